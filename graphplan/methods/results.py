"""Results: what a construction gives, by name, and the controls of what was drawn.

The lines from a link's points to the ends of their orthogonal velocities meet in its pole. Where no pole was marked two
of them show it, and the others must pass through it (N. Rosenauer, Acta Universitatis Latviensis, Mech. II, No. 14
(1939), step 6; No. 16).
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations
from typing import Any, Generic, NamedTuple, TypeVar

from graphplan.kernel.kinds import POINT
from graphplan.kernel.program import Program
from graphplan.mechanism.model import FRAME, NamedValues, Scene
from graphplan.mechanism.units import Units
from graphplan.methods import kinds
from graphplan.methods.kinds import ResultKind, kind_of
from graphplan.methods.panels import MECHANISM, JointForce, pair_letter, pole_named, reactions_named, strand_letters
from graphplan.methods.tolerances import CONTROL_TOL


class Fact(NamedTuple):
    """A result in the scene's units: of which kind, of what, and its value, a number or a vector (x, y); over poses an
    array, of vectors a complex one. `compared` are its numbers beside the solver's, where these are known; `prefix`
    tells its columns from those of the same dimension that are of the same thing."""

    kind: ResultKind
    of: str
    value: Any
    compared: tuple[Any, ...] = ()
    prefix: str = ""

    @property
    def name(self) -> str:
        """Name in files, such as velocity A."""
        return f"{self.kind} {self.of}"

    def unit(self, units: Units) -> str:
        """Unit, as in files."""
        return self.kind.dimension.unit(units)

    @property
    def axes(self) -> dict[str, Any]:
        """Numbers of the result: x and y of a vector, a single one with an empty name."""
        return axes(self.value)

    @property
    def columns(self) -> dict[str, Any]:
        """Numbers of the result under headings of tables, such as A.vx, A.vy and 3.omega."""
        heading = f"{self.prefix} {self.of}.{self.kind.dimension.letter}".strip()
        return {heading + axis: number for axis, number in self.axes.items()}

    @property
    def truth(self) -> Any:
        """The solver's value."""
        truths = tuple([number.truth for number in self.compared])
        return truths if isinstance(self.value, tuple) else truths[0]


def facts(results: Mapping[str, Mapping[str, Any]],
          compared: Mapping[str, Mapping[str, tuple[Any, ...]]] | None = None) -> list[Fact]:
    """Results by kind and name as a list."""
    return [Fact(kind_of(kind), of, value, (compared or {}).get(kind, {}).get(of, ()), _prefix(kind, of, results))
            for kind, named in results.items() for of, value in named.items()]


def _prefix(kind: str, of: str, results: Mapping[str, Mapping[str, Any]]) -> str:
    """The words that tell columns of one name apart: the way of a balance, a screw, or a result without friction."""
    if kind == kinds.SCREW:
        return "screw"
    return "without friction" if of in results.get(kinds.WITH_FRICTION.get(kind, ""), {}) else kind_of(kind).way


def axes(value: Any) -> dict[str, Any]:
    """The numbers of a vector by its axes x and y; a number, or an array of numbers, under no name."""
    if isinstance(value, tuple):
        return dict(zip("xy", value, strict=True))
    is_vector = getattr(value, "dtype", None) is not None and value.dtype.kind == "c"
    return {"x": value.real, "y": value.imag} if is_vector else {"": value}


def thing_named(scene: Scene, kind: ResultKind, of: str) -> str:
    """Object of a result, in words: a slide, a link at a joint, two links, else a point or link by name."""
    return reactions_named(scene)[of] if kind.pair else pole_named(scene, of) if kind.group == kinds.POLES else of


class PairForce(NamedTuple):
    """The force in a pair by its name in results: on which link, by which, at which point where that is one, and its
    letter. `pair` is what scenes ask for it by, `sort` the key of the pair in JSON."""

    sort: str
    pair: str
    name: str
    on: str
    by: str
    point: str
    letter: str

    @property
    def data(self) -> dict[str, str]:
        """Points and links of the force, in JSON."""
        return {self.sort: self.pair if self.sort == "at" else self.name, "on": self.on, "from": self.by}


def pair_forces(scene: Scene) -> Iterator[PairForce]:
    """The force in each pair: in joints on every link but that which carries the pin, by that; else on the first."""
    for joint in scene.revolutes:
        pin, *links = joint.links
        for link in links:
            yield PairForce("at", joint.at, JointForce(joint.at, link).name, link, pin, joint.at,
                            pair_letter(pin, link))
    for slide in scene.slides:
        yield PairForce("slide", slide.name, slide.name, slide.link, slide.along, slide.at,
                        pair_letter(slide.along, slide.link))
    for gear in scene.gears:
        for strand, letter in strand_letters(gear).items():
            yield PairForce("strand", gear.name, strand, *gear.links, "", letter)
    for gear in scene.gears:
        yield PairForce("gear", gear.name, gear.name, *gear.links, "", pair_letter(*gear.links[::-1]))
    for contact in scene.contacts:
        yield PairForce("contact", contact.name, contact.name, *contact.links, contact.at,
                        pair_letter(*contact.links[::-1]))


def balances(scene: Scene, results: Mapping[str, Mapping[str, Any]],
             ways: Sequence[str] = (kinds.BY_PLANS, kinds.BY_LEVER)) -> dict[str, Any]:
    """The balances among results, by name in the scene's order: each in the first of these ways that gives it."""
    found: dict[str, Any] = {}
    for name, balance in scene.loads.named_balances.items() if scene.loads else ():
        values = [results[kind][name] for kind in (kinds.balance_kind(way, balance) for way in ways)
                  if name in results.get(kind, {})]
        found |= {name: values[0]} if values else {}
    return found


def forces(scene: Scene, results: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Return the forces among results by name: reactions such as `2 at B`, and balances such as `balance 2`; those with
    friction where there is any."""
    kinds_of_forces = [also for kind in kinds.REACTIONS for also in (kind, kinds.WITH_FRICTION[kind])]
    reactions = {name: force for kind in kinds_of_forces for name, force in results.get(kind, {}).items()}
    by_balance = balances(scene, results, (kinds.RUBBED, kinds.BY_PLANS, kinds.BY_LEVER))
    return reactions | {f"balance {name}": force for name, force in by_balance.items()
                        if scene.loads and scene.loads.named_balances[name].at}


V = TypeVar("V")
N = TypeVar("N")


class NamedResults(ABC, Generic[V, N]):
    """Results of one pose or of many, all in scene units: complex numbers or arrays of them for vectors."""

    scene: Scene

    @abstractmethod
    def results_of_kind(self, kind: str) -> dict[str, Any]:
        """The results of a kind."""

    def _zero(self) -> Any:
        """The vector of a fixed point."""
        return 0j

    @property
    def velocity(self) -> NamedValues[V]:
        """Velocities of points by name, complex, in scene lengths/s; 0 for a fixed point."""
        return self._vectors(kinds.VELOCITY)

    @property
    def acceleration(self) -> NamedValues[V]:
        """Accelerations of points by name, complex, in scene lengths/s^2; 0 for a fixed point."""
        return self._vectors(kinds.ACCELERATION)

    def _vectors(self, kind: str) -> NamedValues[V]:
        return NamedValues(self.results_of_kind(kind), kind, self.scene.links.get(FRAME, ()), self._zero())

    @property
    def sliding_velocity(self) -> NamedValues[V]:
        """Velocities of sliding points relative to their guides, in scene lengths/s, by slide, such as `3 along 2`."""
        return NamedValues(self.results_of_kind(kinds.SLIDE_VELOCITY), "sliding velocity")

    @property
    def sliding_acceleration(self) -> NamedValues[V]:
        """Accelerations of sliding points relative to their guides, in scene lengths/s^2, by slide."""
        return NamedValues(self.results_of_kind(kinds.SLIDE_ACCELERATION), "sliding acceleration")

    @property
    def poles(self) -> NamedValues[V]:
        """Instant centres, such as `2 frame`, complex, in scene lengths; at infinity nan, or left out if drawn."""
        return NamedValues(self.results_of_kind(kinds.POLE), "pole")

    @property
    def curvature(self) -> NamedValues[V]:
        """Centres of curvature of paths, such as that of `M on 2`, complex, in scene lengths; at infinity nan, or left
        out if drawn."""
        return NamedValues(self.results_of_kind(kinds.CENTRE), "centre of curvature")

    @property
    def omega(self) -> NamedValues[N]:
        """The angular velocities of links in rad/s, counter-clockwise positive."""
        return NamedValues(self.results_of_kind(kinds.OMEGA), "angular velocity", {FRAME}, 0.0)

    @property
    def alpha(self) -> NamedValues[N]:
        """The angular accelerations of links in rad/s^2."""
        return NamedValues(self.results_of_kind(kinds.ALPHA), "angular acceleration", {FRAME}, 0.0)

    @property
    def reactions(self) -> NamedValues[V]:
        """Reactions, complex, in the scene's unit of force: on links at joints, such as `2 at B`, of slides, gears and
        contacts; with friction where they are drawn with it."""
        of_forces = *kinds.REACTIONS, *kinds.WITH_FRICTION.values()
        results = {str(kind): self.results_of_kind(kind) for kind in of_forces}
        return NamedValues(forces(self.scene, results), "reaction")

    @property
    def balances(self) -> list[Any]:
        """The balances in the scene's order, with friction where they are drawn with it, by force plans or else by the
        lever: moments in force * m, forces as complex numbers."""
        results = {kind: self.results_of_kind(kind) for kind in kinds.KINDS}
        return [*balances(self.scene, results, (kinds.RUBBED, kinds.BY_PLANS, kinds.BY_LEVER)).values()]


SHARP = 0.2  # the sine under which two lines cross well enough to show a pole
Line = tuple[Any, Any, Any]


class Control(NamedTuple):
    """Three points of a link, and as marks of the drawn program each of them with the end of its orthogonal velocity.

    The first two lines cross in the pole of the link, through which the third must pass.
    """

    link: str
    points: tuple[str, ...]
    marks: tuple[tuple[int, int], ...]

    def drawn_deviation(self, values: Sequence[Any]) -> Any:
        """Distance of the drawn pole from the third line, times the length of its drawn velocity."""
        return _crossing_deviation(*(_line_through(values[start], values[end]) for start, end in self.marks))

    def true_deviation(self, points: Mapping[str, Any], velocities: Mapping[str, Any]) -> Any:
        """Distance of the pole by true velocities, each perpendicular to the line through its point."""
        lines = [(v[0], v[1], -v[0] * x - v[1] * y) for name in self.points
                 for v, (x, y) in [(velocities[name], points[name])]]
        return _crossing_deviation(*lines)


def controls(scene: Scene, program: Program, values: Sequence[Any], ends: Mapping[str, tuple[int, int]],
             shown: Callable[[tuple[float, float]], bool]) -> Iterator[Control]:
    """The controls of a drawn program: those whose pole counts as `shown` on the sheet and is not marked there.

    `ends` are the marks of points with the ends of their orthogonal velocities.
    """
    size = float(scene.extent)
    marks = sorted(values[step.index] for step in program.steps if step.op.gives == POINT and step.panel == MECHANISM)
    for link in scene.moving:
        drawn = {ends[name]: name for name in scene.links[link] if name in ends}
        lines = {(start, end): _line_through(values[start], values[end]) for start, end in drawn
                 if math.dist(values[start], values[end]) > CONTROL_TOL * size}
        pair = max(combinations(lines, 2), key=lambda two: _sine(*map(lines.__getitem__, two)), default=None)
        if pair is None or _sine(*(lines[one] for one in pair)) < SHARP:
            continue
        pole = _meet(*(lines[one] for one in pair))
        if shown(pole) and not _is_marked(pole, marks, CONTROL_TOL * size):
            for other in lines:
                if other not in pair:
                    three = (*pair, other)
                    yield Control(link, tuple(drawn[one] for one in three), three)


def _is_marked(place: tuple[float, float], marks: Sequence[tuple[float, float]], gap: float) -> bool:
    """Whether one of the marks, which are sorted, is no further from a place than a gap."""
    x, _ = place
    first, last = bisect_left(marks, (x - gap,)), bisect_right(marks, (x + gap, math.inf))
    return any(math.dist(place, mark) <= gap for mark in marks[first:last])


def _line_through(P: Any, Q: Any) -> Line:
    """The line through two points."""
    return P[1] - Q[1], Q[0] - P[0], P[0] * Q[1] - Q[0] * P[1]


def _meet(one: Line, two: Line) -> tuple[float, float]:
    (a, b, c), (d, e, f) = one, two
    return (b * f - e * c) / (a * e - b * d), (d * c - a * f) / (a * e - b * d)


def _sine(one: Line, two: Line) -> float:
    (a, b, _), (d, e, _) = one, two
    return float(abs(a * e - b * d) / math.hypot(a, b) / math.hypot(d, e))


def _crossing_deviation(one: Line, two: Line, three: Line) -> Any:
    """Distance of the crossing of two lines from a third, times the length of its normal; zero if the three meet."""
    (a, b, c), (d, e, f), (g, h, i) = one, two, three
    return (g * (b * f - e * c) + h * (d * c - a * f)) / (a * e - b * d) + i
