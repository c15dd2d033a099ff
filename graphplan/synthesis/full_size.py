"""A pair of wheels in their own size, for CAD programs and machines."""

from __future__ import annotations

from ezdxf.layouts import Modelspace

from graphplan.exports.dxf import full_size
from graphplan.synthesis.figure import wheel_outlines
from graphplan.synthesis.gear import GearPair
from graphplan.synthesis.sketch import Synthesis


def wheels_dxf(synthesis: Synthesis) -> bytes:
    """Draw both wheels in mesh: their outlines, reference and base circles, and centres, each kind on its layer."""
    task = synthesis.task
    gears = GearPair(task.request, task.name)

    def draw(space: Modelspace, layers: dict[str, dict[str, str]]) -> None:
        for outline in wheel_outlines(gears):
            space.add_lwpolyline([(z.real, z.imag) for z in outline], close=True, dxfattribs=layers["outline"])
        for centre, wheel in zip(((0.0, 0.0), (gears.centres, 0.0)), gears.wheels, strict=True):
            for name, radius in (("pitch", wheel.pitch), ("base", wheel.base)):
                space.add_circle(centre, radius, dxfattribs=layers[name])
            space.add_point(centre, dxfattribs=layers["points"])

    return full_size({"Title": task.title}, task.units.length, ("wheel", "pitch circle"), draw)
