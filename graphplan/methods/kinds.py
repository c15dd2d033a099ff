"""The kinds of results: how each is called, its dimension, what it counts for."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Self

from graphplan.mechanism import units
from graphplan.mechanism.model import Balance
from graphplan.phrases import said

BY_PLANS, BY_LEVER, RUBBED = "balance", "lever", "with friction"  # how a balance is found
FORCES, POLES, CURVES = "force", "poles", "curvature"  # groups of what is no motion


class ResultKind(str):
    """A kind of result by its public name: it knows its words, its dimension and what it is read of.

    `pair` says that it is of a pair, and not of a point, a link or a balance; `way` how a balance was found; `place`
    to which group of places on the mechanism plan it belongs, if to any: as one, or as what tells of one at infinity.
    As JSON it stands in a `table` by the name of what it is of, there under a `key`; some are printed otherwise.
    """

    words: str
    dimension: units.Dimension
    pair: bool
    way: str
    place: str
    table: str
    key: str

    def __new__(cls, words: str, dimension: units.Dimension, *, pair: bool = False, way: str = "",
                place: str = "", printed: str = "") -> Self:
        self = super().__new__(cls, words)
        self.words, self.dimension, self.pair, self.way, self.place = words, dimension, pair, way, place
        self.table, _, self.key = printed.partition(".")
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return kind_of, (str(self),)

    @property
    def group(self) -> str:
        """Group of the kind: velocity, acceleration, places of its kind, or force."""
        return self.place or {-1: VELOCITY, -2: ACCELERATION}.get(self.dimension.time, FORCES)

    @property
    def single(self) -> bool:
        """Whether it is one number; else it is a vector."""
        return self.dimension in (units.TURNING, units.TURNING_FASTER, units.MOMENT, units.INERTIA)

    @property
    def turning(self) -> bool:
        """Whether it is the rate of a link."""
        return self.dimension in (units.TURNING, units.TURNING_FASTER)

    def arm(self, reach: Any, scene: units.Units) -> Any:
        """At which arm it counts among its group: turnings with what they make at the mechanism's reach, moments as
        the forces that they are there, headings with how far they lead, and curvatures with how far that strays."""
        if self.dimension in (units.MOMENT, units.CURVING):
            return units.metre(scene) / reach if self.dimension == units.MOMENT else reach * reach
        return reach if self.turning or self.dimension == units.HEADING else 1


VELOCITY = ResultKind(said("velocity"), units.SPEED, printed="points.velocity")
ACCELERATION = ResultKind(said("acceleration"), units.ACCELERATING, printed="points.acceleration")
OMEGA = ResultKind(said("omega"), units.TURNING, printed="links.omega")
ALPHA = ResultKind(said("alpha"), units.TURNING_FASTER, printed="links.alpha")
SLIDE_VELOCITY = ResultKind(said("slide velocity"), units.SPEED, pair=True, printed="slides.velocity")
SLIDE_ACCELERATION = ResultKind(said("slide acceleration"), units.ACCELERATING, pair=True,
                                printed="slides.acceleration")
REACTION = ResultKind(said("reaction"), units.FORCE, pair=True)
SLIDE_REACTION = ResultKind(said("slide reaction"), units.FORCE, pair=True)
SLIDE_MOMENT = ResultKind(said("slide moment"), units.MOMENT, pair=True)
SLIDE_ARM = ResultKind(said("slide arm"), units.LENGTH, pair=True)
POLE = ResultKind(said("pole"), units.PLACE, place=POLES, printed="poles.at")
POLE_HEADING = ResultKind(said("heading to a pole"), units.HEADING, place=POLES,  # of one at infinity
                          printed="poles.direction")
GEAR_REACTION = ResultKind(said("gear reaction"), units.FORCE, pair=True)
CONTACT_REACTION = ResultKind(said("contact reaction"), units.FORCE, pair=True)
SCREW = ResultKind(said("screw moment"), units.MOMENT, pair=True)
REACTIONS = REACTION, SLIDE_REACTION, GEAR_REACTION, CONTACT_REACTION
WITH_FRICTION: Mapping[str, ResultKind] = {
    REACTION: ResultKind(said("reaction with friction"), units.FORCE, pair=True),
    SLIDE_REACTION: ResultKind(said("slide reaction with friction"), units.FORCE, pair=True),
    SLIDE_MOMENT: ResultKind(said("slide moment with friction"), units.MOMENT, pair=True),
    GEAR_REACTION: ResultKind(said("gear reaction with friction"), units.FORCE, pair=True),
    CONTACT_REACTION: ResultKind(said("contact reaction with friction"), units.FORCE, pair=True),
}
# Of the path of a point on a link: its centre of curvature; where that is at infinity the curvature, along the normal;
# where the point is the pole, how far the two are apart. Of a link's motion its inflection pole and its pole, both as
# places; where these are at infinity its turning.
CENTRE = ResultKind(said("centre of curvature"), units.PLACE, place=CURVES, printed="curvature.centre")
STRAIGHT = ResultKind(said("curvature"), units.CURVING, place=CURVES)
CUSP = ResultKind(said("cusp"), units.LENGTH, place=CURVES)
INFLECTION = ResultKind(said("inflection pole"), units.PLACE, place=CURVES, printed="inflection.inflection_pole")
MOTION_POLE = ResultKind(said("pole of the motion"), units.PLACE, place=CURVES, printed="inflection.pole")
TRANSLATION = ResultKind(said("translation"), units.TURNING)
ACCELERATION_CENTRE = ResultKind(said("acceleration centre"), units.PLACE, place=CURVES,  # of a link
                                 printed="acceleration_centres.at")
PATHS = CENTRE, STRAIGHT, CUSP, INFLECTION, MOTION_POLE, ACCELERATION_CENTRE
KINDS: Mapping[str, ResultKind] = {kind: kind for kind in (
    VELOCITY, ACCELERATION, OMEGA, ALPHA, SLIDE_VELOCITY, SLIDE_ACCELERATION, REACTION, SLIDE_REACTION, SLIDE_MOMENT,
    SLIDE_ARM, GEAR_REACTION, CONTACT_REACTION, *WITH_FRICTION.values(), SCREW, POLE, POLE_HEADING, *PATHS, TRANSLATION,
    ResultKind(said("balance"), units.FORCE, way=BY_PLANS),
    ResultKind(said("balance moment"), units.MOMENT, way=BY_PLANS),
    ResultKind(said("balance with friction"), units.FORCE, way=RUBBED),
    ResultKind(said("balance moment with friction"), units.MOMENT, way=RUBBED),
    ResultKind(said("lever"), units.FORCE, way=BY_LEVER), ResultKind(said("lever moment"), units.MOMENT, way=BY_LEVER),
)}
# Of a machine over its cycle, reduced to the drive: no reading of one pose, the first two of a travel in degrees.
CYCLE: Mapping[str, ResultKind] = {kind: kind for kind in (
    ResultKind(said("reduced moment"), units.MOMENT), ResultKind(said("reduced inertia"), units.INERTIA),
    ResultKind(said("closing moment"), units.MOMENT), ResultKind(said("flywheel"), units.INERTIA),
)}
# A third opinion, which is never read off a drawing.
POWER, POWER_MOMENT = ResultKind("power balance", units.FORCE), ResultKind("power balance moment", units.MOMENT)
MOTION = {VELOCITY: (VELOCITY, OMEGA, SLIDE_VELOCITY), ACCELERATION: (ACCELERATION, ALPHA, SLIDE_ACCELERATION),
          POLES: (POLE, POLE_HEADING), CURVES: PATHS}
ORDER = {kind: place for place, kind in enumerate(kind for kinds in MOTION.values() for kind in kinds)}  # as told
WORDS = {**{name: kind.words for name, kind in {**KINDS, **CYCLE}.items()}, FORCES: said("force"), POLES: said("poles"),
         CURVES: said("curvature"), "curves": said("curves"), "position": said("position")}


def kind_of(name: str) -> ResultKind:
    """The kind of this public name."""
    return KINDS.get(name) or CYCLE.get(name) or (POWER if name == POWER else POWER_MOMENT)


def balance_kind(way: str, balance: Balance) -> ResultKind:
    """The kind of a balance that is found in this way: a force or a moment."""
    return next(kind for kind in KINDS.values() if kind.way == way and kind.single != bool(balance.at))
