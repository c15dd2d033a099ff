"""Breaks: the travels at which a load by a table has a corner or jumps, or changes the stroke.

Those over travel are as they are written. Those over a slide's position are where the slide passes its places, and at
its dead points: found between samples of the motion by Newton's method, kept between the ends of a bracket.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from functools import partial

import numpy as np

from graphplan.cycle.linkage import Array
from graphplan.machine.reduced.reduced_loads import LoadValues
from graphplan.machine.reduced.unit_motion import UnitMotion
from graphplan.machine.tolerances import BREAK_DISTANCE, BREAK_TOL, TABLE_TOL
from graphplan.mechanism.loads import TRAVEL, LoadTable
from graphplan.mechanism.model import Slide
from graphplan.mechanism.travel import TURN
from graphplan.methods import kinds

SAMPLES = 360  # of the motion in each turn, between which a slide changes its sense once at most
ASIDE = 0.38  # of the way between two samples
ROUNDS = 60

Function = Callable[[Array], tuple[Array, Array]]


def breaks(loads: LoadValues, motion: UnitMotion, ends: tuple[float, float]) -> tuple[float, ...]:
    """The travels between two ends at which the tables of loads have corners, jump or change strokes, in order."""
    tables = [load.table for load in loads.tabled if load.table]
    found = [travel for table in tables if table.over == TRAVEL for travel in _written(table, motion, ends)]
    for name, slide in loads.slides.items():
        over = [table for table in tables if table.slide == name]
        found += _passed(loads, motion, slide, over, ends)
    return in_order(found, ends)


def in_order(found: Iterable[float], ends: tuple[float, float]) -> tuple[float, ...]:
    """Travels between two ends in order, those that are next to each other once; those beyond the end are those of the
    next round."""
    low, high = ends
    found = (low + (travel - low) % (high - low) if travel > high else travel for travel in found)
    close, kept = BREAK_DISTANCE * (high - low), [low]
    for travel in sorted(found):
        if travel - kept[-1] > close and high - travel > close:
            kept.append(travel)
    return tuple(kept[1:])


def _written(table: LoadTable, motion: UnitMotion, ends: tuple[float, float]) -> Iterator[float]:
    """The places of a table over travel, and as it repeats."""
    unit = math.radians(1.0) if motion.turns else 1.0
    for place in table.corners:
        if not table.period:
            yield float(place) * unit
            continue
        first, period = float(place) * unit, float(table.period) * unit
        for turn in range(math.floor((ends[0] - first) / period), math.ceil((ends[1] - first) / period) + 1):
            yield first + turn * period


def samples(motion: UnitMotion, ends: tuple[float, float]) -> Array:
    """Travels between which a pair changes its sense once at most: of a closed cycle all round, the last that of the
    first again, and none of them at a round place, where a pair may stand still."""
    turns = (ends[1] - ends[0]) / TURN if motion.turns else 1.0
    count = max(2, math.ceil(SAMPLES * turns))
    return np.linspace(*ends, count + 1) + (ASIDE * (ends[1] - ends[0]) / count if motion.period else 0.0)


def _passed(loads: LoadValues, motion: UnitMotion, slide: Slide, tables: list[LoadTable],
            ends: tuple[float, float]) -> list[float]:
    """Where a slide is at a dead point, or passes a place of tables over its position."""
    travel = samples(motion, ends)

    def place(travel: Array) -> tuple[Array, Array]:
        turn = motion.turn(travel)
        return loads.place(slide, turn), loads.speed(slide, turn, motion.velocities(turn)) * motion.unit / motion.metres

    def speed(travel: Array) -> tuple[Array, Array]:
        turn = motion.turn(travel)
        change = loads.speed(slide, turn, motion.accelerations(turn), kinds.SLIDE_ACCELERATION)
        return loads.speed(slide, turn, motion.velocities(turn)), change * motion.unit

    dead = zeros(speed, travel, speed(travel)[0])
    strokes = np.unique(np.concatenate([travel, dead]))
    places, turned = place(strokes)[0], place(np.array(dead))[0] if dead else np.zeros(0)
    found = list(dead)
    for table in tables:
        for corner in table.corners if table.over_position else ():
            if not np.any(np.abs(turned - float(corner)) <= TABLE_TOL * float(table.length)):
                found += zeros(partial(_beyond, place, float(corner)), strokes, places - float(corner))
    return found


def _beyond(place: Function, corner: float, travel: Array) -> tuple[Array, Array]:
    """How far a slide is beyond a place, and how that changes."""
    value, slope = place(travel)
    return value - corner, slope


def zeros(function: Function, travel: Array, values: Array) -> list[float]:
    """Where a function, which gives values and slopes, is zero: once between samples of different signs, and at samples
    that are zero."""
    exact, crossed = travel[:-1][values[:-1] == 0], np.flatnonzero(values[:-1] * values[1:] < 0)
    return [*map(float, exact), *refined(function, travel[crossed], travel[crossed + 1], values[crossed],
                                         values[crossed + 1])]


def refined(function: Function, low: Array, high: Array, before: Array, after: Array) -> list[float]:
    """Where a function is zero, once between each `low` and `high`, where it has values of different signs.

    By Newton's method, or with slopes that are nan by secants; a step that leaves the bracket is one to its middle.
    """
    rising, last, left = after > 0, low, before
    at = low + (high - low) * (before / (before - after))
    for _ in range(ROUNDS if low.size else 0):
        value, slope = function(at)
        below = (value < 0) == rising
        low, high = np.where(below, at, low), np.where(below, high, at)
        with np.errstate(all="ignore"):
            step = at - value / np.where(np.isfinite(slope), slope, (value - left) / (at - last))
        new = np.where((step >= low) & (step <= high), step, np.where(value == 0, at, (low + high) / 2))
        moved, last, left, at = np.abs(new - at), at, value, new
        if np.all(moved <= BREAK_TOL * np.maximum(1.0, np.abs(at))):
            break
    return [*map(float, at)]


def common_period(period: float, tables: list[LoadTable]) -> float:
    """The travel, in radians, after which both the mechanism and the tables over travel are back."""
    turns = [Fraction(table.period) / 360 for table in tables if table.period]
    return math.lcm(round(period / TURN), *map(int, turns)) * TURN
