"""A student who does what the guided handout says, with the lengths that it says, is judged right."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import Any

import pytest
from hands import Drawn, frames, points

import graphplan as gp
from graphplan.accuracy.drafted import draft
from graphplan.accuracy.hand import Pencil
from graphplan.kernel.kinds import CIRCLE, OPENING, POINT, Movement
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import Step
from graphplan.marking.judge.judge import judge
from graphplan.marking.judge.score import score
from graphplan.sheet.handout import guided_task
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.lettering.lettering import plain
from graphplan.sheet.plates.display import Text

LENGTH = re.compile(r"(\d+\.\d) mm(?![/²·])")
COMPONENTS = re.compile(r"\(x (−?\d+\.\d), y (−?\d+\.\d)\)")


def spoken(composition: Composition) -> Iterator[tuple[int, str]]:
    """Each step with what the guided handout says after its number."""
    texts = (item for page in guided_task(composition) for item in page.items
             if isinstance(item, Text) and item.layer == "text" and item.step is not None)
    for index, items in groupby(texts, lambda item: item.step):
        words = list(items)
        last = max((i for i, item in enumerate(words) if item.anchor == "end"), default=-1)
        yield index or 0, " ".join(plain(item.runs) for item in words[last + 1 :])


def obeyed(composition: Composition) -> list[Any]:
    """The construction with every length as it is spoken, in scene units: a ruler knows tenths of a millimetre."""
    drawing, told, values = composition.plans.drawing, dict(spoken(composition)), list[Any]()
    for step in drawing.drawn.steps:
        per_mm = composition.scales.lengths_per_mm(composition.plans.plan_of_step[step.index])
        value = step.op.rule(Floats(), *[values[arg] for arg in step.args], **step.params)
        values.append(measured(step, value, values, told.get(step.index, ""), per_mm))
    return values


def measured(step: Step, value: Any, values: Sequence[Any], told: str, per_mm: float) -> Any:
    """What a step makes with the length that its words tell, if they tell one."""
    lengths = [per_mm * float(length) for length in LENGTH.findall(told)]
    if not lengths or step.op.movement is Movement.PICKED:
        return value
    if step.op.gives in (OPENING, CIRCLE):
        return (*value[:-1], lengths[-1] ** 2)
    if step.op.gives != POINT or step.op.root is None:
        return value
    start = values[step.args[step.op.root]]
    if parts := COMPONENTS.search(told):
        return tuple(x + per_mm * float(part.replace("−", "-")) for x, part in zip(start, parts.groups(), strict=True))
    far = lengths[-1] / (math.dist(start, value) or 1.0)
    return tuple(x + far * (to - x) for x, to in zip(start, value, strict=True))


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "open-chain", "ozols-5-2", "triad-loaded"])
def test_who_obeys_the_guided_handout_is_judged_right(name: str) -> None:
    """Drawn by the spoken lengths, no mark is half a millimetre off, and the score is 100 of 100."""
    composition = draft(drawing := gp.construct(gp.load(name)), Pencil()).composition
    values = obeyed(composition)
    exact = [step.index for step in drawing.drawn.steps if step.op.gives == POINT]
    off = [math.dist(values[i][:2], map(float, drawing.values[i][:2]))
           / composition.scales.lengths_per_mm(composition.plans.plan_of_step[i]) for i in exact]
    assert 0.0 < max(off) < 0.5
    found = judge(drawing, composition, points(Drawn(drawing, values, frames(drawing, composition))), Pencil())
    assert score(found).total == 100


def test_who_mistakes_a_spoken_length_is_not() -> None:
    """A length that is 2 mm longer than the handout says makes its step wrong."""
    composition = draft(drawing := gp.construct(gp.load("four-bar")), Pencil()).composition
    step = next(step for step in drawing.drawn.steps if step.op.root is not None and step.name)
    values = obeyed(composition)
    start, per_mm = values[step.args[step.op.root or 0]], composition.scales.lengths_per_mm(
        composition.plans.plan_of_step[step.index])
    far = 1 + 2 * per_mm / math.dist(start, values[step.index])
    values[step.index] = tuple(x + far * (to - x) for x, to in zip(start, values[step.index], strict=True))
    found = judge(drawing, composition, points(Drawn(drawing, values, frames(drawing, composition))), Pencil())
    assert found.first_wrong
    assert found.first_wrong.step == step.index
