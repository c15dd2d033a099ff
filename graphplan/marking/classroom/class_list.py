"""The drawings of a class: a line for each, what went wrong most often, and where."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from statistics import fmean
from typing import Any

from graphplan.marking.judge.findings import Called, called, complaint, look_at, not_handed_in, opinion, wrong_numbers
from graphplan.marking.judge.score import KINDS, UNJUDGED, Score
from graphplan.marking.judge.verdict import Judgement
from graphplan.phrases import Said, arrange, join, phrase, said

NOT_JUDGED = phrase("Not judged")


@dataclass(frozen=True)
class Marked:
    """A drawing that was judged."""

    judgement: Judgement
    score: Score

    @property
    def file(self) -> str:
        """The name of its file."""
        return self.judgement.name

    @property
    def guilty(self) -> Called | None:
        """The step to blame for the first wrong one; None where no step is wrong."""
        index = self.judgement.guilty
        return None if index is None else called(self.judgement.drawing.drawn, index)

    @property
    def faultless(self) -> bool:
        """Whether something could be judged, and nothing is wrong or missing."""
        return self.score.total is not None and not (
            self.judgement.first or wrong_numbers(self.judgement) or not_handed_in(self.judgement))

    @property
    def mistake(self) -> Said | None:
        """What was probably done at the first wrong step."""
        return self.judgement.first.mistake if self.judgement.first else None

    @property
    def told(self) -> Said:
        """The verdict in words."""
        if self.judgement.first is not None:
            return complaint(self.judgement, self.judgement.first)
        if self.score.total is None:
            return UNJUDGED()
        if self.faultless:
            return said("no wrong step")
        return join((opinion(self.judgement), *look_at(self.judgement)), " ")


@dataclass(frozen=True)
class Unread:
    """A file that could not be judged, and why."""

    file: str
    why: str


@dataclass(frozen=True)
class Classroom:
    """All drawings of a class, in the order of their files; each is judged by the construction that it follows."""

    title: str
    marked: tuple[Marked, ...]
    unread: tuple[Unread, ...] = ()

    @property
    def mean(self) -> float | None:
        """The mean score; none where nothing could be judged."""
        totals = [total for one in self.marked if (total := one.score.total) is not None]
        return fmean(totals) if totals else None

    @property
    def histogram(self) -> dict[Called, int]:
        """How many drawings have each step for their first wrong one, by what it is called, in drawing order."""
        firsts = (first for one in self.marked if (first := one.guilty) is not None)
        return dict(sorted(Counter(firsts).items()))

    @property
    def mistakes(self) -> dict[str, int]:
        """How many drawings go wrong by each kind of mistake, the most frequent first."""
        kinds = (first.kind for one in self.marked if (first := one.judgement.first) is not None and first.kind)
        return dict(sorted(Counter(kinds).items(), key=lambda found: (-found[1], found[0])))

    @property
    def hardest(self) -> Called | None:
        """The step that is wrong first most often, the earlier of equals."""
        found = self.histogram
        return max(found, key=found.__getitem__, default=None)  # the first of equals

    def findings(self) -> Iterator[Said]:
        """What there is to say of the class."""
        faultless = sum(one.faultless for one in self.marked)
        yield said("Drawings: {0}, of which {1} have no wrong step.", len(self.marked), faultless)
        if self.mean is not None:
            yield said("Mean score: {0} of 100.", f"{self.mean:.0f}")
        if self.mistakes:
            kind, count = next(iter(self.mistakes.items()))
            yield said("Most frequent mistake: {0} ({1}).", mistaken(kind), count)
        if self.hardest is not None:
            yield said("Most frequent first wrong step: {0} ({1}).", self.hardest.told,
                       self.histogram[self.hardest])
        if self.unread:
            yield arrange("{0}: {1}.", NOT_JUDGED(), len(self.unread))

    @property
    def data(self) -> dict[str, Any]:
        """The same as data."""
        hardest = self.hardest
        kind = next(iter(self.mistakes), None)
        return {
            "title": self.title,
            "drawings": [{"file": one.file, "score": one.score.total, "first_wrong": one.guilty and one.guilty.number,
                          "mistake": None if one.mistake is None else str(one.mistake)} for one in self.marked],
            "not_judged": [{"file": one.file, "why": one.why} for one in self.unread],
            "mean_score": self.mean,
            "most_frequent_mistake": kind,
            "most_frequent_first_wrong": hardest and hardest.number,
            "mistakes": self.mistakes,
            "first_wrong_steps": [{"step": step.number, "mark": step.mark, "drawings": count}
                                  for step, count in self.histogram.items()],
        }  # fmt: skip


def mistaken(kind: str) -> Said:
    """A kind of mistake in words."""
    return KINDS[kind]()


def lines(found: Classroom) -> Iterator[Said]:
    """The class as text: a line for each drawing and each file that could not be judged, then the findings."""
    for one in found.marked:
        points = [] if one.score.total is None else [said("{0} of 100", f"{one.score.total:.0f}")]
        yield arrange("{0}: {1}", one.file, join((*points, one.told), "; "))
    yield from found.findings()
