"""The report of a class as one page for a browser: what went wrong most often, where, and a line for each drawing."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from html import escape

from graphplan.marking.classroom import NOT_JUDGED, Classroom, Marked, mistaken
from graphplan.output.report_page import FIGURE, HtmlCell, page, table
from graphplan.phrases import said
from graphplan.words.tongue import Tongue

LONGEST = 16.0  # em: the longest bar


def class_list(found: Classroom, tongue: Tongue) -> str:
    """The page of a class, in this tongue."""
    return page(tongue, found.title, _ClassList(found, tongue).body())


@dataclass(frozen=True)
class _ClassList:
    """One class in words."""

    found: Classroom
    tongue: Tongue

    def say(self, text: str) -> str:
        """Words as HTML."""
        return escape(self.tongue(text))

    def body(self) -> Iterator[str]:
        """What stands on the page."""
        yield f"<h1>{escape(self.found.title)}</h1>"
        yield from (f"<p>{self.say(told)}</p>" for told in self.found.findings())
        first = {self.say(step.told): count for step, count in self.found.histogram.items()}
        yield from self._bars(said("First wrong step"), first)
        kinds = {self.say(mistaken(kind)): count for kind, count in self.found.mistakes.items()}
        yield from self._bars(said("Mistakes"), kinds)
        yield from self._drawings()
        yield from self._unread()

    def _drawings(self) -> Iterator[str]:
        heads = (said("Drawing"), said("Score"), said("First wrong step"), said("Likely mistake"), said("Verdict"))
        rows = [("" if one.guilty is None else "wrong", self._row(one)) for one in self.found.marked]
        yield f"<h2>{self.say(said('Drawings'))}</h2>"
        yield from table(self.say(said("Each step is judged from the student's own earlier marks.")),
                         [self.say(head) for head in heads], rows)

    def _row(self, one: Marked) -> tuple[HtmlCell, ...]:
        return (
            HtmlCell(escape(one.file)), HtmlCell("" if one.score.total is None else f"{one.score.total:.0f}", FIGURE),
            HtmlCell("" if one.guilty is None else escape(one.guilty.short), FIGURE),
            HtmlCell(self.say(one.mistake or "")), HtmlCell(self.say(one.told)),
        )  # fmt: skip

    def _unread(self) -> Iterator[str]:
        if self.found.unread:
            yield f"<h2>{self.say(NOT_JUDGED())}</h2>"
            rows = [("", (HtmlCell(escape(one.file)), HtmlCell(escape(one.why)))) for one in self.found.unread]
            yield from table(self.say(said("Files that could not be read, or show no such drawing.")),
                             (self.say(said("Drawing")), self.say(said("Reason"))), rows)

    def _bars(self, head: str, counts: Mapping[str, int]) -> Iterator[str]:
        """Counts as a table with a bar for each; nothing if there are none."""
        if not counts:
            return
        most = max(counts.values())
        rows = [("", (HtmlCell(name), HtmlCell(str(count), FIGURE),
                      HtmlCell(f'<span class="bar" style="width: {LONGEST * count / most:.2f}em"></span>')))
                for name, count in counts.items()]
        yield f"<h2>{self.say(head)}</h2>"
        yield from table(self.say(said("How many drawings, of {0}.", len(self.found.marked))),
                         ("", self.say(said("Drawings")), ""), rows)
