"""Tolerances of the analytic solver: of what size each is a part, and why it is so large."""

# ---- bounds ---------------------------------------------------------------------------------------------------------

ROUNDOFF = 2.0**-53  # of a result: half a unit in its last place
MARGIN = 1 + 2.0**-50  # times a bound: more than the roundings of the bound itself

# ---- systems --------------------------------------------------------------------------------------------------------

# of the largest singular value, times the number of rows: coordinates and their differences carry a rounding of about
# 2^-52 each, which moves every singular value by up to n 2^-52 sigma_max, and the decomposition as much again; with a
# margin, anything below 8 times that may be zero
SINGULAR_TOL = 8 * 2.0**-52
# of the largest singular value, over many poses at once: a smaller one counts as zero; up to 32 rows of the same
POSE_SINGULAR_TOL = 2.0**-44
# of a null vector's largest entry: it is known to about its gap's rounding, and half of the digits tell what moves
# from what stands still
NULL_VECTOR_TOL = 2.0**-26

# of an eigenvalue when its steps are doubled, relative to it: the condition is told to five digits
EIGENVALUE_TOL = 1e-6

# ---- friction -------------------------------------------------------------------------------------------------------

# of the largest force, times the condition of the system: how close two rounds of friction are at the end
FRICTION_TOL = 1e-14
FORCE_TOL = 8 * 2.0**-52  # of the largest force, times the condition of the system: a smaller one has no direction
# of the fastest, times the condition of the rates: what moves more slowly relative to its neighbour stands still
SLIP_TOL = 8 * 2.0**-52
POWER_TOL = 1e-12  # of the power with friction: what the balances give without it is nothing but rounding
