"""Tasks: a cam's law, follower and limits, read from TOML text; all faults at once.

Lengths are in the task's unit, angles in degrees. Lifts of an oscillating follower are degrees, too.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple

from graphplan.cams.law import DWELL, MOTIONS, TABLE, Law, LawStage, spline
from graphplan.cams.tolerances import LIFT_TOL
from graphplan.mechanism.fields import (
    AMOUNT,
    DISTANCE,
    NUMBER,
    Either,
    Faults,
    Field,
    Kind,
    Rows,
    SceneItem,
    SceneNames,
    Table,
    TableRow,
    Vector,
    choice,
    describe,
)
from graphplan.mechanism.numbers import number_text
from graphplan.mechanism.tasks import SheetTask, read_task, task_table, task_text

TRANSLATING, OSCILLATING = "translating", "oscillating"
POINTED, ROLLER, FLAT = "point", "roller", "flat"
PRESSURE, CONVEX, SMALLEST = "pressure angle", "convex", "smallest"
TURNS = {"counter-clockwise": 1, "clockwise": -1}
MIN_DIVISIONS, MAX_DIVISIONS = 6, 72  # divisions of the turn


@dataclass(frozen=True)
class Follower:
    """The follower: its motion and its contact with the cam; lengths that it does not have are 0."""

    moves: str
    contact: str
    radius: Fraction = Fraction(0)
    offset: Fraction | str = Fraction(0)
    arm: Fraction = Fraction(0)
    distance: Fraction = Fraction(0)

    @property
    def oscillates(self) -> bool:
        return self.moves == OSCILLATING

    @property
    def flat(self) -> bool:
        return self.contact == FLAT


@dataclass(frozen=True)
class Limits:
    """The largest pressure angles in degrees while the follower rises and while it returns; None without a limit."""

    rise: Fraction
    back: Fraction | None = None


@dataclass(frozen=True)
class CamWheel:
    """The cam: sense of turning, speed in rad/s, base circle, limits, divisions of the turn."""

    sense: int
    omega: float
    base: Fraction | str
    limits: Limits | None
    least: Fraction
    divisions: int


class FollowerLoad(NamedTuple):
    """Load of a follower on a straight path: a force against its rise in N, its mass in kg, the distance of the nearer
    bearing of its guide from its first contact, the distance of the bearings, their coefficient of friction, and its
    given spring: N a length, and N at the lowest position."""

    force: Fraction
    mass: Fraction
    overhang: Fraction
    bearing: Fraction
    friction: Fraction
    stiffness: Fraction | None = None
    preload: Fraction | None = None


@dataclass(frozen=True)
class Task(SheetTask):
    """The keys of a task."""

    stages: tuple[LawStage, ...]
    follower: Follower
    cam: CamWheel
    load: FollowerLoad | None = None

    @cached_property
    def law(self) -> Law:
        """The law in lengths, or in radians of an oscillating follower."""
        return Law(self.stages, math.pi / 180 if self.follower.oscillates else 1.0)


# ---- the law --------------------------------------------------------------------------------------------------------


def _rows(item: SceneItem, names: SceneNames) -> tuple[tuple[Fraction, Fraction], ...] | None:
    """The angles and lifts of a table, both from 0, the angles rising."""
    if not isinstance(item.value, list) or len(item.value) < 3:
        return item.fault(f"{describe(item.value)} where angles and lifts are wanted",
                          "three pairs or more, such as [[0, 0], [60, 10], [120, 20]]")
    before, points = len(item.faults), list[Vector]()
    for row in item.value:
        if (pair := item.with_value(row).vector()) is not None:
            if points and pair[0] <= points[-1][0]:
                item.fault(f"the angle {number_text(pair[0])} comes after {number_text(points[-1][0])}",
                           "increasing angles")
            points.append(pair)
    if points and any(points[0]):
        item.fault("its first pair is not [0, 0]", "degrees and lifts from the beginning of the stage")
    return tuple(points) if len(item.faults) == before else None


def stage_by_motion(row: TableRow) -> LawStage | None:
    """A stage by the name of its motion; one that is no dwell has a stroke."""
    motion, stroke = row["motion"], row.values.get("stroke", Fraction(0))
    if motion == DWELL and stroke:
        row.items["stroke"].fault("a dwell has no stroke", "leave it out, or name another motion")
    if motion != DWELL and not stroke:
        row.item.fault(f"a {motion} motion without a stroke", 'stroke = 25, or -25 of a return, or motion = "dwell"')
    return LawStage(row["angle"], stroke, motion, tuple(piece.times(stroke) for piece in MOTIONS[motion]))


def stage_by_table(row: TableRow) -> LawStage:
    """A stage by a table of angles and lifts: a cubic spline, at rest at both ends, or periodic where it is all."""
    angles, lifts = zip(*row["table"], strict=True)
    pieces = spline([angle / angles[-1] for angle in angles], lifts, closed=angles[-1] == 360 and not lifts[-1])
    return LawStage(angles[-1], lifts[-1], TABLE, pieces)


_PAIRS = Kind("pairs of numbers", _rows, {"type": "array", "minItems": 3, "items": {
    "type": "array", "items": NUMBER.schema, "minItems": 2, "maxItems": 2}})
LAW = Rows(Either((
    Table("a stage by its motion", (
        Field("angle", "through how many degrees the cam turns meanwhile", DISTANCE, "such as angle = 120"),
        Field("motion", "how the follower moves", choice(*MOTIONS), 'such as motion = "sine"'),
        Field("stroke", "by how much the lift changes: a length, degrees of an oscillating follower; negative of a "
              "return", NUMBER),
    ), stage_by_motion),
    Table("a stage by a table", (
        Field("table", "degrees and lifts from the beginning of the stage; between them a cubic spline runs", _PAIRS,
              "such as table = [[0, 0], [60, 10], [120, 20]]"),
    ), stage_by_table))))


# ---- follower and cam -----------------------------------------------------------------------------------------------


def _offset(item: SceneItem, names: SceneNames) -> Fraction | str | None:
    return SMALLEST if item.value == SMALLEST else item.number()


def _follower(row: TableRow) -> Follower | None:
    """The follower, which has just the lengths that its kind has."""
    moves, contact, values = row["moves"], row["contact"], row.values
    needed_keys = {"radius": contact == ROLLER, "arm": moves == OSCILLATING and contact != FLAT,
                   "centre_distance": moves == OSCILLATING}
    unused = f"it does not apply to a follower that is {moves} with a {contact} contact"
    for key, has in needed_keys.items():
        if has and key not in row.items:
            row.item.fault(f"{key} is missing", f"a length, such as {key} = 10")
        elif key in row.items and not has:
            row.items[key].fault(unused, "leave it out")
    if "offset" in row.items and (moves == OSCILLATING) != (contact == FLAT):
        row.items["offset"].fault(unused, "leave it out")
    none = Fraction(0)
    return Follower(moves, contact, values.get("radius", none), values.get("offset", none), values.get("arm", none),
                    values.get("centre_distance", none))


FOLLOWER = Table("the follower", (
    Field("moves", "along a straight path, or about a pivot", choice(TRANSLATING, OSCILLATING),
          'such as moves = "translating"'),
    Field("contact", "what touches the cam", choice(POINTED, ROLLER, FLAT), 'such as contact = "roller"'),
    Field("radius", "of the roller", DISTANCE),
    Field("offset", "of a point or roller that is translating: how far its path passes the cam's centre, positive on "
          'the side where the cam rises towards it; or "smallest", with both pressure angles, for the smallest cam; of '
          "a flat face that oscillates: how far its plane passes the pivot, towards the cam",
          Kind('number, or "smallest"', _offset, {"anyOf": [NUMBER.schema, {"const": SMALLEST}]})),
    Field("arm", "of a point or roller that oscillates: its distance from the pivot", DISTANCE),
    Field("centre_distance", "of a follower that oscillates: from the cam's centre to the pivot", DISTANCE),
), _follower)


def _base(item: SceneItem, names: SceneNames) -> Fraction | str | None:
    return str(item.value) if item.value in (PRESSURE, CONVEX) else item.positive("radius")


def _angle(item: SceneItem, names: SceneNames) -> Fraction | None:
    number = item.positive("angle")
    if number is not None and number >= 90:
        return item.fault(f"the angle {number_text(number)} is not below 90", "30 as a rule")
    return number


def _divisions(item: SceneItem, names: SceneNames) -> int | None:
    number = item.number()
    if number is not None and (number.denominator != 1 or not MIN_DIVISIONS <= number <= MAX_DIVISIONS):
        return item.fault(f"{number_text(number)} is not a number of divisions",
                          f"a whole number from {MIN_DIVISIONS} to {MAX_DIVISIONS}")
    return None if number is None else int(number)


def _wheel(row: TableRow) -> CamWheel | None:
    values = row.values
    if row["base"] == PRESSURE and "pressure_angle" not in values:
        row.item.fault("pressure_angle is missing", "such as pressure_angle = { rise = 30, return = 30 }")
    omega = float(values["omega"]) if "omega" in values else math.pi * float(values.get("rpm", 0)) / 30
    return CamWheel(TURNS[row["turns"]], omega, row["base"], values.get("pressure_angle"), row["least_radius"],
                    row["divisions"])


_DEGREES = Kind("degrees below 90", _angle, {"type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 90})
CAM = Table("the cam", (
    Field("turns", "which way it turns", choice(*TURNS), default="counter-clockwise"),
    Field("omega", "how fast, in rad/s", DISTANCE),
    Field("rpm", "the same in turns a minute", DISTANCE),
    Field("base", "the radius of the base circle, of a roller that on which its centre is lowest; or the smallest by "
          'the "pressure angle"; or for a flat face the smallest that keeps the profile "convex"',
          Kind(f'number above 0, "{PRESSURE}" or "{CONVEX}"', _base,
               {"anyOf": [DISTANCE.schema, {"enum": [PRESSURE, CONVEX]}]}),
          f'a radius, such as base = 30, or base = "{PRESSURE}"'),
    Field("pressure_angle", "the largest that are allowed", Table("the largest pressure angles", (
        Field("rise", "while the follower rises", _DEGREES, "such as rise = 30"),
        Field("return", "while it returns; without it a spring alone drives it back", _DEGREES),
    ), lambda row: Limits(row["rise"], row.values.get("return")))),
    Field("least_radius", "the smallest radius of curvature that the profile may have where it is convex", AMOUNT,
          default=0),
    Field("divisions", "in how many parts the turn is divided on the sheet",
          Kind("whole number", _divisions, {"type": "integer", "minimum": MIN_DIVISIONS, "maximum": MAX_DIVISIONS}),
          default=24),
), _wheel, either=("omega", "rpm"), remedy="one of them, such as rpm = 300")


LOAD = Table("what a follower on a straight path bears", (
    Field("force", "against the rise, in N", NUMBER, default=0),
    Field("mass", "of the follower, in kg", AMOUNT, default=0),
    Field("overhang", "from where the follower touches, at its lowest, to the nearer bearing of its guide", AMOUNT,
          "a length, such as overhang = 40"),
    Field("bearing", "from there to the further bearing", DISTANCE, "a length, such as bearing = 60"),
    Field("friction", "the coefficient of friction in the guide", AMOUNT, default=0),
    Field("stiffness", "of a spring that keeps contact, in N a length; the least for a preload unless it is given",
          AMOUNT),
    Field("preload", "its force where the follower is lowest, in N; the least that keeps contact unless it is given",
          AMOUNT),
), lambda row: FollowerLoad(**row.values))


TASK = task_table(
    "a cam: the law of its follower, the follower, and what is given of the cam", ("length",),
    Field("law", "the stages of one turn, in order", LAW, '[[law]] with angle = 120, motion = "sine", stroke = 25'),
    Field("follower", "the follower", FOLLOWER, '[follower] with moves = "translating" and contact = "roller"'),
    Field("cam", "the cam", CAM, "[cam] with rpm = 300 and base = 30"),
    Field("load", "forces, mass, guide and spring of a follower on a straight path", LOAD),
)


# ---- reading --------------------------------------------------------------------------------------------------------


def load(source: str) -> Task:
    """The task in a file or on standard input (`-`); fails with `SceneError`, one line a fault."""
    return parse(task_text(source, "cam"), source)


def parse(text: str, name: str) -> Task:
    """The task that a TOML text says; `name` stands in error lines."""
    def build_task(read: dict[str, Any], shared: dict[str, Any], faults: Faults) -> Task:
        task = Task(**shared, stages=read["law"], follower=read["follower"], cam=read["cam"], load=read.get("load"))
        check_task(task, faults)
        return task

    return read_task(TASK, text, name, build_task)


def check_task(task: Task, faults: Faults) -> None:
    """Note what does not fit together."""
    law, follower, cam = task.law, task.follower, task.cam
    turn, resting = law.turn_and_rest
    if turn != 360:
        faults.add("law", f"its stages take {number_text(turn)} degrees", "stages of 360 degrees together")
    if abs(resting) > LIFT_TOL * law.largest(0) / law.times:
        faults.add("law", f"after one turn the lift is {number_text(resting)}", "strokes that add up to 0")
    at, depth = law.extremum(lambda angles, one: -one.value_at(angles))
    if depth > LIFT_TOL * law.largest(0) / law.times:
        faults.add("law", f"the lift is {number_text(-depth)} at {number_text(at)} degrees, below where it begins",
                   "begin with the stage in which the follower is lowest")
    if not any(stage.stroke or stage.motion == TABLE for stage in task.stages):
        faults.add("law", "the follower does not move", "a stage with a stroke")
    if task.load and follower.oscillates:
        faults.add("load", "the follower oscillates", "a load of a follower on a straight path")
    elif task.load and task.load.overhang < law.largest(0):
        faults.add("load.overhang", "the follower rises into its guide", "an overhang of the stroke or more")
    check_fit(follower, cam, faults)


def check_fit(follower: Follower, cam: CamWheel, faults: Faults) -> None:
    """Note where cam and follower do not fit each other."""
    if cam.base == PRESSURE and follower.flat:
        faults.add("cam.base", "the pressure angle of a flat face does not depend on it", f'a radius, or "{CONVEX}"')
    if cam.base == CONVEX and not follower.flat:
        faults.add("cam.base", f"only a flat face needs a {CONVEX} profile", f'a radius, or "{PRESSURE}"')
    if follower.offset == SMALLEST and (cam.base != PRESSURE or cam.limits is None or cam.limits.back is None):
        faults.add("follower.offset", "the smallest cam is that of two pressure angles",
                   f'base = "{PRESSURE}" and pressure_angle = {{ rise = 30, return = 30 }}, or a length')
    past = follower.offset if isinstance(follower.offset, Fraction) and not follower.flat else Fraction(0)
    if isinstance(cam.base, Fraction) and abs(past) >= cam.base:
        faults.add("follower.offset", f"{number_text(past)} is no less than the base circle's radius "
                   f"{number_text(cam.base)}", "a smaller offset, or a larger base circle")
    if isinstance(cam.base, Fraction) and follower.contact == ROLLER and follower.radius >= cam.base:
        faults.add("follower.radius", f"{number_text(follower.radius)} is no less than the radius of the base "
                   f"circle, on which the roller's centre is lowest, {number_text(cam.base)}", "a smaller roller")
    if isinstance(cam.base, Fraction) and follower.oscillates and not follower.flat:
        low, high = abs(follower.distance - follower.arm), follower.distance + follower.arm
        if not low < cam.base < high:
            faults.add("cam.base", f"no triangle has the sides {number_text(follower.distance)}, "
                       f"{number_text(follower.arm)} and {number_text(cam.base)}",
                       f"a radius between {number_text(low)} and {number_text(high)}")
