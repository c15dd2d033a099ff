"""Starts: small mechanisms to begin a scene with, every section explained by the words of the schema.

What is optional stands behind `#` without a blank; a paragraph of it holds as it is, once its `#` are taken away.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from graphplan.mechanism.fields import Fragment
from graphplan.mechanism.schema import scene

TOP = ("title", "source", "gravity")
LOADS = ("balance", "masses", "forces", "moments", "friction")  # one paragraph: all of them need a balance

HEAD = """\
# :schema ./scene.schema.json
# An editor (Even Better TOML, taplo) completes and checks this file once the blank is taken from the line above,
# and there is the file that it names, by: graphplan schema > scene.schema.json
# A line that begins with # and no blank is optional: take the # away to use it, with all its paragraph."""

FORCES = """\
# Forces: one paragraph, as each of its tables needs the balance; leave out the tables that are not wanted.
# With them [find] may name reactions = ["A", "3 along 2"], joints and slides; without that all reactions are found."""

INNER = ("items", "additionalProperties")  # where a schema says what stands in lists, and under names of the scene


@dataclass(frozen=True)
class Start:
    """A mechanism to begin with: its sections as TOML, those that it needs and those that it may have besides."""

    title: str
    needs: Mapping[str, str]
    may: Mapping[str, str] = field(default_factory=dict)

    @property
    def text(self) -> str:
        """The scene file."""
        sections = scene()["properties"]
        tables = [name for name in sections if name not in TOP and name not in LOADS]
        paragraphs = [HEAD, *self._title(sections), *(self._section(name, sections[name]) for name in tables)]
        loads = [self._section(name, sections[name]) for name in LOADS]
        return "\n\n".join([*paragraphs, "\n".join([FORCES, *loads])]) + "\n"

    def _title(self, sections: Fragment) -> Iterator[str]:
        """The keys that stand before all tables."""
        lines = {"title": f'title = "{self.title}"', "source": '#source = "Author, Title (year), figure 1"',
                 "gravity": "#gravity = [0, -9.81]"}
        yield "\n".join(_aligned((lines[name], sections[name]["description"]) for name in lines))

    def _section(self, name: str, section: Fragment) -> str:
        """A section: what it is, and its lines, or the start that shows them."""
        told = f"# {name}: {section['description']}"
        body = self.needs.get(name) or self.may.get(name)
        if body is None:
            other = next(kind for kind, start in STARTS.items() if name in {**start.needs, **start.may})
            return f"{told}; see graphplan new --kind {other}"
        mark, says = "" if name in self.needs else "#", dict(_keys(section))
        places = dict(_places(section)) if name == "points" else {}
        lines = [(mark + line, _said(line, says, places)) for line in body.strip().splitlines()]
        return "\n".join([told, *_aligned(lines)])


def _keys(fragment: Fragment) -> Iterator[tuple[str, str]]:
    """What is said of every key in a section."""
    for key, value in fragment.get("properties", {}).items():
        yield key, value["description"]
    for part in (*fragment.get("anyOf", ()), *(fragment[inner] for inner in INNER if fragment.get(inner))):
        yield from _keys(part)


def _places(points: Fragment) -> Iterator[tuple[frozenset[str], str]]:
    """What is said of each way to place a point, by its keys; coordinates have none."""
    ways = points["additionalProperties"]["anyOf"]
    return ((frozenset(way.get("properties", ())), way["description"]) for way in ways)


def _said(line: str, says: Mapping[str, str], places: Mapping[frozenset[str], str]) -> str:
    """What is said of the key in a line, or of the way in which it places a point."""
    if line.startswith("["):
        return ""
    ((key, value),) = tomllib.loads(line).items()
    return says.get(key) or places.get(frozenset(value if isinstance(value, dict) else ()), "")


def _aligned(rows: Iterable[tuple[str, str]]) -> list[str]:
    """Lines with what is said of them, in a column."""
    lines = list(rows)
    wide = max((len(line) for line, told in lines if told), default=0)
    return [f"{line:<{wide}}  # {told}" if told else line for line, told in lines]


def _loads(balance: str, link: str, at: str) -> dict[str, str]:
    """The loads that a start may have: on a link with a point beside its joints, or at one of them."""
    return {
        "balance": f"[balance]\n{balance}",
        "masses": f'[masses.{link}]\nmass = 1.5\ninertia = 0.002\ncentre = "{at}"',
        "forces": f'[[forces]]\non = "{link}"\nat = "{at}"\nvalue = [0, -100]',
        "moments": f'[[moments]]\non = "{link}"\nvalue = 2.5',
        "friction": '[[friction]]\nat = "A"\nradius = 5\ncoefficient = 0.1',
    }


UNITS = '[units]\nlength = "mm"\nforce = "N"\nmass = "kg"'
SHEET = '''[sheet]
paper = "A3"
frame = "iso"
language = "en"
convention = "real"
owner = "Chair of Mechanisms"
number = "TMM-01"
drawn_by = "graphplan"
scale = "1:2"'''
CRANK = '[[drive]]\nlink = "1"\nomega = 2\nalpha = 0'

STARTS = {
    "four-bar": Start("Four-bar linkage", {
        "points": """[points]
O = [0, 0]
C = [150, 0]
A = { from = "O", distance = 50, angle = 60 }
B = { distances = { A = 120, C = 90 }, side = "left" }
M = { on = "A B", distance = 60 }""",
        "links": '[links]\n1 = "O A"\n2 = "A M B"\n3 = "C B"\nframe = "O C"',
        "drive": CRANK,
    }, {"units": UNITS, "sheet": SHEET,
        "find": '[find]\nvelocity = ["B", "M"]\nacceleration = "all"\nlinks = ["2", "3"]',
        **_loads('link = "1"', "2", "M")}),
    "slider-crank": Start("Slider-crank", {
        "points": """[points]
O = [0, 0]
A = { from = "O", distance = 50, angle = 60 }
B = { distances = { A = 150 }, on = { through = "O", direction = [1, 0] }, pick = "right" }
M = { on = "A B", distance = 75 }""",
        "links": '[links]\n1 = "O A"\n2 = "A M B"\n3 = "B"\nframe = "O"',
        "slides": '[[slides]]\nlink = "3"\nalong = "frame"\nat = "B"\ndirection = [1, 0]',
        "drive": CRANK,
    }, {"units": UNITS, "sheet": SHEET, "find": '[find]\nvelocity = ["B"]\nacceleration = ["B", "M"]\n'
        'links = ["2"]\nslides = ["3 along frame"]',
        **_loads('link = "1"', "2", "M"), "friction": '[[friction]]\nslide = ["3", "frame"]\ncoefficient = 0.1'}),
    "slotted-link": Start("Slotted link with crank and block", {
        "points": """[points]
O = [0, 0]
C = [0, -120]
A = { from = "O", distance = 50, angle = 30 }
D = { on = "C A", distance = 250 }""",
        "links": '[links]\n1 = "O A"\n2 = "A"\n3 = "C D"\nframe = "O C"',
        "slides": '[[slides]]\nlink = "2"\nalong = "3"\nat = "A"\ndirection = "C D"',
        "drive": CRANK,
    }, {"units": UNITS, "sheet": SHEET, "find": '[find]\nvelocity = ["D"]\nacceleration = ["D"]\n'
        'links = ["3"]\nslides = ["2 along 3"]',
        **_loads('link = "1"', "3", "D")}),
    "cylinder": Start("Boom on a cylinder", {
        "points": """[points]
O = [0, 0]
E = [100, 0]
A = [60, 80]
C = [30, 40]
D = [30, 40]""",
        "links": '[links]\nboom = "E A"\nbarrel = "O C"\nrod = "D A"\nframe = "O E"',
        "slides": '[[slides]]\nlink = "rod"\nalong = "barrel"\nat = "D"\ndirection = "O C"',
        "drive": '[[drive]]\nslide = ["rod", "barrel"]\nspeed = 20\nacceleration = 0',
    }, {"units": UNITS, "sheet": SHEET, "find": '[find]\nvelocity = ["A"]\nacceleration = ["A"]\n'
        'links = ["boom"]\nslides = "all"',
        **_loads('on = "rod"\nat = "D"\ndirection = "O C"', "boom", "A")}),
    "open-chain": Start("Open chain, both ends moved", {
        "points": """[points]
K = [0, 0]
A = [60, 80]
B = [160, 90]
L = [200, 10]""",
        "links": '[links]\n1 = "K A"\n2 = "A B"\n3 = "B L"',
        "drive": '[[drive]]\nlink = "2"\nomega = -1\nrelative_to = "frame"',
        "motion": "[motion.K]\nvelocity = [100, 50]\nacceleration = [30, -80]\n[motion.L]\nvelocity = [0, 100]",
    }, {"units": UNITS, "sheet": SHEET, "find": '[find]\nvelocity = ["A", "B"]\nacceleration = ["A", "B"]'}),
    "blank": Start("Crank", {
        "points": "[points]\nO = [0, 0]\nA = [30, 40]",
        "links": '[links]\n1 = "O A"\nframe = "O"',
        "drive": CRANK,
        "find": '[find]\nvelocity = ["A"]\nacceleration = ["A"]\nlinks = ["1"]',
    }, {"units": UNITS, "sheet": SHEET, **_loads('link = "1"', "1", "A"),
        "friction": '[[friction]]\nat = "O"\nradius = 5\ncoefficient = 0.1'}),
}
