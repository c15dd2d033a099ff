"""Friction over the cycle: the reduced moment of friction, what each pair loses, and the efficiency.

The reactions are those of kinetostatics, with the inertia forces at the mean speed of the first drive, which the drive
itself balances. Force polygons with friction circles and leaning guides give the balance with friction; what it is more
than that without is the reduced moment of friction, M_F. It is made up of what the pairs take, N/omega with
N = f R r |omega_rel| of a journal, and of a slide the friction force times |v_rel| (Ozols 1974, 13-3, 12-1 and 14-6;
method A4, there with the reactions R without friction).

Kinytskyi's lambda mechanism, scene `kinytskyi`, by the crank's travel from the scene's pose: the moment M of the drive
without friction, M_F, N m, and the efficiency; his curves are not printed with numbers. In the dwell, from 140 to 340
degrees, M nearly vanishes and the efficiency with it, yet not quite: the stop is approximate, as he says. Where it is
negative the load would drive the crank, but not against friction. It does not depend on how large the load is, where
that alone is heavy.

    travel        0      30      90     120     150     180     240     330
    M         6.258   8.145  -6.220  -7.496  -0.291   0.164   0.005   0.235
    M_F      -0.793  -0.608  -0.559  -1.193  -0.718  -0.418  -0.299  -0.391
    eta       0.887   0.931   0.910   0.841  -1.473   0.281   0.017   0.375
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.cycle.turn import Turn
from graphplan.errors import Refused
from graphplan.machines.integrals import fit_piecewise
from graphplan.machines.reduced.force_drawings import rubbed_drawing, with_resting_pairs
from graphplan.machines.reduced.reduced_loads import (
    LoadValues,
    PressedRecordings,
    Recordings,
    Results,
    UnitMotion,
    UnitRates,
    at_unit_rate,
    couple_and_normal,
    loads_on_links,
    refine_zeros,
    sample_travels,
)
from graphplan.machines.tolerances import BALANCE_TOL, BREAK_OFFSET, SIGNLESS_TOL
from graphplan.mechanism.model import FRAME, Find, Force, Friction, Loads, Number, Scene, Slide
from graphplan.mechanism.numbers import times
from graphplan.mechanism.travel import travel_text
from graphplan.mechanism.units import NEWTONS, weight
from graphplan.methods import kinds
from graphplan.methods.panels import JointForce
from graphplan.phrases import said

Vanishing = Callable[[Results, Turn], tuple[Array, Array]]
M_F = "M_F"
JOINT_FORCE, SLIDE_FORCE = (kinds.WITH_FRICTION[kind] for kind in (kinds.REACTION, kinds.SLIDE_REACTION))
# of friction: after four the forces of every pose stand, unless the mechanism is near to locking itself
FRICTION_ROUNDS = 6


class Bracket(NamedTuple):
    """Something that vanishes between two samples of the motion."""

    of: Vanishing
    low: int
    high: int


@dataclass(frozen=True, eq=False)
class FrictionMoments:
    """Friction in n poses: arrays of shape (n,), in N m of the first drive (in N of one that slides).

    `balance` is what the drive must give without friction at its mean speed, positive in the sense of motion, `moment`
    the reduced moment of friction, which is negative as it resists, and `losses` what the pairs take of it, by the
    names of joints and links, such as `A 2` and `3 along frame`.
    """

    balance: Array
    moment: Array
    losses: dict[str, Array]

    @property
    def efficiency(self) -> Array:
        """The efficiency in each pose: what the drive would have to give, by what it gives with friction, or where it
        holds back the inverse; negative where the loads alone do not overcome the friction."""
        smooth, rubbed = self.balance, self.balance - self.moment
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(smooth > 0, smooth / rubbed, rubbed / smooth)


class FrictionOverCycle:
    """The friction of a scene's pairs over its motion between two `ends`, by one recorded construction of its forces.

    `speed` is the mean speed of the first drive, in rad/s or lengths/s; at rest there are no inertia forces. `edges`
    are the travels at which a pair stands still or bears nothing: there the moment of friction jumps or has a corner.
    """

    def __init__(self, scene: Scene, motion: UnitMotion, ends: tuple[float, float]):
        assert scene.loads is not None
        self.motion, self.speed, self.ends = motion, mean_speed(scene), ends
        self.scene = kinetostatic_scene = with_resting_pairs(kinetostatic(scene, self.speed), motion,
                                                             sample_travels(motion, ends))
        assert kinetostatic_scene.loads is not None
        self.values = LoadValues(kinetostatic_scene, [*loads_on_links(kinetostatic_scene, kinetostatic_scene.loads)])
        self.frictions = [friction for friction in kinetostatic_scene.loads.frictions if friction.coefficient
                          and (friction.radius or not friction.at)]
        self._rate = abs(float(kinetostatic_scene.drives[0].rate))
        self.power = float(NEWTONS[scene.units.force]) * motion.metres / motion.unit / self._rate
        self.recordings, self._further = (PressedRecordings(with_rounds(kinetostatic_scene, rounds), motion.motion,
                                                            rubbed_drawing)
                                          for rounds in (FRICTION_ROUNDS, FRICTION_ROUNDS + 1))
        self.edges = np.array(self._breaks())

    @property
    def pairs(self) -> tuple[str, ...]:
        """The names of the journals and slides that rub."""
        return tuple(name for friction in self.frictions for name in (
            *(journal_name(friction, *journal) for journal in self._journals(friction)),
            *(slide.name for slide in self._slides(friction))))

    def friction_at(self, travel: Array, side: int = 1) -> FrictionMoments:
        """Friction at some travels; at a break that on one side, -1 or 1. Fails with `Refused` where the mechanism
        locks itself: where one round of friction more changes the forces, as none is in equilibrium."""
        travel = self.off_breaks(travel, side)
        forces, turn = self._forces(self.recordings, travel, side, gaps=True)
        if (torn := ~np.isfinite(self.drive_moment(forces, turn, kinds.RUBBED))).any():
            travel = np.where(torn, travel + side * BREAK_OFFSET * (self.ends[1] - self.ends[0]), travel)
            forces, turn = self._forces(self.recordings, travel, side)
        plain, rubbed = (self.drive_moment(forces, turn, kind) for kind in (kinds.BY_PLANS, kinds.RUBBED))
        further = self.drive_moment(*self._forces(self._further, travel, side), kinds.RUBBED)
        larger = np.maximum(np.abs(plain), np.abs(rubbed))
        if locked := np.flatnonzero(~(np.abs(further - rubbed) <= BALANCE_TOL * larger)).tolist():
            at = travel_text(self.scene, float(travel[locked[0]]))
            raise Refused("friction", said("the mechanism locks itself at a travel of {0}", at), "less friction")
        losses = dict(self._losses(forces))
        if self.scene.loads and self.scene.loads.screws:
            losses["screws"] = self.axial_power(forces, turn)[0] - rubbed
        return FrictionMoments(plain, plain - rubbed, losses)

    def off_breaks(self, travel: Array, side: int = 1) -> Array:
        """The travels, but those at breaks a hair beside them: there the senses are known."""
        if not self.edges.size:
            return travel
        low, high = self.ends
        place = low + np.mod(travel - low, high - low) if self.motion.period else travel
        nearest = np.argmin(np.abs(self.edges - place[:, None]), axis=1)
        away, hair = place - self.edges[nearest], BREAK_OFFSET * (high - low)
        return np.where(np.abs(away) < hair, travel - away + side * hair, travel)

    def _forces(self, recordings: Recordings, travel: Array, side: int = 1, gaps: bool = False) -> tuple[Results, Turn]:
        """All forces and rates at some travels, with `gaps` as far as they can be drawn there; and where everything is.
        """
        turn = self.motion.turn(travel)
        acting = self.loads(travel, turn, self.motion.velocities(turn), side)
        return recordings.evaluate(turn, gaps=gaps, loads=acting), turn

    def loads(self, travel: Array, turn: Turn, rates: UnitRates, side: int = 1) -> dict[str, Array]:
        """The loads that change, at the mean speed, by their letters and in the scene's units."""
        values = self.values.values(self.motion, turn, rates, travel, side)
        values |= {load.name: load.law(load.rate * self.speed * self.motion.unit)
                   for load in self.values.over_speed(self.motion, turn, rates)}
        return self.values.in_units(values, turn)

    def drive_moment(self, found: Results, turn: Turn, way: str, screws: bool = True) -> Array:
        """Moment of all drives for a unit of travel, in SI; with friction that of screws included."""
        loads, total = self.scene.loads, np.zeros(())
        assert loads is not None
        for drive, (name, balance) in zip(self.scene.drives, loads.named_balances.items(), strict=True):
            values = found.get(kinds.balance_kind(way if self.frictions else kinds.BY_PLANS, balance), {})
            if name not in values:
                raise Refused("friction", said("force polygons do not find the balance of the drive"),
                              "a scene whose reactions are statically determinate")
            value: Any = values[name]
            if balance.direction is None:
                total = total + value * float(drive.rate) / self.motion.metres
            else:
                along = self.values.guide_direction(self.scene.driven_slide(drive), turn)
                sense = 1 if drive.link == balance.link else -1
                power = sense * (value * np.conj(along)).real * float(drive.rate)
                screw = loads.screw_of(balance) if screws and way == kinds.RUBBED else None
                shares = [float(screw.circumferential(side) / screw.slope) for side in (1, -1)] if screw else (1, 1)
                total = total + power * np.where(power > 0, *shares)
        return np.asarray(self.power * total)

    def _losses(self, found: Results) -> Iterator[tuple[str, Array]]:
        """Yield the loss of each journal and slide, by its reaction and its rate for a unit of travel; contacts' losses
        are left to the polygons."""
        for friction in self.frictions:
            for journal in self._journals(friction):
                circle = float(friction.radius * friction.coefficient)
                force = found[JOINT_FORCE][JointForce(friction.at, journal[0]).name]
                turning = self.relative_rate(found, journal)
                yield journal_name(friction, *journal), -self.power * circle * np.abs(force) * np.abs(turning)
            for slide in self._slides(friction):
                slip, force = found[kinds.SLIDE_VELOCITY][slide.name], found[SLIDE_FORCE][slide.name]
                yield slide.name, -self.power * np.abs((np.conj(slip) * force).real)

    def _journals(self, one: Friction) -> list[tuple[str, str]]:
        """The links on the pin of a joint that rubs, each with the link that has the pin."""
        pin, *links = self.scene.links_of[one.at] if one.at else ("",)
        return [(link, pin) for link in links]

    def _slides(self, one: Friction) -> list[Slide]:
        """The slide that rubs, if it is one."""
        return [slide for slide in self.scene.slides if {*slide.links} == {*one.links}]

    def relative_rate(self, found: Results, journal: tuple[str, str], kind: str = kinds.OMEGA) -> Any:
        """Turning of a link relative to that with the pin."""
        rate, pin_rate = (0.0 if link == FRAME else found[kind][link] for link in journal)
        return rate - pin_rate

    # ---- where it breaks ---------------------------------------------------------------------------------------------

    def _breaks(self) -> list[float]:
        """The travels at which a journal or a slide with friction stands still, or its reaction passes through zero."""
        travel = sample_travels(self.motion, self.ends)
        forces, turn = self._forces(self.recordings, travel, gaps=True)
        brackets = [*self._brackets(forces, turn)]

        def values(at: Array) -> tuple[Array, Array]:
            forces_there, turn = self._forces(self.recordings, at, gaps=True)
            values = [[component[j] for component in bracket.of(forces_there, turn)]
                      for j, bracket in enumerate(brackets)]
            return np.array([value for value, _ in values]), np.array([change for _, change in values]) / self._rate

        low, high = (np.array([getattr(bracket, end) for bracket in brackets], dtype=int) for end in ("low", "high"))
        before, after = (np.array([one.of(forces, turn)[0][k] for one, k in zip(brackets, places, strict=True)])
                         for places in (low, high))
        places = np.array(refine_zeros(values, travel[low], travel[high], before, after))
        first, last = self.ends
        return list(first + np.mod(places - first, last - first) if self.motion.period else places)

    def _brackets(self, found: Results, turn: Turn) -> Iterator[Bracket]:
        """Yield the pairs of samples between which a quantity vanishes; a negligible one at a sample is passed over."""
        every = [np.abs(force) for kind in (JOINT_FORCE, SLIDE_FORCE) for force in found.get(kind, {}).values()]
        largest = max((float(np.nanmax(sizes)) for sizes in every), default=0.0)
        quantities = [of for friction in self.frictions for of in self.vanishing_quantities(friction, largest)]
        if self.scene.loads and self.scene.loads.screws:
            quantities.append((self.axial_power, float(np.nanmax(np.abs(self.axial_power(found, turn)[0])))))
        for of, size in quantities:
            values, _ = of(found, turn)
            for i, j in pairwise(np.flatnonzero(np.abs(values) > SIGNLESS_TOL * size).tolist()):
                if values[i] * values[j] < 0 and j - i <= 2:
                    yield Bracket(of, i, j)
        for name in (JointForce(one.at, link).name for one in self.frictions for link, _ in self._journals(one)):
            force = found[JOINT_FORCE][name]
            for i, j in pairwise(np.flatnonzero(np.abs(force) > SIGNLESS_TOL * largest).tolist()):
                if (force[i] * force[j].conj()).real < 0 and j - i <= 2:
                    yield Bracket(partial(self.force_along, name, force[i].conj()), i, j)

    def vanishing_quantities(self, one: Friction, force: float) -> Iterator[tuple[Vanishing, float]]:
        """Yield the quantities that are zero if a pair stands still, or a slide is not pressed, the value and its rate
        in time; each with its scale."""
        for journal in self._journals(one):
            yield partial(self.joint_rate, journal), self._rate / self.motion.unit
        for slide in self._slides(one):
            yield partial(self.slip_speed, slide), self._rate * (self.scene.extent if self.motion.turns else 1.0)
            yield partial(self.pressing_force, slide), force
            if one.length:
                yield partial(self.edge_excess, slide, one.length), force

    def joint_rate(self, journal: tuple[str, str], found: Results, turn: Turn) -> tuple[Array, Array]:
        zero = np.zeros(turn.travel.shape)
        return self.relative_rate(found, journal) + zero, self.relative_rate(found, journal, kinds.ALPHA) + zero

    def slip_speed(self, slide: Slide, found: Results, turn: Turn) -> tuple[Array, Array]:
        back = np.conj(self.values.guide_direction(slide, turn))
        rates = (found[kind][slide.name] for kind in (kinds.SLIDE_VELOCITY, kinds.SLIDE_ACCELERATION))
        speed, change = ((back * rate).real for rate in rates)
        return speed, change

    def pressing_force(self, slide: Slide, found: Results, turn: Turn) -> tuple[Array, Array]:
        back = np.conj(self.values.guide_direction(slide, turn))
        return (back * found[SLIDE_FORCE][slide.name]).imag, np.full(turn.travel.shape, np.nan)

    def edge_excess(self, slide: Slide, length: Number, found: Results, turn: Turn) -> tuple[Array, Array]:
        """By how much both edges' forces are larger than their sum: zero where a slide comes to be pressed by both."""
        couple, normal = couple_and_normal(self.scene, slide, length, found, turn)
        return np.abs(couple) - np.abs(normal), np.full(turn.travel.shape, np.nan)

    def axial_power(self, found: Results, turn: Turn) -> tuple[Array, Array]:
        moment = self.drive_moment(found, turn, kinds.RUBBED, screws=False)
        return moment, np.full(moment.shape, np.nan)

    def force_along(self, name: str, back: complex, found: Results, turn: Turn) -> tuple[Array, Array]:
        return (found[JOINT_FORCE][name] * back).real, np.full(turn.travel.shape, np.nan)


@dataclass(frozen=True)
class CycleLosses:
    """Friction over a cycle, in J: the work that is `lost`, and the `pairs`' shares, of contacts and gears what
    the others leave over; the work `given` by all that drives, the drive and the loads whose works are positive."""

    lost: float
    given: float
    pairs: dict[str, float]

    @property
    def efficiency(self) -> float:
        """The mean efficiency: how much of the work that is given does not go into friction (Ozols 1974, 14-1)."""
        share = 1 - self.lost / self.given if self.given else 0.0
        return share if abs(share) > BALANCE_TOL else 0.0

    @property
    def relative_gap(self) -> float:
        """Difference of the pairs' shares from the whole loss, relative to it; contacts have the remainder."""
        return abs(sum(self.pairs.values()) - self.lost) / self.lost if self.lost else 0.0


def cycle_losses(friction: FrictionOverCycle, moments: Callable[[Array], Mapping[str, Array]],
                 breaks: Sequence[float]) -> CycleLosses:
    """The losses over the cycle, where `moments` are those of the loads by name, and all is smooth between breaks."""
    motion, ends, names = friction.motion, friction.ends, list[str]()

    def rows(travel: Array) -> Array:
        forces = friction.friction_at(travel)
        named = {"": forces.balance - forces.moment, M_F: forces.moment, **moments(travel)}
        names[:] = [*named, *forces.losses]
        return np.array([*named.values(), *forces.losses.values()])

    sizes = np.abs(rows(sample_travels(motion, ends))).max(axis=1)
    works = fit_piecewise(rows, [ends[0], *breaks, ends[1]], np.maximum(sizes, sizes[0])).total_integral * motion.unit
    done = dict(zip(names, map(float, works), strict=True))
    pairs = {name: -done.pop(name) for name in friction.pairs}
    lost = -done.pop(M_F)
    kinds_left = {"contacts" if one.contact else "gears" for one in friction.frictions if one.contact or one.gear}
    if kinds_left:
        pairs[" ".join(sorted(kinds_left))] = lost - sum(pairs.values())
    return CycleLosses(lost, sum(max(0.0, work) for work in done.values()), pairs)


def journal_name(one: Friction, link: str, pin: str) -> str:
    """A journal by its joint and its link; that with the pin where the other is the frame."""
    return f"{one.at} {pin if link == FRAME else link}"


def mean_speed(scene: Scene) -> float:
    """The mean speed of the first drive: that which its flywheel is asked for, else its own; rad/s or lengths/s."""
    return abs(float(scene.flywheel.speed if scene.flywheel else scene.drives[0].rate))


def kinetostatic(scene: Scene, speed: float) -> Scene:
    """The scene at a constant mean speed of its first drive, with a balance at each drive; at rest with weights alone,
    moving only so that friction has a sense."""
    unit_scene, loads = at_unit_rate(scene), scene.loads
    assert loads is not None
    balances = tuple(map(unit_scene.balance_of, unit_scene.drives))
    if speed:
        unit_scene = unit_scene.with_drives(drive.driven_at(Fraction(drive.rate) * Fraction(speed), 0)
                                            for drive in unit_scene.drives)
    else:
        loads = weights_alone(scene, loads)
    slides = tuple(slide.name for slide in scene.slides)
    return replace(unit_scene, loads=replace(loads, balances=balances), find=Find((), (), None, scene.moving, slides))


def with_rounds(scene: Scene, rounds: int) -> Scene:
    """The scene with so many rounds of friction."""
    return replace(scene, sheet=replace(scene.sheet, rounds=rounds))


def weights_alone(scene: Scene, loads: Loads) -> Loads:
    """The loads with weights as given forces, and no masses."""
    weights = (Force(link, mass.centre, times(mass.mass * weight(scene.units), loads.gravity))
               for link, mass in loads.masses.items() if link != FRAME and mass.mass)
    return replace(loads, masses={}, forces=(*loads.forces, *weights))
