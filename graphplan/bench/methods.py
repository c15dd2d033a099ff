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

from graphplan.bench.problem import (
    AUXILIARY,
    DEGENERACIES,
    FALSE,
    FORCES,
    LEVER,
    LOCI,
    ORTHOGONAL,
    PLANS,
    POLAR,
    POLES,
    POLYGONS,
    RINGS,
    TRIAL,
    TWO_TRIALS,
    WAYS,
    Degeneracy,
)
from graphplan.bench.rows import group_rows
from graphplan.bench.stability import SHEET, by_pencil, why_not_drawn_so
from graphplan.design.decide import construct
from graphplan.design.hand import Pencil
from graphplan.errors import GraphplanError
from graphplan.kernel.images import TRIAL_LAWS
from graphplan.kernel.kinds import plain
from graphplan.kernel.lemoine import counts
from graphplan.mechanism.units import ISO_SIZES
from graphplan.methods.construction import Construction
from graphplan.methods.design import OPEN, Design
from graphplan.output import diagrams

DISTANCES = tuple(10.0 ** (-k / 4) for k in range(17))  # 1 to 1e-4: nearer no pencil draws
SHEETS = ("A4", "A3", "A2", "A1")
PLAN_SHARE = 0.5  # of a sheet's longer side that a plan takes
MAX_ERROR = 0.1  # of the worst result, relative to the largest of its kind: what is accurate enough


@dataclass(frozen=True)
class FormAt:
    """One form at a distance from a special pose, on a sheet: its operations and its worst result's pencil error, or
    why there is none. `drawn` is what its pose makes of it: the form and the plans in which it is drawn."""

    degeneracy: str
    distance: float
    form: str
    sheet: str
    operations: float | None
    error: float | None
    why: str = ""
    drawn: str = ""


def form_choices(degeneracy: Degeneracy) -> dict[str, tuple[str, Design]]:
    """Return the forms to choose from, each with its way and its design: methods on both kinds of plans, plans, or
    force plans; and the one that the pose chooses itself."""
    if degeneracy.compared_ways in (PLANS, FORCES):
        return {way: (way, WAYS[way]) for way in degeneracy.compared_ways} | {SHEET: (SHEET, OPEN)}
    ways = {**{way: WAYS[way] for way in degeneracy.compared_ways},
            **({TWO_TRIALS: WAYS[TWO_TRIALS]} if degeneracy.compared_ways == LOCI else {}), SHEET: OPEN}
    return {f"{way}, {WAYS[plan].plan}": (way, replace(design, plan=WAYS[plan].plan))
            for (way, design), plan in product(ways.items(), (ORTHOGONAL, POLAR))}


def forms_at(*degeneracies: Degeneracy, pencil: Pencil, distances: Sequence[float] = DISTANCES) -> Iterator[FormAt]:
    """Yield every form of each degeneracy at each distance, on each sheet."""
    for degeneracy in degeneracies:
        for distance, (form, (way, choices)) in product(distances, form_choices(degeneracy).items()):
            scene = degeneracy.scene_at(distance)
            try:
                drawing = construct(scene, choices)
                refusal = why_not_drawn_so(drawing, way)
                operations = counts(drawing.drawn).operations
                drawn_form = _drawn_form(drawing, degeneracy) if way == SHEET else form
            except GraphplanError as fault:
                drawing, refusal, operations, drawn_form = None, fault.lines[0], None, ""
            for sheet in SHEETS:
                error, why = (None, refusal) if drawing is None or refusal else _error_on(drawing, pencil, sheet)
                yield FormAt(degeneracy.name, distance, form, sheet, operations, error, why, drawn_form)


def _drawn_form(drawing: Construction, degeneracy: Degeneracy) -> str:
    """Return the form in which the pose's own construction is drawn, by the names of the ways."""
    if degeneracy.compared_ways == FORCES:
        return BOTH_FORCES
    if degeneracy.compared_ways == PLANS:
        return ORTHOGONAL if drawing.turned else POLAR
    forms = {plain(step.choice.best.form) for step in drawing.drawn.steps if step.choice}
    way = next((way for way in RINGS if any(way in words for words in drawing.ways)), None) or next(
        (way for form, way in LOCUS_FORMS.items() if form in forms), AUXILIARY)
    return f"{way}, {WAYS[ORTHOGONAL if drawing.turned else POLAR].plan}"


BOTH_FORCES = f"{POLYGONS}, {LEVER}"
LOCUS_FORMS = dict(zip(TRIAL_LAWS, (TRIAL, TWO_TRIALS, TWO_TRIALS), strict=True))  # the ways, by the form of the locus


def _error_on(drawing: Construction, pencil: Pencil, sheet: str) -> tuple[float | None, str]:
    """The error of the worst result on a sheet, or the reason why it fails."""
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


LETTERS = {AUXILIARY: "Q", TRIAL: "T", TWO_TRIALS: "TT", POLES: "P", FALSE: "F"}
HUES = {AUXILIARY: ("#8fc7e8", "#d8ecf8"), TRIAL: ("#f2b84b", "#fbe6bf"), TWO_TRIALS: ("#f0a58a", "#fae0d6"),
        POLES: ("#86cdb4", "#d9f0e8"), FALSE: ("#d9a9c6", "#f1dfea")}  # on orthogonal plans, and paler on polar ones
SIGNS = {"orthogonal": "⊥", "polar": "p"}
TINTS = {f"{way}, {plan}": (LETTERS[way] + SIGNS[plan], hue)
         for way, hues in HUES.items() for plan, hue in zip(SIGNS, hues, strict=True)} | {
    ORTHOGONAL: ("⊥", "#c9c9c9"), POLAR: ("p", "#e9e9e9"),
    POLYGONS: ("G", "#d6d59b"), LEVER: ("L", "#b5deda"), BOTH_FORCES: ("GL", "#efefd2"),
}  # what each form is marked with
OWN_SHEET = "A1"  # on which the pose's own form is shown
OWN_FORMS = SHEET, f"{SHEET}, {WAYS[ORTHOGONAL].plan}"
OWN_ROW = f"own, {OWN_SHEET}"
ROWS = (OWN_ROW, *SHEETS)
BAR = 0.42  # of the distance of two rows: half as high is a bar
REMARKS = (
    "On each sheet, whose plans are half as wide as it is: the quickest form whose worst result has a pencil error of "
    "at most {limit:.0%} of the largest of its kind, to first order with {pencil}, and its number of drawing "
    "operations. White: where none is as accurate as that, the most accurate one, with its error; empty: none can be "
    f"drawn. Below ({OWN_ROW}): the form that the pose chooses itself, with its error."
)


@diagrams.in_style
def picture(rows: Sequence[FormAt], pencil: str) -> diagrams.Figure:
    """Return the chart of the forms to choose."""
    described = {degeneracy.name: degeneracy for degeneracy in DEGENERACIES}
    sweeps = group_rows(rows, "degeneracy")
    headings = [diagrams.Heading(name, described[name].words) for name in sweeps]
    figure, panels = diagrams.page("Which method when", REMARKS.format(limit=MAX_ERROR, pencil=pencil), headings,
                                   (200.0, 40.0), 2, diagrams.Margins(left=24.0, foot=14.0))
    for axes, of in zip(panels, sweeps.values(), strict=True):
        _draw_panel(axes, of)
    swatches = {**{f"{letter}  {way}": HUES[way][0] for way, letter in LETTERS.items()},
                f"G  {POLYGONS}; L  {LEVER}": TINTS[POLYGONS][1],
                "⊥  orthogonal plans; p  polar plans": TINTS[POLAR][1]}
    diagrams.foot_legend(figure, [diagrams.swatch(label, colour) for label, colour in swatches.items()], 4)
    return figure


def _draw_panel(axes: diagrams.Axes, rows: Sequence[FormAt]) -> None:
    """Draw one way to a special pose: on each sheet what to choose from where to where, and the pose's own form."""
    distances = [*dict.fromkeys(row.distance for row in rows)]
    diagrams.logarithmic(axes.xaxis, min(distances), max(distances))
    axes.set(xlim=(max(distances), min(distances)), ylim=(-0.6, len(ROWS) - 0.4), xlabel="distance d from the pose")
    axes.set_yticks(range(len(ROWS)), labels=ROWS)
    axes.grid(visible=False, axis="y")
    for sheet, of in group_rows(rows, "sheet").items():
        _draw_row(axes, sheet, [best_form(at) for at in group_rows(of, "distance").values()], distances)
    own = [row if row.error is not None else None for row in rows if row.sheet == OWN_SHEET and row.form in OWN_FORMS]
    _draw_row(axes, OWN_ROW, own, distances)


def _draw_row(axes: diagrams.Axes, name: str, chosen: Sequence[FormAt | None], distances: Sequence[float]) -> None:
    """Draw stretches of the distance in which one form is to be chosen, with what it takes or how it errs."""
    ends = [distances[0], *(sqrt(here * beyond) for here, beyond in pairwise(distances)), distances[-1]]
    level = ROWS.index(name)
    for (drawn, accurate), of in groupby(range(len(chosen)), key=lambda k: _kind(chosen[k])):
        places = [*of]
        forms = [form for k in places if (form := chosen[k])]
        if forms:
            letters, hue = TINTS[drawn]
            measure = ([100 * (form.error or 0.0) for form in forms], " %") if not accurate or name == OWN_ROW else (
                [form.operations or 0.0 for form in forms], "")
            diagrams.stretch(axes, (ends[places[0]], ends[places[-1] + 1]), (level - BAR, level + BAR),
                    f"{letters}  {_range(*measure)}|{letters}", facecolor=hue if accurate else "white",
                    edgecolor=diagrams.GREY, linewidth=0.18 * diagrams.MM, gid=f"{name}: {drawn}")


def _kind(chosen: FormAt | None) -> tuple[str, bool]:
    """Return the form that is chosen, and whether it is accurate enough."""
    return ("", False) if chosen is None else (chosen.drawn, (chosen.error or 0.0) <= MAX_ERROR)


def _range(numbers: Sequence[float], unit: str) -> str:
    """Return the least and the greatest of some numbers, in words."""
    low, high = (f"{number:.0f}" for number in (min(numbers), max(numbers)))
    return f"{low}{unit}" if low == high else f"{low} to {high}{unit}"
