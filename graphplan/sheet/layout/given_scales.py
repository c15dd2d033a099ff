"""Scales that the scene gives: they hold whatever room there is, or are refused."""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction

from graphplan.errors import Refused
from graphplan.kernel.program import Panel
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM, ForcePlan
from graphplan.sheet.layout.scales import ACCELERATIONS, VELOCITIES
from graphplan.sheet.plates.pens import FORCES
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.tolerances import SCALE_TOL

GivenScales = tuple[float | None, dict[str, Fraction]]
FREE: GivenScales = (None, {})


def given_scales(plans: Plans) -> GivenScales:
    """The mechanism plan's scale in lengths per mm, where it is given, and the multiples of the plans that have one.

    All plans are constructed in lengths of the mechanism plan, so one scale of any kind fixes that of the mechanism
    plan, and its kind of plan has no multiple but a given one. Fails with `Refused` where scales do not go together.
    """
    k_s = _mechanism_scale(plans.drawing)
    multiples = {panel: _multiple(plans, panel) for panel in plans.panels if panel != MECHANISM}
    _check_force_plans(plans)
    return k_s, {panel: multiple for panel, multiple in multiples.items() if multiple is not None}


def _mechanism_scale(drawing: Construction) -> float | None:
    """The one scale of the mechanism plan that all given scales lead to; none where none is given."""
    first: float | None = None
    for name, scale, lengths in _scales_of_scene(drawing):
        if first is not None and not math.isclose(scale * lengths, first, rel_tol=SCALE_TOL):
            raise Refused(f"sheet.{name} = {scale:g}", "the other scales of the scene's sheet do not go with it",
                          f"{name} = {first / lengths:.6g}, or leave one of them out")  # fmt: skip
        first = first or scale * lengths
    return first


def _scales_of_scene(drawing: Construction) -> Iterator[tuple[str, float, float]]:
    """The given scales: each with its name, and how many lengths one of its kind is drawn long."""
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
    """Every force plan that is spoken of is one that is drawn, unless none is."""
    force_plans = [panel for panel in plans.panels if isinstance(panel, ForcePlan)]
    for plan in plans.drawing.scene.sheet.multiples:
        if force_plans and ForcePlan.names(plan) and plan not in force_plans:
            raise Refused(f"sheet.multiples.{plan}", "there is no such plan", f"one of {', '.join(force_plans)}")
