"""Stages: what textbooks tell of some steps at once, such as the velocity of a point, or of a form a semicircle.

A step bears the teller of its stage and not the words: these hang on the forms in which compounds are drawn, and of
most programs that are recorded nothing is told.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple, Protocol, Self, TypeVar

from graphplan.kernel.kinds import Choice
from graphplan.phrases import Said


class Knowledge(Enum):
    """Knowledge of a vector before its equation is drawn; textbooks underline it twice, once or not at all."""

    WHOLLY = "magnitude and direction"
    DIRECTION = "direction"
    LOCUS = "locus"  # a line on which it ends, drawn in a stage before
    NOTHING = "nothing"

    @property
    def lines(self) -> int:
        """Number of underlines: two, one if one number is unknown, or zero."""
        return {"magnitude and direction": 2, "nothing": 0}.get(self.value, 1)


class Vector(NamedTuple):
    """A vector by its letter, such as a^n_BA, the normal acceleration of B about A."""

    name: str
    known: Knowledge = Knowledge.WHOLLY


class Equation(NamedTuple):
    """An equation as it is written, and the vectors in it."""

    text: str
    vectors: tuple[Vector, ...]

    @property
    def underlines(self) -> list[tuple[int, int, int]]:
        """Of each vector as it is written, from which letter to which, and how many times it is underlined."""
        lined_places, at = list[tuple[int, int, int]](), 0
        for vector in self.vectors:
            start = self.text.find(name := vector.name.removeprefix("-"), at)
            if start >= 0:
                at = start + len(name)
                lined_places.append((start, at, vector.known.lines))
        return lined_places

    @classmethod
    def sum(cls, left: Vector, right: Iterable[Vector]) -> Self:
        """A vector is the sum of others."""
        vectors = left, *right
        return cls(f"{left.name} = {_sum_text(vectors[1:])}", vectors)

    @classmethod
    def zero_sum(cls, vectors: Iterable[Vector]) -> Self:
        """State that vectors have the sum zero."""
        terms = tuple(vectors)
        return cls(f"{_sum_text(terms)} = 0", terms)

    @classmethod
    def moments(cls, forces: Iterable[Vector], about: str, couples: Iterable[str] = ()) -> Self:
        """State that the moments of forces about a point, with those of couples, have the sum zero."""
        acting = tuple(forces)
        moments = [*(Vector(f"M_{about}({force.name})") for force in acting), *map(Vector, couples)]
        return cls(f"{_sum_text(moments)} = 0", acting)


def _sum_text(vectors: Iterable[Vector]) -> str:
    return " + ".join(vector.name for vector in vectors).replace("+ -", "- ")


@dataclass(frozen=True)
class Stage:
    """A part of a construction: its title, the law by which it is drawn, and the equations that it solves.

    It tells itself, where its words hang on no form.
    """

    title: Said
    law: Said
    equations: tuple[Equation, ...] = ()

    def __call__(self, forms: Collection[str]) -> Stage:
        return self

    @property
    def equation(self) -> str:
        """The equations, separated by semicolons; empty if there is no equation."""
        return "; ".join(equation.text for equation in self.equations)

    @property
    def balances(self) -> bool:
        """Whether its equations just balance, and do not give a vector by which one knows what it is for."""
        return any(equation.text.endswith("= 0") for equation in self.equations)

    @property
    def vectors(self) -> dict[str, Knowledge]:
        """Knowledge of each vector of the equations."""
        return {vector.name: vector.known for equation in self.equations for vector in equation.vectors}


Teller = Callable[[Collection[str]], Stage]  # tells a stage of which compounds are drawn in these forms


class Staged(Protocol):
    """A step as far as its stage is concerned."""

    @property
    def stage(self) -> Teller | None: ...

    @property
    def choice(self) -> Choice | None: ...


S = TypeVar("S", bound=Staged)


def tell_stages(steps: Sequence[Staged]) -> list[Stage | None]:
    """The stage of each step, told once all forms are known in which its compounds are drawn."""
    forms: dict[Teller, set[str]] = {}
    for step in steps:
        if step.stage:
            forms.setdefault(step.stage, set()).update([step.choice.form] if step.choice else ())
    stages = {teller: teller(drawn) for teller, drawn in forms.items()}
    return [stages[step.stage] if step.stage else None for step in steps]


def group_by_stage(steps: Sequence[S]) -> list[tuple[Stage, list[S]]]:
    """The stages of steps in their order, each with its consecutive steps; steps without a stage are left out.

    A stage that others interrupt, as where each reads the other, occurs once more.
    """
    groups: list[tuple[Stage, list[S]]] = []
    for step, stage in zip(steps, tell_stages(steps), strict=True):
        if stage and groups and groups[-1][0] == stage:
            groups[-1][1].append(step)
        elif stage:
            groups.append((stage, [step]))
    return groups
