"""Where methods fail: packaged scenes with some points moved until only a distance d keeps them from a special pose.

d is an angle in radians or a part of a length, from 1 downwards; at 0 the pose is special. Coordinates are taken as
the fractions that the floats are, so that the exact solution is that of the very scene that is drawn.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import load

Places = Mapping[str, complex]


@dataclass(frozen=True)
class Degeneracy:
    """One way to a special pose: what happens at d = 0, in which packaged scene, and which points are moved there.

    `move` gives the moved points' places from those of the scene.
    """

    name: str
    what: str
    scene: str
    move: Callable[[Places, float], Places]

    def at(self, d: float) -> Scene:
        """The scene at the distance d."""
        scene = load(self.scene)
        places = {name: complex(*map(float, at)) for name, at in scene.points.items()}
        moved = {name: (Fraction(z.real), Fraction(z.imag)) for name, z in self.move(places, d).items()}
        return replace(scene, points=scene.points | moved)


def _turned(d: float) -> complex:
    """One, turned by the angle d, to the last digit for small angles too."""
    return complex((1 - (d / 2) ** 2) / (1 + (d / 2) ** 2), d / (1 + (d / 2) ** 2))


def _along(length: float, like: complex, d: float) -> complex:
    """A vector of this length, turned by d from the direction of another."""
    return length * like / abs(like) * _turned(d)


def _crossing(a: complex, b: complex, c: complex, d: complex) -> complex:
    """Where the lines ab and cd meet."""
    u, v, w = b - a, d - c, c - a
    return a + u * (w.conjugate() * v).imag / (u.conjugate() * v).imag


def _on_the_line_of_poles(p: Places, d: float) -> Places:
    Q = _crossing(p["K"], p["A"], p["L"], p["B"])
    R = _crossing(p["M"], p["D"], p["N"], p["E"])
    return {"C": Q + (R - Q) * (0.45 + 1j * d)}


def _slot_across_the_crank(p: Places, d: float) -> Places:
    A = p["O"] + _along(abs(p["A"] - p["O"]), 1j * (p["A"] - p["P"]), d)
    return {"P": A + (p["P"] - p["A"]), "B": A + (p["B"] - p["A"]), "A": A, "A3": A}


DEGENERACIES = (
    Degeneracy("parallel bars", "KA turned towards LB: the auxiliary point Q goes far away", "rosenauer-basic",
               lambda p, d: {"K": p["A"] - _along(abs(p["A"] - p["K"]), p["B"] - p["L"], d)}),
    Degeneracy("pole at infinity", "FE turned towards DG: the relative pole of links 2 and 5 goes far away",
               "class-four", lambda p, d: {"E": p["F"] + _along(abs(p["E"] - p["F"]), p["G"] - p["D"], d)}),
    Degeneracy("dead centre", "B brought to the line AC: coupler and rocker stretched", "four-bar",
               lambda p, d: {"B": p["A"] + (p["C"] - p["A"]) / 2 * (1.1 + 1j * d)}),
    Degeneracy("C on QR", "C brought to the line of the auxiliary points", "rosenauer-basic", _on_the_line_of_poles),
    Degeneracy("no relative velocity", "the rocker turned parallel to the crank: the coupler moves straight on",
               "four-bar", lambda p, d: {"C": p["B"] - _along(abs(p["B"] - p["C"]), p["A"] - p["O"], d)}),
    Degeneracy("no turning", "the slot turned square to the crank: guide and Coriolis vector stand still",
               "slotted-link", _slot_across_the_crank),
    Degeneracy("joints coincide", "B brought to A, on link 3", "rosenauer-basic",
               lambda p, d: {"B": p["A"] + d * (p["B"] - p["A"])}),
    Degeneracy("long rocker", "the rocker 1/d times as long", "four-bar",
               lambda p, d: {"C": p["B"] + (p["C"] - p["B"]) / max(d, 1e-300)}),
    Degeneracy("short crank", "the crank d times as long", "four-bar",
               lambda p, d: {"O": p["A"] + d * (p["O"] - p["A"])}),
)
