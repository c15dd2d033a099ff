"""Scales: how much of the scene one millimetre of paper stands for, in round values.

Every plan is constructed in lengths of the mechanism: a velocity is kappa lengths long for each unit, an acceleration
kappa squared, a force phi. On paper each plan has so many lengths per mm that the scales of all that is drawn on it are
round; what it is larger than the mechanism plan is its multiple.

Round are the steps 1, 2, 2.5, 4 and 5 of GOST 2.302 in each power of ten; ISO 5455 has 1, 2 and 5 of them.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from graphplan.mechanism.model import Number
from graphplan.mechanism.units import METRES
from graphplan.phrases import Phrase, Said, arrange, digits, join, phrase, unit
from graphplan.sheet.plates.pens import ACCELERATION_PARTS, FORCES
from graphplan.sheet.tolerances import SCALE_TOL

VELOCITIES, ACCELERATIONS = frozenset({"velocity", "relative"}), frozenset({"acceleration", *ACCELERATION_PARTS})
SPEED_SCALE = phrase("k_v = {0} {1} per mm"), phrase("mu_v = {0} mm per {1}")
ACCELERATION_SCALE = phrase("k_a = {0} {1} per mm"), phrase("mu_a = {0} mm per {1}")
SERIES = Fraction(1), Fraction(2), Fraction(5, 2), Fraction(4), Fraction(5)


def round_up(least: float, lengths: Sequence[Number] = (1,)) -> Fraction:
    """The smallest lengths per mm, not below `least`, at which all kinds of quantity of so many lengths a unit have
    scales of the series; or the first alone, if the given lengths do not allow this for all. Without lengths any scale
    is valid."""
    return _rounded_up(least, tuple(lengths))


@lru_cache(maxsize=4096)  # panels are divided at the same scales again and again
def _rounded_up(least: float, lengths: tuple[Number, ...]) -> Fraction:
    if not lengths and 0 < least < math.inf:
        return Fraction(least)
    first = Fraction(lengths[0] if lengths else 1)
    if not least > 0 or math.isinf(least):
        return first
    power, limit = math.floor(math.log10(least / first)), least * (1 - SCALE_TOL)
    scales = [scale for n in range(power - 1, power + 3) for scale in _decade(lengths, n) if scale[2] >= limit]
    return next((scale for scale, is_round, _ in scales if is_round), scales[0][0])


@lru_cache(maxsize=4096)
def _decade(lengths: tuple[Number, ...], power: int) -> list[tuple[Fraction, bool, float]]:
    """The scales of one power of ten that are round for the first length, each with whether it is so for all, and as
    a float, which is compared in a tenth of the time."""
    scales = [Fraction(lengths[0]) * step * Fraction(10) ** power for step in SERIES]
    return [(scale, all(is_round(scale / Fraction(length)) for length in lengths), float(scale)) for scale in scales]


def is_round(scale: Fraction) -> bool:
    """Whether a scale is of the series."""
    return scale / Fraction(10) ** math.floor(math.log10(scale) + SCALE_TOL) in SERIES


def lengths_of(kinds: Collection[str], kappa: Number, phi: Number) -> list[Number]:
    """Lengths per unit of each quantity that has vectors of these kinds."""
    lengths_by_kind = (VELOCITIES, kappa), (ACCELERATIONS, kappa * kappa), (FORCES, phi)
    return [length for vectors, length in lengths_by_kind if not vectors.isdisjoint(kinds)]


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

    def lengths_per_mm(self, panel: str) -> float:
        """Scene lengths for one mm on a panel."""
        return self.k_s / float(self.multiples.get(panel, 1))

    def speed(self, panel: str) -> float:
        """Speed for one mm of a vector on a panel."""
        return self.lengths_per_mm(panel) / self.kappa

    def acceleration(self, panel: str) -> float:
        """Acceleration for one mm of a vector on a panel."""
        return self.lengths_per_mm(panel) / self.kappa**2

    def force(self, panel: str) -> float:
        """Force for one mm of a vector on a panel."""
        return self.lengths_per_mm(panel) / self.phi

    def scale_texts(self, panel: str, kinds: set[str]) -> list[Said]:
        """The scales of a panel with their units; `kinds` are the kinds of vector drawn on it."""
        texts = [] if panel in self.multiples else [scale_words("s", self.k_s, self.length, self.convention)]
        if kinds & VELOCITIES:
            texts.append(self._moving(SPEED_SCALE, self.speed(panel), f"{self.length}/s"))
        if kinds & ACCELERATIONS:
            texts.append(self._moving(ACCELERATION_SCALE, self.acceleration(panel), f"{self.length}/s²"))
        return [*texts, scale_words("F", self.force(panel), self.unit, self.convention)] if kinds & FORCES else texts

    def _moving(self, words: tuple[Phrase, Phrase], scale: float, of: str) -> Said:
        """The scale of a rate, by the words for each convention."""
        per_unit = self.convention == "drawn"
        return words[per_unit](digits(1 / scale if per_unit else scale), unit(of))

    @property
    def ratio(self) -> Said:
        """The scale of the mechanism plan as a title block has it, such as 1 : 5."""
        text = ratio(self.k_s, self.length)
        return join((text, *self.scale_texts("", set())), "; ") if self.convention == "drawn" else text


def ratio(k_s: float, length: str) -> Said:
    """A drawing scale as a ratio of lengths on paper to those of the scene, such as 1 : 5."""
    reduction = k_s * 1000 * float(METRES[length])
    return arrange("1 : {0}", digits(reduction)) if reduction >= 1 else arrange("{0} : 1", digits(1 / reduction))


def scale_words(letter: str, k: float, measure: str, convention: str = "real") -> Said:
    """A scale in words, such as k_M = 10 N m/mm, or in the convention `drawn` as mm per quantity."""
    if convention == "drawn":
        of = f"mm/({measure})" if " " in measure or "·" in measure else f"mm/{measure}" if measure else "mm"
        return arrange("mu_{0} = {1} {2}", letter, digits(1 / k), unit(of))
    apart = "k_{0} = {1}{2}" if measure == "°" else "k_{0} = {1} {2}"
    return arrange(apart, letter, digits(k), unit(f"{measure or 1}/mm"))
