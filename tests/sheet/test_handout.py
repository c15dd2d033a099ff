"""Task and guided sheets: the frame and windows of the solution, nothing constructed, a box for every number."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from itertools import count

import pytest
import shapely
from sheets import SCENES, composition_of, drawing_of, outside, pages_of, solved_of

import graphplan as gp
from graphplan.cycle import follow
from graphplan.errors import Refused
from graphplan.kernel.numbers import Floats
from graphplan.mechanism.papers import SIZES
from graphplan.methods.kinds import KINDS
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.cycle_frames import construction_in_pose, sheets
from graphplan.sheet.frames.frame import MARKS, corner_marks, page_code
from graphplan.sheet.handout import RULING, code, guided_task, solution, task
from graphplan.sheet.layout.composition import Composition, compose
from graphplan.sheet.layout.facts_block import GIVEN
from graphplan.sheet.layout.paper import paginate
from graphplan.sheet.layout.screen import compose_for_screen, with_poses
from graphplan.sheet.lettering.lettering import plain, sentence_runs
from graphplan.sheet.plates.display import Arrow, Circle, Polygon, Polyline, Sheet, Text
from graphplan.sheet.words.rows import Cell, TextRow

LINE = 5.0  # mm: of a page of words
Handout = tuple[Composition, Sheet, list[Sheet], list[Sheet]]


@cache
def handout_of(name: str) -> Handout:
    """The composition of a scene, its solution, its task and its guided version."""
    composition, solved = composition_of(name), solved_of(name)
    return composition, solved, task(composition), guided_task(composition)


def boxes(sheets: list[Sheet], ticks: bool = False) -> list[Polygon]:
    """The empty boxes, those to fill or those to tick."""
    return [item for sheet in sheets for item in sheet.items
            if isinstance(item, Polygon) and item.layer == "blanks" and (item.step is not None) == ticks]


@pytest.mark.parametrize("name", SCENES)
def test_the_first_page_is_that_of_the_solution_and_others_are_a4(name: str) -> None:
    """A drawing on the first page lies over the solution; pages of words fit any printer; nothing leaves the frame."""
    _, solved, *parts = handout_of(name)
    for first, *others in parts:
        assert (first.panels, first.frame) == (solved.panels, solved.frame)
        assert (first.width, first.height) == (solved.width, solved.height)
        assert {(page.width, page.height) for page in others} <= {SIZES["A4"]}
        assert not any(page.panels for page in others)
        assert [item for page in (first, *others) for item in outside(page)] == []


@pytest.mark.parametrize("name", SCENES)
def test_no_page_of_words_is_four_fifths_blank(name: str) -> None:
    """In the columns of each page of words but the last a fifth of the lines at least has letters or boxes."""
    for _, *words in handout_of(name)[2:]:
        for page in words[:-1]:
            texts = [item.box for item in page.items if isinstance(item, Text) and item.layer == "text"]
            filled = [box.bottom for box in texts] + [item.spots[0][1] for item in boxes([page])]
            halves = [x > page.frame.centre[0] for x in (*(box.left for box in texts),
                                                         *(item.spots[0][0] for item in boxes([page])))]
            lines = {(half, int(y // LINE)) for half, y in zip(halves, filled, strict=True)}
            assert len(lines) > 2 * page.frame.height / LINE / 5


@pytest.mark.parametrize("frame", ["iso", "gost"])
def test_a_student_fills_in_name_group_date_and_variant(frame: str) -> None:
    """Every page of the task and the guided version asks who drew it, and names nobody; the solution does."""
    scene = gp.load("slider-crank")
    composition = compose(gp.construct(replace(scene, sheet=replace(scene.sheet, frame=frame))))
    for pages in (task(composition), guided_task(composition)):
        for page in pages:
            told = {plain(item.runs) for item in page.items if isinstance(item, Text)}
            assert {"Name", "Group", "Date", "Variant"} <= told
            assert "graphplan" not in told
    assert "graphplan" in {plain(item.runs) for item in solution(composition)[0].items if isinstance(item, Text)}


@pytest.mark.parametrize(("name", "values"), [
    ("triad-loaded", ["ω1 = 10 rad/s", "P4 = 161.6 N", "M5 = 4 N·m"]), ("five-bar", ["ω1 = 10 rad/s", "ω4 = 10 rad/s"]),
    ("open-chain", ["vK = 80 mm/s", "ω21 = 0.8 rad/s"]),
])
def test_what_drives_and_loads_the_mechanism_is_drawn_with_its_value(name: str, values: list[str]) -> None:
    """Each drive, given motion, force and moment has its value on the panel of the mechanism."""
    composition, _, (page, *_), _ = handout_of(name)
    panel = composition.arrangement.panels[MECHANISM]
    told = {plain(item.runs) for item in page.items if isinstance(item, Text) and panel.holds(item.at)}
    assert set(values) <= told


def test_the_words_of_a_task_state_the_scales_and_where_plans_begin() -> None:
    """Each plan is told with the scale that its caption has, and with its origin."""
    composition, _, pages, _ = handout_of("four-bar")
    told = " ".join(plain(item.runs) for page in pages for item in page.items if isinstance(item, Text))
    scales = composition.scales
    for panel in composition.plans.panels:
        for scale in scales.scale_texts(panel, composition.plans.kinds(panel)):
            assert told.count(plain(sentence_runs(scale))) == 2
    assert "origin a" in told


def test_every_page_bears_its_marks() -> None:
    """Each page of a task and of its guided version has the marks of this sheet and page: pages come apart."""
    composition, _, *parts = handout_of("alt-eight-link")
    codes = [page_code(code(composition), number) for number in (1, 2, 3)]
    assert codes[0] == code(composition)
    assert len(set(codes)) == 3
    for pages in parts:
        for page, own in zip(pages, codes, strict=False):
            marks = corner_marks(page.width, page.height, page.frame, own)
            assert [item for item in page.items if item.layer == MARKS] == marks


def test_every_sheet_has_a_code_of_its_own() -> None:
    """Another scene, other plans or another paper make another code."""
    sheets = [composition_of(name, paper) for name, paper in (("four-bar", None), ("four-bar", "A2"),
                                                              ("slider-crank", None))]
    assert len({code(sheet) for sheet in sheets}) == 3


@pytest.mark.parametrize("name", SCENES)
def test_no_words_cover_each_other(name: str) -> None:
    """No two letterings overlap on any page, and none lies on a box."""
    for page in (page for pages in handout_of(name)[2:] for page in pages):
        texts = [(plain(item.runs), item.box.inset(0.05, 0.05, 0.05, 0.05)) for item in page.items
                 if isinstance(item, Text)]
        clashes = [(one, two) for i, (one, box) in enumerate(texts) for two, other in texts[:i] if box.meets(other)]
        assert clashes == []
        spots = [spot for box in (*boxes([page]), *boxes([page], ticks=True)) for spot in box.spots]
        assert not any(rect.holds(spot) for _, rect in texts for spot in spots)


@pytest.mark.parametrize("name", ["jaanimets-11", "shaper", "geneva"])
def test_no_cross_stands_in_what_is_given(name: str) -> None:
    """The crosses to measure by leave room for it, where it stands on a plan that is still empty."""
    page = handout_of(name)[2][0]
    given = [item.box for item in page.items if isinstance(item, Text) and item.layer == GIVEN]
    crosses = [item for item in page.items if isinstance(item, Polyline) and item.layer == RULING]
    assert len(given) >= 4 <= len(crosses)
    assert not [box for box in given for cross in crosses if any(map(box.holds, cross.spots))]


@pytest.mark.parametrize("name", SCENES)
def test_a_task_shows_the_mechanism_and_where_plans_begin(name: str) -> None:
    """The mechanism is drawn as in the solution, where its lines may break off at letters; of the steps there are only
    the marks where plans begin."""
    _, solved, pages, _ = handout_of(name)
    steps = drawing_of(name).drawn.steps
    begins = {step.index for step in steps[drawing_of(name).drawn.givens :] if step.op.free}
    assert {item.step for page in pages for item in page.items if item.step is not None} == begins
    plates = [item for item in solved.items if item.layer in ("plates", "links", "blocks", "pairs", "ground")]
    lines = shapely.union_all([shapely.LineString(item.spots) for item in pages[0].items if isinstance(item, Polyline)])
    missing = [item for item in set(plates) - set(pages[0].items)
               if not (isinstance(item, Polyline) and lines.buffer(0.01).covers(shapely.LineString(item.spots)))]
    assert not missing


@pytest.mark.parametrize("name", SCENES)
def test_every_reading_has_its_empty_boxes(name: str) -> None:
    """A box for each component and size that the construction gives, on the task sheet and on the guided one."""
    _, _, *parts = handout_of(name)
    drawing = drawing_of(name)
    sizes = {kind: 1 if KINDS[kind].single else 2 if kind == "slide arm" or KINDS[kind].place else 3
             for kind in drawing.kinds}
    numbers = sum(sizes[kind] * len(found) for kind, found in drawing.read(Floats()).items())
    assert numbers
    for pages in parts:
        assert len(boxes(pages)) == numbers


@pytest.mark.parametrize("name", SCENES)
def test_guided_steps_are_all_there_with_a_box_to_tick(name: str) -> None:
    """Each numbered step stands once in the guided version, with one box."""
    drawn, pages = drawing_of(name).drawn, handout_of(name)[3]
    steps = list(range(drawn.givens, len(drawn)))
    assert [box.step for box in boxes(pages, ticks=True)] == steps
    numbers = [plain(item.runs) for page in pages for item in page.items
               if isinstance(item, Text) and item.layer == "text" and item.anchor == "end" and item.step is not None]
    assert numbers == [str(drawn.number(i)) for i in steps]


def test_results_are_not_given_away() -> None:
    """No number of the solution's result table stands on the task sheet."""
    told = {plain(item.runs) for page in handout_of("jaanimets-10")[2] for item in page.items if isinstance(item, Text)}
    results = {plain(item.runs) for page in pages_of("jaanimets-10") for item in page.items
               if isinstance(item, Text) and item.layer == "results" and item.anchor == "end"}
    figures = {text for text in results if text.lstrip("−").replace(".", "").isdigit() and len(text) > 2}
    assert len(figures) > 20
    assert figures & told == set()


def test_words_run_on_over_pages_without_parting_what_keeps_together() -> None:
    """Rows come in order, each once; a heading goes to the next page with the row that it must keep."""
    arrangement = handout_of("four-bar")[0].arrangement
    numbers = count()
    rows = [TextRow((Cell(float(next(numbers)), ()),), keep=1 - i % 2) for i in range(400)]
    pages = list(paginate(rows, arrangement))
    assert len(pages) > 1
    assert [row for page in pages for row, _, _ in page] == rows
    assert all(len(page) % 2 == 0 for page in pages)


def test_what_is_higher_than_a_page_is_refused() -> None:
    """Rows that must stand together and cannot are refused with what to do."""
    rows = [TextRow((), keep=200)] * 201
    with pytest.raises(Refused, match="a larger sheet"):
        list(paginate(rows, handout_of("four-bar")[0].arrangement))


# ---- around the cycle --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["four-bar", "slotted-link", "jaanimets-11"])
def test_a_posed_drawing_reads_what_the_construction_gives_there(name: str) -> None:
    """The drawn steps in another pose give the readings of a construction made for that pose."""
    drawing = drawing_of(name)
    turn = follow(drawing.scene, 36)
    points, guides = ({key: complex(z[1]) for key, z in arrays.items()} for arrays in (turn.points, turn.guides))
    found = construction_in_pose(drawing, points, guides)
    assert found is not None
    fresh = gp.construct(found.scene).read(Floats())
    for kind, values in found.computed.items():
        largest = max(math.hypot(*value) if isinstance(value, tuple) else abs(value) for value in values.values())
        for key, value in values.items():
            assert value == pytest.approx(fresh[kind][key], rel=0, abs=1e-9 * largest)


@cache
def round_of(name: str) -> list[tuple[Sheet, bool]]:
    """Twelve poses of a scene's cycle on one layout."""
    drawing, turn = drawing_of(name), follow(drawing_of(name).scene, 12)
    plans = with_poses(composition_of(name).plans, [drawing], turn.points, turn.guides, {})
    return list(sheets(compose_for_screen(plans), [(drawing, turn.points)], turn.points, turn.guides))


@pytest.mark.parametrize("name", ["slider-crank", "ozols-5-1"])
def test_the_round_keeps_its_layout_and_holds_the_mechanism_and_its_vectors(name: str) -> None:
    """In all poses panels and scales are the same, and all joints and vectors are on their panels."""
    (first, _), *_ = round_of(name)
    for still, drawn in round_of(name):
        assert drawn
        assert (still.scales, still.panels) == (first.scales, first.panels)
        joints = [item.centre for item in still.items if isinstance(item, Circle) and item.layer == "pairs"]
        assert len(joints) == 4
        assert all(map(still.panels[MECHANISM].holds, joints))
        for vector in (item for item in still.items if isinstance(item, Arrow)):
            assert any(rect.holds(vector.start) and rect.holds(vector.end) for rect in still.panels.values())


def test_where_nothing_can_be_drawn_the_mechanism_stands_alone() -> None:
    """A pose for which there is no construction has the mechanism on its sheet, and no step."""
    turn = follow(drawing_of("four-bar").scene, 12)
    layout = compose_for_screen(with_poses(composition_of("four-bar").plans, [], turn.points, turn.guides, {}))
    bare, drawn = list(sheets(layout, [], turn.points, turn.guides))[3]
    assert not drawn
    assert {item.step for item in bare.items} == {None}
    assert [item.layer for item in bare.items if isinstance(item, Circle)].count("pairs") == 5
