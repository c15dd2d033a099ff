"""The poses of a cycle: in how many, and at which travels of the first drive.

What is asked for is refused, with the figure, where this machine's memory could not hold it.
"""

from __future__ import annotations

import math
import os

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.mechanism.travel import TURN
from graphplan.phrases import said

POSE_BYTES = 2048  # bytes for a pose with its results, as measured on mechanisms of four to ten links


class Travels:
    """The first drive's travel in each of any number of poses: radians, or scene lengths where it slides.

    Without a span it is one full turn, whose end is its beginning; a span, in degrees or lengths, has both ends.
    Fails with :class:`Refused` where nothing drives the scene, or a sliding drive is given no span.
    """

    def __init__(self, scene: Scene, positions: int, span: tuple[float, float] | None):
        check_drives(scene)
        if positions < 1:
            raise Refused("the cycle", f"{positions} positions", "give at least 1")
        sliding = scene.drives[0].slides
        self.positions, self.span = positions, span
        if span is None:
            if sliding:
                why = said("the first drive slides, and no turn closes its travel")
                raise Refused("the cycle", why, "a span of lengths")
            self.ends = 0.0, TURN * (positions - 1) / positions
            return
        if not all(math.isfinite(end) for end in span):
            raise Refused("the cycle", f"the span {span[0]} to {span[1]} has no end", "two finite numbers")
        self.ends = span if sliding else (math.radians(span[0]), math.radians(span[1]))

    def part(self, start: int, stop: int) -> Array:
        """Travels of the poses from one number to before another, an array."""
        places = np.arange(start, min(stop, self.positions))
        if self.span is None:
            return TURN * places / self.positions
        begin, end = self.ends
        travel = begin + places * ((end - begin) / max(1, self.positions - 1))
        travel[places == self.positions - 1] = end if self.positions > 1 else begin
        return travel


def travels(scene: Scene, positions: int, span: tuple[float, float] | None) -> Array:
    """All of them, shape (n,); fails also where this machine's memory could not hold so many poses."""
    poses = Travels(scene, positions, span)
    afford_poses(positions)
    return poses.part(0, positions)


def afford_poses(positions: int) -> None:
    """Refuse more poses, with all their results, than this machine's memory holds."""
    afford("the cycle", positions, "positions", POSE_BYTES)


def check_drives(scene: Scene) -> None:
    """Fail with :class:`Refused` if the scene has no drive, or gives a motion for one moment only."""
    if scene.motions or not scene.drives:
        why = said("the motion of points is given, for this pose alone" if scene.motions else "it has no drive")
        raise Refused("the cycle", why, "a scene with a [[drive]] for each degree of freedom")


def drives_return(scene: Scene, paces: tuple[float, ...]) -> bool:
    """Whether every drive is back where it was after one turn of the first: then going back is going round."""
    return all(pace == 0 if drive.slides else pace == round(pace)
               for drive, pace in zip(scene.drives, paces, strict=True))


# ---- memory ----------------------------------------------------------------------------------------------------------


DEFAULT_MEMORY = 16 * 2**30  # bytes, on a system that does not tell how many it has
PREFIXES = ("", "Ki", "Mi", "Gi", "Ti", "Pi", "Ei", "Zi", "Yi")


def afford(where: str, count: float, of: str, each: float) -> None:
    """Refuse a count `of` things with `each` so many bytes if they are more than the machine's memory."""
    available = memory()
    if count * each > available:
        asked_text, available_text = memory_text(count * each), memory_text(available)
        why = f"{count:.6g} {of} ask for {asked_text} of memory, and this machine has {available_text}"
        raise Refused(where, why, f"at most {available / each:.3g} {of}")


def memory() -> int:
    """The memory of this machine, in bytes."""
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, OSError, ValueError):
        return DEFAULT_MEMORY


def memory_text(count: float) -> str:
    """A number of bytes in words, such as 1.85 EiB."""
    place = 0
    while count >= 1024 and place < len(PREFIXES) - 1:
        count, place = count / 1024, place + 1
    return f"{count:.3g} {PREFIXES[place]}B"
