"""Where the flywheel's diagrams lie, in mm of paper: what the plans give, round scales, and the frame of each diagram.

The moment's diagram stands over that of the energy, with the travel as their common abscissa; the diagram of the
inertia is turned, its ordinates over those of the energy-mass diagram, which has its energies from that beside it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from graphplan.cycle.diagrams import round_scale
from graphplan.kernel.numbers.arrays import Reals
from graphplan.machines.flywheel.steady_cycle import FlywheelSpeeds, SteadyCycle
from graphplan.machines.tolerances import MOMENT_JUMP, ORDINATE_TOL
from graphplan.sheet.diagrams import AxisScale, Frame

MIN_POLE_MM, MAX_POLE_MM = 12.0, 45.0  # the pole from the axis, in mm
COLUMN_GAP_MM, ROW_GAP_MM = 20.0, 16.0  # between the columns and the rows of diagrams, in mm
# on the axis I = 0 the intercept may be so much longer than on a parallel, for that axis to be drawn
MAX_AXIS_RATIO = 1.3
MISSED_CORNER_SHARE = 0.005  # of the energy's range: a chord that is more off passes a corner by


@dataclass(frozen=True)
class DiagramSizes:
    """Room of the diagrams, in mm: the common abscissa, the ordinates of moments, energies and inertias, and the
    abscissa of the turned diagram."""

    travel: float = 150.0
    moment: float = 60.0
    energy: float = 130.0
    inertia: float = 60.0
    turned: float = 75.0


@dataclass(frozen=True)
class CyclePlans:
    """Numbers of the plans: travels in radians, the moments on either side of each, and the inertias."""

    travels: Reals
    left: Reals
    right: Reals
    inertias: Reals

    @property
    def mean(self) -> float:
        """The mean of the strips' moments, each the mean of its two ends."""
        return float(self.strips @ np.diff(self.travels)) / float(self.travels[-1] - self.travels[0])

    @property
    def strips(self) -> Reals:
        """The mean moment of each strip."""
        return (self.right[:-1] + self.left[1:]) / 2

    @cached_property
    def energies(self) -> Reals:
        """The energy at each plan by the strips, where the mean closes the cycle."""
        return np.append(0.0, np.cumsum((self.strips - self.mean) * np.diff(self.travels)))

    def gaps(self, cycle: SteadyCycle) -> Reals:
        """By how much the work of each strip is off, as its chord is no curve."""
        return np.abs(np.diff(cycle.energy.at(self.travels)) - np.diff(self.energies))

    def energy_error(self, cycle: SteadyCycle, j: int, k: int) -> float:
        """By how much the energies of two plans may be off against each other, as chords are no curves.

        The errors of the strips on the better way from one to the other are added up, whatever their signs.
        """
        gaps, (low, high) = self.gaps(cycle), sorted((j, k))
        return float(min(gaps[low:high].sum(), gaps[:low].sum() + gaps[high:].sum()))

    def travels_around(self, travels: Reals, places: Sequence[int]) -> Reals:
        """The travels of plans, those beyond the last in the next cycle."""
        count = len(travels) - 1
        return np.array([travels[k % count] + (travels[-1] - travels[0]) * (k // count) for k in places])

    def heights(self, slope: float) -> Reals:
        """Heights of the points of the energy-mass curve over a line of a slope, in J."""
        return self.energies - slope * self.inertias

    def outermost(self, slope: float, above: bool) -> int:
        """The plan whose point a tangent of a slope meets first, from above or below: the first of equals."""
        heights = self.heights(slope) * (1 if above else -1)
        return int(np.argmax(heights[:-1] >= heights.max() - ORDINATE_TOL * np.ptp(heights)))

    def parabola_error(self, slope: float, k: int) -> float:
        """By how much the vertex of a parabola through three points about a plan is off the curve's, in J.

        Of a cubic it is a sixteenth of the third difference of four neighbours at most; corners between plans can make
        it more than twice that.
        """
        around = np.arange(k - 3, k + 4) % (len(self.travels) - 1)
        return float(np.abs(np.diff(self.heights(slope)[around], 3)).max()) / 6

    def jumps(self, k: int) -> bool:
        """Whether the moment jumps at a plan."""
        size = max(float(np.abs(self.right).max()), float(np.abs(self.left).max()))
        return bool(abs(self.right[k] - self.left[k]) > MOMENT_JUMP * size)


def plans_of(cycle: SteadyCycle, positions: int) -> CyclePlans:
    """The plans at even travels, and at corners: where the moment jumps, or where a chord would pass one by."""
    even = np.linspace(*cycle.ends, positions + 1)
    plans = _plans_at(cycle, even)
    strips = np.clip(np.searchsorted(even, cycle.corners, side="right") - 1, 0, positions - 1)
    jumped = np.abs(cycle.moment.at(cycle.corners) - cycle.moment.at(cycle.corners, -1))
    missed = plans.gaps(cycle)[strips] > MISSED_CORNER_SHARE * np.ptp(plans.energies)
    return _plans_at(cycle, even, cycle.corners[missed | (jumped > MOMENT_JUMP * np.abs(plans.right).max())])


def _plans_at(cycle: SteadyCycle, even: Reals, corners: Reals | None = None) -> CyclePlans:
    """The plans at even travels and corners; one that is near a corner to rounding is there."""
    corners = np.empty(0) if corners is None else corners
    near = np.abs(even[:, None] - corners).min(axis=1, initial=np.inf) <= ORDINATE_TOL * (even[-1] - even[0])
    travels = np.sort(np.concatenate([even[~near], corners]))
    left, right = cycle.moment.at(travels, -1), cycle.moment.at(travels)
    left[0], right[-1] = left[-1], right[0]  # the cycle goes on as it began
    return CyclePlans(travels, left, right, cycle.inertia.at(travels))


class FlywheelLayout(NamedTuple):
    """The frames of the diagrams, the distance of the pole in mm, and the inertia at which the tangents are cut."""

    frames: dict[str, Frame]
    pole: float
    axis: float


def lay_out(cycle: SteadyCycle, wheel: FlywheelSpeeds, plans: CyclePlans, room: DiagramSizes) -> FlywheelLayout:
    """The largest round scales for which there is room.

    The distance of the pole follows from them. Of the tangents' intercepts those on the axis I = 0 are drawn if they
    have room and the tangents do not meet there, as they do without a flywheel; else those on a parallel left of the
    curve.
    """
    begin, degrees = math.degrees(cycle.ends[0]), math.degrees(cycle.span)
    k_turned = float(round_scale(degrees / room.turned))
    axis, k_I = _parallel(plans, room)
    spans = {at: _span(plans, wheel, at) for at in (0.0, axis)}
    intercepts_fit = np.ptp(spans[0.0]) <= MAX_AXIS_RATIO * np.ptp(spans[axis])
    inertias_fit = plans.inertias.max() <= MAX_AXIS_RATIO * room.inertia * k_I
    if intercepts_fit and inertias_fit and wheel.inertia > 0:
        axis = 0.0
    M, E, pole = _moment_over_energy(cycle, plans, spans[axis], room)
    width, (_, drop), (low, high) = float(plans.inertias.max() - axis) / k_I, E.origin, E.upright
    beside = M.level[1] + COLUMN_GAP_MM
    I = Frame((beside, drop + high + ROW_GAP_MM), AxisScale(k_I, axis), AxisScale(k_turned, begin), (0.0, width),
              (0.0, degrees / k_turned))
    return FlywheelLayout({"moment": M, "energy": E, "inertia": I,
                           "energy-mass": Frame((beside, drop), I.x, E.y, (0.0, width), (low, high))}, pole, axis)


def lay_out_energies(cycle: SteadyCycle, plans: CyclePlans, energies: Reals, axis: float,
                     room: DiagramSizes) -> FlywheelLayout:
    """The diagrams of the moment and of these energies alone, in J, as large as they have room."""
    M, E, pole = _moment_over_energy(cycle, plans, (float(energies.min()), float(energies.max())), room)
    return FlywheelLayout({"moment": M, "energy": E}, pole, axis)


def _moment_over_energy(cycle: SteadyCycle, plans: CyclePlans, energies: tuple[float, float],
                        room: DiagramSizes) -> tuple[Frame, Frame, float]:
    """The frames of the moment and of the energy, from its least to its greatest, and the distance of the pole."""
    begin, degrees, degree = math.degrees(cycle.ends[0]), math.degrees(cycle.span), math.radians(1)
    k_phi = float(round_scale(degrees / room.travel))
    k_E = float(round_scale(np.ptp(energies) / room.energy))
    moments = np.array([0.0, plans.mean, *plans.left, *plans.right])
    k_M = float(round_scale(max(np.ptp(moments) / room.moment, k_E / (MAX_POLE_MM * k_phi * degree))))
    if k_E < MIN_POLE_MM * k_M * k_phi * degree:
        k_E = float(round_scale(MIN_POLE_MM * k_M * k_phi * degree))
    length, low, high = degrees / k_phi, energies[0] / k_E, energies[1] / k_E
    M = Frame((0.0, 0.0), AxisScale(k_phi, begin), AxisScale(k_M), (0.0, length),
              (float(moments.min()) / k_M, float(moments.max()) / k_M))
    E = Frame((0.0, M.upright[0] - ROW_GAP_MM - high), M.x, AxisScale(k_E), (0.0, length), (low, high))
    return M, E, k_E / (k_M * k_phi * degree)


def _parallel(plans: CyclePlans, room: DiagramSizes) -> tuple[float, float]:
    """A round inertia a little less than the least, and the scale at which the others have room right of it."""
    least, most = float(plans.inertias.min()), float(plans.inertias.max())
    varies = most - least > ORDINATE_TOL * most
    k_I = float(round_scale((most - least if varies else most) / room.inertia))
    step = 10 * k_I
    return (math.floor(least / step) * step if varies else least), k_I


def _span(plans: CyclePlans, wheel: FlywheelSpeeds, axis: float) -> tuple[float, float]:
    """From where to where the energies go, with those at which the tangents cut a parallel."""
    m, n = (tangent.cut + tangent.slope * axis for tangent in (wheel.upper, wheel.lower))
    energies = plans.energies
    return min(float(energies.min()), n), max(float(energies.max()), m)
