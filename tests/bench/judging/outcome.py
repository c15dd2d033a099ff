"""What the judge says of a drawing by the public command, beside what is right."""

from __future__ import annotations

import contextlib
import io
import json
import re
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import graphplan.commands.verify as verify
from graphplan.commands import main
from judging.hand import Sketch
from judging.task import Task, task


@dataclass(frozen=True)
class Outcome:
    """One drawing judged."""

    path: Path
    sketch: Sketch
    shown: frozenset[int]
    data: dict[str, Any] | None  # none where it was refused
    error: str
    seconds: float

    @property
    def first(self) -> dict[str, Any] | None:
        return self.data["first_wrong"] if self.data else None

    @property
    def points(self) -> float:
        return float(self.data["score"]["total"]) if self.data else 0.0

    @property
    def called_wrong(self) -> bool:
        return self.data is None or self.first is not None

    @property
    def exact(self) -> bool:
        """Whether the first wrong step is named: itself, or where it cannot be seen, the first mark that shows it."""
        fault, first = self.sketch.fault, self.first
        sheet = self.sketch.task
        if fault and fault.hidden and self.data:
            told = {(one["step"], one["mark"]): one["verdict"] for one in self.data["steps"]}
            return told.get((sheet.number(fault.index), sheet.text(fault.index))) in {"missing", "unsure"} and not first
        if fault is None or first is None:
            return False
        right = {fault.index, *(fault.letters or ())}
        named = [(first["step"], first["mark"])]
        named += [(first[also]["step"], first[also]["mark"]) for also in ("guilty", "seen") if first.get(also)]
        right |= surrogates(sheet, fault.index, self.shown)
        return any(mark == sheet.text(at) and (number == sheet.number(at) or sheet.letter(at)) for at in right
                   for number, mark in named)

    @property
    def kind_right(self) -> bool | None:
        """Whether the mistake is told as what it is; none where nothing could be told."""
        fault = self.sketch.fault
        if fault is None or not fault.told:
            return None
        said = f"{(self.first or {}).get('kind') or ''} {(self.first or {}).get('mistake') or ''}"
        return bool(self.exact and re.search(fault.told, said))


def surrogates(sheet: Task, index: int, shown: frozenset[int]) -> set[int]:
    """The first marks in which a step that is not shown can be seen."""
    if index in shown:
        return {index}
    found: set[int] = set()
    for at in sheet.dependents(index):
        found |= surrogates(sheet, at, shown)
    return set(sorted(found)[:2])


@contextlib.contextmanager
def one_sheet_each() -> Any:
    """Within, the sheet of a scene is made once for all drawings of it."""
    whole = verify.on_paper
    verify.on_paper = lambda options: task(options.scene).on_sheet
    try:
        yield
    finally:
        verify.on_paper = whole


def judged(path: Path, sketch: Sketch, shown: set[int]) -> Outcome:
    """A file as `graphplan verify --json` judges it."""
    said, wrong, data = io.StringIO(), io.StringIO(), None
    begun = time.process_time()
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(wrong):
            status = main(["verify", sketch.task.scene, str(path), "--json", "-q", *sketch.task.options])
        if status == 0:
            data = json.loads(said.getvalue())
    except Exception as fault:  # a traceback of the judge is a finding
        wrong.write(f"Traceback: {fault!r}")
    seconds = time.process_time() - begun
    return Outcome(path, sketch, frozenset(shown), data, wrong.getvalue().strip(), seconds)
