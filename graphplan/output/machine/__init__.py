"""Sheets and numbers of the machine over its cycle, and of balancing."""
