"""DXF files as CAD programs write them: layers, points, texts beside them, blocks, units and an origin of their own."""

from __future__ import annotations

import cmath
import io
import math
import random

import ezdxf
from ezdxf.enums import TextEntityAlignment

from judging.hand import Sketch, moved
from judging.vector import GREEK, Ink, inked, shown

UNITS = {"mm": (4, 1.0), "cm": (5, 0.1), "in": (1, 1 / 25.4), "unknown": (0, 1.0), "own": (0, 0.2), "m": (6, 0.001)}


def dxf(sketch: Sketch, seed: int) -> tuple[str, set[int]]:
    """A DXF file of LibreCAD or AutoCAD; and which steps it shows."""
    chance = random.Random(f"dxf {seed}")
    ink = inked(sketch, chance, sketch.task.size)
    unit = chance.choice(("mm", "mm", "mm", "unknown", "cm", "in", "own", "m"))
    header, scale = UNITS[unit]
    origin = chance.choice((0j, complex(chance.uniform(-500, 500), chance.uniform(-500, 500))))
    version = chance.choice(("R12", "R2000", "R2007", "R2010"))
    document = ezdxf.new(version, units=header)
    for layer in ("CONSTRUCTION", "TEXT"):
        document.layers.add(layer)
    _write(document, ink, chance, lambda at: scale * (at + origin), scale)
    text = io.StringIO()
    document.write(text)
    return text.getvalue(), shown(ink)


def _write(document: ezdxf.document.Drawing, ink: Ink, chance: random.Random, place, scale: float) -> None:  # type: ignore[no-untyped-def]
    """The entities, in model space or in a block of it."""
    space, lines = document.modelspace(), {"layer": chance.choice(("0", "CONSTRUCTION"))}
    if chance.random() < 0.2:
        space = document.blocks.new("DRAWING")
        document.modelspace().add_blockref("DRAWING", (0, 0))

    def at(z: complex) -> tuple[float, float]:
        z = place(z)
        return z.real, z.imag

    dot, ruled = chance.choice(("point", "point", "circle", "none", "circle")), chance.choice(("line", "line", "poly"))
    entities = [("stroke", one) for one in ink.strokes] + [("arc", one) for one in ink.arcs]
    if chance.random() < 0.3:
        chance.shuffle(entities)
    for kind, one in entities:
        if kind == "stroke":
            _, start, end = one
            if ruled == "line":
                space.add_line(at(start), at(end), dxfattribs=lines)
            elif document.dxfversion > "AC1009":
                space.add_lwpolyline([at(start), at(end)], dxfattribs=lines)
            else:
                space.add_polyline2d([at(start), at(end)], dxfattribs=lines)
        else:
            _, centre, radius, sweep = one
            if sweep is None:
                space.add_circle(at(centre), radius * scale, dxfattribs=lines)
            else:
                low, high = map(math.degrees, sweep)
                space.add_arc(at(centre), radius * scale, low, high, dxfattribs=lines)
    for _, spot in ink.dots:
        if dot == "point":
            space.add_point(at(spot), dxfattribs=lines)
        elif dot == "circle":
            space.add_circle(at(spot), 0.5 * scale, dxfattribs=lines)
    height, many = chance.uniform(2.5, 3.5), chance.random() < 0.3
    for _, middle, text in ink.letters:
        main, _, low = text.partition("_")
        written = (GREEK.get(main, main) if chance.random() < 0.5 else main) + f"_{low}" * bool(low)
        corner = middle - complex(0.3 * height * len(written), 0.4 * height)
        if many and document.dxfversion > "AC1009":
            space.add_mtext(written, dxfattribs={"char_height": height * scale, "layer": "TEXT", "insert":
                                                 at(middle), "attachment_point": 5})
        else:
            space.add_text(written, height=height * scale, dxfattribs={"layer": "TEXT"}).set_placement(
                at(corner), align=TextEntityAlignment.LEFT)


def turned(sketch: Sketch, seed: int) -> Sketch:
    """The drawing as it lies on a student's own sheet of a CAD program."""
    chance = random.Random(f"cad {seed}")
    turn = cmath.rect(1, math.radians(chance.choice((0.0, 0.0, chance.gauss(0, 3)))))
    return moved(sketch, lambda at: turn * at)
