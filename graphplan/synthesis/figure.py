"""The figure of a synthesis: what its steps draw, and over it the mechanism, the given positions, and curves."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, groupby

import numpy as np

from graphplan.kernel.kinds import CIRCLE, POINT
from graphplan.mechanism.model import Scene
from graphplan.sheet.lettering.lettering import LetterSizes
from graphplan.sheet.plates import pens, symbols
from graphplan.sheet.plates.display import Circle, Item, Polygon, Polyline, Rect
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.plate import DrawnStep, Plate, plate_of_values
from graphplan.sheet.plates.view import View
from graphplan.synthesis import guidance
from graphplan.synthesis.gear import GearPair
from graphplan.synthesis.linkage import FoundLinkage
from graphplan.synthesis.sketch import PLAN, Synthesis, direction
from graphplan.synthesis.stroke import SlottedLever

LINK, SECOND, LATER, FAINT = Pen(0.7), Pen(0.35), Pen(0.25, "#8a8a8a"), Pen(0.18, "#8a8a8a")
PROFILE, TOOTH = Pen(0.7), Pen(0.5)
WHOLE = {"wheel circle": pens.PATH, "pitch circle": pens.WHEEL, "base circle": Pen(0.25, pens.INK, (5.0, 1.0)),
         "tip circle": pens.PATH, "profile": Pen(0.18, pens.GREY), "inflection circle": Pen(0.25, pens.GREEN),
         "return circle": Pen(0.25, pens.BROWN)}  # other circles are struck about their marks alone
UNLETTERED = ("E", "K", "P_", "O_2,", "R")  # marks of divisions and of help
MESH = "N_1", "A", "P", "B", "N_2"
CURVE_SAMPLES, CIRCLE_SAMPLES = 2000, 72
FARTHER = 1.6  # of the size of the mechanism: so far from it other marks make the figure larger
PLANE_AXIS_MM = 9.0
EDGE_MM = 5.0  # from a circle to the edge of the panel


@dataclass(frozen=True)
class SynthesisFigure:
    """The figure in its panel: `view` takes lengths to mm of paper."""

    synthesis: Synthesis
    view: View
    scene: Scene
    letters: LetterSizes

    @property
    def plate(self) -> Plate:
        """What the steps draw."""
        roles = self.synthesis.values.drawing.roles
        steps = self.synthesis.values.drawing.program.steps
        whole = {step: pen for role, pen in WHOLE.items() for step in roles.get(role, ())
                 if steps[step].op.gives == CIRCLE}
        if self.synthesis.task.kind == "stroke":  # the circles are its construction
            whole |= {step.index: pens.THIN for step in steps if step.op.gives == CIRCLE and self._fits(step.index)}
        return plate_of_values(self.synthesis.values, PLAN, self.view, self.scene, self.letters, whole=whole)

    def _circle(self, step: int) -> tuple[complex, float]:
        """The centre and the radius of a circle."""
        x, y, square = map(float, self.synthesis.values[step])
        return complex(x, y), math.sqrt(square)

    def _fits(self, step: int) -> bool:
        """Whether a circle lies in the panel, with air about it."""
        centre, radius = self._circle(step)
        rect = self.view.rect.inset(EDGE_MM, EDGE_MM, EDGE_MM, EDGE_MM)
        return all(rect.holds(self.view.spot(centre + side * radius * (1 + 1j))) for side in (-1, 1))

    def stroke_arcs(self) -> Iterator[Item]:
        """Of each circle of a stroke that does not lie in the panel the arc that has all its marks."""
        values = self.synthesis.values
        steps = values.drawing.program.steps
        places = [complex(*map(float, values[step.index])) for step in steps if step.op.gives == POINT]
        for step in (step.index for step in steps if step.op.gives == CIRCLE and not self._fits(step.index)):
            centre, radius = self._circle(step)
            turns = sorted({round(math.degrees(cmath.phase(z - centre)), 9) for z in places
                            if math.isclose(abs(z - centre), radius)})
            gaps = [(after - before) % 360 for before, after in zip(turns, [*turns[1:], *turns[:1]], strict=True)]
            if len(turns) > 1:
                begin = turns[(gaps.index(max(gaps)) + 1) % len(turns)]
                angles = np.linspace(begin, begin + 360 - max(gaps), CIRCLE_SAMPLES)
                yield self._line([centre + radius * direction(angle) for angle in angles], pens.THIN, "motion")

    def has_letter(self, mark: DrawnStep, enlarged: bool = False) -> bool:
        """Whether the name of a mark stands on the sheet, those of a mesh that is `enlarged` in its detail."""
        divided = self.synthesis.task.kind in ("conjugate", "gear") and mark.name.startswith(UNLETTERED)
        return not (divided or (enlarged and mark.name in MESH))

    def _line(self, points: Sequence[complex], pen: Pen, layer: str = "links") -> Item:
        return Polyline(pen, layer, None, tuple(map(self.view.spot, points)))

    def _joints(self, pivots: Sequence[complex], pins: Sequence[complex]) -> Iterator[Item]:
        """Pivots on the frame, and pins."""
        for at in pivots:
            yield from symbols.pivot(self.view.spot(at), (0.0, -1.0))
        yield from (symbols.revolute(self.view.spot(at)) for at in (*pivots, *pins))

    # ---- what is drawn over the steps ------------------------------------------------------------------------------

    def mechanism(self) -> Iterator[Item]:
        """The linkage in its positions, or the wheel, or the profile."""
        kind = self.synthesis.task.kind
        yield from self.given_strokes()
        if kind == "guidance":
            yield from self.curves()
        if kind == "stroke":
            yield from self.stroke_arcs()
        if self.synthesis.linkages:
            yield from self.linkages()
        elif kind == "dwell":
            yield from self.output()
        elif kind == "geneva":
            yield from self.geneva_wheel()
        elif kind == "conjugate":
            yield from self.profiles()
        elif kind == "gear":
            yield from self.wheels()

    def given_strokes(self) -> Iterator[Item]:
        """The given positions, or the path with its linkage."""
        if self.synthesis.task.kind == "guidance":
            yield from self.given_planes()
        yield from self.paths()

    def paths(self) -> Iterator[Item]:
        """The path that a task is about, the stretch of it, and the linkage that draws it."""
        synthesis = self.synthesis
        for points, pen in ((synthesis.path, pens.PATH), (synthesis.stretch, Pen(0.5, pens.RED))):
            for reached, run in groupby(points, lambda z: not cmath.isnan(z)):
                if reached:
                    yield self._line([*run], pen, "motion")
        if synthesis.given is not None:
            yield from self.linkage_with_joints(synthesis.given, LATER if synthesis.linkages else LINK)

    def output(self) -> Iterator[Item]:
        """The dyad of a dwell that hangs on the coupler's point."""
        if self.synthesis.task.request.straight:
            return
        values = self.synthesis.values
        M, D, E = (complex(*values.values_of_role(role)[0]) for role in "MDE")
        yield self._line([M, D, E], LINK)
        yield from self._joints([E], [M, D])

    def linkages(self) -> Iterator[Item]:
        """The chosen linkage in its positions over the others, of which a plane's are its cranks alone."""
        synthesis = self.synthesis
        others = [linkage for linkage in synthesis.linkages if linkage is not synthesis.linkage]
        if synthesis.task.kind == "cognates":
            for linkage in others:
                yield from self.linkage_with_joints(linkage, SECOND)
        elif synthesis.task.kind == "guidance":
            cranks = {(linkage.O, linkage.A[0]) for linkage in others} - {(synthesis.linkage.C, synthesis.linkage.B[0])}
            yield from (self._line(crank, FAINT) for crank in cranks)
        for k in reversed(range(1, len(synthesis.linkage.A))):
            yield from self.linkage_at(synthesis.linkage, k, LATER)
        yield from self.linkage_with_joints(synthesis.linkage, LINK)
        for D, K in driving_points(synthesis.linkage):
            yield self._line([D, K, synthesis.linkage.A[0]], SECOND)
            yield from self._joints([D], [K])

    def linkage_with_joints(self, linkage: FoundLinkage, pen: Pen) -> Iterator[Item]:
        """A linkage in its first position, with its joints."""
        yield from self.linkage_at(linkage, 0, pen)
        if linkage.C is None:
            along = linkage.guide.real, linkage.guide.imag
            yield symbols.block(self.view.spot(linkage.B[0]), along)
            yield from symbols.guideway(self.view.spot(linkage.B[0]), along, -1.0)
        elif isinstance(linkage, SlottedLever):
            at = self.view.spot(linkage.A[0])
            yield symbols.block(at, symbols.unit_vector(self.view.spot(linkage.C), at))
        yield from self._joints(linkage.pivots, [*{linkage.A[0], linkage.B[0]}])

    def linkage_at(self, linkage: FoundLinkage, k: int, pen: Pen) -> Iterator[Item]:
        """A linkage in one of its positions, the first with wide lines."""
        A, B = linkage.A[k], linkage.B[k]
        yield self._line([linkage.O, A], pen)
        if isinstance(linkage, SlottedLever) and linkage.C is not None:
            yield self._line([linkage.C, linkage.C + 1.25 * (A - linkage.C)], pen)
            return
        carried = [places[k] for places in linkage.carried.values()]
        yield self._line([A, B], pen)
        if carried:
            corners = symbols.hull([*map(self.view.spot, (A, B, *carried))])
            if pen is LINK:
                yield Polygon(pens.PLATE, "plates", None, corners)
            yield Polyline(Pen(0.25) if pen is LINK else FAINT, "links", None, (*corners, corners[0]))
        if linkage.C is not None:
            yield self._line([B, linkage.C], pen)

    def given_planes(self) -> Iterator[Item]:
        """The given positions of the plane: its axis from its origin."""
        for x, y, angle in self.synthesis.task.request.positions:
            (u, v), e = self.view((x, y)), direction(angle)
            yield Polyline(Pen(0.5, pens.RED), "motion", None,
                           ((u, v), (u + PLANE_AXIS_MM * e.real, v + PLANE_AXIS_MM * e.imag)))

    def curves(self) -> Iterator[Item]:
        """The curves of circle points, in the first position, and of their centres."""
        positions = [(complex(x, y), direction(angle)) for x, y, angle in self.synthesis.task.request.positions]
        if len(positions) != 4:
            return
        (m, e), rect = positions[0], self.view.rect
        low, high = (self.view.to_plan(corner) for corner in ((rect.left, rect.bottom), (rect.right, rect.top)))
        corners = [complex(x, y) for x in (low[0], high[0]) for y in (low[1], high[1])]
        reach = max(abs((corner - m) / e) for corner in corners)
        for u in np.linspace(-reach, reach, CURVE_SAMPLES):
            for w in guidance.circle_points(positions, float(u)):
                O = guidance.centre(positions, w)
                for at, pen in ((m + e * w, pens.CIRCLING_POINTS), (O, pens.CENTRE_POINTS)):
                    spot = self.view.spot(at)
                    if rect.holds(spot):
                        yield Circle(Pen(0.0, pen.colour, fill=pen.colour), "motion", None, spot,
                                     0.12 if pen is pens.CIRCLING_POINTS else 0.22)

    def geneva_wheel(self) -> Iterator[Item]:
        """The wheel with its slots, the pin, the locking arc and both pivots."""
        request, results = self.synthesis.task.request, self.synthesis.results
        C, z, R, r = complex(request.centres), request.slots, results["crank"], results["wheel"]
        half, lock = 0.06 * R, 0.82 * R
        outline: list[complex] = []
        for k in range(z):
            axis, following = (direction(180 + 180 / z + 360 * n / z) for n in (k, k + 1))
            inner = C + (request.centres - R - half) * axis
            outline += [C + r * axis - 1j * half * axis, inner - 1j * half * axis, inner + 1j * half * axis,
                        C + r * axis + 1j * half * axis]
            middle = C + request.centres * direction(180 + 360 / z + 360 * k / z)
            outline += [middle + lock * _unit((1 - t) * (C + r * axis - middle) + t * (C + r * following - middle))
                        for t in np.linspace(0.12, 0.88, CIRCLE_SAMPLES)]
        yield self._line([*outline, outline[0]], PROFILE)
        S = complex(*self.synthesis.values.values_of_role("S")[0])
        yield self._line([0j, S], LINK)
        locked = np.linspace(0, 360 - results["working"], CIRCLE_SAMPLES)  # where the pin enters, the lock lets go
        yield self._line([lock * direction(angle) for angle in locked], Pen(0.5))
        yield from self._joints([0j, C], [])
        yield Circle(Pen(0.35, fill=pens.PAPER), "pairs", None, self.view.spot(S), max(0.8, half * self.view.scale))

    def profiles(self) -> Iterator[Item]:
        """The profile of body 1 by its points, the centrodes, and the cusps."""
        results = self.synthesis.results
        yield self._line([complex(x, y) for *_, x, y in results["contacts"]], PROFILE)
        for body, pen in (("1", pens.FIXED_CENTRODE), ("2", pens.MOVING_CENTRODE)):
            yield self._line([complex(x, y) for x, y in results["centrodes"][body]], pen, "motion")
        for *_, x, y in results["cusps"]:
            yield Circle(Pen(0.35, pens.RED), "pairs", None, self.view((x, y)), 1.6)

    def wheels(self) -> Iterator[Item]:
        """Yield both wheels with all their teeth, one of the first lying at P."""
        gears = GearPair(self.synthesis.task.request, self.synthesis.task.name)
        for outline in wheel_outlines(gears):
            yield self._line([*outline, outline[0]], TOOTH)


def _unit(z: complex) -> complex:
    return z / abs(z)


def wheel_outlines(gears: GearPair) -> Iterator[list[complex]]:
    """The outlines of both wheels in mesh: a tooth of the first at P, a gap of the second."""
    (one, two), ring = gears.wheels, gears.request.internal
    at_P = 180.0 if ring else 0.0
    turned = {id(one): (0j, at_P), id(two): (complex(gears.centres), 180.0 + 180 / two.teeth)}
    for wheel in (one, two):
        centre, angle = turned[id(wheel)]
        tooth = wheel.tooth()[:-1]
        yield [centre + z * direction(angle - 360 * k / wheel.teeth) for k in range(wheel.teeth) for z in tooth]


def driving_points(linkage: FoundLinkage) -> Iterator[tuple[complex, complex]]:
    """Pivot and pin of the crank that drives a linkage, if one does."""
    if crank := linkage.further.get("driver"):
        yield complex(*crank["points"]["D"]), complex(*crank["points"]["K"])


def extent(synthesis: Synthesis) -> Rect:
    """Extent of the figure: the mechanism in its positions, and other marks close to it."""
    spots = [(z.real, z.imag) for z in core_points(synthesis)]
    box = bounding_box(spots)
    reach = FARTHER * max(box.width, box.height)
    (x, y), values = box.centre, synthesis.values
    if synthesis.task.kind != "gear":
        plotted = synthesis.task.kind == "guidance"  # points of curves have no names, and some are far off
        near = [values[step.index] for step in values.drawing.program.steps
                if step.op.gives == POINT and (step.name or not plotted)]
        spots += [(u, v) for u, v in near if math.hypot(u - x, v - y) <= reach]
    return bounding_box(spots)


def core_points(synthesis: Synthesis) -> Iterator[complex]:
    """Yield the points that must be visible."""
    linkages = synthesis.linkages if synthesis.task.kind == "cognates" else synthesis.linkages[
        synthesis.chosen:synthesis.chosen + 1]
    yield from (z for z in synthesis.path if not cmath.isnan(z))
    for linkage in (*linkages, *(() if synthesis.given is None else (synthesis.given,))):
        yield from (*linkage.pivots, *linkage.A, *linkage.B)
        yield from chain(*driving_points(linkage))
        for places in linkage.carried.values():
            yield from places
    values, kind = synthesis.values, synthesis.task.kind
    if kind == "gear":
        for outline in wheel_outlines(GearPair(synthesis.task.request, synthesis.task.name)):
            yield from outline
    elif not linkages:
        yield from (complex(*values[step.index]) for step in values.drawing.program.steps if step.op.gives == POINT)
    if kind == "geneva":
        C, reach = complex(synthesis.task.request.centres), synthesis.results["wheel"]
        yield from (C + reach * direction(90 * k) for k in range(4))
