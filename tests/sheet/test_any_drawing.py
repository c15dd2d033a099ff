"""A drawing of no mechanism has its plates, letters and sheet as a construction has."""

from __future__ import annotations

import graphplan as gp
from graphplan.kernel.drawing import Values, record_drawing
from graphplan.kernel.panel import Panel
from graphplan.kernel.program import Board
from graphplan.kernel.stages import Stage
from graphplan.machine.motion.drawing import draw_motion
from graphplan.machine.motion.runs import motion_of_scene
from graphplan.output.svg import svg
from graphplan.phrases import said
from graphplan.sheet.layout.composition import Composer
from graphplan.sheet.layout.layout import layout
from graphplan.sheet.layout.plan_scales import windows
from graphplan.sheet.lettering.letters import letter_plates
from graphplan.sheet.plates.display import Rect, Text
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.plate import Plates


def centroid() -> Values:
    """The centroid of a triangular plate, where two medians meet."""
    board = Board()
    with board.on(Panel("plate"), stage=Stage(said("Centroid"), said("the medians meet in it"))):
        corners = (("A", 0, 0), ("B", 90, 0), ("C", 30, 60))
        A, B, C = (board.given(x=x, y=y, name=name) for name, x, y in corners)
        D, E = board.midpoint(B, C, name="D"), board.midpoint(A, C, name="E")
        S = board.meet(board.line(A, D), board.line(B, E), name="S")
    return record_drawing(board, {"centroid": [S]}).mark_values()


def test_a_plate_s_centroid_is_drawn_lettered_and_told_on_a_sheet() -> None:
    """What was recorded of no mechanism has a sheet: its own plan, all its letters, and its steps in words."""
    values = centroid()
    assert values.values_of_role("centroid") == [(40.0, 20.0)]
    composition = Composer(Plans.of_values(values, gp.load("four-bar")).drawing).compose()
    assert [*composition.views] == ["plate"]
    sheet = layout(composition)
    letters = [item.label for item in sheet.items if isinstance(item, Text) and item.layer == "letters"]
    assert sorted(letters) == ["A", "B", "C", "D", "E", "S"]
    assert sheet.sentences[-1].startswith("Mark S where AD meets BE.")
    assert "The medians meet in it." in svg(sheet)


def test_the_drawing_of_a_motion_is_lettered_as_any_other() -> None:
    """Every named point of a machine's motion has its letter in the window of its plan."""
    scene = gp.load("ozols-13-7")
    motion = draw_motion(motion_of_scene(scene, None, None, False).motion, 12)
    plans = Plans.of_values(motion.values, scene)
    _, views = windows({panel: Rect(0.0, 0.0, 380.0, 270.0) for panel in plans.panels}, plans)
    for plate in letter_plates(Plates(plans, views)).values():
        names = {mark.name for mark in plate.plate.steps if mark.name and plate.plate.is_on_panel(mark)}
        letters = {name for item in plate.letters.items if isinstance(item, Text) for name in item.label.split(",")}
        assert names <= letters
