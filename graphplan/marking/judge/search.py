"""The mistakes that a drawing shows: those that make what is seen likelier than it is without them.

Every mistake of the table is tried at every step that is not clearly right, and every trace that no step needs. At a
glance it is seen what would follow from it; the most promising ones are gone through mark by mark, and the likeliest
way is kept."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain, permutations

import numpy as np
from shapely import LineString, Point

from graphplan.errors import Undrawable
from graphplan.kernel.kinds import CIRCLE, LINE, OPENING, POINT
from graphplan.kernel.program import Step
from graphplan.marking.judge import measures
from graphplan.marking.judge.evidence import KnownMarks, ends_at, unexplained_traces
from graphplan.marking.judge.frames import quarter_turns
from graphplan.marking.judge.matching import UNMARKED, Match, Matching
from graphplan.marking.judge.mistakes import DEEDS, Mistake, lays_off_vector, possible_mistakes, value_of
from graphplan.marking.judge.student_sheet import distance_apart, plain_value, weigh_mark
from graphplan.marking.judge.verdict import RIGHT, WRONG
from graphplan.marking.traces import Submission

Value = tuple[float, ...]
Found = dict[int, int | Mistake]


@dataclass(frozen=True)
class Guess:
    """Guess of a step's mistake, its prior weight, and its promise."""

    index: int
    taken_for: int | Mistake
    prior: float
    promise: float
    odds: float = 0.0  # what the whole way with it won


class Search:
    """A drawing, as far as before its first step, in which mistakes are looked for."""

    def __init__(self, start: Matching):
        self.start = start
        self.gone = 0  # how many steps were gone through
        self.odds: dict[int, float] = {}  # what speaks for each mistake that was found

    @property
    def _first_mistake_odds(self) -> float:
        """Weight that a first mistake needs: larger in a picture, whose ink may be misread."""
        return measures.PICTURE_MISTAKE_ODDS if self.start.evidence.picture else measures.FIRST_MISTAKE_ODDS

    def find_mistakes(self, most: int) -> Found:
        """Mistakes of up to so many steps; empty without evidence of a mistake."""
        mistakes_found: Found = {}
        for _ in range(most):
            more = self._next_mistake(mistakes_found)
            if more is None:
                break
            mistakes_found[more.index] = more.taken_for
            self.odds[more.index] = more.odds
        return mistakes_found

    def _next_mistake(self, found: Found) -> Guess | None:
        """One more mistake, if the way is likelier with it."""
        forks, matching = [], self.start.fork()
        for step in matching.steps:
            forks.append(matching.fork())
            matching.match_until(step.index + 1, found)
        mistaken = any(matching.matches[index].state == WRONG for index in found)
        best, most = None, matching.weight + (measures.FURTHER_MISTAKE_ODDS if mistaken
                                              else self._first_mistake_odds)
        before, enough = self.gone, measures.WAYS_TRIED * len(matching.steps)
        for guess in sorted(self._guesses(matching, found), key=lambda guess: -guess.promise):
            if (guess.promise < measures.QUICK_SHARE * (most - matching.weight) - measures.PROMISE_SPREAD_ODDS
                or self.gone - before > enough):
                break
            weight = self._way_weight(matching, forks, found, guess, most)
            if weight > most:
                best, most = replace(guess, odds=weight - matching.weight), weight
        return best

    def _way_weight(self, matching: Matching, forks: Sequence[Matching], found: Found, guess: Guess,
                    least: float) -> float:
        """The weight of a way with one more mistake; less than everything as soon as it cannot come to the least."""
        touched, picture = self._touched_steps(guess.index), matching.evidence.picture
        rival = forks[min(touched)].fork()
        rival.taken = {**found, guess.index: guess.taken_for}
        hope = guess.prior + sum(self._best_weight(match, touched) for match in matching.matches[len(rival.own):])
        for match in matching.matches[len(rival.own):]:
            index = match.step.index
            hope -= self._best_weight(match, touched)
            try:
                anew = index in touched and (picture or index == guess.index)  # files show strokes as far as drawn
                if anew or index in rival.taken or not rival.try_repeat(matching):
                    rival.match_next(rival.taken.get(index))
                    self.gone += 1
            except Undrawable:
                return -math.inf
            # what is there, though poor, was drawn by somebody; and what is not there either way speaks for no mistake
            mine = rival.matches[-1]
            unseen = index != guess.index and mine.place is None and match.place is None
            if unseen or (index in rival.dead and match.place is not None):
                rival.weight += min(match.sharp_weight - mine.sharp_weight, 0.0)
            if rival.weight + hope < least:
                return -math.inf
        return rival.weight + hope if has_own_ink(rival, rival.matches[guess.index]) else -math.inf

    def _touched_steps(self, index: int) -> set[int]:
        """The steps that a mistake may change: what follows from it, and the strokes to the marks that do."""
        moved_steps = {step.index for step in steps_after(self.start.steps, index)}
        return moved_steps | {stroke for stroke, marks in self.start.sheet.marks_on.items()
                              if not moved_steps.isdisjoint(marks)}

    def _best_weight(self, match: Match, touched: set[int]) -> float:
        """Largest possible weight of a step."""
        settled = match.step.index not in touched and match.place is not None
        return match.weight if settled else max(match.weight, self.start.evidence.most.get(match.step.op.gives, 0.0))

    def _guesses(self, matching: Matching, found: Found) -> Iterator[Guess]:
        """All that may have been mistaken, with what a glance says for it."""
        quick = QuickScore(matching, {index: guess for index, guess in found.items() if isinstance(guess, Mistake)})
        shared = self._shared_places(matching)
        lost = {arg for match in matching.matches if match.weight < 0 for arg in match.step.args}
        settled = self._settled_steps(matching, shared)
        for match in matching.matches:
            if match.step.index in found:
                continue
            if match.place is not None and (match.step.index in lost or match.place in shared):
                yield from self._other_traces(matching, match)
            if not (match.step.index in settled or match.step.index in matching.labels or match.step.op.free):
                yield from self._mistake_guesses(matching, quick, match)

    def _shared_places(self, matching: Matching) -> set[int]:
        """The places of traces that several steps are taken for, but for those whose marks are one."""
        owners, shared = dict[int, int](), set[int]()
        for match in matching.matches:
            if match.place is not None:
                owner = owners.setdefault(match.place, match.step.index)
                if owner != match.step.index and not matching.is_one_mark(match.place, match.step.index):
                    shared.add(match.place)
        return shared

    def _settled_steps(self, matching: Matching, shared: Collection[int]) -> set[int]:
        """The steps at which no mistake is thought of: those whose marks are clearly right, and those without a mark to
        be seen of which nothing but such marks was made."""
        settled, doubtful = set[int](), set[int]()
        for match in reversed(matching.matches):
            is_right = is_clear(match) and match.place not in shared and not self._may_be_anothers(matching, match)
            is_unseen = match.place is None and match.weight >= 0.0 and match.step.index not in doubtful
            if is_right or is_unseen:
                settled.add(match.step.index)
            else:
                doubtful.update(match.step.args)
        return settled

    def _may_be_anothers(self, matching: Matching, match: Match) -> bool:
        """Whether a picture's dot, which has no letter, may be another mark's that is by chance where this should be:
        one is left over near by."""
        if not (matching.evidence.picture and match.step.op.gives == POINT and match.step.name):
            return False
        places, off = matching.evidence.nearby_traces(POINT, matching.sheet.plan_of_step[match.step.index],
                                                      plain_value(match.expected))
        return any(place not in matching.used for place, far in zip(places, off, strict=True)
                   if far < measures.MAX_ASTRAY_MM)

    def _other_traces(self, matching: Matching, match: Match) -> Iterator[Guess]:
        """Yield the other traces that fit a step as well as the one taken; or the guess that its own is missing."""
        step, home = match.step, matching.sheet.plan_of_step[match.step.index]
        assert match.place is not None
        for place in matching.evidence.neighbours(match.place, home, plain_value(matching.own[step.index])):
            if matching.residual(step, match.expected, place, matching.own).fits(matching.chance):
                yield Guess(step.index, place, self._first_mistake_odds - measures.FIRST_MISTAKE_ODDS,
                            measures.NEIGHBOUR_PROMISE)
        if step.op.gives == POINT:
            yield Guess(step.index, UNMARKED, self._first_mistake_odds - measures.FIRST_MISTAKE_ODDS,
                        measures.NEIGHBOUR_PROMISE)

    def _mistake_guesses(self, matching: Matching, quick: QuickScore, match: Match) -> Iterator[Guess]:
        """The mistakes that a step may be, those of the table and others: steps, kinds and all mistakes of one kind are
        equally likely."""
        step, after = match.step, steps_after(matching.steps, match.step.index)
        table = list(possible_mistakes(matching.sheet.drawing.drawn, step, matching.sheet.plan_of_step,
                                       matching.sheet.link_points))
        alike = Counter(mistake.kind for mistake in table)
        for mistake in table:
            prior = -math.log(len(matching.steps) * len(alike) * alike[mistake.kind])
            promise = quick.gain_of(mistake, after) + prior
            if promise > measures.HOPELESS_ODDS:
                yield Guess(step.index, mistake, prior, promise)
        faint = match.place is None or matching.evidence.weight(match.place) < measures.CLEAR_ODDS
        is_dot = step.op.gives == POINT and matching.evidence.picture
        prior = measures.DOT_ASTRAY_ODDS if is_dot else measures.UNNAMED_MISTAKE_ODDS
        for place, value in unmatched_traces(matching, step) if faint and match.weight < measures.CLEAR_ODDS else ():
            # a picture's dots are what was drawn: they are tried before all that is but thought of
            yield Guess(step.index, place, prior,
                        measures.NEIGHBOUR_PROMISE if is_dot else quick.gain(step, value, after) + prior)


def steps_after(steps: Sequence[Step], index: int) -> list[Step]:
    """A step and those that rest on it, in order."""
    resting = {index}
    for step in steps[index + 1:]:
        if not resting.isdisjoint(step.args):
            resting.add(step.index)
    return [steps[one] for one in sorted(resting)]


def is_clear(match: Match) -> bool:
    """Whether a step is so clearly right that no mistake is thought of."""
    off = match.residual
    return (off is not None and match.weight >= measures.CLEAR_ODDS
            and off.square - len(off.off) < measures.CLEAR_SQUARES)


def has_own_ink(matching: Matching, match: Match) -> bool:
    """Whether a wrong stroke of a picture is unexplained by right steps, and joins no two right marks: such a stroke is
    the vector between them."""
    if match.place is None or match.step.op.gives == POINT or not matching.evidence.picture:
        return True
    stroke, traces = matching.traces[match.place], matching.traces
    reach = stroke.figure.buffer(measures.BESIDE_MM)
    if stroke.kind == LINE:
        start, end = (np.array(spot) for spot in stroke.spots[:2])
        beyond = measures.DRIFT_MM * (end - start) / math.dist(start, end)
        reach = LineString([start - beyond, end + beyond]).buffer(measures.BESIDE_MM)
    right = [traces[twin.place] for twin in matching.matches if twin.place is not None and twin.state == RIGHT]
    spots = [trace.figure for trace in right if trace.kind == POINT]
    for given in matching.matches:
        if given.step.op.free and given.step.op.gives == POINT:
            at = matching.sheet.frame(given.step).to_sheet(complex(*plain_value(given.expected)[:2]))
            spots.append(Point(at.real, at.imag))
    return sum(spot.within(reach) for spot in spots) < 2 and bool(unexplained_traces([stroke], right))


def unmatched_traces(matching: Matching, step: Step) -> Iterator[tuple[int, tuple[float, ...]]]:
    """The traces that no step needs, a line through one of the points that a step names, or a point anywhere near, of a
    picture for a mark that has letters; with what the step would have made. The matching has gone through all steps."""
    sheet, kind = matching.sheet, step.op.gives
    mm = abs(sheet.frame(step).unit)
    on = [plain_value(matching.own[step.args[claim[1]]]) for claim in step.op.claims if claim[0] == "on"]
    meant = kind == LINE or (kind == POINT and (step.name or not matching.evidence.picture))
    used = {match.place for match in matching.matches if match.step.name} if (
        kind == POINT and matching.evidence.picture) else matching.used  # nobody dots what has no letters
    for place in matching.evidence.unlabelled_of(kind) if meant else ():
        if place in used or matching.traces[place].panel not in ("", sheet.plan_of_step[step.index]):
            continue
        spots = sheet.spots(step.index, matching.traces[place])
        value = plain_value(sheet.value_of_trace(step, matching.own[step.index], spots, steady=True))
        if kind == POINT:
            near = math.dist(value, plain_value(matching.own[step.index])) * mm < measures.MAX_ASTRAY_MM and not (
                matching.evidence.picture and matching.is_at_beginning(step, value))
        else:
            off = min((float(distance_apart(LINE, value, np.array([complex(*point[:2])]))) for point in on),
                      default=math.inf)
            near = off * mm < measures.SURE_SIGMAS * max(sheet.pencil.point, sheet.pencil.edge)
        if near:
            yield place, value


class QuickScore:
    """A way through a drawing, and what it would win by another mistake."""

    def __init__(self, matching: Matching, mistakes: Mapping[int, Mistake]):
        self.matching, self.mistakes = matching, mistakes
        self.own = [plain_value(value) for value in matching.own]

    def gain_of(self, mistake: Mistake, after: Sequence[Step]) -> float:
        """Gain if a mistake was made at the first of the steps that follow from it; minus infinity if it is
        impossible."""
        wrong = value_of(mistake.step, self.own, mistake)
        return -math.inf if wrong is None else self.gain(mistake.step, wrong, after)

    def gain(self, mistaken: Step, wrong: Value, after: Sequence[Step]) -> float:
        """Gain if a step made this value; minus infinity if its ink is missing, or no later mark follows from it."""
        matching, at = self.matching, mistaken.index
        values, moved_steps, dead = list(self.own), set[int](), set[int]()
        gain = seen_weight = 0.0
        for arg in _strokes_of(matching, at):
            weight, _ = self._visible_weight(matching.steps[arg], self.own[arg],
                                             KnownMarks(self.own[:arg], {at: wrong}))
            gain = gain + weight - measures.QUICK_SHARE * matching.matches[arg].weight
            seen_weight += weight
        for step in after:
            if dead.isdisjoint(step.args) and (step.index == at or not moved_steps.isdisjoint(step.args)):
                value = wrong if step.index == at else value_of(step, values, self.mistakes.get(step.index))
                if value is None:
                    dead.add(step.index)
                    continue
                if not self._differs_visibly(step, value):
                    continue
                moved_steps.add(step.index)
                known_marks = KnownMarks(values[:step.index], self.mistakes)
                weight, values[step.index] = self._visible_weight(step, value, known_marks)
                gain, seen_weight = gain + weight - matching.matches[step.index].weight, seen_weight + weight
                if matching.evidence.is_beyond_panel(step, value):
                    dead.add(step.index)
                if seen_weight < measures.HOPELESS_ODDS or (step.index == at and not self._is_possible(step, weight)):
                    return -math.inf
            elif not dead.isdisjoint(step.args):
                dead.add(step.index)
        return gain - sum(matching.matches[index].weight for index in dead)

    def _is_possible(self, step: Step, weight: float) -> bool:
        """Whether a step may be drawn so, by its visible ink: lines are visible, and in a picture all but the ends of
        vectors, whose dots strokes may hide; printed lines are not drawn."""
        evidence, known_marks = self.matching.evidence, KnownMarks(self.own, self.mistakes)
        if step.op.gives != LINE:
            return weight > -1.0 or not evidence.picture or step.op.gives == OPENING or lays_off_vector(step.op)
        printed = evidence.picture and evidence.visible_share(step, self.own[step.index], known_marks) is None
        return weight > (0.0 if printed else -1.0)

    def _differs_visibly(self, step: Step, made: Value) -> bool:
        """Whether a value is another to the eye than what the step was taken for."""
        own_value, home = self.own[step.index], self.matching.sheet.plan_of_step[step.index]
        if step.op.gives == LINE:
            off = max(abs(_line_offset(own_value, z) - _line_offset(made, z)) for z in self._plan_corners[home])
        elif step.op.gives == OPENING:
            return True
        else:
            off = math.dist(own_value[:2], made[:2])
            if step.op.gives == CIRCLE:
                off += abs(math.sqrt(max(own_value[2], 0)) - math.sqrt(max(made[2], 0)))
        return off * self.matching.sheet.mm(home) > measures.DIFFERENT_MM

    @cached_property
    def _plan_corners(self) -> dict[str, list[complex]]:
        """The corners of what is drawn on each plan."""
        spots_of_plan: dict[str, list[complex]] = {}
        for step, home, value in zip(self.matching.steps, self.matching.sheet.plan_of_step, self.own, strict=True):
            if step.op.gives == POINT:
                spots_of_plan.setdefault(home, []).append(complex(*value))
        return {home: [complex(pick(z.real for z in spots), also(z.imag for z in spots))
                       for pick in (min, max) for also in (min, max)] for home, spots in spots_of_plan.items()}

    def _visible_weight(self, step: Step, value: Value, known: KnownMarks) -> tuple[float, Value]:
        """Weight of a value, and the value as drawn: a point may have drifted."""
        kind, evidence = step.op.gives, self.matching.evidence
        share = None if kind == OPENING else evidence.visible_share(step, value, known)
        if share is None:
            return 0.0, value
        if kind != POINT:
            weight = weigh_mark(evidence.most[kind], measures.ABSENT_ODDS[kind], None, share)
            return measures.QUICK_SHARE * weight, value
        trace = evidence.find_trace(step, value, known, measures.DRIFT_MM)
        if trace is None:
            return measures.QUICK_SHARE * measures.ABSENT_ODDS[kind], value
        spot = self.matching.sheet.frame(step).to_plan(complex(*trace.spots[0]))
        return measures.QUICK_SHARE * evidence.trace_weight(trace), (spot.real, spot.imag)


def _strokes_of(matching: Matching, index: int) -> list[int]:
    """The lines and arcs on which the mark of a step lies: they are drawn as far as where it is thought to be."""
    step = matching.steps[index]
    return [arg for arg in step.args if step.op.gives == POINT and matching.steps[arg].op.gives in (LINE, CIRCLE)]


def _line_offset(line: Sequence[float], z: complex) -> float:
    """Distance of a point from a line, to its left."""
    a, b, c = line
    return (a * z.real + b * z.imag + c) / math.hypot(a, b)


# ---- what a whole way says ------------------------------------------------------------------------------------------


def likelihood(matching: Matching) -> float:
    """Weight of a drawing's marks for the construction with which they were matched. What is missing of a plan was left
    out together: each mark more tells less than the one before."""
    odds, left_out = 0.0, Counter[str]()
    for match in matching.matches:
        if match.place is None and match.weight < 0 and match.mistake is None:
            left_out[matching.sheet.plan_of_step[match.step.index]] += 1
        else:
            odds += match.sharp_weight
    return odds - sum(measures.MISSED_MARK_COST * (1 + math.log(count)) for count in left_out.values())


# ---- arrows that go the wrong way -----------------------------------------------------------------------------------

# Vectors whose ends have no letters, and whose arrows go the wrong way. Of a stroke nobody says what it is meant to
# be. An arrow says it where it begins in the mark at which a vector is laid off and ends in no other mark, goes as
# that would reversed or turned by a right angle, and no stroke goes the right way. Its length is free: forces may
# have a scale of the student's own.


@dataclass(frozen=True)
class RightWay:
    """Where a vector should go, in mm of the sheet, and by how much of a radian its direction is unsure."""

    vector: complex
    sigma: float

    def turn_of(self, way: complex, mark_error: float) -> int | None:
        """By how much a stroke is turned from it, in right angles, 0 to 3; None where by none of them."""
        allowed = measures.SAME_FRAME_SHARE + 3 * math.hypot(self.sigma, math.sqrt(2) * mark_error / abs(way))
        return quarter_turns(way / self.vector, allowed)


def wrong_arrow(matching: Matching, submission: Submission) -> Mistake | None:
    """The first vector that is nowhere drawn as it should be, but as an arrow that goes the wrong way; None where there
    is none."""
    vectors = [(match.step, list(_right_ways(matching, match))) for match in matching.matches
               if submission.tips and _is_unseen_vector(match)]
    error = matching.sheet.pencil.point
    for step, directions in vectors:
        start = _spot(matching, matching.steps[step.root or 0])
        arrows = [tip - start for tip in _arrow_tips(submission, start)]
        strokes = [*arrows, *(end - start for end in _stroke_ends(submission, start))]
        from_here = chain.from_iterable(right_ways for vector, right_ways in vectors if vector.root == step.root)
        if not directions or any(right.turn_of(stroke, error) == 0 for right in from_here for stroke in strokes):
            continue
        for arrow in arrows:
            if _is_no_mark(matching, start + arrow) and (
                    mistake := _mistake_as(matching, step, directions[0], arrow)):
                return mistake
    return None


def _is_unseen_vector(match: Match) -> bool:
    return (match.place is None and match.mistake is None and match.step.root is not None
            and match.step.op.gives == POINT and lays_off_vector(match.step.op))


def _right_ways(matching: Matching, match: Match) -> Iterator[RightWay]:
    """Where a vector should go by the student's own marks, and by the mended ones, as far as that is sure."""
    step, sheet = match.step, matching.sheet
    if step.root is None or matching.matches[step.root].place is None:
        return
    for basis in (matching.own, matching.mended):
        unit = sheet.frame(step).unit
        vector, sigma = sheet.laid_off(step, step.root, basis) or (0j, 0.0)
        if abs(vector * unit) > measures.MIN_VECTOR_MM and abs(vector) > measures.SURE_SIGMAS * sigma:
            yield RightWay(vector * unit, sigma / abs(vector))


def _mistake_as(matching: Matching, step: Step, right: RightWay, arrow: complex) -> Mistake | None:
    """The vector's being reversed, or turned by a right angle, as an arrow goes, with its length."""
    turn, drawing = right.turn_of(arrow, matching.sheet.pencil.point), matching.sheet.drawing
    label = next((vector.label for vector in drawing.arrows if vector.end == step.index), None)
    for deed in possible_mistakes(drawing.drawn, step, matching.sheet.plan_of_step, ()):
        if turn and deed.factor == 1j**turn:
            words, _ = DEEDS.get(deed.kind, (None, ()))
            return replace(deed, factor=arrow / right.vector, text=words(label) if words and label else deed.text)
    return None


def _arrow_tips(submission: Submission, start: complex) -> Iterator[complex]:
    """The tips of the arrows that begin at a mark."""
    for tip in (complex(*spot) for spot in submission.tips):
        if any(ends_at((start, end), tip) and abs(tip - end) < abs(tip - start)
               for end in _stroke_ends(submission, start)):
            yield tip


def _stroke_ends(submission: Submission, start: complex) -> Iterator[complex]:
    """Where the strokes end that begin at a mark and leave it."""
    for trace in submission.traces:
        if trace.kind == LINE:
            yield from (end for begin, end in permutations(complex(*spot) for spot in trace.spots[:2])
                        if abs(begin - start) < measures.SAME_STROKE_MM < abs(end - start))


def _is_no_mark(matching: Matching, tip: complex) -> bool:
    """Whether an arrow ends in no mark that was found."""
    return all(abs(tip - _spot(matching, match.step)) > measures.SAME_STROKE_MM for match in matching.matches
               if match.place is not None and match.step.op.gives == POINT)


def _spot(matching: Matching, step: Step) -> complex:
    """Where a mark is on the sheet, as it is drawn."""
    return matching.sheet.frame(step).to_sheet(complex(*plain_value(matching.own[step.index])[:2]))
