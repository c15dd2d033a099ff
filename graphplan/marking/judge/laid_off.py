"""The vectors that steps lay off, in mechanics' words: which kind each is, of which points, and where it begins.

Textbooks also call the ends of normal and Coriolis accelerations by the link, as n_2, or by the points the other way
round, as n_AB; those of Coriolis by one of the two points, as k_A.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from graphplan.kernel.kinds import POINT, Movement, Primitive
from graphplan.kernel.program import Program, Step
from graphplan.methods.construction import Construction
from graphplan.methods.motion.acceleration import CORIOLIS, NORMAL
from graphplan.phrases import Phrase, Said, phrase

NORMAL_LETTER, CORIOLIS_LETTER = "n", "k"


def vector_letters(drawing: Construction) -> dict[str, int]:
    """The steps that make such ends, by every such name; of several of a link that which the others lead
    to, the last."""
    names = dict[str, int]()
    for step in drawing.drawn.steps:
        letter, _, of = step.name.partition("_")
        pair = next(_point_pairs(drawing, of), None) if letter in (NORMAL_LETTER, CORIOLIS_LETTER) else None
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
