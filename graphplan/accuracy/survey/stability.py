"""Stability: how large errors grow near the places where methods fail, beside what the mechanism itself must cost."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from graphplan.accuracy.survey.degeneracies import DEGENERACIES, Degeneracy
from graphplan.errors import GraphplanError
from graphplan.kernel.numbers.floats import Floats
from graphplan.mechanism.model import Scene
from graphplan.methods.construct import construct
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


def samples(degeneracy: Degeneracy, distances: tuple[float, ...] = DISTANCES) -> Iterator[Sample]:
    """Every method at every distance from a special pose."""
    for d in distances:
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
        largest = max((abs(number) for name in named for number in known[name]), default=0)
        gap = max((abs(Fraction(ours) - true) for name, value in named.items()
                   for ours, true in zip(value, known[name], strict=True)), default=0)
        worst = max(worst, float(gap / largest) if largest else 0.0)
    return worst


def everything() -> Iterator[Sample]:
    """All degeneracies, methods and distances."""
    for degeneracy in DEGENERACIES:
        yield from samples(degeneracy)
