"""Draws a scene by a list of moves, and notes what can be read from it.

A slide makes two links turn alike, a turning drive by a given difference. So a link of one point, such as a block, has
its turning from another; one that such pairs tie to the frame has what the drives prescribe, and nothing is drawn.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import combinations
from typing import NamedTuple

from graphplan.errors import Refused
from graphplan.kernel.passes import freeze, needed_steps
from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import FRAME, Number, Pair, Scene
from graphplan.mechanism.order import by_name, ordered_points
from graphplan.mechanism.replaced import RollingGuide
from graphplan.methods import kinds
from graphplan.methods.assembly import Pose
from graphplan.methods.construction import Construction, PartArrow
from graphplan.methods.design import Design
from graphplan.methods.motion.acceleration import Normal
from graphplan.methods.motion.circle_diagram import DrawnCircle
from graphplan.methods.motion.moves import Auxiliary, Centre, FalsePosition, Move, Pole
from graphplan.methods.motion.plan import MotionPlan
from graphplan.methods.motion.planner import Planner
from graphplan.methods.motion.polar_acceleration import PolarAcceleration
from graphplan.methods.motion.poles import Poles, Unseen
from graphplan.methods.motion.time_scale import point_distance, tempo
from graphplan.methods.motion.vector_parts import drawn_parts
from graphplan.methods.motion.velocity import Orthogonal, Polar, Triangles, Velocity
from graphplan.methods.panels import link_named, list_links, redundancies, replacements
from graphplan.methods.recorded import Reading
from graphplan.phrases import Said, said

VELOCITIES: dict[str, type[Velocity]] = {"orthogonal": Orthogonal, "polar": Polar, "triangles": Triangles}


class LinkSide(NamedTuple):
    """Two points of a link's plane, and the marks that its turning is read from: both, begin and end of each vector.

    `own` says whether both are points of the link, which cannot come together in another pose.
    """

    link: str
    marks: tuple[Mark, ...]
    length: float
    own: bool


class Draughtsman:
    """Draws one scene by one list of moves, and says what can be read from it."""

    def __init__(self, scene: Scene, planner: Planner, design: Design):
        self.scene, self.net = scene, planner.net
        self.design = replace(design, ways=planner.choices, kappa=design.kappa or Fraction(tempo(scene).kappa))
        self.velocities = VELOCITIES[self.design.motion]
        self.board = Board()
        self.net.relied.clear()
        self.pose = Pose(self.board, self.net, self.velocities.mechanism)
        self.tempo = self.design.tempo
        self.planner, self.moves = planner, planner.moves
        self.marks: list[Mark] = []
        self.readings: list[Reading] = []
        self.poles_by: tuple[Said, ...] = ()
        self.paths_by: tuple[Said, ...] = ()
        self.at_rest: list[Said] = []
        self.special: list[Said] = []
        self.circle: DrawnCircle | None = None
        self.unplanned = 0  # steps at the outset that rest on no moves

    def draw(self) -> Construction:
        velocity = self.velocities(self.board, self.net, self.pose, self.tempo)
        poles = None
        if self.scene.find.poles or any(isinstance(move, Centre) for move in self.velocity_moves):
            poles = Poles(self.board, self.scene, self.pose, velocity)
            poles.draw(self.scene.find.poles)
            self.unplanned = 0 if self.scene.loads else len(self.board.steps)
            velocity.pole_of = poles.mark
        if self._needs_velocities:
            velocity.draw(self.velocity_moves)
        self._points(velocity, kinds.VELOCITY, self.scene.find.velocity)
        self._links(velocity, kinds.OMEGA, self.scene.find.velocity)
        self._slides(velocity, kinds.SLIDE_VELOCITY, self.scene.find.velocity)
        plan = self.accelerations(velocity) if self._needs_acceleration else None
        if poles:
            self._poles(poles)
            self.circle = poles.circle
        return self.finish(velocity, plan)

    @property
    def _needs_velocities(self) -> bool:
        """Whether velocities are drawn before all else; the curvature of paths begins them where it needs them."""
        find = self.scene.find
        return bool(find.velocity or find.acceleration or find.turning or find.slides or find.poles)

    def _poles(self, poles: Poles) -> None:
        """The instant centres that are asked for, but for links that do not move relative to each other."""
        for name in self.scene.find.poles:
            one, two = self.scene.link_pair(name)
            try:
                if poles.at_rest(one, two):
                    self.at_rest.append(said("{0}: they do not move relative to each other here, so any point is a "
                                             "pole of theirs", list_links((one, two))))
                    continue
                marks = poles.find(one, two).marks
            except Unseen as unseen:
                marks = (unseen.mark,)  # whoever reads the numbers is told
            self.read(kinds.POLE_HEADING if poles.at_infinity(one, two) else kinds.POLE, name, *marks)
        self.poles_by = tuple(poles.methods) if self.scene.find.poles else ()

    @property
    def velocity_moves(self) -> list[Move]:
        """The moves of the velocities: by poles if asked for, and so that links which roll on each other share the end
        of their pitch point; each as far as that leaves no trial. A plan has them once."""
        if self.planner.velocity_moves is None:
            self.planner.velocity_moves = self._plan_velocities(self.planner.of_velocities)
        return self.planner.velocity_moves

    def _plan_velocities(self, planner: Planner) -> list[Move]:
        """Plan the moves of the velocities, which are those of `planner` where nothing is better."""
        centres, common = self._centres(planner), any(isinstance(slide, RollingGuide) for slide in self.net.slides)
        for some in (centres, {}) if centres else ({},):
            with suppress(Refused):
                found = Planner(self.net, common=common, centres=some).plan() if some or common else planner.moves
                if not some or not any(isinstance(move, FalsePosition) for move in found):
                    return found
        return planner.moves

    def _centres(self, planner: Planner) -> dict[str, Pair]:
        """Poles of links, if velocities are to be drawn by them.

        Where rings of links are broken by relative poles or auxiliary points, the accelerations need these anyway.
        """
        if planner.method != "poles" or not self.net.ground or any(isinstance(move, Pole | Auxiliary)
                                                                   for move in _flat(planner.moves)):
            return {}
        board = Board()
        near = Poles(board, self.scene, Pose(board, self.net)).frame_poles()
        return {link: spot for link, spot in near if self.net.members.get(link) == [link]}

    def finish(self, velocity: Velocity, plan: Normal | None) -> Construction:
        """Finish the construction; the rates that are still asked for come last, as by now it is known which marks are
        drawn anyway."""
        plan = self._curves(velocity, plan)
        self._rates(plan, kinds.ALPHA)
        self._rates(velocity, kinds.OMEGA)
        places = {name: place for place, name in enumerate((*sorted(self.scene.links, key=by_name),
                                                            *ordered_points(self.scene)))}
        self.readings.sort(key=lambda reading: (kinds.ORDER.get(reading.kind, len(kinds.ORDER)),
                                                places.get(reading.of, len(places))))
        part_arrows = tuple(self._part_arrows(velocity, plan))
        program = freeze(self.board, self.marks)
        planned = max(needed_steps(self.board, self.marks), default=0) >= self.unplanned
        return Construction(program, self.scene, self.design, tuple(self.readings), self.velocities.turned,
                            ends_in_pose=tuple(velocity.ends_in_pose()), part_arrows=part_arrows,
                            relied=tuple(self.net.relied), planned=planned,
                            ways=tuple(_ring_methods(self.moves)) if planned else (),
                            velocity_ways=self._velocity_ways(planned),
                            poles_by=self.poles_by, circle=self.circle, paths_by=self.paths_by,
                            notes=[*replacements(self.net.bars), *redundancies(self.scene), *self.at_rest,
                                   *self.special])

    def _velocity_ways(self, planned: bool) -> tuple[Said, ...]:
        """Name the poles by which velocities are drawn; without any, the way of breaking each ring of links."""
        moves = self.planner.of_velocities.moves if planned else []
        return _by_poles(self.velocity_moves) or tuple(_ring_methods(moves))

    def _part_arrows(self, *plans: MotionPlan | None) -> Iterator[PartArrow]:
        """The parts of vectors that what is wanted needs; their marks become wanted, too."""
        needed = needed_steps(self.board, self.marks)
        for plan in filter(None, plans):
            for part, (start, end) in drawn_parts(plan.parts, plan.ends):
                if {start.step.index, end.step.index} <= needed:
                    yield PartArrow(part.kind, part.of, part.letter, (len(self.marks), len(self.marks) + 1))
                    self.marks += [start, end]

    @property
    def _needs_acceleration(self) -> bool:
        """Whether an acceleration is asked for that the drives do not prescribe."""
        find = self.scene.find
        free = any(self.net.turnings.prescribed_rates(link) is None for link in find.links or ())
        return bool(find.acceleration or find.slides or free)

    def accelerations(self, velocity: Velocity) -> Normal:
        """The plan of accelerations, and what is asked of it."""
        kind = PolarAcceleration if self.velocities is Polar else Normal
        plan = kind(self.board, self.net, self.pose, velocity, self.moves)
        plan.draw(self.moves)
        self._points(plan, kinds.ACCELERATION, self.scene.find.acceleration)
        self._links(plan, kinds.ALPHA, self.scene.find.acceleration)
        self._slides(plan, kinds.SLIDE_ACCELERATION, self.scene.find.acceleration)
        return plan

    def _curves(self, velocity: Velocity, plan: Normal | None) -> Normal | None:
        """The curvature of paths and the acceleration centres that are asked for, and the plan of accelerations, begun
        where they need it."""
        find = self.scene.find
        if not (find.curvature or find.inflection or find.acceleration_centres):
            return plan
        from graphplan.methods.motion.curvature import (
            Curves,
            draw_acceleration_centre,  # few scenes need them
        )

        plans = [plan] if plan else []

        def velocities() -> Velocity:
            if not velocity.ends:
                velocity.draw(self.velocity_moves)
            return velocity

        def accelerations() -> Normal:
            if not plans:
                plans.append(self.accelerations(velocities()))
            return plans[0]

        curves = Curves(self.board, self.pose, velocities, accelerations, self.planner.method)
        curves.draw(self.read, self.marks.append)
        self.paths_by, self.special = tuple(curves.ways), [*curves.special]
        for link in find.acceleration_centres:
            centre = draw_acceleration_centre(self.board, self.pose, accelerations, link)
            self.read(kinds.ACCELERATION_CENTRE, link, centre)
        return plans[0] if plans else None

    def read(self, kind: kinds.ResultKind, of: str, *marks: Mark, excess: Number = 0,
             given: Number | Pair | None = None) -> None:
        """Note what is read, and keep the marks that it is read from."""
        start = len(self.marks)
        self.marks.extend(marks)
        self.readings.append(Reading(kind, of, tuple(range(start, len(self.marks))), excess, given))

    def _given_rate(self, kind: kinds.ResultKind, link: str) -> Number | None:
        """The rate that the drives prescribe for a link."""
        rates = self.net.turnings.prescribed_rates(link)
        return rates and getattr(rates, kind)

    def _points(self, plan: MotionPlan, kind: kinds.ResultKind, names: tuple[str, ...]) -> None:
        for name in sorted({*names}, key=self.net.order.point):
            place = (self.net.name(name), "")
            if place not in plan.ends:
                why = said("no known construction determines it")
                raise Refused(said("point {0}", name), why, "ask for other points")
            motion = self.scene.motions.get(name)
            given = getattr(motion, kind) if motion else None
            self.read(kind, name, plan.plan_origin(place), plan.ends[place], given=given)

    def _links(self, plan: MotionPlan, kind: kinds.ResultKind, asked: tuple[str, ...]) -> None:
        """The turning of each link of which two points are asked for, or one and another's motion is given."""
        links, sought = self.scene.find.links, {*map(self.net.name, asked)}
        asked_for = self.scene.moving if links is None else self._asked_links(kind)
        for link in sorted(asked_for, key=self.net.order.link):
            known = sought | {*map(self.net.name, self.scene.motions)}
            names = [p for p in self.net.links[link] if p in known or FRAME in self.net.links_of[p]]
            names = [p for p in names if (p, "") in plan.ends]
            P, R = max(combinations(names, 2), key=lambda pair: point_distance(self.scene, *pair), default=("", ""))
            if P and sought & {*names}:
                vectors = [mark for p in (P, R) for mark in (plan.plan_origin((p, "")), plan.ends[p, ""])]
                points = self.pose.points[P], self.pose.points[R]
                self.read(kind, link, *points, *vectors, given=self._given_rate(kind, link))

    def _rates(self, plan: MotionPlan | None, kind: kinds.ResultKind) -> None:
        """The turning of the other links that are asked for: what is given, else it is read off the cheapest side."""
        read = {reading.of for reading in self.readings if reading.kind == kind}
        links = [link for link in self.net.links if link in self._asked_links(kind) and link not in read]
        needed = needed_steps(self.board, self.marks)
        cheapest: dict[frozenset[str], LinkSide] = {}
        for link in links:
            alike = self.net.turnings.links_turning_with(link)
            if (given := self._given_rate(kind, link)) is not None or plan is None:
                self.read(kind, link, given=given)
                continue
            if (group := frozenset(alike)) not in cheapest:
                with self.board.on(stage=partial(plan.stages.rate, link)):
                    side = cheapest[group] = self._cheapest(plan, link, needed)
                needed |= needed_steps(self.board, side.marks, needed)
            side = cheapest[group]
            self.read(kind, link, *side.marks, excess=getattr(alike[side.link], kind))

    def _asked_links(self, kind: kinds.ResultKind) -> tuple[str, ...]:
        """The links of which a rate of this kind is asked for by name."""
        find = self.scene.find
        return find.turning if kind == kinds.OMEGA else find.links or ()

    def _cheapest(self, plan: MotionPlan, link: str, needed: set[int]) -> LinkSide:
        """The side, of a link or of one that turns alike, that costs the fewest steps beside those needed anyway; then
        one of its own points, then the longest."""
        found = _sides(plan, self.net.turnings.links_turning_with(link))
        if not found:
            why = said("no known construction determines it")
            raise Refused(link_named(link), why, "ask for other links")
        return min(found, key=lambda side: (len(needed_steps(self.board, side.marks, needed)), not side.own,
                                            -side.length))

    def _slides(self, plan: MotionPlan, kind: kinds.ResultKind, asked: tuple[str, ...]) -> None:
        """The sliding of each pair that is asked for, by its name or by its point."""
        names = self.scene.find.slides
        prescribed = {drive.links: drive for drive in self.scene.drives if drive.slides}
        for slide in self.net.all_slides:
            if slide not in self.scene.slides or not (slide.at in asked if names is None else slide.name in names):
                continue
            with self.board.on(stage=partial(plan.stages.sliding_stage, slide)):
                vector = plan.sliding(slide)
                drive = prescribed.get(slide.links)
                given = None if drive is None else drive.rate if kind == kinds.SLIDE_VELOCITY else drive.change
                guide = [self.pose.guide(slide, run=True)] if given else []
                self.read(kind, slide.name, *guide, *vector, given=given)


def _flat(moves: Iterable[Move]) -> Iterator[Move]:
    """The moves, and those of trials."""
    for move in moves:
        yield move
        yield from _flat(move.moves) if isinstance(move, FalsePosition) else ()


def _by_poles(moves: Iterable[Move]) -> tuple[Said, ...]:
    """Name the poles by which velocities are drawn; empty without any."""
    links = sorted((move.body for move in moves if isinstance(move, Centre)), key=by_name)
    return (said("poles of {0}", list_links(links)),) if links else ()


def _ring_methods(moves: Iterable[Move]) -> Iterator[Said]:
    """Yield the methods for rings of links."""
    for move in moves:
        if isinstance(move, Pole):
            yield said("relative pole of links {0} and {1}", *move.bodies)
        elif isinstance(move, FalsePosition):
            yield said("false position of {0}", move.at[0][0])
            yield from _ring_methods(move.moves)


def _sides(plan: MotionPlan, links: Iterable[str]) -> list[LinkSide]:
    """The sides of these links from which their turning can be read: those between points whose ends are drawn, if
    there are any, else those whose ends follow from all that is known of the link."""
    for places in (_points_with_ends, _determining_points):
        found = [_side(plan, link, P, R) for link in links for P, R in combinations(places(plan, link), 2)
                 if point_distance(plan.net.scene, P, R)]
        if found:
            return found
    return []


def _points_with_ends(plan: MotionPlan, link: str) -> list[str]:
    """The points of a link's plane whose ends are drawn."""
    own = [p for p in plan.net.links[link] if (p, "") in plan.ends]
    return own + [p for p, seen in plan.ends if seen == link and p in plan.net.scene.points]


def _determining_points(plan: MotionPlan, link: str) -> list[str]:
    """The points whose ends tell all of the motion of a link's body."""
    return [p for p, _ in plan.known[plan.net.body[link]] if p in plan.net.scene.points]


def _side(plan: MotionPlan, link: str, P: str, R: str) -> LinkSide:
    points, own = plan.pose.points, {P, R} <= {*plan.net.links[link]}
    (p, p1), (r, r1) = (_vector(plan, link, X) for X in (P, R))
    if isinstance(plan, Normal):  # what lies along the side adds nothing to its turning
        r, p = p if plan.stands_level(link, R, P) else r, r if plan.stands_level(link, P, R) else p
    return LinkSide(link, (points[P], points[R], p, p1, r, r1), point_distance(plan.net.scene, P, R), own)


def _vector(plan: MotionPlan, link: str, point: str) -> tuple[Mark, Mark]:
    """Begin and end of the vector of a point of a link's plane."""
    with plan.board.on(plan.panel, (link,)):
        for place in ((point, ""), (point, link)):
            if place in plan.ends and (place[1] or point in plan.net.links[link]):
                return plan.plan_origin(place), plan.ends[place]
        return plan.vector(link, point)
