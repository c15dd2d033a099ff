"""The construction as a LaTeX file for TikZ: coordinates, each by calc from those before, then what is drawn.

Every mark is a coordinate: a line has two, its ends; an opening lies on the x axis from the origin; a circle has its
rightmost point. TeX reckons with five digits after the point, so roots and the meetings of lines go through \\fpeval,
which has sixteen. It has no dimension beyond 16383 pt, so a mark that lies very far out has no coordinate: what rests
on it is given as it lies, and the file says so.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, Movement
from graphplan.kernel.tape.written import Language, operations
from graphplan.output.exports.formula import formula, formulated, spelled
from graphplan.output.exports.walk import REACH, Letter, Source, at_home, heading, parameters, turned_back
from graphplan.phrases import said
from graphplan.sheet.lettering.label_candidates import BALLOON
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Spot
from graphplan.sheet.plates.drawn_step import DrawnStep, Stroke, StruckArc
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plate import Plates

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

STYLES: dict[str, Pen] = {
    "construction": pens.THIN, "produced": pens.PRODUCED, "carried": pens.NORMAL, "locus": pens.LOCUS,
    "compasses": pens.ARC, "leader": pens.LEADER, "joint": pens.PAIR, "dot": pens.DOT, "origin": pens.ORIGIN,
    "bar": pens.BAR, "inside of a bar": pens.HOLLOW, "link": pens.LINK, "plate": pens.PLATE,
    "ground line": pens.GROUND, "hatching": pens.HATCH, "stand": pens.GROUND_FILL, "sliding block": pens.BLOCK,
    "arrowhead": pens.SOLID, "balloon": pens.BALLOON,
    **{f"given {kind}": pen.filled("none") for kind, pen in pens.GIVEN.items()},
    **{kind: pen.filled("none") for kind, pen in pens.VECTORS.items()},
}  # fmt: skip
HEADS = {pens.FILLED: "head", pens.WHITE: "white head", pens.OPEN: "open head"}
NAMES = {pen: name for name, pen in reversed(STYLES.items())}

# What makes a mark, from its operands' names; {A}, {B} are the ends of its first operand, {C}, {D} of its second.
COMMANDS = {
    Movement.RULED: "",
    Movement.MET: r"\coordinate ({out}) at (intersection of {A}--{B} and {C}--{D});",
    Movement.HALVED: r"\coordinate ({out}) at ($({0})!0.5!({1})$);",
    Movement.DROPPED: r"\coordinate ({out}) at ($({A})!({1})!({B})$);",
    Movement.OPENED: r"\path let \p1=($({1})-({0})$) in"
                     r" coordinate ({out}) at ({{\fpeval{{sqrt(\x1*\x1+\y1*\y1)}}pt}},0pt);",
    Movement.STRUCK: r"\coordinate ({out}) at ($({0})+{k}*({1})$);",
    Movement.PARALLEL: r"\coordinate ({out}_to) at ($({1})+({B})-({A})$);",
    Movement.PERPENDICULAR: r"\path let \p1=($({B})-({A})$) in coordinate ({out}_to) at ($({1})+({{-(\y1)}},\x1)$);",
    Movement.LAID_OFF: r"\coordinate ({out}) at ($({2})+{k}*($({1})-({0})$)$);",
    Movement.TURNED: r"\path let \p1=($({1})-({0})$) in coordinate ({out}) at ($({2})+{k}*({{-(\y1)}},\x1)$);",
    Movement.LAID_BY_COMPONENTS: r"\coordinate ({out}) at ($({0})+({dx},{dy})$);",
    Movement.CUT: r"\path let \p1=($({A})!({centre})!({B})$), \p2=($(\p1)-({centre})$),"
                         "\n  " r"\p3=($({1})-({centre})$),"
                         "\n  " r"\n1={{\fpeval{{sqrt(max(0,\x3*\x3-\x2*\x2-\y2*\y2))}}pt}} in"
                         "\n  " r"coordinate ({out}) at ($(\p1)!{back}\n1!($(\p1)+({B})-({A})$)$);",
    Movement.ARCS_MET: r"\path let \p1=($({other})-({centre})$), \p2=($({0})-({centre})$), \p3=($({1})-({other})$),"
                    "\n  " r"\n1={{\fpeval{{0.5+(\x2*\x2-\x3*\x3)/(\x1*\x1+\y1*\y1)/2}}}},"
                    "\n  " r"\n2={{\fpeval{{sqrt(max(0,\x2*\x2/(\x1*\x1+\y1*\y1)-\n1*\n1))}}}} in"
                    "\n  " r"coordinate ({out}) at ($({centre})+\n1*(\x1,\y1){sign}\n2*({{-(\y1)}},\x1)$);",
}  # fmt: skip


def tikz(plates: Plates) -> str:
    """The construction as a standalone LaTeX file that draws with TikZ and its library calc."""
    return TikzWriter(plates).text()


def plain(number: float) -> str:
    """A number to a ten-millionth, without an exponent."""
    return f"{round(number, 7) + 0.0:.7f}".rstrip("0").rstrip(".")


def spot(at: Spot) -> str:
    """A pair of numbers in mm."""
    return f"({plain(at[0])},{plain(at[1])})"


def _operand(number: float) -> str:
    return f"({number!r})" if number < 0 else repr(number)


ARITHMETIC = Language(_operand, operations("sqrt(max(0,{0}))", "abs({0})", "(abs({0})<={2}*({1})?0:sign({0}))"))


class TikzWriter(Source):
    """Writes first every step, then what is drawn of it, plan by plan."""

    live, commands, preamble = False, COMMANDS, PREAMBLE + MEETING

    def text(self) -> str:
        self.lost: set[DrawnStep] = set()  # what lies where TeX cannot reckon
        self.literal: set[DrawnStep] = set()  # what is given as it lies
        box = self.plates.box
        self.lines += [*(f"% {line}" for line in (self.title, self.source) if line), self._preamble() + _styles(),
                       r"\begin{document}", r"\begin{tikzpicture}[drawing]",
                       rf"\path[use as bounding box] ({plain(box.left)},{plain(box.bottom)}) rectangle "
                       rf"({plain(box.right)},{plain(box.top + 4)});"]  # fmt: skip
        self.steps()
        for plate in self.plates:
            self.lines += ["", rf"\begin{{scope}} % {plate.caption}",
                           rf"\node[caption] at {spot((plate.view.rect.left, plate.view.rect.top + 1))} "
                           rf"{{{spelled(plate.caption)}}};"]  # fmt: skip
            self.drawing(plate)
            self.lines.append(r"\end{scope}")
        return "\n".join([*self.lines, r"\end{tikzpicture}", r"\end{document}"]) + "\n"

    def _preamble(self) -> str:
        """What the file needs: with the letters of its language."""
        code = self.say.code
        letters = "" if code == "en" else rf"\usepackage[{ENCODINGS.get(code, LATIN)}]{{fontenc}}" "\n"
        head, packages = self.preamble.split("\n", 1)
        return f"{head}\n{letters}{packages}"

    # ---- steps -----------------------------------------------------------------------------------------------------

    def step(self, drawn: DrawnStep) -> None:
        """The coordinates of a mark, as far as TeX can hold them."""
        if _out_of_reach(drawn):
            self.lost.add(drawn)
            self.lines.append(f"% ({self.say(FAR_OUT)})")
        elif self.lost.intersection(drawn.args):
            self.literal.add(drawn)
            self.lines.append(f"% ({self.say(AS_IT_LIES)})")
            self.put(drawn)
        else:
            super().step(drawn)

    def put(self, drawn: DrawnStep) -> None:
        """The coordinates of a mark as numbers."""
        if drawn.kind == OPENING:
            places = {"": (drawn.radius, 0.0)}
        elif drawn.kind == CIRCLE:
            places = {"_at": drawn.at, "": (drawn.at[0] + drawn.radius, drawn.at[1])}
        elif drawn.kind == LINE:
            (x, y), (dx, dy) = _nearest(drawn), heading(drawn)
            long = REACH / math.hypot(dx, dy)
            places = {"_at": (x, y), "_to": (x + dx * long, y + dy * long)}
        else:
            places = {"": drawn.at}
        self.lines += [rf"\coordinate ({self.names[drawn]}{end}) at {spot(at)};" for end, at in places.items()]

    def told(self, drawn: DrawnStep) -> dict[str, str]:
        told = {name: plain(number) for name, number in parameters(drawn).items()}
        told |= zip("ABCD", (end for arg in drawn.args if arg.kind == LINE for end in self.ends(arg)), strict=False)
        told |= zip(("centre", "other"), (self.centre(arg) for arg in drawn.args if arg.kind == CIRCLE), strict=False)
        back = "-" if turned_back(drawn) else ""
        return {**told, "back": back, "sign": back or "+"}

    def ends(self, line: DrawnStep) -> tuple[str, str]:
        """Two coordinates from one of which to the other a line runs."""
        name, movement = self.names[line], line.step.op.movement
        if movement not in COMMANDS or line in self.literal or not at_home(line):
            return f"{name}_at", f"{name}_to"
        if movement is Movement.RULED:
            return self.names[line.args[0]], self.names[line.args[1]]
        return self.names[line.args[1]], f"{name}_to"

    def centre(self, circle: DrawnStep) -> str:
        """The coordinate of a circle's centre."""
        kept = at_home(circle) and circle not in self.literal
        return self.names[circle.args[0]] if kept else f"{self.names[circle]}_at"

    def reckon(self, drawn: DrawnStep) -> None:
        read: dict[str, None] = {}
        x, *more = formula(drawn, [self._coordinates(arg, read) for arg in drawn.args], ARITHMETIC).results
        places = {"": (x, more[0] if more else "0")}
        if drawn.kind == CIRCLE:
            places = {"_at": (x, more[0]), "": (f"{x}+{more[1]}", more[0])}
        elif drawn.kind == LINE:
            y, dx, dy = more
            part = f"{REACH:g}/sqrt(({dx})*({dx})+({dy})*({dy}))"
            places = {"_at": (x, y), "_to": (f"{x}+({dx})*{part}", f"{y}+({dy})*{part}")}
        lets = ", ".join(rf"\p{{{name}}}=({name})" for name in read)
        made = (rf"coordinate ({self.names[drawn]}{end}) at ({{\fpeval{{{x}}}mm}},{{\fpeval{{{y}}}mm}})"
                for end, (x, y) in places.items())
        self.lines.append("\n  ".join([rf"\path let {lets} in" if read else r"\path", *made]) + ";")

    def _coordinates(self, drawn: DrawnStep, read: dict[str, None]) -> list[str]:
        """The coordinates of an operand in mm, as a formula reads them; `read` are the coordinates to be looked up."""
        circle = (self.centre(drawn), self.names[drawn]) if drawn.kind == CIRCLE else (self.names[drawn],)
        names = self.ends(drawn) if drawn.kind == LINE else circle
        read.update(dict.fromkeys(names))
        (x, y), *ends = [(rf"\x{{{name}}}", rf"\y{{{name}}}") for name in names]
        if drawn.kind == OPENING:
            return [f"({x}/1mm)"]
        rest = [f"(({end[0]}-{x})/1mm)" for end in ends]
        rest += [f"(({end[1]}-{y})/1mm)" for end in ends if drawn.kind == LINE]
        return [f"({x}/1mm)", f"({y}/1mm)", *rest]

    # ---- the drawing -----------------------------------------------------------------------------------------------

    def stroke(self, stroke: Stroke) -> None:
        """By parts of the way between two marks, or from one the way that a line runs."""
        head = f", {HEADS[stroke.pen.tip]}={stroke.head:.3g}" if stroke.head else ""
        style = NAMES[stroke.pen.filled("none")] + head
        start, end, parts = self.names[stroke.start], self.names[stroke.end], (stroke.low, stroke.high)
        if self.lost.intersection((stroke.of, stroke.start, stroke.end)):
            self._path(style, map(spot, stroke.ends))
        elif stroke.in_mm:
            P, Q = self.ends(stroke.of)
            self._path(style, (f"($({start})!{part:.4f}mm!($({start})+({Q})-({P})$)$)" for part in parts))
        elif parts == (0.0, 1.0):
            self.segment(style, start, end)
        else:
            self.part(style, start, end, *parts)

    def segment(self, style: str, one: str, other: str) -> None:
        """A stroke from one mark to another."""
        self._path(style, (f"({one})", f"({other})"))

    def part(self, style: str, start: str, end: str, low: float, high: float) -> None:
        """A stroke by parts of the way from one mark to another."""
        self._path(style, (f"($({start})!{part:.4f}!({end})$)" for part in (low, high)))

    def arc(self, arc: StruckArc) -> None:
        if self.lost.intersection((arc.of, arc.mark, *arc.of.args)):
            self._path("compasses", map(spot, arc.item.spots()))
            return
        before, after, centre = f"-{arc.before:.2f}", f"+{arc.after:.2f}", self.centre(arc.of)
        self.lines.append(
            rf"\draw[compasses] let \p1=($({self.names[arc.mark]})-({centre})$), "
            rf"\n1={{veclen(\x1,\y1)}}, \n2={{atan2(\y1,\x1)}} in ({centre}) +(\n2{before}:\n1) "
            rf"arc[start angle=\n2{before}, end angle=\n2{after}, radius=\n1];")

    def chain(self, pen: Pen, spots: Sequence[Spot], closed: bool) -> None:
        joints = [self.joints.get(at) for at in spots]
        places = [f"({self.names[joint]})" if joint and joint not in self.lost else spot(at)
                  for joint, at in zip(joints, spots, strict=True)]
        self._path(NAMES[pen], [*places, *(["cycle"] if closed else [])])

    def _path(self, style: str, places: Iterable[str]) -> None:
        self.lines.append(rf"\draw[{style}] {' -- '.join(places)};")

    def dot(self, mark: DrawnStep, pen: Pen, radius: float) -> None:
        if mark not in self.lost:
            self.lines.append(rf"\draw[{NAMES[pen]}] ({self.names[mark]}) circle[radius={radius:g}];")

    def letter(self, letter: Letter) -> None:
        """Off its mark, with a leader where it stands far off."""
        text, name = formulated(letter.text.runs), self.names[letter.mark]
        text = rf"$\boldsymbol{{{text}}}$" if letter.text.bold else f"${text}$"
        if letter.mark in self.lost:
            self.lines.append(rf"\node[letter] at {spot(letter.text.at)} {{{text}}};")
            return
        if letter.leader:
            self._path("leader", (f"($({name})+{spot(end)}$)" for end in letter.leader))
        if letter.ringed:
            self.lines.append(rf"\draw[balloon] ($({name})+{spot(letter.ringed)}$) circle[radius={BALLOON:g}];")
        self.label("number" if letter.text.pen == pens.FAINT else "letter", name, spot(letter.off), text)

    def label(self, style: str, mark: str, off: str, text: str) -> None:
        """Words so far off a mark."""
        self.lines.append(rf"\node[{style}] at ($({mark})+{off}$) {{{text}}};")


def _styles() -> str:
    """The pens of the sheet, by name."""
    colours = sorted({colour for pen in STYLES.values() for colour in (pen.colour, pen.fill) if colour != "none"})
    found = [rf"\definecolor{{ink{colour[1:]}}}{{HTML}}{{{colour[1:].upper()}}}" for colour in colours]
    found += [r"\tikzset{", "  drawing/.style={x=1mm, y=1mm, line cap=round, line join=round},",
              "  head/.style={-{Triangle[length=#1mm, width={#1mm/3}]}, line cap=butt},",
              "  white head/.style={-{Triangle[length=#1mm, width={#1mm/2}, open, fill=white]}, line cap=butt},",
              "  open head/.style={-{Straight Barb[length=#1mm, width={#1mm/2}]}, line cap=butt},",
              r"  letter/.style={anchor=base, inner sep=0pt, font=\fontsize{7}{8}\selectfont},",
              rf"  number/.style={{letter, text=ink{pens.GREY[1:]}, font=\fontsize{{5.5}}{{6}}\selectfont}},",
              r"  caption/.style={anchor=south west, inner sep=0pt, font=\bfseries\fontsize{9}{10}\selectfont},"]
    for name, pen in STYLES.items():
        dashes = " ".join(f"{'off' if i % 2 else 'on'} {part:g}mm" for i, part in enumerate(pen.dash))
        look = [f"draw=ink{pen.colour[1:]}, line width={pen.width:g}mm" if pen.width else "draw=none"]
        look += [f"dash pattern={dashes}"] if dashes else []
        look += [f"fill=ink{pen.fill[1:]}"] if pen.fill != "none" else []
        found.append(f"  {name}/.style={{{', '.join(look)}}},")
    return "\n".join([*found, "}"])


def _out_of_reach(drawn: DrawnStep) -> bool:
    """Whether a mark has a coordinate that is no dimension of TeX's."""
    if drawn.kind == OPENING:
        return drawn.radius > FAR
    at = _nearest(drawn) if drawn.kind == LINE else drawn.at
    return max(map(abs, at)) + (drawn.radius if drawn.kind == CIRCLE else 0.0) > FAR


def _nearest(line: DrawnStep) -> Spot:
    """The point of a line that is next to the middle of its plan's window."""
    (x, y), (a, b, c) = line.view.rect.centre, line.line
    off = (a * x + b * y + c) / (a * a + b * b)
    return x - a * off, y - b * off
