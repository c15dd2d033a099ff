"""Claims hold of what the rules draw, whatever the figure."""

from __future__ import annotations

from random import Random

from each import each
from figures import NAMES, Place, corners, drawn, extremes, figure
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from graphplan.kernel import Board
from graphplan.kernel.claims import broken_claims, unmet
from graphplan.kernel.numbers import Floats, Fractions
from graphplan.kernel.passes import freeze

RANDOMS = st.randoms(use_true_random=False)


@each("name", NAMES)
@settings(max_examples=22, deadline=None)
@given(r=RANDOMS)
def test_claims_hold(name: str, r: Random) -> None:
    """What a primitive draws on random operands keeps all its claims."""
    program = figure(name, r)
    values = drawn(program, Floats())
    assume(values is not None)
    assert values is not None
    assert list(broken_claims(program, values)) == []


@each("name", NAMES)
@each("place", [corners, extremes])
def test_claims_hold_in_degenerate_figures(name: str, place: Place) -> None:
    """Points that coincide or lie in line, and lengths 1e-9 and 1e9 apart, are drawn right or not at all."""
    r = Random(name)
    for _ in range(97):
        program = figure(name, r, place)
        values = drawn(program, Floats())
        assert values is None or list(broken_claims(program, values)) == []


@each("name", NAMES)
def test_claims_hold_of_fractions(name: str) -> None:
    """Claims are tested on fractions too."""
    r = Random(name)
    exact = [(program, drawn(program, Fractions())) for program in (figure(name, r) for _ in range(20))]
    assert all(list(broken_claims(program, values)) == [] for program, values in exact if values is not None)


def test_unmet_claim_is_named() -> None:
    """A claim that is not kept is named with its step and how far it is off."""
    b = Board()
    A, B = b.given(x=0, y=0, name="A"), b.given(x=2, y=0, name="B")
    program = freeze(b, [b.midpoint(A, B, name="M")])
    assert unmet(program.steps[2], [(0.0, 0.0), (2.0, 0.0), (1.0, 0.0)]) == []
    assert list(broken_claims(program, [(0.0, 0.0), (2.0, 0.0), (1.5, 0.0)])) == [
        "step 1 (M = midpoint(A, B)): M B is not the vector A M; by 5.0e-01 of its size"]


def test_nan_keeps_no_claim() -> None:
    """A value that is not a number does not pass."""
    b = Board()
    program = freeze(b, [b.midpoint(b.given(x=0, y=0), b.given(x=2, y=0))])
    assert unmet(program.steps[2], [(0.0, 0.0), (2.0, 0.0), (float("nan"), 0.0)])
