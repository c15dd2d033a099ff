"""Claims about `solve --digits`: proven digits of all that floats give, by construction and solver of their own."""

from __future__ import annotations

from collections.abc import Iterator
from decimal import Decimal
from typing import Any

import pytest
from claim import claim
from face import Got

KINDS = "points", "links", "slides", "balance", "reactions"
NAMES = "link", "at", "on", "from", "slide", "gear", "contact"


def numbers(value: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], str | float]]:
    """All numbers of results, with their paths."""
    if isinstance(value, dict | list):
        for key, part in value.items() if isinstance(value, dict) else enumerate(value):
            if key not in NAMES:
                yield from numbers(part, (*path, str(key)))
    elif value is not None:
        yield path, value


@claim()
def digits_are_proven(got: Got) -> None:
    """All results have as many digits as are asked for, or are 0, and construction and solver agree in them; they are
    those that floats give, to rounding. Loads that are known to a float's digits have no more."""
    pytest.importorskip("flint")
    digits = 15 if any("its value in this pose" in why for why in got.scene.irrational) else 30
    data = got.data("solve", "--digits", str(digits))
    assert data["digits"] == digits
    assert all(Decimal(gap) <= Decimal(10) ** -digits for gap in data["check"].values())
    largest: dict[str, float] = {}
    proven = {path: value for kind in KINDS for path, value in numbers(data.get(kind, {}), (kind,))}
    plain = {path: float(value) for kind in KINDS for path, value in numbers(got.solved.get(kind, {}), (kind,))}
    assert proven.keys() == plain.keys()
    for path, value in plain.items():
        kind = "force" if path[0] in ("balance", "reactions") else path[-2 if path[-1] in "01" else -1]
        largest[kind] = max(largest.get(kind, 0.0), abs(value))
    span = float(got.scene.extent)
    for path, text in proven.items():
        kind = "force" if path[0] in ("balance", "reactions") else path[-2 if path[-1] in "01" else -1]
        size = max(largest[kind], largest.get("velocity", 0.0) / span if kind == "omega" else 0.0,
                   largest.get("acceleration", 0.0) / span if kind == "alpha" else 0.0)
        assert text == "0" or len(Decimal(text).as_tuple().digits) == digits, path
        assert abs(float(text) - plain[path]) <= 1e-10 * size, path
