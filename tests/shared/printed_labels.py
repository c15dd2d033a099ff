"""The labels of a picture in LaTeX, measured at the printed width by what its file says."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import combinations

import graphplan as gp
from graphplan.accuracy.drafted import draft
from graphplan.design.hand import pencil
from graphplan.exports.latex import POINT, lettering
from graphplan.exports.tikz import LINE_MM, tikz
from graphplan.exports.walk import identifiers
from graphplan.kernel.kinds import POINT as POINTS
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.screen import compose_for_column
from graphplan.sheet.lettering.lettering import CAPS, DEPTH, DROP
from graphplan.sheet.lettering.letters import letter_plates
from graphplan.sheet.plates.display import Rect, Text

UNIT = re.compile(r"graphplan=([\d.]+)(?:mm|\\linewidth)/([\d.]+)")
FONT = re.compile(r"size of (letters|numbers)/\.style=\{font=\\fontsize\{([\d.]+)\}")
LABEL = re.compile(r"\\node\[([^\]]*)\] at (?:\(\$\((\w+)\)\+)?\(([-\d.]+),([-\d.]+)\)\$?\)? \{(.*)\};")
TOUCH_MM = 0.15  # labels that share less only touch


def label_boxes(source: str, composition: Composition) -> Iterator[list[Rect]]:
    """The labels of each plan as a file sets them, in mm as they are printed."""
    head = next(line for line in source.splitlines() if line.startswith(r"\begin{tikzpicture}"))
    wide, picture = map(float, UNIT.findall(head)[0])
    mm = wide * (LINE_MM if wide <= 1 else 1.0) / picture
    sizes = {kind: float(size) * POINT for kind, size in FONT.findall(head) or FONT.findall(source)[:2]}
    spots = {name: mark.spot for mark, name in identifiers(composition.plates.all_marks).items()
             if mark.kind == POINTS}
    texts = [item for plate in letter_plates(composition.plates).values() for item in plate.items
             if isinstance(item, Text)]
    runs = {lettering(text.runs, text.bold): text for text in texts}
    for scope in source.split(r"\begin{scope}")[1:]:
        boxes = []
        for style, mark, dx, dy, label in LABEL.findall(scope):
            if "heading" in style or "caption" in style:
                continue
            size, text = sizes["numbers" if style.startswith(("number", "small")) else "letters"], runs[label]
            x, y = spots.get(mark, (0.0, 0.0))
            x, y, long = mm * (x + float(dx)), mm * (y + float(dy)), text.box.width * size / text.size
            left = x if "west" in style else x - long if "east" in style else x - long / 2
            base = y - size * CAPS if "north" in style else y
            deep = DROP + 0.15 if any(run.level < 0 for run in text.runs) else DEPTH
            boxes.append(Rect(left, base - size * deep, left + long, base + size * CAPS))
        yield boxes


def shared(one: Rect, other: Rect) -> float:
    """How far two boxes reach into each other; negative where they stand apart."""
    return min(one.right - other.left, other.right - one.left, one.top - other.bottom, other.top - one.bottom)


def clashes(scene: gp.Scene, width: float) -> tuple[int, int]:
    """How many labels a picture of a scene has, and how many pairs of them reach into each other."""
    sheet = draft(gp.construct(scene), pencil("")).composition
    composition = compose_for_column(sheet.plans, width * LINE_MM if width <= 1 else width, width > 1)
    plates = [*label_boxes(tikz(sheet, width=width), composition)]
    pairs = (pair for boxes in plates for pair in combinations(boxes, 2))
    return sum(map(len, plates)), sum(shared(*pair) > TOUCH_MM for pair in pairs)
