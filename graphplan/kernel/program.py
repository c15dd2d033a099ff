"""The program: the ordered steps of a construction, their marks, the panels that bear them, and where these begin.

A line is known by its distance from the origin. Where two lines cross far off, twice as many digits would cancel as the
coordinates have in front of the figure's extent; about a place within it none do.

The plan is a part of a mark's kind: points, lines and circles are joined on one plan alone. From another plan an
operation takes vectors, openings and directions, of which it does not matter where they lie. What would join two plans
cannot be recorded: on paper they stand apart, each at its own scale.

A mark is a name for a step's result and nothing more: it has no coordinates, so a recipe cannot branch on them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple, NoReturn, Self, cast

from graphplan.errors import ConstructionError, Undrawable
from graphplan.kernel import kinds
from graphplan.kernel.elementary import Heading, Total, bearing, incident, laid_off
from graphplan.kernel.kinds import (
    CIRCLE,
    FAILURES,
    LINE,
    OPENING,
    POINT,
    TABLE,
    Choice,
    Movement,
    Primitive,
    parameter_text,
)
from graphplan.kernel.numbers import Domain
from graphplan.kernel.stages import Stage, Teller, group_by_stage
from graphplan.kernel.tolerances import MAX_DRAWN, MIN_DRAWN
from graphplan.phrases import Said, arrange, phrase, said

MAX_OFFSET = 100
"""So many extents of a figure its points may lie off zero: up to four digits of what is drawn there cancel."""


@dataclass(frozen=True)
class Origin:
    """A place far off zero."""

    x: Fraction
    y: Fraction

    def relative_coordinates(self, domain: Domain, x: Any, y: Any) -> dict[str, Any]:
        """The coordinates of a given point from this place."""
        return {"x": domain.lift(x) - domain.lift(self.x), "y": domain.lift(y) - domain.lift(self.y)}

    def absolute_marks(self, domain: Domain, kinds: Iterable[str], values: Iterable[Any]) -> list[Any]:
        """Marks that are drawn about this place, as they lie about zero; those of no kind stay as they are."""
        x, y = domain.lift(self.x), domain.lift(self.y)
        return [_shift_mark(kind, value, x, y) for kind, value in zip(kinds, values, strict=True)]

    def point(self, domain: Domain, value: Any) -> Any:
        """A point that is told from this place, as it lies about zero."""
        return _shift_mark(POINT, value, domain.lift(self.x), domain.lift(self.y))


def _shift_mark(kind: str, value: Any, x: Any, y: Any) -> Any:
    if kind in (POINT, CIRCLE):
        return value[0] + x, value[1] + y, *value[2:]
    return (value[0], value[1], value[2] - (value[0] * x + value[1] * y)) if kind == LINE else value


def origin(points: Collection[tuple[Any, Any]]) -> Origin | None:
    """A round place within these points, where they lie far off zero; None where they do not."""
    axes = [[Fraction(float(coordinate)) for coordinate in axis] for axis in zip(*points, strict=True)]
    extent = max((max(axis) - min(axis) for axis in axes), default=Fraction(0))
    if not extent or max(abs(coordinate) for axis in axes for coordinate in axis) < MAX_OFFSET * extent:
        return None
    unit = Fraction(2) ** (extent.numerator.bit_length() - extent.denominator.bit_length())
    x, y = (round((max(axis) + min(axis)) / 2 / unit) * unit for axis in axes)
    return Origin(x, y)


def on_pose(steps: Sequence[Any]) -> Iterator[str]:
    """Yield the kind of each mark on the plan of the pose's points; empty for marks of other plans, which begin at
    zero."""
    return (step.op.gives if step.panel == steps[0].panel else "" for step in steps)


def shift_steps(steps: Sequence[Any], x: Any, y: Any) -> tuple[Any, ...]:
    """The steps with the points of the pose moved by a vector."""
    return tuple(step.but(params={"x": step.params["x"] + x, "y": step.params["y"] + y})
                 if step.op.movement is Movement.GIVEN else step for step in steps)


class Panel(str):
    """A plan that steps are drawn on: its public name, which knows how it is spoken of and what stands over it.

    `whole` is the plan that it is a part of: itself but where a plan is begun at several places. What it is made of is
    kept beside the name; nobody reads it out of the name.
    """

    words: Said
    heading: Said
    whole: Panel

    def __new__(cls, name: str = "", words: Said | None = None, heading: Said | None = None) -> Self:
        self = super().__new__(cls, name)
        self.words = words or arrange("{0}", name)
        self.heading, self.whole = heading or arrange("{0:capital}", self.words), self
        return self

    @property
    def twin(self) -> Panel:
        """The plan at whose scale it is drawn, too, if there are such."""
        return self

    def caption(self, kinds: Collection[str]) -> Said:
        """Caption of the panel; `kinds` are the kinds of vector drawn on it."""
        return self.heading

    def numbered_part(self, number: int) -> Panel:
        """The part of it that is begun as this one."""
        if number == 1:
            return self
        part = Panel(f"{self}, part {number}", said("{0}, part {1}", self.words, number))
        part.whole = self
        return part


class PlansApart(TypeError):
    """An operation was given points, lines or circles of several plans."""


def require_one_plan(op: Primitive, panels: Sequence[str], names: Sequence[str]) -> None:
    """Refuse operands, by their plans and how they are called, that an operation does not take together: what it draws
    with lies on one plan, and so do both ends of each vector that it takes from another."""
    if any(panels[place] != panels[group[0]] for group in (op.same_plan_operands, *op.afar) for place in group):
        marks = ", ".join(f"{name} on {panel or 'no plan'}" for name, panel in zip(names, panels, strict=True))
        raise PlansApart(f"{op.name} was given marks of several plans ({marks}); it takes points, lines and circles of "
                         "one plan, from another a vector, an opening or a direction")


class Window(NamedTuple):
    """The part of a panel that counts as on the sheet: a circle, in plan units, and the spread of the marks there."""

    centre: tuple[float, float]
    radius: float
    width: float = math.inf

    def holds(self, point: tuple[float, float]) -> bool:
        return math.dist(point, self.centre) <= self.radius

    def shows(self, length: float) -> bool:
        """Whether a length is neither longer than the plan is wide nor too short for a pencil."""
        return math.isinf(self.width) or MIN_DRAWN <= length / self.width <= MAX_DRAWN


EVERYWHERE = Window((0.0, 0.0), math.inf)


NUMBERED = {POINT: phrase("point {0}"), LINE: phrase("line {0}"), OPENING: phrase("opening {0}"),
            CIRCLE: phrase("arc {0}")}


@dataclass(frozen=True, eq=False)
class Step:
    """One drawing step: what it makes (`name`), how (`op`), from which earlier steps (`args`, by index).

    `panel` is the plan, or the part of one, that it lies on, `why` the law or purpose, `links` the links of the
    mechanism it speaks of, `stage` tells what it is a part of, `names` are those of marks inside a compound, `choice`
    the form that begins here and why it is drawn, `quantity` what a length is drawn for. `name` is empty where the mark
    has no letter of its own.
    """

    index: int
    name: str
    op: Primitive
    args: tuple[int, ...]
    params: dict[str, Any]
    panel: Panel
    why: str = ""
    links: tuple[str, ...] = ()
    stage: Teller | None = None
    names: dict[str, str] = field(default_factory=dict)
    choice: Choice | None = None
    quantity: kinds.Quantity | None = None

    @property
    def root(self) -> int | None:
        """The step of the mark that a point is laid off from, if it is."""
        return None if self.op.root is None else self.args[self.op.root]

    def parameters(self, given: Mapping[Any, Mapping[str, Any]]) -> Mapping[str, Any]:
        """Parameters of the step: given ones by its name or index, else as recorded."""
        changed = given.get(self.name) or given.get(self.index)
        return {**self.params, **changed} if changed and changed.keys() <= self.params.keys() else self.params

    def value(self, domain: Domain, values: Sequence[Any], given: Mapping[Any, Mapping[str, Any]]) -> Any:
        """Value of the step from the values of the steps before it."""
        operands = [values[arg] for arg in self.args]
        return domain.mask_refused(self.op.rule(domain, *operands, **self.parameters(given)))

    @property
    def key(self) -> tuple[Any, ...]:
        """Key that is equal for two steps that draw the same."""
        return _key(self.op, self.args, self.params)

    def but(self, **other: Any) -> Step:
        """Copy of the step with other fields; ten times as fast as `replace`."""
        step = object.__new__(Step)
        step.__dict__.update(self.__dict__, **other)
        return step


def _key(op: Primitive, args: tuple[int, ...], params: dict[str, Any]) -> tuple[Any, ...]:
    """Return what an operation draws, whatever it is called: a symmetric one's operands have no order."""
    return op.name, tuple(sorted(args)) if op.symmetric else args, tuple(sorted(params.items())) if params else ()


class Mark:
    """A mark on the board while the construction is recorded.

    `heading` is that of a line, `total` the sum of marks that a point is; `keys` are those of the board. One `against`
    is a line that is drawn the other way.
    """

    __slots__ = ("against", "board", "heading", "keys", "step", "total")

    def __init__(self, board: Board, step: Step, heading: Heading, against: bool = False):
        self.board, self.step, self.heading, self.against = board, step, heading, against
        self.keys: dict[tuple[Any, ...], Mark] = {}
        self.total: Total = ((step.index, 1),)

    @property
    def backwards(self) -> Mark:
        """The line in the opposite sense."""
        return Mark(self.board, self.step, self.heading, not self.against)

    @property
    def kind(self) -> str:
        return self.step.op.gives

    @property
    def panel(self) -> Panel:
        """The plan that it lies on: with its kind it says what may be drawn from it."""
        return self.step.panel

    def _refuse(self, *_: object) -> NoReturn:
        raise TypeError("a mark has no value while the construction is recorded: branch on the scene, not on the pose")

    __bool__ = __float__ = __lt__ = __gt__ = __le__ = __ge__ = _refuse
    __eq__ = _refuse
    __hash__ = object.__hash__

    def __repr__(self) -> str:
        return f"<{self.kind} {self.step.name or self.step.index}>"


class Verbs:
    """The primitives of the table as methods, drawn by the `draw` of the class."""

    draw: Callable[..., Mark]

    def __getattr__(self, verb: str) -> Callable[..., Mark]:
        if verb not in TABLE:
            raise AttributeError(verb)
        return lambda *args, **given: self.draw(TABLE[verb], args, **given)

    def side(self, P: Mark, Q: Mark) -> Mark:
        """The line through two points, whichever way it runs: drawn once for both orders."""
        return self.line(*sorted((P, Q), key=lambda mark: mark.step.index))


class Board(Verbs):
    """Records drawing steps; its methods are the primitives of the table.

    The same operation on the same marks is drawn once, and so is the line that runs one way through one point; a vector
    that is laid off and straight back leads to where it began. A step is drawn on the plan of the mark that it is drawn
    at, from points, lines and circles of that plan and vectors, openings and directions of any; on a `coplanar` board
    all plans lie as one. :meth:`on` says on which plan points are given, of which links the steps speak, and which
    stage they are a part of.
    """

    def __init__(self, coplanar: bool = False) -> None:
        self.coplanar = coplanar
        self.steps: list[Step] = []
        self.marks: list[Mark] = []
        self._drawn: dict[tuple[Any, ...], Mark] = {}
        self._names: dict[str, list[Panel]] = {}  # with the plans that have a mark so called
        self.panel, self._links, self._stage = Panel(), tuple[str, ...](), cast(Teller | None, None)
        self.retell: Callable[[Teller], Teller] | None = None

    @contextmanager
    def on(self, panel: Panel | None = None, links: tuple[str, ...] | None = None,
           stage: Teller | None = None, retell: Callable[[Teller], Teller] | None = None) -> Iterator[None]:
        """Draw the steps inside on this plan, of these links, in this stage, as `retell` tells it; the rest stays."""
        before = self.panel, self._links, self._stage, self.retell
        self.panel, self._links = before[0] if panel is None else panel, before[1] if links is None else links
        retell = self.retell = retell or self.retell
        self._stage = retell(stage) if stage and retell else stage or self._stage
        try:
            yield
        finally:
            self.panel, self._links, self._stage, self.retell = before

    def draw(self, op: Primitive, args: tuple[Mark, ...], *, name: str = "", why: str = "",
             names: dict[str, str] | None = None, quantity: kinds.Quantity | None = None, **params: Any) -> Mark:
        """Record one step; names that are taken get a prime, the first name of a mark stays."""
        read = [arg.step for arg in args]
        if (kinds := tuple([step.op.gives for step in read])) != op.reads:
            raise TypeError(f"{op.name} reads {op.reads}, was given {kinds}")
        if (params or op.params) and params.keys() != set(op.params):
            raise TypeError(f"{op.name} takes the parameters {op.params}, was given {tuple(params)}")
        if [arg for arg in args if arg.board is not self]:
            raise ValueError(f"{op.name} was given a mark of another board")
        panel = read[op.where].panel if read else params.get("plan", self.panel)
        if not self.coplanar and [step for step in read if step.panel != panel]:
            require_one_plan(op, [step.panel for step in read], [step.name or step.op.gives for step in read])
        against = sum([arg.against for arg in args])
        if against and op.reversal and args[0].against:
            params = op.reverse_parameters(params)
        places = tuple([step.index for step in read])
        heading = bearing(op, [arg.heading for arg in args], len(self.steps))
        set_square = op.movement is Movement.PARALLEL or op.movement is Movement.PERPENDICULAR
        key = (*heading, places[1]) if set_square else (*_key(op, places, params),
                                                        *(quantity.sharing_key if quantity else ()))
        total = laid_off(*(arg.total for arg in args)) if op.movement is Movement.LAID_OFF and not params else None
        if total is not None:
            key = (panel, *total)
        same = self._drawn[key] if key in self._drawn else self.existing_sum(key, total)
        if same is not None and op.movement is not Movement.GIVEN:  # coincident points of the pose stay apart
            return self.oriented_mark(self.give_name(same, name), against)
        step = Step(len(self.steps), "", op, places, params, panel, why, self._links, self._stage, names or {},
                    None, quantity)
        mark = Mark(self, step, heading)
        mark.total = total or mark.total
        self.steps.append(step)
        self.marks.append(mark)
        self.index_mark(mark, key, args)
        return self.oriented_mark(self.give_name(mark, name), against)

    def existing_sum(self, key: tuple[Any, ...], total: Total | None) -> Mark | None:
        """The mark that a sum of marks is, if it is one of the same plan."""
        mark = self.marks[total[0][0]] if total and len(total) == 1 and total[0][1] == 1 else None
        return mark if mark is not None and mark.panel == key[0] else None

    def oriented_mark(self, mark: Mark, against: int) -> Mark:
        """A mark made with `against` reversed lines: a line is reversed if that number is odd."""
        return mark.backwards if against % 2 and mark.kind == LINE else mark

    def index_mark(self, mark: Mark, key: tuple[Any, ...], args: tuple[Mark, ...]) -> None:
        """Find a mark under its key, and a line by its heading and each point that lies on it by construction."""
        entries = {key: mark}
        for place in incident(mark.step.op):
            line, point = (mark, args[place]) if mark.kind == LINE else (args[place], mark)
            entries[*line.heading, point.step.index] = line
        for entry, line in entries.items():
            if entry not in self._drawn:
                self._drawn[entry] = mark.keys[entry] = line

    def give_name(self, mark: Mark, name: str, *, by_plan: bool = False) -> Mark:
        """The same mark, bearing this letter if it has none yet, with a prime where the letter is taken; `by_plan` only
        where it is taken on its own plan."""
        if name and not self.steps[mark.step.index].name:
            plan = mark.panel.whole
            while (plans := self._names.get(name)) and (plan in plans or self.coplanar or not by_plan):
                name += "'"
            self._names.setdefault(name, []).append(plan)
            self.annotate(mark.step.index, name=name)
        return mark

    def annotate(self, index: int, **notes: Any) -> None:
        """Add notes (name, why, choice) to a step that is drawn."""
        self.steps[index] = self.marks[index].step = self.steps[index].but(**notes)

    def rewind(self, length: int) -> None:
        """Take back all steps after the first `length`: a form was tried and is not used."""
        for mark in self.marks[length:]:
            for key in mark.keys:
                del self._drawn[key]
            if mark.step.name:
                self._names[mark.step.name].remove(mark.panel.whole)
        del self.steps[length:], self.marks[length:]

    def lay(self, marks: Sequence[Mark], steps: Sequence[Step]) -> None:
        """Put marks back that were taken back, with their steps before these had letters, on what they stood on."""
        for mark, step in zip(marks, steps, strict=True):
            alike = step.stage is self._stage and step.links == self._links
            mark.step = step if alike else step.but(links=self._links, stage=self._stage)
            self._drawn |= mark.keys
        self.marks += marks
        self.steps += [mark.step for mark in marks]


@dataclass(frozen=True)
class Program:
    """A frozen list of steps, in drawing order; `wanted` are the indices of the marks that results are read from."""

    steps: tuple[Step, ...]
    wanted: tuple[int, ...]
    _sentences: dict[int, Said] = field(default_factory=dict, init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        bound = set[tuple[Panel, str]]()
        for index, step in enumerate(self.steps):
            if step.index != index:
                raise ValueError(f"step {step.index} stands at place {index}")
            if step.args and not 0 <= min(step.args) <= max(step.args) < index:
                raise ValueError(f"step {index} reads a mark that is not drawn yet")
            if tuple([self.steps[arg].op.gives for arg in step.args]) != step.op.reads:
                raise ValueError(f"step {index}: {step.op.name} reads {step.op.reads}")
            if index > self.givens and step.op.movement is Movement.GIVEN:
                raise ValueError("the points of the pose come first")
            if step.name and (step.panel.whole, step.name) in bound:
                raise ValueError(f"the name {step.name} is bound twice on the {step.panel.whole}")
            bound.add((step.panel.whole, step.name))
        if any(not 0 <= index < len(self.steps) for index in self.wanted):
            raise ValueError(f"the wanted marks {self.wanted} are not all drawn")

    def __len__(self) -> int:
        return len(self.steps)

    def text(self, index: int) -> str:
        """Text of a mark: its letter, the points of a line, else its kind and step number."""
        step = self.steps[index]
        if step.name:
            return step.name
        if step.op.movement is Movement.RULED and all(_joins(self.steps[arg].name) for arg in step.args):
            return "".join(self.steps[arg].name for arg in step.args)
        return NUMBERED[step.op.gives](self.number(index))

    def text_off_sheet(self, index: int) -> str:
        """Text of a mark away from the sheet: a line by its direction, not by its number."""
        step = self.steps[index]
        if step.name or not step.op.described:
            return self.text(index)
        return step.op.described.format(*map(self.text_off_sheet, step.args))

    def given_vector(self, step: Step) -> bool:
        """Whether a point is the end of a given vector: of a quantity, and laid off by it from where a plan begins."""
        return all((step.name, step.quantity, step.op.has_size, step.root is not None
                    and self.steps[step.root].op.free))

    @cached_property
    def givens(self) -> int:
        """Number of steps that only mark the points of the pose; they come first."""
        return next((k for k, s in enumerate(self.steps) if s.op.movement is not Movement.GIVEN), len(self.steps))

    @cached_property
    def origin(self) -> Origin | None:
        """Origin about which the program is evaluated, if its points lie far off zero; None if a group of links is
        known from there."""
        points = [(step.params["x"], step.params["y"]) for step in self.steps[:self.givens]]
        return None if any("group" in step.params for step in self.steps) else origin(points)

    def number(self, index: int) -> int:
        """The number of a step as printed: the pose's own points are not counted."""
        return index + 1 - self.givens

    def sentence(self, index: int) -> Said:
        """A step in words, in the letters of the sheet; found once, as it is told more than once."""
        if index not in self._sentences:
            self._sentences[index] = self.step_text(self.steps[index])
        return self._sentences[index]

    def step_text(self, step: Step, words: Callable[..., Said] | None = None) -> Said:
        """A step of these marks in its own words, or in others that are filled in with the same."""
        params = {name: parameter_text(value) for name, value in step.params.items()}
        return (words or step.op.sentence_of)(list(map(self.text, step.args)), out=self.text(step.index), **params)

    @property
    def stages(self) -> list[tuple[Stage, list[Step]]]:
        """The stages in drawing order, each with its steps; see :func:`graphplan.kernel.stages.staged`."""
        return group_by_stage(self.steps)

    def sentence_with_reason(self, index: int) -> Said:
        """A step in words, with the law or purpose where there is one."""
        step = self.steps[index]
        return arrange("{0} ({1:capital}.)", self.sentence(index), step.why) if step.why else self.sentence(index)


def _joins(name: str) -> bool:
    """Whether a point's name can stand beside another's, as in KA: words such as pi would run together."""
    letters = name.partition("_")[0]
    return bool(name) and not (len(letters) > 1 and letters.isalpha())


def evaluate(program: Program, domain: Domain, given: Mapping[Any, Mapping[str, Any]] | None = None,
             after: Callable[[Step], None] | None = None) -> list[Any]:
    """The value of every step, in order.

    Reads a program, a number domain and, by name or index of a step, other parameters than were recorded (where a
    point is given, how a guide runs; of a point that is drawn from others its place is not); calls `after` after each
    step.
    Fails with :class:`ConstructionError` naming the step, where the domain raises; arrays give nan instead.
    """
    values = about_origin(program, domain, given, after)
    return program.origin.absolute_marks(domain, on_pose(program.steps), values) if program.origin else values


def about_origin(program: Program, domain: Domain, given: Mapping[Any, Mapping[str, Any]] | None = None,
                 after: Callable[[Step], None] | None = None) -> list[Any]:
    """Evaluate a program about its origin, if it has one."""
    values: list[Any] = []
    given, origin = given or {}, program.origin
    for step in program.steps:
        params = step.parameters(given)
        if origin and step.op.movement is Movement.GIVEN:
            params = origin.relative_coordinates(domain, **params)
        try:
            values.append(domain.mask_refused(step.op.rule(domain, *[values[arg] for arg in step.args], **params)))
        except Undrawable as fault:
            raise error_at(program, step, fault) from None
        if after is not None:
            after(step)
    return values


def error_at(program: Program, step: Step, fault: Undrawable) -> ConstructionError:
    """The rule's fault with its step attached, in the letters of the sheet."""
    names = [program.text_off_sheet(arg) for arg in step.args]
    drawing = f"{program.text(step.index)} = {step.op.name}({', '.join(names)})"
    if step.op.movement is Movement.MET:
        drawing = f"{program.text(step.index)}, where {names[0]} should meet {names[1]}"
    what_to_do = FAILURES[fault.code][1]
    return ConstructionError(fault.code, program.number(step.index), drawing, fault.why, what_to_do, step.links)
