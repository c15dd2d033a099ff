"""Items: one value of a scene with the place where it stands, read as what is wanted there or else a fault.

Every reading method gives the value, or None once it has noted the fault; nothing here raises. All faults of a scene
are gathered, with the names that were probably meant.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TypeVar

from graphplan.errors import Fault, by_name, printable
from graphplan.mechanism.numbers import Unusable, integer, number_text

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
        """One of a few words."""
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
        from graphplan.mechanism.slips import names_in

        for name in dict.fromkeys(names):
            if name not in known and len(apart := names_in(name, known)) > 1:
                self.fault(f"there is no point {name}", f'perhaps "{" ".join(apart)}", with blanks')
            elif name not in known:
                self.faults.unknown(self.where, "point", name, known)
            elif names.count(name) > 1:
                self.fault(f"point {name} is named twice", "each point once")
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
    """What a wrong value is, in words."""
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
