"""One number of a construction against the solver's: how far the two are apart, what is proven, what cancels in it.

A number counts relative to the largest of the terms that it is made of, a vector as a whole. Where these terms vanish,
too, it counts relative to what is next to nothing of all that moves, or of what is drawn as large as the mechanism.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from typing import Any, NamedTuple

from graphplan.check.tolerances import PROVEN_TOL, PROVEN_ZERO, ROUNDING_TOL
from graphplan.errors import BrokenClaim, Disagreement
from graphplan.kernel.claims import broken_claims
from graphplan.kernel.passes import Values
from graphplan.mechanism.model import Scene
from graphplan.methods import kinds
from graphplan.methods.construction import Construction
from graphplan.methods.recorded import components
from graphplan.solver.linear import Bounded
from graphplan.solver.tolerances import MARGIN

Results = Mapping[str, Mapping[str, Any]]
Readings = dict[str, dict[str, Any]]  # the same, as it is put together: values by kind and name
# Of these nothing is proven: they count relative to the largest of their group.
UNBOUNDED = (kinds.SLIDE_ARM, kinds.POWER, kinds.POWER_MOMENT)


class ComparedNumber(NamedTuple):
    """A printed number and the `truth` that the solver says; `gap` is their difference, `bound` how far the number may
    be off, `scale` what both count relative to. `apart` says that the two are proven to differ, `close` that they
    differ by no more than rounding, `near` that they differ by no more than the rounding of what is drawn as large as
    the mechanism: of a far smaller number that may be all digits."""

    value: Any
    truth: Any
    gap: Any
    bound: Any
    scale: Any
    apart: bool = False
    close: bool = True
    near: bool = False

    @property
    def holds(self) -> bool:
        """Whether nine digits are proven, and the difference is rounding."""
        return self.close and bool(self.bound <= PROVEN_TOL * self.scale)

    def relative(self, part: str) -> Any:
        """The gap or the bound relative to the number's size."""
        number = getattr(self, part)
        return number / self.scale if number else 0


Numbers = dict[str, dict[str, tuple[ComparedNumber, ...]]]


def compare(drawing: Construction, ours: Results, theirs: Results,
            floor: Callable[[str, str], float] = lambda kind, name: 0.0) -> Numbers:
    """Compare all results that the solver knows; each difference is relative to no less than its `floor`."""
    largest = scales(drawing, theirs)
    numbers: Numbers = {}
    for kind, named in ours.items():
        if kind in theirs:
            scale = (drawing.scene.extent if kind == kinds.SLIDE_ARM
                     else largest[kinds.kind_of(kind).group] / weight(drawing, kind))
            least = scale if kind in UNBOUNDED else PROVEN_ZERO * scale
            numbers[kind] = {
                name: tuple(_compare_vector(components(ours[kind][name]), components(theirs[kind][name]),
                                            max(least, floor(kind, name),
                                                sliding_size(drawing.scene, theirs, kind, name)), scale))
                for name in named}
    return numbers


def sliding_size(scene: Scene, theirs: Results, part: str, name: str) -> Any:
    """Size of the vectors whose difference a sliding velocity or acceleration is; 0 for any other result."""
    kind = kinds.kind_of(part)
    if not kind.pair or kind.group == kinds.FORCES:
        return 0.0
    at = next(slide.at for slide in scene.slides if slide.name == name)
    sizes = [abs(plain_number(number)) for number in theirs[kind.group][at]]
    return (sizes[0]**2 + sizes[1]**2) ** 0.5


def plain_number(number: Any) -> Any:
    """A number with bounds or sizes as a float, or an array of them; a fraction as it is."""
    if hasattr(number, "middle"):
        return float(number.middle)
    return getattr(number, "value", number)


def scales(drawing: Construction, theirs: Results) -> dict[str, float]:
    """The largest number of each kind, or what is drawn as large as the mechanism if that is larger."""
    largest = drawn_sizes(drawing)
    for kind, named in theirs.items():
        if kind != kinds.SLIDE_ARM:
            sizes = (abs(float(number)) * weight(drawing, kind) for value in named.values()
                     for number in components(value))
            group = kinds.kind_of(kind).group
            largest[group] = max([largest[group], *sizes])
    return largest


def drawn_sizes(drawing: Construction) -> dict[str, float]:
    """The numbers of each kind that are drawn as large as the mechanism."""
    reach, unit = drawing.scene.extent, float(drawing.tempo.unit)
    return {kinds.VELOCITY: reach * unit, kinds.ACCELERATION: reach * unit**2, kinds.POLES: reach, kinds.CURVES: reach,
            kinds.FORCES: reach / float(drawing.phi)}


def weight(drawing: Construction, part: str) -> float:
    """Turnings count with what they make at the mechanism's extent, moments as the force that they are there."""
    return float(kinds.kind_of(part).arm(drawing.scene.extent, drawing.scene.units))


def _compare_vector(ours: tuple[Any, ...], theirs: tuple[Any, ...], least: float,
                    scale: float) -> Iterator[ComparedNumber]:
    """The components of a vector relative to the size of the whole."""
    numbers = [_compare_number(*pair, scale) for pair in zip(ours, theirs, strict=True)]
    largest = max([least, *(number.scale for number in numbers)])
    for number in numbers:
        close = number.close or number.gap <= ROUNDING_TOL * largest
        yield number._replace(scale=largest, close=close, near=bool(number.gap <= ROUNDING_TOL * scale))


def _compare_number(ours: Any, theirs: Any, scale: float) -> ComparedNumber:
    """Compare a drawn number with the solver's, in any number domain."""
    if isinstance(theirs, Bounded):
        most = abs(theirs.value) + theirs.error
        if most <= PROVEN_ZERO * scale and abs(ours) <= ROUNDING_TOL * scale:  # proven to be zero, and drawn so
            return ComparedNumber(0.0, 0.0, 0.0, MARGIN * most, theirs.size)
        gap = abs(ours - theirs.value)
        if max(abs(theirs.value), gap) <= theirs.error and abs(ours) <= ROUNDING_TOL * theirs.size:
            gap, ours = abs(theirs.value), 0.0  # no digit of it is known: it may be nothing, and so it is printed
        return ComparedNumber(ours, theirs.value, gap, MARGIN * (gap + theirs.error), max(theirs.size, abs(ours)),
                              close=gap <= theirs.error)
    if isinstance(ours, Fraction | int):
        gap = abs(ours - theirs)
        return ComparedNumber(ours, theirs, gap, gap, max(abs(ours), abs(theirs)), bool(gap), not gap)
    return _compare_enclosures(ours, theirs)


def _compare_enclosures(ours: Any, theirs: Any) -> ComparedNumber:
    """One enclosure against another: the float that is printed of it, and how far that is off."""
    middle, error, truth = ours.middle, ours.error, theirs.middle
    printed = 0.0 if abs(middle) <= error else float(middle)
    bound = upper_float(max(abs(middle - Fraction(printed)), theirs.error) + error)
    magnitude, gap = max(abs(printed), abs(float(truth))), float(abs(middle - truth))
    return ComparedNumber(printed, float(truth), gap, bound, magnitude, apart=not ours.overlaps(theirs))


def upper_float(bound: Fraction) -> float:
    """A bound as a float that is no smaller."""
    return math.nextafter(float(bound), math.inf) if bound else 0.0


def round_fractions(numbers: Numbers) -> Numbers:
    """Fractions as the floats that are printed of them, with what rounding makes them be off."""
    def round_number(number: ComparedNumber) -> ComparedNumber:
        value = float(number.value)
        bound = upper_float(number.gap + abs(number.value - Fraction(value)))
        return ComparedNumber(value, float(number.truth), upper_float(number.gap), bound, float(number.scale),
                              number.apart)

    return {kind: {name: tuple(map(round_number, vector)) for name, vector in named.items()}
            for kind, named in numbers.items()}


def printed_results(results: Results, numbers: Numbers, plain: Callable[[Any], Any]) -> Readings:
    """The results as they are printed: numbers that are compared as they were, others made `plain`."""
    def value(kind: str, name: str, result: Any) -> Any:
        if kind not in numbers:
            return tuple(map(plain, result)) if isinstance(result, tuple) else plain(result)
        values = tuple(number.value for number in numbers[kind][name])
        return values if isinstance(result, tuple) else values[0]

    return {kind: {name: value(kind, name, result) for name, result in named.items()}
            for kind, named in results.items()}


# ---- what every subject's check asks of its results ------------------------------------------------------------------


def require_claims(name: str, values: Values) -> None:
    """Fail with `BrokenClaim` where a drawn step breaks one of its claims."""
    if fault := next(broken_claims(values.drawing.program, values.numbers), ""):
        raise BrokenClaim(name, fault)


def require_agreement(name: str, gaps: Mapping[str, float], tolerance: float, one: str = "otherwise",
                      by: str = "by the solver") -> None:
    """Fail with `Disagreement` where independent results differ by more than a tolerance, or cannot be compared."""
    for quantity, gap in gaps.items():
        if not gap <= tolerance:
            raise Disagreement(name, quantity, one, by, gap)
