"""The stages of a construction on the slides of beamer: which slide shows what, and what stands beside the picture.

The first slide shows the mechanism, then each stage has one with its equation and its law, and the last shows all.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from graphplan.output.exports.latex import SLIDE, equation, lettering
from graphplan.phrases import arrange
from graphplan.sheet.layout.composition import Composition
from graphplan.sheet.layout.layout import captions
from graphplan.sheet.lettering.lettering import sentence_runs
from graphplan.sheet.plates.display import Text
from graphplan.sheet.words.protocol import Passage, protocol_of
from graphplan.sheet.words.texts import SheetWords


@dataclass(frozen=True)
class Slides:
    """The slides of a composed construction; a set of them is told as beamer reads it, such as 1,3,7."""

    composition: Composition

    @cached_property
    def passages(self) -> dict[int, Passage]:
        """The stages, or parts of them on one plan, by slide."""
        return dict(enumerate(protocol_of(self.composition.plans, self.composition.scales).passages, 2))

    @property
    def last_slide(self) -> int:
        """The slide with everything."""
        return len(self.passages) + 2

    @cached_property
    def slide_of_step(self) -> Mapping[int, int]:
        """By step the slide on which it is drawn."""
        return {movement.index: number for number, passage in self.passages.items()
                for entry in passage.entries for movement in entry.movements}  # fmt: skip

    def showing(self, panel: str) -> str:
        """The slides that show a plan alone."""
        first = [1] if panel == self.composition.plans.panels[0] else []
        return ",".join(map(str,
                            [*first, *(slide for slide, passage in self.passages.items() if passage.plan == panel)]))

    def frame(self, picture: Sequence[str]) -> list[str]:
        """All slides, with the picture."""
        scene = self.composition.plates.scene
        titles = {1: scene.title, self.last_slide: scene.title}
        words = {1: lettering(sentence_runs(scene.source), words=True)}
        for slide, passage in self.passages.items():
            titles[slide], words[slide] = passage.title or passage.plan.words, self._stage_text(passage)
        return [r"\begin{frame}[t]",
                *(rf"\frametitle<{slide}>{{{self._typeset(title)}}}" for slide, title in titles.items()),
                r"\begin{columns}[T,onlytextwidth]", r"\column{.7\textwidth}\centering",
                rf"\begin{{adjustbox}}{{max size={SLIDE}}}", *picture, r"\end{adjustbox}",
                r"\column{.28\textwidth}\raggedright\footnotesize",
                *(rf"\only<{slide}>{{{told}}}" for slide, told in words.items()), r"\end{columns}",
                r"\end{frame}"]  # fmt: skip

    def _stage_text(self, passage: Passage) -> str:
        """The equations and the law of a stage, then the plan and its scales."""
        stage = passage.stage
        lines = [equation(one) for one in stage.equations] if stage else []
        lines += [self._typeset(arrange("{0:capital}.", stage.law))] if stage else []
        plan = (lettering(text.runs, words=True) for text in plan_caption(self.composition, passage.plan))
        return "\\par\\medskip ".join([*lines, "\\scriptsize " + "\\par ".join(plan)])

    def _typeset(self, text: str) -> str:
        """A sentence with the names in it."""
        return lettering(sentence_runs(self.composition.plans.tongue(text), self._names))

    @cached_property
    def _names(self) -> tuple[str, ...]:
        return SheetWords(self.composition.plans).names


def plan_caption(composition: Composition, panel: str) -> Iterator[Text]:
    """What stands over a plan."""
    rect = composition.arrangement.panels[panel]
    return (text for text in captions(composition) if rect.holds(text.at))
