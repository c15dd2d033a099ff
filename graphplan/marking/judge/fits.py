"""Where a plan lies on a student's sheet: the similarity that most of its marks agree on, and how sure it is."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
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


def through(one: Pair, two: Pair) -> PlanFrame | None:
    """The frame in which two marks lie where they do; None where they do not tell."""
    apart = two[0] - one[0]
    if not apart or two[1] == one[1]:
        return None
    unit = (two[1] - one[1]) / apart
    return PlanFrame(one[1] - unit * one[0], unit)


def best(pairs: Sequence[Pair], sigma: float) -> Fit | None:
    """The frame on which most marks agree, each `sigma` mm off in x and in y; None where no two lie apart.

    Every two marks propose one; of those that hold equally many the one that misses them least is taken, and fitted
    to all that it holds.
    """
    frames = (frame for one, two in combinations(pairs, 2) if (frame := through(one, two)))
    held = [(kept, frame) for frame in frames if len(kept := list(_held(pairs, frame, sigma))) >= 2]
    if not held:
        return None
    kept, _ = max(held, key=lambda found: (len(found[0]), -_missed(found[0], found[1])))
    return fitted(kept, sigma)


def _held(pairs: Sequence[Pair], frame: PlanFrame, sigma: float) -> Iterator[Pair]:
    """The marks that a frame holds: those it was laid through shake it, the more the further off a mark is."""
    for plan, sheet in pairs:
        if abs(sheet - frame.onto(plan)) <= SIGMAS * 2.0 * sigma:
            yield plan, sheet


def _missed(pairs: Sequence[Pair], frame: PlanFrame) -> float:
    return sum(abs(sheet - frame.onto(plan)) ** 2 for plan, sheet in pairs)


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
