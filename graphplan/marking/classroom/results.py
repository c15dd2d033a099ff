"""The results of a class: a line for each drawing, what went wrong most often, and lists for a spreadsheet."""

from __future__ import annotations

import csv
import io
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from importlib.util import find_spec
from itertools import islice
from statistics import fmean
from typing import Any

from graphplan.errors import missing_package
from graphplan.marking.classroom import measures
from graphplan.marking.judge.findings import (
    StepName,
    complaint,
    look_at_lines,
    not_handed_in,
    opinion,
    reading_lines,
    step_name,
    wrong_numbers,
)
from graphplan.marking.judge.score import GROUPS, KINDS, UNJUDGED, Score
from graphplan.marking.judge.verdict import Judgement
from graphplan.phrases import Phrase, Said, arrange, join, phrase, said

Row = Sequence[str | float | None]


FORMULA = re.compile(r"[=+\-@\t\r](?!\s*[\d.,]+$)..*", re.DOTALL)


def csv_text(rows: Iterable[Row]) -> str:
    """Rows as CSV; what spreadsheets would take for a formula stands behind an apostrophe, as text does there."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(
        [f"'{cell}" if isinstance(cell, str) and FORMULA.match(cell) else cell for cell in row] for row in rows)
    return text.getvalue()


def require_openpyxl(output: str) -> None:
    """Refuse a workbook that cannot be written here, before anything is judged."""
    if not find_spec("openpyxl"):
        raise missing_package(output, "openpyxl", "xlsx", "a name in .csv, which spreadsheets read")


def workbook(rows: Iterable[Row]) -> bytes:
    """Rows as a workbook; what begins as a formula does stays text."""
    from openpyxl import Workbook

    book, data = Workbook(), io.BytesIO()
    for row in rows:
        book.active.append(row)
    for cell in (cell for cells in book.active for cell in cells if cell.data_type == "f"):
        cell.data_type = "s"
    book.save(data)
    return data.getvalue()


NOT_JUDGED = phrase("Not judged")


@dataclass(frozen=True)
class MarkedDrawing:
    """A drawing that was judged."""

    judgement: Judgement
    score: Score
    by_teacher: bool = False  # whether the teacher has settled it

    @property
    def file(self) -> str:
        """The name of its file."""
        return self.judgement.name

    @property
    def guilty(self) -> StepName | None:
        """The step to blame for the first wrong one; None where no step is wrong."""
        index = self.judgement.first_wrong_step
        return None if index is None else step_name(self.judgement.drawing.drawn, index)

    @property
    def faultless(self) -> bool:
        """Whether the drawing could be judged, and is without a wrong or missing step."""
        return self.score.total is not None and not (
            self.judgement.first_wrong or wrong_numbers(self.judgement) or not_handed_in(self.judgement))

    @property
    def mistake(self) -> Said | None:
        """Probable mistake at the first wrong step."""
        return self.judgement.first_wrong.mistake if self.judgement.first_wrong else None

    @property
    def text(self) -> Said:
        """The verdict in words."""
        return join((*self.score.teacher_lines, self._judged_text), " ")

    @property
    def _judged_text(self) -> Said:
        if self.judgement.first_wrong is not None:
            return complaint(self.judgement, self.judgement.first_wrong)
        if self.score.judge_score is None:
            return UNJUDGED()
        if self.faultless:
            return said("no wrong step")
        return join((opinion(self.judgement), *look_at_lines(self.judgement)), " ")

    @property
    def look(self) -> list[Said]:
        """Remarks for the teacher."""
        return [*reading_lines(self.judgement), *look_at_lines(self.judgement)]

    @property
    def confidence(self) -> float:
        """Certainty of the verdict: that on the first wrong step, or the least of all."""
        first = self.judgement.first_wrong
        counting = self.judgement.counting_verdicts if self.judgement.has_drawn else []
        return min((verdict.confidence for verdict in ([first] if first else counting)), default=1.0)


def certainty(judged: MarkedDrawing | SheetResult) -> float:
    """Certainty of a verdict, by which drawings to be looked at are listed; the teacher's own is settled."""
    sure = judged.confidence
    settled = judged.by_teacher or (sure is not None and sure >= measures.MIN_SURE_CHANCE and not judged.look)
    return measures.SETTLED_CHANCE if sure is None or settled else sure


@dataclass(frozen=True)
class Unread:
    """A file that could not be judged, and why."""

    file: str
    why: str


@dataclass(frozen=True)
class Classroom:
    """All drawings of a class, in the order of their files; each is judged by the construction that it follows."""

    title: str
    marked: tuple[MarkedDrawing, ...]
    unread: tuple[Unread, ...] = ()

    @property
    def mean(self) -> float | None:
        """The mean score; None if no drawing could be judged."""
        totals = [total for drawing in self.marked if (total := drawing.score.total) is not None]
        return fmean(totals) if totals else None

    @property
    def in_order_of_doubt(self) -> list[MarkedDrawing]:
        """All drawings, those first that are to be looked at."""
        return sorted(self.marked, key=certainty)

    @property
    def histogram(self) -> dict[StepName, int]:
        """Number of drawings by their first wrong step, by its name, in drawing order."""
        firsts = (first for drawing in self.marked if (first := drawing.guilty) is not None)
        return dict(sorted(Counter(firsts).items()))

    @property
    def mistakes(self) -> dict[str, int]:
        """Number of drawings by kind of mistake, the most frequent first."""
        kinds = (first.kind
                 for drawing in self.marked if (first := drawing.judgement.first_wrong) is not None and first.kind)
        return dict(sorted(Counter(kinds).items(), key=lambda found: (-found[1], found[0])))

    @property
    def hardest(self) -> StepName | None:
        """The step that is wrong first most often, the earlier of equals."""
        counts = self.histogram
        return max(counts, key=counts.__getitem__, default=None)  # the first of equals

    def findings(self) -> Iterator[Said]:
        """Yield the remarks on the class."""
        faultless = sum(drawing.faultless for drawing in self.marked)
        yield said("Drawings: {0}; without a wrong step: {1}.", len(self.marked), faultless)
        yield from _mean_and_mistake(self.mean, self.mistakes)
        yield from _look_first([drawing.file for drawing in self.in_order_of_doubt
                                if certainty(drawing) < measures.SETTLED_CHANCE])
        if self.hardest is not None:
            yield said("Most frequent first wrong step: {0} ({1}).", self.hardest.words_with_mark,
                       self.histogram[self.hardest])
        if self.unread:
            yield arrange("{0}: {1}.", NOT_JUDGED(), len(self.unread))

    @property
    def data(self) -> dict[str, Any]:
        """The results as data."""
        hardest = self.hardest
        kind = next(iter(self.mistakes), None)
        return {
            "title": self.title,
            "drawings": [{"file": entry.file, "score": entry.score.total,
                          "judged_score": entry.score.judge_score, "note": entry.score.note,
                          "first_wrong": entry.guilty and entry.guilty.number,
                          "mistake": None if entry.mistake is None else str(entry.mistake)} for entry in self.marked],
            "not_judged": [{"file": entry.file, "why": entry.why} for entry in self.unread],
            "mean_score": self.mean,
            "most_frequent_mistake": kind,
            "most_frequent_first_wrong": hardest and hardest.number,
            "mistakes": self.mistakes,
            "first_wrong_steps": [{"step": step.number, "mark": step.mark, "drawings": count}
                                  for step, count in self.histogram.items()],
        }  # fmt: skip


def _mean_and_mistake(mean: float | None, mistakes: Mapping[str, int]) -> Iterator[Said]:
    """Yield the mean score, and the most frequent kind of mistake with its number, as far as they exist."""
    if mean is not None:
        yield said("Mean score: {0} of 100.", f"{mean:.0f}")
    for kind, count in islice(mistakes.items(), 1):
        yield said("Most frequent mistake: {0} ({1}).", mistake_words(kind), count)


def _look_first(names: Sequence[str]) -> Iterator[Said]:
    """Yield the names of those to be looked at first, if there are any."""
    if names:
        yield said("To be looked at first: {0}.", ", ".join(names))


def mistake_words(kind: str) -> Said:
    """A kind of mistake in words."""
    return KINDS[kind]()


def class_lines(found: Classroom) -> Iterator[Said]:
    """The class as text: a line for each drawing, those first that are to be looked at, then the findings."""
    for drawing in found.in_order_of_doubt:
        points = [] if drawing.score.total is None else [said("{0} of 100", f"{drawing.score.total:.0f}")]
        yield arrange("{0}: {1}", drawing.file, join((*points, drawing.text), "; "))
    yield from found.findings()


JUDGED, AGAIN, JOINED, ASIDE, UNASSIGNED, FAILED, ABSENT = (
    "judged", "again", "joined", "set aside", "unassigned", "not judged", "not handed in")
STATUS: Mapping[str, Phrase] = {
    JUDGED: phrase("judged"), AGAIN: phrase("handed in twice"), JOINED: phrase("a further page"),
    ASIDE: phrase("set aside"), UNASSIGNED: phrase("unassigned"), FAILED: phrase("not judged"),
    ABSENT: phrase("not handed in"),
}  # fmt: skip
UNSAFE_CHARS = re.compile(r"[^\w \-.,()]|[. ]+$")
RESERVED_NAMES = re.compile(r"(?i)(con|prn|aux|nul|com\d|lpt\d)(\.|$)")


@dataclass(frozen=True)
class SheetResult:
    """What there is to say of a sheet, or of a student without one; words are in the tongue of the sheets.

    `first` is the number of the first wrong step or a given point's letter, `words` the verdict, `kind` the
    kind of mistake, `look` what the teacher must look at, `detail` a picture of the place as SVG, `thumbnail` one of
    the whole page as a JPEG in base 64, `corrected` the file to hand back, `note` and `by_teacher` whether the
    score is the teacher's own, `group` the student's, `judgement` all that was judged, `review` its steps for the
    teacher to look at, and `overlaid` the file of the sheet with what was read laid over it.
    """

    status: str
    page: str = ""
    variant: int | None = None
    student: str = ""
    score: float | None = None
    groups: Mapping[str, float] = field(default_factory=dict)
    first: str = ""
    words: str = ""
    faultless: bool = False
    kind: str = ""
    confidence: float | None = None
    look: tuple[str, ...] = ()
    detail: str = ""
    thumbnail: str = ""
    corrected: str = ""
    note: str = ""
    by_teacher: bool = False
    group: str = ""
    judgement: Mapping[str, Any] | None = None
    review: Sequence[Mapping[str, Any]] = ()
    overlaid: str = ""

    @property
    def look_text(self) -> str:
        """Remarks for the teacher, in one line."""
        return "; ".join(line.rstrip(".") for line in self.look)


@dataclass(frozen=True)
class StackResults:
    """All sheets of a class: first those of its register, then pages without a name; how many pages are blank, and
    files that are no scans."""

    title: str
    language: str
    sheets: tuple[SheetResult, ...]
    blank: int = 0
    unread: tuple[Unread, ...] = ()

    def with_status(self, *status: str) -> list[SheetResult]:
        """The sheets of which this is so."""
        return [sheet for sheet in self.sheets if sheet.status in status]

    @property
    def scores(self) -> list[float]:
        """The scores that count."""
        return [sheet.score for sheet in self.with_status(JUDGED) if sheet.score is not None]

    @property
    def doubtful(self) -> list[SheetResult]:
        """The judged sheets of which the verdict is not certain, the least certain first."""
        return [sheet for sheet in self.in_order_of_doubt if self._certainty(sheet) < measures.SETTLED_CHANCE]

    @property
    def in_order_of_doubt(self) -> list[SheetResult]:
        """All sheets, those first that are to be looked at."""
        return sorted(self.sheets, key=self._certainty)

    @staticmethod
    def _certainty(sheet: SheetResult) -> float:
        return certainty(sheet) if sheet.status == JUDGED else measures.SETTLED_CHANCE

    @property
    def mean(self) -> float | None:
        """The mean score; None if no sheet was judged."""
        return fmean(self.scores) if self.scores else None

    @property
    def histogram(self) -> dict[str, int]:
        """Number of scores in each tenth, the hundred in the last."""
        counts = Counter(min(int(score * measures.SCORE_BINS / 100), measures.SCORE_BINS - 1) for score in self.scores)
        wide = 100 // measures.SCORE_BINS
        return {f"{wide * i}–{wide * (i + 1)}": counts[i] for i in range(measures.SCORE_BINS)}

    @property
    def mistakes(self) -> dict[str, list[SheetResult]]:
        """The sheets that go wrong first by each kind of mistake, the most frequent first."""
        sheets_of_kind: dict[str, list[SheetResult]] = {}
        for sheet in self.with_status(JUDGED):
            if sheet.kind:
                sheets_of_kind.setdefault(sheet.kind, []).append(sheet)
        return dict(sorted(sheets_of_kind.items(), key=lambda kind: (-len(kind[1]), kind[0])))

    def findings(self) -> Iterator[Said]:
        """Yield the remarks on the class."""
        yield said("Sheets judged: {0}; without a wrong step: {1}.", len(self.with_status(JUDGED)),
                   sum(sheet.faultless for sheet in self.with_status(JUDGED)))
        yield from _mean_and_mistake(self.mean, {kind: len(sheets) for kind, sheets in self.mistakes.items()})
        yield from _look_first([sheet.student or sheet.page for sheet in self.doubtful])
        if absent := self.with_status(ABSENT):
            yield said("Not handed in: {0}.", ", ".join(sheet.student for sheet in absent))
        if twice := self.with_status(AGAIN):
            yield said("Handed in twice: {0}.", ", ".join(sheet.student or sheet.page for sheet in twice))
        if failed := self.with_status(FAILED):
            yield said("Could not be judged: {0}.", ", ".join(sheet.page for sheet in failed))
        if unassigned := self.with_status(UNASSIGNED):
            names = ", ".join(sheet.page for sheet in unassigned)
            yield said("Left to be named, by --assign PAGE=STUDENT: {0}.", names)
        if self.blank:
            yield said("Blank pages: {0}.", self.blank)
        if self.unread:
            yield said("No scans: {0}.", ", ".join(file.file for file in self.unread))

    @property
    def table(self) -> Iterator[Row]:
        """A table with a line for each sheet."""
        yield ["page", "variant", "student", "status", "score", *GROUPS, "first_wrong_step", "verdict", "kind",
               "confidence", "look", "corrected", "note", "group"]
        for sheet in self.sheets:
            scores = (sheet.score, *map(sheet.groups.get, GROUPS))
            yield [sheet.page, sheet.variant, sheet.student, sheet.status,
                   *(None if score is None else round(score, 1) for score in scores), sheet.first, sheet.words,
                   sheet.kind, sheet.confidence, sheet.look_text, sheet.corrected, sheet.note, sheet.group]

    @property
    def data(self) -> dict[str, Any]:
        """All of it but the pictures, as data."""
        left_out = {"detail", "thumbnail", "review", "overlaid"}
        sheets = [{name: value for name, value in asdict(sheet).items() if name not in left_out}
                  for sheet in self.sheets]
        return {
            "title": self.title, "sheets": sheets, "blank_pages": self.blank,
            "unread": [asdict(file) for file in self.unread], "mean_score": self.mean, "histogram": self.histogram,
            "mistakes": {kind: len(sheets_of_kind) for kind, sheets_of_kind in self.mistakes.items()},
        }  # fmt: skip


def file_names(wanted: Sequence[str]) -> list[str]:
    """Names of files for what is called so: safe on any system, no two alike whatever their letters' size."""
    taken, names = set[str](), list[str]()
    for name in wanted:
        safe = UNSAFE_CHARS.sub("_", name.strip())[:measures.MAX_FILE_NAME_CHARS].lstrip(".") or "_"
        safe = f"_{safe}" if RESERVED_NAMES.match(safe) else safe
        again, unique = 1, safe
        while unique.casefold() in taken:
            again += 1
            unique = f"{safe}-{again}"
        taken.add(unique.casefold())
        names.append(unique)
    return names
