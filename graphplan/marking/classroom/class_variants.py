"""The tasks of a class: to each student other numbers, a booklet to print, and the key."""

from __future__ import annotations

import os
from functools import partial
from typing import TYPE_CHECKING, Unpack

from graphplan.app.drafting import Keywords, Options, make_report, on_paper, on_sheet, options_of, with_rounds
from graphplan.errors import Refused
from graphplan.marking.classroom.class_files import ClassRequest, ClassWork, write_class
from graphplan.mechanism.model import Scene

if TYPE_CHECKING:
    from graphplan.accuracy.drafted import Drafted
    from graphplan.app.subjects import FoundMechanism


def variants(scene: Scene | FoundMechanism, folder: str | os.PathLike[str], n: int | None = None, *,
             names: str | os.PathLike[str] | None = None, seed: int = 1, jobs: int | None = None,
             **options: Unpack[Keywords]) -> None:
    """Make the tasks of a class in a new folder, as `graphplan variants` does.

    Reads a scene with a table [vary], or what `synthesize` finds for a task with one, how many tasks (or the CSV of the
    students' `names`; more tasks than names are spare ones), by which `seed` numbers are drawn, and how many processes
    work; further keywords say how it is drawn and what the sheets look like. The folder gets a scene or task for each
    variant, booklet.pdf, key.pdf, key.csv and class.json.
    Fails with `Refused` where nothing varies, or the folder is there and not empty.
    """
    request = ClassRequest(n, None if names is None else os.fspath(names), seed, jobs)
    write_variants(scene, os.fspath(folder), options_of(options), request)


def write_variants(scene: Scene | FoundMechanism, folder: str, options: Options, request: ClassRequest) -> None:
    """Write the variants of a class, with options and request in records of their own."""
    if not isinstance(scene, Scene):
        return scene.write_variants(folder, options, request)
    if not scene.vary:
        raise Refused(f"{scene.name}: vary", "the scene does not say what varies",
                      'a table [vary], such as "drive.0.omega" = [8, 10, 12]')
    write_class(partial(_class_of_scene, scene, options), folder, options, request)


def _class_of_scene(scene: Scene, options: Options) -> ClassWork:
    """The variants of a scene."""
    from graphplan.marking.classroom.booklet import overview, print_exercise
    from graphplan.marking.classroom.variants import SceneDesign
    from graphplan.marking.desk import key_rows

    draw = partial(draft_scene, options)
    drafted = draw(scene)
    return ClassWork(partial(SceneDesign, drafted, draw), partial(print_exercise, draw=draw, further=key_rows),
                     lambda lines: [*overview(drafted.composition, lines)], drafted.drawing.scene.title)


def draft_scene(options: Options, scene: Scene) -> Drafted:
    """A scene on its sheet, as the options say; fails as `graphplan draw` does."""
    scene = on_sheet(with_rounds(scene, options), options)
    return on_paper(scene, options, make_report(scene, options))
