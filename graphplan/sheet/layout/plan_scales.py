"""The scales and windows of all plans: round ones for the room that there is, and those that the scene gives.

Given scales hold whatever room there is, or are refused.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction

from graphplan.errors import Refused
from graphplan.kernel.program import Panel
from graphplan.mechanism.model import Number
from graphplan.mechanism.units import millimetre
from graphplan.methods.construction import Construction
from graphplan.methods.panels import SHEET_EXTENTS, ForcePlan
from graphplan.sheet.layout.division import Demand, divide_among_plans
from graphplan.sheet.layout.paper import CAPTION_SIDE, room_for_marks
from graphplan.sheet.layout.scales import ACCELERATIONS, VELOCITIES, Scales, is_round, lengths_of, round_up
from graphplan.sheet.lettering.lettering import letter_sizes, sentence_runs, two_line_width
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.plates.pens import FORCES
from graphplan.sheet.plates.plans import Plans, bounding_box
from graphplan.sheet.plates.view import COARSER, MUCH_COARSER, View, plan_box, plan_scale, view, wanted_box
from graphplan.sheet.tolerances import SCALE_TOL
from graphplan.sheet.words.lengths import MAX_ENLARGEMENT

GivenScales = tuple[float | None, dict[str, Fraction]]
NO_GIVEN_SCALES: GivenScales = (None, {})


def given_scales(plans: Plans) -> GivenScales:
    """The mechanism plan's scale in lengths per mm, where it is given, and the multiples of the plans that have one.

    All plans are constructed in lengths of the mechanism plan, so one scale of any kind fixes that of the mechanism
    plan, and its kind of plan has no multiple but a given one. Fails with `Refused` where scales do not go together.
    """
    k_s = _mechanism_scale(plans.drawing)
    multiples = {panel: _multiple(plans, panel) for panel in plans.panels[1:]}
    _check_force_plans(plans)
    return k_s, {panel: multiple for panel, multiple in multiples.items() if multiple is not None}


def _mechanism_scale(drawing: Construction) -> float | None:
    """The scale of the mechanism plan that follows from the given scales; None where none is given."""
    first: float | None = None
    for name, scale, lengths in _scales_of_scene(drawing):
        if first is not None and not math.isclose(scale * lengths, first, rel_tol=SCALE_TOL):
            raise Refused(f"sheet.{name} = {scale:g}", "the other scales of the scene's sheet do not go with it",
                          f"{name} = {first / lengths:.6g}, or leave one of them out")  # fmt: skip
        first = first or scale * lengths
    return first


def _scales_of_scene(drawing: Construction) -> Iterator[tuple[str, float, float]]:
    """The given scales: name, value, and how many lengths long a unit of the quantity is drawn."""
    sheet = drawing.scene.sheet
    if sheet.k_F and drawing.scene.loads is None:
        raise Refused("sheet.k_F", "the scene has no forces to draw", "leave it out")
    kinds = (("k_s", sheet.k_s, 1.0), ("k_v", sheet.k_v, drawing.kappa), ("k_a", sheet.k_a, drawing.kappa**2),
             ("k_F", sheet.k_F, float(drawing.phi)))  # fmt: skip
    yield from ((name, float(scale), lengths) for name, scale, lengths in kinds if scale is not None)


def _multiple(plans: Plans, panel: Panel) -> Fraction | None:
    """The multiple given for a plan, or 1 where a scale of its vectors is given."""
    sheet, kinds = plans.drawing.scene.sheet, plans.kinds(panel)
    plan = panel.whole
    multiple = sheet.multiples.get(plan, sheet.multiples.get(plan.twin))
    scaled = ((sheet.k_v, VELOCITIES), (sheet.k_a, ACCELERATIONS), (sheet.k_F, FORCES))
    return multiple or (Fraction(1) if any(scale and kinds & of for scale, of in scaled) else None)


def _check_force_plans(plans: Plans) -> None:
    """Refuse a multiple for a force plan that is not drawn, unless no force plan is drawn."""
    force_plans = [panel for panel in plans.panels if isinstance(panel, ForcePlan)]
    for plan in plans.drawing.scene.sheet.multiples:
        if force_plans and ForcePlan.names(plan) and plan not in force_plans:
            raise Refused(f"sheet.multiples.{plan}", "unknown plan", f"choose one of {', '.join(force_plans)}")


# ---- scales and windows for the room that there is -------------------------------------------------------------------


def windows(rooms: Mapping[str, Rect], plans: Plans,
            given: GivenScales = NO_GIVEN_SCALES) -> tuple[Scales, dict[str, View]]:
    """The scales, round if they are not given, and the windows of plans in their rooms."""
    scales = choose_scales({panel: room_for_marks(rect) for panel, rect in rooms.items()}, plans, given)
    boxes = {panel: plan_box(extent, room_for_marks(rooms[panel]), scales.lengths_per_mm(panel))
             for panel, extent in plans.extents.items()}
    return scales, {panel: view(box, rooms[panel], scales.lengths_per_mm(panel)) for panel, box in boxes.items()}


def choose_scales(rooms: Mapping[str, Rect], plans: Plans, given: GivenScales) -> Scales:
    """The scales, round if they are not given, for so much room for the marks of each plan; twins have one."""
    drawing, names, (k_s, given_multiples) = plans.drawing, plans.drawing.scene.units, given
    box = bounding_box([corner for rect in rooms.values() for corner in rect.corners])
    side, first = max(box.width, box.height), plans.panels[0]
    lengths = unit_lengths(plans, first)
    mechanism_scale = Fraction(k_s or plan_scale(plans.extents[first], rooms[first], COARSER, lengths))
    times = plans.extents[first].longest / side / float(mechanism_scale)
    if not k_s and 1 < times <= SHEET_EXTENTS:
        mechanism_scale = max(mechanism_scale, round_up(times * float(mechanism_scale), lengths))
    most: dict[str, Fraction] = {}
    for panel in plans.panels[1:]:
        twin, lengths = plans.twins[panel], unit_lengths(plans, panel)
        scale = plan_scale(plans.extents[panel], rooms[panel], MUCH_COARSER, lengths)
        if (least := plans.extents[panel].longest / side) > scale:
            scale = round_up(least, lengths)
        most[twin] = max(scale, most.get(twin, scale))
    for source, panel in plans.carry_overs:
        if panel != first:
            twin, taken = plans.twins[panel], most.get(plans.twins[source], mechanism_scale)
            most[twin] = max(most[twin], round_up(float(taken) / MAX_ENLARGEMENT, unit_lengths(plans, panel)))
    multiples: dict[str, Fraction] = {panel: mechanism_scale / most[plans.twins[panel]] for panel in plans.panels[1:]}
    return Scales(float(mechanism_scale), drawing.kappa, names.length, multiples | given_multiples, float(drawing.phi),
                  names.force, drawing.scene.sheet.convention)


def unit_lengths(plans: Plans, panel: Panel) -> Sequence[Number]:
    """Lengths per unit of each quantity that has a scale on a plan or on its twin; none where no scale is told. Those
    of motion are in mm where the scene gives a scale that is not round in its own unit, such as 1 : 10 in inches: then
    the others are a simple number of times as large."""
    if not plans.scales_told:
        return ()
    drawing, kinds = plans.drawing, plans.kinds(panel) | plans.kinds(plans.twins[panel])
    moving, forces = (lengths_of(of, drawing.tempo.kappa, drawing.phi) for of in (kinds - FORCES, kinds & FORCES))
    if panel == plans.panels[0] or not (moving or forces):
        moving = [1, *moving]
    k_s = drawing.scene.sheet.k_s
    unit = millimetre(drawing.scene.units) if k_s and not is_round(k_s) else Fraction(1)
    return [*(unit * Fraction(length) for length in moving), *forces]


def panel_demands(plans: Plans, given: GivenScales, paper: str) -> dict[str, Demand]:
    """What each plan demands of its panel on a paper."""
    demands, (k_s, multiples), size = dict[str, Demand](), given, letter_sizes(paper).text
    first = plans.panels[0]
    for panel in plans.panels:
        head = sentence_runs(plans.tongue(panel.caption(plans.kinds(panel))))
        box = wanted_box(plans.extents[panel], COARSER if panel == first else MUCH_COARSER)
        scale = k_s if panel == first else k_s / float(multiples[panel]) if k_s and panel in multiples else None
        demands[panel] = Demand(box.width, box.height, max(1, plans.point_counts[panel]), unit_lengths(plans, panel),
                                two_line_width(head, size) + 2 * CAPTION_SIDE, scale)
    return demands


def divide_region(wants: Sequence[Mapping[str, Demand]], plans: Plans, paper: str, region: Rect, block: Rect | None,
                  facts: Sequence[tuple[float, float]] = ()) -> dict[str, Rect] | None:
    """Divide a region by the first demands for which there is room; the same one once, whatever words stand beside."""
    scales = tuple([demand.given for demands in wants for demand in demands.values()])
    place = divide_among_plans, paper, scales, region, block, tuple(facts)
    if place not in plans.drawn:
        divisions = (divide_among_plans(region, block, demands, plans.twins, facts) for demands in wants)
        plans.drawn[place] = next(filter(None, divisions), None)
    divided = plans.drawn[place]
    return divided and {**divided}
