"""Expected drawing errors as the sheet tells them: standard deviations beside the results, and by what model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from graphplan.sheet.layout.scales import digits


@dataclass(frozen=True)
class Deviation:
    """How far off a result is drawn: in its own unit, and in mm of paper where it is one drawn vector."""

    value: float
    mm: float | None = None

    def __str__(self) -> str:
        return digits(self.value, 2) + (f" ({digits(self.mm, 2)})" if self.mm is not None else "")


@dataclass(frozen=True)
class Deviations:
    """The deviation of every result by kind and name, and what is said of the drawing model and the worst step."""

    results: Mapping[str, Mapping[str, Deviation]] = field(default_factory=dict)
    told: str = ""

    def of(self, *kinds: str) -> dict[str, Deviation]:
        """The deviations of some kinds, by name."""
        return {name: deviation for kind in kinds for name, deviation in self.results.get(kind, {}).items()}
