"""Compare the forms of a construction: operations and expected drawing error of each.

examples:
  graphplan cost alt-eight-link
  graphplan cost scene.toml --pencil point=0.2,angle=0.1
  graphplan cost scene.toml --json
"""

from __future__ import annotations

import argparse
import textwrap
from functools import partial
from itertools import product

from graphplan.app.choices import Messages, add_pencil, pencil
from graphplan.app.files import as_json, write
from graphplan.methods.panels import motion_plans


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--json", action="store_true", help="as data, with every result's error and every crossing")
    add_pencil(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.accuracy.drafted import shown_motion
    from graphplan.accuracy.preference import (
        LEGEND,
        TABLE_WIDTH,
        Comparison,
        constructions,
        forms,
        plans_alone,
        strict_constructions,
    )
    from graphplan.errors import Disagreement
    from graphplan.mechanism.scene import load
    from graphplan.methods.design import Design

    scene, hand, messages = load(options.scene), pencil(options), Messages(options.quiet)
    comparisons, sheets = [], partial(plans_alone, motion=shown_motion(scene))
    drawn_on = {plan: constructions(scene, Design(plan)) for plan in motion_plans(scene)}
    for strict, (plan, drawn) in product((False, True), drawn_on.items()):
        messages.progress(f"{plan} plans{', strict' if strict else ''}")
        alternatives = forms(strict_constructions(drawn) if strict else drawn, hand, sheets=sheets)
        comparisons.append(Comparison(scene, plan, strict, tuple(alternatives)))
    messages.progress("")
    refusals = [form.refusal for comparison in comparisons for form in comparison.forms]
    for refusal in refusals:
        if isinstance(refusal, Disagreement) or (refusal is not None and all(refusals)):
            raise refusal
    if options.json:
        data = {"title": scene.title, "model": hand.model,
                "forms": [row for comparison in comparisons for row in comparison.data()]}
        write(as_json(data))
    else:
        tables = [line for comparison in comparisons for line in comparison.lines()]
        lines = [scene.title, f"Pencil, standard deviations: {hand.description}.", *tables, "",
                 *textwrap.wrap(LEGEND, TABLE_WIDTH)]
        write("\n".join(lines) + "\n")
    return 0
