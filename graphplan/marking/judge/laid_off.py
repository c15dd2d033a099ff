"""The vectors that steps lay off, in mechanics' words: which kind each is, of which points, and where it begins.

Textbooks also call the ends of normal and Coriolis accelerations by the link, as n_2, or by the points the other way
round, as n_AB; those of Coriolis by one of the two points, as k_A.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from graphplan.errors import Undrawable
from graphplan.kernel.drawing import Compound
from graphplan.kernel.kinds import POINT, Movement, Primitive, Sizing
from graphplan.kernel.numbers import Domain
from graphplan.kernel.program import Program, Step
from graphplan.mechanism.model import FRAME
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import VELOCITY
from graphplan.methods.motion.acceleration import CORIOLIS, NORMAL
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import Phrase, Said, phrase

NORMAL_LETTER, CORIOLIS_LETTER = "n", "k"


def vector_letters(drawing: Construction, kinds: str = NORMAL_LETTER + CORIOLIS_LETTER) -> dict[str, int]:
    """The steps that make such ends of some kinds, by every such name; of several of a link that which the others lead
    to, the last."""
    names = dict[str, int]()
    for step in drawing.drawn.steps:
        letter, _, of = step.name.partition("_")
        pair = next(_point_pairs(drawing, of), None) if letter and letter in kinds else None
        if pair:
            points = pair if letter == CORIOLIS_LETTER else ()
            links = [name for name, link in drawing.scene.links.items()
                     if letter == NORMAL_LETTER and {*pair} <= {*link}]
            names |= {f"{letter}_{low}": step.index for low in ("".join(reversed(pair)), *points, *links)}
    return names


def _point_pairs(drawing: Construction, letters: str) -> Iterator[tuple[str, str]]:
    """The two points that some letters name one after the other."""
    points = drawing.scene.points
    return ((letters[:at], letters[at:]) for at in range(1, len(letters))
            if letters[:at] in points and letters[at:] in points)


NORMAL_VECTOR = phrase("the normal acceleration of {0} about {1}")
CORIOLIS_VECTOR = phrase("the Coriolis acceleration of {0} relative to {1}")
STAGE_VECTOR, VECTOR = phrase("the vector {0}"), phrase("the vector")
LAW_VECTOR_WORDS = {NORMAL_VECTOR: phrase("normal acceleration"), CORIOLIS_VECTOR: phrase("Coriolis acceleration")}


@dataclass(frozen=True)
class LaidOffVector:
    """A vector that steps lay off: of which kind it is and of which points, and the mark at which it begins."""

    words: Phrase
    of: tuple[str, ...]
    start: int | None

    @property
    def text(self) -> Said:
        """The vector in mechanics' words."""
        return self.words(*self.of)


def vector_at(program: Program, step: Step, plan_of_step: Sequence[str]) -> LaidOffVector | None:
    """What a step lays off, or that in whose end its mark lies; None where it is no vector's end."""
    return (_vector_of if lays_off_vector(step.op) else _similar_vector)(program, step, plan_of_step)


def _vector_of(program: Program, step: Step, plan_of_step: Sequence[str]) -> LaidOffVector:
    """What a step lays off, whole or in part, as the steps of its stage say that are drawn on the same plan."""
    alike = [stage_step for stage_step in program.steps if stage_step.index == step.index or (
        step.stage is not None and stage_step.stage is step.stage
        and plan_of_step[stage_step.index] == plan_of_step[step.index])]
    for law, words in ((NORMAL, NORMAL_VECTOR), (CORIOLIS, CORIOLIS_VECTOR)):
        for stage_step in alike:
            if isinstance(stage_step.why, Said) and law.says(stage_step.why):
                start, stage_steps = step.root, {part_step.index for part_step in alike}
                while start in stage_steps and (root := program.steps[start].root) is not None:
                    start = root
                return LaidOffVector(words, stage_step.why.put, start)
    equations = step.stage(()).equations if step.stage and step.name else ()
    if equations and equations[0].vectors:
        return LaidOffVector(STAGE_VECTOR, (equations[0].vectors[0].name,), step.root)
    return LaidOffVector(VECTOR, (), step.root)


def _similar_vector(program: Program, step: Step, plan_of_step: Sequence[str]) -> LaidOffVector | None:
    """The normal acceleration in whose end a mark lies that is found by a similar figure, as its letters n_PQ say, and
    another about the same point is laid off; None where it is no such mark."""
    letter, _, of = step.name.partition("_")
    for other in program.steps[:step.index] if letter == NORMAL_LETTER and step.op.gives == POINT else ():
        if lays_off_vector(other.op) and other.name.startswith(f"{NORMAL_LETTER}_"):
            vector = _vector_of(program, other, plan_of_step)
            centre = vector.of[-1] if vector.words is NORMAL_VECTOR else ""
            if centre and of.endswith(centre) and of != centre:
                return LaidOffVector(NORMAL_VECTOR, (of.removesuffix(centre), centre), vector.start)
    return None


def lays_off_vector(op: Primitive) -> bool:
    """The operations that lay a vector off."""
    return op.root is not None and op.movement is not Movement.DROPPED


@dataclass(frozen=True)
class ComputedVectors:
    """The normal and Coriolis accelerations of a construction as they are computed, v²/r and 2 ω v of the student's own
    velocities, instead of found by figures; `plan_of_step` is the plan of every step."""

    drawing: Construction
    plan_of_step: Sequence[str]

    def value(self, index: int, own: Sequence[Any], domain: Domain) -> Any:
        """Where the end of such a vector would be, by the student's marks so far; None where it is none, or where no
        velocities are known that it could be computed from."""
        if index in self._coriolis:
            coriolis = self._coriolis[index].step
            with suppress(Undrawable):
                return coriolis.op.rule(domain, *(own[arg] for arg in coriolis.args), **coriolis.params)
            return None
        vector = self._vectors.get(index)
        if vector is None:
            return None
        (P, u), (Q, w) = ((own[place], self._velocity(name, own)) for name, place in vector[1])
        arm, speed = (Q[0] - P[0], Q[1] - P[1]), (u[0] - w[0], u[1] - w[1])
        square = arm[0] * arm[0] + arm[1] * arm[1]
        if not float(getattr(square, "value", square)):
            return None
        ratio = (speed[0] * speed[0] + speed[1] * speed[1]) / square
        start = own[vector[0]]
        return start[0] + ratio * arm[0], start[1] + ratio * arm[1]

    def coriolis_figure(self, index: int) -> set[int] | None:
        """The steps on the mechanism that find a Coriolis acceleration, by the step that ends it; None where none does.
        """
        if (compound := self._coriolis.get(index)) is None:
            return None
        return {movement.index for movement in compound.movements if self.plan_of_step[movement.index] == MECHANISM}

    @cached_property
    def _coriolis(self) -> Mapping[int, Compound]:
        """The Coriolis accelerations, by the steps that end them."""
        return {compound.step.index: compound for compound in self.drawing.compounds
                if compound.step.op.sizing is Sizing.DOUBLE and len(compound.movements) > 1}

    def _velocity(self, name: str, own: Sequence[Any]) -> tuple[Any, Any]:
        """The velocity of a point, as drawn: none of a point of the frame."""
        if name not in self._ends:
            return 0.0, 0.0
        start, end = (own[mark] for mark in self._ends[name])
        return end[0] - start[0], end[1] - start[1]

    @cached_property
    def _ends(self) -> Mapping[str, tuple[int, int]]:
        """The marks between which the velocities of points lie."""
        wanted_steps = self.drawing.drawn.wanted
        return {reading.of: (wanted_steps[reading.marks[-2]], wanted_steps[reading.marks[-1]])
                for reading in self.drawing.readings if reading.kind == VELOCITY and len(reading.marks) > 1}

    @cached_property
    def _vectors(self) -> Mapping[int, tuple[int, list[tuple[str, int]]]]:
        """By the steps that end them, where the vectors begin, and their two points, each with its place in the pose.
        """
        drawn, scene = self.drawing.drawn, self.drawing.scene
        places = {scene.points[step.name]: step.index for step in drawn.steps[:drawn.givens]
                  if step.name in scene.points}
        vectors = dict[int, tuple[int, list[tuple[str, int]]]]()
        for step in drawn.steps[drawn.givens:]:
            vector = vector_at(drawn, step, self.plan_of_step) if step.name and step.op.gives == POINT else None
            if vector and vector.words is NORMAL_VECTOR and vector.start is not None:
                ends = [(name, places[scene.points[name]]) for name in vector.of if scene.points.get(name) in places]
                known = all(name in self._ends or name in scene.links.get(FRAME, ()) for name, _ in ends)
                if len(ends) == 2 and known and ends[0][1] != ends[1][1]:
                    vectors[step.index] = vector.start, ends
        return vectors
