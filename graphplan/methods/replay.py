"""A construction replayed: the same steps in other poses, one at a time or many, by the tape of its arithmetic."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from graphplan.errors import Undrawable
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.tape.record import Symbols, function, places
from graphplan.methods.recorded import Recorded

if TYPE_CHECKING:
    from graphplan.kernel.tape.blocks import Blocks

Given = Mapping[Any, Mapping[str, Any]]
Free = tuple[tuple[str | int, str], ...]
Results = dict[str, dict[str, Any]]


class Replay:
    """Readings of a construction as a function of some of its given numbers, by step (name or index) and parameter.

    A reading is a number or a pair; `told` says, by kind and name, where on the tape its numbers stand.
    """

    def __init__(self, construction: Recorded, free: Free, kinds: Collection[str]):
        self.construction, self.free = construction, free
        self._blocks: dict[bool, Blocks] = {}
        domain = Symbols()
        self.tape = domain.tape
        given: dict[str | int, dict[str, Any]] = {}
        for mark, parameter in free:
            given.setdefault(mark, {})[parameter] = self.tape.input(f"{mark}.{parameter}")
        self.inputs = [given[mark][parameter].place for mark, parameter in free]
        results = construction.read(domain, given)
        self.told = {kind: {name: self._place(value) for name, value in values.items()}
                     for kind, values in results.items() if kind in kinds}
        self.outputs = list(places(self.told))
        self.function = function(self.tape, self.inputs, self.told)

    def _place(self, value: Any) -> Any:
        return tuple(map(self._place, value)) if isinstance(value, tuple) else self.tape.place(value)

    def read(self, given: Given) -> Results:
        """All readings in one pose, in floats; fails as the rules do."""
        try:
            found: Results | None = self.function(*[given[mark][parameter] for mark, parameter in self.free])
        except (ZeroDivisionError, OverflowError):
            found = None
        if found is not None:
            return found
        return {kind: named for kind, named in self.construction.read(Floats(), given).items() if kind in self.told}

    def run(self, given: Given, found: Results, machine: bool = False) -> Any:
        """Fill readings over n poses, vectors as complex numbers; the places of those that are left to the rules."""
        if machine not in self._blocks:
            from graphplan.kernel.tape.blocks import Blocks

            self._blocks[machine] = Blocks(self.tape, self.inputs, self.outputs, machine)
        arrays = [given[mark][parameter] for mark, parameter in self.free]
        return self._blocks[machine].run(arrays, list(self._rows(found)))

    def _rows(self, found: Results) -> Iterator[Any]:
        """The array of each output, in order."""
        for kind, values in self.told.items():
            for name, told in values.items():
                z = found[kind][name]
                yield from (z.real, z.imag) if isinstance(told, tuple) else (z,)


def replay_of(construction: Recorded, free: Free, kinds: tuple[str, ...]) -> Replay | None:
    """The replay in which these numbers are free and these kinds of readings wanted, made once.

    None where what stands still cannot be drawn: the rules say why.
    """
    made: dict[Any, Replay | None] = construction.__dict__.setdefault("_replays", {})
    if (free, kinds) not in made:
        try:
            made[free, kinds] = Replay(construction, free, kinds)
        except (Undrawable, ZeroDivisionError):
            made[free, kinds] = None
    return made[free, kinds]
