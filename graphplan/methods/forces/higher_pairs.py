"""Gears and contacts as force plans see them: each bears a force on a line that is known beforehand.

A contact bears one along the common normal of its profiles, one that rolls any through the point of contact. Gears bear
a circumferential force at the pitch point, perpendicular to the line of centres. Their flanks are inclined by the
pressure angle: the tooth force leans towards each wheel's centre, whichever drives. Its radial component passes through
the bearings at both centres, and the link between these has both: so it is added there when all else is known, and no
other force depends on it (Ozols 1974, 11-1 and 11-2).
"""

from __future__ import annotations

import math
from collections import ChainMap
from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass, field, replace

from graphplan.errors import Refused
from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import FRAME, Contact, Gear, Pair, Scene, Slide
from graphplan.mechanism.numbers import dot, quarter_turn
from graphplan.mechanism.pairs.pair import LINE
from graphplan.mechanism.replaced import RollingGuide, with_lower_pairs
from graphplan.methods.assembly import Pose
from graphplan.methods.forces import stages
from graphplan.methods.forces.free_bodies import DrawnForces, Shown, Span, with_sign
from graphplan.methods.forces.loading import Acting
from graphplan.methods.panels import MECHANISM, strand_letters
from graphplan.phrases import said


@dataclass(frozen=True)
class TouchingGuide(Slide):
    """A contact as a guide along the common tangent, which bears a force perpendicular to it and no couple."""

    letter = ""
    binds = 1
    passes = (LINE,)
    given_pair: Contact | None = field(default=None, compare=False)


def bearing(scene: Scene) -> Scene:
    """The scene whose free bodies are drawn: guides at pitch points and at contacts, joints where contacts roll."""
    lower = with_lower_pairs(scene)
    if lower is scene:
        return scene
    points, links, written = dict(lower.points), dict(scene.links), [*scene.written]
    written += [pair for pair in lower.written[len(scene.written):]
                if isinstance(pair, RollingGuide) and isinstance(pair.given_pair, Gear)]
    for contact in scene.contacts:
        if contact.rolling:
            points[rolling_point(contact)] = points[contact.at]
            links |= {link: (*links[link], rolling_point(contact)) for link in contact.links}
        else:
            written.append(_touching(contact, scene))
    return replace(scene, points=points, links=links, written=tuple(written))


def refuse_couples(scene: Scene) -> None:
    """Fail with `Refused` if the force of a belt is a couple alone."""
    for gear in scene.gears:
        if gear.direction is None and not sum(gear.factors):
            why = said("a belt over wheels of equal size transmits a couple alone")
            raise Refused("force plans", why, "ask for the lever, with --plan lever")


def rolling_point(contact: Contact) -> str:
    """The joint that stands for a contact that rolls: a name that no point of a scene has."""
    return f"{contact.at} of {contact.name}"


def _touching(contact: Contact, scene: Scene) -> TouchingGuide:
    """The guide along the tangent of a contact; the frame is never what slides."""
    link, along = contact.links if contact.links[0] != FRAME else contact.links[::-1]
    through, written = contact.through, contact.written
    direction = contact.direction or quarter_turn(contact.normal(scene.points))
    return TouchingGuide(link, along, contact.at, direction, through, written, contact)


def pushing(contact: Contact, points: Mapping[str, Pair]) -> tuple[float, float] | None:
    """The way in which a contact can push its first link; None where one of the two profiles is a corner.

    The body of a convex profile is on the side of its centre; of two with their centres on one side that is the one of
    the smaller radius.
    """
    x, y = map(float, points[contact.at])
    arms = [(float(points[centre][0]) - x, float(points[centre][1]) - y) if centre else None
            for centre in contact.centres]
    sizes = [math.inf if arm is None else math.hypot(*arm) for arm in arms]
    first, second = arms
    if not all(sizes):
        return None
    if first is not None and (sizes[0] <= sizes[1] or (second is not None and dot(first, second) < 0)):
        return first
    assert second is not None
    return -second[0], -second[1]


def pressed_by_teeth(scene: Scene) -> tuple[set[str], set[Slide]]:
    """The joints and the slides in whose reactions tooth forces have radial components."""
    inclined = [gear for gear in scene.gears if gear.tangent or gear.grip]
    racks = {gear.links[1] for gear in inclined if gear.direction is not None}
    return ({centre for gear in inclined for centre in gear.centres},
            {slide for slide in scene.slides if not racks.isdisjoint(slide.links)})


def posed_for(pose: Pose, scene: Scene) -> Pose:
    """The pose with the guides of contacts, and with the points where what rolls bears its force, unless it has them.
    """
    own, board = copy(pose), pose.board
    rolling = {name: pose.points[name if name in pose.points else contact.at]
               for contact in scene.contacts if contact.rolling for name in [rolling_point(contact)]}
    own.points = ChainMap(rolling, pose.points)
    own.guides = dict(pose.guides)
    touching = (slide for slide in scene.slides if isinstance(slide, TouchingGuide) and slide not in own.guides)
    for slide in touching:
        if slide.given_pair and slide.given_pair.direction is None:
            one, two = (pose.points[centre] for centre in slide.given_pair.centres if centre)
            with board.on(MECHANISM, (slide.link, slide.along)):
                own.guides[slide] = board.perpendicular(board.side(one, two), pose.points[slide.at])
    return own


# ---- the radial components of tooth forces --------------------------------------------------------------------------


def press(board: Board, pose: Pose, scene: Scene, forces: DrawnForces) -> None:
    """Add the radial components: to the tooth forces, and to the reactions in the bearings of both wheels.

    Fails with `Refused` where the centres are held apart by more than one link.
    """
    for guide in scene.slides:
        if isinstance(guide, RollingGuide) and isinstance(guide.given_pair, Gear):
            forces.teeth[guide.given_pair] = on_first(guide, forces)
    for guide in inclined_guides(scene):
        gear: Gear = guide.given_pair
        tail, head = forces.teeth[gear]
        bearings = _Bearings(board, scene, gear, forces)
        if tail is head:
            continue
        with board.on(links=gear.links, stage=stages.pressure(guide)):
            line = line_of_pressure(pose, guide, tail, head)
            tip = board.meet(board.parallel(line, tail), board.parallel(pose.guide(guide), head))
        forces.teeth[gear] = tail, tip
        forces.replace_by_whole((tail, head), (tail, tip))
        bearings.press(Acting(pose.points[guide.at], head, tip))


def divide_pulls(board: Board, pose: Pose, scene: Scene, forces: DrawnForces) -> None:
    """Draw the pull of each strand of a belt: the two run from the pole to where the belt leaves the first pulley."""
    for guide in inclined_guides(scene):
        gear: Gear = guide.given_pair
        if gear.grip is None:
            continue
        tail, head = forces.teeth.get(gear, on_first(guide, forces))
        P, C, aside = pose.points[guide.at], pose.points[gear.centres[0]], gear.grip.aside
        with board.on(MECHANISM, gear.links, stages.strands(gear)):
            M, why = board.step_off(C, P, C, ratio=gear.grip.foot), said("the belt leaves the pulley here")
            left, right = (board.line(P, board.step_across(C, P, M, ratio=side * aside, why=why))
                           for side in (1, -1))
        with board.on(links=gear.links, stage=stages.strands(gear)):
            tip = board.meet(board.parallel(left, tail), board.parallel(right, head))
        for (strand, letter), span in zip(strand_letters(gear).items(), ((tail, tip), (tip, head)), strict=True):
            forces.strands[strand] = span
            forces.shown.append(Shown("part", letter, *span))


class _Bearings:
    """Bearings that hold the two wheels of a gear apart: joints at the centres on an arm, or the slide of the arm on a
    rack."""

    def __init__(self, board: Board, scene: Scene, gear: Gear, forces: DrawnForces):
        self.board, self.gear, self.forces = board, gear, forces
        first, second = gear.links
        arms = [link for link, points in scene.links.items() if link not in gear.links and {*gear.centres} <= {*points}]
        self.slide = next((slide for slide in scene.slides for arm in arms if {*slide.links} == {arm, second}
                           and slide.turns_alike), None) if gear.direction is not None else None
        if not arms or (gear.direction is not None and self.slide is None):
            why = said("the centres of the gear {0} are held apart by more than one link", gear.name)
            raise Refused("force plans", why, "ask for the balance, with --plan lever, or give pressure_angle = 0")
        arm = next(link for link in self.slide.links if link != second) if self.slide else arms[0]
        self.joints = [((gear.centres[0], first), -1), ((gear.centres[0], arm), 1)]
        if self.slide is None:
            self.joints += [((gear.centres[1], second), 1), ((gear.centres[1], arm), -1)]

    def press(self, radial: Acting) -> None:
        """Enter the radial force on the first wheel in the reactions."""
        for joint, sign in self.joints:
            if joint in self.forces.joints:
                with self.board.on(stage=stages.joint(joint[0])):
                    self.forces.joints[joint] = self._add_radial(self.forces.joints[joint], radial, sign)
        if self.slide:
            sign = 1 if self.slide.link == self.gear.links[1] else -1
            with self.board.on(stage=stages.seat(self.slide)):
                self._add_couple(self.slide, radial if sign > 0 else radial.answer)
                self.forces.slides[self.slide] = self._add_radial(self.forces.slides[self.slide], radial, sign)

    def _add_radial(self, span: Span, radial: Acting, sign: int) -> Span:
        """A reaction with the radial force, which is drawn in its place."""
        whole = span[0], self.board.transfer(*with_sign((radial.tail, radial.head), sign), span[1])
        self.forces.replace_by_whole(span, whole)
        return whole

    def _add_couple(self, slide: Slide, radial: Acting) -> None:
        """A slide's reaction goes on acting at its seat: the radial force makes a couple with its answer there."""
        seat, pair = self.forces.seats[slide], self.forces.pairs[slide]
        answer = Acting(seat, radial.head, radial.tail)
        if pair is None:
            self.forces.pairs[slide] = radial, answer
            return
        (R, first, mark), Y = (pair[0].at, pair[0].tail, pair[0].head), pair[1].at
        for force in (radial, answer):
            if force.at is not Y:
                mark = self.board.balance(Y, R, force.at, force.head, force.tail, mark)
        self.forces.pairs[slide] = Acting(R, first, mark), Acting(Y, mark, first)


def inclined_guides(scene: Scene) -> list[RollingGuide]:
    """The rolling guides of gears whose flanks are inclined."""
    return [slide for slide in scene.slides if isinstance(slide, RollingGuide) and isinstance(slide.given_pair, Gear)
            and slide.given_pair.tangent]


def on_first(guide: RollingGuide | TouchingGuide, forces: DrawnForces) -> Span:
    """The force on the first link of the gear or contact that a guide stands for."""
    assert guide.given_pair is not None
    return with_sign(forces.slides[guide], 1 if guide.link == guide.given_pair.links[0] else -1)


def line_of_pressure(pose: Pose, guide: RollingGuide, tail: Mark, head: Mark) -> Mark:
    """The line of the tooth force, by the circumferential force on the first wheel."""
    gear: Gear = guide.given_pair
    with pose.board.on(MECHANISM, gear.links):
        draw = pose.board.pull_line if gear.grip else pose.board.pressure_line
        return draw(pose.points[guide.at], pose.points[gear.centres[0]], tail, head, coefficient=gear.tangent)
