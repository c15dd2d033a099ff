"""The GeoGebra export: read back, every mark is where the program has it, also when a point is dragged."""

from __future__ import annotations

import io
import zipfile

import pytest
from geogebra_reader import COMMANDS, Ray, Round, opened, read
from objects import NAMES, drafted_figure, farthest, gap, loose, moved, programs

from graphplan.output.exports.geogebra import geogebra, labels

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


@pytest.mark.parametrize("apart", [False, True], ids=["one plan", "several plans"])
@pytest.mark.parametrize("name", NAMES)
def test_every_operation(name: str, apart: bool) -> None:
    """Every operation of the table gives what its rule gives, wherever its operands lie."""
    for program, values in programs(name):
        figure = loose(program, values, apart)
        found, called = read(opened(geogebra(figure))), labels(figure)
        for object in figure.objects:
            assert gap(object, coordinates(found[called[object]])) < 1e-9


@pytest.mark.parametrize(("scene", "strict"), SCENES)
def test_marks_and_dragging(scene: str, strict: bool) -> None:
    """Every point is where the program has it: in the pose that is given, and after a point of it is dragged."""
    drawing, figure, _ = drafted_figure(scene, strict)
    document, called = opened(geogebra(figure)), labels(figure)
    free, at, values = moved(drawing, figure)
    for elsewhere, truth in (({}, drawing.values), ({called[free]: complex(*at)}, values)):
        found = read(document, elsewhere)
        spots = {object: found[called[object]] for object in figure.objects}
        points = {object: spot for object, spot in spots.items() if isinstance(spot, complex)}
        assert farthest(figure, points, truth) < 1e-6


def test_same_bytes() -> None:
    """The same construction is the same file, without a date."""
    _, figure, _ = drafted_figure("four-bar")
    assert geogebra(figure) == geogebra(figure)
    assert zipfile.ZipFile(io.BytesIO(geogebra(figure))).infolist()[0].date_time == (1980, 1, 1, 0, 0, 0)


def test_what_is_seen() -> None:
    """Lettered marks alone have labels; curves are strokes, links bars and plates, vectors have their colours."""
    _, figure, _ = drafted_figure("rosenauer-basic")
    elements = opened(geogebra(figure)).findall("construction/element")
    named = {element.get("label"): element for element in elements}
    shown = {label for label, element in named.items() if element.find("show").get("object") == "true"}
    assert not [e for e in elements if e.get("type") in ("line", "conic", "numeric") and e.get("label") in shown]
    labelled = {label for label, element in named.items() if element.find("show").get("label") == "true"}
    assert {"K", "v_{a}", "Q", "Q_{1}"} <= labelled
    captions = [e.find("caption") for e in elements if e.get("type") == "segment"]
    letters = {caption.get("val") for caption in captions if caption is not None}
    assert {"β", "γ"} <= letters
    assert {element.get("type") for element in elements} >= {"segment", "polygon", "vector", "conicpart", "text"}
    blue = [e for e in elements if e.get("type") == "vector" and e.find("objColor").get("b") == str(0x8C)]
    assert len(blue) == sum(arrow.kind == "velocity" for arrow in figure.arrows)


def test_the_protocol_speaks() -> None:
    """Every drawn object is captioned with its sentence, and every plan begins with a breakpoint."""
    _, figure, _ = drafted_figure("jaanimets-10")
    elements = {e.get("label"): e for e in opened(geogebra(figure)).findall("construction/element")}
    for object, label in labels(figure).items():
        caption = elements[label].find("caption")
        assert caption is not None
        assert caption.get("val") == object.sentence or elements[label].find("labelMode").get("val") == "3"
        stops = elements[label].find("breakpoint") is not None
        assert stops == (object in figure.firsts.values())
    assert len(figure.firsts) == len(figure.plans)


def test_nothing_but_what_old_and_new_readers_know() -> None:
    """Only the commands are used that the reader of the tests knows: all are in GeoGebra 4.0 and its successors."""
    for scene, strict in SCENES:
        for command in opened(geogebra(drafted_figure(scene, strict)[1])).findall("construction/command"):
            assert command.get("name") in COMMANDS


def test_letters_that_mean_something_else() -> None:
    """A mark that is called e, which GeoGebra takes for a number, has another label and shows its letter."""
    _, figure, _ = drafted_figure("rosenauer-basic")
    called = labels(figure)
    e = next(object for object in figure.objects if object.name == "e")
    elements = opened(geogebra(figure)).findall("construction/element")
    element = next(element for element in elements if element.get("label") == called[e])
    assert called[e] != "e"
    assert element.find("caption").get("val") == "e"
