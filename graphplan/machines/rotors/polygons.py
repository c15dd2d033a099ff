"""The polygons of a rotor: moments, then forces, closed by what two correction masses do.

At the same speed centrifugal forces are as masses times radius vectors, and run as those do. Their moments about plane
I, all turned by a quarter, run as the forces do where a mass is on the side of plane II, and against them on the other.
So the moment polygon has the sides m_i a_i r_i and one unknown side, m_II a r_II, which closes it; divided by the
distance a of the planes it is a side of the force polygon, which m_I r_I closes. The speed cancels.

The marks of the moment polygon are M_0, M_1 ..., of the force polygon F_0, F_1 ..., numbered as the masses; of the end
view O and P_1, P_2 ..., the places of the masses, P_I and P_II those of the corrections. All numbers are those of the
task: masses times lengths, and times lengths once more.

Source: Ozols 1974, 16-5 with figs. 16-17 to 16-19, (16.20) to (16.24).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from enum import Enum
from fractions import Fraction
from functools import cached_property
from typing import Any

from graphplan.kernel.drawing import Values
from graphplan.kernel.kinds import Quantity
from graphplan.kernel.program import Board, Mark, Panel
from graphplan.kernel.stages import Stage
from graphplan.machines.rotors.rotor import PLANES, Eccentric, Rotor, Vector, direction
from graphplan.machines.tolerances import CLOSING_TOL
from graphplan.phrases import Said, said

END_VIEW = Panel("end view", said("end view"))
MOMENTS = Panel("moment polygon", said("moment polygon"), said("Moment polygon: m·a·r"))
FORCES = Panel("force polygon", said("force polygon"), said("Force polygon: m·r"))
Pair = tuple[Any, Any]  # a vector by its components, in any numbers
MOMENT, FORCE = "moment", "force"  # kinds of what is laid off


class UnbalanceState(Enum):
    """What a rotor's unbalance is: none, a force alone or one that a single mass elsewhere would balance, a moment
    alone, or both."""

    BALANCED = "balanced"
    STATIC = "static"
    DYNAMIC = "dynamic"
    BOTH = "static and dynamic"


@dataclass(frozen=True)
class Sums:
    """The sums of m r and of m a r about plane I, as vectors, and what stands in the planes for all masses together.

    Every rotor is out of balance as two eccentric masses are, in any two planes: `planes` are the unbalances of these,
    of one plane alone the sum of m r. What is nothing beside its parts is exactly 0.
    """

    force: Vector
    moment: Vector
    planes: tuple[Vector, ...]

    @property
    def static(self) -> float:
        """The static disbalance (16.23)."""
        return math.hypot(*self.force)

    @property
    def dynamic(self) -> float:
        """The moment about plane I: the dynamic disbalance (16.24) where the static is 0."""
        return math.hypot(*self.moment)

    @property
    def state(self) -> UnbalanceState:
        if not any(self.force):
            return UnbalanceState.DYNAMIC if any(self.moment) else UnbalanceState.BALANCED
        return UnbalanceState.BOTH if self.single is None else UnbalanceState.STATIC

    @property
    def single(self) -> float | None:
        """How far from plane I one mass alone would balance force and moment; nothing where none would."""
        (x, y), (u, v) = self.force, self.moment
        square = x * x + y * y
        if not square or abs(x * v - y * u) > CLOSING_TOL * self.static * self.dynamic:
            return None
        return float((x * u + y * v) / square)


def sums(rotor: Rotor, masses: tuple[Eccentric, ...]) -> Sums:
    """The sums of the masses' unbalances."""
    arms = [rotor.arm(mass.at) for mass in masses if mass.at is not None]
    force, moment = _sum([(Fraction(1), mass) for mass in masses]), _sum([*zip(arms, masses, strict=True)])
    if not rotor.dynamic:
        return Sums(force, moment, (force,))
    shares = [arm / rotor.plane_distance for arm in arms]
    first = _sum([(1 - share, mass) for share, mass in zip(shares, masses, strict=True)])
    return Sums(force, moment, (first, _sum([*zip(shares, masses, strict=True)])))


def _sum(sides: list[tuple[Fraction, Eccentric]]) -> Vector:
    """The sum of multiples of unbalances; 0 where it is within rounding of that."""
    x, y = (sum((times * mass.unbalance[k] for times, mass in sides), Fraction(0)) for k in (0, 1))
    least = CLOSING_TOL * sum(abs(float(times)) * mass.mass_radius for times, mass in sides)
    exact = all(mass.exact for _, mass in sides)
    return (Fraction(0), Fraction(0)) if not exact and math.hypot(x, y) <= least else (x, y)


@dataclass(frozen=True)
class Correction:
    """What balances a rotor in one plane: its number, its place along the axis, mass times radius, and the angle."""

    index: int
    at: Fraction
    mass_radius: float
    angle: float

    @property
    def letter(self) -> str:
        return PLANES[self.index]


@dataclass(frozen=True)
class RotorDrawing:
    """The drawing of polygons and trials, a role for each name of a mark, with the values of its marks."""

    values: Values

    @cached_property
    def marks(self) -> dict[str, int]:
        """The steps of the marks, by their names."""
        return {name: step for name, (step,) in self.values.drawing.roles.items()}

    def position(self, name: str) -> complex:
        """Where a mark is, on its plan."""
        return complex(*self.values[self.marks[name]])

    def corners(self, letter: str) -> list[str]:
        """The marks of a polygon, in their order."""
        return [name for name in self.marks if name.startswith(f"{letter}_")]

    def vector(self, start: str, end: str, values: Sequence[Any]) -> Pair:
        """The vector from one mark to another, in any numbers that the program has been drawn with."""
        (x, y), (u, v) = values[self.marks[start]], values[self.marks[end]]
        return u - x, v - y


def closing_sides(drawing: RotorDrawing, rotor: Rotor, found: Sums, values: Sequence[Any]) -> list[Pair]:
    """What corrects each plane, mass times radius, as the sides that close the polygons: from the last mark to the
    first."""
    force = drawing.vector(drawing.corners("F")[-1], "F_0", values)
    sides = [force]
    if rotor.dynamic:
        x, y = drawing.vector(drawing.corners("M")[-1], "M_0", values)
        second = x / float(rotor.plane_distance), y / float(rotor.plane_distance)
        sides = [force if any(found.force) else (-second[0], -second[1]), second]
    return [side if any(unbalance) else (0.0, 0.0) for side, unbalance in zip(sides, found.planes, strict=True)]


def correction_of(rotor: Rotor, index: int, side: Pair) -> Correction:
    """The correction in a plane that has this mass times radius vector."""
    return Correction(index, rotor.planes[index], math.hypot(*side), direction(*side))


def free_radius(rotor: Rotor, masses: tuple[Eccentric, ...]) -> Fraction:
    """The radius at which corrections are drawn that have none: that of the outermost mass, or 1."""
    radii = [Fraction(mass.radius) for mass in masses if mass.radius]
    return max([*radii, *(radius for radius in rotor.radii if radius)], default=Fraction(1))


class PolygonRecorder:
    """Draws the polygons of one rotor on a board; `marks` are those that are read or shown, by their names."""

    def __init__(self, board: Board, rotor: Rotor, masses: tuple[Eccentric, ...]):
        self.board, self.rotor, self.masses = board, rotor, masses
        self.sums, self.free = sums(rotor, masses), free_radius(rotor, masses)
        self.marks: dict[str, Mark] = {}
        self.turned = [(k, mass) for k, mass in enumerate(masses, 1) if any(mass.unbalance)]  # those off the axis

    def draw_end_view(self) -> None:
        """The end view: the axis and the places of the masses."""
        with self.board.on(END_VIEW):
            self._keep("O", self.board.given(x=0, y=0, name="O"))
            for k, mass in self.turned:
                ratio = mass.mass or Fraction(mass.mass_radius) / self.free
                x, y = (component / ratio for component in mass.unbalance)
                self._keep(f"P_{k}", self.board.given(x=x, y=y, name=f"P_{k}"))

    def draw(self) -> None:
        """The polygons, and the places of the corrections."""
        if self.rotor.dynamic:
            law = said("each m·a·r runs as the radius, left of plane I against it; m_II·a·r_II closes")
            with self.board.on(MOMENTS, stage=Stage(said("Moment polygon"), law)):
                self._moments()
        law = said("centrifugal forces are as m·r; m_I·r_I closes") if self.rotor.dynamic else said(
            "centrifugal forces are as m·r; the correction closes")
        with self.board.on(FORCES, stage=Stage(said("Force polygon"), law)):
            self._forces()
        with self.placing_stage(said("their radii run as the closing sides")):
            self._corrections()

    def placing_stage(self, law: Said) -> AbstractContextManager[None]:
        """The stage in which correction masses are placed."""
        return self.board.on(END_VIEW, stage=Stage(said("Correction masses"), law))

    def _keep(self, name: str, mark: Mark) -> Mark:
        self.marks[name] = mark
        return mark

    def _sides(self, letter: str, written: str, kind: str, arms: Iterable[tuple[int, Eccentric, Fraction]]) -> Mark:
        """A polygon of multiples of the masses' unbalances, each along the radius; the last mark."""
        end = self.marks[f"{letter}_0"]
        for k, mass, arm in arms:
            radius = self.board.line(self.marks["O"], self.marks[f"P_{k}"])
            name, length = f"{letter}_{k}", Quantity(written.format(k), kind)
            text = said("opposite to the radius: left of plane I") if arm < 0 else ""
            end = self._keep(name, self.board.lay_along(self.board.parallel(radius, end), end, name=name, why=text,
                                                        length=mass.mass_radius * float(arm), quantity=length))
        return end

    def _moments(self) -> None:
        """The moment polygon of the masses that are not in plane I."""
        self._keep("M_0", self.board.begin(plan=MOMENTS, name="M_0"))
        arms = [(k, mass, self.rotor.arm(mass.at)) for k, mass in self.turned if mass.at is not None]
        self.last = self._sides("M", "m_{0}·a_{0}·r_{0}", MOMENT, (arm for arm in arms if arm[2]))

    def _forces(self) -> None:
        """The force polygon, with what the moment polygon gives."""
        self._keep("F_0", self.board.begin(plan=FORCES, name="F_0"))
        end = self._sides("F", "m_{0}·r_{0}", FORCE, ((k, mass, Fraction(1)) for k, mass in self.turned))
        if self.rotor.dynamic and any(self.sums.moment) and any(self.sums.force):
            end = self._keep("F_II", self.board.step_off(
                self.last, self.marks["M_0"], end, ratio=1 / self.rotor.plane_distance, name="F_II",
                why=said("m_II·r_II: the side that closes the moment polygon, divided by a")))
        self.end = end

    def _corrections(self) -> None:
        """Where the correction masses are put: on radii that run as the sides that close the polygons."""
        if self.rotor.dynamic and any(self.sums.moment):
            side = self.board.line(self.last, self.marks["M_0"], why=said("the closing side"))
            self.place_correction(1, self.board.parallel(side, self.marks["O"]))
            if not any(self.sums.force):
                self.place_correction(0, self.board.parallel(side, self.marks["O"]), -1, said(
                    "forces close by themselves: m_I·r_I is opposite and as large"))
        if any(self.sums.force) and any(self.sums.planes[0]):
            side = self.board.line(self.end, self.marks["F_0"], why=said("the closing side"))
            self.place_correction(0, self.board.parallel(side, self.marks["O"]))

    def place_correction(self, index: int, ray: Mark, way: int = 1, why: str = "", prime: str = "") -> None:
        """A correction mass on a radius, or opposite."""
        letter, given_radius = PLANES[index], self.rotor.radii[index]
        name = f"P_{letter}{prime}"
        why = why or ("" if given_radius else said("its radius is free"))
        length = way * (given_radius or self.free)
        self._keep(name, self.board.lay_along(ray, self.marks["O"], length=length, name=name, why=why,
                                              quantity=Quantity(f"r_{letter}", "length")))
