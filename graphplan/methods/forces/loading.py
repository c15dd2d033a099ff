"""Loads on the drawing board: weights, given forces, inertia forces and couples of each link as drawn vectors.

A force is drawn `phi` lengths of the mechanism plan long for each unit of force. The inertia force is -m a, from the
acceleration plan; a couple becomes a pair of forces at two points of its link (Ozols 1974, 9-2 and 10-6). Loads that
change are given anew to the steps that lay them off.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from functools import partial
from itertools import combinations
from typing import Any, NamedTuple

from graphplan.kernel.kinds import Quantity
from graphplan.kernel.program import Board, Mark, Program
from graphplan.mechanism.model import FRAME, Force, Loads, Mass, Number, Scene
from graphplan.mechanism.numbers import dot, minus, quarter_turn
from graphplan.mechanism.order import (
    by_name,
    changing_loads,
    named_forces,
    named_moments,
    turning_drives,
    without_higher_pairs,
)
from graphplan.mechanism.units import inertia, metre, weight
from graphplan.methods.assembly import Pose
from graphplan.methods.forces import stages
from graphplan.methods.motion.curvature import draw_acceleration_centre
from graphplan.methods.motion.network import Network
from graphplan.methods.motion.plan import MotionPlan
from graphplan.methods.motion.time_scale import point_distance, round_length, tempo
from graphplan.methods.panels import MECHANISM, SHEET_EXTENTS, link_named
from graphplan.methods.tolerances import PLACE_TOL
from graphplan.phrases import said


class Acting(NamedTuple):
    """A drawn force: the mark at which it acts, its tail and its head; `name` is how it is spoken of."""

    at: Mark
    tail: Mark
    head: Mark
    name: str = ""

    @property
    def answer(self) -> Acting:
        """The force that answers it."""
        return Acting(self.at, self.head, self.tail, self.name)


Lay = Callable[[Mark], Acting]


class Loading:
    """The loads of each link, laid off from any mark of a force plan.

    Reads the plan of accelerations where links have masses, and `phi` and `unit` (of angular velocity), by which forces
    and rates are drawn. `inertia` names the form of inertia forces: at the centre with a couple, shifted so that it
    needs none, as those of two points that replace the link, at the centre of percussion for the acceleration centre,
    or at two pins with a couple for what these leave; those of the links `apart` are not to be shifted.
    """

    def __init__(self, board: Board, net: Network, pose: Pose, phi: Number, unit: Number, motion: MotionPlan | None,
                 inertia: str = "couple"):
        self.board, self.net, self.pose, self.phi, self.unit, self.motion = board, net, pose, phi, unit, motion
        self.inertia, self.apart = inertia, frozenset[str]()
        self.scene: Scene = without_higher_pairs(net.scene)
        assert self.scene.loads is not None
        self.loads: Loads = self.scene.loads

    def forces(self, link: str, start: Mark) -> Iterator[Acting]:
        """The forces on a link, one after the other from `start`."""
        for _, lay in self.forces_on(link):
            force = lay(start)
            yield force
            start = force.head

    def forces_on(self, link: str) -> Iterator[tuple[str, Lay]]:
        """Yield the forces on a link: the point where each acts, and how it is laid off; zero forces are left out."""
        for name, force in named_forces(self.loads).items():
            if force.on == link and (force.table or any(force.value)):
                why = said("{0}, the given force on {1} at {2}", name, link_named(link), force.at)
                yield force.at, partial(self._lay_off_given, force.at, force.value,
                                        Quantity(name, "force", bool(force.table)),
                                        why)
        mass = self.loads.masses.get(link)
        if mass and mass.mass:
            heaviness = tuple(mass.mass * g * weight(self.scene.units) for g in self.loads.gravity)
            if any(heaviness):
                why = said("{0}, the weight of {1}, at {2}", f"G_{link}", link_named(link), mass.centre)
                yield mass.centre, partial(self._lay_off_given, mass.centre, heaviness, Quantity(f"G_{link}", "force"),
                                           why)
            yield from self._inertia_forces(link, mass)

    def _inertia_forces(self, link: str, mass: Mass) -> Iterator[tuple[str, Lay]]:
        """The inertia force at the centre of mass, shifted aside, or at points that replace the link."""
        form = self._form(link, mass)
        whole = partial(self._inertia, link, mass.centre, mass.mass, f"J_{link}")
        if form == "shifted":
            yield self._centre_without_couple(link, mass), whole
        elif form == "percussion":
            yield self._percussion_centre(link, mass), whole
        elif form == "static":
            for pin, pin_mass, name in self._pin_masses(link, mass):
                if self._has_acceleration(link, pin):
                    yield pin, partial(self._inertia, link, pin, pin_mass, name)
        elif form == "points":
            pivot = self.arm_points(link)[0]
            part = self._gyration(mass) / self._square(pivot, mass.centre)
            centre = self._oscillation_centre(link, pivot, mass.centre, part)
            yield centre, partial(self._inertia, link, centre, mass.mass / (1 + part), f"J_{link}")
            if self._has_acceleration(link, pivot):
                yield pivot, partial(self._inertia, link, pivot, mass.mass * part / (1 + part), f"J_{link}'")
        elif self._has_acceleration(link, mass.centre):
            yield mass.centre, whole

    def _form(self, link: str, mass: Mass) -> str:
        """Form of a link's inertia: empty if it cannot turn; a couple if no force can take it up."""
        if self.motion is None or not (mass.inertia and self.turns(link)):
            return ""
        one_force = link not in self.apart and self._has_acceleration(link, mass.centre)
        able = mass.mass and {
            "shifted": one_force, "points": self._oscillates_nearby(link, mass),
            "percussion": one_force and any(
                point_distance(self.scene, P, R) for P, R in combinations(self.scene.links[link], 2)),
            "static": pins_beside(self.scene, link, mass)}.get(self.inertia)
        return self.inertia if able else "couple"

    def _oscillates_nearby(self, link: str, mass: Mass) -> bool:
        """Whether there is a centre of oscillation, and a sheet may hold it."""
        arm = math.sqrt(self._square(self.arm_points(link)[0], mass.centre))
        return arm > 0 and self._gyration(mass) <= SHEET_EXTENTS * self.scene.extent * arm

    def _gyration(self, mass: Mass) -> Number:
        """The square of a link's radius of gyration about its centre of mass."""
        return mass.inertia / mass.mass * metre(self.scene.units) ** 2

    def _pin_masses(self, link: str, mass: Mass) -> tuple[tuple[str, Number, str], ...]:
        """The static replacement: m_A = m CB/AB at the one pin, m_B = m AC/AB at the other."""
        pins = pins_beside(self.scene, link, mass)
        assert pins is not None
        A, B, C = (self.scene.points[name] for name in (*pins, mass.centre))
        part = dot(minus(C, B), minus(A, B)) / self._square(*pins)
        return (pins[0], mass.mass * part, f"J_{link}"), (pins[1], mass.mass * (1 - part), f"J_{link}'")

    def _inertia_left(self, link: str, mass: Mass) -> Number:
        """The moment of inertia of a couple: the link's own, or what two masses at its pins leave, I - m AC CB."""
        if self._form(link, mass) != "static":
            return mass.inertia
        (A, m_A, _), (B, m_B, _) = self._pin_masses(link, mass)
        return mass.inertia - m_A * m_B / mass.mass * self._square(A, B) / metre(self.scene.units) ** 2

    def _square(self, P: str, R: str) -> Number:
        arm = minus(self.scene.points[P], self.scene.points[R])
        return dot(arm, arm)

    def _centre_without_couple(self, link: str, mass: Mass) -> str:
        """The point where the inertia force acts without a couple: acceleration and turning say it, in proportion."""
        name, points = _inertia_place(link), self.pose.standing
        if name not in points:
            home, end, P, R, tip = self._couple_of(link, mass)
            with self.board.on(stage=stages.inertia(link)):
                points[name] = self.board.resultant(
                    points[mass.centre], end, home, P, R, end, tip, name=f"K_{link}",
                    why=said("the inertia force of {0}, shifted by its couple over it", link_named(link)))
        return name

    def acceleration_arm(self, link: str, mass: Mass) -> tuple[Mark, Mark]:
        """The acceleration centre Q of a link and its centre of mass."""
        name, points, motion = f"acceleration centre of {link}", self.pose.standing, self.motion
        assert motion is not None
        if name not in points:
            points[name] = draw_acceleration_centre(self.board, self.pose, lambda: motion, link)
        return points[name], points[mass.centre]

    def _percussion_centre(self, link: str, mass: Mass) -> str:
        """On the line from Q through the centre of mass C, beyond it by i^2 / QC: the force there needs no couple."""
        name, points = _inertia_place(link), self.pose.standing
        if name not in points:
            Q, C = self.acceleration_arm(link, mass)
            P, R = self.arm(link)
            with self.board.on(MECHANISM, (link,), stages.inertia(link)):
                T = self.board.third(C, self.board.transfer(Q, C, C), P, R)
                points[name] = self.board.step_off(
                    C, T, C, ratio=self._gyration(mass) / self._square(*self.arm_points(link)), name=f"K_{link}",
                    why=said("the radius of gyration is the mean of the distances of the acceleration centre and of "
                             "the centre of percussion from {0}", mass.centre))
        return name

    def percussions(self) -> Iterator[tuple[str, Number, Mark, Mark]]:
        """Of each link whose inertia force is at its centre of percussion: i^2, the acceleration and mass centres."""
        for link, mass in self.loads.masses.items():
            if self.inertia == "percussion" == self._form(link, mass):
                yield link, self._gyration(mass), *self.acceleration_arm(link, mass)

    def _couple_of(self, link: str, mass: Mass) -> tuple[Mark, Mark, Mark, Mark, Mark]:
        """The acceleration of a link's centre of mass, as begin and end, and its couple: two points, and the force at
        the second, from that end; both for a mass of one."""
        assert self.motion is not None
        one, two = self.arm_points(link)
        with self.board.on(stage=stages.inertia(link)):
            home, end = self.motion.vector(link, mass.centre)
            P, R, ends = *self.arm(link), self.motion.turning(link, one, two)
            return home, end, P, R, self.board.inertia_pair(P, R, *ends, end, ratio=self._gyration(mass))

    def shifts(self) -> Iterator[tuple[str, tuple[Mark, ...]]]:
        """Of each link whose inertia force is shifted: its acceleration and its couple, as five marks."""
        for link, mass in self.loads.masses.items():
            if self.inertia == "shifted" and self._form(link, mass) == "shifted":
                yield link, self._couple_of(link, mass)

    def _oscillation_centre(self, link: str, pivot: str, centre: str, part: Number) -> str:
        """The centre of oscillation for a pivot: with it the link is replaced by two points (Ozols 1974, 9-2)."""
        name, points = _inertia_place(link), self.pose.standing
        if name not in points:
            with self.board.on(MECHANISM, (link,), stages.inertia(link)):
                points[name] = self.board.step_off(
                    points[pivot], points[centre], points[centre], ratio=part, name=f"K_{link}",
                    why=said("the radius of gyration is the mean of the distances from {0}", centre))
        return name

    def _lay_off_given(self, at: str, value: tuple[Number, ...], quantity: Quantity, why: str, start: Mark) -> Acting:
        x, y = value
        head = self.board.lay_off(start, dx=x * self.phi, dy=y * self.phi, why=why, quantity=quantity)
        return Acting(self.pose.points[at], start, head, quantity.written)

    def _inertia(self, link: str, point: str, mass: Number, name: str, start: Mark) -> Acting:
        """The inertia force of a mass that moves as a point of a link does, against its acceleration."""
        assert self.motion is not None
        form = self._form(link, self.loads.masses[link])
        home, end = self.motion.vector(link, point)
        ratio = -mass * inertia(self.scene.units) * self.phi * self.unit * self.unit
        why = said("{0}, the inertia force of {1}, against the acceleration of {2}", name, link_named(link),
                   self.pose.letter_of_point(point))
        letter = self.pose.letter_of_point(point)
        written = f"{name} = m_{link}{letter if form == 'static' else ''} a_{letter}"
        head = self.board.step_off(home, end, start, ratio=ratio, why=why, quantity=Quantity(written, "force"))
        at = _inertia_place(link) if form in ("shifted", "percussion") else point
        return Acting(self.pose.points[at], start, head, name)

    def _has_acceleration(self, link: str, point: str) -> bool:
        return self.motion is not None and FRAME not in self.scene.links_of[point]

    def couples(self, link: str, start: Mark) -> Iterator[tuple[Acting, Acting]]:
        """The couples on a link, as pairs of forces laid off from `start`: the force at one point, and its answer."""
        for name, moment in named_moments(self.loads).items():
            if moment.on == link and (moment.table or moment.value):
                P, R = self.arm(link)
                value = moment.value * self.phi * metre(self.scene.units)
                head = self.board.couple(P, R, start, moment=value,
                                         why=said("the given moment on {0}", link_named(link)),
                                         quantity=Quantity(name, "force", bool(moment.table)))
                yield Acting(R, start, head, name), Acting(P, head, start, name)
        mass = self.loads.masses.get(link)
        if mass and self._form(link, mass) in ("couple", "static") and self._inertia_left(link, mass):
            yield self._inertia_pair(link, mass, start)

    def _inertia_pair(self, link: str, mass: Mass, start: Mark) -> tuple[Acting, Acting]:
        assert self.motion is not None
        one, two = self.arm_points(link)
        ends = self.motion.turning(link, one, two)
        P, R = self.pose.points[one], self.pose.points[two]
        left, units = self._inertia_left(link, mass), self.scene.units
        ratio = left * weight(units) * metre(units) * self.phi * self.unit * self.unit
        moment = f"(J_{link} - ab m_{link})" if self._form(link, mass) == "static" else f"J_{link}"
        why = said("the inertia couple of {0}, against its angular acceleration", link_named(link))
        head = self.board.inertia_pair(P, R, *ends, start, ratio=ratio, why=why,
                                       quantity=Quantity(f"W_{link} = {moment} alpha_{link}", "force"))
        return Acting(R, start, head, f"W_{link}"), Acting(P, head, start, f"W_{link}")

    def turns(self, link: str) -> bool:
        """Whether a link may have an angular acceleration: not if it turns as the frame does, but for even drives."""
        net = self.net
        if not net.ground or net.classes[net.body[link]] != net.classes[net.ground]:
            return True
        return bool(net.excess(link, net.ground).alpha)

    def arm_points(self, link: str) -> tuple[str, str]:
        """Two points of a link, far apart, the first one fixed if the link has such; of a block, one of its guide."""
        scene, names = self.scene, sorted(self.scene.links[link], key=by_name)
        first = next((p for p in names if FRAME in scene.links_of[p]), names[0])
        own = [p for p in names if point_distance(scene, first, p)]
        names += [p for s in scene.slides if link in (s.link, s.along) for k in (s.link, s.along) if k != link
                  for p in scene.links[k]]
        names += list(scene.points)
        if own:
            return first, max(own, key=lambda p: point_distance(scene, first, p))
        return first, next((p for p in names if point_distance(scene, first, p)), None) or self._auxiliary_point(first)

    def _auxiliary_point(self, point: str) -> str:
        """A point beside this one, where all points of the scene coincide: couples need an arm."""
        name, points = "point aside", self.pose.standing
        if name not in points:
            with self.board.on(MECHANISM, stage=stages.arm()):
                points[name] = self.board.lay_off(points[point], dx=Fraction(1), dy=Fraction(0),
                                                  name=self.pose.letter(name), why=said("an arm for couples"))
        return name

    def arm(self, link: str) -> tuple[Mark, Mark]:
        """The marks of the two points at which a link's couples act as pairs of forces."""
        one, two = self.arm_points(link)
        return self.pose.points[one], self.pose.points[two]


def _inertia_place(link: str) -> str:
    """The place where a link's inertia force acts in another form: a name that no point of a scene has."""
    return f"inertia of {link}"


def force_scale(scene: Scene) -> Number:
    """Drawn length of a unit of force: by the scales of the sheet, else so that the largest load is about a third of
    the mechanism, in a round number of mm."""
    if scene.sheet.phi:
        return scene.sheet.phi
    loads = scene.loads
    assert loads is not None
    size = scene.extent
    sizes = [abs(float(v)) for force in loads.forces for v in force.value]
    sizes += [2 * abs(float(moment.value * metre(scene.units))) / size for moment in loads.moments]
    sizes += [abs(float(m.mass * g * weight(scene.units))) for m in loads.masses.values() for g in loads.gravity]
    sizes += _inertia_sizes(scene, size)
    largest = max(sizes, default=0.0)
    return round_length(size / largest / 3 if largest else size, scene)


def _inertia_sizes(scene: Scene, size: float) -> Iterator[float]:
    """About how large inertia forces are: as if every moving mass ran round a quarter of the mechanism."""
    assert scene.loads is not None
    turning = [abs(float(drive.rate)) for drive in turning_drives(scene)]
    rate = (max(turning, default=0.0) or float(tempo(scene).unit)) ** 2 if scene.drives else 0.0
    for mass in scene.loads.masses.values():
        if FRAME not in scene.links_of[mass.centre]:
            yield float(mass.mass * inertia(scene.units)) * rate * size / 4


Given = dict[str | int, dict[str, Any]]
"""Numbers of steps, by their places in the program."""


def given_loads(program: Program, scene: Scene, phi: Number, loads: Mapping[str, Any]) -> Given:
    """Parameters of a program's steps for given values of the scene's loads, by their letters.

    Forces are complex numbers or arrays of them, moments real ones; `phi` is how long a unit of force is drawn.
    """
    def components(value: Any, name: str) -> dict[str, Any]:
        parts = drawn_components(scene, phi, name)
        numbers = [value.real, value.imag] if len(parts) == 2 else [value]
        return {part: number * times for (part, times), number in zip(parts.items(), numbers, strict=True)}

    return {step: components(loads[name], name) for step, name in changing_steps(program).items() if name in loads}


def changing_steps(program: Program) -> dict[int, str]:
    """The steps that lay off loads that change, each with the load's letter."""
    return {step.index: step.quantity.written for step in program.steps if step.quantity and step.quantity.changing}


def drawn_components(scene: Scene, phi: Number, name: str) -> dict[str, float]:
    """The parameters that lay off a load that changes, each with how long a unit of its component is drawn."""
    if isinstance(changing_loads(scene.loads)[name], Force):
        return {"dx": float(phi), "dy": float(phi)}
    return {"moment": float(phi * metre(scene.units))}


def pins_beside(scene: Scene, link: str, mass: Mass) -> tuple[str, str] | None:
    """The two points of a link furthest apart with its centre of mass on their line, and neither in it."""
    points, reach = scene.points, scene.extent
    C = points[mass.centre]
    names = [name for name in sorted(scene.links[link], key=by_name) if point_distance(scene, mass.centre, name)]
    pairs = [(P, R) for P, R in combinations(names, 2) if point_distance(scene, P, R) and
             abs(float(dot(quarter_turn(minus(points[P], C)), minus(points[R], C)))) <= PLACE_TOL * reach * reach]
    return max(pairs, key=lambda pair: point_distance(scene, *pair), default=None)
