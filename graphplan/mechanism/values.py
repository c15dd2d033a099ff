"""Values: the kinds of values in a scene that are no tables: texts, numbers, names, lists of what is asked for."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Any

from graphplan.mechanism.fields import Kind, Names
from graphplan.mechanism.items import Item, described
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
        found = [part.name_of(noun, choice) for part in parts if not wrong(part.value, item, names)]
        return tuple(dict.fromkeys(name for name in found if name is not None))

    return Kind(f'list of {many}, or "all"', read,
                {"anyOf": [{"const": "all"}, {"type": "array", "items": entry.schema}]})
