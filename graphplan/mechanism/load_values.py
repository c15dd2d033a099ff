"""Loads that change, in the scene's own pose: springs as they are stretched, tables where the drive stands.

A spring is a pair of opposite forces over the distance of its ends, so all that reads loads that change reads springs.

A load over a slide's position hangs on the stroke, so the velocities in the pose are needed, and at a dead point of the
slide the accelerations: the stroke is that into which the drive leads. They are solved from what the pairs state, in
fractions where the scene is rational.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from importlib import import_module
from typing import Any

from graphplan.errors import Refused
from graphplan.mechanism.equations import Elimination
from graphplan.mechanism.fields import (
    AMOUNT,
    DISTANCE,
    POINT,
    TWO_LINKS,
    Field,
    Kind,
    Rows,
    SceneItem,
    SceneNames,
    Table,
    TableRow,
    describe,
)
from graphplan.mechanism.loads import SPEED, STROKE_OF, LoadTable
from graphplan.mechanism.model import FRAME, Force, Moment, Number, Scene, Slide
from graphplan.mechanism.numbers import Pair, dot, exactly, is_exact, minus, root, times
from graphplan.mechanism.pairs.pair import Along, PairSide, PairSides, Rate, Statement
from graphplan.mechanism.tolerances import DEAD_POINT_TOL
from graphplan.mechanism.travel import sense_of_travel


@dataclass(frozen=True)
class Spring:
    """A spring: its ends, the links that they are points of, its stiffness (force / length), its length without force.

    The first end is on a link that moves.
    """

    ends: tuple[str, str]
    links: tuple[str, str]
    stiffness: Number
    free: Number
    where: str = ""

    @property
    def law(self) -> LoadTable:
        """The pull of a spring by the distance l of its ends: c (l - l_0), as powers -c l_0 and c."""
        name = "distance of {} and {}".format(*self.ends)
        return LoadTable(name, powers=(-self.stiffness * self.free, self.stiffness), where=self.where, span=self.ends)


def spring_forces(springs: Iterable[Spring]) -> Iterator[Force]:
    """Yield the forces of springs on moving links: each end is pulled towards the other."""
    for spring in springs:
        for (near, far), link in zip((spring.ends, spring.ends[::-1]), spring.links, strict=True):
            if link != FRAME:
                yield Force(link, near, (Fraction(0), Fraction(0)), spring.law, (Fraction(1), Fraction(0)), (near, far))


def spring_laws(forces: Iterable[Force]) -> Iterator[LoadTable]:
    """The laws of the springs among these forces, each spring once."""
    return (force.table for force in forces if force.table and force.table.span and force.at == force.table.span[0])


def spring_numbers(law: LoadTable) -> tuple[Number, Number]:
    """The stiffness and the length without force of a spring with this law."""
    constant, stiffness = law.powers
    return stiffness, -constant / stiffness


def _read_ends(item: SceneItem, names: SceneNames) -> tuple[str | None, ...] | None:
    if not isinstance(item.value, list) or len(item.value) != 2:
        return item.fault(f"{describe(item.value)} where two points are wanted", 'two points such as ["A", "F"]')
    return tuple(POINT.read(item.with_value(name), names) for name in item.value)


def _spring(row: TableRow) -> Spring | None:
    """A spring, its links named where its ends leave a choice."""
    ends, item, names = row["ends"], row.items["ends"], row.names
    if None in ends:
        return None
    if ends[0] == ends[1]:
        return item.fault("both ends are one point", "two points of different links")
    links = row.values.get("on") or tuple(_only_link(item, end, ends, names) for end in ends)
    if None in links:
        return None
    for end, link in zip(ends, links, strict=True):
        if end not in names.links.get(link, ()):
            return item.fault(f"{end} is not a point of link {link}", "on with a link that has the point")
    if links[0] == links[1]:
        return item.fault(f"both ends are on link {links[0]}, so its length never changes", "points of different links")
    order = slice(None, None, -1 if links[0] == FRAME else 1)
    return Spring(ends[order], links[order], row["stiffness"], row["free"], row.item.where)


def _only_link(item: SceneItem, end: str, ends: Iterable[str], names: SceneNames) -> str | None:
    """Return the only link that has a point; a fault if several links or no link have it."""
    links = [link for link, points in names.links.items() if end in points]
    if len(links) == 1 or not item.faults.none_in("links"):
        return links[0] if links else None
    if not links:
        return item.fault(f"no link has the point {end}", "points of links")
    on = ", ".join(f'"{next((link for link, points in names.links.items() if name in points), FRAME)}"'
                   for name in ends)
    problem = f"{end} is on several links: {', '.join(links)}"
    return item.fault(problem, f"the links of the two ends, such as on = [{on}]")


TWO_POINTS = Kind("two points", _read_ends, {"type": "array", "items": POINT.schema, "minItems": 2, "maxItems": 2})
STIFFNESS = Kind("number above 0", lambda item, names: item.positive("stiffness"), DISTANCE.schema)
SPRINGS = Rows(Table("a spring", (
    Field("ends", "its two ends, points of different links",
          TWO_POINTS,
          'its two ends, such as ends = ["A", "F"]'),
    Field("on", "the links that the ends are on, where a point is on several", TWO_LINKS),
    Field("stiffness", "its stiffness, force / length", STIFFNESS, "its stiffness, such as stiffness = 2.5"),
    Field("free", "its length without force", AMOUNT, "its length without force, such as free = 80"),
), _spring))


FOLLOWER = "graphplan.cycle.swings"  # follows mechanisms to end positions: by its name, as it imports scenes itself
IRRATIONAL = "{}: its value in this pose"  # of a table whose value fractions do not hold


def guide_origin(scene: Scene, slide: Slide) -> str:
    """The point from which a slide's position is measured along its guide; empty for the scene's origin.

    The first of the points that give the guide, else, of a guide that rides on a link, the first of the link.
    """
    if slide.through:
        return slide.through[0]
    return "" if slide.along == FRAME else next(iter(scene.links[slide.along]), "")


def filled_in(scene: Scene, travel: Number = Fraction(0)) -> Scene:
    """The scene with the values that its loads have in its pose, where the first drive has gone so far.

    Fails with `Refused` where a force has no direction in the pose.
    """
    loads = scene.loads
    every: tuple[Force | Moment, ...] = (*loads.forces, *loads.moments) if loads else ()
    if loads is None or not any(load.table for load in every):
        return scene
    pose, irrational = OwnPose(scene, Fraction(travel)), list(scene.irrational)

    def value(load: Force | Moment) -> Any:
        table = load.table
        if table is None:
            return load
        size, exact = pose.value(table)
        if isinstance(load, Force):
            assert load.direction is not None
            ends = [scene.points[point] for point in load.through or ()]
            direction = minus(ends[1], ends[0]) if ends else load.direction
            length, rational = _length(direction)
            if not length:
                raise Refused(table.where, "{} and {} lie together here, so the force has no direction".format(
                    *(load.through or ("its points",) * 2)), "another pose")
            exact = exact and rational and is_exact(direction)
            x, y = times(size / length, exactly(direction))
            filled: Any = replace(load, value=(x, y) if exact else (float(x), float(y)), direction=direction)
        else:
            filled = replace(load, value=size if exact else float(size))
        if not exact:
            irrational.append(IRRATIONAL.format(table.where))
        return filled

    forces, moments = tuple(map(value, loads.forces)), tuple(map(value, loads.moments))
    return replace(scene, loads=replace(loads, forces=forces, moments=moments), irrational=tuple(irrational))


def with_strokes(scene: Scene) -> Scene:
    """The scene with its tables over strokes laid out between the end positions of their slides.

    Fails with `Refused` where the mechanism or a slide does not move.
    """
    loads, slides = scene.loads, {slide.name: slide for slide in scene.slides}
    irrational = list(scene.irrational)

    def lay_out(load: Any) -> Any:
        table = load.table
        if table is None or not table.over.startswith(STROKE_OF):
            return load
        irrational.append(f"{table.where}: the end positions of {table.slide}")
        ends = import_module(FOLLOWER).slide_ends(replace(scene, loads=None), slides[table.slide])
        return replace(load, table=table.lay_out(*map(Fraction, ends)))

    if loads is None:
        return scene
    forces, moments = tuple(map(lay_out, loads.forces)), tuple(map(lay_out, loads.moments))
    return replace(scene, loads=replace(loads, forces=forces, moments=moments), irrational=tuple(irrational))


def with_moving_drives(scene: Scene) -> Scene:
    """The scene with drives that move: where all stand still the first one as it speeds up, or forwards."""
    if any(drive.rate for drive in scene.drives) or not scene.drives:
        return scene
    first, *rest_of_drives = scene.drives
    return scene.with_drives((first.driven_at(Fraction(-1 if first.change < 0 else 1), Fraction(0)), *rest_of_drives))


def onward(scene: Scene) -> int:
    """Whether the drives move on as their travel counts, 1, or begin to move back from rest, -1."""
    return sense_of_travel(with_moving_drives(scene)) * sense_of_travel(scene)


@dataclass(frozen=True)
class OwnPose:
    """A scene in its pose, in fractions, where the first drive has gone so far from the given one."""

    scene: Scene
    travel: Fraction

    def value(self, table: LoadTable) -> tuple[Fraction, bool]:
        """The load of a table in this pose, and whether it is exact."""
        if table.over == SPEED:
            first = self.scene.drives[0] if self.scene.drives else None
            rate = first.rate if first else Fraction(0)
            return Fraction(table.value(abs(Fraction(rate)))), isinstance(rate, Fraction)
        if table.span:
            A, B = (self.scene.points[point] for point in table.span)
            distance, rational = _length(minus(B, A))
            return Fraction(table.value(distance)), rational and is_exact(A, B)
        if not table.slide:
            return Fraction(table.value(self.travel)), True
        slide = next(slide for slide in self.scene.slides if slide.name == table.slide)
        length, rational = _length(slide.direction)
        if table.over_speed:
            speed = self._rates(self.scene)[0].get(slide.name, Fraction(0))
            return Fraction(table.value(speed / length)), rational and self.exact
        origin = guide_origin(self.scene, slide)
        ends = [exactly(self.scene.points[point]) for point in ((slide.at, origin) if origin else (slide.at,))]
        away = minus(*ends) if origin else ends[0]
        place = Fraction(dot(away, exactly(slide.direction))) / length
        exact = rational and is_exact(slide.direction, *(self.scene.points[p] for p in (slide.at, origin) if p))
        stroke = self._stroke(slide, table)
        value = Fraction(table.value(place, stroke))
        return value, exact or table.level(place, stroke)

    @property
    def exact(self) -> bool:
        """Whether its rates are fractions."""
        rates = [drive.rates for drive in self.scene.drives]
        return not self.scene.redundant and is_exact(*self.scene.points.values(), *rates)

    def _stroke(self, slide: Slide, table: LoadTable) -> int:
        """The sense in which a slide moves, or at a dead point begins to; that of the first rows where it never does.
        """
        velocities, accelerations = self._moving
        speed, length = velocities.get(slide.name, Fraction(0)), _length(slide.direction)[0]
        fast = max(abs(float(d.rate)) * (1 if d.slides else self.scene.extent)
                   for d in with_moving_drives(self.scene).drives)
        least = DEAD_POINT_TOL * fast * float(length)
        direction = speed if abs(speed) > least else accelerations.get(slide.name, Fraction(0))
        return (1 if direction > 0 else -1) if direction else next(iter(table.strokes))

    @property
    def _moving(self) -> tuple[dict[str, Fraction], dict[str, Fraction]]:
        """The rates of the slides while the drives move, at constant speeds."""
        moving = with_moving_drives(self.scene)
        return self._rates(moving.with_drives(drive.driven_at(drive.rate, Fraction(0)) for drive in moving.drives))

    def _rates(self, scene: Scene) -> tuple[dict[str, Fraction], dict[str, Fraction]]:
        """Velocity and acceleration of each slide along its guide's direction, times its length; empty in a singular
        pose."""
        facts = [fact for pair in scene.pairs for fact in pair.states(scene)]
        columns = {link: 3 * k for k, link in enumerate(scene.moving)}
        solve = _solver([self._row(fact, columns) for fact in facts], 3 * len(columns), bool(scene.redundant))

        def rates(right: list[Fraction]) -> dict[str, Rate] | None:
            values = solve(right)
            return None if values is None else {link: Rate(*values[k : k + 3]) for link, k in columns.items()}

        along = {slide.name: Along(*slide.links, slide.at, exactly(slide.direction), "along") for slide in scene.slides}
        first = rates([_prescribed_rates(fact)[0] for fact in facts])
        if first is None:
            return {}, {}
        second = rates([_prescribed_rates(fact)[1] + Fraction(fact.left_over(self._sides(fact, first)))
                        for fact in facts])
        slips = {name: (self._sides(fact, first), self._sides(fact, second or first)) for name, fact in along.items()}
        return ({name: Fraction(dot(along[name].direction, velocities.slip))
                 for name, (velocities, _) in slips.items()},
                {name: Fraction(dot(along[name].direction, minus(accelerations.slip, velocities.surplus)))
                 for name, (velocities, accelerations) in slips.items() if second})

    def _row(self, fact: Statement, columns: Mapping[str, int]) -> dict[int, Fraction]:
        """The coefficient of each link's rates in a statement."""
        sides = self._sides(fact, {})
        weights = fact.weights((sides.link.arm, sides.on.arm), lambda square: root(Fraction(square))[0])
        return {columns[link] + k: Fraction(weight) for (link, _), rate in zip(fact.ends, weights, strict=True)
                if link in columns for k, weight in enumerate(rate)}

    def _sides(self, fact: Statement, rates: Mapping[str, Rate]) -> PairSides:
        """The two links of a statement, with these rates; a link's base is at the scene's origin."""
        none = Fraction(0)
        return PairSides(*(PairSide(exactly(self.scene.points[point]) if point else (none, none),
                                    rates.get(link, Rate(none, none, none))) for link, point in fact.ends))


def _solver(rows: Sequence[Mapping[int, Fraction]], width: int,
            repeating: bool) -> Callable[[Sequence[Fraction]], Sequence[Fraction] | None]:
    """Return a function that solves the rows for a right-hand side; for repeated rows the shortest solution, in
    floats."""
    if not repeating:
        system = Elimination(rows, width)
        return lambda right: None if system.free else system.solve(right)
    import numpy as np  # few scenes need it

    matrix = np.array([[float(row.get(j, 0)) for j in range(width)] for row in rows])
    return lambda right: [*map(Fraction, np.linalg.lstsq(matrix, np.array(right, float), rcond=None)[0].tolist())]


def _length(direction: Pair) -> tuple[Fraction, bool]:
    """The length of a direction, and whether it is exact."""
    x, y = exactly(direction)
    return root(x * x + y * y)


def _prescribed_rates(fact: Statement) -> tuple[Fraction, Fraction]:
    """The velocity and the acceleration that a statement prescribes, times the length of its direction."""
    length = _length(fact.direction)[0] if isinstance(fact, Along) and fact.way == "along" else 1
    return length * Fraction(fact.rate), length * Fraction(fact.change)
