"""The cubic of stationary curvature: the points of a link whose paths keep their curvature to third order.

With the link's angle as the time, the pole P as the origin and A the vector to the inflection pole, the acceleration of
the point z of the link is A - z and its jerk J - i z. That the curvature of its path does not change leaves of each ray
through P, of the direction u, one point (Mueller):

    r = 3 (u x A) (u . A) / (u . J + 3 u x A)

These are the circling points. The centres of curvature of their paths, by Euler and Savary, are the centre points. A
and J follow from how the pole wanders: A = -i P' and J = P' - i P''.
"""

from __future__ import annotations

import numpy as np

from graphplan.cycle.centrodes import centrodes
from graphplan.cycle.linkage import Array
from graphplan.cycle.tolerances import RATE_STEP
from graphplan.cycle.turn import RangeOfMotion
from graphplan.mechanism.model import FRAME

RAYS = 7200  # of half a turn
FIRST, SECOND = np.array([1, -8, 0, 8, -1]) / 12, np.array([-1, 16, -30, 16, -1]) / 12


def stationary(motion: RangeOfMotion, link: str) -> tuple[Array, Array] | None:
    """The circling points of a link in the given pose and their centres, ray by ray; complex arrays of shape (n,).

    None where the link does not turn there, or the mechanism does not move on to both sides.
    """
    whole = float(np.ptp(motion.path.travel))
    step = RATE_STEP * whole
    travel = step * np.arange(-2, 3)
    links = motion.moved(travel % whole if motion.whole else travel)
    spin, poles = links[link].spin, centrodes(links, link, FRAME).fixed
    with np.errstate(all="ignore"):
        wander = (FIRST @ poles) / step / spin[2]
        bent = ((SECOND @ poles) / step**2 - wander * (FIRST @ spin) / step) / spin[2] ** 2
        A, J, rays = -1j * wander, wander - 1j * bent, np.exp(1j * np.linspace(0, np.pi, RAYS, endpoint=False))
        along, across, jerk = ((rays.conj() * A).real, (rays.conj() * A).imag, (rays.conj() * J).real)
        far = 3 * across * along / (jerk + 3 * across)
        centres = far * along / (along - far)
    if not (np.isfinite(A) and np.isfinite(J)):
        return None
    return poles[2] + far * rays, poles[2] + centres * rays
