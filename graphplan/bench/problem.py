"""Problems that are measured: mechanisms as they degenerate, and their equations for both drawing boards.

d is the tangent of an angle or a part of a length, from 1 downwards; at 0 the pose is special. Points are moved in
fractions: the special pose is special to the last digit, and floats round what they are given, as with any scene.

Errors are those of some sampled poses, against what is true of the very binary numbers that all are given.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial
from math import ceil, floor, log2
from typing import Any

import numpy as np

from graphplan.check.arithmetics import Exact, enclosures
from graphplan.check.compared import UNBOUNDED
from graphplan.check.forces import force_truth
from graphplan.check.report import ReferenceSolution, reference_solution
from graphplan.errors import Refused, missing_package
from graphplan.kernel.faithful import has_flint
from graphplan.kernel.numbers import Fractions
from graphplan.mechanism.model import Find, Pair, Scene
from graphplan.mechanism.numbers import dot, map_numbers, minus, plus, quarter_turn, times
from graphplan.mechanism.replaced import Higher, straight
from graphplan.mechanism.scene import load
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.design import Design
from graphplan.methods.recorded import components
from graphplan.solver import Rates, poses, solve
from graphplan.solver.statics import Reactions, reactions

Points = Mapping[str, Pair]

AUXILIARY, TRIAL, POLES, FALSE = "auxiliary points", "one trial figure", "relative pole", "false position"
TWO_TRIALS = "two trial figures"
ORTHOGONAL, POLAR, POLYGONS, LEVER = "orthogonal velocities", "polar plans", "force polygons", "lever"
WAYS = {
    AUXILIARY: Design(method="auxiliary"), TRIAL: Design(method="trial"), POLES: Design(method="poles"),
    TWO_TRIALS: Design(method="trial", form="two trial figures"),
    FALSE: Design(method="trial"), ORTHOGONAL: Design("orthogonal"), POLAR: Design("polar"),
    POLYGONS: Design("polygons"), LEVER: Design("lever"),
}
LOCI, RINGS, PLANS, FORCES = (AUXILIARY, TRIAL), (POLES, FALSE), (ORTHOGONAL, POLAR), (POLYGONS, LEVER)


@dataclass(frozen=True)
class Degeneracy:
    """One way to a special pose: what happens at d = 0, what fails there and why, in which packaged scene, and which
    points are moved.

    `move` gives the moved points' places from those of the scene. `singular` says that the mechanism is singular at
    d = 0; else some of its `ways` are, and it is not.
    """

    name: str
    description: str
    failure: str
    scene: str
    singular: bool
    compared_ways: tuple[str, str]
    move: Callable[[Points, Fraction], Points]

    @property
    def words(self) -> str:
        """What happens at d = 0, and what fails there and why, as sentences."""
        return f"{self.description[0].upper()}{self.description[1:]}. {self.failure}"

    def scene_at(self, d: float) -> Scene:
        """The scene at the distance d; of its motion all joints are asked for."""
        scene = load(self.scene)
        find = replace(scene.find, velocity=scene.joints, acceleration=scene.joints)
        return replace(scene, find=find, points={**scene.points, **self.move(scene.points, Fraction(d))})


def _turn_by_tangent(v: Pair, d: Fraction) -> Pair:
    """A vector turned by an angle of tangent d, and as much longer."""
    return plus(v, times(d, quarter_turn(v)))


def _point_beyond(P: Pair, part: float, v: Pair, d: Fraction) -> Pair:
    """From a point a part of a vector on, and d of the vector aside."""
    return plus(P, plus(times(Fraction(part), v), times(d, quarter_turn(v))))


def _half(a: Pair, b: Pair) -> Pair:
    """Halfway between two points."""
    return times(Fraction(1, 2), plus(a, b))


def _crossing(a: Pair, b: Pair, c: Pair, d: Pair) -> Pair:
    """Intersection of the lines ab and cd."""
    u, n = minus(b, a), quarter_turn(minus(d, c))
    return plus(a, times(Fraction(dot(n, minus(c, a))) / dot(n, u), u))


def _on_the_line_of_poles(p: Points, d: Fraction) -> Points:
    Q = _crossing(p["K"], p["A"], p["L"], p["B"])
    R = _crossing(p["M"], p["D"], p["N"], p["E"])
    return {"C": _point_beyond(Q, 0.4375, minus(R, Q), d)}


def _bars_through_one_point(p: Points, d: Fraction) -> Points:
    X = _crossing(p["A"], p["E"], p["B"], p["F"])
    return {"C": plus(p["G"], times(Fraction(1, 8), _turn_by_tangent(minus(X, p["G"]), d)))}


def _poles_in_line(p: Points, d: Fraction) -> Points:
    X = _crossing(p["D"], p["G"], p["A"], p["B"])
    return {"E": plus(p["F"], times(Fraction(1, 2), _turn_by_tangent(minus(X, p["F"]), d)))}


def _rod_across_the_guide(p: Points, d: Fraction) -> Points:
    B = plus(p["A"], _turn_by_tangent((0, -p["A"][1]), d))
    return {"B": B, "S": plus(p["A"], times(Fraction(2, 5), minus(B, p["A"])))}


def _rocker_in_line(p: Points, d: Fraction) -> Points:
    B = _point_beyond(p["A"], 0.5625, minus(p["C"], p["A"]), d)
    return {"B": B, "S": _half(p["A"], B)}


def _crank_in_line(p: Points, d: Fraction) -> Points:
    A = _point_beyond(p["O"], 0.3125, p["B"], d)
    return {"A": A, "S": _half(A, p["B"])}


def _short_coupler(p: Points, d: Fraction) -> Points:
    B = plus(p["A"], times(d, minus(p["B"], p["A"])))
    return {name: minus(at, p["A"]) for name, at in {**p, "B": B}.items()}


def _force_along_the_crank(p: Points, d: Fraction) -> Points:
    A = _turn_by_tangent((-80, 60), -d)
    return {"A": A, "S": _half(A, p["B"])}


DEGENERACIES = (
    Degeneracy("parallel bars", "KA turned towards LB: the auxiliary point Q goes far away",
               "The auxiliary point goes to infinity and loses digits as 1/d; one trial figure lies too far "
               "out for a pencil; two trial figures stay below 10 %, so the sheet has these.", "rosenauer-basic", False,
               LOCI, lambda p, d: {"K": minus(p["A"], times(4, _turn_by_tangent(minus(p["B"], p["L"]), d)))}),
    Degeneracy("joints coincide", "B brought to A, on link 3",
               "Trial figures lose digits as their sides shrink with AB, auxiliary points none; no pencil "
               "draws below d = 0.001, where A and B fall together on paper.", "rosenauer-basic", False,
               LOCI, lambda p, d: {"B": plus(p["A"], times(d, minus(p["B"], p["A"])))}),
    Degeneracy("pole at infinity", "FE turned towards DG: the relative pole of links 2 and 5 goes far away",
               "The relative pole loses digits as 1/d; the false position needs no pole, keeps them all, and "
               "errs by 10 % by pencil.",
               "class-four", False,
               RINGS,
               lambda p, d: {"E": plus(p["F"], times(Fraction(1, 2), _turn_by_tangent(minus(p["G"], p["D"]), d)))}),
    Degeneracy("short crank", "the crank d times as long",
               "Only paper fails: floats keep all digits, but below d = 0.001 O and A fall together on it.",
               "four-bar", False,
               PLANS, lambda p, d: {"A": times(d, p["A"])}),
    Degeneracy("short coupler", "the coupler d times as long, from the origin: floats give it no better elsewhere",
               "Only paper fails, below d = 0.003; at d = 0 the coupler has no direction and the pose is "
               "singular.",
               "four-bar", True, PLANS, _short_coupler),
    Degeneracy("C on QR", "C brought to the line of the auxiliary points",
               "The pose itself is singular: the two loci of C become parallel, so that every way loses "
               "digits as 1/d, and floats with them; solve goes on in fractions.", "rosenauer-basic", True,
               LOCI, _on_the_line_of_poles),
    Degeneracy("triad", "bar GC turned towards the point where the other two meet",
               "The pose itself is singular: bars through one point no longer hold their link, and every way "
               "loses digits as 1/d; solve goes on in fractions.", "triad", True,
               LOCI, _bars_through_one_point),
    Degeneracy("class IV", "bar FE turned until the poles of links 2 and 5 lie in line",
               "The pose itself is singular: every way loses digits as 1/d, the false position first, whose "
               "two trial figures then miss alike; solve goes on in fractions.", "class-four", True,
               RINGS, _poles_in_line),
    Degeneracy("slide locks", "the rod turned perpendicular to the guide",
               "The pose itself is singular: the lines that meet in b become parallel, and both plans lose "
               "digits as 1/d; the solver loses them later.", "slider-crank", True,
               PLANS, _rod_across_the_guide),
    Degeneracy("dead centre against the drive", "coupler and rocker stretched, under load",
               "The pose itself is singular: the lines that meet in the velocity of B become parallel, and "
               "both force plans lose digits as 1/d, with the solver.", "jaanimets-10", True,
               FORCES, _rocker_in_line),
    Degeneracy("dead centre with the drive", "crank and coupler stretched, under load",
               "Nothing fails: the drive goes through this dead centre, and both force plans keep their "
               "digits, the polygons below 4 % by pencil.", "jaanimets-10", False,
               FORCES, _crank_in_line),
    Degeneracy("parallel bars, loaded", "AN turned towards FB: the auxiliary point Q goes far away",
               "As without loads: the auxiliary point loses digits as 1/d, one trial figure lies too far out "
               "for a pencil, two stay below 10 %.", "rosenauer-loaded",
               False, LOCI, lambda p, d: {"N": minus(p["A"], times(2, _turn_by_tangent(minus(p["B"], p["F"]), d)))}),
    Degeneracy("lever without arm", "the balancing force turned along the crank",
               "The pose itself is singular: a force without an arm about O balances no moment; it grows as "
               "1/d, and so do the errors of both force plans.", "jaanimets-10", True,
               FORCES, _force_along_the_crank),
)


POSE_BITS = 12
POSES = 1 << POSE_BITS  # at once
SAMPLED_POSES = 5
LARGEST_FACTOR = 1.02
TRUE_BITS = 256  # of enclosures that stand for the truth: some 70 digits
BATCH_BYTES = 8e6  # of the matrices that LAPACK solves at once
SPARE_BITS = 104  # beyond the digits that are asked for: as many as `solve --digits` takes

Results = Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True)
class TimedRun:
    """One arithmetic at work: what is called, for how many poses, and its results in the sampled pose of a number."""

    call: Callable[[], Any]
    count: int
    read: Callable[[Any, int], Results]


class Problem:
    """A scene's motion, or with `forces` all that it asks for, in many poses.

    These are `points`, complex arrays by name, or the scene's own pose enlarged by up to a fiftieth, or moved where a
    profile is straight, as wheels keep their radii: as good a mechanism each, and other roundings.
    """

    def __init__(self, scene: Scene, forces: bool = False, points: Mapping[str, Any] | None = None):
        self.scene = binary(scene, forces)
        factors: Any = np.linspace(1.0, LARGEST_FACTOR, POSES)
        shifts: Any = 0.0
        if any(isinstance(pair, Higher) and straight(pair) for pair in scene.written):
            factors, shifts = 1.0, np.arange(POSES) * 2.0 ** (floor(log2(scene.extent)) - POSE_BITS)
        self.points = dict(points or {name: complex(*map(float, at)) * factors + shifts
                                      for name, at in scene.points.items()})
        self.n = len(next(iter(self.points.values())))
        self.places = [round(k) for k in np.linspace(0, self.n - 1, SAMPLED_POSES)]

    @cached_property
    def sampled_points(self) -> list[dict[str, complex]]:
        """The points in the sampled poses."""
        return [{name: complex(z[k]) for name, z in self.points.items()} for k in self.places]

    @cached_property
    def truths(self) -> list[ReferenceSolution]:
        """True results in the sampled poses."""
        return [truth(place_points(self.scene, pose)) for pose in self.sampled_points]

    def error(self, run: TimedRun, found: Any) -> float:
        """The largest error of any number in the sampled poses, relative to the largest of its kind."""
        readings = (run.read(found, j) for j in range(SAMPLED_POSES))
        return max(largest_error(results, true.truth(results))
                   for results, true in zip(readings, self.truths, strict=True))

    def run_each(self, one: Callable[[Any], Any], given: Sequence[Any],
                 read: Callable[[Any], Results] = lambda found: found) -> TimedRun:
        """A run over the sampled poses, one after the other."""
        return TimedRun(lambda: [one(pose) for pose in given], SAMPLED_POSES, lambda found, j: read(found[j]))

    def arrays(self, call: Callable[[], Results]) -> TimedRun:
        """A run over all poses: results as arrays of them, as pairs of arrays, or as numbers that never change."""
        return TimedRun(call, self.n, lambda found, j: {kind: {name: self._value_at(self.places[j], value)
                                                               for name, value in named.items()}
                                                        for kind, named in found.items()})

    def _value_at(self, k: int, value: Any) -> Any:
        if isinstance(value, tuple):
            return tuple(float(np.broadcast_to(component, self.n)[k]) for component in value)
        number = np.broadcast_to(value, self.n)[k]
        return (float(number.real), float(number.imag)) if np.iscomplexobj(number) else float(number)


def largest_error(results: Results, true: Results) -> float:
    """The largest error of any number, relative to the largest of its kind; of an enclosure that of its farther bound.

    Angular accelerations are read off a plan on which the normal ones stand: relative to the largest ω², if that is
    larger.
    """
    worst = 0.0
    for kind, named in results.items():
        true_numbers = {name: components(true[kind][name]) for name in named}
        largest = max((abs(_middle(number)) for numbers in true_numbers.values() for number in numbers), default=0)
        if kind == kinds.ALPHA:
            largest = max([largest, *(abs(_middle(turning)) ** 2 for turning in true.get(kinds.OMEGA, {}).values())])
        gap = max((abs(_middle(ours) - _middle(number)) + getattr(ours, "error", 0) for name, value in named.items()
                   for ours, number in zip(components(value), true_numbers[name], strict=True)), default=0)
        worst = max(worst, float(gap / largest) if largest else 0.0)
    return worst


def _middle(number: Any) -> Fraction:
    return Fraction(getattr(number, "middle", number))


def binary(scene: Scene, forces: bool = False) -> Scene:
    """A scene in binary fractions: of its motion the velocities and accelerations of the points asked for or of all
    joints; with `forces` what it asks for itself, without friction, whose rounds are no one system."""
    joints = scene.find.velocity or scene.joints
    find = scene.find if forces else Find(joints, scene.find.acceleration or joints, links=(), slides=())
    driven = scene.with_drives(drive.driven_at(*drive.rates) for drive in scene.drives)
    loads = replace(scene.loads, frictions=()) if forces and scene.loads else None
    plain = replace(driven, irrational=(), placements={}, find=find, loads=loads)
    numbers = {"points": plain.points, "written": tuple(map(_as_given, plain.written)), "motions": plain.motions,
               "loads": loads and replace(loads, balances=tuple(map(_as_given, loads.balances)))}
    return place_points(replace(plain, **map_numbers(numbers, lambda number: Fraction(float(number)))), {})


def _as_given(one: Any) -> Any:
    """A pair or a balance whose direction is the numbers that it has, however it was written."""
    return replace(one, written=None) if getattr(one, "written", None) is not None else one


def place_points(scene: Scene, places: Mapping[str, complex]) -> Scene:
    """A binary scene with some points elsewhere; guides through two points turn with them."""
    points = scene.points | {name: (Fraction(z.real), Fraction(z.imag)) for name, z in places.items()}

    def direction(one: Any) -> Any:
        if getattr(one, "through", None) is None:
            return one.direction
        (ax, ay), (bx, by) = (points[name] for name in one.through)
        return bx - ax, by - ay

    return scene.with_pose(points, direction)


def truth(scene: Scene) -> ReferenceSolution:
    """True results of a binary scene: in fractions, or beyond fifty digits if a root is irrational.

    Fails with `Refused` where that would need enclosures and they are not installed, with `SingularPose` as `solve`.
    """
    try:
        return reference_solution(scene, Exact())
    except Refused:
        if not has_flint():
            raise
    by = enclosures(TRUE_BITS)
    with by.working():
        return reference_solution(scene, by)


def _given_coordinates(drawing: Construction, poses: Sequence[Mapping[str, Any]]) -> list[dict[str, dict[str, Any]]]:
    """The coordinates of each pose as a construction is given them."""
    names = {step.name for step in drawing.program.steps[:drawing.program.givens]}
    return [{name: {"x": Fraction(z.real), "y": Fraction(z.imag)} for name, z in pose.items() if name in names}
            for pose in poses]


def _run_fractions(problem: Problem, drawing: Construction) -> TimedRun:
    """The rules in fractions, one pose after the other."""
    return problem.run_each(lambda pose: drawing.read(Fractions(), pose),
                            _given_coordinates(drawing, problem.sampled_points))


def _run_replay(problem: Problem, drawing: Construction) -> TimedRun:
    """The replay that was written down from the tape, one pose after the other."""
    return problem.run_each(drawing.replay, problem.sampled_points)


def _in_blocks(machine: bool, problem: Problem, drawing: Construction) -> TimedRun:
    """The tape on blocks of poses, by numpy or compiled."""
    return problem.arrays(lambda: drawing.evaluate(problem.points, compiled=machine).results)


def _run_enclosures(digits: int, problem: Problem, drawing: Construction) -> TimedRun:
    """The rules between proven bounds, to so many digits."""
    if not has_flint():
        raise missing_package("enclosures", "python-flint", "certified")
    from graphplan.kernel.numbers.enclosures import Enclosures, precision

    coordinates, bits = _given_coordinates(drawing, problem.sampled_points), ceil(digits * log2(10)) + SPARE_BITS

    def call() -> list[Results]:
        with precision(bits):
            return [drawing.read(Enclosures(), numbers) for numbers in coordinates]

    return TimedRun(call, SAMPLED_POSES, lambda found, j: found[j])


ONE, MANY, COMPILED = "one pose", "many poses", "many poses, compiled"
TWENTY, FORTY, FRACTIONS = "20 proven digits", "40 proven digits", "fractions"
ARITHMETICS: dict[str, Callable[[Problem, Construction], TimedRun]] = {
    ONE: _run_replay,
    MANY: partial(_in_blocks, False),
    COMPILED: partial(_in_blocks, True),
    TWENTY: partial(_run_enclosures, 20),
    FORTY: partial(_run_enclosures, 40),
    FRACTIONS: _run_fractions,
}


def _run_solver(exact: bool, problem: Problem) -> TimedRun:
    """The solver, one pose after the other."""
    lift = place_points if exact else partial(poses.scene_in_poses, guides={})

    def solve_one(scene: Scene) -> Rates | Reactions:
        return solve(scene, exact) if scene.loads is None else reactions(scene, exact)

    return problem.run_each(solve_one, [lift(problem.scene, pose) for pose in problem.sampled_points],
                            partial(_requested_results, problem.scene))


def _run_lapack(problem: Problem) -> TimedRun:
    """The solver over many poses, in batches of LAPACK whose matrices take few megabytes: measured to be fastest."""
    batch = max(1, int(BATCH_BYTES / (8 * (3 * len(problem.scene.moving)) ** 2)))
    starts = range(0, problem.n, batch)
    sizes = [min(batch, problem.n - start) for start in starts]

    def solve_block(start: int, count: int) -> Results:
        block = {name: z[start : start + count] for name, z in problem.points.items()}
        scene = poses.scene_in_poses(problem.scene, block, {})
        rates = poses.solve(scene, count)
        return _requested_results(scene, rates if scene.loads is None else poses.reactions(scene, rates, count))

    return problem.arrays(lambda: _join_blocks(list(map(solve_block, starts, sizes)), sizes))


def _join_blocks(parts: Sequence[Results], sizes: Sequence[int]) -> Results:
    """The results of blocks of these sizes as those of all poses, pairs of arrays."""
    def join_values(values: Sequence[Any]) -> Any:
        if isinstance(values[0], tuple):
            return tuple(map(join_values, zip(*values, strict=True)))
        return np.concatenate([np.broadcast_to(value, count) for value, count in zip(values, sizes, strict=True)])

    return {kind: {name: join_values([block[kind][name] for block in parts]) for name in named}
            for kind, named in parts[0].items()}


def _requested_results(scene: Scene, answer: Rates | Reactions) -> Results:
    """Results that a scene asks of the solver."""
    motion, forces = (answer, {}) if isinstance(answer, Rates) else (answer.rates, force_truth(scene, {}, answer))
    return {kinds.VELOCITY: {name: motion.velocity[name] for name in scene.find.velocity},
            kinds.ACCELERATION: {name: motion.acceleration[name] for name in scene.find.acceleration},
            **{kind: named for kind, named in forces.items() if kind not in UNBOUNDED}}


SOLVER, LAPACK, EXACT_SOLVER = "solver, one pose", "solver, LAPACK batches", "solver, fractions"
SOLVERS: dict[str, Callable[[Problem], TimedRun]] = {
    SOLVER: partial(_run_solver, False), LAPACK: _run_lapack, EXACT_SOLVER: partial(_run_solver, True)}
