"""Where methods fail: packaged scenes with some points moved until only a distance d keeps them from a special pose.

d is the tangent of an angle or a part of a length, from 1 downwards; at 0 the pose is special. Points are moved in
fractions: the special pose is special to the last digit, and floats round what they are given, as with any scene.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from graphplan.mechanism.model import Pair, Scene
from graphplan.mechanism.numbers import dot, minus, plus, quarter_turn, times
from graphplan.mechanism.scene import load

Points = Mapping[str, Pair]

AUXILIARY, TRIAL, POLES, FALSE = "auxiliary points", "trial figures", "relative pole", "false position"
ORTHOGONAL, POLAR, POLYGONS, LEVER = "orthogonal velocities", "polar plans", "force polygons", "lever"
WAYS: dict[str, dict[str, str]] = {  # as arguments of `construct`
    AUXILIARY: {"method": "auxiliary"}, TRIAL: {"method": "trial"}, POLES: {"method": "poles"},
    FALSE: {"method": "trial"}, ORTHOGONAL: {"plan": "orthogonal"}, POLAR: {"plan": "polar"},
    POLYGONS: {"plan": "polygons"}, LEVER: {"plan": "lever"},
}
LOCI, RINGS, PLANS, FORCES = (AUXILIARY, TRIAL), (POLES, FALSE), (ORTHOGONAL, POLAR), (POLYGONS, LEVER)


@dataclass(frozen=True)
class Degeneracy:
    """One way to a special pose: what happens at d = 0, in which packaged scene, and which points are moved there.

    `move` gives the moved points' places from those of the scene. `singular` says that the mechanism is singular at
    d = 0; else some of its `ways` are, and it is not.
    """

    name: str
    description: str
    scene: str
    singular: bool
    compared_ways: tuple[str, str]
    move: Callable[[Points, Fraction], Points]

    def scene_at(self, d: float) -> Scene:
        """The scene at the distance d; of its motion all joints are asked for."""
        scene = load(self.scene)
        find = replace(scene.find, velocity=scene.joints, acceleration=scene.joints)
        return replace(scene, find=find, points={**scene.points, **self.move(scene.points, Fraction(d))})


def _turn_by_tangent(v: Pair, d: Fraction) -> Pair:
    """A vector turned by an angle of tangent d, and as much longer."""
    return plus(v, times(d, quarter_turn(v)))


def _point_beyond(P: Pair, part: float, v: Pair, d: Fraction) -> Pair:
    """From a point a part of a vector on, and d of the vector aside."""
    return plus(P, plus(times(Fraction(part), v), times(d, quarter_turn(v))))


def _half(a: Pair, b: Pair) -> Pair:
    """Halfway between two points."""
    return times(Fraction(1, 2), plus(a, b))


def _crossing(a: Pair, b: Pair, c: Pair, d: Pair) -> Pair:
    """Where the lines ab and cd meet."""
    u, n = minus(b, a), quarter_turn(minus(d, c))
    return plus(a, times(Fraction(dot(n, minus(c, a))) / dot(n, u), u))


def _on_the_line_of_poles(p: Points, d: Fraction) -> Points:
    Q = _crossing(p["K"], p["A"], p["L"], p["B"])
    R = _crossing(p["M"], p["D"], p["N"], p["E"])
    return {"C": _point_beyond(Q, 0.4375, minus(R, Q), d)}


def _bars_through_one_point(p: Points, d: Fraction) -> Points:
    X = _crossing(p["A"], p["E"], p["B"], p["F"])
    return {"C": plus(p["G"], times(Fraction(1, 8), _turn_by_tangent(minus(X, p["G"]), d)))}


def _poles_in_line(p: Points, d: Fraction) -> Points:
    X = _crossing(p["D"], p["G"], p["A"], p["B"])
    return {"E": plus(p["F"], times(Fraction(1, 2), _turn_by_tangent(minus(X, p["F"]), d)))}


def _rod_across_the_guide(p: Points, d: Fraction) -> Points:
    B = plus(p["A"], _turn_by_tangent((0, -p["A"][1]), d))
    return {"B": B, "S": plus(p["A"], times(Fraction(2, 5), minus(B, p["A"])))}


def _rocker_in_line(p: Points, d: Fraction) -> Points:
    B = _point_beyond(p["A"], 0.5625, minus(p["C"], p["A"]), d)
    return {"B": B, "S": _half(p["A"], B)}


def _crank_in_line(p: Points, d: Fraction) -> Points:
    A = _point_beyond(p["O"], 0.3125, p["B"], d)
    return {"A": A, "S": _half(A, p["B"])}


def _short_coupler(p: Points, d: Fraction) -> Points:
    B = plus(p["A"], times(d, minus(p["B"], p["A"])))
    return {name: minus(at, p["A"]) for name, at in {**p, "B": B}.items()}


def _force_along_the_crank(p: Points, d: Fraction) -> Points:
    A = _turn_by_tangent((-80, 60), -d)
    return {"A": A, "S": _half(A, p["B"])}


DEGENERACIES = (
    Degeneracy("parallel bars", "KA turned towards LB: the auxiliary point Q goes far away", "rosenauer-basic", False,
               LOCI, lambda p, d: {"K": minus(p["A"], times(4, _turn_by_tangent(minus(p["B"], p["L"]), d)))}),
    Degeneracy("joints coincide", "B brought to A, on link 3", "rosenauer-basic", False,
               LOCI, lambda p, d: {"B": plus(p["A"], times(d, minus(p["B"], p["A"])))}),
    Degeneracy("pole at infinity", "FE turned towards DG: the relative pole of links 2 and 5 goes far away",
               "class-four", False,
               RINGS,
               lambda p, d: {"E": plus(p["F"], times(Fraction(1, 2), _turn_by_tangent(minus(p["G"], p["D"]), d)))}),
    Degeneracy("short crank", "the crank d times as long", "four-bar", False,
               PLANS, lambda p, d: {"A": times(d, p["A"])}),
    Degeneracy("short coupler", "the coupler d times as long, from the origin: floats give it no better elsewhere",
               "four-bar", True, PLANS, _short_coupler),
    Degeneracy("C on QR", "C brought to the line of the auxiliary points", "rosenauer-basic", True,
               LOCI, _on_the_line_of_poles),
    Degeneracy("triad", "bar GC turned towards the point where the other two meet", "triad", True,
               LOCI, _bars_through_one_point),
    Degeneracy("class IV", "bar FE turned until the poles of links 2 and 5 lie in line", "class-four", True,
               RINGS, _poles_in_line),
    Degeneracy("slide locks", "the rod turned square to the guide", "slider-crank", True,
               PLANS, _rod_across_the_guide),
    Degeneracy("dead centre against the drive", "coupler and rocker stretched, under load", "jaanimets-10", True,
               FORCES, _rocker_in_line),
    Degeneracy("dead centre with the drive", "crank and coupler stretched, under load", "jaanimets-10", False,
               FORCES, _crank_in_line),
    Degeneracy("parallel bars, loaded", "AN turned towards FB: the auxiliary point Q goes far away", "rosenauer-loaded",
               False, LOCI, lambda p, d: {"N": minus(p["A"], times(2, _turn_by_tangent(minus(p["B"], p["F"]), d)))}),
    Degeneracy("lever without arm", "the balancing force turned along the crank", "jaanimets-10", True,
               FORCES, _force_along_the_crank),
)
