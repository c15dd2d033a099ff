"""From compounds to single movements: each compound is drawn in the form that suits the pose.

A form is tried on the board itself, so that it may use what is drawn already; it counts only if it can be drawn and
gives the value of the compound's rule from the marks that it reads. What no form can draw in this pose stays one step.

Compounds inside a form that is tried are tried in turn, but only their best form counts: there a form is left off as
soon as it has taken as many movements as one that has nothing against it (branch and bound). So are the rivals of a
form whose choice is told, until somebody asks for them: then the program is drawn once more by what is known of it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, cached_property, partial
from itertools import combinations
from typing import Any

from graphplan.errors import ConstructionError, Undrawable
from graphplan.kernel.claims import unmet
from graphplan.kernel.coincidence import LyingLines, crossing, line_gap, runs_against
from graphplan.kernel.drawn_points import DrawnPoints
from graphplan.kernel.form_board import FormBoard
from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT, TABLE, Choice, Movement, Primitive, Rating, plain
from graphplan.kernel.known_attempts import Attempt, Start, Tried, keeps_attempts, start
from graphplan.kernel.numbers import Floats
from graphplan.kernel.panel import EVERYWHERE, PlansApart, Window
from graphplan.kernel.program import Mark, Program, Step, error_at
from graphplan.kernel.tolerances import COINCIDENCE_TOL, FORM_TOL, SHELF_SHARE

FLOATS = Floats()

# What counts as one movement: with set squares and dividers, and with compasses and straightedge alone.
STRICT = frozenset(name for name, op in TABLE.items() if not (op.compound or op.movement is Movement.INCLINED))
BY_SET_SQUARE = STRICT | {name for name, op in TABLE.items() if op.movement is not Movement.OTHER}


class Outdone(Exception):
    """Raised where a form that is tried can no longer be the best, however well it goes on."""


@dataclass
class Expander:
    """Copies a program step by step, drawing its compounds out; knows the float value of every step it has drawn.

    Reads a program, its values in the drawn pose, the operations that stay single steps, the panels' windows, and
    the forms wanted by name (`prefer`: such a form wins wherever it can be drawn at all), the figure's extent, and
    whether the values are `better` than floats give them: then forms are held to them. The rounding that forms add is
    not passed on: it would give a direction to vectors that are zero. To `weigh` is to try all forms to their end where
    the choice is told, on the board and with the attempts that it has `begun` with.
    """

    program: Program
    truth: list[Any]
    keep: frozenset[str] = BY_SET_SQUARE
    windows: Mapping[str, Window] = field(default_factory=dict)
    prefer: str = ""
    extent: float = 0.0
    better: bool = False
    weigh: bool = False
    begun: Start | None = None
    _apart: bool = field(default=False, init=False)  # each line is drawn for itself, even where one lies already

    def __post_init__(self) -> None:
        self.weigh |= keeps_attempts()  # whatever form is preferred, all are known then
        self._begin()

    def _begin(self) -> None:
        """An empty board."""
        # Compasses and straightedge alone carry no direction over but in one plane: there the plans lie as one.
        sheet = (self.keep, frozenset(self.windows.items()), self.extent, self._apart)
        self._start = self.begun or start(self.keep <= STRICT, None if self.better else sheet)
        self.board, self._alike = self._start
        self.board.rewind(0)
        self.others: dict[int, Sequence[Rating]] = {}  # by the place of a form those that it was weighed against
        self._inside: set[Primitive] = set()  # the compounds that the forms of one use
        self.values: list[Any] = []
        self.reach: list[float] = []  # the largest number that a mark was made from: its rounding counts beside that
        self.lines = LyingLines(self.values, self.reach, SHELF_SHARE * self.extent)
        self.points = DrawnPoints(self.board.steps, self.values, self.windows)
        self.place: list[int] = []  # of each step of the program its mark, and of each drawn step which step it serves
        self.serves: list[int] = []
        self.inner: dict[int, Sequence[tuple[Mark, str]]] = {}  # marks that forms name, by step of the program
        self._letters: Sequence[tuple[Mark, str]] = ()
        self.made: dict[int, tuple[str, tuple[Mark, ...]]] = {}  # as which compound a mark was drawn, and from what
        self._last_best: dict[str, str] = {}  # by compound the form that was taken last
        self._limit = math.inf  # more steps on the board, and the form that is tried is outdone

    def run(self) -> Program:
        """The expanded program. Lines that fall on one another are drawn apart where only so do they cross."""
        try:
            return self._drawn_program()
        except ConstructionError:
            if not self.weigh:
                self.weigh = True
            elif self._apart or not self.lines.fell:
                raise
            else:
                self._apart = True
            return self.run()

    @cached_property
    def _full_drawing(self) -> Expander:
        """The same program drawn once more, as it was, but that rivals are tried to their end."""
        again = replace(self, weigh=True, begun=self._start)
        again._apart = self._apart
        again.run()
        return again

    def _others_at(self, place: int) -> Sequence[Rating]:
        """The forms beside which that which begins at a place was weighed, the next best first."""
        return (self if self.weigh else self._full_drawing).others[place]

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
        """Draw one operation: as one step if it is one, else in its best form, as that was tried.

        What is only `tried` may be outdone, and is given neither letters nor reasons. A point lies where it does in
        `truth`, if that is given: what its form loses by flat crossings is not handed on.
        """
        if tried:
            attempts = [] if op.name in self.keep else self.attempts(op, args, params, tried, truth)
        else:
            attempts = self._attempts_once(op, args, params, truth if self.better else None)
        if not attempts:
            return self._record(op, args, params, why, truth)
        before, best = len(self.board.steps), attempts[0]
        out = self._redraw_attempt(best)
        if out.step.index >= before:
            self.made.setdefault(out.step.index, (op.name, args))
            self._lay_as_in_truth(op, out.step.index, truth)
        for mark, letter in best.letters if names else ():
            self.board.give_name(mark, (names or {}).get(letter, ""))
        if not tried:
            self._letters = best.letters
            self._explain(op, before, [one.rating for one in attempts], why, out)
        return out

    def _attempts_once(self, op: Primitive, args: tuple[Mark, ...], params: Mapping[str, Any],
                       truth: Any) -> list[Attempt]:
        """The forms that can be drawn and break no claim, the best first; tried once while drawings are alike."""
        what = op, tuple([(arg.step.index, arg.against) for arg in args]), tuple(sorted(params.items()))
        attempts = [] if op.name in self.keep else self._known_attempts(what, args, params, truth, self.weigh)
        if attempts and op.weighed and not self.weigh and self._breaks_a_claim(attempts[0]):
            attempts = self._known_attempts(what, args, params, truth, True)
        while attempts and self._breaks_a_claim(attempts[0]):
            del attempts[0]
        panel, form = self.board.panel, attempts[0].rating.form if attempts else ""
        self._alike = self._alike.next((*what, type(panel), panel, panel.heading, form))
        return attempts

    def _known_attempts(self, what: tuple[Any, ...], args: tuple[Mark, ...], params: Mapping[str, Any], truth: Any,
                        weigh: bool) -> list[Attempt]:
        """The forms that can be drawn, the best first, from the same place of drawings that are alike, if known."""
        op, asked = what[0], (*what, weigh and what[0].weighed)
        tried = self._alike.tried.get(asked)
        if not (tried and tried.serves(self.prefer)):
            self._inside = set()
            attempts = self.attempts(op, args, params, weigh=weigh, truth=truth)
            self._alike.tried[asked] = Tried((*attempts,), self.prefer, frozenset(self._inside), self.lines.fell,
                                             {**self._last_best})
            return attempts
        self.lines.fell |= tried.fell
        attempts = self._best_first(op, tried.attempts)
        self._last_best = {**tried.last_best}
        if attempts:
            self._last_best[op.name] = attempts[0].rating.form
        return attempts

    def _breaks_a_claim(self, attempt: Attempt) -> bool:
        """Whether a step of a form is not what it should be, as where its curves cross too flat in this pose."""
        before = len(self.values)
        self.values += attempt.values
        broken = any(unmet(mark.step, self.values, FORM_TOL, self.extent) for mark in attempt.marks)
        del self.values[before:]
        return broken

    def _redraw_attempt(self, attempt: Attempt) -> Mark:
        """What an attempt has drawn, on the board once more."""
        assert attempt.out is not None
        self.board.lay(attempt.marks, attempt.steps)
        self.values += attempt.values
        self.reach += attempt.reach
        self.lines.lay(attempt.lines)
        self.made |= attempt.made
        if len(self.values) > self._limit:
            raise Outdone
        return attempt.out

    def attempts(self, op: Primitive, args: tuple[Mark, ...], params: Mapping[str, Any],
                 tried: bool = False, truth: Any = None, weigh: bool = False) -> list[Attempt]:
        """The forms that can be drawn, the best first; of all but the first only what is told is sure to be so."""
        truth = op.rule(FLOATS, *map(self.value, args), **params) if truth is None else truth
        found: list[Attempt] = []
        place, last = {form: index for index, form in enumerate(op.forms)}, self._last_best.get(op.name)
        for form in sorted(place, key=lambda form: form != last):  # what is likely to be best bounds the others
            bound = math.inf if weigh and op.weighed else self._movement_limit(form, found, place)
            attempt = self._try(op, args, params, truth, form, bound)
            found += [attempt] if attempt else []
        self._inside |= {op} if tried else set()
        found = self._best_first(op, found)
        if found and found[0].rating.left_off:
            raise Outdone
        if found:
            self._last_best[op.name] = found[0].rating.form
        return found

    def _best_first(self, op: Primitive, found: Sequence[Attempt]) -> list[Attempt]:
        """Attempts at a compound, the best first; of equals that which a textbook would try first."""
        place = {form: index for index, form in enumerate(op.forms)}
        return sorted(found, key=lambda one: (self._rank(one.rating), place[one.rating.form]))

    def _movement_limit(self, form: str, found: Sequence[Attempt], place: Mapping[str, int]) -> float:
        """The movements that a form may take and still be better than those found, or as good and placed before."""
        if not found:
            return math.inf
        *ideal, _ = self._rank(Rating(form, 0))
        return min([one.rating.movements - (place[form] > place[one.rating.form]) for one in found
                    if self._rank(one.rating)[:-1] <= tuple(ideal)], default=math.inf)

    def _rank(self, rating: Rating) -> tuple[Any, ...]:
        return not (self.prefer and plain(rating.form) == self.prefer), *rating.rank

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
            if len(self.values) > self._limit:
                raise Outdone
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

    def _try(self, op: Primitive, args: tuple[Mark, ...], params: Mapping[str, Any], truth: Any,
             form: str, allowed: float) -> Attempt | None:
        """Draw a form without letters, in no more than the movements allowed; look at it, take it back."""
        before, limit = len(self.board.steps), self._limit
        self._limit, board = min(limit, before + allowed), FormBoard(self)
        try:
            out: Mark | None = op.forms[form](board, *args, **params)
            rating = None if out is None else self._judge(form, before)
            if out is None or rating is None:
                return None
            if not self._agrees(op, args, self.value(out), truth, before, rating.sharpest):
                return None
            self._limit_reach(op, args, out, truth, before)
            drawn = range(before, len(self.board.steps))
            new_marks = {index: self.made[index] for index in drawn if index in self.made}
            return Attempt(rating, out, self.board.marks[before:], self.values[before:], self.reach[before:],
                           self.lines.since(before), self.board.steps[before:], new_marks, board.letters)
        except (Undrawable, ZeroDivisionError, PlansApart):
            return None
        except Outdone:
            return Attempt(Rating(form, int(self._limit) + 1 - before, left_off=True))
        finally:
            self._limit = limit
            for index in range(before, len(self.board.steps)):
                self.made.pop(index, None)
            self._rewind(before)

    def _reach(self, step: Step) -> float:
        """The largest number that a mark is made from; of lines elsewhere nothing but their directions counts.

        A line through two points is as true beside the nearer of them as that is.
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
        """How much of the rounding of a vector or figure of another plan a point has: as much smaller as it is drawn
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
        lost = COINCIDENCE_TOL * reach / sharpest if sharpest > COINCIDENCE_TOL else 0.0
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

    def _judge(self, form: str, before: int) -> Rating | None:
        steps = self.board.steps[before:]
        off_sheet = [step for step in steps if step.op.gives == POINT
                     and not self.windows.get(step.panel, EVERYWHERE).holds(self.values[step.index])]
        crossings = [crossing(step, self.values) for step in steps if step.op.crossing]
        undrawn = sum([step.op.name not in self.keep for step in steps])
        return Rating(form, len(steps), not off_sheet, min(crossings, default=1.0), undrawn)

    def _explain(self, op: Primitive, before: int, ranked: list[Rating], why: str, out: Mark) -> None:
        """Tell at the first step of a form which it is, and beside which others if they were weighed; at its last what
        it is good for."""
        if out.step.index < before or len(self.board.steps) == before:
            return
        if why:
            self.board.annotate(out.step.index, why=why)
        self.others[before] = ranked[1:]
        weigh = partial(self._others_at, before) if op.weighed else tuple
        self.board.annotate(before, choice=Choice(op, ranked[0], weigh))


@cache
def _rounded_operands(op: Primitive) -> list[tuple[int, tuple[int, ...]]]:
    """The operands by whose rounding a mark is off, each with the figure of another plan that a point is drawn like."""
    counted = (place for place, kind in enumerate(op.reads) if place in op.same_plan_operands or kind != LINE)
    figures = [group for group in op.afar if op.gives == POINT and len(group) > 1
               and all(op.reads[place] == POINT for place in group)]
    return [(place, next((figure for figure in figures if place in figure), ())) for place in counted]


def _gap(op: Primitive, value: Any, truth: Any, read: float) -> float:
    """How far apart two values of a form are: of lines as far as what was read lies from the origin."""
    return line_gap(truth, value, read) if op.gives == LINE else math.dist(truth, value)
