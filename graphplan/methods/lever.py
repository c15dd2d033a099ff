"""Zhukovsky's lever: the orthogonal velocities from one pole as a rigid body, with the forces at their ends.

The moment of a force about the pole is its power, in the scale of the plan. So the lever balances when the mechanism
does, and one unknown force or moment is had from the moments of all others, without any reaction; the velocities may be
of any size, and those of a mechanism at rest are assumed. To find a reaction its pair is freed: the link may then move
across the pin, the balance does no work, and the reaction takes its place (Ozols 1974, 10-6 and 13-3).
"""

from __future__ import annotations

from collections.abc import Iterator
from copy import copy
from dataclasses import replace
from fractions import Fraction

from graphplan.errors import Refused
from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import (
    FRAME,
    Balance,
    Drive,
    Number,
    Pair,
    Scene,
    Slide,
    SlidingDrive,
    TurningDrive,
)
from graphplan.methods.loading import Acting, Loading
from graphplan.methods.network import Network
from graphplan.methods.panels import MECHANISM, spoken
from graphplan.methods.planner import Planner
from graphplan.methods.poses import Pose
from graphplan.methods.reactions import Shown
from graphplan.methods.tempo import Tempo, extent, round_number
from graphplan.methods.velocity import Orthogonal, Polar, Velocity
from graphplan.phrases import said

Span = tuple[Mark, Mark]
AXES: tuple[Pair, Pair] = (Fraction(1), Fraction(0)), (Fraction(0), Fraction(1))


class Lever:
    """One lever: the loads of a scene at the ends of one set of velocities, on a panel of its own."""

    def __init__(self, board: Board, velocity: Velocity, loading: Loading, panel: str = "lever",
                 renamed: dict[tuple[str, str], str] | None = None):
        self.board, self.velocity, self.loading, self.panel = board, velocity, loading, panel
        self.renamed = renamed or {}
        self.shown: list[Shown] = []
        with board.on(panel):
            self.pole = board.begin(plan=spoken(panel), number=1, name="o")

    # ---- velocities --------------------------------------------------------------------------------------------

    def end(self, link: str, point: str) -> Mark:
        """The end of the orthogonal velocity of a link's point, from the pole."""
        scene, point = self.velocity.net.scene, self.renamed.get((link, point), point)
        if FRAME in scene.links_of.get(point, ()) and point in scene.links[link]:
            return self.pole
        name = f"{self.velocity.pose.spoken(point).lower()}_o"
        if isinstance(self.velocity, Polar):
            return self.board.quarter(self.velocity.pole, self.velocity.end_in(link, point), self.pole, name=name)
        home, end = self.velocity.figure(link, point), self.velocity.end_in(link, point)
        return self.board.transfer(home, end, self.pole, name=name)

    def _relative(self, one: Mark, two: Mark) -> Mark:
        """The end of the velocity of one point about another, from the pole."""
        return two if one is self.pole else self.board.transfer(one, two, self.pole)

    # ---- forces ------------------------------------------------------------------------------------------------

    def forces(self) -> Iterator[Acting]:
        """The loads at the ends of the velocities; those at fixed points have no moment, and are left out."""
        for link in self.loading.scene.moving:
            for point, lay in self.loading.each(link):
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

    def _held(self, X: Mark) -> Mark:
        """The force at the end X, square to its velocity and laid off there, that keeps the lever in balance."""
        mark = X
        for force in self.forces():
            self.shown.append(Shown("load", force.name, force.tail, force.head))
            mark = self.board.balance(self.pole, X, force.at, force.tail, force.head, mark,
                                      why=said("moments about the pole balance, since powers do"))
        return mark

    def moment(self, link: str) -> tuple[Mark, ...]:
        """The balancing moment on a link, as a pair of forces at two of its points: a pole, a point, tail and head."""
        names = self.loading.arm_points(link)
        with self.board.on(self.panel, (link,)):
            X = self._relative(*(self.end(link, point) for point in names))
            head = self._held(X)
        P, R = (self.velocity.pose.points[name] for name in names)
        return P, R, X, head

    def force(self, balance: Balance) -> Span:
        """The balancing force of known line: as much of it as has the moment of that which stands square."""
        assert balance.direction is not None
        with self.board.on(self.panel, (balance.link,)):
            X = self.end(balance.link, balance.at)
            dx, dy = balance.direction
            along = self.board.guide(X, dx=dx, dy=dy)
            head = self.board.meet(along, self.board.parallel(self.board.line(self.pole, X), self._held(X)))
        return X, head

    def across(self, point: str, link: str, pin: str) -> Span:
        """The force on a link at a freed pin, along the direction in which it may move there."""
        with self.board.on(self.panel, (link,)):
            X = self._relative(self.end(pin, point), self.end(link, point))
            return X, self._held(X)


# ---- velocities to hang the forces on ------------------------------------------------------------------------------


def moving(scene: Scene) -> bool:
    """Whether the scene's own velocities serve: one drive, and it moves."""
    rates = [d.omega if isinstance(d, TurningDrive) else d.speed for d in scene.drives]
    return len(rates) == 1 and bool(rates[0])


def virtual(scene: Scene, drives: tuple[Drive, ...], pose: Pose, extra: dict[str, str]) -> Velocity:
    """Orthogonal velocities of a scene as these drives would move it; `extra` are new points at old ones' places."""
    assumed = replace(scene, drives=drives)
    net, own = Network(assumed), copy(pose)
    for new, old in extra.items():  # where one of the two is a link's own point, the other is it, too
        net.coincident |= {((old, k) if new in own_points else (new, k)): (new if new in own_points else old)
                           for k, own_points in net.links.items()}
    own.scene = assumed
    own.points = pose.points | {new: pose.points[old] for new, old in extra.items()}
    velocity = Orthogonal(pose.board, net, own, Tempo(Fraction(1)))
    with pose.board.on(MECHANISM):
        velocity.draw(Planner(net).plan())
    return velocity


def unit_drives(scene: Scene, mode: int) -> tuple[Drive, ...]:
    """The scene's balances held, but for one that moves at a unit rate; a single drive stands for its balance."""
    assert scene.loads is not None
    if len(scene.drives) == 1:
        drive = scene.drives[0]
        if isinstance(drive, TurningDrive):
            return (replace(drive, omega=Fraction(1), alpha=Fraction(0)),)
        return (replace(drive, speed=_speed(scene), acceleration=Fraction(0)),)
    return tuple(_holding(scene, balance, nth == mode) for nth, balance in enumerate(scene.loads.balances))


def _speed(scene: Scene) -> Number:
    return round_number(extent(scene) / 4)


def _holding(scene: Scene, balance: Balance, moves: bool = False) -> Drive:
    """A drive in the place of a balance, of a turning about the frame or a sliding on it: still, or at a unit rate."""
    if not balance.at:
        return TurningDrive(balance.link, FRAME, Fraction(moves), Fraction(0))
    there = scene.links_of[balance.at]
    for link in there:
        if any(FRAME in scene.links_of[point] for point in scene.links[link]):
            return TurningDrive(link, FRAME, Fraction(moves), Fraction(0))
    for slide in scene.slides:
        if slide.link in there and slide.along == FRAME:
            return SlidingDrive(slide.link, FRAME, _speed(scene) if moves else Fraction(0), Fraction(0))
    raise Refused(f"the lever of the force at {balance.at}", "what it holds still is no turning and no sliding",
                  "--plan polygons")


def freed(scene: Scene, point: str, link: str, pin: str, axis: Pair) -> tuple[Scene, tuple[Drive, ...], str]:
    """The scene with one joint freed, so that the link may move along an axis there; its drives; and the new point.

    The link's point gets a name of its own, and a block that carries it and slides along the pin's link.
    """
    assert scene.loads is not None
    new, block = f"{point}*", f"pin {point}"
    links = {name: tuple(new if name == link and p == point else p for p in points)
             for name, points in scene.links.items()}
    slides = [replace(s, at=new) if (s.link, s.at) == (link, point) else s for s in scene.slides]
    drive = SlidingDrive(block, pin, _speed(scene), Fraction(0))
    changed = replace(scene, points=scene.points | {new: scene.points[point]}, links=links | {block: (new,)},
                      slides=(*slides, Slide(block, pin, new, axis)))
    held = tuple(_holding(scene, balance) for balance in scene.loads.balances)
    return changed, (*held, drive), new
