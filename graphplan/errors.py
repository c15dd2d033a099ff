"""Errors that say what, where, why and what to do.

Every error of graphplan has one base, :class:`GraphplanError`, and every class knows the exit status
that the command line gives for it (0 done, 1 disagreement, 2 bad input, 3 singular pose).
"""

from __future__ import annotations

import copyreg
import re
from dataclasses import dataclass
from functools import lru_cache
from typing import Any


def printable(text: str) -> str:
    """The text on one line, its line breaks and other unprintable characters written as Python writes them."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in text)


Key = tuple[tuple[int, int, str], ...]


@lru_cache(1 << 15)
def by_name(name: str) -> Key:
    """The key by which names are ordered: numbers in them by size, so that 10 comes after 9."""
    pieces = re.findall(r"\d+|\D+", name)
    return tuple((0, len(piece.lstrip("0")), piece.lstrip("0") + piece) if piece.isdecimal() else (1, 0, piece)
                 for piece in pieces)


@dataclass(frozen=True)
class Fault:
    """One thing that is wrong with a scene: where it stands, what is wrong, what would be right."""

    where: str
    what: str
    instead: str

    def __str__(self) -> str:
        return f"{self.where}: {self.what}; {self.instead}"


class GraphplanError(Exception):
    """What all errors of graphplan have in common: one readable line, and an exit status."""

    status = 2

    @property
    def lines(self) -> tuple[str, ...]:
        """The error as lines for standard error."""
        return (str(self),)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the error by its text and attributes, as worker processes send it."""
        return copyreg.__newobj__, (type(self), *self.args), self.__dict__  # type: ignore[attr-defined]


class SceneError(GraphplanError):
    """A scene that cannot be read: all its faults at once, one line each.

    `name` is the scene's file as the user wrote it.
    """

    def __init__(self, name: str, faults: tuple[Fault, ...]):
        self.name, self.faults = name, tuple(faults)
        super().__init__("\n".join(self.lines))

    @property
    def lines(self) -> tuple[str, ...]:
        return tuple(f"{self.name}: {fault}" for fault in self.faults)


class Refused(GraphplanError):
    """A well-formed request that graphplan does not fulfil, with the reason and the way out."""

    def __init__(self, what: str, why: str, do: str):
        self.what, self.why, self.do = what, why, do
        super().__init__(f"{what}: {why}; {do}")

    def in_file(self, name: str) -> Refused:
        """The same with the file in front, where it is neither told already nor is it an option that is refused."""
        return self if self.what.startswith(("-", name)) else Refused(f"{name}: {self.what}", self.why, self.do)


def missing_package(where: str, package: str | None, extra: str, instead: str = "") -> Refused:
    """The refusal of a request that needs a package which is not installed, with the command that installs it."""
    remedy = f"pip install 'graphplan[{extra}]'"
    return Refused(where, f"{package} is not installed", f"{remedy}, or {instead}" if instead else remedy)


class SingularPose(GraphplanError):
    """A pose in which what was asked does not exist: the links, and the lines that should meet and don't."""

    status = 3

    def __init__(self, why: str, links: tuple[str, ...] = (), lines_that_miss: str = ""):
        self.why, self.lines_that_miss = why, lines_that_miss
        self.links = tuple(sorted(links, key=by_name))
        named = f" of links {', '.join(self.links)}" if links else ""
        missed = f": {lines_that_miss}" if lines_that_miss else ""
        super().__init__(f"singular pose{named}{missed}; {why}")


class NoMechanism(GraphplanError):
    """A synthesis whose construction does not exist: where in the task, why, and what would do."""

    status = 3

    def __init__(self, where: str, why: str, do: str):
        super().__init__(f"{where}: {why}; {do}")


class Disagreement(GraphplanError):
    """A construction and the analytic solver that differ, whatever way is taken: in what, and by how much."""

    status = 1

    def __init__(self, name: str, what: str, drawn: str, solved: str, gap: float):
        super().__init__(f"{name}: the construction and the analytic solver disagree; the {what} is {drawn} as drawn, "
                         f"{solved} as solved, {gap:.2g} of its size apart")


class BrokenClaim(Disagreement):
    """A drawn step that is not what it should be, such as a point off the line that it should lie on."""

    def __init__(self, name: str, step: str):
        GraphplanError.__init__(self, f"{name}: {step}")


class Undrawable(Exception):
    """Raised by a kernel rule, which does not know its step: a declared failure code and the reason."""

    def __init__(self, code: str, why: str):
        self.code, self.why = code, why
        super().__init__(f"{code}: {why}")


class ConstructionError(GraphplanError):
    """A step that cannot be drawn: its code, number, what it was to make, why, and what to do."""

    status = 3

    def __init__(self, code: str, step: int, drawing: str, why: str, do: str, links: tuple[str, ...] = ()):
        self.code, self.step, self.drawing, self.why, self.do, self.links = code, step, drawing, why, do, tuple(links)
        named = f" (links {', '.join(links)})" if links else ""
        super().__init__(f"{code} at step {step}{named}, {drawing}: {why}. Do: {do}")
