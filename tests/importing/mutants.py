"""Files of other programs with one thing changed: a field removed, added or made another, a row gone, letters lost."""

from __future__ import annotations

import io
import random
import re
import zipfile
from collections.abc import Callable
from pathlib import Path
from urllib.parse import quote, unquote
from xml.etree import ElementTree

from samples import SAMPLES, stamped

STRANGERS = Path(__file__).parents[1] / "cases" / "strangers" / "import"
Mutant = tuple[str, bytes, bool]  # what was done, the file, whether it must be seen in the scene or the remarks


def sources(form: str) -> list[tuple[str, bytes]]:
    """The files of a format, sound as they are."""
    found = [(path.name, path.read_bytes()) for path in sorted(STRANGERS.iterdir()) if not path.name.endswith(".toml")]
    found += [(name, data) for name, (data, _) in SAMPLES.items()]
    return [(name, data) for name, data in found if FORMS[form][0](name, data)]


def mutant(form: str, number: int) -> tuple[str, bytes, Mutant]:
    """A file, and one of its mutants."""
    chance = random.Random(f"{form} {number}")
    name, data = chance.choice(sources(form))
    return name, data, FORMS[form][1](data, chance)


def _cells(rows: list[str], chance: random.Random, between: str) -> tuple[str, list[str], bool]:
    """Rows with a cell removed, added or changed, or with a row removed; of what is left out, and said to be, such as
    colours, friction and outlines, another value changes nothing."""
    place = chance.choice([place for place, row in enumerate(rows) if between in row])
    cells = rows[place].split(between)
    at = chance.randrange(len(cells))
    kind = chance.choice(["remove", "add", "change", "drop"])
    dropped = re.fullmatch("#?[0-9a-fA-F]{6}|#fff|0.1", cells[at]) or (at > 6 and len(cells) > 12)
    seen = cells[at] != "" if kind == "remove" else kind != "change" or not dropped
    if kind == "remove":
        del cells[at]
    elif kind == "add":
        cells.append("strange")
    elif kind == "change":
        cells[at] += "x!"
    rows = [*rows[:place], *([] if kind == "drop" else [between.join(cells)]), *rows[place + 1 :]]
    return f"{kind} cell {at} of row {place}", rows, seen


def _address(data: bytes, chance: random.Random) -> Mutant:
    address, query = data.decode().split("?", 1)
    body = query.rsplit("*", 1)[0].strip()[:-1]
    if chance.random() < 0.2:  # as it is damaged on its way
        at = chance.randrange(len(query) - 1)
        return f"letter {at} lost", f"{address}?{query[:at]}{query[at + 1:]}".encode(), True
    done, rows, seen = _cells(unquote(body).split("."), chance, ",")
    return done, f"{address}?{quote(stamped('.'.join(rows)), safe='!*,.')}".encode(), seen


def _table(data: bytes, chance: random.Random) -> Mutant:
    text = data.decode()
    if "?j=" in text:
        address, query = text.split("?", 1)
        done, rows, seen = _cells(query.split("%0A"), chance, ",")
        return done, f"{address}?{'%0A'.join(rows)}".encode(), seen
    rows = text.splitlines()
    heads = [place for place, row in enumerate(rows) if row.startswith(("id,", "speed,"))]
    if heads and chance.random() < 0.2:
        place = chance.choice(heads)
        rows[place] += ",strange"
        return f"a strange head in row {place}", "\n".join(rows).encode(), True
    done, rows, seen = _cells(rows, chance, ",")
    return done, "\n".join(rows).encode(), seen


def _xml(root: ElementTree.Element, chance: random.Random, skip: Callable[[ElementTree.Element], bool]) -> str:
    parents = [element for element in root.iter() if not skip(element)]
    element = chance.choice([element for element in parents if element.attrib])
    kind = chance.choice(["attribute removed", "attribute added", "attribute changed", "child removed", "child added"])
    if kind == "child removed":
        element = chance.choice([parent for parent in parents if len(parent)])
        child = chance.choice([*element])
        element.remove(child)
        return f"{kind}: {child.tag} of {element.tag}"
    if kind == "child added":
        ElementTree.SubElement(element, "strange", {"more": "1"})
        return f"{kind}: of {element.tag}"
    name = chance.choice([*element.attrib])
    if kind == "attribute removed":
        del element.attrib[name]
    elif kind == "attribute added":
        element.set("strange", "1")
    else:
        element.set(name, f"{element.get(name)}9")
    return f"{kind}: {name} of {element.tag}"


def _linkage(data: bytes, chance: random.Random) -> Mutant:
    root = ElementTree.fromstring(data)
    done = _xml(root, chance, lambda _: False)
    return done, ElementTree.tostring(root), "changed" not in done


def _geogebra(data: bytes, chance: random.Random) -> Mutant:
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        root = ElementTree.fromstring(archive.read("geogebra.xml"))
    construction = root.find("construction")
    assert construction is not None
    done = _xml(construction, chance, lambda element: element is construction)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("geogebra.xml", ElementTree.tostring(root))
    return done, packed.getvalue(), "changed" not in done


def _dxf(data: bytes, chance: random.Random) -> Mutant:
    lines = data.decode().splitlines()
    entities = lines.index("ENTITIES")
    groups = [*range(entities + 1, len(lines) - 1, 2)]
    starts = [place for place in groups if lines[place].strip() == "0"]
    first = chance.randrange(len(starts) - 2)
    kind = chance.choice(["entity removed", "group removed", "strange entity", "cut", "number changed"])
    place = chance.choice(groups[: groups.index(starts[-1])])
    if kind == "entity removed":
        del lines[starts[first] : starts[first + 1]]
    elif kind == "group removed":
        del lines[place : place + 2]
    elif kind == "strange entity":
        lines[starts[first] : starts[first]] = ["  0", "STRANGE", "  5", "FFFF", "  8", "0"]
    elif kind == "cut":
        del lines[place:]
    else:
        lines[place + 1] += "7"
    return f"{kind} at line {place}", "\n".join(lines).encode() + b"\n", kind not in ("cut", "number changed")


FORMS: dict[str, tuple[Callable[[str, bytes], bool], Callable[[bytes, random.Random], Mutant]]] = {
    "address": (lambda name, data: b"?0" in data or b"?2" in data, _address),
    "table": (lambda name, data: b"?j=" in data or (b"?" not in data and name.endswith((".csv", ".txt"))), _table),
    "linkage": (lambda name, data: name.endswith(".linkage2"), _linkage),
    "geogebra": (lambda name, data: name.endswith(".ggb"), _geogebra),
    "dxf": (lambda name, data: name.endswith(".dxf"), _dxf),
}
