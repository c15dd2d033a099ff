"""One rule serves every kind of number: floats, arrays of poses, fractions, enclosures, derivatives, a recorded tape.

A batch and a tape give exactly what floats give, fractions and derivatives the same to rounding, enclosures hold it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from decimal import Decimal, localcontext
from fractions import Fraction
from functools import cached_property
from random import Random
from typing import Any

import numpy as np
import pytest
from each import each
from figures import LENGTHS, NAMES, Place, corners, drawn, extremes, figure, quarters, size

from graphplan.errors import ConstructionError, Undrawable
from graphplan.kernel import TABLE, Program
from graphplan.kernel.numbers import Domain, Floats, Fractions
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.kernel.numbers.enclosures import Enclosure, Enclosures, precision
from graphplan.kernel.numbers.gradients import Gradients
from graphplan.kernel.program import evaluate
from graphplan.kernel.tape.record import Blocks, Symbols, function

PLACES = each("place", [quarters, corners, extremes])
READING = [name for name in NAMES if TABLE[name].reads]  # the others read no number that could change
ROOTS = {"line_meets_circle", "circles_meet", "set_off", "sight",
         "curve_meets_circle", "curves_meet", "close_on_two", "close_on_three", "close_on_four"}


# ---- floats fail with a code, and in batches where they fail alone ---------------------------------------------------


@PLACES
@each("name", NAMES)
def test_no_number_is_silently_none(name: str, place: Place) -> None:
    """Each figure is drawn in finite numbers or raises a code that the primitive declares."""
    r = Random(name)
    for _ in range(65):
        program = figure(name, r, place)
        try:
            values = evaluate(program, Floats())
        except ConstructionError as error:
            assert error.code in {code for step in program.steps for code in step.op.fails}
        else:
            assert all(math.isfinite(number) for value in values for number in value)


@each(("name", "code"), [(name, code) for name in NAMES for code in TABLE[name].fails])
def test_failure_code_is_reached(name: str, code: str) -> None:
    """Every failure that a primitive declares can happen, in floats and in fractions."""
    r = Random(name)
    for domain in (Floats(), Fractions()):
        assert any(failure(figure(name, r, corners), domain) == code for _ in range(2000))


def failure(program: Program, domain: Any) -> str:
    """The code with which the last step fails, if it does."""
    try:
        evaluate(program, domain)
    except ConstructionError as error:
        return error.code if error.step == program.number(len(program) - 1) else ""
    return ""


@PLACES
@each("name", NAMES)
def test_batch_equals_floats(name: str, place: Place) -> None:
    """A batch of n poses gives exactly the n floats, one or many; what cannot be drawn is nan, with a code."""
    r = Random(name)
    for n in (1, 40):
        program = figure(name, r, place)
        given = poses(program, r, place, n)
        arrays = Arrays()
        with np.errstate(all="ignore"):
            values = evaluate(program, arrays, stacked(given) if given[0] else None)[-1]
        batch = np.array([np.broadcast_to(number, n) for number in values]).T
        one_by_one = np.array([last(program, pose) for pose in given])
        assert np.array_equal(batch, one_by_one, equal_nan=True)
        noted = np.zeros(n, bool)
        for _, _, bad in arrays.faults:
            noted |= bad
        assert np.array_equal(noted, np.isnan(batch).all(axis=1))


def poses(program: Program, r: Random, place: Place, n: int) -> list[dict[str, dict[str, float]]]:
    """Other points for the same program."""
    points = [step.name for step in program.steps if step.op.name == "given"]
    return [{name: dict(zip("xy", map(float, place(r)), strict=True)) for name in points} for _ in range(n)]


def stacked(given: list[dict[str, dict[str, float]]]) -> dict[str, dict[str, Any]]:
    """Poses as arrays."""
    return {name: {axis: np.array([pose[name][axis] for pose in given]) for axis in "xy"} for name in given[0]}


def last(program: Program, given: dict[str, dict[str, float]]) -> tuple[float, ...]:
    """The value of the last step in floats, or nan where the pose cannot be drawn."""
    values = drawn(program, Floats(), **given)
    return (math.nan,) * LENGTHS[program.steps[-1].op.gives] if values is None else values[-1]


# ---- a tape is the rules, recorded once ------------------------------------------------------------------------------


class Recorded:
    """The tape of a program whose points are free; the numbers of its last mark are told."""

    def __init__(self, program: Program):
        domain = Symbols()
        self.program = program
        self.points = [step.name for step in program.steps if step.op.name == "given"]
        given = {name: {axis: domain.tape.input(name + axis) for axis in "xy"} for name in self.points}
        values = evaluate(program, domain, given)
        self.tape = domain.tape
        self.inputs = [given[name][axis].place for name in self.points for axis in "xy"]
        self.outputs = [self.tape.place(number) for number in values[-1]]

    @cached_property
    def written(self) -> Any:
        """The function that is written out of the tape."""
        return function(self.tape, self.inputs, tuple(self.outputs))

    def one(self, pose: list[float]) -> tuple[float, ...] | None:
        """One pose by the function; none where it is handed back to the rules."""
        try:
            found: tuple[float, ...] | None = self.written(*pose)
        except (ZeroDivisionError, OverflowError):
            return None
        return found

    def many(self, given: list[list[float]]) -> tuple[Any, list[int]]:
        """Many poses in blocks, and which of them are handed back."""
        found = [np.full(len(given), np.nan) for _ in self.outputs]
        columns = [np.array(column) for column in zip(*given, strict=True)]
        left = Blocks(self.tape, self.inputs, self.outputs).run(columns, found)
        return np.array(found).T, [*left]

    def by_rules(self, pose: list[float]) -> tuple[float, ...] | None:
        """One pose by the rules; none where they refuse it."""
        pairs = zip(self.points, zip(pose[::2], pose[1::2], strict=True), strict=True)
        values = drawn(self.program, Floats(), **{name: {"x": x, "y": y} for name, (x, y) in pairs})
        return None if values is None else values[-1]


@PLACES
@each("name", READING)
def test_a_tape_equals_the_rules(name: str, place: Place) -> None:
    """Written as a function and in blocks it gives the rules' floats exactly, and hands back what they refuse."""
    r = Random(name)
    for _ in range(2):
        recorded = Recorded(figure(name, r))
        given = [[float(x) for _ in recorded.points for x in place(r)] for _ in range(40)]
        right = [recorded.by_rules(pose) for pose in given]
        assert [recorded.one(pose) for pose in given] == right
        found, left = recorded.many(given)
        assert left == [k for k, numbers in enumerate(right) if numbers is None]
        assert all(tuple(ours) == theirs for ours, theirs in zip(found, right, strict=True) if theirs is not None)


def test_a_rule_may_not_branch_on_a_number() -> None:
    """A symbol refuses to be true or false."""
    with pytest.raises(TypeError, match="branch"):
        bool(Symbols().tape.input("x"))


# ---- fractions and enclosures are the truth --------------------------------------------------------------------------


@each("name", NAMES)
def test_fractions_equal_floats(name: str) -> None:
    """Fractions give what floats give, to rounding."""
    r, both = Random(name), 0
    for _ in range(60):
        program = figure(name, r)
        exact, rounded = drawn(program, Fractions()), drawn(program, Floats())
        if exact is None or rounded is None:
            continue
        both += 1
        reach = max(1.0, size(program, rounded), *(abs(float(number)) for value in exact for number in value))
        assert all(abs(float(p) - q) < 1e-12 * reach for p, q in zip(exact[-1], rounded[-1], strict=True))
    assert both or name in ROOTS


def test_fractions_refuse_what_is_irrational() -> None:
    """A root that does not come out, and a float, raise `not-rational`."""
    domain = Fractions()
    for ask in (lambda: domain.sqrt(domain.lift(2), "circles-miss", ""), lambda: domain.lift(0.1)):
        with pytest.raises(Undrawable, match="not-rational"):
            ask()
    assert domain.sqrt(domain.lift("9/4"), "", "") == domain.lift("3/2")


@each("name", NAMES)
def test_every_rule_encloses_the_exact_value(name: str) -> None:
    """What a rule gives in fractions lies between the bounds, and these are as narrow as the precision allows."""
    r, met = Random(name), 0
    for _ in range(40):
        program = figure(name, r)
        with precision(160):
            enclosed, rounded = drawn(program, Enclosures()), drawn(program, Floats())
            exact = drawn(program, Fractions())
        if enclosed is None or rounded is None:
            continue
        met += 1
        reach = max(1.0, size(program, rounded), *(abs(number) for value in rounded for number in value))
        for number, near in zip(enclosed[-1], rounded[-1], strict=True):
            assert abs(float(number) - near) < 1e-12 * reach
            assert number.error < Fraction(1, 2**100) * Fraction(reach)
        if exact is not None:
            assert all(abs(p.middle - q) <= p.error for p, q in zip(enclosed[-1], exact[-1], strict=True))
    assert met


@each("name", NAMES)
def test_what_fractions_cannot_draw_no_enclosure_draws(name: str) -> None:
    """Where a figure degenerates, enclosures fail with the same code as fractions."""
    r = Random(name)
    for _ in range(80):
        program = figure(name, r, corners)
        try:
            evaluate(program, Fractions())
        except ConstructionError as error:
            if error.code != "not-rational":
                with pytest.raises(ConstructionError, match=error.code):
                    evaluate(program, Enclosures())
        except ZeroDivisionError:  # a figure without sense, of which a rule asks nothing
            continue


def test_what_a_ball_cannot_decide_is_never_guessed() -> None:
    """What may be zero or negative fails as if it were, and the domain says that more bits may take it back; the sense
    of a motion is then anything between."""
    third = Fraction(1, 3)
    wide = Enclosure(1) / 3 - third  # nothing, but the ball does not know
    for value, undecided in ((Enclosure(0), False), (wide, True)):
        domain = Enclosures()
        with pytest.raises(Undrawable, match="lines-parallel"):
            domain.nonzero(value, 1, "lines-parallel", "")
        assert domain.undecided is undecided
    for value, undecided in ((Enclosure(-1), False), (wide, True)):
        domain = Enclosures()
        with pytest.raises(Undrawable, match="circles-miss"):
            domain.sqrt(value, "circles-miss", "")
        assert domain.undecided is undecided
    assert [Enclosures().sign(Enclosure(x), 1) for x in (third, -third, 0)] == [1, -1, 0]
    sense = Enclosures().sign(wide, 1)
    assert all(abs(sense.middle - one) <= sense.error for one in (-1, 0, 1))


# ---- derivatives -----------------------------------------------------------------------------------------------------

STEP = Decimal("1e-25")  # of the quotients: with 90 digits they agree with their limits to some 50
ROUNDING = 1e-9  # beside the largest derivative: what floats lose where a figure's lines cross flat


class Digits(Domain):
    """Decimals of very many digits."""

    def lift(self, value: Any) -> Decimal:
        fraction = Fraction(value)
        return Decimal(fraction.numerator) / fraction.denominator

    def sqrt(self, value: Decimal, code: str, why: str) -> Decimal:
        if value < 0:
            raise Undrawable(code, why)
        return value.sqrt()

    def nonzero(self, value: Decimal, scale: Decimal, code: str, why: str) -> Decimal:
        if abs(value) <= STEP * scale:
            raise Undrawable(code, why)
        return value

    def sign(self, value: Decimal, scale: Decimal) -> int:
        return 0 if abs(value) <= STEP * scale else 1 if value > 0 else -1


def last_mark(program: Program, domain: Domain, points: Sequence[Any]) -> Any:
    """What the last step makes, its given points being these coordinates, one after the other."""
    values: list[Any] = list(zip(points[::2], points[1::2], strict=True))
    for step in program.steps[program.givens :]:
        values.append(step.op.rule(domain, *[values[arg] for arg in step.args], **step.params))
    return values[-1]


def quotients(program: Program, points: Sequence[Fraction]) -> list[list[float]]:
    """The difference quotients of every number that is made, by every coordinate."""
    found = []
    with localcontext(prec=90):
        exact = [Digits().lift(number) for number in points]
        for place, number in enumerate(exact):
            ends = [last_mark(program, Digits(), [*exact[:place], number + step, *exact[place + 1 :]])
                    for step in (-STEP, STEP)]
            found.append([float((after - before) / (2 * STEP)) for before, after in zip(*ends, strict=True)])
    return found


@each("name", READING)
def test_derivatives_are_the_limits_of_difference_quotients(name: str) -> None:
    """Every rule of the table, followed with gradients, gives its derivative by each point it rests on."""
    compared = 0
    for seed in range(8):
        program = figure(name, Random(seed))
        points = [step.params[axis] for step in program.steps[: program.givens] for axis in "xy"]
        domain = Gradients(len(points))
        try:
            made = last_mark(program, domain, [float(p) + domain.error(i, 1.0) for i, p in enumerate(points)])
            expected = np.transpose(quotients(program, points))
        except Undrawable:
            continue
        gap = np.abs([domain.partials(number) for number in made] - expected)
        assert (gap <= ROUNDING * np.abs(expected).max()).all()
        compared += 1
    assert compared


# ---- rounding: no more digits are lost than the figure loses ---------------------------------------------------------

EPS = 2.0**-52
TURNS = ("parallel", "perpendicular")
TILTS = (0.0, 1e-14, -1e-14, 1e-10, 1e-6, 1e-2, 1.0)


def both(name: str, *args: Any, **params: Any) -> tuple[Any, Any]:
    """The rule on floats, and on the fractions that these floats are."""
    exact = [tuple(map(Fraction, arg)) for arg in args]
    return TABLE[name].rule(Floats(), *args, **params), TABLE[name].rule(Fractions(), *exact, **params)


def point(r: Random) -> tuple[float, float]:
    return r.uniform(-10, 10), r.uniform(-10, 10)


def line(angle: float, through: tuple[float, float]) -> tuple[float, float, float]:
    """A line with a given direction."""
    a, b = -math.sin(angle), math.cos(angle)
    return a, b, -(a * through[0] + b * through[1])


def off(exact: Any, X: Any) -> float:
    """How far a point lies from where it should."""
    return math.hypot(*(float(p - Fraction(q)) for p, q in zip(exact, X, strict=True)))


def apart(exact: Any, l: Any) -> float:
    """How far two lines of 1-norm one are apart in their numbers."""
    size = abs(exact[0]) + abs(exact[1])
    return max(abs(float(p / size - Fraction(q))) for p, q in zip(exact, l, strict=True))


def strength(turn: str, A: Any, alpha: Any, B: Any, beta: Any, C: Any) -> float:
    """How well two loci determine the third, at most one: small where the pole lies in C."""
    quarter = 1 if turn == "parallel" else 1j
    u, v = (quarter * (complex(*P) - complex(*C)) for P in (A, B))
    n, m = complex(*alpha[:2]), complex(*beta[:2])
    return abs((m.conjugate() * v).real * n - (n.conjugate() * u).real * m) / (abs(u) + abs(v))


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("tilt", TILTS)
def test_carry_is_good_where_the_auxiliary_point_is_far(tilt: float, turn: str) -> None:
    """With loci parallel to within 1e-14, or quite, Q is far away or nowhere: the third locus is as good as ever."""
    r = Random(f"{tilt} {turn}")
    for _ in range(200):
        A, B, C, angle = point(r), point(r), point(r), r.uniform(0, math.tau)
        alpha, beta = line(angle, point(r)), line(angle + tilt, point(r))
        got, exact = both("carry", A, alpha, B, beta, C, turn=turn)
        reach = 1 + abs(alpha[2]) + abs(beta[2]) + abs(got[2])
        assert apart(exact, got) <= 8 * EPS * reach / strength(turn, A, alpha, B, beta, C)


@pytest.mark.parametrize("tilt", TILTS[1:])
def test_meet_is_as_good_as_its_crossing(tilt: float) -> None:
    """Two lines meet to a rounding over the sine of their angle; within a rounding of parallel they do not."""
    r = Random(f"{tilt}")
    for _ in range(200):
        angle = r.uniform(0, math.tau)
        k, l = line(angle, point(r)), line(angle + tilt, point(r))
        sine = float(abs(Fraction(k[0]) * Fraction(l[1]) - Fraction(l[0]) * Fraction(k[1])))
        try:
            got, exact = both("meet", k, l)
        except Undrawable:
            assert sine < 4 * EPS
        else:
            assert off(exact, got) <= 4 * EPS / sine * (20 + math.hypot(*map(float, exact)))


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("tilt", TILTS)
def test_settle_rests_on_the_locus_that_tells_more(tilt: float, turn: str) -> None:
    """Where one locus runs along its own side of the figure, the other one settles it to a few roundings."""
    r = Random(f"{tilt} {turn}")
    for _ in range(200):
        C, c, A, B = point(r), point(r), point(r), point(r)
        quarter, grown = (1 if turn == "parallel" else 1j), r.uniform(0.5, 2)
        CA, CB = (quarter * (complex(*P) - complex(*C)) for P in (A, B))
        a, b = (complex(*c) + grown * side for side in (CA, CB))
        alpha = line(math.atan2(CA.imag, CA.real) + tilt, (a.real, a.imag))
        beta = line(math.atan2(CB.imag, CB.real) + 1.0, (b.real, b.imag))
        got, exact = both("settle", C, c, A, alpha, B, beta, turn=turn)
        assert off(exact, got) <= 100 * EPS * (abs(a) + abs(b)) * max(1.0, abs(CA) / abs(CB))


@pytest.mark.parametrize("tilt", TILTS)
def test_false_position_is_as_good_as_its_trials(tilt: float) -> None:
    """The true position loses digits only as far as the trials miss by the same amount."""
    r = Random(f"{tilt}")
    for _ in range(200):
        A1, A2, Z1, angle = point(r), point(r), point(r), r.uniform(0, math.tau)
        Z2 = Z1[0] + math.cos(angle + tilt), Z1[1] + math.sin(angle + tilt)
        locus = line(angle, point(r))
        errors = [sum(Fraction(p) * Fraction(q) for p, q in zip(locus, (*Z, 1.0), strict=True)) for Z in (Z1, Z2)]
        gap = float(abs(errors[0] - errors[1]))
        try:
            got, exact = both("false_position", A1, A2, Z1, locus, Z2, locus)
        except Undrawable:
            assert gap < 100 * EPS
        else:
            assert off(exact, got) <= 100 * EPS * (20 + math.hypot(*map(float, exact))) / gap


@pytest.mark.parametrize("radius", [1.0, 1e3, 1e6, 1e9])
def test_circles_of_unlike_size_meet_well(radius: float) -> None:
    """A small circle about a point of a large one is crossed to a rounding of the large one."""
    r = Random(f"{radius}")
    for _ in range(100):
        angle = r.uniform(0, math.tau)
        k, m = (0.0, 0.0, radius * radius), (radius * math.cos(angle), radius * math.sin(angle), 0.25)
        x, y = TABLE["circles_meet"].rule(Floats(), k, m, side="left")
        assert abs(math.hypot(x - m[0], y - m[1]) - 0.5) <= 4 * EPS * radius
        assert abs(math.hypot(x, y) - radius) <= 4 * EPS * radius
