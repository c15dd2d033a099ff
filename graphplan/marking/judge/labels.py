"""Letters and marks: which step a label speaks of, which letters and marks belong together at the least cost, and where
strokes cross or end near letters, so that a mark may be meant that has no dot.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations

from shapely import Polygon, STRtree

from graphplan.kernel.kinds import CIRCLE, LINE, POINT, Movement
from graphplan.kernel.program import Program
from graphplan.marking.files.drawing import circle_through
from graphplan.marking.judge import measures
from graphplan.marking.judge.laid_off import vector_letters
from graphplan.marking.traces import Trace, bare_name, spell
from graphplan.methods.construction import Construction
from graphplan.phrases import Said


def labelled_steps(drawing: Construction, plan_of_step: Sequence[str], traces: Sequence[Trace]) -> dict[int, int]:
    """For each step that a trace is labelled as, the place of that trace; of several that which says it best, or first.

    A number beside a line may be that of a link, or of the line next to it: unless the plan is named it tells nothing.
    """
    names, places, used_places = LabelTable(drawing, plan_of_step), dict[int, int](), set[int]()
    for loosely in range(measures.MAX_LOOSENESS + 1):
        named: list[tuple[bool, int, int]] = []
        for place, trace in enumerate(traces):
            numbered = trace.kind != POINT and not trace.panel and trace.label.isdigit()
            step = names.step(trace.kind, trace.panel, trace.label, loosely) if trace.label and not numbered else None
            if step is not None and drawing.drawn.steps[step].op.gives == trace.kind and place not in used_places:
                named.append((spell(trace.label) != spell(drawing.drawn.steps[step].name), place, step))
        for _, place, step in sorted(named):  # c is no C where there is one
            used_places.add(places.setdefault(step, place))
    return places


def is_sure(trace: Trace) -> bool:
    """Whether a label is certainly that of its trace: beside a mark of a drawing may stand the letter of another."""
    return bool(trace.panel) or (trace.kind == POINT and not trace.beside)


class LabelTable:
    """What the marks of a construction may be called."""

    def __init__(self, drawing: Construction, plan_of_step: Sequence[str]):
        self._steps = _label_table(drawing.drawn, plan_of_step, vector_letters(drawing))

    def step(self, kind: str, panel: str, label: str, loosely: int) -> int | None:
        """The step that makes a thing of this kind and label, by the label as it stands, or more loosely read: without
        the subscript's mark, and in small letters."""
        read = spell(label.replace(" ", ""))
        text = (read, read.replace("_", ""), read.replace("_", "").casefold())[loosely]
        return self._steps.get((kind, panel, text), self._steps.get((kind, "", text)))


def _label_table(program: Program, plan_of_step: Sequence[str], also: Mapping[str, int]
                 ) -> dict[tuple[str, str, str], int]:
    """All that a mark may be called, by its kind and plan or on any plan: what is clearer comes first, what textbooks
    call it `also` comes last."""
    table: dict[tuple[str, str, str], int] = {}
    loosely: dict[tuple[str, str, str], set[int]] = {}
    for step in program.steps:
        kind, text = step.op.gives, program.text(step.index)
        letters = [spell(step.name), "" if isinstance(text, Said) else spell(text)]
        number = str(program.number(step.index))
        for panel in (plan_of_step[step.index], ""):
            for letter in filter(None, letters):
                table.setdefault((kind, panel, letter), step.index)
                for less in (letter.replace("_", ""), letter.replace("_", "").casefold()):
                    loosely.setdefault((kind, panel, less), set()).add(step.index)
            for called in (number, f"#{number}", f"{kind}{number}") if step.op.movement is not Movement.GIVEN else ():
                loosely.setdefault((kind, panel, called), set()).add(step.index)
    for spelling, steps in loosely.items():
        if len(steps) == 1:  # what may be said of two is said of neither
            table.setdefault(spelling, *steps)
    for name, index in also.items():
        for panel in (plan_of_step[index], ""):
            for spelled in (spell(name), bare_name(name), bare_name(name).casefold()):
                table.setdefault((POINT, panel, spelled), index)
    return table


# ---- pairing --------------------------------------------------------------------------------------------------------


Costs = Mapping[int, float]  # of a letter's candidates


def assign_labels(wishes: Sequence[Costs], nothing: float, shared: float) -> list[int | None]:
    """The candidate of each letter, None where none is worth it, so that all together cost least: `nothing` is the
    cost of a letter that names no candidate, `shared` that of a candidate's second letter, of its third twice as much.
    """
    chosen: list[int | None] = [None] * len(wishes)
    for crowd in _letter_crowds(wishes):
        if len(crowd) > measures.MAX_CROWD:
            for letter in crowd:
                best = min(wishes[letter], key=wishes[letter].__getitem__)
                chosen[letter] = best if wishes[letter][best] < nothing else None
            continue
        named = sorted({candidate for letter in crowd for candidate in wishes[letter]})
        copies = min(3, len(crowd))
        table = [[wishes[letter].get(candidate, math.inf) + shared * copy for copy in range(copies)
                  for candidate in named]
                 + [nothing] * len(crowd) for letter in crowd]
        for letter, column in zip(crowd, cheapest_columns(table), strict=True):
            chosen[letter] = named[column % len(named)] if column < copies * len(named) else None
    return chosen


def _letter_crowds(wishes: Sequence[Costs]) -> Iterator[list[int]]:
    """The letters that have candidates, in groups that share none with each other."""
    group = list(range(len(wishes)))

    def root(letter: int) -> int:
        while group[letter] != letter:
            group[letter] = letter = group[group[letter]]
        return letter

    first: dict[int, int] = {}
    for letter, costs in enumerate(wishes):
        for candidate in costs:
            group[root(letter)] = root(first.setdefault(candidate, letter))
    crowds: dict[int, list[int]] = {}
    for letter, costs in enumerate(wishes):
        if costs:
            crowds.setdefault(root(letter), []).append(letter)
    yield from crowds.values()


def cheapest_columns(table: Sequence[Sequence[float]]) -> list[int]:
    """The column of each row, no two the same, at the least sum: by shortest augmenting paths (Jonker and Volgenant,
    Computing 38, 1987). There are at least as many columns as rows, and some way of finite cost."""
    rows, columns = len(table), len(table[0]) if table else 0
    price, spare = [0.0] * columns, [0.0] * rows  # of the dual problem
    holder: list[int] = [-1] * columns
    for row in range(rows):
        least, before = [math.inf] * columns, [-1] * columns
        done = [False] * columns
        current, column, far = row, -1, 0.0
        while True:
            for candidate in range(columns):
                if not done[candidate]:
                    length = far + table[current][candidate] - spare[current] - price[candidate]
                    if length < least[candidate]:
                        least[candidate], before[candidate] = length, column
            column = min((candidate for candidate in range(columns) if not done[candidate]), key=least.__getitem__)
            far, done[column] = least[column], True
            if holder[column] < 0:
                break
            current = holder[column]
        spare[row] += far
        for candidate in range(columns):
            if done[candidate] and candidate != column:
                spare[holder[candidate]] += far - least[candidate]
                price[candidate] -= far - least[candidate]
        while column >= 0:
            last = before[column]
            holder[column] = holder[last] if last >= 0 else row
            column = last
    assignment = [-1] * rows
    for column, row in enumerate(holder):
        if row >= 0:
            assignment[row] = column
    return assignment


# ---- crossings ------------------------------------------------------------------------------------------------------


def stroke_meetings(box: Polygon, reach: float, traces: Sequence[Trace], figures: STRtree
                    ) -> tuple[list[Trace], list[Trace]]:
    """Points where strokes cross about a box of letters, as sure as these are drawn; and where lines end."""
    strokes = [traces[place] for place in figures.query(box, "dwithin", reach)
               if traces[place].kind != POINT][:measures.STROKES_NEAR_LETTER]
    left, bottom, right, top = box.bounds

    spots_found: list[complex] = []

    def new_points(spots: Iterable[tuple[complex, float]]) -> list[Trace]:
        """Those of some spots, each with its blur, that are about the box, and not yet found."""
        points = []
        for z, blur in spots:
            gap = math.hypot(max(left - z.real, 0.0, z.real - right), max(bottom - z.imag, 0.0, z.imag - top))
            if gap < reach and all(abs(z - before) > measures.SAME_CROSSING_MM for before in spots_found):
                spots_found.append(z)
                points.append(Trace(POINT, ((z.real, z.imag),), blur=blur, crossed=True))
        return points

    crossings = ((z, measures.CROSSING_BLUR_MM / sine) for first, second in combinations(strokes, 2)
                 for z, sine in _stroke_crossings(first, second))
    ends = ((complex(*spot), 0.0) for stroke in strokes if stroke.kind == LINE for spot in stroke.spots)
    return new_points(crossings), new_points(ends)


def _stroke_crossings(one: Trace, other: Trace) -> Iterator[tuple[complex, float]]:
    """Where two strokes, lines as long as they are drawn, cross, and the sine of the angle."""
    if one.kind == other.kind == LINE:
        a, b, c, d = (complex(*spot) for spot in (*one.spots, *other.spots))
        u, v = b - a, d - c
        sine = (u.conjugate() * v).imag
        if abs(sine) > measures.MIN_CROSSING_SINE * abs(u) * abs(v):
            s, t = ((c - a).conjugate() * v).imag / sine, ((c - a).conjugate() * u).imag / sine
            if all(-measures.SAME_CROSSING_MM <= ratio * abs(vector) <= abs(vector) + measures.SAME_CROSSING_MM
                   for ratio, vector in ((s, u), (t, v))):
                yield a + s * u, abs(sine) / (abs(u) * abs(v))
    elif CIRCLE in (one.kind, other.kind):
        line, arc = (one, other) if other.kind == CIRCLE else (other, one)
        arc_circle = circle_through(*arc.spots[:3])
        if arc_circle is None:
            return
        centre, radius = complex(*arc_circle[0]), arc_circle[1]
        if line.kind == LINE:
            a, b = (complex(*spot) for spot in line.spots)
            vector = (b - a) / abs(b - a)
            foot = a + ((centre - a) * vector.conjugate()).real * vector
            half = radius**2 - abs(foot - centre) ** 2
            ends = [foot + sign * math.sqrt(half) * vector for sign in (1, -1)] if half > 0 else []
            sine = max(measures.MIN_CROSSING_SINE, math.sqrt(max(half, 0.0)) / radius)
            yield from ((z, sine) for z in ends if -measures.SAME_CROSSING_MM <= ((z - a) * vector.conjugate()).real
                        <= abs(b - a) + measures.SAME_CROSSING_MM)
        elif (second := circle_through(*line.spots[:3])) is not None:
            apart = complex(*second[0]) - centre
            if not 0 < abs(radius - second[1]) < abs(apart) < radius + second[1]:
                return
            along = (abs(apart) ** 2 + radius**2 - second[1] ** 2) / (2 * abs(apart))
            turn = math.acos(min(1.0, max(-1.0, along / radius)))
            sine = max(measures.MIN_CROSSING_SINE, math.sin(turn) * abs(apart) / second[1])
            yield from ((centre + cmath.rect(radius, cmath.phase(apart) + sign * turn), sine) for sign in (1, -1))
