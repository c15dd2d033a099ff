"""Tasks of `graphplan synthesize`: TOML files, each with one table that says what is to be found.

The words of each key stand with the key, as in scenes; faults are one line each. Numbers become floats: angles are in
degrees, and a construction with given angles has no fractions.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from graphplan.mechanism.fields import DISTANCE, FLAG, TEXT, Faults, Field, Kind, SceneItem, SceneNames, Table, TableRow
from graphplan.mechanism.numbers import number_text
from graphplan.mechanism.scene_text import VARY, Choices
from graphplan.mechanism.tasks import SheetTask, read_task, task_table, task_text
from graphplan.synthesis.requests import (
    LENGTH,
    MAX_ENTRIES,
    PLACE,
    REAL,
    CirclePointChoice,
    ConjugateTask,
    FunctionTask,
    GearTask,
    GenevaTask,
    GuidanceTask,
    PathTask,
    StrokeTask,
    list_of,
    numbers,
    rows_of_numbers,
    whole_number,
)


@dataclass(frozen=True)
class SynthesisTask(SheetTask):
    """The keys of a task: `kind` is its table, `request` the content of that.

    `text` is the task as it was written, `vary` are its numbers that differ from student to student; `centres_by` names
    the three of more points by which a centre of that letter is drawn.
    """

    kind: str
    request: Any
    text: str = ""
    vary: Choices = field(default_factory=dict, repr=False)
    centres_by: Mapping[str, Sequence[int]] = field(default_factory=dict)


CHOICE = Table("a point of the circle-point curve", (
    Field("u", "its place along the axis of the plane", REAL, "such as u = 2"),
    Field("root", "which real z there, counted from 1 upwards", whole_number(1, 3), "such as root = 1"),
), lambda row: CirclePointChoice(row["u"], row["root"]))


def _moving_point(item: SceneItem, names: SceneNames) -> Any:
    """A point of the moving plane, by two numbers or by u and root."""
    return (CHOICE if isinstance(item.value, dict) else PLACE).read(item, names)


MOVING = list_of(Kind("point", _moving_point, {}), 1, 2, "points",
                 "[[1, 0.5], [4, -2]], or { u = 0, root = 1 } for each")

# ---- guidance and function ------------------------------------------------------------------------------------------


POSITIONS = rows_of_numbers(3, 2, 5, "positions", "[[0, 0, 90], [5.6, 6.4, 0]]: origin and angle of the axis")
TWO_POINTS = rows_of_numbers(2, 2, 2, "points", "two points such as [[0, 0], [9, -2]]")


def check_keys(row: TableRow, needed: Mapping[str, str], unused: Iterable[str], of: str) -> None:
    """Note the keys that are missing, with what would be right, and those that do not apply to it."""
    for key, such in needed.items():
        if key not in row.items:
            row.item.fault(f"{key} is missing", such)
    for key in unused:
        if key in row.items:
            row.items[key].fault(f"it does not apply to {of}", "leave it out")


def _guidance(row: TableRow) -> GuidanceTask | None:
    """Read a guidance task; the chosen points must suit the number of positions."""
    count, items = len(row["positions"]), row.items
    needed_keys = {2: ("moving", "turns"), 3: (), 4: (), 5: ()}[count]
    unused_keys = {2: ("fixed", "table"), 3: ("turns", "table"), 4: ("fixed", "turns"),
                   5: ("moving", "fixed", "turns", "table")}[count]
    such = {"moving": "moving = [[1, 0.5], [4, -2]]", "turns": "turns = [50, -40], of OA and CB"}
    check_keys(row, {key: such[key] for key in needed_keys}, unused_keys, f"{count} positions")
    for k, (x, y, angle) in enumerate(row["positions"]):
        if any((x, y) == (u, v) and (angle - other) % 360 == 0 for u, v, other in row["positions"][:k]):
            items["positions"].fault(f"position {k + 1} is one that stands before it", "different positions")
    if count == 3 and ("moving" in items) == ("fixed" in items):
        row.item.fault("moving and fixed are both given" if "moving" in items else "moving is missing",
                       "moving = [[1, 0.5], [4, -2]], or fixed")
    if count == 4 and not {"moving", "table"} & items.keys():
        row.item.fault("moving is missing", "moving = [{ u = 0, root = 1 }, { u = 2, root = 1 }], or table = [0, 1, 2]")
    if "moving" in items and "moving" not in unused_keys:
        _check_moving(row, count)
    for turn in row.values.get("turns", ()):
        if not 0 < abs(turn) < 360:
            items["turns"].fault(f"a turn of {number_text(turn)} degrees", "angles other than 0, between -360 and 360")
    return GuidanceTask(**row.values)


def _check_moving(row: TableRow, count: int) -> None:
    """Note points that are not of the form that so many positions ask for."""
    for k, point in enumerate(row["moving"], 1):
        if isinstance(point, CirclePointChoice) != (count == 4):
            such = "{ u = 0, root = 1 }" if count == 4 else "two numbers such as [1, 0.5]"
            row.item.faults.add(f"{row.items['moving'].where}.{k}", f"not a point as {count} positions have it", such)
    if len(row["moving"]) != 2 or row["moving"][0] == row["moving"][1]:
        row.items["moving"].fault("A and B are wanted, two different points", "two points such as [[1, 0.5], [4, -2]]")


def _ratio_above_1(item: SceneItem, names: SceneNames) -> float | None:
    number = item.number()
    if number is not None and number < 1:
        return item.fault(f"a ratio of {number_text(number)}", "1 or more: the longer time over the shorter")
    return None if number is None else float(number)


RATIO = Kind("number from 1", _ratio_above_1, {"type": "number", "minimum": 1})
GUIDANCE = Table("positions of a plane through which a linkage guides it", (
    Field("positions", "two to five of them: x and y of the origin, and the angle of the axis", POSITIONS,
          "positions = [[0, 0, 90], [5.6, 6.4, 0]]"),
    Field("moving", "A and B in the moving plane: u along the axis and z across it; of four positions { u, root }",
          MOVING),
    Field("fixed", "of three positions: O and C in the fixed plane", TWO_POINTS),
    Field("turns", "of two positions: the angles through which OA and CB turn",
          numbers(2, 2, "two angles such as [50, -40]")),
    Field("table", "of four positions: further u at which circle points are listed",
          numbers(1, MAX_ENTRIES, "[0, 1.5, 2]")),
    Field("driver", "a crank that swings OA from the first to the last position and back, by its time ratio",
          Table("a driving crank", (Field("ratio", "the time to the last position over that back", RATIO,
                                          "such as ratio = 1.2"),), lambda row: row["ratio"])),
), _guidance)

ANGLES = numbers(2, 5, "two to five angles such as [40, 70, 115]")
ROCKER = Table("a rocker", (
    Field("pivot", "its pivot C", PLACE, "such as pivot = [1, 0]"),
    Field("angles", "of a line of it, one for each angle of the crank", ANGLES, "such as angles = [82.3, 91.9]"),
))
SLIDE = Table("a slide", (
    Field("through", "a point of the guide", PLACE, "such as through = [0, -0.3]"),
    Field("direction", "its direction", PLACE, "such as direction = [1, 0]"),
    Field("at", "where the slider is, from that point along the direction, one for each angle of the crank", ANGLES,
          "such as at = [3.37, 2.84]"),
))


def _function(row: TableRow) -> FunctionTask | None:
    """Rocker or slide with as many entries as the input; a crank or a moving point just where it is wanted."""
    items, count, by_rocker = row.items, len(row["input"]), "rocker" in row.items
    name, key = ("rocker", "angles") if by_rocker else ("slide", "at")
    if len(row[name][key]) != count:
        row.item.faults.add(f"{items[name].where}.{key}", f"{len(row[name][key])} for {count} angles of the crank",
                            f"{count} of them")
    if not by_rocker and row[name]["direction"] == (0, 0):
        row.item.faults.add(f"{items[name].where}.direction", "it has no length", "a direction such as [1, 0]")
    if by_rocker and row[name]["pivot"] == row["pivot"]:
        row.item.faults.add(f"{items[name].where}.pivot", "it is the crank's pivot", "another point")
    if len({angle % 360 for angle in row["input"]}) < count:
        items["input"].fault("the crank is at one angle twice", "different angles")
    if not by_rocker and count > 3:
        items["input"].fault(f"{count} pairs with a slide", "2 or 3 pairs")
    keys = {"crank": "crank = 0.4", "moving": "moving = [{ u = 0.3, root = 1 }]"}
    needed = [key for key, wanted in zip(keys, (count < 4, count == 4), strict=True) if by_rocker and wanted]
    check_keys(row, {key: keys[key] for key in needed}, keys.keys() - needed, f"{count} pairs with a {name}")
    if "moving" in needed and not isinstance((row.values.get("moving") or (CirclePointChoice(0, 1),))[0],
                                                CirclePointChoice):
        items["moving"].fault("not a point of the circle-point curve", "moving = [{ u = 0.3, root = 1 }]")
    return FunctionTask(**row.values)


FUNCTION = Table("angles of a crank and of a rocker, or places of a slide, that belong together", (
    Field("pivot", "the crank's pivot O", PLACE, "pivot = [0, 0]"),
    Field("input", "angles of a line of the crank, two to five", ANGLES, "input = [40, 70, 115]"),
    Field("rocker", "the rocker that is driven", ROCKER),
    Field("slide", "or the slide that is driven", SLIDE),
    Field("crank", "of 2 or 3 pairs with a rocker: the length OA; A lies on the input line", LENGTH),
    Field("moving", "of 4 pairs: A in the crank's plane; of 5 it follows", MOVING),
    Field("compare", "inputs and the outputs that are wanted there: gives the structural error",
          rows_of_numbers(2, 1, MAX_ENTRIES, "pairs", "[[40, 82.3], [41, 82.5]]")),
), _function, either=("rocker", "slide"), remedy="rocker = { pivot = [1, 0], angles = [82.3, 91.9] }, or slide")

# ---- stroke ---------------------------------------------------------------------------------------------------------


def _ground(item: SceneItem, names: SceneNames) -> float | str | None:
    return BEST if item.value == BEST else LENGTH.read(item, names)


BEST = "best"
SIZES_OF_CRANK = "offset", "crank", "rod"


def _stroke(row: TableRow) -> StrokeTask | None:
    """Check that exactly one mechanism is given, with the values that it needs."""
    items, values = row.items, row.values
    angle = values["angle"] if "angle" in values else 180 * (values["ratio"] - 1) / (values["ratio"] + 1)
    if not 0 <= angle < 180:
        return items["angle"].fault(f"an angle of {number_text(angle)} degrees", "one from 0 to 180, 180 excluded")
    if sum(key in items for key in ("stroke", "rocker", "lever")) != 1:
        return row.item.fault("one of stroke, rocker and lever is wanted", "stroke = 100 of a slider-crank, "
                              "rocker = { length = 80, swing = 60 }, or lever = { ground = 200 }")
    sizes = [key for key in SIZES_OF_CRANK if key in items]
    if "stroke" in items and len(sizes) != 1:
        row.item.fault("one of offset, crank and rod is wanted", "such as offset = 30")
    check_keys(row, {}, () if "stroke" in items else sizes, "rockers and levers")
    if ("ground" in items) != ("rocker" in items):
        row.item.fault("ground is missing" if "rocker" in items else "ground without a rocker",
                       'ground = 150, or ground = "best"' if "rocker" in items else "leave it out")
    if "rocker" in items and not values["rocker"]["swing"] < 180:
        row.item.faults.add(f"{items['rocker'].where}.swing", number_text(values["rocker"]["swing"]), "less than 180")
    if "lever" in items and angle == 0:
        row.item.fault("a slotted lever that does not swing", "a ratio above 1")
    given = (sizes[0], values[sizes[0]]) if sizes else ("", 0.0)
    return StrokeTask(angle, values.get("stroke"), given, values.get("rocker"), values.get("ground"),
                      values.get("lever"))


STROKE = Table("the time ratio of a stroke, and what makes it", (
    Field("ratio", "the time of the longer stroke over that of the shorter: (180 + angle)/(180 - angle)", RATIO),
    Field("angle", "or the angle between the dead positions, in degrees", REAL),
    Field("stroke", "of a slider-crank, with offset, crank or rod", LENGTH),
    Field("offset", "how far the guide passes O, positive on the right of its direction", REAL),
    Field("crank", "the length OA", LENGTH),
    Field("rod", "the length AB", LENGTH),
    Field("rocker", "of a crank-rocker", Table("a rocker", (
        Field("length", "CB", LENGTH, "such as length = 80"),
        Field("swing", "in degrees", LENGTH, "such as swing = 60")))),
    Field("ground", 'OC of a crank-rocker, or "best", of the largest least transmission angle',
          Kind('number above 0, or "best"', _ground, {"anyOf": [DISTANCE.schema, {"const": BEST}]})),
    Field("lever", "of a swinging slotted lever", Table("a slotted lever", (
        Field("ground", "OC", LENGTH, "such as ground = 200"),), lambda row: row["ground"])),
), _stroke, either=("ratio", "angle"), remedy="one of them, such as ratio = 1.2")

# ---- paths ----------------------------------------------------------------------------------------------------------


def _path(row: TableRow) -> PathTask | None:
    """The point names its link; a dwell has a range, and a pivot unless it is straight."""
    point, on, link = row["point"].partition(" on ")
    if not on:
        row.items["point"].fault(f'the string "{row["point"]}"', 'a point on a link, such as "M on 2"')
    values, straight = row.values, row.values.get("straight", False)
    if "from" in values and values["from"] == values["to"]:
        row.items["to"].fault("the range has no length", "another travel than that of from")
    if "from" in values and ("pivot" in values) == straight:
        row.item.fault("pivot with a straight path" if straight else "pivot is missing",
                       "leave it out" if straight else "the pivot E of the output, such as pivot = [4, -1]")
    span = (values["from"], values["to"]) if "from" in values else (0.0, 0.0)
    return PathTask(row["scene"], point, link, span, values.get("pivot"), straight)


POINT_OF_SCENE = (
    Field("scene", "a scene file, by its place from the task's, or a packaged scene", TEXT, 'scene = "four-bar.toml"'),
    Field("point", "the point whose path it is, with its link", TEXT, 'point = "M on 2"'),
)
COGNATES = Table("a path that other linkages are to draw", POINT_OF_SCENE, _path)
DWELL = Table("a stretch of a path that is nearly an arc, or straight", (
    *POINT_OF_SCENE,
    Field("from", "the travel of the drive at which it begins", REAL, "from = 160"),
    Field("to", "and at which it ends", REAL, "to = 220"),
    Field("pivot", "of the output that dwells", PLACE),
    Field("straight", "whether the stretch is to be straight", FLAG, default=False),
), _path)

# ---- wheels and profiles --------------------------------------------------------------------------------------------


GENEVA = Table("a Geneva wheel", (
    Field("slots", "from 3 to 15", whole_number(3, 15), "slots = 6"),
    Field("centres", "the distance of both centres", LENGTH, "centres = 100"),
), lambda row: GenevaTask(row["slots"], row["centres"]))


def _profile(row: TableRow) -> dict[str, Any] | None:
    """A circle, a line or a point."""
    values = row.values
    if ("circle" in values) != ("radius" in values):
        return row.item.fault("a circle has a centre and a radius", "{ circle = [70, 0], radius = 8 }")
    if "line" in values and values["line"][0] == values["line"][1]:
        return row.items["line"].fault("both points of the line are one", "two different points")
    return values if sum(key in values for key in ("circle", "line", "point")) == 1 else row.item.fault(
        "one of circle, line and point is wanted", "such as { circle = [70, 0], radius = 8 }")


def _conjugate(row: TableRow) -> ConjugateTask | None:
    """Read a task of conjugate profiles; the motion of body 2 is given once, and over the whole range."""
    values, span = row.values, (row["from"], row["to"])
    if not span[0] < span[1]:
        row.items["to"].fault(f"{number_text(span[1])} is not above from", "a larger angle")
    translating = values.get("translating", False)
    if not translating and "centres" not in values:
        row.item.fault("centres is missing", "centres = 100")
    if "law" in values:
        angles = [phi for phi, _ in values["law"]]
        if sorted(set(angles)) != angles:
            row.items["law"].fault("its angles do not rise", "increasing phi")
        elif not (angles[0] <= min(span[0], 0.0) and max(span[1], 0.0) <= angles[-1]):
            row.items["law"].fault(f"it goes from {number_text(angles[0])} to {number_text(angles[-1])}",
                                   "rows that cover 0 and the range")
        if translating:
            row.items["law"].fault("a law of what translates", "ratio, the shift for each radian")
    if values.get("ratio") == 1 and not translating:
        row.items["ratio"].fault("both bodies turn alike, so that there is no pole", "another ratio than 1")
    return ConjugateTask(values.get("centres", 0.0), row["profile"], span, values.get("ratio", 0.0),
                         values.get("law", ()), translating)


CONJUGATE = Table("the profile of body 1 that the given one of body 2 asks for", (
    Field("centres", "O1 is [0, 0], O2 lies so far along x; not of a body 2 that translates", LENGTH),
    Field("ratio", "omega 2 / omega 1; of a body 2 that translates its shift along +y for each radian", REAL),
    Field("law", "or pairs of angles phi and psi, between which a spline runs",
          rows_of_numbers(2, 2, MAX_ENTRIES, "pairs", "[[0, 0], [60, -20]]")),
    Field("translating", "whether body 2 shifts along +y and does not turn", FLAG, default=False),
    Field("profile", "of body 2 at phi = 0", Table("a profile", (
        Field("circle", "its centre", PLACE),
        Field("radius", "of the circle", LENGTH),
        Field("line", "two points of it", TWO_POINTS),
        Field("point", "the point itself", PLACE)), _profile), "profile = { circle = [70, 0], radius = 8 }"),
    Field("from", "the first angle phi of body 1, in degrees", REAL, "from = -60"),
    Field("to", "and the last", REAL, "to = 60"),
), _conjugate, either=("ratio", "law"), remedy="one of them, such as ratio = -0.5")


MIN_TEETH, MAX_TEETH = 4, 1000
LEAST_SHIFT = "least"


def _shift(item: SceneItem, names: SceneNames) -> tuple[float, ...] | str | None:
    return LEAST_SHIFT if item.value == LEAST_SHIFT else numbers(2, 2, '[0, 0], or "least"').read(item, names)


def _gear(row: TableRow) -> GearTask | None:
    """A ring has more teeth than the wheel in it; the rack is inclined."""
    teeth = row["teeth"]
    if row["internal"] and teeth[1] <= teeth[0]:
        row.items["teeth"].fault(f"a ring of {teeth[1]} teeth about a wheel of {teeth[0]}", "more teeth of the ring")
    if not 0 < row["pressure_angle"] < 45:
        row.items["pressure_angle"].fault(number_text(row["pressure_angle"]), "an angle between 0 and 45, 20 as a rule")
    return GearTask(**row.values)


GEAR = Table("two involute wheels, cut by the rack", (
    Field("module", "their module", LENGTH, "module = 5"),
    Field("teeth", "of both", list_of(whole_number(MIN_TEETH, MAX_TEETH), 2, 2, "numbers of teeth",
                                      "two whole numbers such as [17, 30]"), "teeth = [17, 30]"),
    Field("internal", "whether the second is a ring", FLAG, default=False),
    Field("pressure_angle", "of the rack, in degrees", REAL, default=20),
    Field("shift", 'of the rack for each wheel, in modules; or "least", of no undercut and not negative',
          Kind('two numbers, or "least"', _shift, {"anyOf": [{"type": "array"}, {"const": LEAST_SHIFT}]}),
          default=[0, 0]),
    Field("addendum", "in modules", LENGTH, default=1),
    Field("clearance", "in modules", LENGTH, default=Fraction(1, 4)),
), _gear)

# ---- reading --------------------------------------------------------------------------------------------------------


KINDS = {"guidance": GUIDANCE, "function": FUNCTION, "stroke": STROKE, "cognates": COGNATES, "dwell": DWELL,
         "geneva": GENEVA, "conjugate": CONJUGATE, "gear": GEAR}
TASK = task_table("a mechanism that is to be found, by one of these tables", ("length",),
                  *(Field(kind, table.says, table) for kind, table in KINDS.items()),
                  Field("vary", "numbers that differ from student to student, by their paths, such as stroke.ratio or "
                        "guidance.positions.1.0, for graphplan variants", VARY))


def load(source: str) -> SynthesisTask:
    """The task in a file or on standard input (`-`); fails with `SceneError`, one line a fault."""
    return parse(task_text(source, "synthesize"), source)


def parse(text: str, name: str) -> SynthesisTask:
    """The task that a TOML text says; `name` stands in error lines."""
    def build_task(read: dict[str, Any], shared: dict[str, Any], faults: Faults) -> SynthesisTask | None:
        kinds = [kind for kind in KINDS if kind in read]
        if len(kinds) != 1:
            what = f"{' and '.join(kinds)} are all asked for" if kinds else "nothing is asked for"
            faults.add("file", what, f"one of the tables {', '.join(KINDS)}")
            return None
        return SynthesisTask(**shared, kind=kinds[0], request=read[kinds[0]], text=text, vary=read.get("vary") or {})

    task = read_task(TASK, text, name, build_task)
    assert task is not None
    return task
