"""The live page of a task of synthesis: what is given can be dragged, and the linkage, its construction and its numbers
follow.

The construction is a tape of its program, in JavaScript, whose inputs are the numbers that its steps are given. By role
and place the page says what they are for other given positions (task_kinds.js); the linkage is read from the marks, and
its type, defects and angles are told as synthesis/linkage.py tells them (task_linkage.js).
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from html import escape

from graphplan.errors import Refused
from graphplan.live_pages.page import LANGUAGES, escape_for_script, fill_template, resource
from graphplan.live_pages.tapes import Data, marks_function
from graphplan.live_pages.texts import TASK_WORDS, html
from graphplan.phrases import arrange
from graphplan.sheet.lettering.lettering import name_runs, sentence_runs
from graphplan.sheet.plates.plans import Plans
from graphplan.synthesis import tolerances
from graphplan.synthesis.sheet import DEFECTS, TYPES, SynthesisSheet
from graphplan.synthesis.sketch import Synthesis
from graphplan.words.tongue import Tongue, tongue

MOVED = "guidance", "function", "stroke", "cognates"
SCRIPTS = "task_linkage.js", "task_kinds.js", "task.js"
WORDS = TASK_WORDS | TYPES | {name: arrange("{0:capital}.", text) for name, text in DEFECTS.items()}


@dataclass(frozen=True)
class TaskLivePage:
    """The page of a synthesis in some languages, its own first.

    Fails with `Refused` where the task gives nothing that can be dragged.
    """

    synthesis: Synthesis
    languages: Sequence[str]

    def html(self) -> str:
        """The page."""
        task, say, drawing = self.synthesis.task, tongue(self.languages[0]), self.synthesis.values.drawing
        tape, inputs = marks_function(drawing.program)
        data = {
            **live_task(self.synthesis), "chosen": self.synthesis.chosen, "roles": drawing.roles, "inputs": inputs,
            "results": self.synthesis.results.get("circle_points", ()), "length": task.units.length,
            "steps": self._steps, "givens": drawing.program.givens,
            "tolerances": {name: value for name, value in vars(tolerances).items() if name.isupper()},
            "languages": {code: self._in_language(tongue(code)) for code in self.languages},
        }  # fmt: skip
        script = "\n".join(['"use strict";', "(() => {", f"const TAPE = {tape};", *map(resource, SCRIPTS), "})();\n"])
        return fill_template(resource("task.html"), {
            "language": say.code, "title": escape(say.title(task.title)), "source": escape(task.source),
            "data": escape_for_script(json.dumps(data, ensure_ascii=False)), "script": escape_for_script(script)})

    @property
    def _steps(self) -> list[Data]:
        """What each step makes, on which marks, its number, and its letter in runs."""
        values = self.synthesis.values
        program, sheet = values.drawing.program, SynthesisSheet("A4", self.synthesis, {})
        marks_on = Plans.of_values(values, sheet.scene).marks_on
        return [{"kind": step.op.gives, "number": max(0, program.number(step.index)), "name": name_runs(step.name),
                 "marks": marks_on.get(step.index, ())} for step in program.steps]

    def _in_language(self, say: Tongue) -> Data:
        """All that is said: words, signs of numbers, and the stages with their steps. Laws with names or numbers
        in them are left out."""
        program = self.synthesis.values.drawing.program
        names = tuple(step.name for step in program.steps if step.name)

        def words(text: str) -> str:
            return html(sentence_runs(say(text), names))

        stages = [[words(arrange("{0:capital}", stage.title)),
                   "" if stage.law.put else words(arrange("{0:capital}.", stage.law)),
                   [[program.number(step.index), words(program.sentence(step.index))] for step in steps]]
                  for stage, steps in program.stages]
        return {"name": LANGUAGES[say.code], "title": say.title(self.synthesis.task.title), "stages": stages,
                "words": {name: say(word) for name, word in WORDS.items()},
                "decimal": say.signs.get(ord("."), ".")}


def live_task(synthesis: Synthesis) -> Data:
    """What of a task its page can move: its kind, and what it gives."""
    task, numbers = synthesis.task, asdict(synthesis.task.request)
    if task.kind not in MOVED or numbers.get("driver"):
        raise Refused(f"{task.name}: {task.kind}", "what it gives cannot be dragged",
                      "the live page of the scene that graphplan synthesize -o FILE.toml writes")
    if not synthesis.linkages:
        raise Refused(f"{task.name}: {task.kind}", "no linkage is chosen", "moving = [{ u = 0, root = 1 }, ...]")
    if source := synthesis.given:
        numbers = {"points": {name: (z.real, z.imag) for name, z in source.points.items()},
                   "heading": None if source.C else (source.guide.real, source.guide.imag)}
    return {"kind": task.kind, "request": numbers, "names": synthesis.linkage.names}
