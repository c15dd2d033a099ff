"""On what it is drawn: one file a format, imported when it is called; a format is known by its entry here."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any, NamedTuple

from graphplan.errors import Refused
from graphplan.phrases import Said, said


class Format(NamedTuple):
    """A format: how its files end, what it is in a line, and the back end: its module, what it is called and reads.

    Without a module what is read is written as it is. `extra` is what installs a library that it needs and that does
    not come with graphplan.
    """

    suffix: str
    told: Said
    module: str
    function: str
    reads: str
    extra: str = ""


FORMATS = {
    "ggb": Format(".ggb", said("GeoGebra, 4.0 and later"), "exports.geogebra", "geogebra", "plates"),
    "tikz": Format(".tex", said("LaTeX with TikZ"), "exports.tikz", "tikz", "composition"),
    "c": Format(".c", said("the numbers in C99, over arrays of poses"), "exports.code", "c", "construction"),
    "js": Format(".js", said("the numbers in JavaScript, in one pose or many"), "exports.code", "javascript",
                 "construction"),
    "json": Format(".json", said("the steps as data"), "", "", "steps"),
    "svg": Format(".svg", said("the sheet as SVG"), "svg", "svg", "sheet"),
    "pdf": Format(".pdf", said("the sheet as PDF, in true size"), "pdf", "pdf", "sheets"),
    "png": Format(".png", said("the sheet as a picture"), "png", "png", "sheet"),
    "dxf": Format(".dxf", said("the mechanism 1:1 and the sheet, for CAD"), "dxf", "dxf", "sheets on plates", "dxf"),
}


def back_end(name: str) -> Callable[..., Any]:
    """The function that writes a format; fails with `Refused` where its library is not installed."""
    format = FORMATS[name]
    if not format.module:
        return str
    function: Callable[..., Any] = getattr(load_writer(name, format.module), format.function)
    return function


def load_writer(name: str, module: str) -> Any:
    """A module of this folder that writes a format; fails as :func:`back_end` does."""
    try:
        return importlib.import_module(f"graphplan.output.{module}")
    except ModuleNotFoundError as missing:
        if not FORMATS[name].extra:
            raise
        raise Refused(f"format {name}", f"{missing.name} is not installed",
                      f"pip install 'graphplan[{FORMATS[name].extra}]', or another format") from None
