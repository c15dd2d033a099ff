"""Function generation: crank and rocker, or crank and slide, that are together at given places (Ozols 1974, 22-5 and
22-6).

By inversion: all is turned back as the rocker, or the crank, has turned, so that it stands still in its first position;
the other end of the coupler then runs on a circle.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from graphplan.errors import NoMechanism
from graphplan.kernel.program import Mark
from graphplan.mechanism.numbers import number_text
from graphplan.phrases import said
from graphplan.synthesis import guidance
from graphplan.synthesis.linkage import FoundLinkage, best_first
from graphplan.synthesis.sketch import (
    FIRST_THREE,
    Synthesis,
    SynthesisBoard,
    direction,
    largest,
    place_of,
    require_circle,
    require_lengths,
)
from graphplan.synthesis.task import SynthesisTask
from graphplan.synthesis.tolerances import COLLINEAR_TOL, SAME_POINT_TOL


def synthesize_function(task: SynthesisTask) -> Synthesis:
    """The linkages of a function task, best first: of up to four pairs one, of five up to three."""
    sketches = [RockerSketch(task, w) for w in crank_pins(task)] if task.request.rocker else [SlideSketch(task)]
    linkages, values = best_first((require_lengths(sketch.linkage(), f"{task.name}: function", sketch.size,
                                                   "other angles"), sketch.values) for sketch in sketches)
    results = {"structural_error": structural_error(task, linkages[0])} if task.request.compare else {}
    return Synthesis(task, values, linkages, results)


def crank_pins(task: SynthesisTask) -> list[complex]:
    """The places of A in the crank's plane, whose axis is the input line: the chosen one, or all that five pairs leave.
    """
    request, where = task.request, f"{task.name}: function"
    if request.crank:
        return [complex(request.crank)]
    O, C, angles = complex(*request.pivot), complex(*request.rocker["pivot"]), request.rocker["angles"]
    crank, rocker = map(direction, request.input), [direction(angle - angles[0]) for angle in angles]
    if len(angles) < 5:
        positions = [(C + (O - C) / turn, way / turn) for way, turn in zip(crank, rocker, strict=True)]
        return [guidance.chosen_point(f"{where}.moving.1", positions, request.moving[0])]
    pins = pins_of_five_pairs(C - O, [*crank], rocker)
    if not pins:
        raise NoMechanism(f"{where}.input", "no linkage has these five pairs", "another pair, or four of them")
    return pins


def pins_of_five_pairs(ground: complex, crank: Sequence[complex], rocker: Sequence[complex]) -> list[complex]:
    """All w in the crank's plane for which A = w crank_k and B = ground + b rocker_k are equally far apart.

    The differences of the squares are linear in w, b and g = w conj(b): with d = conj(ground)
    Re(w d (crank_k - crank_1)) - Re(b d (rocker_k - rocker_1)) + Re(g (crank_k/rocker_k - crank_1/rocker_1)) = 0.
    Four of them leave a sum of two solutions, in the ratio t; that g is w conj(b) is a cubic in t.
    """
    ahead, ways = ground.conjugate() / abs(ground), [*zip(crank, rocker, strict=True)]
    factors = [(ahead * (e - crank[0]), ahead * (rocker[0] - f), e / f - crank[0] / rocker[0]) for e, f in ways[1:]]
    rows = [[part for factor in row for part in (factor.real, -factor.imag)] for row in factors]
    solutions = np.linalg.svd(np.array(rows))[2][4:]
    w, b, g = (solutions[:, part] + 1j * solutions[:, part + 1] for part in (0, 2, 4))
    pins = list[complex]()
    for ratio in guidance.real_roots(np.convolve(np.convolve(g, w.conj()), b).imag):
        A, B, product = (complex(pair[0] + ratio * pair[1]) for pair in (w, b, g))
        if min(abs(A), abs(B)) > COLLINEAR_TOL:
            pins.append(abs(ground) * A * (product / (A * B.conjugate())).real)
    return pins


def structural_error(task: SynthesisTask, linkage: FoundLinkage) -> dict[str, Any]:
    """The largest difference of the outputs, both from the first pair, and at which input."""
    request = task.request
    first = request.rocker["angles"][0] if request.rocker else request.slide["at"][0]
    worst: tuple[float, float] = (0.0, request.input[0])
    for angle, output in request.compare:
        A = linkage.O + (linkage.A[0] - linkage.O) * cmath.rect(1.0, math.radians(angle - request.input[0]))
        B = second_pin(linkage, A)
        if B is None:
            raise NoMechanism(f"{task.name}: function.compare", f"at {number_text(angle)} degrees the linkage does not "
                              "close", "inputs between its limits")
        if linkage.C is None:
            error = ((B - linkage.B[0]) / linkage.guide).real - (output - first)
        else:
            turned = math.degrees(cmath.phase((B - linkage.C) / (linkage.B[0] - linkage.C)))
            error = (turned - (output - first) + 180) % 360 - 180
        worst = max(worst, (abs(error), angle), key=lambda pair: pair[0])
    return {"largest": worst[0], "at": worst[1]}


def second_pin(linkage: FoundLinkage, A: complex) -> complex | None:
    """B for a place of A, on the side on which it is in the first position."""
    b = linkage.sides["A B"]
    if linkage.C is None:
        off = ((A - linkage.B[0]) / linkage.guide).imag
        along = b * b - off * off
        sense = math.copysign(1.0, ((linkage.B[0] - linkage.A[0]) / linkage.guide).real)
        return None if along < 0 else A - 1j * off * linkage.guide + sense * math.sqrt(along) * linkage.guide
    c, d = linkage.sides["B C"], linkage.C - A
    x = (b * b - c * c + abs(d) ** 2) / (2 * abs(d))
    side = math.copysign(1.0, ((linkage.B[0] - linkage.A[0]) / (linkage.C - linkage.A[0])).imag)
    return None if abs(x) > b else A + d / abs(d) * complex(x, side * math.sqrt(b * b - x * x))


class InversionSketch:
    """Pairs of a crank and a rocker or slide: all is turned back about a pivot as a link on it has turned.

    Lines through the pivot `about` that turn so are `lines`; the points that are turned back are `moving`.
    """

    where: str
    turns: list[float]
    positions_law = said("the angles of crank and rocker that belong together")

    def __init__(self, task: SynthesisTask, **given: complex):
        self.task, self.sketch, self.pivot = task, SynthesisBoard(), complex(*task.request.pivot)
        self.size = largest(z - self.pivot for z in given.values())
        self.O, *self.given = (self.sketch.given(z, name, name[0]) for name, z in {"O": self.pivot, **given}.items())
        with self.sketch.stage(said("Positions"), self.positions_law):
            self.rays = [self.sketch.keep("input", self.sketch.ray(self.O, angle)) for angle in task.request.input]

    def turn_back(self, about: Mark, lines: list[Mark], far: Mark, moving: list[Mark], letter: str) -> list[Mark]:
        """The points turned back, by triangles over where the lines cross a circle through a point that is far off."""
        board = self.sketch.board
        with self.sketch.stage(said("Positions"), self.positions_law):
            arm = board.circle(about, board.opening(about, far))
            E = [board.line_meets_circle(line, arm, way="on", name=f"E_{k}") for k, line in enumerate(lines, 1)]
        return [moving[0], *(board.triangle(about, E[k], moving[k], about, E[0], name=f"{letter}_{k + 1}′")
                             for k in range(1, len(moving)))]

    def draw_pin(self, back: list[Mark], places: list[complex], line: tuple[Mark, float], letters: str,
                 remedies: tuple[str, str]) -> None:
        """The pin that is as far from all points that are turned back: of two on a line at an angle."""
        sketch, board, moving, found = self.sketch, self.sketch.board, *letters
        if len(back) > 2:
            require_circle(self.where, f"{moving}_1 {moving}_2′ {moving}_3′", places[:3], self.size, remedies[1])
            sketch.circle_through(back, f"{found}_1", found,
                                  three=self.task.centres_by.get(found, FIRST_THREE))
            return
        apart = places[1] - places[0]
        if abs(apart) <= SAME_POINT_TOL * self.size or (
                abs((apart / direction(line[1])).real) <= COLLINEAR_TOL * abs(apart)):
            raise NoMechanism(self.where, f"{moving}_1 and {moving}_2′ lie perpendicular to the first line of "
                              f"{found}, or coincide, so that no point of it is as far from both", remedies[0])
        bisector = sketch.keep("bisector", board.bisector(*back))
        sketch.keep(found, board.meet(bisector, line[0], name=f"{found}_1"))


class RockerSketch(InversionSketch):
    """Two to five pairs of a crank and a rocker, with A at w in the crank's plane."""

    def __init__(self, task: SynthesisTask, w: complex):
        self.at, angles = complex(*task.request.rocker["pivot"]), task.request.rocker["angles"]
        super().__init__(task, C=self.at)
        request, sketch, (C,) = task.request, self.sketch, self.given
        self.where, self.turns = f"{task.name}: function.rocker", [angle - angles[0] for angle in angles]
        turned = [self._turned_back(self.pivot + w * direction(angle), k) for k, angle in enumerate(request.input)]
        with sketch.stage(said("Positions"), self.positions_law):
            lines = [sketch.keep("output", sketch.ray(C, angle)) for angle in angles]
            A = self._pins(w)
        law = said("inversion about C: the rocker stands still, and A moves on a circle about B")
        with sketch.stage(said("Point B"), law):
            back = self.turn_back(C, lines, self.O, A, "A")
            self.draw_pin(back, turned, (lines[0], angles[0]), "AB", ("another crank or angle", "other angles or "
                          "another crank, or a slide instead of the coupler"))
        self.values = sketch.values()

    def _turned_back(self, z: complex, k: int) -> complex:
        """Place of a point when all is turned back about C by the rocker's angle."""
        return self.at + (z - self.at) * direction(-self.turns[k])

    def _pins(self, w: complex) -> list[Mark]:
        """A at each angle of the crank."""
        sketch, board, crank = self.sketch, self.sketch.board, self.task.request.crank
        circle = board.circle(self.O, sketch.keep("crank", board.radius(length=crank))) if crank else None
        return [sketch.keep("A", board.line_meets_circle(ray, circle, way="on", name=f"A_{k}") if circle is not None
                            else board.set_off(ray, self.O, dx=w.real, dy=w.imag, ux=1, uy=0, name=f"A_{k}"))
                for k, ray in enumerate(self.rays, 1)]

    def linkage(self) -> FoundLinkage:
        """The linkage as it is drawn."""
        O, C, B = (place_of(self.values, role) for role in "OCB")
        A = tuple(complex(*at) for at in self.values.values_of_role("A"))
        return FoundLinkage(O, A, tuple(C + (B - C) * direction(turn) for turn in self.turns), C)


class SlideSketch(InversionSketch):
    """Two or three pairs of a crank and a slide."""

    positions_law = said("the angles of the crank and the places of the slide that belong together")

    def __init__(self, task: SynthesisTask):
        request, along = task.request, complex(*task.request.slide["direction"])
        self.where, self.guide = f"{task.name}: function.slide", along / abs(along)
        self.at = [complex(*request.slide["through"]) + place * self.guide for place in request.slide["at"]]
        super().__init__(task, **{f"B_{k}": B for k, B in enumerate(self.at, 1)})
        sketch, B = self.sketch, self.given
        self.turns = [angle - request.input[0] for angle in request.input]
        turned = [self.pivot + (B - self.pivot) * direction(-turn) for B, turn in zip(self.at, self.turns, strict=True)]
        farthest = max(zip(self.at, B, strict=True), key=lambda pair: abs(pair[0] - self.pivot))[1]
        with sketch.stage(said("Positions"), self.positions_law):
            sketch.keep("guide", sketch.board.guide(B[0], dx=self.guide.real, dy=self.guide.imag))
        law = said("inversion about O: the crank stands still, and B moves on a circle about A")
        with sketch.stage(said("Point A"), law):
            back = self.turn_back(self.O, self.rays, farthest, B, "B")
            self.draw_pin(back, turned, (self.rays[0], request.input[0]), "BA", ("another place of the slide", "other "
                          "places or angles, or a second slide instead of the coupler"))
        self.values = sketch.values()

    def linkage(self) -> FoundLinkage:
        """The linkage as it is drawn."""
        O, A = place_of(self.values, "O"), place_of(self.values, "A")
        pins = tuple(O + (A - O) * direction(turn) for turn in self.turns)
        return FoundLinkage(O, pins, tuple(self.at), guide=self.guide, names=("O", "A", "B"))
