"""The scene at another travel of its drives: what is asked there, and what its points are put together from."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from graphplan.cycle.extreme import extreme
from graphplan.cycle.geared import driven_by_gears
from graphplan.cycle.travel import check_drives
from graphplan.cycle.turn import Turn, follow, under
from graphplan.errors import Refused, SingularPose
from graphplan.mechanism.assembly import moved_on
from graphplan.mechanism.load_values import filled_in
from graphplan.mechanism.model import FRAME, Assembly, Pair, Placement, Scene, Slide
from graphplan.mechanism.numerals import TO_A_FLOAT
from graphplan.mechanism.placements import needs
from graphplan.mechanism.travel import coordinates, kept_pace
from graphplan.phrases import said

Travel = Fraction | float | int


def at(scene: Scene, travel: Travel | Sequence[Travel] | str) -> Scene:
    """The scene as it is when its first drive has gone so far in its sense, in degrees or lengths of one that slides.

    The other drives keep pace, or a list says how far each goes in its own sense. "outer" and "inner" are extreme
    positions of the link that the first drive's crank swings, "outer 3" of one of several. The pose is constructed from
    the given one. Fails with `Refused` where nothing leads there, and with `SingularPose` where it is a limit.
    """
    check_drives(scene)
    turned, travel = extreme(scene, travel) if isinstance(travel, str) else (None, travel)
    travels = _travels(scene, travel)
    given, shifts = driven_by_gears(scene, coordinates(scene, travels))
    paced, first = _paced(scene, travels)
    found = follow(paced, 1, (float(first), float(first)))
    if 0 in found.faults:
        why = found.faults[0]
        if all(math.isfinite(abs(z[0])) for z in found.points.values()):
            raise SingularPose(why, ())
        raise Refused(f"{scene.name}: the pose", why, said("a travel that the mechanism reaches"))
    assembly = Assembly(given, travels, shifts, moved_on(given, shifts, TO_A_FLOAT), under(scene), turned)
    posed = filled_in(in_pose(scene, found, 0), travels[0])
    where = "the pose: constructed at another travel of its drive"
    return replace(posed, placements=_standing(scene), irrational=(*scene.irrational, where), assembly=assembly)


def in_pose(scene: Scene, turn: Turn, pose: int) -> Scene:
    """The scene as it is given, in one pose of a turn: its points and the directions of its guides."""
    points: dict[str, Pair] = {name: (float(z[pose].real), float(z[pose].imag)) for name, z in turn.points.items()}

    def direction(one: Any) -> Pair:
        z: complex | None = None
        if isinstance(one, Slide):
            ends = [complex(*points[end]) for end in one.through or ()]
            z = ends[1] - ends[0] if ends else complex(turn.guides[one.name][pose]) if one.name in turn.guides else None
        return one.direction if z is None else (z.real, z.imag)

    return scene.posed(points, direction)


def _standing(scene: Scene) -> dict[str, Placement]:
    """How the points that stand still are placed: from each other as the scene has it, else by their coordinates."""
    fixed = [name for name, links in scene.links_of.items() if FRAME in links or not links]
    return {name: placed if (placed := scene.placements.get(name)) and {*needs(placed)} <= {*fixed}
            else Placement("given", {"at": scene.points[name]}) for name in fixed}


def _travels(scene: Scene, travel: Travel | Sequence[Travel]) -> tuple[Fraction, ...]:
    """How far each drive goes in its sense, in degrees or lengths."""
    given = [travel] if isinstance(travel, Fraction | float | int) else [*travel]
    if len(given) not in (1, len(scene.drives)) or not all(math.isfinite(one) for one in given):
        raise Refused(f"--at {', '.join(map(str, given))}", f"{len(scene.drives)} drives",
                      "one finite travel of the first drive, or one of each")
    if len(given) > 1:
        return tuple(Fraction(one) for one in given)
    return kept_pace(scene, Fraction(given[0]))


def _paced(scene: Scene, travels: Sequence[Fraction]) -> tuple[Scene, Fraction]:
    """The scene with drives at such rates that they go so far together, those first that move; and how far the first.
    """
    if len(travels) == 1:
        return scene, travels[0]
    far = sorted(zip(coordinates(scene, travels), scene.drives, strict=True), key=lambda one: not one[0])
    return scene.with_drives(drive.driven_at(float(shift) if drive.slides else math.radians(float(shift)), 0)
                             for shift, drive in far), abs(far[0][0])
