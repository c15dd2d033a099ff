"""What a live page tells of a construction, as HTML: its steps, what is read off it, the results and the forms.

Whatever may be another in other poses stands in an element of its own, with a number; by these numbers the same are
told once more as templates, of unknown numbers, for the page to fill in (texts.js). And what
stands on the page besides the words of the sheet.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from html import escape
from typing import Any, cast

from graphplan.kernel.passes import Compound, Values
from graphplan.kernel.program import Step
from graphplan.kernel.stages import Equation
from graphplan.live_pages.unknown import EITHER, PLACE, Later, Laters, unknown
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import WORDS
from graphplan.methods.recorded import Reading
from graphplan.phrases import Said, arrange, in_any_case, join, said
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.lettering.lettering import Runs, equation_runs, sentence_runs
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.words.lengths import Length, Lengths
from graphplan.sheet.words.protocol import Entry, Passage, Protocol, protocol_of
from graphplan.sheet.words.rows import Table
from graphplan.sheet.words.texts import Readings, SheetWords
from graphplan.words.tongue import Tongue

PAGE_WORDS: dict[str, Said] = {
    "previous": said("Previous step"), "next": said("Next step"), "first": said("First step"),
    "all": said("Show all"), "play": said("Play"), "pause": said("Pause"), "step": said("Step"),
    "steps": said("Steps"), "sheet": said("Sheet"), "controls": said("Controls"), "zoom": said("Zoom to the plan"),
    "reads": said("reads"), "makes": said("makes"), "results": said("Results"),
    "begin": said("The given mechanism, before the first step."),
    "old": said("This browser cannot unpack the page: it shows the given pose alone."),
    "pace": said("Speed of the motion"), "values": said("Values"), "more": said("More"),
    "further": said("Further scenes"),
    "graph": said("{0} over the travel", "%"),
    "keys": said("Keys: arrows, Page Up and Page Down for stages, Home, End, space for the steps; R runs the "
                 "mechanism, comma and point turn its drive, 0 brings the given pose back."),
    "pose": said("Pose"), "turn": said("Turn of the drive"), "travel": said("Travel of the drive"),
    "back": said("Given pose"), "plan": said("Plan"),
    "method": said("Method"), "language": said("Language"), "own": said("chosen for the pose"),
    "orthogonal": said("orthogonal velocities"), "polar": said("polar plans"),
    "triangles": said("velocity triangles"),
    "auxiliary": said("auxiliary points"), "trial": said("trial figures"), "poles": said("poles"),
    "print": said("Print"), "copy": said("Copy as a scene"), "copied": said("The scene is copied."),
    "take": said("The scene in this pose, to be copied from here:"), "close": said("Close"),
    "curves": said("Paths and hodographs"), "path": said("Path of {0}", "%"),
    "centrodes": said("Centrodes of {0}", "%"),
    "hodograph": said("Hodograph of {0}", "%"), "ends": said("Ends of {0}", "%"),
    "readings": said("Measured on the sheet"), "forms": said("Method and forms"),
    "limits": said("from {0} to {1}", "%1", "%2"), "round": said("all around"),
    "points": said("Points of the mechanism"),
    "handle": said("Point {0}: drag it, or move it by the arrow keys", "%"),
    "undrawn": said("In this pose the construction cannot be drawn: {0}", "%"),
    "formless": said("In this pose the construction takes other forms than those that are drawn here."),
    "short": said("Too short to draw here: {0}", "%"),
    "singular": said("In this pose there are no results."),
    "differs": said("Construction and independent check differ in this pose."),
}  # fmt: skip

TASK_WORDS = PAGE_WORDS | {
    "given": said("Given"), "found": said("Found"), "construction": said("Construction"),
    "home": said("The task as it is given"), "type": said("Type"), "travel": said("The crank turns by"),
    "transmission": said("Least transmission angle"),
    "begin": said("What is given can be dragged or typed: construction, linkage and numbers follow."),
    "none": said("Nothing is found here: {0}.", "%"), "coincide": said("{0} coincide", "%1"),
    "line": said("{0} lie in a line, and no circle goes through them", "%1"),
    "length": said("a link has no length"), "roots": said("the curve of circle points has no such point"),
    "five": said("the two points that have their five positions on circles do not exist here"),
    "limits": said("{0} must be more than {1} and less than {2}", "%1", "%2", "%3"),
    "undrawn": said("the construction cannot be drawn"),
    "crank": said("no crank swings the rocker with these numbers"),
}  # fmt: skip


LEVELS = "{}", "<sup>{}</sup>", "<sub>{}</sub>"  # of letters: on the line, above it, and, as the last, below
FOLLOWS = re.compile(f"[{PLACE}{EITHER}]")


@dataclass(frozen=True)
class FollowingScales(Scales):
    """Scales of a sheet on which plans may be drawn at others: each so many times as many lengths for a mm."""

    later: Later = field(default_factory=Later)
    panels: tuple[str, ...] = ()
    numbers: dict[str, Any] = field(default_factory=dict)

    def lengths_per_mm(self, panel: str) -> Any:
        if panel not in self.numbers:
            self.numbers[panel] = super().lengths_per_mm(panel) * self.later.input(f"s[{self.panels.index(panel)}]")
        return self.numbers[panel]


@dataclass(frozen=True)
class RememberedLengths(Lengths):
    """Lengths of unknown numbers, worked out once by what is assumed of them."""

    later: Later = field(default_factory=Later)
    distances: dict[tuple[int, int], float] = field(default_factory=dict)

    def mm(self, P: int, Q: int) -> float:
        if (P, Q) not in self.distances:
            self.distances[P, Q] = super().mm(P, Q)
        return self.distances[P, Q]

    def for_step(self, step: Step) -> tuple[Length, ...]:
        return cast("tuple[Length, ...]", self.later.remember(step.index, partial(super().for_step, step)))

    def for_earlier_part(self, compound: Compound) -> tuple[Length, ...]:
        question = "earlier part", compound.step.index
        return cast("tuple[Length, ...]", self.later.remember(question, partial(super().for_earlier_part, compound)))


@dataclass(frozen=True)
class FollowingProtocol(Protocol):
    """The protocol of all poses, whose lengths are unknown numbers."""

    later: Later = field(default_factory=Later)

    @cached_property
    def lengths(self) -> Lengths | None:
        lengths = super().lengths
        return lengths and RememberedLengths(**vars(lengths), later=self.later)


def with_marks_anywhere(construction: Construction, later: Later) -> Construction:
    """The construction with its marks wherever they will lie, and what is read of them there."""
    values = Values(construction.drawn_out.drawing, unknown(later, construction.values), Laters())
    results = construction.results_from_marks([values[mark] for mark in construction.drawn.wanted], values.domain)
    return construction.with_values(values, results)


@dataclass
class Texts:
    """The texts of a construction on its plans at these scales, in any tongue."""

    plans: Plans
    scales: Scales
    later: Later = field(default_factory=Later)
    _measured: tuple[list[Said], list[Said]] = field(default_factory=lambda: ([], []))  # in the given pose, and in all

    def texts_in(self, tongue: Tongue, in_pose: bool = True) -> dict[str, Any]:
        """The texts of the given pose by the part of the page, what the marks are called, and the templates; where they
        are not wanted `in_pose`, what hangs on it is left out of them, and stands in the templates alone."""
        html_by_words = dict[str, str]()
        following = self._telling(self._following_protocol, tongue, self._measured[1], html_by_words, in_templates=True)
        telling = self._telling(self.protocol, tongue, self._measured[0], html_by_words) if in_pose else following
        texts = {"list": "\n".join(telling.protocol()), "readings": "".join(telling.readings()),
                 "tables": telling.results(), "forms": "".join(telling.forms())}
        if in_pose:
            for _ in (*following.protocol(), *following.readings(), following.results()):
                pass
            if len(telling.parts) != len(following.parts):
                raise ValueError("a text of other poses has other parts")
        drawn = self.plans.drawing.drawn
        return {**texts, "names": [telling.set(drawn.text(i)) for i in range(len(drawn))],
                "templates": {k: text for k, text in enumerate(following.parts) if FOLLOWS.search(text)}}

    def _telling(self, protocol: Protocol, tongue: Tongue, measured: list[Said], html_by_words: dict[str, str],
                 in_templates: bool = False) -> Telling:
        plans = replace(protocol.plans, tongue=tongue)
        return Telling(plans, protocol, measured, html_by_words=html_by_words, in_templates=in_templates)

    @cached_property
    def protocol(self) -> Protocol:
        """The protocol of the given pose."""
        return protocol_of(self.plans, self.scales)

    @cached_property
    def _following_protocol(self) -> Protocol:
        """Protocol of all poses."""
        scales = FollowingScales(**vars(self.scales), later=self.later, panels=tuple(self.plans.panels))
        plans = Plans(with_marks_anywhere(self.plans.drawing, self.later), self.plans.tongue)
        return FollowingProtocol(plans, scales, self.later)

    def javascript(self) -> str:
        """The function that fills all templates that were told."""
        return self.later.javascript()


@dataclass
class Telling:
    """The texts of one construction as HTML; `parts` are those that hang on the pose, by their numbers; what is
    `measured` is found once for all languages, the HTML of words that are the same in all poses once in a language.
    Where they are templates, what hangs on the pose stands `in_templates` alone.
    """

    plans: Plans
    spoken: Protocol
    measured: list[Said] = field(default_factory=list)
    parts: list[str] = field(default_factory=list)
    html_by_words: dict[str, str] = field(default_factory=dict)
    in_templates: bool = False

    def __post_init__(self) -> None:
        self.names = tuple(step.name for step in self.plans.drawing.drawn.steps if step.name)
        self.words = SheetWords(self.plans)

    def set(self, text: str) -> str:
        """Words with the names of marks set as on the sheet."""
        if (words := self.plans.tongue(text)) not in self.html_by_words:
            self.html_by_words[words] = html(sentence_runs(words, self.names))
        return self.html_by_words[words]

    def _numbered_span(self, told: str) -> str:
        self.parts.append(told)
        shown = "" if self.in_templates and FOLLOWS.search(told) else told
        return f'<span data-told="{len(self.parts) - 1}">{shown}</span>'

    # ---- the protocol ------------------------------------------------------------------------------------------------

    def protocol(self) -> Iterator[str]:
        """The stages with their entries, and in these their movements, as items of an ordered list."""
        plan = ""
        for passage in self.spoken.passages:
            if passage.plan != plan:
                plan = passage.plan
                ideas = "".join(f"<p>{self.set(arrange('{0:capital}.', idea))}</p>" for idea in passage.idea)
                yield f"<li><h3>{self.set(arrange('{0:capital}', passage.plan.words))}</h3>{ideas}</li>"
            yield f'<li class="stage">{self._head(passage)}<ol>{"".join(self._entries(passage.entries))}</ol></li>'

    def _head(self, passage: Passage) -> str:
        """A stage's title, its equations with what is known in them underlined, and its law."""
        if passage.stage is None or passage.title is None:
            return ""
        lines = [] if passage.likewise else [f"<h4>{self.set(arrange('{0:capital}', passage.title))}</h4>"]
        lines += [f'<p class="equation">{_equation(equation)}</p>' for equation in passage.equations]
        lines += [f"<p>{self.set(arrange('{0:capital}.', passage.law))}</p>"] if passage.law else []
        return "".join(lines)

    def _entries(self, entries: Iterable[Entry]) -> Iterator[str]:
        """Entries as items of a list; one of several movements has a list of these."""
        for entry in entries:
            line = f"<b>{entry.number}</b> {self._numbered_span(self.set(entry.text))}"
            last = entry.movements[-1].number
            if not entry.is_compound:
                yield f'<li><button type="button" data-place="{last}">{line}</button></li>'
                continue
            items = "".join(f'<li><button type="button" data-place="{movement.number}"><b>{movement.number}</b> '
                            f"{self._numbered_span(self.set(movement.sentence))}</button></li>"
                            for movement in entry.movements)
            yield f'<li><button type="button" class="whole" data-until="{last}">{line}</button><ol>{items}</ol></li>'

    # ---- what is read ------------------------------------------------------------------------------------------------

    def readings(self) -> Iterator[str]:
        """Yield the measured results with their meaning, as items of a list; empty without results."""
        assert self.spoken.lengths
        if not self.measured:
            readings = Readings(self.plans.drawing, self.spoken.lengths, self.words.values)
            self.measured += [in_any_case(partial(_reading, readings, reading)) for reading in readings.drawn_readings]
        return (f"<li>{self._numbered_span(self.set(text))}</li>" for text in self.measured)

    def results(self) -> str:
        """Results of the finished drawing, as tables."""
        return "".join(f"<table>{''.join(self._rows(table))}</table>" for table in self.words.result_tables())

    def _rows(self, table: Table) -> Iterator[str]:
        """The rows of a table, its head first."""
        for number, row in enumerate(table):
            cells = (f"<td>{self._numbered_span(html(runs))}</td>" if number else f"<th>{html(runs)}</th>"
                     for runs in row[1:])
            yield f"<tr><th>{html(row[0])}</th>{''.join(cells)}</tr>"

    def forms(self) -> Iterator[str]:
        """Items of a list in HTML: the methods and forms of the construction, with reasons."""
        drawing = self.plans.drawing
        for kind, methods in drawing.method.items():
            yield f"<li>{self.set(arrange('{0:capital}: {1}.', WORDS[kind], join(methods)))}</li>"
        yield from (f"<li>{self.set(form)}</li>" for form in drawing.forms)


def _reading(found: Readings, reading: Reading) -> Said:
    """A result in a sentence; empty if it has no value."""
    measured = found.measure(reading)
    return measured.text if measured else arrange("")


def html(runs: Runs) -> str:
    """Lettering as HTML."""
    return "".join(LEVELS[run.level].format(escape(run.text)) for run in runs)


def _equation(equation: Equation) -> str:
    """An equation whose vectors are underlined as often as numbers of them are known."""
    text, done = "", 0
    for start, end, times in equation.underlines:
        text += html(equation_runs(equation.text[done:start]))
        text += f'<span class="known-{times}">{html(equation_runs(equation.text[start:end]))}</span>'
        done = end
    return text + html(equation_runs(equation.text[done:]))
