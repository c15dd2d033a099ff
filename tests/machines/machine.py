"""A named machine in a few lines: a function that places its points, and what joins, guides and drives them.

`@machine("OA AB BP frame:OP", drives="1", at=(40, 200))` stands over a function of the drives' positions that returns
its local names, the points, as complex numbers. Links are numbered as they stand unless they have a name. Letters are
points, with a digit or without. `slides="4 along 3 at B on OC"` guides link 4 by the line OC, or by a vector `on 1,0`.
A drive is a link, two links `3-2` (the first relative to the second) or a slide `4/3`. A function without arguments
gives one pose with round coordinates; the second is the one to which the closure moves in `after` seconds.
"""

from __future__ import annotations

import cmath
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import radians, sqrt
from random import Random
from typing import Any, NamedTuple

Points = dict[str, complex]
RATES = ((3, -2), (-2, 1), (1, 4))  # of the first drive, the second, the third: speed and acceleration
LENGTH = 10  # how far a cylinder goes where a crank goes one radian


class Slide(NamedTuple):
    """Link `link` slides along link `along`; its point `at` lies on the guide, whose direction is `on`."""

    link: str
    along: str
    at: str
    on: str

    def direction(self, at: Points) -> complex:
        if "," in self.on:
            return complex(*map(float, self.on.split(",")))
        start, end = names(self.on)
        return at[end] - at[start]


class Drive(NamedTuple):
    """Link `link` turns relative to `base`, or slides along it, at `speed` with `acceleration`."""

    link: str
    base: str
    slides: bool
    speed: float
    acceleration: float


@dataclass(frozen=True)
class Machine:
    """What stays as it is while the machine moves, and where its points are in the poses that are looked at."""

    name: str
    links: dict[str, tuple[str, ...]]
    slides: tuple[Slide, ...]
    drives: tuple[Drive, ...]
    place: Callable[..., Points]
    positions: tuple[Any, ...]
    after: float
    fails: str

    def __str__(self) -> str:
        return self.name

    def pose(self, k: int) -> Points:
        """Where the points of its links are in one pose."""
        position = self.positions[k]
        found = self.place(*(position if isinstance(position, tuple) else (position,)))
        return {point: complex(found[point]) for own in self.links.values() for point in own}

    def scene(self, at: Points, order: int = 0) -> str:
        """The scene in one pose as graphplan reads it, all of it written in another order for another number."""
        random = Random(order)

        def mixed(things: list[str]) -> list[str]:
            return random.sample(things, len(things)) if order else things

        lines = [f'title = "{self.name}"', "[points]", *mixed([f"{p} = [{z.real!r}, {z.imag!r}]" for p, z in at.items()])]
        lines += ["[links]", *mixed([f'{link} = "{" ".join(mixed([*own]))}"' for link, own in self.links.items()])]
        guides = [_guide(slide, slide.direction(at)) for slide in self.slides]
        return "\n".join([*lines, *mixed(guides), *mixed([_driven(drive) for drive in self.drives])]) + "\n"


def _guide(slide: Slide, direction: complex) -> str:
    on = f"[{direction.real!r}, {direction.imag!r}]" if "," in slide.on else f'"{" ".join(names(slide.on))}"'
    return f'[[slides]]\nlink = "{slide.link}"\nalong = "{slide.along}"\nat = "{slide.at}"\ndirection = {on}'


def _driven(drive: Drive) -> str:
    if drive.slides:
        which = f'slide = ["{drive.link}", "{drive.base}"]\nspeed = {drive.speed}\nacceleration = {drive.acceleration}'
    else:
        relative = "" if drive.base == "frame" else f'\nrelative_to = "{drive.base}"'
        which = f'link = "{drive.link}"\nomega = {drive.speed}\nalpha = {drive.acceleration}{relative}'
    return f"[[drive]]\n{which}"


MACHINES: list[Machine] = []


def machine(links: str, *, drives: str = "1", slides: str = "", at: tuple[Any, ...] = ((),), after: float = 0.15,
            fails: str = "", into: list[Machine] = MACHINES) -> Callable[[Callable[..., Points]], None]:
    """Enter the machine whose points the function gives, for each of the drives' positions in `at`, into the table."""
    whole = dict(_named(i, word) for i, word in enumerate(links.split(), 1))
    guides = tuple(_slide(*line.split()) for line in slides.split(";") if line)

    def enter(place: Callable[..., Points]) -> None:
        driven = tuple(_drive(word, *rate) for word, rate in zip(drives.split(), RATES))
        into.append(Machine(place.__name__.replace("_", " "), whole, guides, driven, place, at, after, fails))

    return enter


def names(word: str) -> tuple[str, ...]:
    """The points of a word: OA is O and A, PA3B is P, A3 and B."""
    return tuple(re.findall(r"[A-Za-z]\d*", word))


def _named(number: int, word: str) -> tuple[str, tuple[str, ...]]:
    name, _, points = word.rpartition(":")
    return name or str(number), names(points)


def _slide(link: str, _along: str, along: str, _at: str, at: str, _on: str, on: str) -> Slide:
    return Slide(link, along, at, on)


def _drive(word: str, speed: int, change: int) -> Drive:
    link, sign, base = re.fullmatch(r"(\w+?)(?:([-/])(\w+))?", word).groups()
    factor = LENGTH if sign == "/" else 1
    return Drive(link, base or "frame", sign == "/", factor * speed, factor * change)


# Where points stand: closed forms over the true lengths.

def turn(degrees: float) -> complex:
    """The unit vector at an angle to the x axis."""
    return cmath.exp(1j * radians(degrees))


def tip(A: complex, a: float, B: complex, b: float) -> complex:
    """The point at the distance a from A and b from B, to the left of the ray from A to B."""
    c = abs(B - A)
    x = (a * a - b * b + c * c) / (2 * c)
    return A + (B - A) / c * complex(x, sqrt(a * a - x * x))


def reach(A: complex, a: float, P: complex, along: complex) -> complex:
    """The point at the distance a from A on the line through P, the one farther on along it."""
    along /= abs(along)
    foot = P + along * ((A - P) * along.conjugate()).real
    return foot + along * sqrt(a * a - abs(A - foot) ** 2)


def mirror(P: complex, A: complex, B: complex) -> complex:
    """The image of P in the line AB."""
    return A + ((P - A) / (B - A)).conjugate() * (B - A)


def towards(A: complex, a: float, B: complex) -> complex:
    """The point at the distance a from A on the ray to B."""
    return A + a * (B - A) / abs(B - A)


def seat(A: complex, B: complex, at: complex) -> complex:
    """The place `at` of a body whose origin is A and whose x axis goes through B."""
    return A + (B - A) / abs(B - A) * at
