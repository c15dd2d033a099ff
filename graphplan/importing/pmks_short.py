"""Short addresses of PMKS+: a packed text instead of tables.

Sources: P. Jeney, lz-string; Ziv and Lempel, IEEE Trans. Inf. Theory 24 (1978).

Sections end with an empty row: four of settings, joints, links and forces, then what is selected, and extensions: what
the editor keeps, and numbers whose thousandths are not enough. A last letter is the length, and after `*` follows a
digest (FNV-1a, 32 bits).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from functools import reduce
from itertools import islice, takewhile

from graphplan.importing.pmks_records import Joint, Read, Row, count_unread, reading
from graphplan.marking.files.safe import number

ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+-$"
BYTE, WORD, END = 0, 1, 2


def unpack(packed: str, max_length: int) -> str:
    """The text that LZ-string packed into an address.

    Lempel and Ziv's code of 1978: a stream of bits, six in each letter, first bit first, each code with its lowest bit
    first and as wide as the dictionary has grown. Codes 0 and 1 bring a new character of 8 or 16 bits, 2 ends the text,
    others are pieces of it that came before. Fails with `ValueError` where it is no such text, or one that is too long.
    """
    letters = packed.replace(" ", "+").rstrip("=")
    if not {*letters} <= {*ALPHABET}:
        raise ValueError("a letter that is not packed text")
    bits = (ALPHABET.index(letter) >> place & 1 for letter in letters for place in reversed(range(6)))
    pieces = ["", "", ""]
    text, last = "", ""
    while (code := _next_number(bits, len(pieces).bit_length())) != END:
        if code in (BYTE, WORD):
            piece = chr(_next_number(bits, 16 if code == WORD else 8))
            pieces.append(piece)
        elif code < len(pieces):
            piece = pieces[code]
        elif code == len(pieces) and last:
            piece = last + last[0]
        else:
            raise ValueError("a code that was not packed")
        if last:
            pieces.append(last + piece[0])
        text, last = text + piece, piece
        if len(text) > max_length:
            raise ValueError("it is too long")
    return text


def _next_number(bits: Iterator[int], width: int) -> int:
    """The next number, of so many bits."""
    digits = [*islice(bits, width)]
    if len(digits) < width:
        raise ValueError("its end is missing")
    return sum(bit << place for place, bit in enumerate(digits))


DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
LENGTHS = ("in", "cm", "m", "")  # by their place
JOINT = "id name x y angle carrier a b speed mass weld"
LINK = "id name mass mass_moi center_of_mass_x center_of_mass_y color"
FORCE = "id link name startx starty endx endy mag"
DECIMALS, INTEGERS, CHOICES = "scale speed cylinders fine", "speed step", "length angle force system"
PRECISE = {"J": "x y angle speed mass", "L": LINK[8:], "F": FORCE[13:], "D": DECIMALS, "I": INTEGERS}
ROOTS, MEMBERS = "YAMG0123", "Namg4567"  # bars, and discs; inertia and centre of mass given or computed
EDITOR = "JLFCSKH"  # what begins locks, anchors of centres of mass, marks of a synthesis, colours, holds


def read_short_address(query: str) -> Read:
    """The linkage of an address."""
    sections = iter(_without_checks(query).split("."))
    settings = [next(sections, "") for _ in range(4)]
    rows = dict[str, dict[str, Row]]()
    for record, head, columns, least, most in (("joint", 1, JOINT, 5, None), ("link", 2, LINK, 7, 7),
                                               ("force", 1, FORCE, 8, None)):
        records = [Row(record, row[head:].split(",")[:most], columns, least, _decimal, row)
                   for row in takewhile(bool, sections)]
        rows[record[0].upper()] = {row["id"]: row for row in records}
        if len(rows[record[0].upper()]) < len(records):
            raise ValueError(f"a {record} has the name of another")
    active, extensions, linkage = next(sections, ""), ".".join(sections), Read()
    if active[:1] not in "JLFN":
        raise ValueError(f"the section {active!r} is not known")
    flags, units = _bits(settings[0]), Row("its units", settings[3], CHOICES, 1, _integer)
    if flags >> 9 or not 0 <= units.number("length") <= 3 or _integer(units.cells.get("force", "")) > 2:
        raise ValueError(f"its settings {'.'.join(settings)} have a choice that is not known")
    decimals = Row("its decimal settings", settings[1].split(","), DECIMALS, 1, _decimal)
    integers = Row("its whole settings", settings[2].split(","), INTEGERS, 1, _rate)
    rows |= {"D": {"": decimals}, "I": {"": integers}, "units": {"": units}}
    for entry in filter(None, extensions.split(",")):
        with reading(f"the extension {entry[:20]!r}"):
            if entry[0] == "P":
                tag, place, value = entry[1:].split("~")
                rows[tag[0]][tag[1:]].cells[PRECISE[tag[0]].split()[int(place)]] = f"={number(value)!r}"
            elif entry[0] in EDITOR:
                linkage.left_out["marks of its editor"] += 1
            else:
                raise ValueError("it is not known")
    linkage.gravity, linkage.unit = not flags & 0x100, LENGTHS[round(units.number("length"))]
    linkage.left_out["settings of the view"] = (flags & 0xFE).bit_count() + bool(active)
    if "*" not in query:
        linkage.notes.append("the address has no digest: of its letters the number alone is checked")
    linkage.turn_at(integers.number("speed") * (-1 if flags & 1 else 1))
    linkage.speed = decimals.number("speed")
    for key, row in rows["J"].items():
        with reading(f"joint {key}"):
            linkage.joints.append(_joint(row, _bits(row.text[0]), linkage.left_out))
    of, whole = {joint.key: joint for joint in linkage.joints}, dict[str, str]()
    for key, row in rows["L"].items():
        with reading(f"link {key}"):
            _link(row, linkage, of, whole)
    if strange := whole.keys() - {key for key, row in rows["L"].items() if row.text[0] in MEMBERS}:
        raise ValueError(f"link {whole[min(strange)]}: its member {min(strange)!r} is missing")
    for key, row in rows["F"].items():
        with reading(f"force {key}"):
            if (kind := _bits(row.text[0])) > 3:
                raise ValueError(f"its letter {row.text[0]!r} is not known")
            linkage.load(row, whole.get(row["link"], row["link"]), bool(kind & 2), bool(kind & 1))
    for joint in linkage.joints:
        joint.guide = whole.get(joint.guide, joint.guide)
        if off := [end for end in joint.slot or () if end not in of or joint.guide not in of[end].links]:
            raise ValueError(f"joint {joint.key}: {off[0]!r} of its slot is not on the link {joint.guide!r}")
    for setting in (decimals, integers, units):
        for column in setting.cells:
            setting.numeral(setting.cells[column])
    return count_unread(linkage, {name: [*section.values()] for name, section in zip(
        ("joints", "links", "forces", "the view", "the animation", "the units"), rows.values(), strict=True)})


def _without_checks(query: str) -> str:
    """Return an address without its checks.

    Fails with `ValueError` where they do not hold.
    """
    body, mark, digest = query.rpartition("*")
    body = body if mark else query
    letters, value = body.encode("utf-16-le"), 0x811C9DC5
    for place in range(0, len(letters), 2):
        value = ((value ^ int.from_bytes(letters[place : place + 2], "little")) * 0x01000193) % 2**32
    if mark and digest != "".join(DIGITS[value // 62**power % 62] for power in reversed(range(6))):
        raise ValueError("its letters do not match its digest: it is incomplete or was changed")
    if not body or DIGITS[len(body[:-1]) % 62] != body[-1]:
        raise ValueError("its letters do not match its checksum: it is incomplete")
    return body[:-1]


def _joint(row: Row, kind: int, left_out: Counter[str]) -> Joint:
    slides, carrier = kind & 1, row["carrier"]
    left_out.update({"paths of points": kind >> 4 & 1, "drawn cylinders": kind >> 5})
    slot, speed, mass = (row["a"], row["b"]), row.number("speed"), row.number("mass")
    if carrier + "".join(slot) and not (carrier and all(slot) and slides and not kind & 4):
        raise ValueError(f"its slot {carrier},{','.join(slot)} is not known")
    if (mass or row["weld"]) and not slides:
        raise ValueError("it turns, and its mass and weld are those of a slider")
    left_out["speeds of joints that are no inputs"] += bool(speed) and not kind & 2
    weld = bool(kind >> 3 & 1 or row.number("weld"))
    return Joint(row["id"], row["name"], row.place("x", "y"), "RP"[slides], [], row.number("angle"), bool(kind & 4),
                 bool(kind & 2), speed, weld, not weld, carrier, slot if carrier else None, mass)


def _link(row: Row, linkage: Read, of: Mapping[str, Joint], whole: dict[str, str]) -> None:
    """A link with its joints and its mass, or a member of links that are welded together."""
    key, letter, kind, cells = row["id"], row.text[0], row.text[1:2], row.text.split(",")[7:]
    joints = [*takewhile(bool, cells)]
    if letter not in ROOTS + MEMBERS or kind not in ("R", "P"):
        raise ValueError(f"its letters {row.text[:2]!r} are not known")
    if strange := [joint for joint in joints if joint not in of]:
        raise ValueError(f"its joint {strange[0]!r} is missing")
    if not joints or joints == cells:
        raise ValueError("its joints have no end" if joints else "it has no joints")
    linkage.left_out.update({f"the name {row['name']} of {key}": row["name"] not in ("", key),
                             "discs and computed inertias": letter not in "YN"})
    if letter in MEMBERS:
        linkage.left_out["members of welded links"] += 1
        return
    for joint in joints:
        of[joint].links.append(key)
    whole.update(dict.fromkeys(filter(None, cells[len(joints) + 1 :]), key))
    linkage.weigh(row, key)
    if kind == "P":
        linkage.masses[key] = *linkage.masses[key][:2], of[joints[0]].at


def _bits(letters: str) -> int:
    """Flags in letters of base 64."""
    return _integer("1" + letters) - (1 << 6 * len(letters))


def _decimal(letters: str) -> float:
    """A number in thousandths, or one that an extension gives."""
    return float(letters[1:]) if letters[:1] == "=" else _integer(letters) / 1000


def _rate(letters: str) -> float:
    """A whole number, or one that an extension gives."""
    return float(letters[1:]) if letters[:1] == "=" else _integer(letters)


def _integer(letters: str) -> int:
    """A whole number in letters of base 64; a 0 before it is its minus."""
    if strange := {*letters} - {*DIGITS}:
        raise ValueError(f"{letters!r} is no number, because of {min(strange)!r}")
    value: int = reduce(lambda value, letter: 64 * value + DIGITS.index(letter), letters, 0)
    return -value if letters[:1] == "0" else value
