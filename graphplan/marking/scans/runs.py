"""Stretches of a line or rim that were really drawn: crests in a row, with gaps no wider than a pencil leaves."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

BIN, GAP = 0.25, 2.0  # mm: how closely a line is looked at, and the widest gap in it


@dataclass(frozen=True)
class Stretch:
    """From where to where something was drawn, in mm along it, and the share of it that is seen."""

    start: float
    end: float
    seen: float

    @property
    def long(self) -> float:
        return self.end - self.start


def stretches(along: NDArray[np.float64], hidden: Callable[[NDArray[np.float64]], NDArray[np.bool_]]
              ) -> Iterator[Stretch]:
    """The stretches that crests at these places make; where print hides a line, it may well go on."""
    low = float(along.min())
    count = int((float(along.max()) - low) / BIN) + 1
    drawn = np.zeros(count, bool)
    drawn[np.minimum(((along - low) / BIN).astype(int), count - 1)] = True
    open_ = ~hidden(np.asarray(low + (np.arange(count) + 0.5) * BIN, np.float64)) | drawn
    counted = np.cumsum(open_)  # so much of it could have been seen
    marked = np.flatnonzero(drawn)
    breaks = np.flatnonzero(np.diff(counted[marked]) > GAP / BIN + 1)
    for first, last in zip([0, *(breaks + 1)], [*breaks, len(marked) - 1], strict=True):
        start, end = int(marked[first]), int(marked[last])
        share = (last - first + 1) / max(1, int(open_[start : end + 1].sum()))
        yield Stretch(low + start * BIN, low + (end + 1) * BIN, share)
