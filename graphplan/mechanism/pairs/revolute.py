"""Revolute pairs (joints, pins): links turn on each other about a point that they share."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from graphplan.mechanism.numbers import X, quarter_turn
from graphplan.mechanism.pairs.pair import FRAME, POINT, Along, GivenPose, KinematicPair


@dataclass(frozen=True)
class Revolute(KinematicPair):
    """A joint of two links or more at a point: the first of them carries the pin, and each other one turns on it.

    A link is held along x and y, or where special geometry needs only one of both, along an axis of its own and across.
    """

    letter, binds, passes = "R", 2, (POINT,)
    at: str
    pinned: tuple[str, ...]
    axes: Mapping[str, Any] = field(default_factory=dict, compare=False)

    @property
    def links(self) -> tuple[str, ...]:
        """The links that it joins."""
        return self.pinned

    def states(self, scene: GivenPose) -> Iterator[Along]:
        """No link's point leaves that of the one with the pin."""
        pin, *links = self.pinned
        for link in links:
            axis, to = self.axes.get(link, X), link if link in self.axes else FRAME
            yield Along(link, pin, self.at, axis, "x", to=to)
            yield Along(link, pin, self.at, quarter_turn(axis), "y", to=to)
