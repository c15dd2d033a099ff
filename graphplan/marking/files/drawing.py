"""What a drawing program's file shows, put together: each thing once, sound, and with its letters.

Which words on a drawing name which of the things on it is told by where they stand.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path

import shapely
from shapely import LineString, Point, STRtree

from graphplan.errors import Refused
from graphplan.kernel.kinds import LINE, POINT
from graphplan.marking.files.safe import FARTHEST, TRACES, Budget, on_paper
from graphplan.marking.spelling import greek, mark
from graphplan.marking.traces import Frames, Spot, Submission, Trace
from graphplan.sheet.lettering.lettering import CAPS, SUBSCRIPT, Run, width

BESIDE = 6.0  # mm from a mark to its letters
CHOICES = 12  # things nearest to a word that are weighed
WORDS = 1000  # that may be names; more name nothing


@dataclass(frozen=True)
class Lettering:
    """Words on the sheet: where their base line begins, in mm, and the size of their letters."""

    text: str
    at: Spot
    size: float

    @property
    def long(self) -> float:
        """How long the words are, in mm; a subscript is smaller."""
        stem, _, index = self.text.partition("_")
        return width((Run(stem), Run(index, -1)), self.size)

    @property
    def names(self) -> list[str]:
        """The marks that are named: several that share a spot stand with commas; other words name none."""
        whole = mark(self.text)
        found = [whole] if whole else [mark(part) for part in self.text.split(",")]
        return found if all(found) else []


def lettering(text: str, at: Spot, size: float, anchor: float = 0.0) -> Lettering:
    """Words that are anchored at a part of their length: 0 at the beginning, 1 at the end."""
    begun = Lettering(text, at, size)
    return replace(begun, at=(at[0] - anchor * begun.long, at[1]))


def joined(words: Sequence[Lettering]) -> list[Lettering]:
    """Words that stand apart in a file and together on the sheet, in the order of the file: smaller ones that are set
    lower become subscripts."""
    found: list[Lettering] = []
    end = math.inf
    for word in words:
        if found and (link := _link(found[-1], end, word)) is not None:
            found[-1] = replace(found[-1], text=found[-1].text + link + word.text)
        else:
            found.append(word)
        end = word.at[0] + word.long
    return found


def _link(whole: Lettering, end: float, word: Lettering) -> str | None:
    """What stands between a text and the word that continues it; None where it does not."""
    drop, smaller = (whole.at[1] - word.at[1]) / whole.size, word.size / whole.size
    if abs(end - word.at[0]) > 0.25 * whole.size or abs(drop) > 0.6:
        return None
    if drop > 0.05:
        return "_" if SUBSCRIPT / 2 < smaller < 1.05 and "_" not in whole.text.rpartition(",")[2] else None
    return "" if abs(smaller - 1) < 0.05 and "_" in whole.text else None


def labelled(traces: Sequence[Trace], words: Sequence[Lettering]) -> list[Trace]:
    """The traces with the names beside them, the nearest pairs first; a thing of several names is several traces.

    Letters name points, Greek ones lines where there are some, and numbers what is nearer. What has a name already
    gets another only from a word that finds nothing else.
    """
    named = [(word, names) for word in words[:WORDS] if (names := word.names)]
    taken: dict[int, list[str]] = {}
    if named and traces:
        things = STRtree([Point(*trace.spots) if trace.kind == POINT else LineString(trace.spots) for trace in traces])
        wishes = sorted(wish for i, (word, names) in enumerate(named)
                        for wish in _wishes(i, word, names[0], traces, things))
        placed: set[int] = set()
        for shared in (False, True):
            for _, word, thing in wishes:
                if word not in placed and (shared or thing not in taken):
                    taken.setdefault(thing, []).extend(named[word][1])
                    placed.add(word)
    return [replace(trace, label=name, beside=i in taken) for i, trace in enumerate(traces)
            for name in taken.get(i, [trace.label])]


def _wishes(place: int, word: Lettering, name: str, traces: Sequence[Trace], things: STRtree
            ) -> list[tuple[float, int, int]]:
    """The things nearest to a word that it may name: how far each is, in mm, the word and the thing."""
    (x, y), lined = word.at, greek(name) or name.isdigit()
    box = shapely.box(x, y, x + word.long, y + CAPS * word.size)
    near = things.query(box, "dwithin", BESIDE)
    found = []
    for gap, thing in zip(shapely.distance(things.geometries[near], box), near, strict=True):
        farther = BESIDE / 2 if greek(name) and traces[thing].kind == POINT else 0.0
        if traces[thing].kind == POINT or (traces[thing].kind == LINE and lined):
            found.append((float(gap) + farther, place, int(thing)))
    return sorted(wish for wish in found if wish[0] < BESIDE)[:CHOICES]


NO_DRAWING = frozenset({"paper", "border", "corner marks", "ruling", "frame", "text", "letters", "results", "ground",
                        "drive", "motion"})  # layers of graphplan's own sheets with nothing that a construction draws
ROUNDED = 1e-4  # of a size: as files write their numbers


def same_paper(size: tuple[float, float], asked: tuple[float, float] | None) -> bool:
    """Whether one of graphplan's own files is of the size of paper that is asked for, if one is."""
    return asked is None or all(math.isclose(*pair, rel_tol=ROUNDED) for pair in zip(size, asked, strict=True))


def drawing(path: Path, traces: Iterable[Trace], words: Sequence[Lettering], frames: Frames,
            tips: Sequence[Spot] = ()) -> Submission:
    """A drawing as it was handed in: what is drawn twice is one thing, and words name what they stand beside.

    Fails with `Refused` where something lies on no sheet, there is too much of it, or nothing at all.
    """
    once = list(dict.fromkeys(traces))
    Budget(path, TRACES, "points, lines and circles").spend(len(once))
    for trace in once:
        if not on_paper(*chain.from_iterable(trace.spots)):
            raise Refused(f"{path}", f"a {trace.kind} lies farther away than {FARTHEST:g} mm, or nowhere",
                          "millimetres of paper as unit of the drawing")
    if not once:
        raise Refused(f"{path}", "nothing is drawn in it, no point, line or circle", "give the drawing itself")
    sound = [word for word in words if word.size > 0 and on_paper(*word.at, word.size)]
    found = labelled(once, joined(sound))
    shows = frozenset({LINE, *(trace.kind for trace in found)})
    ends = tuple(tip for tip in tips if on_paper(*tip))
    return Submission(path.name, tuple(found), shows=shows, frames=frames, tips=ends)
