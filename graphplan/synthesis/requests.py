"""What tasks of a synthesis ask for: a record for each kind. Angles are in degrees."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

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
    slots: int
    centres: float


@dataclass(frozen=True)
class ConjugateTask:
    """The centre distance, how body 2 moves by body 1, its profile, and the range of phi."""

    centres: float
    profile: dict[str, Any]
    span: tuple[float, float]
    ratio: float = 0.0
    law: tuple[Point, ...] = ()
    translating: bool = False


@dataclass(frozen=True)
class GearTask:
    module: float
    teeth: tuple[int, int]
    internal: bool
    pressure_angle: float
    shift: tuple[float, float] | str
    addendum: float
    clearance: float
