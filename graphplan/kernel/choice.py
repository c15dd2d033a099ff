"""The choice of a form: how well each can be drawn in the pose, and why one of them is.

Crossings below one degree are for want of better; of the others, one on the sheet beats one off it, crossings above
15 degrees beat flatter ones, and then the fewest movements win.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from graphplan.kernel.kinds import Primitive
from graphplan.phrases import Said, joined, said

SHARP = math.sin(math.radians(15))
BLUNT = math.sin(math.radians(1))


@dataclass(frozen=True)
class Rating:
    """How well one form draws in this pose; of one that was left off, how well it could at best."""

    form: str
    movements: int
    on_sheet: bool = True
    sharpest: float = 1.0
    undrawn: int = 0
    left_off: bool = False

    @property
    def rank(self) -> tuple[int, bool, bool, bool, int]:
        return self.undrawn, self.sharpest < BLUNT, not self.on_sheet, self.sharpest < SHARP, self.movements

    @property
    def told(self) -> Said:
        """What speaks for it, in words."""
        angle = math.degrees(math.asin(min(1.0, self.sharpest)))
        place = said("on the sheet") if self.on_sheet else said("off the sheet")
        return said("{0} ({1} steps, {2}, flattest crossing {3}°)", said(self.form), self.movements, place,
                    f"{angle:.0f}")


@dataclass(frozen=True)
class Choice:
    """The form in which a compound is drawn, and the others that can be drawn in this pose, the next best first."""

    compound: Primitive
    best: Rating
    others: tuple[Rating, ...]

    def __str__(self) -> str:
        return f"{self.compound.name}: {self.best.form}"

    def reason(self, rivals: int | None = None) -> Said:
        """Why this form, beside all others or so many."""
        if not self.others:
            return said("{0}, the only form that can be drawn here", self.best.told)
        return said("{0} rather than {1}", self.best.told, joined(other.told for other in self.others[:rivals]))
