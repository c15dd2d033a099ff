"""Enclosures: every rule of the table between proven bounds, and what a ball cannot decide is never guessed."""

from __future__ import annotations

from fractions import Fraction
from random import Random
from typing import Any

import pytest
from each import each
from figures import NAMES, corners, drawn, figure, size

from graphplan.errors import ConstructionError, Undrawable
from graphplan.kernel.numbers import Floats, Fractions
from graphplan.kernel.numbers.enclosures import Enclosure, Enclosures, Undecided, heading, pi, precision
from graphplan.kernel.program import evaluate

BITS = 160
THIRD = Fraction(1, 3)
WIDE = Enclosure(1) / 3 - THIRD  # nothing, but the ball does not know


def around(number: Enclosure, value: Any) -> bool:
    """Whether the bounds hold a value for certain."""
    return abs(number.middle - Fraction(value)) <= number.error


@each("name", NAMES)
def test_every_rule_encloses_the_exact_value(name: str) -> None:
    """What a rule gives in fractions lies between the bounds, and these are as narrow as the precision allows."""
    r, met = Random(name), 0
    for _ in range(40):
        program = figure(name, r)
        with precision(BITS):
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
            assert all(around(p, q) for p, q in zip(enclosed[-1], exact[-1], strict=True))
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


def test_zero_that_is_not_certain_is_undecided() -> None:
    """A ball around zero fails as zero does, and the domain says that more bits may take it back."""
    for value, undecided in ((Enclosure(0), False), (WIDE, True)):
        domain = Enclosures()
        with pytest.raises(Undrawable, match="lines-parallel"):
            domain.nonzero(value, 1, "lines-parallel", "")
        assert domain.undecided is undecided


@each(("value", "undecided"), [(Enclosure(-1), False), (WIDE, True)])
def test_root_that_may_be_of_a_negative_number(value: Enclosure, undecided: bool) -> None:
    """A root fails where the number is negative, and where that cannot be told."""
    domain = Enclosures()
    with pytest.raises(Undrawable, match="circles-miss"):
        domain.sqrt(value, "circles-miss", "")
    assert domain.undecided is undecided


def test_length_of_next_to_nothing_has_bounds() -> None:
    """The root of a sum of squares that may be nothing lies between 0 and that of its upper bound."""
    root = (WIDE * WIDE).root
    assert around(root, 0)
    assert 0 < root.error < Fraction(1, 2**50)


def test_sense_of_motion() -> None:
    """The sense of a motion is 1, -1, or 0, and anything between where the ball holds more than one."""
    domain = Enclosures()
    assert [domain.sign(Enclosure(x), 1) for x in (THIRD, -THIRD, 0)] == [1, -1, 0]
    assert all(around(domain.sign(WIDE, 1), sense) for sense in (-1, 0, 1))


def test_order_of_overlapping_numbers_is_undecided() -> None:
    """Numbers are larger or smaller for certain, or the question is refused."""
    assert Enclosure(THIRD) < Fraction(1, 2) <= Enclosure(1) / 2
    with pytest.raises(Undecided):
        bool(WIDE > 0)
    assert WIDE != 0


def test_equal_is_what_is_known_to_be_one_number() -> None:
    """The same reckoning gives equal numbers with equal hashes, and a number by itself is one."""
    one, two = Enclosure(2).root, Enclosure(2).root
    assert one == two
    assert hash(one) == hash(two)
    assert one / one == 1
    assert one != one + WIDE


def test_numbers_are_lifted_as_they_are_written() -> None:
    """A fraction is its quotient, a float its binary fraction, and all of them reckon with enclosures."""
    domain = Enclosures()
    assert around(domain.lift(Fraction(1, 10)), Fraction(1, 10))
    assert domain.lift(0.1).middle == Fraction(0.1)
    two = Enclosure(2)
    for number in (THIRD, 3, 0.25):
        exact = Fraction(number)
        for found, value in ((two + number, 2 + exact), (number - two, exact - 2), (number * two, 2 * exact),
                             (two / number, 2 / exact), (number / two, exact / 2), (-two * number, -2 * exact)):
            assert around(found, value)


def test_angles_are_of_exact_degrees() -> None:
    """Cosine and sine of 60 degrees hold one half and the root of three quarters; pi holds its first digits."""
    with precision(BITS):
        c, s = heading(Fraction(60))
        assert around(c, Fraction(1, 2))
        assert around(s * s, Fraction(3, 4))
        assert abs(pi().middle - Fraction("3.14159265358979323846264338327950288419716939937510")) < Fraction(1, 10**45)
