"""Drawings of tasks of synthesis, judged: drawings by hand with choices of their own, and mistakes."""

from __future__ import annotations

from itertools import combinations, product
from pathlib import Path

import boards
import pytest


@pytest.mark.parametrize("ending", ["csv", "svg"])
def test_right_drawings_with_choices_of_their_own_are_right(ending: str, tmp_path: Path) -> None:
    """At any scale and turned, all turned back in another position, other bisectors, a ground nearly as good, mirrored
    where the task gives no place: of at most one in twenty a mark is called wrong."""
    alarms = [(name, seed) for name in boards.DRAWERS for seed in range(3)
              if not boards.is_right(boards.judged(name, boards.draw(name, seed), tmp_path / f"drawing.{ending}"))]
    assert 20 * len(alarms) <= 3 * len(boards.DRAWERS), alarms


@pytest.mark.parametrize(("of_O", "of_C"), [*product(combinations(range(4), 3), repeat=2)])
def test_a_centre_is_right_by_any_three_of_four_positions(of_O: tuple[int, ...], of_C: tuple[int, ...],
                                                          tmp_path: Path) -> None:
    """Each of both centres may be drawn by three positions of its own."""
    board = boards.draw("guidance-22-8", 0, O=of_O, C=of_C)
    assert boards.is_right(boards.judged("guidance-22-8", board, tmp_path / "drawing.csv"))


@pytest.mark.parametrize(("name", "slip"), [*boards.mistakes()])
def test_one_mistake_is_told_where_it_is_and_costs_once(name: str, slip: str, tmp_path: Path) -> None:
    """The first wrong mark is that of the mistake, and the drawing keeps 65 to 95 points."""
    sheets = [board for seed in range(3) if (board := boards.draw(name, seed, slip)).guilty]
    assert sheets
    assert all(boards.is_told(boards.judged(name, board, tmp_path / "drawing.csv"), board) for board in sheets)


@pytest.mark.parametrize("name", boards.DRAWERS)
def test_a_wholly_wrong_drawing_is_told(name: str, tmp_path: Path) -> None:
    """Letters that are scattered over a sheet earn next to nothing."""
    scores = [boards.judged(name, boards.scatter(name, seed), tmp_path / "drawing.csv")["score"]["total"]
              for seed in range(4)]
    assert sorted(scores)[1] < 20
    assert max(scores) < 65
