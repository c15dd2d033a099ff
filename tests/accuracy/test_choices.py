"""Which form is preferred, and what `cost` compares: by what commands print."""

from __future__ import annotations

import re

import pytest
from face import got, ran


def test_cost_compares_all_forms_in_a_table() -> None:
    """`cost` prints a table that is not too wide, with every method on both plans, by set squares and strictly."""
    lines = ran("cost", "five-bar").out.splitlines()
    assert max(map(len, lines)) <= 120
    assert sum(line.startswith("every method") for line in lines) == 2 * 2 * 2
    assert sum(bool(re.search("Orthogonal|Polar", line)) for line in lines) == 4


@pytest.mark.parametrize(("name", "count"), [("five-bar", 4), ("four-bar", 8), ("triad", 13)])
def test_each_form_is_compared_once(name: str, count: int) -> None:
    """Methods that draw the same share a form; simplicity is told of strict forms; all cross in at most 90 degrees."""
    forms = got(name).data("cost", "--json")["forms"]
    assert len(forms) == count
    assert len({(form["form"], form["plan"], form["strict"]) for form in forms}) == count
    for form in forms:
        assert (form["cost"]["simplicity"] is not None) == form["strict"]
        assert all(0 < crossing["degrees"] <= 90 for crossing in form["cost"]["crossings"])


@pytest.mark.parametrize(("wish", "price"), [
    ("quick", lambda operations, error: operations), ("accurate", lambda operations, error: error),
    ("balanced", lambda operations, error: operations * error)])
def test_the_form_preferred_is_the_best_of_those_told(wish: str, price: object) -> None:
    """The quick form has the fewest operations, the accurate one the smallest error, the balanced one the smallest
    product; all that were weighed are told, a line each."""
    told = got("triad").printed("steps", "--plan", "polar", "--prefer", wish)
    found = re.search(rf"{wish} form preferred: (.*?); compared on A\d[^:]*:\n((?: .*\n)+)", told)
    assert found
    weighed = {name: price(int(operations), float(error)) for name, operations, error in re.findall(  # type: ignore[operator]
        r"  (.*): (\d+) operations, error ([\d.]+) %", found[2])}
    assert len(weighed) > 1
    best = next(name for name in weighed if found[1] in name)
    assert weighed[best] <= min(weighed.values())
