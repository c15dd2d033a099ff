"""Units: what the scene's own units are in kilograms, metres and newtons, exactly; and the sizes of paper in mm."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple


@dataclass(frozen=True)
class Units:
    """The scene's units by name; results come back in them."""

    length: str = "mm"
    force: str = "N"
    mass: str = "kg"


METRES = {"mm": Fraction(1, 1000), "cm": Fraction(1, 100), "m": Fraction(1), "in": Fraction(254, 10000),
          "ft": Fraction(3048, 10000)}
KILOGRAMS = {"kg": Fraction(1), "g": Fraction(1, 1000), "t": Fraction(1000), "lb": Fraction(45359237, 10**8)}
NEWTONS = {"N": Fraction(1), "kN": Fraction(1000), "kgf": Fraction(980665, 10**5),
           "lbf": Fraction(45359237, 10**8) * Fraction(980665, 10**5)}


class Dimension(NamedTuple):
    """Powers of length, time and force, the letter of such a quantity, and how its unit is made of the scene's."""

    length: int
    time: int
    force: int
    letter: str
    pattern: str

    def unit(self, units: Units) -> str:
        """The unit of such a quantity, as files write it."""
        return self.pattern.format(length=units.length, force=units.force, mass=units.mass)

    def sheet_unit(self, units: Units) -> str:
        """Return the unit in the notation of sheets."""
        return self.unit(units).replace("^2", "²").replace("*", "·")


SPEED, ACCELERATING = Dimension(1, -1, 0, "v", "{length}/s"), Dimension(1, -2, 0, "a", "{length}/s^2")
TURNING, TURNING_FASTER = Dimension(0, -1, 0, "omega", "rad/s"), Dimension(0, -2, 0, "alpha", "rad/s^2")
FORCE, MOMENT = Dimension(0, 0, 1, "F", "{force}"), Dimension(1, 0, 1, "M", "{force}*m")
LENGTH = Dimension(1, 0, 0, "r", "{length}")
PLACE, HEADING = Dimension(1, 0, 0, "P", "{length}"), Dimension(0, 0, 0, "d", "1")  # one at infinity has a heading
CURVING = Dimension(-1, 0, 0, "k", "1/{length}")
INERTIA = Dimension(1, 2, 1, "I", "{mass}*m^2")

BY_QUANTITY = {"length": METRES, "force": NEWTONS, "mass": KILOGRAMS}  # the first unit of each is the default


def metre(units: Units) -> Fraction:
    """One metre in the scene's lengths: a moment (force * m) as force times length."""
    return 1 / METRES[units.length]


def millimetre(units: Units) -> Fraction:
    """One millimetre in the scene's lengths: in it scales are round, whatever the unit."""
    return metre(units) / 1000


def weight(units: Units) -> Fraction:
    """The scene's force that gives its unit of mass 1 m/s^2; also its couple (force * m) for mass * m^2 and rad/s^2."""
    return KILOGRAMS[units.mass] / NEWTONS[units.force]


def inertia(units: Units) -> Fraction:
    """The scene's force that gives its unit of mass one of its lengths per s^2."""
    return weight(units) * METRES[units.length]


ISO_SIZES = {"A4": (297.0, 210.0), "A3": (420.0, 297.0), "A2": (594.0, 420.0), "A1": (841.0, 594.0),
             "A0": (1189.0, 841.0)}
SIZES = {**ISO_SIZES, "Letter": (279.4, 215.9), "Legal": (355.6, 215.9), "Tabloid": (431.8, 279.4)}
AS_LARGE_AS = {"Letter": "A4", "Legal": "A4", "Tabloid": "A3"}  # the ISO paper beside which others are judged
PAPERS = tuple(f"{size}{way}" for size in SIZES for way in ("", " portrait"))


def iso_size(paper: str) -> str:
    """The ISO size that a sheet such as `A4 portrait` or `Letter` has, or is about as large as."""
    name = paper.partition(" ")[0]
    return AS_LARGE_AS.get(name, name)
