"""Variants: what is drawn, how it is worded, and what is no task for a class."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

import pytest

from graphplan.accuracy.drafted import Drafted, draft
from graphplan.accuracy.hand import Pencil
from graphplan.check.trusted import report
from graphplan.marking.classroom.quality import DrawnSize, Flaw, Quality, assess
from graphplan.marking.classroom.variants import Design, Wording, draw_values, sheet_keys
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import load, parse
from graphplan.words.tongue import ENGLISH, tongue

CHOICES = {"a": tuple(map(Fraction, range(4))), "b": tuple(map(Fraction, range(3)))}


def draw(scene: Scene) -> Drafted:
    """A scene on its sheet."""
    found = report(scene)
    return draft(found.drawing, Pencil(), check=found.check)


def design(name: str) -> Design:
    """A packaged scene as that of a class."""
    return Design(draw(load(name)), draw, map)


def test_values_are_drawn_uniformly_and_none_twice() -> None:
    """All of the grid is drawn, each once, in an order of the seed alone; each place is as likely to come first."""
    found = [tuple(values.values()) for values in draw_values(CHOICES, 5)]
    assert len(found) == len(set(found)) == 12
    assert found == [tuple(values.values()) for values in draw_values(CHOICES, 5)]
    assert found != [tuple(values.values()) for values in draw_values(CHOICES, 6)]
    firsts = Counter(tuple(next(draw_values(CHOICES, seed)).values()) for seed in range(1200))
    assert len(firsts) == 12
    assert all(60 < count < 140 for count in firsts.values())


def test_a_variant_is_worded_as_its_teacher_would() -> None:
    """Numbers, title and sheet are changed in the text, in the language of the class; [vary] is gone."""
    scene = load("ozols-5-1")
    values = {"points.A.angle": Fraction(35), "drive.0.omega": Fraction(25, 2)}
    for say, title in ((ENGLISH, f"{scene.title}, variant 7"), (tongue("de"), f"{scene.title}, ")):
        wording = Wording(scene.text, scene.title, {"paper": '"A3"', "k_s": "2.5"}, say)
        found = parse(wording.variant(7, values).text, "variant")
        assert found.title.startswith(title)
        assert found.vary == {}
        assert (found.sheet.paper, found.sheet.k_s) == ("A3", Fraction(5, 2))
        assert found.drives[0].rate == Fraction(25, 2)
        assert found.placements["A"].data["angle"] == 35
        assert "# The printed data: OA = 250" in found.text


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "jaanimets-11", "rosenauer-basic"])
def test_the_scene_itself_is_a_task(name: str) -> None:
    """A scene at the scales of its own sheet has no flaw, and has that sheet's scales."""
    own = design(name)
    composition = own.drafted.composition
    keys = sheet_keys(own.scene, composition.scales, composition.arrangement.paper)
    text = own.wording(keys).variant(1, {}).text
    assert assess(text, name, draw, own.own_quality) == composition.scales.multiples
    assert draw(parse(text, name)).composition.scales == composition.scales


FLAWS: Mapping[str, tuple[str, dict[str, str], str]] = {
    "arcs that miss": ("ozols-5-1", {"points.B.distances.A": "280", "points.A.angle": "90"}, "it cannot be assembled"),
    "a dead centre": ("four-bar", {"points.A.0": "-40", "points.A.1": "450"}, "it is singular"),
    "too fast for its scale": ("four-bar", {"drive.0.omega": "30"}, "it does not fit the scales of the class"),
    "too slow for its scale": ("four-bar", {"drive.0.omega": "2"}, "vectors are too short"),
}


@pytest.mark.parametrize("case", FLAWS)
def test_flaws_are_told(case: str) -> None:
    """What is no task for a class is told by its kind."""
    name, values, kind = FLAWS[case]
    own = design(name)
    composition = own.drafted.composition
    wording = own.wording(sheet_keys(own.scene, composition.scales, composition.arrangement.paper))
    variant = wording.variant(1, {path: Fraction(value) for path, value in values.items()})
    found = assess(variant.text, name, draw, own.own_quality)
    assert isinstance(found, Flaw)
    assert found.kind == kind
    assert found.text


def test_a_sheet_may_be_as_bad_as_the_scenes_own() -> None:
    """What is poor is only a flaw where the scene's own sheet is better."""
    good = Quality({"v_A": DrawnSize(8.0, 8.0)}, (), 0.0, True, 40.0, "omega of link 2", 0.02)
    bad = Quality({"v_A": DrawnSize(3.0, 8.0)}, (7,), 0.5, False, 5.0, "omega of link 2", 0.5)
    assert bad.find_flaw(bad) is None
    assert good.find_flaw(good) is None
    assert bad.find_flaw(good) == Flaw("it is nearly singular", "lines cross at 5°")
    shorter = replace(good, sizes={"v_A": DrawnSize(7.9, 8.0)})
    assert shorter.find_flaw(good) == Flaw("vectors are too short", "v_A has 7.90 mm, less than 8")
    assert shorter.find_flaw(bad) is None
    crowded = replace(good, poor=0.3)
    assert crowded.find_flaw(good) == Flaw("the sheet is crowded", "the sheet is crowded, 30 % of its letters have no "
                                           "good place")


def test_a_small_grid_gives_the_same_numbers_twice() -> None:
    """Where the ranges have fewer values than there are students, all are given out before one is given again."""
    text = load("four-bar").text.partition("[vary]")[0] + '[vary]\n"drive.0.omega" = [9, 10]\n'
    found = Design(draw(parse(text, "four-bar")), draw, map).series(3, 1, lambda done, of: None)
    drawn = [variant.values["drive.0.omega"] for variant in found.variants]
    assert set(drawn[:2]) == {9, 10}
    assert drawn[2] == drawn[0]
    assert len({variant.text for variant in found.variants}) == 3
    assert "1 variants have the numbers of another" in [*found.lines][-1]
