"""Tolerances of machines: of what size each is a part, and why it is so large.

Loads are measured by what they could do, speeds by what the drive makes at the mechanism's reach: no rounding is
measured by itself.
"""

# ---- integrals and rounding -----------------------------------------------------------------------------------------

# of the largest value, as of the largest energy and the whole time: terms of a series below it are rounding
SERIES_TOL = 1e-13
SIGN_TOL = 1e-14  # of the largest value: what is smaller has no sign
COUNT_TOL = 1e-9  # of one: by so much a number of panels or steps may be beyond a whole one by rounding
# of the size of the machine, as the least that terms which sum up to a moment are taken for: a thousandth of what is
# rounding beside it, 1e-13, is that of a float
MACHINE_SHARE = 1e-2

# ---- reduction ------------------------------------------------------------------------------------------------------

# of the drive's rate, at the mechanism's reach for what slides: a slide that is slower is at a dead point, and what
# is slower everywhere stands still; rates carry some 1e-14
DEAD_POINT_TOL = 1e-9
TABLE_TOL = 1e-9  # of a table's length: a place that is so near to a dead point is that
BREAK_DISTANCE = 1e-11  # of the range: breaks that are nearer to each other are one
BREAK_TOL = 4e-16  # of a travel, two roundings: a break that a round of the search moves by less is found
# of the cycle: so far beside a break it is seen how pairs move there; ten times the distance of breaks
BREAK_OFFSET = 1e-10
SIGNLESS_TOL = 1e-12  # of the drive's rates, or of the largest reaction: what is smaller has no sense
EDGE_TOL = 1e-9  # of a slide's reaction: how much nearer or further than its edge it may pass through that
BALANCE_TOL = 1e-9  # of the balance: what one round of friction more may change

# ---- flywheel -------------------------------------------------------------------------------------------------------

WORK_TOL = 1e-9  # of the work that the loads together do to and fro: a work of no more is none
CANCELLED_WORK_TOL = 1e-14  # of the same work: what is left of sums that cancel
MOTOR_TOL = 1e-9  # of the larger: a motor's arm and rate that vary by no more over the cycle are constant
LINE_TOL_MM = 1e-6  # mm: three points so near to a line lie on it, finer than any pen
SPEED_TOL = 1e-14  # of a speed: a step of the search that is smaller is the last; some fifty roundings
# of a speed, or of the machine's own inertia: it runs evenly but for rounding, and a flywheel of less is rounding
EVENNESS_TOL = 1e-12
AREA_TOL = 1e-10  # of all areas: a smaller area is none
ORDINATE_TOL = 1e-9  # of the largest ordinate, or of the cycle: what differs by less is one
MOMENT_JUMP = 1e-6  # of the largest moment: one that jumps by more has a point on each side
PLAN_TOL = 1e-6  # of the distance of two plans: by so much a corner may lie before the plan whose number it has

# ---- motion ---------------------------------------------------------------------------------------------------------

INERTIA_TOL = 1e-9  # of the largest inertia: a smaller one is none, as squares of rates at a limit position
MIN_STRETCH = 1e-13  # of the travel asked for: a stretch that must be narrower leads nowhere
MOMENT_TOL = 1e-11  # of the largest moment: what is below it moves nothing from rest
TRAVEL_TOL = 1e-12  # of the span of a machine: by so much a travel may end beyond it by rounding
STOP_TOL = 4e-16  # of the energy, two roundings: a stretch whose work misses it by less comes to rest at its end
CYCLE_TOL = 1e-12  # of the energy, or of all work in a cycle: what is less is rounding
MIN_RANGE = 1e-3  # of the largest value: a smaller range is shown as one of this size
SCALE_TOL = 1e-9  # of a scale: by so much one of the series may be below the least that fits
ENERGY_TOL = 1e-15  # of the largest energy: what the last round of Newton's method changes at most, five roundings
RATE_STEP = 1e-7  # of the rate: the step by which laws are differentiated; the root of rounding is about this

# ---- rotors ---------------------------------------------------------------------------------------------------------

CLOSING_TOL = 1e-12  # of the sum of a polygon's sides: what closes it and is shorter is rounding
MIN_EFFECT = 1e-3  # of the rotor's own vibration: a trial weight that changes it by less has no effect
VIBRATION_TOL = 1e-9  # of a trial weight's effect: a vibration of less is none
PREDICTION_TOL = 1e-6  # of a vibration: predictions that differ by less tell nothing
HARMONIC_TOL = 1e-12  # of the mean weight: a first harmonic of no more is rounding of its sum

# ---- mass centres and counterweights --------------------------------------------------------------------------------

COINCIDENCE_TOL = 1e-12  # of the mechanism's extent: points that lie no further apart are one, and give no line
VECTOR_TOL = 2.0**-45  # of its mass times the length of its link: a part of a vector that is smaller is rounding alone
BALANCED_TOL = 1e-11  # of what is to be balanced: what is left over is rounding
WEIGHT_TOL = 2.0**-44  # of a counterweight's mass: what a round may change where counterweights load each other's links
# of the reach, of the largest singular value, or of a unit vector: coefficients of mass centres below it are rounding
FACTOR_TOL = 1e-12
# of the rod's length: a smaller term of the series is none; its mean over 1,024 places is good to 1e-16
TERM_TOL = 1e-15
ON_LINE_TOL = 1e-9  # of its link's length: so near is a mass centre on the line of its joints
ORDER_TOL = 1e-9  # of the number of cranks: a sum of their directions that is smaller is zero

# ---- sheets ---------------------------------------------------------------------------------------------------------

ZERO_TOL = 1e-9  # of a size of the machine, or of what bearings bore before: what is less is printed as zero
MIN_WEIGHT = 1e-9  # of mass: the largest ordinate of a diagram whose weights are all zero
