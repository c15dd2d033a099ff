"""Gears and contacts around the cycle: closed formulas, numbers of turns, random mechanisms beside the solver."""

from __future__ import annotations

import math
from itertools import permutations
from random import Random
from typing import Any

import higher
import numpy as np
import pytest

import graphplan as gp
from graphplan.check.cycle import cycle
from graphplan.cycle import follow
from graphplan.cycle.turn import RangeOfMotion, whole_motion
from graphplan.errors import GraphplanError
from graphplan.mechanism.model import Scene
from graphplan.mechanism.replaced import guides
from graphplan.solver import poses

SEEDS = 12
DRIVE = "[[drive]]\nlink = '1'\nomega = 2\nalpha = 3\n"
PLANET = f"""
[points]
O = [0, 0]
A = [30, 40]
M = [{{x}}, {{y}}]
[links]
1 = "O A"
2 = "A M"
frame = "O"
[[gears]]
{{gear}}
{DRIVE}
"""
GENEVA = """
[points]
O = [0, 0]
C = [100, 0]
A = [60, 37]
A2 = [60, 37]
{points}
[links]
1 = "O A"
2 = "C A2"
{links}
frame = "O C"
{pairs}
[[drive]]
link = "1"
omega = 10
"""


def planet(gear: str, M: complex = 54 + 22j) -> Scene:
    """A wheel about A on the arm OA, geared with the frame, with a point M."""
    return gp.parse(PLANET.format(gear=gear, x=M.real, y=M.imag), "planet")


def test_redundant_pairs_hold_nothing() -> None:
    """An eccentric between two faces of a slider: one contact repeats the other, and the slider stays on its guide."""
    faces = [higher.contact("1 2", at, '["B", [4, -3]]') for at in "KL"]
    text = higher.text({"1": "A B", "2": "M", "frame": "A"}, higher.slide("2", "M", "[3, 4]"), *faces, DRIVE)
    turn = follow(gp.parse(text.replace("[points]", "[points]\nL = [60, 80]"), "faces"), 24)
    assert not turn.faults
    away, apart = turn.points["M"] - (75 + 20j), turn.points["B"] - turn.points["M"]
    assert (away / (3 + 4j)).imag == pytest.approx(0, abs=1e-9)
    assert (apart / (3 + 4j)).real == pytest.approx(-2.2)


@pytest.mark.parametrize(("gear", "ratio"), [
    ("links = ['frame', '2']\ncentres = ['O', 'A']\nteeth = [20, 30]", 1 + 20 / 30),
    ("links = ['2', 'frame']\ncentres = ['A', 'O']\nradii = [20, 70]\ninternal = true", 1 - 70 / 20),
    ("links = ['2', 'frame']\ncentres = ['A', 'O']\nradii = [7, 20]\nbelt = 'open'", 1 - 20 / 7),
    ("links = ['2', 'frame']\ncentres = ['A', 'O']\nradii = [7, 20]\nbelt = 'crossed'", 1 + 20 / 7),
])
def test_points_of_planets_trace_cycloids(gear: str, ratio: float) -> None:
    """Over many turns of the arm, either way, a planet turns by its ratio: its points are on their cycloids."""
    A, M = 30 + 40j, 54 + 22j
    turn = follow(planet(gear), 500, (-900, 2600))
    arm = np.exp(1j * turn.travel)
    expected = A * arm + (M - A) * np.exp(1j * ratio * turn.travel)
    assert turn.faults == {}
    assert np.abs(turn.points["M"] - expected).max() < 1e-12 * 100


def test_cardan_circles_draw_straight_lines() -> None:
    """A point of the rim of a wheel in a ring twice as large goes back and forth on a diameter."""
    gear = "links = ['2', 'frame']\ncentres = ['A', 'O']\nradii = [50, 100]\ninternal = true"
    found = follow(planet(gear, 60 + 0j), 360).points["M"]
    assert np.abs(found.imag).max() < 1e-12 * 100
    assert found.real.min() == pytest.approx(-100, rel=1e-4)


@pytest.mark.parametrize(("teeth", "turns"), [((20, 30), 3), ((30, 20), 2), ((19, 31), 0), ((16, 1), 1)])
def test_the_motion_goes_on_until_all_is_back(teeth: tuple[int, int], turns: int) -> None:
    """A planetary gear is followed through the fewest turns that bring its planet back; none if these are too many."""
    found = whole_motion(planet(f"links = ['frame', '2']\ncentres = ['O', 'A']\nteeth = {[*teeth]}"))
    assert found.goes_round == bool(turns)
    assert found.path.travel[-1] == pytest.approx(2 * math.pi * max(turns, 1))
    assert follow(found.scene, 12).closed == (turns == 1)


def test_the_wheel_rolls_on_its_rail() -> None:
    """A wheel on a rail that is not level goes as far as it turns, and touches the rail under its centre."""
    scene = gp.parse(higher.TEXTS["wheel on a rail"], "wheel")
    turn, (bx, by), (kx, ky) = follow(scene, 50, (-700, 700)), *(map(float, scene.points[name]) for name in "BK")
    radius, along = complex(bx - kx, by - ky), complex(-4, 3) / 5
    gone = (turn.points["B"] - complex(bx, by)) * along.conjugate()
    side = math.copysign(abs(radius), (radius * along.conjugate()).imag)
    assert np.abs(gone + side * turn.travel).max() < 1e-11
    assert np.abs(turn.points["B"] - turn.points["K"] - radius).max() < 1e-11


def test_a_slot_is_a_contact_and_a_slide() -> None:
    """A Geneva wheel goes round the same whether its pin touches the slot or slides there with a block."""
    contact = GENEVA.format(points="K = [60, 37]", links="", pairs=higher.contact("1 2", "K", '["A", "A2 C"]'))
    slide = GENEVA.format(points="", links='3 = "A"', pairs="[[slides]]\nlink = '3'\nalong = '2'\nat = 'A'\n"
                          "direction = 'A2 C'\n")
    one, other = (follow(gp.parse(text, "geneva"), 72) for text in (contact, slide))
    assert np.abs(one.points["K"] - one.points["A"]).max() == 0
    assert np.abs((one.points["A2"] - 100) / abs(one.points["A2"] - 100)
                  - (other.points["A"] - 100) / abs(other.points["A"] - 100)).max() < 1e-12
    assert one.faults == other.faults == {}


# ---- random mechanisms -----------------------------------------------------------------------------------------------


class Chance:
    """A crank, and on it by chance dyads, planets, racks, followers, and dyads on geared cranks."""

    def __init__(self, seed: int):
        self.random = Random(seed)
        self.points = {"O": (0, 0), "A": (24, 32)}
        self.links = {"1": ["O", "A"], "frame": ["O"]}
        self.pairs: list[str] = []
        kinds = self.dyad, self.planet, self.planet, self.coupled, self.rack, self.follower, self.flat
        for _ in range(self.random.randint(1, 3)):
            self.random.choice(kinds)()

    def point(self, *links: str, at: tuple[int, int] | None = None) -> str:
        """A new point of links."""
        name = f"P{len(self.points)}"
        self.points[name] = at or (self.random.randint(-90, 90), self.random.randint(-90, 90))
        for link in links:
            self.links[link].append(name)
        return name

    def link(self) -> str:
        """A new link."""
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
        """A pair of gears."""
        teeth = self.random.randint(10, 40), self.random.randint(10, 40)
        self.pairs.append(higher.gear(f"{one} {two}", f"{P} {Q}", f"teeth = {[*teeth]}"))

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
        self.pairs += [higher.slide(rack, at, str(way)), f"[[gears]]\nlinks = ['{on}', '{rack}']\n"
                       f"centres = ['{P}']\nradius = 20\ndirection = {way}\n"]

    def follower(self) -> None:
        (on, Q), link = self.known(), self.link()
        self.point(link, "frame")
        C = self.point(link)
        (x, y), (u, v) = self.points[Q], self.points[C]
        K = self.point(at=(3 * x - 2 * u, 3 * y - 2 * v))
        self.pairs.append(higher.contact(f"{link} {on}", K, f'["{C}", "{Q}"]'))

    def flat(self) -> None:
        (on, Q), link = self.known(), self.link()
        self.point(link, "frame")
        (x, y), (dx, dy) = self.points[Q], self.random.choice(((3, 4), (-4, 3), (12, 5)))
        K = self.point(at=(x - 2 * dy, y + 2 * dx))
        self.pairs.append(higher.contact(f"{link} {on}", K, f'[[{dx}, {dy}], "{Q}"]'))

    def text(self, shuffle: Random | None = None) -> str:
        """The scene as it is written, its tables in any order."""
        def some(things: Any) -> list[Any]:
            return shuffle.sample([*things], len(things)) if shuffle else [*things]

        points = [f"{name} = {[*at]}" for name, at in some(self.points.items())]
        links = [f'{name} = "{" ".join(some(held))}"' for name, held in some(self.links.items())]
        find = '[find]\nvelocity = "all"\nacceleration = "all"'
        return "\n".join(["[points]", *points, "[links]", *links, *some(self.pairs), DRIVE, find])


def random_scenes() -> list[tuple[Chance, Scene]]:
    """Those that are sound, and have a gear or a contact."""
    found = []
    for seed in range(SEEDS):
        made = Chance(seed)
        try:
            scene = gp.parse(made.text(), f"random {seed}")
        except GraphplanError:
            continue
        if made.pairs:
            found.append((made, scene))
    return found


def test_random_mechanisms_move_as_the_solver_says() -> None:
    """In all poses to which they come, in whatever order they are written, links turn at the solver's rates, and the
    constructions give those of the solver."""
    moved = drawn = 0
    for made, scene in random_scenes():
        motion = RangeOfMotion(scene, -0.6, 0.6, closed=False)
        low, high = motion.path.travel[[0, -1]]
        travel = np.linspace(low, high, 15)[1:-1]
        if high - low < 0.1:
            continue
        turn, links, span = motion.turn(travel), motion.links_at(travel), tuple(map(math.degrees, travel[[0, -1]]))
        truth = poses.solve(poses.scene_in_poses(scene, turn.points, turn.guides), travel.size)
        for link in scene.moving:
            gap = np.abs(abs(float(scene.drives[0].rate)) * links[link].spin - truth.omega[link])
            assert gap.max() <= 1e-9 * (2 + np.max(np.abs(truth.omega[link]))), (scene.name, link)
        again = follow(gp.parse(made.text(Random(1)), "shuffled"), 13, span)
        for name, z in turn.points.items():
            assert np.abs(again.points[name] - z).max() <= 1e-8 * scene.extent, (scene.name, name)
        moved += 1
        try:
            found = cycle(scene, 7, span)
        except GraphplanError:
            continue
        assert found.wrong == (), scene.name
        drawn += len(found.faults) < 7
    assert moved > SEEDS / 3
    assert drawn > SEEDS / 4


def test_directions_go_with_the_links() -> None:
    """Straight profiles and racks on moving links have their directions in all poses, as they turn."""
    text = higher.TEXTS["turning flat follower"]
    scene = gp.parse(text, "turning")
    found = follow(scene, 12)
    ((name, guide),) = guides(scene).items()
    arm = found.points["K"] - complex(*map(float, scene.points["M"]))
    given = complex(*map(float, scene.points["K"])) - complex(*map(float, scene.points["M"]))
    expected = complex(*map(float, guide.direction)) * np.exp(1j * np.angle(arm / given))
    assert np.abs(found.guides[name] - expected).max() < 1e-12 * 10
