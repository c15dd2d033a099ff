"""The closure of one group in any numbers: how its links lie, what its pairs leave open, and Newton's step.

The unknowns are angles of links and displacements of slides: seen from the links placed before, each link's base is a
point of another link, or lies off it along a guide (a spanning tree of the group's pairs). What pairs are left over
close the loops, in as many equations as there are unknowns.

All is straight-line arithmetic: floats, arrays and the symbols of a tape go through the same lines.

The step is a sparse QR factorisation by plane rotations (Givens 1958): stable in any order, so that the order is that
of the structure alone, and no number is asked anything on the way. The first rotations turn each loop's two equations
along a link and across it, so that they hold for any pose.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, NamedTuple

from graphplan.cycle.tolerances import TINY_PIVOT
from graphplan.kernel.tape.machine import Machine
from graphplan.kernel.tape.record import Blocks, Symbol, Symbols, Tape, function
from graphplan.mechanism.numbers import dot, minus, plus, quarter_turn, times

RESIDUE, TRAVEL = -1, -2
"""Columns of an equation besides those of the unknowns: what it leaves open, and its change with the travel."""

Vector = tuple[Any, Any]

Moves = dict[int, Any]
"""The derivatives of a vector or a number, by column."""

Row = dict[int, Any]


class Spin(NamedTuple):
    """A link turns as the link `on` does and a drive has it; without `on` its angle is unknown."""

    link: int
    on: int | None
    drive: int | None = None


class Seat(NamedTuple):
    """A link's base is the point of the link `on` at an arm.

    Or it lies off it along `way`, fixed to the link `guide`, by a drive or an unknown displacement. Without `on` both
    its coordinates are unknown. Arms and ways are told by their places among the arms; an arm of no length is none.
    """

    link: int
    on: int | None = None
    arm: int | None = None
    guide: int | None = None
    direction: int | None = None
    drive: int | None = None


class Closing(NamedTuple):
    """The arms of two links end in one point, or `far` from each other.

    With a guide, only the component of the gap along a way that is fixed to it is what a drive has it, or nothing; or
    as the link has rolled there, which turns on the other with a `lever`. Both numbers are told by their places among
    the arms.
    """

    link: int
    arm: int | None
    on: int
    on_arm: int | None
    guide: int | None = None
    direction: int | None = None
    drive: int | None = None
    far: int | None = None
    lever: int | None = None


class Mesh(NamedTuple):
    """Two links that turn on a third so that the sum of the angles, weighted by `factors` (a pair among the arms), is
    zero."""

    first: int
    second: int
    carrier: int
    factors: int


class GroupLayout(NamedTuple):
    """The structure of a group, which says all but its numbers; links are told by their places, 0 is the frame.

    `known` links are placed before. The unknowns are the angles in the order of `spins`, then what the seats ask for.
    `turnings` are spins that close a loop. Where the angles are `counted`, links know how far they have turned in all.
    """

    carriers: int
    arms: int
    drives: tuple[bool, ...]
    spins: tuple[Spin, ...]
    seats: tuple[Seat, ...]
    closings: tuple[Closing, ...]
    turnings: tuple[Spin, ...]
    meshes: tuple[Mesh, ...] = ()
    counted: bool = False

    @property
    def angles(self) -> int:
        """Number of unknown angles."""
        return sum(spin.on is None for spin in self.spins)

    @property
    def unknowns(self) -> int:
        """Number of unknowns."""
        return self.angles + sum(2 if seat.on is None else seat.direction is not None and seat.drive is None
                                 for seat in self.seats)


class DriveState(NamedTuple):
    """State of a drive: the cosine and sine of its angle, and the angle itself where angles are counted, or its length;
    and its rate by the travel, if asked for."""

    at: Any
    rate: Any


@dataclass
class LinkPose:
    """A link in a pose: its base and its turn, a unit vector, or None if it does not turn.

    `moves` and `spin` are their derivatives, the turn's as angles. `angle` is how far it has turned in all, if counted.
    """

    base: Vector = (0.0, 0.0)
    turn: Vector | None = None
    moves: Moves = field(default_factory=dict)
    spin: Moves = field(default_factory=dict)
    angle: Any = 0.0

    def point(self, arm: Vector | None) -> tuple[Vector, Moves]:
        """The link's point at an arm, and how it moves."""
        if arm is None:
            return self.base, self.moves
        lever = rotate(self.turn, arm)
        return plus(self.base, lever), _add_rates(self.moves,
                                                  _lever_rates(self.spin, lever)) if self.spin else self.moves


def rotate(turn: Any, vector: Any) -> Any:
    """A vector turned as a link is."""
    return vector if turn is None else (turn[0] * vector[0] - turn[1] * vector[1],
                                        turn[1] * vector[0] + turn[0] * vector[1])


def pose_links(layout: GroupLayout, known: Sequence[LinkPose], arms: Sequence[Vector], drives: Sequence[DriveState],
               state: Sequence[Any], moving: bool = True) -> list[LinkPose]:
    """All links, those of the group after the known ones; in `state` an unknown angle is its cosine and sine, and where
    angles are counted the angle itself.

    If they are not `moving`, derivatives by angles are left out.
    """
    links = [*known, *(LinkPose() for _ in layout.spins)]
    unknown = iter(enumerate(state))
    for spin in layout.spins:
        link = links[spin.link]
        if spin.on is None:
            i, (cos, sin, *angle) = next(unknown)
            link.turn, link.spin = (cos, sin), {i: None} if moving else {}
            link.angle = angle[0] if angle else 0.0
            continue
        on = links[spin.on]
        link.turn, link.spin, link.angle = on.turn, on.spin, on.angle
        if spin.drive is not None:
            (cos, sin, *angle), rate = drives[spin.drive]
            link.turn, link.spin = rotate(on.turn, (cos, sin)), _add_rates(on.spin, _drive_rates(rate))
            link.angle = on.angle + angle[0] if angle else on.angle
    for seat in layout.seats:
        _place_on_seat(links, seat, arms, drives, unknown)
    return links


def _place_on_seat(links: Sequence[LinkPose], seat: Seat, arms: Sequence[Vector], drives: Sequence[DriveState],
                   unknown: Iterator[tuple[int, Any]]) -> None:
    """Put a link on another."""
    link = links[seat.link]
    if seat.on is None:
        (i, x), (j, y) = next(unknown), next(unknown)
        link.base, link.moves = plus(_arm(arms, seat.arm) or (0.0, 0.0), (x, y)), {i: (1.0, 0.0), j: (0.0, 1.0)}
        return
    link.base, link.moves = links[seat.on].point(_arm(arms, seat.arm))
    if seat.direction is None or seat.guide is None:
        return
    guide = links[seat.guide]
    ray = rotate(guide.turn, arms[seat.direction])
    if seat.drive is None:
        i, far = next(unknown)
        moves = {i: ray}
    else:
        far, rate = drives[seat.drive]
        moves = {k: times(w, ray) for k, w in _drive_rates(rate).items()}
    off = times(far, ray)
    link.base = plus(link.base, off)
    link.moves = _add_rates(_add_rates(link.moves, _lever_rates(guide.spin, off)), moves)


def _lever_rates(spin: Moves, lever: Vector) -> Moves:
    """Rates of the end of a turning lever."""
    across = quarter_turn(lever) if spin else lever
    return {k: across if w is None else times(w, across) for k, w in spin.items()}


def _drive_rates(rate: Any) -> Moves:
    """Derivative of a driven quantity; empty if no rates are asked for."""
    return {} if rate is None else {TRAVEL: rate}


def _arm(arms: Sequence[Vector], place: int | None) -> Vector | None:
    return None if place is None else arms[place]


def residual_rows(layout: GroupLayout, links: Sequence[LinkPose], arms: Sequence[Vector],
                  drives: Sequence[DriveState]) -> list[Row]:
    """Residuals, with their derivatives, of the pairs that place no link, for given positions of the links."""
    rows = [row for closing in layout.closings for row in _closing_rows(links, closing, arms, drives)]
    rows += [_mesh_row(links, mesh, arms) for mesh in layout.meshes]
    return rows + [_turning_row(links, turning, drives) for turning in layout.turnings]


def _closing_rows(links: Sequence[LinkPose], closing: Closing, arms: Sequence[Vector],
                  drives: Sequence[DriveState]) -> Iterator[Row]:
    """Yield the residuals of a pair, with their derivatives."""
    place, moves = links[closing.link].point(_arm(arms, closing.arm))
    far_end, far_moves = links[closing.on].point(_arm(arms, closing.on_arm))
    gap, moves = minus(place, far_end), _subtract_rates(moves, far_moves)
    if closing.far is not None:
        far, _ = arms[closing.far]
        yield {RESIDUE: (dot(gap, gap) - far * far) / (far + far),
               **{k: dot(gap, move) / far for k, move in moves.items()}}
        return
    if closing.guide is None or closing.direction is None:
        for i in range(2):
            yield {RESIDUE: gap[i], **{k: move[i] for k, move in moves.items()}}
        return
    guide = links[closing.guide]
    ray = rotate(guide.turn, arms[closing.direction])
    swing = dot(quarter_turn(ray), gap)
    row = _add_rates({k: dot(ray, move) for k, move in moves.items()},
                     {k: swing if w is None else w * swing for k, w in guide.spin.items()})
    residual = dot(ray, gap)
    if closing.drive is not None:
        far, rate = drives[closing.drive]
        residual, row = residual - far, _add_rates(row, {k: -w for k, w in _drive_rates(rate).items()})
    if closing.lever is not None:
        link, on_link, (lever, _) = links[closing.link], links[closing.on], arms[closing.lever]
        residual = residual + lever * (link.angle - on_link.angle)
        row = _add_rates(row, _add_rates(_scaled_rates(lever, link.spin), _scaled_rates(-lever, on_link.spin)))
    yield {RESIDUE: residual, **row}


def _mesh_row(links: Sequence[LinkPose], mesh: Mesh, arms: Sequence[Vector]) -> Row:
    """Residual of a pair of gears, with its derivatives: an angle, linear in those of the links."""
    (k1, k2), row, residual = arms[mesh.factors], Row(), 0.0
    for weight, place in ((k1, mesh.first), (k2, mesh.second), (-(k1 + k2), mesh.carrier)):
        residual = residual + weight * links[place].angle
        row = _add_rates(row, _scaled_rates(weight, links[place].spin))
    return {RESIDUE: residual, **row}


def _scaled_rates(weight: Any, spin: Moves) -> Moves:
    """The derivatives of so many times an angle."""
    return {k: weight if w is None else weight * w for k, w in spin.items()}


def _turning_row(links: Sequence[LinkPose], turning: Spin, drives: Sequence[DriveState]) -> Row:
    """Residual, with its derivatives, of a pair that ties a link's turning to another's."""
    link, on = links[turning.link], links[turning.on or 0]
    reference, spin = on.turn or (1.0, 0.0), on.spin
    if turning.drive is not None:
        (cos, sin, *_), rate = drives[turning.drive]
        reference, spin = rotate(on.turn, (cos, sin)), _add_rates(spin, _drive_rates(rate))
    mirrored = reference[0], -reference[1]
    cos, sin = rotate(link.turn or (1.0, 0.0), mirrored)
    apart = _add_rates({k: 1.0 if w is None else w for k, w in link.spin.items()},
                       {k: -1.0 if w is None else -w for k, w in spin.items()})
    return {RESIDUE: sin, **{k: cos * w for k, w in apart.items()}}


def _add_rates(first: Moves, second: Moves) -> Moves:
    """The sum of two sets of derivatives, of vectors or of numbers."""
    total = dict(first)
    for k, b in second.items():
        a = total.get(k)
        total[k] = b if a is None else plus(a, b) if isinstance(a, tuple) else a + b
    return total


def _subtract_rates(first: Moves, second: Moves) -> Moves:
    """The difference of two sets of derivatives of vectors."""
    difference = dict(first)
    for k, (x, y) in second.items():
        difference[k] = minus(difference[k], (x, y)) if k in difference else (-x, -y)
    return difference


class NewtonStep(NamedTuple):
    """Newton's step: what is to be taken from each unknown, their rates, and the determinant of the derivatives."""

    corrections: list[Any]
    rates: list[Any]
    determinant: Any


def step(rows: Sequence[Row], width: int, sqrt: Callable[[Any], Any]) -> NewtonStep:
    """Newton's step for so many unknowns, from what is left open."""
    open_rows, pivots, determinant = list(rows), list[tuple[int, Row]](), 1.0
    free = set(range(width))
    while free:
        column = min(free, key=lambda j: (sum(j in row for row in open_rows), j))
        pivot, *lower_rows = sorted((row for row in open_rows if column in row),
                                    key=lambda row: sum(j >= 0 for j in row))
        open_rows = [row for row in open_rows if column not in row]
        for lower_row in lower_rows:
            pivot, cleared = _rotate_rows(pivot, lower_row, column, sqrt)
            open_rows.append(cleared)
        free.remove(column)
        pivots.append((column, pivot))
        determinant = determinant * pivot[column]
    corrections, rates = (_back_substitute(pivots, side) for side in (RESIDUE, TRAVEL))
    return NewtonStep(corrections, [-rate for rate in rates], determinant)


def _rotate_rows(upper: Row, lower: Row, column: int, sqrt: Callable[[Any], Any]) -> tuple[Row, Row]:
    """Rotate two rows (Givens) so that the second has a zero in a column."""
    a, b = upper[column] + TINY_PIVOT, lower[column]
    hypotenuse = sqrt(a * a + b * b)
    cos, sin = a / hypotenuse, b / hypotenuse
    first: Row = {column: hypotenuse}
    second: Row = {}
    for k in dict.fromkeys([*upper, *lower]):
        x, y = upper.get(k), lower.get(k)
        if k == column:
            continue
        if y is None:
            first[k], second[k] = cos * x, -(sin * x)
        elif x is None:
            first[k], second[k] = sin * y, cos * y
        else:
            first[k], second[k] = cos * x + sin * y, cos * y - sin * x
    return first, second


def _back_substitute(pivots: Sequence[tuple[int, Row]], side: int) -> list[Any]:
    """Back substitution for one right-hand side."""
    solution: Row = {}
    for column, row in reversed(pivots):
        value = row.get(side, 0.0)
        for k, weight in row.items():
            if k in solution:
                value = value - weight * solution[k]
        solution[column] = value / row[column]
    return [solution[column] for column in range(len(pivots))]


def rates_of(link: LinkPose, rates: Sequence[Any]) -> Iterator[Any]:
    """Yield the rates of a link's base along x and along y, and of its turn, by the travel, for given rates of the
    unknowns."""
    base = link.moves
    for moves in ({k: x for k, (x, _) in base.items()}, {k: y for k, (_, y) in base.items()}, link.spin):
        rate: Any = moves.get(TRAVEL, 0.0)
        for k in moves.keys() - {TRAVEL}:
            rate = rate + (rates[k] if moves[k] is None else rates[k] * moves[k])
        yield rate


def apply_corrections(layout: GroupLayout, state: Sequence[Any], corrections: Sequence[Any]) -> list[Any]:
    """The state less the corrections; an angle is turned back by Cayley's formula, right to second order, and where it
    is counted by as much: twice the arc tangent of half the correction."""
    corrected = list(state)
    for i, correction in enumerate(corrections):
        if i < layout.angles:
            half = 0.5 * correction
            square = half * half
            denominator = 1.0 + square
            cos, sin, *angle = state[i]
            turned = rotate((cos, sin), ((1.0 - square) / denominator, -correction / denominator))
            corrected[i] = (*turned, *(angle_in_all - correction * _arc_tangent_ratio(square)
                                       for angle_in_all in angle))
        else:
            corrected[i] = state[i] - correction
    return corrected


def _arc_tangent_ratio(square: Any) -> Any:
    """The arc tangent over its tangent, from the square of that: to the last digit up to a quarter, by its series."""
    ratio: Any = 1 / 15
    for k in range(13, 0, -2):
        ratio = 1 / k - square * ratio
    return ratio


PoseNumbers = tuple[float, ...]
"""How a link lies in one pose: its base and turn as x, y, cos, sin, and their rates by the travel as x, y, angle; where
angles are counted then how far it has turned in all."""


TapeRun = Blocks | Machine
"""What replays a tape over arrays."""


class CorrectedPose(NamedTuple):
    """One pose, corrected: as Newton's step has it, and how each link of the group lies then and moves."""

    corrections: tuple[float, ...]
    rates: tuple[float, ...]
    determinant: float
    lies: tuple[PoseNumbers, ...]


class _Record:
    """Newton's step of a group on a tape; without `rates` known links and drives have no rates.

    The inputs are how each known link but the frame lies, the arms, the drives, and the state.
    """

    def __init__(self, layout: GroupLayout, rates: bool):
        self.tape, self.inputs, self.layout = Symbols().tape, list[int](), layout
        known_links = [LinkPose(), *(LinkPose(self._pair(), self._pair(), {TRAVEL: self._pair()} if rates else {},
                                              {TRAVEL: self._new()} if rates else {}, self._new() if layout.counted
                                              else 0.0)
                                     for _ in range(layout.carriers - 1))]
        arms = [self._pair() for _ in range(layout.arms)]
        drives = [DriveState(self._angle() if turns else self._new(), self._new() if rates else None)
                  for turns in layout.drives]
        state = [self._angle() if i < layout.angles else self._new() for i in range(layout.unknowns)]
        links = pose_links(layout, known_links, arms, drives, state)
        self.step = step(residual_rows(layout, links, arms, drives), layout.unknowns, Symbol.root)
        closed = pose_links(layout, known_links, arms, drives, apply_corrections(layout, state, self.step.corrections),
                            moving=False)
        self.links, self.closed = links[layout.carriers:], closed[layout.carriers:]

    def _new(self) -> Symbol:
        symbol = self.tape.input(f"n{len(self.inputs)}")
        self.inputs.append(symbol.place)
        return symbol

    def _pair(self) -> Vector:
        return self._new(), self._new()

    def _angle(self) -> tuple[Symbol, ...]:
        """The cosine and sine of an angle, and where angles are counted that itself."""
        return tuple(self._new() for _ in range(3 if self.layout.counted else 2))

    def tape_places(self, *numbers: Any) -> tuple[int, ...]:
        """The places of numbers."""
        return tuple(map(self.tape.place, numbers))

    def link_pose(self, i: int) -> tuple[Any, ...]:
        """Position of a link of the group: its base and its turn."""
        return *self.closed[i].base, *(self.closed[i].turn or (1.0, 0.0))

    def link_angle(self, i: int) -> tuple[Any, ...]:
        """The angle that a link has turned in all, if counted."""
        return (self.closed[i].angle,) if self.layout.counted else ()

    def link_rates(self, i: int) -> Iterator[Any]:
        """Rates of a link."""
        return rates_of(self.links[i], self.step.rates)


def record_step(layout: GroupLayout) -> tuple[Tape, list[int], Any]:
    """The tape that corrects one pose: its inputs, and where on it the parts of a :class:`Corrected` stand.

    The inputs are how each known link but the frame lies, the arms, the cosine and sine or the length of each drive
    with its rate, and of each unknown the cosine and sine, or the displacement.
    """
    record = _Record(layout, rates=True)
    step, places_of = record.step, record.tape_places
    lies = tuple(places_of(*record.link_pose(i), *record.link_rates(i), *record.link_angle(i))
                 for i in range(len(record.links)))
    return record.tape, record.inputs, CorrectedPose(places_of(*step.corrections), places_of(*step.rates),
                                                     record.tape.place(step.determinant), lies)


@lru_cache(maxsize=256)
def single_pose_step(layout: GroupLayout) -> Callable[..., Any]:
    """A function that corrects one pose: it reads the inputs of the record and gives the parts of :class:`Corrected`.
    """
    return function(*record_step(layout))


@lru_cache(maxsize=64)
def many_poses_step(layout: GroupLayout, machine: bool) -> TapeRun:
    """Newton's step over arrays, without rates: corrections, determinant, and x, y, cos, sin of each link, then the
    angle if counted."""
    record = _Record(layout, rates=False)
    lies = [number for i in range(len(record.links)) for number in (*record.link_pose(i), *record.link_angle(i))]
    outputs = record.tape_places(*record.step.corrections, record.step.determinant, *lies)
    return (Machine if machine else Blocks)(record.tape, record.inputs, outputs)
