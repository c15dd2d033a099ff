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
    found: Given = {}
    for name, steps in changing_steps(program, scene).items():
        for step, parts in steps if name in loads else ():
            value = loads[name]
            numbers = [value.real, value.imag] if len(parts) == 2 else [value * float(metre(scene.units))]
            found[step] = {part: number * float(phi) for part, number in zip(parts, numbers, strict=True)}
    return found


def changing_steps(program: Program, scene: Scene) -> dict[str, list[tuple[int, tuple[str, ...]]]]:
    """The steps that lay off each load that changes, by its letter, with the parameters that are its components."""
    known = changing_loads(scene.loads)
    if not known:
        return {}
    found: dict[str, list[tuple[int, tuple[str, ...]]]] = {name: [] for name in known}
    for step in program.steps:
        if step.quantity and step.quantity.changing:
            force = isinstance(known[step.quantity.written], Force)
            found[step.quantity.written].append((step.index, ("dx", "dy") if force else ("moment",)))
    return found
