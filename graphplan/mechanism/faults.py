"""Faults: everything that is wrong with a scene, gathered, with the names that were probably meant."""

from __future__ import annotations

from collections.abc import Iterable

from graphplan.errors import Fault, by_name, printable

_LONGEST = 300
"""Characters of one part of a fault line: a name may be a novel, an error line may not."""

_GUESSES = 50
"""Only so many faults are given suggestions: guessing is slow, and nobody reads further."""


class Faults:
    """The faults found so far; each is kept once, in the order in which they were found."""

    def __init__(self) -> None:
        self._found: dict[Fault, None] = {}

    @property
    def found(self) -> tuple[Fault, ...]:
        """All faults, first found first."""
        return tuple(self._found)

    def __len__(self) -> int:
        return len(self._found)

    def add(self, where: str, what: str, instead: str) -> None:
        """Note one fault."""
        self._found[Fault(one_line(where), one_line(what), one_line(instead))] = None

    def unknown(self, where: str, kind: str, name: str, known: Iterable[str]) -> None:
        """Note that there is no such `kind` (point, link, ...), with the names that were probably meant."""
        anything = f"a {kind} that the scene has"
        instead = perhaps(name, sorted(known, key=by_name), kind) if len(self) < _GUESSES else anything
        self.add(where, f"there is no {kind} {name}", instead)

    def none_in(self, *tables: str) -> bool:
        """Whether the scene's top-level tables of these names are free of faults."""
        return not any(fault.where.split(".")[0] in tables for fault in self._found)


def perhaps(name: str, known: Iterable[str], kind: str) -> str:
    """What was probably meant by `name`: the nearest known names, or else the whole choice."""
    from difflib import get_close_matches  # few scenes have faults

    choice = list(known)
    near = get_close_matches(name[:60], choice, n=2, cutoff=0.6)
    folded = [word for word in choice if word.lower() == name.lower()]
    if folded or near:
        return "perhaps " + " or ".join(folded or near)
    if not choice:
        return f"a {kind} that the scene has"
    return "one of " + ", ".join(choice[:12]) + (", ..." if len(choice) > 12 else "")


def one_line(text: str) -> str:
    """The text without line breaks and other unprintables, and not too long: a fault is one line."""
    return printable(text[:_LONGEST]) + "..." * (len(text) > _LONGEST)
