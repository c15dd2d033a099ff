"""The pose to a hundred digits: fine enough to tell special geometry from what only comes close to it."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal, localcontext
from fractions import Fraction
from functools import cache, partial
from typing import Any

from graphplan.mechanism.directions import Misfit, vector
from graphplan.mechanism.model import Balance, Scene, Slide
from graphplan.mechanism.numerals import Reckoning, exactly, heading, is_exact, root
from graphplan.mechanism.placements import placed_by

DIGITS = 100
_BITS = 360
_ONE = 1 << _BITS

Place = tuple[Decimal, Decimal]


def fine_pose(scene: Scene) -> tuple[Scene, bool, dict[str, Place]]:
    """A scene in its pose as it is written, unbalanced: points in reaches from the first one, directions of length 1;
    and in which direction each moving link's joints are held."""
    points = _points(scene)
    with localcontext(prec=DIGITS):
        first, *_ = points.values()
        arms = {name: (_decimal(x - first[0]), _decimal(y - first[1])) for name, (x, y) in points.items()}
        reach = max(max(map(abs, arm)) for arm in arms.values()) or Decimal(1)
        places = {name: (x / reach, y / reach) for name, (x, y) in arms.items()}
        axes = {link: _unit(*map(Decimal, across(scene, link, places))) for link in scene.moving}
        return scene.posed(places, lambda one: _guide(one, points)), False, axes


def across(scene: Scene, link: str, places: Mapping[str, tuple[Any, Any]]) -> tuple[Any, Any]:
    """Square to a link that is a bar between two joints; of any other link along x."""
    joints = [places[point] for point in scene.links[link] if point in scene.joints]
    (ax, ay), (bx, by) = joints if len(joints) == 2 else ((0, 0), (0, 0))
    return (ay - by, bx - ax) if (ax, ay) != (bx, by) else (1, 0)


def _points(scene: Scene) -> dict[str, tuple[Fraction, Fraction]]:
    """Every point where its placement puts it; where arcs touch to a float's digits only, as the float that it is."""
    known = {name: exactly(at) for name, at in scene.points.items()}
    if is_exact(*scene.points.values()):
        return known
    try:
        return known | {name: exactly(at) for name, at in placed_by(scene.placements, FINELY).items()}
    except Misfit:
        return known


def _guide(slide: Slide | Balance, points: dict[str, tuple[Fraction, Fraction]]) -> Place:
    written: Any = slide.direction if slide.written is None else vector(slide.written, points.__getitem__, FINELY)[:2]
    x, y = exactly(written)
    return _unit(_decimal(x), _decimal(y))


def _unit(x: Decimal, y: Decimal) -> Place:
    length = (x * x + y * y).sqrt()
    return x / length, y / length


def _decimal(number: Fraction) -> Decimal:
    return Decimal(number.numerator) / number.denominator


def _circular(degrees: Fraction) -> tuple[Fraction, Fraction]:
    """Cosine and sine by their series, of an angle within an eighth of a turn."""
    angle, power, order, sums = int(abs(degrees) * _pi() / 180 * _ONE), _ONE, 0, [0, 0]
    while power:
        sums[order % 2] += -power if order % 4 > 1 else power
        order += 1
        power = power * angle // _ONE // order
    return Fraction(sums[0], _ONE), Fraction(sums[1] if degrees > 0 else -sums[1], _ONE)


@cache
def _pi() -> Fraction:
    """Machin's formula."""
    def arctan(inverse: int) -> int:
        term, total, k = _ONE // inverse, 0, 1
        while term:
            total += term // k if k % 4 == 1 else -(term // k)
            term, k = term // (inverse * inverse), k + 2
        return total

    return Fraction(16 * arctan(5) - 4 * arctan(239), _ONE)


FINELY = Reckoning(partial(root, bits=_BITS), partial(heading, circular=_circular))
