"""The mistakes that are made on drawing boards: each is a step that is drawn instead of another.

A mistake of the table says of which operations it can be made, by what their records say, and which steps it makes. The
same table finds the mistake that a drawing shows, and seeds the drawings that the finding is tested on.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

from graphplan.errors import Undrawable
from graphplan.kernel.kinds import CIRCLE, DIVIDERS, LINE, POINT, Movement, Primitive, made_by
from graphplan.kernel.numbers import Domain, Floats
from graphplan.kernel.positions import Angle
from graphplan.kernel.program import Program, Step
from graphplan.marking.judge import measures
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import ACCELERATION, VELOCITY
from graphplan.methods.motion.acceleration import CORIOLIS, NORMAL
from graphplan.phrases import Phrase, Said, digits, phrase, said

# ---- a step that is drawn by mistake --------------------------------------------------------------------------------

# One mistake: a step that is drawn instead of another, with another operation, other marks read, a vector
# turned, too long or elsewhere; so its rule gives what it makes, in any domain of numbers.


@dataclass(frozen=True)
class Mistake:
    """A step as it is drawn by mistake: its kind, how it is told, and the step; what is laid off, from its root or
    from the mark `start`, or the radius, is multiplied by `factor`, and by the distance of the first two marks of
    `radii` over that of the others; a point, or a line through the first of them, is mirrored in the line of two marks;
    a point is turned by a `half_turn` about the middle of two; or what is laid off from `start` is so from `other`,
    another mark, or one that this step makes later.
    """

    kind: str
    text: Said
    step: Step
    factor: complex = 1.0
    mirror: tuple[int, int] | None = None
    start: int | None = None
    radii: tuple[int, int, int, int] | None = None
    half_turn: tuple[int, int] | None = None
    other: int | Step | None = None

    @property
    def reads(self) -> tuple[int, ...]:
        """All marks that it is made of."""
        other_marks = self.other.args if isinstance(self.other, Step) else (self.other,)
        mark_groups = self.step.args, self.mirror, (self.start,), self.radii, self.half_turn, other_marks
        return tuple(mark for marks in mark_groups for mark in marks or () if mark is not None)

    def value(self, domain: Domain, values: list[Any] | dict[int, Any]) -> Any:
        """Value of the mistake from these marks; fails as the step's rule does."""
        result = _made_by(self.step, domain, values)
        if self.other is not None and self.start is not None:
            start = values[self.start]
            root = _made_by(self.other, domain, values) if isinstance(self.other, Step) else values[self.other]
            return root[0] + result[0] - start[0], root[1] + result[1] - start[1]
        if self.half_turn:
            P, Q = (values[mark] for mark in self.half_turn)
            return P[0] + Q[0] - result[0], P[1] + Q[1] - result[1]
        if self.mirror:
            return (_mirror_line if self.step.op.gives == LINE else _mirror_point)(
                domain, result, *(values[arg] for arg in self.mirror))
        if self.factor == 1.0 and not self.radii:
            return result
        if self.step.op.gives == CIRCLE:
            return *result[:2], result[2] * abs(self.factor) ** 2
        root = self.step.root if self.start is None else self.start
        assert root is not None, f"{self.step.op.name} lays nothing off"
        start = values[root]
        ratio = _distance_ratio(domain, *(values[mark] for mark in self.radii)) if self.radii else 1.0
        dx, dy, c, s = result[0] - start[0], result[1] - start[1], self.factor.real * ratio, self.factor.imag * ratio
        return start[0] + c * dx - s * dy, start[1] + s * dx + c * dy


def value_of(step: Step, values: list[Any] | dict[int, Any], mistake: Mistake | None
             ) -> tuple[float, ...] | None:
    """Value of a step from plain values, or of a mistake at it; None if it cannot be drawn."""
    try:
        result: tuple[float, ...] = mistake.value(Floats(), values) if mistake else _made_by(step, Floats(), values)
    except Undrawable:
        return None
    return result if all(map(math.isfinite, result)) else None


def _made_by(step: Step, domain: Domain, values: list[Any] | dict[int, Any]) -> Any:
    """Value of a step from these marks; fails as its rule does."""
    return step.op.rule(domain, *[values[arg] for arg in step.args], **step.params)


def _mirror_point(domain: Domain, point: Any, P: Any, Q: Any) -> Any:
    """A point on the other side of the line PQ."""
    u, w = (Q[0] - P[0], Q[1] - P[1]), (point[0] - P[0], point[1] - P[1])
    square = domain.nonzero(u[0] * u[0] + u[1] * u[1], 1.0, "points-coincide", "the two points coincide")
    along = (u[0] * w[0] + u[1] * w[1]) / square
    return P[0] + 2 * along * u[0] - w[0], P[1] + 2 * along * u[1] - w[1]


def _mirror_line(domain: Domain, line: Any, P: Any, Q: Any) -> Any:
    """A line through P on the other side of the line PQ."""
    away = P[0] + line[1], P[1] - line[0]
    x, y = _mirror_point(domain, away, P, Q)
    a, b = P[1] - y, x - P[0]
    return a, b, -(a * P[0] + b * P[1])


def _distance_ratio(domain: Domain, P: Any, Q: Any, R: Any, S: Any) -> Any:
    """The distance PQ over the distance RS."""
    first_square, second_square = ((B[0] - A[0]) * (B[0] - A[0]) + (B[1] - A[1]) * (B[1] - A[1])
                                   for A, B in ((P, Q), (R, S)))
    return domain.sqrt(first_square / domain.nonzero(second_square, 1.0, "points-coincide", "the two points coincide"),
                       "", "")


# ---- vectors that are laid off --------------------------------------------------------------------------------------

# The vectors that steps lay off, in mechanics' words: which kind each is, of which points, and where it begins.
# Textbooks also call the ends of normal and Coriolis accelerations by the link, as n_2, or by the points the other
# way round, as n_AB; those of Coriolis by one of the two points, as k_A.


NORMAL_LETTER, CORIOLIS_LETTER = "n", "k"
END_LETTERS = {VELOCITY: "v", ACCELERATION: "a"}


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
    for reading in drawing.readings if not drawing.turned else ():  # from a pole ends bear the letters of points
        if reading.kind in END_LETTERS:
            names[f"{END_LETTERS[reading.kind]}_{reading.of}"] = drawing.drawn.wanted[reading.marks[-1]]
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
    """Vector that a step lays off, or at whose end its mark lies; None if the mark is no vector's end."""
    return (_vector_of if lays_off_vector(step.op) else _similar_vector)(program, step, plan_of_step)


def _vector_of(program: Program, step: Step, plan_of_step: Sequence[str]) -> LaidOffVector:
    """Vector that a step lays off, whole or in part, by the steps of its stage on the same plan."""
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


# ---- the table ------------------------------------------------------------------------------------------------------

@dataclass(frozen=True)
class Occasion:
    """A step of a program at which a mistake of a kind can be made; `plan_of_step` is the plan of every step, `links`
    the given points of each link, `vector` what the step lays off, if anything."""

    kind: str
    program: Program
    step: Step
    plan_of_step: Sequence[str]
    links: Sequence[Sequence[int]]
    vector: LaidOffVector | None = None

    def text(self, place: int = 0) -> str:
        """Letters of the operand at a place."""
        return self.program.text(self.step.args[place])

    def mistaken_step(self, told: Said, factor: complex = 1.0, mirror: tuple[int, int] | None = None,
                      start: int | None = None,
                      radii: tuple[int, int, int, int] | None = None, **changed: Any) -> Mistake:
        """The step as it is drawn by mistake, with something changed."""
        return Mistake(self.kind, told, self.step.but(**changed), factor, mirror, start, radii)

    def given_point(self, name: str) -> int | None:
        """The given point of this name."""
        return next((step.index for step in self.program.steps[:self.program.givens] if step.name == name), None)

    @property
    def sides(self) -> list[tuple[int, int]]:
        """The given points that a step joins, two by two, or that lie on a link together: sides of links."""
        givens = self.program.givens
        joined = (step.args for step in self.program.steps if step.op.spans or step.op.root is not None)
        pairs = [(args[0], args[1]) for args in joined if len(args) > 1 and max(args[:2]) < givens]
        pairs += [pair for points in self.links for pair in combinations(points, 2)]
        return list({frozenset(pair): pair for pair in reversed(pairs) if pair[0] != pair[1]}.values())[::-1]

    def are_figure_sides(self, lines: Iterable[Step]) -> bool:
        """Whether lines follow two sides of a link that meet in one of its points, so that they cross in the image of
        that; two loci of a vector do not."""
        ends = [{first, last} for first, last, _ in (base_of(self.program, line) for line in lines)]
        corners = set[int | None]().union(*ends)
        return len(corners) == 3 and any(corners <= set(points) for points in self.links)

    def with_other_marks(self, told: Phrase, *places: int) -> Iterator[Mistake]:
        """The step with another mark, of the same kind and plan, read at a place, told by the names of both."""
        step = self.step
        for place in places:
            kind, home = step.op.reads[place], self.plan_of_step[step.args[place]]
            for earlier in self.program.steps[:step.index]:
                if (earlier.op.gives == kind and self.plan_of_step[earlier.index] == home
                    and earlier.index not in step.args):
                    args = (*step.args[:place], earlier.index, *step.args[place + 1:])
                    yield self.mistaken_step(told(self.program.text(earlier.index), self.text(place)), args=args)


Rule = Callable[[Occasion], Iterable[Mistake]]
Operations = Callable[[Primitive], bool]


@dataclass(frozen=True)
class MistakeKind:
    """One kind of mistake: how it is told of a class, at which operations it can be made, and as which steps; one
    `of_vector` also where the end of a vector is found by a similar figure."""

    words: Callable[[], Said]
    at: Operations
    rule: Rule
    of_vector: bool = False


MISTAKES: dict[str, MistakeKind] = {}


def enter_mistake(kind: str, words: Callable[[], Said], at: Operations, of_vector: bool = False
                  ) -> Callable[[Rule], Rule]:
    """Enter the decorated rule in the table."""

    def enter(rule: Rule) -> Rule:
        MISTAKES[kind] = MistakeKind(words, at, rule, of_vector)
        return rule

    return enter


def for_movements(*movements: Movement) -> Operations:
    """The operations of some movements."""
    return lambda op: op.movement in movements


def possible_mistakes(program: Program, step: Step, plan_of_step: Sequence[str], links: Sequence[Sequence[int]]
                      ) -> Iterator[Mistake]:
    """All the mistakes of the table that can be made at a step; `links` are the given points of each link."""
    is_laid_off = lays_off_vector(step.op)
    vector = vector_at(program, step, plan_of_step)
    for kind, entry in MISTAKES.items():
        if entry.of_vector if vector and not is_laid_off else entry.at(step.op):
            yield from entry.rule(Occasion(kind, program, step, plan_of_step, links, vector))


ALIGNED = for_movements(Movement.PARALLEL, Movement.PERPENDICULAR)


def base_of(program: Program, line: Step) -> tuple[int | None, int | None, complex]:
    """The two marks whose line a locus follows through parallels and perpendiculars, and whether it is turned from
    that by a right angle, as a factor."""
    turn: complex = 1
    while ALIGNED(line.op) and program.steps[line.args[0]].op.gives == LINE:
        turn = (1j if turn == 1 else 1) if line.op.movement is Movement.PERPENDICULAR else turn
        line = program.steps[line.args[0]]
    is_ruled = line.op.movement is Movement.RULED and len(line.args) > 1
    return (line.args[0], line.args[1], turn) if is_ruled else (None, None, turn)


@enter_mistake("perpendicular missed", phrase("parallel instead of perpendicular"),
               for_movements(Movement.PERPENDICULAR))
def _(at: Occasion) -> Iterable[Mistake]:
    return [at.mistaken_step(said("parallel to {0}, not perpendicular", at.text()), op=made_by(Movement.PARALLEL))]


@enter_mistake("parallel missed", phrase("perpendicular instead of parallel"), for_movements(Movement.PARALLEL))
def _(at: Occasion) -> Iterable[Mistake]:
    return [at.mistaken_step(said("perpendicular to {0}, not parallel", at.text()), op=made_by(Movement.PERPENDICULAR))]


@enter_mistake("wrong side", phrase("the other of the two crossings"), lambda op: op.crossing and bool(op.reversal))
def _(at: Occasion) -> Iterable[Mistake]:
    return [] if _figure_ends(at) else [at.mistaken_step(said("the other of the two crossings"),
                                                         params=at.step.op.reverse_parameters(at.step.params))]


def _figure_ends(at: Occasion) -> tuple[int, int] | None:
    """The two marks with letters about which the arcs are struck that cross in the third corner of their figure."""
    steps = at.program.steps
    ends = [steps[arc].args[0] for arc in at.step.args] if at.step.op.movement is Movement.ARCS_MET else []
    is_figure = len({*ends}) == 2 and all(end >= at.program.givens and steps[end].name for end in ends)
    return (ends[0], ends[1]) if is_figure else None


@enter_mistake("mirrored figure", phrase("the figure is mirrored"),
               for_movements(Movement.MET, Movement.PARALLEL, Movement.PERPENDICULAR, Movement.ARCS_MET))
def _(at: Occasion) -> Iterable[Mistake]:
    """The third corner of a figure, or a side to it, on the other side of the line of the two others."""
    if ends := _figure_ends(at):
        yield at.mistaken_step(said("the figure is mirrored"), mirror=ends)
    corners = [at.step] if at.step.op.gives == POINT else [
        step for step in at.program.steps if step.op.movement is Movement.MET and at.step.index in step.args]
    for corner in corners:
        lines = [line for line in map(at.program.steps.__getitem__, corner.args) if ALIGNED(line.op)]
        lines.sort(key=lambda line: line.index != at.step.index)
        through = [line.args[-1] for line in lines]
        if len(set(through)) == 2 and max(through) < at.step.index and at.are_figure_sides(lines):
            yield at.mistaken_step(said("the figure is mirrored"), mirror=(through[0], through[1]))


@enter_mistake("exchanged directions", phrase("the directions of two lines exchanged"), for_movements(Movement.MET))
def _(at: Occasion) -> Iterable[Mistake]:
    """Exchanged directions of two lines through given points: their crossing is the mark turned by half a turn about
    the middle of those points."""
    lines = [at.program.steps[arg] for arg in at.step.args]
    if all(ALIGNED(line.op) for line in lines) and lines[0].args[0] != lines[1].args[0]:
        P, Q = (line.args[-1] for line in lines)
        if P != Q:
            yield replace(at.mistaken_step(said("the directions of the lines through {0} and {1} are exchanged",
                                                at.program.text(P), at.program.text(Q))), half_turn=(P, Q))


DEEDS: dict[str, tuple[Phrase, tuple[complex, ...]]] = {
    "omitted": (phrase("{0} omitted"), (0.0,)),
    "reversed": (phrase("{0} reversed"), (-1.0,)),
    "turned the wrong way": (phrase("{0} turned the wrong way"), (1j, -1j)),
    "halved": (phrase("{0} halved"), (0.5,)),
    "doubled": (phrase("{0} doubled"), (2.0,)),
}


def _enter_deed(words: Phrase | None, deed: str) -> None:
    """Enter a mistake with the vectors of a law, or with any vector, in the table."""
    deed_phrase, factors = DEEDS[deed]
    thing = LAW_VECTOR_WORDS[words] if words else phrase("a vector")

    def rule(at: Occasion) -> Iterable[Mistake]:
        assert at.vector is not None
        if (at.vector.words if at.vector.words in LAW_VECTOR_WORDS else None) is words:
            for factor in factors:
                yield at.mistaken_step(deed_phrase(at.vector.text), factor, start=at.vector.start)

    enter_mistake(f"{thing()} {deed}" if words else deed, lambda: deed_phrase(thing()), lays_off_vector,
                  of_vector=True)(rule)


for _words in (*LAW_VECTOR_WORDS, None):
    for _deed in DEEDS:
        _enter_deed(_words, _deed)


@enter_mistake("wrong scale", phrase("a vector of the wrong length"), lays_off_vector, of_vector=True)
def _(at: Occasion) -> Iterable[Mistake]:
    assert at.vector is not None
    return [at.mistaken_step(said("{0} is {1} times as long as it should be", at.vector.text, digits(factor, 2)),
                             factor,
                             start=at.vector.start) for factor in measures.SCALE_FACTORS]


@enter_mistake("wrong radius", phrase("a normal acceleration over the wrong radius"), lays_off_vector,
               of_vector=True)
def _(at: Occasion) -> Iterable[Mistake]:
    """The square of the velocity over the length of another link."""
    assert at.vector is not None
    ends = [at.given_point(name) for name in at.vector.of] if at.vector.words is NORMAL_VECTOR else []
    if len(ends) == 2 and None not in ends:
        one, other = (end for end in ends if end is not None)
        for P, Q in at.sides:
            if {P, Q} != {one, other}:
                told = said("{0} with the radius {1}{2} instead of {3}{4}", at.vector.text, *map(
                    at.program.text, (P, Q)), *at.vector.of)
                yield at.mistaken_step(told, start=at.vector.start, radii=(one, other, P, Q))


@enter_mistake("wrong line", phrase("parallel or perpendicular to the wrong line"), ALIGNED)
def _(at: Occasion) -> Iterable[Mistake]:
    return at.with_other_marks(phrase("parallel to {0} instead of {1}") if at.step.op.movement is Movement.PARALLEL
                               else phrase("perpendicular to {0} instead of {1}"), 0)


@enter_mistake("wrong point", phrase("drawn through the wrong point"),
               for_movements(Movement.PARALLEL, Movement.PERPENDICULAR, Movement.RULED, Movement.DROPPED))
def _(at: Occasion) -> Iterable[Mistake]:
    places = (place for place, kind in enumerate(at.step.op.reads) if kind == POINT)
    return at.with_other_marks(phrase("drawn through {0} instead of {1}"), *places)


@enter_mistake("wrong crossing", phrase("the wrong lines crossed"), lambda op: op.crossing)
def _(at: Occasion) -> Iterable[Mistake]:
    return at.with_other_marks(phrase("marked on {0} instead of {1}"), *range(len(at.step.args)))


@enter_mistake("wrong start", phrase("laid off from the wrong point"), lays_off_vector, of_vector=True)
def _(at: Occasion) -> Iterable[Mistake]:
    """From another mark of its plan; also from one that the task draws later, but of marks that are there before."""
    told, program, step = phrase("laid off from {0} instead of {1}"), at.program, at.step
    if at.vector is None or (start := at.vector.start) is None:
        return
    for rival in program.steps:
        if (rival.index not in (start, step.index, *step.args) and rival.op.gives == POINT
            and at.plan_of_step[rival.index] == at.plan_of_step[start]):
            mistake = at.mistaken_step(told(program.text(rival.index), program.text(start)), start=start)
            if rival.index < step.index:
                yield replace(mistake, other=rival.index)
            elif rival.name and max(rival.args, default=step.index) < step.index:
                yield replace(mistake, other=rival)


@enter_mistake("wrong vector", phrase("the wrong vector carried over"),
               lambda op: op.movement is Movement.HALVED or (lays_off_vector(op) and op.instrument == DIVIDERS))
def _(at: Occasion) -> Iterable[Mistake]:
    return at.with_other_marks(phrase("taken from {0} instead of {1}"), 0, 1)


@enter_mistake("wrong centre", phrase("struck about the wrong centre"), for_movements(Movement.STRUCK))
def _(at: Occasion) -> Iterable[Mistake]:
    return at.with_other_marks(phrase("struck about {0} instead of {1}"), 0)


@enter_mistake("wrong opening", phrase("struck with the wrong opening"), for_movements(Movement.STRUCK))
def _(at: Occasion) -> Iterable[Mistake]:
    for factor in (2.0, 0.5):
        yield at.mistaken_step(said("the radius is {0} times as large as it should be", digits(factor, 2)), factor)
    yield from at.with_other_marks(phrase("struck with {0} instead of {1}"), 1)


@enter_mistake("wrong angle", phrase("an angle of the wrong size"), for_movements(Movement.INCLINED))
def _(at: Occasion) -> Iterable[Mistake]:
    """Counted clockwise or from another axis, doubled or halved, from the nearest axis."""
    angle, quarter = at.step.params["angle"], measures.QUARTER_DEGREES
    right = math.degrees(math.atan2(angle.y, angle.x))
    wrong_angles = [quarter * turns - right for turns in range(3)]
    for axis in (turn * round(right / turn) for turn in (quarter, 2 * quarter)):
        wrong_angles += [2 * right - axis, (right + axis) / 2]
    for wrong in wrong_angles:
        if abs(wrong - right) % 180:
            told, u = said("the angle is {0}° instead of {1}°", *map(digits, (wrong, right))), math.radians(wrong)
            yield at.mistaken_step(told, params={"angle": Angle(told, math.cos(u), math.sin(u))})


@enter_mistake("exchanged coordinates", phrase("coordinates exchanged, or of the wrong sign"),
               lambda op: op.movement is Movement.GIVEN or op.name == "set_off")
def _(at: Occasion) -> Iterable[Mistake]:
    names = ("x", "y") if at.step.op.movement is Movement.GIVEN else ("dx", "dy")
    for told, pair in exchanged_coordinates(*(at.step.params[name] for name in names)):
        yield at.mistaken_step(told, params={**at.step.params, **dict(zip(names, pair, strict=True))})


def exchanged_coordinates(x: float, y: float) -> Sequence[tuple[Said, tuple[float, float]]]:
    """Mistakes with two coordinates."""
    return [(said("x and y are exchanged"), (y, x)), (said("x has the wrong sign"), (-x, y)),
            (said("y has the wrong sign"), (x, -y))]
