"""A protocol follows the reasoning: what a stage reads is told before it, and each stage in one piece."""

from __future__ import annotations

import re
from itertools import groupby, pairwise

import pytest
from sheets import SCENES, composition_of, drawing_of

from graphplan.kernel.kinds import Sizing
from graphplan.output import text
from graphplan.sheet.words.protocol import Passage, Protocol
from graphplan.words.tongue import tongue

PLANS = "orthogonal", "polar"
MAX_WORDS = 1215  # and numbers of the steps of Rosenauer's own example, with all equations and lengths


def passages(name: str, plan: str = "orthogonal") -> tuple[Passage, ...]:
    """The passages of a packaged scene's protocol."""
    return Protocol(composition_of(name, plan=plan).plans, composition_of(name, plan=plan).scales).passages


@pytest.mark.parametrize("plan", PLANS)
@pytest.mark.parametrize("name", SCENES)
def test_a_stage_is_interrupted_only_by_what_it_needs(name: str, plan: str) -> None:
    """A stage is continued only where it and another read each other."""
    drawing, told = drawing_of(name, plan).drawn, passages(name, plan)
    stage_of = {movement.index: passage.number for passage in told for entry in passage.entries
                for movement in entry.movements}
    reads: dict[int | None, set[int | None]] = {}
    for index, number in stage_of.items():
        reads.setdefault(number, set()).update(stage_of[arg] for arg in drawing.steps[index].args if arg in stage_of)
    for passage in told:
        others = {number for number in reads[passage.number] if number != passage.number}
        assert not passage.again or passage.number in _behind(reads, others), passage.title


def _behind(reads: dict[int | None, set[int | None]], numbers: set[int | None]) -> set[int | None]:
    """All that some stages read, and what that reads."""
    while (more := numbers.union(*(reads[number] for number in numbers))) != numbers:
        numbers = more
    return numbers


@pytest.mark.parametrize("plan", PLANS)
@pytest.mark.parametrize("name", [*SCENES, "double-butterfly"])
def test_a_compound_is_split_only_after_what_others_read(name: str, plan: str) -> None:
    """The movements of a compound follow each other, on whatever plans they are, but where those up to there give what
    another reads, too: the second trial lays off the length that the first has constructed."""
    drawing = drawing_of(name, plan)
    for compound in drawing.compounds:
        own = {movement.index for movement in compound.movements}
        shared = {arg for step in drawing.drawn.steps if step.index not in own for arg in step.args} & own
        assert all(two.index == one.index + 1 or one.index in shared
                   for one, two in pairwise(compound.movements)), compound.sentence


@pytest.mark.parametrize("plan", PLANS)
@pytest.mark.parametrize("name", SCENES)
def test_a_law_and_an_idea_are_told_once(name: str, plan: str) -> None:
    """What holds for many stages, and what a plan is for, stands over the first."""
    once = [told for passage in passages(name, plan) for told in (passage.law, *passage.idea) if told]
    assert len(once) == len(set(once))


def test_likes_are_told_briefly() -> None:
    """What is done as before is told in few words, without a title of its own where an equation says what it is."""
    told = [passage for passage in passages("rosenauer-basic") if passage.likewise]
    assert len(told) > 10
    assert all("Likewise" in entry.sentence for passage in told for entry in passage.entries)
    composition = composition_of("rosenauer-basic")
    protocol = text.protocol(composition).partition("On the mechanism plan:")[2].partition("Measured")[0]
    assert sum(bool(re.search(r"\w", word)) for word in protocol.split()) <= MAX_WORDS
    assert "continued" not in protocol


def test_the_first_velocity_is_introduced() -> None:
    """Where a crank's velocity ends in its pivot, that and the scale which makes it so are told before it is read."""
    first, *others = passages("four-bar")
    assert "v_A ends in O: k_v = omega_1 · k_s" in first.idea
    assert [passage.plan for passage in others if passage.idea] == ["N-plan"]
    assert "v_B, v_P12, v_P12(2) end in O: k_v = omega_1 · k_s" in passages("planetary")[0].idea


def test_what_is_told_together_has_one_heading() -> None:
    """It lists all vectors that the stages under it give; each stage's own title stays its own."""
    headings = [str(passage.title) for passage in passages("rosenauer-basic") if not passage.likewise]
    assert {"Velocity of M, N, L, K", "Locus of v_d, v_e, v_b, v_a",
            "Auxiliary point Q, R of link 3, link 4, locus of v_c",
            "Normal acceleration of C about D, D about M, C about A, A about K, by the semicircle"} <= {*headings}
    assert not any(passage.heading for passage in passages("instant-centres") if "Pole" in str(passage.title))
    assert [passage.title for passage in passages("four-bar") if passage.likewise] == [
        passage.stage.title for passage in passages("four-bar") if passage.likewise and passage.stage]


def test_what_goes_on_under_a_title_has_no_second_one() -> None:
    """The yoke's guide force is told in two stages of one title, one after the other, under one heading."""
    titles = [str(one.title) for one in passages("ozols-13-6") if one.title and not one.likewise]
    assert not [one for one, two in pairwise(titles) if one == two]


def test_a_heading_for_several_is_in_the_plural() -> None:
    """Where a language has such a form; of one point it stays in the singular."""
    headings = [tongue("ru")(passage.title) for passage in passages("rosenauer-basic") if not passage.likewise]
    assert {"Скорости точек D, E, A, B", "Скорость точки C", "Ускорения точек D, E, A, B"} <= {*headings}


@pytest.mark.parametrize("plan", PLANS)
def test_a_plan_is_told_in_one_go(plan: str) -> None:
    """Where links read each other in a ring, too: all but the mechanism's plan are left when they are done."""
    runs = [str(key) for key, _ in groupby(passages("class-four-loaded", plan), lambda passage: passage.plan)]
    others = [run for run in runs if run != "mechanism"]
    assert len(others) == len(set(others)) >= 4


def test_an_equation_is_told_once() -> None:
    """Of two trials the second has no equations that the first has."""
    told = [equation for passage in passages("class-four-loaded") for equation in passage.equations]
    assert len(told) == len(set(told)) > 20


@pytest.mark.parametrize("name", ["ozols-13-6", "ozols-13-7", "ozols-10-2"])
def test_every_moment_says_what_is_laid_off(name: str) -> None:
    """The force with its product, or that the arm is 0, where what is given passes through the point."""
    protocol = Protocol(composition_of(name).plans, composition_of(name).scales)
    assert protocol.lengths is not None
    moments = [step for step in drawing_of(name).drawn.steps if step.op.sizing is Sizing.MOMENTS]
    told = [str(length.text) for step in moments for length in protocol.lengths.for_step(step)]
    assert len(told) == len(moments) > 1
    assert all("P·h/" in words or words == "h = 0.0 mm" for words in told)
    assert "h = 0.0 mm" in told
