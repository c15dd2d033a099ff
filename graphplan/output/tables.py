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
from dataclasses import dataclass, replace
from typing import IO, Any, NamedTuple

import numpy as np

from graphplan.mechanism.model import Scene
from graphplan.mechanism.travel import printed_travels
from graphplan.mechanism.units import FORCE, LENGTH, MOMENT
from graphplan.methods import kinds
from graphplan.methods.results import axes, balances, facts, forces, pair_forces
from graphplan.phrases import Said, arrange, digits, join, said, unit
from graphplan.sheet.tolerances import ZERO_TOL

ROWS = 4096  # written in one call

Results = Mapping[str, Mapping[str, Any]]
Columns = Sequence[tuple[str, Any]]  # headings with arrays of shape (n,)


def text(scene: Scene, travel: Any, points: Mapping[str, Any], results: Results, faults: Mapping[int, str],
         efficiency: Any = None) -> str:
    """Comma-separated text: a heading, then one line for each pose; what there is not is left empty, and says why.

    Numbers have as many digits as tell them apart.
    """
    columns = [*pose_columns(scene, travel, points, results, efficiency)]
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


def pose_columns(scene: Scene, travel: Any, points: Mapping[str, Any], results: Results,
                 efficiency: Any = None) -> Iterator[tuple[str, Any]]:
    """Each column with its heading, such as `A.vx [mm/s]`."""
    for column in _columns(scene, travel, points, results, efficiency):
        yield f"{column.name} [{column.unit}]" if column.unit else column.name, column.values


class TableQuantity(NamedTuple):
    """What a table has by a name: words for it, its unit, and its values over the poses, of vectors complex; of a
    result its kind."""

    name: str
    label: Said | str
    unit: str
    values: Any
    kind: str = ""

    @property
    def is_vector(self) -> bool:
        return bool(np.iscomplexobj(self.values))


def _columns(scene: Scene, travel: Any, points: Mapping[str, Any], results: Results,
             efficiency: Any) -> Iterator[TableQuantity]:
    """Yield the columns of a table, numbers all; the last are sizes and directions of forces, and the efficiency."""
    long, (unit, gone) = LENGTH.unit(scene.units), printed_travel(scene, travel)
    yield TableQuantity(TRAVEL, TRAVEL, unit, gone)
    for name, z in points.items():
        for axis, coordinate in axes(z).items():
            yield TableQuantity(f"{name}.{axis}", f"{name}.{axis}", long, coordinate)
    for fact in facts(results):
        for heading, column in fact.columns.items():
            yield TableQuantity(heading, heading, fact.unit(scene.units), column)
    for name, force in forces(scene, results).items():
        yield TableQuantity(f"{name}.{SIZE}", f"{name}.{SIZE}", FORCE.unit(scene.units), np.abs(force))
        yield TableQuantity(f"{name}.{DIRECTION}", f"{name}.{DIRECTION}", "deg", direction(force))
    if efficiency is not None:
        yield TableQuantity(EFFICIENCY, said("efficiency"), "", efficiency)


def named_quantities(scene: Scene, points: Mapping[str, Any], results: Results,
                     efficiency: Any = None) -> dict[str, TableQuantity]:
    """Return all that a table has, by the names that its files have: `velocity A`, `reaction 2 at B`, `point A`, and
    columns such as `A.vx` or `2 at B.size`."""
    quantities = [TableQuantity(f"point {name}", name, LENGTH.unit(scene.units), z, "point")
                  for name, z in points.items()]
    quantities += [TableQuantity(fact.name, join((fact.kind.words, fact.of), " "), fact.unit(scene.units), fact.value,
                            fact.kind) for fact in facts(results)]
    columns = _columns(scene, np.zeros(0), points, results, efficiency)
    return {quantity.name: quantity for quantity in (*quantities, *columns) if quantity.name != TRAVEL}


def quantity_groups(scene: Scene, quantities: Mapping[str, TableQuantity]) -> dict[str, list[str]]:
    """Return the names of several quantities by a name for them: a kind of result, such as `velocity`; `reaction`, of
    all pairs or of a joint, such as `reaction B`, and `balance`, with friction where there is any."""
    groups = dict[str, list[str]]()
    for quantity in quantities.values():
        if quantity.kind:
            groups.setdefault(str(quantity.kind), []).append(quantity.name)
    groups["reaction"] = []
    for pair in pair_forces(scene):
        names = [f"{also} {pair.name}" for kind in kinds.REACTIONS for also in (kinds.WITH_FRICTION[kind], kind)]
        for name in [name for name in names if name in quantities][:1]:
            groups["reaction"].append(name)
            groups.setdefault(f"reaction {pair.point or pair.name}", []).append(name)
    groups["balance"] = []
    for name, balance in scene.loads.named_balances.items() if scene.loads else ():
        ways = (kinds.RUBBED, kinds.BY_PLANS, kinds.BY_LEVER)
        names = [f"{kinds.balance_kind(way, balance)} {name}" for way in ways]
        groups["balance"] += [name for name in names if name in quantities][:1]
    return {name: members for name, members in groups.items() if members}


def direction(z: Any) -> Any:
    """Return the directions of vectors in degrees, counter-clockwise from x, above -180 and up to 180."""
    return np.degrees(np.angle(z + 0.0))


@dataclass(frozen=True)
class Largest:
    """The largest value of a quantity over the poses in which it is known, of a vector (complex) by its size; the pose
    by its place and its travel; and the root mean square of all, of which `squares` is the sum over `count` poses."""

    value: Any
    pose: int
    travel: float
    squares: float
    count: int

    @classmethod
    def over(cls, values: Any, travels: Any, earlier: int = 0) -> Largest | None:
        """Return it of poses after so many earlier ones, of values that differ by rounding the first; None where no
        value is known."""
        sizes = np.abs(values)
        if not np.isfinite(sizes).any():
            return None
        k = int(np.argmax(sizes >= (1 - ZERO_TOL) * np.nanmax(sizes)))
        return cls(values[k].item(), earlier + k, float(travels[k]), float(np.nansum(sizes**2)),
                   int(np.isfinite(sizes).sum()))

    @property
    def rms(self) -> float:
        """The root mean square."""
        return math.sqrt(self.squares / self.count)

    def merge(self, other: Largest) -> Largest:
        """Return the largest value of these poses and of others after them."""
        larger = max(self, other, key=lambda one: abs(one.value))
        return replace(larger, squares=self.squares + other.squares, count=self.count + other.count)

    @property
    def data(self) -> dict[str, float]:
        """JSON: of a force its `size` and `direction`, of a moment its `value`; `pose`, `travel` and `rms`."""
        sized = {SIZE: abs(self.value), DIRECTION: float(direction(self.value))} if isinstance(
            self.value, complex) else {VALUE: self.value}
        return {**sized, "pose": self.pose, TRAVEL: self.travel, "rms": self.rms}


class LargestLoads:
    """The largest of each force and each balancing moment, over poses that come block by block."""

    def __init__(self, scene: Scene):
        self.scene, self.by_name, self.poses = scene, dict[str, Largest](), 0

    def add(self, travel: Any, results: Results) -> None:
        """Take in the next block."""
        travels = printed_travel(self.scene, travel)[1]
        for name, values in {**forces(self.scene, results), **balancing_moments(self.scene, results)}.items():
            if largest := Largest.over(values, travels, self.poses):
                self.by_name[name] = self.by_name[name].merge(largest) if name in self.by_name else largest
        self.poses += len(travels)

    @property
    def data(self) -> dict[str, dict[str, dict[str, float]]]:
        """JSON: all of them by name as `largest`, where there are any."""
        return {LARGEST: {name: largest.data for name, largest in self.by_name.items()}} if self.by_name else {}

    def remarks(self) -> Iterator[str]:
        """Yield a line for each: its largest value with its place, and the root mean square."""
        gone = printed_travel(self.scene, np.zeros(1))[0]
        place = "°" if gone == "deg" else f" {gone}"
        for name, largest in self.by_name.items():
            value, of = (abs(largest.value), FORCE) if isinstance(largest.value, complex) else (largest.value, MOMENT)
            measure = of.sheet_unit(self.scene.units)
            yield (f"{name}: largest {value:.4g} {measure} at {largest.travel:.5g}{place}, "
                   f"root mean square {largest.rms:.4g} {measure}")


def balancing_moments(scene: Scene, results: Results) -> dict[str, Any]:
    """Return the balances among results that are moments, by names such as `balance 1`, with friction where there is
    any."""
    by_name = balances(scene, results, (kinds.RUBBED, kinds.BY_PLANS, kinds.BY_LEVER))
    return {f"balance {name}": moment for name, moment in by_name.items() if not np.iscomplexobj(moment)}


TRAVEL, FAULTS, EFFICIENCY, LARGEST = "travel", "faults", "efficiency", "largest"
SIZE, DIRECTION, VALUE = "size", "direction", "value"  # of forces, and of moments
FULL_TURN = 360.0  # degrees
READ_BYTES = 1 << 20  # of a file that is sent on, at once


class ColumnSpool:
    """Data of each column, block by block, in one temporary file of a folder; `size` is its length."""

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
    """JSON: `travel`, `points` and each kind of result by name as lists, vectors as [x, y]; null where there is none;
    of forces `size` and `direction`; `efficiency`; and what holds for the whole motion.
    """

    def __init__(self, scene: Scene, folder: str):
        self.scene, self.spool = scene, ColumnSpool(folder)

    def add(self, travel: Any, points: Mapping[str, Any], results: Results, faults: Mapping[int, str],
            efficiency: Any = None) -> None:
        """Take in a block, whose faults are by the place among all poses."""
        travels, results = printed_travel(self.scene, travel)[1], {
            **results, **sizes_and_directions(forces(self.scene, results))}
        self.spool.add((TRAVEL, ""), _json(travels.tolist())[1:-1])
        if efficiency is not None:
            self.spool.add((EFFICIENCY, ""), _json([*_numbers_of(efficiency)])[1:-1])
        for kind, named in {"points": points, **results}.items():
            for name, z in named.items():
                self.spool.add((kind, name), _json([*_numbers_of(z)])[1:-1])
        self.spool.add((FAULTS, ""), _json({str(pose): why for pose, why in faults.items()})[1:-1])

    def parts(self, motion: Mapping[str, Any]) -> Iterator[bytes]:
        """The file, column after column: what holds one is written as empty, and cut where the column stands in it."""
        units = {"length": self.scene.units.length, "travel": printed_travel(self.scene, np.zeros(1))[0],
                 **({"force": self.scene.units.force} if self.scene.loads else {})}
        yield _json({"title": self.scene.title, "units": units, TRAVEL: []})[:-2]
        yield from self._joined(TRAVEL, "")
        yield b"]"
        names_by_kind: dict[str, list[str]] = {"points": []}
        for kind, name in self.spool.places:
            if kind not in (TRAVEL, FAULTS, EFFICIENCY):
                names_by_kind.setdefault(kind, []).append(name)
        for kind, names in names_by_kind.items():
            yield b", " + _json({kind: {}})[1:-2]
            for number, name in enumerate(names):
                yield b", " * bool(number) + _json({name: []})[1:-2]
                yield from self._joined(kind, name)
                yield b"]"
            yield b"}"
        if (EFFICIENCY, "") in self.spool.places:
            yield b", " + _json({EFFICIENCY: []})[1:-2]
            yield from self._joined(EFFICIENCY, "")
            yield b"]"
        yield b", " + _json({**motion, FAULTS: {}})[1:-2]
        yield from self._joined(FAULTS, "")
        yield b"}}\n"

    def _joined(self, kind: str, name: str) -> Iterator[bytes]:
        """Yield the data of a column."""
        for number, data in enumerate(self.spool.read((kind, name))):
            yield b", " + data if number else data


def sizes_and_directions(of_forces: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Return the sizes of forces by name, and their directions in degrees, where there are forces."""
    named = {SIZE: {name: np.abs(force) for name, force in of_forces.items()},
             DIRECTION: {name: direction(force) for name, force in of_forces.items()}}
    return named if of_forces else {}


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
        self.scene, self.folder, self.spool = scene, folder, ColumnSpool(folder)
        self.kinds: dict[str, np.dtype[Any]] = {}
        self.faults: dict[int, str] = {}
        self.count = 0

    def add(self, travel: Any, points: Mapping[str, Any], results: Results, faults: Mapping[int, str],
            efficiency: Any = None) -> None:
        """Take in a block, whose faults are by the place among all poses."""
        sizes = sizes_and_directions(forces(self.scene, results))
        arrays = {"travel": travel, **{fact.name: fact.value for fact in facts(results)},
                  **{f"point {name}": z for name, z in points.items()},
                  **{f"{kind} {name}": z for kind, named in sizes.items() for name, z in named.items()},
                  **({} if efficiency is None else {EFFICIENCY: efficiency})}
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
