"""Linkages of PMKS and PMKS+: files, and the addresses that the programs keep them in.

| form                          | what it looks like                                                   |
|-------------------------------|----------------------------------------------------------------------|
| PMKS text                     | `mech=`, a line for each joint: its links, its type, x, y, angle     |
| PMKS file (.pmks)             | JSON with `Joints`                                                   |
| PMKS+ table (.csv) or address | `joints`, `links`, `settings`; `?j=...&l=...&s=...`                  |
| PMKS+ short address           | `?0P.TY.K,0.101.MA,A,0mv,0VU,0.` in letters of base 64, then a check |
| PMKS+ of 2025                 | `--- j ---` in tables; `?data=...` packed JSON                       |

Joints are revolute (R), sliding (P: along the ground, or along the first of their links), pins in a slot of the first
of their links (RP), or where two gears touch (G). A piston of PMKS+ is a link of a revolute joint and a sliding one in
the same place.

Sources: M. Campbell, PMKS file format 1.0 (2019), and the joints of PMKS; PMKS+, its writers and readers of addresses
and tables (2022, 2023, 2025).
"""

from __future__ import annotations

import csv
import json
import math
import re
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import product
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from graphplan.errors import Refused
from graphplan.importing.lz_string import unpack
from graphplan.importing.sketch import LinkageSketch, SketchDrive, SketchGuide, Slot
from graphplan.importing.tolerances import LINE_TOL, PISTON_TOL
from graphplan.importing.written import number as number_text
from graphplan.marking.files.safe import Budget, number
from graphplan.mechanism.model import FRAME

MAX_LENGTH = 2_000_000  # characters of what an address unpacks to
MAX_JOINTS = 600
ADDRESS = re.compile(r"https?://[^\s?]*\?(\S+)")
STARTS = re.compile(r"^---\s*\w+\s*---|^joints\b|^mech\s*=|^\s*[\w ]+,[\w ]+,\s*(R|P|RP)\s*,", re.MULTILINE)
DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
UNITS = {"in": "in", "inch": "in", "cm": "cm", "centimeter": "cm", "m": "m", "meter": "m", "mm": "mm"}
LENGTHS = ("in", "cm", "m", "")  # in the short address, by their place


@dataclass
class Joint:
    """A joint as any of the forms has it; angles in radians."""

    key: str
    name: str
    at: complex
    kind: str
    links: list[str]
    angle: float = 0.0
    ground: bool = False
    input: bool = False
    rpm: float | None = None
    welded: bool = False


@dataclass
class Read:
    """The content of a file: joints, links that are welded together, the speed of its inputs, the unit of length."""

    joints: list[Joint]
    welds: Sequence[Sequence[str]] = ()
    rate: str = ""
    unit: str = ""
    title: str = ""


def knows(text: str) -> bool:
    """Whether a text looks like one of the forms."""
    start = text.lstrip()[:2000]
    address = start[:1] != "<" and ADDRESS.search(text)
    return bool(address or STARTS.search(start) or (start[:1] == "{" and '"Joints"' in text))


def read(path: Path, text: str) -> LinkageSketch:
    """The linkage of a file.

    Fails with `Refused` where it is damaged.
    """
    try:
        linkage = _read(text)
        Budget(path, MAX_JOINTS, "joints").spend(len(linkage.joints))
        return _sketch(linkage)
    except (ValueError, IndexError, KeyError, TypeError, AttributeError, csv.Error, RecursionError) as error:
        cause = " ".join(str(error).split())[:80]
        raise Refused(f"{path}", f"not a complete linkage of PMKS ({cause})", "save or copy it anew") from None


def _read(text: str) -> Read:
    if address := ADDRESS.search(text):
        query = unquote(address[1])
        if query.startswith("data="):
            return _read_packed(query[len("data=") :])
        return _long_address(query) if re.search(r"(^|&)j=", query) else _read_short(query)
    start = text.lstrip()
    if start.startswith("{"):
        return _file(json.loads(text))
    if start.startswith("---"):
        return _sections(text)
    return _tables(text) if start.startswith("joints") else _lines(text)


# ---- PMKS ------------------------------------------------------------------------------------------------------------


def _file(data: Any) -> Read:
    """A .pmks file: JSON; the driving joint is between two links, or the first that has the ground."""
    driving = int(data.get("DrivingIndex", 0))
    joints = [Joint(str(place), str(joint.get("Name", "")), complex(float(joint["X"]), float(joint["Y"])),
                    str(joint["TypeOfJoint"]).upper(), [str(link) for link in joint["Links"]],
                    float(joint.get("Angle") or 0), input=place == driving)
              for place, joint in enumerate(data["Joints"])]
    return Read(joints, rate=f"omega = {number_text(float(data.get('InputSpeed', 0)))}",
                title=str(data.get("Name", "")))


def _lines(text: str) -> Read:
    """The text of PMKS: a joint a line, or between bars."""
    joints, settings = list[Joint](), dict[str, str]()
    for line in re.split(r"[\n|]", text):
        key, equals, value = line.partition("=")
        if equals:
            settings[key.strip()] = value.strip()
        elif words := [word for word in re.split(r"[,\s]+", line.strip()) if word]:
            kind = [word.upper() in ("R", "P", "RP", "G") for word in words].index(True)
            numbers = [float(number(word)) for word in words[kind + 1 : kind + 4] if not word.isalpha()]
            shows = words[-1] if re.fullmatch("[tf]{1,4}", words[-1]) else ""
            joints.append(Joint(str(len(joints)), "", complex(numbers[0], numbers[1]), words[kind].upper(),
                                words[:kind],
                                numbers[2] if len(numbers) > 2 else 0.0, input=shows[3:] == "t"))
    driving, speed = int(settings.get("d", -1)), settings.get("s", "")
    if not any(joint.input for joint in joints):
        joints[max(driving, 0)].input = driving >= 0
    return Read(joints, rate=f"omega = {number_text(number(speed))}" if speed else "", title=settings.get("name", ""))


# ---- PMKS+, 2022: tables and long addresses --------------------------------------------------------------------------


def _tables(text: str) -> Read:
    rows = _by_section(text, lambda row: row[0].strip() if sum(map(bool, row)) == 1 else "")
    return _rows(rows["joints"], ",", (rows["settings"] or [[]])[0])


def _by_section(text: str, title: Callable[[list[str]], str]) -> Mapping[str, list[list[str]]]:
    """The rows under each title, without the heads of their columns."""
    rows = defaultdict[str, list[list[str]]](list)
    section, is_head = "", False
    for row in csv.reader(text.splitlines()):
        if name := title(row):
            section, is_head = name, True
        elif is_head:
            is_head = False
        elif any(row):
            rows[section].append(row)
    return rows


def _long_address(query: str) -> Read:
    values = dict(pair.split("=", 1) for pair in re.split(r"&(?=[jlfs]|pp|tp)", query) if "=" in pair)
    rows = [line.split(",") for line in values["j"].split("\n") if line.strip()]
    return _rows(rows, "|", values.get("s", "").strip().split(","))


def _rows(rows: Sequence[Sequence[str]], between: str, settings: Sequence[str]) -> Read:
    """Joints: id, x, y, links, type, ground, angle, (friction,) input; settings: speed, clockwise, gravity, unit."""
    joints = []
    for row in rows:
        flags = [flag.strip() for flag in row[6:] if flag.strip()]
        angle = 0.0 if flags[0] in ("Null", "") or not flags[0][-1:].isdigit() else number(flags[0])
        joints.append(Joint(row[0].strip(), row[0].strip(), complex(number(row[1]), number(row[2])), row[4].strip(),
                            [link for link in row[3].split(between) if link], angle, _yes(row[5]), _yes(flags[-1])))
    values = [*map(str.strip, settings), "", "", "", ""]
    speed = number(values[0]) * (-1 if _yes(values[1]) else 1) if values[0] else 0.0
    return Read(joints, rate=f"rpm = {number_text(speed)}" if speed else "", unit=UNITS.get(values[3].lower(), ""))


def _yes(written: str) -> bool:
    return written.strip().lower() in ("t", "true", "y")


# ---- PMKS+, 2023: short addresses ------------------------------------------------------------------------------------


def _read_short(query: str) -> Read:
    """Settings, joints, links, in letters of base 64; the last letter is the length, as a check."""
    whole, check = query[:-1], query[-1:]
    if not check or DIGITS[len(whole) % 62] != check:
        raise ValueError("its letters do not match its checksum: it is incomplete")
    flags, _, integers, choices, remainder = whole.split(".", 4)
    joints_part, _, remainder = remainder.partition("..")
    links_part = remainder.partition("..")[0]
    joints, kinds = [], {}
    for row in joints_part.split("."):
        bits, (key, name, x, y, angle) = DIGITS.index(row[0]), row[1:].split(",")[:5]
        joints.append(Joint(key, name, complex(_integer(x), _integer(y)) / 1000, "P" if bits & 1 else "R", [],
                            _integer(angle) / 1000, bool(bits & 4), bool(bits & 2), welded=bool(bits & 8)))
    of = {joint.key: joint for joint in joints}
    for row in filter(None, links_part.split(".")):
        head, *cells = row.split(",")
        kinds[head[2:]] = head[1]
        if head[0] == "Y":
            for key in cells[6 : cells.index("", 6)]:
                of[key].links.append(head[2:])
    clockwise = DIGITS.index(flags[-1]) & 1 if flags else 0
    speed = _integer(integers.split(",")[0])
    unit = LENGTHS[DIGITS.index(choices[0])] if choices[:1] in ("0", "1", "2", "3") else ""
    return Read(joints, rate=f"rpm = {'-' if clockwise else ''}{speed}" if speed else "", unit=unit)


def _integer(letters: str) -> int:
    """A whole number in letters of base 64; a 0 before it is its minus."""
    value = reduce(lambda value, letter: 64 * value + DIGITS.index(letter), letters, 0)
    return -value if letters[:1] == "0" else value


# ---- PMKS+, 2025: sections, and packed addresses ---------------------------------------------------------------------


def _read_packed(letters: str) -> Read:
    """JSON in which separators are shortened, whole numbers are hexadecimal texts, and truths are y and n."""
    text = unpack(letters, MAX_LENGTH)
    for short, long in (("--", '"]_["'), ("RP", "Reference Point"), ("_", ","), ("~", '","')):
        text = text.replace(short, long)
    data = json.loads(text)

    def decode(part: Any) -> str:
        return str(int(part, 16)) if isinstance(part, str) and re.fullmatch("-?[0-9a-f]+", part) else str(part)

    def rows(what: str, *numeric: int) -> list[list[str]]:
        return [[decode(cell) if place in numeric else str(cell) for place, cell in enumerate(row)]
                for row in data.get(what) or ()]

    return _read_late(rows("j", 0, 2, 3, 4, 5, 8), rows("l", 0), rows("c", 0))


def _sections(text: str) -> Read:
    rows = _by_section(text, lambda row: "".join(re.findall(r"^\s*---\s*(\w+)\s*---\s*$", row[0])) if row else "")
    return _read_late(rows["j"], rows["l"], rows["c"])


def _read_late(joints: Sequence[Sequence[str]], links: Sequence[Sequence[str]], welds: Sequence[Sequence[str]]) -> Read:
    """Joints: id, name, x, y, type, angle, ground, input, speed, welded ...; links: id, name, ..., joints in the
    seventh place; compound links: links in the sixth. Angles are degrees, speeds turns a minute, counter-clockwise."""
    joints_read = [Joint(row[0], row[1], complex(number(row[2]), number(row[3])), "PR"[int(row[4])], [],
                         math.radians(number(row[5])), _yes(row[6]), _yes(row[7]), number(row[8]), _yes(row[9]))
                   for row in joints]
    of = {joint.key: joint for joint in joints_read}
    names = {row[0]: row[1].strip() or row[0] for row in links}
    for row in links:
        for key in filter(None, row[6].split("|")):
            if key in of:
                of[key].links.append(names[row[0]])
    return Read(joints_read, [[names[key] for key in row[5].split("|") if key in names] for row in welds])


# ---- what they have in common ----------------------------------------------------------------------------------------


def _sketch(linkage: Read) -> LinkageSketch:
    sketch = LinkageSketch("PMKS", title=linkage.title, length=linkage.unit)
    if not linkage.unit:
        sketch.note("the unit of length: mm is a guess")
    pistons = {joint.key: twin for joint in linkage.joints if joint.kind == "P"
               and (twin := _twin(joint, linkage.joints))}
    for joint in linkage.joints:
        if joint.key not in pistons and joint.kind != "G":
            sketch.point(joint.key, joint.at, joint.name)
            if (joint.ground and joint.kind != "P") or (joint.kind == "R" and _is_ground(joint.links)):
                sketch.fixed[joint.key] = None
    names = dict.fromkeys(link for joint in linkage.joints for link in joint.links if not _is_ground([link]))
    for name in names:
        points = [pistons.get(joint.key, joint).key for joint in linkage.joints if name in _carried_links(joint)
                  and joint.kind != "G"]
        sketch.link(points, name, name)
    for weld in linkage.welds:
        first, *merged = [link for link in weld if link in sketch.links] or [""]
        for link in merged:
            sketch.called.pop(link)
            sketch.hold(first, *sketch.links.pop(link))
    for joint in linkage.joints:
        if joint.kind == "G":
            _gear(sketch, joint, linkage.joints)
        else:
            _sliding(sketch, joint, pistons.get(joint.key))
    sketch.drives += [drive for joint in linkage.joints if joint.input for drive in _drives(sketch, linkage, joint)]
    return sketch


def _twin(joint: Joint, joints: Sequence[Joint]) -> Joint | None:
    """The revolute joint of a piston, in the same place as its sliding joint."""
    least = PISTON_TOL * max(max(abs(candidate.at), abs(candidate.at - joint.at)) for candidate in joints)
    return next((candidate for candidate in joints if candidate.kind == "R" and {*candidate.links} & {*joint.links}
                 and abs(candidate.at - joint.at) <= least), None)


def _is_ground(links: Sequence[str]) -> bool:
    return any(link.lower() == "ground" for link in links)


def _carried_links(joint: Joint) -> list[str]:
    """The links that have a joint as a point: of a sliding joint or a slot not that of the guide."""
    return joint.links[1:] if joint.kind in ("P", "RP") and len(joint.links) > 1 else joint.links


def _sliding(sketch: LinkageSketch, joint: Joint, twin: Joint | None) -> None:
    direction = complex(round(math.cos(joint.angle), 14), round(math.sin(joint.angle), 14))
    if joint.kind == "P" and twin:
        piston = next(link for link in joint.links if link in twin.links)
        guides = [link for link in joint.links if not (joint.ground or link in twin.links or _is_ground([link]))]
        sketch.guides.append(SketchGuide(piston, guides[0] if guides else FRAME, twin.key, direction))
    elif joint.kind in ("P", "RP") and len(joint.links) > 1:
        along, link = (FRAME if _is_ground([name]) else name for name in joint.links[:2])
        if joint.kind == "P" and link == FRAME:  # the guide of the first link is what stands still
            sketch.hold(along, joint.key)
            sketch.guides.append(SketchGuide(along, FRAME, joint.key, direction))
        elif joint.kind == "P":
            sketch.guides.append(SketchGuide(link, along, joint.key, direction))
        else:
            if link == FRAME:
                sketch.fixed[joint.key] = None
            sketch.slots.append(Slot(joint.key, along, direction))
    elif joint.kind == "P" and joint.welded and joint.links:
        sketch.guides.append(SketchGuide(joint.links[0], FRAME, joint.key, direction))
    elif joint.kind == "P":
        sketch.slots.append(Slot(joint.key, FRAME, direction))


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


def _drives(sketch: LinkageSketch, linkage: Read, joint: Joint) -> Iterator[SketchDrive]:
    links = [link for link in joint.links if not _is_ground([link]) and link in sketch.links]
    rate = f"rpm = {number_text(joint.rpm)}" if joint.rpm else linkage.rate
    guess = "" if rate and rate != "omega = 0" else "The file tells no speed: 1 rad/s is a guess."
    if joint.kind != "R":
        guide = next((candidate for candidate in sketch.guides if candidate.link in links), None)
        if guide:
            yield SketchDrive(guide.link, "speed = 1", "A sliding input: its speed is a guess.", guide.along, True)
        else:
            sketch.note(f"the input at {joint.name or 'a sliding joint'}: left out")
    elif joint.ground or _is_ground(joint.links):
        yield from (SketchDrive(link, "omega = 1" if guess else rate, guess) for link in links)
    elif len(links) == 2:
        yield SketchDrive(links[1], "omega = 1" if guess else rate, guess, links[0])
    else:
        sketch.note(f"the input at {joint.name or 'a joint'} between {len(links)} links: left out")
