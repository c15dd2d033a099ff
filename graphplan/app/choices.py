"""What several subcommands share: options, and what they are asked for (a scene, its construction, its sheet, a subject
that is written as the ending of its output says); messages on standard error.

Errors are always said, red on a terminal unless NO_COLOR is set (no-color.org); remarks, and which files were written,
unless `--quiet` is given; progress on a terminal alone.
"""

from __future__ import annotations

import argparse
import os
import sys
import tomllib
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

from graphplan.app import drafting
from graphplan.app.drafting import KEYS, with_sheet
from graphplan.app.files import STANDARD, kind
from graphplan.errors import Refused, printable
from graphplan.mechanism.sections import INERTIA, METHOD_PAIRS, METHODS, OF_PATHS, PREFERENCES
from graphplan.mechanism.units import SIZES
from graphplan.words import LANGUAGES

if TYPE_CHECKING:
    from graphplan.accuracy.drafted import Drafted
    from graphplan.app.subjects import FoundMechanism, Subject
    from graphplan.design.hand import Pencil
    from graphplan.mechanism.model import Scene
    from graphplan.mechanism.tasks import SheetTask

Task = TypeVar("Task", bound="SheetTask")
RED, PLAIN = "\x1b[31m", "\x1b[0m"
PROGRESS_WIDTH = 60  # of the line of progress, which is written over and over


def error(line: str) -> None:
    """Report an error."""
    coloured = sys.stderr.isatty() and not os.environ.get("NO_COLOR")
    _write_message(line, *((RED, PLAIN) if coloured else ("", "")))


def _write_message(line: str, before: str = "", after: str = "") -> None:
    """A line, which covers progress that may stand there."""
    text = printable(line)
    covering = f"{text:<{PROGRESS_WIDTH}}" if sys.stderr.isatty() else text
    _write_stderr(f"{before}{covering}{after}\n")


def _write_stderr(text: str) -> None:
    with suppress(OSError):  # there is no place to say so
        sys.stderr.write(text)
        sys.stderr.flush()


@dataclass(frozen=True)
class Messages:
    """The messages of a command besides errors and results."""

    quiet: bool

    def remark(self, line: str) -> None:
        """Report a remark."""
        if not self.quiet:
            _write_message(line)

    def progress(self, text: str) -> None:
        """Report progress, in place of the message before; empty when it is done."""
        if not self.quiet and sys.stderr.isatty():
            _write_stderr(f"\r{text:<{PROGRESS_WIDTH}}\r")


# Keys of a scene that readers take for options, by table.
IN_THE_SCENE = {f"--{key}": f"sheet.{key}" for key in KEYS} | {
    f"--{name}": f"flywheel.{name}" for name in ("speed", "unevenness", "closes")}
OF_A_MOTION = {f"--{name}": f"run.{name}" for name in ("speed", "travel")}


def count(option: str, least: int, most: int | None = None) -> Callable[[str], int]:
    """Return a reader of an option's whole number, within bounds."""
    right = f"at least {least}" if most is None else f"{least} to {most}"

    def read(text: str) -> int:
        try:
            number = int(text)
        except ValueError:
            number = least - 1
        if number < least or (most is not None and number > most):
            raise Refused(option, text, f"give {right}")
        return number

    return read


# --- declared ------------------------------------------------------------------------------------------------------


def add_choices(command: argparse.ArgumentParser, *, method: bool = True, strict: bool = False,
                inertia: bool = False) -> None:
    """The options that choose how it is drawn."""
    add = command.add_argument
    if method:
        add("--method", default="", choices=(*METHODS, *METHOD_PAIRS, *OF_PATHS), metavar="METHOD",
            help=f"how loci and rings are drawn ({', '.join(METHODS)}; a pair such as auxiliary,trial is for "
            f"velocities and for accelerations), or centres of curvature ({', '.join(OF_PATHS)}); by default the "
            "best for the pose")
    add("--plan", default="", metavar="PLAN", help="plan of motion: orthogonal, polar (velocity and acceleration "
        "polygons) or triangles (of gears), by default by the links' lengths; of forces: lever, polygons or both "
        "(default); such as polar,lever")
    add_settings(command)
    if inertia:
        add("--inertia", default="", choices=INERTIA, metavar="FORM",
            help="inertia forces: couple (default), shifted, points, percussion or static")
    if strict:
        add("--strict", action="store_true", help="compasses and straightedge alone, no set squares")


def add_settings(command: argparse.ArgumentParser) -> None:
    """The option that changes values of the scene, by their paths."""
    command.add_argument("--set", action="append", default=[], metavar="PATH=VALUE", dest="settings",
                         help="change a value of the scene, such as points.A.angle=40 or sheet.curves=all; entries of "
                         "lists count from 0, * is each")


def add_travel(command: argparse.ArgumentParser) -> None:
    """The option that asks for another pose."""
    command.add_argument("--at", metavar="TRAVEL", help="the pose after the drive has moved by TRAVEL, in degrees or "
                         "lengths (of several drives such as 60,-30, or the first one's); or an extreme position, "
                         "outer or inner, such as 'outer 3' of link 3")


def add_language(command: argparse.ArgumentParser) -> None:
    """The option that chooses the language; by default the scene's."""
    command.add_argument("--language", default="", choices=LANGUAGES,
                         help="the language of all words (the scene's, or en)")


def add_offer(command: argparse.ArgumentParser) -> None:
    """The option that lists what may be chosen on the page."""
    command.add_argument("--choices", type=drafting.choices_of, metavar="WHAT",
                         help=f"what can be chosen on the page: {', '.join(drafting.CHOICES)}, some languages such as "
                         "de,lv, or none; by default plans, and languages if the page stays small")


def add_paper(command: argparse.ArgumentParser, text: str) -> None:
    """The option that names the sheet."""
    command.add_argument("--paper", choices=tuple(SIZES), help=text)


def add_sheet(command: argparse.ArgumentParser) -> None:
    """The options that say what the sheet looks like; without them the scene has a say in it."""
    add_paper(command, "the sheet (the scene's, or the smallest that will do)")
    add_language(command)


def add_curves(command: argparse.ArgumentParser) -> None:
    """The options that name the curves of the motion."""
    add = command.add_argument
    add("--curves", metavar="POINTS", help="paths of points over the motion, such as M,C, or all")
    add("--centrodes", metavar="LINKS", help='fixed and moving centrodes of links, each with its carrier, '
        'such as "2 frame,2 3"')


def add_pencil(command: argparse.ArgumentParser) -> None:
    """The option that sets the accuracy of the pencil."""
    command.add_argument("--pencil", metavar="SIZES",
                         help="standard deviations of the pencil; the defaults are point=0.1,edge=0.1,"
                         "opening=0.1 (mm of paper) and angle=0.05 (degrees)")


def add_preference(command: argparse.ArgumentParser) -> None:
    """The option by which a form is preferred."""
    command.add_argument("--prefer", default="", choices=PREFERENCES,
                         help="compare all methods: the fewest operations, the smallest pencil error, or both")


# --- asked for -----------------------------------------------------------------------------------------------------


def sheet_keys(options: argparse.Namespace) -> dict[str, Any]:
    """The keys of [sheet] that options say."""
    return {key: value for key in KEYS if key != "positions" and (value := getattr(options, key, None))}


def text_of_scene(options: argparse.Namespace, source: str) -> str:
    """The text of a scene or a task that is named, with the values that options set."""
    from graphplan.mechanism.scene import source_text

    text = source_text(source, source)
    if not options.settings:
        return text
    for setting in options.settings:
        path, equals, value = setting.partition("=")
        if not equals:
            raise Refused(f"--set {setting}", "no value is given", "such as --set points.A.angle=40")
        text = set_value(text, path.strip(), value.strip(), source)
    return text


def set_value(text: str, path: str, value: str, source: str) -> str:
    """The text of a scene with another value at a path, as options write it."""
    from graphplan.mechanism.written_scene import with_value_in_text

    return with_value_in_text(text, path, _value(value), source)


def _value(text: str) -> object:
    """A value as TOML reads it; else the text itself, without quotes."""
    from graphplan.mechanism.numbers import decimal

    try:
        return tomllib.loads(f"value = {text}", parse_float=decimal)["value"]
    except ValueError:
        return text


def load_scene(options: argparse.Namespace, scene: Scene | None = None) -> Scene:
    """The scene, by default that which is named, in the pose and with the keys of [sheet] that options say."""
    from graphplan.mechanism.written_scene import parse

    if scene is None:
        scene = parse(text_of_scene(options, options.scene), options.scene)
        question(options, scene)
    if getattr(options, "at", None) is not None:
        from graphplan.cycle.pose import at
        from graphplan.mechanism.written_scene import parse_pose

        scene = at(scene, parse_pose(options.at))
    return with_sheet(scene, sheet_keys(options))


def load_source(options: argparse.Namespace, *unused: str) -> Scene | FoundMechanism:
    """The scene that is named, or what is found for a task, of which the `unused` options are refused."""
    from graphplan import leaves
    from graphplan.mechanism.scene import tables_of
    from graphplan.mechanism.written_scene import parse

    text = text_of_scene(options, options.scene)
    kind = leaves.kind_of_task(tables_of(text, options.scene))
    if kind is None or not kind.finder:
        scene = parse(text, options.scene)
        question(options, scene)
        return load_scene(options, scene)
    for option in unused:
        if getattr(options, option, None):
            raise Refused(f"--{option}", f"it does not apply to a task of graphplan {kind.command}", "leave it out")
    found: FoundMechanism = with_sheet(leaves.module(kind.finder).find(text, options.scene), sheet_keys(options))
    return found


def question(options: argparse.Namespace, scene: Scene) -> None:
    """Report what is probably a slip of the pen in a scene, though it is allowed."""
    from graphplan.mechanism.scene import questions

    for fault in questions(scene):
        Messages(options.quiet).remark(f"{scene.name}: {fault}")


def on_paper(options: argparse.Namespace, *, words: bool = True, **keys: str) -> Drafted:
    """The construction of the scene that is named on its sheet, with further keys of [sheet], with or without pages of
    words."""
    drafted = drafting.on_paper(with_sheet(load_scene(options), keys), words=words)
    for line in drafted.drawing.missing:
        Messages(options.quiet).remark(f"{options.scene}: {line}")
    return drafted


def pencil(options: argparse.Namespace) -> Pencil:
    """The pencil that is asked for, or a careful hand's."""
    from graphplan.design import hand

    return hand.pencil(options.pencil or "")


def read_task(options: argparse.Namespace, load: Callable[[str], Task], parse: Callable[[str, str], Task]) -> Task:
    """The task that is named, as options set it; its own file is not written over."""
    source, output = options.task, options.output
    named = output not in (None, STANDARD) and "\0" not in output + source  # no file has a null byte in its name
    if named and os.path.realpath(output) == os.path.realpath(source):
        raise Refused(f"-o {output}", "the task file would be overwritten", "another name")
    task = parse(text_of_scene(options, source), source) if options.settings else load(source)
    return with_sheet(task, sheet_keys(options))


SCENE, JSON = (".toml",), (".json",)  # endings of what alone an option applies to


def add_subject(command: argparse.ArgumentParser) -> None:
    """The options of all subjects: language, other values of the scene or task, and the steps in JSON."""
    add_language(command)
    add_settings(command)
    command.add_argument("--steps", action="store_true", help="add the steps of the drawing to the JSON, as in "
                         "`graphplan steps --json`")


def run_subject(options: argparse.Namespace, name: str, endings: Sequence[str],
                find: Callable[[argparse.Namespace, str, Messages], Subject], **only: Sequence[str]) -> int:
    """Write what is asked for of the subject that is found for an ending; `only` has those to which an option applies.
    """
    ending, messages = kind(options.output, endings, name), Messages(options.quiet)
    for option, applies in {**only, "steps": JSON}.items():
        if (value := getattr(options, option, None)) not in (None, False) and ending not in applies:
            raise Refused(f"--{option}" if value is True else f"--{option} {value}",
                          f"it does not apply to a {ending}", f"leave it out, or -o FILE{applies[0]}")
    try:
        subject = find(options, ending, messages)
    except Refused as refused:
        raise refused.in_file(options.scene if hasattr(options, "scene") else options.task) from None
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
    return with_sheet(scene, sheet_keys(options))
