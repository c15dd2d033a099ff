"""The drawing of a governor: the rays of its positions on its characteristic, and where that of its speed meets it.

Rays from the origin cut off c tan psi on an upright at the distance c, which says the speeds. With friction there are
the rays of one position on both other characteristics, and the places between which friction holds the governor.

Source: O. Ozols, Mehānismu un mašīnu teorija (1974), section 15-5 with figs. 15-14 to 15-16; method A21.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from graphplan.cycle.curves import AxisScale, Frame
from graphplan.cycle.linkage import Array
from graphplan.kernel.drawing import PlanScale, Values, record_drawing
from graphplan.kernel.program import Board, Mark, Panel
from graphplan.kernel.stages import Stage
from graphplan.machines.governor.governor import GovernorResult
from graphplan.machines.motion.diagram_layout import fine_scale
from graphplan.phrases import said

GOVERNOR = Panel("governor", said("Characteristic of the governor"))
WALL_SHARE, TOP_SHARE = 0.9, 0.95  # of the largest r, where rays are cut; of the height, what is used


@dataclass(frozen=True, eq=False)
class GovernorDrawing:
    """The recorded construction of a governor in its diagram; speeds are read on the upright at `c` mm."""

    result: GovernorResult
    frame: Frame
    c: float
    values: Values

    @property
    def omega(self) -> Array:
        """The speeds at the positions, as they are drawn."""
        return self.speeds("rays")

    @property
    def band(self) -> Array:
        """The speeds at which the balls move outwards and inwards in the middle position, as they are drawn."""
        return self.speeds("band")

    def speeds(self, role: str) -> Array:
        """The speeds that rays cut off on the upright."""
        heights = np.array([y for _, y in self.values.values_of_role(role)]) - self.frame.origin[1]
        return np.sqrt(heights * self.frame.y.unit / (self.frame.x.unit * self.result.mass * self.c))

    @property
    def r(self) -> Array:
        """The distances of the balls in the positions of equilibrium, as they are drawn, in metres."""
        return self.distances("equilibria")

    @property
    def held_between(self) -> Array:
        """Those between which friction holds the governor, as they are drawn, in metres."""
        return np.sort(self.distances("held"))

    def distances(self, role: str) -> Array:
        """The distances of the balls at some places on the axis of r."""
        return np.array([self.frame.x.value(x - self.frame.origin[0]) for x, _ in self.values.values_of_role(role)])


def draw_governor(result: GovernorResult, width: float = 250.0, height: float = 180.0) -> GovernorDrawing:
    """The characteristic with the rays of its positions, and where that of the spindle's speed meets it; with friction
    the rays of both other characteristics in one position, and between which places friction holds the governor."""
    states, omega = result.drawn_states, max(result.extremes[1], result.spindle_speed)
    wall = WALL_SHARE * float(states.r[-1])
    bands = dict(zip(("''", "'"), result.drawn_band, strict=True)) if result.friction else {}
    top = max(float(C.max()) for C in (states.C, *bands.values()))
    k_r = fine_scale(float(states.r[-1]) / (TOP_SHARE * width))
    k_C = fine_scale(max(top, result.mass * omega**2 * wall) / (TOP_SHARE * height))
    frame = Frame((0.0, 0.0), AxisScale(k_r), AxisScale(k_C), (0.0, width), (0.0, height))
    board, c, middle = Board(), wall / k_r, result.drawn_middle
    crossings = {prime: result.drawn_crossings(C) for prime, C in bands.items()}
    crossings[""] = [] if result.is_isochronous else result.drawn_crossings(states.C)  # that is a ray itself

    def points_at(prime: str, C: Array, places: Iterable[int]) -> dict[int, Mark]:
        """The given points of a characteristic at some of the positions."""
        return {k: board.given(x=float(x), y=float(y), name=f"C_{k + 1}{prime}") for k in sorted({*places})
                for x, y in [frame.position(states.r[k], C[k])]}

    with board.on(GOVERNOR):
        O = board.given(x=0.0, y=0.0, name="O")
        points = {"": points_at("", states.C, range(len(states.r)))}
        points |= {prime: points_at(prime, C, [middle, *(k + end for k in crossings[prime] for end in (0, 1))])
                   for prime, C in bands.items()}
    with board.on(GOVERNOR, stage=Stage(said("Speeds"), said("rays with tan psi = C/r = m omega² cut off c tan psi"))):
        axis = board.guide(O, dx=1, dy=0, why=said("the axis of r"))
        foot = board.lay_along(axis, O, length=c, name="W", why=said("the length c sets the scale"))
        upright = board.perpendicular(axis, foot, why=said("on it the rays cut off c tan psi"))
        rays = [board.meet(board.line(O, point, why=said("the ray of this position")), upright, name=f"T_{k + 1}")
                for k, point in points[""].items()]
    cut = result.mass * result.spindle_speed**2 * k_r * c / k_C
    with board.on(GOVERNOR, stage=Stage(said("Equilibrium"), said("the ray of a speed meets the characteristic"))):
        T = board.lay_along(upright, foot, length=cut, name="T", why=said("it is c tan psi = c k_r/k_C m omega²"))
        ray = board.line(O, T, why=said("the ray of the speed"))
        equilibria = [_equilibrium(board, axis, ray, points[""], k) for k in crossings[""]]
    band, ends = list[Mark](), list[Mark]()
    if bands:
        law = said("C'' moves the balls outwards, C' inwards: between their speeds friction holds them")
        with board.on(GOVERNOR, stage=Stage(said("Insensitivity"), law)):
            band = [board.meet(board.line(O, points[prime][middle], why=said("the ray of this position with friction")),
                               upright, name=f"T_{middle + 1}{prime}") for prime in bands]
            ends = [_equilibrium(board, axis, ray, points[prime], k, prime) for prime in bands
                    for k in crossings[prime]]
    marks = {"origin": [O], "points": [*points[""].values()], "rays": rays, "speed": [T, ray],
             "equilibria": equilibria, "band": band, "held": ends}
    return GovernorDrawing(result, frame, c, record_drawing(board, marks, {GOVERNOR: PlanScale(on_paper=True)}
                                                            ).mark_values())


def _equilibrium(board: Board, axis: Mark, ray: Mark, points: Mapping[int, Mark], k: int, prime: str = "") -> Mark:
    """Where the ray meets a characteristic between two positions, carried down to the axis of r."""
    chord = board.line(points[k], points[k + 1], why=said("the chord of the characteristic"))
    why = said("from here on friction holds it") if prime else said("the position of equilibrium")
    E = board.meet(ray, chord, name=f"E_{k + 1}{prime}", why=why)
    upright = board.perpendicular(axis, E, why=said("down to the axis"))
    return board.meet(axis, upright, name=f"R_{k + 1}{prime}")
