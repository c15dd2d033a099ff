"""The live page of a task of synthesis: what is given can be dragged, and the linkage, its construction and its numbers
follow.

The construction is a tape of its program, in JavaScript, whose inputs are the numbers that its steps are given. By role
and place the page says what they are for other given positions (task_kinds.js); the linkage is read from the marks, and
its type, defects and angles are told as synthesis/linkage.py tells them (task_linkage.js). It is drawn, lettered, gone
through and dragged as on the page of a scene.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from html import escape

from graphplan.errors import Refused
from graphplan.live_pages import picture as pictures
from graphplan.live_pages.page import (
    LANGUAGES,
    POLICY,
    escape_for_script,
    fill_template,
    program_data,
    resource,
    svg_in_page,
)
from graphplan.live_pages.tapes import Data, marks_function
from graphplan.live_pages.texts import TASK_WORDS, html
from graphplan.phrases import arrange
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.layout import plans_sheet
from graphplan.sheet.layout.screen import compose_for_screen
from graphplan.sheet.lettering.lettering import sentence_runs
from graphplan.sheet.plates.plans import Plans
from graphplan.synthesis import tolerances
from graphplan.synthesis.sheet import DEFECTS, TYPES, SynthesisOnPaper
from graphplan.synthesis.sketch import Synthesis
from graphplan.words.tongue import Tongue, tongue

SCREEN_MM = "A4", 250.0, 196.0  # the plan's part of a window of 1280 by 800 pixels, and the paper whose letters it has
MOVED = "guidance", "function", "stroke", "cognates"
MOST_PAIRS = 5  # of a crank and a rocker: A is computed then, and not found by a page
SCRIPTS = ("texts.js", "base.js", "viewing.js", "stepping.js", "task_linkage.js", "task_kinds.js", "task.js")
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
        tongues, program = [tongue(code) for code in self.languages], program_data(self.composition)
        picture = pictures.PictureData(self.composition)
        data = {
            **live_task(self.synthesis), "chosen": self.synthesis.chosen, "roles": drawing.roles, "inputs": inputs,
            "results": self.synthesis.results.get("circle_points", ()), "length": task.units.length,
            "program": program, "picture": picture.drawn_picture,
            "tolerances": {name: value for name, value in vars(tolerances).items() if name.isupper()},
            "languages": {say.code: LANGUAGES[say.code] for say in tongues},
            "words": {say.code: {name: say(word) for name, word in WORDS.items()} for say in tongues},
            "signs": {say.code: {chr(sign): mark for sign, mark in say.signs.items()} for say in tongues},
            "told": {say.code: self._page_words(say, picture) for say in tongues},
        }  # fmt: skip
        sources = pictures.scripts(), *map(resource, SCRIPTS)
        script = "\n".join(['"use strict";', "(() => {", f"const TAPE = {tape};", *sources, "})();\n"])
        return fill_template(resource("task.html"), {
            "language": say.code, "title": escape(say.title(task.title)), "source": escape(task.source),
            "policy": POLICY, "style": resource("page.css"), "walk": resource("walk.html"),
            "told": resource("told.html"), "svg": svg_in_page(plans_sheet(self.composition, ())),
            "data": escape_for_script(json.dumps(data, ensure_ascii=False)), "script": escape_for_script(script)})

    @cached_property
    def composition(self) -> Composition:
        """The construction in the window of the page."""
        drawing = SynthesisOnPaper("A4", self.synthesis, {}).construction(self.synthesis.values)
        return compose_for_screen(Plans(drawing, tongue(self.languages[0])), [SCREEN_MM])

    def _page_words(self, say: Tongue, picture: pictures.PictureData) -> Data:
        """All that is said of the construction: the stages with their steps, what marks are called. Laws with names or
        numbers in them are left out."""
        program = self.synthesis.values.drawing.program
        names = tuple(step.name for step in program.steps if step.name)

        def words(text: str) -> str:
            return html(sentence_runs(say(text), names))

        stages = [[words(arrange("{0:capital}", stage.title)),
                   "" if stage.law.put else words(arrange("{0:capital}.", stage.law)),
                   [[program.number(step.index), words(program.sentence(step.index))] for step in steps]]
                  for stage, steps in program.stages]
        return {"title": say.title(self.synthesis.task.title), "stages": stages,
                "programs": [{"names": [words(program.text(step.index)) for step in program.steps]}],
                "steps": picture.step_words(say)}


def live_task(synthesis: Synthesis) -> Data:
    """Movable data of a task for its page: its kind, and its given numbers."""
    task, numbers = synthesis.task, asdict(synthesis.task.request)
    if task.kind not in MOVED or numbers.get("driver") or len(numbers.get("input", ())) == MOST_PAIRS:
        raise Refused(f"{task.name}: {task.kind}", "what it gives cannot be dragged",
                      "the live page of the scene that graphplan synthesize -o FILE.toml writes")
    if not synthesis.linkages:
        raise Refused(f"{task.name}: {task.kind}", "no linkage is chosen", "moving = [{ u = 0, root = 1 }, ...]")
    if source := synthesis.given:
        numbers = {"points": {name: (z.real, z.imag) for name, z in source.points.items()},
                   "heading": None if source.C else (source.guide.real, source.guide.imag)}
    return {"kind": task.kind, "request": numbers, "names": synthesis.linkage.names}
