"""How the plans share their part of a sheet: the first has the larger share, the others stand beside or under it.

Two others stand in a stack or in a row. More stand in a grid, in reading order, each with room for what it has to show.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product

from graphplan.sheet.display import Rect

SHARES = (0.5, 0.55, 0.6, 0.66)


def divisions(plans: Rect, needs: Mapping[str, float]) -> Iterator[dict[str, Rect]]:
    """The ways to divide a region; `needs` says how much room each plan wants beside the others, in drawing order."""
    first, *rest = needs
    if not rest:
        yield {first: plans}
        return
    left, bottom, right, top = plans.left, plans.bottom, plans.right, plans.top
    many = range(1, len(rest) + 1) if len(rest) > 2 else ()
    grids = {count: _rows(rest, needs, count) for count in range(1, len(rest) + 1)}
    for share in SHARES:
        x, y = left + share * plans.width, bottom + (1 - share) * plans.height
        for even, count in product((False, True), many or (len(rest),)):
            yield {first: Rect(left, bottom, x, top), **_grid(Rect(x, bottom, right, top), needs, grids[count], even)}
        for even, count in product((False, True), many or (1,)):
            yield {first: Rect(left, y, right, top), **_grid(Rect(left, bottom, right, y), needs, grids[count], even)}


def _rows(panels: Sequence[str], needs: Mapping[str, float], count: int) -> list[list[str]]:
    """The plans in so many rows of about the same need, none of them empty."""
    rows: list[list[str]] = [[]]
    total, filled = sum(needs[panel] for panel in panels), 0.0
    for i, panel in enumerate(panels):
        middle = (filled + needs[panel] / 2) * count / total
        due = len(panels) - i <= count - len(rows)  # each row left gets a plan of its own
        if rows[-1] and len(rows) < count and (due or middle > len(rows)):
            rows.append([])
        rows[-1].append(panel)
        filled += needs[panel]
    return rows


def _grid(
    region: Rect, needs: Mapping[str, float], rows: Sequence[Sequence[str]], even: bool
) -> dict[str, Rect]:
    """Rows from the top, plans from the left: areas are as the needs, or the rows are of even height."""
    total, found, top = sum(needs[panel] for row in rows for panel in row), {}, region.top
    for row in rows:
        need, left = sum(needs[panel] for panel in row), region.left
        bottom = top - region.height * (1 / len(rows) if even else need / total)
        for panel in row:
            right = left + region.width * needs[panel] / need
            found[panel] = Rect(left, bottom, right, top)
            left = right
        top = bottom
    return found
