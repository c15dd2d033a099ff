"""What drawing a construction costs: movements, changes of instrument, how its curves cross, what leaves the paper."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from graphplan.kernel.expand import crossing
from graphplan.kernel.kinds import DIVIDERS, POINT, SET_SQUARES
from graphplan.kernel.lemoine import Counts, counts
from graphplan.methods.construction import Construction
from graphplan.phrases import Said, said
from graphplan.sheet.layout.composition import Composition


@dataclass(frozen=True)
class Crossing:
    """Where two curves meet: the step that marks it, and the sine of the angle between them."""

    number: int
    mark: str
    sine: float

    @property
    def degrees(self) -> float:
        """The angle between the curves."""
        return math.degrees(math.asin(min(1.0, self.sine)))


@dataclass(frozen=True)
class Cost:
    """The counts of a drawing, its steps, its crossings, and the steps whose marks lie outside the paper of their
    plans."""

    counts: Counts
    steps: int
    crossings: tuple[Crossing, ...]
    off_sheet: tuple[int, ...]

    @property
    def flattest(self) -> Crossing | None:
        """The crossing with the smallest angle."""
        return min(self.crossings, key=lambda crossing: crossing.sine, default=None)

    @property
    def data(self) -> dict[str, Any]:
        """All of it, as data; simplicity and exactitude, which know no set squares, of a strict drawing alone."""
        found = self.counts
        return {
            "said": found.told, "steps": self.steps, "operations": found.operations, "lines": found.R2,
            "arcs": found.C3, "scale": found.scale, "set squares": found.others.get(SET_SQUARES, 0),
            "dividers": found.others.get(DIVIDERS, 0), "instrument changes": found.changes,
            "simplicity": found.simplicity if found.strict else None,
            "exactitude": found.exactitude if found.strict else None,
            "crossings": [{"step": c.number, "mark": c.mark, "degrees": c.degrees} for c in self.crossings],
            "off the sheet": list(self.off_sheet),
        }

    def lines(self) -> list[Said]:
        """The cost in words, a line each."""
        told = [said("Changes of instrument: {0}.", self.counts.changes)]
        if self.flattest:
            angle = f"{self.flattest.degrees:.0f}"
            told.append(said("Flattest crossing: {0}°, step {1}.", angle, self.flattest.number))
        if self.off_sheet:
            told.append(said("Outside the paper of their plans: steps {0}.", ", ".join(map(str, self.off_sheet))))
        return told


def cost(drawing: Construction, composition: Composition) -> Cost:
    """What drawing a construction costs on its sheet."""
    drawn = drawing.drawn
    crossings = [Crossing(drawn.number(step.index), drawn.text(step.index), crossing(step, drawing.values))
                 for step in drawn.steps if step.op.crossing]
    return Cost(counts(drawn), len(drawn) - drawn.givens, tuple(crossings), _off_sheet(composition))


def _off_sheet(composition: Composition) -> tuple[int, ...]:
    """The steps whose points lie outside the paper of their plans."""
    points = (drawn for drawn in composition.plates.steps if drawn.kind == POINT)
    return tuple(point.number for point in points if not point.view.rect.holds(point.at))
