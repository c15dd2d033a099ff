"""Certified numbers: construction and second opinion between proven bounds, to as many digits as are asked for.

The pose is reckoned from the placements as they are written, the construction is replayed on it and the solver's
equations are solved, all in enclosures. Where these are too wide, or cannot decide something, the working precision is
doubled and everything is done once more.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import islice
from typing import TYPE_CHECKING, Any

from graphplan.check.arithmetics import enclosures
from graphplan.check.bench import WAYS
from graphplan.check.certified_solver import bounded_rates, bounded_reactions
from graphplan.check.decimals import OPEN, SPARE, decimal, upwards
from graphplan.check.enclosed import enclosed
from graphplan.check.json_results import data
from graphplan.check.measures import difference
from graphplan.check.report import Report
from graphplan.check.trusted import trusted
from graphplan.errors import ConstructionError, GraphplanError, Refused, SingularPose
from graphplan.kernel.numbers.enclosures import Enclosure, Enclosures, Undecided, precision
from graphplan.mechanism.model import Scene
from graphplan.methods.construct import constructions
from graphplan.methods.kinds import ACCELERATION, FORCES, ORDER, SLIDE_ARM, VELOCITY, kind_of
from graphplan.methods.motion.time_scale import extent
from graphplan.solver import Rates, solve

if TYPE_CHECKING:
    from graphplan.methods.construction import Construction
    from graphplan.solver.statics import Reactions

MOST = 10_000  # digits
ENOUGH = 1 << 14  # bits, to which the precision is doubled at most; for many digits it is doubled once in any case


@dataclass(frozen=True, kw_only=True)
class Certified(Report):
    """A construction with its numbers between proven bounds; `bits` is the precision at which `digits` were had.

    `results` are enclosures by kind and name, `check` and `errors` are upper bounds by velocity, acceleration, force.
    """

    digits: int
    bits: int

    @cached_property
    def check(self) -> dict[str, Enclosure]:
        """The most that construction and solver may differ by, beside the largest value of each kind."""
        return {kind: Enclosure(max(map(_most, self._gaps(kind)), default=Fraction(0)) / self._sizes[kind])
                for kind in self._parts}

    @property
    def agrees(self) -> bool:
        """Whether the enclosures of construction and solver overlap everywhere."""
        return all(gap.overlaps(Enclosure(0)) for kind in self._parts for gap in self._gaps(kind))

    @cached_property
    def errors(self) -> dict[str, Fraction]:
        """The most that a number of each kind may be off, before its last digit is rounded."""
        return {kind: max((value.error for part in parts for value in self._weighed(part, self.results[part])),
                          default=Fraction(0)) for kind, parts in self._parts.items()}

    @cached_property
    def data(self) -> dict[str, Any]:
        """What `graphplan solve --digits` prints; fails with `Undecided` where there are too few digits yet."""
        check = {kind: upwards(_most(gap)) for kind, gap in self.check.items()}
        bounds = {kind: upwards(error) for kind, error in self.errors.items()}
        table: dict[str, Any] = self._texts(data(self) | {"check": check})
        return table | {"digits": self.digits, "bounds": bounds}

    @property
    def settled(self) -> bool:
        """Whether there are digits enough, and construction and solver agree in them or certainly do not."""
        close = Fraction(10) ** -self.digits
        return bool(self.data) and (not self.agrees or all(_most(gap) <= close for gap in self.check.values()))

    @cached_property
    def _parts(self) -> dict[str, list[str]]:
        """The readings that there are, by the kind that they count for."""
        known: dict[str, list[str]] = {}
        for part in sorted(self.results, key=lambda part: ORDER.get(kind_of(part), len(ORDER))):
            if part != SLIDE_ARM:
                known.setdefault(kind_of(part).group, []).append(part)
        return known

    @cached_property
    def _sizes(self) -> dict[str, Fraction]:
        """The largest value of each kind, or where all are nothing what is drawn as large as the mechanism."""
        unit, phi = (Fraction(float(number)) for number in (self.drawing.tempo.unit, self.drawing.phi))
        drawn = {VELOCITY: self._extent * unit, ACCELERATION: self._extent * unit**2, FORCES: self._extent / phi}
        sizes = {}
        for kind, parts in self._parts.items():
            values = [value for part in parts for value in self._weighed(part, self.results[part])]
            least = max((abs(value.middle) - value.error for value in values), default=Fraction(0))
            sizes[kind] = least if least > 0 else drawn[kind]
        return sizes

    @cached_property
    def _extent(self) -> Fraction:
        return Fraction(extent(self.scene))

    def _weight(self, part: str) -> Fraction:
        """Turnings count with what they make at the mechanism's extent, moments as the force that they are there."""
        return Fraction(kind_of(part).arm(self._extent, self.scene.units))

    def _weighed(self, part: str, values: dict[str, Any]) -> Iterator[Enclosure]:
        """The components of all readings of one kind."""
        for value in values.values():
            for number in value if isinstance(value, tuple) else (value,):
                yield Enclosure(number) * self._weight(part)

    def _gaps(self, kind: str) -> Iterator[Enclosure]:
        """What the construction exceeds the solver by."""
        for part in self._parts[kind]:
            truth, ours = self.truth(part), self.results[part]
            yield from self._weighed(part, {name: difference(ours[name], truth[name]) for name in ours})

    def _texts(self, entry: Any, key: str = "") -> Any:
        """Printed data with every enclosure as a decimal, beside the largest value of what its key names."""
        if isinstance(entry, dict):
            return {name: self._texts(part, name) for name, part in entry.items()}
        if isinstance(entry, list):
            return [self._texts(part, key) for part in entry]
        if not isinstance(entry, Enclosure):
            return entry
        return decimal(entry, self.digits, self._beside(key))

    def _beside(self, key: str) -> Fraction:
        """The largest value of what a key of the printed data names."""
        kind, part = {"omega": ("velocity", "omega"), "alpha": ("acceleration", "alpha"),
                      "moment": ("force", "moment")}.get(key, (key, ""))
        plain = {"acts_at": self._extent, "efficiency": Fraction(1)}
        return plain[key] if key in plain else self._sizes[kind] / self._weight(part)


def certified(scene: Scene, digits: int, *, method: str = "", plan: str = "",
              inertia: str = "couple") -> Certified:
    """Construct, read, solve and compare between proven bounds, until every result has its digits.

    Fails with `SingularPose` where the pose is singular as far as the digits can tell, with `Refused` as `report` does
    and where the digits asked for are not among 1 to 10000.
    """
    if not 1 <= digits <= MOST:
        raise Refused(f"--digits {digits}", "there are no such digits", f"a number from 1 to {MOST}")
    least = bits = math.ceil((digits + SPARE) * math.log2(10)) + 64
    doubt = Undecided(OPEN)
    while bits <= max(ENOUGH, 2 * least):
        with precision(bits):
            try:
                found = _attempt(scene, digits, bits, method=method, plan=plan, inertia=inertia)
                if found.settled:
                    return found
            except Undecided as undecided:
                doubt = undecided
            except ConstructionError as certain:
                raise _named(scene, certain, "", method=method, plan=plan, inertia=inertia) from None
        if bits == least and _certainly_singular(scene):
            raise _named(scene, doubt, "", method=method, plan=plan, inertia=inertia)
        bits *= 2
    far = f", as far as {bits // 2} bits can tell"
    raise _named(scene, doubt.__cause__ or doubt, far, method=method, plan=plan, inertia=inertia)


def _certainly_singular(scene: Scene) -> bool:
    """Whether fractions tell that the pose is singular."""
    try:
        if not scene.irrational:
            solve(scene, exact=True)
    except SingularPose:
        return True
    return False


def _attempt(scene: Scene, digits: int, bits: int, **how: Any) -> Certified:
    """Both opinions at one precision, by the first way on which they agree; `Undecided` where that is too low."""
    by = enclosures()
    try:
        known = enclosed(scene, by)
    except Undecided:
        raise Undecided("whether the arcs of its points meet cannot be told") from None
    rates = bounded_rates(known, by)
    forces = bounded_reactions(known, rates, by) if known.loads is not None else None
    wrong: Certified | None = None
    stuck: ConstructionError | None = None
    try:
        for drawing in islice(constructions(known, **how), WAYS):
            try:
                found = _beside(drawing, rates, forces, digits, bits)
            except ConstructionError as error:
                stuck = stuck or error
                continue
            if found.agrees:
                return found
            wrong = wrong or found
    except Refused as refused:
        if wrong is None and stuck is None:
            raise Refused(f"{scene.name}: {refused.what}", refused.why, refused.do) from None
    if wrong is None:
        assert stuck is not None
        raise stuck
    return wrong


def _beside(drawing: Construction, rates: Rates, smooth: Reactions | None, digits: int, bits: int) -> Certified:
    """One construction beside the solver."""
    domain = Enclosures()
    try:
        results = drawing.read(domain)
    except ConstructionError as error:
        if domain.undecided:
            raise Undecided(error.why) from error
        raise
    if smooth is None:
        return Certified(drawing, rates, results, False, digits=digits, bits=bits)
    from graphplan.check.forces import Held
    from graphplan.check.rubbed import rubbed

    rough = rubbed(smooth, drawing.rounds, enclosures()) if drawing.rounds else None
    forces = Held(drawing.scene, results, smooth, (), drawing.rounds, rough=rough)
    return Certified(drawing, rates, results, False, forces, digits=digits, bits=bits)


def _named(scene: Scene, fault: BaseException, far: str, **how: Any) -> GraphplanError:
    """The error that says what cannot be had and how `far` that is known; the floats name links, and lines that miss.

    Where they see nothing singular, it is the step of the construction that is named, or what could not be decided.
    """
    try:
        trusted(scene, **how, refuse=False)
    except SingularPose as singular:
        return SingularPose(f"{singular.why}{far}", singular.links, singular.lines_that_miss)
    if isinstance(fault, ConstructionError):
        return SingularPose(f"{fault.why}{far}", fault.links, fault.drawing)
    return Refused(f"{scene.name}: --digits", f"{fault}{far}", "ask for floats, without --digits")


def _most(value: Enclosure) -> Fraction:
    """What a number's size is at most."""
    return abs(value.middle) + value.error
