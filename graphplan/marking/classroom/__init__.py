"""A class: its tasks, its stack of drawings, and what was found of them."""
