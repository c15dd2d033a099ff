"""The construction against the analytic solver: what both say, by how much they differ, and what is proven of it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from graphplan.check.arithmetics import FLOATS, Arithmetic, Exact, bounded_rates, enclose_scene, placing_error
from graphplan.check.compared import ComparedNumber, Numbers, Readings, Results
from graphplan.check.tolerances import ROUNDING_TOL, UNPROVEN_TOL
from graphplan.errors import BrokenClaim, ConstructionError, Disagreement, SingularPose
from graphplan.mechanism.model import FRAME, Scene
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.kinds import FORCES, MOTION, ORDER, POLE, POLE_HEADING, POLES, kind_of
from graphplan.methods.results import Control, Fact, facts
from graphplan.solver import Rates, solve
from graphplan.solver import instant_centres as solved
from graphplan.solver.instant_centres import relative_motion

if TYPE_CHECKING:
    from graphplan.check.forces import Forces
    from graphplan.solver.statics import Reactions

Reasons = dict[str, dict[str, str]]  # why something is not told, by printed key and name
SAFETY_FACTOR = 100  # times the bound of a constructed place that the cycle may have it elsewhere
STANDING_ROUNDS = 20  # of friction: where none is drawn, the forces stand after so many


# ---- what the solver says in one arithmetic, by the kinds and names of a construction's results ---------------------


@dataclass(frozen=True)
class ReferenceSolution:
    """The solver's rates of a scene, where there are loads its reactions, too, and those after so many `rounds` of
    friction; `power` is a third, independent result for the balances, where it is known."""

    scene: Scene
    rates: Rates
    reactions: Reactions | None = None
    rounds: Callable[[int], Reactions] | None = None
    power: tuple[Any, ...] = ()

    def truth(self, results: Results, rounds: int = 0) -> Readings:
        """The true results of a construction that draws so many rounds of friction."""
        if self.reactions is None or self.rounds is None:
            return rates_by_kind(self.rates, results)
        from graphplan.check.forces import force_truth

        return rates_by_kind(self.rates, results) | force_truth(self.scene, results, self.reactions,
                                                                self.with_friction(rounds))

    @property
    def power_readings(self) -> Readings:
        """The power balance, which is compared as what is drawn is."""
        if not self.power:
            return {}
        from graphplan.check.forces import powers

        return powers(self.power)

    def drawn_forces(self, drawing: Construction, results: Readings, locks: str,
                     exact: bool = False,
                     bounded: bool = False) -> Forces | None:
        """The forces among the results, drawn or computed; None for a scene without loads."""
        if self.reactions is None:
            return None
        from graphplan.check.forces import Forces

        readings_drawn = {(reading.kind, reading.of) for reading in drawing.readings}
        alone = dict.fromkeys(name for kind, named in results.items() for name in named
                              if (kind, name) not in readings_drawn)
        return Forces(drawing.scene, results, self.reactions, self.power, drawing.rounds, exact, bounded,
                      self.with_friction(drawing.rounds), locks, tuple(alone))

    def undrawn_forces(self, drawing: Construction, results: Results, truth: Results) -> Readings:
        """The forces that are asked for and not drawn, as this has them."""
        if self.reactions is None or drawing.scene.loads is None:
            return {}
        from graphplan.check.forces import undrawn_forces

        return undrawn_forces(drawing.scene, results, truth)

    def with_friction(self, rounds: int) -> Reactions | None:
        """The reactions with friction, after so many rounds; None for a scene without friction."""
        loads = self.scene.loads
        if self.rounds is None or loads is None or not (loads.frictions
                                                        and any(drive.rate for drive in self.scene.drives)):
            return None
        return self.rounds(rounds or self.scene.sheet.rounds or STANDING_ROUNDS)


def reference_solution(scene: Scene, by: Arithmetic) -> ReferenceSolution:
    """The solver's results; fails with the arithmetic's doubt if its bounds are too wide."""
    bounded_scene = scene if isinstance(by, Exact) else enclose_scene(scene, by)
    rates = solve(scene, exact=True) if isinstance(by, Exact) else bounded_rates(bounded_scene, by)
    if scene.loads is None:
        return ReferenceSolution(bounded_scene, rates)
    from graphplan.check.forces import bounded_reactions, friction_rounds
    from graphplan.solver.friction import with_friction
    from graphplan.solver.statics import power, reactions

    if isinstance(by, Exact):
        return ReferenceSolution(bounded_scene, rates, reactions(scene, exact=True),
                                 lambda rounds: with_friction(scene, rounds, exact=True), power(scene, exact=True))
    smooth, certain = bounded_reactions(bounded_scene, rates, by), by
    try:
        third = power(scene) if by is FLOATS else ()
    except SingularPose:  # for bare floats alone: better arithmetic will tell
        raise by.doubt from None
    return ReferenceSolution(bounded_scene, rates, smooth, lambda rounds: friction_rounds(smooth, rounds, certain),
                             third)


def rates_by_kind(rates: Rates, results: Results) -> dict[str, Any]:
    """The solver's rates, by the kinds of readings; its places as they are asked for by results."""
    truth: dict[str, Any] = {kind: getattr(rates, kind.replace(" ", "_")) for kind in ORDER if not kind.place}
    for kind, named in results.items():
        if kind_of(kind).group == POLES:
            truth[kind] = {name: _pole(rates, name, value, kind == POLE) for name, value in named.items()}
    return truth | path_truth(rates, results)


def _pole(rates: Rates, name: str, ours: Any, near: bool) -> Any:
    """The instant centre of two links, or the heading to it on the side of ours."""
    centre = relative_motion(rates, *rates.equations.scene.link_pair(name))
    if near:
        return centre.centre
    return centre.heading(ours if isinstance(ours, tuple) else (ours.real, ours.imag))


# ---- the construction against it -------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Report:
    """A construction with its numbers and the solver's; `forces` are those of forces.

    `arithmetic` is that in which both were found: floats, enclosures of so many digits, or fractions; `exact` says that
    the numbers themselves are fractions. `numbers` are what is compared, by kind and name, as the results are. `fault`
    says why nothing can be drawn, where the numbers are the solver's alone. Where some of what is asked cannot be had
    in the pose, `whole` is the scene as it was given, and `missing` says why, by printed key and name.
    """

    drawing: Construction
    rates: Rates
    results: Readings
    exact: bool
    forces: Forces | None = None
    arithmetic: str = "floats"
    numbers: Numbers = field(default_factory=dict, repr=False)
    fault: ConstructionError | None = None
    whole: Scene | None = None
    missing: Reasons = field(default_factory=dict)

    @property
    def given_scene(self) -> Scene:
        """The scene as it was given."""
        return self.whole or self.scene

    @property
    def scene(self) -> Scene:
        return self.drawing.scene

    @property
    def check(self) -> dict[str, Any]:
        """For each kind the largest difference of a number from the solver's, relative to what cancels in the number.
        """
        return self._largest("gap") | ({"position": self.displacement} if self.scene.assembly else {})

    @property
    def displacement(self) -> float:
        """Largest distance of a constructed point from its place in the cycle, relative to the mechanism's extent."""
        drawing = self.drawing
        marks = ((step.index, self.scene.points[step.name]) for step in drawing.program.steps
                 if step.name in self.scene.points and step.name)
        return max((math.dist(drawing.truth[index], tuple(map(float, at))) for index, at in marks),
                   default=0.0) / self.scene.extent

    @property
    def bounds(self) -> dict[str, Any]:
        """For each kind how far any number is off at most, relative to what cancels in it."""
        return self._largest("bound")

    def _largest(self, measure: str) -> dict[str, Any]:
        largest: dict[str, Any] = {}
        for kind in (*MOTION, FORCES):
            values = [number.relative(measure) for reading, _, number in self._all_numbers
                      if kind_of(reading).group == kind]
            if values or (kind == FORCES and self.forces is not None):
                largest[kind] = max(values, default=0)
        return largest

    def truth(self, part: str) -> dict[str, Any]:
        """The solver's values for one kind of reading."""
        return {fact.of: fact.truth for fact in self.facts if fact.kind == part and fact.compared}

    @property
    def facts(self) -> list[Fact]:
        """The results, with the numbers that are compared."""
        return facts(self.results, self.numbers)

    @property
    def condition(self) -> float:
        """The condition of the mechanism: of its rates, and of its reactions where there are loads."""
        return max(self.rates.condition, self.forces.reactions.condition if self.forces else 1.0)

    @property
    def proven(self) -> bool:
        """Whether nine digits of each number are proven, and the difference from the solver is rounding."""
        return all(number.holds and not number.apart for _, _, number in self._all_numbers)

    @property
    def wrong(self) -> bool:
        """Whether the construction and the solver are proven to differ."""
        return any(number.apart for _, _, number in self._all_numbers)

    @property
    def agrees(self) -> bool:
        """Whether construction and solver say the same, no drawn step breaks a claim, no exact number a control."""
        return self.numbers_agree and not self.broken_claim

    @property
    def broken_claim(self) -> str:
        """The first claim that a drawn step breaks, or control that fails, in words; empty if all hold."""
        controls = self.drawing.controls if self.exact else ()  # relative to rounding nobody can tell
        missed = next((control for control in controls if self._fails(control)), None)
        control = missed and (f"link {missed.link}: the lines from {', '.join(missed.points)} to the ends of their "
                              "orthogonal velocities do not meet in its pole")
        return self.drawing.broken_claim or control or self._moving_links_without_pole

    @property
    def _moving_links_without_pole(self) -> str:
        """Links of which no pole is told, as if they rested on each other, and that move as the solver has them."""
        with_pole = {name for kind in (POLE, POLE_HEADING) for name in self.results.get(kind, ())}
        for name in self.scene.find.poles if self.fault is None else ():
            with suppress(SingularPose):  # so do fractions tell that they rest
                if name not in with_pole and relative_motion(self.rates, *self.scene.link_pair(name)).moves:
                    return f"links {name}: they move relative to each other, and have a pole"
        return ""

    def _fails(self, control: Control) -> bool:
        """Whether a control does not hold in fractions."""
        return bool(control.true_deviation(self.scene.points, self.results["velocity"]) != 0)

    @property
    def numbers_agree(self) -> bool:
        """Whether the numbers of construction and solver are the same, as far as can be told."""
        return not self.wrong and self._in_place and all(
            number.gap <= UNPROVEN_TOL * number.scale or number.holds or number.near
                                                         for _, _, number in self._all_numbers)

    @property
    def _in_place(self) -> bool:
        """Whether constructed points are where the cycle has them, as far as the lengths tell."""
        if self.scene.assembly is None or self.fault is not None or self.displacement <= ROUNDING_TOL:
            return True
        return self.displacement <= min(UNPROVEN_TOL, SAFETY_FACTOR * placing_error(self.scene) / self.scene.extent)

    @property
    def _all_numbers(self) -> list[tuple[str, str, ComparedNumber]]:
        """Every number with its kind and name."""
        return [(fact.kind, fact.of, number) for fact in self.facts for number in fact.compared]

    @property
    def disagreement(self) -> Disagreement:
        """The error that names the number with the largest difference; if no number differs, the step that breaks a
        claim."""
        if self.numbers_agree:
            return BrokenClaim(self.scene.name, self.broken_claim)
        if not self._in_place:
            return Disagreement(self.scene.name, "position", "constructed", "followed", self.displacement)
        kind, name, number = max(self._all_numbers, key=lambda one: (one[2].apart, one[2].relative("gap")))
        return Disagreement(self.scene.name, f"{kind} of {name}", number_text(number.value), number_text(number.truth),
                            float(number.relative("gap")))


def number_text(value: Any) -> str:
    """A number as an error line has it."""
    return f"{float(value):.10g}"


# ---- the solver on the curvature of paths and on inflection circles --------------------------------------------------


NOTHING_MOVES = "what is asked of {0} does not exist, as nothing moves there"
OF_POINTS: dict[str, Callable[[Rates, str, str], Any]] = {
    kinds.CENTRE: solved.centre,
    kinds.STRAIGHT: lambda rates, point, link: solved.curvature(rates, point),
    kinds.CUSP: solved.from_pole,
}
OF_LINKS: dict[str, Callable[[Rates, str], Any]] = {
    kinds.INFLECTION: solved.inflection_pole,
    kinds.MOTION_POLE: lambda rates, link: relative_motion(rates, link, FRAME).centre,
    kinds.ACCELERATION_CENTRE: solved.acceleration_centre,
    kinds.TRANSLATION: lambda rates, link: rates.omega[link],
}


def traces_path(rates: Rates, point: str, link: str) -> bool:
    """Whether a point's path has a centre, a direction or a cusp here: not where it rests, unless that is known."""
    for told in OF_POINTS.values():
        with suppress(ZeroDivisionError):
            told(rates, point, link)
            return True
    return False


def path_truth(rates: Rates, results: Mapping[str, Iterable[str]]) -> Readings:
    """The solver's values by the kinds and names of results; fails with `SingularPose` if one does not exist."""
    traced = rates.equations.scene.find.curvature_points
    truths: Readings = {}
    for kind, names in results.items():
        for name in names if kind in OF_POINTS or kind in OF_LINKS else ():
            point, link = traced.get(name, ("", name))
            try:
                value = OF_POINTS[kind](rates, point, link) if kind in OF_POINTS else OF_LINKS[kind](rates, link)
            except ZeroDivisionError:
                raise SingularPose(NOTHING_MOVES.format(name), (link,)) from None
            truths.setdefault(kind, {})[name] = value
    return truths
