"""Drawings of each kind made, judged, and counted."""

from __future__ import annotations

import random
import shutil
import statistics
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import lru_cache
from pathlib import Path

from graphplan.errors import GraphplanError, Undrawable
from judging import cad, geogebra, picture, tables, vector
from judging.faults import faulty
from judging.hand import Sketch, drawn
from judging.mechanisms import mechanism
from judging.outcome import Outcome, judged, one_sheet_each
from judging.task import task

SMALL = (
    "four-bar", "slider-crank", "stephenson", "triad", "shaper", "slotted-link", "open-chain", "five-bar",
    "plough-lift", "ozols-5-1", "ozols-5-2", "ozols-5-3", "ozols-5-4", "ozols-5-5", "jaanimets-11",
)  # sheets that go through a school's scanner
LARGE = ("class-four", "alt-eight-link", "rosenauer-basic", "alt-ten-link", "double-butterfly")
OWN_FOLDER = tempfile.TemporaryDirectory()
OWN = 0.4  # of all drawings, the share of mechanisms that are in no scene file
SCENES = (*SMALL, *SMALL, *LARGE)
Writer = Callable[[Sketch, int, Path], tuple[Path, set[int]]]


def written(suffix: str, write: Callable[[Sketch, int], tuple[str | bytes, set[int]]]) -> Writer:
    """A writer into files of this ending."""
    def into(sketch: Sketch, seed: int, folder: Path) -> tuple[Path, set[int]]:
        data, shown = write(sketch, seed)
        path = folder / f"{Path(sketch.task.scene).stem}-{seed}{suffix}"
        path.write_bytes(data if isinstance(data, bytes) else data.encode())
        return path, shown
    return into


PICTURES = ("scans", "photos")
TARGETS = {"points": (98, 85, 1), "points, precision left out": (98, 85, 3)}
LABELLED, PICTURED = (95, 80, 2), (85, 70, 2)


def pictured(take: Callable[[Sketch, int], tuple[bytes, str, set[int]]]) -> Writer:
    """A writer of pictures."""
    def into(sketch: Sketch, seed: int, folder: Path) -> tuple[Path, set[int]]:
        data, suffix, shown = take(sketch, seed)
        path = folder / f"{Path(sketch.task.scene).stem}-{seed}{suffix}"
        path.write_bytes(data)
        return path, shown
    return into


KINDS: Mapping[str, Writer] = {
    "points": written(".csv", lambda sketch, seed: tables.points(sketch, seed)),
    "points, precision left out": written(".csv", lambda sketch, seed: tables.points(sketch, seed, stated=False)),
    "svg": written(".svg", vector.svg),
    "dxf": written(".dxf", lambda sketch, seed: cad.dxf(cad.turned(sketch, seed), seed)),
    "ggb": written(".ggb", geogebra.ggb),
    "scans": pictured(picture.scan),
    "photos": pictured(picture.photo),
}


@lru_cache(maxsize=512)
def sketched(seed: int, printed: bool) -> Sketch:
    """The drawing of a seed: of some scene or one of its own; an odd seed's with a mistake, on a sheet with what is
    given or without."""
    scenes = SMALL if printed else SCENES
    chance = random.Random(f"scene {seed}")
    while True:
        own = chance.random() < OWN
        scene = task(mechanism(chance.randrange(10**6), Path(OWN_FOLDER.name)) if own else chance.choice(scenes))
        try:
            return (faulty if seed % 2 else drawn)(scene, seed, printed=printed)
        except (LookupError, Undrawable):
            continue


def measure(kind: str, seeds: Iterable[int], keep: Path | None = None) -> list[Outcome]:
    """Drawings of a kind, judged; what is judged wrongly is kept in a folder, with a line of what is right."""
    found: list[Outcome] = []
    with tempfile.TemporaryDirectory() as folder, one_sheet_each():
        for seed in seeds:
            sketch = sketched(seed, kind in PICTURES)
            try:
                path, shown = KINDS[kind](sketch, seed, Path(folder))
            except GraphplanError as fault:
                print(f"{kind} {seed}: {fault}", file=sys.stderr)
                continue
            one = judged(path, sketch, shown)
            found.append(one)
            print(f"{kind} {seed}: {one.seconds:.1f} s {complaint(one)}", file=sys.stderr, flush=True)
            if keep is not None and (told := complaint(one)):
                keep.mkdir(parents=True, exist_ok=True)
                shutil.copy(path, keep / path.name)
                if sketch.task.scene.endswith(".toml"):
                    shutil.copy(sketch.task.scene, keep)
                with (keep / "README.md").open("a") as file:
                    file.write(told + "\n")
    return found


def complaint(one: Outcome) -> str:
    """What is wrong with a verdict, in a line; empty where it is right."""
    fault, task = one.sketch.fault, one.sketch.task
    right = f"step {task.number(fault.index)} ({task.text(fault.index)}): {fault.kind}" if fault else "no fault"
    said = (one.error or "refused") if one.data is None else (
        f"step {one.first['step']} ({one.first['mark']}): {one.first['mistake'] or one.first['kind']}"
        if one.first else "no step is wrong") + f", {one.points:.0f} of 100"
    fair = not one.called_wrong and one.points >= 90
    right_told = one.exact and one.kind_right is not False
    if fair if fault is None else right_told:
        return ""
    called = " ".join(["verify", Path(task.scene).name, one.path.name, *task.options])
    return f"- `{called}`: right is: {right}; judged: {said}"


def share(count: int, of: int) -> str:
    return f"{100 * count / of:.0f}" if of else "-"


def head(seeds: str) -> Iterator[str]:
    """What stands over the table."""
    yield f"Seeds {seeds}. In brackets what must be reached; seconds of the processor a drawing, without its sheet.\n"
    yield ("| kind | faulty | exact % | kind % | faultless | called wrong % | faultless < 90 % | wrong given >= 90 % | "
           "refused | seconds |")
    yield "|---|---|---|---|---|---|---|---|---|---|"


def rows(found: Mapping[str, list[Outcome]]) -> Iterator[str]:
    """The table, a row a kind, targets in brackets."""
    for kind, ones in found.items():
        wrong = [one for one in ones if one.sketch.fault]
        fair = [one for one in ones if not one.sketch.fault]
        told = [one for one in wrong if one.kind_right is not None]
        exact, right, alarm = TARGETS.get(kind, PICTURED if kind in PICTURES else LABELLED)
        yield (f"| {kind} | {len(wrong)} | {share(sum(one.exact for one in wrong), len(wrong))} [{exact}] "
               f"| {share(sum(bool(one.kind_right) for one in told), len(told))} [{right}] | {len(fair)} "
               f"| {share(sum(one.called_wrong for one in fair), len(fair))} [{alarm}] "
               f"| {share(sum(one.points < 90 for one in fair), len(fair))} "
               f"| {share(sum(one.points >= 90 for one in wrong), len(wrong))} [2] "
               f"| {sum(one.data is None for one in ones)} "
               f"| {statistics.median(one.seconds for one in ones):.1f} |")
