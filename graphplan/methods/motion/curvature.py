"""Curvature of paths: inflection circles and centres of curvature, drawn from known centres or from the rates.

A link's inflection circle is known from its pole P and two of its points W. Each point of the link whose path's centre
of curvature is known gives a ray through P and a W on it:

- a pin on a link that turns about the frame: its pivot is the centre, and W the third proportional;
- a pin on a link that slides on the frame: its path is straight, and it is W itself;
- a pivot by which a line of the link always passes: it is a return point, W lies opposite, as far from P;
- a pin on a link whose circle is known: its centre by Euler and Savary, then W the third proportional;
- the centre of a wheel that rolls on the frame: P is where it touches, W_0 its centre's third proportional;
- any point whose velocity and acceleration are drawn: W divides the normal acceleration as P the velocity, twice.

Which of them a link has, its joints say. Where the pose puts P or a centre at infinity, the rates serve.

The acceleration centre of a link is its point Q without acceleration. The ends of the accelerations of a link's points,
laid off from one pole pi, form a figure similar to the link's, and with its sense. So Q is to A and B as pi is to the
ends of a_A and a_B: the triangle on AB that is similar to a'b'pi has its third corner in Q. A link with a fixed pivot
has Q in it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import chain, combinations

from graphplan.errors import ConstructionError, Refused
from graphplan.kernel.numbers import Floats
from graphplan.kernel.passes import freeze
from graphplan.kernel.program import Board, Mark, evaluate
from graphplan.kernel.stages import Stage
from graphplan.mechanism.model import FRAME, Scene, Slide
from graphplan.mechanism.order import sort_scene
from graphplan.mechanism.replaced import RollingGuide, rolling_guides
from graphplan.methods import kinds
from graphplan.methods.assembly import Pose
from graphplan.methods.motion.acceleration import Normal
from graphplan.methods.motion.plan import MotionPlan
from graphplan.methods.motion.stages import (
    by_centres,
    by_rates,
    by_rolling,
    centre_by_rates,
    centre_of,
    circle_of,
    pole_of,
)
from graphplan.methods.motion.time_scale import point_distance
from graphplan.methods.motion.velocity import Velocity
from graphplan.methods.panels import MECHANISM, link_named
from graphplan.methods.tolerances import EXTENT_TOL
from graphplan.phrases import Phrase, Said, phrase, said

BY_CENTRES, BY_RATES = said("two known centres"), said("velocities and accelerations")
SPECIAL: dict[str, Phrase] = {
    kinds.STRAIGHT: phrase("{0}: the path is straight to second order, its centre of curvature is at infinity"),
    kinds.CUSP: phrase("{0}: the point is the pole, so its path has a cusp there"),
    kinds.TRANSLATION: phrase("{0}: its pole is at infinity, so the paths of all its points have one curvature, and "
                              "there is no inflection circle"),
}
MAX_POINT_PAIRS = 16  # pairs of points that are tried
Point = tuple[float, float]


@dataclass(frozen=True)
class Source:
    """A point of a link whose path's centre of curvature is known, and how: as a pin or by a slide of `link`."""

    how: str
    point: str
    link: str = ""
    slide: Slide | None = None


@dataclass(frozen=True)
class InflectionCircle:
    """A link's inflection circle: its pole, its inflection pole, and of two points the marks with their centres."""

    pole: Mark
    inflection: Mark
    pins: tuple[Mark, ...] = ()
    shown: bool = False
    by: Said = BY_CENTRES


PREFERRED = "pin", "path", "return", "chain"


def rolling(scene: Scene) -> dict[str, RollingGuide]:
    """The links that roll on the frame, each with what it rolls by."""
    guides = (guide for guide in rolling_guides(scene) if FRAME in guide.links)
    return {next(link for link in guide.links if link != FRAME): guide for guide in guides}


def sources(scene: Scene) -> dict[str, tuple[Source, Source]]:
    """Find for each link two points whose paths have known centres of curvature.

    Uses pins, slides and rolling wheels alone; links without two such points are left out.
    """
    fixed = scene.links.get(FRAME, ())
    pivots = {link: point for link in scene.moving for point in scene.links[link] if point in fixed}
    slides = {s.link if s.along == FRAME else s.along: s for s in scene.slides if FRAME in s.links and s.turns_alike}
    found, wheels = dict[str, tuple[Source, Source]](), rolling(scene)

    def known_centres(link: str) -> Iterator[Source]:
        for point in scene.links[link]:
            for other in scene.links_of[point]:
                if other in pivots and other != link:
                    yield Source("pin", point, other)
                elif other in slides and other != link:
                    yield Source("path", point, other, slides[other])
                elif other in found or (other in wheels and other != link):
                    yield Source("chain", point, other)
        for slide in scene.slides:
            other = next((one for one in slide.links if one != link), "")
            if link in slide.links and other in pivots and slide.turns_alike:
                yield Source("return", pivots[other], other, slide)

    def pair(link: str) -> tuple[Source, Source] | None:
        ranked = sorted(known_centres(link), key=lambda source: PREFERRED.index(source.how))
        return next(((one, two) for one, two in combinations(ranked, 2)
                     if scene.points[one.point] != scene.points[two.point]), None)

    waiting = [link for link in scene.moving if link not in pivots and link not in slides]
    while more := {link: two for link in waiting if link not in found and (two := pair(link))}:
        found |= more
    return found


def point_pairs(scene: Scene, link: str) -> list[tuple[str, str]]:
    """Two points of a link's plane each: its own, those furthest apart first, then other links' in their place."""
    own = {*scene.links[link]}
    pairs = [two for two in combinations(scene.points, 2) if point_distance(scene, *two)]
    pairs.sort(key=lambda two: (-len(own & {*two}), -point_distance(scene, *two)))
    return pairs[:MAX_POINT_PAIRS]


def centre_name(point: str) -> str:
    """The letter of the centre of curvature of a point's path."""
    return "C_" + point.replace("_", "")


class Curves:
    """Draws the curvature of paths on the mechanism plan, and says what is read of it."""

    def __init__(self, board: Board, pose: Pose, velocities: Callable[[], Velocity],
                 accelerations: Callable[[], Normal], method: str):
        self.board, self.pose, self.scene = board, pose, sort_scene(pose.scene)
        self.velocities, self.accelerations, self.method = velocities, accelerations, method
        self.ways: dict[Said, None] = {}
        self.special: list[Said] = []
        self._circles: dict[str, InflectionCircle | None] = {}

    # ---- a link's circle ----------------------------------------------------------------------------------------

    @cached_property
    def known_sources(self) -> dict[str, tuple[Source, Source]]:
        """Two points with known centres of each link; empty if the rates are asked for."""
        return sources(self.scene) if self.method != "accelerations" else {}

    @cached_property
    def wheels(self) -> dict[str, RollingGuide]:
        """The links that roll on the frame; empty if the rates are asked for."""
        return rolling(self.scene) if self.method != "accelerations" else {}

    def circle(self, link: str) -> InflectionCircle | None:
        """The link's inflection circle; None where its pole is at infinity in this pose."""
        if link not in self._circles:
            pivot = next((p for p in self.scene.links[link] if p in self.scene.links.get(FRAME, ())), "")
            self._circles[link] = (InflectionCircle(self.point(pivot), self.point(pivot)) if pivot else
                                   self._first_drawable(self._circle_methods(link)))
        return self._circles[link]

    def _circle_methods(self, link: str) -> Iterator[Callable[[], InflectionCircle]]:
        """Yield the ways to draw the circle: from known centres, or else from the rates of two of the link's points."""
        if link in self.wheels:
            yield partial(self._by_rolling, link, self.wheels[link])
        if link in self.known_sources:
            yield partial(self._by_centres, link)
        if not (pairs := point_pairs(self.scene, link)):
            raise Refused(f"inflection circle of link {link}", "all points of the mechanism lie in one place",
                          "name another point of that link")
        yield from (partial(self._by_rates, link, two) for two in pairs)
        yield lambda: self._by_rates(link, (pairs[0][0], self._corner(link, *pairs[0])))

    def _corner(self, link: str, P: str, R: str) -> str:
        """A point of the link's plane aside of two others: where all are on one line, the pole lies on it, too."""
        name = f"corner of {link}"
        A, B = self.point(P), self.point(R)
        self.pose.points[name] = self.board.quarter(A, B, A, name=self.pose.letter(name))
        return name

    def _first_drawable(self, ways: Iterator[Callable[[], InflectionCircle]]) -> InflectionCircle | None:
        """The first of these that can be drawn in this pose."""
        for way in ways:
            with suppress(ConstructionError, Refused):
                circle = way()
                if all(abs(part) < self.scene.extent / EXTENT_TOL
                       for mark in self.values(circle.pole, circle.inflection) for part in mark):
                    return circle
        return None

    def _by_rolling(self, link: str, guide: RollingGuide) -> InflectionCircle:
        """P where the wheel touches, W_0 on the line of centres: its centre's third proportional, the centre itself on
        a straight rail; of a rail that rolls the point opposite the wheel's centre."""
        with self.board.on(MECHANISM, (link,), by_rolling(link)):
            P = self.point(guide.at)
            if guide.through:
                B, C = sorted(guide.through, key=lambda centre: centre not in self.scene.links[link])
                W0 = self.board.third(self.point(B), self.point(C), self.point(B), P, name="W_0")
            else:
                W0 = self.point(guide.base)
                if guide.base not in self.scene.links[link]:
                    W0 = self.board.transfer(W0, P, P, name="W_0")
            return InflectionCircle(P, W0, by=said("rolling"))

    def _by_centres(self, link: str) -> InflectionCircle:
        """P where the rays cross, W_0 where the perpendiculars to them in W_1 and W_2 do."""
        with self.board.on(MECHANISM, (link,), by_centres(link)):
            two = self.known_sources[link]
            with self.board.on(stage=pole_of(link)):
                rays = [self._ray(source) for source in two]
                P = self.board.meet(*rays, name="P")
            centres = [self._centre(source) for source in two]
            points = [self._on_the_circle(source, centre, P, f"W_{number}")
                      for number, (source, centre) in enumerate(zip(two, centres, strict=True), 1)]
            return replace(self._thales(P, rays, points), pins=self._pins(two, centres),
                           shown=link in self.scene.find.inflection)

    def _thales(self, P: Mark, rays: list[Mark], points: list[Mark]) -> InflectionCircle:
        """The point opposite P on the circle through P and two points of its rays."""
        uprights = [self.board.perpendicular(ray, W) for ray, W in zip(rays, points, strict=True)]
        return InflectionCircle(P, self.board.meet(*uprights, name="W_0"))

    def _pins(self, two: tuple[Source, ...], centres: list[Mark | None]) -> tuple[Mark, ...]:
        """The points and their centres, where these are not at infinity."""
        marks = [mark for source, centre in zip(two, centres, strict=True) if centre is not None
                 for mark in (self.point(source.point), centre)]
        return tuple(marks) if len(marks) == 4 and all(source.how != "return" for source in two) else ()

    def _ray(self, source: Source) -> Mark:
        """The normal of the path of a known point: it passes through the pole."""
        X = self.point(source.point)
        if source.slide is not None:
            return self.board.perpendicular(self.pose.guide(source.slide), X)
        return self.board.side(X, self._pole(source.link))

    def _pole(self, link: str) -> Mark:
        circle = self.circle(link)
        if circle is None:
            raise Refused(link_named(link), said("its pole is at infinity"), "the rates")
        return circle.pole

    def _centre(self, source: Source) -> Mark | None:
        """The centre of curvature of a known point's path, where it is not at infinity."""
        if source.how == "chain":
            circle = self.circle(source.link)
            assert circle is not None
            return self._curvature_centre(circle, source.point)
        return self._pole(source.link) if source.how == "pin" else None

    def _on_the_circle(self, source: Source, centre: Mark | None, P: Mark, name: str) -> Mark:
        """The point of the inflection circle on the ray of a known point."""
        X = self.point(source.point)
        if source.how == "return":
            return self.board.transfer(X, P, P, name=name)
        return X if centre is None else self.board.third(X, centre, X, P, name=name)

    def _by_rates(self, link: str, two: tuple[str, str]) -> InflectionCircle:
        """Inflection circle from the velocities and the accelerations of two points of the link."""
        with self.board.on(MECHANISM, (link,), by_rates(link)):
            ends = [self._orthogonal(link, X) for X in two]
            rays = [self.board.side(self.point(X), end) for X, end in zip(two, ends, strict=True)]
            P = self.board.meet(*rays, name="P")
            points = []
            for name, end, ray in zip(two, ends, rays, strict=True):
                X, N = self.point(name), self.board.foot(ray, self._acceleration(link, name))
                once = self.board.divide(X, end, P, X, N)  # a_n = omega^2 XW, and v = omega XP
                points.append(self.board.divide(X, end, P, X, once))
            return replace(self._thales(P, rays, points), by=BY_RATES)

    def _orthogonal(self, link: str, X: str) -> Mark:
        """The velocity of a point of a link, laid off from it a quarter turned."""
        velocity = self.velocities()
        start, end = velocity.vector(link, X)
        if velocity.turned:
            return velocity.shift_by(end, start, self.point(X))
        return self.board.quarter(start, end, self.point(X))

    def _acceleration(self, link: str, X: str) -> Mark:
        """The acceleration of a point of a link, laid off from it."""
        return self.board.transfer(*self.accelerations().vector(link, X), self.point(X))

    # ---- what is asked for --------------------------------------------------------------------------------------

    def draw(self, read: Callable[..., None], keep: Callable[..., None]) -> None:
        """Draw what is asked for: `read` notes what is read of which marks, `keep` that marks are drawn for themselves.
        """
        for link in self.scene.find.inflection:
            self._inflection(link, read, keep)
        for name, (point, link) in self.scene.find.curvature_points.items():
            kind, marks = self._path_reading(point, link)
            self.special += [SPECIAL[kind](name)] if kind in SPECIAL else []
            read(kind, name, *marks, given=None if marks else (0, 0))

    def _inflection(self, link: str, read: Callable[..., None], keep: Callable[..., None]) -> None:
        """The inflection circle over the pole and the inflection pole, and its mirror image in the pole."""
        circle = self.circle(link)
        if circle is None:
            two = point_pairs(self.scene, link)[0]
            ends = [mark for X in two for mark in self.velocities().vector(link, X)]
            self.special.append(SPECIAL[kinds.TRANSLATION](link_named(link)))
            read(kinds.TRANSLATION, link, *map(self.point, two), *ends)
            return
        P, W0 = circle.pole, circle.inflection
        self.ways |= {circle.by: None} if P is not W0 else {}
        read(kinds.MOTION_POLE, link, P)
        read(kinds.INFLECTION, link, P, W0)
        if P is not W0:
            with self.board.on(MECHANISM, (link,), circle_of(link)):
                R0 = self.board.transfer(W0, P, P, name="R_0")
                for opposite in (W0, R0):
                    middle = self.board.midpoint(P, opposite)
                    keep(self.board.circle(middle, self.board.opening(middle, P)))

    def _path_reading(self, point: str, link: str) -> tuple[kinds.ResultKind, tuple[Mark, ...]]:
        """Kind and marks of the result for a point's path."""
        link = min(self.scene.links_of[point], key=lambda other: (self._rank(other), other != link))
        if self._rank(link) == 0:
            return kinds.CENTRE, (self.point(point), self._pole(link))
        if self._rank(link) == 1:
            return kinds.STRAIGHT, ()
        told = link in self.known_sources or link in self.wheels or link in self.scene.find.inflection
        circle = self.circle(link) if told else None
        with self.board.on(MECHANISM, (link,), partial(centre_of, point) if circle else centre_by_rates(point)):
            return self._by_circle(circle, point) if circle else self._by_normal(point, link)

    def _rank(self, link: str) -> int:
        """Rank of a link by the paths of its points: arcs about its pivot, lines, two known centres, or the rates."""
        if FRAME in self.scene.links and {*self.scene.links[link]} & {*self.scene.links[FRAME]}:
            return 0
        sliding = any({link, FRAME} == {*slide.links} and slide.turns_alike for slide in self.scene.slides)
        return 1 if sliding else 2 if link in self.known_sources or link in self.wheels else 3

    def _by_circle(self, circle: InflectionCircle, point: str) -> tuple[kinds.ResultKind, tuple[Mark, ...]]:
        """By Euler and Savary, Bobillier or Hartmann."""
        marks = circle.pole, self.point(point), circle.inflection
        P, M, W0 = (complex(*place) for place in self.values(*marks))
        if abs(P - M) <= EXTENT_TOL * self.scene.extent:
            return kinds.CUSP, marks[:2]
        if abs(((P - M) * (W0 - M).conjugate()).real) <= EXTENT_TOL * abs(P - M) * max(abs(W0 - M), abs(P - M)):
            return kinds.STRAIGHT, marks
        return kinds.CENTRE, (marks[1], self._curvature_centre(circle, point))

    def _by_normal(self, point: str, link: str) -> tuple[kinds.ResultKind, tuple[Mark, ...]]:
        """From velocity and normal acceleration: the radius is the third proportional to the two."""
        M, end = self.point(point), self._orthogonal(link, point)
        if self._coincide(M, end) and (circle := self.circle(link)):
            return kinds.CUSP, (circle.pole, M)
        N = self.board.foot(self.board.side(M, end), self._acceleration(link, point))
        if self._coincide(M, N):
            vectors = (plan.vector(link, point) for plan in (self.velocities(), self.accelerations()))
            return kinds.STRAIGHT, (M, *chain.from_iterable(vectors))
        self.ways |= {BY_RATES: None}
        return kinds.CENTRE, (M, self.board.third(M, N, M, end, name=centre_name(point)))

    def _curvature_centre(self, circle: InflectionCircle, point: str) -> Mark:
        """The centre of curvature of a point's path, from its link's circle or from two points with known centres."""
        M, name = self.point(point), centre_name(point)
        if circle.pins and (not circle.shown or self.method in ("bobillier", "hartmann")):
            letters = {letter: letter for letter in ("W_1", "W_2", "W_0", "Q", "R", "U", "t")}
            return self.board.conjugate(circle.pole, *circle.pins, M, name=name, names=letters)
        return self.board.curved(circle.pole, M, circle.inflection, name=name, names={"W": "W", "Q": "Q"})

    def _coincide(self, *two: Mark) -> bool:
        """Whether two marks fall on one place in this pose; not where they cannot be drawn there."""
        try:
            return math.dist(*self.values(*two)) <= EXTENT_TOL * self.scene.extent
        except ConstructionError:
            return False

    def point(self, name: str) -> Mark:
        return self.pose.points[name]

    def values(self, *marks: Mark) -> list[Point]:
        """Values of marks in this pose; fails if they cannot be drawn."""
        program = freeze(self.board, marks)
        values = evaluate(program, Floats())
        return [values[index] for index in program.wanted]


# ---- acceleration centres --------------------------------------------------------------------------------------------

SIMILAR_FIGURE = said("the ends of the accelerations of a link's points, from one pole, form a figure similar to the "
                      "link's: its point without acceleration lies as the pole does")


def draw_acceleration_centre(board: Board, pose: Pose, accelerations: Callable[[], MotionPlan], link: str) -> Mark:
    """The acceleration centre of a link, on the mechanism plan.

    Fails with `Refused` where all points of the link have the same acceleration: it shifts, and there is no centre.
    Source: Ozols 1974, 9-2, fig. 9-4d.
    """
    scene = pose.scene
    if pivot := next((point for point in scene.links[link] if FRAME in scene.links_of[point]), ""):
        return pose.points[pivot]
    for A, B in point_pairs(scene, link):
        with suppress(ConstructionError):
            return _similar_triangle(board, pose, accelerations(), link, (A, B))
    raise Refused(link_named(link), said("all its points have the same acceleration"), "a link that turns")


def _similar_triangle(board: Board, pose: Pose, plan: MotionPlan, link: str, points: tuple[str, str]) -> Mark:
    """Q over two points of the link, as the pole lies to the ends of their accelerations."""
    A, B = (pose.points[name] for name in points)
    stage = Stage(said("Acceleration centre of {0}", link_named(link)), SIMILAR_FIGURE)
    with board.on(plan.panel, (link,), stage):
        (pi, a), (start, end) = (plan.vector(link, name) for name in points)
        b = end if start is pi else board.transfer(start, end, pi, name=f"{points[1]}'")
    with board.on(MECHANISM, (link,), stage):
        return board.triangle(a, b, pi, A, B, name=f"Q_{link}")
