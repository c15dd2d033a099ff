"""Linkages drawn in GeoGebra (.ggb): segments and polygons are links, and how points depend tells what moves.

| drawn                                                | read as                                                      |
|------------------------------------------------------|--------------------------------------------------------------|
| a segment, a polyline, a polygon between points      | a bar, bars, a rigid link, where no length of it changes     |
| a point where a circle of given radius is crossed    | a point of one link with the centre                          |
| a point on a circle, or turned by an angle's slider  | the pin of a crank, which drives                             |
| a point on a line that stands still                  | a slide on the frame; a free one drives                      |
| a point where a line through two points is crossed   | a slide along the link of the two                            |
| a point on a segment, a midpoint, a constant turn    | a point of that link                                         |
| free points, where others move; points made fixed    | the frame                                                    |

GeoGebra knows no speeds. Values and dependences are read as they are for drawings that are handed in.
"""

from __future__ import annotations

import cmath
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

from graphplan.importing.sketch import LinkageSketch, SketchDrive, Slot
from graphplan.importing.tolerances import DIRECTION_TOL, LINE_TOL, STEPS
from graphplan.marking.files.geogebra import (
    CAPTION_MODE,
    LINE_TYPES,
    NAME,
    GeoGebraObjects,
    PlaneVector,
    is_shown,
    read_construction,
)
from graphplan.mechanism.model import FRAME

AXES = {"xAxis": 1 + 0j, "yAxis": 1j}
RIGID = {"Point", "PointIn", "Midpoint", "Center", "Rotate", "Dilate", "Centroid"}
TURNED = re.compile(r";\s*([^)]*)\)|(?:cos|sin)\s*\(([^()]*)\)")
INNER = re.compile(r"(\w+)\s*[\[(](.*)[\])]")
READ = {"coords", "value", "show", "fixed", "caption", "labelMode", "layer", "matrix", "animation"}  # of elements
GUESS = "GeoGebra knows no speed: 1 {unit} is a guess."


def read(path: Path, data: bytes) -> LinkageSketch:
    """The linkage of a file."""
    return read_construction(path, data, lambda objects: _GeoGebraLinkage(objects).sketch)


class _GeoGebraLinkage:
    """Reads the objects, link by link and then point by point."""

    def __init__(self, objects: GeoGebraObjects):
        self.objects = objects
        self.dependents: dict[str, set[str]] = {}
        for label in objects.elements:
            for name in self._needs(label):
                self.dependents.setdefault(name, set()).add(label)
        self.points = {label for label, element in objects.elements.items()
                       if element.get("type") == "point" and isinstance(objects.values.get(label), complex)}
        self.driving = {*self._driving()}
        running = [label for label in objects.elements if self._command(label)[0] in ("Point", "PointIn")]
        self.moving = self._made_of([*self.driving, *running])
        self.poses = [*self._poses([*self.driving, *(label for label in running if self._needs(label) <= {
            *self.objects.elements} - self.moving)])]
        self.sketch = LinkageSketch("GeoGebra")
        own_sheet = any(label.startswith("stroke_") for label in objects.elements)
        unit = "graphplan's own sheet, saved anew, is in mm of paper" if own_sheet else "GeoGebra's own is read as mm"
        self.sketch.note(f"the unit of length: {unit}")
        for ends in self._join_straight_bars([*self._links(own_sheet)]) if own_sheet else self._links(own_sheet):
            self._add_points(*ends)
            self.sketch.link(ends)
        for label in [*self.sketch.places]:
            self._read_constraint(label)
        for label in sorted(self.points - self.sketch.places.keys()):
            if not (own_sheet and label.startswith("point_")):
                self._read_carried_point(label)
        self._frame()
        self._count()

    def _count(self) -> None:
        """Count what was read, and what a scene has no place for."""
        sketch, elements = self.sketch, self.objects.elements
        sketch.contents = Counter(f"{element.get('type')}s" for element in elements.values())
        sketch.contents.update({"commands": len(self.objects.commands), "attributes": sum(
            len(part.attrib) for part in self.objects.document.iter())})
        sketch.left_out.update(Counter(child.tag for element in elements.values() for child in element
                                       if child.tag not in READ))
        if lone := [label for label in sorted(self.points - sketch.places.keys()) if is_shown(elements[label])]:
            sketch.note(f"points on no link, left out: {' '.join(lone)}")

    def _poses(self, drivers: Iterable[str]) -> Iterator[tuple[dict[str, Any], dict[str, Any]]]:
        """The values of all objects as they are made again, and where the driving objects have gone on."""
        for step in STEPS:
            before, after = dict[str, Any](), dict[str, Any]()
            for label in drivers:
                value, path = self.objects.values.get(label), [*self._command(label)[1], ""][0]
                centre, line = self._centre(path), self.objects.term(path)
                along = AXES.get(path) or getattr(line, "along", None)
                if isinstance(value, float):
                    after[label] = value + step
                elif isinstance(value, complex) and centre is not None:
                    pivot = self.objects.values[centre]
                    after[label] = pivot + (value - pivot) * cmath.rect(1, step)
                elif isinstance(value, complex) and along:
                    after[label] = value + step * along
                before |= {label: value} if label in after else {}
            yield self.objects.values_with(before), self.objects.values_with(after)

    def _changes(self, corners: list[str]) -> bool:
        """Whether distances of corners change where the construction moves."""
        length = max(abs(self.objects.values[end] - self.objects.values[corners[0]]) for end in corners)
        return any(abs(abs(after[start] - after[end]) - abs(before[start] - before[end])) > LINE_TOL * length
                   for start, end in combinations(corners, 2) for before, after in self.poses
                   if {start, end} <= before.keys() & after.keys())

    def _add_points(self, *labels: str) -> None:
        for label in labels:
            if label not in self.sketch.places:
                self.sketch.point(label, self.objects.values[label], self._name(label))

    def _name(self, label: str) -> str:
        element = self.objects.elements[label]
        mode, caption = element.find("labelMode"), element.find("caption")
        is_shown = caption is not None and mode is not None and mode.get("val") == CAPTION_MODE
        return caption.get("val", "") or label if is_shown and caption is not None else label

    # ---- what moves ------------------------------------------------------------------------------------------------

    def _command(self, label: str) -> tuple[str, list[str], int]:
        """The command that makes an object, and its inputs; also where it stands within another one."""
        command = self.objects.commands.get(label)
        if command is None and label not in self.objects.elements and (inner := INNER.fullmatch(label.strip())):
            command = inner[1], _split_inputs(inner[2]), 0
        return command or ("", [], 0)

    def _needs(self, label: str) -> set[str]:
        """The objects that one is made of."""
        texts = [*self._command(label)[1], self.objects.terms.get(label, "")]
        return {name for text in texts for name in re.findall(NAME, text) if name in self.objects.elements} - {label}

    def _free(self, label: str) -> bool:
        term = self.objects.terms.get(label, "")
        return label not in self.objects.commands and not any(name in self.objects.elements for name in
                                                              re.findall(NAME, term))

    def _driving(self) -> Iterator[str]:
        """The free numbers that turn something, or are animated."""
        turned = [inputs[1] for name, inputs, _ in self.objects.commands.values() if name == "Rotate" and inputs[1:]]
        turned += ["".join(groups) for term in self.objects.terms.values() for groups in TURNED.findall(term)]
        turning = {name for text in turned for name in re.findall(NAME, text)}
        for label, element in self.objects.elements.items():
            if element.get("type") in ("numeric", "angle") and self._free(label):
                animated = element.find("animation")
                playing = animated is not None and animated.get("playing") == "true"
                if label in turning or playing:
                    yield label

    def moves(self, label: str) -> bool:
        """Whether a driving number, or a point that runs on something, makes an object move."""
        return label in self.moving or any(name in self.moving for name in self._needs(label))

    def _made_of(self, labels: Iterable[str]) -> set[str]:
        """Labels of these objects and of all that depend on them."""
        labels_made, new = {*labels}, [*labels]
        while new:
            new += (further := self.dependents.get(new.pop(), set()) - labels_made)
            labels_made |= further
        return labels_made

    # ---- links -----------------------------------------------------------------------------------------------------

    def _links(self, own: bool) -> Iterator[list[str]]:
        """The points of each link that is drawn; on graphplan's own files links are on the lowest layer."""
        omitted, changing = 0, list[str]()
        for label, element in self.objects.elements.items():
            command, inputs, place = self._command(label)
            layer = element.find("layer")
            strange = own and (layer is None or layer.get("val") != "0")
            if command not in ("Segment", "Polygon", "PolyLine",
                               "Polyline") or place or not is_shown(element) or strange:
                continue
            corners = [name for name in inputs if name in self.points and not (own and name.startswith("point_"))]
            if len(corners) < 2 or (len(corners) < len(inputs) and not own):
                omitted += not own
            elif command not in ("PolyLine", "Polyline") and self._changes(corners):
                changing.append("".join(corners))
            elif command in ("PolyLine", "Polyline"):
                yield from ([*pair] for pair in pairwise(corners) if not self._changes([*pair]))
            else:
                yield corners
        if changing:
            self.sketch.note(f"{', '.join(changing)}: left out, as their lengths change when the construction moves")
        if omitted:
            self.sketch.note(f"{omitted} segments or polygons whose ends are no points of their own: left out")

    def _join_straight_bars(self, links: list[list[str]]) -> list[list[str]]:
        """With bars that go on straight as one: graphplan draws a bar from point to point."""
        bars, at = [link for link in links if len(link) == 2], self.objects.values
        for first, second in combinations(bars, 2):
            for joint in {*first} & {*second}:
                arms = [at[next(name for name in bar[::step] if name != joint)] - at[joint]
                        for bar, step in ((first, 1), (second, -1))]
                if len({*first, *second}) > 2 and abs(sum(arm / abs(arm) for arm in arms)) < DIRECTION_TOL:
                    links.append([*dict.fromkeys([*first, *second])])
        return links

    def _read_constraint(self, label: str) -> None:
        """Read the condition on a point of a link: circles, lines, turns."""
        command, inputs, _ = self._command(label)
        if command == "Intersect":
            self._read_intersection(label, inputs[:2])
        elif command in ("Point", "PointIn") and inputs:
            self._read_point_on(label, inputs[0])
        elif command == "Rotate" and len(inputs) == 3 and {inputs[0], inputs[2]} <= self.points:
            self._read_rotation(label, *inputs)
        elif term := self.objects.terms.get(label, ""):
            self._read_term(label, term)

    def _read_intersection(self, label: str, inputs: list[str]) -> None:
        lines = [name for name in inputs if self._is_line(name)]
        for centre in map(self._centre, inputs):
            if centre is None:
                continue
            self._bar(centre, label)
            through = {*self._ends(next((line for line in lines), ""))} - {centre, label}
            if lines and centre in self._ends(lines[0]) and through:
                self._read_pointer(centre, label, through.pop())
                lines = []
        for line in lines:
            self._add_slide(label, line)

    def _read_pointer(self, centre: str, label: str, other: str) -> None:
        """A link that points where another point is: that slides on it, or is a handle that drives it."""
        if self.moves(other) or other in self.sketch.places:
            self._add_points(other)
            link = next(link for link, points in self.sketch.links.items() if {centre, label} <= {*points})
            self.sketch.slots.append(Slot(other, link, (centre, label)))
        else:
            self._drive(centre, label)

    def _read_point_on(self, label: str, path: str) -> None:
        """A point that runs on something: a crank's pin, a slide, or a point of a bar that moves."""
        centre, ends = self._centre(path), self._ends(path)
        if centre is not None:
            self._bar(centre, label)
            self._drive(centre, label)
        elif len(ends) == 2 and self.moves(path):
            self._bar(*ends, label)
        elif self._is_line(path):
            self._add_slide(label, path)
            self.sketch.note(f"{self.sketch.names[label]} is free on a line: a drive, if nothing else drives")

    def _read_rotation(self, label: str, point: str, angle: str, centre: str) -> None:
        if any(self.moves(name) for name in re.findall(NAME, angle) if name in self.objects.elements):
            self._bar(centre, label)
            if not self.moves(point):
                self._drive(centre, label)
        elif self.moves(point) or self.moves(centre):
            self._bar(centre, point, label)

    def _read_term(self, label: str, term: str) -> None:
        """An expression with a driving number, from one point that stands still: the pin of a crank."""
        needs = self._needs(label)
        pivots = [name for name in needs & self.points if not self.moves(name)]
        turned = {name for groups in TURNED.findall(term) for name in re.findall(NAME, "".join(groups))}
        if len(pivots) == 1 and len(needs & self.points) == 1 and any(self.moves(name) for name in turned & needs):
            self._bar(pivots[0], label)
            self._drive(pivots[0], label)
        elif turned & self.driving:
            partners = [partner for points in self.sketch.links.values() if label in points for partner in points
                        if not self.moves(partner)]
            if partners:
                self._drive(partners[0], label)

    def _read_carried_point(self, label: str) -> None:
        """A point that is seen, and made of points of one link alone, is one of that link."""
        command, inputs, _ = self._command(label)
        on = len(inputs) == 1
        of = [*self._ends(inputs[0])] if on else [name for name in inputs if name in self.points]
        if not (is_shown(self.objects.elements[label]) and command in RIGID and len(of) > 1):
            return
        if any(self.moves(name) for name in self._needs(label) - self.points) and not on:
            return
        if link := next((key for key, points in self.sketch.links.items() if {*of} <= {*points}), ""):
            self._add_points(label)
            self.sketch.hold(link, label)

    # ---- circles and lines -----------------------------------------------------------------------------------------

    def _centre(self, circle: str) -> str | None:
        """The centre of a circle whose radius is given, or the distance of points that stand still."""
        command, inputs, _ = self._command(circle)
        if command != "Circle" or len(inputs) != 2 or inputs[0] not in self.points:
            return None
        radius = [name for name in re.findall(NAME, inputs[1]) if name in self.objects.elements]
        bars = [name for name in radius if self._command(name)[0] == "Segment" and inputs[1].strip() == name]
        return None if not bars and any(self.moves(name) for name in radius) else inputs[0]

    def _is_line(self, name: str) -> bool:
        element = self.objects.elements.get(name)
        is_line = element is not None and element.get("type") in LINE_TYPES
        return name in AXES or is_line or (element is None and self._command(name)[0] in ("Line", "Segment", "Ray"))

    def _ends(self, line: str) -> tuple[str, ...]:
        """The two points by which a line is drawn, if it is."""
        command, inputs, _ = self._command(line)
        ends = tuple(name for name in inputs if name in self.points)
        return ends if command in ("Line", "Segment", "Ray") and len(ends) == len(inputs) == 2 else ()

    def _add_slide(self, label: str, line: str) -> None:
        """A slide along a line."""
        value: Any = self.objects.values.get(line) or self.objects.term(line)
        ends, along = self._ends(line), AXES.get(line, getattr(value, "along", None))
        if along is not None and not isinstance(value, PlaneVector) and not self.moves(line):
            self.sketch.slots.append(Slot(label, FRAME, along / abs(along)))
        elif len(ends) == 2:
            self._bar(*ends)
            link = next(link for link, points in self.sketch.links.items() if {*ends} <= {*points})
            self.sketch.slots.append(Slot(label, link, (ends[0], ends[1])))
        else:
            self.sketch.note(f"{self.sketch.names[label]} lies on the line {line}, which moves: left out")

    def _bar(self, *points: str) -> None:
        """Add a link of points, unless a link has them all."""
        self._add_points(*points)
        if not any({*points} <= {*link_points} for link_points in self.sketch.links.values()):
            self.sketch.link(points)

    def _drive(self, centre: str, pin: str) -> None:
        self.sketch.drives.append(SketchDrive((centre, pin), "omega = 1", GUESS.format(unit="rad/s")))

    def _frame(self) -> None:
        """Points that are made fixed; where anything moves also all that do not."""
        moving = any(self.moves(label) for label in self.sketch.places)
        led = self._made_of({point for drive in self.sketch.drives for point in drive.link[1:]})  # by a handle
        for label in self.sketch.places:
            flag = self.objects.elements[label].find("fixed")
            is_fixed = flag is not None and flag.get("val") == "true" and self._free(label)
            if is_fixed or ((moving or bool(self.sketch.drives)) and label not in self.moving | led):
                self.sketch.fixed[label] = None


def _split_inputs(inputs: str) -> list[str]:
    """The inputs of a command that is written out, without those of commands within it taken apart."""
    inputs_found, depth = [""], 0
    for letter in inputs:
        depth += (letter in "([") - (letter in ")]")
        if letter == "," and not depth:
            inputs_found.append("")
        else:
            inputs_found[-1] += letter
    return [entry.strip() for entry in inputs_found]
