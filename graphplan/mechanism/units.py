"""Units: what the scene's own units are in kilograms, metres and newtons, exactly as they are defined."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


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

BY_QUANTITY = {"length": METRES, "force": NEWTONS, "mass": KILOGRAMS}  # the first unit of each is the default


def metre(units: Units) -> Fraction:
    """One metre in the scene's lengths: a moment (force * m) as force times length."""
    return 1 / METRES[units.length]


def weight(units: Units) -> Fraction:
    """The scene's force that gives its unit of mass 1 m/s^2; also its couple (force * m) for mass * m^2 and rad/s^2."""
    return KILOGRAMS[units.mass] / NEWTONS[units.force]


def inertia(units: Units) -> Fraction:
    """The scene's force that gives its unit of mass one of its lengths per s^2."""
    return weight(units) * METRES[units.length]
