"""Zhukovsky's lever: the orthogonal velocities from one pole as a rigid body, with the forces at their ends.

The moment of a force about the pole is its power, in the scale of the plan. So the lever balances when the mechanism
does, and one unknown force or moment is had from the moments of all others, without any reaction; the velocities may be
of any size, and those of a mechanism at rest are assumed. To find a reaction its pair is freed: the link may then move
in the pair, the balances do no work, and the reaction takes their place (Ozols 1974, 10-6 and 13-3).

In an assumed motion one force that is looked for does work, and no other. A balance that does no work is a support: its
link does not turn, or its point moves only across its direction, in a block that slides that way on the frame.
"""

from __future__ import annotations

import math
from collections import ChainMap
from collections.abc import Collection, Iterator
from copy import copy
from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import NamedTuple

from graphplan.kernel.program import Mark
from graphplan.mechanism.model import FRAME, Balance, Drive, Find, Pair, Scene, Slide, SlidingDrive, TurningDrive
from graphplan.mechanism.order import ordered_drives
from graphplan.mechanism.pairs.pair import KinematicPair
from graphplan.mechanism.structure import bracing
from graphplan.methods import kinds
from graphplan.methods.assembly import Pose
from graphplan.methods.design import Design
from graphplan.methods.draughtsman import Draughtsman
from graphplan.methods.forces import stages
from graphplan.methods.forces.free_bodies import Shown, Span
from graphplan.methods.forces.groups import ForceTransfer, Result, pairs
from graphplan.methods.forces.higher_pairs import pressed_by_teeth
from graphplan.methods.forces.loading import Acting, Loading
from graphplan.methods.motion.planner import Planner
from graphplan.methods.motion.stages import beginning_stage
from graphplan.methods.motion.time_scale import Tempo, round_down, round_number
from graphplan.methods.motion.velocity import Orthogonal, Polar, Velocity
from graphplan.methods.panels import MECHANISM, JointForce, LeverPlan, balance_letter, pair_letter
from graphplan.methods.tolerances import EXTENT_TOL
from graphplan.methods.ways import Plan, first_drawable
from graphplan.phrases import Said, said

# of the mechanism's extent: between these the longest assumed velocity is drawn as it is, else about so long
SHORTEST, LONGEST, ASSUMED = 0.1, 1.2, 0.4
AXES: tuple[Pair, Pair] = (Fraction(1), Fraction(0)), (Fraction(0), Fraction(1))


class Levers:
    """Balances and reactions of a scene by levers, without any force plan: results, and the arrows that show them."""

    def __init__(self, pose: Pose, velocity: Velocity, loading: Loading, plans: ForceTransfer):
        self.pose, self.velocity, self.loading, self.plans = pose, velocity, loading, plans
        self.scene = loading.scene
        self.results: list[Result] = []
        self.notes: list[Said] = []
        self.shown: list[Shown] = []

    def balances(self) -> Levers:
        """The balances, one lever for each; where one drive moves the scene's own velocities serve."""
        drives, named = self.scene.drives, self.loading.loads.named_balances
        for mode, (name, balance) in enumerate(named.items()):
            own = len(drives) == 1 and drives[0].rate
            lever = self._lever(None if own else working(self.scene, mode),
                                LeverPlan.of_part(None if len(named) == 1 else mode + 1), balance_letter(balance))
            marks = lever.force(balance) if balance.at else lever.turning(*balance.links)
            self._record_result(lever, kinds.balance_kind(kinds.BY_LEVER, balance), name, marks, "balance")
        return self

    def reactions(self, asked: Collection[str]) -> Levers:
        """The reactions of the joints and slides of these names that statics tells, each with its pair freed."""
        scene, (joints, guides) = self.loading.net.scene, pressed_by_teeth(self.plans.given)
        left = sorted(joints & {*asked}) + [slide.name for slide in guides if slide.name in asked]
        if left:
            self.notes.append(said("reactions in {0}: force plans alone have the radial components of tooth forces",
                                   ", ".join(left)))
        for point, link, pin in pairs(scene):
            if point in asked and point not in joints and JointForce(point, link).name not in scene.indeterminate_pairs:
                self._joint(JointForce(point, link), pin)
        for slide in self.scene.slides:
            if slide.name in asked and slide not in guides and slide.name not in scene.indeterminate_pairs:
                lever = self._lever(freed_slide(self.scene, slide), LeverPlan.of_part(slide, "F"),
                                    pair_letter(slide.along, slide.link))
                self._record_result(lever, kinds.SLIDE_REACTION, slide.name, lever.off_guide(slide), "reaction")
                lever = self._lever(freed_turning(self.scene, slide), LeverPlan.of_part(slide, "M"), f"M_{slide.link}")
                self._record_result(lever, kinds.SLIDE_MOMENT, slide.name, lever.turning(slide.link, slide.along),
                                    "reaction")
        return self

    def _joint(self, force: JointForce, pin: str) -> None:
        """A joint's reaction by two levers, one for each component."""
        spans = []
        for axis, letter in zip(AXES, "xy", strict=True):
            lever = self._lever(freed_joint(self.scene, force.point, force.link, pin, axis),
                                LeverPlan.of_part(force, letter), f"R_{letter}")
            spans.append(lever.force_across(force.point, force.link, pin))
            self.shown += [*lever.shown, Shown("reaction", lever.letter, *spans[-1])]
        (tail, corner), other = spans
        with self.pose.board.on(lever.panel, stage=lever.stage):
            self.results.append((kinds.REACTION, force.name, (tail, self.pose.board.transfer(*other, corner))))

    def _record_result(self, lever: Lever, kind: kinds.ResultKind, name: str, marks: tuple[Mark, ...],
                       shown: str) -> None:
        self.results.append((kind, name, marks))
        self.shown += [*lever.shown, Shown(shown, lever.letter, *marks[-2:])]

    def _lever(self, assumed: Assumed | None, panel: LeverPlan, letter: str) -> Lever:
        """The lever of an assumed motion, or of the scene's own, for a force or moment of this letter."""
        if assumed is None:
            return Lever(self.velocity, self.loading, panel, {}, letter)
        if panel not in self.plans.planners:
            self.plans.planners[panel] = plan_motion(assumed.scene)
        own, (planner, pace) = copy(self.pose), self.plans.planners[panel]
        own.scene, own.order = assumed.scene, planner.net.order
        renamed = {new: self.pose.points[old] for (_, old), new in assumed.renamed.items()}
        own.points = ChainMap(renamed, self.pose.standing)
        velocity = Orthogonal(self.pose.board, planner.net, own, pace)
        velocity.stages = replace(velocity.stages, purpose=panel.words)
        with self.pose.board.on(MECHANISM):
            velocity.draw(planner.moves)
        return Lever(velocity, self.loading, panel, assumed.renamed, letter)


class Lever:
    """One lever: the loads of a scene at the ends of one set of velocities, on a panel of its own.

    `letter` is that of the force or moment which it tells.
    """

    def __init__(self, velocity: Velocity, loading: Loading, panel: LeverPlan, renamed: dict[tuple[str, str], str],
                 letter: str):
        self.board, self.velocity, self.loading, self.panel = loading.board, velocity, loading, panel
        self.renamed, self.letter = renamed, letter
        self.shown: list[Shown] = []
        self.loads: list[str] = []
        self.stage = partial(stages.lever, panel, letter, self.loads)
        with self.board.on(panel, stage=beginning_stage("o", panel.words, pole=True)):
            self.pole = self.board.pole(plan=panel, name="o")

    # ---- velocities --------------------------------------------------------------------------------------------

    def end(self, link: str, point: str) -> Mark:
        """The end of the orthogonal velocity of a link's point, from the pole."""
        scene, point = self.velocity.net.scene, self.renamed.get((link, point), point)
        if FRAME in scene.links_of.get(point, ()) and point in scene.links[link]:
            return self.pole
        name = f"{self.velocity.pose.letter_of_point(point).lower()}_o"
        if isinstance(self.velocity, Polar):
            return self.board.quarter(self.velocity.pole, self.velocity.end_in(link, point), self.pole, name=name)
        home, end = self.velocity.vector(link, point)
        return self.board.transfer(home, end, self.pole, name=name)

    def _relative(self, one: Mark, two: Mark) -> Mark:
        """The end of the velocity of one point about another, from the pole."""
        return two if one is self.pole else self.board.transfer(one, two, self.pole)

    # ---- forces ------------------------------------------------------------------------------------------------

    def forces(self) -> Iterator[Acting]:
        """The loads at the ends of the velocities; those at fixed points have no moment, and are left out."""
        for link in self.loading.scene.moving:
            for point, lay in self.loading.forces_on(link):
                end = self.end(link, point)
                if end is not self.pole:
                    force = lay(end)
                    yield Acting(end, end, force.head, force.name)
            yield from self._couples(link)

    def _couples(self, link: str) -> Iterator[Acting]:
        """The couples, as pairs of forces at two points of the link; that at a fixed point is left out."""
        ends = [self.end(link, point) for point in self.loading.arm_points(link)]
        for force, answer in self.loading.couples(link, ends[1]):
            yield Acting(ends[1], force.tail, force.head, force.name)
            if ends[0] is not self.pole:
                tip = self.board.transfer(answer.tail, answer.head, ends[0])
                yield Acting(ends[0], ends[0], tip, answer.name)

    def _balancing_force(self, X: Mark) -> Mark:
        """The force at the end X, perpendicular to its velocity and laid off there, that keeps the lever in balance."""
        mark = X
        for force in self.forces():
            self.shown.append(Shown("load", force.name, force.tail, force.head))
            self.loads.append(force.name)
            mark = self.board.balance(self.pole, X, force.at, force.tail, force.head, mark,
                                      why=stages.POWERS)
        return mark

    def turning(self, link: str, on: str = FRAME) -> tuple[Mark, ...]:
        """The moment on a link that turns on another, as a pair of forces: a pole, a point, tail and head."""
        P, R = names = self.loading.arm_points(link)
        with self.board.on(self.panel, (link,), self.stage):
            X = self._relative(*(self.end(link, point) for point in names))
            if on != FRAME:
                X = self._relative(self._relative(*(self.end(on, point) for point in names)), X)
            head = self._balancing_force(X)
        return self.velocity.pose.points[P], self.velocity.pose.points[R], X, head

    def force(self, balance: Balance) -> Span:
        """The balancing force of known line."""
        assert balance.direction is not None
        with self.board.on(self.panel, (balance.link,), self.stage):
            X = self.end(balance.link, balance.at)
            if balance.on != FRAME:
                X = self._relative(self.end(balance.on, balance.at), X)
            dx, dy = balance.direction
            return self._force_along(X, self.board.guide(X, dx=dx, dy=dy))

    def _force_along(self, X: Mark, line: Mark) -> Span:
        """The force at X along a line: as much of it as has the moment of that which stands square."""
        return X, self.board.meet(line, self.board.parallel(self.board.line(self.pole, X), self._balancing_force(X)))

    def force_across(self, point: str, link: str, pin: str) -> Span:
        """The force on a link at a freed pin, along the direction in which it may move there."""
        with self.board.on(self.panel, (link,), self.stage):
            X = self._relative(self.end(pin, point), self.end(link, point))
            return X, self._balancing_force(X)

    def off_guide(self, slide: Slide) -> Span:
        """The force on a sliding link that may leave its guide."""
        guide = self.velocity.pose.guide(slide)
        with self.board.on(self.panel, (slide.link,), self.stage):
            X = self._relative(self.end(slide.along, slide.at), self.end(slide.link, slide.at))
            return self._force_along(X, self.board.perpendicular(guide, X))


# ---- assumed motions ------------------------------------------------------------------------------------------------


class Assumed(NamedTuple):
    """A scene whose drives make an assumed motion; of the links that were freed, points that are named apart."""

    scene: Scene
    renamed: dict[tuple[str, str], str]


def plan_motion(scene: Scene) -> tuple[Planner, Tempo]:
    """The plan of an assumed motion by the first way that can be drawn, and the tempo at which its velocities are in
    proportion: as they are if they are neither longer than the mechanism nor short beside it, or if no point moves but
    for rounding."""
    every = Find(tuple(point for point, links in scene.links_of.items() if links), ())
    plan = Plan(replace(scene, loads=None, find=every))
    drawing = first_drawable(plan, Design("orthogonal", kappa=Fraction(1)),
                             lambda plan, way, design: Draughtsman(plan.scene, way, design).draw())
    velocities = drawing.computed.get(kinds.VELOCITY, {}).values() if drawing.has_numbers else ()
    longest = max((math.hypot(*velocity) for velocity in velocities), default=0.0) / scene.extent
    well_drawn = longest <= EXTENT_TOL or SHORTEST <= longest <= LONGEST
    tempo = Tempo(Fraction(1) if well_drawn else 1 / round_down(ASSUMED / longest))
    return plan.way_by(drawing.design.ways), tempo


def working(scene: Scene, mode: int) -> Assumed:
    """The motion in which only the balance of this number does work; a single drive stands for its balance."""
    assert scene.loads is not None
    held = [balance for nth, balance in enumerate(scene.loads.balances) if nth != mode]
    balance, apart = scene.loads.balances[mode], scene.with_drives(())
    speed = round_number(scene.extent / 4)
    own = [drive.driven_at(speed if drive.slides else Fraction(1), Fraction(0)) for drive in ordered_drives(scene)]
    if len(own) > 1 and not balance.at:
        own = [TurningDrive(*balance.links, Fraction(1), Fraction(0))]
    found = [_with_supports(apart.with_drives((drive,)), held) for drive in own]
    return Assumed(next((one for one in found if bracing(one).sound), found[0]), {})


def _with_supports(scene: Scene, balances: list[Balance]) -> Scene:
    """The scene with supports instead of balances."""
    for nth, balance in enumerate(balances):
        if balance.direction is None:
            still = TurningDrive(*balance.links, Fraction(0), Fraction(0))
            scene = scene.with_drives((*scene.drives, still))
        else:
            (dx, dy), block = balance.direction, f"support {nth + 1} of {balance.link}"
            across = Slide(block, balance.on, balance.at, (-dy, dx))
            scene = replace(scene, links=scene.links | {block: (balance.at,)}, written=(*scene.written, across))
    return scene


def freed_joint(scene: Scene, point: str, link: str, pin: str, axis: Pair) -> Assumed:
    """The motion of a link on the pin in a joint, along an axis.

    The link's point gets a name of its own, and a block that carries it and slides along the pin's link.
    """
    new, block = f"{point} of {link}", f"pin {point}"
    links = {name: tuple(new if name == link and p == point else p for p in points)
             for name, points in scene.links.items()}
    slides = [replace(s, at=new) if (s.link, s.at) == (link, point) else s for s in scene.slides]
    written = *slides, Slide(block, pin, new, axis), _sliding(scene, block, pin)
    return _free_pair(scene, links | {block: (new,)}, written, {(link, point): new})


def freed_slide(scene: Scene, slide: Slide) -> Assumed:
    """The motion of a sliding link off its guide, along the axis that is more across it: on a second block."""
    new, block = f"{slide.at} of {slide.name}", f"block {slide.name}"
    dx, dy = slide.direction
    axis = AXES[abs(float(dx)) >= abs(float(dy))]
    slides = [replace(s, along=block) if s == slide else s for s in scene.slides]
    written = *slides, Slide(block, slide.along, new, axis), _sliding(scene, block, slide.along)
    return _free_pair(scene, scene.links | {block: (new,)}, written, {(block, slide.at): new})


def freed_turning(scene: Scene, slide: Slide) -> Assumed:
    """The motion of a sliding link that turns on its guide, about the slide's point, in a block there."""
    block = f"block {slide.name}"
    slides = [replace(s, link=block) if s == slide else s for s in scene.slides]
    written = *slides, TurningDrive(slide.link, slide.along, Fraction(1), Fraction(0))
    return _free_pair(scene, scene.links | {block: (slide.at,)}, written, {})


def _sliding(scene: Scene, block: str, along: str) -> Drive:
    return SlidingDrive(block, along, round_number(scene.extent / 4), Fraction(0))


def _free_pair(scene: Scene, links: dict[str, tuple[str, ...]], written: tuple[KinematicPair, ...],
               renamed: dict[tuple[str, str], str]) -> Assumed:
    """The scene with other pairs, one freed and driven, and with all its balances as supports."""
    assert scene.loads is not None
    points = scene.points | {new: scene.points[old] for (_, old), new in renamed.items()}
    freed = replace(scene, points=points, links=links, written=written)
    return Assumed(_with_supports(freed, [replace(balance, at=renamed.get((balance.link, balance.at), balance.at))
                                          for balance in scene.loads.balances]), renamed)
