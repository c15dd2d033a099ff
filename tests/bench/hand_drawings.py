"""How well hand drawings are judged: `python tests/bench/hand_drawings.py [-n 20] [--seed 7] [KIND ...]`.

Every drawing is generated: a construction redrawn by a hand of the stated accuracy, half of them with one mistake of
a kind of the table at some step, at least three tolerances large. Printed are, for every kind of drawing, how often
the first wrong step is named exactly, how often a faultless drawing is called wrong, and which mistake was told for
which. A seed makes drawings that no other makes; those of the tests and of tuning have seeds below 9000.
"""

from __future__ import annotations

import argparse
import os
import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from tempfile import gettempdir
from typing import Any
from zlib import crc32

import beside  # noqa: F401  (makes hands and raster importable)
import cv2
import numpy as np
from hands import Drawn, apart, draw, frames, in_panel, off_paper, points, slipped, strokes, traced, wrong_by
from raster import Printed, photo, printed, scan

import graphplan as gp
from graphplan.accuracy.hand import Pencil
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.judge.judge import judge
from graphplan.marking.judge.mistaken_step import Mistake
from graphplan.marking.judge.student_sheet import distance_apart as apart_by
from graphplan.marking.judge.verdict import Judgement
from graphplan.marking.submission import read_submission
from graphplan.marking.traces import PlanFrame, Submission
from graphplan.mechanism.scene import packaged_names
from graphplan.methods.construction import Construction
from graphplan.sheet.handout import code, task
from graphplan.sheet.layout.composition import Composition, compose
from graphplan.sheet.plates.plans import Plans

PENCIL, TRIES = Pencil(), 60
LARGE, LEAST = 3.0, 0.4  # how many tolerances a mistake is large, and mm of a tolerance at least
ALL = frozenset({POINT, LINE, CIRCLE})
NONE, UNTOLD = "none", "untold"
PAPERS: dict[str, Printed] = {}


def labelled(drawn: Drawn) -> Submission:
    """A file with every line, labelled by letters or by the numbers of steps."""
    return Submission("labelled.svg", tuple(traced(drawn)), shows=ALL)


def unlabelled(drawn: Drawn) -> Submission:
    """A file with every line, but only the given points labelled."""
    given = drawn.drawing.scene.points
    traces = [replace(trace, label=trace.label if trace.label in given else "", panel="") for trace in traced(drawn)]
    return Submission("unlabelled.svg", tuple(traces), shows=ALL)


def scanned(drawn: Drawn, sheet: Composition, seed: int) -> Path:
    """The printed page with the drawing in pencil, on a flatbed at 200 dpi."""
    return _picture(scan(_page(drawn.drawing, sheet), strokes(drawn, sheet, seed), seed).image, ".png")


def photographed(drawn: Drawn, sheet: Composition, seed: int) -> Path:
    """The same before a phone."""
    return _picture(photo(_page(drawn.drawing, sheet), strokes(drawn, sheet, seed), seed).image, ".jpg")


def _page(drawing: Construction, sheet: Composition) -> Printed:
    """The task from the printer; the last one is kept."""
    if drawing.scene.title not in PAPERS:
        PAPERS.clear()
        PAPERS[drawing.scene.title] = printed(task(sheet)[0])
    return PAPERS[drawing.scene.title]


def _picture(image: Any, suffix: str) -> Path:
    """A picture as a file, which the next one takes the place of."""
    path = Path(gettempdir()) / f"hand-drawing-{os.getpid()}{suffix}"
    cv2.imwrite(str(path), image)
    return path


Made = Submission | Path
KINDS: dict[str, Callable[[Drawn, Composition, int], Made]] = {
    "points": lambda drawn, *_: points(drawn), "labelled": lambda drawn, *_: labelled(drawn),
    "unlabelled": lambda drawn, *_: unlabelled(drawn), "scans": scanned, "photos": photographed}
PRINTED = ("scans", "photos")  # whose mechanism is not the student's
ANYWHERE = ("points", "labelled")  # kinds whose plans lie anywhere on the sheet, turned and scaled at will


@dataclass
class Tally:
    """What came out for one kind of drawing."""

    exact: int = 0
    mistaken: int = 0
    alarms: int = 0
    faultless: int = 0
    seconds: list[float] = field(default_factory=list)
    misread: list[float] = field(default_factory=list)
    confusion: Counter[tuple[str, str]] = field(default_factory=Counter)
    missed: list[str] = field(default_factory=list)


def main() -> None:
    """Draw, judge and print."""
    parser = argparse.ArgumentParser(description="Judge generated hand drawings.")
    parser.add_argument("kinds", nargs="*", metavar="KIND", help=f"of {', '.join(KINDS)}; default all")
    parser.add_argument("-n", type=int, default=20, help="how many drawings of each scene, faultless and mistaken")
    parser.add_argument("--seed", type=int, default=9000, help="where the seeds begin")
    parser.add_argument("--scenes", nargs="*", default=packaged_names(), help="packaged scenes")
    parser.add_argument("--missed", action="store_true", help="print every drawing that was not judged exactly")
    asked = parser.parse_args()
    for kind in asked.kinds or KINDS:
        tally = Tally()
        for name in asked.scenes:
            measure(kind, name, range(asked.seed, asked.seed + asked.n), tally)
        print("\n".join([*table(kind, tally), *(tally.missed if asked.missed else ())]), flush=True)


def measure(kind: str, name: str, seeds: range, tally: Tally) -> None:
    """The drawings of one scene."""
    drawing = gp.construct(gp.load(name))
    sheet = compose(drawing)
    for seed in seeds:
        where = frames(drawing, sheet, seed if kind in ANYWHERE else None)
        clean = draw(drawing, where, PENCIL, seed)
        found = _judged(kind, drawing, sheet, clean, seed, tally)
        tally.misread += misread(found, clean)
        tally.faultless += 1
        if found.first_wrong:
            tally.alarms += 1
            tally.missed.append(f"{name} {seed} faultless: {_told(found)}")
        mistaken = _mistaken(kind, drawing, sheet, where, seed, found)
        if mistaken is not None:
            slip, drawn = mistaken
            found = _judged(kind, drawing, sheet, drawn, seed, tally)
            exact = found.first_wrong_step == slip.step.index
            tally.mistaken, tally.exact = tally.mistaken + 1, tally.exact + exact
            told = (found.first_wrong.kind or UNTOLD) if found.first_wrong else NONE
            tally.confusion[slip.kind, told] += 1
            if not exact:
                tally.missed.append(f"{name} {seed} step {drawing.drawn.number(slip.step.index)} {slip.kind}, "
                                    f"{slip.text}: {_told(found)}")


def _judged(kind: str, drawing: Construction, sheet: Composition, drawn: Drawn, seed: int, tally: Tally) -> Judgement:
    """A drawing judged against the clock."""
    made = KINDS[kind](drawn, sheet, seed)
    page = cache(lambda: task(sheet)[0])
    before = time.perf_counter()
    known = isinstance(made, Submission)
    submission = made if known else read_submission(made, list(sheet.views), drawn.frames, page, code(sheet))
    found = judge(drawing, sheet, submission, PENCIL)
    tally.seconds.append(time.perf_counter() - before)
    return found


def misread(found: Judgement, drawn: Drawn) -> Iterator[float]:
    """How far off, in mm, the marks of a drawing were seen, those that were: of strokes the farthest spot."""
    plan_of_step = Plans(drawn.drawing).plan_of_step
    for verdict in found.verdicts:
        value, trace, step = drawn.values[verdict.step], verdict.trace, drawn.drawing.drawn.steps[verdict.step]
        if trace is None or value is None or step.op.name in ("given", "begin", "pick"):
            continue
        frame = found.frames[plan_of_step[verdict.step]]
        spots = np.array([frame.to_plan(complex(*spot)) for spot in trace.spots])
        yield apart_by(trace.kind, [float(part) for part in value], spots) * abs(frame.unit)


def _mistaken(kind: str, drawing: Construction, sheet: Composition, where: dict[str, PlanFrame], seed: int,
              clean: Judgement) -> tuple[Mistake, Drawn] | None:
    """A drawing with a mistake that can be seen: of any kind alike often, and on the paper."""
    rng = np.random.default_rng([seed, crc32(drawing.scene.title.encode())])
    shown = {POINT} if kind == "points" else ALL
    steps = [step for step in drawing.drawn.steps if step.op.gives in shown
             and (step.op.name != "given" or kind not in PRINTED)]
    for _ in range(TRIES):
        step = steps[rng.integers(len(steps))]
        slips = list(slipped(drawing, step.index))
        kinds = sorted({slip.kind for slip in slips})
        if not kinds:
            continue
        chosen = kinds[rng.integers(len(kinds))]
        alike = [slip for slip in slips if slip.kind == chosen]
        slip = alike[rng.integers(len(alike))]
        drawn = draw(drawing, where, PENCIL, seed, {step.index: slip})
        tolerance = clean.verdicts[step.index].tolerance
        there = drawn.values[step.index] is not None and not off_paper(drawn) and (
            kind not in PRINTED or (in_panel(drawn, sheet) and apart(drawn, step) and None not in drawn.values))
        if there and wrong_by(drawn, step) > LARGE * max(tolerance, LEAST):
            return slip, drawn
    return None


def _told(found: Judgement) -> str:
    """What was said of a drawing."""
    if found.first_wrong is None or found.first_wrong_step is None:
        return "nothing is wrong"
    return (f"step {found.drawing.drawn.number(found.first_wrong_step)}, {found.first_wrong.off:.2f} mm off, "
            f"{found.first_wrong.tolerance:.2f} allowed; {found.first_wrong.mistake}")


def table(kind: str, tally: Tally) -> Iterator[str]:
    """The figures of one kind of drawing, and its confusion table: what was done, and what was told."""
    share = 100 * tally.exact / max(tally.mistaken, 1)
    alarm = 100 * tally.alarms / max(tally.faultless, 1)
    yield (f"{kind}: first wrong step exact {tally.exact} of {tally.mistaken} ({share:.1f} %), faultless called wrong "
           f"{tally.alarms} of {tally.faultless} ({alarm:.1f} %), median {np.median(tally.seconds):.2f} s, largest "
           f"{max(tally.seconds):.2f} s, marks seen {np.median(tally.misread):.3f} mm off")
    for done in sorted({pair[0] for pair in tally.confusion}):
        row = sorted(((count, told) for (one, told), count in tally.confusion.items() if one == done), reverse=True)
        yield f"  {done:28} " + ", ".join(f"{told} {count}" for count, told in row)


if __name__ == "__main__":
    main()
