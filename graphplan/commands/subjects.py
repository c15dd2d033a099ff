"""Subjects as commands: a flywheel, a motion, a balanced linkage or rotor, a cam.

Each of their commands asks the public layer for its subject, and the subject writes what the output's ending says.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from graphplan.commands.choices import question, text_of_scene
from graphplan.commands.output import Messages, kind
from graphplan.errors import Refused
from graphplan.public.subjects import Subject

if TYPE_CHECKING:
    from graphplan.mechanism.model import Scene

__all__ = ["JSON", "SCENE", "Subject", "add_steps", "load_driven", "run_subject"]

SCENE, JSON = (".toml",), (".json",)  # endings of what alone an option applies to


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
        if (value := getattr(options, option, None)) not in (None, False) and ending not in applies:
            raise Refused(f"--{option}" if value is True else f"--{option} {value}",
                          f"it does not apply to a {ending}", f"leave it out, or -o FILE{applies[0]}")
    subject = find(options, ending, messages)
    messages.progress("")
    for remark in subject.remarks:
        messages.remark(remark)
    subject.save(options.output, steps=options.steps)
    return 0


def load_driven(options: argparse.Namespace) -> Scene:
    """The scene that is named, driven by its first drive."""
    from graphplan.mechanism.written_scene import parse

    scene = parse(text_of_scene(options, options.scene), options.scene, by_drive=True)
    question(options, scene)
    return scene
