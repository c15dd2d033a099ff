"""SVG files as drawing programs write them: layers, transforms, dots as circles or strokes, letters beside them."""

from __future__ import annotations

import cmath
import math
import random
from collections.abc import Iterator
from dataclasses import dataclass, field
from xml.sax.saxutils import escape

from graphplan.kernel.kinds import LINE, OPENING, POINT
from judging.hand import Sketch, ends, swept

GREEK = {"alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "pi": "π"}


@dataclass
class Ink:
    """What is drawn, in mm of paper, y upward, whatever writes it."""

    dots: list[tuple[int, complex]] = field(default_factory=list)
    strokes: list[tuple[int, complex, complex]] = field(default_factory=list)
    arcs: list[tuple[int, complex, float, tuple[float, float] | None]] = field(default_factory=list)
    letters: list[tuple[int, complex, str]] = field(default_factory=list)  # the middle of the text


def inked(sketch: Sketch, chance: random.Random, page: tuple[float, float], numbers: bool = True) -> Ink:
    """Dots, strokes and arcs of a drawing, and the letters beside the dots: 1.5 to 5 mm off, wherever there is room.

    Marks without a letter bear their step's number in some files. What falls outside of the page is cut off.
    """
    ink, task = Ink(), sketch.task
    numbered = numbers and chance.random() < 0.5
    for step, place in zip(task.steps, sketch.places, strict=True):
        index, kind = step.index, step.op.gives
        if index in sketch.hidden or kind == OPENING:
            continue
        at = complex(*place[:2])
        if kind == POINT:
            ink.dots.append((index, at))
        elif kind == LINE:
            start, end = ends(sketch, index, chance.uniform(0.5, 6))
            ink.strokes.append((index, start, end))
        else:
            ink.arcs.append((index, at, place[2], swept(sketch, index)))
    for index, at in ink.dots:
        text = sketch.letters[index] or (str(task.number(index)) if numbered else "")
        if text and inside(at, page, 0):
            ink.letters.append((index, beside(at, text, ink, chance), text))
    return ink


def inside(at: complex, page: tuple[float, float], margin: float) -> bool:
    return -margin <= at.real <= page[0] + margin and -margin <= at.imag <= page[1] + margin


def beside(at: complex, text: str, ink: Ink, chance: random.Random) -> complex:
    """Where a letter is written: in any direction, rather not on another letter or dot, as a person sees to it."""
    def crowded(where: complex) -> float:
        taken = sum(abs(where - other) < 3.0 for _, other, _ in ink.letters)
        dots = sum(abs(where - dot) < abs(where - at) and dot != at for _, dot in ink.dots)
        return taken + 2 * dots
    tries = [at + cmath.rect(chance.uniform(1.5, 5.0) + 0.5 * (len(text) > 2), chance.uniform(0, math.tau))
             for _ in range(12)]
    return min(tries, key=crowded)


def svg(sketch: Sketch, seed: int) -> tuple[str, set[int]]:
    """An SVG file as Inkscape or Illustrator would write it, in mm, points or pixels; and which steps it shows."""
    chance = random.Random(f"svg {seed}")
    (width, height), inkscape = sketch.task.size, chance.random() < 0.6
    ink = inked(sketch, chance, (width, height))
    unit, per = chance.choice((("mm", 1.0), ("mm", 10.0), ("px", 96 / 25.4), ("pt", 72 / 25.4)))
    whole = 1.0 if unit == "mm" else per
    size = f'width="{width * whole:.3f}{unit}" height="{height * whole:.3f}{unit}"'
    head = (f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
            f'{size} viewBox="0 0 {width * per:.3f} {height * per:.3f}">')
    style = f"fill:none;stroke:#{chance.choice(('000', '333', '1a1a1a'))};stroke-width:{0.25 * per:.3f}"
    shapes = list(_shapes(ink, chance, height, per, style))
    if chance.random() < 0.3:
        chance.shuffle(shapes)
    texts = list(_texts(ink, chance, height, per, inkscape))
    if inkscape:
        dx, dy = chance.uniform(-40, 40), chance.uniform(-40, 40)
        body = (f'<g inkscape:groupmode="layer" inkscape:label="Layer 1" transform="translate({-dx:.4f},{-dy:.4f})">'
                f'<g transform="translate({dx:.4f},{dy:.4f})">{"".join(shapes)}</g></g>'
                f'<g inkscape:groupmode="layer" inkscape:label="Text" id="layer2">{"".join(texts)}</g>')
    else:
        both = shapes + texts
        body = f'<g id="Layer_1">{"".join(both)}</g>'
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{head}{body}</svg>\n', shown(ink)


def shown(ink: Ink) -> set[int]:
    """The steps of which there is any ink."""
    return {index for index, *_ in [*ink.dots, *ink.strokes, *ink.arcs]}


def _shapes(ink: Ink, chance: random.Random, height: float, per: float, style: str) -> Iterator[str]:
    """Strokes as lines, polylines or paths; arcs as paths; dots as circles, short strokes, or crosses, or none."""
    def at(z: complex) -> str:
        return f"{z.real * per:.3f},{(height - z.imag) * per:.3f}"

    dot = chance.choice(("circle", "circle", "circle", "ellipse", "ring", "cross"))
    ruled = chance.choice(("path", "path", "line", "polyline"))
    for _, start, end in ink.strokes:
        (x, y), (u, v) = at(start).split(","), at(end).split(",")
        yield {"path": f'<path style="{style}" d="M {x},{y} {u},{v}"/>',
               "line": f'<line style="{style}" x1="{x}" y1="{y}" x2="{u}" y2="{v}"/>',
               "polyline": f'<polyline style="{style}" points="{x},{y} {u},{v}"/>'}[ruled]
    for _, centre, radius, sweep in ink.arcs:
        if sweep is None:
            x, y = at(centre).split(",")
            yield f'<circle style="{style}" cx="{x}" cy="{y}" r="{radius * per:.3f}"/>'
            continue
        low, high = sweep
        one, other = centre + cmath.rect(radius, low), centre + cmath.rect(radius, high)
        r, large = f"{radius * per:.3f}", int(high - low > math.pi)
        yield f'<path style="{style}" d="M {at(one)} A {r} {r} 0 {large} 0 {at(other)}"/>'
    for _, spot in ink.dots:
        x, y = at(spot).split(",")
        r = f"{0.5 * per:.3f}"
        if dot == "cross":
            d = 0.8 * per
            yield (f'<path style="{style}" d="M {float(x) - d:.3f},{float(y) - d:.3f} l {2 * d:.3f},{2 * d:.3f} '
                   f'm 0,{-2 * d:.3f} l {-2 * d:.3f},{2 * d:.3f}"/>')
        elif dot == "ellipse":
            yield f'<ellipse style="fill:#000;stroke:none" cx="{x}" cy="{y}" rx="{r}" ry="{r}"/>'
        else:
            fill = "fill:#000;stroke:none" if dot == "circle" else style
            yield f'<circle style="{fill}" cx="{x}" cy="{y}" r="{r}"/>'


def _texts(ink: Ink, chance: random.Random, height: float, per: float, tspans: bool) -> Iterator[str]:
    """Letters; subscripts as smaller tspans, or plainly, Greek as such."""
    size = chance.uniform(2.8, 4.0)
    raised = chance.choice(("sub", "dy", "plain", "plain"))
    middle = chance.random() < 0.5
    for _, at, text in ink.letters:
        main, _, low = text.partition("_")
        main = GREEK.get(main, main)
        wide = 0.55 * size * (len(main) + 0.7 * len(low))
        x = (at.real - (0 if middle else wide / 2)) * per
        y = (height - at.imag + 0.35 * size) * per
        small = f"font-size:{0.65 * size * per:.2f}px"
        inner = escape(main) + {
            "sub": f'<tspan style="{small};baseline-shift:sub">{escape(low)}</tspan>',
            "dy": f'<tspan style="{small}" dy="{0.25 * size * per:.2f}">{escape(low)}</tspan>',
            "plain": escape(f"_{low}")}[raised] * bool(low)
        if tspans:
            inner = f'<tspan x="{x:.3f}" y="{y:.3f}">{inner}</tspan>'
        anchor = ";text-anchor:middle" if middle else ""
        yield (f'<text x="{x:.3f}" y="{y:.3f}" style="font-size:{size * per:.2f}px;font-family:sans-serif{anchor};'
               f'fill:#000">{inner}</text>')
