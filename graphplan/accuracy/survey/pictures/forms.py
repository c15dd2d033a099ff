"""The best forms over a cycle as a picture: two strips a scene, coloured by the form that is best in each pose."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from graphplan.accuracy.survey.best_forms import EQUAL, PENCIL, ROUNDING, Sample
from graphplan.accuracy.survey.picture import Axis, Chart, Look, Series, SubChart, grouped
from graphplan.methods.styles import METHODS, MOTION_PLANS
from graphplan.sheet.plates.pens import BLUE, GREEN, GREY, RED

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
