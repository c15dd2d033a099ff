"""Machines that move by special geometry though the count says they cannot: their poses in whole numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import lcm
from random import Random

Point = tuple[Fraction, Fraction]
Guide = tuple[str, str, str, tuple[int, int]]
"""The sliding link, the guide's link, the point and the direction of a slide."""


@dataclass(frozen=True)
class Machine:
    """A machine by its points, links, slides and the driven link or slide; `free` is a point whose shift spoils it.

    `redundant` are the pairs to be named, `count` is Chebyshev's.
    """

    name: str
    points: Mapping[str, Sequence[Fraction | int | str]]
    links: Mapping[str, str]
    slides: tuple[Guide, ...] = ()
    drive: str = "1"
    free: str = ""
    count: int = 0
    redundant: tuple[str, ...] = ()

    @property
    def places(self) -> dict[str, Point]:
        """The points in whole numbers: all coordinates times their common denominator."""
        exact = {name: (Fraction(x), Fraction(y)) for name, (x, y) in self.points.items()}
        scale = lcm(*(part.denominator for at in exact.values() for part in at))
        return {name: (x * scale, y * scale) for name, (x, y) in exact.items()}

    def spoiled(self, by: Fraction = Fraction(1, 10**6)) -> Machine:
        """The same with one point shifted by a part of the machine's size: its lengths are special no more."""
        places = self.places
        size = max(abs(part) for at in places.values() for part in at)
        x, y = places[self.free]
        return replace(self, points=places | {self.free: (x + by * size, y - 2 * by * size)})

    def text(self, more: str = "", shuffled: Random | None = None) -> str:
        """The scene, its tables in any order."""
        points = [f"{name} = [{x}, {y}]" for name, (x, y) in self.places.items()]
        links = [f'{name} = "{" ".join(_mixed(held.split(), shuffled))}"' for name, held in self.links.items()]
        slides = [f'[[slides]]\nlink = "{link}"\nalong = "{along}"\nat = "{at}"\ndirection = {list(way)}'
                  for link, along, at, way in self.slides]
        one, _, other = self.drive.partition("/")
        drive = f'slide = ["{one}", "{other}"]\nspeed = 3' if other else f'link = "{one}"\nomega = 2\nalpha = 1'
        lines = ["[points]", *_mixed(points, shuffled), "[links]", *_mixed(links, shuffled),
                 *_mixed(slides, shuffled), "[[drive]]", drive, more]
        return "\n".join(lines)


def _mixed(things: list[str], chance: Random | None) -> list[str]:
    return chance.sample(things, len(things)) if chance else things


Complex = tuple[Fraction, Fraction]


def times(a: Complex, b: Complex) -> Complex:
    return a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]


def less(a: Complex, b: Complex) -> Complex:
    return a[0] - b[0], a[1] - b[1]


def mirrored(a: Complex) -> Complex:
    return a[0], -a[1]


def inverse(a: Complex) -> Complex:
    square = a[0] ** 2 + a[1] ** 2
    return a[0] / square, -a[1] / square


def crossing(p: Complex, q: Complex, r: Complex, s: Complex) -> Complex:
    """Where the lines pq and rs meet."""
    u, v, w = less(q, p), less(s, r), less(r, p)
    part = (w[0] * v[1] - w[1] * v[0]) / (u[0] * v[1] - u[1] * v[0])
    return p[0] + part * u[0], p[1] + part * u[1]


def focal(A: Complex, K: Complex, s: Complex, N0: Complex, way: Complex) -> dict[str, Complex]:
    """The focal mechanism of Burmester (1893) and Kempe (1878): a four-bar ABCD whose four sides carry bars to one P.

    The quadrangles AKPN and PMCL are inversely similar, A to P and P to C, and so are BLPK and PNDM. Of N = N0 + m way
    the factor m makes them so; P is the origin, and s the ratio and turn of the similarity.
    """
    def miss(m: Fraction) -> Fraction:
        N = N0[0] + m * way[0], N0[1] + m * way[1]
        u, v = mirrored(less(K, A)), mirrored(less(N, A))
        terms = (1, times(K, u)), (1, times(N, v)), (-1, times(times(N, K), inverse(s))), (-1, times(s, times(u, v)))
        return sum((sign * z[1] for sign, z in terms), Fraction(0))

    m = miss(Fraction(0)) / (miss(Fraction(0)) - miss(Fraction(1)))
    N, P = (N0[0] + m * way[0], N0[1] + m * way[1]), (Fraction(0), Fraction(0))
    M, C, L = (times(s, mirrored(less(z, A))) for z in (K, P, N))
    B, D = crossing(A, K, C, L), crossing(A, N, C, M)
    return {"A": A, "B": B, "C": C, "D": D, "K": K, "L": L, "M": M, "N": N, "P": P}


def whole(x: int, y: int) -> Complex:
    return Fraction(x), Fraction(y)


FOCAL = focal(whole(4, 10), whole(2, 10), (Fraction(1), Fraction(1, 10)), whole(-4, 3), whole(2, -1))

MACHINES = (
    Machine("three cranks on a parallelogram",
            {"O": (0, 0), "E": (20, 0), "C": (40, 0), "A": (7, 11), "D": (27, 11), "B": (47, 11)},
            {"1": "O A", "2": "A D B", "3": "C B", "4": "E D", "frame": "O E C"}, free="D", redundant=("4 at D",)),
    Machine("three cranks, upright",
            {"O": (0, 0), "E": (20, 0), "C": (40, 0), "A": (0, 11), "D": (20, 11), "B": (40, 11)},
            {"1": "O A", "2": "A D B", "3": "C B", "4": "E D", "frame": "O E C"}, free="D", redundant=("4 at D",)),
    Machine("wedge of three slides", {"O": (0, 0), "A": (0, 0), "B": (10, 2), "C": (3, 4)},
            {"1": "A C", "2": "B", "frame": "O"},
            (("1", "frame", "A", (1, 0)), ("2", "frame", "B", (0, 1)), ("1", "2", "C", (3, 4))), drive="1/frame",
            redundant=("2 along frame",)),
    Machine("double parallelogram", {"O": (0, 0), "C": (30, 0), "A": (3, 4), "B": (33, 4), "A2": (6, 8), "B2": (36, 8)},
            {"1": "O A A2", "2": "C B B2", "3": "A B", "4": "A2 B2", "frame": "O C"}, free="B2",
            redundant=("4 at B2",)),
    Machine("scissor lift guided once more",
            {"O": (0, 0), "P": (4, 3), "A": (8, 6), "B": (8, 0), "C": (0, 6)},
            {"1": "O P A", "2": "B P C", "3": "B", "4": "C", "5": "A", "frame": "O"},
            (("3", "frame", "B", (1, 0)), ("5", "4", "A", (1, 0)), ("4", "frame", "C", (0, 1))), free="P",
            count=-1, redundant=("3 along frame", "5 along 4")),
    Machine("elliptic trammel with a bar to its middle",
            {"O": (0, 0), "M": (3, 4), "A": (6, 0), "B": (0, 8)},
            {"1": "O M", "2": "A M B", "3": "A", "4": "B", "frame": "O"},
            (("3", "frame", "A", (1, 0)), ("4", "frame", "B", (0, 1))), free="M", redundant=("4 along frame",)),
    Machine("a table on two trammels and a guide",
            {"O": (0, 0), "M": (3, 4), "A": (6, 0), "B": (0, 8),
             "Q": (20, 0), "N": (23, 4), "D": (26, 0), "E": (20, 8)},
            {"1": "O M", "2": "A M B", "3": "A", "5": "Q N", "6": "D N E", "7": "D", "8": "B E", "frame": "O Q"},
            (("3", "frame", "A", (1, 0)), ("7", "frame", "D", (1, 0)), ("8", "frame", "B", (0, 1))), free="N",
            count=-1, redundant=("3 along frame", "7 along frame")),
    Machine("Dixon's nine bars between two lines at right angles",
            {"A": (1, 0), "B": (2, 0), "C": (-3, 0), "D": (0, 2), "E": (0, 5), "G": (0, "-3.5")},
            {"frame": "A D", "1": "A E", "2": "A G", "3": "B D", "4": "B E", "5": "B G", "6": "C D", "7": "C E",
             "8": "C G"},
            free="G", redundant=("8 at G",)),
    Machine("Burmester's focal mechanism", FOCAL,
            {"1": "A K B", "2": "B L C", "3": "C M D", "frame": "D N A",
             "4": "P K", "5": "P L", "6": "P M", "7": "P N"},
            free="L", count=-1, redundant=("6 at P", "7 at P")),
    Machine("a truss of two bars too many on a crank",
            {"O": (0, 0), "C": (9, 0), "A": (3, 4), "B": (10, 7), "D": (5, 9)},
            {"1": "O A", "2": "A B", "3": "C B", "4": "A D", "5": "B D", "6": "A D", "7": "A B", "frame": "O C"},
            count=-1, redundant=("6 at D", "7 at B")),
)
