"""The construction all the way round: one recorded program replayed in every pose, against the analytic solver in each.

Where the recorded way through a ring of links cannot be drawn in a pose, or lets rounding grow there, the other forms
are tried for that pose, and which one served is noted.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import combinations
from typing import Any

import numpy as np

from graphplan.check.answerable import regular_part
from graphplan.check.arithmetics import decide_friction
from graphplan.check.compared import Readings, Results
from graphplan.check.stream import (
    ComparedPoses,
    PoseBatch,
    Stream,
    compared_groups,
    pose_gaps,
    poses_rubbed_as_drawn,
    sound_poses,
)
from graphplan.check.trusted import construct, unjudged_construction
from graphplan.cycle.diagrams import KinematicCurve, curve_over_travel
from graphplan.cycle.loads import guide_direction
from graphplan.cycle.motion_curves import Centrodes, sheet_centrodes
from graphplan.cycle.pose import in_pose
from graphplan.cycle.travel import afford_poses
from graphplan.cycle.turn import Turn, turn_of_parts
from graphplan.design.decide import construct as unchecked
from graphplan.errors import ConstructionError, GraphplanError, Refused, SingularPose
from graphplan.mechanism.model import FRAME, Scene, Slide
from graphplan.mechanism.sections import METHODS
from graphplan.mechanism.travel import TURN
from graphplan.methods.construction import Construction
from graphplan.methods.design import OPEN, Design
from graphplan.methods.panels import slide_named
from graphplan.phrases import Said, said
from graphplan.solver import solve

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
        """Places of the points whose velocities, accelerations or paths are asked for; then the centrodes."""
        return requested_points(self.scene, self.turn) | {
            f"{kind} centrode {links}": places for links, curves in self.centrodes.items()
            for kind, places in zip(("fixed", "moving"), curves, strict=True)}

    @cached_property
    def efficiency(self) -> Any:
        """The instantaneous efficiency in each pose; None of a machine without friction."""
        return efficiency_of(self.scene, self.turn, self.results)

    @property
    def check(self) -> dict[str, float]:
        """The largest difference from the solver in any pose, by kind."""
        return {kind: float(np.nanmax(gap, initial=0.0)) for kind, gap in self.gaps.items()}


def efficiency_of(scene: Scene, turn: Turn, results: Mapping[str, Mapping[str, Any]]) -> Any:
    """The instantaneous efficiency in each pose; None of a machine without friction."""
    if scene.loads is None or not scene.loads.frictions:
        return None
    from graphplan.check.efficiency import efficiency_in_poses

    return efficiency_in_poses(scene, turn, results)


def requested_points(scene: Scene, turn: Turn) -> dict[str, Any]:
    """Places of the points whose velocities, accelerations or paths are asked for."""
    names = {*scene.find.velocity, *scene.find.acceleration, *scene.sheet.curves}
    return {name: turn.points[name] for name in scene.points if name in names}


def cycle(scene: Scene, positions: int, span: tuple[float, float] | None = None, wishes: Design = OPEN, *,
          workers: int | str = 1, progress: Progress | None = None) -> Cycle:
    """The construction in so many poses of the drive's turn, or of a span of its travel, and the check in each.

    Reads a scene with a drive; `workers` are told ranges of poses and give back what is drawn and compared in each, as
    those of a :class:`Stream`; `progress` is told what is being done, how many poses are done, of how many. Fails as
    `follow` and `construct` do.
    """
    afford_poses(positions)
    return join_blocks([*cycle_blocks(scene, positions, span, wishes, workers=workers, progress=progress)])


def cycle_blocks(scene: Scene, positions: int, span: tuple[float, float] | None = None, wishes: Design = OPEN, *,
                 workers: int | str = 1, progress: Progress | None = None) -> Iterator[Cycle]:
    """Yield the cycle block by block, in the memory of one: successive poses, numbered from the block's first."""
    def report_progress(what: str) -> Callable[[int, int], None]:
        return lambda done, of: progress(what, done, of) if progress else None

    drawing = _construct(scene, wishes)
    shares = 1 if isinstance(workers, str) else max(1, workers)
    length = min(MAX_BLOCK, max(MIN_BLOCK, -(-positions // (SHARES_EACH * shares))))
    stream = Stream(drawing, positions, span, length=length,
                    progress=lambda part: report_progress("positions")(round(part * positions), positions))
    other_ways, done = OtherWays(scene, drawing, wishes), 0
    for compared in stream.shared_out(_compare_block, workers):
        block, remaining = _recorded_way(stream, compared)
        start, done = done, done + len(block.turn.travel)
        report_progress("poses")(done, positions)
        remaining = other_ways.draw_remaining(block, start, remaining, report_progress)
        faults = {k: why for k, why in sorted(block.faults.items()) if k not in block.otherwise}
        for z in (*(z for named in block.results.values() for z in named.values()), *block.gaps.values()):
            z[list(faults)] *= np.nan  # near a limit numbers say nothing; of a vector neither component
        other_ways.enter_regular_part(block, remaining.select(np.isin(remaining.places, [*faults])))
        yield replace(block, faults=faults, wrong=tuple(int(k) for k in remaining.places if k not in faults))


def join_blocks(blocks: Sequence[Cycle]) -> Cycle:
    """Neighbouring blocks of one motion, in their order and one at least, as one."""
    starts = np.cumsum([0, *(len(block.turn.travel) for block in blocks)]).tolist()

    def arrays(parts: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
        return {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}

    def shift_places(notes: Sequence[Mapping[int, str]]) -> dict[int, str]:
        return {start + place: note for start, noted in zip(starts, notes, strict=False)
                for place, note in noted.items()}

    first, motion = blocks[0], blocks[0].turn.motion
    assert motion is not None
    turn = turn_of_parts([block.turn for block in blocks], motion)
    results = {kind: arrays([block.results[kind] for block in blocks]) for kind in first.results}
    faults, otherwise = (shift_places([getattr(block, notes) for block in blocks]) for notes in ("faults", "otherwise"))
    wrong = tuple(start + k for start, block in zip(starts, blocks, strict=False) for k in block.wrong)
    curves = {names: [block.centrodes[names] for block in blocks] for names in first.centrodes}
    centrodes = {names: Centrodes(*map(np.concatenate, zip(*parts, strict=True))) for names, parts in curves.items()}
    return Cycle(first.scene, first.drawing, turn, results, faults, arrays([block.gaps for block in blocks]), otherwise,
                 wrong, centrodes)


def _construct(scene: Scene, wishes: Design) -> Construction:
    """The construction, compared with the solver in the given pose unless that is singular."""
    try:
        return construct(scene, wishes)
    except (SingularPose, ConstructionError):
        return unjudged_construction(scene, wishes)


def _recorded_way(stream: Stream, compared: ComparedPoses) -> tuple[Cycle, PoseBatch]:
    """The results of the recorded steps in a block, and its poses for which these steps are not valid."""
    turn, drawing = replace(compared.turn, motion=stream.motion), stream.drawing
    count = len(turn.travel)
    gaps = {kind: np.full(count, np.nan) for kind in compared_groups(drawing)}
    block = Cycle(drawing.scene, drawing, turn, drawing.empty_arrays(count), dict(compared.faults), gaps,
                  centrodes=sheet_centrodes(stream.motion, turn.travel))
    _enter_results(block, compared.reached.places, compared.results, compared.gaps, slice(None))
    return block, compared.reached.select(~compared.sound)


def _compare_block(of: Stream, start: int) -> ComparedPoses:
    """The block that begins there, as it is sent: whoever asked for it has the motion."""
    poses = of.compare(start)
    return poses._replace(turn=replace(poses.turn, motion=None))


class OtherWays:
    """Constructions for poses in which the recorded steps are not valid, each made when the first pose needs it: if the
    form is free, those that go another way through a ring; then those that are recorded in other poses, whose steps
    rely on no coincidence of the given pose."""

    def __init__(self, scene: Scene, drawing: Construction, wishes: Design):
        self.scene, self.drawing, self.wishes = scene, drawing, wishes
        self.ways_kept = list[tuple[str, Construction]]()
        self.forms, self.poses_recorded = iter(() if wishes.method else METHODS), 0

    def draw_remaining(self, block: Cycle, start: int, remaining: PoseBatch,
                       report: Callable[[str], Callable[[int, int], None]]) -> PoseBatch:
        """Draw what remains of a block, which begins with this pose; what still remains then."""
        kept = iter([*self.ways_kept])
        while remaining.places.size and (way := next(kept, None) or self._another_way(block, start, remaining.places)):
            name, alternative = way
            poses = alternative.evaluate(remaining.points, remaining.guides, loads=remaining.loads,
                                         progress=report("plans"))
            apart = pose_gaps(remaining, alternative, poses.results, report("check"))
            sound = sound_poses(remaining, alternative, poses.results, apart)
            sound &= poses_rubbed_as_drawn(remaining, alternative)
            block.otherwise.update((int(place), name) for place in remaining.places[sound])
            _enter_results(block, remaining.places, poses.results, apart, sound)
            remaining = remaining.select(~sound)
        return remaining

    def enter_regular_part(self, block: Cycle, singular: PoseBatch) -> None:
        """Enter what is known in poses that are singular in part; why the rest is not stays their fault."""
        if not singular.places.size:
            return
        posed = in_pose(self.scene, block.turn, int(singular.places[0]))
        regular = regular_part(replace(posed, irrational=("the pose",)))
        if regular is None:
            return
        batch = singular.of_part(regular[0])
        try:
            drawing = unchecked(batch.scene, self.wishes)
        except GraphplanError:
            return
        results = drawing.evaluate(batch.points, batch.guides, loads=batch.loads).results
        sound = sound_poses(batch, drawing, results, pose_gaps(batch, drawing, results))
        _enter_results(block, batch.places, results, {}, sound)

    def _another_way(self, block: Cycle, start: int, places: Any) -> tuple[str, Construction] | None:
        """The next that was not made yet, for the poses of a block at these places; None where there are no more."""
        while form := next(self.forms, None):
            alternative = self._construct_alike(self.drawing.scene, form)
            if alternative and alternative.ways != self.drawing.ways:
                return self._keep_way(", ".join(alternative.ways), alternative)
        while block.faults.keys() & {*places.tolist()} and self.poses_recorded < MAX_OTHER_POSES:
            self.poses_recorded += 1
            pose = int(places[places.size // 2])
            scene_there = decide_friction(in_pose(self.scene, block.turn, pose))[0]
            if alternative := self._construct_alike(scene_there, self.wishes.method):
                return self._keep_way(f"the steps of pose {start + pose}", alternative)
        return None

    def _construct_alike(self, scene: Scene, method: str) -> Construction | None:
        """The construction in a scene's own pose, if that is not singular, so that no way serves, and the same is read
        from it: a pole at infinity in one pose alone is another result."""
        try:
            solve(scene)
            alternative = unchecked(scene, replace(self.wishes, method=method))
        except GraphplanError:
            return None
        return alternative if _names_read(alternative) == _names_read(self.drawing) else None

    def _keep_way(self, name: str, alternative: Construction) -> tuple[str, Construction]:
        self.ways_kept.append((name, alternative))
        return name, alternative


def _names_read(drawing: Construction) -> set[tuple[str, str]]:
    return {(reading.kind, reading.of) for reading in drawing.readings}


def _enter_results(over_cycle: Cycle, places: Any, results: Results, apart: Mapping[str, Any], kept: Any) -> None:
    """Enter the results of poses among all, at these places, of those that are kept; what no pose of the cycle is asked
    for, as the rate of a link that a part of the mechanism shows, stays out."""
    places = places[kept]
    for kind, named in over_cycle.results.items():
        for name, z in results.get(kind, {}).items():
            if name in named:
                named[name][places] = z[kept]
    for kind, gap in apart.items():
        over_cycle.gaps[kind][places] = gap[kept]


# ---- curves: the motion of a link, of a slide or of a point's coordinate, with its rates from the plans --------------


@dataclass(frozen=True)
class PlotQuantity:
    """A quantity to be plotted: its name, its unit, and the points whose rates give it."""

    name: str
    label: Said
    unit: str
    points: tuple[str, ...]
    slide: Slide | None = None


def quantities(scene: Scene, names: Sequence[str]) -> tuple[PlotQuantity, ...]:
    """The quantities of these names: links, slides, coordinates such as `B.x`; without names those of the driven links.

    Fails with `Refused` if a name is unknown, if there are too many, or if the first drive has no constant rate, so
    that there are no diagrams over time.
    """
    drive = scene.drives[0] if scene.drives else None
    if drive is None or not drive.rate or drive.change:
        raise Refused("diagrams", "the first drive has no constant rate: there are no diagrams over time",
                      "a [[drive]] with a rate and without acceleration")
    names = names or _output_names(scene)
    if len(names) > MAX_DIAGRAMS:
        raise Refused("diagrams", f"{len(names)} are too many for one sheet", f"at most {MAX_DIAGRAMS}")
    return tuple(_plot_quantity(scene, name) for name in names)


def side_of_link(scene: Scene, link: str) -> tuple[str, str]:
    """The two points of a link that lie furthest apart."""
    places = {name: complex(*map(float, scene.points[name])) for name in scene.links[link]}
    return max(combinations(places, 2), key=lambda pair: abs(places[pair[0]] - places[pair[1]]))


def is_plot_quantity(scene: Scene, name: str) -> bool:
    """Whether a name means a link, a slide or a coordinate, whose diagrams have chords and tangents."""
    try:
        _plot_quantity(scene, name)
    except Refused:
        return False
    return True


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
        return PlotQuantity(name, said("angle of link {0}", name), "rad", side_of_link(scene, name))
    if point in scene.points and axis in ("x", "y"):
        return PlotQuantity(name, said("{0} of {1}", axis, point), length, (point,))
    links = [link for link in scene.moving if len(scene.links[link]) > 1]
    available = [*links, *(s.name for s in scene.slides), *(f"{p}.x" for p in scene.points)]
    raise Refused(f"diagram of {name}", "unknown quantity", f"one of {', '.join(available)}")


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
    """Travel of a slide's point along its guide from the given pose, with its rates."""
    points, guides, results = over_cycle.turn.points, over_cycle.turn.guides, over_cycle.results
    along = guide_direction(slide, points, guides)
    carrier = next(iter(over_cycle.scene.links.get(slide.along, ())), "")
    seat = points[slide.at] - (points[carrier] if carrier else 0.0)
    vectors = seat, results["slide velocity"][slide.name], results["slide acceleration"][slide.name]
    s, v, a = ((z / along).real for z in vectors)
    return s - s[0], v, a
