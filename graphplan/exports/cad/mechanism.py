"""The mechanism in model space, in its own size and units: links, pairs, guides, points, ground and dimensions.

Symbols, letters and the lines of dimensions are as large as on a print in the scale of the sheet.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

from graphplan.exports.cad.entities import STYLE, Ink
from graphplan.exports.cad.layers import FULL_SIZE, Layers
from graphplan.mechanism.model import FRAME
from graphplan.sheet.lettering.lettering import CAPS, SMALL_SHEET, width
from graphplan.sheet.plates import pens
from graphplan.sheet.plates.annotations import FIRST_LEVEL_MM, LinkDimension, dimensions
from graphplan.sheet.plates.display import Item, Polyline, Rect, Spot, Text
from graphplan.sheet.plates.drawn_mechanism import DrawnMechanism
from graphplan.sheet.plates.plans import bounding_box
from graphplan.sheet.plates.plate import Plates
from graphplan.sheet.plates.symbols import GUIDE, LONG, NEAR, offset
from graphplan.sheet.plates.traced_motion import outline
from graphplan.sheet.plates.view import View

SYMBOLS = {"ground", "wheels", "blocks", "drive", "pairs"}  # layers of the sheet that are drawn as they are there
DIMENSIONED, POINTS = f"{FULL_SIZE} dimensions", f"{FULL_SIZE} points"
CLEAR = 2.2  # mm from a point to its letters
DIGITS = 4  # of the longest dimension
ROOM = 3 * FIRST_LEVEL_MM  # mm about the points for symbols, letters and dimensions
DIMENSION_STYLE = {  # mm on paper, as ISO 129 has them
    "dimtxt": 2.5, "dimasz": 2.5, "dimexo": 1.0, "dimexe": 1.5, "dimgap": 0.8, "dimtad": 1, "dimtih": 0, "dimtoh": 0,
    "dimtix": 1, "dimtofl": 1, "dimzin": 8, "dimlwd": 18, "dimlwe": 18, "dimlfac": 1.0, "dimtxsty": STYLE,
}  # fmt: skip


@dataclass(frozen=True)
class FullSize:
    """A mechanism in its own units; `scale` of them are a mm of a print in the scale of the sheet."""

    plates: Plates
    scale: float

    @cached_property
    def drawn_mechanism(self) -> DrawnMechanism:
        """The mechanism on a print."""
        everywhere = Rect(-math.inf, -math.inf, math.inf, math.inf)
        return DrawnMechanism(self.plates.scene, View(everywhere, 1 / self.scale, (0.0, 0.0)))

    @cached_property
    def items(self) -> tuple[Item, ...]:
        """All but points and dimensions, in mm of the print, each on its layer."""
        symbols = [replace(item, layer=f"{FULL_SIZE} {item.layer}") for item in self.drawn_mechanism.items()
                   if item.layer in SYMBOLS and item.pen != pens.PRODUCED]
        return (*self._guides(), *self._links(), *symbols, *self._letters())

    def _links(self) -> Iterator[Item]:
        """A line through the points of each link, or around them."""
        for link in self.plates.scene.moving:
            for chain in outline([self.drawn_mechanism.spots[name] for name in self.plates.scene.links[link]]):
                yield Polyline(pens.LINK, f"{FULL_SIZE} link {link}", None, chain)

    def _guides(self) -> Iterator[Item]:
        """The line along which each block slides."""
        for slide in self.plates.scene.slides:
            seat, along = self.drawn_mechanism.seat(slide), self.drawn_mechanism.direction(slide)
            ends = offset(seat, along, -GUIDE), offset(seat, along, GUIDE)
            yield Polyline(pens.PRODUCED, f"{FULL_SIZE} guides", None, ends)

    def _letters(self) -> Iterator[Text]:
        """The names of points, each where the links at it leave most room."""
        size, seats = SMALL_SHEET.mark, [self.drawn_mechanism.seat(slide) for slide in self.plates.scene.slides]
        for (x, y), (runs, _) in self.drawn_mechanism.letters().items():
            direction = self._free((x, y))
            half = width(runs, size) / 2, CAPS * size / 2
            clear = CLEAR + (LONG if any(math.dist(seat, (x, y)) < NEAR for seat in seats) else 0.0)
            far = min(clear + half_size / abs(side)
                      for half_size, side in zip(half, (direction.real, direction.imag), strict=True) if side)
            at = x + far * direction.real, y + far * direction.imag - half[1]
            yield Text(pens.LETTERS, f"{FULL_SIZE} names", None, at, runs, size, "middle")

    def _free(self, spot: Spot) -> complex:
        """The middle of the widest angle between what leaves a spot: links, and the ground below."""
        joints = [name for name, at in self.drawn_mechanism.spots.items() if math.dist(at, spot) < NEAR]
        directions = [complex(*neighbour) - complex(*spot) for name in joints
                      for neighbour in self.drawn_mechanism.neighbours(name)]
        directions += [-1j for name in joints if FRAME in self.plates.scene.links_of[name]]
        turns = sorted(cmath.phase(direction) for direction in directions) or [-math.pi / 2]
        gaps = [(end - start, start) for start, end in pairwise([*turns, turns[0] + math.tau])]
        gap, start = max(gaps, key=lambda one: (round(one[0], 6), one[1]))
        return cmath.rect(1.0, start + gap / 2)

    @cached_property
    def dimensions(self) -> list[LinkDimension]:
        """The dimensions of its links."""
        return dimensions(self.plates.scene, self.drawn_mechanism.spots, self.items)

    @property
    def box(self) -> Rect:
        """What it takes up, in units of the scene."""
        sides = [abs(dimension.aside) for dimension in self.dimensions]
        box, margin = bounding_box(list(self.drawn_mechanism.spots.values())), max([ROOM, *sides]) + FIRST_LEVEL_MM
        return box.inset(-margin, -margin, -margin, -margin).times(self.scale)

    def draw(self, space: Any, layers: Layers, decimal: str) -> None:
        """Draw it in a space; of numbers that are not whole the decimals follow this sign."""
        ink, scene = Ink(space, layers, self.scale), self.plates.scene
        for item in self.items:
            ink.item(item)
        places = {name: (float(x), float(y)) for name, (x, y) in scene.points.items()}
        for place in dict.fromkeys(places.values()):
            space.add_point(place, dxfattribs={"layer": POINTS})
        style = self._style(space.doc, places, decimal)
        for dimension in self.dimensions:
            space.add_aligned_dim(places[dimension.start], places[dimension.end], self.scale * dimension.aside,
                                  dimstyle=style,
                                  dxfattribs={"layer": DIMENSIONED}).render()  # fmt: skip

    def _style(self, document: Any, places: Mapping[str, Spot], decimal: str) -> str:
        """The style of dimensions, entered also as the document's own, by which some programs draw all of them."""
        longest = max((math.dist(places[dimension.start], places[dimension.end]) for dimension in self.dimensions),
                      default=1.0)
        places_after = max(0, DIGITS - 1 - math.floor(math.log10(longest)))
        settings = DIMENSION_STYLE | {"dimscale": self.scale, "dimdec": places_after, "dimdsep": ord(decimal)}
        style = document.dimstyles.add("GRAPHPLAN", dxfattribs=settings)
        style.copy_to_header(document)
        return "GRAPHPLAN"
