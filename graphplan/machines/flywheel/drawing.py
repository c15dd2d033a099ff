"""The flywheel drawn: the diagrams of moment, energy and inertia, and Wittenbauer's curve with its two tangents.

One sheet in mm of paper, as Ozols' fig. 13-9 has it. From the plans' moments and inertias all is drawn: the closing
moment as the mean ordinate, the energy by chords parallel to rays from a pole, and points carried across. Where the
curve is outermost, parallels of the prescribed slope through three neighbours cut the axis in points of a parabola over
their travels; the tangent's is its vertex.

Source: Ozols 1974, 13-6 and 15-2, figs. 13-9, 15-2 and 15-3, (15.10), (15.15), (15.16).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from graphplan.cycle.diagrams import Axes, integrate
from graphplan.errors import Refused
from graphplan.kernel.numbers.arrays import Reals
from graphplan.kernel.passes import PlanScale, Values, record_drawing
from graphplan.kernel.program import Board, Mark, Panel
from graphplan.kernel.stages import Stage
from graphplan.machines.flywheel.diagram_layout import DiagramSizes, FlywheelLayout, lay_out, plans_of
from graphplan.machines.flywheel.steady_cycle import FlywheelSpeeds, SteadyCycle, Tangency
from graphplan.machines.tolerances import LINE_TOL_MM, PLAN_TOL
from graphplan.phrases import Said, digits, said
from graphplan.sheet.diagrams import Frame

FLYWHEEL = Panel("flywheel", said("flywheel"), said("Moment, energy, inertia and the energy-mass diagram"))
MIN_POSITIONS, MAX_POSITIONS = 6, 720  # plans, those included with which the error of the strips is found


@dataclass(frozen=True, eq=False)
class FlywheelDrawing:
    """The drawing of the flywheel, in mm of paper, with the values of its marks, and its diagrams by name.

    `travels` are those of the plans, in degrees, and those at which the moment jumps. `pole` is its distance
    in mm: k_E = pole k_M k_phi. The tangents are cut at the inertia `axis`; their intercept is off by `strip_error` J
    at most, as the moment of a strip is no straight line and the curve no parabola.
    """

    cycle: SteadyCycle
    wheel: FlywheelSpeeds
    values: Values
    travels: Reals
    frames: dict[str, Frame]
    pole: float
    axis: float
    strip_error: float

    @property
    def mean(self) -> float:
        """The mean moment of the loads, as it is drawn."""
        frame = self.frames["moment"]
        return float(frame.y.value(self.values.values_of_role("mean")[0][1] - frame.origin[1]))

    @property
    def intercept(self) -> float:
        """The length mn on the axis that is drawn, in J."""
        (m,), (n,) = self.values.values_of_role("m"), self.values.values_of_role("n")
        return float(m[1] - n[1]) * self.frames["energy"].y.unit

    @property
    def inertia(self) -> float:
        """The flywheel by the intercept, (15.15)."""
        return self.intercept / self._divisor - self.axis

    @property
    def unevenness(self) -> float:
        """The unevenness with the wheel by the intercept, (15.13)."""
        return self.intercept / self._moment

    def change(self, given: bool) -> float:
        """By how much one J of the intercept changes the flywheel, or the unevenness with a `given` one."""
        return 1 / (self._moment if given else self._divisor)

    @property
    def _divisor(self) -> float:
        """delta omega^2."""
        return self.wheel.upper.slope - self.wheel.lower.slope

    @property
    def _moment(self) -> float:
        """(I_s + I') omega^2."""
        return (self.wheel.inertia + self.axis) * ((self.wheel.omega_max + self.wheel.omega_min) / 2) ** 2

    def touching(self, which: str) -> float:
        """The travel at which the `upper` or the `lower` tangent touches, as it is read off."""
        first, last = self.travels[[0, -1]]
        read = float(self.frames["energy"].x.value(self.values.values_of_role(f"{which} apex")[0][0]))
        return float(first + (read - first) % (last - first))


def draw_flywheel(cycle: SteadyCycle, wheel: FlywheelSpeeds, positions: int = 24,
                  room: DiagramSizes | None = None) -> FlywheelDrawing:
    """The drawing of the flywheel, from so many plans of the cycle; fails with `Refused` where these are too few."""
    if not MIN_POSITIONS <= positions <= MAX_POSITIONS:
        raise Refused(f"{positions} positions", "the curves are drawn through them",
                      f"from {MIN_POSITIONS} to {MAX_POSITIONS}")
    return FlywheelRecorder(cycle, wheel, positions, room or DiagramSizes()).drawing


class FlywheelRecorder:
    """Draws one flywheel on the board, by Wittenbauer's diagram."""

    def __init__(self, cycle: SteadyCycle, wheel: FlywheelSpeeds, positions: int, room: DiagramSizes):
        self.cycle, self.wheel, self.plans = cycle, wheel, plans_of(cycle, positions)
        self.scales = self._layout(room)
        self.frames, self.board = self.scales.frames, Board()
        self.marks: dict[str, list[Mark]] = {}
        self.told = np.degrees(self.plans.travels)
        even = (self.plans.travels - cycle.ends[0]) / cycle.span * positions
        self.numbers = np.floor(even + PLAN_TOL).astype(int).tolist()  # a corner has that of the plan before it, primed

    def _layout(self, room: DiagramSizes) -> FlywheelLayout:
        """Places of the diagrams."""
        return lay_out(self.cycle, self.wheel, self.plans, room)

    @property
    def drawing(self) -> FlywheelDrawing:
        """The finished program."""
        with self.board.on(FLYWHEEL):
            self.draw_given()
            for title, law, draw in self._stages():
                with self.board.on(FLYWHEEL, stage=Stage(title, law)):
                    draw()
        drawing = record_drawing(self.board, self.marks, {FLYWHEEL: PlanScale(on_paper=True)})
        return FlywheelDrawing(self.cycle, self.wheel, drawing.mark_values(), self.told, self.frames, self.scales.pole,
                               self.scales.axis, self.strip_error)

    @property
    def strip_error(self) -> float:
        """By how much the intercept may be off by the strips, in J."""
        plans, tangents = self.plans, ((self.wheel.upper.slope, True), (self.wheel.lower.slope, False))
        touched = [plans.outermost(slope, above) for slope, above in tangents]
        return plans.energy_error(self.cycle, *touched) + sum(plans.parabola_error(slope, k)
                                                              for (slope, _), k in zip(tangents, touched, strict=True))

    def _stages(self) -> list[tuple[Said, Said, Callable[[], None]]]:
        """Stages of the drawing in order: title, law and function."""
        return [
            (said("Closing moment"), said("over a cycle the moments do no work: their mean is missing"), self._closing),
            (said("Energy"), said("each chord is parallel to the ray of its strip: k_E = H·k_M·k_phi"), self._energy),
            (said("Energy-mass diagram"), said("energy and inertia of one plan give a point"), self._points),
            (said("Tangents"), said("tan psi = (k_I/2k_E)·(1 ± delta/2)²·omega²"), self._tangents)]

    def _mark(self, frame: str, x: float, y: float, name: str) -> Mark:
        """A point given by two values."""
        at = self.frames[frame].position(x, y)
        return self.board.given(x=float(at[0]), y=float(at[1]), name=name)

    def draw_given(self) -> None:
        """Draw the given numbers of the plans: moments and inertias."""
        self._draw_moments()
        self.marks["inertias"] = [self._mark("inertia", I, x, f"I_{k}")
                                  for k, x, I in zip(self.numbers, self.told, self.plans.inertias, strict=True)]

    def _draw_moments(self) -> None:
        """Moments on both sides of each travel."""
        plans, last = self.plans, len(self.told) - 1
        self.before, self.after = list[Mark](), list[Mark]()
        for k, x in enumerate(self.told):
            mark_after = self._mark("moment", x, plans.right[k] if k < last else plans.left[k], f"M_{self.numbers[k]}")
            self.after.append(mark_after)
            two = 0 < k < last and plans.jumps(k)
            self.before.append(self._mark("moment", x, plans.left[k], f"M_{self.numbers[k]}") if two else mark_after)
        self.marks["moments"] = [mark for pair in zip(self.before, self.after, strict=True)
                                 for mark in dict.fromkeys(pair)]

    def _closing(self) -> None:
        """The axes, the mean ordinate of all strips, and the pole on its level."""
        board, mean = self.board, self.frames["moment"].y.mm(self.plans.mean)
        O = board.begin(plan=FLYWHEEL, name="O")
        self.level = board.guide(O, dx=1, dy=0, why=said("the axis of travel"))
        self.upright = board.perpendicular(self.level, O, why=said("the axis of moments"))
        strips = list(zip(self.after, self.before[1:], strict=False))
        self.means = [board.midpoint(P, Q, why=said("the mean ordinate of the strip")) for P, Q in strips]
        Z = board.lay_along(self.upright, O, length=float(mean), name="Z",
                            why=said("the mean ordinate: the areas over and under its level are equal"))
        H = board.lay_off(Z, dx=-self.scales.pole, dy=0, name="H", why=said("the pole"))
        zero = board.parallel(self.level, Z, why=said("zero line of the moments, closed"))
        self.rates = Axes(O, self.level, self.upright, H)
        self.marks |= {"mean": [Z], "ray origin": [H], "closed": [zero], "means": self.means}

    def _energy(self) -> None:
        """The string of chords."""
        board, down = self.board, self.frames["energy"].origin[1]
        start = board.lay_off(self.rates.origin, dx=0, dy=down, name="E_0", why=said("zero line of the energy"))
        rays = integrate(board, self.means, start, self.after, self.rates,
                         [f"E_{k}" for k in self.numbers[1:]])
        self.energies = [start, *(ray.end for ray in rays)]
        self.marks |= {"energies": self.energies, "cuts": [ray.cut for ray in rays]}

    def _points(self) -> None:
        """The energy-mass diagram."""
        board, points = self.board, list[Mark]()
        for k, E, I in zip(self.numbers[:-1], self.energies, self.marks["inertias"], strict=False):
            across = board.parallel(self.level, E, why=said("carry the energy across"))
            down = board.parallel(self.upright, I, why=said("and the inertia down"))
            points.append(board.meet(across, down, name=f"P_{k}"))
        self.points = [*points, points[0]]
        self.marks["points"] = points

    def _tangents(self) -> None:
        """Draw both tangents and their intersections with the axis."""
        board, frame = self.board, self.frames["energy-mass"]
        A = board.lay_off(self.energies[0], dx=frame.origin[0], dy=0, name="A",
                          why=said("where the inertia is {0}", digits(self.scales.axis)))
        self.axis = board.parallel(self.upright, A, why=said("the axis on which the tangents are cut"))
        self.marks["axis"] = [self.axis]
        for which, letter, touch in (("upper", "m", self.wheel.upper), ("lower", "n", self.wheel.lower)):
            slope = touch.slope * frame.x.unit / frame.y.unit
            guide = board.guide(A, dx=1, dy=slope, why=said("the slope of the speed that is largest") if letter == "m"
                                else said("the slope of the speed that is least"))
            cut, apex = self._outermost(guide, touch, letter)
            self.marks |= {which: [board.parallel(guide, cut, why=said("the tangent"))], letter: [cut],
                           f"{which} apex": [apex]}

    def _outermost(self, guide: Mark, touch: Tangency, letter: str) -> tuple[Mark, Mark]:
        """Intersection of the tangent with the axis, and its point of contact over the travel.

        Parallels through three neighbours cut the axis; their cuts, over the travels of these, are points of a parabola
        whose vertex is the tangent's. Where the moment jumps the curve has a corner, which the tangent goes through.
        """
        k, three = self._neighbours(touch.slope, above=letter == "m")
        if len(three) == 1:
            cut = self.board.meet(self.axis, self.board.parallel(guide, self.points[k]), name=letter)
            return cut, self.level_over(cut, k)
        round_trip = len(self.points) - 1
        cuts = [self.board.meet(self.axis, self.board.parallel(guide, self.points[j % round_trip]),
                                name=f"{letter}_{self.numbers[j % round_trip]}") for j in three]
        A, B, C = (self.board.give_name(self.level_over(cut, j), f"{name}_{letter}")
                   for name, cut, j in zip("ABC", cuts, three, strict=True))
        first, middle, last = self.plans.travels_around(self.told, three)
        return self._vertex(A, B, C, float((middle - first) / (last - first)), letter)

    def _neighbours(self, slope: float, above: bool) -> tuple[int, list[int]]:
        """The outermost plan, and the three that the parabola goes through: itself alone where it is a corner, or these
        lie on a line. That after the last is the second, in the next cycle."""
        plans, k = self.plans, self.plans.outermost(slope, above)
        middle = k or len(self.told) - 1
        three = [middle - 1, middle, middle + 1]
        mm = plans.heights(slope)[np.array(three) % (len(self.told) - 1)] / self.frames["energy"].y.unit
        return k, [k] if plans.jumps(k) or are_in_line(plans.travels_around(self.told, three), mm) else three

    def level_over(self, cut: Mark, k: int) -> Mark:
        """The level of a cut over the travel of a plan."""
        board, energies = self.board, self.energies
        at = energies[k] if k < len(energies) else board.transfer(
            energies[0], energies[-1], energies[k - len(energies) + 1], why=said("the cycle goes on as it began"))
        return board.meet(board.parallel(self.level, cut), board.parallel(self.upright, at))

    def _vertex(self, A: Mark, B: Mark, C: Mark, part: float, letter: str) -> tuple[Mark, Mark]:
        """The level tangent of the parabola through three points, where it meets the axis and where it touches.

        Two tangents of it meet in D, so that a third divides AD and DC alike.
        """
        board = self.board
        chord = board.meet(board.line(A, C), board.parallel(self.upright, B))
        D = board.step_off(chord, B, board.midpoint(A, C), ratio=1 / (2 * part * (1 - part)), name=f"D_{letter}",
                           why=said("the tangents at the outer points meet here"))
        F = board.transfer(A, D, D, name=f"F_{letter}")
        G = board.meet(board.line(F, C), board.parallel(self.level, D), name=f"G_{letter}")
        side, second_side = board.line(A, D), board.line(D, C)
        K = board.meet(second_side, board.parallel(side, G), name=f"K_{letter}",
                       why=said("the level tangent goes through it"))
        tangent = board.parallel(self.level, K)
        L = board.meet(side, tangent, name=f"L_{letter}")
        cut = board.meet(self.axis, tangent, name=letter)
        return cut, board.divide(F, C, G, L, K, name=f"T_{letter}")


def are_in_line(travels: Reals, heights: Reals) -> bool:
    """Whether three points lie on a line."""
    first, middle, last = heights
    share = (travels[1] - travels[0]) / (travels[2] - travels[0])
    return bool(abs(middle - first - share * (last - first)) < LINE_TOL_MM)
