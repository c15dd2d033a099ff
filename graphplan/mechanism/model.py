"""What is given: a mechanism in one pose, as frozen plain data.

Numbers are :class:`fractions.Fraction` wherever the scene is rational, exactly as written, and floats where a
placement or a rate is not (polar and compass placements, rpm). Lengths and rates are in the scene's own units,
angles in radians, counter-clockwise positive.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

Number = Fraction | float
Pair = tuple[Number, Number]
Written = tuple[Fraction, Fraction] | Fraction | str | None

FRAME = "frame"


@dataclass(frozen=True)
class Units:
    """The scene's units by name; results come back in them."""

    length: str = "mm"
    force: str = "N"
    mass: str = "kg"


@dataclass(frozen=True)
class Placement:
    """How a point was placed: `how` is given, polar, compass, arc-line or on-line; `data` is the entry as written."""

    how: str
    data: dict[str, object] = field(default_factory=dict)


@dataclass(frozen=True)
class Slide:
    """A sliding pair: `link` slides along the guide fixed to `along`; `at` is a point of `link` on the guide line.

    `direction` is the guide's direction in this pose, of any length. `through` names the two points that give it,
    where the scene gives it so: then it turns with them in other poses. `written` is the direction as the scene
    writes it: a vector, an angle in degrees, or two points.
    """

    link: str
    along: str
    at: str
    direction: Pair
    through: tuple[str, str] | None = None
    written: Written = field(default=None, compare=False)

    @property
    def name(self) -> str:
        """The pair's name in results, such as `3 along 2`."""
        return f"{self.link} along {self.along}"


@dataclass(frozen=True)
class TurningDrive:
    """A prescribed angular velocity (rad/s) and acceleration (rad/s^2) of `link` relative to `relative_to`.

    `rpm` is the angular velocity in turns a minute, where the scene writes it so.
    """

    link: str
    relative_to: str
    omega: Number
    alpha: Number
    rpm: Number | None = field(default=None, compare=False)


@dataclass(frozen=True)
class SlidingDrive:
    """A prescribed speed and acceleration of `link` along its guide on `along`, positive along the direction."""

    link: str
    along: str
    speed: Number
    acceleration: Number


Drive = TurningDrive | SlidingDrive


class Condition(NamedTuple):
    """One condition of a kinematic pair: of `link` at the joint `on`, or of the slide of `link` along the link `on`.

    A joint keeps its two links together in the `way` x and in the way y; a slide keeps the sliding link on the guide
    (across) and from turning relative to it (turn).
    """

    link: str
    on: str
    way: str

    @property
    def pair(self) -> str:
        """The pair's name in results, such as `3 at B` or `3 along 2`."""
        return f"{self.link} {'at' if self.way in ('x', 'y') else 'along'} {self.on}"


@dataclass(frozen=True)
class Motion:
    """The given motion of one point of an open chain."""

    velocity: Pair
    acceleration: Pair


@dataclass(frozen=True)
class Find:
    """What is asked for: names of points; joints and slides (such as `3 along 2`) whose reactions are wanted; links
    whose rates and slides whose velocities and accelerations are wanted.

    None where nothing is said of them: then all reactions are found where there are loads, the rates of links of which
    two points are asked for, and the sliding of pairs whose point is asked for.
    """

    velocity: tuple[str, ...]
    acceleration: tuple[str, ...]
    reactions: tuple[str, ...] | None = None
    links: tuple[str, ...] | None = None
    slides: tuple[str, ...] | None = None


@dataclass(frozen=True)
class Mass:
    """A link's mass, its inertia about the centre of mass (mass * m^2), and that centre, a point of the link."""

    mass: Number
    inertia: Number
    centre: str


@dataclass(frozen=True)
class Force:
    """A given force on a link, at a point of it."""

    on: str
    at: str
    value: Pair


@dataclass(frozen=True)
class Moment:
    """A given couple on a link, in force * m, counter-clockwise positive."""

    on: str
    value: Number


@dataclass(frozen=True)
class Balance:
    """The unknown that keeps the prescribed motion: a moment on `link`, or a force at its point `at` along `direction`.

    The direction has any length, and is written as a slide's is; only where there is none it is a moment.
    """

    link: str
    at: str = ""
    direction: Pair | None = None
    written: Written = field(default=None, compare=False)

    @property
    def spellings(self) -> tuple[str, str, str]:
        """Its names, each longer than the one before: by the link, by a force's point, and by its direction, too."""
        if self.direction is None:
            return self.link, self.link, self.link
        dx, dy = map(float, self.direction)
        return self.link, f"{self.link} at {self.at}", f"{self.link} at {self.at} along ({dx:g}, {dy:g})"


@dataclass(frozen=True)
class Friction:
    """Friction in a pair: a journal `at` a joint, with its radius, or a slide (link, along); and its coefficient."""

    at: str
    slide: tuple[str, str] | None
    radius: Number
    coefficient: Number


@dataclass(frozen=True)
class Loads:
    """What acts on the links besides each other: gravity is in m/s^2, all else in the scene's units.

    `rounds` is how many rounds of friction are asked for; 0 means as many as it takes.
    """

    gravity: Pair
    masses: dict[str, Mass]
    forces: tuple[Force, ...]
    moments: tuple[Moment, ...]
    balances: tuple[Balance, ...]
    frictions: tuple[Friction, ...] = ()
    rounds: int = 0

    @cached_property
    def named_balances(self) -> dict[str, Balance]:
        """The balances by their names in results: the link, or where several act on one, more of what tells them apart.
        """
        borne = Counter(name for balance in self.balances for name in dict.fromkeys(balance.spellings))
        return {next((name for name in balance.spellings if borne[name] == 1), balance.spellings[-1]): balance
                for balance in self.balances}


@dataclass(frozen=True)
class Presentation:
    """How a scene wishes its sheet: texts that are empty, and scales that are None, are left to graphplan.

    `k_s`, `k_v`, `k_a` and `k_F` are what a millimetre of paper stands for, in the scene's units; `multiples` are by
    how much other plans are larger than the mechanism's; by `convention` scales are told as real per drawn, or as
    drawn per real.
    """

    paper: str = ""
    frame: str = "iso"
    owner: str = ""
    number: str = ""
    date: str = ""
    drawn_by: str = "graphplan"
    approved_by: str = ""
    language: str = ""
    k_s: Fraction | None = None
    k_v: Fraction | None = None
    k_a: Fraction | None = None
    k_F: Fraction | None = None
    multiples: dict[str, Fraction] = field(default_factory=dict)
    convention: str = "real"

    @property
    def kappa(self) -> Fraction | None:
        """How long a speed of one is drawn, where two of the scales of lengths, velocities and accelerations tie it."""
        if self.k_s and self.k_v:
            return self.k_s / self.k_v
        return self.k_v / self.k_a if self.k_v and self.k_a else None

    @property
    def phi(self) -> Fraction | None:
        """How long a force of one is drawn, where the scales of lengths and forces tie it."""
        return self.k_s / self.k_F if self.k_s and self.k_F else None


@dataclass(frozen=True)
class Scene:
    """A mechanism in a pose and what is asked of it; made by :func:`graphplan.load`, validated there.

    `points` are coordinates (x, y); `links` lists the points of each link, `frame` among them where there is one.
    `irrational` says, for each value that fractions cannot hold, where it stands in the scene and why. `loads` is None
    where no forces are asked for. `sheet` is how its sheet should look. `text` is the scene as it was written.
    `redundant` are the conditions without which the mechanism moves just the same, by its special geometry, and
    `repeating` all those that follow from others of them: which of them carry the forces nothing tells.
    """

    title: str
    source: str
    name: str
    units: Units
    points: dict[str, Pair]
    placements: dict[str, Placement]
    links: dict[str, tuple[str, ...]]
    slides: tuple[Slide, ...]
    drives: tuple[Drive, ...]
    motions: dict[str, Motion]
    find: Find
    irrational: tuple[str, ...] = ()
    loads: Loads | None = None
    sheet: Presentation = Presentation()
    text: str = field(default="", repr=False, compare=False)
    redundant: tuple[Condition, ...] = ()
    repeating: tuple[Condition, ...] = ()

    @property
    def moving(self) -> tuple[str, ...]:
        """The links that are not the frame, in the scene's order."""
        return tuple(link for link in self.links if link != FRAME)

    @property
    def redundant_pairs(self) -> tuple[str, ...]:
        """The names of the pairs that are redundant, such as `4 at D`, or of which a condition is."""
        return tuple(dict.fromkeys(condition.pair for condition in self.redundant))

    @cached_property
    def indeterminate_pairs(self) -> tuple[str, ...]:
        """The names of the pairs whose reactions are statically indeterminate, each by the link that has the reaction.

        The frame has the opposite of all other links' forces.
        """
        found = {condition.pair for condition in self.repeating}
        joints = (f"{link} at {p}" for p in self.joints for link in self.links_of[p][1:]
                  if not found.isdisjoint(f"{k} at {p}" for k in (self.links_of[p] if link == FRAME else (link,))))
        return (*joints, *(slide.name for slide in self.slides if slide.name in found))

    @cached_property
    def links_of(self) -> dict[str, tuple[str, ...]]:
        """For each point, the links that name it, in the scene's order."""
        found: dict[str, list[str]] = {point: [] for point in self.points}
        for link, points in self.links.items():
            for point in points:
                found[point].append(link)
        return {point: tuple(links) for point, links in found.items()}

    @cached_property
    def joints(self) -> tuple[str, ...]:
        """The points that more than one link names, in the scene's order: the revolute pairs."""
        return tuple(p for p, links in self.links_of.items() if len(links) > 1)
