"""Instant centres from the rates of the links: where two of them have one velocity.

Relative to link j every point X of link i has the velocity v + w x OX, v being that of a point O of link i and w the
difference of the angular velocities. It vanishes at O + (-v_y, v_x)/w; where w is nothing, that is at infinity, square
to v.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NamedTuple

from graphplan.errors import SingularPose
from graphplan.mechanism.model import FRAME, Pair
from graphplan.mechanism.numbers import dot, times
from graphplan.solver.rates import Rates


class Relative(NamedTuple):
    """How a link moves relative to another: `across` is the velocity of its point O, a quarter ahead."""

    O: Pair
    across: Pair
    turning: Any

    @property
    def moves(self) -> bool:
        """Whether it certainly moves."""
        return any(map(_certain, (self.turning, *self.across)))

    @property
    def centre(self) -> Pair:
        """The instant centre; fails where the turning may be nothing."""
        x, y = self.across
        return self.O[0] + x / self.turning, self.O[1] + y / self.turning

    def heading(self, like: Pair) -> Pair:
        """The heading to an instant centre at infinity, in the size and sense of one `like` it; nothing where it is
        certainly not at infinity."""
        if _certain(self.turning):
            return 0 * like[0], 0 * like[1]
        return times(dot(self.across, like) / dot(self.across, self.across), self.across)


def relative(rates: Rates, one: str, two: str) -> Relative:
    """How link `one` moves relative to link `two`, in numbers of any kind.

    What they share tells it where they happen to stand still: a pin, or a guide. Fails with `SingularPose` where
    nothing does.
    """
    scene, zero = rates.equations.scene, 0 * next(iter(rates.omega.values()))
    for joint in scene.revolutes:
        if {one, two} <= {*joint.links}:
            return Relative(scene.points[joint.at], (zero, zero), 1)
    for slide in scene.slides:
        if {one, two} == {*slide.links} and slide.turns_alike:
            x, y = slide.direction
            return Relative(scene.points[slide.at], (zero - y, zero + x), zero)
    at, off = one if one != FRAME else two, 1 if one != FRAME else -1
    O = rates.equations.bases[at]
    (x, y), turning = rates.velocity[O], rates.omega[at]
    other = two if at == one else one
    if other != FRAME:
        base = rates.equations.bases[other]
        (bx, by), (vx, vy) = scene.points[base], rates.velocity[base]
        ox, oy = scene.points[O][0] - bx, scene.points[O][1] - by
        x, y = x - vx + rates.omega[other] * oy, y - vy - rates.omega[other] * ox
        turning = turning - rates.omega[other]
    if isinstance(turning, Fraction) and not any((x, y, turning)):
        raise SingularPose("they do not move relative to each other here, so any point is a pole of theirs", (one, two))
    return Relative(scene.points[O], (-y * off, x * off), turning * off)


def _certain(number: Any) -> bool:
    """Whether a number is known not to be nothing."""
    if hasattr(number, "overlaps"):
        return not number.overlaps(type(number)(0.0))
    return isinstance(number, Fraction) and number != 0
