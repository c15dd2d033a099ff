"""Instant centres and curvature of paths from the rates alone: the second opinion on poles and on Euler and Savary.

Relative to link j every point X of link i has the velocity v + w x OX, v being that of a point O of link i and w the
difference of the angular velocities. It vanishes at O + (-v_y, v_x)/w; where w is nothing, that is at infinity, square
to v. With v and a of a point its path has the curvature (v x a) / |v|^3, to the left of v. The acceleration of the
link's own point at its velocity pole P is omega^2 times the vector from P to the inflection pole, whatever alpha.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NamedTuple

from graphplan.errors import SingularPose, by_name
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.numbers import Pair, dot, minus, plus, quarter_turn, times
from graphplan.solver.rates import Rates


class RelativeMotion(NamedTuple):
    """Motion of a link relative to another: `across` is the velocity of its point O, turned by a quarter."""

    O: Pair
    across: Pair
    turning: Any

    @property
    def moves(self) -> bool:
        """Whether it certainly moves."""
        return any(map(_is_certainly_not_zero, (self.turning, *self.across)))

    @property
    def centre(self) -> Pair:
        """The instant centre; fails if the turning may be zero."""
        return plus(self.O, divide_vector(self.across, self.turning))

    def heading(self, like: Pair) -> Pair:
        """Heading to an instant centre at infinity, in the size and sense of one `like` it; zero if the centre is
        certainly finite."""
        if _is_certainly_not_zero(self.turning):
            return 0 * like[0], 0 * like[1]
        return times(dot(self.across, like) / dot(self.across, self.across), self.across)


def relative_motion(rates: Rates, link: str, reference: str) -> RelativeMotion:
    """The motion of a `link` relative to a `reference` link, in numbers of any kind.

    What they share tells it where they happen to stand still: a pin, or a guide. Fails with `SingularPose` where
    nothing does, and where two pins hold them together.
    """
    scene, zero = rates.equations.scene, 0 * next(iter(rates.omega.values()))
    pins = [scene.points[joint.at] for joint in scene.revolutes if {link, reference} <= {*joint.links}]
    if len(pins) == 1:
        return RelativeMotion(pins[0], (zero, zero), 1)
    for slide in scene.slides:
        if {link, reference} == {*slide.links} and slide.turns_alike:
            x, y = slide.direction
            return RelativeMotion(scene.points[slide.at], (zero - y, zero + x), zero)
    based_link, sense = link if link != FRAME else reference, 1 if link != FRAME else -1
    O = rates.equations.bases[based_link]
    (x, y), turning = rates.velocity[O], rates.omega[based_link]
    second_link = reference if based_link == link else link
    if second_link != FRAME:
        base, spin = rates.equations.bases[second_link], rates.omega[second_link]
        vx, vy = rates.velocity[base]
        ox, oy = minus(scene.points[O], scene.points[base])
        x, y, turning = x - vx + spin * oy, y - vy - spin * ox, turning - spin
    if pins or (isinstance(turning, Fraction) and not any((x, y, turning))):
        raise SingularPose("they do not move relative to each other here, so any point is a pole of theirs",
                           (link, reference))
    return RelativeMotion(scene.points[O], (-y * sense, x * sense), turning * sense)


def _is_certainly_not_zero(number: Any) -> bool:
    """Whether a number is certainly different from zero."""
    if hasattr(number, "overlaps"):
        return not number.overlaps(type(number)(0.0))
    return isinstance(number, Fraction) and number != 0


def centre(rates: Rates, point: str, link: str) -> Pair:
    """The centre of curvature of a point's path; divides by zero where that is straight, or where the point rests.

    A point at rest that turns about a pivot, as at a dead centre, has that as its centre: if it may, that of the link.
    """
    v, a = _point_rates(rates, point)
    scene, links_of = rates.equations.scene, rates.equations.scene.links_of
    links = sorted(links_of[point], key=lambda link_name: (link_name != link, by_name(link_name)))
    pivots = [p for link_name in links for p in scene.links[link_name] if FRAME in links_of[p]]
    pivot = plus(scene.points[pivots[0]], times(0, v)) if pivots else None
    try:
        radius = times(dot(v, v) / dot(quarter_turn(v), a), quarter_turn(v))
        return _fill_missing(plus(scene.points[point], radius), pivot)
    except ArithmeticError:
        if pivot is None:
            raise
        return pivot


def _fill_missing(value: Pair, fallback: Pair | None) -> Pair:
    """Replace nan in a vector, or in vectors of many poses, by another vector."""
    x: Any
    y: Any
    x, y = value
    return value if fallback is None or not hasattr(x, "fill_missing") else (
        x.fill_missing(fallback[0]), y.fill_missing(fallback[1]))


def curvature(rates: Rates, point: str) -> Pair:
    """The vector from a point towards the centre of curvature of its path, as long as one over the radius; divides by
    zero where the point rests, unless it is on a link that slides on the frame."""
    v, a = _point_rates(rates, point)
    square, links = dot(v, v), rates.equations.scene.links_of[point]
    guided = any(FRAME in slide.links and {*links} & {*slide.links} for slide in rates.equations.scene.slides)
    try:
        return _fill_missing(times(dot(quarter_turn(v), a) / square / square, quarter_turn(v)),
                             (square, square) if guided else None)
    except ArithmeticError:
        if not guided:
            raise
        return square, square


def from_pole(rates: Rates, point: str, link: str) -> Pair:
    """The vector from the pole of a link's motion to its point; divides by zero where the link does not turn."""
    return divide_vector(quarter_turn(rates.velocity[point]), -rates.omega[link])


def inflection_pole(rates: Rates, link: str) -> Pair:
    """The point opposite the pole on a link's inflection circle; divides by zero where the link does not turn."""
    base, omega = rates.equations.bases[link], rates.omega[link]
    tangential = times(-rates.alpha[link], quarter_turn(from_pole(rates, base, link)))
    towards = divide_vector(plus(rates.acceleration[base], tangential), omega)
    return plus(rates.equations.scene.points[base], divide_vector(towards, omega))


def acceleration_centre(rates: Rates, link: str) -> Pair:
    """The point Q of a link that has no acceleration: a_A + (i alpha - omega^2) AQ = 0, as complex numbers; divides by
    zero where the link neither turns nor begins to."""
    base, omega, alpha = rates.equations.bases[link], rates.omega[link], rates.alpha[link]
    (x, y), square = rates.acceleration[base], omega * omega
    to_centre = square * x - alpha * y, square * y + alpha * x
    return plus(rates.equations.scene.points[base], divide_vector(to_centre, square * square + alpha * alpha))


def divide_vector(a: Pair, number: Any) -> Pair:
    """A vector over a number."""
    return a[0] / number, a[1] / number


def _point_rates(rates: Rates, point: str) -> tuple[Any, Any]:
    return rates.velocity[point], rates.acceleration[point]
