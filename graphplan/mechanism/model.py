"""What is given: a mechanism in one pose, as frozen plain data.

Numbers are :class:`fractions.Fraction` wherever the scene is rational, exactly as written, and floats where a
placement or a rate is not (polar and compass placements, rpm). Lengths and rates are in the scene's own units,
angles in radians, counter-clockwise positive.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from itertools import permutations
from typing import Any

from graphplan.mechanism.directions import Written
from graphplan.mechanism.load_tables import LoadTable
from graphplan.mechanism.pairs.contact import Contact
from graphplan.mechanism.pairs.drives import Drive, DrivenPoint, Motion, SlidingDrive, TurningDrive
from graphplan.mechanism.pairs.gear import Gear
from graphplan.mechanism.pairs.pair import FRAME, Along, Condition, KinematicPair, Statement, Turning
from graphplan.mechanism.pairs.revolute import Revolute
from graphplan.mechanism.pairs.sliding import Slide
from graphplan.mechanism.plane import Number, Pair
from graphplan.mechanism.running import Flywheel, Run
from graphplan.mechanism.sheet import Presentation
from graphplan.mechanism.units import Units

__all__ = ["FRAME", "Assembly", "Balance", "Condition", "Contact", "Drive", "Extreme", "Find", "Flywheel", "Force",
           "Friction", "Gear", "LoadTable", "Loads", "Mass", "Moment", "Motion", "Number", "Pair", "Placement",
           "Presentation", "Run", "Scene", "Slide", "SlidingDrive", "TurningDrive", "Units", "Written"]


@dataclass(frozen=True)
class Placement:
    """How a point was placed: `how` is given, polar, compass, arc-line or on-line; `data` is the entry as written."""

    how: str
    data: dict[str, object] = field(default_factory=dict)


@dataclass(frozen=True)
class Find:
    """What is asked for: names of points; joints and slides (such as `3 along 2`) whose reactions are wanted; links
    whose rates and slides whose velocities and accelerations are wanted; pairs of links (such as `2 frame`) whose
    instant centres are; points on links (such as `M on 2`), the curvature of whose paths is wanted, and links whose
    inflection circle is.

    None where nothing is said of them: then all reactions are found where there are loads, the rates of links of which
    two points are asked for, and the sliding of pairs whose point is asked for. `by_default` says that the scene has no
    [find].
    """

    velocity: tuple[str, ...]
    acceleration: tuple[str, ...]
    reactions: tuple[str, ...] | None = None
    links: tuple[str, ...] | None = None
    slides: tuple[str, ...] | None = None
    poles: tuple[str, ...] = ()
    curvature: tuple[str, ...] = ()
    inflection: tuple[str, ...] = ()
    by_default: bool = field(default=False, compare=False)

    @property
    def traced(self) -> dict[str, tuple[str, str]]:
        """The points on links the curvature of whose paths is asked for, by name: M on 2."""
        return {name: (point, link) for name in self.curvature for point, _, link in [name.partition(" on ")]}


@dataclass(frozen=True)
class Mass:
    """A link's mass, its inertia about the centre of mass (mass * m^2), and that centre, a point of the link."""

    mass: Number
    inertia: Number
    centre: str


@dataclass(frozen=True)
class Force:
    """A given force on a link, at a point of it: `value` in this pose.

    One that changes over the cycle has a `table` of its values along `direction`, of any length, which is fixed in the
    plane, or turns with the two points that it goes `through`.
    """

    on: str
    at: str
    value: Pair
    table: LoadTable | None = None
    direction: Pair | None = None
    through: tuple[str, str] | None = None


@dataclass(frozen=True)
class Moment:
    """A given couple on a link, in force * m, counter-clockwise positive: `value` in this pose, and the `table` of one
    that changes over the cycle."""

    on: str
    value: Number
    table: LoadTable | None = None


@dataclass(frozen=True)
class Balance:
    """The unknown that keeps the prescribed motion: a moment on `link`, or a force at its point `at` along `direction`.

    The direction has any length, and is written as a slide's is; only where there is none it is a moment. It acts from
    the frame, or from the link `on`, which has its counterpart.
    """

    link: str
    at: str = ""
    direction: Pair | None = None
    written: Written = field(default=None, compare=False)
    on: str = FRAME

    def __hash__(self) -> int:
        return hash((self.link, self.at, self.on))  # fractions take long

    @property
    def links(self) -> tuple[str, str]:
        """The link on which it acts, and the one from which it does."""
        return self.link, self.on

    @property
    def spellings(self) -> tuple[str, str, str]:
        """Its names, each longer than the one before: by the link, by a force's point, and by its direction, too."""
        if self.direction is None:
            return self.link, self.link, self.link
        dx, dy = map(float, self.direction)
        return self.link, f"{self.link} at {self.at}", f"{self.link} at {self.at} along ({dx:g}, {dy:g})"

    def states(self, scene: Scene) -> Iterator[Statement]:
        """What would stand still if it were a support: a turning, or a motion along its direction."""
        if self.direction is None:
            yield Turning(self.link, self.on)
        else:
            yield Along(self.link, self.on, self.at, self.direction, "held")


@dataclass(frozen=True)
class Friction:
    """Friction in a pair, with its coefficient: a journal `at` a joint, with its radius, a slide (link, along), or a
    contact of two links."""

    at: str
    slide: tuple[str, str] | None
    radius: Number
    coefficient: Number
    contact: tuple[str, str] | None = None

    @property
    def links(self) -> tuple[str, ...]:
        """The links of a slide or a contact."""
        return self.slide or self.contact or ()


@dataclass(frozen=True)
class Loads:
    """What acts on the links besides each other: gravity is in m/s^2, all else in the scene's units.

    `rounds` is how many rounds of friction are asked for; 0 means as many as it takes. `resting` are the names of the
    pairs that are known to stand still: nothing rubs in them.
    """

    gravity: Pair
    masses: dict[str, Mass]
    forces: tuple[Force, ...]
    moments: tuple[Moment, ...]
    balances: tuple[Balance, ...]
    frictions: tuple[Friction, ...] = ()
    rounds: int = 0
    resting: frozenset[str] = frozenset()

    @cached_property
    def named_balances(self) -> dict[str, Balance]:
        """The balances by their names in results: the link, or where several act on one, more of what tells them apart.
        """
        borne = Counter(name for balance in self.balances for name in dict.fromkeys(balance.spellings))
        return {next((name for name in balance.spellings if borne[name] == 1), balance.spellings[-1]): balance
                for balance in self.balances}


@dataclass(frozen=True)
class Extreme:
    """An extreme position, `outer` or `inner`, of a `link` that a `coupler` on a crank swings: they lie in one line.

    The crank turns about its `pivot`; the coupler is on its `pin`, and the link on the coupler's other `joint`.
    `time_ratio`: of the crank's turns from one extreme position to the other the larger over the smaller, if known.
    """

    way: str
    link: str
    coupler: str
    pivot: str
    pin: str
    joint: str
    time_ratio: float | None = None


@dataclass(frozen=True)
class Assembly:
    """What a pose is put together from: the links of a scene as they are `given`, moved on by the `travels` of its
    drives (degrees, or lengths of one that slides), each in its own sense.

    `shifts` are the same counter-clockwise, or along the direction, of the drives of the given scene: links that gears
    turn have drives there in their place. `moves` says that in the given scene's numbers: the cosine and sine of a
    turning drive's shift, the vector of a sliding one's. `riding` are points that only mark the place under a sliding
    point, each with that point. `extreme` is the extreme position that the pose is, where such was asked for.
    """

    given: Scene
    travels: tuple[Fraction, ...]
    shifts: tuple[Fraction, ...]
    moves: tuple[Pair, ...]
    riding: dict[str, str] = field(default_factory=dict)
    extreme: Extreme | None = None


@dataclass(frozen=True)
class Scene:
    """A mechanism in a pose and what is asked of it; made by :func:`graphplan.load`, validated there.

    `points` are coordinates (x, y); `links` lists the points of each link, `frame` among them where there is one.
    `written` are the pairs that are written as such, drives among them: joints are points that links share.
    `irrational` says, for each value that fractions cannot hold, where it stands in the scene and why. `loads` is None
    where no forces are asked for. `flywheel` and `run` say what is asked of the machine over its cycle, if anything is.
    `sheet` is how its sheet should look. `text` is the scene as it was written, `vary`
    the values that some of its numbers have in variants, by path.
    `assembly` is what its pose is constructed from, where that is not given.
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
    written: tuple[KinematicPair, ...]
    motions: dict[str, Motion]
    find: Find
    irrational: tuple[str, ...] = ()
    loads: Loads | None = None
    flywheel: Flywheel | None = None
    run: Run | None = None
    sheet: Presentation = field(default_factory=Presentation)
    text: str = field(default="", repr=False, compare=False)
    redundant: tuple[Condition, ...] = ()
    repeating: tuple[Condition, ...] = ()
    vary: dict[str, tuple[Fraction, ...]] = field(default_factory=dict, repr=False)
    assembly: Assembly | None = field(default=None, repr=False)

    @property
    def moving(self) -> tuple[str, ...]:
        """The links that are not the frame, in the scene's order."""
        return tuple(link for link in self.links if link != FRAME)

    @cached_property
    def extent(self) -> float:
        """The extent of the mechanism, across or upwards."""
        xs, ys = zip(*((float(x), float(y)) for x, y in self.points.values()), strict=True)
        return max(max(xs) - min(xs), max(ys) - min(ys)) or 1.0

    def link_pair(self, name: str) -> tuple[str, str]:
        """The two links that a name such as `2 frame` is made of."""
        return next(pair for pair in permutations((*self.links, FRAME), 2) if " ".join(pair) == name)

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
        joints = (f"{link} at {joint.at}" for joint in self.revolutes for link in joint.links[1:]
                  if not found.isdisjoint(f"{k} at {joint.at}" for k in (joint.links if link == FRAME else (link,))))
        return (*joints, *(pair.name for pair in self.guided if pair.name in found))

    @cached_property
    def links_of(self) -> dict[str, tuple[str, ...]]:
        """For each point, the links that name it, in the scene's order."""
        found: dict[str, list[str]] = {point: [] for point in self.points}
        for link, points in self.links.items():
            for point in points:
                found[point].append(link)
        return {point: tuple(links) for point, links in found.items()}

    @cached_property
    def pairs(self) -> tuple[KinematicPair, ...]:
        """Every kinematic pair: the joints, what is written, drives last, and the points whose motion is given."""
        undriven = (pair for pair in self.written if not isinstance(pair, Drive))
        points = (DrivenPoint(point, self.links_of[point][0], motion) for point, motion in self.motions.items())
        return *self.revolutes, *undriven, *self.drives, *points

    @property
    def binding(self) -> Iterator[KinematicPair]:
        """The pairs that drive nothing."""
        return (pair for pair in self.pairs if not isinstance(pair, Drive | DrivenPoint))

    @cached_property
    def revolutes(self) -> tuple[Revolute, ...]:
        """The points that more than one link names, in the scene's order: the revolute pairs."""
        return tuple(Revolute(point, links) for point, links in self.links_of.items() if len(links) > 1)

    @cached_property
    def joints(self) -> tuple[str, ...]:
        """The points of the revolute pairs."""
        return tuple(pair.at for pair in self.revolutes)

    @cached_property
    def slides(self) -> tuple[Slide, ...]:
        """The pairs with a guide."""
        return tuple(pair for pair in self.written if isinstance(pair, Slide))

    @cached_property
    def gears(self) -> tuple[Gear, ...]:
        """The links that are geared with each other."""
        return tuple(pair for pair in self.written if isinstance(pair, Gear))

    @cached_property
    def contacts(self) -> tuple[Contact, ...]:
        """The links that touch each other."""
        return tuple(pair for pair in self.written if isinstance(pair, Contact))

    def turning_alike(self, link: str) -> tuple[str, ...]:
        """The links that turn as one does by the slides between them, itself first."""
        found = [link]
        for one in found:
            found += {other for slide in self.slides if slide.turns_alike and one in slide.links
                      for other in slide.links} - {*found}
        return tuple(found)

    @property
    def guided(self) -> tuple[Slide | Gear | Contact, ...]:
        """The pairs that may have a direction."""
        return *self.slides, *self.gears, *self.contacts

    @cached_property
    def drives(self) -> tuple[Drive, ...]:
        """The drives."""
        return tuple(pair for pair in self.written if isinstance(pair, Drive))

    def with_drives(self, drives: Iterable[Drive]) -> Scene:
        """The scene with other drives."""
        return replace(self, written=(*(pair for pair in self.written if not isinstance(pair, Drive)), *drives))

    def driven_slide(self, drive: Drive) -> Slide:
        """The slide in which a sliding drive works."""
        return next(slide for slide in self.slides if {*slide.links} == {*drive.links})

    def balance_of(self, drive: Drive) -> Balance:
        """What a drive does: a moment on its link, or the force along its slide, from the other link of the drive."""
        if not drive.slides:
            return Balance(drive.link, on=drive.on)
        slide = self.driven_slide(drive)
        return Balance(slide.link, slide.at, slide.direction, slide.written, slide.along)

    def posed(self, points: dict[str, Any], direction: Callable[[Any], Any],
              length: Callable[[Any], Any] = lambda radius: radius) -> Scene:
        """The scene in another pose, or in other numbers: its points, the direction of each guide and balance, and by
        `length` the radii of its gears. A balance between two moving links keeps to the guide that it drives."""
        def directed(one: Any) -> Any:
            one = one.scaled(length) if isinstance(one, Gear) else one
            return replace(one, direction=direction(one)) if getattr(one, "direction", None) is not None else one

        written = tuple(map(directed, self.written))
        guides = {frozenset(pair.links): pair.direction for pair in written if isinstance(pair, Slide)}

        def balanced(one: Balance) -> Balance:
            guide = guides.get(frozenset(one.links)) if one.at and one.on != FRAME else None
            return directed(one) if guide is None else replace(one, direction=guide)

        loads = self.loads and replace(self.loads, balances=tuple(map(balanced, self.loads.balances)))
        return replace(self, points=points, written=written, loads=loads)
