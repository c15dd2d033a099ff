"""The GeoGebra export: read back, every mark is where the program has it, also when a point is dragged."""

from __future__ import annotations

import cmath
import io
import math
import re
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from dragged_linkages import DraggedLinkage
from each import each
from geogebra_program import GeoGebra
from geogebra_reader import COMMANDS, Ray, Round, opened, read
from objects import NAMES, PLACES, Place, drafted_plates, gap, loose, programs

from graphplan.accuracy.reach import ReachablePoses, best_construction, corrected_values
from graphplan.cycle.relations import relations
from graphplan.cycle.turn import points_under_slides
from graphplan.kernel.kinds import POINT
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.kernel.program import evaluate
from graphplan.mechanism.travel import paces
from graphplan.output.exports.geogebra import BOX, HIGH, _GeoGebraWriter, geogebra
from graphplan.output.exports.ggb_commands import labels
from graphplan.sheet.cycle_frames import inputs_in_pose
from graphplan.sheet.plates.pens import BLUE
from graphplan.sheet.plates.plate import Plates

SCENES = [("rosenauer-basic", False), ("kinytskyi", False), ("jaanimets-10", False), ("walschaerts-loaded", False),
          ("four-bar", True), ("gear-linkage", False), ("roller-cam", False)]


def coordinates(value: object) -> list[float]:
    """A value of the reader by what stands in a formula."""
    match value:
        case Ray(at, along):
            return [at.real, at.imag, along.real, along.imag]
        case Round(at, radius):
            return [at.real, at.imag, radius]
        case complex():
            return [value.real, value.imag]
    return [float(value)]  # type: ignore[arg-type]


@PLACES
@each("name", NAMES)
def test_every_operation(name: str, place: Place) -> None:
    """Every operation of the table gives what its rule gives, wherever its operands lie."""
    for program, values in programs(name):
        plates = loose(program, values, place)
        found, called = read(opened(geogebra(plates))), labels(plates)
        for mark in plates.all_marks:
            assert gap(mark, coordinates(found[called[mark]])) < 1e-9


class Drag:
    """A packaged scene on paper, dragged: what GeoGebra is told, and where the marks are then."""

    def __init__(self, name: str, strict: bool = False):
        self.given, self.paper, _ = drafted_plates(name, strict)
        self.plates = self.paper
        self.drawing, self.wrong = best_construction(self.given)
        if self.drawing is not self.given:
            self.plates = Plates(replace(self.plates.plans, drawing=self.drawing), self.plates.views)
        self.scene, self.view, self.called = self.given.scene, next(iter(self.plates)).view, labels(self.plates)
        found = relations(self.scene, self.view)
        assert found is not None
        self.relations, self.linkage = found, DraggedLinkage(found.scene)

    def some(self, rng: Random, far: float) -> tuple[dict[str, complex], list[float]]:
        """A pin somewhere near and the drives where the first one goes."""
        scene, pins, travels = self.scene, dict[str, complex](), list[float]()
        if self.relations.free and rng.random() < 0.7:
            name = rng.choice(self.relations.free)
            off = complex(rng.uniform(-far, far), rng.uniform(-far, far)) * scene.extent
            pins[name] = self.linkage.places[name] + off
        if scene.drives and not scene.motions:
            travel = rng.uniform(*self.relations.limits) / (self.view.scale if scene.drives[0].slides else 1.0)
            travels = [pace * travel for pace in paces(scene)]
        return pins, travels or [rng.uniform(0.0, 0.3) for _ in scene.drives]

    def told(self, pins: Mapping[str, complex], travels: Sequence[float]) -> dict[str, Any]:
        """Free points, in mm, and sliders, by label."""
        marks = {drawn.name: self.called[drawn] for drawn in self.plates.pose.values()}
        where = {name: pins.get(name, self.linkage.places[name]) for name in self.relations.free}
        sliders = {f"drive_{{{k + 1}}}": travel if drive.slides else math.degrees(travel)
                   for k, (travel, drive) in enumerate(zip(travels, self.scene.drives, strict=True))}
        return {marks[name]: complex(*self.view((z.real, z.imag))) for name, z in where.items()} | sliders

    def truth(self, pins: Mapping[str, complex], travels: Sequence[float]) -> dict[str, complex] | None:
        """Where all points are in mm, by label, what is wanted by the rules; nan where a form cannot be drawn.

        None where the linkage does not come there.
        """
        points = self.linkage.dragged(pins, travels)
        if points is None:
            return None
        points |= {name: points[at] for name, at in points_under_slides(self.relations.scene).items()}
        guides = self.linkage.guides(pins, travels)
        one = ReachablePoses(*({name: np.array([z]) for name, z in some.items()} for some in (points, guides)))
        values = corrected_values(self.drawing, one, self.wrong)
        found = {}
        for mark in self.plates.all_marks:
            if mark.kind == POINT:
                z = points[mark.name] if mark.index < 0 else complex(*(float(np.ravel(part)[0]) for part
                                                                       in values[mark.index][:2]))
                found[self.called[mark]] = complex(*mark.view((z.real, z.imag)))
        rules = self.drawing.program
        true = evaluate(rules, Arrays(), inputs_in_pose(rules, one.points, one.guides))
        for ours, theirs in zip(self.drawing.drawn.wanted, rules.wanted, strict=True):
            if rules.steps[theirs].op.gives == POINT and math.isfinite(x := float(np.ravel(true[theirs][0])[0])):
                mark = self.plates.steps[ours]
                found[self.called[mark]] = complex(*mark.view((x, float(np.ravel(true[theirs][1])[0]))))
        return found

    def gap(self, found: Mapping[str, Any], truth: Mapping[str, complex]) -> float:
        """How far points lie from where they should, beside the size of the paper or how far off it they are."""
        wide = self.plates.box.width
        gaps = [abs(found[label] - z) / max(wide, abs(z)) for label, z in truth.items() if not cmath.isnan(z)]
        return math.inf if any(map(math.isnan, gaps)) else max(gaps)


@pytest.mark.parametrize(("scene", "strict"), SCENES)
def test_the_mechanism_moves(scene: str, strict: bool) -> None:
    """Every point is where the construction has it: in the given pose, and where pins and sliders are dragged to."""
    drag, rng = Drag(scene, strict), Random(scene)
    document = opened(geogebra(drag.paper))
    drags = [({}, [0.0] * len(drag.scene.drives)), *(drag.some(rng, 0.03) for _ in range(4))]
    led = 0
    for pins, travels in drags:
        truth = drag.truth(pins, travels)
        if truth is not None:
            led += 1
            assert drag.gap(read(document, drag.told(pins, travels)), truth) < 1e-6
    assert led > 2


def test_a_handle_turns_the_drive() -> None:
    """A handle that is dragged around its orbit adds its turn to the slider's, and stays on the crank pin."""
    drag = Drag("four-bar")
    document, turn = opened(geogebra(drag.paper)), cmath.exp(1j * math.radians(25))
    O, A = (complex(*drag.plates.pose[name].spot) for name in "OA")
    slid = read(document, {"drive_{1}": 30.0})
    begun = next(z for label, z in slid.items() if label.startswith("pin_"))
    assert abs(begun - slid["A"]) < 1e-9
    found = read(document, {"drive_{1}": 30.0, "handle_{1}": O + (begun - O) * turn})
    assert abs(found["A"] - (O + (A - O) * cmath.exp(1j * math.radians(55)))) < 1e-9


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Iterator[GeoGebra]:
    with GeoGebra(tmp_path_factory.mktemp("geogebra")) as found:
        yield found


@pytest.mark.parametrize("scene", ["four-bar", "shaper"])
def test_in_geogebra_itself(program: GeoGebra, scene: str, tmp_path: Path) -> None:
    """GeoGebra 4.0 opens the file and has every point where the construction has it, wherever one drags to."""
    drag, rng = Drag(scene), Random(scene)
    program.open(tmp_path / "figure.ggb", geogebra(drag.paper))
    for pins, travels in [({}, [0.0]), *(drag.some(rng, 0.03) for _ in range(3))]:
        truth = drag.truth(pins, travels)
        for label, value in drag.told(pins, travels).items():
            program.tell(*(("drag", label, value.real, value.imag) if isinstance(value, complex)
                           else ("set", label, value)))
        if truth is not None:
            assert drag.gap(program.values(), truth) < 1e-6


def test_what_cannot_be_is_not_there_and_comes_back(program: GeoGebra, tmp_path: Path) -> None:
    """A pin that is dragged too far takes the figure away; dragged back, it is there again."""
    _, plates, _ = drafted_plates("four-bar")
    program.open(tmp_path / "figure.ggb", geogebra(plates))
    before, (x, y) = program.values(), plates.pose["C"].spot
    program.tell("drag", "C", x + 900, y)
    assert math.isnan(program.values()["B"].real)
    program.tell("drag", "C", x, y)
    assert abs(program.values()["B"] - before["B"]) < 1e-9


def test_the_navigation_bar_walks_the_steps(program: GeoGebra, tmp_path: Path) -> None:
    """At the breakpoint of a step its marks are seen with its own sentence, and nothing of later steps."""
    _, plates, _ = drafted_plates("four-bar")
    program.open(tmp_path / "figure.ggb", geogebra(plates))
    called = labels(plates)
    for number in (0, 5, max(mark.number for mark in plates.all_marks)):
        program.tell("step", f"step_{{{number}}}")
        seen = program.seen()
        assert {label for label in seen if label.startswith("step_")} == {f"step_{{{number}}}"}
        later = {called[mark] for mark in plates.all_marks if mark.number > number}
        assert not later & seen


def test_same_bytes() -> None:
    """The same construction is the same file, without a date."""
    _, plates, _ = drafted_plates("four-bar")
    assert geogebra(plates) == geogebra(plates)
    assert zipfile.ZipFile(io.BytesIO(geogebra(plates))).infolist()[0].date_time == (1980, 1, 1, 0, 0, 0)


def test_what_is_seen() -> None:
    """Lettered marks alone have labels; curves are strokes, links bars and plates, vectors have their colours."""
    _, plates, _ = drafted_plates("rosenauer-basic")
    elements = opened(geogebra(plates)).findall("construction/element")
    named = {element.get("label"): element for element in elements}
    shown = {label for label, element in named.items() if element.find("show").get("mark") == "true"}
    assert not [e for e in elements if e.get("type") in ("line", "conic", "numeric") and e.get("label") in shown]
    labelled = {label for label, element in named.items() if element.find("show").get("label") == "true"}
    assert {"K", "v_{a}", "Q", "Q_{1}"} <= labelled
    captions = [e.find("caption") for e in elements if e.get("type") == "segment"]
    letters = {caption.get("val") for caption in captions if caption is not None}
    assert {"β", "γ"} <= letters
    assert {element.get("type") for element in elements} >= {"segment", "polygon", "vector", "conicpart", "text"}
    values = [e for e in elements if e.get("type") == "text" and e.get("label").startswith("value")]
    assert len(values) == len(plates.plans.drawing.arrows)
    blue = [e for e in elements if e.get("type") == "vector" and e.find("objColor").get("b") == str(0x8C)]
    due = _GeoGebraWriter(plates, plates, {}).due.values()
    heads = [one for ones in due for one in ones if getattr(one, "head", 0.0)]
    assert len(blue) == sum(stroke.pen.colour == BLUE for stroke in heads) > 0


def test_the_protocol_speaks() -> None:
    """Every drawn step ends with its sentence, where the navigation bar stops; marks are captioned with theirs."""
    _, plates, _ = drafted_plates("jaanimets-10")
    document = opened(geogebra(plates))
    elements = {e.get("label"): e for e in document.findall("construction/element")}
    texts = {e.get("label"): e.get("exp") for e in document.findall("construction/expression")}
    stops = [label for label, element in elements.items() if element.find("breakpoint") is not None]
    steps = [mark for mark in plates.all_marks if mark.number]
    assert stops == [f"step_{{{number}}}" for number in range(len(steps) + 1)]
    for mark in steps:
        sentence = _GeoGebraWriter(plates, plates, {})._typeset(mark.sentence)
        assert sentence in texts[f"step_{{{mark.number}}}"].replace("”", '"').replace("\n", " ")
        caption = elements[labels(plates)[mark]].find("caption")
        assert caption.get("val") == sentence or elements[labels(plates)[mark]].find("labelMode").get("val") == "3"


def test_check_boxes_for_plans_and_stages() -> None:
    """Each plan and each stage has a check box, by which what is drawn of it is seen."""
    drawing, plates, _ = drafted_plates("four-bar")
    elements = opened(geogebra(plates)).findall("construction/element")
    captions = {e.get("label"): e.find("caption").get("val") for e in elements if e.get("type") == "boolean"}
    writer = _GeoGebraWriter(plates, plates, {})
    assert set(captions.values()) == {*(plate.caption for plate in plates),
                                      *(writer._typeset(str(stage.title)) for stage, _ in drawing.drawn.stages)}
    conditions = " ".join(e.find("condition").get("showObject") for e in elements if e.find("condition") is not None)
    assert all(box in conditions for box in captions)


def test_check_boxes_fit_in_one_column() -> None:
    """Where stages are many, some that follow each other share a box; drawings begin beside the longest caption."""
    _, plates, _ = drafted_plates("walschaerts-loaded")
    writer = _GeoGebraWriter(plates, plates, {})
    writer.document()
    boxes = [e for e in writer.objects.construction.iter("element") if e.get("type") == "boolean"]
    assert max(int(box.find("labelOffset").get("y")) for box in boxes) < HIGH - BOX
    assert len({*writer._stage.values()}) > len(boxes) > len({*writer._stage.values()}) / 4
    assert writer.column > 7 * max(len(box.find("caption").get("val")) for box in boxes)


def test_texts_have_letters() -> None:
    """Names in sentences and captions are set with subscripts and in Greek, of several characters, too."""
    _, plates, _ = drafted_plates("walschaerts-loaded")
    texts = " ".join(e.get("exp") for e in opened(geogebra(plates)).iter("expression") if '"' in e.get("exp"))
    assert "R_{0,10} = " in texts
    assert "γ" in texts
    assert not re.search(r"\w_\w|\bgamma\b", texts)


@pytest.mark.costly
def test_nothing_but_what_old_and_new_readers_know() -> None:
    """Only the commands are used that the reader of the tests knows: all are in GeoGebra 4.0 and its successors."""
    for scene, strict in SCENES:
        for command in opened(geogebra(drafted_plates(scene, strict)[1])).findall("construction/command"):
            assert command.get("name") in COMMANDS


def test_letters_that_mean_something_else() -> None:
    """A mark that is called e, which GeoGebra takes for a number, has another label and shows its letter."""
    _, plates, _ = drafted_plates("rosenauer-basic")
    called = labels(plates)
    e = next(mark for mark in plates.all_marks if mark.name == "e")
    elements = opened(geogebra(plates)).findall("construction/element")
    element = next(element for element in elements if element.get("label") == called[e])
    assert called[e] != "e"
    assert element.find("caption").get("val") == "e"
