"""Tolerances of sheets: of what size each is a part, or how many mm of paper it is, and why it is so large."""

# ---- of what is drawn -----------------------------------------------------------------------------------------------

# of the largest mark: by more a drawn mark does not differ from what the rules say, unless its form fails
MARK_TOL = 1e-6
ARC_TOL = 1e-9  # of a radius squared: an arc's end lies on this side of its middle by more than rounding
# of the mechanism: a plan that is no larger is a spot, and what moves less stands in the given pose; rounding is
# 1e-15
EXTENT_TOL = 1e-9
# of the distance of crank and wheel: by which a Geneva wheel's crank may miss the sine of half the angle of its slots
SLOTS_TOL = 0.005
MIN_VECTOR = 0.02  # of the largest vector of its kind: a shorter one asks for no larger scale

# ---- mm on paper ----------------------------------------------------------------------------------------------------

SHORT_STROKE = 0.3  # mm: what is left of a stroke is not drawn if it is shorter, about a pen's width
MIN_LENGTH = 0.05  # mm: what is shorter has no length on paper; half a tenth, the last digit that is printed
EDGE_TOL = 1e-6  # mm: by which edges that should be one may differ
LEVEL_TOL = 1e-7  # mm: an edge that rises by less between two sides is level; its slope would be rounding
LEAN_TOL = 1e-6  # mm: the sum of arms by which the spots about a guide lie on one of its sides
RADIUS_TOL = 1e-6  # mm: a circle of a smaller radius is a spot and has no arcs
AREA_TOL = 1e-6  # mm²: marks in a smaller box all coincide, and are nowhere apart
SPOT_TOL = 1e-9  # mm: spots no further apart coincide but for rounding, and corners that bulge less are none
ZERO_SCALE = 1e-9  # units per mm: stands for the scale of a plan whose marks all coincide

# ---- numbers and scales ---------------------------------------------------------------------------------------------

SCALE_TOL = 1e-9  # of a scale: scales closer than this are one; their decimals are rounded to 1e-16
FIGURE_TOL = 1e-9  # of a figure: within it all of it is printed, where few digits do
ZERO_TOL = 1e-12  # of the largest number of its kind: a smaller one is printed as zero
LENGTH_TOL = 5e-4  # of a length carried over: what differs by less is as long; half of the fourth digit
STEP_TOL = 1e-9  # of a division: by so much one may be below a round step, or beyond the end of an axis, by rounding
