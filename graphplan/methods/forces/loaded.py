"""The construction of a scene with loads: after the motion its forces, by polygons, by the lever, or by both.

Where a slide's reaction acts is drawn if it lies near. Imported for scenes with loads alone.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from graphplan.errors import ConstructionError
from graphplan.kernel.numbers import Floats
from graphplan.kernel.passes import freeze, needed_steps
from graphplan.kernel.program import Board, Mark, evaluate
from graphplan.mechanism.model import Loads, Scene
from graphplan.mechanism.units import metre
from graphplan.methods.construction import Construction, ForceArrow
from graphplan.methods.design import TEXTBOOK, Design
from graphplan.methods.draughtsman import Draughtsman
from graphplan.methods.forces import groups
from graphplan.methods.forces.free_bodies import DrawnForces, Shown
from graphplan.methods.forces.friction import Rubbed
from graphplan.methods.forces.groups import ForceTransfer, Result
from graphplan.methods.forces.higher_pairs import pushing
from graphplan.methods.forces.lever import Levers
from graphplan.methods.forces.loading import Loading, force_scale
from graphplan.methods.forces.stages import in_round
from graphplan.methods.kinds import REACTION, SLIDE_MOMENT, SLIDE_REACTION
from graphplan.methods.motion.acceleration import Normal
from graphplan.methods.motion.planner import Planner
from graphplan.methods.motion.velocity import Velocity
from graphplan.methods.panels import link_named, pair_text, slide_named
from graphplan.methods.recorded import ReadableDrawing, Reading
from graphplan.methods.tolerances import CONTROL_TOL, REACTION_TOL, SHORT_FORCE
from graphplan.phrases import Said, said

MAX_ARM_EXTENTS = 2.0  # extents of the mechanism: where a slide's reaction acts further away, its line is not drawn
MOST_ROUNDS = 8  # of friction: near to locking they may never stand


class Loaded(Draughtsman):
    """Draws one scene with its forces; `transfer` has the plans of its groups."""

    def __init__(self, scene: Scene, planner: Planner, design: Design, transfer: ForceTransfer):
        super().__init__(scene, planner, design)
        assert scene.loads is not None
        self.loads: Loads = scene.loads
        self.phi = design.phi or force_scale(scene)
        self.design, self.plans, self.way = replace(self.design, phi=self.phi), transfer, design.group_way or TEXTBOOK
        self.shown: list[Shown] = []
        self.notes: list[str] = []
        self.without_lines: list[str] = []
        self.rounds = 0

    @property
    def _needs_velocities(self) -> bool:
        return self.design.lever or needs_motion(self.scene)

    def finish(self, velocity: Velocity, plan: Normal | None) -> Construction:
        """Motion and forces; the accelerations are drawn for inertia forces, too."""
        if plan is None and self.loads.masses:
            plan = self.accelerations(velocity)
        self._forces(velocity, plan)
        shown = force_arrows(self.board, self.marks, self.shown)
        drawn = super().finish(velocity, plan)
        return replace(drawn, force_arrows=shown, rounds=self.rounds,
                       notes=[*drawn.notes, *self.notes, *self.without_lines])

    def _forces(self, velocity: Velocity, plan: Normal | None) -> None:
        """Force plans and lever, as the design says."""
        loading = Loading(self.board, self.net, self.pose, self.phi, self.tempo.unit, plan, self.design.inertia)
        loading.apart = frozenset((*self._shifted_too_far(loading), *self._percussion_too_far(loading)))
        if self.design.polygons:
            self._polygons(velocity, loading)
        if self.design.lever or self.scene.repeating:
            levers = Levers(self.pose, velocity, loading, self.plans).balances()
            if not self.design.polygons:
                levers.reactions(self._by_lever)
                self.notes += levers.notes
                if rubs(self.scene):
                    self.notes.append(said("friction is not drawn: force polygons alone have it; its results "
                                           "are the analytic solver's"))
            self._note(levers.results, levers.shown)

    def _shifted_too_far(self, loading: Loading) -> Iterator[str]:
        """Yield the links whose inertia force would be shifted too far, or is negligible relative to its couple."""
        size = self.scene.extent
        for link, marks in loading.shifts():
            try:
                home, end, P, R, tip = self._mark_values(marks)
            except ConstructionError:  # whoever reads the numbers is told
                return
            force = math.dist(home, end)
            couple = abs((R[0] - P[0]) * (tip[1] - end[1]) - (R[1] - P[1]) * (tip[0] - end[0]))
            if force <= SHORT_FORCE * size or couple > MAX_ARM_EXTENTS * size * force:
                yield link
                if couple > SHORT_FORCE * size * size:
                    self.notes.append(said("{0}: its inertia force is small compared with its couple; they are not "
                                           "combined", link_named(link)))

    def _percussion_too_far(self, loading: Loading) -> Iterator[str]:
        """Yield the links whose acceleration centre is in the mass centre, or at infinity, or whose centre of
        percussion is too far off."""
        size = self.scene.extent
        for link, square, *marks in loading.percussions():
            try:
                arm = math.dist(*self._mark_values(marks))
            except ConstructionError:  # all its points have one acceleration
                arm = 0.0
            if arm <= SHORT_FORCE * size or square > MAX_ARM_EXTENTS * size * arm:
                yield link
                self.notes.append(said("{0}: its centre of percussion is too far off; its inertia force stays at the "
                                       "mass centre, with its couple", link_named(link)))

    def _polygons(self, velocity: Velocity, loading: Loading) -> None:
        """The reactions and the balances, group by group against the motion's order; and once more with friction."""
        forces = groups.reactions(self.board, self.pose, loading, self.plans, self.way)
        self._draw_arms(forces)
        found = [*groups.results(self.scene, loading, forces, self.board)]
        self._note(found, forces.shown)
        self.notes += self._pulling(forces)
        self._note(groups.arms(self.scene, forces, self.board, self.pose, self._near_lines(found)), ())
        if rubs(self.scene) and not self.scene.repeating:
            forces = self._rounds(velocity, loading, forces)
        if self.loads.screws:
            before = len(forces.shown)
            self._note([*groups.screw_moments(velocity, loading, forces)], ())
            self.shown += forces.shown[before:]

    @property
    def _by_lever(self) -> tuple[str, ...]:
        """The pairs whose reactions levers find, where no polygons do: those that are named, or all."""
        if self.design.all_by_lever and self.scene.find.reactions is None:
            return (*self.scene.joints, *(slide.name for slide in self.scene.slides))
        return self.scene.find.reactions or ()

    def _near_lines(self, found: Sequence[Result]) -> tuple[str, ...]:
        """The slides whose reactions act near enough for their lines to be drawn; the others are told."""
        try:
            values = self._numbers(found)
        except ConstructionError:  # whoever reads the numbers is told
            return ()
        slides, moments = values.get(SLIDE_REACTION, {}), values.get(SLIDE_MOMENT, {})
        sizes = {name: math.hypot(*force) for name, force in slides.items()}
        reactions = (*values.get(REACTION, {}).values(), *slides.values())
        least = max(REACTION_TOL * max((math.hypot(*force) for force in reactions), default=0.0),
                    SHORT_FORCE * self.scene.extent / float(self.phi))
        reach = MAX_ARM_EXTENTS * self.scene.extent / float(metre(self.scene.units))
        near = tuple(name for name, size in sizes.items() if size > least and abs(moments[name]) <= reach * size)
        self.without_lines += [
            said("slide {0}: its reaction is small compared with its moment; it is given as a force and a couple, not "
                 "by its line of action", slide_named(slide))
            for slide in self.scene.slides
            if slide.name in sizes and slide.name not in near and abs(moments[slide.name]) > least * reach]
        return near

    def _numbers(self, found: Sequence[Result]) -> dict[str, dict[str, Any]]:
        """Results in numbers of this pose, by kind and name."""
        marks, results = list[Mark](), list[Reading]()
        for kind, of, own in found:
            results.append(Reading(kind, of, tuple(range(len(marks), len(marks) + len(own)))))
            marks += own
        drawn = ReadableDrawing(freeze(self.board, marks), self.scene, self.design, tuple(results), turned=False)
        return drawn.read(Floats())

    def _draw_arms(self, forces: DrawnForces) -> None:
        """The arms of the forces that balancing moments oppose."""
        for moment in forces.about_centres.values():
            own, shortest = "h'" if forces.number else "h", CONTROL_TOL * self.scene.extent
            for letter, force, foot in moment.arms(self.board, self._mark_values, own, shortest):
                forces.shown.append(Shown("arm", letter, moment.centre, foot, force.head))

    def _pulling(self, forces: DrawnForces) -> Iterator[Said]:
        """Yield the remarks on contacts whose links would separate in this pose."""
        for contact in self.scene.contacts:
            span = groups.touching_force(forces, self.board, contact)
            way = pushing(contact, self.scene.points)
            if span is None or way is None or span[0] is span[1]:
                continue
            try:
                tail, head = self._mark_values(span)
            except ConstructionError:  # whoever reads the numbers is told
                return
            if (head[0] - tail[0]) * way[0] + (head[1] - tail[1]) * way[1] < -SHORT_FORCE * self.scene.extent**2:
                yield said("the contact of {0} can only push, and its force pulls: something else must press them "
                           "together, such as a spring", pair_text(contact.links))

    def _rounds(self, velocity: Velocity, loading: Loading, forces: DrawnForces) -> DrawnForces:
        """The forces of the last round of friction, of as many as are asked for, or until they stand."""
        rubbed, stands = Rubbed(velocity, loading, forces), False
        wished = self.scene.sheet.rounds
        while forces.number < (wished or MOST_ROUNDS) and not stands:
            with self.board.on(retell=partial(in_round, forces.number + 1)):
                forces = groups.reactions(self.board, rubbed.pose, loading, self.plans.rough, self.way, forces)
            with self.board.on(retell=partial(in_round, forces.number + 1)):
                rubbed, last = Rubbed(velocity, loading, forces), rubbed
            self.shown += forces.shown
            try:
                stands = not wished and last.stands(rubbed, self._mark_values)
            except ConstructionError:  # whoever reads the numbers is told
                break
        before = len(forces.shown)
        self._draw_arms(forces)
        self._note(groups.results_with_friction(self.scene, loading, forces, self.board), forces.shown[before:])
        self.rounds = forces.number
        if wished:
            self.notes.append(said("friction: rounds drawn, as asked: {0}", forces.number))
        elif stands:
            self.notes.append(said("friction: the forces no longer change after round {0}", forces.number))
        else:
            self.notes.append(said("friction: the forces still change after {0} rounds", forces.number))
        return forces

    def _mark_values(self, marks: Sequence[Mark]) -> list[Any]:
        """The values of marks in this pose."""
        program = freeze(self.board, marks)
        values = evaluate(program, Floats())
        return [values[index] for index in program.wanted]

    def _note(self, found: Iterable[Result], shown: Iterable[Shown]) -> None:
        """Keep results, and the arrows that show them."""
        self.shown += shown
        for kind, of, marks in found:
            self.read(kind, of, *marks)


def needs_motion(scene: Scene) -> bool:
    """Whether velocities are asked for, or the forces of polygons need them: for inertia, friction and screws."""
    assert scene.loads is not None
    loads = scene.loads
    return bool(scene.find.asks_motion or scene.repeating or loads.masses or loads.screws or rubs(scene))


def rubs(scene: Scene) -> bool:
    """Whether there is friction: at rest it has no sense."""
    assert scene.loads is not None
    return bool(scene.loads.frictions) and any(drive.rate for drive in scene.drives)


def force_arrows(board: Board, marks: list[Mark], shown: Iterable[Shown]) -> tuple[ForceArrow, ...]:
    """The forces drawn as arrows, of those that the wanted marks need; their own marks become wanted, too."""
    needed = needed_steps(board, marks)
    arrows = []
    for force in dict.fromkeys(shown):
        head = force.head if force.of is None else force.of
        if force.tail is not force.head and {head.step.index, force.tail.step.index} <= needed:
            start = len(marks)
            marks += [force.tail, force.head]
            arrows.append(ForceArrow(force.kind, force.label, (start, start + 1)))
    return tuple(arrows)
