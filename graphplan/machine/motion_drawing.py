"""The true motion as it is drawn: energy by graphical integration, speed by rays of the energy-mass diagram, and time.

The work of the moments is drawn under their diagram, strip by strip. Each energy is projected across, each inertia down
from its turned diagram: they meet in a point of the energy-mass diagram, whose ray from the origin has the slope psi,
and omega^2 = 2 k_E/k_I tan psi. The root is drawn as a mean proportional: on the upright at a distance c the ray cuts
off c tan psi, and a half circle over this length and another one, d below, cuts off omega on the axis. By similar
triangles follows 1/omega, and by integration the time, from rest with two strips of a parabola first.

Sources: Ozols 1974, 13-6 with fig. 13-9 and 13-10, (13.36) to (13.41); 15-2 (integration with a pole).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from graphplan.cycle.curves import FARTHEST, round_scale
from graphplan.cycle.diagram_program import Axes, integrate
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.passes import freeze
from graphplan.kernel.program import Board, Mark, Panel, Program, evaluate
from graphplan.kernel.stages import Stage
from graphplan.machine.driven import Driven
from graphplan.machine.integrals import Reals
from graphplan.machine.strips import parabola
from graphplan.machine.true_motion import TrueMotion
from graphplan.phrases import Said, digits, said

MOTION = Panel("motion", said("motion"), said("True motion: energy, speed and time over the travel"))
STRIPS = 24
ROOM, LENGTH, BESIDE = 34.0, 144.0, 20.0  # mm: for poles, of the axis of travel, between the two columns of diagrams
HEIGHTS = {"moment": 36.0, "energy": 56.0, "omega": 40.0, "slowness": 34.0, "time": 40.0}
BETWEEN, WIDE = 11.0, 56.0  # mm: between diagrams under each other, of the largest inertia
ORIGINS = {"moment": "M", "energy-mass": "I", "omega": "ω", "slowness": "u", "reciprocal": "r", "time": "t"}
SLOWEST = 8.0  # times the least 1/omega: what is larger goes off the paper


class Frame(NamedTuple):
    """A diagram on the panel: where its quantities are nothing, how much of each a mm is, and its window, in mm."""

    x: float
    y: float
    k_x: float
    k_y: float
    left: float
    bottom: float
    right: float
    top: float

    def at(self, x: Any, y: Any) -> tuple[Any, Any]:
        """Where values lie, in mm."""
        return self.x + x / self.k_x, self.y + y / self.k_y


@dataclass(frozen=True, eq=False)
class MotionDrawing:
    """The recorded construction of a motion and what it finds at its divisions.

    `travel` are the divisions in SI, `first` the place of the first whose time is integrated. `frames` are the
    diagrams, by name; `marks` the steps that draw something, by what it is.
    """

    motion: TrueMotion
    program: Program
    values: list[Any]
    frames: dict[str, Frame]
    marks: dict[str, list[int]]
    travel: Reals
    first: int

    def read(self, name: str) -> Reals:
        """What the drawing says at the divisions: `energy`, `omega` or `time`, nan where it says nothing."""
        frame, found = self.frames[name], np.full(len(self.travel), np.nan)
        heights = [self.values[step][1] for step in self.marks[name]]
        start = len(self.travel) - len(heights)
        found[start:] = (np.array(heights) - frame.y) * frame.k_y
        if start and name != "slowness":
            found[0] = 0.0
        return found

    @cached_property
    def errors(self) -> dict[str, float]:
        """How far the drawing is from the true motion at most, as parts of the largest energy, speed and time."""
        true = self.motion.at(self.travel)
        pairs = {name: (self.read(name), getattr(true, name)) for name in ("energy", "omega", "time")}
        return {name: float(np.nanmax(abs(drawn - exact)) / np.nanmax(abs(exact)))
                for name, (drawn, exact) in pairs.items()}


def drawn(motion: TrueMotion, strips: int = STRIPS) -> MotionDrawing | None:
    """The construction of a motion in so many strips; none where it stops within the first three.

    Each strip has the moment of its middle, that of loads over a speed at the speed at which the strip begins.
    """
    machine = motion.machine
    travel = np.linspace(motion.start, motion.end, strips + 1)
    moments, energies = _chords(machine, travel, float(motion.at([motion.start]).energy[0]))
    if len(moments) < 3:
        return None
    return _Drawing(motion, travel[:len(energies)], np.array(moments), np.array(energies)).made


def _chords(machine: Driven, travel: Reals, energy: float) -> tuple[list[float], list[float]]:
    """The moment of each strip, and the energies at the divisions, as far as there is some."""
    moments, energies = list[float](), [energy]
    for here, there in pairwise(travel):
        rate = np.sqrt(2 * energies[-1] / machine.inertia(np.array([here])))
        moment = float(machine.moment(np.array([(here + there) / 2]), rate)[0])
        energy = energies[-1] + moment * (there - here)
        if not energy > 0:
            break
        moments.append(moment)
        energies.append(energy)
    return moments, energies


class _Drawing:
    """Draws one motion on the board."""

    def __init__(self, motion: TrueMotion, travel: Reals, moments: Reals, energies: Reals):
        self.motion, self.travel, self.moments, self.energies = motion, travel, moments, energies
        self.inertias = motion.machine.inertia(travel)
        self.omegas = np.sqrt(2 * energies / self.inertias)
        self.first = 2 if energies[0] == 0 else 0
        self.board, self.found = Board(), dict[str, list[Mark]]()
        self._scaled()

    # ---- scales and places -----------------------------------------------------------------------------------------

    def _scaled(self) -> None:
        """Round scales, and what they make of the lengths c, d, q and the poles."""
        k_phi = self._travel_scale(self.motion.end - self.motion.start)
        slowness = 1 / self.omegas[max(1, self.first):]
        slowest = min(slowness.max(), SLOWEST * slowness.min())
        k_e = _scale(self.energies.max() / HEIGHTS["energy"])
        k_i = _scale(self.inertias.max() / WIDE)
        k_w = _scale(self.omegas.max() / HEIGHTS["omega"])
        k_s = _scale(slowest / HEIGHTS["slowness"])
        span = max(self.moments.max(), 0) - min(self.moments.min(), 0)
        k_m = _scale(max(span / HEIGHTS["moment"], k_e / k_phi / FARTHEST))
        end = self._elapsed()
        k_t = _scale(max(end / HEIGHTS["time"], k_s * k_phi * 5))
        self.poles = k_e / k_m / k_phi, k_t / k_s / k_phi
        steepest = (self.energies / k_e / (self.inertias / k_i)).max()
        self.c = min(WIDE * 0.6, HEIGHTS["energy"] / steepest)
        self.d = 2 * k_e / (k_i * self.c * k_w**2)
        self.q = 1 / math.sqrt(k_w * k_s)
        self._framed(k_phi, {"moment": k_m, "energy": k_e, "omega": k_w, "slowness": k_s, "time": k_t}, k_i)

    def _travel_scale(self, span: float) -> float:
        """Degrees or lengths for one mm, round, in SI."""
        unit = self.motion.machine.degree
        return unit * _scale(span / unit / LENGTH)

    def _elapsed(self) -> float:
        """About how long it takes."""
        w, x = self.omegas, self.travel
        start = parabola(x, w).time if self.first else 0.0
        return start + float((np.diff(x)[self.first:] * (1 / w[self.first:-1] + 1 / w[self.first + 1:]) / 2).sum())

    def _framed(self, k_phi: float, k: dict[str, float], k_i: float) -> None:
        """The diagrams of the travel under each other, inertia and energy-mass diagram right of the first two."""
        self.frames, top = dict[str, Frame](), 0.0
        length = (self.motion.end - self.motion.start) / k_phi
        for name, height in HEIGHTS.items():
            below = -min(self.moments.min() / k["moment"], 0.0) if name == "moment" else 0.0
            low = top - height
            self.frames[name] = Frame(0.0, low + below, k_phi, k[name], 0.0, low, length, top)
            top = low - BETWEEN
        right, energy, moment = length + BESIDE, self.frames["energy"], self.frames["moment"]
        end = right + WIDE
        self.frames["energy-mass"] = Frame(right, energy.y, k_i, k["energy"], right, energy.bottom, end, energy.top)
        down = -(self.motion.end - self.motion.start) / (moment.top - moment.bottom)
        self.frames["inertia"] = Frame(right, moment.top, k_i, down, right, moment.bottom, end, moment.top)
        omega = self.frames["omega"]
        self.frames["reciprocal"] = Frame(right, omega.y, 1.0, 1.0, right, omega.bottom, end, omega.top)

    # ---- drawing ---------------------------------------------------------------------------------------------------

    @property
    def made(self) -> MotionDrawing:
        """The finished program."""
        stages: list[tuple[Said, Said, Callable[[], None]]] = [
            (said("Energy"), said("its chords have the slope of the moment in the middle of each strip"), self._energy),
            (said("Energy-mass diagram"), said("energies are projected across, inertias down"), self._mass),
            (said("Speed"), said("omega² = 2 k_E/k_I tan psi: the root is a mean proportional"), self._speed),
            (said("Slowness"), said("1/omega by similar triangles"), self._slowness),
            (said("Time"), said("its chords have the slope of the mean 1/omega of each strip"), self._time)]
        with self.board.on(MOTION):
            self._ruled()
        for title, law, draw in stages:
            with self.board.on(MOTION, stage=Stage(title, law)):
                draw()
        names = [(name, mark) for name, marks in self.found.items() for mark in marks]
        program = freeze(self.board, [mark for _, mark in names])
        found: dict[str, list[int]] = {name: [] for name in self.found}
        for (name, _), step in zip(names, program.wanted, strict=True):
            found[name].append(step)
        return MotionDrawing(self.motion, program, evaluate(program, Floats()), self.frames, found, self.travel,
                             self.first)

    def _given(self, frame: str, x: float, y: float, name: str = "") -> Mark:
        """A mark at values of a diagram."""
        at = self.frames[frame].at(x, y)
        return self.board.given(x=float(at[0]), y=float(at[1]), name=name)

    def _ruled(self) -> None:
        """What is given: origins, divisions, moments, inertias, and the energy at the beginning."""
        x, count = self.travel - self.motion.start, len(self.travel)
        self.origins = {name: self._given(name, 0.0, 0.0, f"O_{letter}") for name, letter in ORIGINS.items()}
        self.start = self._given("energy", 0.0, float(self.energies[0]), "E_0")
        self.divisions = [self._given("moment", float(x[k]), 0.0, f"D_{k}") for k in range(count)]
        middles = (x[1:] + x[:-1]) / 2
        self.found["moment"] = [self._given("moment", float(at), float(moment), f"M_{k}")
                                for k, (at, moment) in enumerate(zip(middles, self.moments, strict=True), 1)]
        self.found["inertia"] = [self._given("inertia", float(self.inertias[k]), float(x[k]), f"I_{k}")
                                 for k in range(count)]

    def _axes(self, frame: str, letter: str, pole: float) -> Axes:
        """The axes of a diagram, and its pole."""
        board, O = self.board, self.origins[frame]
        t = board.guide(O, dx=1, dy=0, why=said("the axis of travel"))
        y = board.perpendicular(t, O, why=said("the axis of {0}", letter))
        H = board.lay_off(O, dx=-pole, dy=0, name=f"H_{letter}", why=said("the pole: its distance sets the scale"))
        return Axes(O, t, y, H)

    def _energy(self) -> None:
        board, self.rate = self.board, self._axes("moment", "M", self.poles[0])
        names = [f"E_{k}" for k in range(1, len(self.travel))]
        rays = integrate(board, self.found["moment"], self.start, self.divisions, self.rate, names)
        self.found["energy"] = [self.start, *(ray.end for ray in rays)]
        self.found["energy rays"] = [ray.cut for ray in rays]

    def _mass(self) -> None:
        board = self.board
        self.O = self.origins["energy-mass"]
        self.found["energy-mass"] = []
        for k, (energy, inertia) in enumerate(zip(self.found["energy"], self.found["inertia"], strict=True)):
            level = board.parallel(self.rate.abscissas, energy, why=said("carry the energy across"))
            upright = board.parallel(self.rate.ordinates, inertia, why=said("carry the inertia down"))
            self.found["energy-mass"].append(board.meet(level, upright, name=f"W_{k}"))

    def _speed(self) -> None:
        board = self.board
        axis = board.parallel(self.rate.abscissas, self.O, why=said("the axis of inertias"))
        C = board.lay_off(self.O, dx=self.c, dy=0, name="C", why=said("c: its length sets the scale"))
        P = board.lay_off(C, dx=0, dy=-self.d, name="P", why=said("d = 2 k_E/(k_I c k_ω²)"))
        self.cutting = board.parallel(self.rate.ordinates, C, why=said("on it the rays cut off c tan psi"))
        self.found["omega"] = []
        base = board.parallel(self.rate.abscissas, self.origins["omega"], why=said("the axis of travel"))
        self.found["rays"], self.found["roots"] = [], []
        for k in range(1 if self.first else 0, len(self.travel)):
            ray = board.line(self.O, self.found["energy-mass"][k], why=said("its slope is that of omega²/2"))
            T = board.meet(ray, self.cutting, name=f"T_{k}")
            middle = board.midpoint(P, T)
            half = board.circle(middle, board.opening(middle, T), why=said("the half circle over d and c tan psi"))
            R = board.line_meets_circle(axis, half, way="on", name=f"R_{k}", why=said("the mean proportional"))
            self._carried(k, base, C, R, "omega", f"omega_{k}")
            self.found["rays"].append(T)
            self.found["roots"].append(R)

    def _carried(self, k: int, base: Mark, one: Mark, other: Mark, what: str, name: str) -> None:
        """A length laid off upwards at a division of an axis."""
        board = self.board
        upright = board.parallel(self.rate.ordinates, self.divisions[k], why=said("the upright at division {0}", k))
        foot = board.meet(upright, base)
        arc = board.circle(foot, board.opening(one, other), why=said("carried there with dividers"))
        self.found[what].append(board.line_meets_circle(upright, arc, way="on", name=name))

    def _slowness(self) -> None:
        board = self.board
        corner = self.origins["reciprocal"]
        right = board.lay_off(corner, dx=self.q, dy=0, name="Q", why=said("q: its square sets the scale"))
        above = board.lay_off(corner, dx=0, dy=self.q, name="S", why=said("q upwards"))
        wall = board.parallel(self.rate.ordinates, right, why=said("to it the speeds are projected"))
        ceiling = board.parallel(self.rate.abscissas, above, why=said("on it the rays cut off q²/omega"))
        self.found["slowness"], self.found["reciprocals"] = [], []
        self.under = self._axes("slowness", "u", self.poles[1])
        for k, omega in self._from_first():
            level = board.parallel(self.rate.abscissas, omega, why=said("carry the speed across"))
            ray = board.line(corner, board.meet(level, wall), why=said("the ray of this speed"))
            cut = board.meet(ray, ceiling, name=f"U_{k}")
            self._carried(k, self.under.abscissas, above, cut, "slowness", f"u_{k}")
            self.found["reciprocals"].append(cut)

    def _from_first(self) -> list[tuple[int, Mark]]:
        """The divisions from which on the time is integrated, and the speeds there."""
        omegas = dict(enumerate(self.found["omega"], 1 if self.first else 0))
        return [(k, omegas[k]) for k in range(self.first, len(self.travel))]

    def _time(self) -> None:
        board, x = self.board, self.travel - self.motion.start
        means = [board.midpoint(P, Q, why=said("the mean 1/omega of the strip"))
                 for P, Q in zip(self.found["slowness"], self.found["slowness"][1:], strict=False)]
        starts = self._begun(x)
        names = [f"t_{k}" for k in range(self.first + 1, len(x))]
        rays = integrate(board, means, starts[-1], self.divisions[self.first:], self.under, names)
        self.found["time"] = [*starts, *(ray.end for ray in rays)]
        self.found["time rays"] = [ray.cut for ray in rays]

    def _begun(self, x: Reals) -> Sequence[Mark]:
        """The first points of the diagram of time: its origin, or from rest those of the parabola."""
        if not self.first:
            return [self.origins["time"]]
        curve, found = parabola(x, self.omegas), []
        axis = self.board.parallel(self.rate.abscissas, self.origins["time"], why=said("the axis of travel"))
        for k in (1, 2):
            spent = curve.time * (x[k] / x[2]) ** (1 - curve.n)
            told = said("the first two strips as a parabola omega = {0} phi^{1}: {2} s", digits(round(curve.k, 4)),
                        digits(round(curve.n, 4)), digits(round(spent, 5)))
            upright = self.board.parallel(self.rate.ordinates, self.divisions[k])
            foot = self.board.meet(upright, axis)
            found.append(self.board.lay_off(foot, dx=0, dy=spent / self.frames["time"].k_y, name=f"t_{k}", why=told))
        return found


def _scale(least: float) -> float:
    return float(round_scale(float(least)))
