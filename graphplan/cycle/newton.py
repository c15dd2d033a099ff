"""Newton's method held to one branch: poses corrected from predictions, and whether each is certain to stay there.

A predicted pose is trusted only where the first correction is small beside the step that it predicts, where each
further one is small beside the one before, and where no determinant of a part has changed its sign: it does wherever
two branches meet.
"""

from __future__ import annotations

import numpy as np

from graphplan.cycle.closure import Closure
from graphplan.cycle.linkage import Array

_NEAR = 1 / 16
"""The largest first correction, of the step."""

_SHRINKING = 1 / 4
"""The largest further correction, of the one before."""

SETTLED = 2.0**-13
"""A quarter of the digits: a correction below it, of the step, leaves half of them, and the next one leaves none."""


def settle(closure: Closure, predicted: Array, travel: Array, step: Array) -> tuple[Array, Array, Array]:
    """The poses at these travels, the derivatives last used, and the mask of those to be trusted (their senses apart).

    Reads predictions of shape (n, 2, links), travels (n,), and the length (n,) of the step that predicts each.
    """
    pose, trusted = predicted, np.ones(len(travel), dtype=bool)
    allowed, settled = _NEAR * step, np.zeros(len(travel), dtype=bool)
    while True:
        correction = closure.correction(pose, travel)
        size = correction.size
        trusted = trusted & (size <= allowed)
        pose = np.where(trusted[:, None, None], closure.corrected(pose, correction), predicted)
        if np.all(settled | ~trusted):
            return pose, correction.jacobian, trusted
        settled = size <= SETTLED * step
        allowed = np.where(settled, _NEAR * step, _SHRINKING * size)


def distance(one: Array, other: Array) -> Array:
    """How far n poses lie apart: the largest change of a link's base, in reaches, or of its turn; shape (n,)."""
    return np.max(np.abs(one - other), axis=(1, 2))
