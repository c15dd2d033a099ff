"""The construction as a GCLC source: points of the pose, then every drawing step as commands, then the drawing.

It keeps to the language of GCLC 2022 and WinGCLC (the release under the MIT licence), of which three things matter
here. Its reader of numbers loses the minus sign before an exponent, so decimals are written out. Its `rotate` turns by
a pi of seven digits, so quarter turns are reckoned by coordinates. Its `intersec2` gives the upper of two points
first (where they are level the right one) for a line and a circle, and the lower first (or the left) for two circles,
whichever way the figure lies; the procedures at the top pick by side instead, so that a dragged point keeps its branch.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from decimal import Decimal
from itertools import pairwise

from graphplan.kernel.kinds import CIRCLE, FAILURES, LINE, OPENING, POINT
from graphplan.output.exports.figure import Figure, Object, Plan
from graphplan.output.exports.formula import Language, formula, operations
from graphplan.output.exports.live_strokes import REACH, Letter, Stroke, Traced, at_home
from graphplan.output.exports.tex import formulated
from graphplan.phrases import said
from graphplan.sheet.lettering.lettering import CAPS
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.pens import Pen

COORDINATES = {POINT: ("x", "y"), LINE: ("x", "y", "dx", "dy"), OPENING: ("r",), CIRCLE: ("x", "y", "r")}

PROCEDURES = {
    "laid_off": ("P Q t R X", "X is R moved by t times the vector PQ", """
  towards Y P Q t
  translate X P Y R"""),
    "across": ("P Q t R X", "X is R moved by t times the vector PQ, turned a quarter counter-clockwise", """
  getx a P
  gety b P
  getx c Q
  gety d Q
  getx x R
  gety y R
  expression x { x-t*(d-b) }
  expression y { y+t*(c-a) }
  point X x y"""),
    "struck": ("C r t k", "k is the circle about C with t times the opening r", """
  getx x C
  gety y C
  expression x { x+t*r }
  point P x y
  circle k C P"""),
    "farther": ("l k P Q X", "X is the crossing of the line l and the circle k that lies farther the way PQ runs", """
  intersec2 A B l k
  translate M P Q A
  getx a A
  gety b A
  getx c B
  gety d B
  getx x M
  gety y M
  if_then_else { (c-a)*(x-a)+(d-b)*(y-b)>0 } { set_equal X B } { set_equal X A }"""),
    "left": ("k m X", "X is the crossing of the circles k and m to the left of the ray of their centres", """
  getcenter K k
  getcenter M m
  intersec2 A B k m
  getx a K
  gety b K
  getx c M
  gety d M
  getx x A
  gety y A
  if_then_else { (c-a)*(y-b)-(d-b)*(x-a)>0 } { set_equal X A } { set_equal X B }"""),
    "stroke": ("P Q s t", "draws from s to t of the way from P to Q", """
  towards S P Q s
  towards T P Q t
  drawsegment S T"""),
    "dashes": ("P Q s t", "the same, dashed", """
  towards S P Q s
  towards T P Q t
  drawdashsegment S T"""),
    "swing": ("C X s t", "draws the arc about C from s degrees before X to t degrees after it", """
  expression b { 0-s }
  expression w { s+t }
  rotate S C b X
  drawarc C S w"""),
    "vector": ("P Q", "draws the vector PQ", """
  drawsegment P Q
  drawarrow P Q 1"""),
}

# The language's own commands, by the step that they make.
COMMANDS = {
    "line": "line {out} {0} {1}",
    "parallel": "parallel {out} {1} {0}",
    "perpendicular": "perp {out} {1} {0}",
    "meet": "intersec {out} {0} {1}",
    "opening": "distance {out} {0} {1}",
    "bisector": "med {out} {0} {1}",
    "midpoint": "midpoint {out} {0} {1}",
    "foot": "foot {out} {1} {0}",
}
VECTORS = {"transfer": "laid_off", "step_off": "laid_off", "quarter": "across", "step_across": "across"}
SIDES = "r", "rt", "t", "lt", "l", "lb", "b", "rb"  # where a letter stands off its mark, every 45 degrees


def gclc(figure: Figure) -> str:
    """The figure as a GCLC source (.gcl): points, steps with their sentences, strokes and letters."""
    return _Writer(figure).text()


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


@dataclass
class _Writer:
    """Writes one figure: the commands of each step, with what they need written where it is first needed."""

    figure: Figure
    lines: list[str] = field(default_factory=list)
    called: set[str] = field(default_factory=set)
    measured: set[str] = field(default_factory=set)
    held: list[str] = field(default_factory=list)

    def text(self) -> str:
        for object in self.figure.objects:
            self._step(object)
        self._drawing()
        title = [f"% {line}" for line in (self.figure.title, self.figure.source) if line]
        box = self.figure.box
        head = [*title, "", f"dim {decimal(math.ceil(box.right + 5))} {decimal(math.ceil(box.top + 5))}", ""]
        return "\n".join([*head, *self._procedures(), *self.lines]) + "\n"

    def _procedures(self) -> Iterator[str]:
        """The definitions of the procedures that are called."""
        for name, (arguments, does, block) in PROCEDURES.items():
            if name in self.called:
                yield f"% {name}: {does}\nprocedure {name} {{ {arguments} }}\n{{{block}\n}}\n"

    def _call(self, name: str, *arguments: str) -> None:
        self.called.add(name)
        self.lines.append(f"call {name} {{ {' '.join(arguments)} }}")

    # ---- steps -----------------------------------------------------------------------------------------------------

    def _step(self, object: Object) -> None:
        """What is said of a step, under what conditions, and its commands."""
        if object is self.figure.firsts.get(object.plan.name):
            self.lines += ["", f"% {self.figure.tongue(said('plan: {0}', object.plan.caption))}"]
        if object.number:
            self.lines += ["", f"% {object.number}. {object.sentence}"]
            self.lines += [f"% {self.figure.tongue(said('drawable unless {0}', FAILURES[code][0]))}"
                           for code in object.step.op.fails]
        self._made(object)

    def _made(self, object: Object) -> None:
        """The commands that make a mark: the language's own where it has them, else what its formula says."""
        op, names = object.step.op.name, [arg.id for arg in object.args]
        if object.free:
            self.lines.append(f"point {object.id} {' '.join(map(decimal, object.at))}")
        elif not at_home(object):
            self._reckoned(object)
        elif op in COMMANDS:
            self.lines.append(COMMANDS[op].format(*names, out=object.id))
        elif op in VECTORS:
            self._laid_off(object)
        elif op == "circle":
            opened = object.args[1]
            self._call("struck", object.args[0].id, opened.id, decimal(object.factor(opened)), object.id)
        elif op == "line_meets_circle":
            ends = self._way(object.args[0])
            self._call("farther", *names, *(ends if object.step.params["way"] == "on" else ends[::-1]), object.id)
        elif op == "circles_meet":
            self._call("left", *(names if object.step.params["side"] == "left" else names[::-1]), object.id)
        else:
            self._reckoned(object)

    def _laid_off(self, object: Object) -> None:
        """A multiple of a vector, from whatever plan, straight or turned a quarter."""
        P, Q, R = object.args
        times = float(object.step.params.get("ratio", 1)) * object.factor(P)
        if times == 1.0 and VECTORS[object.step.op.name] == "laid_off":
            self.lines.append(f"translate {object.id} {P.id} {Q.id} {R.id}")
        else:
            self._call(VECTORS[object.step.op.name], P.id, Q.id, decimal(times), R.id, object.id)

    def _reckoned(self, object: Object) -> None:
        """A mark by the arithmetic of its rule."""
        coordinates = [self._coordinates(arg) for arg in object.args]
        found = formula(object, coordinates, EXPRESSIONS, f"{object.id}_n")
        numbers = [f"{object.id}_{part}" for part in COORDINATES[object.kind]]
        told = [*found.terms, *zip(numbers, found.results, strict=True)]
        self.lines += [f"expression {name} {{ {text} }}" for name, text in told]
        if object.kind == OPENING:
            self.lines.append(f"number {object.id} {object.id}_r")
        elif object.kind == POINT:
            self.lines.append(f"point {object.id} {object.id}_x {object.id}_y")
            self.measured.add(f"{object.id}_x")
        elif object.kind == CIRCLE:
            self.lines.append(f"point {object.id}_at {object.id}_x {object.id}_y")
            self._call("struck", f"{object.id}_at", f"{object.id}_r", "1", object.id)
        else:
            self._through(object.id)

    def _through(self, line: str) -> None:
        """A line from a point of it and the way that it runs."""
        far = f"{decimal(REACH)}/sqrt({line}_dx*{line}_dx+{line}_dy*{line}_dy)"
        self.lines += [f"expression {line}_u {{ {line}_x+{line}_dx*{far} }}",
                       f"expression {line}_v {{ {line}_y+{line}_dy*{far} }}", f"point {line}_at {line}_x {line}_y",
                       f"point {line}_to {line}_u {line}_v", f"line {line} {line}_at {line}_to"]  # fmt: skip

    # ---- operands --------------------------------------------------------------------------------------------------

    def _coordinates(self, object: Object) -> list[str]:
        """The coordinates of an operand, as a formula reads them."""
        if object.kind == OPENING:
            return [object.id]
        if object.kind == CIRCLE:
            centre, opened = object.args
            if not at_home(object):
                return [f"{object.id}_{part}" for part in COORDINATES[CIRCLE]]
            return [*self._place(centre.id), f"({opened.id}*{decimal(object.factor(opened))})"]
        if object.kind == POINT:
            return self._place(object.id)
        (a, b), (c, d) = (self._place(end) for end in self._way(object))
        return [*self._place(self._foothold(object)), f"({c}-{a})", f"({d}-{b})"]

    def _place(self, point: str) -> list[str]:
        """The coordinates of a point, measured once."""
        if f"{point}_x" not in self.measured:
            self.measured.add(f"{point}_x")
            self.lines += [f"getx {point}_x {point}", f"gety {point}_y {point}"]
        return [f"{point}_x", f"{point}_y"]

    def _centre(self, circle: Object) -> str:
        """The centre of a circle."""
        return circle.args[0].id if at_home(circle) else f"{circle.id}_at"

    def _foothold(self, line: Object) -> str:
        """A point of a line."""
        match line.step.op.name if at_home(line) else "":
            case "line":
                return line.args[0].id
            case "parallel" | "perpendicular":
                return line.args[1].id
            case "bisector":
                self._once(f"{line.id}_at", f"midpoint {line.id}_at {line.args[0].id} {line.args[1].id}")
        return f"{line.id}_at"

    def _way(self, line: Object) -> tuple[str, str]:
        """Two points from one of which to the other a line runs, on it or beside it."""
        match line.step.op.name if at_home(line) else "":
            case "line":
                return line.args[0].id, line.args[1].id
            case "parallel":
                return self._way(line.args[0])
            case "perpendicular":
                return self._turned(line, *self._way(line.args[0]))
            case "bisector":
                return self._turned(line, line.args[0].id, line.args[1].id)
        return f"{line.id}_at", f"{line.id}_to"

    def _turned(self, line: Object, P: str, Q: str) -> tuple[str, str]:
        """The way of a line that runs a quarter turn counter-clockwise of PQ."""
        if f"{line.id}_to" not in self.measured:
            self.measured.add(f"{line.id}_to")
            self._call("across", P, Q, "1", P, f"{line.id}_to")
        return P, f"{line.id}_to"

    # ---- the drawing -----------------------------------------------------------------------------------------------

    def _drawing(self) -> None:
        """The strokes, plan by plan, in the widths and colours of the sheet."""
        for plan in self.figure.plans:
            self.lines += ["", f"% {self.figure.tongue(said('drawing: {0}', plan.caption))}"]
            traced = Traced(self.figure, plan)
            self._symbols(plan, "ground")
            self._pen(pens.LINK)
            self.lines += [f"drawsegment {one.id} {other.id}" for one, other in traced.sides]
            self._symbols(plan, "blocks", "drive")
            for stroke in traced.strokes:
                self._pen(stroke.pen)
                self._stroke(stroke)
            for swing in traced.swings:
                self._pen(pens.ARC)
                self._call("swing", self._centre(swing.made), swing.mark.id, _short(swing.before), _short(swing.after))
            self._vectors(traced)
            self._pen(pens.DOT)
            self.lines += [f"cmark {point.id}" for point in traced.dots]
            self.lines += map(self._letter, traced.letters)

    def _symbols(self, plan: Plan, *layers: str) -> None:
        """Symbols of the mechanism as they lie; nothing is filled."""
        for symbol in self.figure.drawn_symbols(plan, *layers):
            self._pen(symbol.pen)
            names = [f"s_{self.figure.symbols.index(symbol)}_{i}" for i in range(len(symbol.spots))]
            self.lines += [f"point {name} {_short(x)} {_short(y)}"
                           for name, (x, y) in zip(names, symbol.spots, strict=True)]
            ends = pairwise([*names, names[0]] if symbol.closed else names)
            self.lines += [f"drawsegment {one} {other}" for one, other in ends]

    def _stroke(self, stroke: Stroke) -> None:
        """A straight stroke along its marks, or from its one mark the way the line runs."""
        name, parts = "dashes" if stroke.pen.dash else "stroke", (_short(stroke.low), _short(stroke.high))
        if stroke.end is not None:
            self._call(name, stroke.start.id, stroke.end.id, *parts)
            return
        P, Q = self._way(stroke.made)
        self._once(f"{stroke.made.id}_on", f"translate {stroke.made.id}_on {P} {Q} {stroke.start.id}")
        self._call(name, stroke.start.id, f"{stroke.made.id}_on", *parts)

    def _vectors(self, traced: Traced) -> None:
        """Given vectors, then those that were asked for."""
        for end, start in traced.given.items():
            self._pen(pens.GIVEN[traced.quantity])
            self._call("vector", start.id, end.id)
        for arrow in traced.arrows:
            self._pen(pens.VECTORS[arrow.kind])
            self._call("vector", arrow.start.id, arrow.end.id)

    def _letter(self, letter: Letter) -> str:
        """Lettering on the side of its mark where it stands on the sheet."""
        angle = math.atan2(letter.off[1] + letter.text.size * CAPS / 2, letter.off[0])
        side = SIDES[round(angle / (math.pi / 4)) % 8]
        return f"printat_{side} {letter.mark.id} {{{formulated(letter.text.runs)}}}"

    def _pen(self, pen: Pen) -> None:
        """Width and colour, where they change."""
        red, green, blue = (int(pen.colour[i : i + 2], 16) for i in (1, 3, 5))
        taken = [f"linethickness {decimal(pen.width)}", f"color {red} {green} {blue}"]
        if taken != self.held:
            self.lines += taken
            self.held = taken

    def _once(self, name: str, command: str) -> None:
        """A mark that only serves others, made where it is first needed."""
        if name not in self.measured:
            self.measured.add(name)
            self.lines.append(command)
