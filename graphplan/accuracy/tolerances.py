"""Tolerances of surveys: of what size each is a part, and why it is so large."""

MIN_SIZE = 1e-12  # in units of the mechanism: stands for the size of marks that are made from the origin alone
EPSILON = 2.0**-52  # of a number: what its rounding may be
MIN_ERROR = 1e-17  # of a number: errors below it are shown as this, below any rounding
TIMER_TICK = 1e-9  # seconds: the least that a clock tells apart
