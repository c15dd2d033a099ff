"""Gear wheels in their own size for CAD programs and machines: closed outlines, their circles and centres."""

from __future__ import annotations

import io

import ezdxf

from graphplan.output.cad.layers import FULL_SIZE
from graphplan.output.cad.profile import DASHES
from graphplan.output.dxf import UNITS, declare_classes, without_date
from graphplan.output.subjects.synthesis_figure import wheel_outlines
from graphplan.synthesis.gear import GearPair
from graphplan.synthesis.sketch import Synthesis

WHEEL, PITCH, BASE, POINTS = (f"{FULL_SIZE} {part}" for part in ("wheel", "pitch circle", "base circle", "points"))
PENS = {WHEEL: ("CONTINUOUS", 50), PITCH: ("DASHDOT", 18), BASE: ("DASHED", 18), POINTS: ("CONTINUOUS", 35)}


def wheels_dxf(synthesis: Synthesis) -> bytes:
    """Both wheels in mesh: their outlines, reference and base circles, and centres, each kind on its layer."""
    task = synthesis.task
    gears = GearPair(task.request, task.name)
    with without_date():
        document, text = ezdxf.new("R2010", units=UNITS[task.units.length]), io.StringIO()
        for name, (whole, *dashes) in DASHES.items():
            document.linetypes.add(name, [whole, *dashes])
        for name, (line, weight) in PENS.items():
            document.layers.add(name, linetype=line, lineweight=weight)
        space = document.modelspace()
        for outline in wheel_outlines(gears):
            space.add_lwpolyline([(z.real, z.imag) for z in outline], close=True, dxfattribs={"layer": WHEEL})
        for centre, wheel in zip(((0.0, 0.0), (gears.centres, 0.0)), gears.wheels, strict=True):
            for layer, radius in ((PITCH, wheel.pitch), (BASE, wheel.base)):
                space.add_circle(centre, radius, dxfattribs={"layer": layer})
            space.add_point(centre, dxfattribs={"layer": POINTS})
        document.header.custom_vars.append("Title", task.title)
        declare_classes(document)
        document.write(text)
        return bytes(document.encode(text.getvalue()))
