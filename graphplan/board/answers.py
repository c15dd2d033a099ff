"""What the board asks of a scene's text: an edit, its numbers, its sheet with the steps, its motion, files of it.

Each answer is plain data. Where the scene is faulty, or its pose singular, it has the command's words for that under
`faults`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import wraps
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from graphplan import leaves
from graphplan.app.drafting import drawable, on_paper, with_sheet
from graphplan.app.pages import sheet_files
from graphplan.app.results import find_results
from graphplan.board.edit import apply_operations
from graphplan.board.view import scene_data, written_language
from graphplan.cycle.turn import follow
from graphplan.errors import GraphplanError, Refused
from graphplan.mechanism.model import Scene
from graphplan.mechanism.structure import structure
from graphplan.mechanism.travel import travel_unit
from graphplan.mechanism.written_scene import parse
from graphplan.output import svg
from graphplan.output import text as words
from graphplan.sheet.layout.layout import pages

Answer = dict[str, Any]
POSES = 120  # of a motion, enough for it to run smoothly


def with_faults(answer: Callable[..., Answer]) -> Callable[..., Answer]:
    """A function whose errors are answers too."""
    @wraps(answer)
    def answer_or_faults(**values: Any) -> Answer:
        try:
            return answer(**values)
        except GraphplanError as error:
            prefix = f"{values.get('name', '')}: "
            return {"faults": [line.removeprefix(prefix) for line in error.lines]}
        except (ArithmeticError, LookupError, MemoryError, RecursionError, TypeError, ValueError) as error:
            return {"faults": [f"scene: no answer is found ({type(error).__name__}: {error}); another pose, or fewer "
                               "objects"]}

    return answer_or_faults


@with_faults
def edit_scene(text: str, name: str, operations: Sequence[Mapping[str, Any]]) -> Answer:
    """The text after operations, what these made, and the scene's objects and faults; `refused` says why there is
    nothing to be done."""
    try:
        text, names = apply_operations(text, name, operations)
    except Refused as refused:
        return {"text": text, "made": [], "refused": str(refused), **scene_data(text, name)}
    return {"text": text, "made": names, **scene_data(text, name)}


@with_faults
def find_numbers(text: str, name: str) -> Answer:
    """The results as `graphplan solve` prints them."""
    return {"results": find_results(parse(text, name)).json(), "faults": []}


def _scene_in(language: str, text: str, name: str) -> Scene:
    """The scene of a text, in a language where it names none."""
    return with_sheet(parse(text, name), {} if written_language(text) else {"language": language})


@with_faults
def draw_sheet(text: str, name: str, language: str) -> Answer:
    """The pages of the sheet as SVG, and its steps in words, with their stages."""
    scene = _scene_in(language, text, name)
    drafted = on_paper(scene, drawable(scene))
    steps = words.steps(drafted.composition, structure(drafted.drawing.scene).lines())
    return {"pages": [svg.svg(page) for page in pages(drafted.composition)], "faults": [],
            "steps": {key: steps[key] for key in ("entries", "stages", "readings", "structure", "forms", "cost")},
            "missing": list(map(str, drafted.drawing.missing))}


@with_faults
def follow_motion(text: str, name: str) -> Answer:
    """The places of all points around the travel of the first drive; null where it does not come."""
    scene = parse(text, name)
    turn = follow(scene, POSES)
    return {"travel": turn.travel.tolist(), "closed": turn.closed, "unit": travel_unit(scene), "faults": [],
            "points": {point: [[z.real, z.imag] if math.isfinite(abs(z)) else None for z in places.tolist()]
                       for point, places in turn.points.items()}}


@with_faults
def write_pdf(text: str, name: str, language: str) -> Answer:
    """The sheet as a PDF, in true size."""
    contents = sheet_files(_scene_in(language, text, name), None, "pdf").contents
    return {"pdf": contents[0][1], "faults": []}


@with_faults
def write_live_page(text: str, name: str, language: str) -> Answer:
    """The live page of the scene."""
    page = next(leaf.pages[".html"] for leaf in leaves.leaves().values() if ".html" in leaf.pages)
    return {"page": leaves.module(page).live_page(_scene_in(language, text, name)), "faults": []}


@with_faults
def import_file(file: str, data: bytes) -> Answer:
    """The scene in a file of another program, as text, and what was guessed."""
    from graphplan.importing.readers import import_scene  # few boards need the readers

    with TemporaryDirectory() as folder:
        path = Path(folder) / (Path(file.replace("\\", "/")).name or "file")
        path.write_bytes(data)
        try:
            text, remarks = import_scene(path)
        except Refused as refused:
            return {"faults": [str(refused).replace(f"{folder}/", "")]}
    return {"text": text, "remarks": [f"{remark}" for remark in remarks], "faults": []}


ANSWERS: Mapping[str, Callable[..., Answer]] = {
    "edit": edit_scene, "numbers": find_numbers, "sheet": draw_sheet, "motion": follow_motion, "pdf": write_pdf,
    "live": write_live_page, "import": import_file}
