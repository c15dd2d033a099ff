"""Sheets of cams: the construction by inversion, the curve x(s), the law's diagrams, and the words."""
