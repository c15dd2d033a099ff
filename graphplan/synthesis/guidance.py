"""Guidance: a linkage that leads a plane through two to five positions (Ozols 1974, 22-7).

Of two and three positions A and B are chosen in the plane, or O and C in the frame, and the others are centres of
circles, by bisectors. Of four positions A and B are points of the circle-point curve, of five Burmester's points: these
are computed and plotted, and their bisectors meet in one centre.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations, permutations
from typing import Any

from graphplan.errors import NoMechanism
from graphplan.kernel.program import Mark
from graphplan.phrases import digits, said
from graphplan.synthesis import burmester
from graphplan.synthesis.burmester import Position, place
from graphplan.synthesis.driver import DrivingCrank
from graphplan.synthesis.linkage import FoundLinkage, sort_linkages
from graphplan.synthesis.sketch import (
    FIRST_THREE,
    Synthesis,
    SynthesisBoard,
    direction,
    largest,
    pair,
    place_of,
    require_circle,
    require_lengths,
)
from graphplan.synthesis.task import SynthesisTask
from graphplan.synthesis.tolerances import SAME_POINT_TOL

SLIDE = "another point, or guide it by a slide along that line"
WELL_CROSSING = 0.35  # a sine: bisectors that cross at no smaller angle are taken for a pole as they are there
POLE_ANGLES = 15, 165, 15  # degrees: at which pairs of circles give points of the centre-point curve


def synthesize_guidance(task: SynthesisTask) -> Synthesis:
    """All linkages that the task asks for, best first."""
    request = task.request
    positions = [(complex(x, y), direction(angle)) for x, y, angle in request.positions]
    results = pole_results(positions)
    if len(positions) == 5:
        dyads = burmester.burmester_points(positions)
        if not dyads:
            raise NoMechanism(f"{task.name}: guidance.positions", "no point of the plane has these five positions on a "
                              "circle", "another position, or four of them")
        results |= {"circle_points": [circle_point(w, O, positions) for w, O in dyads]}
        pairs: list[tuple[complex, ...]] = [*permutations([w for w, _ in dyads], 2)]
    elif len(positions) == 4:
        chosen = [burmester.chosen_point(f"{task.name}: guidance.moving.{k}", positions, point)
                  for k, point in enumerate(request.moving, 1)]
        listed = [*(w for u in request.table for w in burmester.circle_points(positions, u)), *chosen]
        results |= {"circle_points": [circle_point(w, burmester.centre(positions, w), positions)
                                      for w in distinct_points(listed)]}
        pairs = [(chosen[0], chosen[1])] if chosen else []
    else:
        pairs = [tuple(complex(*point) for point in request.moving)] if request.moving else [()]
    sketches = [GuidanceSketch(task, positions, points) for points in pairs or [()]]
    if request.driver:
        for start in sketches:
            start.drive()
    if not pairs:
        return Synthesis(task, (sketches[0].values,), (), results)
    linkages = {id(start.linkage): start.values for start in sketches}
    ordered = sort_linkages([start.linkage for start in sketches])
    return Synthesis(task, tuple(linkages[id(start)] for start in ordered), tuple(ordered), results)


def distinct_points(points: Sequence[complex]) -> list[complex]:
    """Points without those that are there already."""
    distinct: list[complex] = []
    for w in points:
        if all(abs(w - earlier) > SAME_POINT_TOL * max(1.0, abs(w)) for earlier in distinct):
            distinct.append(w)
    return distinct


def circle_point(w: complex, O: complex, positions: Sequence[Position]) -> dict[str, Any]:
    """A circle point as results have it."""
    return {"u": w.real, "z": w.imag, "centre": pair(O), "radius": abs(place(positions[0], w) - O)}


def pole_results(positions: Sequence[Position]) -> dict[str, Any]:
    """Poles, and of four positions the inflection and return circles with Ball's point and the return point."""
    moving = burmester.poles(positions)
    fixed = {key: None if w is None else place(positions[int(key[0]) - 1], w) for key, w in moving.items()}
    results: dict[str, Any] = {"poles": {key: {"fixed": pair(at), "moving": pair(w)} if at is not None and w is not None
                                         else {"fixed": None, "moving": None}
                                         for (key, w), at in zip(moving.items(), fixed.values(), strict=True)}}
    if len(positions) == 4:
        for name, point, table in (("inflection", "ball", moving), ("return", "return_point", fixed)):
            circles = {f"{i}{j}{k}": burmester.inflection_circle([table[f"{i}{j}"], table[f"{i}{k}"], table[f"{j}{k}"]])
                       for i, j, k in combinations("1234", 3)}
            results[name] = {key: None if circle is None else {"centre": pair(circle[0]), "radius": circle[1]}
                             for key, circle in circles.items()}
            start, end, common = circles["123"], circles["124"], table["12"]
            if start is None or end is None or common is None:
                results[point] = None
            else:
                results[point] = pair(burmester.mirror_point(common, start[0], end[0]))
    return results


class GuidanceSketch:
    """The construction of one linkage; `points` are A and B in the moving plane, none of fixed pivots or of none."""

    def __init__(self, task: SynthesisTask, positions: Sequence[Position], points: Sequence[complex]):
        self.task, self.positions, self.points, self.sketch = task, positions, points, SynthesisBoard()
        self.size = largest([m for m, _ in positions] + [*points])
        self.M = [self.sketch.given(m, f"M_{k}", "M") for k, (m, _) in enumerate(positions, 1)]
        self.pivots = [self.sketch.given(complex(*point), name)
                       for point, name in zip(task.request.fixed, ("O", "C"), strict=False)]
        self._draw()
        self.values = self.sketch.values()
        if points or self.pivots:
            self.linkage = self._linkage()

    def _draw(self) -> None:
        """Stage by stage."""
        sketch, request = self.sketch, self.task.request
        with sketch.stage(said("Positions"), said("the origin M and the axis of the plane")):
            self.axes = [sketch.keep("axis", sketch.ray(M, angle)) for M, (_, _, angle) in
                         zip(self.M, request.positions, strict=True)]
        if self.pivots:
            for O, letter, name in zip(self.pivots, "OC", "AB", strict=True):
                self._centre_of_pivot(O, letter, name)
        for w, name, letter, k in zip(self.points, "AB", "OC", (0, 1), strict=False):
            if len(self.positions) == 2:
                self._apex(w, name, letter, request.turns[k])
            else:
                self._centre_of_circle(w, name, letter)
        self._poles()

    # ---- the centre of a moving point ------------------------------------------------------------------------------

    def _places(self, w: complex, name: str) -> list[Mark]:
        """A point of the plane in its positions."""
        return [self.sketch.keep(name, self.carry(w, k, f"{name}_{k + 1}")) for k in range(len(self.positions))]

    def carry(self, w: complex, k: int, name: str = "") -> Mark:
        """A point of the plane in a position."""
        if w == 0:
            return self.M[k]
        return self.sketch.board.set_off(self.axes[k], self.M[k], dx=w.real, dy=w.imag, ux=1, uy=0, name=name, why=said(
            "{0} along the axis, {1} to its left", digits(w.real, 5), digits(w.imag, 5)))

    def _apex(self, w: complex, name: str, letter: str, turn: float) -> None:
        """The apex of the isosceles triangle over both positions of a point."""
        board, sketch = self.sketch.board, self.sketch
        start, end = (place(position, w) for position in self.positions)
        if abs(end - start) <= SAME_POINT_TOL * self.size:
            raise NoMechanism(f"{self.task.name}: guidance.moving", f"{name}_1 and {name}_2 coincide: it is the pole "
                              "P_12", "another point")
        base = 90 - turn / 2
        law = said("the triangle over {0}_1 {0}_2 has the base angle (180° - {1}°)/2", name, digits(abs(turn)))
        with sketch.stage(said("Centre {0}", letter), law):
            A, B = self._places(w, name)
            across = sketch.keep("bisector", board.bisector(A, B))
            if abs(turn) == 180:
                sketch.keep(letter, board.meet(board.line(A, B), across, name=letter))
            else:
                chord = math.degrees(math.atan2((end - start).imag, (end - start).real))
                side = sketch.keep(f"base {name}", sketch.ray(A, chord + base))
                sketch.keep(letter, board.meet(across, side, name=letter))

    def _centre_of_circle(self, w: complex, name: str, letter: str) -> None:
        """The centre of the circle through the first three positions of a point, on all further bisectors too."""
        at = [place(position, w) for position in self.positions]
        names = " ".join(f"{name}_{k}" for k in range(1, 4))
        require_circle(f"{self.task.name}: guidance.moving", names, at[:3], self.size, SLIDE)
        law = said("it lies on the perpendicular bisectors of the positions of {0}", name)
        with self.sketch.stage(said("Centre {0}", letter), law):
            self.sketch.circle_through(self._places(w, name), letter,
                                       three=self.task.centres_by.get(letter, FIRST_THREE))

    def _centre_of_pivot(self, O: Mark, letter: str, name: str) -> None:
        """The moving point of a fixed pivot: the frame is turned back, the plane stands still in position 1."""
        board, sketch = self.sketch.board, self.sketch
        fixed = complex(*self.task.request.fixed["OC".index(letter)])
        turned = [place(self.positions[0], (fixed - m) / e) for m, e in self.positions]
        names = " ".join([letter, f"{letter}_2′", f"{letter}_3′"])
        require_circle(f"{self.task.name}: guidance.fixed", names, turned, self.size,
                       "another pivot, or a slide that turns on it")
        law = said("seen from the plane in position 1 the frame turns back, and {0} runs on a circle about {1}", letter,
                   name)
        with sketch.stage(said("Moving point {0}", name), law):
            E = [sketch.keep("E", board.set_off(axis, M, dx=self.size, dy=0, ux=1, uy=0, name=f"E_{k}"))
                 for k, (axis, M) in enumerate(zip(self.axes, self.M, strict=True), 1)]
            back = [board.triangle(self.M[k], E[k], O, self.M[0], E[0], name=f"{letter}_{k + 1}′") for k in (1, 2)]
            self.sketch.circle_through([O, *back], f"{name}_1", name)

    # ---- poles -----------------------------------------------------------------------------------------------------

    def _poles(self) -> None:
        """The poles, by the bisectors of two points each; of four positions the circles and curves over them."""
        board, sketch = self.sketch.board, self.sketch
        moving = burmester.poles(self.positions)
        with sketch.stage(said("Poles"), said("the bisectors of two points of the plane meet in the pole of two "
                                              "positions")):
            marks = {}
            for key, w in moving.items():
                if w is None:
                    continue
                i, k = (int(number) - 1 for number in key)
                start, end = self._far_from(w)
                lines = [board.bisector(*(self.carry(x, n, f"{self._letter(x)}_{n + 1}") for n in (i, k)))
                         for x in (start, end)]
                marks[key] = sketch.keep(f"P{key}", board.meet(*lines, name=f"P_{key}"))
        if len(self.positions) == 4 and len(marks) == 6:
            self._circles(marks, moving)
            self._curve(marks, moving)

    def _letter(self, x: complex) -> str:
        """The letter of a point by which poles are drawn: A and B, or by where it lies from the origin."""
        if x in self.points:
            return "AB"[self.points.index(x)]
        return "U" if x.real > 0 else "W" if x.real < 0 else "V"

    def _far_from(self, w: complex) -> tuple[complex, complex]:
        """Two points of the plane whose bisectors cross well in a pole: A and B, else those that are best seen from it.
        """
        def sine(start: complex, end: complex) -> float:
            across = (end - w) / (start - w)
            return abs(across.imag) / abs(across)

        h = self.size / 4
        distinct = [x for x in self.points if abs(x - w) > h / 8]
        if len(distinct) == 2 and sine(*distinct) >= WELL_CROSSING:
            return distinct[0], distinct[1]
        tried = [x for x in (0j, complex(h), 1j * h, complex(-h)) if abs(x - w) > h / 8]
        return max(combinations(tried, 2), key=lambda ends: sine(*ends))

    def _circles(self, marks: dict[str, Mark], moving: dict[str, complex | None]) -> None:
        """Two inflection circles, through the poles carried into position 1, and Ball's point; two return circles and
        the return point: in each case the crossing that is no pole."""
        board, sketch = self.sketch.board, self.sketch
        circles = [burmester.inflection_circle([moving["12"], moving[f"1{k}"], moving[f"2{k}"]]) for k in "34"]
        if None in circles:
            return
        law = said("two of the circles cross in a pole, and in this point")
        with sketch.stage(said("Ball's point"), law):
            back = [sketch.keep("pole back", self.carry(moving[key] or 0j, 0, f"P_{key}′")) for key in ("23", "24")]
            centres = [sketch.circle_through([marks["12"], marks[key], mark], "", "inflection centre")
                       for key, mark in zip(("13", "14"), back, strict=True)]
            for start in centres:
                sketch.keep("inflection circle", board.circle(start, board.opening(start, marks["12"])))
            F = board.foot(board.line(*centres), marks["12"])
            sketch.keep("ball", board.step_off(marks["12"], F, F, ratio=1, name="B_a"))
        with sketch.stage(said("Return point"), law):
            centres = [sketch.circle_through([marks["12"], marks[start], marks[end]], "", "return centre")
                       for start, end in (("13", "23"), ("14", "24"))]
            for start in centres:
                sketch.keep("return circle", board.circle(start, board.opening(start, marks["12"])))
            F = board.foot(board.line(*centres), marks["12"])
            sketch.keep("return point", board.step_off(marks["12"], F, F, ratio=1, name="G"))

    def _curve(self, marks: dict[str, Mark], moving: dict[str, complex | None]) -> None:
        """Points of the centre-point curve: they see opposite sides of the quadrilateral P12 P23 P34 P14 alike."""
        board, sketch = self.sketch.board, self.sketch
        fixed = {key: place(self.positions[int(key[0]) - 1], w) for key, w in moving.items() if w is not None}
        sides = ("12", "23"), ("14", "34")
        law = said("from them opposite sides of the quadrilateral P_12 P_23 P_34 P_14 are seen under one angle: two "
                   "circles over these cross there")
        with sketch.stage(said("Centre-point curve"), law):
            for start, end in (*sides, ("23", "34"), ("12", "14")):
                sketch.keep("quadrilateral", board.line(marks[start], marks[end]))
            middles = [board.midpoint(marks[start], marks[end]) for start, end in sides]
            for angle in range(POLE_ANGLES[0], POLE_ANGLES[1] + 1, POLE_ANGLES[2]):
                ratio = 0.0 if angle == 90 else 0.5 / math.tan(math.radians(angle))
                centres = [(fixed[start] + fixed[end]) / 2 + 1j * ratio * (fixed[end] - fixed[start])
                           for start, end in sides]
                radii = [abs(c - fixed[start]) for c, (start, _) in zip(centres, sides, strict=True)]
                if not 1.001 * abs(radii[0] - radii[1]) < abs(centres[0] - centres[1]) < 0.999 * sum(radii):
                    continue
                about = [board.step_across(marks[start], marks[end], middle, ratio=ratio, why=said(
                    "the side is seen under {0}°", angle)) for (start, end), middle in zip(sides, middles, strict=True)]
                circles = [board.circle(c, board.opening(c, marks[start]))
                           for c, (start, _) in zip(about, sides, strict=True)]
                for side in ("left", "right"):
                    sketch.keep("centre point", board.circles_meet(*circles, side=side))

    # ---- the result ------------------------------------------------------------------------------------------------

    def _linkage(self) -> FoundLinkage:
        """The linkage as it is drawn."""
        values, frame = self.values, self.positions[0]
        O, C = (place_of(values, letter) for letter in "OC")
        A, B = ([complex(*at) for at in values.values_of_role(name)] for name in "AB")
        if self.pivots:
            A, B = ([place(position, (at[0] - frame[0]) / frame[1]) for position in self.positions] for at in (A, B))
        long = abs(B[0] - A[0])
        carried = {"M": tuple(m for m, _ in self.positions), "N": tuple(m + long * e for m, e in self.positions)}
        linkage = FoundLinkage(O, tuple(A), tuple(B), C, carried=carried)
        return require_lengths(linkage, f"{self.task.name}: guidance", self.size, "other points")

    def drive(self) -> None:
        """Add a crank that swings OA from the first position to the last, where the linkage goes through them."""
        if not (self.points or self.pivots):
            return
        if self.linkage.travel is None:
            self.linkage = replace(self.linkage, further={"driver": None})
            return
        crank = DrivingCrank.of_linkage(self.task, self.linkage)
        A = self.sketch.roles["A"]
        ends = (A[0], A[-1]) if len(A) == len(self.positions) else self._ends_of_OA()
        crank.draw(self.sketch, self.sketch.roles["O"][0], *ends)
        self.values = self.sketch.values()
        self.linkage = replace(self.linkage, further={"driver": crank.results})

    def _ends_of_OA(self) -> tuple[Mark, Mark]:  # noqa: N802
        """Of pivots that are given: A in the first position, and carried by the plane into the last."""
        board, M, E = self.sketch.board, self.M, self.sketch.roles["E"]
        A = self.sketch.roles["A"][0]
        with self.sketch.stage(said("Driving crank"), said("the plane carries A into its last position")):
            return A, board.triangle(M[0], E[0], A, M[-1], E[-1], name=f"A_{len(M)}")
