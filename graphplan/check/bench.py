"""Where the constructions of a scene are judged: both opinions in as good an arithmetic as the digits need.

Floats with proven bounds come first; where these do not prove nine digits of each number, or the two opinions differ by
more than rounding, enclosures of more and more digits, then fractions.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from importlib.util import find_spec
from itertools import islice
from typing import Any, NamedTuple

from graphplan.check.arithmetics import floats
from graphplan.check.certified_solver import bounded_rates, bounded_reactions, by_part, plain_rates
from graphplan.check.compared import compared, printed, rounded
from graphplan.check.enclosed import enclosed
from graphplan.check.report import Report
from graphplan.errors import ConstructionError, Refused, SingularPose
from graphplan.kernel.kinds import Movement, Primitive
from graphplan.kernel.numbers import Domain
from graphplan.kernel.numbers.floats import Floats
from graphplan.kernel.numbers.fractions import Fractions
from graphplan.mechanism.model import Scene
from graphplan.methods.construct import constructions
from graphplan.methods.construction import Construction
from graphplan.solver import Rates, solve
from graphplan.solver.bounded import Unproven

ENOUGH = 40, 80, 160, 320, 640  # digits of enclosures, one after the other
WAYS = 24  # constructions that are tried at most


class Opinion(NamedTuple):
    """What the solver says in one arithmetic: as plain numbers, and as they are compared, by kind and name."""

    rates: Rates
    reactions: Any  # Reactions, whose module is imported where there are loads
    power: tuple[Any, ...]
    truth: Callable[[dict[str, dict[str, Any]], int], dict[str, Any]]  # of results with so many rounds of friction

    @property
    def third(self) -> dict[str, dict[str, Any]]:
        """The power balance, which is compared as what is drawn is."""
        if not self.power:
            return {}
        from graphplan.check.forces import powers

        return powers(self.power)


class Bench:
    """Where the constructions of a scene are judged, one after the other, each in as good an arithmetic as it needs."""

    def __init__(self, scene: Scene, how: dict[str, Any], exact: bool):
        self.scene, self.how, self.exact = scene, how, exact
        self._enclosed: dict[int, tuple[Scene, Opinion]] = {}

    def judged(self, drawing: Construction) -> Report:
        """A construction beside the solver, in the first arithmetic that proves the digits or a difference.

        Where none does, the last word is that of floats, with bounds as large as they are.
        """
        last: Report | None = None
        fault: ConstructionError | None = None
        for attempt in self._attempts(drawing):
            try:
                found = attempt()
            except ConstructionError as error:
                fault = error
                continue
            except Unproven:
                continue
            if found is not None:
                if found.proven or found.wrong:
                    return found
                last, fault = found, None
        if last is None and (fault is None or self._singular is not None):
            raise self._unproven(drawing)
        if fault is not None:
            raise fault
        assert last is not None
        return last

    def alone(self, drawing: Construction, fault: ConstructionError) -> Report:
        """What the solver says of all that a construction would give, which has no numbers in this pose."""
        found: Report | None = None
        for opinion, name, lift in self._opinions():
            truth = opinion.truth({}, 0)
            ours = {kind: {r.of: lift(truth[kind][r.of]) for r in drawing.readings if r.kind == kind}
                    for kind in drawing.kinds if kind in truth}
            found = replace(self._report(drawing, opinion, ours, name), fault=fault)
            if found.proven:
                break
        if found is None:
            raise fault
        return found

    def _opinions(self) -> Iterator[tuple[Opinion, str, Callable[[Any], Any]]]:
        """What the solver says in each arithmetic that tells anything, and how its numbers are compared."""
        def middle(value: Any) -> Any:
            return tuple(map(middle, value)) if isinstance(value, tuple) else float(value)

        with suppress(Unproven):
            yield self._floating, "floats", middle
        if find_spec("flint"):
            from graphplan.kernel.numbers.enclosures import Undecided, precision

            for digits in ENOUGH:
                with precision(bits(digits)):
                    try:
                        yield self._enclosing(digits)[1], f"enclosures of {digits} digits", lambda value: value
                    except Undecided:
                        continue

    def _attempts(self, drawing: Construction) -> Iterator[Callable[[], Report | None]]:
        """The arithmetics in their order; only fractions can tell of a singular pose that it is."""
        if self.exact:
            yield lambda: self._exactly(drawing)
            return
        yield lambda: self._in_floats(drawing)
        frictions = self.scene.loads.frictions if self.scene.loads else ()
        rational = not self.scene.irrational and not any(friction.at for friction in frictions)
        if find_spec("flint") and not (rational and self._singular):
            for digits in ENOUGH:
                yield lambda digits=digits: self._in_enclosures(drawing, digits)  # type: ignore[misc]
        if rational:
            yield lambda: self._in_fractions(drawing)

    # ---- floats ----------------------------------------------------------------------------------------------------

    def _in_floats(self, drawing: Construction) -> Report:
        return self._report(drawing, self._floating, drawing.read(Floats()), "floats")

    @cached_property
    def _floating(self) -> Opinion:
        """The solver in floats with proven bounds."""
        by = floats()
        try:
            return self._opinion(enclosed(self.scene, by), by, float, "power")
        except Unproven:
            self._unprovable = True
            raise

    _unprovable = False

    @cached_property
    def _singular(self) -> SingularPose | None:
        """Why floats hold the pose for singular, where they do."""
        if not self._unprovable:
            return None
        try:
            solve(self.scene)
            if self.scene.loads is not None:
                from graphplan.solver.statics import reactions

                reactions(self.scene)
        except SingularPose as singular:
            return singular
        return None

    def _unproven(self, drawing: Construction) -> SingularPose | Refused:
        """The error where no arithmetic at hand tells anything: what floats say of it."""
        if self._singular is not None:
            return SingularPose(self._singular.why, self._singular.links, miss(drawing, Floats()))
        return Refused(f"{self.scene.name}: the pose", "it is too near to a singular one for floats",
                       "install graphplan[certified], or give its points as coordinates")

    # ---- enclosures ------------------------------------------------------------------------------------------------

    def _in_enclosures(self, drawing: Construction, digits: int) -> Report | None:
        """Both opinions in enclosures; none where so many digits cannot decide something."""
        from graphplan.kernel.numbers.enclosures import Enclosures, Undecided, precision

        domain = Enclosures()
        with precision(bits(digits)):
            try:
                known, opinion = self._enclosing(digits)
                sharp = self._same(known, drawing) if self.scene.irrational else drawing
                if sharp is None:
                    return None
                return self._report(drawing, opinion, sharp.read(domain), f"enclosures of {digits} digits")
            except Undecided:
                return None
            except ConstructionError:
                if domain.undecided:
                    return None
                raise

    def _enclosing(self, digits: int) -> tuple[Scene, Opinion]:
        """The scene and the solver in enclosures of the working precision."""
        from graphplan.check.arithmetics import enclosures

        if digits not in self._enclosed:
            by = enclosures()
            known = enclosed(self.scene, by)
            self._enclosed[digits] = known, self._opinion(known, by, lambda number: float(by.lift(number).middle), "")
        return self._enclosed[digits]

    def _same(self, known: Scene, drawing: Construction) -> Construction | None:
        """The same construction of the scene in enclosures: by the same steps."""
        def steps(one: Construction) -> list[tuple[Primitive, tuple[int, ...]]]:
            return [(step.op, step.args) for step in one.program.steps]

        every = islice(constructions(known, **self.how), WAYS)
        return next((one for one in every if steps(one) == steps(drawing)), None)

    # ---- fractions -------------------------------------------------------------------------------------------------

    def _exactly(self, drawing: Construction) -> Report:
        """Both opinions in fractions; what they say of a singular pose is so."""
        domain = Fractions()
        try:
            opinion = self._exact
        except SingularPose as singular:
            raise SingularPose(singular.why, singular.links, miss(drawing, domain)) from None
        return self._report(drawing, opinion, drawing.read(domain), "fractions")

    def _in_fractions(self, drawing: Construction) -> Report:
        """The same, printed as floats."""
        found = self._exactly(drawing)
        numbers = rounded(found.numbers)
        rates = plain_rates(found.rates, float)
        results = printed(found.results, numbers, float)
        held = replace(found.held, results=results) if found.held is not None else None
        return replace(found, exact=False, rates=rates, results=results, held=held, numbers=numbers)

    @cached_property
    def _exact(self) -> Opinion:
        rates = solve(self.scene, exact=True)
        if self.scene.loads is None:
            return Opinion(rates, None, (), lambda results, rounds: by_part(rates))
        from graphplan.check.forces import force_truth
        from graphplan.solver.friction import with_friction
        from graphplan.solver.statics import reactions
        from graphplan.solver.virtual_power import power

        def truth(results: dict[str, dict[str, Any]], rounds: int) -> dict[str, Any]:
            rough = with_friction(self.scene, rounds, exact=True) if rounds else None
            return by_part(rates) | force_truth(self.scene, results, found, rough)

        found, powers = reactions(self.scene, exact=True), power(self.scene, exact=True)
        return Opinion(rates, found, powers, truth)

    # ---- both ------------------------------------------------------------------------------------------------------

    def _opinion(self, known: Scene, by: Any, plain: Callable[[Any], Any], third: str) -> Opinion:
        """The solver's answer in numbers with bounds; with the third opinion on balances where floats give it."""
        rates = bounded_rates(known, by)
        told = plain_rates(rates, plain)
        if self.scene.loads is None:
            return Opinion(told, None, (), lambda results, rounds: by_part(rates))
        from graphplan.check.forces import force_truth, plain_reactions
        from graphplan.check.rubbed import rubbed
        from graphplan.solver.virtual_power import power

        def truth(results: dict[str, dict[str, Any]], rounds: int) -> dict[str, Any]:
            rough = rubbed(held, rounds, by) if rounds else None
            return by_part(rates) | force_truth(known, results, held, rough)

        held = bounded_reactions(known, rates, by)
        powers = power(self.scene) if third else ()
        return Opinion(told, plain_reactions(held, told, plain), powers, truth)

    def _report(self, drawing: Construction, opinion: Opinion, ours: dict[str, dict[str, Any]], name: str) -> Report:
        """The comparison in one arithmetic."""
        numbers = compared(drawing, ours | opinion.third, opinion.truth(ours, drawing.rounds))
        results = printed(ours, numbers, (lambda number: number) if self.exact or name == "fractions" else float)
        if opinion.reactions is None:
            return Report(drawing, opinion.rates, results, self.exact, None, name, numbers)
        from graphplan.check.forces import Held

        held = Held(self.scene, results, opinion.reactions, opinion.power, drawing.rounds, self.exact)
        return Report(drawing, opinion.rates, results, self.exact, held, name, numbers)


def bits(digits: int) -> int:
    """The precision that holds so many decimal digits."""
    return digits * 10 // 3 + 4


def miss(drawing: Construction, domain: Domain) -> str:
    """The lines that should meet and do not: where the construction stops, or where its lines cross flattest."""
    try:
        drawing.read(domain)
    except ConstructionError as error:
        return f"{error.drawing}: {error.why}"
    try:
        flattest = min((step for step in drawing.program.steps if step.op.movement is Movement.MET),
                       key=lambda step: _sine(drawing, step.args), default=None)
    except ConstructionError:
        return ""
    if flattest is None:
        return ""
    one, two = (drawing.program.described(arg) for arg in flattest.args)
    return f"{drawing.program.text(flattest.index)}, where {one} should meet {two}: the two lines are all but parallel"


def _sine(drawing: Construction, lines: tuple[int, ...]) -> float:
    (a, b, _), (c, d, _) = (drawing.truth[line] for line in lines)
    return float(abs(a * d - b * c) / ((a * a + b * b) * (c * c + d * d)) ** 0.5)
