"""On what it is drawn: one file a format, imported when it is called; its entry is here, or in a leaf."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

from graphplan.errors import Refused, missing_package
from graphplan.leaves import Format, leaves
from graphplan.phrases import said

FORMATS = {
    "json": Format(".json", said("the steps as data"), "", "", "steps"),
    "svg": Format(".svg", said("the sheet as SVG"), "graphplan.output.svg", "svg", "sheet"),
    "pdf": Format(".pdf", said("the sheet as PDF, in true size"), "graphplan.output.pdf", "pdf", "sheets"),
    "png": Format(".png", said("the sheet as a picture"), "graphplan.output.png", "png", "sheet"),
}


def formats() -> Mapping[str, Format]:
    """All formats, by name: those of leaves, and those of sheets."""
    return {name: format for leaf in leaves().values() for name, format in leaf.formats.items()} | FORMATS


def back_end(name: str) -> Callable[..., Any]:
    """The function that writes a format; fails with `Refused` where its library is not installed."""
    format = FORMATS.get(name) or formats().get(name)
    if format is None:
        raise Refused(f"format {name}", "there is no such format", f"one of {', '.join(formats())}")
    if not format.module:
        return str
    function: Callable[..., Any] = getattr(load_writer(format.module, format.extra), format.function)
    return function


def load_writer(module: str, extra: str) -> Any:
    """A module that needs the libraries of an `extra`; fails with `Refused` where one is not installed."""
    try:
        return import_module(module)
    except ModuleNotFoundError as missing:
        if not extra:
            raise
        raise missing_package(f"format {extra}", missing.name, extra, "another format") from None


def sheet_writer(name: str) -> Callable[..., Any]:
    """The function `write_sheet` of the leaf that writes a page of any sheet by this ending, else that of a format."""
    for leaf in leaves().values():
        if module := leaf.sheets.get(f".{name}"):
            write_sheet: Callable[..., Any] = import_module(module).write_sheet
            return write_sheet
    return back_end(name)
