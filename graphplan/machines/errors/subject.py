"""The errors of a scene's positions as what can be written of them: numbers, and a sheet for each dimension."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from graphplan.accuracy.drafted import draft
from graphplan.app.drafting import pencil, translate_title, with_sheet
from graphplan.app.files import SHEETS, as_json, kind, write, write_sheets
from graphplan.app.subjects import JSON
from graphplan.design.hand import Pencil
from graphplan.machines.errors.errors import DrivenPosition, PartialError, PositionErrors
from graphplan.phrases import Said, arrange, digits, join, said, unit
from graphplan.sheet.layout.layout import pages
from graphplan.sheet.plates.display import Sheet
from graphplan.words.tongue import tongue

if TYPE_CHECKING:
    from graphplan.mechanism.model import Scene

DOCUMENT = said("Position errors")


def error_sheets(errors: PositionErrors, pencil: Pencil) -> list[Sheet]:
    """The sheets of all transformed mechanisms, each with its words, in the scene's language."""
    sheets: list[Sheet] = []
    say = tongue(errors.scene.sheet.language)
    for part in errors.parts:
        title = say(said("{0}: error of {1}", errors.scene.title, part.dimension.name))
        notes = [*part.report.drawing.notes, *_partial_errors(errors, part)]
        notes += _sums(errors) if part is errors.parts[-1] else ()
        drawing = replace(part.report.drawing, scene=replace(part.report.scene, title=title), notes=notes)
        sheets += pages(draft(drawing, pencil, check=part.report.check, tongue=say).composition, DOCUMENT)
    return sheets


def _partial_errors(errors: PositionErrors, part: PartialError) -> Iterator[Said]:
    """Yield the coefficients and partial errors that the velocities of a transformed mechanism give, in words."""
    yield said("The drives are held, and {0} grows by 1 {1} in a second: velocities are errors by this dimension.",
               part.dimension.name, "°" if part.dimension.is_angle else unit(errors.scene.units.length))
    for position in errors.positions:
        coefficient, measure = part.coefficients[position.name], _measure(errors, position)
        yield said("Error of {0}: {1} · {2} = {3} {4}.", position.name, digits(abs(coefficient)),
                   digits(part.tolerance), digits(part.error(position.name)), measure)


def _sums(errors: PositionErrors) -> Iterator[Said]:
    """The errors by all dimensions together."""
    for position in errors.positions:
        name, measure = position.name, _measure(errors, position)
        parts = join([arrange("{0}", digits(part.error(name))) for part in errors.parts], " + ")
        yield said("Largest error of {0}: {1} = {2} {3}; probable error {4} {3}.", name, parts,
                   digits(errors.largest(name)), measure, digits(errors.probable(name)))


def _measure(errors: PositionErrors, position: DrivenPosition) -> Said:
    """The unit of a position."""
    return unit(errors.scene.units.length if position.slide else "rad")


ERROR_ENDINGS = (JSON, *SHEETS)


@dataclass(frozen=True, repr=False)
class ErrorResults:
    """The errors of a scene's positions, checked."""

    errors: PositionErrors

    def json(self) -> dict[str, Any]:
        """The JSON of `graphplan errors`."""
        data: dict[str, Any] = json.loads(as_json(self.errors.data))
        return data

    def save(self, path: str | os.PathLike[str] | None, *, dpi: int | None = None) -> None:
        """Write what the ending of a path says, as the command does with -o, byte for byte: the numbers (.json), or the
        sheets of all dimensions, a .png in so many `dpi`. Fails with `Refused` where that cannot be."""
        path = None if path is None else os.fspath(path)
        ending = kind(path, ERROR_ENDINGS, "errors")
        if ending in SHEETS:
            sheets = error_sheets(self.errors, pencil(self.errors.scene))
            write_sheets(sheets, path, ending[1:], dpi, suffix="")
        else:
            write(as_json(self.errors.data), path)

    def __repr__(self) -> str:
        sums = ", ".join(f"{position.name}: {self.errors.largest(position.name):.4g}"
                         for position in self.errors.positions)
        return f"<errors of position: {sums}>"


def position_errors(scene: Scene | str | os.PathLike[str], **options: Any) -> ErrorResults:
    """Compute position errors of driven links from the scene's [tolerances], by transformed mechanisms.

    Reads a scene, or its file or packaged name; options say how plans are drawn (`method`, `plan`) and what the sheets
    look like. Gives coefficients, errors, their sum and the probable error of the slides and links that [find] asks
    for, else of the last link; lengths in the scene's unit, angles of links in rad. Fails with `Refused` where nothing
    has a tolerance, with `SingularPose` where the pose is singular.
    Source: O. Ozols, Mehānismu un mašīnu teorija (1974), section 18-3.
    """
    from graphplan.mechanism.model import Scene
    from graphplan.mechanism.written_scene import load

    return find_errors(with_sheet(scene if isinstance(scene, Scene) else load(scene), options))


def find_errors(scene: Scene) -> ErrorResults:
    """Compute the position errors of a scene."""
    from graphplan.machines.errors.errors import position_errors as find

    return ErrorResults(find(translate_title(scene)))
