"""Claims are worth something only if they catch wrong rules: faults are sown in the table, and each is caught."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from random import Random
from typing import Any

import pytest
from each import each
from figures import LENGTHS, NAMES, drawn, figure

from graphplan.kernel import TABLE
from graphplan.kernel.claims import broken_claims
from graphplan.kernel.numbers import Floats

Rule = Callable[..., Any]

FIGURES = 12


def turned(rule: Rule, **swap: dict[str, str]) -> Rule:
    """The rule on the other branch."""
    return lambda d, *args, **params: rule(
        d, *args, **{name: swap[name][value] if name in swap else value for name, value in params.items()})


def ordered(*places: int) -> Callable[[Rule], Rule]:
    """The rule with operands swapped."""
    return lambda rule: lambda d, *args, **params: rule(d, *(args[k] for k in places), **params)


def doubled(k: int) -> Callable[[Rule], Rule]:
    """The step from an operand to the drawn point, twice as long."""
    return lambda rule: lambda d, *args, **params: tuple(
        2 * p - q for p, q in zip(rule(d, *args, **params), args[k], strict=True))


def reflected(k: int) -> Callable[[Rule], Rule]:
    """The step from an operand to the drawn point, the other way."""
    return lambda rule: lambda d, *args, **params: tuple(
        2 * q - p for p, q in zip(rule(d, *args, **params), args[k], strict=True))


def backwards(rule: Rule) -> Rule:
    """The same line, running the other way."""
    return lambda d, *args, **params: tuple(-number for number in rule(d, *args, **params))


def displaced(k: int) -> Callable[[Rule], Rule]:
    """One number of the value a thousandth off."""
    return lambda rule: lambda d, *args, **params: tuple(
        1.001 * p + 0.001 if place == k else p for place, p in enumerate(rule(d, *args, **params)))


OTHER = {"side": {"left": "right", "right": "left"}, "way": {"on": "back", "back": "on"},
         "turn": {"parallel": "perpendicular", "perpendicular": "parallel"}}

FAULTS: list[tuple[str, str, Callable[[Rule], Rule]]] = [
    ("line", "runs from the second point to the first", backwards),
    ("parallel", "runs against the line", backwards),
    ("perpendicular", "turned clockwise", backwards),
    ("bisector", "turned clockwise", backwards),
    ("guide", "direction mirrored", lambda rule: lambda d, P, *, dx, dy: rule(d, P, dx=dx, dy=-dy)),
    ("meet", "sign of x", lambda rule: lambda d, *args: (-rule(d, *args)[0], rule(d, *args)[1])),
    ("opening", "not squared", lambda rule: lambda d, *args: (rule(d, *args)[0] ** 0.5,)),
    ("circle", "opening taken for a diameter", lambda rule: lambda d, C, o: (*C, o[0] / 4)),
    ("circles_meet", "wrong side", lambda rule: turned(rule, side=OTHER["side"])),
    ("circles_meet", "circles swapped", ordered(1, 0)),
    ("line_meets_circle", "wrong way", lambda rule: turned(rule, way=OTHER["way"])),
    ("step_off", "vector reversed", ordered(1, 0, 2)),
    ("step_across", "turned clockwise", reflected(2)),
    ("lay_along", "backwards", reflected(1)),
    ("lay_off", "twice", doubled(0)),
    ("pick", "behind", lambda rule: lambda d, *args, ratio: rule(d, *args, ratio=-ratio)),
    ("midpoint", "laid off whole", doubled(0)),
    ("foot", "mirror image", doubled(1)),
    ("transfer", "vector reversed", ordered(1, 0, 2)),
    ("transfer", "laid off from its own beginning", ordered(0, 1, 0)),
    ("quarter", "turned clockwise", reflected(2)),
    ("shift", "shifted back", ordered(0, 2, 1)),
    ("divide", "from the other end", ordered(0, 1, 2, 4, 3)),
    ("divide", "part and whole swapped", ordered(0, 2, 1, 3, 4)),
    ("similar", "wrong turn", lambda rule: turned(rule, turn=OTHER["turn"])),
    ("similar", "images swapped", ordered(0, 1, 2, 4, 3)),
    ("similar", "mirrored", reflected(3)),
    ("triangle", "images swapped", ordered(0, 1, 2, 4, 3)),
    ("triangle", "mirrored", reflected(3)),
    ("triangle", "another corner", ordered(1, 2, 0, 3, 4)),
    ("carry", "wrong turn", lambda rule: turned(rule, turn=OTHER["turn"])),
    ("carry", "loci swapped", ordered(0, 3, 2, 1, 4)),
    ("carry", "sign of the elimination", lambda rule: lambda d, A, alpha, B, beta, C, *, turn: rule(
        d, A, alpha, (2 * C[0] - B[0], 2 * C[1] - B[1]), beta, C, turn=turn)),
    ("settle", "wrong turn", lambda rule: turned(rule, turn=OTHER["turn"])),
    ("settle", "the other point's image", ordered(0, 1, 4, 5, 2, 3)),
    ("settle", "mirrored", reflected(1)),
    ("normal", "towards k", reflected(4)),
    ("normal", "velocity not squared", lambda rule: lambda d, K, A, m, w, k: tuple(
        q + (p - q) / ((w[0] - m[0]) ** 2 + (w[1] - m[1]) ** 2) ** 0.5
        for p, q in zip(rule(d, K, A, m, w, k), k, strict=True))),
    ("computed_normal", "towards k", reflected(4)),
    ("computed_normal", "velocity not squared", lambda rule: lambda d, K, A, m, w, k: tuple(
        q + (p - q) / ((w[0] - m[0]) ** 2 + (w[1] - m[1]) ** 2) ** 0.5
        for p, q in zip(rule(d, K, A, m, w, k), k, strict=True))),
    ("coriolis", "sign", reflected(4)),
    ("coriolis", "laid off once", lambda rule: lambda d, *args: tuple(
        (p + q) / 2 for p, q in zip(rule(d, *args), args[4], strict=True))),
    ("coriolis", "turning and sliding swapped", ordered(0, 1, 3, 2, 4)),
    ("third", "to the other side", reflected(0)),
    ("third", "from the other end", ordered(1, 0, 2, 3)),
    ("curved", "pole and inflection pole swapped", ordered(2, 1, 0)),
    ("curved", "to the other side", reflected(1)),
    ("conjugate", "point and centre swapped", ordered(0, 2, 1, 3, 4, 5)),
    ("conjugate", "to the other side", reflected(5)),
    ("false_position", "errors added", lambda rule: lambda d, A1, A2, Z1, l1, Z2, l2: rule(
        d, A1, A2, Z1, l1, (2 * Z1[0] - Z2[0], 2 * Z1[1] - Z2[1]), l2)),
    ("false_position", "from the second trial", ordered(1, 0, 2, 3, 4, 5)),
    ("balance", "sign of the moment", reflected(5)),
    ("balance", "about the other point", ordered(1, 0, 2, 3, 4, 5)),
    ("couple", "the wrong way round", reflected(2)),
    ("inertia_pair", "with the turning", reflected(4)),
    ("resultant", "to the other side", reflected(0)),
    ("touch", "with the turning", reflected(0)),
    ("lean", "with the sliding", lambda rule: lambda d, l, B, w, p, q, *, coefficient: rule(
        d, l, B, w, p, q, coefficient=-coefficient)),
    ("pressure_line", "leans to the other wheel", lambda rule: lambda d, P, B, p, q, *, coefficient: rule(
        d, P, B, p, q, coefficient=-coefficient)),
    ("pull_line", "pushes", lambda rule: lambda d, P, B, p, q, *, coefficient: rule(
        d, P, B, p, q, coefficient=-coefficient)),
    ("towards", "parallel to the first line", lambda rule: lambda d, y, z, X: (y[0], y[1], -y[0] * X[0] - y[1] * X[1])),
    ("weigh", "sign of the moment", reflected(6)),
    ("link_length", "not squared", lambda rule: lambda d, **params: (rule(d, **params)[0] ** 0.5,)),
    ("inclined", "runs the other way", backwards),
    ("crank", "twice as long", doubled(0)),
    ("corner", "mirrored", lambda rule: lambda d, P, Q, **given: rule(d, P, Q, **given | {"dy": -given["dy"]})),
    ("corner", "from the other point", ordered(1, 0)),
    ("set_off", "backwards", reflected(1)),
    ("sight", "wrong way", lambda rule: turned(rule, way=OTHER["way"])),
    ("sight", "runs the other way", backwards),
    ("curve_meets_circle", "as the plans come the other way", ordered(3, 2, 1, 0, 4)),
    ("curves_meet", "off it", doubled(0)),
    *((name, "off it", doubled(0)) for name in ("close_on_two", "close_on_three", "close_on_four")),
]


def complaints(name: str) -> list[str]:
    """What the claims say of a fixed set of figures."""
    r, found = Random(name), []
    for _ in range(FIGURES):
        program = figure(name, r)
        values = drawn(program, Floats())
        if values is not None:
            found += list(broken_claims(program, values))
    return found


def sow(patch: pytest.MonkeyPatch, name: str, fault: Callable[[Rule], Rule]) -> None:
    """Put the faulty rule in the table."""
    patch.setitem(TABLE, name, replace(TABLE[name], rule=fault(TABLE[name].rule)))


@each("name", NAMES)
def test_no_fault_no_complaint(name: str) -> None:
    """Without a fault the claims have nothing to say."""
    assert complaints(name) == []


@each(("name", "what", "fault"), FAULTS, ids=lambda fault: f"{fault[0]}: {fault[1]}")
def test_fault_is_caught(name: str, what: str, fault: Callable[[Rule], Rule], monkeypatch: pytest.MonkeyPatch) -> None:
    """A fault sown in a rule is caught by what the primitive claims, on a few figures."""
    sow(monkeypatch, name, fault)
    assert any(f" = {name}(" in complaint for complaint in complaints(name))


@each("name", NAMES)
def test_displacement_is_caught(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever a primitive draws, a little beside it is wrong: each number of its value matters."""
    for place in range(LENGTHS[TABLE[name].gives]):
        with monkeypatch.context() as patch:
            sow(patch, name, displaced(place))
            assert complaints(name), f"number {place}"


def test_every_primitive_is_tried() -> None:
    """Faults are sown in every primitive that has a choice to get wrong."""
    plain = {"given", "begin", "pole", "radius"}
    assert {name for name, _, _ in FAULTS} == set(NAMES) - plain
