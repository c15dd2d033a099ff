"""The letters of a plan: marks, loci, vectors, and the numbers of marks that have no letter."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from graphplan.kernel.kinds import CIRCLE, POINT
from graphplan.kernel.program import Program, Step
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import said
from graphplan.sheet.lettering.label_candidates import SMALL, Wish
from graphplan.sheet.lettering.lettering import listed, name_runs, sentence_runs
from graphplan.sheet.plates import clip, pens
from graphplan.sheet.plates.display import Spot
from graphplan.sheet.plates.plans import Vector, around, corner
from graphplan.sheet.plates.strokes import Stretch, Strokes, towards
from graphplan.sheet.plates.symbols import RADIUS

ALONG = 0.97, 0.03, 0.9, 0.1, 0.8, 0.2, 0.65, 0.35, 0.5  # where along a line its letter may stand
MIDDLE, NEAR_HEAD = (0.5, 0.4, 0.6, 0.3, 0.7), (0.7, 0.65, 0.75, 0.6, 0.8)  # the same along a vector
NEAR = 0.25
NUMBERED = 0.5, 0.4, 0.6, 0.3, 0.7  # the same of the number of a line that ends at its marks
STRUCK = 1.0, 0.0, 0.85, 0.15, 0.7, 0.3, 0.5  # the same along an arc

Span = tuple[Spot, Spot]


@dataclass(frozen=True)
class Letters:
    """What stands beside the strokes of one plan."""

    strokes: Strokes

    @property
    def drawn(self) -> Program:
        return self.strokes.plans.drawing.drawn

    def wishes(self) -> Iterator[Wish]:
        """The letters of the plan: marks, loci, vectors, and the numbers of marks that are spoken of by them."""
        yield from self._point_letters()
        for step in self.strokes.steps:
            if step.index in self.strokes.stretches:
                yield from self._line_letters(step, self.strokes.stretches[step.index])
            elif step.op.gives == CIRCLE and self._numbered:
                yield from self._arc_number(step)
        spans = self._spans()
        for (start, end), vectors in spans.items():
            yield from self._vector_letter(vectors, any(_same(span, (end, start)) for span in spans))

    def _point_letters(self) -> Iterator[Wish]:
        """The letters, and apart from them the numbers, of each place: marks that coincide stand together."""
        for spot, steps in self._places().items():
            clear = RADIUS + 0.4 if self.strokes.panel == MECHANISM and self._at_joint(spot) else 0.6
            lettered = [step for step in steps if step.name]
            if lettered:
                names, bold = [step.name for step in lettered], all(map(corner, lettered))
                yield Wish(listed(names), (spot,), clear, step=lettered[0].index, label=",".join(names), bold=bold,
                           raised=self._raised(*lettered))
            numbered = [step for step in steps if not step.name]
            if numbered:
                said = self._numbers(*numbered)
                yield Wish(sentence_runs(said), (spot,), clear, SMALL, pens.FAINT, numbered[0].index, f"point {said}")

    @property
    def _numbered(self) -> bool:
        return self.strokes.plans.numbered

    def _numbers(self, *steps: Step) -> str:
        return ", ".join(str(self.drawn.number(step.index)) for step in steps)

    def _raised(self, *steps: Step) -> str:
        """The numbers that letters bear, where they do."""
        return self._numbers(*steps) if self._numbered else ""

    def _places(self) -> dict[Spot, list[Step]]:
        """The marks that need a letter or number, by where they lie."""
        places: dict[Spot, list[Step]] = {}
        for step in self.strokes.steps:
            drawn = step.op.gives == POINT and step.op.name != "given" and self.strokes.shown(step.index)
            if drawn and self._spoken(step):
                spot = self.strokes.spots[step.index]
                key = next((other for other in places if math.dist(other, spot) < NEAR), spot)
                places.setdefault(key, []).append(step)
        return places

    def _at_joint(self, spot: Spot) -> bool:
        plans, view = self.strokes.plans, self.strokes.view
        return any(math.dist(view(plans.place(name)), spot) < 1.0 for name in plans.drawing.scene.points)

    def _spoken(self, step: Step) -> bool:
        """Whether a mark has a letter, or is spoken of by its number in a later step, or bears it in any case."""
        return bool(step.name) or step.index in self._read or self._numbered

    @cached_property
    def _read(self) -> set[int]:
        """The marks that later steps read by number; a line through two lettered points is spoken of by them."""
        drawn = self.drawn
        return {arg for step in drawn.steps for arg in step.args if drawn.text(arg).endswith(f" {drawn.number(arg)}")}

    def _line_letters(self, step: Step, stretch: Stretch) -> Iterator[Wish]:
        """A locus' letter or a line's number, near an end; and where a line that breaks off goes."""
        drawn = self.drawn
        spots = tuple(clip.between(stretch.start, stretch.end, t) for t in self._along(step, stretch))
        if step.name:
            yield Wish(name_runs(step.name), spots, 0.5, step=step.index, label=step.name, free=True,
                       raised=self._raised(step))
        elif self._spoken(step):
            number = self._numbers(step)
            yield Wish(sentence_runs(number), spots, 0.5, SMALL, pens.FAINT, step.index, f"line {number}", free=True)
        for tip, tail, mark in stretch.breaks:
            name, near = drawn.text(mark), (towards(tip, tail, 2.0),)
            runs = sentence_runs(self.strokes.plans.tongue(said("to {0}", name)), (name,))
            yield Wish(runs, near, 0.6, 2.2, pens.FAINT, step.index, f"to {name} {step.index}")

    def _along(self, step: Step, stretch: Stretch) -> Sequence[float]:
        """Where along a line its letter may stand; numbers stand at its ends, the outer end of the figure first."""
        if not self._numbered:
            return ALONG
        if self.strokes.directs(step):
            return NUMBERED
        out = math.dist(stretch.end, self._middle) >= math.dist(stretch.start, self._middle)
        return (1.0, 0.0, *ALONG) if out else (0.0, 1.0, *(1.0 - t for t in ALONG))

    @cached_property
    def _middle(self) -> Spot:
        """The middle of the plan's marks."""
        return around([spot for i, spot in self.strokes.spots.items() if self.strokes.shown(i)]).centre

    def _arc_number(self, step: Step) -> Iterator[Wish]:
        """An arc's number, near an end of it."""
        arcs = list(self.strokes.arcs(step))
        spots = [arc.at(arc.start + (arc.end - arc.start) * t) for t in STRUCK for arc in arcs]
        if inside := tuple(filter(self.strokes.view.rect.holds, spots)):
            number = self._numbers(step)
            yield Wish(sentence_runs(number), inside, 0.5, SMALL, pens.FAINT, step.index, f"arc {number}", free=True)

    def _spans(self) -> dict[Span, list[Vector]]:
        """The vectors by where they begin and end: some lie on each other."""
        spans: dict[Span, list[Vector]] = {}
        for vector in self.strokes.vectors:
            ends = self.strokes.spots[vector.start], self.strokes.spots[vector.end]
            spans.setdefault(next((span for span in spans if _same(span, ends)), ends), []).append(vector)
        return spans

    def _vector_letter(self, vectors: list[Vector], answered: bool) -> Iterator[Wish]:
        """The own letters of vectors that lie on each other, at their middle, unless their end bears them.

        Where others run the opposite way the letters stand nearer to their heads.
        """
        first = vectors[0]
        borne = self.drawn.steps[first.end].name
        names = tuple(dict.fromkeys(v.label for v in vectors if v.label and v.label != borne))
        if names:
            start, end = self.strokes.spots[first.start], self.strokes.spots[first.end]
            spots = tuple(clip.between(start, end, t) for t in (NEAR_HEAD if answered else MIDDLE))
            pen = replace(pens.VECTORS[first.kind], width=0.0)
            step = max(first.start, first.end)
            yield Wish(listed(names), spots, 0.7, pen=pen, step=step, label=" ".join(names), free=True)


def _same(one: Span, other: Span) -> bool:
    """Whether two spans are one on paper."""
    return all(math.dist(p, q) < NEAR for p, q in zip(one, other, strict=True))
