"""Special geometry: mechanisms that move although the count of freedoms says that they cannot.

The count holds for points in general position. Where lengths and directions are special (a third crank parallel to the
two of a parallelogram), some conditions of the pairs only repeat what the others say. They are found by the rank of all
conditions in the pose as it is written. Rank alone tells velocities; whether the links move or can but shake is told by
higher derivatives: the motion is continued as a power series, until a condition that repeats the others contradicts.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from decimal import Decimal, localcontext
from fractions import Fraction
from functools import cache, partial
from random import Random
from typing import Any, NamedTuple

from graphplan.mechanism.equations import PIN, FreedomEquation, System, Thing, Unknown
from graphplan.mechanism.model import FRAME, Balance, Condition, Scene, Slide
from graphplan.mechanism.numbers import Reckoning, exactly, heading, is_exact, root
from graphplan.mechanism.order import Key, by_name
from graphplan.mechanism.pairs.pair import LinkAttitude, Statement
from graphplan.mechanism.placements import placed_by
from graphplan.mechanism.tolerances import SERIES_TOL
from graphplan.mechanism.values import Misfit, vector

SERIES_ORDER = 4
"""How far the motion is continued: velocities, accelerations, and twice more for links that can all but move."""


class Special(NamedTuple):
    """What the rank at the pose tells of a mechanism: its degrees of freedom, and the links that have a velocity.

    `moves` says whether these go beyond velocities. `repetitions` are the conditions without which the others say as
    much, each with those that it follows from: statics cannot tell the forces of any of these.
    """

    freedoms: int
    links: tuple[str, ...]
    moves: bool
    repetitions: Mapping[Condition, tuple[Condition, ...]]


def special(scene: Scene) -> Special:
    """The mechanism in its pose, its drives and given motions apart."""
    with localcontext(prec=POSE_DIGITS):
        system = System(*fine_pose(replace(scene, motions={}, repetitions={})))
        pairs, echelon = _in_order(scene, system.pairs), _Echelon()
        redundant = [last for last, equation in enumerate(pairs) if not echelon.add(equation.terms)]
        repetitions = {pairs[last].fact.condition: tuple(
            pairs[i].fact.condition for i in sorted(echelon.rows_of_repetition(last) - {last})) for last in redundant}
        freedoms = len(system.unknowns) - echelon.rank
        course = _Course(system.posed_scene)
        moves = course.continues(echelon, pairs, system.unknowns)
        links = tuple(sorted(filter(course.starts, scene.moving), key=by_name))
        return Special(freedoms, links, moves, repetitions)


def _in_order(scene: Scene, equations: Iterable[FreedomEquation]) -> list[FreedomEquation]:
    """The order in which conditions are taken in: of those that repeat each other the last is called redundant.

    Driven links come first, joints before other pairs, links with many pairs; of one link its pairs with the frame.
    Nothing depends on the order in which the scene is written.
    """
    driven = {link for drive in scene.drives for link in drive.links} - {FRAME}
    fixed = {FRAME, *scene.links.get(FRAME, ())}
    pairs = Counter(link for pair in scene.binding for link in pair.links)

    def rank(equation: FreedomEquation) -> tuple[bool, bool, int, Key, bool, Key, str, str]:
        link, on, axis, name = equation.fact.condition
        return (link not in driven, axis not in ("x", "y"), -pairs[link], by_name(link), on not in fixed, by_name(on),
                axis, name)

    return sorted(equations, key=rank)


class _Series:
    """A power series in time, up to the order that is sought: its coefficient there is zero until it is settled."""

    def __init__(self, *coefficients: Decimal):
        self.terms = list(coefficients)

    def __add__(self, other: _Series) -> _Series:
        return _Series(*(a + b for a, b in zip(self.terms, other.terms, strict=True)))

    def __sub__(self, other: _Series) -> _Series:
        return _Series(*(a - b for a, b in zip(self.terms, other.terms, strict=True)))

    def __mul__(self, other: _Series | Decimal | int) -> _Series:
        if not isinstance(other, _Series):
            return _Series(*(a * other for a in self.terms))
        last = len(self.terms)
        return _Series(*(sum((self.terms[k] * other.terms[n - k] for k in range(n + 1)), Decimal(0))
                         for n in range(last)))

    __rmul__ = __mul__

    def __truediv__(self, other: int) -> _Series:
        return _Series(*(a / other for a in self.terms))

    def angle(self, y: _Series) -> _Series:
        """The angle of the vector (self, y), which starts along x: its rate is (x y' - y x') / (x^2 + y^2)."""
        square, last, rates = self * self + y * y, len(self.terms) - 1, list[Decimal]()
        for k in range(last):
            swept = sum(((n + 1) * (self.terms[k - n] * y.terms[n + 1] - y.terms[k - n] * self.terms[n + 1])
                         for n in range(k + 1)), Decimal(0))
            swept -= sum((square.terms[m] * rates[k - m] for m in range(1, k + 1)), Decimal(0))
            rates.append(swept / square.terms[0])
        return _Series(Decimal(0), *(rate / (k + 1) for k, rate in enumerate(rates)))


class _Course:
    """How the links and pins move from the pose, as power series in time."""

    def __init__(self, scene: Scene):
        self._scene = scene
        bodies: list[Thing] = [("link", link) for link in (*scene.moving, FRAME)]
        bodies += [("joint", point) for point in scene.joints]
        unity, nothing = Decimal(1), Decimal(0)
        self._attitudes = {body: LinkAttitude(*map(_Series, (nothing, nothing, unity, nothing))) for body in bodies}

    def continues(self, found: _Echelon, pairs: Sequence[FreedomEquation], unknowns: Iterable[Unknown]) -> bool:
        """Whether the motion can be continued beyond its velocities, what is free going any way it likes."""
        chance = Random(1909)
        for _ in range(SERIES_ORDER):
            self.lengthen()
            any_way = {unknown: Decimal(chance.randrange(-999, 999)) / 1000 for unknown in unknowns}
            values = found.solve([-self.excess(equation.fact) for equation in pairs], any_way)
            if values is None:
                return False
            for (body, axis), value in values.items():
                getattr(self._attitudes[body], "sin" if axis == "turn" else axis).terms[-1] = value
        return True

    def lengthen(self) -> None:
        """Go on to the next order; a cosine follows from the sine of lower orders."""
        for x, y, cosine, sine in self._attitudes.values():
            squares = sum((a * b for s in (cosine.terms, sine.terms)
                           for a, b in zip(s[1:], s[:0:-1], strict=True)), Decimal(0))
            cosine.terms.append(-squares / 2)
            for series in (x, y, sine):
                series.terms.append(Decimal(0))

    def starts(self, link: str) -> bool:
        """Whether a link has a velocity."""
        x, y, _, sine = self._attitudes["link", link]
        return any(abs(series.terms[1]) > SERIES_TOL for series in (x, y, sine))

    def excess(self, fact: Statement) -> Decimal:
        """What the lower orders leave over in a statement at this order."""
        pose = {body: self._attitudes[("link", body) if body != PIN else ("joint", fact.at)]
                for body in (fact.link, fact.on, FRAME)}
        link_point, on_point = (self._scene.points[point] if point else None for _, point in fact.ends)
        excess: Decimal = fact.residual(pose, (link_point, on_point)).terms[-1]
        return excess


# --- echelon form in decimals: equations are taken in one by one, those that only repeat the others found out ---------


class _Row(NamedTuple):
    """What is left of an equation, its pivot (None if nothing is left), and how often each row before it was taken."""

    terms: dict[Unknown, Decimal]
    pivot: Unknown | None
    taken: dict[int, Decimal]


class _Echelon:
    """Equations brought to echelon form in the order in which they come, to be solved for any right-hand side."""

    def __init__(self) -> None:
        self._rows: list[_Row] = []

    @property
    def rank(self) -> int:
        """How many of the equations say something that those before them do not."""
        return sum(row.pivot is not None for row in self._rows)

    def add(self, equation: Mapping[Unknown, Decimal | int]) -> bool:
        """Add one more equation; whether it is independent of those before."""
        terms, taken = {k: Decimal(c) for k, c in equation.items()}, {}
        for i, row in enumerate(self._rows):
            if row.pivot is not None and (excess := terms.get(row.pivot)):
                taken[i] = factor = excess / row.terms[row.pivot]
                for k, c in row.terms.items():
                    terms[k] = terms.get(k, 0) - factor * c
                del terms[row.pivot]
        terms = {k: c for k, c in terms.items() if abs(c) > SERIES_TOL}
        self._rows.append(_Row(terms, max(terms, key=lambda k: abs(terms[k]), default=None), taken))
        return bool(terms)

    def rows_of_repetition(self, last: int) -> set[int]:
        """The equations whose weighted sum is nothing, the last of them among them."""
        weights = {last: Decimal(1)}
        for i in range(last, -1, -1):
            for k, factor in self._rows[i].taken.items() if i in weights else ():
                weights[k] = weights.get(k, Decimal(0)) - weights[i] * factor
        return {i for i, weight in weights.items() if abs(weight) > SERIES_TOL}

    def solve(self, right: Sequence[Decimal], chosen: Mapping[Unknown, Decimal]) -> dict[Unknown, Decimal] | None:
        """The solution with chosen values of what is free; None where the right-hand side contradicts the equations."""
        sides: list[Decimal] = []
        for row, side in zip(self._rows, right, strict=True):
            sides.append(side - sum((f * sides[i] for i, f in row.taken.items()), Decimal(0)))
        least = SERIES_TOL * max(Decimal(1), *map(abs, right))  # what is free goes about a reach
        if any(row.pivot is None and abs(side) > least for row, side in zip(self._rows, sides, strict=True)):
            return None
        values = dict(chosen)
        for row, side in zip(reversed(self._rows), reversed(sides), strict=True):
            if row.pivot is not None:
                settled = sum((c * values[k] for k, c in row.terms.items() if k != row.pivot), Decimal(0))
                values[row.pivot] = (side - settled) / row.terms[row.pivot]
        return values


# --- the pose to a hundred digits: fine enough to tell special geometry from what only comes close to it --------------

POSE_DIGITS = 100
_BITS = 360
_ONE = 1 << _BITS

Place = tuple[Decimal, Decimal]


def fine_pose(scene: Scene) -> tuple[Scene, bool, dict[str, Place]]:
    """A scene in its pose as it is written, unbalanced: points in reaches from the first one, directions of length 1;
    and in which direction each moving link's joints are held."""
    points = _points(scene)
    with localcontext(prec=POSE_DIGITS):
        first, *_ = points.values()
        arms = {name: (_decimal(x - first[0]), _decimal(y - first[1])) for name, (x, y) in points.items()}
        reach = max(max(map(abs, arm)) for arm in arms.values()) or Decimal(1)
        places = {name: (x / reach, y / reach) for name, (x, y) in arms.items()}
        axes = {link: _unit(*map(Decimal, scene.across_link(link, places))) for link in scene.moving}
        return scene.with_pose(places, lambda one: _guide(one, points),
                               lambda radius: _decimal(Fraction(radius)) / reach
                           ), False, axes


def _points(scene: Scene) -> dict[str, tuple[Fraction, Fraction]]:
    """Every point where its placement puts it; where arcs touch to a float's digits only, as the float that it is."""
    places = {name: exactly(at) for name, at in scene.points.items()}
    if is_exact(*scene.points.values()):
        return places
    try:
        return places | {name: exactly(at) for name, at in placed_by(scene.placements, FINELY).items()}
    except Misfit:
        return places


def _guide(slide: Slide | Balance, points: dict[str, tuple[Fraction, Fraction]]) -> Place:
    written: Any = slide.direction
    if slide.written is not None:
        with suppress(Misfit):  # such a direction has a fault of its own, and stands for any
            written = vector(slide.written, points.__getitem__, FINELY)[:2]
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
