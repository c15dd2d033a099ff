"""The closure of one group in any numbers: how its links lie, and what their pairs leave open.

The unknowns are angles of links and displacements of slides: seen from the links placed before, each link's base is a
point of another link, or lies off it along a guide (a spanning tree of the group's pairs). What pairs are left over
close the loops, in as many equations as there are unknowns.

All is straight-line arithmetic: floats, arrays and the symbols of a tape go through the same lines.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

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
    """Two links turn on a third so that by their `factors`, a pair among the arms, the sum of the angles is nothing."""

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
        """How many unknowns are angles."""
        return sum(spin.on is None for spin in self.spins)

    @property
    def unknowns(self) -> int:
        """How many unknowns there are."""
        return self.angles + sum(2 if seat.on is None else seat.direction is not None and seat.drive is None
                                 for seat in self.seats)


class DriveState(NamedTuple):
    """Where a drive is: the cosine and sine of its angle, and that itself where angles are counted, or its length; and
    its rate by the travel, if asked for."""

    at: Any
    rate: Any


@dataclass
class LinkPose:
    """A link in a pose: its base and its turn, a vector of length 1, or none where it does not turn.

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
    """How the end of a lever moves that turns so."""
    across = quarter_turn(lever) if spin else lever
    return {k: across if w is None else times(w, across) for k, w in spin.items()}


def _drive_rates(rate: Any) -> Moves:
    """The derivative of what is driven; none where nobody asks for rates."""
    return {} if rate is None else {TRAVEL: rate}


def _arm(arms: Sequence[Vector], place: int | None) -> Vector | None:
    return None if place is None else arms[place]


def residual_rows(layout: GroupLayout, links: Sequence[LinkPose], arms: Sequence[Vector],
                  drives: Sequence[DriveState]) -> list[Row]:
    """What the pairs that seat no link leave open in a pose in which the links lie so."""
    rows = [row for closing in layout.closings for row in _closing_rows(links, closing, arms, drives)]
    rows += [_mesh_row(links, mesh, arms) for mesh in layout.meshes]
    return rows + [_turning_row(links, turning, drives) for turning in layout.turnings]


def _closing_rows(links: Sequence[LinkPose], closing: Closing, arms: Sequence[Vector],
                  drives: Sequence[DriveState]) -> Iterator[Row]:
    """What a pair leaves open."""
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
    """What a pair of gears leaves open: an angle, as linear in those of the links as it is."""
    (k1, k2), row, residual = arms[mesh.factors], Row(), 0.0
    for weight, place in ((k1, mesh.first), (k2, mesh.second), (-(k1 + k2), mesh.carrier)):
        residual = residual + weight * links[place].angle
        row = _add_rates(row, _scaled_rates(weight, links[place].spin))
    return {RESIDUE: residual, **row}


def _scaled_rates(weight: Any, spin: Moves) -> Moves:
    """The derivatives of so many times an angle."""
    return {k: weight if w is None else weight * w for k, w in spin.items()}


def _turning_row(links: Sequence[LinkPose], turning: Spin, drives: Sequence[DriveState]) -> Row:
    """What a pair leaves open that holds a link's turning to another's."""
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
