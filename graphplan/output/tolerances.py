"""Tolerances of what is written: of what size each is a part, and why it is so large."""

ZERO_TOL = 1e-9  # of a size of the machine, or of what bearings bore before: what is less is printed as zero
# of a diagram's range, or its size, or a column's largest number: what is less is zero, and no corner, jump or side is
# drawn
RANGE_TOL = 1e-9
TRAVEL_TOL = 1e-9  # of the cycle: travels that differ by less are one
HARMONIC_TOL = 1e-9  # of the mean weight: a first harmonic of no more has no phase
MIN_WEIGHT = 1e-9  # of mass: the largest ordinate of a diagram whose weights are all zero
OFFSET_TOL = 1e-6  # of the base circle's radius: a corner that is so near to the offset lies on it
BASE_TOL = 1e-9  # of the base circle's radius: a base circle that is larger than the least by no more is the least
STILL_RATE = 1e-12  # of the largest lift, for each radian: a piece that moves more slowly rests
