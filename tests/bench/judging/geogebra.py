"""GeoGebra files: free and dependent objects under names of their own, in units of centimetres, letters as captions."""

from __future__ import annotations

import io
import random
import zipfile
from xml.sax.saxutils import quoteattr

from graphplan.kernel.kinds import LINE, OPENING, POINT
from judging.hand import Sketch, ends

SHOWN = '<show object="true" label="true"/>'
HIDDEN = '<show object="false" label="false"/>'


def ggb(sketch: Sketch, seed: int) -> tuple[bytes, set[int]]:
    """A file of GeoGebra, in which points bear the letters as names or captions; and which steps it shows."""
    chance, task = random.Random(f"ggb {seed}"), sketch.task
    per = chance.choice((1.0, 0.1, 0.1, 0.04))  # own units for a mm
    origin = complex(chance.uniform(-200, 0), chance.uniform(-200, 0))
    captions = chance.random() < 0.3
    body, shown, lettered = [], set(), 0

    def at(z: complex) -> complex:
        return per * (z + origin)

    def element(kind: str, name: str, coords: str, caption: str = "", extra: str = "") -> None:
        told = f"<caption val={quoteattr(caption)}/><labelMode val=\"3\"/>" if caption else ""
        body.append(f'<element type="{kind}" label={quoteattr(name)}>{SHOWN}{told}{extra}{coords}</element>')

    for step, place in zip(task.steps, sketch.places, strict=True):
        index, kind = step.index, step.op.gives
        if index in sketch.hidden or kind == OPENING:
            continue
        shown.add(index)
        spot, lettered = at(complex(*place[:2])), lettered + 1
        letter = sketch.letters[index]
        if kind == POINT:
            name = f"P_{{{lettered}}}" if captions or not letter else braced(letter)
            element("point", name, f'<coords x="{spot.real!r}" y="{spot.imag!r}" z="1.0"/>',
                    letter if captions else "")
        elif kind == LINE:
            if chance.random() < 0.5:
                start, end = map(at, ends(sketch, index, 3))
                a, b, c = start.imag - end.imag, end.real - start.real, 0.0
                c = -(a * start.real + b * start.imag)
                s, e = f"S_{{{lettered}}}", f"E_{{{lettered}}}"
                for one, z in ((s, start), (e, end)):
                    body.append(f'<element type="point" label="{one}">{HIDDEN}'
                                f'<coords x="{z.real!r}" y="{z.imag!r}" z="1.0"/></element>')
                name = f"s_{{{lettered}}}"
                body.append(f'<command name="Segment"><input a0="{s}" a1="{e}"/><output a0="{name}"/></command>')
                element("segment", name, f'<coords x="{a!r}" y="{b!r}" z="{c!r}"/>')
            else:
                a, b = -place[3], place[2]
                c = -(a * spot.real + b * spot.imag)
                element("line", f"g_{{{lettered}}}", f'<coords x="{a!r}" y="{b!r}" z="{c!r}"/>')
        else:
            r, x, y = place[2] * per, spot.real, spot.imag
            axes = '<eigenvectors x0="1.0" y0="0.0" z0="1.0" x1="-0.0" y1="1.0" z1="1.0"/>'
            element("conic", f"c_{{{lettered}}}", f'<matrix A0="1.0" A1="1.0" A2="{x * x + y * y - r * r!r}" '
                    f'A3="0.0" A4="{-x!r}" A5="{-y!r}"/>', extra=axes)
    xml = ('<?xml version="1.0" encoding="utf-8"?>\n<geogebra format="5.0" version="5.0.570.0" app="classic">'
           f'<construction title="" author="" date="">{"".join(body)}</construction></geogebra>')
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("geogebra.xml", xml)
        archive.writestr("geogebra_javascript.js", "function ggbOnInit() {}")
    return packed.getvalue(), shown


def braced(letter: str) -> str:
    """v_b2 as GeoGebra writes it."""
    main, _, low = letter.partition("_")
    return f"{main}_{{{low}}}" if len(low) > 1 else letter
