"""Points placed as the scene says, and positions of links that a sheet shows.

Links that a drive holds together are one body: of it all lengths are known, whichever way it lies. Vectors of its
figure are the parameters of what is drawn from them.

The pose of a construction is given; this is a program of its own that draws the pose from the scene's placements, for
those who begin with an empty sheet.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from graphlib import TopologicalSorter
from typing import Any

from graphplan.errors import Refused, by_name
from graphplan.kernel.elementary import dot
from graphplan.kernel.passes import freeze
from graphplan.kernel.positions import Angle
from graphplan.kernel.program import Board, Mark, Program
from graphplan.kernel.stages import Stage
from graphplan.mechanism.fields import vector
from graphplan.mechanism.model import FRAME, Assembly, Number, Pair, Placement, Scene, Slide
from graphplan.mechanism.numbers import exactly, minus, plus, times
from graphplan.mechanism.order import ordered_points
from graphplan.mechanism.pairs.pair import LinkAttitude
from graphplan.mechanism.placements import needs
from graphplan.mechanism.travel import STILL, following, turned_about, undone
from graphplan.methods.motion.network import Network
from graphplan.methods.panels import MECHANISM, list_links
from graphplan.methods.tolerances import PARALLEL_TOL
from graphplan.phrases import Said, digits, said


def figure(v: Pair, u: Pair) -> dict[str, Number]:
    """A vector of a link's figure beside another, as parameters."""
    return {"dx": v[0], "dy": v[1], "ux": u[0], "uy": u[1]}


def angle(v: Pair) -> Angle:
    """The direction of a vector, spoken in degrees from the x-axis."""
    x, y = map(float, v)
    return Angle(digits(round(math.degrees(math.atan2(y, x)), 6), 6), *v)


def runs_along(v: Pair, u: Pair) -> bool:
    """Whether a vector runs along another, or has no length."""
    (x, y), (a, b) = map(float, v), map(float, u)
    return abs(a * y - b * x) <= PARALLEL_TOL * (abs(a) + abs(b)) * (abs(x) + abs(y))


def same_place(one: Pair, other: Pair) -> bool:
    """Whether two places of a figure are one."""
    pairs = zip(map(float, one), map(float, other), strict=True)
    return all(abs(p - q) <= PARALLEL_TOL * (abs(p) + abs(q)) for p, q in pairs)


def widest(drawn: Sequence[tuple[Pair, Mark]]) -> tuple[tuple[Pair, Mark], tuple[Pair, Mark]] | None:
    """The two of some marks that lie furthest apart; None if all lie in one place."""
    pairs = [(one, two) for k, one in enumerate(drawn) for two in drawn[k + 1:] if not same_place(one[0], two[0])]
    return max(pairs, key=lambda ends: math.dist(*([float(part) for part in place] for place, _ in ends)), default=None)


@dataclass
class Body:
    """Links that drives hold together: how each lies in the body's own figure, and what is drawn of it.

    `spots` are marks of it without a name in the scene, by their place in the figure; `heading` is a line that runs as
    a vector of the figure does.
    """

    top: str
    lies: dict[str, LinkAttitude]
    spots: list[tuple[Pair, Mark]] = field(default_factory=list)
    heading: tuple[Pair, Mark] | None = None


class Placing:
    """The bodies of a scene, of which `placed` are drawn so far; `marks` are those of its points."""

    def __init__(self, board: Board, scene: Scene, assembly: Assembly):
        self.board, self.scene, self.assembly, self.given = board, scene, assembly, assembly.given_scene
        self.net = Network(self.given)
        self.marks: dict[str, Mark] = {}
        self.lines: dict[str, Mark] = {}
        self.bodies = {top: Body(top, {link: self._attitude(link) for link in members})
                       for top, members in self.net.members.items()}
        self.ground = self.bodies.setdefault(self.net.ground or FRAME, Body(FRAME, {FRAME: STILL}))
        self.placed = [self.ground]
        self._mark_fixed_points()

    # ---- figures of bodies ------------------------------------------------------------------------------------------

    def _attitude(self, link: str) -> LinkAttitude:
        """Position of a link in its body, after its drives have moved it."""
        if link not in self.net.welds:
            return STILL
        weld = self.net.welds[link]
        x, y = self.assembly.moves[self.given.drives.index(weld.drive)]
        here = (turned_about(self.given.points[weld.at], x, weld.sign * y) if weld.slide is None
                else LinkAttitude(weld.sign * x, weld.sign * y, 1, 0))
        return following(here, self._attitude(weld.to))

    def _first_body_with(self, point: str) -> Body:
        """The first body placed of those that have a point; `Refused` of one that a lever thinks in."""
        if point not in self.given.links_of:
            why = said("no known construction determines it")
            raise Refused(said("point {0}", point), why, "the pose as it is given")
        bodies = [self.bodies[self.net.body[link]] for link in self.given.links_of[point]] or [self.ground]
        return next(body for body in self.placed if any(body is one for one in bodies))

    def _figure(self, body: Body, point: str) -> Pair:
        """Place of a point in a body's figure."""
        link = next((link for link in body.lies if point in self.given.links.get(link, ())), FRAME)
        at: Pair = body.lies.get(link, STILL).place_of(self.given.points[point])
        return at

    def _drawn_marks(self, body: Body, links: tuple[str, ...] = ()) -> list[tuple[Pair, Mark]]:
        """The marks of a body, or of some links of it, by their places in its figure."""
        names = dict.fromkeys(point for link in links or body.lies for point in self.given.links.get(link, ())
                              if point in self.marks and point not in self.assembly.riding)
        return [(self._figure(body, name), self.marks[name]) for name in names] + ([] if links else body.spots)

    # ---- points and lines of a body that is placed -------------------------------------------------------------------

    def mark(self, point: str) -> Mark:
        """The mark of a point of the scene."""
        point = self.assembly.riding.get(point, point)
        if point not in self.marks:
            body = self._first_body_with(point)
            self.marks[point] = self._mark_at(body, self._figure(body, point), self.given.links_of[point], point)
        return self.marks[point]

    def _mark_at(self, body: Body, at: Pair, links: tuple[str, ...] = (), name: str = "") -> Mark:
        """The mark at a place of a body's figure: one that is there, else one that is drawn from two of the same link,
        or from two of the body."""
        links = tuple(link for link in links if link in body.lies and link != FRAME)
        for own in (links, ()):
            drawn = self._drawn_marks(body, own) if own or not links or body is not self.ground else []
            same = next((mark for place, mark in drawn if same_place(place, at)), None)
            if same is not None:
                return self.board.give_name(same, name)
            if found := widest(drawn):
                (p, P), (q, Q) = found
                return self._corner(P, Q, minus(at, p), minus(q, p), name)
        if links and body is self.ground:
            link = next((link for link in links if not self._at_root(body, link, at)), links[0])
            return self._driven_mark(body, link, at, name)
        drawn = self._drawn_marks(body)
        if drawn and body is self.ground:
            dx, dy = minus(at, drawn[0][0])
            return self.board.lay_off(drawn[0][1], dx=dx, dy=dy, name=name)
        if not drawn or body.heading is None:
            raise self._unknown(*body.lies)
        (p, P), (u, line) = drawn[0], body.heading
        with self.board.on(MECHANISM, tuple(body.lies)):
            return self.board.set_off(line, P, **figure(minus(at, p), u), name=name)

    def _at_root(self, body: Body, link: str, at: Pair) -> bool:
        """Whether a place is the very joint about which a link is driven."""
        weld = self.net.welds[link]
        return weld.slide is None and same_place(self._figure(body, weld.at), at)

    def _unknown(self, *links: str) -> Refused:
        """The error where no way is known to find where links are."""
        why = said("no steps are known that find where they are at this travel")
        return Refused(str(list_links(sorted(links, key=by_name))), why, "the pose as it is given")

    def _corner(self, P: Mark, Q: Mark, v: Pair, u: Pair, name: str) -> Mark:
        return self.board.corner(P, Q, **figure(v, u), name=name)

    def _driven_mark(self, body: Body, link: str, at: Pair, name: str) -> Mark:
        """The first mark of a link that is driven from the frame: a crank laid off, or a slider moved along."""
        weld = self.net.welds[link]
        law = (said("{0} lies at the angle of its drive, at the length of its link", name or link)
               if weld.drive in self.scene.drives and weld.slide is None else
               said("{0} lies at the angle that the ratio of the gears gives its link", name or link)
               if weld.slide is None else
               said("{0} has moved along its guide by the travel of its drive", name or link))
        with self.board.on(MECHANISM, (link,), self._stage(law, (link,))):
            if weld.slide is None:
                root = self._figure(body, weld.at)
                return self.board.crank(self.mark(weld.at), angle=angle(minus(at, root)), name=name)
            before = undone(LinkAttitude(weld.sign * self._move(weld)[0], weld.sign * self._move(weld)[1], 1, 0), at)
            line = self._line(body, before, weld.slide.direction)
            shift = self.assembly.shifts[self.given.drives.index(weld.drive)]
            start = self._mark_at(body, before)
            return self.board.lay_along(line, start, length=weld.sign * shift, name=name)

    def _move(self, weld: Any) -> Pair:
        return self.assembly.moves[self.given.drives.index(weld.drive)]

    def _line(self, body: Body, p: Pair, u: Pair) -> Mark:
        """The line through a place of a body's figure that runs as a vector of it does."""
        drawn = self._drawn_marks(body)
        on = [(place, mark) for place, mark in drawn if runs_along(minus(place, p), u)]
        if ends := widest(on):
            (one, P), (two, Q) = ends
            return self.board.line(P, Q) if float(dot(u, minus(two, one))) > 0 else self.board.line(Q, P)
        P = on[0][1] if on else self._mark_at(body, p)
        if body.heading and runs_along(body.heading[0], u):
            along, line = body.heading
            return self.board.parallel(line if float(dot(along, u)) > 0 else line.backwards, P)
        if body is self.ground:
            return self.board.guide(P, dx=u[0], dy=u[1])
        far = 2.0 ** round(math.log2(self.scene.extent / 4 / math.hypot(*map(float, u))))
        far = int(far) if far >= 1 else far
        return self.board.line(P, self._mark_at(body, plus(p, times(far, u))))

    def _path(self, slide: Slide, body: Body, at: Pair) -> Mark:
        """The line on what is placed along which a place of a body's figure slides."""
        mover, guide = (link for link in sorted(slide.links, key=lambda link: link not in body.lies))
        on = self.bodies[self.net.body[guide]] if guide in self.net.body else self.ground
        lies = on.lies.get(guide, STILL)
        return self._line(on, lies.place_of(undone(body.lies[mover], at)), lies.turn_vector(slide.direction))

    def _heads(self, slide: Slide, body: Body) -> Pair:
        """The direction of a slide in a body's figure."""
        way: Pair = next(lies for link, lies in body.lies.items() if link in slide.links).turn_vector(slide.direction)
        return way

    def guide(self, slide: Slide) -> Mark:
        """The guide of a slide through its point, as its direction runs."""
        given, point = next((one for one in self.given.slides if one.name == slide.name), None), self.mark(slide.at)
        if given is None:  # a support of an assumed motion: it stands as the loads of this pose say
            return self.board.guide(point, dx=slide.direction[0], dy=slide.direction[1])
        slide = given
        if slide.name in self.lines:
            return self.board.parallel(self.lines[slide.name], point)
        body = self.bodies.get(self.net.body.get(slide.along, ""), self.ground)
        lies = body.lies.get(slide.along, STILL)
        line = self._line(body, lies.place_of(self.given.points[slide.at]), lies.turn_vector(slide.direction))
        return self.board.parallel(line, point)

    # ---- the ground --------------------------------------------------------------------------------------------------

    def _mark_fixed_points(self) -> None:
        """Mark the points that stand still, and on a guide of the frame without such a point, one of its points."""
        with self.board.on(MECHANISM):
            fixed = [name for name in ordered_points(self.given) if name not in self.assembly.riding
                     and (FRAME in (links := self.given.links_of[name]) or not links)]
            for name in fixed:
                x, y = self.given.points[name]
                self.marks[name] = self.board.given(x=x, y=y, name=name)
            for slide in self.net.all_slides:
                at = self.given.points[slide.at]
                if FRAME in slide.links and (slide not in self.net.slides or not any(
                        runs_along(minus(place, at), slide.direction) for place, _ in self._drawn_marks(self.ground))):
                    self.ground.spots.append((at, self.board.given(x=at[0], y=at[1], name=f"{slide.at}_0")))

    def _stage(self, law: Said, links: tuple[str, ...]) -> Stage:
        return Stage(said("Position of {0}", list_links(links)), law)


def layout(scene: Scene) -> Program:
    """The steps that put every point of the scene in its place, each after those it is measured from; where the pose is
    constructed, those that stand still."""
    board = Board()
    marks: dict[str, Mark] = {}
    waiting = {name: [p for p in needs(placement) if p in scene.placements] for name, placement in
               scene.placements.items()}
    order = list(TopologicalSorter(waiting).static_order())
    for name, placement in scene.placements.items():
        line: Any = placement.data.get("on")
        if placement.how == "arc-line" and not isinstance(line["through"], str):
            x, y = line["through"]
            marks[name + "_0"] = board.given(x=x, y=y, name=name + "_0")
    for name in sorted(order, key=lambda point: scene.placements[point].how != "given"):
        marks[name] = board.give_name(_draw_point(board, scene, name, scene.placements[name], marks), name)
    return freeze(board, [marks[name] for name in scene.points if name in marks])


def _draw_point(board: Board, scene: Scene, name: str, placement: Placement, marks: dict[str, Mark]) -> Mark:
    """One point, by the instruments that its placement names."""
    data: dict[str, Any] = placement.data
    match placement.how:
        case "polar":
            start = scene.points[data["from"]]
            dx, dy = (p - q for p, q in zip(scene.points[name], start, strict=True))
            distance, angle = (digits(float(data[key]), 6) for key in ("distance", "angle"))
            why = said("{0} long, at {1} degrees from +x", distance, angle)
            return board.lay_off(marks[data["from"]], dx=dx, dy=dy, why=why)
        case "compass":
            one, two = (_arc(board, marks[centre], r) for centre, r in data["distances"].items())
            return board.circles_meet(one, two, side=data["side"])
        case "arc-line":
            ((centre, r),) = data["distances"].items()
            way = "on" if data["pick"] == "right" else "back"
            guide = _guide(board, scene, name, data["on"], marks)
            return board.line_meets_circle(guide, _arc(board, marks[centre], r), way=way)
        case "on-line":
            one, two = (marks[end] for end in data["on"].split())
            if not data["distance"]:
                return one
            way = "on" if data["distance"] > 0 else "back"
            return board.line_meets_circle(board.line(one, two), _arc(board, one, abs(data["distance"])), way=way)
        case "turned down":
            centre, arm = (marks[end] for end in data["from"].split())
            return _turned_down(board, centre, arm, data)
    x, y = scene.points[name]
    return board.given(x=x, y=y)


def _arc(board: Board, centre: Mark, radius: Any) -> Mark:
    return board.circle(centre, board.radius(length=radius))


def _turned_down(board: Board, centre: Mark, arm: Mark, data: dict[str, Any]) -> Mark:
    """The end of a joint's arm turned down into the plane of drawing about the trace, and a share of the arm there."""
    dx, dy = data["trace"]
    if data.get("flat"):
        return board.foot(board.guide(centre, dx=dx, dy=dy), arm)
    if data["cosine"] != 1:
        foot = board.foot(board.guide(centre, dx=dx, dy=dy), arm)
        arm = board.step_off(foot, arm, foot, ratio=1 / data["cosine"], why=said(
            "the circle turned down about the trace: heights over it grow as 1 : cos delta, {0}",
            digits(float(data["cosine"]), 6)))
    return board.step_off(centre, arm, centre, ratio=data["share"],
                          why=said("the crank that moves as the joint in space does, seen in the plane"))


def _guide(board: Board, scene: Scene, name: str, on: dict[str, Any], marks: dict[str, Mark]) -> Mark:
    """The line of an arc-and-line placement."""
    through = marks[on["through"]] if isinstance(on["through"], str) else marks[name + "_0"]
    dx, dy, _ = vector(on["direction"], lambda point: exactly(scene.points[point]))
    return board.guide(through, dx=dx, dy=dy)
