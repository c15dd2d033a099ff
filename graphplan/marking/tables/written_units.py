"""Units as students write them, `mm/s²`, `m s^-1`, `kN·m`, `rpm`, and what they are in the scene's own units."""

from __future__ import annotations

import math
import re

from graphplan.mechanism.model import Units
from graphplan.mechanism.units import KILOGRAMS, METRES, MOMENT, NEWTONS, Dimension

BASES: dict[str, tuple[float, tuple[int, int, int]]] = {
    **{name: (float(size), (1, 0, 0)) for name, size in METRES.items()},
    **{name: (float(size), (-1, 2, 1)) for name, size in KILOGRAMS.items()},
    **{name: (float(size), (0, 0, 1)) for name, size in NEWTONS.items()},
    "kp": (float(NEWTONS["kgf"]), (0, 0, 1)), "MN": (1e6, (0, 0, 1)), "daN": (10.0, (0, 0, 1)),
    "s": (1.0, (0, 1, 0)), "sec": (1.0, (0, 1, 0)), "ms": (1e-3, (0, 1, 0)), "min": (60.0, (0, 1, 0)),
    "h": (3600.0, (0, 1, 0)), "km": (1000.0, (1, 0, 0)), "dm": (0.1, (1, 0, 0)),
    "rad": (1.0, (0, 0, 0)), "1": (1.0, (0, 0, 0)), "deg": (math.pi / 180, (0, 0, 0)),
    "°": (math.pi / 180, (0, 0, 0)), "rev": (2 * math.pi, (0, 0, 0)), "rpm": (math.pi / 30, (0, -1, 0)),
}  # fmt: skip
RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻−", "0123456789--")
FACTOR = re.compile(r"(1|[A-Za-z°]+)(?:\^?\(?([+-]?[0-9])\)?)?")
LONGEST = 30  # characters


def factor(written: str, dimension: Dimension, units: Units) -> float:
    """What one of a written unit is in the scene's units of this dimension.

    Fails with `ValueError` where it is no unit, or none of this dimension.
    """
    size, powers = 1.0, [0, 0, 0]
    for name, power in _factors(written):
        if name not in BASES:
            raise ValueError(f"{written!r} is no unit that is known")
        one, bases = BASES[name]
        size *= one**power
        powers = [total + power * base for total, base in zip(powers, bases, strict=True)]
    if tuple(powers) != dimension[:3]:
        raise ValueError(f"{written!r} is no such unit as {example(dimension)}")
    return size / _scene(dimension, units)


def _factors(written: str) -> list[tuple[str, int]]:
    """The factors of a unit with their powers; all that stands after a slash divides."""
    if len(written) > LONGEST:
        raise ValueError(f"{written[:LONGEST]!r}... is no unit that is known")
    found = []
    for place, part in enumerate(written.translate(RAISED).split("/")):
        for piece in re.split(r"[\s·*⋅×.]+", part.strip(" ()")):
            fits = FACTOR.fullmatch(piece)
            if fits is None:
                raise ValueError(f"{written!r} is no unit that is known")
            found.append((fits[1], int(fits[2] or 1) * (-1 if place else 1)))
    return found


def example(dimension: Dimension) -> str:
    """Such a unit, as a student may write it."""
    return dimension.unit(Units()).replace("*", "·")


def _scene(dimension: Dimension, units: Units) -> float:
    """The scene's unit of this dimension in metres, seconds and newtons; moments are in its forces times metres."""
    force = float(NEWTONS[units.force]) ** dimension.force
    return force if dimension == MOMENT else force * float(METRES[units.length]) ** dimension.length
