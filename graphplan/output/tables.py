"""Results over many poses as columns: comma-separated text, or numpy's archive of arrays."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from graphplan.mechanism.model import Scene, Units

# What the readings of each kind are called in a column, and in which unit they stand.
HEADINGS = {
    "velocity": ("v", "{length}/s"),
    "acceleration": ("a", "{length}/s^2"),
    "omega": ("omega", "rad/s"),
    "alpha": ("alpha", "rad/s^2"),
    "slide velocity": ("v", "{length}/s"),
    "slide acceleration": ("a", "{length}/s^2"),
    "reaction": ("F", "{force}"),
    "slide reaction": ("F", "{force}"),
    "slide moment": ("M", "{force}*m"),
    "slide arm": ("r", "{length}"),
    "balance": ("F", "{force}"),
    "balance moment": ("M", "{force}*m"),
    "lever": ("F", "{force}"),
    "lever moment": ("M", "{force}*m"),
    "balance with friction": ("F", "{force}"),
    "balance moment with friction": ("M", "{force}*m"),
}
# What a numbered reading is the number of.
NUMBERED = {"balance": "balance", "balance moment": "balance", "lever": "lever", "lever moment": "lever",
            "balance with friction": "with friction", "balance moment with friction": "with friction"}

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


def archive(scene: Scene, travel: Any, points: Mapping[str, Any], results: Results,
            faults: Mapping[int, str]) -> bytes:
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
    yield ("travel " + _unit("{length}" if sliding else "deg", scene.units)), travel if sliding else np.degrees(travel)
    for name, z in points.items():
        yield from _parts(f"{name}.", z, _unit("{length}", scene.units))
    for kind, named in results.items():
        letter, unit = HEADINGS[kind]
        for name, z in named.items():
            of = f"{NUMBERED[kind]} {name}" if kind in NUMBERED else name
            yield from _parts(f"{of}.{letter}", z, _unit(unit, scene.units))


def _parts(heading: str, z: Any, unit: str) -> Iterator[tuple[str, Any]]:
    """A real column, or the two components of a complex one."""
    if not np.iscomplexobj(z):
        yield f"{heading} {unit}", z
        return
    yield f"{heading}x {unit}", z.real
    yield f"{heading}y {unit}", z.imag


def _unit(template: str, units: Units) -> str:
    return "[" + template.format(length=units.length, force=units.force) + "]"
