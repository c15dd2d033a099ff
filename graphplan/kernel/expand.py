"""Compounds drawn out into elementary steps: the first of the forms that serves, by the table's order.

A form is tried on the board itself, so that it may use what is drawn already; it counts only if it can be drawn and
gives the value of the compound's rule from the marks that it reads. It serves if its marks lie on the sheet and its
curves cross at 15 degrees or more; where none does, the form that lacks least is drawn, and what no form can draw in
this pose stays one step.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from itertools import combinations
from typing import Any, NamedTuple

from graphplan.errors import ConstructionError, Undrawable
from graphplan.kernel.claims import unmet
from graphplan.kernel.drawn import DrawnPoints, LyingLine, LyingLines, crossing, line_gap, runs_against
from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT, TABLE, Choice, Movement, Primitive, Rating, plain
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import (
    EVERYWHERE,
    Board,
    Mark,
    Panel,
    PlansApart,
    Program,
    Step,
    Verbs,
    Window,
    error_at,
)
from graphplan.kernel.tolerances import COINCIDENCE_TOL, FORM_TOL, SHELF_SHARE


class FormBoard(Verbs):
    """The board as a form sees it: the same verbs, compounds inside drawn out in turn; `letters` are marks it names."""

    def __init__(self, expander: Any):
        self._expander = expander  # of whose board it is the face
        self.letters: list[tuple[Mark, str]] = []
        self._begun = len(expander.board.steps)

    def draw(self, op: Primitive, args: tuple[Mark, ...], name: str = "", **params: Any) -> Mark:
        if op.movement is Movement.RULED and self._nothing(self.distance(*args), *args):
            raise Undrawable("points-coincide", "the two points coincide but for rounding")
        mark = self._expander.draw(op, args, params, tried=True)
        return self.name_mark(mark, name) if name else mark

    def name_mark(self, mark: Mark, name: str) -> Mark:
        """A mark that the form has a name for."""
        self.letters.append((mark, name))
        return mark

    def is_new(self, mark: Mark) -> bool:
        """Whether a mark was not on the board before the form."""
        return mark.step.index >= self._begun

    def made_by(self, mark: Mark) -> tuple[str, tuple[Mark, ...]]:
        """The operation that drew a mark, as a compound if it was one, and its operands."""
        drawn = mark.step.op.name, tuple(self._expander.board.marks[arg] for arg in mark.step.args)
        made: dict[int, tuple[str, tuple[Mark, ...]]] = self._expander.made
        return made.get(mark.step.index, drawn)

    def place(self, P: Mark) -> tuple[float, float]:
        """Place of a point."""
        x, y = self._expander.value(P)
        return x, y

    # What a draughtsman sees on the sheet, by which a form that is not for this pose gives nothing.

    def share_plan(self, *marks: Mark) -> bool:
        """Whether marks lie on one plan, so that they may be joined."""
        return self._expander.board.coplanar or len({mark.panel for mark in marks}) == 1

    def points_coincide(self, P: Mark, Q: Mark) -> bool:
        """Whether two points of a plan fall on one place."""
        return self.share_plan(P, Q) and self._nothing(self.distance(P, Q), P, Q)

    def equal(self, P: Mark, Q: Mark, R: Mark, S: Mark) -> bool:
        """Whether PQ is as long as RS."""
        return self._nothing(self.distance(P, Q) - self.distance(R, S), P, Q, R, S)

    def lies_on(self, P: Mark, l: Mark) -> bool:
        """Whether a point lies on a line of its plan."""
        (x, y), (a, b, c) = self._expander.value(P), self._expander.value(l)
        return self.share_plan(P, l) and self._nothing((a * x + b * y + c) / math.hypot(a, b), P, l)

    def lines_coincide(self, l: Mark, m: Mark) -> bool:
        """Whether two lines of a plan fall together."""
        (a, b, c), (u, v, w) = self._expander.value(l), self._expander.value(m)
        way, reach = complex(-b, a) / math.hypot(a, b), max(self._expander.reach[mark.step.index] for mark in (l, m))
        ends = (complex(-a * c, -b * c) / (a * a + b * b) + sign * reach * way for sign in (1, -1))
        return self.share_plan(l, m) and all(
            self._nothing((u * end.real + v * end.imag + w) / math.hypot(u, v), l, m) for end in ends)

    def in_line(self, P: Mark, Q: Mark, R: Mark) -> bool:
        """Whether R lies on the line of P and Q."""
        p, q, r = [complex(*self._expander.value(X)) for X in (P, Q, R)]
        return self._nothing(((q - p).conjugate() * (r - p)).imag / (abs(q - p) or 1.0), P)

    def sense_along(self, P: Mark, Q: Mark, R: Mark) -> str:
        """Sense of R from P on the line PQ: `on` towards Q, or `back`."""
        p, q, r = (complex(*self._expander.value(X)) for X in (P, Q, R))
        return "on" if ((q - p).conjugate() * (r - p)).real >= 0 else "back"

    def side_of(self, P: Mark, Q: Mark, R: Mark) -> str:
        """The side, left or right, of the ray from P to Q on which R lies."""
        p, q, r = (complex(*self._expander.value(X)) for X in (P, Q, R))
        return "left" if ((q - p).conjugate() * (r - p)).imag >= 0 else "right"

    def side_of_line(self, l: Mark, P: Mark) -> str:
        """The side, left or right, of a directed line on which a point of its plan lies."""
        (x, y), (a, b, c) = self._expander.value(P), self._expander.value(l)
        return "left" if a * x + b * y + c >= 0 else "right"

    def distance(self, P: Mark, Q: Mark) -> float:
        return math.dist(self._expander.value(P), self._expander.value(Q))

    def _nothing(self, length: float, *marks: Mark) -> bool:
        """Whether a length is negligible relative to the numbers from which these marks were made."""
        reach: list[float] = self._expander.reach
        return abs(length) <= COINCIDENCE_TOL * max([reach[mark.step.index] for mark in marks])

    def points_on(self, l: Mark) -> list[Mark]:
        """The points that a line was drawn through or that were drawn on it, the way it runs."""
        (a, b, _), values, marks = self._expander.value(l), self._expander.values, self._expander.board.marks
        through = (l.step.args[place] for place in l.step.op.claim_operands("on"))
        on = *through, *self._expander.points.on_curve(l.step.index)
        return [marks[k] for k in sorted(on, key=lambda k: values[k][0] * b - values[k][1] * a)]

    def on_sheet(self, P: Mark) -> bool:
        """Whether a point lies on the sheet of its plan."""
        return bool(self._expander.windows.get(P.panel, EVERYWHERE).holds(self._expander.value(P)))

    def drawable(self, P: Mark, length: float) -> bool:
        """Whether a length can be drawn on the plan of P; always with compasses and straightedge alone, where lengths
        are not computed."""
        return bool(self._expander.board.coplanar or self._expander.windows.get(P.panel, EVERYWHERE).shows(length))

    def clear_of(self, P: Mark, among: Sequence[Mark] | None = None) -> Mark | None:
        """The point furthest from P, of some or of all, on its plan if there is one; on the sheet, if there is one."""
        points = self._expander.points
        if among is None:
            places = points.on_plan(P.panel, True) or points.on_plan(P.panel, False)
        else:
            near = [X for X in among if X.panel == P.panel] or list(among)
            places = [X.step.index for X in [*filter(self.on_sheet, near)] or near]
        if not places:
            return None
        far = self._expander.board.marks[points.furthest(self._expander.value(P), places)]
        return None if self.points_coincide(P, far) else far


FLOATS = Floats()

# What counts as one movement: with set squares and dividers, and with compasses and straightedge alone.
STRICT = frozenset(name for name, op in TABLE.items() if not (op.compound or op.movement is Movement.INCLINED))
BY_SET_SQUARE = STRICT | {name for name, op in TABLE.items() if op.movement is not Movement.OTHER}


class Attempt(NamedTuple):
    """A form as it was tried: how well it draws, what came out, and what it put on the board, to be laid there again.

    `letters` are the marks that the form has a letter for, each with what it calls it.
    """

    rating: Rating
    out: Mark
    marks: Sequence[Mark]
    values: Sequence[Any]
    reach: Sequence[float]
    lines: Sequence[LyingLine]
    steps: Sequence[Step]  # the marks', before anything is noted at them
    made: Mapping[int, tuple[str, tuple[Mark, ...]]]
    letters: Sequence[tuple[Mark, str]]


@dataclass
class Expander:
    """Copies a program step by step, drawing its compounds out; knows the float value of every step it has drawn.

    Reads a program, its values in the drawn pose, the operations that stay single steps, the panels' windows, and
    the form wanted by name on a panel (`prefer`: it is drawn wherever it can be drawn at all), the figure's extent, and
    whether the values are `better` than floats give them: then forms are held to them. The rounding that forms add is
    not passed on: it would give a direction to vectors that are zero.
    """

    program: Program
    truth: list[Any]
    keep: frozenset[str] = BY_SET_SQUARE
    windows: Mapping[str, Window] = field(default_factory=dict)
    prefer: Callable[[Panel], str] = lambda panel: ""
    extent: float = 0.0
    better: bool = False
    _apart: bool = field(default=False, init=False)  # each line is drawn for itself, even where one lies already

    def __post_init__(self) -> None:
        self._begin()

    def _begin(self) -> None:
        """An empty board."""
        # Compasses and straightedge alone carry no direction over but in one plane: there the plans lie as one.
        self.board = Board(self.keep <= STRICT)
        self.values: list[Any] = []
        self.reach: list[float] = []  # the largest number that a mark was made from: its rounding counts beside that
        self.lines = LyingLines(self.values, self.reach, SHELF_SHARE * self.extent)
        self.points = DrawnPoints(self.board.steps, self.values, self.windows)
        self.place: list[int] = []  # of each step of the program its mark, and of each drawn step which step it serves
        self.serves: list[int] = []
        self.inner: dict[int, Sequence[tuple[Mark, str]]] = {}  # marks that forms name, by step of the program
        self._letters: Sequence[tuple[Mark, str]] = ()
        self.made: dict[int, tuple[str, tuple[Mark, ...]]] = {}  # as which compound a mark was drawn, and from what

    def run(self) -> Program:
        """The expanded program. Lines that fall on one another are drawn apart where only so do they cross."""
        try:
            return self._drawn_program()
        except ConstructionError:
            if self._apart or not self.lines.fell:
                raise
            self._apart = True
            return self.run()

    def _drawn_program(self) -> Program:
        self._begin()
        place: list[Mark] = []
        for step in self.program.steps:
            args = tuple(place[arg] for arg in step.args)
            try:
                with self.board.on(step.panel, step.links, step.stage):
                    self._letters = ()
                    mark = self.draw(step.op, args, step.params, step.why, step.names, truth=self.truth[step.index])
            except Undrawable as fault:
                raise error_at(self.program, step, fault) from None
            if step.quantity:
                self.board.annotate(mark.step.index, quantity=step.quantity)
            self.board.give_name(mark, step.name)
            place.append(self._directed_line(self.truth[step.index], mark) if mark.kind == LINE else mark)
            self.inner[step.index] = self._letters
            self.serves += [step.index] * (len(self.board.steps) - len(self.serves))
        self.place = [mark.step.index for mark in place]
        return Program(tuple(self.board.steps), tuple(self.place[index] for index in self.program.wanted))

    def _directed_line(self, truth: Any, mark: Mark) -> Mark:
        """A line as it runs in truth. A locus has no way to run: drawn out, it may run against its rule."""
        return mark.backwards if runs_against(truth, self.value(mark)) else mark

    def value(self, mark: Mark) -> Any:
        """The float value of a mark on the board."""
        value = self.values[mark.step.index]
        return tuple(-part for part in value) if mark.against else value

    def draw(self, op: Primitive, args: tuple[Mark, ...], params: Mapping[str, Any], why: str = "",
             names: Mapping[str, str] | None = None, tried: bool = False, truth: Any = None) -> Mark:
        """Draw one operation: as one step if it is one, else in the form that serves, as that was tried.

        What is only `tried` is given neither letters nor reasons. A point lies where it does in `truth`, if that is
        given: what its form loses by flat crossings is not handed on.
        """
        attempt, passed = None, list[Rating]()
        if op.name not in self.keep:
            attempt, passed = self._serving_form(op, args, params, truth if tried or self.better else None, tried)
        if attempt is None:
            return self._record(op, args, params, why, truth)
        before = len(self.board.steps)
        out = self._redraw_attempt(attempt)
        if out.step.index >= before:
            self.made.setdefault(out.step.index, (op.name, args))
            self._lay_as_in_truth(op, out.step.index, truth)
        for mark, letter in attempt.letters if names else ():
            self.board.give_name(mark, (names or {}).get(letter, ""), by_plan=True)
        if not tried:
            self._letters = attempt.letters
            self._note_choice(Choice(op, attempt.rating, tuple(passed)), before, why, out)
        return out

    def _serving_form(self, op: Primitive, args: tuple[Mark, ...], params: Mapping[str, Any], truth: Any,
                      tried: bool) -> tuple[Attempt | None, list[Rating]]:
        """The first form that serves in this pose, or lacks least, and those before it: of the preferred ones, if any
        can be drawn at all, else of the others."""
        truth = op.rule(FLOATS, *map(self.value, args), **params) if truth is None else truth
        drawable, wanted = list[Attempt](), self.prefer(self.board.panel)
        for preferred in (True, False):
            for form in (form for form in op.forms if (plain(form) == wanted) == preferred):
                attempt = self.attempt(op, args, params, truth, form)
                if attempt is None or (not tried and self._breaks_a_claim(attempt)):
                    continue
                if attempt.rating.serves:
                    return attempt, [other.rating for other in drawable]
                drawable.append(attempt)
            if drawable:
                break
        best = min(drawable, key=lambda one: one.rating.rank, default=None)
        return best, [other.rating for other in drawable if other is not best]

    def _breaks_a_claim(self, attempt: Attempt) -> bool:
        """Whether a step of a form is not what it should be, as where its curves cross too flat in this pose."""
        before = len(self.values)
        self.values += attempt.values
        broken = any(unmet(mark.step, self.values, FORM_TOL, self.extent) for mark in attempt.marks)
        del self.values[before:]
        return broken

    def _redraw_attempt(self, attempt: Attempt) -> Mark:
        """Enter the marks of an attempt on the board once more."""
        self.board.lay(attempt.marks, attempt.steps)
        self.values += attempt.values
        self.reach += attempt.reach
        self.lines.lay(attempt.lines)
        self.made |= attempt.made
        return attempt.out

    def _record(self, op: Primitive, args: tuple[Mark, ...], params: Mapping[str, Any], why: str,
                truth: Any) -> Mark:
        """Record one step and give it its value: that of `truth`, where that is known and no line runs another way."""
        mark, step = self.board.draw(op, args, why=why, **params), self.board.steps[-1]
        if mark.step.index == len(self.values):
            drawn = [self.values[arg] for arg in step.args]
            known = truth and self.better and not [arg for arg in args if arg.against]
            self.values.append(truth if known else op.rule(FLOATS, *drawn, **step.params))
            self.reach.append(self._reach(step))
            self._lay_as_in_truth(op, step.index, truth)
            if op.gives == LINE and (lying := self.lines.enter_line(step, self._apart)) is not None:
                run = self.value(mark)
                self._rewind(step.index)
                old = self.board.marks[lying]
                return self._directed_line(run, Mark(self.board, old.step, old.heading))
        return mark

    def _lay_as_in_truth(self, op: Primitive, index: int, truth: Any) -> None:
        """Lay a point where it lies in truth, unless floats tell that no better."""
        rounding = 0.0 if self.better else COINCIDENCE_TOL * max(self.extent, self.reach[index])
        if truth and op.gives == POINT and math.dist(self.values[index], truth) > rounding:
            self.values[index] = truth

    def _rewind(self, length: int) -> None:
        """Take back all steps after the first `length`."""
        self.board.rewind(length)
        del self.values[length:], self.reach[length:]
        self.lines.rewind(length)
        self.points.rewind(length)

    def attempt(self, op: Primitive, args: tuple[Mark, ...], params: Mapping[str, Any], truth: Any,
                form: str) -> Attempt | None:
        """Draw a form without letters, look at it, take it back."""
        before, board = len(self.board.steps), FormBoard(self)
        try:
            out: Mark | None = op.forms[form](board, *args, **params)
            if out is None:
                return None
            rating = self._rating(form, before)
            parallel = rating.sharpest < COINCIDENCE_TOL  # but for rounding: where they cross no pencil can tell
            if parallel or not self._agrees(op, args, self.value(out), truth, before, rating.sharpest):
                return None
            self._limit_reach(op, args, out, truth, before)
            drawn = range(before, len(self.board.steps))
            new_marks = {index: self.made[index] for index in drawn if index in self.made}
            return Attempt(rating, out, self.board.marks[before:], self.values[before:], self.reach[before:],
                           self.lines.since(before), self.board.steps[before:], new_marks, board.letters)
        except (Undrawable, ZeroDivisionError, PlansApart):
            return None
        finally:
            for index in range(before, len(self.board.steps)):
                self.made.pop(index, None)
            self._rewind(before)

    def _reach(self, step: Step) -> float:
        """The largest number from which a mark is made; for lines elsewhere only their directions count.

        A line through two points is as accurate near the nearer of them as that point is.
        """
        if step.op.movement is Movement.RULED:
            return min([self.reach[arg] for arg in step.args])
        value = self.values[step.index]
        reach_of_step = (math.hypot(*value[:2]) if step.op.gives in (POINT, CIRCLE)
                         else math.sqrt(value[0]) if step.op.gives == OPENING else 0.0)
        for place, figure in _rounded_operands(step.op):
            reach = self.reach[step.args[place]]
            reach_of_step = max(reach_of_step, reach * self._share(step, figure) if figure else reach)
        return reach_of_step

    def _share(self, step: Step, figure: Sequence[int]) -> float:
        """Share of the rounding of a vector or figure of another plan in a point: as much smaller as it is drawn
        smaller."""
        extent = max(math.dist(self.values[step.args[first]], self.values[step.args[second]])
                     for first, second in combinations(figure, 2))
        return min(1.0, math.hypot(*self.values[step.index]) / extent) if extent else 1.0

    def _agrees(self, op: Primitive, args: tuple[Mark, ...], value: Any, truth: Any, before: int,
                sharpest: float) -> bool:
        """Whether a form gave the rule's value but for rounding, by the steps that it has drawn.

        Flat crossings and marks far away lose digits. What is further off is another thing: a wrong branch, or a form
        for other poses. Small as it may be beside the sheet, the next flat crossing makes it large.
        """
        read = self._reach_of(args)
        if op.gives == LINE:
            locus = op.claim_operands("locus") or op.claim_operands("concurrent")
            if runs_against(truth, value) and not locus:
                return False
            spread = read
        else:
            plan = args[op.where].panel
            spread = max([math.dist(truth, self.value(arg)) for arg in args if arg.kind == POINT and arg.panel == plan],
                         default=read)
        used = [index for step in self.board.steps[before:] for index in (step.index, *step.args)]
        reach = max([read, *map(self.reach.__getitem__, used)])
        lost = COINCIDENCE_TOL * reach / sharpest
        return _gap(op, value, truth, read) <= max(COINCIDENCE_TOL * read, min(FORM_TOL * spread, lost))

    def _limit_reach(self, op: Primitive, args: tuple[Mark, ...], out: Mark, truth: Any, before: int) -> None:
        """A mark that is as true as what its form read is made from no larger numbers, wherever the form has led."""
        read, index = self._reach_of(args), out.step.index
        if index >= before and _gap(op, self.value(out), truth, read) <= COINCIDENCE_TOL * read:
            own = math.hypot(*truth[:2]) if op.gives == POINT else 0.0
            self.reach[index] = min(self.reach[index], max(read, own))

    def _reach_of(self, marks: tuple[Mark, ...]) -> float:
        """The largest number that any of these marks was made from."""
        return max([self.reach[mark.step.index] for mark in marks])

    def _rating(self, form: str, before: int) -> Rating:
        steps = self.board.steps[before:]
        off_sheet = [step for step in steps if step.op.gives == POINT
                     and not self.windows.get(step.panel, EVERYWHERE).holds(self.values[step.index])]
        crossings = [crossing(step, self.values) for step in steps if step.op.crossing]
        undrawn = sum([step.op.name not in self.keep for step in steps])
        return Rating(form, len(steps), not off_sheet, min(crossings, default=1.0), undrawn)

    def _note_choice(self, choice: Choice, before: int, why: str, out: Mark) -> None:
        """Tell at the first step of a form which it is; at its last what it is good for."""
        if out.step.index < before or len(self.board.steps) == before:
            return
        if why:
            self.board.annotate(out.step.index, why=choice.compound.reasons.get(choice.form, why))
        self.board.annotate(before, choice=choice)


@cache
def _rounded_operands(op: Primitive) -> list[tuple[int, tuple[int, ...]]]:
    """The operands by whose rounding a mark is off, each with the figure of another plan that a point is drawn like."""
    counted = (place for place, kind in enumerate(op.reads) if place in op.same_plan_operands or kind != LINE)
    figures = [group for group in op.afar if op.gives == POINT and len(group) > 1
               and all(op.reads[place] == POINT for place in group)]
    return [(place, next((figure for figure in figures if place in figure), ())) for place in counted]


def _gap(op: Primitive, value: Any, truth: Any, read: float) -> float:
    """Distance between two values of a form; of lines within the distance of the operands from the origin."""
    return line_gap(truth, value, read) if op.gives == LINE else math.dist(truth, value)
