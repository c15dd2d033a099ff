"""Numbers of a machine over its cycle, which no drawing of one pose has: judged beside what is expected of them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

from graphplan.marking.judge import measures
from graphplan.marking.judge.student_sheet import bound
from graphplan.marking.judge.verdict import RIGHT, WRONG, Judgement, NumberVerdict
from graphplan.marking.tables.results import in_scene_units, scene_unit
from graphplan.marking.traces import Number
from graphplan.mechanism.model import Units
from graphplan.methods.kinds import CYCLE
from graphplan.phrases import Said, digits, said


class Expected(NamedTuple):
    """What a number should be, the standard deviation of what a pencil makes of it, and by how much the drawing with so
    many plans is off: in the scene's units."""

    value: float
    deviation: float
    off: float = 0.0


Expecting = Callable[[str, str], Expected | None]  # by kind, and by travel in degrees where it has one


def with_cycle(judgement: Judgement, expecting: Expecting) -> Judgement:
    """The judgement with the verdicts on numbers over the cycle, once on each; others are not asked for."""
    units = judgement.drawing.scene.units
    found, unasked = dict[tuple[str, str], NumberVerdict](), list[Number]()
    for number in judgement.unasked:
        expected = expecting(number.kind, number.of) if number.kind in CYCLE else None
        key = number.kind, number.of
        if expected is None:
            unasked.append(number)
        elif key in found:
            found[key] = replace(found[key], again=(*found[key].again, number))
        else:
            found[key] = _judged(number, expected, units)
    return replace(judgement, numbers=(*judgement.numbers, *found.values()), unasked=tuple(unasked))


def _judged(number: Number, expected: Expected, units: Units) -> NumberVerdict:
    """The verdict on one number, with the slip that makes a wrong one right."""
    value, = in_scene_units(number, units)
    deviation = math.hypot(expected.deviation, number.rounding * scene_unit(number, units))
    allowed = expected.off + math.sqrt(bound(1, measures.FALSE_ALARM_CHANCE)) * deviation

    def off(tried: float) -> float:
        return abs(tried - expected.value)

    slips: list[tuple[str, Said, float]] = [("reversed", said("the sign is reversed"), -value)]
    slips += [("wrong scale", said("the number is {0} times as large as it should be", digits(factor, 3)),
               value / factor) for factor in measures.NUMBER_FACTORS]
    right = off(value) <= allowed
    kind, told, _ = next((slip for slip in slips if not right and off(slip[2]) <= allowed), ("", None, 0.0))
    return NumberVerdict(number, RIGHT if right else WRONG, off(value), allowed, (expected.value,), told, kind)
