"""What sentences speak of is as long on paper: with a ruler, a student finds what he is told."""

from __future__ import annotations

import math
from typing import Any

import pytest
from inked_sheet import InkedSheet
from measured import random_scenes
from sheets import SCENES, composition_of, drawing_of
from spoken import misspoken, spoken

import graphplan as gp
from graphplan.errors import GraphplanError
from graphplan.output.svg import svg
from graphplan.output.text import steps
from graphplan.sheet.layout.composition import Composition, compose
from graphplan.sheet.layout.layout import layout

DRAWN = [(name, {}) for name in SCENES] + [(name, {"plan": "polar"}) for name in SCENES[::8]]


def told_of(composition: Composition, *, drawn: bool = True) -> tuple[dict[str, Any], InkedSheet | None]:
    """The list of steps, and the sheet as it is drawn."""
    return steps(composition), InkedSheet.of(svg(layout(composition))) if drawn else None


@pytest.mark.parametrize(("name", "how"), DRAWN)
def test_spoken_lengths_are_those_of_the_sheet(name: str, how: dict[str, str]) -> None:
    """Every number of mm in a sentence is what a ruler measures between its marks, on some sheets between circles."""
    told, sheet = told_of(composition_of(name, **how), drawn=name in SCENES[::4])
    measured = [step for step in told["steps"] if step["number"] and step["instrument"] in ("scale", "dividers")]
    assert sum(len(spoken(step["sentence"])) for step in told["steps"]) >= min(6, len(measured)) / 2
    assert misspoken(told, sheet) == []


@pytest.mark.costly
@pytest.mark.parametrize("seed", range(3))
def test_spoken_lengths_of_random_linkages_are_those_of_the_sheet(seed: int) -> None:
    """So it is of any linkage, under load too."""
    (_, scene), = random_scenes(1, seed)
    try:
        told, _ = told_of(compose(gp.construct(scene)), drawn=False)
    except GraphplanError:
        pytest.skip("cannot be drawn in this pose")
    assert misspoken(told) == []


def test_a_length_that_is_spoken_wrong_is_found() -> None:
    """A mark elsewhere makes sentences wrong, and so does a number that nothing measures."""
    told, _ = told_of(composition_of("four-bar"))
    moved = [{**step, "paper": [step["paper"][0] + 1, *step["paper"][1:]]} if step["makes"] == "v_b" else step
             for step in told["steps"]]
    assert len(misspoken({**told, "steps": moved})) > 2
    wrong = [{**step, "sentence": step["sentence"].replace(" mm.", " mm, 99.9 mm.")} for step in told["steps"]]
    assert len(misspoken({**told, "steps": wrong})) > 5


@pytest.mark.parametrize("name", SCENES)
def test_what_the_scale_lays_off_is_told_in_mm(name: str) -> None:
    """No step leaves it open how long it is what is measured off on the scale, unless it is nothing."""
    composition = composition_of(name)
    for step, plate in zip(steps(composition)["steps"], composition.plates.steps, strict=True):
        nothing = plate.root is not None and math.dist(plate.root.spot, plate.spot) < 0.06
        if step["instrument"] == "scale" and step["kind"] == "point" and step["number"] and not nothing:
            assert step["lengths"], step["sentence"]


@pytest.mark.parametrize("name", SCENES)
def test_what_is_measured_means_what_is_computed(name: str) -> None:
    """A reading by tenths of mm gives the computed value, as near as half a tenth and four printed figures let it."""
    tempo = float(drawing_of(name).tempo.unit)
    found = steps(composition_of(name))["readings"]
    assert found
    for one in found:
        assert abs(abs(one["value"]) - abs(one["computed"])) <= off(one, tempo) + half_figure(one["value"]), one["said"]


def half_figure(value: float) -> float:
    """Half of the last of four figures: results are printed so."""
    return 0.5 * 10.0 ** (math.floor(math.log10(abs(value))) - 3) if value else 0.0


def off(one: dict[str, Any], tempo: float) -> float:
    """How far off a reading may be by what tenths of mm leave open."""
    mm, marks = ([length[key] for length in one["lengths"]] for key in ("mm", "marks"))
    size = max(abs(one["value"]), abs(one["computed"]))
    if one["kind"] == "omega" and len(marks[0]) == 2:
        return 0.051 / mm[1] * (1 + mm[0] / mm[1]) * tempo
    if len(mm) > 2:  # a moment of several forces
        return sum(0.051 * (a + b) for a, b in zip(mm[::2], mm[1::2], strict=True)) / min(
            a * b for a, b in zip(mm[::2], mm[1::2], strict=True)) * size * len(mm)
    return sum(0.051 / length for length in mm if length) * size * 1.01
