"""A sketch: a linkage as another program's file has it, before it is a scene.

Points have the keys that the file knows them by; a link is the points that it holds rigidly together.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property

from graphplan.importing.tolerances import ANGLE_TOL, DECIMAL_TOL, DIRECTION_TOL, PLACE_TOL, THOUSANDTH
from graphplan.mechanism.model import FRAME

Way = tuple[str, str] | complex
"""The direction of a guide: from one point to another, or a vector."""

MAX_LINKS, MAX_POINTS = 300, 1500  # links, and points that they have together
MAX_DISTANCE = 1e9  # from the origin


@dataclass(frozen=True)
class SketchGuide:
    """A link that slides along another, its point `at` on the guide line.

    Or two links that roll on each other about the two points `way`, the first `at`; their `gear` is as TOML writes it:
    `teeth = [1, 2]`, `belt = "open"`.
    """

    link: str
    along: str
    at: str
    way: Way
    gear: tuple[str, ...] = ()


@dataclass(frozen=True)
class Slot:
    """A pin that slides in a slot of a link, and turns in it."""

    at: str
    along: str
    way: Way


@dataclass(frozen=True)
class SketchDrive:
    """A drive: the rate as TOML writes it (`rpm = 15`), of a link, or of the link that holds two points; `on` another.

    One that `slides` drives the guide of its two links. `told` says where the rate is from, or that it is a guess.
    """

    link: str | tuple[str, str]
    rate: str
    told: str = ""
    on: str = FRAME
    slides: bool = False


@dataclass(frozen=True)
class SketchMass:
    """A link's mass, its inertia about the centre of mass, and that point."""

    mass: float
    inertia: float
    centre: str


@dataclass(frozen=True)
class SketchForce:
    """A constant force on a point of a link; one that turns with the link points to another point of it."""

    link: str
    at: str
    value: complex
    towards: str = ""


@dataclass
class LinkageSketch:
    """A linkage as it was read, in `notes` what could not be determined, in `left_out` how much of what a scene has no
    place for, in `contents` what was read."""

    program: str
    title: str = ""
    length: str = ""
    places: dict[str, complex] = field(default_factory=dict)
    names: dict[str, str] = field(default_factory=dict)
    links: dict[str, list[str]] = field(default_factory=dict)
    called: dict[str, str] = field(default_factory=dict)
    fixed: dict[str, None] = field(default_factory=dict)
    guides: list[SketchGuide] = field(default_factory=list)
    slots: list[Slot] = field(default_factory=list)
    drives: list[SketchDrive] = field(default_factory=list)
    masses: dict[str, SketchMass] = field(default_factory=dict)
    forces: list[SketchForce] = field(default_factory=list)
    gravity: bool = False
    units: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    left_out: Counter[str] = field(default_factory=Counter)
    contents: Counter[str] = field(default_factory=Counter)

    def point(self, key: str, at: complex, name: str = "") -> str:
        """Put a point; its key.

        Fails with `ValueError` where it lies too far away.
        """
        if not abs(at) < MAX_DISTANCE:
            raise ValueError(f"a point lies at {at.real:g}, {at.imag:g}")
        self.places[key], self.names[key] = at, name
        return key

    def link(self, points: Iterable[str], key: str = "", name: str = "") -> str:
        """Put a link; its key, which is made where none, or one that is there already, is given.

        Fails with `ValueError` where there are too many.
        """
        number = len(self.links)
        if number == MAX_LINKS:
            raise ValueError(f"it has more than {MAX_LINKS} links")
        while not key or key in self.links or key == FRAME:
            key, number = f"link {number}", number + 1
        self.links[key], self.called[key] = [], name
        self.hold(key, *points)
        return key

    def hold(self, link: str, *points: str) -> None:
        """Give a link further points; fails with `ValueError` where there are too many."""
        if sum(map(len, self.links.values())) + len(points) > MAX_POINTS:
            raise ValueError(f"its links have more than {MAX_POINTS} points")
        self.links[link] = [*dict.fromkeys([*self.links[link], *points])]

    def spot(self, link: str, at: complex, name: str) -> str:
        """The point of a link at a place; a new one where it has none."""
        key = next((key for key in self.links[link] if abs(self.places[key] - at) <= PLACE_TOL * self.extent), "")
        if not key:
            key = self.point(f"{name} of {link}", at, name)
            self.hold(link, key)
        return key

    def heading(self, angle: float, whose: str, length: float = 0.0) -> complex:
        """The direction of an angle in radians; one that three decimals rounded, its own or those of the ends of a
        `length`, has the multiple of 15 degrees that it plainly is."""
        plain = math.radians(15 * round(math.degrees(angle) / 15))
        missed = abs(angle - plain)
        rounded = length * missed <= THOUSANDTH if length else abs(angle - round(plain, 3)) <= DECIMAL_TOL
        if DIRECTION_TOL < missed <= ANGLE_TOL and rounded:
            self.note(f"{whose} at {math.degrees(angle):.7g} degrees is plainly at {math.degrees(plain):.7g}")
            angle = plain
        return complex(round(math.cos(angle), 14), round(math.sin(angle), 14))

    def note(self, told: str) -> None:
        """Note what could not be determined, once."""
        if told not in self.notes:
            self.notes.append(told)

    @property
    def bodies(self) -> dict[str, list[str]]:
        """The links with their points, the frame among them."""
        return {**self.links, FRAME: [*self.fixed]}

    def holders(self, point: str) -> list[str]:
        """The bodies that have a point."""
        return [key for key, points in self.bodies.items() if point in points]

    @cached_property
    def extent(self) -> float:
        """The larger of width and height; 1 of a single point."""
        xs, ys = [at.real for at in self.places.values()], [at.imag for at in self.places.values()]
        return max(max(xs) - min(xs), max(ys) - min(ys)) if xs and max(xs) - min(xs) + max(ys) - min(ys) else 1.0

    def vector(self, way: Way) -> complex:
        """The direction of a guide as a vector."""
        return self.places[way[1]] - self.places[way[0]] if isinstance(way, tuple) else way

    @property
    def freedoms(self) -> int:
        """Chebyshev's count of its mobility."""
        counts = Counter(point for points in self.bodies.values() for point in points)
        joints = 2 * sum(count - 1 for count in counts.values())
        return 3 * len(self.links) - joints - sum(2 - bool(guide.gear) for guide in self.guides)
