"""Counterweights of a linkage: masses instead of its links, their centre, dyads that are added.

With a = AC and b = CB on the line of two pins, m_A = m b/(a + b) and m_B = m a/(a + b) have the link's mass and its
centre: their forces have the link's resultant, but not its moment, as they leave the moment of inertia I' = I - m a b.
Three masses m_A = I/(a (a + b)), m_B = I/(b (a + b)) and the rest at C have that, too; they need neither the centre's
acceleration nor the link's turning.

Source: O. Ozols, Mehānismu un mašīnu teorija (1974), section 9-2 with fig. 9-5, (9.13), example 9-1; methods A14, A15.

Every point of a linkage is a sum of vectors that turn with its links, so the first moment of mass is one, too: each
link's turning, and each free sliding, with a factor. Where chains close, such sums of vectors are constant; so the mass
centre stands still if its factors are those of closed chains, each times any number, and nothing is left over. That is
linear in the first moments of the counterweights. Of a four-bar linkage it says that the polygon of principal vectors
is similar to that of the links, of a slider-crank that its principal vectors vanish. To move along a guide alone, also
what keeps a slider's point on such a guide may be used.

A link may be given a counterweight if it turns. Those hinged on the frame come first: their counterweights load no
other link. A linkage can be balanced so if joints lead from every link to the frame.

Source: Ozols 1974, 16-3, (16.10) to (16.12), table 16-1; R. S. Berkof and G. G. Lowen, A new method for completely
force balancing simple linkages, 1969; F. R. Tepper and G. G. Lowen, General theorems concerning full force balancing of
planar linkages by internal mass redistribution, 1972.

The principal vectors are carried to the mass centre by parallelograms: each vector turns with its link, so a bar that a
parallelogram keeps parallel to the link leads from the sum of the vectors before it to the next. Of a slider-crank this
is one dyad, of a four-bar three; a last vector that does not turn is left out, as its ends move alike.

Source: Ozols 1974, 16-2, figs. 16-6 and 16-7, of which the text is lost; after the vectors there.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from graphplan.errors import Refused
from graphplan.machines.linkages.mass_centre import Hanging, MassCentre, PrincipalVector, spanning_tree
from graphplan.machines.tolerances import BALANCED_TOL, COINCIDENCE_TOL, FACTOR_TOL, WEIGHT_TOL
from graphplan.mechanism.model import FRAME, Mass, Placement, Scene, Slide
from graphplan.mechanism.replaced import free_name
from graphplan.mechanism.scene_text import with_keys
from graphplan.mechanism.units import KILOGRAMS, METRES
from graphplan.methods.forces.loading import pins_beside
from graphplan.phrases import said


@dataclass(frozen=True)
class ReplacedMass:
    """A link as masses in kg at points: `static` at two pins, which leave `inertia_left` in kg m^2, and `dynamic` at
    the pins and, between them in order, the mass centre."""

    link: str
    pins: tuple[str, str]
    centre: str
    static: tuple[float, float]
    dynamic: tuple[float, float, float]
    inertia_left: float

    def load(self, accelerations: Mapping[str, Any], places: Mapping[str, Any], about: complex, alpha: Any,
             metre: float) -> Iterator[tuple[Any, Any]]:
        """The inertia force of the masses at two pins with the couple of what they leave, and of those at three points:
        in N, each with its moment about a point, in N m."""
        at_two, at_three = zip(self.pins, self.static, strict=True), zip(
            (self.pins[0], self.centre, self.pins[1]), self.dynamic, strict=True)
        for masses, inertia in ((at_two, self.inertia_left), (at_three, 0.0)):
            forces = [(point, -mass * metre * accelerations[point]) for point, mass in masses]
            moment = sum(metre * ((places[point] - about).conjugate() * force).imag for point, force in forces)
            yield sum(force for _, force in forces), moment - inertia * alpha


def replaced_masses(scene: Scene, masses: Mapping[str, Mass]) -> tuple[ReplacedMass, ...]:
    """The links whose mass centre lies on a line of two of their points, beside both, as masses at points."""
    return tuple(_replace(scene, link, mass, pins) for link, mass in masses.items()
                 if link != FRAME and mass.mass and (pins := pins_beside(scene, link, mass)))


def _replace(scene: Scene, link: str, mass: Mass, pins: tuple[str, str]) -> ReplacedMass:
    metre, kilogram = float(METRES[scene.units.length]), float(KILOGRAMS[scene.units.mass])
    A, C, B = (metre * complex(*map(float, scene.points[name])) for name in (pins[0], mass.centre, pins[1]))
    long = abs(B - A)
    a, b = (float(np.real(part * np.conj(B - A))) / long for part in (C - A, B - C))
    m, inertia = kilogram * float(mass.mass), kilogram * float(mass.inertia)
    m_A, m_B = inertia / (a * long), inertia / (b * long)
    return ReplacedMass(link, pins, mass.centre, (m * b / long, m * a / long), (m_A, m - m_A - m_B, m_B),
                        inertia - m * a * b)


MAX_MASS_ROUNDS = 100  # in which the masses of counterweights must settle that load each other's links
RADIUS_FACTORS = (1, 2, 4, 8)  # times the length of the link: radii that are tried where none is given

Form = dict[str, complex]
"""A sum of vectors: of each link that tells how others turn, or of each free sliding, the factor; lengths complex."""


@dataclass(frozen=True)
class Counterweight:
    """A mass on a link, at a `radius` from its `pivot`, in scene units; `moment` is mass times radius, as a complex
    number in the scene's pose."""

    link: str
    pivot: str
    moment: complex
    radius: float

    @property
    def mass(self) -> float:
        """Mass of the counterweight."""
        return abs(self.moment) / self.radius

    def place(self, scene: Scene) -> complex:
        """Place of the counterweight in the scene's pose."""
        return point_of(scene, self.pivot) + self.radius * self.moment / abs(self.moment)


def balance_fully(scene: Scene, keep: Collection[str] = (), radii: Mapping[str, float] | None = None,
         ) -> tuple[Counterweight, ...]:
    """The counterweights with which the mass centre stands still in every pose, as few as will do.

    Reads the links that `keep` their masses, and the radii, in scene lengths, of counterweights; without one it is the
    length of the link. Fails with `Refused` where no counterweights can do it.
    """
    return _Balancing(scene, None).solve(keep, radii or {})


def balance_along_guide(scene: Scene, keep: Collection[str], radii: Mapping[str, float] | None,
                ) -> tuple[Counterweight, ...]:
    """Counterweights that let the mass centre move parallel to the first guide on the frame alone."""
    guide = next((slide for slide in scene.slides if FRAME in slide.links), None)
    if guide is None:
        raise Refused(f"{scene.name}: counterweights", said("no slide is guided on the frame, so there is no direction "
                      "in which the mass centre may move"), "--counterweights full")
    return _Balancing(scene, guide).solve(keep, radii or {})


class _Balancing:
    """The linear conditions of one scene."""

    def __init__(self, scene: Scene, guide: Slide | None):
        self.scene, self.guide, self.tree = scene, guide, spanning_tree(scene)
        self.masses: dict[str, Mass] = scene.loads.masses if scene.loads else {}
        self.turning = {link: next((one for one in (FRAME, *scene.moving) if one in scene.turning_alike(link)), link)
                        for link in scene.moving}
        self.reach = scene.extent

    # ---- sums of vectors ---------------------------------------------------------------------------------------------

    def position_form(self, link: str, point: str) -> Form:
        """Place of a link's point, without its constant part."""
        if link == FRAME:
            return {}
        hanging = self.tree.entry[link]
        form = {f"sliding of {link}": 1 + 0j} if not hanging.on else self.position_form(hanging.on, hanging.at)
        arm = point_of(self.scene, point) - point_of(self.scene, hanging.at)
        return sum_of_forms([(1, form), (1, {self.turning[link]: arm})])

    @property
    def chains(self) -> list[Form]:
        """The sums that are constant as chains close: of each joint as a point of one link less as one of another."""
        closed = [sum_of_forms([(1, self.position_form(joint.links[0], joint.at)), (-1, self.position_form(link,
                                                                                                           joint.at))])
                  for joint in self.scene.revolutes for link in joint.links[1:]]
        return [chain for chain in closed if any(abs(factor) > FACTOR_TOL * self.reach for factor in chain.values())]

    @property
    def guided_forms(self) -> list[Form]:
        """The sums of which the real multiples do not move across the guide."""
        if self.guide is None:
            return []
        ahead, forms = guide_unit(self.guide), list[Form]()
        for slide in self.scene.slides:
            if FRAME in slide.links and slide.link != FRAME:
                turn = (guide_unit(slide) / ahead).conjugate()
                forms.append(sum_of_forms([(turn, self.position_form(slide.link, slide.at))]))
        return forms

    def first_moment(self, weights: Mapping[str, float]) -> Form:
        """The first moment of all masses, and of counterweights with these masses as if in their pivots."""
        terms = [(float(mass.mass), self.position_form(link, mass.centre)) for link, mass in self.masses.items()]
        terms += [(mass, self.position_form(link, self.pivot(link))) for link, mass in weights.items()
                  if not self.is_grounded(link)]
        return sum_of_forms(terms)

    def pivot(self, link: str) -> str:
        """The point of a link about which its counterweight is laid off: on the frame where it is hinged there."""
        hinges = (p for p in self.scene.links[link] if p in self.scene.links.get(FRAME, ()))
        return next(hinges, self.tree.entry[link].at)

    def is_grounded(self, link: str) -> bool:
        """Whether a link is hinged on the frame."""
        return self.pivot(link) in self.scene.links.get(FRAME, ())

    # ---- the conditions ----------------------------------------------------------------------------------------------

    def solve(self, keep: Collection[str], radii: Mapping[str, float]) -> tuple[Counterweight, ...]:
        """The counterweights on as few links as will do."""
        able = [link for link in self.scene.moving if self.turning[link] != FRAME]
        place, moving = f"{self.scene.name}: counterweights", self.scene.moving
        if unknown := next((link for link in keep if link not in moving), ""):
            raise Refused(place, said("there is no moving link {0}", unknown), f"one of {', '.join(moving)}")
        if unable := next((link for link in radii if link not in able), ""):
            raise Refused(place, said("link {0} does not turn", unable), f"one of {', '.join(able)}")
        able = [link for link in able if link not in keep]
        grounded = [link for link in able if self.is_grounded(link)]
        chosen = [*grounded]
        for link in (*(link for link in able if link not in grounded), ""):
            if not self.unbalanced_keys(chosen, {}):
                break
            chosen += [link] if link else []
        if unbalanced := self.unbalanced_keys(chosen, {}):
            raise self.refusal(chosen, unbalanced)
        for link in chosen[::-1]:
            fewer = [one for one in chosen if one != link]
            if not self.unbalanced_keys(fewer, {}):
                chosen = fewer
        return self.settle_masses(chosen, radii)

    def settle_masses(self, links: Sequence[str], radii: Mapping[str, float]) -> tuple[Counterweight, ...]:
        """The counterweights on these links, whose own masses load the links that bear them.

        A link may bear them in vain at its own length: a mass in its next joint loads that. Then the radius is longer.
        """
        for longer in RADIUS_FACTORS:
            radius_of = {link: radii.get(link) or self.length(link) * (1 if self.is_grounded(link) else longer)
                         for link in links}
            weights = dict.fromkeys(links, 0.0)
            for _ in range(MAX_MASS_ROUNDS):
                moments = self.moments(links, weights)[0]
                counterweights = [Counterweight(link, self.pivot(link), moment, radius_of[link])
                                  for link, moment in moments.items()]
                before, weights = weights, {weight.link: weight.mass for weight in counterweights}
                if all(abs(mass - before[link]) <= WEIGHT_TOL * mass for link, mass in weights.items()):
                    return tuple(one for one in counterweights if abs(one.moment) > BALANCED_TOL * self.moment_scale)
        raise Refused(f"{self.scene.name}: counterweights",
                      said("their own masses would need ever larger counterweights"), said("a larger radius"))

    def unbalanced_keys(self, links: Sequence[str], weights: Mapping[str, float]) -> list[str]:
        """Parts of the first moment that counterweights on these links cannot balance, by turnings and slidings."""
        _, remainder = self.moments(links, weights)
        return [key for key, factor in remainder.items() if abs(factor) > BALANCED_TOL * self.moment_scale]

    @property
    def moment_scale(self) -> float:
        """The largest mass times the reach: moments are compared with it."""
        return max((float(mass.mass) for mass in self.masses.values()), default=0.0) * self.reach

    def moments(self, links: Sequence[str], weights: Mapping[str, float]) -> tuple[dict[str, complex], Form]:
        """Fit the static moments of counterweights on these links: mass times arm, complex, in the given pose.

        Also gives the part of the first moment of all masses that they leave unbalanced.
        """
        import numpy as np

        first = self.first_moment(weights)
        keys = [key for key in dict.fromkeys((*first, *(key for chain in self.chains for key in chain),
                                              *(self.turning[link] for link in links))) if not self.is_free(key)]
        freely = [{self.turning[link]: complex(self.reach)} for link in links] + self.chains
        columns = [[sense * form.get(key, 0j) for key in keys] for form in freely for sense in (1, 1j)]
        columns += [[form.get(key, 0j) for key in keys] for form in self.guided_forms]
        right = -np.array([first.get(key, 0j) for key in keys])
        matrix = np.array(columns, dtype=complex).reshape(len(columns), len(keys)).T
        solution = np.linalg.lstsq(real_equations(matrix), real_equations(right), rcond=FACTOR_TOL)[0]
        remainder = matrix @ solution - right
        moments = {link: self.reach * complex(solution[2 * k], solution[2 * k + 1]) for k, link in enumerate(links)}
        return moments, dict(zip(keys, remainder.tolist(), strict=True))

    def is_free(self, key: str) -> bool:
        """Whether a part of the first moment needs no balancing: a constant one, or one along the guide."""
        if key == FRAME:
            return True
        if self.guide is None or not key.startswith("sliding of "):
            return False
        directions = [guide_unit(slide) / guide_unit(self.guide) for slide in self.scene.slides if FRAME in slide.links
                      and key == f"sliding of {slide.link}" and self.turning[slide.link] == FRAME]
        return any(abs(direction.imag) < FACTOR_TOL for direction in directions)

    def length(self, link: str) -> float:
        """The length of a link: how far its farthest joint is from the pivot, or its farthest point."""
        pivot = point_of(self.scene, self.pivot(link))
        points = [p for p in self.scene.links[link] if p in self.scene.joints] or self.scene.links[link]
        far = max(abs(point_of(self.scene, point) - pivot) for point in points)
        return far or max(abs(point_of(self.scene, point) - pivot) for point in self.scene.links[link]) or self.reach

    def refusal(self, links: Sequence[str], left: Sequence[str]) -> Refused:
        """Why it cannot be done: what stays unbalanced."""
        slides = [key.removeprefix("sliding of ") for key in left if key.startswith("sliding of ")]
        place = f"{self.scene.name}: counterweights"
        if slides:
            return Refused(place, said("link {0} slides, and no joints lead from it to the frame: what slides with it "
                                       "cannot be balanced", slides[0]), "--counterweights none, or partial")
        turning = [link for link in self.scene.moving if self.turning[link] in left]
        on = ", ".join(links) or said("no link")
        return Refused(place, said("what turns with {0} cannot be balanced by counterweights on {1}",
                                   ", ".join(turning), on), "fewer links in --keep, or --counterweights partial")


def sum_of_forms(terms: Sequence[tuple[complex, Form]]) -> Form:
    """The sum of so many times these sums."""
    total: Form = {}
    for times, form in terms:
        for key, factor in form.items():
            total[key] = total.get(key, 0j) + times * factor
    return total


def real_equations(numbers: Any) -> Any:
    """Complex equations as twice as many real ones."""
    import numpy as np

    return np.concatenate([numbers.real, numbers.imag])


def point_of(scene: Scene, point: str) -> complex:
    return complex(*map(float, scene.points[point]))


def guide_unit(slide: Slide) -> complex:
    direction = complex(*map(float, slide.direction))
    return direction / abs(direction)


def add_counterweights(scene: Scene, weights: Sequence[Counterweight]) -> Scene:
    """The scene with these counterweights on its links: their masses, mass centres and moments of inertia changed."""
    for weight in weights:
        scene = add_counterweight(scene, weight)
    return scene


def add_counterweight(scene: Scene, weight: Counterweight) -> Scene:
    """The scene with one counterweight."""
    assert scene.loads is not None
    own_mass, weight_place = scene.loads.masses.get(weight.link), weight.place(scene)
    centre, mass, inertia = weight_place, weight.mass, 0.0
    if own_mass is not None:
        own_centre = point_of(scene, own_mass.centre)
        mass += float(own_mass.mass)
        centre = (float(own_mass.mass) * own_centre + weight.mass * weight_place) / mass
        metre = float(METRES[scene.units.length])
        inertia = float(own_mass.inertia) + metre**2 * (float(own_mass.mass) * abs(own_centre - centre) ** 2
                                                        + weight.mass * abs(weight_place - centre) ** 2)
    name = own_mass.centre if own_mass else f"S_{weight.link}"
    while name in scene.points:
        name += "'"
    spot = centre.real, centre.imag
    masses = scene.loads.masses | {weight.link: Mass(mass, inertia, name)}
    return replace(
        scene, points={**scene.points, name: spot}, loads=replace(scene.loads, masses=masses),
        links={**scene.links, weight.link: (*scene.links[weight.link], name)},
        placements={**scene.placements, name: Placement("given", {"at": spot})},
        irrational=(*scene.irrational, f"points.{name}: a mass centre with its counterweight"))


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
