"""Certified numbers: construction and solver between proven bounds, to as many digits as are asked for.

The pose is computed from the placements as they are written, the construction is replayed on it and the solver's
equations are solved, all in enclosures. Where these are too wide, or cannot decide something, the working precision is
doubled and everything is done once more.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from decimal import ROUND_DOWN, Context, Decimal
from fractions import Fraction
from functools import cached_property
from typing import Any, NamedTuple

from graphplan.check.answerable import answer_what_exists, drop_extras, extras, join_reasons
from graphplan.check.arithmetics import decide_friction, enclosures
from graphplan.check.compared import Readings, drawn_sizes, weight
from graphplan.check.json_results import result_data
from graphplan.check.report import Reasons, ReferenceSolution, Report, reference_solution
from graphplan.check.trusted import first_sound, report, solver_results
from graphplan.errors import BrokenClaim, ConstructionError, Disagreement, GraphplanError, Refused, SingularPose
from graphplan.kernel.numbers.enclosures import Enclosure, Enclosures, Undecided, precision
from graphplan.mechanism.load_values import IRRATIONAL
from graphplan.mechanism.model import Scene
from graphplan.mechanism.order import changing_loads
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.design import OPEN, Design
from graphplan.methods.recorded import components
from graphplan.solver import solve

MAX_DIGITS = 10_000  # digits
FLOAT_DIGITS = 15  # digits that a float has in any case
MAX_BITS = 1 << 14  # bits, to which the precision is doubled at most; for many digits it is doubled once in any case
PATIENT_FACTOR = 4  # times the least precision, up to which a way to draw it may need more bits than the solver
OPEN_BOUNDS = "the bounds of a number do not close, as where a pair with friction may stand still"
SPARE_DIGITS = 12  # known beyond the last before it is rounded: it is off by half a unit and 10^-12 at most


@dataclass(frozen=True, kw_only=True)
class Certified(Report):
    """A construction with its numbers between proven bounds; `bits` is the precision at which `digits` were had.

    `results` are enclosures by kind and name, `truths` what the solver says of them; `check` and `errors` are upper
    bounds by velocity, acceleration, force.
    """

    digits: int
    bits: int
    truths: Readings = field(repr=False)

    @property
    def check(self) -> dict[str, Enclosure]:
        """The most that construction and solver may differ by, relative to the largest value of each kind."""
        return {kind: Enclosure(max(map(_upper_bound, self._gaps(kind)), default=Fraction(0)) / self._sizes[kind])
                for kind in self._kinds_by_group}

    @property
    def agrees(self) -> bool:
        """Whether the enclosures of construction and solver overlap everywhere."""
        same = all(gap.overlaps(Enclosure(0)) for kind in self._kinds_by_group for gap in self._gaps(kind))
        return same and not self.drawing.broken_claim

    @property
    def disagreement(self) -> Disagreement:
        """The error that names the first number in which the two certainly differ, else the step that breaks a claim.
        """
        for kind in (kind for kinds_of_group in self._kinds_by_group.values() for kind in kinds_of_group):
            for name, ours in self.results[kind].items():
                for ours_number, theirs_number in zip(components(ours), components(self.truths[kind][name]),
                                                      strict=True):
                    if not Enclosure(ours_number - theirs_number).overlaps(Enclosure(0)):
                        gap = abs(float(ours_number - theirs_number)) / max(abs(float(ours_number)),
                                                                            abs(float(theirs_number)))
                        return Disagreement(self.scene.name, f"{kind} of {name}", f"{float(ours_number)}",
                                            f"{float(theirs_number)}", gap)
        return BrokenClaim(self.scene.name, self.drawing.broken_claim)

    @property
    def errors(self) -> dict[str, Fraction]:
        """The most that a number of each kind may be off, before its last digit is rounded."""
        return {group: max((value.error for value in self._values(group)), default=Fraction(0))
                for group in self._kinds_by_group}

    @property
    def data(self) -> dict[str, Any]:
        """The JSON of `graphplan solve --digits`; fails with `Undecided` if more digits are needed."""
        with precision(self.bits):
            check = {kind: bound_text(_upper_bound(gap)) for kind, gap in self.check.items()}
            bounds = {kind: bound_text(error) for kind, error in self.errors.items()}
            table: dict[str, Any] = self._texts(result_data(self) | {"check": check})
        return table | {"digits": self.digits, "bounds": bounds}

    @property
    def has_digits(self) -> bool:
        """Whether there are digits enough, and construction and solver agree in them or certainly do not."""
        close = Fraction(10) ** -self.digits
        return bool(self.data) and (not self.agrees or all(_upper_bound(gap) <= close for gap in self.check.values()))

    @property
    def _kinds_by_group(self) -> dict[str, list[str]]:
        """The readings that there are, by the kind that they count for."""
        grouped: dict[str, list[str]] = {}
        for reading_kind in sorted(self.results, key=lambda reading_kind: kinds.ORDER.get(kinds.kind_of(reading_kind),
                                                                                          len(kinds.ORDER))):
            if reading_kind != kinds.SLIDE_ARM:
                grouped.setdefault(kinds.kind_of(reading_kind).group, []).append(reading_kind)
        return grouped

    @cached_property
    def _sizes(self) -> dict[str, Fraction]:
        """The largest value of each kind; if all are zero, the size that is drawn as large as the mechanism."""
        sizes = {}
        for kind in self._kinds_by_group:
            values = [*self._values(kind)]
            least = max((abs(value.middle) - value.error for value in values), default=Fraction(0))
            sizes[kind] = least if least > 0 else Fraction(drawn_sizes(self.drawing)[kind])
        return sizes

    def _values(self, group: str) -> Iterator[Enclosure]:
        """The components of all readings of a group."""
        for kind in self._kinds_by_group[group]:
            yield from self._weighted_components(kind, self.results[kind])

    def _weighted_components(self, part: str, values: dict[str, Any]) -> Iterator[Enclosure]:
        """The components of all readings of one kind."""
        heavy = Fraction(weight(self.drawing, part))
        return (Enclosure(number) * heavy for value in values.values() for number in components(value))

    def _gaps(self, kind: str) -> Iterator[Enclosure]:
        """Differences between the construction and the solver."""
        for reading_kind in self._kinds_by_group[kind]:
            ours, truth = self.results[reading_kind], self.truths[reading_kind]
            yield from self._weighted_components(reading_kind,
                                                 {name: tuple([p - q for p, q in zip(components(value),
                                                                                     components(truth[name]),
                                                                                     strict=True)])
                                                  for name, value in ours.items()})

    def _texts(self, entry: Any, key: str = "") -> Any:
        """Printed data with every enclosure as a decimal, relative to the largest value of what its key names."""
        if isinstance(entry, dict):
            return {name: self._texts(item, name) for name, item in entry.items()}
        if isinstance(entry, list):
            return [self._texts(item, key) for item in entry]
        if not isinstance(entry, Enclosure):
            return entry
        return decimal(entry, self.digits, self._reference_size(key))

    def _reference_size(self, key: str) -> Fraction:
        """The largest value of what a key of the printed data names."""
        extent = Fraction(self.scene.extent)
        lengths = "acts_at", "at", "centre", "radius", "pole", "inflection_pole", "diameter"
        if key in (plain := {**dict.fromkeys(lengths, extent), "efficiency": Fraction(1), "direction": Fraction(1)}):
            return plain[key]
        kind = {"omega": kinds.OMEGA, "alpha": kinds.ALPHA, "moment": kinds.SLIDE_MOMENT}.get(key)
        return self._sizes[kind.group] / Fraction(weight(self.drawing, kind)) if kind else self._sizes[key]


def certify(scene: Scene, digits: int, wishes: Design = OPEN) -> Certified:
    """Construct, read, solve and compare between proven bounds, until every result has its digits.

    Where no way to draw it has numbers there, the solver's alone, as plain `solve` has them. Fails with `SingularPose`
    where the pose is singular as far as the digits can tell, with `Refused` as `report` does and where the digits asked
    for are not among 1 to 10000.
    """
    if not 1 <= digits <= MAX_DIGITS:
        raise Refused(f"--digits {digits}", "out of range", f"a number from 1 to {MAX_DIGITS}")
    for load in changing_loads(scene.loads).values():
        table_name = load.table.where if load.table else ""
        if digits > FLOAT_DIGITS and IRRATIONAL.format(table_name) in scene.irrational:
            raise Refused(f"--digits {digits}", f"{table_name} has its value in this pose to the digits of a float",
                          f"at most {FLOAT_DIGITS}, or a load that is a fraction in this pose")
    scene, locks = decide_friction(scene)
    missing: Reasons = report(scene, wishes, refuse=False, alone=True).missing if extras(scene) else {}
    certified, reasons = answer_what_exists(drop_extras(scene, missing),
                                            lambda asked: _to_digits(asked, digits, wishes, locks))
    every = join_reasons(missing, reasons)
    if not every:
        return certified
    with precision(certified.bits):
        explained = replace(certified, whole=scene, missing=every)
        assert explained.has_digits
    return explained


def _to_digits(scene: Scene, digits: int, wishes: Design, locks: str) -> Certified:
    """The numbers of a scene at the first precision that gives them so many digits."""
    least = bits = math.ceil((digits + SPARE_DIGITS) * math.log2(10)) + 64
    doubt: Exception = Undecided(OPEN_BOUNDS)
    while bits <= max(MAX_BITS, 2 * least):
        with precision(bits):
            try:
                attempt = _Attempt(reference_solution(scene, enclosures(bits)), digits, bits, locks)
                certified = attempt.certify(wishes, patient=bits < PATIENT_FACTOR * least)
                if certified.has_digits:
                    return certified
            except Undecided as undecided:
                doubt = undecided
        if bits == least and _certainly_singular(scene):
            raise _explain_failure(scene, doubt, "", wishes)
        if bits >= PATIENT_FACTOR * least and (exact := _of_fractions(scene, digits, bits, wishes)) is not None:
            return exact
        bits *= 2
    far = f", as far as {bits // 2} bits can tell"
    raise _explain_failure(scene, doubt.__cause__ or doubt, far, wishes)


def _certainly_singular(scene: Scene) -> bool:
    """Whether fractions tell that the pose is singular."""
    try:
        if not scene.irrational:
            solve(scene, exact=True)
    except SingularPose:
        return True
    return False


def _of_fractions(scene: Scene, digits: int, bits: int, wishes: Design) -> Certified | None:
    """The numbers of a rational scene whose bounds do not close, from fractions; None if fractions cannot decide
    either."""
    try:
        exact = report(scene, wishes, exact=True, refuse=False)
    except GraphplanError:
        return None
    with precision(bits):
        results = _enclose(exact.results)
        truths = _enclose({kind: exact.truth(kind) for kind in exact.results})
        forces = exact.forces and replace(exact.forces, results=results, exact=False, bounded=True)
        certified = Certified(exact.drawing, exact.rates, results, False, forces, digits=digits, bits=bits,
                              truths=truths, fault=exact.fault)
        return certified if certified.has_digits else None


def _enclose(value: Any) -> Any:
    """Fractions between bounds: one, a vector of them, or a table."""
    if isinstance(value, dict):
        return {name: _enclose(number) for name, number in value.items()}
    return tuple(map(Enclosure, value)) if isinstance(value, tuple) else Enclosure(value)


class _Attempt(NamedTuple):
    """The scene `solved` at a precision of so many bits, and how many digits are wanted of it."""

    solved: ReferenceSolution
    digits: int
    bits: int
    locks: str

    def certify(self, wishes: Design, patient: bool) -> Certified:
        """The first way on which construction and solver agree, else the solver alone.

        `Undecided` where the precision is too low for a way, as long as we are `patient`.
        """
        doubts: list[ConstructionError] = []
        first = first_sound(self.solved.scene, wishes, lambda drawing: self.of_drawing(drawing, doubts))
        if isinstance(first, Certified) and (first.agrees or not doubts):
            return first
        if doubts and patient:
            raise Undecided(doubts[0].why) from doubts[0]
        if isinstance(first, Certified):
            return first
        drawing, fault = first  # it has no numbers in this pose: what the solver says of all that it would give
        return replace(self.of_results(drawing, solver_results(drawing, self.solved)), fault=fault)

    def of_drawing(self, drawing: Construction, doubts: list[ConstructionError]) -> Certified:
        """One construction and the solver; why it has no numbers joins the `doubts` where more bits may give some."""
        domain = Enclosures()
        try:
            results = drawing.read(domain)
        except ConstructionError as error:
            doubts += [error] if domain.undecided else []
            raise
        return self.of_results(drawing, results)

    def of_results(self, drawing: Construction, results: Readings) -> Certified:
        """Results and the solver's, and the solver's of what is not drawn."""
        truths = self.solved.truth(results, drawing.rounds)
        for kind, named in self.solved.undrawn_forces(drawing, results, truths).items():
            results = results | {kind: results.get(kind, {}) | named}
        forces = self.solved.drawn_forces(drawing, results, self.locks, bounded=True)
        return Certified(drawing, self.solved.rates, results, False, forces, digits=self.digits, bits=self.bits,
                         truths=truths)


def _explain_failure(scene: Scene, fault: BaseException, far: str, wishes: Design) -> GraphplanError:
    """The error that says what cannot be had and how `far` that is known; the floats name links, and lines that miss.

    Where they see nothing singular, it is the step of the construction that is named, or what could not be decided.
    """
    try:
        report(scene, wishes, refuse=False)
    except SingularPose as singular:
        return SingularPose(f"{singular.why}{far}", singular.links, singular.lines_that_miss)
    if isinstance(fault, ConstructionError):
        return SingularPose(f"{fault.why}{far}", fault.links, fault.drawing)
    return Refused(f"{scene.name}: --digits", f"{fault}{far}", "ask for floats, without --digits")


def _upper_bound(value: Enclosure) -> Fraction:
    """Upper bound of a number's size."""
    return abs(value.middle) + value.error


# ---- proven decimals: numerals of which every digit is right -------------------------------------------------------


def decimal(value: Enclosure, digits: int, size: Fraction) -> str:
    """A number with so many significant digits: its own, or those of `size` if it is negligible relative to that.

    Fails with `Undecided` if the enclosure is too wide.
    """
    error, middle = value.error * 10**SPARE_DIGITS, value.middle
    least = _exponent(size) + 1 - digits
    place = _exponent(abs(middle)) + 1 - digits if middle else least
    if error > _ten(place):
        place = least
        if error > _ten(place) or abs(middle) > _ten(place):
            raise Undecided(OPEN_BOUNDS)
    number = round(middle / _ten(place))
    if abs(number) == 10**digits:
        number, place = number // 10, place + 1
    return _numeral(number, place)


def bound_text(bound: Fraction) -> str:
    """An upper bound to two digits, rounded up."""
    place = _exponent(bound) - 1 if bound else 0
    return _numeral(math.ceil(bound / _ten(place)), place)


def _numeral(number: int, place: int) -> str:
    """`number` times 10^`place` in digits."""
    sign, figures, _ = Decimal(number).as_tuple()
    return str(Decimal((sign, figures, place))).lower() if number else "0"


def _ten(power: int) -> Fraction:
    return Fraction(10) ** power


def _exponent(size: Fraction) -> int:
    """The power of ten of the first digit."""
    return Context(prec=1, rounding=ROUND_DOWN).divide(size.numerator, size.denominator).adjusted()
