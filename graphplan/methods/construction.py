"""The construction of a scene: the recorded program, what is read from it, and its drawn form."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple

from graphplan.errors import ConstructionError
from graphplan.kernel.claims import broken_claims
from graphplan.kernel.expand import BY_SET_SQUARE, STRICT, Expander
from graphplan.kernel.faithful import Faithful, faithful
from graphplan.kernel.kinds import LINE, POINT
from graphplan.kernel.numbers import Floats
from graphplan.kernel.passes import Compound, Drawing, Values
from graphplan.kernel.program import EVERYWHERE, Panel, Program, Step, Window, on_pose, shift_steps
from graphplan.kernel.reasoning import order_by_reasoning
from graphplan.kernel.tolerances import FORM_TOL
from graphplan.mechanism.model import Scene
from graphplan.methods import kinds
from graphplan.methods.motion.circle_diagram import DrawnCircle
from graphplan.methods.panels import ACCELERATION_PLAN, MECHANISM, N_PLAN, ForcePlan, LeverPlan, pole_letter
from graphplan.methods.recorded import ReadableDrawing
from graphplan.methods.results import Control, NamedResults, controls
from graphplan.methods.tolerances import EXTENT_TOL
from graphplan.phrases import Said, said

if TYPE_CHECKING:
    from graphplan.methods.replay import Poses


class DrawnVector(NamedTuple):
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


class PartArrow(NamedTuple):
    """A part of a velocity or an acceleration that is drawn as an arrow: its kind, the points that it is `of`, its
    letter, and from which wanted mark to which (by position)."""

    kind: str
    of: str
    letter: str
    marks: tuple[int, int]


@dataclass(frozen=True, eq=False, repr=False)
class DrawnOut(Values):
    """The marks of a construction drawn out in single movements, with their values in some pose; the compounds, the
    controls, and what is read in that pose."""

    compounds: Sequence[Compound] = ()
    controls: Sequence[Control] = ()
    results: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)


@dataclass(frozen=True, eq=False, repr=False)
class Construction(ReadableDrawing, NamedResults[complex, float]):
    """Ordered drawing steps for a scene, and what they give.

    `drawn` is the program in single movements, in the form chosen for this pose. Velocities and accelerations are
    complex numbers in scene units, true and not turned. `rounds` are those of friction that are drawn.
    `ways` says how rings of links are broken, `velocity_ways` how for velocities alone, `poles_by` how poles are found
    that are asked for, `circle` in which order, `paths_by` how the curvature of paths is where no form says so.
    `planned` is whether what is drawn rests on the planner's moves, as poles by the circle diagram alone do not.
    `posed` are the drawn marks in another pose than that of the program: see :meth:`with_values`.
    """

    ways: tuple[Said, ...] = ()
    planned: bool = True
    notes: list[str] = field(default_factory=list)
    ends_in_pose: tuple[tuple[str, str], ...] = ()
    part_arrows: tuple[PartArrow, ...] = ()
    force_arrows: tuple[ForceArrow, ...] = ()
    rounds: int = 0
    velocity_ways: tuple[Said, ...] = ()
    poles_by: tuple[Said, ...] = ()
    circle: DrawnCircle | None = None
    paths_by: tuple[Said, ...] = ()
    posed: DrawnOut | None = None

    def with_values(self, values: Values, results: Mapping[str, Mapping[str, Any]],
                    scene: Scene | None = None) -> Construction:
        """Copy of the drawing with other values of its drawn marks and the results read from them; `scene` is that of
        their pose. What its program gives in other numbers (`read`, `evaluate`) stays that of the pose it was recorded
        in."""
        posed = DrawnOut(values.drawing, values.numbers, values.domain, self.compounds, self.controls, results)
        return replace(self, scene=scene or self.scene, posed=posed)

    def __repr__(self) -> str:
        """One line: the title, and of what can be drawn in this pose how many steps it takes, by which methods."""
        try:
            methods = [f"; {kind} by {', '.join(map(str, names))}" for kind, names in self.method.items()]
            summary = f"{len(self.drawn) - self.drawn.givens} steps{''.join(methods)}"
        except ConstructionError as singular:
            summary = singular.code
        return f"<Construction of {self.scene.title}: {summary}>"

    @cached_property
    def truth(self) -> list[Any]:
        """The float value of every step of `program`, in the scene's pose."""
        values, origin = self._faithful.values, self.program.origin
        return origin.absolute_marks(Floats(), on_pose(self.program.steps), values) if origin else values

    @cached_property
    def _faithful(self) -> Faithful:
        return faithful(self.program)

    @cached_property
    def _expander(self) -> Expander:
        """The expander of the program's compounds, about its origin."""
        points, origin = dict[str, list[tuple[float, float]]](), self.program.origin
        program = self.program
        if origin:
            program = replace(program, steps=shift_steps(program.steps, -origin.x, -origin.y))
        truth = self._faithful.values
        for step in program.steps:
            if step.op.gives == POINT:
                points.setdefault(step.panel, []).append(truth[step.index])
        least = EXTENT_TOL * float(self.scene.extent)
        windows = {panel: _window(places, least) for panel, places in points.items()}
        keep = STRICT if self.strict else BY_SET_SQUARE
        return Expander(program, truth, keep, windows, self.design.form_on, self.scene.extent, self._faithful.better)

    @cached_property
    def _drawn_out(self) -> tuple[Program, Sequence[Any], list[int]]:
        """The program in single movements, the values of its steps, and the place of each among those drawn out."""
        program, order = order_by_reasoning(self._expander.run(), self._expander.serves)
        values, origin = [self._expander.values[index] for index in order], self.program.origin
        if origin is None:
            return program, values, order
        moved_back = replace(program, steps=shift_steps(program.steps, origin.x, origin.y))
        return moved_back, origin.absolute_marks(Floats(), on_pose(program.steps), values), order

    @cached_property
    def compounds(self) -> Sequence[Compound]:
        """The compounds that take several movements, by their first in drawing order."""
        if self.posed:
            return self.posed.compounds
        program, _, order = self._drawn_out
        now = {before: index for index, before in enumerate(order)}
        place, whole = [now[before] for before in self._expander.place], dict[int, list[Step]]()
        for step, before in zip(program.steps, order, strict=True):
            whole.setdefault(self._expander.serves[before], []).append(step)

        def compound(one: Step, steps: list[Step]) -> Compound:
            inner = {name: now[mark.step.index] for mark, name in self._expander.inner[one.index]}
            as_drawn = one.but(index=place[one.index], args=tuple(place[arg] for arg in one.args))
            return Compound(program, as_drawn, tuple(steps), inner)

        return [compound(self.program.steps[index], steps) for index, steps in whole.items() if len(steps) > 1]

    @cached_property
    def broken_claim(self) -> str:
        """The first drawn step or compound that breaks a claim, in words; empty if all hold.

        Steps that cannot be drawn in this pose have no claim to keep. Drawn steps lose digits where curves cross flat.
        """
        with suppress(ConstructionError):
            extent, blur = self.scene.extent, self._faithful.blur
            return next(chain(broken_claims(self.drawn, self.values, FORM_TOL, extent, blur),
                              broken_claims(self.program, self.truth, extent=extent, blur=blur)), "")
        return ""

    @cached_property
    def controls(self) -> Sequence[Control]:
        """Controls that the finished sheet shows without a step for them; empty if this pose cannot be drawn."""
        if self.posed:
            return self.posed.controls
        with suppress(ConstructionError):
            ends = {vector.point: (vector.start, vector.end) for vector in self.arrows if vector.kind == kinds.VELOCITY}
            window, origin = self._expander.windows.get(MECHANISM, EVERYWHERE), self.program.origin
            if origin:
                window = window._replace(centre=origin.point(Floats(), window.centre))
            visible = controls(self.scene, self.drawn, self.values, ends, window.holds)
            return tuple(visible) if self.turned else ()
        return ()

    @cached_property
    def drawn_out(self) -> Values:
        """The marks drawn in single movements, with their values."""
        return self.posed or Values(Drawing(self._drawn_out[0]), self._drawn_out[1])

    @property
    def drawn(self) -> Program:
        """The program in single movements."""
        return self.drawn_out.drawing.program

    @property
    def values(self) -> Sequence[Any]:
        """The value of every step of `drawn`, a float where the pose is known."""
        return self.drawn_out.numbers

    def sentences(self) -> list[str]:
        """Each drawn step in words, with the law or purpose where there is one."""
        return [self.drawn.sentence_with_reason(step.index) for step in self.drawn.steps]

    @property
    def forms(self) -> list[str]:
        """The forms that stand instead of others in this pose, each with the reason, by step number."""
        chosen = [(self.drawn.number(step.index), step.choice.reason()) for step in self.drawn.steps
                  if step.choice and step.choice.passed and step.choice.compound.weighed]
        return [*self.missing, *self.notes, *self._far_pole_notes(), *(said("step {0}: {1}", *row) for row in chosen)]

    def _far_pole_notes(self) -> Iterator[Said]:
        """The poles that are off the sheet, by the lines that cross in them."""
        for reading in self.readings:
            if reading.kind == kinds.POLE and len(reading.marks) == 2:
                lines = (self.drawn.text(self.drawn.wanted[position]) for position in reading.marks)
                letter = pole_letter(self.scene.link_pair(reading.of))
                yield said("{0} lies far off the sheet, where {1} meets {2}", letter, *lines)

    @property
    def plan(self) -> str:
        """Plan of the motion: orthogonal, polar or triangles."""
        return self.design.motion

    @property
    def strict(self) -> bool:
        """Whether it is drawn with compasses and straightedge alone."""
        return self.design.strict

    @cached_property
    def plan_of_step(self) -> list[Panel]:
        """The plan of every drawn step.

        Compasses alone cannot carry a direction from plan to plan: in a strict drawing all plans lie as one.
        """
        return [MECHANISM if self.strict else step.panel for step in self.drawn.steps]

    @cached_property
    def method(self) -> dict[str, list[str]]:
        """Methods of velocities, accelerations and forces, in a few words each."""
        methods: dict[str, list[str]] = {}
        for kind in (kinds.VELOCITY, kinds.ACCELERATION):
            if any(reading.marks and reading.kind.group == kind for reading in self.readings):
                names: list[str] = list(dict.fromkeys([*self._loci(kind), *self._ring_methods(kind)]))
                methods[kind] = names or [PLAIN[self.plan, kind]]
        if self.poles_by:
            methods[kinds.POLES] = [*self.poles_by]
        if curved := [*self._curvatures()]:
            methods[kinds.CURVES] = curved
        return methods | (self._force_method() if self.scene.loads else {})

    def _ring_methods(self, kind: str) -> tuple[Said, ...]:
        """Methods for rings of links; of velocities by poles, which poles."""
        return self.velocity_ways if kind == kinds.VELOCITY else self.ways

    def _curvatures(self) -> Iterator[str]:
        """Yield the methods for centres of curvature and inflection circles, each once."""
        chosen = (step.choice for step in self.drawn.steps if step.choice)
        forms = (choice.form for choice in chosen if choice.compound.claim_operands("curved") or
                 choice.compound.claim_operands("conjugate"))
        yield from dict.fromkeys([*map(said, forms), *self.paths_by])

    def _loci(self, kind: str) -> Iterator[Said]:
        """The forms in which the loci of a kind's plans are drawn, auxiliary points with their letters."""
        letters = self._letters()
        plan_of = {movement.index: one.step.panel for one in self.compounds for movement in one.movements}
        for step in self.drawn.steps:
            if step.choice is None or not step.choice.compound.claim_operands("locus"):
                continue
            plan = plan_of.get(step.index, step.panel).whole
            if (plan in (N_PLAN, ACCELERATION_PLAN)) == (kind == kinds.ACCELERATION):
                form = step.choice.form
                if form != "auxiliary point":
                    yield said(form)
                elif letters:
                    yield said("auxiliary points {0}", ", ".join(letters))

    def _force_method(self) -> dict[str, list[str]]:
        """Methods of forces: polygons, their auxiliary points and false positions, and the lever."""
        plans = {step.panel for step in self.drawn.steps if isinstance(step.panel, ForcePlan)}
        steps = [step for step in self.program.steps if step.panel in plans or step.op.gives == LINE]
        used = {step.op.method for step in steps}
        names: list[str] = [said("force polygons")] if plans else []
        names += [said(name) for name in sorted(used) if name]
        names += [said("Zhukovsky's lever")] if any(isinstance(s.panel, LeverPlan) for s in self.drawn.steps) else []
        return {"force": names} if names else {}

    def _letters(self) -> list[str]:
        """The letters of the auxiliary points."""
        names = {step.names.get("Q", "") for step in self.program.steps if step.op.claim_operands("locus")}
        names_on_sheet = {step.name for step in self.drawn.steps}
        return sorted(name for name in names & names_on_sheet if name)

    @property
    def kappa(self) -> float:
        """Drawn velocity over true velocity, in seconds; for accelerations its square."""
        return float(self.tempo.kappa)

    @cached_property
    def arrows(self) -> tuple[DrawnVector, ...]:
        """The vectors that were asked for, as marks of the drawn program, after the parts that they are the sums of.

        A part that is the whole has no letter beside that one's.
        """
        results = [self._arrow(reading.kind, reading.of, f"{reading.kind.dimension.letter}_{reading.of}", reading.marks)
                   for reading in self.readings if reading.kind in (kinds.VELOCITY, kinds.ACCELERATION)]
        whole = {(vector.start, vector.end) for vector in results}
        components = [self._arrow(*arrow) for arrow in self.part_arrows]
        components = [arrow._replace(label="") if (arrow.start, arrow.end) in whole else arrow for arrow in components]
        forces = (self._arrow(kind, letter, letter, marks) for kind, letter, marks in self.force_arrows)
        return (*components, *results, *forces)

    def _arrow(self, kind: str, of: str, letter: str, marks: tuple[int, ...]) -> DrawnVector:
        """A vector between two wanted marks, by their positions."""
        start, end = (self.drawn.wanted[position] for position in marks)
        return DrawnVector(kind, of, letter, self.drawn.steps[end].panel, start, end)

    def evaluate(self, points: Mapping[str, Any], guides: Mapping[str, Any] | None = None, *,
                 loads: Mapping[str, Any] | None = None, only: Collection[str] | None = None,
                 workers: int | str = 1, compiled: bool = False,
                 progress: Callable[[int, int], None] | None = None) -> Poses:
        """Evaluate the steps in n poses: `points` has complex arrays of shape (n,); points left out stand still.

        `guides` gives, by the names of slides, the directions of guides that ride on moving links and whose direction
        the scene gives as a vector. `loads` gives those that change over the cycle, by their letters: forces as complex
        arrays (P_3, P_3'), moments as real ones (M_1); one left out stays as it is here. `only` names the kinds of
        results that are wanted, such as velocity and acceleration: no other is computed. `workers` threads share the
        poses; the address of a dask scheduler sends it the arrays, which takes longer than they do (streams send
        ranges). `compiled` replays in machine code, if numba is installed: the same numbers to the last bit, several
        times faster. `progress` receives the number of finished poses, and of all.
        """
        from graphplan.methods.replay import batch

        return batch(self, points, guides or {}, loads or {}, only, workers, compiled, progress)

    def replay(self, points: Mapping[str, complex] | None = None, *,
               only: Collection[str] | None = None) -> dict[str, dict[str, Any]]:
        """All readings, or `only` those of some kinds, with some points elsewhere: for poses that come one by one."""
        from graphplan.methods.replay import replay_of

        inputs = {name: {"x": z.real, "y": z.imag} for name, z in (points or {}).items()}
        kinds = self.kinds if only is None else tuple(only)
        reader = replay_of(self, tuple([(name, axis) for name in inputs for axis in "xy"]), kinds)
        return reader.read(inputs) if reader is not None else {
            kind: named for kind, named in self.read(Floats(), inputs).items() if kind in kinds}

    @cached_property
    def fault(self) -> ConstructionError | None:
        """The error because of which floats give no numbers in this pose; None if they do."""
        try:
            _ = self.computed
        except ConstructionError as error:
            return error
        return None

    @property
    def has_numbers(self) -> bool:
        """Whether floats give it numbers in this pose."""
        return self.fault is None

    @cached_property
    def computed(self) -> Mapping[str, Mapping[str, Any]]:
        """All readings in floats, right to the last digits near singular poses too, by kind and name."""
        return self.posed.results if self.posed else self.results_about_origin(self._faithful.values, Floats())

    @cached_property
    def _results(self) -> dict[str, dict[str, Any]]:
        """The results, with complex numbers for vectors."""
        return {kind: {name: complex(*value) if isinstance(value, tuple) else value for name, value in named.items()}
                for kind, named in self.computed.items()}

    def results_of_kind(self, kind: str) -> dict[str, Any]:
        return self._results.get(kind, {})


PLAIN: dict[tuple[str, str], Said] = {
    ("orthogonal", kinds.VELOCITY): said("parallels on the mechanism plan"),
    ("triangles", kinds.VELOCITY): said("velocity triangles"),
    ("polar", kinds.VELOCITY): said("polar velocity plan"),
    ("orthogonal", kinds.ACCELERATION): said("plan of relative normal accelerations"),
    ("triangles", kinds.ACCELERATION): said("plan of relative normal accelerations"),
    ("polar", kinds.ACCELERATION): said("polar acceleration plan"),
}


def _window(points: Iterable[tuple[float, float]], least: float) -> Window:
    """The sheet around a panel: about as much again as these points, which no form has a choice about; no
    smaller than the least, where they coincide."""
    xs, ys = zip(*points, strict=True)
    centre = (min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2
    width = max(max(xs) - min(xs), max(ys) - min(ys), least)
    return Window(centre, 1.25 * width, width)
