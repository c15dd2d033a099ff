"""Write a scene to start from, with every section explained.

The scene can be drawn at once. An existing file is never overwritten.

examples:
  graphplan new scene.toml                         a four-bar linkage
  graphplan new press.toml --kind slider-crank
  graphplan new mine.toml --from shaper            a copy of a packaged scene
  graphplan new - --kind blank                     on standard output
"""

from __future__ import annotations

import argparse
import re
import tomllib
from collections.abc import Iterable, Mapping
from importlib.resources import files

from graphplan.app.choices import Messages
from graphplan.app.files import STANDARD, kind, write
from graphplan.errors import Refused
from graphplan.mechanism.fields import Either, Field, Rows, Value, inner, suggestion
from graphplan.mechanism.placements import COORDINATES, WAYS
from graphplan.mechanism.scene import SCENE, TASK_FOLDER, packaged_names, source_text

# In the templates beside the packaged scenes what is optional stands behind `#` without a blank; a paragraph of it
# holds as it is, once its `#` are taken away.
KINDS = ("four-bar", "slider-crank", "slotted-link", "cylinder", "gears", "joints", "governor", "cam", "open-chain",
         "blank")
TOP = ("title", "source", "gravity", "frame")
LOADS = ("balance", "masses", "forces", "moments", "springs", "friction")  # one paragraph: all of them need a balance

HEAD = """\
# :schema ./scene.schema.json
# An editor (Even Better TOML, taplo) completes and checks this file once the blank is taken from the line above,
# and there is the file that it names, by: graphplan schema > scene.schema.json
# A line that begins with # and no blank is optional: take the # away to use it, with all its paragraph."""

FORCES = """\
# Forces: one paragraph, as each of its tables needs the balance; leave out the tables that are not wanted.
# With them [find] may name reactions = ["A", "3 along 2"], joints and slides; without that all reactions are found."""


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("file", metavar="FILE", help="the scene to write, such as scene.toml; - for standard output")
    which = command.add_mutually_exclusive_group()
    which.add_argument("--kind", choices=KINDS, default="four-bar", help="the mechanism to start from")
    which.add_argument("--from", dest="packaged", metavar="SCENE", help="a copy of a packaged scene or task, such as "
                       "shaper")


def run(options: argparse.Namespace) -> int:
    kind(options.file, (".toml",), "scene", "new")
    write(packaged_text(options.packaged) if options.packaged else template(options.kind), options.file, new=True)
    if options.file != STANDARD:
        Messages(options.quiet).remark(f"graphplan watch {options.file} draws it whenever it is saved")
    return 0


def packaged_text(name: str) -> str:
    """The text of a packaged scene or task; fails with `Refused` if the name is unknown."""
    names = [*packaged_names(), *packaged_names(TASK_FOLDER)]
    if name not in names:
        raise Refused(f"--from {name}", "no packaged scene has this name", suggestion(name, names, "scene"))
    return source_text(name, name)


def template(kind: str) -> str:
    """The scene file to begin with."""
    sections, written = {field.name: field for field in SCENE.fields}, _sections(kind)
    top = zip(written[""].splitlines(), TOP, strict=True)
    tables = [_section(field, written) for name, field in sections.items() if name not in (*TOP, *LOADS)]
    loads = [_section(sections[name], written) for name in LOADS]
    paragraphs = HEAD, "\n".join(_align_comments((line, sections[name].words) for line, name in top)), *tables
    return "\n\n".join([*paragraphs, "\n".join([FORCES, *loads])]) + "\n"


def _sections(kind: str) -> dict[str, str]:
    """The paragraphs of a template by the names of their tables; the first stands before all tables."""
    text = files("graphplan").joinpath("scenes", "new", f"{kind}.toml").read_text(encoding="utf-8")
    first, *tables = text.strip().split("\n\n")
    return {"": first, **{re.findall(r"\w+", paragraph)[0]: paragraph for paragraph in tables}}


def _section(section: Field, written: Mapping[str, str]) -> str:
    """A section: what it is, and its lines, or the template that shows them."""
    heading = f"# {section.name}: {section.words}"
    if section.name not in written:
        return f"{heading}; see graphplan new --kind {next(kind for kind in KINDS if section.name in _sections(kind))}"
    rows = [(row, _words_of_form(section.kind, row)) for row in re.split(r"\n(?=#?\[\[)", written[section.name])]
    return "\n".join([heading, *_align_comments((line, _words_of_key(line, says))
                                                for row, says in rows for line in row.splitlines())])


def _words_of_form(kind: Value, row: str) -> dict[str, str]:
    """Descriptions of a table's keys, in the form that it has of several."""
    if isinstance(kind, Rows) and isinstance(kind.entry, Either) and not kind.entry.choose:
        kind = kind.entry.by_keys(re.findall(r"(?m)^#?(\w+) =", row))
    return {field.name: field.words for field in inner(kind)}


def _words_of_key(line: str, says: Mapping[str, str]) -> str:
    """Description of the key in a line, or of the way in which it places a point."""
    line = line.removeprefix("#")
    if line.startswith("["):
        return ""
    ((key, value),) = tomllib.loads(line).items()
    if key in says:
        return says[key]
    if isinstance(value, dict):
        return next((way.says for way in WAYS if {*way.keys} == value.keys()), "")
    return COORDINATES.says if isinstance(value, list) and len(value) == 2 else ""


def _align_comments(rows: Iterable[tuple[str, str]]) -> list[str]:
    """Lines with what is said of them, in a column."""
    lines = list(rows)
    wide = max((len(line) for line, comment in lines if comment), default=0)
    return [f"{line:<{wide}}  # {comment}" if comment else line for line, comment in lines]
