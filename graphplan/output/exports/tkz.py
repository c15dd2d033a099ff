"""The construction as a LaTeX file for tkz-euclide 4 and 5: the same coordinates as for TikZ, by that package's macros.

What the package has no macro for, or would do less exactly, stays as the TikZ export writes it. Of two circles its
first crossing lies to the left of the ray of their centres; of a line and a circle, on that side from which the centre
lies to the left on the way to the second: which of them is meant is told for the pose as it is given.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from graphplan.output.exports.figure import Figure, Object
from graphplan.output.exports.live_strokes import Stroke, Swing, at_home
from graphplan.output.exports.tikz import LAID_OFF, MEETING, NAMES, Writer, spot

PREAMBLE = r"""\documentclass[border=4mm]{standalone}
\usepackage{amsbsy,xfp,tkz-euclide}
\usetikzlibrary{calc,arrows.meta}
"""

COMMANDS = {
    "meet": r"\tkzInterLL({A},{B})({C},{D}) \tkzGetPoint{{{out}}}",
    "midpoint": r"\tkzDefMidPoint({0},{1}) \tkzGetPoint{{{out}}}",
    "foot": r"\tkzDefPointBy[projection=onto {A}--{B}]({1}) \tkzGetPoint{{{out}}}",
    "parallel": r"\tkzDefLine[parallel=through {1}]({A},{B}) \tkzGetPoint{{{out}_to}}",
    "perpendicular": r"\tkzDefLine[orthogonal=through {1}]({A},{B}) \tkzGetPoint{{{out}_to}}",
    "transfer": r"\tkzDefPointBy[translation=from {0} to {1}]({2}) \tkzGetPoint{{{out}}}",
    "laid off": r"\tkzDefPointWith[colinear=at {2},K={times}]({0},{1}) \tkzGetPoint{{{out}}}",
    "circles_meet": r"\tkzInterCC({centre},{0})({other},{1}) \tkzGetPoints{{{first}}}{{{second}}}",
    "line_meets_circle": r"\tkzInterLC({A},{B})({centre},{1}) \tkzGetPoints{{{first}}}{{{second}}}",
}
CLEAR = 0.05, 0.95  # how far from a circle's centre a line passes, in radii, where its crossings are told apart well


def tkz_euclide(figure: Figure) -> str:
    """The figure as a standalone LaTeX file that draws with tkz-euclide."""
    return _Writer(figure).text()


@dataclass
class _Writer(Writer):
    """Writes one figure with the macros of tkz-euclide."""

    preamble = PREAMBLE + MEETING

    def made(self, object: Object) -> Iterator[str]:
        """The coordinates of a mark by the package's macros, where it has them."""
        op = object.step.op.name
        told = self._told(object)
        if op in LAID_OFF and (op != "transfer" or told["times"] != "1"):
            op = LAID_OFF[op]
        if object.free:
            yield rf"\tkzDefPoint{spot(object.at)}{{{object.id}}}"
        elif op in COMMANDS and at_home(object) and (op != "line_meets_circle" or _clear(object)):
            yield COMMANDS[op].format(*(arg.id for arg in object.args), out=object.id, **told)
        else:
            yield from super().made(object)

    def _told(self, object: Object) -> dict[str, str]:
        """What a command says beside the names of the operands: of two crossings, which is meant."""
        told, names = super()._told(object), (object.id, f"{object.id}_other")
        if object.step.op.name == "circles_meet":
            told["first"], told["second"] = names if object.step.params["side"] == "left" else names[::-1]
        elif object.step.op.name == "line_meets_circle":
            ahead = (object.step.params["way"] == "on") == (_passing(object) > 0)
            told["second"], told["first"] = names if ahead else names[::-1]
        return told

    # ---- the drawing -----------------------------------------------------------------------------------------------

    def segment(self, style: str, one: str, other: str) -> str:
        """A stroke from one mark to another."""
        return rf"\tkzDrawSegment[{style}]({one},{other})"

    def stroke(self, stroke: Stroke) -> str:
        """A line by what is added to the way between two marks."""
        if stroke.end is None or (stroke.low, stroke.high) == (0.0, 1.0):
            return super().stroke(stroke)
        add = f"{-stroke.low:.4f} and {stroke.high - 1:.4f}"
        return rf"\tkzDrawLine[{NAMES[stroke.pen]}, add={add}]({stroke.start.id},{stroke.end.id})"

    def swing(self, swing: Swing) -> str:
        """The mark that compasses leave about a point."""
        if swing.half:
            return super().swing(swing)
        return rf"\tkzCompass[compasses, delta={swing.before:.0f}]({self.centre(swing.made)},{swing.mark.id})"

    def label(self, mark: str, off: str, text: str) -> str:
        """Words so far off a mark."""
        return rf"\tkzLabelPoint[letter, shift={{{off}}}]({mark}){{{text}}}"


def _passing(object: Object) -> float:
    """How far to the left of a line a circle's centre lies, in radii."""
    line, circle = object.args
    a, b, c = line.line
    return (a * circle.at[0] + b * circle.at[1] + c) / (math.hypot(a, b) * circle.radius)


def _clear(object: Object) -> bool:
    """Whether the crossings of a line and a circle are told apart well."""
    return CLEAR[0] < abs(_passing(object)) < CLEAR[1]
