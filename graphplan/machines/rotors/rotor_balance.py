"""A rotor balanced: by polygons from its masses, or by trial runs, whose answers polygons carry to other planes.

What a trial finds of a plane is an unbalance there, opposite to its correction. Where the trial masses were put in the
correction planes themselves the corrections are found; elsewhere they are what balances the two unbalances (16.25).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import product
from typing import Any

from graphplan.kernel.drawing import record_drawing
from graphplan.kernel.positions import Angle
from graphplan.kernel.program import Board, Mark
from graphplan.machines.rotors.polygons import (
    Correction,
    Pair,
    PolygonRecorder,
    RotorDrawing,
    Sums,
    UnbalanceState,
    closing_sides,
    correction_of,
    sums,
)
from graphplan.machines.rotors.rotor import PLANES, Eccentric, Rotor, RotorTask, ThreeRuns, TrialWeights
from graphplan.machines.rotors.trial_runs import Effect, draw_trial, effect, read_corrections
from graphplan.phrases import Said, digits, said, unit

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

    @cached_property
    def sums(self) -> Sums:
        return sums(self.task.rotor, self.masses)

    def sides(self, values: Sequence[Any]) -> list[Pair]:
        """What the first answer is read from, mass times radius vectors, in any numbers that the drawing was made with.
        """
        if self.polygons:
            return closing_sides(self.drawing, self.task.rotor, self.sums, values)
        return [read_corrections(self.drawing, plane_effect, index, values)[0]
                for index, plane_effect in enumerate(self.effects)]

    def mass_and_radius(self, one: Correction) -> tuple[float | None, float | None]:
        """Mass and radius of a correction, in the task's units; nothing where neither is given."""
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
        """What is worth knowing of the rotor."""
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
