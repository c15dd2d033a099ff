r"""The construction as LaTeX for TikZ: coordinates, each by calc from those before, then what is drawn.

Every mark is a coordinate: a line has two, its ends; an opening lies on the x axis from the origin; a circle has its
rightmost point. TeX reckons with five digits after the point, so roots and the meetings of lines go through \fpeval,
which has sixteen. It has no dimension beyond 16383 pt, so a mark that lies very far out has no coordinate: what rests
on it is given as it lies, and the file says so.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from graphplan.exports import latex
from graphplan.exports.code import formula
from graphplan.exports.latex import HEADS, LETTERS, NAMES, lettering
from graphplan.exports.walk import REACH, Letter, Walk, corners, extent, heading, parameters, turned_back
from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, Movement
from graphplan.kernel.tape.record import Language, operations
from graphplan.phrases import said
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.layout import captions
from graphplan.sheet.layout.screen import compose_for_column
from graphplan.sheet.lettering.label_candidates import BALLOON
from graphplan.sheet.lettering.lettering import LARGE_SHEET
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import Circle, Polygon, Spot, Text
from graphplan.sheet.plates.pens import Pen
from graphplan.sheet.plates.plate import DrawnStep, Plate, Plates, Stroke, StruckArc
from graphplan.sheet.plates.traced_motion import LAYER as MOTION

# mm: three times as much, as in P + (B - A), is still less than the longest dimension of TeX, 16383 pt
MAX_COORDINATE_MM = 1900.0
FAR_OUT = said("beyond TeX's dimensions: marks that depend on it are given by coordinates")
AS_IT_LIES = said("given by coordinates: it depends on a mark that TeX cannot hold")
BACK = "plates", MOTION, "ground", "wheels", "links"  # layers behind the steps
FRONT = "blocks", "drive", "pairs"  # layers over them
LINE_MM = 121.0  # \\linewidth of LaTeX's own documents in 10 points: where it is wider, letters have more room
MAX_OVERLAP_MM = 0.2  # mm that lettering may reach over its mark, and still stands beside it

# How far the foot on the way \p1 of the point that lies at \p2 is: pgf's own is a tenth of a millimetre off.
FOOT = "".join(rf"\n{place}={{{{\fpeval{{{{(\x1*\x2+\y1*\y2)/(\x1*\x1+\y1*\y1)*\{part}1}}}}pt}}}}" + ", " * (place == 1)
               for place, part in ((1, "x"), (2, "y")))  # fmt: skip

# What makes a mark, from its operands' names; {A}, {B} are the ends of its first operand, {C}, {D} of its second.
COMMANDS = {
    Movement.RULED: "",
    Movement.MET: r"\coordinate ({out}) at (intersection of {A}--{B} and {C}--{D});",
    Movement.HALVED: r"\coordinate ({out}) at ($({0})!0.5!({1})$);",
    Movement.DROPPED: r"\path let \p1=($({B})-({A})$), \p2=($({1})-({A})$), " + FOOT + " in"
                      "\n  " r"coordinate ({out}) at ($({A})+(\n1,\n2)$);",
    Movement.OPENED: r"\path let \p1=($({1})-({0})$) in"
                     r" coordinate ({out}) at ({{\fpeval{{sqrt(\x1*\x1+\y1*\y1)}}pt}},0pt);",
    Movement.STRUCK: r"\coordinate ({out}) at ($({0})+{k}*({1})$);",
    Movement.PARALLEL: r"\coordinate ({out}_to) at ($({1})+({B})-({A})$);",
    Movement.PERPENDICULAR: r"\path let \p1=($({B})-({A})$) in coordinate ({out}_to) at ($({1})+({{-(\y1)}},\x1)$);",
    Movement.LAID_OFF: r"\coordinate ({out}) at ($({2})+{k}*($({1})-({0})$)$);",
    Movement.TURNED: r"\path let \p1=($({1})-({0})$) in coordinate ({out}) at ($({2})+{k}*({{-(\y1)}},\x1)$);",
    Movement.LAID_BY_COMPONENTS: r"\coordinate ({out}) at ($({0})+({dx},{dy})$);",
    Movement.CUT: r"\path let \p1=($({B})-({A})$), \p2=($({centre})-({A})$), \p3=($({1})-({centre})$), " + FOOT
                  + ",\n  " r"\n3={{\fpeval{{sqrt(max(0,\x3*\x3+\y3*\y3-(\n1-\x2)^2-(\n2-\y2)^2)"
                  r"/(\x1*\x1+\y1*\y1))}}}} in" "\n  " r"coordinate ({out}) at ($({A})+(\n1,\n2){sign}\n3*(\x1,\y1)$);",
    Movement.ARCS_MET: r"\path let \p1=($({other})-({centre})$), \p2=($({0})-({centre})$), \p3=($({1})-({other})$),"
                    "\n  " r"\n1={{\fpeval{{0.5+(\x2*\x2-\x3*\x3)/(\x1*\x1+\y1*\y1)/2}}}},"
                    "\n  " r"\n2={{\fpeval{{sqrt(max(0,\x2*\x2/(\x1*\x1+\y1*\y1)-\n1*\n1))}}}} in"
                    "\n  " r"coordinate ({out}) at ($({centre})+\n1*(\x1,\y1){sign}\n2*({{-(\y1)}},\x1)$);",
}  # fmt: skip


def tikz(composition: Composition, *, bare: bool = False, width: float = 0.0) -> str:
    r"""Return the construction as LaTeX that draws with TikZ: a document of its own, or `bare`, to be read by another
    that uses the style.

    It is `width` mm wide, or up to 1 so much of \\linewidth, and composed anew where the sheet is wider; else as large
    as the sheet.
    """
    is_column = 0 < _mm(width) < composition.arrangement.frame.width
    if is_column:
        composition = compose_for_column(composition.plans, _mm(width), scales_told=width > 1)
        times, scales = composition.arrangement.width / _mm(width), composition.scales
        composition = replace(composition, scales=replace(scales, k_s=times * scales.k_s))
    writer, say = TikzWriter(composition.plates, composition), composition.plans.tongue
    picture = writer.picture(width, is_column)
    if not bare:
        picture = latex.standalone(picture, say.code)
    return "\n".join([*latex.head_lines([writer.title, writer.source], say, bare), *picture]) + "\n"


def _mm(width: float) -> float:
    r"""A width in mm, or up to 1 as so much of \linewidth, in mm."""
    return width if width > 1 else width * LINE_MM


def plain(number: float) -> str:
    """A number to a ten-millionth, without an exponent."""
    return f"{round(number, 7) + 0.0:.7f}".rstrip("0").rstrip(".")


def spot(at: Spot) -> str:
    """A pair of numbers in mm."""
    return f"({plain(at[0])},{plain(at[1])})"


def _operand(number: float) -> str:
    return f"({number!r})" if number < 0 else repr(number)


ARITHMETIC = Language(_operand, operations("sqrt(max(0,{0}))", "abs({0})", "(abs({0})<={2}*({1})?0:sign({0}))"))


class TikzWriter(Walk):
    """Writes first every step, then what is drawn of it, plan by plan, under the captions of a `composition`."""

    reduction = 1.0  # how many times as small as its letters are composed they are printed
    tells_scales = True  # whether the plans are as large as their scales say

    def __init__(self, plates: Plates, composition: Composition | None = None):
        super().__init__(plates)
        self.lost: set[DrawnStep] = set()  # what lies where TeX cannot reckon
        self.literal: set[DrawnStep] = set()  # what is given as it lies
        self.composition = composition
        views = {panel: view.rect for panel, view in plates.views.items()}
        self.panels = composition.arrangement.panels if composition else views

    def picture(self, width: float = 0.0, is_column: bool = False) -> list[str]:
        r"""The picture, so many mm wide, or up to 1 so much of \linewidth; where it is composed for a column of text,
        its letters are as much smaller as it is."""
        words = captions(self.composition) if self.composition else ()
        box = extent([*(item for plate in self.plates for item in self.plan_items(plate)), *words])
        if self.composition and is_column:
            box = box._replace(left=0.0, right=self.composition.arrangement.width)
            self.reduction = box.width / _mm(width)
        self.tells_scales = not width or (is_column and width > 1)
        self.far = MAX_COORDINATE_MM / max(1.0, width / box.width)
        wide = rf"{width:g}\linewidth" if width <= 1 else f"{width:g}mm"
        key = f"graphplan={wide}/{plain(box.width)}" if width else "graphplan"
        letters = self.plates.letters
        sizes = ", large sheet" if letters == LARGE_SHEET else ""
        if self.reduction > 1:
            sizes = f", {latex.letter_styles(letters.mark / self.reduction, letters.text / self.reduction)}"
        bounds = rf"\path[use as bounding box] {spot(box.corners[0])} rectangle {spot(box.corners[2])};"
        self.lines += [rf"\begin{{tikzpicture}}[{key}{sizes}]", bounds]
        self.steps()
        for plate in self.plates:
            self.lines += ["", rf"\begin{{scope}} % {plate.caption}"]
            self._caption(plate.panel)
            self.drawing(plate)
            self.lines.append(r"\end{scope}")
        return [*self.lines, r"\end{tikzpicture}"]

    def _caption(self, panel: str) -> None:
        """Write the caption of a plan, and its scales, from the top down in as many lines as the panel's width
        takes."""
        place, wide = "", rf"text width={plain(self.panels[panel].width)}\graphplanmm"
        texts = plan_caption(self.composition, panel) if self.composition else ()
        for text in (text for text in texts if text.bold or self.tells_scales):
            place = r"([yshift=-1.2\graphplanmm]plan.south west)" if place else spot((text.at[0], text.box.top))
            style = f"{'heading' if text.bold else 'caption'}={latex.points(text.size / self.reduction):g}"
            self.lines.append(rf"\node[{style}, {wide}] (plan) at {place} {{{lettering(text.runs, words=True)}}};")

    # ---- steps -----------------------------------------------------------------------------------------------------

    def steps(self) -> None:
        """Write each step's sentence as a comment, and its commands."""
        firsts = self.plates.firsts
        for mark in self.plates.all_marks:
            if mark in firsts:
                self.lines += ["", f"% {self.say(said('plan: {0}', firsts[mark].caption))}"]
            if mark.number:
                self.lines += ["", f"% {mark.number}. {mark.sentence}"]
            self.step(mark)

    def step(self, drawn: DrawnStep) -> None:
        """Write the coordinates of a mark: by a command where there is one, else by its formula, as far as TeX can
        hold them."""
        command = COMMANDS.get(drawn.step.op.movement)
        if _reach(drawn) > self.far:
            self.lost.add(drawn)
            self.lines.append(f"% ({self.say(FAR_OUT)})")
        elif self.lost.intersection(drawn.args):
            self.literal.add(drawn)
            self.lines.append(f"% ({self.say(AS_IT_LIES)})")
            self.put(drawn)
        elif drawn.free:
            self.put(drawn)
        elif command is None:
            self.reckon(drawn)
        elif command:
            names = [self.names[arg] for arg in drawn.args]
            self.lines.append(command.format(*names, out=self.names[drawn], **self.command_texts(drawn)))

    def put(self, drawn: DrawnStep) -> None:
        """The coordinates of a mark as numbers."""
        if drawn.kind == OPENING:
            places = {"": (drawn.radius, 0.0)}
        elif drawn.kind == CIRCLE:
            places = {"_at": drawn.spot, "": (drawn.spot[0] + drawn.radius, drawn.spot[1])}
        elif drawn.kind == LINE:
            (x, y), (dx, dy) = _nearest_to_middle(drawn), heading(drawn)
            long = REACH / math.hypot(dx, dy)
            places = {"_at": (x, y), "_to": (x + dx * long, y + dy * long)}
        else:
            places = {"": drawn.spot}
        self.lines += [rf"\coordinate ({self.names[drawn]}{end}) at {spot(at)};" for end, at in places.items()]

    def command_texts(self, drawn: DrawnStep) -> dict[str, str]:
        """The texts of a command beside the names of its operands."""
        texts = {name: plain(number) for name, number in parameters(drawn).items()}
        texts |= zip("ABCD", (end for arg in drawn.args if arg.kind == LINE for end in self.ends(arg)), strict=False)
        texts |= zip(("centre", "other"), (self.centre(arg) for arg in drawn.args if arg.kind == CIRCLE), strict=False)
        return {**texts, "sign": "-" if turned_back(drawn) else "+"}

    def ends(self, line: DrawnStep) -> tuple[str, str]:
        """Two coordinates from one of which to the other a line runs."""
        name, movement = self.names[line], line.step.op.movement
        if movement not in COMMANDS or line in self.literal:
            return f"{name}_at", f"{name}_to"
        if movement is Movement.RULED:
            return self.names[line.args[0]], self.names[line.args[1]]
        return self.names[line.args[1]], f"{name}_to"

    def centre(self, circle: DrawnStep) -> str:
        """The coordinate of a circle's centre."""
        return f"{self.names[circle]}_at" if circle in self.literal else self.names[circle.args[0]]

    def reckon(self, drawn: DrawnStep) -> None:
        """Write the coordinates of a mark by the arithmetic of its rule."""
        read: dict[str, None] = {}
        x, *more = formula(drawn, [self._coordinates(arg, read) for arg in drawn.args], ARITHMETIC).results
        places = {"": (x, more[0] if more else "0")}
        if drawn.kind == CIRCLE:
            places = {"_at": (x, more[0]), "": (f"{x}+{more[1]}", more[0])}
        elif drawn.kind == LINE:
            y, dx, dy = more
            unit_length = f"{REACH:g}/sqrt(({dx})*({dx})+({dy})*({dy}))"
            places = {"_at": (x, y), "_to": (f"{x}+({dx})*{unit_length}", f"{y}+({dy})*{unit_length}")}
        lets = ", ".join(rf"\p{{{name}}}=({name})" for name in read)
        coordinates = (rf"coordinate ({self.names[drawn]}{end}) at ({{\fpeval{{{x}}}}},{{\fpeval{{{y}}}}})"
                       for end, (x, y) in places.items())
        self.lines.append("\n  ".join([rf"\path let {lets} in" if read else r"\path", *coordinates]) + ";")

    def _coordinates(self, drawn: DrawnStep, read: dict[str, None]) -> list[str]:
        """The coordinates of an operand in mm, as a formula reads them; `read` are the coordinates to be looked up."""
        circle = (self.centre(drawn), self.names[drawn]) if drawn.kind == CIRCLE else (self.names[drawn],)
        names = self.ends(drawn) if drawn.kind == LINE else circle
        read.update(dict.fromkeys(names))
        (x, y), *ends = [(rf"\x{{{name}}}", rf"\y{{{name}}}") for name in names]
        lengths = [x, y, *(f"({end[0]}-{x})" for end in ends)]
        lengths += [f"({end[1]}-{y})" for end in ends if drawn.kind == LINE]
        return [rf"({length}/\graphplanmm)" for length in lengths[: 1 if drawn.kind == OPENING else None]]

    # ---- the drawing -----------------------------------------------------------------------------------------------

    def drawing(self, plate: Plate) -> None:
        """Write the ink of one plan, from back to front, each step with its letters."""
        letters: dict[int | None, list[Letter]] = {}
        for letter in self.letters(plate):
            letters.setdefault(letter.text.step, []).append(letter)
        self.items(plate, *BACK)
        for mark in plate.steps:
            self.movement(plate, mark, letters.get(mark.index, ()))
        self.items(plate, *FRONT)
        for letter in letters.get(None, ()):
            self.letter(letter)

    def items(self, plate: Plate, *layers: str) -> None:
        """Write some layers of the mechanism: what depends on its joints, and its symbols as they lie."""
        items = [item for item in self.plan_items(plate) if item.layer in layers and not isinstance(item, Text)]
        for item in sorted(items, key=lambda item: layers.index(item.layer)):
            if isinstance(item, Circle):
                self.circle(item, self.joints.get(item.centre))
            else:
                self.chain(item.pen, corners(item), isinstance(item, Polygon))

    def movement(self, plate: Plate, drawn: DrawnStep, letters: Iterable[Letter]) -> None:
        """Write the ink of one step, with the vector that it completes."""
        for stroke in (*plate.strokes(drawn), *(vector for vector in plate.vectors if vector.of is drawn)):
            self.stroke(stroke)
        for arc in plate.arcs(drawn):
            if plate.is_on_panel(arc.mark):
                self.arc(arc)
        if pen := plate.dot(drawn):
            self.dot(drawn, pen, plate.dot_radius(drawn))
        for letter in letters:
            self.letter(letter)

    def stroke(self, stroke: Stroke) -> None:
        """By parts of the way between two marks, or from one the way that a line runs."""
        head = f", {HEADS[stroke.pen.tip]}={stroke.head:.3g}" if stroke.head else ""
        style = NAMES[stroke.pen.with_fill("none")] + head
        start, end, shares = self.names[stroke.start], self.names[stroke.end], (stroke.low, stroke.high)
        if self.lost.intersection((stroke.of, stroke.start, stroke.end)):
            self._path(style, map(spot, stroke.ends))
        elif stroke.in_mm:
            P, Q = self.ends(stroke.of)
            self._path(style, (rf"($({start})!{share:.4f}\graphplanmm!($({start})+({Q})-({P})$)$)" for share in shares))
        elif shares == (0.0, 1.0):
            self._path(style, (f"({start})", f"({end})"))
        else:
            self._path(style, (rf"($({start})!{share:.4f}!({end})$)" for share in shares))

    def arc(self, arc: StruckArc) -> None:
        """An arc about its mark."""
        if self.lost.intersection((arc.of, arc.mark, *arc.of.args)):
            self._path("compasses", map(spot, arc.item.spots()))
            return
        before, after, centre = f"-{arc.before:.2f}", f"+{arc.after:.2f}", self.centre(arc.of)
        self.lines.append(
            rf"\draw[compasses] let \p1=($({self.names[arc.mark]})-({centre})$), "
            rf"\n1={{veclen(\x1,\y1)}}, \n2={{atan2(\y1,\x1)}} in ({centre}) +(\n2{before}:\n1) "
            rf"arc[start angle=\n2{before}, end angle=\n2{after}, radius=\n1];")

    def chain(self, pen: Pen, spots: Sequence[Spot], closed: bool) -> None:
        """Strokes from spot to spot: joints, or places as they lie."""
        joints = [self.joints.get(at) for at in spots]
        places = [f"({self.names[joint]})" if joint and joint not in self.lost else spot(at)
                  for joint, at in zip(joints, spots, strict=True)]
        self._path(NAMES[pen], [*places, *(["cycle"] if closed else [])])

    def _path(self, style: str, places: Iterable[str]) -> None:
        self.lines.append(rf"\draw[{style}] {' -- '.join(places)};")

    def circle(self, item: Circle, joint: DrawnStep | None) -> None:
        """The circle of a joint, or one as it lies."""
        place = f"({self.names[joint]})" if joint and joint not in self.lost else spot(item.centre)
        self.lines.append(rf"\draw[{NAMES[item.pen]}] {place} circle[radius={item.radius:g}];")

    def dot(self, mark: DrawnStep, pen: Pen, radius: float) -> None:
        """The dot of a mark."""
        if mark not in self.lost:
            self.lines.append(rf"\draw[{NAMES[pen]}] ({self.names[mark]}) circle[radius={radius:g}];")

    def letter(self, letter: Letter) -> None:
        """On that side of its mark where it stands, with a leader where it stands far off."""
        text, name, is_known = letter.text, self.names[letter.mark], letter.mark not in self.lost
        written = lettering(text.runs, text.bold)
        if letter.leader:
            ends = (letter.spot_off(end) for end in letter.leader)
            self._path("leader", (f"($({name})+{spot(off)}$)" if is_known else spot(at)
                                  for off, at in zip(letter.leader, ends, strict=True)))
        if letter.ringed:
            place = f"($({name})+{spot(letter.ringed)}$)" if is_known else spot(letter.spot_off(letter.ringed))
            self.lines.append(rf"\draw[balloon] {place} circle[radius={plain(BALLOON * text.size)}];")
        style = self._style(text)
        if is_known:
            anchor, off = _anchor(letter)
            style += f", anchor={anchor}" if anchor != "base" else ""
            self.lines.append(rf"\node[{style}] at ($({name})+{spot(off)}$) {{{written}}};")
        else:
            self.lines.append(rf"\node[{style}] at {spot(letter.spot_off(letter.off))} {{{written}}};")

    def _style(self, text: Text) -> str:
        """Style of a letter, by its object."""
        if text.pen == pens.FAINT:
            return "number"
        if text.size < self.plates.letters.mark - 0.01:
            return "small letter"
        return LETTERS.get(text.pen.colour, "letter")


def _anchor(letter: Letter) -> tuple[str, Spot]:
    """The TikZ anchor of a letter, and the offset of that side from its mark."""
    box, (x, y), middle = letter.text.box, letter.mark.spot, letter.off
    left, right, top = box.left - x, box.right - x, box.top - y
    if left > -MAX_OVERLAP_MM:
        side, across = " west", left
    elif right < MAX_OVERLAP_MM:
        side, across = " east", right
    else:
        side, across = "", middle[0]
    return (f"north{side}", (across, top)) if top < MAX_OVERLAP_MM else (f"base{side}", (across, middle[1]))


def plan_caption(composition: Composition, panel: str) -> Iterator[Text]:
    """The texts that stand over a plan."""
    rect = composition.arrangement.panels[panel]
    return (text for text in captions(composition) if rect.holds(text.at))


def _reach(drawn: DrawnStep) -> float:
    """Largest coordinate of a mark."""
    if drawn.kind == OPENING:
        return drawn.radius
    at = _nearest_to_middle(drawn) if drawn.kind == LINE else drawn.spot
    return max(map(abs, at)) + (drawn.radius if drawn.kind == CIRCLE else 0.0)


def _nearest_to_middle(line: DrawnStep) -> Spot:
    """The point of a line that is next to the middle of its plan's window."""
    (x, y), (a, b, c) = line.view.rect.centre, line.line
    off = (a * x + b * y + c) / (a * a + b * b)
    return x - a * off, y - b * off
