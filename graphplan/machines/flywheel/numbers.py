"""A flywheel as numbers: the machine reduced over its cycle, the wheel, other methods, and what a drawing gives.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from graphplan.machines.flywheel.result import NEGLECTS_NOTHING, FlywheelResult
from graphplan.machines.flywheel.steady_cycle import FlywheelSpeeds, Tangency
from graphplan.machines.reduced.friction import M_F
from graphplan.output.tables import TableColumn, column_csv

MOMENT, INERTIA, RATE = "N m", "kg m²", "rad/s"  # units


def numbers(result: FlywheelResult, pencil_error: float) -> dict[str, Any]:
    """All of it, plain data for JSON: kg m^2, N m, J and rad/s; travels in degrees, in the sense of motion.

    `pencil_error` is the standard deviation of the drawn flywheel, or of the drawn unevenness with one that is given.
    """
    cycle = result.cycle
    (least_at, least), (most_at, most) = cycle.energy.extremes(cycle.closed_moment)
    pairs = {name: np.stack([result.travels_in_degrees, row + 0.0], 1).tolist() for name, row in result.plans.items()}
    found: dict[str, Any] = {
        "title": result.scene.title,
        "units": {"travel": "deg", "inertia": "kg m2", "moment": "N m", "energy": "J", "speed": "rad/s"},
        "speed": cycle.speed, "unevenness": result.unevenness,
        "reduced_inertia": pairs["inertia"], "reduced_moment": pairs["moment"],
        "closing_moment": cycle.closing, "load_factor": cycle.factor,
        "work": {name: cycle.work(name) for name in cycle.loads} | {"closing": cycle.closing * cycle.span},
        "energy": pairs["energy"], "omega": pairs["omega"],
        "energy_extremes": {"least_at": in_degrees(result, least_at), "most_at": in_degrees(result, most_at),
                            "range": most - least},
        "flywheel": wheel_numbers(result, pencil_error),
        "without_flywheel": {"exact": speed_numbers(result, result.without_flywheel),
                             "by_mean_energy": speed_numbers(result, result.by_mean_energy)},
        "methods": method_numbers(result),
        "drawing": drawing_numbers(result),
        "check": dict(result.check),
    }
    if result.reduction.friction:
        found["friction"] = friction_numbers(result)
    return found


def friction_numbers(result: FlywheelResult) -> dict[str, Any]:
    """Numbers of friction: its moment by travel, the work lost over the cycle, in all and by pair, the share of the
    given work, and so the mean efficiency."""
    losses, moment = result.reduction.losses, result.reduction.reduce_at(result.travels).by[M_F]
    return {"moment": np.stack([result.travels_in_degrees, moment + 0.0], 1).tolist(), "lost": losses.lost,
            "given": losses.given, "efficiency": losses.efficiency, "pairs": losses.pairs}


def columns(result: FlywheelResult) -> dict[str, TableColumn]:
    """The travel and what there is at each plan; on sheets M is the reduced moment, before the cycle is closed."""
    plans = {"inertia": ("I", "I", INERTIA), "moment": ("M_r", "M", MOMENT), "whole": ("M", "M", MOMENT),
             "energy": ("E", "E", "J"), "omega": ("omega", "omega", RATE)}
    return {"travel": TableColumn("travel", "phi", "°", result.travels_in_degrees),
            **{name: TableColumn(*column, result.plans[name]) for name, column in plans.items()}}


def table(result: FlywheelResult) -> str:
    """Comma-separated text: a heading, then a line for each plan."""
    return column_csv(columns(result).values())


def method_numbers(result: FlywheelResult) -> dict[str, Any]:
    """Results of each method, by its name: Wittenbauer's first."""
    found: dict[str, Any] = {"wittenbauer": {"inertia": result.wheel.inertia, "stored": result.wheel.intercept(),
                                             "neglects": str(NEGLECTS_NOTHING)}}
    for method in result.methods:
        figures = {key: plain_figure(result, key, value) for key, value in method.figures.items()}
        found[method.name] = {"inertia": method.inertia, "stored": method.stored, "neglects": str(method.neglects),
                              **figures}
    return found


def wheel_numbers(result: FlywheelResult, pencil_error: float) -> dict[str, Any]:
    """The wheel, the tangents of the energy-mass diagram, and what the drawing gives."""
    wheel = result.wheel
    return {
        "inertia": wheel.inertia, **(speed_numbers(result, wheel) or {}),
        "intercept": wheel.intercept(), "cuts": [wheel.upper.cut, wheel.lower.cut],
        "slopes": [wheel.upper.slope, wheel.lower.slope],
        "touching": [_touch(wheel.upper), _touch(wheel.lower)],
        "origin": {"inertia": -wheel.inertia, "energy": wheel.origin},
        "drawn": result.drawn_result, "drawn_of": "unevenness" if result.given else "inertia",
        "drawn_error": result.strip_error + 2 * pencil_error,
    }


def _touch(touch: Tangency) -> list[float]:
    return [touch.inertia, touch.energy]


def speed_numbers(result: FlywheelResult, wheel: FlywheelSpeeds | None) -> dict[str, float] | None:
    """The speeds with a wheel; None if the machine does not turn."""
    if wheel is None:
        return None
    return {"omega_max": wheel.omega_max, "omega_min": wheel.omega_min,
            "omega_max_at": in_degrees(result, wheel.upper.travel),
            "omega_min_at": in_degrees(result, wheel.lower.travel),
            "unevenness": wheel.unevenness}


def drawing_numbers(result: FlywheelResult) -> dict[str, Any]:
    """Numbers of the drawing: scales for one mm, the pole in mm, the axis on which the tangents are cut, and the
    steps."""
    drawing, program = result.drawing, result.drawing.values.drawing.program
    moment, energy, inertia = (drawing.frames[name] for name in ("moment", "energy", "inertia"))
    return {"scales": {"travel": moment.x.unit, "moment": moment.y.unit, "energy": energy.y.unit,
                       "inertia": inertia.x.unit},
            "pole_distance": drawing.pole, "axis": drawing.axis, "closing_moment": -drawing.mean,
            "omega_max_at": drawing.touching("upper"), "omega_min_at": drawing.touching("lower"),
            "positions": result.positions, "steps": len(program) - program.givens}


def in_degrees(result: FlywheelResult, travel: float) -> float:
    return float(result.in_degrees(travel)) + 0.0


def plain_figure(result: FlywheelResult, key: str, value: Any) -> Any:
    """A figure of a method, its travels as they are told."""
    if key == "areas":
        return [[in_degrees(result, area.start), in_degrees(result, area.end), area.work] for area in value]
    if key.endswith("_at"):
        first, last = result.cycle.ends
        return in_degrees(result, first + (value - first) % (last - first))
    return [in_degrees(result, at) for at in value] if isinstance(value, tuple) else value
