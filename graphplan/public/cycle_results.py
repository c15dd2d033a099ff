"""What a scene's flywheel gives beside the results of its pose: in keys of variants, and expected of students."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from graphplan.accuracy.hand import Pencil
from graphplan.marking.classroom.booklet import KeyRow, single_row
from graphplan.marking.judge.numbers import ExpectedCycleNumber
from graphplan.mechanism.model import Scene
from graphplan.mechanism.units import KILOGRAMS, NEWTONS
from graphplan.methods.kinds import CYCLE
from graphplan.public.machine import pencil_errors

if TYPE_CHECKING:
    from graphplan.machine.flywheel.result import FlywheelResult

MOMENT, INERTIA, CLOSING, FLYWHEEL = CYCLE
PLACES = {MOMENT: "moment", INERTIA: "inertia"}  # by their names among what there is at a plan


@dataclass(frozen=True)
class CycleResults:
    """The results over the cycle of a scene whose flywheel is asked for and whose first drive turns, else none."""

    scene: Scene
    pencil: Pencil

    @cached_property
    def flywheel(self) -> FlywheelResult | None:
        if self.scene.flywheel is None or self.scene.drives[0].slides:
            return None
        from graphplan.machine.flywheel.result import flywheel

        return flywheel(self.scene)

    def expected_result(self, kind: str, of: str) -> ExpectedCycleNumber | None:
        """What is expected of a number, if it is one of these: a travel in degrees is any of the cycle."""
        result = self.flywheel
        if result is None or (kind == FLYWHEEL and result.given):
            return None
        if kind in PLACES:
            try:
                travel = math.radians(float(of))
            except ValueError:
                return None
            return self._expected_at(result, kind,
                                     travel) if result.cycle.ends[0] <= travel <= result.cycle.ends[1] else None
        if of:
            return None
        one, (wheel, mean) = self._unit(kind), pencil_errors(result, self.pencil)
        if kind == CLOSING:
            closing = result.cycle.closing
            return ExpectedCycleNumber(closing / one, mean / one, abs(result.drawing.mean + closing) / one)
        return ExpectedCycleNumber(result.wheel.inertia / one, wheel / one, result.strip_error / one)

    def _expected_at(self, result: FlywheelResult, kind: str, travel: float) -> ExpectedCycleNumber:
        import numpy as np

        value = float(result.values_at(np.array([travel]))[PLACES[kind]][0])
        return ExpectedCycleNumber(value / self._unit(kind), self._read(result, kind))

    def _unit(self, kind: str) -> float:
        """The scene's unit, in kg m^2 or N m."""
        units = self.scene.units
        return float(NEWTONS[units.force] if kind in (MOMENT, CLOSING) else KILOGRAMS[units.mass])

    def _read(self, result: FlywheelResult, kind: str) -> float:
        """The standard deviation of an ordinate that is plotted and read off."""
        frame = result.drawing.frames[PLACES[kind]]
        scale = frame.y.unit if kind == MOMENT else frame.x.unit
        return math.sqrt(2) * self.pencil.point * scale / self._unit(kind)

    @property
    def rows(self) -> Iterator[KeyRow]:
        """The rows of a key: moment and inertia at each plan, the closing moment, and the flywheel."""
        result, units = self.flywheel, self.scene.units
        if result is None:
            return
        for kind, name in PLACES.items():
            values = result.plans[name] / self._unit(kind)
            for travel, value in zip(result.travels_in_degrees, values, strict=True):
                yield single_row(CYCLE[kind], f"{travel:g}", float(value), float(abs(values).max()), units)
        for kind in (CLOSING, FLYWHEEL):
            if expected := self.expected_result(kind, ""):
                yield single_row(CYCLE[kind], "", expected.value, abs(expected.value), units)


def key_rows(scene: Scene) -> Iterator[KeyRow]:
    """The further rows of the key of a variant."""
    yield from CycleResults(scene, Pencil()).rows
