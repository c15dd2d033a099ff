"""Named machines: the construction, the solver and the closure say the same, in whatever order a machine is written."""

from __future__ import annotations

from importlib import import_module

import pytest
from closure import Closure, Rates
from machine import MACHINES, Machine, Points

import graphplan as gp
from graphplan.kernel.numbers.floats import Floats
from graphplan.mechanism.scene import parse

FAMILIES = ("fourbars", "sixbars", "guided", "engines", "cylinders", "platforms")
for family in FAMILIES:
    import_module(family)

POSES = [pytest.param(m, k, id=f"{m}-{k}") for m in MACHINES for k in (0, 1)]
KINDS = {"velocity": 1, "omega": 1, "slide velocity": 1, "acceleration": 2, "alpha": 2, "slide acceleration": 2}
EPSILON = 2.0**-52


def pose(machine: Machine, k: int) -> Points:
    """One of the poses that a machine is looked at in."""
    if k < len(machine.positions):
        return machine.pose(k)
    return Closure(machine, machine.pose(0)).moved(machine.after)


def constructed(scene: gp.Scene, plan: str) -> Rates:
    """Everything that the construction gives."""
    results = gp.construct(scene, plan=plan).read(Floats())
    return {(kind, name): complex(*value) if isinstance(value, tuple) else value
            for kind, named in results.items() for name, value in named.items()}


def solved(scene: gp.Scene) -> tuple[Rates, float]:
    """Everything that the solver says, and the condition of its equations."""
    rates = gp.analytic.solve(scene)
    found = {(kind, name): complex(*value) if isinstance(value, tuple) else value
             for kind in KINDS for name, value in getattr(rates, kind.replace(" ", "_")).items()}
    return found, rates.condition


def gap(one: Rates, other: Rates, size: float) -> float:
    """The largest difference in what both say, beside the speeds or the accelerations that the machine is made of."""
    speed = max(abs(v) * (size if kind == "omega" else 1) for (kind, _), v in other.items() if KINDS[kind] == 1)
    change = max(abs(v) * (size if kind == "alpha" else 1) for (kind, _), v in other.items() if KINDS[kind] == 2)
    scale = {1: speed, 2: max(change, speed * speed / size)}
    return max(abs(value - other[kind, name]) * (size if kind in ("omega", "alpha") else 1) / scale[KINDS[kind]]
               for (kind, name), value in one.items())


@pytest.mark.parametrize(("machine", "k"), POSES)
def test_three_opinions_are_one(machine: Machine, k: int) -> None:
    """Orthogonal and polar plans, the solver, and the machine itself a moment later, agree."""
    closure = Closure(machine, pose(machine, k))
    scene = parse(machine.scene(pose(machine, k)), str(machine))
    truth, condition = solved(scene)
    tolerance = 64 * EPSILON * condition
    assert gap(closure.rates(), truth, closure.size) < 1e3 * tolerance
    for plan in ("orthogonal", "polar"):
        ours = constructed(scene, plan)
        assert {name for kind, name in ours if kind == "acceleration"} == set(scene.find.acceleration)
        assert gap(ours, truth, closure.size) < tolerance


@pytest.mark.parametrize("machine", MACHINES, ids=str)
def test_the_order_of_writing_means_nothing(machine: Machine) -> None:
    """Links, points, slides and drives in any order give the same."""
    at = pose(machine, 0)
    size = Closure(machine, at).size
    first = parse(machine.scene(at), str(machine))
    truth, condition = solved(first)
    for order, plan in ((1, ""), (2, "polar")):
        ours = constructed(parse(machine.scene(at, order), str(machine)), plan)
        assert gap(ours, truth, size) < 64 * EPSILON * condition
