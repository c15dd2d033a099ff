"""The method of loci: a ternary link on three bars, whose lengths leave it two places."""

from __future__ import annotations

import math

import pytest

from graphplan.kernel import Board
from graphplan.kernel.closures import Attitude, Closure, Hinge, PlacedPin
from graphplan.kernel.expand import Expander
from graphplan.kernel.numbers import Floats
from graphplan.kernel.passes import freeze
from graphplan.kernel.program import evaluate

A, B, C = (100.0, 20.0), (150.0, 150.0), (220.0, 40.0)
E, F, G = (0.0, 0.0), (40.0, 0.0), (15.0, 35.0)  # of the ternary link's figure
AE, BG, CF = 44.7214, 58.9981, 70.9483
PLACES = [((120.0, 60.0), (157.575, 73.716)), ((111.633, 63.182), (150.129, 52.318))]  # E and F


def group(E1: tuple[float, float], F1: tuple[float, float]) -> Closure:
    """The group as it lies there, from a drawing: to a tenth of a millimetre."""
    turn = complex(F1[0] - E1[0], F1[1] - E1[1]) / 40
    G1 = complex(*E1) + turn * complex(*G)
    ends = [(A, E1, AE), (B, (G1.real, G1.imag), BG), (C, F1, CF)]
    ways = [complex(end[0] - pin[0], end[1] - pin[1]) for pin, end, _ in ends]
    bars = [Attitude(*pin, way.real / abs(way), way.imag / abs(way))
            for (pin, _, _), way in zip(ends, ways, strict=True)]
    pairs = [PlacedPin(k, (0.0, 0.0), k) for k in range(3)]
    hinges = [Hinge(k, (long, 0.0), 3, place) for k, (long, place) in enumerate([(AE, E), (BG, G), (CF, F)])]
    return Closure("2 to 5", [*pairs, *hinges], [*bars, Attitude(*E1, turn.real, turn.imag)], {"E": (0, (AE, 0.0))})


@pytest.mark.parametrize("place", PLACES, ids=["first", "second"])
def test_the_curve_of_the_freed_link_meets_the_circle_in_either_place(place: tuple[tuple[float, float], ...]) -> None:
    """From about where it is the joint comes out to the digits of the lengths, and four plans draw it."""
    board = Board()
    outer = [board.given(x=x, y=y, name=name) for name, (x, y) in zip("ABC", (A, B, C), strict=True)]
    near = [(x + 0.1, y - 0.1) for x, y in place]
    program = freeze(board, [board.close_on_three(*outer, group=group(near[0], near[1]), joint="E", name="E")])
    values = evaluate(program, Floats())
    assert math.dist(values[-1], place[0]) < 2e-3
    expander = Expander(program, values)
    drawn = expander.run()
    assert drawn.steps[drawn.wanted[0]].op is not program.steps[-1].op
    assert math.dist(expander.values[drawn.wanted[0]], values[-1]) < 1e-9
