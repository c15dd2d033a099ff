"""Scales: how much of the scene one millimetre of paper stands for, in round values.

The mechanism plan is drawn at k_s; the construction's kappa then ties the velocities to it, k_v = k_s/kappa, and the
accelerations, k_a = k_s/kappa^2, as every plan is constructed in lengths of the mechanism plan; forces are phi lengths
long for each unit, k_F = k_s/phi. A plan that would be too small or too large is drawn at a round multiple of the
scale, and says so.

Round are the steps 1, 2, 2.5, 4 and 5 of GOST 2.302 in each power of ten; ISO 5455 has 1, 2 and 5 of them. Multiples
are 1, 2, 3, 5 and powers of ten, as the sources draw vectors two or three times as large.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

from graphplan.mechanism.units import METRES
from graphplan.phrases import Phrase, Said, arranged, digits, joined, phrase, unit
from graphplan.sheet.plates.pens import FORCES

VELOCITIES, ACCELERATIONS = frozenset({"velocity", "relative"}), frozenset({"acceleration", "normal"})
SPEED = phrase("k_v = {0} {1} per mm"), phrase("mu_v = {0} mm per {1}")
SHARPNESS = phrase("k_a = {0} {1} per mm"), phrase("mu_a = {0} mm per {1}")
SERIES = (1.0, 2.0, 2.5, 4.0, 5.0)
SIMPLE = (1, 2, 3, 5)


def round_up(least: float) -> float:
    """The smallest scale of the series 1, 2, 2.5, 4, 5 x 10^n that is not below `least`."""
    if not least > 0 or math.isinf(least):
        return 1.0
    power = math.floor(math.log10(least))
    candidates = (float(f"{step}e{n}") for n in (power - 1, power, power + 1) for step in SERIES)
    return min(scale for scale in candidates if scale >= least * (1 - 1e-9))


def multiple_below(most: float) -> Fraction:
    """The largest of ..., 1/5, 1/3, 1/2, 1, 2, 3, 5, 10, 20, ... that is not above `most`."""
    most *= 1 + 1e-9
    if most >= 1:
        whole = 10 ** math.floor(math.log10(most))
        return Fraction(max(m * whole for m in SIMPLE if m * whole <= most))
    whole = 10 ** math.floor(math.log10(1 / most))
    return Fraction(1, min(m * whole for m in (*SIMPLE, 10) if m * whole * most >= 1))


def times(multiple: Fraction) -> str:
    """A multiple as it is said: x2, x1/2."""
    return f"×{multiple}"


@dataclass(frozen=True)
class Scales:
    """The scales of one sheet: `k_s` in lengths per mm, the multiples of the other plans, the construction's kappa and
    phi, the units of length and force, and whether scales are told as `real` per drawn or as `drawn` per real."""

    k_s: float
    kappa: float
    length: str
    multiples: dict[str, Fraction]
    phi: float = 1.0
    unit: str = "N"
    convention: str = "real"

    def of(self, panel: str) -> float:
        """Scene lengths for one mm on a panel."""
        return self.k_s / float(self.multiples.get(panel, 1))

    def speed(self, panel: str) -> float:
        """Speed for one mm of a vector on a panel."""
        return self.of(panel) / self.kappa

    def acceleration(self, panel: str) -> float:
        """Acceleration for one mm of a vector on a panel."""
        return self.of(panel) / self.kappa**2

    def force(self, panel: str) -> float:
        """Force for one mm of a vector on a panel."""
        return self.of(panel) / self.phi

    def said(self, panel: str, kinds: set[str]) -> list[Said]:
        """The scales of a panel with their units; `kinds` are the kinds of vector drawn on it."""
        told = [] if panel in self.multiples else [self._static("s", self.k_s, self.length)]
        if kinds & VELOCITIES:
            told.append(self._moving(SPEED, self.speed(panel), f"{self.length}/s"))
        if kinds & ACCELERATIONS:
            told.append(self._moving(SHARPNESS, self.acceleration(panel), f"{self.length}/s²"))
        return [*told, self._static("F", self.force(panel), self.unit)] if kinds & FORCES else told

    def _static(self, letter: str, scale: float, of: str) -> Said:
        """What a millimetre stands for, or how many stand for one."""
        if self.convention == "drawn":
            return joined((f"mu_{letter} =", digits(1 / scale), unit(f"mm/{of}")), " ")
        return joined((f"k_{letter} =", digits(scale), unit(f"{of}/mm")), " ")

    def _moving(self, words: tuple[Phrase, Phrase], scale: float, of: str) -> Said:
        """The same of a rate, by the words for the one and for the other."""
        drawn = self.convention == "drawn"
        return words[drawn](digits(1 / scale if drawn else scale), unit(of))

    @property
    def ratio(self) -> Said:
        """The scale of the mechanism plan as a title block has it, such as 1 : 5."""
        told = ratio(self.k_s, self.length)
        return joined((told, *self.said("", set())), "; ") if self.convention == "drawn" else told


def ratio(k_s: float, length: str) -> Said:
    """A drawing scale as a ratio of lengths on paper to those of the scene, such as 1 : 5."""
    size = k_s * 1000 * float(METRES[length])
    return arranged("1 : {0}", digits(size)) if size >= 1 else arranged("{0} : 1", digits(1 / size))
