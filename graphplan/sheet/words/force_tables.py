"""Tables of forces: the reactions by the letters of the force plans, and the balance by every way that gives it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from graphplan.mechanism.model import Balance
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.panels import balance_letter, pair_letter, slide_named
from graphplan.methods.results import pair_forces
from graphplan.phrases import Phrase, Said, arrange, coordinates, digits, join, phrase, said, unit
from graphplan.sheet.lettering.lettering import Runs, name_runs, sentence_runs
from graphplan.sheet.words.lengths import magnitude
from graphplan.sheet.words.rows import Deviations, Table, largest_size, number_runs, with_deviations
from graphplan.words.tongue import ENGLISH, Tongue

Pair = tuple[float, float]
BALANCE_METHODS = {phrase("by force plans"): kinds.BY_PLANS, phrase("with friction"): kinds.RUBBED,
                   phrase("by the lever"): kinds.BY_LEVER}


@dataclass(frozen=True)
class ForceTables:
    """Tables of a construction's forces, in a language; `values` are its readings by kind and name, `pencil` their
    deviations."""

    drawing: Construction
    values: Mapping[str, Mapping[str, Any]]
    pencil: Deviations = field(default_factory=Deviations)
    tongue: Tongue = ENGLISH

    @property
    def unit(self) -> str:
        return self.tongue(unit(self.drawing.scene.units.force))

    @property
    def moment(self) -> str:
        """The unit of moments."""
        return self.tongue(unit(f"{self.drawing.scene.units.force}·m"))

    # ---- reactions -------------------------------------------------------------------------------------------------

    def reactions(self) -> Iterator[Table]:
        """The reactions without friction, and those with it, where they are drawn."""
        for rubbed in (False, True):
            if any(self.values.get(kind) for kind in self._with_friction(kinds.REACTIONS, rubbed)):
                yield self._reactions(rubbed)

    def _with_friction(self, of: Iterable[str], rubbed: bool) -> list[kinds.ResultKind]:
        """Kinds of these names, with friction if `rubbed`."""
        return [kinds.WITH_FRICTION[kind] if rubbed else kinds.kind_of(kind) for kind in of]

    def _reactions(self, rubbed: bool) -> Table:
        """Every reaction with its components and size, those of slides with their moments about the slide's point."""
        every = self._with_friction(kinds.REACTIONS, rubbed)
        slide_reaction, slide_moment = self._with_friction((kinds.SLIDE_REACTION, kinds.SLIDE_MOMENT), rubbed)
        slides = self.values.get(slide_reaction, {})
        forces = {name: force for kind in every for name, force in self.values.get(kind, {}).items()}
        letters = self._letters()
        largest = largest_size(forces)
        table = [[sentence_runs(word) for word in (self.tongue(every[0].words), "R_x", "R_y", f"|R| {self.unit}")]]
        column = [sentence_runs(f"M {self.moment}")]
        for name, force in forces.items():
            letter, sign = letters[name]
            moment = self.values.get(slide_moment, {}).get(name)
            moment_runs = () if moment is None else self._figure(sign * moment, largest)
            sizes = sign * force[0], sign * force[1], magnitude(*force)
            table.append([letter, *(self._figure(component, largest) for component in sizes)])
            column.append((*moment_runs, *self._deviation_runs(slide_moment, name)))
        table = with_deviations(self.tongue, table, list(forces), self.pencil.of_kinds(*every))
        if slides:
            table = [[*row, cell] for row, cell in zip(table, column, strict=True)]
        return table

    def _figure(self, value: float, largest: float) -> Runs:
        return number_runs(self.tongue, value, largest)

    def _deviation_runs(self, kind: str, name: str) -> Runs:
        """The deviation of a number, to stand behind it; empty where it is not known."""
        deviation = self.pencil.of_kinds(kind).get(name)
        return () if deviation is None else sentence_runs(f" ±{self.tongue(deviation.text)}")

    def _letters(self) -> dict[str, tuple[Runs, int]]:
        """The letter of every reaction and where it acts, by its name in results; that of its answer, with the sign -1,
        where that is drawn."""
        drawn = {vector.label for vector in self.drawing.arrows}
        table = dict[str, tuple[Runs, int]]()
        for force in pair_forces(self.drawing.scene):
            answer = pair_letter(force.on, force.by)
            sign = -1 if answer in drawn and force.letter not in drawn else 1
            place = self.tongue(said("at {0}", force.point) if force.point else said("in mesh"))
            runs = (*name_runs(force.letter if sign > 0 else answer), *sentence_runs(f" {place}", (force.point,)))
            table[force.name] = (name_runs(force.letter), 1) if force.sort == "strand" else (runs, sign)
        return table

    def seats(self) -> Iterator[Said]:
        """Yield the points of application of slides' reactions, in words."""
        for name, (x, y) in self.values.get(kinds.SLIDE_ARM, {}).items():
            slide = next(slide for slide in self.drawing.scene.slides if slide.name == name)
            at = [float(coordinate) for coordinate in self.drawing.scene.points[slide.at]]
            spot, off = coordinates((at[0] + x, at[1] + y)), self.pencil.of_kinds(kinds.SLIDE_ARM).get(name)
            place = [spot, unit(self.drawing.scene.units.length), *([arrange("±{0}", off.text)] if off else [])]
            yield said("The reaction of the slide {0} acts at {1}.", slide_named(slide), join(place, " "))

    # ---- balance ---------------------------------------------------------------------------------------------------

    def balance(self) -> Table:
        """Each balance by force plans and by the lever, side by side."""
        loads = self.drawing.scene.loads
        table: Table = []
        for name, balance in loads.named_balances.items() if loads else ():
            kind_of = {words: kinds.balance_kind(method, balance) for words, method in BALANCE_METHODS.items()}
            readings = {words: self.values.get(kind, {}).get(name) for words, kind in kind_of.items()}
            values = {words: value for words, value in readings.items() if value is not None}
            off = [self._deviation_runs(kind_of[words], name) for words in values]
            heads = (said("balance"), *(words() for words in values))
            table = table or [[sentence_runs(self.tongue(head)) for head in heads]]
            table += self._force(balance, values, off) if balance.at else self._moment(balance, values, off)
        return table if table and len(table[0]) > 1 else []

    def _moment(self, balance: Balance, ways: Mapping[Phrase, float], off: list[Runs]) -> Table:
        name = (*name_runs(balance_letter(balance)), *sentence_runs(f" {self.moment}"))
        values = (sentence_runs(self.tongue(digits(value))) for value in ways.values())
        return [[name, *((*value, *within) for value, within in zip(values, off, strict=True))]]

    def _force(self, balance: Balance, ways: Mapping[Phrase, Pair], off: list[Runs]) -> Table:
        largest, letter, units = largest_size(ways), balance_letter(balance), sentence_runs(f" {self.unit}")
        rows = [[(*name_runs(f"{letter}{axis}"), *units), *(self._figure(v[i], largest) for v in ways.values())]
                for i, axis in enumerate("xy")]  # fmt: skip
        values = zip(ways.values(), off, strict=True)
        sizes = [(*self._figure(magnitude(*v), largest), *within) for v, within in values]
        return [*rows, [(*sentence_runs(f"|{letter}|"), *units), *sizes]]
