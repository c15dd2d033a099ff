"""Named machines: the construction, the solver and the closure say the same, in whatever order a machine is written."""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest
from closure import Closure, Rates
from machine import Machine, Points, family

import graphplan as gp
from graphplan.kernel.numbers import Floats, Fractions
from graphplan.solver import solve as solve_rates

FAMILIES = ("fourbars", "sixbars", "guided", "engines", "cylinders", "platforms")
MACHINES = [machine for name in FAMILIES for machine in family(name)]
REDUNDANT = family("redundant")
LENGTHS = {"velocity": 1, "slide velocity": 1, "acceleration": 2, "slide acceleration": 2}  # how often derived
ANGLES = {"omega": 1, "alpha": 2}
LATER = 0.15  # seconds from the first pose to the second, where a table gives but one
ROUNDING = 64 * 2.0**-52
TAYLOR = 1e-9  # what sixteen poses on a circle leave of the accelerations, at the most


def poses(machines: list[Machine], numbers: tuple[int, ...]) -> list[Any]:
    """The machines in some of their poses."""
    return [pytest.param(m, k, id=f"{m}, pose {k}") for m in machines for k in numbers]


@cache
def posed(machine: Machine, k: int) -> Closure:
    """A machine in one of the poses in which it is looked at."""
    if k < len(machine.at):
        return Closure(machine, machine.pose(k))
    return Closure(machine, posed(machine, 0).moved(LATER))


def read(machine: Machine, at: Points, order: int = 0) -> gp.Scene:
    """The scene in a pose, written in some order."""
    return gp.parse(machine.scene(at, order), machine.name)


def flat(results: dict[str, dict[str, Any]]) -> Rates:
    """Every number by its kind and name; vectors as complex numbers."""
    return {(kind, name): complex(*value) if isinstance(value, tuple) else value
            for kind, named in results.items() for name, value in named.items()}


def constructed(scene: gp.Scene, plan: str) -> Rates:
    """Everything that the construction gives."""
    return flat(gp.construct(scene, plan=plan).read(Floats()))


@cache
def solved(machine: Machine, k: int) -> tuple[Rates, float]:
    """Everything that the solver says of a machine in a pose, and the condition of its equations."""
    rates = solve_rates(read(machine, posed(machine, k).where))
    return flat({kind: getattr(rates, kind.replace(" ", "_")) for kind in LENGTHS | ANGLES}), rates.condition


def gap(one: Rates, other: Rates, size: float) -> float:
    """The largest difference, beside the largest speed or acceleration that the machine's motion is made of."""
    def length(kind: str, value: complex) -> float:
        return abs(value) * (size if kind in ANGLES else 1)

    order = LENGTHS | ANGLES
    speed, change = (max(length(kind, v) for (kind, _), v in other.items() if order[kind] == n) for n in (1, 2))
    scale = {1: speed, 2: max(change, speed * speed / size)}
    return max(length(kind, value - other[kind, name]) / scale[order[kind]] for (kind, name), value in one.items())


@pytest.mark.parametrize(("machine", "k"), poses(MACHINES, (0, 1)) + poses(REDUNDANT, (0,)))
def test_three_opinions_are_one(machine: Machine, k: int) -> None:
    """Orthogonal and polar plans, the solver, and the machine itself a moment later, agree; in the first pose, which is
    drawn in other orders too, on one plan."""
    closure, (truth, condition) = posed(machine, k), solved(machine, k)
    assert gap(closure.rates(), truth, closure.size) < TAYLOR
    for plan in ("orthogonal", "polar") if k else ("orthogonal",):
        ours = constructed(read(machine, closure.where), plan)
        assert {("acceleration", point) for point in set(closure.where) - {*machine.links["frame"]}} <= {*ours}
        assert gap(ours, truth, closure.size) < ROUNDING * condition


@pytest.mark.parametrize(("machine", "k"), poses(MACHINES + REDUNDANT, (0,)))
def test_the_order_of_writing_means_nothing(machine: Machine, k: int) -> None:
    """Points, links, slides and drives in any order give the same."""
    closure, (truth, condition) = posed(machine, k), solved(machine, k)
    for order, plan in ((1, "orthogonal"), (2, "polar")):
        ours = constructed(read(machine, closure.where, order), plan)
        assert gap(ours, truth, closure.size) < ROUNDING * condition


@pytest.mark.parametrize(("machine", "k"), poses([m for m in MACHINES + REDUNDANT if m.at == ([],)], (0,)))
def test_round_poses_agree_exactly(machine: Machine, k: int) -> None:
    """Where the pose is of round numbers, construction and solver are the same fractions, in any order of writing."""
    exact = solve_rates(read(machine, machine.pose(k)), exact=True)
    for order in (0, 1, 2):
        for kind, named in gp.construct(read(machine, machine.pose(k), order)).read(Fractions()).items():
            truth = getattr(exact, kind.replace(" ", "_"))
            assert named == {name: truth[name] for name in named}
