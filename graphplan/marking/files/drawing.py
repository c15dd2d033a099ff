"""What a drawing program's file shows, put together: each thing once, sound, and with its letters."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import chain
from pathlib import Path

from graphplan.errors import Refused
from graphplan.kernel.kinds import LINE
from graphplan.marking.files.labels import Lettering, joined, labelled
from graphplan.marking.files.safe import FARTHEST, TRACES, Budget, on_paper
from graphplan.marking.traces import Frames, Submission, Trace

NO_DRAWING = frozenset({"paper", "border", "corner marks", "ruling", "frame", "text", "letters", "results", "ground",
                        "drive"})  # layers of graphplan's own sheets with nothing that a construction draws
ROUNDED = 1e-4  # of a size: as files write their numbers


def same_paper(size: tuple[float, float], asked: tuple[float, float] | None) -> bool:
    """Whether one of graphplan's own files is of the size of paper that is asked for, if one is."""
    return asked is None or all(math.isclose(*pair, rel_tol=ROUNDED) for pair in zip(size, asked, strict=True))


def drawing(path: Path, traces: Iterable[Trace], words: Sequence[Lettering], frames: Frames) -> Submission:
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
    return Submission(path.name, tuple(found), shows=frozenset({LINE, *(trace.kind for trace in found)}), frames=frames)
