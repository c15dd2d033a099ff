"""A linkage that was found: its type, how far its crank has turned at each given position, and what hinders it.

Four links OA, AB, BC and the ground OC, or B on a guide instead of BC. With psi, the angle of OA from the axis
(OC, or the guide's normal), the cosine of the transmission angle is p + q cos psi; the linkage closes where that is
between -1 and 1. So the ranges of OA and the least transmission angle are known in closed form.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import Any, TypeVar

from graphplan.synthesis.tolerances import CHANGE_TOL, SENSE_TOL

Drawn = TypeVar("Drawn")
BRANCH, CIRCUIT, ORDER = "branch", "circuit", "order"
TYPES = {"O A": "crank-rocker", "O C": "double-crank", "B C": "rocker-crank", "A B": "double-rocker"}  # by the shortest
CHANGE_POINT, TRIPLE_ROCKER, SLIDER_CRANK = "change point", "triple-rocker", "slider-crank"


@dataclass(frozen=True)
class FoundLinkage:
    """Linkage: A and B at each given position; O, and C or the direction of the guide on which B slides.

    `names` are what the results call O, A, B and C; `carried` are further points of AB at each position; `whole_turn`
    says that its transmission angle is asked for over the turn.
    """

    O: complex
    A: tuple[complex, ...]
    B: tuple[complex, ...]
    C: complex | None = None
    guide: complex = 0j
    names: tuple[str, ...] = ("O", "A", "B", "C")
    carried: Mapping[str, tuple[complex, ...]] = field(default_factory=dict)
    whole_turn: bool = False
    driven: int = 1  # the link that the scene drives: 1 or 3
    further: Mapping[str, Any] = field(default_factory=dict)

    @property
    def pivots(self) -> list[complex]:
        """O, and C where there is one."""
        return [self.O, *([] if self.C is None else [self.C])]

    @property
    def points(self) -> dict[str, complex]:
        """Points in the first position."""
        places = {"O": self.O, "A": self.A[0], "B": self.B[0]} | ({} if self.C is None else {"C": self.C})
        renamed = {self.names["OABC".index(name)]: place for name, place in places.items()}
        return renamed | {name: places[0] for name, places in self.carried.items()}

    @cached_property
    def sides(self) -> dict[str, float]:
        """The lengths of its links by the letters O, A, B, C; of a slider-crank its offset instead of BC and OC.
        """
        sides = {"O A": abs(self.A[0] - self.O), "A B": abs(self.B[0] - self.A[0])}
        if self.C is None:
            return sides
        return sides | {"B C": abs(self.C - self.B[0]), "O C": abs(self.C - self.O)}

    @property
    def lengths(self) -> dict[str, float]:
        """Lengths under the names of its points; of a slider-crank the offset too: the distance of the guide from O."""
        words = {letter: self.names["OABC".index(letter)] for letter in "OABC"[:len(self.names)]}
        named = {" ".join(words[letter] for letter in side.split()): size for side, size in self.sides.items()}
        return named if self.C is not None else named | {"offset": abs(self.offset)}

    @property
    def offset(self) -> float:
        """Distance of the guide from O to the left of its direction."""
        return ((self.B[0] - self.O) / self.guide).imag

    @property
    def grashof(self) -> float:
        """By how much the sum of the shortest and the longest link is less than that of the others, as a part of both.
        """
        if self.C is None:
            r, b, e = self.sides["O A"], self.sides["A B"], abs(self.offset)
            return (abs(b - r) - e) / (b + r + e)
        sizes = sorted(self.sides.values())
        return (sizes[1] + sizes[2] - sizes[0] - sizes[3]) / sum(sizes)

    @property
    def type(self) -> str:
        """Type after Grashof, driven at OA."""
        if self.C is None:
            return SLIDER_CRANK
        if abs(self.grashof) <= CHANGE_TOL:
            return CHANGE_POINT
        return TYPES[min(self.sides, key=lambda side: self.sides[side])] if self.grashof > 0 else TRIPLE_ROCKER

    # ---- the range of OA -------------------------------------------------------------------------------------------

    @property
    def axis(self) -> complex:
        """The direction from which psi counts: of OC, or the normal of the guide."""
        return 1j * self.guide if self.C is None else self.C - self.O

    @property
    def transmission_line(self) -> tuple[float, float]:
        """p and q: the cosine of the transmission angle is p + q cos psi."""
        a, b = self.sides["O A"], self.sides["A B"]
        if self.C is None:
            return self.offset / b, -a / b
        c, d = self.sides["B C"], self.sides["O C"]
        return (b * b + c * c - a * a - d * d) / (2 * b * c), a * d / (b * c)

    @cached_property
    def psi(self) -> tuple[float, ...]:
        """The angle of OA from the axis at each position, from -pi to pi."""
        return tuple(cmath.phase((A - self.O) / self.axis) for A in self.A)

    @property
    def limits(self) -> tuple[float, float]:
        """Between which sizes of psi the linkage closes: 0 and pi where OA goes round."""
        p, q = self.transmission_line
        cosines = sorted(((1 - p) / q, (-1 - p) / q))
        if abs(self.grashof) <= CHANGE_TOL:
            cosines = [value if abs(abs(value) - 1) > 4 * CHANGE_TOL else math.copysign(2, value) for value in cosines]
        return (0.0 if cosines[1] >= 1 else math.acos(max(-1.0, cosines[1])),
                math.pi if cosines[0] <= -1 else math.acos(min(1.0, cosines[0])))

    def _on_range(self, psi: float) -> float:
        """An angle as it counts along the range of OA, which is free of jumps in it."""
        low, high = self.limits
        return psi % (2 * math.pi) if low > 0 and high == math.pi else psi

    # ---- defects ---------------------------------------------------------------------------------------------------

    def _changes(self, sines: Sequence[float]) -> bool:
        """Whether an angle changes its sense between positions, by its sines; 0 has no sense."""
        return any(sine > SENSE_TOL for sine in sines) and any(sine < -SENSE_TOL for sine in sines)

    @cached_property
    def _sines(self) -> dict[str, list[float]]:
        """The sines of the angles at the four joints, at each position."""
        O, C, rod = self.O, self.C, [B - A for A, B in zip(self.A, self.B, strict=True)]
        crank, ground = [A - O for A in self.A], [self.axis for _ in self.A]
        rocker = [1j * self.guide if C is None else B - C for B in self.B]

        def sines(u: Sequence[complex], v: Sequence[complex]) -> list[float]:
            return [(y / x).imag / abs(y / x) for x, y in zip(u, v, strict=True)]

        return {"O": sines(crank, ground), "A": sines(crank, rod), "B": sines(rod, rocker),
                "C": [1.0] if C is None else sines(rocker, ground)}

    @cached_property
    def defects(self) -> tuple[str, ...]:
        """Defects that keep it from going through its positions."""
        defects = [BRANCH] if self._changes(self._sines["B"]) else []
        if self.grashof > CHANGE_TOL:
            shortest = min(self.sides, key=lambda side: self.sides[side])
            if any(self._changes(self._sines[joint]) for joint in "OABC" if joint not in shortest.split()):
                defects.append(CIRCUIT)
        if not defects and len(self.A) > 2 and self._turns is None:
            defects.append(ORDER)
        return tuple(defects)

    @cached_property
    def _turns(self) -> tuple[float, ...] | None:
        """Angles that OA has turned at each position in one sense, counter-clockwise positive; None if no sense gives
        the positions in order."""
        if len(self.psi) == 1:
            return (0.0,)
        if self.limits == (0.0, math.pi):
            turns = [psi - self.psi[0] for psi in self.psi]
            courses: list[list[float]] = [[turn % (2 * math.pi) for turn in turns],
                                       [-(-turn % (2 * math.pi)) for turn in turns]]
        else:
            along = [self._on_range(psi) for psi in self.psi]
            courses = [[psi - along[0] for psi in along]]
        ordered = [course for course in courses
                   if _rises([abs(turn) for turn in course]) and len({turn > 0 for turn in course[1:]}) == 1]
        shortest: Sequence[float] = min(ordered, key=lambda course: abs(course[-1]), default=())
        return tuple(shortest) or None

    @property
    def sense(self) -> int:
        """Sense of OA from the first to the last position: 1 counter-clockwise, or -1."""
        return -1 if self._turns is not None and self._turns[-1] < 0 else 1

    @property
    def travel(self) -> tuple[float, ...] | None:
        """Angles that OA has turned at each position, in degrees, in its sense; None with a defect."""
        return None if self.defects or self._turns is None else tuple(math.degrees(abs(turn)) for turn in self._turns)

    # ---- transmission ----------------------------------------------------------------------------------------------

    @property
    def transmission(self) -> tuple[float, float]:
        """The least transmission angle, in degrees, and how far OA has turned there."""
        turns = [0.0, *(self._turns or ())] if not self.defects else [psi - self.psi[0] for psi in self.psi]
        if not self.defects and self._turns is not None:
            last = math.copysign(2 * math.pi, self._turns[-1]) if self.whole_turn else self._turns[-1]
            for psi in (0.0, math.pi):
                turn = (psi - self.psi[0]) % (2 * math.pi)
                turns += [course for course in (turn, turn - 2 * math.pi) if 0 <= course * self.sense <= abs(last)]
        p, q = self.transmission_line
        angles = [(math.degrees(math.acos(min(1.0, abs(p + q * math.cos(self.psi[0] + turn))))), turn)
                  for turn in turns]
        least, turn = min(angles, key=lambda pair: (pair[0], abs(pair[1])))
        return least, math.degrees(turn if self.defects else abs(turn))


def _rises(values: Sequence[float]) -> bool:
    return all(low < high for low, high in pairwise(values))


def best_first(linkages: Iterable[tuple[FoundLinkage, Drawn]]) -> tuple[tuple[FoundLinkage, ...], tuple[Drawn, ...]]:
    """Return the linkages, and what is drawn of each: those without defects first, by falling least transmission angle.
    """
    ordered = sorted(linkages, key=lambda pair: (bool(pair[0].defects), -pair[0].transmission[0]))
    return tuple(linkage for linkage, _ in ordered), tuple(values for _, values in ordered)
