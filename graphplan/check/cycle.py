"""The construction all the way round: one recorded program replayed in every pose, against the analytic solver in each.

Where the recorded way through a ring of links cannot be drawn in a pose, or lets rounding grow there, the other forms
are tried for that pose, and which one served is noted.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from typing import Any

import numpy as np

from graphplan.check.compared import Readings, Results
from graphplan.check.decided_friction import decide_friction
from graphplan.check.poses import PoseBatch, compared_groups, pose_gaps, poses_rubbed_as_drawn, sound_poses
from graphplan.check.stream import ComparedPoses, Stream
from graphplan.check.trusted import construct
from graphplan.cycle.curves import KinematicCurve, curve_over_travel
from graphplan.cycle.loads import guide_direction
from graphplan.cycle.motion_curves import Centrodes, sheet_centrodes
from graphplan.cycle.pose import in_pose
from graphplan.cycle.travel import afford_poses
from graphplan.cycle.turn import Turn, turn_of_parts
from graphplan.errors import ConstructionError, GraphplanError, Refused, SingularPose
from graphplan.mechanism.model import FRAME, Scene, Slide
from graphplan.mechanism.sections import METHODS
from graphplan.mechanism.travel import TURN
from graphplan.methods.construct import construct as unchecked
from graphplan.methods.construction import Construction
from graphplan.methods.panels import slide_named
from graphplan.phrases import Said, said

MAX_DIAGRAMS = 4  # diagrams that stand side by side
MIN_BLOCK, MAX_BLOCK = 1024, 16384  # poses of a block: those that a worker is told of at a time
SHARES_EACH = 4  # blocks for each worker, where there are so many poses: the last to finish keeps nobody waiting long
MAX_OTHER_POSES = 3  # poses in which steps are recorded where those of the given pose do not serve
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True)
class Cycle:
    """n poses of a scene around its drive's turn, and what the construction gives in each.

    `results` are arrays of shape (n,) by kind and name, complex for vectors, nan where there are none; `faults` says
    why, by the pose's place. `gaps`: for each kind the largest difference of a number from the solver's, relative to
    what cancels in it, in each pose. `otherwise`: by the pose's place, the form that served where the recorded one did
    not. `wrong`: the poses where the difference is more than rounding.
    """

    scene: Scene
    drawing: Construction
    turn: Turn
    results: Readings
    faults: dict[int, str]
    gaps: dict[str, Any]
    otherwise: dict[int, str] = field(default_factory=dict)
    wrong: tuple[int, ...] = ()
    centrodes: dict[str, Centrodes] = field(default_factory=dict)

    @property
    def requested_points(self) -> dict[str, Any]:
        """Where the points are of which velocities, accelerations or paths are asked for; then the centrodes."""
        return requested_points(self.scene, self.turn) | {
            f"{kind} centrode {links}": places for links, curves in self.centrodes.items()
            for kind, places in zip(("fixed", "moving"), curves, strict=True)}

    @property
    def check(self) -> dict[str, float]:
        """The largest difference from the solver in any pose, by kind."""
        return {kind: float(np.nanmax(gap, initial=0.0)) for kind, gap in self.gaps.items()}


def requested_points(scene: Scene, turn: Turn) -> dict[str, Any]:
    """Where the points are of which velocities, accelerations or paths are asked for."""
    names = {*scene.find.velocity, *scene.find.acceleration, *scene.sheet.curves}
    return {name: turn.points[name] for name in scene.points if name in names}


def cycle(scene: Scene, positions: int, span: tuple[float, float] | None = None, *, method: str = "", plan: str = "",
          inertia: str = "couple", workers: int | str = 1, machine: bool = False,
          progress: Progress | None = None) -> Cycle:
    """The construction in so many poses of the drive's turn, or of a span of its travel, and the check in each.

    Reads a scene with a drive; `workers` are told ranges of poses and give back what is drawn and compared in each, as
    those of a :class:`Stream`; `machine` is `compiled` of :meth:`Construction.evaluate`; `progress` is told what is
    being done, how many poses are done, of how many. Fails as `follow` and `construct` do.
    """
    def report_progress(what: str) -> Callable[[int, int], None]:
        return lambda done, of: progress(what, done, of) if progress else None

    drawing = _construct(scene, method=method, plan=plan, inertia=inertia)
    afford_poses(positions)
    shares = 1 if isinstance(workers, str) else max(1, workers)
    length = min(MAX_BLOCK, max(MIN_BLOCK, -(-positions // (SHARES_EACH * shares))))
    stream = Stream(drawing, positions, span, compiled=machine, length=length,
                    progress=lambda part: report_progress("positions")(round(part * positions), positions))
    turn, remaining, results_so_far = _recorded_way(stream, workers, report_progress("poses"))

    def elsewhere() -> Iterator[tuple[str, Scene]]:
        """Poses in which nothing was drawn yet: their steps rely on nothing that coincides in the given pose alone."""
        for _ in range(MAX_OTHER_POSES if results_so_far.faults.keys() & {*remaining.places.tolist()} else 0):
            pose = int(remaining.places[remaining.places.size // 2])
            yield f"the steps of pose {pose}", decide_friction(in_pose(scene, turn, pose))[0]

    alternatives = _other_forms(drawing, elsewhere(), method, plan, inertia)
    while remaining.places.size and (alternative_way := next(alternatives, None)):
        name, alternative = alternative_way
        poses = alternative.evaluate(remaining.points, remaining.guides, loads=remaining.loads, compiled=machine,
                                     progress=report_progress("plans"))
        apart = pose_gaps(remaining, alternative, poses.results, report_progress("check"))
        sound = sound_poses(remaining, alternative, poses.results, apart)
        sound &= poses_rubbed_as_drawn(remaining, alternative)
        results_so_far.otherwise.update((int(place), name) for place in remaining.places[sound])
        _enter_results(results_so_far, remaining.places, poses.results, apart, sound)
        remaining = remaining.select(~sound)
    faults = {k: why for k, why in sorted(results_so_far.faults.items()) if k not in results_so_far.otherwise}
    for z in (*(z for named in results_so_far.results.values() for z in named.values()), *results_so_far.gaps.values()):
        z[list(faults)] *= np.nan  # near a limit there are numbers, and they say nothing; of a vector neither component
    return replace(results_so_far, faults=faults, wrong=tuple(int(k) for k in remaining.places if k not in faults))


def _construct(scene: Scene, **how: str) -> Construction:
    """The construction, compared with the solver in the given pose unless that is singular."""
    try:
        return construct(scene, **how)  # type: ignore[arg-type]
    except (SingularPose, ConstructionError):
        return unchecked(scene, **how)  # type: ignore[arg-type]


def _recorded_way(stream: Stream, workers: int | str,
                  progress: Callable[[int, int], None]) -> tuple[Turn, PoseBatch, Cycle]:
    """The turn, the poses of it in which the recorded steps do not serve, and what they give in all, block by block.
    """
    scene, count = stream.drawing.scene, stream.positions
    blocks, remaining, done = list[Turn](), list[PoseBatch](), 0
    gaps = {kind: np.full(count, np.nan) for kind in compared_groups(stream.drawing)}
    nowhere = Turn(np.empty(0), {}, {}, {})
    over_cycle = Cycle(scene, stream.drawing, nowhere, stream.drawing.empty_arrays(count), {}, gaps)
    for part in stream.shared_out(_compare_block, workers):
        _enter_results(over_cycle, done + part.reached.places, part.results, part.gaps, slice(None))
        over_cycle.faults.update((done + place, why) for place, why in part.faults.items())
        remaining.append(part.reached.select(~part.sound).moved_on(done))
        blocks.append(part.turn)
        done += len(part.turn.travel)
        progress(done, count)
    turn = turn_of_parts(blocks, stream.motion)
    centrodes = sheet_centrodes(stream.motion, turn.travel)
    return turn, PoseBatch.of_parts(remaining), replace(over_cycle, turn=turn, centrodes=centrodes)


def _compare_block(of: Stream, start: int) -> ComparedPoses:
    """The block that begins there, as it is sent: whoever asked for it has the motion."""
    poses = of.compare(start)
    return poses._replace(turn=replace(poses.turn, motion=None))


def _other_forms(drawing: Construction, elsewhere: Iterator[tuple[str, Scene]], method: str, plan: str,
                 inertia: str) -> Iterator[tuple[str, Construction]]:
    """Where the form is free, the constructions that go another way through a ring; then those that are recorded
    elsewhere."""
    for name in () if method else METHODS:
        alternative = _construct_or_none(drawing.scene, name, plan, inertia)
        if alternative and alternative.ways != drawing.ways:
            yield ", ".join(alternative.ways), alternative
    for name, scene in elsewhere:
        if alternative := _construct_or_none(scene, method, plan, inertia):
            yield name, alternative


def _construct_or_none(scene: Scene, method: str, plan: str, inertia: str) -> Construction | None:
    """The construction in a scene's own pose, if there is one."""
    try:
        return unchecked(scene, method=method, plan=plan, inertia=inertia)
    except GraphplanError:
        return None


def _enter_results(over_cycle: Cycle, places: Any, results: Results, apart: Mapping[str, Any], kept: Any) -> None:
    """Enter the results of poses among all, at these places, of those that are kept."""
    places = places[kept]
    for kind, named in results.items():
        for name, z in named.items():
            over_cycle.results[kind][name][places] = z[kept]
    for kind, gap in apart.items():
        over_cycle.gaps[kind][places] = gap[kept]


# ---- curves: the motion of a link, of a slide or of a point's coordinate, with its rates from the plans --------------


@dataclass(frozen=True)
class PlotQuantity:
    """What is to be plotted: how it is called, its unit, and the points whose rates tell it."""

    name: str
    label: Said
    unit: str
    points: tuple[str, ...]
    slide: Slide | None = None


def quantities(scene: Scene, names: Sequence[str]) -> tuple[PlotQuantity, ...]:
    """What these names mean: links, slides, coordinates such as `B.x`; without names what the mechanism drives.

    Fails with `Refused` where a name means nothing, where there are too many, or where the first drive has no constant
    rate, so that there are no diagrams over time.
    """
    drive = scene.drives[0] if scene.drives else None
    if drive is None or not drive.rate or drive.change:
        raise Refused("diagrams", "the first drive has no constant rate: there are no diagrams over time",
                      "a [[drive]] with a rate and without acceleration")
    names = names or _output_names(scene)
    if len(names) > MAX_DIAGRAMS:
        raise Refused("diagrams", f"{len(names)} are too many for one sheet", f"at most {MAX_DIAGRAMS}")
    return tuple(_plot_quantity(scene, name) for name in names)


def scene_asking_for(scene: Scene, wanted: Sequence[PlotQuantity]) -> Scene:
    """The scene, asking also for what these quantities are told by."""
    find = scene.find
    points = [point for quantity in wanted for point in quantity.points]
    velocity, acceleration = (tuple(p for p in scene.points if p in {*requested, *points})
                              for requested in (find.velocity, find.acceleration))
    names = [quantity.name for quantity in wanted]
    links, slides = (None if requested is None else tuple(name for name in available if name in {*requested, *names})
                     for requested, available in ((find.links, scene.moving),
                                                  (find.slides, [s.name for s in scene.slides])))
    return replace(scene, find=replace(find, velocity=velocity, acceleration=acceleration, links=links, slides=slides))


def curves(over_cycle: Cycle, wanted: Sequence[PlotQuantity]) -> list[KinematicCurve]:
    """The curves of these quantities over the cycle, which was asked for them."""
    drive = over_cycle.scene.drives[0]
    period = TURN if over_cycle.turn.closed and not over_cycle.faults else None
    unit = over_cycle.scene.units.length if drive.slides else "rad"
    return [curve_over_travel(quantity.label, quantity.unit, over_cycle.turn.travel, float(drive.rate),
                              *_ordinates(over_cycle, quantity),
                              period=period, travel_unit=unit) for quantity in wanted]


def _output_names(scene: Scene) -> list[str]:
    """The slides on the frame, and the links that turn on it and show a side, that no drive moves."""
    driven = {drive.links[0] for drive in scene.drives}
    outputs = [s.name for s in scene.slides if FRAME in (s.along, s.link) and s.link not in driven]
    fixed = set(scene.links.get(FRAME, ()))
    sides = [link for link in scene.moving if link not in driven and len(scene.links[link]) > 1]
    outputs += [link for link in sides if fixed & set(scene.links[link])]
    return outputs[:MAX_DIAGRAMS] or sides[:1]


def _plot_quantity(scene: Scene, name: str) -> PlotQuantity:
    length = scene.units.length
    slide = next((s for s in scene.slides if s.name == name), None)
    point, _, axis = name.rpartition(".")
    if slide is not None:
        return PlotQuantity(name, said("slide {0}", slide_named(slide)), length, (slide.at,), slide)
    if len(scene.links.get(name, ())) > 1 and name != FRAME:
        return PlotQuantity(name, said("angle of link {0}", name), "rad", _side(scene, name))
    if point in scene.points and axis in ("x", "y"):
        return PlotQuantity(name, said("{0} of {1}", axis, point), length, (point,))
    links = [link for link in scene.moving if len(scene.links[link]) > 1]
    available = [*links, *(s.name for s in scene.slides), *(f"{p}.x" for p in scene.points)]
    raise Refused(f"diagram of {name}", "unknown quantity", f"one of {', '.join(available)}")


def _side(scene: Scene, link: str) -> tuple[str, str]:
    """The two points of a link that lie furthest apart."""
    places = {name: complex(*map(float, scene.points[name])) for name in scene.links[link]}
    return max(combinations(places, 2), key=lambda pair: abs(places[pair[0]] - places[pair[1]]))


def _ordinates(over_cycle: Cycle, quantity: PlotQuantity) -> tuple[Any, Any, Any]:
    """The quantity, its rate, and the rate's rate in each pose."""
    points, results = over_cycle.turn.points, over_cycle.results
    if quantity.slide is not None:
        return _slide_ordinates(over_cycle, quantity.slide)
    if quantity.unit == "rad":
        P, R = quantity.points
        return np.angle(points[R] - points[P]), results["omega"][quantity.name], results["alpha"][quantity.name]
    (point,) = quantity.points
    vectors = points[point], results["velocity"][point], results["acceleration"][point]
    s, v, a = (z.real if quantity.name.endswith(".x") else z.imag for z in vectors)
    return s, v, a


def _slide_ordinates(over_cycle: Cycle, slide: Slide) -> tuple[Any, Any, Any]:
    """How far a slide's point has slid along its guide from the given pose, with its rates there."""
    points, guides, results = over_cycle.turn.points, over_cycle.turn.guides, over_cycle.results
    along = guide_direction(slide, points, guides)
    carrier = next(iter(over_cycle.scene.links.get(slide.along, ())), "")
    seat = points[slide.at] - (points[carrier] if carrier else 0.0)
    vectors = seat, results["slide velocity"][slide.name], results["slide acceleration"][slide.name]
    s, v, a = ((z / along).real for z in vectors)
    return s - s[0], v, a
