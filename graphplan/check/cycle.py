"""The construction all the way round: one recorded program replayed in every pose, beside the analytic solver in each.

Where the recorded way through a ring of links cannot be drawn in a pose, or lets rounding grow there, the other forms
are tried for that pose, and which one served is noted.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from graphplan.check.poses import Round, gaps, sound
from graphplan.check.trusted import construct
from graphplan.cycle import Turn, follow
from graphplan.errors import ConstructionError, GraphplanError, SingularPose
from graphplan.mechanism.model import Scene
from graphplan.methods.construct import construct as unchecked
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import FORCES, MOTION
from graphplan.methods.motion.time_scale import extent
from graphplan.methods.styles import METHODS

BACK = 1e-9  # of the mechanism's extent: points that are so near are in one place
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True)
class Cycle:
    """n poses of a scene around its drive's turn, and what the construction gives in each.

    `results` are arrays of shape (n,) by kind and name, complex for vectors, nan where there are none; `faults` says
    why, by the pose's place. `gaps`: for each kind the largest difference of a number from the solver's beside what
    cancels in it, in each pose. `otherwise`: by the pose's place, the form that served where the recorded one did not.
    `wrong`: the poses where the difference is more than rounding. `closed`: after the turn the mechanism is as it was.
    """

    scene: Scene
    drawing: Construction
    turn: Turn
    results: dict[str, dict[str, Any]]
    faults: dict[int, str]
    gaps: dict[str, Any]
    otherwise: dict[int, str] = field(default_factory=dict)
    wrong: tuple[int, ...] = ()
    closed: bool = False

    @property
    def asked(self) -> dict[str, Any]:
        """Where the points are of which velocities or accelerations are asked for."""
        find = self.scene.find
        return {p: self.turn.points[p] for p in self.scene.points if p in {*find.velocity, *find.acceleration}}

    @property
    def check(self) -> dict[str, float]:
        """The largest difference from the solver in any pose, by kind."""
        return {kind: float(np.nanmax(gap, initial=0.0)) for kind, gap in self.gaps.items()}


def cycle(scene: Scene, positions: int, span: tuple[float, float] | None = None, *, method: str = "", plan: str = "",
          inertia: str = "couple", workers: int | str = 1, machine: bool = False,
          progress: Progress | None = None) -> Cycle:
    """The construction in so many poses of the drive's turn, or of a span of its travel, and the check in each.

    Reads a scene with a drive; `workers` and `machine` are those of :meth:`Construction.evaluate`; `progress` is told
    what is being done, how many poses are done, of how many. Fails as `follow` and `construct` do.
    """
    def told(what: str) -> Callable[[int, int], None]:
        return lambda done, of: progress(what, done, of) if progress else None

    drawing = _construct(scene, method=method, plan=plan, inertia=inertia)
    turn = follow(scene, positions, span, lambda part: told("positions")(round(part * positions), positions))
    left = Round.reached(scene, turn.points, turn.guides)
    kinds = (*MOTION, *([FORCES] if scene.loads else []))
    found = Cycle(scene, drawing, turn, drawing.blank(positions), dict(turn.faults),
                  {kind: np.full(positions, np.nan) for kind in kinds})
    for name, other in _forms(drawing, method, plan, inertia):
        if not left.places.size:
            break
        drawn = other.evaluate(left.points, left.guides, workers=workers, machine=machine, progress=told("plans"))
        apart = gaps(left, other, drawn.results, told("check"))
        kept = sound(left, other, drawn.results, apart)
        if other is drawing:
            found.faults.update((int(left.places[k]), why) for k, why in drawn.faults.items())
        else:
            found.otherwise.update((int(place), name) for place in left.places[kept])
        _enter(found, left, drawn.results, apart, kept | (other is drawing))
        left = left.some(~kept)
    faults = {k: why for k, why in sorted(found.faults.items()) if k not in found.otherwise}
    _clear(found, list(faults))
    closed = span is None and not turn.faults and _comes_back(scene)
    return replace(found, faults=faults, wrong=tuple(int(k) for k in left.places if k not in faults), closed=closed)


def _construct(scene: Scene, **how: str) -> Construction:
    """The construction, compared with the solver in the given pose unless that is singular."""
    try:
        return construct(scene, **how)  # type: ignore[arg-type]
    except (SingularPose, ConstructionError):
        return unchecked(scene, **how)  # type: ignore[arg-type]


def _comes_back(scene: Scene) -> bool:
    """Whether every point is back in its place after a full turn of the first drive."""
    there = follow(scene, 2, (0.0, 360.0)).points
    return all(abs(z[1] - z[0]) <= BACK * extent(scene) for z in there.values())


def _forms(drawing: Construction, method: str, plan: str, inertia: str) -> Iterator[tuple[str, Construction]]:
    """The recorded construction; then, where the form is free, those that go another way through a ring."""
    yield "", drawing
    for name in () if method else METHODS:
        try:
            other = unchecked(drawing.scene, method=name, plan=plan, inertia=inertia)
        except GraphplanError:
            continue
        if other.ways != drawing.ways:
            yield ", ".join(other.ways), other


def _enter(found: Cycle, part: Round, results: Mapping[str, Mapping[str, Any]], apart: Mapping[str, Any],
           kept: Any) -> None:
    """Enter the results of some poses among all."""
    places = part.places[kept]
    for kind, named in results.items():
        for name, z in named.items():
            found.results[kind][name][places] = z[kept]
    for kind, gap in apart.items():
        found.gaps[kind][places] = gap[kept]


def _clear(found: Cycle, places: list[int]) -> None:
    """Poses with a fault have no results: near a limit there are numbers, and they say nothing."""
    for z in (*(z for named in found.results.values() for z in named.values()), *found.gaps.values()):
        z[places] = np.nan


