"""What a construction costs, as Lemoine counts it (Géométrographie, 1902).

| R1 | the ruler laid at a point            | C1 | a point of the compasses set on a known point           |
| R2 | a line drawn along it                | C2 | a point of the compasses set anywhere on a line         |
|    |                                      | C3 | a circle drawn                                          |

Simplicity is the number of all operations, exactitude the number of those that prepare (R1, C1, C2): the fewer, the
better. The compasses keep their opening until another is taken, and need not be set where they stand already. Lengths
laid off by the scale are outside his system and counted apart; so are set squares and dividers, and how often one
instrument is put down for another.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from graphplan.kernel.kinds import COMPASSES, DIVIDERS, PENCIL, PROTRACTOR, SCALE, SET_SQUARES, STRAIGHTEDGE, Movement
from graphplan.kernel.program import Program, Step
from graphplan.phrases import Said, join, phrase, said


@dataclass(frozen=True)
class Counts:
    """Lemoine's five counts, the lengths laid off by the scale, what set squares and dividers did, and how often the
    instrument changes."""

    R1: int = 0
    R2: int = 0
    C1: int = 0
    C2: int = 0
    C3: int = 0
    scale: int = 0
    changes: int = 0
    others: dict[str, int] = field(default_factory=dict)

    @property
    def strict(self) -> bool:
        """Whether compasses and straightedge did it all."""
        return not self.others

    @property
    def simplicity(self) -> int:
        return self.R1 + self.R2 + self.C1 + self.C2 + self.C3

    @property
    def exactitude(self) -> int:
        return self.R1 + self.C1 + self.C2

    @property
    def operations(self) -> int:
        """Lines, arcs and lengths drawn, and movements of set squares and dividers."""
        return self.R2 + self.C3 + self.scale + sum(self.others.values())

    @property
    def text(self) -> Said:
        """The counts in words."""
        scale_text = [said("by the scale {0}", self.scale)] if self.scale else []
        if not self.strict:
            instrument_texts = [BY[instrument](number) for instrument, number in self.others.items()]
            texts = [said("lines {0}", self.R2), said("arcs {0}", self.C3), *instrument_texts, *scale_text]
            return said("{0} operations: {1}", self.operations, join(texts))
        terms = [f"{n} {name}" for name in ("R1", "R2", "C1", "C2", "C3") if (n := getattr(self, name))]
        simple = said("simplicity {0}, exactitude {1}", self.simplicity, self.exactitude)
        return join([join((" + ".join(terms) or "0", simple), ": "), *scale_text])


BY = {SET_SQUARES: phrase("by set squares {0}"), PROTRACTOR: phrase("by protractor {0}"),
      DIVIDERS: phrase("by dividers {0}"),
      COMPASSES: phrase("by compasses {0}"), STRAIGHTEDGE: phrase("by the straightedge {0}")}


class Tally:
    """Plays a program through: what is in the compasses, and where they stand."""

    def __init__(self, program: Program):
        self.program = program
        self.counts: Counter[str] = Counter()
        self.others: Counter[str] = Counter()
        self.opening, self.needles = -1, frozenset[int]()
        self.known: set[int] = set()
        self.taken = ""

    def play(self, step: Step) -> None:
        """Count one step."""
        match step.op.movement:
            case _ if step.op.free or step.op.instrument == PENCIL:
                pass
            case Movement.RULED:
                self._take(STRAIGHTEDGE)
                self.counts.update(R1=2, R2=1)
            case Movement.OPENED:
                self._open(step)
            case Movement.STRUCK:
                self._take(COMPASSES)
                centre, opening = step.args
                if opening != self.opening:
                    self._open(self.program.steps[opening])
                if centre not in self.needles:
                    self._set(centre)
                self.needles = frozenset([centre])
                self.counts["C3"] += 1
            case _ if step.op.instrument == SCALE:
                self._take(SCALE)
                self.counts["scale"] += 1
            case _:
                self._take(step.op.instrument)
                self.others[step.op.instrument] += 1

    def _take(self, instrument: str) -> None:
        """Take an instrument, putting down the last one."""
        self.counts["changes"] += self.taken not in ("", instrument)
        self.taken = instrument

    def _open(self, step: Step) -> None:
        """Take a distance between the compasses' points, which then stand at both ends."""
        self._take(COMPASSES)
        for point in step.args:
            self._set(point)
        self.opening, self.needles = step.index, frozenset(step.args)

    def _set(self, point: int) -> None:
        """Set a point of the compasses: on a known point, or first on one chosen anywhere on a line."""
        anywhere = self.program.steps[point].op.movement is Movement.PICKED and point not in self.known
        self.counts["C2" if anywhere else "C1"] += 1
        self.known.add(point)


def counts(program: Program) -> Counts:
    """Lemoine's count of a program's operations; complete only for a strict one, as Lemoine had no set squares."""
    tally = Tally(program)
    for step in program.steps:
        tally.play(step)
    return Counts(**tally.counts, others=dict(tally.others))
