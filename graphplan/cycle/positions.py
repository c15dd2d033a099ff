"""Positions of links and points in many poses, followed on one branch from the given pose to the limits of motion.

Linkages of driven links and plain dyads alone are assembled by the compass rules. Of all others the states of groups
are predicted from the knots of the path and closed by Newton's step; where that was long, by as many more as it takes;
where it is not to be trusted, the pose is walked to. Poses are placed in blocks that stay in the cache.

Each step is predicted from the last knots (Hermite) and corrected by Newton, group after group. A step that is not
certain to stay on its branch is halved; where even the finest is not, the linkage is at a limit: a limit position (dead
centre), or a change point (such as a parallelogram with all links in line), from which several motions lead on and the
lengths say not which.

A predicted pose is trusted only where the first correction is small relative to the step that it predicts, where each
further one is small relative to the one before, and where no determinant of a group has changed its sign: it does
wherever two branches meet.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from graphplan.cycle import closure
from graphplan.cycle.closure import TRAVEL, DriveState, GroupLayout, LinkPose, PoseNumbers, Vector
from graphplan.cycle.dyads import Failure, PlacedLink, assemble, closure_pose
from graphplan.cycle.groups import MAX_CORRECTION_RATIO, MAX_FIRST_CORRECTION, ClosureGroup, state_slices
from graphplan.cycle.linkage import Array, Linkage
from graphplan.cycle.tolerances import (
    CORRECTION_TOL,
    CROSSING_STEP,
    LONGER_MISS,
    MIN_GOAL_STEP,
    MIN_STEP,
    RESIDUE_TOL,
    SHORTER_MISS,
    SINGULAR_TOL,
)
from graphplan.cycle.travel import afford
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.travel import TURN, travel_unit

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
        runs = [closure.many_poses_step(group.layout, machine) if taped and group.unknowns else None
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

    def _follow_block(self, path: Path, travel: Array, at: Array, runs: Sequence[closure.TapeRun | None]) -> None:
        """Follow the poses of one block of travels."""
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
                  allowed: Array, settled: Array, run: closure.TapeRun | None) -> tuple[list[LinkPose], Array]:
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


class MovingLink(NamedTuple):
    """A link in n poses: its base, which was given at `origin`, and its turn; how both change with the drive's travel,
    the turn as an angle. All are arrays of shape (n,), complex but for the last."""

    origin: complex
    base: Array
    turn: Array
    velocity: Array
    spin: Array

    def carried_back(self, places: Array) -> Array:
        """Places in the plane, as they were on the link when it was given."""
        return self.origin + (places - self.base) * self.turn.conj()

    def velocity_at(self, places: Array) -> Array:
        """Velocity of the link's points at some places of the plane."""
        return self.velocity + 1j * self.spin * (places - self.base)


def link_rates(linkage: Linkage, groups: Sequence[ClosureGroup], travel: Array, points: Mapping[str, Array],
               turns: Mapping[str, Array]) -> dict[str, MovingLink]:
    """Position and rates of every link for given places of its points and given turns; nan for nan, and in singular
    poses."""
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
    """Yield the turn of each imaginary arm, the line between two centres."""
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
        rates = closure.step(rows, group.unknowns, np.sqrt).rates
    for link, body in zip(group.links, links[len(carriers):], strict=True):
        *velocity, spin = closure.rates_of(body, rates)
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


Progress = Callable[[float], None]
"""Is told how much of the path is followed, from 0 to 1."""

MAX_STEP_TURNS = 1 / 60
"""The longest step, of a turn: 6 degrees."""

FIRST_STEP = 1 / 8
"""The first step, of the longest: the tangent in one knot does not lead so far as the curve through several."""

PREDICTOR_KNOTS = 3
"""How many knots lead to the next one."""

INTERPOLATION_KNOTS = 4
"""How many knots tell what lies between two of them."""

KNOT_BYTES = 512
"""Bytes for each link in a step, as measured on long travels."""

LIMIT_SLACK = 16
"""How many finest steps a limit may lie beyond the last knot: a step is only taken where several fit before it."""


class Knot(NamedTuple):
    """A pose on the path: the state of all groups, shape (unknowns,), its rate, and the groups' determinants."""

    travel: float
    state: Array
    rate: Array
    determinants: Array

    def is_regular(self, start: Knot) -> bool:
        """Whether it is on the branch of the given pose, and not too near to where another meets it."""
        return bool((self.determinants / start.determinants >= SINGULAR_TOL).all())


class Limit(NamedTuple):
    """A pose beyond which the linkage cannot be followed: its travel and tolerance, the part that stops, and whether it
    is a change point."""

    travel: float
    slack: float
    links: tuple[str, ...]
    change: bool

    @property
    def kind(self) -> str:
        """The name of this kind of limit: change point, or limit position."""
        return "change point" if self.change else "limit position"


class Path:
    """The knots in order of travel, the given pose among them, and the limits at the ends, if any.

    `travel` has the shape (knots,), `steps` are the lengths of the steps between them, `senses` the signs of the
    groups' determinants.
    """

    def __init__(self, knots: Sequence[Knot], steps: Array, senses: Array, lower: Limit | None, upper: Limit | None):
        self.travel, self._state, self._rate = (np.array([knot[i] for knot in knots]) for i in range(3))
        self.knots, self._steps, self.senses, self.lower, self.upper = knots, steps, senses, lower, upper

    def nearest_states(self, travel: Array) -> Array:
        """The states of the knots nearest to n travels, shape (unknowns, n)."""
        return self._state[np.argmin(np.abs(self.travel - travel[:, None]), axis=1)].T

    def predict_states(self, travel: Array) -> tuple[Array, Array]:
        """The states at n travels by the knots around each (Hermite), shape (unknowns, n), and the steps there."""
        nodes, table = self._knot_curves
        i = np.clip(np.searchsorted(self.travel, travel) - 1, 0, len(self.travel) - 2)
        around, coefficients = travel - nodes.take(i, axis=1), table.take(i, axis=1)
        *lower, states = coefficients.reshape(2 * len(nodes), self._state.shape[1], len(travel))
        for k, coefficient in reversed([*enumerate(lower)]):
            states *= around[k // 2]
            states += coefficient
        return states, self._steps.take(i)

    @cached_property
    def _knot_curves(self) -> tuple[Array, Array]:
        """Between any two knots: those around, and the coefficients of the curve through them."""
        width = min(INTERPOLATION_KNOTS, len(self.travel))
        first = np.arange(1 - width // 2, len(self.travel) - width // 2).clip(0, len(self.travel) - width)
        around = np.arange(width)[:, None] + first
        table = np.concatenate(divided_differences(self.travel[around][..., None], self._state[around],
                                                   self._rate[around]), axis=1)
        return self.travel[around], table.T.copy()


def divided_differences(travel: Array, state: Array, rate: Array) -> list[Array]:
    """The divided differences of m knots, the first axis, with their rates: the coefficients of Newton's polynomial."""
    nodes, column = travel.repeat(2, axis=0), np.empty((2 * len(travel) - 1, *state.shape[1:]))
    column[::2], column[1::2] = rate, (state[1:] - state[:-1]) / (travel[1:] - travel[:-1])
    differences = [state[0], column[0]]
    for k in range(2, len(nodes)):
        column = (column[1:] - column[:-1]) / (nodes[k:] - nodes[:-k])
        differences.append(column[0])
    return differences


class Continuation:
    """The path of a linkage from the given pose, either way."""

    def __init__(self, linkage: Linkage, groups: Sequence[ClosureGroup], lower: float, upper: float,
                 progress: Progress | None = None):
        self.linkage, self.groups = linkage, groups
        self.slices = state_slices(groups)
        self._angle = np.array([i < group.layout.angles for group in groups for i in range(group.unknowns)], dtype=bool)
        self.lower, self.upper, self.progress = lower, upper, progress or (lambda done: None)
        self.longest = MAX_STEP_TURNS * min((upper - lower if drive.slides else TURN) / abs(pace) for drive, pace
                                            in zip(linkage.scene.drives, linkage.paces, strict=True) if pace)
        self.finest = MIN_STEP * self.longest
        self.pace = max(abs(pace) / (linkage.reach if drive.slides else 1) for drive, pace
                        in zip(linkage.scene.drives, linkage.paces, strict=True))
        if self.longest:
            unit, name = travel_unit(linkage.scene)
            afford("the cycle", (upper - lower) / unit, name, KNOT_BYTES * len(linkage.links) * unit / self.longest)

    def path(self, closed: bool) -> Path:
        """Follow the linkage from the given pose to `upper` and to `lower`; in a closed cycle also around the other
        way."""
        still = np.zeros(self._angle.size)
        start = self._solve_knot(0.0, still, math.inf)
        if isinstance(start, int):  # this group is singular, and the pose leads nowhere
            start = Knot(0.0, still, still, 1.0 - np.eye(len(self.groups))[start])
        with np.errstate(all="ignore"):
            up, upper = self._follow_to(start, self.upper, 0.0)
            down, lower = self._follow_to(start, upper.travel - TURN if closed and upper else self.lower, 0.5)
        self.progress(1.0)
        knots = [*down[:0:-1], *up]
        travel, states = (np.array([knot[i] for knot in knots]) for i in range(2))
        steps = self._step_length(np.diff(travel), np.diff(states, axis=0), states[:-1])
        return Path(knots, steps, np.sign(start.determinants), lower, upper)

    def state(self, path: Path, travel: float) -> Array | None:
        """The state at this travel, followed from the nearest knot; None if rounding hides it."""
        near = path.knots[int(np.argmin(np.abs(path.travel - travel)))]
        with np.errstate(all="ignore"):
            knots, limit = self._follow_to(near, travel)
        return None if limit else knots[-1].state

    def _follow_to(self, start: Knot, goal: float, done: float | None = None) -> tuple[list[Knot], Limit | None]:
        """The knots up to the goal, or to the limit before it; `done` so much of the path."""
        knots, at, step = [start], start.travel, math.copysign(FIRST_STEP * self.longest, goal - start.travel)
        while at != goal:
            remaining = goal - at
            step = remaining if abs(remaining) <= abs(step) + self.finest else step
            travel = goal if step == remaining else at + step
            predicted = _extrapolate(knots[-PREDICTOR_KNOTS:], travel)
            covered = max(abs(step), MIN_GOAL_STEP * self.longest) if step == remaining else abs(step)
            length = float(self._step_length(covered, predicted - knots[-1].state, knots[-1].state))
            knot = self._solve_knot(travel, predicted, length)
            if isinstance(knot, int) or not knot.is_regular(start):
                step /= 2
                if abs(step) < self.finest:
                    return self._end_at_limit(knots, math.copysign(CROSSING_STEP * self.longest, step))
                continue
            missed = float(self._scaled_change(knot.state - predicted, predicted).max(initial=0.0)) / length
            if missed <= LONGER_MISS and 2 * abs(step) <= self.longest:
                step *= 2
            elif missed > SHORTER_MISS:
                step /= 2
            knots.append(knot)
            at = travel
            if done is not None:
                self.progress(done + at / goal / 2)
        return knots, None

    def _step_length(self, travel: Any, change: Array, state: Array) -> Any:
        """The lengths of steps of some travels, by which states change: the largest change of an unknown or a drive.

        It is no more than a radian or a reach.
        """
        return np.minimum(1.0, np.maximum(self._scaled_change(change, state).max(axis=-1, initial=0.0),
                                          self.pace * travel))

    def _scaled_change(self, change: Array, state: Array) -> Array:
        """The sizes of changes, relative to the state where that is a displacement of more than a reach: it may be
        endless.
        """
        return np.abs(change) / np.where(self._angle, 1.0, np.maximum(1.0, np.abs(state)))

    def _solve_knot(self, travel: float, predicted: Array, size: float) -> Knot | int:
        """The knot at this travel; the place of the first group in which Newton's method is not to be trusted there."""
        link_numbers, guess = dict[str, PoseNumbers](), predicted.tolist()
        state, rate, determinants = list[float](), list[float](), list[float]()
        for i, group in enumerate(self.groups):
            settled = group.settle(link_numbers, travel, guess[self.slices[i]], size)
            if settled is None:
                return i
            last = settled[1]
            state += settled[0]
            rate += last.rates
            determinants.append(last.determinant)
            link_numbers.update(zip(group.links, last.lies, strict=True))
        return Knot(travel, np.array(state), np.array(rate), np.array(determinants))

    def _end_at_limit(self, knots: list[Knot], step: float) -> tuple[list[Knot], Limit]:
        """The knots up to a limit: one more where the motion leads straight through a change point.

        There a determinant goes through zero, as a straight line does on so short a way. The way begins as far before
        the limit as it ends beyond it: nearer knots are as singular as rounding lets them be.
        """
        start, last = knots[0], knots[-1]
        before = next((knot for knot in reversed(knots) if abs(last.travel - knot.travel) >= abs(step)), start)
        travel = last.travel + step
        predicted = _extrapolate([before], travel)
        beyond = self._solve_knot(travel, predicted, 
                                  float(self._step_length(abs(travel - before.travel), predicted - before.state,
                                                          before.state)))
        if isinstance(beyond, int) or (beyond.determinants / before.determinants > 0).all():
            i = int(np.argmin(np.abs(last.determinants / (start.determinants if len(knots) > 1 else 1.0))))
            return knots, Limit(last.travel, LIMIT_SLACK * self.finest, self.linkage.parts[i], False)
        ratio = beyond.determinants / before.determinants
        i = int(np.argmax(ratio <= 0))
        travel = before.travel + (travel - before.travel) / (1 - float(ratio[i]))
        limit_knot = last._replace(travel=travel, state=_extrapolate([before, beyond], travel))
        knots = [knot for knot in knots if abs(knot.travel) < abs(travel)]
        return [*knots, limit_knot], Limit(travel, CROSSING_STEP * abs(step), self.linkage.parts[i], True)


def _extrapolate(knots: Sequence[Knot], travel: float) -> Array:
    """The state at this travel on the curve through these knots with their rates (Hermite, in Lagrange's form)."""
    state: Array = 0.0
    for knot in knots:
        gaps = [(knot.travel - neighbour.travel, travel - neighbour.travel) for neighbour in knots
                if neighbour is not knot]
        weight, away = math.prod(far / gap for gap, far in gaps) ** 2, travel - knot.travel
        slope = 2 * sum(1 / gap for gap, _ in gaps)
        state = state + weight * (1 - slope * away) * knot.state + weight * away * knot.rate
    return state
