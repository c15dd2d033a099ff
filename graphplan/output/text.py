"""The construction in words: a protocol to draw by, and the same as data."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from typing import Any

from graphplan.kernel.lemoine import counts
from graphplan.kernel.stages import Stage
from graphplan.methods.construction import Construction
from graphplan.methods.positions import layout
from graphplan.phrases import Said, coordinates, digits, joined, said, unit
from graphplan.sheet.layout.composition import Composition
from graphplan.words.tongue import ENGLISH, Tongue

WIDTH = 110


def protocol(drawing: Construction, structure: Iterable[str] = (), drafting: Iterable[str] = (),
             say: Tongue = ENGLISH) -> str:
    """The whole construction as numbered sentences, plan by plan; `drafting` is what is told of its cost and errors."""
    scene, drawn = drawing.scene, drawing.drawn
    lines = [say.title(scene.title), *filter(None, [scene.source]), ""]
    lines += [say(said("Structure: {0}", line)) for line in structure]
    lines += ["", *_pose(drawing, say), "", say(_tempo(drawing)), ""]
    panel = ""
    for step in drawn.steps[drawn.givens :]:
        if step.panel != panel:
            panel = step.panel
            lines.append(say(said("On the {0}", step.panel.words)) + ":")
        lines += _numbered(drawn.number(step.index), say(drawn.told(step.index)))
    lines += ["", say(said("Cost: {0}.", counts(drawn).told))]
    lines += [line for told in drafting for line in _wrapped(say(told), "")]
    if drawing.forms:
        lines += ["", say(said("Forms chosen for this pose:"))]
        lines += [line for form in drawing.forms for line in _wrapped(say(form), "  ")]
    return "\n".join(lines).rstrip() + "\n"


def _pose(drawing: Construction, say: Tongue) -> list[str]:
    """How the mechanism plan is laid out: coordinates, and steps where the scene places points by arcs and angles."""
    program = layout(drawing.scene)
    given = [joined((step.name, coordinates((float(step.params["x"]), float(step.params["y"])), 6)), " ")
             for step in program.steps[: program.givens]]
    lines = _wrapped(say(said("Mechanism plan, given: {0}.", joined(given))), "")
    for step in program.steps[program.givens :]:
        lines += _wrapped(say(program.told(step.index)), "  ")
    return lines


def _tempo(drawing: Construction) -> Said:
    length = drawing.scene.units.length
    return said("Velocities are drawn {0} long: {1} on the plan for {2}; accelerations {3} long.",
                joined((digits(drawing.kappa, 6), unit("s")), " "), unit(length), unit(f"{length}/s"),
                joined((digits(drawing.kappa**2, 6), unit("s^2")), " "))


def _numbered(number: int, sentence: str) -> list[str]:
    return textwrap.wrap(sentence, WIDTH, initial_indent=f"{number:4d}. ", subsequent_indent=" " * 6)


def _wrapped(text: str, indent: str) -> list[str]:
    return textwrap.wrap(text, WIDTH, initial_indent=indent, subsequent_indent=indent + "  ")


def steps(composition: Composition, structure: Iterable[str] = ()) -> dict[str, Any]:
    """The construction as data: its stages, and an entry for each drawn step, with what it makes, how, from what, why
    and where on the paper."""
    drawing, say = composition.plans.drawing, composition.plans.tongue
    drawn, entries = drawing.drawn, []
    stage_of, compound_of = ({step.index: number for number, (_, steps) in enumerate(of) for step in steps}
                             for of in (drawn.stages, drawing.compounds))
    for plate in composition.plates.steps:
        step, number = plate.step, stage_of.get(plate.index)
        entries.append({
            "number": plate.number,
            "makes": say(drawn.text(step.index)),
            "kind": plate.kind,
            "operation": step.op.name,
            "instrument": step.op.instrument,
            "reads": [say(drawn.text(arg)) for arg in step.args],
            "plan": plate.panel,
            "sentence": plate.sentence,
            "stage": number,
            "why": say(step.why or ("" if number is None else drawn.stages[number][0].law)),
            "compound": compound_of.get(plate.index),
            "form": str(step.choice or ""),
            "reason": step.choice.reason() if step.choice and step.choice.compound.weighed else "",
            "links": list(step.links),
            "value": list(drawing.values[step.index]),
            "paper": list(plate.paper(composition.arrangement.height)),
        })
    return {
        "title": say.title(drawing.scene.title),
        "source": drawing.scene.source,
        "structure": list(map(say, structure)),
        "kappa": drawing.kappa,
        "method": drawing.method,
        "forms": list(map(say, drawing.forms)),
        "cost": say(counts(drawn).told),
        "stages": [_stage(stage, say) for stage, _ in drawn.stages],
        "compounds": [say(sentence) for sentence, _ in drawing.compounds],
        "steps": entries,
    }


def _stage(stage: Stage, say: Tongue) -> dict[str, Any]:
    return {"title": say(stage.title), "equation": stage.equation, "law": say(stage.law),
            "vectors": {name: known.value for name, known in stage.vectors.items()}}
