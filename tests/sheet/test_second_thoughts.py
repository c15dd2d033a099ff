"""Second thoughts about letters: in a crowd those that cannot be read find better places."""

from __future__ import annotations

import random
from dataclasses import replace

import pytest

from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.labels import PlacedLetters, lettering
from graphplan.sheet.lettering.lettering import name_runs
from graphplan.sheet.lettering.relabelling import Relabelling
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Item, Polyline, Rect


def crowd(count: int, seed: int) -> PlacedLetters:
    """Letters of so many marks on a tight spot, through which a line runs from mark to mark."""
    numbers, side = random.Random(seed), 5.0 * count**0.5
    spots = [(20.0 + numbers.uniform(0.0, side), 20.0 + numbers.uniform(0.0, side)) for _ in range(count)]
    items: list[Item] = [Polyline(pens.THIN, "construction", None, tuple(spots))]
    items += [Circle(pens.DOT, "construction", None, spot, 0.5) for spot in spots]
    wishes = [Wish(name_runs(f"A_{number}"), (spot,)) for number, spot in enumerate(spots)]
    return lettering(wishes, items, spots, Rect(0.0, 0.0, 40.0 + side, 40.0 + side))


@pytest.mark.parametrize("seed", range(3))
def test_letters_that_think_again_can_be_read(seed: int) -> None:
    """Of thirty letters fewer have faults in the end, and all pay less for what they cover."""
    letters = crowd(30, seed)
    first, last = Relabelling(letters.prices, letters.choice), Relabelling(*letters._final_choice)
    assert len(last.faulty) < len(first.faulty) / 2
    assert last.paid.sum() < first.paid.sum()


def test_letters_in_haste_ask_none_to_make_room() -> None:
    """Before a crowd is enlarged its letters move by themselves alone: those without a fault stay where they are."""
    letters = crowd(30, 0)
    in_haste = replace(letters, in_haste=True)
    faulty = Relabelling(letters.prices, letters.choice).faulty
    for letter, (first, (_, last)) in enumerate(zip(letters.choice, in_haste.places, strict=True)):
        assert letter in faulty or (letters.prices.found.boxes[first] == last.boxes).all()
