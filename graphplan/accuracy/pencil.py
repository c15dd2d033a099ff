"""The drawing model: how far off a careful hand is, in millimetres of paper whatever the scale.

A tenth of a millimetre each way puts nineteen points out of twenty within a quarter of a millimetre: the width of a
narrow line (ISO 128-2), and what surveying counts on as plotting accuracy (measured by N. D. Haasbroek, Investigation
of the accuracy of plotting and scaling-off, Delft 1955). Set squares turn as far as such an edge does that is laid
along 160 mm of a line: 0.1 mm at both ends, times the root of two, over 160 mm is a twentieth of a degree.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection
from dataclasses import asdict, dataclass, fields

from graphplan.errors import Refused
from graphplan.phrases import Said, digits, said


@dataclass(frozen=True)
class Pencil:
    """Standard deviations of single movements: `point`, `edge` and `opening` in mm of paper, `angle` in degrees.

    `point` is that of a pricked point in x and in y, or of the compasses' needle; `edge` that of a ruler's edge at each
    point that it is laid at; `angle` that of a direction carried over by set squares; `opening` that of the compasses.
    """

    point: float = 0.1
    edge: float = 0.1
    angle: float = 0.05
    opening: float = 0.1

    @property
    def slope(self) -> float:
        """The angle as the slope that a line gets by it, in first order."""
        return math.radians(self.angle)

    def times(self, factor: float) -> Pencil:
        """A pencil that is so many times as unsteady."""
        return Pencil(*(size * factor for size in asdict(self).values()))

    @property
    def model(self) -> dict[str, float]:
        """The model as data."""
        return asdict(self)

    @property
    def told(self) -> Said:
        """The model in words."""
        sizes = (self.point, self.edge, self.angle, self.opening)
        return said("points ±{0} mm, edges ±{1} mm, set squares ±{2}°, openings ±{3} mm", *map(digits, sizes))


@dataclass(frozen=True)
class SeenPencil:
    """The pencil by which a drawing is judged: so many times as unsteady as the `stated` one; the standard deviation
    of reading its marks, mm, beside what is stated for each, and the part of that which they show. `marks` is how many
    of them tell it, 0 if it is assumed.
    """

    stated: Pencil
    scale: float
    reading: float
    marks: int = 0
    part: float = 1.0

    @property
    def pencil(self) -> Pencil:
        return self.stated.times(self.scale)

    @property
    def told(self) -> Said:
        """In words."""
        point, reading = digits(self.pencil.point, 2), digits(self.reading, 2)
        return said("{0} mm, marks measured to {1} mm", point, reading) if self.reading else said("{0} mm", point)

    @property
    def record(self) -> dict[str, float]:
        """As data, in mm and degrees."""
        return {**self.pencil.model, "reading": self.reading, "marks": self.marks}


SHEET = 1000.0  # mm: no hand is so far off on any sheet
UNITS = {"point": "mm", "edge": "mm", "angle": "degrees", "opening": "mm"}


def pencil(text: str) -> Pencil:
    """The pencil that a text such as `point=0.2,angle=0.1` speaks of; what it leaves out stays as it is by default."""
    known = [field.name for field in fields(Pencil)]
    return Pencil(**settings("--pencil", text, known, "a pencil has no such error", _size))


def _size(name: str, text: str) -> float:
    """A standard deviation: a number of millimetres or degrees, below those of a sheet or of a right angle's half."""
    size, most = decimal(text), 45.0 if name == "angle" else SHEET
    if not 0 <= size < most:
        right = f"a standard deviation in {UNITS[name]}, from 0 to below {most:g}"
        raise Refused(f"--pencil {name}={text}", "this is no size of an error", right)
    return size


def settings(option: str, text: str, known: Collection[str], unknown: str,
             size: Callable[[str, str], float]) -> dict[str, float]:
    """What a text says of the `known` settings; `size` reads each from its name and what is given for it.

    Fails with `Refused`, in the words `unknown`, where it names another one, and where it names one twice.
    """
    found: dict[str, float] = {}
    for entry in filter(None, text.split(",")):
        name, _, given = (part.strip() for part in entry.partition("="))
        if name not in known:
            raise Refused(f"{option} {entry}", unknown, f"one of {', '.join(known)}")
        if name in found:
            raise Refused(f"{option} {text}", f"{name} is told twice", "tell it once")
        found[name] = size(name, given)
    return found


def decimal(text: str) -> float:
    """A number, or nan where it is none."""
    try:
        return float(text)
    except ValueError:
        return math.nan
