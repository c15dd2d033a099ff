"""Groups of links that arcs alone do not place: where a joint lies once the lengths of all links of its group close.

The value is that of Newton's method from where the linkage is known to be, with the matrix of that pose: the residues
are reckoned in whatever numbers there are, so each round leaves as many digits more as the matrix has.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, Self

from graphplan.kernel.tolerances import CLOSURE_TOL

Vector = tuple[Any, Any]


class PlacedPin(NamedTuple):
    """A point of a body, by its place in the body's figure, lies in an outer joint, by its number."""

    body: int
    at: Vector
    joint: int


class Hinge(NamedTuple):
    """Points of two bodies are one."""

    body: int
    at: Vector
    other: int
    there: Vector


class PlacedGuide(NamedTuple):
    """A point of another body slides along the line of a body through a place, and the two turn alike; `there` is the
    point, and `ray` the guide's direction, in the other body's figure."""

    body: int
    at: Vector
    way: Vector
    other: int
    there: Vector
    ray: Vector


class Attitude(NamedTuple):
    """How a body lies: where its figure's origin is, and the cosine and sine of its turn."""

    x: Any
    y: Any
    cos: Any
    sin: Any

    def turn_vector(self, u: Vector) -> Vector:
        return self.cos * u[0] - self.sin * u[1], self.sin * u[0] + self.cos * u[1]

    def place_point(self, p: Vector) -> Vector:
        u, v = self.turn_vector(p)
        return self.x + u, self.y + v


class Closure(str):
    """The pairs of a group of bodies, and the pose in which it is known to close, named by its links.

    `joints` are by name the body of a joint and its place there.
    """

    pairs: tuple[PlacedPin | Hinge | PlacedGuide, ...]
    start: tuple[Attitude, ...]
    joints: dict[str, tuple[int, Vector]]
    _inverse: list[list[float]]

    def __new__(cls, links: str, pairs: Sequence[PlacedPin | Hinge | PlacedGuide], start: Sequence[Attitude],
                joints: dict[str, tuple[int, Vector]]) -> Self:
        self = super().__new__(cls, links)
        self.pairs, self.start, self.joints = tuple(pairs), tuple(start), joints
        self._inverse = []
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return Closure, (str(self), self.pairs, self.start, self.joints)

    @property
    def square(self) -> bool:
        """Whether its pairs state as much as its bodies have ways to move."""
        return 2 * len(self.pairs) == 3 * len(self.start)

    @property
    def inverse(self) -> list[list[float]]:
        """What makes corrections (x, y and turn of each body) of residues, as the pose is known; raises
        ZeroDivisionError where that is singular."""
        if not self._inverse:
            self._inverse = inverse_matrix([row for pair in self.pairs for row in _rows(pair, self.start)])
        return self._inverse

    def residues(self, pose: Sequence[Attitude], joints: Sequence[Vector], lift: Any) -> list[Any]:
        """What the pairs leave open in a pose."""
        return [residue for pair in self.pairs for residue in _residuals(pair, pose, joints, lift)]


def _residuals(pair: PlacedPin | Hinge | PlacedGuide, pose: Sequence[Attitude], joints: Sequence[Vector],
               lift: Any) -> Iterator[Any]:
    def lift_vector(u: Vector) -> Vector:
        return lift(u[0]), lift(u[1])

    x, y = pose[pair.body].place_point(lift_vector(pair.at))
    if isinstance(pair, PlacedPin):
        u, v = joints[pair.joint]
        yield from (x - u, y - v)
        return
    u, v = pose[pair.other].place_point(lift_vector(pair.there))
    if isinstance(pair, Hinge):
        yield from (x - u, y - v)
        return
    a, b = pose[pair.body].turn_vector(lift_vector(pair.way))
    c, d = pose[pair.other].turn_vector(lift_vector(pair.ray))
    yield a * (v - y) - b * (u - x)
    yield a * d - b * c


def _rows(pair: PlacedPin | Hinge | PlacedGuide, pose: Sequence[Attitude]) -> Iterator[dict[int, float]]:
    """The derivatives of what a pair leaves open by x, y and turn of the bodies, in floats."""
    def plain(u: Vector) -> tuple[float, float]:
        return float(u[0]), float(u[1])

    i = 3 * pair.body
    p = pose[pair.body].turn_vector(plain(pair.at))
    rows = [{i: 1.0, i + 2: -p[1]}, {i + 1: 1.0, i + 2: p[0]}]
    if isinstance(pair, PlacedPin):
        yield from rows
        return
    j = 3 * pair.other
    q = pose[pair.other].turn_vector(plain(pair.there))
    others = [{j: 1.0, j + 2: -q[1]}, {j + 1: 1.0, j + 2: q[0]}]
    if isinstance(pair, Hinge):
        yield from ({**one, **{k: -w for k, w in two.items()}} for one, two in zip(rows, others, strict=True))
        return
    a, b = pose[pair.body].turn_vector(plain(pair.way))
    c, d = pose[pair.other].turn_vector(plain(pair.ray))
    (x, y), (u, v) = pose[pair.body].place_point(plain(pair.at)), pose[pair.other].place_point(plain(pair.there))
    across = {j: -b, j + 1: a, j + 2: a * q[0] + b * q[1], i: b, i + 1: -a}
    yield {**across, i + 2: -a * p[0] - b * p[1] - b * (v - y) - a * (u - x)}
    yield {i + 2: -b * d - a * c, j + 2: a * c + b * d}


def inverse_matrix(rows: Sequence[dict[int, float]]) -> list[list[float]]:
    """The inverse of a square matrix, its rows given sparsely; raises ZeroDivisionError where there is none."""
    n = len(rows)
    table = [[row.get(k, 0.0) for k in range(n)] + [float(k == i) for k in range(n)] for i, row in enumerate(rows)]
    for k in range(n):
        best = max(range(k, n), key=lambda i: abs(table[i][k]))
        table[k], table[best] = table[best], table[k]
        head = [value / table[k][k] for value in table[k]]
        table[k] = head
        for i in range(n):
            if i != k and table[i][k]:
                factor = table[i][k]
                table[i] = [value - factor * top for value, top in zip(table[i], head, strict=True)]
    return [row[n:] for row in table]


def close_group(d: Any, joints: Sequence[Vector], group: Closure) -> list[Attitude]:
    """The pose in which a group closes on these outer joints, near the one that is known."""
    try:
        inverse = [[d.lift(value) for value in row] for row in group.inverse]
    except ZeroDivisionError:
        nothing = d.nonzero(0 * joints[0][0], d.lift(1), "circles-miss", "the group's links are in a limit position")
        return [Attitude(nothing, nothing, nothing, nothing) for _ in group.start]
    pose = [_normalize_turn(d, Attitude(*map(d.lift, lies))) for lies in group.start]
    corrections: list[Any] = []
    for _ in range(d.rounds):
        pose = [_normalize_turn(d, Attitude(*map(d.middle, lies))) for lies in pose]
        left = group.residues(pose, joints, d.lift)
        corrections = [dot_all(row, left) for row in inverse]
        pose = [_apply_correction(lies, *corrections[3 * i:3 * i + 3]) for i, lies in enumerate(pose)]
    size = sum((abs(x) + abs(y) for x, y in joints), d.lift(0))
    last = sum((abs(one) for one in corrections), d.lift(0))
    d.sqrt(size * d.lift(CLOSURE_TOL) - last, "circles-miss", "the lengths of the group's links do not close")
    return pose


def dot_all(row: Sequence[Any], left: Sequence[Any]) -> Any:
    """The sum of the products of two rows."""
    total = row[0] * left[0]
    for one, two in zip(row[1:], left[1:], strict=True):
        total = total + one * two
    return total


def _normalize_turn(d: Any, lies: Attitude) -> Attitude:
    """A body as it is known to lie, its turn no longer and no shorter than 1 in better numbers."""
    x, y, cos, sin = lies
    length = d.sqrt(cos * cos + sin * sin, "not-rational", "the turn of a link is irrational")
    return Attitude(x, y, cos / length, sin / length)


def _apply_correction(lies: Attitude, x: Any, y: Any, turn: Any) -> Attitude:
    """A body corrected: turned back by an angle, whose half is the tangent's to third order, so nothing is stretched.
    """
    t = turn / 2
    whole = 1 + t * t
    c, s = (1 - t * t) / whole, (2 * t) / whole
    return Attitude(lies.x - x, lies.y - y, lies.cos * c + lies.sin * s, lies.sin * c - lies.cos * s)
