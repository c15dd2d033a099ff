"""Scans and photos of handouts judged: the pencil on them is laid over the construction."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path

import pytest

cv2 = pytest.importorskip("cv2")

from hands import draw, frames, slipped, strokes  # noqa: E402
from raster import Printed, photo, printed, scan  # noqa: E402

import graphplan as gp  # noqa: E402
from graphplan.accuracy.hand import Pencil  # noqa: E402
from graphplan.kernel.kinds import LINE  # noqa: E402
from graphplan.marking.judge.judge import judge  # noqa: E402
from graphplan.marking.judge.mistaken_step import Mistake  # noqa: E402
from graphplan.marking.judge.score import score  # noqa: E402
from graphplan.marking.judge.verdict import MISSING, RIGHT, Judgement  # noqa: E402
from graphplan.marking.submission import read_submission  # noqa: E402
from graphplan.methods.construction import Construction  # noqa: E402
from graphplan.output.pdf import pdf  # noqa: E402
from graphplan.sheet.handout import code, task  # noqa: E402
from graphplan.sheet.layout.composition import Composition, compose  # noqa: E402
from graphplan.sheet.layout.layout import layout  # noqa: E402
from graphplan.sheet.plates.display import Sheet  # noqa: E402


@cache
def handout() -> tuple[Construction, Composition, Sheet, Printed]:
    """A task, and its page from the printer."""
    drawing = gp.construct(gp.load("four-bar"))
    sheet = compose(drawing)
    page = task(sheet)[0]
    return drawing, sheet, page, printed(page)


def judged(folder: Path, seed: int, slips: dict[int, Mistake] | None = None, *, phone: bool = False) -> Judgement:
    """A drawing on the handout, before a scanner or a phone, and what is said of it."""
    drawing, sheet, page, paper = handout()
    ways = frames(drawing, sheet)
    drawn = draw(drawing, ways, Pencil(), seed, slips)
    picture = (photo if phone else scan)(paper, strokes(drawn, sheet, seed), seed)
    path = folder / ("photo.jpg" if phone else "scan.png")
    cv2.imwrite(str(path), picture.image)
    submission = read_submission(path, list(sheet.views), ways, lambda: page, code(sheet))
    return judge(drawing, sheet, submission, Pencil())


@pytest.mark.costly
@pytest.mark.parametrize("phone", [False, True])
def test_a_faultless_drawing_is_right_in_a_picture(tmp_path: Path, phone: bool) -> None:
    """No step is wrong, and most of what can be seen is found."""
    found = judged(tmp_path, 39, phone=phone)
    states = [verdict.state for verdict in found.verdicts]
    assert found.first_wrong is None
    assert states.count(RIGHT) > len(states) / 3
    assert states.count(MISSING) <= 2
    lines = [trace.spots for trace in found.spare if trace.kind == LINE]
    assert all(math.dist(*spots[:2]) < 20 for spots in lines)  # mm: what is drawn over print is not spare


def test_a_point_far_off_is_found_in_a_scan(tmp_path: Path) -> None:
    """A vector that ends far from where it should is wrong there, though all that follows goes on from it."""
    drawing, *_ = handout()
    b = next(step.index for step in drawing.drawn.steps if step.name == "b")
    for mistake in (mistake for mistake in slipped(drawing, b) if mistake.kind in ("reversed", "turned the wrong way")):
        found = judged(tmp_path, 33, {b: mistake})
        assert found.first_wrong_step == b
        assert (score(found).total or 0) < 90


@pytest.mark.costly
def test_nothing_is_wrong_on_an_own_sheet_in_a_pdf(tmp_path: Path) -> None:
    """A sheet that was drawn as a page, which has other print than the task, is laid by its frame and its mechanism."""
    pytest.importorskip("pypdfium2")
    drawing, sheet, page, _ = handout()
    path = tmp_path / "sheet.pdf"
    path.write_bytes(pdf([layout(sheet)]))
    found = judge(drawing, sheet,
                  read_submission(path, list(sheet.views), frames(drawing, sheet), lambda: page, code(sheet)),
                  Pencil())
    assert found.first_wrong is None
    assert (score(found).total or 0) > 90


def test_a_wrong_line_is_found_in_a_scan(tmp_path: Path) -> None:
    """A perpendicular to the wrong side of the link is named, with the line that was taken for it."""
    drawing, *_ = handout()
    beta = next(step.index for step in drawing.drawn.steps if step.name == "beta")
    mistake = next(mistake for mistake in slipped(drawing, beta) if mistake.text == "perpendicular to AB instead of BC")
    found = judged(tmp_path, 32, {beta: mistake})
    assert found.first_wrong_step == beta
    assert found.first_wrong
    assert str(found.first_wrong.mistake) == "perpendicular to AB instead of BC"
    assert found.first_wrong.off > 3 * found.first_wrong.tolerance
