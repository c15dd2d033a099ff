"""The unlabelled traces of a sheet: which of them are near to something expected, and which are one stroke."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from shapely import LineString

from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.judge.student_sheet import StudentSheet, sampled
from graphplan.marking.traces import Trace

TWIN, BESIDE = 0.5, 1.0  # mm: a stroke that is found twice lies so near to itself; two may be taken for each other


class Unlabelled:
    """The unlabelled traces of a sheet, on every plan: where they are near to something expected."""

    def __init__(self, sheet: StudentSheet, traces: Sequence[Trace], places: Sequence[int], seen: int):
        self.traces, self._places = traces, {kind: [i for i in places if traces[i].kind == kind]
                                             for kind in (POINT, LINE, CIRCLE)}
        self._spots: dict[tuple[str, str], Any] = {}
        self._board, self.seen, self._twins = sheet, seen, dict[int, set[int]]()

    def of(self, kind: str) -> list[int]:
        """The loose traces of a kind."""
        return self._places.get(kind, [])

    def twins(self, place: int) -> set[int]:
        """The loose traces that are the same stroke as a trace that was found by seeking it."""
        trace = self.traces[place]
        if place < self.seen or trace.kind == POINT:
            return set()
        if place not in self._twins:
            self._twins[place] = {other for other in self._places[trace.kind] if _same(trace, self.traces[other])}
        return self._twins[place]

    def beside(self, place: int, panel: str, value: Sequence[float]) -> list[int]:
        """The other traces that are so near to what one is that it could be they."""
        places, off = self.near(self.traces[place].kind, panel, value)
        return [other for other, far in zip(places, off, strict=True) if far < BESIDE and other != place]

    def near(self, kind: str, panel: str, value: Sequence[float]) -> tuple[list[int], Any]:
        """The traces of a kind that may lie on a plan, and how far each is from a value in mm at most."""
        places = self.of(kind)
        if not places:
            return [], np.zeros(0)
        spots = self._on(kind, panel)
        if kind == POINT:
            off = np.abs(spots[:, 0] - complex(value[0], value[1]))
        elif kind == LINE:
            a, b, c = value
            off = np.max(np.abs(a * spots.real + b * spots.imag + c), axis=1) / math.hypot(a, b)
        else:
            off = np.max(np.abs(np.abs(spots - complex(value[0], value[1])) - math.sqrt(max(value[2], 0.0))), axis=1)
        return places, off * self._board.mm(panel)

    def _on(self, kind: str, panel: str) -> Any:
        """The spots of all traces of a kind in the units of a plan; nowhere where they are said to be on another."""
        if (kind, panel) not in self._spots:
            frame = self._board.fits[panel].frame
            rows = [[frame.back(complex(*spot)) if self.traces[i].panel in ("", panel) else complex(math.inf)
                     for spot in sampled(self.traces[i])] for i in self._places[kind]]
            self._spots[kind, panel] = np.array(rows)
        return self._spots[kind, panel]


def _same(one: Trace, other: Trace) -> bool:
    """Whether a line, or a rim, lies upon another of its kind, and beside no more than half of it."""
    whole = LineString(other.spots)
    return bool(whole.intersection(LineString(one.spots).buffer(TWIN)).length > whole.length / 2)
