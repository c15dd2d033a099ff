"""The report of a judged drawing, or of a whole class, as one page for a browser, without scripts or a network.

All that comes from a student's file is escaped, and the page itself forbids whatever could be fetched or run.

The results of a stack of scans as one page for a browser, without scripts or a network.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from html import escape
from importlib.resources import files

from graphplan.marking.classroom import measures
from graphplan.marking.classroom.results import (
    ABSENT,
    FAILED,
    JUDGED,
    NOT_JUDGED,
    STATUS,
    UNASSIGNED,
    Classroom,
    MarkedDrawing,
    SheetResult,
    StackResults,
    mistake_words,
)
from graphplan.marking.judge.findings import (
    ALLOWED_WORD,
    OFF_WORD,
    SIGNIFICANT_DIGITS,
    look_at_lines,
    number_text,
    number_words,
    opinion,
    reading_lines,
    result_named,
    step_name,
    step_words,
    summary_lines,
)
from graphplan.marking.judge.score import GROUPS, KINDS, Score
from graphplan.marking.judge.verdict import STATES, UNSEEN, Judgement, NumberVerdict, Verdict
from graphplan.output.svg import svg
from graphplan.phrases import arrange, digits, phrase, said
from graphplan.sheet.lettering.lettering import sentence_runs
from graphplan.sheet.plates.display import Sheet
from graphplan.words.tongue import Tongue

PICTURES = "img-src data:; "  # the policy of a page with pictures of its own
EACH = phrase("Each step is judged from the student's own earlier marks.")
MAX_BAR_EM = 16.0  # em: the longest bar
FIGURE, STATE = "figure", "state"  # the classes of cells: of numbers, and of verdicts


@dataclass(frozen=True)
class HtmlCell:
    """A cell of a table, as HTML, with its class."""

    html: str
    look: str = ""

    def element(self, head: bool = False) -> str:
        """The cell as an element; one that is a `head` names its row."""
        look = f' class="{self.look}"' if self.look else ""
        return f'<th scope="row"{look}>{self.html}</th>' if head else f"<td{look}>{self.html}</td>"


Rows = Iterable[tuple[str, Sequence[HtmlCell]]]  # each with its class; the first cell of a row names it


def report_page(judgement: Judgement, score: Score, sheets: Sequence[Sheet]) -> str:
    """The page of a judgement, with its overlay, in the tongue of its sheet."""
    report = _Report(judgement.composition.plans.tongue, judgement, score)
    return report.page(f"{judgement.drawing.scene.title}: {judgement.name}", report.body(sheets))


def class_list(found: Classroom, tongue: Tongue) -> str:
    """The page of a class, in this tongue."""
    report = _ClassList(tongue, found)
    return report.page(found.title, report.body())


@dataclass(frozen=True)
class HtmlPage:
    """A page in a tongue."""

    tongue: Tongue

    def say(self, text: str) -> str:
        """Words as HTML."""
        return escape(self.tongue(text))

    def page(self, title: str, body: Iterable[str], pictures: str = "") -> str:
        """The whole page; the body is HTML, with `pictures` of the kind that is said."""
        fields = {"language": self.tongue.code, "title": escape(title), "body": "\n".join(body), "pictures": pictures}
        text = files(__package__).joinpath("report_page.html").read_text("utf-8")
        return re.sub(r"\{\{(\w+)\}\}", lambda slot: fields[slot[1]], text)

    def table(self, title: str, caption: str, heads: Sequence[str], rows: Rows) -> Iterator[str]:
        """Yield a table under its title, with its caption and heads; a head without words is an empty cell."""
        columns = (f'<th scope="col">{self.say(head)}</th>' if head else "<td></td>" for head in heads)
        yield f"<h2>{self.say(title)}</h2>"
        yield f'<div class="wide" tabindex="0"><table><caption>{self.say(caption)}</caption>'
        yield "<thead><tr>" + "".join(columns) + "</tr></thead><tbody>"
        for look, cells in rows:
            yield f'<tr class="{look}">' + "".join(cell.element(not i) for i, cell in enumerate(cells)) + "</tr>"
        yield "</tbody></table></div>"

    def bars(self, head: str, counts: Mapping[str, int], whole: int) -> Iterator[str]:
        """Yield counts of this whole as a table with a bar for each; empty without counts."""
        if not counts:
            return
        most = max(1, *counts.values())
        rows = [("", (HtmlCell(name), HtmlCell(str(count), FIGURE),
                      HtmlCell(f'<span class="bar" style="width: {MAX_BAR_EM * count / most:.2f}em"></span>')))
                for name, count in counts.items()]
        yield from self.table(head, said("How many drawings, of {0}.", whole), ("", said("Drawings"), ""), rows)


@dataclass(frozen=True)
class _Report(HtmlPage):
    """One judgement in words."""

    judgement: Judgement
    score: Score

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(step.name for step in self.judgement.drawing.drawn.steps if step.name)

    def set(self, text: str) -> str:
        """Words as HTML, with the names of marks set as on the sheet."""
        runs = sentence_runs(self.tongue(text), self.names)
        return "".join(f"<sub>{escape(run.text)}</sub>" if run.level else escape(run.text) for run in runs)

    def body(self, sheets: Sequence[Sheet]) -> Iterator[str]:
        """Yield the content of the page."""
        scene, wrong = self.judgement.drawing.scene, " wrong" if self.judgement.first_wrong else ""
        yield f"<h1>{escape(scene.title)}</h1>"
        yield f'<p class="source">{escape(self.judgement.name)}</p>'
        for line in reading_lines(self.judgement):
            yield f'<p class="reading">{self.set(line)}</p>'
        yield f'<p class="opinion{wrong}">{self.set(opinion(self.judgement))}</p>'
        yield from (f"<p>{self.set(summary_line)}</p>" for summary_line in summary_lines(self.judgement))
        yield from (f"<p>{self.set(told)}</p>" for told in look_at_lines(self.judgement))
        yield from self._score()
        for sheet in sheets:
            yield f"<figure>{picture(sheet)}</figure>"
        yield from self._numbers()
        yield from self._steps()

    def _score(self) -> Iterator[str]:
        yield from (f"<p>{self.say(line)}</p>" for line in self.score.teacher_lines)
        if self.score.judge_score is None:
            return
        groups = [(GROUPS[group](), percent) for group, percent in self.score.groups.items()]
        groups += [(KINDS[kind](), -cost) for kind, cost in self.score.costs.items()]
        groups.append((said("in all, of 100"), self.score.judge_score))
        rows = [("", (HtmlCell(self.say(name)), HtmlCell(self.say(digits(round(percent))), FIGURE)))
                for name, percent in groups]
        yield from self.table(said("Score"), said("Score of 100."), ("", said("Score")), rows)

    # ---- steps -----------------------------------------------------------------------------------------------------

    def _steps(self) -> Iterator[str]:
        heads = (said("Step"), said("Plan"), said("What is drawn"), said("Verdict"), said("Off, mm"),
                 said("Allowed, mm"), said("Sure, %"), said("Likely mistake"))
        givens = self.judgement.drawing.drawn.givens
        rows = [(verdict.state, self._step(verdict)) for verdict in self.judgement.verdicts
                if verdict.step >= givens or verdict.state != UNSEEN]
        yield from self.table(said("Steps"), EACH(), heads, rows)

    def _step(self, verdict: Verdict) -> tuple[HtmlCell, ...]:
        program, plans = self.judgement.drawing.drawn, self.judgement.composition.plans
        is_seen = self.judgement.is_measured(verdict)
        sizes = [self.say(digits(size, SIGNIFICANT_DIGITS)) if is_seen else ""
                 for size in (verdict.off, verdict.tolerance)]
        return (
            HtmlCell(self.set(step_name(program, verdict.step).short), FIGURE),
            HtmlCell(self.say(plans.plan_of_step[verdict.step].words)),
            HtmlCell(self.set(program.sentence(verdict.step))),
            HtmlCell(self.say(STATES[verdict.state]()), STATE),
            *(HtmlCell(size, FIGURE) for size in sizes),
            HtmlCell(f"{100 * verdict.confidence:.0f}", FIGURE),
            HtmlCell(self.set(self._mistake(verdict))),
        )  # fmt: skip

    def _mistake(self, verdict: Verdict) -> str:
        """Probable mistake, with the earlier step at which it was made if that is another."""
        if verdict.mistake is None:
            return ""
        if verdict.at_fault == verdict.step:
            return verdict.mistake
        return arrange("{0}: {1}", step_words(self.judgement.drawing.drawn, verdict.at_fault), verdict.mistake)

    # ---- numbers ---------------------------------------------------------------------------------------------------

    def _numbers(self) -> Iterator[str]:
        if not self.judgement.numbers:
            return
        heads = (said("Result"), said("handed in"), said("true"), said("Verdict"), OFF_WORD(), ALLOWED_WORD(),
                 said("Likely mistake"))
        rows = [(verdict.state, self._number(verdict)) for verdict in self.judgement.numbers]
        yield from self.table(said("Results"), said("In the units of the scene."), heads, rows)

    def _number(self, verdict: NumberVerdict) -> tuple[HtmlCell, ...]:
        name = result_named(self.judgement, verdict.number.kind, verdict.number.of)
        return (
            HtmlCell(self.set(name)), HtmlCell(self.say(number_words(verdict.number)), FIGURE),
            HtmlCell(self.say(number_text(verdict.true)), FIGURE), HtmlCell(self.say(STATES[verdict.state]()), STATE),
            *(HtmlCell(self.say(digits(size, SIGNIFICANT_DIGITS)), FIGURE)
              for size in (verdict.off, verdict.tolerance)),
            HtmlCell(self.set(verdict.mistake or "")),
        )  # fmt: skip


def picture(sheet: Sheet) -> str:
    """A sheet to stand in a page: without its own heading, and named by what it says."""
    text = svg(replace(sheet, scene=""), alone=False, role="img", aria_label=sheet.description)
    return text[text.index("<svg "):]


# ---- the report of a class ------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _ClassList(HtmlPage):
    """One class in words."""

    found: Classroom

    def body(self) -> Iterator[str]:
        """Yield the content of the page."""
        yield f"<h1>{escape(self.found.title)}</h1>"
        yield from (f"<p>{self.say(line)}</p>" for line in self.found.findings())
        first = {self.say(step.words_with_mark): count for step, count in self.found.histogram.items()}
        yield from self.bars(said("First wrong step"), first, len(self.found.marked))
        kinds = {self.say(mistake_words(kind)): count for kind, count in self.found.mistakes.items()}
        yield from self.bars(said("Mistakes"), kinds, len(self.found.marked))
        yield from self._drawings()
        yield from self._unread()

    def _drawings(self) -> Iterator[str]:
        heads = (said("Drawing"), said("Score"), said("First wrong step"), said("Likely mistake"), said("Verdict"))
        rows = [("" if drawing.guilty is None else "wrong", self._row(drawing))
                for drawing in self.found.in_order_of_doubt]
        yield from self.table(said("Drawings"), EACH(), heads, rows)

    def _row(self, one: MarkedDrawing) -> tuple[HtmlCell, ...]:
        return (
            HtmlCell(escape(one.file)), HtmlCell("" if one.score.total is None else f"{one.score.total:.0f}", FIGURE),
            HtmlCell("" if one.guilty is None else escape(one.guilty.short), FIGURE),
            HtmlCell(self.say(one.mistake or "")), HtmlCell(self.say(one.text)),
        )  # fmt: skip

    def _unread(self) -> Iterator[str]:
        if self.found.unread:
            rows = [("", (HtmlCell(escape(file.file)), HtmlCell(escape(file.why)))) for file in self.found.unread]
            yield from self.table(NOT_JUDGED(), said("Files that cannot be read, or do not show this drawing."),
                                  (said("Drawing"), said("Reason")), rows)


def results_page(found: StackResults, tongue: Tongue) -> str:
    """The page of the results of a class, in this tongue."""
    page = _ResultsPage(tongue, found)
    return page.page(found.title, page.body(), PICTURES)


@dataclass(frozen=True)
class _ResultsPage(HtmlPage):
    """The results of a class in words."""

    found: StackResults

    def body(self) -> Iterator[str]:
        """Yield the content of the page."""
        yield f"<h1>{escape(self.found.title)}</h1>"
        yield from (f"<p>{self.say(line)}</p>" for line in self.found.findings())
        yield from self._unassigned_pages()
        yield from self._sheets()
        if self.found.scores:
            yield from self.bars(said("Scores"), self.found.histogram, len(self.found.scores))
        yield from self._mistakes()
        yield from self._no_scans()

    def _unassigned_pages(self) -> Iterator[str]:
        """The pages that the teacher has to name, as pictures."""
        unnamed = self.found.with_status(UNASSIGNED, FAILED)
        if unnamed:
            yield f"<h2>{self.say(said('To be looked at'))}</h2><div class=\"pictures\">"
            for sheet in unnamed:
                why = f"{sheet.page}: {sheet.look_text}"
                picture = (f'<img src="data:image/jpeg;base64,{escape(sheet.thumbnail)}" alt="{escape(sheet.page)}">'
                           if sheet.thumbnail else "")
                yield f"<figure>{picture}<figcaption>{escape(why)}</figcaption></figure>"
            yield "</div>"

    def _sheets(self) -> Iterator[str]:
        heads = (said("Student"), said("Variant"), said("Page"), said("Score"), said("First wrong step"),
                 said("Verdict"), said("Certainty"), said("Look here"))
        rows = [("wrong" if sheet.first else "", self._row(sheet)) for sheet in self.found.in_order_of_doubt
                if sheet.status != UNASSIGNED]
        caption = said("Each step is judged from the student's own earlier marks.")
        yield from self.table(said("Sheets of the class"), caption, heads, rows)

    def _row(self, one: SheetResult) -> tuple[HtmlCell, ...]:
        name = escape(one.student)
        if one.corrected:
            name = f'<a href="{escape(one.corrected)}">{name or escape(one.corrected)}</a>'
        words = one.words if one.status == JUDGED else self.tongue(STATUS[one.status]())
        sure = "" if one.confidence is None else f"{100 * one.confidence:.0f} %"
        return (
            HtmlCell(name), HtmlCell("" if one.variant is None else str(one.variant), FIGURE),
            HtmlCell(escape(one.page)), HtmlCell("" if one.score is None else f"{one.score:.0f}", FIGURE),
            HtmlCell(escape(one.first), FIGURE), HtmlCell(escape(words)),
            HtmlCell(sure if one.status != ABSENT else "", FIGURE), HtmlCell(escape(one.look_text)),
        )  # fmt: skip

    def _mistakes(self) -> Iterator[str]:
        """The most frequent mistakes, with the places of some of them."""
        mistakes = self.found.mistakes
        kinds = {self.say(mistake_words(kind)): len(sheets) for kind, sheets in mistakes.items()}
        yield from self.bars(said("Mistakes"), kinds, len(self.found.with_status(JUDGED)))
        for kind, sheets in list(mistakes.items())[:measures.MISTAKES_SHOWN]:
            first_sheets = [one for one in sheets if one.detail][:measures.MISTAKES_SHOWN]
            if not first_sheets:
                continue
            yield f"<h3>{self.say(mistake_words(kind))}</h3><div class=\"pictures\">"
            for sheet in first_sheets:
                yield f"<figure>{sheet.detail}<figcaption>{escape(sheet.student or sheet.page)}: {escape(sheet.words)}"
                yield "</figcaption></figure>"
            yield "</div>"

    def _no_scans(self) -> Iterator[str]:
        if self.found.unread:
            rows = [("", (HtmlCell(escape(file.file)), HtmlCell(escape(file.why)))) for file in self.found.unread]
            yield from self.table(said("No scans"), said("Files that are left out."), (said("File"), said("Reason")),
                                  rows)
