"""Loads that change: what the steps that lay them off are given in another pose."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from graphplan.kernel.program import Program
from graphplan.mechanism.model import Force, Number, Scene
from graphplan.mechanism.order import changing_loads
from graphplan.mechanism.units import metre

Given = dict[str | int, dict[str, Any]]
"""Numbers of steps, by their places in the program."""


def given_loads(program: Program, scene: Scene, phi: Number, loads: Mapping[str, Any]) -> Given:
    """What the steps of a program are given where the loads of a scene, by their letters, have these values.

    Forces are complex numbers or arrays of them, moments real ones; `phi` is how long a unit of force is drawn.
    """
    def components(value: Any, name: str) -> dict[str, Any]:
        parts = drawn_components(scene, phi, name)
        numbers = [value.real, value.imag] if len(parts) == 2 else [value]
        return {part: number * times for (part, times), number in zip(parts.items(), numbers, strict=True)}

    return {step: components(loads[name], name) for step, name in changing_steps(program).items() if name in loads}


def changing_steps(program: Program) -> dict[int, str]:
    """The steps that lay off loads that change, each with the load's letter."""
    return {step.index: step.quantity.written for step in program.steps if step.quantity and step.quantity.changing}


def drawn_components(scene: Scene, phi: Number, name: str) -> dict[str, float]:
    """The parameters that lay off a load that changes, each with how long a unit of its component is drawn."""
    if isinstance(changing_loads(scene.loads)[name], Force):
        return {"dx": float(phi), "dy": float(phi)}
    return {"moment": float(phi * metre(scene.units))}
