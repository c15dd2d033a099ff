"""The construction as a GCLC source, read back with the arithmetic of that engine."""

from __future__ import annotations

import math
import re

import pytest
from gcl import Reader
from laid_out import laid_out
from objects import NAMES, coordinates, drafted_figure, farthest, loose, moved, programs

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.mechanism.scene import packaged
from graphplan.output.exports.figure import Object
from graphplan.output.exports.gclc import decimal, gclc


def off(object: Object, found: tuple[float, ...]) -> float:
    """How far an object is read from where it lies, beside its distance from the corner of the paper."""
    there = coordinates(object)
    if object.kind == LINE:
        (a, b, c), (x, y, dx, dy) = found, there
        off, turn = abs(a * x + b * y + c), abs(a * dx + b * dy) / math.hypot(dx, dy)
        return (off / (1.0 + math.hypot(x, y)) + turn) / math.hypot(a, b)
    return math.dist(found, there) / (1.0 + math.hypot(*there))


@pytest.mark.parametrize("name", packaged())
def test_every_mark_is_read_where_it_lies(name: str) -> None:
    """Every point, line, opening and circle of every packaged scene is recovered from the commands alone."""
    _, figure = laid_out(name)
    read = Reader().read(gclc(figure))
    assert max(off(object, read.objects[object.id][1:]) for object in figure.objects) < 1e-6


def test_compasses_alone_are_read_too() -> None:
    """The construction with compasses and straightedge alone, with its marks between plans, is recovered as well."""
    _, figure = laid_out("slider-crank", strict=True)
    read = Reader().read(gclc(figure))
    points = [object for object in figure.objects if object.kind in (POINT, CIRCLE)]
    assert max(off(object, read.objects[object.id][1:]) for object in points) < 1e-6


@pytest.mark.parametrize("name", ["rosenauer-basic", "slider-crank", "kinytskyi"])
def test_a_moved_point_moves_the_construction(name: str) -> None:
    """Another place for one point of the pose gives the construction in that pose, on the same branches."""
    drawing, figure, _ = drafted_figure(name)
    point, at, values = moved(drawing, figure)
    source = re.sub(rf"(?m)^point {point.id} .*$", f"point {point.id} {' '.join(map(decimal, at))}", gclc(figure))
    read = Reader().read(source)
    marks = {object: complex(*read.objects[object.id][1:]) for object in figure.objects if object.kind == POINT}
    assert farthest(figure, marks | {point: complex(*at)}, values) < 1e-6


@pytest.mark.parametrize("apart", [False, True], ids=["one plan", "several plans"])
@pytest.mark.parametrize("name", NAMES)
def test_every_operation_is_translated(name: str, apart: bool) -> None:
    """Each operation of the table becomes commands that give its value, wherever its operands lie."""
    for program, values in programs(name):
        figure = loose(program, values, apart)
        read = Reader().read(gclc(figure))
        assert off(figure.objects[-1], read.objects[figure.objects[-1].id][1:]) < 1e-6


def test_every_step_is_said_with_its_conditions() -> None:
    """Each drawn step stands under its sentence, and under what would make it impossible; the drawing follows."""
    _, figure = laid_out("four-bar")
    source = gclc(figure)
    places = [source.index(f"\n% {object.number}. {object.sentence}\n") for object in figure.steps]
    assert places == sorted(places)
    assert places[-1] < source.index("% drawing: ")
    meet = next(object for object in figure.steps if object.step.op.name == "meet")
    assert f"{meet.sentence}\n% drawable unless two lines that should meet are parallel\nintersec {meet.id}" in source
    assert all(f"% plan: {plan.caption}\n" in source for plan in figure.plans)


def test_what_the_sheet_shows_is_drawn() -> None:
    """Links, vectors and letters are drawn: each link side, each vector, and a letter for each lettered mark."""
    _, figure = laid_out("four-bar")
    source = gclc(figure)
    drawn = Reader().read(source).drawn
    assert {("drawsegment", link.points[0].id, link.points[1].id) for link in figure.links} <= set(drawn)
    assert all(f"call vector {{ {arrow.start.id} {arrow.end.id} }}" in source for arrow in figure.arrows)
    assert {"v_{b}", "M_{1}", r"\beta"} <= {texts[-1] for command, *texts in drawn if command.startswith("printat")}


def test_numbers_have_no_exponents() -> None:
    """The engine loses the sign of an exponent, so there is none; and the same figure gives the same text."""
    _, figure = laid_out("jaanimets-10")
    source = gclc(figure)
    assert decimal(-1.5e-7) == "-0.00000015"
    assert not re.search(r"\d[eE][-+]?\d", re.sub(r"%.*", "", source))
    assert gclc(figure) == source
