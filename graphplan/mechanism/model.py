"""What is given: a mechanism in one pose, as frozen plain data.

`"O A"` is the distance of two points of a link, `"3 along frame"` how far the guide of that slide lies to the left of
where it is, `"A B C"` the angle at B between BA and BC, of three points of a link, in degrees.

Numbers are :class:`fractions.Fraction` wherever the scene is rational, exactly as written, and floats where a
placement or a rate is not (polar and compass placements, rpm). Lengths and rates are in the scene's own units,
angles in radians, counter-clockwise positive.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from itertools import permutations
from typing import Any, NamedTuple, NoReturn, TypeVar, cast

from graphplan.mechanism.fields import (
    AMOUNT,
    NUMBER,
    TEXT,
    Field,
    Kind,
    Named,
    SceneItem,
    SceneNames,
    Table,
    TableRow,
    Written,
)
from graphplan.mechanism.loads import Balance, Force, Friction, Loads, LoadTable, Mass, Moment, Wedge
from graphplan.mechanism.numbers import Number, Pair
from graphplan.mechanism.pairs.contact import Contact
from graphplan.mechanism.pairs.drives import Drive, DrivenPoint, Motion, SlidingDrive, TurningDrive
from graphplan.mechanism.pairs.gear import Gear
from graphplan.mechanism.pairs.pair import FRAME, Condition, FrameName, KinematicPair
from graphplan.mechanism.pairs.revolute import Revolute
from graphplan.mechanism.pairs.sliding import Slide
from graphplan.mechanism.units import Units

K = TypeVar("K")
V = TypeVar("V")


class Frozen(dict[K, V]):
    """A dictionary that cannot be changed; `|` and `{**...}` make new ones."""

    def _refuse(self, *args: object, **named: object) -> NoReturn:
        raise TypeError(f"{type(self).__name__} cannot be changed: make another, such as by scene.replace(path, value)")

    __setitem__ = __delitem__ = _refuse
    __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self),)


class NamedValues(Frozen[str, V]):
    """Results by name; a name that was not asked for but stands still has the value of the `fixed`.

    Any other name is a `KeyError` that says which were asked for.
    """

    def __init__(self, asked: dict[str, V], what: str = "result", fixed: Collection[str] = (), zero: V | None = None):
        super().__init__(asked)
        self.what, self.fixed, self.zero = what, frozenset(fixed), zero

    def __missing__(self, name: str) -> V:
        if name in self.fixed:
            return cast(V, self.zero)
        raise KeyError(f"the {self.what} of {name} was not asked for, but of {', '.join(self) or 'nothing'}")

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self), self.what, self.fixed, self.zero)


@dataclass(frozen=True)
class NamedDimension:
    """A dimension by its name: of `link` between two or three of its `points`, or the offset of the guide of a `slide`.
    """

    name: str
    link: str
    points: tuple[str, ...] = ()
    slide: Slide | None = None

    @property
    def is_angle(self) -> bool:
        """Whether it is an angle, in degrees."""
        return len(self.points) == 3


def dimension(name: str, links: Mapping[str, tuple[str, ...]], pairs: Iterable[KinematicPair]) -> NamedDimension | None:
    """The dimension of this name among links and pairs; None if it does not exist."""
    for pair in pairs:
        if isinstance(pair, Slide) and pair.name == name:
            return NamedDimension(name, pair.along, slide=pair)
    points = tuple(name.split())
    links_with = [link for link, own in links.items() if {*points} <= {*own}]
    exists = links_with and len({*points}) == len(points) in (2, 3)
    return NamedDimension(name, links_with[0], points) if exists else None


def _check_dimension(name: str, item: SceneItem, names: SceneNames) -> None:
    """A fault where a name is that of no dimension."""
    if item.faults.none_in("links", "slides") and dimension(name, names.links, names.pairs) is None:
        item.fault(f"{name} is no dimension of a link", 'two points of a link, such as "O A", three for the angle at '
                   'the second, or a slide, such as "3 along frame", for the offset of its guide')


TOLERANCES = Named(AMOUNT, TEXT, _check_dimension)


@dataclass(frozen=True)
class Extreme:
    """An extreme position of a `link`, `outer` or `inner`.

    Where a `coupler` on a crank swings it, they lie in one line: the crank turns about its `pivot`; the coupler is on
    its `pin`, and the link on the coupler's other `joint`.
    `time_ratio`: of the crank's turns from one extreme position to the other the larger over the smaller, if known.
    """

    way: str
    link: str
    coupler: str = ""
    pivot: str = ""
    pin: str = ""
    joint: str = ""
    time_ratio: float | None = None


MAX_CYLINDERS = 64


@dataclass(frozen=True)
class Cylinders:
    """Equal cylinders in line: the `angles` of their cranks in degrees, counted from the crank of the scene, and their
    `places` along the shaft, in the scene's lengths."""

    angles: tuple[Fraction, ...]
    places: tuple[Fraction, ...]


def _numbers(item: SceneItem, names: SceneNames) -> tuple[Fraction, ...] | None:
    values = item.value if isinstance(item.value, list) else []
    if not 1 <= len(values) <= MAX_CYLINDERS:
        return item.fault("not a list of numbers, one for each cylinder", f"1 to {MAX_CYLINDERS}, such as [0, 180]")
    numbers = tuple(item.with_value(value).number() for value in values)
    return None if None in numbers else numbers  # type: ignore[return-value]


def _cylinders(row: TableRow) -> Any:
    angles, places = row["angles"], row["places"]
    if len(angles) != len(places):
        return row.items["places"].fault(f"{len(places)} places of {len(angles)} cranks", "a place for each crank")
    return Cylinders(angles, places)


NUMBERS = Kind("list of numbers", _numbers, {"type": "array", "items": NUMBER.schema, "minItems": 1,
                                             "maxItems": MAX_CYLINDERS})
CYLINDERS = Table("equal cylinders in line", (
    Field("angles", "the angles of their cranks in degrees, from the crank of the scene", NUMBERS,
          "an angle for each cylinder, such as angles = [0, 180, 180, 0]"),
    Field("places", "their places along the shaft, in the scene's lengths", NUMBERS,
          "a place for each cylinder, such as places = [0, 100, 200, 300]"),
), _cylinders)


@dataclass(frozen=True)
class Governor:
    """A governor: the links whose masses revolve as `balls` about an `axis` through two points of the frame, between
    which travels of the first drive it works, and the `speed` of its spindle in rad/s."""

    balls: tuple[str, ...]
    axis: tuple[str, str]
    between: Pair
    speed: Number | None = None


T = TypeVar("T", bound=KinematicPair)

__all__ = ["FRAME", "Assembly", "Balance", "Condition", "Contact", "Drive", "Extreme", "Find", "Flywheel", "Force",
           "Friction", "Gear", "LinkPoints", "LoadTable", "Loads", "Mass", "Moment", "Motion", "Number", "Pair",
           "Placement", "Presentation", "RunRequest", "Scene", "Slide", "SlidingDrive", "TurningDrive", "Units",
           "Wedge", "Written"]


class LinkPoints(NamedTuple):
    """Two points of a link."""

    link: str
    points: tuple[str, str]


@dataclass(frozen=True)
class Presentation:
    """The sheet that a scene asks for: texts that are empty, and scales that are None, are left to graphplan.

    `plan`, `method`, `inertia`, `rounds`, `strict`, `prefer` and `pencil` are how plans are drawn, such as polar, or by
    trial, `protocol` is where the words stand; `task` are a teacher's own words; `k_s`,
    `k_v`, `k_a` and `k_F` are what a millimetre of paper stands for, in the scene's units; `multiples` are by how much
    other plans are larger than the mechanism's; `auxiliary` are the auxiliary points by their letters, each with the
    links of which it is a point and the points of these whose loci give it; `time_scale` is how long a speed of one is
    drawn, `by_crank` whether so that a crank's is as long as the crank, `force_scale` a force of one, `ways` which of
    several ways on is taken at each ring of links, `force_way` what comes first in force plans and where a trial
    begins; by `convention` scales are told as real per drawn, or as drawn per real. `student`, `group` and `variant`
    are whose task it is in a class, and its number.
    """

    paper: str = ""
    frame: str = "iso"
    owner: str = ""
    number: str = ""
    date: str = ""
    drawn_by: str = "graphplan"
    approved_by: str = ""
    language: str = "en"
    plan: str = ""
    method: str = ""
    inertia: str = ""
    rounds: int = 0
    strict: bool = False
    prefer: str = ""
    pencil: str = ""
    protocol: str = ""
    task: str = ""
    k_s: Fraction | None = None
    k_v: Fraction | None = None
    k_a: Fraction | None = None
    k_F: Fraction | None = None  # noqa: N815
    multiples: dict[str, Fraction] = field(default_factory=dict)
    auxiliary: dict[str, tuple[LinkPoints, ...]] = field(default_factory=dict)
    time_scale: Fraction | None = None
    by_crank: bool = False
    force_scale: Fraction | None = None
    ways: tuple[int, ...] = ()
    force_way: tuple[str, int] | None = None
    convention: str = "real"
    curves: tuple[str, ...] = ()
    centrodes: tuple[str, ...] = ()
    cubics: tuple[str, ...] = ()
    positions: int = 0
    student: str = ""
    group: str = ""
    variant: str = ""

    @property
    def kappa(self) -> Fraction | None:
        """Drawn length of a unit speed, if it is given or two of the scales of lengths, velocities and accelerations
        determine it."""
        if self.k_s and self.k_v:
            return self.k_s / self.k_v
        return self.k_v / self.k_a if self.k_v and self.k_a else self.time_scale

    @property
    def phi(self) -> Fraction | None:
        """Drawn length of a unit force, if it is given or the scales of lengths and forces determine it."""
        return self.k_s / self.k_F if self.k_s and self.k_F else self.force_scale

    @property
    def shows_motion(self) -> bool:
        """Whether more is shown than the pose that is given."""
        return bool(self.curves or self.positions or self.centrodes or self.cubics)


@dataclass(frozen=True)
class Flywheel:
    """A flywheel that is asked for: the mean `speed` of the first drive (rad/s, or lengths/s), and the allowed
    fluctuation.

    `unevenness` is (omega_max - omega_min) / mean, the mean being half their sum; or the `inertia` (mass * m^2) is
    given and the unevenness asked for. A constant moment on the drive `closes` the cycle, or the loads that change are
    scaled by a constant ("load").
    """

    speed: Number
    unevenness: Fraction | None = None
    inertia: Fraction | None = None
    closes: str = "drive"


@dataclass(frozen=True)
class RunRequest:
    """The request for a true motion: the initial `speed` of the first drive (rad/s, or lengths/s), the `travel` to
    follow it over (degrees, or lengths), and whether it ends at rest (`stops`); None if not given."""

    speed: Number | None = None
    travel: Fraction | None = None
    stops: bool = False


@dataclass(frozen=True)
class Placement:
    """The rule by which a point was placed: `how` is given, polar, compass, arc-line or on-line; `data` is the entry as
    written."""

    how: str
    data: dict[str, object] = field(default_factory=dict)


@dataclass(frozen=True)
class Find:
    """Names of all results that are asked for.

    Points by `velocity` and `acceleration`; joints and slides (such as `3 along 2`) by `reactions`; links whose rates
    and slides whose velocities and accelerations are wanted; links whose `omega` is, without their alpha; pairs of
    links (such as `2 frame`) whose instant centres are; points on links (such as `M on 2`), the curvature of whose
    paths is wanted, and links whose inflection circle is, or whose point without acceleration. None if the scene does
    not say: then all reactions are found where there are loads, the rates of links of which two points are asked for,
    and the sliding of pairs whose point is asked for. `by_default` says that the scene has no [find].
    """

    velocity: tuple[str, ...]
    acceleration: tuple[str, ...]
    reactions: tuple[str, ...] | None = None
    links: tuple[str, ...] | None = None
    slides: tuple[str, ...] | None = None
    omega: tuple[str, ...] = ()
    poles: tuple[str, ...] = ()
    curvature: tuple[str, ...] = ()
    inflection: tuple[str, ...] = ()
    acceleration_centres: tuple[str, ...] = ()
    by_default: bool = field(default=False, compare=False)

    @property
    def turning(self) -> tuple[str, ...]:
        """The links whose angular velocities are asked for by name."""
        return tuple(dict.fromkeys((*(self.links or ()), *self.omega)))

    @property
    def asks_motion(self) -> bool:
        """Whether anything but reactions is asked for."""
        return any((self.velocity, self.acceleration, self.turning, self.slides, self.poles, self.curvature,
                    self.inflection, self.acceleration_centres))

    @property
    def curvature_points(self) -> dict[str, tuple[str, str]]:
        """The points on links the curvature of whose paths is asked for, by name: M on 2."""
        return {name: (point, link) for name in self.curvature for point, _, link in [name.partition(" on ")]}


@dataclass(frozen=True)
class Assembly:
    """The links of a scene as they are `given`, from which a pose is assembled, and the `travels` of its drives
    (degrees, or lengths of a sliding one), each in its own sense.

    `shifts` are the same counter-clockwise, or along the direction, of the drives of the given scene: links that gears
    turn have drives there in their place. `moves` says that in the given scene's numbers: the cosine and sine of a
    turning drive's shift, the vector of a sliding one's. `riding` are points that only mark the place under a sliding
    point, each with that point. `extreme` is the extreme position that the pose is, where such was asked for.
    """

    given_scene: Scene
    travels: tuple[Fraction, ...]
    shifts: tuple[Fraction, ...]
    moves: tuple[Pair, ...]
    riding: dict[str, str] = field(default_factory=dict)
    extreme: Extreme | None = None


@dataclass(frozen=True, repr=False)
class Scene:
    """A mechanism in a pose and what is asked of it; made by :func:`graphplan.load`, validated there.

    `points` are coordinates (x, y); `links` lists the points of each link, `frame` among them where there is one.
    `written` are the pairs that are written as such, drives among them: joints are points that links share.
    `irrational` says, for each value that fractions cannot hold, where it stands in the scene and why. `loads` is None
    where no forces are asked for. `flywheel` and `run` say what is asked of the machine over its cycle, if anything is.
    `sheet` is how its sheet should look. `text` is the scene as it was written, `vary`
    the values that some of its numbers have in variants, by path.
    `assembly` is what its pose is constructed from, where that is not given; `tolerances` are those of dimensions, by
    their names.
    `frame_name` is what it calls the fixed link; `unused_loads` are the tables of loads that nothing asks for.
    `repetitions` are the conditions without which the mechanism moves just the same, by its special geometry, each
    with those that it repeats: which of them carry the forces nothing tells.
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
    run: RunRequest | None = None
    cylinders: Cylinders | None = None
    governor: Governor | None = None
    sheet: Presentation = field(default_factory=Presentation)
    text: str = field(default="", repr=False, compare=False)
    repetitions: Mapping[Condition, tuple[Condition, ...]] = field(default_factory=dict)
    vary: dict[str, tuple[Fraction, ...]] = field(default_factory=dict, repr=False)
    assembly: Assembly | None = field(default=None, repr=False)
    tolerances: dict[str, Fraction] = field(default_factory=dict, repr=False)
    frame_name: str = FRAME
    unused_loads: tuple[str, ...] = ()

    @classmethod
    def without_mechanism(cls, source: Any, title: str = "") -> Scene:
        """The title, the units and the sheet of a scene or a task."""
        return cls(title or source.title, source.source, source.name, source.units, {}, {}, {}, (), {}, Find((), ()),
                   sheet=source.sheet, text=getattr(source, "text", ""))

    def __repr__(self) -> str:
        return f"<Scene {self.title or self.name}: {len(self.links)} links, {len(self.points)} points>"

    @property
    def frame(self) -> str:
        """The fixed link, by its name."""
        return FRAME if self.frame_name == FRAME else FrameName(self.frame_name)

    @cached_property
    def moving(self) -> tuple[str, ...]:
        """The links that are not the frame, in the scene's order."""
        return tuple(link for link in self.links if link != FRAME)

    @cached_property
    def extent(self) -> float:
        """Extent of the mechanism in scene lengths: the larger of width and height."""
        places = [(float(x), float(y)) for x, y in self.points.values()] or [(0.0, 0.0)]
        xs, ys = zip(*places, strict=True)
        return max(max(xs) - min(xs), max(ys) - min(ys)) or 1.0

    def link_pair(self, name: str) -> tuple[str, str]:
        """The two links that a name such as `2 frame` is made of."""
        return next(pair for pair in permutations((*self.moving, self.frame), 2) if " ".join(pair) == name)

    @property
    def redundant(self) -> tuple[Condition, ...]:
        """The conditions that only repeat what others state."""
        return tuple(self.repetitions)

    @property
    def repeating(self) -> tuple[Condition, ...]:
        """All conditions that follow from others of them."""
        return tuple(dict.fromkeys(c for last, others in self.repetitions.items() for c in (*others, last)))

    @property
    def redundant_pairs(self) -> tuple[str, ...]:
        """The names of the pairs that are redundant, such as `4 at D`, or of which a condition is."""
        return tuple(dict.fromkeys(condition.pair for condition in self.redundant))

    @property
    def indeterminate_pairs(self) -> tuple[str, ...]:
        """The names of the pairs whose reactions are statically indeterminate, each by the link that has the reaction.

        The frame has the opposite of all other links' forces.
        """
        repeating = {condition.pair for condition in self.repeating}
        joints = (f"{link} at {joint.at}" for joint in self.revolutes for link in joint.links[1:]
                  if not repeating.isdisjoint(f"{k} at {joint.at}"
                                              for k in (joint.links if link == FRAME else (link,))))
        return (*joints, *(pair.name for pair in self.directed_pairs if pair.name in repeating))

    @cached_property
    def links_of(self) -> dict[str, tuple[str, ...]]:
        """For each point, the links that name it, in the scene's order."""
        links: dict[str, list[str]] = {point: [] for point in self.points}
        for link, points in self.links.items():
            for point in points:
                links[point].append(link)
        return {point: tuple(names) for point, names in links.items()}

    @cached_property
    def pairs(self) -> tuple[KinematicPair, ...]:
        """Every kinematic pair: the joints, what is written, drives last, and the points whose motion is given."""
        undriven = (pair for pair in self.written if not isinstance(pair, Drive))
        points = (DrivenPoint(point, self.links_of[point][0], motion) for point, motion in self.motions.items())
        return *self.revolutes, *undriven, *self.drives, *points

    @property
    def binding(self) -> Iterator[KinematicPair]:
        """The pairs without a drive."""
        return (pair for pair in self.pairs if not isinstance(pair, Drive | DrivenPoint))

    @cached_property
    def revolutes(self) -> tuple[Revolute, ...]:
        """The points that more than one link names, in the scene's order: the revolute pairs."""
        return tuple(Revolute(point, links) for point, links in self.links_of.items() if len(links) > 1)

    @property
    def joints(self) -> tuple[str, ...]:
        """The points of the revolute pairs."""
        return tuple(pair.at for pair in self.revolutes)

    def _written_as(self, kind: type[T]) -> tuple[T, ...]:
        """The pairs of a kind, in the order in which they are written."""
        return tuple(pair for pair in self.written if isinstance(pair, kind))

    @property
    def slides(self) -> tuple[Slide, ...]:
        """The pairs with a guide."""
        return self._written_as(Slide)

    @property
    def gears(self) -> tuple[Gear, ...]:
        """The links that are geared with each other."""
        return self._written_as(Gear)

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """The links that touch each other."""
        return self._written_as(Contact)

    def across_link(self, link: str, places: Mapping[str, tuple[Any, Any]]) -> tuple[Any, Any]:
        """Perpendicular to a link that is a bar between two joints; of any other link along x."""
        joints = [places[point] for point in self.links[link] if point in self.joints]
        (ax, ay), (bx, by) = joints if len(joints) == 2 else ((0, 0), (0, 0))
        return (ay - by, bx - ax) if (ax, ay) != (bx, by) else (1, 0)

    def turning_alike(self, link: str) -> tuple[str, ...]:
        """The links that turn as one does by the slides between them, itself first."""
        alike = [link]
        for turning in alike:
            alike += {neighbour for slide in self.slides if slide.turns_alike and turning in slide.links
                      for neighbour in slide.links} - {*alike}
        return tuple(alike)

    @property
    def directed_pairs(self) -> tuple[Slide | Gear | Contact, ...]:
        """The pairs that may have a direction."""
        return *self.slides, *self.gears, *self.contacts

    @property
    def drives(self) -> tuple[Drive, ...]:
        """The drives."""
        return self._written_as(Drive)

    def with_drives(self, drives: Iterable[Drive]) -> Scene:
        """The scene with other drives."""
        return replace(self, written=(*(pair for pair in self.written if not isinstance(pair, Drive)), *drives))

    def driven_slide(self, drive: Drive) -> Slide:
        """The slide in which a sliding drive works."""
        return next(slide for slide in self.slides if {*slide.links} == {*drive.links})

    def balance_of(self, drive: Drive) -> Balance:
        """The unknown load of a drive: a moment on its link, or the force along its slide, from the other link of the
        drive."""
        if not drive.slides:
            return Balance(drive.link, on=drive.on)
        slide = self.driven_slide(drive)
        return Balance(slide.link, slide.at, slide.direction, slide.written, slide.along)

    def with_pose(self, points: dict[str, Any], direction: Callable[[Any], Any],
                  length: Callable[[Any], Any] = lambda radius: radius) -> Scene:
        """The scene in another pose, or in other numbers: its points, the direction of each guide and balance, and by
        `length` the radii of its gears. A balance between two moving links keeps to the guide that it drives."""
        def with_direction(pair: Any) -> Any:
            pair = pair.with_lengths(length) if isinstance(pair, Gear) else pair
            return replace(pair, direction=direction(pair)) if getattr(pair, "direction", None) is not None else pair

        written = tuple(map(with_direction, self.written))
        guides = {frozenset(pair.links): pair.direction for pair in written if isinstance(pair, Slide)}

        def with_guide(balance: Balance) -> Balance:
            guide = guides.get(frozenset(balance.links)) if balance.at and balance.on != FRAME else None
            return with_direction(balance) if guide is None else replace(balance, direction=guide)

        loads = self.loads and replace(self.loads, balances=tuple(map(with_guide, self.loads.balances)))
        return replace(self, points=points, written=written, loads=loads)
