"""Cams and gear wheels in their own size for CAD programs and machines: closed outlines, their circles and centres."""

from __future__ import annotations

import io
from collections.abc import Callable

import ezdxf
from ezdxf.layouts import Modelspace

from graphplan.cams.profile import Cam
from graphplan.output.cad.layers import FULL_SIZE
from graphplan.output.dxf import UNITS, declare_classes, without_date
from graphplan.output.subjects.synthesis_figure import wheel_outlines
from graphplan.synthesis.gear import GearPair
from graphplan.synthesis.sketch import Synthesis

LINES = {"outline": ("CONTINUOUS", 50), "pitch": ("DASHDOT", 18), "base": ("DASHED", 18), "points": ("CONTINUOUS", 35)}
DASHES = {"DASHED": (6.0, 5.0, -1.0), "DASHDOT": (6.0, 4.0, -0.9, 0.2, -0.9)}


def profile_dxf(cam: Cam, tolerance: float) -> bytes:
    """The profile as a closed polyline of arcs, none further from it than the tolerance, about the cam's centre.

    Beside it, on layers of their own, are the base circle, the path of the roller's centre, and the centre.
    """
    def draw(space: Modelspace, layers: dict[str, dict[str, str]]) -> None:
        outline = [(arc.start.real, arc.start.imag, arc.bulge) for arc in cam.arcs(tolerance)]
        space.add_lwpolyline(outline, format="xyb", close=True, dxfattribs=layers["outline"])
        space.add_circle((0, 0), cam.pair.base, dxfattribs=layers["base"])
        space.add_point((0, 0), dxfattribs=layers["points"])
        if cam.roller:
            curve = [(z.real, z.imag) for z in map(complex, cam.pitch_curve)]
            space.add_lwpolyline(curve, close=True, dxfattribs=layers["pitch"])

    return _full_size({"Title": cam.task.title, "Tolerance": repr(tolerance)}, cam.task.units.length,
                      ("profile", "pitch curve"), draw)


def wheels_dxf(synthesis: Synthesis) -> bytes:
    """Both wheels in mesh: their outlines, reference and base circles, and centres, each kind on its layer."""
    task = synthesis.task
    gears = GearPair(task.request, task.name)

    def draw(space: Modelspace, layers: dict[str, dict[str, str]]) -> None:
        for outline in wheel_outlines(gears):
            space.add_lwpolyline([(z.real, z.imag) for z in outline], close=True, dxfattribs=layers["outline"])
        for centre, wheel in zip(((0.0, 0.0), (gears.centres, 0.0)), gears.wheels, strict=True):
            for name, radius in (("pitch", wheel.pitch), ("base", wheel.base)):
                space.add_circle(centre, radius, dxfattribs=layers[name])
            space.add_point(centre, dxfattribs=layers["points"])

    return _full_size({"Title": task.title}, task.units.length, ("wheel", "pitch circle"), draw)


def _full_size(properties: dict[str, str], unit: str, names: tuple[str, str],
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
