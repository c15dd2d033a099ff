"""A scene seen otherwise: moved, turned, mirrored, scaled, in other units, run backwards, renamed, in another order.

Each is one record, which says both what becomes of a scene's tables and what must become of its results.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from random import Random
from typing import Any

Tables = dict[str, Any]
Results = dict[tuple[str, ...], Any]

WORDS = {"title", "source", "side", "pick", "belt", "units"}  # what stands under these keys names nothing
POOL = [f"{letter}{number}" for letter in "ABKPQabq" for number in ("", 1, 2, 9, 10, "_3")]
LINK_POOL = [*map(str, range(1, 41)), "arm", "rod", "cam", "A", "x2", "x10", "zeta"]
BELOW = ("points", "links", "masses", "motion", "distances")  # the keys of these tables are names


@dataclass(frozen=True)
class Transformation:
    """`turn` is the matrix of a turning or a reflection, by rows; the factors multiply what is in their unit.

    `angle` is where the x axis goes, in degrees, where it is a multiple of 90. With `time` -1 the motion is reversed.
    """

    turn: tuple[tuple[Fraction, Fraction], ...] = ((Fraction(1), Fraction(0)), (Fraction(0), Fraction(1)))
    angle: Fraction = Fraction(0)
    shift: tuple[Fraction, Fraction] = (Fraction(0), Fraction(0))
    length: Fraction = Fraction(1)
    force: Fraction = Fraction(1)
    moment: Fraction = Fraction(1)
    mass: Fraction = Fraction(1)
    inertia: Fraction = Fraction(1)
    gravity: Fraction = Fraction(1)
    time: int = 1
    units: Mapping[str, str] = field(default_factory=dict)
    points: Mapping[str, str] = field(default_factory=dict)
    links: Mapping[str, str] = field(default_factory=dict)
    order: int | None = None

    @property
    def sense(self) -> Fraction:
        """The determinant: -1 where counter-clockwise becomes clockwise."""
        (a, b), (c, d) = self.turn
        return a * d - b * c

    def vector(self, value: Any, factor: Fraction = Fraction(1)) -> list[Fraction]:
        """A vector, in a unit that is multiplied by this factor."""
        x, y = map(Fraction, value)
        return [factor * (a * x + b * y) for a, b in self.turn]

    def point(self, value: Any) -> list[Fraction]:
        """A place."""
        return [part + by for part, by in zip(self.vector(value, self.length), self.shift, strict=True)]

    def name(self, text: str) -> str:
        """Names of points and links, alone or in a text such as "3 along 2"."""
        return " ".join(self.links.get(word, self.points.get(word, word)) for word in text.split())

    # --- the scene -----------------------------------------------------------------------------------------------

    def scene(self, tables: Tables) -> Tables:
        """The tables of the scene as it is seen otherwise."""
        found = self._renamed({key: self._section(key, value) for key, value in tables.items()})
        if self.units:
            found["units"] = dict(self.units)
        return _shuffled(found, Random(self.order)) if self.order is not None else found

    def _section(self, key: str, value: Any) -> Any:
        match key:
            case "points":
                return {name: self._placed(at) for name, at in value.items()}
            case "gravity":
                return self.vector(value, self.gravity)
            case "masses":
                return {name: {**mass, "mass": mass["mass"] * self.mass,
                               "inertia": mass.get("inertia", 0) * self.inertia} for name, mass in value.items()}
            case "motion":
                rates = {"velocity": self.length * self.time, "acceleration": self.length}
                return {name: {kind: self.vector(rate, rates[kind]) for kind, rate in motion.items()}
                        for name, motion in value.items()}
            case "balance":
                rows = value if isinstance(value, list) else [value]
                return [self._row(key, row) for row in rows]
            case _ if isinstance(value, list) and all(isinstance(row, dict) for row in value):
                return [self._row(key, row) for row in value]
        return value

    def _placed(self, at: Any) -> Any:
        if isinstance(at, list):
            return self.point(at)
        found = dict(at)
        if "distance" in at:
            found["distance"] = at["distance"] * self.length
        if isinstance(at.get("distances"), dict):
            found["distances"] = {name: distance * self.length for name, distance in at["distances"].items()}
        if "angle" in at:
            found["angle"] = self.sense * at["angle"] + self.angle
        if "side" in at and self.sense < 0:
            found["side"] = {"left": "right", "right": "left"}[at["side"]]
        if isinstance(at.get("on"), dict):
            through = at["on"]["through"]
            found["on"] = {"through": self.point(through) if isinstance(through, list) else through,
                           "direction": self._heading(at["on"]["direction"])}
        return found

    def _heading(self, direction: Any, sense: int = 1) -> Any:
        """A direction as it is written; reversed where the sense is -1."""
        if isinstance(direction, list):
            return self.vector(direction, Fraction(sense))
        if isinstance(direction, str):
            return " ".join(direction.split()[::sense])
        return self.sense * direction + self.angle + (0 if sense > 0 else 180)

    def _row(self, key: str, row: dict[str, Any]) -> dict[str, Any]:
        found = dict(row)
        factors = {"omega": self.sense * self.time, "rpm": self.sense * self.time, "alpha": self.sense,
                   "speed": self.length * self.time, "acceleration": self.length, "radius": self.length}
        for name in factors.keys() & row.keys():
            found[name] = row[name] * factors[name]
        if key == "moments" and "value" in row:
            found["value"] = row["value"] * self.moment * self.sense
        elif key == "forces" and "value" in row:
            found["value"] = self.vector(row["value"], self.force)
        if "radii" in row:
            found["radii"] = [radius * self.length for radius in row["radii"]]
        if "direction" in row:  # a rack's has its wheel on the left
            found["direction"] = self._heading(row["direction"], -1 if key == "gears" and self.sense < 0 else 1)
        for name in ("centres", "next") if key == "contacts" else ():
            if name in row:
                found[name] = [end if isinstance(end, str) and " " not in end else self._heading(end)
                               for end in row[name]]
        return found

    def _renamed(self, thing: Any, below: str = "") -> Any:
        if isinstance(thing, dict):
            named = self.links if below in ("links", "masses") else self.points
            return {(named.get(key, key) if below in BELOW else key):
                    (value if (below == "" and key in WORDS) or key in ("side", "pick", "belt")
                     else self._renamed(value, key)) for key, value in thing.items()}
        if isinstance(thing, list):
            return [self._renamed(part) for part in thing]
        return self.name(thing) if isinstance(thing, str) else thing

    # --- its results ---------------------------------------------------------------------------------------------

    def results(self, results: Results) -> Results:
        """What the results must be, of those before."""
        factors = {"velocity": self.length * self.time, "acceleration": self.length, "force": self.force,
                   "omega": self.sense * self.time, "alpha": self.sense, "moment": self.moment * self.sense,
                   "length": self.length}

        def seen(kind: str, value: Any) -> Any:
            if value is None:
                return None
            if kind == "point":
                return self.point(value)
            return self.vector(value, factors[kind]) if isinstance(value, list) else factors[kind] * value

        return {(key[0], *map(self.name, key[1:])): seen(key[0], value) for key, value in results.items()}


def _shuffled(tables: Tables, random: Random) -> Tables:
    """Tables with names and rows in another order; what the first drive is, and which link carries a pin, stays."""
    def shuffled(thing: list[Any]) -> list[Any]:
        return random.sample(thing, len(thing))

    found = {}
    for key, value in tables.items():
        if key in ("points", "links", "masses"):
            found[key] = {name: value[name] for name in shuffled([*value])}
        elif isinstance(value, list) and value and isinstance(value[0], dict) and key != "balance":
            found[key] = shuffled(value)
        else:
            found[key] = value
    found["links"] = {link: " ".join(shuffled(points.split())) for link, points in found["links"].items()}
    return found


def tables_of(text: str) -> Tables:
    """The tables of a scene's text, its numbers as fractions."""
    def exact(thing: Any) -> Any:
        if isinstance(thing, dict):
            return {key: exact(value) for key, value in thing.items()}
        if isinstance(thing, list):
            return [exact(value) for value in thing]
        return Fraction(thing) if type(thing) is int else thing

    return exact(tomllib.loads(text, parse_float=Fraction))  # type: ignore[no-any-return]


def text_of(tables: Tables) -> str:
    """The tables as a scene's text."""
    plain = {key: value for key, value in tables.items() if not isinstance(value, dict) and not _rows(value)}
    parts = [f"{key} = {_toml(value)}" for key, value in plain.items()]
    for key, value in tables.items():
        if isinstance(value, dict):
            parts += [f"[{key}]", *(f"{_toml(name)} = {_toml(entry)}" for name, entry in value.items())]
        elif _rows(value):
            for row in value:
                parts += [f"[[{key}]]", *(f"{_toml(name)} = {_toml(entry)}" for name, entry in row.items())]
    return "\n".join(parts) + "\n"


def _rows(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(row, dict) for row in value)


def _toml(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, list):
        return f"[{', '.join(map(_toml, value))}]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{_toml(key)} = {_toml(part)}" for key, part in value.items()) + " }"
    return _decimal(Fraction(value))


def _decimal(number: Fraction) -> str:
    """A decimal fraction with all its digits."""
    places = next(k for k in range(200) if 10**k % number.denominator == 0)
    digits = str(abs(number.numerator) * (10**places // number.denominator)).rjust(places + 1, "0")
    sign = "-" if number < 0 else ""
    return sign + (f"{digits[:-places]}.{digits[-places:]}" if places else digits)


def results_of(printed: Tables) -> Results:
    """What `solve` prints, by kind and names; the first word of a key is the kind of its quantity."""
    found: Results = {}

    def take(kind: str, value: Any, *names: str) -> None:
        read: Callable[[Any], Any] = lambda part: Fraction(part)  # noqa: E731
        found[kind, *names] = None if value is None else [*map(read, value)] if isinstance(value, list) else read(value)

    for name, point in printed["points"].items():
        for kind, value in point.items():
            take(kind, value, name)
    for name, link in printed["links"].items():
        for kind, value in link.items():
            take(kind, value, name)
    for name, slide in printed["slides"].items():
        for kind, value in slide.items():
            take(kind, value, name)
    balances = printed.get("balance", [])
    for entry in balances if isinstance(balances, list) else [balances]:
        kind = "force" if "force" in entry else "moment"
        take(kind, entry[kind], "balance", entry["link"], entry.get("at") or "-")
    for entry in printed.get("reactions", []):
        pair = next(kind for kind in ("at", "slide", "gear", "contact") if kind in entry)
        names = entry[pair], entry["on"], entry["from"]
        take("force", entry["force"], *names)
        if "moment" in entry:
            take("moment", entry["moment"], *names)
    for name, pole in printed.get("poles", {}).items():
        if pole.get("at") is not None:
            take("point", pole["at"], "pole", name)
    return found


# --- the transformations ---------------------------------------------------------------------------------------------


def _matrix(a: Any, b: Any, c: Any, d: Any) -> tuple[tuple[Fraction, Fraction], ...]:
    return (Fraction(a), Fraction(b)), (Fraction(c), Fraction(d))


def scaled(k: Fraction) -> Transformation:
    """All lengths k times as long; masses so that what inertia does stays."""
    return Transformation(length=k, moment=k, mass=1 / k, inertia=k, gravity=k)


MIRRORED = Transformation(_matrix(1, 0, 0, -1))
MOVED = Transformation(shift=(Fraction(10**6), Fraction(-10**6)))
BACKWARDS = Transformation(time=-1)
QUARTER = Transformation(_matrix(0, -1, 1, 0), Fraction(90))
TURNED = Transformation(_matrix("3/5", "-4/5", "4/5", "3/5"))
LARGE, SMALL = scaled(Fraction(1000)), scaled(Fraction(1, 1000))
INCHES = {"length": "in", "force": "lbf", "mass": "lb"}
METRIC = Transformation(length=Fraction("25.4"), force=Fraction("4.4482216152605"),
                        moment=Fraction("4.4482216152605"), mass=Fraction("0.45359237"),
                        inertia=Fraction("0.45359237"), units={"length": "mm", "force": "N", "mass": "kg"})
"""Of a scene in INCHES."""


def renamed(tables: Tables, random: Random) -> Transformation:
    """Other names for all points and links."""
    links = [link for link in tables["links"] if link != "frame"]
    points = random.sample([name for name in POOL if name not in LINK_POOL], len(tables["points"])) \
        if len(tables["points"]) < 40 else [f"q{n}" for n in range(len(tables["points"]))]
    return Transformation(points=dict(zip(tables["points"], points, strict=True)),
                          links=dict(zip(links, random.sample([x for x in LINK_POOL if x not in POOL], len(links)),
                                         strict=True)))
