"""Doubled keys: the place where a scene's text says a thing a second time, and the line where it said it first.

TOML's own word for it names neither the key nor the line where that stood before.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator

from graphplan.mechanism.items import quoted
from graphplan.mechanism.scene_text import TOKENS

PART = r"(?:[A-Za-z0-9_-]+|\"[^\"\n]*\"|'[^'\n]*')"
NAME = rf"{PART}(?:[ \t]*\.[ \t]*{PART})*"
KEY = re.compile(rf"[ \t]*({NAME})[ \t]*=")
HEADER = re.compile(rf"[ \t]*(\[\[?)[ \t]*({NAME})[ \t]*\]")
INLINE = re.compile(r"Duplicate inline table key '(.*)'", re.DOTALL)
Path = tuple[str, ...]


def doubled_key(text: str, message: str, line: int) -> tuple[str, str, str] | None:
    """The line of a text that says a thing again, what is wrong and what to write; None if nothing is said twice.

    TOML refuses the text with this message at this line, where a value may end that began earlier.
    """
    if inline := INLINE.fullmatch(message):
        return f"line {line}", f"the key {quoted(inline[1])} is given twice in one table", "one of the two"
    seen: dict[Path, tuple[int, str]] = {}
    for number, sort, path in _entries(text):
        if number > line:
            break
        whole = next((path[:end] for end in range(1, len(path)) if seen.get(path[:end], (0, ""))[1] == "="), path)
        first, before = seen.get(whole, (0, ""))
        if before and not sort == before == "[[":
            name, wrong = ".".join(map(quoted, whole)), first if sort == "[[" else number
            return (f"line {number}", f"{name} is given twice, first in line {first}", "each name once") \
                if "[[" not in (sort, before) else \
                (f"line {wrong}", f"{name} is a list of tables, but not here", f"[[{name}]] in each place")
        for end in range(1, len(path) + 1) if sort == "=" else (len(path),):
            seen.setdefault(path[:end], (number, sort if end == len(path) else "."))
    return None


def _entries(text: str) -> Iterator[tuple[int, str, Path]]:
    """Each key and header with its line: whether it is a key (=), a table ([) or an entry of a list ([[), and its path.

    The entries of a list are counted, so that the keys of each are its own.
    """
    table: Path = ()
    entries = dict[Path, int]()
    for number, line in enumerate(TOKENS.sub(_without_text, text).split("\n"), 1):
        if header := HEADER.match(line):
            table = _path(header[2])
            yield number, header[1], table
            if header[1] == "[[":
                entries[table] = entries.get(table, 0) + 1
                table = *table, f"{entries[table]}"
        elif key := KEY.match(line):
            yield number, "=", (*table, *_path(key[1]))


def _without_text(token: re.Match[str]) -> str:
    """A token as it stands, but what has several lines, and comments, as empty lines."""
    return re.sub(r"[^\n]", "", token[0]) if token[0][0] == "#" or "\n" in token[0] else token[0]


def _path(name: str) -> Path:
    """The parts of a key: of points.A both."""
    parts: list[str] = []
    try:
        tables: object = tomllib.loads(f"{name} = 0")
    except ValueError:  # strange characters in quotes
        return (name,)
    while isinstance(tables, dict):
        ((part, tables),) = tables.items()
        parts.append(part)
    return tuple(parts)
