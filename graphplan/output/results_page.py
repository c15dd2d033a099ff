"""The results of a stack of scans as one page for a browser, without scripts or a network."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from html import escape

from graphplan.marking.classroom.results import (
    ABSENT,
    FAILED,
    JUDGED,
    MISTAKES_SHOWN,
    STATUS,
    UNASSIGNED,
    SheetResult,
    StackResults,
    mistake_words,
)
from graphplan.output.report_page import FIGURE, PICTURES, HtmlCell, HtmlPage
from graphplan.phrases import said
from graphplan.words.tongue import Tongue


def results_page(found: StackResults, tongue: Tongue) -> str:
    """The page of the results of a class, in this tongue."""
    page = _ResultsPage(tongue, found)
    return page.page(found.title, page.body(), PICTURES)


@dataclass(frozen=True)
class _ResultsPage(HtmlPage):
    """The results of a class in words."""

    found: StackResults

    def body(self) -> Iterator[str]:
        """What stands on the page."""
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
        for kind, sheets in list(mistakes.items())[:MISTAKES_SHOWN]:
            first_sheets = [one for one in sheets if one.detail][:MISTAKES_SHOWN]
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
