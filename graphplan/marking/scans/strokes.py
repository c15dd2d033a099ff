"""What was drawn, taken apart: the line with the most crests first, then of what is left, again and again.

Crests that bend are carried on as a circle's rim; what is neither straight nor round, such as letters, is left.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphplan.marking.scans.lines import Row, bends, line, row
from graphplan.marking.scans.pencil_pixels import Ink
from graphplan.marking.scans.ridges import Ridges
from graphplan.marking.scans.rims import grown
from graphplan.marking.scans.runs import Run, runs
from graphplan.marking.scans.vote import LEAST, Vote
from graphplan.marking.traces import Trace

SEEN, FEW, MOST = 0.55, 8, 600  # the share of a line that is seen, its fewest crests, the most lines tried
LONGER = 1.25  # how much longer a rim is than the piece of it that looked straight


@dataclass
class Strokes:
    """The lines and rims among crests, as they are taken away; `left` says which are not."""

    found: Ridges
    ink: Ink
    left: NDArray[np.bool_]

    @classmethod
    def of(cls, found: Ridges, ink: Ink) -> Strokes:
        """All crests, none taken yet."""
        return cls(found, ink, np.ones(len(found), bool))

    def traces(self) -> list[Trace]:
        """All lines and rims, the longest lines first."""
        vote, traces = Vote(self.found), list[Trace]()
        for _ in range(MOST):
            peak = vote.peak()
            if peak is None:
                break
            crests = row(self.found, np.flatnonzero(self.left), *peak)
            if crests is None:
                vote.forget()
                continue
            for run in self._runs(crests):
                trace, which = self._taken(crests, run)
                if trace:
                    traces.append(trace)
                    self.left[which] = False
                    vote.remove(which)
            vote.forget()
        return traces

    def _runs(self, crests: Row) -> list[Run]:
        """The stretches of a row that were drawn."""
        found = runs(crests.along, lambda along: self.ink.crossed(crests.spots(along)))
        return [run for run in found
                if run.long >= LEAST and run.seen >= SEEN and crests.part(run).sum() >= FEW]

    def _taken(self, crests: Row, run: Run) -> tuple[Trace | None, NDArray[np.intp]]:
        """What a run belongs to, a line or a rim, and the crests that go with it."""
        own = crests.which[crests.part(run)]
        own = own[self.left[own]]
        if len(own) < FEW:
            return None, own
        rim = grown(self.found, np.flatnonzero(self.left), own, self.ink) if bends(crests, run) else None
        if rim is None or rim.run.long < LONGER * run.long:
            return line(crests, run), own  # a hand that wobbles bends lines, too, but no further than they go
        return rim.trace(), rim.which
