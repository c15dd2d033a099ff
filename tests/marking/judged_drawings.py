"""Hand drawings of every kind as `graphplan verify` judges them, and the shares in which it is right.

`python tests/bench/judging.py` prints the shares of 60 drawings a kind, of fresh seeds; the suite holds those of 20.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import count, islice
from pathlib import Path
from typing import Any

import cv2
import drawing_pictures as pictures
import hand_drawings as hand
from drawing_board import Fault, Unfit, cause_named, place_named
from drawing_files import FORMATS, PROGRAMS
from drawing_tasks import BOTH, SINGLE
from face import ran

PRIME = "'"
COMPLETE, MISTAKEN = 97.0, 95.0  # what a right drawing has of 100 at least, and one with a mistake at most
LINKAGES = ("four-bar", "slider-crank", "ozols-5-1", "shaper", "rosenauer-basic", "five-bar", "stephenson",
            "class-four", "open-chain")
ENDS = {  # where the vectors of results end and begin, by plan and letter
    "velocity": ((("first", "{1}"), ("first", "p")), (("mechanism", "v_{1}"), ("mechanism", "{0}"))),
    "acceleration": ((("second", "{1}'"), ("second", "π")),)}
PLAIN_MM, PLAIN_SHARE = 8.0, 0.2  # by which a vector is plainly another, whatever its construction allows
Make = Callable[[str, int], hand.Drawing]
RIGHT, MISTAKEN_ONCE, REMOVED = "right", "with a mistake", "without the mark of a result"  # what a drawing is
Put = Callable[[str, int, str, Path], tuple[hand.Drawing, Path]]  # makes a drawing of a name and seed, that is so


@dataclass(frozen=True)
class Judged:
    """A drawing, and what is said of it; nothing where it was refused."""

    drawing: hand.Drawing
    data: dict[str, Any] | None
    error: str
    twin: hand.Drawing | None = None  # the same without the mistake

    @property
    def first(self) -> dict[str, Any]:
        """The first wrong step, or the first wrong number of a table; empty where nothing is wrong."""
        if not self.data:
            return {}
        wrong = [one for one in self.data["numbers"] if one["verdict"] == "wrong"] if self.drawing.numbers else []
        return self.data["first_wrong"] or next(iter(wrong), {})

    @property
    def score(self) -> float:
        return float(self.data["score"]["total"] or 0) if self.data else 0.0

    @property
    def counts(self) -> dict[str, int]:
        """How many steps have each verdict."""
        verdicts = [step["verdict"] for step in (self.data or {"steps": []})["steps"]]
        return {verdict: verdicts.count(verdict) for verdict in {*verdicts}}

    @property
    def words(self) -> str:
        """The marks that are named as the place of the mistake, and what is said of it; empty where there is none."""
        if not self.first:
            return ""
        if self.drawing.numbers:
            return f"{self.first['kind']} {self.first['of']}|{self.first['mistake']}"
        return "|".join((self.first["guilty"]["mark"], (self.first["seen"] or self.first["guilty"])["mark"],
                         str(self.first["mistake"])))

    @property
    def is_placed(self) -> bool:
        """Whether the place of the mistake is named."""
        fault = self.drawing.fault
        assert fault
        if self.drawing.numbers:
            return bool(self.words) and self.words.startswith(fault.mark)
        return bool(self.words) and (place_named(fault, self.words) or self.words.split("|")[0] in self.lines_to_mark)

    @property
    def lines_to_mark(self) -> set[str]:
        """The lines that meet in a mark that is beside its place, or at the end of a wrong locus: who draws one wrong,
        puts the mark wrong."""
        fault, task = self.drawing.fault, self.drawing.task
        assert fault
        mark = fault.mark.partition(" by ")[0] if fault.kind in ("slip", "wrong side", "right angle") else ""
        names = {mark, f"v_{mark}", f"{mark.rstrip(PRIME).upper()}_1"} if mark else set()
        return {str(read) for step in hand.steps_of(hand.scene_file(task), *task.options)
                if step["makes"] in names and step["operation"] == "meet" for read in step["reads"]}

    @property
    def is_looked_at(self) -> bool:
        """Whether nothing is called wrong, and the place of the mistake is to be looked at."""
        assert self.drawing.fault
        steps = [] if self.first or not self.data else self.data["steps"]
        return any(place_named(self.drawing.fault, step["mark"]) for step in steps if step["verdict"] == "unsure")

    @property
    def is_accused_elsewhere(self) -> bool:
        return bool(self.first) and not self.is_placed

    @property
    def is_credited(self) -> bool:
        """Whether a result counts that is not there, or counts as right, though its vector is plainly another than in
        the right drawing."""
        results = (self.data or {"results": []})["results"]
        return any(result["verdict"] in ("right", "follows") and self._is_spoilt(result) for result in results)

    def _is_spoilt(self, result: dict[str, str]) -> bool:
        """Whether the vector of a result is not there any more, or is plainly wrong and counts as right."""
        assert self.twin
        named = [[(plan, letter.format(result["of"], result["of"].lower())) for plan, letter in ends]
                 for ends in ENDS.get(result["kind"], ())]
        for keys in named:
            true, own = ([board.marks.get(key) for key in keys] for board in (self.twin.board, self.drawing.board))
            if None not in true:
                right = true[0] - true[1]
                if own[0] is None:
                    return bool(abs(right) > PLAIN_MM)
                drawn = own[0] - (own[1] or 0j)
                return result["verdict"] == "right" and abs(drawn - right) > max(PLAIN_MM, PLAIN_SHARE * abs(right))
        return False

    @property
    def is_explained(self) -> bool:
        """Whether what was done is named, at its place."""
        assert self.drawing.fault
        return self.is_placed and cause_named(self.drawing.fault, self.first["mistake"])


def judged(drawing: hand.Drawing, path: Path, *options: str, twin: hand.Drawing | None = None) -> Judged:
    """A drawing that lies in a file, and how it would be without its mistake."""
    done = ran("verify", hand.scene_file(drawing.task), path, "--json", "-q", *drawing.task.options, *options)
    assert done.status == 0 or (done.status == 2 and done.err.count("\n") == 1), done.err
    return Judged(drawing, json.loads(done.out) if done.status == 0 else None, done.err, twin)


def written(drawing: hand.Drawing, form: str, folder: Path) -> Path:
    """A drawing as a file of a form."""
    suffix, write = FORMATS[form]
    (path := folder / f"student{suffix}").write_bytes(write(drawing))
    return path


def as_files(forms: Sequence[str], right: Make = hand.right, mistaken: Make = hand.mistaken) -> Put:
    """What makes drawings as files of these forms in turn."""
    def put(name: str, seed: int, state: str, folder: Path) -> tuple[hand.Drawing, Path]:
        drawing = (mistaken if state == MISTAKEN_ONCE else right)(name, seed)
        drawing = hand.without_result(drawing, seed) if state == REMOVED else drawing
        return drawing, written(drawing, forms[(len(name) + seed) % len(forms)], folder)

    return put


def fault_of(name: str, seed: int, state: str) -> Fault | None:
    """The mistake of a picture, if it is to have one: none of letters, as nobody reads them there."""
    fault = hand.mistake_at(hand.task_of(name, seed), seed) if state == MISTAKEN_ONCE else None
    if fault and fault.kind == "letters":
        raise LookupError("letters of a picture")
    return fault


def on_task(take: Callable[..., pictures.Grey]) -> Put:
    """What makes pictures of printed tasks that were drawn upon."""
    def put(name: str, seed: int, state: str, folder: Path) -> tuple[hand.Drawing, Path]:
        drawing, paper = pictures.on_printed_task(hand.task_of(name, seed), seed, fault_of(name, seed, state))
        drawing = hand.without_result(drawing, seed) if state == REMOVED else drawing
        cv2.imwrite(str(path := folder / "picture.png"), take(paper, pictures.pencilled(drawing.board), seed))
        return drawing, path

    return put


@dataclass(frozen=True)
class Kind:
    """A kind of drawings: how they are made, of which names, and in what shares they are to be judged well.

    `alarms` are right drawings in which a step is called wrong, `complete` those that have all points; `placed` are
    drawings with a mistake whose place is named, or in a picture is to be looked at, and `explained` are those of them
    in which something is called wrong whose kind is named too; `elsewhere` are those in which another step is called
    wrong first, `praised` those that have nearly all points for all that, and in `credited` ones a result counts as
    right that is plainly wrong, or not there; `unread` is of both.
    """

    put: Put
    names: Sequence[str]
    alarms: float = 0.0
    complete: float = 1.0
    placed: float = 1.0
    explained: float = 1.0
    elsewhere: float = 0.0
    praised: float = 0.0
    credited: float = 0.0
    unread: float = 0.0
    has_vectors: bool = True  # of results, that may be removed
    number: int = 10  # in the suite, right ones and as many with a mistake
    seed: int = 0  # where those of the suite begin

    def drawings(self, state: str, first_seed: int, folder: Path) -> Iterator[Judged]:
        """Drawings of the kind, of each name in turn, without end."""
        for number in count():
            work = self.names[number % len(self.names)], first_seed + number // len(self.names)
            try:
                twin = None if state == RIGHT else self.put(*work, RIGHT, folder)[0]
                yield judged(*self.put(*work, state, folder), twin=twin)
            except (LookupError, Unfit):  # no task of this seed can be set, or drawn so
                continue

    def shares(self, number: int, first_seed: int, folder: Path) -> dict[str, float]:
        """In which shares so many right drawings, as many wrong ones and as many without a result are judged well."""
        fair, wrong, removed = ([*islice(self.drawings(state, first_seed, folder), count)] for state, count in (
            (RIGHT, number), (MISTAKEN_ONCE, number), (REMOVED, number * self.has_vectors)))
        return {"alarms": sum(bool(one.first) for one in fair) / number,
                "complete": sum(one.score >= COMPLETE for one in fair) / number,
                "placed": sum(one.is_placed or one.is_looked_at for one in wrong) / number,
                "explained": sum(one.is_explained for one in wrong) / max(1, sum(bool(one.first) for one in wrong)),
                "elsewhere": sum(one.is_accused_elsewhere for one in wrong) / number,
                "praised": sum(one.score >= MISTAKEN for one in wrong) / number,
                "credited": sum(one.is_credited for one in (*wrong, *removed)) / number / (1 + self.has_vectors),
                "unread": sum(one.data is None for one in (*fair, *wrong)) / number / 2}

    def misses(self, shares: dict[str, float]) -> dict[str, tuple[float, float]]:
        """The shares that are worse than they may be, each with what it may be."""
        return {name: (share, limit) for name, share in shares.items() if
                (share < (limit := getattr(self, name)) if name in ("complete", "placed", "explained")
                 else share > (limit := getattr(self, name)))}


KINDS = {  # shares as they were measured
    "points": Kind(as_files(["csv"]), [*SINGLE]),
    "SVG": Kind(as_files(["svg", "inkscape", "illustrator"]), [*SINGLE]),
    "DXF": Kind(as_files(["dxf lines", "dxf blocks", "dxf points"]), [*SINGLE]),
    "GeoGebra": Kind(as_files(["geogebra"]), [*SINGLE]),
    "mixed forms": Kind(as_files(["csv", *PROGRAMS], hand.by_mixed_forms, hand.mistaken_by_mixed_forms), [*SINGLE]),
    "plans of two kinds": Kind(as_files(["csv", *PROGRAMS]), [*BOTH]),
    "results alone": Kind(as_files(["csv", *PROGRAMS], lambda name, seed: hand.results_alone(hand.right(name, seed)),
                                   lambda name, seed: hand.results_alone(hand.mistaken(name, seed))), [*SINGLE],
                          complete=0.5, explained=0.9),
    "the task's own steps": Kind(as_files(["csv"], hand.retraced, hand.mistaken_retraced), [*LINKAGES, "jaanimets-11"],
                                 placed=0.9, explained=0.9, elsewhere=0.1, has_vectors=False),
    "tables": Kind(as_files(["csv"], hand.table, hand.mistaken_table), LINKAGES, has_vectors=False),
    # of pictures a result whose mark is not seen is to be looked at: such a drawing is not complete
    "scans": Kind(on_task(partial(pictures.scan, dpi=120.0)), pictures.PICTURED, complete=0.8, placed=0.9,
                  explained=0.9, seed=1),
    "photos": Kind(on_task(pictures.photo), pictures.PICTURED, complete=0.8, placed=0.8, explained=0.8, number=5,
                   seed=1),
}
