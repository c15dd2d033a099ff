"""A construction replayed: the same steps in other poses, one at a time or many, by the tape of its arithmetic.

Many poses are replayed on arrays, block by block, if need be by several threads; or as a function of arrays of any
library that speaks the array API: CuPy computes on the GPU, and JAX compiles and differentiates what it is given.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple
from weakref import WeakKeyDictionary

import numpy as np

from graphplan.errors import Refused, Undrawable
from graphplan.kernel.kinds import Movement
from graphplan.kernel.numbers import Floats
from graphplan.kernel.numbers.arrays import Arrays
from graphplan.kernel.passes import steps_behind
from graphplan.kernel.program import Program, Step, error_at
from graphplan.kernel.tape.record import Symbols, array_function, function, places
from graphplan.mechanism.model import FRAME, Pair, Scene, Slide
from graphplan.mechanism.order import changing_loads
from graphplan.mechanism.replaced import guides as straight_guides
from graphplan.mechanism.replaced import rolling_guides, with_lower_pairs
from graphplan.methods.executors import worker_pool
from graphplan.methods.forces.loading import given_loads
from graphplan.methods.recorded import ReadableDrawing
from graphplan.methods.results import NamedResults
from graphplan.methods.tolerances import EXTENT_TOL
from graphplan.phrases import Said, said

if TYPE_CHECKING:
    from graphplan.kernel.tape.machine import Machine
    from graphplan.kernel.tape.record import Blocks

Given = Mapping[Any, Mapping[str, Any]]
Inputs = dict[str | int, dict[str, Any]]
Free = tuple[tuple[str | int, str], ...]
Results = dict[str, dict[str, Any]]
Faults = dict[int, str]
Progress = Callable[[int, int], None]


class Replay:
    """Readings of a construction as a function of some of its given numbers, by step (name or index) and parameter.

    A reading is a number or a pair; `told` says, by kind and name, where on the tape its numbers stand. `outputs` are
    these places, what is read of one point or link together, in the order in which they are drawn: so each number is
    used soon after it is made.
    """

    def __init__(self, construction: ReadableDrawing, free: Free, kinds: Collection[str]):
        self.construction, self.free = construction, free
        self._over_arrays: dict[bool, Blocks | Machine] = {}
        domain = Symbols()
        self.tape = domain.tape
        symbols: dict[str | int, dict[str, Any]] = {}
        for mark, parameter in free:
            symbols.setdefault(mark, {})[parameter] = self.tape.input(f"{mark}.{parameter}")
        self.inputs = [symbols[mark][parameter].place for mark, parameter in free]
        results = construction.read(domain, symbols)
        self.places_of_results = {kind: {name: self._place(value) for name, value in values.items()}
                                  for kind, values in results.items() if kind in kinds}
        drawn: dict[str, int] = {}
        for reading in construction.readings:
            drawn.setdefault(reading.of, max((construction.program.wanted[k] for k in reading.marks), default=0))
        self.rows = sorted(((kind, name) for kind, values in self.places_of_results.items() for name in values),
                           key=lambda row: drawn[row[1]])
        self.outputs = [place for kind, name in self.rows for place in places(self.places_of_results[kind][name])]
        self.function = function(self.tape, self.inputs, self.places_of_results)

    def _place(self, value: Any) -> Any:
        return tuple(map(self._place, value)) if isinstance(value, tuple) else self.tape.place(value)

    def read(self, given: Given) -> Results:
        """All readings in one pose, in floats; fails as the rules do."""
        try:
            results: Results | None = self.function(*[given[mark][parameter] for mark, parameter in self.free])
        except (ZeroDivisionError, OverflowError):
            results = None
        if results is not None:
            return results
        results = self.construction.read(Floats(), given)
        return {kind: values for kind, values in results.items() if kind in self.places_of_results}

    def run(self, given: Given, found: Results, compiled: bool = False) -> Any:
        """Fill readings over n poses, vectors as complex numbers; the places of those that are left to the rules."""
        if compiled not in self._over_arrays:
            from graphplan.kernel.tape.machine import Machine
            from graphplan.kernel.tape.record import Blocks

            self._over_arrays[compiled] = (Machine if compiled else Blocks)(self.tape, self.inputs, self.outputs)
        arrays = [given[mark][parameter] for mark, parameter in self.free]
        return self._over_arrays[compiled].run(arrays, list(self._rows(found)))

    def _rows(self, found: Results) -> Iterator[Any]:
        """The array of each output, in order."""
        for kind, name in self.rows:
            z = found[kind][name]
            yield from (z.real, z.imag) if isinstance(self.places_of_results[kind][name], tuple) else (z,)


REPLAYS: WeakKeyDictionary[ReadableDrawing, dict[Any, Replay | None]] = WeakKeyDictionary()  # kept with it


def replay_of(construction: ReadableDrawing, free: Free, kinds: tuple[str, ...]) -> Replay | None:
    """The replay in which these numbers are free and these kinds of readings wanted, made once.

    None where what stands still cannot be drawn: the rules say why.
    """
    replays = REPLAYS.setdefault(construction, {})
    if (free, kinds) not in replays:
        try:
            replays[free, kinds] = Replay(construction, free, kinds)
        except (Undrawable, ZeroDivisionError):
            replays[free, kinds] = None
    return replays[free, kinds]


class Moving(NamedTuple):
    """Moving point or guide, by `kind`: its name, where the scene has it, and its two numbers, each with all its steps
    and parameters."""

    kind: str
    name: str
    at: Pair
    parts: tuple[Free, Free]


def moving_parts(construction: ReadableDrawing) -> list[Moving]:
    """The drawn points that are on no frame, and the guides that ride on links in directions given as vectors."""
    scene, steps = construction.scene, construction.program.steps[:construction.program.givens]
    items = [Moving("point", step.name, scene.points[step.name], (((step.name, "x"),), ((step.name, "y"),)))
             for step in steps if step.name in scene.points and step.name not in scene.links.get(FRAME, ())]
    for name, slide in straight_guides(scene).items():
        if slide.through is None and slide.along != FRAME and (steps_of_guide := guide_steps(construction, slide)):
            dx, dy = (tuple((step, component) for step in steps_of_guide) for component in ("dx", "dy"))
            items.append(Moving("guide", name, slide.direction, (dx, dy)))
    return items


def guide_steps(construction: ReadableDrawing, slide: Slide) -> list[int]:
    """The steps that draw the guide of a slide in its given direction, which no other guide may share.

    In the scene's pose two guides through one point, of one direction, are one line; in other poses they are not.
    """
    for name, neighbour in straight_guides(construction.scene).items():
        alike = neighbour.at == slide.at and neighbour.direction == slide.direction and neighbour.through is None
        if alike and neighbour.along not in construction.scene.turning_alike(slide.along):
            raise Refused(f"guides {slide.name} and {name}", "they are drawn as one line but turn differently",
                          "two points of its link for the direction of each")
    return guiding_steps(construction.program, slide)


def guiding_steps(program: Program, slide: Slide) -> list[int]:
    """The steps of a program that draw the guide of a slide in its given direction."""
    return [step.index for step in program.steps
            if step.op.movement is Movement.GUIDED and step.links == slide.links
            and (step.params["dx"], step.params["dy"]) == slide.direction]


# ---- over many poses, block by block ---------------------------------------------------------------------------------

STRETCH = 1 << 16  # poses between two reports of progress, and of one thread or worker at a time


@dataclass(frozen=True)
class Poses(NamedResults[Any, Any]):
    """Results over n poses, by kind and name: complex arrays of shape (n,) for vectors, real ones for numbers.

    All in scene units. Where a pose is singular its results are nan, and `faults` says why, by the pose's place; fixed
    points stand still in all.
    """

    scene: Scene
    n: int
    results: Results
    faults: Faults

    def results_of_kind(self, kind: str) -> dict[str, Any]:
        return self.results.get(kind, {})

    def _zero(self) -> Any:
        return np.zeros(self.n, dtype=complex)


def batch(construction: ReadableDrawing, points: Mapping[str, Any], guides: Mapping[str, Any], loads: Mapping[str, Any],
          only: Collection[str] | None = None, workers: int | str = 1, compiled: bool = False,
          progress: Progress | None = None) -> Poses:
    """The construction replayed over the poses in `points` and `guides`, for all kinds of results or `only` some; the
    `loads` that change are complex arrays by their letters, real ones of moments, and as they are where left out.

    `workers` is how many threads of this process share the poses out, and nothing is copied; or the address of a dask
    scheduler, which is sent the arrays. `compiled` replays in machine code; `progress` is told after each stretch how
    many poses are done, of how many.
    """
    n, inputs = _poses_and_inputs(construction, points, guides, loads)
    stretches = [slice(start, min(start + STRETCH, n)) for start in range(0, n, STRETCH)] if inputs else [slice(0, n)]
    results, faults = _result_arrays(construction, n, only), dict[int, str]()
    faults_by_stretch = _fill_stretches(construction, inputs, stretches, results, workers, compiled)
    for place, wrong in zip(stretches, faults_by_stretch, strict=True):
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

    def given(name: str) -> Any:
        """Place of a point in each pose, as given."""
        return _poses(points.get(name, places[name]))

    def place(name: str) -> Any:
        """Place of a point in each pose; a pitch point is on its line of centres, and of a rack it is not needed."""
        guide = wandering.get(name)
        if guide is None or not guide.base:
            return given(name)
        if guide.ratio is None:
            return np.array([complex(np.inf)])
        B = given(guide.base)
        return B + float(guide.ratio) * (given(guide.other_centre) - B)

    for first, second in construction.relied:
        gap = np.abs(place(first) - place(second))
        for pose in np.flatnonzero(gap > close).tolist():
            faults.setdefault(pose, coincidence_fault(first, second))
            for named in results.values():
                for z in named.values():
                    z[pose] *= np.nan  # both components of a vector


def _coincidence_distance(scene: Scene) -> float:
    """Largest distance of points that count as coincident."""
    return EXTENT_TOL * scene.extent


def coincidence_fault(one: str, other: str) -> Said:
    """Why a construction does not hold in a pose in which these points lie apart."""
    return said("points {0} and {1} coincide in the scene and lie apart here: one mark cannot serve both", one, other)


def _result_arrays(construction: ReadableDrawing, n: int, only: Collection[str] | None) -> Results:
    """Arrays for the results that are wanted."""
    for kind in only or ():
        if kind not in construction.kinds:
            raise Refused(f"results {kind}", "the scene does not ask for them", f"of {', '.join(construction.kinds)}")
    return {kind: named for kind, named in construction.empty_arrays(n, None).items() if only is None or kind in only}


def _fill_stretches(construction: ReadableDrawing, given: Inputs, stretches: Sequence[slice], results: Results,
                    workers: int | str, compiled: bool) -> Iterator[Faults]:
    """Fill the results stretch by stretch, by one hand or many; the faults of each."""
    if not isinstance(workers, str):
        def fill(place: slice) -> Faults:
            return _fill_stretch(construction, _select_poses(given, place), _select_poses(results, place), compiled)

        yield from map(fill, stretches[:1])  # what is made once is made by one
        with worker_pool(workers, threads=True) as shared_out:
            yield from shared_out(fill, stretches[1:])
        return
    bare = replace(construction)  # without what was computed of it, which a worker has no use for
    work = partial(_evaluate_stretch, bare, kinds=tuple(results), compiled=compiled)
    with worker_pool(workers) as shared_out:
        parts_done = shared_out(work, (_select_poses(given, place) for place in stretches))
        for place, (values, faults) in zip(stretches, parts_done, strict=True):
            for kind, named in values.items():
                for name, value in named.items():
                    results[kind][name][place] = value
            yield faults


def _select_poses(arrays: Mapping[Any, Mapping[str, Any]], place: Any) -> dict[Any, dict[str, Any]]:
    """Arrays of some of the poses."""
    return {key: {name: array[place] for name, array in named.items()} for key, named in arrays.items()}


def _evaluate_stretch(construction: ReadableDrawing, given: Inputs, kinds: tuple[str, ...],
                      compiled: bool) -> tuple[Results, Faults]:
    """The results and faults of one stretch of poses."""
    n = len(next(iter(next(iter(given.values())).values())))
    results = {kind: named for kind, named in construction.empty_arrays(n, None).items() if kind in kinds}
    return results, _fill_stretch(construction, given, results, compiled)


def _fill_stretch(construction: ReadableDrawing, given: Inputs, results: Results, compiled: bool) -> Faults:
    """Fill the results of one stretch of poses; return its faults, by place. Without results there is no fault."""
    if not results:
        return {}
    free = tuple((key, name) for key, numbers in given.items() for name in numbers)
    replay = replay_of(construction, free, tuple(results))
    if replay is None or not given:
        return _fill_by_rules(construction, given, results)
    undone = replay.run(given, results, compiled)
    if not undone.size:
        return {}
    of_undone = _select_poses(results, undone)
    faults = _fill_by_rules(construction, _select_poses(given, undone), of_undone)
    for kind, named in of_undone.items():
        for name, value in named.items():
            results[kind][name][undone] = value
    return {int(undone[pose]): why for pose, why in faults.items()}


def _fill_by_rules(construction: ReadableDrawing, given: Inputs, results: Results) -> Faults:
    """Fill results by the rules themselves, which find the poses that cannot be drawn; their faults, by place.

    What no result is read from, such as the arm of a force that vanishes, is no fault.
    """
    domain, program, faults = Arrays(), construction.program, dict[int, str]()
    read = steps_behind(program.steps, (program.wanted[place] for reading in construction.readings
                                        if reading.kind in results for place in reading.marks))
    n = len(next(z for named in results.values() for z in named.values()))

    def note(step: Step) -> None:
        for code, why, bad in domain.faults if step.index in read else ():
            for pose in np.flatnonzero(np.broadcast_to(bad, (n,))):
                faults.setdefault(int(pose), str(error_at(program, step, Undrawable(code, why))))
        domain.faults.clear()

    with np.errstate(all="ignore"):
        values_by_kind = construction.read(domain, given, note)
    for kind, named in results.items():
        for name, z in named.items():
            value = values_by_kind[kind][name]
            for row, number in [(z.real, value[0]), (z.imag, value[1])] if isinstance(value, tuple) else [(z, value)]:
                row[:] = number
    return faults


def _poses_and_inputs(construction: ReadableDrawing, points: Mapping[str, Any], guides: Mapping[str, Any],
                      loads: Mapping[str, Any]) -> tuple[int, Inputs]:
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
    for name, at in construction.coincident_points.items():  # one mark serves both
        if name not in arrays:
            continue
        if np.any(np.abs(arrays.setdefault(at, arrays[name]) - arrays[name]) > _coincidence_distance(scene)):
            why = "they coincide in the scene and differ here"
            raise Refused(f"points {at} and {name}", why, "the same array for both")
    for guide in rolling_guides(with_lower_pairs(scene)):
        if guide.rail and not guide.base and guide.rail.at in arrays and guide.at not in arrays:
            raise Refused(f"point {guide.at}", f"it moves with {guide.rail.at}, and stands still here",
                          "its place in each pose")
    given_points = {step.name for step in construction.program.steps[:construction.program.givens]}
    inputs: Inputs = {name: _components(z, "x", "y") for name, z in arrays.items() if name in given_points}
    for name, z in directions.items():
        inputs |= {step: _components(z, "dx", "dy") for step in guide_steps(construction, slides[name])}
    inputs |= given_loads(construction.program, scene, construction.phi, acting)
    return next(iter(shapes))[0], inputs


def _poses(z: Any) -> Any:
    return np.atleast_1d(np.asarray(z, dtype=complex))


def _components(z: Any, one: str, two: str) -> dict[str, Any]:
    return {one: z.real, two: z.imag}


# ---- as a function of arrays of any library --------------------------------------------------------------------------

Components = Mapping[str, tuple[Any, Any]]


def function_of(drawing: ReadableDrawing, names: Collection[str], only: Collection[str] | None,
                ) -> Callable[[Components], dict[str, dict[str, Any]]]:
    """The drawing's readings, all or `only` of some kinds, as a function of where these points and guides are.

    Fails with `Refused` where a name is none that moves, where what stands still cannot be drawn, and where points
    coincide and the construction takes one for the other.
    """
    movable = {part.name: part.parts for part in moving_parts(drawing)}
    for name in names:
        if name not in movable:
            choices = f"one of {', '.join(movable)}" if movable else "a scene that gives its points, not its lengths"
            raise Refused(f"point {name}", "no drawn point or guide of this name moves", choices)
    if relied := sorted({name for pair in drawing.relied for name in pair} & {*names}):
        raise Refused(f"points {', '.join(relied)}", "the construction takes points for one that coincide in the scene",
                      "drawing.evaluate, which asks in each pose whether they do")
    free = tuple(step for name in names for steps in movable[name] for step in steps)
    replay = replay_of(drawing, free, tuple(drawing.kinds if only is None else only))
    if replay is None:
        raise Refused("the construction", "what stands still in all poses cannot be drawn", "see graphplan check")
    run = array_function(replay.tape, replay.inputs, replay.places_of_results)

    def readings(places: Components) -> dict[str, dict[str, Any]]:
        """Vectors as two arrays, numbers as one, by kind and name; nan in poses that the rules would refuse."""
        xp = _namespace([number for name in names for number in places[name]])
        arrays = [xp.asarray(places[name][axis], dtype=xp.float64)
                  for name in names for axis, steps in enumerate(movable[name]) for _ in steps]
        with np.errstate(all="ignore"):
            values, refused = run(xp, *arrays)
        blank = xp.where(refused, xp.full_like(arrays[0], xp.nan), xp.zeros_like(arrays[0]))
        return {kind: {name: tuple(blank + part for part in value) if isinstance(value, tuple) else blank + value
                       for name, value in named.items()} for kind, named in values.items()}

    return readings


def _namespace(numbers: list[Any]) -> Any:
    """The array library of these numbers; numpy by default."""
    return next((number.__array_namespace__() for number in numbers if hasattr(number, "__array_namespace__")), np)
