"""Friction on the drawing board: a journal's force touches its friction circle, a slide's leans by its friction angle.

Which way it does so follows from the force itself. So each round takes the directions of the forces from the last, and
the first those without friction; then friction is no load, but a pose in which the forces act elsewhere, and a round is
a force plan like any other (Ozols 1974, 9-1, 12-1 and 12-4). The senses of slides' forces seldom change, and a force
that is turned a little still touches its circle but for the square of that: few rounds are needed.
"""

from __future__ import annotations

import math
from collections import ChainMap
from collections.abc import Callable, Iterator, Sequence
from copy import copy
from dataclasses import dataclass, replace
from typing import Any

from graphplan.kernel.program import Mark
from graphplan.mechanism.model import FRAME, Contact, Friction, Gear, Number, Scene, Slide
from graphplan.mechanism.numbers import dot, minus, plus, quarter_turn, square_root, times
from graphplan.mechanism.order import by_name
from graphplan.mechanism.replaced import RollingGuide
from graphplan.methods.assembly import Pose
from graphplan.methods.forces import stages
from graphplan.methods.forces.free_bodies import DrawnForces, Span, reaction_on
from graphplan.methods.forces.higher_pairs import (
    TouchingGuide,
    inclined_guides,
    line_of_pressure,
    on_first,
    posed_for,
    rolling_point,
)
from graphplan.methods.forces.loading import Loading
from graphplan.methods.motion.velocity import Velocity
from graphplan.methods.panels import MECHANISM, JointForce, link_named, pair_text, slide_named
from graphplan.methods.tolerances import FRICTION_TOL, SHORT_FORCE
from graphplan.phrases import said

Valued = Callable[[Sequence[Mark]], list[Any]]


@dataclass(frozen=True)
class Journal:
    """A journal that rubs: the joint as the scene names it and as the `rough` scene does, the link, and the pin's."""

    friction: Friction
    point: str
    link: str
    pin: str


def journal_point(point: str, link: str) -> str:
    """The joint of a link alone with the pin of a journal: a name that no point of a scene has."""
    return f"{point} of {link}"


def journals(scene: Scene) -> Iterator[Journal]:
    """The journals that rub, each of a link in that which carries the pin."""
    assert scene.loads is not None
    for friction in sorted(scene.loads.frictions, key=lambda friction: by_name(friction.at)):
        if friction.at and friction.radius * friction.coefficient:
            pin, *others = scene.links_of[friction.at]
            for link in sorted(others, key=by_name):
                yield Journal(friction, journal_point(friction.at, link), link, pin)


def rubbing(scene: Scene, forces: DrawnForces) -> Iterator[Journal]:
    """The journals that rub, but for those of links that stand for rolling."""
    return (journal for journal in journals(scene) if journal.link in forces.scene.links)


def sliding(loading: Loading, forces: DrawnForces) -> Iterator[tuple[Slide, Number]]:
    """The slides and contacts that rub, each with its coefficient."""
    coefficients = {frozenset(friction.links): friction.coefficient for friction in loading.loads.frictions}
    for slide in forces.scene.slides:
        coefficient = coefficients.get(frozenset(slide.links))
        pair = slide.given_pair if isinstance(slide, TouchingGuide) else slide
        if coefficient and pair and not isinstance(slide, RollingGuide) and pair.name not in (
                *loading.loads.resting, *(loading.loads.pressed or ())):
            yield slide, coefficient


def meshing(loading: Loading, forces: DrawnForces) -> Iterator[tuple[RollingGuide, Number]]:
    """The gears whose teeth lose power, each with the share that they lose."""
    losses = {frozenset(friction.links): friction.coefficient for friction in loading.loads.frictions if friction.gear}
    for guide in forces.scene.slides:
        gear = guide.given_pair if isinstance(guide, RollingGuide) else None
        loss = losses.get(frozenset(gear.links)) if isinstance(gear, Gear) else None
        if isinstance(guide, RollingGuide) and loss and guide.given_pair.name not in loading.loads.resting:
            yield guide, loss


def rolling(loading: Loading) -> Iterator[tuple[Contact, Number]]:
    """The contacts that resist rolling, each with the arm by which its normal force lies ahead."""
    arms = {frozenset(friction.links): friction.coefficient for friction in loading.loads.frictions if friction.rolling}
    for contact in loading.net.scene.contacts:
        if (arm := arms.get(frozenset(contact.links))) and contact.name not in loading.loads.resting:
            yield contact, arm


def edge_point(slide: Slide) -> str:
    """Name of the point where the friction angles at both edges of a slide meet; no point of a scene has it."""
    return f"edges of {slide.name}"


def pressed_slides(scene: Scene) -> Iterator[tuple[Slide, Number, int]]:
    """The slides that are pressed at both edges, each with how far from the guide the friction angles there meet, and
    on which side."""
    sleeves = {frozenset(friction.links): friction for friction in scene.loads.frictions} if scene.loads else {}
    for slide in scene.slides:
        if scene.loads and (side := (scene.loads.pressed or {}).get(slide.name)):
            friction = sleeves[frozenset(slide.links)]
            yield slide, friction.length / friction.coefficient / 2, side


def rough(scene: Scene) -> Scene:
    """The scene with a joint of two links for each journal that rubs: their forces act at points of their own.

    So do those of a slide that is pressed at both edges: through the point where the friction angles there meet.
    """
    named: dict[str, dict[str, list[str]]] = {}
    for journal in journals(scene):
        for link in (journal.link, journal.pin):
            named.setdefault(journal.friction.at, {}).setdefault(link, []).append(journal.point)
    points = {name: at for point, at in scene.points.items()
              for name in (point, *dict.fromkeys(new for own in named.get(point, {}).values() for new in own))
              for at in (at,)}
    links = {link: tuple(name for point in own for name in named.get(point, {}).get(link, [point]))
             for link, own in scene.links.items()}
    written = list(scene.written)
    for slide, far, side in pressed_slides(scene):
        square = quarter_turn(slide.direction)
        away = times(side * far / square_root(dot(square, square)), square)
        points[edge_point(slide)] = plus(scene.points[slide.at], away)
        links |= {link: (*links[link], edge_point(slide)) for link in slide.links}
        written.remove(slide)
    return replace(scene, points=points, links=links, written=tuple(written))


class Rubbed:
    """The pose in which the forces of one round act, as those of the round before say."""

    def __init__(self, velocity: Velocity, loading: Loading, forces: DrawnForces):
        self.velocity, self.loading, self.forces, self.board = velocity, loading, forces, loading.board
        self.posed = posed_for(loading.pose, forces.scene)
        self.touching = {journal: self._touching(journal) for journal in rubbing(loading.net.scene, forces)}
        self.leaning = {slide: self._leaning(slide, coefficient) for slide, coefficient in sliding(loading, forces)}
        self.meshing = {guide: self._meshing(guide, loss) for guide, loss in meshing(loading, forces)}
        self.rolling = {contact: self._rolling(contact, arm) for contact, arm in rolling(loading)}
        self.leaning |= {guide: self._pressing(guide) for guide in inclined_guides(forces.scene)}

    @property
    def pose(self) -> Pose:
        """The pose with the points where journals' forces touch, and with guides that lean."""
        own = copy(self.loading.pose)
        touching = {journal.point: mark for journal, mark in self.touching.items()}
        touching |= {guide.at: mark for guide, mark in self.meshing.items()}
        touching |= {rolling_point(contact): mark for contact, mark in self.rolling.items()}
        touching |= {edge_point(slide): self._edges(slide, side * far)
                     for slide, far, side in pressed_slides(self.loading.net.scene)}
        own.points = ChainMap(touching, own.standing)
        own.guides = self.leaning
        return own

    def _touching(self, journal: Journal) -> Mark:
        """Point where a journal's force touches its friction circle."""
        at, points = journal.friction.at, self.loading.pose.points
        arm, pair = self._arm(journal), (journal.link, journal.pin)
        tail, head = self._reaction(journal)
        if tail is head or JointForce(at, journal.link).name in self.loading.loads.resting:
            return points[at]
        why = said("the friction of the journal {0}, of {1} in {2}", at, *map(link_named, pair))
        with self.board.on(MECHANISM, pair, stages.journal(why)):
            slip = self.velocity.slip(journal.pin, journal.link, arm)
            return self.board.touch(points[at], points[arm], slip, tail, head, name=f"{at}'", why=why,
                                    radius=journal.friction.radius * journal.friction.coefficient)

    def _edges(self, slide: Slide, far: Number) -> Mark:
        """Point where the friction angles at both edges of a slide meet: its reaction passes through it."""
        why = said("the friction angles at both edges of the slide {0} meet here: l/(2 mu)", slide_named(slide))
        with self.board.on(MECHANISM, slide.links, stages.edges(slide)):
            B, guide = self.posed.points[slide.at], self.loading.pose.guide(slide, run=True)
            return self.board.lay_along(self.board.perpendicular(guide, B), B, length=far, name=f"E_{slide.link}",
                                        why=why)

    def _meshing(self, guide: RollingGuide, loss: Number) -> Mark:
        """Point where a tooth force crosses the line of centres, on the side that opposes the turning of the wheels.

        It touches a circle, whose centre is but for the square of the loss at the pitch point.
        """
        gear: Gear = guide.given_pair
        (tail, head), (link, other), centre = self._tooth_force(guide), gear.links, gear.centres[0]
        P, C = self.posed.points[guide.at], self.posed.points[centre]
        if tail is head:
            return P
        driving, driven = (gear.crossing(1 - loss, drives) for drives in (1, -1))
        points = self.loading.net.scene.points
        arm = minus(gear.pitch_point(points), points[centre])
        radius = square_root(dot(arm, arm) * (driving - driven) ** 2 / (1 + gear.tangent**2)) / 2
        why = said("the losses of the gear {0}", gear.name)
        with self.board.on(MECHANISM, gear.links, stages.teeth(why)):
            Q = self.board.step_off(C, P, C, ratio=(driving + driven) / 2, name=f"{guide.at}'", why=why)
            slip = self.velocity.slip(other, link, centre)
            return self.board.touch(Q, C, slip, tail, head, why=why, radius=radius)

    def _rolling(self, contact: Contact, radius: Number) -> Mark:
        """Point of application of the force of a rolling contact: its normal component touches a circle about the point
        of contact, on the side that opposes the turning."""
        link, on, centre = contact.curved_side
        K, C = self.posed.points[contact.at], self.posed.points[centre]
        tail, head = self._contact_force(contact)
        if tail is head:
            return K
        board, why = self.board, said("the resistance to rolling of the contact {0}", pair_text(contact.links))
        with board.on(MECHANISM, (link, on), stages.rolling(why)):
            normal = board.side(K, C)
            N = board.meet(board.parallel(normal, tail), board.perpendicular(normal, head))
            return board.touch(K, C, self.velocity.slip(on, link, centre), tail, N, name=f"{contact.at}'", why=why,
                               radius=radius)

    def _contact_force(self, contact: Contact) -> Span:
        """The force on the link that a rolling contact holds first, in a round or without friction."""
        return reaction_on(self.forces, self.board, rolling_point(contact), contact.curved_side[0])

    def _tooth_force(self, guide: RollingGuide) -> Span:
        """The force on the first wheel, with its radial component."""
        return self.forces.teeth.get(guide.given_pair, on_first(guide, self.forces))

    def _reaction(self, journal: Journal) -> Span:
        """The force of a journal, in a round or without friction."""
        point = journal.point if journal.point in self.forces.scene.points else journal.friction.at
        return reaction_on(self.forces, self.board, point, journal.link)

    def _arm(self, journal: Journal) -> str:
        """Another point of the link than the journal."""
        one, two = self.loading.arm_points(journal.link if journal.link != FRAME else journal.pin)
        return two if one == journal.friction.at else one

    def _pressing(self, guide: RollingGuide) -> Mark:
        """The line of centres of two gears, turned by the pressure angle."""
        pose, (tail, head) = self.posed, on_first(guide, self.forces)
        with self.board.on(MECHANISM, guide.links, stages.pressure(guide)):
            return self.board.perpendicular(line_of_pressure(pose, guide, tail, head), pose.points[guide.at])

    def _leaning(self, slide: Slide, coefficient: Number) -> Mark:
        """The guide of a slide, or the tangent of a contact, turned by the friction angle."""
        pose = self.posed
        why = (said("the friction of the contact {0}", pair_text(slide.links)) if isinstance(slide, TouchingGuide)
               else said("the friction of the slide {0}", slide_named(slide)))
        with self.board.on(MECHANISM, (slide.link, slide.along), stages.guide(why)):
            slip = self.velocity.slip(slide.along, slide.link, slide.at)
            return self.board.lean(pose.guide(slide), pose.points[slide.at], slip, *self.forces.slides[slide],
                                   coefficient=coefficient, why=why)

    def stands(self, then: Rubbed, valued: Valued) -> bool:
        """Whether the forces of this round act as they themselves say: so `then` would have them act.

        Their moments about the points where they should touch, and their parts along the guides that should be square
        to them, are nothing beside the largest of them.
        """
        touching = [mark for journal, T in self.touching.items()
                    for mark in (T, then.touching[journal], *then._reaction(journal))]
        touching += [mark for guide, Q in self.meshing.items()
                     for mark in (Q, then.meshing[guide], *then._tooth_force(guide))]
        touching += [mark for contact, P in self.rolling.items()
                     for mark in (P, then.rolling[contact], *then._contact_force(contact))]
        leant = [mark for slide, guide in then.leaning.items() for mark in (guide, *then.forces.slides[slide])]
        values = valued([*touching, *leant])
        size, far = self.loading.scene.extent, [0.0]
        forces = [values[k + 1 : k + 3] for k in range(len(touching), len(values), 3)]
        forces += [values[k + 2 : k + 4] for k in range(0, len(touching), 4)]
        largest = max([SHORT_FORCE * size, *(math.dist(*force) for force in forces)])
        for T, new, tail, head in zip(*[iter(values[: len(touching)])] * 4, strict=True):
            far.append(abs((new[0] - T[0]) * (head[1] - tail[1]) - (new[1] - T[1]) * (head[0] - tail[0])) / size)
        for (a, b, _), tail, head in zip(*[iter(values[len(touching) :])] * 3, strict=True):
            far.append(abs((head[0] - tail[0]) * b - (head[1] - tail[1]) * a) / math.hypot(a, b))
        return max(far) <= FRICTION_TOL * largest
