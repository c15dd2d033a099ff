"""Tolerances of the motion: of what size each is a part, and why it is so large.

States are counted in radians and in reaches of the linkage, determinants in the same; steps in parts of a turn.
"""

# ---- Newton's method ------------------------------------------------------------------------------------------------

# in reaches: stands for a pivot that is zero, so that a rotation is one then, too; its square does not underflow
TINY_PIVOT = 1e-150
DETERMINANT_TOL = 1e-140  # in reaches: a determinant below it has a pivot that is zero
# of the step, a quarter of the digits: a correction below it leaves half of them, and the next one leaves none
CORRECTION_TOL = 2.0**-13
CLOSURE_TOL = 2.0**-26  # of the step, half of the digits: a correction below it leaves none
RESIDUE_TOL = 2.0**-54  # of the step: the square of a correction, which is what it leaves; below rounding
# in radians and reaches: the largest last correction; its square is what is left, 1e-10 of the linkage
RELATION_TOL = 1e-5

# ---- the path -------------------------------------------------------------------------------------------------------

# of the longest step: the finest. Near a limit a pose changes with its root, so half of these digits stand there
MIN_STEP = 2.0**-36
# of the longest step: no step to a goal is trusted less than one so long. Of a shorter one rounding is no small part;
# another branch is further off, as its determinant is
MIN_GOAL_STEP = 2.0**-24
# of the step: where the prediction missed by less, the next step is twice as long. What lies between the knots is
# then predicted so well that one correction is enough for most poses
LONGER_MISS = 2.0**-13
SHORTER_MISS = 2.0**-8  # of the step: where the prediction missed by more, the next step is half as long
SINGULAR_TOL = 2.0**-22  # of a part's determinant in the given pose: below it, rounding may choose the branch
# of the longest step: the step that leads straight through a change point, and nowhere beyond a limit position. It
# tells the change point to as small a part of itself: rounding weighs there as much
CROSSING_STEP = 2.0**-12
# in radians and reaches: links that are so near to where they were are back; a state is corrected to 1e-14
RETURN_TOL = 1e-9
PLACE_TOL = 1e-6  # of the extent: the cycle comes to this place; at a limit position half of the digits stand
PIN_TOL = 1e-6  # mm: places of the frame that are so near are one; the page writes as many digits
LOOK_AHEAD = 1e-4  # in radians or of the mechanism's extent: how far ahead a slide at a dead point is seen to move

# ---- rates and curves -----------------------------------------------------------------------------------------------

# of the rates of two links: links that turn relative to each other by less turn alike; rates carry some 2^-50
TURNING_TOL = 2.0**-40
POLE_TOL = 1e-9  # of the size at which centrodes are drawn: a pole that moves by less stays in its place
RATE_STEP = 2e-4  # of the whole travel: between poses from which rates are taken; the fourth power of it is the error
TIME_TOL = 2.0**-40  # of the whole time: times read back from the paper are not beyond the ends for less
RATE_TOL = 2.0**-30  # of what the motion would need to show: rates below it are rounding alone
ORDINATE_TOL = 2.0**-40  # of the largest ordinate: errors below it have no order
REST_RATE = 1e-9  # for a unit of the drive's travel: a link that turns or slides no faster stands still
DWELL_TOL = 0.05  # of the stroke: a link that turns back more than once within it, at one end, dwells there
LENGTH_TOL = 2.0**-40  # of the longest side: lengths that are taken from coordinates carry some 2^-50
