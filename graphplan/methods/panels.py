"""The plans of a construction, and how links and pairs are spoken of."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

from graphplan.kernel.program import Panel
from graphplan.mechanism.model import FRAME, Balance, Contact, Gear, Scene, Slide
from graphplan.mechanism.order import by_name
from graphplan.mechanism.replaced import straight
from graphplan.mechanism.sections import MOTION_PLANS
from graphplan.mechanism.structure import general_mobility, mobility
from graphplan.phrases import Said, arrange, join, phrase, said

SHEET_EXTENTS = 10.0  # extents of the mechanism: what is farther from it lies on no sheet

class _MechanismPlan(Panel):
    """The mechanism itself; where only compasses and straightedge draw, all plans lie on it."""

    def caption(self, kinds: Collection[str]) -> Said:
        if not {"part", "reaction", "balance"}.isdisjoint(kinds):
            return said("Mechanism, velocities, accelerations and forces in one plane")
        match "velocity" in kinds, "acceleration" in kinds, "load" in kinds:
            case True, True, _:
                return said("Mechanism, velocities and accelerations in one plane")
            case True, False, True:
                return said("Mechanism plan with orthogonal velocities and loads")
            case True, False, False:
                return said("Mechanism plan with orthogonal velocities")
            case False, _, True:
                return said("Mechanism plan with loads")
        return said("Mechanism plan")


class TrianglePlan(_MechanismPlan):
    """The mechanism with its velocities as they are, each drawn from its point."""

    def caption(self, kinds: Collection[str]) -> Said:
        if kinds and {"acceleration", "load", "part", "reaction", "balance"}.isdisjoint(kinds):
            return said("Mechanism plan with velocity triangles")
        return super().caption(kinds)


MECHANISM = _MechanismPlan("mechanism", said("mechanism plan"))
TRIANGLES = TrianglePlan(str(MECHANISM), MECHANISM.words)
N_PLAN = Panel("N-plan", said("N-plan"), said("N-plan: relative normal accelerations"))
VELOCITY_PLAN = Panel("velocity plan", said("velocity plan"))
ACCELERATION_PLAN = Panel("acceleration plan", said("acceleration plan"))
OF_RATES: dict[str, str] = {  # what a plan is made of, whatever is asked
    VELOCITY_PLAN: "velocity", N_PLAN: "acceleration", ACCELERATION_PLAN: "acceleration"}


class ForcePlan(Panel):
    """The force polygon of a group of `links`; `number` is that of its round of friction, 0 without."""

    links: tuple[str, ...]
    number: int

    @classmethod
    def of_links(cls, links: tuple[str, ...], number: int = 0) -> ForcePlan:
        named, who = "force plan " + ", ".join(links), list_links(links)
        if number > 1:
            plan = cls(f"{named} with friction, round {number}",
                       said("force plan with friction of {0}, round {1}", who, number),
                       said("Force plan with friction, round {1}: {0}", who, number))
        elif number:
            plan = cls(f"{named} with friction", said("force plan with friction of {0}", who),
                       said("Force plan with friction: {0}", who))
        else:
            plan = cls(named, said("force plan of {0}", who), said("Force plan: {0}", who))
        plan.links, plan.number = links, number
        return plan

    @staticmethod
    def names(written: str) -> bool:
        """Whether what a scene writes is meant to name a force plan."""
        return written.startswith("force plan ")

    @property
    def twin(self) -> Panel:
        """The plan of these links without friction: the two are compared."""
        return ForcePlan.of_links(self.links)


@dataclass(frozen=True)
class JointForce:
    """The force at a joint on one of its links, from the others there."""

    point: str
    link: str

    @property
    def name(self) -> str:
        """Name in results, such as `2 at B`."""
        return f"{self.link} at {self.point}"

    @property
    def words(self) -> Said:
        """The link and the joint."""
        return join((_bare(self.link), said("at {0}", self.point)), " ")


class LeverPlan(Panel):
    """A lever of Zhukovsky's: the only one, or that of a balance by its number, or of one part of a reaction."""

    @classmethod
    def of_part(cls, what: JointForce | Slide | int | None = None, part: str = "") -> LeverPlan:
        if what is None:
            return cls("lever", said("lever"), arrange("{0:capital}", said("Zhukovsky's lever")))
        if isinstance(what, int):
            return cls(f"lever {what}", said("lever {0}", what), said("Zhukovsky's lever {0}", what))
        name = f"lever {what.name}, {part}"
        if isinstance(what, Slide):
            whose = join((slide_named(what), part))
            return cls(name, said("lever {0}", whose), said("Zhukovsky's lever {0}", whose))
        force = said("Zhukovsky's lever: the force on {0} at {1}, along {2}", link_named(what.link), what.point, part)
        return cls(name, said("lever {0}", join((what.words, part))), force)


def list_links(links: Sequence[str]) -> Said:
    """Links by name: link 1; links 2 and 3; links 2, 3 and 5; links 4 to 9."""
    if len(links) == 1:
        return link_named(links[0])
    if len(links) > 2 and all(link.isdigit() for link in links):
        numbers = [int(link) for link in links]
        if numbers == list(range(numbers[0], numbers[0] + len(links))):
            return said("links {0} to {1}", links[0], links[-1])
    return said("links {0} and {1}", ", ".join(links[:-1]), links[-1])


def pair_text(links: Sequence[str]) -> Said:
    """The two links of a pair, by name and the frame last: links 2 and 3; link 2 and the frame."""
    moving = sorted((link for link in links if str(link) != FRAME), key=by_name)
    return list_links(moving) if len(moving) == len(links) else said("link {0} and the frame", moving[0])


def link_named(link: str) -> Said:
    """A link by its name, or the frame."""
    return said("the frame") if str(link) == FRAME else said("link {0}", link)


def pole_letter(links: Sequence[str]) -> str:
    """Letter of the pole of two links: with both numbers, 0 for the frame, in their order."""
    return "P_" + link_index(sorted(links, key=lambda link: (str(link) == FRAME, by_name(link))))


def pair_letter(one: str, other: str) -> str:
    """The letter of the force of one link on another."""
    return "R_" + link_index((one, other))


def strand_letters(gear: Gear) -> dict[str, str]:
    """The letters of the tensions of a belt's strands, by their names in results."""
    letter = f"S_{link_index(gear.links)}"
    return dict(zip(gear.strands, (letter, f"{letter}'"), strict=False))


def balance_letter(balance: Balance) -> str:
    """The letter of a balance: of a force, or of that of a pair for a moment."""
    return f"{'F' if balance.at else 'T'}_{balance.link}"


def link_index(links: Sequence[str]) -> str:
    """Links as a letter's index: the frame is 0."""
    names = ["0" if str(link) == FRAME else link for link in links]
    return ("" if all(len(name) == 1 for name in names) else ",").join(names)


def pole_named(scene: Scene, name: str) -> Said:
    """The two links of a pole."""
    one, two = map(link_named, scene.link_pair(name))
    return said("{0} relative to {1}", one, two)


def slide_named(slide: Slide) -> Said:
    """A slide by its links: 3 along 2, or 3 along the frame."""
    return said("{0} along {1}", _bare(slide.link), _bare(slide.along))


def reactions_named(scene: Scene) -> dict[str, Said]:
    """In words, by their names in results, the force on every link of every joint, every slide, gear and contact."""
    forces = (JointForce(point, link) for point in scene.joints for link in scene.links_of[point])
    higher = {pair.name: pair_text(pair.links) for pairs in (scene.gears, scene.contacts) for pair in pairs}
    sides = phrase("{0}, left strand"), phrase("{0}, right strand")
    strands = {strand: side(higher[gear.name]) for gear in scene.gears
               for strand, side in zip(gear.strands, sides, strict=False)}
    slides = {slide.name: slide_named(slide) for slide in scene.slides}
    return {force.name: force.words for force in forces} | higher | strands | slides


def replacements(bars: Mapping[str, Contact]) -> Iterator[Said]:
    """Yield the remarks on bars and blocks that replace contacts."""
    for bar, contact in bars.items():
        links, profile = pair_text(contact.links), straight(contact)
        if profile:
            yield said("the block {0} replaces the contact of {1} at {2}: with it {3} slides along the straight "
                       "profile of {4}", bar, links, contact.at, profile.at, link_named(profile.along))
        else:
            yield said("the bar {0} replaces the contact of {1} at {2}: it joins the centres of curvature {3} and {4}",
                       bar, links, contact.at, *contact.centres)
        if contact.beyond:
            yield said("at {0} a profile of {1} goes on with another curvature: accelerations jump there, and are "
                       "drawn as they are before it", contact.at, links)


def redundancies(scene: Scene) -> Iterator[Said]:
    """Yield the remarks on pairs that special geometry makes redundant, and on indeterminate reactions."""
    named = reactions_named(scene)
    for name in scene.redundant_pairs:
        repeated = dict.fromkeys(
            condition.on if condition.way in ("x", "y") else named[condition.pair]
            for last, conditions in scene.repetitions.items() if last.pair == name for condition in conditions
            if condition.pair != name and (condition.way, condition.on) != (last.way, last.on))
        yield said("{0}: redundant, it repeats what the pairs {1} state; with lengths and directions in general "
                   "position the mobility would be {2}, by special geometry it is {3}", named[name],
                   join(repeated), general_mobility(scene), mobility(scene) + len(scene.redundant))
    if scene.loads and scene.indeterminate_pairs:
        yield said("statically indeterminate, so not drawn: reactions {0}",
                   join(named[pair] for pair in scene.indeterminate_pairs))


def _bare(link: str) -> str:
    """A link's name alone, or the frame."""
    return said("frame") if str(link) == FRAME else link


def motion_plans(scene: Scene) -> tuple[str, ...]:
    """The plans of motion that a scene may have: velocity triangles stand on the lines of centres of its gears."""
    return MOTION_PLANS if scene.gears else MOTION_PLANS[:2]
