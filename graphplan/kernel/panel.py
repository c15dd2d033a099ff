"""Panels: the plans that steps are drawn on, by their public names."""

from __future__ import annotations

from collections.abc import Collection
from typing import Self

from graphplan.phrases import Said, arrange, said


class Panel(str):
    """A plan that steps are drawn on: its public name, which knows how it is spoken of and what stands over it.

    `whole` is the plan that it is a part of: itself but where a plan is begun at several places. What it is made of is
    kept beside the name; nobody reads it out of the name.
    """

    words: Said
    heading: Said
    whole: Panel

    def __new__(cls, name: str = "", words: Said | None = None, heading: Said | None = None) -> Self:
        self = super().__new__(cls, name)
        self.words = words or arrange("{0}", name)
        self.heading, self.whole = heading or arrange("{0:capital}", self.words), self
        return self

    @property
    def twin(self) -> Panel:
        """The plan at whose scale it is drawn, too, if there are such."""
        return self

    def caption(self, kinds: Collection[str]) -> Said:
        """What stands over it; `kinds` are the kinds of vector drawn on it."""
        return self.heading

    def part(self, number: int) -> Panel:
        """The part of it that is begun as this one."""
        if number == 1:
            return self
        part = Panel(f"{self}, part {number}", said("{0}, part {1}", self.words, number))
        part.whole = self
        return part
