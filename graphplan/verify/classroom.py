"""The drawings of a class: a line for each, what went wrong most often, and where."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from statistics import fmean
from typing import Any

from graphplan.kernel.program import Program
from graphplan.phrases import Phrase, Said, arranged, joined, phrase, said
from graphplan.verify.findings import complaint, named, place
from graphplan.verify.score import NOTHING, Score
from graphplan.verify.verdict import Judgement

NOT_JUDGED = phrase("Not judged")
MISTAKEN: Mapping[str, Phrase] = {  # the kinds of mistake, as they are told of a class
    "perpendicular missed": phrase("parallel instead of perpendicular"),
    "parallel missed": phrase("perpendicular instead of parallel"),
    "wrong line": phrase("parallel or perpendicular to the wrong line"),
    "wrong point": phrase("drawn through the wrong point"),
    "wrong crossing": phrase("the wrong lines crossed"),
    "wrong side": phrase("the other of the two crossings"),
    "mirrored figure": phrase("the figure is mirrored"),
    "reversed": phrase("the vector has the wrong sense"),
    "turned the wrong way": phrase("the vector is a quarter turn off"),
    "wrong scale": phrase("a vector of the wrong length"),
    "wrong start": phrase("laid off from the wrong point"),
    "wrong vector": phrase("the wrong vector carried over"),
    "wrong centre": phrase("struck about the wrong centre"),
    "wrong opening": phrase("struck with the wrong opening"),
    "exchanged coordinates": phrase("coordinates exchanged, or of the wrong sign"),
}


@dataclass(frozen=True)
class Marked:
    """A drawing that was judged, by the name of its file."""

    file: str
    judgement: Judgement
    score: Score


@dataclass(frozen=True)
class Unread:
    """A file that could not be judged, and why."""

    file: str
    why: str


@dataclass(frozen=True)
class Row:
    """A drawing in one line: its score, its first wrong step by number and in words, its mistake."""

    file: str
    score: float | None
    step: int | None
    told: Said | None
    mistake: Said | None


@dataclass(frozen=True)
class Classroom:
    """All drawings of a class, in the order of their files; each is of the scene's construction `drawn`."""

    title: str
    drawn: Program
    marked: tuple[Marked, ...]
    unread: tuple[Unread, ...] = ()

    @property
    def rows(self) -> list[Row]:
        """A line for every drawing."""
        return [_row(one) for one in self.marked]

    @property
    def mean(self) -> float | None:
        """The mean score; none where nothing could be judged."""
        totals = [total for one in self.marked if (total := one.score.total) is not None]
        return fmean(totals) if totals else None

    @property
    def histogram(self) -> dict[int, int]:
        """How many drawings have each step for their first wrong one, by its place in the program, in drawing order."""
        firsts = (first for one in self.marked if (first := one.judgement.guilty) is not None)
        return dict(sorted(Counter(firsts).items()))

    @property
    def mistakes(self) -> dict[str, int]:
        """How many drawings go wrong by each kind of mistake, the most frequent first."""
        kinds = (first.kind for one in self.marked if (first := one.judgement.first) is not None and first.kind)
        return dict(sorted(Counter(kinds).items(), key=lambda found: (-found[1], found[0])))

    @property
    def hardest(self) -> int | None:
        """The step that is wrong first most often, the earlier of equals."""
        return max(self.histogram, key=lambda index: (self.histogram[index], -index), default=None)

    def findings(self) -> Iterator[Said]:
        """What there is to say of the class."""
        faultless = sum(one.judgement.first is None for one in self.marked)
        yield said("Drawings: {0}, of which {1} have no wrong step.", len(self.marked), faultless)
        if self.mean is not None:
            yield said("Mean score: {0} of 100.", f"{self.mean:.0f}")
        if self.mistakes:
            kind, count = next(iter(self.mistakes.items()))
            yield said("Most frequent mistake: {0} ({1}).", mistaken(kind), count)
        if self.hardest is not None:
            yield said("Most frequent first wrong step: {0} ({1}).", named(self.drawn, self.hardest),
                       self.histogram[self.hardest])
        if self.unread:
            yield arranged("{0}: {1}.", NOT_JUDGED(), len(self.unread))

    @property
    def data(self) -> dict[str, Any]:
        """The same as data."""
        drawn, hardest = self.drawn, self.hardest
        kind = next(iter(self.mistakes), None)
        return {
            "title": self.title,
            "drawings": [{"file": row.file, "score": row.score, "first_wrong": row.step,
                          "mistake": None if row.mistake is None else str(row.mistake)} for row in self.rows],
            "not_judged": [{"file": one.file, "why": one.why} for one in self.unread],
            "mean_score": self.mean,
            "most_frequent_mistake": kind,
            "most_frequent_first_wrong": None if hardest is None else place(drawn, hardest),
            "mistakes": self.mistakes,
            "first_wrong_steps": [{"step": place(drawn, index), "mark": drawn.text(index), "drawings": count}
                                  for index, count in self.histogram.items()],
        }  # fmt: skip


def mistaken(kind: str) -> Said:
    """A kind of mistake in words."""
    return MISTAKEN[kind]()


def _row(one: Marked) -> Row:
    judgement, first = one.judgement, one.judgement.first
    if first is None:
        return Row(one.file, one.score.total, None, None, None)
    guilty = judgement.guilty
    assert guilty is not None
    return Row(one.file, one.score.total, place(judgement.drawing.drawn, guilty), complaint(judgement, first),
               first.mistake)


def lines(found: Classroom) -> Iterator[Said]:
    """The class as text: a line for each drawing and each file that could not be judged, then the findings."""
    for row in found.rows:
        told = said("no wrong step") if row.told is None else row.told
        yield arranged("{0}: {1}", row.file, joined((_points(row.score), told), "; "))
    yield from found.findings()


def _points(total: float | None) -> Said:
    return NOTHING() if total is None else said("{0} of 100", f"{total:.0f}")
