"""The GeoGebra export: read back, every mark is where the program has it, also when a point is dragged."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Callable

import pytest
from geogebra_reader import COMMANDS, Ray, Round, opened, read
from objects import NAMES, PLACES, drafted_plates, farthest, gap, loose, moved, programs

from graphplan.kernel.program import Panel
from graphplan.output.exports.geogebra import _GeoGebraWriter, geogebra, labels
from graphplan.sheet.plates.pens import BLUE

SCENES = [("rosenauer-basic", False), ("jaanimets-10", False), ("walschaerts-loaded", False), ("four-bar", True)]


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
@pytest.mark.parametrize("name", NAMES)
def test_every_operation(name: str, place: Callable[[int], Panel]) -> None:
    """Every operation of the table gives what its rule gives, wherever its operands lie."""
    for program, values in programs(name):
        plates = loose(program, values, place)
        found, called = read(opened(geogebra(plates))), labels(plates)
        for mark in plates.drawn:
            assert gap(mark, coordinates(found[called[mark]])) < 1e-9


@pytest.mark.parametrize(("scene", "strict"), SCENES)
def test_marks_and_dragging(scene: str, strict: bool) -> None:
    """Every point is where the program has it: in the pose that is given, and after a point of it is dragged."""
    drawing, plates, _ = drafted_plates(scene, strict)
    document, called = opened(geogebra(plates)), labels(plates)
    free, at, values = moved(drawing, plates)
    for elsewhere, truth in (({}, drawing.values), ({called[free]: complex(*at)}, values)):
        found = read(document, elsewhere)
        spots = {mark: found[called[mark]] for mark in plates.drawn}
        points = {mark: spot for mark, spot in spots.items() if isinstance(spot, complex)}
        assert farthest(plates, points, truth) < 1e-6


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
    blue = [e for e in elements if e.get("type") == "vector" and e.find("objColor").get("b") == str(0x8C)]
    heads = [one for ones in _GeoGebraWriter(plates).due.values() for one in ones if getattr(one, "head", 0.0)]
    assert len(blue) == sum(stroke.pen.colour == BLUE for stroke in heads) > 0


def test_the_protocol_speaks() -> None:
    """Every drawn object is captioned with its sentence, and every plan begins with a breakpoint."""
    _, plates, _ = drafted_plates("jaanimets-10")
    elements = {e.get("label"): e for e in opened(geogebra(plates)).findall("construction/element")}
    for mark, label in labels(plates).items():
        caption = elements[label].find("caption")
        assert caption is not None
        assert caption.get("val") == mark.sentence or elements[label].find("labelMode").get("val") == "3"
        stops = elements[label].find("breakpoint") is not None
        assert stops == (mark in plates.firsts)
    assert len(plates.firsts) == len(plates.plans.panels)


def test_nothing_but_what_old_and_new_readers_know() -> None:
    """Only the commands are used that the reader of the tests knows: all are in GeoGebra 4.0 and its successors."""
    for scene, strict in SCENES:
        for command in opened(geogebra(drafted_plates(scene, strict)[1])).findall("construction/command"):
            assert command.get("name") in COMMANDS


def test_letters_that_mean_something_else() -> None:
    """A mark that is called e, which GeoGebra takes for a number, has another label and shows its letter."""
    _, plates, _ = drafted_plates("rosenauer-basic")
    called = labels(plates)
    e = next(mark for mark in plates.drawn if mark.name == "e")
    elements = opened(geogebra(plates)).findall("construction/element")
    element = next(element for element in elements if element.get("label") == called[e])
    assert called[e] != "e"
    assert element.find("caption").get("val") == "e"
