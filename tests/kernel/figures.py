"""Random figures: programs that end with one use of a primitive, for any primitive of the table.

Operands are made by kind. Where a primitive asks more of them (C on AB, an image like its link), they are drawn so.
Coordinates are quarters, so that every number domain has them exactly.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from random import Random
from typing import Any

from graphplan.errors import GraphplanError
from graphplan.kernel import CIRCLE, LINE, OPENING, POINT, TABLE, Board, Mark, Primitive, Program
from graphplan.kernel.elementary import dot
from graphplan.kernel.images import Attitude, Closure, Curve, Hinge, PlacedPin, cubic_direction, cubic_point
from graphplan.kernel.numbers import Domain, Floats
from graphplan.kernel.passes import freeze
from graphplan.kernel.positions import Angle
from graphplan.kernel.program import Panel, evaluate

Place = Callable[[Random], tuple[Any, Any]]
Points = list[Mark]
Draw = Callable[[Board, Points, Random, dict[str, Any]], tuple[Mark, ...]]

NAMES = sorted(TABLE)
LENGTHS = {POINT: 2, LINE: 3, OPENING: 1, CIRCLE: 3}
COMPOUNDS = [name for name in NAMES if TABLE[name].compound]


def quarters(r: Random) -> tuple[Fraction, Fraction]:
    """A point like any other."""
    return Fraction(r.randint(-50, 50), 4), Fraction(r.randint(-50, 50), 4)


def corners(r: Random) -> tuple[Fraction, Fraction]:
    """One of few points: many coincide, lie on one line, or are equally far apart."""
    return Fraction(r.randint(0, 2)), Fraction(r.randint(0, 2))


def extremes(r: Random) -> tuple[float, float]:
    """Lengths 1e-9 and 1e9 apart."""
    sizes = (0.0, 1.0, 1.0, 2.0, 1e-9, 1e9)
    return r.choice(sizes) * r.choice((-1, 1)), r.choice(sizes) * r.choice((-1, 1))


PARAMS: dict[str, Callable[[Random], Any]] = {
    **dict.fromkeys(("x", "y", "dx", "dy", "ux", "uy", "length", "moment"), lambda r: Fraction(r.randint(-8, 8), 4)),
    **dict.fromkeys(("radius", "coefficient"), lambda r: Fraction(r.randint(1, 8), 8)),
    "ratio": lambda r: Fraction(r.choice((-3, -2, -1, 1, 2, 3, 5)), 2),
    "angle": lambda r: Angle("30", Fraction(r.randint(-8, 8), 4), Fraction(r.randint(-8, 8), 4)),
    **dict.fromkeys(("group", "joint", "curve"), lambda r: "J"),
    "plan": lambda r: Panel("N-plan"),
    "number": lambda r: r.randint(1, 3),
    "way": lambda r: r.choice(("on", "back")),
    "side": lambda r: r.choice(("left", "right")),
    "turn": lambda r: r.choice(("parallel", "perpendicular")),
}


def _image(b: Board, C: Mark, A: Mark, c: Mark, ratio: Fraction, turn: str) -> Mark:
    return (b.step_off if turn == "parallel" else b.step_across)(C, A, c, ratio=ratio)


def _divide(b: Board, p: Points, r: Random, params: dict[str, Any]) -> tuple[Mark, ...]:
    return p[0], p[1], b.step_off(p[0], p[1], p[0], ratio=Fraction(r.randint(-4, 8), 4)), p[2], p[3]


def _similar(b: Board, p: Points, r: Random, params: dict[str, Any]) -> tuple[Mark, ...]:
    return *p[:4], _image(b, p[0], p[1], p[3], PARAMS["ratio"](r), params["turn"])


def _carry(b: Board, p: Points, r: Random, params: dict[str, Any]) -> tuple[Mark, ...]:
    """Any loci, or such as are drawn from an auxiliary point that is known."""
    if r.randrange(4):
        return p[0], b.line(p[1], p[2]), p[3], b.line(p[4], p[5]), p[6]
    y, z = b.line(p[0], p[1]), b.line(p[3], p[4])
    q = b.transfer(p[2], p[5], b.meet(y, z))
    return p[0], getattr(b, params["turn"])(y, q), p[3], getattr(b, params["turn"])(z, q), p[6]


def _settle(b: Board, p: Points, r: Random, params: dict[str, Any]) -> tuple[Mark, ...]:
    ratio = PARAMS["ratio"](r)
    one, two = (_image(b, p[0], X, p[1], ratio, params["turn"]) for X in p[2:4])
    return p[0], p[1], p[2], b.line(one, p[4]), p[3], b.line(two, p[5])


def _coriolis(b: Board, p: Points, r: Random, params: dict[str, Any]) -> tuple[Mark, ...]:
    return p[0], p[1], b.step_off(p[1], p[0], p[1], ratio=Fraction(r.randint(-4, 4), 2)), p[2], p[3]


def _false_position(b: Board, p: Points, r: Random, params: dict[str, Any]) -> tuple[Mark, ...]:
    locus = b.line(p[4], p[5])
    return p[0], p[1], p[2], locus, p[3], b.parallel(locus, p[6])


def _corner(b: Board, p: Points, r: Random, params: dict[str, Any]) -> tuple[Mark, ...]:
    c, s = Fraction(r.choice((-4, -3, 3, 4)), 5), Fraction(4, 5)
    s = s if abs(c) == Fraction(3, 5) else Fraction(3, 5)
    return p[0], b.lay_off(p[0], dx=c * params["ux"] - s * params["uy"], dy=s * params["ux"] + c * params["uy"])


def _conjugate(b: Board, p: Points, r: Random, params: dict[str, Any]) -> tuple[Mark, ...]:
    centres = [b.step_off(X, p[0], X, ratio=Fraction(r.choice((-5, -3, -2, 2, 3, 5, 6)), 4)) for X in p[1:3]]
    return p[0], p[1], centres[0], p[2], centres[1], p[3]


def _closing(b: Board, p: Points, r: Random, params: dict[str, Any]) -> tuple[Mark, ...]:
    """Two bars, from the first joint and from the last, that meet in a joint of theirs."""
    (x, y), *_, (u, v) = ([float(b.steps[mark.step.index].params[key]) for key in "xy"] for mark in p)
    J = [float(part) for part in quarters(r)]
    start = Attitude(x, y, 1.0, 0.0), Attitude(u, v, 1.0, 0.0)
    one, two = (J[0] - x, J[1] - y), (J[0] - u, J[1] - v)
    pairs = PlacedPin(0, (0.0, 0.0), 0), PlacedPin(1, (0.0, 0.0), len(p) - 1), Hinge(0, one, 1, two)
    params["group"], params["joint"] = Closure("2 and 3", pairs, start, {"J": (0, one)}), "J"
    return tuple(p)


def _at(b: Board, mark: Mark) -> tuple[float, float]:
    """Where a given point is."""
    x, y = (float(b.steps[mark.step.index].params[key]) for key in "xy")
    return x, y


def _curve_and_arc(b: Board, p: Points, r: Random, params: dict[str, Any]) -> tuple[Mark, ...]:
    """A curve and an arc that cross in a place which is a little off the cubic."""
    places, (x, y) = [_at(b, mark) for mark in p[:4]], _at(b, p[4])
    u, off = r.uniform(-0.5, 1.5), (0.125, -0.25)
    X = tuple(one + two for one, two in zip(cubic_point(Floats(), places, u), off, strict=True))
    slope = 2 * dot((X[0] - x, X[1] - y), cubic_direction(places, u))
    params["curve"] = Curve("a curve", [u], [off], [[1 / (slope or 1.0)]])
    return *p[:4], b.circle(p[4], b.opening(p[4], b.given(x=X[0], y=X[1], name="X")))


def _two_curves(b: Board, p: Points, r: Random, params: dict[str, Any]) -> tuple[Mark, ...]:
    """Two curves that cross in a place which is a little off both cubics."""
    own = [[_at(b, mark) for mark in p[k : k + 4]] for k in (0, 4)]
    at, X = [r.uniform(-0.5, 1.5) for _ in own], _at(b, p[8])
    offs = [tuple(one - two for one, two in zip(X, cubic_point(Floats(), *pair), strict=True))
            for pair in zip(own, at, strict=True)]
    (a, c), (e, f) = (cubic_direction(*pair) for pair in zip(own, at, strict=True))
    whole = (c * e - a * f) or 1.0
    params["curve"] = Curve("a curve", at, offs, [[-f / whole, e / whole]])
    return tuple(p[:8])


FITTING: dict[str, tuple[int, Draw]] = {
    "divide": (4, _divide), "similar": (4, _similar), "carry": (7, _carry), "settle": (6, _settle),
    "coriolis": (4, _coriolis),
    "false_position": (7, _false_position), "corner": (1, _corner), "conjugate": (4, _conjugate),
    "curve_meets_circle": (5, _curve_and_arc), "curves_meet": (9, _two_curves),
    "close_on_two": (2, _closing), "close_on_three": (3, _closing), "close_on_four": (4, _closing),
}

NEEDED = {POINT: 1, LINE: 2, OPENING: 2, CIRCLE: 3}
MADE: dict[str, Callable[[Board, Points], Mark]] = {
    POINT: lambda b, p: p[0],
    LINE: lambda b, p: b.line(*p),
    OPENING: lambda b, p: b.opening(*p),
    CIRCLE: lambda b, p: b.circle(p[0], b.opening(*p[1:])),
}


def _by_kind(op: Primitive) -> tuple[int, Draw]:
    """How many points operands of these kinds need, and how they are drawn on them."""

    def draw(b: Board, points: Points, r: Random, params: dict[str, Any]) -> tuple[Mark, ...]:
        left = iter(points)
        return tuple(MADE[kind](b, [next(left) for _ in range(NEEDED[kind])]) for kind in op.reads)

    return sum(NEEDED[kind] for kind in op.reads), draw


def figure(name: str, r: Random, place: Place = quarters) -> Program:
    """A program that ends with one use of the primitive, on points from `place`."""
    op, board = TABLE[name], Board()
    params = {param: PARAMS[param](r) for param in op.params}
    number, draw = FITTING.get(name) or _by_kind(op)
    points = []
    for k in range(number):
        x, y = place(r)
        points.append(board.given(x=x, y=y, name=f"P{k}"))
    return freeze(board, [board.draw(op, draw(board, points, r, params), name="out", **params)])


def drawn(program: Program, domain: Domain, **given: Any) -> list[Any] | None:
    """The values of a program, or nothing where it cannot be drawn."""
    try:
        return evaluate(program, domain, given or None)
    except GraphplanError:
        return None


def size(program: Program, values: list[Any]) -> float:
    """How far the points of a drawing reach."""
    points = [value for step, value in zip(program.steps, values, strict=True) if step.op.gives == POINT]
    return max((math.hypot(*map(float, point)) for point in points), default=1.0) or 1.0
