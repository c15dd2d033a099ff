"""A construction on its paper: the words that it needs, and then the best composition that holds them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from graphplan.sheet.composition import Composition, composed
from graphplan.sheet.deviations import Deviations
from graphplan.sheet.planes import Drawing, Planes
from graphplan.sheet.texts import Words
from graphplan.sheet.title import TitleBlock


def compose(drawing: Drawing, paper: str | None = None, check: Mapping[str, Any] | None = None,
            pencil: Deviations | None = None) -> Composition:
    """Where everything goes: on the paper named, or on the smallest good one.

    Fails with `Refused` where the words do not fit the paper named.
    """
    planes, block = Planes(drawing), TitleBlock(drawing.scene.title, drawing.scene.source)
    words = Words(planes, check or {}, pencil or Deviations())
    return composed(planes, cache(words.rows), block.height, paper)
