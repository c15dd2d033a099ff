"""The construction as a LaTeX file for tkz-euclide 4 and 5: the same coordinates as for TikZ, by that package's macros.

What the package has no macro for, or would do less exactly, stays as the TikZ export writes it. Of two circles its
first crossing lies to the left of the ray of their centres; of a line and a circle, on that side from which the centre
lies to the left on the way to the second: which of them is meant is told for the pose as it is given.
"""

from __future__ import annotations

import math
from typing import Any

from graphplan.kernel.kinds import Movement
from graphplan.output.exports import tikz
from graphplan.output.exports.walk import turned_back
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.plates.drawn_step import DrawnStep, StruckArc

COMMANDS = {
    Movement.MET: r"\tkzInterLL({A},{B})({C},{D}) \tkzGetPoint{{{out}}}",
    Movement.HALVED: r"\tkzDefMidPoint({0},{1}) \tkzGetPoint{{{out}}}",
    Movement.DROPPED: r"\tkzDefPointBy[projection=onto {A}--{B}]({1}) \tkzGetPoint{{{out}}}",
    Movement.PARALLEL: r"\tkzDefLine[parallel=through {1}]({A},{B}) \tkzGetPoint{{{out}_to}}",
    Movement.PERPENDICULAR: r"\tkzDefLine[orthogonal=through {1}]({A},{B}) \tkzGetPoint{{{out}_to}}",
    Movement.LAID_OFF: r"\tkzDefPointWith[colinear=at {2},K={k}]({0},{1}) \tkzGetPoint{{{out}}}",
    Movement.ARCS_MET: r"\tkzInterCC({centre},{0})({other},{1}) \tkzGetPoints{{{first}}}{{{second}}}",
    Movement.CUT: r"\tkzInterLC({A},{B})({centre},{1}) \tkzGetPoints{{{first}}}{{{second}}}",
}
WHOLE = {Movement.LAID_OFF: r"\tkzDefPointBy[translation=from {0} to {1}]({2}) \tkzGetPoint{{{out}}}"}
CLEAR = 0.05, 0.7  # how far from a circle's centre a line passes, in radii, where its crossings are told apart well


def tkz_euclide(composition: Composition, **look: Any) -> str:
    """The construction in LaTeX that draws with tkz-euclide; see :func:`graphplan.output.exports.tikz.written`."""
    return tikz.write_picture(TkzWriter, composition, **look)


class TkzWriter(tikz.TikzWriter):
    """Writes with the macros of tkz-euclide, where it has them."""

    commands, whole, packages = {**tikz.COMMANDS, **COMMANDS}, WHOLE, ("tkz-euclide",)

    def command(self, drawn: DrawnStep) -> str | None:
        movement = drawn.step.op.movement
        unclear = movement is Movement.CUT and not CLEAR[0] < abs(_passing(drawn)) < CLEAR[1]
        return tikz.COMMANDS[movement] if unclear else super().command(drawn)

    def put(self, drawn: DrawnStep) -> None:
        if drawn.free and drawn not in self.literal:
            self.lines.append(rf"\tkzDefPoint{tikz.spot(drawn.spot)}{{{self.names[drawn]}}}")
        else:
            super().put(drawn)

    def command_texts(self, drawn: DrawnStep) -> dict[str, str]:
        """Of two crossings, which is meant."""
        texts, names = super().command_texts(drawn), (self.names[drawn], f"{self.names[drawn]}_other")
        second = turned_back(drawn)
        if drawn.step.op.movement is Movement.CUT:
            second = turned_back(drawn) != (_passing(drawn) > 0)
        texts["first"], texts["second"] = names[::-1] if second else names
        return texts

    # ---- the drawing -----------------------------------------------------------------------------------------------

    def segment(self, style: str, one: str, other: str) -> None:
        self.lines.append(rf"\tkzDrawSegment[{style}]({one},{other})")

    def stroke_by_shares(self, style: str, start: str, end: str, low: float, high: float) -> None:
        """A line by what is added to the way between two marks; a head could point back."""
        if "head" in style:
            super().stroke_by_shares(style, start, end, low, high)
        else:
            self.lines.append(rf"\tkzDrawLine[{style}, add={-low:.4f} and {high - 1:.4f}]({start},{end})")

    def arc(self, arc: StruckArc) -> None:
        """The mark that compasses leave about a point."""
        if arc.half or self.lost.intersection((arc.of, arc.mark, *arc.of.args)):
            super().arc(arc)
        else:
            ends = f"{self.centre(arc.of)},{self.names[arc.mark]}"
            self.lines.append(rf"\tkzCompass[compasses, delta={arc.before:.0f}]({ends})")

    def label(self, style: str, mark: str, off: str, text: str) -> None:
        self.lines.append(rf"\tkzLabelPoint[{style}, shift={{{off}}}]({mark}){{{text}}}")


def _passing(drawn: DrawnStep) -> float:
    """How far to the left of a line a circle's centre lies, in radii."""
    line, circle = drawn.args
    a, b, c = line.line
    return (a * circle.spot[0] + b * circle.spot[1] + c) / (math.hypot(a, b) * circle.radius)
