"""The construction all the way round: one recorded program replayed in every pose, beside the analytic solver in each.

Where the recorded way through a ring of links cannot be drawn in a pose, or lets rounding grow there, the other forms
are tried for that pose, and which one served is noted.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from graphplan.check.measures import extent
from graphplan.check.report import EPSILON, KINDS, RATES, SAFETY
from graphplan.cycle import Turn, follow
from graphplan.errors import GraphplanError
from graphplan.mechanism.model import Scene
from graphplan.mechanism.units import metre
from graphplan.methods.construct import METHODS, construct
from graphplan.methods.construction import Construction
from graphplan.solver import poses, solve

BLOCK = 4096  # poses whose systems are solved at once
BACK = 1e-9  # of the mechanism's extent: points that are so near are in one place
CLOSE = 1e-12  # differences up to this are rounding in any mechanism
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True)
class Cycle:
    """n poses of a scene around its drive's turn, and what the construction gives in each.

    `results` are arrays of shape (n,) by kind and name, complex for vectors, nan where there are none; `faults` says
    why, by the pose's place. `gaps`: for each kind the largest difference from the solver beside the largest value, in
    each pose. `otherwise`: by the pose's place, the form that served where the recorded one did not. `wrong`: the poses
    where the difference is more than rounding. `closed`: after the turn the mechanism is as it was.
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


@dataclass(frozen=True)
class _Round:
    """Some of the poses: their places among all, and where points and guides are in them."""

    scene: Scene
    places: Any
    points: Mapping[str, Any]
    guides: Mapping[str, Any]

    def some(self, kept: Any) -> _Round:
        """Those of the poses that a mask or a slice keeps."""
        points, guides = ({name: z[kept] for name, z in arrays.items()} for arrays in (self.points, self.guides))
        return _Round(self.scene, self.places[kept], points, guides)


def cycle(scene: Scene, positions: int, span: tuple[float, float] | None = None, *, method: str = "", plan: str = "",
          inertia: str = "couple", workers: int | str = 1, machine: bool = False,
          progress: Progress | None = None) -> Cycle:
    """The construction in so many poses of the drive's turn, or of a span of its travel, and the check in each.

    Reads a scene with a drive; `workers` and `machine` are those of :meth:`Construction.evaluate`; `progress` is told
    what is being done, how many poses are done, of how many. Fails as `follow` and `construct` do.
    """
    def told(what: str) -> Callable[[int, int], None]:
        return lambda done, of: progress(what, done, of) if progress else None

    drawing = construct(scene, method=method, plan=plan, inertia=inertia)
    turn = follow(scene, positions, span, lambda part: told("positions")(round(part * positions), positions))
    left = _Round(scene, np.arange(positions), turn.points, turn.guides).some(_reached(turn))
    kinds = (*KINDS, *(["force"] if scene.loads else []))
    found = Cycle(scene, drawing, turn, drawing.blank(positions), dict(turn.faults),
                  {kind: np.full(positions, np.nan) for kind in kinds})
    for name, other in _forms(drawing, method, plan, inertia):
        if not left.places.size:
            break
        drawn = other.evaluate(left.points, left.guides, workers=workers, machine=machine, progress=told("plans"))
        gaps = _gaps(left, drawn.results, told("check"))
        sound = _sound(left, gaps)
        if other is drawing:
            found.faults.update((int(left.places[k]), why) for k, why in drawn.faults.items())
        else:
            found.otherwise.update((int(place), name) for place in left.places[sound])
        _enter(found, left, drawn.results, gaps, sound | (other is drawing))
        left = left.some(~sound)
    faults = {k: why for k, why in sorted(found.faults.items()) if k not in found.otherwise}
    _clear(found, list(faults))
    closed = span is None and not turn.faults and _comes_back(scene)
    return replace(found, faults=faults, wrong=tuple(int(k) for k in left.places if k not in faults), closed=closed)


def _comes_back(scene: Scene) -> bool:
    """Whether every point is back in its place after a full turn of the first drive."""
    there = follow(scene, 2, (0.0, 360.0)).points
    return all(abs(z[1] - z[0]) <= BACK * float(extent(scene)) for z in there.values())


def _reached(turn: Turn) -> Any:
    """The poses in which every point has its place."""
    return np.all([np.isfinite(z) for z in turn.points.values()], axis=0)


def _forms(drawing: Construction, method: str, plan: str, inertia: str) -> Iterator[tuple[str, Construction]]:
    """The recorded construction; then, where the form is free, those that go another way through a ring."""
    yield "", drawing
    for name in () if method else METHODS:
        try:
            other = construct(drawing.scene, method=name, plan=plan, inertia=inertia)
        except GraphplanError:
            continue
        if other.ways != drawing.ways:
            yield ", ".join(other.ways), other


def _enter(found: Cycle, part: _Round, results: Mapping[str, Mapping[str, Any]], gaps: Mapping[str, Any],
           kept: Any) -> None:
    """Enter the results of some poses among all."""
    places = part.places[kept]
    for kind, named in results.items():
        for name, z in named.items():
            found.results[kind][name][places] = z[kept]
    for kind, gap in gaps.items():
        found.gaps[kind][places] = gap[kept]


def _clear(found: Cycle, places: list[int]) -> None:
    """Poses with a fault have no results: near a limit there are numbers, and they say nothing."""
    for z in (*(z for named in found.results.values() for z in named.values()), *found.gaps.values()):
        z[places] = np.nan


def _sound(part: _Round, gaps: Mapping[str, Any]) -> Any:
    """In which poses the results are there, and differ from the solver's by no more than the mechanism's condition."""
    worst = np.max(list(gaps.values()), axis=0)
    worst[np.isnan(worst)] = np.inf
    sound = worst <= CLOSE
    for k in np.flatnonzero(~sound & np.isfinite(worst)):
        pose = part.some(k)
        try:
            condition = solve(poses.posed(part.scene, pose.points, pose.guides)).condition
        except GraphplanError:
            continue
        sound[k] = worst[k] <= SAFETY * EPSILON * condition
    return sound


def _gaps(part: _Round, results: Mapping[str, Mapping[str, Any]], progress: Callable[[int, int], None]) -> Any:
    """For each kind of result the largest difference from the solver beside the largest value, in each pose."""
    n, found = part.places.size, list[dict[str, Any]]()
    for start in range(0, n, BLOCK):
        block = slice(start, min(start + BLOCK, n))
        ours = {kind: {name: z[block] for name, z in named.items()} for kind, named in results.items()}
        found.append(_against(part.some(block), ours))
        progress(block.stop, n)
    return {kind: np.concatenate([gaps[kind] for gaps in found]) for kind in found[0]}


def _against(part: _Round, ours: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """The differences in one block of poses."""
    n, scene = part.places.size, poses.posed(part.scene, part.points, part.guides)
    reach = float(extent(part.scene))
    motion = poses.solve(scene, n)
    gaps = {kind: _largest(ours, {name: getattr(motion, name.replace(" ", "_")) for name in names},
                           {name: reach if name in RATES else 0.0 for name in names})
            for kind, names in KINDS.items()}
    if scene.loads is not None:
        from graphplan.check.held import MOMENTS, Held

        truth = Held(scene, ours, poses.reactions(scene, motion, n), (), rounds=False).truth
        arm = metre(scene.units) / reach
        gaps["force"] = _largest(ours, {kind: truth[kind] for kind in truth if kind != "slide arm"},
                                 dict.fromkeys(MOMENTS, arm))
    return {kind: np.broadcast_to(gap, (n,)) for kind, gap in gaps.items()}


def _largest(ours: Mapping[str, Mapping[str, Any]], truth: Mapping[str, Mapping[str, Any]],
             arms: Mapping[str, float]) -> Any:
    """The largest difference in each pose beside the largest vector; what is no vector counts by its arm."""
    gap: Any = 0.0
    largest: Any = 0.0
    for part, values in truth.items():
        for name, value in values.items():
            theirs = _vector(*value) if isinstance(value, tuple) else np.asarray(value, float)
            arm = arms.get(part, 0.0)
            largest = largest if arm else np.maximum(largest, np.abs(theirs))
            if name in ours.get(part, {}):
                miss = np.abs(ours[part][name] - theirs) * (arm or 1.0)
                gap = np.where(np.isnan(miss), np.nan, np.maximum(gap, miss))
    return np.where(largest > 0, gap / np.where(largest > 0, largest, 1.0), gap)


def _vector(x: Any, y: Any) -> Any:
    return np.asarray(x, float) + 1j * np.asarray(y, float)
