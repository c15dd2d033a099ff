"""Curvature of paths and inflection circles from the rates alone: the second opinion on what Euler and Savary draw.

With v and a of a point its path has the curvature (v x a) / |v|^3, to the left of v. A link that turns has its velocity
pole P where v vanishes; the acceleration of the link's own point there is omega^2 times the vector from P to the
inflection pole, whatever alpha. Numbers are those of the rates: floats, fractions, or numbers with bounds.
"""

from __future__ import annotations

from typing import Any

from graphplan.errors import by_name
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.numbers import Pair, dot, plus, quarter_turn, times
from graphplan.solver.rates import Rates


def centre(rates: Rates, point: str, link: str) -> Pair:
    """The centre of curvature of a point's path; divides by zero where that is straight, or where the point rests.

    A point at rest that turns about a pivot, as at a dead centre, has that as its centre: if it may, that of the link.
    """
    v, a = _point_rates(rates, point)
    scene = rates.equations.scene
    try:
        return plus(scene.points[point], times(dot(v, v) / dot(quarter_turn(v), a), quarter_turn(v)))
    except ArithmeticError:
        links = sorted(scene.links_of[point], key=lambda one: (one != link, by_name(one)))
        pivots = [p for one in links for p in scene.links[one] if FRAME in scene.links_of[p]]
        if not pivots:
            raise
        return plus(scene.points[pivots[0]], times(0, v))


def curvature(rates: Rates, point: str) -> Pair:
    """The vector from a point towards the centre of curvature of its path, as long as one over the radius; divides by
    zero where the point rests, unless it is on a link that slides on the frame."""
    v, a = _point_rates(rates, point)
    square, links = dot(v, v), rates.equations.scene.links_of[point]
    try:
        return times(dot(quarter_turn(v), a) / square / square, quarter_turn(v))
    except ArithmeticError:
        if not any(FRAME in slide.links and {*links} & {*slide.links} for slide in rates.equations.scene.slides):
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


def divide_vector(a: Pair, number: Any) -> Pair:
    """A vector over a number."""
    return a[0] / number, a[1] / number


def _point_rates(rates: Rates, point: str) -> tuple[Any, Any]:
    return rates.velocity[point], rates.acceleration[point]
