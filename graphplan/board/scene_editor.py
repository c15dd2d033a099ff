"""A scene's text that is edited table by table: comments, order and layout of what is not edited stay."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, MutableMapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import tomlkit
from tomlkit.container import Container
from tomlkit.exceptions import TOMLKitError
from tomlkit.items import AoT, Comment, Item, Key, Table

from graphplan.errors import Refused
from graphplan.mechanism.fields import quote_key
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.scene import incomplete_scene
from graphplan.mechanism.scene_text import path_parts

Place = Sequence[float]


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
                self.erase_key("vary", path)
            elif places[path] > removed:
                new_path = ".".join(map(quote_key, [key, f"{places[path] - 1}", *path_parts(path)[2:]]))
                rename_key(self.tables["vary"], path, new_path, ("vary",))

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

    def erase_key(self, table: str, key: str) -> None:
        """Erase a key of a table, and the table with its last one."""
        keys = self.tables.get(table)
        if isinstance(keys, MutableMapping) and key in keys:
            self.remove_key(keys, key)
            if not keys and table not in ("points", "links"):
                self.remove_key(self.tables, table)

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
        """Fail with `Refused` if the scene has no such link."""
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


def write_key(table: Any, key: str | int, value: Any) -> None:
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


def rename_key(table: MutableMapping[str, Any], old: str, new: str, above: tuple[str, ...]) -> None:
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
