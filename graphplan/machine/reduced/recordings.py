"""Recordings: the constructions of one scene that serve in every pose of its motion, the one where another cannot.

The construction of the given pose comes first. Where it cannot be drawn in another pose, or relies on points that
coincide in its own alone, those by other forms follow, and those that are recorded in other poses.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.cycle.pose import in_pose
from graphplan.cycle.turn import RangeOfMotion, Turn
from graphplan.errors import GraphplanError, Refused
from graphplan.mechanism.model import Scene
from graphplan.methods.construction import Construction
from graphplan.methods.styles import METHODS

ELSEWHERE = (0.11, 0.43, 0.79)  # of the range: poses in which constructions are recorded where no other serves

Draw = Callable[[Scene, str], Construction]
Results = dict[str, dict[str, Array]]


class Recordings:
    """The constructions of a scene over its motion, each drawn when it is first needed, by a method if one is named."""

    def __init__(self, scene: Scene, motion: RangeOfMotion, draw: Draw, compiled: bool = False):
        self.scene, self.motion, self.draw, self.compiled = scene, motion, draw, compiled
        self._drawn: dict[object, Construction | None] = {}

    @property
    def first(self) -> Construction:
        """The construction of the given pose."""
        return next(self._constructions())

    def evaluate(self, turn: Turn, wanted: Collection[str] | None = None, gaps: bool = False,
                 **given: Mapping[str, Array]) -> Results:
        """The results of the wanted kinds, or of all, in the poses of a turn; with `gaps` nan where there are none.

        Else it fails with `Refused` where no construction serves in a pose.
        """
        found, why = Results(), ""
        left = np.arange(len(turn.travel))
        for drawing in self._constructions():
            only = None if wanted is None else [kind for kind in drawing.kinds if kind in wanted]
            if only is not None and not only:
                return found
            try:
                poses = self._poses(drawing, turn, left, only, given)
            except Refused as refused:
                why = str(refused)
                continue
            for kind, named in poses.results.items():
                for name, z in named.items():
                    row = found.setdefault(kind, {}).setdefault(name, np.full(len(turn.travel), np.nan, z.dtype))
                    row[left] = z
            torn = np.any([~np.isfinite(z) for named in poses.results.values() for z in named.values()], axis=0)
            left, why = left[torn], next(iter(poses.faults.values()), why)
            if not left.size:
                return found
        if gaps and found:
            return found
        raise Refused("the cycle", why, "a span of travels in which the mechanism has velocities")

    def _poses(self, drawing: Construction, turn: Turn, left: Array, only: Collection[str] | None,
               given: Mapping[str, Mapping[str, Array]]) -> Any:
        """One construction in some of the poses."""
        points, guides, *more = ({name: z[left] for name, z in own.items()}
                                 for own in (turn.points, turn.guides, *given.values()))
        return drawing.evaluate(points, guides, only=only, compiled=self.compiled,
                                **dict(zip(given, more, strict=True)))  # type: ignore[arg-type]

    def _constructions(self) -> Iterator[Construction]:
        """The construction in the given pose; then by other forms, and as it is recorded in other poses."""
        for method in ("", *METHODS):
            yield from self._once(method, partial(self.draw, self.scene, method))
        low, high = (float(self.motion.path.travel[end]) for end in (0, -1))
        for part in ELSEWHERE:
            turn = self.motion.turn(np.array([low + part * (high - low)]))
            if not turn.faults:
                yield from self._once(part, partial(self.draw, in_pose(self.scene, turn, 0), ""))

    def _once(self, key: object, draw: Callable[[], Construction]) -> Iterator[Construction]:
        """A construction, unless there is none; what keeps the given pose from having one is told."""
        if key not in self._drawn:
            try:
                self._drawn[key] = draw()
            except GraphplanError:
                if key == "":
                    raise
                self._drawn[key] = None
        if found := self._drawn[key]:
            yield found
