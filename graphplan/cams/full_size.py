"""The profile of a cam in its own size, for CAD programs and machines."""

from __future__ import annotations

from ezdxf.layouts import Modelspace

from graphplan.cams.profile import Cam
from graphplan.exports.dxf import full_size


def profile_dxf(cam: Cam, tolerance: float) -> bytes:
    """The profile as a closed polyline of arcs, all within the tolerance, about the cam's centre.

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

    return full_size({"Title": cam.task.title, "Tolerance": repr(tolerance)}, cam.task.units.length,
                      ("profile", "pitch curve"), draw)
