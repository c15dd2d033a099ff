"""The kinds of values in tasks of a synthesis: lists of numbers, and numbers as floats.

What tasks of a synthesis ask for: a record for each kind. Angles are in degrees.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from graphplan.mechanism.fields import DISTANCE, NUMBER, VECTOR, Kind, SceneItem, SceneNames, describe
from graphplan.mechanism.numbers import number_text

MAX_ENTRIES = 10_000  # entries of a list: more are none that somebody wrote


def entries_of(item: SceneItem, least: int, most: int, what: str, such: str) -> list[SceneItem] | None:
    """The entries of a list of so many; None if it is not such a list."""
    if not isinstance(item.value, list) or not least <= len(item.value) <= most:
        count = f"{least}" if least == most else f"{least} to {most}" if most < MAX_ENTRIES else f"{least} or more"
        return item.fault(f"{describe(item.value)} where {count} {what} are wanted", such)
    return [SceneItem(value, f"{item.where}.{k}", item.faults, item.key) for k, value in enumerate(item.value, 1)]


def _as_float(kind: Kind) -> Kind:
    """A kind of number as a float, of vectors as two."""
    def read(item: SceneItem, names: SceneNames) -> Any:
        value = kind.read(item, names)
        return None if value is None else tuple(map(float, value)) if isinstance(value, tuple) else float(value)

    return kind._replace(read=read)


REAL, LENGTH, PLACE = _as_float(NUMBER), _as_float(DISTANCE), _as_float(VECTOR)


def list_of(kind: Kind, least: int, most: int, what: str, such: str) -> Kind:
    """A list of so many of a kind, as a tuple."""
    def read(item: SceneItem, names: SceneNames) -> tuple[Any, ...] | None:
        values = [kind.read(entry, names) for entry in entries_of(item, least, most, what, such) or ()]
        return tuple(values) if values and None not in values else None

    return Kind(what, read, {"type": "array", "minItems": least, "maxItems": most, "items": kind.schema})


def numbers(least: int, most: int, such: str) -> Kind:
    """A list of numbers, as floats."""
    return list_of(REAL, least, most, "numbers", such)


def rows_of_numbers(size: int, least: int, most: int, what: str, such: str) -> Kind:
    """A list of lists of so many numbers, as tuples of floats."""
    return list_of(numbers(size, size, such), least, most, what, such)


def whole_number(least: int, most: int) -> Kind:
    """A whole number in a range."""
    def read(item: SceneItem, names: SceneNames) -> int | None:
        number = item.number()
        if number is None:
            return None
        if number.denominator != 1 or not least <= number <= most:
            return item.fault(f"{number_text(number)} where a whole number is wanted", f"one from {least} to {most}")
        return int(number)

    return Kind("whole number", read, {"type": "integer", "minimum": least, "maximum": most})


Point = tuple[float, float]


@dataclass(frozen=True)
class CirclePointChoice:
    """A point of the circle-point curve: its u, and which real z there, counted from 1 upwards."""

    u: float
    root: int


@dataclass(frozen=True)
class GuidanceTask:
    """Positions of a plane (origin and angle of its axis), and what else is chosen."""

    positions: tuple[tuple[float, float, float], ...]
    moving: tuple[Any, ...] = ()
    fixed: tuple[Point, ...] = ()
    turns: tuple[float, ...] = ()
    table: tuple[float, ...] = ()
    driver: float = 0.0  # the time ratio of a crank that swings OA; 0 where none is asked for


@dataclass(frozen=True)
class FunctionTask:
    """Angles of a crank, and angles of a rocker or places of a slide that belong to them."""

    pivot: Point
    input: tuple[float, ...]
    rocker: dict[str, Any] | None = None
    slide: dict[str, Any] | None = None
    crank: float | None = None
    moving: tuple[CirclePointChoice, ...] = ()
    compare: tuple[Point, ...] = ()


@dataclass(frozen=True)
class StrokeTask:
    """The angle between the dead positions of a crank, and of what."""

    angle: float
    stroke: float | None = None
    given: tuple[str, float] = ("", 0.0)  # offset, crank or rod
    rocker: dict[str, float] | None = None
    ground: float | str | None = None
    lever: float | None = None


@dataclass(frozen=True)
class PathTask:
    """A point of a scene's coupler; of a dwell the travels between which it lasts, and the pivot of the output."""

    scene: str
    point: str
    link: str
    span: tuple[float, float] = (0.0, 0.0)
    pivot: Point | None = None
    straight: bool = False


@dataclass(frozen=True)
class GenevaTask:
    """A Geneva drive is asked for: how many slots, and how far apart the centres."""

    slots: int
    centres: float


@dataclass(frozen=True)
class ConjugateTask:
    """The centre distance, 0 where body 2 translates, how body 2 moves by body 1, its profile, and the range of phi."""

    centres: float
    profile: dict[str, Any]
    span: tuple[float, float]
    ratio: float = 0.0
    law: tuple[Point, ...] = ()
    translating: bool = False
    divisions: int = 24  # of the range, in which it is drawn

    @property
    def size(self) -> float:
        """The size of the machine, from O1 to its furthest given point."""
        points = self.profile.get("line") or [self.profile.get("circle") or self.profile["point"]]
        return max(self.centres, *(math.hypot(*point) for point in points))


@dataclass(frozen=True)
class GearTask:
    """A pair of gears is asked for: its module and numbers of teeth."""

    module: float
    teeth: tuple[int, int]
    internal: bool
    pressure_angle: float
    shift: tuple[float, float] | str
    addendum: float
    clearance: float
