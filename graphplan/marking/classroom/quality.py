"""How good a task a sheet makes: flaws, for which a variant is drawn anew, though the scene itself is a task.

What the scene's own sheet has no better is no flaw of a variant, as far as it is not much worse there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from graphplan.accuracy.drafted import Drafted
from graphplan.errors import ConstructionError, GraphplanError, Refused, SceneError, SingularPose
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse
from graphplan.methods.kinds import KINDS
from graphplan.sheet.layout.composition import Composition

MIN_CROSSING_DEGREES = 12.0  # degrees: two lines that cross flatter have no clear point
MAX_ERROR_SHARE = 0.15  # of the largest of its kind: a result that a careful hand misses by more is none
MAX_POOR_SHARE = 0.15  # of the letters that have no good place, on paper of any size
MAX_WORSE_RATIO = 1.25  # times: so much worse than the scene itself a variant may be where that is no better
MIN_DRAWN_MM, MIN_ASKED_MM = 3.0, 8.0  # of a vector that is drawn, or gives a direction; of one that is asked for

Draw = Callable[[Scene], Drafted]  # a scene on its sheet, as the options say


class Flaw(NamedTuple):
    """What is wrong, as a kind that many variants share, and as it is with this one."""

    kind: str
    text: str


class DrawnSize(NamedTuple):
    """The mm of a vector, or between two points that give a direction, and the least that it should have."""

    mm: float
    least: float


@dataclass(frozen=True)
class Quality:
    """What is measured of a sheet: the shortest of its vectors, and of what its directions are taken from, by name;
    steps outside the paper; the part of letters without a good place; whether it is legible; the flattest crossing in
    degrees; the result that a careful hand draws worst, and by how much of the largest it is off."""

    sizes: Mapping[str, DrawnSize]
    outside: tuple[int, ...]
    poor: float
    legible: bool
    flattest: float
    worst: str
    error: float

    @classmethod
    def of_sheet(cls, drafted: Drafted) -> Quality:
        """The quality of a sheet."""
        composition, cost = drafted.composition, drafted.cost
        sizes = dict(sorted(drawn_sizes(composition), key=lambda named: -named[1].mm / named[1].least))
        return cls(sizes, cost.off_sheet, composition.poor, composition.legible,
                   cost.flattest.degrees if cost.flattest else 90.0, drafted.worst.label if drafted.worst else "",
                   drafted.error)

    @property
    def short(self) -> dict[str, DrawnSize]:
        """What is smaller than it should be, by name."""
        return {name: size for name, size in self.sizes.items() if size.mm < size.least}

    def find_flaw(self, own: Quality) -> Flaw | None:
        """What makes it worse than a class's sheet may be; `own` is the quality of the scene's own sheet."""
        if self.flattest < min(MIN_CROSSING_DEGREES, own.flattest / MAX_WORSE_RATIO):
            return Flaw("it is nearly singular", f"lines cross at {self.flattest:.0f}°")
        for name, size in self.short.items():
            if name not in own.short or size.mm < own.short[name].mm / MAX_WORSE_RATIO:
                return Flaw("vectors are too short", f"{name} has {size.mm:.2f} mm, less than {size.least:g}")
        if len(self.outside) > len(own.outside):
            return Flaw("steps are outside the paper", f"step {self.outside[0]} is outside the paper")
        if self.error > max(MAX_ERROR_SHARE, MAX_WORSE_RATIO * own.error):
            off = f"by {100 * self.error:.0f} %" if math.isfinite(self.error) else "without bound"
            return Flaw("a careful hand draws it too far off", f"a careful hand is off {off} in {self.worst}")
        if (own.legible and not self.legible) or self.poor > max(MAX_POOR_SHARE, MAX_WORSE_RATIO * own.poor):
            return Flaw("the sheet is crowded", f"the sheet is crowded, {100 * self.poor:.0f} % of its letters have no "
                        "good place")
        return None


def drawn_sizes(composition: Composition) -> Iterator[tuple[str, DrawnSize]]:
    """All vectors of a sheet with their sizes there, asked for or not, and what each line through two points has for
    its direction."""
    plans, drawing = composition.plans, composition.plans.drawing
    program, places = drawing.drawn, plans.plan_of_step

    def size(start: int, end: int, least: float) -> DrawnSize:
        scale = composition.views[places[end]].scale
        return DrawnSize(math.dist(plans.spot(start), plans.spot(end)) * scale, least)

    asked = {tuple(program.wanted[place] for place in reading.marks): f"{reading.kind} of {reading.of}"
             for reading in drawing.readings if not KINDS[reading.kind].single and len(reading.marks) == 2}
    for (start, end), name in asked.items():
        yield name, size(start, end, MIN_ASKED_MM)
    for vector in drawing.arrows:
        if vector.label and (vector.start, vector.end) not in asked:
            yield f"{vector.label} in {vector.panel}", size(vector.start, vector.end, MIN_DRAWN_MM)
    for step in program.steps:
        if step.op.claim_operands("runs"):
            start, end = step.args[:2]
            if places[start] == places[end]:
                yield f"the line {program.text(start)} {program.text(end)}", size(start, end, MIN_DRAWN_MM)
        elif step.root is not None and step.name:
            yield f"{step.name} in {places[step.index]}", size(step.root, step.index, MIN_DRAWN_MM)


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


def find_flaw(text: str, name: str, draw: Draw, own: Quality) -> Flaw | None:
    """Why a scene is no task for the class whose own scene has a sheet of this quality; None where it is one."""
    sheet = sheet_of(text, name, draw)
    return sheet if isinstance(sheet, Flaw) else Quality.of_sheet(sheet).find_flaw(own)
