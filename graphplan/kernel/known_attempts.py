"""What forms gave where a compound was tried before: in the same place of drawings that are alike so far.

To compare forms a construction is drawn out many times, each time with another form preferred or with other words about
its steps. Up to the first compound that is then drawn otherwise all is as it was, and no form is tried once more.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from graphplan.kernel.coincidence import LyingLine
from graphplan.kernel.kinds import Primitive, Rating, plain
from graphplan.kernel.program import Board, Mark, Step


class Attempt(NamedTuple):
    """A form as it was tried: how well it draws, what came out, and what it put on the board, to be laid there again.

    `letters` are the marks that the form has a letter for, each with what it calls it.
    """

    rating: Rating
    out: Mark | None = None
    marks: Sequence[Mark] = ()
    values: Sequence[Any] = ()
    reach: Sequence[float] = ()
    lines: Sequence[LyingLine] = ()
    steps: Sequence[Step] = ()  # the marks', before anything is noted at them
    made: Mapping[int, tuple[str, tuple[Mark, ...]]] = {}
    letters: Sequence[tuple[Mark, str]] = ()


@dataclass(frozen=True)
class Tried:
    """The attempts at a compound while a form was `preferred`; the compounds `inside` its forms, whether lines `fell`
    on others by then, and which form of each compound was the best one last."""

    attempts: Sequence[Attempt]
    preferred: str
    inside: frozenset[Primitive]
    fell: bool
    last_best: Mapping[str, str]

    def serves(self, preferred: str) -> bool:
        """Whether the attempts are the same while another form is preferred: no compound inside has either."""
        names = {preferred, self.preferred} - {""}
        return preferred == self.preferred or not any(plain(form) in names for op in self.inside for form in op.forms)


@dataclass(eq=False)
class AlikeSoFar:
    """Drawings that are alike so far: what was tried next, and those that are alike after the same thing is drawn."""

    tried: dict[Hashable, Tried] = field(default_factory=dict)
    after: dict[Hashable, AlikeSoFar] = field(default_factory=dict)

    def next(self, drawn: Hashable) -> AlikeSoFar:
        """Those in which this is drawn next."""
        return self.after.setdefault(drawn, AlikeSoFar())


Start = tuple[Board, AlikeSoFar]  # an empty board, on which the marks of all attempts lie
_starts: ContextVar[dict[Hashable, Start] | None] = ContextVar("starts", default=None)


@contextmanager
def keep_attempts() -> Iterator[None]:
    """Inside, forms are tried once in the same place of drawings that are alike so far."""
    before = _starts.get()
    token = _starts.set({} if before is None else before)
    try:
        yield
    finally:
        _starts.reset(token)


def keeps_attempts() -> bool:
    """Whether attempts are kept for other drawings."""
    return _starts.get() is not None


def start(coplanar: bool, sheet: Hashable) -> Start:
    """Where drawings on a sheet begin, if it is like others: where attempts are kept on the board on which these were
    made, else on a new one."""
    starts = _starts.get()
    if starts is None or sheet is None:
        return Board(coplanar), AlikeSoFar()
    return starts.setdefault((coplanar, sheet), (Board(coplanar), AlikeSoFar()))
