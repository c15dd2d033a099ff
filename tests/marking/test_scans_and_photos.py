"""A drawing on the printed task before scanners and phones: whichever way it lies and whatever is lost of the paper, it
is judged as what it is, or refused with a word."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from pathlib import Path

import cv2
import numpy as np
import pytest
from drawing_board import Fault
from drawing_pictures import Grey, Paper, Stroke, as_document, on_printed_task, pencilled, photo, printed, scan
from face import ran
from hand_drawings import Drawing, scene_file, task_of
from judged_drawings import Judged, judged

pytestmark = pytest.mark.costly

NAME, SEED = "four-bar, polar", 1
SMALL = 2800, 2100  # pixels of a phone
Take = Callable[[Paper, list[Stroke], int], Grey]


@cache
def upon_task(fault: Fault | None = None) -> tuple[Drawing, Paper, list[Stroke]]:
    """The drawing, right or with a mistake, the paper, and the strokes."""
    drawing, paper = on_printed_task(task_of(NAME, SEED), SEED, fault)
    return drawing, paper, pencilled(drawing.board)


def seen(folder: Path, take: Take, fault: Fault | None = None, *, lost: tuple[int, ...] = ()) -> Judged:
    """What is said of a picture of it, of which some corners may lie under a thumb."""
    drawing, paper, strokes = upon_task(fault)
    cv2.imwrite(str(path := folder / "picture.png"), take(paper.without(*lost), strokes, 40))
    return judged(drawing, path)


WAYS: dict[str, tuple[Take, tuple[int, ...]]] = {
    "upright": (scan, ()), "on its side": (partial(scan, quarters=1), ()),
    "upside down": (partial(scan, quarters=2), ()),
    "from its back": (lambda *of: scan(*of)[:, ::-1], ()),
    "by a phone": (partial(photo, size=SMALL), ()), "by a phone, a corner lost": (partial(photo, size=SMALL), (2,)),
    "three corners lost": (scan, (0, 1, 3)),
}


@pytest.mark.parametrize("way", WAYS)
def test_a_right_drawing_is_right_whichever_way_it_lies(way: str, tmp_path: Path) -> None:
    """No step is wrong, most of what can be seen is found, and nearly all points are earned."""
    take, lost = WAYS[way]
    found = seen(tmp_path, take, lost=lost)
    assert found.data, found.error
    assert found.first == {}
    assert found.counts["right"] >= 5
    assert found.score > 85


@pytest.mark.parametrize(("fault", "mark"), [
    (Fault("reversed", "n_BA", -1), "n_BA"), (Fault("slip", "b", 14 + 3j), "b")])
def test_a_mistake_is_found_in_a_scan(fault: Fault, mark: str, tmp_path: Path) -> None:
    """A vector that goes the wrong way, and a mark beside its place."""
    found = seen(tmp_path, scan, fault)
    assert found.is_placed, (mark, found.words)
    assert found.score < 95


def test_an_empty_task_earns_nothing(tmp_path: Path) -> None:
    """A task on which nothing was drawn shows nothing, for all its print: nothing is wrong, and nothing is earned."""
    drawing, paper, _ = upon_task()
    cv2.imwrite(str(path := tmp_path / "picture.png"), scan(paper, [], 80))
    found = judged(drawing, path)
    assert found.data
    assert (found.first, found.score) == ({}, 0.0)


def refused(folder: Path, image: Grey) -> str:
    """The one line in which a picture is refused."""
    drawing, *_ = upon_task()
    cv2.imwrite(str(path := folder / "picture.png"), image)
    done = ran("verify", scene_file(drawing.task), path, "-q", *drawing.task.options)
    assert (done.status, done.err.count("\n")) == (2, 1)
    return done.err


def test_what_is_no_drawing_on_the_task_is_refused(tmp_path: Path) -> None:
    """Another task's sheet, one that is cut off, a drawing on blank paper, a picture of nothing and one of noise."""
    _, paper, strokes = upon_task()
    other = printed("slider-crank", "--paper", "A4")
    assert "those of another task" in refused(tmp_path, scan(other, [], 81))
    image = scan(paper, strokes, 82)
    cut = refused(tmp_path, image[:, : image.shape[1] * 3 // 5])
    assert any(word in cut for word in ("cut off", "not found", "neither"))
    assert "blank" in refused(tmp_path, np.full((600, 800), 240, np.uint8))
    blank = Paper(paper.width, paper.height, np.full_like(paper.page, 0.97))
    assert "measured points" in refused(tmp_path, scan(blank, strokes, 83))
    noise = np.random.default_rng(3).integers(0, 255, (600, 800), np.uint8)
    assert any(word in refused(tmp_path, noise) for word in ("neither", "not found"))


def test_a_page_of_a_document_is_read(tmp_path: Path) -> None:
    """A scan in a PDF is judged as the picture that it is."""
    drawing, paper, strokes = upon_task()
    (path := tmp_path / "scan.pdf").write_bytes(as_document(scan(paper, strokes, 40, dpi=150)))
    found = judged(drawing, path)
    assert found.data, found.error
    assert found.first == {}
    assert found.score > 85
