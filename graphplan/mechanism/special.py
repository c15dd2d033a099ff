"""Special geometry: mechanisms that move although the count of freedoms says that they cannot.

The count holds for points in general position. Where lengths and directions are special (a third crank parallel to the
two of a parallelogram), some conditions of the pairs only repeat what the others say. They are found by the rank of all
conditions in the pose as it is written. Rank alone tells velocities; whether the links move or can but shake is told by
higher derivatives: the motion is continued as a power series, until a condition that repeats the others contradicts.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from decimal import Decimal, localcontext
from random import Random
from typing import NamedTuple

from graphplan.mechanism.echelon import NOTHING, Echelon
from graphplan.mechanism.equations import Equation, System, Unknown, ends
from graphplan.mechanism.fine import DIGITS, fine_pose
from graphplan.mechanism.model import FRAME, Condition, Scene
from graphplan.mechanism.order import Key, by_name

ORDER = 4
"""How far the motion is continued: velocities, accelerations, and twice more for links that can all but move."""


class Special(NamedTuple):
    """What rank at the pose tells of a mechanism: its degrees of freedom, and the links that have a velocity.

    `moves` says whether these go beyond velocities. `redundant` are conditions without which the others say as much;
    `repeating` are all that follow from others of them, so that statics cannot tell their forces.
    """

    freedoms: int
    links: tuple[str, ...]
    moves: bool
    redundant: tuple[Condition, ...]
    repeating: tuple[Condition, ...]


def special(scene: Scene) -> Special:
    """The mechanism in its pose, its drives and given motions apart."""
    with localcontext(prec=DIGITS):
        system = System(replace(scene, motions={}, redundant=()), pose=fine_pose(scene))
        pairs, found = sorted(system.pairs, key=_Order(scene)), Echelon[Unknown]()
        redundant = tuple(equation.condition for equation in pairs if not found.add(equation.terms))
        repeating = tuple(pairs[i].condition for i in sorted(found.repeated()))
        freedoms = len(system.unknowns) - found.rank
        course = _Course(system)
        moves = _continues(course, found, pairs, system.unknowns)
        links = tuple(sorted(filter(course.starts, scene.moving), key=by_name))
        return Special(freedoms, links, moves, redundant, repeating)


class _Order:
    """The order in which conditions are taken in: of those that repeat each other the last is called redundant.

    Driven links come first, joints before slides, then links with many pairs; of one link its pairs with the frame.
    Nothing depends on the order in which the scene is written.
    """

    def __init__(self, scene: Scene):
        self._driven = {link for drive in scene.drives for link in ends(drive)} - {FRAME}
        self._fixed = {FRAME, *scene.links.get(FRAME, ())}
        self._pairs = {link: sum(point in scene.joints for point in points) for link, points in scene.links.items()}
        for slide in scene.slides:
            for link in (slide.link, slide.along):
                self._pairs[link] += 1

    def __call__(self, equation: Equation) -> tuple[bool, bool, int, Key, bool, Key, str]:
        link, on, way = equation.condition
        return (link not in self._driven, way in ("across", "turn"), -self._pairs[link], by_name(link),
                on not in self._fixed, by_name(on), way)


def _continues(course: _Course, found: Echelon[Unknown], pairs: Sequence[Equation],
               unknowns: Iterable[Unknown]) -> bool:
    """Whether the motion can be continued beyond its velocities, what is free going any way it likes."""
    chance = Random(1909)
    for _ in range(ORDER):
        course.lengthen()
        any_way = {unknown: Decimal(chance.randrange(-999, 999)) / 1000 for unknown in unknowns}
        values = found.solve([-course.excess(equation.condition) for equation in pairs], any_way)
        if values is None:
            return False
        course.settle(values)
    return True


class _Course:
    """How the links move from the pose, as power series in time: their points at the origin, and the sines and cosines
    of their turns. The coefficients of the order that is sought are zero until they are settled."""

    def __init__(self, system: System):
        names = (*system.scene.moving, FRAME)
        self._pose, self._at = system.pose, {(s.link, s.along): s.at for s in system.scene.slides}
        self._series = {(link, way): [Decimal(0)] for link in names for way in ("x", "y", "turn")}
        self._cosines = {link: [Decimal(1)] for link in names}

    def lengthen(self) -> None:
        """Go on to the next order; a cosine follows from the sine of lower orders."""
        for link, cosine in self._cosines.items():
            sine = self._series[link, "turn"]
            squares = sum((a * b for s in (cosine, sine) for a, b in zip(s[1:], s[:0:-1], strict=True)), Decimal(0))
            cosine.append(-squares / 2)
        for series in self._series.values():
            series.append(Decimal(0))

    def settle(self, values: dict[Unknown, Decimal]) -> None:
        """Enter the coefficients of this order."""
        for ((sort, name), way), value in values.items():
            if sort == "link":
                self._series[name, way][-1] = value

    def starts(self, link: str) -> bool:
        """Whether a link has a velocity."""
        return any(abs(self._series[link, way][1]) > NOTHING for way in ("x", "y", "turn"))

    def excess(self, condition: Condition) -> Decimal:
        """What the lower orders leave over in a condition at this order."""
        link, on, way = condition
        if way == "turn":
            return _product(self._series[link, way], self._cosines[on]) - _product(
                self._cosines[link], self._series[on, way])
        if way in ("across", "along"):
            return self._slip(link, on, way)
        assert self._pose
        (x, y), (ax, ay) = self._pose.points[on], self._pose.axes[link]
        return self._cosines[link][-1] * (ax * x + ay * y if way == "x" else ax * y - ay * x)

    def _slip(self, link: str, on: str, way: str) -> Decimal:
        """The sliding point on one link relative to the other, its component along or across the guide."""
        assert self._pose
        gx, gy = self._pose.guides[link, on]
        gx, gy = (gx, gy) if way == "along" else (-gy, gx)
        apart = [[a - b for a, b in zip(one, other, strict=True)]
                 for one, other in zip(self._place(link, on, link), self._place(link, on, on), strict=True)]
        cosine, sine = self._cosines[on], self._series[on, "turn"]
        ray = ([c * gx - s * gy for c, s in zip(cosine, sine, strict=True)],
               [s * gx + c * gy for c, s in zip(cosine, sine, strict=True)])
        return _product(ray[0], apart[0]) + _product(ray[1], apart[1])

    def _place(self, link: str, on: str, carrier: str) -> tuple[list[Decimal], list[Decimal]]:
        """Where a link carries the point of a slide."""
        assert self._pose
        px, py = self._pose.points[self._at[link, on]]
        x, y, sine = (self._series[carrier, way] for way in ("x", "y", "turn"))
        turn = list(zip(self._cosines[carrier], sine, strict=True))
        return ([a + c * px - s * py for a, (c, s) in zip(x, turn, strict=True)],
                [b + s * px + c * py for b, (c, s) in zip(y, turn, strict=True)])


def _product(one: Sequence[Decimal], other: Sequence[Decimal]) -> Decimal:
    """The coefficient of the highest order in the product of two series."""
    return sum((a * b for a, b in zip(one, reversed(other), strict=True)), Decimal(0))
