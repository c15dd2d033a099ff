"""The profile of a cam in its own size for CAD programs and machines: closed, of arcs that keep a tolerance."""

from __future__ import annotations

import io

import ezdxf

from graphplan.cams.profile import Cam
from graphplan.output.cad.layers import FULL_SIZE
from graphplan.output.dxf import UNITS, declare_classes, without_date

PROFILE, PITCH, BASE, POINTS = (f"{FULL_SIZE} {part}" for part in ("profile", "pitch curve", "base circle", "points"))
PENS = {PROFILE: ("CONTINUOUS", 50), PITCH: ("DASHDOT", 18), BASE: ("DASHED", 18), POINTS: ("CONTINUOUS", 35)}
DASHES = {"DASHED": (6.0, 5.0, -1.0), "DASHDOT": (6.0, 4.0, -0.9, 0.2, -0.9)}


def profile_dxf(cam: Cam, tolerance: float) -> bytes:
    """The profile as a closed polyline of arcs, none further from it than the tolerance, about the cam's centre.

    Beside it, on layers of their own, are the base circle, the path of the roller's centre, and the centre.
    """
    with without_date():
        document, text = ezdxf.new("R2010", units=UNITS[cam.task.units.length]), io.StringIO()
        for name, (whole, *dashes) in DASHES.items():
            document.linetypes.add(name, [whole, *dashes])
        for name, (line, weight) in PENS.items():
            document.layers.add(name, linetype=line, lineweight=weight)
        space = document.modelspace()
        outline = [(arc.start.real, arc.start.imag, arc.bulge) for arc in cam.arcs(tolerance)]
        space.add_lwpolyline(outline, format="xyb", close=True, dxfattribs={"layer": PROFILE})
        space.add_circle((0, 0), cam.pair.base, dxfattribs={"layer": BASE})
        space.add_point((0, 0), dxfattribs={"layer": POINTS})
        if cam.roller:
            curve = [(z.real, z.imag) for z in map(complex, cam.pitch_curve)]
            space.add_lwpolyline(curve, close=True, dxfattribs={"layer": PITCH})
        document.header.custom_vars.append("Title", cam.task.title)
        document.header.custom_vars.append("Tolerance", repr(tolerance))
        declare_classes(document)
        document.write(text)
        return bytes(document.encode(text.getvalue()))
