"""Poles (instant centres) drawn: in the order of the circle diagram, and where that alone does not reach by velocities.

A pole is a marked point, or off the sheet the crossing of two lines that are drawn towards it, or at infinity a line
that heads to it: lines through it are its parallels. Which of these, and by which two lines, is chosen for the pose, as
the forms of compounds are.

Where not enough sides of the circle diagram close, the lines from two points of a link to the ends of their orthogonal
velocities cross in its pole, and the diagram goes on from there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from itertools import combinations, product
from typing import Any, NamedTuple

from graphplan.errors import Refused, Undrawable
from graphplan.kernel.numbers import Domain, Floats, Fractions
from graphplan.kernel.passes import needed_steps
from graphplan.kernel.program import Board, Mark
from graphplan.kernel.stages import Stage
from graphplan.mechanism.model import FRAME, Pair, Scene, Slide
from graphplan.mechanism.numbers import is_exact
from graphplan.mechanism.order import Key, by_name
from graphplan.mechanism.pairs.contact import Contact
from graphplan.mechanism.pairs.gear import Gear
from graphplan.mechanism.replaced import RollingGuide
from graphplan.methods.assembly import Pose
from graphplan.methods.motion.circle_diagram import (
    EQUAL,
    CircleDiagram,
    DrawnCircle,
    DrawnSide,
    FoundPole,
    PoleLine,
    Sides,
    cross,
)
from graphplan.methods.motion.velocity import Velocity
from graphplan.methods.panels import MECHANISM, SHEET_EXTENTS, link_named, list_links, pole_letter
from graphplan.methods.tolerances import MIN_SIZE, PENCIL, PLACE_TOL, SINE_TOL
from graphplan.phrases import Said, join, said

MAX_LINK_POINTS = 6  # points of a link whose velocities are looked at
MAX_POLE_EXTENTS = 1.5  # sizes of the mechanism: no further from its middle a pole is marked that is not asked for
KENNEDY = said("the poles of three links relative to each other lie on one line (Aronhold-Kennedy)")
PITCH_POINT = said("the links roll on each other in the pitch point: there they have one velocity")
ACROSS = said("the links slide on each other: their pole is at infinity, perpendicular to the guide")
NORMAL = said("profiles that touch slide along their tangent: the pole lies on the common normal")
BY_VELOCITIES = said("the lines from points of a link to the ends of their orthogonal velocities meet in its pole")


class Unseen(Exception):
    """Raised if a mark cannot be drawn in this pose."""

    def __init__(self, mark: Mark):
        self.mark = mark


class DrawnPole(NamedTuple):
    """A pole as it is drawn: its `mark`, or lines that cross in it, or one that heads to it at infinity."""

    mark: Mark | None = None
    lines: tuple[Mark, ...] = ()

    @property
    def marks(self) -> tuple[Mark, ...]:
        """Marks of the pole: its point or its lines."""
        return self.lines if self.mark is None else (self.mark,)


class Poles:
    """The poles of one scene on one board, each drawn as it is asked for."""

    def __init__(self, board: Board, scene: Scene, pose: Pose, velocity: Velocity | None = None):
        self.board, self.scene, self.pose, self.order, self._velocity = board, scene, pose, pose.order, velocity
        self.diagram = CircleDiagram(scene, (*sorted(scene.moving, key=self.order.link), scene.frame))
        self.seen = _Seen(board, scene)
        self.drawn: dict[Sides, DrawnPole] = {}
        self.lines: dict[tuple[Sides, PoleLine], Mark | None] = {}
        self.seeds: list[Sides] = []
        self.requested: list[Sides] = []  # by whoever wants them all drawn
        self._pins()
        self._lines()
        self.outset = frozenset(self.diagram.found)

    # ---- what is there at the outset --------------------------------------------------------------------------

    def _pins(self) -> None:
        """Joints, and where profiles or wheels roll on each other."""
        for joint in sorted(self.scene.revolutes, key=lambda joint: self.order.point(joint.at)):
            for links in combinations(sorted(joint.links, key=self.order.link), 2):
                self._enter(links, DrawnPole(self.pose.points[joint.at]))
        for gear in sorted(self.scene.gears, key=self._place):
            with self._in_stage(gear.links, PITCH_POINT):
                self._enter(gear.links, self._pitch_point(gear))
        for contact in sorted(self.scene.contacts, key=self._place):
            if contact.rolling:
                self._enter(contact.links, DrawnPole(self.pose.points[contact.at]))

    def _lines(self) -> None:
        """Enter the poles of guides at infinity, and the common normals of profiles that slide on each other."""
        for slide in sorted(self.scene.slides, key=self._place):
            with self._in_stage(slide.links, ACROSS):
                across = self.board.perpendicular(self.pose.guide(slide), self.pose.points[slide.at])
            self._enter(slide.links, DrawnPole(None, (across,)))
        for contact in sorted(self.scene.contacts, key=self._place):
            if not contact.rolling:
                with self._in_stage(contact.links, NORMAL):
                    normal = self._normal(contact)
                self.diagram.enter_line(self.diagram.sides(*contact.links), PoleLine(contact.at, normal),
                                        self.seen[normal])

    def _place(self, pair: Slide | Gear | Contact) -> tuple[int | Key, ...]:
        """Sort key of a pair in the order of drawing."""
        return *map(self.order.link, pair.links), by_name(pair.name)

    def _pitch_point(self, gear: Gear) -> DrawnPole:
        """The pitch point; of equal pulleys of an open belt, which turn alike, the line of centres heads to it."""
        for slide in self.pose.scene.slides:
            if isinstance(slide, RollingGuide) and slide.given_pair == gear:
                return DrawnPole(self.pose.points[slide.at])
        one, *other = (self.pose.points[centre] for centre in gear.centres)
        letter = pole_letter(gear.links)
        if not other:
            across = self.board.perpendicular(self._pitch_line(gear, one), one)
            return DrawnPole(self.board.lay_along(across, one, length=-gear.radius, name=letter))
        whole = gear.factors[0] + gear.factors[1]
        if not whole:
            return DrawnPole(None, (self.board.side(one, *other),))
        return DrawnPole(self.board.step_off(one, *other, one, ratio=gear.factors[0] / whole, name=letter))

    def _normal(self, contact: Contact) -> Mark:
        """The common normal of two profiles."""
        one, *other = (self.pose.points[centre] for centre in contact.centres if centre)
        if other:
            return self.board.side(one, *other)
        return self.board.perpendicular(self._pitch_line(contact, self.pose.points[contact.at]), one)

    def _pitch_line(self, pair: Gear | Contact, through: Mark) -> Mark:
        """A line along the pitch line of a rack, or a straight profile."""
        if pair.through:
            return self.board.line(*(self.pose.points[end] for end in pair.through))
        dx, dy = pair.direction or (0, 0)
        return self.board.guide(through, dx=dx, dy=dy)

    def _enter(self, links: Sequence[str], drawn: DrawnPole) -> None:
        """Enter a drawn pole, unless the pole of its links is known."""
        sides = self.diagram.sides(*links)
        if sides not in self.diagram.found:
            x, y, w = self.seen[drawn.marks[0]]
            self.diagram.enter(sides, FoundPole((x, y, w) if drawn.mark is not None else (y, -x, 0)))
            self.drawn[sides] = drawn

    # ---- what others ask ----------------------------------------------------------------------------------------

    def find(self, one: str, two: str) -> DrawnPole:
        """The pole of two links; fails with `Refused` where no known construction determines it."""
        sides = self.diagram.sides(one, two)
        if sides not in self.diagram.found:
            self.diagram.close({sides, *self.requested})
        while sides not in self.diagram.found and self._seed(sides):
            self.diagram.close({sides, *self.requested})
        if sides not in self.diagram.found:
            raise Refused(said("the pole of {0}", list_links(sides)), said("no known construction determines it"),
                          "ask for other poles")
        return self._draw(sides)

    def draw(self, names: Iterable[str]) -> None:
        """Draw those of the poles of this name that the diagram gives: they need no velocities."""
        poles = {self.diagram.sides(*self.scene.link_pair(name)) for name in names}
        self.requested = sorted(poles, key=self.diagram.places)
        self.diagram.close(self.requested)
        for sides in self.requested:
            if sides in self.diagram.found:
                self._draw(sides)

    def frame_poles(self) -> Iterator[tuple[str, Pair]]:
        """The links whose poles relative to the frame the circle diagram gives, no pins, each with where it is."""
        self.diagram.close([(link, FRAME) for link in self.scene.moving])
        for sides, found in self.diagram.found.items():
            if sides[1] == FRAME and sides not in self.outset and self.diagram.distance(sides) <= MAX_POLE_EXTENTS:
                x, y, w = found.at
                yield sides[0], (x / w, y / w)

    def mark(self, one: str, two: str) -> Mark:
        """The pole as a marked point, wherever it is; fails with `Refused` where it is at infinity."""
        pole = self.find(one, two)
        if pole.mark is not None:
            return pole.mark
        sides = self.diagram.sides(one, two)
        if len(pole.lines) < 2:
            raise Refused(said("the pole of {0}", list_links(sides)), said("it is at infinity"), "ask for other poles")
        with self._in_stage(sides, self._law(sides)):
            mark = self.board.meet(*pole.lines, name=pole_letter(sides))
        self.drawn[sides] = DrawnPole(mark)
        return mark

    def at_infinity(self, one: str, two: str) -> bool:
        """Whether the pole of two links was found to be at infinity: they turn alike in this pose."""
        drawn = self.drawn.get(self.diagram.sides(one, two))
        return drawn is not None and drawn.mark is None and len(drawn.lines) == 1

    @property
    def methods(self) -> Iterator[Said]:
        """Yield the methods of the poles."""
        yield said("Kennedy's theorem, in the order of the circle diagram")
        if self.seeds:
            yield said("{0} by velocities", ", ".join(map(pole_letter, self.seeds)))

    @property
    def circle(self) -> DrawnCircle | None:
        """The circle diagram as far as it is drawn, if anything is found by it."""
        closed = [sides for sides in self.drawn if sides not in self.outset]
        outset = [DrawnSide(sides, 0) for sides in self.diagram.found if sides in self.outset]
        sides = (*outset, *(DrawnSide(sides, number) for number, sides in enumerate(closed, 1)))
        return DrawnCircle((*sorted(self.scene.moving, key=by_name), self.scene.frame), sides) if closed else None

    # ---- drawing ------------------------------------------------------------------------------------------------

    def _draw(self, sides: Sides) -> DrawnPole:
        """A pole that is found, drawn with all that it rests on."""
        if sides in self.drawn:
            return self.drawn[sides]
        found = self.diagram.found[sides]
        for link, line in product(sides, found.lines):
            if line.drawn is None:
                self._draw(self.diagram.sides(link, line.by))  # before its own lines are begun
        lines = [line for line in (self._line(sides, line) for line in found.lines) if line is not None]
        with self._in_stage(sides, self._law(sides)):
            if len(lines) < 2 or self.diagram.at_infinity(sides):
                self.drawn[sides] = DrawnPole(None, (lines[0],))
            elif self.diagram.distance(sides) <= (SHEET_EXTENTS if sides in self.requested else MAX_POLE_EXTENTS):
                self.drawn[sides] = DrawnPole(self.board.meet(*lines, name=pole_letter(sides)))
            else:
                self.drawn[sides] = DrawnPole(None, tuple(lines))
        return self.drawn[sides]

    def _line(self, sides: Sides, line: PoleLine) -> Mark | None:
        """A line on which a pole lies; None for the line at infinity."""
        if (sides, line) not in self.lines:
            self.lines[sides, line] = self._line_of_poles(sides, line.by) if line.drawn is None else line.drawn
        return self.lines[sides, line]

    def _line_of_poles(self, sides: Sides, third: str) -> Mark | None:
        """The line through the poles that two links have with a third one."""
        P, Q = sorted((self._draw(self.diagram.sides(link, third)) for link in sides),
                      key=lambda pole: (pole.mark is None, -len(pole.lines)))
        if P.mark is None and len(P.lines) == 2:
            P = DrawnPole(self.mark(*next(pair for pair, pole in self.drawn.items() if pole is P)))
        if P.mark is None:
            return None
        with self._in_stage(sides, self._law(sides)):
            if Q.mark is not None:
                return self.board.side(P.mark, Q.mark)
            return (self.board.towards if len(Q.lines) == 2 else self.board.parallel)(*Q.lines, P.mark)

    def _in_stage(self, links: Sequence[str], law: Said) -> AbstractContextManager[None]:
        """Draw the steps inside in the stage of a pole, which has this law."""
        sides = sorted(links, key=lambda link: (link == FRAME, by_name(link)))
        one, two = map(link_named, sides)
        stage = Stage(said("Pole {0} of {1} relative to {2}", pole_letter(sides), one, two), law)
        return self.board.on(MECHANISM, tuple(link for link in sides if link != FRAME), stage)

    def _law(self, sides: Sides) -> Said:
        """Why a pole lies on the two lines that it is found by."""
        if sides in self.seeds:
            return BY_VELOCITIES
        told = [said("of {0} and {1}", *(self._letter_of(self.diagram.sides(link, line.by)) for link in sides))
                if line.drawn is None else said("the common normal in {0}", line.by)
                for line in self.diagram.found[sides].lines]
        return said("{0}; here on the lines {1}", KENNEDY, join(told, "; "))

    def _letter_of(self, sides: Sides) -> str:
        """A pole by its letter, and that of the joint that it is."""
        drawn = self.drawn.get(sides)
        name = drawn.mark.step.name if drawn and drawn.mark is not None else ""
        return f"{pole_letter(sides)} = {name}" if name in self.scene.points else pole_letter(sides)

    @property
    def velocity(self) -> Velocity:
        """The velocities by which poles are found that the diagram does not reach."""
        assert self._velocity is not None
        return self._velocity

    # ---- by velocities ------------------------------------------------------------------------------------------

    def _seed(self, wanted: Sides) -> bool:
        """Find one more pole by velocities: that of a link relative to the frame, the wanted one's links first."""
        order = sorted(self.diagram.links[:-1], key=lambda link: link not in wanted)
        for sides in ((link, FRAME) for link in order):
            if sides not in self.diagram.found and self._by_velocities(sides):
                return True
        return FRAME not in wanted and self._by_velocities(wanted)

    def _by_velocities(self, sides: Sides) -> bool:
        """Whether the velocities of two points tell the pole of two links, one relative to the other."""
        with self._in_stage(sides, BY_VELOCITIES):
            ends = [(self.pose.points[X], self._end(*sides, X)) for X in self._points(sides)]
            still = next((X for X, x in ends if x is X or self.seen.points_coincide(X, x)), None)
            moving = [(X, x) for X, x in ends if not (x is X or self.seen.points_coincide(X, x))]
            if still is not None and moving:
                self._enter(sides, DrawnPole(still))
            best = min(self._crossings(moving), key=lambda found: found.error, default=None)
        if best and sides not in self.diagram.found:
            self.diagram.enter(sides, best)
        if sides in self.diagram.found:
            self.seeds.append(sides)
        return sides in self.diagram.found

    def _points(self, sides: Sides) -> list[str]:
        """Points that lie apart, to take velocities of: a link's own, and where it has fewer than two others, too."""
        net = self.velocity.net
        points = [X for link in sides if link != FRAME for X in net.links[link]]
        first = {net.spot(X): X for X in reversed(points)}
        if len(first) < 2:
            first |= {net.spot(X): X for X in self.order.points() if net.spot(X) not in first}
        return list(first.values())[:MAX_LINK_POINTS]

    def _end(self, link: str, other: str, X: str) -> Mark:
        """The end of the orthogonal velocity of a point of a link relative to another link, laid off at the point."""
        return self.velocity.orthogonal(link, X) if other == FRAME else self.velocity.slip(other, link, X)

    def _crossings(self, moving: Sequence[tuple[Mark, Mark]]) -> list[FoundPole]:
        """The pole from the orthogonal velocities of two points, by all pairs of points: on the lines to their ends.
        Only if all these cross flat, and some coincide in this pose, on the line of the points and that of the ends
        turned back by a quarter: in other poses the pole does not lie there."""
        pairs = [(one, two) for one, two in combinations(moving, 2) if not self.seen.points_coincide(one[0], two[0])]
        crossings = [(pair, self._crossing(*(self.board.side(X, x) for X, x in pair))) for pair in pairs]
        poles = [found for _, found in crossings if found]
        if any(found.error <= EQUAL * PENCIL for found in poles):
            return poles
        on_points = (self._crossing(self.board.side(*(X for X, _ in pair)),
                                    self.board.side(*(self.board.step_across(X, x, X, ratio=-1) for X, x in pair)))
                     for pair, found in crossings if not found)
        return [*poles, *filter(None, on_points)]

    def _crossing(self, k: Mark, l: Mark) -> FoundPole | None:
        """The pole where two lines cross, if they do."""
        if (sine := self._sine(k, l)) <= SINE_TOL:
            return None
        return FoundPole(cross(self.seen[k], self.seen[l]), PENCIL / sine, (PoleLine("1", k), PoleLine("2", l)))

    def at_rest(self, one: str, two: str) -> bool:
        """Whether two links do not move relative to each other, by two pins or though no pair says so: any point is a
        pole then."""
        sides = self.diagram.sides(one, two)
        if sides in self.outset:
            return sum({*sides} <= {*joint.links} for joint in self.scene.revolutes) > 1
        ends = [(self.pose.points[X], self._end(*sides, X)) for X in self._points(sides)[:2]]
        return len(ends) == 2 and all(X is x or self.seen.points_coincide(X, x) for X, x in ends)

    def _sine(self, k: Mark, l: Mark) -> float:
        """Sine of the angle between two lines."""
        return self.diagram.sine(self.seen[k], self.seen[l], dual=True)


class _Seen:
    """Values of the marks on the board, as vectors (x, y, 1) and (a, b, c).

    They are fractions wherever the scene is rational and roots do not hinder it, else floats.
    """

    def __init__(self, board: Board, scene: Scene):
        self.board = board
        exact = not scene.irrational and all(map(is_exact, scene.points.values()))
        self.domain: Domain = Fractions() if exact else Floats()
        self._values: dict[int, Any] = {}

    def __getitem__(self, mark: Mark) -> Any:
        value = self._value(mark)
        value = tuple(-part for part in value) if mark.against else value
        return (*value, 1) if len(value) == 2 else value

    def points_coincide(self, P: Mark, Q: Mark) -> bool:
        """Whether two points fall on one place."""
        p, q = self[P], self[Q]
        size = max(MIN_SIZE, *(abs(float(part)) for part in (*p[:2], *q[:2])))
        gap = abs(p[0] - q[0]) + abs(p[1] - q[1])
        return bool(gap == 0 if isinstance(self.domain, Fractions) else gap <= PLACE_TOL * size)

    def _value(self, mark: Mark) -> Any:
        """The value of a mark, and of all that it is made from."""
        try:
            for index in sorted(needed_steps(self.board, [mark], self._values)):
                step = self.board.steps[index]
                read = [self._values[arg] for arg in step.args]
                self._values[index] = step.op.rule(self.domain, *read, **step.params)
        except Undrawable as fault:
            if fault.code != "not-rational" or isinstance(self.domain, Floats):
                raise Unseen(self.board.marks[step.index]) from None
            self.domain, self._values = Floats(), {}
            return self._value(mark)
        return self._values[mark.step.index]
