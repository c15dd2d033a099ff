"""What a sheet measures, read from its SVG alone: whether it can be read and measured with a ruler.

`python tests/sheet/measured.py [-o FILE.md] [SCENE ...]` prints a row for each packaged scene, or for those named.
"""

from __future__ import annotations

import argparse
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import combinations
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
import shapely
import shapely.prepared
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath
from numpy.typing import NDArray

NS = "{http://www.w3.org/2000/svg}"
FONT = FontProperties(family="DejaVu Sans")
CAPITALS = 0.729  # of the size of the letters
MARK = 0.7  # mm: the radius of a mark's circle is no larger, that of a pair's is
TOUCHED = 0.02  # mm²: letters that share less are apart
NEAR = 0.1  # mm by which a stroke may touch the box of letters
SHORTEST, SMALL = 5.0, 0.02  # mm of a vector that is asked for, and of the largest of its kind what may be shorter
SAME = 1e-9  # of a line, beside its distance from the origin
ROUND = {1.0, 2.0, 2.5, 4.0, 5.0}


@dataclass(frozen=True)
class Label:
    """Letters on a plan: the layer or step that they belong to, what they say, and the box of their ink."""

    key: str
    text: str
    box: shapely.Geometry
    capitals: float


@dataclass(frozen=True)
class Stroke:
    """A line, an arc or a circle, with the layer or step that it belongs to."""

    key: str
    line: shapely.Geometry


@dataclass(frozen=True)
class MeasuredSheet:
    """A sheet as its SVG tells it: panels by plan, labels and strokes on them, marks by step, vectors asked for."""

    root: ET.Element

    @classmethod
    def of(cls, svg: str) -> MeasuredSheet:
        """The sheet of an SVG text."""
        return cls(ET.fromstring(svg.encode()))

    @property
    def page(self) -> float:
        """The area of the paper, mm²."""
        _, _, wide, high = map(float, self.root.get("viewBox", "").split())
        return wide * high

    @cached_property
    def panels(self) -> dict[str, shapely.Geometry]:
        """The panel of each plan."""
        return {rect.get("data-plan", ""): shapely.box(x, y, x + wide, y + high)
                for rect in self.root.iter(f"{NS}rect") if rect.get("class") == "panel"
                for x, y, wide, high in [[float(rect.get(name, 0)) for name in ("x", "y", "width", "height")]]}

    @cached_property
    def plans(self) -> shapely.Geometry:
        """All panels as one area."""
        return shapely.union_all([*self.panels.values()])

    @cached_property
    def elements(self) -> list[tuple[str, ET.Element]]:
        """What is drawn, each with the layer or step of its group; paper and border are left out."""
        groups = [(g.get("data-step") or g.get("class", ""), g) for g in self.root.findall(f"{NS}g")]
        return [(key, element) for key, group in groups if key not in ("layer-paper", "layer-border", "layer-results")
                for element in group.iter()]

    @cached_property
    def labels(self) -> list[Label]:
        """The letters on the plans; captions and protocols are none."""
        near = shapely.prepared.prep(self.plans.buffer(0.1))
        return [label(key, element) for key, element in self.elements
                if element.tag == f"{NS}text" and key != "layer-text"
                and near.contains(shapely.Point(float(element.get("x", 0)), float(element.get("y", 0))))]

    @cached_property
    def strokes(self) -> list[Stroke]:
        """The lines on the plans, circles of marks and pairs among them."""
        lines = [(key, line) for key, element in self.elements for line in stroked(element)]
        return [Stroke(key, line) for key, line in lines if self.plans.intersects(line)]

    @cached_property
    def marks(self) -> list[tuple[str, shapely.Geometry]]:
        """The marks of steps, by step."""
        return [(key, shapely.Point(float(e.get("cx", 0)), float(e.get("cy", 0)))) for key, e in self.elements
                if e.tag == f"{NS}circle" and key.isdigit() and float(e.get("r", 0)) <= MARK]

    @cached_property
    def vectors(self) -> list[tuple[str, float]]:
        """What each vector asked for is, such as velocity A, and its length in mm."""
        arrows = [e for _, e in self.elements if e.get("data-vector")]
        ends = [[np.array(e.get(end, "").split(), float) for end in ("data-from", "data-to")] for e in arrows]
        return [(e.get("data-vector", ""), float(np.hypot(*(end - start))))
                for e, (start, end) in zip(arrows, ends, strict=True)]

    # ---- what is counted --------------------------------------------------------------------------------------

    @property
    def labels_on_labels(self) -> list[tuple[str, str]]:
        """Letters that cover other letters."""
        return [(a.text, b.text) for a, b in combinations(self.labels, 2)
                if a.box.intersects(b.box) and a.box.intersection(b.box).area > TOUCHED]

    @property
    def lines_through_labels(self) -> list[tuple[str, str]]:
        """Letters through which a line of another step goes, with that step."""
        tree = shapely.STRtree([stroke.line for stroke in self.strokes])
        cores = [(one, one.box.buffer(-NEAR)) for one in self.labels]
        return [(one.text, self.strokes[k].key) for one, core in cores if not core.is_empty
                for k in tree.query(core, predicate="intersects") if self.strokes[k].key != one.key]

    @property
    def labels_nearer_to_others(self) -> list[str]:
        """Letters of a mark that are nearer to the mark of another step."""
        found = [(key, mark, min(of, key=lambda one: one.box.distance(mark))) for key, mark in self.marks
                 if (of := [one for one in self.labels if one.key == key])]  # its vector has letters too
        return [one.text for key, mark, one in found if any(
            other.distance(one.box) < mark.distance(one.box) - NEAR for step, other in self.marks if step != key)]

    @property
    def smallest_capitals(self) -> float:
        """The height of the smallest letters on the plans, mm; indices are not counted."""
        return min((one.capitals for one in self.labels), default=np.inf)

    @property
    def short_vectors(self) -> list[tuple[str, float]]:
        """Vectors asked for that are too short to be measured, with their lengths in mm."""
        largest: dict[str, float] = {}
        for name, length in self.vectors:
            kind = name.split()[0]
            largest[kind] = max(length, largest.get(kind, 0.0))
        return [(name, length) for name, length in self.vectors
                if SMALL * largest[name.split()[0]] <= length < SHORTEST]

    @property
    def plans_of_page(self) -> float:
        """The part of the page that plans take."""
        return float(self.plans.area / self.page)

    @property
    def ink_of_panels(self) -> list[float]:
        """The part of each panel that the box of its ink takes."""
        drawn = [stroke.line for stroke in self.strokes] + [one.box for one in self.labels]
        inside = [[panel.intersection(line) for line in drawn if panel.intersects(line)]
                  for panel in self.panels.values()]
        return [float(shapely.union_all(lines).envelope.area / panel.area) if lines else 0.0
                for panel, lines in zip(self.panels.values(), inside, strict=True)]

    @property
    def odd_scales(self) -> list[str]:
        """Scales that no ruler has."""
        told = re.findall(r"(k_\w) = ([\d.e+-]+)", self.root.findtext(f"{NS}desc") or "")
        return [f"{name} = {value}" for name, value in told if significand(float(value)) not in ROUND]


def significand(value: float) -> float:
    """The number from 1 to 10 that a value is a power of ten times."""
    return round(value / 10 ** np.floor(np.log10(value) + 1e-12), 9)


def label(key: str, element: ET.Element) -> Label:
    """A text with the box of its ink: its runs one after the other, indices lower, from its anchor."""
    x, y, size = (float(element.get(name, 0)) for name in ("x", "y", "font-size"))
    runs = [(element.text or "", size, 0.0), *((run.text or "", float(run.get("font-size", size)),
                                               float(run.get("dy", 0))) for run in element)]
    boxes, width = [], 0.0
    for text, high, down in runs:
        y += down
        if text.strip():
            left, top, right, bottom = inked(text, high)
            boxes.append((width + left, y - bottom, width + right, y - top))
        width += advance(text, high)
    shift = x - {"middle": width / 2, "end": width}.get(element.get("text-anchor", ""), 0.0)
    box = shapely.union_all([shapely.box(a + shift, b, c + shift, d) for a, b, c, d in boxes]).envelope
    return Label(key, "".join(text for text, _, _ in runs), box, CAPITALS * size)


def inked(text: str, size: float) -> tuple[float, ...]:
    """The box of a text's ink, from its base line upwards."""
    return tuple(size * end for end in letters(text))


@cache
def letters(text: str) -> tuple[float, ...]:
    """The box of the ink of letters of size 1."""
    return tuple(map(float, TextPath((0, 0), text, size=1, prop=FONT).get_extents().extents))


def advance(text: str, size: float) -> float:
    """How far a text leads."""
    return inked(text + "|", size)[2] - inked("|", size)[2] if text else 0.0


def stroked(element: ET.Element) -> Iterator[shapely.Geometry]:
    """The line of an element that has one; what is only filled has none."""
    if element.get("stroke") in (None, "none"):
        return
    if element.tag in (f"{NS}polyline", f"{NS}polygon"):
        spots = [tuple(map(float, spot.split(","))) for spot in element.get("points", "").split()]
        yield shapely.LineString([*spots, spots[0]] if element.tag.endswith("polygon") else spots)
    elif element.tag == f"{NS}circle":
        x, y, r = (float(element.get(name, 0)) for name in ("cx", "cy", "r"))
        yield shapely.Point(x, y).buffer(r).exterior
    elif element.tag == f"{NS}path":
        yield arc(element.get("d", ""))


def arc(path: str) -> shapely.Geometry:
    """An arc as graphplan writes it, M x y A r r 0 large 0 u v, counter-clockwise on paper, as a chain."""
    x, y, r, _, _, large, _, u, v = map(float, re.findall(r"-?[\d.]+", path))
    half, start, end = np.hypot(u - x, v - y) / 2, complex(x, y), complex(u, v)
    away = np.sqrt(max(r * r - half * half, 0.0)) * (1 if large else -1)
    centre = (start + end) / 2 + away * 1j * (end - start) / (2 * half or 1.0)
    first = np.angle(start - centre)
    turn = -(np.angle((start - centre) / (end - centre)) % (2 * np.pi))
    at = centre + r * np.exp(1j * (first + turn * np.linspace(0, 1, 2 + int(abs(turn) * 15))))
    return shapely.LineString(np.stack([at.real, at.imag], axis=1))


# ---- the list of steps -------------------------------------------------------------------------------------------


Step = dict[str, Any]


def without_reason(steps: Iterable[Step]) -> list[int]:
    """The numbers of the steps that neither say why they are drawn nor stand in a stage."""
    return [step["number"] for step in steps if step["number"] and not step["why"] and step.get("stage") is None]


def drawn_twice(steps: Iterable[Step]) -> list[int]:
    """The numbers of the steps that draw a line where one of the same plan lies already."""
    found, lying = list[int](), dict[str, list[NDArray[np.float64]]]()
    for step in steps:
        if step["kind"] != "line" or not step["number"]:
            continue
        line = np.array(step["value"], float) / np.hypot(*step["value"][:2])
        before = lying.setdefault(step["plan"], [])
        if any(min(np.abs(line - old).max(), np.abs(line + old).max()) <= SAME * (1 + abs(line[2])) for old in before):
            found.append(step["number"])
        before.append(line)
    return found


# ---- the table -------------------------------------------------------------------------------------------------------


HEADS = ("scene", "labels on labels", "lines through labels", "labels nearer to others", "smallest capitals mm",
         "vectors too short", "plans of page", "ink of panels", "odd scales", "steps without a reason",
         "lines drawn twice")


def row(name: str, sheet: MeasuredSheet, steps: list[Step]) -> tuple[str, ...]:
    """What a sheet and its list of steps measure, in words."""
    counts = [len(found) for found in (sheet.labels_on_labels, sheet.lines_through_labels,
                                       sheet.labels_nearer_to_others)]
    lacks = [len(found(steps)) for found in (without_reason, drawn_twice)]
    return (name, *map(str, counts), f"{sheet.smallest_capitals:.2f}", str(len(sheet.short_vectors)),
            f"{sheet.plans_of_page:.0%}", f"{median(sheet.ink_of_panels):.0%}", ", ".join(sheet.odd_scales),
            *map(str, lacks))


def table(rows: Iterable[tuple[str, ...]]) -> str:
    """Rows in Markdown."""
    return "".join(f"| {' | '.join(cells)} |\n" for cells in (HEADS, ("---",) * len(HEADS), *rows))


def main() -> None:
    """Measure the scenes asked for, or all."""
    import graphplan as gp
    from graphplan.mechanism.scene import packaged
    from graphplan.output.text import steps
    from graphplan.sheet.layout.composition import compose

    parser = argparse.ArgumentParser(description="Measure the sheets of scenes.")
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("-o", dest="file", type=Path, help="write the table here")
    asked = parser.parse_args()
    drawings = {name: gp.construct(gp.load(name)) for name in asked.scenes or packaged()}
    rows = [row(name, MeasuredSheet.of(gp.sheet.svg(drawing)), steps(compose(drawing))["steps"])
            for name, drawing in drawings.items()]
    text = table(rows)
    if asked.file:
        asked.file.write_text(text)
    else:
        print(text, end="")


if __name__ == "__main__":
    main()
