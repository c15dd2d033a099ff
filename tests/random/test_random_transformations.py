"""Any scene seen otherwise gives the same results, seen otherwise: exactly, and with the same exit status.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from fractions import Fraction
from itertools import islice
from pathlib import Path
from random import Random

import pytest
from gearings import gearing
from linkages import linkage
from loads import loaded_scenes
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

import graphplan
from graphplan.check.cycle import cycle
from graphplan.check.json_results import result_data
from graphplan.check.trusted import report
from graphplan.errors import GraphplanError
from graphplan.mechanism.scene import parse

SCENES = 12  # of each kind
MADE = {"linkage": linkage, "gearing": gearing}
SEEN: dict[str, Callable[[Tables, int], Transformation]] = {
    "moved": lambda tables, seed: MOVED, "turned": lambda tables, seed: TURNED,
    "mirrored": lambda tables, seed: MIRRORED, "backwards": lambda tables, seed: BACKWARDS,
    "large": lambda tables, seed: LARGE, "small": lambda tables, seed: SMALL, "metric": lambda tables, seed: METRIC,
    "renamed": lambda tables, seed: renamed(tables, Random(seed)),
    "shuffled": lambda tables, seed: Transformation(order=seed),
}


def _scenes() -> Iterator[tuple[str, Tables]]:
    """Random mechanisms with every kind of pair, without loads and with them."""
    for seed in range(SCENES):
        for kind, made in MADE.items():
            yield f"{kind} {seed}", tables_of(made(seed).text())
            if (loaded := next(loaded_scenes(seed, 1, made), None)) is not None:
                tables = tables_of(loaded.text)
                for gear in tables.get("gears", []):
                    if "belt" not in gear:
                        gear["pressure_angle"] = {"tangent": Fraction("0.36")}
                yield f"loaded {kind} {seed}", tables


def _solved(tables: Tables, exact: bool = True) -> tuple[int, Results]:
    """The exit status of `solve`, and its results where that is 0."""
    try:
        return 0, results_of(result_data(report(parse(text_of(tables), "scene"), exact=exact)))
    except GraphplanError as error:
        return error.status, {}


def test_scenes_seen_otherwise_give_the_same() -> None:
    """As fractions, with the same status; each pin's reaction on the link that is told where links change their order.

    Each scene is seen in one of the ways in turn.
    """
    statuses, ways = set(), [*SEEN]
    for number, (name, given) in enumerate(_scenes()):
        for way in ways[number % len(ways)::len(ways)]:
            tables = {**given, "units": INCHES} if way == "metric" else given
            seen = SEEN[way](tables, number)
            (status, before), (now, found) = _solved(tables), _solved(seen.scene(tables))
            wanted = seen.results(before)
            if way == "shuffled":
                wanted, found = ({key: one[key] for key in one.keys() & other.keys()}
                                 for one, other in ((wanted, found), (found, wanted)))
            assert now == status, (name, way)
            differing = {key for key in wanted.keys() | found.keys() if wanted.get(key) != found.get(key)}
            assert not differing, (name, way)
            statuses.add(status)
    assert 0 in statuses


def test_floats_lose_no_digit_for_lying_far_off() -> None:
    """Moved by a million a scene has the same numbers, to the digits of floats."""
    compared = 0
    for name, tables in islice(_scenes(), None, None, 3):
        (status, near), (now, far) = (_solved(one, exact=False) for one in (tables, MOVED.scene(tables)))
        assert now == status, name
        for key, value in near.items():
            parts = zip(value, far[key], strict=True) if isinstance(value, list) else [(value, far[key])]
            size = max(map(abs, value)) if isinstance(value, list) else abs(value or 0)
            for one, other in parts if value is not None and key[0] != "point" else ():
                compared += 1
                assert abs(one - other) <= 1e-9 * max(size, Fraction(1, 10**6)), (name, key)
    assert compared > 100


@pytest.mark.parametrize("seen", [MOVED, MIRRORED, QUARTER, BACKWARDS, LARGE, SMALL])
def test_cycles_seen_otherwise_agree_as_well(seen: Transformation) -> None:
    """Around the cycle construction and solver agree wherever the scene lies, and however large it is."""
    text = "[points]\nO = [0, 0]\nA = [20, 110]\nB = [135, 225]\nC = [310, 0]\n[links]\n1 = 'O A'\n2 = 'A B'\n" \
           "3 = 'B C'\nframe = 'O C'\n[[drive]]\nlink = '1'\nomega = 10\n"
    found = cycle(parse(text_of(seen.scene(tables_of(text))), "scene"), 8)
    assert found.wrong == ()
    assert max(found.check.values()) < 1e-12


def test_loads_are_superposed() -> None:
    """Reactions and balances of all loads are the sums of those of inertia and weight, and of the given loads."""
    compared = 0
    for name, tables in _scenes():
        if not name.startswith("loaded"):
            continue
        tables["gears"] = [{key: value for key, value in gear.items() if key != "pressure_angle"}
                           | ({} if "belt" in gear else {"pressure_angle": {"tangent": Fraction(0)}})
                           for gear in tables.get("gears", [])]  # flanks push apart whichever way the force goes
        inertia, given = ({key: value for key, value in tables.items() if key not in left_out}
                          for left_out in (("forces", "moments"), ("masses", "gravity")))
        (status, every), (_, one), (_, other) = map(_solved, (tables, inertia, given))
        for key in (key for key in every if key[0] in ("force", "moment") and status == 0):
            compared += 1
            value, parts = every[key], (one[key], other[key])
            total = [*map(sum, zip(*parts, strict=True))] if isinstance(value, list) else sum(parts)
            assert value == total, (name, key)
    assert compared > 5


def test_a_slide_without_force_has_no_line_of_action() -> None:
    """A pump moved by a million agrees in all poses: also where its piston presses on no side of its cylinder."""
    text = (Path(graphplan.__file__).parent / "scenes" / "ozols-16-1.toml").read_text("utf-8")
    found = cycle(parse(text_of(MOVED.scene(tables_of(text))), "scene"), 12)
    assert found.wrong == ()
