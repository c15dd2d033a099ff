"""Which form is best where: over a mechanism's cycle, by how rounding grows in each form and by its pencil error.

In every pose each form is planned anew, as `construct` does for that pose. Its sheet keeps the scales that it has in
the given pose, as on a sheet with many poses; only the pencil's slips and the way they spread are those of the pose.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphplan.accuracy.drafted import drafted
from graphplan.accuracy.first_order import first_order
from graphplan.accuracy.hand import hand
from graphplan.accuracy.pencil import Pencil
from graphplan.accuracy.survey.draughtsman import PAPER
from graphplan.cycle import follow
from graphplan.errors import GraphplanError
from graphplan.mechanism.model import Scene
from graphplan.methods.construct import construct
from graphplan.methods.construction import Construction
from graphplan.methods.motion.alternatives import growth_of_rates
from graphplan.methods.styles import METHODS, MOTION_PLANS
from graphplan.sheet.layout.scales import Scales
from graphplan.solver import poses

SCENES = ("alt-eight-link-2", "alt-ten-link-2", "class-four", "double-butterfly", "stephenson", "triad")
POSES = 60
EQUAL = 1.05  # growths and errors within this factor of the least count as equal: then all of them are best
ROUNDING, PENCIL = "rounding", "pencil"
FORMS = tuple(f"{method}, {plan}" for plan in MOTION_PLANS for method in METHODS)


@dataclass(frozen=True)
class Sample:
    """One form in one pose: by how much errors of its steps grow in the results, or how far off a pencil draws them
    beside the largest; whether it is best there; or why it is not drawn. `travel` is the drive's, in degrees."""

    scene: str
    pose: int
    travel: float
    measure: str
    form: str
    value: float | None
    best: bool
    why: str = ""


def samples(scene: Scene, pencil: Pencil, count: int = POSES) -> Iterator[Sample]:
    """Every form in every pose of the cycle, by both measures."""
    turn = follow(scene, count)
    scales = {form: _scales(scene, form, pencil) for form in FORMS}
    for pose, travel in enumerate(np.degrees(turn.travel)):
        here = None if pose in turn.faults else poses.posed(
            scene, {name: complex(z[pose]) for name, z in turn.points.items()},
            {name: complex(z[pose]) for name, z in turn.guides.items()})
        found = {form: _measured(here, form, scales[form], pencil, turn.faults.get(pose, "")) for form in FORMS}
        for measure in (ROUNDING, PENCIL):
            values = {form: values.get(measure) for form, (values, _) in found.items()}
            best = least(values)
            for form, (_, why) in found.items():
                yield Sample(scene.name, pose, float(travel), measure, form, values[form], form in best,
                             "" if values[form] is not None else why or "infinite")


def least(values: Mapping[str, float | None]) -> set[str]:
    """The names whose values are all but the least of those that there are."""
    bound = EQUAL * min((value for value in values.values() if value is not None), default=0.0)
    return {name for name, value in values.items() if value is not None and value <= bound}


def _scales(scene: Scene, form: str, pencil: Pencil) -> Scales | GraphplanError:
    """The scales of a form's sheet in the given pose, or why it is not drawn there."""
    try:
        return drafted(_constructed(scene, form), pencil, PAPER).composition.scales
    except GraphplanError as refusal:
        return refusal


def _constructed(scene: Scene, form: str) -> Construction:
    method, plan = form.split(", ")
    return construct(scene, method=method, plan=plan)


def _measured(scene: Scene | None, form: str, scales: Scales | GraphplanError, pencil: Pencil,
              fault: str) -> tuple[dict[str, float], str]:
    """What a form is worth in one pose by each measure that there is, and why one is missing."""
    values = dict[str, float]()
    if scene is None:
        return values, fault
    try:
        drawing = _constructed(scene, form)
        values[ROUNDING] = growth_of_rates(drawing)
        if isinstance(scales, GraphplanError):
            raise scales
        values[PENCIL] = _error(drawing, scales, pencil)
    except GraphplanError as refusal:
        return _finite(values), refusal.lines[0]
    return _finite(values), ""


def _finite(values: dict[str, Any]) -> dict[str, float]:
    return {measure: value for measure, value in values.items() if np.isfinite(value)}


def _error(drawing: Construction, scales: Scales, pencil: Pencil) -> float:
    """The largest expected error of any result beside the largest of its kind, at these scales."""
    results = first_order(drawing, hand(drawing, scales, pencil), scales)
    return max((result.relative for result in results if result.relative is not None), default=0.0)
