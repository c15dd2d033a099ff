"""Equations: which freedoms of links and joints a mechanism has, what binds them, and where geometry makes them depend.

Made from what the pairs state. Each moving link has three freedoms (the velocity of its point at the origin, and its
turning), each revolute joint of moving links two, so that a joint of many links favours none of them. Where a
coefficient needs coordinates, chance gives them: what holds for points in general position is what the graph says.

In which order motion passes, and what must be solved together: each equation is given one freedom to determine (a
matching); a thing then depends on all others in the equations of its freedoms; things that depend on each other in a
ring are solved together. Nothing here recurses: chains are long.

The equations are eliminated exactly, with whole numbers or residues of a prime and nothing rounded. Rows are kept as
primitive integers, so that no fraction is reduced before the last division. The shortest row is always used next, on
its rarest column: a mechanism's system then hardly fills in, and a chain's costs little more than reading it.

The count holds for points in general position. Where lengths and directions are special (a third crank parallel to the
two of a parallelogram), some conditions of the pairs only repeat what the others say. They are found by the rank of all
conditions in the pose as it is written. Rank alone tells velocities; whether the links move or can but shake is told by
higher derivatives: the motion is continued as a power series, until a condition that repeats the others contradicts.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from decimal import Decimal, localcontext
from fractions import Fraction
from functools import cache, cached_property, partial
from heapq import heapify, heappop, heappush
from random import Random
from typing import Any, NamedTuple, TypeVar

from graphplan.mechanism.fields import Misfit, vector
from graphplan.mechanism.model import FRAME, Balance, Condition, Scene, Slide
from graphplan.mechanism.numbers import Number, Reckoning, exactly, heading, is_exact, root
from graphplan.mechanism.order import Key, by_name
from graphplan.mechanism.pairs.drives import DrivenPoint
from graphplan.mechanism.pairs.pair import KinematicPair, LinkAttitude, Statement
from graphplan.mechanism.pairs.revolute import Revolute
from graphplan.mechanism.placements import placed_by
from graphplan.mechanism.tolerances import SERIES_TOL

PRIME = 2**61 - 1
"""Residues of this prime are exact, of one size, and a chance zero among them is all but impossible."""


class Elimination:
    """A system brought to echelon form once, to be solved for any right-hand side.

    `rows` hold ints or fractions by column; where a `prime` is given, ints that count modulo the prime. `pivots` are
    (column, row) in the order of elimination, `dependent` the rows that vanished.
    """

    def __init__(self, rows: Sequence[Mapping[int, Number]], width: int, prime: int = 0):
        self.width, self._prime = width, prime
        self._given: list[dict[int, Any]] = [
            {j: value % prime if prime else Fraction(value) for j, value in row.items()} for row in rows]
        self._scales = [math.lcm(*(value.denominator for value in row.values())) for row in self._given]
        scaled = zip(self._given, self._scales, strict=True)
        self._rows = [{j: int(value * scale) for j, value in row.items() if value} for row, scale in scaled]
        self.pivots: list[tuple[int, int]] = []
        self.dependent: list[int] = []
        self._operations: list[tuple[int, int, int, int, int]] = []
        self._eliminate()

    def _eliminate(self) -> None:
        """Take the shortest row left, and clear its rarest column from the others, until no row is left."""
        users: list[set[int]] = [set() for _ in range(self.width)]
        for i, row in enumerate(self._rows):
            for j in row:
                users[j].add(i)
        queue, remaining = [(len(row), i) for i, row in enumerate(self._rows)], set(range(len(self._rows)))
        heapify(queue)
        while queue:
            length, source = heappop(queue)
            row = self._rows[source]
            if source not in remaining or length != len(row):  # spent, or its length has changed since it was queued
                continue
            remaining.remove(source)
            if not row:
                self.dependent.append(source)
                continue
            for j in row:
                users[j].remove(source)
            column = min(row, key=lambda j: (len(users[j]), j))
            self.pivots.append((column, source))
            for target in sorted(users[column]):
                before = self._rows[target].keys()
                self._clear(target, source, column)
                for j in before ^ self._rows[target].keys():
                    users[j] ^= {target}
                heappush(queue, (len(self._rows[target]), target))

    def _clear(self, target: int, source: int, column: int) -> None:
        """Clear `column` from the row `target` with the row `source`, and note how:

        the row becomes (keep * target - take * source) / content.
        """
        row, pivot = self._rows[target], self._rows[source]
        common = math.gcd(pivot[column], row[column])
        keep, take = pivot[column] // common, row[column] // common
        mixed = {j: keep * row.get(j, 0) - take * pivot.get(j, 0) for j in row.keys() | pivot.keys()}
        if self._prime:
            mixed = {j: value % self._prime for j, value in mixed.items()}
        content = math.gcd(*mixed.values()) or 1
        self._rows[target] = {j: value // content for j, value in sorted(mixed.items()) if value}
        self._operations.append((target, keep, take, source, content))

    def solve(self, right: Sequence[Number]) -> list[Fraction] | None:
        """The solution (zero in free columns), or None where the right-hand side contradicts the rows."""
        sides = [Fraction(value) * scale for value, scale in zip(right, self._scales, strict=True)]
        for target, keep, take, source, content in self._operations:
            sides[target] = (keep * sides[target] - take * sides[source]) / content
        return None if any(sides[i] for i in self.dependent) else self._substitute(sides, {})

    def _substitute(self, sides: Sequence[Number], chosen: Mapping[int, int]) -> list[Any]:
        """Back substitution from chosen values of the free columns."""
        values: list[Any] = [chosen.get(j, 0) for j in range(self.width)]
        for column, i in reversed(self.pivots):
            row, prime = self._rows[i], self._prime
            remainder = sides[i] - sum(v * values[j] for j, v in row.items() if j != column and values[j])
            values[column] = remainder * pow(row[column], -1,
                                             prime) % prime if prime else Fraction(remainder) / row[column]
        return values

    def _null_vector(self, chosen: Mapping[int, int]) -> list[Any]:
        """Solve the homogeneous system for chosen values of the free columns."""
        return self._substitute([0] * len(self._rows), chosen)

    @property
    def _unbound(self) -> list[int]:
        """The columns that no row was solved for."""
        return sorted(set(range(self.width)).difference(column for column, _ in self.pivots))

    @property
    def free(self) -> frozenset[int]:
        """The columns that the system leaves undetermined."""
        return frozenset(j for j, value in enumerate(self.random_motion) if value)

    @property
    def random_motion(self) -> list[Any]:
        """Return a random solution of the homogeneous system: every unbound freedom gets a random value."""
        chance = Random(1974)
        return self._null_vector({j: chance.randrange(1, PRIME) for j in self._unbound})

    def conflict(self, right: Sequence[Number]) -> frozenset[int]:
        """The rows that contradict each other with this right-hand side."""
        proofs = Elimination(transpose(self._given, self.width), len(self._given))
        null_vectors = (proofs._null_vector({j: 1}) for j in proofs._unbound)
        against = (y for y in null_vectors if sum(a * Fraction(b) for a, b in zip(y, right, strict=True)))
        return frozenset(i for y in against for i, value in enumerate(y) if value)


def transpose(rows: Sequence[Mapping[int, Number]], width: int) -> list[dict[int, Number]]:
    """The columns of a system as rows."""
    columns: list[dict[int, Number]] = [{} for _ in range(width)]
    for i, row in enumerate(rows):
        for j, value in row.items():
            columns[j][i] = value
    return columns


PIN = ""
"""The pin of a joint, apart from all its links."""

Thing = tuple[str, str]
"""What moves: ("link", its name) or ("joint", its point)."""

Unknown = tuple[Thing, str]
"""A freedom of a link or joint: along x, along y, or its rotation."""

WAYS = ("x", "y", "turn")

Node = TypeVar("Node", bound=Hashable)


class FreedomEquation(NamedTuple):
    """One condition on the freedoms: its terms, whole numbers that stand for residues or decimals of a pose, and the
    statement that it is."""

    terms: dict[Unknown, Any]
    fact: Statement


@dataclass(frozen=True)
class System:
    """All freedoms of a scene's moving links and all equations, the scene's redundant conditions left out.

    With `balanced`, each balance stands instead of a drive: it holds the motion on which it does work. Without
    `axes` points and guides are in general position; with them the scene is taken in its pose, and a link's joints are
    held along the link's axis (x) and across it (y).
    """

    scene: Scene
    balanced: bool = False
    axes: Mapping[str, tuple[Decimal, Decimal]] | None = None

    @cached_property
    def posed_scene(self) -> Scene:
        """The scene in the numbers of the coefficients."""
        if self.axes is not None:
            return self.scene
        chance = Random(1939)

        def any_way(_: object = None) -> tuple[int, int]:
            return chance.randrange(1, PRIME), chance.randrange(1, PRIME)

        return self.scene.with_pose({point: any_way() for point in self.scene.points}, any_way, lambda _: any_way()[0])

    @cached_property
    def given_points(self) -> frozenset[str]:
        """The points whose motion is given beforehand: those of the frame, and the given motions."""
        return frozenset(self.scene.links.get(FRAME, ())) | frozenset(self.scene.motions)

    @property
    def unknowns(self) -> tuple[Unknown, ...]:
        """All freedoms, in the scene's order."""
        links = [(("link", k), axis) for k in self.scene.moving for axis in WAYS]
        joints = [(("joint", p), axis) for p in self.scene.joints if p not in self.given_points for axis in ("x", "y")]
        return tuple(links + joints)

    @cached_property
    def _free(self) -> frozenset[Unknown]:
        return frozenset(self.unknowns)

    @cached_property
    def equations(self) -> tuple[FreedomEquation, ...]:
        """All equations: of the pairs, of the drives or the balances."""
        loads, scene = self.posed_scene.loads, self.posed_scene
        drives = (loads.balances if loads else ()) if self.balanced else scene.drives
        return (*self.pairs, *self._equations_of(drives))

    @property
    def pairs(self) -> tuple[FreedomEquation, ...]:
        """The equations of the pairs without a drive, and of the points whose motion is given: link by link."""
        scene, dropped = self.posed_scene, frozenset(self.scene.redundant)
        points = [pair for pair in scene.pairs if isinstance(pair, DrivenPoint) and pair.at not in scene.joints]
        pins = self._equations_of([*map(self._with_pin, scene.revolutes), *points])
        other_pairs = self._equations_of(pair for pair in scene.binding if not isinstance(pair, Revolute))
        place = {(link, point): i for i, (link, point) in enumerate(
            (link, point) for link in scene.moving for point in scene.links[link])}
        linked = sorted(pins, key=lambda equation: place[equation.fact.link, equation.fact.at])
        return tuple(equation for equation in (*linked, *other_pairs) if equation.fact.condition not in dropped)

    def _root(self, square: Any) -> Any:
        """The root of a number; in general position the number itself will do."""
        return square.sqrt() if self.axes is not None else square

    def _with_pin(self, joint: Revolute) -> Revolute:
        """A joint with a pin of its own, or where its motion is given one of the frame."""
        links = [link for link in joint.links if link != FRAME]
        pin = FRAME if joint.at in self.given_points else PIN
        return replace(joint, pinned=(pin, *links), axes=self.axes or {})

    def _equations_of(self, pairs: Iterable[KinematicPair | Balance]) -> Iterator[FreedomEquation]:
        """Yield the equations that pairs state."""
        for pair in pairs:
            yield from (FreedomEquation(self.terms(fact), fact) for fact in pair.states(self.posed_scene))

    def terms(self, fact: Statement) -> dict[Unknown, Any]:
        """The coefficient of each freedom in a statement."""
        terms: dict[Unknown, Any] = {}
        arms: Any = [self.posed_scene.points[point] if point else (0, 0) for _, point in fact.ends]
        for (body, point), weights in zip(fact.ends, fact.weights(arms, self._root), strict=True):
            mover = ("link", body) if body != PIN else ("joint", point)
            terms |= {(mover, axis): weight for axis, weight in zip(WAYS, weights, strict=True)
                      if weight and (mover, axis) in self._free}
        return terms


def stages(system: System) -> list[tuple[Thing, ...]]:
    """The links and joints that are solved together, in the order of their dependence."""
    owner = matching([tuple(equation.terms) for equation in system.equations])
    depends: dict[Thing, dict[Thing, None]] = {thing: {} for thing, _ in system.unknowns}
    for (thing, _), i in owner.items():
        depends[thing].update((needed, None) for needed, _ in system.equations[i].terms if needed != thing)
    return list(rings({thing: tuple(needed) for thing, needed in depends.items()}))


def matching(options: Sequence[Sequence[Node]]) -> dict[Node, int]:
    """For as many equations as possible an unknown of their own: the unknowns, each with its equation."""
    owner: dict[Node, int] = {}
    waiting = list(range(len(options)))
    while waiting:  # in one round nothing is visited twice, so each round costs one reading of the equations
        visited: set[Node] = set()
        unmatched = [i for i in waiting if not _augment(i, options, owner, visited)]
        if len(unmatched) == len(waiting):
            break
        waiting = unmatched
    return owner


def _augment(start: int, options: Sequence[Sequence[Node]], owner: dict[Node, int], seen: set[Node]) -> bool:
    """Find equation `start` an unknown, moving others to free ones along a path of exchanges."""
    path: list[tuple[int, Iterator[Node]]] = [(start, iter(options[start]))]
    taken: list[Node] = []
    while path:
        unknown = next((u for u in path[-1][1] if u not in seen), None)
        if unknown is None:
            path.pop()
            del taken[-1:]
            continue
        seen.add(unknown)
        taken.append(unknown)
        if unknown not in owner:
            owner.update((u, i) for (i, _), u in zip(path, taken, strict=True))
            return True
        path.append((owner[unknown], iter(options[owner[unknown]])))
    return False


def rings(depends: Mapping[Node, Sequence[Node]]) -> Iterator[tuple[Node, ...]]:
    """The strongly connected components (Tarjan 1972), each after all that it depends on."""
    index: dict[Node, int] = {}
    low: dict[Node, int] = {}
    stack: list[Node] = []
    done: set[Node] = set()
    for first in depends:
        path = [] if first in index else [(first, iter(depends[first]))]
        while path:
            node, neighbours = path[-1]
            if node not in index:
                index[node] = low[node] = len(index)
                stack.append(node)
            neighbour = next((o for o in neighbours if o not in done), None)
            if neighbour is None:
                path.pop()
                if path:
                    low[path[-1][0]] = min(low[path[-1][0]], low[node])
                if low[node] == index[node]:
                    ring = [stack.pop()]
                    while ring[-1] != node:
                        ring.append(stack.pop())
                    done.update(ring)
                    yield tuple(ring[::-1])
            elif neighbour in index:
                low[node] = min(low[node], index[neighbour])
            else:
                path.append((neighbour, iter(depends[neighbour])))


SERIES_ORDER = 4
"""How far the motion is continued: velocities, accelerations, and twice more for links that can all but move."""


class Special(NamedTuple):
    """The result of a rank test at the pose: degrees of freedom, and the links that have a velocity.

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
    """The motion of links and pins from the pose, as power series in time."""

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
        """The remainder of a statement at this order that the lower orders cause."""
        pose = {body: self._attitudes[("link", body) if body != PIN else ("joint", fact.at)]
                for body in (fact.link, fact.on, FRAME)}
        link_point, on_point = (self._scene.points[point] if point else None for _, point in fact.ends)
        excess: Decimal = fact.residual(pose, (link_point, on_point)).terms[-1]
        return excess


class _Row(NamedTuple):
    """A reduced equation: its remaining terms, its pivot (None if no term remains), and the multiple of each earlier
    row that was subtracted."""

    terms: dict[Unknown, Decimal]
    pivot: Unknown | None
    taken: dict[int, Decimal]


class _Echelon:
    """Equations brought to echelon form in the order in which they come, to be solved for any right-hand side."""

    def __init__(self) -> None:
        self._rows: list[_Row] = []

    @property
    def rank(self) -> int:
        """The number of linearly independent equations."""
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
        """Indices of the equations whose weighted sum is zero, the last of them included."""
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


POSE_DIGITS = 100
_BITS = 360
_ONE = 1 << _BITS

Place = tuple[Decimal, Decimal]


def fine_pose(scene: Scene) -> tuple[Scene, bool, dict[str, Place]]:
    """The arguments of `System` for the equations in the scene's pose: decimals, in reaches from the first point.

    They are the scene in these units, False (drives stand in it, not balances), and by link the unit vector across it.
    """
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
