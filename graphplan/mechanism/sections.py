"""Sections: the tables of a scene besides points, pairs and loads: links, units, motions, questions, the sheet."""

from __future__ import annotations

import re
from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations, permutations, product
from math import pi

from graphplan.errors import by_name
from graphplan.mechanism.fields import (
    AMOUNT,
    DISTANCE,
    FLAG,
    LINK,
    NAME,
    NUMBER,
    POINT,
    TEXT,
    VECTOR,
    Field,
    Kind,
    Named,
    SceneItem,
    SceneNames,
    Table,
    TableRow,
    choice,
    describe,
    name_list,
    suggestion,
)
from graphplan.mechanism.model import (
    FRAME,
    Contact,
    Drive,
    Find,
    Flywheel,
    Gear,
    LinkPoints,
    Motion,
    Number,
    Presentation,
    RunRequest,
    Slide,
    Units,
)
from graphplan.mechanism.numbers import number_text
from graphplan.mechanism.units import KILOGRAMS, METRES, NEWTONS, PAPERS
from graphplan.words import LANGUAGES

# --- links ---------------------------------------------------------------------------------------------------------


def _link(item: SceneItem, names: SceneNames) -> tuple[str, ...]:
    """The points of a link; empty for a faulty one."""
    named = item.points(names.points)
    if named == ():
        item.fault("a link without points", 'its points, such as "A B"')
    if not item.key.strip() or not item.key.isprintable():
        item.fault("a link without a readable name", 'a name, such as 1 = "A B"')
    return named or ()


LINKS = Named(Kind("points", _link, {"type": "string", "pattern": rf"^\s*{NAME}(\s+{NAME})*\s*$"}), LINK, least=1)


UNITS = Table("the units", (
    Field("length", "the unit of lengths", choice(*METRES), default="mm"),
    Field("force", "the unit of forces; moments are force * m", choice(*NEWTONS), default="N"),
    Field("mass", "the unit of masses; inertia is mass * m^2", choice(*KILOGRAMS), default="kg"),
), lambda row: Units(**row.values))


# --- motions and questions -----------------------------------------------------------------------------------------


def _check_motion(point: str, item: SceneItem, names: SceneNames) -> None:
    """A fault where a point cannot have a given motion."""
    if point not in names.points:
        item.faults.unknown(item.where, "point", point, names.points)
    elif point in names.links.get(FRAME, ()):
        item.fault(f"{point} is a point of the frame, which stands still", "a point of moving links only")
    elif point not in names.link_counts and item.faults.none_in("links"):
        item.fault(f"no link has the point {point}", "a point of a link")


MOTIONS = Named(Table("a motion", (
    Field("velocity", "its velocity, in length/s", VECTOR, "two components, such as velocity = [10, 5]"),
    Field("acceleration", "its acceleration, in length/s^2", VECTOR, default=[0, 0]),
), lambda row: Motion(**row.values)), POINT, _check_motion)


def _has_no_motion(point: object, item: SceneItem, names: SceneNames) -> bool:
    """Whether a point that is asked for has no motion, as no link has it; that is a fault."""
    lonely = point in names.points and point not in names.link_counts and item.faults.none_in("links")
    if lonely:
        item.fault(f"no link has the point {point}, so it has no motion", "a point of a link")
    return lonely


def _is_frame(name: object, item: SceneItem, names: SceneNames) -> bool:
    """Whether results of the frame are asked for; that is a fault."""
    if name == FRAME:
        item.fault("the frame stands still", "a moving link")
    return name == FRAME


def _slides(names: SceneNames) -> tuple[str, ...]:
    return tuple(pair.name for pair in names.pairs if isinstance(pair, Slide))


def _pairs(names: SceneNames) -> Iterator[str]:
    """The joints, the slides, the gears and the contacts."""
    yield from (p for p in names.points if names.link_counts[p] > 1)
    yield from dict.fromkeys(pair.name for pair in names.pairs if isinstance(pair, Slide | Gear | Contact))


def _links(names: SceneNames) -> tuple[str, ...]:
    """All links, the ground last, be it a link or not."""
    return (*sorted(names.moving, key=by_name), names.frame)


def _on_another(names: SceneNames) -> list[str]:
    """Each link with each other one, by name."""
    return [*map(" ".join, permutations(_links(names), 2))]


def _points_on_links(names: SceneNames) -> tuple[str, ...]:
    """The moving points on each of their links, such as M on 2."""
    return tuple(f"{point} on {link}" for link in _links(names)[:-1]
                 for point in sorted(names.links[link], key=by_name) if point in names.movable)


def _has_no_path(name: object, item: SceneItem, names: SceneNames) -> bool:
    """Whether a point on a link that is asked for has no path; that is a fault."""
    point, on, link = name.partition(" on ") if isinstance(name, str) else ("", "", "")
    if not on or point not in names.points or link not in names.bodies:
        return False
    if link == FRAME or point in names.links.get(FRAME, ()):
        item.fault(f"{point} is a point of the frame, which stands still", "a moving point of a link, such as M on 2")
    elif point not in names.links[link]:
        instead = "one of " + ", ".join(sorted(names.links[link], key=by_name))
        item.fault(f"{point} is not a point of link {link}", instead)
    else:
        return False
    return True


def _turning(names: SceneNames) -> tuple[str, ...]:
    """The links that can turn: no chain of slides ties them to the frame."""
    still, pairs = {FRAME}, [pair.links for pair in names.pairs if isinstance(pair, Slide) and pair.turns_alike]
    while more := {link for links in pairs if still & {*links} for link in links} - still:
        still |= more
    return tuple(link for link in _links(names) if link not in still)


_POINTS = name_list("point", '["A", "C"]', lambda names: names.points, lambda names: names.movable,
                    entry=POINT, wrong=_has_no_motion)
_TURNING = name_list("link", '["2"]', lambda names: names.moving, _turning, entry=LINK, after=("links", "slides"),
                     wrong=_is_frame)
FIND = Table("what is asked for", (
    Field("velocity", 'the points whose velocities are asked for, or "all"', _POINTS, default=[]),
    Field("acceleration", 'the points whose accelerations are asked for, or "all"', _POINTS, default=[]),
    Field("links", 'the links whose angular velocities and accelerations are asked for, or "all"; without it those '
          "of which two points are asked for",
          name_list("link", '["2", "3"]', lambda names: names.moving, entry=LINK, after=("links",), wrong=_is_frame)),
    Field("omega", 'the links whose angular velocities are asked for without their accelerations, or "all"',
          name_list("link", '["3"]', lambda names: names.moving, entry=LINK, after=("links",), wrong=_is_frame)),
    Field("slides", 'the slides (such as "3 along 2") whose velocities and accelerations are asked for, or "all"; '
          "without it those whose point is asked for",
          name_list("slide", '["3 along 2"]', _slides, after=("links", "slides"), wrong=_is_frame)),
    Field("poles", 'the pairs of links (such as "2 frame", of link 2 relative to the frame) whose instant centres are '
          'asked for, or "all"',
          name_list("pair of links", '["2 frame", "2 3"]',
                    _on_another, lambda names: tuple(map(" ".join, combinations(_links(names), 2))),
                    many="pairs of links", after=("links",)), default=[]),
    Field("reactions", 'the joints, slides (such as "3 along 2"), gears and contacts (such as "2 3") whose reactions '
          'are asked for, or "all"',
          name_list("joint, slide, gear or contact", '["A", "3 along 2"]', lambda names: [*_pairs(names)],
                    lambda names: None, many="joints, slides, gears and contacts",
                    after=("slides", "gears", "contacts", "links", "points"))),
    Field("curvature", 'the points on links (such as "M on 2") the centres of curvature of whose paths are asked for, '
          'or "all"',
          name_list("point on a link", '["M on 2"]', _points_on_links, many="points on links",
                    after=("links", "points"),
                    wrong=_has_no_path), default=[]),
    Field("inflection", 'the links whose inflection circles are asked for, or "all"',
          _TURNING, default=[]),
    Field("acceleration_centres", 'the links whose points without acceleration are asked for, or "all"',
          _TURNING, default=[]),
), lambda row: Find(**row.values))


# --- the machine over its cycle ------------------------------------------------------------------------------------


def _speed(row: TableRow) -> Number | None:
    """The speed of the first drive that a table gives, in rad/s or turns a minute; None if not given."""
    first = next((pair for pair in row.names.pairs if isinstance(pair, Drive)), None)
    if "rpm" not in row.items or first is None:
        return row.values.get("speed")
    if first.slides:
        return row.items["rpm"].fault("the first drive slides", "speed, in length/s")
    return float(row["rpm"] / 30 * Fraction(pi))


def _flywheel(row: TableRow) -> Flywheel | None:
    uneven = row.values.get("unevenness")
    if uneven is not None and not 0 < uneven < 2:
        return row.items["unevenness"].fault(f"an unevenness of {number_text(uneven)}", "more than 0 and less than 2")
    if ("unevenness" in row.items) == ("inertia" in row.items):
        return row.item.fault("unevenness and inertia are both given" if uneven is not None else
                              "unevenness is missing", "unevenness, or inertia where the unevenness is asked for")
    speed = _speed(row)
    if speed is None:
        return None
    if speed <= 0:
        return row.item.fault(f"a mean speed of {number_text(speed)}", "a speed above 0; its drive tells the sense")
    return Flywheel(speed, uneven, row.values.get("inertia"), row["closes"])


FLYWHEEL = Table("a flywheel", (
    Field("speed", "the mean speed of the first drive, in rad/s (in length/s where it slides)", NUMBER),
    Field("rpm", "the same in turns a minute, instead of speed", NUMBER),
    Field("unevenness", "(omega_max - omega_min) / mean, the mean being half their sum", NUMBER),
    Field("inertia", "of a flywheel that is given, in mass * m^2, where the unevenness is asked for", AMOUNT),
    Field("closes", "what closes the cycle: a constant moment on the drive, or a constant factor of the loads that "
          "change", choice("drive", "load"), default="drive"),
), _flywheel, either=("speed", "rpm"), remedy="either speed in rad/s or rpm")


def _run(row: TableRow) -> RunRequest | None:
    if "speed" in row.items and "rpm" in row.items:
        return row.item.fault("speed and rpm are both given", "either speed in rad/s or rpm")
    if row.values.get("travel") == 0:
        return row.items["travel"].fault("the travel is 0", "degrees or lengths, such as travel = 720")
    return RunRequest(_speed(row), row.values.get("travel"), row["stops"])


RUN = Table("a run", (
    Field("speed", "the first drive's speed at its beginning, in rad/s (in length/s where it slides); without it that "
          "of the drive", NUMBER),
    Field("rpm", "the same in turns a minute, instead of speed", NUMBER),
    Field("travel", "how far it is followed, in degrees of the first drive (in lengths where it slides); without it "
          "one turn", NUMBER),
    Field("stops", "true: followed until the machine comes to rest", FLAG, default=False),
), _run)


# --- the sheet: the paper, the frame and the title block that a scene wishes, and its scales -------------------------


FRAMES = ("iso", "gost")
MOTION_PLANS = ("orthogonal", "polar", "triangles")
FORCE_PLANS = ("lever", "polygons", "both")
PLAN_STYLES = (*MOTION_PLANS, *FORCE_PLANS)
METHODS = {"auxiliary": "auxiliary point", "trial": "trial figure", "poles": ""}  # with the form that each prefers
METHOD_PAIRS = tuple(map(",".join, product(METHODS, repeat=2)))  # of velocities, of accelerations
CRANK = "crank"  # the scale of velocities that are as long as the crank
OF_PATHS = {"euler-savary": "Euler-Savary", "bobillier": "Bobillier", "hartmann": "Hartmann", "accelerations": ""}
BESIDE_PLANS, NO_WORDS = "aside", "none"
PROTOCOLS = ("auto", BESIDE_PLANS, "pages", NO_WORDS)  # where the words stand: beside plans, on pages, nowhere
PLANS = ("N-plan", "velocity plan", "acceleration plan", "lever")  # and force plans, by their links
INERTIA = ("couple", "shifted", "points", "percussion", "static")
FORCE_ORDERS = ("polygons", "moments")  # what is drawn first of unknown forces
FORCE_WAY = f"^({'|'.join(FORCE_ORDERS)}) ([0-9])$"
PREFERENCES = ("quick", "accurate", "balanced")
MAX_POSITIONS = 72  # positions that are drawn
MAX_ROUNDS = 50  # of friction that are drawn, each in force plans of its own
LENGTH = r"(?=[0.]*[1-9])(\d{1,9}(?:\.\d{1,9})?)"  # above zero
RATIO = rf"\s*{LENGTH}\s*:\s*{LENGTH}\s*"


def _line(item: SceneItem, names: SceneNames) -> str | None:
    text = item.text("a text", "a text in quotes")
    if text is not None and not text.replace("\N{NO-BREAK SPACE}", " ").isprintable():
        item.fault("a text with line breaks or characters that cannot be printed", "a text on one line")
    return text


def _ratio(item: SceneItem, names: SceneNames) -> Fraction | None:
    """The scene's lengths in a millimetre of paper, from a ratio such as 1:2."""
    ratio = re.fullmatch(RATIO, item.value) if isinstance(item.value, str) else None
    if ratio is None:
        return item.fault(f"{describe(item.value)} is not a ratio",
                          'a length on paper to a length of the scene, such as "1:2"')
    return Fraction(ratio[2]) / Fraction(ratio[1]) / 1000 / METRES[names.units.length]


def _plan(name: str, item: SceneItem, names: SceneNames) -> None:
    """A fault where there is no such plan; only the drawing tells which force plans there are."""
    if name not in PLANS and not name.startswith(("force plan ", "lever ")):
        item.fault("unknown plan", suggestion(name, (*PLANS, "force plan 2, 3"), "plan"))


def _plan_styles(item: SceneItem, names: SceneNames) -> str | None:
    """Read the styles of plans: one word for the motion, one for the forces, or both with a comma between them."""
    text = _line(item, names)
    for word in text.split(",") if text else ():
        if word not in PLAN_STYLES:
            return item.fault(f"{word or text}: unknown plan", suggestion(word, PLAN_STYLES, "plan"))
    return text


def _stands_still(point: object, item: SceneItem, names: SceneNames) -> bool:
    """Add a fault if a point whose path is asked for stands still; return whether it does."""
    still = point in names.points and point not in names.movable
    if still:
        item.fault(f"{point} does not move", "a point of moving links only")
    return still


def _up_to(most: int, what: str) -> Kind:
    """A whole number from 1 to the most that there may be."""
    def read(item: SceneItem, names: SceneNames) -> int | None:
        number = item.number()
        if number is None:
            return None
        if number.denominator != 1 or not 1 <= number <= most:
            return item.fault(f"{number_text(number)} is not a number of {what}", f"a whole number from 1 to {most}")
        return int(number)

    return Kind("whole number", read, {"type": "integer", "minimum": 1, "maximum": most})


def _presentation(row: TableRow) -> Presentation | None:
    """The sheet that the scene asks for; all plans are drawn in lengths of the mechanism plan, so k_a is k_v^2/k_s."""
    values = {key: row[key] for key in row.items}
    if "scale" in values:
        if "k_s" in values:
            row.items["scale"].fault("k_s and scale are both given", "give one of the two")
        values["k_s"] = values.pop("scale")
    for key, field in (("kappa", "time_scale"), ("phi", "force_scale")):
        if key in values:
            values[field] = values.pop(key)
    if values.get("k_v") == CRANK:
        del values["k_v"]
        if "kappa" in row.items:
            row.items["k_v"].fault("kappa and k_v are both given", "give one of the two")
        rates = [pair.rate for pair in row.names.pairs if isinstance(pair, Drive) and not pair.slides and pair.rate]
        values |= {"time_scale": abs(1 / Fraction(rates[0])) if rates else None, "by_crank": True}
    k_s, k_v, k_a = (values.get(key) for key in ("k_s", "k_v", "k_a"))
    if k_s and k_v and k_a and number_text(k_a) != number_text(k_v**2 / k_s):
        problem = f"{number_text(k_a)} does not fit k_s and k_v"
        row.items["k_a"].fault(problem, f"k_v^2/k_s, which is {number_text(k_v**2 / k_s)}")
    sheet = Presentation(**{key: value for key, value in values.items() if value})
    for key, given, tied, by in (("kappa", sheet.time_scale, sheet.kappa, "k_s, k_v and k_a"),
                                 ("phi", sheet.force_scale, sheet.phi, "k_s and k_F")):
        if given is not None and tied is not None and given != tied:
            row.items[key].fault(f"{number_text(given)} does not fit {by}", f"{number_text(tied)}, or leave it out")
    return sheet


def _whole_numbers(item: SceneItem, names: SceneNames) -> tuple[int, ...] | None:
    """Whole numbers from 0."""
    numbers = item.value if isinstance(item.value, list) else [None]
    if any(type(number) is not int or number < 0 for number in numbers):
        return item.fault(f"{describe(item.value)} where whole numbers are wanted", "numbers from 0, such as [0, 1]")
    return tuple(numbers)


def _force_way(item: SceneItem, names: SceneNames) -> tuple[str, int] | None:
    """Read the order in which unknown forces are found, and the place where a trial begins."""
    way = re.fullmatch(FORCE_WAY, item.value) if isinstance(item.value, str) else None
    if way is None:
        return item.fault(f"{describe(item.value)} is no way of drawing forces", 'such as "polygons 0" or "moments 1"')
    return way[1], int(way[2])


def _auxiliary(item: SceneItem, names: SceneNames) -> dict[str, tuple[LinkPoints, ...]]:
    """The auxiliary points by their letters: of which links they are points, and which two of its points have the loci.
    """
    letters, found = item.table() or {}, {}
    for letter, entry in letters.items():
        if letter in names.points or not re.fullmatch(NAME, letter):
            entry.fault(f"{letter} is a point of the scene" if letter in names.points else "not a letter",
                        "another letter, such as Q")
        text = entry.text("a text", 'two bars by their ends, such as "LA BT"')
        if text is None or not item.faults.none_in("links", "points"):
            continue
        bars = [_bar_ends(word, {*names.points}, {*letters}) for word in text.split()]
        if len(bars) != 2 or not all(bars):
            entry.fault(f"{describe(text)} is not two bars", 'two bars by their ends, such as "LA BT"')
        elif held := tuple(LinkPoints(link, (A, B)) for link in names.moving for A, B in product(*bars)
                           if A != B and {A, B} <= {*names.links[link]}
                           and not any(len(bar) == 2 and {*bar} <= {*names.links[link]} for bar in bars)):
            found[letter] = held
        else:
            entry.fault(f"{text}: no moving link is held by both", "two bars that hold one link")
    return found


def _bar_ends(word: str, points: set[str], letters: set[str]) -> tuple[str, ...]:
    """The points of the scene in the name of a bar, such as LA, or CQ where Q is an auxiliary point; none of others."""
    for cut in range(1, len(word)):
        ends = word[:cut], word[cut:]
        if {*ends} <= points | letters and {*ends} & points:
            return tuple(end for end in ends if end in points)
    return ()


def _speed_scale(item: SceneItem, names: SceneNames) -> Number | str | None:
    """A speed for a mm of paper; or the word for such a scale that a crank is as long as its velocities."""
    if item.value != CRANK:
        return item.positive("scale")
    turning = [pair.rate for pair in names.pairs if isinstance(pair, Drive) and not pair.slides]
    if not any(turning) and item.faults.none_in("drive"):
        return item.fault("no drive turns a crank", "a speed for a mm of paper, such as k_v = 50")
    return CRANK


def _above_0(what: str) -> Kind:
    return Kind(DISTANCE.says, lambda item, names: item.positive(what), DISTANCE.schema)


_TEXT, _SCALE = Kind("text", _line, TEXT.schema), _above_0("scale")
SHEET = Table("the sheet", (
    Field("paper", "the sheet; without it the smallest that will do", choice(*PAPERS)),
    Field("frame", "frame and title block after ISO 5457 and ISO 7200, or after GOST 2.301 and GOST 2.104",
          choice(*FRAMES), default="iso"),
    Field("language", "the language of all words on the sheet", choice(*LANGUAGES), default="en"),
    Field("plan", "orthogonal velocities on the mechanism plan, polar plans, or triangles; of forces the lever, "
          'polygons or both; such as "polar" or "polar,lever"',
          Kind("text", _plan_styles, {"type": "string", "pattern": "^(WAYS)(,(WAYS))?$".replace(
              "WAYS", "|".join(PLAN_STYLES))})),
    Field("method", "the form of loci and rings, or of centres of curvature, as --method; a pair such as "
          "auxiliary,trial is that of velocities and that of accelerations; without it the pose chooses",
          choice(*METHODS, *METHOD_PAIRS, *OF_PATHS)),
    Field("auxiliary", "the auxiliary points, each with the two bars in whose lines it lies, such as { Q = \"LA BT\", "
          "R = \"FD SE\" }; the loci of the two links that the bars hold close in their common joint",
          Kind("two bars, by letter", _auxiliary, {"type": "object", "additionalProperties": {
              "type": "string", "pattern": rf"^\s*{NAME}\s+{NAME}\s*$"}})),
    Field("inertia", "inertia forces: at the centre of mass with a couple, shifted so that they need none, at two "
          "points, at the centre of percussion, or at two pins with a couple", choice(*INERTIA), default="couple"),
    Field("rounds", "how many rounds of the friction iteration are drawn; without it until the forces no longer change",
          _up_to(MAX_ROUNDS, "rounds")),
    Field("strict", "true: compasses and straightedge alone, no set squares", FLAG, default=False),
    Field("prefer", "weigh all forms: the fewest operations, the smallest pencil error, or both", choice(*PREFERENCES)),
    Field("pencil", "how far off the pencil is, as standard deviations: mm of paper, angle in degrees",
          _TEXT),
    Field("protocol", "where the words stand: aside, in columns beside the plans; on pages of their own, as without a "
          "word; or nowhere", choice(*PROTOCOLS), default="auto"),
    Field("task", "the teacher's own words, which stand at the head of the task", _TEXT),
    Field("convention", "scales as real per drawn (k_v, mm/s per mm) or drawn per real (mu_v, mm per mm/s)",
          choice("real", "drawn"), default="real"),
    Field("owner", "the legal owner, for the title block", _TEXT),
    Field("number", "the identification number", _TEXT),
    Field("date", "the date of issue", _TEXT),
    Field("drawn_by", "who drew it", _TEXT, default="graphplan"),
    Field("approved_by", "who approved it", _TEXT),
    Field("scale", "the scale of the mechanism plan, a ratio of paper to scene",
          Kind("ratio", _ratio, {"type": "string", "pattern": f"^{RATIO}$"})),
    Field("k_s", "the same as lengths of the scene for a mm of paper", _SCALE),
    Field("k_v", "the speed, in length/s, for a mm of paper; or crank: the velocities of the first crank are drawn as "
          "long as its points are from its pivot", Kind(f"{DISTANCE.says}, or {CRANK}", _speed_scale, {
              "anyOf": [DISTANCE.schema, {"const": CRANK}]})),
    Field("k_a", "the acceleration, in length/s^2, for a mm of paper", _SCALE),
    Field("k_F", "the force for a mm of paper", _SCALE),
    Field("kappa", "how many lengths of the scene a speed of one is drawn, in s; without it as is in proportion, or "
          "costs least", _SCALE),
    Field("phi", "how many lengths of the scene a force of one is drawn", _SCALE),
    Field("ways", "which of several ways on is taken at each ring of links, counted from 0; draw --design tells them",
          Kind("whole numbers", _whole_numbers, {"type": "array", "items": {"type": "integer", "minimum": 0}})),
    Field("force_way", "what is drawn first in force plans, polygons or moments, and where a trial begins, counted "
          'from 0; such as "moments 1"', Kind("text", _force_way, {"type": "string", "pattern": FORCE_WAY})),
    Field("multiples", "how many times as large as by these scales other plans are drawn, by their names",
          Named(_above_0("multiple"), TEXT, _plan)),
    Field("curves", 'the points whose paths over the motion are drawn on the mechanism plan, or "all"',
          name_list("point", '["M"]', lambda names: names.points, lambda names: names.movable,
                    after=("points", "links"),
                    entry=POINT, wrong=_stands_still)),
    Field("centrodes", "of which links, each with the link that it moves on, the fixed and the moving centrodes are "
          'drawn there; or "all", those of all links on the frame',
          name_list("pair of links", '["2 frame"]', _on_another,
                    lambda names: tuple(f"{link} {names.frame}" for link in names.moving), many="pairs of links",
                    after=("links",))),
    Field("cubics", "the links of which the points that keep the curvature of their paths are drawn there and their "
          'centres: the cubic of stationary curvature of this pose; or "all"',
          name_list("link", '["2"]', lambda names: names.moving, after=("links",), entry=LINK)),
    Field("positions", "how many positions of the mechanism are drawn there in faint lines, at equal travels",
          _up_to(MAX_POSITIONS, "positions")),
), _presentation)
