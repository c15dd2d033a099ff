"""Any scene seen otherwise gives the same results, seen otherwise: exactly, and with the same exit status."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from random import Random

import pytest
from face import ran
from transformations import (
    BACKWARDS,
    INCHES,
    LARGE,
    METRIC,
    MIRRORED,
    MOVED,
    QUARTER,
    SMALL,
    TURNED,
    Results,
    Tables,
    Transformation,
    renamed,
    results_of,
    tables_of,
    text_of,
)
from worlds import texts

import graphplan as gp

SEEDS = 12  # of each kind
KINDS = "linkage", "gearing", "loaded linkage", "loaded gearing"
SEEN: dict[str, Callable[[Tables, int], Transformation]] = {
    "moved": lambda tables, seed: MOVED, "turned": lambda tables, seed: TURNED,
    "mirrored": lambda tables, seed: MIRRORED, "backwards": lambda tables, seed: BACKWARDS,
    "large": lambda tables, seed: LARGE, "small": lambda tables, seed: SMALL, "metric": lambda tables, seed: METRIC,
    "renamed": lambda tables, seed: renamed(tables, Random(seed)),
    "shuffled": lambda tables, seed: Transformation(order=seed),
}


def scenes(kind: str) -> Iterator[tuple[int, Tables]]:
    """The tables of random mechanisms, without loads or with them."""
    for seed, text in texts(kind, range(SEEDS)):
        yield seed, tables_of(text)


def solved(tables: Tables, exact: bool = True) -> tuple[int, Results]:
    """The exit status of `solve`, and its results where that is 0."""
    try:
        return 0, results_of(gp.solve(gp.parse(text_of(tables)), exact=exact).json())
    except gp.GraphplanError as error:
        return error.status, {}


@pytest.mark.parametrize("kind", KINDS)
def test_scenes_seen_otherwise_give_the_same(kind: str) -> None:
    """As fractions, with the same status; each pin's reaction on the link that is told where links change their order.
    Each scene is seen in one of the ways in turn."""
    statuses, ways = set(), [*SEEN]
    for number, (seed, given) in enumerate(scenes(kind), KINDS.index(kind)):
        way = ways[number % len(ways)]
        tables = {**given, "units": INCHES} if way == "metric" else given
        seen = SEEN[way](tables, seed)
        (status, before), (now, found) = solved(tables), solved(seen.scene(tables))
        wanted = seen.results(before)
        if way == "shuffled":
            wanted, found = ({key: one[key] for key in one.keys() & other.keys()}
                             for one, other in ((wanted, found), (found, wanted)))
        assert now == status, (seed, way)
        assert {key for key in wanted.keys() | found.keys() if wanted.get(key) != found.get(key)} == set(), (seed, way)
        statuses.add(status)
    assert 0 in statuses


@pytest.mark.parametrize("kind", KINDS[1:])
def test_floats_lose_no_digit_for_lying_far_off(kind: str) -> None:
    """Moved by a million a scene has the same numbers, to the digits of floats."""
    compared = 0
    for seed, tables in [*scenes(kind)][::3]:
        (status, near), (now, far) = (solved(one, exact=False) for one in (tables, MOVED.scene(tables)))
        assert now == status, seed
        for key, value in near.items():
            parts = zip(value, far[key], strict=True) if isinstance(value, list) else [(value, far[key])]
            size = max(map(abs, value)) if isinstance(value, list) else abs(value or 0)
            for one, other in parts if value is not None and key[0] != "point" else ():
                compared += 1
                assert abs(one - other) <= 1e-9 * max(size, Fraction(1, 10**6)), (seed, key)
    assert compared > 30


@pytest.mark.parametrize("name", ["four-bar", "ozols-16-1"])
@pytest.mark.parametrize("seen", [MOVED, MIRRORED, QUARTER, BACKWARDS, LARGE, SMALL])
def test_cycles_seen_otherwise_agree_as_well(name: str, seen: Transformation) -> None:
    """Around the cycle construction and solver agree wherever the scene lies, and however large it is; also where the
    piston of a pump presses on no side of its cylinder."""
    text = text_of(seen.scene(tables_of(gp.load(name).text)))
    done = ran("cycle", "-", "--positions", "12", given=text)
    assert done.status == 0, done.err
    last = done.err.splitlines()[-1]
    assert last.startswith("12 of 12 poses"), last
    assert all(float(gap.split()[-1]) < 1e-9 for gap in last.partition("solver: ")[2].split(","))
