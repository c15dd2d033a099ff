"""The records of PMKS and PMKS+: joints, loads, what a file has, and rows whose cells are known by their columns."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field

from graphplan.importing.written import number as number_text
from graphplan.marking.files.safe import number

CORNER = re.compile(r"b\d[xy]")  # the columns of a link's outline

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
    unit of length; `left_out` counts what a scene has no place for, `notes` say what else is to be known."""

    joints: list[Joint] = field(default_factory=list)
    welds: list[Sequence[str]] = field(default_factory=list)
    rate: str = ""
    speed: float = 0.0
    unit: str = ""
    title: str = ""
    masses: dict[str, tuple[float, float, complex]] = field(default_factory=dict)
    loads: list[Load] = field(default_factory=list)
    gravity: bool = False
    left_out: Counter[str] = field(default_factory=Counter)
    notes: list[str] = field(default_factory=list)

    def turn_at(self, rpm: float) -> None:
        """Set the speed of inputs without one of their own."""
        self.rate = f"rpm = {number_text(rpm)}" if rpm else ""

    def load(self, row: Row, link: str, out: bool, local: bool) -> Load:
        """Add a force along its arrow, which points to its end, or else to its start."""
        start, magnitude = row.place("startx", "starty"), row.number("mag")
        arrow = row.place("endx", "endy") - start
        if not arrow and magnitude:
            raise ValueError("its arrow has no length")
        self.loads.append(Load(link, row["name"] or row["id"], start,
                               (1 if out else -1) * magnitude * arrow / (abs(arrow) or 1.0), local))
        return self.loads[-1]

    def weigh(self, row: Row, link: str) -> None:
        """Give a link the mass of its row."""
        centre = row.place("center_of_mass_x", "center_of_mass_y")
        self.masses[link] = row.number("mass"), row.number("mass_moi"), centre


class Row:
    """The cells of a row by their columns; cells that are not read are counted as left out."""

    def __init__(self, what: str, cells: Sequence[str], columns: str, least: int = 0,
                 numeral: Callable[[str], float] = number, text: str = ""):
        """Fails with `ValueError` where there are more cells than columns, or fewer than the least."""
        names = columns.split()
        if len(cells) > len(names):
            raise ValueError(f"{what} {cells[0]}: field {len(names) + 1}, {cells[len(names)]!r}, is not known")
        if len(cells) < least:
            raise ValueError(f"{what} {cells[0]}: its field {names[len(cells)]} is missing")
        self.text, self.numeral = text, numeral
        self.cells: dict[str, str] = dict(zip(names, (cell.strip() for cell in cells), strict=False))
        self.unread = {*self.cells}

    def __getitem__(self, column: str) -> str:
        self.unread.discard(column)
        return self.cells.get(column, "")

    def number(self, column: str) -> float:
        """The number of a column, 0 of one that is empty."""
        return self.numeral(written) if (written := self[column]) else 0.0

    def place(self, x: str, y: str) -> complex:
        """The place that two columns give."""
        return complex(self.number(x), self.number(y))

    def holds(self, column: str) -> bool:
        """Whether a column says so."""
        written = self[column].lower()
        if written not in ("t", "true", "y", "f", "false", "n", ""):
            raise ValueError(f"{written!r} is neither true nor false")
        return written in ("t", "true", "y")


@contextmanager
def reading(where: str) -> Iterator[None]:
    """Say where something is wrong, or missing."""
    try:
        yield
    except (LookupError, TypeError, AttributeError) as error:
        missing = f"{error} is missing" if isinstance(error, KeyError) else "it is incomplete"
        raise ValueError(f"{where}: {missing}") from None
    except ValueError as error:
        raise ValueError(f"{where}: {error}") from None


def count_unread(linkage: Read, rows: Mapping[str, Sequence[Row]]) -> Read:
    """Count the cells that were not read; return the linkage."""
    for section, section_rows in rows.items():
        for row in section_rows:
            columns = dict.fromkeys(CORNER.sub("outline", column) for column in row.cells
                                    if column in row.unread and row.cells[column])
            linkage.left_out.update(f"{column} of {section}" for column in columns)
    return linkage
