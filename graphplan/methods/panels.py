"""The plans by name: how the panels of a construction are spoken of, and what stands over them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from graphplan.mechanism.model import FRAME, Scene, Slide
from graphplan.phrases import Said, arranged, joined, phrase, said

MECHANISM, LEVER, FRICTION, FORCE_PLAN = "mechanism", "lever", " with friction", "force plan "
PLANS = {
    MECHANISM: phrase("mechanism plan"), "N-plan": phrase("N-plan"), "velocity plan": phrase("velocity plan"),
    "acceleration plan": phrase("acceleration plan"), LEVER: phrase("lever"),
}  # fmt: skip


def spoken(panel: str) -> Said:
    """How a plan is spoken of among the steps."""
    if panel.startswith(FORCE_PLAN):
        number, links = _round(panel), listed(_links(panel))
        if number > "1":
            return said("force plan with friction of {0}, round {1}", links, number)
        return phrase("force plan with friction of {0}" if number else "force plan of {0}")(links)
    if panel.startswith(f"{LEVER} "):
        return said("lever {0}", _whose(panel.removeprefix(f"{LEVER} ")))
    name, _, part = panel.partition(", part ")
    plan = PLANS[name]() if name in PLANS else arranged("{0}", name)
    return said("{0}, part {1}", plan, part) if part else plan


def caption(panel: str, kinds: Collection[str]) -> Said:
    """What a plan is; `kinds` are the kinds of vector drawn on it."""
    if panel == MECHANISM:
        return _over_the_mechanism(kinds)
    if panel == "N-plan":
        return said("N-plan: relative normal accelerations")
    if panel.startswith(FORCE_PLAN):
        number, links = _round(panel), listed(_links(panel))
        if number > "1":
            return said("Force plan with friction, round {1}: {0}", links, number)
        return phrase("Force plan with friction: {0}" if number else "Force plan: {0}")(links)
    if panel == LEVER:
        return arranged("{0:capital}", said("Zhukovsky's lever"))
    if panel.startswith(f"{LEVER} "):
        return _served(panel.removeprefix(f"{LEVER} "))
    return arranged("{0:capital}", spoken(panel))


def _over_the_mechanism(kinds: Collection[str]) -> Said:
    """What the mechanism's plan shows; where only compasses and straightedge draw, all plans lie on it."""
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


def _whose(what: str) -> Said:
    """What a lever serves, in short: a balance by its number, or a reaction, as `2 at B, x` or `3 along 2, M`."""
    site, _, part = what.rpartition(", ")
    whose = sliding if " along " in site else acting
    return joined((whose(site), part)) if site else arranged("{0}", what)


def _served(what: str) -> Said:
    """Which lever of several: that of a balance, by number, or of a reaction, such as `2 at B, x`."""
    if " at " not in what:
        return said("Zhukovsky's lever {0}", _whose(what))
    link, _, place = what.partition(" at ")
    point, _, axis = place.rpartition(", ")
    return said("Zhukovsky's lever: the force on {0} at {1}, along {2}", link_named(link), point, axis)


def rubbing(number: int) -> str:
    """What a force plan's name ends with in a round of friction; the first is but named so."""
    return "" if not number else FRICTION if number == 1 else f"{FRICTION}, round {number}"


def smooth(panel: str) -> str:
    """The plan without friction of the same links."""
    return panel.partition(FRICTION)[0]


def _links(panel: str) -> list[str]:
    return smooth(panel).removeprefix(FORCE_PLAN).split(", ")


def _round(panel: str) -> str:
    """Which round of friction a force plan is of."""
    _, rubs, number = panel.partition(FRICTION)
    return number.removeprefix(", round ") or ("1" if rubs else "")


def listed(links: Sequence[str]) -> Said:
    """Links by name: link 1; links 2 and 3; links 2, 3 and 5; links 4 to 9."""
    if len(links) == 1:
        return link_named(links[0])
    if len(links) > 2 and all(link.isdigit() for link in links):
        numbers = [int(link) for link in links]
        if numbers == list(range(numbers[0], numbers[0] + len(links))):
            return said("links {0} to {1}", links[0], links[-1])
    return said("links {0} and {1}", ", ".join(links[:-1]), links[-1])


def link_named(link: str) -> Said:
    """A link by its name, or the frame."""
    return said("the frame") if link == FRAME else said("link {0}", link)


def slide_named(slide: Slide) -> Said:
    """A slide by its links: 3 along 2, or 3 along the frame."""
    return sliding(slide.name)


def sliding(name: str) -> Said:
    """A slide by its name in results, such as `3 along frame`."""
    link, _, guide = name.partition(" along ")
    return said("{0} along {1}", _bare(link), _bare(guide))


def acting(name: str) -> Said:
    """The link and the joint of a reaction by its name in results, such as `2 at B`."""
    link, _, point = name.rpartition(" at ")
    return joined((_bare(link), said("at {0}", point)), " ")


def redundancies(scene: Scene) -> Iterator[Said]:
    """What is said of the pairs that special geometry makes redundant, and of the reactions that it leaves untold."""
    for pair in scene.redundant_pairs:
        yield said("{0}: redundant, it repeats what the other pairs state; by special geometry the mechanism moves",
                   _named(pair))
    if scene.loads and scene.indeterminate_pairs:
        yield said("statically indeterminate, so not drawn: reactions {0}",
                   joined(map(_named, scene.indeterminate_pairs)))


def _named(pair: str) -> Said:
    """A pair by its name in results."""
    return sliding(pair) if " along " in pair else acting(pair)


def _bare(link: str) -> str:
    """A link's name alone, or the frame."""
    return said("frame") if link == FRAME else link
