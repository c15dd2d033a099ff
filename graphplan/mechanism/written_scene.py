"""Tables as the text of a scene, a value changed in it by its path, and its pose in the words that `--at` takes.

Scenes as users have them in Python: made from mappings, changed by the path of a value, written as TOML again.

The text of a scene has its mechanism in the given pose. Drawn in another one, it says so in a comment above all keys.
"""

from __future__ import annotations

import json
import os
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, fields
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache
from numbers import Complex, Integral, Rational, Real
from typing import Any

from graphplan.errors import Refused
from graphplan.mechanism import scene as reader
from graphplan.mechanism.fields import suggestion
from graphplan.mechanism.model import Scene
from graphplan.mechanism.numbers import Unusable, decimal
from graphplan.mechanism.scene_text import KEPT_TEXTS, decimal_text, is_number_at, path_parts, with_keys, with_numbers
from graphplan.mechanism.units import Units

BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")
EACH = "*"  # in a path: every place of a list


def toml_text(tables: Mapping[str, Any]) -> str:
    """A mapping as a TOML file: text, numbers and lists first, then a table for each mapping, and a table in double
    brackets for each mapping of a list.

    Vectors may be tuples, arrays or complex numbers; floats are the decimals that Python shows. Fails with `Refused`
    where a value is none that TOML has.
    """
    plain = {key: value for key, value in tables.items() if not _is_table(value) and not _is_list_of_tables(value)}
    sections = ["".join(_lines(plain))]
    for key, value in tables.items():
        if key in plain:
            continue
        for header, table in ([(f"[{toml_key(key)}]", value)] if _is_table(value) else
                              [(f"[[{toml_key(key)}]]", entry) for entry in value]):
            sections.append("".join([f"{header}\n", *_lines(table)]))
    return "\n".join(filter(None, sections))


def new_scene_text(title: str, source: str, units: Units, tables: Mapping[str, Any]) -> str:
    """A scene of these tables as a TOML file; those that are empty are left out."""
    heading = {"title": title, "source": source, "units": {"length": units.length}}
    return toml_text({key: value for key, value in (heading | dict(tables)).items() if value})


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping)


def _is_list_of_tables(value: Any) -> bool:
    return isinstance(value, Sequence) and not isinstance(value, str) and bool(value) and all(map(_is_table, value))


def _lines(table: Mapping[str, Any]) -> Iterator[str]:
    return (f"{toml_key(key)} = {toml_value(value, str(key))}\n" for key, value in table.items())


def toml_key(key: object) -> str:
    """A key as TOML wants it: in quotes unless it is made of ASCII letters, digits, _ and -."""
    return str(key) if BARE_KEY.fullmatch(str(key)) else json.dumps(str(key), ensure_ascii=False)


def toml_value(value: Any, key: str) -> str:
    """Write a value in TOML; fails with `Refused`, which names the key, if TOML has no such value."""
    match value:
        case bool():
            return str(value).lower()
        case str():
            return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
        case Unusable():
            return value.text
        case Integral():
            return str(int(value))
        case Rational() if _is_decimal(Fraction(value)):
            return decimal_text(Fraction(value))
        case Decimal():
            return f"{value:f}"
        case Real() if not isinstance(value, Rational):
            return repr(float(value))
        case Complex() if not isinstance(value, Real):
            return f"[{float(value.real)!r}, {float(value.imag)!r}]"
        case Mapping():
            return "{ " + ", ".join(line.rstrip() for line in _lines(value)) + " }"
    if hasattr(value, "tolist"):  # an array, or a number of numpy's
        return toml_value(value.tolist(), key)
    if isinstance(value, Sequence):
        return f"[{', '.join(toml_value(entry, key) for entry in value)}]"
    raise Refused(key, f"{value!r} cannot be written in a scene", "a text, a number, a list or a mapping of these")


def _is_decimal(number: Fraction) -> bool:
    """Whether a fraction is a decimal of some digits."""
    remainder = number.denominator
    for prime in (2, 5):
        while remainder % prime == 0:
            remainder //= prime
    return remainder == 1


def with_value(tables: Mapping[str, Any], path: str, value: object) -> dict[str, Any]:
    """The tables with another value at a path, such as points.A.angle, links.2 or drive.0.omega.

    In a list * is each place. The last key may be new, and so may a table of the whole scene; fails with `Refused`
    where nothing else leads there.
    """
    first, *more = path_parts(path) or ("",)
    if not more:
        return {**tables, first: value}
    return {**tables, first: _change_within(tables.get(first, {}), more, value, path)}


def _change_within(inner: Any, keys: Sequence[str], value: object, path: str) -> Any:
    """Return a value with another value at the place that keys lead to."""
    key, more = keys[0], keys[1:]
    if isinstance(inner, list):
        if key not in (EACH, *map(str, range(len(inner)))):
            raise Refused(path, f"there is no place {key} in a list of {len(inner)}",
                          f"places count from 0, and {EACH} is each")
        return [entry if key not in (EACH, str(place)) else value if not more else
                _change_within(entry, more, value, path) for place, entry in enumerate(inner)]
    if not isinstance(inner, Mapping) or (more and key not in inner):
        known = [*map(str, inner)] if isinstance(inner, Mapping) else []
        remedy = suggestion(key, known, "key") if known else "a path that leads to a value of the scene"
        raise Refused(path, f"nothing stands at {key}", remedy)
    return {**inner, key: value if not more else _change_within(inner[key], more, value, path)}


@dataclass(frozen=True, repr=False)
class WrittenScene(Scene):
    """A scene that was read from text, which can be changed by paths and written again.

    Loads that no balance holds are held `by_drive`.
    """

    by_drive: bool = False

    def replace(self, path: str | Mapping[str, object], value: object = None) -> WrittenScene:
        """The scene with another value at a path, as in [vary]: points.A.angle, drive.0.omega, find.velocity, and
        friction.*.coefficient of each friction; or with several, as a mapping of values by paths, which in a loop is
        faster than one after the other.

        Lengths are in the scene's units and angles in degrees, as they are written there. Where a number takes the
        place of a number, comments and layout stay. Fails with :class:`SceneError` where the scene is faulty then, and
        with :class:`Refused` where nothing leads to the path, or `gp.at` has moved the scene.
        """
        if self.assembly is not None:
            raise Refused(f"{self.name}", "the scene stands in another pose", "replace first, then gp.at")
        values = {path: value} if isinstance(path, str) else dict(path)
        return _with_values(self, values)

    def toml(self) -> str:
        """The scene as a file; of one that `gp.at` has moved, in the pose in which it was given."""
        return self.text


def _with_values(scene: WrittenScene, values: Mapping[str, object]) -> WrittenScene:
    """The scene with these values by their paths: numbers instead of numbers at once, the others in turn."""
    tables = _tables(scene.text, scene.name)
    numbers = {path: number for path, value in values.items()
               if (number := _decimal(value)) is not None and is_number_at(tables, path)}
    text = with_numbers(scene.text, numbers) if numbers else scene.text
    for path, number in numbers.items():
        tables = with_value(tables, path, number)
    for path, value in values.items():
        if path not in numbers:
            text = with_value_in_text(text, path, value, scene.name)
            tables = _tables(text, scene.name)
    return _written_scene(reader.scene_of_tables(tables, text, scene.name, scene.by_drive), scene.by_drive)


@lru_cache(KEPT_TEXTS)
def _tables(text: str, name: str) -> dict[str, object]:
    """The tables of a text, cached; no caller changes them."""
    return reader.tables_of(text, name)


def with_value_in_text(text: str, path: str, value: object, name: str) -> str:
    """The text of a scene or a task with another value at a path; comments and layout stay where a number takes the
    place of a number, or a key stands in a table of its own. Fails as :meth:`WrittenScene.replace` does."""
    number, tables = _decimal(value), reader.tables_of(text, name)
    if number is not None and is_number_at(tables, path):
        return with_numbers(text, {path: number})
    edited, (*table, key) = with_value(tables, path, value), path_parts(path) or ("",)
    if len(table) < 2 and not isinstance(value, Mapping):
        candidate = with_keys(text, "".join(table), {toml_key(key): toml_value(value, key)})
        with suppress(ValueError):
            if tomllib.loads(candidate, parse_float=decimal) == edited:
                return candidate
    return toml_text(edited)


def _decimal(value: object) -> Fraction | None:
    """A number as it is written in decimals; None of what is no number."""
    if isinstance(value, bool) or not isinstance(value, Real):
        return None
    try:
        return Fraction(value) if isinstance(value, Rational) else Fraction(repr(float(value)))
    except ValueError:  # nan, inf
        return None


def load(source: str | os.PathLike[str], name: str | None = None, by_drive: bool = False) -> WrittenScene:
    """The scene in a file, on standard input (`-`), or packaged under this name.

    Loads that no balance holds are a fault, unless they are held `by_drive`, as flywheels and motions have it.
    Fails with a :class:`SceneError` that has one line for each fault.
    """
    written = os.fspath(source)
    return parse(reader.source_text(written, name or written), name or written, by_drive)


def parse(text: str, name: str = "scene", by_drive: bool = False) -> WrittenScene:
    """The scene that a TOML text says; `name` stands in error lines, and files that it names are beside it.

    Fails as :func:`load` does.
    """
    return _written_scene(reader.parse(text, name, by_drive), by_drive)


def _written_scene(scene_read: Scene, by_drive: bool) -> WrittenScene:
    """A scene that was read, with what users do with it."""
    values = {field.name: getattr(scene_read, field.name) for field in fields(scene_read)}
    return WrittenScene(**values, by_drive=by_drive)


def scene(tables: Mapping[str, Any], name: str = "scene") -> WrittenScene:
    """The scene that a mapping says, as TOML reads: `{"points": {"O": (0, 0)}, "links": {"1": "O A"}, ...}`.

    Vectors may be tuples, arrays or complex numbers, and floats are the decimals that Python shows for them. Fails as
    :func:`load` does, and with :class:`Refused` where a value is none that TOML has.
    """
    return parse(toml_text(tables), name)


EXACT_TRAVEL = r"-?\d{1,80}(?:[./]\d{1,80})?"  # no exponents: a short text may not be a number that fills the memory
POSE_LINE = re.compile(rf"# drawn with --at ({EXACT_TRAVEL}(?:,{EXACT_TRAVEL})*|(?:outer|inner)[^\n]{{0,100}})\n")
MAX_TRAVEL = 36_000  # degrees or lengths: a hundred turns, which are all followed [0.4 s; 100,000 turns: > 40 s]
GIVEN_POSE = "0"


def pose_text(scene: Scene) -> str:
    """The pose as `--at` takes it: the travel of each drive, exact, or an extreme position; empty if it is the given
    one."""
    if scene.assembly is None:
        return ""
    if extreme := scene.assembly.extreme:
        return f"{extreme.way} {extreme.link}".strip()
    return ",".join(shown if Fraction(shown := decimal_text(travel)) == travel else str(travel)
                    for travel in scene.assembly.travels)


def with_pose(text: str, scene: Scene) -> str:
    """Add the line that states the pose to the text of a scene, unless it is the given one; an empty text stays
    empty."""
    if line := POSE_LINE.match(text):  # a sheet's own text says the pose that it was drawn in then
        text = text[line.end():]
    pose = pose_text(scene)
    return f"# drawn with --at {pose}\n{text}" if text and pose else text


def written_pose(text: str) -> str:
    """The pose that the first line of a text states; empty if it states no readable pose."""
    if line := POSE_LINE.match(text):
        with suppress(Refused):
            parse_pose(line[1])
            return line[1].strip()
    return ""


def parse_pose(text: str) -> list[Fraction] | str:
    """The travel of each drive, or of the first alone, or the words for an extreme position.

    Fails with `Refused` where a text is neither, or a travel is so far that to follow it would take too long.
    """
    if text.strip()[:1].isalpha():
        return text
    try:
        travels = [Fraction(travel.strip()) for travel in text.split(",")]
        sum(map(float, travels))  # OverflowError: a travel that is larger than any float
    except (ValueError, ZeroDivisionError, OverflowError):
        raise Refused(f"--at {text}", "not a travel", "degrees or lengths, such as 60, or 60,-30") from None
    if max(map(abs, travels)) > MAX_TRAVEL:
        raise Refused(f"--at {text}", "too far: every turn is followed", f"at most {MAX_TRAVEL} degrees or lengths")
    return travels
