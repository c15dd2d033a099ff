"""Extreme positions: where a link turns back, and the crank and the coupler that bring it there."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Extreme:
    """An extreme position of a `link`, `outer` or `inner`.

    Where a `coupler` on a crank swings it, they lie in one line: the crank turns about its `pivot`; the coupler is on
    its `pin`, and the link on the coupler's other `joint`.
    `time_ratio`: of the crank's turns from one extreme position to the other the larger over the smaller, if known.
    """

    way: str
    link: str
    coupler: str = ""
    pivot: str = ""
    pin: str = ""
    joint: str = ""
    time_ratio: float | None = None
