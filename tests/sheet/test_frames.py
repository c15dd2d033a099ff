"""Frames and title blocks: after which standard, with its measures, and never in the way of anything."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import cycle, pairwise
from pathlib import Path
from typing import Any

import pytest
from sheets import SCENES, composition_of, drawing_of, outside, sheet_of

import graphplan as gp
from graphplan.commands import main
from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.mechanism.papers import ISO_SIZES, SIZES
from graphplan.output.svg import svg
from graphplan.sheet.frames.frame import BORDER, FRAMES, frame_of
from graphplan.sheet.frames.title import DOCUMENTS, SOLUTION, TITLE_SIZE, Page
from graphplan.sheet.handout import guided_task, solution, task
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.layout.layout import layout
from graphplan.sheet.lettering.lettering import CAPS, HEADING, SIZE, plain
from graphplan.sheet.plates.display import Polyline, Rect, Sheet, Text
from graphplan.sheet.strip import strip
from graphplan.words import LANGUAGES
from graphplan.words.tongue import ENGLISH, tongue

FIELDS = {"A4": (6, 4), "A3": (8, 6), "A2": (12, 8), "A1": (16, 12), "A0": (24, 16)}  # ISO 5457, table 2


def wishing(scene: Scene, **wishes: Any) -> Scene:
    """A scene whose sheet has these wishes."""
    return replace(scene, sheet=replace(scene.sheet, **wishes))


def sheet_with(name: str, paper: str | None = None, plan: str = "orthogonal", **wishes: Any) -> Sheet:
    """The sheet of a scene with these wishes."""
    drawing = drawing_of(name, plan)
    return layout(compose(replace(drawing, scene=wishing(drawing.scene, **wishes)), paper))


def texts(sheet: Sheet) -> list[str]:
    """All that is written on a sheet."""
    return [plain(item.runs) for item in sheet.items if isinstance(item, Text)]


def clashes(sheet: Sheet) -> list[tuple[str, str]]:
    """The letterings that cover each other."""
    found = [(plain(item.runs), item.box.inset(0.05, 0.05, 0.05, 0.05)) for item in sheet.items
             if isinstance(item, Text)]
    return [(one, two) for i, (one, box) in enumerate(found) for two, other in found[:i] if box.meets(other)]


# ---- all scenes --------------------------------------------------------------------------------------------------

DRAWN = list(zip(SCENES, cycle(("A1", "A2", None)), cycle(("orthogonal", "polar")), strict=False))
CASES = [(*drawn, frame) for k, drawn in enumerate(DRAWN)
         for frame in FRAMES if frame == "gost" or k % 4 < 2]  # in the usual frame test_layout.py draws all


@pytest.mark.parametrize(("name", "paper", "plan", "frame"), CASES)
def test_in_both_frames_nothing_is_in_the_way(name: str, paper: str | None, plan: str, frame: str) -> None:
    """Nothing leaves the frame or the sheet, no letters cover each other, and plans and words keep off the title block.
    """
    drawing = drawing_of(name, plan)
    usual = frame == (drawing.scene.sheet.frame or "iso")
    wished = replace(drawing, scene=wishing(drawing.scene, frame=frame))
    composition = composition_of(name, paper, plan) if usual else compose(wished, paper)
    sheet = sheet_of(name, paper, plan) if usual else layout(composition)
    assert outside(sheet) == []
    assert clashes(sheet) == []
    assert ("velocity plan" in sheet.panels) == (plan == "polar")
    page = Rect(0.0, 0.0, sheet.width, sheet.height)
    assert all(page.holds(spot) for item in sheet.items if isinstance(item, Text)
               for spot in (item.box.corners[0], item.box.corners[2]))
    arrangement = composition.arrangement
    assert not [rect for rect in (*arrangement.columns, *arrangement.panels.values()) if rect.meets(arrangement.title)]


@pytest.mark.parametrize("frame", FRAMES)
def test_a_sheet_is_the_same_every_time(frame: str) -> None:
    """The same scene, read and drawn twice, is the same file to the byte."""
    one, other = (svg(layout(compose(gp.construct(wishing(gp.load("shaper"), frame=frame)), "A2"))) for _ in range(2))
    assert one == other


# ---- ISO 5457 and 7200 -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("paper", [*ISO_SIZES, "A4 portrait", "A3 portrait"])
def test_fields_are_those_of_the_standard(paper: str) -> None:
    """Fields are as many as in the standard's table, named in 3.5 mm on both sides, on A4 on one; no I and no O."""
    size, _, upright = paper.partition(" ")
    wide, high = SIZES[size][::-1] if upright else SIZES[size]
    space = FRAMES["iso"].space(wide, high)
    names = [item for item in FRAMES["iso"].items(paper, space, ENGLISH) if isinstance(item, Text)]
    assert [item.size * CAPS for item in names] == pytest.approx([3.5] * len(names))
    across, upwards = FIELDS[size][::-1] if upright else FIELDS[size]
    letters = [*"ABCDEFGHJKLMNPQRSTUVWXYZ"][:upwards]
    numbers = [str(number) for number in range(1, across + 1)]
    assert sorted(plain(item.runs) for item in names) == sorted((letters + numbers) * (1 if size == "A4" else 2))
    right = [item for item in names if item.at[0] > space.right]
    assert [plain(item.runs) for item in sorted(right, key=lambda item: -item.at[1])] == letters
    top = [item for item in names if item.at[1] > space.top]
    assert [plain(item.runs) for item in sorted(top, key=lambda item: item.at[0])] == numbers


def test_the_border_is_that_of_the_standard() -> None:
    """The frame is 20 mm from the left edge and 10 mm from the others; divisions are 50 mm apart from the middles."""
    sheet = sheet_with("four-bar", "A2")
    assert sheet.frame == Rect(20.0, 10.0, 584.0, 410.0)
    strokes = [item for item in sheet.items if isinstance(item, Polyline) and item.layer == BORDER]
    top = sorted(item.spots[0][0] for item in strokes
                 if len(item.spots) == 2 and min(y for _, y in item.spots) == 410.0 and item.pen.width < 0.7)
    assert 594 / 2 in top
    assert {round(b - a, 9) for a, b in pairwise(top)} == {50.0}
    marks = {item.spots for item in strokes if item.pen.width == 0.7}
    assert marks == {((15.0, 210.0), (20.0, 210.0)), ((589.0, 210.0), (584.0, 210.0)),
                     ((297.0, 5.0), (297.0, 10.0)), ((297.0, 415.0), (297.0, 410.0))}  # fmt: skip


def test_the_block_of_the_standard_fills_an_upright_a4() -> None:
    """On an upright A4 the title block is 180 mm wide, as the frame; on larger sheets as the column over it."""
    drawing = drawing_of("four-bar")
    title = composition_of("four-bar", "A4 portrait").arrangement.title
    assert (title.left, title.right, title.bottom) == (20.0, 200.0, 10.0)
    arrangement = compose(drawing, "A2", protocol="aside").arrangement
    assert arrangement.title.width == pytest.approx(arrangement.columns[-1].width + 5.0)


def test_data_fields_are_told_where_the_scene_fills_them() -> None:
    """Document, author, scale, format, sheet and language always stand in the block, the others where there are any."""
    bare, full = (texts(sheet_with("four-bar", "A3", **wishes)) for wishes in (
        {}, {"owner": "Chair of Mechanisms", "number": "TMM-01", "date": "1939", "approved_by": "N. N."}))
    assert {"Document", "Construction sheet", "Drawn by", "graphplan", "Format", "A3", "Sheet", "1/2", "Language",
            "en"} <= set(bare)
    optional = {"Legal owner", "Number", "Date of issue", "Approved by"}
    assert not optional & set(bare)
    assert optional | {"Chair of Mechanisms", "TMM-01", "1939", "N. N."} <= set(full)


# ---- GOST 2.301 and 2.104 ----------------------------------------------------------------------------------------


def test_form_1_has_the_measures_of_the_standard() -> None:
    """The block is 185 x 55 mm, with columns of 7, 10, 23, 15, 10, 70, 15, 17 and 18 mm and rows of 5 mm."""
    sheet = sheet_with("four-bar", "A3", frame="gost")
    assert sheet.frame == Rect(20.0, 5.0, 415.0, 292.0)
    lines = [item.spots for item in sheet.items if isinstance(item, Polyline) and item.layer == "paper"]
    upright = sorted({a[0] for a, b in lines if a[0] == b[0]})
    level = sorted({a[1] for a, b in lines if a[1] == b[1] and a[0] == 230.0})
    columns = [round(b - a, 9) for a, b in pairwise((*upright, 415.0))]
    assert columns == [7, 10, 23, 15, 10, 70, 5, 5, 5, 5, 12, 18]  # the letter's cell in three, the pages' edge at 20
    assert [round(b - a, 9) for a, b in pairwise((5.0, *level))] == [5.0] * 10 + [5.0]
    words = {"Rev.", "Doc. No.", "Approved", "Lit.", "Mass", "Scale", "Sheet 1", "Sheets 2", "Format A3"}
    assert words <= set(texts(sheet))


def test_form_1_speaks_russian() -> None:
    """In Russian its words are those of the standard."""
    words = {"Изм.", "Лист", "№ докум.", "Подп.", "Дата", "Разраб.", "Пров.", "Т. контр.", "Н. контр.", "Утв.", "Лит.",
             "Масса", "Масштаб", "Лист 1", "Листов 2"}  # fmt: skip
    assert words <= set(texts(sheet_with("four-bar", "A3", frame="gost", language="ru")))


def test_a4_stands_upright_after_gost() -> None:
    """GOST 2.301 knows an A4 only upright, whether it is named or found; its block is as wide as the frame."""
    scene = gp.load("four-bar")
    drawing = gp.construct(wishing(replace(scene, find=replace(scene.find, velocity=("A",), acceleration=())),
                                   frame="gost"))
    for paper in (None, "A4"):
        sheet = layout(compose(drawing, paper))
        assert (sheet.width, sheet.height, sheet.frame.width) == (210.0, 297.0, 185.0)


@pytest.mark.parametrize("code", LANGUAGES)
@pytest.mark.parametrize("frame", FRAMES)
def test_its_own_words_fit_in_every_language(frame: str, code: str) -> None:
    """Headings and kinds of document have room in the cells of both blocks, on any page and of any scale."""
    scene = wishing(gp.load("four-bar"), frame=frame)
    block = frame_of(scene).block(scene, tongue(code))
    for document in DOCUMENTS:
        wide = block.width(Rect(20.0, 10.0, 410.0, 287.0), 101.0)
        rect = Rect(0.0, 0.0, wide, block.height(wide))
        for page in (Page(document, "A3", "1 : 2.5", 12, 34), Page(document, "A4", "2.5 : 1")):
            items = [item for item in block.items(rect, page) if isinstance(item, Text)]
            assert all(rect.holds(spot) for item in items for spot in (item.box.corners[0], item.box.corners[2]))
            assert not any(one.box.meets(two.box) for i, one in enumerate(items) for two in items[:i])


# ---- what is written ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("frame", FRAMES)
def test_long_titles_wrap_and_shrink(frame: str) -> None:
    """A long title stands on more lines and in letters of no less than 2.5 mm; one that is too long is refused."""
    scene = wishing(gp.load("four-bar"), frame=frame)
    sizes = []
    for words in (3, 14):
        long = replace(scene, title=" ".join(["kinematic"] * words))
        block = frame_of(scene).block(long, ENGLISH)
        wide = block.width(Rect(20.0, 10.0, 410.0, 287.0), 101.0)
        items = block.items(Rect(0.0, 0.0, wide, block.height(wide)), Page(SOLUTION, "A3", "1 : 1"))
        sizes.append({item.size for item in items if isinstance(item, Text) and "kinematic" in plain(item.runs)})
    assert sizes == [{HEADING if frame == "iso" else TITLE_SIZE}, {SIZE}]
    block = frame_of(scene).block(replace(scene, title="kinematic " * 99), ENGLISH)
    with pytest.raises(Refused, match=r"title: it is too long .*; fewer words"):
        list(block.items(Rect(0.0, 0.0, wide, block.height(wide)), Page(SOLUTION, "A3", "1 : 1")))


@pytest.mark.parametrize("field", ["drawn_by", "approved_by", "date", "number", "owner"])
def test_what_is_too_long_for_form_1_is_named(field: str) -> None:
    """What has no room in its cell of the block after GOST is refused by the name of its field, and by no other."""
    scene = wishing(gp.load("four-bar"), frame="gost", **{field: "Rosenauer, Nikolai " * 20})
    with pytest.raises(Refused, match=rf"^sheet\.{field}: it is too long .*; fewer words"):
        layout(compose(replace(drawing_of("four-bar"), scene=scene), "A3"))


def test_form_1_has_names_beside_their_roles() -> None:
    """Who drew the sheet stands in the first row of those who sign, who approved it in the last, the date in the first.
    """
    signed = {"drawn_by": "N. R.", "approved_by": "A. W.", "date": "1939"}
    sheet = sheet_with("four-bar", "A3", frame="gost", **signed)
    found = {plain(item.runs): item.at[1] for item in sheet.items if isinstance(item, Text)}
    rows = {word: int((at - 5.0) // 5) for word, at in found.items()}
    assert rows["N. R."] == rows["1939"] == rows["Drawn"] == 5
    assert rows["A. W."] == rows["Approved"] == 0


def pages() -> Iterator[tuple[list[Sheet], str]]:
    """Documents of several pages, with what they are called."""
    composition = composition_of("alt-eight-link")
    solved = solution(composition)
    yield solved, "Solution"
    yield task(composition), "Task"
    yield guided_task(composition), "Guided construction"
    yield strip(composition, "A3"), "Film strip"


def test_every_page_says_which_document_and_page_it_is() -> None:
    """The title block names the kind of document, and which sheet it is of how many."""
    for sheets, document in pages():
        for number, sheet in enumerate(sheets, 1):
            told = {part for text in texts(sheet) for part in text.split(" · ")}
            assert f"{number}/{len(sheets)}" in told
            assert told & set(map(str, DOCUMENTS)) == {document}
        assert clashes(sheets[-1]) == []


def test_the_command_line_has_the_last_word(tmp_path: Path) -> None:
    """Options win over the scene's sheet, and the sheet over what is usual."""
    wishes = '[sheet]\npaper = "A2"\nframe = "gost"\nlanguage = "ru"\n[points]'
    text = gp.load("five-bar").text.replace("[points]", wishes, 1)
    scene, out = tmp_path / "scene.toml", tmp_path / "sheet.svg"
    scene.write_text(text)

    def drawn(*options: str) -> str:
        assert main(["draw", str(scene), "-o", str(out), *options]) == 0
        return out.read_text()

    wished = drawn()
    assert 'width="594mm"' in wished
    assert 'xml:lang="ru"' in wished
    assert "№ докум." in wished
    told = drawn("--paper", "A3", "--set", "sheet.frame=iso", "--language", "lv")
    assert 'width="420mm"' in told
    assert 'xml:lang="lv"' in told
    assert "№ докум." not in told
    assert svg(layout(compose(gp.construct(gp.load(scene))))).count("№ докум.") == 1
