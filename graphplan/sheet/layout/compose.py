"""A construction on its paper: the words that it needs, and then the best composition that holds them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache, partial
from typing import Any

from graphplan.methods.construction import Construction
from graphplan.sheet.frames.frame import frame_of
from graphplan.sheet.layout.composition import Composition, composed
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.words.deviations import Deviations
from graphplan.sheet.words.texts import Words
from graphplan.words.tongue import Tongue
from graphplan.words.tongue import tongue as tongue_of


def compose(drawing: Construction, paper: str | None = None, check: Mapping[str, Any] | None = None,
            pencil: Deviations | None = None, tongue: Tongue | None = None) -> Composition:
    """Where everything goes: on the paper named, here or by the scene, or on the smallest good one.

    Without a tongue it speaks that of the scene's sheet.

    Fails with `Refused` where the words do not fit the paper named.
    """
    return Composer(drawing, paper, check, tongue).compose(pencil)


class Composer:
    """Composes a construction on its paper, as often as its drawing errors change; see :func:`compose`."""

    def __init__(self, drawing: Construction, paper: str | None = None, check: Mapping[str, Any] | None = None,
                 tongue: Tongue | None = None):
        scene = drawing.scene
        say = tongue or tongue_of(scene.sheet.language or "en")
        self.plans, self.paper = Plans(drawing, say), paper or scene.sheet.paper or None
        self.words, self.title = Words(self.plans, check or {}), frame_of(scene).block(scene, say)

    def compose(self, pencil: Deviations | None = None) -> Composition:
        """The composition with these drawing errors told on it."""
        rows = cache(partial(self.words.rows, pencil=pencil or Deviations()))
        return composed(self.plans, rows, self.title, self.paper)
