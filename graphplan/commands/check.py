"""Check the construction against the analytic solver, side by side.

examples:
  graphplan check alt-eight-link
  graphplan check scene.toml --exact
"""

from __future__ import annotations

import argparse
import sys
from fractions import Fraction
from typing import Any

from graphplan.commands.choices import add_choices, write


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--exact", action="store_true", help="in fractions, without any tolerance")
    add_choices(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.check.replacement import replacements
    from graphplan.check.report import report
    from graphplan.check.shortcuts import shortcuts
    from graphplan.mechanism.scene import load
    from graphplan.mechanism.structure import structure

    scene = load(options.scene)
    found = report(scene, exact=options.exact, method=options.method, plan=options.plan, inertia=options.inertia)
    lines = [scene.title, *structure(scene).lines(), "", f"{'':<24}{'construction':>32}{'analytic solver':>32}"]
    for part, ours in found.results.items():
        truth = found.truth(part)
        lines += [f"{part + ' ' + name:<24}{_text(ours[name]):>32}{_text(truth[name]):>32}" for name in ours]
    powers = found.held.power if found.held else ()
    lines += [f"{f'power balance {number}':<24}{_text(value):>32}" for number, value in enumerate(powers, 1)]
    lines.append("")
    for kind, difference in found.check.items():
        lines.append(f"largest difference in {kind}: {float(difference):.2g} of the largest value")
    lines += map(str, (*shortcuts(found.drawing), *replacements(scene)))
    if found.held and found.held.efficiency is not None:
        lines.append(f"instantaneous efficiency: {found.held.efficiency:.4g} as drawn, "
                     f"{found.held.standing.efficiency:.4g} in further rounds")
    if not found.exact:
        lines.append(f"condition of the mechanism: {found.condition:.3g}; allowed: {found.tolerance:.2g}")
    write("\n".join(lines) + "\n", None)
    if found.complaint:
        print(found.complaint, file=sys.stderr)
    return 0 if found.agrees else 1


def _text(value: Any) -> str:
    if isinstance(value, tuple):
        return "(" + ", ".join(_text(part) for part in value) + ")"
    return str(value) if isinstance(value, Fraction) else f"{value:.9g}"
