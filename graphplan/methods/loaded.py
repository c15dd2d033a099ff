"""The construction of a scene with loads: after the motion its forces, by polygons, by the lever, or by both.

Force plans in which errors grow are drawn in other ways, too, and the steadiest is kept; where a slide's reaction acts
is drawn if it lies near. Imported for scenes with loads alone.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator

from graphplan.errors import ConstructionError
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.passes import needed_steps
from graphplan.mechanism.model import Loads, Scene, TurningDrive
from graphplan.mechanism.units import metre
from graphplan.methods.acceleration import Normal
from graphplan.methods.construct import Draughtsman
from graphplan.methods.construction import Construction
from graphplan.methods.forces import Plans, Result, Way, arms, freed_reactions, levers, reactions, results, rubbed
from graphplan.methods.friction import Rubbed
from graphplan.methods.loading import Loading, force_scale
from graphplan.methods.network import Network
from graphplan.methods.panels import slide_named
from graphplan.methods.planner import Planner
from graphplan.methods.reactions import Shown
from graphplan.methods.readings import Reading
from graphplan.methods.statics import PREFERENCES
from graphplan.methods.styles import Style
from graphplan.methods.tempo import extent
from graphplan.methods.velocity import Velocity
from graphplan.methods.ways import EQUAL, growth, ways
from graphplan.phrases import said

NEAR = 2.0  # extents of the mechanism: where a slide's reaction acts further away, its line is not drawn
SMALL = 1e-6  # of the largest reaction: a slide's that is smaller has no line to speak of
MOST_PICKS = 4  # at how many places a trial of forces may begin
TEXTBOOK = "polygons", 0
UNSTEADY = 30.0  # growth of errors from which on force plans are drawn in other ways too, and weighed


class Loaded(Draughtsman):
    """Draws one scene with its forces, its groups planned in one way; `arms` are the slides whose lines are drawn."""

    def __init__(self, scene: Scene, planner: Planner, style: Style, plans: Plans, way: Way = TEXTBOOK,
                 arms: tuple[str, ...] = ()):
        super().__init__(scene, planner, style)
        assert scene.loads is not None
        self.loads: Loads = scene.loads
        self.style, self.plans, self.way, self.arms = style, plans, way, arms
        self.phi = force_scale(scene)
        self.shown: list[Shown] = []

    def finished(self, velocity: Velocity, plan: Normal | None) -> Construction:
        """Motion and forces; the accelerations are drawn for inertia forces, too."""
        if plan is None and self.loads.masses:
            plan = self.accelerations(velocity)
        self._forces(velocity, plan)
        shown = self._arrows()
        drawn = super().finished(velocity, plan)
        drawn.phi, drawn.shown = self.phi, shown
        return drawn

    def _forces(self, velocity: Velocity, plan: Normal | None) -> None:
        """Force plans and lever, as the style says."""
        loading = Loading(self.board, self.net, self.pose, self.phi, self.tempo.unit, plan, self.style.inertia)
        if self.style.polygons:
            self._polygons(velocity, loading)
        if self.style.lever or self.scene.repeating:
            self._note(*levers(self.pose, velocity, loading))
            if not self.style.polygons:
                self._note(*freed_reactions(self.pose, loading))

    def _polygons(self, velocity: Velocity, loading: Loading) -> None:
        """The reactions and the balances, group by group against the motion's order; and once more with friction."""
        forces = reactions(self.board, self.pose, loading, self.plans, self.way)
        self._note(results(self.scene, loading, forces, self.board), forces.shown)
        self._note(arms(self.scene, forces, self.board, self.pose, self.arms), ())
        if self.loads.frictions and self._in_motion:
            loading.rubbing = Rubbed(self.board, velocity, loading, forces)
            second = reactions(self.board, self.pose, loading, self.plans, self.way, forces)
            self._note(rubbed(loading, second), second.shown)
            loading.rubbing = None

    @property
    def _in_motion(self) -> bool:
        """Whether any drive moves: at rest friction has no sense."""
        return any(d.omega if isinstance(d, TurningDrive) else d.speed for d in self.scene.drives)

    def _note(self, found: Iterable[Result], shown: Iterable[Shown]) -> None:
        """Keep results, and the arrows that show them."""
        self.shown += shown
        for kind, of, marks in found:
            self.read(kind, of, *marks)

    def _arrows(self) -> tuple[Reading, ...]:
        """The forces drawn as arrows: of those that what is asked for needs."""
        needed = needed_steps(self.board, self.marks)
        found = []
        for force in dict.fromkeys(self.shown):
            head = force.head if force.of is None else force.of
            if force.tail is not force.head and {head.step.index, force.tail.step.index} <= needed:
                start = len(self.marks)
                self.marks += [force.tail, force.head]
                found.append(Reading(force.kind, force.label, (start, start + 1)))
        return tuple(found)


def loaded_constructions(scene: Scene, method: str, style: Style) -> Iterator[Construction]:
    """The constructions of a scene with loads, best first: by the ways through its motion, each with its forces."""
    plans = Plans(scene)
    found = ways(Network(scene), method, lambda planner: Loaded(scene, planner, style, plans).draw())
    for best, planner in found:
        yield _steadiest(best, planner, style, plans) if style.polygons else best


def _steadiest(found: Construction, planner: Planner, style: Style, plans: Plans) -> Construction:
    """The construction with its forces drawn well: if errors grow in their plans, other ways are weighed against it."""
    scene, way = found.scene, TEXTBOOK
    if growth(found.program) >= UNSTEADY:
        drawn = {TEXTBOOK: found}
        for other in ((order, pick) for order in PREFERENCES for pick in range(MOST_PICKS)):
            if other not in drawn and other[1] < plans.options:
                drawn[other] = Loaded(scene, planner, style, plans, other).draw()
        grown = {other: growth(construction.program) for other, construction in drawn.items()}
        least = EQUAL * min(grown.values())
        way = min(drawn, key=lambda other: (max(grown[other], least), len(drawn[other].program)))
        drawn[way].notes, found = found.notes, drawn[way]
    return _with_arms(found, lambda names: Loaded(scene, planner, style, plans, way, names).draw())


def _with_arms(found: Construction, draw: Callable[[tuple[str, ...]], Construction]) -> Construction:
    """The construction with the points where slides' reactions act, as far as they lie near; the others are told."""
    try:
        values = found.read(Floats())
    except ConstructionError:
        return found
    slides, moments = values.get("slide reaction", {}), values.get("slide moment", {})
    sizes = {name: math.hypot(*force) for name, force in slides.items()}
    least = SMALL * max((math.hypot(*force) for force in (*values.get("reaction", {}).values(), *slides.values())),
                        default=0.0)
    reach = NEAR * extent(found.scene) / float(metre(found.scene.units))
    near = tuple(name for name, size in sizes.items() if size > least and abs(moments[name]) <= reach * size)
    drawn = draw(near) if near else found
    drawn.notes = found.notes + [
        said("slide {0}: its reaction is small beside its moment; it is told as a force and a couple, not by its line",
             slide_named(slide))
        for slide in found.scene.slides
        if slide.name in sizes and slide.name not in near and abs(moments[slide.name]) > least * reach]
    return drawn
