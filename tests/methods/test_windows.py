"""What is said to be off the sheet does not hang on units."""

from __future__ import annotations

import pytest

from graphplan.methods.construction import _window


@pytest.mark.parametrize("scale", [1e-12, 1.0, 1e12])
def test_the_sheet_of_one_point_is_as_small_as_the_mechanism(scale: float) -> None:
    """About points that coincide the window is a part of the mechanism, in any unit, wherever they lie."""
    least = 1e-9 * scale
    assert _window([(0.0, 0.0)] * 2, least).radius == 1.25 * least
    assert _window([(5e6 * scale, 0.0)] * 2, least).radius == 1.25 * least
    assert _window([(0.0, 0.0), (scale, 0.0)], least).radius == 1.25 * scale
