"""A construction replayed: the same steps in other poses, one at a time or many, by the tape of its arithmetic."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple
from weakref import WeakKeyDictionary

from graphplan.errors import Refused, Undrawable
from graphplan.kernel.kinds import Movement
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.program import Program
from graphplan.kernel.tape.record import Symbols
from graphplan.kernel.tape.written import function, places
from graphplan.mechanism.model import FRAME, Pair, Slide
from graphplan.mechanism.replaced import guides
from graphplan.methods.recorded import ReadableDrawing

if TYPE_CHECKING:
    from graphplan.kernel.tape.blocks import Blocks
    from graphplan.kernel.tape.machine import Machine

Given = Mapping[Any, Mapping[str, Any]]
Free = tuple[tuple[str | int, str], ...]
Results = dict[str, dict[str, Any]]


class Replay:
    """Readings of a construction as a function of some of its given numbers, by step (name or index) and parameter.

    A reading is a number or a pair; `told` says, by kind and name, where on the tape its numbers stand. `outputs` are
    these places, what is read of one point or link together, in the order in which they are drawn: so each number is
    used soon after it is made.
    """

    def __init__(self, construction: ReadableDrawing, free: Free, kinds: Collection[str]):
        self.construction, self.free = construction, free
        self._over_arrays: dict[bool, Blocks | Machine] = {}
        domain = Symbols()
        self.tape = domain.tape
        given: dict[str | int, dict[str, Any]] = {}
        for mark, parameter in free:
            given.setdefault(mark, {})[parameter] = self.tape.input(f"{mark}.{parameter}")
        self.inputs = [given[mark][parameter].place for mark, parameter in free]
        results = construction.read(domain, given)
        self.told = {kind: {name: self._place(value) for name, value in values.items()}
                     for kind, values in results.items() if kind in kinds}
        first = {name: min(places(told)) for values in reversed(self.told.values()) for name, told in values.items()}
        self.rows = sorted(((kind, name) for kind, values in self.told.items() for name in values),
                           key=lambda row: first[row[1]])
        self.outputs = [place for kind, name in self.rows for place in places(self.told[kind][name])]
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

    def run(self, given: Given, found: Results, compiled: bool = False) -> Any:
        """Fill readings over n poses, vectors as complex numbers; the places of those that are left to the rules."""
        if compiled not in self._over_arrays:
            from graphplan.kernel.tape.blocks import Blocks
            from graphplan.kernel.tape.machine import Machine

            self._over_arrays[compiled] = (Machine if compiled else Blocks)(self.tape, self.inputs, self.outputs)
        arrays = [given[mark][parameter] for mark, parameter in self.free]
        return self._over_arrays[compiled].run(arrays, list(self._rows(found)))

    def _rows(self, found: Results) -> Iterator[Any]:
        """The array of each output, in order."""
        for kind, name in self.rows:
            z = found[kind][name]
            yield from (z.real, z.imag) if isinstance(self.told[kind][name], tuple) else (z,)


REPLAYS: WeakKeyDictionary[ReadableDrawing, dict[Any, Replay | None]] = WeakKeyDictionary()  # kept with it


def replay_of(construction: ReadableDrawing, free: Free, kinds: tuple[str, ...]) -> Replay | None:
    """The replay in which these numbers are free and these kinds of readings wanted, made once.

    None where what stands still cannot be drawn: the rules say why.
    """
    made = REPLAYS.setdefault(construction, {})
    if (free, kinds) not in made:
        try:
            made[free, kinds] = Replay(construction, free, kinds)
        except (Undrawable, ZeroDivisionError):
            made[free, kinds] = None
    return made[free, kinds]


class Moving(NamedTuple):
    """What moves with a mechanism, `point` or `guide` by `kind`: its name, where the scene has it, and its two numbers,
    each by all steps and parameters that it is."""

    kind: str
    name: str
    at: Pair
    parts: tuple[Free, Free]


def moving_parts(construction: ReadableDrawing) -> list[Moving]:
    """The drawn points that are on no frame, and the guides that ride on links in directions given as vectors."""
    scene, steps = construction.scene, construction.program.steps[:construction.program.givens]
    found = [Moving("point", step.name, scene.points[step.name], (((step.name, "x"),), ((step.name, "y"),)))
             for step in steps if step.name in scene.points and step.name not in scene.links.get(FRAME, ())]
    for name, slide in guides(scene).items():
        if slide.through is None and slide.along != FRAME and (drawn := guide_steps(construction, slide)):
            dx, dy = (tuple((step, part) for step in drawn) for part in ("dx", "dy"))
            found.append(Moving("guide", name, slide.direction, (dx, dy)))
    return found


def guide_steps(construction: ReadableDrawing, slide: Slide) -> list[int]:
    """The steps that draw the guide of a slide in its given direction, which no other guide may share.

    In the scene's pose two guides through one point, of one direction, are one line; in other poses they are not.
    """
    for name, other in guides(construction.scene).items():
        alike = other.at == slide.at and other.direction == slide.direction and other.through is None
        if alike and other.along not in construction.scene.turning_alike(slide.along):
            raise Refused(f"guides {slide.name} and {name}", "they are drawn as one line, and turn apart",
                          "two points of its link for the direction of each")
    return guiding_steps(construction.program, slide)


def guiding_steps(program: Program, slide: Slide) -> list[int]:
    """The steps of a program that draw the guide of a slide in its given direction."""
    return [step.index for step in program.steps
            if step.op.movement is Movement.GUIDED and step.links == slide.links
            and (step.params["dx"], step.params["dy"]) == slide.direction]
