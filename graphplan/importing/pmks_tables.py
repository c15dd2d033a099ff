"""Tables of PMKS+: those of 2022, which addresses hold too, and those of 2025, which are packed in addresses."""

from __future__ import annotations

import csv
import json
import math
import re
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

from graphplan.importing.pmks_records import Joint, Read, Row, count_unread, reading
from graphplan.importing.pmks_short import unpack
from graphplan.marking.files.safe import number

MAX_LENGTH = 2_000_000  # characters of what an address unpacks to
UNITS = {"": "", "in": "in", "inch": "in", "cm": "cm", "centimeter": "cm", "m": "m", "meter": "m", "mm": "mm"}
JOINT = "id x y links type ground angle input"
LINK = "id mass mass_moi center_of_mass_x center_of_mass_y joints forces shape b1x b1y b2x b2y b3x b3y b4x b4y"
FORCE = "id link startx starty endx endy fixed direction mag"
COLUMNS = {"joints": f"{JOINT} friction", "links": f"{LINK} type", "forces": f"{FORCE} xMag yMag",
           "settings": "speed cw gravity unit", "pathPoints": "id x y neighbor1 neighbor2"}
ALIASES = {"input_speed_mag": "speed", "clockwise": "cw", "coeffOfFriction": "friction"}
Rows = Mapping[str, Sequence[Row]]


def read_tables(text: str) -> Read:
    """The linkage of tables, each below its name and the heads of its columns."""
    rows, heads, section = defaultdict[str, list[Row]](list), dict[str, list[str]](), ""
    for row in csv.reader(text.splitlines()):
        if sum(map(bool, row)) == 1 and row[0].strip() not in ("", *heads):
            section = row[0].strip()
            if section not in COLUMNS:
                raise ValueError(f"the section {section!r} is not known")
            heads[section] = []
        elif any(row) and not heads[section]:
            heads[section] = [ALIASES.get(cell.strip(), cell.strip()) for cell in row]
            if unknown := [cell for cell in heads[section] if cell not in COLUMNS[section].split()]:
                raise ValueError(f"{section}: the column {unknown[0]!r} is not known")
        elif any(row):
            cells = row[:-1] if len(row) > len(heads[section]) and not row[-1] else row
            rows[section].append(Row(section, cells, " ".join(heads[section]), len(heads[section])))
    return _linkage(rows)


def read_long_address(query: str) -> Read:
    """The linkage of an address with the same tables, without heads."""
    values = dict(pair.split("=", 1) for pair in re.split(r"&(?=\w+=)", query) if "=" in pair)
    if unknown := values.keys() - {*"jlfs", "pp", "tp"}:
        raise ValueError(f"the section {min(unknown)!r} is not known")
    rows = defaultdict[str, list[Row]](list)
    for section, key in zip(COLUMNS, "jlfs", strict=False):
        for line in filter(None, map(str.strip, values.get(key, "").splitlines())):
            cells = line.rstrip(",").split(",") if section == "joints" else line.split(",")
            columns = re.sub(" type$| friction$| xMag yMag$", "", COLUMNS[section])
            if section == "joints" and len(cells) > 8:
                columns = columns.replace("angle", "angle friction")
            elif section == "forces" and len(cells) > 9:  # as the first version wrote them
                columns = columns.replace("mag", "xMag yMag")
            rows[section].append(Row(section, cells, columns, 8 if section == "links" else len(columns.split())))
    linkage = _linkage(rows)
    linkage.left_out.update({f"the section {key}": len(values.get(key, "").split()) for key in ("pp", "tp")})
    return linkage


def _linkage(rows: Rows) -> Read:
    """The linkage of tables."""
    linkage = Read()
    for row in rows["joints"]:
        with reading(f"joint {row['id']}"):
            if row["type"] not in ("R", "P"):
                raise ValueError(f"its type {row['type']!r} is not known")
            angle = 0.0 if row["angle"] in ("Null", "") else row.number("angle")
            linkage.joints.append(Joint(
                row["id"], row["id"], complex(number(row["x"]), number(row["y"])), row["type"],
                _names(row["links"]), angle, row.holds("ground"), row.holds("input"),
                turns=True))
    forces = {row["id"]: row for row in rows["forces"]}
    if len({row["id"] for row in rows["joints"]}) < len(rows["joints"]) or len(forces) < len(rows["forces"]):
        raise ValueError("a joint or a force has the name of another")
    for row in rows["links"]:
        with reading(f"link {row['id']}"):
            joints = {joint.key for joint in linkage.joints if row["id"] in joint.links}
            if not joints or ("joints" in row.cells and joints != {*_names(row["joints"])}):
                raise ValueError(f"its joints are {row['joints']}, but {' '.join(sorted(joints)) or 'none'} name it")
            for key in _names(row["forces"]):
                if forces[key]["link"] != row["id"]:
                    raise ValueError(f"the force {key} is on another link")
            if row.cells.get("type", "R") not in ("R", "P"):
                raise ValueError(f"its type {row['type']!r} is not known")
            linkage.weigh(row, row["id"])
    for key, row in forces.items():
        with reading(f"force {key}"):
            row.cells.setdefault("mag", "1")
            load = linkage.load(row, row["link"], row.holds("direction"), not row.holds("fixed"))
            if "xMag" in row.cells:
                arrow, load.vector = load.vector, row.place("xMag", "yMag")
                linkage.left_out[f"arrow of the force {key}, against its components"] += (
                    arrow.conjugate() * load.vector).real < 0
    for row in rows["settings"][:1]:
        linkage.turn_at(row.number("speed") * (-1 if row.holds("cw") else 1))
        if row["unit"].lower() not in UNITS:
            raise ValueError(f"settings: the unit {row['unit']!r} is not known")
        linkage.unit, linkage.gravity = UNITS[row["unit"].lower()], row.holds("gravity")
    return count_unread(linkage, rows)


def _names(cell: str) -> list[str]:
    """The names in a cell, with commas or bars between them."""
    return [name for name in re.split(r"[,|]", cell) if name]


# ---- 2025 ------------------------------------------------------------------------------------------------------------

LATE = {  # the columns of each section, how many there are at the least, and which are packed as whole numbers
    "j": ("id name x y type angle ground input speed welded locked hidden reference", 10, (0, 2, 3, 4, 5, 8)),
    "l": ("id name mass color center_of_mass_x center_of_mass_y joints forces locked length angle", 7, (0, 2)),
    "c": ("id name mass center_of_mass_x center_of_mass_y links locked", 6, (0, 2)), "t": ("id x y", 3, (0,)),
    "f": ("id name startx starty endx endy mag angle frame", 9, (0, 2, 3, 4, 5, 6, 7)),
    "p": ("id name mass color x y joints forces locked point length angle", 1, (0,))}


def read_packed(letters: str) -> Read:
    """The linkage of JSON in which separators are shortened, whole numbers are hexadecimal texts, and truths y and n.
    """
    text = unpack(letters, MAX_LENGTH)
    for short, long in (("--", '"]_["'), ("RP", "Reference Point"), ("_", ","), ("~", '","')):
        text = text.replace(short, long)

    def decode(part: Any) -> str:
        return str(int(part, 16)) if isinstance(part, str) and re.fullmatch("-?[0-9a-f]+", part) else str(part)

    return _late({section: [[decode(cell) if place in LATE.get(section, ("", 0, ()))[2] else str(cell)
                             for place, cell in enumerate(row)] for row in rows or () if any(row)]
                  for section, rows in json.loads(text).items()})


def read_sections(text: str) -> Read:
    """The linkage of tables that begin with `--- j ---`; the columns are known by their places, whatever their heads.
    """
    rows, section, heads = dict[str, list[list[str]]](), "", Counter[str]()
    for row in csv.reader(text.splitlines()):
        if title := re.fullmatch(r"\s*---\s*(\w+)\s*---\s*", row[0] if row else ""):
            section = title[1]
            rows[section] = []
        elif any(row) and (rows[section] or row[0].strip().isdigit()):
            rows[section].append(row)
        elif any(row):
            heads.update(f"the head {cell.strip()}" for cell in row)
    linkage = _late(rows)
    linkage.left_out.update(heads)
    return linkage


def _late(cells: Mapping[str, list[list[str]]]) -> Read:
    """Joints, links, compound links, forces; angles are degrees, speeds turns a minute, counter-clockwise."""
    if unknown := cells.keys() - LATE.keys():
        raise ValueError(f"the section {min(unknown)!r} is not known")
    rows = {section: [Row(section, row, columns, least) for row in cells.get(section, ())]
            for section, (columns, least, _) in LATE.items()}
    linkage = Read()
    for row in rows["j"]:
        with reading(f"joint {row['name'] or row['id']}"):
            linkage.joints.append(Joint(
                row["id"], row["name"], complex(number(row["x"]), number(row["y"])), {"0": "P", "1": "R"}[row["type"]],
                [], math.radians(row.number("angle")), row.holds("ground"), row.holds("input"), row.number("speed"),
                row.holds("welded"), not row.holds("welded")))
    of, forces = {joint.key: joint for joint in linkage.joints}, {row["id"]: row for row in rows["f"]}
    names = {row["id"]: row["name"] or row["id"] for row in rows["l"]}
    if (len(of), len(forces), len({*names.values()})) != tuple(len(rows[section]) for section in "jfl"):
        raise ValueError("a joint, a link or a force has the name of another")
    for key, row in zip(names, rows["l"], strict=True):
        with reading(f"link {names[key]}"):
            if not key.isdigit():
                raise ValueError(f"its number {key!r} is not known")
            for joint in _names(row["joints"]):
                of[joint].links.append(names[key])
            linkage.weigh(row, names[key])
            for force in _names(row["forces"]):
                linkage.load(forces[force], names[key], True, forces[force]["frame"].lower() == "local")
    for row in rows["c"]:
        with reading(f"compound link {row['name']}"):
            linkage.welds.append([names[key] for key in _names(row["links"])])
            if row.number("mass"):  # that of the whole
                linkage.masses |= dict.fromkeys(linkage.welds[-1], (0.0, 0.0, 0j))
                linkage.weigh(row, linkage.welds[-1][0])
    return count_unread(linkage, rows)
