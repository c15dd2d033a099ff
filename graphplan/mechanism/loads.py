"""Loads: the tables of a scene that ask for forces, read into the model: masses, forces, moments, balance, friction."""

from __future__ import annotations

from collections.abc import Mapping, Sized
from fractions import Fraction

from graphplan.errors import by_name
from graphplan.mechanism.checks import check_balance
from graphplan.mechanism.faults import Faults
from graphplan.mechanism.items import Item, described
from graphplan.mechanism.model import FRAME, Balance, Force, Friction, Loads, Mass, Moment, Number, Pair, Scene, Slide
from graphplan.mechanism.numerals import shown
from graphplan.mechanism.sections import Names, read_guide, read_pair

TABLES = ("masses", "forces", "moments", "balance", "friction")
NOTHING: Pair = (Fraction(0), Fraction(0))


def read_loads(items: Mapping[str, Item], names: Names, slides: tuple[Slide, ...]) -> Loads | None:
    """The loads of a scene; None where it has none of their tables."""
    gravity = (items["gravity"].vector() if "gravity" in items else None) or NOTHING
    if not any(table in items for table in TABLES):
        return None
    rows = {table: items[table].rows() if table in items else [] for table in ("forces", "moments", "friction")}
    forces = [_force(row, names) for row in rows["forces"]]
    moments = [_moment(row, names) for row in rows["moments"]]
    frictions = [_friction(row, names, slides) for row in rows["friction"]]
    return Loads(
        gravity,
        _masses(items["masses"], names) if "masses" in items else {},
        tuple(force for force in forces if force),
        tuple(moment for moment in moments if moment),
        _balances(items["balance"], names) if "balance" in items else (),
        _once(frictions, items["friction"]) if frictions else (),
    )


def _masses(item: Item, names: Names) -> dict[str, Mass]:
    """The masses of links, by link."""
    masses: dict[str, Mass] = {}
    for link, entry in (item.table() or {}).items():
        if link == FRAME:
            entry.fault("the frame is given a mass", "a moving link")
        elif link not in names.links:
            item.faults.unknown(entry.where, "link", link, names.links)
        wanted = {"mass": "a mass, such as mass = 10", "centre": 'a point of the link, such as centre = "S"'}
        fields = entry.fields(("mass", "inertia", "centre"), wanted)
        if fields is None:
            continue
        mass, centre = _amount(fields["mass"], "mass"), fields["centre"].name_of("point", names.points)
        inertia = _amount(fields["inertia"], "inertia") if "inertia" in fields else Fraction(0)
        if centre is not None and _on_link(fields["centre"], centre, link, names) and mass is not None:
            masses[link] = Mass(mass, inertia or Fraction(0), centre)
    return masses


def _amount(item: Item, what: str) -> Number | None:
    """A number that is not negative."""
    number = item.number()
    if number is not None and number < 0:
        item.fault(f"the {what} {shown(number)} is negative", "a number of 0 or more")
        return None
    return number


def _on_link(item: Item, point: str, link: str, names: Names) -> bool:
    """Whether a point is one of a link's; a fault where it is not."""
    own = names.links.get(link, ())
    if own and point not in own:
        item.fault(f"{point} is no point of link {link}", "one of " + ", ".join(sorted(own, key=by_name)))
    return point in own


def _loaded(item: Item, names: Names) -> str | None:
    """The moving link that a load is on."""
    link = item.name_of("link", names.links)
    if link == FRAME:
        item.fault("a load on the frame moves nothing", "a moving link")
        return None
    return link


def _force(row: Item, names: Names) -> Force | None:
    wanted = {
        "on": 'the loaded link, such as on = "2"',
        "at": 'a point of that link, such as at = "C"',
        "value": "two components, such as value = [-150, 0]",
    }
    fields = row.fields(wanted, wanted)
    if fields is None:
        return None
    link, at = _loaded(fields["on"], names), fields["at"].name_of("point", names.points)
    value = fields["value"].vector()
    if link is None or at is None or value is None or not _on_link(fields["at"], at, link, names):
        return None
    return Force(link, at, value)


def _moment(row: Item, names: Names) -> Moment | None:
    wanted = {"on": 'the loaded link, such as on = "3"', "value": "a moment, such as value = 12.0"}
    fields = row.fields(wanted, wanted)
    if fields is None:
        return None
    link, value = _loaded(fields["on"], names), fields["value"].number()
    return None if link is None or value is None else Moment(link, value)


def _balances(item: Item, names: Names) -> tuple[Balance, ...]:
    """One balance as a table, or several, for as many drives, as an array of tables."""
    rows = item.rows() if isinstance(item.value, list) else [item]
    found = [_balance(row, names) for row in rows]
    return tuple(balance for balance in found if balance)


def _balance(row: Item, names: Names) -> Balance | None:
    force = isinstance(row.value, dict) and bool(row.value.keys() & {"at", "on", "direction"})
    if not force:
        fields = row.fields(("link",), {"link": 'the link on which a moment acts, such as link = "1"'})
        link = _balanced(fields["link"], names) if fields else None
        return Balance(link) if link is not None else None
    wanted = {
        "at": 'the point where a force acts, such as at = "B"',
        "on": 'the link on which it acts, such as on = "1"',
        "direction": "the force's direction: a vector, an angle in degrees, or two points",
    }
    fields = row.fields(wanted, wanted)
    if fields is None:
        return None
    link, at = _balanced(fields["on"], names), fields["at"].name_of("point", names.points)
    guide = read_guide(fields["direction"], names)
    if link is None or at is None or guide is None or not _on_link(fields["at"], at, link, names):
        return None
    return Balance(link, at, guide[0], guide[2])


def _balanced(item: Item, names: Names) -> str | None:
    """The moving link that a balance acts on."""
    link = item.name_of("link", names.links)
    if link == FRAME:
        item.fault("a balance on the frame, which does not move, keeps no motion", "a moving link")
        return None
    return link


def _friction(row: Item, names: Names, slides: tuple[Slide, ...]) -> Friction | None:
    """Friction in a joint (a journal has a radius) or in a slide."""
    sliding = isinstance(row.value, dict) and "slide" in row.value
    place = {"slide": 'a slide, such as slide = ["3", "2"]'} if sliding else {
        "at": 'a joint, such as at = "B", or slide = ["3", "2"]', "radius": "the journal's radius"}
    wanted = {**place, "coefficient": "the coefficient of friction, such as coefficient = 0.1"}
    fields = row.fields(wanted, wanted)
    if fields is None:
        return None
    coefficient = _amount(fields["coefficient"], "coefficient")
    if sliding:
        pair = read_pair(fields["slide"], names)
        if pair is None or coefficient is None:
            return None
        return Friction("", pair, Fraction(0), coefficient) if _is_slide(fields["slide"], pair, slides) else None
    at, radius = fields["at"].name_of("point", names.points), _amount(fields["radius"], "radius")
    if at is not None and sum(at in points for points in names.links.values()) < 2 and row.faults.none_in("links"):
        fields["at"].fault(f"{at} is no joint of two links", "a joint")
        return None
    return None if at is None or radius is None or coefficient is None else Friction(at, None, radius, coefficient)


def _is_slide(item: Item, pair: tuple[str, str], slides: tuple[Slide, ...]) -> bool:
    """Whether the scene has this slide; a fault where it has not, unless the slides have faults of their own."""
    found = any((slide.link, slide.along) == pair for slide in slides)
    if not found and item.faults.none_in("slides", "links"):
        known = [f'slide = ["{slide.link}", "{slide.along}"]' for slide in slides]
        meant = [f'slide = ["{slide.link}", "{slide.along}"]' for slide in slides if (slide.along, slide.link) == pair]
        instead = "perhaps " + meant[0] if meant else ", ".join(sorted(known, key=by_name)) or "a joint and its radius"
        item.fault(f"no slide of link {pair[0]} along link {pair[1]}", instead)
    return found


def _once(frictions: list[Friction | None], item: Item) -> tuple[Friction, ...]:
    """The frictions, each pair's once."""
    found: dict[object, Friction] = {}
    for row, friction in enumerate(frictions, 1):
        if friction is None:
            continue
        place = friction.at or friction.slide
        if place in found:
            told = f"joint {friction.at}" if friction.slide is None else "slide {} along {}".format(*friction.slide)
            item.faults.add(f"{item.where}.{row}", f"a second friction of {told}", "one for each joint or slide")
        found[place] = friction
    return tuple(found.values())


def read_reactions(item: Item, names: Names, slides: tuple[Slide, ...]) -> tuple[str, ...] | None:
    """The joints and slides whose reactions are asked for; None for "all"."""
    if not item.faults.none_in("slides", "links", "points"):
        return ()  # a joint or slide that is meant may be among those that have faults
    joints = [p for p in names.points if sum(p in points for points in names.links.values()) > 1]
    known = [*joints, *(slide.name for slide in slides)]
    if item.value == "all":
        return None
    if not isinstance(item.value, list):
        instead = 'a list such as ["A", "3 along 2"], or "all"'
        item.fault(f"{described(item.value)} where a list of joints and slides is wanted", instead)
        return ()
    named = [Item(entry, item.where, item.faults).name_of("joint or slide", known) for entry in item.value]
    return tuple(dict.fromkeys(name for name in named if name is not None))


def check_loads(scene: Scene, faults: Faults) -> None:
    """What can be said against the loads only when all of the scene is known."""
    loads = scene.loads
    if loads is None:
        if scene.find.reactions:
            faults.add("find.reactions", "reactions are asked for, but no load is given", "[[forces]] or [masses]")
        return
    if scene.motions:
        faults.add("motion", "what moves these points is no link, so nothing is known of its force",
                   "drives, where forces are asked for")
    elif len(loads.balances) < len(scene.drives):
        what = f"{_numbered(loads.balances, 'balance')} for {_numbered(scene.drives, 'drive')}"
        faults.add("balance", f"{what}: nothing keeps the prescribed motion",
                   '[balance] with link = "1" for a moment, or with at, on and direction for a force')
    elif len(loads.balances) > len(scene.drives):
        what = f"{_numbered(loads.balances, 'balance')} for {_numbered(scene.drives, 'drive')}"
        faults.add("balance", f"{what}: statically indeterminate", "one balance for each drive")
    else:
        check_balance(scene, faults)
        _check_asked(scene, faults)


def _check_asked(scene: Scene, faults: Faults) -> None:
    """Of every joint and slide that is asked for some reaction can be told."""
    for name in scene.find.reactions or ():
        told = [f"{link} at {name}" for link in scene.links_of.get(name, ())[1:]] or [name]
        if set(told) <= set(scene.indeterminate_pairs):
            what = f"the reaction {' and '.join(told)} is statically indeterminate: the pairs of this mechanism repeat"
            faults.add("find.reactions", f"{what} each other", "reactions of other pairs, or no redundant pair")


def _numbered(things: Sized, noun: str) -> str:
    return f"{len(things) or 'no'} {noun}{'' if len(things) == 1 else 's'}"
