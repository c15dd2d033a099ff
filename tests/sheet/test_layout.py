"""The sheet of every packaged scene: all on the sheet, nothing on top of each other, vectors that can be measured."""

from __future__ import annotations

from dataclasses import replace

import pytest
from sheets import SCENES, composition_of, drawing_of, outside, pages_of, sheet_of, spots

import graphplan as gp
from graphplan.errors import Refused
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.layout.layout import captions, layout, pages
from graphplan.sheet.lettering.lettering import CAPS, plain
from graphplan.sheet.plates.display import ENLARGED, Arrow, Text


@pytest.mark.parametrize("name", SCENES)
def test_nothing_leaves_the_frame(name: str) -> None:
    """Every stroke, symbol and letter lies inside the frame."""
    assert outside(sheet_of(name)) == []


@pytest.mark.parametrize("name", SCENES)
def test_panels_are_disjoint(name: str) -> None:
    """No two panels overlap, and each lies inside the frame."""
    sheet = sheet_of(name)
    panels = list(sheet.panels.values())
    assert not any(one.meets(other) for i, one in enumerate(panels) for other in panels[:i])
    assert all(sheet.frame.holds(corner, 0.01) for p in panels for corner in ((p.left, p.bottom), (p.right, p.top)))


@pytest.mark.parametrize("name", ["jaanimets-10", "ozols-13-6"])
def test_scales_are_no_larger_than_the_headings_over_them(name: str) -> None:
    """A plan whose heading has only room in small letters has its scales in those, too."""
    composition, larger = composition_of(name), list[str]()
    for rect in composition.arrangement.panels.values():
        lines = [line for line in captions(composition) if rect.holds(line.at, 0.01)]
        most = max(line.size for line in lines if line.bold)
        larger += [plain(line.runs) for line in lines if line.size > most]
    assert larger == []


@pytest.mark.parametrize("name", SCENES)
def test_no_two_letterings_overlap(name: str) -> None:
    """No letter covers another, on the plans and in the columns."""
    texts = [item for item in sheet_of(name).items if isinstance(item, Text)]
    boxes = [text.box.inset(0.05, 0.05, 0.05, 0.05) for text in texts]
    clashes = [(plain(texts[i].runs), plain(texts[j].runs)) for i in range(len(boxes)) for j in range(i)
               if boxes[i].meets(boxes[j])]  # fmt: skip
    assert clashes == []


@pytest.mark.parametrize("name", SCENES)
def test_every_mark_of_the_mechanism_has_its_letter(name: str) -> None:
    """Each point of the scene is lettered, and each link numbered, once on the plan or in a detail."""
    texts, scene = [item for item in sheet_of(name).items if isinstance(item, Text) and item.label], gp.load(name)
    on_plan, in_details = ([item.label for item in texts if (item.layer == ENLARGED) == there]
                           for there in (False, True))
    lettered, links = {*scene.points}, {f"link {link}" for link in scene.moving}
    for labels in (on_plan, in_details):
        points = [name for label in labels for name in label.split(",") if name in scene.points]
        numbered = [label for label in labels if label.startswith("link ")]
        assert [len({*points}), len({*numbered})] == [len(points), len(numbered)]
        lettered, links = lettered - {*points}, links - {*numbered}
    assert not lettered | links


@pytest.mark.parametrize("name", SCENES)
def test_the_step_list_is_complete_and_legible(name: str) -> None:
    """Every step is listed on the sheet or a page beside it, alone or in its compound, in capitals of 1.8 mm."""
    drawn = drawing_of(name).drawn
    texts = [item for page in pages_of(name) for item in page.items if isinstance(item, Text) and item.layer == "text"]
    steps, listed = range(drawn.givens, len(drawn)), [text for text in texts if text.step is not None]
    assert min(text.size for text in listed) * CAPS >= 1.8
    ranges = [[int(number) for number in plain(text.runs).split("–")] for text in listed if text.anchor == "end"]
    told = [number for ends in ranges for number in range(ends[0], ends[-1] + 1)]
    assert sorted(told) == [drawn.number(i) for i in steps]


@pytest.mark.parametrize("name", SCENES[::2])  # the others are drawn so by test_frames.py
def test_the_polar_plans_have_panels_of_their_own(name: str) -> None:
    """A polar construction shows the mechanism, its velocity plan and its acceleration plan side by side."""
    sheet = sheet_of(name, plan="polar")
    asked = {"acceleration plan"} if "acceleration" in drawing_of(name, plan="polar").method else set()
    assert {"mechanism", "velocity plan"} | asked <= set(sheet.panels)
    assert outside(sheet) == []


@pytest.mark.parametrize("name", SCENES)
def test_strokes_stay_on_their_panels(name: str) -> None:
    """Nothing that is constructed leaves its panel, even where a mark lies far outside."""
    sheet = sheet_of(name)
    for item in sheet.items:
        if item.step is not None and item.layer != "text":
            assert any(all(rect.holds(spot, 0.01) for spot in spots(item)) for rect in sheet.panels.values())


def test_a_given_vector_that_is_not_asked_for_stays_on_its_plan() -> None:
    """The velocity of the crank, drawn where only another point's is asked for, does not run off the sheet."""
    scene = gp.load("triad")
    asked = replace(scene, find=replace(scene.find, velocity=("E",), acceleration=()))
    sheet = layout(compose(gp.construct(asked, plan="polar")))
    arrows = [item for item in sheet.items if isinstance(item, Arrow) and item.label in ("", "velocity E")]
    assert len(arrows) == 2
    assert all(sheet.panels["velocity plan"].holds(spot) for arrow in arrows for spot in (arrow.start, arrow.end))


def test_a_named_paper_is_used() -> None:
    """The sheet asked for is the sheet drawn, upright where that is asked for."""
    assert (sheet_of("four-bar", "A2").width, sheet_of("four-bar", "A2").height) == (594, 420)
    assert (sheet_of("four-bar", "A3 portrait").width, sheet_of("four-bar", "A3 portrait").height) == (297, 420)


@pytest.mark.parametrize(("paper", "why"), [("A9", "unknown sheet"), ("A4", "do not fit")])
def test_paper_that_cannot_serve_is_refused(paper: str, why: str) -> None:
    """A sheet that does not exist, or is too small for the words, is refused with the reason."""
    with pytest.raises(Refused, match=why):
        compose(gp.construct(gp.load("ozols-5-4")), paper, protocol="aside")


@pytest.mark.parametrize(("paper", "mark", "text"), [("A4", 2.5, 1.8), ("A3", 2.5, 1.8), ("A2", 3.5, 2.5)])
def test_letters_grow_with_the_paper(paper: str, mark: float, text: float) -> None:
    """Capitals of marks and of words are as high as is told for the paper, wherever they stand."""
    first, *others = pages(composition_of("four-bar", paper, protocol="pages"))
    steps = [t for page in others for t in page.items if isinstance(t, Text) and t.layer == "text" and t.step]
    assert min(t.size for t in steps) * CAPS >= (text if paper in ("A4", "A3") else 1.8)
    named = [t.size * CAPS for t in first.items if isinstance(t, Text) and t.layer == "letters" and t.label in "OABCM"]
    assert named == pytest.approx([mark] * 5, abs=0.02)
    assert min(t.size * CAPS for t in first.items if isinstance(t, Text)) >= text
