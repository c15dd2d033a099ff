"""A centrifugal governor as a scene tells it: its balls, the axis that they revolve about, and its range."""

from __future__ import annotations

from dataclasses import dataclass

from graphplan.mechanism.numbers import Number, Pair


@dataclass(frozen=True)
class Governor:
    """A governor: the links whose masses revolve as `balls` about an `axis` through two points of the frame, between
    which travels of the first drive it works, and the `speed` of its spindle in rad/s."""

    balls: tuple[str, ...]
    axis: tuple[str, str]
    between: Pair
    speed: Number | None = None
