"""A recorded construction: its program, what is read from the marks that are wanted, and results by kind and name."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from graphplan.errors import Undrawable
from graphplan.kernel.elementary import dot, meet, vector_size
from graphplan.kernel.numbers import Domain
from graphplan.kernel.passes import Drawing
from graphplan.kernel.program import Step, about_origin, error_at
from graphplan.mechanism import units
from graphplan.mechanism.model import Number, Pair, Scene
from graphplan.methods.design import Design
from graphplan.methods.kinds import ResultKind, kind_of
from graphplan.methods.motion.network import Network
from graphplan.methods.motion.time_scale import Tempo
from graphplan.phrases import Said

ROW_PADDING = 40  # numbers: some hundreds of bytes


class Reading(NamedTuple):
    """Result that is read from the program: its kind, its object, and its wanted marks (by position).

    `excess` is added to a turning that is read off another link: what drives prescribe beside that. `given` is what
    the scene prescribes, for a slide along the guide, its first mark; then the marks only show it.
    """

    kind: ResultKind
    of: str
    marks: tuple[int, ...]
    excess: Number = 0
    given: Number | Pair | None = None


@dataclass(frozen=True, eq=False, repr=False)
class ReadableDrawing(Drawing):
    """The drawing of a scene, and what is read from it.

    Its program holds compounds, each with the value rule that is good in every pose. The drawn velocities are `turned`
    a quarter or not. Where two points that are `relied` on lie apart, the program holds no more. In a pose that is
    singular in part `whole` is the scene with the links that are not known, and `missing` says what is not drawn.
    """

    scene: Scene
    design: Design
    readings: tuple[Reading, ...]
    turned: bool
    relied: tuple[tuple[str, str], ...] = ()
    whole: Scene | None = None
    missing: tuple[Said, ...] = ()

    @property
    def tempo(self) -> Tempo:
        """Scale of rates: the angular velocity, in rad/s, that is drawn as one."""
        return self.design.tempo

    @property
    def phi(self) -> Number:
        """Drawn length of a unit of force."""
        return self.design.phi or 1

    @property
    def mechanism(self) -> Scene:
        """The whole mechanism, with the links that cannot be drawn."""
        return self.whole or self.scene

    @property
    def coincident_points(self) -> dict[str, str]:
        """The points that lie where another one does, each with that one."""
        return Network(self.scene).shared_marks

    def read(self, domain: Domain, given: Mapping[Any, Mapping[str, Any]] | None = None,
             after: Callable[[Step], None] | None = None) -> dict[str, dict[str, Any]]:
        """All readings in a number domain, by kind and name: pairs (x, y), or single numbers for links.

        `given` overrides numbers of steps, by name or index: such as the coordinates of points; `after` is called
        after each step.
        """
        return self.results_about_origin(about_origin(self.program, domain, given, after), domain)

    def results_about_origin(self, values: Sequence[Any], domain: Domain) -> dict[str, dict[str, Any]]:
        """All readings from the value of every step about the program's origin."""
        origin = self.program.origin
        results = self.results_from_marks([values[index] for index in self.program.wanted], domain)
        return results if origin is None else {
            kind: {of: origin.point(domain, at) if kind_of(kind).dimension == units.PLACE else at
                   for of, at in named.items()} for kind, named in results.items()}

    def results_from_marks(self, wanted: Sequence[Any], domain: Domain) -> dict[str, dict[str, Any]]:
        """All readings from the values of the wanted marks, by kind and name; what is prescribed as it is given."""
        def value(reading: Reading) -> Any:
            marks = [wanted[position] for position in reading.marks]
            return (self.value if reading.given is None else prescribed_value)(reading, marks, domain)

        return self._by_kind_and_name(value)

    def _by_kind_and_name(self, value: Callable[[Reading], Any]) -> dict[str, dict[str, Any]]:
        """Something for each reading, by kind and name."""
        results: dict[str, dict[str, Any]] = {}
        for reading in self.readings:
            results.setdefault(reading.kind, {})[reading.of] = value(reading)
        return results

    def value(self, reading: Reading, marks: Sequence[Any], domain: Domain) -> Any:
        """Value of marks, if there are any: a rate in the scene's lengths and seconds, or a force in its units."""
        if not marks:
            return prescribed_value(reading, marks, domain)
        try:
            value = READERS[reading.kind.dimension](marks, domain, self)
        except Undrawable as fault:
            step = self.program.steps[self.program.wanted[reading.marks[-1]]]
            raise error_at(self.program, step, fault) from None
        return value + domain.lift(reading.excess) if reading.excess else value

    @property
    def kinds(self) -> tuple[str, ...]:
        """The kinds of readings that there are."""
        return tuple(dict.fromkeys(reading.kind for reading in self.readings))

    def empty_arrays(self, n: int, value: float | None = math.nan) -> dict[str, dict[str, Any]]:
        """Arrays for the readings in n poses, by kind and name, complex ones for vectors; with None as they come.

        All are rows of one array: a large piece of memory is handed out faster than many small ones. Rows are a little
        longer than they need be, lest the same pose of all of them share one place in a cache.
        """
        import numpy as np

        single = sum(reading.kind.single for reading in self.readings)
        numbers, vectors = (np.empty((rows, n + ROW_PADDING), kind)[:, :n]
                            for rows, kind in ((single, float), (len(self.readings) - single, complex)))
        if value is not None:
            numbers[:], vectors[:] = value, complex(value, value)
        rows = {True: iter(numbers), False: iter(vectors)}
        return self._by_kind_and_name(lambda reading: next(rows[bool(reading.kind.single)]))


def components(value: Any) -> tuple[Any, ...]:
    """The numbers of a vector, or a number alone."""
    return value if isinstance(value, tuple) else (value,)


def _difference(one: Any, two: Any) -> Any:
    return two[0] - one[0], two[1] - one[1]


def _speed(marks: Sequence[Any], domain: Domain, drawing: ReadableDrawing) -> Any:
    (x, y), unit = _difference(*marks[-2:]), domain.lift(drawing.tempo.unit)
    return (y * unit, -x * unit) if drawing.turned else (x * unit, y * unit)


def _acceleration(marks: Sequence[Any], domain: Domain, drawing: ReadableDrawing) -> Any:
    (x, y), unit = _difference(*marks[-2:]), domain.lift(drawing.tempo.unit)
    return x * unit * unit, y * unit * unit


def _turning(marks: Sequence[Any], domain: Domain, drawing: ReadableDrawing) -> Any:
    return _rate(marks, drawing.turned) * domain.lift(drawing.tempo.unit)


def _turning_faster(marks: Sequence[Any], domain: Domain, drawing: ReadableDrawing) -> Any:
    unit = domain.lift(drawing.tempo.unit)
    return _rate(marks, False) * unit * unit


def _rate(marks: Sequence[Any], turned: bool) -> Any:
    """From the vectors of two points P, R, turned a quarter or not: marks P, R, begin and end of each."""
    P, R, p0, p1, r0, r1 = marks
    u, w = _difference(P, R), _difference(_difference(p0, p1), _difference(r0, r1))
    rate = -(u[0] * w[0] + u[1] * w[1]) if turned else u[0] * w[1] - u[1] * w[0]
    return rate / (u[0] * u[0] + u[1] * u[1])


def _force(marks: Sequence[Any], domain: Domain, drawing: ReadableDrawing) -> Any:
    (x, y), phi = _difference(*marks), domain.lift(drawing.phi)
    return x / phi, y / phi


def _moment(marks: Sequence[Any], domain: Domain, drawing: ReadableDrawing) -> Any:
    """Of forces, each by its point, tail and head, about the first mark."""
    pole, *vectors = marks
    phi, long = domain.lift(drawing.phi), domain.lift(units.metre(drawing.scene.units))
    total = 0 * phi
    for C, tail, head in zip(*[iter(vectors)] * 3, strict=True):
        arm, force = _difference(pole, C), _difference(tail, head)
        total = total + (arm[0] * force[1] - arm[1] * force[0])
    return total / phi / long


def _length(marks: Sequence[Any], domain: Domain, drawing: ReadableDrawing) -> Any:
    """From the slide's point to where its reaction acts, in the scene's lengths."""
    return _difference(*marks)


def _place(marks: Sequence[Any], domain: Domain, drawing: ReadableDrawing) -> Any:
    """Place of the last marked point, or of the crossing of two lines that is not marked."""
    return marks[-1] if len(marks[-1]) == 2 else meet(domain, *marks)


def _heading(marks: Sequence[Any], domain: Domain, drawing: ReadableDrawing) -> Any:
    """Direction of a line, to the right, or straight upwards, in a size of one by both its numbers together."""
    x, y = marks[0][1], -marks[0][0]
    scale = abs(x) + abs(y)
    right, up = domain.sign(x, scale), domain.sign(y, scale)
    sense = (right + (1 - abs(right)) * up) / scale
    return x * sense, y * sense


def _curving(marks: Sequence[Any], domain: Domain, drawing: ReadableDrawing) -> Any:
    """The vector n/rho of a path, from the pole, the point and the inflection pole by Euler and Savary, or from the
    point, begin and end of its velocity and of its acceleration."""
    if len(marks) == 3:
        P, M, W = marks
        ray = _difference(M, P)
        square, component = dot(ray, ray), dot(ray, _difference(M, W))
        return ray[0] * component / square / square, ray[1] * component / square / square
    velocity, acceleration = _difference(*marks[1:3]), _difference(*marks[3:])
    domain.nonzero(vector_size(velocity), vector_size(marks[1]) + vector_size(marks[2]), "points-coincide",
                   "the point rests, so its path has no curvature")
    x, y = velocity if drawing.turned else (-velocity[1], velocity[0])
    square, component = x * x + y * y, dot((x, y), acceleration)
    return x * component / square / square, y * component / square / square


READERS: dict[units.Dimension, Callable[[Sequence[Any], Domain, ReadableDrawing], Any]] = {
    units.SPEED: _speed, units.ACCELERATING: _acceleration, units.TURNING: _turning,
    units.TURNING_FASTER: _turning_faster, units.FORCE: _force, units.MOMENT: _moment, units.LENGTH: _length,
    units.PLACE: _place, units.HEADING: _heading, units.CURVING: _curving,
}  # fmt: skip


def prescribed_value(reading: Reading, marks: Sequence[Any], domain: Domain) -> Any:
    """Value that the scene prescribes, as given: a number, a vector, or along a guide a rate."""
    value = reading.given
    if isinstance(value, tuple):
        return tuple(map(domain.lift, value))
    if not reading.kind.pair:
        return domain.lift(value)
    if not value:
        return domain.lift(0), domain.lift(0)
    a, b, _ = marks[0]
    rate = domain.lift(value) / domain.sqrt(a * a + b * b, "not-rational", "a rate along this line is irrational")
    return rate * b, -rate * a
