"""What was drawn, taken apart: the line with the most crests first, then of what is left, again and again.

Crests that bend are carried on as a circle's rim; what is neither straight nor round, such as letters, is left.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphplan.marking.scans.lines import CrestRow, bends, line, row
from graphplan.marking.scans.pencil_pixels import Ink
from graphplan.marking.scans.ridges import Ridges
from graphplan.marking.scans.rims import grown
from graphplan.marking.scans.runs import Stretch, stretches
from graphplan.marking.scans.vote import LEAST, Vote
from graphplan.marking.traces import Trace

SEEN, FEW, MOST = 0.55, 8, 600  # the share of a line that is seen, its fewest crests, the most lines tried
LONGER = 1.25  # how much longer a rim is than the piece of it that looked straight


@dataclass
class StrokeSearch:
    """The lines and rims among crests, as they are taken away; `left` says which are not."""

    found: Ridges
    ink: Ink
    left: NDArray[np.bool_]

    @classmethod
    def of(cls, found: Ridges, ink: Ink) -> StrokeSearch:
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
            for stretch in self._runs(crests):
                trace, which = self._taken(crests, stretch)
                if trace:
                    traces.append(trace)
                    self.left[which] = False
                    vote.remove(which)
            vote.forget()
        return traces

    def _runs(self, crests: CrestRow) -> list[Stretch]:
        """The stretches of a row that were drawn."""
        found = stretches(crests.along, lambda along: self.ink.crossed(crests.spots(along)))
        return [stretch for stretch in found
                if stretch.long >= LEAST and stretch.seen >= SEEN and crests.part(stretch).sum() >= FEW]

    def _taken(self, crests: CrestRow, stretch: Stretch) -> tuple[Trace | None, NDArray[np.intp]]:
        """What a run belongs to, a line or a rim, and the crests that go with it."""
        own = crests.which[crests.part(stretch)]
        own = own[self.left[own]]
        if len(own) < FEW:
            return None, own
        rim = grown(self.found, np.flatnonzero(self.left), own, self.ink) if bends(crests, stretch) else None
        if rim is None or rim.stretch.long < LONGER * stretch.long:
            return line(crests, stretch), own  # a hand that wobbles bends lines, too, but no further than they go
        return rim.trace(), rim.which
