"""Equations: which freedoms of links and joints a mechanism has, and what binds them.

Made from what the pairs state. Each moving link has three freedoms (the velocity of its point at the origin, and its
turning), each revolute joint of moving links two, so that a joint of many links favours none of them. Where a
coefficient needs coordinates, chance gives them: what holds for points in general position is what the graph says.

In which order motion passes, and what must be solved together: each equation is given one freedom to determine (a
matching); a thing then depends on all others in the equations of its freedoms; things that depend on each other in a
ring are solved together. Nothing here recurses: chains are long.

The equations are eliminated exactly, with whole numbers or residues of a prime and nothing rounded. Rows are kept as
primitive integers, so that no fraction is reduced before the last division. The shortest row is always used next, on
its rarest column: a mechanism's system then hardly fills in, and a chain's costs little more than reading it.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from fractions import Fraction
from functools import cached_property
from heapq import heapify, heappop, heappush
from random import Random
from typing import Any, NamedTuple, TypeVar

from graphplan.mechanism.model import FRAME, Balance, Scene
from graphplan.mechanism.numbers import Number
from graphplan.mechanism.pairs.drives import DrivenPoint
from graphplan.mechanism.pairs.pair import KinematicPair, Statement
from graphplan.mechanism.pairs.revolute import Revolute

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
        """What solves the system with nothing on the right and chosen values of the free columns."""
        return self._substitute([0] * len(self._rows), chosen)

    @cached_property
    def _unbound(self) -> list[int]:
        """The columns that no row was solved for."""
        return sorted(set(range(self.width)).difference(column for column, _ in self.pivots))

    @property
    def free(self) -> frozenset[int]:
        """The columns that the system leaves undetermined."""
        return frozenset(j for j, value in enumerate(self.random_motion) if value)

    @property
    def random_motion(self) -> list[Any]:
        """What solves the system with nothing on the right: what moves when chance moves all that no row binds."""
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

    With `balanced`, each balance stands in the place of a drive: it holds the motion on which it does work. Without
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

    @cached_property
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

    @cached_property
    def pairs(self) -> tuple[FreedomEquation, ...]:
        """The equations of the pairs that drive nothing, and of the points whose motion is given: link by link."""
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
        """What these pairs state, as equations."""
        for pair in pairs:
            yield from (FreedomEquation(self.terms(fact), fact) for fact in pair.states(self.posed_scene))

    def terms(self, fact: Statement) -> dict[Unknown, Any]:
        """How much each freedom counts in what is stated."""
        terms: dict[Unknown, Any] = {}
        arms: Any = [self.posed_scene.points[point] if point else (0, 0) for _, point in fact.ends]
        for (body, point), weights in zip(fact.ends, fact.weights(arms, self._root), strict=True):
            mover = ("link", body) if body != PIN else ("joint", point)
            terms |= {(mover, axis): weight for axis, weight in zip(WAYS, weights, strict=True)
                      if weight and (mover, axis) in self._free}
        return terms


# --- in which order motion passes ------------------------------------------------------------------------------------


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
    for root in depends:
        path = [] if root in index else [(root, iter(depends[root]))]
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
