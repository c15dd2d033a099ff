"""Which method when: the quickest form that is accurate enough, by how near the pose is to a special one and by paper.

Each form is drawn by pencil to first order, each of its plans across half a sheet. The quickest form whose worst result
is within MAX_ERROR is the one to choose; where none is, the most accurate one, and where points fall together on paper
or the error is as large as the drawing, none.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby, pairwise, product
from math import sqrt

from graphplan.bench.picture import Axis, Chart, ChartSeries, Look, SubChart, group_rows
from graphplan.bench.problem import DEGENERACIES, FORCES, ORTHOGONAL, PLANS, POLAR, WAYS, Degeneracy
from graphplan.bench.stability import by_pencil, why_not_drawn_so
from graphplan.design.decide import construct
from graphplan.design.hand import Pencil
from graphplan.errors import GraphplanError
from graphplan.kernel.lemoine import counts
from graphplan.mechanism.units import ISO_SIZES
from graphplan.methods.construction import Construction
from graphplan.methods.design import Design

DISTANCES = tuple(10.0 ** (-k / 4) for k in range(17))  # 1 to 1e-4: nearer no pencil draws
SHEETS = ("A4", "A3", "A2", "A1")
PLAN_SHARE = 0.5  # of a sheet's longer side that a plan takes
MAX_ERROR = 0.1  # of the worst result, relative to the largest of its kind: what is accurate enough


@dataclass(frozen=True)
class FormAt:
    """One form at a distance from a special pose, on a sheet: its operations and its worst result's pencil error, or
    why there is none."""

    degeneracy: str
    distance: float
    form: str
    sheet: str
    operations: float | None
    error: float | None
    why: str = ""


def form_choices(degeneracy: Degeneracy) -> dict[str, tuple[str, Design]]:
    """The forms to choose from, each with its way and its design: methods on both kinds of plans,
    plans, or force plans."""
    if degeneracy.compared_ways in (PLANS, FORCES):
        return {way: (way, WAYS[way]) for way in degeneracy.compared_ways}
    return {f"{way}, {WAYS[plan].plan}": (way, replace(WAYS[way], plan=WAYS[plan].plan))
            for way, plan in product(degeneracy.compared_ways, (ORTHOGONAL, POLAR))}


def forms_at(*degeneracies: Degeneracy, pencil: Pencil, distances: Sequence[float] = DISTANCES) -> Iterator[FormAt]:
    """Every form of each degeneracy at each distance, on each sheet."""
    for degeneracy in degeneracies:
        for distance, (form, (way, choices)) in product(distances, form_choices(degeneracy).items()):
            scene = degeneracy.scene_at(distance)
            try:
                drawing = construct(scene, choices)
                refusal = why_not_drawn_so(drawing, way)
                operations = counts(drawing.drawn).operations
            except GraphplanError as fault:
                drawing, refusal, operations = None, fault.lines[0], None
            for sheet in SHEETS:
                error, why = (None, refusal) if drawing is None or refusal else _error_on(drawing, pencil, sheet)
                yield FormAt(degeneracy.name, distance, form, sheet, operations, error, why)


def _error_on(drawing: Construction, pencil: Pencil, sheet: str) -> tuple[float | None, str]:
    """The error of the worst result on a sheet, or why there is none."""
    try:
        return by_pencil(drawing, pencil, PLAN_SHARE * ISO_SIZES[sheet][0])
    except GraphplanError as fault:
        return None, fault.lines[0]


def best_form(rows: Sequence[FormAt]) -> FormAt | None:
    """The form to choose among those at one place: the quickest that is accurate enough, else the most accurate."""
    drawn = [row for row in rows if row.error is not None]
    accurate = [row for row in drawn if (row.error or 0.0) <= MAX_ERROR]
    return min(accurate, key=lambda row: (row.operations or 0.0, row.error or 0.0)) if accurate else min(
        drawn, key=lambda row: row.error or 0.0, default=None)


TINTS = {  # method by the hue, polar plans paler
    "auxiliary points, orthogonal": "#9ecae1", "auxiliary points, polar": "#d3e5f4",
    "trial figures, orthogonal": "#fdae6b", "trial figures, polar": "#fee0c4",
    "relative pole, orthogonal": "#8fce94", "relative pole, polar": "#d2efcf",
    "false position, orthogonal": "#b5b3dc", "false position, polar": "#e2e1f1",
    ORTHOGONAL: "#e39aa2", POLAR: "#f8d5d8", "force polygons": "#d6d59b", "lever": "#b5deda",
}
NO_FORM = Look("#969696", area=True, hollow=True)
SHEET_AXIS = Axis("", before=tuple((sheet, sheet) for sheet in SHEETS))
DISTANCE = Axis("distance d from the special pose", falling=True)
REMARKS = (
    "On each sheet, whose plans are half as wide as it is: the quickest form whose worst result has a pencil error of "
    "at most {limit:.0%} of the largest of its kind, to first order with {pencil}, and its number of drawing "
    "operations. Hollow: where none is as accurate as that, the most accurate one. At d = 0 the pose is special for "
    "one of the forms, or singular for all."
)


def picture(rows: Sequence[FormAt], pencil: str) -> Chart:
    """The chart of the forms to choose."""
    described = {degeneracy.name: degeneracy for degeneracy in DEGENERACIES}
    panels = tuple(_panel(described[name], of) for name, of in group_rows(rows, "degeneracy").items())
    return Chart("Which method when", REMARKS.format(limit=MAX_ERROR, pencil=pencil), panels, 2, (160.0, 26.0), (
        *((form, Look(tint, area=True)) for form, tint in TINTS.items()), ("no form can be drawn", NO_FORM)))


def _panel(degeneracy: Degeneracy, rows: Sequence[FormAt]) -> SubChart:
    """One way to a special pose: on each sheet what to choose from where to where."""
    series = tuple(stretch for sheet, of in group_rows(rows, "sheet").items() for stretch in _stretches(sheet, of))
    return SubChart(f"{degeneracy.name}: {degeneracy.description}", DISTANCE, SHEET_AXIS, series)


def _stretches(sheet: str, rows: Sequence[FormAt]) -> Iterator[ChartSeries]:
    """Stretches of the distance in which one form is to be chosen, with what it takes."""
    best = {of[0].distance: best_form(of) for of in group_rows(rows, "distance").values()}
    distances = list(best)
    ends = [distances[0], *(sqrt(here * beyond) for here, beyond in pairwise(distances)), distances[-1]]
    for (label, look), places in groupby(range(len(distances)), key=lambda k: _label_and_look(best[distances[k]])):
        stretch = list(places)
        yield ChartSeries(look, ((ends[stretch[0]], sheet), (ends[stretch[-1] + 1], sheet)), label=label)


def _label_and_look(chosen: FormAt | None) -> tuple[str, Look]:
    """A form's operations, and its tint, hollow where it is not accurate enough."""
    if chosen is None:
        return "", NO_FORM
    accurate = (chosen.error or 0.0) <= MAX_ERROR
    return f"{chosen.operations:g}" if accurate else "", Look(TINTS[chosen.form], area=True, hollow=not accurate)
