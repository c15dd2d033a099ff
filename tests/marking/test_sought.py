"""Where a picture is searched for a stroke."""

from __future__ import annotations

import cmath
from types import SimpleNamespace
from typing import Any

import pytest

from graphplan.marking.judge import measures
from graphplan.marking.judge.evidence import ImageSearch


def test_an_arc_is_sought_to_both_sides_of_its_mark() -> None:
    """At equal distances, from as far before its mark as after it, on its circle."""
    step: Any = None
    search = object.__new__(ImageSearch)
    search.sheet = SimpleNamespace(frame=lambda step: SimpleNamespace(unit=2.0, to_sheet=lambda z: 2 * z))  # type: ignore
    spots = [complex(*spot) for spot in search._arc(step, (1.0, 2.0, 100.0), [1 + 12j], measures.ARC_MM)]
    assert len(spots) == measures.STROKE_SPOTS + 1
    turns = [cmath.phase((spot - (2 + 4j)) / 20j) for spot in spots]
    assert turns == pytest.approx([measures.ARC_MM / 20 * (2 * k / measures.STROKE_SPOTS - 1)
                                   for k in range(measures.STROKE_SPOTS + 1)], abs=1e-12)
    assert [abs(spot - (2 + 4j)) for spot in spots] == pytest.approx([20.0] * len(spots))
