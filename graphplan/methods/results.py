"""What a construction gives: from which marks each result is read, and how."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from graphplan.kernel.numbers import Domain
from graphplan.mechanism.model import Number, Pair, Scene
from graphplan.mechanism.units import (
    ACCELERATING,
    FORCE,
    LENGTH,
    MOMENT,
    SPEED,
    TURNING,
    TURNING_FASTER,
    Dimension,
    metre,
)
from graphplan.methods import kinds
from graphplan.methods.panels import reactions_named

if TYPE_CHECKING:
    from graphplan.methods.construction import Construction

class Reading(NamedTuple):
    """What is read from the program: of what kind, of which thing, between which wanted marks (by position).

    `excess` is added to a turning that is read off another link: what drives prescribe beside that. `given` is what
    the scene prescribes, for a slide along the guide, its first mark; then the marks only show it.
    """

    kind: kinds.Kind
    of: str
    marks: tuple[int, ...]
    excess: Number = 0
    given: Number | Pair | None = None


class Vectors(dict[str, Any]):
    """Vectors by the points that they are asked of; those of the `fixed` points, which nobody needs to ask, are zero.
    """

    def __init__(self, asked: dict[str, Any], fixed: Collection[str], zero: Any):
        super().__init__(asked)
        self.fixed, self.zero = frozenset(fixed), zero

    def __missing__(self, name: str) -> Any:
        if name in self.fixed:
            return self.zero
        raise KeyError(name)


def thing_named(scene: Scene, kind: kinds.Kind, of: str) -> str:
    """What a reading of a kind is of, in words: a slide, a link at a joint, else a point or link as it is."""
    return reactions_named(scene)[of] if kind.pair else of


def balances(scene: Scene, results: Mapping[str, Mapping[str, Any]],
             ways: Sequence[str] = (kinds.BY_PLANS, kinds.BY_LEVER)) -> dict[str, Any]:
    """The balances among results, by name in the scene's order: each in the first of these ways that gives it."""
    found: dict[str, Any] = {}
    for name, balance in scene.loads.named_balances.items() if scene.loads else ():
        values = [results[kind][name] for kind in (kinds.balance_kind(way, balance) for way in ways)
                  if name in results.get(kind, {})]
        found |= {name: values[0]} if values else {}
    return found


# ---- reading -----------------------------------------------------------------------------------------------------


Lift = Callable[[Any], Any]


def _difference(one: Any, two: Any) -> Any:
    return two[0] - one[0], two[1] - one[1]


def _speed(marks: Sequence[Any], lift: Lift, drawing: Construction) -> Any:
    (x, y), unit = _difference(*marks[-2:]), lift(drawing.tempo.unit)
    return (y * unit, -x * unit) if drawing.turned else (x * unit, y * unit)


def _acceleration(marks: Sequence[Any], lift: Lift, drawing: Construction) -> Any:
    (x, y), unit = _difference(*marks[-2:]), lift(drawing.tempo.unit)
    return x * unit * unit, y * unit * unit


def _turning(marks: Sequence[Any], lift: Lift, drawing: Construction) -> Any:
    return _rate(marks, drawing.turned) * lift(drawing.tempo.unit)


def _turning_faster(marks: Sequence[Any], lift: Lift, drawing: Construction) -> Any:
    unit = lift(drawing.tempo.unit)
    return _rate(marks, False) * unit * unit


def _rate(marks: Sequence[Any], turned: bool) -> Any:
    """From the vectors of two points P, R, turned a quarter or not: marks P, R, begin and end of each."""
    P, R, p0, p1, r0, r1 = marks
    u, w = _difference(P, R), _difference(_difference(p0, p1), _difference(r0, r1))
    rate = -(u[0] * w[0] + u[1] * w[1]) if turned else u[0] * w[1] - u[1] * w[0]
    return rate / (u[0] * u[0] + u[1] * u[1])


def _force(marks: Sequence[Any], lift: Lift, drawing: Construction) -> Any:
    (x, y), phi = _difference(*marks), lift(drawing.phi)
    return x / phi, y / phi


def _moment(marks: Sequence[Any], lift: Lift, drawing: Construction) -> Any:
    """Of forces, each by its point, tail and head, about the first mark."""
    pole, *rest = marks
    phi, long = lift(drawing.phi), lift(metre(drawing.scene.units))
    total = 0 * phi
    for C, tail, head in zip(*[iter(rest)] * 3, strict=True):
        arm, force = _difference(pole, C), _difference(tail, head)
        total = total + (arm[0] * force[1] - arm[1] * force[0])
    return total / phi / long


def _length(marks: Sequence[Any], lift: Lift, drawing: Construction) -> Any:
    """From the slide's point to where its reaction acts, in the scene's lengths."""
    return _difference(*marks)


READERS: dict[Dimension, Callable[[Sequence[Any], Lift, Construction], Any]] = {
    SPEED: _speed, ACCELERATING: _acceleration, TURNING: _turning, TURNING_FASTER: _turning_faster,
    FORCE: _force, MOMENT: _moment, LENGTH: _length,
}  # fmt: skip


def prescribed(reading: Reading, marks: Sequence[Any], domain: Domain) -> Any:
    """What the scene prescribes, as it is given: a number, a vector, or along a guide a rate."""
    given = reading.given
    if isinstance(given, tuple):
        return tuple(map(domain.lift, given))
    if not reading.kind.pair:
        return domain.lift(given)
    if not given:
        return domain.lift(0), domain.lift(0)
    a, b, _ = marks[0]
    rate = domain.lift(given) / domain.sqrt(a * a + b * b, "not-rational", "a rate along this line is irrational")
    return rate * b, -rate * a
