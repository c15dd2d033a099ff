"""The construction as dependent objects: where they stand, and that every rule can be written out over coordinates."""

from __future__ import annotations

import math

import pytest
from each import each
from objects import (
    MECHANISM,
    NAMES,
    PLACES,
    TWO,
    VIEWS,
    Place,
    apart,
    coordinates,
    drafted_plates,
    gap,
    loose,
    programs,
)

import graphplan as gp
from graphplan.kernel.tape.written import PYTHON
from graphplan.output.exports.formula import formula
from graphplan.output.exports.walk import corners, identifiers
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.layout.layout import layout
from graphplan.sheet.plates.display import Arrow, Polygon, Polyline
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.pens import LINK
from graphplan.sheet.plates.symbols import turn


@each("shared", ["t", ""], ids=lambda shared: "terms by name" if shared else "written in full")
@PLACES
@each("name", NAMES)
def test_every_rule_can_be_written_out(name: str, place: Place, shared: str) -> None:
    """The formula of every operation of the table gives its value in mm, wherever its operands lie."""
    for program, values in programs(name):
        last = loose(program, values, place).steps[-1]
        written = formula(last, [[repr(part) for part in coordinates(arg)] for arg in last.args], PYTHON, shared)
        known = {"sqrt": math.sqrt, "abs": abs, "copysign": math.copysign}
        for term, text in written.terms:
            known[term] = eval(text, known)
        assert gap(last, [eval(text, known) for text in written.results]) < 1e-9
        assert bool(shared) or not written.terms


def test_terms_are_written_once() -> None:
    """A term that is used more than once has a name, and the formula is shorter for it."""
    last = loose(*next(programs("circles_meet")), apart).steps[-1]
    texts = [[f"P{i}{part}" for part, _ in enumerate(coordinates(arg))] for i, arg in enumerate(last.args)]
    long, short = formula(last, texts, PYTHON), formula(last, texts, PYTHON, "t")
    assert 2 * sum(map(len, map(str, short.terms))) < sum(map(len, long.results))


@pytest.mark.parametrize("name", ["jaanimets-10", "rosenauer-basic"])
def test_marks_stand_where_the_sheet_has_them(name: str) -> None:
    """Every vector of the figure begins and ends where the sheet's does, to the hundredth of a millimetre."""
    _, plates, composition = drafted_plates(name)
    on_sheet = {item.label: item for item in layout(composition).items if getattr(item, "head", 0)}
    arrows = [stroke for plate in plates for stroke in plate.vectors if stroke.vector]
    found = {f"{arrow.vector.kind} {arrow.vector.point}": arrow for arrow in arrows}
    common = [label for label in on_sheet if label in found and label.split()[0] in ("velocity", "acceleration")]
    assert common
    for label in common:
        assert math.dist(found[label].start.spot, on_sheet[label].start) < 0.01
        assert math.dist(found[label].end.spot, on_sheet[label].end) < 0.01


@pytest.mark.parametrize("name", ["rosenauer-basic", "jaanimets-10", "slider-crank"])
def test_identifiers_are_safe_and_unique(name: str) -> None:
    """Letters and digits alone, each once, whatever the marks are called; and every operand stands before its use."""
    _, plates, _ = drafted_plates(name)
    ids = identifiers(plates.all_marks)
    assert len(set(ids.values())) == len(ids) == len(plates.all_marks)
    assert all(id.isascii() and id.isalnum() and id[0].isalpha() for id in ids.values())
    seen: set[str] = set()
    for mark in plates.all_marks:
        assert all(ids[arg] in seen for arg in mark.args)
        seen.add(ids[mark])


def test_links_have_points_that_no_step_reads() -> None:
    """A point of a link that the construction does not need is part of the pose all the same."""
    _, plates, _ = drafted_plates("slider-crank")
    assert {point for points in plates.scene.links.values() for point in points} <= set(plates.pose)
    assert set(plates.pose.values()) <= set(plates.all_marks)


@pytest.mark.parametrize("name", ["walschaerts-loaded", "jaanimets-10"])
def test_plates_have_their_inner_points_tied_to_a_corner(name: str) -> None:
    """A link is a bar between its ends or a plate with a convex outline; what lies within a plate has a rib to it."""
    _, plates, composition = drafted_plates(name)
    joints = {point.spot: point.name for point in plates.pose.values()}
    items = list(DrawnMechanism(plates.scene, composition.views[MECHANISM]).items())
    hulls = [item.spots for item in items if isinstance(item, Polygon) and item.layer == "plates"]
    ribs = [item.spots for item in items if isinstance(item, Polyline) and item.pen == LINK and len(item.spots) == 2]
    for hull in hulls:
        assert min(turn(a, b, c) for a, b, c in zip(hull, hull[1:] + hull[:1], hull[2:] + hull[:2], strict=True)) > 0
        tied = {joints[end] for corner, end in ribs if corner in hull}
        assert any({joints[corner] for corner in hull} | tied >= set(points) for points in plates.scene.links.values())
    assert bool(ribs) == bool(hulls) == (name == "walschaerts-loaded")


def test_a_length_is_carried_over_by_the_scales() -> None:
    """The factor between two plans is the ratio of their mm per unit."""
    *_, last = loose(*next(programs("transfer")), apart).steps
    assert (last.panel, last.args[1].panel) == (MECHANISM, TWO)
    assert last.factor(last.args[1]) == VIEWS[MECHANISM].scale / VIEWS[TWO].scale


@pytest.mark.parametrize("name", ["slider-crank", "slotted-link", "jaanimets-10"])
def test_strokes_told_by_marks_are_those_of_the_sheet(name: str) -> None:
    """Every straight stroke of the construction and every vector on the sheet is a part of the way between marks."""
    _, plates, composition = drafted_plates(name)
    sheet = layout(composition)
    on_sheet = [item for item in sheet.items if item.layer in ("construction", "vectors")]
    there = {(item.step, item.spots) for item in on_sheet if isinstance(item, Polyline) and len(item.spots) == 2}
    there |= {(item.step, (item.start, item.end)) for item in on_sheet if isinstance(item, Arrow)}
    strokes = [one for plate in plates for drawn in plate.steps for one in plate.strokes(drawn)]
    strokes += [vector for plate in plates for vector in plate.vectors]
    assert {(stroke.of.index, stroke.ends) for stroke in strokes} == there


@pytest.mark.parametrize("name", ["slider-crank", "slotted-link"])
def test_the_symbols_are_those_of_the_sheet(name: str) -> None:
    """Ground, blocks and the sense of the drive are told as on the sheet: as many strokes, all on its panel."""
    drawing = gp.construct(gp.load(name))
    composition = compose(drawing)
    found, sheet = composition.plates[MECHANISM].mechanism, layout(composition)
    for layer in ("ground", "blocks", "drive"):
        there = [item for item in sheet.items if item.layer == layer]
        assert len(there) == len([item for item in found if item.layer == layer]) > 0
    assert all(sheet.panels["mechanism"].holds(spot) for item in found for spot in corners(item))
