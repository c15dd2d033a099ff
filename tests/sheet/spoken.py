"""Spoken lengths beside measured ones: what the sentences of a list of steps say, and what a ruler says on paper."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from inked_sheet import InkedSheet

OFF = 0.06  # mm: tenths are spoken
Place = Sequence[float]

GIVEN = re.compile(r"[^\s=]+ \S+ : [^\s=]+ = ")  # a value over its scale
FACTOR = re.compile(r" · [^\s=]+ (?==)|(?<=\d) · [^\s=]+(?=\)²)")  # how much longer a vector is on another plan
FORCE = re.compile(r"\([^()\s]+ [^()\s]+\)")  # what the mm stand for
COMPONENTS = re.compile(r" ?\(x (−?[\d.]+), y (−?[\d.]+)\)")
TENTHS = re.compile(r"(?<![\w.−])\d+\.\d(?![\d.])")


def misspoken(told: Mapping[str, Any], sheet: InkedSheet | None = None) -> list[str]:
    """The sentences of a list of steps that speak of a length which the marks on paper do not have.

    Marks lie where the list tells; two whose circles are on the sheet, if it is given, as far apart as these are.
    """
    drawn = {key: (point.x, point.y) for key, point in sheet.marks_on_plans} if sheet else {}
    places = [step["paper"] for step in told["steps"]]
    circles = {mark: drawn[str(step["number"])] for mark, step in enumerate(told["steps"])
               if str(step["number"]) in drawn}
    return [entry["sentence"] for entry in (*told["steps"], *told["entries"]) if [*_wrong(entry, places, circles)]]


def spoken(sentence: str) -> list[float]:
    """The lengths on paper that a sentence speaks of."""
    for pattern, instead in ((COMPONENTS, ""), (FORCE, ""), (GIVEN, "= "), (FACTOR, " ")):
        sentence = pattern.sub(instead, sentence)
    return [float(number) for number in TENTHS.findall(sentence)]


def _wrong(entry: Mapping[str, Any], places: Sequence[Place], circles: Mapping[int, Place]) -> Iterator[float]:
    """The lengths of an entry that are not those between its marks."""
    found = [measured(length["marks"], circles if circles.keys() >= {*length["marks"]} and len(length["marks"]) == 2
                      else places) for length in entry["lengths"]]
    yield from (length["mm"] for length, mm in zip(entry["lengths"], found, strict=True)
                if abs(length["mm"] - mm) > OFF)
    yield from (number for number in spoken(entry["sentence"])
                if not any(abs(number - mm) <= OFF for mm in found))
    for parts in COMPONENTS.findall(entry["sentence"]):
        start, end = (places[mark] for mark in entry["lengths"][-1]["marks"])
        x, y = (float(part.replace("−", "-")) for part in parts)
        yield from (part for part, mm in ((x, end[0] - start[0]), (y, start[1] - end[1])) if abs(part - mm) > OFF)


def measured(marks: Sequence[int], places: Mapping[int, Place] | Sequence[Place]) -> float:
    """What a ruler measures: between two marks, a radius, an arm of a force, or the part of a vector square to a way.
    """
    if len(marks) == 2 and marks[0] == marks[1]:
        return float(places[marks[0]][-1])
    spots = [complex(*places[mark][:2]) for mark in marks]
    if len(spots) == 2:
        return abs(spots[1] - spots[0])
    if len(spots) == 4:
        arm, along = spots[1] - spots[0], spots[3] - spots[2]
    else:
        along, arm = spots[2] - spots[1], spots[4] - spots[3]
    return abs((arm.conjugate() * along).imag) / (abs(along) or math.inf)
