"""Random mechanisms of known solvability: Assur groups added one after another to a crank, as texts of scenes.

Coordinates are small integers, so that every pose is rational; `Builder` only makes names, links and slides.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from random import Random

import graphplan as gp

FRAME = "frame"
TRIES = 100  # of a mechanism of the same groups, until no part of it is braced and none loose


class Builder:
    """A mechanism that grows by groups; every group leaves joints that later groups may hang on."""

    def __init__(self, random: Random):
        self.random = random
        self.points: dict[str, tuple[int, int]] = {}
        self.links: dict[str, list[str]] = {FRAME: []}
        self.slides: list[str] = []
        O, A = self.point(FRAME), self.point()
        self.crank = self.link(O, A)

    def point(self, *links: str) -> str:
        """A new point at a place of its own, on these links."""
        name = f"P{len(self.points)}"
        while True:
            place = self.random.randint(-40, 40), self.random.randint(-40, 40)
            if place not in self.points.values():
                break
        self.points[name] = place
        for link in links:
            self.links[link].append(name)
        return name

    def link(self, *points: str) -> str:
        name = str(len(self.links))
        self.links[name] = list(points)
        return name

    def outer(self) -> str:
        """A point to hang on: a new one on any link, or a joint that is there already."""
        link = self.random.choice(list(self.links))
        if self.links[link] and self.random.random() < 0.4:
            return self.random.choice(self.links[link])
        return self.point(link)

    def slide(self, link: str, along: str, at: str) -> None:
        direction = [self.random.randint(1, 9), self.random.randint(-9, 9)]
        self.slides.append(f'[[slides]]\nlink = "{link}"\nalong = "{along}"\nat = "{at}"\ndirection = {direction}')

    def carrier(self, *but: str) -> str:
        """A link to slide along, or to hang on."""
        return self.random.choice([link for link in self.links if link not in but])

    def text(self) -> str:
        """The scene, driven at the crank, which asks for the motion of all points that are not fixed."""
        points = [p for p in self.points if p not in self.links[FRAME]]
        omega, alpha = self.random.choice([1, 2, -3]), self.random.randint(-2, 2)
        asked = ", ".join(f'"{point}"' for point in points)
        return "\n".join([
            'title = "random"', "[points]", *(f"{name} = {[*place]}" for name, place in self.points.items()),
            "[links]", *(f'{link} = "{" ".join(own)}"' for link, own in self.links.items()), *self.slides,
            f'[[drive]]\nlink = "{self.crank}"\nomega = {omega}\nalpha = {alpha}',
            f"[find]\nvelocity = [{asked}]\nacceleration = [{asked}]"]) + "\n"


def rrr(b: Builder) -> None:
    """Dyad, modification 1."""
    A, B, C = b.outer(), b.outer(), b.point()
    b.link(A, C)
    b.link(C, B)


def rrp(b: Builder) -> None:
    """Dyad, modification 2: an outer pair slides."""
    guide, A, B = b.carrier(), b.outer(), b.point()
    b.link(A, B)
    b.slide(b.link(B), guide, B)


def rpr(b: Builder) -> None:
    """Dyad, modification 3: the inner pair slides."""
    A, B = b.outer(), b.outer()
    block = b.link(A)
    b.slide(block, b.link(B), A)


def prp(b: Builder) -> None:
    """Dyad, modification 4: both outer pairs slide."""
    one, two, B = b.carrier(), b.carrier(), b.point()
    b.slide(b.link(B), one, B)
    b.slide(b.link(B), two, B)


def rpp(b: Builder) -> None:
    """Dyad, modification 5: the inner pair and an outer one slide."""
    guide, A = b.carrier(), b.outer()
    block = b.link(A)
    B = b.point()
    rod = b.link(B)
    b.slide(block, rod, A)
    b.slide(rod, guide, B)


def triad(b: Builder) -> None:
    """Class III: a ternary link on three bars."""
    outer = [b.outer() for _ in range(3)]
    base = [b.point() for _ in range(3)]
    b.link(*base)
    for one, two in zip(outer, base, strict=True):
        b.link(one, two)


def sliding_triad(b: Builder) -> None:
    """Class III with a slider for one of the bars."""
    guide, outer, base = b.carrier(), [b.outer() for _ in range(2)], [b.point() for _ in range(3)]
    b.link(*base)
    for one, two in zip(outer, base, strict=False):
        b.link(one, two)
    b.slide(b.link(base[2]), guide, base[2])


def class_four(b: Builder) -> None:
    """Class IV: two ternary links joined by two bars."""
    A, B = b.outer(), b.outer()
    D, F, G, E = (b.point() for _ in range(4))
    b.link(A, D, F)
    b.link(B, G, E)
    b.link(D, G)
    b.link(F, E)


def rosenauer(b: Builder) -> None:
    """Two ternary links sharing a joint, on four bars."""
    K, L, M, N = (b.outer() for _ in range(4))
    A, B, C, D, E = (b.point() for _ in range(5))
    b.link(A, B, C)
    b.link(C, D, E)
    for outer, inner in ((K, A), (L, B), (M, D), (N, E)):
        b.link(outer, inner)


GROUPS: dict[str, Callable[[Builder], None]] = {
    group.__name__: group for group in (rrr, rrp, rpr, prp, rpp, triad, sliding_triad, class_four, rosenauer)
}


def mechanism_text(groups: list[str], seed: int) -> str:
    """A crank with these groups added in turn; the first of some that its drive determines."""
    random = Random(seed)
    for _ in range(TRIES):
        builder = Builder(random)
        for group in groups:
            GROUPS[group](builder)
        with suppress(gp.SceneError):
            return gp.parse(builder.text(), "random").text
    raise LookupError(f"no mechanism of {groups} by seed {seed}")


def mechanism(groups: list[str], seed: int) -> gp.Scene:
    """The same as a scene."""
    return gp.parse(mechanism_text(groups, seed), "random")
