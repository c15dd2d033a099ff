"""Tolerances of constructions: of what size each is a part, and why it is so large."""

# ---- places and directions ------------------------------------------------------------------------------------------

# of the mechanism's extent: places no further apart coincide, and what is further than its inverse is at infinity;
# marks of a long construction lose six of sixteen digits at most
EXTENT_TOL = 1e-9
CONTROL_TOL = 1e-6  # of the mechanism's extent: marks that are nearer show no direction, to the eye nor to a pencil
# of the product of lengths, or of a number: vectors that are no further apart run alike; their coordinates are some
# roundings off
PARALLEL_TOL = 1e-13
PLACE_TOL = 1e-12  # of their coordinates: points no further apart are one, as far as floats can show
MIN_SIZE = 1e-300  # in any unit: stands for the size of coordinates that are all zero, above underflow
PENCIL = 1e-3  # of the mechanism: how far off a point is that is given or marked with a pencil
# sine of the angle between two poles on the unit sphere: below it their line is found from their numbers
NEAR_SINE = 1e-4
SINE_TOL = 1e-9  # sine of an angle: vectors at a smaller one are one, and its square is that of a point at infinity
# of a unit vector in homogeneous coordinates: its last part, below which a pole lies at infinity but for rounding
INFINITY_TOL = 1e-13

# ---- forces ---------------------------------------------------------------------------------------------------------

# of the largest force, at the mechanism's extent: how far off its circle or its line a force may be
FRICTION_TOL = 1e-12
SHORT_FORCE = 1e-9  # of the mechanism's extent: a force that is drawn shorter is zero
# of the largest force on a link: one that is drawn shorter shows no line of action, so its arm is not drawn
DIRECTION_SHARE = 0.02
# of the largest reaction: a slide's that is smaller has no line to speak of, as its place is a moment divided by it
REACTION_TOL = 1e-6
