"""The sheet: where a construction goes on paper."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from graphplan.sheet.composition import Composition
    from graphplan.sheet.planes import Drawing


def svg(drawing: Drawing, paper: str | None = None, check: Mapping[str, Any] | None = None,
        composition: Composition | None = None, language: str = "en") -> str:
    """The construction sheet as SVG text, in a language by its code, such as de.

    Reads a construction, the name of a sheet (such as `A3` or `A4 portrait`; without it the smallest good one is
    taken) and what the check against the analytic solver found, by kind; or the composition of the sheet, if it is
    composed already, such as with the expected drawing errors. Fails with `Refused` where the words do not fit.
    """
    from graphplan.backends.svg import svg as write
    from graphplan.sheet.layout import layout
    from graphplan.words.tongue import tongue

    return write(layout(drawing, paper, check, composition, tongue(language)))
