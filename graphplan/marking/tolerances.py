"""Tolerances of rounding in what is read and judged: of what size each is a part, and why it is so large.

What pencils, scanners and students do to a drawing is measured, and stands where it is used.
"""

from fractions import Fraction

# ---- files ----------------------------------------------------------------------------------------------------------

SIZE_TOL = 1e-4  # of a size: as files write their numbers
BULGE_TOL = 1e-6  # of the distance of its ends: what bulges less is straight, as files have seven digits
COLLINEAR_TOL = 1e-12  # of the sides' product: three spots that are no further off one line give no circle
PARALLEL_TOL = 2.0**-50  # sine of the angle between lines: a smaller one is rounding

# ---- numbers --------------------------------------------------------------------------------------------------------

FIGURE_TOL = 1e-3  # of a number: the part that may be lost by rounding it to three figures
# times a length: a vector that ends just in a point has a mark of its own then
VECTOR_END_RATIO = 1 + Fraction(1, 10**9)
VARIANCE_TOL = 1e-9  # of the largest variance: a smaller one is none, as a covariance has half of a float's digits
BOUND_TOL = 1e-6  # of one square of a normal deviate: how closely a bound of their sum is searched
VARIANCE_FLOOR = 1e-9  # mm²: is added to variances, that a covariance has an inverse where spots have no error
SCALE_STEP = 1e-6  # of a scale: the next coarser one is coarser by more

# ---- pictures -------------------------------------------------------------------------------------------------------

# of full ink, of ink for each square of a pixel, or pixels: a smaller divisor is this, where there is nothing to
# divide
MIN_DIVISOR = 1e-9
