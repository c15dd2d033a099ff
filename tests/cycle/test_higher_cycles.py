"""Gears and contacts around the cycle: closed formulas, numbers of turns, random mechanisms beside the solver."""

from __future__ import annotations

import math
from itertools import permutations
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from face import ran

import graphplan as gp

follow = gp.cycle.follow
CASES = Path(__file__).parents[1] / "cases" / "cycle"
PLANET = gp.load(CASES / "planet.toml", by_drive=True)
SEEDS = 12
STEP = 2.0**-11  # degrees


def planet(gear: dict[str, Any], M: tuple[int, int] = (54, 22)) -> gp.Scene:
    """A wheel about A on the arm OA, geared with the frame, with a point M."""
    return PLANET.replace("gears", [gear]).replace("points.M", [*M])


def test_redundant_pairs_hold_nothing() -> None:
    """An eccentric between two faces of a slider: one contact repeats the other, and the slider stays on its guide."""
    turn = follow(gp.load(CASES / "faces.toml"), 24)
    assert not turn.faults
    away, apart = turn.points["M"] - (75 + 20j), turn.points["B"] - turn.points["M"]
    assert (away / (3 + 4j)).imag == pytest.approx(0, abs=1e-9)
    assert (apart / (3 + 4j)).real == pytest.approx(-2.2)


@pytest.mark.parametrize(("gear", "ratio"), [
    ({"links": ["frame", "2"], "centres": ["O", "A"], "teeth": [20, 30]}, 1 + 20 / 30),
    ({"links": ["2", "frame"], "centres": ["A", "O"], "radii": [20, 70], "internal": True}, 1 - 70 / 20),
    ({"links": ["2", "frame"], "centres": ["A", "O"], "radii": [7, 20], "belt": "open"}, 1 - 20 / 7),
    ({"links": ["2", "frame"], "centres": ["A", "O"], "radii": [7, 20], "belt": "crossed"}, 1 + 20 / 7),
], ids=["outside", "ring", "belt", "crossed belt"])
def test_points_of_planets_trace_cycloids(gear: dict[str, Any], ratio: float) -> None:
    """Over many turns of the arm, either way, a planet turns by its ratio: its points are on their cycloids."""
    A, M = 30 + 40j, 54 + 22j
    turn = follow(planet(gear), 500, (-900, 2600))
    arm = np.exp(1j * turn.travel)
    assert turn.faults == {}
    assert np.abs(turn.points["M"] - A * arm - (M - A) * np.exp(1j * ratio * turn.travel)).max() < 1e-12 * 100


def test_cardan_circles_draw_straight_lines() -> None:
    """A point of the rim of a wheel in a ring twice as large goes back and forth on a diameter."""
    gear = {"links": ["2", "frame"], "centres": ["A", "O"], "radii": [50, 100], "internal": True}
    found = follow(planet(gear, (60, 0)), 360).points["M"]
    assert np.abs(found.imag).max() < 1e-12 * 100
    assert found.real.min() == pytest.approx(-100, rel=1e-4)


@pytest.mark.parametrize(("teeth", "turns"), [((20, 30), 3), ((30, 20), 2), ((19, 31), 0), ((16, 1), 1)])
def test_the_motion_goes_on_until_all_is_back(teeth: tuple[int, int], turns: int) -> None:
    """A planetary gear is followed through the fewest turns that bring its planet back; it has no steady cycle if these
    are too many."""
    scene = PLANET.replace("gears.0.teeth", [*teeth])
    assert follow(scene, 12).closed == (turns == 1)
    heavy = scene.replace("masses", {"2": {"mass": 1, "centre": "M"}}).replace(
        "moments", [{"on": "2", "value": 1}])
    if not turns:
        with pytest.raises(gp.Refused):
            gp.flywheel(heavy, speed=2, unevenness=0.01)
        return
    rows = gp.flywheel(heavy, speed=2, unevenness=0.01).json()["reduced_inertia"]
    assert rows[-1][0] == pytest.approx(360 * turns)
    assert rows[-1][1] == pytest.approx(rows[0][1])


def test_the_wheel_rolls_on_its_rail() -> None:
    """A wheel on a rail that is not level goes as far as it turns, and touches the rail under its centre."""
    scene = gp.load(CASES / "rail.toml")
    turn, B, K = follow(scene, 50, (-700, 700)), 30 + 40j, 12 + 16j
    radius, along = B - K, complex(-4, 3) / 5
    gone = (turn.points["B"] - B) * along.conjugate()
    side = math.copysign(abs(radius), (radius * along.conjugate()).imag)
    assert np.abs(gone + side * turn.travel).max() < 1e-11
    assert np.abs(turn.points["B"] - turn.points["K"] - radius).max() < 1e-11


def test_a_slot_is_a_contact_and_a_slide() -> None:
    """A Geneva wheel goes round the same whether its pin touches the slot or slides there with a block."""
    one, other = (follow(gp.load(CASES / f"{name}.toml"), 72) for name in ("geneva", "geneva-block"))
    assert np.abs(one.points["K"] - one.points["A"]).max() == 0
    assert np.abs((one.points["A2"] - 100) / abs(one.points["A2"] - 100)
                  - (other.points["A"] - 100) / abs(other.points["A"] - 100)).max() < 1e-12
    assert one.faults == other.faults == {}


def test_directions_go_with_the_links() -> None:
    """A straight profile on a moving link has its direction in all poses, as it turns."""
    found = follow(gp.load(CASES / "turning-face.toml"), 12)
    ((name, ways),) = found.guides.items()
    arm, given = found.points["K"] - (75 + 20j), 12 + 16j - (75 + 20j)
    right = (4 - 3j) * np.exp(1j * np.angle(arm / given))
    assert np.abs(ways - ways[0] / right[0] * right).max() < 1e-12 * 10
    assert abs((ways[0] / right[0]).imag) < 1e-15, name


# ---- random mechanisms -----------------------------------------------------------------------------------------------


class Chance:
    """A crank, and on it by chance dyads, planets, racks, followers, and dyads on geared cranks."""

    def __init__(self, seed: int):
        self.random = Random(seed)
        self.points: dict[str, tuple[int, int]] = {"O": (0, 0), "A": (24, 32)}
        self.links = {"1": ["O", "A"], "frame": ["O"]}
        self.pairs: dict[str, list[dict[str, Any]]] = {"gears": [], "slides": [], "contacts": []}
        kinds = self.dyad, self.planet, self.planet, self.coupled, self.rack, self.follower, self.flat
        for _ in range(self.random.randint(1, 3)):
            self.random.choice(kinds)()

    def point(self, *links: str, at: tuple[int, int] | None = None) -> str:
        name = f"P{len(self.points)}"
        self.points[name] = at or (self.random.randint(-90, 90), self.random.randint(-90, 90))
        for link in links:
            self.links[link].append(name)
        return name

    def link(self) -> str:
        name = str(len(self.links))
        self.links[name] = []
        return name

    def known(self, fixed: bool = False) -> tuple[str, str]:
        """A moving link that is there and a point of it, which moves, or else is of the frame."""
        frame = self.links["frame"]
        return self.random.choice([(link, point) for link, points in self.links.items() for point in points
                                   if link != "frame" and (point in frame) == fixed])

    def dyad(self) -> None:
        (_, P), one, two = self.known(), self.link(), self.link()
        self.links[one].append(P)
        self.point(one, two)
        self.point(two, "frame")
        self.point(one)

    def planet(self) -> None:
        arms = [(arm, P, Q, link) for arm, ends in self.links.items() for P, Q in permutations(ends, 2)
                for link, points in self.links.items() if Q in points and link != arm]
        (_, P, Q, on), wheel = self.random.choice(arms), self.link()
        self.links[wheel].append(P)
        self.point(wheel)
        self.geared(on, wheel, Q, P)

    def geared(self, one: str, two: str, P: str, Q: str) -> None:
        teeth = [self.random.randint(10, 40), self.random.randint(10, 40)]
        self.pairs["gears"].append({"links": [one, two], "centres": [P, Q], "teeth": teeth})

    def coupled(self) -> None:
        """Five links that are solved together: two geared cranks and a dyad on them, which a bar moves."""
        (_, A), (a, b, c, d, e) = self.known(), [self.link() for _ in range(5)]
        P, Q = self.point(a, "frame"), self.point(b, "frame")
        self.point(a, c)
        self.point(b, d)
        self.point(c, d, e)
        self.links[e].append(A)
        self.geared(a, b, P, Q)

    def rack(self) -> None:
        (on, P), rack = self.known(fixed=True), self.link()
        at, way = self.point(rack), self.random.choice(([3, 4], [-4, 3], [1, 0]))
        self.pairs["slides"].append({"link": rack, "along": "frame", "at": at, "direction": way})
        self.pairs["gears"].append({"links": [on, rack], "centres": [P], "radius": 20, "direction": way})

    def follower(self) -> None:
        (on, Q), link = self.known(), self.link()
        self.point(link, "frame")
        C = self.point(link)
        (x, y), (u, v) = self.points[Q], self.points[C]
        K = self.point(at=(3 * x - 2 * u, 3 * y - 2 * v))
        self.pairs["contacts"].append({"links": [link, on], "at": K, "centres": [C, Q]})

    def flat(self) -> None:
        (on, Q), link = self.known(), self.link()
        self.point(link, "frame")
        (x, y), (dx, dy) = self.points[Q], self.random.choice(((3, 4), (-4, 3), (12, 5)))
        K = self.point(at=(x - 2 * dy, y + 2 * dx))
        self.pairs["contacts"].append({"links": [link, on], "at": K, "centres": [[dx, dy], Q]})

    def scene(self, shuffle: Random | None = None) -> gp.Scene:
        """The mechanism, its tables in any order."""
        def some(things: Any) -> list[Any]:
            return shuffle.sample([*things], len(things)) if shuffle else [*things]

        return gp.scene({
            "points": {name: [*at] for name, at in some(self.points.items())},
            "links": {name: " ".join(some(held)) for name, held in some(self.links.items())},
            **{kind: some(pairs) for kind, pairs in self.pairs.items() if pairs},
            "drive": [{"link": "1", "omega": 2, "alpha": 3}], "find": {"velocity": "all", "acceleration": "all"}})


def test_random_mechanisms_move_as_the_solver_says() -> None:
    """In whatever order they are written, all points move off at the solver's velocities and accelerations, and are the
    same around; where the whole can be drawn, the constructions give those of the solver."""
    moved = drawn = 0
    for made in filter(lambda made: any(made.pairs.values()), map(Chance, range(SEEDS))):
        try:
            turn = follow(scene := made.scene(), 3, (-STEP, STEP))
        except gp.GraphplanError:  # no sound mechanism
            continue
        if turn.faults:
            continue
        step, truth = math.radians(STEP) / 2, gp.analytic.solve(scene)  # seconds, at 2 rad/s
        fast = max(map(abs, truth.velocity.values()))
        for name in {point for points in made.links.values() for point in points} & truth.velocity.keys():
            before, here, after = turn.points[name]
            assert abs((after - before) / (2 * step) - truth.velocity[name]) <= 1e-5 * fast, (scene, name)
            bent = (after - 2 * here + before) / step**2 + 3 / 2 * truth.velocity[name]  # with alpha = 3
            assert abs(bent - truth.acceleration[name]) <= 1e-3 * max(map(abs, truth.acceleration.values())), name
        one, again = (follow(given, 13, (-20, 20)) for given in (scene, made.scene(Random(1))))
        assert one.faults.keys() == again.faults.keys()
        for name, z in one.points.items():
            assert np.nanmax(np.abs(again.points[name] - z), initial=0) <= 1e-8 * scene.extent, (scene, name)
        moved += 1
        told = ran("cycle", "-", "-q", "--positions", "7", "--from", "-20", "--to", "20", given=scene.toml())
        assert told.status in (0, 2), told.err  # 1 where construction and solver disagree
        drawn += told.status == 0
    assert moved > SEEDS / 3
    assert drawn > SEEDS / 4
