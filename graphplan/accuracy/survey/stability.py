"""Stability: how large errors grow near the places where methods fail, beside what the mechanism itself must cost."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Any

from graphplan.accuracy.survey.degeneracies import DEGENERACIES, Degeneracy
from graphplan.accuracy.survey.picture import Axis, Chart, Look, Place, Series, Spot, SubChart, grouped
from graphplan.errors import GraphplanError
from graphplan.kernel.numbers.floats import Floats
from graphplan.mechanism.model import Scene
from graphplan.methods.construct import construct
from graphplan.sheet.plates.pens import BLUE, BROWN, GREEN, GREY, INK, RED, VIOLET
from graphplan.solver import solve

EPSILON = 2.0**-52
DISTANCES = (*(10.0 ** (-k / 2) for k in range(33)), 0.0)  # 1, 0.3, 0.1, ... 1e-16, and the special pose itself

# Methods by name, as arguments of `construct`.
METHODS: dict[str, dict[str, Any]] = {
    "chosen by the pose": {},
    "auxiliary points": {"method": "auxiliary"},
    "trial figures": {"method": "trial"},
    "poles": {"method": "poles"},
    "orthogonal": {"plan": "orthogonal"},
    "polar plans": {"plan": "polar"},
}


@dataclass(frozen=True)
class Sample:
    """One method at one distance: the largest error of any result beside the largest of its kind, or why there is none.

    `condition` is that of the mechanism in the pose, infinite where it is singular.
    """

    degeneracy: str
    method: str
    distance: float
    condition: float
    error: float | None
    why: str = ""

    @property
    def roundings(self) -> float | None:
        """The error in roundings (2^-52) of the mechanism's own condition."""
        return None if self.error is None else self.error / (EPSILON * self.condition)


def samples(*degeneracies: Degeneracy, distances: tuple[float, ...] = DISTANCES) -> Iterator[Sample]:
    """Every method at every distance from special poses."""
    for degeneracy, d in product(degeneracies, distances):
        scene = degeneracy.at(d)
        truth = exact(scene)
        for name, choices in METHODS.items():
            yield Sample(degeneracy.name, name, d, *_measured(scene, truth, choices))


def _measured(scene: Scene, truth: Any, choices: dict[str, Any]) -> tuple[float, float | None, str]:
    """The condition of the mechanism, the error of a method, and why there is no number."""
    if truth is None:
        return float("inf"), None, "the pose is singular"
    try:
        condition = solve(scene).condition
    except GraphplanError as error:
        return float("inf"), None, error.lines[0]
    try:
        return condition, error_of(construct(scene, **choices).read(Floats()), truth), ""
    except GraphplanError as error:
        return condition, None, error.lines[0]


def exact(scene: Scene) -> Any:
    """The solver's rates in fractions; None in a singular pose."""
    try:
        return solve(scene, exact=True)
    except GraphplanError:
        return None


def error_of(results: dict[str, dict[str, Any]], truth: Any) -> float:
    """The largest error of any velocity or acceleration, beside the largest of its kind."""
    worst = 0.0
    for kind in ("velocity", "acceleration"):
        known, named = getattr(truth, kind), results.get(kind, {})
        largest = max((abs(number) for vector in known.values() for number in vector), default=0)
        gap = max((abs(Fraction(ours) - true) for name, value in named.items()
                   for ours, true in zip(value, known[name], strict=True)), default=0)
        worst = max(worst, float(gap / largest) if largest else 0.0)
    return worst


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
    about = {way.name: way.what for way in DEGENERACIES}
    panels = tuple(_panel(f"{name} – {about[name]}", of) for name, of in grouped(rows, "degeneracy").items())
    return Chart("Stability: error near the places where methods fail", REMARKS, panels, 3, (116.0, 70.0),
                 tuple(_key()))


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
