"""The sheet of a rotor, with its numbers as JSON and as a table."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any, NamedTuple

from graphplan.accuracy.expected import deviation
from graphplan.design.hand import Pencil, program_hand
from graphplan.kernel.kinds import Quantity
from graphplan.kernel.passes import Values
from graphplan.machines.rotors.check import bearing_reactions
from graphplan.machines.rotors.figures import MAX_LETTERED_CORNERS, RotorFigures, panels
from graphplan.machines.rotors.rotor import PLANES, MarkedRuns, ThreeRuns, TrialWeights, direction
from graphplan.machines.rotors.rotor_balance import (
    AMPLITUDE,
    FORCES,
    MOMENTS,
    Answer,
    BalancedRotor,
    Correction,
    Effect,
)
from graphplan.machines.tolerances import ZERO_TOL
from graphplan.mechanism.model import Scene
from graphplan.mechanism.units import KILOGRAMS, NEWTONS
from graphplan.output.tables import csv_text
from graphplan.phrases import Said, arrange, digits, join, said, unit
from graphplan.sheet.layout.scales import ratio
from graphplan.sheet.panels import PanelPage, PanelSheet, Words, check_words
from graphplan.sheet.words.lengths import Lengths, PaperDistance

HEADINGS = "what", "place", "mass_radius [kg m]", "angle [deg]"


def numbers(rotor: RotorOnPaper) -> dict[str, Any]:
    """All of it, plain data for JSON: kg, m and N, angles in degrees from 0 to 360; places along the axis as the task
    has them. `answers` are there where trials leave a choice, of which `corrections` is the first; `drawn_error` are
    two standard deviations of what a pencil draws of these; steps speak lengths of paper of this sheet."""
    found, sheet = rotor.balanced, rotor.sheet
    task, program, sums = found.task, found.drawing.values.drawing.program, found.sums
    kg_m, metres = float(task.kg_m), float(task.metres)
    drawn = [{"mass_radius": 2 * error.mass_radius * kg_m, "angle": 2 * error.angle} for error in rotor.errors]
    data: dict[str, Any] = {
        "title": task.title, "units": {"length": task.units.length, "mass_radius": "kg m", "moment": "kg m2"},
        "corrections": [one | {"drawn_error": error}
                        for one, error in zip(answer_numbers(found, found.corrections), drawn, strict=True)],
        "state": sums.state.value,
        "static_unbalance": sums.static * kg_m, "static_angle": direction(*sums.force),
        "moment": sums.dynamic * kg_m * metres, "moment_angle": direction(*sums.moment),
    }
    if len(found.answers) > 1:
        data["answers"] = [answer_numbers(found, answer) for answer in found.answers]
    if found.effects:
        data["trials"] = [{"amplitude": one.amplitude, "ratio": one.ratio, "turned": list(one.turns)}
                          | ({"fourth": list(one.fourth)} if one.fourth else {}) for one in found.effects]
    if task.rotor.bearings:
        data["reactions"] = {
            "omega": task.rotor.omega, "bearings": [float(at) for at in task.rotor.bearings],
            "before": [reaction_numbers(one) for one in bearing_reactions(found)],
            "after": [reaction_numbers(one) for one in bearing_reactions(found, found.corrections)]}
    return data | {
        "notes": [str(note) for note in found.notes],
        "steps": [{"step": program.number(step.index), "stage": str(stage.title),
                   "sentence": str(sheet.sentence_with_lengths(step))}
                  for stage, steps in program.stages for step in steps],
        "check": dict(rotor.check)}


def answer_numbers(found: BalancedRotor, answer: Answer) -> list[dict[str, Any]]:
    """The corrections of one answer, with the masses or radii that follow."""
    return [{"plane": plain_number(one.at), "index": one.index, "mass_radius": one.mass_radius * float(found.task.kg_m),
             "angle": one.angle, **mass_and_radius_numbers(found, one)} for one in answer]


def plain_number(number: Any) -> float | int:
    """A number as it is written, without a decimal point for integers."""
    return int(number) if number == int(number) else float(number)


def mass_and_radius_numbers(found: BalancedRotor, one: Correction) -> dict[str, float]:
    """Mass in kg and radius in m of a correction, where one of them is given."""
    mass, radius = found.mass_and_radius(one)
    units = {"mass": float(KILOGRAMS[found.task.units.mass]), "radius": float(found.task.metres)}
    return {key: value * units[key] for key, value in (("mass", mass), ("radius", radius)) if value is not None}


def reaction_numbers(reaction: complex) -> dict[str, float]:
    """A reaction that turns with the rotor, and its angle on it."""
    return {"force": abs(reaction), "angle": math.degrees(math.atan2(reaction.imag, reaction.real)) % 360}


def table(found: BalancedRotor) -> str:
    """Comma-separated text: a heading, then a line for each unbalance and each correction."""
    kg_m = float(found.task.kg_m)
    rows = [(f"unbalance {mass.name}", float(mass.at or 0), mass.mass_radius * kg_m, mass.angle)
            for mass in found.masses]
    rows += [(f"correction {one.letter}", float(one.at), one.mass_radius * kg_m, one.angle)
             for one in found.corrections]
    return csv_text(HEADINGS, ((name, *(f"{number:.12g}" for number in numbers)) for name, *numbers in rows))


PAPERS = "A3", "A2"


class PencilError(NamedTuple):
    """The standard deviations of a drawn correction: of mass times radius in the task's units, and of its angle."""

    mass_radius: float
    angle: float


class RotorLengths(Lengths):
    """Lengths of paper, each plan in its own quantity."""

    def scale(self, kind: str, where: int) -> tuple[float, str]:
        """Value of a mm at a step, and its unit."""
        plan, length = self.plan(where), self.scales.length
        measures = {MOMENTS: f"{self.scales.unit}·{length}²", FORCES: f"{self.scales.unit}·{length}"}
        return self.scales.lengths_per_mm(plan), self.scales.unit if kind == "weight" else measures.get(plan, length)

    def _given_quantity(self, quantity: Quantity, laid: PaperDistance, where: int) -> Said:
        """A quantity with its value over its scale; amplitudes have no unit."""
        if quantity.kind != AMPLITUDE:
            return super()._given_quantity(quantity, laid, where)
        per = self.scales.lengths_per_mm(self.plan(where))
        return arrange("{0}: {1} : {2} = {3}", quantity.written, digits(laid.mm * per), digits(per), laid.text)


@dataclass(frozen=True)
class RotorOnPaper:
    """One rotor on one paper: its figures, its words, and what a pencil makes of it."""

    paper: str
    balanced: BalancedRotor
    check: Mapping[str, float]
    pencil: Pencil

    @cached_property
    def figures(self) -> RotorFigures:
        """The figures on their page, which has the title and the sheet of the task."""
        return RotorFigures(self.balanced, PanelPage(self.paper, Scene.without_mechanism(self.balanced.task),
                                                     panels(self.balanced)))

    @property
    def values(self) -> Values:
        return self.balanced.drawing.values

    @property
    def sheet(self) -> PanelSheet:
        """The sheet; of so many masses the steps of a plan are told once for all."""
        figures, program = self.figures, self.values.drawing.program
        lengths = RotorLengths(program, self.values.numbers, lambda index: program.steps[index].panel, figures.scales)
        return PanelSheet(
            figures.page, said("Balancing of a rotor"),
            said("Balancing of a rotor in {0} steps.", len(program) - program.givens), self.values,
            ratio(figures.k_r, self.balanced.task.units.length), figures.figures, figures.scales,
            given=[*self.given_words()], found=[*self.result_words()], lengths=lengths,
            told_once=None if len(self.balanced.masses) > MAX_LETTERED_CORNERS else ())

    @property
    def errors(self) -> list[PencilError]:
        """Errors of the first answer's drawn corrections, in first order."""
        hand = program_hand(self.values.drawing.program, self.values.numbers,
                            lambda step: self.figures.scales.lengths_per_mm(step.panel), self.pencil)
        found = []
        for k, one in enumerate(self.balanced.corrections):
            ways = math.radians(one.angle), math.radians(one.angle + 90)
            along, across = (deviation(hand, partial(self.component, k, way)) for way in ways)
            found.append(PencilError(along, math.degrees(across / one.mass_radius) if one.mass_radius else 0.0))
        return found

    def component(self, k: int, way: float, values: Sequence[Any]) -> Any:
        """Component of correction k in the direction `way`, in radians, from the values of drawn marks."""
        x, y = self.balanced.sides(values)[k]
        return x * math.cos(way) + y * math.sin(way)

    # ---- words -----------------------------------------------------------------------------------------------------

    def given_words(self) -> Iterator[Words]:
        """The masses or the trials, and the planes."""
        task, units = self.balanced.task, self.balanced.task.units
        for effect, letter in zip(self.balanced.effects, PLANES, strict=False):
            yield from self._trial(effect, letter)
        if not self.balanced.effects:
            yield self._masses()
        places = join(digits(float(at), 6) for at in task.rotor.planes)
        yield said("Correction planes at {0} {1}", places, unit(units.length)) if task.rotor.dynamic else said(
            "Correction plane at {0} {1}: static balancing", places, unit(units.length))
        if task.rotor.bearings:
            yield said("Bearings at {0} {1}, ω = {2} rad/s", join(digits(float(at), 6) for at in task.rotor.bearings),
                       unit(units.length), digits(task.rotor.omega))

    def _masses(self) -> list[list[Said | str]]:
        """The masses with what polygons are drawn of."""
        rotor, units = self.balanced.task.rotor, self.balanced.task.units
        mr, mra = f"{units.mass}·{units.length}", f"{units.mass}·{units.length}²"
        rows: list[list[Said | str]] = [["", *(join((name, unit(measure))) for name, measure in (
            ("m", units.mass), ("r", units.length), ("α", "°"), ("a", units.length), ("m·r", mr)))]]
        rows[0] += [join(("m·a·r", unit(mra)))] if rotor.dynamic else []
        for number, mass in enumerate(self.balanced.masses, 1):
            arm = rotor.arm(mass.at) if mass.at is not None else 0
            name = f"{number}" if mass.name == str(number) else f"{number} {mass.name}"
            row: list[Said | str] = [name, *("–" if value is None else digits(float(value)) for value in (
                mass.mass, mass.radius, mass.angle, arm, mass.mass_radius))]
            rows.append(row + ([digits(mass.mass_radius * float(arm))] if rotor.dynamic else []))
        return rows

    def _trial(self, effect: Effect, letter: str) -> Iterator[Said]:
        """Yield the measurements of a trial."""
        trial, units = effect.trial, self.balanced.task.units
        place = said("{0} {1}", digits(float(trial.at or 0), 6), unit(units.length))
        if isinstance(trial, TrialWeights):
            yield said("Trial weights at {0}, radius {1} {2}, the first at {3}°, counter-clockwise:", place,
                       digits(float(trial.mass_radius)), unit(units.length), digits(float(trial.angle)))
            yield join((join(digits(float(weight)) for weight in trial.weights), unit(units.mass)), " ")
            return
        yield said("Trial {0} at {1}: m·r = {2} {3} at {4}°", letter, place, digits(float(trial.mass_radius)),
                   unit(f"{units.mass}·{units.length}"), digits(float(trial.angle)))
        if isinstance(trial, ThreeRuns):
            yield arrange("A_1 = {0}, A_2 = {1}, A_3 = {2}", *(digits(float(one)) for one in trial.amplitudes))
            if trial.fourth:
                yield said("fourth run with the trial mass at {0}°: {1}", digits(float(trial.fourth.angle)),
                           digits(float(trial.fourth.amplitude)))
        elif isinstance(trial, MarkedRuns):
            yield join(arrange("{0} = {1}, {2}°", name, digits(float(one.amplitude)), digits(float(one.angle)))
                       for name, one in (("A_1", trial.first), ("A_2", trial.second)))

    def result_words(self) -> Iterator[Words]:
        """Corrections, disbalances, reactions, what is worth knowing, and the checks."""
        for effect, letter in zip(self.balanced.effects, PLANES, strict=False):
            yield from self._effect(effect, letter)
        for number, answer in enumerate(self.balanced.answers, 1):
            if len(self.balanced.answers) > 1:
                yield said("Answer {0}:", number)
            yield from self._answer(answer, self.errors if number == 1 else ())
        yield from self._disbalance()
        if any(one.mass_radius for one in self.balanced.corrections):
            yield said("±: the standard deviation of what the pencil draws")
        yield from self.reaction_text()
        for note in self.balanced.notes:
            yield arrange("{0:capital}", note)
        yield check_words(self.check)

    def _effect(self, effect: Effect, letter: str) -> Iterator[Said]:
        """Yield the results of a trial."""
        if isinstance(effect.trial, TrialWeights):
            yield said("Half the difference of the largest and the smallest weight: p = {0} {1}", digits(effect.ratio),
                       unit(self.balanced.task.units.mass))
            return
        turns = join(digits(turn) for turn in effect.turns)
        yield said("Trial {0}: A = {1}, A_1/A = {2}, α = {3}°", letter, digits(effect.amplitude), digits(effect.ratio),
                   turns)
        if effect.fourth:
            yield said("the fourth run should give {0}; the other answer {1}", *(digits(one) for one in effect.fourth))

    def _answer(self, answer: Answer, errors: Sequence[PencilError]) -> Iterator[Said]:
        """The corrections of an answer, plane by plane, those of the first with what a pencil makes of them."""
        measure = unit(f"{self.balanced.task.units.mass}·{self.balanced.task.units.length}")
        for one in answer:
            if not one.mass_radius:
                yield arrange("m_{0}·r_{0} = 0", one.letter)
                continue
            size, angle = digits(one.mass_radius, 5), digits(one.angle, 5)
            if errors:
                size = arrange("{0} ± {1}", size, digits(errors[one.index].mass_radius, 2))
                angle = arrange("{0}° ± {1}", angle, digits(errors[one.index].angle, 2))
            yield said("m_{0}·r_{0} = {1} {2} at alpha_{0} = {3}°", one.letter, size, measure, angle)
            yield from self.mass_and_radius_text(one)

    def mass_and_radius_text(self, one: Correction) -> Iterator[Said]:
        """Mass and radius, where one of them is given."""
        mass, radius = self.balanced.mass_and_radius(one)
        if mass is not None and radius is not None:
            units = self.balanced.task.units
            yield arrange("m_{0} = {1} {2}, r_{0} = {3} {4}", one.letter, digits(mass), unit(units.mass),
                          digits(radius), unit(units.length))

    def _disbalance(self) -> Iterator[Said]:
        """The static disbalance, and the moment about plane I."""
        sums, units = self.balanced.sums, self.balanced.task.units
        if sums.static:
            yield said("Static disbalance: {0} {1} at {2}°", digits(sums.static, 5),
                       unit(f"{units.mass}·{units.length}"), digits(direction(*sums.force)))
        if self.balanced.task.rotor.dynamic:
            yield said("Moment about plane I: {0} {1}", digits(sums.dynamic, 5), unit(f"{units.mass}·{units.length}²"))

    def reaction_text(self) -> Iterator[Said]:
        """The bearings' turning reactions, before and after."""
        if self.balanced.task.rotor.bearings:
            force = self.balanced.task.units.force
            sizes = [[abs(one) / float(NEWTONS[force]) for one in bearing_reactions(self.balanced, answer)]
                     for answer in ((), self.balanced.corrections)]
            nothing = ZERO_TOL * max(sizes[0])
            before, after = (join(digits(size if size > nothing else 0.0) for size in part) for part in sizes)
            yield said("Turning reactions of the bearings: {0} {1} before, {2} {1} after", before, unit(force), after)
