"""Gears and contacts as force plans see them: each bears a force on a line that is known beforehand.

A contact bears one along the common normal of its profiles, one that rolls any through the point of contact. Gears bear
a circumferential force at the pitch point, square to the line of centres. Their flanks are inclined by the pressure
angle: the tooth force leans towards each wheel's centre, whichever drives. Its radial component passes through the
bearings at both centres, and the link between these has both: so it is added there when all else is known, and no other
force depends on it (Ozols 1974, 11-1 and 11-2).
"""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Iterator
from copy import copy
from dataclasses import dataclass, field, replace

from graphplan.errors import Refused
from graphplan.kernel.program import Board, Mark
from graphplan.mechanism.model import FRAME, Contact, Gear, Scene, Slide
from graphplan.mechanism.pairs.pair import LINE
from graphplan.mechanism.plane import turned
from graphplan.mechanism.replaced import EqualTurning, RollingGuide, replaced
from graphplan.methods.forces import stages
from graphplan.methods.forces.free_bodies import DrawnForces, Shown, Span, pair_letter, signed
from graphplan.methods.panels import MECHANISM
from graphplan.methods.poses import Pose
from graphplan.phrases import said


@dataclass(frozen=True)
class TouchingGuide(Slide):
    """A contact as a guide along the common tangent, which bears a force square to it and no couple."""

    letter = ""
    binds = 1
    passes = (LINE,)
    given: Contact | None = field(default=None, compare=False)


def bearing(scene: Scene) -> Scene:
    """The scene whose free bodies are drawn: guides at pitch points and at contacts, joints where contacts roll.

    Fails with `Refused` where a belt bears nothing but a couple.
    """
    lower = replaced(scene)
    if lower is scene:
        return scene
    points, links, written = dict(lower.points), dict(scene.links), [*scene.written]
    for pair in lower.written[len(scene.written):]:
        if isinstance(pair, EqualTurning):
            why = said("the belt over wheels of one size bears nothing but a couple")
            raise Refused("force plans", why, "ask for the lever, with --plan lever")
        if isinstance(pair, RollingGuide) and isinstance(pair.given, Gear):
            written.append(pair)
    for contact in scene.contacts:
        if contact.rolling:
            points[rolling_point(contact)] = points[contact.at]
            links |= {link: (*links[link], rolling_point(contact)) for link in contact.links}
        else:
            written.append(_touching(contact, scene))
    return replace(scene, points=points, links=links, written=tuple(written))


def rolling_point(contact: Contact) -> str:
    """The joint that stands for a contact that rolls: a name that no point of a scene has."""
    return f"{contact.at} of {contact.name}"


def _touching(contact: Contact, scene: Scene) -> TouchingGuide:
    """The guide along the tangent of a contact; the frame is never what slides."""
    link, along = contact.links if contact.links[0] != FRAME else contact.links[::-1]
    through, written = contact.through, contact.written
    direction = contact.direction or turned(contact.normal(scene.points))
    return TouchingGuide(link, along, contact.at, direction, through, written, contact)


def posed_for(pose: Pose, scene: Scene) -> Pose:
    """The pose with the guides of contacts, and with the points where they roll."""
    own, board = copy(pose), pose.board
    rolling = {rolling_point(contact): pose.points[contact.at] for contact in scene.contacts if contact.rolling}
    own.points = ChainMap(rolling, pose.points)
    own.guides = dict(pose.guides)
    touching = (slide for slide in scene.slides if isinstance(slide, TouchingGuide) and slide not in own.guides)
    for slide in touching:
        if slide.given and slide.given.direction is None:
            one, two = (pose.points[centre] for centre in slide.given.centres if centre)
            with board.on(MECHANISM, (slide.link, slide.along)):
                own.guides[slide] = board.perpendicular(board.side(one, two), pose.points[slide.at])
    return own


# ---- the radial components of tooth forces --------------------------------------------------------------------------


def press(board: Board, pose: Pose, scene: Scene, forces: DrawnForces) -> None:
    """Add the radial components: to the tooth forces, and to the reactions in the bearings of both wheels."""
    for guide in scene.slides:
        if isinstance(guide, RollingGuide) and isinstance(guide.given, Gear):
            forces.teeth[guide.given] = on_first(guide, forces)
    for guide in toothed(scene):
        gear: Gear = guide.given
        tail, head = forces.teeth[gear]
        if tail is head:
            continue
        with board.on(links=gear.links, stage=stages.pressure(guide)):
            line = line_of_pressure(pose, guide, tail, head)
            tip = board.meet(board.parallel(line, tail), board.parallel(pose.guide(guide), head))
        forces.teeth[gear] = tail, tip
        forces.shown.append(Shown("reaction", pair_letter(*gear.links[::-1]), tail, tip))
        for bearing, sign in _bearings(scene, gear):
            if bearing in forces.joints:
                begin, end = forces.joints[bearing]
                with board.on(stage=stages.joint(bearing[0])):
                    forces.joints[bearing] = begin, board.transfer(*signed((head, tip), sign), end)


def toothed(scene: Scene) -> list[RollingGuide]:
    """The rolling guides of gears whose flanks are inclined."""
    return [slide for slide in scene.slides if isinstance(slide, RollingGuide) and isinstance(slide.given, Gear)
            and slide.given.tangent]


def on_first(guide: RollingGuide | TouchingGuide, forces: DrawnForces) -> Span:
    """The force on the first link of the gear or contact that a guide stands for."""
    assert guide.given is not None
    return signed(forces.slides[guide], 1 if guide.link == guide.given.links[0] else -1)


def line_of_pressure(pose: Pose, guide: RollingGuide, tail: Mark, head: Mark) -> Mark:
    """The line of the tooth force, by the circumferential force on the first wheel."""
    gear: Gear = guide.given
    with pose.board.on(MECHANISM, gear.links):
        return pose.board.pressure_line(pose.points[guide.at], pose.points[gear.centres[0]], tail, head,
                                        coefficient=gear.tangent)


def _bearings(scene: Scene, gear: Gear) -> Iterator[tuple[tuple[str, str], int]]:
    """The joints at both centres, on wheel and on arm: and whether they bear the radial force on the first wheel."""
    arms = [link for link, points in scene.links.items() if link not in gear.links and {*gear.centres} <= {*points}]
    if not arms or len(gear.centres) < 2:
        why = said("the centres of the gear {0} are held apart by more than one link", gear.name)
        raise Refused("force plans", why, "ask for the lever, with --plan lever, or give pressure_angle = 0")
    for centre, wheel, sign in zip(gear.centres, gear.links, (-1, 1), strict=True):
        yield (centre, wheel), sign
        yield (centre, arms[0]), -sign
