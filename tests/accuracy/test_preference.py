"""Which form is preferred, and what is told of it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

import graphplan as gp
from graphplan.accuracy.drafted import Drafted
from graphplan.accuracy.hand import Pencil
from graphplan.accuracy.preference import FORMS, Form, choose_form, forms, preferred_form
from graphplan.commands import main
from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.methods import construct as ways
from graphplan.methods.construct import construct as unchecked
from graphplan.methods.construction import Construction

SCENE = gp.load("alt-eight-link")
POSE = """
[points]
O = [-11, -24]
A = [-114, 60]
E = [45, 34]
F = [190, 114]
G = [86, 20]
B = [30, 233]
C = [113, 1]

[links]"""
SCALES = "[sheet]  # longer velocities than a sheet would choose\nk_s = 4\nk_v = 40\n"
TRIAD = re.sub(r"\n\[points\].*\[links\]", POSE, gp.load("triad").text, flags=re.DOTALL) + SCALES


@pytest.fixture(scope="module")
def found() -> list[Form]:
    """The forms of a triad on polar plans, in a pose in which the shortest is not the most accurate."""
    return forms(gp.parse(TRIAD, "triad"), Pencil(), plan="polar", paper="A2")


@pytest.fixture(scope="module")
def drawn(found: list[Form]) -> dict[str, Drafted]:
    """The same drawn, by method."""
    return {method: form.drafted for form in found for method in form.methods if form.drafted is not None}


def test_every_form_is_drawn_once(drawn: dict[str, Drafted]) -> None:
    """Every method has its form; those that draw the same share it."""
    assert set(drawn) == set(FORMS)
    assert drawn[""] is drawn["poles"] is not drawn["auxiliary"]


def test_quick_and_accurate_are_the_best_of_their_kind(found: list[Form], drawn: dict[str, Drafted]) -> None:
    """The quick form has the fewest operations, the accurate one the smallest error; here they are two."""
    quick, accurate = (drawn[choose_form(found, prefer).method] for prefer in ("quick", "accurate"))
    assert quick.operations == min(one.operations for one in drawn.values()) < accurate.operations
    assert accurate.error == min(one.error for one in drawn.values()) < quick.error


def test_balanced_has_the_smallest_product(found: list[Form], drawn: dict[str, Drafted]) -> None:
    """No form has less of operations times error than the balanced one."""
    balanced = drawn[choose_form(found, "balanced").method]
    assert balanced.operations * balanced.error == min(one.operations * one.error for one in drawn.values())


def test_what_was_weighed_is_told(found: list[Form], drawn: dict[str, Drafted]) -> None:
    """The choice is told with every alternative, its operations and its error, a line each."""
    head, *others = choose_form(found, "quick").remarks
    assert head == "quick form preferred: auxiliary; compared on A2:"
    assert {line.partition(":")[0] for line in others} == {"pose's own, poles", "auxiliary", "trial"}
    assert any(line.startswith("trial") and f"{drawn['trial'].operations} operations" in line for line in others)


def test_preference_and_method_exclude_each_other(capsys: pytest.CaptureFixture[str]) -> None:
    """A form that is named needs no preference: asked for both, the command refuses."""
    assert main(["draw", "four-bar", "--prefer", "quick", "--method", "trial"]) == 2
    assert capsys.readouterr().err.startswith("--prefer quick: --method trial already names the form")
    with pytest.raises(Refused, match="unknown preference"):
        preferred_form(SCENE, "cheap", Pencil())


def test_a_form_that_cannot_be_drawn_says_why() -> None:
    """On paper too small for a given scale a form is not drawn and keeps the reason; where none is that is raised."""
    large = replace(SCENE, sheet=replace(SCENE.sheet, k_s=Fraction(1, 10)))
    refused = forms(large, Pencil(), paper="A4")
    assert {form.name for form in refused} == {"pose's own", "auxiliary", "trial", "poles"}
    assert all(re.search("cannot be drawn: .* does not fit on A4", form.verdict) for form in refused)
    with pytest.raises(Refused, match="does not fit on A4"):
        preferred_form(large, "quick", Pencil(), paper="A4")


@pytest.mark.costly
def test_the_protocol_tells_the_preference(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """`steps --prefer` draws the form preferred, of the least error, and its protocol says what was weighed."""
    scene = tmp_path / "triad.toml"
    scene.write_text(TRIAD)
    assert main(["steps", str(scene), "--plan", "polar", "--prefer", "accurate"]) == 0
    told = capsys.readouterr().out
    preferred, weighed = re.search(r"accurate form preferred: (.*); compared on A\d.*:\n((?: .*\n)+)", told).groups()
    errors = {name: float(error) for name, error in re.findall(r"  (.*): \d+ operations, error ([\d.]+) %", weighed)}
    assert len(errors) > 1
    assert min(errors.values()) == next(error for name, error in errors.items() if preferred in name)


@pytest.mark.parametrize(("name", "times"), [("five-bar", 1), ("four-bar", 2), ("triad", 4)])
def test_methods_that_lead_to_one_program_are_judged_once(name: str, times: int) -> None:
    """Of a five-bar, whose poles hang on its drives, there is one drawing, of a four-bar one more by poles; a triad's
    own form, auxiliary points, trial figures and poles are four drawings."""
    judged: list[str] = []

    def construct(scene: Scene, method: str, **how: Any) -> Construction:
        judged.append(method)
        return gp.construct(scene, method=method, **how)

    found = forms(gp.load(name), Pencil(), plan="polar", construct=construct)
    assert sorted(method for form in found for method in form.methods) == sorted(FORMS)
    assert len(judged) == times


@pytest.mark.parametrize("method", ["", "auxiliary", "trial"])
def test_what_is_kept_of_other_forms_changes_no_drawing(method: str) -> None:
    """It has the same steps of the same links, with the same reasons, and each in its own stage."""
    scene = gp.load("triad")
    alone = unchecked(scene, method=method, strict=True)
    assert alone.drawn.steps
    with ways.keep_ways():
        for name in ("auxiliary", ""):
            assert unchecked(scene, method=name, strict=True).drawn.steps
        again = unchecked(scene, method=method, strict=True)
    for one, other in zip(alone.drawn.steps, again.drawn.steps, strict=True):
        assert (one.key, one.name, one.links, one.panel, str(one.choice), one.why) == (
            other.key, other.name, other.links, other.panel, str(other.choice), other.why)
    titles = [[stage.title for stage, _ in drawing.drawn.stages] for drawing in (alone, again)]
    assert titles[0] == titles[1]
    assert {step.stage for step in again.drawn.steps} <= {step.stage for step in again.program.steps}


def test_a_refusal_ends_a_search_each_time() -> None:
    """What ends the search for ways is told to all that ask for them, not as if there were no more."""
    def search() -> Iterator[Construction]:
        yield first
        raise Refused("another", "no ring", "draw another")

    first = gp.construct(gp.load("four-bar"))
    found = ways.FoundWays(search())
    for _ in range(2):
        asked = iter(found)
        assert next(asked) is first
        with pytest.raises(Refused):
            next(asked)
