"""A construction replayed: the same steps in other poses, one at a time or many, by the tape of its arithmetic."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from graphplan.errors import Undrawable
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.tape.record import Symbols
from graphplan.kernel.tape.source import function

if TYPE_CHECKING:
    from graphplan.kernel.tape.blocks import Blocks
    from graphplan.methods.construction import Construction

Given = Mapping[Any, Mapping[str, Any]]
Free = tuple[tuple[str | int, str], ...]
Results = dict[str, dict[str, Any]]


class Replay:
    """Readings of a construction as a function of some of its given numbers, by step (name or index) and parameter.

    A reading is a number or a pair; `shape` says where each of its numbers stands among the outputs.
    """

    def __init__(self, construction: Construction, free: Free, kinds: Collection[str]):
        self.construction, self.free = construction, free
        self._blocks: dict[bool, Blocks] = {}
        domain = Symbols()
        self.tape = domain.tape
        given: dict[str | int, dict[str, Any]] = {}
        for mark, parameter in free:
            given.setdefault(mark, {})[parameter] = self.tape.input(f"{mark}.{parameter}")
        self.inputs = [given[mark][parameter].place for mark, parameter in free]
        results = construction.read(domain, given)
        self.outputs: list[int] = []
        self.shape = {kind: {name: self._told(value) for name, value in values.items()}
                      for kind, values in results.items() if kind in kinds}
        self.function = function(self.tape, self.inputs, self.outputs)

    def _told(self, value: Any) -> Any:
        if isinstance(value, tuple):
            return tuple(self._told(number) for number in value)
        self.outputs.append(self.tape.place(value))
        return len(self.outputs) - 1

    def read(self, given: Given) -> Results:
        """All readings in one pose, in floats; fails as the rules do."""
        try:
            found = self.function(*[given[mark][parameter] for mark, parameter in self.free])
        except (ZeroDivisionError, OverflowError):
            found = None
        return self.construction.read(Floats(), given) if found is None else self.shaped(found)

    def run(self, given: Given, found: Results, machine: bool = False) -> list[slice]:
        """Fill readings over n poses, vectors as complex numbers; the blocks of poses that are left to the rules."""
        if machine not in self._blocks:
            from graphplan.kernel.tape.blocks import Blocks

            self._blocks[machine] = Blocks(self.tape, self.inputs, self.outputs, machine)
        arrays = [given[mark][parameter] for mark, parameter in self.free]
        return self._blocks[machine].run(arrays, list(self._rows(found)))

    def _rows(self, found: Results) -> Iterator[Any]:
        """The array of each output, in order."""
        for kind, values in self.shape.items():
            for name, places in values.items():
                z = found[kind][name]
                yield from (z.real, z.imag) if isinstance(places, tuple) else (z,)

    def shaped(self, found: Sequence[Any]) -> Results:
        """Outputs as readings, by kind and name."""
        return {kind: {name: _filled(value, found) for name, value in values.items()}
                for kind, values in self.shape.items()}


def _filled(shape: Any, found: Sequence[Any]) -> Any:
    return tuple(found[k] for k in shape) if isinstance(shape, tuple) else found[shape]


def replay(construction: Construction, free: Free, kinds: Collection[str]) -> Replay | None:
    """The replay of these kinds of readings, or None where what stands still cannot be drawn: the rules say why."""
    try:
        return Replay(construction, free, kinds)
    except (Undrawable, ZeroDivisionError):
        return None
