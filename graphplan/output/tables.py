"""Tables of numbers over poses: CSV, and files of columns.

Poses come block by block, but these files lie column after column: a temporary file takes what each block has of a
column, and at the end the columns are read from it, one after the other.
"""

from __future__ import annotations

import json
import math
import tempfile
import zipfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import IO, Any, NamedTuple

import numpy as np

from graphplan.mechanism.model import Scene
from graphplan.mechanism.travel import printed_travels
from graphplan.mechanism.units import LENGTH
from graphplan.methods.results import axes, facts
from graphplan.phrases import Said, arrange, digits, join, unit

ROWS = 4096  # written in one call

Results = Mapping[str, Mapping[str, Any]]
Columns = Sequence[tuple[str, Any]]  # headings with arrays of shape (n,)


def text(scene: Scene, travel: Any, points: Mapping[str, Any], results: Results, faults: Mapping[int, str]) -> str:
    """Comma-separated text: a heading, then one line for each pose; what there is not is left empty, and says why.

    Numbers have as many digits as tell them apart.
    """
    columns = [*pose_columns(scene, travel, points, results)]
    return csv_head(columns) + csv_rows(columns, faults)


def csv_head(columns: Columns) -> str:
    """The heading of comma-separated text."""
    return ",".join(map(_csv_cell, ("pose", *(heading for heading, _ in columns), "fault"))) + "\n"


def csv_rows(columns: Columns, faults: Mapping[int, str], first: int = 0) -> str:
    """A line for each pose, from the first one's place on, by which faults are told.

    Python writes a list of lists in one call, much faster than numbers one by one.
    """
    lines = list[str]()
    for start in range(0, len(columns[0][1]), ROWS):
        rows = np.stack([column[start : start + ROWS] for _, column in columns], axis=1) + 0.0  # a zero has no sign
        numbers = str(rows.tolist())[2:-2].replace(", ", ",").replace("nan", "").split("],[")
        lines += [f"{pose},{row},{_csv_cell(faults.get(pose, ''))}" for pose, row in enumerate(numbers, first + start)]
    return "\n".join([*lines, ""])


def csv_text(headings: Iterable[str], rows: Iterable[Iterable[str | float]]) -> str:
    """Comma-separated text of headings and rows; numbers have as many digits as tell them apart, nan is left empty."""
    return "\n".join([*(",".join(map(_csv_cell, row)) for row in (headings, *rows)), ""])


class TableColumn(NamedTuple):
    """A column of numbers: its name in files, its letter and its unit on sheets, and its values."""

    name: str
    letter: Said | str
    unit: str
    values: Any


def column_csv(columns: Iterable[TableColumn]) -> str:
    """Comma-separated text of columns, their units in plain signs."""
    names, _, units, values = zip(*columns, strict=True)
    heads = (f"{name} [{plain_unit(measure)}]" if measure else name for name, measure in zip(names, units, strict=True))
    return csv_text(heads, np.stack(values, 1).tolist())


def quantity_table(columns: Sequence[TableColumn], first: int = 0) -> list[list[Said | str]]:
    """The rows of a table on paper, numbered from the first, under letters and units; nan is left empty."""
    heads = (join((column.letter, unit(column.unit))) if column.unit else arrange("{0}", column.letter)
             for column in columns)
    rows = zip(*(column.values for column in columns), strict=True)
    return [["", *heads], *([str(k), *("" if math.isnan(x) else digits(float(x)) for x in row)]
                            for k, row in enumerate(rows, first))]


def plain_unit(words: str) -> str:
    """A unit as files have it: kg*m^2 for kg m²."""
    return words.replace(" ", "*").replace("²", "^2").replace("°", "deg")


def _csv_cell(cell: str | float) -> str:
    """A cell as comma-separated text has it."""
    if isinstance(cell, float):
        return "" if math.isnan(cell) else repr(cell + 0.0)  # a zero has no sign
    return '"' + cell.replace('"', '""') + '"' if any(mark in cell for mark in ',"\n\r') else cell


def printed_travel(scene: Scene, travel: Any) -> tuple[str, Any]:
    """The drive's travel, and its unit."""
    return LENGTH.unit(scene.units) if scene.drives[0].slides else "deg", printed_travels(scene, travel)


def pose_columns(scene: Scene, travel: Any, points: Mapping[str, Any], results: Results) -> Iterator[tuple[str, Any]]:
    """Each column with its heading, such as `A.vx [mm/s]`."""
    long, (unit, gone) = LENGTH.unit(scene.units), printed_travel(scene, travel)
    yield f"travel [{unit}]", gone
    for name, z in points.items():
        yield from ((f"{name}.{axis} [{long}]", coordinate) for axis, coordinate in axes(z).items())
    for fact in facts(results):
        yield from ((f"{heading} [{fact.unit(scene.units)}]", column) for heading, column in fact.columns.items())


TRAVEL, FAULTS = "travel", "faults"
READ_BYTES = 1 << 20  # of a file that is sent on, at once


class ColumnSpool:
    """What blocks have of each column, in one temporary file of a folder; `size` is its length."""

    def __init__(self, folder: str):
        self.file: IO[bytes] = tempfile.TemporaryFile(dir=folder)  # noqa: SIM115
        self.places: dict[tuple[str, str], list[tuple[int, int]]] = {}
        self.size = 0

    def add(self, column: tuple[str, str], data: bytes) -> None:
        """Put a block's data of a column after those of the blocks before."""
        places = self.places.setdefault(column, [])
        if data:
            places.append((self.size, len(data)))
            self.file.write(data)
            self.size += len(data)

    def read(self, column: tuple[str, str]) -> Iterator[bytes]:
        """The data of a column, block after block."""
        for start, length in self.places[column]:
            self.file.seek(start)
            yield self.file.read(length)


class JsonTable:
    """JSON: `travel`, `points` and each kind of result by name as lists, vectors as [x, y]; null where there is none.

    `faults` says why, by the pose's place; what is found of the whole motion stands there too.
    """

    def __init__(self, scene: Scene, folder: str):
        self.scene, self.spool = scene, ColumnSpool(folder)

    def add(self, travel: Any, points: Mapping[str, Any], results: Results, faults: Mapping[int, str]) -> None:
        """Take in a block, whose faults are by the place among all poses."""
        self.spool.add((TRAVEL, ""), _json(printed_travel(self.scene, travel)[1].tolist())[1:-1])
        for kind, named in {"points": points, **results}.items():
            for name, z in named.items():
                self.spool.add((kind, name), _json([*_numbers_of(z)])[1:-1])
        self.spool.add((FAULTS, ""), _json({str(pose): why for pose, why in faults.items()})[1:-1])

    def parts(self, motion: Mapping[str, Any]) -> Iterator[bytes]:
        """The file, column after column: what holds one is written as empty, and cut where the column stands in it."""
        units = {"length": self.scene.units.length, "travel": printed_travel(self.scene, np.zeros(1))[0]}
        yield _json({"title": self.scene.title, "units": units, TRAVEL: []})[:-2]
        yield from self._joined(TRAVEL, "")
        yield b"]"
        names_by_kind: dict[str, list[str]] = {"points": []}
        for kind, name in self.spool.places:
            if kind not in (TRAVEL, FAULTS):
                names_by_kind.setdefault(kind, []).append(name)
        for kind, names in names_by_kind.items():
            yield b", " + _json({kind: {}})[1:-2]
            for number, name in enumerate(names):
                yield b", " * bool(number) + _json({name: []})[1:-2]
                yield from self._joined(kind, name)
                yield b"]"
            yield b"}"
        yield b", " + _json({**motion, FAULTS: {}})[1:-2]
        yield from self._joined(FAULTS, "")
        yield b"}}\n"

    def _joined(self, kind: str, name: str) -> Iterator[bytes]:
        """What the blocks have of a column."""
        for number, data in enumerate(self.spool.read((kind, name))):
            yield b", " + data if number else data


def _json(value: Any) -> bytes:
    return json.dumps(value, ensure_ascii=False).encode()


def _numbers_of(z: Any) -> Iterator[Any]:
    """The numbers of an array, or its vectors."""
    for number in z.tolist():
        if number != number:  # noqa: PLR0124
            yield None
        else:
            yield [number.real, number.imag] if isinstance(number, complex) else number


class ArchiveTable:
    """numpy's .npz: `travel`, complex arrays such as `point A`, `velocity A`, real ones such as `omega 3`.

    `fault_pose` and `fault_why` say which poses have no results, and why.
    """

    def __init__(self, scene: Scene, folder: str):
        self.folder, self.spool = folder, ColumnSpool(folder)
        self.kinds: dict[str, np.dtype[Any]] = {}
        self.faults: dict[int, str] = {}
        self.count = 0

    def add(self, travel: Any, points: Mapping[str, Any], results: Results, faults: Mapping[int, str]) -> None:
        """Take in a block, whose faults are by the place among all poses."""
        arrays = {"travel": travel, **{fact.name: fact.value for fact in facts(results)},
                  **{f"point {name}": z for name, z in points.items()}}
        for name, z in arrays.items():
            self.kinds[name] = z.dtype
            self.spool.add(("", name), np.ascontiguousarray(z).tobytes())
        self.count += len(travel)
        self.faults.update(faults)

    def parts(self, motion: Mapping[str, Any]) -> Iterator[bytes]:
        """The file, which is packed before its first bytes are known."""
        from numpy.lib import format as npy

        with tempfile.TemporaryFile(dir=self.folder) as packed:
            with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
                for name, kind in self.kinds.items():
                    with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
                        npy.write_array_header_1_0(member, {"descr": npy.dtype_to_descr(kind), "fortran_order": False,
                                                            "shape": (self.count,)})
                        member.writelines(self.spool.read(("", name)))
                for name, z in {"fault_pose": np.array([*self.faults], dtype=int),
                                "fault_why": np.array([*self.faults.values()], dtype=str)}.items():
                    with archive.open(f"{name}.npy", "w", force_zip64=True) as member:
                        npy.write_array(member, z, allow_pickle=False)
            packed.seek(0)
            yield from iter(lambda: packed.read(READ_BYTES), b"")
