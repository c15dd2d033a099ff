"""A sheet as its SVG has it: panels, letters, strokes, marks and vectors, and what of them cannot be read or measured.

Nothing but the file is read, so a sheet is judged by what a student holds in hand. Lengths are mm of paper.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import combinations
from pathlib import Path
from statistics import median

import numpy as np
import shapely
import shapely.prepared
from matplotlib import get_data_path
from matplotlib.ft2font import FT2Font, Kerning, LoadFlags

NS = "{http://www.w3.org/2000/svg}"
# A font of its own: matplotlib changes the size of those that it shares.
FONT, UNIT = FT2Font(str(Path(get_data_path(), "fonts", "ttf", "DejaVuSans.ttf"))), 1000.0
FONT.set_size(UNIT, 72)
CAPITALS = 0.729  # of the size of the letters
MARK = 0.7  # the radius of a mark's circle is no larger, that of a pair's is
RING = "#4a2c0a"  # the colour of the rings about what details show
LEADER = "0.13"  # the width of the lines that tie letters to marks
BLACK, GREY = "#000000", "#555555"  # letters of marks, numbers of steps
MAX_LEADER_MM = 8.01  # of them; ends are written to a hundredth
CAPTION_END = " : 1"  # of a detail's caption, which is of its step, too
ONE, APART = 0.05, 1.0  # marks nearer than the first are one, those between cannot be told apart
TOUCHED = 0.02  # mm²: letters that share less are apart
NEAR = 0.1  # a stroke may touch the box of letters by so much
SHORTEST, SMALL = 5.0, 0.02  # a vector that is asked for, and of the largest of its kind what may be shorter
EDGE = 0.6  # mm: a line that ends nearer to the edge of its panel leaves it
UPON, SHARED = 0.35, 3.0  # vectors so near to a line lie upon it, where they do so for longer than this
WRITTEN = 0.02  # mm: coordinates are written to a hundredth
POWERS = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")
ROUND, FOUR_DIGITS = {1.0, 2.0, 2.5, 4.0, 5.0}, 5e-4


@dataclass(frozen=True)
class Label:
    """Letters on a plan: the layer or step that they belong to, what they say, the box of their ink, and its colour."""

    key: str
    text: str
    box: shapely.Geometry
    colour: str


@dataclass(frozen=True)
class Stroke:
    """A line, an arc or a circle, with the layer or step that it belongs to."""

    key: str
    line: shapely.Geometry


@dataclass(frozen=True)
class Vector:
    """A drawn vector: what it is, such as velocity A, or nothing where it is not asked for, and its shaft."""

    name: str
    line: shapely.Geometry


@dataclass(frozen=True)
class InkedSheet:
    """A sheet as its SVG tells it: panels by plan, labels and strokes on them, marks by step, vectors."""

    root: ET.Element

    @classmethod
    def of(cls, svg: str) -> InkedSheet:
        """The sheet of an SVG text."""
        return cls(ET.fromstring(svg.encode()))

    @property
    def page(self) -> float:
        """The area of the paper, mm²."""
        _, _, wide, high = map(float, self.root.get("viewBox", "").split())
        return wide * high

    @cached_property
    def frame(self) -> shapely.Geometry:
        """What lies inside the border."""
        rect = next(rect for rect in self.root.iter(f"{NS}rect") if rect.get("class") == "frame")
        return box_of(rect)

    @cached_property
    def panels(self) -> dict[str, shapely.Geometry]:
        """The panel of each plan."""
        return {rect.get("data-plan", ""): box_of(rect) for rect in self.root.iter(f"{NS}rect")
                if rect.get("class") == "panel"}

    @cached_property
    def plans(self) -> shapely.Geometry:
        """All panels as one area."""
        return shapely.union_all([*self.panels.values()])

    @cached_property
    def elements(self) -> list[tuple[str, ET.Element]]:
        """What is drawn, each with the layer or step of its group, in details with its own; paper and border are left
        out."""
        groups = [(g.get("data-step") or g.get("class", ""), g) for g in self.root.findall(f"{NS}g")]
        return [(child.get("data-step", key), element) for key, group in groups
                if key not in ("layer-paper", "layer-border") for child in group for element in child.iter()]

    @cached_property
    def rings(self) -> list[shapely.Geometry]:
        """The areas of the plans that details show enlarged: what lies there is read in these. A ring that breaks off
        at letters is of several arcs of one circle."""
        rings = dict[object, list[shapely.Geometry]]()
        for group in self.root.iter(f"{NS}g"):
            for e in group if group.get("class") == "layer-enlarged" else ():
                if e.get("stroke") == RING and e.tag in (f"{NS}circle", f"{NS}path"):
                    radius = e.get("r") or e.get("d", "").split()[4]
                    rings.setdefault((e.get("data-step"), radius), []).extend(stroked(e))
        return [shapely.union_all(arcs).convex_hull for arcs in rings.values()]

    @cached_property
    def texts(self) -> list[tuple[str, ET.Element]]:
        """All lettering, with its layer or step."""
        return [(key, element) for key, element in self.elements if element.tag == f"{NS}text"]

    @cached_property
    def lettering(self) -> list[Label]:
        """All lettering with its box: letters on plans, captions, facts, words and the title block."""
        return [label(key, element) for key, element in self.texts if said(element).strip()]

    @property
    def outside(self) -> list[str]:
        """What leaves the frame, but for what stands in its border."""
        inside = self.frame.buffer(WRITTEN)
        drawn = [(f"{element.tag.removeprefix(NS)} of {key}", line) for key, element in self.elements
                 if key != "layer-corner marks" for line in (*stroked(element), *filled(element))]
        return [what for what, shape in [*drawn, *((one.text, one.box) for one in self.lettering)]
                if not inside.contains(shape)]

    @property
    def letters_on_letters(self) -> list[tuple[str, str]]:
        """Lettering of any kind that covers other lettering."""
        tree = shapely.STRtree([one.box for one in self.lettering])
        return [(self.lettering[i].text, self.lettering[k].text) for i, one in enumerate(self.lettering)
                for k in tree.query(one.box, predicate="intersects")
                if i < k and one.box.intersection(self.lettering[k].box).area > TOUCHED]

    def captions(self, plan: str) -> list[str]:
        """The lines of the heading of a plan."""
        near = self.panels[plan].buffer(WRITTEN)
        return [said(element) for key, element in self.texts if key == "layer-text" and near.contains(
            shapely.Point(float(element.get("x", 0)), float(element.get("y", 0))))]

    def scale(self, plan: str, letter: str) -> float:
        """What a millimetre of a plan stands for by its heading: of lengths (s), velocities (v), accelerations (a) or
        forces (F)."""
        found = re.search(rf"k{letter} = (\S+) ", " ".join(self.captions(plan)) + " ")
        assert found, f"the heading of {plan} tells no k_{letter}"
        return number(found[1])

    def plan_at(self, *spots: tuple[float, float]) -> str:
        """The plan on whose panel all of some spots lie."""
        return next(plan for plan, panel in self.panels.items()
                    if all(panel.buffer(WRITTEN).contains(shapely.Point(spot)) for spot in spots))

    @cached_property
    def labels(self) -> list[Label]:
        """The letters on the plans; captions and protocols are none."""
        near = shapely.prepared.prep(self.plans.buffer(0.1))
        return [label(key, element) for key, element in self.texts if key not in ("layer-text", "layer-results")
                and near.contains(shapely.Point(float(element.get("x", 0)), float(element.get("y", 0))))]

    @cached_property
    def strokes(self) -> list[Stroke]:
        """The lines on the plans, circles of marks and pairs among them."""
        lines = [(key, line) for key, element in self.elements for line in stroked(element)]
        return [Stroke(key, line) for key, line in lines if self.plans.intersects(line)]

    @cached_property
    def marks(self) -> list[tuple[str, shapely.Geometry]]:
        """The marks of steps, by step; of what is enlarged those in the detail."""
        return [(key, spot) for key, spot, r in self._circles if key.isdigit() and r <= MARK]

    @property
    def marks_on_plans(self) -> list[tuple[str, shapely.Geometry]]:
        """The marks of steps where they lie on the plans, in rings too: lengths are measured between these."""
        groups = (group for group in self.root.findall(f"{NS}g") if group.get("class") != "layer-enlarged")
        circles = ((child.get("data-step", group.get("data-step", "")), e) for group in groups for child in group
                   for e in child.iter(f"{NS}circle"))
        return [(key, shapely.Point(float(e.get("cx", 0)), float(e.get("cy", 0)))) for key, e in circles
                if key.isdigit() and float(e.get("r", 0)) <= MARK]

    @property
    def pins(self) -> list[shapely.Geometry]:
        """The middles of pairs, and of what details show of them."""
        return [spot for key, spot, _ in self._circles if key == "layer-pairs"]

    @property
    def leaders(self) -> list[tuple[str, shapely.Geometry]]:
        """The thinnest lines, which tie letters to their marks, by step."""
        return [(key, line) for key, element in self.elements if element.get("stroke-width") == LEADER
                for line in stroked(element)]

    @property
    def long_leaders(self) -> list[str]:
        """The leaders that are too long for the eye to follow."""
        return [f"{line.length:.1f} mm" for _, line in self.leaders if line.length > MAX_LEADER_MM]

    @property
    def cut_lines(self) -> list[str]:
        """What is written where lines leave their panels: to which marks they go on; and the steps whose lines end at
        the edge of a panel without a word."""
        told = [label for label in self.labels if label.text.startswith("to ")]
        edges = shapely.union_all([panel.exterior for panel in self.panels.values()])
        ends = [(stroke.key, shapely.Point(end)) for stroke in self.strokes
                if stroke.key.isdigit() and stroke.line.geom_type == "LineString" and len(stroke.line.coords) == 2
                for end in stroke.line.coords]
        untold = {f"step {key}" for key, end in ends if edges.distance(end) < EDGE
                  and not any(one.key == key or one.box.distance(end) < MAX_LEADER_MM for one in told)}
        return [one.text for one in told] + sorted(untold)

    @property
    def facts_in_pieces(self) -> int:
        """How many more headings given and found have than one each."""
        return max(0, sum(said(element) in ("Given", "Found") for _, element in self.texts) - 2)

    @cached_property
    def _circles(self) -> list[tuple[str, shapely.Geometry, float]]:
        """All circles outside the rings: their layer or step, their middle, their radius."""
        circles = [(key, shapely.Point(float(e.get("cx", 0)), float(e.get("cy", 0))), float(e.get("r", 0)))
                   for key, e in self.elements if e.tag == f"{NS}circle"]
        return [(key, spot, r) for key, spot, r in circles if not any(ring.contains(spot) for ring in self.rings)]

    @cached_property
    def vectors(self) -> list[Vector]:
        """The vectors on all plans."""
        arrows = [e for _, e in self.elements if e.get("class") == "vector"]
        return [Vector(e.get("data-vector", ""), shapely.LineString([
            tuple(map(float, e.get(end, "").split())) for end in ("data-from", "data-to")])) for e in arrows]

    # ---- letters ----------------------------------------------------------------------------------------------------

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
        """Letters of a mark that are nearer to the mark of another step, but for those that a leader ties to theirs.

        Those of its vector or arm are coloured; what tells whither its line goes stands at the edge.
        """
        found = [(key, mark, min(of, key=lambda one: one.box.distance(mark))) for key, mark in self.marks
                 if (of := [one for one in self.labels if one.key == key and one.colour in (BLACK, GREY)
                            and not (one.text.endswith(CAPTION_END) or one.text.startswith("to "))])]
        own = [*self.marks, *self.marks_on_plans]  # in a ring a letter is of the mark there
        tied = {key for key, line in self.leaders for one, mark in own if one == key and line.distance(mark) <= ONE}
        return [one.text for key, _, one in found if key not in tied and any(
            other.distance(one.box) < min(mark.distance(one.box) for of, mark in own if of == key) - NEAR
            for step, other in self.marks if step != key)]

    @property
    def smallest_letters(self) -> float:
        """The height of the smallest capitals on the sheet, subscripts apart."""
        return CAPITALS * min((float(text.get("font-size", 0)) for _, text in self.texts), default=np.inf)

    @property
    def smallest_subscripts(self) -> float:
        """The height of the smallest capitals of subscripts."""
        return CAPITALS * min((float(run.get("font-size", np.inf)) for _, text in self.texts for run in text),
                              default=np.inf)

    # ---- marks and vectors ------------------------------------------------------------------------------------------

    @property
    def marks_too_near(self) -> list[tuple[str, str]]:
        """Marks that cannot be told apart from another mark, or from a pair, though they are not the same."""
        spots = [*self.marks, *((key, spot) for key, spot, r in self._circles
                                if key == "layer-pairs" or (key == "layer-enlarged" and r > MARK))]
        tree = shapely.STRtree([spot for _, spot in spots])
        found = [(i, int(k)) for i, (_, spot) in enumerate(spots) for k in tree.query(spot, "dwithin", APART)]
        return [(spots[i][0], spots[k][0]) for i, k in found if i < k and spots[i][1].distance(spots[k][1]) > ONE]

    @property
    def short_vectors(self) -> list[tuple[str, float]]:
        """Vectors asked for that are too short to be measured, with their lengths."""
        asked = [(vector.name, float(vector.line.length)) for vector in self.vectors if vector.name]
        largest: dict[str, float] = {}
        for name, length in asked:
            kind = name.split()[0]
            largest[kind] = max(length, largest.get(kind, 0.0))
        return [(name, length) for name, length in asked if SMALL * largest[name.split()[0]] <= length < SHORTEST]

    @property
    def vectors_on_vectors(self) -> float:
        """The length over which vectors that are asked for lie upon each other."""
        asked = [vector.line for vector in self.vectors if vector.name]
        return sum(upon(one, other) for one, other in combinations(asked, 2))

    @property
    def vectors_on_links(self) -> float:
        """The length over which vectors that are asked for lie upon links."""
        links = shapely.union_all([stroke.line for stroke in self.strokes if stroke.key == "layer-links"])
        return sum(upon(vector.line, links) for vector in self.vectors if vector.name)

    # ---- paper ------------------------------------------------------------------------------------------------------

    @property
    def plans_of_page(self) -> float:
        """The part of the page that plans take."""
        return float(self.plans.area / self.page)

    @property
    def ink_of_panels(self) -> float:
        """The part of its panel that the box of a plan's ink takes: the median of all plans."""
        drawn = [stroke.line for stroke in self.strokes] + [one.box for one in self.labels]
        tree, parts = shapely.STRtree(drawn), list[float]()
        for panel in self.panels.values():
            inside = [panel.intersection(drawn[k]) for k in tree.query(panel, "intersects")]
            parts.append(float(shapely.union_all(inside).envelope.area / panel.area))
        return median(parts)

    @property
    def odd_scales(self) -> list[str]:
        """Scales that no ruler has, and plans that are drawn a number of times as large as by their scale."""
        told = re.findall(r"((?:k|mu)_\w) = ([\d.e+-]+)", self.root.findtext(f"{NS}desc") or "")
        odd = [f"{name} = {value}" for name, value in told
               if not np.isclose(significand(float(value)), [*ROUND, 10.0], rtol=FOUR_DIGITS).any()]
        captions = [said(element) for key, element in self.texts if key == "layer-text"
                    and self.plans.contains(shapely.Point(float(element.get("x", 0)), float(element.get("y", 0))))]
        return odd + [times for caption in captions for times in re.findall(r"×\s?\d[\d/.]*", caption)]


def upon(line: shapely.Geometry, other: shapely.Geometry) -> float:
    """The length over which a line lies upon others, crossings left out."""
    shared = line.intersection(other.buffer(UPON, cap_style="flat"))
    return sum(float(part.length) for part in shapely.get_parts(shared) if part.length > SHARED)


def significand(value: float) -> float:
    """The number from 1 to 10 that a value is a power of ten times."""
    return round(value / 10 ** np.floor(np.log10(value) + 1e-12), 9)


def number(text: str) -> float:
    """A printed number, such as −1.2·10⁻³."""
    mantissa, _, power = text.replace("−", "-").partition("·10")
    return float(mantissa) * 10.0 ** int(power.translate(POWERS) or 0)


# ---- elements -------------------------------------------------------------------------------------------------------


def said(element: ET.Element) -> str:
    """What a text says."""
    return "".join(element.itertext())


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
    return Label(key, said(element), box, element.get("fill", BLACK))


def inked(text: str, size: float) -> tuple[float, ...]:
    """The box of a text's ink, from its base line upwards."""
    return tuple(size * end for end in letters(text)[0])


def advance(text: str, size: float) -> float:
    """How far a text leads."""
    return size * letters(text)[1]


@cache
def letters(text: str) -> tuple[tuple[float, ...], float]:
    """The box of the ink of letters of size 1, and how far they lead."""
    x, before, boxes = 0.0, 0, []
    for char in text:
        place, box, leads = glyph(char)
        x += FONT.get_kerning(before, place, Kerning.DEFAULT) / 64 / UNIT if before else 0.0
        if not char.isspace():
            boxes.append((x + box[0], box[1], x + box[2], box[3]))
        x, before = x + leads, place
    left, low, right, high = zip(*boxes, strict=True) if boxes else ((0.0,),) * 4
    return (min(left), min(low), max(right), max(high)), x


@cache
def glyph(char: str) -> tuple[int, tuple[float, ...], float]:
    """A letter's place in the font, the box of its ink and its advance, for letters of size 1."""
    shape = FONT.load_char(ord(char), flags=LoadFlags.NO_HINTING)
    return FONT.get_char_index(ord(char)), tuple(end / 64 / UNIT for end in shape.bbox), \
        shape.linearHoriAdvance / 65536 / UNIT


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


def filled(element: ET.Element) -> Iterator[shapely.Geometry]:
    """The area of a figure without a stroke."""
    if element.tag == f"{NS}polygon" and element.get("stroke") in (None, "none"):
        yield shapely.Polygon([tuple(map(float, spot.split(","))) for spot in element.get("points", "").split()])


def box_of(rect: ET.Element) -> shapely.Geometry:
    """The area of a rectangle."""
    x, y, wide, high = (float(rect.get(name, 0)) for name in ("x", "y", "width", "height"))
    return shapely.box(x, y, x + wide, y + high)


def arc(path: str) -> shapely.Geometry:
    """An arc as graphplan writes it, M x y A r r 0 large 0 u v, counter-clockwise on paper, as a chain."""
    x, y, r, _, _, large, _, u, v = map(float, re.findall(r"-?[\d.]+", path))
    half, start, end = np.hypot(u - x, v - y) / 2, complex(x, y), complex(u, v)
    if start == end:  # to a hundredth of a millimetre
        return shapely.Point(x, y)
    away = np.sqrt(max(r * r - half * half, 0.0)) * (1 if large else -1)
    centre = (start + end) / 2 + away * 1j * (end - start) / (2 * half)
    first = np.angle(start - centre)
    turn = -(np.angle((start - centre) / (end - centre)) % (2 * np.pi))
    at = centre + r * np.exp(1j * (first + turn * np.linspace(0, 1, 2 + int(abs(turn) * 15))))
    return shapely.LineString(np.stack([at.real, at.imag], axis=1))
