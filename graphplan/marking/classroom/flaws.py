"""Flaws: why a variant of a scene is no task for a class, though the scene itself is one."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from graphplan.accuracy.drafted import Drafted
from graphplan.errors import ConstructionError, GraphplanError, Refused, SceneError, SingularPose
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse

FLATTEST = 12.0  # degrees: two lines that cross flatter have no clear point
COARSEST = 0.15  # of the largest of its kind: a result that a careful hand misses by more is none
WORSE = 1.25  # times: so much worse than the scene itself a variant may be where that is no better

Draw = Callable[[Scene], Drafted]  # a scene on its sheet, as the options say


class Flaw(NamedTuple):
    """What is wrong, as a kind that many variants share, and as it is with this one."""

    kind: str
    told: str


@dataclass(frozen=True)
class Quality:
    """What is measured of a sheet: vectors too short, in mm; steps outside the paper; the part of letters without a
    good place; whether it is legible; the flattest crossing in degrees; the result that a careful hand draws worst, and
    by how much of the largest it is off."""

    short: tuple[float, ...]
    outside: tuple[int, ...]
    poor: float
    legible: bool
    flattest: float
    worst: str
    error: float

    @classmethod
    def of(cls, drafted: Drafted) -> Quality:
        """The quality of a sheet."""
        composition, cost = drafted.composition, drafted.cost
        return cls(tuple(composition.short), cost.off_sheet, composition.poor, composition.legible,
                   cost.flattest.degrees if cost.flattest else 90.0, drafted.worst.label if drafted.worst else "",
                   drafted.error)

    def flaw(self, own: Quality) -> Flaw | None:
        """What makes it worse than a class's sheet may be; `own` is the quality of the scene's own sheet."""
        if self.flattest < min(FLATTEST, own.flattest / WORSE):
            return Flaw("it is nearly singular", f"lines cross at {self.flattest:.0f}°")
        if len(self.short) > len(own.short):
            return Flaw("vectors are too short", f"vectors of {min(self.short):.1f} mm are too short")
        if len(self.outside) > len(own.outside):
            return Flaw("steps are outside the paper", f"step {self.outside[0]} is outside the paper")
        if self.error > max(COARSEST, WORSE * own.error):
            off = f"by {100 * self.error:.0f} %" if math.isfinite(self.error) else "without bound"
            return Flaw("a careful hand draws it too far off", f"a careful hand is off {off} in {self.worst}")
        if own.legible and not self.legible:
            return Flaw("the sheet is crowded", f"the sheet is crowded, {100 * self.poor:.0f} % of its letters have no "
                        "good place")
        return None


def sheet_of(text: str, name: str, draw: Draw) -> Drafted | Flaw:
    """The sheet of a scene, or why there is none."""
    try:
        return draw(parse(text, name))
    except SceneError as error:
        return Flaw("it cannot be assembled", f"{error.faults[0].where}: {error.faults[0].what}")
    except (SingularPose, ConstructionError) as error:
        return Flaw("it is singular", f"{error}".partition(";")[0])
    except Refused as error:
        return Flaw("it does not fit the scales of the class", f"{error.what}: {error.why}")
    except GraphplanError as error:
        return Flaw("it cannot be drawn", f"{error}")


def flaw(text: str, name: str, draw: Draw, own: Quality) -> Flaw | None:
    """Why a scene is no task for the class whose own scene has a sheet of this quality; None where it is one."""
    found = sheet_of(text, name, draw)
    return found if isinstance(found, Flaw) else Quality.of(found).flaw(own)
