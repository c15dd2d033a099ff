"""The results of a stack: a line for each sheet, what went wrong most often, and what is left to the teacher."""

from __future__ import annotations

import csv
import io
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from statistics import fmean
from typing import Any

from graphplan.marking.classroom.class_list import Unread, mistaken
from graphplan.marking.judge.score import GROUPS
from graphplan.phrases import Phrase, Said, phrase, said

JUDGED, AGAIN, JOINED, ASIDE, UNASSIGNED, FAILED, ABSENT = (
    "judged", "again", "joined", "set aside", "unassigned", "not judged", "not handed in")
STATUS: Mapping[str, Phrase] = {
    JUDGED: phrase("judged"), AGAIN: phrase("handed in twice"), JOINED: phrase("a further page"),
    ASIDE: phrase("set aside"), UNASSIGNED: phrase("unassigned"), FAILED: phrase("not judged"),
    ABSENT: phrase("not handed in"),
}  # fmt: skip
BINS = 10  # of the histogram of scores
SHOWN = 5  # the most frequent mistakes that are shown, and how many pictures of each
LONGEST = 60  # characters of a file's name
UNSAFE = re.compile(r"[^\w \-.,()]|[. ]+$")
RESERVED = re.compile(r"(?i)(con|prn|aux|nul|com\d|lpt\d)(\.|$)")


@dataclass(frozen=True)
class SheetResult:
    """What there is to say of a sheet, or of a student without one; words are in the tongue of the sheets.

    `first` is the number of the first wrong step or a given point's letter, `words` the verdict, `kind` the
    kind of mistake, `look` what the teacher must look at, `detail` a picture of the place as SVG, `thumbnail` one of
    the whole page as a JPEG in base 64, `corrected` the file to hand back, `judgement` all that was judged.
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
    judgement: Mapping[str, Any] | None = None

    @property
    def told(self) -> str:
        """What the teacher must look at, in one line."""
        return "; ".join(line.rstrip(".") for line in self.look)


@dataclass(frozen=True)
class Results:
    """All sheets of a class: first those of its register, then pages without a name; how many pages are blank, and
    files that are no scans."""

    title: str
    language: str
    sheets: tuple[SheetResult, ...]
    blank: int = 0
    unread: tuple[Unread, ...] = ()

    def of(self, *status: str) -> list[SheetResult]:
        """The sheets of which this is so."""
        return [sheet for sheet in self.sheets if sheet.status in status]

    @property
    def scores(self) -> list[float]:
        """The scores that count."""
        return [sheet.score for sheet in self.of(JUDGED) if sheet.score is not None]

    @property
    def mean(self) -> float | None:
        """The mean score; none where nothing was judged."""
        return fmean(self.scores) if self.scores else None

    @property
    def histogram(self) -> dict[str, int]:
        """How many scores there are in each tenth, the hundred in the last."""
        counts = Counter(min(int(score * BINS / 100), BINS - 1) for score in self.scores)
        wide = 100 // BINS
        return {f"{wide * i}–{wide * (i + 1)}": counts[i] for i in range(BINS)}

    @property
    def mistakes(self) -> dict[str, list[SheetResult]]:
        """The sheets that go wrong first by each kind of mistake, the most frequent first."""
        found: dict[str, list[SheetResult]] = {}
        for sheet in self.of(JUDGED):
            if sheet.kind:
                found.setdefault(sheet.kind, []).append(sheet)
        return dict(sorted(found.items(), key=lambda kind: (-len(kind[1]), kind[0])))

    def findings(self) -> Iterator[Said]:
        """What there is to say of the class."""
        yield said("Sheets judged: {0}, of which {1} have no wrong step.", len(self.of(JUDGED)),
                   sum(sheet.faultless for sheet in self.of(JUDGED)))
        if self.mean is not None:
            yield said("Mean score: {0} of 100.", f"{self.mean:.0f}")
        if self.mistakes:
            kind, sheets = next(iter(self.mistakes.items()))
            yield said("Most frequent mistake: {0} ({1}).", mistaken(kind), len(sheets))
        if absent := self.of(ABSENT):
            yield said("Not handed in: {0}.", ", ".join(sheet.student for sheet in absent))
        if twice := self.of(AGAIN):
            yield said("Handed in twice: {0}.", ", ".join(sheet.student or sheet.page for sheet in twice))
        if failed := self.of(FAILED):
            yield said("Could not be judged: {0}.", ", ".join(sheet.page for sheet in failed))
        if unassigned := self.of(UNASSIGNED):
            names = ", ".join(sheet.page for sheet in unassigned)
            yield said("Left to be named, by --assign PAGE=STUDENT: {0}.", names)
        if self.blank:
            yield said("Blank pages: {0}.", self.blank)
        if self.unread:
            yield said("No scans: {0}.", ", ".join(one.file for one in self.unread))

    @property
    def csv(self) -> str:
        """A table with a line for each sheet."""
        written = io.StringIO()
        table = csv.writer(written, lineterminator="\n")
        table.writerow(["page", "variant", "student", "status", "score", *GROUPS, "first_wrong_step", "verdict",
                        "kind", "confidence", "look", "corrected"])
        for one in self.sheets:
            groups = (_rounded(one.groups.get(group)) for group in GROUPS)
            table.writerow([one.page, one.variant, one.student, one.status, _rounded(one.score), *groups, one.first,
                            one.words, one.kind, one.confidence, one.told, one.corrected])
        return written.getvalue()

    @property
    def data(self) -> dict[str, Any]:
        """All of it but the pictures, as data."""
        left_out = {"detail", "thumbnail"}
        sheets = [{name: value for name, value in asdict(one).items() if name not in left_out} for one in self.sheets]
        return {
            "title": self.title, "sheets": sheets, "blank_pages": self.blank,
            "unread": [asdict(file) for file in self.unread], "mean_score": self.mean, "histogram": self.histogram,
            "mistakes": {kind: len(found) for kind, found in self.mistakes.items()},
        }  # fmt: skip


def _rounded(score: float | None) -> float | None:
    """A score as a table has it."""
    return None if score is None else round(score, 1)


def file_names(wanted: Sequence[str]) -> list[str]:
    """Names of files for what is called so: safe on any system, no two alike whatever their letters' size."""
    taken, found = set[str](), list[str]()
    for name in wanted:
        safe = UNSAFE.sub("_", name.strip())[:LONGEST].lstrip(".") or "_"
        safe = f"_{safe}" if RESERVED.match(safe) else safe
        again, other = 1, safe
        while other.casefold() in taken:
            again += 1
            other = f"{safe}-{again}"
        taken.add(other.casefold())
        found.append(other)
    return found
