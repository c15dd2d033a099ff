"""Structure: mobility, and the groups of links (Assur groups) through which motion is transferred.

The driven chain falls apart into groups that are solved one after another. A group of two links is a dyad, of class
II; the class of a larger one is the number of sides of its largest closed contour, which is either rigid (a link
with m pairs) or deformable (a loop of links). Its order is the number of its outer pairs, with what moves already.
Links held together by a drive count as one body. A drive between links that no pair joins prescribes their turning
alone: it acts as a fictitious link that slides along both.

Counting freedoms does not tell whether a mechanism is held as it should be: the count can be right while one part is
held twice and another not at all. So the equations are solved for points in general position: what can still move
while all drives stand still is loose; the transposed equations find those that only repeat what others say.

Source: Jaanimets (1966), sections 1-9; Artobolevsky's classes.
"""

from __future__ import annotations

from collections import Counter, defaultdict, deque
from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace
from itertools import pairwise
from typing import Any, NamedTuple

from graphplan.errors import Fault, SceneError, by_name
from graphplan.mechanism.equations import PRIME, Elimination, System, stages, transpose
from graphplan.mechanism.model import FRAME, Drive, Scene
from graphplan.mechanism.order import ordered_links
from graphplan.mechanism.pairs.pair import KinematicPair
from graphplan.mechanism.pairs.revolute import Revolute
from graphplan.phrases import Said, phrase, said

_MODIFICATIONS = ("RRR", "RRP", "RPR", "PRP", "RPP")
"""The dyads, numbered from 1: outer, inner and outer pair, R revolute, P sliding."""


class Group(NamedTuple):
    """Links that are solved together: an Assur group, or a driving link (class I)."""

    links: tuple[str, ...]
    class_: int
    order: int
    kind: str

    @property
    def line(self) -> Said:
        """The group in words."""
        names, class_ = " ".join(self.links), roman(self.class_)
        if self.kind == "follower":
            return said("links that follow by special geometry: {0}", names)
        if self.class_ == 1:
            return said("class I: driving link {0}", names)
        if self.kind.startswith("dyad"):
            form, modification = self.kind.split()[1], _MODIFICATIONS.index(self.kind.split()[1]) + 1
            return said("class {0} group, order {1}: links {2} (dyad {3}, modification {4})", class_, self.order, names,
                        form, modification)
        pattern = phrase("class {0} group, order {1}: links {2} (triad)" if self.kind == "triad"
                         else "class {0} group, order {1}: links {2}")
        return pattern(class_, self.order, names)


class Structure(NamedTuple):
    """A mechanism's mobility and its parts in the order of motion transfer, driving links among them."""

    mobility: int
    parts: tuple[Group, ...]

    @property
    def groups(self) -> tuple[Group, ...]:
        """The Assur groups alone."""
        return tuple(part for part in self.parts if part.class_ > 1)

    @property
    def driving(self) -> tuple[str, ...]:
        """The links that are driven alone."""
        return tuple(link for part in self.parts if part.class_ == 1 for link in part.links)

    @property
    def class_(self) -> int:
        """The mechanism's class: that of its highest group."""
        return max((part.class_ for part in self.parts), default=1)

    def lines(self) -> tuple[Said, ...]:
        """One line for each part, in order, and one for the whole."""
        whole = said("mechanism of class {0}, mobility {1}", roman(self.class_), self.mobility)
        return (*(part.line for part in self.parts), whole)


class _Bond(NamedTuple):
    """A pair of a group: its kind (R, P, or T for a prescribed turning) and its bodies; an outer pair has but one.

    A prescribed turning acts as a `fictitious` link, which is no body of the group.
    """

    kind: str
    bodies: tuple[str, ...]
    fictitious: bool = False


def mobility(scene: Scene) -> int:
    """Chebyshev's count: 3 for each moving link, less what each pair binds; a joint of k links is k - 1 pairs."""
    return 3 * len(scene.moving) - sum(pair.binds * (len(pair.links) - 1) for pair in scene.binding)


def general_mobility(scene: Scene) -> int:
    """The degrees of freedom that the scene's pairs leave its links with points and guides in general position."""
    system = System(replace(scene, motions={}, repetitions={}))
    columns = {unknown: j for j, unknown in enumerate(system.unknowns)}
    rows = [{columns[unknown]: c for unknown, c in equation.terms.items()} for equation in system.pairs]
    return len(columns) - len(rows) + len(Elimination(rows, len(columns), PRIME).dependent)


def structure(scene: Scene) -> Structure:
    """The scene's mobility and groups; a :class:`SceneError` where its drives do not determine its motion."""
    hold = bracing(scene)
    if not hold.sound:
        fault = Fault("links", f"links {' '.join(hold.loose)} are loose", "drives and pairs that hold each link once")
        raise SceneError(scene.name, (fault,))
    system = System(scene)
    links = [[name for sort, name in stage if sort == "link"] for stage in stages(system)]
    order = {link: i for i, link in enumerate(ordered_links(scene))}
    teams = [tuple(sorted(team, key=order.__getitem__)) for team in links if team]
    surroundings = _Surroundings(scene, system.given_points, {link: i for i, team in enumerate(teams) for link in team})
    return Structure(mobility(scene) + len(scene.redundant), tuple(_group(surroundings, team) for team in teams))


def _group(around: _Surroundings, links: tuple[str, ...]) -> Group:
    """Classify the group that links form."""
    body = around.bodies(links)
    bonds = tuple(around.bonds(links, body))
    bodies = dict.fromkeys([*body.values(), *(body_name for bond in bonds for body_name in bond.bodies)])
    outer = [bond for bond in bonds if len(bond.bodies) == 1]
    if len(bodies) == 1:
        outer_pairs = len([bond for bond in outer if bond.kind != "T"])
        return Group(links, 1, outer_pairs, "driving link") if around.is_driven(links) else Group(links, 0, outer_pairs,
                                                                                                  "follower")
    first, *last = sorted((bond.kind for bond in outer), reverse=True)
    form = "".join([first, *(bond.kind for bond in bonds if len(bond.bodies) > 1), *last])
    if len(bodies) == 2 and form in _MODIFICATIONS:  # another form has a pair that special geometry has made redundant
        return Group(links, 2, 2, f"dyad {form} (modification {_MODIFICATIONS.index(form) + 1})")
    sides = _sides(bonds)
    real = len(bodies) + sum(bond.fictitious for bond in bonds)
    triad = (real, sides, len(outer)) == (4, 3, 3)
    return Group(links, sides, len(outer), "triad" if triad else f"class {roman(sides)} group")


def _sides(bonds: tuple[_Bond, ...]) -> int:
    """The number of sides of the largest contour, rigid or deformable."""
    pairs: dict[str, int] = defaultdict(int)
    graph: dict[Node, set[Node]] = defaultdict(set)
    for i, bond in enumerate(bonds):
        for body in bond.bodies:
            pairs[body] += 1
            if len(bond.bodies) < 2:  # an outer pair is in no loop
                continue
            fictitious = [("pair", i, body), ("fictitious", i)]  # the link has a pair with each of the two
            for node, neighbour in pairwise([("body", body), *(fictitious if bond.fictitious else [("pair", i)])]):
                graph[node].add(neighbour)
                graph[neighbour].add(node)
    loops = (length // 2 for length in loop_lengths(graph))  # every other node of a loop is a link
    return max(*pairs.values(), *loops, 2)


class _Surroundings:
    """The surroundings of a group: the pairs of each link, and the order in which links move."""

    def __init__(self, scene: Scene, known: frozenset[str], stage: Mapping[str, int]):
        self.scene, self.known, self.stage = scene, known, stage
        self.pairs: dict[str, list[KinematicPair]] = defaultdict(list)
        for pair in scene.written:
            for link in pair.links:
                self.pairs[link].append(pair)
        self.dropped = Counter((condition.link, condition.on) for condition in scene.redundant)
        self.lost = Counter(condition.pair for condition in scene.redundant)
        self.first = {point: min((stage[link] for link in links if link != FRAME and self._is_held(link, point)),
                                 default=-1) for point, links in scene.links_of.items()}

    def _is_held(self, link: str, point: str) -> bool:
        """Whether a joint holds a link, at least in one way."""
        return self.dropped[link, point] < Revolute.binds

    def _drives(self, links: tuple[str, ...]) -> list[Drive]:
        """The drives of these links."""
        return list(dict.fromkeys(pair for link in links for pair in self.pairs[link] if isinstance(pair, Drive)))

    def is_driven(self, links: tuple[str, ...]) -> bool:
        """Whether a drive prescribes how these links move, or a given motion."""
        led = any(point in self.scene.motions for link in links for point in self.scene.links[link])
        return led or any(end == FRAME or self.stage[end] <= self.stage[links[0]] for drive in self._drives(links)
                          for end in set(drive.links) - set(links))

    def bodies(self, links: tuple[str, ...]) -> dict[str, str]:
        """For each link, the first link of the body that it forms with those that a drive at a common pair holds to it.
        """
        body = {link: link for link in links}
        for drive in self._drives(links):
            first, second = drive.links
            joined = drive.slides or set(self.scene.links.get(first, ())) & set(self.scene.links.get(second, ()))
            if joined and first in links and second in links:
                joint_body, lost = body[first], body[second]
                body.update((link, joint_body) for link in links if body[link] == lost)
        return body

    def bonds(self, links: tuple[str, ...], body: Mapping[str, str]) -> Iterator[_Bond]:
        """The pairs of a group: its inner ones, and the outer ones with what moves already."""
        now = self.stage[links[0]]
        for point in dict.fromkeys(point for link in links for point in self.scene.links[link]):
            holders = [link for link in self.scene.links_of[point] if link in body and self._is_held(link, point)]
            bodies = tuple(dict.fromkeys(body[link] for link in holders))
            if point in self.known or self.first[point] < now:
                yield from (_Bond("R", (body_name,)) for body_name in bodies)
            elif len(bodies) > 1:
                yield _Bond("R", bodies)
        near = dict.fromkeys(pair for link in links for pair in self.pairs[link])
        for pair in sorted(near, key=lambda pair: pair.binds, reverse=True):
            bodies = tuple(dict.fromkeys(body[link] for link in pair.links if link in body))
            within_one_body = len(bodies) == 1 and all(link in body for link in pair.links)
            before = all(link == FRAME or self.stage[link] <= now for link in pair.links)
            binds = self.lost[getattr(pair, "name", "")] < pair.binds
            if not (pair.letter and binds and before) or within_one_body:
                continue
            if len(pair.letter) == 1:
                yield _Bond(pair.letter, bodies, isinstance(pair, Drive))
            else:
                between = f"between {' '.join(pair.links)}"
                yield from (_Bond(kind, (between, *([body[link]] if link in body else [])))
                            for kind, link in zip(pair.letter, pair.links, strict=True))


# --- contours: the closed loops of a group, of which the largest gives its class -----------------------------------

Node = Any
Graph = Mapping[Node, Collection[Node]]
"""Each node with its neighbours."""


def loop_lengths(graph: Graph) -> list[int]:
    """The numbers of edges of the loops in a smallest set of independent ones, shortest first (Horton 1987)."""
    edges = {edge: i for i, edge in enumerate({frozenset((a, b)): None for a in graph for b in graph[a]})}
    lengths: list[int] = []
    independent: dict[int, int] = {}  # loops as sets of edges, in binary, by their highest edge
    for length, loop in sorted(_candidates(graph, edges)):
        while loop and loop.bit_length() in independent:
            loop ^= independent[loop.bit_length()]
        if loop:
            independent[loop.bit_length()] = loop
            lengths.append(length)
    return lengths


def _candidates(graph: Graph, edges: Mapping[frozenset[Node], int]) -> Iterator[tuple[int, int]]:
    """From each branching node and each edge, the loop that two shortest paths close: length and edges."""
    branching = [node for node in graph if len(graph[node]) > 2]
    for root in branching or graph:
        paths = {root: 0}
        queue = deque([root])
        while queue:
            node = queue.popleft()
            for neighbour in graph[node]:
                step = 1 << edges[frozenset((node, neighbour))]
                if neighbour not in paths:
                    paths[neighbour] = paths[node] | step
                    queue.append(neighbour)
        for edge, i in edges.items():
            a, b = edge
            if a in paths:
                loop = paths[a] ^ paths[b] ^ (1 << i)
                if loop:
                    yield loop.bit_count(), loop


def roman(number: int) -> str:
    """A number in Roman numerals."""
    numerals = ((100, "C"), (90, "XC"), (50, "L"), (40, "XL"), (10, "X"), (9, "IX"), (5, "V"), (4, "IV"), (1, "I"))
    text = ""
    for value, letters in numerals:
        text += letters * (number // value)
        number %= value
    return text


# --- how links are held ----------------------------------------------------------------------------------------------


class Bracing(NamedTuple):
    """The links that can move though every drive stands still, and the links that are held more than once."""

    loose: tuple[str, ...]
    overbraced: tuple[str, ...]

    @property
    def sound(self) -> bool:
        """Whether the drives determine the motion, each link's once."""
        return not self.loose and not self.overbraced


def bracing(scene: Scene, balanced: bool = False) -> Bracing:
    """Find the links that are free and those that are held more than once, with drives or with balances in their
    place."""
    system = System(scene, balanced)
    columns = {unknown: j for j, unknown in enumerate(system.unknowns)}
    rows = [{columns[unknown]: c for unknown, c in equation.terms.items()} for equation in system.equations]
    elimination = Elimination(rows, len(columns), PRIME)
    loose = {system.unknowns[j][0][1] for j in elimination.free}
    proofs = Elimination(transpose(rows, len(columns)), len(rows), PRIME) if elimination.dependent else None
    repeated = [system.equations[i].fact for i in (proofs.free if proofs else ())]
    overbraced = {link for fact in repeated for link in (fact.link, fact.on)}
    return Bracing(*(tuple(sorted(links.intersection(scene.moving), key=by_name)) for links in (loose, overbraced)))
