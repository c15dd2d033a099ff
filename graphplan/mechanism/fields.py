"""Fields: what a scene may say, each key once, with its words, the kind of its value, its default or its remedy.

An item is one value of a scene with the place where it stands; it is read as what is wanted there, or is a fault.

Every reading method gives the value, or None once it has noted the fault; nothing here raises. All faults of a scene
are gathered, with the names that were probably meant.

The reader, the JSON Schema, the commented scenes of `graphplan new` and the manual all read these records. A kind of
value says how it is read (None where that noted a fault) and how JSON Schema has it. Tables, lists of tables and tables
by name are kinds as well, so that a whole scene is one table of fields.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Collection, Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from typing import Any, NamedTuple, TypeAlias, TypeVar

from graphplan.errors import Fault, by_name, printable
from graphplan.mechanism.numbers import (
    FLOAT_RECKONING,
    Pair,
    Reckoning,
    Unusable,
    exactly,
    integer,
    is_exact,
    number_text,
)
from graphplan.mechanism.pairs.pair import FRAME, KinematicPair
from graphplan.mechanism.units import Units

T = TypeVar("T")
Vector = tuple[Fraction, Fraction]

MAX_PART_LENGTH = 300
"""Characters of one part of a fault line: a name may be a novel, an error line may not."""

MAX_SUGGESTIONS = 50
"""Faults that get a suggestion; guessing is slow."""


MAX_UNKNOWN_KEYS = 3
"""More unknown keys than this are reported as one fault: the header of their table is missing."""


class Faults:
    """The faults found so far; each is kept once, in the order in which they were found.

    That a name is unknown where a scene has none at all follows from that, and is told only if nothing else is.
    """

    def __init__(self) -> None:
        self._found: dict[Fault, None] = {}
        self._following: set[Fault] = set()

    def __iter__(self) -> Iterator[Fault]:
        return iter([fault for fault in self._found if fault not in self._following] or [*self._found])

    def __len__(self) -> int:
        return len(self._found)

    def add(self, where: str, what: str, instead: str) -> None:
        """Note one fault."""
        self._note(where, what, instead)

    def _note(self, *parts: str) -> Fault:
        fault = Fault(*map(one_line, parts))
        self._found[fault] = None
        return fault

    def unknown(self, where: str, kind: str, name: str, known: Collection[str]) -> None:
        """Note that there is no such `kind` (point, link, ...), with the names that were probably meant."""
        anything = f"a {kind} that the scene has"
        instead = suggestion(name, sorted(known, key=by_name), kind) if len(self) < MAX_SUGGESTIONS else anything
        fault = self._note(where, f"there is no {kind} {name}", instead)
        if not known:
            self._following.add(fault)

    def none_in(self, *tables: str) -> bool:
        """Whether the scene's top-level tables of these names are free of faults."""
        return not any(fault.where.split(".")[0] in tables for fault in self._found)


@dataclass(frozen=True)
class SceneItem:
    """A value as tomllib gave it, `where` it stands in the scene, the faults to add to, and the key it is under."""

    value: object
    where: str
    faults: Faults
    key: str = ""

    def with_value(self, value: object) -> SceneItem:
        """Another value at the same place, such as a part of this one."""
        return replace(self, value=value)

    def fault(self, what: str, instead: str) -> T | None:
        """Note a fault of this very item; None, as it has no value then."""
        self.faults.add(self.where, what, instead)
        return None

    def number(self) -> Fraction | None:
        """A finite number of usable size, exactly."""
        value = integer(self.value) if type(self.value) is int else self.value
        if isinstance(value, Fraction):
            return value
        if isinstance(value, Unusable):
            return self.fault(f"{value.text} is not a usable number", "a finite number between 1e-60 and 1e60 in size")
        return self.fault(*(self.slip() or (f"{describe(value)} where a number is wanted", "a number such as 12.5")))

    def slip(self) -> tuple[str, str] | None:
        """The fault of a text that should be a number, and its correction; None where it is no such text."""
        if not isinstance(self.value, str):
            return None
        from graphplan.mechanism.slips import slip  # few scenes have faults

        return slip(self.value, self.key)

    def positive(self, what: str) -> Fraction | None:
        """A number above zero."""
        number = self.number()
        if number is not None and number <= 0:
            return self.fault(f"the {what} {number_text(number)} is not positive", f"a {what} above 0")
        return number

    def amount(self) -> Fraction | None:
        """A number that is not negative."""
        number = self.number()
        if number is not None and number < 0:
            return self.fault(f"the {self.key} {number_text(number)} is negative", "a number of 0 or more")
        return number

    def vector(self) -> Vector | None:
        """Two numbers: coordinates or components."""
        if not isinstance(self.value, list) or len(self.value) != 2:
            return self.fault(f"{describe(self.value)} where two numbers are wanted", "two numbers such as [10, 5]")
        x, y = (self.with_value(number).number() for number in self.value)
        return None if x is None or y is None else (x, y)

    def text(self, wanted: str, instead: str) -> str | None:
        """A string."""
        if isinstance(self.value, str):
            return self.value
        return self.fault(f"{describe(self.value)} where {wanted} is wanted", instead)

    def choice(self, words: Collection[str]) -> str | None:
        """Return the value if it is one of these words; else record a fault."""
        if isinstance(self.value, str) and self.value in words:
            return self.value
        instead = suggestion(self.value, words, "word") if isinstance(self.value, str) else "one of " + ", ".join(words)
        return self.fault(f"{describe(self.value)} is not known here", instead)

    def name_of(self, kind: str, known: Collection[str]) -> str | None:
        """The name of a point or link that the scene has."""
        name = self.text(f"the name of a {kind}", 'a name in quotes, such as "3"')
        if name is None:
            return None
        same = next((link for link in known if name in (str(link), link)), None)  # the frame may have another name
        if same is None:
            self.faults.unknown(self.where, kind, name, known)
        return same

    def points(self, known: Collection[str]) -> tuple[str, ...] | None:
        """Names of different points, written as one string with blanks between them."""
        text = self.text("a string of points", 'points separated by blanks, such as "A B"')
        if text is None:
            return None
        if "," in text:
            return self.fault("commas between points", 'points separated by blanks alone, such as "A B"')
        names = text.split()
        before = len(self.faults)
        for name in dict.fromkeys(names):
            if name in known:
                if names.count(name) > 1:
                    self.fault(f"point {name} is named twice", "each point once")
                continue
            from graphplan.mechanism.slips import names_in  # few scenes have faults

            if len(apart := names_in(name, known)) > 1:
                self.fault(f"there is no point {name}", f'perhaps "{" ".join(apart)}", with blanks')
            else:
                self.faults.unknown(self.where, "point", name, known)
        return tuple(names) if len(self.faults) == before else None

    def two_points(self, known: Collection[str], such: str) -> str | None:
        """Two points, as one string."""
        names = self.points(known)
        if names is not None and len(names) != 2:
            return self.fault(f"{describe(self.value)} where two points are wanted", f'two points such as "{such}"')
        return None if names is None else " ".join(names)

    def table(self) -> dict[str, SceneItem] | None:
        """The items of a table."""
        if not isinstance(self.value, dict):
            return self.fault(f"{describe(self.value)} where a table is wanted", "a table of keys and values")
        prefix = f"{self.where}." if self.where else ""
        return {key: SceneItem(value, prefix + quote_key(key), self.faults, key) for key, value in self.value.items()}

    def fields(self, known: Iterable[str], required: Mapping[str, str]) -> dict[str, SceneItem] | None:
        """The items of a table with these keys only; `required` keys must be there, each with what it should say."""
        items, keys = self.table(), list(known)
        if items is None:
            return None
        unknown = [key for key in items if key not in keys]
        if len(unknown) > MAX_UNKNOWN_KEYS:  # a table's header is missing above them
            listed = ", ".join(unknown[:MAX_UNKNOWN_KEYS]) + ", ..."
            self.faults.add(self.where or "file", f"unknown keys {listed}", "the header of their table above them")
        for key in unknown if len(unknown) <= MAX_UNKNOWN_KEYS else ():
            items[key].fault("unknown key", suggestion(key, keys, "key"))
        missing = [key for key in required if key not in items]
        for key in missing:
            self.fault(f"{key} is missing", required[key])
        return None if missing else {key: items[key] for key in keys if key in items}

    def rows(self) -> list[SceneItem]:
        """The tables of an array of tables; their places are numbered from 1."""
        if isinstance(self.value, list):
            return [SceneItem(row, f"{self.where}.{i}", self.faults) for i, row in enumerate(self.value, 1)]
        self.fault(f"{describe(self.value)} where a list of tables is wanted", f"[[{self.where}]], in double brackets")
        return []


def quote_key(key: str) -> str:
    """A key as TOML wants it: in quotes unless it is made of letters, digits, _ and -."""
    return key if re.fullmatch(r"[\w-]+", key) else f'"{key}"'


def describe(value: object) -> str:
    """Describe a wrong value in words."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, Unusable):
        return value.text
    if isinstance(value, str):
        return f'the string "{value[:40]}"'
    if isinstance(value, list):
        return f"a list of {len(value)}"
    if isinstance(value, dict):
        return f"a table with the keys {', '.join(list(value)[:4])}" if value else "an empty table"
    if isinstance(value, Fraction):
        return f"the number {number_text(value)}"
    if isinstance(value, int):
        return describe(integer(value))
    return "a date or time"


def suggestion(name: str, known: Iterable[str], kind: str) -> str:
    """The known names nearest to `name`, or else the whole choice, as the remedy of a fault."""
    from difflib import get_close_matches  # few scenes have faults

    from graphplan.mechanism.slips import with_frame

    choice = list(known)
    if corrected := with_frame(name, choice):
        return f"perhaps {corrected}"
    near = get_close_matches(name[:60], choice, n=2, cutoff=0.6)
    same = [word for word in choice if word.lower() in (name.lower(), f"{name.lower()}s")]  # but for case and plural
    if same or near:
        return "perhaps " + " or ".join(same or near)
    if not choice:
        return f"a {kind} that the scene has"
    return "one of " + ", ".join(choice[:12]) + (", ..." if len(choice) > 12 else "")


def one_line(text: str) -> str:
    """The text without line breaks and other unprintables, and not too long: a fault is one line."""
    return printable(text[:MAX_PART_LENGTH]) + "..." * (len(text) > MAX_PART_LENGTH)


Fragment = dict[str, Any]


@dataclass
class SceneNames:
    """Names that a table may refer to, as far as they are read: points and their places, links with their points,
    pairs.

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
        """Name of the fixed link; `frame` in a scene without one."""
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
        """Read a table; return None if it, or a value in it, has a fault."""
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
        """Read a table by the form that its keys choose."""
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
        """Read the tables without faults, in order."""
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
        """Read the entries, without those that are empty."""
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


NAME = r"[^\s,]+"
TEXT = Kind("text", lambda item, names: item.text("a text", "a text in quotes"), {"type": "string"})
NUMBER = Kind("number", lambda item, names: item.number(), {"type": "number"})
DISTANCE = Kind("number above 0", lambda item, names: item.positive("distance"),
                {"type": "number", "exclusiveMinimum": 0})
AMOUNT = Kind("number from 0", lambda item, names: item.amount(), {"type": "number", "minimum": 0})
VECTOR = Kind("two numbers", lambda item, names: item.vector(),
              {"type": "array", "items": NUMBER.schema, "minItems": 2, "maxItems": 2})
POINT = Kind("point", lambda item, names: item.name_of("point", names.points),
             {"type": "string", "pattern": f"^{NAME}$"})
LINK = Kind("link", lambda item, names: item.name_of("link", names.links), {"type": "string", "pattern": r"\S"})
BODY = Kind("link", lambda item, names: item.name_of("link", names.bodies), LINK.schema)


def _two_links(item: SceneItem, names: SceneNames) -> tuple[str | None, ...] | None:
    if not isinstance(item.value, list) or len(item.value) != 2:
        return item.fault(f"{describe(item.value)} where two links are wanted", 'two links such as ["3", "2"]')
    return tuple(LINK.read(item.with_value(name), names) for name in item.value)


TWO_LINKS = Kind("two links", _two_links, {"type": "array", "items": LINK.schema, "minItems": 2, "maxItems": 2})


def _flag(item: SceneItem, names: SceneNames) -> bool | None:
    fault = f"{describe(item.value)} where true or false is wanted"
    return item.value if isinstance(item.value, bool) else item.fault(fault, "true or false, without quotes")


FLAG = Kind("true · false", _flag, {"type": "boolean"})


def _centres(item: SceneItem, names: SceneNames) -> tuple[str, ...] | None:
    if not isinstance(item.value, list) or not item.value:
        return item.fault(f"{describe(item.value)} where centres are wanted", 'points such as ["B", "C"]')
    centres = tuple(POINT.read(item.with_value(name), names) for name in item.value)
    return None if None in centres else centres


CENTRES = Kind("centres", _centres, {"type": "array", "items": POINT.schema, "minItems": 1, "maxItems": 2})


def _two(what: str, such: str, whole: bool = False) -> Kind:
    """Two numbers above zero."""
    def read(item: SceneItem, names: SceneNames) -> tuple[Any, ...] | None:
        if not isinstance(item.value, list) or len(item.value) != 2:
            return item.fault(f"{describe(item.value)} where two {what} are wanted", f"two numbers such as {such}")
        numbers = tuple(item.with_value(entry).positive(f"number of {what}" if whole else "radius")
                        for entry in item.value)
        for number in numbers if whole else ():
            if number is not None and number.denominator != 1:
                return item.fault(f"{number_text(number)} {what}", f"whole numbers such as {such}")
        return None if None in numbers else numbers

    entry = {"type": "integer", "minimum": 1} if whole else DISTANCE.schema
    return Kind(f"two {what}", read, {"type": "array", "items": entry, "minItems": 2, "maxItems": 2})


TEETH = _two("teeth", "[24, 36]", whole=True)
RADII = _two("radii", "[48, 72]")


def centres_on(row: TableRow, *wanted: tuple[str, str]) -> bool:
    """Whether each of these centres is a point of its link; a fault for one that is not."""
    misplaced = [centre for centre, link in wanted if not is_on_link(row, "centres", centre, link)]
    return not misplaced


def choice(*words: str) -> Kind:
    """The kind of a value that is one of these words."""
    return Kind(" · ".join(words), lambda item, names: item.choice(words), {"enum": [*words]})


def moving(fault: str) -> Kind:
    """A link that is not the frame; with the frame it is this fault."""
    def read(item: SceneItem, names: SceneNames) -> str | None:
        link = item.name_of("link", names.links)
        if link == FRAME:
            item.fault(fault, "a moving link")
        return link

    return Kind("moving link", read, LINK.schema)


def name_list(noun: str, such: str, known: Callable[[SceneNames], Collection[str]],
              every: Callable[[SceneNames], Any] | None = None, *, many: str = "", after: tuple[str, ...] = (),
              entry: Kind = TEXT, wrong: Callable[[object, SceneItem, SceneNames], bool] = lambda name, item,
              names: False) -> Kind:
    """A list of what results are asked of, of those `known` that are not `wrong`; or "all", which means `every` one.

    Where the tables `after` have faults nothing is said of names: what is meant may be among those.
    """
    many = many or f"{noun}s"

    def read(item: SceneItem, names: SceneNames) -> Any:
        if not item.faults.none_in(*after):
            return ()
        if item.value == "all":
            return (every or known)(names)
        if not isinstance(item.value, list):
            return item.fault(f"{describe(item.value)} where a list of {many} is wanted",
                              f'a list such as {such}, or "all"')
        entries, choice = [item.with_value(value) for value in item.value], known(names)
        chosen = [entry.name_of(noun, choice) for entry in entries
                  if not (isinstance(entry.value, str) and wrong(entry.value, item, names))]
        return tuple(dict.fromkeys(name for name in chosen if name is not None))

    return Kind(f'list of {many}, or "all"', read,
                {"anyOf": [{"const": "all"}, {"type": "array", "items": entry.schema}]})


Direction = Vector | Fraction | str
"""A direction as written: a vector, an angle in degrees, or two points such as "O A"."""

Written = Direction | None
"""A direction as the scene writes it, if it does."""

Where = Callable[[str], tuple[Any, Any]]
"""Gives a named point's coordinates, in fractions or in any numbers that compute with them."""

_EIGHTHS = ((1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1))
"""A direction may have any length, so the multiples of 45 degrees are exact."""


class Misfit(Exception):
    """Raised by a geometric rule whose figure cannot be drawn: what is wrong, and what would be right."""

    def __init__(self, what: str, instead: str):
        self.what, self.instead = what, instead
        super().__init__(what)


def _direction(item: SceneItem, names: SceneNames) -> Direction | None:
    """A direction in one of its three spellings."""
    if isinstance(item.value, list):
        if item.value and all(isinstance(value, str) and value in names.points for value in item.value):
            return item.fault("a list of points", f'both points in one string, such as "{" ".join(item.value[:2])}"')
        components = item.vector()
        if components is not None and not any(components):
            return item.fault("the direction is zero", "a vector that is not [0, 0]")
        return components
    if isinstance(item.value, str):
        if not {*item.value.split()} <= {*names.points} and (fault := item.slip()):
            return item.fault(*fault)
        return item.two_points(names.points, "O A")
    return item.number()


def _guide(item: SceneItem, names: SceneNames) -> tuple[Pair, tuple[str, ...] | None, Written] | None:
    """A guide's direction in this pose, the two points that give it, if points do, and the direction as written."""
    direction = _direction(item, names)
    if direction is None:
        return None
    through = points_of(direction)
    if any(name not in names.places for name in through):
        return (Fraction(1), Fraction(0)), through, direction  # the point has its own fault; look for more
    try:
        x, y, exact = vector(direction, lambda name: exactly(names.places[name]))
    except Misfit as misfit:
        return item.fault(misfit.what, misfit.instead)
    if not exact:
        names.irrational.append(f"{item.where}: angle")
    rational = exact and is_exact(*(names.places[name] for name in through))
    return (x, y) if rational else (float(x), float(y)), through or None, direction


TWO_POINTS = Kind("two points", lambda item, names: item.two_points(names.points, "A B"),
                  {"type": "string", "pattern": rf"^\s*{NAME}\s+{NAME}\s*$"})
DIRECTION = Kind("direction", _direction, {"anyOf": [VECTOR.schema, NUMBER.schema, TWO_POINTS.schema]})
GUIDE = Kind("direction", _guide, DIRECTION.schema)


def points_of(direction: object) -> tuple[str, ...]:
    """The points that give a direction, if points do."""
    return tuple(direction.split()) if isinstance(direction, str) else ()


def vector(direction: Direction, at: Where, by: Reckoning = FLOAT_RECKONING) -> tuple[Any, Any, bool]:
    """The direction as a vector, and whether it is exact (provided that its points are)."""
    if isinstance(direction, tuple):
        return *direction, True
    if isinstance(direction, Fraction):
        if direction % 45 == 0:
            x, y = _EIGHTHS[int(direction / 45) % 8]
            return Fraction(x), Fraction(y), True
        return by.heading(direction)
    (x0, y0), (x1, y1) = (at(name) for name in points_of(direction))
    if (x0, y0) == (x1, y1):
        raise Misfit(f"the points {direction} coincide and give no direction", "two points that lie apart")
    return x1 - x0, y1 - y0, True
