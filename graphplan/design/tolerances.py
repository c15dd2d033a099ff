"""Tolerances of expected errors: of what size each is a part, and why it is so large."""

ZERO_TOL = 1e-12  # of the error: a kind whose largest value is smaller is zero
MAX_GROWTH = 1e7  # of a mark's own slip: where those before it become more, curves cross too flat for a pencil
EXTENT_TOL = 1e-9  # of the mechanism's extent: a plan that is no larger is a point, but for rounding
