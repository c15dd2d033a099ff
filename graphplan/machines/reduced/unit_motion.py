"""The motion at a unit rate of the first drive: rates by its travel, from one recorded construction.

Only ratios of velocities count where masses and forces are reduced, so the first drive goes at a rate of one and the
others in pace, whatever their rates are; a scene that stands still is moved so, too (Ozols 1974, 13-2).

The construction of the given pose serves in every pose of the motion. Where it cannot be drawn in another pose, or
relies on points that coincide in its own alone, those by other forms follow, and those that are recorded in other
poses.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.cycle.pose import in_pose
from graphplan.cycle.turn import RangeOfMotion, Turn
from graphplan.errors import GraphplanError, Refused
from graphplan.mechanism.model import FRAME, Find, Scene
from graphplan.mechanism.sections import METHODS
from graphplan.mechanism.travel import sense
from graphplan.mechanism.units import METRES
from graphplan.methods import kinds
from graphplan.methods.construct import construct
from graphplan.methods.construction import Construction

# ---- recordings -----------------------------------------------------------------------------------------------------


OTHER_POSES = (0.11, 0.43, 0.79)  # of the range: poses in which constructions are recorded where no other serves

Draw = Callable[[Scene, str], Construction]
Results = dict[str, dict[str, Array]]


class Recordings:
    """The constructions of a scene over its motion, each drawn when it is first needed, by a method if one is named."""

    def __init__(self, scene: Scene, motion: RangeOfMotion, draw: Draw, compiled: bool = False):
        self.scene, self.motion, self.draw, self.compiled = scene, motion, draw, compiled
        self._drawn: dict[object, Construction | None] = {}

    def evaluate(self, turn: Turn, wanted: Collection[str] | None = None, gaps: bool = False,
                 **given: Mapping[str, Array]) -> Results:
        """The results of the wanted kinds, or of all, in the poses of a turn; with `gaps` nan where there are none.

        Else it fails with `Refused` where no construction serves in a pose.
        """
        results, why = Results(), ""
        remaining = np.arange(len(turn.travel))
        for drawing in self.constructions():
            only = None if wanted is None else [kind for kind in drawing.kinds if kind in wanted]
            if only is not None and not only:
                return results
            try:
                poses = self._poses(drawing, turn, remaining, only, given)
            except Refused as refused:
                why = str(refused)
                continue
            for kind, named in poses.results.items():
                for name, z in named.items():
                    row = results.setdefault(kind, {}).setdefault(name, np.full(len(turn.travel), np.nan, z.dtype))
                    row[remaining] = z
            torn = np.any([~np.isfinite(z) for named in poses.results.values() for z in named.values()], axis=0)
            remaining, why = remaining[torn], next(iter(poses.faults.values()), why)
            if not remaining.size:
                return results
        if gaps and results:
            return results
        raise Refused("the cycle", why, "a span of travels in which the mechanism has velocities")

    def _poses(self, drawing: Construction, turn: Turn, left: Array, only: Collection[str] | None,
               given: Mapping[str, Mapping[str, Array]]) -> Any:
        """One construction in some of the poses."""
        points, guides, *more = ({name: z[left] for name, z in values.items()}
                                 for values in (turn.points, turn.guides, *given.values()))
        return drawing.evaluate(points, guides, only=only, compiled=self.compiled,
                                **dict(zip(given, more, strict=True)))  # type: ignore[arg-type]

    def constructions(self) -> Iterator[Construction]:
        """The construction in the given pose; then by other forms, and as it is recorded in other poses."""
        for method in ("", *METHODS):
            yield from self.draw_once(method, partial(self.draw, self.scene, method))
        low, high = (float(self.motion.path.travel[end]) for end in (0, -1))
        for share in OTHER_POSES:
            turn = self.motion.turn(np.array([low + share * (high - low)]))
            if not turn.faults:
                yield from self.draw_once(share, partial(self.draw, in_pose(self.scene, turn, 0), ""))

    def draw_once(self, key: object, draw: Callable[[], Construction]) -> Iterator[Construction]:
        """A construction, unless there is none; what keeps the given pose from having one is told."""
        if key not in self._drawn:
            try:
                self._drawn[key] = draw()
            except GraphplanError:
                if key == "":
                    raise
                self._drawn[key] = None
        if drawn_pose := self._drawn[key]:
            yield drawn_pose


# ---- rates ----------------------------------------------------------------------------------------------------------


VELOCITIES = kinds.VELOCITY, kinds.OMEGA, kinds.SLIDE_VELOCITY
ACCELERATIONS = kinds.ACCELERATION, kinds.ALPHA, kinds.SLIDE_ACCELERATION


@dataclass(frozen=True, eq=False)
class UnitRates:
    """Rates over n poses, by kind and name, in metres and radians for a unit of travel (a radian, or a metre of a
    sliding drive): complex arrays of shape (n,) for points and slides, real ones for links. What is fixed has 0."""

    found: Mapping[str, Mapping[str, Array]]

    def rate(self, kind: str, name: str) -> Any:
        """The rates of one thing."""
        return self.found.get(kind, {}).get(name, 0.0)


class UnitMotion:
    """The scene's motion as far as `motion` goes, at a unit rate in the sense in which its first drive moves.

    `sense` is that sense, 1 or -1; travels are in radians or scene lengths. `unit` is the size of a unit
    of travel in SI: 1 of radians where the drive `turns`, else the `metres` of a length. `period` is the travel after
    which all is back, 0 where that is never. `find` is what is asked of the motion.
    """

    def __init__(self, scene: Scene, motion: RangeOfMotion, find: Find, compiled: bool = False):
        self.motion, self.compiled = motion, compiled
        first = scene.drives[0]
        self.sense = sense(first)
        self.period = float(motion.path.travel[-1]) if motion.goes_round else 0.0
        self.metres = float(METRES[scene.units.length])
        self.turns = not first.slides
        self.unit = 1.0 if self.turns else self.metres
        self.scene = replace(at_unit_rate(scene), loads=None, find=find)
        self.recordings = Recordings(self.scene, motion, construct_by, compiled)

    def turn(self, travel: Array) -> Turn:
        """Where everything is at these travels, of a closed motion at any; fails with `Refused` where a pose is not
        reached."""
        if self.period:
            travel = np.mod(travel, self.period)
        turn = self.motion.turn(travel, self.compiled)
        if turn.faults:
            why = next(iter(turn.faults.values()))
            raise Refused("the cycle", why, "a span of travels that the mechanism reaches")
        return turn

    def in_scene_units(self, travel: Array) -> Array:
        """Travels as scenes tell them: in degrees, or in lengths."""
        return np.degrees(travel) if self.turns else travel

    def velocities(self, turn: Turn) -> UnitRates:
        """The velocities in the poses of a turn."""
        return self._rates(turn, VELOCITIES)

    def accelerations(self, turn: Turn) -> UnitRates:
        """The accelerations in the poses of a turn, at a constant rate of the drive."""
        return self._rates(turn, ACCELERATIONS)

    def _rates(self, turn: Turn, wanted: tuple[kinds.ResultKind, ...]) -> UnitRates:
        """The rates of some kinds in the poses of a turn."""
        rates = self.recordings.evaluate(turn, wanted)
        return UnitRates({kind: {name: z * self._scale(kind) for name, z in named.items()}
                          for kind, named in rates.items()})

    def _scale(self, kind: str) -> float:
        """What turns a rate by lengths and seconds into one by metres and units of travel."""
        dimension = kinds.kind_of(kind).dimension
        return self.metres**dimension.length * self.unit**dimension.time


def construct_by(scene: Scene, method: str) -> Construction:
    return construct(scene, method=method)


def at_unit_rate(scene: Scene) -> Scene:
    """The scene with its first drive at a rate of one in its sense, or in the positive one from rest; others in pace.
    """
    first = scene.drives[0]
    unit = abs(Fraction(first.rate)) or Fraction(1)
    first_drive, *other_drives = scene.drives
    start = first_drive.driven_at(Fraction(first_drive.rate) / unit or Fraction(1), Fraction(0))
    return scene.with_drives((start,
                              *(drive.driven_at(Fraction(drive.rate) / unit, Fraction(0)) for drive in other_drives)))


def moving_points(scene: Scene, names: Iterable[str]) -> tuple[str, ...]:
    """Those of some points that are not on the frame, each once."""
    return tuple(name for name in dict.fromkeys(names) if FRAME not in scene.links_of[name])
