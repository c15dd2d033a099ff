"""One construction over many poses: the recorded steps replayed on arrays, block by block, if need be by many hands."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from graphplan.errors import Refused, Undrawable
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.kernel.program import Step, error_at
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.order import changing_loads
from graphplan.mechanism.replaced import guides as straight_guides
from graphplan.mechanism.replaced import rolling_guides, with_lower_pairs
from graphplan.methods.executors import crew
from graphplan.methods.forces.changing import given_loads
from graphplan.methods.recorded import ReadableDrawing
from graphplan.methods.replay import guide_steps, replay_of
from graphplan.methods.results import NamedResults
from graphplan.methods.tolerances import EXTENT_TOL
from graphplan.phrases import Said, said

Coordinates = dict[str | int, dict[str, Any]]
Results = dict[str, dict[str, Any]]
Faults = dict[int, str]
Progress = Callable[[int, int], None]
STRETCH = 1 << 16  # poses between two reports of progress, and to one worker at a time


@dataclass(frozen=True)
class Poses(NamedResults):
    """Results over n poses, by kind and name: complex arrays of shape (n,) for vectors, real ones for numbers.

    All in scene units. Where a pose is singular its results are nan, and `faults` says why, by the pose's place; fixed
    points stand still in all.
    """

    scene: Scene
    n: int
    results: Results
    faults: Faults

    def named(self, kind: str) -> dict[str, Any]:
        return self.results.get(kind, {})

    def zero(self) -> Any:
        return np.zeros(self.n, dtype=complex)


def batch(construction: ReadableDrawing, points: Mapping[str, Any], guides: Mapping[str, Any], loads: Mapping[str, Any],
          only: Collection[str] | None = None, workers: int | str = 1, compiled: bool = False,
          progress: Progress | None = None) -> Poses:
    """The construction replayed over the poses in `points` and `guides`, for all kinds of results or `only` some; the
    `loads` that change are complex arrays by their letters, real ones of moments, and as they are where left out.

    `workers` is how many processes share the poses out, or the address of a dask scheduler; `compiled` replays in
    machine code; `progress` is told after each stretch how many poses are done, of how many.
    """
    n, given = _poses_and_inputs(construction, points, guides, loads)
    stretches = [slice(start, min(start + STRETCH, n)) for start in range(0, n, STRETCH)] if given else [slice(0, n)]
    results, faults = _result_arrays(construction, n, only), dict[int, str]()
    found = _fill_stretches(construction, given, stretches, results, workers, compiled)
    for place, wrong in zip(stretches, found, strict=True):
        faults.update((place.start + pose, why) for pose, why in wrong.items())
        if progress:
            progress(place.stop, n)
    _discard_torn_poses(construction, points, results, faults)
    return Poses(construction.scene, n, results, faults)


def _discard_torn_poses(construction: ReadableDrawing, points: Mapping[str, Any], results: Results,
                        faults: Faults) -> None:
    """Take the results of poses in which points lie apart on whose coincidence the program relies."""
    places = {name: complex(*map(float, at)) for name, at in construction.scene.points.items()}
    close = _coincidence_distance(construction.scene)
    wandering = {guide.at: guide for guide in rolling_guides(with_lower_pairs(construction.scene))}

    def place(name: str) -> Any:
        """Where a point is in each pose: a pitch point on its line of centres; of a rack it is not asked."""
        guide = wandering.get(name)
        if guide is None or not guide.base:
            return _poses(points.get(name, places[name]))
        if guide.ratio is None:
            return np.array([complex(np.inf)])
        B = place(guide.base)
        return B + float(guide.ratio) * (place(guide.other_centre) - B)

    for one, other in construction.relied:
        gap = np.abs(place(one) - place(other))
        for pose in np.flatnonzero(gap > close).tolist():
            faults.setdefault(pose, coincidence_fault(one, other))
            for named in results.values():
                for z in named.values():
                    z[pose] = np.nan


def _coincidence_distance(scene: Scene) -> float:
    """How far apart points may be that coincide."""
    return EXTENT_TOL * scene.extent


def coincidence_fault(one: str, other: str) -> Said:
    """Why a construction does not hold in a pose in which these points lie apart."""
    return said("points {0} and {1} coincide in the scene and lie apart here: one mark cannot serve both", one, other)


def _result_arrays(construction: ReadableDrawing, n: int, only: Collection[str] | None) -> Results:
    """Arrays for the results that are wanted."""
    for kind in only or ():
        if kind not in construction.kinds:
            raise Refused(f"results {kind}", "the scene does not ask for them", f"of {', '.join(construction.kinds)}")
    return {kind: named for kind, named in construction.blank(n, None).items() if only is None or kind in only}


def _fill_stretches(construction: ReadableDrawing, given: Coordinates, stretches: Iterable[slice], results: Results,
            workers: int | str, compiled: bool) -> Iterator[Faults]:
    """Fill the results stretch by stretch, by one hand or many; the faults of each."""
    if workers == 1:
        for place in stretches:
            yield _fill_stretch(construction, _select_poses(given, place), _select_poses(results, place), compiled)
        return
    bare = replace(construction)  # without what was computed of it, which a worker has no use for
    work = partial(_evaluate_stretch, bare, kinds=tuple(results), compiled=compiled)
    with crew(workers) as shared_out:
        found = shared_out(work, (_select_poses(given, place) for place in stretches))
        for place, (values, faults) in zip(stretches, found, strict=True):
            for kind, named in values.items():
                for name, value in named.items():
                    results[kind][name][place] = value
            yield faults


def _select_poses(arrays: Mapping[Any, Mapping[str, Any]], place: Any) -> dict[Any, dict[str, Any]]:
    """The same arrays, for some of the poses."""
    return {key: {name: array[place] for name, array in named.items()} for key, named in arrays.items()}


def _evaluate_stretch(construction: ReadableDrawing, given: Coordinates, kinds: tuple[str, ...],
            compiled: bool) -> tuple[Results, Faults]:
    """The results and faults of one stretch of poses."""
    n = len(next(iter(next(iter(given.values())).values())))
    results = {kind: named for kind, named in construction.blank(n, None).items() if kind in kinds}
    return results, _fill_stretch(construction, given, results, compiled)


def _fill_stretch(construction: ReadableDrawing, given: Coordinates, results: Results, compiled: bool) -> Faults:
    """Fill the results of one stretch of poses; its faults, by place. Where nothing is asked there are none."""
    if not results:
        return {}
    free = tuple((key, name) for key, numbers in given.items() for name in numbers)
    replay = replay_of(construction, free, tuple(results))
    if replay is None or not given:
        return _fill_by_rules(construction, given, results)
    left = replay.run(given, results, compiled)
    if not left.size:
        return {}
    some = _select_poses(results, left)
    faults = _fill_by_rules(construction, _select_poses(given, left), some)
    for kind, named in some.items():
        for name, value in named.items():
            results[kind][name][left] = value
    return {int(left[pose]): why for pose, why in faults.items()}


def _fill_by_rules(construction: ReadableDrawing, given: Coordinates, results: Results) -> Faults:
    """Fill results by the rules themselves, which find the poses that cannot be drawn; their faults, by place."""
    domain, program, faults = Arrays(), construction.program, dict[int, str]()
    n = len(next(z for named in results.values() for z in named.values()))

    def note(step: Step) -> None:
        for code, why, bad in domain.faults:
            for pose in np.flatnonzero(np.broadcast_to(bad, (n,))):
                faults.setdefault(int(pose), str(error_at(program, step, Undrawable(code, why))))
        domain.faults.clear()

    with np.errstate(all="ignore"):
        found = construction.read(domain, given, note)
    for kind, named in results.items():
        for name, z in named.items():
            value = found[kind][name]
            for row, number in [(z.real, value[0]), (z.imag, value[1])] if isinstance(value, tuple) else [(z, value)]:
                row[:] = number
    return faults


def _poses_and_inputs(construction: ReadableDrawing, points: Mapping[str, Any], guides: Mapping[str, Any],
           loads: Mapping[str, Any]) -> tuple[int, Coordinates]:
    """The number of poses, and what is given in each: coordinates of points, and by their steps directions of guides
    and loads."""
    scene = construction.scene
    if scene.assembly is not None and (points or guides):
        raise Refused("points", said("the pose is constructed from the lengths of links"), "the scene as it is given")
    arrays = {name: _poses(z) for name, z in points.items()}
    directions = {name: _poses(z) for name, z in guides.items()}
    for name in arrays:
        if name not in scene.points:
            raise Refused(f"point {name}", "the scene has no such point", f"one of {', '.join(scene.points)}")
    slides = straight_guides(scene)
    for name in directions:
        if name not in slides or slides[name].through or slides[name].along == FRAME:
            free = [n for n, s in slides.items() if s.through is None and s.along != FRAME]
            raise Refused(f"guide {name}", "no guide on a moving link has its direction given under this name",
                          f"one of {', '.join(free)}" if free else "points alone: they turn every guide here")
    changing = changing_loads(scene.loads)
    for name in loads:
        if name not in changing:
            raise Refused(f"load {name}", "the scene has no load of this name that changes",
                          f"one of {', '.join(changing)}" if changing else "a load with a table")
    acting = {name: np.atleast_1d(np.asarray(z)) for name, z in loads.items()}
    shapes = {array.shape for array in (*arrays.values(), *directions.values(), *acting.values())} or {(1,)}
    if len(shapes) > 1 or len(next(iter(shapes))) != 1:
        raise Refused("poses", f"the arrays have the shapes {sorted(shapes)}", "one array of shape (n,) a point")
    for name, at in construction.shared.items():  # one mark serves both
        if name not in arrays:
            continue
        if np.any(np.abs(arrays.setdefault(at, arrays[name]) - arrays[name]) > _coincidence_distance(scene)):
            why = "they coincide in the scene and differ here"
            raise Refused(f"points {at} and {name}", why, "the same array for both")
    for guide in rolling_guides(with_lower_pairs(scene)):
        if guide.rail and not guide.base and guide.rail.at in arrays and guide.at not in arrays:
            raise Refused(f"point {guide.at}", f"it moves with {guide.rail.at}, and stands still here",
                          "its place in each pose")
    drawn = {step.name for step in construction.program.steps[:construction.program.givens]}
    given: Coordinates = {name: _components(z, "x", "y") for name, z in arrays.items() if name in drawn}
    for name, z in directions.items():
        given |= {step: _components(z, "dx", "dy") for step in guide_steps(construction, slides[name])}
    given |= given_loads(construction.program, scene, construction.phi, acting)
    return next(iter(shapes))[0], given


def _poses(z: Any) -> Any:
    return np.atleast_1d(np.asarray(z, dtype=complex))


def _components(z: Any, one: str, two: str) -> dict[str, Any]:
    return {one: z.real, two: z.imag}
