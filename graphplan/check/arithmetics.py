"""The arithmetics in which a scene is solved, and which pairs stand still, so that nothing rubs in them.

All take the scene as it is written: a rational one is exact, and what is not is computed once more from its placements,
angles and turns a minute.

A scene whose links are held just once has a square system. Where special geometry makes facts redundant, as many are
kept as there are unknowns; that the others hold, too, is checked.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext, suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from graphplan.errors import GraphplanError, Refused, SingularPose, Undrawable
from graphplan.kernel.faithful import has_flint
from graphplan.kernel.numbers import Domain, Floats, Fractions
from graphplan.kernel.passes import freeze
from graphplan.kernel.program import Board, evaluate
from graphplan.mechanism.fields import Misfit, vector
from graphplan.mechanism.model import Balance, Drive, Pair, Scene, Slide
from graphplan.mechanism.numbers import FLOAT_RECKONING, Reckoning, dot, is_exact, map_numbers
from graphplan.mechanism.placements import placed_by
from graphplan.mechanism.travel import moved_on
from graphplan.methods.assembly import Assembler
from graphplan.solver import solve
from graphplan.solver.linear import PI, BoundedSystem, Unproven, blocks, bounded_number, by_blocks, heading
from graphplan.solver.rates import Equations, Rates, motion, motion_equations, reach

DIGITS = 160  # of the enclosures that are computed where floats do not decide


@dataclass(frozen=True)
class Exact:
    """Arithmetic in fractions: every number is exact."""

    name: str = "fractions"
    domain: Callable[[], Domain] = Fractions
    doubt: type[Exception] = Unproven
    working: Callable[[], AbstractContextManager[None]] = nullcontext


@dataclass(frozen=True)
class Bounds:
    """An arithmetic of numbers with bounds, and its solution of linear systems.

    `solve` reads rows, the scale of each unknown, and gives what solves for a right-hand side; `doubt` is the error
    where the bounds are too wide to tell; `working` is the context in which it is computed.
    """

    name: str
    domain: Callable[[], Domain]
    doubt: type[Exception]
    lift: Callable[[Any], Any]
    pi: Callable[[], Any]
    heading: Callable[[Fraction], tuple[Any, Any]]
    solve: Callable[[Sequence[Mapping[int, Any]], Sequence[float]], Callable[[Sequence[Any]], list[Any]]]
    middle: Callable[[Any], Any]
    rounds: int
    working: Callable[[], AbstractContextManager[None]] = nullcontext

    def root(self, square: Any) -> Any:
        """The square root of a number that is not negative."""
        return self.lift(square).root

    @property
    def reckoning(self) -> Reckoning:
        """Roots and angles of placements, as fractions where possible."""
        return Reckoning(self._root, self._heading)

    def _root(self, square: Any) -> tuple[Any, bool]:
        if isinstance(square, Fraction):
            root, exact = FLOAT_RECKONING.root(square)
            if exact:
                return root, True
        return self.root(square), False

    def _heading(self, degrees: Fraction) -> tuple[Any, Any, bool]:
        return FLOAT_RECKONING.heading(degrees) if degrees % 90 == 0 else (*self.heading(degrees), False)


FLOATS = Bounds("floats", Floats, Unproven, bounded_number, lambda: PI, heading,
                lambda rows, scales: BoundedSystem(rows, scales).solve,
                lambda number: bounded_number(number.value), Domain.rounds)


def enclosures(bits: int = DIGITS * 10 // 3) -> Bounds:
    """Enclosures of this precision; fails with `ImportError` without python-flint."""
    from graphplan.kernel.numbers.enclosures import Enclosure, Enclosures, Undecided, heading, pi, precision, solve

    def solve_system(rows: Sequence[Mapping[int, Any]], _: Sequence[float]) -> Callable[[Sequence[Any]], list[Any]]:
        return by_blocks(rows, blocks(rows, len(rows)), lambda block, local_rows: solve(local_rows))

    name = f"enclosures of {math.floor(bits * math.log10(2))} digits"
    return Bounds(name, Enclosures, Undecided, Enclosure, pi, heading, solve_system, Enclosures().middle,
                  4 + bits // 32, lambda: precision(bits))


Arithmetic = Exact | Bounds


def enclose_scene(scene: Scene, by: Bounds) -> Scene:
    """The scene in numbers with bounds: placements, angles and rpm as written, any other float as it is.

    Points that the scene's floats hold for one, and that cannot be told apart, are one. Fails with `Refused` where
    arcs miss each other that touch to a float's digits.
    """
    if scene.assembly is not None:
        scene = enclose_assembly(scene, enclose_scene(scene.assembly.given_scene, by), by)

    def direction(one: Slide | Balance) -> Any:
        if scene.assembly is not None or one.written is None:
            return one.direction
        return vector(one.written, points.__getitem__, by.reckoning)[:2]

    def enclose_drive(one: Drive) -> Drive:
        return one.driven_at(by.pi() * one.rpm / 30, one.change) if one.rpm else one

    try:
        points = _points(scene, by)
        posed = scene.with_pose(points, direction)
    except Misfit as misfit:
        raise Refused(f"{scene.name}: points", misfit.what, misfit.instead) from None
    except by.doubt:
        raise by.doubt("whether the arcs of its points meet cannot be told") from None
    posed = posed.with_drives(map(enclose_drive, posed.drives))
    values = {field_name: getattr(posed, field_name) for field_name in ("points", "written", "loads", "motions")}
    return replace(posed, **map_numbers(values,
                                        lambda number: by.lift(number) if isinstance(number, float) else number))


def _points(scene: Scene, by: Bounds) -> dict[str, Pair]:
    """Every point where its placement puts it; coinciding ones are the very same."""
    if not scene.irrational or scene.assembly is not None:
        return scene.points
    placements = placed_by(scene.placements, by.reckoning)
    first: dict[Pair, Pair] = {}
    points: dict[str, Pair] = {}
    for name, at in scene.points.items():
        place = at if is_exact(at) else placements.get(name, at)
        first_place = first.setdefault(at, place)
        same = all(by.lift(p).overlaps(by.lift(q)) for p, q in zip(place, first_place, strict=True))
        points[name] = first_place if same else place
    return points


class Proofs(Domain):
    """Numbers with bounds in the rules of a construction: what they cannot tell is in doubt."""

    def __init__(self, by: Bounds):
        self._by, self.rounds = by, by.rounds

    def lift(self, value: Any) -> Any:
        return self._by.lift(value)

    def sqrt(self, value: Any, code: str, why: str) -> Any:
        if value < 0:
            raise Undrawable(code, why)
        return self._by.root(value)

    def nonzero(self, value: Any, scale: Any, code: str, why: str) -> Any:
        if value.overlaps(self._by.lift(0)):
            raise self._by.doubt(why)
        return value

    def sign(self, value: Any, scale: Any) -> Any:
        raise self._by.doubt("the sense of a motion")

    def middle(self, value: Any) -> Any:
        return self._by.middle(value)


def enclose_assembly(scene: Scene, given: Scene, by: Bounds) -> Scene:
    """A pose that is constructed, in numbers with bounds: where its steps lead from the given scene in such numbers."""
    assert scene.assembly is not None
    assembly = replace(scene.assembly, given_scene=given, moves=moved_on(given, scene.assembly.shifts, by.reckoning))
    board = Board()
    assembler = Assembler(board, scene, assembly)
    guides = {slide: assembler.guide(slide) for slide in scene.slides}
    program = freeze(board, [*(assembler.mark(name) for name in scene.points), *guides.values()])
    values = evaluate(program, Proofs(by))
    marks = [values[index] for index in program.wanted]
    points = dict(zip(scene.points, marks, strict=False))
    directions = {slide: (b, -a) for slide, (a, b, _) in zip(guides, marks[len(points):], strict=True)}
    return replace(scene.with_pose(points, lambda one: directions.get(one, one.direction)), assembly=assembly)


def placing_error(scene: Scene) -> float:
    """Largest rounding error of a constructed point, proven by floats; infinite if they cannot prove one."""
    try:
        bounded_scene = enclose_scene(scene, FLOATS)
    except Unproven:
        return math.inf
    return max(math.hypot(*(FLOATS.lift(coordinate).error for coordinate in at))
               for at in bounded_scene.points.values())


def bounded_rates(scene: Scene, by: Bounds) -> Rates:
    """The rates of a scene in numbers with bounds; fails where the pose may be singular as far as they tell."""
    equations = motion_equations(scene, by.root)
    independent = independent_facts(equations)
    solve = by.solve([equations.rows[i] for i in independent], equations.scales)
    return motion(equations, lambda right: _consistent(equations, right, independent, solve, by), by.lift(0))


def independent_facts(equations: Equations) -> list[int]:
    """Indices of independent facts, as many as there are unknowns, in the order in which they are stated."""
    if len(equations.facts) == equations.width:
        return list(range(equations.width))
    from graphplan.solver.floating import independent

    return independent(equations.rows, equations.scales)


def _consistent(equations: Equations, right: Sequence[Any], kept: Sequence[int],
                solve: Callable[[Sequence[Any]], list[Any]], by: Bounds) -> list[Any]:
    """The solution of the rows that are kept; fails where it certainly does not meet the others."""
    values = solve([right[i] for i in kept])
    for i in set(range(len(equations.rows))).difference(kept):
        left_side = sum((by.lift(value) * values[j] for j, value in equations.rows[i].items()), by.lift(0))
        if not left_side.overlaps(by.lift(right[i])):
            raise by.doubt("the redundant facts contradict the others")
    return values


ROOTS = "fractions do not hold friction in journals: the size of a reaction is a root; leave out --exact"
TEETH = "fractions do not hold the losses of teeth as they are drawn, by a circle; leave out --exact"
NORMALS = "fractions do not hold the resistance to rolling {0}: the length of its normal is a root; leave out --exact"
REPEATING = "statically indeterminate: friction depends on forces that equilibrium does not tell"


def decide_friction(scene: Scene, exact: bool = False) -> tuple[Scene, str]:
    """The scene with the names of its pairs that stand still, where some could rub. Where its forces with friction
    cannot be had, the scene without its friction, and the reason."""
    loads = scene.loads
    if loads is None or not loads.frictions or not any(drive.rate for drive in scene.drives):
        return scene, ""
    from graphplan.solver.friction import pressed_slides, with_friction
    from graphplan.solver.statics import required_loads

    smooth = replace(scene, loads=replace(loads, frictions=()))
    if exact and any(friction.at and friction.coefficient * friction.radius for friction in loads.frictions):
        return smooth, ROOTS if _journals_bear(smooth, {friction.at for friction in loads.frictions}) else ""
    if exact and any(friction.gear and friction.coefficient for friction in loads.frictions):
        return smooth, TEETH
    rolling = {frozenset(friction.links) for friction in loads.frictions if friction.rolling and friction.coefficient}
    for contact in scene.contacts if exact else ():
        normal = contact.normal(scene.points)
        if frozenset(contact.links) in rolling and isinstance(reach(dot(normal, normal)), float):
            return smooth, NORMALS.format(contact.name)
    if scene.repeating:
        return smooth, REPEATING
    with suppress(GraphplanError, ArithmeticError):
        scene = replace(scene, loads=replace(loads, resting=_resting_pairs(scene)))
    try:
        standing = with_friction(scene, scene.sheet.rounds, exact)
    except SingularPose as singular:
        return smooth, singular.why
    return replace(scene, loads=replace(required_loads(scene), pressed=pressed_slides(standing))), ""


def _journals_bear(smooth: Scene, journals: set[str]) -> bool:
    """Whether any of these joints bears a force without friction; if not, it has no friction either."""
    from graphplan.solver.statics import reactions

    try:
        forces = reactions(smooth, exact=True)
    except SingularPose:
        return True
    return any(any(force) for (point, _), force in forces.joints.items() if point in journals)


def _resting_pairs(scene: Scene) -> frozenset[str]:
    """The names of the pairs that stand still."""
    from graphplan.solver.friction import resting

    if not scene.irrational:
        return resting(solve(scene, exact=True), lambda speed: not speed)
    by = enclosures() if has_flint() else FLOATS
    with by.working():
        return resting(bounded_rates(enclose_scene(scene, by), by), lambda speed: by.lift(speed).overlaps(by.lift(0)))
