"""The layers of a CAD drawing: the sheet's own, and one a drawing step, in order by the stages of the construction.

A layer has the colour, weight and line type of the pen that draws most of it; what another pen draws says so itself.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from ezdxf.lldxf.const import VALID_DXF_LINEWEIGHTS

from graphplan.sheet.plates.display import Item, Sheet
from graphplan.sheet.plates.pens import INK, Pen
from graphplan.sheet.plates.plate import Plates
from graphplan.sheet.words.protocol import Protocol

NAME = "GRAPHPLAN"  # whose extended data these are
SHEET, FULL_SIZE, GIVEN, VIEWPORTS = "SHEET", "MECHANISM 1-1", "STAGE 00", "VIEWPORTS"
MAX_TITLE_LETTERS = 120  # letters of a stage's title in the name of a layer
FORBIDDEN = str.maketrans(dict.fromkeys('<>/\\";?*|=`', "-") | {":": " -"})  # in names
FOREGROUND = 7  # the colour that is black on white and white on black
LINE_TYPES = {  # by how many dashes and gaps they have: names by which programs know their own
    2: ("DASHED", "DASHED2", "HIDDEN", "HIDDEN2"), 4: ("DASHDOT", "DASHDOT2"), 6: ("DIVIDE", "DIVIDE2"),
}  # fmt: skip


def stage_layers(plates: Plates) -> Layers:
    """The layers of a construction: one a step, by the stages."""
    program, tongue = plates.plans.drawing.drawn, plates.plans.tongue
    stages, of = Protocol(plates.plans).stages
    layers = []
    for index in range(len(program)):
        place = of.get(index)
        if index < program.givens:
            layers.append(f"{GIVEN} given")
        else:
            title = "" if place is None else f" {tongue(stages[place].title)[:MAX_TITLE_LETTERS].translate(FORBIDDEN)}"
            stage = len(stages) if place is None else place
            layers.append(f"STAGE {stage + 1:02}{title} - STEP {program.number(index):03}")
    sentences = plates.plans.sentences
    return Layers(layers, {layers[index]: sentences[index] for index in range(program.givens, len(program))})


def step_layers(sheet: Sheet) -> Layers:
    """The layers of a sheet of which no more is known: one a step."""
    names = [f"STEP {index + 1 - sheet.givens:03}" if index >= sheet.givens else f"{GIVEN} given"
             for index in range(len(sheet.sentences))]
    return Layers(names, dict(list(zip(names, sheet.sentences, strict=True))[sheet.givens :]))


@dataclass
class Layers:
    """Which layer an item lies on, and how it looks there; what is drawn is told first.

    `steps` are the layers of drawing steps, `sentences` what is said of them, by layer.
    """

    steps: Sequence[str]
    sentences: Mapping[str, str]
    counted: dict[str, Counter[Pen]] = field(default_factory=lambda: defaultdict(Counter))

    def count(self, items: Iterable[Item]) -> None:
        """Tell what will be drawn."""
        for item in items:
            self.counted[self.layer_of(item)][item.pen] += 1

    def layer_of(self, item: Item) -> str:
        """The layer of an item."""
        if item.step is None:
            return item.layer if item.layer.startswith(FULL_SIZE) else f"{SHEET} {item.layer}"
        return self.steps[item.step]

    @cached_property
    def pens(self) -> dict[str, Pen]:
        """The layers in the order of their names, each with the pen that draws most of it."""
        return {name: self.counted[name].most_common(1)[0][0] for name in sorted(self.counted)}

    @cached_property
    def line_types(self) -> dict[tuple[float, ...], str]:
        """The names of line types by their dashes, mm; the longest of each kind has the plain name."""
        line_types: dict[tuple[float, ...], str] = {(): "Continuous"}
        dashes = {pen.dash for pens in self.counted.values() for pen in pens if pen.dash}
        names = {count: iter(pattern) for count, pattern in LINE_TYPES.items()}
        for dash in sorted(dashes, key=lambda dash: (-sum(dash), dash)):
            line_types[dash] = next(names.get(len(dash), iter(())),
                                    "-".join(["DASH", *(f"{stretch:g}" for stretch in dash)]))
        return line_types

    def look(self, item: Item) -> dict[str, Any]:
        """The layer of an item, and what its pen has other than the layer."""
        name = self.layer_of(item)
        pen, usual = item.pen, self.pens[name]
        look: dict[str, Any] = {"layer": name}
        if pen.colour != usual.colour:
            look |= colour(pen.colour)
        if pen.width != usual.width:
            look["lineweight"] = weight(pen.width)
        if pen.dash != usual.dash:
            look["linetype"] = self.line_types[pen.dash]
        return look

    def enter(self, document: Any) -> None:
        """The layers and line types, entered into a document."""
        for dash, name in self.line_types.items():
            if dash:
                pattern = [-stretch if i % 2 else stretch for i, stretch in enumerate(dash)]
                document.linetypes.add(name, [sum(dash), *pattern], description=f"{dash} mm")
        for name, pen in self.pens.items():
            layer = document.layers.add(name, **colour(pen.colour), lineweight=weight(pen.width),
                                        linetype=self.line_types[pen.dash])
            if name in self.sentences:
                layer.description = self.sentences[name]
        document.layers.add(VIEWPORTS, plot=False)


def colour(colour: str) -> dict[str, int]:
    """A colour as attributes; black ink is whatever stands out from the background."""
    return {"color": FOREGROUND} if colour == INK else {"color": FOREGROUND, "true_color": int(colour[1:], 16)}


def weight(width: float) -> int:
    """The line weight next to a width in mm, in hundredths of a mm."""
    return int(min(VALID_DXF_LINEWEIGHTS, key=lambda weight: abs(weight - 100 * width)))
