"""Values: the kinds of values in a scene that are no tables: texts, numbers, names, directions, lists of names."""

from __future__ import annotations

from collections.abc import Callable, Collection
from fractions import Fraction
from typing import Any

from graphplan.mechanism.fields import Kind, SceneNames, TableRow, is_on_link
from graphplan.mechanism.items import SceneItem, Vector, describe
from graphplan.mechanism.numbers import FLOAT_RECKONING, Pair, Reckoning, exactly, is_exact, number_text
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


def _two_links(item: SceneItem, names: SceneNames) -> tuple[str | None, ...] | None:
    if not isinstance(item.value, list) or len(item.value) != 2:
        return item.fault(f"{describe(item.value)} where two links are wanted", 'two links such as ["3", "2"]')
    return tuple(LINK.read(item.with_value(name), names) for name in item.value)


TWO_LINKS = Kind("two links", _two_links, {"type": "array", "items": LINK.schema, "minItems": 2, "maxItems": 2})


def _flag(item: SceneItem, names: SceneNames) -> bool | None:
    fault = f"{describe(item.value)} where true or false is wanted"
    return item.value if isinstance(item.value, bool) else item.fault(fault, "true or false, without quotes")


FLAG = Kind("true · false", _flag, {"type": "boolean"})


def _centres(item: SceneItem, names: SceneNames) -> tuple[str, ...] | None:
    if not isinstance(item.value, list) or not item.value:
        return item.fault(f"{describe(item.value)} where centres are wanted", 'points such as ["B", "C"]')
    centres = tuple(POINT.read(item.with_value(name), names) for name in item.value)
    return None if None in centres else centres


CENTRES = Kind("centres", _centres, {"type": "array", "items": POINT.schema, "minItems": 1, "maxItems": 2})


def _two(what: str, such: str, whole: bool = False) -> Kind:
    """Two numbers above zero."""
    def read(item: SceneItem, names: SceneNames) -> tuple[Any, ...] | None:
        if not isinstance(item.value, list) or len(item.value) != 2:
            return item.fault(f"{describe(item.value)} where two {what} are wanted", f"two numbers such as {such}")
        numbers = tuple(item.with_value(entry).positive(f"number of {what}" if whole else "radius")
                        for entry in item.value)
        for number in numbers if whole else ():
            if number is not None and number.denominator != 1:
                return item.fault(f"{number_text(number)} {what}", f"whole numbers such as {such}")
        return None if None in numbers else numbers

    entry = {"type": "integer", "minimum": 1} if whole else DISTANCE.schema
    return Kind(f"two {what}", read, {"type": "array", "items": entry, "minItems": 2, "maxItems": 2})


TEETH = _two("teeth", "[24, 36]", whole=True)
RADII = _two("radii", "[48, 72]")


def centres_on(row: TableRow, *wanted: tuple[str, str]) -> bool:
    """Whether each of these centres is a point of its link; a fault for one that is not."""
    misplaced = [centre for centre, link in wanted if not is_on_link(row, "centres", centre, link)]
    return not misplaced


def choice(*words: str) -> Kind:
    """One of these words."""
    return Kind(" · ".join(words), lambda item, names: item.choice(words), {"enum": [*words]})


def moving(fault: str) -> Kind:
    """A link that is not the frame; with the frame it is this fault."""
    def read(item: SceneItem, names: SceneNames) -> str | None:
        link = item.name_of("link", names.links)
        if link == FRAME:
            item.fault(fault, "a moving link")
        return link

    return Kind("moving link", read, LINK.schema)


def name_list(noun: str, such: str, known: Callable[[SceneNames], Collection[str]],
              every: Callable[[SceneNames], Any] | None = None, *, many: str = "", after: tuple[str, ...] = (),
              entry: Kind = TEXT, wrong: Callable[[object, SceneItem, SceneNames], bool] = lambda name, item,
              names: False) -> Kind:
    """A list of what results are asked of, of those `known` that are not `wrong`; or "all", which means `every` one.

    Where the tables `after` have faults nothing is said of names: what is meant may be among those.
    """
    many = many or f"{noun}s"

    def read(item: SceneItem, names: SceneNames) -> Any:
        if not item.faults.none_in(*after):
            return ()
        if item.value == "all":
            return (every or known)(names)
        if not isinstance(item.value, list):
            return item.fault(f"{describe(item.value)} where a list of {many} is wanted",
                              f'a list such as {such}, or "all"')
        entries, choice = [item.with_value(value) for value in item.value], known(names)
        chosen = [entry.name_of(noun, choice) for entry in entries
                  if not (isinstance(entry.value, str) and wrong(entry.value, item, names))]
        return tuple(dict.fromkeys(name for name in chosen if name is not None))

    return Kind(f'list of {many}, or "all"', read,
                {"anyOf": [{"const": "all"}, {"type": "array", "items": entry.schema}]})


# --- directions: of guides and lines ---------------------------------------------------------------------------------


Direction = Vector | Fraction | str
"""A direction as written: a vector, an angle in degrees, or two points such as "O A"."""

Written = Direction | None
"""A direction as the scene writes it, if it does."""

Where = Callable[[str], tuple[Any, Any]]
"""Gives a named point's coordinates, in fractions or in any numbers that compute with them."""

_EIGHTHS = ((1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1))
"""A direction may have any length, so the multiples of 45 degrees are exact."""


class Misfit(Exception):
    """Raised by a geometric rule whose figure cannot be drawn: what is wrong, and what would be right."""

    def __init__(self, what: str, instead: str):
        self.what, self.instead = what, instead
        super().__init__(what)


def _direction(item: SceneItem, names: SceneNames) -> Direction | None:
    """A direction in one of its three spellings."""
    if isinstance(item.value, list):
        if item.value and all(isinstance(value, str) and value in names.points for value in item.value):
            return item.fault("a list of points", f'both points in one string, such as "{" ".join(item.value[:2])}"')
        components = item.vector()
        if components is not None and not any(components):
            return item.fault("the direction is zero", "a vector that is not [0, 0]")
        return components
    if isinstance(item.value, str):
        if not {*item.value.split()} <= {*names.points} and (fault := item.slip()):
            return item.fault(*fault)
        return item.two_points(names.points, "O A")
    return item.number()


def _guide(item: SceneItem, names: SceneNames) -> tuple[Pair, tuple[str, ...] | None, Written] | None:
    """A guide's direction in this pose, the two points that give it, if points do, and the direction as written."""
    direction = _direction(item, names)
    if direction is None:
        return None
    through = points_of(direction)
    if any(name not in names.places for name in through):
        return (Fraction(1), Fraction(0)), through, direction  # the point has its own fault; look for more
    try:
        x, y, exact = vector(direction, lambda name: exactly(names.places[name]))
    except Misfit as misfit:
        return item.fault(misfit.what, misfit.instead)
    if not exact:
        names.irrational.append(f"{item.where}: angle")
    rational = exact and is_exact(*(names.places[name] for name in through))
    return (x, y) if rational else (float(x), float(y)), through or None, direction


TWO_POINTS = Kind("two points", lambda item, names: item.two_points(names.points, "A B"),
                  {"type": "string", "pattern": rf"^\s*{NAME}\s+{NAME}\s*$"})
DIRECTION = Kind("direction", _direction, {"anyOf": [VECTOR.schema, NUMBER.schema, TWO_POINTS.schema]})
GUIDE = Kind("direction", _guide, DIRECTION.schema)


def points_of(direction: object) -> tuple[str, ...]:
    """The points that give a direction, if points do."""
    return tuple(direction.split()) if isinstance(direction, str) else ()


def vector(direction: Direction, at: Where, by: Reckoning = FLOAT_RECKONING) -> tuple[Any, Any, bool]:
    """The direction as a vector, and whether it is exact (provided that its points are)."""
    if isinstance(direction, tuple):
        return *direction, True
    if isinstance(direction, Fraction):
        if direction % 45 == 0:
            x, y = _EIGHTHS[int(direction / 45) % 8]
            return Fraction(x), Fraction(y), True
        return by.heading(direction)
    (x0, y0), (x1, y1) = (at(name) for name in points_of(direction))
    if (x0, y0) == (x1, y1):
        raise Misfit(f"the points {direction} coincide and give no direction", "two points that lie apart")
    return x1 - x0, y1 - y0, True
