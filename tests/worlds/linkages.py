"""Random linkages: any graph of links, pins and slides that its drives determine, as the text of a scene.

Nothing is built up from known groups: pairs join links by chance, and what cannot be driven is thrown away. Numbers are
small and whole, so that every pose is rational and points often coincide, lines often are parallel.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from random import Random
from typing import TypeVar

import graphplan as gp

FRAME = "frame"
DIRECTIONS = (1, 0), (0, 1), (3, 4), (-4, 3), (5, -12), (-8, 15)  # their lengths are whole: actuators stay rational


@dataclass
class Linkage:
    """A linkage as it grows: `points` with their places, `links` with their points, pairs and drives as TOML tables."""

    random: Random
    points: dict[str, tuple[int, int]] = field(default_factory=dict)
    links: dict[str, list[str]] = field(default_factory=dict)
    slides: list[str] = field(default_factory=list)
    drives: list[str] = field(default_factory=list)
    guided: list[tuple[str, str]] = field(default_factory=list)
    loads: list[str] = field(default_factory=list)

    def point(self, reach: int) -> str:
        name = f"P{len(self.points)}"
        self.points[name] = self.random.randint(-reach, reach), self.random.randint(-reach, reach)
        return name

    def text(self, order: Random | None = None) -> str:
        """The scene as it is written; `order` shuffles links, points of links, slides, drives and loads."""
        def shuffled(things: list[str]) -> list[str]:
            return order.sample(things, len(things)) if order else things

        links = [f'{link} = "{" ".join(shuffled(points))}"' for link, points in self.links.items()]
        points = [f"{name} = [{x}, {y}]" for name, (x, y) in self.points.items()]
        parts = ['title = "random"', "[points]", *shuffled(points), "[links]", *shuffled(links), *shuffled(self.slides),
                 *shuffled(self.drives), *shuffled(self.loads), '[find]\nvelocity = "all"\nacceleration = "all"']
        return "\n".join(parts) + "\n"


L = TypeVar("L", bound=Linkage)


def linkage(seed: int) -> Linkage:
    """A linkage of 1 to 9 moving links that its drives determine, by the count and as a graph."""
    random = Random(seed)
    freedoms = random.choice((1, 1, 1, 2, 2, 3))
    links = random.choice([k for k in range(1, 10) if (3 * k - freedoms) % 2 == 0 and 3 * k - freedoms >= 2 * k])
    return movable(lambda: _attempt(random, links, freedoms))


def with_points_in_line(seed: int) -> Linkage:
    """A linkage on whose links with three points or more, at least one, the third lies in line with the first two."""
    random = Random(seed)
    while True:
        found = linkage(random.randrange(10**6))
        rows = [points[:3] for link, points in found.links.items() if link != FRAME and len(points) > 2]
        for (one, two, three), times in ((row, random.choice((-1, 2, 3))) for row in rows):
            (x, y), (u, v) = found.points[one], found.points[two]
            found.points[three] = x + times * (u - x), y + times * (v - y)
        with suppress(gp.GraphplanError):
            if rows and gp.solve(gp.parse(found.text(), "in line")):
                return found


def movable(attempt: Callable[[], L | None]) -> L:
    """The first of the attempts that a scene can be made of."""
    while True:
        if (found := attempt()) is not None:
            with suppress(gp.SceneError):
                gp.parse(found.text(), "random")
                return found


def _attempt(random: Random, links: int, freedoms: int) -> Linkage | None:
    """Links, pins and slides by chance, as many as leave the drives their freedoms; None where two pairs join two."""
    moving = [str(k + 1) for k in range(links)]
    count = (3 * links - freedoms) // 2
    found = Linkage(random, links={link: [] for link in (*moving, FRAME)})
    reach, sliding = random.choice((3, 10, 40, 90)), random.choice((0.0, 0.15, 0.3, 0.6))
    pairs = joined(found, moving, count, reach, sliding)
    if pairs is None:
        return None
    for _ in range(freedoms):
        drive(found, pairs, moving)
    return found


def joined(found: Linkage, moving: list[str], count: int, reach: int, sliding: float) -> list[tuple[str, str]] | None:
    """Join all links by so many pins and slides, and give some a point more; None where two pairs would join two."""
    random, pairs = found.random, set[tuple[str, str]]()
    for number in range(count):
        one = moving[number] if number < len(moving) else random.choice(moving)
        before = [FRAME, *moving[:number]] if number < len(moving) else [FRAME, *moving]
        two = random.choice([link for link in before if link != one])
        if (one, two) in pairs or (two, one) in pairs:
            return None
        pairs.add((one, two))
        _slide(found, one, two, reach) if random.random() < sliding else _pin(found, one, two, reach)
    for link in found.links:
        if random.random() < 0.25 or not found.links[link]:
            found.links[link].append(found.point(reach))
    return sorted(pairs)


def _pin(found: Linkage, one: str, two: str, reach: int) -> None:
    """A pin of two links: new, or at a joint that one of them has already."""
    shared = [point for point in found.links[two] if point not in found.links[one]]
    if shared and found.random.random() < 0.2:
        found.links[one].append(found.random.choice(shared))
        return
    point = found.point(reach)
    found.links[one].append(point)
    found.links[two].append(point)


def _slide(found: Linkage, one: str, two: str, reach: int) -> None:
    """A slide of one link along another, at a point of its own or at a joint."""
    one, two = found.random.sample((one, two), 2)
    if one == FRAME:
        one, two = two, one
    if not found.links[one] or found.random.random() < 0.5:
        found.links[one].append(found.point(reach))
    dx, dy = found.random.choice(DIRECTIONS)
    at = found.random.choice(found.links[one])
    found.slides.append(f'[[slides]]\nlink = "{one}"\nalong = "{two}"\nat = "{at}"\ndirection = [{dx}, {dy}]')
    found.guided.append((one, two))


def drive(found: Linkage, pairs: list[tuple[str, str]], moving: list[str]) -> None:
    """A drive of any kind: on the ground, between two links with or without a pair, or of a slide."""
    random = found.random
    rate, change = random.choice((0, 1, 1, 2, -3, 0.5)), random.choice((0, 0, 1, -2, 0.25))
    kind = random.random()
    if found.guided and kind < 0.45:
        one, two = random.choice(found.guided)
        found.drives.append(f'[[drive]]\nslide = ["{one}", "{two}"]\nspeed = {rate}\nacceleration = {change}')
        return
    links = random.choice(pairs) if kind < 0.9 else tuple(random.sample([*moving, FRAME], 2))
    one, two = links if links[0] != FRAME else links[::-1]
    relative = f'\nrelative_to = "{two}"' if two != FRAME else ""
    found.drives.append(f'[[drive]]\nlink = "{one}"\nomega = {rate}\nalpha = {change}{relative}')


def scenes(seed: int, orders: int = 3, made: Callable[[int], Linkage] = linkage) -> Iterator[gp.Scene]:
    """The scene of one seed, as it came and in further orders of writing."""
    found = made(seed)
    for number in range(orders):
        yield gp.parse(found.text(Random(number) if number else None), f"random {seed}")
