"""The design of a drawing as the keys of [sheet] that fix it, and what each design costs that was looked at."""

from __future__ import annotations

from graphplan.app.drafting import drawable, on_paper, wishes_of
from graphplan.design.cost import TERMS
from graphplan.design.decide import MAX_COST, Candidate, candidates
from graphplan.mechanism.model import Scene
from graphplan.mechanism.written_scene import toml_value
from graphplan.methods.design import Design

HEAD = (f"# costs in %: {', '.join(f'{term.price:g} {term.each}' for term in TERMS)};",
        f"# what costs {MAX_COST:g} or less is taken at once")


def design_text(scene: Scene) -> str:
    """The chosen design, with its paper, as a table of a scene; in comments what it and the others cost."""
    result = drawable(scene)
    drafted, design = on_paper(scene, result), result.drawing.design
    keys = design.keys | {"paper": drafted.paper}
    lines = ["[sheet]", *(f"{key} = {toml_value(value, key)}" for key, value in keys.items())]
    choices = candidates(result.scene, wishes_of(result.scene)[0])
    return "\n".join((*lines, "", *_costs(choices, design))) + "\n"


def _costs(choices: list[Candidate], design: Design) -> list[str]:
    """A line for each design that was looked at, the cheapest first, with what it has otherwise than the chosen one."""
    lines = [*HEAD, "# " + "".join(f"{column:>10}" for column in ("cost", *(term.name for term in TERMS)))]
    for choice in choices:
        numbers = (choice.percent, *choice.cost.amounts)
        unweighed = "too long to be weighed" if choice.is_drawable else "cannot be drawn in this pose"
        columns = ("".join(f"{number:>10.3g}" for number in numbers) if choice.cost.amounts
                   else f"{unweighed:>{10 * (1 + len(TERMS))}}")
        others = {key: value for key, value in choice.design.keys.items() if value != design.keys.get(key)}
        keys = ", ".join(f"{key} = {toml_value(value, key)}" for key, value in others.items())
        lines.append(f"# {columns}   {keys}".rstrip())
    return lines
