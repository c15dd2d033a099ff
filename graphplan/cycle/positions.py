"""Where links and points are in many poses, group after group in the order of motion transfer, and how they move.

Linkages of driven links and plain dyads alone are assembled by the compass rules. Of all others the states of groups
are predicted from the knots of the path and closed by Newton's step; where that was long, by as many more as it takes;
where it is not to be trusted, the pose is walked to. Poses are placed in blocks that stay in the cache.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from graphplan.cycle import closure, newton
from graphplan.cycle.closure import TRAVEL, DriveState, GroupLayout, LinkPose, Vector
from graphplan.cycle.continuation import Path
from graphplan.cycle.dyads import Failure, PlacedLink, assemble, closure_pose
from graphplan.cycle.groups import MAX_CORRECTION_RATIO, MAX_FIRST_CORRECTION, ClosureGroup, state_slices
from graphplan.cycle.linkage import Array, Linkage
from graphplan.cycle.tolerances import CORRECTION_TOL, RESIDUE_TOL
from graphplan.mechanism.model import FRAME

BLOCK_POSES = 2048
"""Poses whose numbers fit into the cache."""

MIN_TAPE_POSES = 4096
"""For fewer poses a tape is not worth its writing."""


class PosePlacer:
    """The points of a linkage in many poses; `points` are complex arrays of shape (n,), `turns` those of some links.

    `failures` tells for each group that could not be placed in which poses.
    """

    def __init__(self, linkage: Linkage, groups: Sequence[ClosureGroup], n: int, turning: Iterable[str]):
        self.linkage, self.groups = linkage, groups
        self.slices = state_slices(groups)
        links = dict.fromkeys(turning)
        rows = np.empty((len(linkage.places) + len(links), n), dtype=complex)  # one large piece of memory is had faster
        self.points = dict(zip(linkage.places, rows, strict=False))
        self.turns = dict(zip(links, rows[len(linkage.places):], strict=True))
        self.failures: list[tuple[Failure, Array]] = []
        self.owned = {link: [(point, linkage.places[point] - linkage.origins[link]) for point in linkage.points(link)
                             if link == min(linkage.scene.links_of[point], key=linkage.order.__getitem__)]
                      for link in linkage.links}

    def follow(self, path: Path, travel: Array, at: Array, machine: bool) -> None:
        """Place the poses `at` these places, which the path reaches; by machine code if asked for."""
        self._place_fixed_points(at)
        blocks = [at[start : start + BLOCK_POSES] for start in range(0, len(at), BLOCK_POSES)]
        if not blocks or self._assemble_blocks(travel, blocks):
            return
        taped = machine or at.size > MIN_TAPE_POSES
        runs = [newton.many_poses_step(group.layout, machine) if taped and group.unknowns else None
                for group in self.groups]
        with np.errstate(all="ignore"):
            for block in blocks:
                self._follow_block(path, travel[block], block, runs)

    def _assemble_blocks(self, travel: Array, blocks: Sequence[Array]) -> bool:
        """Place blocks of poses by compass rules, which need no path; not where some group is no plain dyad."""
        for block in blocks:
            links_placed, failures = assemble(self.linkage, self.groups, travel[block])
            if len(links_placed) < len(self.linkage.links):
                return False
            self.failures += [(failure, block[missing]) for failure, missing in failures if missing.any()]
            target = _as_slice(block)
            for link in self.linkage.links[1:]:
                for point, _ in self.owned[link]:
                    self.points[point][target] = links_placed[link].point(self.linkage.places[point])
            for link, array in self.turns.items():
                array[target] = links_placed[link].turn
        return True

    def retry(self, walked: Callable[[float], Array | None], travel: Array) -> None:
        """Place the poses that failed by the states to which one can walk at their travels."""
        lost = {place for _, at in self.failures for place in at.tolist()}
        states = {place: state for place in sorted(lost) if (state := walked(float(travel[place]))) is not None}
        if states:
            at = np.array([*states])
            self.place_states(np.stack([*states.values()], axis=1), travel, at)
            self.failures = [(failure, np.setdiff1d(poses, at)) for failure, poses in self.failures]

    def place_states(self, state: Array, travel: Array, at: Array) -> None:
        """Take the poses `at` these places from states, (unknowns, n): where one is singular, it cannot be closed."""
        travels, bodies = travel[at], {FRAME: LinkPose()}
        for i, group in enumerate(self.groups):
            carriers = [bodies[link] for link in (FRAME, *group.carriers)]
            self._enter_points(group, group.link_poses(carriers, travels, state[self.slices[i]]),
                               bodies, at)
        self._place_fixed_points(at)
        for point, place in self.linkage.places.items():
            self.points[point][at[travels == 0]] = place

    def _place_fixed_points(self, at: Array) -> None:
        """The points of the frame, and of no link, stay where they are."""
        for point, links in self.linkage.scene.links_of.items():
            if not links or FRAME in links:
                self.points[point][at] = self.linkage.places[point]

    def explain_failures(self, travel: Array, at: Array) -> None:
        """Tell of the poses `at` these places, which the path does not reach, what prevents them."""
        _, failures = assemble(self.linkage, self.groups, travel[at])
        self.failures += [(failure, at[missing]) for failure, missing in failures]

    def _follow_block(self, path: Path, travel: Array, at: Array, runs: Sequence[newton.TapeRun | None]) -> None:
        """One block."""
        state, lengths = path.predict_states(travel)
        bodies = {FRAME: LinkPose()}
        for i, group in enumerate(self.groups):
            carriers = [bodies[link] for link in (FRAME, *group.carriers)]
            links, trusted = _settle_poses(group, carriers, travel, state[self.slices[i]], lengths,
                                           path.senses[i], MAX_FIRST_CORRECTION * lengths,
                                           np.zeros(len(travel), dtype=bool), runs[i])
            if not trusted.all():
                why = Failure(group.part, "Newton's method does not stay on their branch")
                self.failures.append((why, at[~trusted]))
            self._enter_points(group, links, bodies, at)

    def _enter_points(self, group: ClosureGroup, links: Sequence[LinkPose], bodies: dict[str, LinkPose],
                      at: Array) -> None:
        """Write down the points of a group."""
        for link, body in zip(group.links, links, strict=True):
            bodies[link] = LinkPose(body.base, body.turn, angle=body.angle)
            x, y = (self.linkage.reach * number for number in body.base)
            x, y = x + self.linkage.origins[FRAME].real, y + self.linkage.origins[FRAME].imag
            for point, lever in self.owned[link]:
                (a, b), array = closure.rotate(body.turn, (lever.real, lever.imag)), self.points[point]
                array.real[at], array.imag[at] = x + a, y + b
            if link in self.turns:
                self.turns[link].real[at], self.turns[link].imag[at] = body.turn or (1.0, 0.0)


def _as_slice(places: Array) -> slice | Array:
    """Places as a slice if they follow each other: arrays are then written much faster."""
    first, last = int(places[0]), int(places[-1])
    return slice(first, last + 1) if last - first == len(places) - 1 else places


def _settle_poses(group: ClosureGroup, carriers: Sequence[LinkPose], travel: Array, state: Array, length: Array,
                  sense: float,
                  allowed: Array, settled: Array, run: newton.TapeRun | None) -> tuple[list[LinkPose], Array]:
    """A group closed in n poses, and where that is to be trusted: see :meth:`Group.settled`."""
    if not group.unknowns:
        return group.link_poses(carriers, travel, state), np.ones(len(travel), dtype=bool)
    corrections, determinant, links = group.step(carriers, travel, state, run)
    far, n = np.abs(corrections), group.layout.angles
    far[n:] /= np.maximum(1.0, np.abs(state[n:]))  # as the path weighs changes
    far = far.max(axis=0)
    trusted = (far <= allowed) & (np.sign(determinant) == sense)
    again = np.flatnonzero(trusted & ~settled & (far * far > RESIDUE_TOL * length))
    if again.size:
        far, length = far[again], length[again]
        settled = far <= CORRECTION_TOL * length
        settled_links, trusted[again] = _settle_poses(group, [_pose_subset(body, again) for body in carriers],
                                                      travel[again],
                                                      (state - corrections)[:, again], length, sense,
                                                      np.where(settled, MAX_FIRST_CORRECTION * length,
                                                               MAX_CORRECTION_RATIO * far), settled, run)
        for link, settled_link in zip(links, settled_links, strict=True):
            for array, values in zip((*link.base, link.angle, *(link.turn or ())),
                                     (*settled_link.base, settled_link.angle, *(settled_link.turn or (1.0, 0.0))),
                                     strict=False):
                if isinstance(array, np.ndarray):
                    array[again] = values
    return links, trusted


def _pose_subset(body: LinkPose, at: Array) -> LinkPose:
    """A link in some of its poses."""
    def subset(vector: tuple[Any, ...]) -> Any:
        return tuple(number[at] if isinstance(number, np.ndarray) else number for number in vector)

    (angle,) = subset((body.angle,))
    return LinkPose(subset(body.base), subset(body.turn) if body.turn else None, angle=angle)


# ---- how links move, from the closures of their groups ---------------------------------------------------------------


class MovingLink(NamedTuple):
    """A link in n poses: its base, which was given at `origin`, and its turn; how both change with the drive's travel,
    the turn as an angle. All are arrays of shape (n,), complex but for the last."""

    origin: complex
    base: Array
    turn: Array
    velocity: Array
    spin: Array

    def carried_back(self, places: Array) -> Array:
        """Where places of the plane were on the link as it was given."""
        return self.origin + (places - self.base) * self.turn.conj()

    def velocity_at(self, places: Array) -> Array:
        """How its points at some places of the plane move."""
        return self.velocity + 1j * self.spin * (places - self.base)


def link_rates(linkage: Linkage, groups: Sequence[ClosureGroup], travel: Array, points: Mapping[str, Array],
               turns: Mapping[str, Array]) -> dict[str, MovingLink]:
    """How every link lies and moves where its points and turns are so; nan where they are, and where it is singular."""
    frame, reach, still = linkage.origins[FRAME], linkage.reach, np.zeros(travel.shape)
    bodies = {FRAME: LinkPose()}
    turns = {**turns, **dict(_turned_arms(linkage, points))}
    for link in linkage.links[1:]:
        pin = next(iter(linkage.points(link)), "") or linkage.lines.arms[link].at
        bodies[link] = closure_pose(linkage, link, PlacedLink(linkage.places[pin], points[pin], turns[link]))
    for group in groups:
        _enter_rates(group, bodies, travel)
    links = {FRAME: MovingLink(frame, still + frame, still + 1.0, still + 0j, still)}
    for link in linkage.links[1:]:
        body = bodies[link]
        (x, y), spin = body.moves.get(TRAVEL, (0.0, 0.0)), body.spin.get(TRAVEL, 0.0)
        links[link] = MovingLink(linkage.origins[link], frame + reach * _complex(body.base), turns[link],
                                 reach * _complex((x, y)) + still, spin + still)
    return links


def _turned_arms(linkage: Linkage, points: Mapping[str, Array]) -> Iterator[tuple[str, Array]]:
    """How the arms turn that are thought in."""
    for name, gear in linkage.lines.arms.items():
        line, given_line = (places[gear.far_centre] - places[gear.at] for places in (points, linkage.places))
        yield name, line / np.abs(line) / (given_line / abs(given_line))


def _enter_rates(group: ClosureGroup, bodies: dict[str, LinkPose], travel: Array) -> None:
    """Enter how the links of a group move."""
    carriers = [bodies[link] for link in (FRAME, *group.carriers)]
    drives = [DriveState(drive.at, rate) for drive, (_, rate) in zip(group.drives_and_state(travel, ())[0],
                                                                     group.drives, strict=True)]
    state = _unknowns_of(group.layout, [*carriers, *(bodies[link] for link in group.links)], group.arms)
    links = closure.pose_links(group.layout, carriers, group.arms, drives, state)
    with np.errstate(all="ignore"):
        rows = closure.residual_rows(group.layout, links, group.arms, drives)
        rates = newton.step(rows, group.unknowns, np.sqrt).rates
    for link, body in zip(group.links, links[len(carriers):], strict=True):
        *velocity, spin = newton.rates_of(body, rates)
        bodies[link] = LinkPose(bodies[link].base, bodies[link].turn, {TRAVEL: tuple(velocity)}, {TRAVEL: spin})


def _unknowns_of(layout: GroupLayout, links: Sequence[LinkPose], arms: Sequence[Vector]) -> list[Any]:
    """The unknowns of a group where its links lie so: cosine and sine of the angles, then displacements."""
    unknowns: list[Any] = [links[spin.link].turn for spin in layout.spins if spin.on is None]
    for seat in layout.seats:
        base = _complex(links[seat.link].base)
        if seat.on is None:
            away = base - (complex(*arms[seat.arm]) if seat.arm is not None else 0.0)
            unknowns += away.real, away.imag
        elif seat.direction is not None and seat.guide is not None and seat.drive is None:
            on, guide = links[seat.on], links[seat.guide]
            arm = _rotated_complex(on, arms[seat.arm]) if seat.arm is not None else 0.0
            ray = _rotated_complex(guide, arms[seat.direction])
            unknowns.append(((base - _complex(on.base) - arm) * np.conj(ray)).real)
    return unknowns


def _rotated_complex(body: LinkPose, vector: Vector) -> Any:
    return _complex(closure.rotate(body.turn, vector))


def _complex(vector: Any) -> Any:
    return vector[0] + 1j * vector[1]
