"""Accuracy where methods fail: the basic case with its bars turned parallel, and the auxiliary point anywhere."""

from __future__ import annotations

import math
from fractions import Fraction
from random import Random

import pytest

from graphplan.check.report import report
from graphplan.mechanism.model import Find, Motion, Scene, Units

LINKS = {"KA": "K A", "BL": "B L", "3": "A B C", "4": "C D E", "MD": "M D", "EN": "E N"}
POINTS = {"K": (0, 0), "A": (40, 130), "L": (150, -20), "B": (150, 90), "C": (260, 180), "D": (340, 110),
          "E": (420, 170), "M": (310, -10), "N": (470, 10)}
MOTIONS = {"K": ((1, 2), (-1, 3)), "L": ((-1, 1), (2, 2)), "M": ((2, -1), (1, 1)), "N": ((0, 1), (-2, 1))}
ANGLES = [0.0, *(10.0**-k for k in range(1, 17))]


def basic_case(**moved: tuple[float, float]) -> Scene:
    """Rosenauer's basic case, some of its points moved; floats are taken as the fractions that they are."""
    points = {name: (Fraction(x), Fraction(y)) for name, (x, y) in (POINTS | moved).items()}
    links = {name: tuple(names.split()) for name, names in LINKS.items()}
    motions = {name: Motion(*((Fraction(x), Fraction(y)) for x, y in given)) for name, given in MOTIONS.items()}
    find = Find(tuple("ABCDE"), tuple("ABCDE"))
    return Scene("basic", "", "basic", Units(), points, {}, links, (), (), motions, find)


def turned(d: float) -> Scene:
    """KA turned towards LB until they differ by the angle d."""
    x, y = POINTS["A"]
    return basic_case(K=(x + 136 * math.sin(d), y - 136 * math.cos(d)))


def error(scene: Scene, **choices: str) -> float:
    """The largest error of any result, in units of 2.2e-16 times the condition of the mechanism."""
    drawn, truth = report(scene, **choices), report(scene, exact=True)
    worst = 0.0
    for kind in ("velocity", "acceleration"):
        largest = max(abs(float(number)) for pair in truth.results[kind].values() for number in pair)
        for name, pair in truth.results[kind].items():
            gap = max(abs(float(p - Fraction(q))) for p, q in zip(pair, drawn.results[kind][name], strict=True))
            worst = max(worst, gap / largest)
    return worst / (2.0**-52 * drawn.rates.condition)


@pytest.mark.parametrize("d", ANGLES)
def test_parallel_bars_cost_no_accuracy(d: float) -> None:
    """With KA turned towards LB down to nothing every result is as good as the mechanism allows."""
    assert error(turned(d)) <= 100


@pytest.mark.parametrize("d", ANGLES)
def test_the_form_named_does_not_change_the_numbers(d: float) -> None:
    """Auxiliary points asked for by name change the drawing, not the accuracy of the numbers."""
    assert error(turned(d), method="auxiliary") <= 100


@pytest.mark.parametrize("seed", range(60))
def test_the_auxiliary_point_may_lie_anywhere(seed: int) -> None:
    """Wherever Q lies, the results are as good as the mechanism allows."""
    random = Random(seed)
    reach = 10.0 ** random.uniform(-2, 6)
    angle = random.uniform(0, 2 * math.pi)
    (ax, ay), (bx, by) = POINTS["A"], POINTS["B"]
    qx, qy = 95 + reach * math.cos(angle), 110 + reach * math.sin(angle)
    share = 100 / max(math.dist((ax, ay), (qx, qy)), math.dist((bx, by), (qx, qy)), 200)
    K = ax + share * (qx - ax), ay + share * (qy - ay)
    L = bx + share * (qx - bx), by + share * (qy - by)
    assert error(basic_case(K=K, L=L)) <= 100


def test_the_sheet_leaves_the_auxiliary_point_where_it_leaves_the_sheet() -> None:
    """With parallel bars the trial figure is drawn, and the protocol says why."""
    assert "trial figure" in report(turned(0.0)).drawing.method["velocity"][0]
    assert any("off the sheet" in form for form in report(turned(1e-3)).drawing.forms)
