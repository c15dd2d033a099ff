"""The construction as a GCLC source: points of the pose, then every drawing step as commands, then the drawing.

It keeps to the language of GCLC 2022 and WinGCLC (the release under the MIT licence), of which three things matter
here. Its reader of numbers loses the minus sign before an exponent, so decimals are written out. Its `rotate` turns by
a pi of seven digits, so quarter turns are reckoned by coordinates. Its `intersec2` gives the upper of two points
first (where they are level the right one) for a line and a circle, and the lower first (or the left) for two circles,
whichever way the figure lies; the procedures at the top pick by side instead, so that a dragged point keeps its branch.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from decimal import Decimal
from importlib.resources import files
from itertools import pairwise

from graphplan.kernel.kinds import CIRCLE, FAILURES, LINE, OPENING, POINT, Movement
from graphplan.kernel.tape.written import Language, operations
from graphplan.output.exports.formula import formula
from graphplan.output.exports.latex import formula_of_runs, lettering, points
from graphplan.output.exports.walk import REACH, Letter, TextWriter, extent, heading, parameters, turned_back
from graphplan.output.tolerances import SHIFT_TOL_MM
from graphplan.phrases import said
from graphplan.sheet.lettering.label_candidates import BALLOON
from graphplan.sheet.lettering.lettering import CAPS
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import SLIM, Circle, Rect, Spot
from graphplan.sheet.plates.drawn_step import DrawnStep, Stroke, StruckArc
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plate import Plates
from graphplan.sheet.plates.view import View

COORDINATES = {POINT: ("x", "y"), LINE: ("x", "y", "dx", "dy"), OPENING: ("r",), CIRCLE: ("x", "y", "r")}

# What makes a mark of its coordinates.
RECKONED = {
    POINT: ("point {0} {0}_x {0}_y",),
    OPENING: ("number {0} {0}_r",),
    CIRCLE: ("point {0}_at {0}_x {0}_y", "call struck {{ {0}_at {0}_r 1 {0} }}"),
    LINE: (f"expression {{0}}_u {{{{ {{0}}_x+{{0}}_dx*{REACH:g}/sqrt({{0}}_dx*{{0}}_dx+{{0}}_dy*{{0}}_dy) }}}}",
           f"expression {{0}}_v {{{{ {{0}}_y+{{0}}_dy*{REACH:g}/sqrt({{0}}_dx*{{0}}_dx+{{0}}_dy*{{0}}_dy) }}}}",
           "point {0}_at {0}_x {0}_y", "point {0}_to {0}_u {0}_v", "line {0} {0}_at {0}_to"),
}  # fmt: skip
# The language's own commands, and calls of the procedures, by the movement that they are.
COMMANDS = {
    Movement.RULED: "line {out} {0} {1}",
    Movement.PARALLEL: "parallel {out} {1} {0}",
    Movement.PERPENDICULAR: "perp {out} {1} {0}",
    Movement.MET: "intersec {out} {0} {1}",
    Movement.OPENED: "distance {out} {0} {1}",
    Movement.BISECTED: "med {out} {0} {1}",
    Movement.HALVED: "midpoint {out} {0} {1}",
    Movement.DROPPED: "foot {out} {1} {0}",
    Movement.LAID_OFF: "call laid_off {{ {0} {1} {k} {2} {out} }}",
    Movement.TURNED: "call across {{ {0} {1} {k} {2} {out} }}",
    Movement.STRUCK: "call struck {{ {0} {1} {k} {out} }}",
    Movement.CUT: "call farther {{ {0} {1} {P} {Q} {out} }}",
    Movement.ARCS_MET: "call left {{ {left} {right} {out} }}",
}
AIR = 8.0  # mm: about the picture, with room for letters
SWALLOW = {pens.OPEN: 0.7}  # how deep the heads of vectors are cut in, beside their length


def gclc(plates: Plates) -> str:
    """The construction as a GCLC source (.gcl): points, steps with their sentences, strokes and letters."""
    return _GclcWriter(move_to_corner(plates)).text()


def _strokes(plates: Plates) -> Rect:
    """The box about all that is drawn but letters; where nothing is, about the panels."""
    items = [item for plate in plates for item in (*plate.items(), *plate.mechanism)]
    return extent(items) if items else plates.box


def move_to_corner(plates: Plates) -> Plates:
    """The plates with what is drawn on them, and air for its letters, in the lower left corner of the picture."""
    box = _strokes(plates)
    dx, dy = AIR - box.left, AIR - box.bottom
    if max(abs(dx), abs(dy)) < SHIFT_TOL_MM:
        return plates

    def moved_view(view: View) -> View:
        rect, (x, y) = view.rect, view.origin
        rect_there = Rect(rect.left + dx, rect.bottom + dy, rect.right + dx, rect.top + dy)
        return replace(view, rect=rect_there, origin=(x + dx, y + dy))

    return replace(plates, views={panel: moved_view(view) for panel, view in plates.views.items()})


def decimal(number: float) -> str:
    """A number without an exponent, whatever its size, exactly."""
    return format(Decimal(repr(number + 0.0)), "f").removesuffix(".0")


def _short(number: float) -> str:
    """How much of a stroke is drawn: exact enough for a drawing."""
    return decimal(round(number, 4))


def _operand(number: float) -> str:
    """A number inside an expression."""
    return decimal(number) if number >= 0 else f"({decimal(number)})"


SIGN = "ite(abs({0})<={2}*({1}),0,ite({0}>0,1,-1))"
EXPRESSIONS = Language(_operand, operations("sqrt(max(0,{0}))", "abs({0})", SIGN))


class _GclcWriter(TextWriter):
    """Writes the commands of each step, with what they need written where it is first needed."""

    commands, whole = COMMANDS, {Movement.LAID_OFF: "translate {out} {0} {1} {2}"}

    def text(self) -> str:
        self.made: set[str] = set()  # marks that only serve others, and coordinates that are measured
        self.held: dict[str, str] = {}  # the pen that is taken up, and the letters
        self.steps()
        for plate in self.plates:
            self.lines += ["", f"% {self.say(said('drawing: {0}', plate.caption))}"]
            self.drawing(plate)
        title, box = [f"% {line}" for line in (self.title, self.source) if line], _strokes(self.plates)
        head = [*title, "", f"dim {decimal(math.ceil(box.right + AIR))} {decimal(math.ceil(box.top + AIR))}", ""]
        return "\n".join([*head, *self._procedures(), *self.lines]) + "\n"

    def _procedures(self) -> Iterator[str]:
        """The definitions of the procedures that are called."""
        called = {line.split()[1] for line in self.lines if line.startswith("call ")}
        for block in files(__package__).joinpath("procedures.gcl").read_text("utf-8").split("\n\n"):
            if block.split(":")[0].removeprefix("% ") in called:
                yield f"{block.rstrip()}\n"

    # ---- steps -----------------------------------------------------------------------------------------------------

    def step(self, drawn: DrawnStep) -> None:
        """The commands of a mark, after what it is drawable under."""
        if drawn.number:
            self.lines += [f"% {self.say(said('drawable unless {0}', FAILURES[code][0]))}"
                           for code in drawn.step.op.fails]  # fmt: skip
        super().step(drawn)

    def command_texts(self, drawn: DrawnStep) -> dict[str, str]:
        """The number that vectors are multiplied by; of two crossings, which is meant."""
        texts = {"k": decimal(parameters(drawn)["k"])}
        if drawn.step.op.movement is Movement.CUT:
            texts |= zip("QP" if turned_back(drawn) else "PQ", self._line_points(drawn.args[0]), strict=True)
        if drawn.step.op.movement is Movement.ARCS_MET:
            sides = ("right", "left") if turned_back(drawn) else ("left", "right")
            texts |= zip(sides, map(self.names.__getitem__, drawn.args), strict=True)
        return texts

    def put(self, drawn: DrawnStep) -> None:
        self.lines.append(f"point {self.names[drawn]} {' '.join(map(decimal, drawn.spot))}")

    def reckon(self, drawn: DrawnStep) -> None:
        name, coordinates = self.names[drawn], [self._coordinates(arg) for arg in drawn.args]
        expression = formula(drawn, coordinates, EXPRESSIONS, f"{name}_n")
        numbers = [f"{name}_{part}" for part in COORDINATES[drawn.kind]]
        terms = [*expression.terms, *zip(numbers, expression.results, strict=True)]
        self.lines += [f"expression {term} {{ {text} }}" for term, text in terms]
        self.lines += [line.format(name) for line in RECKONED[drawn.kind]]
        if drawn.kind == POINT:
            self.made.add(f"{name}_x")

    # ---- operands --------------------------------------------------------------------------------------------------

    def _coordinates(self, drawn: DrawnStep) -> list[str]:
        """The coordinates of an operand, as a formula reads them."""
        name = self.names[drawn]
        if drawn.kind == OPENING:
            return [name]
        if drawn.kind == POINT:
            return self._place(name)
        if drawn.kind == CIRCLE:
            centre, opened = map(self.names.__getitem__, drawn.args)
            return [*self._place(centre), f"({opened}*{decimal(parameters(drawn)['k'])})"]
        (a, b), (c, d) = (self._place(end) for end in self._line_points(drawn))
        return [*self._place(self._foothold(drawn)), f"({c}-{a})", f"({d}-{b})"]

    def _place(self, point: str) -> list[str]:
        """The coordinates of a point, measured once."""
        self._define_once(f"{point}_x", f"getx {point}_x {point}", f"gety {point}_y {point}")
        return [f"{point}_x", f"{point}_y"]

    def _foothold(self, line: DrawnStep) -> str:
        """A point of a line."""
        movement, ends = line.step.op.movement, [self.names[arg] for arg in line.args]
        if movement not in COMMANDS:
            return f"{self.names[line]}_at"
        if movement is Movement.BISECTED:
            self._define_once(f"{self.names[line]}_at", f"midpoint {self.names[line]}_at {ends[0]} {ends[1]}")
            return f"{self.names[line]}_at"
        return ends[0] if movement is Movement.RULED else ends[1]

    def _line_points(self, line: DrawnStep) -> tuple[str, str]:
        """Two points from one of which to the other a line runs, on it or beside it."""
        movement, name = line.step.op.movement, self.names[line]
        if movement not in COMMANDS:
            return f"{name}_at", f"{name}_to"
        if movement is Movement.PARALLEL:
            return self._line_points(line.args[0])
        ends = [self.names[arg] for arg in line.args]
        P, Q = self._line_points(line.args[0]) if movement is Movement.PERPENDICULAR else (ends[0], ends[1])
        if movement is Movement.RULED:
            return P, Q
        self._define_once(f"{name}_to", f"call across {{ {P} {Q} 1 {P} {name}_to }}")
        return P, f"{name}_to"

    def _define_once(self, name: str, *commands: str) -> None:
        """A mark that only serves others, or a number, made where it is first needed."""
        if name not in self.made:
            self.made.add(name)
            self.lines += commands

    # ---- the drawing -----------------------------------------------------------------------------------------------

    def stroke(self, stroke: Stroke) -> None:
        """Along its marks, or from one mark the way the line runs."""
        self._pen(stroke.pen)
        if stroke.head:
            slim = SLIM[stroke.pen.tip]
            head = 2 * math.degrees(math.atan(1 / slim)), stroke.head * math.hypot(1, 1 / slim)
            self._set_attribute("arrowstyle", *map(_short, head), _short(SWALLOW.get(stroke.pen.tip, 0.0)))
        start, end, low, high = self.names[stroke.start], self.names[stroke.end], stroke.low, stroke.high
        if stroke.head and (low, high) == (0.0, 1.0):
            self.lines.append(f"call vector {{ {start} {end} }}")
            return
        if stroke.in_mm:
            (P, Q), long = self._line_points(stroke.of), math.hypot(*heading(stroke.of))
            end = f"{self.names[stroke.of]}_on"
            self._define_once(end, f"translate {end} {P} {Q} {start}")
            low, high = low / long, high / long
        name = "arrow" if stroke.head else "dashes" if stroke.pen.dash else "stroke"
        self.lines.append(f"call {name} {{ {start} {end} {_short(low)} {_short(high)} }}")

    def arc(self, arc: StruckArc) -> None:
        self._pen(pens.ARC)
        ends = f"{self.names[arc.of.args[0]]} {self.names[arc.mark]}"
        self.lines.append(f"call swing {{ {ends} {_short(arc.before)} {_short(arc.after)} }}")

    def chain(self, pen: Pen, spots: Sequence[Spot], closed: bool) -> None:
        """A figure is filled by triangles about its first corner: all are convex."""
        names = [self._name_at(spot) for spot in spots]
        if closed and pen.fill != "none":
            self._set_attribute("color", *map(str, pens.rgb(pen.fill)))
            self.lines += [f"filltriangle {names[0]} {start} {end}" for start, end in pairwise(names[1:])]
        if pen.width:
            self._pen(pen)
            self.lines += [f"drawsegment {one} {other}" for one, other in pairwise([*names, *names[:closed]])]

    def _name_at(self, spot: Spot) -> str:
        """A joint, or a point of its own."""
        if joint := self.joints.get(spot):
            return self.names[joint]
        name = f"s_{len(self.lines)}"
        self.lines.append(f"point {name} {_short(spot[0])} {_short(spot[1])}")
        return name

    def circle(self, item: Circle, joint: DrawnStep | None) -> None:
        self._round(item.pen, self.names[joint] if joint else self._name_at(item.centre), item.radius)

    def dot(self, mark: DrawnStep, pen: Pen, radius: float) -> None:
        self._round(pen, self.names[mark], radius)

    def _round(self, pen: Pen, centre: str, radius: float) -> None:
        """A circle, filled and drawn as the pen says."""
        if pen.fill != "none":
            self._set_attribute("color", *map(str, pens.rgb(pen.fill)))
            self.lines.append(f"call disc {{ {centre} {_short(radius)} }}")
        if pen.width:
            self._pen(pen)
            self.lines.append(f"call ring {{ {centre} {_short(radius)} }}")

    def letter(self, letter: Letter) -> None:
        """Where it stands on the sheet, with its leader and the circle about it."""
        text, (x, y) = letter.text, letter.off
        if letter.leader:
            self._pen(pens.LEADER)
            self.lines.append("drawsegment "
                              + " ".join(self._point_off_mark(letter.mark, spot) for spot in letter.leader))
        if letter.ringed:
            self._round(pens.BALLOON, self._point_off_mark(letter.mark, letter.ringed), BALLOON * text.size)
        place = self._point_off_mark(letter.mark, (x, y + text.size * CAPS / 2))
        self._set_attribute("color", *map(str, pens.rgb(text.pen.colour)))
        self._set_attribute("fontsize", f"{points(text.size):.0f}")
        words = any(word.isalpha() and word[1:].islower() for run in text.runs for word in run.text.split())
        lettering_text = rf"\mbox{{{lettering(text.runs)}}}" if words else formula_of_runs(text.runs)
        self.lines.append(f"printat {place} {{{lettering_text}}}")

    def _point_off_mark(self, mark: DrawnStep, off: Spot) -> str:
        """A point so far off a mark."""
        name = f"s_{len(self.lines)}"
        self.lines.append(f"call beside {{ {self.names[mark]} {_short(off[0])} {_short(off[1])} {name} }}")
        return name

    def _pen(self, pen: Pen) -> None:
        """Width and colour."""
        self._set_attribute("linethickness", decimal(pen.width))
        self._set_attribute("color", *map(str, pens.rgb(pen.colour)))

    def _set_attribute(self, what: str, *how: str) -> None:
        """What holds for all that follows, where it changes."""
        statement = " ".join((what, *how))
        if statement != self.held.get(what):
            self.lines.append(statement)
            self.held[what] = statement
