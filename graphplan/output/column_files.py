"""Tables by columns of any number of poses, in the memory of a block: JSON, or numpy's archive of arrays.

Poses come block by block, but these files lie column after column: a temporary file takes what each block has of a
column, and at the end the columns are read from it, one after the other.
"""

from __future__ import annotations

import json
import tempfile
import zipfile
from collections.abc import Iterator, Mapping
from typing import IO, Any

import numpy as np

from graphplan.mechanism.model import Scene
from graphplan.methods.results import facts
from graphplan.output.tables import Results, printed_travel

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
