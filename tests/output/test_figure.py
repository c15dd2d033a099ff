"""The construction as dependent objects: where they stand, and that every rule can be written out over coordinates."""

from __future__ import annotations

import math

import pytest
from objects import NAMES, ONE, TWO, coordinates, drafted_figure, gap, objects, programs

import graphplan as gp
from graphplan.output.exports.figure import figure
from graphplan.output.exports.formula import Language, formula, operations
from graphplan.sheet.layout.compose import compose
from graphplan.sheet.layout.layout import layout
from graphplan.sheet.plates.symbols import turn

PYTHON = Language(repr, operations("sqrt({})", "abs({})", "(0.0 if abs({0}) <= {2} * {1} else copysign(1.0, {0}))"))


@pytest.mark.parametrize("shared", ["t", ""], ids=["terms by name", "written in full"])
@pytest.mark.parametrize("apart", [False, True], ids=["one plan", "several plans"])
@pytest.mark.parametrize("name", NAMES)
def test_every_rule_can_be_written_out(name: str, apart: bool, shared: str) -> None:
    """The formula of every operation of the table gives its value in mm, wherever its operands lie."""
    for program, values in programs(name):
        last = objects(program, values, apart)[-1]
        written = formula(last, [[repr(part) for part in coordinates(arg)] for arg in last.args], PYTHON, shared)
        known = {"sqrt": math.sqrt, "abs": abs, "copysign": math.copysign}
        for term, text in written.terms:
            known[term] = eval(text, known)
        assert gap(last, [eval(text, known) for text in written.results]) < 1e-9
        assert bool(shared) or not written.terms


def test_terms_are_written_once() -> None:
    """A term that is used more than once has a name, and the formula is shorter for it."""
    last = objects(*next(programs("circles_meet")), apart=True)[-1]
    texts = [[f"P{i}{part}" for part, _ in enumerate(coordinates(arg))] for i, arg in enumerate(last.args)]
    long, short = formula(last, texts, PYTHON), formula(last, texts, PYTHON, "t")
    assert 2 * sum(map(len, map(str, short.terms))) < sum(map(len, long.results))


@pytest.mark.parametrize("name", ["jaanimets-10", "rosenauer-basic"])
def test_marks_stand_where_the_sheet_has_them(name: str) -> None:
    """Every vector of the figure begins and ends where the sheet's does, to the hundredth of a millimetre."""
    drawing, figure, composition = drafted_figure(name)
    on_sheet = {item.label: item for item in layout(drawing, composition=composition).items if getattr(item, "head", 0)}
    found = {f"{arrow.kind} {arrow.point}": arrow for arrow in figure.arrows}
    common = [label for label in on_sheet if label in found and label.split()[0] in ("velocity", "acceleration")]
    assert common
    for label in common:
        assert math.dist(found[label].start.at, on_sheet[label].start) < 0.01
        assert math.dist(found[label].end.at, on_sheet[label].end) < 0.01


@pytest.mark.parametrize("name", ["rosenauer-basic", "jaanimets-10", "slider-crank"])
def test_identifiers_are_safe_and_unique(name: str) -> None:
    """Letters and digits alone, each once, whatever the marks are called; and every operand stands before its use."""
    _, figure, _ = drafted_figure(name)
    ids = [object.id for object in figure.objects]
    assert len(set(ids)) == len(ids)
    assert all(id.isascii() and id.isalnum() and id[0].isalpha() for id in ids)
    seen: set[str] = set()
    for object in figure.objects:
        assert all(arg.id in seen for arg in object.args)
        seen.add(object.id)


def test_links_have_points_that_no_step_reads() -> None:
    """A point of a link that the construction does not need is part of the pose all the same."""
    _, figure, _ = drafted_figure("slider-crank")
    assert all(point in figure.objects for link in figure.links for point in link.points)


def test_plates_have_their_inner_points_tied_to_a_corner() -> None:
    """A link is a bar between its ends or a plate with a convex outline; what lies within a plate has a rib to it."""
    for name in ("walschaerts-loaded", "jaanimets-10"):
        for link in drafted_figure(name)[1].links:
            corners, inner = [point.at for point in link.corners], [point.at for _, point in link.ribs]
            turns = [turn(a, b, c) for a, b, c in zip(corners, corners[1:] + corners[:1], corners[2:] + corners[:2],
                                                      strict=True)]
            assert len(corners) < 3 or min(turns) > 0
            assert len(corners) < 3 or {*corners, *inner} == {point.at for point in link.points}
    assert [len(link.ribs) for link in drafted_figure("walschaerts-loaded")[1].links if link.ribs]


def test_a_length_is_carried_over_by_the_scales() -> None:
    """The factor between two plans is the ratio of their mm per unit."""
    *_, last = objects(*next(programs("transfer")), apart=True)
    assert (last.plan, last.args[1].plan) == (ONE, TWO)
    assert last.factor(last.args[1]) == ONE.scale / TWO.scale


@pytest.mark.parametrize("name", ["slider-crank", "slotted-link"])
def test_the_symbols_are_those_of_the_sheet(name: str) -> None:
    """Ground, blocks and the sense of the drive are decoration of the figure: as many strokes as on the sheet."""
    drawing = gp.construct(gp.load(name))
    composition = compose(drawing)
    found, sheet = figure(drawing, composition).symbols, layout(drawing, composition=composition)
    for layer in ("ground", "blocks", "drive"):
        there = [item for item in sheet.items if item.layer == layer]
        assert len(there) == len([symbol for symbol in found if symbol.layer == layer]) > 0
    assert all(sheet.panels["mechanism"].holds(spot) for symbol in found for spot in symbol.spots)
