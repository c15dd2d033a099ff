"""Travel: how far the first drive goes, in how many poses, and how the other drives keep pace with it.

What is asked for is refused, with the figure, where this machine's memory could not hold it.
"""

from __future__ import annotations

import math
import os

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.phrases import said

TURN = 2 * math.pi
POSE = 2048  # bytes for a pose with its results, as measured on mechanisms of four to ten links


def travels(scene: Scene, positions: int, span: tuple[float, float] | None) -> Array:
    """The first drive's travel in each pose, shape (n,): radians, or scene lengths where it slides.

    Without a span it is one full turn, whose end is its beginning; a span, in degrees or lengths, has both ends.
    Fails with :class:`Refused` where nothing drives the scene, or a sliding drive is given no span.
    """
    check_drives(scene)
    if positions < 1:
        raise Refused("the cycle", f"{positions} positions are none", "at least 1")
    afford("the cycle", positions, "positions", POSE)
    sliding = scene.drives[0].slides
    if span is None:
        if sliding:
            why = said("the first drive slides, and no turn closes its travel")
            raise Refused("the cycle", why, "a span of lengths")
        return TURN * np.arange(positions) / positions
    if not all(math.isfinite(end) for end in span):
        raise Refused("the cycle", f"the span {span[0]} to {span[1]} has no end", "two finite numbers")
    ends = span if sliding else (math.radians(span[0]), math.radians(span[1]))
    return np.linspace(*ends, positions)


def check_drives(scene: Scene) -> None:
    """Fail with :class:`Refused` where nothing drives the scene but for a moment."""
    if scene.motions or not scene.drives:
        why = said("the motion of points is given, for this pose alone" if scene.motions else "nothing drives it")
        raise Refused("the cycle", why, "a scene with a [[drive]] for each degree of freedom")


def paces(scene: Scene) -> tuple[float, ...]:
    """The travel of each drive for a unit of the first one's: its rate over the first one's."""
    first, *others = (float(drive.rate) for drive in scene.drives)
    if first == 0 and any(others):
        raise Refused("the cycle", said("the first drive stands still while another moves"),
                      "a drive that moves as the first [[drive]]")
    return (1.0, *(other / first if first else 0.0 for other in others))


def closes(scene: Scene, paces: tuple[float, ...]) -> bool:
    """Whether every drive is back where it was after one turn of the first: then going back is going round."""
    return all(pace == 0 if drive.slides else pace == round(pace)
               for drive, pace in zip(scene.drives, paces, strict=True))


def travel_unit(scene: Scene) -> tuple[float, str]:
    """The unit in which the first drive's travel is told, and its name: a degree, or the scene's length."""
    if scene.drives[0].slides:
        return 1.0, scene.units.length
    return math.radians(1.0), "degrees"


def told_travels(scene: Scene, travel: Array) -> Array:
    """Travels as numbers are told: degrees, to the digits that turning radians into them leaves, or lengths."""
    return travel if scene.drives[0].slides else np.round(np.degrees(travel), 12)


def told(scene: Scene, travel: float, digits: int = 6) -> str:
    """A travel in words: degrees, or the scene's lengths."""
    unit, name = travel_unit(scene)
    return f"{travel / unit:.{digits}g} {name}"


# ---- memory ----------------------------------------------------------------------------------------------------------


UNKNOWN = 16 * 2**30  # bytes, on a system that does not tell how many it has
PREFIXES = ("", "Ki", "Mi", "Gi", "Ti", "Pi", "Ei", "Zi", "Yi")


def afford(where: str, count: float, of: str, each: float) -> None:
    """Refuse a count `of` things with `each` so many bytes if they are more than the machine's memory."""
    held = memory()
    if count * each > held:
        why = f"{count:.6g} {of} ask for {size(count * each)} of memory, and this machine has {size(held)}"
        raise Refused(where, why, f"at most {held / each:.3g} {of}")


def memory() -> int:
    """The memory of this machine, in bytes."""
    try:
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    except (AttributeError, OSError, ValueError):
        return UNKNOWN


def size(count: float) -> str:
    """A number of bytes in words, such as 1.85 EiB."""
    place = 0
    while count >= 1024 and place < len(PREFIXES) - 1:
        count, place = count / 1024, place + 1
    return f"{count:.3g} {PREFIXES[place]}B"
