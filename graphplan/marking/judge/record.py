"""What is found of a drawing, as data."""

from __future__ import annotations

import math
from typing import Any

from graphplan.marking.judge.findings import blamed, called, counts, measured
from graphplan.marking.judge.score import Score
from graphplan.marking.judge.verdict import Judgement, NumberVerdict, Verdict


def record(judgement: Judgement, score: Score) -> dict[str, Any]:
    """Everything that was judged, step by step and number by number; lengths are mm of paper."""
    first = judgement.first
    return {
        "title": judgement.drawing.scene.title,
        "drawing": judgement.name,
        "first_wrong": None if first is None else _complaint(judgement, first),
        "steps": [_step(judgement, verdict) for verdict in judgement.verdicts],
        "numbers": [_number(verdict) for verdict in judgement.numbers],
        "not_needed": len(judgement.spare),
        "score": {"total": score.total, **score.groups},
        "counts": counts(judgement),
    }


def _step(judgement: Judgement, verdict: Verdict) -> dict[str, Any]:
    """One step, with how far off it is where it can be seen."""
    seen = measured(judgement, verdict)
    return {
        **_mark(judgement, verdict.step), "verdict": verdict.state,
        "off_mm": _finite(verdict.off) if seen else None,
        "tolerance_mm": _finite(verdict.tolerance) if seen else None,
        "astray_mm": _finite(verdict.astray) if seen else None,
        "mistake": None if verdict.mistake is None else str(verdict.mistake),
    }  # fmt: skip


def _mark(judgement: Judgement, index: int) -> dict[str, Any]:
    """A step by its number and its mark."""
    name = called(judgement.drawing.drawn, index)
    return {"step": name.number, "mark": name.mark}


def _complaint(judgement: Judgement, verdict: Verdict) -> dict[str, Any]:
    """The first wrong step; `guilty` is the earlier one that is probably to blame, where there is one."""
    drawn, guilty = judgement.drawing.drawn, blamed(verdict)
    return {
        **_mark(judgement, verdict.step), "sentence": str(drawn.sentence(verdict.step)),
        "off_mm": _finite(verdict.off), "tolerance_mm": _finite(verdict.tolerance),
        "mistake": None if verdict.mistake is None else str(verdict.mistake),
        "kind": verdict.kind or None,
        "guilty": None if guilty is None else _mark(judgement, guilty),
    }  # fmt: skip


def _finite(size: float) -> float | None:
    """A size as JSON takes it: what cannot be drawn from the student's marks is off by nothing that could be told."""
    return size if math.isfinite(size) else None


def _number(verdict: NumberVerdict) -> dict[str, Any]:
    """One number of the table, beside the true one, in the scene's units."""
    number = verdict.number
    return {
        "kind": number.kind, "of": number.of, "value": list(number.value), "unit": number.unit,
        "verdict": verdict.state, "true": list(verdict.true),
        "off": _finite(verdict.off), "tolerance": _finite(verdict.tolerance),
        "mistake": None if verdict.mistake is None else str(verdict.mistake),
    }  # fmt: skip
