"""Live pages: constructions that move in a browser, each from one file that needs no network."""
