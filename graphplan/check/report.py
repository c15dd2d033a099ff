"""The construction beside the analytic solver: what both say, and by how much they differ."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from graphplan.check.measures import difference, extent, size
from graphplan.errors import ConstructionError, Refused, SingularPose, by_name
from graphplan.kernel.numbers import Domain
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.numbers.fractions import Fractions
from graphplan.mechanism.model import Scene
from graphplan.methods.construct import construct
from graphplan.methods.construction import Construction
from graphplan.methods.ways import growth, growth_of_rates
from graphplan.solver import Rates, solve

if TYPE_CHECKING:
    from graphplan.check.held import Held

EPSILON = 2.0**-52
LOST = 1e-6  # a form that loses more digits than these gives no numbers
SAFETY = 100  # roundings of the mechanism's own condition that a difference may have

# What the readings of a construction are called in the solver's answer, by the kind that their difference counts for.
KINDS = {
    "velocity": ("velocity", "omega", "slide velocity"),
    "acceleration": ("acceleration", "alpha", "slide acceleration"),
}
RATES = ("omega", "alpha")


@dataclass(frozen=True)
class Report:
    """A construction with its numbers, exact or in floats, and the second opinion on them; `held` is that on forces."""

    drawing: Construction
    rates: Rates
    results: dict[str, dict[str, Any]]
    exact: bool
    held: Held | None = None

    @property
    def scene(self) -> Scene:
        return self.drawing.scene

    @cached_property
    def check(self) -> dict[str, Any]:
        """For velocities and accelerations the largest difference beside the largest value of its kind.

        A link's rates count with what they make at the mechanism's extent.
        """
        found = {}
        for kind, parts in KINDS.items():
            gaps = [self._gap(part) for part in parts if part in self.results]
            truth = [self.truth(part).values() for part in parts if part not in RATES]
            largest = max((size(value) for values in truth for value in values), default=0)
            if gaps:
                found[kind] = max(gaps) / largest if largest else max(gaps)
        if self.held is not None:
            found["force"] = self.held.gap
        return found

    def truth(self, part: str) -> Mapping[str, Any]:
        """The solver's values for one kind of reading."""
        if self.held is not None and part in self.held.truth:
            return self.held.truth[part]
        truth: Mapping[str, Any] = getattr(self.rates, part.replace(" ", "_"))
        return truth

    def _gap(self, part: str) -> Any:
        """The largest difference in one kind of reading."""
        ours, truth = self.results[part], self.truth(part)
        gap = max(size(difference(ours[name], truth[name])) for name in ours)
        return gap * extent(self.scene) if part in RATES else gap

    @property
    def tolerance(self) -> float:
        """What rounding may make of the mechanism's own condition; nothing where the numbers are exact."""
        return 0.0 if self.exact else max(1e-12, SAFETY * EPSILON * self.condition)

    @property
    def condition(self) -> float:
        """The condition of the mechanism: of its rates, and of its reactions where there are loads."""
        return max(self.rates.condition, self.held.reactions.condition if self.held else 1.0)

    @property
    def agrees(self) -> bool:
        """Whether the differences are within the tolerance, or within what this form lets rounding grow to."""
        return not self.complaint or (self._grown and self._worst <= LOST)

    @property
    def complaint(self) -> str:
        """What is wrong with the numbers, if anything: one line."""
        if self._worst <= self.tolerance:
            return ""
        if not self._grown:
            return "the construction and the analytic solver disagree"
        digits = max(0, int(-math.log10(self._worst)))
        return (f"rounding grows large in this form here: {digits} digits of the construction hold; "
                "let the form be chosen, without --method or --plan")

    @property
    def _worst(self) -> Any:
        return max(self.check.values(), default=0)

    @cached_property
    def _grown(self) -> bool:
        """Whether this form lets rounding grow to such differences."""
        return not self.exact and bool(self._worst <= SAFETY * EPSILON * max(
            growth(self.drawing.program), growth_of_rates(self.drawing)))


def report(scene: Scene, *, exact: bool = False, method: str = "", plan: str = "",
           strict: bool = False, inertia: str = "couple") -> Report:
    """Construct, read, solve and compare.

    Friction, which depends on the sizes of reactions, is left out of exact numbers. Fails with `SingularPose`, which
    names the links and the lines that should meet; with `Refused` where --exact meets an irrational scene, or where no
    construction reaches what is asked.
    """
    if exact and scene.irrational:
        irrational = ", ".join(sorted(scene.irrational, key=by_name))
        raise Refused(f"{scene.name}: {irrational}", "fractions cannot hold this", "leave out --exact")
    if exact and scene.loads is not None:  # the size of a reaction is a root
        scene = replace(scene, loads=replace(scene.loads, frictions=()))
    try:
        drawing = construct(scene, method=method, plan=plan, strict=strict, inertia=inertia)
    except Refused as refused:
        solve(scene, exact)  # where the pose is singular, that is why nothing can be drawn
        raise Refused(f"{scene.name}: {refused.what}", refused.why, refused.do) from None
    domain: Domain = Fractions() if exact else Floats()
    try:
        rates = solve(scene, exact)
    except SingularPose as singular:
        raise SingularPose(singular.why, singular.links, _miss(drawing, domain)) from None
    if scene.loads is None:
        return Report(drawing, rates, drawing.read(domain), exact)
    from graphplan.check.held import held

    forces = held(scene, exact, lambda: drawing.read(domain))  # the solver is asked first: it names the links
    return Report(drawing, rates, forces.results, exact, forces)


def _miss(drawing: Construction, domain: Domain) -> str:
    """The lines that should meet and do not: where the construction stops, or where its lines cross flattest."""
    try:
        drawing.read(domain)
    except ConstructionError as error:
        return f"{error.drawing}: {error.why}"
    flattest = min((step for step in drawing.program.steps if step.op.name == "meet"),
                   key=lambda step: _sine(drawing, step.args), default=None)
    if flattest is None:
        return ""
    one, two = (drawing.program.described(arg) for arg in flattest.args)
    return f"{drawing.program.text(flattest.index)}, where {one} should meet {two}: the two lines are all but parallel"


def _sine(drawing: Construction, lines: tuple[int, ...]) -> float:
    (a, b, _), (c, d, _) = (drawing.truth[line] for line in lines)
    return float(abs(a * d - b * c) / ((a * a + b * b) * (c * c + d * d)) ** 0.5)
