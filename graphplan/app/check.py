"""Compare the construction with the analytic solver, and test the claims of each drawn step.

examples:
  graphplan check alt-eight-link
  graphplan check scene.toml --exact
  graphplan check scene.toml --json
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from graphplan.app.choices import add_choices, add_travel, error, load_scene
from graphplan.app.drafting import make_report
from graphplan.app.files import as_json, write

if TYPE_CHECKING:
    from graphplan.check.report import Report
    from graphplan.methods.results import Fact


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("--exact", action="store_true", help="in fractions, without any tolerance")
    command.add_argument("--json", action="store_true", help="as data")
    add_choices(command)
    add_travel(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.check.answerable import report_regular_part
    from graphplan.check.json_results import reasons
    from graphplan.check.trusted import replacements, shortcuts
    from graphplan.mechanism.planets import planet_remarks
    from graphplan.mechanism.structure import structure
    from graphplan.methods.panels import redundancies

    scene = load_scene(options)
    report = report_regular_part(scene, lambda scene: make_report(scene, exact=options.exact, refuse=False))
    groups = structure(scene).lines()
    notes = [str(note) for note in (*redundancies(scene), *planet_remarks(scene), *shortcuts(report.drawing),
                                    *replacements(scene))]
    notes += [f"{key} {name}: {why}" for key, named in reasons(report).items() for name, why in named.items()]
    if options.json:
        write(as_json(_data(report, groups, notes)))
    else:
        write("\n".join(_lines(report, groups, notes)) + "\n")
    if report.drawing.broken_claim:
        error(f"check: {report.drawing.broken_claim}")
    if not report.numbers_agree:
        error(str(report.disagreement))
    return 0 if report.agrees else 1


def _lines(report: Report, groups: Sequence[str], notes: Sequence[str]) -> list[str]:
    """Results of construction and solver as a table, and the remarks."""
    lines = [report.scene.title, *groups, "", _row("", "construction", "analytic solver", "difference", "own size")]
    lines += [_row(fact.name, _text(fact.value), _text(fact.truth), *(f"{size:.2g}" for size in _sizes(fact)))
              for fact in report.facts]
    powers = report.forces.by_balance(report.forces.power) if report.forces and report.forces.power else {}
    lines += [_row(f"power balance {name}", "", _text(value)) for name, value in powers.items()]
    lines.append("")
    for kind, difference in report.check.items():
        bound = None if report.exact else report.bounds.get(kind)
        proof = "" if bound is None else f" (proven bound {float(bound):.2g})"
        relative = "relative" if kind in report.bounds else "relative to the mechanism's extent"
        lines.append(f"largest difference, {kind}: {float(difference):.2g}, {relative}{proof}")
    lines += notes
    if report.forces and report.forces.efficiency is not None:
        lines.append(f"instantaneous efficiency: {float(report.forces.efficiency):.4g} as drawn, "
                     f"{float(report.forces.standing.efficiency or 0):.4g} in further rounds")
    if not report.exact:
        lines.append(f"arithmetic: {report.arithmetic}; condition of the mechanism: {report.condition:.3g}")
    return lines


def _data(report: Report, groups: Sequence[str], notes: Sequence[str]) -> dict[str, Any]:
    """Results of construction and solver as data."""
    results: dict[str, dict[str, Any]] = {kind: {} for kind in report.results}
    for fact in report.facts:
        results[fact.kind][fact.of] = {"construction": _plain(fact.value), "solver": _plain(fact.truth),
                                       **dict(zip(("difference", "size"), _sizes(fact), strict=True))}
    force_data = {"power balance": _plain(tuple(report.forces.power))} if report.forces else {}
    if report.forces and report.forces.efficiency is not None:
        force_data["efficiency"] = {"drawn": _plain(report.forces.efficiency),
                                    "stands": _plain(report.forces.standing.efficiency)}
    condition = {} if report.exact else {"condition": report.condition}
    return {"title": report.scene.title, "structure": list(groups), "results": results, **force_data,
            "check": {kind: float(difference) for kind, difference in report.check.items()},
            "bounds": {kind: float(bound) for kind, bound in report.bounds.items()}, "arithmetic": report.arithmetic,
            "notes": list(notes), **condition, "agrees": report.agrees}


def _row(name: str, *cells: str) -> str:
    """A line of the table: two opinions, their difference, and the size that it is relative to."""
    widths = (30, 30, 12, 12)
    return f"{name:<24}" + "".join(f"  {cell:>{width}}" for cell, width in zip(cells, widths, strict=False))


def _sizes(fact: Fact) -> tuple[float, float]:
    """The largest difference of a result's numbers, and its own size."""
    return float(max(number.gap for number in fact.compared)), float(fact.compared[0].scale)


def _text(value: Any) -> str:
    if isinstance(value, tuple):
        return "(" + ", ".join(_text(component) for component in value) + ")"
    return str(value) if isinstance(value, Fraction) else f"{value:.9g}"


def _plain(value: Any) -> Any:
    """A number or a vector as JSON takes it: fractions as a string p/q."""
    if isinstance(value, tuple):
        return [_plain(component) for component in value]
    return str(value) if isinstance(value, Fraction) else value
