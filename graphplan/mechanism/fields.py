"""Fields: what a scene may say, each key once: its name, its words, the kind of its value, its default or its remedy.

The reader, the JSON Schema, the commented scenes of `graphplan new` and the manual all read these records. A kind of
value says how it is read (None where that noted a fault) and how JSON Schema has it. Tables, lists of tables and tables
by name are kinds as well, so that a whole scene is one table of fields.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Hashable, Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple, TypeAlias

from graphplan.errors import by_name
from graphplan.mechanism.items import SceneItem
from graphplan.mechanism.numbers import Pair
from graphplan.mechanism.pairs.pair import FRAME, KinematicPair
from graphplan.mechanism.units import Units

Fragment = dict[str, Any]


@dataclass
class SceneNames:
    """What a table may speak of, as far as it is read: names and places of points, links with their points, pairs.

    `held` says of each point how many links have it, `irrational` gathers where fractions do not hold what is written,
    `tables` is all that is written. Files that it names lie in `folder`; `files` are the rows of
    those that are read.
    """

    points: Collection[str]
    places: dict[str, Pair] = field(default_factory=dict)
    links: dict[str, tuple[str, ...]] = field(default_factory=dict)
    link_counts: Counter[str] = field(default_factory=Counter)
    pairs: tuple[KinematicPair, ...] = ()
    units: Units = field(default_factory=Units)
    irrational: list[str] = field(default_factory=list)
    tables: dict[str, object] = field(default_factory=dict)
    folder: str = ""
    files: dict[str, tuple[Pair, ...]] = field(default_factory=dict)

    @property
    def frame(self) -> str:
        """The fixed link, by its name; frame where the scene has none."""
        return next((link for link in self.links if link == FRAME), FRAME)

    @property
    def bodies(self) -> Collection[str]:
        """The names of all links, with the frame even where no link is called so."""
        return self.links if FRAME in self.links else (*self.links, FRAME)

    @property
    def moving(self) -> tuple[str, ...]:
        """The links that are not the frame."""
        return tuple(link for link in self.links if link != FRAME)

    def take_links(self, links: dict[str, tuple[str, ...]]) -> None:
        """Take in the links with their points."""
        self.links, self.link_counts = links, Counter(point for points in links.values()
                                                      for point in dict.fromkeys(points))

    @property
    def movable(self) -> tuple[str, ...]:
        """The points that links have and the frame has not."""
        fixed = {*self.links.get(FRAME, ())}
        return tuple(p for p in self.points if p in self.link_counts and p not in fixed)


class Field(NamedTuple):
    """A key of a table, what it says, and the kind of its value.

    One that must be there has what to write instead (`wanted`); one that may be left out has a default, or nothing.
    """

    name: str
    words: str
    kind: Value
    wanted: str = ""
    default: Any = None


@dataclass
class TableRow:
    """A table as it was read: its values by key, the items that they are from, and what the scene has."""

    item: SceneItem
    items: dict[str, SceneItem]
    values: dict[str, Any]
    names: SceneNames

    def __getitem__(self, key: str) -> Any:
        return self.values[key]


class Kind(NamedTuple):
    """A kind of value that is no table: in words, how it is read (None where that noted a fault), and its schema."""

    says: str
    read: Callable[[SceneItem, SceneNames], Any]
    schema: Fragment


class Table(NamedTuple):
    """A table of these fields and no others, and what is made of it: by default the values by key.

    Just one of the keys `either` must be there, which `remedy` says.
    """

    says: str
    fields: tuple[Field, ...]
    make: Callable[[TableRow], Any] = lambda row: row.values
    either: tuple[str, ...] = ()
    remedy: str = ""

    @property
    def keys(self) -> list[str]:
        """The names of its fields."""
        return [field.name for field in self.fields]

    def read(self, item: SceneItem, names: SceneNames) -> Any:
        """What is made of a table; None where it, or a value in it, has a fault."""
        items = item.fields(self.keys, {field.name: field.wanted for field in self.fields if field.wanted})
        if items is None:
            return None
        before, values = len(item.faults), {}
        for name, _, kind, _, default in self.fields:
            if name in items:
                values[name] = kind.read(items[name], names)
            elif default is not None:
                values[name] = kind.read(item.with_value(default), names)
        if self.either and sum(key in items for key in self.either) != 1:
            twice = f"{' and '.join(self.either)} are both given"
            item.fault(twice if self.either[0] in items else f"{self.either[0]} is missing", self.remedy)
        return self.make(TableRow(item, items, values, names)) if len(item.faults) == before else None


class Either(NamedTuple):
    """One of several forms, which its own rule may choose.

    Without a rule it is the last of which a key is there that no other form has, otherwise the first.
    """

    forms: tuple[Any, ...]
    choose: Callable[[SceneItem], Value | None] | None = None

    @property
    def says(self) -> str:
        """The forms in words."""
        return ", or ".join(form.says for form in self.forms)

    def read(self, item: SceneItem, names: SceneNames) -> Any:
        """What the form makes of a table."""
        if self.choose:
            form = self.choose(item)
            return form.read(item, names) if form else None
        return self.by_keys(item.value if isinstance(item.value, dict) else ()).read(item, names)

    def by_keys(self, keys: Iterable[str]) -> Any:
        """The form that these keys tell."""
        own = {*keys}
        for form in reversed(self.forms[1:]):
            if own & {*form.keys}.difference(*(rival.keys for rival in self.forms if rival is not form)):
                return form
        return self.forms[0]


class Rows(NamedTuple):
    """An array of tables; a `single` one may stand as a table of its own.

    `once` gives what of an entry may not come twice, and what it is called.
    """

    entry: Table | Either
    single: bool = False
    once: Callable[[Any], tuple[Hashable, str]] | None = None
    remedy: str = ""

    @property
    def says(self) -> str:
        """The entries in words."""
        return f"{'a table or ' if self.single else ''}an array of tables: {self.entry.says}"

    def read(self, item: SceneItem, names: SceneNames) -> Any:
        """What is made of the tables without faults, in order."""
        rows = [item] if self.single and not isinstance(item.value, list) else item.rows()
        entries: list[Any] = []
        earlier = set()
        for row in rows:
            entry = self.entry.read(row, names)
            if entry is None:
                continue
            if self.once:
                identity, noun = self.once(entry)
                if identity in earlier:
                    row.fault(f"a second {noun}", self.remedy)
                earlier.add(identity)
            entries.append(entry)
        return tuple(entries)


class Named(NamedTuple):
    """A table whose keys are names, of points or links of the scene or others; `check` notes what is wrong with one."""

    entry: Value
    key: Kind
    check: Callable[[str, SceneItem, SceneNames], object] = lambda name, item, names: None
    least: int = 0

    @property
    def says(self) -> str:
        """The entries in words."""
        return f"by {self.key.says}: {self.entry.says}"

    def read(self, item: SceneItem, names: SceneNames) -> Any:
        """What the entries say, without those that say nothing."""
        entries = {}
        for name, entry in (item.table() or {}).items():
            self.check(name, entry, names)
            entries[name] = self.entry.read(entry, names)
        return {name: value for name, value in entries.items() if value is not None}


Value: TypeAlias = Kind | Table | Either | Rows | Named


def inner(value: Value) -> Iterator[Field]:
    """The fields of all tables in a kind of value, each before those in it."""
    match value:
        case Table(fields=fields):
            for field in fields:
                yield field
                yield from inner(field.kind)
        case Either(forms=forms):
            for form in forms:
                yield from inner(form)
        case Rows(entry=entry) | Named(entry=entry):
            yield from inner(entry)


def is_on_link(row: TableRow, key: str, point: str, link: str, what: str = "link") -> bool:
    """Whether a point that a key names is a point of this link; a fault where it is not."""
    points = row.names.links.get(link, ())
    if points and point not in points:
        instead = "one of " + ", ".join(sorted(points, key=by_name))
        row.items[key].fault(f"{point} is not a point of {what} {link}", instead)
    return point in points
