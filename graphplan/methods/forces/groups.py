"""Reactions and balance of a scene: the force plans of all groups, against the order of the motion (Assur)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cached_property

from graphplan.errors import Refused
from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import Contact, Gear, Scene, Slide
from graphplan.mechanism.order import without_higher_pairs
from graphplan.mechanism.replaced import RollingGuide
from graphplan.methods import kinds
from graphplan.methods.assembly import Pose
from graphplan.methods.forces import higher_pairs
from graphplan.methods.forces import stages as told
from graphplan.methods.forces.force_plan import ForcePolygon
from graphplan.methods.forces.free_bodies import DrawnForces, Shown, Span, reaction_on, with_sign
from graphplan.methods.forces.friction import edge_point, journal_point, rough
from graphplan.methods.forces.loading import Acting, Loading
from graphplan.methods.forces.statics import Equilibrium, StaticMove
from graphplan.methods.forces.unknown_forces import ForceGroup, Position, groups, in_general, scene_position
from graphplan.methods.motion.planner import Planner
from graphplan.methods.motion.time_scale import Tempo
from graphplan.methods.motion.velocity import Velocity
from graphplan.methods.panels import MECHANISM, JointForce, slide_named
from graphplan.phrases import said

Result = tuple[kinds.ResultKind, str, tuple[Mark, ...]]
Way = tuple[str, int]


class ForceTransfer:
    """The groups of a scene in the order of force transfer, and the moves of each, planned once for every way.

    `rough` are the plans for its rounds of friction. Groups with statically indeterminate forces, and those that have
    forces from them, are left out.

    A way is a preference of moves, and where a trial begins, counted from the first choice; `options` tells how many
    choices there are.
    """

    def __init__(self, given: Scene):
        self.given, self.scene = given, (scene := higher_pairs.bearing(given))
        self.groups: list[ForceGroup] = []
        self._general = in_general(scene)
        self.planners: dict[str, tuple[Planner, Tempo]] = {}  # of the motions that levers assume, by their panel
        self.options = 1
        self._moves: dict[tuple[tuple[str, ...], Way], list[StaticMove] | Refused] = {}
        done: list[str] = []
        untold: set[str] = set()
        own = without_higher_pairs(scene)
        for links in groups(own):
            if _indeterminate(scene, links, untold):
                untold.update(links)
            else:
                self.groups.append(ForceGroup(own, links, done))
                done += links

    @cached_property
    def rough(self) -> ForceTransfer:
        """The plans of the scene whose journals rub."""
        changed = rough(self.given)
        return self if changed.links == self.given.links else ForceTransfer(changed)

    @cached_property
    def _position(self) -> Position:
        return scene_position(self.scene)

    def moves(self, group: ForceGroup, way: Way) -> list[StaticMove]:
        """The moves of a group; where the pose refuses them it may be singular, which the numbers will show."""
        key = group.links, way
        if key not in self._moves:
            for positions in ((self._general, self._position), (self._general,)):
                equilibrium = Equilibrium(group, positions, *way)
                try:
                    self._moves[key] = equilibrium.plan()
                except Refused as refused:
                    self._moves[key] = refused
                else:
                    self.options = max(self.options, equilibrium.options)
                    break
        moves = self._moves[key]
        if isinstance(moves, Refused):
            raise moves
        return moves


def _indeterminate(scene: Scene, links: Iterable[str], untold: set[str]) -> bool:
    """Whether some force on these links is statically indeterminate, or comes from links that have such."""
    ends = {end for c in scene.repeating for end in ((c.link,) if c.way in ("x", "y") else (c.link, c.on))}
    near = {other for link in links for point in scene.links[link] for other in scene.links_of[point]}
    near |= {end for s in scene.slides if {s.link, s.along} & set(links) for end in (s.link, s.along)}
    return bool(scene.repeating) and not (ends.isdisjoint(links) and untold.isdisjoint(near))


def reactions(board: Board, pose: Pose, loading: Loading, plans: ForceTransfer, way: Way,
              before: DrawnForces | None = None) -> DrawnForces:
    """All reactions, drawn in a pose; in one of friction after those of the round `before`."""
    higher_pairs.refuse_couples(plans.given)
    forces, pose = DrawnForces(plans.scene, before), higher_pairs.posed_for(pose, plans.scene)
    for group in plans.groups:
        plan = ForcePolygon(board, pose, group, loading, forces)
        if plan.idle():
            plan.zero_reactions()
        else:
            plan.draw(plans.moves(group, way))
        plan.enter()
    if before is None:
        higher_pairs.press(board, pose, plans.scene, forces)
    forces.edges = {name: pose.points[name] for name in map(edge_point, loading.net.scene.slides)
                    if name in pose.points}
    higher_pairs.divide_pulls(board, pose, plans.scene, forces)
    return forces


def pairs(scene: Scene) -> Iterator[tuple[str, str, str]]:
    """The revolute pairs: joint, link, and the link named first there, which carries the pin."""
    for point in scene.joints:
        pin, *others = scene.links_of[point]
        for link in others:
            yield point, link, pin


def balances(loading: Loading, forces: DrawnForces, way: str) -> Iterator[Result]:
    """The balances by kind and name, found in this way."""
    for name, balance in loading.loads.named_balances.items():
        if balance in forces.balances:
            yield kinds.balance_kind(way, balance), name, forces.balances[balance]
        elif balance in forces.about_centres:
            moment = forces.about_centres[balance]
            yield kinds.balance_kind(way, balance), name, moment_marks(moment.centre, moment.forces)
        elif balance in forces.moments:
            pair = forces.moments[balance]
            yield kinds.balance_kind(way, balance), name, moment_marks(loading.arm(balance.link)[0], pair or ())


def results(scene: Scene, loading: Loading, forces: DrawnForces, board: Board) -> Iterator[Result]:
    """Yield the results of the force plans that are asked for: kind, name and marks."""
    yield from bearing_forces(scene, loading, forces, board)
    yield from balances(loading, forces, kinds.BY_PLANS)


def results_with_friction(scene: Scene, loading: Loading, forces: DrawnForces, board: Board) -> Iterator[Result]:
    """Yield the results of a round of friction."""
    for kind, name, marks in bearing_forces(scene, loading, forces, board):
        yield kinds.WITH_FRICTION[kind], name, marks
    yield from balances(loading, forces, kinds.RUBBED)


def bearing_forces(scene: Scene, loading: Loading, forces: DrawnForces, board: Board) -> Iterator[Result]:
    """The reactions that are asked for, as far as they are told: in a round of friction each journal has its own joint.
    """
    def is_requested(name: str) -> bool:
        return scene.find.reactions is None or name in scene.find.reactions

    for point, link, _ in pairs(scene):
        own = journal_point(point, link)
        joint = own if own in forces.scene.points else point
        if is_requested(point) and _is_force_known(forces.scene, forces, joint, link):
            yield kinds.REACTION, JointForce(point, link).name, reaction_on(forces, board, joint, link)
    for slide in scene.slides:
        if is_requested(slide.name) and slide in forces.slides:
            yield kinds.SLIDE_REACTION, slide.name, forces.slides[slide]
            yield kinds.SLIDE_MOMENT, slide.name, _moment(loading, slide, forces)
        elif is_requested(slide.name) and edge_point(slide) in forces.edges:
            A, span = forces.edges[edge_point(slide)], reaction_on(forces, board, edge_point(slide), slide.link)
            yield kinds.SLIDE_REACTION, slide.name, span
            yield kinds.SLIDE_MOMENT, slide.name, moment_marks(loading.pose.points[slide.at], [Acting(A, *span)])
    for guide in forces.slides:
        if isinstance(guide, RollingGuide) and isinstance(guide.given_pair,
                                                          Gear) and is_requested(guide.given_pair.name):
            yield kinds.GEAR_REACTION, guide.given_pair.name, forces.teeth.get(guide.given_pair,
                                                                               higher_pairs.on_first(guide, forces))
            for strand in guide.given_pair.strands:
                yield kinds.GEAR_REACTION, strand, forces.strands[strand]
    for contact in scene.contacts:
        if (touching := touching_force(forces, board, contact)) and is_requested(contact.name):
            yield kinds.CONTACT_REACTION, contact.name, touching


def arms(scene: Scene, forces: DrawnForces, board: Board, pose: Pose, named: Iterable[str]) -> Iterator[Result]:
    """Yield the arms of these slides' reactions: from the slide's point along the guide to their lines."""
    for slide in (slide for slide in scene.slides if slide.name in named):
        seat, pair = forces.seats[slide], forces.pairs[slide]
        with board.on(MECHANISM, (slide.link, slide.along), told.seat(slide)):
            H = seat if pair is None else board.resultant(
                seat, *forces.slides[slide], pair[1].at, pair[0].at, pair[0].tail, pair[0].head, name=f"H_{slide.link}",
                why=said("the reaction of the slide {0} acts here", slide_named(slide)))
            at, guide = pose.points[slide.at], pose.guide(slide)
            if seat is not at:
                H = board.foot(guide, H)
        yield kinds.SLIDE_ARM, slide.name, (at, H)


def _is_force_known(scene: Scene, forces: DrawnForces, point: str, link: str) -> bool:
    """Whether the force on a link at a joint is drawn, or those on all others there."""
    others = [other for other in scene.links_of[point] if other != link]
    return (point, link) in forces.joints or all((point, other) in forces.joints for other in others)


def touching_force(forces: DrawnForces, board: Board, contact: Contact) -> Span | None:
    """The force of a contact on its first link."""
    if contact.rolling:
        at, link = higher_pairs.rolling_point(contact), contact.links[0]
        return reaction_on(forces, board, at, link) if _is_force_known(forces.scene, forces, at, link) else None
    return next((higher_pairs.on_first(slide, forces) for slide in forces.slides
                 if isinstance(slide, higher_pairs.TouchingGuide) and slide.given_pair == contact), None)


def _moment(loading: Loading, slide: Slide, forces: DrawnForces) -> tuple[Mark, ...]:
    """The moment of a slide's reaction about its point."""
    acting = [Acting(forces.seats[slide], *forces.slides[slide]), *(forces.pairs[slide] or ())]
    return moment_marks(loading.pose.points[slide.at], acting)


def moment_marks(pole: Mark, acting: Iterable[Acting]) -> tuple[Mark, ...]:
    """A point, and of each force that has a moment about it where it acts, its tail and its head."""
    marks = [(force.at, force.tail, force.head) for force in acting if force.at is not pole]
    return pole, *(mark for three in marks for mark in three)


def screw_moments(velocity: Velocity, loading: Loading, forces: DrawnForces) -> Iterator[Result]:
    """The moments on the screws through which balances act, drawn from these on the developed thread.

    It rises by the lead on the circumference of its mean radius, an inclined plane of the lead angle alpha. The force
    of the screw leans from its normal by the friction angle phi against the sliding: its part around the axis is Q
    tan(alpha + phi) where the screw drives, Q tan(alpha - phi) where the load does (Ozols 1974, 12-3, figs. 12-9 and
    12-10). A positive moment drives the first link along the guide's direction.
    """
    board, pose = loading.board, loading.pose
    for balance, span in forces.balances.items():
        screw = loading.loads.screw_of(balance)
        if screw is None:
            continue
        slide = next(slide for slide in loading.scene.slides if slide.links == screw.links)
        tail, head = with_sign(span, 1 if balance.link == slide.link else -1)
        stage, why = told.screw(slide), said("the mean radius of the thread")
        rise, rubs = said("the thread rises by tan alpha"), said("the friction of the screw {0}", slide_named(slide))
        with board.on(MECHANISM, slide.links, stage):
            B, axis = pose.points[slide.at], pose.guide(slide, run=True)
            A = board.lay_along(axis, B, length=screw.radius, why=why)
            around = board.perpendicular(axis, B)
            T = board.step_off(B, A, board.quarter(B, A, B), ratio=-screw.slope, why=rise)
            slip = velocity.slip(slide.along, slide.link, slide.at)
            leaning = board.lean(board.line(B, T), B, slip, tail, head, coefficient=screw.coefficient, why=rubs)
        with board.on(links=slide.links, stage=stage):
            tip = board.meet(board.perpendicular(leaning, tail), board.parallel(around, head))
        forces.shown.append(Shown("part", f"H_{slide.link}", head, tip))
        yield kinds.SCREW, slide.name, moment_marks(B, [Acting(A, head, tip)])
