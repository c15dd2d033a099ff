"""Values from the books, with the precision of their drawings, and exact ones from recomputation."""

from __future__ import annotations

import math
from dataclasses import dataclass

import pytest
from each import each

from graphplan.check.report import Report
from graphplan.check.trusted import report
from graphplan.mechanism.scene import load


@dataclass(frozen=True)
class Printed:
    """One value in m and s, how far off its source may be (relative), and where it stands."""

    scene: str
    kind: str
    of: str
    value: float
    tolerance: float
    note: str = ""


OF_LINKS = {"relative velocity": "omega", "tangential acceleration": "alpha"}  # of two points of a link: "LINK P R"
OZOLS = "Ozols 1974, 5-5"
VALUES = [
    # read off the book's drawing at 1:10
    Printed("ozols-5-1", "velocity", "B", 1.46, 0.026, f"{OZOLS}, ex. 5-1: drawn 20.5 mm, exactly 20.96"),
    Printed("ozols-5-1", "velocity", "C", 1.68, 0.016, f"{OZOLS}, ex. 5-1"),
    Printed("ozols-5-1", "omega", "2", 3.34, 0.002, f"{OZOLS}, ex. 5-1: clockwise"),
    Printed("ozols-5-1", "acceleration", "B", 30.1, 0.018, f"{OZOLS}, ex. 5-1"),
    Printed("ozols-5-1", "acceleration", "C", 27.0, 0.011, f"{OZOLS}, ex. 5-1"),
    Printed("ozols-5-1", "alpha", "2", 9.1, 0.001, f"{OZOLS}, ex. 5-1: opposite to omega"),
    Printed("ozols-5-1", "relative velocity", "2 A B", 2.43, 0.003, f"{OZOLS}, ex. 5-1: over AB 3.33, printed 3.34"),
    Printed("ozols-5-1", "tangential acceleration", "2 A B", 6.64, 0.001, f"{OZOLS}, ex. 5-1"),
    # recomputed
    Printed("ozols-5-1", "velocity", "B", 1.4973, 1e-4),
    Printed("ozols-5-1", "velocity", "C", 1.7051, 1e-4),
    Printed("ozols-5-1", "acceleration", "B", 29.578, 1e-4),
    Printed("ozols-5-1", "acceleration", "C", 26.720, 1e-4),
    Printed("ozols-5-1", "alpha", "2", 9.1000, 1e-4),
    Printed("ozols-5-2", "omega", "3", 18.040125, 1e-6),
    Printed("ozols-5-2", "alpha", "3", -68.914925, 1e-6),
    Printed("ozols-5-2", "velocity", "A", 2.525618, 1e-6),
    Printed("ozols-5-2", "acceleration", "A", 46.572773, 1e-6),
    Printed("ozols-5-2", "velocity", "F", 3.190168, 1e-6),
    Printed("ozols-5-2", "acceleration", "F", 52.898411, 1e-6),
    Printed("ozols-5-2", "slide velocity", "2 along 1", 1.962411, 1e-6),
    Printed("ozols-5-2", "slide acceleration", "2 along 1", 10.969283, 1e-6),
    Printed("ozols-5-3", "omega", "1", -2.547887, 1e-6),
    Printed("ozols-5-3", "omega", "3", -4.596420, 1e-6),
    Printed("ozols-5-3", "alpha", "1", -3.628679, 1e-6),
    Printed("ozols-5-3", "alpha", "3", -11.019952, 1e-6),
    Printed("ozols-5-4", "omega", "2", -1.860753, 1e-6),
    Printed("ozols-5-4", "omega", "3", 2.462812, 1e-6),
    Printed("ozols-5-4", "omega", "5", -1.936112, 1e-6),
    Printed("ozols-5-4", "alpha", "5", -71.653687, 1e-6),
    Printed("ozols-5-4", "slide velocity", "4 along 5", 0.104802, 5e-6),
    Printed("ozols-5-5", "omega", "1", -8.138972, 1e-6),
    Printed("ozols-5-5", "omega", "2", 3.861028, 1e-6),
    Printed("ozols-5-5", "omega", "3", -7.988959, 1e-6),
    Printed("ozols-5-5", "alpha", "1", -15.214981, 1e-6),
    Printed("ozols-5-5", "alpha", "3", 3.746078, 1e-6),
]


def measured(found: Report, value: Printed) -> float:
    """What the construction gives: a vector's size in metres, or a link's rate; signs only where the value has one."""
    if value.kind in OF_LINKS:
        link, one, other = value.of.split()
        (x, y), (u, v) = (found.scene.points[name] for name in (one, other))
        return math.hypot(x - u, y - v) * abs(found.results[OF_LINKS[value.kind]][link]) / 1000
    number = found.results[value.kind][value.of]
    if isinstance(number, tuple):
        return float(abs(complex(*number))) / 1000
    return float(number) if value.value < 0 or value.tolerance < 1e-4 else abs(float(number))


@each("value", VALUES, ids=lambda v: f"{v.scene} {v.kind} {v.of} {v.value}")
def test_the_construction_gives_the_books_value(value: Printed) -> None:
    """Each printed value within the precision of its drawing, each recomputed one to its digits."""
    found = report(load(value.scene))
    assert measured(found, value) == pytest.approx(value.value, rel=value.tolerance)


def test_the_connecting_rod_turns_clockwise_and_ever_slower() -> None:
    """Ozols 5-1: the coupler turns clockwise with decreasing speed, the piston is accelerated to the left."""
    results = report(load("ozols-5-1")).results
    assert results["omega"]["2"] < 0 < results["alpha"]["2"]
    assert results["acceleration"]["B"][0] < 0
