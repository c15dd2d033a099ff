"""What trial runs tell of a rotor's unbalance, in one plane, and how it is drawn.

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
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from graphplan.errors import Refused
from graphplan.kernel.kinds import Quantity
from graphplan.kernel.program import Board, Mark, Panel
from graphplan.kernel.stages import Stage
from graphplan.machines.rotors.polygons import Pair, RotorDrawing
from graphplan.machines.rotors.rotor import PLANES, MarkedRuns, ThreeRuns, Trial, TrialWeights, Vibration
from graphplan.machines.tolerances import HARMONIC_TOL, MIN_EFFECT, PREDICTION_TOL, VIBRATION_TOL
from graphplan.phrases import said

AMPLITUDE, WEIGHT = "amplitude", "weight"  # kinds of what is laid off


@dataclass(frozen=True)
class Effect:
    """What a trial tells: the vibration of the trial mass alone, and of each answer by how many degrees it is turned
    from the trial mass and how many times as large it is; `fourth` are the amplitudes that the answers foretell."""

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


# ---- numbers --------------------------------------------------------------------------------------------------------


def effect(trial: Trial, where: str) -> Effect:
    """What a trial tells; fails with `Refused` where no rotor behaves so."""
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
    """The permanent weight in the place of the trial weights' radius, by their first harmonic."""
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
    """Where the weight of this number hangs, in degrees."""
    return float(trial.angle + Fraction(360 * k, len(trial.weights)))


# ---- drawing --------------------------------------------------------------------------------------------------------


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
    """A vibration laid off; where it is nothing the mark itself."""
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
