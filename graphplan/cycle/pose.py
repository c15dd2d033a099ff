"""The scene at another travel of its drives, at an extreme position, and with drives instead of its gears.

In an extreme position a crank and the coupler on it lie in one line, and the link that they swing turns back. The joint
between the coupler and that link is then b + r (outer) or b - r (inner) from the crank's pivot: Ozols 1974, section
5-1. Which of the crossings the mechanism comes to, the cycle says.

Gears turn links as far as the drives of a train give it, each link laid off as if it were driven. The turns obey the
same ratios as their rates, as long as the centres keep apart: exact in fractions.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any, TypeVar, cast

from graphplan.cycle.swings import coupled_links, pivot_or_guide, swings, time_ratio
from graphplan.cycle.tolerances import PLACE_TOL
from graphplan.cycle.travel import check_drives
from graphplan.cycle.turn import Turn, follow, points_under_slides
from graphplan.errors import Refused, SingularPose
from graphplan.mechanism.equations import Elimination
from graphplan.mechanism.load_values import filled_in
from graphplan.mechanism.model import FRAME, Assembly, Extreme, Gear, Number, Pair, Placement, Scene, Slide
from graphplan.mechanism.numbers import FLOAT_RECKONING, is_exact
from graphplan.mechanism.pairs.drives import TurningDrive
from graphplan.mechanism.placements import needs
from graphplan.mechanism.travel import coordinates, kept_pace, moved_on, sense
from graphplan.phrases import Said, said

Travel = Fraction | float | int
S = TypeVar("S", bound=Scene)


def at(scene: S, travel: Travel | Sequence[Travel] | str) -> S:
    """The scene as it is when its first drive has gone so far in its sense, in degrees or lengths of one that slides.

    The other drives keep pace, or a list says how far each goes in its own sense. "outer" and "inner" are extreme
    positions of the link that the first drive's crank swings, "outer 3" of one of several. The pose is constructed from
    the given one. Fails with `Refused` where nothing leads there, and with `SingularPose` where it is a limit.
    """
    check_drives(scene)
    turned, travel = extreme_position(scene, travel) if isinstance(travel, str) else (None, travel)
    travels = _drive_travels(scene, travel)
    with_drives, shifts = driven_by_gears(scene, coordinates(scene, travels))
    paced, first = _pace_drives(scene, travels)
    turn_there = follow(paced, 1, (float(first), float(first)))
    if 0 in turn_there.faults:
        why = turn_there.faults[0]
        if all(math.isfinite(abs(z[0])) for z in turn_there.points.values()):
            raise SingularPose(why, ())
        raise Refused(f"{scene.name}: the pose", why, said("a travel that the mechanism reaches"))
    assembly = Assembly(with_drives, travels, shifts, moved_on(with_drives, shifts, FLOAT_RECKONING),
                        points_under_slides(scene), turned)
    posed = filled_in(in_pose(scene, turn_there, 0), travels[0])
    reason_irrational = "the pose: constructed at another travel of its drive"
    return cast(S, replace(posed, placements=_fixed_placements(scene),
                           irrational=(*scene.irrational, reason_irrational), assembly=assembly))


def in_pose(scene: Scene, turn: Turn, pose: int) -> Scene:
    """The scene as it is given, in one pose of a turn: its points and the directions of its guides."""
    points: dict[str, Pair] = {name: (float(z[pose].real), float(z[pose].imag)) for name, z in turn.points.items()}

    def direction(one: Any) -> Pair:
        z: complex | None = None
        if isinstance(one, Slide):
            ends = [complex(*points[end]) for end in one.through or ()]
            z = ends[1] - ends[0] if ends else complex(turn.guides[one.name][pose]) if one.name in turn.guides else None
        return one.direction if z is None else (z.real, z.imag)

    return scene.with_pose(points, direction)


def _fixed_placements(scene: Scene) -> dict[str, Placement]:
    """Placements of the fixed points: from each other as in the scene, else by their coordinates."""
    fixed = [name for name, links in scene.links_of.items() if FRAME in links or not links]
    return {name: placement if (placement := scene.placements.get(name)) and {*needs(placement)} <= {*fixed}
            else Placement("given", {"at": scene.points[name]}) for name in fixed}


def _drive_travels(scene: Scene, travel: Travel | Sequence[Travel]) -> tuple[Fraction, ...]:
    """Travel of each drive in its sense, in degrees or lengths."""
    asked_travels = [travel] if isinstance(travel, Fraction | float | int) else [*travel]
    count = len(scene.drives)
    if len(asked_travels) not in (1, count) or not all(math.isfinite(value) for value in asked_travels):
        raise Refused(f"--at {', '.join(map(str, asked_travels))}", f"the scene has {count} drive{'s' * (count > 1)}",
                      "one finite travel of the first drive, or one of each")
    if len(asked_travels) > 1:
        return tuple(Fraction(value) for value in asked_travels)
    return kept_pace(scene, Fraction(asked_travels[0]))


def _pace_drives(scene: Scene, travels: Sequence[Fraction]) -> tuple[Scene, Fraction]:
    """The scene with drives at such rates that they go so far together, those first that move; and how far the first.
    """
    if len(travels) == 1:
        return scene, travels[0]
    far = sorted(zip(coordinates(scene, travels), scene.drives, strict=True), key=lambda one: not one[0])
    return scene.with_drives(drive.driven_at(float(shift) if drive.slides else math.radians(float(shift)), 0)
                             for shift, drive in far), abs(far[0][0])


# ---- extreme positions -----------------------------------------------------------------------------------------------


EXTREME_SIGNS = {"outer": 1, "inner": -1}  # on which side of the pivot the crank lies, seen from the joint, where b > r


def extreme_position(scene: Scene, asked: str) -> tuple[Extreme, Fraction]:
    """The extreme position that is asked for, such as "outer" or "inner 3", and how far the first drive goes to it.

    Degrees. That of a link which a coupler on the crank swings is where they lie in one line; that of any other is
    where the cycle turns it back. Fails with `Refused` where no link or more than one has such, or the mechanism does
    not come there.
    """
    side, _, link = asked.strip().partition(" ")
    link = link.strip()
    if side not in EXTREME_SIGNS:
        raise Refused(f"--at {asked}", "not a position", "degrees or lengths, or outer or inner, such as outer 3")
    coupled = [*coupled_links(scene, side)]
    matches = [position for position in coupled if link in ("", position.link)]
    if len(matches) == 1:
        return _coupled_extreme(scene, asked, matches[0])
    oscillations = [] if matches else [swing for swing in swings(scene) if link in ("", swing.link)]
    if len(oscillations) == 1:
        swing = oscillations[0]
        return Extreme(side, swing.link, time_ratio=swing.time_ratio), Fraction(swing.travel(side))
    names = [position.link for position in matches] or [swing.link for swing in oscillations or swings(scene)]
    links = ", ".join(dict.fromkeys(f"{side} {name}" for name in names))
    why = (said("several links have extreme positions") if matches or oscillations else
           said("this link has no extreme position") if links else
           said("no link swings about or along the frame as the first drive goes on"))
    raise Refused(f"--at {asked}", why, said("one of {0}", links) if links else said("the travel of the drive"))


def _coupled_extreme(scene: Scene, asked: str, position: Extreme) -> tuple[Extreme, Fraction]:
    """An extreme position with crank and coupler in one line, its time ratio and the drive's travel to it."""
    travel = _travel_to_extreme(scene, position)
    if travel is None:
        raise Refused(f"--at {asked}", _no_extreme_reason(position), said("the travel of the drive"))
    way = "inner" if position.way == "outer" else "outer"
    opposite = _travel_to_extreme(scene, replace(position, way=way))
    ratio = time_ratio(travel, opposite) if opposite is not None and follow(scene, 2).closed else None
    return replace(position, time_ratio=ratio), Fraction(travel)


def _no_extreme_reason(one: Extreme) -> Said:
    return said("the mechanism reaches no position in which {0} and {1} lie in one line in this way",
                f"{one.pivot}{one.pin}", f"{one.pin}{one.joint}")


def _travel_to_extreme(scene: Scene, position: Extreme) -> float | None:
    """Travel of the drive to an extreme position in its sense, in degrees: on from the given pose, else back; None if
    it does not come there."""
    at = {name: complex(*map(float, place)) for name, place in scene.points.items()}
    O, A, B = at[position.pivot], at[position.pin], at[position.joint]
    long = abs(B - A) + EXTREME_SIGNS[position.way] * abs(A - O)
    if abs(long) <= PLACE_TOL * scene.extent:
        return None
    drive = scene.drives[0]
    sense_sign = sense(drive) * (1 if drive.on == FRAME else -1)
    for joint in _crossings(scene, position, O, B, abs(long), at):
        arm = EXTREME_SIGNS[position.way] * (joint - O) / long
        turn = sense_sign * math.degrees(cmath.phase(arm / (A - O))) % 360
        for travel in (turn, turn - 360):
            turn_there = follow(scene, 1, (travel, travel))
            if 0 not in turn_there.faults and abs(turn_there.points[position.joint][0]
                                                  - joint) <= PLACE_TOL * scene.extent:
                return travel
    return None


def _crossings(scene: Scene, position: Extreme, O: complex, B: complex, far: float,
               at: dict[str, complex]) -> Iterator[complex]:
    """Yield the places where the joint has this distance from the pivot, on its circle or its line."""
    hold = pivot_or_guide(scene, position.link, position.joint)
    if isinstance(hold, str):
        C = at[hold]
        if C == O:
            return
        d, direction = abs(C - O), (C - O) / abs(C - O)
        along = (far * far + d * d - abs(B - C) ** 2) / (2 * d)
        foot, up = O + along * direction, 1j * direction
    else:
        assert hold is not None
        up = hold / abs(hold)
        foot = B + ((O - B) * up.conjugate()).real * up
    high = far * far - abs(foot - O) ** 2
    if high > 0:
        yield from (foot + sign * math.sqrt(high) * up for sign in (1, -1))


# ---- how far gears turn links ----------------------------------------------------------------------------------------


Row = dict[str, Fraction]  # what links' turns are multiplied by in a sum, which is the value of ""


def driven_by_gears(scene: Scene, shifts: tuple[Fraction, ...]) -> tuple[Scene, tuple[Fraction, ...]]:
    """The scene with drives instead of its gears, and how far all drives go, counter-clockwise or along.

    Fails with `Refused` where that is not so: of a rack, and of gears whose line of centres no train alone turns.
    """
    if not scene.gears and not scene.contacts:
        return scene, shifts
    rows = [_turns_row((drive.link, 1), (drive.on, -1), turn=shift)
            for drive, shift in zip(scene.drives, shifts, strict=True) if not drive.slides]
    rows += [row for gear in scene.gears if (row := _ratio_row(scene, gear))]
    turns = _solve_turns(rows) | {FRAME: Fraction(0)}
    more, led = _gear_drives(scene, turns)
    plain = not scene.contacts and all(_ratio_row(scene, gear) and {*gear.links} <= led for gear in scene.gears)
    if not plain or any(name and name not in turns for row in rows for name in row):
        raise Refused(f"{scene.name}: the pose",
                      said("no construction is known for the positions of these gears or contacts"),
                      "the pose as it is given; graphplan cycle has its numbers in all poses")
    without_gears = replace(scene, written=tuple(pair for pair in scene.written if pair not in scene.gears),
                            repetitions={})
    return (without_gears.with_drives((*scene.drives, *more)),
            (*shifts, *(turns[drive.link] - turns[drive.on] for drive in more)))


def _gear_drives(scene: Scene, turns: Row) -> tuple[list[TurningDrive], set[str]]:
    """Drives for links whose turns are known, each about a joint with another such, and all links so driven."""
    led, more = {FRAME: True}, list[TurningDrive]()
    ends = [ends for drive in scene.drives for ends in (drive.links, drive.links[::-1])]
    while True:
        driven = next((link for link, on in ends if on in led and link not in led), None)
        about = next(((link, on) for link in turns for on in led if link not in led and on in turns
                      and {*scene.links[link]} & {*scene.links.get(on, ())}), None)
        if driven is not None:
            led[driven] = True
        elif about is not None:
            more.append(TurningDrive(*about, 0, 0))
            led[about[0]] = True
        else:
            return more, {*led}


def _ratio_row(scene: Scene, gear: Gear) -> Row | None:
    """Condition of a gear on the turns of its links and of the arm that holds its centres; None for a gear without an
    arm."""
    arm = next((link for link, points in scene.links.items() if {*gear.centres} <= {*points}), None)
    if len(gear.centres) < 2 or arm is None or not is_exact(gear.factors):
        return None
    first, second = gear.factors
    return _turns_row((gear.links[0], first), (gear.links[1], second), (arm, -first - second))


def _turns_row(*terms: tuple[str, Number], turn: Number = 0) -> Row:
    """The sum of links' turns, each times its factor."""
    row = {"": Fraction(turn)}
    for link, factor in terms:
        if link != FRAME:
            row[link] = row.get(link, Fraction(0)) + Fraction(factor)
    return row


def _solve_turns(rows: list[Row]) -> Row:
    """The turns that follow from the rows, as far as these bind them."""
    links = [*dict.fromkeys(name for row in rows for name in row if name)]
    system = Elimination([{k: row[link] for k, link in enumerate(links) if link in row} for row in rows], len(links))
    turns, free = system.solve([row[""] for row in rows]) or [], system.free
    return {link: turn for k, (link, turn) in enumerate(zip(links, turns, strict=False)) if k not in free}
