"""Scans of drawings on blank and squared paper: two lettered points say where the mechanism is."""

from __future__ import annotations

import cmath
import math
import random
import zlib
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

import pytest

cv2 = pytest.importorskip("cv2")

import numpy as np  # noqa: E402
from blackboard import Board, Fault, Places, Unfit, mistaken, task_of  # noqa: E402
from numpy.typing import NDArray  # noqa: E402
from raster import FINE, Printed, Stroke, scan  # noqa: E402
from test_blackboard_scans import DRAWN, given_places, pencil_strokes  # noqa: E402

from graphplan.errors import Refused  # noqa: E402
from graphplan.kernel.kinds import LINE  # noqa: E402
from graphplan.marking.classroom.results import MarkedDrawing  # noqa: E402
from graphplan.marking.judge.score import Weights  # noqa: E402
from graphplan.marking.scans.blank_paper import (  # noqa: E402
    blank_ink,
    has_frame,
    lay_paper,
    paper_corners,
    read_blank_paper,
    stated_size,
)
from graphplan.marking.scans.image import stated_dpi  # noqa: E402
from graphplan.marking.scans.pencil_pixels import darkness  # noqa: E402
from graphplan.marking.scans.pin_letters import find_pins  # noqa: E402
from graphplan.marking.scans.plan_places import find_plans  # noqa: E402
from graphplan.marking.scans.ruled_paper import without_smudges  # noqa: E402
from graphplan.marking.scans.straighten import lay_straight  # noqa: E402
from graphplan.marking.traces import PlanFrame, Trace  # noqa: E402
from graphplan.mechanism.scene import load  # noqa: E402
from graphplan.methods.panels import MECHANISM  # noqa: E402
from graphplan.public.desk import Desk  # noqa: E402
from graphplan.public.drafting import Options  # noqa: E402
from graphplan.public.variants import draft_scene  # noqa: E402

A3, A4, LARGER, SMALL = (420.0, 297.0), (297.0, 210.0), (170.0, 120.0), (120.0, 85.0)
EDGE_MM, SQUARE_MM, RULING, PX_PER_MM, CLEARLY_DARK = 12.0, 5.0, 0.72, 8.0, 0.1
SEEDS, MISTAKEN_SEEDS = range(40, 41), range(60, 64)
FALSE_ALARMS, ALMOST_ALL, MOST_UNREAD = 0.05, 97.0, 0.2
CORNER, NEAR_MM = 20 + 20j, 0.8
TRIANGLE = {"O": 0j, "A": 30 + 40j, "C": 70 + 5j}  # mm


def _arc(x: float, wide: float, start: float, end: float) -> list[complex]:
    """A piece of an oval in a letter's box, counter-clockwise between two angles in degrees."""
    turns = [math.radians(start + (end - start) * k / 24) for k in range(25)]
    return [complex(x + wide * math.cos(turn), 0.5 + 0.5 * math.sin(turn)) for turn in turns]


LETTERS = {  # strokes in a box of height 1
    "O": [_arc(0.4, 0.4, 90, 450)], "C": [_arc(0.45, 0.42, 50, 310)],
    "A": [[0j, 0.35 + 1j, 0.7 + 0j], [0.12 + 0.35j, 0.58 + 0.35j]],
}


def letter_strokes(letter: str, at: complex, size: float, lean: float) -> Iterator[Stroke]:
    """A letter about a spot, leaning to the right."""
    for stroke in LETTERS[letter]:
        spots = [at + size * complex(z.real + lean * z.imag - 0.4, z.imag - 0.5) for z in stroke]
        yield [(z.real, z.imag) for z in spots], 0.3, 0.75


def freest_spot(about: complex, board: Board) -> complex:
    """The spot for a letter about a point that is farthest from all strokes."""
    spots = np.array([one + (other - one) * share for one, other in board.strokes for share in np.linspace(0, 1.1, 60)])
    around = about + 4.0 * np.exp(2j * np.pi * np.arange(16) / 16)
    return complex(around[np.abs(around[:, None] - spots[None]).min(axis=1).argmax()])


def paper(size: tuple[float, float], squared: bool, chance: np.random.Generator) -> Printed:
    """Paper with nothing on it but squares."""
    page = np.full((round(size[1] * FINE), round(size[0] * FINE)), 0.97, np.float32)
    for axis, first in enumerate(chance.uniform(0, SQUARE_MM, 2) if squared else ()):
        for at in np.arange(first, size[1 - axis], SQUARE_MM):
            page[(slice(int(at * FINE), int(at * FINE) + 2), slice(None))[:: 1 - 2 * axis]] = RULING
    return Printed(*size, page)


def triangle(squared: bool, letters: str) -> NDArray[np.uint8]:
    """A picture of three strokes between dots, two of them lettered, on a small piece of paper."""
    board = Board(random.Random(1), None)
    spots = {name: CORNER + z for name, z in TRIANGLE.items()}
    for name, other in ("OA", "AC", "CO"):
        board.strokes.append((spots[name], spots[other]))
    dots = [([(z.real + 0.2 * k, z.imag) for k in (-1, 0, 1)], 0.7, 0.9) for z in spots.values()]
    strokes: list[Stroke] = [*pencil_strokes(board), *dots]
    for letter in letters:
        strokes += letter_strokes(letter, freest_spot(spots[letter], board), 3.6, 0.1)
    return scan(paper(SMALL, squared, np.random.default_rng(3)), strokes, 1).image


def test_two_lettered_points_are_found(tmp_path: Path) -> None:
    """They say where the mechanism is; without letters nothing does."""
    cv2.imwrite(str(path := tmp_path / "scan.png"), triangle(False, "OC"))
    submission = read_blank_paper(path, {MECHANISM: TRIANGLE}, {MECHANISM: PlanFrame(0j, 1.2)}, SMALL)
    assert submission
    frame = submission.frames[MECHANISM]
    assert abs(frame.origin - CORNER) < NEAR_MM
    assert frame.unit == pytest.approx(1.0, abs=0.01)
    assert not find_pins(np.array([*TRIANGLE.values()]), [], TRIANGLE, 1.0)


PLAN = [0j, 30 + 5j, 12 + 33j, -20 + 18j]  # mm from its beginning


def lines_between(spots: Sequence[complex]) -> Callable[[complex, complex], bool]:
    """Whether a line is between two spots: between any two of these."""
    return lambda one, two: all(min(abs(z - spot) for spot in spots) < NEAR_MM for z in (one, two))


@pytest.mark.parametrize("ratio", [1.0, 0.8, -1.0])
def test_a_plan_is_found_by_its_dots(ratio: float) -> None:
    """It begins where they say, whatever dots lie about, at the task's scale or its own, and upside down too."""
    frame, chance = PlanFrame(120 + 60j, ratio), random.Random(5)
    marks = [frame.to_sheet(mark) for mark in PLAN]
    dots = marks + [complex(chance.uniform(0, 60), chance.uniform(0, 120)) for _ in range(8)]
    (found,) = find_plans(np.array(dots), np.array([30 + 30j]), PLAN, 1.0, lines_between(marks))
    assert abs(found.origin - frame.origin) < NEAR_MM
    assert found.unit == pytest.approx(ratio, abs=0.01)


def test_no_plan_is_turned_slightly() -> None:
    """Dots that are so are off, in a plan that is upright as the mechanism."""
    marks = [100 + mark * cmath.rect(1.0, math.radians(1.5)) for mark in PLAN]
    (found,) = find_plans(np.array(marks), np.array([], complex), PLAN, 1.0, lines_between(marks))
    assert found.unit.imag == pytest.approx(0.0, abs=1e-9)


def test_a_plan_is_found_without_a_dot_at_its_beginning() -> None:
    """Its other marks, at which lines end, say where it begins."""
    marks = [100 + mark for mark in PLAN]
    (found,) = find_plans(np.array(marks[1:]), np.array([], complex), PLAN, 1.0, lines_between(marks))
    assert abs(found.origin - 100) < NEAR_MM


def test_a_plan_with_a_wrong_length_has_the_scale_of_its_first_vector() -> None:
    """What was drawn half as long, and what follows from it, does not make the plan half as large."""
    marks = [100 + mark for mark in (*PLAN[:2], PLAN[2] / 2, PLAN[3] / 2)]
    (found,) = find_plans(np.array(marks), np.array([], complex), PLAN, 1.0, lines_between(marks))
    assert abs(found.origin - 100) < NEAR_MM
    assert found.unit == pytest.approx(1.0)


def test_an_upright_plan_with_a_mistake_is_likelier_than_a_turned_one() -> None:
    """Dots that chance to lie as a turned plan has them, smaller, leave it where most of it is right."""
    marks = [0.9 * mark for mark in PLAN]
    marks[2] += 12 - 9j
    chance = [120 + 60j + 0.6j * mark for mark in PLAN[:3]]
    dots = np.array([*marks, *chance])
    (found,) = find_plans(dots, np.array([], complex), PLAN, 1.0, lines_between(dots.tolist()))
    assert abs(found.origin) < NEAR_MM
    assert found.unit == pytest.approx(0.9, abs=0.01)


def test_two_scales_for_the_same_dots_are_one_plan() -> None:
    """Small plans have no sharp scale, and are clear for all that."""
    plan = [0.25 * mark for mark in PLAN]
    marks = [100 + mark * (1 + 0.1 * (-1) ** order) for order, mark in enumerate(plan)]
    assert len(find_plans(np.array(marks), np.array([], complex), plan, 0.8, lines_between(marks))) == 1


def test_dots_at_which_no_line_ends_hold_no_plan() -> None:
    """A dot beside a missing mark does not move the others."""
    marks = [100 + mark for mark in PLAN[:3]]
    dots = np.array([*marks, 100 + PLAN[3] + 0.9])
    (found,) = find_plans(dots, np.array([], complex), PLAN, 1.0, lines_between(marks))
    assert abs(found.origin - 100) < 1e-6
    assert found.unit == pytest.approx(1.0)


def test_a_plan_that_may_lie_at_two_places_has_a_rival() -> None:
    """Where its marks are drawn twice, nothing says which are meant."""
    marks = [0j, 31 + 7j, 12 + 33j]
    dots = [place + mark for place in (10 + 10j, 90 + 30j) for mark in marks]
    assert len(find_plans(np.array(dots), np.array([], complex), marks, 1.0, lines_between(dots))) > 1


def test_a_shadow_is_no_edge_of_the_paper() -> None:
    """Of paper that lies on a darker table, half in shadow, the corners are found."""
    corners = np.array([(30, 560), (760, 540), (740, 60), (60, 40)])
    picture = cv2.fillPoly(np.full((600, 800), 60, np.uint8), [corners], 230)
    shade = cv2.GaussianBlur(np.repeat(np.where(np.arange(800) < 350, 0.55, 1.0)[None], 600, axis=0), (0, 0), 25.0)
    found = paper_corners((picture * shade).astype(np.uint8))
    assert found is not None
    assert np.abs(found - corners).max() < 5


def test_what_is_left_of_squares_in_a_smudge_is_no_pencil() -> None:
    """Its cells are as dark as what is about them; a pencil's line is darker."""
    dark = np.full((160, 160), 0.15, np.float32)
    dark[10::40] = dark[:, 10::40] = 0.0
    dark[70:73, 20:140] = 0.5
    left = without_smudges(dark, PX_PER_MM)
    assert (left[70:73, 30:130] > 0.25).all()
    assert not left[:60, 20:140].any()


def test_squares_are_taken_off_and_tell_the_scale() -> None:
    """Paper that is taken for larger is as large as its squares say, and hardly any of them is left."""
    picture = triangle(True, "")
    warp, is_stated = lay_paper(picture, None, LARGER)
    dark = darkness(lay_straight(picture, warp, PX_PER_MM))
    ink, warp = blank_ink(picture, warp, is_stated, PX_PER_MM)
    assert warp.size == pytest.approx(SMALL, rel=0.01)
    assert (dark > CLEARLY_DARK).mean() > 0.05
    assert (ink.dark > CLEARLY_DARK).mean() < 0.01


def test_a_frame_is_that_of_a_printed_sheet() -> None:
    """Three sides tell it; a line along one side, or a mechanism's four, are none."""
    rim = [(5.0, 5.0), (115.0, 5.5), (115.0, 80.0), (5.0, 80.0)]
    sides = [Trace(LINE, (one, other)) for one, other in zip(rim, rim[1:] + rim[:1], strict=True)]
    crank = [(20.0, 20.0), (30.0, 50.0), (80.0, 70.0), (90.0, 25.0)]
    links = [Trace(LINE, (one, other)) for one, other in zip(crank, crank[1:] + crank[:1], strict=True)]
    assert has_frame(sides[:3], SMALL)
    assert not has_frame([sides[0], *links], SMALL)


def test_a_stated_density_is_believed_where_there_is_such_paper(tmp_path: Path) -> None:
    """Programs state densities that nobody measured."""
    picture = np.zeros((165, 234), np.uint8)
    data = cv2.imencode(".png", picture)[1].tobytes()
    density = b"pHYs" + round(20 / 0.0254).to_bytes(4) * 2 + b"\1"
    stated = len(density[4:]).to_bytes(4) + density + zlib.crc32(density).to_bytes(4)
    (path := tmp_path / "scan.png").write_bytes(data[:33] + stated + data[33:])
    assert stated_dpi(path, picture) == pytest.approx(20.0, rel=0.01)
    assert stated_size(picture, 20.0) == pytest.approx(A4, rel=0.01)
    assert stated_size(picture, 7.2) is None


def judged(name: str, seed: int, folder: Path, squared: bool, fault: Fault | None = None) -> MarkedDrawing:
    """A drawing at a size and place of its own, right or with a mistake, its first fixed points lettered, scanned."""
    task, chance = task_of(name, seed), np.random.default_rng([seed, 7])
    (scene := folder / "task.toml").write_text(task.scene)
    options = Options(plan=task.plan if task.plan == "polar" else "")
    sheet = draft_scene(options, load(str(scene)))
    own, size = given_places(task, sheet.composition), chance.uniform(0.85, 1.05)
    shift = complex(*chance.uniform(5, 10, 2))
    board = Board(random.Random(seed), fault)
    task.draw(task, board, Places(*(size * z + shift for z in (own.mechanism, own.first, own.second)), size * own.k,
                                  size * own.kv, own.ka * (size if task.plan == "polar" else 1.0)))
    if not all(EDGE_MM < z.real < A3[0] - EDGE_MM and EDGE_MM < z.imag < A3[1] - EDGE_MM for z in board.marks.values()):
        raise Unfit("off the paper")
    strokes = pencil_strokes(board)
    for letter in "OC" if ("mechanism", "C") in board.marks else "OA":
        at = freest_spot(board.marks["mechanism", letter], board)
        strokes += letter_strokes(letter, at, chance.uniform(3.0, 4.2), chance.uniform(0, 0.25))
    cv2.imwrite(str(path := folder / "scan.png"), scan(paper(A3, squared, chance), strokes, seed).image)
    return Desk(sheet, Weights(), options).judge_file(path)


@pytest.mark.costly
@pytest.mark.parametrize("squared", [False, True])
def test_a_right_drawing_on_blank_paper_is_right(squared: bool, tmp_path: Path) -> None:
    """At most five of a hundred are called wrong, two of three earn almost all, and few cannot be read. Squares take
    long to take off: on them are fewer."""
    marked, unread = list[MarkedDrawing](), 0
    for name in DRAWN[::3] if squared else DRAWN:
        for seed in SEEDS:
            try:
                marked.append(judged(name, seed, tmp_path, squared))
            except (LookupError, Unfit):  # no task of this seed can be set or drawn
                continue
            except Refused:
                unread += 1
    assert marked
    assert unread <= MOST_UNREAD * (len(marked) + unread)
    assert sum(one.guilty is not None for one in marked) <= max(1, FALSE_ALARMS * len(marked))
    assert 3 * sum((one.score.total or 0) >= ALMOST_ALL for one in marked) >= 2 * len(marked)


@pytest.mark.costly
def test_a_mistake_on_blank_paper_is_told(tmp_path: Path) -> None:
    """It is named, or marks are to be looked at, or missing, and few drawings cannot be read; mistakes of letters are
    left out, as nobody reads them."""
    told, unread = list[bool](), 0
    for name in DRAWN:
        for seed in MISTAKEN_SEEDS:
            try:
                if (fault := mistaken(name, seed).fault) and fault.kind != "letters":
                    marked = judged(name, seed, tmp_path, squared=False, fault=fault)
                    counts = marked.judgement.counts
                    told.append(marked.guilty is not None or counts["missing"] + counts["unsure"] > 0)
            except (LookupError, Unfit):  # no task of this seed can be set or drawn
                continue
            except Refused:
                unread += 1
    assert told
    assert all(told)
    assert unread <= MOST_UNREAD * (len(told) + unread)
