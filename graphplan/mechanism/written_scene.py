"""Scenes as users have them in Python: made from mappings, changed by the path of a value, written as TOML again."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, fields
from fractions import Fraction
from functools import lru_cache
from numbers import Rational, Real
from typing import Any

from graphplan.errors import Refused
from graphplan.mechanism import scene as reader
from graphplan.mechanism.model import Scene
from graphplan.mechanism.numbers import decimal
from graphplan.mechanism.scene_text import KEPT_TEXTS, with_keys, with_numbers
from graphplan.mechanism.toml_text import toml_key, toml_text, toml_value, with_value
from graphplan.mechanism.variation import is_number_at, path_parts


@dataclass(frozen=True, repr=False)
class WrittenScene(Scene):
    """A scene that was read from text, which can be changed by paths and written again.

    Loads that no balance holds are held `by_drive`.
    """

    by_drive: bool = False

    def replace(self, path: str | Mapping[str, object], value: object = None) -> WrittenScene:
        """The scene with another value at a path, as in [vary]: points.A.angle, drive.0.omega, find.velocity; or with
        several, as a mapping of values by paths, which in a loop is faster than one after the other.

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
    """The scene with these values by their paths: numbers in the place of numbers at once, the others in turn."""
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
    return _written(reader.scene_of_tables(tables, text, scene.name, scene.by_drive), scene.by_drive)


@lru_cache(KEPT_TEXTS)
def _tables(text: str, name: str) -> dict[str, object]:
    """The tables of a text, kept; nobody changes them."""
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
    return _written(reader.parse(text, name, by_drive), by_drive)


def _written(scene_read: Scene, by_drive: bool) -> WrittenScene:
    """A scene that was read, with what users do with it."""
    values = {field.name: getattr(scene_read, field.name) for field in fields(scene_read)}
    return WrittenScene(**values, by_drive=by_drive)


def scene(tables: Mapping[str, Any], name: str = "scene") -> WrittenScene:
    """The scene that a mapping says, as TOML reads: `{"points": {"O": (0, 0)}, "links": {"1": "O A"}, ...}`.

    Vectors may be tuples, arrays or complex numbers, and floats are the decimals that Python shows for them. Fails as
    :func:`load` does, and with :class:`Refused` where a value is none that TOML has.
    """
    return parse(toml_text(tables), name)
