"""Poles (instant centres) drawn: in the order of the circle diagram, and where that alone does not reach by velocities.

A pole is a marked point, or off the sheet the crossing of two lines that are drawn towards it, or at infinity a line
that heads to it: lines through it are its parallels. Which of these, and by which two lines, is chosen for the pose, as
the forms of compounds are.

Where not enough sides of the circle diagram close, the lines from two points of a link to the ends of their orthogonal
velocities cross in its pole, and the diagram goes on from there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from itertools import combinations
from typing import Any, NamedTuple

from graphplan.errors import Refused, Undrawable
from graphplan.kernel.numbers import Domain, Fractions
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.passes import needed_steps
from graphplan.kernel.program import Board, Mark, Program, error_at
from graphplan.kernel.stages import Stage
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.numerals import is_exact
from graphplan.mechanism.order import ordered_links, ordered_slides
from graphplan.methods.motion.circle_diagram import ONE, PENCIL, CircleDiagram, FoundPole, PoleLine, Sides, cross
from graphplan.methods.motion.velocity import Velocity
from graphplan.methods.panels import MECHANISM, listed
from graphplan.methods.poses import Pose
from graphplan.phrases import Said, joined, said

NEAR = 1.5  # sizes of the mechanism: a pole no further from its middle is marked
KENNEDY = said("the poles of three links relative to each other lie on one line (Aronhold-Kennedy)")
BY_VELOCITIES = said("the lines from points of a link to the ends of their orthogonal velocities meet in its pole")


class DrawnPole(NamedTuple):
    """A pole as it is drawn: its `mark`, or lines that cross in it, or one that heads to it at infinity."""

    mark: Mark | None = None
    lines: tuple[Mark, ...] = ()

    @property
    def marks(self) -> tuple[Mark, ...]:
        """What it is read from."""
        return self.lines if self.mark is None else (self.mark,)


class Poles:
    """The poles of one scene on one board, each drawn as it is asked for."""

    def __init__(self, board: Board, scene: Scene, pose: Pose, velocity: Velocity):
        self.board, self.scene, self.pose, self.velocity = board, scene, pose, velocity
        links = tuple(link for link in ordered_links(scene) if link != FRAME)
        self.diagram = CircleDiagram(scene, (*links, FRAME))
        self.seen = _Seen(board, scene)
        self.drawn: dict[Sides, DrawnPole] = {}
        self.lines: dict[tuple[Sides, PoleLine], Mark | None] = {}
        self.seeds: list[Sides] = []
        self._given()
        self.diagram.close()

    def _given(self) -> None:
        """The sides that are there at the outset: pins, and what guides have at infinity."""
        for joint in self.scene.revolutes:
            mark, at = self.pose.points[joint.at], self.scene.points[joint.at]
            for sides in combinations(joint.links, 2):
                self._enter(sides, (*at, 1), DrawnPole(mark))
        for slide in ordered_slides(self.scene):
            dx, dy = slide.direction
            if slide.turns_alike:
                self._enter(slide.links, (-dy, dx, 0), None)

    def _enter(self, links: Sequence[str], at: Any, drawn: DrawnPole | None) -> None:
        sides = self.diagram.sides(*links)
        if sides not in self.diagram.found:
            self.diagram.found[sides] = FoundPole(tuple(_plain(number) for number in at))
            if drawn:
                self.drawn[sides] = drawn

    # ---- what others ask ----------------------------------------------------------------------------------------

    def find(self, one: str, two: str) -> DrawnPole:
        """The pole of two links; fails with `Refused` where no construction known here reaches it."""
        sides = self.diagram.sides(one, two)
        while sides not in self.diagram.found and self._seed(sides):
            self.diagram.close()
        if sides not in self.diagram.found:
            raise Refused(said("the pole of {0}", listed(sides)), said("no construction known here reaches it"),
                          "ask for other poles")
        return self._draw(sides)

    def mark(self, one: str, two: str) -> Mark:
        """The pole as a marked point, wherever it is; fails with `Refused` where it is at infinity."""
        found = self.find(one, two)
        if found.mark is not None:
            return found.mark
        sides = self.diagram.sides(one, two)
        if len(found.lines) < 2:
            raise Refused(said("the pole of {0}", listed(sides)), said("it is at infinity"), "ask for other poles")
        with self.board.on(MECHANISM, self._moving(sides), self._stage(sides)):
            mark = self.board.meet(*found.lines, name=self.letter(sides))
        self.drawn[sides] = DrawnPole(mark)
        return mark

    def at_infinity(self, one: str, two: str) -> bool:
        """Whether the links turn alike in this pose."""
        return len(self.find(one, two).marks) == 1 and self.drawn[self.diagram.sides(one, two)].mark is None

    @property
    def ways(self) -> Iterator[Said]:
        """How they are found."""
        yield said("Kennedy's theorem, in the order of the circle diagram")
        if self.seeds:
            yield said("{0} by velocities", ", ".join(map(self.letter, self.seeds)))

    def letter(self, sides: Sides) -> str:
        """What a pole is called: by its two links, 0 being the frame."""
        named = ["0" if link == FRAME else link for link in sides]
        return "P_" + ("" if all(len(name) == 1 for name in named) else ",").join(named)

    # ---- drawing ------------------------------------------------------------------------------------------------

    def _draw(self, sides: Sides) -> DrawnPole:
        """A pole that is found, drawn with all that it rests on."""
        if sides in self.drawn:
            return self.drawn[sides]
        found = self.diagram.found[sides]
        if not found.lines:
            return self.drawn.setdefault(sides, DrawnPole(None, (self._across(sides),)))
        lines = [line for line in (self._line(sides, line) for line in found.lines) if line is not None]
        with self.board.on(MECHANISM, self._moving(sides), self._stage(sides)):
            if len(lines) < 2 or self.diagram.at_infinity(sides):
                self.drawn[sides] = DrawnPole(None, (lines[0],))
            elif self.diagram.distance(sides) <= NEAR:
                self.drawn[sides] = DrawnPole(self.board.meet(*lines, name=self.letter(sides)))
            else:
                self.drawn[sides] = DrawnPole(None, tuple(lines))
        return self.drawn[sides]

    def _across(self, sides: Sides) -> Mark:
        """The line that heads to the pole of two links that slide on each other, at infinity."""
        slide = next(s for s in ordered_slides(self.scene) if {*s.links} == {*sides})
        with self.board.on(MECHANISM, self._moving(sides), self._stage(sides)):
            return self.board.perpendicular(self.pose.guide(slide), self.pose.points[slide.at])

    def _line(self, sides: Sides, line: PoleLine) -> Mark | None:
        """A line on which a pole lies; none of that at infinity."""
        if (sides, line) not in self.lines:
            self.lines[sides, line] = self._through(sides, line.by) if line.drawn is None else line.drawn
        return self.lines[sides, line]

    def _through(self, sides: Sides, third: str) -> Mark | None:
        """The line through the poles that two links have with a third one."""
        P, Q = sorted((self._draw(self.diagram.sides(link, third)) for link in sides),
                      key=lambda pole: (pole.mark is None, -len(pole.lines)))
        if P.mark is None and len(P.lines) == 2:
            P = DrawnPole(self.mark(*next(pair for pair, pole in self.drawn.items() if pole is P)))
        if P.mark is None:
            return None
        with self.board.on(MECHANISM, self._moving(sides), self._stage(sides)):
            if Q.mark is not None:
                return self.board.side(P.mark, Q.mark)
            return (self.board.towards if len(Q.lines) == 2 else self.board.parallel)(*Q.lines, P.mark)

    def _moving(self, sides: Sides) -> tuple[str, ...]:
        """The links that a fault should name."""
        return tuple(link for link in sides if link != FRAME)

    def _title(self, sides: Sides) -> Said:
        return said("Pole {0} of {1}", self.letter(sides), listed(sides))

    def _stage(self, sides: Sides) -> Stage:
        found = self.diagram.found[sides]
        title = self._title(sides)
        if sides in self.seeds:
            return Stage(title, BY_VELOCITIES)
        if not found.lines:
            return Stage(title, said("the links slide on each other: their pole is at infinity, square to the guide"))
        thirds = [line.by for line in found.lines]
        told = [said("{0} and {1}", *(self.letter(self.diagram.sides(link, third)) for link in sides))
                for third in thirds]
        return Stage(title, joined((KENNEDY, said("here with {0}", joined(told, "; "))), ": "))

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
        link, other = sides
        with self.board.on(MECHANISM, self._moving(sides), Stage(self._title(sides), BY_VELOCITIES)):
            ends = [(self.pose.points[X], self._end(link, other, X)) for X in self.velocity.net.links[link]]
            still = next((X for X, x in ends if x is X or self.seen.one(X, x)), None)
            moving = [(X, x) for X, x in ends if not (x is X or self.seen.one(X, x))]
            if still is not None and moving:
                self._enter(sides, self.seen[still], DrawnPole(still))
            best = min((found for pair in combinations(moving, 2) for found in self._crossing(*pair)),
                       key=lambda found: found.error, default=None)
        if best and sides not in self.diagram.found:
            self.diagram.found[sides] = best
        if sides in self.diagram.found:
            self.seeds.append(sides)
        return sides in self.diagram.found

    def _end(self, link: str, other: str, X: str) -> Mark:
        """The end of the orthogonal velocity of a point of a link relative to another link, laid off at the point."""
        return self.velocity.orthogonal(link, X) if other == FRAME else self.velocity.slip(other, link, X)

    def _crossing(self, one: tuple[Mark, Mark], two: tuple[Mark, Mark]) -> Iterator[FoundPole]:
        """The pole from the orthogonal velocities of two points: on the lines to their ends, or where these are one, on
        the line of the points and that of the ends turned back by a quarter."""
        (X, x), (Y, y) = one, two
        if self.seen.one(X, Y):
            return
        pairs = [(self.board.side(X, x), self.board.side(Y, y))]
        if self._sine(*pairs[0]) <= ONE:
            tips = [self.board.step_across(P, p, P, ratio=-1) for P, p in (one, two)]
            pairs = [(self.board.side(X, Y), self.board.side(*tips))]
        for k, l in pairs:
            if (sine := self._sine(k, l)) > ONE:
                yield FoundPole(cross(self.seen[k], self.seen[l]), PENCIL / sine, (PoleLine("1", k), PoleLine("2", l)),
                                round=self.diagram.rounds + 1)

    def _sine(self, k: Mark, l: Mark) -> float:
        """How well two lines cross."""
        return self.diagram.sine(self.seen[k], self.seen[l], dual=True)


def _plain(number: Any) -> Any:
    """A number of the scene as it is, one between bounds as a float."""
    return number if isinstance(number, Fraction | int) else float(number)


class _Seen:
    """What is seen on the board: the numbers of marks, as vectors (x, y, 1) and (a, b, c).

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

    def one(self, P: Mark, Q: Mark) -> bool:
        """Whether two points fall on one place."""
        p, q = self[P], self[Q]
        size = max(1e-300, *(abs(float(part)) for part in (*p[:2], *q[:2])))
        gap = abs(p[0] - q[0]) + abs(p[1] - q[1])
        return bool(gap == 0 if isinstance(self.domain, Fractions) else gap <= ONE * size)

    def _value(self, mark: Mark) -> Any:
        """The value of a mark, and of all that it is made from."""
        try:
            for index in sorted(needed_steps(self.board, [mark], self._values)):
                step = self.board.steps[index]
                read = [self._values[arg] for arg in step.args]
                self._values[index] = step.op.rule(self.domain, *read, **step.params)
        except Undrawable as fault:
            if fault.code != "not-rational" or isinstance(self.domain, Floats):
                raise error_at(Program(tuple(self.board.steps), ()), step, fault) from None
            self.domain, self._values = Floats(), {}
            return self._value(mark)
        return self._values[mark.step.index]
