"""Scans and photos of handouts: found, straightened to a part of a millimetre, and the pencil on them read."""

from __future__ import annotations

import math
import os
import struct
import tempfile
import zlib
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

cv2 = pytest.importorskip("cv2")

from raster import Picture, Printed, photo, printed, scan  # noqa: E402

import graphplan as gp  # noqa: E402
from graphplan.errors import Refused  # noqa: E402
from graphplan.kernel.kinds import CIRCLE, LINE, POINT  # noqa: E402
from graphplan.marking.scans import measures  # noqa: E402
from graphplan.marking.scans.printed_ink import print_picture, print_pieces  # noqa: E402
from graphplan.marking.scans.scan import PencilPage, read_page, read_scan  # noqa: E402
from graphplan.marking.scans.straighten import _warp_by_marks, straighten  # noqa: E402
from graphplan.marking.submission import read_submission  # noqa: E402
from graphplan.marking.traces import PlanFrame, Trace  # noqa: E402
from graphplan.sheet.frames.frame import corner_marks, corner_numbers, corner_rects, mark_cells, sheet_code  # noqa: E402
from graphplan.sheet.handout import task  # noqa: E402
from graphplan.sheet.layout.composition import compose  # noqa: E402
from graphplan.sheet.plates.display import Sheet  # noqa: E402

CODE = sheet_code("slider-crank")
MARKS = "corner marks"
SMALL = 2800, 2100  # pixels of a phone, beside which A4 is as large as A3 is beside 12 megapixels


@cache
def page() -> Sheet:
    """A task with its marks."""
    composition = compose(gp.construct(gp.load("slider-crank")), "A4")
    sheet = task(composition)[0]
    return replace(sheet, items=(*sheet.items, *corner_marks(sheet.width, sheet.height, sheet.frame, CODE)))


@cache
def paper(*, marked: bool = True) -> Printed:
    """The task from the printer, with or without its marks."""
    return printed(page() if marked else replace(page(), items=tuple(i for i in page().items if i.layer != MARKS)))


def lines() -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """Lines in all directions on the plan that is empty."""
    (x, y) = list(page().panels.values())[1].centre
    turns = [math.radians(9 + 31 * i) for i in range(6)]
    aside = [(x + 3 * i - 8, 18 * math.cos(turn), 18 * math.sin(turn)) for i, turn in enumerate(turns)]
    return [((at - u, y - v), (at + u, y + v)) for at, u, v in aside]


STROKES = [(0.25, 0.55), (0.2, 0.4), (0.35, 0.65)]  # widths and darkness of pencils


def drawn() -> list[tuple[tuple[tuple[float, float], ...], float, float]]:
    """The lines as strokes."""
    return [(line, *STROKES[i % 3]) for i, line in enumerate(lines())]


def saved(folder: Path, image: np.ndarray, name: str = "drawing.png") -> Path:
    """A picture as a file."""
    cv2.imwrite(str(folder / name), image)
    return folder / name


def distance(trace: Trace, line: tuple[tuple[float, float], tuple[float, float]]) -> float:
    """How far the ends of a line are from the one it should be; endless where it has another direction."""
    way = np.subtract(line[1], line[0]) / math.dist(*line)
    out = np.array(trace.spots) - line[0]
    along, off = out @ way, np.abs(out @ [-way[1], way[0]])
    return float(off.max()) if np.ptp(along) > 0.75 * math.dist(*line) else math.inf


def errors(traces: tuple[Trace, ...]) -> list[float]:
    """How far the nearest found line is from each that was drawn."""
    found = [trace for trace in traces if trace.kind == LINE]
    return [min((distance(trace, line) for trace in found), default=math.inf) for line in lines()]


def without(seen: Picture, corners: tuple[int, ...]) -> Picture:
    """The picture with some marks covered by a thumb."""
    image = seen.image.copy()
    for corner in corners:
        rect = corner_rects(page().width, page().height, page().frame)[corner]
        cv2.fillConvexPoly(image, seen.seen(np.array(rect.inset(-1, -1, -1, -1).corners)).astype(np.int32), 170)
    return replace(seen, image=image)


def test_marks_are_those_of_the_dictionary() -> None:
    """The formula of the marks gives what OpenCV's dictionary has, and one number for each corner."""
    words = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_ARUCO_ORIGINAL)
    for number in range(0, 1024, 11):
        image = cv2.aruco.generateImageMarker(words, number, 7)[1:6, 1:6] > 0
        assert [[bit == "1" for bit in row] for row in mark_cells(number)] == image.tolist()
    assert [number >> 8 for number in corner_numbers(CODE)] == [0, 1, 2, 3]


def test_marks_cover_nothing_printed() -> None:
    """Marks lie on the paper and outside the frame, where there are neither plans nor words."""
    sheet = page()
    for rect in corner_rects(sheet.width, sheet.height, sheet.frame):
        assert rect.left > 0
        assert rect.right < sheet.width
        assert rect.bottom > 0
        assert rect.top < sheet.height
        assert not rect.meets(sheet.frame)


@pytest.mark.parametrize("quarters", [0, 1, 2])
def test_scans_any_way_up(quarters: int, tmp_path: Path) -> None:
    """A scan that lies upright, on its side or upside down gives every line to a tenth of a millimetre."""
    seen = scan(paper(), drawn(), 40 + quarters, quarters=quarters)
    submission = read_scan(saved(tmp_path, seen.image), page(), {"N-plan": PlanFrame(0j, 1 + 0j)}, CODE)
    found = errors(submission.traces)
    assert np.median(found) < 0.1
    assert max(found) < 0.3
    assert submission.shows == {LINE, CIRCLE}
    assert "N-plan" in submission.frames


@pytest.mark.costly
def test_a_mirrored_scan_is_read(tmp_path: Path) -> None:
    """A scan that shows the sheet from its back gives every line to a tenth of a millimetre."""
    seen = scan(paper(), drawn(), 44).image[:, ::-1]
    assert np.median(errors(read_scan(saved(tmp_path, seen), page(), {}, CODE).traces)) < 0.1


@pytest.mark.costly
@pytest.mark.parametrize(("lost", "seed"), [((2,), 51), ((0, 2), 53), ((0, 1, 3), 52)])
def test_photos(lost: tuple[int, ...], seed: int, tmp_path: Path) -> None:
    """A photo, tilted, bent and shadowed, gives every line to a tenth of a millimetre, even where marks are lost."""
    seen = without(photo(paper(), drawn(), seed, size=SMALL), lost)
    found = errors(read_scan(saved(tmp_path, seen.image, "drawing.jpg"), page(), {}, CODE).traces)
    assert np.median(found) < 0.1
    assert max(found) < 0.3


def astray(sheet: Sheet, seen: Picture) -> tuple[float, float]:
    """How many mm a straightened picture is off somewhere, and how sure of itself it is."""
    _, found = straighten(seen.image, sheet, print_picture(sheet, measures.PAGE_PX_PER_MM), measures.PAGE_PX_PER_MM,
                          None,
                          "photo")
    across, up = np.linspace(25, sheet.width - 15, 9), np.linspace(15, sheet.height - 15, 7)
    spots = np.array([(x, y) for x in across for y in up])
    off = np.hypot(*(found.warp(spots) - seen.seen(spots)).T) / found.warp.fineness()
    return float(off.max()), found.error


@pytest.mark.costly
def test_straightened_to_hundredths() -> None:
    """Lens, tilt and feed are taken out of a photo to a few hundredths of a millimetre, even by the frame alone."""
    off, error = astray(page(), photo(paper(marked=False), drawn(), 60, size=SMALL))
    assert off < 0.06
    assert error < 0.03


@pytest.mark.parametrize("seed", range(20))
def test_a_sheet_is_laid_by_all_its_marks(seed: int) -> None:
    """Corners that are seen a pixel off leave no mark far from where it is printed."""
    chance, sheet = np.random.default_rng(seed), page()
    rects = corner_rects(sheet.width, sheet.height, sheet.frame)
    marks = [np.array(rect.corners[::-1]) * 7 + chance.uniform(-1, 1, (4, 2)) for rect in rects]
    laid = _warp_by_marks(dict(enumerate(marks)), sheet)
    off = [laid(np.array(rect.corners[::-1])) - seen for rect, seen in zip(rects, marks, strict=True)]
    assert np.abs(off).max() < 3


@cache
def asked() -> PencilPage:
    """A scan with a very faint line, a struck arc and a dot, and a word's worth of scribble."""
    strokes = [((lines()[0]), 0.2, 0.12), (tuple(arc()), 0.25, 0.5), ((dot(),), 0.8, 0.8)]
    with tempfile.TemporaryDirectory() as folder:
        return read_page(saved(Path(folder), scan(paper(), strokes, 70).image), page(), CODE)


def arc() -> list[tuple[float, float]]:
    """A short struck arc: 30 mm about the middle of the free plan."""
    (x, y) = list(page().panels.values())[1].centre
    return [(x + 30 * math.cos(t), y + 30 * math.sin(t)) for t in np.linspace(1.0, 1.25, 40)]


def dot() -> tuple[float, float]:
    (x, y) = list(page().panels.values())[1].centre
    return x - 13.0, y + 14.0


@pytest.mark.costly
def test_a_page_is_asked_for_what_is_expected() -> None:
    """A faint line, a short arc and a dot are found near where they belong, and nothing where nothing is."""
    (x, y), (u, v) = lines()[0]
    found = asked().find_line((x + 0.3, y - 0.4), (u, v + 0.3), 1.0)
    assert found is not None
    assert distance(found, lines()[0]) < 0.15
    centre = list(page().panels.values())[1].centre
    rim = asked().find_arc(centre, 30.4, arc(), 1.0)
    assert rim is not None
    assert rim.kind == CIRCLE
    assert max(abs(math.dist(spot, centre) - 30) for spot in rim.spots) < 0.2
    spot = asked().find_dot((dot()[0] + 0.3, dot()[1]), 1.0)
    assert spot is not None
    assert spot.kind == POINT
    assert math.dist(spot.spots[0], dot()) < 0.1
    assert asked().find_line((x, y + 12), (u, v + 12), 1.0) is None
    assert asked().find_dot((x + 4, y + 9), 1.0) is None


BEYOND = (262.0, 203.0), [((288.5, y), (291.0, y + 2)) for y in (55.0, 60.0, 65.0)]  # a dot and letters off all panels


@cache
def dotted() -> tuple[PencilPage, dict[tuple[bool, int], tuple[float, float]]]:
    """A scan with places where up to two lines cross, marked by a dot or bare; and those places. A line leaves its
    panel, where its end is dotted, and something is written."""
    (x, y) = list(page().panels.values())[1].centre
    places = {(dot, count): (x + 14 * count - 18, y + high) for dot, high in ((True, 9), (False, -9))
              for count in range(3)}
    turns = math.radians(20), math.radians(80)
    strokes = [(((u - 6 * math.cos(turn), v - 6 * math.sin(turn)), (u + 6 * math.cos(turn), v + 6 * math.sin(turn))),
                0.25, 0.55) for (_, count), (u, v) in places.items() for turn in turns[:count]]
    strokes += [((spot,), 0.55, 0.77) for (dot, _), spot in places.items() if dot]
    end, letters = BEYOND
    strokes += [(((end[0] - 4, end[1] - 25), end), 0.25, 0.55), ((end,), 0.55, 0.77)]
    strokes += [(letter, 0.25, 0.55) for letter in letters]
    with tempfile.TemporaryDirectory() as folder:
        return read_page(saved(Path(folder), scan(paper(), strokes, 71).image), page(), CODE), places


@pytest.mark.parametrize("count", range(3))
@pytest.mark.parametrize("dot", [True, False])
def test_a_dot_is_told_from_lines_that_cross(count: int, dot: bool) -> None:
    """A dot on a line or on a crossing is seen, and none where there is none."""
    seen, places = dotted()
    spots = [trace.spots[0] for trace in seen.traces if trace.kind == POINT]
    assert any(math.dist(spot, places[dot, count]) < 0.3 for spot in spots) == dot
    assert (seen.find_dot(places[dot, count], 0.5) is not None) == dot


def test_what_leaves_a_panel_is_read() -> None:
    """A line is read as far as beyond its panel, and the dot at its end, but nothing that is written there."""
    seen, (end, letters) = dotted()[0], BEYOND
    near = {kind: [trace for trace in seen.traces if trace.kind == kind and min(
        math.dist(spot, end) for spot in trace.spots) < 2.0] for kind in (LINE, POINT)}
    assert [len(traces) for traces in near.values()] == [1, 1]
    assert not any(math.dist(spot, letter[0]) < 4.0 for trace in seen.traces for spot in trace.spots
                   for letter in letters)


@pytest.mark.costly
def test_a_ring_marks_the_point_in_its_middle(tmp_path: Path) -> None:
    """A small circle drawn about a point, alone, on a line or on a crossing, is that point; and it is nearer where
    lines meet than where a hand has drawn the ring."""
    (x, y) = list(page().panels.values())[1].centre
    places, turns = [(x + 14 * count - 18, y + 9) for count in range(3)], (math.radians(20), math.radians(80))
    strokes = [(((u - 6 * math.cos(turn), v - 6 * math.sin(turn)), (u + 6 * math.cos(turn), v + 6 * math.sin(turn))),
                0.25, 0.55) for count, (u, v) in enumerate(places) for turn in turns[:count]]
    rims = [[(u + 0.2 + 0.8 * math.cos(t), v + 0.2 + 0.8 * math.sin(t)) for t in np.linspace(0, math.tau, 40)]
            for u, v in places]
    strokes += [(tuple(rim), 0.25, 0.5) for rim in rims]
    seen = read_page(saved(tmp_path, scan(paper(), strokes, 72).image), page(), CODE)
    spots = [trace.spots[0] for trace in seen.traces if trace.kind == POINT]
    assert len(spots) == 3
    off = [min(math.dist(spot, place) for spot in spots) for place in places]
    assert off[0] < 0.4
    assert off[2] < 0.12


@pytest.mark.parametrize("far", [-2.0, 2.0])
def test_a_short_arc_is_seen_as_askew_as_it_is(far: float) -> None:
    """Its spots lie on it, where it was expected about a centre to one side."""
    (x, y), (u, v) = list(page().panels.values())[1].centre, arc()[20]
    across = (y - v) / 30 * far, (u - x) / 30 * far
    rim = asked().find_arc((x + across[0], y + across[1]), 30.0, arc(), 1.0)
    assert rim is not None
    assert max(abs(math.dist(spot, (x, y)) - 30) for spot in rim.spots) < 0.2


@pytest.mark.costly
def test_nothing_is_read_from_an_empty_page(tmp_path: Path) -> None:
    """A task on which nothing was drawn shows no line and no rim, for all its print, and is read as a blank sheet."""
    path = saved(tmp_path, scan(paper(), [], 80).image)
    assert [trace for trace in read_page(path, page(), CODE).traces if trace.kind != POINT] == []
    assert not read_scan(path, page(), {}, CODE).traces


@pytest.mark.costly
def test_documents(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The page of a PDF with the marks is read, whichever page it is, even after one with strokes and letters."""
    pytest.importorskip("pypdfium2")
    from graphplan.output import pdf

    monkeypatch.setattr(pdf, "_layer", lambda item: "ink")
    bare = replace(page(), items=tuple(item for item in page().items if item.layer != "corner marks"))
    path = tmp_path / "drawing.pdf"
    path.write_bytes(pdf.pdf([bare, page()]))
    assert read_page(path, page(), CODE).error < 0.03
    assert not read_submission(path, (), {}, page, CODE).letters
    path.write_bytes(pdf.pdf([bare]))
    assert read_submission(path, (), {}, page, CODE).letters


def test_another_task_is_refused(tmp_path: Path) -> None:
    """A sheet with the marks of another task is not judged."""
    path = saved(tmp_path, scan(paper(), [], 81).image)
    with pytest.raises(Refused, match="those of another task"):
        read_page(path, page(), sheet_code("four-bar"))


@pytest.mark.costly
def test_print_that_is_drawn_over_is_known() -> None:
    """A sheet all of whose own print a pencil is drawn along is still that of its task; one without it is not."""
    ink = print_pieces(page())
    side = np.column_stack([-ink.along[:, 1], ink.along[:, 0]])[ink.is_own] * 0.5
    ends = (ink.along * ink.halves[:, None])[ink.is_own]
    pencil = [(tuple(map(tuple, (at - end, at + end))), 0.6, 0.9)
              for at, end in zip(ink.middles[ink.is_own] + side, ends, strict=True)]
    over = scan(paper(), pencil, 83).image
    assert straighten(over, page(), print_picture(page(), measures.PAGE_PX_PER_MM), measures.PAGE_PX_PER_MM, CODE,
                      "over")[1].own_share > 0.5
    bare = replace(page(), items=tuple(item for item in page().items if item.layer in {"paper", MARKS}))
    with pytest.raises(Refused, match="print of this task was not found"):
        straighten(scan(printed(bare), [], 84).image, page(), print_picture(page(), measures.PAGE_PX_PER_MM),
                   measures.PAGE_PX_PER_MM, CODE, "bare")


def test_cropped_sheets_are_refused(tmp_path: Path) -> None:
    """A picture on which a plan is cut off is refused, by name."""
    seen = scan(paper(), drawn(), 82)
    right = list(page().panels.values())[1].right
    edge = int(seen.seen(np.array([[right - 15.0, 100.0]]))[0, 0])
    with pytest.raises(Refused, match=r"cut off|not found|neither"):
        read_page(saved(tmp_path, seen.image[:, :edge]), page(), CODE)


def _png(width: int, height: int, data: bytes = b"") -> bytes:
    """A PNG that says it is so large."""
    head = b"IHDR" + struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    body = b"IDAT" + data
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(part) - 4) + part + struct.pack(">I", zlib.crc32(part)) for part in (head, body, b"IEND"))


BAD = {
    "bomb.png": (_png(60000, 60000, zlib.compress(bytes(10**6))), "megapixels"),
    "huge.jpg": (b"\xff\xd8\xff\xe0\x00\x04ab\xff\xc0\x00\x11\x08\xff\xff\xff\xff\x03" + bytes(40), "megapixels"),
    "tiny.png": (_png(20, 20, zlib.compress(bytes(420))), "too few"),
    "broken.png": (_png(1000, 1000, b"no"), "damaged"),
    "headless.jpg": (b"\xff\xd8\xff\xe0\x00\x10JFIF", "damaged"),
    "broken.pdf": (b"%PDF-1.7\nnothing", "damaged"),
    "words.png": (b"these are words", "not a PNG"),
    "empty.png": (b"", "it is empty"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_files_are_refused(name: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Bombs, broken and foreign files are refused in one line, from their headers; decoders say nothing of them."""
    data, why = BAD[name]
    if name.endswith("pdf"):
        pytest.importorskip("pypdfium2")
    (tmp_path / name).write_bytes(data)
    with pytest.raises(Refused, match=why) as refused:
        read_page(tmp_path / name, page(), CODE)
    assert len(refused.value.lines) == 1
    assert name in str(refused.value)
    assert capfd.readouterr().err == ""


def test_blank_pictures_are_refused(tmp_path: Path) -> None:
    """A picture of nothing is refused, and so is one of noise."""
    with pytest.raises(Refused, match="blank"):
        read_page(saved(tmp_path, np.full((600, 800), 240, np.uint8)), page(), CODE)
    noise = np.random.default_rng(3).integers(0, 255, (600, 800), np.uint8)
    with pytest.raises(Refused, match=r"neither|not found"):
        read_page(saved(tmp_path, noise), page(), CODE)


def test_missing_files_are_refused(tmp_path: Path) -> None:
    """A file that is not there, a folder and a pipe are refused in one line, and nothing waits for them."""
    os.mkfifo(tmp_path / "pipe.png")
    for path, why in ((tmp_path / "none.png", "no such file"), (tmp_path, "a directory"),
                      (tmp_path / "pipe.png", "not a regular file")):
        with pytest.raises(Refused, match=why) as refused:
            read_page(path, page(), CODE)
        assert str(refused.value).startswith(f"{path}: ")
