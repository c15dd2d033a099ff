"""Hand drawings judged: faultless ones are right, a slip is held against one step, and named."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from hands import Drawn, draw, frames, points, slipped, traced, wrong_by

import graphplan as gp
from graphplan.accuracy.hand import Pencil
from graphplan.errors import Refused
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.judge.findings import repeated_number, summary_lines
from graphplan.marking.judge.judge import judge, judge_any_method
from graphplan.marking.judge.mistakes import MISTAKES
from graphplan.marking.judge.verdict import FOLLOWS, IMPLIED, MISSING, RIGHT, UNSEEN, WRONG
from graphplan.marking.submission import read_submission
from graphplan.marking.traces import StudentNumber, Submission, Trace
from graphplan.methods.construction import Construction
from graphplan.output.svg import svg
from graphplan.sheet.layout.composition import Composition, compose
from graphplan.sheet.layout.layout import layout
from graphplan.words.tongue import tongue

PENCIL = Pencil()
SCENES = ("four-bar", "slider-crank", "slotted-link", "alt-eight-link", "open-chain", "jaanimets-11")
ALL = frozenset({POINT, LINE, CIRCLE})


@cache
def composed(name: str, method: str = "", plan: str = "") -> tuple[Construction, Composition]:
    drawing = gp.construct(gp.load(name), method=method, plan=plan)
    return drawing, compose(drawing)


def whole(drawn: Drawn, labels: bool = True) -> Submission:
    """Everything on the sheet, as a CAD file has it; without labels those of the given points are left."""
    traces = traced(drawn)
    if not labels:
        given = drawn.drawing.scene.points
        traces = [replace(trace, label=trace.label if trace.label in given else "", panel="") for trace in traces]
    return Submission("drawing.svg", tuple(traces), shows=ALL)


@pytest.mark.parametrize("name", SCENES)
def test_a_faultless_drawing_has_no_wrong_step(name: str) -> None:
    """Measured points, whatever the origin, direction and scale of each plan, and a file with every line."""
    drawing, sheet = composed(name)
    for seed in (1, 2):
        drawn = draw(drawing, frames(drawing, sheet, seed), PENCIL, seed)
        assert judge(drawing, sheet, points(drawn), PENCIL).first_wrong is None
        assert judge(drawing, sheet, whole(drawn), PENCIL).first_wrong is None


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "five-bar"])
def test_an_unlabelled_drawing_is_matched_to_its_steps(name: str) -> None:
    """Without a letter but those of the given points, every line, arc and point finds its step."""
    drawing, sheet = composed(name)
    drawn = draw(drawing, frames(drawing, sheet), PENCIL, 3)
    found = judge(drawing, sheet, whole(drawn, labels=False), PENCIL)
    assert found.first_wrong is None
    assert not found.spare
    assert all(verdict.state in (RIGHT, IMPLIED) for verdict in found.counting_verdicts)


@pytest.mark.parametrize("kind", [kind for kind in MISTAKES if kind != "wrong angle"])  # tasks of synthesis have it
def test_every_mistake_is_held_against_its_own_step(kind: str) -> None:
    """A mistake of each kind, in a file with every line: that step is wrong, nothing after it, and it is told so."""
    rng = np.random.default_rng(list(MISTAKES).index(kind))
    for name in ("alt-eight-link", "jaanimets-11", "four-bar", "slotted-link"):
        drawing, sheet = composed(name)
        ways = frames(drawing, sheet)
        made = [slip for step in drawing.drawn.steps if MISTAKES[kind].at(step.op)
                for slip in slipped(drawing, step.index) if slip.kind == kind]
        for place in rng.permutation(len(made))[:9]:
            step, slip = drawing.drawn.steps[made[place].step.index], made[place]
            drawn = draw(drawing, ways, PENCIL, 5, {step.index: slip})
            if None in drawn.values or wrong_by(drawn, step) < 5.0:  # by chance it is as it should be
                continue
            found = judge(drawing, sheet, whole(drawn), PENCIL)
            assert found.first_wrong_step == step.index
            assert found.first_wrong
            assert found.first_wrong.kind == kind
            assert [verdict.state for verdict in found.verdicts].count(WRONG) == 1
            return
    pytest.fail("no scene shows this mistake")


def test_later_steps_follow_from_a_slip() -> None:
    """What rests on a wrong mark is right after an earlier mistake, what does not is right."""
    drawing, sheet = composed("four-bar")
    where = {step.name: step.index for step in drawing.drawn.steps}
    mistake = next(one for one in slipped(drawing, where["v_b"]) if one.text.endswith("AB instead of line 3"))
    drawn = draw(drawing, frames(drawing, sheet), PENCIL, 1, {where["v_b"]: mistake})
    states = {verdict.step: verdict.state for verdict in judge(drawing, sheet, whole(drawn), PENCIL).verdicts}
    assert states[where["v_b"]] == WRONG
    assert states[where["v_m"]] == FOLLOWS
    assert states[where["a"]] == RIGHT


def test_a_mark_drawn_from_the_truth_after_a_slip_is_right() -> None:
    """One mark is measured wrongly; the others, drawn from where it should be, are right."""
    drawing, sheet = composed("four-bar")
    drawn = draw(drawing, frames(drawing, sheet), PENCIL, 1)
    traces = [replace(trace, spots=((trace.spots[0][0] + 8.0, trace.spots[0][1]),)) if trace.label == "v_b" else trace
              for trace in traced(drawn) if trace.kind == POINT]
    found = judge(drawing, sheet, Submission("x.csv", tuple(traces), shows=frozenset({POINT})), PENCIL)
    assert [drawing.drawn.steps[v.step].name for v in found.verdicts if v.state == WRONG] == ["v_b"]
    assert found.first_wrong
    assert found.first_wrong.off == pytest.approx(8.0, abs=1.0)
    assert found.first_wrong.off > 3 * found.first_wrong.tolerance


def test_the_tolerance_of_every_mark_is_told() -> None:
    """Every judged point has a tolerance in mm, about as large as its ellipse."""
    drawing, sheet = composed("slider-crank")
    drawn = draw(drawing, frames(drawing, sheet), PENCIL, 1)
    for verdict in judge(drawing, sheet, points(drawn), PENCIL).verdicts:
        if verdict.ellipse:
            assert 0 < verdict.ellipse.minor <= verdict.tolerance * 1.001 <= verdict.ellipse.major * 1.002


def test_a_coarser_pencil_is_judged_more_mildly() -> None:
    """A mark a millimetre off is wrong with a sharp pencil, and right with a blunt one, if it alone tells which."""
    drawing, sheet = composed("four-bar")
    drawn = draw(drawing, frames(drawing, sheet), Pencil(), 1)
    shifted = [replace(trace, spots=((trace.spots[0][0] + 1.5, trace.spots[0][1]),)) if trace.label == "M_1" else trace
               for trace in traced(drawn) if trace.kind == POINT]
    submission = Submission("x.csv", tuple(shifted), shows=frozenset({POINT}))
    assert judge(drawing, sheet, submission, PENCIL).first_wrong
    assert not judge(drawing, sheet, submission, Pencil(0.5, 0.5, 0.25, 0.5)).first_wrong


@pytest.mark.parametrize("size", [0.2, 0.5, 2.0])
def test_no_pencil_hides_what_is_a_tenth_of_a_plan_off(size: float) -> None:
    """However coarse it is said to be."""
    drawing, sheet = composed("four-bar")
    coarse = Pencil(size, size, size / 2, size)
    drawn = draw(drawing, frames(drawing, sheet), PENCIL, 1)
    for mark in ("b", "v_b", "B_1"):
        moved = [replace(trace, spots=((trace.spots[0][0] + 30.0 * (trace.label == mark), trace.spots[0][1]),))
                 for trace in traced(drawn) if trace.kind == POINT]
        found = judge(drawing, sheet, Submission("x.csv", tuple(moved), shows=frozenset({POINT})), coarse)
        assert found.first_wrong
        assert drawing.drawn.steps[found.first_wrong.step].name == mark
        assert found.first_wrong.tolerance <= 15.0


def test_missing_marks_are_told_unless_others_rest_on_them() -> None:
    """A result that is not there is missing, whatever rests on it; lines on which right marks lie are borne out."""
    drawing, sheet = composed("four-bar")
    drawn = draw(drawing, frames(drawing, sheet), PENCIL, 1)
    traces = [trace for trace in traced(drawn) if trace.kind == POINT and trace.label not in ("v_b", "M_1")]
    found = judge(drawing, sheet, Submission("x.csv", tuple(traces), shows=frozenset({POINT})), PENCIL)
    states = {drawing.drawn.steps[verdict.step].name: verdict.state for verdict in found.verdicts}
    assert found.first_wrong is None
    assert (states["v_b"], states["M_1"]) == (MISSING, MISSING)
    lines = {verdict.state for verdict in found.verdicts if drawing.drawn.steps[verdict.step].op.gives == LINE}
    assert lines == {IMPLIED, UNSEEN, MISSING}  # before a right mark, before a missing one, after all that is there


def test_traces_that_no_step_asks_for_are_spare() -> None:
    """A line of the student's own is not needed, and harms nothing."""
    drawing, sheet = composed("four-bar")
    own = Trace(LINE, ((0.0, 0.0), (10.0, 3.0)))
    submission = whole(draw(drawing, frames(drawing, sheet), PENCIL, 1), labels=False)
    found = judge(drawing, sheet, replace(submission, traces=(*submission.traces, own)), PENCIL)
    assert found.spare == (own,)
    assert found.first_wrong is None


@pytest.mark.costly
def test_another_form_of_construction_is_accepted() -> None:
    """A student who draws trial figures instead of auxiliary points has every step right, of that construction."""
    task, sheet = composed("alt-eight-link")
    other, other_sheet = composed("alt-eight-link", "trial")
    assert [step.key for step in task.drawn.steps] != [step.key for step in other.drawn.steps]
    found = judge_any_method(task, sheet, whole(draw(other, frames(other, other_sheet), PENCIL, 1)), PENCIL)
    assert found.first_wrong is None
    assert [step.key for step in found.drawing.drawn.steps] == [step.key for step in other.drawn.steps]


def test_polar_plans_are_accepted_for_orthogonal_ones() -> None:
    """What counts is the result: velocities drawn on a plan of their own are judged there."""
    task, sheet = composed("four-bar")
    other, other_sheet = composed("four-bar", "", "polar")
    found = judge_any_method(task, sheet, points(draw(other, frames(other, other_sheet), PENCIL, 1)), PENCIL)
    assert found.first_wrong is None
    assert "velocity plan" in found.frames


def test_a_sheet_without_the_mechanism_is_refused() -> None:
    """Marks that lie nowhere on the mechanism cannot be judged."""
    drawing, sheet = composed("four-bar")
    submission = Submission("x.csv", (Trace(POINT, ((1.0, 2.0),), "Z"),), shows=frozenset({POINT}))
    with pytest.raises(Refused, match="fewer than two of its points"):
        judge(drawing, sheet, submission, PENCIL)


def test_numbers_of_links_are_not_those_of_steps() -> None:
    """A drawing whose links are numbered 1, 2, 3 is not judged as if its lines were steps 1, 2, 3."""
    drawing, sheet = composed("four-bar")
    submission = whole(draw(drawing, frames(drawing, sheet), PENCIL, 1), labels=False)
    bars = [Trace(LINE, trace.spots, number) for number, trace in zip(("1", "2", "3"), (
        trace for trace in submission.traces[::-1] if trace.kind == LINE), strict=False)]
    assert judge(drawing, sheet, replace(submission, traces=(*submission.traces, *bars)), PENCIL).first_wrong is None


@pytest.mark.parametrize("name", ["four-bar", "triad"])
def test_our_own_sheet_is_a_faultless_drawing(name: str, tmp_path: Path) -> None:
    """The sheet that graphplan draws, with all its letters and numbers, has no wrong step."""
    drawing, sheet = composed(name)
    path = tmp_path / "sheet.svg"
    path.write_text(svg(layout(sheet)))
    size = sheet.arrangement.width, sheet.arrangement.height
    submission = read_submission(path, list(sheet.views), frames(drawing, sheet), size=size)
    assert judge(drawing, sheet, submission, PENCIL).first_wrong is None


def test_noise_is_no_drawing() -> None:
    """In spots that lie anywhere no mechanism is seen, however many there are."""
    drawing, sheet = composed("four-bar")
    spots = np.random.default_rng(1).uniform(0, 300, (60, 2)).tolist()
    submission = Submission("x.csv", tuple(Trace(POINT, ((x, y),)) for x, y in spots), shows=frozenset({POINT}))
    with pytest.raises(Refused, match="fewer than two of its points"):
        judge(drawing, sheet, submission, PENCIL)


def test_a_hand_without_errors_has_no_tolerance() -> None:
    """A pencil that never errs cannot be judged by."""
    drawing, sheet = composed("four-bar")
    with pytest.raises(Refused, match="a size is 0"):
        judge(drawing, sheet, points(draw(drawing, frames(drawing, sheet), PENCIL, 1)), Pencil(point=0.0))


@pytest.mark.parametrize(("mark", "locus", "told"), [
    ("v_b", "line 3", "v_BC is not perpendicular to BC"), ("v_b", "BC", "v_BA is not perpendicular to AB"),
    ("B_1", "beta", "a^t_BA is not perpendicular to AB")])
def test_a_mark_on_one_of_its_loci_alone_tells_which_vector_is_wrong(mark: str, locus: str, told: str) -> None:
    """In mechanics' words, wherever it lies on that."""
    drawing, sheet = composed("four-bar")
    ways = frames(drawing, sheet)
    steps = {drawing.drawn.text(step.index): step for step in drawing.drawn.steps}
    a, b, _ = drawing.values[steps[locus].index]
    drawn = draw(drawing, ways, PENCIL, 1)
    x, y = drawn.values[steps[mark].index]
    far = 13.0 / sheet.views[steps[mark].panel].scale / float(a * a + b * b) ** 0.5
    drawn.values[steps[mark].index] = x + far * float(b), y - far * float(a)
    found = judge(drawing, sheet, points(drawn), PENCIL).first_wrong
    assert found
    assert (found.step, str(found.mistake)) == (steps[mark].index, told)


# ---- numbers ---------------------------------------------------------------------------------------------------------


def _velocity(name: str, factor: complex = 1.0) -> StudentNumber:
    value = composed("four-bar")[0].velocity[name] * factor
    return StudentNumber("velocity", name, (value.real, value.imag), "mm/s")


@pytest.mark.parametrize(("factor", "told"), [
    (1.0, ""), (-1.0, "the sign is reversed"), (1j, "the vector is a quarter turn off"),
    (10.0, "the number is 10 times as large as it should be")])
def test_numbers_are_judged_with_what_was_probably_done(factor: complex, told: str) -> None:
    """A result that a drawing cannot give is wrong, with the sign, turn or factor that makes it so."""
    drawing, sheet = composed("four-bar")
    found = judge(drawing, sheet, Submission("x.csv", numbers=(_velocity("B", factor),)), PENCIL)
    assert found.numbers[0].state == (RIGHT if factor == 1.0 else WRONG)
    assert str(found.numbers[0].mistake or "") == told


def test_a_number_of_another_point_is_recognised() -> None:
    """The velocity of B written down for M is told to be that of B."""
    drawing, sheet = composed("four-bar")
    found = judge(drawing, sheet, Submission("x.csv", numbers=(replace(_velocity("B"), of="M"),)), PENCIL)
    assert str(found.numbers[0].mistake) == "this is the number of B"


def test_a_result_that_is_not_asked_for_is_told_and_counts_for_nothing() -> None:
    """The others are judged as they are without it; alone it is no blank sheet."""
    drawing, sheet = composed("four-bar")
    number, right = StudentNumber("velocity", "Z", (1.0, 2.0), "mm/s"), _velocity("B")
    alone, beside, without = (judge(drawing, sheet, Submission("x.csv", numbers=numbers), PENCIL)
                              for numbers in ((number,), (right, number), (right,)))
    assert [one.unasked for one in (alone, beside, without)] == [(number,), (number,), ()]
    assert beside.numbers == without.numbers
    assert not alone.numbers
    assert not alone.is_blank
    assert "Not asked for, and not counted: velocity Z." in map(str, summary_lines(beside))


def test_a_result_that_is_written_twice_is_judged_once() -> None:
    """The first counts; the others, however they are spelled, are told beside it."""
    drawing, sheet = composed("four-bar")
    numbers = _velocity("B"), _velocity("A"), replace(_velocity("B", -1.0), of="b")
    found = judge(drawing, sheet, Submission("x.csv", numbers=numbers), PENCIL)
    again = [(one.number.of, one.state, one.again) for one in found.numbers]
    assert again == [("B", RIGHT, numbers[2:]), ("A", RIGHT, ())]
    assert "written down twice" in str(repeated_number(found, found.numbers[0]))


def test_a_result_is_told_in_the_language() -> None:
    """The words of a number of a table, of what slides on what, and of its unit, are the sheet's."""
    number = StudentNumber("slide velocity", "3 along frame", (1.0, 2.0), "mm/s")
    found = judge(*composed("slider-crank"), Submission("x.csv", numbers=(number, number)), PENCIL)
    told = tongue("ru")(repeated_number(found, found.numbers[0]))
    assert "скорость скольжения 3 по стойке" in told
    assert "(1; 2) мм/с" in told


def test_a_number_read_off_a_wrong_drawing_follows() -> None:
    """The student measures his own v_b, which is wrong: the number is right after an earlier mistake."""
    drawing, sheet = composed("four-bar")
    drawn = draw(drawing, frames(drawing, sheet), PENCIL, 1)
    traces = [replace(trace, spots=((trace.spots[0][0] + 8.0, trace.spots[0][1]),)) if trace.label == "v_b" else trace
              for trace in traced(drawn) if trace.kind == POINT]
    value = drawing.velocity["B"] - 8.0j / sheet.views["mechanism"].scale / drawing.kappa
    submission = Submission("x.csv", tuple(traces), (StudentNumber("velocity", "B", (value.real, value.imag), "mm/s"),),
                            frozenset({POINT}))
    found = judge(drawing, sheet, submission, PENCIL)
    assert found.numbers[0].state == FOLLOWS
