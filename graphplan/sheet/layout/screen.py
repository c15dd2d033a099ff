"""The division of a screen, a film's pictures or a column of text among the plans: one layout for all poses, no title.

So that nothing has to make way while the mechanism moves, room is found for what the plans show over the whole travel.
Where vectors grow without bounds, as towards a limit position, there is room for those of most poses.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from graphplan.errors import Refused
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.kernel.program import Panel, evaluate
from graphplan.methods.construction import Construction
from graphplan.methods.forces.loading import given_loads
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.cycle_frames import inputs_in_pose
from graphplan.sheet.layout.composition import Composition, composition_of
from graphplan.sheet.layout.division import Packing, divide_among_plans
from graphplan.sheet.layout.paper import NO_GIVEN_SCALES, Arrangement, given_scales, panel_demands
from graphplan.sheet.plates.display import Rect, Spot
from graphplan.sheet.plates.plans import Plans, bounding_box, extend_box

SCREENS_MM = ("A4", 250.0, 145.0), ("A4", 310.0, 180.0), ("A3", 380.0, 220.0)  # and the paper whose letters they have
EDGE_MM = 1.0  # mm around the panels
COLUMN_PAPER = "A4"  # whose letters pictures in a column of text have
COLUMN_REDUCTIONS = 1.0, 1.4  # how many times as small as on paper letters may be there: 5 points at least
COLUMN_HEIGHTS = 0.6, 1.0, 1.5, 2.2  # of a picture in a column, beside its width
MAX_COLUMN_HEIGHT = 3.5  # the same where letters need it
MAX_POOR_SHARE_IN_COLUMN = 0.1  # of all letters may find no good place
MAX_OVER_GIVEN = 1.2  # how much larger than in the given pose a plan may become at one scale
MAX_OVER_LINKS = 1.4  # how much larger than its links the mechanism plan may be for vectors
LARGER_MECHANISM = 4  # how many times the marks of any plan the mechanism plan has room for
Array = Any


def compose_for_screen(plans: Plans, screens: Sequence[tuple[str, float, float]] = SCREENS_MM) -> Composition:
    """The plans on the smallest screen on which they can be read, or on the largest: the smaller it is, the larger
    its letters are seen."""
    *smaller, largest = screens
    for paper, wide, high in smaller:
        composition = _in_region(plans, paper, wide, high)
        if composition and composition.legible:
            return composition
    return _require_room(_in_region(plans, *largest))


def compose_for_column(plans: Plans, wide: float, scales_told: bool = True) -> Composition:
    """The plans for a picture in a column of text so many mm wide: it may be wider, to be reduced with its letters, and
    is as high as these need to stand apart. Where no scales are told plans are as large as there is room."""
    plans = replace(plans, scales_told=scales_told)
    sizes = [(times, high) for times in COLUMN_REDUCTIONS for high in COLUMN_HEIGHTS]
    best = None
    for times, high in (*sizes, (COLUMN_REDUCTIONS[-1], MAX_COLUMN_HEIGHT)):
        tried = _in_region(plans, COLUMN_PAPER, wide * times, wide * times * high, large_mechanism=False)
        if tried and (best is None or tried.poor < best.poor):
            best = tried
        if best and best.poor <= MAX_POOR_SHARE_IN_COLUMN:
            break
    return _require_room(best)


def _require_room(composition: Composition | None) -> Composition:
    """A composition that there must be; fails with `Refused` where the plans have no room."""
    if composition is None:
        raise Refused("the plans", "they have no room", "fewer results in [find]")
    return composition


def _in_region(plans: Plans, paper: str, wide: float, high: float, large_mechanism: bool = True) -> Composition | None:
    """The plans in so much room, with the letters of some paper; None if they do not fit."""
    region = Rect(EDGE_MM, EDGE_MM, wide - EDGE_MM, high - EDGE_MM)
    for given in (given_scales(plans), NO_GIVEN_SCALES):
        demands = panel_demands(plans, given, paper)
        most = max(demand.marks for demand in demands.values())
        if large_mechanism and MECHANISM in demands:  # as the eye is on it: as large as the plan with the most marks
            demands[MECHANISM] = replace(demands[MECHANISM], marks=LARGER_MECHANISM * most)
        panels = divide_among_plans(Packing(region), None, demands, plans.twins)
        if panels:
            corner = Rect(region.right, region.bottom, region.right, region.bottom)
            return composition_of(Arrangement(paper, wide, high, region, panels, (), corner), plans, given)
    return None


def with_poses(plans: Plans, drawings: Iterable[Construction], points: Mapping[str, Array], guides: Mapping[str, Array],
               loads: Mapping[str, Array]) -> Plans:
    """The plans, which have room for what constructions of their scene show in these poses: arrays of shape (n,)."""
    boxes: dict[Panel, list[Rect]] = {panel: [] for panel in plans.panels}
    for drawing in drawings:
        if (drawn_plans := Plans(drawing)).panels == plans.panels:
            for panel, boxes_of_poses in _boxes(drawn_plans, points, guides, loads).items():
                boxes[panel] += boxes_of_poses
    swept = {panel: _usual_box(boxes[panel], plans.extent(panel).core) for panel in boxes if panel != MECHANISM}
    if MECHANISM in boxes:
        links = _boxes_of([np.array([z.real, z.imag]) for z in points.values()])
        swept[MECHANISM] = _links_and_vectors(links, boxes[MECHANISM])
    return replace(plans, swept={panel: box for panel, box in swept.items() if box})


def _boxes(plans: Plans, points: Mapping[str, Array], guides: Mapping[str, Array],
           loads: Mapping[str, Array]) -> dict[Panel, list[Rect]]:
    """Boxes of each plan in each pose in which it can be drawn."""
    drawing, drawn = plans.drawing, plans.drawing.drawn
    inputs = inputs_in_pose(drawn, points, guides) | given_loads(drawn, drawing.scene, drawing.phi, loads)
    with np.errstate(all="ignore"):
        values = evaluate(drawn, Arrays(), inputs)
    count, boxes = len(next(iter(points.values()))), {}
    for panel in plans.panels:
        marks = [*plans.ends(panel)] or plans.points(panel)
        places = [np.array([np.broadcast_to(part, count) for part in values[mark][:2]]) for mark in marks]
        if marks and panel != MECHANISM:  # its window goes with the first of them
            shift = np.array(plans.spot(marks[0]))[:, None] - places[0]
            places = [place + shift for place in places]
        boxes[panel] = _boxes_of(places)
    return boxes


def _boxes_of(places: Sequence[Array]) -> list[Rect]:
    """The box around some points, arrays of shape (2, n), in each pose in which all are somewhere."""
    if not places:
        return []
    low, high = np.min(places, axis=0), np.max(places, axis=0)  # nan where any is
    return [Rect(*map(float, (*low[:, k], *high[:, k]))) for k in np.flatnonzero(np.isfinite(low + high).all(axis=0))]


def _usual_box(boxes: Sequence[Rect], given: Rect) -> tuple[Spot, ...]:
    """The corners of a box around those of all poses in which a plan is hardly larger than in the given one."""
    return _around([box for box in boxes if _size(box) <= MAX_OVER_GIVEN * _size(given)])


def _links_and_vectors(links: Sequence[Rect], vectors: Iterable[Rect]) -> tuple[Spot, ...]:
    """The corners of a box around the links in all poses, and around as many of their vectors as it may grow for."""
    corners = _around(links)
    if not corners:
        return ()
    whole = bounding_box(corners)
    most = MAX_OVER_LINKS * _size(whole)
    for box in sorted(vectors, key=_size):
        larger = extend_box(extend_box(whole, (box.left, box.bottom)), (box.right, box.top))
        whole = larger if _size(larger) <= most else whole
    return whole.corners


def _around(boxes: Sequence[Rect]) -> tuple[Spot, ...]:
    return bounding_box([spot for box in boxes for spot in box.corners]).corners if boxes else ()


def _size(box: Rect) -> float:
    return math.hypot(box.width, box.height)
