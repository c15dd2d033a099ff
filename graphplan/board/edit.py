"""Edits of a scene's text by the mouse: comments, order and layout of what is not edited stay.

A scene says by itself which lengths are kept: a point that is placed by a distance keeps it while others are dragged.
So a length that is typed at a link is written as the placement of one of its ends, and a dragged point moves by what
its placement leaves free: its coordinates, its angle, its place on a line, or, of a point where two arcs meet, the
angles of the points that it depends on.
"""

from __future__ import annotations

import math
import string
from collections import Counter
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, MutableMapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial
from itertools import combinations
from operator import eq
from typing import Any, cast

import tomlkit
from tomlkit.container import Container
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT, Comment, Item, Key, Table

from graphplan.errors import Refused
from graphplan.mechanism.fields import Misfit, quote_key
from graphplan.mechanism.model import FRAME, Placement, Scene
from graphplan.mechanism.numbers import FLOAT_RECKONING
from graphplan.mechanism.placements import needs, placed_by
from graphplan.mechanism.scene import incomplete_scene
from graphplan.mechanism.scene_text import path_parts, value_at
from graphplan.mechanism.slips import names_in

Place = Sequence[float]
OMEGA = 10  # rad/s of a drive until it is changed
ANGLE_DECIMALS, LENGTH_DECIMALS = 4, 6  # of numbers that a drag writes: finer than a pixel
STANDING_DECIMALS = 10  # of numbers that are to leave a point where it is, such as in line with two others
MAX_ROUNDS = 25  # of the search for the pose in which a dragged point is near the mouse
STEP = 1.0  # degrees: the largest turn in a round is a good ten of them
ROWS = "slides", "drive", "forces", "moments", "balance", "gears", "contacts", "springs", "friction"  # lists of tables
TEXT_KEYS = {"title", "source", "task", "language", "file"}  # whose values name no objects


@dataclass
class SceneEditor:
    """The text of a scene while it is edited: its tables, as tomlkit keeps them."""

    text: str
    name: str

    def __post_init__(self) -> None:
        try:
            self.tables = tomlkit.parse(self.text)
        except TOMLKitError as error:
            raise Refused("scene", f"its text cannot be edited by the mouse: {error}", "mend the text first") from None

    def edited_text(self) -> str:
        """The text with all edits."""
        return tomlkit.dumps(self.tables)

    @property
    def scene(self) -> Scene:
        """The scene as it stands, as far as it can be read."""
        return incomplete_scene(self.edited_text() or "[points]\n", self.name)

    # ---- tables ------------------------------------------------------------------------------------------------------

    def table(self, key: str) -> Any:
        """A table of the scene, which is made where there is none."""
        if key not in self.tables:
            self.tables[key] = tomlkit.table()
        table = self.tables[key]
        if not isinstance(table, MutableMapping):
            raise Refused(key, "it is no table", f"[{key}]")
        return table

    def rows(self, key: str) -> list[Any]:
        """The tables of a list, as they are."""
        rows = self.tables.get(key, [])
        return [row for row in rows if isinstance(row, MutableMapping)] if isinstance(rows, list) else [rows]

    def add_row(self, key: str, values: Mapping[str, Any]) -> None:
        """Append a table to a list of tables."""
        rows = self.tables.get(key)
        row = tomlkit.table() if rows is None or isinstance(rows, AoT) else tomlkit.inline_table()
        row.update(values)
        if rows is None:
            if self.tables:
                self.tables.add(tomlkit.nl())
            self.tables[key] = tomlkit.aot()
        elif not isinstance(rows, list):
            raise Refused(key, "it is no list of tables", f"[[{key}]]")
        elif isinstance(rows, AoT) and rows:
            next_comment = take_comment(rows[-1])
            (row if rows[-1].as_string().endswith("\n\n") else rows[-1]).add(tomlkit.nl())
            row.value.body.extend(next_comment)
        self.tables[key].append(row)

    def remove_row(self, key: str, place: int) -> None:
        """Remove a table of a list, and the list with its last one."""
        rows = self.tables.get(key)
        if not isinstance(rows, list):
            self.remove_key(self.tables, key)
        elif 0 <= place < len(rows):
            self.remove_key(rows, place)
            if not rows:
                del self.tables[key]
            self._count_varied_rows_anew(key, place)

    def _count_varied_rows_anew(self, key: str, removed: int) -> None:
        """Let the paths of [vary] lead to the same tables of a list after one of them is removed."""
        places = dict[str, int]()
        for path in self.tables.get("vary", {}):
            list_key, *more = path_parts(path)
            if list_key == key and more and more[0].isdecimal():
                places[path] = int(more[0])
        for path in sorted(places, key=places.__getitem__):
            if places[path] == removed:
                _erase_key(self, "vary", path)
            elif places[path] > removed:
                new_path = ".".join(map(quote_key, [key, f"{places[path] - 1}", *path_parts(path)[2:]]))
                _rename_key(self.tables["vary"], path, new_path, ("vary",))

    def remove_key(self, holder: Any, key: str | int) -> None:
        """Remove a key, or a table with the comment right above it; the comment above the next one stays."""
        headers, removed = [*tables_with_headers(self.tables)], holder[key]
        place = next((place for place, table in enumerate(headers) if table is removed), None)
        if place is not None:
            next_comment = take_comment(removed)
            if place:
                take_comment(headers[place - 1])
                headers[place - 1].value.body.extend(next_comment)
            elif headers[1:]:
                headers[1].trivia.indent = "".join(item.as_string() for _, item in next_comment)
        del holder[key]

    def remove_rows(self, key: str, is_meant: Callable[[Any], bool]) -> None:
        """Remove the tables of a list for which it is so."""
        for place in reversed(range(len(rows := self.rows(key)))):
            if is_meant(rows[place]):
                self.remove_row(key, place)

    # ---- points and links --------------------------------------------------------------------------------------------

    @property
    def frame(self) -> str:
        """The name of the fixed link."""
        return str(self.tables.get("frame", FRAME))

    def links(self) -> dict[str, list[str]]:
        """The points of each link, as they are written."""
        return {str(name): points_in(value) for name, value in self.table("links").items()}

    def links_at(self, point: str) -> list[str]:
        """The moving links that have a point."""
        return [name for name, points in self.links().items() if point in points and name != self.frame]

    def write_link(self, name: str, points: Iterable[str]) -> None:
        """Write the points of a link; without any it goes."""
        links, text = self.table("links"), " ".join(points)
        if not text:
            links.pop(name, None)
        elif isinstance(links.get(name), list):
            links[name] = text.split()
        else:
            write_key(links, name, text)

    def require_point(self, name: str) -> None:
        """Fail with `Refused` if the scene has no such point."""
        if name not in self.table("points"):
            raise Refused(f"point {name}", "there is no such point", "a point of the scene")

    def require_link(self, name: str) -> None:
        """Fails with `Refused` where there is no such link."""
        if name not in self.table("links"):
            raise Refused(f"link {name}", "there is no such link", "a link of the scene")

    @cached_property
    def floats(self) -> dict[str, complex]:
        """Where the points are before the edit."""
        return {name: complex(float(x), float(y)) for name, (x, y) in self.scene.points.items()}


def tables_with_headers(container: Container) -> Iterator[Table]:
    """The tables with a header of their own, in the order of the text."""
    for key, item in container.body:
        if isinstance(item, AoT):
            for row in item.body:
                yield row
                yield from tables_with_headers(row.value)
        elif isinstance(item, Table) and key is not None and not key.is_dotted():
            if not item.is_super_table():
                yield item
            yield from tables_with_headers(item.value)


def take_comment(table: Any) -> list[tuple[Key | None, Item]]:
    """Take off the comment at the end of a table, which is about the next one, whose header it stands above."""
    body, comment = table.value.body if isinstance(table, Table) else [], list[tuple[Key | None, Item]]()
    while body and isinstance(body[-1][1], Comment):
        comment.insert(0, body.pop())
    return comment


def write_key(table: Any, key: str, value: Any) -> None:
    """Write a value; a new key stands above the comment that is about the next table."""
    next_comment = take_comment(table)
    table[key] = value
    if next_comment:
        table.value.body.extend(next_comment)


def points_in(value: Any) -> list[str]:
    """The names in a list of points, which is a text or a list."""
    return str(value).split() if isinstance(value, str) else [str(name) for name in value] if isinstance(
        value, list) else []


def number(value: float, decimals: int | None = None) -> int | float:
    """A number as it is written: whole where it is; as it was typed where no count of decimals is named."""
    rounded = float(value) if decimals is None or not math.isfinite(value) else round(float(value), decimals)
    if not math.isfinite(rounded):
        raise Refused(f"{value}", "not a number", "a number such as 12.5")
    return int(rounded) if rounded == int(rounded) else rounded


def pair(place: Place, decimals: int | None = None) -> Any:
    """Two numbers as a list in one line."""
    x, y = place
    return tomlkit.item([number(x, decimals), number(y, decimals)])


# ---- what is drawn ---------------------------------------------------------------------------------------------------


def add_point(editor: SceneEditor, at: Place) -> str:
    """Add a point under the next letter, and return its name."""
    points = editor.table("points")
    name = next(name for name in point_names() if name not in points)
    write_key(points, name, pair(at))
    return name


def point_names() -> Iterator[str]:
    """The names of points in order: A to Z, then with numbers."""
    yield from string.ascii_uppercase
    count = 1
    while True:
        yield from (f"{letter}{count}" for letter in string.ascii_uppercase)
        count += 1


def add_link(editor: SceneEditor, points: Sequence[str]) -> str:
    """Add a link of these points under the next number, and return its name."""
    for point in points:
        editor.require_point(point)
    links = editor.links()
    name = next(f"{count}" for count in range(1, len(links) + 2) if f"{count}" not in links)
    editor.write_link(name, dict.fromkeys(points))
    return name


def fix_point(editor: SceneEditor, point: str, fixed: bool = True) -> str:
    """Make a point one of the frame, or not one any more."""
    editor.require_point(point)
    points = editor.links().get(editor.frame, [])
    editor.write_link(editor.frame, [*points, point] if fixed and point not in points else
                      points if fixed else [name for name in points if name != point])
    return point


def add_slide(editor: SceneEditor, point: str, along: str = "", direction: Any = None) -> str:
    """Add a sliding pair at a point: along the frame in a direction, or along a link on the line of two of its points.

    The sliding link is that of the point which has the fewest joints. Where the frame guides the only link there, which
    is held by another joint, so that it would be stuck, a block is made that turns on it.
    """
    editor.require_point(point)
    along = along or editor.frame
    sliding = sliding_link(editor, point, along)
    if along != editor.frame:
        editor.require_link(along)
        direction = guide_direction(editor, point, along)
    if isinstance(direction, complex):
        direction = direction.real, direction.imag
    heading = direction if isinstance(direction, str) else pair(direction or (1, 0))
    if not isinstance(heading, str) and heading[0] == 0 == heading[1]:
        raise Refused("slide", "its direction has no length", "a second place apart from the point")
    editor.add_row("slides", {"link": sliding, "along": along, "at": point, "direction": heading})
    return sliding


def sliding_link(editor: SceneEditor, point: str, along: str) -> str:
    """The link that slides at a point; a new block where none can."""
    links = editor.links()
    taken = _slides(editor)
    choices = [link for link in editor.links_at(point) if link != along and (link, along) not in taken]
    joints = {link: sum(other != link and bool({*links[link]} & {*points}) for other, points in links.items())
              for link in choices}
    other_joints = {link: sum(sum(name in points for points in links.values()) > 1
                              for name in links[link] if name != point) for link in choices}
    best = min(choices, key=lambda link: (other_joints[link], joints[link], -[*links].index(link)), default=None)
    if best is None or (along == editor.frame and other_joints[best]):
        return add_link(editor, [point])
    return best


def guide_direction(editor: SceneEditor, point: str, along: str) -> str | complex:
    """Two points of the guiding link whose line passes nearest to the point, as a direction; of a link without such
    across its own slide."""
    at, links = editor.floats, editor.links()
    points = [name for name in links[along] if name in at and name != point]
    lines = [ends for ends in combinations(points, 2) if at[ends[0]] != at[ends[1]]]
    if lines and point in at:
        nearest: tuple[str, str] = min(lines, key=lambda ends: _offset(at[point], at[ends[0]], at[ends[1]]))
        return " ".join(nearest)
    for slide in editor.scene.slides:
        if slide.link == along:
            x, y = map(float, slide.direction)
            return complex(-y, x)
    raise Refused(f"link {along}", "it has no two points that give a direction", "a link of two points or more")


def _offset(point: complex, first: complex, second: complex) -> float:
    """The distance of a point from the line of two others."""
    along = second - first
    return abs(((point - first) / along).imag) * abs(along)


def add_drive(editor: SceneEditor, link: str) -> str:
    """Drive a link relative to the frame; once."""
    editor.require_link(link)
    if link == editor.frame:
        raise Refused(f"link {link}", "the frame is not driven", "a moving link")
    if all(str(row.get("link")) != link for row in editor.rows("drive")):
        editor.add_row("drive", {"link": link, "omega": OMEGA})
        _balance_loads(editor)
    return link


def ask(editor: SceneEditor, point: str, wanted: bool = True) -> str:
    """Ask for the velocity and the acceleration of a point, or not any more."""
    editor.require_point(point)
    find = editor.table("find")
    for key in ("velocity", "acceleration"):
        names = find.get(key, [])
        if names == "all":
            continue
        if isinstance(names, str):
            names = [names]
        if wanted and point not in names:
            write_key(find, key, names)
            find[key].append(point)
        elif not wanted and point in names:
            names.remove(point)
            if not names:
                del find[key]
    if not find:
        editor.remove_key(editor.tables, "find")
    return point


def add_load(editor: SceneEditor, point: str, value: Place) -> str:
    """Put a force on a point, and have the first drive's link balance it where nothing does."""
    editor.require_point(point)
    links = editor.links_at(point)
    if not links:
        raise Refused(f"point {point}", "no moving link has this point", "a point of a link")
    if not any(value):
        raise Refused("force", "it has no size", "a release apart from the point")
    editor.add_row("forces", {"on": links[0], "at": point, "value": pair(value)})
    _balance_loads(editor)
    return point


def set_mass(editor: SceneEditor, link: str, mass: float) -> str:
    """Give a link a mass, at the middle of its points where it has no centre yet; without mass it has none."""
    editor.require_link(link)
    if not mass > 0:
        _erase_key(editor, "masses", link)
        _drop_balance(editor)
        return link
    masses = editor.table("masses")
    if link in masses:
        masses[link]["mass"] = number(mass)
        return link
    places = [editor.floats[point] for point in editor.links()[link] if point in editor.floats]
    if not places:
        raise Refused(f"link {link}", "it has no point", "a link with points")
    middle = sum(places) / len(places)
    centre = next((point for point in editor.links()[link] if editor.floats.get(point) == middle), "")
    if not centre:
        centre = add_point(editor, (middle.real, middle.imag))
        editor.write_link(link, [*editor.links()[link], centre])
    entry = tomlkit.inline_table()
    entry.update({"mass": number(mass), "centre": centre})
    write_key(masses, link, entry)
    _balance_loads(editor)
    return link


def _balance_loads(editor: SceneEditor) -> None:
    drives = [row for row in editor.rows("drive") if "link" in row]
    if {"forces", "masses"} & {*editor.tables} and "balance" not in editor.tables and len(drives) == 1:
        editor.table("balance")["link"] = str(drives[0]["link"])


def _drop_balance(editor: SceneEditor) -> None:
    """Erase the balance where no load is left."""
    if not {"forces", "moments", "masses", "springs", "gravity"} & {*editor.tables}:
        editor.remove_rows("balance", lambda row: True)


# ---- what is moved ---------------------------------------------------------------------------------------------------


def move_point(editor: SceneEditor, point: str, to: Place) -> str:
    """Move a point to a place, or as near as the lengths that are kept let it."""
    editor.require_point(point)
    scene, entry = editor.scene, editor.table("points")[point]
    placement, goal = scene.placements.get(point), complex(*map(float, to))
    if placement is None or placement.how == "given":
        _write_coordinates(editor, point, to)
        return point
    places = point_places(scene.placements)
    if placement.how == "polar":
        entry["angle"] = number(math.degrees(_phase(goal - places[str(placement.data["from"])])), ANGLE_DECIMALS)
    elif placement.how == "on-line":
        first, second = (places[name] for name in needs(placement)[:2])
        if first != second:
            along = ((goal - first) / (second - first)).real * abs(second - first)
            entry["distance"] = number(along, LENGTH_DECIMALS)
    else:
        for name, value in pose_towards(scene.placements, point, goal).items():
            editor.table("points")[name]["angle"] = number(value, ANGLE_DECIMALS)
    return point


def _write_coordinates(editor: SceneEditor, point: str, to: Place) -> None:
    entry = editor.table("points")[point]
    if isinstance(entry, list) and len(entry) == 2:
        entry[0], entry[1] = number(to[0]), number(to[1])
    else:
        editor.table("points")[point] = pair(to)


def _phase(vector: complex) -> float:
    return math.atan2(vector.imag, vector.real)


def point_places(placements: Mapping[str, Placement]) -> dict[str, complex]:
    """Where the points are by their placements."""
    return {name: complex(float(x), float(y)) for name, (x, y) in placed_by(placements, FLOAT_RECKONING).items()}


def pose_towards(placements: Mapping[str, Placement], point: str, goal: complex) -> dict[str, float]:
    """The angles of the points that a point depends on, by their names, with which it comes nearest to a place.

    By Gauss and Newton with damped steps; lengths and fixed points stay. A step that no assembly follows is halved.
    """
    needed = _ancestors(placements, point)
    angles = [name for name in needed if placements[name].how == "polar"]
    if not angles:
        return {}

    def with_angles(values: Mapping[str, float]) -> Mapping[str, Placement]:
        return {**placements, **{name: replace(placements[name], data={
            **placements[name].data, "angle": Fraction(value).limit_denominator(10**9)})
            for name, value in values.items()}}

    def place(values: Mapping[str, float]) -> complex | None:
        try:
            return point_places(with_angles(values))[point]
        except Misfit:
            return None

    values = {name: float(cast("Fraction", placements[name].data["angle"])) for name in angles}
    now, turn = place(values), 10 * STEP
    for _ in range(MAX_ROUNDS):
        if now is None or turn < STEP / 1000:
            break
        slopes = {name: ((place({**values, name: values[name] + STEP / 100}) or now) - now) / (STEP / 100)
                  for name in angles}
        square = sum(abs(slope) ** 2 for slope in slopes.values())
        if not square:
            break
        gap = goal - now
        steps = {name: (slope.conjugate() * gap).real / square for name, slope in slopes.items()}
        longest = max(map(abs, steps.values())) or 1.0
        share = min(1.0, turn / longest)
        tried = {name: values[name] + share * steps[name] for name in angles}
        next_place = place(tried)
        if next_place is not None and abs(goal - next_place) < abs(gap):
            values, now = tried, next_place
        else:
            turn = min(turn, longest) / 2
    return values


def _ancestors(placements: Mapping[str, Placement], point: str) -> list[str]:
    """The points that a point depends on, nearest first."""
    names, waiting = list[str](), [point]
    while waiting:
        for name in needs(placements[waiting.pop(0)]):
            if name not in names and name in placements:
                names.append(name)
                waiting.append(name)
    return names


# ---- what is typed ---------------------------------------------------------------------------------------------------


def set_length(editor: SceneEditor, ends: Sequence[str], length: float) -> str:
    """Give the distance of two points of a link, and keep it: one of the two is placed by it from then on."""
    a, b = ends
    if not length > 0:
        raise Refused(f"length {a} {b}", f"{length:g}", "a length above 0")
    placements = editor.scene.placements
    for point, partner in ((b, a), (a, b)):
        if partner in _locks(placements[point]):
            return _write_length(editor, point, partner, length)
    fixed = {*editor.links().get(editor.frame, ())}
    choices = sorted(((b, a), (a, b)), key=lambda ends: (ends[0] in fixed, len(_locks(placements[ends[0]]))))
    for point, partner in choices:
        if point in (*_ancestors(placements, partner), partner) or len(_locks(placements[point])) > 1:
            continue
        if placements[point].how in ("given", "polar"):
            _lock(editor, point, partner, length)
            return point
    raise Refused(f"length {a} {b}", "both points are placed by other lengths already", "free one of these lengths")


def _locks(placement: Placement) -> dict[str, Any]:
    """The distances that place a point, by the points from which they are."""
    if placement.how == "polar":
        return {str(placement.data["from"]): placement.data["distance"]}
    return dict(cast("dict[str, Any]", placement.data.get("distances", {})))


def _write_length(editor: SceneEditor, point: str, other: str, length: float) -> str:
    entry = editor.table("points")[point]
    if "distances" in entry:
        entry["distances"][other] = number(length)
    else:
        entry["distance"] = number(length)
    return point


def _lock(editor: SceneEditor, point: str, other: str, length: float) -> None:
    """Place a point by its distance from another, besides one that it may have already."""
    at, placement = editor.floats, editor.scene.placements[point]
    entry = tomlkit.inline_table()
    if placement.how == "polar":
        first, kept = next(iter(_locks(placement).items()))
        turned = ((at[point] - at[first]) * (at[other] - at[first]).conjugate()).imag
        distances = tomlkit.inline_table()
        distances.update({first: number(float(kept)), other: number(length)})
        entry.update({"distances": distances, "side": "left" if turned >= 0 else "right"})
    else:
        angle = number(math.degrees(_phase(at[point] - at[other])), STANDING_DECIMALS)
        entry.update({"from": other, "distance": number(length), "angle": angle})
    editor.table("points")[point] = entry


def set_angle(editor: SceneEditor, ends: Sequence[str], angle: float) -> str:
    """Turn the second of two points about the first to an angle from +x, in degrees; its distance is kept."""
    first, second = ends
    placement, at = editor.scene.placements[second], editor.floats
    entry = editor.table("points")[second]
    if placement.how == "polar" and placement.data["from"] == first:
        entry["angle"] = number(angle)
    elif placement.how == "given":
        turned, distance = tomlkit.inline_table(), number(abs(at[second] - at[first]), STANDING_DECIMALS)
        turned.update({"from": first, "distance": distance, "angle": number(angle)})
        editor.table("points")[second] = turned
    else:
        raise Refused(f"angle {first} {second}", f"{second} is placed by other lengths", "free these lengths")
    return second


def free_point(editor: SceneEditor, point: str) -> str:
    """Place a point by its coordinates where it is: no length is kept by it any more."""
    editor.require_point(point)
    if point in editor.floats:
        place = editor.floats[point]
        editor.table("points")[point] = pair((place.real, place.imag), STANDING_DECIMALS)
    return point


def set_value(editor: SceneEditor, path: Sequence[str | int], value: Any) -> str:
    """Write a value at a path of keys and places; None removes it."""
    *above, key = path
    holder: Any = editor.tables
    for step in above:
        if isinstance(holder, list) and isinstance(step, int) and 0 <= step < len(holder):
            holder = holder[step]
        elif isinstance(holder, MutableMapping):
            if step not in holder:
                holder[step] = tomlkit.table()
            holder = holder[step]
        else:
            raise Refused(".".join(map(str, path)), "nothing stands there", "a value of the scene")
    if isinstance(holder, list) and not (isinstance(key, int) and 0 <= key < len(holder)):
        raise Refused(".".join(map(str, path)), "nothing stands there", "a value of the scene")
    if value is None:
        holder.pop(key, None)
    else:
        value = number(value) if isinstance(value, float) else value
        write_key(holder, key, value)
    return str(key)


# ---- what is erased, and changed -------------------------------------------------------------------------------------


def erase(editor: SceneEditor, kind: str, name: str | int) -> str:
    """Erase an object with what cannot be without it."""
    lists = {"slide": "slides", "drive": "drive", "force": "forces", "gear": "gears", "contact": "contacts",
             "moment": "moments", "spring": "springs"}
    slides = _slides(editor)
    if kind == "point":
        _erase_point(editor, str(name))
    elif kind == "link":
        _erase_link(editor, str(name))
    elif kind == "ask":
        ask(editor, str(name), wanted=False)
    elif kind in lists:
        editor.remove_row(lists[kind], int(name))
    _forget_slides(editor, slides - _slides(editor))
    _forget_joints(editor)
    _drop_balance(editor)
    return ""


def _erase_point(editor: SceneEditor, point: str) -> None:
    """Erase a point; what is placed by it stays where it is, links of it alone go."""
    for name, placement in editor.scene.placements.items():
        if point in needs(placement) and name != point:
            free_point(editor, name)
    for link, points in editor.links().items():
        if points == [point] and link != editor.frame:
            _erase_link(editor, link)
        elif point in points:
            editor.write_link(link, [name for name in points if name != point])
    _erase_key(editor, "points", point)
    _forget(editor, point)


def _erase_link(editor: SceneEditor, link: str) -> None:
    """Erase a link with its slides, drives and loads."""
    _erase_key(editor, "links", link)
    _forget(editor, link)


def _forget(editor: SceneEditor, name: str) -> None:
    """Erase all that names a point or a link which is gone, but points and links."""
    for table in ROWS:
        editor.remove_rows(table, lambda row: name in _words(row))
    for table in ("motion", "masses"):
        _erase_key(editor, table, name)
    for link, mass in [*editor.tables.get("masses", {}).items()]:
        if name in _words(mass):
            _erase_key(editor, "masses", link)
    for key in [*editor.tables.get("tolerances", {})]:
        if name in key.split():
            _erase_key(editor, "tolerances", key)
    for table in ("find", "sheet"):
        for key in [*editor.tables.get(table, {})]:
            _remove_entries(editor, table, key, lambda entry: name in _words(entry))


def _slides(editor: SceneEditor) -> set[tuple[str, str]]:
    """The links of each slide."""
    return {(str(row.get("link")), str(row.get("along"))) for row in editor.rows("slides")}


def _forget_slides(editor: SceneEditor, gone: set[tuple[str, str]]) -> None:
    """Erase what names slides that are gone."""
    for link, along in gone:
        name, links = f"{link} along {along}", [link, along]
        for table in ROWS:
            editor.remove_rows(table, partial(_names_slide, name=name, links=links))
        _remove_entries(editor, "find", "slides", partial(eq, name))


def _forget_joints(editor: SceneEditor) -> None:
    """Ask no more for the reactions in points that join no two links."""
    links_at = Counter(point for points in editor.links().values() for point in points)
    _remove_entries(editor, "find", "reactions",
                    lambda name: name in editor.tables.get("points", {}) and links_at[name] < 2)


def _remove_entries(editor: SceneEditor, table: str, key: str, is_meant: Callable[[Any], bool]) -> None:
    """Remove those entries of a list under a key for which it is so, and the key with its last one."""
    entries = value_at(editor.tables, (table, key))
    places = [place for place, entry in enumerate(entries) if is_meant(entry)] if isinstance(entries, list) else []
    if places and len(places) == len(entries):
        _erase_key(editor, table, key)
    else:
        for place in reversed(places):
            del entries[place]


def _names_slide(row: Any, name: str, links: list[str]) -> bool:
    """Whether a table of a list names a slide."""
    return f" {name} " in f" {' '.join(_words(row))} " or row.get("slide") == links


def _erase_key(editor: SceneEditor, table: str, key: str) -> None:
    """Erase a key of a table, and the table with its last one."""
    keys = editor.tables.get(table)
    if isinstance(keys, MutableMapping) and key in keys:
        editor.remove_key(keys, key)
        if not keys and table not in ("points", "links"):
            editor.remove_key(editor.tables, table)


def _words(value: Any) -> list[str]:
    """The words of all texts in a value."""
    if isinstance(value, str):
        return str(value).split()
    if isinstance(value, Mapping):
        return [word for entry in value.values() for word in _words(entry)]
    return [word for entry in value for word in _words(entry)] if isinstance(value, list) else []


def rename(editor: SceneEditor, kind: str, old: str, new: str) -> str:
    """Give a point or a link another name, wherever it is named."""
    table = editor.table("points" if kind == "point" else "links")
    if not new or new.split() != [new] or "," in new or not new.isprintable():
        raise Refused(f"{kind} {new!r}", "a name is empty or has blanks or commas", "a name without them, such as A2")
    if new in table:
        raise Refused(f"{kind} {new}", "the name is taken", "another name")
    if old not in table:
        raise Refused(f"{kind} {old}", "there is no such name", f"a {kind} of the scene")
    if kind == "link" and old == editor.frame:
        editor.tables["frame"] = new
    if kind == "point":
        _rename_in_bars(editor.tables.get("sheet", {}).get("auxiliary", {}), [*table], old, new)
    _rename_within(editor.tables, kind, old, new, ())
    return new


def _rename_in_bars(auxiliary: MutableMapping[str, Any], points: Collection[str], old: str, new: str) -> None:
    """Rename a point in the bars that give auxiliary points, such as "LA BT": names without blanks between them."""
    for letter, bars in auxiliary.items():
        if isinstance(bars, str):
            ends = [names_in(bar, points) or [bar] for bar in bars.split()]
            auxiliary[letter] = " ".join("".join(new if name == old else name for name in names) for names in ends)


def _rename_within(table: MutableMapping[str, Any], kind: str, old: str, new: str, above: tuple[str, ...]) -> None:
    """Rename in a table: keys that are names, and words of texts."""
    other = "links" if kind == "point" else "points"
    for key in [*table]:
        value = table[key]
        path = (*above, str(key))
        if key in TEXT_KEYS or (path[0] == other and kind == "link"):
            continue
        if isinstance(value, MutableMapping):
            _rename_within(value, kind, old, new, path)
        elif isinstance(value, str):
            if (changed := _with_word(value, old, new)) != value and not (kind == "link" and path[0] == "links"):
                table[key] = changed
        elif isinstance(value, list):
            for place, entry in enumerate(value):
                if isinstance(entry, MutableMapping):
                    _rename_within(entry, kind, old, new, path)
                elif isinstance(entry, str) and (changed := _with_word(entry, old, new)) != entry:
                    value[place] = changed
    for key in [*table]:
        if (new_key := _new_key(str(key), kind, old, new, above)) != key:
            _rename_key(table, key, new_key, above)


def _with_word(text: str, old: str, new: str) -> str:
    words = text.split()
    return " ".join(new if word == old else word for word in words) if old in words else text


def _new_key(key: str, kind: str, old: str, new: str, above: tuple[str, ...]) -> str:
    """A key of a table after the change: it may be a name, words of names, or a path."""
    table = f"{kind}s"
    if above[:1] == ("tolerances",):
        return _with_word(key, old, new)
    if above[:1] == ("vary",):
        first, *more = path_parts(key)
        return ".".join(map(quote_key, [first, new, *more[1:]])) if first == table and more[:1] == [old] else key
    named = above[:1] in (("points",), ("motion",)) if kind == "point" else above in (("links",), ("masses",))
    return new if named and key == old else key


def _rename_key(table: MutableMapping[str, Any], old: str, new: str, above: tuple[str, ...]) -> None:
    """Rename a key, in its place where tomlkit lets it."""
    value = table[old]
    if isinstance(value, Table):
        value.display_name = ".".join(tomlkit.key(name).as_string() for name in (*above, new))
    container = getattr(table, "value", None)
    if isinstance(container, Container):
        container._replace(old, new, value)
        dict.__setitem__(container, new, getattr(value, "value", value))  # tomlkit leaves this out
    else:
        del table[old]
        table[new] = value


OPERATIONS: Mapping[str, Callable[..., str]] = {
    "point": add_point, "link": add_link, "fix": fix_point, "slide": add_slide, "drive": add_drive, "ask": ask,
    "load": add_load, "mass": set_mass, "move": move_point, "length": set_length, "angle": set_angle,
    "free": free_point, "value": set_value, "erase": erase, "rename": rename}


def apply_operations(text: str, name: str, operations: Sequence[Mapping[str, Any]]) -> tuple[str, list[str]]:
    """The text after these operations, each with its name under `do`, and what each made or changed.

    Fails with `Refused` where one cannot be done.
    """
    names = []
    for values in operations:
        editor = SceneEditor(text, name)
        varied = _varied_paths(editor)
        names.append(OPERATIONS[values["do"]](editor, **{key: value for key, value in values.items() if key != "do"}))
        for path in varied - _varied_paths(editor):
            _erase_key(editor, "vary", path)
        text = editor.edited_text()
    return text, names


def _varied_paths(editor: SceneEditor) -> set[str]:
    """The paths of [vary] that lead to a value."""
    return {path for path in editor.tables.get("vary", {}) if value_at(editor.tables, path_parts(path)) is not None}
