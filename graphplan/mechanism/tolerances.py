"""Tolerances of what is given: of what size each is a part, and why it is so large."""

from decimal import Decimal
from fractions import Fraction

# of their coordinates: rounded points that lie no further apart were meant to coincide
COINCIDENCE_TOL = Fraction(1, 10**12)
PLACE_TOL = Fraction(1, 10**14)  # of a coordinate: what a place may be off by where it was computed in floats
# of a radius squared: where centres are rounded, arcs whose half-chord squared is below zero by so much do touch
TANGENCY_TOL = Fraction(1, 10**12)
# sine of the angle by which a point may be off the common normal, where coordinates are written in ten digits
NORMAL_SINE_TOL = Fraction(1, 10**9)
# of the larger length: lengths that differ by less were meant to be equal, however they are written
LENGTH_TOL = Fraction(1, 10**9)
# of a table's length: by so much a place may be off by rounding, beyond its ends or beside a jump
TABLE_END_TOL = Fraction(1, 10**9)
# of what the drives make at the mechanism's reach: a slide that is slower is at a dead point; rates carry some 1e-14,
# and a dead point that is computed in floats is off by more
DEAD_POINT_TOL = 1e-9
# of the coefficients of a series, which are about 1: they are good to twice as many digits and more
SERIES_TOL = Decimal("1e-40")
