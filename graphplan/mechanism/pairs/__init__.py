"""Kinematic pairs: one file a kind, each with all that is said of it."""
