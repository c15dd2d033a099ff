"""The drawing of a true motion: its diagrams, laid out to scale in strips of equal travel.

Those over the travel stand under each other; the inertia, turned, and the energy-mass diagram stand right of moments
and energies. Where the energy varies little its origin lies off the paper: energy, inertia and speed then show no more
than the range of their values.

Source: Ozols 1974, fig. 13-9, (13.36) and (13.37).

Sources: Ozols 1974, (13.31) (Baranov's step), (13.32), (13.40) and (13.41) (the first strips from rest as a parabola),
example 13-7 (Euler's step for omega^2, where loads hang on the speed).

The work of the moments is drawn under their diagram, strip by strip. Each energy is projected across, each inertia down
from its turned diagram: they meet in a point of the energy-mass diagram, whose ray from the origin has the slope psi,
and omega^2 = 2 k_E/k_I tan psi. The root is drawn as a mean proportional: on the upright at a distance c the ray cuts
off c tan psi, and a half circle over this length and another one, d below, cuts off omega on the axis. By similar
triangles follows 1/omega, and by integration the time, from rest with two strips of a parabola first.

Sources: Ozols 1974, 13-6 with fig. 13-9 and 13-10, (13.36) to (13.41); 15-2 (integration with a pole).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from graphplan.cycle.diagrams import Axes, integrate, round_scale
from graphplan.errors import Refused
from graphplan.kernel.numbers.arrays import Reals
from graphplan.kernel.passes import PlanScale, Values, record_drawing
from graphplan.kernel.program import Board, Mark, Panel
from graphplan.kernel.stages import Stage
from graphplan.machines.motion.runs import DrivenMachine, TrueMotion
from graphplan.machines.tolerances import MIN_RANGE, SCALE_TOL
from graphplan.phrases import Said, digits, said
from graphplan.sheet.diagrams import AxisScale, Frame

# mm: for poles, between the two columns of diagrams, and between their rows
POLE_ROOM_MM, COLUMN_GAP_MM, ROW_GAP_MM = 34.0, 22.0, 12.0
MIN_POLE_MM, MAX_POLE_MM = 4.5, 30.0  # mm: poles from their axes
SHARES = {"moment": 0.17, "energy": 0.28, "omega": 0.19, "slowness": 0.16, "time": 0.2}  # of what is free: heights
# of what is free: the axis of travel, the largest inertia; of that, c at most
TRAVEL_SHARE, INERTIA_SHARE, RAY_CUT_SHARE = 0.66, 0.22, 0.6
MAX_SLOWNESS_RATIO = 8.0  # times the least 1/omega: what is larger goes off the paper
MIN_ENERGY_SHARE = 0.5  # of the largest energy: where the least is more the origin is off the paper
MARGIN = 0.08  # of a range, beyond it
SCALE_STEPS = 1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0  # of the scale of travel, which fills its room


class PanelSize(NamedTuple):
    """Room of all diagrams together, in mm."""

    width: float = 280.0
    height: float = 250.0

    @property
    def free(self) -> float:
        """Width without poles and gaps."""
        return self.width - POLE_ROOM_MM - COLUMN_GAP_MM

    @property
    def heights(self) -> dict[str, float]:
        """The heights of the diagrams under each other."""
        free = self.height - (len(SHARES) - 1) * ROW_GAP_MM
        return {name: share * free for name, share in SHARES.items()}


@dataclass(frozen=True, eq=False)
class MotionLayout:
    """The diagrams of what is drawn: moments of the strips, the least and the largest moment of all, and at the
    divisions travel (from the beginning), energies, inertias and speeds, in SI; `first` is the division from which the
    time is integrated, `degree` the unit of travel.

    The motion may end where there is no division any more: `whole` is its travel.
    """

    travel: Reals
    moments: Reals
    extreme_moments: tuple[float, float]
    energies: Reals
    inertias: Reals
    omegas: Reals
    first: int
    whole: float
    degree: float
    room: PanelSize

    @property
    def origin_off_paper(self) -> bool:
        """Whether the origin of the energy-mass diagram is off the paper."""
        return bool(self.energies.min() > MIN_ENERGY_SHARE * self.energies.max())

    @cached_property
    def k(self) -> dict[str, float]:
        """Round scales for one mm."""
        high, span = self.room.heights, (1 + 2 * MARGIN) * float(np.ptp([*self.extreme_moments, 0.0]))
        slowness = 1 / self.omegas[max(1, self.first):]
        least = self.whole / self.degree / (TRAVEL_SHARE * self.room.free)
        phi = self.degree * fine_scale(least)
        energy = _scale(self._span(self.energies) / high["energy"])
        moment = _scale(max(span / high["moment"], energy / phi / MAX_POLE_MM))
        slow = min(slowness.max(), MAX_SLOWNESS_RATIO * slowness.min()) / high["slowness"]
        time = _scale(float(np.nanmax(times(self.travel, self.omegas))) / high["time"])
        slow = _scale(max(slow, time / phi / MAX_POLE_MM))
        return {"travel": phi, "moment": moment, "energy": max(energy, _scale(MIN_POLE_MM * moment * phi)),
                "inertia": _scale(self._span(self.inertias) / (INERTIA_SHARE * self.room.free)),
                "omega": _scale(self._span(self.omegas) / high["omega"]), "slowness": slow,
                "time": max(time, _scale(MIN_POLE_MM * slow * phi))}

    def _span(self, values: Reals) -> float:
        """Shown range of some values: from zero on, or their range alone."""
        top = float(values.max())
        return max(top - self._low(values), MIN_RANGE * top)

    def _low(self, values: Reals) -> float:
        """The least value that is shown."""
        low, high = float(values.min()), float(values.max())
        return low - MARGIN * (high - low) if self.origin_off_paper else 0.0

    @property
    def poles(self) -> tuple[float, float]:
        """The distances of the poles of moments and of 1/omega, in mm."""
        k = self.k
        return k["energy"] / k["moment"] / k["travel"], k["time"] / k["slowness"] / k["travel"]

    @property
    def c(self) -> float:
        """Distance at which rays of the energy-mass diagram are cut, in mm from its origin."""
        steepest = float((self.energies / self.inertias).max()) * self.k["inertia"] / self.k["energy"]
        return min(INERTIA_SHARE * self.room.free * RAY_CUT_SHARE, self.room.heights["energy"] / steepest)

    @property
    def d(self) -> float:
        """The length that makes with c tan psi the mean proportional omega, in mm."""
        return 2 * self.k["energy"] / (self.k["inertia"] * self.c * self.k["omega"] ** 2)

    @property
    def q(self) -> float:
        """The mean proportional of omega and 1/omega, in mm."""
        return 1 / math.sqrt(self.k["omega"] * self.k["slowness"])

    @property
    def frames(self) -> dict[str, Frame]:
        """The diagrams by name, in SI; `reciprocal` is where 1/omega is constructed."""
        frames, top, k = dict[str, Frame](), 0.0, self.k
        travel, level = AxisScale(k["travel"]), (0.0, self.whole / k["travel"])
        lowest = {"moment": min(self.extreme_moments[0], 0.0) * (1 + MARGIN), "energy": self._low(self.energies),
                  "omega": self._low(self.omegas)}
        for name, height in self.room.heights.items():
            upright = AxisScale(k[name], lowest.get(name, 0.0))
            frames[name] = Frame((0.0, top - height), travel, upright, level, (0.0, height))
            top -= height + ROW_GAP_MM
        right, wide = level[1] + COLUMN_GAP_MM, (0.0, INERTIA_SHARE * self.room.free)
        inertia, energy, omega = AxisScale(k["inertia"], self._low(self.inertias)), frames["energy"], frames["omega"]
        low, high = frames["moment"].upright
        down = AxisScale(-self.whole / (high - low))
        frames["energy-mass"] = Frame((right, energy.origin[1]), inertia, energy.y, wide, energy.upright)
        frames["inertia"] = Frame((right, 0.0), inertia, down, wide, (low - high, 0.0))
        frames["reciprocal"] = Frame((right, omega.origin[1]), AxisScale(1.0), AxisScale(1.0), wide, omega.upright)
        return frames


def fine_scale(least: float) -> float:
    """The least of a fine series of scales that is no smaller."""
    power = 10.0 ** math.floor(math.log10(least))
    return power * next(step for step in SCALE_STEPS if step * power >= least * (1 - SCALE_TOL))


def _scale(least: float) -> float:
    return float(round_scale(float(least)))


class Parabola(NamedTuple):
    """omega = k phi^n over the first two strips from rest, and the time that they take."""

    n: float
    k: float
    time: float


def parabola(travel: Reals, omega: Reals) -> Parabola:
    """The parabola through the second and the third of three points, the first being at rest.

    Fails with `Refused` where it would take for ever to leave the rest, as n is 1 or more.
    """
    (x2, x3), (w2, w3) = travel[1:3] - travel[0], omega[1:3]
    n = math.log(w3 / w2) / math.log(x3 / x2)
    if not n < 1:
        raise Refused("the first strips", f"omega grows with the power {n:.3g} of the travel, and the time has no end",
                      "narrower strips (--positions)")
    k = math.exp((math.log(x3) * math.log(w2) - math.log(x2) * math.log(w3)) / (math.log(x3) - math.log(x2)))
    return Parabola(n, k, x3 ** (1 - n) / (k * (1 - n)))


def times(travel: Reals, omega: Reals) -> Reals:
    """The time at each travel: trapezoids under 1/omega, from rest two strips of a parabola first.

    Within the parabola it goes by its own law; nan from where the speed is no more than 0, or unknown.
    """
    elapsed, first = np.zeros(len(travel)), 0
    if omega[0] == 0:
        curve = parabola(travel, omega)
        elapsed[1], elapsed[2], first = curve.time * ((travel[1] - travel[0]) / (travel[2]
                                                                                 - travel[0])) ** (1 - curve.n), \
            curve.time, 2
    slowness = np.divide(1.0, omega, out=np.full(len(omega), np.nan), where=omega > 0)
    strips = (slowness[first:-1] + slowness[first + 1:]) / 2 * np.diff(travel[first:])
    elapsed[first + 1:] = elapsed[first] + np.cumsum(strips)
    return elapsed


def by_energy(machine: DrivenMachine, travel: Reals, omega: float) -> Reals:
    """The speeds with each strip's moment taken at its beginning: Euler's step for omega^2, of the first order.

    d(omega^2) = 2/I M dphi where the inertia does not change; nan from where nothing is left.
    """
    speeds = [omega]
    for start, end in pairwise(travel):
        inertia = machine.inertia(np.array([start, end]))
        moment = float(machine.moment(np.array([start]), np.array([speeds[-1]]))[0])
        square = (inertia[0] * speeds[-1] ** 2 + 2 * moment * (end - start)) / inertia[1]
        speeds.append(math.sqrt(square) if square >= 0 else math.nan)
    return np.array(speeds)


def baranov(machine: DrivenMachine, travel: Reals, omega: float) -> Reals:
    """The speeds by Baranov's step (13.31), of the first order; from rest the first strip is one of `by_energy`."""
    speeds = [omega]
    if omega == 0:
        speeds += [float(by_energy(machine, travel[:2], 0.0)[1])]
    for start, end in pairwise(travel[len(speeds) - 1:]):
        (now, then), rate = machine.inertia(np.array([start, end])), speeds[-1]
        moment = float(machine.moment(np.array([start]), np.array([rate]))[0])
        step = moment * (end - start) / (now * rate) + (3 * now - then) / (2 * now) * rate if rate > 0 else math.nan
        speeds.append(step)
    return np.array(speeds)


MOTION = Panel("motion", said("motion"), said("True motion: energy, speed and time over the travel"))
CORRECTIONS_PER_STRIP = 3  # times that a load over a speed is taken anew, at the speed in the middle of a strip
CURVE_SAMPLES = 60  # between two travels at which the moment may jump
ORIGINS = {"moment": "M", "energy-mass": "I", "slowness": "u", "reciprocal": "r", "time": "t"}


@dataclass(frozen=True, eq=False)
class MotionDrawing:
    """The recorded construction of a motion and what it finds at its divisions.

    `travel` are the divisions in SI, `first` the place of the first whose time is integrated. `frames` are the
    diagrams, by name; what is drawn at the divisions has the role of its name.
    """

    motion: TrueMotion
    values: Values
    frames: dict[str, Frame]
    travel: Reals
    first: int

    def read(self, name: str) -> Reals:
        """Read the drawing at the divisions: `energy`, `omega` or `time`, nan where it has no value."""
        frame, values = self.frames[name], np.full(len(self.travel), np.nan)
        heights = [y for _, y in self.values.values_of_role(name)]
        start = len(self.travel) - len(heights)
        values[start:] = frame.y.value(np.array(heights) - frame.origin[1])
        if start and name != "slowness":
            values[0] = 0.0
        return values

    @property
    def errors(self) -> dict[str, float]:
        """Largest differences of the drawing from the true motion, as parts of the largest energy, speed and time."""
        true = self.motion.state_at(self.travel)
        pairs = {name: (self.read(name), getattr(true, name)) for name in ("energy", "omega", "time")}
        return {name: float(np.nanmax(abs(drawn_values - exact)) / np.nanmax(abs(exact)))
                for name, (drawn_values, exact) in pairs.items()}


def draw_motion(motion: TrueMotion, strips: int,
                room: PanelSize | None = None) -> MotionDrawing | None:
    """The construction of a motion in so many strips; None if it stops within the first three.

    Each strip has the moment of its middle, that of loads over a speed at the speed there.
    """
    machine = motion.machine
    travel = np.linspace(motion.start, motion.last_travel, strips + 1)
    moments, energies = strip_moments(machine, travel, float(motion.state_at([motion.start]).energy[0]))
    if len(moments) < 3:
        return None
    return _MotionRecorder(motion, travel[:len(energies)], np.array(moments), np.array(energies),
                           room or PanelSize()).draw


def strip_moments(machine: DrivenMachine, travel: Reals, energy: float) -> tuple[list[float], list[float]]:
    """The moment of each strip, and the energies at the divisions, as far as there is some."""
    moments, energies = list[float](), [energy]
    for start, end in pairwise(travel):
        middle = np.array([(start + end) / 2])
        inertia, half = float(machine.inertia(middle)[0]), energy
        for _ in range(CORRECTIONS_PER_STRIP if machine.laws else 1):
            rate = np.sqrt(2 * max(half, 0.0) / inertia)
            moment = float(machine.moment(middle, np.array([rate]))[0])
            half = energy + moment * (end - start) / 2
        energy += moment * (end - start)
        if not energy > 0:
            break
        moments.append(moment)
        energies.append(energy)
    return moments, energies


def moment_curve(motion: TrueMotion) -> tuple[Reals, Reals]:
    """Travels and the moments there, on both sides of where the moment jumps."""
    travels, moments = list[Reals](), list[Reals]()
    for start, end in pairwise(motion.machine.edges(motion.start, motion.last_travel)):
        travel = np.linspace(start, end, CURVE_SAMPLES)
        omega = motion.state_at(travel).omega
        before = motion.machine.moment(travel[-1:], omega[-1:], side=-1)
        travels.append(travel)
        moments.append(np.concatenate([motion.machine.moment(travel[:-1], omega[:-1]), before]))
    return np.concatenate(travels), np.concatenate(moments)


class _MotionRecorder:
    """Draws one motion on the board."""

    def __init__(self, motion: TrueMotion, travel: Reals, moments: Reals, energies: Reals, room: PanelSize):
        self.motion, self.travel, self.x = motion, travel, travel - motion.start
        inertias, first = motion.machine.inertia(travel), 0 if energies[0] > 0 else 2
        omegas = np.sqrt(2 * energies / inertias)
        curve = moment_curve(motion)[1]
        self.lay = MotionLayout(self.x, moments, (float(np.nanmin(curve)), float(np.nanmax(curve))), energies, inertias,
                                omegas, first, motion.last_travel - motion.start, motion.machine.degree, room)
        self.first, self.frames = first, self.lay.frames
        self.board, self.marks = Board(), dict[str, list[Mark]]()

    # ---- drawing ---------------------------------------------------------------------------------------------------

    @property
    def draw(self) -> MotionDrawing:
        """The finished program."""
        stages: list[tuple[Said, Said, Callable[[], None]]] = [
            (said("Energy"), said("its chords have the slope of the moment in the middle of each strip"), self._energy),
            (said("Energy-mass diagram"), said("energies are projected across, inertias down"), self._mass),
            *([(said("Speed"), said("omega² = 2 E/I"), self.lay_off_computed)] if self.lay.origin_off_paper else [
                (said("Speed"), said("omega² = 2 k_E/k_I tan psi: the root is a mean proportional"), self._speed),
                (said("Slowness"), said("1/omega by similar triangles"), self._slowness)]),
            *([(said("First strips"), said("from rest 1/omega is infinite"), self.draw_first_strips)] if self.first
              else []),
            (said("Mean slowness"), said("of each strip"), self._means),
            (said("Time"), said("its chords have the slope of the mean 1/omega of each strip"), self._time)]
        with self.board.on(MOTION):
            self.draw_given()
        for title, law, draw in stages:
            with self.board.on(MOTION, stage=Stage(title, law)):
                draw()
        drawing = record_drawing(self.board, self.marks, {MOTION: PlanScale(on_paper=True)})
        return MotionDrawing(self.motion, drawing.mark_values(), self.frames, self.travel, self.first)

    def mark_value(self, frame: str, x: float, y: float, name: str) -> Mark:
        """A mark at values of a diagram."""
        at = self.frames[frame].position(x, y)
        return self.board.given(x=float(at[0]), y=float(at[1]), name=name)

    def draw_given(self) -> None:
        """Draw the given quantities: origins, divisions, moments, inertias, and the energy at the beginning."""
        x, lay, count = self.x, self.lay, len(self.x)
        self.origins = {name: self.mark_value(name, 0.0, 0.0, f"O_{letter}") for name, letter in ORIGINS.items()}
        low = self.frames["omega"]
        self.base = self.board.given(x=low.origin[0], y=low.origin[1], name="O_ω")
        self.start = self.mark_value("energy", 0.0, float(lay.energies[0]), "E_0")
        self.divisions = [self.mark_value("moment", float(x[k]), 0.0, f"D_{k}") for k in range(count)]
        middles = (x[1:] + x[:-1]) / 2
        self.marks["moment"] = [self.mark_value("moment", float(at), float(moment), f"M_{k}")
                                for k, (at, moment) in enumerate(zip(middles, lay.moments, strict=True), 1)]
        self.marks["inertia"] = [self.mark_value("inertia", float(lay.inertias[k]), float(x[k]), f"I_{k}")
                                 for k in range(count)]

    def _axes(self, frame: str, letter: str, pole: float) -> Axes:
        """The axes of a diagram, and its pole."""
        board, O = self.board, self.origins[frame]
        t = board.guide(O, dx=1, dy=0, why=said("the axis of travel"))
        y = board.perpendicular(t, O, why=said("the axis of {0}", letter))
        H = board.lay_off(O, dx=-pole, dy=0, name=f"H_{letter}", why=said("the pole: its distance sets the scale"))
        return Axes(O, t, y, H)

    def _energy(self) -> None:
        board, self.rate = self.board, self._axes("moment", "M", self.lay.poles[0])
        names = [f"E_{k}" for k in range(1, len(self.travel))]
        rays = integrate(board, self.marks["moment"], self.start, self.divisions, self.rate, names)
        self.marks["energy"] = [self.start, *(ray.end for ray in rays)]
        self.marks["energy rays"] = [ray.cut for ray in rays]

    def _mass(self) -> None:
        board = self.board
        self.O = self.origins["energy-mass"]
        self.marks["energy-mass"] = []
        for k, (energy, inertia) in enumerate(zip(self.marks["energy"], self.marks["inertia"], strict=True)):
            level = board.parallel(self.rate.abscissas, energy, why=said("carry the energy across"))
            upright = board.parallel(self.rate.ordinates, inertia, why=said("carry the inertia down"))
            self.marks["energy-mass"].append(board.meet(level, upright, name=f"W_{k}"))

    def lay_off_computed(self) -> None:
        """Speeds and their reciprocals laid off as they are computed: the rays' origin is off the paper."""
        low, omegas = self.frames["omega"], self.lay.omegas
        base = self.board.parallel(self.rate.abscissas, self.base, why=said("the axis of travel"))
        self.under = self._axes("slowness", "u", self.lay.poles[1])
        heights = low.y.mm(omegas), self.frames["slowness"].y.mm(1 / omegas)
        axes = base, self.under.abscissas
        for (name, letter), axis, rows in zip((("omega", "omega"), ("slowness", "u")), axes, heights, strict=True):
            self.marks[name] = []
            for k, height in enumerate(rows):
                text = said("from the point {0}: omega = {1}", k, digits(float(omegas[k])))
                self.marks[name].append(self.board.lay_off(self._foot(k, axis), dx=0, dy=float(height),
                                                           name=f"{letter}_{k}", why=text))

    def _foot(self, k: int, axis: Mark) -> Mark:
        """Intersection of the upright at a division with an axis."""
        text = said("the upright at division {0}", k)
        upright = self.board.parallel(self.rate.ordinates, self.divisions[k], why=text)
        return self.board.meet(upright, axis)

    def _speed(self) -> None:
        board = self.board
        axis = board.parallel(self.rate.abscissas, self.O, why=said("the axis of inertias"))
        C = board.lay_off(self.O, dx=self.lay.c, dy=0, name="C", why=said("c: its length sets the scale"))
        P = board.lay_off(C, dx=0, dy=-self.lay.d, name="P", why=said("d = 2 k_E/(k_I c k_ω²)"))
        self.cutting = board.parallel(self.rate.ordinates, C, why=said("on it the rays cut off c tan psi"))
        self.marks["omega"] = []
        base = board.parallel(self.rate.abscissas, self.base, why=said("the axis of travel"))
        self.marks["rays"], self.marks["roots"] = [], []
        for k in range(1 if self.first else 0, len(self.travel)):
            ray = board.line(self.O, self.marks["energy-mass"][k], why=said("its slope is that of omega²/2"))
            T = board.meet(ray, self.cutting, name=f"T_{k}")
            middle = board.midpoint(P, T)
            half = board.circle(middle, board.opening(middle, T), why=said("the half circle over d and c tan psi"))
            R = board.line_meets_circle(axis, half, way="on", name=f"R_{k}", why=said("the mean proportional"))
            self.carry_length(k, base, C, R, "omega", f"omega_{k}")
            self.marks["rays"].append(T)
            self.marks["roots"].append(R)

    def carry_length(self, k: int, base: Mark, one: Mark, other: Mark, what: str, name: str) -> None:
        """A length laid off upwards at a division of an axis."""
        board = self.board
        foot = self._foot(k, base)
        arc = board.circle(foot, board.opening(one, other), why=said("carried there with dividers"))
        upright = board.parallel(self.rate.ordinates, self.divisions[k])
        self.marks[what].append(board.line_meets_circle(upright, arc, way="on", name=name))

    def _slowness(self) -> None:
        board = self.board
        corner = self.origins["reciprocal"]
        right = board.lay_off(corner, dx=self.lay.q, dy=0, name="Q", why=said("q: its square sets the scale"))
        above = board.lay_off(corner, dx=0, dy=self.lay.q, name="S", why=said("q upwards"))
        wall = board.parallel(self.rate.ordinates, right, why=said("to it the speeds are projected"))
        ceiling = board.parallel(self.rate.abscissas, above, why=said("on it the rays cut off q²/omega"))
        self.marks["slowness"], self.marks["reciprocals"] = [], []
        self.under = self._axes("slowness", "u", self.lay.poles[1])
        for k, omega in self._from_first():
            level = board.parallel(self.rate.abscissas, omega, why=said("carry the speed across"))
            ray = board.line(corner, board.meet(level, wall), why=said("the ray of this speed"))
            cut = board.meet(ray, ceiling, name=f"U_{k}")
            self.carry_length(k, self.under.abscissas, above, cut, "slowness", f"u_{k}")
            self.marks["reciprocals"].append(cut)

    def _from_first(self) -> list[tuple[int, Mark]]:
        """The divisions from which on the time is integrated, and the speeds there."""
        omegas = dict(enumerate(self.marks["omega"], 1 if self.first else 0))
        return [(k, omegas[k]) for k in range(self.first, len(self.travel))]

    def _means(self) -> None:
        self.means = [self.board.midpoint(P, Q, why=said("the mean 1/omega of the strip"))
                      for P, Q in pairwise(self.marks["slowness"])]

    def _time(self) -> None:
        starts = self.marks.get("time") or [self.origins["time"]]
        names = [f"t_{k}" for k in range(self.first + 1, len(self.x))]
        rays = integrate(self.board, self.means, starts[-1], self.divisions[self.first:], self.under, names)
        self.marks["time"] = [*starts, *(ray.end for ray in rays)]
        self.marks["time rays"] = [ray.cut for ray in rays]

    def draw_first_strips(self) -> None:
        """The first points of the diagram of time, from rest: those of the parabola."""
        curve, x, board = parabola(self.x, self.lay.omegas), self.x, self.board
        axis = board.parallel(self.rate.abscissas, self.origins["time"], why=said("the axis of travel"))
        self.marks["time"] = []
        for k in (1, 2):
            spent = curve.time * float(x[k] / x[2]) ** (1 - curve.n)
            text = said("the first two strips as a parabola omega = {0} phi^{1}: {2} s", digits(curve.k),
                        digits(curve.n), digits(spent))
            length = float(self.frames["time"].y.mm(spent))
            self.marks["time"].append(board.lay_off(self._foot(k, axis), dx=0, dy=length, name=f"t_{k}", why=text))
