"""The cam of a task as what can be written of it: sheet, numbers, profile in true size, scene."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Unpack

from graphplan.app.drafting import SheetKeywords, with_sheet
from graphplan.app.subjects import Subject
from graphplan.cams.tolerances import LEAST_TOLERANCE
from graphplan.errors import Refused
from graphplan.output import load_writer

if TYPE_CHECKING:
    from graphplan.cams.task import Task
    from graphplan.sheet.panels import PanelSheet

CAM_ENDINGS = (".svg", ".pdf", ".png", ".tex", ".dxf", ".json", ".toml")
POSITIONS, TOLERANCE = 360, 0.001


def cam(task: str | os.PathLike[str], *, at: float | None = None, positions: int | None = None,
        tolerance: float | None = None, **options: Unpack[SheetKeywords]) -> Subject:
    """The cam of a task, from the law of its follower: base circle, profile by inversion, sheet.

    Reads a task file, the pose of the scene that it can be written as (`at`, in degrees), in how many `positions` it is
    tabled, and how far arcs may be off the profile (`tolerance`, in the task's lengths). Saved as .dxf it is the
    profile in true size, as .toml a scene in one pose.
    Fails with `SceneError` where the task is faulty and with `Refused` where the cam cannot be made.
    """
    from graphplan.cams.task import load

    return find_cam(with_sheet(load(os.fspath(task)), options), at, positions, tolerance)


def find_cam(task: Task, at: float | None = None, positions: int | None = None,
             tolerance: float | None = None) -> Subject:
    """The cam of a task that is read."""
    from graphplan.cams.check import check_cam
    from graphplan.cams.construction import draw_cam
    from graphplan.cams.exports import numbers, scene_text
    from graphplan.cams.profile import make_loaded_cam

    if tolerance is not None and not LEAST_TOLERANCE <= tolerance < float("inf"):
        raise Refused("--tolerance", f"{tolerance:g}", "give a length above 0, 1e-9 at least")
    if at is not None and not abs(at) < float("inf"):
        raise Refused("--at", f"{at:g}", "give an angle in degrees")
    profile = make_loaded_cam(task)
    drawing = draw_cam(profile)
    check, arcs_off = check_cam(drawing), TOLERANCE if tolerance is None else tolerance

    def sheet(paper: str) -> PanelSheet:
        from graphplan.cams.sheet import cam_sheet

        return cam_sheet(paper, drawing, check)

    def profile_dxf() -> bytes:
        content: bytes = load_writer("graphplan.cams.full_size", "dxf").profile_dxf(profile, arcs_off)
        return content

    return Subject(sheet, lambda: numbers(drawing, positions or POSITIONS, arcs_off, check), profile.task.sheet.paper,
                   files={".toml": lambda: scene_text(profile, at or 0.0), ".dxf": profile_dxf},
                   remarks=[f"{task.name}: {note}" for note in profile.notes], rows=False, name="cam",
                   endings=CAM_ENDINGS)
