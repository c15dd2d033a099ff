"""Kinytskyi's lambda mechanism over its cycle: forces, driving moment and efficiency by his formulas, written apart.

His (4) to (11): the force P4 of bar 4 from the moment M5 on the driven rocker and the transmission angle mu at E; P3
and P2 of the coupler by sines, as three forces meet in one point K; the moment of the crank from the powers, with f r R
|omega| of each journal; and the efficiency, the moment without friction by that with it. Positions and rates are his
mechanism's by trigonometry, with nothing of graphplan.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
import pytest
from face import ran

POSES = 36
ROUNDS = 4  # of friction, after which the forces stand to the tenth digit also where it is large
OMEGA, LOAD, INERTIA = 10.0, 20.0, 0.3  # rad/s, N m against the rocker, kg m²
CRANK, SIDE, BAR, ROCKER = 69.8, 200.0, 197.2, 264.4  # mm
O, C, F = 0j, 210 + 0j, -50.7 + 528.2j
JOURNALS = {"O": ("frame at O", 15), "A": ("2 at A", 10), "B": ("3 at B", 10), "C": ("frame at C", 15),
            "D": ("4 at D", 10), "E": ("5 at E", 10), "F": ("frame at F", 15)}  # mm


def cross(one: Any, other: Any) -> Any:
    return (np.conj(one) * other).imag


def crossing(P: Any, Q: Any, p: float, q: float, side: int) -> Any:
    """Where circles of radii p about P and q about Q meet, on the left of PQ for 1."""
    long = abs(Q - P)
    along = (p * p - q * q + long * long) / (2 * long)
    return P + (along + side * 1j * np.sqrt(p * p - along * along)) * (Q - P) / long


def dyad(P: Any, vP: Any, aP: Any, X: Any, Q: complex) -> tuple[Any, Any, Any, Any]:
    """Turning and its change of two links PX and QX, of which Q is fixed."""
    p, q = X - P, X - Q

    def turns(closing: Any) -> tuple[Any, Any]:
        return (closing * np.conj(q)).real / cross(q, p), (closing * np.conj(p)).real / cross(q, p)

    w, u = turns(vP)
    change, other = turns(aP - w**2 * p + u**2 * q)
    return w, u, change, other


@cache
def mechanism() -> dict[str, Any]:
    """Points and rates in 36 positions of the crank, ten degrees apart from -60."""
    A = CRANK * np.exp(1j * np.radians(-60 + 360 / POSES * np.arange(POSES)))
    B = crossing(A, C, SIDE, SIDE, 1)
    D = A + 2 * (B - A)
    E = crossing(D, F, BAR, ROCKER, -1)
    w2, w3, e2, _ = dyad(A, 1j * OMEGA * A, -OMEGA**2 * A, B, C)
    w4, w5, _, e5 = dyad(D, 1j * OMEGA * A + 1j * w2 * (D - A), -OMEGA**2 * A + (1j * e2 - w2**2) * (D - A), E, F)
    return {"A": A, "B": B, "D": D, "E": E, "w": (OMEGA, w2, w3, w4, w5), "e5": e5}


def formulas(load: float) -> dict[str, Any]:
    """P4, P3, P2 in N and the driving moment in N m without friction, under a load on the rocker."""
    at = mechanism()
    A, B, D, E = (at[name] for name in "ABDE")
    M5 = load + INERTIA * at["e5"]
    P4 = 1000 * M5 / cross(E - F, (E - D) / BAR)  # EF sin mu
    b4, b3, along = np.angle(E - D), np.angle(B - C), (B - C) / SIDE
    K = D + (E - D) / BAR * cross(along, B - D) / cross(along, (E - D) / BAR)
    gamma = np.angle(A - K)
    return {"P4": P4, "P3": P4 * np.sin(b4 - gamma) / np.sin(gamma - b3),
            "P2": P4 * np.sin(b4 - b3) / np.sin(gamma - b3), "M1": M5 * at["w"][4] / OMEGA}


def family(*settings: str) -> dict[str, Any]:
    """The table of the scene's cycle with other values, as `--vary` plots it."""
    with TemporaryDirectory() as folder:
        file = Path(folder) / "turn.json"
        options = [word for setting in settings for word in ("--set", setting)]
        done = ran("cycle", "kinytskyi", "--positions", str(POSES), *options, "-q", "-o", file)
        assert done.status == 0, done.err
        data: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
        return data


def sizes(vectors: Any) -> Any:
    return np.hypot(*np.array(vectors, dtype=float).T)


@pytest.mark.parametrize("load", [10, 20, 40])
def test_forces_and_moment_are_those_of_his_formulas(load: float) -> None:
    """Figure 2: P4, P3 and P2 over the crank's angle, a curve for each load; (4) to (8) in 36 positions to 1e-9."""
    data, by_formula = family(f"moments.0.value=-{load}"), formulas(load)
    for letter, name in (("P4", "5 at E"), ("P3", "3 at B"), ("P2", "2 at A")):
        assert sizes(data["reaction"][name]) == pytest.approx(abs(by_formula[letter]), rel=1e-9, abs=1e-9)
    assert data["balance moment"]["1"] == pytest.approx(by_formula["M1"], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("coefficient", [0.02, 0.05, 0.1, 0.2])
def test_moment_and_efficiency_with_friction_are_those_of_his_formulas(coefficient: float) -> None:
    """Figure 3: the efficiency over the crank's angle, a curve for each coefficient in all journals; (9) to (11) with
    the reactions that the table has: where the load drives it is the other way about."""
    data = family(f"friction.*.coefficient={coefficient}", f"sheet.rounds={ROUNDS}")
    smooth, (w1, w2, w3, w4, w5) = formulas(LOAD)["M1"], mechanism()["w"]
    turning = {"O": w1, "A": w2 - w1, "B": w3 - w2, "C": w3, "D": w4 - w2, "E": w5 - w4, "F": w5}
    lost = sum(coefficient * radius / 1000 * sizes(data["reaction with friction"][name]) * np.abs(turning[joint])
               for joint, (name, radius) in JOURNALS.items())
    rubbed = smooth + lost / OMEGA
    assert data["balance moment with friction"]["1"] == pytest.approx(rubbed, rel=1e-9, abs=1e-9)
    efficiency = np.where(smooth > 0, smooth / rubbed, rubbed / smooth)
    assert data["efficiency"] == pytest.approx(efficiency, rel=1e-9, abs=1e-9)
