"""Subjects as commands: a flywheel, a motion, a balanced linkage or rotor, a cam.

Each of their commands computes its subject and gives one record of what can be written of it. By the ending of the
output one of these is made and written: the sheet, the numbers as JSON, with the steps of the sheet where these are
asked for, or another file, such as a table.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from graphplan.commands.choices import on_sheet, question
from graphplan.commands.output import SHEETS, Messages, as_json, kind, write, write_sheets
from graphplan.errors import Refused

if TYPE_CHECKING:
    from graphplan.mechanism.model import Scene
    from graphplan.output.panelled import Panelled

PNG, SCENE, JSON = (".png",), (".toml",), (".json",)  # endings of what alone an option applies to


@dataclass(frozen=True)
class Subject:
    """What can be written of a subject, each made when it is asked for.

    `sheet` is that on a paper of this name: on the `paper` that is named, or on the smallest of some `papers` on which
    it has room. `numbers` are plain data for JSON, lists of them in `rows`. `files` are made for other endings; the
    `remarks` are worth knowing, though nothing is wrong.
    """

    sheet: Callable[[str], Panelled]
    numbers: Callable[[], dict[str, Any]]
    paper: str
    papers: Sequence[str] = ("A3", "A2", "A1")
    files: Mapping[str, Callable[[], str | bytes]] = field(default_factory=dict)
    remarks: Iterable[str] = ()
    rows: bool = True

    @property
    def one_sheet(self) -> Panelled:
        """The sheet on one paper, whether its words have room or not."""
        return self.sheet(self.paper or self.papers[0])


def add_steps(command: argparse.ArgumentParser) -> None:
    """The option that gives the steps of a drawing in JSON."""
    command.add_argument("--steps", action="store_true", help="in JSON the steps of the drawing too, to be executed on "
                         "paper as those of `graphplan steps --json`")


def run_subject(options: argparse.Namespace, name: str, endings: Sequence[str],
                find: Callable[[argparse.Namespace, str, Messages], Subject], **only: Sequence[str]) -> int:
    """Write what is asked for of the subject that is found for an ending; `only` has those to which an option applies.
    """
    ending, messages = kind(options.output, endings, name), Messages(options.quiet)
    for option, applies in {**only, "steps": JSON}.items():
        if (value := getattr(options, option)) not in (None, False) and ending not in applies:
            raise Refused(f"--{option}" if value is True else f"--{option} {value}",
                          f"it does not apply to a {ending}", f"leave it out, or -o FILE{applies[0]}")
    subject = find(options, ending, messages)
    messages.progress("")
    for remark in subject.remarks:
        messages.remark(remark)
    if ending in subject.files:
        write(subject.files[ending](), options.output)
    elif ending in SHEETS:
        from graphplan.output.panelled import pages

        write_sheets(pages(subject.sheet, subject.paper, subject.papers), options.output, ending[1:], options.dpi)
    else:
        write(as_json(_numbers(options, subject), rows=subject.rows), options.output)
    return 0


def _numbers(options: argparse.Namespace, subject: Subject) -> dict[str, Any]:
    """The numbers, with the steps of the sheet where these are asked for."""
    numbers = subject.numbers()
    if options.steps:
        from graphplan.output.panel_protocol import protocol

        numbers |= {"protocol": protocol(subject.one_sheet)}
    return numbers


def load_driven(options: argparse.Namespace, change: Callable[[Scene], Scene] = lambda scene: scene) -> Scene:
    """The scene that is named, driven by its first drive, with a change that options ask for and on its sheet."""
    from graphplan.mechanism.scene import parse, source_text

    scene = on_sheet(options, change(parse(source_text(options.scene, options.scene), options.scene, by_drive=True)))
    question(options, scene)
    return scene
