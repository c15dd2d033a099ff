"""The sheet: where a construction goes on paper."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from graphplan.app.construction import WorkingDrawing


def svg(drawing: WorkingDrawing, paper: str | None = None, language: str | None = None) -> str:
    """The first page of the construction sheet as SVG text, byte for byte as `graphplan draw` writes it.

    Reads a construction, the name of a sheet (such as `A3` or `A4 portrait`; without it the smallest good one is
    taken), and a language by its code, such as de; without it that of the scene. Fails with `Refused` where the words
    do not fit.
    """
    return str(_first_file(drawing, "svg", paper, language))


def pdf(drawing: WorkingDrawing, paper: str | None = None, language: str | None = None) -> bytes:
    """The construction sheet as a PDF document in true size, its words on further pages where they stand apart; reads
    and fails as :func:`svg` does."""
    return bytes(_first_file(drawing, "pdf", paper, language))


def png(drawing: WorkingDrawing, paper: str | None = None, language: str | None = None, *, dpi: int = 150) -> bytes:
    """The construction sheet as a picture of so many dots per inch; else reads and fails as :func:`svg` does."""
    return bytes(_first_file(drawing, "png", paper, language, dpi))


def _first_file(drawing: WorkingDrawing, name: str, paper: str | None, language: str | None,
                dpi: int | None = None) -> Any:
    from graphplan.app.drafting import with_sheet
    from graphplan.app.pages import sheet_files

    scene = with_sheet(drawing.given_scene or drawing.scene, {"paper": paper, "language": language})
    return sheet_files(scene, None, name, dpi=dpi).contents[0][1]
