r"""LaTeX for constructions and sheets: documents, letters and TikZ's picture, every stroke where it lies.

A picture is an environment tikzpicture with the key `graphplan`, by which the names of the styles are known inside it
and nowhere else. Every length in it is so many \graphplanmm, which is a millimetre unless the key has another value;
letters alone have sizes in points. It is written for pdflatex, lualatex and xelatex of 2020 and later.

What is drawn of a step stands after a comment with its sentence. Constructions have a better file, which draws them by
their steps: :mod:`graphplan.exports.tikz`; this one serves sheets of diagrams.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence

from graphplan.output.svg import round_mm, split_groups
from graphplan.phrases import said
from graphplan.sheet.lettering.lettering import GREEK, LARGE_SHEET, SMALL_SHEET, Runs, TextRun
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.display import SLIM, Arc, Arrow, Circle, Item, Polygon, Polyline, Sheet, Spot, Text
from graphplan.sheet.plates.pens import Pen
from graphplan.words.tongue import Tongue, tongue

PACKAGES, LIBRARIES = ("amsmath", "xfp", "tikz"), "calc,arrows.meta"
STYLE = "graphplan"  # the package
CYRILLIC = "ru", "uk"
FONTS = "CMU Serif", "Libertinus Serif", "DejaVu Serif", "Times New Roman", "FreeSerif"  # with Cyrillic letters
SIZES = 5, 6, 7, 8, 9, 10, 10.95, 12, 14.4, 17.28  # points: those in which every font of LaTeX comes
POINT = 0.3514598  # mm
BOLD = r"\bfseries"

STYLES: dict[str, Pen] = {
    "construction": pens.THIN, "produced": pens.PRODUCED, "carried": pens.NORMAL, "locus": pens.LOCUS,
    "compasses": pens.ARC, "leader": pens.LEADER, "joint": pens.PAIR, "dot": pens.DOT, "origin": pens.ORIGIN,
    "bar": pens.BAR, "inside of a bar": pens.HOLLOW, "link": pens.LINK, "plate": pens.PLATE,
    "ground": pens.GROUND, "hatching": pens.HATCH, "stand": pens.GROUND_FILL, "sliding block": pens.BLOCK,
    "arrowhead": pens.SOLID, "balloon": pens.BALLOON, "drive": pens.DRIVE, "path of a point": pens.PATH,
    "end of a path": pens.PATH_END, "spot of a path": pens.PATH_DOT, "other position": pens.POSITION,
    "wheel": pens.WHEEL, "side of a figure": pens.SIDE, "fixed centrode": pens.FIXED_CENTRODE,
    "moving centrode": pens.MOVING_CENTRODE, "circling points": pens.CIRCLING_POINTS,
    "centre points": pens.CENTRE_POINTS,
    **{f"given {kind}": pen.with_fill("none") for kind, pen in pens.GIVEN.items()},
    **{kind: pen.with_fill("none") for kind, pen in pens.VECTORS.items()},
}  # fmt: skip
HEADS = {pens.FILLED: "head", pens.WHITE: "white head", pens.OPEN: "open head"}
NAMES = {pen: name for name, pen in reversed(STYLES.items())}
COLOURS = {getattr(pens, name): f"graphplan{name.lower()}" for name in (
    "INK", "GREY", "BLUE", "RED", "GREEN", "TINT", "BROWN", "VIOLET", "ROSE", "SKY", "PAPER")}
LETTERS = {pen.colour: f"{kind} letter" for kind, pen in reversed(pens.VECTORS.items()) if pen.colour != pens.INK}

EXACTLY = r"""% Where two lines meet, with the sixteen digits of \fpeval: with five pgf is half a millimetre off.
\makeatletter
\newdimen\graphplanmm
\newcommand*{\graphplanspot}[3]{\pgf@process{#1}\edef#2{\the\pgf@x}\edef#3{\the\pgf@y}}
\newcommand*{\graphplanmeeting}[4]{{%
  \graphplanspot{#1}\xa\ya \graphplanspot{#2}\xb\yb \graphplanspot{#3}\xc\yc \graphplanspot{#4}\xd\yd
  \edef\part{\fpeval{((\xc-\xa)*(\yd-\yc)-(\yc-\ya)*(\xd-\xc))/((\xb-\xa)*(\yd-\yc)-(\yb-\ya)*(\xd-\xc))}}%
  \global\pgf@x=\fpeval{\xa+\part*(\xb-\xa)}pt\relax \global\pgf@y=\fpeval{\ya+\part*(\yb-\ya)}pt\relax}}
\makeatother
"""


def style() -> str:
    """The colours and styles of all pictures, by what they are of."""
    lines = [rf"\definecolor{{{name}}}{{HTML}}{{{colour[1:].upper()}}}" for colour, name in COLOURS.items()]
    lines += [r"\tikzset{graphplan/.default=1mm, graphplan/.code={\graphplanmm=\fpeval{#1}pt\relax",
              r"  \let\pgfpointintersectionoflines\graphplanmeeting \pgfkeysalso{graphplan styles}},",
              r"  graphplan styles/.style={x=\graphplanmm, y=\graphplanmm, line cap=round, line join=round,"]
    lines += [f"  {line}," for line in (*_heads(), *_letters(), *(f"{name}/.style={{{look(pen)}}}"
                                                                  for name, pen in STYLES.items()))]
    return EXACTLY + "\n".join([*lines, "}}"]) + "\n"


def package() -> str:
    """The style as a package, to be read once by a document with many pictures."""
    needed = [rf"\RequirePackage{{{','.join(PACKAGES)}}}", rf"\usetikzlibrary{{{LIBRARIES}}}"]
    how = [r"% In a document, other colours: \tikzset{graphplan styles/.append style={link/.append style={red}}}"]
    return "\n".join([*how, r"\NeedsTeXFormat{LaTeX2e}", rf"\ProvidesPackage{{{STYLE}}}", *needed, style()])


def colour(of: str) -> str:
    """The name of a colour in the file; a grey is so much black."""
    return COLOURS.get(of) or f"black!{100 - 100 * pens.rgb(of)[0] / 255:.0f}"


def look(pen: Pen, colour: Callable[[str], str] = colour, unit: str = r"\graphplanmm") -> str:
    """The options of what a pen draws."""
    dashes = " ".join(rf"{'off' if i % 2 else 'on'} {stretch:g}{unit}" for i, stretch in enumerate(pen.dash))
    options = [f"draw={colour(pen.colour)}, line width={pen.width:g}{unit}" if pen.width else "draw=none"]
    options += [f"dash pattern={dashes}"] if dashes else []
    options += [f"fill={colour(pen.fill)}"] if pen.fill != "none" else []
    return ", ".join(options)


def _heads() -> Iterator[str]:
    """The heads of vectors, so many mm long."""
    tips = {"head": ("Triangle", pens.FILLED, ""), "white head": ("Triangle", pens.WHITE, ", open, fill=white"),
            "open head": ("Straight Barb", pens.OPEN, "")}
    for name, (tip, kind, more) in tips.items():
        look = rf"length=\graphplanhead, width={{\graphplanhead*{2 / SLIM[kind]:.4f}}}{more}"
        yield (rf"{name}/.code={{\edef\graphplanhead{{\the\dimexpr##1\graphplanmm\relax}}"
               rf"\pgfkeysalso{{-{{{tip}[{look}]}}, line cap=butt}}}}")


def _letters() -> Iterator[str]:
    """The letters of marks, of links and numbers, in the sizes of small sheets and of large ones; of headings."""
    yield "letter/.style={inner sep=0pt, outer sep=0pt, anchor=base, text depth=0pt, size of letters}"
    yield f"number/.style={{letter, text={COLOURS[pens.GREY]}, size of numbers}}"
    yield "small letter/.style={letter, size of numbers}"
    for colour, name in LETTERS.items():
        yield f"{name}/.style={{letter, text={COLOURS[colour]}}}"
    yield rf"caption/.style={{inner sep=0pt, outer sep=0pt, anchor=north west, align=left, {_font('##1')}}}"
    yield rf"heading/.style={{caption=##1, {_font('##1', BOLD)}}}"
    yield letter_styles(SMALL_SHEET.mark, SMALL_SHEET.text)
    yield f"large sheet/.style={{{letter_styles(LARGE_SHEET.mark, LARGE_SHEET.text)}}}"


def letter_styles(mark: float, text: float) -> str:
    """The styles that set letters of marks, and numbers, in sizes in mm."""
    sizes = {"letters": points(mark), "numbers": points(text)}
    return ", ".join(f"size of {what}/.style={{{_font(size, high=True)}}}" for what, size in sizes.items())


def _font(size: float | str, series: str = "", high: bool = False) -> str:
    command = rf"font={series}\fontsize{{{size}}}{{{size}}}\selectfont"
    return f"{command}, text height={0.69 * float(size):.2f}pt" if high else command


def points(mm: float) -> float:
    """The size of type next to one in mm."""
    return min(SIZES, key=lambda size: abs(size - mm / POINT))


def head_lines(lines: Iterable[str], say: Tongue, bare: bool) -> list[str]:
    """The first lines of a file, in comments: what it is, and what it needs."""
    needs = said("LaTeX: packages {0}; by pdflatex, lualatex or xelatex", ", ".join(PACKAGES))
    style_line = [rf"\usepackage{{{STYLE}}}"] if bare else []
    return [f"% {line}" for text in (*lines, say(needs), *style_line) for line in text.splitlines()]


def standalone(picture: Sequence[str], code: str) -> list[str]:
    """A document of a picture alone, in the letters of a language."""
    return [r"\documentclass[border=2mm]{standalone}", *letters(code), rf"\usepackage{{{','.join(PACKAGES)}}}",
            rf"\usetikzlibrary{{{LIBRARIES}}}", *style().splitlines(), r"\begin{document}", *picture,
            r"\end{document}"]  # fmt: skip


def letters(code: str) -> list[str]:
    """The letters of a language, for each engine: of what is at hand the first font that has them."""
    if code not in CYRILLIC:
        return [r"\usepackage{iftex}", r"\ifPDFTeX\usepackage[T1]{fontenc}\usepackage{lmodern}\fi"]
    tried = r"\newcommand*{\cyrillicfont}[1]{\IfFontExistsTF{#1}{\setmainfont{#1}\setsansfont{#1}" \
            r"\renewcommand*{\cyrillicfont}[1]{}}{}}"  # fmt: skip
    return [r"\usepackage{iftex}", r"\ifPDFTeX\usepackage[T2A]{fontenc}\else", r"  \usepackage{fontspec}", f"  {tried}",
            *(rf"  \cyrillicfont{{{font}}}" for font in FONTS), r"\fi"]  # fmt: skip


LETTER = {"epsilon": "varepsilon", "phi": "varphi"}  # as they look on the sheet
SIGNS = {sign: rf"\{LETTER.get(name, name)} " for name, sign in GREEK.items() if name != "upsilon"}
SIGNS |= {sign.upper(): rf"\{name.capitalize()} " for name, sign in GREEK.items() if sign.upper() in "ΓΔΘΛΞΠΣΥΦΨΩ"}
SIGNS |= {"′": "'", "″": "''", "·": r"\cdot ", "°": r"^\circ ", "−": "-", "×": r"\times ", "±": r"\pm ",
          "→": r"\to ", "≈": r"\approx ", "≠": r"\ne ", "≡": r"\equiv ", "∥": r"\parallel ", "⊥": r"\perp ",
          "∠": r"\angle ", "½": r"\tfrac12 ", "√": r"\surd "}  # fmt: skip
RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻ⁿ", "0123456789-n")
SPECIAL = {char: rf"\{char}" for char in "&%$#_{}"} | {"~": r"\textasciitilde{}", "^": r"\textasciicircum{}",
                                                       "\\": r"\textbackslash{}"}  # fmt: skip
LETTERED = r"[A-Za-zα-ωΑ-Ω]"
NAME = re.compile(rf"(?<!\w){LETTERED}\d*(?:\(\w+\))?[′″']*(?![\w-])")
AMONG_WORDS = re.compile(r"(?<!\w)(?:[A-Zα-ωΑ-Ω]\d*|[A-Z]{2})[′″']*(?![\w-])")  # where a letter may be a word
LAST = re.compile(rf"(?:{LETTERED}|\w+)(?:\(\w+\))?[′″']*$")


def lettering(runs: Runs, bold: bool = False, words: bool = False) -> str:
    """Lettering as LaTeX sets it: names as formulas, other words, or all that have no index, as they are."""
    text, place = "", 0
    while place < len(runs):
        level, after = runs[place].text if not runs[place].level else "", place + (not runs[place].level)
        levels = []
        while after < len(runs) and runs[after].level:
            levels.append(_level(runs[after]))
            after += 1
        base = LAST.search(level) if levels else None
        text += _words(level[: base.start()] if base else level, bold or words)
        text += f"${_formula(base[0] if base else '')}{''.join(levels)}$" if levels else ""
        place = after
    return rf"\textbf{{{text}}}" if bold else text


def _level(run: TextRun) -> str:
    """A subscript or a superscript; empty for a run on the base line."""
    return f"{'_' if run.level < 0 else '^'}{{{_formula(run.text.strip())}}}" if run.level else ""


def _formula(text: str) -> str:
    """Text inside a formula."""
    formula_text = re.sub("[⁰¹²³⁴-⁹⁻ⁿ]+", lambda found: f"^{{{found[0].translate(RAISED)}}}", text)
    formula_text = "".join(SIGNS.get(char) or SPECIAL.get(char, char) if char not in "^{}" else char
                           for char in formula_text)
    return formula_text.strip() if formula_text.isascii() else rf"\text{{{text}}}"


def _words(words: str, nameless: bool) -> str:
    """Words with the names in them, if there are any, as formulas, and the characters escaped that are commands."""
    text, done = "", 0
    names = AMONG_WORDS if re.search(r"[^\W\d]{2}", words) else NAME
    for name in () if nameless else names.finditer(words):
        text += escape_words(words[done : name.start()]) + f"${_formula(name[0])}$"
        done = name.end()
    return text + escape_words(words[done:])


def escape_words(words: str) -> str:
    """Words with the characters escaped that LaTeX would take for commands, or has in formulas alone."""
    pieces = re.split("([⁰¹²³⁴-⁹⁻ⁿ]+)", words)
    return "".join(f"${_formula(piece)}$" if place % 2 else "".join(map(_character, piece))
                   for place, piece in enumerate(pieces))  # fmt: skip


def _character(char: str) -> str:
    return f"${SIGNS[char]}$" if char in SIGNS else SPECIAL.get(char, char)


PICTURE = r"[x=1mm, y=1mm, line cap=round, line join=round, every node/.style={anchor=base west, inner sep=0pt}]"
SIDES = {"start": "", "middle": "anchor=base, ", "end": "anchor=base east, "}


def write_sheet(sheet: Sheet) -> str:
    """The sheet as a document that is as large as it is."""
    say = tongue(sheet.language)
    lines = [rf"\begin{{tikzpicture}}{PICTURE}", *_colours(sheet.items),
             rf"\useasboundingbox (0,0) rectangle {_spot((sheet.width, sheet.height))};"]
    for step, items in split_groups(sheet):
        lines.append(f"% {step + 1 - sheet.givens}: {sheet.sentences[step]}" if isinstance(step, int) else f"% {step}")
        lines += [line for item in items for line in _draw_item(item)]
    picture = standalone([*lines, r"\end{tikzpicture}"], say.code)
    return "\n".join([*head_lines([sheet.title, sheet.description], say, bare=False), *picture]) + "\n"


def _draw_item(item: Item) -> Iterator[str]:
    """An item as commands."""
    ink = look(item.pen, _colour, "mm")
    shaft = look(item.pen.with_fill("none"), _colour, "mm")
    match item:
        case Polyline():
            yield rf"\draw[{shaft}] {_chain(item.spots)};"
        case Polygon():
            yield rf"\path[{ink}] {_chain(item.spots)} -- cycle;"
        case Circle():
            yield rf"\path[{ink}] {_spot(item.centre)} circle[radius={round_mm(item.radius)}];"
        case Arc():
            yield (rf"\draw[{ink}] {_spot(item.spot_at(item.start))} arc[start angle={round_mm(item.start)}, "
                   rf"end angle={round_mm(item.end)}, radius={round_mm(item.radius)}];")
        case Arrow():
            for ends in item.shaft:
                yield rf"\draw[{shaft}] {_chain(ends)};"
            for corners, fill in item.figures:
                yield rf"\fill[{_colour(fill)}] {_chain(corners)} -- cycle;"
        case Text():
            size, anchor = points(item.size), SIDES[item.anchor]
            font = rf"font=\fontsize{{{size:g}}}{{{size:g}}}\selectfont"
            yield (rf"\node[{anchor}text={_colour(item.pen.colour)}, {font}] at "
                   rf"{_spot(item.at)} {{{lettering(item.runs, item.bold, words=True)}}};")
        case _:
            raise TypeError(f"no TikZ for {type(item).__name__}")


def _colour(colour: str) -> str:
    """The name of a colour in the file."""
    return COLOURS.get(colour, f"graphplan{colour.removeprefix('#')}")


def _colours(items: Iterable[Item]) -> Iterator[str]:
    """The colours that the style of constructions does not know."""
    colours = {colour for item in items for colour in (item.pen.colour, item.pen.fill) if colour.startswith("#")}
    for colour in sorted(colours - COLOURS.keys()):
        yield rf"\definecolor{{{_colour(colour)}}}{{HTML}}{{{colour[1:].upper()}}}"


def _chain(spots: Iterable[Spot]) -> str:
    return " -- ".join(map(_spot, spots))


def _spot(at: Spot) -> str:
    return f"({round_mm(at[0])},{round_mm(at[1])})"
