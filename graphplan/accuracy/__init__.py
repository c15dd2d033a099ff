"""The draughtsman: what a construction costs him, how far off his pencil is, and which form he would rather draw."""
