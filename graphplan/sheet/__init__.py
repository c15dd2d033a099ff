"""The sheet: where a construction goes on paper."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from graphplan.methods.construction import Construction
    from graphplan.sheet.layout.composition import Composition


def svg(drawing: Construction, paper: str | None = None, check: Mapping[str, Any] | None = None,
        composition: Composition | None = None, language: str | None = None) -> str:
    """The construction sheet as SVG text, in a language by its code, such as de; without it in that of the scene.

    Reads a construction, the name of a sheet (such as `A3` or `A4 portrait`; without it the smallest good one is
    taken) and what the check against the analytic solver found, by kind; or the composition of the sheet, if it is
    composed already, such as with the expected drawing errors. Fails with `Refused` where the words do not fit.
    """
    from graphplan.output.svg import svg as write
    from graphplan.sheet.layout.layout import layout

    return write(layout(composition or _compose(drawing, paper, check, language)))


def pdf(drawing: Construction, paper: str | None = None, check: Mapping[str, Any] | None = None,
        composition: Composition | None = None, language: str | None = None) -> bytes:
    """The construction sheet as a PDF document in true size, its words on further pages where they stand apart; reads
    and fails as :func:`svg` does."""
    from graphplan.output.pdf import pdf as write
    from graphplan.sheet.layout.layout import pages

    return write(pages(composition or _compose(drawing, paper, check, language)))


def png(drawing: Construction, paper: str | None = None, check: Mapping[str, Any] | None = None,
        composition: Composition | None = None, language: str | None = None, *, dpi: float = 150) -> bytes:
    """The construction sheet as a picture of so many dots per inch; else reads and fails as :func:`svg` does."""
    from graphplan.output.png import png as write
    from graphplan.sheet.layout.layout import layout

    return write(layout(composition or _compose(drawing, paper, check, language)), dpi)


def _compose(drawing: Construction, paper: str | None, check: Mapping[str, Any] | None,
             language: str | None) -> Composition:
    """Where all of it lies, in a language by its code."""
    from graphplan.cycle.motion_curves import traced_motion
    from graphplan.sheet.layout.composition import compose
    from graphplan.words.tongue import tongue

    say = tongue(language) if language else None
    return compose(drawing, paper, check, say, motion=traced_motion(drawing.scene))
