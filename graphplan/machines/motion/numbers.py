"""A motion as numbers: speed, time and acceleration over the travel, and what they come to.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from graphplan.machines.motion.drawing import MotionDrawing
from graphplan.machines.motion.runs import MachineMotion
from graphplan.machines.motion.strips import baranov, by_energy, times
from graphplan.machines.motion.true_motion import Place
from graphplan.output.tables import TableColumn, column_csv, plain_unit


def numbers(found: MachineMotion, drawing: MotionDrawing | None, check: dict[str, float], positions: int) -> dict[str,
                                                                                                                  Any]:
    """All of it, plain data for JSON: travel in degrees and rates in rad/s, of a drive that slides in scene lengths;
    moments in N m (forces in N), energies in J; null where the machine does not get."""
    motion, machine = found.motion, found.machine
    rows, measures = columns(found, positions), quantities(found)
    data: dict[str, Any] = {"title": found.scene.title, "units": {name: plain_unit(measures[name][1]) for name in rows}}
    data |= {name: json_numbers(values) for name, values in rows.items()}
    data |= {"stop": None if motion.stop is None else place_numbers(found, motion.stop), "speeds": speed_numbers(found)}
    data["steady"] = found.steady is motion
    if machine.wheel:
        data["flywheel"] = {"inertia": machine.wheel}
    if machine.closing:
        data["closing_moment"] = machine.closing
    if found.nominal is not None:
        data["nominal_omega"] = found.nominal / machine.pace
    if found.run_up is not None:
        data["run_up"] = {**place_numbers(found, found.run_up.place), "turns": found.run_up.turns}
    data["drawn"] = None if drawing is None else drawn_numbers(found, drawing)
    data["strips"] = strip_numbers(found, positions)
    return data | {"check": check}


def quantities(found: MachineMotion) -> dict[str, tuple[str, str]]:
    """Letters and units of what changes over the motion: of a drive that slides it is forces and masses."""
    slides, length = found.scene.drives[0].slides, found.scene.units.length
    s, v, a, F, m = ("s", "v", "a", "F", "m") if slides else ("phi", "omega", "epsilon", "M", "I")
    travel, angle, moment, inertia = (length, length, "N", "kg") if slides else ("°", "rad", "N m", "kg m²")
    return {"travel": (s, travel), "omega": (v, f"{angle}/s"), "time": ("t", "s"), "acceleration": (a, f"{angle}/s²"),
            "energy": ("E", "J"), "moment": (F, moment), "inertia": (m, inertia), "slowness": (f"1/{v}", f"s/{angle}")}


def columns(found: MachineMotion, positions: int) -> dict[str, Any]:
    """Travel, speed, time, acceleration, energy, moment of all loads and inertia at the ends of so many parts."""
    motion, machine = found.motion, found.machine
    travel = np.linspace(motion.start, motion.end, positions + 1)
    state = motion.state_at(travel)
    lost = np.where(np.isnan(state.omega), np.nan, 0.0)
    return {"travel": travel / machine.degree, "omega": state.omega / machine.pace, "time": state.time,
            "acceleration": state.acceleration / machine.pace, "energy": state.energy,
            "moment": machine.moment(travel, state.omega) + lost, "inertia": machine.inertia(travel) + lost}


def table(found: MachineMotion, positions: int) -> str:
    """The same as comma-separated text: a heading, then a line for each position."""
    measures = quantities(found)
    return column_csv(TableColumn(name, *measures[name], values) for name, values in columns(found, positions).items())


def drawn_numbers(found: MachineMotion, drawing: MotionDrawing) -> dict[str, Any]:
    """What the drawing says at its divisions, and how far it is off at most, as parts of the largest value."""
    machine = found.machine
    return {"travel": json_numbers(drawing.travel / machine.degree), "energy": json_numbers(drawing.read("energy")),
            "omega": json_numbers(drawing.read("omega") / machine.pace), "time": json_numbers(drawing.read("time")),
            "error": drawing.errors}


def strip_numbers(found: MachineMotion, positions: int) -> dict[str, Any]:
    """What other forms come to at the end of as many strips, beside the true motion there."""
    motion, machine = found.motion, found.machine
    travel = np.linspace(motion.start, motion.last_travel, positions + 1)[:None if motion.stop is None else -1]
    exact = motion.state_at(travel)
    forms = {"true": exact.omega}
    if len(travel) > 3:
        forms |= {"euler": by_energy(machine, travel, float(exact.omega[0])),
                  "baranov": baranov(machine, travel, float(exact.omega[0]))}
    data = {name: {"omega": json_number(omega[-1] / machine.pace), "time": json_number(times(travel, omega)[-1])}
            for name, omega in forms.items() if name != "true"}
    return {"travel": float(travel[-1] / machine.degree),
            "true": {"omega": json_number(exact.omega[-1] / machine.pace), "time": json_number(exact.time[-1])}, **data}


def speed_numbers(found: MachineMotion) -> dict[str, Any]:
    """The largest and the least speed, where they are, and the means."""
    motion, pace = found.motion, found.machine.pace
    least, most = motion.extremes
    means = motion.means
    return {"max": place_numbers(found, most), "min": place_numbers(found, least),
            "arithmetic_mean": means.arithmetic / pace,
            "mean_over_travel": means.planimetric / pace, "mean_over_time": json_number(means.true / pace),
            "unevenness": means.unevenness}


def place_numbers(found: MachineMotion, place: Place) -> dict[str, float | None]:
    """A travel with the speed and the time there."""
    return {"travel": float(place.travel / found.machine.degree), "omega": float(place.omega / found.machine.pace),
            "time": json_number(place.time)}


def json_numbers(values: Any) -> list[float | None]:
    return [json_number(value) for value in values]


def json_number(value: float) -> float | None:
    return float(value) + 0.0 if math.isfinite(value) else None
