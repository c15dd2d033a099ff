"""Which form is best where: over a mechanism's cycle, by how rounding grows in each form and by its pencil error.

In every pose each form is planned anew, as `construct` does for that pose. Its sheet keeps the scales that it has in
the given pose, as on a sheet with many poses; only the pencil's slips and the way they spread are those of the pose.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from graphplan.accuracy.drafted import drafted
from graphplan.accuracy.first_order import first_order
from graphplan.accuracy.hand import hand
from graphplan.accuracy.pencil import Pencil
from graphplan.accuracy.survey.draughtsman import PAPER
from graphplan.accuracy.survey.picture import Axis, Chart, Look, Series, SubChart, grouped
from graphplan.cycle import follow
from graphplan.errors import GraphplanError
from graphplan.mechanism.model import Scene
from graphplan.methods.construct import construct
from graphplan.methods.construction import Construction
from graphplan.methods.motion.alternatives import growth_of_rates
from graphplan.methods.styles import METHODS, MOTION_PLANS
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.plates.pens import BLUE, GREEN, GREY, RED
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
    if scene is None:
        return {}, fault
    values, why = dict[str, float](), ""
    try:
        drawing = _constructed(scene, form)
        values[ROUNDING] = growth_of_rates(drawing)
        if isinstance(scales, GraphplanError):
            raise scales
        results = first_order(drawing, hand(drawing, scales.of, pencil), scales)
        values[PENCIL] = max((result.relative or 0.0 for result in results), default=0.0)
    except GraphplanError as refusal:
        why = refusal.lines[0]
    return {measure: value for measure, value in values.items() if np.isfinite(value)}, why


ANY = "any method"
_HUES = {"orthogonal": ("#7f7f7f", BLUE, RED, GREEN), "polar": ("#d4d4d4", "#8fb0e6", "#eaa0a4", "#93cfa9")}
LOOKS = {f"{method}, {plan}": Look(colour, area=True) for plan in MOTION_PLANS
         for method, colour in zip((ANY, *METHODS), _HUES[plan], strict=True)}
NOWHERE = Look(GREY, area=True, hollow=True)
TRAVEL = Axis("travel of the drive from the given pose, degrees", log=False, step=60.0)
MEASURES = Axis("", log=False, after=((ROUNDING, ROUNDING), (PENCIL, PENCIL)))
REMARKS = (
    "Which form is best where: above by how much rounding grows in it, below by the expected pencil error, in "
    f"each pose of the cycle. Forms within {100 * EQUAL - 100:.0f} % of the best count as equal, and of equals "
    "orthogonal plans and the first method are shown; where every method is as good on a plan it is any. Blank: "
    "the mechanism does not come there, or no form is drawn."
)


def picture(rows: Sequence[Sample]) -> Chart:
    """The chart of these samples."""
    panels = tuple(SubChart(scene, TRAVEL, MEASURES, tuple(_bands(of))) for scene, of in grouped(rows, "scene").items())
    key = (*LOOKS.items(), ("no form there", NOWHERE))
    return Chart("The best form over the cycle", REMARKS, panels, 2, (160.0, 12.0), key)


def _bands(rows: Sequence[Sample]) -> Iterator[Series]:
    """Stretches of poses with one best form, for each measure."""
    travels = sorted({row.travel for row in rows})
    ends = dict(zip(travels, [*travels[1:], 2 * travels[-1] - travels[-2] if len(travels) > 1 else 360.0], strict=True))
    for measure in (ROUNDING, PENCIL):
        best: dict[float, list[str]] = {travel: [] for travel in travels}
        for row in rows:
            if row.measure == measure and row.best:
                best[row.travel].append(row.form)
        for name, part in groupby(travels, key=lambda travel: shown(best[travel])):
            stretch = list(part)
            yield Series(LOOKS.get(name, NOWHERE), ((stretch[0], measure), (ends[stretch[-1]], measure)))


def shown(best: Sequence[str]) -> str:
    """The name under which equally good forms are shown; none where there are none."""
    for plan in MOTION_PLANS:
        methods = [form.split(", ")[0] for form in best if form.endswith(f", {plan}")]
        if methods:
            return f"{ANY if len(methods) == len(METHODS) else methods[0]}, {plan}"
    return ""
