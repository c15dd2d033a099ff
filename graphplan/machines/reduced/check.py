"""A reduction against the analytic solver: kinetic energy and power at a unit rate in every pose, from its rates alone.

The reduced inertia is twice the kinetic energy, the reduced moment the power of the loads, and the inertia's slope
twice the power of the inertia forces, taken against them, while the first drive goes at a constant rate of one and the
others in pace. The solver finds the rates from its linear systems; tables are read where its slides stand and move. A
number counts relative to the size of what cancels in it.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from graphplan.check.stream import POSES_AT_ONCE, SAFETY_FACTOR, PoseBatch, single_pose
from graphplan.check.tolerances import DEAD_POINT_TOL, EPSILON, FRICTION_TOL, ROUNDING_TOL
from graphplan.errors import Disagreement, GraphplanError
from graphplan.machines.reduced.friction import M_F
from graphplan.machines.reduced.reduced_loads import at_unit_rate
from graphplan.machines.reduced.reduction import Reduced, Reduction
from graphplan.machines.tolerances import MACHINE_SHARE
from graphplan.mechanism.load_values import guide_origin
from graphplan.mechanism.loads import LoadTable
from graphplan.mechanism.model import FRAME, Force, Loads, Slide
from graphplan.mechanism.units import KILOGRAMS, METRES, NEWTONS
from graphplan.methods.construction import Construction
from graphplan.solver import poses, solve, with_friction
from graphplan.solver.friction import delivered_power
from graphplan.solver.poses import Sized, with_size

Gaps = dict[str, Any]


def reduction_gaps(reduction: Reduction, travel: Any) -> Gaps:
    """For inertia, moment and slope the difference from the solver relative to the number's own size, in each pose."""
    travel = np.atleast_1d(np.asarray(travel, dtype=float))
    blocks: dict[str, list[Any]] = {}
    for start in range(0, max(1, travel.size), POSES_AT_ONCE):
        block = travel[start : start + POSES_AT_ONCE]
        reference = ReferenceReduction(reduction, block)
        for quantity, gap in reference.gaps(reduction.reduce_at(block)).items():
            blocks.setdefault(quantity, []).append(gap)
    return {quantity: np.concatenate(gaps) for quantity, gaps in blocks.items()}


def frictionless(reduced: Reduced, quantity: str) -> Any:
    """Inertia, moment or slope as it is without friction, which is compared by itself."""
    value = getattr(reduced, quantity)
    return value - reduced.by[M_F] if quantity == "moment" and M_F in reduced.by else value


def check_reduction(reduction: Reduction, travel: Any) -> dict[str, float]:
    """The largest difference from the solver in any of these poses, by what differs; with friction where it rubs.

    Fails with `Disagreement` where one is more than rounding, relative to the condition of the solver's rates.
    """
    travel = np.atleast_1d(np.asarray(travel, dtype=float))
    gaps = reduction_gaps(reduction, travel)
    for quantity, gap in gaps.items():
        for k in np.flatnonzero(~(gap <= ROUNDING_TOL)):
            reference = ReferenceReduction(reduction, travel[k : k + 1])
            ours = frictionless(reduction.reduce_at(travel[k : k + 1]), quantity)[0]
            truth = reference.truth[quantity].value[0]
            if abs(ours - truth) <= ROUNDING_TOL * getattr(reduction.machine_size, quantity):
                gap[k] = 0.0  # relative to what these masses and loads do elsewhere both are nothing
            elif not gap[k] <= SAFETY_FACTOR * EPSILON * reference.condition:
                place = f"{reduction.scene.name}: at a travel of {travel[k]:.9g}"
                raise Disagreement(place, f"reduced {quantity}", f"{ours:.15g}", f"{truth:.15g}", float(gap[k]))
    other_gaps = {} if reduction.friction is None else {"friction": friction_gap(reduction, travel)}
    if any(reduction.loads.gravity):
        other_gaps["weights"] = weights_gap(reduction, travel)
    return {quantity: float(np.max(gap, initial=0.0)) for quantity, gap in gaps.items()} | other_gaps


def weights_gap(reduction: Reduction, travel: Any) -> float:
    """Difference of the weights' moments by the lever from those by projections, relative to the largest in any pose.

    Fails with `Disagreement` where that is more than rounding.
    """
    by, projected = reduction.reduce_at(travel).by, reduction.projections(travel)
    worst = max((float(np.max(np.abs(by[name] - moment))) for name, moment in projected.items()), default=0.0)
    least = MACHINE_SHARE * reduction.machine_size.moment
    largest = max([least, *(float(np.max(np.abs(moment), initial=0.0)) for moment in projected.values())])
    gap = worst / largest if worst else 0.0
    if gap > ROUNDING_TOL:
        raise Disagreement(reduction.scene.name, "weights", "otherwise by the lever", "by their projections", gap)
    return gap


def check_lever(reduction: Reduction, travel: float) -> tuple[Construction, float]:
    """The lever drawn in one pose, and how far it is from the reduced moment relative to the largest of the loads' own.

    Fails with `Disagreement` where that is more than rounding, relative to the condition of the solver's rates.
    """
    drawing, reduced = reduction.drawing(travel), reduction.reduce_at([travel])
    (balance,) = drawing.balances
    drive = reduction.motion.scene.drives[0]
    if drive.slides:
        x, y = map(float, drawing.scene.driven_slide(drive).direction)
        balance = (complex(balance) * complex(x, -y)).real / abs(complex(x, y))
    by_lever = -reduction.sense * balance * float(NEWTONS[reduction.scene.units.force])
    by_reduction = float(frictionless(reduced, "moment")[0])
    scale = max([MACHINE_SHARE * reduction.machine_size.moment,
                 *(abs(float(moment[0])) for moment in reduced.by.values())])
    gap = abs(by_lever - by_reduction) / scale if by_lever != by_reduction else 0.0
    reference = ReferenceReduction(reduction, np.array([travel]))
    if gap > ROUNDING_TOL and not gap <= SAFETY_FACTOR * EPSILON * reference.condition:
        raise Disagreement(reduction.scene.name, "lever", f"{by_lever:.15g}", f"{by_reduction:.15g}", gap)
    return drawing, float(gap)


def friction_gap(reduction: Reduction, travel: Any) -> float:
    """Difference of the moment of friction from the solver's, whose reactions lean, in any of these poses; relative to
    the given and lost power.

    Fails with `Disagreement` where that is more than rounding.
    """
    rubbing = reduction.friction
    assert rubbing is not None
    travel = rubbing.off_breaks(np.atleast_1d(np.asarray(travel, dtype=float)))
    turn = reduction.motion.turn(travel)
    rates = reduction.motion.velocities(turn)
    friction_moments, values = rubbing.friction_at(travel), rubbing.loads(travel, turn, rates)
    worst, usual = 0.0, reduction.machine_size.moment
    batch = PoseBatch(rubbing.scene, np.arange(travel.size), turn.points, turn.guides, values)
    for k in range(travel.size):
        reference = with_friction(single_pose(batch.select(k).posed_scene))
        work = float(delivered_power(reference, rubs=True)) * rubbing.power
        scale = max(abs(float(friction_moments.balance[k])), abs(work),
                    -sum(float(loss[k]) for loss in friction_moments.losses.values()))
        gap = abs(work - float(friction_moments.balance[k]
                               - friction_moments.moment[k])) / scale if scale > ROUNDING_TOL * usual else 0.0
        if gap > max(FRICTION_TOL, SAFETY_FACTOR * EPSILON * reference.condition):
            place = f"{reduction.scene.name}: at a travel of {travel[k]:.9g}"
            by_drawing = f"{float(friction_moments.balance[k] - friction_moments.moment[k]):.15g}"
            raise Disagreement(place, "balance with friction", by_drawing, f"{work:.15g}", gap)
        worst = max(worst, gap)
    return worst


class ReferenceReduction:
    """The solver's reduction at some travels, right after its breaks: its `truth`, as numbers that include their
    cancellation."""

    def __init__(self, reduction: Reduction, travel: Any):
        self.scene, self.motion = reduction.scene, reduction.motion
        self.travel, self.turn = travel, self.motion.turn(travel)
        self.part = PoseBatch(at_unit_rate(self.scene), np.arange(travel.size), self.turn.points, self.turn.guides)
        self.posed = self.part.posed_scene
        self.rates: Any = poses.solve(self.posed, travel.size, sizes=True)
        self.rubbing = reduction.friction
        self.metres, self.unit = float(METRES[self.scene.units.length]), self.motion.unit

    @property
    def friction(self) -> Any:
        """The moment of friction, which `friction_gap` compares: it is no part of the truth."""
        if self.rubbing is None:
            return np.zeros(self.travel.shape)
        return self.rubbing.friction_at(self.travel).moment

    @property
    def _none(self) -> Sized:
        """Nothing in every pose."""
        return with_size(np.zeros(self.travel.shape))

    @property
    def condition(self) -> float:
        """The condition of the solver's rates in the first pose."""
        try:
            return solve(single_pose(self.part.select(0).posed_scene)).condition
        except GraphplanError:
            return np.inf

    @property
    def truth(self) -> dict[str, Sized]:
        """Inertia, moment and slope, in SI."""
        twice = self._kinetic(self.rates.acceleration, self.rates.alpha)
        return {"inertia": self._kinetic(self.rates.velocity, self.rates.omega), "moment": self._power(),
                "slope": twice * (2 / self.unit)}

    def gaps(self, reduced: Reduced) -> Gaps:
        """The differences of what was found."""
        gaps: Gaps = {}
        for quantity, truth in self.truth.items():
            apart, scale = np.abs(frictionless(reduced, quantity) - truth.value), truth.size
            gaps[quantity] = np.divide(apart, scale, out=np.where(apart > 0, np.inf, 0.0), where=scale > 0)
        return gaps

    def _kinetic(self, vectors: Any, turnings: Any) -> Sized:
        """The sum of m v.w + I omega epsilon over all masses, of velocities and others."""
        assert self.scene.loads is not None
        total, kilogram = self._none, float(KILOGRAMS[self.scene.units.mass])
        for link, mass in self.scene.loads.masses.items():
            if link != FRAME:
                (vx, vy), (wx, wy) = self.rates.velocity[mass.centre], vectors[mass.centre]
                translation = (with_size(vx) * wx + with_size(vy) * wy) * (self.metres / self.unit) ** 2
                rotation = with_size(self.rates.omega[link]) * turnings[link] * (1 / self.unit) ** 2
                total = total + (translation * float(mass.mass) + rotation * float(mass.inertia)) * kilogram
        return total

    def _power(self) -> Sized:
        """The power of all loads that do not change with a speed."""
        loads: Loads | None = self.scene.loads
        assert loads is not None
        total, newton = self._none, float(NEWTONS[self.scene.units.force])
        for force in loads.forces:
            if force.on != FRAME and not (force.table and force.table.over_speed):
                total = total + self._point_power(force.at, self._vector(force)) * newton
        for moment in loads.moments:
            if moment.on != FRAME and not (moment.table and moment.table.over_speed):
                value = self._table_values(moment.table) if moment.table else float(moment.value)
                total = total + with_size(self.rates.omega[moment.on]) * value * (newton / self.unit)
        for link, mass in loads.masses.items():
            if link != FRAME:
                weight = float(mass.mass) * float(KILOGRAMS[self.scene.units.mass])
                total = total + self._point_power(mass.centre,
                                                  (float(loads.gravity[0]), float(loads.gravity[1]))) * weight
        return total

    def _point_power(self, point: str, vector: tuple[Any, Any]) -> Sized:
        """A vector times the velocity of a point."""
        x, y = self.rates.velocity[point]
        power: Sized = with_size(x) * vector[0] + with_size(y) * vector[1]
        return power * (self.metres / self.unit)

    def _vector(self, force: Force) -> tuple[Any, Any]:
        """A force in every pose."""
        if force.table is None:
            return float(force.value[0]), float(force.value[1])
        x, y, length = self.line_of_action(force)
        value = self._table_values(force.table) / length
        return x * value, y * value

    def line_of_action(self, force: Force) -> tuple[Any, Any, Any]:
        """The direction in which a force acts, and its length."""
        direction: Any = force.direction or (0, 0)
        if force.through:
            (ax, ay), (bx, by) = (self.posed.points[point] for point in force.through)
            direction = bx - ax, by - ay
        x, y = (np.asarray(component, float) for component in direction)
        return x, y, np.hypot(x, y)

    def slide_component(self, slide: Slide, vectors: Any) -> Any:
        """The component of a slide's vector along its guide."""
        (x, y), (dx, dy) = vectors[slide.name], slide.direction
        return (x.value * dx + y.value * dy) / np.hypot(np.asarray(dx, float), np.asarray(dy, float))

    def slide_of(self, table: LoadTable) -> Slide:
        """The slide that a table is over, as it lies in these poses."""
        return next(slide for slide in self.posed.slides if slide.name == table.slide)

    def _table_values(self, table: LoadTable) -> Any:
        """Loads of a table in every pose."""
        if table.span:
            (ax, ay), (bx, by) = (self.posed.points[point] for point in table.span)
            return table.values_at(np.hypot(np.asarray(bx - ax, float), np.asarray(by - ay, float)))
        if not table.slide:
            return table.values_at(self.motion.in_scene_units(self.travel))
        slide = self.slide_of(table)
        (x, y), (dx, dy) = self.posed.points[slide.at], slide.direction
        if origin := guide_origin(self.scene, slide):
            x, y = x - self.posed.points[origin][0], y - self.posed.points[origin][1]
        length = np.hypot(np.asarray(dx, float), np.asarray(dy, float))
        reach = self.scene.extent if self.motion.turns else 1.0
        speed = self.slide_component(slide, self.rates.slide_velocity)
        moves = np.abs(speed) > DEAD_POINT_TOL * reach
        speed = np.where(moves, speed, self.slide_component(slide, self.rates.slide_acceleration))
        zero = np.zeros(self.travel.shape)
        return table.values_at((x * dx + y * dy) / length + zero, np.where(speed < 0, -1.0, 1.0) + zero)
