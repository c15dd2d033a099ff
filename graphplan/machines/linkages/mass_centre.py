"""How every moving link hangs on the frame: one way over joints, by which vectors of links lead to each of its points.

Ways go depth first from the hinge of the first drive's link, so that the links of a loop make one chain from hinge to
hinge, as the textbooks lay off principal vectors; or each link hangs on the nearest hinge, where that takes fewer
vectors. A link that no joints lead to (it slides) hangs loose: a vector of changing length leads there from the first
hinge.

The mass centre of the moving links as a construction, and the shaking force that its acceleration is a measure of.

Principal vectors are laid off head to tail from a fixed hinge. A link's principal vector goes along with the link:
h_i = [m_i s_i + (the mass that hangs on its next joint) l_i]/m, with a part perpendicular to the link where its mass
centre lies off the line of its joints. The vectors are constant on their links, so the steps serve every pose, and laid
off from the pole with the velocities of the points in their places they give the velocity of the mass centre, with the
accelerations its acceleration. The shaking force and moment, what the inertia of all links does to the frame, are in
newtons and newton metres, whatever the scene's units.

Source: Ozols 1974, 16-2, (16.1) to (16.9), figs. 16-4, 16-5 (Fischer's method); the polygon of masses is his (2).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from graphplan.errors import Refused
from graphplan.kernel.kinds import Quantity
from graphplan.kernel.passes import Drawing, Values, record_drawing
from graphplan.kernel.program import Board, Mark, Step
from graphplan.kernel.stages import Stage
from graphplan.machines.tolerances import COINCIDENCE_TOL, VECTOR_TOL
from graphplan.mechanism.model import FRAME, Mass, Number, Pair, Scene
from graphplan.mechanism.numbers import dot, minus, plus, quarter_turn, times
from graphplan.mechanism.units import KILOGRAMS, METRES
from graphplan.methods.panels import MECHANISM
from graphplan.phrases import Said, digits, said


@dataclass(frozen=True)
class Hanging:
    """A moving link with the point at which it hangs, and the link whose point that is, too; empty if it is free."""

    link: str
    at: str
    on: str


@dataclass(frozen=True)
class SpanningTree:
    """The ways from the frame to all moving links of a scene; `hangings` are in an order in which each may be laid."""

    scene: Scene
    hangings: tuple[Hanging, ...]

    @property
    def roots(self) -> tuple[Hanging, ...]:
        """Links with a mass that hang on the frame, or free; the first of all if no link has a mass."""
        roots = [hanging for hanging in self.hangings if hanging.on in ("", FRAME)]
        return tuple(hanging for hanging in roots if self.mass_beyond(hanging.link)) or (roots[0],)

    @property
    def base(self) -> str:
        """The point from which all vectors are laid off: the first hinge."""
        return self.roots[0].at

    @property
    def count(self) -> int:
        """Number of vectors to all masses."""
        return len(self.roots) + sum(1 for hanging in self.hangings if self.mass_beyond(hanging.link))

    @property
    def entry(self) -> dict[str, Hanging]:
        """Suspension of each link, by its name."""
        return {hanging.link: hanging for hanging in self.hangings}

    def hung_on(self, link: str) -> list[Hanging]:
        """Links that hang on a link."""
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
    """Yield these links and all that joints connect to them: depth first if `chained`, else breadth first."""
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


@dataclass(frozen=True)
class PrincipalVector:
    """The vector of one link: `along` times the line from `start` to `end`, and `across` times the same line turned a
    quarter counter-clockwise. `link` is empty where it leads to a further hinge, and has no direction of a link.
    """

    link: str
    start: str
    end: str
    along: Number
    across: Number


@dataclass(frozen=True)
class MassCentre:
    """The construction of a scene's mass centre: `mass` of the moving links in the scene's unit, from which point on
    vectors are laid off, and the drawing, whose roles are S, the heads H of the vectors, and the ends of the polygon
    behind them.
    """

    scene: Scene
    tree: SpanningTree
    mass: Number
    base: str
    vectors: tuple[PrincipalVector, ...]
    drawing: Drawing

    @property
    def masses(self) -> dict[str, Mass]:
        """The masses of the moving links."""
        masses = self.scene.loads.masses if self.scene.loads else {}
        return {link: mass for link, mass in masses.items() if link in self.scene.moving}

    @property
    def points(self) -> tuple[str, ...]:
        """The points that the construction is drawn from, and the mass centres of the links."""
        given_names = (step.name for step in self._given_steps)
        return tuple(dict.fromkeys((*given_names, *(mass.centre for mass in self.masses.values()))))

    @property
    def _given_steps(self) -> Sequence[Step]:
        return self.drawing.program.steps[:self.drawing.program.givens]

    @property
    def values(self) -> Values:
        """The values of the marks in the scene's pose."""
        return self.drawing.mark_values()

    def position_from(self, places: Mapping[str, Any]) -> Any:
        """The mass centre where the points are so: complex arrays of shape (n,) by name.

        Of the velocities of the points it is the velocity of the mass centre, of their accelerations its acceleration.
        """
        from graphplan.kernel.numbers.arrays import Arrays

        inputs = {step.name: {"x": z.real, "y": z.imag} for step in self._given_steps for z in [places[step.name]]}
        (x, y), = self.drawing.mark_values(Arrays(), inputs).values_of_role("S")
        return x + 1j * y


def mass_centre(scene: Scene) -> MassCentre:
    """The construction of a scene's mass centre in its pose.

    Fails with `Refused` where no moving link has a mass.
    """
    if scene.loads is None or not any(mass.mass for link, mass in scene.loads.masses.items() if link in scene.moving):
        raise Refused(f"{scene.name}: masses", "no moving link has a mass, so there is no mass centre",
                      "[masses.2] with mass and centre")
    tree = spanning_tree(scene)
    mass = sum(tree.mass_beyond(root.link) for root in tree.roots)
    vectors = tuple(_vectors(tree, mass))
    return MassCentre(scene, tree, mass, tree.base, vectors, _draw_vectors(scene, tree.base, vectors))


def _vectors(tree: SpanningTree, mass: Number) -> Iterator[PrincipalVector]:
    """The vectors in the order in which they are laid off: to further hinges first, then from link to link."""
    scene = tree.scene
    for root in tree.roots[1:]:
        yield PrincipalVector("", tree.base, root.at, tree.mass_beyond(root.link) / mass, Fraction(0))
    for hanging in tree.hangings:
        start, end = tree.line(hanging.link)
        line = minus(scene.points[end], scene.points[start])
        if start == end:
            continue
        multiples = as_multiple(moments_of_mass(tree, hanging.link), line)
        least = VECTOR_TOL * float(tree.mass_beyond(hanging.link))
        along, across = (multiple / mass if abs(float(multiple)) > least else Fraction(0) for multiple in multiples)
        if along or across:
            yield PrincipalVector(hanging.link, start, end, along, across)


def _draw_vectors(scene: Scene, base: str, vectors: tuple[PrincipalVector, ...]) -> Drawing:
    """The drawing steps: the principal point of each link, and the vectors to them, head to tail."""
    board = Board()
    needed = {base, *(point for vector in vectors for point in (vector.start, vector.end))}
    with board.on(panel=MECHANISM):
        points = {name: board.given(x=x, y=y, name=name) for name, (x, y) in scene.points.items() if name in needed}
    heads, ends = list[Mark](), [points[base]]
    for vector in vectors:
        with board.on(panel=MECHANISM, links=(vector.link,) if vector.link else (), stage=_stage(vector)):
            heads.append(_head(board, vector, points))
            ends.append(board.transfer(points[vector.start], heads[-1], ends[-1], why=laying_reason(vector)))
    board.give_name(ends[-1], "S")
    for vector, head, end in zip(vectors, heads, ends[1:], strict=True):
        board.give_name(head, f"H_{vector.link}" if vector.link else f"H_{vector.end}")
        board.give_name(end, f"S_{vector.link}" if vector.link else f"S_{vector.end}")
    return record_drawing(board, {"S": ends[-1:], "heads": heads, "ends": ends[1:]})


def _head(board: Board, vector: PrincipalVector, points: Mapping[str, Mark]) -> Mark:
    """The principal point of a link: how far along its line, and how far beside it."""
    P, Q = points[vector.start], points[vector.end]
    head, name, line = P, vector.link or vector.end, f"{vector.start}{vector.end}"
    if vector.along:
        text = said("the principal point: h_{0} = {1} {2}", name, digits(float(vector.along), 5), line)
        head = board.step_off(P, Q, P, ratio=vector.along, why=text, quantity=Quantity(f"h_{name}", "length"))
    if vector.across:
        text = said("its offset: xi_{0} = {1} {2}", name, digits(float(vector.across), 5), line)
        head = board.step_across(P, Q, head, ratio=vector.across, why=text, quantity=Quantity(f"xi_{name}", "length"))
    return head


def laying_reason(vector: PrincipalVector) -> Said:
    if not vector.link:
        return said("the mass that hangs on {0}, by their part of the whole", vector.end)
    return said("head to tail, as link {0} is directed", vector.link)


def _stage(vector: PrincipalVector) -> Stage:
    if not vector.link:
        return Stage(said("Further hinge {0}", vector.end), said("the part of the mass that hangs on it"))
    return Stage(said("Principal vector of link {0}", vector.link),
                 said("the link's mass by the distance of its centre, and the masses beyond by the distance of their "
                      "joint, over the whole mass"))


# ---- what shakes the frame ------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Shaking:
    """The inertia forces -m a_S of the links, complex arrays of shape (n,) in N, by link; and the moment of all of them
    with the couples -I alpha about a point `about`, in N m."""

    about: complex
    parts: dict[str, Any]
    moment: Any

    @property
    def force(self) -> Any:
        """The shaking force, the sum of its parts."""
        return sum(self.parts.values())


def shaking(centre: MassCentre, places: Mapping[str, Any], accelerations: Mapping[str, Any],
            alphas: Mapping[str, Any]) -> Shaking:
    """The shaking force and its moment about the hinge from which the principal vectors are laid off, or where that
    moves, about the scene's origin.

    Reads where the mass centres of the links are, how they are accelerated (complex arrays of shape (n,) by point, in
    scene units), and the angular accelerations of the links.
    """
    scene = centre.scene
    about = complex(*map(float, scene.points[centre.base])) if FRAME in scene.links_of[centre.base] else 0j
    long, heavy, components, moment = float(METRES[scene.units.length]), float(KILOGRAMS[scene.units.mass]), {}, 0.0
    for link, mass in centre.masses.items():
        force = -heavy * long * float(mass.mass) * accelerations[mass.centre]
        components[link] = force
        moment = moment + long * ((places[mass.centre] - about).conjugate() * force).imag
        moment = moment - heavy * float(mass.inertia) * alphas[link]
    return Shaking(about, components, moment)
