"""Errors of position: by transformed mechanisms, from the tolerances of dimensions."""
