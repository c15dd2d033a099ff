"""Which steps of a program break a claim, and what is then wrong with them, in words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from graphplan.kernel.claims import TOLERANCE, Vector, unmet
from graphplan.kernel.kinds import Claim
from graphplan.kernel.program import Program, Step

# What a step is that breaks a claim, by the claim and, where that says it otherwise, by the kind of what is drawn.
# {0}, {1}, ... are the claim's operands.
BROKEN: dict[str, str] = {
    "stands": "not where it is given",
    "on": "not on {0}",
    "on line": "not through {0}",
    "heads": "not in the given direction",
    "runs": "not directed from {0} to {1}",
    "parallel": "not parallel to {0}, or it runs the other way",
    "perpendicular": "not perpendicular to {0}, or it runs the other way",
    "alike": "not parallel to {0}",
    "halfway": "not as far from {0} as from {1}, or it runs the other way",
    "shifted": "{2} does not lie to it as {1} lies to {0}",
    "span": "not as wide as {0} is from {1}",
    "measures": "not of the given length",
    "centre": "not centred at {0}",
    "opened": "not of the radius {0}",
    "way": "the other intersection of {0} with {1}",
    "side": "on the other side of the line from {0} to {1}",
    "ahead": "on the other side of {1} along {0}",
    "upright": "not square to {0} from {1}",
    "same": "{1} is not the vector {0}",
    "quarter": "{1} is not {0}, turned by 90°",
    "moved": "{0} is not the given vector",
    "laid": "not at the given distance from {1} along {0}",
    "along": "{0} is not parallel to {1}",
    "across": "{0} is not perpendicular to {1}",
    "away": "{0} points against {1}",
    "times": "{0} is not the given multiple of {1}",
    "times across": "{0} is not the given multiple of {1}, turned by 90°",
    "proportion": "it does not divide {3}{4} as {2} divides {0}{1}",
    "image": "{2}{3} is no side of the image of {0}{1}",
    "likeness": "not similar to {0}{1}{2}",
    "carried": "no similar figure has its other end on {4}",
    "locus": "trial figures have their third ends off it",
    "mean": "not the normal acceleration of {1} about {0}",
    "coriolis": "not the Coriolis acceleration of {1}",
    "balanced": "not where the error of the trials vanishes",
    "counters": "its moment about {0} does not balance the given force's",
    "counters afar": "it does not balance the given force with forces along {0} and {1}",
    "concurrent": "not concurrent with {0} and {1}",
    "turns": "not the given moment",
    "resists": "not the moment against the angular acceleration",
    "takes couple": "the force there has not the couple's moment",
    "touches": "the force there does not touch the friction circle",
    "leans": "not turned by the friction angle",
}


def broken(program: Program, values: Sequence[Any], tolerance: float = TOLERANCE) -> Iterator[str]:
    """All claims that a program breaks in one pose, in the letters of the sheet, the first step's first."""
    for step in program.steps:
        for claim, residual in unmet(step, values, tolerance):
            read = ", ".join(map(program.text, step.args))
            yield (f"step {program.number(step.index)} ({program.text(step.index)} = {step.op.name}({read})): "
                   f"{_broken(program, step, claim)}; by {residual:.1e} of its size")


def _broken(program: Program, step: Step, claim: Claim) -> str:
    """What a step is that breaks a claim, in the letters of the sheet."""
    def named(operand: int | Vector) -> str:
        if isinstance(operand, tuple):
            return " ".join(map(named, operand))
        return program.text((*step.args, step.index)[operand])

    kind, *operands = claim
    return BROKEN.get(f"{kind} {step.op.gives}", BROKEN[kind]).format(*map(named, operands))
