"""Stability as a picture: error against the distance from a special pose, a small picture a way to it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from graphplan.accuracy.survey.degeneracies import DEGENERACIES
from graphplan.accuracy.survey.picture import Axis, Chart, Look, Place, Series, Spot, SubChart, grouped
from graphplan.accuracy.survey.stability import EPSILON, METHODS, Sample
from graphplan.sheet.plates.pens import BLUE, BROWN, GREEN, GREY, INK, RED, VIOLET

MOST = 100  # roundings of the mechanism's own condition that the default may lose
_STROKES = (
    (INK, "circle", (), False), (BLUE, "square", (1.6, 0.8), False), (RED, "up", (0.4, 0.7), False),
    (GREEN, "diamond", (2.4, 0.6, 0.4, 0.6), False), (BROWN, "down", (3.0, 1.0), True),
    (VIOLET, "plus", (0.8, 0.6), True),
)
LOOKS = {name: Look(colour, marker, hollow, 1.1, 0.2, dash)
         for name, (colour, marker, dash, hollow) in zip(METHODS, _STROKES, strict=True)}
CONDITION, LIMIT = Look("#a8a8a8", width=0.7), Look(GREY, width=0.25, dash=(2.0, 1.0))
END = "0"
RAILS = tuple((name, "no number" if k == len(METHODS) // 2 else "") for k, name in enumerate(METHODS))
DISTANCE = Axis("distance d from the special pose", falling=True, after=((END, END),))
ERROR = Axis("largest error, relative", before=(("exact", "exact"),), after=RAILS)
REMARKS = (
    "Each picture goes one way to a special pose, to the right; at its end the pose is special. Grey is what the "
    "mechanism itself must cost, its condition in units of 2.2e-16, dashed 100 times that. Marks above the "
    "pictures: there is no number, since the pose is singular or the form is refused; one line a method. Marks "
    "below: no error."
)


def picture(rows: Sequence[Sample]) -> Chart:
    """The chart of these samples."""
    about = {degeneracy.name: degeneracy.what for degeneracy in DEGENERACIES}
    panels = tuple(_panel(f"{name} – {about[name]}", of) for name, of in grouped(rows, "degeneracy").items())
    return Chart("Stability: error near the places where methods fail", REMARKS, panels,
                 3, (116.0, 70.0), tuple(_key()))


def _panel(title: str, rows: Sequence[Sample]) -> SubChart:
    """One way to a special pose: the mechanism's own cost, and a line for each method."""
    return SubChart(title, DISTANCE, ERROR, (*_costs(rows), *(
        Series(look, tuple(_spot(row) for row in rows if row.method == name)) for name, look in LOOKS.items())))


def _costs(rows: Sequence[Sample]) -> Iterator[Series]:
    """What the mechanism must cost, and the limit."""
    conditions = {row.distance: row.condition for row in rows if row.distance and row.condition < float("inf")}
    for look, factor in ((CONDITION, 1), (LIMIT, MOST)):
        yield Series(look, tuple((d, factor * EPSILON * condition) for d, condition in conditions.items()))


def _spot(row: Sample) -> Spot:
    level: Place = row.method if row.error is None else row.error or "exact"
    return row.distance or END, level


def _key() -> Iterable[tuple[str, Look]]:
    yield from LOOKS.items()
    yield "the mechanism's condition × 2.2e-16", CONDITION
    yield f"{MOST} times that", LIMIT
