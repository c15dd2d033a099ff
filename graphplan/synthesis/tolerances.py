"""Tolerances of syntheses: of what size each is a part, and why it is so large."""

CHANGE_TOL = 1e-9  # of the sum of both lengths: linkages whose sums differ by no more are at a change point
SINE_TOL = 1e-12  # a sine: directions that differ by no more are one, as those of positions with equal angles
COLLINEAR_TOL = 1e-10  # a sine: points that are so nearly in a line have no circle that can be drawn
SAME_POINT_TOL = 1e-10  # of the size of the task: places no further apart are one
ROOT_TOL = 1e-7  # of the size of a root: one with no larger imaginary part is real, as double roots halve the digits
GUESS_TOL = 1e-3  # of the size of a root: of a resultant one that is so nearly real is tried, and then bettered
STEP_TOL = 1e-15  # of the size of the task: a step of Newton that is no larger is the last
RESIDUAL_TOL = 1e-11  # of the squared size of the task: a Burmester point meets all five positions to this
SENSE_TOL = 1e-9  # a sine: an angle that is no larger is at a dead point, and has no sense
ANGLE_STEP = 1e-16  # radians: a step of Newton that is no larger is rounding
LENGTH_TOL = 1e-12  # of the size of the task: lengths of no more are rounding
