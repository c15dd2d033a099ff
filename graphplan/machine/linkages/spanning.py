"""How every moving link hangs on the frame: one way over joints, by which vectors of links lead to each of its points.

Ways go depth first from the hinge of the first drive's link, so that the links of a loop make one chain from hinge to
hinge, as the textbooks lay off principal vectors; or each link hangs on the nearest hinge, where that takes fewer
vectors. A link that no joints lead to (it slides) hangs loose: a vector of changing length leads there from the first
hinge.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from graphplan.machine.tolerances import COINCIDENCE_TOL
from graphplan.mechanism.model import FRAME, Number, Pair, Scene
from graphplan.mechanism.numbers import dot, minus, plus, quarter_turn, times


@dataclass(frozen=True)
class Hanging:
    """A moving link: the point at which it hangs, and the link whose point that is, too; none where it hangs loose."""

    link: str
    at: str
    on: str


@dataclass(frozen=True)
class SpanningTree:
    """The ways from the frame to all moving links of a scene; `hangings` are in an order in which each may be laid."""

    scene: Scene
    hangings: tuple[Hanging, ...]

    @cached_property
    def roots(self) -> tuple[Hanging, ...]:
        """What hangs on the frame, or loose, and bears a mass; the first of all where nothing does."""
        roots = [hanging for hanging in self.hangings if hanging.on in ("", FRAME)]
        return tuple(hanging for hanging in roots if self.mass_beyond(hanging.link)) or (roots[0],)

    @property
    def base(self) -> str:
        """The point from which all vectors are laid off: the first hinge."""
        return self.roots[0].at

    @property
    def count(self) -> int:
        """How many vectors lead to all masses."""
        return len(self.roots) + sum(1 for hanging in self.hangings if self.mass_beyond(hanging.link))

    @cached_property
    def entry(self) -> dict[str, Hanging]:
        """How each link hangs, by its name."""
        return {hanging.link: hanging for hanging in self.hangings}

    def hung_on(self, link: str) -> list[Hanging]:
        """What hangs on a link."""
        return [hanging for hanging in self.hangings if hanging.on == link]

    def mass_beyond(self, link: str) -> Number:
        """The mass of a link and of all that hangs on it, in the scene's unit."""
        masses = self.scene.loads.masses if self.scene.loads else {}
        own_mass: Number = masses[link].mass if link in masses else 0
        return own_mass + sum(self.mass_beyond(hanging.link) for hanging in self.hung_on(link))

    def line(self, link: str) -> tuple[str, str]:
        """The two points that a link's vectors are multiples of: where it hangs, and the next joint, or a point apart.

        Both are the same where all points of the link coincide.
        """
        scene, start = self.scene, self.entry[link].at
        masses = scene.loads.masses if scene.loads else {}
        centre = [masses[link].centre] if link in masses else []
        joints = [p for p in scene.links[link] if p in scene.joints]
        ends = [*(hanging.at for hanging in self.hung_on(link)), *joints, *centre, *scene.links[link]]
        x, y = map(float, scene.points[start])
        least = COINCIDENCE_TOL * scene.extent
        apart = (end for end in ends if math.dist((x, y), map(float, scene.points[end])) > least)
        return start, next(apart, start)


def spanning_tree(scene: Scene) -> SpanningTree:
    """The ways to all moving links of a scene that take the fewest vectors; in chains, where as few do."""
    trees = (SpanningTree(scene, tuple(_hangings(scene, chained))) for chained in (True, False))
    return min(trees, key=lambda tree: tree.count)


def _hangings(scene: Scene, chained: bool) -> Iterator[Hanging]:
    reached, frame = {FRAME}, scene.links.get(FRAME, ())
    driven = [link for drive in scene.drives for link in drive.links if link != FRAME]
    order = [*dict.fromkeys((*driven, *scene.moving))]
    fixed = [Hanging(link, point, FRAME) for link in order for point in scene.links[link] if point in frame]
    loose = [Hanging(link, point, "") for point in scene.motions for link in scene.links_of[point]]
    loose += [Hanging(slide.link, slide.at, "") for slide in scene.slides if slide.link != FRAME]
    loose += [Hanging(link, scene.links[link][0], "") for link in order]
    for first in ([hanging] for hanging in (*fixed, *loose)) if chained else (fixed, *([one] for one in loose)):
        yield from hang_from(scene, first, reached, chained)


def hang_from(scene: Scene, first: list[Hanging], found: set[str], chained: bool) -> Iterator[Hanging]:
    """These links and all that joints lead to from them: `chained` depth first, else the nearest first."""
    queue = first[::-1]
    while queue:
        hanging = queue.pop()
        if hanging.link in found:
            continue
        found.add(hanging.link)
        yield hanging
        points = [point for point in scene.links[hanging.link] if point not in scene.links.get(FRAME, ())]
        more = [Hanging(link, point, hanging.link) for point in points for link in scene.links_of[point]]
        queue = [*queue, *more[::-1]] if chained else [*more[::-1], *queue]


def as_multiple(vector: Pair, of: Pair) -> Pair:
    """A vector as so many times another one, and so many times that one turned a quarter counter-clockwise."""
    square = dot(of, of)
    return dot(vector, of) / square, dot(vector, quarter_turn(of)) / square


def moments_of_mass(tree: SpanningTree, link: str) -> Pair:
    """The first moment, in the scene's mass times length, of a link and of all that hangs on it, about where it hangs.

    What hangs on it counts as masses in its joints.
    """
    scene, start = tree.scene, tree.entry[link].at
    masses = scene.loads.masses if scene.loads else {}
    total: Pair = (0, 0)
    for point, mass in (*((masses[link].centre, masses[link].mass) for _ in (0,) if link in masses),
                        *((hanging.at, tree.mass_beyond(hanging.link)) for hanging in tree.hung_on(link))):
        total = plus(total, times(mass, minus(scene.points[point], scene.points[start])))
    return total
