"""Fuzzing: scenes spoilt by chance, always the same for a seed, and a command that is watched while it runs."""

from __future__ import annotations

import contextlib
import io
import re
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from random import Random
from typing import NamedTuple

from graphplan.commands import main
from graphplan.mechanism.scene import load, packaged_names

NUMBER = re.compile(r"(?<![\w.\"-])-?\d+(?:\.\d+)?(?![\w.\"])")
NAME = re.compile(r"\b[A-Za-z]\w*\b|\"\w+\"|(?m:^\w+)(?= *=)")
VALUE = re.compile(r"(?m)(?<== )[^=\n]+$")
EXTREMES = ("0", "-0.0", "1", "-1", "1e-9", "1e9", "1e-30", "1e30", "9e59", "1e60", "1e-60", "1e-61", "-1e59", "nan",
            "inf", "-inf", "1" + "0" * 40, "1" + "0" * 5000, "0.1", "0.333333333333333333333333", "1e400", "12,5",
            "250 mm", "95 rpm", "20°", "0x10", "1_000")
VALUES = ("true", '"text"', '""', "[]", "{}", "[1]", "[1, 2, 3]", "[[1, 2]]", "1979-05-27", "07:32:00", '"A"', '"1"',
          '"frame"', '"all"', "{ from = 1 }", "''", "2", "[0, 0]", '["1", "2"]', '"A A"', '"A, B"', f'"{"A" * 400}"')
STRANGE = ("é", "λ", "𝔸", "\u202e", "\u0000", "\x1b[31m", "\ufeff", "٣", "’", "\t", "\r", "  ", '"', "]", "{", "#",
           "\\", "=")


def scenes() -> list[str]:
    """The texts that are spoilt: the packaged scenes, and those that once failed."""
    failed = sorted((Path(__file__).parent.parent / "faults").glob("[0-9]*.toml"))
    return [*(load(name).text for name in packaged_names()), *(path.read_text(encoding="utf-8") for path in failed)]


# ---- spoiling ------------------------------------------------------------------------------------------------------


def _exchanged(text: str, pattern: re.Pattern[str], chance: Random, new: Callable[[str], str]) -> str:
    """The text with something of a pattern replaced, somewhere."""
    found = list(pattern.finditer(text))
    if not found:
        return text
    at = chance.choice(found)
    return text[: at.start()] + new(at[0]) + text[at.end():]


def character(text: str, chance: Random) -> str:
    """A character is dropped."""
    at = chance.randrange(len(text))
    return text[:at] + text[at + 1:]


def strange(text: str, chance: Random) -> str:
    """A character that nobody types is put in."""
    at = chance.randrange(len(text))
    return text[:at] + chance.choice(STRANGE) + text[at:]


def cut(text: str, chance: Random) -> str:
    """The end is missing."""
    return text[: chance.randrange(len(text))]


def extreme(text: str, chance: Random) -> str:
    """A number is absurd."""
    return _exchanged(text, NUMBER, chance, lambda number: chance.choice(EXTREMES))


def other(text: str, chance: Random) -> str:
    """A number is another one of the scene."""
    numbers = NUMBER.findall(text)
    return _exchanged(text, NUMBER, chance, lambda number: chance.choice(numbers))


def near(text: str, chance: Random) -> str:
    """A number is off by a little, or by its sign."""
    factor = 1 + chance.choice((1e-13, -1e-9, 1e-6, -2, 9, -0.5))
    return _exchanged(text, NUMBER, chance, lambda number: f"{float(number) * factor:.17g}")


def renamed(text: str, chance: Random) -> str:
    """A name is another one of the scene."""
    names = NAME.findall(text)
    return _exchanged(text, NAME, chance, lambda name: chance.choice(names))


def swapped(text: str, chance: Random) -> str:
    """Two names are exchanged everywhere."""
    names = sorted({*re.findall(r"\b\w+\b", text)})
    if not names:
        return text
    one, two = chance.choice(names), chance.choice(names)
    return re.sub(rf"\b(?:{one}|{two})\b", lambda name: two if name[0] == one else one, text)


def typed(text: str, chance: Random) -> str:
    """A value is of another type."""
    return _exchanged(text, VALUE, chance, lambda value: chance.choice(VALUES))


def removed(text: str, chance: Random) -> str:
    """A line is missing."""
    lines = text.splitlines()
    lines.pop(chance.randrange(len(lines)))
    return "\n".join(lines) + "\n"


def doubled(text: str, chance: Random) -> str:
    """A line stands in a second place."""
    lines = text.splitlines()
    lines.insert(chance.randrange(len(lines)), chance.choice(lines))
    return "\n".join(lines) + "\n"


def moved(text: str, chance: Random) -> str:
    """A line stands in another place."""
    lines = text.splitlines()
    line = lines.pop(chance.randrange(len(lines)))
    lines.insert(chance.randrange(len(lines) + 1), line)
    return "\n".join(lines) + "\n"


def shuffled(text: str, chance: Random) -> str:
    """The sections stand in another order."""
    head, *sections = re.split(r"(?m)^(?=\[)", text)
    chance.shuffle(sections)
    return head + "\n".join(section.rstrip("\n") + "\n" for section in sections)


MUTATIONS = (character, strange, cut, extreme, extreme, other, other, near, near, renamed, renamed, swapped, typed,
             typed, removed, removed, doubled, moved, shuffled)


def spoilt(text: str, chance: Random) -> str:
    """The text with one to three mutations."""
    for mutation in chance.choices(MUTATIONS, k=chance.choice((1, 1, 1, 2, 3))):
        text = mutation(text, chance) if text.strip() else text
    return text


# ---- watching ------------------------------------------------------------------------------------------------------


class Ran(NamedTuple):
    """What a command made of its words: its exit status, what it printed and told."""

    status: int
    out: str
    err: str

    def complaints(self) -> Iterator[str]:
        """What no command may do, whatever its words and its scene."""
        told, failed = self.err.splitlines(), self.status in (2, 3)
        if self.status not in (0, 1, 2, 3):
            yield f"exit status {self.status}"
        if failed and not told:
            yield "no word of what is wrong"
        if not all(line.isprintable() for line in told):
            yield f"told {self.err[:300]!r}"
        if failed and not self.out:  # of what is printed all the same, such as poses, some are told to be wrong
            yield from (f"told {line[:300]!r}" for line in told if ": " not in line or not re.search("; |Do: ", line))


@contextlib.contextmanager
def _watched(given: str, out: io.StringIO, err: io.StringIO) -> Iterator[None]:
    """Within this context the streams are these, and a warning is an error."""
    stdin = sys.stdin
    sys.stdin = io.TextIOWrapper(io.BytesIO(given.encode("utf-8", "surrogatepass")))
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), warnings.catch_warnings():
            warnings.simplefilter("error")  # it would be told on standard error
            yield
    finally:
        sys.stdin = stdin


def ran(words: Sequence[str], given: str = "") -> Ran:
    """Run a command in this process, with a text on standard input; fails as the command does."""
    out, err = io.StringIO(), io.StringIO()
    with _watched(given, out, err):
        try:
            status = main(words)
        except SystemExit as end:
            status = end.code if isinstance(end.code, int) else 0
    return Ran(status, out.getvalue(), err.getvalue())


def complaint(words: Sequence[str], given: str = "") -> str:
    """What is wrong with how a command goes; empty where nothing is."""
    try:
        return ", ".join(ran(words, given).complaints())
    except Exception as error:
        last = error.__traceback__
        while last and last.tb_next:
            last = last.tb_next
        place = f"{Path(last.tb_frame.f_code.co_filename).name}:{last.tb_lineno}" if last else ""
        return f"{type(error).__name__} at {place}: {error}"
