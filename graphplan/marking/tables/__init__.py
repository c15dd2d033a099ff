"""Tables of measured points and of results."""
