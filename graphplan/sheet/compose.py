"""A construction on its paper: the words that it needs, and then the best composition that holds them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache, partial
from typing import Any

from graphplan.sheet.composition import Composition, composed
from graphplan.sheet.deviations import Deviations
from graphplan.sheet.planes import Drawing, Planes
from graphplan.sheet.texts import Words
from graphplan.sheet.title import TitleBlock
from graphplan.words.tongue import ENGLISH, Tongue


def compose(drawing: Drawing, paper: str | None = None, check: Mapping[str, Any] | None = None,
            pencil: Deviations | None = None, tongue: Tongue = ENGLISH) -> Composition:
    """Where everything goes: on the paper named, or on the smallest good one.

    Fails with `Refused` where the words do not fit the paper named.
    """
    return Composer(drawing, paper, check, tongue).compose(pencil)


class Composer:
    """Composes a construction on its paper, as often as its drawing errors change; see :func:`compose`."""

    def __init__(self, drawing: Drawing, paper: str | None = None, check: Mapping[str, Any] | None = None,
                 tongue: Tongue = ENGLISH):
        self.planes, self.paper = Planes(drawing, tongue), paper
        self.words = Words(self.planes, check or {})
        self.title = TitleBlock(drawing.scene.title, drawing.scene.source, tongue)

    def compose(self, pencil: Deviations | None = None) -> Composition:
        """The composition with these drawing errors told on it."""
        rows = cache(partial(self.words.rows, pencil=pencil or Deviations()))
        return composed(self.planes, rows, cache(self.title.height), self.paper)
