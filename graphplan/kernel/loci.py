"""The method of loci: a joint of a group lies where the curves cross that it describes on either side, if it is freed.

On one side that is a circle, where a bar holds it; else the path of a point of a linkage that is driven by one of its
bars: plans of it are drawn in positions near the one that is looked for, and a curve through the places of the joint.
Its value is the crossing of the true paths; the curve through four plans is off that by a known, small vector.

Source: Ozols 1974, section 5-2.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import product
from typing import Any, NamedTuple, Self

from graphplan.errors import Undrawable
from graphplan.kernel.closures import Attitude, Closure, Hinge, PlacedPin, Vector, close_group
from graphplan.kernel.kinds import CIRCLE, COMPASSES, PENCIL, POINT, TABLE, Movement, primitive
from graphplan.kernel.numbers import Floats
from graphplan.kernel.positions import Angle
from graphplan.kernel.primitives import cross, dot
from graphplan.kernel.tolerances import LOCUS_STEP, LOCUS_TOL
from graphplan.phrases import digits, phrase

SPACING = 12.0, 8.0, 4.0, 2.0, 1.0  # degrees between plans, the widest first that serves
NODES = -1.0, 0.0, 1.0, 2.0  # of the parameter, at the plans
FLOATS = Floats()


# ---- a curve through four points ----------------------------------------------------------------------------------


class Curve(str):
    """How a curve is drawn through four points: the parameters where it crosses, and by how much the true path is off
    the cubic through them there; `slopes` make corrections of what misses."""

    at: tuple[float, ...]
    off: tuple[Vector, ...]
    slopes: tuple[tuple[float, ...], ...]

    def __new__(cls, name: str, at: Sequence[float], off: Sequence[Vector], slopes: Sequence[Sequence[float]]) -> Self:
        self = super().__new__(cls, name)
        self.at, self.off, self.slopes = tuple(at), tuple(off), tuple(map(tuple, slopes))
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return Curve, (str(self), self.at, self.off, self.slopes)


def cubic_point(d: Any, plans: Sequence[Any], u: Any) -> Vector:
    """The place at a parameter on the cubic through four points."""
    weights = []
    for k, node in enumerate(NODES):
        weight = d.lift(1)
        for other in NODES[:k] + NODES[k + 1:]:
            weight = weight * (u - d.lift(other)) / d.lift(node - other)
        weights.append(weight)
    return (sum((w * P[0] for w, P in zip(weights, plans, strict=True)), d.lift(0)),
            sum((w * P[1] for w, P in zip(weights, plans, strict=True)), d.lift(0)))


def cubic_direction(plans: Sequence[Any], u: float) -> Vector:
    """How the cubic runs there."""
    (x, y), (v, w) = (cubic_point(FLOATS, plans, u + off) for off in (-LOCUS_STEP, LOCUS_STEP))
    return (v - x) / (2 * LOCUS_STEP), (w - y) / (2 * LOCUS_STEP)


@primitive((POINT, POINT, POINT, POINT, CIRCLE), POINT, PENCIL,
           "Draw {curve} through {0}, {1}, {2} and {3}: it meets {4} in {out}.", claims=(("on", 4), ("fair", 0)),
           params=("curve",), movement=Movement.TRACED)
def curve_meets_circle(d: Any, P: Any, Q: Any, R: Any, S: Any, c: Any, /, *, curve: Curve) -> Any:
    """Where a curve through four points meets a circle near a known place, to first order in what misses there."""
    u, (dx, dy) = d.lift(curve.at[0]), map(d.lift, curve.off[0])
    x, y = cubic_point(d, (P, Q, R, S), u)
    arm = (x + dx - c[0], y + dy - c[1])
    x, y = cubic_point(d, (P, Q, R, S), u - d.lift(curve.slopes[0][0]) * (dot(arm, arm) - c[2]))
    return x + dx, y + dy


@primitive((POINT,) * 8, POINT, PENCIL,
           "Draw {curve} through {0}, {1}, {2} and {3}, and one through {4}, {5}, {6} and {7}: they cross in {out}.",
           claims=(("fair", 0), ("fair", 1)), params=("curve",), movement=Movement.TRACES_MET)
def curves_meet(d: Any, *plans: Any, curve: Curve) -> Any:
    """Where two curves cross near a known place, each through four points, to first order in what misses there."""
    u, w = map(d.lift, curve.at)
    (a, b), (e, f) = (tuple(map(d.lift, off)) for off in curve.off)
    i, j = map(d.lift, curve.slopes[0])
    (x, y), (v, z) = cubic_point(d, plans[:4], u), cubic_point(d, plans[4:], w)
    gap = x + a - v - e, y + b - z - f
    x, y = cubic_point(d, plans[:4], u - i * gap[0] - j * gap[1])
    return x + a, y + b


# ---- a joint of a group --------------------------------------------------------------------------------------------


class Side(NamedTuple):
    """What of a group is on one side of a joint that is freed: its bodies, and a place of one of them that is there."""

    bodies: tuple[int, ...]
    body: int
    at: Vector


def sides(group: Closure, joint: str) -> list[Side]:
    """The two parts into which a group falls when a joint is freed, each with one way to move; none where it does not.
    """
    freed, at = group.joints[joint]
    others = [(h.other, h.there) if (h.body, h.at) == (freed, at) else (h.body, h.at) for h in group.pairs
              if isinstance(h, Hinge) and ((h.body, h.at) == (freed, at) or (h.other, h.there) == (freed, at))]
    if len(others) != 1 or any(not isinstance(pair, PlacedPin | Hinge) for pair in group.pairs):
        return []
    found = [_side(group, freed, at, joint), _side(group, *others[0], joint)]
    apart = not {*found[0].bodies} & {*found[1].bodies}
    return found if apart and all(_mobility(group, side, joint) == 1 for side in found) else []


def _mobility(group: Closure, side: Side, joint: str) -> int:
    """In how many ways a side can move on the outer joints."""
    freed = group.joints[joint]
    pairs = sum(pair.body in side.bodies for pair in group.pairs
                if isinstance(pair, PlacedPin) or freed not in ((pair.body, pair.at), (pair.other, pair.there)))
    return 3 * len(side.bodies) - 2 * pairs


def _side(group: Closure, body: int, at: Vector, joint: str) -> Side:
    """All that hangs together with a body but by the joint."""
    freed, place = group.joints[joint]
    bodies = {body}
    hinges = [h for h in group.pairs if isinstance(h, Hinge)
              and (freed, place) not in ((h.body, h.at), (h.other, h.there))]
    while more := {end for h in hinges for end in (h.body, h.other) if {h.body, h.other} & bodies} - bodies:
        bodies |= more
    return Side(tuple(sorted(bodies)), body, at)


class Sketch:
    """A board on which nothing is drawn: its marks are their values."""

    def __getattr__(self, verb: str) -> Any:
        return partial(TABLE[verb].rule, FLOATS)

    def place(self, P: Any) -> Any:
        return P


class SidePositions:
    """Plans of one side in several positions: its bodies are placed from a bar that is turned."""

    def __init__(self, s: Any, joints: Sequence[Any], group: Closure, pose: Sequence[Attitude], side: Side):
        self.s, self.joints, self.group, self.pose, self.side = s, joints, group, pose, side
        self.pins = {pin.body: pin for pin in group.pairs if isinstance(pin, PlacedPin) and pin.body in side.bodies}
        self.hinges = [h for h in group.pairs if isinstance(h, Hinge) and {h.body, h.other} <= {*side.bodies}]

    def circle(self) -> Any:
        """The circle of the joint, where the side is a bar."""
        pin = self.pins[self.side.body]
        return self.s.circle(self.joints[pin.joint], self._length(pin.at, self.side.at))

    def _length(self, p: Vector, q: Vector) -> Any:
        return self.s.link_length(dx=q[0] - p[0], dy=q[1] - p[1])

    def curve(self) -> tuple[list[Any], float] | None:
        """Places of the joint in four positions near the known one, and its parameter there; none where arcs do not
        find them, or no curve through them is near enough to the path."""
        sketch = SidePositions(Sketch(), [self.s.place(mark) for mark in self.joints], self.group, self.pose, self.side)
        true = self.pose[self.side.body].place_point((float(self.side.at[0]), float(self.side.at[1])))
        for (pin, hinge), spacing in product(self._cranks(), SPACING):
            x, y = self.pose[pin.body].turn_vector((float(hinge[0] - pin.at[0]), float(hinge[1] - pin.at[1])))
            now, long = math.degrees(math.atan2(y, x)), math.hypot(x, y)
            base = math.floor(now / spacing) * spacing
            angles, u = [_angle(base + node * spacing, long) for node in NODES], (now - base) / spacing
            try:
                places = [sketch.plan(pin, hinge, angle) for angle in angles]
            except Undrawable:  # links do not reach each other
                continue
            if None not in places and math.dist(true,
                                                cubic_point(FLOATS, places, u)) <= LOCUS_TOL * math.dist(*places[1:3]):
                return [self.plan(pin, hinge, angle) for angle in angles], u
        return None

    def _cranks(self) -> Iterator[tuple[PlacedPin, Vector]]:
        """The bodies that turn about an outer joint, each with another joint of it."""
        for pin in self.pins.values():
            yield from [(pin, h.at if h.body == pin.body else h.there) for h in self.hinges
                        if pin.body in (h.body, h.other)][:1]

    def plan(self, pin: PlacedPin, hinge: Vector, angle: Angle) -> Any:
        """The joint in one position; nothing where arcs alone do not place it."""
        known = {pin.body: [(pin.at, self.joints[pin.joint]),
                            (hinge, self.s.crank(self.joints[pin.joint], angle=angle))]}
        while self.side.body not in known:
            if not self._place_next(known):
                return None
        return self._point(known[self.side.body], self.side.at)

    def _place_next(self, known: dict[int, list[Any]]) -> bool:
        """Place the next two bodies by arcs, or one that hangs between two that are."""
        anchors = {body: self._anchors(body, known) for body in self.side.bodies if body not in known}
        for body, found in anchors.items():
            if len(found) > 1:
                known[body] = found
                return True
        single = {body: found[0] for body, found in anchors.items() if len(found) == 1}
        for h in self.hinges:
            if h.body in single and h.other in single:
                (p, P), (q, Q) = single[h.body], single[h.other]
                ends = [self.pose[body].place_point((float(at[0]), float(at[1])))
                        for body, at in ((h.body, p), (h.other, q), (h.body, h.at))]
                (x, y), (u, v), (a, b) = ends
                side = "left" if cross((u - x, v - y), (a - x, b - y)) > 0 else "right"
                met = self.s.circles_meet(self.s.circle(P, self._length(p, h.at)),
                                          self.s.circle(Q, self._length(q, h.there)), side=side)
                known[h.body], known[h.other] = [(p, P), (h.at, met)], [(q, Q), (h.there, met)]
                return True
        return False

    def _anchors(self, body: int, known: dict[int, list[Any]]) -> list[Any]:
        """The points of a body that are placed: outer joints, and those that it shares with bodies that are."""
        pins = [(pin.at, self.joints[pin.joint]) for pin in self.group.pairs if isinstance(pin, PlacedPin)
                and pin.body == body]
        hinges = [(h.at, self._point(known[h.other], h.there)) if h.body == body
                  else (h.there, self._point(known[h.body], h.at)) for h in self.hinges
                  if body in (h.body, h.other) and {h.body, h.other} & known.keys()]
        return pins + hinges

    def _point(self, placed: list[Any], at: Vector) -> Any:
        """A point of a body of which two are placed."""
        same = next((mark for place, mark in placed if place == at), None)
        if same is not None:
            return same
        (p, P), (q, Q) = placed[:2]
        return self.s.corner(P, Q, dx=at[0] - p[0], dy=at[1] - p[1], ux=q[0] - p[0], uy=q[1] - p[1])


def _angle(degrees: float, long: float) -> Angle:
    """A direction by its angle, so long."""
    turn = math.radians(degrees)
    return Angle(digits(degrees, 6), long * math.cos(turn), long * math.sin(turn))


def _loci(s: Any, *joints: Any, group: Closure, joint: str) -> Any:
    """The crossing of the two curves."""
    pose = close_group(FLOATS, [s.place(mark) for mark in joints], group)
    plans = [SidePositions(s, joints, group, pose, side) for side in sides(group, joint)]
    if not plans:
        return None
    plans.sort(key=lambda plan: len(plan.side.bodies) == 1)
    side = plans[0].side
    true = pose[side.body].place_point((float(side.at[0]), float(side.at[1])))
    bars = [plan.circle() for plan in plans if len(plan.side.bodies) == 1]
    if len(bars) == 2:
        (x, y), (u, v) = (s.place(joints[plan.pins[plan.side.body].joint]) for plan in plans)
        left = cross((u - x, v - y), (true[0] - x, true[1] - y)) > 0
        return s.circles_meet(*bars, side="left" if left else "right")
    optional_curves = [plan.curve() for plan in plans if len(plan.side.bodies) > 1]
    if any(curve is None for curve in optional_curves):
        return None
    curves = [curve for curve in optional_curves if curve is not None]
    places = [[s.place(mark) for mark in marks] for marks, _ in curves]
    offs = [tuple(t - p for t, p in zip(true, cubic_point(FLOATS, place, u), strict=True))
            for place, (_, u) in zip(places, curves, strict=True)]
    tangents = [cubic_direction(place, u) for place, (_, u) in zip(places, curves, strict=True)]
    at = [u for _, u in curves]
    if bars:
        x, y = s.place(joints[plans[1].pins[plans[1].side.body].joint])
        slope = 2 * dot((true[0] - x, true[1] - y), tangents[0])
        return s.curve_meets_circle(*curves[0][0], bars[0], curve=Curve("a curve", at, offs, [[1 / slope]]))
    (a, b), (e, f) = tangents
    whole = b * e - a * f
    slopes = [[-f / whole, e / whole]]
    return s.curves_meet(*curves[0][0], *curves[1][0], curve=Curve("a curve", at, offs, slopes))


def _enter_primitive(count: int, name: str) -> None:
    def rule(d: Any, *joints: Any, group: Closure, joint: str) -> Any:
        """The joint of a group where the lengths of all its links close on its outer joints."""
        body, at = group.joints[joint]
        return close_group(d, joints, group)[body].place_point((d.lift(at[0]), d.lift(at[1])))

    rule.__name__ = name
    listed = ", ".join(f"{{{k}}}" for k in range(count))
    primitive((POINT,) * count, POINT, COMPASSES,
              f"On {listed} let the lengths of links {{group}} close: mark {{out}}, their joint {{joint}}.",
              claims=(("closes",),), fails=("circles-miss",), params=("group", "joint"),
              source="Ozols 1974, section 5-2: method of loci", forms={"loci": _loci}, by_form={"loci": phrase(
                  "Free {joint}, draw plans of what is left on either side in positions near this one, and through its "
                  "places the curves on which it lies: they cross in {out}.")})(rule)


for number, word in ((2, "close_on_two"), (3, "close_on_three"), (4, "close_on_four")):
    _enter_primitive(number, word)
