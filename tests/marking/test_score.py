"""The score of a drawing: what its steps and numbers earn, by weights that are read with their faults told."""

from __future__ import annotations

from dataclasses import replace

import pytest
from judged import judgement

from graphplan.errors import Refused
from graphplan.marking.classroom.results import mistake_words
from graphplan.marking.judge.findings import opinion
from graphplan.marking.judge.score import POSE, RESULTS, Weights, groups_of_steps, parse_weights, score
from graphplan.marking.judge.verdict import (
    FOLLOWS,
    IMPLIED,
    MISSING,
    RIGHT,
    UNCLEAR,
    UNSEEN,
    WRONG,
    Judgement,
    NumberVerdict,
)
from graphplan.marking.judge.verdict import asked_results as asked_results
from graphplan.marking.traces import StudentNumber


def numbered(found: Judgement, *states: str) -> Judgement:
    """The drawing with numbers of these verdicts."""
    number = StudentNumber("velocity", "A", (1.0, 2.0))
    return replace(found, numbers=tuple(NumberVerdict(number, state, 0.0, 1.0, (1.0, 2.0)) for state in states))


def crossing(name: str) -> int:
    """The first crossing that a scene's construction marks."""
    drawn = judgement(name).drawing.drawn
    return next(step.index for step in drawn.steps if step.op.name == "meet")


def test_a_faultless_drawing_earns_everything() -> None:
    """Where every step that can be seen is right, each kind of step has 100, and so has the whole."""
    found = score(judgement("four-bar"))
    assert found.groups == {"velocity": 100.0, "acceleration": 100.0, "results": 100.0}
    assert found.total == 100.0


def test_a_slip_is_punished_once() -> None:
    """One wrong step costs what its kind of mistake does, or its step's share if that is more, whatever rests on it;
    follows=0 takes those shares too."""
    slipped = judgement("four-bar", {crossing("four-bar"): 3j})
    seen = [verdict.state for verdict in slipped.counting_verdicts if verdict.state != UNSEEN]
    assert FOLLOWS in seen
    results = [one.state for one in asked_results(slipped)]
    whole = len(seen) + 3 * len(results)
    assert score(slipped, parse_weights("numbers=3")).total == pytest.approx(88.0)
    assert score(slipped, parse_weights("numbers=3,other=0")).total == pytest.approx(100 * (1 - 1 / whole))
    right = seen.count(RIGHT) + 3 * results.count(RIGHT)
    assert score(slipped, parse_weights("numbers=3,follows=0,other=0")).total == pytest.approx(100 * right / whole)


def test_the_first_mistake_of_each_kind_costs_what_the_teacher_says() -> None:
    """Two mistakes of one kind cost its points once, and of the second a step's share; another kind costs its own."""
    one, two = [step.index for step in judgement("four-bar").drawing.drawn.steps if step.op.name == "meet"][:2]
    told = parse_weights("reversed=30,wrong line=25")
    twice = score(judgement("four-bar", {one: 3j, two: 3j}, kind="reversed"), told)
    once = score(judgement("four-bar", {one: 3j}, kind="reversed"), told)
    share = 100 / sum(most for _, most in once.shares.values())
    assert once.total == pytest.approx(70.0)
    assert twice.total == pytest.approx(70.0 - share)
    assert twice.costs == {"reversed": pytest.approx(30.0 - share)}
    both = judgement("four-bar", {one: 3j, two: 3j}, kind="reversed")
    mixed = replace(both, verdicts=tuple(replace(v, kind="wrong line") if v.step == two else v for v in both.verdicts))
    assert score(mixed, told).total == pytest.approx(45.0)
    assert f"{mistake_words('reversed')} −28" in str(score(mixed, told).text)


def test_one_number_is_worth_one_number() -> None:
    """Of a table alone every result that is asked for counts alike, and what is not in it is missing."""
    found = judgement("four-bar")
    empty = replace(found, verdicts=tuple(replace(v, state=UNSEEN, trace=None) for v in found.verdicts))
    wanted = [(one.kind, one.of) for one in asked_results(empty)]
    assert len(wanted) > 5
    for count in (0, 1, len(wanted)):
        numbers = tuple(NumberVerdict(StudentNumber(kind, of, (1.0,)), RIGHT, 0.0, 1.0, (1.0,))
                        for kind, of in wanted[:count])
        told = replace(empty, numbers=numbers)
        assert told.is_blank == (count == 0)
        assert score(told).total == pytest.approx(100 * count / len(wanted))


def test_a_blank_sheet_scores_nothing() -> None:
    """Given points that are printed on a handout earn nothing by themselves, and the sheet is said to be blank."""
    found = judgement("four-bar")
    free = [step.op.free for step in found.drawing.drawn.steps]
    blank = replace(found, verdicts=tuple(
        v if free[v.step] else replace(v, state=MISSING, trace=None) for v in found.verdicts))
    assert blank.is_blank
    assert score(blank).total == 0.0
    assert "blank" in opinion(blank)


def test_what_is_given_counts_only_where_it_is_wrong() -> None:
    """A right point of the pose earns nothing; a wrong one has lost a share."""
    assert POSE not in score(judgement("four-bar")).shares
    wrong = score(judgement("four-bar", {0: 2.0}))
    assert wrong.groups[POSE] == 0.0
    assert wrong.total is not None
    assert wrong.total < 100


def test_numbers_count_as_steps() -> None:
    """A result counts for as many steps as its weight says, and one of a wrong number earns nothing."""
    right, wrong = (score(numbered(judgement("four-bar"), state), parse_weights("numbers=3")).shares[RESULTS]
                    for state in (RIGHT, WRONG))
    assert right[0] == right[1] == wrong[1]
    assert wrong[0] == right[0] - 3.0


def test_a_missing_step_counts_and_an_unseen_one_does_not() -> None:
    """A drawing of which nothing can be seen has no score; one of which all is missing has none of 100."""
    found = judgement("four-bar")
    unseen, missing = (replace(found, verdicts=tuple(replace(v, state=state) for v in found.verdicts))
                       for state in (UNSEEN, MISSING))
    assert score(unseen).total is None
    assert score(missing).total == 0.0


def test_penalties_never_make_a_score_negative() -> None:
    """Wrong steps may cost more than they would earn, but no drawing has less than nothing."""
    all_wrong = judgement("four-bar")
    wrong = replace(all_wrong, verdicts=tuple(replace(v, state=WRONG) for v in all_wrong.verdicts))
    assert score(wrong, parse_weights("wrong=-1")).total == 0.0


def test_steps_are_told_apart_by_what_they_serve() -> None:
    """In a loaded scene steps serve velocities first, then accelerations, then forces; the pose serves all."""
    found = judgement("jaanimets-10")
    groups, drawn = groups_of_steps(found.drawing), found.drawing.drawn
    assert set(groups) == {POSE, "velocity", "acceleration", "force"}
    assert all(groups[step.index] == "force" for step in drawn.steps if step.panel.startswith(("force plan", "lever")))
    assert "force" not in groups_of_steps(judgement("open-chain").drawing)
    assert all(groups[arg] != "force" for step in drawn.steps if groups[step.index] == "velocity" for arg in step.args)


def test_weights_are_read() -> None:
    """What a text leaves out stays as it is by default."""
    assert parse_weights("") == Weights()
    assert parse_weights("follows=0.5, numbers = 3") == Weights(follows=0.5, numbers=3.0)


@pytest.mark.parametrize(("text", "why"), [
    ("wright=1", "nothing of this name is weighed"),
    ("wrong=0,wrong=1", "wrong is given twice"),
    ("right=0", "not a weight; a number from 0.001 to 1000"),
    ("numbers=-1", "not a weight; a number from 0 to 1000"),
    ("right=1e308,numbers=1e308", "not a weight"),
    ("wrong=-inf", "not a weight; a number from -1000"),
    ("missing=nan", "not a weight"),
    ("wrong=much", "not a weight"),
    ("wrong=2", "a weight is greater than that of right"),
    ("reversed=-1", "not a weight; a number from 0 to 100"),
    ("reversed=101", "not a weight; a number from 0 to 100"),
    ("revered=10", "one of right, .*reversed"),
])
def test_bad_weights_are_refused(text: str, why: str) -> None:
    """One line says what is wrong with the weights."""
    with pytest.raises(Refused, match=why):
        parse_weights(text)


def test_what_is_implied_earns_and_what_cannot_be_told_does_not() -> None:
    """A step that a right mark bears out earns as if it were drawn; one that cannot be told earns nothing."""
    found = judgement("four-bar")
    implied, unsure = (replace(found, verdicts=tuple(replace(v, state=state) for v in found.verdicts))
                       for state in (IMPLIED, UNCLEAR))
    assert score(implied, parse_weights("missing=0.5")).total == 100.0
    assert score(unsure, parse_weights("missing=0.5")).total == 0.0
