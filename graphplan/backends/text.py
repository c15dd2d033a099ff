"""The construction in words: a protocol to draw by, and the same as data."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from typing import Any

from graphplan.kernel.lemoine import counts
from graphplan.methods.construction import Construction
from graphplan.methods.positions import layout
from graphplan.sheet.captions import spoken

WIDTH = 110


def protocol(drawing: Construction, structure: Iterable[str] = (), drafting: Iterable[str] = ()) -> str:
    """The whole construction as numbered sentences, plan by plan; `drafting` is what is told of its cost and errors."""
    scene, drawn = drawing.scene, drawing.drawn
    lines = [scene.title, *filter(None, [scene.source]), ""]
    lines += [f"Structure: {line}" for line in structure]
    lines += ["", *_pose(drawing), "", _tempo(drawing), ""]
    panel = ""
    for step, sentence in zip(drawn.steps[drawn.givens :], drawing.sentences()[drawn.givens :], strict=True):
        if step.panel != panel:
            panel = step.panel
            lines.append(f"On the {spoken(panel)}:")
        lines += _numbered(drawn.number(step.index), sentence)
    lines += ["", f"Cost: {counts(drawn)}."]
    lines += [line for told in drafting for line in _wrapped(told, "")]
    if drawing.forms:
        lines += ["", "Forms chosen for this pose:"]
        lines += [line for form in drawing.forms for line in _wrapped(form, "  ")]
    return "\n".join(lines).rstrip() + "\n"


def _pose(drawing: Construction) -> list[str]:
    """How the mechanism plan is laid out: coordinates, and steps where the scene places points by arcs and angles."""
    program = layout(drawing.scene)
    given = [f"{s.name} ({float(s.params['x']):g}, {float(s.params['y']):g})" for s in program.steps[: program.givens]]
    lines = _wrapped("Mechanism plan, given: " + ", ".join(given) + ".", "")
    for step in program.steps[program.givens :]:
        why = f" ({step.why}.)" if step.why else ""
        lines += _wrapped(program.sentence(step.index) + why, "  ")
    return lines


def _tempo(drawing: Construction) -> str:
    unit = drawing.scene.units.length
    return (f"Velocities are drawn {drawing.kappa:.6g} s long: {unit} on the plan for {unit}/s; "
            f"accelerations {drawing.kappa**2:.6g} s^2 long.")


def _numbered(number: int, sentence: str) -> list[str]:
    return textwrap.wrap(sentence, WIDTH, initial_indent=f"{number:4d}. ", subsequent_indent=" " * 6)


def _wrapped(text: str, indent: str) -> list[str]:
    return textwrap.wrap(text, WIDTH, initial_indent=indent, subsequent_indent=indent + "  ")


def steps(drawing: Construction, structure: Iterable[str] = ()) -> dict[str, Any]:
    """The construction as data: one entry for each drawn step, with what it makes, how, from what and why."""
    drawn, values = drawing.drawn, drawing.values
    entries = []
    for step, sentence in zip(drawn.steps, drawing.sentences(), strict=True):
        entries.append({
            "number": drawn.number(step.index) if step.index >= drawn.givens else 0,
            "makes": drawn.text(step.index),
            "kind": step.op.gives,
            "operation": step.op.name,
            "instrument": step.op.instrument,
            "reads": [drawn.text(arg) for arg in step.args],
            "plan": step.panel,
            "sentence": sentence,
            "why": step.why,
            "form": step.form,
            "reason": step.reason,
            "links": list(step.links),
            "value": list(values[step.index]),
        })
    return {
        "title": drawing.scene.title,
        "source": drawing.scene.source,
        "structure": list(structure),
        "kappa": drawing.kappa,
        "method": drawing.method,
        "forms": drawing.forms,
        "cost": str(counts(drawn)),
        "steps": entries,
    }
