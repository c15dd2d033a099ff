"""A student's drawing judged: laid on the construction, gone through step by step, and its first wrong step explained.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from graphplan.accuracy.pencil import Pencil
from graphplan.errors import Refused
from graphplan.kernel.kinds import LINE
from graphplan.marking.judge.figures import judged
from graphplan.marking.judge.fits import Fit
from graphplan.marking.judge.image_search import Sought, wobbly
from graphplan.marking.judge.labels import labelled, sure
from graphplan.marking.judge.matching import Rules, Taken, Walk
from graphplan.marking.judge.register import Register
from graphplan.marking.judge.search import Search
from graphplan.marking.judge.student_sheet import Board
from graphplan.marking.judge.unlabelled import Loose
from graphplan.marking.judge.verdict import WRONG, Judgement
from graphplan.marking.judge.verdicts import verdicts
from graphplan.marking.traces import Frame, Handed
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.layout.composition import Composition

STUMP = 10.0  # mm: a shorter line of a picture may be a piece of an arc or of a letter, unless it is sought there
NOWHERE, RIVALS = 1e6, 2  # mm: as far off as no sheet is; how many frames of a plan are looked at closely
LITTLE = -10.0  # what may speak against a frame in which no mistake is looked for
MOST = 4  # mistakes that are looked for
ALARM = 0.002  # how often a faultless drawing may be called wrong


def judge(drawing: Construction, composition: Composition, handed: Handed, pencil: Pencil) -> Judgement:
    """What is said of a drawing, by the marks on it; `composition` is the sheet that the task was set on.

    Fails with `Refused` where the mechanism is not to be found on it, or a hand without errors has no tolerance.
    """
    if not all(size > 0 for size in pencil.model.values()):
        raise Refused(f"--pencil {pencil.told}", "a hand without errors has no tolerance", "sizes above 0")
    return Judge(drawing, composition, handed, pencil).judgement()


class Judge:
    """One drawing beside its construction."""

    def __init__(self, drawing: Construction, composition: Composition, handed: Handed, pencil: Pencil):
        self.drawing, self.composition, self.handed, self.pencil = drawing, composition, handed, pencil
        plan_of_step = Board(drawing, {}, pencil).plan_of_step
        self.sought: Sought | None = None
        self.traces = [wobbly(trace) for trace in handed.traces] if handed.page else list(handed.traces)
        self.labels = labelled(drawing.drawn, plan_of_step, handed.traces)
        taken = {place for place in self.labels.values() if sure(handed.traces[place])}
        self.loose = [place for place, trace in enumerate(handed.traces) if place not in taken and not (
            handed.page and trace.kind == LINE and math.dist(*trace.spots[:2]) < STUMP)]
        self.rules = Rules(ALARM / len(drawing.drawn), handed.shows)

    def judgement(self) -> Judgement:
        """The verdicts of the frames that fit best, the wrong ones explained."""
        fits = self._frames()
        walk = self.walk(fits, MOST)
        spare = [trace for place, trace in enumerate(self.handed.traces) if place not in walk.used | walk.over]
        numbers = tuple(judged(walk, self.handed.numbers)) if self.handed.numbers else ()
        return Judgement(
            self.handed.name, self.drawing, self.composition, {panel: fit.frame for panel, fit in fits.items()},
            tuple(verdicts(walk)), tuple(spare), numbers)

    # ---- frames ----------------------------------------------------------------------------------------------------

    def _frames(self) -> dict[str, Fit]:
        """Where every plan lies, plan by plan: as on the task's sheet, unless another frame explains more."""
        if not self.handed.traces:  # numbers alone: as on the task's sheet
            return {panel: Fit(Frame(complex(*view.origin), view.scale))
                    for panel, view in self.composition.views.items()}
        register = Register(self.drawing, self.composition, self.handed, self.pencil, self.labels)
        if self.handed.frames.keys() >= set(register.panels):
            return {panel: Fit(self.handed.frames[panel]) for panel in register.panels}
        mechanism = register.mechanism()
        if self.loose:
            register.follow(self._alone(mechanism, register.panels))
        expected = {panel: register.expected(panel, mechanism) for panel in register.panels[1:]}
        fits = {MECHANISM: mechanism} | {panel: found[0] for panel, found in expected.items()}
        for panel, found in expected.items():
            if len(found) > 1:
                fits[panel] = self._likeliest(fits, panel, found)
        if begun := register.begins(fits):
            self._label(begun)
            fits |= {panel: register.expected(panel, mechanism)[0] for panel in register.panels[1:]}
        return self._relaid(fits, register)

    def _relaid(self, fits: dict[str, Fit], register: Register) -> dict[str, Fit]:
        """The frames of the plans whose steps are wrong in the expected ones, as rivals have it that explain them."""
        plan_of_step, start = register.plan_of_step, self._start(fits)
        for panel in [panel for panel in register.panels[1:] if panel not in self.handed.frames]:
            end = len(plan_of_step) - plan_of_step[::-1].index(panel)
            start = start.moved(self._start(fits)).until(plan_of_step.index(panel))
            walk = start.fork().until(end)
            wrong, best = float(_wrong(walk, panel)), fits[panel]
            for rival in register.rivals(panel, walk) if wrong else ():
                other = start.moved(self._start({**fits, panel: rival.fit})).until(end)
                if _wrong(other, panel) + rival.weight < wrong:
                    wrong, best = _wrong(other, panel) + rival.weight, rival.fit
            fits[panel] = best
        return fits

    def _likeliest(self, fits: Mapping[str, Fit], panel: str, found: Sequence[Fit]) -> Fit:
        """The frame of a plan in which a drawing is likeliest, with the likeliest mistakes if it needs any."""
        ways = [(self.walk({**fits, panel: fit}), fit) for fit in found]
        ways.sort(key=lambda way: -way[0].weight)
        if sum(min(taken.weight, 0.0) for taken in _on(ways[0][0], panel)) > LITTLE:
            return ways[0][1]
        return max((fit for _, fit in ways[:RIVALS]), key=lambda fit: self.walk({**fits, panel: fit}, 1).weight)

    def _alone(self, mechanism: Fit, panels: Sequence[str]) -> Walk:
        """The way through with the mechanism alone; the other plans are as good as nowhere."""
        nowhere = Fit(Frame(complex(NOWHERE), 1.0))
        return self.walk({panel: mechanism if panel == MECHANISM else nowhere for panel in panels})

    def _label(self, found: Mapping[int, int]) -> None:
        """Take loose traces for what they were found to be."""
        self.labels |= found
        self.loose = [place for place in self.loose if place not in found.values()]

    # ---- the way through -------------------------------------------------------------------------------------------

    def walk(self, fits: Mapping[str, Fit], mistakes: int = 0) -> Walk:
        """The way through the construction, with the mistakes, not more than so many, that make it likelier."""
        walk = self._start(fits)
        return walk.through(Search(walk.fork()).found(mistakes) if mistakes and self.loose else {})

    def _start(self, fits: Mapping[str, Fit]) -> Walk:
        """Before the first step, in these frames."""
        board = Board(self.drawing, fits, self.pencil)
        loose = Loose(board, self.traces, self.loose, len(self.handed.traces))
        if self.handed.page and not self.sought:
            # the frames of a picture are known: one board serves all
            self.sought = Sought(board, self.handed.page, self.composition.arrangement.panels)
        return Walk(board, self.rules, self.traces, self.labels, loose, self.sought)


def _on(walk: Walk, panel: str) -> Iterator[Taken]:
    """What the steps of a plan were taken for."""
    return (taken for taken in walk.taken if walk.board.plan_of_step[taken.step.index] == panel)


def _wrong(walk: Walk, panel: str) -> int:
    """How many steps of a plan are wrong on the way through."""
    return sum(taken.state == WRONG for taken in _on(walk, panel))
