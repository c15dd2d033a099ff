"""What letters pay for covering: the length of lines, the area of surfaces, standing nearer to another mark."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest

from graphplan.sheet.lettering.label_candidates import AIR, OUTWARDS, Array, LabelCandidates
from graphplan.sheet.lettering.prices import FAULT, MISTAKEN_TIMES, STRANGER, TOUCH, Lines, Marks, Surfaces
from graphplan.sheet.lettering.standing import Footprints, clashes, costs_of_all
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Polygon, Polyline, Spot

RATE = 3.0  # of a figure, for a mm^2


def cells(*boxes: tuple[float, float, float, float], spot: Spot = (0.0, 0.0)) -> LabelCandidates:
    """Candidates which are, with the air around them, these boxes."""
    count = len(boxes)
    return LabelCandidates(np.arange(count), np.array(boxes) - AIR * OUTWARDS, np.full((count, 2), spot),
                           np.zeros(count),
                           np.zeros(count, dtype=bool))  # fmt: skip


def covered(spots: tuple[Spot, ...], *boxes: tuple[float, float, float, float]) -> Array:
    """The area of a figure that each box covers."""
    price = Surfaces([Polygon(pens.BLOCK, "blocks", None, spots)]).price(cells(*boxes))
    return np.where(price > 0, (price - FAULT * (price > FAULT)) / RATE - TOUCH, 0.0)


@pytest.mark.parametrize("turned", [False, True])
def test_a_place_pays_for_the_area_that_it_covers(turned: bool) -> None:
    """Of an L-shaped figure, whichever way it runs round: all, a part, the notch alone, nothing beside it."""
    spots = (0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)
    boxes = (-1.0, -1.0, 9.0, 9.0), (0.5, 0.5, 2.0, 2.0), (2.0, 2.0, 3.0, 3.0), (5.0, 5.0, 6.0, 6.0)
    areas = covered(spots[::-1] if turned else spots, *boxes)
    assert areas == pytest.approx([6.0, 0.5 * 1.5 + 0.5 * 1.0, 0.0, 0.0])


def test_areas_are_those_of_many_points() -> None:
    """A slanting triangle's area in random boxes is the share of the points of a fine grid that lie in both."""
    spots, numbers = ((0.0, 0.0), (7.0, 2.0), (3.0, 6.0)), random.Random(5)
    corners = [(numbers.uniform(-1, 5), numbers.uniform(-1, 5)) for _ in range(40)]
    boxes = [(x, y, x + 2.0, y + 1.5) for x, y in corners]
    grid = (np.arange(200) + 0.5) / 200
    for box, area in zip(boxes, covered(spots, *boxes), strict=True):
        x, y = np.meshgrid(box[0] + 2.0 * grid, box[1] + 1.5 * grid)
        left = [(q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]) >= 0
                for p, q in zip(spots, (*spots[1:], spots[0]), strict=True)]
        assert area == pytest.approx(3.0 * float(np.all(left, axis=0).mean()), abs=0.02)


def test_thick_strokes_and_discs_are_surfaces() -> None:
    """A bar covers its length by its width, and its round ends; a dot its disc and a little around it."""
    everything = cells((-50.0, -50.0, 50.0, 50.0))
    bar = Surfaces([Polyline(pens.BAR, "links", None, ((0.0, 0.0), (6.0, 8.0)))]).price(everything)[0]
    octagon = 2 * math.sqrt(2) * (pens.BAR.width / 2) ** 2
    assert bar == pytest.approx(FAULT + 5.0 * (10.0 * pens.BAR.width + octagon + TOUCH))
    dot = Surfaces([Circle(pens.DOT, "construction", None, (3.0, 4.0), 0.8)]).price(everything)[0]
    assert dot == pytest.approx(FAULT + 5.0 * (math.pi + TOUCH), rel=0.01)


def test_a_ring_is_a_surface_that_is_open_within() -> None:
    """A wide ring costs half of what it does in a place over its half, and nothing in one within it."""
    ring = Surfaces([Circle(pens.DOT, "construction", None, (0.0, 0.0), 5.0)])
    whole, half, within = ring.price(cells((-9.0, -9.0, 9.0, 9.0), (-9.0, -9.0, 0.0, 9.0), (-2.0, -2.0, 2.0, 2.0)))
    assert whole == pytest.approx(FAULT + 5.0 * (2 * math.pi * 5.2 * 0.4 + TOUCH), rel=0.02)
    assert half == pytest.approx((whole + FAULT + 5.0 * TOUCH) / 2)
    assert within == 0.0


def test_a_place_pays_for_the_length_of_lines() -> None:
    """A line through a place costs its length there, and once for touching it, however many segments it has."""
    price = 1.0 + 5.0 * pens.THIN.width
    bent = Polyline(pens.THIN, "construction", None, ((-5.0, 1.0), (1.0, 1.0), (1.0, 9.0)))
    paid = Lines([bent]).price(cells((0.0, 0.0, 2.0, 2.0), (3.0, 0.0, 4.0, 2.0)))
    assert paid == pytest.approx([FAULT + price * (2.0 + TOUCH), 0.0])


def test_a_place_should_be_nearest_to_its_own_mark() -> None:
    """Each other mark that is nearer than the letter's own costs; the own mark and those far away do not."""
    marks = Marks([(0.0, 0.0), (6.0, 0.0), (6.0, 2.0), (90.0, 0.0)])
    prices = marks.price(cells((4.0, 0.0, 5.0, 1.0), (1.0, 0.0, 2.0, 1.0)))
    assert prices == pytest.approx([MISTAKEN_TIMES * FAULT + 2 * STRANGER, 0.0])


def test_a_plan_without_obstacles_costs_nothing() -> None:
    """No lines, no marks and no surfaces are free."""
    place = cells((0.0, 0.0, 1.0, 1.0))
    assert [float(part.price(place)[0]) for part in (Lines([]), Marks([]), Surfaces([]))] == [0.0, 0.0, 0.0]


def test_letters_that_stand_are_priced_together_as_one_by_one() -> None:
    """What all letters pay for each other is what each pays where the others stand: boxes, and leaders through them."""
    rng = np.random.default_rng(2)
    low = rng.uniform(0.0, 20.0, (30, 2))
    places = LabelCandidates(np.arange(30), np.hstack([low, low + 3.0]), low + rng.uniform(-9.0, 9.0, (30, 2)),
                             np.zeros(30), rng.random(30) < 0.5)  # fmt: skip
    standing = Footprints.of(places)
    alone = [float(clashes(standing[[letter]], standing[np.delete(np.arange(30), letter)]).cost[0])
             for letter in range(30)]
    assert costs_of_all(standing) == pytest.approx(alone)
    assert len(set(alone)) > 10
