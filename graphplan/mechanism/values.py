"""Values: the kinds of values in a scene that are no tables: texts, numbers, names, lists of what is asked for."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

from graphplan.errors import by_name
from graphplan.mechanism.fields import Kind, Names, Row
from graphplan.mechanism.items import Item, described
from graphplan.mechanism.numerals import shown
from graphplan.mechanism.pairs.pair import FRAME

NAME = r"[^\s,]+"
TEXT = Kind("text", lambda item, names: item.text("a text", "a text in quotes"), {"type": "string"})
NUMBER = Kind("number", lambda item, names: item.number(), {"type": "number"})
DISTANCE = Kind("number above 0", lambda item, names: item.positive("distance"),
                {"type": "number", "exclusiveMinimum": 0})
AMOUNT = Kind("number from 0", lambda item, names: item.amount(), {"type": "number", "minimum": 0})
VECTOR = Kind("two numbers", lambda item, names: item.vector(),
              {"type": "array", "items": NUMBER.schema, "minItems": 2, "maxItems": 2})
POINT = Kind("point", lambda item, names: item.name_of("point", names.points),
             {"type": "string", "pattern": f"^{NAME}$"})
LINK = Kind("link", lambda item, names: item.name_of("link", names.links), {"type": "string", "pattern": r"\S"})
BODY = Kind("link", lambda item, names: item.name_of("link", names.bodies), LINK.schema)


def _two_links(item: Item, names: Names) -> tuple[str | None, ...] | None:
    if not isinstance(item.value, list) or len(item.value) != 2:
        return item.fault(f"{described(item.value)} where two links are wanted", 'two links such as ["3", "2"]')
    return tuple(LINK.read(item.instead(name), names) for name in item.value)


TWO_LINKS = Kind("two links", _two_links, {"type": "array", "items": LINK.schema, "minItems": 2, "maxItems": 2})


def _flag(item: Item, names: Names) -> bool | None:
    told = f"{described(item.value)} where true or false is wanted"
    return item.value if isinstance(item.value, bool) else item.fault(told, "true or false, without quotes")


FLAG = Kind("true · false", _flag, {"type": "boolean"})


def _centres(item: Item, names: Names) -> tuple[str, ...] | None:
    if not isinstance(item.value, list) or not item.value:
        return item.fault(f"{described(item.value)} where centres are wanted", 'points such as ["B", "C"]')
    found = tuple(POINT.read(item.instead(name), names) for name in item.value)
    return None if None in found else found


CENTRES = Kind("centres", _centres, {"type": "array", "items": POINT.schema, "minItems": 1, "maxItems": 2})


def _two(what: str, such: str, whole: bool = False) -> Kind:
    """Two numbers above zero."""
    def read(item: Item, names: Names) -> tuple[Any, ...] | None:
        if not isinstance(item.value, list) or len(item.value) != 2:
            return item.fault(f"{described(item.value)} where two {what} are wanted", f"two numbers such as {such}")
        found = tuple(item.instead(one).positive(f"number of {what}" if whole else "radius") for one in item.value)
        for number in found if whole else ():
            if number is not None and number.denominator != 1:
                return item.fault(f"{shown(number)} {what}", f"whole numbers such as {such}")
        return None if None in found else found

    entry = {"type": "integer", "minimum": 1} if whole else DISTANCE.schema
    return Kind(f"two {what}", read, {"type": "array", "items": entry, "minItems": 2, "maxItems": 2})


TEETH = _two("teeth", "[24, 36]", whole=True)
RADII = _two("radii", "[48, 72]")


def centres_on(row: Row, *wanted: tuple[str, str]) -> bool:
    """Whether each of these centres is a point of its link; a fault for one that is not."""
    astray = [(centre, link) for centre, link in wanted if centre not in row.names.links.get(link, ())]
    for centre, link in astray:
        if own := row.names.links.get(link, ()):
            instead = "one of " + ", ".join(sorted(own, key=by_name))
            row.items["centres"].fault(f"{centre} is no point of link {link}", instead)
    return not astray


def choice(*words: str) -> Kind:
    """One of these words."""
    return Kind(" · ".join(words), lambda item, names: item.choice(words), {"enum": [*words]})


def moving(fault: str) -> Kind:
    """A link that is not the frame; with the frame it is this fault."""
    def read(item: Item, names: Names) -> str | None:
        link = item.name_of("link", names.links)
        if link == FRAME:
            item.fault(fault, "a moving link")
        return link

    return Kind("moving link", read, LINK.schema)


def asked(noun: str, such: str, known: Callable[[Names], Collection[str]],
          every: Callable[[Names], Any] | None = None, *, many: str = "", after: tuple[str, ...] = (),
          entry: Kind = TEXT, wrong: Callable[[object, Item, Names], bool] = lambda name, item, names: False) -> Kind:
    """A list of what results are asked of, of those `known` that are not `wrong`; or "all", which means `every` one.

    Where the tables `after` have faults nothing is said of names: what is meant may be among those.
    """
    many = many or f"{noun}s"

    def read(item: Item, names: Names) -> Any:
        if not item.faults.none_in(*after):
            return ()
        if item.value == "all":
            return (every or known)(names)
        if not isinstance(item.value, list):
            return item.fault(f"{described(item.value)} where a list of {many} is wanted",
                              f'a list such as {such}, or "all"')
        parts, choice = [item.instead(value) for value in item.value], known(names)
        found = [part.name_of(noun, choice) for part in parts
                 if not (isinstance(part.value, str) and wrong(part.value, item, names))]
        return tuple(dict.fromkeys(name for name in found if name is not None))

    return Kind(f'list of {many}, or "all"', read,
                {"anyOf": [{"const": "all"}, {"type": "array", "items": entry.schema}]})
