"""Shortcuts of the drawing board, and what they cost in a drawing.

For the middle A of a link BC whose ends have the loci beta and gamma, Rosenauer (No. 16) draws the bisector of the
angle between beta and gamma where the median of the trial triangles belongs, and lets alpha, the locus of A, begin at
a itself, without the normal acceleration of A. Both suit a pencil in some poses; here is by how much they miss.

The static replacement of a link by masses at two joints is a third. Masses in the inverse proportion of their distances
keep the link's mass and its centre, so the inertia force has the right size and direction; but the moment of inertia
becomes m a b instead of I: the couple is wrong by ab/i^2 - 1, whatever the motion (Ozols 1974, 9-2, example 9-1).
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from graphplan.check.tolerances import COLLINEAR_TOL
from graphplan.kernel.kinds import Movement
from graphplan.kernel.program import Step
from graphplan.mechanism.model import Scene
from graphplan.mechanism.units import metre
from graphplan.methods.construction import Construction
from graphplan.methods.panels import N_PLAN

Line = tuple[float, float, float]


@dataclass(frozen=True)
class Shortcuts:
    """What the shortcuts make of the acceleration of a link's middle.

    `angle` is between bisector and median, in degrees; `bisector` and `dropped` are the misses of the middle's end,
    by the bisector and by dropping its normal acceleration, as parts of its acceleration.
    """

    middle: str
    angle: float
    bisector: float
    dropped: float

    def __str__(self) -> str:
        return (f"shortcuts for {self.middle}, the middle of its link: the bisector is {self.angle:.2g} degrees off "
                f"the median and misses a_{self.middle} by {100 * self.bisector:.2g} %; dropping its normal "
                f"acceleration misses it by {100 * self.dropped:.2g} %")


def shortcuts(drawing: Construction) -> list[Shortcuts]:
    """The shortcuts wherever a drawing has a link with three loci on the N-plan, one of them of its middle."""
    return [shortcut for step in drawing.program.steps if step.op.claim_operands("locus") and step.panel.whole == N_PLAN
            for shortcut in _shortcuts_at(drawing, step)]


def _shortcuts_at(drawing: Construction, carry: Step) -> Iterator[Shortcuts]:
    """The link whose loci this step carries together, if one of its three points halves the other two, whose loci meet.
    """
    steps, values = drawing.program.steps, drawing.truth
    requested = {reading.of for reading in drawing.readings if reading.kind == "acceleration"}
    for step in steps:
        if step.op.movement is Movement.MET and carry.index in step.args:
            A, alpha, B, beta, C = carry.args
            (gamma,) = (arg for arg in step.args if arg != carry.index)
            three = [(A, alpha), (B, beta), (C, gamma)]
            for middle in three:
                first, second = (joint for joint in three if joint is not middle)
                halves = (complex(*values[first[0]]) + complex(*values[second[0]])) / 2
                beta, gamma, name = values[first[1]], values[second[1]], steps[middle[0]].name
                near = abs(halves - complex(*values[middle[0]])) < COLLINEAR_TOL * abs(halves)
                if near and name in requested and _sine(beta, gamma):
                    yield _cost(drawing, name, values[middle[1]], beta, gamma)


def _cost(drawing: Construction, name: str, alpha: Line, beta: Line, gamma: Line) -> Shortcuts:
    """Draw both shortcuts and compare them with the exact end of the middle."""
    arrow = next(r for r in drawing.readings if r.kind == "acceleration" and r.of == name)
    a, end = (complex(*drawing.truth[drawing.program.wanted[mark]]) for mark in arrow.marks)
    corner = _meet(beta, gamma)
    median = end - corner
    first, second = (complex(line[1], -line[0]) / math.hypot(*line[:2]) for line in (beta, gamma))
    bisector = min((first + second, first - second), key=lambda way: _angle(way, median))
    by_bisector = _meet(_line_through(corner, bisector), alpha)
    short = _meet(_line_through(corner, median), _line_through(a, complex(alpha[1], -alpha[0])))
    length = abs(end - a)
    return Shortcuts(name, math.degrees(_angle(bisector, median)), abs(by_bisector - end) / length,
                     abs(short - end) / length)


def _line_through(point: complex, way: complex) -> Line:
    return -way.imag, way.real, way.imag * point.real - way.real * point.imag


def _meet(k: Line, l: Line) -> complex:
    w = _sine(k, l)
    return complex((k[1] * l[2] - l[1] * k[2]) / w, (k[2] * l[0] - l[2] * k[0]) / w)


def _sine(k: Line, l: Line) -> float:
    """Twice the area between the normals of two lines: nothing where they are parallel."""
    return k[0] * l[1] - l[0] * k[1]


def _angle(one: complex, two: complex) -> float:
    """The angle between two lines of these directions."""
    turn = abs(cmath.phase(one / two))
    return min(turn, math.pi - turn)


@dataclass(frozen=True)
class Replacement:
    """A link, the joints that its mass would go to, and the error of the inertia couple as a part of it."""

    link: str
    joints: tuple[str, str]
    error: float

    def __str__(self) -> str:
        A, B = self.joints
        return (f"static replacement: masses at {A} and {B} for link {self.link} would miss its inertia couple by "
                f"{100 * self.error:.3g} %")


def replacements(scene: Scene) -> Iterator[Replacement]:
    """For each link with mass and inertia whose centre lies between two of its joints, what replacing it would cost."""
    places = {name: (float(x), float(y)) for name, (x, y) in scene.points.items()}
    for link, mass in (scene.loads.masses if scene.loads else {}).items():
        if not mass.mass or not mass.inertia:
            continue
        radius2 = float(mass.inertia / mass.mass * metre(scene.units) ** 2)
        joints = [point for point in scene.links[link] if point in scene.joints and point != mass.centre]
        for A, B in combinations(joints, 2):
            a, b = (math.dist(places[mass.centre], places[joint]) for joint in (A, B))
            if a + b <= math.dist(places[A], places[B]) * (1 + COLLINEAR_TOL):
                yield Replacement(link, (A, B), a * b / radius2 - 1)
