"""The standard deviation of what is mostly noise: by the median, which strays do not move."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

NORMAL = 0.6745  # the median of what is off, in standard deviations


def deviation(off: NDArray[np.floating]) -> float:
    """How far off things are, as a standard deviation."""
    return float(np.median(np.abs(off))) / NORMAL
