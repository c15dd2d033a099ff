"""Linkages of PMKS and PMKS+: files, and the addresses that the programs keep them in.

| form                          | what it looks like                                                          |
|-------------------------------|-----------------------------------------------------------------------------|
| PMKS text                     | `mech=`, a line for each joint: its links, its type, x, y, angle in degrees |
| PMKS file (.pmks)             | JSON with `Joints`                                                          |
| PMKS+ table (.csv) or address | `joints`, `links`, `forces`, `settings`; `?j=...&l=...&f=...&s=...`         |
| PMKS+ short address           | `?0P.TY.K,0.101.MA,A,0mv,0VU,0.` in letters of base 64, then its checks     |
| PMKS+ of 2025                 | `--- j ---` in tables; `?data=...` packed JSON                              |

Joints are revolute (R), sliding (P), pins in a slot (RP), or where two gears touch (G); the guide or the slot is of
the ground or of another link. A piston of PMKS+ is a link of a revolute joint and a sliding one in the same place.
A field, a section or a version that is not known is refused by its name.

Sources: M. Campbell, PMKS file format 1.0 (2019), and the joints of PMKS; PMKS+, its writers and readers of addresses
and tables (2022, 2023, 2025, 2026).
"""

from __future__ import annotations

import csv
import json
import math
import re
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import reduce
from itertools import product, takewhile
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from graphplan.errors import Refused
from graphplan.importing.lz_string import unpack
from graphplan.importing.sketch import (
    LinkageSketch,
    SketchDrive,
    SketchForce,
    SketchGuide,
    SketchMass,
    Slot,
    Way,
    absorb,
)
from graphplan.importing.tolerances import LINE_TOL, PISTON_TOL
from graphplan.importing.written import number as number_text
from graphplan.marking.files.safe import Budget, number
from graphplan.mechanism.model import FRAME
from graphplan.mechanism.units import METRES

MAX_LENGTH = 2_000_000  # characters of what an address unpacks to
MAX_JOINTS = 600
ADDRESS = re.compile(r"https?://[^\s?]*\?(\S+)")
STARTS = re.compile(r"^---\s*\w+\s*---|^joints\b|^mech\s*=|^\s*[\w ]+,[\w ]+,\s*(R|P|RP)\s*,", re.MULTILINE)
DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
UNITS = {"in": "in", "inch": "in", "cm": "cm", "centimeter": "cm", "m": "m", "meter": "m", "mm": "mm"}
LENGTHS = ("in", "cm", "m", "")  # in the short address, by their place
MASSES = {"in": "lb", "cm": "g"}  # what the program measures masses in beside a length; else kg
INERTIAS = {"in": METRES["in"] ** 2, "cm": 1000 * METRES["cm"] ** 2}  # lb in², and kg cm² beside g; else kg m²


@dataclass
class Joint:
    """A joint as any of the forms has it; angles in radians.

    Of one that slides `guide` is the link of its guide or slot, empty of the ground, and `slot` two joints on it; where
    it `turns` too it is a pin. `speed` is its own as an input.
    """

    key: str
    name: str
    at: complex
    kind: str
    links: list[str]
    angle: float = 0.0
    ground: bool = False
    input: bool = False
    speed: float = 0.0
    welded: bool = False
    turns: bool = False
    guide: str = ""
    slot: tuple[str, str] | None = None
    mass: float = 0.0


@dataclass
class Load:
    """A force on a link, from its start; one that is `local` turns with the link."""

    link: str
    name: str
    start: complex
    vector: complex
    local: bool


@dataclass
class Read:
    """The content of a file: joints, links that are welded together, masses and loads, the speeds of its inputs, the
    unit of length; `left_out` counts what a scene has no place for."""

    joints: list[Joint]
    welds: list[Sequence[str]] = field(default_factory=list)
    rate: str = ""
    speed: float = 0.0
    unit: str = ""
    title: str = ""
    masses: dict[str, tuple[float, float, complex]] = field(default_factory=dict)
    loads: list[Load] = field(default_factory=list)
    gravity: bool = False
    left_out: Counter[str] = field(default_factory=Counter)


def knows(text: str) -> bool:
    """Whether a text looks like one of the forms."""
    start = text.lstrip()[:2000]
    address = start[:1] != "<" and ADDRESS.search(text)
    return bool(address or STARTS.search(start) or (start[:1] == "{" and '"Joints"' in text))


def read(path: Path, text: str) -> LinkageSketch:
    """The linkage of a file.

    Fails with `Refused` where it is damaged, or has what is not known.
    """
    try:
        with _reading("the file"):
            linkage = _read(text)
            Budget(path, MAX_JOINTS, "joints").spend(len(linkage.joints))
            return _sketch(linkage)
    except ValueError as error:
        cause = " ".join(str(error).split())[:160]
        raise Refused(f"{path}", cause, "an address or a file as PMKS or PMKS+ writes it") from None


@contextmanager
def _reading(where: str) -> Iterator[None]:
    """Say where something is wrong, or missing."""
    try:
        yield
    except KeyError as error:
        raise ValueError(f"{where}: {error} is missing") from None
    except IndexError:
        raise ValueError(f"{where}: a field is missing") from None
    except (TypeError, AttributeError, csv.Error, RecursionError, json.JSONDecodeError) as error:
        raise ValueError(f"{where}: it is incomplete ({error})") from None
    except ValueError as error:
        raise ValueError(f"{error}" if where == "the file" else f"{where}: {error}") from None


def _named(what: str, cells: Sequence[str], columns: str, least: int) -> dict[str, str]:
    """The cells of a row by their columns, of which the last may be missing.

    Fails with `ValueError` where there are more, or too few.
    """
    names, what = columns.split(), f"{what}: " if what else ""
    if len(cells) > len(names):
        raise ValueError(f"{what}field {len(names) + 1}, {cells[len(names)]!r}, is not known")
    if len(cells) < least:
        raise ValueError(f"{what}its field {names[len(cells)]} is missing")
    return dict(zip(names, (cell.strip() for cell in cells), strict=False))


def _read(text: str) -> Read:
    if address := ADDRESS.search(text):
        linkage = _address(unquote(address[1]))
        linkage.left_out["letters beside the address"] += len("".join(text.split())) - len(address[0])
        return linkage
    start = text.lstrip()
    if start.startswith("{"):
        return _file(json.loads(text))
    if start.startswith("---"):
        return _sections(text)
    return _tables(text) if start.startswith("joints") else _lines(text)


def _address(query: str) -> Read:
    if query.startswith("data="):
        return _read_packed(query[len("data="):])
    if version := re.match(r"[a-z]+\d+:", query):
        raise ValueError(f"the version {version[0]!r} of addresses is not known")
    return _long_address(query) if re.search(r"(^|&)j=", query) else _read_short(query)


# ---- PMKS ------------------------------------------------------------------------------------------------------------


def _file(data: Any) -> Read:
    """A .pmks file: JSON; the driving joint is between two links, or the first that has the ground."""
    known, of_joint = {"Name", "Joints", "DrivingIndex", "InputSpeed"}, {"Name", "X", "Y", "TypeOfJoint", "Links",
                                                                        "Angle"}
    driving = int(data.get("DrivingIndex", 0))
    joints = [_old_joint(place, [str(link) for link in joint["Links"]], str(joint["TypeOfJoint"]),
                         complex(float(joint["X"]), float(joint["Y"])), float(joint.get("Angle") or 0),
                         place == driving, str(joint.get("Name", ""))) for place, joint in enumerate(data["Joints"])]
    other = [*(data.keys() - known), *(key for joint in data["Joints"] for key in joint.keys() - of_joint)]
    return Read(joints, rate=f"omega = {number_text(float(data.get('InputSpeed', 0)))}",
                title=str(data.get("Name", "")), left_out=Counter(sorted(other)))


def _lines(text: str) -> Read:
    """The text of PMKS: a joint a line, or between bars; angles in degrees."""
    joints, settings, left_out = list[Joint](), dict[str, str](), Counter[str]()
    for line in re.split(r"[\n|]", text):
        key, equals, value = line.partition("=")
        if equals:
            settings[key.strip()] = value.strip()
        elif words := [word for word in re.split(r"[,\s]+", line.strip()) if word]:
            with _reading(f"joint {len(joints) + 1}"):
                joints.append(_line(len(joints), words, left_out))
    driving, speed = int(settings.pop("d", -1)), settings.pop("s", "")
    if not any(joint.input for joint in joints):
        joints[max(driving, 0)].input = driving >= 0
    title = settings.pop("name", "")
    settings.pop("mech", "")
    left_out.update(f"the setting {key} = {value}" for key, value in settings.items())
    return Read(joints, rate=f"omega = {number_text(number(speed))}" if speed else "", title=title, left_out=left_out)


def _line(place: int, words: list[str], left_out: Counter[str]) -> Joint:
    """A joint by its words: its links, its kind, two coordinates, an angle in degrees, what is shown and driven."""
    place_of_kind = next((at for at, word in enumerate(words) if word.upper() in ("R", "P", "RP", "G")), 0)
    if not place_of_kind:
        raise ValueError(f"{' '.join(words)!r} tells no links and kind")
    links, kind, rest = words[:place_of_kind], words[place_of_kind].upper(), words[place_of_kind + 1 :]
    shown = rest.pop() if rest and re.fullmatch("[tf]{1,4}", rest[-1]) else ""
    left_out["marks of what is shown"] += bool(shown)
    left_out["angles of joints that do not slide"] += len(rest) > 2 and kind not in ("P", "RP")
    if not 2 + (kind in ("P", "RP")) <= len(rest) <= 3:
        raise ValueError(f"{' '.join(words)!r} has {len(rest)} numbers; x, y and an angle are known")
    x, y, angle = map(number, [*rest, "0"][:3])
    return _old_joint(place, links, kind, complex(x, y), math.radians(angle), shown[3:] == "t")


def _old_joint(place: int, links: list[str], kind: str, at: complex, angle: float, is_input: bool,
               name: str = "") -> Joint:
    """A joint of PMKS: the guide of a sliding one, or the slot of a pin, is of the first of its links."""
    kind = kind.upper()
    along, *riders = links if kind in ("P", "RP") and len(links) > 1 else ["", *links]
    if kind == "P" and _is_ground(riders):  # the guide of the first link is what stands still
        along, riders = "", [along]
    return Joint(str(place), name, at, kind, riders, angle, input=is_input, turns=kind == "RP" or len(links) < 2,
                 guide="" if _is_ground([along]) else along)


# ---- PMKS+, 2022: tables and long addresses --------------------------------------------------------------------------

JOINT = "id x y links type ground angle input"
LINK = "id mass mass_moi center_of_mass_x center_of_mass_y joints forces shape b1x b1y b2x b2y b3x b3y b4x b4y"
FORCE = "id link startx starty endx endy fixed direction mag"
BY_COMPONENTS = FORCE.replace("mag", "x_mag y_mag")  # as the first version wrote forces
SETTINGS = "speed cw gravity unit"
HEADS = {"joints": f"{JOINT} friction", "links": f"{LINK} type", "forces": FORCE, "settings": SETTINGS}
ALIASES = {"input_speed_mag": "speed", "clockwise": "cw"}
Rows = Mapping[str, Sequence[Mapping[str, str]]]


def _tables(text: str) -> Read:
    """Tables, each below its name and the heads of its columns."""
    rows, heads = defaultdict[str, list[dict[str, str]]](list), dict[str, list[str]]()
    section = ""
    for row in csv.reader(text.splitlines()):
        if sum(map(bool, row)) == 1 and row[0].strip() not in ("", *heads):
            section = row[0].strip()
            if section not in HEADS:
                raise ValueError(f"the section {section!r} is not known")
            heads[section] = []
        elif any(row) and not heads[section]:
            heads[section] = [ALIASES.get(cell.strip(), cell.strip()) for cell in row]
            if unknown := [cell for cell in heads[section] if cell not in HEADS[section].split()]:
                raise ValueError(f"{section}: the column {unknown[0]!r} is not known")
        elif any(row):
            what = f"{section}, row {len(rows[section]) + 1}"
            full = row[:-1] if len(row) == len(heads[section]) + 1 and not row[-1] else row
            rows[section].append(_named(what, full, " ".join(heads[section]), len(heads[section])))
    return _rows(rows, ",")


def _long_address(query: str) -> Read:
    values = dict(pair.split("=", 1) for pair in re.split(r"&(?=\w+=)", query) if "=" in pair)
    if unknown := values.keys() - {*"jlfs", "pp", "tp"}:
        raise ValueError(f"the section {min(unknown)!r} is not known")
    rows: dict[str, list[dict[str, str]]] = {}
    for section, key in zip(HEADS, "jlfs", strict=True):
        lines = [line.strip().split(",") for line in values.get(key, "").split("\n") if line.strip()]
        rows[section] = []
        for place, line in enumerate(lines, 1):
            columns = HEADS[section].removesuffix(" type").removesuffix(" friction")
            if section == "joints" and len(line) > 8 and line[8]:
                columns = columns.replace("angle", "angle friction")
            if section == "forces" and len(line) > 9:
                columns = BY_COMPONENTS
            cells = line if line[-1] or section != "joints" else line[:-1]
            least = 8 if section == "links" else len(columns.split())
            rows[section].append(_named(f"{section}, row {place}", cells, columns, least))
    linkage = _rows(rows, "|")
    linkage.left_out.update({"path points": values.get("pp", "").count("\n"),
                             "positions to be reached": values.get("tp", "").count("\n")})
    return linkage


def _rows(rows: Rows, between: str) -> Read:
    """The linkage of tables; names of links or joints in one cell have a mark `between` them."""
    linkage = Read([], left_out=Counter())
    for row in rows["joints"]:
        with _reading(f"joint {row['id']}"):
            if row["type"] not in ("R", "P"):
                raise ValueError(f"its type {row['type']!r} is not known")
            angle = number(row["angle"]) if row["angle"] not in ("Null", "") else 0.0
            linkage.joints.append(Joint(
                row["id"], row["id"], complex(number(row["x"]), number(row["y"])), row["type"],
                [link for link in row["links"].split(between) if link], angle, _yes(row["ground"]), _yes(row["input"]),
                turns=True))
            linkage.left_out["coefficients of friction of joints"] += number(row.get("friction", "0")) != 0
    forces = {row["id"]: row for row in rows.get("forces", ())}
    for row in rows.get("links", ()):
        with _reading(f"link {row['id']}"):
            held = {joint.key for joint in linkage.joints if row["id"] in joint.links}
            listed = {key for key in row.get("joints", "").split(between) if key}
            if "joints" in row and listed != held:
                raise ValueError(f"its joints are {' '.join(sorted(listed))}, but {' '.join(sorted(held))} name it")
            for key in filter(None, row.get("forces", "").split(between)):
                if forces[key]["link"] != row["id"]:
                    raise ValueError(f"the force {key} is on another link")
            if "mass" in row:
                linkage.masses[row["id"]] = number(row["mass"]), number(row["mass_moi"]), complex(
                    number(row["center_of_mass_x"]), number(row["center_of_mass_y"]))
            if row.get("type", "R") not in ("R", "P"):
                raise ValueError(f"its type {row['type']!r} is not known")
            linkage.left_out["kinds of links"] += "type" in row
            if not held:
                raise ValueError("no joint names it")
            outline = [number(row[name]) for name in LINK.split()[8:] if name in row]
            linkage.left_out["outlines of links"] += len(outline) + ("shape" in row)
    for key, row in forces.items():
        with _reading(f"force {key}"):
            load = _load(row["link"], key, *(number(row[name]) for name in FORCE.split()[2:6]),
                         number(row.get("mag", "1")), _yes(row["direction"]), not _yes(row["fixed"]))
            if "x_mag" in row:
                value = complex(number(row["x_mag"]), number(row["y_mag"]))
                linkage.left_out[f"arrow of the force {key}, against its components"] += (
                    load.vector.conjugate() * value).real < 0
                load.vector = value
            linkage.loads.append(load)
    for row in rows.get("settings", ())[:1]:
        speed = number(row["speed"]) * (-1 if _yes(row["cw"]) else 1)
        linkage.rate = f"rpm = {number_text(speed)}" if speed else ""
        linkage.unit, linkage.gravity = UNITS[row["unit"].lower()], _yes(row["gravity"])
    return linkage


def _load(link: str, name: str, x: float, y: float, end_x: float, end_y: float, size: float, out: bool,
          local: bool) -> Load:
    """A force along its arrow, which points to its end, or else to its start."""
    start, arrow = complex(x, y), complex(end_x - x, end_y - y)
    if not arrow and size:
        raise ValueError("its arrow has no length")
    return Load(link, name, start, (1 if out else -1) * size * arrow / (abs(arrow) or 1.0), local)


def _yes(written: str) -> bool:
    if written.strip().lower() not in ("t", "true", "y", "f", "false", "n", ""):
        raise ValueError(f"{written.strip()!r} is neither true nor false")
    return written.strip().lower() in ("t", "true", "y")


# ---- PMKS+, since 2023: short addresses ------------------------------------------------------------------------------

SHORT_JOINT = "id name x y angle carrier a b speed mass weld"
SHORT_FORCE = "id link name x y end_x end_y size"
ROOTS, MEMBERS = "YAMG0123", "Namg4567"  # bars, and discs; inertia and centre of mass given or computed
EDITOR = {"J": "locks", "L": "locks", "F": "locks", "C": "anchors of centres of mass", "S": "marks of a synthesis",
          "K": "colours", "H": "holds"}


def _read_short(query: str) -> Read:
    """Settings, joints, links and forces in letters of base 64, each section ended by an empty row, then what the
    editor keeps, with numbers whose thousandths are not enough among it; last a letter, the length as a check, and `*`
    with a digest."""
    sections = iter(_checked(query).split("."))
    flags, decimals, integers, choices = (next(sections, "") for _ in range(4))
    joint_rows, link_rows, force_rows = ([*takewhile(bool, sections)] for _ in range(3))
    active, extensions = next(sections, "N"), ".".join(sections)
    linkage, precise = Read([]), dict[tuple[str, int], float]()
    if active[:1] not in "JLFN":
        raise ValueError(f"the section {active!r} is not known")
    for entry in filter(None, extensions.split(",")):
        with _reading(f"the extension {entry[:20]!r}"):
            if entry[0] == "P":
                tag, place, value = entry.split("~")
                precise[tag[1:], int(place)] = number(value)
            elif entry[0] in EDITOR:
                linkage.left_out[EDITOR[entry[0]]] += 1
            else:
                raise ValueError("it is not known")

    def value(tag: str, place: int, letters: str, scale: int = 1000) -> float:
        return precise.pop((tag, place), _integer(letters) / scale)

    bits = _bits(flags)
    lengths = _named("its decimal settings", decimals.split(","), "scale speed cylinders fine", 1)
    turns = _named("its whole settings", integers.split(","), "speed step", 1)
    units = _named("its units", [*choices], "length angle force system", 1)
    if bits >> 9 or not 0 <= _integer(units["length"]) <= 3 or _integer(units.get("force", "1")) > 2:
        raise ValueError(f"its settings {flags}.{decimals}.{integers}.{choices} have a choice that is not known")
    for place, setting in enumerate(("scale", "cylinders", "fine")):
        value("D", place + (place > 0), lengths.get(setting, ""))
    value("I", 1, turns.get("step", ""), 1)
    linkage.left_out["settings of the view"] = len(lengths) + len(turns) + len(units) - 3 + (bits & 0xFE).bit_count()
    linkage.gravity, linkage.unit = not bits & 0x100, LENGTHS[_integer(units["length"])]
    speed = value("I", 0, turns["speed"], 1)
    linkage.rate = f"rpm = {number_text(-speed if bits & 1 else speed)}" if speed else ""
    linkage.speed = value("D", 1, lengths.get("speed", ""))
    for row in joint_rows:
        with _reading(f"joint {row[1:].partition(',')[0]}"):
            linkage.joints.append(_short_joint(row, value, linkage.left_out))
    of = {joint.key: joint for joint in linkage.joints}
    whole: dict[str, str] = {}
    for row in link_rows:
        with _reading(f"link {row[2:].partition(',')[0]}"):
            _short_link(row, value, linkage, of, whole)
    if strange := whole.keys() - {row[2:].partition(",")[0] for row in link_rows if row[0] in MEMBERS}:
        raise ValueError(f"link {whole[min(strange)]}: its member {min(strange)!r} is missing")
    for row in force_rows:
        with _reading(f"force {row[1:].partition(',')[0]}"):
            kind, cells = _bits(row[0]), _named("", row[1:].split(","), SHORT_FORCE, 8)
            tag = f"F{cells['id']}"
            numbers = [value(tag, place, cells[name]) for place, name in enumerate(SHORT_FORCE.split()[3:])]
            link = whole.get(cells["link"], cells["link"])
            if kind > 3 or link not in {link for joint in linkage.joints for link in joint.links}:
                raise ValueError(f"its letter {row[0]!r} or its link {cells['link']!r} is not known")
            linkage.loads.append(_load(link, cells["id"], *numbers, bool(kind & 2), bool(kind & 1)))
    for joint in linkage.joints:
        joint.guide = whole.get(joint.guide, joint.guide)
        if strange := [end for end in joint.slot or () if end not in of or joint.guide not in of[end].links]:
            raise ValueError(f"joint {joint.key}: {strange[0]!r} of its slot is not on the link {joint.guide!r}")
    if strange := [tag for tag, _ in precise]:
        raise ValueError(f"the extension 'P{strange[0]}' names no field")
    return linkage


def _checked(query: str) -> str:
    """What an address says, without its checks."""
    body, mark, digest = query.rpartition("*")
    if mark:
        letters, units = body.encode("utf-16-le"), 0x811C9DC5
        for place in range(0, len(letters), 2):
            units = ((units ^ int.from_bytes(letters[place : place + 2], "little")) * 0x01000193) % 2**32
        if digest != "".join(DIGITS[units // 62**power % 62] for power in reversed(range(6))):
            raise ValueError("its letters do not match its digest: it is incomplete or was changed")
    whole, check = (body[:-1], body[-1:]) if mark else (query[:-1], query[-1:])
    if not check or DIGITS[len(whole) % 62] != check:
        raise ValueError("its letters do not match its checksum: it is incomplete")
    return whole


def _short_joint(row: str, value: Callable[..., float], left_out: Counter[str]) -> Joint:
    kind, cells = _bits(row[0]), _named("", row[1:].split(","), SHORT_JOINT, 5)
    tag, slides = f"J{cells['id']}", kind & 1
    x, y, angle, speed, mass = (value(tag, place, cells.get(name, "")) for place, name in
                                enumerate(("x", "y", "angle", "speed", "mass")))
    left_out.update({"paths of points": kind >> 4 & 1, "drawn cylinders": kind >> 5})
    if (mass or cells.get("weld")) and not slides:
        raise ValueError("it turns, and its mass and weld are those of a slider")
    left_out["speeds of joints that are no inputs"] += bool(speed) and not kind & 2
    slot = tuple(cells.get(name, "") for name in ("carrier", "a", "b"))
    if any(slot) and not (all(slot) and slides and not kind & 4):
        raise ValueError(f"its slot {','.join(slot)} is not known")
    weld = kind >> 3 & 1 or _integer(cells.get("weld", "")) != 0
    return Joint(cells["id"], cells["name"], complex(x, y), "RP"[slides], [], angle, bool(kind & 4), bool(kind & 2),
                 speed, bool(weld), not weld, slot[0], (slot[1], slot[2]) if slot[0] else None, mass)


def _short_link(row: str, value: Callable[..., float], linkage: Read, of: Mapping[str, Joint],
                whole: dict[str, str]) -> None:
    """A link with its joints and its mass, or a member of links that are welded together."""
    head, *cells = row.split(",")
    key, tag = head[2:], f"L{head[2:]}"
    if head[0] not in ROOTS + MEMBERS or head[1:2] not in ("R", "P"):
        raise ValueError(f"its letters {head[:2]!r} are not known")
    mass, inertia, x, y = (value(tag, place, cells[place + 1]) for place in range(4))
    end = next((place for place in range(6, len(cells)) if not cells[place]), 0)
    if strange := [joint for joint in cells[6:end] if joint not in of] or not end:
        raise ValueError(f"its joint {strange[0]!r} is missing" if strange else "its joints have no end")
    if not cells[6:end]:
        raise ValueError("it has no joints")
    linkage.left_out.update({"colours": bool(cells[5]), f"the name {cells[0]} of {key}": cells[0] not in ("", key),
                             "discs and computed inertias": head[0] not in "YN"})
    if head[0] in MEMBERS:
        linkage.left_out["members of welded links"] += 1
        return
    for joint in cells[6:end]:
        of[joint].links.append(key)
    whole.update(dict.fromkeys(filter(None, cells[end + 1 :]), key))
    linkage.masses[key] = mass, inertia, complex(x, y) if head[1] == "R" else of[cells[6]].at


def _bits(letters: str) -> int:
    """Flags in letters of base 64."""
    return _integer("1" + letters) - 64 ** len(letters)


def _integer(letters: str) -> int:
    """A whole number in letters of base 64; a 0 before it is its minus."""
    if strange := {*letters} - {*DIGITS}:
        raise ValueError(f"{letters!r} is no number, because of {min(strange)!r}")
    value = reduce(lambda value, letter: 64 * value + DIGITS.index(letter), letters, 0)
    return -value if letters[:1] == "0" else value


# ---- PMKS+, 2025: sections, and packed addresses ---------------------------------------------------------------------

LATE = {"j": ("id name x y type angle ground input speed welded locked hidden reference", 10),
        "l": ("id name mass color x y joints forces locked length angle", 7),
        "c": ("id name mass x y links locked", 6), "t": ("id x y", 3),
        "f": ("id name x y end_x end_y size angle frame", 9),
        "p": ("id name mass color x y joints forces locked point length angle", 1)}
LATE_WHOLE = {"j": (0, 2, 3, 4, 5, 8), "l": (0, 2), "c": (0, 2), "t": (0,), "f": (0, 2, 3, 4, 5, 6, 7), "p": (0,)}


def _read_packed(letters: str) -> Read:
    """JSON in which separators are shortened, whole numbers are hexadecimal texts, and truths are y and n."""
    text = unpack(letters, MAX_LENGTH)
    for short, long in (("--", '"]_["'), ("RP", "Reference Point"), ("_", ","), ("~", '","')):
        text = text.replace(short, long)
    data = json.loads(text)

    def decode(part: Any) -> str:
        return str(int(part, 16)) if isinstance(part, str) and re.fullmatch("-?[0-9a-f]+", part) else str(part)

    return _read_late({section: [[decode(cell) if place in LATE_WHOLE.get(section, ()) else str(cell)
                                  for place, cell in enumerate(row)] for row in rows or () if any(row)]
                       for section, rows in data.items()})


def _sections(text: str) -> Read:
    rows, section, left_out = dict[str, list[list[str]]](), "", Counter[str]()
    for row in csv.reader(text.splitlines()):
        if title := re.fullmatch(r"\s*---\s*(\w+)\s*---\s*", row[0] if row else ""):
            section = title[1]
            rows[section] = []
        elif any(row) and (rows[section] or row[0].strip().isdigit()):
            rows[section].append(row)
        elif any(row):  # a table may have a head; its columns are known by their places
            left_out.update(f"the head {cell.strip()}" for cell in row)
    linkage = _read_late(rows)
    linkage.left_out.update(left_out)
    return linkage


def _read_late(tables: Mapping[str, list[list[str]]]) -> Read:
    """Joints, links, compound links, forces; angles are degrees, speeds turns a minute, counter-clockwise."""
    if unknown := tables.keys() - LATE.keys():
        raise ValueError(f"the section {min(unknown)!r} is not known")
    rows = {section: [_named(f"{section}, row {place}", row, *LATE[section])
                      for place, row in enumerate(tables.get(section, ()), 1)] for section in LATE}
    linkage = Read([])
    for row in rows["j"]:
        with _reading(f"joint {row['name'] or row['id']}"):
            if row["type"] not in ("0", "1"):
                raise ValueError(f"its type {row['type']!r} is not known")
            linkage.joints.append(Joint(
                row["id"], row["name"], complex(number(row["x"]), number(row["y"])), "PR"[int(row["type"])], [],
                math.radians(number(row["angle"])), _yes(row["ground"]), _yes(row["input"]), number(row["speed"]),
                _yes(row["welded"]), not _yes(row["welded"])))
            linkage.left_out["marks of joints"] += sum(_yes(row.get(mark, "")) for mark in ("locked", "hidden",
                                                                                          "reference"))
    of = {joint.key: joint for joint in linkage.joints}
    names = {row["id"]: row["name"] or row["id"] for row in rows["l"]}
    forces = {row["id"]: row for row in rows["f"]}
    if strange := [row["id"] for row in rows["l"] if not row["id"].isdigit()]:
        raise ValueError(f"the link {strange[0]!r}: its number is not known")
    for row in rows["l"]:
        with _reading(f"link {names[row['id']]}"):
            for key in filter(None, row["joints"].split("|")):
                of[key].links.append(names[row["id"]])
            linkage.masses[names[row["id"]]] = number(row["mass"]), 0.0, complex(number(row["x"]), number(row["y"]))
            for key in filter(None, row.get("forces", "").split("|")):
                force = forces.pop(key)
                linkage.loads.append(_load(names[row["id"]], force["name"], *(
                    number(force[name]) for name in ("x", "y", "end_x", "end_y", "size")), True,
                    force["frame"].lower() == "local"))
            linkage.left_out.update({"colours": bool(row["color"]), "locks": _yes(row.get("locked", "")),
                                     "computed lengths and angles": ("length" in row) + ("angle" in row)})
    linkage.welds = [[names[key] for key in row["links"].split("|")] for row in rows["c"]]
    for row, members in zip(rows["c"], linkage.welds, strict=True):
        if mass := number(row["mass"]):  # that of the whole
            linkage.masses |= dict.fromkeys(members, (0.0, 0.0, 0j))
            linkage.masses[members[0]] = mass, 0.0, complex(number(row["x"]), number(row["y"]))
    linkage.left_out.update({"trajectories": len(rows["t"]), "positions to be reached": len(rows["p"]),
                             "forces on no link": len(forces)})
    return linkage


# ---- what they have in common ----------------------------------------------------------------------------------------


def _sketch(linkage: Read) -> LinkageSketch:
    sketch = LinkageSketch("PMKS", title=linkage.title, length=linkage.unit, gravity=linkage.gravity)
    sketch.left_out = linkage.left_out
    if not linkage.unit:
        sketch.note("the unit of length: mm is a guess")
    twins = {joint.key: twin for joint in linkage.joints if joint.kind == "P"
             and (twin := _twin(joint, linkage.joints))}
    for joint in linkage.joints:
        if joint.key in twins and joint.name not in ("", twins[joint.key].name):
            sketch.left_out[f"name {joint.name} of a sliding joint"] += 1
        if joint.key not in twins and joint.kind != "G":
            sketch.point(joint.key, joint.at, joint.name)
            if joint.kind == "R" and (joint.ground or _is_ground(joint.links)):
                sketch.fixed[joint.key] = None
    names = dict.fromkeys(link for joint in linkage.joints for link in [*joint.links, joint.guide]
                          if link and not _is_ground([link]))
    for name in names:
        points = [twins.get(joint.key, joint).key for joint in linkage.joints if name in joint.links
                  and joint.kind != "G"]
        sketch.link(points, name, name)
    for joint in linkage.joints:
        if joint.kind == "G":
            _gear(sketch, joint, linkage.joints)
        elif joint.kind != "R":
            _sliding(sketch, linkage, joint, twins.get(joint.key))
        elif joint.input:
            _turning(sketch, linkage, joint)
    for link, (mass, inertia, centre) in linkage.masses.items():
        if mass or inertia:
            inertia *= float(INERTIAS.get(linkage.unit, 1))
            sketch.masses[link] = SketchMass(mass, inertia, sketch.spot(link, centre, f"S_{link}"))
    for load in linkage.loads:
        if load.link not in sketch.links:
            raise ValueError(f"the force {load.name}: the link {load.link!r} is missing")
        at = sketch.spot(load.link, load.start, load.name)
        sketch.forces.append(SketchForce(load.link, at, load.vector))
        if load.local:
            sketch.note(f"the force {load.name} turns with its link: in the scene it keeps its direction")
    if sketch.masses or sketch.forces:
        if not linkage.unit:
            sketch.note("the units of force and mass: N and kg are a guess")
        sketch.units = {"force": "lbf" if linkage.unit == "in" else "N", "mass": MASSES.get(linkage.unit, "kg")}
    elif linkage.gravity:
        sketch.note("gravity: left out, as no link has a mass")
    weld_at = [[link for link in twin.links if link in sketch.links] for twin in twins.values() if twin.welded]
    for weld in [*linkage.welds, *weld_at]:
        first, *merged = [link for link in weld if link in sketch.links] or [""]
        for link in merged:
            absorb(sketch, link, first)
    return sketch


def _twin(joint: Joint, joints: Sequence[Joint]) -> Joint | None:
    """The revolute joint of a piston, in the same place as its sliding joint."""
    least = PISTON_TOL * max(max(abs(candidate.at), abs(candidate.at - joint.at)) for candidate in joints)
    return next((candidate for candidate in joints if candidate.kind == "R" and {*candidate.links} & {*joint.links}
                 and abs(candidate.at - joint.at) <= least), None)


def _is_ground(links: Sequence[str]) -> bool:
    return any(link.lower() == "ground" for link in links)


def _sliding(sketch: LinkageSketch, linkage: Read, joint: Joint, twin: Joint | None) -> None:
    """A link that slides along a guide, or a pin in a slot, with the drive of it."""
    along, at = joint.guide or FRAME, twin.key if twin else joint.key
    way: Way = joint.slot or sketch.heading(joint.angle, f"the guide of {sketch.names[at] or joint.name or 'a joint'}")
    if joint.turns and not twin and not (joint.input or joint.mass):
        if _is_ground(joint.links):
            sketch.fixed[joint.key] = None
        return sketch.slots.append(Slot(joint.key, along, way))
    if twin:
        link = next(link for link in joint.links if link in twin.links)
    else:
        link = sketch.link([joint.key])
        linkage.welds += [] if joint.turns else [[*joint.links, link]]
        linkage.masses[link] = joint.mass, 0.0, joint.at
    sketch.guides.append(SketchGuide(link, along, at, way))
    if joint.input:
        speed = joint.speed or linkage.speed
        sketch.drives.append(SketchDrive(link, f"speed = {number_text(speed or 1.0)}", "" if speed else
                                         "A sliding input: its speed is a guess.", along, True))
    return None


def _gear(sketch: LinkageSketch, joint: Joint, joints: Sequence[Joint]) -> None:
    """Two gears touch in a joint: each turns about a pin on the line through it."""
    pins = [[pin for pin in joints if pin.kind == "R" and link in pin.links] for link in joint.links[:2]]
    for first, second in product(*pins):
        line = second.at - first.at
        share = (joint.at - first.at) / line if line else 1j
        if abs(share.imag) > LINE_TOL:
            continue
        sizes, inner = (abs(share.real * line), abs((1 - share.real) * line)), not 0 < share.real < 1
        links = [FRAME if _is_ground([link]) else link for link in joint.links]
        wheels = [*zip(sizes, links, (first.key, second.key), strict=False)]
        (radius, link, at), (ring, on, far) = sorted(wheels) if inner else wheels
        radii = f"radii = [{number_text(radius, sketch.extent)}, {number_text(ring, sketch.extent)}]"
        return sketch.guides.append(SketchGuide(link, on, at, (at, far), (radii, *["internal = true"] * inner)))
    return sketch.note(f"a gear joint at ({joint.at.real:g}, {joint.at.imag:g}) of {' '.join(joint.links)}: left out")


def _turning(sketch: LinkageSketch, linkage: Read, joint: Joint) -> None:
    """The drives of a revolute joint that is an input."""
    links = [link for link in joint.links if link in sketch.links]
    rate = f"rpm = {number_text(joint.speed)}" if joint.speed else linkage.rate
    guess = "" if rate and rate != "omega = 0" else "The file tells no speed: 1 rad/s is a guess."
    rate = "omega = 1" if guess else rate
    if joint.ground or _is_ground(joint.links):
        sketch.drives += [SketchDrive(link, rate, guess) for link in links]
    elif len(links) == 2:
        sketch.drives.append(SketchDrive(links[1], rate, guess, links[0]))
    else:
        sketch.note(f"the input at {joint.name or 'a joint'} between {len(links)} links: left out")
