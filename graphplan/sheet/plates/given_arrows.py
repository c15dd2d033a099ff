"""What drives and loads a mechanism, drawn at its points as a task shows it: arrows that are all alike, each with its
letter and its value, as nothing is to scale before it is constructed.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from graphplan.mechanism.model import FRAME, Drive, Loads, Pair
from graphplan.mechanism.order import named_forces, named_moments
from graphplan.phrases import digits, joined, unit
from graphplan.sheet.lettering.label_candidates import Wish
from graphplan.sheet.lettering.lettering import Runs, name_runs, sentence_runs
from graphplan.sheet.plates import clip, pens, symbols
from graphplan.sheet.plates.display import Arc, Arrow, Item, Rect, Spot
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.symbols import Vector, off
from graphplan.words.tongue import Tongue

LAYER = "drive"
LENGTHS = 15.0, 12.0, 9.0  # mm: of an arrow, the longest that stays on the panel
ASIDE = 4.0  # mm from a block to the arrow of its drive
ALONG = 1.0, 0.85, 0.7, 0.5  # where along an arrow its value may stand

Marked = tuple[list[Item], Wish]  # an arrow, and its value beside it


@dataclass(frozen=True)
class GivenArrows:
    """The arrows of a mechanism in its window."""

    mechanism: DrawnMechanism
    tongue: Tongue

    @property
    def rect(self) -> Rect:
        return self.mechanism.view.rect

    def __iter__(self) -> Iterator[Marked]:
        """Every arrow with its value: drives, given motions, forces, moments."""
        scene, length = self.mechanism.scene, self.mechanism.scene.units.length
        yield from map(self._drive, filter(_moves, scene.drives))
        for name, motion in scene.motions.items():
            for letter, value, pen, of in (("v", motion.velocity, pens.GIVEN["velocity"], f"{length}/s"),
                                           ("a", motion.acceleration, pens.GIVEN["acceleration"], f"{length}/s²")):
                if any(value):
                    yield self._arrow(name, value, pen, self._value(f"{letter}_{name}", math.hypot(*value), of))
        if scene.loads:
            yield from self._loads(scene.loads)

    def _loads(self, loads: Loads) -> Iterator[Marked]:
        units, load = self.mechanism.scene.units, pens.VECTORS["load"]
        for letter, force in named_forces(loads).items():
            if any(force.value):
                value = self._value(letter, math.hypot(*force.value), units.force)
                yield self._arrow(force.at, force.value, load, value)
        for letter, moment in named_moments(loads).items():
            if moment.value:
                value = self._value(letter, abs(float(moment.value)), f"{units.force}·m")
                yield self._turn(self.mechanism.middle(moment.on), math.copysign(1.0, moment.value), value)

    def _value(self, letter: str, value: float, of: str) -> Runs:
        """A letter with its value."""
        told = joined(("=", digits(float(value)), unit(of)), " ")
        return (*name_runs(letter), *sentence_runs(f" {self.tongue(told)}"))

    def _arrow(self, name: str, value: Pair, pen: Pen, told: Runs) -> Marked:
        """A vector from the point where it acts, or to it where only that way it stays on the panel."""
        along, at = symbols.unit((0.0, 0.0), (float(value[0]), float(value[1]))), self.mechanism.spots[name]
        ends = [(off(at, along, -long * back), off(at, along, long * (1 - back)))
                for back in (0, 1) for long in LENGTHS]
        start, end = next((pair for pair in ends if all(map(self.rect.holds, pair))), ends[0])
        return self._straight(start, end, pen, told)

    def _straight(self, start: Spot, end: Spot, pen: Pen, told: Runs) -> Marked:
        arrow = Arrow(pen, LAYER, None, start, end, pens.HEADS["velocity"])
        spots = tuple(clip.between(start, end, t) for t in ALONG)
        return [arrow], Wish(told, spots, 0.8, pen=replace(pen, width=0.0), label=f"given {start}", free=True)

    def _turn(self, at: Spot, sign: float, told: Runs) -> Marked:
        """An arc about a spot."""
        return self._around(list(symbols.drive(at, (0.0, 1.0), sign)), told)

    def _around(self, items: list[Item], told: Runs) -> Marked:
        """What turns, with its value along the arc."""
        items = [replace(item, layer=LAYER) for item in items]
        arcs = [item for item in items if isinstance(item, Arc)]
        spots = tuple(spot for arc in arcs for spot in arc.spots(9.0))
        return items, Wish(told, spots, 0.8, label=f"given {spots[0]}", free=True)

    def _drive(self, drive: Drive) -> Marked:
        """The sense of turning, which the mechanism itself shows, or an arrow beside the sliding block."""
        scene, length = self.mechanism.scene, self.mechanism.scene.units.length
        if not drive.slides:
            told = self._value(rate_letters(drive)[0], abs(float(drive.rate)), "1/s")
            found = list(self.mechanism.driven(drive))
            if not found:
                return self._turn(self.mechanism.middle(drive.link), math.copysign(1.0, drive.rate), told)
            _, wish = self._around(found, told)
            return [], wish
        told = self._value(rate_letters(drive)[0], abs(float(drive.rate)), f"{length}/s")
        slide = next(slide for slide in scene.slides if (slide.link, slide.along) == drive.links)
        at, (x, y) = self.mechanism.seat(slide), self.mechanism.along(slide)
        way: Vector = (x, y) if drive.rate > 0 else (-x, -y)
        start, end = off(at, way, -LENGTHS[0] / 2, ASIDE), off(at, way, LENGTHS[0] / 2, ASIDE)
        return self._straight(start, end, pens.GIVEN["velocity"], told)


def _moves(drive: Drive) -> bool:
    return bool(drive.rate)


def rate_letters(drive: Drive) -> tuple[str, str]:
    """The letters of the velocity and the acceleration that a drive prescribes."""
    index = drive.link if drive.on == FRAME else f"{drive.link}{drive.on}"
    return ("v", "a") if drive.slides else (f"omega_{index}", f"alpha_{index}")
