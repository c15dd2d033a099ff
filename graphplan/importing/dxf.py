"""Linkages drawn in DXF: lines are bars, polylines rigid links, circles pins, and ends that meet are joints.

Layers tell more by their whole names: what is on `ground` or `frame` is fixed, what is on `slide` or `guide` are lines
along which pins slide, what is on `drive`, `crank` or `input` drives, and all that is on a layer `link 3` is one link.
Lines on layers of dimensions, centre lines or borders are bars only where nothing else is drawn. A polyline around both
ends of a bar is its outline. What is left out is counted. Texts beside pins are their names. The unit is that of the
drawing ($INSUNITS). Of a sheet of graphplan's own that a CAD program saved anew the mechanism in its own size is read,
which stands on layers of its own.
"""

from __future__ import annotations

import cmath
import math
import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise, product
from pathlib import Path
from typing import Any

from graphplan.errors import Refused
from graphplan.importing.sketch import LinkageSketch, SketchDrive, Slot
from graphplan.importing.tolerances import JOINT_TOL
from graphplan.marking.files import measures
from graphplan.marking.files.dxf import read_document
from graphplan.marking.files.safe import Budget, on_paper
from graphplan.mechanism.model import FRAME

GROUND = re.compile(r"(ground|frame|fixed|base|gestell|support)s?", re.IGNORECASE)
GUIDES = re.compile(r"(slide|guide|slot)s?", re.IGNORECASE)
DRIVES = re.compile(r"(drive|crank|input|motor)s?", re.IGNORECASE)
LINK = re.compile(r"link(?:[ _-]+(\S+)|(\d\S*))", re.IGNORECASE)
OTHER = re.compile(r"dim(ension)?s?|texts?|titles?|borders?|hidden|defpoints|hatch(es)?|cent(re|er)([ _-]?lines?|s)?",
                   re.IGNORECASE)
OWN, SYMBOLS = "MECHANISM 1-1 ", re.compile(r"blocks|drive|dimensions")  # of graphplan's own sheets
MAX_PIN_RADIUS = 0.06  # of the drawing: a larger circle is no pin
NAME_REACH = 2.5  # heights of letters from a pin to its name
UNITS = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m"}  # of $INSUNITS
MAX_ENTITIES = 4000


def read(path: Path, data: bytes) -> LinkageSketch:
    """The linkage of a file."""
    def linkage(document: Any) -> LinkageSketch:
        drawing = _DxfLinkage(path, document, b"$INSUNITS" in data)
        drawing.contents["groups"] = data.count(b"\n") // 2
        return drawing.sketch()

    return read_document(path, data, linkage)


@dataclass
class _Shape:
    """A link as it is drawn, and the layer it is on."""

    corners: list[complex]
    layer: str
    closed: bool = False


@dataclass
class _Pin:
    at: complex
    radius: float
    layer: str


@dataclass
class _DxfLinkage:
    """Reader of a drawing, and then of its sketch."""

    path: Path
    document: Any
    states_unit: bool
    shapes: list[_Shape] = field(default_factory=list)
    pins: list[_Pin] = field(default_factory=list)
    texts: list[tuple[complex, float, str]] = field(default_factory=list)
    omitted: Counter[str] = field(default_factory=Counter)
    contents: Counter[str] = field(default_factory=Counter)
    joints: list[complex] = field(default_factory=list)

    def sketch(self) -> LinkageSketch:
        """Sketch of the drawing: joints, links, slides, fixed points and drives."""
        self.budget = Budget(self.path, MAX_ENTITIES, "lines, circles and texts")
        self.hidden = {layer.dxf.name for layer in self.document.layers if layer.is_off() or layer.is_frozen()}
        self.own = any(layer.dxf.name.startswith(OWN) for layer in self.document.layers)
        self._read(self.document.modelspace(), 0, "")
        spots = [corner for shape in self.shapes for corner in shape.corners] + [pin.at for pin in self.pins]
        if not all(on_paper(spot.real, spot.imag) for spot in spots):
            raise Refused(f"{self.path}", "a line lies too far away", "coordinates below a million")
        self.size = max((max(spans) - min(spans) for spans in ([spot.real for spot in spots],
                                                               [spot.imag for spot in spots]) if spans),
                        default=0.0) or 1.0
        big = [pin for pin in self.pins if pin.radius > MAX_PIN_RADIUS * self.size]
        self.pins = [pin for pin in self.pins if pin not in big]
        self.omitted["large circles"] = len(big)
        self._choose_shapes()
        sketch = LinkageSketch("DXF", length=UNITS.get(self.document.units, "") if self.states_unit else "")
        if not sketch.length:
            sketch.note("the unit of length: the drawing states none that a scene has, mm is a guess")
        self._links(sketch)
        self._name_joints(sketch)
        self.omitted["texts"] = len(self.texts) - len([name for name in sketch.names.values() if name])
        sketch.left_out, sketch.contents = self.omitted, self.contents
        return sketch

    def _choose_shapes(self) -> None:
        """Leave out outlines of bars and closed figures at one joint, such as arrow heads, and lines on layers of
        dimensions, unless no other line is drawn; an outline of pins alone is their link."""
        strokes = [shape for shape in self.shapes if not OTHER.fullmatch(shape.layer.strip())] or self.shapes
        self.omitted["lines on layers of dimensions, centre lines or borders"] = len(self.shapes) - len(strokes)
        pins = [*dict.fromkeys(pin.at for pin in self.pins)]
        spots = [(at, -1) for at in pins] + [(at, owner) for owner, shape in enumerate(strokes) for at in shape.corners]
        near = defaultdict[tuple[int, int], set[int]](set)  # which shapes, or pins, are in each small square
        for (x, y), owner in ((self._square(at), owner) for at, owner in spots):
            for square in product((x - 1, x, x + 1), (y - 1, y, y + 1)):
                near[square].add(owner)
        self.shapes = []
        for owner, shape in enumerate(strokes):
            joints = sum(near[self._square(corner)] != {owner} for corner in {*shape.corners})
            layer, corners = shape.layer.strip(), shape.corners
            if joints > 1 or not (shape.closed or corners[0] == corners[-1]) or GROUND.fullmatch(
                    layer) or GUIDES.fullmatch(layer):
                self.shapes.append(shape)
                continue
            within = self._spots_inside(shape, [at for at, holder in spots if holder != owner])
            surrounded = [len(other.corners) for other in strokes if other is not shape and within >= {*other.corners}]
            if not joints and not surrounded and len(within & {*pins}) > 1:
                self.shapes.append(_Shape([at for at in pins if at in within], shape.layer))
            else:
                self.omitted["outlines of bars" if 2 in surrounded else "closed figures at one joint or none"] += 1

    def _square(self, spot: complex) -> tuple[int, int]:
        return round(spot.real / (JOINT_TOL * self.size)), round(spot.imag / (JOINT_TOL * self.size))

    def _spots_inside(self, shape: _Shape, spots: list[complex]) -> set[complex]:
        """Return those places that are within a closed polyline, or on it."""
        xs, ys = [at.real for at in shape.corners], [at.imag for at in shape.corners]
        reach = JOINT_TOL * self.size
        left, right, low, high = min(xs) - reach, max(xs) + reach, min(ys) - reach, max(ys) + reach
        near = {at for at in spots if left <= at.real <= right and low <= at.imag <= high}
        sides = [*pairwise([*shape.corners, shape.corners[0]])]
        return {at for at in near if any(_distance_to_stroke(at, *side) <= reach for side in sides) or abs(
            sum(cmath.phase((end - at) / (start - at)) for start, end in sides)) > math.pi}

    def _read(self, entities: Iterable[Any], depth: int, within: str) -> None:
        """Lines, polylines, circles and texts, those of blocks among them."""
        for entity in entities:
            self.budget.spend()
            layer = entity.dxf.layer if entity.dxf.hasattr("layer") else "0"
            layer = within if layer == "0" and within else layer
            if layer in self.hidden or (entity.dxf.hasattr("invisible") and entity.dxf.invisible):
                self.omitted["hidden objects"] += 1
                continue
            if self.own and (not layer.startswith(OWN) or SYMBOLS.search(layer)):
                continue
            layer = layer.removeprefix(OWN)
            closed = "closed " if getattr(entity, "is_closed", False) is True else ""
            self.contents[f"{closed}{entity.dxftype().lower()}s"] += 1
            match entity.dxftype():
                case "INSERT" if depth < measures.MAX_BLOCK_DEPTH:
                    if any(map(GROUND.fullmatch, re.split(r"[^A-Za-z]+", entity.dxf.name))):
                        self.pins.append(_Pin(_spot(entity.dxf.insert), 0.0, "ground"))
                    else:
                        self._read(entity.virtual_entities(), depth + 1, layer)
                case "TEXT" | "MTEXT" | "ATTRIB":
                    high = entity.dxf.char_height if entity.dxftype() == "MTEXT" else entity.dxf.height
                    self.texts.append((_spot(entity.dxf.insert), high, entity.plain_text().strip()))
                case "CIRCLE":
                    self.pins.append(_Pin(_spot(entity.ocs().to_wcs(entity.dxf.center)), entity.dxf.radius, layer))
                case "POINT":
                    self.pins.append(_Pin(_spot(entity.dxf.location), 0.0, layer))
                case "LINE" | "LWPOLYLINE" | "POLYLINE":
                    corners = _corners(entity)
                    self.budget.spend(len(corners))
                    if len({*corners}) > 1:
                        self.shapes.append(_Shape(corners, layer, bool(closed)))
                    self.omitted["strokes of no length"] += len({*corners}) < 2
                    self.omitted["curves of polylines, read as straight"] += bool(getattr(entity, "has_arc", False))
                case kind:
                    self.omitted[f"{kind.lower()}s"] += 1

    # ---- joints and links ------------------------------------------------------------------------------------------

    def _joint(self, spot: complex) -> str:
        """The joint at a place: that of the pin whose circle it touches, else the nearest within tolerance; else a new
        one."""
        pin = next((pin for pin in self.pins if abs(pin.at - spot) <= 1.02 * pin.radius + JOINT_TOL * self.size), None)
        at = spot if pin is None else pin.at
        for place, joint in enumerate(self.joints):
            if abs(joint - at) <= JOINT_TOL * self.size:
                return str(place)
        self.joints.append(at)
        return str(len(self.joints) - 1)

    def _links(self, found: LinkageSketch) -> None:
        """Make links of shapes and of layers, then of pins that lie on them; guides are lines of slides, without a
        drive."""
        bars = [shape for shape in self.shapes if not GUIDES.fullmatch(shape.layer.strip())]
        for shape in bars:
            points = [self._add_point(found, corner) for corner in shape.corners]
            name = LINK.fullmatch(shape.layer.strip())
            if GROUND.fullmatch(shape.layer.strip()):
                found.fixed |= dict.fromkeys(points)
            elif name and shape.layer in found.links:
                found.hold(shape.layer, *points)
            else:
                link = found.link(points, shape.layer if name else "", (name[1] or name[2]) if name else "")
                if DRIVES.fullmatch(shape.layer.strip()):
                    remark = f"It is on the layer {shape.layer}; its speed is a guess."
                    found.drives.append(SketchDrive(link, "omega = 1", remark))
        for pin in self.pins:
            self._place_pin(found, pin, bars)
        for shape in self.shapes:
            if GUIDES.fullmatch(shape.layer.strip()):
                self._guide(found, shape, bars)

    def _add_point(self, found: LinkageSketch, spot: complex) -> str:
        key = self._joint(spot)
        return key if key in found.places else found.point(key, self.joints[int(key)])

    def _place_pin(self, found: LinkageSketch, pin: _Pin, bars: Sequence[_Shape]) -> None:
        """A pin on the way of a bar is a joint of it, one on the ground is fixed."""
        guides = [shape for shape in self.shapes if GUIDES.fullmatch(shape.layer.strip())
                  and _distance_to_stroke(pin.at, shape.corners[0], shape.corners[-1]) <= JOINT_TOL * self.size]
        on = [shape for shape in bars if any(_distance_to_stroke(pin.at, *side) <= JOINT_TOL * self.size
                                             for side in _sides(shape))
              and (pin.at in shape.corners or not any(self._carries(shape, guide) for guide in guides))]
        if on:
            key = self._add_point(found, pin.at)
            for shape in on:
                corners = {self._joint(corner) for corner in shape.corners}
                for link, points in found.links.items():
                    if corners <= {*points} and key not in points:
                        found.hold(link, key)
        if GROUND.fullmatch(pin.layer.strip()) and (key := self._joint(pin.at)) in found.places:
            found.fixed[key] = None

    def _carries(self, bar: _Shape, guide: _Shape) -> bool:
        """Whether a side of a bar runs along a guide, or on from it: then the guide is on its link."""
        start, end = guide.corners[0], guide.corners[-1]
        return any(max(_distance_to_line(corner, start, end) for corner in side) <= JOINT_TOL * self.size
                   for side in _sides(bar))

    def _guide(self, found: LinkageSketch, guide: _Shape, bars: Sequence[_Shape]) -> None:
        """The pins on a guide slide along it; it is of the link with a bar along it, else of the frame."""
        start, end = guide.corners[0], guide.corners[-1]
        carriers = [{self._joint(corner) for corner in bar.corners} for bar in bars if self._carries(bar, guide)]
        along = next((link for link, points in found.links.items() if any(joints <= {*points} for joints in carriers)),
                     FRAME)
        direction = (end - start) / abs(end - start)
        for key, at in found.places.items():
            if _distance_to_stroke(at, start, end) <= JOINT_TOL * self.size and key not in found.fixed and (
                    along == FRAME or key not in found.links[along]):
                found.slots.append(Slot(key, along, direction))
                if along == FRAME and self.own:
                    found.note("that each guide without a bar along it is on the frame is a guess")

    def _name_joints(self, found: LinkageSketch) -> None:
        """Names by the texts beside the joints."""
        for key, at in found.places.items():
            near = [(abs(spot - at), text) for spot, high, text in self.texts
                    if abs(spot - at) <= NAME_REACH * high + MAX_PIN_RADIUS * self.size and re.fullmatch(r"\S{1,6}",
                                                                                                         text)]
            found.names[key] = min(near)[1] if near else ""


def _spot(vector: Any) -> complex:
    return complex(vector[0], vector[1])


def _corners(entity: Any) -> list[complex]:
    """The corners of a line or a polyline; a closed one does not name its first again."""
    if entity.dxftype() == "LINE":
        return [_spot(entity.dxf.start), _spot(entity.dxf.end)]
    if entity.dxftype() == "LWPOLYLINE":
        return [*map(_spot, entity.vertices_in_wcs())]
    return [_spot(vertex.dxf.location) for vertex in entity.vertices]


def _sides(shape: _Shape) -> Iterator[tuple[complex, complex]]:
    yield from pairwise([*shape.corners, *shape.corners[:shape.closed]])


def _distance_to_stroke(at: complex, start: complex, end: complex) -> float:
    """Distance of a place from a stroke."""
    stroke = end - start
    if not stroke:
        return abs(at - start)
    share = ((at - start) * stroke.conjugate()).real / abs(stroke) ** 2
    return abs(at - start - min(max(share, 0.0), 1.0) * stroke)


def _distance_to_line(at: complex, start: complex, end: complex) -> float:
    """Distance of a place from a line."""
    return abs(((end - start).conjugate() * (at - start)).imag) / abs(end - start)
