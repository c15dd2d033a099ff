"""A flywheel's second opinion: the motion with it, integrated step by step with what the solver says of the machine.

The equation of motion I epsilon + omega^2/2 dI/dphi = M is linear in omega^2; Gragg's midpoint rule, extrapolated,
carries it through the cycle from the speed at which it is said to begin. Inertia, slope and moment come from the
solver's rates, not from the reduction. The speeds that come of it have to be those asked for, and the cycle to close.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from graphplan.check.reduction import ReferenceReduction
from graphplan.check.reduction import check_reduction as reduction_checked
from graphplan.check.tolerances import HALVING_TOL, SPEED_TOL
from graphplan.errors import BrokenClaim, Disagreement
from graphplan.kernel.claims import broken
from graphplan.machine.flywheel.found import FlywheelResult

SUBSTEPS = (2, 4, 8)  # of one step, whose results are extrapolated to none
STEPS, MOST = 48, 1536  # of the whole cycle, at first and at most
FINER = 16  # steps in that with an extreme speed
POSES = 12  # in which the reduction is compared


def check_flywheel(result: FlywheelResult) -> dict[str, float]:
    """By how much the second opinions differ, relative to what is compared.

    Fails with `BrokenClaim` where a drawn step breaks a claim, and with `Disagreement` where the integrated motion is
    another one, or methods that neglect nothing find different flywheels.
    """
    name, drawing = result.scene.name, result.drawing
    if fault := next(broken(drawing.program, drawing.values), ""):
        raise BrokenClaim(name, fault)
    first, last = result.cycle.ends
    apart = np.linspace(first, last, POSES, endpoint=False)
    found = {f"reduced {what}": gap for what, gap in reduction_checked(result.reduction, apart).items()}
    found |= _motion(result)
    if result.reduction.friction:
        found["friction"] = result.reduction.losses.apart
    gutjahr = next((method.inertia for method in result.methods if method.name == "gutjahr"), None)
    if gutjahr is not None and not result.given:
        size = result.wheel.inertia + float(abs(result.cycle.inertia.terms[:, 0]).max())
        found["gutjahr"] = abs(gutjahr - result.wheel.inertia) / size
    for what, gap in found.items():
        if not gap <= SPEED_TOL and not what.startswith("reduced"):
            raise Disagreement(name, what, "otherwise", "by the integrated equation of motion", gap)
    return found


def _motion(result: FlywheelResult) -> dict[str, float]:
    """How far the integrated speeds are from those found, beside the mean, and how far the cycle is from closed."""
    motion = _Motion(result)
    squares = motion.around()
    high, low = (float(np.sqrt(motion.extreme(squares, best))) for best in (np.argmax, np.argmin))
    wheel, mean = result.wheel, result.cycle.speed
    return {"omega_max": abs(high - wheel.omega_max) / mean, "omega_min": abs(low - wheel.omega_min) / mean,
            "unevenness": abs((high - low) / ((high + low) / 2) - result.unevenness),
            "closing": abs(float(squares[-1] - squares[0])) / mean**2}


class _Motion:
    """The motion with a flywheel by the solver: the squares of its speeds at the ends of steps."""

    def __init__(self, result: FlywheelResult):
        self.result, cycle = result, result.cycle
        self.reduction = result.reduction.scaled(cycle.factor)
        first, last = cycle.ends
        self.breaks = [first, *(at for at in self.reduction.breaks if first < at < last), last]
        self.begin = float(result.omega(first)) ** 2

    def around(self) -> Any:
        """The squares at the ends of the steps of the cycle; of so many that halving them changes nothing."""
        count = STEPS
        while True:
            self.edges = self._steps(count)
            squares, self.rates, gap = self._squares(self.edges, self.begin)
            if gap <= HALVING_TOL * self.begin or count >= MOST:
                return squares
            count *= 2

    def _squares(self, edges: Any, begin: float) -> tuple[Any, Any, float]:
        """The squares at the ends of steps, what drives them there, and what the last extrapolation changed."""
        shift, factor, ends, gap = self._carried(edges)
        squares = [begin]
        for one, other in zip(shift, factor, strict=True):
            squares.append(one + other * squares[-1])
        return np.array(squares), ends, float(np.max(gap))

    def _steps(self, count: int) -> Any:
        """The ends of about so many steps of the cycle, those of a piece between breaks alike."""
        first, last = self.breaks[0], self.breaks[-1]
        rows = [np.linspace(low, high, max(1, round(count * (high - low) / (last - first))) + 1)
                for low, high in zip(self.breaks, self.breaks[1:], strict=False)]
        return np.concatenate([rows[0], *(row[1:] for row in rows[1:])])

    def extreme(self, squares: Any, best: Any) -> float:
        """The largest or the least square: the step in which it lies is taken in finer ones."""
        k = int(best(_tops(self.edges, squares, self.rates, best)))
        edges = np.linspace(self.edges[k], self.edges[k + 1], FINER + 1)
        inner, rates, _ = self._squares(edges, squares[k])
        tops = _tops(edges, inner, rates, best)
        return float(tops[best(tops)])

    def _carried(self, edges: Any) -> tuple[Any, Any, Any, Any]:
        """Over each step: the square at its end is shift + factor * square at its beginning; push, drag at both ends;
        what the last extrapolation changed."""
        finest = SUBSTEPS[-1]
        places = edges[:-1, None] + np.diff(edges)[:, None] * np.arange(finest + 1) / finest
        places[:, -1] = edges[1:]
        push, drag = self._coefficients(places)
        table = list[Any]()
        for count in SUBSTEPS:
            own = slice(None, None, finest // count)
            row = [_midpoints(push[:, own], drag[:, own], np.diff(edges) / count)]
            for j, before in enumerate(table[-1] if table else []):
                ratio = (count / SUBSTEPS[len(table) - 1 - j]) ** 2
                row.append(row[j] + (row[j] - before) / (ratio - 1))
            table.append(row)
        (shift, factor), (off, apart) = table[-1][-1], abs(table[-1][-1] - table[-1][-2])
        return shift, factor, (push[:, [0, -1]], drag[:, [0, -1]]), off + apart * self.begin

    def _coefficients(self, places: Any) -> tuple[Any, Any]:
        """Of d(omega^2)/dphi = push - drag omega^2 at places of steps, the last of each step from before it."""
        found = np.empty((3, *places.shape))
        for own, side in ((np.s_[:, :-1], 1), (np.s_[:, -1:], -1)):
            travel = places[own].ravel()
            opinion = ReferenceReduction(self.reduction, travel, side)
            truth = opinion.truth
            moment = truth["moment"].value + opinion.friction + self._over_speed(travel, side)
            rows = (truth["inertia"].value + self.result.wheel.inertia, truth["slope"].value,
                    moment + self.result.cycle.closing)
            for k, row in enumerate(rows):
                found[k][own] = np.reshape(row, places[own].shape)
        inertia, slope, moment = found
        return 2 * moment / inertia, slope / inertia

    def _over_speed(self, travel: Any, side: int) -> Any:
        """The moments of the loads over a speed, at the mean speed."""
        loads = self.reduction.at(travel, side).speed_loads if self.result.reduction.changing else ()
        return sum((load.moment(self.result.cycle.speed) for load in loads), np.zeros(travel.shape))


def _tops(edges: Any, squares: Any, rates: Any, best: Any) -> Any:
    """The largest or least square within each step, of the cubic with its slopes at both ends."""
    push, drag = rates
    widths, ends = np.diff(edges), np.stack([squares[:-1], squares[1:]], axis=1)
    one, two = ((push - drag * ends) * widths[:, None]).T
    rise = ends[:, 1] - ends[:, 0]
    cubic, square = one + two - 2 * rise, 3 * rise - 2 * one - two
    root = np.sqrt(np.maximum(square**2 - 3 * cubic * one, 0))
    with np.errstate(divide="ignore", invalid="ignore"):
        places = [np.nan_to_num((sign * root - square) / (3 * cubic)) for sign in (1, -1)]
        places.append(np.nan_to_num(-one / (2 * square)))
    places = [np.clip(place, 0, 1) for place in (*places, np.zeros(len(widths)), np.ones(len(widths)))]
    values = np.array([ends[:, 0] + t * (one + t * (square + t * cubic)) for t in places])
    return values[best(values, axis=0), np.arange(len(widths))]


def _midpoints(push: Any, drag: Any, width: Any) -> Any:
    """Gragg's rule over steps: push and drag at the ends of the substeps; shift and factor, shape (2, steps)."""
    start = np.stack([np.zeros(len(push)), np.ones(len(push))])
    moved = np.array([[1.0], [0.0]])

    def rate(k: int, value: Any) -> Any:
        return moved * push[:, k] - drag[:, k] * value

    before, value = start, start + width * rate(0, start)
    last = push.shape[1] - 1
    for k in range(1, last):
        before, value = value, before + 2 * width * rate(k, value)
    return (value + before + width * rate(last, value)) / 2
