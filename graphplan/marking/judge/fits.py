"""Where a plan lies on a student's sheet: the similarity that most of its marks agree on, and how sure it is."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

from graphplan.marking.traces import PlanFrame

Pair = tuple[complex, complex]  # where a mark is on its plan, and where on the sheet
SIGMAS = 4.0  # how many standard deviations a mark may lie off a frame that holds it


@dataclass(frozen=True)
class Fit:
    """A frame with its standard deviations: `turn` of its scale and direction, as a part of one, about `centre` on
    the plan; `shift` of its place, in mm. `tied` names the plan whose scale and direction it shares."""

    frame: PlanFrame
    turn: float = 0.0
    shift: float = 0.0
    centre: complex = 0j
    tied: str = ""


def best(pairs: Sequence[Pair], sigma: float) -> Fit | None:
    """The frame on which most marks agree, each `sigma` mm off in x and in y; None where no two lie apart.

    Every two marks propose one; of those that hold equally many the one that misses them least is taken, and fitted
    to all that it holds. The marks that a frame was laid through shake it, the more the further off a mark is.
    """
    most, least, held = 1, math.inf, list[Pair]()
    for one, two in combinations(pairs, 2):
        if one[0] != two[0] and one[1] != two[1]:
            unit = (two[1] - one[1]) / (two[0] - one[0])
            off = [abs(sheet - one[1] - unit * (plan - one[0])) for plan, sheet in pairs]
            kept = [place for place, far in enumerate(off) if far <= SIGMAS * 2.0 * sigma]
            missed = sum(off[place] ** 2 for place in kept)
            if len(kept) > most or (len(kept) == most > 1 and missed < least):
                most, least, held = len(kept), missed, [pairs[place] for place in kept]
    return fitted(held, sigma) if held else None


def fitted(pairs: Sequence[Pair], sigma: float) -> Fit | None:
    """The frame of least squares."""
    here = sum(plan for plan, _ in pairs) / len(pairs)
    there = sum(sheet for _, sheet in pairs) / len(pairs)
    spread = sum(abs(plan - here) ** 2 for plan, _ in pairs)
    unit = sum((plan - here).conjugate() * (sheet - there) for plan, sheet in pairs) / spread if spread else 0j
    if not unit or not cmath.isfinite(unit):
        return None
    turn = sigma / abs(unit) / math.sqrt(spread)
    return Fit(PlanFrame(there - unit * here, unit), turn, sigma / math.sqrt(len(pairs)), here)
