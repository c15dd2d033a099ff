"""The construction of a scene with loads: after the motion its forces, by polygons, by the lever, or by both.

Force plans in which errors grow are drawn in other ways, too, and the steadiest is kept; where a slide's reaction acts
is drawn if it lies near. Imported for scenes with loads alone.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from graphplan.errors import ConstructionError, Refused
from graphplan.kernel.numbers import Floats
from graphplan.kernel.passes import freeze, needed_steps
from graphplan.kernel.program import Board, Mark, evaluate
from graphplan.mechanism.model import Find, Loads, Scene
from graphplan.mechanism.units import metre
from graphplan.methods.construction import Construction, ForceArrow
from graphplan.methods.draughtsman import Draughtsman
from graphplan.methods.forces import groups
from graphplan.methods.forces.free_bodies import DrawnForces, Shown
from graphplan.methods.forces.friction import Rubbed
from graphplan.methods.forces.groups import ForceTransfer, Result, Way
from graphplan.methods.forces.higher_pairs import pushing
from graphplan.methods.forces.lever import Levers
from graphplan.methods.forces.loading import Loading, force_scale
from graphplan.methods.forces.stages import in_round
from graphplan.methods.forces.statics import PREFERENCES
from graphplan.methods.kinds import REACTION, SLIDE_MOMENT, SLIDE_REACTION
from graphplan.methods.motion.acceleration import Normal
from graphplan.methods.motion.alternatives import EQUAL, NetworkPlans, alternatives, growth
from graphplan.methods.motion.network import Network
from graphplan.methods.motion.planner import Planner
from graphplan.methods.motion.velocity import Velocity
from graphplan.methods.panels import Style, link_named, pair_text, slide_named
from graphplan.methods.tolerances import CONTROL_TOL, REACTION_TOL, SHORT_FORCE
from graphplan.phrases import Phrase, Said, phrase, said

MAX_ARM_EXTENTS = 2.0  # extents of the mechanism: where a slide's reaction acts further away, its line is not drawn
MOST_PICKS = 4  # at how many places a trial of forces may begin
TEXTBOOK = "polygons", 0
MOST_FAILURES = 3  # ways of a motion whose forces could not be drawn, before no more are tried
MOST_ROUNDS = 8  # of friction: near to locking they may never stand
UNSTEADY = 30.0  # growth of errors from which on force plans are drawn in other ways too, and weighed


class Loaded(Draughtsman):
    """Draws one scene with its forces, its groups planned in one way; `arms` are the slides whose lines are drawn.

    `by_lever` are the pairs whose reactions levers are to find, where no polygons are drawn.
    """

    def __init__(self, scene: Scene, planner: Planner, style: Style, plans: ForceTransfer, way: Way = TEXTBOOK,
                 arms: tuple[str, ...] = (), by_lever: tuple[str, ...] = ()):
        super().__init__(scene, planner, style)
        assert scene.loads is not None
        self.loads: Loads = scene.loads
        self.style, self.plans, self.way, self.arms, self.by_lever = style, plans, way, arms, by_lever
        self.phi = style.phi or force_scale(scene)
        self.shown: list[Shown] = []
        self.notes: list[str] = []
        self.rounds = 0

    def finish(self, velocity: Velocity, plan: Normal | None) -> Construction:
        """Motion and forces; the accelerations are drawn for inertia forces, too."""
        if plan is None and self.loads.masses:
            plan = self.accelerations(velocity)
        self._forces(velocity, plan)
        shown = force_arrows(self.board, self.marks, self.shown)
        drawn = super().finish(velocity, plan)
        return replace(drawn, phi=self.phi, force_arrows=shown, rounds=self.rounds, notes=[*drawn.notes, *self.notes])

    def _forces(self, velocity: Velocity, plan: Normal | None) -> None:
        """Force plans and lever, as the style says."""
        loading = Loading(self.board, self.net, self.pose, self.phi, self.tempo.unit, plan, self.style.inertia)
        loading.apart = frozenset((*self._shifted_too_far(loading), *self._percussion_too_far(loading)))
        if self.style.polygons:
            self._polygons(velocity, loading)
        if self.style.lever or self.scene.repeating:
            levers = Levers(self.pose, velocity, loading, self.plans).balances()
            if not self.style.polygons:
                levers.reactions(self.by_lever)
                self.notes += levers.notes
                if _rubs(self.scene):
                    self.notes.append(said("friction is not drawn: force polygons alone have it; its results "
                                           "are the analytic solver's"))
            self._note(levers.results, levers.shown)

    def _shifted_too_far(self, loading: Loading) -> Iterator[str]:
        """The links whose inertia force would be shifted too far, or is nothing beside its couple."""
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
        """The links whose acceleration centre is in the mass centre, or nowhere, or that of percussion too far off."""
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
        self._note(groups.results(self.scene, loading, forces, self.board), forces.shown)
        self.notes += self._pulling(forces)
        self._note(groups.arms(self.scene, forces, self.board, self.pose, self.arms), ())
        if _rubs(self.scene) and not self.scene.repeating:
            forces = self._rounds(velocity, loading, forces)
        if self.loads.screws:
            before = len(forces.shown)
            self._note([*groups.screw_moments(velocity, loading, forces)], ())
            self.shown += forces.shown[before:]

    def _draw_arms(self, forces: DrawnForces) -> None:
        """The arms of the forces that balancing moments oppose."""
        for moment in forces.about_centres.values():
            own, shortest = "h'" if forces.number else "h", CONTROL_TOL * self.scene.extent
            for letter, force, foot in moment.arms(self.board, self._mark_values, own, shortest):
                forces.shown.append(Shown("arm", letter, moment.centre, foot, force.head))

    def _pulling(self, forces: DrawnForces) -> Iterator[Said]:
        """What is said of the contacts whose links would part in this pose."""
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
        asked = self.loads.rounds or MOST_ROUNDS
        while forces.number < asked and not stands:
            with self.board.on(retell=partial(in_round, forces.number + 1)):
                forces = groups.reactions(self.board, rubbed.pose, loading, self.plans.rough, self.way, forces)
            with self.board.on(retell=partial(in_round, forces.number + 1)):
                rubbed, last = Rubbed(velocity, loading, forces), rubbed
            self.shown += forces.shown
            try:
                stands = not self.loads.rounds and last.stands(rubbed, self._mark_values)
            except ConstructionError:  # whoever reads the numbers is told
                break
        before = len(forces.shown)
        self._draw_arms(forces)
        self._note(groups.results_with_friction(self.scene, loading, forces, self.board), forces.shown[before:])
        self.rounds = forces.number
        if self.loads.rounds:
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


def _rubs(scene: Scene) -> bool:
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


def loaded_constructions(scene: Scene, method: str, style: Style) -> Iterator[Construction]:
    """The constructions of a scene with loads, best first: by the ways through its motion, each with its forces."""
    forces = Alternatives(scene, style)
    for best, planner in alternatives(NetworkPlans(scene, method), forces.draw):
        yield forces.steadiest(best, planner)


def plainly_loaded(scene: Scene, method: str, style: Style) -> Construction:
    """The force polygons by the first way through the motion and the forces, drawable in this pose or not."""
    planner = Planner(Network(scene), method)
    planner.plan()
    return Loaded(scene, planner, replace(style, lever=False, polygons=True), ForceTransfer(scene)).draw()


class Alternatives:
    """Draws the forces of a scene as is asked for; where the lever or the polygons cannot serve, by the other."""

    def __init__(self, scene: Scene, style: Style):
        self.scene, self.plans = scene, ForceTransfer(scene)
        self.style = replace(style, polygons=style.polygons or _rubs(scene))
        self.added = self.style.polygons > style.polygons
        self.chosen: dict[Planner, Style] = {}
        self.wary = False  # a way of the motion has failed: of others the motion is tried first
        self.hopeless: list[tuple[Construction, Style]] = []  # forces that could not be drawn, though the motion could

    def draw(self, planner: Planner) -> Construction:
        """The first construction that can be drawn in this pose, which says what it leaves out, and why.

        Where there is none it is the first at all; fails with `Refused` where not even that is planned.
        """
        if len(self.hopeless) >= MOST_FAILURES:  # another way of the motion is no help
            drawing, self.chosen[planner] = self.hopeless[0]
            return drawing
        if self.wary and _singular(motion := self._motion(planner)):
            return motion
        first: tuple[Construction, Style] | None = None
        faults: list[Refused | ConstructionError] = []
        for style, missing in self._styles():
            self.chosen[planner] = style
            try:
                drawing = self._draw_by(planner, style)
                if _singular(drawing) and style.polygons:
                    drawing = self._by_best_way(drawing, planner)[0]
            except Refused as refused:
                faults.append(refused)
                continue
            singular = _singular(drawing)
            if singular is None:
                drawing.notes.extend([missing(faults[-1].why)] if faults else [])
                if self.added and style.polygons:
                    drawing.notes.append(said("friction: force polygons alone have it, so they are drawn, too"))
                return drawing
            if not faults and _singular(self._motion(planner)):
                self.wary = True
                return drawing
            first = first or (drawing, style)
            faults.append(singular)
        if first is None:
            raise faults[0]
        self.hopeless.append(first)
        drawing, self.chosen[planner] = first
        return drawing  # whoever reads the numbers is told

    def _motion(self, planner: Planner) -> Construction:
        """The motion alone: where it cannot be drawn this way no other forces help."""
        every = tuple(point for point, links in self.scene.links_of.items() if links)
        bare = replace(self.scene, loads=None, find=Find(every, every))
        return Draughtsman(bare, planner, self.style).draw()

    def _styles(self) -> Iterator[tuple[Style, Phrase]]:
        """The style that is asked for, and others in its place, each with what it leaves out."""
        no_lever, no_polygons = phrase("no lever: {0}"), phrase("no force polygons: {0}")
        yield self.style, no_lever
        if self.style.lever:
            yield replace(self.style, lever=False, polygons=True), no_lever
        if self.style.polygons:
            yield replace(self.style, lever=True, polygons=False), no_polygons

    def _draw_by(self, planner: Planner, style: Style, way: Way = TEXTBOOK, arms: tuple[str, ...] = ()) -> Construction:
        return Loaded(self.scene, planner, style, self.plans, way, arms, self._by_lever).draw()

    @property
    def _by_lever(self) -> tuple[str, ...]:
        """The pairs whose reactions levers find, where no polygons do: if levers are asked for those that are named."""
        asked = self.scene.find.reactions
        if asked is None and self.style.polygons:
            return (*self.scene.joints, *(slide.name for slide in self.scene.slides))
        return asked or ()

    def steadiest(self, drawing: Construction, planner: Planner) -> Construction:
        """The construction with its force plans, if it has any, drawn well."""
        style = self.chosen.get(planner)
        if style is None:  # of a motion that cannot be drawn: whoever reads the numbers is told
            return self._draw_by(planner, self.style)
        if not style.polygons:
            return drawing
        drawing, way = self._by_best_way(drawing, planner)
        return _with_arms(drawing, lambda names: self._draw_by(planner, style, way, names))

    def _by_best_way(self, drawing: Construction, planner: Planner) -> tuple[Construction, Way]:
        """If errors grow in the force plans other ways are weighed against this one; the best, and which it is."""
        if growth(drawing.program) < UNSTEADY:
            return drawing, TEXTBOOK
        drawn = {TEXTBOOK: drawing}
        for way in ((order, pick) for order in PREFERENCES for pick in range(MOST_PICKS)):
            if way not in drawn and way[1] < self.plans.options:
                drawn[way] = self._draw_by(planner, self.chosen[planner], way)
        grown = {way: growth(construction.program) for way, construction in drawn.items()}
        least = EQUAL * min(grown.values())
        way = min(drawn, key=lambda way: (max(grown[way], least), len(drawn[way].program)))
        return replace(drawn[way], notes=drawing.notes), way


def _singular(drawing: Construction) -> ConstructionError | None:
    """Why the construction cannot be drawn in this pose, if it cannot."""
    try:
        drawing.read(Floats())
    except ConstructionError as error:
        return error
    return None


def _with_arms(drawing: Construction, draw: Callable[[tuple[str, ...]], Construction]) -> Construction:
    """The construction with the points where slides' reactions act, as far as they lie near; the others are told."""
    try:
        values = drawing.read(Floats())
    except ConstructionError:
        return drawing
    slides, moments = values.get(SLIDE_REACTION, {}), values.get(SLIDE_MOMENT, {})
    sizes = {name: math.hypot(*force) for name, force in slides.items()}
    least = REACTION_TOL * max((math.hypot(*force) for force in (*values.get(REACTION, {}).values(), *slides.values())),
                               default=0.0)
    size = drawing.scene.extent
    least = max(least, SHORT_FORCE * size / float(drawing.phi))
    reach = MAX_ARM_EXTENTS * size / float(metre(drawing.scene.units))
    near = tuple(name for name, size in sizes.items() if size > least and abs(moments[name]) <= reach * size)
    drawn = draw(near) if near else drawing
    return replace(drawn, notes=drawing.notes + [
        said("slide {0}: its reaction is small compared with its moment; it is given as a force and a couple, not by "
             "its line of action", slide_named(slide))
        for slide in drawing.scene.slides
        if slide.name in sizes and slide.name not in near and abs(moments[slide.name]) > least * reach])
