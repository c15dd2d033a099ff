"""Drawings of GeoGebra (.ggb): points, lines and circles with their labels; a unit of its plane is a mm of paper."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from xml.etree.ElementTree import Element

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.files import measures
from graphplan.marking.files.constructions import (
    CAPTION_MODE,
    CIRCLE_TYPES,
    LINE_TYPES,
    CircleValue,
    GeoGebraObjects,
    LineValue,
    PlaneVector,
    coordinate,
    is_shown,
    read_construction,
)
from graphplan.marking.files.drawing import arc_spots, circle_trace, drawing_submission, visible_stretch
from graphplan.marking.files.safe import contents
from graphplan.marking.traces import Spot, Submission, Trace, can_name_line, mark_name

ARC_COMMANDS = {"CircleArc", "CircularArc", "Arc"}


def read_ggb(path: Path) -> Submission:
    """The things that are to be seen in a GeoGebra file, and hidden points that are named as marks."""
    return read_construction(path, contents(path, measures.MAX_GGB_BYTES),
                             lambda objects: drawing_submission(path, _traces(objects), (), {}, _tips(objects)))


def _traces(objects: GeoGebraObjects) -> list[Trace]:
    """Points first, as lines without ends go as far as these do."""
    points = []
    for label, element in objects.elements.items():
        value, name = objects.values.get(label), mark_name(_letters(label, element))
        if element.get("type") == "point" and isinstance(value, complex) and (name or is_shown(element)):
            points.append(Trace(POINT, ((value.real, value.imag),), name))
    xs, ys = ([trace.spots[0][i] for trace in points] or [0.0] for i in (0, 1))
    box = [(x, y) for x in (min(xs), max(xs)) for y in (min(ys), max(ys))]  # no line without ends is seen farther
    return points + [trace for label in objects.elements for trace in _curve(objects, label, box)]


def _tips(objects: GeoGebraObjects) -> list[Spot]:
    """Where the vectors end that are seen."""
    return [ends[1] for label, element in objects.elements.items()
            if element.get("type") == "vector" and is_shown(element) and (ends := _ends(objects, label))]


def _curve(objects: GeoGebraObjects, label: str, box: list[Spot]) -> Iterator[Trace]:
    """A line or circle that is seen; its label is a name where it is a Greek letter or a number, as others are given
    by GeoGebra."""
    element, value = objects.elements[label], objects.values.get(label)
    if not is_shown(element):
        return
    letters = mark_name(_letters(label, element))
    name = letters if can_name_line(letters) else ""
    if element.get("type") in CIRCLE_TYPES:
        yield from _round(objects, label, name)
    elif element.get("type") in LINE_TYPES:
        ends = _ends(objects,
                     label) or (visible_stretch(value.at, value.along, box) if isinstance(value, LineValue) else None)
        if ends is not None:
            yield Trace(LINE, ends, name)


def _round(objects: GeoGebraObjects, label: str, name: str) -> Iterator[Trace]:
    """A circle, or as much of it as an arc has."""
    command, inputs, _ = objects.commands.get(label, ("", [], 0))
    circle = objects.values.get(label)
    arc = [spot for term in inputs if (spot := objects.point(term)) is not None] if command in ARC_COMMANDS else []
    if len(arc) == 3 and arc[0] != arc[1]:
        centre, *ends = arc
        angles = [math.degrees(math.atan2((end - centre).imag, (end - centre).real)) for end in ends]
        yield Trace(CIRCLE, arc_spots((centre.real, centre.imag), abs(ends[0] - centre), *angles), name)
    elif isinstance(circle, CircleValue):
        trace = circle_trace((circle.at.real, circle.at.imag), circle.radius)
        yield Trace(trace.kind, trace.spots, name)


def _ends(objects: GeoGebraObjects, label: str) -> tuple[Spot, Spot] | None:
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
    elif isinstance(value, PlaneVector):
        if begin is not None:
            start = objects.point(begin.get("exp", "")) if "exp" in begin.attrib else complex(
                coordinate(begin.get("x", "0")), coordinate(begin.get("y", "0")))
        end = None if start is None else start + value.along
    if start is None or end is None or start == end:
        return None
    return (start.real, start.imag), (end.real, end.imag)


def _letters(label: str, element: Element) -> str:
    """What stands beside an object: its caption where this is shown or the label is no mark's, else its label."""
    mode, caption = element.find("labelMode"), element.find("caption")
    caption_text = "" if caption is None else caption.get("val", "")
    captioned = not mark_name(label) or (mode is not None and mode.get("val") == CAPTION_MODE)
    return caption_text if captioned and mark_name(caption_text) else label
