"""A student's drawing judged: laid on the construction, gone through step by step, and its first wrong step explained.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from graphplan.drafting.pencil import Pencil
from graphplan.errors import Refused
from graphplan.handed.traces import Frame, Handed
from graphplan.kernel.kinds import LINE
from graphplan.methods.construction import Construction
from graphplan.methods.panels import MECHANISM
from graphplan.sheet.composition import Composition
from graphplan.verify.board import Board
from graphplan.verify.figures import judged
from graphplan.verify.fits import Fit
from graphplan.verify.labels import labelled, sure
from graphplan.verify.mistakes import Slip
from graphplan.verify.pronounce import verdicts
from graphplan.verify.register import Register
from graphplan.verify.sought import Sought, wobbly
from graphplan.verify.verdict import WRONG, Judgement
from graphplan.verify.walk import Loose, Rules, Walk

STUMP = 10.0  # mm: a shorter line of a picture may be a piece of an arc or of a letter, unless it is sought there
TRIALS = 150  # how many suspects are followed up on one way: a sheet full of scribbles ends, too
HORIZON, FIRST = 60, 4  # how many steps further it is seen what a mistake explains; how many of them are compared
NOWHERE, RIVALS = 1e6, 2  # mm: as far off as no sheet is; how many frames of a plan are looked at closely
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
        homes = Board(drawing, {}, pencil).homes
        self.sought: Sought | None = None
        self.trials = 0  # how many suspects may still be followed up
        self.traces = [wobbly(trace) for trace in handed.traces] if handed.page else list(handed.traces)
        self.labels = labelled(drawing.drawn, homes, handed.traces)
        taken = {place for place in self.labels.values() if sure(handed.traces[place])}
        self.loose = [place for place, trace in enumerate(handed.traces) if place not in taken and not (
            handed.page and trace.kind == LINE and math.dist(*trace.spots[:2]) < STUMP)]
        self.rules = Rules(ALARM / len(drawing.drawn), handed.shows)

    def judgement(self) -> Judgement:
        """The verdicts of the frames that fit best, the wrong ones explained."""
        fits = self._frames()
        walk = self.walk(fits, searching=True)
        spare = [trace for place, trace in enumerate(self.handed.traces) if place not in walk.used]
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
        register.taken |= self._there({MECHANISM: mechanism}, register.panels)
        expected = {panel: register.expected(panel, mechanism) for panel in register.panels[1:]}
        fits = {MECHANISM: mechanism} | {panel: found[0] for panel, found in expected.items()}
        for panel, found in expected.items():
            if len(found) > 1:
                fits[panel] = self._fullest(fits, panel, found)
        if begun := register.begins(fits):
            self._label(begun)
            fits |= {panel: register.expected(panel, mechanism)[0] for panel in register.panels[1:]}
        return self._relaid(fits, register)

    def _relaid(self, fits: dict[str, Fit], register: Register) -> dict[str, Fit]:
        """The frames of the plans whose steps are wrong in the expected ones, as rivals have it that explain them."""
        homes, start = register.homes, self._start(fits)
        for panel in [panel for panel in register.panels[1:] if panel not in self.handed.frames]:
            end = len(homes) - homes[::-1].index(panel)
            start = start.moved(self._start(fits)).until(homes.index(panel))
            walk = start.fork().until(end)
            wrong, best = float(_wrong(walk, panel)), fits[panel]
            for rival in register.rivals(panel, walk) if wrong else ():
                other = start.moved(self._start({**fits, panel: rival.fit})).until(end)
                if _wrong(other, panel) + rival.weight < wrong:
                    wrong, best = _wrong(other, panel) + rival.weight, rival.fit
            fits[panel] = best
        return fits

    def _fullest(self, fits: Mapping[str, Fit], panel: str, found: Sequence[Fit]) -> Fit:
        """The frame of a plan in which most traces belong to steps, with the likeliest mistakes for the rest."""
        ranked = sorted(found, key=lambda fit: -len(self.walk({**fits, panel: fit}).used))
        if len(self.walk({**fits, panel: ranked[0]}).used) == len(self.handed.traces):
            return ranked[0]
        return max(ranked[:RIVALS], key=lambda fit: len(self.walk({**fits, panel: fit}, searching=True).used))

    def _there(self, fits: Mapping[str, Fit], panels: Sequence[str]) -> set[int]:
        """The loose traces that belong to the plans that are found; the others are as good as nowhere."""
        nowhere = Fit(Frame(complex(NOWHERE), 1.0))
        walk = self.walk({panel: fits.get(panel, nowhere) for panel in panels}) if self.loose else None
        return walk.used if walk else set()

    def _label(self, found: Mapping[int, int]) -> None:
        """Take loose traces for what they were found to be."""
        self.labels |= found
        self.loose = [place for place in self.loose if place not in found.values()]

    # ---- the way through -------------------------------------------------------------------------------------------

    def walk(self, fits: Mapping[str, Fit], searching: bool = False) -> Walk:
        """The way through the construction; `searching` for the loose traces that steps were mistaken for."""
        walk = self._start(fits)
        if not searching or not self.loose:
            return walk.through()
        self.trials, found = TRIALS, dict[int, int | Slip]()
        for gain in (2, 1):  # first what others follow from, then what is merely like a mistake
            self._search(walk.fork(), gain, found)
        return walk.through(found)

    def _start(self, fits: Mapping[str, Fit]) -> Walk:
        """Before the first step, in these frames."""
        board = Board(self.drawing, fits, self.pencil)
        loose = Loose(board, self.traces, self.loose, len(self.handed.traces))
        if self.handed.page and not self.sought:
            self.sought = Sought(board, self.handed.page)  # of a picture the frames are known: one board serves all
        return Walk(board, self.rules, self.traces, self.labels, loose, self.sought)

    def _search(self, start: Walk, gain: int, found: dict[int, int | Slip]) -> None:
        """Enter, one after the other, what steps were mistaken for: whatever makes most of the traces fit."""
        while (best := self._best(start.fork(), gain, found)) is not None:
            found[best[0]] = best[1]

    def _best(self, walk: Walk, gain: int, found: dict[int, int | Slip]) -> tuple[int, int | Slip] | None:
        """The step, of the first few that could be, and the suspect or slip that explains most; none that explains
        fewer traces than `gain`."""
        ahead, best, most, seen = walk.fork().through(found), None, gain - 1, 0
        left = set(self.loose) - ahead.used
        while left and len(walk.own) < len(walk.steps) and seen < FIRST and self.trials > 0:
            step = walk.next
            end = min(step.index + HORIZON, len(walk.steps))
            gains = [(len(walk.fork().go(one).until(end, found).used) - len(ahead.before(end)), one)
                     for one in self._tried(walk, left, gain)] if step.index not in found else []
            self.trials -= len(gains)
            larger, one = max(gains, key=lambda pair: pair[0], default=(0, None))
            seen += larger >= gain
            if one is not None and larger > most:
                most, best = larger, (step.index, one)
            walk.go(found.get(step.index))
        return best

    def _tried(self, walk: Walk, left: set[int], gain: int) -> list[int | Slip]:
        """What the next step may have been mistaken for, if it is not to be found where it should be."""
        step, place = walk.next, walk.find()
        # on a line that is there already nothing is to be drawn; and a line begins at a point that it goes through
        unfound = place is None or place in walk.used or not walk.reaches(step, place)
        if not unfound or step.op.name in ("given", "begin") or walk.hidden(step):
            return []
        slips: list[int | Slip] = [*walk.assumptions(left)] if gain > 1 and place is None else []
        return slips + walk.suspects(left, half_right=gain > 1)


def _wrong(walk: Walk, panel: str) -> int:
    """How many steps of a plan are wrong on the way through."""
    return sum(taken.state == WRONG and walk.board.homes[taken.step.index] == panel for taken in walk.taken)
