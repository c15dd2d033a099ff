"""Parts in their own size for CAD programs and machines: closed outlines, their circles and centres."""

from __future__ import annotations

import io
from collections.abc import Callable

import ezdxf
from ezdxf.layouts import Modelspace

from graphplan.exports.cad.layers import FULL_SIZE
from graphplan.exports.dxf import UNITS, declare_classes, without_date

LINES = {"outline": ("CONTINUOUS", 50), "pitch": ("DASHDOT", 18), "base": ("DASHED", 18), "points": ("CONTINUOUS", 35)}
DASHES = {"DASHED": (6.0, 5.0, -1.0), "DASHDOT": (6.0, 4.0, -0.9, 0.2, -0.9)}


def full_size(properties: dict[str, str], unit: str, names: tuple[str, str],
               draw: Callable[[Modelspace, dict[str, dict[str, str]]], None]) -> bytes:
    """A drawing true to size: `names` are what its outlines and pitch curves are called."""
    layers = dict(zip(LINES, (*names, "base circle", "points"), strict=True))
    with without_date():
        document, text = ezdxf.new("R2010", units=UNITS[unit]), io.StringIO()
        for name, (whole, *dashes) in DASHES.items():
            document.linetypes.add(name, [whole, *dashes])
        for name, (line, weight) in LINES.items():
            document.layers.add(f"{FULL_SIZE} {layers[name]}", linetype=line, lineweight=weight)
        draw(document.modelspace(), {name: {"layer": f"{FULL_SIZE} {layer}"} for name, layer in layers.items()})
        for name, value in properties.items():
            document.header.custom_vars.append(name, value)
        declare_classes(document)
        document.write(text)
        return bytes(document.encode(text.getvalue()))
