"""The construction of a scene: the recorded program, what is read from it, and its drawn form."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, fields
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple

from graphplan.errors import ConstructionError
from graphplan.kernel.broken import broken
from graphplan.kernel.evaluate import evaluate
from graphplan.kernel.expand import AGREE, BY_SET_SQUARE, STRICT, Expander, Window
from graphplan.kernel.kinds import LINE, POINT
from graphplan.kernel.numbers import Domain
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.passes import gathered
from graphplan.kernel.program import Panel, Program, Step
from graphplan.mechanism.model import FRAME, Number, Scene
from graphplan.methods import kinds
from graphplan.methods.motion.time_scale import Tempo
from graphplan.methods.panels import ACCELERATION_PLAN, N_PLAN, ForcePlan, Lever
from graphplan.methods.results import READERS, Reading, Vectors, balances, prescribed
from graphplan.phrases import Said, said

if TYPE_CHECKING:
    from graphplan.methods.batch import Poses
    from graphplan.methods.replay import Free, Replay


class Arrow(NamedTuple):
    """A vector on the sheet: from one mark to another of the drawn program (indices), on a panel.

    `kind` is velocity or acceleration; `point` is the point of the mechanism it belongs to; `label` is the letter
    that stands at it, possibly empty.
    """

    kind: str
    point: str
    label: str
    panel: Panel
    start: int
    end: int


class ForceArrow(NamedTuple):
    """A force that is drawn as an arrow: its kind and letter, and from which wanted mark to which (by position)."""

    kind: str
    letter: str
    marks: tuple[int, int]


@dataclass(repr=False)
class Construction:
    """Ordered drawing steps for a scene, and what they give.

    `program` holds compounds, each with the value rule that is good in every pose; `drawn` is the same construction
    in single movements, in the form chosen for this pose. Velocities and accelerations are complex numbers in scene
    units, true and not turned. `rounds` are those of friction that are drawn.
    """

    scene: Scene
    tempo: Tempo
    program: Program
    readings: tuple[Reading, ...]
    turned: bool
    ways: tuple[Said, ...] = ()
    prefer: str = ""
    strict: bool = False
    notes: list[str] = field(default_factory=list)
    phi: Number = 1
    shown: tuple[ForceArrow, ...] = ()
    rounds: int = 0

    def __repr__(self) -> str:
        """One line: the title, and of what can be drawn in this pose how many steps it takes, by which methods."""
        try:
            ways = [f"; {kind} by {', '.join(map(str, found))}" for kind, found in self.method.items()]
            told = f"{len(self.drawn) - self.drawn.givens} steps{''.join(ways)}"
        except ConstructionError as singular:
            told = singular.code
        return f"<Construction of {self.scene.title}: {told}>"

    @cached_property
    def truth(self) -> list[Any]:
        """The float value of every step of `program`, in the scene's pose."""
        return evaluate(self.program, Floats())

    @cached_property
    def _expander(self) -> Expander:
        panels = {step.panel for step in self.program.steps}
        windows: dict[str, Window] = {panel: self._window(panel) for panel in panels}
        keep = STRICT if self.strict else BY_SET_SQUARE
        return Expander(self.program, self.truth, keep, windows, self.prefer)

    def _window(self, panel: Panel) -> Window:
        """The sheet around a panel: about as much again as the points that no form has a choice about."""
        points = [self.truth[s.index] for s in self.program.steps if s.panel == panel and s.op.gives == POINT]
        xs, ys = zip(*points, strict=True)
        centre = (min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2
        return Window(centre, 1.25 * max(max(xs) - min(xs), max(ys) - min(ys), 1e-9 * (abs(centre[0]) + 1)))

    @cached_property
    def _gathered(self) -> tuple[Program, list[Any]]:
        program, order = gathered(self._expander.run())
        return program, [self._expander.values[index] for index in order]

    @cached_property
    def broken(self) -> str:
        """The first drawn step or compound that breaks a claim, in words; nothing where none does.

        What cannot be drawn in this pose claims nothing. Drawn steps lose digits where curves cross flat.
        """
        with suppress(ConstructionError):
            return next(chain(broken(self.drawn, self.values, AGREE), broken(self.program, self.truth)), "")
        return ""

    @property
    def drawn(self) -> Program:
        """The program in single movements."""
        return self._gathered[0]

    @property
    def values(self) -> list[Any]:
        """The float value of every step of `drawn`."""
        return self._gathered[1]

    def sentences(self) -> list[str]:
        """Each drawn step in words, with the law or purpose where there is one."""
        return [self.drawn.told(step.index) for step in self.drawn.steps]

    @property
    def forms(self) -> list[str]:
        """The forms chosen for this pose, each with the reason, by step number."""
        return self._forms()

    @property
    def brief_forms(self) -> list[str]:
        """The same, each form beside its nearest rival only."""
        return self._forms(rivals=1)

    def _forms(self, rivals: int | None = None) -> list[str]:
        chosen = [(self.drawn.number(step.index), step.choice.reason(rivals)) for step in self.drawn.steps
                  if step.choice and step.choice.others and step.choice.compound.weighed]
        return self.notes + [said("step {0}: {1}", *told) for told in chosen]

    @cached_property
    def method(self) -> dict[str, list[str]]:
        """How velocities, accelerations and forces are found, in a few words each."""
        found: dict[str, list[str]] = {}
        for kind in (kinds.VELOCITY, kinds.ACCELERATION):
            if any(reading.marks and reading.kind.group == kind for reading in self.readings):
                ways: list[str] = list(dict.fromkeys([*self._loci(kind), *self.ways]))
                found[kind] = ways or [PLAIN[self.turned, kind]]
        return found | self._force_method()

    def _loci(self, kind: str) -> Iterator[Said]:
        """The forms in which the loci of a kind's plans are drawn, auxiliary points with their letters."""
        letters = self._letters()
        for step in self.drawn.steps:
            if step.choice is None or not step.choice.compound.claimed("locus"):
                continue
            if (step.panel in (N_PLAN, ACCELERATION_PLAN)) == (kind == kinds.ACCELERATION):
                form = step.choice.best.form
                if form != "auxiliary point":
                    yield said(form.partition(" on ")[0])
                elif letters:
                    yield said("auxiliary points {0}", ", ".join(letters))

    def _force_method(self) -> dict[str, list[str]]:
        """How forces are found: by polygons, with what auxiliary points and false positions, and by the lever."""
        plans = {step.panel for step in self.drawn.steps if isinstance(step.panel, ForcePlan)}
        steps = [step for step in self.program.steps if step.panel in plans or step.op.gives == LINE]
        used = {step.op.method for step in steps}
        names: list[str] = [said("force polygons")] if plans else []
        names += [said(name) for name in sorted(used) if name]
        names += [said("Zhukovsky's lever")] if any(isinstance(s.panel, Lever) for s in self.drawn.steps) else []
        return {"force": names} if names else {}

    def _letters(self) -> list[str]:
        """The letters of the auxiliary points."""
        names = {step.names.get("Q", "") for step in self.program.steps if step.op.claimed("locus")}
        drawn = {step.name for step in self.drawn.steps}
        return sorted(name for name in names & drawn if name)

    @property
    def kappa(self) -> float:
        """Drawn velocity over true velocity, in seconds; for accelerations its square."""
        return float(self.tempo.kappa)

    @property
    def arrows(self) -> tuple[Arrow, ...]:
        """The vectors that were asked for, as marks of the drawn program."""
        found = []
        for reading in self.readings:
            if reading.kind in (kinds.VELOCITY, kinds.ACCELERATION):
                start, end = (self.drawn.wanted[position] for position in reading.marks)
                panel = self.drawn.steps[end].panel
                prefix = "v" if reading.kind == kinds.VELOCITY else "j"
                found.append(Arrow(reading.kind, reading.of, f"{prefix}_{reading.of.lower()}", panel, start, end))
        for force in self.shown:
            start, end = (self.drawn.wanted[position] for position in force.marks)
            found.append(Arrow(force.kind, force.letter, force.letter, self.drawn.steps[end].panel, start, end))
        return tuple(found)

    def read(
        self,
        domain: Domain,
        given: Mapping[Any, Mapping[str, Any]] | None = None,
        after: Callable[[Step], None] | None = None,
    ) -> dict[str, dict[str, Any]]:
        """All readings in a number domain, by kind and name: pairs (x, y), or single numbers for links.

        `given` overrides numbers of steps, by name or index: such as the coordinates of points; `after` is called
        after each step.
        """
        values = evaluate(self.program, domain, given, after)
        return self.told([values[index] for index in self.program.wanted], domain)

    def told(self, wanted: Sequence[Any], domain: Domain) -> dict[str, dict[str, Any]]:
        """All readings from the values of the wanted marks, by kind and name; what is prescribed as it is given."""
        def value(reading: Reading) -> Any:
            marks = [wanted[position] for position in reading.marks]
            return (self.value if reading.given is None else prescribed)(reading, marks, domain)

        return self._named(value)

    def _named(self, value: Callable[[Reading], Any]) -> dict[str, dict[str, Any]]:
        """Something for each reading, by kind and name."""
        results: dict[str, dict[str, Any]] = {}
        for reading in self.readings:
            results.setdefault(reading.kind, {})[reading.of] = value(reading)
        return results

    def value(self, reading: Reading, marks: Sequence[Any], domain: Domain) -> Any:
        """What marks say, if there are any: a rate in the scene's lengths and seconds, or a force in its units."""
        if not marks:
            return prescribed(reading, marks, domain)
        value = READERS[reading.kind.dimension](marks, domain.lift, self)
        return value + domain.lift(reading.excess) if reading.excess else value

    def evaluate(self, points: Mapping[str, Any], guides: Mapping[str, Any] | None = None, *,
                 only: Collection[str] | None = None, workers: int | str = 1, machine: bool = False,
                 progress: Callable[[int, int], None] | None = None) -> Poses:
        """The same steps over n poses: `points` gives complex arrays of shape (n,); points left out stand still.

        `guides` gives, by the names of slides, the directions of guides that ride on moving links and whose direction
        the scene gives as a vector. `only` names the kinds of results that are wanted, such as velocity and
        acceleration: nothing else is reckoned. `workers` processes share the poses out, or those of a dask scheduler
        by its address; with `machine` numba compiles the replay, which pays for millions of poses; `progress` is told
        how many are done, of how many.
        """
        from graphplan.methods.batch import batch

        return batch(self, points, guides or {}, only, workers, machine, progress)

    def blank(self, n: int, value: float | None = math.nan) -> dict[str, dict[str, Any]]:
        """Arrays for the readings in n poses, by kind and name, complex ones for vectors; with None as they come."""
        import numpy as np

        def array(reading: Reading) -> Any:
            numbers = np.empty(n, float if reading.kind.single else complex)
            if value is not None:
                numbers[:] = value
            return numbers

        return self._named(array)

    def replay(self, points: Mapping[str, complex] | None = None, *,
               only: Collection[str] | None = None) -> dict[str, dict[str, Any]]:
        """All readings, or `only` those of some kinds, with some points elsewhere: for poses that come one by one."""
        given = {name: {"x": z.real, "y": z.imag} for name, z in (points or {}).items()}
        kinds = self.kinds if only is None else tuple(only)
        found = self.replay_of(tuple([(name, part) for name in given for part in "xy"]), kinds)
        return found.read(given) if found is not None else {
            kind: named for kind, named in self.read(Floats(), given).items() if kind in kinds}

    @property
    def kinds(self) -> tuple[str, ...]:
        """The kinds of readings that there are."""
        return tuple(dict.fromkeys(reading.kind for reading in self.readings))

    def replay_of(self, free: Free, kinds: tuple[str, ...]) -> Replay | None:
        """The replay in which these numbers are free and these kinds of readings wanted, made once.

        None where what stands still cannot be drawn.
        """
        if (free, kinds) not in self._replays:
            from graphplan.methods.replay import replay

            self._replays[free, kinds] = replay(self, free, kinds)
        return self._replays[free, kinds]

    @cached_property
    def _replays(self) -> dict[tuple[Free, tuple[str, ...]], Replay | None]:
        return {}

    def __getstate__(self) -> dict[str, Any]:
        """What makes it up; what is found from that is found again elsewhere."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    @cached_property
    def _floats(self) -> dict[str, dict[str, Any]]:
        return self.read(Floats())

    @property
    def velocity(self) -> Vectors:
        """The velocities asked for, in length units of the scene per second; of a fixed point 0."""
        return self._vectors(kinds.VELOCITY)

    @property
    def reactions(self) -> dict[str, complex]:
        """The reactions asked for, in the scene's forces: on links at joints, such as `2 at B`, and of slides."""
        forces = {**self._floats.get(kinds.REACTION, {}), **self._floats.get(kinds.SLIDE_REACTION, {})}
        return {name: complex(*pair) for name, pair in forces.items()}

    @property
    def balances(self) -> list[complex | float]:
        """The balances in the scene's order, by force plans or else by the lever: moments in force * m, forces as
        complex numbers."""
        found = balances(self.scene, self._floats)
        return [complex(*value) if isinstance(value, tuple) else float(value) for value in found.values()]

    @property
    def acceleration(self) -> Vectors:
        """The accelerations asked for, in length units of the scene per second squared; of a fixed point 0."""
        return self._vectors(kinds.ACCELERATION)

    def _vectors(self, kind: str) -> Vectors:
        found = {name: complex(*pair) for name, pair in self._floats.get(kind, {}).items()}
        return Vectors(found, self.scene.links.get(FRAME, ()), 0j)


PLAIN = {
    (True, kinds.VELOCITY): said("parallels on the mechanism plan"),
    (True, kinds.ACCELERATION): said("plan of relative normal accelerations"),
    (False, kinds.VELOCITY): said("polar velocity plan"),
    (False, kinds.ACCELERATION): said("polar acceleration plan"),
}
