"""The live page: a construction that moves in a browser, from one file that needs no network."""
