"""What is found of a drawing: counted, in words, as data, and as the words beside it: counts and score, the first
wrong step, what the colours mean, what is wrong."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from graphplan.kernel.kinds import POINT
from graphplan.kernel.passes import steps_behind
from graphplan.kernel.program import Program
from graphplan.marking.judge.score import GROUPS, KINDS, Score
from graphplan.marking.judge.verdict import (
    FOLLOWS,
    MISSING,
    NOT_NEEDED,
    RIGHT,
    STATES,
    UNCLEAR,
    WRONG,
    Judgement,
    NumberVerdict,
    Verdict,
    asked_results,
    result_marks,
)
from graphplan.marking.traces import StudentNumber
from graphplan.methods.kinds import WORDS
from graphplan.methods.panels import reactions_named
from graphplan.phrases import Said, arrange, coordinates, digits, join, phrase, said, unit
from graphplan.sheet.lettering.lettering import HEADING, Runs, sentence_runs
from graphplan.sheet.words.rows import Cell, TextRow, table_rows
from graphplan.sheet.words.texts import SheetWords

SIGNIFICANT_DIGITS = 2  # of a distance on paper
OFF_WORD, ALLOWED_WORD = phrase("off"), phrase("allowed")
VERDICT_TITLE = said("Verdict")
LEGEND_WORDS_MM = 11.0  # mm: where the words of the legend begin


def count_words(judgement: Judgement) -> Said:
    """Number of steps by verdict, in words, with the unneeded marks."""
    parts = [arrange("{0} {1}", count, STATES[state]()) for state, count in judgement.counts.items() if count]
    if judgement.spare:
        parts.append(arrange("{0} {1}", len(judgement.spare), NOT_NEEDED()))
    return join(parts)


@dataclass(frozen=True, order=True)
class StepName:
    """Name of a step in any construction: its printed number, 0 for a given one, and its mark."""

    number: int
    mark: str

    @property
    def short(self) -> str:
        """The number, or of what is given the letter."""
        return str(self.number) if self.number else self.mark

    @property
    def words(self) -> Said:
        """In words: a step by its number, a point of the pose by its name."""
        return said("step {0}", self.number) if self.number else said("the given point {0}", self.mark)

    @property
    def words_with_mark(self) -> Said:
        """Name with the mark, as another construction may have another step of this number."""
        return join((self.words, self.mark)) if self.number else self.words


def step_name(drawn: Program, index: int) -> StepName:
    """Name of a construction's step."""
    return StepName(max(drawn.number(index), 0), drawn.text(index))


def step_words(drawn: Program, index: int) -> Said:
    """A step of a construction in words."""
    return step_name(drawn, index).words


def wrong_mark(judgement: Judgement, verdict: Verdict) -> Said:
    """Name of the faulty mark: a textbook's mark, of the step, of the result to which it leads before the one that
    shows it, of that one, or of the next; and the step's number if the student's sheet has it; a point of the pose by
    its name."""
    program = judgement.drawing.drawn
    step = step_words(program, verdict.at_fault)
    led_to = [later.index for later in program.steps[verdict.at_fault + 1:]
              if is_book_mark(program, later.index) and verdict.at_fault in steps_behind(program.steps, {later.index})]
    results = {mark for reading in judgement.drawing.readings for mark in result_marks(judgement.drawing, reading)}
    first = led_to[0] if led_to and led_to[0] in results and led_to[0] < verdict.step else verdict.step
    marks = [index for index in (verdict.at_fault, first) if is_book_mark(program, index)] or led_to
    if not marks or verdict.at_fault < program.givens:
        return step
    mark = program.text(marks[0])
    return arrange("{0} ({1})", mark, step) if judgement.has_own_numbers else arrange("{0}", mark)


def book_mark_words(judgement: Judgement) -> Said:
    """Number of textbook marks by verdict; empty if there are no such marks to judge."""
    counts = Counter(verdict.state for verdict in judgement.counting_verdicts
                     if is_book_mark(judgement.drawing.drawn, verdict.step))
    return join([arrange("{0} {1}", counts[state], STATES[state]()) for state in STATES if counts[state]])


def is_book_mark(drawn: Program, index: int) -> bool:
    """Whether a step makes a point that has letters of its own."""
    step = drawn.steps[index]
    return step.op.gives == POINT and bool(step.name) and index >= drawn.givens


def opinion(judgement: Judgement) -> Said:
    """The main finding: the first wrong step, or else result, or that all are right, or that the sheet is empty."""
    first = judgement.first_wrong
    if first is not None:
        return said("First wrong is {0}: {1}.", wrong_mark(judgement, first), remark(judgement, first))
    if judgement.asks_nothing:
        return said("There is nothing to draw: all that is asked for is zero or given.")
    if judgement.is_blank:
        return said("The sheet is blank: nothing that was asked for is on it.")
    if wrong := wrong_numbers(judgement):
        return wrong_number(judgement, wrong[0])
    if not (judgement.has_drawn or judgement.numbers):
        return said("Nothing that was asked for is recognized: look at the sheet.")
    if judgement.counts[UNCLEAR]:
        return said("No step is surely wrong; some are to be looked at.")
    return said("No step is wrong.")


def reading_lines(judgement: Judgement) -> list[Said]:
    """Pose and interpretation of a drawing; empty if it is drawn as the task's own sheet is."""
    pose, reading = judgement.other_pose, judgement.reading
    return ([said("Drawn in another pose than the task's: as with --at {0}.", pose)] * bool(pose)
            + [said("Read as {0}.", reading)] * bool(reading))


def summary_lines(judgement: Judgement) -> list[Said]:
    """Number of lettered points and steps by verdict, the pencil, if the drawing shows it, and repeated or unneeded
    marks."""
    lines = [said("Lettered points: {0}.", marks)] if (marks := book_mark_words(judgement)) else []
    lines.append(said("Steps: {0}.", count_words(judgement)))
    if judgement.pencil is not None:
        lines.append(said("Pencil read off the drawing: {0}.", judgement.pencil.description))
    lines += [repeated_number(judgement, number) for number in judgement.numbers if number.again]
    if judgement.unasked:
        lines.append(said("Not asked for, and not counted: {0}.", join(
            [result_named(judgement, number.kind, number.of) for number in judgement.unasked])))
    if judgement.left_out:
        lines.append(said("Too small to be measured, and left out: {0}.", join(judgement.left_out)))
    return lines


def first_wrong_sentence(judgement: Judgement) -> list[Said]:
    """Sentence of the first wrong step; empty if no step is wrong."""
    program, guilty = judgement.drawing.drawn, judgement.first_wrong_step
    return ([] if guilty is None
            else [arrange("{0:capital}: {1}", step_words(program, guilty), program.sentence(guilty))])


def look_at_lines(judgement: Judgement) -> list[Said]:
    """Unclear and missing steps, and results; empty if there are no such steps."""
    lines = []
    if unsure := step_numbers(judgement, UNCLEAR):
        lines.append(said("Unclear steps, to be looked at: {0}.", unsure))
    if missing := step_numbers(judgement, MISSING):
        lines.append(arrange("{0:capital}: {1}.", STATES[MISSING](), missing))
    if absent := not_handed_in(judgement):
        lines.append(said("Results that are not handed in: {0}.", join(absent)))
    return lines


def not_handed_in(judgement: Judgement) -> list[Said]:
    """The results that were asked for, and are neither drawn nor in a table."""
    absent = (result for result in asked_results(judgement) if result.state == MISSING)
    return [result_named(judgement, result.kind, result.of) for result in absent]


def wrong_numbers(judgement: Judgement) -> list[NumberVerdict]:
    """The numbers of the table that are wrong."""
    return [number for number in judgement.numbers if number.state == WRONG]


def complaint(judgement: Judgement, verdict: Verdict) -> Said:
    """Fault of a step: its place, the probable mistake, its distance, and the allowed one."""
    return arrange("{0:capital}: {1}", step_words(judgement.drawing.drawn, verdict.at_fault),
                   remark(judgement, verdict))


def remark(judgement: Judgement, verdict: Verdict) -> Said:
    """Fault of a step without its number; an invisible one with the number of the step that shows it; an invisible line
    has no distance."""
    if verdict.mistake is not None and not math.isfinite(verdict.off):
        return verdict.mistake
    sizes = said("{0} mm off, {1} mm allowed",
                 *(digits(length, SIGNIFICANT_DIGITS) for length in (verdict.off, verdict.tolerance)))
    if verdict.mistake is None:
        return sizes
    if verdict.at_fault == verdict.step:
        return join((verdict.mistake, sizes))
    return said("{0}, seen at {1}: {2}", verdict.mistake, step_words(judgement.drawing.drawn, verdict.step), sizes)


def step_numbers(judgement: Judgement, state: str = MISSING) -> str:
    """The numbers of the steps of a state, as `3, 7-9`."""
    program = judgement.drawing.drawn
    numbers = [program.number(verdict.step) for verdict in judgement.counting_verdicts if verdict.state == state]
    ranges: list[list[int]] = []
    for number in numbers:
        if ranges and ranges[-1][-1] == number - 1:
            ranges[-1].append(number)
        else:
            ranges.append([number])
    return ", ".join(str(numbers_in_row[0]) if len(numbers_in_row) == 1
                     else f"{numbers_in_row[0]}–{numbers_in_row[-1]}" for numbers_in_row in ranges)


def result_named(judgement: Judgement, kind: str, of: str) -> Said:
    """A result in words, such as velocity A."""
    return join((WORDS.get(kind, kind), reactions_named(judgement.drawing.scene).get(of, of)), " ")


def wrong_number(judgement: Judgement, verdict: NumberVerdict) -> Said:
    """Fault of a number: its difference, in the scene's units, and the probable mistake."""
    sizes = digits(verdict.off, SIGNIFICANT_DIGITS), digits(verdict.tolerance, SIGNIFICANT_DIGITS)
    result_name = result_named(judgement, verdict.number.kind, verdict.number.of)
    phrases = [result_name, arrange("{0} {1}", OFF_WORD(), sizes[0]), arrange("{0} {1}", ALLOWED_WORD(), sizes[1])]
    return said("Wrong result: {0}.", join(phrases if verdict.mistake is None else [*phrases, verdict.mistake]))


def repeated_number(judgement: Judgement, verdict: NumberVerdict) -> Said:
    """Remark that a result is written down more than once, and the one that counts."""
    number, later_numbers = verdict.number, join(map(number_words, verdict.again))
    return said("{0} is written down twice: {1} counts, not {2}.", result_named(judgement, number.kind, number.of),
                number_words(number), later_numbers)


def judgement_record(judgement: Judgement, score: Score) -> dict[str, Any]:
    """Everything that was judged, step by step and number by number; lengths are mm of paper."""
    first = judgement.first_wrong
    return {
        "title": judgement.drawing.scene.title,
        "drawing": judgement.name,
        "reading": str(judgement.reading),
        "pose": judgement.other_pose or None,
        "pencil": None if judgement.pencil is None else judgement.pencil.record,
        "first_wrong": None if first is None else _complaint_record(judgement, first),
        "steps": [_step_record(judgement, verdict) for verdict in judgement.verdicts],
        "numbers": [_number_record(verdict) for verdict in judgement.numbers],
        "not_asked": [{"kind": number.kind, "of": number.of} for number in judgement.unasked],
        "left_out": list(judgement.left_out),
        "not_needed": len(judgement.spare),
        "results": [{"kind": result.kind, "of": result.of, "verdict": result.state}
                    for result in asked_results(judgement)],
        "blank": judgement.is_blank,
        "score": score.record,
        "judged_score": score.judge_score,
        "note": score.note,
        "costs": dict(score.costs),
        "counts": judgement.counts,
    }


def review_rows(judgement: Judgement) -> list[dict[str, str]]:
    """The steps that count, and the results, for a teacher to look at, in the tongue of the sheet: what each is called,
    its number among the groups of the sheet, its mark, sentence, verdict, and what was probably done."""
    program, say = judgement.drawing.drawn, judgement.composition.plans.tongue
    rows = []
    for verdict in judgement.counting_verdicts:
        name = step_name(program, verdict.step)
        told = remark(judgement, verdict) if verdict.state == WRONG and not verdict.by_teacher else ""
        rows.append({"name": name.short, "step": str(name.number), "mark": str(say(name.mark)),
                     "sentence": str(say(program.sentence(verdict.step))), "verdict": verdict.state,
                     "remark": str(say(told))})
    wrong = {(number.number.kind, number.number.of): wrong_number(judgement, number)
             for number in wrong_numbers(judgement)}
    return rows + [{"name": result.name, "step": "", "mark": "", "sentence": str(say(result_named(
        judgement, result.kind, result.of))), "verdict": result.state,
        "remark": str(say(wrong.get((result.kind, result.of), "")))} for result in asked_results(judgement)]


def _step_record(judgement: Judgement, verdict: Verdict) -> dict[str, Any]:
    """One step, with how far off it is where it can be seen."""
    sizes = {f"{size}_mm": _finite_or_none(getattr(verdict, size)) if judgement.is_measured(verdict) else None
             for size in ("off", "tolerance", "astray")}
    return {**_mark_record(judgement, verdict.step), "verdict": verdict.state,
            "confidence": round(verdict.confidence, 3), **sizes, "mistake": _mistake_text(verdict),
            "by_teacher": verdict.by_teacher}


def _mark_record(judgement: Judgement, index: int) -> dict[str, Any]:
    """A step by its number and its mark."""
    name = step_name(judgement.drawing.drawn, index)
    return {"step": name.number, "mark": name.mark}


def _complaint_record(judgement: Judgement, verdict: Verdict) -> dict[str, Any]:
    """The first wrong step, and the one that shows it: a later one where it is not to be seen itself."""
    guilty = _mark_record(judgement, verdict.at_fault)
    return {
        **guilty, "sentence": str(judgement.drawing.drawn.sentence(verdict.at_fault)),
        "off_mm": _finite_or_none(verdict.off), "tolerance_mm": _finite_or_none(verdict.tolerance),
        "mistake": _mistake_text(verdict),
        "kind": verdict.kind or None, "confidence": round(verdict.confidence, 3), "guilty": guilty,
        "seen": _mark_record(judgement, verdict.step),
    }  # fmt: skip


def _number_record(verdict: NumberVerdict) -> dict[str, Any]:
    """One number of the table, beside the true one, in the scene's units."""
    number = verdict.number
    return {
        "kind": number.kind, "of": number.of, "value": list(number.value), "unit": number.unit,
        "verdict": verdict.state, "true": list(verdict.true), "off": _finite_or_none(verdict.off),
        "tolerance": _finite_or_none(verdict.tolerance), "mistake": _mistake_text(verdict),
        "again": [{"value": list(later.value), "unit": later.unit} for later in verdict.again],
    }  # fmt: skip


def _mistake_text(verdict: Verdict | NumberVerdict) -> str | None:
    return None if verdict.mistake is None else str(verdict.mistake)


def _finite_or_none(size: float) -> float | None:
    """A size for JSON: None for infinity, as from marks that cannot be drawn."""
    return size if math.isfinite(size) else None


@dataclass(frozen=True)
class LegendRow(TextRow):
    """A row of the legend, with a sample of a verdict's strokes before it; None stands for spare marks."""

    state: str | None = None


class Remarks(SheetWords):
    """All that is said beside a judged drawing."""

    def lines(self, wide: float, judgement: Judgement, score: Score) -> list[TextRow]:
        """Everything, for a column of this width, what matters most first."""
        return [self._heading(VERDICT_TITLE, gap=0.0), *self._verdict(wide, judgement), *self._legend(wide),
                *self._score(wide, score), *self._numbers(wide, judgement), *self._wrong(wide, judgement)]

    def _heading(self, text: str, size: float = HEADING, gap: float = 3.0, step: int | None = None) -> TextRow:
        """A heading, which may stand over a single row."""
        return replace(super()._heading(text, size, gap, step), keep=1)

    def _verdict(self, wide: float, judgement: Judgement) -> Iterator[TextRow]:
        yield from self.paragraph(judgement.name, wide)
        for line in reading_lines(judgement):
            yield from self.paragraph(line, wide)
        yield from self.paragraph(opinion(judgement), wide)
        for line in summary_lines(judgement):
            yield from self.paragraph(line, wide)

    def _legend(self, wide: float) -> Iterator[TextRow]:
        yield self._heading(said("Legend"))
        for state in (RIGHT, FOLLOWS, WRONG, UNCLEAR, None):
            state_text = NOT_NEEDED() if state is None else STATES[state]()
            yield LegendRow((Cell(LEGEND_WORDS_MM, sentence_runs(self.plans.tongue(state_text))),), gap=0.6,
                            state=state)
        yield from self.paragraph(said("Grey: the true drawing. Ellipses: where a point may be, after the student's "
                                       "own earlier marks. Dashed: where a wrong mark should be."), wide)

    def _score(self, wide: float, score: Score) -> Iterator[TextRow]:
        if score.total is None and not score.note:
            return
        yield self._heading(said("Score"))
        for line in score.teacher_lines:
            yield from self.paragraph(line, wide)
        if score.judge_score is None:
            return
        score_rows: list[tuple[str, float]] = [(GROUPS[group](), percent) for group, percent in score.groups.items()]
        score_rows += [(KINDS[kind](), -cost) for kind, cost in score.costs.items()]
        score_rows.append((said("in all, of 100"), score.judge_score))
        yield from table_rows([[self._runs(name), self._runs(digits(round(percent)))] for name, percent in score_rows])

    def _numbers(self, wide: float, judgement: Judgement) -> Iterator[TextRow]:
        """The numbers of the table beside the true ones, in the scene's units."""
        if not judgement.numbers:
            return
        yield self._heading(said("Results"))
        table = [[self._runs(text) for text in ("", said("handed in"), said("true"), OFF_WORD(), ALLOWED_WORD())]]
        for verdict in judgement.numbers:
            sizes = verdict.true, (verdict.off,), (verdict.tolerance,)
            cells = number_words(verdict.number), *map(number_text, sizes)
            result_name = result_named(judgement, verdict.number.kind, verdict.number.of)
            table.append([self._runs(result_name), *map(self._runs, cells)])
        yield from table_rows(table)
        for verdict in judgement.numbers:
            if verdict.state == WRONG:
                yield from self.paragraph(wrong_number(judgement, verdict), wide)

    def _wrong(self, wide: float, judgement: Judgement) -> Iterator[TextRow]:
        """The wrong steps one by one, and the numbers of those that are missing or not to be seen."""
        program = judgement.drawing.drawn
        wrong = [verdict for verdict in judgement.counting_verdicts if verdict.state == WRONG]
        if wrong:
            yield self._heading(said("Wrong steps"))
        for verdict in wrong:
            sentence = arrange("{0} {1:capital}.", program.sentence(verdict.at_fault), remark(judgement, verdict))
            yield from self.paragraph(sentence, wide, verdict.step, step_name(program, verdict.at_fault).short)
        for line in look_at_lines(judgement):
            yield from self.paragraph(line, wide)

    def _runs(self, text: str) -> Runs:
        return sentence_runs(self.plans.tongue(text), self.names)


def number_words(number: StudentNumber) -> Said:
    """A number as it was handed in, with its unit."""
    return join((number_text(number.value), *map(unit, filter(None, [number.unit]))), " ")


def number_text(numbers: Sequence[float]) -> Said:
    """A number, or the components of a vector, as they are told."""
    return digits(numbers[0]) if len(numbers) == 1 else coordinates(numbers)
