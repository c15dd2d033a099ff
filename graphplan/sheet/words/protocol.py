"""The protocol: a construction in sentences, stage by stage, with the idea of each.

The one model of what is told of the drawing: text, sheet, handout, strip, live page and data read it. Values in drawing
order, in English that knows its words in other languages:

    protocol = protocol_of(plans, scales)   # lengths are those of a sheet at these scales
    for passage in protocol.passages:       # what is drawn in one go for one stage, which ends on a plan
        passage.plan, passage.title, passage.stage, passage.law, passage.again
        for entry in passage.entries:       # one movement, or a compound as one step in the source's words
            entry.number                    # "12", or of a compound "34–41": numbers of steps, as marks bear them
            entry.sentence, entry.reason
            for movement in entry.movements:
                movement.number, movement.sentence, movement.step

There is one numbering, that of the steps. What takes several movements bears the numbers of the first and the last:
folded, a reader still finds every number that stands on the sheet, and unfolded the same sentences stand below it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import groupby, takewhile
from typing import Any, NamedTuple

from graphplan.kernel.kinds import Movement, Primitive, plain
from graphplan.kernel.passes import Compound
from graphplan.kernel.program import Panel, Program, Step
from graphplan.kernel.reasoning import home_plan
from graphplan.kernel.stages import Equation, Stage
from graphplan.mechanism.order import turning_drives
from graphplan.methods.panels import ACCELERATION_PLAN, N_PLAN, VELOCITY_PLAN, ForcePlan, LeverPlan, TrianglePlan
from graphplan.phrases import Said, arrange, digits, in_any_case, join, list_differences, phrase, said
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.tolerances import LENGTH_TOL
from graphplan.sheet.words.lengths import Length, Lengths, carry_overs

TURNED = said("velocities are drawn from their points, turned by 90°: the ends of a link's points form its image, with "
              "parallel sides")
TRIANGLES = said("each velocity is drawn from its point, its parts head to tail")
IDEAS = {
    N_PLAN: said("the vector ba is the normal acceleration of A about B; the acceleration of each point begins at the "
                 "point's own mark"),
    VELOCITY_PLAN: said("all velocities are laid off from the pole; the ends of a link's points form its image, turned "
                        "by 90°"),
    ACCELERATION_PLAN: said("all accelerations are laid off from the pole, their parts head to tail"),
}
FORCES = said("forces are laid off head to tail; in equilibrium they close")
LEVER = said("a lever that turns about the pole: forces at the ends of their points balance, as their powers do")
ENLARGED = phrase("the {0} is drawn {1} times as large, for clearness")
REDUCED = phrase("the {0} is drawn {1} times as large, to fit the paper")
BESIDE_ANOTHER = phrase("the {0} is drawn {1} times as large as the {2}")
FIRST_END = phrase("{0} ends in {1}: k_v = omega_{2} · k_s")
FIRST_ENDS = phrase("{0} end in {1}: k_v = omega_{2} · k_s")


def plan_idea(plans: Plans, plan: Panel) -> Iterator[Said]:
    """Yield the purpose of a plan; for orthogonal velocities also the ends of the drive's."""
    match plan.whole:
        case ForcePlan():
            yield FORCES
        case LeverPlan():
            yield LEVER
        case TrianglePlan():
            yield TRIANGLES
        case whole if whole in IDEAS:
            yield IDEAS[whole]
        case whole if plans.drawing.turned and "velocity" in plans.kinds(whole):
            yield TURNED
            yield from _first_ends(plans)


def factor_reasons(scales: Scales, pairs: Iterable[tuple[Panel, Panel]]) -> tuple[Said, ...]:
    """Return why the second plan of each pair is drawn larger or smaller than the first, where it is."""
    reasons = list[Said]()
    for other, plan in pairs:
        times = scales.lengths_per_mm(other) / scales.lengths_per_mm(plan)
        if abs(times - 1) > LENGTH_TOL:
            words = BESIDE_ANOTHER if other in scales.multiples else ENLARGED if times > 1 else REDUCED
            reasons.append(words(plan.words, digits(times), other.words))
    return tuple(reasons)


def _first_ends(plans: Plans) -> Iterator[Said]:
    """The velocities that end in a point of the pose, as a crank's do in its pivot, and the scale that makes them."""
    drawing = plans.drawing
    links = [drive.link for drive in turning_drives(drawing.scene) if abs(drive.rate) == drawing.tempo.unit]
    vectors_of = dict[str, list[str]]()
    for vector, end in drawing.ends_in_pose if links else ():
        vectors_of.setdefault(end, []).append(vector)
    for end, vectors in vectors_of.items():
        yield (FIRST_ENDS if len(vectors) > 1 else FIRST_END)(join(vectors), end, links[0])


Measuring = Callable[[], tuple[Length, ...]]  # finds how long something is on paper
Text = tuple[Said, Measuring]  # a sentence, and the lengths in it
CONTROL = phrase("Control: {0} and {1} meet in the pole of link {2}, through which {3} must pass.")
MAX_DIFFERENCES = 2  # between titles that one heading lists, such as an auxiliary point and its link
LIKE_CONTROL = phrase("Control, likewise for link {2}: {0}, {1} and {3}.")
Way = tuple[Primitive, str]  # an operation and the form in which it is drawn


@dataclass(frozen=True)
class SpokenStep:
    """A drawn step in words: its number, what the hand does and how long it is on paper, and why."""

    step: Step
    number: int
    sentence: Said
    why: str
    measuring: Measuring

    @property
    def lengths(self) -> tuple[Length, ...]:
        """Lengths on paper."""
        return self.measuring()

    @property
    def index(self) -> int:
        return self.step.index


class Entry(NamedTuple):
    """One written step: one movement, or several consecutive ones of a compound; `factors` has the reasons for enlarged
    or reduced lengths that no earlier entry explains."""

    sentence: Said
    why: str
    movements: tuple[SpokenStep, ...]
    measuring: Measuring
    factors: Callable[[], tuple[Said, ...]] = tuple

    @property
    def lengths(self) -> tuple[Length, ...]:
        """Lengths on paper."""
        return self.measuring()

    @property
    def is_compound(self) -> bool:
        """Whether it is several movements."""
        return len(self.movements) > 1

    @property
    def number(self) -> str:
        """The number of its step, or those of its first and last."""
        first, last = self.movements[0].number, self.movements[-1].number
        return f"{first}–{last}" if self.is_compound else str(first)

    @property
    def reason(self) -> Said:
        """Return why it is drawn, and why at another scale."""
        return in_any_case(self._reason)

    def _reason(self) -> Said:
        return join((*filter(None, (self.why,)), *self.factors()), "; ")

    @property
    def text(self) -> Said:
        """The sentence, with its reason if it has one."""
        return in_any_case(lambda: with_reason(self.sentence, self._reason()))


@dataclass(frozen=True)
class Passage:
    """Entries of one stage, one after the other, and the plan on which they end; `again` where others of that stage
    came before on that plan.

    `number` is the place of the stage among those of the program, and of one that is told again that of the first;
    `law` is empty where it was told before, and `equations` are those that were not; `controls` are what can be seen on
    the plan when it is drawn, `idea` is told where a plan is begun. No title is needed where all is done `likewise` as
    under the last title, whose `heading` lists them all.
    """

    plan: Panel
    stage: Stage | None
    number: int | None
    again: bool
    law: str
    entries: tuple[Entry, ...]
    controls: tuple[Said, ...] = ()
    likewise: bool = False
    idea: tuple[Said, ...] = ()
    heading: Said | None = None
    equations: tuple[Equation, ...] = ()

    @property
    def title(self) -> Said | None:
        """Title over the passage if it stands alone."""
        if self.stage is None:
            return None
        title = self.heading or self.stage.title
        return said("{0}, continued", title) if self.again else title


@dataclass(frozen=True)
class Protocol:
    """The steps of a construction in words, with lengths on paper where scales are given."""

    plans: Plans
    scales: Scales | None = None

    @property
    def _program(self) -> Program:
        return self.plans.drawing.drawn

    @cached_property
    def steps(self) -> tuple[SpokenStep, ...]:
        """Every step, in drawing order."""
        program, spoken = self._program, list[SpokenStep]()
        for step in program.steps[program.givens :]:
            measuring = partial(self.lengths.for_step, step) if self.lengths else tuple
            sentence = with_lengths(program.sentence(step.index), measuring)
            spoken.append(SpokenStep(step, program.number(step.index), sentence, step.why, measuring))
        return tuple(spoken)

    @property
    def sentences(self) -> tuple[Said, ...]:
        """Every step of the program in a sentence, with its reason; those that are given first."""
        program = self._program
        given = (program.sentence_with_reason(index) for index in range(program.givens))
        return *given, *(with_reason(step.sentence, step.why) for step in self.steps)

    @cached_property
    def lengths(self) -> Lengths | None:
        """The lengths of paper."""
        return lengths_of(self.plans, self.scales) if self.scales else None

    @cached_property
    def stages(self) -> tuple[tuple[Stage, ...], Mapping[int, int]]:
        """The stages, each once, and by step which of them it is a part of."""
        numbers: dict[Stage, int] = {}
        of = {step.index: numbers.setdefault(stage, len(numbers)) for stage, steps in self._program.stages
              for step in steps}
        return tuple(numbers), of

    @cached_property
    def passages(self) -> tuple[Passage, ...]:
        """All that is drawn, in drawing order: each stage with all that is drawn for it, on whatever plan."""
        passages, begun, laws, ideas = list[Passage](), set[tuple[int | None, Panel]](), set[str](), set[str]()
        plan, ways_told, equations = None, dict[str | None, set[Way]](), set[Equation]()
        factors = set[frozenset[Panel]]()
        for number, run in groupby(self.steps, lambda one: self._passage_of[one.index]):
            steps, stage = [*run], None if number is None else self.stages[0][number]
            home, law = home_plan(self._program, [one.step for one in steps]), stage.law if stage else ""
            idea = self._idea(home, ideas) if home != plan else ()
            plan, ways_told = home, ways_told if home == plan else {}
            before = {*(ways := ways_told.setdefault(_words_of(stage), set()))}
            entries = tuple(self._with_factors(entry, factors) for entry in self._entries(steps, stage, ways))
            likewise = bool(stage and (law in laws or stage.equations) and not stage.balances and ways == before
                            and passages and _are_alike(passages[-1].stage, stage))
            likewise |= bool(stage and passages and _have_one_title(passages[-1], stage, home))
            controls = tuple(control for step in steps for control in self._controls_at(step.index))
            again = stage is not None and (number, home) in begun
            solved = tuple(one for one in stage.equations if one not in equations) if stage else ()
            passages.append(Passage(home, stage, number, again, "" if law in laws else law, entries, controls, likewise,
                                    idea, equations=solved))
            laws.add(law)
            equations.update(solved)
            begun.add((number, home))
        return tuple(_with_headings(passages))

    def _idea(self, plan: Panel, ideas: set[str]) -> tuple[Said, ...]:
        """Purpose of a plan, in one or two sentences that are not printed before; they are recorded."""
        sentences = tuple(idea for idea in plan_idea(self.plans, plan) if idea not in ideas)
        ideas.update(sentences)
        return sentences

    def _with_factors(self, entry: Entry, explained: set[frozenset[Panel]]) -> Entry:
        """An entry that explains the factors between plans which no entry before it explains; they are recorded."""
        if not self.lengths:
            return entry
        plan, twins, pairs = self.plans.plan_of_step, self.plans.twins, list[tuple[Panel, Panel]]()
        for movement in entry.movements:
            for source, target in carry_overs(movement.step) if not movement.step.quantity else ():
                pair = twins[plan[source]], twins[plan[target]]
                if pair[0] != pair[1] and frozenset(pair) not in explained:
                    explained.add(frozenset(pair))
                    pairs.append(pair if pair[1] != self.plans.panels[0] else pair[::-1])
        return entry._replace(factors=partial(factor_reasons, self.lengths.scales, pairs)) if pairs else entry

    @cached_property
    def _passage_of(self) -> Mapping[int, int | None]:
        """The stage of each step in the text: its own, or for a step without a stage that of the next drawn step."""
        (_, of), numbers, number = self.stages, dict[int, int | None](), None
        for step in reversed(self.steps):
            number = numbers[step.index] = of.get(step.index, number)
        return numbers

    def _controls_at(self, step: int) -> Iterator[Said]:
        """The controls whose last mark this step draws, all but the first briefly."""
        last_marks = [max(map(max, control.marks)) for control in self.plans.drawing.controls]
        for last, control in zip(last_marks, self.plans.drawing.controls, strict=True):
            if step == last:
                lines = (join(map(self._program.text, line), " ") for line in control.marks)
                words = CONTROL if last == min(last_marks) else LIKE_CONTROL
                yield words(next(lines), next(lines), control.link, next(lines))

    @cached_property
    def _compounds(self) -> dict[int, Compound]:
        """The compound of each step that belongs to one."""
        return {step.index: compound for compound in self.plans.drawing.compounds for step in compound.movements}

    def _entries(self, steps: Sequence[SpokenStep], stage: Stage | None, ways: set[Way]) -> Iterator[Entry]:
        """Steps of one stage, those of a compound as one entry where it has words for them.

        What is drawn in one of the `ways` that were told is told briefly; a side is drawn for the entry that reads it.
        """
        side: SpokenStep | None = None
        for entry in self._plain_entries(steps, stage, ways):
            if side and any(side.index in movement.step.args for movement in entry.movements):
                entry, side = entry._replace(movements=(side, *entry.movements)), None
            if side:
                yield self._entry((side,), stage)
            side = entry.movements[0] if self._is_side(entry.movements) else None
            if not side:
                yield entry
        if side:
            yield self._entry((side,), stage)

    def _plain_entries(self, steps: Sequence[SpokenStep], stage: Stage | None, ways: set[Way]) -> Iterator[Entry]:
        """Yield the entries of steps, sides by themselves."""
        for compound, run in groupby(steps, lambda one: self._compounds.get(one.index)):
            movements = tuple(run)
            text = self._compound_text(compound, movements, ways) if compound and len(movements) > 1 else None
            if text:
                yield self._entry(movements, stage, text)
            else:
                yield from (self._entry((one,), stage, self._likewise(one.step, "", (one.measuring,), ways))
                            for one in movements)

    def _entry(self, movements: tuple[SpokenStep, ...], stage: Stage | None, text: Text | None = None) -> Entry:
        """Movements with a text, or one with its own."""
        sentence, measuring = text or (movements[-1].sentence, movements[-1].measuring)
        return Entry(sentence, _reason(movements[-1], stage), movements, measuring)

    def _is_side(self, movements: Sequence[SpokenStep]) -> bool:
        """Whether a movement does no more than join two points, by whose letters the line is called."""
        step = movements[0].step
        return len(movements) == 1 and step.op.movement is Movement.RULED and not step.name and not step.why and (
            self._program.text(step.index) == "".join(self._program.steps[arg].name for arg in step.args))

    def _compound_text(self, compound: Compound, movements: Sequence[SpokenStep], ways: set[Way]) -> Text | None:
        """Some movements of a compound in a few sentences: the whole compound, or its part that is drawn before the
        rest."""
        inner_is_new = any(one.index in compound.inner.values() for one in movements)  # and not that of another one
        before = compound.sentence_before if inner_is_new else None
        earlier = self._measuring(Lengths.for_earlier_part, compound)
        first = (with_lengths(before, earlier), earlier) if before else None
        if movements[-1].index != compound.step.index:
            return first
        whole = self._measuring(Lengths.for_step, compound.last_told if before else compound.step)
        last = with_lengths(compound.sentence_after if before else compound.sentence, whole), whole
        if first is None or len(movements) < len(compound.movements):
            return self._likewise(compound.step, compound.variant, (whole,), ways, compound.inner_texts) or last
        both = join((first[0], last[0]), " "), partial(_all_lengths, (earlier, whole))
        return self._likewise(compound.step, compound.variant, (earlier, whole), ways, compound.inner_texts) or both

    def _measuring(self, rule: Callable[[Lengths, Any], tuple[Length, ...]], of: Step | Compound) -> Measuring:
        """Finds lengths of paper by a rule, where there is paper."""
        return partial(rule, self.lengths, of) if self.lengths else tuple

    def _likewise(self, step: Step, form: str, measuring: tuple[Measuring, ...], ways: set[Way],
                  inner: Mapping[str, str] | None = None) -> Text | None:
        """A step in the few words that it has for a form, where one was told in this way; from now on one is."""
        way, brief = (step.op, plain(form)), step.op.likewise
        words = brief.get(form, brief.get(plain(form))) if way in ways else None
        ways.add(way)
        if words is None:
            return None
        text = self._program.step_text(step, lambda marks, **named: words(*marks, **named, **(inner or {})))
        lengths = partial(_all_lengths, measuring)
        return with_lengths(text, lengths), lengths


def protocol_of(plans: Plans, scales: Scales) -> Protocol:
    """Protocol of a construction at some scales, made once for all its sheets, pages and languages."""
    protocols: list[Protocol] = plans.told.setdefault((Protocol, plans.drawing), [])
    protocol = next((protocol for protocol in protocols if protocol.scales == scales), None)
    if protocol is None:
        protocols.append(protocol := Protocol(plans, scales))
    return protocol


def _are_alike(last: Stage | None, stage: Stage) -> bool:
    """Whether two titles have the same words, and so little that differs that one heading can list it."""
    return last is not None and _words_of(last) == _words_of(stage) and sum(
        one != other for one, other in zip(last.title.put, stage.title.put, strict=True)) <= MAX_DIFFERENCES


def _have_one_title(last: Passage, stage: Stage, plan: Panel) -> bool:
    """Whether a stage has the title of the last passage and goes on on its plan: it stands under that."""
    return last.stage is not None and last.stage.title == stage.title and last.plan == plan


def _with_headings(passages: Sequence[Passage]) -> Iterator[Passage]:
    """The passages, of those that are told likewise the first with a heading for all."""
    for place, passage in enumerate(passages):
        followers = takewhile(lambda follower: follower.likewise, passages[place + 1 :])
        titles = [*dict.fromkeys(one.stage.title for one in (passage, *followers) if one.stage)]
        several = len(titles) > 1 and not passage.likewise
        heading = arrange("{0:many}", list_differences(titles)) if several else None
        yield replace(passage, heading=heading) if several else passage


def _words_of(stage: Stage | None) -> str | None:
    """The words of a stage's title, whatever it speaks of; of one that is arranged from others those of the last, too.
    """
    title, words = stage.title if stage else None, ""
    while title:
        words += title.key
        title = None if title.section else next((text for text in reversed(title.put) if isinstance(text, Said)), None)
    return words or None


def _all_lengths(measuring: Iterable[Measuring]) -> tuple[Length, ...]:
    """The lengths of several parts, one after the other, but what is only laid off as it was found."""
    lengths = list[Length]()
    for length in (length for part in measuring for length in part()):
        if not lengths or abs(length.mm - lengths[-1].mm) > LENGTH_TOL * lengths[-1].mm:
            lengths.append(length)
    return tuple(lengths)


def lengths_of(plans: Plans, scales: Scales) -> Lengths:
    """The lengths of a construction on its plans at some scales."""
    return Lengths(plans.drawing.drawn, plans.drawing.values, plans.plan_of_step.__getitem__, scales)


def with_reason(sentence: Said, why: str) -> Said:
    """A sentence with its reason where it has one."""
    return arrange("{0} ({1:capital}.)", sentence, why) if why else sentence


def with_lengths(sentence: Said, measuring: Measuring) -> Said:
    """A sentence with its lengths behind it."""
    def sentence_with_lengths() -> Said:
        lengths = measuring()
        return arrange("{0} {1}.", sentence, join(length.text for length in lengths)) if lengths else sentence

    return in_any_case(sentence_with_lengths)


def _reason(step: SpokenStep, stage: Stage | None) -> str:
    """The reason of a step; empty where its stage states it already."""
    stage_text = f"{stage.title} {stage.law}".lower() if stage else ""
    return "" if step.why.lower() in stage_text else step.why
