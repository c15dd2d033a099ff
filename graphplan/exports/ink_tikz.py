r"""A sheet's display list in LaTeX that draws with TikZ: every stroke where it lies, in mm of paper.

What is drawn of a step stands after a comment with its sentence. Constructions have a better file, which draws them by
their steps: :mod:`graphplan.exports.tikz`; this one serves sheets of diagrams.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from graphplan.exports import latex
from graphplan.exports.latex import lettering
from graphplan.output.svg import round_mm, split_groups
from graphplan.sheet.plates.display import Arc, Arrow, Circle, Item, Polygon, Polyline, Sheet, Spot, Text
from graphplan.words.tongue import tongue

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
    picture = latex.standalone([*lines, r"\end{tikzpicture}"], say.code)
    return "\n".join([*latex.head_lines([sheet.title, sheet.description], say, bare=False), *picture]) + "\n"


def _draw_item(item: Item) -> Iterator[str]:
    """An item as commands."""
    look = latex.look(item.pen, _colour, "mm")
    shaft = latex.look(item.pen.with_fill("none"), _colour, "mm")
    match item:
        case Polyline():
            yield rf"\draw[{shaft}] {_chain(item.spots)};"
        case Polygon():
            yield rf"\path[{look}] {_chain(item.spots)} -- cycle;"
        case Circle():
            yield rf"\path[{look}] {_spot(item.centre)} circle[radius={round_mm(item.radius)}];"
        case Arc():
            yield (rf"\draw[{look}] {_spot(item.spot_at(item.start))} arc[start angle={round_mm(item.start)}, "
                   rf"end angle={round_mm(item.end)}, radius={round_mm(item.radius)}];")
        case Arrow():
            for ends in item.shaft:
                yield rf"\draw[{shaft}] {_chain(ends)};"
            for corners, fill in item.figures:
                yield rf"\fill[{_colour(fill)}] {_chain(corners)} -- cycle;"
        case Text():
            size, anchor = latex.points(item.size), SIDES[item.anchor]
            font = rf"font=\fontsize{{{size:g}}}{{{size:g}}}\selectfont"
            yield (rf"\node[{anchor}text={_colour(item.pen.colour)}, {font}] at "
                   rf"{_spot(item.at)} {{{lettering(item.runs, item.bold, words=True)}}};")
        case _:
            raise TypeError(f"no TikZ for {type(item).__name__}")


def _colour(colour: str) -> str:
    """The name of a colour in the file."""
    return latex.COLOURS.get(colour, f"graphplan{colour.removeprefix('#')}")


def _colours(items: Iterable[Item]) -> Iterator[str]:
    """The colours that the style of constructions does not know."""
    colours = {colour for item in items for colour in (item.pen.colour, item.pen.fill) if colour.startswith("#")}
    for colour in sorted(colours - latex.COLOURS.keys()):
        yield rf"\definecolor{{{_colour(colour)}}}{{HTML}}{{{colour[1:].upper()}}}"


def _chain(spots: Iterable[Spot]) -> str:
    return " -- ".join(map(_spot, spots))


def _spot(at: Spot) -> str:
    return f"({round_mm(at[0])},{round_mm(at[1])})"
