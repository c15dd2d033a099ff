"""Drawings of GeoGebra (.ggb): points, lines and circles with their labels; a unit of its plane is a mm of paper."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from xml.etree.ElementTree import Element

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.files.constructions import (
    CAPTION,
    CIRCLES,
    LARGEST,
    LINES,
    CircleValue,
    LineValue,
    Objects,
    Vector,
    finite,
    of_construction,
    seen,
)
from graphplan.marking.files.curves import bow, full, reach
from graphplan.marking.files.drawing import drawing
from graphplan.marking.files.safe import contents
from graphplan.marking.spelling import lined, mark
from graphplan.marking.traces import Spot, Submission, Trace

ARCS = {"CircleArc", "CircularArc", "Arc"}


def read_ggb(path: Path) -> Submission:
    """The things that are to be seen in a GeoGebra file, and hidden points that are named as marks."""
    return of_construction(path, contents(path, LARGEST), lambda objects: drawing(path, _traces(objects), (), {}))


def _traces(objects: Objects) -> list[Trace]:
    """Points first, as lines without ends go as far as these do."""
    points = []
    for label, element in objects.elements.items():
        value, name = objects.values.get(label), mark(_letters(label, element))
        if element.get("type") == "point" and isinstance(value, complex) and (name or seen(element)):
            points.append(Trace(POINT, ((value.real, value.imag),), name))
    xs, ys = ([trace.spots[0][i] for trace in points] or [0.0] for i in (0, 1))
    box = [(x, y) for x in (min(xs), max(xs)) for y in (min(ys), max(ys))]  # no line without ends is seen farther
    return points + [trace for label in objects.elements for trace in _curve(objects, label, box)]


def _curve(objects: Objects, label: str, box: list[Spot]) -> Iterator[Trace]:
    """A line or circle that is seen; its label is a name where it is a Greek letter or a number, as others are given
    by GeoGebra."""
    element, value = objects.elements[label], objects.values.get(label)
    if not seen(element):
        return
    letters = mark(_letters(label, element))
    name = letters if lined(letters) else ""
    if element.get("type") in CIRCLES:
        yield from _round(objects, label, name)
    elif element.get("type") in LINES:
        ends = _ends(objects, label) or (reach(value.at, value.along, box) if isinstance(value, LineValue) else None)
        if ends is not None:
            yield Trace(LINE, ends, name)


def _round(objects: Objects, label: str, name: str) -> Iterator[Trace]:
    """A circle, or as much of it as an arc has."""
    command, inputs, _ = objects.commands.get(label, ("", [], 0))
    circle = objects.values.get(label)
    arc = [spot for term in inputs if (spot := objects.point(term)) is not None] if command in ARCS else []
    if len(arc) == 3 and arc[0] != arc[1]:
        centre, *ends = arc
        angles = [math.degrees(math.atan2((end - centre).imag, (end - centre).real)) for end in ends]
        yield Trace(CIRCLE, bow((centre.real, centre.imag), abs(ends[0] - centre), *angles), name)
    elif isinstance(circle, CircleValue):
        found = full((circle.at.real, circle.at.imag), circle.radius)
        yield Trace(found.kind, found.spots, name)


def _ends(objects: Objects, label: str) -> tuple[Spot, Spot] | None:
    """The ends of a segment, a polygon's side or a vector, which begins where it is put, else at the origin; None where
    there are none, or they are not known."""
    command, inputs, place = objects.commands.get(label, ("", [], 0))
    value, begin = objects.values.get(label), objects.elements[label].find("startPoint")
    start: complex | None = 0j
    end: complex | None = None
    if command == "Polygon" and 0 < place <= len(inputs):
        start, end = objects.point(inputs[place - 1]), objects.point(inputs[place % len(inputs)])
    elif command in ("Segment", "Vector") and len(inputs) == 2:
        start, end = objects.point(inputs[0]), objects.point(inputs[1])
    elif isinstance(value, Vector):
        if begin is not None:
            start = objects.point(begin.get("exp", "")) if "exp" in begin.attrib else complex(
                finite(begin.get("x", "0")), finite(begin.get("y", "0")))
        end = None if start is None else start + value.along
    if start is None or end is None or start == end:
        return None
    return (start.real, start.imag), (end.real, end.imag)


def _letters(label: str, element: Element) -> str:
    """What stands beside an object: its caption where this is shown or the label is no mark's, else its label."""
    mode, caption = element.find("labelMode"), element.find("caption")
    said = "" if caption is None else caption.get("val", "")
    captioned = not mark(label) or (mode is not None and mode.get("val") == CAPTION)
    return said if captioned and mark(said) else label
