"""Results over many poses as columns: comma-separated text, or numpy's archive of arrays."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from graphplan.mechanism.model import Scene
from graphplan.mechanism.units import LENGTH
from graphplan.methods.kinds import KINDS

Results = Mapping[str, Mapping[str, Any]]


def text(scene: Scene, travel: Any, points: Mapping[str, Any], results: Results, faults: Mapping[int, str]) -> str:
    """Comma-separated text: a heading, then one line for each pose; what there is not is left empty, and says why."""
    columns = dict(_columns(scene, travel, points, results))
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["pose", *columns, "fault"])
    for pose, numbers in enumerate(zip(*columns.values(), strict=True)):
        told = ["" if math.isnan(number) else repr(float(number) + 0.0) for number in numbers]
        writer.writerow([pose, *told, faults.get(pose, "")])
    return file.getvalue()


def archive(scene: Scene, travel: Any, points: Mapping[str, Any], results: Results, faults: Mapping[int, str]) -> bytes:
    """numpy's .npz: `travel`, complex arrays such as `point A`, `velocity A`, real ones such as `omega 3`.

    `fault_pose` and `fault_why` say which poses have no results, and why.
    """
    arrays = {f"{kind} {name}": z for kind, named in results.items() for name, z in named.items()}
    arrays |= {f"point {name}": z for name, z in points.items()}
    arrays |= {"fault_pose": np.array(list(faults), dtype=int), "fault_why": np.array(list(faults.values()), dtype=str)}
    file = io.BytesIO()
    np.savez_compressed(file, allow_pickle=False, travel=travel, **arrays)
    return file.getvalue()


def _columns(scene: Scene, travel: Any, points: Mapping[str, Any], results: Results) -> Iterator[tuple[str, Any]]:
    """Each column with its heading, such as `A.vx [mm/s]`."""
    sliding = scene.drives[0].slides
    long = LENGTH.unit(scene.units)
    yield f"travel [{long if sliding else 'deg'}]", travel if sliding else np.degrees(travel)
    for name, z in points.items():
        yield from _parts(f"{name}.", z, f"[{long}]")
    for kind, named in results.items():
        way, dimension = KINDS[kind].way, KINDS[kind].dimension
        for name, z in named.items():
            yield from _parts(f"{way} {name}.{dimension.letter}".strip(), z, f"[{dimension.unit(scene.units)}]")


def _parts(heading: str, z: Any, unit: str) -> Iterator[tuple[str, Any]]:
    """A real column, or the two components of a complex one."""
    if not np.iscomplexobj(z):
        yield f"{heading} {unit}", z
        return
    yield f"{heading}x {unit}", z.real
    yield f"{heading}y {unit}", z.imag
