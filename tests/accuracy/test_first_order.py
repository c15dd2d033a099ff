"""Expected drawing errors: the first order beside many hands, and how errors go with the pencil and the scale."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest
from drawings import SCENES, drafted_of, drawing_of, scales_of
from noisy_hands import HANDS, sample_hands

from graphplan.accuracy.drafted import draft
from graphplan.accuracy.expected import Result, first_order
from graphplan.design.hand import Hand, Pencil, hand
from graphplan.kernel.numbers import Floats
from graphplan.methods.construction import Construction

SIGMAS = 5
SHARP = Pencil(0.005, 0.005, 0.0025, 0.005)  # so fine that nothing of second order shows, at the flattest crossing
CURVED = 0.02  # of a deviation: what is left of second order
EXACT = 1e-9  # of an error: a known number of roundings


def expected(drawing: Construction, pencil: Pencil, size: float = 200.0) -> list[Result]:
    """The results of a drawing of this size."""
    scales = scales_of(drawing, size)
    return list(first_order(drawing, hand(drawing, scales.lengths_per_mm, pencil), scales))


def parts(value: Any) -> tuple[float, ...]:
    """The components of a vector, or a number alone."""
    return value if isinstance(value, tuple) else (value,)


@pytest.mark.parametrize("name", SCENES)
def test_first_order_is_how_fine_hands_scatter(name: str) -> None:
    """With a fine pencil every result has the mean and the standard deviation that first order expects."""
    drawing, scales = drawing_of(name), scales_of(drawing_of(name))
    scatter = sample_hands(drawing, hand(drawing, scales.lengths_per_mm, SHARP))
    values = drawing.read(Floats())
    assert scatter.missed == 0
    for result in expected(drawing, SHARP):
        spread, value = scatter.results[result.kind][result.of], values[result.kind][result.of]
        off, error = math.dist(spread.mean, parts(value)), result.deviation.value
        size = max(math.hypot(*parts(other)) for kind in values for other in values[kind].values()
                   if kind.split()[-1] == result.kind.split()[-1])
        assert off <= error * (SIGMAS / math.sqrt(HANDS) + CURVED) + EXACT * size
        assert abs(spread.deviation - error) <= error * (SIGMAS / math.sqrt(2 * HANDS) + CURVED) + EXACT * size


def test_flat_crossings_are_missed_by_blunt_hands() -> None:
    """Where curves cross too flat for the pencil some hands miss them, and the first order says too much."""
    flat = draft(drawing_of("double-butterfly"), Pencil(point=0.2))
    assert flat.worst is not None
    scatter = sample_hands(flat.drawing, flat.hand)
    assert 0.1 < scatter.missed < 0.5
    assert scatter.results[flat.worst.kind][flat.worst.of].deviation < 0.8 * flat.worst.deviation.value


def test_shares_are_the_variances_of_the_steps() -> None:
    """A step's share is the variance where it alone slips; all of them add up to the variance."""
    drawing, scales = drawing_of("four-bar"), scales_of(drawing_of("four-bar"))
    whole = hand(drawing, scales.lengths_per_mm, Pencil())
    results = first_order(drawing, whole, scales)
    for step, slips in enumerate(whole.slips):
        alone = Hand(whole.program, whole.values, [slips if i == step else (0.0,) * len(other)
                                                   for i, other in enumerate(whole.slips)])
        for result, part in zip(results, first_order(drawing, alone, scales), strict=True):
            assert part.deviation.value**2 == pytest.approx(result.shares[step], rel=EXACT)
    for result in results:
        assert sum(result.shares) == pytest.approx(result.deviation.value**2, rel=EXACT)


@pytest.mark.parametrize("name", ["alt-eight-link", "ozols-10-1"])
def test_errors_are_proportional_to_the_pencil(name: str) -> None:
    """A pencil twice as blunt doubles every error exactly."""
    drawing, fine = drawing_of(name), Pencil()
    blunt = Pencil(2 * fine.point, 2 * fine.edge, 2 * fine.angle, 2 * fine.opening)
    for one, two in zip(expected(drawing, fine), expected(drawing, blunt), strict=True):
        assert two.deviation.value == 2 * one.deviation.value
        assert two.deviation.mm == (None if one.deviation.mm is None else 2 * one.deviation.mm)


@pytest.mark.parametrize("name", ["alt-eight-link", "ozols-10-1"])
def test_a_sheet_twice_as_large_halves_the_errors(name: str) -> None:
    """All errors in millimetres count half on a drawing twice as large; those of angles as much as before."""
    drawing = drawing_of(name)
    lengths, angles = Pencil(angle=0), Pencil(0, 0, 0.05, 0)
    for pencil, factor in ((lengths, 2), (angles, 1)):
        for small, large in zip(expected(drawing, pencil), expected(drawing, pencil, 400), strict=True):
            assert small.deviation.value == pytest.approx(factor * large.deviation.value, rel=EXACT)


@pytest.mark.parametrize("name", ["four-bar", "triad", "slider-crank"])
def test_the_worst_step_drawn_well_helps_most(name: str) -> None:
    """Without the slips of the step named, a result's error falls more than without those of any other."""
    whole = drafted_of(name)
    assert whole.worst is not None

    def without(step: int) -> float:
        slips = [(0.0,) * len(other) if i == step else other for i, other in enumerate(whole.hand.slips)]
        found = first_order(whole.drawing, replace(whole.hand, slips=slips), whole.composition.scales)
        return found[whole.results.index(whole.worst)].deviation.value

    best = without(whole.worst.worst_step)
    assert best < whole.worst.deviation.value
    assert best == min(map(without, range(len(whole.hand.slips))))
