"""Stroke: slider-crank, crank-rocker or slotted lever of a given time ratio (Ozols 1974, 22-1 and 22-4).

In the dead positions crank and coupler are in line: OB is b + r, and b - r. The chord B1 B2 is seen from O under the
angle a that the ratio gives, K = (180 + a)/(180 - a). The examples of the book are lost with its page 384; these are
the standard constructions, with its symbols.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from graphplan.errors import NoMechanism
from graphplan.kernel.numbers.arrays import sign_change
from graphplan.kernel.program import Mark
from graphplan.mechanism.numbers import number_text
from graphplan.phrases import digits, said
from graphplan.synthesis.linkage import FoundLinkage
from graphplan.synthesis.paths import extreme
from graphplan.synthesis.requests import StrokeTask
from graphplan.synthesis.sketch import Synthesis, SynthesisBoard, pair, place_of
from graphplan.synthesis.task import BEST, SynthesisTask
from graphplan.synthesis.tolerances import LENGTH_TOL

ARC_SAMPLES = 720
SLOTTED_LEVER = "slotted lever"


def synthesize_stroke(task: SynthesisTask) -> Synthesis:
    """All mechanisms of a stroke task."""
    request = task.request
    find = slotted_levers if request.lever else crank_rockers if request.rocker else slider_cranks
    mechanisms = sorted(find(task), key=lambda pair: -pair[0].transmission[0])
    linkages, drawings = zip(*mechanisms, strict=True)
    return Synthesis(task, drawings, linkages, dict(linkages[0].further))


def ratio_of(angle: float) -> float:
    """The time ratio of the angle between the dead positions."""
    return (180 + angle) / (180 - angle)


# ---- slider-crank ---------------------------------------------------------------------------------------------------


def slider_cranks(task: SynthesisTask) -> Iterator[tuple[FoundLinkage, Any]]:
    """The slider-crank of a stroke, with its offset, crank or rod."""
    request = task.request
    offset = slider_offset(task)
    s, e, a = request.stroke, abs(offset), math.radians(request.angle)
    if request.angle == 0:  # a central one, whose rod is given
        b, r = request.given[1], s / 2
    else:
        difference = e * s / math.sin(a)
        total = (s * s + 2 * difference * math.cos(a)) / 2
        b, r = math.sqrt((total + difference) / 2), math.sqrt((total - difference) / 2)
    side = -1 if offset >= 0 else 1
    outer = complex(math.sqrt((b + r) ** 2 - e * e), side * e)
    inner = outer - s
    sketch = SynthesisBoard()
    B1, B2 = sketch.given(outer, "B_1", "B"), sketch.given(inner, "B_2", "B")
    board = sketch.board
    law = said("the chord B_1 B_2 is seen from O under {0}°", digits(request.angle))
    with sketch.stage(said("Centre O"), law):
        chord = sketch.keep("guide", board.line(B2, B1))
        if request.angle == 0:
            O = sketch.keep("O", sketch.keep("offset", board.lay_along(chord, B1, length=-(b + r), name="O")))
        else:
            arc = _on_arc(sketch, B1, B2, request.angle, side < 0)
            O = (_at_offset(sketch, chord, B1, arc, offset) if request.given[0] == "offset"
                 else _at_size(sketch, (B1, B2), arc, request, (outer, inner)))
    with sketch.stage(CRANK, DEAD):
        draw_crank_and_rod(sketch, O, B1, B2)
    values = sketch.values()
    # O is the origin of the results
    place = place_of(values, "O")
    A = tuple(complex(*at) - place for at in values.values_of_role("A"))
    linkage = FoundLinkage(0j, A, (outer - place, inner - place), guide=1 + 0j, names=("O", "A", "B"), whole_turn=True)
    yield _with_dead(task, linkage), values


def _on_arc(sketch: SynthesisBoard, B1: Mark, B2: Mark, angle: float, above: bool) -> Mark:
    """The arc from which the chord is seen under an angle."""
    board = sketch.board
    middle = board.midpoint(B2, B1)
    centre = middle if abs(angle - 90) <= LENGTH_TOL else sketch.keep(
        "arc centre", board.step_across(B2, B1, middle, ratio=_arc_ratio(angle, above), name="F"))
    return sketch.keep("arc", board.circle(centre, board.opening(centre, B1)))


def _arc_ratio(angle: float, above: bool) -> float:
    """Distance of that arc's centre to the left of the chord from B2 to B1, in chords."""
    return (0.5 if above else -0.5) / math.tan(math.radians(angle))


def _arc_centre(outer: complex, inner: complex, angle: float, above: bool) -> complex:
    """Place of that centre; `outer` and `inner` are B1 and B2."""
    return (outer + inner) / 2 + 1j * _arc_ratio(angle, above) * (outer - inner)


def _at_offset(sketch: SynthesisBoard, chord: Mark, B1: Mark, arc: Mark, offset: float) -> Mark:
    """O on the arc at its distance from the guide, the crossing that has B2 nearer."""
    board = sketch.board
    across = board.perpendicular(chord, B1)
    H = sketch.keep("offset", board.lay_along(across, B1, length=offset, name="H"))
    return sketch.keep("O", board.line_meets_circle(board.parallel(chord, H), arc, way="back", name="O"))


def _at_size(sketch: SynthesisBoard, ends: tuple[Mark, Mark], arc: Mark, request: Any,
             places: tuple[complex, complex]) -> Mark:
    """O on the arc by the length of the crank or of the rod; `places` are those of both ends, seen from O.

    OB_2 laid on the line OB_1, towards B_1 or away from it, ends 2 r or 2 b from B_1. With O and B_2 that end makes a
    triangle of two equal sides, so that it sees the chord under 90 degrees and half the angle, or under half the angle.
    """
    board, (B1, B2), (outer, inner), (key, size) = sketch.board, ends, places, request.given
    degrees = request.angle / 2 + (90 if key == "crank" else 0)
    twice = sketch.keep("size", board.radius(length=2 * size, why=said("twice the crank") if key == "crank" else
                                             said("twice the rod")))
    above = outer.imag < 0
    F = _arc_centre(outer, inner, degrees, above)
    E = outer - 2 * size * outer / abs(outer)
    side = "left" if ((E - outer) / (F - outer)).imag > 0 else "right"
    end = board.circles_meet(board.circle(B1, twice), _on_arc(sketch, B1, B2, degrees, above), side=side, name="E",
                             why=said("the chord is seen from here under {0}°", digits(degrees)))
    return sketch.keep("O", board.line_meets_circle(board.line(B1, end), arc, way="on", name="O"))


def draw_on_arc(sketch: SynthesisBoard, marks: tuple[Mark, Mark, Mark], places: tuple[complex, ...], degrees: float,
                name: str) -> Mark:
    """A crank's pivot on the arc over the chord of its dead positions, so far from the rocker's pivot; read are the
    marks of this and of both ends, and the places of the crank's pivot and of these."""
    board, (C, B1, B2), (at_O, at_C, outer, inner) = sketch.board, marks, places
    ground = sketch.keep("ground length", board.radius(length=abs(at_O - at_C)))
    circle = sketch.keep("ground circle", board.circle(C, ground))
    if degrees == 0:
        return sketch.keep(name, board.line_meets_circle(board.line(B1, B2), circle, way="on", name=name))
    on_left = ((at_O - inner) / (outer - inner)).imag > 0
    arc = _on_arc(sketch, B1, B2, degrees, on_left)
    F = _arc_centre(outer, inner, degrees, on_left)
    side = "left" if ((at_O - F) / (at_C - F)).imag > 0 else "right"
    return sketch.keep(name, board.circles_meet(arc, circle, side=side, name=name))


def draw_crank_and_rod(sketch: SynthesisBoard, O: Mark, B1: Mark, B2: Mark, names: str = "D H_1 A_1 A_2",
                       role: str = "A") -> None:
    """r is half the difference of OB1 and OB2: A1 and A2 on the lines, from O towards B1 and away from B2."""
    board, (at_end, middle, first, last) = sketch.board, names.split()
    one, two = board.line(O, B1), board.line(O, B2)
    D = board.line_meets_circle(one, board.circle(O, board.opening(O, B2)), way="on", name=at_end)
    half = board.midpoint(D, B1, name=middle)
    crank = sketch.keep("crank circle", board.circle(O, board.opening(D, half)))
    sketch.keep(role, board.line_meets_circle(one, crank, way="on", name=first))
    sketch.keep(role, board.line_meets_circle(two, crank, way="back", name=last))


CRANK, DEAD = said("Crank and coupler"), said("OB_1 = b + r and OB_2 = b - r in the dead positions")


def slider_offset(task: SynthesisTask) -> float:
    """The offset of a slider-crank, given or from crank or rod; fails with the limit if there is no such crank."""
    request = task.request
    (key, value), s, a = request.given, request.stroke, math.radians(request.angle)
    key_path = f"{task.name}: stroke.{key}"
    if request.angle == 0:
        if key == "rod" and value > s / 2:
            return 0.0
        if key == "rod":
            raise NoMechanism(key_path, f"a rod of {number_text(value)} is no longer than half the stroke",
                              f"more than {number_text(s / 2)}")
        raise NoMechanism(key_path, "strokes that take equal times make a central slider-crank, with a crank of half "
                          "the stroke and any rod", "rod alone, or a larger ratio")
    if key == "offset":
        most = s / 2 / math.tan(a / 2)
        if not 0 < abs(value) < most:
            raise NoMechanism(key_path, f"no point at {number_text(value)} from the guide sees the stroke under "
                              f"{number_text(request.angle)} degrees", f"more than 0 and less than {number_text(most)}")
        return float(value)
    if key == "crank":
        low, high = 0.0, s / 2
        square, rod_square = value**2, (s * s - 2 * value**2 * (1 + math.cos(a))) / (2 * (1 - math.cos(a)))
    else:
        low, high = s / 2, s / (2 * math.sin(a / 2))
        square, rod_square = (s * s - 2 * value**2 * (1 - math.cos(a))) / (2 * (1 + math.cos(a))), value**2
    if not low < value < high:
        raise NoMechanism(key_path, f"{number_text(value)} does not fit the stroke and the ratio",
                          f"more than {number_text(low)} and less than {number_text(high)}")
    return float((rod_square - square) * math.sin(a) / s)


def _with_dead(task: SynthesisTask, linkage: FoundLinkage) -> FoundLinkage:
    """The linkage with its dead positions and its ratio."""
    dead = {name: {"A": pair(A), "B": pair(B)} for name, A, B in zip(("outer", "inner"), linkage.A, linkage.B,
                                                                      strict=True)}
    return replace(linkage, further={"dead": dead, "ratio": ratio_of(task.request.angle)})


# ---- crank-rocker ---------------------------------------------------------------------------------------------------


def crank_rockers(task: SynthesisTask) -> Iterator[tuple[FoundLinkage, Any]]:
    """All crank-rockers of a rocker, its swing and the ground, one for each set of lengths; or the best."""
    request = task.request
    arcs = arcs_of_centres(request)
    places = [best_place(request, f"{task.name}: stroke.rocker")] if request.ground == BEST else [
        (arc, at) for arc in arcs for at in arc.at_ground(request.ground)]
    mechanisms = [arc.draw(task, at) for arc, at in places]
    if not mechanisms:
        ranges = [f"{number_text(low)} to {number_text(high)}" for arc in arcs for low, high in arc.ground_ranges()]
        raise NoMechanism(f"{task.name}: stroke.ground",
                          f"no crank-rocker has the ground {number_text(request.ground)}",
                          f"a ground from {' or from '.join(ranges)}" if ranges else
                          "a smaller ratio, or another swing")
    yield from mechanisms


def arcs_of_centres(request: StrokeTask) -> list[ArcOfCentres]:
    """The arcs on which the crank's pivot may lie."""
    return [ArcOfCentres(request, side) for side in ((1,) if request.angle == 0 else (1, -1))]


def best_place(request: StrokeTask, where: str) -> tuple[ArcOfCentres, float]:
    """Place on the arcs with the largest least transmission angle; fails with `NoMechanism` if no crank turns."""
    least, arc, t = max((arc.best() for arc in arcs_of_centres(request)), key=lambda choice: choice[0])
    if least <= 0:
        raise NoMechanism(where, "no crank swings this rocker with that ratio", "a smaller ratio, or another swing")
    return arc, t


class ArcOfCentres:
    """The arc on which O lies, in a frame whose C is the origin and whose chord B1 B2 is upright at the right.

    `t` runs along it; of equal times it is the chord produced.
    """

    def __init__(self, request: StrokeTask, side: int):
        assert request.rocker is not None
        self.side = side
        self.c, half = float(request.rocker["length"]), math.radians(request.rocker["swing"] / 2)
        self.B = self.c * cmath.rect(1.0, half), self.c * cmath.rect(1.0, -half)
        self.angle = math.radians(request.angle)

    def centre(self, t: float) -> complex:
        """O at a place of the arc, 0 < t < 1; B[0] is the outer end of the stroke, further from O."""
        high = self.B[0].imag
        if self.angle == 0:
            return complex(self.B[0].real, -high - high * t / (1 - t))
        middle = self.B[0].real + self.side * high / math.tan(self.angle)
        radius = high / math.sin(self.angle)
        # the end of the arc is at B[1], its middle on the axis, where the crank vanishes
        start = cmath.phase((self.B[1] - middle) * self.side)
        return middle + self.side * radius * cmath.rect(1.0, start + (0 - start) * t)

    def linkage(self, t: float) -> FoundLinkage | None:
        """The crank-rocker with O there, O being the origin and C on the x-axis; None if it is not a crank-rocker."""
        O = self.centre(t)
        outer, inner = self.B
        r, b = (abs(outer - O) - abs(inner - O)) / 2, (abs(outer - O) + abs(inner - O)) / 2
        if not (r > LENGTH_TOL * self.c and b > r and abs(O) > LENGTH_TOL * self.c):
            return None
        B = tuple((end - O) * abs(O) / -O for end in self.B)
        if B[0].imag < 0:
            B = tuple(z.conjugate() for z in B)
        A = r * B[0] / abs(B[0]), -r * B[1] / abs(B[1])
        linkage = FoundLinkage(0j, A, B, complex(abs(O)), whole_turn=True)
        return linkage if linkage.type == "crank-rocker" and not linkage.defects else None

    def samples(self) -> Iterator[tuple[float, FoundLinkage]]:
        """Places of the arc with the crank-rockers that are there."""
        for k in range(1, ARC_SAMPLES):
            if (linkage := self.linkage(k / ARC_SAMPLES)) is not None:
                yield k / ARC_SAMPLES, linkage

    def ground_ranges(self) -> list[tuple[float, float]]:
        """The approximate range of ground lengths that give crank-rockers; empty without any."""
        grounds = [abs(self.centre(t)) for t, _ in self.samples()]
        return [(min(grounds), max(grounds))] if grounds else []

    def at_ground(self, ground: float) -> Iterator[float]:
        """The places of the arc that are so far from C, and have a crank-rocker."""
        for k in range(1, ARC_SAMPLES - 1):
            low, high = k / ARC_SAMPLES, (k + 1) / ARC_SAMPLES
            if (abs(self.centre(low)) - ground) * (abs(self.centre(high)) - ground) <= 0:
                t = sign_change(lambda t: abs(self.centre(t)) - ground, low, high)
                if self.linkage(t) is not None:
                    yield t

    def best(self) -> tuple[float, ArcOfCentres, float]:
        """The largest least transmission angle, and where it is."""
        def least_transmission(t: float) -> float:
            linkage = self.linkage(t)
            return 0.0 if linkage is None else linkage.transmission[0]

        t, angle = extreme(lambda places: np.array([*map(least_transmission, places)]), 1 / ARC_SAMPLES,
                           1 - 1 / ARC_SAMPLES)
        return angle, self, t

    def draw(self, task: SynthesisTask, t: float) -> tuple[FoundLinkage, Any]:
        """The construction with O there, and the linkage that is read from it."""
        linkage = self.linkage(t)
        assert linkage is not None
        assert linkage.C is not None
        request, sketch = task.request, SynthesisBoard()
        C = sketch.given(linkage.C, "C")
        first = math.degrees(cmath.phase(linkage.B[0] - linkage.C))
        swing = math.copysign(request.rocker["swing"], ((linkage.B[1] - linkage.C) / (linkage.B[0] - linkage.C)).imag)
        board = sketch.board
        with sketch.stage(said("Rocker"), said("its length and its swing")):
            length = sketch.keep("rocker length", board.radius(length=request.rocker["length"]))
            arm = sketch.keep("rocker circle", board.circle(C, length))
            rays = [sketch.keep("rocker ray", sketch.ray(C, angle)) for angle in (first, first + swing)]
            B1, B2 = (sketch.keep("B", board.line_meets_circle(ray, arm, way="on", name=name))
                      for ray, name in zip(rays, ("B_1", "B_2"), strict=True))
        law = said("the chord B_1 B_2 is seen from O under {0}°", digits(request.angle))
        with sketch.stage(said("Centre O"), law):
            O = draw_on_arc(sketch, (C, B1, B2), (0j, linkage.C, *linkage.B), request.angle, "O")
        with sketch.stage(CRANK, DEAD):
            draw_crank_and_rod(sketch, O, B1, B2)
        values = sketch.values()
        A, B = (tuple(complex(*at) for at in values.values_of_role(role)) for role in "AB")
        mechanisms = FoundLinkage(place_of(values, "O"), A, B, linkage.C, whole_turn=True)
        return _with_dead(task, mechanisms), values


# ---- slotted lever --------------------------------------------------------------------------------------------------


def slotted_levers(task: SynthesisTask) -> Iterator[tuple[FoundLinkage, Any]]:
    """The swinging slotted lever: its swing is the angle, and the crank circle touches its dead positions."""
    request, sketch = task.request, SynthesisBoard()
    O, C = sketch.given(0j, "O"), sketch.given(complex(request.lever), "C")
    board = sketch.board
    law = said("the lever swings by {0}°, and its dead positions touch the crank circle", digits(request.angle))
    with sketch.stage(said("Dead positions"), law):
        for k, angle in ((1, 180 - request.angle / 2), (2, 180 + request.angle / 2)):
            sketch.keep("A", board.foot(sketch.keep("lever", sketch.ray(C, angle)), O, name=f"A_{k}"))
        sketch.keep("crank circle", board.circle(O, board.opening(O, sketch.roles["A"][0])))
    values = sketch.values()
    A = tuple(complex(*at) for at in values.values_of_role("A"))
    yield _with_dead(task, SlottedLever(0j, A, A, complex(request.lever), whole_turn=True)), values


class SlottedLever(FoundLinkage):
    """A crank OA whose pin slides along the lever through C; B is the point of the lever under A in the first position.
    """

    @property
    def sides(self) -> dict[str, float]:
        assert self.C is not None
        return {"O A": abs(self.A[0] - self.O), "O C": abs(self.C - self.O)}

    @property
    def type(self) -> str:
        return SLOTTED_LEVER

    @property
    def defects(self) -> tuple[str, ...]:
        return ()

    @property
    def travel(self) -> tuple[float, ...] | None:
        turn = math.degrees(cmath.phase(self.A[1] / self.A[0]))
        return 0.0, abs(turn)

    @property
    def sense(self) -> int:
        return 1 if cmath.phase(self.A[1] / self.A[0]) > 0 else -1

    @property
    def transmission(self) -> tuple[float, float]:
        """The block presses perpendicular to the lever, whose point under it moves so too."""
        return 90.0, 0.0
