"""Frames and title blocks, and the coded marks in the corners."""
