"""The parts of a sheet one by one: scales, lettering, clipping, paper, symbols, letters."""

from __future__ import annotations

import math
import pickle
from dataclasses import replace
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphplan.kernel.program import Panel
from graphplan.mechanism.model import Slide
from graphplan.methods.panels import MECHANISM, N_PLAN, VELOCITY_PLAN, ForcePlan, JointForce, LeverPlan, list_links
from graphplan.phrases import digits
from graphplan.sheet.layout.scales import Scales, ratio, round_up
from graphplan.sheet.lettering.label_candidates import Wish, candidates
from graphplan.sheet.lettering.labels import place_letters
from graphplan.sheet.lettering.lettering import (
    TextRun,
    name_runs,
    plain,
    sentence_runs,
    tie_equations,
    tie_short_words,
    tie_words,
    width,
    wrap,
)
from graphplan.sheet.plates import pens, symbols
from graphplan.sheet.plates.display import Arrow, Polygon, Polyline, Rect, Text
from graphplan.sheet.plates.view import clip_item, clip_segment
from graphplan.sheet.words.rows import Cell, TextRow, fill

SQUARE = Rect(0, 0, 100, 100)


@given(st.floats(1e-6, 1e9))
def test_scales_are_round(least: float) -> None:
    """A scale is 1, 2, 2.5, 4 or 5 times a power of ten, not below what is needed and not twice it."""
    scale = round_up(least)
    lead = scale / 10 ** math.floor(math.log10(scale) + 1e-9)
    assert least * (1 - 1e-8) <= scale <= 2 * least * (1 + 1e-8)
    assert min(abs(lead - step) for step in (1, 2, 2.5, 4, 5, 10)) < 1e-6


@given(st.floats(1e-4, 1e4), st.sampled_from((1, 2, 5)), st.sampled_from((1, 2, 5)), st.integers(-3, 3))
def test_all_scales_of_a_plan_are_round(least: float, kappa: int, phi: int, power: int) -> None:
    """Lengths, velocities, accelerations and forces on one plan all have round scales, as large as that lets them."""
    lengths = [Fraction(1), kappa * Fraction(10) ** power, kappa**2 * Fraction(10) ** (2 * power), Fraction(phi)]
    scale = round_up(least, lengths)
    assert least * (1 - 1e-8) <= scale <= 10 * least
    assert all(round_up(float(scale / length)) == scale / length for length in lengths)


def test_given_lengths_leave_the_first_scale_round() -> None:
    """Where a scene ties velocities to lengths so that both cannot be round, lengths are."""
    assert round_up(3.0, [Fraction(1), Fraction(22, 7)]) == 4


def test_scales_tie_velocity_and_acceleration_to_the_plan() -> None:
    """k_v = k_s/kappa and k_a = k_s/kappa^2, divided by the multiple of the plan."""
    scales = Scales(5.0, 0.1, "mm", {"N-plan": Fraction(2)})
    assert scales.scale_texts("mechanism", {"velocity"}) == ["k_s = 5 mm/mm", "k_v = 50 mm/s per mm"]
    assert scales.scale_texts("N-plan", {"acceleration"}) == ["k_a = 250 mm/s² per mm"]


def test_the_scale_of_forces_follows_from_phi() -> None:
    """k_F = k_s/phi, divided by the multiple of the plan, in the scene's unit of force."""
    scales = Scales(5.0, 0.1, "mm", {"force plan 1": Fraction(2), "lever": Fraction(1, 2)}, 0.25, "kN")
    assert scales.scale_texts("force plan 1", {"reaction", "part"}) == ["k_F = 10 kN/mm"]
    assert scales.scale_texts("lever", {"velocity", "load", "balance"}) == ["k_v = 100 mm/s per mm", "k_F = 40 kN/mm"]


@pytest.mark.parametrize(("value", "text"), [
    (0.0, "0"), (12345.6, "12350"), (-0.25, "−0.25"), (1e-9, "1·10⁻⁹"), (123456.0, "123500"), (6.02e23, "6.02·10²³"),
])  # fmt: skip
def test_numbers_have_four_digits(value: float, text: str) -> None:
    """Numbers are printed in four significant digits with a true minus and no letter e."""
    assert digits(value) == text


@pytest.mark.parametrize(("k_s", "length", "text"), [(5, "mm", "1 : 5"), (0.5, "mm", "2 : 1"), (0.01, "m", "1 : 10")])
def test_the_title_block_gives_the_ratio(k_s: float, length: str, text: str) -> None:
    """The scale in the title block is a ratio of lengths, whatever the scene's unit."""
    assert ratio(k_s, length) == text


@pytest.mark.parametrize(("name", "runs"), [
    ("v_c", (TextRun("v"), TextRun("c", -1))),
    ("alpha", (TextRun("α"),)),
    ("alpha_3'", (TextRun("α′"), TextRun("3", -1))),
    ("A_1", (TextRun("A"), TextRun("1", -1))),
    ("P_25_1", (TextRun("P"), TextRun("25,1", -1))),
    ("B''", (TextRun("B″"),)),
    ("A2", (TextRun("A2"),)),
])  # fmt: skip
def test_names_are_set_as_in_a_textbook(name: str, runs: tuple[TextRun, ...]) -> None:
    """Subscripts, Greek letters and primes are recognised in a mark's name."""
    assert name_runs(name) == runs


def test_names_run_together_are_told_apart() -> None:
    """In v_qC, the line through v_q and C, only q is a subscript; alpha_1 is no line alpha."""
    assert sentence_runs("Draw v_qC.", ("v_q", "C")) == (TextRun("Draw v"), TextRun("q", -1), TextRun("C."))
    assert sentence_runs("alphabet", ("alpha",)) == (TextRun("alphabet"),)
    assert sentence_runs("alpha_1: on alpha", ("alpha",)) == (TextRun("α"), TextRun("1", -1), TextRun(": on α"))


@pytest.mark.parametrize(("panel", "kinds", "text"), [
    (MECHANISM, set(), "Mechanism plan"),
    (MECHANISM, {"load"}, "Mechanism plan with loads"),
    (MECHANISM, {"load", "velocity"}, "Mechanism plan with orthogonal velocities and loads"),
    (VELOCITY_PLAN, {"velocity"}, "Velocity plan"),
    (ForcePlan.of_links(("1",)), {"balance"}, "Force plan: link 1"),
    (ForcePlan.of_links(("2", "3")), {"load"}, "Force plan: links 2 and 3"),
    (ForcePlan.of_links(("2", "3"), 1), {"load"}, "Force plan with friction: links 2 and 3"),
    (LeverPlan.of_part(), {"load"}, "Zhukovsky's lever"),
    (LeverPlan.of_part(2), {"load"}, "Zhukovsky's lever 2"),
    (LeverPlan.of_part(JointForce("B", "2"), "x"), {"load"}, "Zhukovsky's lever: the force on link 2 at B, along x"),
    (LeverPlan.of_part(JointForce("O", "frame"), "y"), {"load"},
     "Zhukovsky's lever: the force on the frame at O, along y"),
])  # fmt: skip
def test_a_caption_says_what_its_plan_is(panel: Panel, kinds: set[str], text: str) -> None:
    """Each plan is named as a textbook would, with its links, and the mechanism's with what is drawn on it."""
    assert panel.caption(kinds) == text


@pytest.mark.parametrize(("panel", "name"), [
    (MECHANISM, "mechanism"), (N_PLAN.numbered_part(2), "N-plan, part 2"),
    (ForcePlan.of_links(("2", "3")), "force plan 2, 3"),
    (ForcePlan.of_links(("2", "3"), 1), "force plan 2, 3 with friction"),
    (ForcePlan.of_links(("2", "3"), 2), "force plan 2, 3 with friction, round 2"), (LeverPlan.of_part(), "lever"),
    (LeverPlan.of_part(2), "lever 2"), (LeverPlan.of_part(JointForce("O", "frame"), "y"), "lever frame at O, y"),
    (LeverPlan.of_part(Slide("3", "frame", "B", (1, 0)), "M"), "lever 3 along frame, M"),
])  # fmt: skip
def test_a_plan_has_one_public_name(panel: Panel, name: str) -> None:
    """A plan is named in files and options as ever, and stays what it is on its way to another process."""
    assert panel == name
    again = pickle.loads(pickle.dumps(panel))
    assert (again, type(again), again.words, again.caption(())) == (panel, type(panel), panel.words, panel.caption(()))
    assert (again.whole, again.twin) == (panel.whole, panel.twin)


def test_links_with_the_words_of_names_are_no_riddle() -> None:
    """What a link is called changes nothing of what its plans are: nothing is read out of a name."""
    odd = "2 with friction, round 3"
    assert ForcePlan.of_links((odd,)).words == f"force plan of link {odd}"
    assert ForcePlan.of_links((odd,), 1).twin == ForcePlan.of_links((odd,))
    assert LeverPlan.of_part(JointForce("B", "4 along 3"), "x").words == "lever 4 along 3 at B, x"


def test_links_are_listed_shortly() -> None:
    """Links that follow each other are given by the first and the last, also where a plan is spoken of in a step."""
    assert list_links(["4", "5", "6", "7"]) == "links 4 to 7"
    assert list_links(["2", "3", "5"]) == "links 2, 3 and 5"
    assert list_links(["rod", "piston"]) == "links rod and piston"
    assert ForcePlan.of_links(("4", "5", "6")).words == "force plan of links 4 to 6"
    assert (MECHANISM.words, N_PLAN.words) == ("mechanism plan", "N-plan")


@given(st.text(st.characters(codec="latin-1"), max_size=200), st.floats(20, 100))
def test_wrapped_lines_fit(text: str, room: float) -> None:
    """No wrapped line is longer than its room, and no word is lost."""
    lines = wrap(sentence_runs(text), 2.5, room)
    assert all(width(line, 2.5) <= room + 1e-9 for line in lines)
    assert "".join("".join(map(plain, lines)).split()) == "".join(plain(sentence_runs(text)).split())


def test_lines_are_broken_inside_no_word() -> None:
    """Not in a list whose items are longer than a line; nor is a number parted from its unit or its abbreviation."""
    assert [*map(plain, wrap(sentence_runs(tie_words("at once (reaction of the frame)")), 2.5, 25.0))] == [
        "at once (reaction of", "the frame)"]
    room = width(sentence_runs("No. 15, fig."), 2.5)
    assert [*map(plain, wrap(sentence_runs(tie_short_words("No. 15, fig. 2 (0.1 mm)")), 2.5, room))] == [
        "No. 15,", "fig. 2", "(0.1 mm)"]
    assert [*map(plain, wrap(sentence_runs(tie_short_words("with l = 1.05, at N).")), 2.5, room))] == [
        "with", "l = 1.05,", "at N)."]
    room = width(sentence_runs("25.0 = 1.0 mm."), 2.5)
    assert [*map(plain, wrap(sentence_runs(tie_equations("v²/r = 5.0² : 25.0 = 1.0 mm.")), 2.5, room))] == [
        "v²/r = 5.0² :", "25.0 = 1.0 mm."]


@given(*[st.tuples(st.floats(-200, 300), st.floats(-200, 300))] * 2)
def test_clipped_segments_stay_inside(start: tuple[float, float], end: tuple[float, float]) -> None:
    """What is left of a segment lies in the rectangle and on the segment."""
    inside = clip_segment(SQUARE, start, end)
    for t in inside or ():
        assert SQUARE.holds((start[0] + t * (end[0] - start[0]), start[1] + t * (end[1] - start[1])), 1e-6)


def test_a_chain_that_leaves_and_returns_is_drawn_in_pieces() -> None:
    """A stroke that runs out of the panel and back leaves two strokes."""
    chain = Polyline(pens.THIN, "construction", 3, ((50, 50), (150, 50), (150, 60), (50, 60)))
    assert len(list(clip_item(chain, SQUARE))) == 2


def test_columns_fill_one_after_the_other() -> None:
    """Rows run down the first column, then the next; a heading stays with what it heads."""
    rows = [TextRow((Cell(0, (TextRun("text"),)),)) for _ in range(4)]
    heading = TextRow((Cell(0, (TextRun("heading"),)),), keep=1)
    high = 3 * rows[0].height + 0.1
    columns = [Rect(0, 0, 50, high), Rect(60, 0, 110, high)]
    placed_rows = fill([*rows[:2], heading, *rows[2:]], columns)
    assert placed_rows is not None
    assert [x for _, x, _ in placed_rows] == [0, 0, 60, 60, 60]
    assert fill(rows * 2, columns) is None


def test_the_head_of_an_arrow_ends_at_its_tip() -> None:
    """An arrowhead reaches exactly the end of its vector and is slim."""
    tip, left, right = Arrow(pens.THIN, "vectors", 0, (0, 0), (30, 40), 4.0).barbs
    assert tip == (30, 40)
    assert math.dist(left, right) < 4.0 / 2


@pytest.mark.parametrize(("tip", "fills"), [
    (pens.FILLED, [pens.BLUE]), (pens.OPEN, [pens.BLUE] * 2), (pens.WHITE, [pens.BLUE, pens.PAPER])])
def test_heads_are_told_apart_without_colour(tip: str, fills: list[str]) -> None:
    """A head is full, two barbs or white inside; it begins at the tip, and the shaft ends within it."""
    arrow = Arrow(replace(pens.VECTORS["velocity"], tip=tip), "vectors", 0, (0, 0), (30, 40), 4.0)
    figures = list(arrow.figures)
    assert [fill for _, fill in figures] == fills
    assert figures[0][0][0] == (30, 40)
    assert all(math.dist(spot, (30, 40)) < 4.5 for spots, _ in figures for spot in spots)
    (_, end), = arrow.shaft
    assert 0 < math.dist(end, (30, 40)) <= 4.0 + 1e-9


def test_kinds_of_line_have_pens_of_their_own() -> None:
    """Without colour no two of velocity, acceleration, load, reaction, locus, produced and constructed lines agree."""
    kinds = *(pens.VECTORS[kind] for kind in ("velocity", "acceleration", "load", "reaction", "part", "relative")), \
        pens.LOCUS, pens.PRODUCED, pens.THIN
    assert len({(pen.width, pen.dash, pen.tip) for pen in kinds}) == len(kinds)


def test_a_bent_link_is_a_plate_and_a_straight_one_a_bar() -> None:
    """Three points on a line make a bar; off the line they make a tinted triangle."""
    assert symbols.are_collinear([(0, 0), (10, 0), (20, 0.05)])
    assert not symbols.are_collinear([(0, 0), (10, 4), (20, 0)])
    plates = [item for item in symbols.plate([(0, 0), (10, 4), (20, 0), (10, 1)]) if isinstance(item, Polygon)]
    assert set(plates[0].spots) == {(0, 0), (10, 4), (20, 0)}


def test_one_corner_of_a_plate_is_hatched() -> None:
    """The widest corner has strokes at 45 degrees, all inside the plate, for no more than a third of its sides."""
    corners = [(0.0, 0.0), (30.0, 0.0), (12.0, 9.0)]
    sides = list(zip(corners, corners[1:] + corners[:1], strict=True))
    strokes = [item for item in symbols.plate(corners) if isinstance(item, Polyline) and item.pen == pens.HATCH]
    assert len(strokes) > 2
    for (x, y), (u, v) in (stroke.spots for stroke in strokes):
        assert v - y == pytest.approx(u - x)
        for spot in ((x, y), (u, v)):
            assert all(symbols.turn(start, end, spot) >= -1e-9 for start, end in sides)
            assert math.dist(spot, corners[2]) <= math.dist(corners[1], corners[2]) / 3


def test_a_block_is_turned_to_its_guide() -> None:
    """The long sides of a block run along the guide's direction."""
    block = symbols.block((0, 0), (0.6, 0.8))
    assert isinstance(block, Polygon)
    (x, y), (u, v) = block.spots[:2]
    assert math.isclose((u - x) * 0.8, (v - y) * 0.6)


@pytest.mark.costly
def test_letters_in_a_crowd_do_not_overlap() -> None:
    """Thirty letters of marks within a few millimetres all find places of their own, the same every time."""
    marks = [(50 + i % 6, 50 + i // 6) for i in range(30)]
    wishes = [Wish((TextRun(f"M{i}"),), (mark,), label=f"M{i}") for i, mark in enumerate(marks)]
    items = place_letters(wishes, [], marks, SQUARE)
    assert items == place_letters(wishes, [], marks, SQUARE)
    texts = [(item.at, width(item.runs, item.size)) for item in items if isinstance(item, Text)]
    boxes = [Rect(x, y, x + long, y + 1.8) for (x, y), long in texts]
    assert len(boxes) == 30
    assert not any(boxes[i].meets(boxes[j]) for i in range(30) for j in range(i))


def test_a_letter_whose_mark_is_off_the_panel_stands_whole_at_its_edge() -> None:
    """Its one place is as near to the mark as the panel allows, and as large as the letter."""
    wish = Wish((TextRun("A"),), ((130, 50),))
    wide, high = wish.extent
    assert candidates([wish], SQUARE).boxes.tolist() == [pytest.approx([100 - wide, 50, 100, 50 + high])]


def test_a_letter_avoids_the_line_through_its_mark() -> None:
    """A letter beside a line does not stand on it."""
    line = Polyline(pens.THIN, "construction", None, ((0, 50), (100, 50)))
    (text,) = place_letters([Wish((TextRun("A"),), ((50, 50),))], [line], [(50, 50)], SQUARE)
    assert isinstance(text, Text)
    assert text.at[1] > 50 or text.at[1] + 1.8 < 50


@given(st.floats(0, 2 * math.pi), st.tuples(st.floats(0, 400), st.floats(0, 300)))
def test_a_point_on_a_side_is_no_corner(turned: float, at: tuple[float, float]) -> None:
    """The hull of a triangle and the middle of one of its sides is the triangle, wherever it lies."""
    cos, sin = math.cos(turned), math.sin(turned)
    places = [(at[0] + cos * x - sin * y, at[1] + sin * x + cos * y) for x, y in ((-30, 0), (0, 0), (30, 0), (10, 25))]
    assert {*symbols.hull(places)} == {places[0], *places[2:]}
