"""Settings that are given as one text, such as `point=0.2,angle=0.1`."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection

from graphplan.errors import Refused


def settings(option: str, text: str, known: Collection[str], unknown: str,
             size: Callable[[str, str], float]) -> dict[str, float]:
    """What a text says of the `known` settings; `size` reads each from its name and what is given for it.

    Fails with `Refused`, in the words `unknown`, where it names another one, and where it names one twice.
    """
    found: dict[str, float] = {}
    for entry in filter(None, text.split(",")):
        name, _, given = (part.strip() for part in entry.partition("="))
        if name not in known:
            raise Refused(f"{option} {entry}", unknown, f"one of {', '.join(known)}")
        if name in found:
            raise Refused(f"{option} {text}", f"{name} is told twice", "tell it once")
        found[name] = size(name, given)
    return found


def decimal(text: str) -> float:
    """A number, or nan where it is none."""
    try:
        return float(text)
    except ValueError:
        return math.nan
