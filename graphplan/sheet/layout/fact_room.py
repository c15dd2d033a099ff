"""Room for what is given and found on a composed sheet: among what is drawn, or where plans make room for it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace
from fractions import Fraction

from graphplan.kernel.program import Panel
from graphplan.sheet.layout.division import CAPTION
from graphplan.sheet.layout.facts_block import FactPlace, FactRows
from graphplan.sheet.layout.free_room import places_in_free_room
from graphplan.sheet.layout.paper import Arrangement, room_for_marks
from graphplan.sheet.layout.plan_scales import GivenScales, unit_lengths
from graphplan.sheet.layout.scales import Scales, round_up
from graphplan.sheet.plates.display import Item, Polygon, Polyline
from graphplan.sheet.plates.pens import BORDER
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.view import View, plan_box

FEW_MARKS, COARSER = 6, 2.0  # of a plan that is made smaller for facts, and by how much at least


def free_places(facts: FactRows, arrangement: Arrangement, drawn: Iterable[Item]) -> tuple[FactPlace, ...]:
    """Places for facts among what is drawn on the plans; none where there is no room."""
    items = list(drawn)
    for panel in arrangement.panels.values():
        caption = replace(panel, bottom=panel.top - CAPTION)
        items += [Polygon(BORDER, "paper", None, caption.corners),
                  Polyline(BORDER, "paper", None, (*panel.corners, panel.corners[0]))]
    items += [Polygon(BORDER, "paper", None, rect.corners) for rect in (arrangement.title, *arrangement.columns)]
    return places_in_free_room(arrangement.frame, items, facts.enlarge(arrangement.letters.times), arrangement.title)


def lower_plans(views: Mapping[str, View], plans: Plans) -> dict[str, View]:
    """The windows with each plan at the foot of its panel, which leaves room at the head."""
    views = dict(views)
    for panel, window in views.items():
        (x, y), room = window.origin, room_for_marks(window.rect)
        box = plan_box(plans.extents[panel], room, 1 / window.scale)
        views[panel] = replace(window, origin=(x, min(y, room.bottom - window.scale * box.bottom)))
    return views


def raise_plan(window: View, panel: Panel, plans: Plans) -> View:
    """The window with its plan at the head of the panel."""
    (x, y), top = window.origin, max((window(plans.spot(mark))[1] for mark in plans.points(panel)), default=math.inf)
    return replace(window, origin=(x, max(y, y + room_for_marks(window.rect).top - top)))


def smaller_plan(plans: Plans, scales: Scales) -> tuple[Panel, GivenScales] | None:
    """The plan of fewest marks, and scales at which it is smaller; none where it has many."""
    panel = min(plans.panels[1:], key=plans.point_counts.__getitem__, default=None)
    if not panel or plans.point_counts[panel] > FEW_MARKS:
        return None
    coarser = round_up(COARSER * scales.lengths_per_mm(panel), unit_lengths(plans, panel))
    twins = [twin for twin in plans.panels[1:] if plans.twins[twin] == plans.twins[panel]]
    return panel, (scales.k_s, scales.multiples | dict.fromkeys(twins, Fraction(scales.k_s) / coarser))
