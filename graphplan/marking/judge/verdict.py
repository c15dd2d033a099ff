"""The judgement of a drawing: a verdict on every step and number, and the state of every result that is asked for."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from graphplan.design.hand import SeenPencil
from graphplan.kernel.kinds import POINT, Movement
from graphplan.marking.judge import measures
from graphplan.marking.traces import Frames, StudentNumber, Trace, mark_name
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import CYCLE, ResultKind
from graphplan.methods.recorded import Reading
from graphplan.phrases import Said, join, phrase
from graphplan.sheet.layout.composition import Composition

RIGHT, FOLLOWS, IMPLIED, WRONG, MISSING, UNCLEAR, UNSEEN = (
    "right", "follows", "implied", "wrong", "missing", "unsure", "unseen")
STATES = {
    RIGHT: phrase("correct"),
    FOLLOWS: phrase("correct after an earlier mistake"),
    IMPLIED: phrase("implied by a correct mark"),  # by a right mark that rests on it
    WRONG: phrase("wrong"),
    MISSING: phrase("missing"),
    UNCLEAR: phrase("unclear: look here"),  # something is there, or should be: the teacher has the word
    UNSEEN: phrase("not visible"),  # of a kind that the drawing does not show, and nothing that is right rests on it
}
EARNED = frozenset({RIGHT, FOLLOWS, IMPLIED})  # what was done as it should be
NOT_NEEDED = phrase("not needed")
AS_THE_TASK = join(())  # nothing need be said of how a drawing was read


@dataclass(frozen=True)
class Ellipse:
    """The tolerance of a point about where it should be: half axes in mm of paper, and the first one's angle in the
    plan, in degrees."""

    major: float
    minor: float
    angle: float


@dataclass(frozen=True)
class Verdict:
    """What is said of one drawn step, by its place in the drawn program; lengths are mm of paper.

    `off` is how far what was drawn is from what the student's own earlier marks ask for, `tolerance` how far it may be
    in that direction, `astray` how far it is from the true drawing, which errors that went before explain where the
    step is right; all three are infinite of a line or an arc that was drawn by mistake and is not to be seen.
    `expected` is where it should be after the earlier marks, in plan units, as the kernel has it; `mistake` says what
    was probably done, at the step `guilty`, which may be an earlier one that is not to be seen. `confidence` is how
    likely the verdict is the right one, from 0 to 1; `by_teacher` whether it is the teacher's own.
    """

    step: int
    state: str
    off: float = 0.0
    tolerance: float = 0.0
    astray: float = 0.0
    trace: Trace | None = None
    expected: tuple[float, ...] = ()
    ellipse: Ellipse | None = None
    mistake: Said | None = None
    kind: str = ""
    guilty: int | None = None
    confidence: float = 1.0
    by_teacher: bool = False

    @property
    def at_fault(self) -> int:
        """The step that is wrong: an earlier one that is probably to blame, or this."""
        return self.step if self.guilty is None else self.guilty


@dataclass(frozen=True)
class NumberVerdict:
    """Verdict on one number of the table: `off` and `tolerance` in the scene's units, and the true value; `again` are
    later numbers for the same result, which are not judged."""

    number: StudentNumber
    state: str
    off: float
    tolerance: float
    true: tuple[float, ...]
    mistake: Said | None = None
    kind: str = ""
    again: tuple[StudentNumber, ...] = ()


class FaultCount(NamedTuple):
    """Number of wrong and of missing marks, and of points whose letters a reading does not use."""

    wrong: float
    missing: int
    strange_letters: int


@dataclass(frozen=True)
class Judgement:
    """All that is said of a drawing.

    `frames` is where each plan lies on the student's sheet; `spare` are the traces that no step asks for. `reading`
    says as what it was read, where that is not what the task's own sheet has; `pencil` is the one that its marks tell.
    `unasked` are numbers of results that the scene asks for none of, `left_out` arcs too small to be seen.
    `has_own_numbers` says whether the steps are numbered as on the task's sheet; `other_pose` is the pose that was
    drawn instead of the task's, as `--at` takes it. `drawn_right` are the results that the marks show as they
    truly are, `told` the verdicts of the teacher on results.
    """

    name: str
    drawing: Construction
    composition: Composition
    frames: Frames
    verdicts: tuple[Verdict, ...]
    spare: tuple[Trace, ...] = ()
    numbers: tuple[NumberVerdict, ...] = ()
    reading: Said = AS_THE_TASK
    pencil: SeenPencil | None = None
    unasked: tuple[StudentNumber, ...] = ()
    left_out: tuple[str, ...] = ()
    has_own_numbers: bool = True
    other_pose: str = ""
    drawn_right: frozenset[tuple[str, str]] = frozenset()
    told: Mapping[tuple[str, str], str] = field(default_factory=dict)

    def overrule(self, told: Mapping[str, str]) -> Judgement:
        """Return the judgement with the teacher's own verdicts: on steps by their numbers, on given points by their
        letters, and on results by their kind and object."""
        drawn = self.drawing.drawn
        names = {verdict.step: str(max(drawn.number(verdict.step), 0) or drawn.text(verdict.step))
                 for verdict in self.verdicts}
        states = {step: told[name] for step, name in names.items() if name in told}
        results: dict[tuple[str, str], str] = {(result.kind, result.of): told[result.name]
                                               for result in asked_results(self) if result.name in told}
        verdicts = tuple(replace(verdict, state=states[verdict.step], mistake=None, kind="", guilty=None,
                                 confidence=1.0, by_teacher=True) if verdict.step in states else verdict
                         for verdict in self.verdicts)
        numbers = tuple(replace(number, state=results.get((number.number.kind, number.number.of), number.state))
                        for number in self.numbers)
        return replace(self, verdicts=verdicts, numbers=numbers, told=results)

    @property
    def without_doubtful_mistakes(self) -> Judgement:
        """The judgement in which all that is wrong, or follows from it, is to be looked at, where the first mistake is
        not sure: less likely than in a picture it has to be, hardly beyond what is allowed, or at a point without
        letters, which nobody dots."""
        first = self.first_wrong
        if first is None:
            return self
        step = self.drawing.drawn.steps[first.at_fault]
        is_small = first.off < measures.MAX_TOLERANCES_OFF * first.tolerance
        is_dotted = bool(step.name) or step.op.gives != POINT
        if first.confidence >= measures.MIN_PICTURE_MISTAKE_CHANCE and is_dotted and not is_small:
            return self
        return replace(self, verdicts=tuple(
            replace(verdict, state=UNCLEAR, mistake=None, kind="", guilty=None) if verdict.state in (WRONG, FOLLOWS)
            else verdict for verdict in self.verdicts))

    @property
    def counting_verdicts(self) -> list[Verdict]:
        """The verdicts that count: what is given counts only where it is wrong, and a plan may begin anywhere."""
        steps = self.drawing.drawn.steps
        return [verdict for verdict in self.verdicts if verdict.state == WRONG or not steps[verdict.step].op.free]

    @property
    def counts(self) -> dict[str, int]:
        """Number of steps by verdict."""
        state_counts = Counter(verdict.state for verdict in self.counting_verdicts)
        return {state: state_counts[state] for state in STATES}

    @property
    def fault_count(self) -> FaultCount:
        """Faults of the reading."""
        states = Counter(verdict.state for verdict in self.verdicts)
        strange_letters = sum(trace.kind == POINT and bool(mark_name(trace.label)) for trace in self.spare)
        return FaultCount(states[WRONG], states[MISSING], strange_letters)

    def is_measured(self, verdict: Verdict) -> bool:
        """Whether a step can be seen and has a place of its own: a plan begins where its marks agree that it does."""
        begun = self.drawing.drawn.steps[verdict.step].op.movement is Movement.BEGUN
        return verdict.trace is not None and (not begun or verdict.state == WRONG)

    @property
    def asks_nothing(self) -> bool:
        """Whether the task is empty, as all results are zero or given; and no number was handed in."""
        return len(self.drawing.drawn) == self.drawing.drawn.givens and not self.numbers

    @property
    def has_drawn(self) -> bool:
        """Whether any step was drawn: what is given is there before."""
        return any(verdict.trace is not None for verdict in self.counting_verdicts)

    @property
    def is_blank(self) -> bool:
        """Whether the sheet is blank: without a step or a number, or any mark that the task does not give."""
        return not (self.has_drawn or self.numbers or self.spare or self.unasked or self.first_wrong)

    @property
    def first_wrong(self) -> Verdict | None:
        """The verdict that shows the first wrong step, in drawing order; None if no step is wrong."""
        wrong = (verdict for verdict in self.verdicts if verdict.state == WRONG)
        return min(wrong, key=lambda verdict: verdict.at_fault, default=None)

    @property
    def first_wrong_step(self) -> int | None:
        """The first wrong step itself, by its place in the drawn program: a later one that is seen may show it."""
        return None if self.first_wrong is None else self.first_wrong.at_fault


# ---- the results that a task asks for -------------------------------------------------------------------------------


@dataclass(frozen=True)
class AskedResult:
    """A result that is asked for and its state, by the truth: that of its number, if there is one, else what its marks
    show."""

    kind: ResultKind
    of: str
    state: str

    @property
    def name(self) -> str:
        """Key of the verdict in a teacher's decisions: kind and name of the result."""
        return f"{self.kind} {self.of}".strip()


def result_marks(drawing: Construction, reading: Reading) -> frozenset[int]:
    """The steps that show a result, without points of the pose and beginnings of plans."""
    marks = (drawing.drawn.wanted[place] for place in reading.marks)
    return frozenset(mark for mark in marks if not drawing.drawn.steps[mark].op.free)


def asked_results(judgement: Judgement) -> Iterator[AskedResult]:
    """All of them. What only given points show is asked for in a table alone; what is too small to be drawn, and what
    is prescribed, is not asked for: a wrong number of it counts nevertheless."""
    numbers = {(verdict.number.kind, verdict.number.of): verdict.state for verdict in judgement.numbers}
    states = {verdict.step: verdict.state for verdict in judgement.verdicts}
    for reading in judgement.drawing.readings:
        state = judgement.told.get((reading.kind, reading.of)) or numbers.get((reading.kind, reading.of))
        if state is None:
            mark_states = {states[mark] for mark in result_marks(judgement.drawing, reading)}
            is_right = (reading.kind, reading.of) in judgement.drawn_right
            state = _state_of_marks(mark_states, is_right) if judgement.has_drawn or judgement.asks_nothing else MISSING
        if state != UNSEEN and (reading.given is None or state == WRONG):
            yield AskedResult(reading.kind, reading.of, state)
    for kind, of in numbers:
        if kind in CYCLE:  # asked for as far as it is handed in
            yield AskedResult(CYCLE[kind], of, numbers[kind, of])


def _state_of_marks(states: Collection[str], is_right: bool) -> str:
    """What marks say together of a result that they show as it truly is, or not."""
    worst = next((state for state in (MISSING, UNCLEAR, UNSEEN) if state in states), None if states else UNSEEN)
    return worst or (RIGHT if is_right else WRONG if WRONG in states else FOLLOWS)
