"""What a hand adds to a drawing, on figures whose errors can be told without a computer."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import pytest

from graphplan.design.hand import Hand, Pencil, Slips, program_hand
from graphplan.kernel import Board, Mark
from graphplan.kernel.numbers import Floats
from graphplan.kernel.numbers.gradients import Gradients
from graphplan.kernel.passes import freeze
from graphplan.kernel.program import evaluate

Points = Sequence[Mark]
Draw = Callable[[Board, Points], Mark]
PLACES = (0, 0), (10, 0), (20, 0), (10, -1), (10, 1)

# The line y = 0 drawn in some way, its slips, and how far off it then is at x = 20.
LINES: list[tuple[str, Draw, Slips, float]] = [
    ("at its first point", lambda b, p: b.line(p[0], p[1]), (3, 0), 3 * 1),
    ("at its second point", lambda b, p: b.line(p[0], p[1]), (0, 3), 3 * 2),
    ("at both", lambda b, p: b.line(p[0], p[1]), (3, 3), 3 * math.hypot(1, 2)),
    ("at both, running the other way", lambda b, p: b.line(p[1], p[0]), (3, 3), 3 * math.hypot(1, 2)),
    ("by set squares, moved", lambda b, p: b.parallel(b.line(p[3], b.given(x=20, y=-1)), p[0]), (3, 0), 3),
    ("by set squares, turned", lambda b, p: b.parallel(b.line(p[3], b.given(x=20, y=-1)), p[0]), (0, 0.01), 20 * 0.01),
    ("perpendicular to another", lambda b, p: b.perpendicular(b.line(p[3], p[4]), p[0]), (0, 0.01), 20 * 0.01),
    ("in a given direction", lambda b, p: b.guide(p[0], dx=3, dy=0), (0, 0.01), 20 * 0.01),
    ("halving two points, turned there", lambda b, p: b.bisector(p[3], p[4]), (0, 0.01), 10 * 0.01),
]


def errors(mark: Mark, slipping: Mark, slips: Slips) -> tuple[tuple[float, ...], ...]:
    """The derivatives of a mark's numbers by the slips of one step, all others being drawn without any."""
    program = freeze(mark.board, [mark, slipping])
    last, place = program.wanted
    hand = Hand(program, evaluate(program, Floats()), [slips if i == place else () for i in range(len(program))])
    domain = Gradients(len(slips))

    def of(step: int) -> list[object]:
        return [domain.error(i, size) for i, size in enumerate(slips)] if step == place else [0.0, 0.0]

    return tuple(tuple(domain.partials(number)) for number in hand.draw(domain, of, of)[last])


def board() -> tuple[Board, Points]:
    """A board with some points of the pose."""
    made = Board()
    return made, [made.given(x=x, y=y) for x, y in PLACES]


def test_a_computed_normal_acceleration_is_off_along_it_by_what_its_lengths_are_misread_by() -> None:
    """v²/r from v = 5 and r = 10, each misread by 0.1: 2 v/r times as far off by the one, (v/r)² by the other."""
    made = Board()
    K, A, m, w, k = (made.given(x=x, y=y) for x, y in ((0, 0), (6, 8), (1, 1), (1, 6), (3, 3)))
    mark = made.computed_normal(K, A, m, w, k)
    program = freeze(made, [mark])
    drawn = program_hand(program, evaluate(program, Floats()), lambda step: 1.0, Pencil(point=0.2, opening=0.1))
    assert drawn.slips[-1] == pytest.approx((0.2, 0.2, 0.1 * math.hypot(1.0, 0.25)))
    along, across = errors(mark, mark, (0.0, 0.0, 1.0))
    assert (along[2], across[2]) == pytest.approx((0.6, 0.8))


@pytest.mark.parametrize(("draw", "slips", "off"), [case[1:] for case in LINES], ids=[case[0] for case in LINES])
def test_a_line_is_off_by_the_lever(draw: Draw, slips: Slips, off: float) -> None:
    """A line that slips where it is laid is off further along by the law of the lever, whichever way it runs."""
    made, points = board()
    line = draw(made, points)
    crossing = made.meet(line, made.guide(points[2], dx=0, dy=1))
    assert math.hypot(*errors(crossing, line, slips)[1]) == pytest.approx(off)


def test_an_arc_is_off_by_its_opening() -> None:
    """An opening that slips moves what an arc marks by as much."""
    made, points = board()
    opening = made.opening(points[0], points[1])
    axis = made.line(points[0], points[2])
    crossing = made.line_meets_circle(axis, made.circle(points[0], opening), way="on")
    assert errors(crossing, opening, (3,))[0] == pytest.approx((3,))


def test_a_trial_point_is_free_along_its_line() -> None:
    """A point picked on a line is off it across, and nothing is wrong with where along it lies."""
    made, points = board()
    trial = made.pick(made.line(points[0], points[1]), *[points[0]] * 3, points[2], ratio=1)
    along, across = errors(trial, trial, (3,))
    assert (along, across) == ((0.0,), (3.0,))


def test_coincident_points_are_one_hole() -> None:
    """Points of the pose that coincide are off together: the vector between them stays nothing."""
    made, points = board()
    twin = made.given(x=10, y=0)
    vector = made.transfer(points[1], twin, points[0])
    assert errors(vector, points[1], (3, 3)) == ((0.0, 0.0), (0.0, 0.0))
