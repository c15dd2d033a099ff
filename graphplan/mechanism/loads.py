"""Loads: the tables of a scene that ask for forces: masses, forces, moments, balance, friction."""

from __future__ import annotations

from collections.abc import Mapping, Sized
from fractions import Fraction
from typing import Any

from graphplan.mechanism.checks import check_balance
from graphplan.mechanism.directions import GUIDE
from graphplan.mechanism.faults import Faults
from graphplan.mechanism.fields import (
    AMOUNT,
    LINK,
    NUMBER,
    POINT,
    TWO_LINKS,
    VECTOR,
    Either,
    Field,
    Named,
    Names,
    Row,
    Rows,
    Table,
    moving,
    on_link,
)
from graphplan.mechanism.items import Item
from graphplan.mechanism.model import FRAME, Balance, Force, Friction, Loads, Mass, Moment, Pair, Scene
from graphplan.mechanism.pairs.sliding import has_slide

# --- masses, forces, moments ---------------------------------------------------------------------------------------


def _weighed(link: str, item: Item, names: Names) -> None:
    """A fault where a link can have no mass."""
    if link == FRAME:
        item.fault("the frame is given a mass", "a moving link")
    elif link not in names.links:
        item.faults.unknown(item.where, "link", link, names.links)


MASSES = Named(Table("a mass", (
    Field("mass", "its mass", AMOUNT, "a mass, such as mass = 10"),
    Field("inertia", "its inertia about the centre of mass, in mass * m^2", AMOUNT, default=0),
    Field("centre", "its centre of mass, a point of that link", POINT, 'a point of the link, such as centre = "S"'),
), lambda row: Mass(**row.values) if on_link(row, row.item.key) else None), LINK, _weighed)

_LOADED = moving("a load on the frame moves nothing")
FORCES = Rows(Table("a force", (
    Field("on", "the loaded link", _LOADED, 'the loaded link, such as on = "2"'),
    Field("at", "a point of that link", POINT, 'a point of that link, such as at = "C"'),
    Field("value", "the components of the force", VECTOR, "two components, such as value = [-150, 0]"),
), lambda row: Force(**row.values) if on_link(row, row["on"]) else None))
MOMENTS = Rows(Table("a moment", (
    Field("on", "the loaded link", _LOADED, 'the loaded link, such as on = "3"'),
    Field("value", "the moment in force * m, counter-clockwise positive", NUMBER, "a moment, such as value = 12.0"),
), lambda row: Moment(**row.values)))


# --- balance and friction ------------------------------------------------------------------------------------------


def _balance(row: Row) -> Balance | None:
    vector, _, written = row["direction"]
    return Balance(row["on"], row["at"], vector, written) if on_link(row, row["on"]) else None


_BALANCED = moving("a balance on the frame, which does not move, keeps no motion")
BALANCE = Rows(Either((Table("a moment", (
    Field("link", "the link on which a moment keeps the motion", _BALANCED,
          'the link on which a moment acts, such as link = "1"'),
), lambda row: Balance(**row.values)), Table("a force along a line", (
    Field("at", "the point of that link where the force acts", POINT,
          'the point where a force acts, such as at = "B"'),
    Field("on", "the link on which a force keeps the motion", _BALANCED,
          'the link on which it acts, such as on = "1"'),
    Field("direction", "the force's direction: a vector, an angle in degrees, or two points", GUIDE,
          "the force's direction: a vector, an angle in degrees, or two points"),
), _balance))), single=True)


def _journal(row: Row) -> Friction | None:
    at = row["at"]
    if sum(at in points for points in row.names.links.values()) < 2 and row.item.faults.none_in("links"):
        row.items["at"].fault(f"{at} is no joint of two links", "a joint")
        return None
    return Friction(at, None, row["radius"], row["coefficient"])


def _rubbing(row: Row) -> Friction | None:
    slide = has_slide(row, "a joint and its radius")
    return Friction("", slide.links, Fraction(0), row["coefficient"]) if slide else None


def _rubbed(friction: Friction) -> tuple[object, str]:
    """The pair that has the friction."""
    if friction.slide is None:
        return friction.at, f"friction of joint {friction.at}"
    return friction.slide, "friction of slide {} along {}".format(*friction.slide)


_COEFFICIENT = Field("coefficient", "the coefficient of friction", AMOUNT,
                     "the coefficient of friction, such as coefficient = 0.1")
FRICTION = Rows(Either((Table("friction in a journal", (
    Field("at", "the joint", POINT, 'a joint, such as at = "B", or slide = ["3", "2"]'),
    Field("radius", "the journal's radius", AMOUNT, "the journal's radius"),
    _COEFFICIENT,
), _journal), Table("friction in a slide", (
    Field("slide", "the sliding link and the link with the guide", TWO_LINKS, 'a slide, such as slide = ["3", "2"]'),
    _COEFFICIENT,
), _rubbing))), once=_rubbed, remedy="one for each joint or slide")

TABLES = ("forces", "moments", "friction", "masses", "balance")


def loads(read: Mapping[str, Any]) -> Loads | None:
    """The loads of a scene, from what is read of its tables; None where it has none of them."""
    if read.keys().isdisjoint(TABLES):
        return None
    none: Pair = (Fraction(0), Fraction(0))
    return Loads(read.get("gravity", none), read.get("masses", {}), read.get("forces", ()), read.get("moments", ()),
                 read.get("balance", ()), read.get("friction", ()))


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
    """Of every joint and slide that is asked for some reaction is determinate."""
    for name in scene.find.reactions or ():
        told = [f"{link} at {name}" for link in scene.links_of.get(name, ())[1:]] or [name]
        if set(told) <= set(scene.indeterminate_pairs):
            what = f"the reaction {' and '.join(told)} is statically indeterminate: the pairs of this mechanism repeat"
            faults.add("find.reactions", f"{what} each other", "reactions of other pairs, or no redundant pair")


def _numbered(things: Sized, noun: str) -> str:
    return f"{len(things) or 'no'} {noun}{'' if len(things) == 1 else 's'}"
