"""Centrodes: the paths of a link's pole relative to another, on the one and on the other, from the links' rates.

The fixed centrode lies on the link that is moved on, the moving one on the link that moves; the moving one rolls on the
fixed one. Where the two links turn alike the pole is at infinity: a centrode has branches, which no line joins.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.cycle.rates import Moved
from graphplan.cycle.tolerances import TURNING_TOL
from graphplan.cycle.turn import RangeOfMotion

FINER = 12
"""How often the travel between two poles is halved at most."""

CHORDS = 256
"""How many of the longest chords that are drawn reach as far as a centrode is drawn."""


class Centrodes(NamedTuple):
    """The poles of a link relative to another in n poses, both links as they were given: on the other one (`fixed`) and
    on itself (`moving`), complex arrays of shape (n,), nan where there is no pole."""

    fixed: Array
    moving: Array


def centrodes(links: Mapping[str, Moved], link: str, on: str) -> Centrodes:
    """The centrodes of a link that moves relative to another."""
    one, other = links[link], links[on]
    turning, slip = one.spin - other.spin, one.velocity - other.velocity_at(one.base)
    turning = np.where(np.abs(turning) > TURNING_TOL * (np.abs(one.spin) + np.abs(other.spin)), turning, np.nan)
    with np.errstate(all="ignore"):
        pole = one.base + 1j * slip / turning
    return Centrodes(other.carried_back(pole), one.carried_back(pole))


def rolling(motion: RangeOfMotion, travel: Array) -> dict[str, Centrodes]:
    """The centrodes that the scene's sheet asks for at these travels, by the names of the two links."""
    wanted = motion.scene.sheet.centrodes
    links = motion.moved(travel) if wanted else {}
    return {names: centrodes(links, *names.split()) for names in wanted}


def branches(motion: RangeOfMotion, link: str, on: str, travel: Array, middle: complex,
             far: float) -> tuple[list[Array], list[Array]] | None:
    """The branches of the fixed and of the moving centrode, as far as they are no further from the middle; complex
    arrays. None where the two links turn alike all the way.

    `travel` grows. Between poles that lie too far apart for a chord more are sought; where even the finest travel does
    not bring them together, they lie on two branches.
    """
    longest, found = far / CHORDS, centrodes(motion.moved(travel), link, on)
    if np.isnan(found.fixed).all():
        return None
    for _ in range(FINER):
        wide = np.any([_near(places, middle, far) & ~(np.abs(np.diff(places)) <= longest) for places in found], axis=0)
        between = (travel[1:] + travel[:-1])[wide] / 2
        if not between.size:
            break
        order = np.argsort(np.concatenate([travel, between]), kind="stable")
        more = centrodes(motion.moved(between), link, on)
        travel = np.concatenate([travel, between])[order]
        found = Centrodes(*(np.concatenate(parts)[order] for parts in zip(found, more, strict=True)))
    fixed, moving = ([*parted(places, middle, far, longest)] for places in found)
    return fixed, moving


def _near(places: Array, middle: complex, far: float) -> Array:
    """Between which places a curve may be near enough to be drawn: one of the two is."""
    near = np.abs(places - middle) <= far
    return near[1:] | near[:-1]


def parted(places: Array, middle: complex, far: float, longest: float) -> Iterator[Array]:
    """The stretches of a curve that are near and whole."""
    near = np.abs(places - middle) <= far
    joined = near[1:] & near[:-1] & (np.abs(np.diff(places)) <= longest)
    for part in np.split(np.arange(places.size), np.flatnonzero(~joined) + 1):
        if part.size > 1:
            yield places[part]
