"""Synthesis: mechanisms found on the drawing board, from what they are to do (Ozols 1974, chapters 19, 21 and 22)."""
