"""A rotor balanced in its planes by polygons, and by trial runs where its unbalance is measured.

At the same speed centrifugal forces are as masses times radius vectors, and run as those do. Their moments about plane
I, all turned by a quarter, run as the forces do where a mass is on the side of plane II, and against them on the other.
So the moment polygon has the sides m_i a_i r_i and one unknown side, m_II a r_II, which closes it; divided by the
distance a of the planes it is a side of the force polygon, which m_I r_I closes. The speed cancels.

The marks of the moment polygon are M_0, M_1 ..., of the force polygon F_0, F_1 ..., numbered as the masses; of the end
view O and P_1, P_2 ..., the places of the masses, P_I and P_II those of the corrections. All numbers are those of the
task: masses times lengths, and times lengths once more.

Source: Ozols 1974, 16-5 with figs. 16-17 to 16-19, (16.20) to (16.24).

The vibration of a rotor is as its unbalance, and adds to that of a trial mass. With A_1 its own vibration, A_2 that
with the trial mass, and A_3 that with the trial mass opposite, A_2 = A_1 + A and A_3 = A_1 - A, where A is the trial
mass's effect: the diagonals of a parallelogram whose sides are A_1 and A. The trial mass on the radius that is turned
by alpha, from A to -A_1, and A_1/A times as large, balances the rotor.

- By amplitudes alone the parallelogram is drawn with compasses: a triangle of the sides A_2, A_3 and twice A_1, of
  which A is the median. It may lie on either side, so there are two answers; a fourth run decides.
- By marks the vectors are known, angles too.
- Weights that just turn the rotor against friction are smallest where the rotor helps and largest opposite; between
  they run as a cosine. Its amplitude is the permanent weight, at the place of the largest.

The triangle's marks are C and D, the ends of A_1, and G, that of A_2 and A; E is as far beyond D as C is before it.

Source: Ozols 1974, 16-6, figs. 16-20 to 16-24, (16.26) to (16.32), of which (16.28) and (16.29) are lost in the text
and drawn anew from the parallelogram. The polygon of weights is that of their first harmonic.

What a trial finds of a plane is an unbalance there, opposite to its correction. Where the trial masses were put in the
correction planes themselves the corrections are found; elsewhere they are what balances the two unbalances (16.25).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import Any

from graphplan.errors import Refused
from graphplan.kernel.kinds import Quantity
from graphplan.kernel.passes import Values, record_drawing
from graphplan.kernel.positions import Angle
from graphplan.kernel.program import Board, Mark, Panel
from graphplan.kernel.stages import Stage
from graphplan.machines.rotors.rotor import (
    PLANES,
    Eccentric,
    MarkedRuns,
    Rotor,
    RotorTask,
    ThreeRuns,
    Trial,
    TrialWeights,
    Vector,
    Vibration,
    direction,
)
from graphplan.machines.tolerances import CLOSING_TOL, HARMONIC_TOL, MIN_EFFECT, PREDICTION_TOL, VIBRATION_TOL
from graphplan.phrases import Said, digits, said, unit

END_VIEW = Panel("end view", said("end view"))
MOMENTS = Panel("moment polygon", said("moment polygon"), said("Moment polygon: m·a·r"))
FORCES = Panel("force polygon", said("force polygon"), said("Force polygon: m·r"))
Pair = tuple[Any, Any]  # a vector by its components, in any numbers
MOMENT, FORCE = "moment", "force"  # kinds of what is laid off


class UnbalanceState(Enum):
    """Kind of a rotor's unbalance: balanced, a force alone or one that a single mass elsewhere would balance, a moment
    alone, or both."""

    BALANCED = "balanced"
    STATIC = "static"
    DYNAMIC = "dynamic"
    BOTH = "static and dynamic"


@dataclass(frozen=True)
class Sums:
    """The sums of m r and of m a r about plane I, as vectors, and what stands in the planes for all masses together.

    Every rotor is out of balance as two eccentric masses are, in any two planes: `planes` are the unbalances of these,
    of one plane alone the sum of m r. What is nothing beside its parts is exactly 0.
    """

    force: Vector
    moment: Vector
    planes: tuple[Vector, ...]

    @property
    def static(self) -> float:
        """The static disbalance (16.23)."""
        return math.hypot(*self.force)

    @property
    def dynamic(self) -> float:
        """The moment about plane I: the dynamic disbalance (16.24) where the static is 0."""
        return math.hypot(*self.moment)

    @property
    def state(self) -> UnbalanceState:
        if not any(self.force):
            return UnbalanceState.DYNAMIC if any(self.moment) else UnbalanceState.BALANCED
        return UnbalanceState.BOTH if self.single is None else UnbalanceState.STATIC

    @property
    def single(self) -> float | None:
        """Distance from plane I at which one mass alone would balance force and moment; None if no single mass
        would."""
        (x, y), (u, v) = self.force, self.moment
        square = x * x + y * y
        if not square or abs(x * v - y * u) > CLOSING_TOL * self.static * self.dynamic:
            return None
        return float((x * u + y * v) / square)


def sums(rotor: Rotor, masses: tuple[Eccentric, ...]) -> Sums:
    """The sums of the masses' unbalances."""
    arms = [rotor.arm(mass.at) for mass in masses if mass.at is not None]
    force, moment = _sum([(Fraction(1), mass) for mass in masses]), _sum([*zip(arms, masses, strict=True)])
    if not rotor.dynamic:
        return Sums(force, moment, (force,))
    shares = [arm / rotor.plane_distance for arm in arms]
    first = _sum([(1 - share, mass) for share, mass in zip(shares, masses, strict=True)])
    return Sums(force, moment, (first, _sum([*zip(shares, masses, strict=True)])))


def _sum(sides: list[tuple[Fraction, Eccentric]]) -> Vector:
    """The sum of multiples of unbalances; 0 where it is within rounding of that."""
    x, y = (sum((times * mass.unbalance[k] for times, mass in sides), Fraction(0)) for k in (0, 1))
    least = CLOSING_TOL * sum(abs(float(times)) * mass.mass_radius for times, mass in sides)
    exact = all(mass.exact for _, mass in sides)
    return (Fraction(0), Fraction(0)) if not exact and math.hypot(x, y) <= least else (x, y)


@dataclass(frozen=True)
class Correction:
    """Correction of a rotor in one plane: its number, its place along the axis, mass times radius, and the angle."""

    index: int
    at: Fraction
    mass_radius: float
    angle: float

    @property
    def letter(self) -> str:
        return PLANES[self.index]


@dataclass(frozen=True)
class RotorDrawing:
    """The drawing of polygons and trials, a role for each name of a mark, with the values of its marks."""

    values: Values

    @cached_property
    def marks(self) -> dict[str, int]:
        """The steps of the marks, by their names."""
        return {name: step for name, (step,) in self.values.drawing.roles.items()}

    def position(self, name: str) -> complex:
        """Place of a mark, on its plan."""
        return complex(*self.values[self.marks[name]])

    def corners(self, letter: str) -> list[str]:
        """The marks of a polygon, in their order."""
        return [name for name in self.marks if name.startswith(f"{letter}_")]

    def vector(self, start: str, end: str, values: Sequence[Any]) -> Pair:
        """The vector from one mark to another, in any numbers that the program has been drawn with."""
        (x, y), (u, v) = values[self.marks[start]], values[self.marks[end]]
        return u - x, v - y


def closing_sides(drawing: RotorDrawing, rotor: Rotor, found: Sums, values: Sequence[Any]) -> list[Pair]:
    """Corrections of each plane, mass times radius, as the sides that close the polygons: from the last mark to the
    first."""
    force = drawing.vector(drawing.corners("F")[-1], "F_0", values)
    sides = [force]
    if rotor.dynamic:
        x, y = drawing.vector(drawing.corners("M")[-1], "M_0", values)
        second = x / float(rotor.plane_distance), y / float(rotor.plane_distance)
        sides = [force if any(found.force) else (-second[0], -second[1]), second]
    return [side if any(unbalance) else (0.0, 0.0) for side, unbalance in zip(sides, found.planes, strict=True)]


def correction_of(rotor: Rotor, index: int, side: Pair) -> Correction:
    """The correction in a plane that has this mass times radius vector."""
    return Correction(index, rotor.planes[index], math.hypot(*side), direction(*side))


def free_radius(rotor: Rotor, masses: tuple[Eccentric, ...]) -> Fraction:
    """The radius at which corrections without a radius are drawn: that of the outermost mass, or 1."""
    radii = [Fraction(mass.radius) for mass in masses if mass.radius]
    return max([*radii, *(radius for radius in rotor.radii if radius)], default=Fraction(1))


class PolygonRecorder:
    """Draws the polygons of one rotor on a board; `marks` are those that are read or shown, by their names."""

    def __init__(self, board: Board, rotor: Rotor, masses: tuple[Eccentric, ...]):
        self.board, self.rotor, self.masses = board, rotor, masses
        self.sums, self.free = sums(rotor, masses), free_radius(rotor, masses)
        self.marks: dict[str, Mark] = {}
        self.turned = [(k, mass) for k, mass in enumerate(masses, 1) if any(mass.unbalance)]  # those off the axis

    def draw_end_view(self) -> None:
        """The end view: the axis and the places of the masses."""
        with self.board.on(END_VIEW):
            self._keep("O", self.board.given(x=0, y=0, name="O"))
            for k, mass in self.turned:
                ratio = mass.mass or Fraction(mass.mass_radius) / self.free
                x, y = (component / ratio for component in mass.unbalance)
                self._keep(f"P_{k}", self.board.given(x=x, y=y, name=f"P_{k}"))

    def draw(self) -> None:
        """The polygons, and the places of the corrections."""
        if self.rotor.dynamic:
            law = said("each m·a·r runs as the radius, left of plane I against it; m_II·a·r_II closes")
            with self.board.on(MOMENTS, stage=Stage(said("Moment polygon"), law)):
                self._moments()
        law = said("centrifugal forces are as m·r; m_I·r_I closes") if self.rotor.dynamic else said(
            "centrifugal forces are as m·r; the correction closes")
        with self.board.on(FORCES, stage=Stage(said("Force polygon"), law)):
            self._forces()
        with self.placing_stage(said("their radii run as the closing sides")):
            self._corrections()

    def placing_stage(self, law: Said) -> AbstractContextManager[None]:
        """The stage in which correction masses are placed."""
        return self.board.on(END_VIEW, stage=Stage(said("Correction masses"), law))

    def _keep(self, name: str, mark: Mark) -> Mark:
        self.marks[name] = mark
        return mark

    def _sides(self, letter: str, written: str, kind: str, arms: Iterable[tuple[int, Eccentric, Fraction]]) -> Mark:
        """A polygon of multiples of the masses' unbalances, each along the radius; the last mark."""
        end = self.marks[f"{letter}_0"]
        for k, mass, arm in arms:
            radius = self.board.line(self.marks["O"], self.marks[f"P_{k}"])
            name, length = f"{letter}_{k}", Quantity(written.format(k), kind)
            text = said("opposite to the radius: left of plane I") if arm < 0 else ""
            end = self._keep(name, self.board.lay_along(self.board.parallel(radius, end), end, name=name, why=text,
                                                        length=mass.mass_radius * float(arm), quantity=length))
        return end

    def _moments(self) -> None:
        """The moment polygon of the masses that are not in plane I."""
        self._keep("M_0", self.board.begin(plan=MOMENTS, name="M_0"))
        arms = [(k, mass, self.rotor.arm(mass.at)) for k, mass in self.turned if mass.at is not None]
        self.last = self._sides("M", "m_{0}·a_{0}·r_{0}", MOMENT, (arm for arm in arms if arm[2]))

    def _forces(self) -> None:
        """The force polygon, with what the moment polygon gives."""
        self._keep("F_0", self.board.begin(plan=FORCES, name="F_0"))
        end = self._sides("F", "m_{0}·r_{0}", FORCE, ((k, mass, Fraction(1)) for k, mass in self.turned))
        if self.rotor.dynamic and any(self.sums.moment) and any(self.sums.force):
            end = self._keep("F_II", self.board.step_off(
                self.last, self.marks["M_0"], end, ratio=1 / self.rotor.plane_distance, name="F_II",
                why=said("m_II·r_II: the side that closes the moment polygon, divided by a")))
        self.end = end

    def _corrections(self) -> None:
        """Place the correction masses: on radii parallel to the sides that close the polygons."""
        if self.rotor.dynamic and any(self.sums.moment):
            side = self.board.line(self.last, self.marks["M_0"], why=said("the closing side"))
            self.place_correction(1, self.board.parallel(side, self.marks["O"]))
            if not any(self.sums.force):
                self.place_correction(0, self.board.parallel(side, self.marks["O"]), -1, said(
                    "forces close by themselves: m_I·r_I is opposite and as large"))
        if any(self.sums.force) and any(self.sums.planes[0]):
            side = self.board.line(self.end, self.marks["F_0"], why=said("the closing side"))
            self.place_correction(0, self.board.parallel(side, self.marks["O"]))

    def place_correction(self, index: int, ray: Mark, way: int = 1, why: str = "", prime: str = "") -> None:
        """A correction mass on a radius, or opposite."""
        letter, given_radius = PLANES[index], self.rotor.radii[index]
        name = f"P_{letter}{prime}"
        why = why or ("" if given_radius else said("its radius may be chosen"))
        length = way * (given_radius or self.free)
        self._keep(name, self.board.lay_along(ray, self.marks["O"], length=length, name=name, why=why,
                                              quantity=Quantity(f"r_{letter}", "length")))


AMPLITUDE, WEIGHT = "amplitude", "weight"  # kinds of what is laid off


@dataclass(frozen=True)
class Effect:
    """Result of a trial: the vibration of the trial mass alone, and of each answer its angle from the trial mass in
    degrees and its ratio to it; `fourth` are the amplitudes that the answers predict."""

    trial: Trial
    amplitude: float
    ratio: float
    turns: tuple[float, ...]
    fourth: tuple[float, ...] = ()

    @property
    def balancing(self) -> list[complex]:
        """Mass times radius vector of the correction, one for each answer."""
        mass_radius = float(self.trial.mass_radius) * self.ratio
        return [cmath.rect(mass_radius, math.radians(float(self.trial.angle) + turn)) for turn in self.turns]


TRIAL_PLANS = tuple(Panel(f"trial {letter}", said("plan of trial {0}", letter),
                          said("Trial in plane {0}", letter)) for letter in PLANES)


def effect(trial: Trial, where: str) -> Effect:
    """Result of a trial; fails with `Refused` if no rotor behaves so."""
    match trial:
        case ThreeRuns():
            return three_runs_effect(trial, where)
        case MarkedRuns():
            return marked_effect(trial, where)
        case TrialWeights():
            return weights_effect(trial)
    raise TypeError(f"{type(trial).__name__} is no trial")


def three_runs_effect(trial: ThreeRuns, where: str) -> Effect:
    """The trial's effect by (16.29), alpha by (16.32)."""
    first, second, third = trial.amplitudes
    square = (second**2 + third**2) / 2 - first**2
    amplitudes_text = f"the amplitudes {', '.join(f'{float(amplitude):g}' for amplitude in trial.amplitudes)}"
    if square < 0 or square <= first**2 * Fraction(MIN_EFFECT) ** 2:
        why = "A² = (A_2² + A_3²)/2 - A_1² is below 0" if square < 0 else "the trial mass has almost no effect"
        raise Refused(where, f"{amplitudes_text}: {why}", "measure again, with a larger trial mass")
    over, under = (third**2 - second**2) / 4, first**2 * square  # cos alpha = over / sqrt(under)
    if over**2 > under:
        raise Refused(where, f"{amplitudes_text}: no parallelogram has these sides and diagonals (|cos α| > 1)",
                      "measure again")
    A = math.sqrt(square)
    if first <= VIBRATION_TOL * A:
        return Effect(trial, A, 0.0, (0.0,))
    alpha = math.degrees(math.acos(max(-1.0, min(1.0, float(over) / math.sqrt(under)))))
    ratio, turns = float(first) / A, (alpha,) if over**2 == under else (alpha, -alpha)
    if trial.fourth is None or len(turns) == 1:
        return Effect(trial, A, ratio, turns)
    foretold = [foretold_amplitude(trial, trial.fourth, A, turn) for turn in turns]
    if abs(foretold[0] - foretold[1]) <= PREDICTION_TOL * max(foretold):
        raise Refused(f"{where}.fourth", "both solutions predict the same amplitude there",
                      "a fourth run with the trial mass at another angle, not opposite to the second")
    order = sorted((0, 1), key=lambda k: abs(foretold[k] - float(trial.fourth.amplitude)))  # type: ignore[union-attr]
    return Effect(trial, A, ratio, (turns[order[0]],), tuple(foretold[k] for k in order))


def foretold_amplitude(trial: ThreeRuns, fourth: Vibration, A: float, turn: float) -> float:
    """The amplitude with the trial mass elsewhere, if this answer is right."""
    own_vibration = -cmath.rect(float(trial.amplitudes[0]), math.radians(turn))
    return abs(own_vibration + cmath.rect(A, math.radians(float(fourth.angle - trial.angle))))


def marked_effect(trial: MarkedRuns, where: str) -> Effect:
    """The trial's effect as a difference of vectors (16.26)."""
    first, second = (cmath.rect(float(vibration.amplitude), math.radians(float(vibration.angle)))
                     for vibration in (trial.first, trial.second))
    A = second - first
    if abs(A) <= MIN_EFFECT * abs(first):
        raise Refused(where, "both vibrations are the same: the trial mass has almost no effect",
                      "measure again, with a larger trial mass")
    if abs(first) <= VIBRATION_TOL * abs(A):
        return Effect(trial, abs(A), 0.0, (0.0,))
    return Effect(trial, abs(A), abs(first) / abs(A), (math.degrees(cmath.phase(-first / A)),))


def weights_effect(trial: TrialWeights) -> Effect:
    """The permanent weight instead of the trial weights' radius, by their first harmonic."""
    first = harmonic(trial)
    mean = float(sum(trial.weights)) / len(trial.weights)
    if abs(first) <= HARMONIC_TOL * mean or not mean:
        return Effect(trial, mean, 0.0, (0.0,))
    return Effect(trial, mean, abs(first), (math.degrees(cmath.phase(first)) - float(trial.angle),))


def harmonic(trial: TrialWeights) -> complex:
    """The amplitude of the weights over the turn, in the direction of the largest."""
    count = len(trial.weights)
    return 2 / count * sum((cmath.rect(float(weight), math.radians(angle_of(trial, k)))
                            for k, weight in enumerate(trial.weights)), 0j)


def angle_of(trial: TrialWeights, k: int) -> float:
    """Angle of the weight of this number, in degrees."""
    return float(trial.angle + Fraction(360 * k, len(trial.weights)))


def draw_trial(board: Board, effect: Effect, index: int) -> dict[str, Mark]:
    """The plan of one trial; its marks by the number of the plane and their names, such as 0:C."""
    if isinstance(effect.trial, TrialWeights):
        title, law = said("Trial weights"), said("each in the direction in which it hangs; 2/n times their sum is p")
    elif isinstance(effect.trial, MarkedRuns):
        title, law = said("Vibrations"), said("A = A_2 − A_1 is the effect of the trial mass")
    else:
        title, law = said("Three runs"), said("A_2 = A_1 + A and A_3 = A_1 − A: a triangle with the median A")
    recorder = next(draws for kind, draws in DRAWN.items() if isinstance(effect.trial, kind))
    with board.on(TRIAL_PLANS[index], stage=Stage(title, law)):
        return {f"{index}:{name}": mark for name, mark in recorder(board, effect, TRIAL_PLANS[index]).items()}


def _drawn_runs(board: Board, effect: Effect, plan: Panel) -> dict[str, Mark]:
    """The triangle with its median, by compasses; on both sides."""
    trial = effect.trial
    assert isinstance(trial, ThreeRuns)
    first, second, third = trial.amplitudes
    C = board.begin(plan=plan, name="C")
    if not effect.ratio:
        return {"C": C}
    base = board.guide(C, dx=1, dy=0, why=said("any direction"))
    D = board.lay_along(base, C, length=first, name="D", quantity=Quantity("A_1", AMPLITUDE))
    E = board.transfer(C, D, D, name="E")
    if len(effect.turns) == 1 and not effect.fourth:
        projection = effect.amplitude * math.cos(math.radians(effect.turns[0]))
        G = board.lay_along(base, C, length=float(first) - projection, name="G", quantity=Quantity("A_2", AMPLITUDE),
                            why=said("A_1, A_2 and A_3 lie on one line"))
        return {"C": C, "D": D, "E": E, "G": G}
    arcs = [board.circle(P, board.radius(length=length, quantity=Quantity(letter, AMPLITUDE)))
            for P, length, letter in ((C, second, "A_2"), (E, third, "A_3"))]
    left, right = (board.circles_meet(*arcs, side=side, name="G", why=why) for side, why in (
        ("left", said("DG is the effect A of the trial mass, the angle from DG to DC is alpha")),
        ("right", said("the other answer: amplitudes do not tell the sense of alpha"))))
    marks = {"C": C, "D": D, "E": E, "G": left, "H": right}
    return marks if effect.turns[0] > 0 else marks | {"G": right, "H": left}


def _drawn_marks(board: Board, effect: Effect, plan: Panel) -> dict[str, Mark]:
    """The vectors of both vibrations."""
    trial = effect.trial
    assert isinstance(trial, MarkedRuns)
    C = board.begin(plan=plan, name="C")
    D = lay_off_vibration(board, C, trial.first, "D", "A_1")
    G = lay_off_vibration(board, C, trial.second, "G", "A_2",
                          said("DG is the effect A of the trial mass; the angle from DG to DC "
                                                       "is alpha"))
    return {"C": C, "D": D, "G": G}


def lay_off_vibration(board: Board, P: Mark, one: Vibration, name: str, letter: str, why: str = "") -> Mark:
    """Lay off a vibration; the mark itself if it is zero."""
    if not one.amplitude:
        return P
    z = cmath.rect(float(one.amplitude), math.radians(float(one.angle)))
    return board.lay_off(P, dx=z.real, dy=z.imag, name=name, quantity=Quantity(letter, AMPLITUDE), why=why)


def _drawn_weights(board: Board, effect: Effect, plan: Panel) -> dict[str, Mark]:
    """The polygon of the weights, and its closing side divided."""
    trial = effect.trial
    assert isinstance(trial, TrialWeights)
    end = W = board.begin(plan=plan, name="W_0")
    marks = {"W_0": W}
    for k, weight in enumerate(trial.weights, 1):
        vibration = Vibration(weight, Fraction(angle_of(trial, k - 1)))
        end = marks[f"W_{k}"] = lay_off_vibration(board, end, vibration, f"W_{k}", f"p_{k - 1}")
    if effect.ratio:
        marks["p"] = board.step_off(W, end, W, ratio=Fraction(2, len(trial.weights)), name="p", why=said(
            "the permanent weight, where the largest trial weight would hang"))
    return marks


DRAWN: dict[type[Trial], Callable[[Board, Effect, Panel], dict[str, Mark]]] = {
    ThreeRuns: _drawn_runs, MarkedRuns: _drawn_marks, TrialWeights: _drawn_weights}


def read_corrections(drawing: RotorDrawing, effect: Effect, index: int, values: Sequence[Any]) -> list[Pair]:
    """The corrections as they are measured on the plan of a trial, mass times radius, one for each answer."""
    mass_radius, at = float(effect.trial.mass_radius), cmath.rect(1.0, math.radians(float(effect.trial.angle)))
    if not effect.ratio:
        return [(0.0, 0.0)]
    if isinstance(effect.trial, TrialWeights):
        x, y = drawing.vector(f"{index}:W_0", f"{index}:p", values)
        return [(mass_radius * x, mass_radius * y)]
    (u, v), corrections = drawing.vector(f"{index}:D", f"{index}:C", values), []
    for end in "GH"[:len(effect.turns)]:  # the trial mass's vector, turned and grown as DG is to DC
        x, y = drawing.vector(f"{index}:D", f"{index}:{end}", values)
        square = (x * x + y * y) / mass_radius
        along, across = (u * x + v * y) / square, (v * x - u * y) / square
        corrections.append((along * at.real - across * at.imag, along * at.imag + across * at.real))
    return corrections


DOUBT_SHARE = 0.25  # of the way from what one answer foretells to what the other does: a measurement is off both
Answer = tuple[Correction, ...]


@dataclass(frozen=True)
class BalancedRotor:
    """A rotor with its unbalances, given or measured, the drawing that balances it, and the corrections by answers.

    There are several answers where amplitudes alone leave the sense of an angle open, each with its unbalances.
    """

    task: RotorTask
    effects: tuple[Effect, ...]
    unbalances: tuple[tuple[Eccentric, ...], ...]
    drawing: RotorDrawing
    answers: tuple[Answer, ...]

    @property
    def masses(self) -> tuple[Eccentric, ...]:
        """The unbalances of the first answer."""
        return self.unbalances[0]

    @property
    def corrections(self) -> Answer:
        """The first answer."""
        return self.answers[0]

    @property
    def sums(self) -> Sums:
        return sums(self.task.rotor, self.masses)

    def sides(self, values: Sequence[Any]) -> list[Pair]:
        """Sides of which the first answer is read, mass times radius vectors, in the numbers of the drawing."""
        if self.polygons:
            return closing_sides(self.drawing, self.task.rotor, self.sums, values)
        return [read_corrections(self.drawing, plane_effect, index, values)[0]
                for index, plane_effect in enumerate(self.effects)]

    def mass_and_radius(self, one: Correction) -> tuple[float | None, float | None]:
        """Mass and radius of a correction, in the task's units; None if neither is given."""
        radius, mass = self.task.rotor.radii[one.index], self.task.rotor.weights[one.index]
        if radius is not None:
            return one.mass_radius / float(radius), float(radius)
        return (None, None) if mass is None else (float(mass), one.mass_radius / float(mass))

    @property
    def polygons(self) -> bool:
        """Whether polygons are drawn."""
        return "F_0" in self.drawing.marks

    @property
    def notes(self) -> Iterator[Said]:
        """Yield the remarks on the rotor."""
        rotor, sums, units = self.task.rotor, self.sums, self.task.units
        if sums.state is UnbalanceState.BALANCED:
            yield said("the rotor is balanced as it is")
        elif not rotor.dynamic and any(sums.moment):
            yield said("one plane balances forces alone: a moment of {0} {1} about it is left, which two balance",
                       digits(sums.dynamic), unit(f"{units.mass}·{units.length}²"))
        elif sums.state is UnbalanceState.DYNAMIC:
            yield said("the unbalance is dynamic only: the force polygon closes by itself")
        elif rotor.dynamic and sums.single is not None and not self.effects:
            yield said("the unbalance is static only: one mass with m·r = {0} {1} at {2} {3} would balance it",
                       digits(sums.static), unit(f"{units.mass}·{units.length}"),
                       digits(float(rotor.planes[0]) + math.copysign(sums.single, rotor.planes[-1] - rotor.planes[0])),
                       unit(units.length))
        for plane_effect in self.effects:
            if plane_effect.fourth and isinstance(plane_effect.trial, ThreeRuns) and plane_effect.trial.fourth:
                (near, far), measured = plane_effect.fourth, float(plane_effect.trial.fourth.amplitude)
                if abs(measured - near) > DOUBT_SHARE * abs(far - near):
                    yield said("the fourth run should have given {0} or {1} and gave {2}", digits(near), digits(far),
                               digits(measured))
        if len(self.answers) > 1:
            yield said("amplitudes leave the sense of the angle open, so there are {0} answers: a fourth run decides",
                       len(self.answers))


def balance_rotor(task: RotorTask) -> BalancedRotor:
    """The corrections of a task; fails with `Refused` where what was measured cannot be."""
    if not task.trials:
        return _by_polygons(task, (), [task.rotor.masses])
    places = [f"{task.name}: trial" + (f".{k}" if len(task.trials) > 1 else "") for k in range(1, len(task.trials) + 1)]
    effects = tuple(map(effect, task.trials, places))
    choices = [[_unbalance(index, one, side) for side in one.balancing] for index, one in enumerate(effects)]
    masses = [tuple(choice) for choice in product(*choices)]
    if all(one.trial.at == plane for one, plane in zip(effects, task.rotor.planes, strict=True)):
        return _by_trials(task, effects, masses)
    return _by_polygons(task, effects, masses)


def _unbalance(index: int, one: Effect, side: complex) -> Eccentric:
    """The unbalance in the plane of a trial, opposite to its correction."""
    return Eccentric(PLANES[index].lower(), (Fraction(-side.real), Fraction(-side.imag)), one.trial.at, None, False)


def _by_polygons(task: RotorTask, effects: tuple[Effect, ...], masses: list[tuple[Eccentric, ...]]) -> BalancedRotor:
    """By polygons of the first choice of masses; the others are reckoned."""
    board = Board()
    recorder = PolygonRecorder(board, task.rotor, masses[0])
    recorder.draw_end_view()
    marks: dict[str, Mark] = {}
    for index, plane_effect in enumerate(effects):
        marks |= draw_trial(board, plane_effect, index)
    recorder.draw()
    drawing = rotor_drawing(board, marks | recorder.marks)
    sides = closing_sides(drawing, task.rotor, recorder.sums, drawing.values.numbers)
    first = tuple(correction_of(task.rotor, k, side) for k, side in enumerate(sides))
    other_answers = (compute_corrections(task.rotor, choice) for choice in masses[1:])
    return BalancedRotor(task, effects, tuple(masses), drawing, (first, *other_answers))


def _by_trials(task: RotorTask, effects: tuple[Effect, ...], masses: list[tuple[Eccentric, ...]]) -> BalancedRotor:
    """By the plans of trials alone, each in a correction plane."""
    board = Board()
    recorder = PolygonRecorder(board, task.rotor, ())
    recorder.draw_end_view()
    marks: dict[str, Mark] = {}
    for index, plane_effect in enumerate(effects):
        marks |= draw_trial(board, plane_effect, index)
    weighed = any(isinstance(one.trial, TrialWeights) for one in effects)
    with recorder.placing_stage(said("where the largest trial weight would hang") if weighed else
                                said("turned by alpha from the trial mass, A_1/A times as large")):
        for index, plane_effect in enumerate(effects):
            for k, side in enumerate(plane_effect.balancing if plane_effect.ratio else ()):
                recorder.place_correction(index, _ray(board, recorder.marks["O"], plane_effect, k, side), prime="'" * k)
    drawing = rotor_drawing(board, marks | recorder.marks)
    corrections = [read_corrections(drawing, one, index, drawing.values.numbers) for index, one in enumerate(effects)]
    answers = tuple(tuple(correction_of(task.rotor, index, side) for index, side in enumerate(sides))
                    for sides in product(*corrections))
    return BalancedRotor(task, effects, tuple(masses), drawing, answers)


def _ray(board: Board, O: Mark, one: Effect, k: int, side: complex) -> Mark:
    """The radius of a correction that a trial has found."""
    angle = math.degrees(cmath.phase(side)) % 360
    text = said("{0}° from the trial mass", digits(one.turns[k])) if isinstance(one.trial, ThreeRuns) else ""
    return board.inclined(O, angle=Angle(digits(angle), side.real, side.imag), why=text)


def rotor_drawing(board: Board, marks: dict[str, Mark]) -> RotorDrawing:
    """The finished program."""
    return RotorDrawing(record_drawing(board, {name: [mark] for name, mark in marks.items()}).mark_values())


def compute_corrections(rotor: Rotor, masses: tuple[Eccentric, ...]) -> Answer:
    """The corrections by their equations: opposite to the two eccentric masses that a rotor is as."""
    return tuple(correction_of(rotor, k, (-float(x), -float(y))) for k, (x, y) in enumerate(sums(rotor, masses).planes))
