"""How the plans share their part of a sheet: the first has the larger share, the others stand beside or under it.

Two others stand in a stack or in a row. More stand in rows or in columns, in reading order, each with room for what it
has to show.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from graphplan.sheet.plates.display import Rect

SHARES = (0.5, 0.55, 0.6, 0.66)


def divisions(plans: Rect, needs: Mapping[str, float]) -> Iterator[dict[str, Rect]]:
    """The ways to divide a region; `needs` says how much room each plan wants beside the others, in drawing order."""
    first, *rest = needs
    if not rest:
        yield {first: plans}
        return
    left, bottom, right, top = plans.left, plans.bottom, plans.right, plans.top
    others = {panel: needs[panel] for panel in rest}
    for share in SHARES:
        x, y = left + share * plans.width, bottom + (1 - share) * plans.height
        for division in _shared(Rect(x, bottom, right, top), others, len(rest)):
            yield {first: Rect(left, bottom, x, top), **division}
        for division in _shared(Rect(left, bottom, right, y), others, 1):
            yield {first: Rect(left, y, right, top), **division}


def _shared(region: Rect, needs: Mapping[str, float], few: int) -> Iterator[dict[str, Rect]]:
    """The ways in which plans share a region: one or two evenly in `few` rows, more in rows or columns."""
    if len(needs) < 3:
        yield _grid(region, dict.fromkeys(needs, 1.0), few)
        return
    for count in range(1, len(needs) + 1):
        yield _grid(region, needs, count)
        yield _grid(region, needs, count, even=True)
        yield {panel: _turned(rect) for panel, rect in _grid(_turned(region), needs, count).items()}


def _grid(region: Rect, needs: Mapping[str, float], count: int, even: bool = False) -> dict[str, Rect]:
    """Rows from the top, plans from the left: areas are as the needs, or the rows are of even height."""
    total, found, top = sum(needs.values()), dict[str, Rect](), region.top
    for row in _rows(needs, count):
        need, left = sum(needs[panel] for panel in row), region.left
        bottom = top - region.height * (1 / count if even else need / total)
        for panel in row:
            right = left + region.width * needs[panel] / need
            found[panel] = Rect(left, bottom, right, top)
            left = right
        top = bottom
    return found


def _rows(needs: Mapping[str, float], count: int) -> Sequence[Sequence[str]]:
    """The plans in so many rows of about the same need, none of them empty."""
    rows: list[list[str]] = [[]]
    total, filled = sum(needs.values()), 0.0
    for i, (panel, need) in enumerate(needs.items()):
        due = len(needs) - i <= count - len(rows)  # each row left gets a plan of its own
        if rows[-1] and len(rows) < count and (due or (filled + need / 2) * count / total > len(rows)):
            rows.append([])
        rows[-1].append(panel)
        filled += need
    return rows


def _turned(rect: Rect) -> Rect:
    """Right and down exchanged: what were rows are columns. Turned twice, a rectangle is as before."""
    return Rect(-rect.top, -rect.right, -rect.bottom, -rect.left)
