"""The design of a drawing as the keys of [sheet] that fix it, and what each design costs that was looked at."""

from __future__ import annotations

import math
from collections.abc import Iterator

from graphplan.app.drafting import Options, drawable, on_paper, wishes_of
from graphplan.design.cost import DEPARTURE, STEP, TOO_SHORT
from graphplan.design.decide import ENOUGH, Choice, looked_at
from graphplan.mechanism.model import Scene
from graphplan.mechanism.written_scene import toml_value
from graphplan.methods.design import Design

HEAD = (f"# what each costs, in %: its worst error, {STEP:g} a step, {TOO_SHORT:g} a vector too short for a pencil,",
        f"# {DEPARTURE:g} where it is another than the textbook's; one that costs {ENOUGH:g} or less is taken at once")
COLUMNS = "cost", "error", "steps", "too short"


def design_text(scene: Scene, options: Options) -> str:
    """The chosen design, with its paper, as a table of a scene; in comments what it and the others cost."""
    result = drawable(scene, options)
    drafted, design = on_paper(scene, options, result), result.drawing.design
    keys = design.keys | {"paper": drafted.paper}
    lines = ["[sheet]", *(f"{key} = {toml_value(value, key)}" for key, value in keys.items())]
    choices = looked_at(result.scene, wishes_of(result.scene, options)[0])
    return "\n".join((*lines, "", *_costs(choices, design))) + "\n"


def _costs(choices: list[Choice], design: Design) -> Iterator[str]:
    """A line for each design that was looked at, the cheapest first, with what it has otherwise than the chosen one."""
    yield from HEAD
    yield "# " + "".join(f"{column:>10}" for column in COLUMNS)
    for choice in choices:
        cost = choice.cost
        numbers = (f"{cost.percent:>10.3g}{cost.error:>10.3g}{cost.steps:>10}{cost.too_short:>10}"
                   if math.isfinite(cost.percent) else f"{'cannot be drawn in this pose':>40}")
        others = {key: value for key, value in choice.design.keys.items() if value != design.keys.get(key)}
        keys = ", ".join(f"{key} = {toml_value(value, key)}" for key, value in others.items())
        yield f"# {numbers}   {keys}".rstrip()
