"""Position errors: by transformed mechanisms, from the tolerances of dimensions."""
