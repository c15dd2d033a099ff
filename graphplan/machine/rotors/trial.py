"""Trials: what was measured of a rotor in order to balance it, with what and where; angles in degrees."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import NamedTuple

from graphplan.mechanism.fields import Either, Field, Kind, Names, Row, Rows, Table
from graphplan.mechanism.items import Item, described
from graphplan.mechanism.values import AMOUNT, DISTANCE, NUMBER

LEAST_PLACES, MOST_PLACES = 4, 36  # at which trial weights are found


class Vibration(NamedTuple):
    """A vibration as it was measured: its amplitude, and the angle of its mark."""

    amplitude: Fraction
    angle: Fraction


@dataclass(frozen=True)
class Trial:
    """A trial mass by mass times radius and angle, where along the axis it was put, and its radius where that is told.
    """

    mass_radius: Fraction
    angle: Fraction
    at: Fraction | None
    radius: Fraction | None


@dataclass(frozen=True)
class ThreeRuns(Trial):
    """Amplitudes without the trial mass, with it, and with it at the opposite place; `fourth` with it elsewhere."""

    amplitudes: tuple[Fraction, Fraction, Fraction]
    fourth: Vibration | None


@dataclass(frozen=True)
class Marked(Trial):
    """Vibrations, with the angles of their marks, without the trial mass and with it."""

    first: Vibration
    second: Vibration


@dataclass(frozen=True)
class TrialWeights(Trial):
    """The weights that just turn the rotor when they hang at equal places in turn, the first at `angle`, counter-
    clockwise; `mass_radius` is the radius that they hang at."""

    weights: tuple[Fraction, ...]


def _amounts(least: int, most: int, what: str, such: str) -> Kind:
    """A list of numbers from 0."""
    def read(item: Item, names: Names) -> tuple[Fraction, ...] | None:
        if not isinstance(item.value, list) or not least <= len(item.value) <= most:
            return item.fault(f"{described(item.value)} where {what} are wanted", such)
        numbers = [item.instead(value).amount() for value in item.value]
        return tuple(number for number in numbers if number is not None) if None not in numbers else None

    return Kind("list of numbers from 0", read,
                {"type": "array", "items": AMOUNT.schema, "minItems": least, "maxItems": most})


def _size(row: Row) -> Fraction:
    """Mass times radius of the trial mass."""
    values = row.values
    if ("mass_radius" in values) == ("mass" in values or "radius" in values):
        row.item.fault("mass_radius, or mass and radius, tell the trial mass", "mass = 0.02 and radius = 100")
    elif "mass_radius" not in values and not ("mass" in values and "radius" in values):
        row.item.fault(f"{'radius' if 'mass' in values else 'mass'} is missing", "mass = 0.02 and radius = 100")
    found: Fraction = values.get("mass_radius") or values.get("mass", Fraction(1)) * values.get("radius", 1)
    return found


def _trial_mass(row: Row) -> tuple[Fraction, Fraction, Fraction | None, Fraction | None]:
    """Mass times radius, angle, place and radius."""
    return _size(row), row["angle"] % 360, row.values.get("at"), row.values.get("radius")


def _three_runs(row: Row) -> ThreeRuns:
    return ThreeRuns(*_trial_mass(row), row["amplitudes"], row.values.get("fourth"))


def _marked(row: Row) -> Marked:
    return Marked(*_trial_mass(row), row["first"], row["with_trial"])


_VIBRATION = Table("a vibration", (
    Field("amplitude", "its amplitude, in any unit", AMOUNT, "such as amplitude = 3.2"),
    Field("angle", "the angle in degrees, counter-clockwise", NUMBER, "degrees, such as angle = 40"),
), lambda row: Vibration(row["amplitude"], row["angle"] % 360))
_TRIAL_MASS = (
    Field("mass", "the trial mass", DISTANCE),
    Field("radius", "its distance from the axis", DISTANCE),
    Field("mass_radius", "in the place of both: mass times radius", DISTANCE),
    Field("angle", "where on the rotor it is put, in degrees, counter-clockwise from x", NUMBER, default=0),
    Field("at", "where along the axis it is put and the vibration measured; without it in the planes, in their order",
          NUMBER),
)
TRIALS = Rows(Either((
    Table("three runs by amplitudes alone", (
        *_TRIAL_MASS,
        Field("amplitudes", "without the trial mass, with it, and with it at the opposite place, in any unit",
              _amounts(3, 3, "three amplitudes", "such as amplitudes = [3, 4.2, 3.1]"),
              "three numbers, such as amplitudes = [3, 4.2, 3.1]"),
        Field("fourth", "the amplitude of a fourth run with the trial mass at another angle: it decides which of two "
              "answers is right", _VIBRATION),
    ), _three_runs),
    Table("two runs with marks of the largest deflection", (
        *_TRIAL_MASS,
        Field("first", "the vibration without the trial mass", _VIBRATION, "{ amplitude = 3, angle = 40 }"),
        Field("with_trial", "the vibration with it", _VIBRATION, "{ amplitude = 4, angle = 75 }"),
    ), _marked),
    Table("trial weights of static balancing", (
        Field("weights", "the masses that, hung at equal places in turn, just turn the rotor by a small angle",
              _amounts(LEAST_PLACES, MOST_PLACES, f"{LEAST_PLACES} to {MOST_PLACES} weights",
                       "eight as a rule, such as weights = [40, 46, 55, 58, 56, 48, 41, 38]"),
              f"{LEAST_PLACES} weights or more"),
        Field("radius", "at which distance from the axis they hang", DISTANCE, "such as radius = 150"),
        Field("angle", "where on the rotor the first hangs, in degrees; the others follow counter-clockwise", NUMBER,
              default=0),
        Field("at", "where along the axis they hang; without it in the planes, in their order", NUMBER),
    ), lambda row: TrialWeights(row["radius"], row["angle"] % 360, row.values.get("at"), row["radius"],
                                row["weights"])),
)), single=True)
