"""Travel: how far the drives have gone from the given pose, each in its own sense, and how that moves their links.

The first drive's travel is the one parameter of the motion, and the others follow in proportion. A drive moves in the
sense of its omega or speed; one that stands still counter-clockwise, or along its direction. Travel is printed in
degrees, or in the scene's lengths of a drive that slides; inside it is in radians, or in the same lengths. A drive's
own coordinate, counter-clockwise or along its direction, is its travel times its sense.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from graphplan.errors import Refused
from graphplan.mechanism.model import Scene
from graphplan.mechanism.numbers import Number, Pair, Reckoning
from graphplan.mechanism.pairs.pair import LinkAttitude
from graphplan.phrases import said

if TYPE_CHECKING:
    from graphplan.mechanism.model import Scene
    from graphplan.mechanism.pairs.drives import Drive


TURN = 2 * math.pi
PRINTED_DIGITS = 12
"""Decimals of degrees that turning radians into them leaves."""


def sense(drive: Drive) -> int:
    """The sense in which a drive moves: 1 counter-clockwise, along its direction or at rest, else -1."""
    return -1 if drive.rate < 0 else 1


def sense_of_travel(scene: Scene) -> int:
    """The sense in which the first drive moves."""
    return sense(scene.drives[0]) if scene.drives else 1


def paces(scene: Scene) -> tuple[float, ...]:
    """The rate of each drive's coordinate per unit of travel; the first drive's is 1 or -1 by its sense.

    Fails with `Refused` where the first drive stands still while another moves.
    """
    first, *rates = (float(drive.rate) for drive in scene.drives)
    if first == 0 and any(rates):
        raise Refused("the cycle", said("the first drive stands still while another moves"),
                      "a drive that moves as the first [[drive]]")
    return (float(sense_of_travel(scene)), *(rate / abs(first) if first else 0.0 for rate in rates))


def kept_pace(scene: Scene, travel: Fraction) -> tuple[Fraction, ...]:
    """The printed travel of each drive where the first has gone so far and the others follow in proportion."""
    first, *drives = scene.drives
    return travel, *(travel * _pace(first, drive) for drive in drives)


def _pace(first: Drive, other: Drive) -> Fraction:
    """The travel of another drive for a unit of the first one's, both as they are printed."""
    units = {(False, True): math.radians(1.0), (True, False): math.degrees(1.0)}
    unit = Fraction(units.get((first.slides, other.slides), 1))
    return unit * abs(Fraction(other.rate) / Fraction(first.rate)) if first.rate else Fraction(0)


def coordinates(scene: Scene, travels: Sequence[Fraction]) -> tuple[Fraction, ...]:
    """Travel of the drives counter-clockwise, or along their directions."""
    return tuple(sense(drive) * travel for drive, travel in zip(scene.drives, travels, strict=True))


# ---- as it is printed ------------------------------------------------------------------------------------------------


def travel_unit(scene: Scene) -> tuple[float, str]:
    """The unit in which the first drive's travel is printed, and its name: a degree, or the scene's length."""
    if scene.drives[0].slides:
        return 1.0, scene.units.length
    return math.radians(1.0), "degrees"


def printed_travels(scene: Scene, travel: Any) -> Any:
    """Travels in degrees, or in lengths, as an array."""
    import numpy as np  # few scenes need it

    return np.asarray(travel) if scene.drives[0].slides else np.round(np.degrees(travel), PRINTED_DIGITS)


def travel_text(scene: Scene, travel: float, digits: int = 6) -> str:
    """A travel in words, with its unit."""
    unit, name = travel_unit(scene)
    return f"{travel / unit:.{digits}g} {name}"


# --- how links lie that drives have moved on -------------------------------------------------------------------------


def moved_on(given: Scene, shifts: tuple[Fraction, ...], by: Reckoning) -> tuple[Pair, ...]:
    """The motion of each driven link by a shift in degrees or lengths, counter-clockwise or along its direction: the
    cosine and sine of a turn, or the vector of a shift."""
    moves: list[Pair] = []
    for drive, shift in zip(given.drives, shifts, strict=True):
        if not drive.slides:
            moves.append(by.heading(shift)[:2])
            continue
        x, y = given.driven_slide(drive).direction
        square = x * x + y * y
        share = shift / by.root(Fraction(square) if isinstance(square, float) else square)[0]
        moves.append((x * share, y * share))
    return tuple(moves)


STILL = LinkAttitude(0, 0, 1, 0)


def turned_about(at: Pair, cos: Number, sin: Number) -> LinkAttitude:
    """A turn about a point."""
    x, y = at
    return LinkAttitude(x - cos * x + sin * y, y - sin * x - cos * y, cos, sin)


def following(first: LinkAttitude, then: LinkAttitude) -> LinkAttitude:
    """Compose two attitudes: `first`, then `then`."""
    x, y = then.place_of((first.x, first.y))
    return LinkAttitude(x, y, then.cos * first.cos - then.sin * first.sin,
                        then.sin * first.cos + then.cos * first.sin)


def undone(attitude: LinkAttitude, at: Pair) -> Pair:
    """The point that an attitude brings to a place."""
    x, y = at[0] - attitude.x, at[1] - attitude.y
    return attitude.cos * x + attitude.sin * y, attitude.cos * y - attitude.sin * x
