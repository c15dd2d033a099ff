"""How a scene wishes its sheet, as frozen plain data."""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction


@dataclass(frozen=True)
class Presentation:
    """How a scene wishes its sheet: texts that are empty, and scales that are None, are left to graphplan.

    `k_s`, `k_v`, `k_a` and `k_F` are what a millimetre of paper stands for, in the scene's units; `multiples` are by
    how much other plans are larger than the mechanism's; by `convention` scales are told as real per drawn, or as
    drawn per real. `student` and `variant` are whose task it is in a class, and its number.
    """

    paper: str = ""
    frame: str = "iso"
    owner: str = ""
    number: str = ""
    date: str = ""
    drawn_by: str = "graphplan"
    approved_by: str = ""
    language: str = "en"
    k_s: Fraction | None = None
    k_v: Fraction | None = None
    k_a: Fraction | None = None
    k_F: Fraction | None = None
    multiples: dict[str, Fraction] = field(default_factory=dict)
    convention: str = "real"
    curves: tuple[str, ...] = ()
    centrodes: tuple[str, ...] = ()
    cubics: tuple[str, ...] = ()
    positions: int = 0
    student: str = ""
    variant: str = ""

    @property
    def kappa(self) -> Fraction | None:
        """How long a speed of one is drawn, where two of the scales of lengths, velocities and accelerations tie it."""
        if self.k_s and self.k_v:
            return self.k_s / self.k_v
        return self.k_v / self.k_a if self.k_v and self.k_a else None

    @property
    def phi(self) -> Fraction | None:
        """How long a force of one is drawn, where the scales of lengths and forces tie it."""
        return self.k_s / self.k_F if self.k_s and self.k_F else None
