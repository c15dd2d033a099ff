"""The score of a drawing: what its steps and numbers earn, by weights that are read with their faults told."""

from __future__ import annotations

from dataclasses import replace

import pytest
from judged import judgement

from graphplan.errors import Refused
from graphplan.marking.judge.score import POSE, RESULTS, Weights, score, served, weights
from graphplan.marking.judge.verdict import (
    FOLLOWS,
    IMPLIED,
    MISSING,
    RIGHT,
    UNSEEN,
    UNSURE,
    WRONG,
    Judgement,
    NumberVerdict,
)
from graphplan.marking.traces import Number


def numbered(found: Judgement, *states: str) -> Judgement:
    """The drawing with numbers of these verdicts."""
    number = Number("velocity", "A", (1.0, 2.0))
    return replace(found, numbers=tuple(NumberVerdict(number, state, 0.0, 1.0, (1.0, 2.0)) for state in states))


def crossing(name: str) -> int:
    """The first crossing that a scene's construction marks."""
    drawn = judgement(name).drawing.drawn
    return next(step.index for step in drawn.steps if step.op.name == "meet")


def test_a_faultless_drawing_earns_everything() -> None:
    """Where every step that can be seen is right, each kind of step has 100, and so has the whole."""
    found = score(judgement("four-bar"))
    assert found.groups == {"velocity": 100.0, "acceleration": 100.0}
    assert found.total == 100.0


def test_a_slip_is_punished_once() -> None:
    """One wrong step costs one step's share, whatever rests on it; follows=0 takes those shares too."""
    slipped = judgement("four-bar", {crossing("four-bar"): 3j})
    seen = [verdict.state for verdict in slipped.judged if verdict.state != UNSEEN]
    assert FOLLOWS in seen
    assert score(slipped).total == pytest.approx(100 * (1 - 1 / len(seen)))
    assert score(slipped, weights("follows=0")).total == pytest.approx(100 * seen.count(RIGHT) / len(seen))


def test_what_is_given_counts_only_where_it_is_wrong() -> None:
    """A right point of the pose earns nothing; a wrong one has lost a share."""
    assert POSE not in score(judgement("four-bar")).shares
    wrong = score(judgement("four-bar", {0: 2.0}))
    assert wrong.groups[POSE] == 0.0
    assert wrong.total is not None
    assert wrong.total < 100


def test_numbers_count_as_steps() -> None:
    """A number counts for as many steps as its weight says, and a wrong one earns nothing."""
    found = numbered(judgement("four-bar"), RIGHT, WRONG)
    share = score(found, weights("numbers=3")).shares[RESULTS]
    assert share == (3.0, 6.0)


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
    assert score(wrong, weights("wrong=-1")).total == 0.0


def test_steps_are_told_apart_by_what_they_serve() -> None:
    """In a loaded scene steps serve velocities first, then accelerations, then forces; the pose serves all."""
    found = judgement("jaanimets-10")
    groups, drawn = served(found.drawing), found.drawing.drawn
    assert set(groups) == {POSE, "velocity", "acceleration", "force"}
    assert all(groups[step.index] == "force" for step in drawn.steps if step.panel.startswith(("force plan", "lever")))
    assert "force" not in served(judgement("open-chain").drawing)
    assert all(groups[arg] != "force" for step in drawn.steps if groups[step.index] == "velocity" for arg in step.args)


def test_weights_are_read() -> None:
    """What a text leaves out stays as it is by default."""
    assert weights("") == Weights()
    assert weights("follows=0.5, numbers = 3") == Weights(follows=0.5, numbers=3.0)


@pytest.mark.parametrize(("text", "why"), [
    ("wright=1", "nothing of this name is weighed"),
    ("wrong=0,wrong=1", "wrong is told twice"),
    ("right=0", "this is no weight; a number from 0.001 to 1000"),
    ("numbers=-1", "this is no weight; a number from 0 to 1000"),
    ("right=1e308,numbers=1e308", "this is no weight"),
    ("wrong=-inf", "this is no weight; a number from -1000"),
    ("missing=nan", "this is no weight"),
    ("wrong=much", "this is no weight"),
    ("wrong=2", "earns more than what is right"),
])
def test_bad_weights_are_refused(text: str, why: str) -> None:
    """One line says what is wrong with the weights."""
    with pytest.raises(Refused, match=why):
        weights(text)


def test_what_is_implied_earns_and_what_cannot_be_told_does_not() -> None:
    """A step that a right mark bears out earns as if it were drawn; one that cannot be told earns nothing."""
    found = judgement("four-bar")
    implied, unsure = (replace(found, verdicts=tuple(replace(v, state=state) for v in found.verdicts))
                       for state in (IMPLIED, UNSURE))
    assert score(implied, weights("missing=0.5")).total == 100.0
    assert score(unsure, weights("missing=0.5")).total == 0.0
