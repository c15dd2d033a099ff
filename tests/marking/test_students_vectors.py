"""Vectors that students compute, letter and lay off in their own way: their marks are judged as they stand."""

from __future__ import annotations

from pathlib import Path

import pytest
from blackboard import Fault, finish, mistaken, right, task_of
from formats import FORMATS, cause_named, dxf_points
from mixed_forms import mistaken_by_mixed_forms
from test_blackboard import judged, words

import graphplan as gp
from graphplan.kernel.kinds import LINE
from graphplan.marking.judge.arrows import _stroke_ends
from graphplan.marking.judge.laid_off import vector_letters
from graphplan.marking.judge.similar_figures import SimilarFigures
from graphplan.marking.submission import read_submission
from graphplan.marking.traces import Submission, Trace


def test_a_wrong_normal_acceleration_is_told_without_its_figure(tmp_path: Path) -> None:
    """Who draws velocities larger than the task does, and computes v²/r, has not the slips of the task's semicircle."""
    drawing = mistaken("inverted slider-crank", 103)
    marked = judged(drawing, "csv", tmp_path)
    assert drawing.answers.search(words(marked))
    assert marked.judgement.first_wrong
    assert cause_named(drawing, marked.judgement.first_wrong.mistake)
    assert (marked.score.total or 0) < 95.0


@pytest.mark.parametrize(("name", "seed", "fault", "told"), [
    ("inverted slider-crank", 300, Fault("slip", "k_A", 3 + 4j), "k_A3A|k_A3A|None"),
    ("force polygon", 301, Fault("reversed", "P", -1), "II|II|the vector reversed")])
def test_vectors_laid_off_at_a_scale_of_ones_own_are_judged(name: str, seed: int, fault: Fault, told: str,
                                                            tmp_path: Path) -> None:
    """A Coriolis acceleration without a figure is computed, and off by no more than what is measured for it; a plan
    whose vector is reversed need not be the task's size."""
    marked = judged(finish(task_of(name, seed), seed, fault), "svg", tmp_path)
    assert words(marked) == told
    assert all(0 < verdict.tolerance < 1.5 for verdict in marked.judgement.verdicts if verdict.state == "wrong")


ARROW_FORMS = [form for form in FORMATS if form != "csv"]


@pytest.mark.parametrize("form", ARROW_FORMS)
@pytest.mark.parametrize(("fault", "told"), [(Fault("reversed", "P", -1), "P_2 reversed"),
                                             (Fault("quarter turn", "T", 1j), "T_1 turned the wrong way")])
def test_an_arrow_tells_that_a_vector_without_letters_goes_the_wrong_way(form: str, fault: Fault, told: str,
                                                                         tmp_path: Path) -> None:
    """Forces on Zhukovsky's lever, at a scale of the student's own, have no letters at their tips."""
    marked = judged(finish(task_of("lever", 500), 500, fault), form, tmp_path)
    assert words(marked).endswith(f"|{told}")
    assert [verdict.state for verdict in marked.judgement.verdicts].count("wrong") == 1


@pytest.mark.parametrize("form", ARROW_FORMS[:1])
def test_an_arrow_that_pushes_at_its_mark_is_not_reversed(form: str, tmp_path: Path) -> None:
    """A force may end in the mark at which it acts: nothing is said of the stroke on the other side of that."""
    drawing = right("lever", 500)
    (start, end), other = drawing.board.arrows
    pushing = 2 * start - end, start
    drawing.board.arrows[:] = [pushing, other]
    drawing.board.strokes[drawing.board.strokes.index((start, end))] = pushing
    assert not words(judged(drawing, form, tmp_path))


def test_ends_of_vectors_are_called_by_links_as_textbooks_do(tmp_path: Path) -> None:
    """n_3 of a link with two such ends is that which the other leads to; k_A is the end of a Coriolis acceleration."""
    drawing = judged(right("inverted slider-crank", 22), "csv", tmp_path).judgement.drawing
    named = {name: drawing.drawn.steps[index].name for name, index in vector_letters(drawing).items()}
    assert (named["n_3"], named["n_CA3"], named["k_A"]) == ("n_A3C", "n_A3C", "k_A3A")


def test_the_direction_of_a_wrong_locus_is_named(tmp_path: Path) -> None:
    """Of a mark that lies on one of two lines alone it is told along which side of a link the other was drawn."""
    marked = judged(mistaken("poles", 101), "csv", tmp_path)
    assert words(marked).endswith("parallel to AM instead of OA")


def test_a_wrong_locus_that_should_follow_a_guide_is_named(tmp_path: Path) -> None:
    """Of a locus along a guide, too, it is told along or across which link it was drawn instead."""
    wrong = finish(task_of("slider-crank, polar", 100), 100, Fault("wrong side", "b' by O", 0))
    assert "|perpendicular to OA instead of " in words(judged(wrong, "csv", tmp_path))


@pytest.mark.parametrize(("name", "told"), [
    ("four-bar, polar", "the normal acceleration of B about C with the radius OC instead of BC"),
    ("quick return", "laid off from n_A3C instead of a'")])
def test_mistakes_at_ends_without_letters_are_named(name: str, told: str, tmp_path: Path) -> None:
    """The frame, too, is a length that v² may be divided by, and where two loci of one vector cross no figure is there
    to be mirrored."""
    assert words(judged(mistaken_by_mixed_forms(name, 902), "csv", tmp_path)).endswith(told)


@pytest.mark.parametrize(("form", "fault", "told"), [
    ("csv", None, ""), ("svg", Fault("wrong start", "n_BA"), "n_BA|n_BA|laid off from pi instead of a'"),
    ("csv", Fault("letters", "v_b+v_s"), "v_b|v_b|the letters of v_b and v_s are exchanged")])
def test_velocities_from_their_points_go_with_accelerations_from_a_pole(form: str, fault: Fault | None, told: str,
                                                                       tmp_path: Path) -> None:
    """Velocities and accelerations on plans of different kinds: right ones are right, and mistakes are told by the
    letters of the student's own marks."""
    marked = judged(finish(task_of("slider-crank, both", 5), 5, fault), form, tmp_path)
    assert words(marked) == told
    assert str(marked.judgement.reading).startswith("orthogonal velocities at their points, a polar plan")


def test_a_round_scale_of_the_mechanism_is_of_mm(tmp_path: Path) -> None:
    """A file without a unit whose mechanism is drawn at 1:2.5 is in mm, not in a unit of its own."""
    marked = judged(right("inverted slider-crank", 505), "dxf lines", tmp_path)
    assert "unit of its own" not in str(marked.judgement.reading)
    assert not words(marked)


@pytest.mark.parametrize(("form", "crowded"), [("csv", False), ("dxf points", True)])
def test_exchanged_letters_that_set_a_scale_are_told(form: str, crowded: bool, tmp_path: Path) -> None:
    """Where letters tell the scale of their plan, and where their marks lie close together: there it tells whose they
    are that all stand alike from their marks."""
    name, seed, pair = ("inverted slider-crank", 403, "a3+k") if crowded else ("force polygon", 103, "II+III")
    marked = judged(finish(task_of(name, seed), seed, Fault("letters", pair)), form, tmp_path)
    assert "are exchanged" in words(marked)
    assert (marked.score.total or 0) < 95.0


def test_letters_of_old_dxf_files_are_read(tmp_path: Path) -> None:
    """Older files have Greek letters as codes."""
    (path := tmp_path / "student.dxf").write_bytes(dxf_points(right("slider-crank, polar", 0)))
    assert b"\\U+03" in path.read_bytes()
    assert "pi" in {name for word in read_submission(path, [], {}, None, "").letters for name in word.names}


def test_a_given_point_makes_no_similar_figure() -> None:
    """Pivots of the frame are the ends of their velocities on the mechanism plan; before all of them are marked the
    last has no place by the others."""
    drawing = gp.construct(gp.load("kinytskyi"))
    steps, last = drawing.drawn.steps, drawing.drawn.givens - 1
    assert steps[last].name in drawing.scene.links["frame"]
    figures = SimilarFigures(drawing, [step.panel for step in steps])
    assert list(figures.values(last, drawing.values[:last], {*range(last)})) == []


def test_a_stroke_that_does_not_leave_its_mark_is_no_vector() -> None:
    """It goes nowhere, and so as little the right way as a wrong one."""
    strokes = [Trace(LINE, ((end, 0.0), (0.0, 0.0))) for end in (0.3, 9.0)]
    assert list(_stroke_ends(Submission("a.svg", tuple(strokes)), 0j)) == [9 + 0j]
