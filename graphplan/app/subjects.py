"""Subjects: what is computed and drawn besides constructions, such as flywheels and cams.

Each is one record of what can be written of it. By the ending of a file one of these is made and written: the sheet,
the numbers as JSON, with the steps of the sheet where these are asked for, or another file, such as a table.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Protocol, Self

from graphplan.app.files import SHEETS, as_json, kind, write, write_sheets
from graphplan.mechanism.written_scene import load

if TYPE_CHECKING:
    from graphplan.accuracy.drafted import Drafted
    from graphplan.mechanism.model import Scene
    from graphplan.sheet.panels import PanelSheet

JSON = ".json"


@dataclass(frozen=True, repr=False)
class Subject:
    """Outputs of a subject, each made when it is asked for.

    `sheet` is that on a paper of this name: on the `paper` that is named, or on the smallest of some `papers` on which
    it has room. `numbers` are plain data for JSON, lists of them in `rows`. `files` are made for other endings; the
    `remarks` are worth knowing, though nothing is wrong. `name` and `endings` are what it is, and how it is written.
    """

    sheet: Callable[[str], PanelSheet]
    numbers: Callable[[], dict[str, Any]]
    paper: str
    papers: Sequence[str] = ("A3", "A2", "A1")
    files: Mapping[str, Callable[[], str | bytes]] = field(default_factory=dict)
    remarks: Iterable[str] = ()
    rows: bool = True
    name: str = "subject"
    endings: Sequence[str] = (JSON, *SHEETS)

    @property
    def one_sheet(self) -> PanelSheet:
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
        """The command's JSON; with the `steps` of the sheet, to be executed on paper."""
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
            from graphplan.sheet.panels import pages

            write_sheets(pages(self.sheet, self.paper, self.papers), path, ending[1:], dpi)
        else:
            write(self.text(steps), path)

    def __repr__(self) -> str:
        return f"<{self.name}; save it as {', '.join(self.endings)}>"

    def _repr_svg_(self) -> str:
        """The sheet, drawn when a notebook asks."""
        from graphplan.output.svg import svg
        from graphplan.sheet.panels import pages

        return svg(pages(self.sheet, self.paper, self.papers)[0])


def driven_scene(source: Scene | str | os.PathLike[str]) -> Scene:
    """A scene, or that in a file or packaged, driven by its first drive where no balance holds its loads."""
    from graphplan.mechanism.model import Scene
    from graphplan.mechanism.written_scene import WrittenScene, parse

    if isinstance(source, WrittenScene) and not source.by_drive:
        return replace(parse(source.text, source.name, by_drive=True), sheet=source.sheet)
    return source if isinstance(source, Scene) else load(source, by_drive=True)


class FoundMechanism(Protocol):
    """A mechanism found for a task, which can stand instead of a scene: in handouts, on live pages, in classes."""

    def with_sheet(self, keys: Mapping[str, Any]) -> Self:
        """Return the mechanism with other keys of [sheet]."""

    def on_paper(self) -> Drafted:
        """The construction on its sheet."""

    def save_handout(self, path: str, only: str | None, offered: Collection[str] | None) -> None:
        """Write a handout of the task."""

    def live_page(self, offered: Collection[str] | None) -> str:
        """The page on which what is given is dragged."""

    def write_variants(self, folder: str, request: Any) -> None:
        """Make the tasks of a class, as a `ClassRequest` asks for them, in a new folder."""

    def desk(self, weights: Any, keys: Mapping[str, Any], words: Mapping[str, Any]) -> Any:
        """The `Desk` on which drawings of the task are judged."""
