"""A named machine: one record of a few lines in a family's table, written as a scene in any pose and order.

    ["whitworth quick return"]
    links  = "OA A PB BC C frame:OP"
    slides = "2 along 3 at A on PB; 5 along frame at C on 1,0"
    at     = [50, 200]
    where  = "O, P = 0, -20j; A = O + 50 * turn(a); B = ...; C = reach(B, 200, 0, 1)"

Points are letters, with a digit or without. Links are numbered as they stand, unless they have a name. A slide's guide
is a line of two points or a vector. A drive is a link (the first where there is none), two links `3-2`, the first
relative to the second, or a slide `4/3`. `where` places the points in the plane of complex numbers, from the positions
a, b, c of the drives, of which `at` has two; a machine without them has one pose, and moves from there to the second.
"""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import geometry

Points = dict[str, complex]
RATES = ((3, -2), (-2, 1), (1, 4))  # speed and acceleration of the first drive, the second, the third
LENGTH = 10  # how far a cylinder goes where a crank goes one radian


class Slide(NamedTuple):
    """Link `link` slides along link `along`; the guide runs through its point `at`, `on` two points or a vector."""

    link: str
    along: str
    at: str
    on: str

    def direction(self, at: Points) -> complex:
        if "," in self.on:
            return complex(*map(float, self.on.split(",")))
        start, end = letters(self.on)
        return at[end] - at[start]

    def written(self, at: Points) -> str:
        z = self.direction(at)
        on = f"[{z.real!r}, {z.imag!r}]" if "," in self.on else f'"{" ".join(letters(self.on))}"'
        return f'[[slides]]\nlink = "{self.link}"\nalong = "{self.along}"\nat = "{self.at}"\ndirection = {on}'


class Drive(NamedTuple):
    """Link `link` turns relative to `base`, or slides along it, at `speed` with `acceleration`."""

    link: str
    base: str
    slides: bool
    speed: int
    acceleration: int

    def written(self) -> str:
        if self.slides:
            rates = f"speed = {self.speed}\nacceleration = {self.acceleration}"
            return f'[[drive]]\nslide = ["{self.link}", "{self.base}"]\n{rates}'
        base = "" if self.base == "frame" else f'\nrelative_to = "{self.base}"'
        return f'[[drive]]\nlink = "{self.link}"\nomega = {self.speed}\nalpha = {self.acceleration}{base}'


@dataclass(frozen=True, eq=False)
class Machine:
    """What stays as it is while the machine moves, and how its poses are placed."""

    name: str
    links: dict[str, tuple[str, ...]]
    slides: tuple[Slide, ...]
    drives: tuple[Drive, ...]
    at: tuple[Any, ...]
    where: str

    def __str__(self) -> str:
        return self.name

    def pose(self, k: int) -> Points:
        """Where its points are."""
        position = self.at[k] if isinstance(self.at[k], list) else [self.at[k]]
        scope = vars(geometry) | dict(zip("abc", position, strict=False))
        exec(self.where, scope)
        return {point: complex(scope[point]) for own in self.links.values() for point in own}

    def scene(self, at: Points, order: int = 0) -> str:
        """The scene in a pose as graphplan reads it; another number, another order of all that is written."""
        random = Random(order)

        def in_any_order(things: list[str]) -> list[str]:
            return random.sample(things, len(things)) if order else things

        points = in_any_order([f"{point} = [{z.real!r}, {z.imag!r}]" for point, z in at.items()])
        links = in_any_order([f'{link} = "{" ".join(in_any_order([*own]))}"' for link, own in self.links.items()])
        slides, drives = [slide.written(at) for slide in self.slides], [drive.written() for drive in self.drives]
        head, find = f'title = "{self.name}"', '[find]\nvelocity = "all"\nacceleration = "all"\n'
        pairs = [*in_any_order(slides), *in_any_order(drives)]
        return "\n".join([head, "[points]", *points, "[links]", *links, *pairs, find])


def family(name: str) -> list[Machine]:
    """The machines of one table."""
    return [_machine(*item) for item in tomllib.loads(Path(__file__).with_name(f"{name}.toml").read_text()).items()]


def letters(word: str) -> tuple[str, ...]:
    """The points of a word: OA is O and A, PA3B is P, A3 and B."""
    return tuple(re.findall(r"[A-Za-z]\d*", word))


def _machine(name: str, record: dict[str, Any]) -> Machine:
    links = {}
    for number, word in enumerate(record["links"].split(), 1):
        link, _, points = word.rpartition(":")
        links[link or str(number)] = letters(points)
    slides = re.findall(r"(\w+) along (\w+) at (\w+) on ([\w,-]+)", record.get("slides", ""))
    drives = [_drive(word, *rate) for word, rate in zip(record.get("drives", "1").split(), RATES, strict=False)]
    parts = tuple(Slide(*slide) for slide in slides), tuple(drives), tuple(record.get("at", [[]]))
    return Machine(name, links, *parts, record["where"])


def _drive(word: str, speed: int, acceleration: int) -> Drive:
    link, sign, base = re.split(r"([-/])", word) if re.search("[-/]", word) else (word, "-", "frame")
    unit = LENGTH if sign == "/" else 1
    return Drive(link, base, sign == "/", unit * speed, unit * acceleration)
