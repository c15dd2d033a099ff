"""Units: what the scene's own units are in kilograms, metres and newtons, exactly as they are defined."""

from __future__ import annotations

from fractions import Fraction

from graphplan.mechanism.fields import Field, Table, choice
from graphplan.mechanism.model import Units

METRES = {"mm": Fraction(1, 1000), "cm": Fraction(1, 100), "m": Fraction(1), "in": Fraction(254, 10000),
          "ft": Fraction(3048, 10000)}
KILOGRAMS = {"kg": Fraction(1), "g": Fraction(1, 1000), "t": Fraction(1000), "lb": Fraction(45359237, 10**8)}
NEWTONS = {"N": Fraction(1), "kN": Fraction(1000), "kgf": Fraction(980665, 10**5),
           "lbf": Fraction(45359237, 10**8) * Fraction(980665, 10**5)}

BY_QUANTITY = {"length": METRES, "force": NEWTONS, "mass": KILOGRAMS}  # the first unit of each is the default

UNITS = Table("the units", (
    Field("length", "the unit of lengths", choice(*METRES), default="mm"),
    Field("force", "the unit of forces; moments are force * m", choice(*NEWTONS), default="N"),
    Field("mass", "the unit of masses; inertia is mass * m^2", choice(*KILOGRAMS), default="kg"),
), lambda row: Units(**row.values))


def metre(units: Units) -> Fraction:
    """One metre in the scene's lengths: a moment (force * m) as force times length."""
    return 1 / METRES[units.length]


def weight(units: Units) -> Fraction:
    """The scene's force that gives its unit of mass 1 m/s^2; also its couple (force * m) for mass * m^2 and rad/s^2."""
    return KILOGRAMS[units.mass] / NEWTONS[units.force]


def inertia(units: Units) -> Fraction:
    """The scene's force that gives its unit of mass one of its lengths per s^2."""
    return weight(units) * METRES[units.length]
