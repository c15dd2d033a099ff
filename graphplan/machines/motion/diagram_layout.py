"""Where the diagrams of a motion lie on paper, and their scales.

Those over the travel stand under each other; the inertia, turned, and the energy-mass diagram stand right of moments
and energies. Where the energy varies little its origin lies off the paper: energy, inertia and speed then show no more
than the range of their values.

Source: Ozols 1974, fig. 13-9, (13.36) and (13.37).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from graphplan.cycle.curves import AxisScale, Frame, round_scale
from graphplan.kernel.numbers.arrays import Reals
from graphplan.machines.motion.strips import times
from graphplan.machines.tolerances import MIN_RANGE, SCALE_TOL

# mm: for poles, between the two columns of diagrams, and between their rows
POLE_ROOM_MM, COLUMN_GAP_MM, ROW_GAP_MM = 34.0, 22.0, 12.0
MIN_POLE_MM, MAX_POLE_MM = 4.5, 30.0  # mm: poles from their axes
SHARES = {"moment": 0.17, "energy": 0.28, "omega": 0.19, "slowness": 0.16, "time": 0.2}  # of what is free: heights
# of what is free: the axis of travel, the largest inertia; of that, c at most
TRAVEL_SHARE, INERTIA_SHARE, RAY_CUT_SHARE = 0.66, 0.22, 0.6
MAX_SLOWNESS_RATIO = 8.0  # times the least 1/omega: what is larger goes off the paper
MIN_ENERGY_SHARE = 0.5  # of the largest energy: where the least is more the origin is off the paper
MARGIN = 0.08  # of a range, beyond it
SCALE_STEPS = 1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0  # of the scale of travel, which fills its room


class PanelSize(NamedTuple):
    """How large all diagrams together may be, in mm."""

    width: float = 280.0
    height: float = 250.0

    @property
    def free(self) -> float:
        """What poles and gaps leave of the width."""
        return self.width - POLE_ROOM_MM - COLUMN_GAP_MM

    @property
    def heights(self) -> dict[str, float]:
        """The heights of the diagrams under each other."""
        free = self.height - (len(SHARES) - 1) * ROW_GAP_MM
        return {name: share * free for name, share in SHARES.items()}


@dataclass(frozen=True, eq=False)
class MotionLayout:
    """The diagrams of what is drawn: moments of the strips, the least and the largest moment of all, and at the
    divisions travel (from the beginning), energies, inertias and speeds, in SI; `first` is the division from which the
    time is integrated, `degree` the unit of travel.

    The motion may end where there is no division any more: `whole` is its travel.
    """

    travel: Reals
    moments: Reals
    extreme_moments: tuple[float, float]
    energies: Reals
    inertias: Reals
    omegas: Reals
    first: int
    whole: float
    degree: float
    room: PanelSize

    @cached_property
    def origin_off_paper(self) -> bool:
        """Whether the origin of the energy-mass diagram is off the paper."""
        return bool(self.energies.min() > MIN_ENERGY_SHARE * self.energies.max())

    @cached_property
    def k(self) -> dict[str, float]:
        """What one mm stands for, round."""
        high, span = self.room.heights, (1 + 2 * MARGIN) * float(np.ptp([*self.extreme_moments, 0.0]))
        slowness = 1 / self.omegas[max(1, self.first):]
        least = self.whole / self.degree / (TRAVEL_SHARE * self.room.free)
        phi = self.degree * fine_scale(least)
        energy = _scale(self._span(self.energies) / high["energy"])
        moment = _scale(max(span / high["moment"], energy / phi / MAX_POLE_MM))
        slow = min(slowness.max(), MAX_SLOWNESS_RATIO * slowness.min()) / high["slowness"]
        time = _scale(float(np.nanmax(times(self.travel, self.omegas))) / high["time"])
        slow = _scale(max(slow, time / phi / MAX_POLE_MM))
        return {"travel": phi, "moment": moment, "energy": max(energy, _scale(MIN_POLE_MM * moment * phi)),
                "inertia": _scale(self._span(self.inertias) / (INERTIA_SHARE * self.room.free)),
                "omega": _scale(self._span(self.omegas) / high["omega"]), "slowness": slow,
                "time": max(time, _scale(MIN_POLE_MM * slow * phi))}

    def _span(self, values: Reals) -> float:
        """What of some values is shown: from nothing on, or their range alone."""
        top = float(values.max())
        return max(top - self._low(values), MIN_RANGE * top)

    def _low(self, values: Reals) -> float:
        """The least value that is shown."""
        low, high = float(values.min()), float(values.max())
        return low - MARGIN * (high - low) if self.origin_off_paper else 0.0

    @cached_property
    def poles(self) -> tuple[float, float]:
        """The distances of the poles of moments and of 1/omega, in mm."""
        k = self.k
        return k["energy"] / k["moment"] / k["travel"], k["time"] / k["slowness"] / k["travel"]

    @cached_property
    def c(self) -> float:
        """Where rays of the energy-mass diagram are cut, in mm from its origin."""
        steepest = float((self.energies / self.inertias).max()) * self.k["inertia"] / self.k["energy"]
        return min(INERTIA_SHARE * self.room.free * RAY_CUT_SHARE, self.room.heights["energy"] / steepest)

    @cached_property
    def d(self) -> float:
        """The length that makes with c tan psi the mean proportional omega, in mm."""
        return 2 * self.k["energy"] / (self.k["inertia"] * self.c * self.k["omega"] ** 2)

    @cached_property
    def q(self) -> float:
        """The mean proportional of omega and 1/omega, in mm."""
        return 1 / math.sqrt(self.k["omega"] * self.k["slowness"])

    @cached_property
    def frames(self) -> dict[str, Frame]:
        """The diagrams by name, in SI; `reciprocal` is where 1/omega is constructed."""
        frames, top, k = dict[str, Frame](), 0.0, self.k
        travel, level = AxisScale(k["travel"]), (0.0, self.whole / k["travel"])
        lowest = {"moment": min(self.extreme_moments[0], 0.0) * (1 + MARGIN), "energy": self._low(self.energies),
                  "omega": self._low(self.omegas)}
        for name, height in self.room.heights.items():
            upright = AxisScale(k[name], lowest.get(name, 0.0))
            frames[name] = Frame((0.0, top - height), travel, upright, level, (0.0, height))
            top -= height + ROW_GAP_MM
        right, wide = level[1] + COLUMN_GAP_MM, (0.0, INERTIA_SHARE * self.room.free)
        inertia, energy, omega = AxisScale(k["inertia"], self._low(self.inertias)), frames["energy"], frames["omega"]
        low, high = frames["moment"].upright
        down = AxisScale(-self.whole / (high - low))
        frames["energy-mass"] = Frame((right, energy.origin[1]), inertia, energy.y, wide, energy.upright)
        frames["inertia"] = Frame((right, 0.0), inertia, down, wide, (low - high, 0.0))
        frames["reciprocal"] = Frame((right, omega.origin[1]), AxisScale(1.0), AxisScale(1.0), wide, omega.upright)
        return frames


def fine_scale(least: float) -> float:
    """The least of a fine series of scales that is no smaller."""
    power = 10.0 ** math.floor(math.log10(least))
    return power * next(step for step in SCALE_STEPS if step * power >= least * (1 - SCALE_TOL))


def _scale(least: float) -> float:
    return float(round_scale(float(least)))
