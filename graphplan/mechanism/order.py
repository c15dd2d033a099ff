"""The orders of links, points and pairs: by name, and by what they are joined to, the same whatever they are called.

Links by name, the frame last; a link's points as motion passes through them: those on the frame first, then joints with
links before this one, joints with links after it, and the others, each by name; slides and drives by their links.

Links come as motion passes through them, from a drive along each chain to its end. Which chain is first is told by how
far from a drive links and points are and by their pairs, by those of their neighbours, and so on until nothing more
tells two apart (refinement of colours: B. Weisfeiler, A. Leman, 1968). What is alike then, as the halves of a
symmetrical linkage, comes as it lies: links from left to right, points from right to left, and in one place by name.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, TypeVar

from graphplan.errors import Key as Key
from graphplan.errors import by_name as by_name
from graphplan.mechanism.model import FRAME, Contact, Drive, Force, Gear, Loads, Moment, Scene, Slide

Load = TypeVar("Load", Force, Moment)


def sort_scene(scene: Scene) -> Scene:
    """The scene with its links, points, pairs and loads in this order; its balances stay numbered as they are."""
    links = ordered_links(scene)
    higher = (*sorted(scene.gears, key=_by_links), *sorted(scene.contacts, key=_by_links))
    return replace(scene, points={point: scene.points[point] for point in ordered_points(scene)}, links=links,
                   written=(*ordered_slides(scene), *higher, *scene.drives),
                   loads=scene.loads and _ordered_loads(scene.loads))


def without_higher_pairs(scene: Scene) -> Scene:
    """The scene in this order without its higher pairs, where others stand for them."""
    sorted_scene = sort_scene(scene)
    return replace(sorted_scene, written=tuple(pair for pair in sorted_scene.written
                                               if not isinstance(pair, Gear | Contact)))


def _ordered_loads(loads: Loads) -> Loads:
    """The loads by their links, those of one link by their values and points."""
    def key(load: Force | Moment) -> tuple[Key, tuple[float, ...], Key]:
        at, value = (load.at, load.value) if isinstance(load, Force) else ("", (load.value,))
        if load.table is not None:  # so a load is called alike in every pose
            value = *(load.direction or () if isinstance(load, Force) else ()), *load.table.numbers
        return by_name(load.on), tuple(map(float, value)), by_name(at)

    masses = {link: loads.masses[link] for link in sorted(loads.masses, key=by_name)}
    return replace(loads, masses=masses, forces=tuple(sorted(loads.forces, key=key)),
                   moments=tuple(sorted(loads.moments, key=key)),
                   frictions=tuple(sorted(loads.frictions, key=lambda f: (f.links, by_name(f.at)))))


def named_forces(loads: Loads) -> dict[str, Force]:
    """The given forces by their letters: P_2 and P_2' on link 2."""
    return _by_letter("P", _ordered_loads(loads).forces)


def named_moments(loads: Loads) -> dict[str, Moment]:
    """The given moments by their letters: M_2 and M_2' on link 2."""
    return _by_letter("M", _ordered_loads(loads).moments)


def changing_loads(loads: Loads | None) -> dict[str, Force | Moment]:
    """The loads that change over the cycle, by their letters."""
    named: dict[str, Force | Moment] = {**named_forces(loads), **named_moments(loads)} if loads else {}
    return {name: load for name, load in named.items() if load.table}


def with_values(loads: Loads, values: Mapping[str, Any]) -> Loads:
    """The loads, some with other values by their letters: pairs for forces, numbers for moments; or arrays of them."""
    new_values: dict[int, Any] = {id(load): values[name]
                                  for name, load in changing_loads(loads).items() if name in values}

    def with_value(load: Any) -> Any:
        return replace(load, value=new_values[id(load)]) if id(load) in new_values else load

    return replace(loads, forces=tuple(map(with_value, loads.forces)), moments=tuple(map(with_value, loads.moments)))


def _by_letter(letter: str, loads: Sequence[Load]) -> dict[str, Load]:
    """Loads by their letters: that of their link, with a prime where it is taken."""
    links = [load.on for load in loads]
    return {f"{letter}_{load.on}" + "'" * links[:i].count(load.on): load for i, load in enumerate(loads)}


def ordered_links(scene: Scene) -> dict[str, tuple[str, ...]]:
    """Links in order of their names, the frame last; the points of each in the order in which links lead to them."""
    links = sorted(scene.links, key=lambda link: (link == FRAME, by_name(link)))
    rank = {link: -1 if link == FRAME else number for number, link in enumerate(links)}

    def place(link: str, point: str) -> tuple[int, Key]:
        first = min((rank[link_before] for link_before in scene.links_of[point] if link_before != link), default=None)
        if first is None:
            return 3, by_name(point)
        return (0 if first < 0 else 1 if first < rank[link] else 2), by_name(point)

    return {link: tuple(sorted(scene.links[link], key=partial(place, link))) for link in links}


def ordered_points(scene: Scene) -> tuple[str, ...]:
    """The points, link by link; last those that no link has."""
    linked = dict.fromkeys(point for points in ordered_links(scene).values() for point in points)
    return (*linked, *sorted(scene.points.keys() - linked, key=by_name))


def ordered_slides(scene: Scene) -> tuple[Slide, ...]:
    """The slides by their links."""
    return tuple(sorted(scene.slides, key=_by_links))


def ordered_drives(scene: Scene) -> tuple[Drive, ...]:
    """The drives by their links, those of turnings first."""
    return tuple(sorted(scene.drives, key=lambda drive: (drive.slides, _by_links(drive))))


def turning_drives(scene: Scene) -> tuple[Drive, ...]:
    """The drives that prescribe a turning, by their links."""
    return tuple(drive for drive in ordered_drives(scene) if not drive.slides)


def _by_links(pair: Slide | Gear | Contact | Drive) -> tuple[Key, ...]:
    return *map(by_name, pair.links), by_name("" if isinstance(pair, Drive) else pair.name)


PLACE_DIGITS = 9  # beside the mechanism, by which places are told apart: no rounding reaches these
LINK, POINT = 0, 1
Node = tuple[int, str]  # a link or a point, and its name


class StructuralOrder:
    """The places of a scene's links, the frame's last, and of its points."""

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.beside = self._neighbours()
        distances = self._distances()
        natures = {node: (node[0], node[1] == FRAME, distances.get(node, len(self.beside)), len(joined))
                   for node, joined in self.beside.items()}
        alike = self._refine(_ranks(natures))
        self._places = _ranks({node: (alike[node], self._spots(node), by_name(node[1])) for node in self.beside})
        self._links = {link: place for place, link in enumerate(self._along_chains())}

    def link(self, name: str) -> int:
        """The place of a link."""
        return self._links[name]

    def point(self, name: str) -> int:
        """The place of a point."""
        return self._places[POINT, name]

    def links(self) -> dict[str, tuple[str, ...]]:
        """Each link with its points as motion passes through them: those on the frame first, then joints with links
        before this one, joints with links after it, and the others."""
        def turn(link: str, point: str) -> tuple[int, int]:
            others = [self.link(name) for name in self.scene.links_of[point] if name not in (link, FRAME)]
            if FRAME in self.scene.links_of[point] and link != FRAME:
                return 0, self.point(point)
            before = min(others, default=-1) < self.link(link)
            return (3 if not others else 1 if before else 2), self.point(point)

        return {link: tuple(sorted(self.scene.links[link], key=lambda point: turn(link, point)))
                for link in sorted(self.scene.links, key=self.link)}

    def points(self) -> list[str]:
        """The points, link by link; last those that no link has."""
        linked = dict.fromkeys(point for points in self.links().values() for point in points)
        return [*linked, *sorted(self.scene.points.keys() - linked, key=self.point)]

    def slides(self) -> tuple[Slide, ...]:
        """The slides by their links."""
        return tuple(sorted(self.scene.slides, key=self._of_links))

    def drives(self) -> tuple[Drive, ...]:
        """The drives by their links, those of turnings first."""
        return tuple(sorted(self.scene.drives, key=lambda drive: (drive.slides, self._of_links(drive))))

    def _of_links(self, pair: Slide | Drive) -> tuple[Any, ...]:
        at = self.point(pair.at) if isinstance(pair, Slide) else 0
        return *map(self.link, pair.links), at, by_name(getattr(pair, "name", ""))

    def _neighbours(self) -> dict[Node, list[tuple[str, Node]]]:
        """The neighbours of each link and point, each with the kind of connection."""
        scene = self.scene
        beside: dict[Node, list[tuple[str, Node]]] = {(LINK, link): [] for link in (*scene.links, FRAME)}
        beside |= {(POINT, point): [] for point in scene.points}

        def join(how: str, one: Node, two: Node) -> None:
            beside.setdefault(one, []).append((f"{how}, to", two))
            beside.setdefault(two, []).append((f"{how}, from", one))

        for link, points in scene.links.items():
            for point in points:
                join("point", (LINK, link), (POINT, point))
        for pair in scene.written:
            kind, (one, two) = type(pair).__name__, pair.links
            join(kind, (LINK, one), (LINK, two))
            if at := getattr(pair, "at", ""):
                join(f"{kind} at", (LINK, one), (POINT, at))
        return beside

    def _distances(self) -> dict[Node, int]:
        """Number of connections from a drive, or from a point whose motion is given, to each link and point, not
        through the frame."""
        begin = [(LINK, link) for drive in self.scene.drives for link in drive.links if link != FRAME]
        begin += [(POINT, point) for point in self.scene.motions]
        distances = dict.fromkeys(begin, 0)
        waiting = [*distances]
        for node in waiting:
            for _, other in self.beside[node]:
                if other not in distances and other[1] != FRAME:
                    distances[other] = distances[node] + 1
                    waiting.append(other)
        return distances

    def _along_chains(self) -> Iterable[str]:
        """The links, those that are driven first, each followed by the chains that begin at it; the frame last."""
        def earlier(links: Iterable[str]) -> list[str]:
            return sorted(links, key=lambda link: self._places[LINK, link], reverse=True)

        waiting, passed = earlier(link for link in self.scene.links if link != FRAME), dict[str, None]()
        while waiting:
            if (link := waiting.pop()) not in passed:
                passed[link] = None
                waiting += earlier(self._links_beside(link) - passed.keys())
        return *passed, self.scene.frame

    def _links_beside(self, link: str) -> set[str]:
        """The links that share a point or a pair with a link, but for the frame."""
        beside = self.beside[LINK, link]
        nodes = {other for _, (kind, point) in beside if kind == POINT for _, other in self.beside[kind, point]}
        return {name for kind, name in (*nodes, *(node for _, node in beside)) if kind == LINK and name != FRAME}

    def _refine(self, ranks: Mapping[Node, int]) -> Mapping[Node, int]:
        """Tell nodes apart by their neighbours until that tells no more."""
        count = 0
        while count < (count := len({*ranks.values()})) < len(ranks):
            ranks = _ranks({node: (ranks[node], sorted((ranks[other], how) for how, other in joined))
                            for node, joined in self.beside.items()})
        return ranks

    def _spots(self, node: Node) -> list[tuple[float, ...]]:
        """Places of a point or of the points of a link, relative to the extent, sorted."""
        kind, name = node
        extent = float(self.scene.extent) or 1.0
        points, along = (self.scene.links.get(name, ()), extent) if kind == LINK else ((name,), -extent)
        spots = (map(float, self.scene.points[point]) for point in points)
        return sorted((round(x / along, PLACE_DIGITS), round(y / extent, PLACE_DIGITS)) for x, y in spots)


def _ranks(keys: Mapping[Node, Any]) -> dict[Node, int]:
    """The places of nodes in the order of their keys, the same one for equal keys."""
    ranks, last, place = dict[Node, int](), None, -1
    for place_in_order, node in enumerate(sorted(keys, key=keys.__getitem__)):
        if keys[node] != last:
            last, place = keys[node], place_in_order
        ranks[node] = place
    return ranks
