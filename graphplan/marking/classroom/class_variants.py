"""The tasks of a class: to each student other numbers, a booklet to print, and the key."""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, Unpack

from graphplan.app.drafting import Keywords, make_report, on_paper, translate_title, with_sheet
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
    request = ClassRequest(n, None if names is None else os.fspath(names), seed, jobs, {**options})
    write_variants(scene, os.fspath(folder), request)


def write_variants(scene: Scene | FoundMechanism, folder: str, request: ClassRequest) -> None:
    """Write the variants of a class, as is asked for."""
    if not isinstance(scene, Scene):
        return scene.write_variants(folder, request)
    if not scene.vary:
        raise Refused(f"{scene.name}: vary", "the scene does not say what varies",
                      'a table [vary], such as "drive.0.omega" = [8, 10, 12]')
    write_class(partial(_class_of_scene, scene, request.keys), folder, request)


def _class_of_scene(scene: Scene, keys: Mapping[str, Any]) -> ClassWork:
    """The variants of a scene."""
    from graphplan.marking.classroom.booklet import overview, print_exercise
    from graphplan.marking.classroom.variants import SceneDesign
    from graphplan.marking.desk import key_rows

    draw = partial(draft_scene, keys)
    drafted = draw(scene)
    return ClassWork(partial(SceneDesign, drafted, partial(draw, words=False)),
                     partial(print_exercise, draw=draw, further=key_rows),
                     lambda lines: [*overview(drafted.composition, lines)], drafted.drawing.scene.title)


def draft_scene(keys: Mapping[str, Any], scene: Scene, *, words: bool = True) -> Drafted:
    """A scene on its sheet, with these keys of [sheet], with or without pages of words; fails as `graphplan draw` does.
    """
    scene = translate_title(with_sheet(scene, keys))
    return on_paper(scene, make_report(scene), words=words)
