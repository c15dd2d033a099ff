"""From a scene to its construction: plan the moves, draw the plans, freeze what is wanted."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import combinations

from graphplan.errors import ConstructionError, Refused
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.passes import freeze, needed_steps
from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import FRAME, Number, Scene, TurningDrive
from graphplan.mechanism.units import metre
from graphplan.methods.acceleration import Normal, PolarAcceleration
from graphplan.methods.construction import ACCELERATION, VELOCITY, Construction, Reading
from graphplan.methods.forces import arms, freed_reactions, levers, reactions, results, rubbed
from graphplan.methods.friction import Rubbed
from graphplan.methods.loading import Loading, force_scale
from graphplan.methods.moves import Move, Pole, Trial
from graphplan.methods.network import Network
from graphplan.methods.plan import Plan
from graphplan.methods.planner import Planner
from graphplan.methods.poses import Pose
from graphplan.methods.reactions import Forces, Shown
from graphplan.methods.statics import PREFERENCES
from graphplan.methods.tempo import extent, tempo
from graphplan.methods.velocity import Orthogonal, Polar, Velocity
from graphplan.methods.ways import EQUAL, best_way, growth


def in_motion(scene: Scene) -> bool:
    """Whether any drive moves: at rest friction has no sense."""
    return any(d.omega if isinstance(d, TurningDrive) else d.speed for d in scene.drives)


class Draughtsman:
    """Draws one scene by one list of moves, and says what can be read from it."""

    def __init__(self, scene: Scene, planner: Planner, style: Style, order: str = "polygons", pick: int = 0,
                 arms: tuple[str, ...] = ()):
        self.scene, self.net, self.style, self.order, self.pick = scene, planner.net, style, order, pick
        self.arms = arms
        self.polar = style.polar
        self.board = Board()
        self.pose = Pose(self.board, scene, {new: at for (at, _), new in self.net.coincident.items()})
        self.tempo = tempo(scene)
        self.moves = planner.moves
        self.phi: Number = 1
        self.options = 1
        self.shown: list[Shown] = []
        self.marks: list[Mark] = []
        self.readings: list[Reading] = []

    def draw(self) -> Construction:
        velocity = (Polar if self.polar else Orthogonal)(self.board, self.net, self.pose, self.tempo)
        velocity.draw(self.moves)
        self._points(velocity, VELOCITY, self.scene.find.velocity)
        self._links(velocity, "omega", self.scene.find.velocity)
        self._slides(velocity, "slide velocity", self.scene.find.velocity)
        plan = self._accelerations(velocity) if self._accelerated() else None
        if self.scene.loads is not None:
            self._forces(velocity, plan)
        shown = self._arrows()
        program = freeze(self.board, self.marks)
        return Construction(self.scene, self.tempo, program, tuple(self.readings), not self.polar, _ways(self.moves),
                            phi=self.phi, shown=shown)

    def _friction(self, velocity: Velocity, loading: Loading, forces: Forces) -> None:
        """The same force plans with the friction of the reactions among the loads, for the balances alone."""
        loading.rubbing = Rubbed(self.board, velocity, loading, forces)
        second, _ = reactions(self.board, self.pose, loading, self.order, self.pick, forces)
        self.shown += second.shown
        for kind, of, marks in rubbed(loading, second):
            self._read(kind, of, *marks)
        loading.rubbing = None

    def _arrows(self) -> tuple[Reading, ...]:
        """The forces drawn as arrows: of those that what is asked for needs."""
        needed = needed_steps(self.board, self.marks)
        found = []
        for force in dict.fromkeys(self.shown):
            if force.tail is not force.head and {force.tail.step.index, force.head.step.index} <= needed:
                start = len(self.marks)
                self.marks += [force.tail, force.head]
                found.append(Reading(force.kind, force.label, (start, start + 1)))
        return tuple(found)

    def _accelerated(self) -> bool:
        """Whether accelerations are asked for, or make inertia forces."""
        loads = self.scene.loads
        return bool(self.scene.find.acceleration or (loads is not None and loads.masses))

    def _accelerations(self, velocity: Velocity) -> Normal:
        kind = PolarAcceleration if self.polar else Normal
        plan = kind(self.board, self.net, self.pose, velocity, self.moves)
        plan.draw(self.moves)
        self._points(plan, ACCELERATION, self.scene.find.acceleration)
        self._links(plan, "alpha", self.scene.find.acceleration)
        self._slides(plan, "slide acceleration", self.scene.find.acceleration)
        return plan

    def _forces(self, velocity: Velocity, plan: Normal | None) -> None:
        """The reactions and the balance, group by group against the motion's order."""
        self.phi = force_scale(self.scene)
        loading = Loading(self.board, self.net, self.pose, self.phi, self.tempo.unit, plan,
                          self.style.inertia)
        if self.style.polygons:
            forces, self.options = reactions(self.board, self.pose, loading, self.order, self.pick)
            self.shown += forces.shown
            for kind, of, marks in results(self.scene, loading, forces, self.board):
                self._read(kind, of, *marks)
            for kind, of, marks in arms(self.scene, forces, self.board, self.pose, self.arms):
                self._read(kind, of, *marks)
            if loading.loads.frictions and in_motion(self.scene):
                self._friction(velocity, loading, forces)
        if self.style.lever:
            found, shown = levers(self.pose, velocity, loading)
            if not self.style.polygons:
                freed, more = freed_reactions(self.pose, loading)
                found, shown = found + freed, shown + more
            self.shown += shown
            for kind, of, marks in found:
                self._read(kind, of, *marks)

    def _read(self, kind: str, of: str, *marks: Mark) -> None:
        start = len(self.marks)
        self.marks.extend(marks)
        self.readings.append(Reading(kind, of, tuple(range(start, len(self.marks)))))

    def _points(self, plan: Plan, kind: str, names: tuple[str, ...]) -> None:
        for name in names:
            place = (name, "")
            if place not in plan.ends:
                raise Refused(f"point {name}", "no construction known here reaches it", "ask for other points")
            self._read(kind, name, plan.home(place), plan.ends[place])

    def _links(self, plan: Plan, kind: str, asked: tuple[str, ...]) -> None:
        """The turning of each link of which two points are asked for, or one and another's motion is given."""
        for link in self.scene.moving:
            known = {*asked, *self.scene.motions}
            names = [p for p in self.scene.links[link] if p in known or FRAME in self.scene.links_of[p]]
            names = [p for p in names if (p, "") in plan.ends]
            P, R = max(combinations(names, 2), key=lambda pair: self._apart(*pair), default=("", ""))
            if set(names) & set(asked) and self._apart(P, R):
                vectors = [mark for p in (P, R) for mark in (plan.home((p, "")), plan.ends[p, ""])]
                self._read(kind, link, self.pose.points[P], self.pose.points[R], *vectors)

    def _apart(self, P: str, R: str) -> float:
        """How far apart two points are: a link's turning is read off its longest side."""
        one, two = (self.scene.points.get(name, (0, 0)) for name in (P, R))
        return max(abs(float(p - q)) for p, q in zip(one, two, strict=True))

    def _slides(self, plan: Plan, kind: str, asked: tuple[str, ...]) -> None:
        """The sliding of each pair whose point is asked for."""
        for slide in self.scene.slides:
            if slide.at in asked:
                begin = plan.end_in(slide.along, slide.at)
                end = plan.end_in(slide.link, slide.at)
                seat = plan.seat(slide, slide.along, slide.link, slide.at)
                self._read(kind, slide.name, plan.moved(begin, seat, plan.figure(slide.link, slide.at)), end)


def _ways(moves: Iterable[Move]) -> str:
    """How the rings of links are broken, if there are any."""
    ways = []
    for move in moves:
        if isinstance(move, Pole):
            ways.append(f"relative pole of links {move.bodies[0]} and {move.bodies[1]}")
        elif isinstance(move, Trial):
            ways.append(f"false position of {move.at[0][0]}")
            ways.extend(filter(None, [_ways(move.moves)]))
    return ", ".join(ways)


METHODS = {"auxiliary": "auxiliary point", "trial": "trial figure", "poles": ""}
PLANS = ("orthogonal", "polar", "lever", "polygons", "both")
INERTIA = ("couple", "shifted", "points")
NEAR = 2.0  # extents of the mechanism: where a slide's reaction acts further away, its line is not drawn
SMALL = 1e-6  # of the largest reaction: a slide's that is smaller has no line to speak of
UNSTEADY = 30.0  # growth of errors from which on force plans are drawn in other ways too, and weighed


@dataclass(frozen=True)
class Style:
    """Which plans are drawn: orthogonal or polar ones of the motion; the lever, force polygons, or both."""

    polar: bool = False
    lever: bool = True
    polygons: bool = True
    inertia: str = "couple"


def style(plan: str, inertia: str) -> Style:
    """The style that `plan` names: one word for the motion, one for the forces, or both with a comma between them."""
    if inertia not in INERTIA:
        raise Refused(f"inertia {inertia}", "there is no such form", f"one of {', '.join(INERTIA)}")
    words = plan.split(",")
    for word in words:
        if word not in PLANS:
            raise Refused(f"plan {word}", "there is no such plan", f"one of {', '.join(PLANS)}")
    lever, polygons = "lever" in words, "polygons" in words
    both = "both" in words or not (lever or polygons)
    return Style("polar" in words, lever or both, polygons or both, inertia)


def construct(scene: Scene, *, method: str = "", plan: str = "orthogonal", strict: bool = False,
              inertia: str = "couple") -> Construction:
    """The construction of what the scene asks for.

    `method` names the form of loci and rings (auxiliary, trial or poles); without it the pose chooses, and the
    construction says why. `plan` is orthogonal or polar, and for forces lever, polygons or both, such as "polar,lever";
    `inertia` is the form of inertia forces: with a couple, shifted so that they need none, or at two points that
    replace the link; `strict` draws with compasses and straightedge alone. Fails with `Refused` where no move of the
    planner reaches what is asked; numbers are not looked at before they are read, so a singular pose shows then.
    """
    if method not in ("", *METHODS):
        raise Refused(f"method {method}", "there is no such form", f"one of {', '.join(METHODS)}")
    chosen = style(plan, inertia)
    best = best_way(Network(scene), method, lambda planner: _steadiest(scene, planner, chosen))
    best.prefer, best.strict = METHODS.get(method, ""), strict
    return best


def _steadiest(scene: Scene, planner: Planner, chosen: Style) -> Construction:
    """The construction by these moves; force plans in which errors grow are weighed against other ways to draw them."""
    draughtsman = Draughtsman(scene, planner, chosen)
    first = draughtsman.draw()
    if scene.loads is None or not chosen.polygons:
        return first
    way, found = ("polygons", 0), first
    if growth(first.program) >= UNSTEADY:
        ways = [(order, pick) for order in PREFERENCES for pick in range(draughtsman.options)]
        drawn = [first, *(Draughtsman(scene, planner, chosen, *way).draw() for way in ways[1:])]
        grown = [growth(construction.program) for construction in drawn]
        best = min(range(len(ways)), key=lambda k: (max(grown[k], EQUAL * min(grown)), len(drawn[k].program)))
        way, found = ways[best], drawn[best]
    return _with_arms(found, lambda names: Draughtsman(scene, planner, chosen, *way, names).draw())


def _with_arms(found: Construction, draw: Callable[[tuple[str, ...]], Construction]) -> Construction:
    """The construction with the points where slides' reactions act, as far as they lie near; the others are told."""
    try:
        values = found.read(Floats())
    except ConstructionError:
        return found
    moments = values.get("slide moment", {})
    sizes = {name: math.hypot(*force) for name, force in values.get("slide reaction", {}).items() if name in moments}
    reach = NEAR * extent(found.scene) / float(metre(found.scene.units))
    forces = [*values.get("reaction", {}).values(), *values.get("slide reaction", {}).values()]
    least = SMALL * max((math.hypot(*force) for force in forces), default=0.0)
    near = tuple(name for name, size in sizes.items() if size > least and abs(moments[name]) <= reach * size)
    with_arms = draw(near) if near else found
    with_arms.notes += [
        f"slide {name}: its reaction is small beside its moment; it is told as a force and a couple, not by its line"
        for name in sizes if name not in near and abs(moments[name]) > least * reach]
    return with_arms
