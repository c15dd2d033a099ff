"""Readings: what a construction gives, of what kind, from which marks it is read, and how it is called."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any, NamedTuple

from graphplan.kernel.numbers import Domain
from graphplan.mechanism.model import Number, Pair, Scene
from graphplan.methods.panels import reactions_named
from graphplan.phrases import Said, phrase

VELOCITY, ACCELERATION = "velocity", "acceleration"
OMEGA, ALPHA = "omega", "alpha"
SLIDE_VELOCITY, SLIDE_ACCELERATION = "slide velocity", "slide acceleration"


class Reading(NamedTuple):
    """What is read from the program: of what kind, of which thing, between which wanted marks (by position).

    `excess` is added to a turning that is read off another link: what drives prescribe beside that. `given` is what
    the scene prescribes, for a slide along the guide, its first mark; then the marks only show it.
    """

    kind: str
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


PAIRS = frozenset({"slide velocity", "slide acceleration", "slide reaction", "slide moment", "slide arm", "reaction"})
KINDS = {
    "velocity": phrase("velocity"), "acceleration": phrase("acceleration"), "omega": phrase("omega"),
    "alpha": phrase("alpha"), "slide velocity": phrase("slide velocity"), "force": phrase("force"),
    "slide acceleration": phrase("slide acceleration"), "reaction": phrase("reaction"),
    "slide reaction": phrase("slide reaction"), "slide moment": phrase("slide moment"),
    "slide arm": phrase("slide arm"), "balance": phrase("balance"), "balance moment": phrase("balance moment"),
    "balance with friction": phrase("balance with friction"),
    "balance moment with friction": phrase("balance moment with friction"), "lever": phrase("lever"),
    "lever moment": phrase("lever moment"), "curves": phrase("curves"),
}  # fmt: skip


def kind_named(kind: str) -> Said:
    """A kind of reading in words."""
    return KINDS[kind]()


def thing_named(scene: Scene, kind: str, of: str) -> str:
    """What a reading of a kind is of, in words: a slide, a link at a joint, else a point or link as it is."""
    return reactions_named(scene)[of] if kind in PAIRS else of


def balances(scene: Scene, results: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """The balances among results, by name in the scene's order: by force plans or else by the lever."""
    kinds = "lever", "lever moment", "balance", "balance moment"
    found = {name: value for kind in kinds for name, value in results.get(kind, {}).items()}
    return {name: found[name] for name in (scene.loads.named_balances if scene.loads else ()) if name in found}


def _difference(one: Any, two: Any) -> Any:
    return two[0] - one[0], two[1] - one[1]


def _read_velocity(marks: Sequence[Any], unit: Any, turned: bool) -> Any:
    x, y = _difference(*marks[-2:])
    return (y * unit, -x * unit) if turned else (x * unit, y * unit)


def _read_acceleration(marks: Sequence[Any], unit: Any, turned: bool) -> Any:
    x, y = _difference(*marks[-2:])
    return x * unit * unit, y * unit * unit


def _read_omega(marks: Sequence[Any], unit: Any, turned: bool) -> Any:
    """From the vectors of two points P, R: marks P, R, begin and end of each."""
    P, R, p0, p1, r0, r1 = marks
    u, w = _difference(P, R), _difference(_difference(p0, p1), _difference(r0, r1))
    if not turned:
        w = -w[1], w[0]
    return -(u[0] * w[0] + u[1] * w[1]) / (u[0] * u[0] + u[1] * u[1]) * unit


def _read_alpha(marks: Sequence[Any], unit: Any, turned: bool) -> Any:
    P, R, p0, p1, r0, r1 = marks
    u, w = _difference(P, R), _difference(_difference(p0, p1), _difference(r0, r1))
    return (u[0] * w[1] - u[1] * w[0]) / (u[0] * u[0] + u[1] * u[1]) * unit * unit


READERS = {  # in the order in which they are told
    VELOCITY: _read_velocity,
    OMEGA: _read_omega,
    SLIDE_VELOCITY: _read_velocity,
    ACCELERATION: _read_acceleration,
    ALPHA: _read_alpha,
    SLIDE_ACCELERATION: _read_acceleration,
}
ORDER = {kind: place for place, kind in enumerate(READERS)}
# What each of them is drawn by: the plan of velocities, or that of accelerations.
PLANS = dict(zip(READERS, (VELOCITY,) * 3 + (ACCELERATION,) * 3, strict=True))


def prescribed(reading: Reading, marks: Sequence[Any], domain: Domain) -> Any:
    """What the scene prescribes, as it is given: a number, a vector, or along a guide a rate."""
    given = reading.given
    if isinstance(given, tuple):
        return tuple(map(domain.lift, given))
    if reading.kind not in (SLIDE_VELOCITY, SLIDE_ACCELERATION):
        return domain.lift(given)
    if not given:
        return domain.lift(0), domain.lift(0)
    a, b, _ = marks[0]
    rate = domain.lift(given) / domain.sqrt(a * a + b * b, "not-rational", "a rate along this line is irrational")
    return rate * b, -rate * a



def _read_force(marks: Sequence[Any], phi: Any, metre: Any) -> Any:
    x, y = _difference(*marks)
    return x / phi, y / phi


def _read_moment(marks: Sequence[Any], phi: Any, metre: Any) -> Any:
    """Of forces, each by its point, tail and head, about the first mark."""
    pole, *rest = marks
    total = 0 * phi
    for C, tail, head in zip(*[iter(rest)] * 3, strict=True):
        arm, force = _difference(pole, C), _difference(tail, head)
        total = total + (arm[0] * force[1] - arm[1] * force[0])
    return total / phi / metre


def _read_arm(marks: Sequence[Any], phi: Any, metre: Any) -> Any:
    """From the slide's point to where its reaction acts, in the scene's lengths."""
    return _difference(*marks)


FORCE_READERS = {
    "reaction": _read_force,
    "slide reaction": _read_force,
    "slide moment": _read_moment,
    "slide arm": _read_arm,
    "balance": _read_force,
    "balance moment": _read_moment,
    "balance with friction": _read_force,
    "balance moment with friction": _read_moment,
    "lever": _read_force,
    "lever moment": _read_moment,
}

# Readings that are one number; the others are vectors.
NUMBERS = frozenset({OMEGA, ALPHA, *(kind for kind in FORCE_READERS if "moment" in kind)})
