"""Tolerances of the kernel: of what size each is a part, and why it is so large."""

# ---- rounding of floats ---------------------------------------------------------------------------------------------

ULP = 2.0**-52  # of a number: what its rounding may be
ROUNDOFF_TOL = 2.0**-50  # of the products that a difference is made of: it is noise within a few roundings of them
COINCIDENCE_TOL = 1e-13  # of the largest numbers that a mark was made from: what differs by less is one
SHELF_SHARE = 1e-7  # of the mechanism's extent: lines further apart are never taken for one, so they are kept apart
COLLINEAR_TOL = 1e-13  # of the sides' product: what is no further off the line lies on it
DIVISOR_SHARE = 2.0**-20  # of the terms of a divisor: if less is left of them, too few digits are

# ---- figures --------------------------------------------------------------------------------------------------------

# of the sizes that a claim compares: the residual of one that holds, however often its marks were rounded
CLAIM_TOL = 1e-9
MIN_MEASURE = 1e-3  # of a figure's extent: what is smaller is measured by this
STANDSTILL_TOL = 1e-12  # of the drawing's size: what moves less may be said to stand still
CLOSURE_TOL = 1e-9  # of the linkage: a last Newton correction that is larger leads nowhere
FORM_TOL = 1e-6  # of the figure that is drawn: a form of a compound that loses more is not taken
# of the width of a plan's marks: a shorter length, or a longer one, is not constructed, but computed and laid off
MIN_DRAWN, MAX_DRAWN = 0.02, 1.0

# ---- curves ---------------------------------------------------------------------------------------------------------

LOCUS_TOL = 1e-4  # of the distance of two plans: what a curve through them may be off at most, below a pen's width
# of the parameter between two plans: central difference by which the direction of a locus is found
LOCUS_STEP = 2.0**-12
