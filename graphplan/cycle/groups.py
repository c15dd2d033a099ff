"""The groups of a linkage, each made ready for its closure: which link sits on which, and what closes the loops.

The tree grows breadth first from the links placed before, so that loops are short. A joint, or a slide that is driven
along its guide, seats a link whole; a slide alone seats it but for its displacement.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import accumulate, chain
from typing import Any, NamedTuple

import numpy as np

from graphplan.cycle import closure
from graphplan.cycle.closure import Closing, CorrectedPose, GroupLayout, LinkPose, Mesh, PoseNumbers, Seat, Spin
from graphplan.cycle.linkage import CentreDistance, GearBond, Linkage, RackBond, unit_direction
from graphplan.cycle.tolerances import CLOSURE_TOL, CORRECTION_TOL, DETERMINANT_TOL
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.pairs.pair import TOUCHING, Along, Turning

Array = Any

MAX_FIRST_CORRECTION = 1 / 64
"""The largest first correction, of the step."""

MAX_CORRECTION_RATIO = 1 / 4
"""The largest further correction, of the one before."""


class End(NamedTuple):
    """The end of an arm: the link that it is fixed to, and a point, or a direction of a guide."""

    link: str
    at: str
    is_direction: bool


class ClosureGroup:
    """One part of a linkage in its numbers; lengths are counted in reaches.

    `links` are its own, `carriers` those placed before that it needs, but for the frame. Those must be made before: the
    linkage is told where the bases of links were given. `ends` are for each of the `arms` the link that it is fixed to,
    the point at its end or of its guide, and whether it is a guide's way. `drives` turn or slide, at rates.
    """

    def __init__(self, linkage: Linkage, part: tuple[str, ...]):
        builder = _LayoutBuilder(linkage, part)
        self.part, self.links, self.carriers = part, tuple(builder.seated), builder.carriers
        self.layout, self.arms, self.ends, self.drives = builder.layout(), builder.arms, builder.ends, builder.drives
        self.unknowns, self._angles = self.layout.unknowns, self.layout.angles
        self._run = closure.single_pose_step(self.layout)
        self._flat = [number for arm in self.arms for number in arm]
        self._still = np.empty((len(self._flat), 0))  # the same for as many poses as were asked for

    # ---- one pose ---------------------------------------------------------------------------------------------

    def correct(self, placed: Mapping[str, PoseNumbers], travel: float, state: Sequence[float]) -> CorrectedPose:
        """One step of Newton from a state; raises ZeroDivisionError where it is singular."""
        flat: list[float] = []
        for link in self.carriers:
            flat += placed[link]
        flat += self._flat
        for turns, rate in self.drives:
            angle = rate * travel
            flat += (*self._angle_numbers(angle), rate) if turns else (angle, rate)
        for angle in state[: self._angles]:
            flat += self._angle_numbers(angle)
        return CorrectedPose(*self._run(*flat, *state[self._angles:]))

    def _angle_numbers(self, angle: Any) -> tuple[Any, ...]:
        """An angle as the closure has it."""
        turn = (np.cos(angle), np.sin(angle)) if isinstance(angle, np.ndarray) else (math.cos(angle), math.sin(angle))
        return (*turn, angle) if self.layout.counted else turn

    def settle(self, placed: Mapping[str, PoseNumbers], travel: float, state: list[float], size: float,
                ) -> tuple[list[float], CorrectedPose] | None:
        """The state that closes the group, and the last step towards it; None if it is not to be trusted.

        It is trusted only if the first correction is small relative to the `size` of the predicted step, and each
        further one small relative to the one before.
        """
        allowed, settled = MAX_FIRST_CORRECTION * size, not self.unknowns
        while True:
            try:
                corrected = self.correct(placed, travel, state)
            except (ZeroDivisionError, OverflowError, ValueError):  # singular, or a state that has gone to infinity
                return None
            far = self._largest_correction(corrected.corrections, state)
            if not far <= allowed or abs(corrected.determinant) < DETERMINANT_TOL:
                return None
            state = [value - correction for value, correction in zip(state, corrected.corrections, strict=True)]
            if settled or far <= CLOSURE_TOL * size:
                return state, corrected
            settled = far <= CORRECTION_TOL * size
            allowed = MAX_FIRST_CORRECTION * size if settled else MAX_CORRECTION_RATIO * far

    def _largest_correction(self, corrections: Sequence[float], state: Sequence[float]) -> float:
        """The largest correction, as the path weighs changes."""
        n = self._angles
        far = (abs(a) / max(1.0, abs(b)) for a, b in zip(corrections[n:], state[n:], strict=True))
        return max(chain(map(abs, corrections[:n]), far), default=0.0)

    # ---- many poses -------------------------------------------------------------------------------------------

    def drives_and_state(self, travel: Array, state: Sequence[Array]) -> tuple[list[closure.DriveState], list[Any]]:
        """The drives of n poses, and their states as the closure has them."""
        drives = [closure.DriveState(self._angle_numbers(rate * travel) if turns else rate * travel, None)
                  for turns, rate in self.drives]
        return drives, [self._angle_numbers(value) if i < self._angles else value for i, value in enumerate(state)]

    def link_poses(self, known: Sequence[LinkPose], travel: Array, state: Sequence[Array]) -> list[LinkPose]:
        """Positions of the links in n poses for given states, without a correction."""
        return closure.pose_links(self.layout, known, self.arms, *self.drives_and_state(travel, state),
                                  moving=False)[len(known):]

    def step(self, known: Sequence[LinkPose], travel: Array, state: Sequence[Array],
             run: closure.TapeRun | None) -> tuple[Array, Array, list[LinkPose]]:
        """Newton's corrections of n poses, shape (unknowns, n), their determinants, and how the links lie then.

        With `run` it is done by the tape.
        """
        drives, numbers = self.drives_and_state(travel, state)
        if run:
            return self._replay_step(known, drives, numbers, run, len(travel))
        links = closure.pose_links(self.layout, known, self.arms, drives, numbers)
        newton_step = closure.step(closure.residual_rows(self.layout, links, self.arms, drives), self.unknowns, np.sqrt)
        closed = closure.apply_corrections(self.layout, numbers, newton_step.corrections)
        links = closure.pose_links(self.layout, known, self.arms, drives, closed, moving=False)[len(known):]
        return np.array(newton_step.corrections), np.broadcast_to(newton_step.determinant, travel.shape), links

    def _replay_step(self, known: Sequence[LinkPose], drives: Sequence[closure.DriveState], numbers: Sequence[Any],
                     run: closure.TapeRun,
                     n: int) -> tuple[Array, Array, list[LinkPose]]:
        """Compute Newton's step in n poses by the tape."""
        def arrays(vectors: Iterable[Any]) -> Iterator[Array]:
            for number in (number for vector in vectors for number in (vector if isinstance(vector, tuple)
                                                                       else (vector,))):
                yield number if isinstance(number, np.ndarray) else np.full(n, number)

        if self._still.shape[1] < n:
            self._still = np.repeat(np.array(self._flat)[:, None], n, axis=1)
        counted = self.layout.counted
        bases = (vector for body in known[1:]
                 for vector in (body.base, body.turn or (1.0, 0.0), *((body.angle,) if counted else ())))
        moving = (*(drive.at for drive in drives), *numbers)
        width = 5 if counted else 4
        rows = np.empty((self.unknowns + 1 + width * len(self.links), n))
        run.run([*arrays(bases), *self._still[:, :n], *arrays(moving)], list(rows))
        corrections, (determinant, *lies) = rows[: self.unknowns], rows[self.unknowns:]
        links = [LinkPose((x, y), (cos, sin), angle=angle[0] if angle else 0.0)
                 for x, y, cos, sin, *angle in zip(*(lies[i::width] for i in range(width)), strict=True)]
        return corrections, determinant, links


def state_slices(groups: Sequence[ClosureGroup]) -> list[slice]:
    """Slices of each group's unknowns among all unknowns."""
    counts = [group.unknowns for group in groups]
    return [slice(end - count, end) for count, end in zip(counts, accumulate(counts), strict=True)]


class _LayoutBuilder:
    """Finds the layout of one part."""

    def __init__(self, linkage: Linkage, part: tuple[str, ...]):
        self.linkage, self.part, self.carriers = linkage, linkage.members[part], linkage.carriers(part)
        bonds = [bond for link in self.part for bond in linkage.bonds[link]]
        self.arms: list[tuple[float, float]] = []
        self.ends: list[End] = []
        self.drives: list[tuple[bool, float]] = []
        self.turnings = [bond for bond in bonds if isinstance(bond, Turning)]
        self.joints: dict[tuple[Any, ...], list[Along]] = {}
        for bond in bonds:
            if isinstance(bond, Along):
                alone = (bond.direction,) if bond.way == TOUCHING else ()
                self.joints.setdefault((bond.link, bond.on, bond.at, *alone), []).append(bond)
        self.seated: list[str] = []
        seats = list(self._seats())
        self.place = {link: i for i, link in enumerate((FRAME, *self.carriers, *self.seated))}
        self.spins = tuple(self._spins())
        self.seats = tuple(self._seat(*seat) for seat in seats)
        self.closings = (*(closing for joint in self.joints.values() for closing in self._closings(joint)),
                         *(self._rolling_closing(bond) for bond in bonds
                           if isinstance(bond, CentreDistance | RackBond)))
        self.meshes = tuple(self._gear_mesh(bond) for bond in bonds if isinstance(bond, GearBond))

    def layout(self) -> GroupLayout:
        """The layout of the group: its places, closings, turnings and meshes."""
        turnings = tuple(Spin(self.place[bond.link], self.place[bond.on], self._enter_drive(True, float(bond.rate)))
                         for bond in self.turnings)
        return GroupLayout(1 + len(self.carriers), len(self.arms), tuple(turns for turns, _ in self.drives), self.spins,
                           self.seats, self.closings, turnings, self.meshes, self.linkage.counts_angles)

    def _spins(self) -> Iterator[Spin]:
        """Yield the turning of each link: with a link of known turning, or else by an unknown angle."""
        turning_links, remaining = {FRAME, *self.carriers}, dict.fromkeys(self.seated)
        while remaining:
            bond = next((bond for bond in self.turnings if (bond.link in turning_links) != (bond.on in turning_links)),
                        None)
            link = next(iter(remaining)) if bond is None else bond.link if bond.on in turning_links else bond.on
            del remaining[link]
            turning_links.add(link)
            if bond is None:
                yield Spin(self.place[link], None)
                continue
            self.turnings.remove(bond)
            reference, rate = (bond.on, float(bond.rate)) if link == bond.link else (bond.link, -float(bond.rate))
            yield Spin(self.place[link], self.place[reference], self._enter_drive(True, rate))

    def _seats(self) -> Iterator[tuple[str, list[Along]]]:
        """Yield rounds of links with the pair that places each, the whole pairs first; empty if no pair does."""
        placed_links = {FRAME, *self.carriers}
        while len(self.seated) < len(self.part):
            whole, half = ([(key, joint) for key, joint in self.joints.items()
                            if len(joint) == conditions
                            and (joint[0].link in placed_links) != (joint[0].on in placed_links)
                            and (conditions > 1 or not joint[0].rate)] for conditions in (2, 1))
            seats: dict[str, list[Along]] = {}
            for key, joint in whole or half[:1]:
                link = joint[0].on if joint[0].link in placed_links else joint[0].link
                if link not in seats:
                    seats[link] = self.joints.pop(key)
            if not seats:
                seats[next(link for link in self.part if link not in placed_links)] = []
            placed_links.update(seats)
            self.seated += seats
            for link, joint in seats.items():
                if joint:
                    self.linkage.origins[link] = self.linkage.places[joint[0].at]
                yield link, joint

    def _seat(self, link: str, joint: Sequence[Along]) -> Seat:
        """A link on the pair that seats it."""
        if not joint:
            return Seat(self.place[link], arm=self._arm(FRAME, self.linkage.origins[link], ""))
        bond = max(joint, key=lambda bond: bool(bond.rate))
        on = bond.on if link == bond.link else bond.link
        seat = Seat(self.place[link], self.place[on], self._arm(on, self.linkage.places[bond.at], bond.at))
        if len(joint) == 2 and not bond.rate:
            return seat
        direction = unit_direction(bond) if len(joint) == 2 else -1j * unit_direction(bond)
        rate = float(bond.rate) * (1 if link == bond.link else -1)
        drive = self._enter_drive(False, rate / self.linkage.reach) if len(joint) == 2 else None
        return seat._replace(guide=self.place[bond.to or bond.on], direction=self._guide_direction(bond, direction),
                             drive=drive)

    def _closings(self, joint: Sequence[Along]) -> Iterator[Closing]:
        """Yield the conditions that close a loop: a joint at once, or one statement after another."""
        bond = joint[0]
        at = self.linkage.places[bond.at]
        arm, on_arm = (self._arm(link, at, bond.at) for link in (bond.link, bond.on))
        closing = Closing(self.place[bond.link], arm, self.place[bond.on], on_arm)
        if len(joint) == 2 and not any(bond.rate for bond in joint):
            yield closing
            return
        for bond in joint:
            drive = self._enter_drive(False, float(bond.rate) / self.linkage.reach)
            yield closing._replace(guide=self.place[bond.to or bond.on],
                                   direction=self._guide_direction(bond, unit_direction(bond)),
                                   drive=drive)

    def _rolling_closing(self, bond: CentreDistance | RackBond) -> Closing:
        """The condition that closes a loop by a length: the distance of two centres, or the radius of a rolling
        wheel."""
        places, reach = self.linkage.places, self.linkage.reach
        far_point = bond.far_centre if isinstance(bond, CentreDistance) else bond.at
        closing = Closing(self.place[bond.link], self._arm(bond.link, places[bond.at], bond.at),
                          self.place[bond.on], self._arm(bond.on, places[far_point], far_point))
        if isinstance(bond, CentreDistance):
            return closing._replace(far=self._number(abs(places[bond.at] - places[far_point]) / reach))
        direction = self._enter_arm(unit_direction(bond), End(bond.on, bond.at, True))
        return closing._replace(guide=self.place[bond.on], direction=direction, lever=self._number(bond.lever / reach))

    def _gear_mesh(self, bond: GearBond) -> Mesh:
        """The mesh of a pair of gears; of its factors, and their sum, the largest is 1."""
        k1, k2 = bond.factors
        largest = max(abs(k1), abs(k2), abs(k1 + k2))
        carrier = self.linkage.lines.carriers[bond.arm]
        return Mesh(self.place[bond.link], self.place[bond.on], self.place[carrier],
                    self._number(k1 / largest, k2 / largest))

    def _number(self, one: float, other: float = 0.0) -> int:
        """Numbers that stand among the arms, and are on no link."""
        return self._enter_arm(complex(one, other), End("", "", False))

    def _arm(self, link: str, place: complex, at: str) -> int | None:
        """The arm from a link's base to a place, that of a point."""
        arm = (place - self.linkage.origins[link]) / self.linkage.reach
        return self._enter_arm(arm, End(link, at, False)) if arm else None

    def _guide_direction(self, bond: Along, way: complex) -> int:
        """A direction that is fixed to the guide's link."""
        return self._enter_arm(way, End(bond.to or bond.on, bond.at, True))

    def _enter_arm(self, arm: complex, end: End) -> int:
        self.arms.append((arm.real, arm.imag))
        self.ends.append(end)
        return len(self.arms) - 1

    def _enter_drive(self, turns: bool, rate: float) -> int | None:
        """Add a drive of this rate; None if it does not move."""
        if not rate:
            return None
        self.drives.append((turns, rate))
        return len(self.drives) - 1
