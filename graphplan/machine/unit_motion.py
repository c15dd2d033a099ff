"""The motion at a unit rate of the first drive: rates by its travel, from one recorded construction.

Only ratios of velocities count where masses and forces are reduced, so the first drive goes at a rate of one and the
others in pace, whatever their rates are; a scene that stands still is moved so, too (Ozols 1974, 13-2). Where the
construction of the given pose cannot serve in another one, those by other forms are tried there, and then those that
are recorded in other poses.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.cycle.pose import in_pose
from graphplan.cycle.turn import RangeOfMotion, Turn
from graphplan.errors import GraphplanError, Refused
from graphplan.mechanism.model import FRAME, Find, Scene
from graphplan.mechanism.units import METRES
from graphplan.methods import kinds
from graphplan.methods.construct import construct
from graphplan.methods.construction import Construction
from graphplan.methods.styles import METHODS

VELOCITIES = kinds.VELOCITY, kinds.OMEGA, kinds.SLIDE_VELOCITY
ACCELERATIONS = kinds.ACCELERATION, kinds.ALPHA, kinds.SLIDE_ACCELERATION
ELSEWHERE = (0.11, 0.43, 0.79)  # of the range: poses in which constructions are recorded where no other serves


@dataclass(frozen=True, eq=False)
class Rates:
    """Rates over n poses, by kind and name, in metres and radians for a unit of travel (a radian, or a metre of a
    sliding drive): complex arrays of shape (n,) for points and slides, real ones for links. What is fixed has 0."""

    found: Mapping[str, Mapping[str, Array]]

    def of(self, kind: str, name: str) -> Any:
        """The rates of one thing."""
        return self.found.get(kind, {}).get(name, 0.0)


class UnitMotion:
    """The scene's motion as far as `motion` goes, at a unit rate in the sense in which its first drive moves.

    `sense` is that sense, 1 or -1: travels here, in radians or scene lengths, count in it. `unit` is the size of a unit
    of travel in SI: 1 of radians where the drive `turns`, else the `metres` of a length. `period` is the travel after
    which all is back, 0 where that is never. `find` is what is asked of the motion.
    """

    def __init__(self, scene: Scene, motion: RangeOfMotion, find: Find, compiled: bool = False):
        self.motion, self.compiled = motion, compiled
        first = scene.drives[0]
        self.sense = -1 if first.rate < 0 else 1
        self.period = float(motion.path.travel[-1]) if motion.whole else 0.0
        self.metres = float(METRES[scene.units.length])
        self.turns = not first.slides
        self.unit = 1.0 if self.turns else self.metres
        self.scene = replace(at_unit_rate(scene), loads=None, find=find)
        self._drawings: dict[object, Construction | None] = {}

    def turn(self, travel: Array) -> Turn:
        """Where everything is at these travels, of a closed motion at any; fails with `Refused` where a pose is not
        reached."""
        travel = self.sense * travel
        if self.period:
            travel = np.mod(travel, self.period)
        found = self.motion.turn(travel, self.compiled)
        if found.faults:
            why = next(iter(found.faults.values()))
            raise Refused("the cycle", why, "a span of travels that the mechanism reaches")
        return found

    def told(self, travel: Array) -> Array:
        """Travels as scenes tell them: in degrees, or in lengths."""
        return np.degrees(travel) if self.turns else travel

    def velocities(self, turn: Turn) -> Rates:
        """The velocities in the poses of a turn."""
        return self._rates(turn, VELOCITIES)

    def accelerations(self, turn: Turn) -> Rates:
        """The accelerations in the poses of a turn, at a constant rate of the drive."""
        return self._rates(turn, ACCELERATIONS)

    def _rates(self, turn: Turn, wanted: tuple[kinds.ResultKind, ...]) -> Rates:
        """The rates of some kinds in the poses of a turn."""
        n = len(turn.travel)
        found, left = dict[str, dict[str, Array]](), np.arange(n)
        why = ""
        for drawing in self._constructions():
            only = [kind for kind in drawing.kinds if kind in wanted]
            if not only:
                break
            points, guides = ({name: z[left] for name, z in own.items()} for own in (turn.points, turn.guides))
            try:
                poses = drawing.evaluate(points, guides, only=only, compiled=self.compiled)
            except Refused as refused:
                why = str(refused)
                continue
            if not found:
                found = {kind: {name: np.full(n, np.nan, z.dtype) for name, z in named.items()}
                         for kind, named in poses.results.items()}
            for kind, named in poses.results.items():
                for name, z in named.items():
                    found[kind][name][left] = z
            torn = np.any([~np.isfinite(z) for named in poses.results.values() for z in named.values()], axis=0)
            left, why = left[torn], next(iter(poses.faults.values()), why)
            if not left.size:
                break
        else:
            raise Refused("the cycle", why, "a span of travels in which the mechanism has velocities")
        return Rates({kind: {name: z * self._scale(kind) for name, z in named.items()}
                      for kind, named in found.items()})

    def _scale(self, kind: str) -> float:
        """What turns a rate by lengths and seconds into one by metres and units of travel."""
        dimension = kinds.kind_of(kind).dimension
        return self.metres**dimension.length * self.unit**dimension.time

    @property
    def drawing(self) -> Construction:
        """The construction of the velocities in the given pose."""
        return next(self._constructions())

    def _constructions(self) -> Iterator[Construction]:
        """The construction in the given pose; then by other forms, and as it is recorded in other poses."""
        yield from self._drawn(None, lambda: construct(self.scene))
        for method in METHODS:
            yield from self._drawn(method, lambda method=method: construct(self.scene, method=method))
        low, high = (float(self.motion.path.travel[end]) for end in (0, -1))
        for part in ELSEWHERE:
            turn = self.motion.turn(np.array([low + part * (high - low)]))
            if not turn.faults:
                yield from self._drawn(part, lambda turn=turn: construct(in_pose(self.scene, turn, 0)))

    def _drawn(self, key: object, draw: Any) -> Iterator[Construction]:
        """A construction that is drawn when it is first asked for; none where there is none."""
        if key not in self._drawings:
            try:
                self._drawings[key] = draw()
            except GraphplanError:
                if key is None:
                    raise
                self._drawings[key] = None
        if found := self._drawings[key]:
            yield found


def at_unit_rate(scene: Scene) -> Scene:
    """The scene with its first drive at a rate of one in its sense, or in the positive one from rest; others in pace.
    """
    first = scene.drives[0]
    size = abs(Fraction(first.rate)) or Fraction(1)
    one, *others = scene.drives
    start = one.driven_at(Fraction(one.rate) / size or Fraction(1), Fraction(0))
    return scene.with_drives((start, *(drive.driven_at(Fraction(drive.rate) / size, Fraction(0)) for drive in others)))


def moving_points(scene: Scene, names: Iterable[str]) -> tuple[str, ...]:
    """Those of some points that are not on the frame, each once."""
    return tuple(name for name in dict.fromkeys(names) if FRAME not in scene.links_of[name])
