"""The construction beside the analytic solver: what both say, and by how much they differ."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from graphplan.errors import ConstructionError, Refused, SingularPose
from graphplan.kernel.numbers import Domain
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.numbers.fractions import Fractions
from graphplan.mechanism.model import Scene, Slide
from graphplan.mechanism.units import metre
from graphplan.methods.construct import construct
from graphplan.methods.construction import Construction
from graphplan.methods.forces import pair_name, pairs
from graphplan.methods.ways import growth
from graphplan.solver import Rates, solve
from graphplan.solver.efficiency import efficiency
from graphplan.solver.friction import Frictional, with_friction
from graphplan.solver.power import power
from graphplan.solver.reactions import Reactions, reactions

EPSILON = 2.0**-52
SAFETY = 100  # roundings of the mechanism's own condition that a difference may have

# What the readings of a construction are called in the solver's answer, by the kind that their difference counts for.
KINDS = {
    "velocity": ("velocity", "omega", "slide velocity"),
    "acceleration": ("acceleration", "alpha", "slide acceleration"),
}
RATES = ("omega", "alpha")
RUBBED = ("balance with friction", "balance moment with friction")
MOMENTS = ("slide moment", "balance moment", "lever moment")


@dataclass(frozen=True)
class Report:
    """A construction with its numbers, exact or in floats, and the second opinion on them."""

    drawing: Construction
    rates: Rates
    results: dict[str, dict[str, Any]]
    exact: bool
    reactions: Reactions | None = None
    power: tuple[Any, ...] = ()

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
            largest = max((_size(value) for values in truth for value in values), default=0)
            if gaps:
                found[kind] = max(gaps) / largest if largest else max(gaps)
        if self.forces:
            found["force"] = self._force_gap()
        return found

    @cached_property
    def forces(self) -> dict[str, dict[str, Any]]:
        """What the solver says of every force that the construction gives, by the same kinds and names."""
        if self.reactions is None:
            return {}
        arms = {s.name: self._arm(s) for s in self.scene.slides if s.name in self.results.get("slide arm", {})}
        joints = {pair_name(p, link): self.reactions.joints[p, link] for p, link, _ in pairs(self.scene)}
        slides, moments = ({name: both[k] for name, both in self.reactions.slides.items()} for k in (0, 1))
        balances = {str(k): value for k, value in enumerate(self.reactions.balances, 1)}
        held = {name: value for name, value in balances.items() if isinstance(value, tuple)}
        turned = {name: value for name, value in balances.items() if name not in held}
        return {"reaction": joints, "slide reaction": slides, "slide moment": moments, "slide arm": arms,
                "balance": held, "lever": held, "balance moment": turned, "lever moment": turned, **self._rubbed}

    @property
    def _rubbed(self) -> dict[str, dict[str, Any]]:
        """The balances with friction as they stand in the end, where some are drawn: a round of their own."""
        kinds = [kind for kind in RUBBED if kind in self.results]
        return {kind: {str(k): value for k, value in enumerate(self.standing.balances, 1)
                       if isinstance(value, tuple) == (kind == RUBBED[0])} for kind in kinds}

    def _arm(self, slide: Slide) -> Any:
        """From a slide's point to where its reaction has no moment, square to it."""
        assert self.reactions is not None
        (x, y), moment = self.reactions.slides[slide.name]
        reach = moment * metre(self.scene.units) / (x * x + y * y)
        return y * reach, -x * reach

    @property
    def _metres(self) -> Any:
        """The mechanism's extent in metres: a moment counts as the force that it is at that arm."""
        return self._extent / metre(self.scene.units)

    def _force_gap(self) -> Any:
        """The largest difference of forces and moments beside the largest force; lever and power balance among them."""
        gaps, sizes = [], []
        for kind, truth in self.forces.items():
            if kind in ("slide arm", *RUBBED):
                continue
            arm = self._metres if kind in MOMENTS else 1
            sizes += [_size(value) / arm for value in truth.values()]
            ours = self.results.get(kind, {})
            gaps += [_size(_less(ours[name], truth[name])) / arm for name in ours]
        for value, other in zip(self.power, self.reactions.balances if self.reactions else (), strict=True):
            gaps.append(_size(_less(value, other)) / (1 if isinstance(value, tuple) else self._metres))
        largest = max(sizes, default=0)
        return max(gaps, default=0) / largest if largest else max(gaps, default=0)

    def truth(self, part: str) -> Mapping[str, Any]:
        """The solver's values for one kind of reading."""
        if part in self.forces:
            return self.forces[part]
        truth: Mapping[str, Any] = getattr(self.rates, part.replace(" ", "_"))
        return truth

    def _gap(self, part: str) -> Any:
        """The largest difference in one kind of reading."""
        ours, truth = self.results[part], self.truth(part)
        gap = max(_size(_less(ours[name], truth[name])) for name in ours)
        return gap * self._extent if part in RATES else gap

    @property
    def _extent(self) -> Any:
        """How far the mechanism extends, across or upwards."""
        xs, ys = zip(*self.scene.points.values(), strict=True)
        return max(max(xs) - min(xs), max(ys) - min(ys))

    @property
    def tolerance(self) -> float:
        """What rounding may make of the mechanism's own condition; nothing where the numbers are exact."""
        return 0.0 if self.exact else max(1e-12, SAFETY * EPSILON * self.condition)

    @property
    def condition(self) -> float:
        """The condition of the mechanism: of its rates, and of its reactions where there are loads."""
        return max(self.rates.condition, self.reactions.condition if self.reactions else 1.0)

    @property
    def agrees(self) -> bool:
        """Whether the differences are within the tolerance, or within what this form lets rounding grow to."""
        worst = max(self.check.values(), default=0)
        if self.exact or worst <= self.tolerance:
            return worst <= self.tolerance
        return bool(worst <= SAFETY * EPSILON * growth(self.drawing.program))

    @cached_property
    def standing(self) -> Frictional:
        """What the forces with friction come to, when round follows round."""
        return with_friction(self.scene)

    @property
    def efficiency(self) -> float | None:
        """The instantaneous efficiency of what is drawn: of the balances' powers without friction and with it."""
        if not self.results.keys() & set(RUBBED):
            return None
        with_, without = (self._delivered(suffix) for suffix in (" with friction", ""))
        return efficiency(without, with_)

    def _delivered(self, suffix: str) -> float:
        """The power that the balances of the construction give, in force * length/s."""
        loads, power = self.scene.loads, 0.0
        for number, balance in enumerate(loads.balances if loads else (), 1):
            if balance.at:
                force, velocity = self.results["balance" + suffix][str(number)], self.rates.velocity[balance.at]
                power += float(force[0] * velocity[0] + force[1] * velocity[1])
            else:
                moment = self.results["balance moment" + suffix][str(number)]
                power += float(moment * metre(self.scene.units) * self.rates.omega[balance.link])
        return power


def report(scene: Scene, *, exact: bool = False, method: str = "", plan: str = "orthogonal",
           strict: bool = False, inertia: str = "couple") -> Report:
    """Construct, read, solve and compare.

    Friction, which depends on the sizes of reactions, is left out of exact numbers. Fails with `SingularPose`, which
    names the links and the lines that should meet; with `Refused` where --exact meets an irrational scene, or where no
    construction reaches what is asked.
    """
    if exact and scene.irrational:
        raise Refused(f"{scene.name}: {', '.join(scene.irrational)}", "fractions cannot hold this", "leave out --exact")
    if exact and scene.loads is not None:  # the size of a reaction is a root
        scene = replace(scene, loads=replace(scene.loads, frictions=()))
    try:
        drawing = construct(scene, method=method, plan=plan, strict=strict, inertia=inertia)
    except Refused as refused:
        raise Refused(f"{scene.name}: {refused.what}", refused.why, refused.do) from None
    domain: Domain = Fractions() if exact else Floats()
    try:
        rates = solve(scene, exact)
    except SingularPose as singular:
        raise SingularPose(singular.why, singular.links, _miss(drawing, domain)) from None
    held = reactions(scene, exact) if scene.loads is not None else None
    return Report(drawing, rates, drawing.read(domain), exact, held, power(scene, exact) if held else ())


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


def _less(one: Any, two: Any) -> Any:
    return (one[0] - two[0], one[1] - two[1]) if isinstance(one, tuple) else one - two


def _size(value: Any) -> Any:
    return max(abs(value[0]), abs(value[1])) if isinstance(value, tuple) else abs(value)
