"""Reactions and balance of a scene: the force plans of all groups, against the order of the motion (Assur)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import Scene, Slide
from graphplan.methods.force_plan import ForcePlan
from graphplan.methods.lever import AXES, Lever, freed, moving, unit_drives, virtual
from graphplan.methods.loading import Acting, Loading
from graphplan.methods.panels import MECHANISM, slide_named
from graphplan.methods.poses import Pose
from graphplan.methods.reactions import Forces, Shown
from graphplan.methods.sites import Group, groups
from graphplan.methods.statics import Equilibrium, StaticMove
from graphplan.methods.velocity import Velocity
from graphplan.phrases import said

REACTION, SLIDE_REACTION, SLIDE_MOMENT, SLIDE_ARM = "reaction", "slide reaction", "slide moment", "slide arm"
BALANCE, BALANCE_MOMENT = "balance", "balance moment"
RUBBED, RUBBED_MOMENT = "balance with friction", "balance moment with friction"
LEVER, LEVER_MOMENT = "lever", "lever moment"
Result = tuple[str, str, tuple[Mark, ...]]
Way = tuple[str, int]


class Plans:
    """The groups of a scene in the order of force transfer, and the moves of each, planned once for every way.

    Groups with statically indeterminate forces, and those that have forces from them, are left out.
    A way is a preference of moves, and where a trial begins, counted from the first choice; `options` tells how many
    choices there are.
    """

    def __init__(self, scene: Scene):
        self.groups: list[Group] = []
        self.options = 1
        self._moves: dict[tuple[tuple[str, ...], Way], list[StaticMove]] = {}
        done: list[str] = []
        untold: set[str] = set()
        for links in groups(scene):
            if _indeterminate(scene, links, untold):
                untold.update(links)
            else:
                self.groups.append(Group(scene, links, done))
                done += links

    def moves(self, group: Group, way: Way) -> list[StaticMove]:
        """The moves of a group."""
        if (group.links, way) not in self._moves:
            equilibrium = Equilibrium(group, *way)
            self._moves[group.links, way] = equilibrium.plan()
            self.options = max(self.options, equilibrium.options)
        return self._moves[group.links, way]


def _indeterminate(scene: Scene, links: Iterable[str], untold: set[str]) -> bool:
    """Whether some force on these links is statically indeterminate, or comes from links that have such."""
    ends = {end for c in scene.repeating for end in ((c.link,) if c.way in ("x", "y") else (c.link, c.on))}
    near = {other for link in links for point in scene.links[link] for other in scene.links_of[point]}
    near |= {end for s in scene.slides if {s.link, s.along} & set(links) for end in (s.link, s.along)}
    return bool(scene.repeating) and not (ends.isdisjoint(links) and untold.isdisjoint(near))


def reactions(board: Board, pose: Pose, loading: Loading, plans: Plans, way: Way,
              before: Forces | None = None) -> Forces:
    """All reactions, drawn; `before` are those without friction, where friction is now among the loads."""
    forces = Forces(before)
    for group in plans.groups:
        plan = ForcePlan(board, pose, group, loading, forces)
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


def pair_name(point: str, link: str) -> str:
    """How the reaction on a link at a joint is named among the readings."""
    return f"{link} at {point}"


def rubbed(loading: Loading, forces: Forces) -> Iterator[Result]:
    """The balances with friction, by kind and name."""
    for name, balance in loading.loads.named_balances.items():
        if balance in forces.balances:
            yield RUBBED, name, forces.balances[balance]
        elif balance in forces.moments:
            pair = forces.moments[balance]
            yield RUBBED_MOMENT, name, _about(loading.arm(balance.link)[0], pair or ())


def results(scene: Scene, loading: Loading, forces: Forces, board: Board) -> Iterator[Result]:
    """What is read of the force plans: kind, name and marks of everything that is asked for and told."""
    asked = scene.find.reactions
    for point, link, _ in pairs(scene):
        if (asked is None or point in asked) and _told(scene, forces, point, link):
            yield REACTION, pair_name(point, link), reaction_on(scene, forces, board, point, link)
    for slide in scene.slides:
        if (asked is None or slide.name in asked) and slide in forces.slides:
            yield SLIDE_REACTION, slide.name, forces.slides[slide]
            yield SLIDE_MOMENT, slide.name, _moment(loading, slide, forces)
    for name, balance in loading.loads.named_balances.items():
        if balance in forces.balances:
            yield BALANCE, name, forces.balances[balance]
        elif balance in forces.moments:
            pair = forces.moments[balance]
            yield BALANCE_MOMENT, name, _about(loading.arm(balance.link)[0], pair or ())


def levers(pose: Pose, velocity: Velocity, loading: Loading) -> tuple[list[Result], list[Shown]]:
    """The balances by Zhukovsky's lever: one lever for each."""
    scene, board = loading.scene, pose.board
    results: list[Result] = []
    shown: list[Shown] = []
    for mode, (name, balance) in enumerate(loading.loads.named_balances.items()):
        serves = moving(scene)
        motion = velocity if serves else virtual(scene, unit_drives(scene, mode), pose, {})
        panel = "lever" if len(loading.loads.balances) == 1 else f"lever {mode + 1}"
        lever = Lever(board, motion, loading, panel)
        if balance.at:
            marks: tuple[Mark, ...] = lever.force(balance)
            results.append((LEVER, name, marks))
        else:
            marks = lever.moment(balance.link)
            results.append((LEVER_MOMENT, name, marks))
        shown += [*lever.shown, Shown("balance", f"{'F' if balance.at else 'T'}_{balance.link}", *marks[-2:])]
    return results, shown


def freed_reactions(pose: Pose, loading: Loading) -> tuple[list[Result], list[Shown]]:
    """The reactions that are asked for by name, each by two levers with its pair freed."""
    scene, board = loading.scene, pose.board
    results: list[Result] = []
    shown: list[Shown] = []
    for point, link, pin in pairs(scene):
        if point not in (scene.find.reactions or ()):
            continue
        spans = []
        for axis, name in zip(AXES, "xy", strict=True):
            changed, drives, new = freed(scene, point, link, pin, axis)
            velocity = virtual(changed, drives, pose, {new: point})
            lever = Lever(board, velocity, loading, f"lever {pair_name(point, link)}, {name}", {(link, point): new})
            spans.append(lever.across(point, link, pin))
            shown += [*lever.shown, Shown("reaction", f"R_{name}", *spans[-1])]
        (tail, corner), other = spans
        with board.on(lever.panel):
            results.append((REACTION, pair_name(point, link), (tail, board.transfer(*other, corner))))
    return results, shown


def arms(scene: Scene, forces: Forces, board: Board, pose: Pose, named: Iterable[str]) -> Iterator[Result]:
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
        yield SLIDE_ARM, slide.name, (at, H)


def reaction_on(scene: Scene, forces: Forces, board: Board, point: str, link: str) -> tuple[Mark, Mark]:
    """The force on a link, the frame among them, at a joint."""
    if (point, link) in forces.joints:
        return forces.joints[point, link]
    spans = [forces.joints[point, other][::-1] for other in scene.links_of[point] if other != link]
    first, mark = spans[0]
    for tail, head in spans[1:]:
        mark = board.transfer(tail, head, mark)
    return first, mark


def _told(scene: Scene, forces: Forces, point: str, link: str) -> bool:
    """Whether the force on a link at a joint is drawn, or those on all others there."""
    others = [other for other in scene.links_of[point] if other != link]
    return (point, link) in forces.joints or all((point, other) in forces.joints for other in others)


def _moment(loading: Loading, slide: Slide, forces: Forces) -> tuple[Mark, ...]:
    """The moment of a slide's reaction about its point."""
    acting = [Acting(forces.seats[slide], *forces.slides[slide]), *(forces.pairs[slide] or ())]
    return _about(loading.pose.points[slide.at], acting)


def _about(pole: Mark, acting: Iterable[Acting]) -> tuple[Mark, ...]:
    """A point, and of each force that has a moment about it where it acts, its tail and its head."""
    marks = [(force.at, force.tail, force.head) for force in acting if force.at is not pole]
    return pole, *(mark for three in marks for mark in three)
