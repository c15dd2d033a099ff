"""Checks: what can be said against a scene only when all of it is known.

Points that nothing uses, joints of a link that coincide, links that hang on nothing, gears without an arm, and a motion
that the drives determine twice or not at all. What a scene may well say, and is more often a slip of the pen, is asked.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import combinations, islice
from typing import Any

from graphplan.errors import Fault, by_name
from graphplan.mechanism.equations import PRIME, Elimination, System
from graphplan.mechanism.items import Faults, quote_key
from graphplan.mechanism.model import FRAME, Contact, Drive, Gear, Pair, Scene
from graphplan.mechanism.numbers import exactly, is_exact, number_text
from graphplan.mechanism.order import ordered_links
from graphplan.mechanism.structure import Bracing, bracing, mobility
from graphplan.mechanism.tolerances import COINCIDENCE_TOL
from graphplan.mechanism.units import METRES

MAX_PIVOT_SETS, MAX_PIVOT_SUGGESTIONS = 200, 3  # sets of points, in a scene with many loose ends


def check_use(scene: Scene, elsewhere: Collection[str], faults: Faults) -> None:
    """Every point is a point of a link, or serves to place a point or to give a direction."""
    for point, links in scene.links_of.items():
        if not links and point not in elsewhere:
            faults.add(f"points.{quote_key(point)}", "no link has this point", "name it in a link, or remove it")


def check_joints(scene: Scene, placed: Mapping[str, Pair], faults: Faults) -> None:
    """The joints of a moving link lie apart."""
    joints, links = set(scene.joints) & placed.keys(), ordered_links(scene)
    for link in scene.moving:
        for a, b in combinations([point for point in links[link] if point in joints], 2):
            if _coincide(placed[a], placed[b]):
                instead = "joints that lie apart, or one name for both"
                faults.add(f"links.{quote_key(link)}", f"the joints {a} and {b} coincide", instead)


def _coincide(a: Pair, b: Pair) -> bool:
    if is_exact(a, b):
        return a == b
    (ax, ay), (bx, by) = exactly(a), exactly(b)
    return max(abs(ax - bx), abs(ay - by)) <= COINCIDENCE_TOL * max(abs(ax), abs(ay), abs(bx), abs(by))


def check_frame(scene: Scene, faults: Faults) -> None:
    """Where no link is called frame, and one has another name of the fixed link, no link stands still.

    An open chain that its drives and given motions determine may call its links as it likes.
    """
    if FRAME in scene.links or (scene.motions and mobility(scene) == len(scene.drives) + 2 * len(scene.motions)):
        return
    from graphplan.mechanism.slips import is_frame_synonym  # few scenes have no frame

    for link, points in scene.links.items():
        if is_frame_synonym(link):
            faults.add(f"links.{quote_key(link)}", f"link {link} would move: the fixed link is called frame",
                       f'frame = "{" ".join(points)}"')


def check_connections(scene: Scene, faults: Faults) -> None:
    """Every link hangs together with the frame, or with a point whose motion is given."""
    joined: dict[str, set[str]] = {}
    for pair in scene.binding:
        for link in pair.links:
            joined.setdefault(link, set()).update(pair.links)
    grounded = {FRAME} & {*scene.links} | {link for point in scene.motions for link in scene.links_of[point]}
    reached = [*grounded]
    while reached:
        reached += (further := joined.get(reached.pop(), set()) - grounded)
        grounded |= further
    for link in scene.moving:
        if grounded and link not in grounded:
            lonely = "shares no joint or slide with any other"
            fault = "is connected to neither the frame nor a given motion" if link in joined else lonely
            instead = "a point that it shares with another link, or a slide"
            faults.add(f"links.{quote_key(link)}", f"link {link} {fault}", instead)


def check_gears(scene: Scene, faults: Faults) -> None:
    """Without the gears, too, their centres are held apart, and that of a gear on a rack at its pitch line.

    An arm does so in any position, so that a motion by chance keeps what a bar between the centres would.
    """
    free = replace(scene, written=tuple(pair for pair in scene.written if not isinstance(pair, Gear | Drive)))
    system = System(free)
    columns = {unknown: j for j, unknown in enumerate(system.unknowns)}
    rows = [{columns[unknown]: c for unknown, c in equation.terms.items()} for equation in system.pairs]
    motion = Elimination(rows, len(columns), PRIME).random_motion
    for number, gear in enumerate(scene.gears, 1):
        bar, of = _bar(gear), " and ".join(gear.centres)
        if gear.direction is None:
            terms = system.terms(next(bar.states(system.posed_scene)))
            if not sum(c * motion[columns[unknown]] for unknown, c in terms.items()) % PRIME:
                continue
            problem, instead = f"nothing holds the centres {of} apart", "an arm: a link with a joint at each"
        else:
            problem, instead = f"{of} can leave the pitch line", "a pin, or a slide along it"
        if not _held_in_its_pose(free, bar):
            faults.add(f"gears.{number}.centres", problem, instead)


def _bar(gear: Gear) -> Contact:
    """A bar between the centres of a gear, or a slide of its centre along the pitch line."""
    first, second = gear.centres[0], gear.centres[1] if gear.direction is None else None
    return Contact(gear.links, first, (first, second), False, gear.direction, gear.through, gear.written)


def _held_in_its_pose(free: Scene, bar: Contact) -> bool:
    """Whether the links do what a bar would do by special geometry, and not for their velocities alone."""
    from graphplan.mechanism.special import special  # few scenes need it

    before, after = special(free), special(replace(free, written=(*free.written, bar)))
    return before.freedoms == after.freedoms and after.moves


def check_mobility(scene: Scene, faults: Faults) -> Scene:
    """The scene, with what special geometry makes redundant in it.

    A fault unless it has as many drives and given motions as degrees of freedom, and each link is held just once.
    """
    counted = Faults()
    checked = _check_freedoms(scene, counted)
    loose = Faults()
    if scene.gears and faults.none_in("points") and counted.none_in("links"):  # a missing pivot tells more
        check_gears(scene, loose)
    for fault in loose if len(loose) else counted:
        faults.add(fault.where, fault.what, fault.instead)
    return checked


def _check_freedoms(scene: Scene, faults: Faults) -> Scene:
    """The same by the count of freedoms, with what special geometry makes redundant."""
    freedoms, drives, motions = mobility(scene), len(scene.drives), len(scene.motions)
    prescribed = drives + 2 * motions
    drives_text = _count(drives, "drive") + (f" and {_count(motions, 'given motion')} (two degrees each)" if motions
                                             else "")
    problem = f"mobility {freedoms} but {drives_text}"
    hold = bracing(scene)
    loose, twice = _links_text(hold.loose), _links_text(hold.overbraced)
    if freedoms < prescribed and not hold.loose and (special_scene := _in_its_pose(scene, prescribed, drives_text,
                                                                                   faults)):
        return special_scene
    if freedoms < prescribed:
        pairs = "joints and slides" if not (scene.gears or scene.contacts) else "pairs, or gears whose ratios agree"
        instead = f"fewer drives, or fewer {pairs}" if freedoms > 0 else f"a chain with fewer {pairs}"
        faults.add("drive", problem, instead)
    elif freedoms > prescribed and (choices := missing_pivots(scene, freedoms - prescribed)):
        points = ", or ".join(" and ".join(pivots) for pivots in choices)
        on_none = f"{points} {'is' if len(choices[0]) == 1 else 'are'} on no other link"
        entries, more = [frame_entry(scene, pivots) for pivots in choices], f"{freedoms - prescribed} more [[drive]]"
        if FRAME in scene.links:
            entries.append(more)
        else:
            problem = "no link is the frame"
        faults.add(f"links.{quote_key(scene.frame)}", f"{problem}, and {on_none}", " or ".join(entries))
    elif freedoms == prescribed + 1 and (ends := _missing_link(scene)):
        number = 1 + max((int(link) for link in scene.links if link.isdecimal()), default=0)
        faults.add("links", f"{problem}, and {' and '.join(ends)} belong to one link each",
                   f'perhaps a link is missing, such as {number} = "{" ".join(ends)}"; or 1 more [[drive]]')
    elif rollers := _idle_rollers(scene, hold.loose):
        faults.add("contacts", f"{loose} can turn idly: a passive freedom, that moves nothing else",
                   f"rolling = true in the contact of {' and of '.join(rollers)}")
    elif freedoms > prescribed:
        faults.add("drive", problem, f"{freedoms - prescribed} more [[drive]], since {loose} can still move")
    elif not hold.sound:
        problem = f"{twice} {_are(hold.overbraced)} overbraced while {loose} {_are(hold.loose)} loose"
        faults.add("links", problem, "joints, slides and drives that hold each link just once")
    return scene


def _in_its_pose(scene: Scene, given: int, told: str, faults: Faults) -> Scene | None:
    """The scene with its redundant conditions, where special geometry makes it move; None where it does not."""
    from graphplan.mechanism.special import special  # few scenes need it

    geometry = special(scene)
    links = _links_text(geometry.links)
    if geometry.freedoms < given:
        return None
    if geometry.freedoms > given:
        problem = f"{links} have mobility {geometry.freedoms} in this pose alone but {told}"
        faults.add("links", problem, "another pose, in which they have fewer degrees of freedom")
    elif not geometry.moves:
        problem = f"{links} can shake in this pose but not move"
        faults.add("links", problem, "lengths with which they move, or fewer joints and slides")
    return replace(scene, repetitions=geometry.repetitions)


def _idle_rollers(scene: Scene, loose: tuple[str, ...]) -> list[str]:
    """The contacts of rollers that turn on their pins as they like, where nothing else is loose: passive freedoms."""
    idle = {link: contact.name for contact in scene.contacts if not contact.rolling
            for link, centre in zip(contact.links, contact.centres, strict=True)
            if link in loose and centre in scene.joints and len(scene.links[link]) == 1}
    return list(idle.values()) if len(idle) == len(loose) else []


def check_loads(scene: Scene, faults: Faults, by_drive: bool) -> None:
    """What can be said against the loads only when all of the scene is known; held `by_drive` they need no balance."""
    loads = scene.loads
    if loads is None:
        if scene.find.reactions:
            faults.add("find.reactions", "reactions are asked for, but no load is given", "[[forces]] or [masses]")
        return
    counts = f"{_count(len(loads.balances), 'balance')} for {_count(len(scene.drives), 'drive')}"
    if scene.motions:
        faults.add("motion", "these points are moved by no link, so the force on them is unknown",
                   "drives, where forces are asked for")
    elif by_drive and scene.drives and not loads.balances:
        return
    elif len(loads.balances) < len(scene.drives):
        faults.add("balance", f"{counts}: nothing keeps the prescribed motion",
                   '[balance] with link = "1" for a moment, or with at, on and direction for a force')
    elif len(loads.balances) > len(scene.drives):
        faults.add("balance", f"{counts}: statically indeterminate", "one balance for each drive")
    else:
        _check_balance(scene, faults)


def _check_balance(scene: Scene, faults: Faults) -> None:
    """With the balances in the place of the drives each link is held just once: then statics determines all forces."""
    hold: Bracing = bracing(scene, balanced=True)
    if not hold.sound:
        loose, twice = _links_text(hold.loose), _links_text(hold.overbraced)
        problem = f"it does not hold {loose}, and {twice} {_are(hold.overbraced)} statically indeterminate"
        faults.add("balance", problem, "a moment or a force that works when the drive moves the mechanism")


def _count(number: int, noun: str) -> str:
    return f"{number or 'no'} {noun}{'' if number == 1 else 's'}"


def _links_text(links: tuple[str, ...]) -> str:
    more = f" and {len(links) - 12} more" if len(links) > 12 else ""
    return f"link{'s' if len(links) > 1 else ''} {' '.join(links[:12])}{more}"


def _are(links: tuple[str, ...]) -> str:
    return "are" if len(links) > 1 else "is"


def missing_pivots(scene: Scene, freedoms: int) -> list[tuple[str, ...]]:
    """The points that would take so many freedoms from a scene if they were on the frame too, in each of a few ways.

    They are on no other link, and with them the drives determine the motion. A pivot takes two freedoms. First come
    those of the links with the fewest points, which have no other use.
    """
    if freedoms % 2 or scene.motions:  # of an open chain it is a motion that is missing
        return []
    fixed = scene.links.get(FRAME, ())
    lone = {point: links[0] for point, links in scene.links_of.items() if len(links) == 1}
    ends = sorted(lone.keys() - {*fixed}, key=lambda p: (len(scene.links[lone[p]]), by_name(p)))
    choices = islice(combinations(ends, freedoms // 2), MAX_PIVOT_SETS)
    sound = (pivots for pivots in choices
             if bracing(replace(scene, links={**scene.links, FRAME: (*fixed, *pivots)})).sound)
    chosen = list(islice(sound, MAX_PIVOT_SUGGESTIONS))
    most = [max(len(scene.links[lone[p]]) for p in pivots) for pivots in chosen]
    return [pivots for pivots, points in zip(chosen, most, strict=True) if points == most[0]]


def _missing_link(scene: Scene) -> tuple[str, ...]:
    """Two points, each of one link alone, between which a bar would hold the links just once; none where none would.

    A distance by which one is placed from the other is such a bar before all.
    """
    if scene.motions:
        return ()
    lone = sorted((point for point, links in scene.links_of.items() if len(links) == 1), key=by_name)
    placed = {frozenset((point, centre)) for point in lone if point in scene.placements
              for centre in scene.placements[point].data.get("distances", ())}  # type: ignore[attr-defined]
    pairs = sorted(combinations(lone, 2), key=lambda ends: frozenset(ends) not in placed)
    ends = (ends for ends in islice(pairs, MAX_PIVOT_SETS) if scene.links_of[ends[0]] != scene.links_of[ends[1]]
            and bracing(replace(scene, links={**scene.links, " ".join(ends): ends})).sound)
    return tuple(sorted(next(ends, ()), key=lambda point: FRAME not in scene.links_of[point]))


def frame_entry(scene: Scene, way: tuple[str, ...]) -> str:
    """The frame with these points, as it is written."""
    return f'{quote_key(scene.frame)} = "{" ".join((*scene.links.get(FRAME, ()), *way))}"'


# --- questions: no faults, but what is more often a slip of the pen --------------------------------------------------


MAX_FRICTION_COEFFICIENT = 2
"""A coefficient of friction: no dry surfaces of machines rub more, and no flanks of a wedge do."""
MAX_GYRATION = 10  # times a link's length: no link has a larger radius of gyration


def questions(scene: Scene) -> Iterator[Fault]:
    """Doubtful entries, each with its place and the probable intention."""
    loads = scene.loads
    for table in scene.unused_loads:
        yield Fault(table, "not used, as motion alone is asked for", 'with [balance], such as link = "{}", forces are '
                    "found too".format(scene.drives[0].link if scene.drives else "1"))
    yield from _sizes_of_slips(scene)
    for screw in loads.screws if loads else ():
        if loads and not any(loads.screw_of(balance) == screw for balance in loads.balances):
            yield Fault("friction", "no balance acts through the screw of {} along {}".format(*screw.links),
                        "no [balance] at all, so that the drive of this slide is it")
    for number, friction in enumerate(loads.frictions if loads else (), 1):
        coefficient = (friction.wedge or friction).coefficient
        if coefficient > MAX_FRICTION_COEFFICIENT and not friction.rolling:
            yield Fault(f"friction.{number}.coefficient", f"{number_text(coefficient)} is more than dry surfaces have",
                        f"perhaps {number_text(coefficient / 100)}, if that is in percent")


def _sizes_of_slips(scene: Scene) -> Iterator[Fault]:
    """Angles that look like radians, a mechanism in the wrong unit of length, an inertia in that of the drawing."""
    angles: dict[str, Any] = {f"points.{quote_key(point)}.angle": placement.data["angle"]
                              for point, placement in scene.placements.items() if "angle" in placement.data}
    angles |= {f"slides.{number}.direction": slide.written for number, slide in enumerate(scene.slides, 1)
               if isinstance(slide.written, Fraction)}
    for place, angle in angles.items():
        if abs(angle) <= math.tau and (10 * angle).denominator > 1:
            yield Fault(place, f"{number_text(angle)} degrees is a small angle",
                        f"perhaps {math.degrees(angle):.5g}, if that is in radians")
    metres = METRES[scene.units.length]
    if scene.points and scene.extent * metres * 1000 < 1:
        yield Fault("units.length", f"the mechanism is {scene.extent:.4g} {scene.units.length} wide",
                    'perhaps length = "m"')
    for link, mass in scene.loads.masses.items() if scene.loads else ():
        ends = [tuple(map(float, scene.points[point])) for point in scene.links[link]]
        size = float(metres) * max((math.dist(*two) for two in combinations(ends, 2)), default=0.0)
        if size and mass.mass and (radius := math.sqrt(mass.inertia / mass.mass)) > MAX_GYRATION * size:
            yield Fault(f"masses.{quote_key(link)}.inertia", f"a radius of gyration of {radius:.4g} m, in a link of "
                        f"{size:.4g} m", f"perhaps {float(mass.inertia * metres**2):.4g}, if that is in "
                        f"{scene.units.mass} {scene.units.length}²")
