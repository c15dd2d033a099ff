"""Paths and positions on the plan of the mechanism: they disturb neither letters nor the judge, nor what students get.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import pytest
import shapely
from command_line import run
from inked_sheet import InkedSheet
from sheets import solution

import graphplan as gp
from graphplan.cycle.motion_curves import traced_motion
from graphplan.marking.submission import read_submission
from graphplan.methods.panels import MECHANISM
from graphplan.output import back_end
from graphplan.output.svg import svg
from graphplan.sheet.handout import task
from graphplan.sheet.layout.composition import Composition, compose
from graphplan.sheet.layout.layout import layout
from graphplan.sheet.plates.display import Circle, Polyline, Text
from graphplan.sheet.plates.traced_motion import LAYER, outline, simplify_chain


@cache
def composed(name: str, curves: tuple[str, ...] = (), positions: int = 0) -> Composition:
    """The sheet of a packaged scene that shows its motion."""
    scene = gp.load(name)
    drawing = gp.construct(replace(scene, sheet=replace(scene.sheet, curves=curves, positions=positions)))
    return compose(drawing, motion=traced_motion(drawing.scene))


@cache
def inked(name: str, curves: tuple[str, ...] = (), positions: int = 0) -> InkedSheet:
    """The same as it is on paper."""
    composition = composed(name, curves, positions)
    return InkedSheet.of(svg(layout(composition)))


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "plough-lift"])
def test_the_motion_leaves_letters_free(name: str) -> None:
    """No path and no position goes through letters, on its own plan or out of it."""
    sheet = inked(name, tuple(gp.load(name).points)[1:2], 8)
    moving = [stroke for stroke in sheet.strokes if stroke.key == f"layer-{LAYER}"]
    assert len(moving) > 8
    assert not [through for through in sheet.lines_through_labels if through[1] == f"layer-{LAYER}"]
    assert all(sheet.panels[MECHANISM].buffer(0.02).covers(stroke.line) for stroke in moving)


def test_positions_move_no_letter() -> None:
    """Faint lines break off at letters, which stand where they stand without them."""
    composition = composed("slider-crank", (), 12)
    still = replace(composition, plans=replace(composition.plans, motion=None))
    told = [[item for item in layout(one).items if isinstance(item, Text)]
            for one in (composition, still)]
    assert told[0] == told[1]


def test_a_path_is_whole_where_that_costs_a_bit() -> None:
    """The coupler curve of a four-bar is whole on paper; at a given scale it is cut off at its panel."""
    free = composed("four-bar", ("M",))
    scene = replace(free.plans.drawing.scene, sheet=replace(free.plans.drawing.scene.sheet, k_s=Fraction(5, 2)))
    given = compose(gp.construct(scene), "A4", motion=free.plans.motion)
    for composition, whole in ((free, True), (given, False)):
        view = composition.views[MECHANISM]
        spots = [view(spot) for path in composition.plans.motion.paths for spot in path.spots]
        assert all(map(view.rect.holds, spots)) == whole


def test_a_path_that_goes_back_on_itself_is_drawn_once() -> None:
    """The end of a rocker goes to and fro on an arc; a curve that comes back another way is whole."""
    path = next(path for path in composed("four-bar", ("B",)).plans.motion.paths)
    assert shapely.LineString(simplify_chain(path.spots)).length < 0.51 * shapely.LineString(path.spots).length
    assert len(simplify_chain([(0, 0), (4, 0), (4, 3), (0, 0)])) == 4


def test_links_are_outlines() -> None:
    """A bar is one line, a plate its hull, a link with all points at one place nothing."""
    assert list(outline([(0, 0), (4, 0), (2, 0)])) == [((0, 0), (4, 0))]
    assert [len(chain) for chain in outline([(0, 0), (4, 0), (0, 3)])] == [4]
    assert not list(outline([(1, 1), (1, 1)]))


def test_ends_are_marked_where_the_motion_stops() -> None:
    """A cylinder's paths have a stroke across each end; the dots on a path are its positions."""
    items = composed("plough-lift", ("T",), 6).plates[MECHANISM].mechanism
    mine = [item for item in items if item.layer == LAYER]
    assert [sum(isinstance(item, kind) for item in mine) for kind in (Polyline, Circle)] == [3, 6]


def test_students_are_not_given_the_motion() -> None:
    """The solution shows what is asked for; the page to draw on does not."""
    composition = composed("four-bar", ("M",), 6)
    solved = solution(composition)
    pages = solved[0], task(composition)[0]
    assert [any(item.layer == LAYER for item in page.items) for page in pages] == [True, False]


@pytest.mark.parametrize(("ending", "package"), [("svg", "svgelements"), ("dxf", "ezdxf")])
def test_the_judge_does_not_see_the_motion(ending: str, package: str, tmp_path: Path) -> None:
    """Paths and positions are no construction: of an own sheet as much is read as without them."""
    pytest.importorskip(package)
    composition, found = composed("four-bar", ("M", "B"), 6), []
    for one in (composition, replace(composition, plans=replace(composition.plans, motion=None))):
        sheet = layout(one)
        text = back_end(ending)(*([sheet] if ending == "svg" else [[sheet], one.plates]))
        file = tmp_path / f"sheet.{ending}"
        file.write_bytes(text if isinstance(text, bytes) else text.encode())
        found.append(len(read_submission(file, [], {}).traces))
    assert found[0] == found[1] > 50


@pytest.mark.parametrize(("arguments", "line"), [
    (("--curves", "M,Z"), "--curves M,Z: there is no point Z; one of A, B, M"),
    (("--curves", "O"), "--curves O: O does not move; one of A, B, M"),
    (("--set", "sheet.positions=0"), "sheet.positions: 0 is not a number of positions; a whole number from 1 to 72"),
])
def test_what_does_not_move_is_refused(arguments: tuple[str, str], line: str,
                                       capsys: pytest.CaptureFixture[str]) -> None:
    """One line on standard error, and exit status 2."""
    assert run("cycle", "four-bar", "--positions", "4", *arguments) == 2
    assert line in capsys.readouterr().err
