"""Tolerances of cams: of what size each is a part, and why it is so large."""

# ---- the law --------------------------------------------------------------------------------------------------------

JUMP_TOL = 1e-9  # of the largest value of a derivative: a jump of no more is none; laws are computed to some 1e-13
LIFT_TOL = 1e-9  # of the largest lift: a lift of no more is none, as where a law's pieces add up to zero
MIN_SIZE = 1e-300  # in any unit: stands for the largest value of a law that is zero everywhere, above underflow

# ---- the cam --------------------------------------------------------------------------------------------------------

# radians: an arm at a smaller angle lies on the line of centres; roots of a search are no better than 1e-8
ARM_ANGLE = 1e-9
# degrees: by so much a limit of an angle may seem to be overstepped, and no arc is divided further
ANGLE_TOL_DEG = 1e-9
# of the base circle's radius, or of the profile: by so much a limit of a length may seem to be overstepped
LENGTH_TOL = 1e-9
ZERO_LENGTH = 1e-12  # of the base circle's radius: lengths of no more are rounding, and their ends are one point
FLAT_ARC = 1e-12  # of half the chord: an arc whose middle is no further off it is straight
DIRECTION_TOL = 1e-15  # of a unit vector: a part so near to 0, 1 or -1 is that; sines and cosines are rounded to 1e-16

LEAST_TOLERANCE = 1e-9  # of the task's lengths: what --tolerance takes of an outline, which rounding still leaves

# ---- the load -------------------------------------------------------------------------------------------------------

# of the stroke or the largest velocity: with no more a follower is lowest, or stands; of a preload: it is enough with
# so little less
LEAST_LIFT = 1e-6

# ---- the sheet ------------------------------------------------------------------------------------------------------

OFFSET_TOL = 1e-6  # of the base circle's radius: a corner that is so near to the offset lies on it
STILL_RATE = 1e-12  # of the largest lift, for each radian: a piece that moves more slowly rests
