"""Reactions and balance of a scene: the force plans of all groups, against the order of the motion (Assur)."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from functools import cached_property

from graphplan.errors import Refused
from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import Scene, Slide
from graphplan.mechanism.order import ordered
from graphplan.methods import kinds, panels
from graphplan.methods.forces import assumed_motion
from graphplan.methods.forces.assumed_motion import Assumed
from graphplan.methods.forces.force_plan import ForcePolygon
from graphplan.methods.forces.friction import rough
from graphplan.methods.forces.lever import Lever
from graphplan.methods.forces.loading import Acting, Loading
from graphplan.methods.forces.reactions import DrawnForces, Shown, pair_letter, reaction_on
from graphplan.methods.forces.statics import Equilibrium, StaticMove
from graphplan.methods.forces.unknown_forces import ForceGroup, Position, groups, in_general, posed
from graphplan.methods.motion.planner import Planner
from graphplan.methods.motion.velocity import Velocity
from graphplan.methods.panels import MECHANISM, JointForce, slide_named
from graphplan.methods.poses import Pose
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

    def __init__(self, scene: Scene):
        self.scene = scene
        self.groups: list[ForceGroup] = []
        self._general = in_general(scene)
        self._assumed: dict[str, Planner] = {}
        self.options = 1
        self._moves: dict[tuple[tuple[str, ...], Way], list[StaticMove] | Refused] = {}
        done: list[str] = []
        untold: set[str] = set()
        own = ordered(scene)
        for links in groups(own):
            if _indeterminate(scene, links, untold):
                untold.update(links)
            else:
                self.groups.append(ForceGroup(own, links, done))
                done += links

    @cached_property
    def rough(self) -> ForceTransfer:
        """The plans of the scene whose journals rub."""
        changed = rough(self.scene)
        return self if changed.links == self.scene.links else ForceTransfer(changed)

    def planner(self, assumed: Assumed, panel: str) -> Planner:
        """The plan of the motion that a lever's panel shows."""
        if panel not in self._assumed:
            self._assumed[panel] = assumed_motion.planned(assumed)
        return self._assumed[panel]

    def moves(self, group: ForceGroup, way: Way) -> list[StaticMove]:
        """The moves of a group."""
        if (group.links, way) not in self._moves:
            try:
                self._plan(group, (self._general, posed(self.scene)), way)
            except Refused:  # the pose may be singular, which the numbers will show
                self._plan(group, (self._general,), way)
        moves = self._moves[group.links, way]
        if isinstance(moves, Refused):
            raise moves
        return moves

    def _plan(self, group: ForceGroup, positions: Sequence[Position], way: Way) -> None:
        equilibrium = Equilibrium(group, positions, *way)
        try:
            self._moves[group.links, way] = equilibrium.plan()
        except Refused as refused:
            self._moves[group.links, way] = refused
            raise
        self.options = max(self.options, equilibrium.options)


def _indeterminate(scene: Scene, links: Iterable[str], untold: set[str]) -> bool:
    """Whether some force on these links is statically indeterminate, or comes from links that have such."""
    ends = {end for c in scene.repeating for end in ((c.link,) if c.way in ("x", "y") else (c.link, c.on))}
    near = {other for link in links for point in scene.links[link] for other in scene.links_of[point]}
    near |= {end for s in scene.slides if {s.link, s.along} & set(links) for end in (s.link, s.along)}
    return bool(scene.repeating) and not (ends.isdisjoint(links) and untold.isdisjoint(near))


def reactions(board: Board, pose: Pose, loading: Loading, plans: ForceTransfer, way: Way,
              before: DrawnForces | None = None) -> DrawnForces:
    """All reactions, drawn in a pose; in one of friction after those of the round `before`."""
    forces = DrawnForces(plans.scene, before)
    for group in plans.groups:
        plan = ForcePolygon(board, pose, group, loading, forces)
        if plan.idle():
            plan.rest()
        else:
            plan.draw(plans.moves(group, way))
        plan.enter()
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
        elif balance in forces.moments:
            pair = forces.moments[balance]
            yield kinds.balance_kind(way, balance), name, _about(loading.arm(balance.link)[0], pair or ())


def results(scene: Scene, loading: Loading, forces: DrawnForces, board: Board) -> Iterator[Result]:
    """What is read of the force plans: kind, name and marks of everything that is asked for and told."""
    asked = scene.find.reactions
    for point, link, _ in pairs(scene):
        if (asked is None or point in asked) and _told(scene, forces, point, link):
            yield kinds.REACTION, JointForce(point, link).name, reaction_on(forces, board, point, link)
    for slide in scene.slides:
        if (asked is None or slide.name in asked) and slide in forces.slides:
            yield kinds.SLIDE_REACTION, slide.name, forces.slides[slide]
            yield kinds.SLIDE_MOMENT, slide.name, _moment(loading, slide, forces)
    yield from balances(loading, forces, kinds.BY_PLANS)


def levers(pose: Pose, velocity: Velocity, loading: Loading, plans: ForceTransfer) -> tuple[list[Result], list[Shown]]:
    """The balances by Zhukovsky's lever: one lever for each."""
    scene, board = loading.scene, pose.board
    results: list[Result] = []
    shown: list[Shown] = []
    for mode, (name, balance) in enumerate(loading.loads.named_balances.items()):
        panel, motion = panels.LeverPlan.of(None if len(loading.loads.balances) == 1 else mode + 1), velocity
        if not assumed_motion.moving(scene):
            assumed = assumed_motion.working(scene, mode)
            motion = assumed_motion.velocities(assumed, pose, plans.planner(assumed, panel))
        lever = Lever(board, motion, loading, panel)
        marks: tuple[Mark, ...] = lever.force(balance) if balance.at else lever.moment(balance.link)
        results.append((kinds.balance_kind(kinds.BY_LEVER, balance), name, marks))
        shown += [*lever.shown, Shown("balance", f"{'F' if balance.at else 'T'}_{balance.link}", *marks[-2:])]
    return results, shown


class Freed:
    """Reactions by levers without any force plan, each with its pair freed: results and the arrows that show them."""

    def __init__(self, pose: Pose, loading: Loading, plans: ForceTransfer):
        self.pose, self.loading, self.plans, self.board = pose, loading, plans, pose.board
        self.results: list[Result] = []
        self.shown: list[Shown] = []

    def all(self, asked: Collection[str]) -> Freed:
        """Those of the joints and slides of these names that statics tells."""
        scene = self.loading.net.scene
        for point, link, pin in pairs(scene):
            if point in asked and JointForce(point, link).name not in scene.indeterminate_pairs:
                self._joint(point, link, pin)
        for slide in self.loading.scene.slides:
            if slide.name in asked and slide.name not in scene.indeterminate_pairs:
                self._slide(slide)
        return self

    def _lever(self, assumed: Assumed, panel: panels.LeverPlan) -> Lever:
        motion = assumed_motion.velocities(assumed, self.pose, self.plans.planner(assumed, panel))
        return Lever(self.board, motion, self.loading, panel, assumed.renamed)

    def _joint(self, point: str, link: str, pin: str) -> None:
        """A joint's reaction by two levers, one for each component."""
        spans, force = [], JointForce(point, link)
        for axis, letter in zip(assumed_motion.AXES, "xy", strict=True):
            assumed = assumed_motion.freed_joint(self.loading.scene, point, link, pin, axis)
            lever = self._lever(assumed, panels.LeverPlan.of(force, letter))
            spans.append(lever.across(point, link, pin))
            self.shown += [*lever.shown, Shown("reaction", f"R_{letter}", *spans[-1])]
        (tail, corner), other = spans
        with self.board.on(lever.panel):
            self.results.append((kinds.REACTION, force.name, (tail, self.board.transfer(*other, corner))))

    def _slide(self, slide: Slide) -> None:
        """A slide's reaction by two levers: its force, and its moment."""
        lever = self._lever(assumed_motion.freed_slide(self.loading.scene, slide), panels.LeverPlan.of(slide, "F"))
        force = lever.off_guide(slide)
        self.shown += [*lever.shown, Shown("reaction", pair_letter(slide.along, slide.link), *force)]
        self.results.append((kinds.SLIDE_REACTION, slide.name, force))
        lever = self._lever(assumed_motion.freed_turning(self.loading.scene, slide), panels.LeverPlan.of(slide, "M"))
        moment = lever.turning(slide.link, slide.along)
        self.shown += [*lever.shown, Shown("reaction", f"M_{slide.link}", *moment[-2:])]
        self.results.append((kinds.SLIDE_MOMENT, slide.name, moment))


def arms(scene: Scene, forces: DrawnForces, board: Board, pose: Pose, named: Iterable[str]) -> Iterator[Result]:
    """Where the reactions of these slides act: from the slide's point along the guide to their lines."""
    for slide in (slide for slide in scene.slides if slide.name in named):
        seat, pair = forces.seats[slide], forces.pairs[slide]
        with board.on(MECHANISM, (slide.link, slide.along)):
            H = seat if pair is None else board.resultant(
                seat, *forces.slides[slide], pair[1].at, pair[0].at, pair[0].tail, pair[0].head, name=f"H_{slide.link}",
                why=said("the reaction of the slide {0} acts here", slide_named(slide)))
            at, guide = pose.points[slide.at], pose.guide(slide)
            if seat is not at:
                H = board.foot(guide, H)
        yield kinds.SLIDE_ARM, slide.name, (at, H)


def _told(scene: Scene, forces: DrawnForces, point: str, link: str) -> bool:
    """Whether the force on a link at a joint is drawn, or those on all others there."""
    others = [other for other in scene.links_of[point] if other != link]
    return (point, link) in forces.joints or all((point, other) in forces.joints for other in others)


def _moment(loading: Loading, slide: Slide, forces: DrawnForces) -> tuple[Mark, ...]:
    """The moment of a slide's reaction about its point."""
    acting = [Acting(forces.seats[slide], *forces.slides[slide]), *(forces.pairs[slide] or ())]
    return _about(loading.pose.points[slide.at], acting)


def _about(pole: Mark, acting: Iterable[Acting]) -> tuple[Mark, ...]:
    """A point, and of each force that has a moment about it where it acts, its tail and its head."""
    marks = [(force.at, force.tail, force.head) for force in acting if force.at is not pole]
    return pole, *(mark for three in marks for mark in three)
