"""Tolerances of checks: of what size each is a part, and how far apart independent results may be."""

# ---- poses ----------------------------------------------------------------------------------------------------------

PROVEN_ZERO = 2.0**-64  # of the largest of a kind: a number that is proven to be smaller is zero
PROVEN_TOL = 1e-9  # of a number: what its bound may be at most
ROUNDING_TOL = 1e-12  # of a number: differences up to this are rounding in any construction
RESTING_TOL = 1e-12  # of the drives' rates, by the mechanism's size: in a pose of a cycle what is slower stands still
EPSILON = 2.0**-52  # of a number: what its rounding may be
UNPROVEN_TOL = 1e-6  # of a number: where no arithmetic at hand proves it, a difference up to this is taken for rounding
# of the distance of the joints: so near is a point on their line or in the middle between two, which marks show
COLLINEAR_TOL = 1e-9

# ---- machines -------------------------------------------------------------------------------------------------------

FRICTION_TOL = 1e-9  # of the balance: rounds of friction, drawn as many times in every pose, may leave so much
# of what the drive makes at the mechanism's reach: a slide that is slower is at a dead point; rates carry some 1e-14
DEAD_POINT_TOL = 1e-9
SPEED_TOL = 1e-9  # of speeds: by so much the construction and the integration may differ
# of the largest speed, the whole time and the largest energy: so far apart independent motions may be
MOTION_TOL = 1e-8
STRETCH_TOL = 1e-13  # of travels and speeds: the last terms of the series of a stretch of the motion
PICARD_TOL = 1e-14  # of the same, some fifty roundings: a round that changes less is the last
INTERPOLATION_TOL = 1e-12  # of the largest value: how well Chebyshev's points give it between them
BREAK_DISTANCE = 1e-6  # of the cycle: breaks nearer to each other are one
MIN_SPEED = 1e-3  # rad/s: the size of speeds that are taken for the integration's error, as of a start from rest

# ---- balance, rotors and cams ---------------------------------------------------------------------------------------

SUM_TOL = 1e-9  # of the size of what is added up: so far apart independent sums may be
CAM_STEP = 1e-4  # radians of the cam between numbers that are differentiated: the fourth power of it is the error
# of the base circle or of the largest value: by so much independent results may differ; the last two are
# differentiated
CAM_TOL = {"points": 1e-11, "motion": 1e-11, "curvature": 1e-5, "law": 1e-6, "load": 1e-9}

# ---- syntheses ------------------------------------------------------------------------------------------------------

# of the largest length: by so much independent results may differ; envelopes are differentiated
SYNTHESIS_TOL, ENVELOPE_TOL = 1e-9, 1e-8
FOLLOWED_TOL = 1e-6  # of the largest length: near a limit half the digits of a pose are lost by its travel
STENCIL_STEP = 1e-3  # radians between numbers that are differentiated: the fourth power of it is the error
RATE_WEIGHT = 1e-6  # differences of numerical derivatives count so little beside those of lengths

# ---- errors of position ---------------------------------------------------------------------------------------------

# of the mechanism's extent, or radians: steps of the dimension between poses whose positions are differentiated; their
# fourth power is the error, which is large near limit positions, where smaller steps serve
DIFFERENCE_STEPS = 1e-4, 1e-6, 1e-7
# of a coefficient: so far apart it and the differences may be, the rounding of positions being divided by the step
DIFFERENCE_TOL = 1e-6
