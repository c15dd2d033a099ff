"""What a drawing program's file shows, put together: each thing once, sound, and with its letters.

Which letters name which of the things is not told here: that the whole drawing tells, beside its construction.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import chain
from pathlib import Path

from shapely import Point, STRtree

from graphplan.errors import Refused
from graphplan.kernel.kinds import LINE, POINT
from graphplan.marking.files.curves import aside, dotted
from graphplan.marking.files.safe import FARTHEST, TRACES, Budget, on_paper
from graphplan.marking.spelling import lined
from graphplan.marking.tolerances import SIZE_TOL
from graphplan.marking.traces import Frames, Lettering, Spot, Submission, Trace
from graphplan.sheet.lettering.lettering import SUBSCRIPT, TextRun, width

STATED = 3.0  # what the unit that a file states speaks for itself, as a logarithm of odds
WORDS = 500  # that may be names; more name nothing
LED = 0.6  # of their size that a leader begins beside letters
AT, FREE, LONGEST = 0.3, 0.5, 30.0  # mm from a leader's end to its mark, and from the other to anything; of a leader


def lettering(text: str, at: Spot, size: float, anchor: float = 0.0) -> Lettering:
    """Words that are anchored at a part of their length: 0 at the beginning, 1 at the end; a subscript is smaller."""
    stem, _, index = text.partition("_")
    long = width((TextRun(stem), TextRun(index, -1)), size)
    return Lettering(text, (at[0] - anchor * long, at[1]), size, long)


def joined(words: Sequence[Lettering]) -> list[Lettering]:
    """Words that stand apart in a file and together on the sheet, in the order of the file: smaller ones that are set
    lower become subscripts."""
    found: list[Lettering] = []
    end = math.inf
    for word in words:
        if found and (link := _link(found[-1], end, word)) is not None:
            found[-1] = lettering(found[-1].text + link + word.text, found[-1].at, found[-1].size)
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


def led(words: Sequence[Lettering], traces: Sequence[Trace], leaders: Sequence[Trace] | None
        ) -> tuple[list[Lettering], list[Trace]]:
    """The words that name marks, with where their leaders end, and the traces without those. Some files know their
    `leaders`; of another nothing leads from a number or a Greek letter, as those stand where lines end."""
    strokes = _like_leaders(traces) if leaders is None else leaders
    words = [word for word in words if word.names]
    ends, taken = dict[int, tuple[float, Spot]](), set[Trace]()
    able = [place for place, word in enumerate(words) if leaders is not None or not lined(word.names[0])]
    boxes = STRtree([words[place].box for place in able])
    for stroke in strokes if able else ():
        gap, nearest, far = min(_beside(boxes, *spots) for spots in (stroke.spots, stroke.spots[::-1]))
        word = able[nearest]
        if gap < LED * words[word].size and gap < ends.get(word, (math.inf,))[0]:
            ends[word] = gap, far
            taken.add(stroke)
    found = [replace(word, leads=ends[place][1]) if place in ends else word for place, word in enumerate(words)]
    return found, [trace for trace in traces if trace not in taken]


def _beside(boxes: STRtree, near: Spot, far: Spot) -> tuple[float, int, Spot]:
    """The letters beside one end of a stroke: how far off they are, which they are, and where the stroke leads."""
    at = Point(*near)
    word = int(boxes.nearest(at))
    return float(boxes.geometries[word].distance(at)), word, far


def _like_leaders(traces: Sequence[Trace]) -> list[Trace]:
    """The short strokes that may be leaders: from a point to where nothing is, past no other point; none that goes on
    from another line through the point."""
    lines = [trace for trace in traces if trace.kind == LINE]
    points = STRtree([Point(*trace.spots[0]) for trace in traces if trace.kind == POINT])
    figures, strokes = STRtree([trace.figure for trace in traces]), STRtree([trace.figure for trace in lines])

    def leader(line: Trace) -> bool:
        ends = [Point(*spot) for spot in line.spots]
        marked = [bool(len(points.query(end, "dwithin", AT))) for end in ends]
        if line.figure.length > LONGEST or sum(marked) != 1 or len(points.query(line.figure, "dwithin", FREE)) > 1:
            return False
        mark, end = ends if marked[0] else ends[::-1]
        through = (lines[place] for place in strokes.query(mark, "dwithin", AT))
        return len(figures.query(end, "dwithin", FREE)) == 1 and not any(
            other is not line and aside(other.spots, (end.x, end.y)) < FREE for other in through)

    return [line for line in lines if leader(line)]


NO_DRAWING = frozenset({  # layers of graphplan's own sheets with nothing that a construction draws
    "paper", "border", "corner marks", "ruling", "frame", "text", "letters", "results", "ground", "wheels", "drive",
    "motion"})


def same_paper(size: tuple[float, float], asked: tuple[float, float] | None) -> bool:
    """Whether one of graphplan's own files is of the size of paper that is asked for, if one is."""
    return asked is None or all(math.isclose(*pair, rel_tol=SIZE_TOL) for pair in zip(size, asked, strict=True))


def drawing(path: Path, traces: Iterable[Trace], words: Sequence[Lettering], frames: Frames,
            tips: Sequence[Spot] = (), leaders: Sequence[Trace] | None = None, millimetres: float = 0.0
            ) -> Submission:
    """A drawing as it was handed in: what is drawn twice is one thing, and letters are tied to their leaders.

    Fails with `Refused` where something lies on no sheet, there is too much of it, or nothing at all.
    """
    once = list(dict.fromkeys(dotted(list(traces))))
    Budget(path, TRACES, "points, lines and circles").spend(len(once))
    for trace in once:
        if not on_paper(*chain.from_iterable(trace.spots)):
            raise Refused(f"{path}", f"a {trace.kind} lies farther away than {FARTHEST:g} mm, or nowhere",
                          "millimetres of paper as unit of the drawing")
    if not once:
        raise Refused(f"{path}", "it contains no point, line or circle", "give the drawing itself")
    sound = [word for word in words if word.size > 0 and on_paper(*word.at, word.size, word.long)]
    letters, found = led(joined(sound), once, leaders)
    shows = frozenset({LINE, *(trace.kind for trace in found)})
    ends = tuple(tip for tip in tips if on_paper(*tip))
    return Submission(path.name, tuple(found), shows=shows, frames=frames, tips=ends, letters=tuple(letters[:WORDS]),
                      millimetres=millimetres)
