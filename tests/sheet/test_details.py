"""Details: what crowds on a plan is enlarged in a window of its own, and lines break off at letters without room."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import pytest
import shapely
from inked_sheet import inked
from sheets import composition_of

import graphplan as gp
from graphplan.marking.files.drawing import LAYERS_NOT_DRAWN
from graphplan.sheet.layout.composition import Composition, compose
from graphplan.sheet.layout.enlargements import DetailRing, EnlargedPlan
from graphplan.sheet.layout.layout import layout, sheet_at_step
from graphplan.sheet.lettering.label_candidates import OUTWARDS, Wish
from graphplan.sheet.lettering.labels import lettering
from graphplan.sheet.lettering.lettering import DROP, name_runs, plain, script_size, sentence_runs, width
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import ENLARGED, Arrow, Circle, Item, Polygon, Polyline, Rect, Text
from graphplan.sheet.plates.plans import bounding_box

CRANK = {
    "points": {"O": [0, 0], "A": [2, 2.2], "B": [402, 0]},
    "links": {"1": "O A", "2": "A B", "3": "B", "frame": "O"},
    "slides": [{"link": "3", "along": "frame", "at": "B", "direction": [1, 0]}],
    "drive": [{"link": "1", "omega": 10}], "find": {"velocity": ["A", "B"], "acceleration": ["B"]},
}  # fmt: skip


@pytest.fixture(scope="module")
def crank() -> Composition:
    """A crank of 3 mm on a rod of 400 mm."""
    return compose(gp.construct(gp.scene(CRANK)), protocol="pages")


def frame_of_detail(composition: Composition) -> Rect:
    """The frame of the only detail."""
    (frame,) = (item for item in layout(composition).items
                if isinstance(item, Polygon) and item.pen == pens.RING and item.layer == ENLARGED)
    return bounding_box(frame.spots)


def test_a_crank_that_its_pins_cover_has_a_detail(crank: Composition) -> None:
    """Its pins are as many times as far apart in the window as the caption says, where the crank is shorter
    than a letter."""
    items, frame = layout(crank).items, frame_of_detail(crank)
    (caption,) = (plain(item.runs) for item in items if isinstance(item, Text) and "Detail" in plain(item.runs))
    pins = [item.centre for item in items if isinstance(item, Circle) and item.pen == pens.PAIR
            and frame.holds(item.centre)]
    on_plan = [crank.views["mechanism"](crank.plans.place(name)) for name in "OA"]
    assert (crank.arrangement.paper, len(pins)) == ("A4", 2)
    assert math.dist(*pins) == pytest.approx(int(caption.split()[2]) * math.dist(*on_plan))


def test_nothing_else_stands_in_the_window_of_a_detail(crank: Composition) -> None:
    """What is drawn on the page keeps off, and what is drawn in the window stays in it."""
    frame = frame_of_detail(crank)
    window = shapely.box(frame.left, frame.bottom, frame.right, frame.top)
    texts = [(item, shapely.box(item.box.left, item.box.bottom, item.box.right, item.box.top))
             for item in layout(crank).items if isinstance(item, Text)]
    there = [(item, box) for item, box in texts if window.intersects(box)]
    assert {"O", "A"} <= {plain(item.runs) for item, _ in there}
    assert all(item.layer == ENLARGED and window.contains(box) for item, box in there)


def test_a_detail_is_drawn_with_its_steps(crank: Composition) -> None:
    """Before a step nothing of it lies in the window; a reader of files takes nothing there for drawn."""
    sheet = layout(crank)
    later, before = ([item for item in one.items if item.layer == ENLARGED and (item.step or 0) > 2]
                     for one in (sheet, sheet_at_step(sheet, 2)))
    assert later
    assert not before
    assert ENLARGED in LAYERS_NOT_DRAWN


def test_letters_that_can_be_read_stand_on_the_plan_too() -> None:
    """Of the letters in a ring those of clear marks stay beside them; the others stand in the detail alone."""
    composition = composition_of("walschaerts-loaded")
    plans = [EnlargedPlan(picture) for picture in composition.pictures.values()]
    plan = max(plans, key=lambda plan: plan.illegible)
    marks, weights = plan.crowd
    ring = DetailRing(tuple(marks[weights.argmax()].tolist()), 6.0, 2, "Z")
    larger = plan.with_detail(ring, Rect(0.0, 0.0, 42.0, 46.0))
    doubtful = {tuple(mark) for mark in marks[weights > 0].tolist()}
    gone = [wish for wish in plan.plain.letters.wishes
            if wish.label not in {letter.label for letter in larger.picture.letters.wishes}]
    assert gone
    assert all(wish.spots[0] in doubtful for wish in gone if not wish.free)
    in_detail = {letter.label for letter in larger.details[0].picture.letters.wishes}
    assert {wish.label for wish in gone if wish.step is not None and not wish.free} <= in_detail


def test_the_points_of_a_mechanism_have_their_letters_on_its_plan() -> None:
    """On A1 E of kinytskyi is told on the plan, too, though the marks about its pin are told in a detail."""
    composition = composition_of("kinytskyi", "A1")
    letters = [item for item in layout(composition).items if isinstance(item, Text)]
    for name in composition.plates.scene.points:
        place = composition.views["mechanism"](composition.plans.place(name))
        assert any(plain(item.runs) == name and math.dist(item.at, place) < 10 for item in letters), name


def test_the_letter_of_a_ring_keeps_a_space_off_others() -> None:
    """It takes that much more room to both sides: Y beside E would read as one."""
    wish = DetailRing((0.0, 0.0), 3.0, 5, "Y").wish
    space = width(sentence_runs(" "), wish.letter_size, bold=True)
    assert wish.extent[0] == pytest.approx(width(sentence_runs("Y"), wish.letter_size, bold=True) + 2 * space)


@pytest.mark.parametrize("name", ["kinytskyi", "walschaerts-loaded"])
def test_lines_end_at_the_edge_of_the_window(name: str) -> None:
    """Vectors and arms of forces too, whose other ends lie far away."""
    for picture in composition_of(name).pictures.values():
        for mark in picture.marks[::3]:
            window = Rect(0.0, 0.0, 52.0, 56.0)
            (detail,) = EnlargedPlan(picture).with_detail(DetailRing(mark, 4.0, 5), window).details
            lines = [item for item in detail.picture.strokes if isinstance(item, Polyline)]
            assert all(window.holds(spot) for line in lines for spot in line.spots)


def test_lines_break_off_at_letters_without_room() -> None:
    """No line or vector runs through letters that found no place beside the lines, nor through their indices."""
    found = dict[bool, int]()
    for picture in composition_of("walschaerts-loaded").pictures.values():
        boxes = [shapely.box(item.box.left, item.box.bottom, item.box.right, item.box.top)
                 for item in picture.letters.hidden_items if isinstance(item, Text)]
        for broken, items in ((False, picture.items), (True, picture.items_off_letters)):
            lines = [shapely.LineString(line) for item in items for line in lines_of(item)]
            count = sum(line.intersects(box) for box in boxes for line in lines)
            found[broken] = found.get(broken, 0) + count
    assert found[False]
    assert not found[True]


def lines_of(item: Item) -> Iterable[Sequence[tuple[float, float]]]:
    """The strokes of a line, or of a vector's shaft."""
    return [item.spots] if isinstance(item, Polyline) else item.shaft if isinstance(item, Arrow) else ()


@pytest.mark.parametrize("name", ["p4", "P8'_1", "v_p8", "pi_6", "C_2", "v_c"])
def test_how_deep_letters_reach_is_known(name: str) -> None:
    """Their ink ends where the box does but for what it leaves empty below, to a tenth of a millimetre."""
    wish = Wish(name_runs(name), ((0.0, 0.0),))
    size = wish.letter_size
    ink = max(DROP * size - inked(run.text, script_size(size))[1] if run.level < 0 else -inked(run.text, size)[1]
              for run in wish.runs if run.level <= 0)
    assert size * wish.depth - wish.slack[1] == pytest.approx(ink, abs=0.1)


def test_letters_nearer_to_another_mark_have_a_leader() -> None:
    """However near they stand, as in the details of random marks."""
    marks = [(10.0 + 4 * math.cos(k), 10.0 + 3 * math.sin(2.3 * k)) for k in range(60)]
    wishes = [Wish(name_runs(f"v_p{k}"), (mark,)) for k, mark in enumerate(marks)]
    letters = lettering(wishes, [], marks, Rect(0.0, 0.0, 30.0, 30.0))
    near = 0
    for wish, place in letters.places:
        left, low, right, top = place.boxes - OUTWARDS * wish.slack
        gaps = [math.dist(mark, (min(max(mark[0], left), right), min(max(mark[1], low), top))) for mark in marks]
        own = gaps[marks.index(wish.spots[0])]
        assert place.led or own <= min(gaps) + 1e-9
        near += place.led and own < 3.4
    assert near
