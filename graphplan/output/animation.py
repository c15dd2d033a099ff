"""A construction in motion: the sheets of its poses, one after the other, as an animated GIF or as one animated SVG.

A GIF has a picture for each pose. An SVG has every stroke, circle and letter once: what moves has SVG's own animations
of its places, from pose to pose in straight lines, and what is not there in all poses is shown where it is. A reader
who wants no motion is shown the first pose. The same poses are the same bytes.
"""

from __future__ import annotations

import io
import math
import re
from collections.abc import Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any
from xml.etree.ElementTree import Element, SubElement, tostring

from graphplan.output.svg import SPACED, groups, round_mm
from graphplan.sheet.lettering.lettering import FONTS, TextRun
from graphplan.sheet.plates.display import Sheet, Text, move_item
from graphplan.sheet.plates.pens import LETTERS, PAPER

if TYPE_CHECKING:
    from PIL.Image import Image

MARGIN, FOOT, TOLD = 3.0, 7.5, 4.0  # mm about the plans, and below them for the travel, and its letters
COLOURS = 32  # of a GIF: lines on paper have few
SAMPLE = 6  # pictures by which the colours are chosen
MOVES = {"points", "d", "x", "y", "cx", "cy", "r", "width", "height"}  # attributes that can go from pose to pose
ENDS = {"data-from", "data-to"}  # of a vector, which nothing can animate
MAX_JUMP_MM = 40.0  # mm: what goes farther from one pose to the next is not the same
Track = dict[int, Element]  # an element by the poses in which it is there
WORDS = "title", "desc"  # of a group
NUMBER, FLAGS = re.compile(r"-?\d+(?:\.\d+)?"), re.compile(r"A \S+ \S+ (\S+ \S+ \S+)")
STILL = """.still{display:none}
@media (prefers-reduced-motion:reduce){.still{display:inline}.moving{display:none!important}}"""
PLACES = 4  # decimals of a part of the round


@dataclass(frozen=True)
class Film:
    """The sheets of a loop, each with what is told of it, such as how far the drive has gone; and how many seconds it
    takes."""

    sheets: Sequence[Sheet]
    told: Sequence[str]
    seconds: float

    def pictures(self) -> Iterator[Sheet]:
        """The plans from their corner on, with what is told of each."""
        for sheet, caption in zip(self.sheets, self.told, strict=True):
            rects = sheet.panels.values()
            left, top = min(rect.left for rect in rects) - MARGIN, max(rect.top for rect in rects) + MARGIN
            right, low = max(rect.right for rect in rects) + MARGIN, min(rect.bottom for rect in rects) - FOOT
            items = [move_item(item, -left, -low) for item in sheet.items]
            items.append(Text(LETTERS, "travel", None, (right - left - MARGIN, 2.0), (TextRun(caption),), TOLD, "end"))
            yield replace(sheet, width=right - left, height=top - low, items=tuple(items))


# ---- GIF -------------------------------------------------------------------------------------------------------------


def gif(film: Film, width: int) -> bytes:
    """The film as a GIF of so many pixels in width, which begins again when it is over."""
    from PIL.Image import Dither

    sheets, written = list(film.pictures()), io.BytesIO()
    palette = _palette([_image(sheet, width) for sheet in sheets[:: math.ceil(len(sheets) / SAMPLE)]])
    first, *frames = (_image(sheet, width).quantize(palette=palette, dither=Dither.NONE) for sheet in sheets)
    each = max(2, round(100 * film.seconds / len(sheets)))  # hundredths of a second; less is slowed down by browsers
    first.save(written, "GIF", save_all=True, append_images=frames, duration=10 * each, loop=0, optimize=False)
    return written.getvalue()


def _image(sheet: Sheet, width: int) -> Image:
    from graphplan.output.png import picture

    return picture(sheet, width / sheet.width)


def _palette(images: Sequence[Image]) -> Image:
    """The colours of some pictures."""
    from PIL import Image

    strip = Image.new("RGB", (images[0].width, images[0].height * len(images)))
    for k, image in enumerate(images):
        strip.paste(image, (0, k * image.height))
    return strip.quantize(COLOURS)


# ---- SVG -------------------------------------------------------------------------------------------------------------


def svg(film: Film, width: int) -> str:
    """The film as one SVG of so many pixels in width, which begins again when it is over."""
    sheets = list(film.pictures())
    wide, high = round_mm(sheets[0].width), round_mm(sheets[0].height)
    picture = Element("svg", {
        "xmlns": "http://www.w3.org/2000/svg", **SPACED, "viewBox": f"0 0 {wide} {high}", "width": str(width),
        "height": str(round(width * high / wide)), "font-family": FONTS, "stroke-linecap": "round",
        "stroke-linejoin": "round", "xml:lang": sheets[0].language})  # fmt: skip
    SubElement(picture, "title").text = sheets[0].title
    SubElement(picture, "desc").text = sheets[0].description
    SubElement(picture, "style").text = STILL
    SubElement(picture, "rect", {"width": str(wide), "height": str(high), "fill": PAPER})
    poses = [dict(_groups(sheet)) for sheet in sheets]
    clock = _Clock(len(sheets), film.seconds)
    for key in _merge_orders(poses):
        first = next(pose[key] for pose in poses if key in pose)
        group = SubElement(picture, "g", first.attrib)
        group.extend([child for child in first if child.tag in WORDS])
        for track in _tracks([pose.get(key, ()) for pose in poses]):
            group.extend([*clock.animate_element(track)])
    return f'<?xml version="1.0" encoding="utf-8"?>\n{tostring(picture, encoding="unicode")}\n'


def _groups(sheet: Sheet) -> Iterator[tuple[str, Element]]:
    """The groups of a sheet, steps by their numbers."""
    for key, group in groups(sheet, lambda step: max(0, step + 1 - sheet.givens)):
        yield key, group.get_xml()


def _tracks(poses: Sequence[Iterable[Element]]) -> list[Track]:
    """Tracks of a group's elements, from back to front: each element by the poses that show it."""
    kinds: dict[Hashable, list[list[Element]]] = {}
    elements = [[child for child in pose if child.tag not in WORDS] for pose in poses]
    for k, pose in enumerate(elements):
        for element in pose:
            kinds.setdefault(_kind(element), [[] for _ in poses])[k].append(element)
    tracks = [track for of_kind in kinds.values() for track in _follow_elements(of_kind)]
    names = {element: name for name, track in enumerate(tracks) for element in track.values()}
    return [tracks[name] for name in _merge_orders([[names[element] for element in pose] for pose in elements])]


def _follow_elements(poses: Sequence[Sequence[Element]]) -> list[Track]:
    """Tracks of elements that differ only by their places: in their order if their number is constant, else by the
    shortest distances."""
    if len({*map(len, poses)}) == 1:
        return [dict(enumerate(track)) for track in zip(*poses, strict=True)]
    tracks: list[Track] = []
    last: list[complex] = []
    for k, elements in enumerate(poses):
        spots = [_middle(element) for element in elements]
        distances = sorted((abs(place - spot), name, i)
                           for name, place in enumerate(last) for i, spot in enumerate(spots))
        free, new = {*range(len(tracks))}, {*range(len(elements))}
        for distance, name, i in distances:
            if distance <= MAX_JUMP_MM and name in free and i in new:
                free.discard(name)
                new.discard(i)
                tracks[name][k], last[name] = elements[i], spots[i]
        tracks += [{k: elements[i]} for i in sorted(new)]
        last += [spots[i] for i in sorted(new)]
    return tracks


def _middle(element: Element) -> complex:
    """About where an element is, in mm."""
    numbers = [float(number) for child in element.iter() for name in ("points", "d", "x", "cx", "y", "cy")
               for number in NUMBER.findall(child.get(name, ""))]
    if "d" in element.attrib:  # of an arc the ends
        numbers = numbers[:2] + numbers[-2:]
    return complex(sum(numbers[::2]), sum(numbers[1::2])) / max(1, len(numbers) // 2)


def _kind(element: Element) -> Hashable:
    """Kind of an element, independent of its place."""
    look = ((name, _form(value) if name in MOVES else value) for name, value in sorted(element.attrib.items())
            if name not in ENDS)
    return element.tag, element.text, tuple(look), tuple(map(_kind, element))


def _form(value: str) -> Hashable:
    """Number of a place's numbers, and the flags of arcs, which cannot be interpolated."""
    return len(NUMBER.findall(value)), tuple(FLAGS.findall(value))


def _merge_orders(orders: Sequence[Iterable[Hashable]]) -> list[Any]:
    """All names of some lists in one, each behind those that it stands behind."""
    merged: list[Hashable] = []
    places: set[Hashable] = set()
    for order in orders:
        at = 0
        for name in order:
            if name not in places:
                places.add(name)
                merged.insert(at, name)
            at = merged.index(name) + 1
    return merged


@dataclass(frozen=True)
class _Clock:
    """When each of so many poses is shown in a round of some seconds."""

    poses: int
    seconds: float

    def animate_element(self, element: Track) -> Iterator[Element]:
        """An element by the poses in which it is there: as it stands still in the first, and as it moves."""
        places = sorted(element)
        first = element[places[0]]
        moving = self._moving([element[k] for k in places], places)
        if len(places) < self.poses:
            moving.insert(0, self._display(places))
        if moving.find(".//animate") is not None:
            if places[0] == 0:
                yield _plain(first, {"class": "still", "display": "none"})
            else:
                moving.set("display", "none")
            moving.set("class", f"{moving.get('class', '')} moving".strip())
        yield moving

    def _moving(self, elements: Sequence[Element], places: Sequence[int]) -> Element:
        """An element with what moves it: how its places change, and those of what is in it."""
        moving = _plain(elements[0], {}, deep=False)
        for name in sorted(MOVES.intersection(elements[0].attrib)):
            values = [element.attrib[name] for element in elements]
            if len({*values}) > 1:
                moving.append(self._animate(name, *self._track(values, places)))
        for children in zip(*elements, strict=True):
            moving.append(self._moving(children, places))
        return moving

    def _track(self, values: Sequence[str], places: Sequence[int]) -> tuple[list[str], list[float]]:
        """The values with their times; one that is not there in the next pose is held until then."""
        if len(values) == self.poses:
            return [*values, values[0]], []
        track: list[tuple[float, str]] = []
        value_at = dict(zip(places, values, strict=True))
        for k, value in value_at.items():
            track.append((k, value))
            if k + 1 not in value_at:
                track.append((k + 1, value_at[0] if k + 1 == self.poses and 0 in value_at else value))
        if track[0][0] > 0:
            track.insert(0, (0, track[0][1]))
        if track[-1][0] < self.poses:
            track.append((self.poses, track[-1][1]))
        return [value for _, value in track], [k / self.poses for k, _ in track]

    def _display(self, places: Sequence[int]) -> Element:
        """An element of SVG that shows its parent in these poses alone."""
        is_visible = [k in {*places} for k in range(self.poses)]
        turns = [k for k in range(self.poses) if k == 0 or is_visible[k] != is_visible[k - 1]]
        return self._animate("display", ["inline" if is_visible[k] else "none" for k in turns],
                             [k / self.poses for k in turns], calcMode="discrete")

    def _animate(self, name: str, values: Sequence[str], times: Sequence[float], **more: str) -> Element:
        timed = {"keyTimes": ";".join(f"{round_mm(time, PLACES):g}" for time in times)} if times else {}
        return Element("animate", {"attributeName": name, "values": ";".join(values), **timed, **more,
                                   "dur": f"{round_mm(self.seconds):g}s", "repeatCount": "indefinite"})  # fmt: skip


def _plain(element: Element, look: dict[str, str], deep: bool = True) -> Element:
    """A copy of an element, without the ends of vectors, as these move."""
    element_copy = Element(element.tag,
                           {name: value for name, value in element.attrib.items() if name not in ENDS} | look)
    element_copy.text = element.text
    if deep:
        element_copy.extend(element)
    return element_copy
