"""Balancing of rotors: polygons of forces and moments, and trial runs."""
