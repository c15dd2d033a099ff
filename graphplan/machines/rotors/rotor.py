"""Rotors: masses off the axis of rotation, given or to be found by trial runs, and the planes that correct them.

All is in the units of the task, angles in degrees, counter-clockwise as one looks along the axis from plane II to
plane I; mass times radius is a vector, the unbalance of a mass. Trials say what was measured of a rotor in order to
balance it, with what and where.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, NamedTuple

from graphplan.mechanism.fields import (
    AMOUNT,
    DISTANCE,
    NUMBER,
    Either,
    Faults,
    Field,
    Kind,
    Rows,
    SceneItem,
    SceneNames,
    Table,
    TableRow,
    describe,
)
from graphplan.mechanism.numbers import heading, number_text
from graphplan.mechanism.tasks import SheetTask, read_task, task_table
from graphplan.mechanism.units import KILOGRAMS, METRES

# ---- trials ---------------------------------------------------------------------------------------------------------


MIN_WEIGHTS, MAX_WEIGHTS = 4, 36  # at which trial weights are found


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
class MarkedRuns(Trial):
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
    def read(item: SceneItem, names: SceneNames) -> tuple[Fraction, ...] | None:
        if not isinstance(item.value, list) or not least <= len(item.value) <= most:
            return item.fault(f"{describe(item.value)} where {what} are wanted", such)
        numbers = [item.with_value(value).amount() for value in item.value]
        return tuple(number for number in numbers if number is not None) if None not in numbers else None

    return Kind("list of numbers from 0", read,
                {"type": "array", "items": AMOUNT.schema, "minItems": least, "maxItems": most})


def trial_mass_radius(row: TableRow) -> Fraction:
    """Mass times radius of the trial mass."""
    values = row.values
    if ("mass_radius" in values) == ("mass" in values or "radius" in values):
        row.item.fault("mass_radius, or mass and radius, tell the trial mass", "mass = 0.02 and radius = 100")
    elif "mass_radius" not in values and not ("mass" in values and "radius" in values):
        row.item.fault(f"{'radius' if 'mass' in values else 'mass'} is missing", "mass = 0.02 and radius = 100")
    product: Fraction = values.get("mass_radius") or values.get("mass", Fraction(1)) * values.get("radius", 1)
    return product


def _trial_mass(row: TableRow) -> tuple[Fraction, Fraction, Fraction | None, Fraction | None]:
    """Mass times radius, angle, place and radius."""
    return trial_mass_radius(row), row["angle"] % 360, row.values.get("at"), row.values.get("radius")


def _three_runs(row: TableRow) -> ThreeRuns:
    return ThreeRuns(*_trial_mass(row), row["amplitudes"], row.values.get("fourth"))


def marked_runs(row: TableRow) -> MarkedRuns:
    return MarkedRuns(*_trial_mass(row), row["first"], row["with_trial"])


_VIBRATION = Table("a vibration", (
    Field("amplitude", "its amplitude, in any unit", AMOUNT, "such as amplitude = 3.2"),
    Field("angle", "the angle in degrees, counter-clockwise", NUMBER, "degrees, such as angle = 40"),
), lambda row: Vibration(row["amplitude"], row["angle"] % 360))
_TRIAL_MASS = (
    Field("mass", "the trial mass", DISTANCE),
    Field("radius", "its distance from the axis", DISTANCE),
    Field("mass_radius", "instead of both: mass times radius", DISTANCE),
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
    ), marked_runs),
    Table("trial weights of static balancing", (
        Field("weights", "the masses that, hung at equal places in turn, just turn the rotor by a small angle",
              _amounts(MIN_WEIGHTS, MAX_WEIGHTS, f"{MIN_WEIGHTS} to {MAX_WEIGHTS} weights",
                       "eight as a rule, such as weights = [40, 46, 55, 58, 56, 48, 41, 38]"),
              f"{MIN_WEIGHTS} weights or more"),
        Field("radius", "at which distance from the axis they hang", DISTANCE, "such as radius = 150"),
        Field("angle", "where on the rotor the first hangs, in degrees; the others follow counter-clockwise", NUMBER,
              default=0),
        Field("at", "where along the axis they hang; without it in the planes, in their order", NUMBER),
    ), lambda row: TrialWeights(row["radius"], row["angle"] % 360, row.values.get("at"), row["radius"],
                                row["weights"])),
)), single=True)


Vector = tuple[Fraction, Fraction]
PLANES = "I", "II"
MAX_NAME_LETTERS = 20  # letters of a mass's name


@dataclass(frozen=True)
class Eccentric:
    """A mass off the axis: mass times its radius vector, where along the axis it is, and its mass where it is known.

    `exact` says whether fractions hold the vector as it is written.
    """

    name: str
    unbalance: Vector
    at: Fraction | None
    mass: Fraction | None = None
    exact: bool = True

    @property
    def mass_radius(self) -> float:
        """Mass times radius."""
        return math.hypot(*self.unbalance)

    @property
    def radius(self) -> float | None:
        """Distance of the mass from the axis, if known."""
        return self.mass_radius / float(self.mass) if self.mass else None

    @property
    def angle(self) -> float:
        """Direction in degrees from 0 to 360."""
        return direction(*self.unbalance)


@dataclass(frozen=True)
class Rotor:
    """The correction planes in their places along the axis, the masses, what is given of corrections in each plane
    (radius or mass), the bearings' places and the speed in rad/s where reactions are asked for."""

    planes: tuple[Fraction, ...]
    masses: tuple[Eccentric, ...]
    radii: tuple[Fraction | None, ...]
    weights: tuple[Fraction | None, ...]
    bearings: tuple[Fraction, ...] = ()
    omega: float = 0.0

    @property
    def dynamic(self) -> bool:
        """Whether there are two planes, so that moments are balanced, too."""
        return len(self.planes) > 1

    def arm(self, at: Fraction) -> Fraction:
        """Distance of a place on the axis from plane I, towards plane II."""
        return (at - self.planes[0]) * (-1 if self.planes[-1] < self.planes[0] else 1)

    @property
    def plane_distance(self) -> Fraction:
        """Distance of the planes; 0 for one alone."""
        return self.arm(self.planes[-1])


@dataclass(frozen=True)
class RotorTask(SheetTask):
    """The keys of a task: masses or trials, one for each plane."""

    rotor: Rotor
    trials: tuple[Trial, ...]

    @property
    def kg_m(self) -> Fraction:
        """The task's mass times length in kg m."""
        return KILOGRAMS[self.units.mass] * METRES[self.units.length]

    @property
    def metres(self) -> Fraction:
        """The task's unit of length in metres."""
        return METRES[self.units.length]


def direction(x: Fraction | float, y: Fraction | float) -> float:
    """The angle of a vector in degrees, from 0 up to 360; 0 where it has no length."""
    return math.degrees(math.atan2(y, x)) % 360 % 360  # the first of a tiny negative angle is 360


# ---- the masses -----------------------------------------------------------------------------------------------------


def _name(item: SceneItem, names: SceneNames) -> str | None:
    text = item.text("a name", 'a name in quotes, such as "fan"')
    if text is not None and not (text.isprintable() and 0 < len(text.strip()) <= MAX_NAME_LETTERS):
        return item.fault(f"{describe(text)} is not a name", f"a name of {MAX_NAME_LETTERS} letters or less")
    return text


def mass_by_angle(row: TableRow) -> Eccentric:
    """A mass by its distance from the axis and its angle, or mass times radius with an angle."""
    values = row.values
    c, s, exact = heading(values["angle"])
    mass_radius = values["mass"] * values["radius"] if "mass" in values else values["mass_radius"]
    return Eccentric(values.get("name", ""), (mass_radius * c, mass_radius * s), values.get("at"), values.get("mass"),
                     exact)


def mass_by_coordinates(row: TableRow) -> Eccentric:
    """A mass by its coordinates."""
    mass, values = row["mass"], row.values
    return Eccentric(values.get("name", ""), (mass * values["x"], mass * values["y"]), values.get("at"), mass)


_NAME = Field("name", "what it is called in tables; without it its number",
              Kind("text", _name, {"type": "string", "minLength": 1, "maxLength": MAX_NAME_LETTERS}))
_AT = Field("at", "where along the axis it is; of a rotor with one plane in that, unless it is said", NUMBER)
_MASS = Field("mass", "its mass", AMOUNT, "such as mass = 0.5")
ANGLE = Field("angle", "its direction in degrees, counter-clockwise from x", NUMBER, "degrees, such as angle = 120")
_ONCE: Callable[[Any], Any] = lambda mass: (mass.name or object(), f"mass {mass.name}")  # noqa: E731
MASSES = Rows(Either((
    Table("a mass by radius and angle", (
        _NAME, _MASS, Field("radius", "its distance from the axis of rotation", AMOUNT, "such as radius = 100"), ANGLE,
        _AT), mass_by_angle),
    Table("a mass by coordinates", (
        _NAME, _MASS, Field("x", "its place across the axis", NUMBER, "x and y, such as x = 60"),
        Field("y", "the same", NUMBER, "x and y, such as y = -80"), _AT), mass_by_coordinates),
    Table("an unbalance", (
        _NAME, Field("mass_radius", "mass times radius, in the task's units", AMOUNT, "such as mass_radius = 50"),
        ANGLE, _AT), mass_by_angle),
)), once=_ONCE, remedy="another name")


# ---- the rotor ------------------------------------------------------------------------------------------------------


def _numbers(least: int, what: str, such: str, positive: str = "") -> Kind:
    """A list of one number or two, at least so many; one alone may stand without brackets. Above 0 where that is what
    is `positive`."""
    def read_numbers(item: SceneItem, names: SceneNames) -> tuple[Fraction, ...] | None:
        values = item.value if isinstance(item.value, list) else [item.value]
        if not least <= len(values) <= 2:
            return item.fault(f"{describe(item.value)} where {what} wanted", such)
        parts = [item.with_value(value) for value in values]
        numbers = tuple(part.positive(positive) if positive else part.number() for part in parts)
        return None if None in numbers else tuple(number for number in numbers if number is not None)

    entry = DISTANCE.schema if positive else NUMBER.schema
    listed = {"type": "array", "items": entry, "minItems": least, "maxItems": 2}
    return Kind("list of two numbers" if least == 2 else "number, or list of one or two", read_numbers,
                listed if least == 2 else {"anyOf": [entry, listed]})


def _rotor(row: TableRow) -> Rotor | None:
    """The rotor, each mass named and in its place."""
    values, planes = row.values, row["planes"]
    if len(planes) == 2 and planes[0] == planes[1]:
        return row.items["planes"].fault(f"both planes stand at {number_text(planes[0])}",
                                         "two places, or one plane alone")
    speed = math.pi * float(values["rpm"]) / 30 if "rpm" in values else float(values.get("omega", 0))
    if "rpm" in values and "omega" in values:
        row.items["rpm"].fault("omega and rpm are both given", "omega or rpm, not both")
    bearings = values.get("bearings", ())
    if bool(speed) != bool(bearings):
        row.item.fault("bearings and a speed belong together", "bearings = [-50, 650] with rpm = 1500, or neither")
    if bearings and bearings[0] == bearings[1]:
        row.items["bearings"].fault(f"both bearings stand at {number_text(bearings[0])}", "two places")
    return Rotor(planes, _in_place(row, planes), per_plane(row, "radius", planes), per_plane(row, "mass", planes),
                 bearings,
                 speed)


def _in_place(row: TableRow, planes: tuple[Fraction, ...]) -> tuple[Eccentric, ...]:
    """The masses by name, those of a rotor with one plane in it unless they stand elsewhere."""
    rows = []
    for number, mass in enumerate(row.values.get("masses", ()), 1):
        if mass.at is None and len(planes) == 2:
            row.items["masses"].rows()[number - 1].fault("at is missing", "its place along the axis, such as at = 200")
        at = planes[0] if mass.at is None else mass.at
        rows.append(replace(mass, name=mass.name or str(number), at=at))
    return tuple(rows)


def per_plane(row: TableRow, key: str, planes: tuple[Fraction, ...]) -> tuple[Fraction | None, ...]:
    """Given values of the correction in each plane, one number for both."""
    values = row.values.get(key, (None,))
    if len(values) > len(planes):
        row.items[key].fault("two numbers for one plane", "one number")
    if key == "mass" and key in row.values and "radius" in row.values:
        row.items[key].fault("radius is given, too: each follows from the other", "one of them")
    return tuple((values * 2)[:len(planes)])


ROTOR = Table("the rotor", (
    Field("planes", "where along the axis the planes of correction stand: two, or one for static balancing alone",
          _numbers(1, "one place or two are", "planes = [0, 600], or [0] for static balancing"),
          "where the correction planes stand, such as planes = [0, 600]"),
    Field("masses", "what is out of balance", MASSES),
    Field("radius", "how far from the axis correction masses are put, in both planes or in each: their masses follow",
          _numbers(1, "one radius or two are", "such as radius = [80, 100]", "radius")),
    Field("mass", "how heavy correction masses are: their radii follow",
          _numbers(1, "one mass or two are", "such as mass = [0.5, 0.5]", "mass")),
    Field("bearings", "where the bearings stand, for their rotating reactions before and after",
          _numbers(2, "two places are", "two places, such as bearings = [-50, 650]")),
    Field("omega", "the speed for these reactions, in rad/s", DISTANCE),
    Field("rpm", "the same in turns a minute", DISTANCE),
), _rotor)
TASK = task_table(
    "a rotor: its masses, or what was measured in trial runs, and the planes in which it is balanced",
    ("length", "mass", "force"),
    Field("rotor", "the rotor", ROTOR, "[rotor] with planes = [0, 600] and masses"),
    Field("trial", "what was measured, for each plane one table: by three runs, by two with marks, or by trial weights",
          TRIALS),
)


# ---- reading --------------------------------------------------------------------------------------------------------


def parse(text: str, name: str) -> RotorTask:
    """The task that a TOML text says; `name` stands in error lines."""
    def build_task(read: dict[str, Any], shared: dict[str, Any], faults: Faults) -> RotorTask:
        rotor, trials = read["rotor"], read.get("trial", ())
        _fitting(rotor, trials, faults)
        trials = tuple(replace(trial, at=rotor.planes[k] if trial.at is None else trial.at)
                       for k, trial in enumerate(trials[:len(rotor.planes)]))
        if trials and rotor.radii[0] is None and rotor.weights[0] is None:  # where the trial masses were put
            rotor = replace(rotor, radii=tuple(trial.radius for trial in trials))
        if len(trials) == 2 and trials[0].at == trials[1].at:
            faults.add("trial", f"both trial masses were put at {number_text(trials[0].at)}", "a place for each plane")
        return RotorTask(**shared, rotor=rotor, trials=trials)

    return read_task(TASK, text, name, build_task)


def _fitting(rotor: Rotor, trials: tuple[Trial, ...], faults: Faults) -> None:
    """Note where masses, trials and planes do not fit each other."""
    if not rotor.masses and not trials:
        faults.add("rotor.masses", "there are no masses",
                   "masses = [{ mass = 0.5, radius = 100, angle = 0, at = 200 }], or a [trial] in which they are found")
    elif rotor.masses and trials:
        faults.add("trial", "the masses are given already", "masses, or a [trial] in which they are found")
    elif trials and len(trials) != len(rotor.planes):
        faults.add("trial", f"trials: {len(trials)}, planes: {len(rotor.planes)}", "one [[trial]] for each plane")
    elif rotor.dynamic and any(isinstance(trial, TrialWeights) for trial in trials):
        faults.add("trial", "trial weights do not determine moments, which two planes balance",
                   "one plane, or amplitudes")
