"""The construction as a LaTeX file for TikZ: coordinates, each by calc from those before, then what is drawn.

Every mark is a coordinate: a line has two, its ends; an opening lies on the x axis from the origin; a circle has its
rightmost point. TeX reckons with five digits after the point, so roots and the meetings of lines go through \\fpeval,
which has sixteen. It has no dimension beyond 16383 pt, so a mark that lies very far out has no coordinate: what rests
on it is given as it lies, and the file says so.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

from graphplan.kernel.kinds import CIRCLE, LINE, OPENING
from graphplan.output.exports.figure import Figure, Object
from graphplan.output.exports.formula import Language, formula, operations
from graphplan.output.exports.live_strokes import REACH, Letter, Stroke, Swing, Traced, at_home, heading
from graphplan.output.exports.tex import formulated, spelled
from graphplan.phrases import said
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Spot
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.symbols import RADIUS

GIVEN_HEAD = 3.0  # mm
FAR = 1900.0  # mm: three times as much, as in P + (B - A), is still less than TeX's longest dimension of 16383 pt

FAR_OUT = said("too far out for TeX's dimensions: what rests on it is given as it lies")
AS_IT_LIES = said("given as it lies: it rests on what TeX cannot hold")
LATIN, ENCODINGS = "T1", {"ru": "T2A", "uk": "T2A"}

PREAMBLE = r"""\documentclass[tikz,border=4mm]{standalone}
\usepackage{amsbsy,xfp}
\usetikzlibrary{calc,arrows.meta}
"""

MEETING = r"""% Where two lines meet, with the sixteen digits of \fpeval: with five pgf is half a millimetre off.
\makeatletter
\newcommand*{\spotof}[3]{\pgf@process{#1}\edef#2{\the\pgf@x}\edef#3{\the\pgf@y}}
\renewcommand*{\pgfpointintersectionoflines}[4]{{%
  \spotof{#1}\xa\ya \spotof{#2}\xb\yb \spotof{#3}\xc\yc \spotof{#4}\xd\yd
  \edef\part{\fpeval{((\xc-\xa)*(\yd-\yc)-(\yc-\ya)*(\xd-\xc))/((\xb-\xa)*(\yd-\yc)-(\yb-\ya)*(\xd-\xc))}}%
  \global\pgf@x=\fpeval{\xa+\part*(\xb-\xa)}pt\relax \global\pgf@y=\fpeval{\ya+\part*(\yb-\ya)}pt\relax}}
\makeatother
"""

EDGE = (pens.BAR.width - pens.HOLLOW.width) / 2  # mm: of a bar, which is hollow so that vectors along it show
STYLES: dict[str, tuple[Pen, str]] = {
    "construction": (pens.THIN, ""),
    "produced": (pens.PRODUCED, ""),
    "carried": (pens.NORMAL, ""),
    "locus": (pens.LOCUS, ""),
    "compasses": (pens.ARC, ""),
    "leader": (pens.LEADER, ""),
    "joint": (pens.PAIR, ", fill=white"),
    "dot": (pens.DOT, ", fill=white"),
    "origin": (pens.ORIGIN, ", fill=black"),
    "ground line": (pens.GROUND, ""),
    "hatching": (pens.HATCH, ""),
    "stand": (pens.GROUND_FILL, ", fill=white"),
    "sliding block": (pens.BLOCK, ", fill=white"),
    "arrowhead": (pens.SOLID, ", fill=black"),
    **{f"given {kind}": (pen, ", head=3") for kind, pen in pens.GIVEN.items()},
    **{kind: (pen, f", head={pens.HEADS[kind]:g}") for kind, pen in pens.VECTORS.items()},
    "link": (replace(pens.BAR, width=EDGE),
             f", double=ink{pens.HOLLOW.colour[1:]}, double distance={pens.HOLLOW.width:g}mm"),
}
NAMES = {pen: name for name, (pen, _) in reversed(STYLES.items())}

# What makes a mark, from its operands' names; {A}, {B} are the ends of its first operand, {C}, {D} of its second.
COMMANDS = {
    "meet": r"\coordinate ({out}) at (intersection of {A}--{B} and {C}--{D});",
    "midpoint": r"\coordinate ({out}) at ($({0})!0.5!({1})$);",
    "foot": r"\coordinate ({out}) at ($({A})!({1})!({B})$);",
    "opening": r"\path let \p1=($({1})-({0})$) in coordinate ({out}) at ({{\fpeval{{sqrt(\x1*\x1+\y1*\y1)}}pt}},0pt);",
    "circle": r"\coordinate ({out}) at ($({0})+{factor}*({1})$);",
    "parallel": r"\coordinate ({out}_to) at ($({1})+({B})-({A})$);",
    "perpendicular": r"\path let \p1=($({B})-({A})$) in coordinate ({out}_to) at ($({1})+({{-(\y1)}},\x1)$);",
    "laid off": r"\coordinate ({out}) at ($({2})+{times}*($({1})-({0})$)$);",
    "across": r"\path let \p1=($({1})-({0})$) in coordinate ({out}) at ($({2})+{times}*({{-(\y1)}},\x1)$);",
    "lay_off": r"\coordinate ({out}) at ($({0})+({dx},{dy})$);",
    "line_meets_circle": r"\path let \p1=($({A})!({centre})!({B})$), \p2=($(\p1)-({centre})$),"
                         "\n  " r"\p3=($({1})-({centre})$),"
                         "\n  " r"\n1={{\fpeval{{sqrt(max(0,\x3*\x3-\x2*\x2-\y2*\y2))}}pt}} in"
                         "\n  " r"coordinate ({out}) at ($(\p1)!{way}\n1!($(\p1)+({B})-({A})$)$);",
    "circles_meet": r"\path let \p1=($({other})-({centre})$), \p2=($({0})-({centre})$), \p3=($({1})-({other})$),"
                    "\n  " r"\n1={{\fpeval{{0.5+(\x2*\x2-\x3*\x3)/(\x1*\x1+\y1*\y1)/2}}}},"
                    "\n  " r"\n2={{\fpeval{{sqrt(max(0,\x2*\x2/(\x1*\x1+\y1*\y1)-\n1*\n1))}}}} in"
                    "\n  " r"coordinate ({out}) at ($({centre})+\n1*(\x1,\y1){side}\n2*({{-(\y1)}},\x1)$);",
}  # fmt: skip
LAID_OFF = {"transfer": "laid off", "step_off": "laid off", "quarter": "across", "step_across": "across"}


def tikz(figure: Figure) -> str:
    """The figure as a standalone LaTeX file that draws with TikZ and its library calc."""
    return Writer(figure).text()


def plain(number: float) -> str:
    """A number to a ten-millionth, without an exponent."""
    return f"{round(number, 7) + 0.0:.7f}".rstrip("0").rstrip(".")


def _operand(number: float) -> str:
    return f"({number!r})" if number < 0 else repr(number)


ARITHMETIC = Language(_operand, operations("sqrt(max(0,{0}))", "abs({0})", "(abs({0})<={2}*({1})?0:sign({0}))"))


@dataclass
class Writer:
    """Writes one figure: first every step, then what is drawn of it, plan by plan."""

    figure: Figure
    lines: list[str] = field(default_factory=list)
    lost: set[Object] = field(default_factory=set)  # what lies where TeX cannot reckon
    literal: set[Object] = field(default_factory=set)  # what is given as it lies

    preamble = PREAMBLE + MEETING

    def text(self) -> str:
        head = [f"% {line}" for line in (self.figure.title, self.figure.source) if line]
        box = self.figure.box
        self.lines += [*head, self._preamble() + self._styles(), r"\begin{document}", r"\begin{tikzpicture}[drawing]",
                       rf"\path[use as bounding box] ({plain(box.left)},{plain(box.bottom)}) rectangle "
                       rf"({plain(box.right)},{plain(box.top + 4)});"]  # fmt: skip
        for object in self.figure.objects:
            self._step(object)
        for plan in self.figure.plans:
            self._drawing(Traced(self.figure, plan))
        return "\n".join([*self.lines, r"\end{tikzpicture}", r"\end{document}"]) + "\n"

    def _preamble(self) -> str:
        """What the file needs: with the letters of its language."""
        code = self.figure.tongue.code
        letters = "" if code == "en" else rf"\usepackage[{ENCODINGS.get(code, LATIN)}]{{fontenc}}" "\n"
        head, packages = self.preamble.split("\n", 1)
        return f"{head}\n{letters}{packages}"

    def _styles(self) -> str:
        """The pens of the sheet, by name."""
        colours = sorted({pens.HOLLOW.colour, *(pen.colour for pen, _ in STYLES.values())})
        found = [rf"\definecolor{{ink{colour[1:]}}}{{HTML}}{{{colour[1:].upper()}}}" for colour in colours]
        found += [r"\tikzset{", "  drawing/.style={x=1mm, y=1mm, line cap=round, line join=round},",
                  "  head/.style={-{Triangle[length=#1mm, width={#1mm/3}]}, line cap=butt},",
                  r"  letter/.style={anchor=base, inner sep=0pt, font=\fontsize{7}{8}\selectfont},",
                  r"  caption/.style={anchor=south west, inner sep=0pt, font=\bfseries\fontsize{9}{10}\selectfont},"]
        for name, (pen, more) in STYLES.items():
            dashes = " ".join(f"{'off' if i % 2 else 'on'} {part:g}mm" for i, part in enumerate(pen.dash))
            dashed = f", dash pattern={dashes}" if dashes else ""
            found.append(f"  {name}/.style={{draw=ink{pen.colour[1:]}, line width={pen.width:g}mm{dashed}{more}}},")
        return "\n".join([*found, "}"])

    # ---- steps -----------------------------------------------------------------------------------------------------

    def _step(self, object: Object) -> None:
        """What is said of a step, and its coordinates."""
        if object is self.figure.firsts.get(object.plan.name):
            self.lines += ["", f"% {self.figure.tongue(said('plan: {0}', object.plan.caption))}"]
        if object.number:
            self.lines += ["", f"% {object.number}. {object.sentence}"]
        if self._out_of_reach(object):
            self.lost.add(object)
            self.lines.append(f"% ({self.figure.tongue(FAR_OUT)})")
        elif self.lost.intersection(object.args):
            self.literal.add(object)
            self.lines += [f"% ({self.figure.tongue(AS_IT_LIES)})", *self.as_it_lies(object)]
        else:
            self.lines += self.made(object)

    def _out_of_reach(self, object: Object) -> bool:
        """Whether a mark has a coordinate that is no dimension of TeX's."""
        if object.kind == OPENING:
            return object.radius > FAR
        at = nearest(object) if object.kind == LINE else object.at
        return max(map(abs, at)) + (object.radius if object.kind == CIRCLE else 0.0) > FAR

    def as_it_lies(self, object: Object) -> Iterator[str]:
        """The coordinates of a mark as numbers."""
        match object.kind:
            case "point":
                yield rf"\coordinate ({object.id}) at {spot(object.at)};"
            case "opening":
                yield rf"\coordinate ({object.id}) at ({plain(object.radius)},0);"
            case "circle":
                yield rf"\coordinate ({object.id}_at) at {spot(object.at)};"
                yield rf"\coordinate ({object.id}) at ({plain(object.at[0] + object.radius)},{plain(object.at[1])});"
            case "line":
                (x, y), (dx, dy) = nearest(object), heading(object)
                long = REACH / math.hypot(dx, dy)
                yield rf"\coordinate ({object.id}_at) at {spot((x, y))};"
                yield rf"\coordinate ({object.id}_to) at {spot((x + dx * long, y + dy * long))};"

    def made(self, object: Object) -> Iterator[str]:
        """The coordinates of a mark from those of its operands."""
        op = LAID_OFF.get(object.step.op.name, object.step.op.name)
        if object.free:
            yield from self.as_it_lies(object)
        elif op == "line" and at_home(object):
            return
        elif op in COMMANDS and at_home(object):
            yield COMMANDS[op].format(*(arg.id for arg in object.args), out=object.id, **self._told(object))
        else:
            yield from self._reckoned(object)

    def _told(self, object: Object) -> dict[str, str]:
        """What a command says beside the names of the operands."""
        ends = [end for arg in object.args if arg.kind == LINE for end in self.ends(arg)]
        told = dict(zip("ABCD", ends, strict=False))
        centres = [self.centre(arg) for arg in object.args if arg.kind == CIRCLE]
        told |= dict(zip(("centre", "other"), centres, strict=False))
        params, scale = object.step.params, object.plan.scale
        told["way"] = "-" if params.get("way") == "back" else ""
        told["side"] = "-" if params.get("side") == "right" else "+"
        told |= {part: plain(float(params[part]) * scale) for part in ("dx", "dy") if part in params}
        if object.args:
            told["times"] = plain(float(params.get("ratio", 1)) * object.factor(object.args[0]))
            told["factor"] = plain(object.factor(object.args[-1]))
        return told

    def ends(self, line: Object) -> tuple[str, str]:
        """Two coordinates from one of which to the other a line runs."""
        op = line.step.op.name
        if line in self.literal or not at_home(line):
            return f"{line.id}_at", f"{line.id}_to"
        if op == "line":
            return line.args[0].id, line.args[1].id
        return (line.args[1].id if op in COMMANDS else f"{line.id}_at"), f"{line.id}_to"

    def centre(self, circle: Object) -> str:
        """The coordinate of a circle's centre."""
        return f"{circle.id}_at" if circle in self.literal or not at_home(circle) else circle.args[0].id

    def _reckoned(self, object: Object) -> Iterator[str]:
        """A mark by the arithmetic of its rule."""
        read: dict[str, None] = {}
        found = formula(object, [self._coordinates(arg, read) for arg in object.args], ARITHMETIC)
        lets = ", ".join(rf"\p{{{name}}}=({name})" for name in read)
        begin = rf"\path let {lets} in" if read else r"\path"
        ends = {LINE: ("_at", "_to"), CIRCLE: ("_at", "")}.get(object.kind, ("",))
        told = zip(ends, self._places(object.kind, found.results), strict=True)
        made = (rf"coordinate ({object.id}{end}) at ({{\fpeval{{{x}}}mm}},{{\fpeval{{{y}}}mm}})"
                for end, (x, y) in told)
        yield "\n  ".join([begin, *made]) + ";"

    def _places(self, kind: str, results: tuple[str, ...]) -> list[tuple[str, str]]:
        """The coordinates, one pair or two, that stand for a mark."""
        if kind == OPENING:
            return [(results[0], "0")]
        x, y, *more = results
        if kind == CIRCLE:
            return [(x, y), (f"{x}+{more[0]}", y)]
        if kind == LINE:
            part = f"{REACH:g}/sqrt(({more[0]})*({more[0]})+({more[1]})*({more[1]}))"
            return [(x, y), (f"{x}+({more[0]})*{part}", f"{y}+({more[1]})*{part}")]
        return [(x, y)]

    def _coordinates(self, object: Object, read: dict[str, None]) -> list[str]:
        """The coordinates of an operand in mm, as a formula reads them; `read` are the coordinates to be looked up."""
        circle = (self.centre(object), object.id) if object.kind == CIRCLE else (object.id,)
        names = self.ends(object) if object.kind == LINE else circle
        read.update(dict.fromkeys(names))
        (x, y), *ends = [(rf"\x{{{name}}}", rf"\y{{{name}}}") for name in names]
        if object.kind == OPENING:
            return [f"({x}/1mm)"]
        rest = [f"(({end[0]}-{x})/1mm)" for end in ends]
        rest += [f"(({end[1]}-{y})/1mm)" for end in ends if object.kind == LINE]
        return [f"({x}/1mm)", f"({y}/1mm)", *rest]

    # ---- the drawing -----------------------------------------------------------------------------------------------

    def _drawing(self, traced: Traced) -> None:
        """What is drawn on one plan, from back to front."""
        left, top = plain(traced.plan.rect.left), plain(traced.plan.rect.top + 1)
        self.lines += ["", rf"\begin{{scope}} % {traced.plan.caption}",
                       rf"\node[caption] at ({left},{top}) {{{spelled(traced.plan.caption)}}};"]  # fmt: skip
        self.lines += self._symbols(traced, "ground")
        self.lines += [self.segment("link", one.id, other.id) for one, other in traced.sides
                       if not self.lost.intersection((one, other))]
        self.lines += self._symbols(traced, "blocks", "drive")
        for stroke in traced.strokes:
            lost = self.lost.intersection((stroke.made, stroke.start, stroke.end))
            self.lines.append(chain(stroke.pen, traced.ends(stroke)) if lost else self.stroke(stroke))
        for swing in traced.swings:
            lost = self.lost.intersection((swing.made, *swing.made.args))
            self.lines.append(chain(pens.ARC, traced.arc(swing).spots()) if lost else self.swing(swing))
        vectors = [(f"given {traced.quantity}", start, end) for end, start in traced.given.items()]
        vectors += [(arrow.kind, arrow.start, arrow.end) for arrow in traced.arrows]
        self.lines += [self.vector(*vector) for vector in vectors if not self.lost.intersection(vector[1:])]
        self.lines += map(self.dot, traced.dots)
        for letter in traced.letters:
            self.lines += self._letter(letter)
        self.lines.append(r"\end{scope}")

    def _symbols(self, traced: Traced, *layers: str) -> Iterator[str]:
        """Symbols of the mechanism as they lie."""
        for symbol in self.figure.drawn_symbols(traced.plan, *layers):
            yield chain(symbol.pen, symbol.spots, symbol.closed)

    def segment(self, style: str, one: str, other: str) -> str:
        """A stroke from one mark to another."""
        return rf"\draw[{style}] ({one}) -- ({other});"

    def stroke(self, stroke: Stroke) -> str:
        """A stroke by parts of the way between two marks, or from one the way that a line runs."""
        style, start = NAMES[stroke.pen], stroke.start.id
        low, high = (f"{part:.4f}" for part in (stroke.low, stroke.high))
        if stroke.end is None:
            (P, Q), long = self.ends(stroke.made), math.hypot(*heading(stroke.made))
            low, high = (f"{part * long:.4f}mm" for part in (stroke.low, stroke.high))
            end = f"($({start})+({Q})-({P})$)"
        elif stroke.low == 0.0 and stroke.high == 1.0:
            return self.segment(style, start, stroke.end.id)
        else:
            end = f"({stroke.end.id})"
        return rf"\draw[{style}] ($({start})!{low}!{end}$) -- ($({start})!{high}!{end}$);"

    def swing(self, swing: Swing) -> str:
        """An arc about a mark on it."""
        before, after = f"-{swing.before:.2f}", f"+{swing.after:.2f}"
        return (rf"\draw[compasses] let \p1=($({swing.mark.id})-({self.centre(swing.made)})$), "
                rf"\n1={{veclen(\x1,\y1)}}, \n2={{atan2(\y1,\x1)}} in"
                rf" ({self.centre(swing.made)}) +(\n2{before}:\n1) "
                rf"arc[start angle=\n2{before}, end angle=\n2{after}, radius=\n1];")

    def vector(self, style: str, start: Object, end: Object) -> str:
        """A vector; a short one has a shorter head."""
        head, full = 0.6 * math.dist(start.at, end.at), pens.HEADS.get(style, GIVEN_HEAD)
        return self.segment(f"{style}, head={head:.2f}" if head < full else style, start.id, end.id)

    def dot(self, point: Object) -> str:
        """The circle of a joint, or the dot of a mark."""
        style, radius = ("joint", RADIUS) if point.number == 0 else (NAMES[point.pen], 0.5 if point.name else 0.4)
        return rf"\draw[{style}] ({point.id}) circle[radius={radius:g}];"

    def _letter(self, letter: Letter) -> Iterator[str]:
        """Lettering off its mark, with a leader where it stands far off."""
        text = formulated(letter.text.runs)
        text = rf"$\boldsymbol{{{text}}}$" if letter.text.bold else f"${text}$"
        if letter.mark in self.lost:
            (x, y), (right, up) = letter.mark.at, letter.off
            yield rf"\node[letter] at {spot((x + right, y + up))} {{{text}}};"
            return
        if letter.leader is not None:
            yield rf"\draw[leader] ({letter.mark.id}) -- +{spot(letter.leader)};"
        yield self.label(letter.mark.id, spot(letter.off), text)

    def label(self, mark: str, off: str, text: str) -> str:
        """Words so far off a mark."""
        return rf"\node[letter] at ($({mark})+{off}$) {{{text}}};"


def spot(at: Spot) -> str:
    """A pair of numbers in mm."""
    return f"({plain(at[0])},{plain(at[1])})"


def chain(pen: Pen, spots: Iterable[Spot], closed: bool = False) -> str:
    """A stroke as it lies, from spot to spot, and back to the first where it is closed."""
    return rf"\draw[{NAMES[pen]}] {' -- '.join([*map(spot, spots), *(['cycle'] if closed else [])])};"


def nearest(line: Object) -> Spot:
    """The point of a line that is next to the middle of its plan's window."""
    (x, y), (a, b, c) = line.plan.rect.centre, line.line
    off = (a * x + b * y + c) / (a * a + b * b)
    return x - a * off, y - b * off
