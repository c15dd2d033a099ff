"""Memory: what is asked for is refused, with the figure, where this machine could not hold it."""

from __future__ import annotations

import os

from graphplan.errors import Refused

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
