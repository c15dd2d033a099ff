"""The profile constructed by inversion: the cam stands still, and the frame with the follower goes round it backwards.

The turn is divided; at each division the path or the pivot is drawn where it has gone, the lift is carried there from
the first position by an arc about the cam's centre O, as both are as far from O; then the roller's circle or the flat
face. It touches the profile where the normal through the relative pole P of cam and follower meets it; P lies
perpendicular to the path, or on the line of centres, where the cam's points have the follower's velocity.

Source: Ozols 1974, 20-4 with figs. 5-31, 19-6 and 19-7 (inversion), 20-11 (envelope), (20.14) (pole).
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import Any

from graphplan.cams.base import CamPair, FlatOscillating, Oscillating, Translating
from graphplan.cams.profile import Cam
from graphplan.cams.tolerances import DIRECTION_TOL, ZERO_LENGTH
from graphplan.kernel.kinds import Quantity
from graphplan.kernel.passes import Values, record_drawing
from graphplan.kernel.program import Board, Mark, Panel
from graphplan.kernel.stages import Stage
from graphplan.phrases import digits, said

CAM_PLAN = Panel("cam", said("cam"), said("The cam by inversion"))
FACE_REACH = 1.1  # of the farthest contact from the pivot: where a face is marked that turns


@dataclass(frozen=True)
class CamDrawing:
    """The construction of a cam with the values of its marks: a role has one mark at each division, or stands once."""

    cam: Cam
    values: Values

    @property
    def angles(self) -> list[float]:
        """The angles of the divisions, in degrees."""
        count = self.cam.task.cam.divisions
        return [360.0 * k / count for k in range(count)]

    def positions(self, name: str) -> list[complex]:
        """The points of a name at all divisions, such as A or K."""
        return [complex(*point) for point in self.values.values_of_role(name)]


def draw_cam(cam: Cam) -> CamDrawing:
    """The construction of a cam's profile, over its divisions of the turn."""
    return _CamRecorder(cam).drawing


class _CamRecorder:
    """Draws one cam on the board."""

    def __init__(self, cam: Cam):
        self.cam, self.pair, self.board = cam, cam.pair, Board()
        self.count = cam.task.cam.divisions
        self.common: dict[str, Mark] = {}
        self.marks: list[dict[str, Mark]] = [{} for _ in range(self.count)]

    @property
    def drawing(self) -> CamDrawing:
        """The finished program."""
        with self.board.on(CAM_PLAN):
            self.O = self.board.given(x=0, y=0, name="O")
        stages = [
            (said("Base circle and first position"), said("the follower is lowest"), self.draw_first),
            (said("Lifts"), said("the law's lift at each division of the turn"), self._lifts),
            (said("Inversion"), said("the cam stands still, the frame goes round it backwards"), self._round),
            (said("Profile"), said("the follower touches it where the normal through the pole meets the follower"),
             self._profile)]
        for title, law, draw in stages:
            with self.board.on(CAM_PLAN, stage=Stage(title, law)):
                draw()
        roles = {name: [mark] for name, mark in self.common.items()}
        roles |= {name: [marks[name] for marks in self.marks] for name in self.marks[0]}
        return CamDrawing(self.cam, record_drawing(self.board, roles).mark_values())

    # ---- what all kinds share --------------------------------------------------------------------------------------

    def _angle(self, k: int) -> float:
        return 360.0 * k / self.count

    def _law(self, k: int, order: int) -> float:
        return float(self.cam.law.value_at([self._angle(k)], order)[0])

    def _guide(self, P: Mark, degrees: float, **notes: Any) -> Mark:
        """The line through a point at an angle."""
        ray = cmath.rect(1.0, math.radians(degrees % 360))
        return self.board.guide(P, dx=without_rounding(ray.real), dy=without_rounding(ray.imag), **notes)

    def _ray(self, k: int) -> Mark:
        """The line through O that was level at first, where it has gone."""
        text = said("division {0}: {1}°, against the turning of the cam", k, digits(self._angle(k)))
        return self._guide(self.O, -self.pair.sense * self._angle(k), why=text)

    def draw_first(self) -> None:
        """The base circle and the follower where it is lowest."""
        o = self.board.radius(length=self.pair.base, quantity=_length("r_0"), why=said("the radius of the base circle"))
        self.base = self.common["base"] = self.board.circle(self.O, o, why=said("the base circle"))
        if self.oscillates:
            pair: Any = self.pair
            span = self.board.radius(length=pair.distance, quantity=_length("a"), why=said("the centre distance"))
            self.pivots = self.board.circle(self.O, span, why=said("on it the pivot goes round"))
            self.common["pivots"] = self.pivots
            self.arm = self.board.radius(length=self._reach, quantity=_length("l"), why=said("the arm"))
        elif self._path_offset:
            o = self.board.radius(length=abs(self._path_offset), quantity=_length("e"), why=said("the offset"))
            self.offsets = self.common["offsets"] = self.board.circle(self.O, o, why=said("the paths touch it"))
        self.rays = [self._ray(0)]
        self.place_follower(0)
        if isinstance(self.pair, FlatOscillating):
            self.A = self.lifted_mark(0, 0.0)
        elif self.oscillates:
            self.A = self.arm_end(0, self.base)
        else:
            self.A = self.board.line_meets_circle(self.marks[0]["path"], self.base, way="on", name="A_0")

    @property
    def oscillates(self) -> bool:
        return isinstance(self.pair, Oscillating | FlatOscillating)

    @property
    def _path_offset(self) -> float:
        """Distance of the path to the right of O at first."""
        return self.pair.sense * self.pair.offset if isinstance(self.pair, Translating) else 0.0

    @property
    def _reach(self) -> float:
        """The radius at which the turning of an arm is drawn."""
        return self.pair.arm if isinstance(self.pair, Oscillating) else FACE_REACH * self.cam.reach[1]

    def place_follower(self, k: int) -> None:
        """The path or the pivot where it has gone."""
        board, ray, marks = self.board, self.rays[k], self.marks[k]
        if self.oscillates:
            marks["B"] = board.line_meets_circle(ray, self.pivots, way="on", name=f"B_{k}", why=said("the pivot"))
            marks["arc"] = board.circle(marks["B"], self.arm, why=said("the arm about it"))
        else:
            sense = "on" if self._path_offset > 0 else "back"
            T = board.line_meets_circle(ray, self.offsets, way=sense, name=f"T_{k}",
                                        why=said("where the path touches it")) if self._path_offset else self.O
            marks["path"] = board.perpendicular(ray, T, why=said("the path of the follower"))

    def arm_end(self, k: int, circle: Mark) -> Mark:
        """The end of the arm on a circle about O."""
        return self.board.circles_meet(circle, self.marks[k]["arc"], side="left", name=f"A_{k}")

    def _lifts(self) -> None:
        """The lifts at the first position."""
        self.lifted = [self.A]
        for k in range(1, self.count):
            s = self._law(k, 0)
            self.lifted.append(self.lifted_mark(k, s) if abs(s) > ZERO_LENGTH * self.pair.base else self.A)

    def lifted_mark(self, k: int, s: float) -> Mark:
        """The follower lifted by so much where it stands at first."""
        if not self.oscillates:
            return self.board.lay_along(self.marks[0]["path"], self.A, length=s, name=f"S_{k}", quantity=_length("s"),
                                        why=said("the lift at {0}°", digits(self._angle(k))))
        pair: Any = self.pair
        arm = self._guide(self.marks[0]["B"], 180 - math.degrees(pair.angle + s),
                          why=said("lifted by {0}° at {1}°", digits(math.degrees(s)), digits(self._angle(k))))
        return self.board.line_meets_circle(arm, self.marks[0]["arc"], way="on", name=f"S_{k}" if k else "A_0")

    def _round(self) -> None:
        """The follower at all divisions."""
        self.marks[0]["A"] = self.A
        for k in range(1, self.count):
            self.rays.append(self._ray(k))
            self.place_follower(k)
            lowest = self.lifted[k] is self.A and not isinstance(self.pair, FlatOscillating)
            arc = self.base if lowest else self.board.circle(
                self.O, self.board.opening(self.O, self.lifted[k]), why=said("the lift is carried round"))
            if self.oscillates:
                self.marks[k]["A"] = self.arm_end(k, arc)
            else:
                self.marks[k]["A"] = self.board.line_meets_circle(self.marks[k]["path"], arc, way="on", name=f"A_{k}")

    def _profile(self) -> None:
        """Roller or face at all divisions, and where the profile touches it."""
        if self.cam.roller:
            o = self.board.radius(length=self.cam.roller, quantity=_length("r"), why=said("the radius of the roller"))
        for k in range(self.count):
            marks = self.marks[k]
            if self.cam.task.follower.flat:
                marks["face"] = self._face(k)
                marks["K"] = self.board.foot(marks["face"], self._pole(k), name=f"K_{k}")
            elif self.cam.roller:
                marks["roller"] = self.board.circle(marks["A"], o, why=said("the roller"))
                normal = self.board.line(self._pole(k), marks["A"], why=said("the contact normal"))
                marks["K"] = self.board.line_meets_circle(normal, marks["roller"], way="back", name=f"K_{k}")
            else:
                marks["K"] = marks["A"]

    def _pole(self, k: int) -> Mark:
        """The relative pole of cam and follower."""
        far = pole(self.pair, self._law(k, 1))
        if abs(far) <= ZERO_LENGTH * self.pair.base:
            return self.O
        formula = "a·ψ′/(1 ± ψ′)" if self.oscillates else "ds/dφ"
        return self.board.lay_along(self.rays[k], self.O, length=far, name=f"P_{k}", quantity=_length(formula),
                                    why=said("the pole of cam and follower: there the cam moves as the follower"))

    def _face(self, k: int) -> Mark:
        """The flat face."""
        board, marks = self.board, self.marks[k]
        if not self.oscillates:
            return board.perpendicular(marks["path"], marks["A"], why=said("the flat face"))
        arm = board.line(marks["B"], marks["A"])
        offset = self.pair.offset if isinstance(self.pair, FlatOscillating) else 0.0
        if not offset:
            return arm
        across = board.perpendicular(arm, marks["B"])
        D = board.lay_along(across, marks["B"], length=offset, name=f"D_{k}", quantity=_length("e"),
                            why=said("the offset of the face"))
        return board.parallel(arm, D, why=said("the flat face"))


def pole(pair: CamPair, rate: float) -> float:
    """Distance of the relative pole of cam and follower to the right of O, for this rate of the lift."""
    if isinstance(pair, Oscillating | FlatOscillating):
        return pair.distance * rate / (pair.sense + rate)
    return pair.sense * rate


def _length(written: str) -> Quantity:
    """Quantity of a drawn length."""
    return Quantity(written, "length")


def without_rounding(part: float) -> float:
    """A component of a direction that is 0, 1 or -1 where rounding alone makes it another."""
    return float(round(part)) if abs(part - round(part)) < DIRECTION_TOL else part
