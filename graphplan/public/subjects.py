"""What is computed and drawn besides constructions: flywheels, motions, balanced linkages and rotors; cams from the law
of their follower, and errors of position.

Each is one record of what can be written of it. By the ending of a file one of these is made and written: the sheet,
the numbers as JSON, with the steps of the sheet where these are asked for, or another file, such as a table.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Unpack

from graphplan.errors import Refused
from graphplan.mechanism.written_scene import load
from graphplan.output import load_writer
from graphplan.public.drafting import Options, SheetKeywords, on_sheet, options_of, pencil, with_presentation
from graphplan.public.files import SHEETS, as_json, kind, write, write_sheets

if TYPE_CHECKING:
    from graphplan.cams.task import Task
    from graphplan.check.position_errors import PositionErrors
    from graphplan.mechanism.model import Scene
    from graphplan.output.panelled import Panelled
    from graphplan.output.subjects.cam_sheet import CamSheet

JSON = ".json"


@dataclass(frozen=True, repr=False)
class Subject:
    """What can be written of a subject, each made when it is asked for.

    `sheet` is that on a paper of this name: on the `paper` that is named, or on the smallest of some `papers` on which
    it has room. `numbers` are plain data for JSON, lists of them in `rows`. `files` are made for other endings; the
    `remarks` are worth knowing, though nothing is wrong. `name` and `endings` are what it is, and how it is written.
    """

    sheet: Callable[[str], Panelled]
    numbers: Callable[[], dict[str, Any]]
    paper: str
    papers: Sequence[str] = ("A3", "A2", "A1")
    files: Mapping[str, Callable[[], str | bytes]] = field(default_factory=dict)
    remarks: Iterable[str] = ()
    rows: bool = True
    name: str = "subject"
    endings: Sequence[str] = (JSON, *SHEETS)

    @property
    def one_sheet(self) -> Panelled:
        """The sheet on one paper, whether its words have room or not."""
        return self.sheet(self.paper or self.papers[0])

    def text(self, steps: bool = False) -> str:
        """The numbers as the command prints them; with the `steps` of the sheet, to be executed on paper."""
        numbers = self.numbers()
        if steps:
            from graphplan.output.executable import protocol

            numbers |= {"protocol": protocol(self.one_sheet)}
        return as_json(numbers, rows=self.rows)

    def json(self, steps: bool = False) -> dict[str, Any]:
        """What the command prints, as JSON reads it; with the `steps` of the sheet, to be executed on paper."""
        data: dict[str, Any] = json.loads(self.text(steps))
        return data

    def save(self, path: str | os.PathLike[str] | None, *, steps: bool = False, dpi: int | None = None) -> None:
        """Write what the ending of a path says, as the command does with -o, byte for byte: the numbers (.json), the
        sheet, a .png in so many `dpi`, or one of the other files. Fails with `Refused` where that cannot be."""
        path = None if path is None else os.fspath(path)
        ending = kind(path, self.endings, self.name)
        if ending in self.files:
            write(self.files[ending](), path)
        elif ending in SHEETS:
            from graphplan.output.panelled import pages

            write_sheets(pages(self.sheet, self.paper, self.papers), path, ending[1:], dpi)
        else:
            write(self.text(steps), path)

    def __repr__(self) -> str:
        return f"<{self.name}; save it as {', '.join(self.endings)}>"

    def _repr_svg_(self) -> str:
        """The sheet, drawn when a notebook asks."""
        from graphplan.output.panelled import pages
        from graphplan.output.svg import svg

        return svg(pages(self.sheet, self.paper, self.papers)[0])


def driven_scene(source: Scene | str | os.PathLike[str]) -> Scene:
    """A scene, or that in a file or packaged, driven by its first drive where no balance holds its loads."""
    from graphplan.mechanism.model import Scene
    from graphplan.mechanism.written_scene import WrittenScene, parse

    if isinstance(source, WrittenScene) and not source.by_drive:
        return replace(parse(source.text, source.name, by_drive=True), sheet=source.sheet)
    return source if isinstance(source, Scene) else load(source, by_drive=True)


def driven_on_sheet(source: Scene | str | os.PathLike[str], options: Options,
                    change: Callable[[Scene], Scene] = lambda scene: scene) -> Scene:
    """The same with a change, on its sheet as the options have it."""
    return on_sheet(change(driven_scene(source)), options)


LEAST_TOLERANCE = 1e-9  # of an outline, that --tolerance takes
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

    return find_cam(load(os.fspath(task)), options_of(options), at, positions, tolerance)


def find_cam(task: Task, options: Options, at: float | None = None, positions: int | None = None,
             tolerance: float | None = None) -> Subject:
    """The cam of a task that is read."""
    from graphplan.cams.construction import draw_cam
    from graphplan.cams.exports import numbers, scene_text
    from graphplan.cams.forces import make_loaded_cam
    from graphplan.check.cams import check_cam

    if tolerance is not None and not LEAST_TOLERANCE <= tolerance < float("inf"):
        raise Refused("--tolerance", f"{tolerance:g}", "give a length above 0, 1e-9 at least")
    if at is not None and not abs(at) < float("inf"):
        raise Refused("--at", f"{at:g}", "give an angle in degrees")
    profile = make_loaded_cam(with_presentation(task, options))
    drawing = draw_cam(profile)
    check, arcs_off = check_cam(drawing), TOLERANCE if tolerance is None else tolerance

    def sheet(paper: str) -> CamSheet:
        from graphplan.output.subjects.cam_sheet import CamSheet

        return CamSheet(paper, drawing, check)

    return Subject(sheet, lambda: numbers(drawing, positions or POSITIONS, arcs_off, check), profile.task.sheet.paper,
                   files={".toml": lambda: scene_text(profile, at or 0.0),
                          ".dxf": lambda: load_writer("dxf", "cad.full_size").profile_dxf(profile, arcs_off)},
                   remarks=[f"{task.name}: {note}" for note in profile.notes], rows=False, name="cam",
                   endings=CAM_ENDINGS)


ERROR_ENDINGS = (JSON, *SHEETS)


@dataclass(frozen=True, repr=False)
class ErrorResults:
    """The errors of a scene's positions, checked, and how their sheets look."""

    errors: PositionErrors
    options: Options

    def json(self) -> dict[str, Any]:
        """What `graphplan errors` prints, as JSON reads it."""
        data: dict[str, Any] = json.loads(as_json(self.errors.data))
        return data

    def save(self, path: str | os.PathLike[str] | None, *, dpi: int | None = None) -> None:
        """Write what the ending of a path says, as the command does with -o, byte for byte: the numbers (.json), or the
        sheets of all dimensions, a .png in so many `dpi`. Fails with `Refused` where that cannot be."""
        path = None if path is None else os.fspath(path)
        ending = kind(path, ERROR_ENDINGS, "errors")
        if ending in SHEETS:
            from graphplan.output.subjects.error_sheets import error_sheets

            sheets = error_sheets(self.errors, pencil(self.options, self.errors.scene))
            write_sheets(sheets, path, ending[1:], dpi, suffix="")
        else:
            write(as_json(self.errors.data), path)

    def __repr__(self) -> str:
        sums = ", ".join(f"{position.name}: {self.errors.largest(position.name):.4g}"
                         for position in self.errors.positions)
        return f"<errors of position: {sums}>"


def position_errors(scene: Scene | str | os.PathLike[str], **options: Any) -> ErrorResults:
    """How far driven links are off where dimensions are off by the scene's [tolerances], by transformed mechanisms.

    Reads a scene, or its file or packaged name; options say how plans are drawn (`method`, `plan`) and what the sheets
    look like. Gives coefficients, errors, their sum and the probable error of the slides and links that [find] asks
    for, else of the last link; lengths in the scene's unit, angles of links in rad. Fails with `Refused` where nothing
    has a tolerance, with `SingularPose` where the pose is singular.
    Source: O. Ozols, Mehānismu un mašīnu teorija (1974), section 18-3.
    """
    from graphplan.mechanism.model import Scene
    from graphplan.mechanism.written_scene import load

    chosen = options_of(options)
    return find_errors(scene if isinstance(scene, Scene) else load(scene), chosen)


def find_errors(scene: Scene, options: Options) -> ErrorResults:
    """The same with options in one record."""
    from graphplan.check.position_errors import position_errors as find

    placed = on_sheet(scene, options)
    return ErrorResults(find(placed, method=options.method or placed.sheet.method,
                             plan=options.plan or placed.sheet.plan), options)
