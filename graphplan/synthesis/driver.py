"""A driving crank for a guided plane: a dyad D K A that swings OA between the first and the last given position.

The crank DK turns all the way round. OA is the rocker of a crank-rocker whose dead positions are the first and the last
position; the way there takes longer than the way back by the time ratio. D has the largest least transmission angle.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import Any

from graphplan.errors import NoMechanism
from graphplan.kernel.program import Mark
from graphplan.phrases import digits, said
from graphplan.synthesis.linkage import FoundLinkage
from graphplan.synthesis.requests import StrokeTask
from graphplan.synthesis.sketch import SynthesisBoard, pair
from graphplan.synthesis.stroke import best_place, draw_crank_and_rod, draw_on_arc
from graphplan.synthesis.task import BEST, SynthesisTask


@dataclass(frozen=True)
class DrivingCrank:
    """The crank of a linkage: its pivot D, the angle between its dead positions in degrees, and its least transmission
    angle; `sides` are crank and rod, `outer_first` says that A is farther from D in the first position.
    """

    linkage: FoundLinkage
    angle: float
    D: complex
    least: float
    sides: tuple[float, float]
    outer_first: bool

    @classmethod
    def of_linkage(cls, task: SynthesisTask, linkage: FoundLinkage) -> DrivingCrank:
        """The best crank; fails with `NoMechanism` if no crank swings OA so far with that ratio."""
        assert linkage.travel is not None
        where, swing, ratio = f"{task.name}: guidance.driver", linkage.travel[-1], task.request.driver
        if swing >= 180:
            raise NoMechanism(where, f"OA turns by {swing:.6g} degrees, and a crank swings no link by 180 or more",
                              "drive OA itself, or choose other points")
        angle = 180 * (ratio - 1) / (ratio + 1)
        arc, t = best_place(StrokeTask(angle, rocker={"length": linkage.sides["O A"], "swing": swing}, ground=BEST),
                            where)
        rocker, outer = arc.linkage(t), linkage.sense < 0  # on the arc the inner end lies clockwise of the outer one
        assert rocker is not None
        turn = (linkage.A[0] - linkage.O) / arc.B[0 if outer else 1]
        return cls(linkage, angle, linkage.O + arc.centre(t) * turn, rocker.transmission[0],
                   (rocker.sides["O A"], rocker.sides["A B"]), outer)

    @property
    def pins(self) -> list[float]:
        """The angle of the crank in the first and the last position, in degrees."""
        ends = self.linkage.A[0] - self.D, self.D - self.linkage.A[-1]
        return [math.degrees(cmath.phase(arm if self.outer_first else -arm)) for arm in ends]

    @property
    def results(self) -> dict[str, Any]:
        """The crank as JSON has it, with how far it has turned at each position, the longer way to the last."""
        (crank, rod), (first, last) = self.sides, self.pins
        turn = (last - first) % 360
        sense = 1 if abs(turn - 180 - self.angle) <= abs(turn - 180 + self.angle) else -1
        travel = [0.0]
        for A in self.linkage.A[1:-1]:
            arm = A - self.D
            half = math.acos(max(-1.0, min(1.0, (crank**2 + abs(arm) ** 2 - rod**2) / (2 * crank * abs(arm)))))
            travel.append(min((math.degrees(cmath.phase(arm) + side * half) - first) * sense % 360 for side in (1, -1)))
        K = self.D + cmath.rect(crank, math.radians(first))
        return {"points": {"D": pair(self.D), "K": pair(K)}, "lengths": {"D K": crank, "K A": rod}, "sense": sense,
                "travel": [*travel, 180 + self.angle], "transmission": {"least": self.least}}

    def draw(self, sketch: SynthesisBoard, O: Mark, start: Mark, end: Mark) -> None:
        """D on the arc that sees the swing of A under the angle, and the crank from the dead positions."""
        A, outer, inner, names = self.linkage.A, start, end, ["K_1", f"K_{len(self.linkage.A)}"]
        if not self.outer_first:
            A, outer, inner, names = A[::-1], end, start, names[::-1]
        law = said("A is in its dead positions in the first and in the last position: from D these are seen under {0}°",
                   digits(self.angle))
        with sketch.stage(said("Driving crank"), law):
            D = draw_on_arc(sketch, (O, outer, inner), (self.D, self.linkage.O, A[0], A[-1]), self.angle, "D")
            draw_crank_and_rod(sketch, D, outer, inner, f"L H {' '.join(names)}", "crank pin")
