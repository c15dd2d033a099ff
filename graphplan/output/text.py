"""The construction in words: a protocol to draw by, and the same as data."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator
from functools import partial
from typing import Any

from graphplan.kernel.lemoine import counts
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import evaluate
from graphplan.kernel.stages import Equation, Stage
from graphplan.mechanism.model import Scene
from graphplan.methods.panels import MECHANISM
from graphplan.methods.placing import layout
from graphplan.output.executable import OnPaper, operands
from graphplan.phrases import arrange, coordinates, join, said
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.scales import Scales
from graphplan.sheet.words.lengths import Length, Lengths
from graphplan.sheet.words.protocol import Passage, lengths_of, protocol_of, with_lengths
from graphplan.sheet.words.texts import Readings, SheetWords
from graphplan.words.tongue import Tongue

WIDTH = 110
HANGING = 9  # letters: what hangs from a number
RULES = " -="  # under a vector of which nothing is known, one number, or both


def protocol(composition: Composition, structure: Iterable[str] = (), drafting: Iterable[str] = (), *,
             movements: bool = False) -> str:
    """The whole construction stage by stage, as it lies on its sheet; `movements` unfolds what takes several.

    `drafting` is what is told of its cost and errors.
    """
    plans, say = composition.plans, composition.plans.tongue
    drawing, words = plans.drawing, protocol_of(plans, composition.scales)
    lines = [say.title(drawing.scene.title), *filter(None, [drawing.scene.source]), ""]
    lines += [say(said("Structure: {0}", line)) for line in structure]
    lines += ["", *_scales(composition), *_pose(drawing.scene, composition.scales, say), ""]
    underlined = said("Underlined twice: magnitude and direction known; once: one of them, or a locus.")
    lines += _wrap_lines(say(underlined), "")
    lines += [*_passages(words.passages, say, movements), *_results(SheetWords(plans), composition.scales, say)]
    lines += ["", say(said("Cost: {0}.", counts(drawing.drawn).text))]
    lines += [line for told in drafting for line in _wrap_lines(say(told), "")]
    if drawing.forms:
        lines += ["", say(said("Forms chosen for this pose:"))]
        lines += [line for form in drawing.forms for line in _wrap_lines(say(form), "  ")]
    return "\n".join(lines).rstrip() + "\n"


def _pose(scene: Scene, scales: Scales, say: Tongue) -> list[str]:
    """Layout of the mechanism plan: coordinates in mm, and steps if the scene places points by arcs and angles."""
    program = layout(scene)
    values = evaluate(program, Floats())
    lengths = Lengths(program, values, lambda index: MECHANISM, scales)
    points = [join((step.name,
                    coordinates([round(float(coordinate) / scales.k_s, 1) for coordinate in values[step.index]])), " ")
              for step in program.steps[: program.givens]]
    lines = _wrap_lines(say(said("Mechanism plan, in mm of paper: {0}.", join(points))), "")
    for step in program.steps[program.givens :]:
        sentence = program.sentence_with_reason(step.index)
        lines += _wrap_lines(say(with_lengths(sentence, partial(lengths.for_step, step))), "  ")
    return lines


def _scales(composition: Composition) -> Iterator[str]:
    """Yield the scales of all plans."""
    plans, scales = composition.plans, composition.scales
    lines = [join((plan.words, join(scales.scale_texts(plan, plans.kinds(plan)))), ": ") for plan in plans.panels]
    paper = composition.arrangement.paper
    yield from _wrap_lines(plans.tongue(said("Scales on {0}: {1}.", paper, join(lines, "; "))), "")


def _passages(passages: Iterable[Passage], say: Tongue, movements: bool) -> Iterator[str]:
    """Yield the construction in words, plan by plan and stage by stage, numbered by steps."""
    plan = ""
    for passage in passages:
        if passage.plan != plan:
            plan = passage.plan
            yield from ("", say(said("On the {0}", passage.plan.words)) + ":")
        for idea in passage.idea:
            yield from _wrap_lines(say(arrange("{0:capital}.", idea)), "  ", "")
        yield from _head(passage, say)
        for entry in passage.entries:
            yield from _numbered_lines(entry.number, say(entry.text))
            for movement in entry.movements if movements and entry.is_compound else ():
                yield from _numbered_lines(str(movement.number), say(movement.sentence), HANGING)
        for control in passage.controls:
            yield from _wrap_lines(say(control), "    ", "")


def _head(passage: Passage, say: Tongue) -> Iterator[str]:
    """A stage's title, its equations with what is known in them, and its law where it was not told before."""
    if passage.stage is None or passage.title is None:
        return
    yield from () if passage.likewise else ("", *_wrap_lines(say(arrange("{0:capital}", passage.title)), "  "))
    for equation in passage.equations:
        yield from (4 * " " + line for line in (equation.text, _underlines(equation)) if line)
    if passage.law:
        yield from _wrap_lines(say(arrange("{0:capital}.", passage.law)), "    ", "")


def _underlines(equation: Equation) -> str:
    """Rules under the vectors of an equation."""
    line = [" "] * len(equation.text)
    for start, end, times in equation.underlines:
        line[start:end] = RULES[times] * (end - start)
    return "".join(line).rstrip()


def _results(words: SheetWords, scales: Scales, say: Tongue) -> Iterator[str]:
    """Yield the measured results, each beside the computed value, and the results in tables."""
    read = list(Readings(words.drawing, lengths_of(words.plans, scales), words.values))
    yield from ("", say(said("Measured on the sheet")) + ":") if read else ()
    for reading in read:
        yield from _wrap_lines(say(reading.text), "  ")
    for number, table in enumerate(words.result_tables()):
        yield from ("",) if number else ("", say(said("Results")) + ":")
        cells = [["".join(f"_{run.text}" if run.level else run.text for run in runs) for runs in row] for row in table]
        wide = [max(map(len, column)) for column in zip(*cells, strict=True)]
        yield from ("  " + "  ".join(cell.rjust(room) if place else cell.ljust(room) for place, (cell, room) in
                                     enumerate(zip(row, wide, strict=True))) for row in cells)


def _numbered_lines(number: str, sentence: str, indent: int = 0) -> list[str]:
    """A sentence that hangs from its number."""
    return textwrap.wrap(sentence, WIDTH, initial_indent=f"{' ' * indent}{number:>{HANGING - 2}}. ",
                         subsequent_indent=" " * (HANGING + indent))


def _wrap_lines(text: str, indent: str, hanging: str = "  ") -> list[str]:
    return textwrap.wrap(text, WIDTH, initial_indent=indent, subsequent_indent=indent + hanging)


def steps(composition: Composition, structure: Iterable[str] = ()) -> dict[str, Any]:
    """The construction as data: its stages, and an entry for each drawn step, with what it makes, how, from what, why
    and where on the paper."""
    drawing, say = composition.plans.drawing, composition.plans.tongue
    program, entries = drawing.drawn, []
    protocol = protocol_of(composition.plans, composition.scales)
    (stages, stage_of), entry_of = protocol.stages, {one.index: one for one in protocol.steps}
    compound_of = {one.index: number for number, compound in enumerate(drawing.compounds)
                   for one in compound.movements}
    on_paper = OnPaper(drawing.values, composition.plans.plan_of_step.__getitem__, composition.scales.lengths_per_mm)
    for plate in composition.plates.steps:
        step, number, words = plate.step, stage_of.get(plate.index), entry_of.get(plate.index)
        entries.append({
            "number": plate.number,
            "makes": say(program.text(step.index)),
            "kind": plate.kind,
            "operation": step.op.name,
            "instrument": step.op.instrument,
            "reads": [say(program.text(arg)) for arg in operands(step)],
            "plan": plate.panel,
            "sentence": say(words.sentence) if words else plate.sentence,
            "lengths": _measures(words.lengths if words else ()),
            "stage": number,
            "why": say(step.why or ("" if number is None else stages[number].law)),
            "compound": compound_of.get(plate.index),
            "form": str(step.choice or ""),
            "reason": step.choice.reason() if step.choice and step.choice.compound.weighed else "",
            "links": list(step.links),
            **on_paper.step_data(step),
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
        "cost": say(counts(program).text),
        "stages": [_stage(stage, say) for stage in stages],
        "compounds": [say(compound.sentence) for compound in drawing.compounds],
        "entries": [{"steps": [one.number for one in entry.movements], "stage": passage.number, "plan": passage.plan,
                     "sentence": say(entry.sentence),
                     "why": say(join((*(() if place else passage.idea), *filter(None, (entry.reason,))), "; ")),
                     "lengths": _measures(entry.lengths)}
                    for passage in protocol.passages for place, entry in enumerate(passage.entries)],
        "controls": [say(control) for passage in protocol.passages for control in passage.controls],
        "readings": [{"kind": one.kind, "of": one.of, "said": say(one.text), "value": one.value,
                      "computed": one.computed, "lengths": _measures([one.length])}
                     for one in Readings(drawing, lengths_of(composition.plans, composition.scales),
                                         SheetWords(composition.plans).values)],
        "steps": entries,
    }


def _measures(lengths: Iterable[Length]) -> list[dict[str, Any]]:
    """The mm that a sentence speaks of, each with the marks between which they are, by their places in the list."""
    return [{"mm": measure.mm, "marks": list(measure.marks)} for length in lengths for measure in length.measures]


def _stage(stage: Stage, say: Tongue) -> dict[str, Any]:
    return {"title": say(stage.title), "equation": stage.equation, "law": say(stage.law),
            "vectors": {name: vector.value for name, vector in stage.vectors.items()}}
