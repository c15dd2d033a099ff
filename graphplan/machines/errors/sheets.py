"""Sheets of errors of position: a construction for each dimension, with what its plan means; all errors on the last."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from graphplan.accuracy.drafted import draft
from graphplan.accuracy.hand import Pencil
from graphplan.machines.errors.errors import PartialError, PositionErrors
from graphplan.machines.errors.transformed import DrivenPosition
from graphplan.phrases import Said, arrange, digits, join, said, unit
from graphplan.sheet.layout.layout import pages
from graphplan.sheet.plates.display import Sheet
from graphplan.words.tongue import tongue

DOCUMENT = said("Errors of position")


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
    """What the velocities of a transformed mechanism mean: coefficients and partial errors."""
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
