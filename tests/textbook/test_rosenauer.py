"""Rosenauer's eight figures: the construction has his marks by his letters, each where his lines meet."""

from __future__ import annotations

import tomllib
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import graphplan as gp

FIGURES = {figure["source"]: figure for figure in tomllib.loads(
    (Path(__file__).parent / "rosenauer.toml").read_text(encoding="utf-8"))["figure"]}
PLANS = {"velocity": "mechanism", "acceleration": "N-plan"}


@cache
def drawn(source: str) -> gp.Construction:
    """The construction of a figure."""
    return gp.construct(gp.load(FIGURES[source]["scene"]), method=FIGURES[source]["method"])


def marks(source: str, plan: str) -> dict[str, complex]:
    """The places of the named points of a plan."""
    drawing = drawn(source)
    return {step.name: complex(*drawing.values[step.index]) for step in drawing.drawn.steps
            if step.name and step.op.gives == "point" and step.panel.whole == plan}


def rows(figure: dict[str, Any], kind: str) -> list[str]:
    """The marks of a figure, after those of the one that it is like."""
    return [*(rows(FIGURES[figure["as"]], kind) if "as" in figure else ()), *figure.get(kind, ())]


def split(text: str, names: dict[str, complex]) -> tuple[complex, complex]:
    """Two marks that are written one after the other."""
    one, other = next((text[:k], text[k:]) for k in range(1, len(text)) if {text[:k], text[k:]} <= {*names})
    return names[one], names[other]


def line(text: str, here: dict[str, complex], mechanism: dict[str, complex]) -> tuple[complex, complex]:
    """A point of a line and its direction."""
    for sign, turn in ("|", 1), ("+", 1j):
        if sign in text:
            through, side = text.split(sign)
            P, R = split(side, mechanism)
            return here[through], (R - P) * turn
    P, R = split(text, here)
    return P, R - P


@pytest.mark.parametrize("kind", PLANS)
@pytest.mark.parametrize("source", FIGURES)
def test_the_marks_are_his(source: str, kind: str) -> None:
    """Each of his marks is there by his letter, where his two lines meet."""
    here, mechanism = marks(source, PLANS[kind]), marks(source, "mechanism")
    size = max(abs(place) for place in here.values())
    for row in rows(FIGURES[source], kind):
        name, *lines = row.split()
        for text in lines:
            P, along = line(text, here, mechanism)
            assert abs(((here[name] - P) * along.conjugate()).imag) <= 1e-9 * size * abs(along), row


@pytest.mark.parametrize("source", FIGURES)
def test_his_methods_are_told(source: str) -> None:
    """Velocities are said to be found by auxiliary points, accelerations by trial figures."""
    method = drawn(source).method
    assert all(name.startswith("auxiliary points") for name in method["velocity"])
    assert method["acceleration"] == ["trial figure"]
