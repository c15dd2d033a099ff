"""Sheets of panels: steps as ink on their panel, words beside it or on pages of their own, other formats."""

from __future__ import annotations

import io
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import pytest

from graphplan.kernel.drawing import Drawing, Values
from graphplan.kernel.numbers import Floats
from graphplan.kernel.passes import freeze, put_together
from graphplan.kernel.program import Board, Panel, Program, evaluate
from graphplan.kernel.stages import Stage
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import load
from graphplan.methods.construction import ForceArrow
from graphplan.output.exports.ink_tikz import sheet_tikz
from graphplan.output.panelled import Panelled, Words, pages
from graphplan.output.svg import svg
from graphplan.phrases import Said, said
from graphplan.sheet.lettering.letters import items_with_names
from graphplan.sheet.plates.display import Arrow, Item, Rect, Sheet, Text
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.styled_plate import StyledPlates
from graphplan.sheet.plates.view import View

POLYGON = Panel("polygon", said("polygon"), said("Polygon of forces"))
FORCES = [(30.0, 0.0), (10.0, 25.0), (-35.0, 20.0), (-20.0, -30.0)]


def polygon() -> Program:
    """Forces laid off one after the other, and the line that closes them, in mm."""
    board = Board()
    with board.on(POLYGON, stage=Stage(said("Polygon of forces"), said("the forces one after the other"))):
        corners = [board.begin(plan=POLYGON, name="A")]
        for k, (dx, dy) in enumerate(FORCES, 1):
            corners.append(board.lay_off(corners[-1], dx=dx, dy=dy, name=f"P_{k}"))
        closing = board.line(corners[0], corners[-1])
    return freeze(board, [*corners, closing])


@dataclass(frozen=True)
class PolygonSheet(Panelled):
    """A sheet of one polygon."""

    document = said("Polygon sheet")
    description = said("A polygon of forces.")
    scale = said("1 : 1")

    @cached_property
    def scene(self) -> Scene:
        return load("four-bar")

    @cached_property
    def values(self) -> Values:
        return Drawing(polygon()).mark_values()

    def panels_in(self, room: Rect) -> dict[Panel, Rect]:
        return {POLYGON: room}

    def figure(self, panel: Panel, rect: Rect) -> list[Item]:
        forces = [ForceArrow("load", f"P_{k}", (k - 1, k)) for k in range(1, 5)]
        plans = Plans.of_values(self.values, self.scene, forces)
        return items_with_names(StyledPlates(plans, {panel: View(rect, 2.0, rect.centre)}, self.letters)[panel])

    def given_words(self) -> Iterator[Words]:
        yield said("Forces")
        yield [["P", "x", "y"], *([f"P_{k}", f"{x:g}", f"{y:g}"] for k, (x, y) in enumerate(FORCES, 1))]

    def result_words(self) -> Iterator[Said]:
        yield said("Closing line")


@pytest.fixture(scope="module")
def sheet() -> Sheet:
    """The sheet on the smallest paper."""
    found, = pages(PolygonSheet)
    return found


def test_steps_are_ink_and_words(sheet: Sheet) -> None:
    """Each step has its ink with its number, its vector and its sentence with the length on paper."""
    arrows = [item for item in sheet.items if isinstance(item, Arrow)]
    assert [arrow.label for arrow in arrows] == [f"load P_{k}" for k in range(1, 5)]
    text = svg(sheet)
    assert all(f'data-step="{k}"' in text for k in range(1, 7))
    words = "".join(run.text for item in sheet.items if isinstance(item, Text) for run in item.runs)
    assert "30.0 mm" in words
    assert "Polygon of forces" in words


def test_letters_stand_on_the_panel_and_not_on_each_other(sheet: Sheet) -> None:
    """The letters of the figure are inside their panel, and no two meet."""
    letters = [item for item in sheet.items if isinstance(item, Text) and item.layer == "letters"]
    assert len(letters) == 5
    panel = sheet.panels[POLYGON]
    assert all(panel.holds(corner) for item in letters for corner in item.box.corners)
    assert not any(one.box.meets(other.box) for one, other in combinations(letters, 2))


def test_words_without_room_stand_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where a paper has no room for the steps they follow on another page, and the first says so; no figure is drawn
    for a page of words."""
    figures, draw = list[Panel](), PolygonSheet.figure
    monkeypatch.setattr(PolygonSheet, "figure", lambda sheet, panel, rect: figures.append(panel)
                        or draw(sheet, panel, rect))
    first, second = PolygonSheet("A4").sheet_with_steps_apart()
    assert not second.panels
    assert figures == [POLYGON]
    assert [f"{k}/2" in svg(page) for k, page in ((1, first), (2, second))] == [True, True]


def test_other_formats_have_every_step(sheet: Sheet) -> None:
    """A DXF has a layer for each step, a TikZ picture a comment with its sentence."""
    ezdxf = pytest.importorskip("ezdxf")
    from graphplan.output.dxf import dxf

    document = ezdxf.read(io.StringIO(dxf([sheet]).decode()))
    used = {entity.dxf.layer for entity in document.modelspace()}
    assert {f"STEP {k:03}" for k in range(1, 7)} <= used
    tikz = sheet_tikz(sheet)
    assert all(f"\n% {k}: {sentence}\n" in tikz for k, sentence in enumerate(sheet.sentences, 1))
    assert tikz.count(r"\begin{tikzpicture}") == tikz.count(r"\end{tikzpicture}") == 1


def test_programs_are_put_together() -> None:
    """Two programs one after the other give the marks of both, and letters that are taken get a prime."""
    one = polygon()
    both, places = put_together([one, one])
    values, own = evaluate(both, Floats()), evaluate(one, Floats())
    assert all(values[there] == value for found in places for there, value in zip(found, own, strict=True))
    assert [step.name for step in both.steps if step.name][:1] == ["A"]
    assert {step.name for step in both.steps} >= {"P_1", "P_1'"}
    assert [both.number(place) for place in places[1]] == [len(one) + one.number(step.index) for step in one.steps]
