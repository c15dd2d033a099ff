"""The words of a command line, so that argparse takes a value that begins with a minus sign for what it is."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

SIZE = r"(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?(?:/\d+)?"
NUMBER = rf"[-+\u2212]?{SIZE}"
OPTION = re.compile(r"--[a-z][\w-]*")
BELOW_ZERO = re.compile(rf"[-\u2212](?:{SIZE}|inf|nan)(?:,.*)?", re.IGNORECASE)
TRAVELS = re.compile(rf"{NUMBER}(?:,\s*{NUMBER})*,?", re.IGNORECASE)
MINUS = "\u2212"  # as it is printed
AT = "--at"  # the option that takes the travels of several drives, also as several words


def with_values_joined(words: Sequence[str]) -> list[str]:
    """The words, with each number below zero joined to the option before it, and the travels of a list into one word.

    --at -3,1.5 becomes --at=-3,1.5, and --at 60 -30 becomes --at=60,-30.
    """
    return list(_join_values([*words]))


def _join_values(words: list[str]) -> Iterator[str]:
    while words:
        word = words.pop(0)
        if word == "--":
            yield from (word, *words)
            return
        option, equals, value = word.partition("=")
        values = [value] if equals else []
        while option == AT and words and all(map(TRAVELS.fullmatch, (*values, words[0]))):
            values.append(words.pop(0))
        if not values and OPTION.fullmatch(option) and words and BELOW_ZERO.fullmatch(words[0]):
            values.append(words.pop(0))
        joined = ",".join(value.rstrip(",") for value in values) if len(values) > 1 else "".join(values)
        yield f"{option}={joined.replace(MINUS, '-')}" if values else word
