"""The mass centre as a joint of dyads added to the linkage, so that the plans of the linkage find its motion.

The principal vectors are carried to the mass centre by parallelograms: each vector turns with its link, so a bar that a
parallelogram keeps parallel to the link leads from the sum of the vectors before it to the next. Of a slider-crank this
is one dyad, of a four-bar three; a last vector that does not turn is left out, as its ends move alike.

Source: Ozols 1974, 16-2, figs. 16-6 and 16-7, of which the text is lost; after the vectors there.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from graphplan.errors import Refused
from graphplan.machines.linkages.mass_centre import Hanging, MassCentre, PrincipalVector
from graphplan.machines.tolerances import COINCIDENCE_TOL
from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.replaced import free_name
from graphplan.mechanism.scene_text import with_keys
from graphplan.phrases import said


@dataclass(frozen=True)
class Dyads:
    """A scene with added dyads, as TOML; the `point` that moves as the mass centre does, and how many dyads there are.
    """

    text: str
    point: str
    count: int


def added_dyads(centre: MassCentre) -> Dyads:
    """The scene with the dyads that carry the principal vectors, asking for the motion of the mass centre.

    Fails with `Refused` where the vectors are those of no chain of links from a hinge of the frame.
    """
    chain = [vector for vector in centre.vectors if FRAME not in centre.scene.turning_alike(vector.link)]
    entry = {"": Hanging("", "", ""), **centre.tree.entry}
    hung = [entry[vector.link].on for vector in chain]
    if not chain or hung != [FRAME, *(vector.link for vector in chain[:-1])]:
        raise Refused(f"{centre.scene.name}: added dyads", said("the principal vectors make no chain from one hinge of "
                      "the frame"), said("the polygon of principal vectors, which serves always"))
    built = _Dyads(centre.scene)
    built.add(chain, [*(entry[vector.link].at for vector in chain), chain[-1].end])
    return Dyads(built.text(), built.last, built.count)


@dataclass
class _Dyads:
    """Adds points and links to a scene."""

    scene: Scene
    places: dict[str, complex] = field(default_factory=dict)
    links: dict[str, list[str]] = field(default_factory=dict)
    last: str = ""
    count: int = 0

    def __post_init__(self) -> None:
        self.places = {name: complex(*map(float, at)) for name, at in self.scene.points.items()}
        self.links = {link: [*points] for link, points in self.scene.links.items()}

    def add(self, chain: list[PrincipalVector], joints: list[str]) -> None:
        """Row by row: the joints of the chain, moved so that the next vector begins where the last one ends."""
        bars, end = [vector.link for vector in chain], joints[0]
        for k, vector in enumerate(chain[:-1]):
            end = self._point(f"H_{vector.link}" if k == 0 else f"S_{vector.link}", end, vector, bars[k])
            if self.coincide(end, joints[k + 1]):
                end = joints[k + 1]
                continue
            joints, bars = self._row(chain, joints, bars, k, end)
        self.last = self._point("S", end, chain[-1], bars[-1])

    def _row(self, chain: list[PrincipalVector], joints: list[str], bars: list[str], k: int,
             end: str) -> tuple[list[str], list[str]]:
        """The chain beyond a joint moved to where a vector ends: a dyad for each of its links.

        Of the last row the last link is as long as its vector.
        """
        step, displacement, new = self.places[end] - self.places[joints[k + 1]], [*joints], [*bars]
        displacement[k + 1] = end
        for j in range(k + 1, len(chain)):
            foot = joints[j + 1]
            if j == k + 1 == len(chain) - 1:
                foot = self._point(f"H_{chain[j].link}" if k == 0 else f"F_{chain[j].link}", joints[j], chain[j],
                                   bars[j])
            head = self.add_point("S" if j == k + 1 == len(chain) - 1 else f"L_{k + 1}{j + 1}",
                                  self.places[foot] + step)
            new[j] = self._bar(chain[j].link, displacement[j], head)
            self._bar(chain[k].link, foot, head)
            displacement[j + 1], self.count = head, self.count + 1
        return displacement, new

    def _point(self, name: str, start: str, vector: PrincipalVector, bar: str) -> str:
        """The end of a principal vector that is laid off from a point of a bar that is parallel to its link."""
        line = self.places[vector.end] - self.places[vector.start]
        place = self.places[start] + complex(vector.along, vector.across) * line
        for point in self.links[bar]:
            if abs(self.places[point] - place) < COINCIDENCE_TOL * self.scene.extent:
                return point
        point = self.add_point(name, place)
        self.links[bar].append(point)
        return point

    def coincide(self, one: str, other: str) -> bool:
        return abs(self.places[one] - self.places[other]) < COINCIDENCE_TOL * self.scene.extent

    def add_point(self, name: str, place: complex) -> str:
        """A new point of this name, with primes where it is taken."""
        name = free_name(name, self.places)
        self.places[name] = place
        return name

    def _bar(self, link: str, start: str, end: str) -> str:
        """A bar that is parallel to a link."""
        name = free_name(link, self.links)
        self.links[name] = [start, end]
        return name

    def text(self) -> str:
        """The scene's text with what was added, asking for the motion of the last point."""
        scene = self.scene
        points = {f'"{name}"': f"[{z.real!r}, {z.imag!r}]" for name, z in self.places.items()
                  if name not in scene.points}
        bare = {link for link in scene.links if re.search(rf"(?m)^[ \t]*{re.escape(link)}[ \t]*=", scene.text)}
        links = {link if link in bare else f'"{link}"': f'"{" ".join(points)}"'
                 for link, points in self.links.items() if points != [*scene.links.get(link, ())]}
        text = with_keys(with_keys(scene.text, "points", points), "links", links)
        asked_points = f'["{self.last}"]'
        return with_keys(text, "find",
                         {"velocity": asked_points, "acceleration": asked_points, "links": "[]", "slides": "[]",
                          **({"reactions": "[]"} if scene.loads else {})})
