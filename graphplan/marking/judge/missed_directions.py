"""Which direction a locus was drawn in by mistake, along another side of a link or at right angles to one, and how
many times too long a vector is, or from where it is laid off."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

from graphplan.kernel.kinds import LINE, POINT, Movement
from graphplan.kernel.program import Step
from graphplan.marking.judge import measures
from graphplan.marking.judge.laid_off import vector_at
from graphplan.marking.judge.matching import Matching
from graphplan.marking.judge.mistakes import DEEDS, base_of
from graphplan.marking.judge.student_sheet import plain_value
from graphplan.mechanism.model import Scene
from graphplan.phrases import Phrase, Said, digits, phrase, said

OTHER_SIDES: tuple[tuple[Phrase, complex], ...] = (
    (phrase("parallel to {0} instead of {1}"), 1), (phrase("perpendicular to {0} instead of {1}"), 1j))


def wrong_direction(matching: Matching, line: Step, mark: complex, allowed: float) -> Said | None:
    """The direction that a locus must have been given, as a mark lies on it that is not on the true one; None where it
    is that of no side. `mark` and `allowed`, how far off it may be, are in units of its plan."""
    program = matching.sheet.drawing.drawn
    first, last, turn = base_of(program, line)
    throughs = [arg for arg in (line.args if line.op.movement is Movement.RULED else line.args[-1:])
                if program.steps[arg].op.gives == POINT]
    rays = [mark - _spot(matching, arg) for arg in throughs]
    names, own_text = set[str](), program.text(line.index)  # of a guide's line there is no side
    if first is not None and last is not None:
        names, own_text = {program.steps[end].name for end in (first, last)}, program.text(first) + program.text(last)
        own_side = _spot(matching, last) - _spot(matching, first)
        if any(_is_along(ray, own_side * turn * 1j, allowed) for ray in rays):
            return said("parallel to {0}, not perpendicular" if turn.imag else "perpendicular to {0}, not parallel",
                        own_text)
    for P, Q, side in _sides(matching.sheet.drawing.scene):
        for words, quarter in OTHER_SIDES:
            if {P, Q} != names and any(_is_along(ray, side * quarter, allowed) for ray in rays):
                return words(P + Q, own_text)
    return None


def _is_along(ray: complex, direction: complex, allowed: float) -> bool:
    """Whether the end of a ray lies on the line in a direction."""
    gap = abs((ray.conjugate() * direction).imag) / abs(direction)
    return gap < allowed + measures.DIRECTION_SHARE * abs(ray) and allowed < abs(ray)


def _sides(scene: Scene) -> Iterator[tuple[str, str, complex]]:
    """The sides of the links, by the points that they join, each with its direction, whether it is drawn or not."""
    for P, Q in dict.fromkeys(pair for points in scene.links.values() for pair in combinations(points, 2)):
        (x, y), (u, v) = (map(float, scene.points[name]) for name in (P, Q))
        if (side := complex(u - x, v - y)):
            yield P, Q, side


def wrong_vector(matching: Matching, step: Step, mark: complex, allowed: float) -> Said | None:
    """From which mark a vector is laid off by mistake, or how many times too long it is: one that ends in this step's
    mark, or without a mark of its own on the line of this step; None where it is neither, or there is none."""
    program = matching.sheet.drawing.drawn
    end = step if step.op.gives == POINT else program.steps[step.args[-1]]
    vector = vector_at(program, end, matching.sheet.plan_of_step) if end.op.gives == POINT else None
    if vector is None or vector.start is None or (end is not step and matching.matches[end.index].place is not None):
        return None
    start = _spot(matching, vector.start)
    tip = complex(*plain_value(matching.matches[end.index].expected)[:2]) if end is step else _spot(matching, end.index)
    across = complex(*plain_value(matching.own[step.index])[:2]) if end is not step else None
    for rival in _other_starts(matching, end.index, vector.start):
        gap = mark - tip - _spot(matching, rival) + start
        if (abs(gap) if across is None else abs((gap.conjugate() * across).real) / abs(across)) < allowed:
            return said("laid off from {0} instead of {1}", program.text(rival), program.text(vector.start))
    ratio = _ratio_along(tip - start, mark - start, across, allowed)
    if ratio > 0 and abs(ratio - 1) > measures.ROUND_SCALE_TOL:
        return said("{0} is {1} times as long as it should be", vector.text, digits(ratio, 2))
    return None


def omission(matching: Matching, mistaken: Step) -> Said | None:
    """That a vector was omitted, where a line is drawn through the mark at which it begins and its end is not seen;
    None where it is not so."""
    program = matching.sheet.drawing.drawn
    for right, wrong in zip(matching.steps[mistaken.index].args, mistaken.args, strict=True):
        end = program.steps[right]
        vector = right != wrong and matching.matches[right].place is None and end.op.gives == POINT and vector_at(
            program, end, matching.sheet.plan_of_step)
        if vector and vector.start == wrong and mistaken.op.gives == LINE:
            return DEEDS["omitted"][0](vector.text)
    return None


def _ratio_along(vector: complex, ray: complex, across: complex | None, allowed: float) -> float:
    """How many times a vector must be as long to end this way off, or on the line there `across` which a direction
    goes; nothing where it ends beside, or cannot end there."""
    if across is None:
        misses = not vector or abs((ray.conjugate() * vector).imag) > allowed * abs(vector)
        return 0.0 if misses else (ray / vector).real
    reach = (vector.conjugate() * across).real
    is_flat = abs(reach) < measures.MIN_CROSSING_SINE * abs(vector) * abs(across)
    return 0.0 if is_flat else (ray.conjugate() * across).real / reach


def _other_starts(matching: Matching, end: int, start: int) -> Iterator[int]:
    """The other marks with letters on the plan of a vector, none of them its own ends."""
    homes = matching.sheet.plan_of_step
    return (index for index in matching.labels if matching.steps[index].op.gives == POINT
            and homes[index] == homes[end] and index not in (start, end) and matching.matches[index].place is not None)


def _spot(matching: Matching, index: int) -> complex:
    """Where a mark is on its plan, as it is drawn."""
    return complex(*plain_value(matching.own[index])[:2])
