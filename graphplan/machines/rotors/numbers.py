"""A balanced rotor as numbers: corrections, disbalances, what trials found, reactions, steps, and what is checked.
"""

from __future__ import annotations

import math
from typing import Any

from graphplan.machines.rotors.check import bearing_reactions
from graphplan.machines.rotors.polygons import Correction
from graphplan.machines.rotors.rotor import direction
from graphplan.machines.rotors.rotor_balance import Answer, BalancedRotor
from graphplan.machines.rotors.sheet import RotorSheet
from graphplan.mechanism.units import KILOGRAMS
from graphplan.output.tables import csv_text

HEADINGS = "what", "place", "mass_radius [kg m]", "angle [deg]"


def numbers(sheet: RotorSheet) -> dict[str, Any]:
    """All of it, plain data for JSON: kg, m and N, angles in degrees from 0 to 360; places along the axis as the task
    has them. `answers` are there where trials leave a choice, of which `corrections` is the first; `drawn_error` are
    two standard deviations of what a pencil draws of these; steps speak lengths of paper of this sheet."""
    found = sheet.balanced
    task, program, sums = found.task, found.drawing.values.drawing.program, found.sums
    kg_m, metres = float(task.kg_m), float(task.metres)
    drawn = [{"mass_radius": 2 * error.mass_radius * kg_m, "angle": 2 * error.angle} for error in sheet.errors]
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
        "check": dict(sheet.check)}


def answer_numbers(found: BalancedRotor, answer: Answer) -> list[dict[str, Any]]:
    """The corrections of one answer, with the masses or radii that follow."""
    return [{"plane": plain_number(one.at), "index": one.index, "mass_radius": one.mass_radius * float(found.task.kg_m),
             "angle": one.angle, **mass_and_radius_numbers(found, one)} for one in answer]


def plain_number(number: Any) -> float | int:
    """A number as it is written, without a decimal point where it has none."""
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
