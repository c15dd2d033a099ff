"""The GeoGebra export over the whole slider: vectors are derivatives of the file's own positions, whatever is moved."""

from __future__ import annotations

import cmath
import math
import re
import shutil
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import combinations
from typing import Any, NamedTuple

import pytest
from geogebra_program import WebGeoGebra, web_geogebra
from geogebra_reader import condition, opened, read
from objects import drafted_plates

import graphplan as gp
from graphplan.cycle.turn import points_under_slides
from graphplan.mechanism.scene import load, packaged_names
from graphplan.mechanism.travel import sense
from graphplan.output.exports.geogebra import geogebra
from graphplan.output.exports.ggb_commands import labels

POSES = 25
FAULTY_ONCE = ["geared-five-bar", "planetary", "wheel-on-rail"]
DRIVEN = [name for name in packaged_names() if (scene := load(name)).drives and not scene.motions]
VALUE = re.compile(r'"([va])_\{?(\w+)\}? = " \+ \((\S+) \* Length\[(\S+)\]\)')
MIDDLE = 0.47  # of the way from pose to pose: at 180 degrees GeoGebra takes a sine of 1e-8 for nothing
ALONE = 1e-3  # of the largest value of a point: below, it is lost in the steps of the difference


class Vector(NamedTuple):
    """A vector of the file: of which point, at which scale, and under which label."""

    kind: str
    point: str
    scale: float
    label: str


class MovingFile:
    """A packaged scene as a GeoGebra file, and what its points, sliders and vectors are called."""

    def __init__(self, name: str):
        drawing, plates, _ = drafted_plates(name)
        self.scene, self.packed, self.view = drawing.scene, geogebra(plates), next(iter(plates)).view
        self.document = opened(self.packed)
        self.called = {name: labels(plates)[mark] for name, mark in plates.pose.items()}

    @cached_property
    def limits(self) -> tuple[float, float]:
        """From where to where the first slider goes."""
        slider = next(self.document.iter("slider"))
        return float(slider.get("min", "")), float(slider.get("max", ""))

    @cached_property
    def travels(self) -> list[float]:
        low, high = self.limits
        return [low + (high - low) * (k + MIDDLE) / POSES for k in range(POSES)]

    @cached_property
    def free(self) -> dict[str, complex]:
        """Pins that may be dragged, by label, and where they are given."""
        points = {element.get("label", ""): element for element in self.document.iter("element")
                  if element.get("type") == "point" and element.find("fixed") is None}
        return {label: complex(float(at.get("x", "")), float(at.get("y", ""))) for label in self.called.values()
                if label in points and (at := points[label].find("coords")) is not None}

    @cached_property
    def vectors(self) -> list[Vector]:
        """The velocities and accelerations of points of links: where a slide alone says where a point is, it is no
        point of its link in the next pose."""
        texts = (VALUE.match(entry.get("exp", "")) for entry in self.document.iter("expression"))
        return [Vector(text[1], text[2], float(text[3].strip("()")), text[4]) for text in texts
                if text and text[2] in self.called and text[2] not in points_under_slides(self.scene)]

    def sliders(self, travel: float, time: float) -> dict[str, float]:
        """Where the sliders stand so long after the first has gone so far and the others have kept pace."""
        first, settings = self.scene.drives[0], dict[str, float]()
        for k, drive in enumerate(self.scene.drives):
            rate, change = (sense(drive) * float(number) for number in drive.rates)
            share = rate / abs(float(first.rate)) if first.rate else float(not k)
            moved = rate * time + change * time**2 / 2
            settings[f"drive_{{{k + 1}}}"] = share * travel + (moved if drive.slides else math.degrees(moved))
        return settings

    def differences(self, state: Callable[[Mapping[str, float]], Mapping[str, Any]], travel: float) -> Iterator[Any]:
        """Each vector with its value in the file, and the same from three positions of its point."""
        drive = self.scene.drives[0]
        unit = self.scene.extent if drive.slides else 1.0
        step = 2e-4 * unit / (abs(float(drive.rate)) or 1.0)
        before, now, after = (state(self.sliders(travel, time)) for time in (-step, 0.0, step))
        for vector in self.vectors:
            p, q, r = (values[self.called[vector.point]] / self.view.scale for values in (before, now, after))
            difference = (r - p) / (2 * step) if vector.kind == "v" else (r - 2 * q + p) / step**2
            yield vector, vector.scale * abs(getattr(now[vector.label], "z", now[vector.label])), abs(difference)


def faults(file: MovingFile, state: Callable[[Mapping[str, float]], Mapping[str, Any]],
           travels: Sequence[float]) -> list[str]:
    """The vectors that are no derivatives."""
    pairs = [(travel, *pair) for travel in travels for pair in file.differences(state, travel)]
    largest: dict[Vector, float] = {}
    for _, vector, _, difference in pairs:
        largest[vector] = max(largest.get(vector, 0.0), difference)
    return [f"{vector.kind}_{vector.point} at {travel:.4g}: {value:.6g}, its point moves by {difference:.6g}"
            for travel, vector, value, difference in pairs
            if not abs(value - difference) <= 1e-4 * abs(difference) + ALONE * largest[vector]]


def moved_pin(file: MovingFile) -> dict[str, complex]:
    """A pin a little off."""
    label, place = [*file.free.items()][-1]
    return {label: place + 0.004 * file.view.scale * file.scene.extent * cmath.exp(2j)}


@pytest.mark.parametrize("name", FAULTY_ONCE)
def test_no_pose_is_lost(name: str) -> None:
    """Over the whole slider every point is where the cycle has it; what is not free to be dragged is fixed."""
    file = MovingFile(name)
    points = {element.get("label"): element.find("fixed") for element in file.document.iter("element")}
    assert all(label in file.free or points[label].get("val") == "true" for label in file.called.values())
    poses = gp.follow(file.scene, POSES, (file.travels[0], file.travels[-1]))
    for k in range(0, POSES, 4):
        values = read(file.document, file.sliders(file.travels[k], 0.0))
        for point, places in poses.points.items():
            assert abs(values[file.called[point]] - complex(*file.view((places[k].real, places[k].imag)))) < 1e-5


@pytest.mark.parametrize("name", DRIVEN[::4])
def test_vectors_are_derivatives_over_the_whole_slider(name: str) -> None:
    """Velocities and accelerations are those of the file's own points, in the given linkage and with a pin moved."""
    file = MovingFile(name)
    assert file.vectors
    for pins in ({}, moved_pin(file) if file.free else {}):
        travels = file.travels if not pins else file.travels[8:17:4]
        assert not faults(file, lambda sliders, pins=pins: read(file.document, {**pins, **sliders}), travels)


def far_pins(file: MovingFile) -> Iterator[dict[str, complex]]:
    """Each pin that may be dragged, further and further off."""
    size = file.view.scale * file.scene.extent
    yield from ({label: place + times * size * cmath.exp(0.7j)} for label, place in file.free.items()
                for times in (0.2, 1.0, 5.0, 50.0))


def is_torn(file: MovingFile, values: Mapping[str, Any]) -> bool:
    """Whether a link's points that are defined are apart otherwise than in the scene."""
    under, torn = points_under_slides(file.scene), False
    for link in file.scene.moving:
        for one, other in combinations([name for name in file.scene.links[link] if name not in under], 2):
            apart = values[file.called[one]] - values[file.called[other]]
            given = math.dist(*([*map(float, file.scene.points[name])] for name in (one, other))) * file.view.scale
            torn |= abs(abs(apart) - given) > 1e-6 * file.view.scale * file.scene.extent
    return torn


@pytest.mark.parametrize("name", dict.fromkeys(("four-bar", "alt-eight-link", *DRIVEN[1::4])))
def test_what_cannot_be_assembled_is_said_and_comes_back(name: str) -> None:
    """With a pin far off links are as they were, or some points are undefined and a text says so; back, all is well."""
    file, said = MovingFile(name), set[bool]()
    for pins in ({}, *far_pins(file), {}):
        values = read(file.document, {**pins, **file.sliders(file.travels[12], 0.0)})
        assert not is_torn(file, values)
        undefined = any(cmath.isnan(values[label]) for label in file.called.values())
        assert condition(file.document, "cannot be assembled", values) == undefined
        assert pins or not undefined
        said.add(undefined)
    assert True in said or name not in ("four-bar", "alt-eight-link")


@pytest.fixture(scope="module")
def pad() -> Iterator[Any]:
    """GeoGebra 5 in Chromium."""
    api, chromium = pytest.importorskip("playwright.sync_api"), shutil.which("chromium")
    if chromium is None:
        pytest.skip("no Chromium is installed")
    with api.sync_playwright() as play:
        browser = play.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        with web_geogebra(browser) as page:
            yield page
        browser.close()


@pytest.mark.parametrize("name", DRIVEN[2::4])
def test_vectors_are_derivatives_in_geogebra_itself(name: str, pad: Any) -> None:
    """The same of GeoGebra 5's own points and vectors, in the given linkage and with a pin moved."""
    file = MovingFile(name)
    labels, program = [*file.called.values(), *(vector.label for vector in file.vectors)], WebGeoGebra(pad, file.packed)
    for pins in ({}, moved_pin(file) if file.free else {}):
        travels = file.travels if not pins else file.travels[8:17:4]
        assert not faults(file, lambda sliders, pins=pins: program.places(labels, {**pins, **sliders}), travels)


@pytest.mark.parametrize("name", dict.fromkeys(("four-bar", *DRIVEN[3::4])))
def test_what_cannot_be_assembled_is_said_in_geogebra_itself(name: str, pad: Any) -> None:
    """With a pin far off GeoGebra 5 shows the text just where a point is undefined, and no link is torn."""
    file = MovingFile(name)
    program, called = WebGeoGebra(pad, file.packed), [*file.called.values()]
    text = next(entry.get("label") for entry in file.document.iter("expression")
                if "cannot be assembled" in entry.get("exp", ""))
    for pins in ({}, *far_pins(file), file.free):
        values = program.places(called, {**pins, **file.sliders(file.travels[12], 0.0)})
        assert not is_torn(file, values)
        assert program.page.evaluate("(label) => api.getVisible(label)", text) == any(map(cmath.isnan, values.values()))
