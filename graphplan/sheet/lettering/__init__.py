"""How it is lettered: names as a textbook sets them, placed beside their marks."""
