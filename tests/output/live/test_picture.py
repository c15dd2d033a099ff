"""The live page's picture, drawn by JavaScript: in the given pose the sheet's own, in others as Python draws them."""

from __future__ import annotations

import cmath
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import combinations, islice, pairwise
from typing import Any

import pytest
from pages import chromium

import graphplan as gp
from graphplan.cycle import follow
from graphplan.errors import GraphplanError
from graphplan.mechanism.scene import packaged_names
from graphplan.methods.construction import Construction
from graphplan.output.live.picture import PictureData, captions_by_step, scripts
from graphplan.output.svg import ink_group, svg
from graphplan.sheet.cycle_frames import construction_in_pose
from graphplan.sheet.frames.title import CONSTRUCTION
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.layout.layout import captions, frame_items, plans_sheet, sheet
from graphplan.sheet.lettering.letters import letter_plate
from graphplan.sheet.lettering.prices import strokes as thin
from graphplan.sheet.plates.display import Circle, Item, Rect
from graphplan.sheet.plates.drawn_step import LAYER
from graphplan.sheet.plates.lever_arms import LAYER as ARMS
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.plate import Plates
from graphplan.sheet.plates.view import clip_segment

SCENES = [*dict.fromkeys(("cardan-circles", "jaanimets-11", "kinytskyi", "roller-cam", *packaged_names()[::4]))]
POSES = 12  # of a turn
FAR = 1e9  # mm
NEAR = 0.0101  # mm: both pictures are rounded to hundredths
LOOK = ("fill", "stroke", "stroke-width", "stroke-dasharray", "data-vector", "font-size", "font-weight",
        "text-anchor")  # fmt: skip
STILL = "layer-paper", "layer-border", "layer-text", "layer-machine"
NUMBERS = {"circle": ("cx", "cy", "r"), "polyline": ("points",), "polygon": ("points",), "path": ("d",),
           "g": ("data-from", "data-to"), "text": ("x", "y")}  # fmt: skip
READ = """svg => [...svg.querySelectorAll('g.step, g[class^="layer-"]')].map(group => [
  group.dataset.step ?? group.getAttribute('class'),
  [...group.querySelectorAll('polyline, polygon, path, circle, text, g.vector')]
    .filter(node => !node.closest('[display=none]')).map(node => [node.localName,
      Object.fromEntries([...node.attributes].map(one => [one.name, one.value])),
      node.localName === 'text' ? node.innerHTML.replace(/ xmlns="[^"]*"/g, '') : '',
      node.closest('.vector') !== null && node.localName !== 'g', node.parentNode !== group,
      (node.closest('[transform]')?.getAttribute('transform') ?? '0 0').match(/-?[\\d.]+/g).map(Number)])])"""

Stroke = tuple[str, str, tuple[float, ...]]  # what it is, how it looks, where it lies
Strokes = dict[str, list[Stroke]]


class Stage:
    """A scene's sheet in a browser, drawn anew."""

    def __init__(self, scene: gp.Scene, browser: Any):
        self.drawing = gp.construct(scene)
        composed = compose(self.drawing, protocol="none")
        self.composition = replace(composed, plans=replace(composed.plans, unfolded=True))  # pages tell each movement
        drawn = (item for picture in self.composition.pictures.values() for item in picture.items)  # without details
        self.sheet = sheet(self.composition, [*frame_items(self.composition), *captions(self.composition), *drawn],
                           CONSTRUCTION)
        self.page, self.complaints = browser.new_page(viewport={"width": 1400, "height": 1000}), list[str]()
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))
        self.page.on("console", lambda message: self.complaints.append(message.text))
        text = svg(self.sheet)
        drawn = PictureData(self.composition).picture_in(self.composition.plans.tongue)
        captions_told = captions_by_step(self.composition, plans_sheet(self.composition))
        data = json.dumps({"programs": [drawn], "captions": captions_told})
        self.page.set_content(f"<!DOCTYPE html><body>{text[text.index('<svg'):]}<script>{scripts()}</script><script>"
                              f"const svg = document.querySelector('svg'), data = {data};</script></body>")
        self.own = self.read()
        self.page.evaluate("window.drawn = new Picture(svg, data)")

    def read(self) -> list[Any]:
        """Every group of the picture with what can be seen in it."""
        found: list[Any] = self.page.evaluate(f"({READ})(svg)")
        return found

    def draw(self, drawing: Construction, points: Mapping[str, complex], guides: Mapping[str, complex]) -> list[Any]:
        """The picture in a pose, read."""
        values = [[float(part) for part in value] for value in drawing.values]
        told = ({name: [z.real, z.imag] for name, z in places.items()} for places in (points, guides))
        self.page.evaluate("pose => drawn.draw(0, ...pose)", [values, *told])
        return self.read()

    def given(self) -> list[Any]:
        """The picture in the given pose."""
        points = {name: complex(*map(float, place)) for name, place in self.drawing.scene.points.items()}
        return self.draw(self.drawing, points, {})

    @cached_property
    def poses(self) -> list[tuple[Construction, dict[str, complex], dict[str, complex]]]:
        """Poses of the turn that are drawn by the same steps."""
        try:
            turn = follow(self.drawing.scene, POSES)
        except GraphplanError:
            return []
        found = []
        for k in range(1, len(turn.travel)):
            points, guides = ({name: complex(z[k]) for name, z in told.items()} for told in (turn.points, turn.guides))
            finite = all(map(cmath.isfinite, points.values()))
            if finite and (drawing := construction_in_pose(self.drawing, points, guides)):
                found.append((drawing, points, guides))
        return found

    def plates(self, drawing: Construction) -> Plates:
        """A pose as Python draws it in the windows that the picture has."""
        windows = self.page.evaluate("drawn.windows.map(view => [view.origin, view.scale])")
        views = {name: replace(view, origin=tuple(origin), scale=scale) for (name, view), (origin, scale)
                 in zip(self.composition.views.items(), windows, strict=True)}  # fmt: skip
        return Plates(Plans(drawing, unfolded=True), views, self.composition.arrangement.letters)

    def letters(self) -> list[dict[str, Rect]]:
        """The letters of each plan, and what they cover."""
        found = self.page.evaluate("drawn.sheet.letters.map(letters => letters.map(one => [one.id, ...one.box]))")
        return [{name: Rect(*box) for name, *box in letters} for letters in found]

    def expected(self, drawing: Construction) -> Strokes:
        """What Python draws of the steps in a pose, but of lines to where millimetres are lost in rounding."""
        found: dict[str, list[Item]] = {}
        for plate in self.plates(drawing):
            for drawn in plate.steps:
                if drawn.index in plate.stretches and any(math.hypot(*mark.spot) > FAR for mark in plate.marks(drawn)):
                    continue
                items: list[Item] = [stroke.item for stroke in plate.strokes(drawn)]
                items += [arc.item for arc in plate.arcs(drawn)]
                if pen := plate.dot(drawn):
                    items.append(Circle(pen, LAYER, drawn.index, drawn.spot, plate.dot_radius(drawn)))
                found.setdefault(str(drawn.number), []).extend(items)
            for vector in plate.vectors:
                found.setdefault(str(vector.of.number), []).append(vector.item)
        return {key: [_stroke(node.tag, node.attrib, "") for node in ink_group(self.sheet, 0, items).get_xml()
                      if node.tag in NUMBERS] for key, items in found.items()}  # fmt: skip


def _stroke(tag: str, attributes: Mapping[str, str], text: str, shift: Sequence[float] = (0.0, 0.0)) -> Stroke:
    """One element that is shifted; which half of a circle is the larger is nothing to tell."""
    parts = " ".join(attributes.get(name, "") for name in NUMBERS[tag])
    numbers = [float(part) for part in parts.replace(",", " ").replace("M", "").replace("A", "").split()]
    numbers = [part + shift[i % 2] * (tag != "circle" or i < 2) for i, part in enumerate(numbers)]
    look = " ".join(attributes.get(name, "") for name in LOOK)
    return tag, look + text, tuple(numbers[:4] + numbers[7:] if tag == "path" else numbers)


def strokes(groups: Sequence[Any], whole: bool) -> Strokes:
    """Everything that is seen, or the strokes, arcs, dots and vectors of steps alone."""
    return {key: [_stroke(tag, attributes, text, shift) for tag, attributes, text, of_vector, nested, shift in nodes
                  if whole or not (of_vector or nested or tag == "text")]
            for key, nodes in groups if whole or not key.startswith("layer-")}  # fmt: skip


def different(one: Strokes, other: Strokes) -> list[tuple[str, str, Stroke]]:
    """What one has and the other has not."""
    found = []
    for key in sorted({*one, *other}):
        left = list(other.get(key, ()))
        for stroke in one.get(key, ()):
            twin = next((one for one in left if _alike(stroke, one)), None)
            if twin is None:
                found.append((key, "lacks", stroke))
            else:
                left.remove(twin)
        found += [(key, "has", stroke) for stroke in left]
    return found


def _alike(one: Stroke, other: Stroke) -> bool:
    return one[:2] == other[:2] and len(one[2]) == len(other[2]) and \
        all(abs(p - q) <= NEAR for p, q in zip(one[2], other[2], strict=True))


def whole(groups: Strokes, panels: Mapping[str, Rect], height: float) -> Strokes:
    """What no panel cuts off: the one picture cuts strokes, the other shows a part of them."""

    def kept(key: str, stroke: Stroke) -> bool:
        tag, _, numbers = stroke
        if tag not in ("polyline", "polygon", "path") or (not key.startswith("layer-") and len(numbers) == 4):
            return True
        ends = (*numbers[:2], *numbers[4:]) if tag == "path" else numbers
        spots = [(x, height - y) for x, y in zip(ends[::2], ends[1::2], strict=True)]
        return all(panels.get(key, panels["0"]).holds(spot, -0.02) for spot in spots)

    return {key: [stroke for stroke in strokes if kept(key, stroke)] for key, strokes in groups.items()}


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """A browser without a window."""
    with chromium() as running:
        yield running


@pytest.fixture(scope="module", params=SCENES)
def stage(request: pytest.FixtureRequest, browser: Any) -> Iterator[Stage]:
    """A scene on its sheet; its page may say nothing."""
    found = Stage(gp.load(request.param), browser)
    yield found
    found.page.close()
    assert found.complaints == []


def test_in_the_given_pose_it_is_the_sheet(stage: Stage) -> None:
    """The strokes, arcs, dots, vectors, symbols and letters of the sheet stand where they stood, also after a turn."""
    panels = {str(drawn.number): drawn.view.rect for drawn in stage.composition.plates.steps}
    own = whole(strokes([group for group in stage.own if group[0] not in STILL], True), panels, stage.sheet.height)
    for pose in (None, *islice(stage.poses, 1)):
        if pose:
            stage.draw(*pose)
        drawn = [group for group in stage.given() if group[0] not in STILL]
        assert different(own, whole(strokes(drawn, True), panels, stage.sheet.height)) == []


def test_in_any_pose_its_strokes_are_those_that_python_draws(stage: Stage) -> None:
    """Strokes, arcs, dots and vectors of the steps lie as far apart as rounding makes them."""
    for pose in stage.poses:
        drawn, expected = strokes(stage.draw(*pose), False), stage.expected(pose[0])
        assert different(expected, {key: drawn.get(key, []) for key in expected}) == []


def test_letters_stand_as_on_a_sheet_of_the_pose(stage: Stage) -> None:
    """The letters are those that Python writes; none stand on each other, and lines of the steps go through as few."""
    here, there, count = 0, 0, 0
    for drawing, *places in stage.poses[::3]:
        stage.draw(drawing, *places)
        stage.page.evaluate("drawn.settle()")
        for plate, letters in zip(stage.plates(drawing), stage.letters(), strict=True):
            own = letter_plate(plate)
            written = {f"{plate.panel}|{'' if wish.step is None else wish.step}|{wish.label}": Rect(*place.boxes)
                       for wish, place in own.letters.places if wish.layer != ARMS}  # on sheets alone
            assert letters.keys() == written.keys()
            assert not any(one.meets(other) for one, other in combinations(letters.values(), 2))
            lines = [ends for chain, _ in thin(plate.items()) for ends in pairwise(chain)]
            crossed = [sum(any(clip_segment(box, *ends) for ends in lines) for box in boxes.values())
                       for boxes in (letters, written)]  # fmt: skip
            here, there, count = here + crossed[0], there + crossed[1], count + len(letters)
    assert here <= there + 0.02 * count


SPRUNG = """
[points]
O = [0, 0]
A = [20, 110]
B = [135, 225]
C = [310, 0]
F = [360, 260]
[links]
1 = "O A"
2 = "A B"
3 = "B C"
frame = "O C F"
[[drive]]
link = "1"
omega = 10
[[springs]]
ends = ["B", "F"]
on = ["3", "frame"]
stiffness = 2
free = 40
[balance]
link = "1"
"""


def test_springs_follow_their_ends(browser: Any) -> None:
    """A spring is the sheet's zigzag in the given pose, and in another has as many coils between its ends."""
    sprung = Stage(gp.parse(SPRUNG), browser)
    own, given = ({group[0]: group[1] for group in groups}["layer-machine"] for groups in (sprung.own, sprung.given()))
    assert [float(x) for x in given[0][1]["points"].replace(",", " ").split()] == pytest.approx(
        [float(x) for x in own[0][1]["points"].replace(",", " ").split()], abs=NEAR)
    moved = {group[0]: group[1] for group in sprung.draw(*sprung.poses[3])}["layer-machine"]
    assert len(moved[0][1]["points"].split()) == len(own[0][1]["points"].split())
    sprung.page.close()
