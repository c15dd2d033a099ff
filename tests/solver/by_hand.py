"""Scenes made by hand: the shortest way to a Scene without a file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from graphplan.mechanism.model import (
    FRAME,
    Balance,
    Find,
    Force,
    Friction,
    Loads,
    Mass,
    Moment,
    Motion,
    Number,
    Pair,
    Placement,
    Scene,
    Slide,
    SlidingDrive,
    TurningDrive,
    Units,
)

Written = int | float | str | Fraction


def number(value: Written) -> Number:
    """Whole numbers and texts exactly as written, floats as they are."""
    return value if isinstance(value, float) else Fraction(value)


def pair(values: Sequence[Written]) -> Pair:
    """Two numbers."""
    return number(values[0]), number(values[1])


def slide(link: str, along: str, at: str, direction: Sequence[Written]) -> Slide:
    """A sliding pair."""
    return Slide(link, along, at, pair(direction))


def turn(link: str, omega: Written, alpha: Written = 0, relative_to: str = FRAME) -> TurningDrive:
    """A drive that turns a link."""
    return TurningDrive(link, relative_to, number(omega), number(alpha))


def push(link: str, along: str, speed: Written, acceleration: Written = 0) -> SlidingDrive:
    """A drive that slides a link."""
    return SlidingDrive(link, along, number(speed), number(acceleration))


def move(velocity: Sequence[Written], acceleration: Sequence[Written] = (0, 0)) -> Motion:
    """The given motion of a point."""
    return Motion(pair(velocity), pair(acceleration))


def force(on: str, at: str, value: Sequence[Written]) -> Force:
    """A given force on a link."""
    return Force(on, at, pair(value))


def moment(on: str, value: Written) -> Moment:
    """A given couple on a link."""
    return Moment(on, number(value))


def mass(kilograms: Written, inertia: Written, centre: str) -> Mass:
    """The mass of a link."""
    return Mass(number(kilograms), number(inertia), centre)


def hold(link: str, at: str = "", direction: Sequence[Written] | None = None) -> Balance:
    """A balance: a moment, or a force along a direction."""
    return Balance(link, at, pair(direction) if direction else None)


def journal(at: str, radius: Written, coefficient: Written) -> Friction:
    """Friction in a joint."""
    return Friction(at, None, number(radius), number(coefficient))


def rough(link: str, along: str, coefficient: Written) -> Friction:
    """Friction in a slide."""
    return Friction("", (link, along), Fraction(0), number(coefficient))


def loads(
    *given: Force | Moment,
    masses: Mapping[str, Mass] | None = None,
    gravity: Sequence[Written] = (0, 0),
    balances: Sequence[Balance] = (),
    frictions: Sequence[Friction] = (),
) -> Loads:
    """The loads of a scene: given forces and moments, masses, balances and frictions."""
    return Loads(
        gravity=pair(gravity),
        masses=dict(masses or {}),
        forces=tuple(load for load in given if isinstance(load, Force)),
        moments=tuple(load for load in given if isinstance(load, Moment)),
        balances=tuple(balances),
        frictions=tuple(frictions),
    )


def mechanism(
    points: Mapping[str, tuple[Written, Written]],
    links: Mapping[str, str],
    drives: Sequence[Any] = (),
    slides: Sequence[Slide] = (),
    motions: Mapping[str, Motion] | None = None,
    irrational: Sequence[str] = (),
    loads: Loads | None = None,
    units: Units | None = None,
) -> Scene:
    """A scene of points, links as in the scene file, drives, slides, given motions and loads; lengths in mm."""
    return Scene(
        title="by hand",
        source="",
        name="by hand",
        units=units or Units(),
        points={name: pair(at) for name, at in points.items()},
        placements={name: Placement("given") for name in points},
        links={name: tuple(names.split()) for name, names in links.items()},
        written=(*slides, *drives),
        motions=dict(motions or {}),
        find=Find((), ()),
        irrational=tuple(irrational),
        loads=loads,
    )
