"""Function generation: crank and rocker, or crank and slide, that are together at given places (Ozols 1974, 22-5 and
22-6).

By inversion: all is turned back as the rocker, or the crank, has turned, so that it stands still in its first position;
the other end of the coupler then runs on a circle.
"""

from __future__ import annotations

import cmath
import math
from itertools import pairwise
from typing import Any

from graphplan.errors import NoMechanism
from graphplan.kernel.program import Mark
from graphplan.mechanism.numbers import number_text
from graphplan.phrases import said
from graphplan.synthesis import burmester
from graphplan.synthesis.linkage import FoundLinkage
from graphplan.synthesis.requests import CirclePointChoice
from graphplan.synthesis.sketch import Synthesis, SynthesisBoard, direction, largest, place_of, require_circle
from graphplan.synthesis.task import SynthesisTask
from graphplan.synthesis.tolerances import COLLINEAR_TOL, SAME_POINT_TOL


def synthesize_function(task: SynthesisTask) -> Synthesis:
    """The linkage of a function task."""
    construction = RockerSketch(task) if task.request.rocker else SlideSketch(task)
    linkage = construction.linkage()
    results = {}
    if task.request.compare:
        results = {"structural_error": structural_error(task, linkage)}
    return Synthesis(task, (construction.values,), (linkage,), results)


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


class RockerSketch:
    """Two to four pairs of a crank and a rocker."""

    def __init__(self, task: SynthesisTask):
        request = task.request
        self.task, self.sketch = task, SynthesisBoard()
        self.pivot, self.at = complex(*request.pivot), complex(*request.rocker["pivot"])
        self.turns = [angle - request.rocker["angles"][0] for angle in request.rocker["angles"]]
        self.size = abs(self.at - self.pivot)
        self.O, self.C = self.sketch.given(self.pivot, "O"), self.sketch.given(self.at, "C")
        self._draw()
        self.values = self.sketch.values()

    def _turned_back(self, z: complex, k: int) -> complex:
        """Where a point is when all is turned back about C as the rocker has turned."""
        return self.at + (z - self.at) * direction(-self.turns[k])

    def _draw(self) -> None:
        request, sketch, board = self.task.request, self.sketch, self.sketch.board
        with sketch.stage(said("Positions"), said("the angles of crank and rocker that belong together")):
            self.rays = [sketch.keep("input", sketch.ray(self.O, angle)) for angle in request.input]
            lines = [sketch.keep("output", sketch.ray(self.C, angle)) for angle in request.rocker["angles"]]
            arm = board.circle(self.C, board.opening(self.C, self.O))
            E = [board.line_meets_circle(line, arm, way="on", name=f"E_{k}") for k, line in enumerate(lines, 1)]
            A = self._pins()
            at = [complex(*point) for point in self._pin_places()]
        law = said("all is turned back about C as the rocker has turned: it stands still, and A runs on a circle about "
                   "B")
        with sketch.stage(said("Point B"), law):
            back = [A[0], *(board.triangle(self.C, E[k], A[k], self.C, E[0], name=f"A_{k + 1}′")
                            for k in range(1, len(A)))]
            turned = [self._turned_back(z, k) for k, z in enumerate(at)]
            if len(A) == 2:
                self._on_first_line(back, turned, lines[0])
                return
            require_circle(f"{self.task.name}: function.rocker", "A_1 A_2′ A_3′", turned[:3], self.size,
                           "other angles or another crank, or a slide in the place of the coupler")
            sketch.circle_through(back[:3], "B_1", "B")
            for start, end in pairwise(back[2:]):
                sketch.keep("bisector", board.bisector(start, end))

    def _pins(self) -> list[Mark]:
        """A at each angle of the crank."""
        request, sketch, board = self.task.request, self.sketch, self.sketch.board
        if request.crank:
            circle = board.circle(self.O, board.radius(length=request.crank))
            return [sketch.keep("A", board.line_meets_circle(ray, circle, way="on", name=f"A_{k}"))
                    for k, ray in enumerate(self.rays, 1)]
        w = self._moving_point
        return [sketch.keep("A", board.set_off(ray, self.O, dx=w.real, dy=w.imag, ux=1, uy=0, name=f"A_{k}"))
                for k, ray in enumerate(self.rays, 1)]

    def _pin_places(self) -> list[tuple[float, float]]:
        w = complex(self.task.request.crank) if self.task.request.crank else self._moving_point
        places = [self.pivot + w * direction(angle) for angle in self.task.request.input]
        return [(z.real, z.imag) for z in places]

    @property
    def _moving_point(self) -> complex:
        """Of four pairs A in the crank's plane: a circle point of its positions seen from the rocker."""
        choice: CirclePointChoice = self.task.request.moving[0]
        positions = [(self._turned_back(self.pivot, k), direction(angle - self.turns[k]))
                     for k, angle in enumerate(self.task.request.input)]
        points = burmester.circle_points(positions, choice.u)
        if choice.root > len(points):
            raise NoMechanism(f"{self.task.name}: function.moving.1", f"at u = {choice.u:g} the circle-point curve has "
                              f"{len(points)} real points", "a root up to that number, or another u")
        return points[choice.root - 1]

    def _on_first_line(self, back: list[Mark], turned: list[complex], line: Mark) -> None:
        """B on the first line of the rocker, as far from both places of A."""
        start, end = turned
        first = direction(self.task.request.rocker["angles"][0])
        apart = abs(end - start)
        if apart <= SAME_POINT_TOL * self.size or abs(((end - start) / first).real) <= COLLINEAR_TOL * apart:
            raise NoMechanism(f"{self.task.name}: function.rocker", "A_1 and A_2′ lie square to the first line of the "
                              "rocker, or coincide, so that no point of it is as far from both",
                              "another crank or angle")
        bisector = self.sketch.keep("bisector", self.sketch.board.bisector(*back))
        self.sketch.keep("B", self.sketch.board.meet(bisector, line, name="B_1"))

    def linkage(self) -> FoundLinkage:
        """The linkage as it is drawn."""
        values = self.values
        O, C, B = (place_of(values, role) for role in "OCB")
        A = tuple(complex(*at) for at in values.values_of_role("A"))
        if abs(B - C) <= SAME_POINT_TOL * self.size or abs(B - A[0]) <= SAME_POINT_TOL * self.size or (
                abs(A[0] - O) <= SAME_POINT_TOL * self.size):
            raise NoMechanism(f"{self.task.name}: function", "a link of the linkage has no length", "other angles")
        return FoundLinkage(O, A, tuple(C + (B - C) * direction(turn) for turn in self.turns), C)


class SlideSketch:
    """Two or three pairs of a crank and a slide."""

    def __init__(self, task: SynthesisTask):
        request = task.request
        self.task, self.sketch = task, SynthesisBoard()
        slide = request.slide
        along = complex(*slide["direction"])
        self.pivot, self.guide = complex(*request.pivot), along / abs(along)
        self.at = [complex(*slide["through"]) + place * self.guide for place in slide["at"]]
        self.size = largest([B - self.pivot for B in self.at])
        self.O = self.sketch.given(self.pivot, "O")
        self.B = [self.sketch.given(B, f"B_{k}", "B") for k, B in enumerate(self.at, 1)]
        self._draw()
        self.values = self.sketch.values()

    def _draw(self) -> None:
        request, sketch, board = self.task.request, self.sketch, self.sketch.board
        turned = [self.pivot + (B - self.pivot) * direction(request.input[0] - angle)
                  for B, angle in zip(self.at, request.input, strict=True)]
        with sketch.stage(said("Positions"), said("the angles of the crank and the places of the slide that belong "
                                                  "together")):
            rays = [sketch.keep("input", sketch.ray(self.O, angle)) for angle in request.input]
            sketch.keep("guide", board.guide(self.B[0], dx=self.guide.real, dy=self.guide.imag))
            arm = board.circle(self.O, board.opening(self.O, self._farthest))
            E = [board.line_meets_circle(ray, arm, way="on", name=f"E_{k}") for k, ray in enumerate(rays, 1)]
        law = said("all is turned back about O as the crank has turned: it stands still, and B runs on a circle about "
                   "A")
        with sketch.stage(said("Point A"), law):
            back = [self.B[0], *(board.triangle(self.O, E[k], self.B[k], self.O, E[0], name=f"B_{k + 1}′")
                                 for k in range(1, len(self.B)))]
            if len(back) == 2:
                first = direction(request.input[0])
                apart = turned[1] - turned[0]
                if abs(apart) <= SAME_POINT_TOL * self.size or (
                        abs((apart / first).real) <= COLLINEAR_TOL * abs(apart)):
                    raise NoMechanism(f"{self.task.name}: function.slide", "B_1 and B_2′ lie square to the first line "
                                      "of the crank, or coincide", "another place of the slide")
                bisector = sketch.keep("bisector", board.bisector(*back))
                sketch.keep("A", board.meet(bisector, rays[0], name="A_1"))
            else:
                require_circle(f"{self.task.name}: function.slide", "B_1 B_2′ B_3′", turned, self.size,
                               "other places or angles, or a second slide in the place of the coupler")
                sketch.circle_through(back, "A_1", "A")

    @property
    def _farthest(self) -> Mark:
        """The place of the slide that is farthest from O."""
        return max(zip(self.at, self.B, strict=True), key=lambda pair: abs(pair[0] - self.pivot))[1]

    def linkage(self) -> FoundLinkage:
        """The linkage as it is drawn."""
        O, A = place_of(self.values, "O"), place_of(self.values, "A")
        if abs(A - O) <= SAME_POINT_TOL * self.size or abs(A - self.at[0]) <= SAME_POINT_TOL * self.size:
            raise NoMechanism(f"{self.task.name}: function", "a link of the linkage has no length", "other angles")
        turns = [angle - self.task.request.input[0] for angle in self.task.request.input]
        pins = tuple(O + (A - O) * direction(turn) for turn in turns)
        return FoundLinkage(O, pins, tuple(self.at), guide=self.guide, names=("O", "A", "B"))
