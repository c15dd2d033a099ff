"""The draughtsman's board: drawing operations against the expected pencil error, of every form of a scene.

All forms are drawn on sheets of one size, as a larger one would make any of them more accurate. A form is on the front
where no other takes fewer operations without a larger error.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from graphplan.accuracy.pencil import Pencil
from graphplan.accuracy.preference import Form, forms
from graphplan.mechanism.model import Scene
from graphplan.methods.styles import MOTION_PLANS

PAPER = "A1"
SQUARES, STRICT = "set squares", "compasses and straightedge"
LONG = "with loads this takes many seconds a form; name the scene with --scenes"


@dataclass(frozen=True)
class Draft:
    """One form on its sheet: operations, the worst result's error beside the largest of its kind, and whether it is on
    the front; or why it is not drawn."""

    scene: str
    form: str
    plan: str
    tools: str
    paper: str
    operations: int | None
    error: float | None
    front: bool = False
    why: str = ""


def drafts(scene: Scene, pencil: Pencil, long: bool = True, paper: str = PAPER) -> list[Draft]:
    """Every form of a scene, those on the front marked; without `long` loaded scenes are not drawn strictly."""
    found = list(_drawn(scene, pencil, long, paper))
    best = front([(one.operations, one.error) for one in found if one.operations is not None and one.error])
    return [replace(one, front=(one.operations, one.error) in best) for one in found]


def _drawn(scene: Scene, pencil: Pencil, long: bool, paper: str) -> Iterator[Draft]:
    for tools in (SQUARES, STRICT):
        for plan in MOTION_PLANS:
            if tools == STRICT and scene.loads is not None and not long:
                yield Draft(scene.name, "every method", plan, tools, paper, None, None, why=LONG)
                continue
            for form in forms(scene, pencil, plan=plan, strict=tools == STRICT, paper=paper):
                yield _draft(scene, form, plan, tools, paper)


def _draft(scene: Scene, form: Form, plan: str, tools: str, paper: str) -> Draft:
    """One form's place on the board."""
    one = form.drafted
    if one is None:
        return Draft(scene.name, form.name, plan, tools, paper, None, None, why=str(form.refusal))
    why = "" if one.error else "every result is nothing"
    return Draft(scene.name, form.name, plan, tools, paper, one.operations, one.error or None, why=why)


def front(places: Sequence[tuple[int, float]]) -> list[tuple[int, float]]:
    """The places that no other beats in one coordinate without losing in the other (Pareto), by the first one."""
    best: list[tuple[int, float]] = []
    for place in sorted(set(places)):
        if not best or place[1] < best[-1][1]:
            best.append(place)
    return best
