"""How good a task a sheet makes: flaws, for which a variant is drawn anew, though the scene itself is a task.

What the scene's own sheet has no better is no flaw of a variant, as far as it is not much worse there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from graphplan.accuracy.drafted import Drafted
from graphplan.errors import ConstructionError, GraphplanError, Refused, SceneError, SingularPose
from graphplan.marking.classroom import measures
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import parse
from graphplan.sheet.layout.composition import Composition

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
    degrees; the result that a careful hand draws worst, and by how much of the largest it is off; defects of a
    mechanism that is found."""

    sizes: Mapping[str, DrawnSize]
    outside: tuple[int, ...]
    poor: float
    legible: bool
    flattest: float
    worst: str = ""
    error: float = 0.0
    defects: tuple[str, ...] = ()

    @classmethod
    def of_sheet(cls, drafted: Drafted) -> Quality:
        """The quality of a sheet."""
        composition, cost = drafted.composition, drafted.cost
        sizes = dict(sorted(drawn_sizes(composition), key=lambda named: -named[1].mm / named[1].least))
        return cls(sizes, cost.off_sheet, composition.poor, composition.legible,
                   cost.flattest.degrees if cost.flattest else measures.SQUARE_DEGREES,
                   drafted.worst.label if drafted.worst else "", drafted.error)

    @property
    def short(self) -> dict[str, DrawnSize]:
        """What is smaller than it should be, by name."""
        return {name: size for name, size in self.sizes.items() if size.mm < size.least}

    def find_flaw(self, own: Quality) -> Flaw | None:
        """What makes it worse than a class's sheet may be; `own` is the quality of the scene's own sheet."""
        if defects := [defect for defect in self.defects if defect not in own.defects]:
            return Flaw("its mechanism has a defect", f"it has a defect: {', '.join(defects)}")
        if self.flattest < min(measures.MIN_CROSSING_DEGREES, own.flattest / measures.MAX_WORSE_RATIO):
            return Flaw("it is nearly singular", f"lines cross at {self.flattest:.0f}°")
        for name, size in self.short.items():
            if name not in own.short or size.mm < own.short[name].mm / measures.MAX_WORSE_RATIO:
                return Flaw("vectors are too short", f"{name} has {size.mm:.2f} mm, less than {size.least:g}")
        if len(self.outside) > len(own.outside):
            return Flaw("steps are outside the paper", f"step {self.outside[0]} is outside the paper")
        if self.error > max(measures.MAX_ERROR_SHARE, measures.MAX_WORSE_RATIO * own.error):
            off = f"by {100 * self.error:.0f} %" if math.isfinite(self.error) else "without bound"
            return Flaw("a careful hand draws it too far off", f"a careful hand is off {off} in {self.worst}")
        most_poor = max(measures.MAX_POOR_SHARE, measures.MAX_WORSE_RATIO * own.poor)
        if (own.legible and not self.legible) or self.poor > most_poor:
            return Flaw("the sheet is crowded", f"the sheet is crowded, {100 * self.poor:.0f} % of its letters have no "
                        "good place")
        return None


def drawn_sizes(composition: Composition) -> Iterator[tuple[str, DrawnSize]]:
    """All vectors of a sheet with their sizes there, asked for or not, and what each line through two points has for
    its direction."""
    plans, drawing = composition.plans, composition.plans.drawing
    program, places = drawing.drawn, plans.plan_of_step
    results = {tuple(program.wanted[place] for place in reading.marks): f"{reading.kind} of {reading.of}"
               for reading in drawing.readings if not reading.kind.single and len(reading.marks) == 2}
    vectors: dict[tuple[int, ...], str] = {(vector.start, vector.end): f"{vector.label} in {vector.panel}"
                                           for vector in drawing.arrows if vector.label}
    for step in program.steps:
        if step.op.claim_operands("runs"):
            vectors.setdefault(step.args[:2], "the line " + " ".join(map(str, map(program.text, step.args[:2]))))
        elif step.root is not None and step.name:
            vectors.setdefault((step.root, step.index), f"{step.name} in {places[step.index]}")
    for (start, end), name in (vectors | results).items():
        if places[start] == places[end]:
            length = math.dist(plans.spot(start), plans.spot(end)) * composition.views[places[end]].scale
            yield name, DrawnSize(length, measures.MIN_ASKED_MM if (start, end) in results else measures.MIN_DRAWN_MM)


def assess(text: str, name: str, draw: Draw, own: Quality) -> Flaw | Mapping[str, Fraction]:
    """Why a scene is no task for the class whose own scene has a sheet of this quality; how large its other plans are
    where it is one."""
    try:
        sheet = draw(parse(text, name))
        return Quality.of_sheet(sheet).find_flaw(own) or sheet.composition.scales.multiples
    except SceneError as error:
        return Flaw("it cannot be assembled", f"{error.faults[0].where}: {error.faults[0].what}")
    except (SingularPose, ConstructionError) as error:
        return Flaw("it is singular", f"{error}".partition(";")[0])
    except Refused as error:
        return Flaw("it does not fit the scales of the class", f"{error.what}: {error.why}")
    except GraphplanError as error:
        return Flaw("it cannot be drawn", f"{error}")
