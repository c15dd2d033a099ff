"""From the matching of a drawing to what is said of each step: its state, how sure that is, how far off it is and may
be; of a wrong step what was probably done there, or at one before it that is not to be seen itself.

Matching weighs every mark in logarithms of odds. A faint mark is sure all the same where others go on rightly from it,
and one that is not to be seen at all is implied there; what is rather not there than there cannot be told.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations
from typing import Any

import numpy as np

from graphplan.design.hand import Errors
from graphplan.errors import Undrawable
from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT, Movement
from graphplan.kernel.numbers import Domain, Floats
from graphplan.kernel.passes import steps_behind
from graphplan.kernel.program import Step
from graphplan.kernel.stages import Knowledge
from graphplan.marking.judge import measures
from graphplan.marking.judge.evidence import KnownMarks, unexplained_traces
from graphplan.marking.judge.matching import Match, Matching
from graphplan.marking.judge.mistakes import DEEDS, MISTAKES, Mistake, base_of, possible_mistakes, vector_at
from graphplan.marking.judge.search import has_own_ink
from graphplan.marking.judge.student_sheet import Residual, distance_apart, plain_value, squares_bound
from graphplan.marking.judge.verdict import (
    EARNED,
    FOLLOWS,
    IMPLIED,
    MISSING,
    UNCLEAR,
    UNSEEN,
    WRONG,
    Ellipse,
    NumberVerdict,
    Verdict,
    result_marks,
)
from graphplan.marking.traces import Trace
from graphplan.mechanism.model import Scene
from graphplan.phrases import Phrase, Said, digits, phrase, said

# ---- states ---------------------------------------------------------------------------------------------------------


class States:
    """The states of the steps of a drawing; a number that is right shows its result as a drawn mark does."""

    def __init__(self, matching: Matching, numbers: Iterable[NumberVerdict] = ()):
        self.matching = matching
        right = {(verdict.number.kind, verdict.number.of) for verdict in numbers if verdict.state in EARNED}
        self.answered, self.asked = set[int](), set[int]()  # the marks of results with such a number, and of others
        for reading in matching.sheet.drawing.readings:
            if reading.given is None:
                marks = result_marks(matching.sheet.drawing, reading)
                (self.answered if (reading.kind, reading.of) in right else self.asked).update(marks)

    def state_of(self, match: Match) -> tuple[str, float]:
        """The state of a step, and how sure that is, from 0 to 1."""
        odds = self.odds[match.step.index]
        if match.state == WRONG:
            return WRONG if has_own_ink(self.matching, match) else UNCLEAR, sureness(self._wrong_odds(match))
        if odds == -math.inf and self._is_unasked(match):
            return UNSEEN, sureness(-match.weight if match.place is None else odds)
        if match.step.op.free:
            return match.state, sureness(-match.weight if match.place is None else odds)
        if odds > -math.inf:
            state = match.state if match.place is not None else IMPLIED
            # it could be seen, and something else is there; strokes beside marks with letters may mean anything
            meant = match.step.op.gives == POINT or not self.matching.evidence.only_letters
            elsewhere = match.weight < 0.0 and meant and self.unexplained_near(match)
            return UNCLEAR if (odds < 0.0 and self.matching.evidence.picture) or elsewhere else state, sureness(odds)
        if self.drawn_steps[match.step.index] and match.step.index not in self.unreadable_marks:
            return UNSEEN, sureness(-match.weight)
        rested_on = self.matching.evidence.picture and self.drawn_steps[match.step.index]
        is_unclear = rested_on or self._is_hidden(match) or self.unexplained_near(match)
        return UNCLEAR if is_unclear else MISSING, sureness(-match.weight)

    def _is_unasked(self, match: Match) -> bool:
        """Whether a step's mark is not required: it is too small to draw, or there are only numbers; or if marks are
        identified by letters, no lettered mark depends on it."""
        index, evidence = match.step.index, self.matching.evidence
        return index in self.matching.sheet.hidden or not self.matching.traces or (
            evidence.only_letters and index not in self._steps_to_letters)

    @cached_property
    def _steps_to_letters(self) -> set[int]:
        """The steps that make a mark with letters, and those on which such a mark rests."""
        return steps_behind(self.matching.steps, {step.index for step in self.matching.steps if step.name})

    def _is_hidden(self, match: Match) -> bool:
        """Whether print hides where a step's mark should be in a picture."""
        known_marks = KnownMarks(self.matching.own, {})
        return self.matching.evidence.picture and match.step.op.gives != OPENING and (
            match.step.index not in self.matching.dead
            and self.matching.evidence.visible_share(match.step, match.expected, known_marks) is None)

    def unexplained_near(self, match: Match) -> Trace | None:
        """The nearest ink of its kind that no step explains, beside where a step's mark should be."""
        if match.place is not None or match.step.op.gives == OPENING:
            return None
        home = self.matching.sheet.plan_of_step[match.step.index]
        places, off = self.matching.evidence.nearby_traces(match.step.op.gives, home, plain_value(match.expected))
        near = [place for far, place in sorted(zip(off, places, strict=True)) if far < measures.REACH_MM]
        free = [self.matching.traces[place] for place in near
                if place not in self.matching.used and place not in self._further_strokes]
        return next(iter(unexplained_traces(free, self._explained_traces)), None)

    @cached_property
    def _further_strokes(self) -> set[int]:
        """The places of strokes that lie on a line or a circle of which another stroke is taken: a circle is drawn as
        an arc about each of its marks."""
        sheet, further = self.matching.sheet, set[int]()
        for match in self.matching.matches:
            if match.place is not None and match.state in EARNED and match.step.op.gives != POINT:
                further |= self.matching.evidence.strokes_upon(
                    match.step.op.gives, sheet.plan_of_step[match.step.index],
                    plain_value(self.matching.own[match.step.index]))
        return further

    @property
    def _explained_traces(self) -> list[Trace]:
        """The traces that steps are taken for."""
        return [self.matching.traces[place] for place in self.matching.used]

    # ---- what speaks for it ----------------------------------------------------------------------------------------

    @cached_property
    def odds(self) -> list[float]:
        """Evidence for each step that it was drawn right: its own mark, or the surest of those that depend on it,
        directly or through invisible ones; minus infinity without evidence."""
        step_odds = [self._own_odds(match) for match in self.matching.matches]
        for match in reversed(self.matching.matches):
            index, is_seen = match.step.index, match.place is not None or match.state == WRONG
            if index in self.unreadable_marks:
                step_odds[index] = -math.inf
            for arg in match.step.args if match.state in EARNED or not is_seen else ():
                step_odds[arg] = max(step_odds[arg], step_odds[index])
        return step_odds

    def _own_odds(self, match: Match) -> float:
        """Evidence of a step's own mark; or of a number, or of the strokes that cross there."""
        if match.place is not None:
            return match.weight if match.state in EARNED else -math.inf
        if match.step.index in self.answered:
            return measures.MAX_SURE_ODDS
        strokes = [self.matching.matches[arg] for arg in match.step.args]
        stroke_weights = [stroke.weight for stroke in strokes
                          if stroke.place is not None and stroke.state in EARNED and stroke.weight > 0.0]
        crossed = match.step.op.crossing and match.state != WRONG and stroke_weights and (
            len(stroke_weights) == len(strokes) or self._is_hidden(match))
        return min(stroke_weights) if crossed else -math.inf

    @cached_property
    def unreadable_marks(self) -> set[int]:
        """The marks of results that are asked for, and cannot be read off where they are not marked: they are missing,
        whatever rests on them. Those need no mark at which loci cross, or a vector meets one."""
        sheet, matches = self.matching.sheet, self.matching.matches
        if self.matching.evidence.picture:
            asked = self.asked - self.answered - set(sheet.hidden)
            return {index for index in asked if matches[index].place is None
                    and math.isinf(self._own_odds(matches[index]))}
        strokes = [match.step.index for match in matches if match.place is not None and match.state in EARNED]
        crossed = Counter(mark for stroke in strokes for mark in sheet.marks_on.get(stroke, ()))
        legible = {mark for mark, count in crossed.items() if count > 1 or not matches[mark].step.op.crossing}
        seen_steps = {match.step.index for match in matches if match.place is not None}
        return self.asked - self.answered - legible - seen_steps - set(sheet.hidden)

    @cached_property
    def drawn_steps(self) -> list[bool]:
        """For each step whether it is seen, or a mark that rests on it is: then it was drawn somehow."""
        is_drawn = [match.place is not None for match in self.matching.matches]
        for step in reversed(self.matching.steps):
            for arg in step.args if is_drawn[step.index] else ():
                is_drawn[arg] = True
        return is_drawn

    def _wrong_odds(self, match: Match) -> float:
        """Evidence that a wrong mark is wrong: the odds of the matching with its mistake, or else its distance beyond a
        pencil's error, if it is its mark at all."""
        if match.step.index in self.matching.odds:
            return self.matching.odds[match.step.index]
        if match.residual is None or match.place is None:
            return match.weight
        beyond = (match.residual.square - squares_bound(len(match.residual.off), self.matching.chance)) / 2
        return min(beyond, self.matching.evidence.weight(match.place))


def sureness(odds: float) -> float:
    """A logarithm of odds as a probability."""
    return 1 / (1 + math.exp(-min(max(odds, -measures.MAX_SURE_ODDS), measures.MAX_SURE_ODDS)))


# ---- verdicts -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Suspect:
    """A mistake at a step that would lead to a wrong mark, and what it adds to the sum of squares."""

    mistake: Mistake
    source: Step
    rank: float = 0.0


def explain_mark(matching: Matching, match: Match) -> Suspect | None:
    """The mistake that explains a wrong trace best, if one does."""
    step = match.step
    assert match.place is not None
    spots = matching.sheet.spots(step.index, matching.traces[match.place])
    best, least = None, math.inf
    for suspect in _closest_suspects(matching, step, np.array([complex(*plain_value(spot)) for spot in spots])):
        mistaken_value = _carry_mistake(matching, step, matching.own, suspect, matching.sheet.domain,
                                        matching.sheet.errors)
        if mistaken_value is None:
            continue
        residual = matching.sheet.residual(step, mistaken_value, spots, matching.own)
        if residual.fits(matching.chance) and residual.square + suspect.rank < least and (
                match.residual is None or residual.tolerance(matching.chance) < match.residual.distance):  # says where
            best, least = suspect, residual.square + suspect.rank
    return best


def _closest_suspects(matching: Matching, step: Step, spots: Any) -> list[Suspect]:
    """The mistakes that lead nearest to what was drawn."""
    floats, hand = [plain_value(value) for value in matching.own[:step.index]], matching.sheet.hand
    ranked: list[tuple[float, int, Suspect]] = []
    for suspect in _suspects(matching, step):
        mistaken_value = _carry_mistake(matching, step, floats, suspect, Floats(),
                                        lambda index: [0.0] * len(hand.slips[index]))
        if mistaken_value is not None and all(map(math.isfinite, mistaken_value)):
            ranked.append((distance_apart(step.op.gives, mistaken_value, spots), len(ranked), suspect))
    return [suspect for _, _, suspect in sorted(ranked)[:measures.MANY_CANDIDATES]]


def _suspects(matching: Matching, step: Step) -> Iterator[Suspect]:
    """Every mistake at the step, and at those before that cannot be seen."""
    order = {kind: place for place, kind in enumerate(MISTAKES)}
    for far, source in enumerate(_unseen_steps(matching, step)):
        for mistake in possible_mistakes(matching.sheet.drawing.drawn, source, matching.sheet.plan_of_step,
                                         matching.sheet.link_points):
            yield Suspect(mistake, source,
                          measures.CLEAR_SQUARES * far + measures.TABLE_ROW_SQUARES * order[mistake.kind])


def _unseen_steps(matching: Matching, step: Step) -> list[Step]:
    """The step and those before it on whose marks it rests without their being seen, the last first; no lines from
    which others rightly follow."""
    unseen, front, followed = {step.index}, [step.index], {
        arg for match in matching.matches[:step.index] if match.place is not None and match.state in EARNED
        for arg in match.step.args if matching.steps[arg].op.gives == LINE}
    while front:
        for arg in matching.steps[front.pop()].args:
            if (arg not in unseen | followed and matching.matches[arg].place is None
                and not matching.steps[arg].op.free):
                unseen.add(arg)
                front.append(arg)
    return [matching.steps[index] for index in sorted(unseen, reverse=True)]


def _carry_mistake(matching: Matching, step: Step, values: list[Any], suspect: Suspect, domain: Domain,
                   errors: Errors) -> Any:
    """Value of the step after a mistake, and all unseen steps that follow from it; None if it does not follow."""
    basis, source, hand = list(values), suspect.source.index, matching.sheet.hand
    try:
        wrong = suspect.mistake.value(domain, values)
        basis[source:source + 1] = [hand.add_slips(suspect.source, wrong, errors(source))]
        follows = {source}
        for between in matching.steps[source + 1:step.index + 1]:
            unseen = between.index == step.index or matching.matches[between.index].place is None
            if unseen and not follows.isdisjoint(between.args):
                basis[between.index:between.index + 1] = [hand.draw_step(between, domain, basis, errors)]
                follows.add(between.index)
    except Undrawable:
        return None
    return basis[step.index] if step.index in follows else None


def verdicts(matching: Matching, numbers: Iterable[NumberVerdict] = ()) -> Iterator[Verdict]:
    """Yield the verdict on every step."""
    states, unseen = States(matching, numbers), unseen_mistakes(matching)
    for match in matching.matches:
        state, confidence = states.state_of(match)
        if match.mistake and (match.place is None or state == UNCLEAR):
            state = UNSEEN if match.step.index in unseen.values() else UNCLEAR
            match = replace(match, state=state, mistake=None)
        elif match.step.index in unseen and state in EARNED:
            yield _verdict_of_unseen(matching, match, matching.matches[unseen[match.step.index]])
            continue
        verdict = replace(_verdict_on(matching, match, state), confidence=confidence)
        yield replace(verdict,
                      trace=states.unexplained_near(match)) if state == UNCLEAR and not verdict.trace else verdict


def unseen_mistakes(matching: Matching) -> dict[int, int]:
    """Mistaken steps without ink, by the first visible mark that follows from each and is out of place: that shows the
    mistake, and without such a mark there is no mistake."""
    shown = dict[int, int]()
    for match in matching.matches:
        if match.mistake and match.place is None:
            moved = {match.step.index}
            for later in matching.matches[match.step.index + 1:]:
                if moved.isdisjoint(later.step.args):
                    continue
                if later.state == FOLLOWS and later.place is not None and later.step.index not in shown:
                    shown[later.step.index] = match.step.index
                    break
                moved.add(later.step.index)
    return shown


def _verdict_of_unseen(matching: Matching, match: Match, mistaken: Match) -> Verdict:
    """The verdict on the mark that shows a mistake at an earlier step of which there is no ink."""
    step, sheet = match.step, matching.sheet
    assert match.place is not None
    assert mistaken.mistake
    trace, chance = matching.traces[match.place], matching.chance
    spots = sheet.spots(step.index, trace)
    residual = sheet.residual(step, matching.mended[step.index], spots, matching.mended)
    astray = sheet.residual(step, sheet.drawing.values[step.index], spots, sheet.drawing.values).distance
    return Verdict(step.index, WRONG, residual.distance, residual.tolerance(chance), astray, trace,
                   plain_value(matching.mended[step.index]), _tolerance_ellipse(residual, step, chance),
                   mistaken.mistake.text, mistaken.mistake.kind, mistaken.step.index,
                   sureness(matching.odds.get(mistaken.step.index, measures.MAX_SURE_ODDS)))


def _verdict_on(matching: Matching, match: Match, state: str) -> Verdict:
    """The verdict on a trace, or on a mark that is not to be seen, but from which all that follows is: of those only a
    point is somewhere."""
    step, sheet, is_seen, chance = match.step, matching.sheet, match.place is not None, matching.chance
    reason = explain_mark(matching, match) if state == WRONG and is_seen and not match.mistake else None
    mistake = reason.mistake if reason else match.mistake
    is_vague = mistake is None or (reason and mistake.kind == "wrong crossing")  # any line may pass near a mark
    missed = missed_locus(matching, match, bool(mistake)) if state == WRONG and is_seen and is_vague else None
    guilty = reason.source.index if reason else step.index if state == WRONG else None
    if mistake and mistake.mirror and step.op.movement is Movement.MET:  # wrong from the first of its unseen lines on
        guilty = next((line for line in sorted(mistake.step.args) if matching.matches[line].place is None), guilty)
    verdict = Verdict(step.index, state, expected=plain_value(match.expected),
                      mistake=missed if missed or not mistake else omission(matching, mistake.step) or mistake.text,
                      kind=mistake.kind if mistake else "", guilty=guilty)
    if not is_seen and (not mistake or step.op.gives != POINT):
        return replace(verdict, off=math.inf, tolerance=math.inf, astray=math.inf) if mistake else verdict
    trace, true = None if match.place is None else matching.traces[match.place], sheet.drawing.values
    spots = sheet.spots(step.index, trace) if trace else [(x, y) for x, y in [plain_value(matching.own[step.index])]]
    residual = match.residual or sheet.residual(step, match.expected, spots, matching.own)
    allowed = measures.DRIFT_MM if step.op.movement is Movement.BEGUN else residual.tolerance(chance)
    return replace(verdict, off=residual.distance, tolerance=allowed, trace=trace,
                   astray=sheet.residual(step, true[step.index], spots, true).distance,
                   ellipse=_tolerance_ellipse(residual, step, chance) if trace else None)


def missed_locus(matching: Matching, match: Match, explained: bool) -> Said | None:
    """The vector whose direction or length is wrong, for a mark that lies on one of its two loci alone, or the locus
    that it misses if it is not `explained` otherwise; None if it lies on both or neither, and ends no vector."""
    step, sheet, program = match.step, matching.sheet, matching.sheet.drawing.drawn
    lines = [program.steps[arg] for arg in step.args if program.steps[arg].op.gives == LINE]
    if step.op.gives == CIRCLE or match.place is None or match.residual is None:
        return None
    allowed = match.residual.tolerance(matching.chance) / sheet.mm(sheet.plan_of_step[step.index])
    if step.op.gives == LINE:
        far = max(sheet.spots(step.index, matching.traces[match.place]), key=lambda spot: math.dist(
            plain_value(spot), plain_value(matching.own[step.args[-1]])[:2]))
        return None if explained else wrong_direction(matching, step, complex(*plain_value(far)), allowed)
    spot, = sheet.spots(step.index, matching.traces[match.place])
    at = np.array([complex(*plain_value(spot))])
    if not step.op.crossing or len(lines) != 2:
        return wrong_vector(matching, step, at[0], allowed)
    off = [line for line in lines if distance_apart(LINE, plain_value(matching.own[line.index]), at) > allowed]
    if len(off) != 1:
        return None
    missed_line, = off
    side = program.text(missed_line.index if missed_line.op.movement is Movement.RULED else missed_line.args[0])
    vectors = step.stage(()).vectors if step.stage else {}
    vector = next((name for name, knowledge in vectors.items() if knowledge is Knowledge.DIRECTION
                   and name.rpartition("_")[2] in (side, side[::-1])), None)
    if vector:
        return said("{0} is not perpendicular to {1}", vector, side)
    kept_line = next(line for line in lines if line is not missed_line)
    neither = None if explained else said("on {0}, but not on {1}", *map(program.text, (kept_line.index,
                                                                                       missed_line.index)))
    tried = (rule(matching, missed_line, at[0], allowed) for rule in (wrong_direction, wrong_vector))
    return next(filter(None, tried), neither)


def _tolerance_ellipse(residual: Residual, step: Step, chance: float) -> Ellipse | None:
    """The tolerance of a point, if it has any two ways."""
    if step.op.gives != POINT or len(residual.off) < 2 or step.op.movement is Movement.BEGUN:
        return None
    variances, axes = np.linalg.eigh(residual.covariance)
    minor, major = (math.sqrt(max(variance, 0.0) * squares_bound(2, chance)) for variance in variances)
    return Ellipse(major, minor, math.degrees(math.atan2(axes[1, 1], axes[0, 1])))


# ---- directions and lengths that are wrong --------------------------------------------------------------------------

# Which direction a locus was drawn in by mistake, along another side of a link or at right angles to one, and how
# many times too long a vector is, or from where it is laid off.


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
    """The mark from which a vector is laid off by mistake, or its factor of length: for a vector that ends in this
    step's mark, or without a mark of its own on the line of this step; None if it is neither."""
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
        return said("{0} is {1} times as long as it should be", vector.text, digits(ratio, 3))
    return None


def omission(matching: Matching, mistaken: Step) -> Said | None:
    """Remark that a vector was omitted, if a line is drawn through the mark at which it begins and its end is not
    visible; else None."""
    program = matching.sheet.drawing.drawn
    for right, wrong in zip(matching.steps[mistaken.index].args, mistaken.args, strict=True):
        end = program.steps[right]
        vector = right != wrong and matching.matches[right].place is None and end.op.gives == POINT and vector_at(
            program, end, matching.sheet.plan_of_step)
        if vector and vector.start == wrong and mistaken.op.gives == LINE:
            return DEEDS["omitted"][0](vector.text)
    return None


def _ratio_along(vector: complex, ray: complex, across: complex | None, allowed: float) -> float:
    """Factor of a vector's length for which it ends at this distance, or on the line there in direction `across`; 0 if
    it ends beside, or cannot end there."""
    if across is None:
        misses = not vector or abs((ray.conjugate() * vector).imag) > allowed * abs(vector)
        return 0.0 if misses else (ray / vector).real
    reach = (vector.conjugate() * across).real
    is_flat = abs(reach) < measures.MIN_CROSSING_SINE * abs(vector) * abs(across)
    return 0.0 if is_flat else (ray.conjugate() * across).real / reach


def _other_starts(matching: Matching, end: int, start: int) -> Iterator[int]:
    """Yield the other lettered marks on the plan of a vector, except for its ends."""
    homes = matching.sheet.plan_of_step
    return (index for index in matching.labels if matching.steps[index].op.gives == POINT
            and homes[index] == homes[end] and index not in (start, end) and matching.matches[index].place is not None)


def _spot(matching: Matching, index: int) -> complex:
    """Place of a mark on its plan, as drawn."""
    return complex(*plain_value(matching.own[index])[:2])
