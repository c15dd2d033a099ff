"""Sizes and differences of numbers and of vectors, in any number domain."""

from __future__ import annotations

from typing import Any

from graphplan.mechanism.model import Scene


def difference(one: Any, two: Any) -> Any:
    """What one number or vector exceeds another by."""
    return (one[0] - two[0], one[1] - two[1]) if isinstance(one, tuple) else one - two


def size(value: Any) -> Any:
    """The size of a number, or of a vector's larger component."""
    return max(abs(value[0]), abs(value[1])) if isinstance(value, tuple) else abs(value)


def extent(scene: Scene) -> Any:
    """How far the mechanism extends, across or upwards; one unit of length where all its points coincide."""
    xs, ys = zip(*scene.points.values(), strict=True)
    return max(max(xs) - min(xs), max(ys) - min(ys)) or 1
