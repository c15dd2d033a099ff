"""Hand drawings as the files of several drawing programs."""

from __future__ import annotations

import cmath
import io
import math
import random
import zipfile
from collections.abc import Callable
from html import escape

import ezdxf
from hand_drawings import Drawing

HEIGHT, WIDTH, BEYOND_MM, LETTER_MM = 297.0, 420.0, 3.0, 3.5


def lines(drawing: Drawing) -> list[tuple[complex, complex]]:
    """The strokes, drawn on beyond their ends."""
    return [(one, other + BEYOND_MM * ((one, other) not in drawing.board.arrows) * (other - one) / abs(other - one))
            for one, other in drawing.board.strokes if abs(other - one) > 0.5]


def arc_angles(arc: tuple[complex, complex, complex]) -> tuple[complex, float, float, float]:
    """The centre, the radius, and the angles of the ends in degrees, counterclockwise."""
    centre, *ends = arc
    first, last = (math.degrees(cmath.phase(end - centre)) for end in ends)
    return centre, abs(ends[0] - centre), first, last if last > first else last + 360


def svg(drawing: Drawing) -> bytes:
    """The drawing as a program of geometry draws it, with letters beside its dots."""
    rows = ['<svg xmlns="http://www.w3.org/2000/svg" width="420mm" height="297mm" viewBox="0 0 420 297">']
    for one, other in drawing.board.strokes:
        if abs(other - one) > 0.5:
            other += 0 if (one, other) in drawing.board.arrows else (other - one) / abs(other - one) * 3
            rows.append(f'<line x1="{one.real:.2f}" y1="{297 - one.imag:.2f}" x2="{other.real:.2f}" '
                        f'y2="{297 - other.imag:.2f}" stroke="black" stroke-width=".25"/>')
    for corners in drawing.heads:
        points = " ".join(f"{z.real:.2f},{297 - z.imag:.2f}" for z in corners)
        rows.append(f'<polygon points="{points}" fill="black"/>')
    for (_, letter), z in drawing.board.marks.items():
        rows.append(f'<circle cx="{z.real:.2f}" cy="{297 - z.imag:.2f}" r=".5"/>'
                    f'<text x="{z.real + 1:.2f}" y="{296 - z.imag:.2f}" font-size="3.5">{escape(letter)}</text>')
    for centre, start, end in drawing.board.arcs:
        r = abs(start - centre)
        rows.append(f'<path d="M {start.real:.2f} {297 - start.imag:.2f} A {r:.2f} {r:.2f} 0 0 0 {end.real:.2f} '
                    f'{297 - end.imag:.2f}" fill="none" stroke="black" stroke-width=".25"/>')
    return "\n".join([*rows, "</svg>\n"]).encode()


def inkscape(drawing: Drawing) -> bytes:
    """Layers, one of them moved; paths with relative moves; letters of several pieces in a style of their own."""
    scale = 96 / 25.4
    rows = ['<?xml version="1.0" encoding="UTF-8" standalone="no"?>',
            f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
            f'width="{WIDTH}mm" height="{HEIGHT}mm" viewBox="0 0 {WIDTH * scale:.4f} {HEIGHT * scale:.4f}">',
            '<defs><marker id="Arrow" orient="auto" style="overflow:visible"><path style="fill:#000000" '
            'd="M 0,0 -8,2.5 -8,-2.5 Z"/></marker></defs>'
            '<g inkscape:groupmode="layer" inkscape:label="Layer 1" transform="translate(-30,40)">']

    def at(z: complex) -> tuple[float, float]:
        return scale * z.real + 30, scale * (HEIGHT - z.imag) - 40

    for one, other in lines(drawing):
        (x, y), (u, v) = at(one), at(other)
        rows.append(f'<path style="fill:none;stroke:#000000;stroke-width:1" d="m {x:.3f},{y:.3f} {u - x:.3f},'
                    f'{v - y:.3f}"/>')
    for one, other in drawing.board.arrows:
        (x, y), (u, v) = at(one), at(other)
        rows.append(f'<path style="stroke:#000000;stroke-width:1;marker-end:url(#Arrow)" d="M {x:.3f},{y:.3f} '
                    f'{u:.3f},{v:.3f}"/>')
    for centre, start, end in drawing.board.arcs:
        (x, y), (u, v), r = at(start), at(end), scale * abs(start - centre)
        rows.append(f'<path style="fill:none;stroke:#000000;stroke-width:1" d="m {x:.3f},{y:.3f} a {r:.3f},{r:.3f} 0 0 '
                    f'0 {u - x:.3f},{v - y:.3f}"/>')
    for letter, z in drawing.letters:
        (x, y), (base, _, low) = at(z), letter.partition("_")
        low = f'<tspan style="font-size:65%;baseline-shift:sub">{escape(low)}</tspan>' if low else ""
        rows.append(f'<circle style="fill:#000000" cx="{x:.3f}" cy="{y:.3f}" r="1.8"/><text style="font-size:13px;'
                    f'font-family:sans-serif" x="{x + 4:.2f}" y="{y - 4:.2f}"><tspan x="{x + 4:.2f}" y="{y - 4:.2f}">'
                    f'{escape(base, quote=False)}{low}</tspan></text>')
    return "\n".join([*rows, "</g></svg>\n"]).encode()


def illustrator(drawing: Drawing) -> bytes:
    """Points of a 72nd of an inch, classes, polylines, letters placed by matrices, dots as paths."""
    scale = 72 / 25.4
    wide, high = WIDTH * scale, HEIGHT * scale
    rows = [f'<svg version="1.1" xmlns="http://www.w3.org/2000/svg" width="{wide:.2f}pt" height="{high:.2f}pt" '
            f'viewBox="0 0 {wide:.2f} {high:.2f}"><style type="text/css">.st0{{fill:none;stroke:#1D1D1B;'
            'stroke-width:0.5;}.st1{font-family:\'Helvetica\';}.st2{font-size:9px;}</style><g id="Layer_1">']

    def at(z: complex) -> tuple[float, float]:
        return scale * z.real, scale * (HEIGHT - z.imag)

    for one, other in lines(drawing):
        (x, y), (u, v) = at(one), at(other)
        rows.append(f'<polyline class="st0" points="{x:.2f},{y:.2f} {u:.2f},{v:.2f} "/>')
    for arc in drawing.board.arcs:
        centre, radius, first, last = arc_angles(arc)
        parts = max(1, round((last - first) / 45))
        turn = math.radians((last - first) / parts)
        reach = complex(1, 4 / 3 * math.tan(turn / 4))
        x, y = at(arc[1])
        text = f"M{x:.2f},{y:.2f}"
        for k in range(parts):
            u = cmath.rect(radius, math.radians(first) + k * turn)
            w = u * cmath.rect(1, turn)
            text += "C" + ",".join(f"{c:.2f}" for z in (u * reach, w * reach.conjugate(), w) for c in at(centre + z))
        rows.append(f'<path class="st0" d="{text}"/>')
    for corners in drawing.heads:
        rows.append('<path d="M' + "L".join(f"{x:.2f},{y:.2f}" for x, y in map(at, corners)) + 'z"/>')
    for letter, z in drawing.letters:
        x, y = at(z)
        r, k = 1.4, 0.77
        rows.append(f'<path d="M{x + r:.2f},{y:.2f}c0,{k:.2f}-{r - k:.2f},{r:.2f}-{r:.2f},{r:.2f}s-{r:.2f}-{r - k:.2f}-'
                    f'{r:.2f}-{r:.2f}s{r - k:.2f}-{r:.2f},{r:.2f}-{r:.2f}S{x + r:.2f},{y - k:.2f},{x + r:.2f},{y:.2f}z"'
                    f'/><text transform="matrix(1 0 0 1 {x + 3:.2f} {y - 3:.2f})" class="st1 st2">'
                    f'{escape(letter, quote=False)}</text>')
    return "\n".join([*rows, "</g></svg>\n"]).encode()


def _dxf(document: ezdxf.document.Drawing) -> bytes:
    text = io.StringIO()
    document.write(text)
    return document.encode(text.getvalue())


def dxf_lines(drawing: Drawing) -> bytes:
    """Of an old and simple program: lines, small circles and texts, in mm."""
    document = ezdxf.new("R12")
    space = document.modelspace()
    for one, other in lines(drawing):
        space.add_line((one.real, one.imag), (other.real, other.imag))
    for centre, radius, first, last in map(arc_angles, drawing.board.arcs):
        space.add_arc((centre.real, centre.imag), radius, first, last)
    for tip, *barbs in drawing.heads:
        for barb in barbs:
            space.add_line((tip.real, tip.imag), (barb.real, barb.imag))
    for letter, z in drawing.letters:
        space.add_circle((z.real, z.imag), 0.5)
        space.add_text(letter, height=LETTER_MM).set_placement((z.real + 1, z.imag + 1))
    return _dxf(document)


def dxf_blocks(drawing: Drawing) -> bytes:
    """Of a large program, in inches: polylines, dots as blocks, texts of many lines with formats."""
    document = ezdxf.new("R2010", units=ezdxf.units.IN)
    space, inch = document.modelspace(), 25.4
    block = document.blocks.new("DOT")
    block.add_point((0, 0))
    block.add_circle((0, 0), 0.5 / inch)
    for one, other in lines(drawing):
        space.add_lwpolyline([(one.real / inch, one.imag / inch), (other.real / inch, other.imag / inch)])
    for centre, radius, first, last in map(arc_angles, drawing.board.arcs):
        ends = (centre + cmath.rect(radius, math.radians(angle)) for angle in (first, last))
        bulges = math.tan(math.radians(last - first) / 4), 0.0
        space.add_lwpolyline([(end.real / inch, end.imag / inch, 0, 0, bulge)
                              for end, bulge in zip(ends, bulges, strict=True)])
    for corners in drawing.heads:
        space.add_solid([(z.real / inch, z.imag / inch) for z in (*corners, corners[-1])])
    for letter, z in drawing.letters:
        space.add_blockref("DOT", (z.real / inch, z.imag / inch))
        space.add_mtext(rf"{{\fArial|b0|i0;{letter}}}", dxfattribs={
            "insert": ((z.real + 1) / inch, (z.imag + 1 + LETTER_MM) / inch), "char_height": LETTER_MM / inch})
    return _dxf(document)


def dxf_points(drawing: Drawing) -> bytes:
    """Of a program that says no unit: points, old polylines, texts set by their middle, on layers."""
    document = ezdxf.new("R2000")
    document.header["$INSUNITS"] = 0
    space = document.modelspace()
    for name in ("Lines", "Letters"):
        document.layers.add(name)
    for one, other in lines(drawing):
        space.add_polyline2d([(one.real, one.imag), (other.real, other.imag)], dxfattribs={"layer": "Lines"})
    for centre, radius, first, last in map(arc_angles, drawing.board.arcs):
        space.add_arc((centre.real, centre.imag), radius, first, last, dxfattribs={"layer": "Lines"})
    for corners in drawing.heads:
        space.add_solid([(z.real, z.imag) for z in (*corners, corners[-1])], dxfattribs={"layer": "Lines"})
    for letter, z in drawing.letters:
        space.add_point((z.real, z.imag), dxfattribs={"layer": "Lines"})
        wide = 0.6 * LETTER_MM * len(letter)
        space.add_text(letter, height=LETTER_MM, dxfattribs={"layer": "Letters"}).set_placement(
            (z.real + 1 + wide / 2, z.imag + 1 + LETTER_MM / 2), align=ezdxf.enums.TextEntityAlignment.MIDDLE_CENTER)
    return _dxf(document)


def geogebra(drawing: Drawing) -> bytes:
    """In cm, the points in another order than they were found, with captions; segments between them."""
    marks = list(drawing.letters)
    random.Random(len(marks)).shuffle(marks)
    labels, rows = {}, list[str]()
    for number, (letter, z) in enumerate(marks):
        labels[z] = label = f"P_{{{number}}}"
        rows.append(f'<element type="point" label="{label}"><show object="true" label="true"/><labelMode val="3"/>'
                    f'<caption val="{escape(letter)}"/><coords x="{z.real / 10!r}" y="{z.imag / 10!r}" z="1.0"/>'
                    '</element>')
    for number, (one, other) in enumerate(drawing.board.strokes):
        ends = [labels.get(z, f"({z.real / 10!r}, {z.imag / 10!r})") for z in (one, other)]
        a, b = other.imag - one.imag, one.real - other.real
        if abs(other - one) > 0.5:
            kind = "Vector" if (one, other) in drawing.board.arrows else "Segment"
            rows.append(f'<command name="{kind}"><input a0="{ends[0]}" a1="{ends[1]}"/><output a0="s_{{{number}}}"/>'
                        f'</command><element type="{kind.lower()}" label="s_{{{number}}}"><show object="true"/>'
                        f'<coords x="{-a!r}" y="{-b!r}" z="{(a * one.real + b * one.imag) / 10!r}"/></element>')
    for number, (centre, start, end) in enumerate(drawing.board.arcs):
        x, y, square = centre.real / 10, centre.imag / 10, abs(start - centre) ** 2 / 100
        inputs = " ".join(f'a{k}="({z.real / 10!r}, {z.imag / 10!r})"' for k, z in enumerate((centre, start, end)))
        rows.append(f'<command name="CircleArc"><input {inputs}/><output a0="c_{{{number}}}"/></command>'
                    f'<element type="conicpart" label="c_{{{number}}}"><show object="true"/><matrix A0="1" A1="1" '
                    f'A2="{x * x + y * y - square!r}" A3="0" A4="{-x!r}" A5="{-y!r}"/></element>')
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("geogebra.xml", '<geogebra format="5.0"><construction title="">' + "".join(rows)
                         + "</construction></geogebra>")
    return data.getvalue()


FORMATS: dict[str, tuple[str, Callable[[Drawing], bytes]]] = {
    "csv": (".csv", lambda drawing: drawing.text.encode()), "svg": (".svg", svg),
    "inkscape": (".svg", inkscape), "illustrator": (".svg", illustrator), "dxf lines": (".dxf", dxf_lines),
    "dxf blocks": (".dxf", dxf_blocks), "dxf points": (".dxf", dxf_points), "geogebra": (".ggb", geogebra),
}
PROGRAMS = [form for form in FORMATS if form != "csv"]
