"""GeoGebra and LaTeX step by step: pins that are dragged, words and letters, pictures in a column of text."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Mapping
from functools import cached_property
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
import tikz_reader
from claims_of_exports import apart, exported, points, sheet
from face import Got, got, names, ran
from geogebra_reader import condition, opened, read
from printed_labels import clashes

import graphplan as gp

DRIVEN = [name for name in names() if got(name).scene.drives and not got(name).scene.motions]
VALUE = re.compile(r'"([va])_\{?(\w+)\}? = " \+ \((\S+) \* Length\[(\S+)\]\)')
WIDTHS = 0.8, 0.5, 1.0, 60, 88, 150  # of \\linewidth, or mm


class Figure:
    """A scene's GeoGebra file, what its points are called, and which of them can be dragged."""

    def __init__(self, name: str):
        self.got: Got = got(name)
        self.scene, self.document = self.got.scene, opened(exported(name, "ggb"))
        self.elements = {one.get("label", ""): one for one in self.document.findall("construction/element")}
        self.texts = {one.get("label"): one.get("exp", "") for one in self.document.iter("expression")}
        slider = next(self.document.iter("slider"), None)
        self.low, self.high = (float(slider.get(end, "")) if slider is not None else 0.0 for end in ("min", "max"))

    @cached_property
    def free(self) -> dict[str, complex]:
        """Pins that may be dragged, by label, and where they are given."""
        return {label: complex(float(at.get("x", "")), float(at.get("y", ""))) for label, one in self.elements.items()
                if one.get("type") == "point" and one.find("fixed") is None and label.replace("{", "").replace("}", "")
                in self.scene.points and (at := one.find("coords")) is not None}

    @cached_property
    def called(self) -> dict[str, str]:
        """The points of moving links by the label that bears their letter; what only marks a slide's place has none."""
        under = {slide.at for slide in self.scene.slides}
        together = [place for place in self.scene.points.values() if [*self.scene.points.values()].count(place) > 1]
        labels = {label.replace("{", "").replace("}", ""): label for label in self.elements}
        return {name: labels[name] for name, place in self.scene.points.items()
                if name in labels and name not in under and place not in together and self.scene.links_of[name]}

    def values(self, travel: float = 0.0, pins: Mapping[str, complex] = {}, time: float = 0.0) -> dict[str, Any]:
        """The values of all objects so long after the first drive has gone so far, with pins moved."""
        sliders, first = {}, self.scene.drives[0]
        for k, drive in enumerate(self.scene.drives, 1):
            rate, change = (float(number) * (-1 if drive.rate < 0 else 1) for number in (drive.rate, drive.change))
            share = rate / abs(float(first.rate)) if first.rate else float(k == 1)
            moved = rate * time + change * time**2 / 2
            sliders[f"drive_{{{k}}}"] = share * travel + (moved if drive.slides else math.degrees(moved))
        return read(self.document, {**pins, **sliders})

    def torn(self, values: Mapping[str, Any]) -> list[str]:
        """Pairs of points of a link that are apart otherwise than in the given pose, where both are defined."""
        pairs = [(self.called[one], self.called[other]) for link in self.scene.moving
                 for one, other in combinations([name for name in self.scene.links[link] if name in self.called], 2)]
        return [one + other for one, other in pairs if abs(
            abs(values[one] - values[other]) - abs(self.given[one] - self.given[other])) > 1e-6 * self.size]

    @cached_property
    def given(self) -> dict[str, Any]:
        """The values of the given pose."""
        return self.values()

    @cached_property
    def size(self) -> float:
        """The longest distance of two points, in mm of paper."""
        return max(abs(self.given[one] - self.given[two]) for one, two in combinations(self.called.values(), 2))

    @property
    def plan(self) -> float:
        """How many mm a length of the scene is on paper."""
        places = [complex(*map(float, self.scene.points[name])) for name in self.called]
        return self.size / max(abs(one - two) for one, two in combinations(places, 2))


@pytest.mark.parametrize("name", dict.fromkeys(("four-bar", "alt-eight-link", *DRIVEN[1::4])))
def test_what_cannot_be_assembled_is_said_and_comes_back(name: str) -> None:
    """With a pin far off links are as they were, or some points are undefined and a text says so; back, all is well."""
    figure, said = Figure(name), set[bool]()
    size = figure.size
    travel = figure.low + 0.47 * (figure.high - figure.low)
    far = [{label: place + times * size * cmath.exp(0.7j)} for label, place in figure.free.items()
           for times in (0.2, 1.0, 5.0, 50.0)]
    for pins in ({}, *far, {}):
        values = figure.values(travel, pins)
        assert not figure.torn(values)
        undefined = any(cmath.isnan(values[label]) for label in figure.called.values())
        assert condition(figure.document, "cannot be assembled", values) >= undefined
        assert pins or not undefined
        said.add(undefined)
    assert True in said or name not in ("four-bar", "alt-eight-link")


@pytest.mark.costly
@pytest.mark.parametrize("name", DRIVEN[::4])
def test_vectors_are_derivatives_with_a_pin_moved(name: str) -> None:
    """With a pin of the frame moved, velocities and accelerations are those of the file's own points over a time."""
    figure, scene = Figure(name), got(name).scene
    texts = [text.groups() for text in map(VALUE.match, figure.texts.values()) if text]
    size, plan = figure.size, figure.plan
    step = 2e-4 * (scene.extent if scene.drives[0].slides else 1.0) / (abs(float(scene.drives[0].rate)) or 1.0)
    pins = {label: place + 0.004 * size * cmath.exp(2j) for label, place in [*figure.free.items()][-1:]}
    pairs = []
    for share in (0.31, 0.53, 0.75):
        travel = figure.low + share * (figure.high - figure.low)
        before, now, after = (figure.values(travel, pins, time) for time in (-step, 0.0, step))
        for kind, point, scale, label in texts:
            if point in figure.called:
                p, q, r = (values[figure.called[point]] / plan for values in (before, now, after))
                rate = (r - p) / (2 * step) if kind == "v" else (r - 2 * q + p) / step**2
                pairs.append((kind, point, float(scale.strip("()")) * abs(now[label].z), abs(rate)))
    assert pairs or name in ("geneva", "jaanimets-10", "ozols-10-2")  # what moves there lies together with a mark
    for kind, point, told, rate in pairs:
        largest = max(one[3] for one in pairs if one[:2] == (kind, point))
        assert abs(told - rate) <= 1e-4 * rate + 1e-3 * largest, (kind, point)


def test_a_handle_turns_the_drive_beyond_its_slider() -> None:
    """The pin's handle goes on from where the slider has led it."""
    figure = Figure("four-bar")
    O, A = figure.given["O"], figure.given["A"]
    begun = next(z for label, z in figure.values(30.0).items() if label.startswith("pin_"))
    assert abs(begun - figure.values(30.0)["A"]) < 1e-9
    turned = figure.values(30.0, {"handle_{1}": O + (begun - O) * cmath.exp(1j * math.radians(25))})
    assert abs(turned["A"] - (O + (A - O) * cmath.exp(1j * math.radians(55)))) < 1e-9


def test_what_is_seen() -> None:
    """Lettered marks alone have labels; curves are strokes, links bars and plates, vectors have their colours."""
    figure = Figure("rosenauer-basic")
    elements = [*figure.elements.values()]
    assert not [one for one in elements if one.get("type") in ("line", "conic", "numeric")
                and one.find("show").get("mark") == "true"]
    labelled = {label for label, one in figure.elements.items() if one.find("show").get("label") == "true"}
    assert {"K", "v_{a}", "Q", "Q_{1}"} <= labelled
    captions = [one.find("caption") for one in elements if one.get("type") == "segment"]
    assert {"β", "γ"} <= {caption.get("val") for caption in captions if caption is not None}
    assert {one.get("type") for one in elements} >= {"segment", "polygon", "vector", "conicpart", "text"}
    drawn = [vector.name for vector in sheet("rosenauer-basic").vectors if vector.name.startswith("velocity")]
    values = [text.group(1) for text in map(VALUE.match, figure.texts.values()) if text]
    assert values.count("v") == len(drawn) > 0
    blue = [one for one in elements if one.get("type") == "vector" and one.find("objColor").get("b") == str(0x8C)]
    assert len(blue) >= values.count("v")


def test_the_protocol_speaks() -> None:
    """The navigation bar stops at each drawn step, which ends with its sentence."""
    figure = Figure("jaanimets-10")
    stops = [label for label, one in figure.elements.items() if one.find("breakpoint") is not None]
    steps = {step["number"]: step["sentence"] for step in figure.got.steps["steps"]}
    assert stops == [f"step_{{{number}}}" for number in range(max(steps) + 1)]
    for number, sentence in steps.items():
        if number:
            assert sentence.split()[0] == figure.texts[f"step_{{{number}}}"].split()[1]


def test_check_boxes_for_plans_and_stages() -> None:
    """Each plan and each stage has a check box, by which what is drawn of it is seen; many fit into one column."""
    figure = Figure("four-bar")
    boxes = {label: one for label, one in figure.elements.items() if one.get("type") == "boolean"}
    captions = {one.find("caption").get("val") for one in boxes.values()}
    assert len(captions) == len({step["plan"] for step in figure.got.steps["steps"]}) + len(figure.got.steps["stages"])
    conditions = " ".join(one.find("condition").get("showObject") for one in figure.elements.values()
                          if one.find("condition") is not None)
    assert all(box in conditions for box in boxes)
    many = Figure("walschaerts-loaded")
    offsets = [int(one.find("labelOffset").get("y")) for one in many.elements.values() if one.get("type") == "boolean"]
    assert max(offsets) < 900
    assert len(many.got.steps["stages"]) > len(offsets) > len(many.got.steps["stages"]) / 4


def test_letters_are_typeset() -> None:
    """Names in sentences and captions have subscripts and Greek letters; a mark called e, which GeoGebra takes for a
    number, shows its letter by another label."""
    loaded = Figure("walschaerts-loaded")
    texts = " ".join(text for text in loaded.texts.values() if '"' in text)
    assert "R_{0,10} = " in texts
    assert "γ" in texts
    assert not re.search(r"\w_\w|\bgamma\b", texts)
    basic = Figure("rosenauer-basic").elements
    assert "e" not in basic
    assert any(one.find("caption").get("val") == "e" for one in basic.values() if one.find("caption") is not None)


# ---- LaTeX -----------------------------------------------------------------------------------------------------------


def test_what_tex_cannot_hold_is_given_as_it_lies() -> None:
    """Where a pole lies metres off the paper no coordinate does, and all other marks are where the sheet has them."""
    name = str(Path(__file__).parents[1] / "cases" / "exports" / "far-out.toml")
    spots = tikz_reader.coordinates(exported(name, "tex").decode()).values()
    assert max(map(abs, spots)) < 6000
    near = [place for place in points(name).values() if abs(place) < 1800]
    assert len(near) >= 5
    assert apart(near, [*spots]) < 1e-5


@pytest.mark.costly
@pytest.mark.parametrize(("name", "width"), [(name, WIDTHS[k % 6]) for k, name in enumerate(names()[::4])])
def test_labels_stand_apart_at_the_printed_width(name: str, width: float) -> None:
    """No label of a picture reaches into another one at its final width, in the type that the file sets it in."""
    labels, pairs = clashes(gp.load(name), width)
    assert labels > 3
    assert pairs == 0


def test_scales_are_told_where_they_are_known(tmp_path: Path) -> None:
    """A picture so many mm wide tells the scales at which it is printed; one as wide as a line, none."""
    pictures = []
    for width in ("60", "0.5"):
        assert ran("export", "four-bar", "-q", "--width", width, "-o", tmp_path / "picture.tex").status == 0
        pictures.append((tmp_path / "picture.tex").read_text(encoding="utf-8"))
    reduction = float(re.search(r"graphplan=60mm/([\d.]+)", pictures[0])[1]) / 60
    places, k_s = tikz_reader.coordinates(pictures[0]), float(re.search(r"\$k_\{s\}\$ = ([\d.]+)", pictures[0])[1])
    assert reduction > 1
    assert k_s * abs(places["O"] - places["C"]) / reduction == pytest.approx(310)
    assert "k_{s}" not in pictures[1]
