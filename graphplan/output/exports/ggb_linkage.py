"""The linkage of a scene in GeoGebra: its fixed pins can be dragged, its drives have a slider each, and a handle where
they turn about a fixed pin; every other point is where the relations have it.

A slider has the drive's travel, in its own sense. A handle is a point of a circle that the slider turns: both together
are how far the drive has gone. The orbit begins where the slider has the crank pin, so that the handle stays on it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from itertools import chain

from graphplan.cycle.relations import KNOT_SPANS, Relations
from graphplan.cycle.relations import WrittenRelations as WrittenRelations
from graphplan.mechanism.model import FRAME, Drive
from graphplan.mechanism.travel import sense
from graphplan.output.exports.ggb_commands import LANGUAGE, MAX_NESTING, number
from graphplan.output.exports.ggb_xml import CURVES, POINTS, Objects, empty, show_caption
from graphplan.phrases import digits
from graphplan.sheet.plates import pens

SLIDER, ROW = 260, 36  # pixels: how long a slider is, and from one to the next
ROUND = 359.99  # degrees of an orbit: a whole circle has no beginning
LAST_TURN = 359.995  # degrees: an angle beyond it is a rounded 0


def slider(k: int) -> str:
    """The label of a drive's slider."""
    return f"drive_{{{k + 1}}}"


def in_sense(drive: Drive, text: str) -> str:
    """A travel as the drive's own coordinate, or that as the travel."""
    return text if sense(drive) > 0 else f"(-({text}))"


def handle(k: int) -> str:
    """The label of a drive's handle."""
    return f"handle_{{{k + 1}}}"


class GeoGebraLinkage:
    """Enters a linkage among the objects; `labels` say what the points of the scene are called."""

    def __init__(self, relations: Relations, objects: Objects, labels: Mapping[str, str]):
        self.relations, self.objects, self.labels = relations, objects, labels
        self.scene, self.places = relations.scene, relations.places

    def enter(self, pin: Callable[[str, tuple[str, ...]], None]) -> WrittenRelations:
        """The pins of the frame, by what enters one with its coordinates (a free one has none), the drives and the
        numbers of all else; what the points are made of."""
        inputs: dict[str, str] = {}
        for name in self.relations.free:
            pin(name, ())
            inputs |= {f"x {name}": f"x({self.labels[name]})", f"y {name}": f"y({self.labels[name]})"}
        for name, coordinates in self.relations.write_fixed_pins(LANGUAGE, inputs).items():
            pin(name, coordinates)
        for k, drive in enumerate(self.scene.drives):
            inputs |= dict(self._drive_inputs(k, drive))
        inputs |= dict(self._states())
        return self._numbers(self.relations.write(LANGUAGE, inputs, "place", MAX_NESTING))

    def _numbers(self, found: WrittenRelations) -> WrittenRelations:
        """The terms, and the turns of links by a label each."""
        for label, text in found.terms:
            self.objects.numeric(label, text)
        turns = {link: (self.objects.numeric(self.objects.label("turn"), cos),
                        self.objects.numeric(self.objects.label("turn"), sin))
                 for link, (cos, sin) in found.turns.items()}
        return found._replace(turns=turns)

    # ---- drives ----------------------------------------------------------------------------------------------------

    def _drive_inputs(self, k: int, drive: Drive) -> Iterator[tuple[str, str]]:
        """The inputs that a drive gives: its slider's and its handle's shift together."""
        scale, gone = self.relations.view.scale, in_sense(drive, slider(k))
        self._slider(k, drive)
        if drive.slides:
            yield f"shift {k}", self.objects.numeric(f"travel_{{{k + 1}}}", f"{number(scale)} * {gone}")
            return
        turned = self._handle(k, drive)
        shift = self.objects.numeric(f"travel_{{{k + 1}}}", f"{gone} + {turned}" if turned else gone)
        for function in ("cos", "sin"):
            yield f"{function} {k}", self.objects.numeric(f"{function}travel_{{{k + 1}}}".replace("travel", "drive"),
                                                          f"{function}({shift}°)")
        if f"shift {k}" in self.relations.used_inputs:  # where it is counted how far links have turned in all
            within = in_sense(drive, self._round(in_sense(drive, shift), k))  # not in °: GeoGebra takes off whole turns
            yield f"shift {k}", self.objects.numeric(f"turned_{{{k + 1}}}", f"({within}) * {number(math.radians(1))}")

    def _limits(self, k: int, drive: Drive) -> tuple[float, float]:
        """From where to where the slider goes, in degrees or scene lengths."""
        if k or self.scene.drives[0].slides != drive.slides:
            return (-360.0, 360.0) if not drive.slides else (-self.scene.extent, self.scene.extent)
        low, high = self.relations.limits
        unit = self.relations.view.scale if drive.slides else math.radians(1.0)
        return low / unit, high / unit

    def _slider(self, k: int, drive: Drive) -> None:
        element = self.objects.element("numeric", slider(k), True, True, pens.LETTERS, POINTS)
        low, high = self._limits(k, drive)
        empty(element, "value", val=0.0)
        sign, unit = ("s", f" {self.scene.units.length}") if drive.slides else ("φ", "°")
        show_caption(element, f"{sign}_{{{drive.link}}} = %v{unit}")
        empty(element, "slider", min=low, max=high, absoluteScreenLocation=True, width=SLIDER, x=20, y=40 + ROW * k,
              fixed=True, horizontal=True, showAlgebra=True)
        whole = high - low > 359.0 and not drive.slides
        empty(element, "animation", step=float(digits((high - low) / 360, 1)), speed=1.0, type=1 if whole else 0,
              playing=False)

    def _handle(self, k: int, drive: Drive) -> str:
        """How far the handle has turned the drive, in degrees; nothing where it has none."""
        points, frame = self.scene.links[drive.link], self.scene.links.get(FRAME, ())
        pivots = [point for point in points if drive.on == FRAME and point in frame]
        pins = [point for point in points if point not in frame]
        if not pivots or not pins:
            return ""
        arm, pivot = self.places[pins[0]] - self.places[pivots[0]], self.labels[pivots[0]]
        x, y, angle = number(arm.real), number(arm.imag), f"{in_sense(drive, slider(k))}°"
        begin = self.objects.numeric(self.objects.label("pin"), f"{pivot} + ({x} * cos({angle}) - {y} * sin({angle}), "
                                     f"{x} * sin({angle}) + {y} * cos({angle}))", "point", type="point")
        orbit = f"orbit_{{{k + 1}}}"
        self.objects.command("CircleArc", [pivot, begin, f"Rotate[{begin}, {ROUND}°, {pivot}]"], [orbit])
        self.objects.element("conicpart", orbit, False, False, pens.THIN, CURVES)
        self.objects.command("Point", [orbit], [handle(k)])
        element = self.objects.element("point", handle(k), True, False, pens.PAIR, POINTS)
        at = self.places[pins[0]]
        empty(element, "coords", x=at.real, y=at.imag, z=1.0)
        empty(element, "pointSize", val=6)
        empty(element, "pointStyle", val=2)
        turned = self.objects.numeric(self.objects.label("turn"), f"Angle[{begin}, {pivot}, {handle(k)}] / (1°)")
        return f"{turned} - 360 * floor({turned} / {LAST_TURN})"

    def _round(self, travel: str, k: int) -> str:
        """The first drive's travel, in degrees, within the round that the knots tell; any other travel as it is."""
        knots = self.relations.knots
        if k or knots is None or self.scene.drives[0].slides:
            return travel
        period = 360 * max(1, round((knots.high - knots.low) / math.tau))
        low = math.degrees((knots.low + knots.high) / 2) - period / 2
        return f"({travel} - {period} * floor(({travel} - {number(low)}) / {period}))"

    # ---- where Newton's steps begin --------------------------------------------------------------------------------

    def _states(self) -> Iterator[tuple[str, str]]:
        """The inputs of states: straight between the knots around the first drive's travel."""
        knots, used_inputs = self.relations.knots, self.relations.used_inputs
        states = sorted({int(name.split()[-1]) for name in used_inputs if "state" in name})
        if knots is None:
            yield from chain.from_iterable(((f"cos state {i}", "1"), (f"sin state {i}", "0"), (f"state {i}", "0"))
                                           for i in states)
            return
        travel = self._round(in_sense(self.scene.drives[0], "travel_{1}"), 0)
        unit = 1.0 if self.scene.drives[0].slides else math.radians(1.0)
        share = f"({travel} - {number(knots.low / unit)}) / {number((knots.high - knots.low) / unit)}"
        done = self.objects.numeric("knot_{1}", f"Min[1, Max[0, {share}]]")
        far = self.objects.numeric("knot_{2}", f"{number(KNOT_SPANS / math.pi)} * acos(1 - 2 * {done})")
        k = self.objects.numeric("knot_{3}", f"Min[{KNOT_SPANS}, floor({far}) + 1]")
        for i in states:
            values = f"knots_{{{i}}}"
            numbers = ", ".join(number(round(state, 7)) for state in knots.states[i])
            self.objects.numeric(values, f"{{{numbers}}}", "list")
            before, after = (f"Element[{values}, {place}]" for place in (k, f"{k} + 1"))
            state = self.objects.numeric(f"state_{{{i}}}", f"{before} + ({far} - {k} + 1) * ({after} - {before})")
            for name, text in ((f"cos state {i}", f"cos({state})"), (f"sin state {i}", f"sin({state})")):
                if name in used_inputs:
                    yield name, self.objects.numeric(f"{name[:3]}state_{{{i}}}".replace("state", "knot"), text)
            yield f"state {i}", state
