"""Motions that are assumed to hang forces on: in each of them one force that is looked for does work, and no other.

A balance that does no work is a support: its link does not turn, or its point moves only across its direction, in a
block that slides that way on the frame. A reaction does work where its pair is freed.
"""

from __future__ import annotations

from collections import ChainMap
from copy import copy
from dataclasses import dataclass, replace
from fractions import Fraction

from graphplan.mechanism.bracing import bracing
from graphplan.mechanism.model import FRAME, Balance, Drive, Find, Pair, Scene, Slide, SlidingDrive, TurningDrive
from graphplan.mechanism.order import ordered_drives
from graphplan.mechanism.pairs.pair import KinematicPair
from graphplan.methods.draughtsman import Draughtsman
from graphplan.methods.motion.alternatives import ways
from graphplan.methods.motion.network import Network
from graphplan.methods.motion.planner import Planner
from graphplan.methods.motion.time_scale import Tempo, extent, round_number
from graphplan.methods.motion.velocity import Orthogonal, Velocity
from graphplan.methods.panels import MECHANISM
from graphplan.methods.poses import Pose
from graphplan.methods.styles import Style

AXES: tuple[Pair, Pair] = (Fraction(1), Fraction(0)), (Fraction(0), Fraction(1))


@dataclass(frozen=True)
class Assumed:
    """A scene whose drives make an assumed motion; of the links that were freed, points that are named apart."""

    scene: Scene
    renamed: dict[tuple[str, str], str]


def moving(scene: Scene) -> bool:
    """Whether the scene's own velocities serve: one drive, and it moves."""
    return len(scene.drives) == 1 and bool(scene.drives[0].rate)


def velocities(assumed: Assumed, pose: Pose, planner: Planner) -> Velocity:
    """The orthogonal velocities of an assumed motion."""
    scene, own = assumed.scene, copy(pose)
    own.scene = scene
    own.points = ChainMap({new: pose.points[old] for (_, old), new in assumed.renamed.items()}, pose.standing)
    velocity = Orthogonal(pose.board, planner.net, own, Tempo(Fraction(1)))
    with pose.board.on(MECHANISM):
        velocity.draw(planner.moves)
    return velocity


def planned(assumed: Assumed) -> Planner:
    """The plan of an assumed motion by the best way."""
    scene = assumed.scene
    every = Find(tuple(point for point, links in scene.links_of.items() if links), ())
    bare, style = replace(scene, loads=None, find=every), Style()
    return next(ways(Network(bare), "", lambda planner: Draughtsman(bare, planner, style).draw()))[1]


def working(scene: Scene, mode: int) -> Assumed:
    """The motion in which only the balance of this number does work; a single drive stands for its balance."""
    assert scene.loads is not None
    held = [balance for nth, balance in enumerate(scene.loads.balances) if nth != mode]
    balance, apart = scene.loads.balances[mode], scene.with_drives(())
    own: list[Drive] = [_unit(drive, scene) for drive in ordered_drives(scene)]
    if len(own) > 1 and not balance.at:
        own = [TurningDrive(balance.link, FRAME, Fraction(1), Fraction(0))]
    found = [_held(apart.with_drives((drive,)), held) for drive in own]
    return Assumed(next((one for one in found if bracing(one).sound), found[0]), {})


def _unit(drive: Drive, scene: Scene) -> Drive:
    """The drive at a rate of one."""
    return drive.driven_at(round_number(extent(scene) / 4) if drive.slides else Fraction(1), Fraction(0))


def _held(scene: Scene, balances: list[Balance]) -> Scene:
    """The scene with supports in the place of balances."""
    for nth, balance in enumerate(balances):
        if balance.direction is None:
            still = TurningDrive(balance.link, FRAME, Fraction(0), Fraction(0))
            scene = scene.with_drives((*scene.drives, still))
        else:
            (dx, dy), block = balance.direction, f"support {nth + 1} of {balance.link}"
            across = Slide(block, FRAME, balance.at, (-dy, dx))
            scene = replace(scene, links=scene.links | {block: (balance.at,)}, written=(*scene.written, across))
    return scene


def freed_joint(scene: Scene, point: str, link: str, pin: str, axis: Pair) -> Assumed:
    """The motion of a link on the pin in a joint, along an axis.

    The link's point gets a name of its own, and a block that carries it and slides along the pin's link.
    """
    new, block = f"{point} of {link}", f"pin {point}"
    links = {name: tuple(new if name == link and p == point else p for p in points)
             for name, points in scene.links.items()}
    slides = [replace(s, at=new) if (s.link, s.at) == (link, point) else s for s in scene.slides]
    written = *slides, Slide(block, pin, new, axis), _sliding(scene, block, pin)
    return _freed(scene, links | {block: (new,)}, written, {(link, point): new})


def freed_slide(scene: Scene, slide: Slide) -> Assumed:
    """The motion of a sliding link off its guide, along the axis that is more across it: on a second block."""
    new, block = f"{slide.at} of {slide.name}", f"block {slide.name}"
    dx, dy = slide.direction
    axis = AXES[abs(float(dx)) >= abs(float(dy))]
    slides = [replace(s, along=block) if s == slide else s for s in scene.slides]
    written = *slides, Slide(block, slide.along, new, axis), _sliding(scene, block, slide.along)
    return _freed(scene, scene.links | {block: (new,)}, written, {(block, slide.at): new})


def freed_turning(scene: Scene, slide: Slide) -> Assumed:
    """The motion of a sliding link that turns on its guide, about the slide's point, in a block there."""
    block = f"block {slide.name}"
    slides = [replace(s, link=block) if s == slide else s for s in scene.slides]
    written = *slides, TurningDrive(slide.link, slide.along, Fraction(1), Fraction(0))
    return _freed(scene, scene.links | {block: (slide.at,)}, written, {})


def _sliding(scene: Scene, block: str, along: str) -> Drive:
    return SlidingDrive(block, along, round_number(extent(scene) / 4), Fraction(0))


def _freed(scene: Scene, links: dict[str, tuple[str, ...]], written: tuple[KinematicPair, ...],
           renamed: dict[tuple[str, str], str]) -> Assumed:
    """The scene with other pairs, one freed and driven, and with all its balances as supports."""
    assert scene.loads is not None
    points = scene.points | {new: scene.points[old] for (_, old), new in renamed.items()}
    freed = replace(scene, points=points, links=links, written=written)
    return Assumed(_held(freed, [replace(balance, at=renamed.get((balance.link, balance.at), balance.at))
                                 for balance in scene.loads.balances]), renamed)
