"""README, the manual's chapters and the gallery's front page against the package: size, tables, links, commands."""

from __future__ import annotations

import argparse
import json
import re
import shlex
from collections.abc import Iterator
from pathlib import Path

import pytest
from each import each

import graphplan as gp
from graphplan.cams.task import TASK as CAM
from graphplan.commands import commands, parser
from graphplan.machines.rotors.rotor import TASK as ROTOR
from graphplan.mechanism.scene import TASK_FOLDER, packaged_names
from graphplan.mechanism.schema import reference
from graphplan.site.chapters import CONTENTS, GROUPS, anchor, chapters, python_reference
from graphplan.site.scene_pages import TOPICS

ROOT = Path(__file__).parent.parent
README = ROOT / "README.md"
CHAPTERS = ROOT / "graphplan" / "site" / "chapters"
TABLES = ROOT / "gallery" / "tables"
PAGES = [README, *sorted(CHAPTERS.glob("*.md")), *sorted((ROOT / "gallery").rglob("*.md"))]


def named(page: Path) -> str:
    return str(page.relative_to(ROOT))


def text_of(page: Path) -> str:
    return page.read_text(encoding="utf-8")


def without_fences(text: str) -> str:
    """The text without its blocks of code."""
    return re.sub(r"(?ms)^ *```.*?^ *```$", "", text)


def fences(text: str, language: str) -> list[str]:
    """The blocks of code in a language."""
    return re.findall(rf"(?ms)^ *```{language}\n(.*?)^ *```$", text)


def first_cells(text: str) -> list[str]:
    """What stands in backticks in the first cells of a table's rows."""
    return re.findall(r"(?m)^\| `([^`]+)`", text)


# ---- README ---------------------------------------------------------------------------------------------------------


def test_the_first_line_about_tests_is_the_command_that_runs_them() -> None:
    """The first line with `pytest` sets up a bare machine and runs the tests: continuous integration runs this line."""
    line = next(line for line in text_of(README).splitlines() if "pytest" in line)
    assert re.match(r"\{ python3 -m venv \.venv .*pip install .*'\.\[tests\]'.* -m pytest\b", line)


def test_the_first_scene_has_the_printed_results() -> None:
    """The scene of README is that of its picture, and `solve` prints what stands there."""
    scene = gp.parse(fences(text_of(README), "toml")[0], "scene.toml")
    pictured = gp.load("four-bar")
    assert (scene.title, scene.points, scene.links) == (pictured.title, pictured.points, pictured.links)
    printed = json.loads(fences(text_of(README), "json")[0])
    drawing = gp.construct(scene)
    for point, motion in printed["points"].items():
        for quantity, vector in motion.items():
            assert complex(*vector) == pytest.approx(getattr(drawing, quantity)[point], rel=1e-12)
    for link, rates in printed["links"].items():
        for quantity, rate in rates.items():
            assert rate == pytest.approx(getattr(drawing, quantity)[link], rel=1e-12)
    assert printed["steps"] == len(drawing.drawn.steps) - drawing.drawn.givens


@pytest.mark.parametrize("page", [README, CHAPTERS / "python.md", CHAPTERS / "examples.md"], ids=named)
def test_python_examples_run(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every call of an example exists and returns."""
    monkeypatch.chdir(tmp_path)
    if "compiled=True" in text_of(page):
        pytest.importorskip("numba")
    examples = fences(text_of(page), "python")
    assert examples
    for example in examples:
        exec(example, {})


# ---- tables ---------------------------------------------------------------------------------------------------------


def test_every_command_has_its_line() -> None:
    """The table of commands has each once, and their chapter speaks of each."""
    assert first_cells(text_of(TABLES / "commands.md")) == [f"graphplan {name}" for name in commands()]
    chapter = text_of(CHAPTERS / "commands.md")
    assert [name for name in commands() if not re.search(rf"`graphplan {name}[ `]", chapter)] == []


def test_every_key_has_its_line() -> None:
    """The tables of keys are what the records say: `graphplan schema keys` prints the first."""
    for name, table in {"scene-keys": reference(), "cam-keys": reference(CAM), "rotor-keys": reference(ROTOR)}.items():
        assert table in text_of(TABLES / f"{name}.md"), name


def test_what_is_to_be_copied_is_there() -> None:
    """Each file that the table of additions names exists, each kind of addition names one, and says what it costs."""
    rows = re.findall(r"(?m)^\| ([a-z ]+) \|(.*)\|([^|]*)\|$", text_of(CHAPTERS / "adding.md"))
    assert [name for name, *_ in rows] == ["to add", "primitive", "compound", "form", "pair", "method", "mistake",
                                           "back end", "language", "kind of result", "scene key", "scene", "subject",
                                           "command", "chapter"]
    for name, row, cost in rows[1:]:
        paths = re.findall(r"`([\w/.-]+\.\w+)`", row)
        assert paths, name
        assert [path for path in paths if not (ROOT / path).exists()] == []
        assert re.fullmatch(r" \d(-\d)? ", cost), name


@each("page", PAGES, ids=named)
def test_rows_have_as_many_cells_as_their_head(page: Path) -> None:
    """No row of a table is longer or shorter than its head, so that none of its words is lost."""
    width = 0
    for line in without_fences(text_of(page)).splitlines():
        cells = len(re.findall(r"(?<!\\)\|", re.sub(r"`[^`]*`", "", line))) if line.startswith("|") else 0
        assert not (cells and width) or cells == width, line
        width = cells


def test_every_packaged_scene_has_one_topic() -> None:
    """The gallery shows each packaged scene and task once, and no other."""
    assert sorted(name for scenes in TOPICS.values() for name in scenes.split()) == sorted(
        [*packaged_names(), *packaged_names(TASK_FOLDER)])


# ---- links ----------------------------------------------------------------------------------------------------------


@each("page", PAGES, ids=named)
def test_every_link_leads_somewhere(page: Path) -> None:
    """Links and pictures lead to files and heads that exist."""
    text = re.sub(r"`[^`\n]*`", "", without_fences(text_of(page)))
    addresses = re.findall(r'\]\(([^)\s]+)\)|<img src="([^"]+)"', text)
    for link, picture in addresses:
        path, _, head = (link or picture).partition("#")
        target = (page.parent / path).resolve() if path else page
        assert target.is_file(), f"{link or picture}: no such file"
        assert target.is_relative_to(ROOT)
        if head:
            assert head in {anchor(title) for title in re.findall(r"(?m)^#+ (.+)$", without_fences(text_of(target)))}


def test_the_manual_can_be_read() -> None:
    """Its chapters have at most 18,000 words, code apart; the README takes at most 8 kB."""
    assert sum(len(without_fences(text).split()) for text in chapters().values()) <= 18_000
    assert len(README.read_bytes()) <= 8192


def test_the_contents_list_every_chapter_once() -> None:
    """The contents lead to all chapters by topic."""
    listed = re.findall(r"(?m)^- \[[^\]]+\]\(([\w-]+)\.md\)", text_of(CHAPTERS / f"{CONTENTS}.md"))
    assert sorted([*listed, CONTENTS]) == sorted(chapters())


# ---- commands -------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def options() -> dict[str, set[str]]:
    """The options of each command."""
    parsers = next(action.choices for action in parser(tuple(commands()))._actions
                    if isinstance(action, argparse._SubParsersAction))
    return {name: {*command._option_string_actions} for name, command in parsers.items()}


def command_lines(text: str) -> Iterator[list[str]]:
    """The words of each call of graphplan that is shown, in blocks of code or within a sentence."""
    blocks = [line for language in ("sh", "bat", "") for block in fences(text, language) for line in block.splitlines()]
    spans = re.findall(r"`([^`\n]+)`", without_fences(text))
    for line in [*blocks, *spans]:
        for call in re.split(r"&&|\|", line.replace("\\", "/")):
            words = shlex.split(call, comments=True) if "'" not in call or call.count("'") % 2 == 0 else call.split()
            if len(words) > 1 and re.fullmatch(r"(\S*/)?graphplan", words[0]):
                yield words[1:]


@each("page", [README, *sorted(CHAPTERS.glob("*.md")), ROOT / "gallery" / "tutorial.md"], ids=named)
def test_every_command_line_can_be_typed(page: Path, options: dict[str, set[str]]) -> None:
    """Commands and options that are shown exist; an option that stands alone is one of some command."""
    for name, *words in command_lines(text_of(page)):
        if name in ("help", "--help", "--version"):
            continue
        assert name in options, name
        asked = {word.partition("=")[0] for word in words if re.match(r"--?[a-zA-Z]", word)}
        assert asked <= options[name], f"{name}: {asked - options[name]}"
    alone = set(re.findall(r"`(--[a-z]+)\b[^`]*`", without_fences(text_of(page))))
    assert alone <= set().union(*options.values())


# ---- the reference of Python -----------------------------------------------------------------------------------------


def test_the_reference_is_what_the_docstrings_say() -> None:
    """The table of the gallery is made from the docstrings, and every public name stands in it once."""
    assert python_reference() in text_of(TABLES / "python.md")
    assert sorted(" ".join(GROUPS.values()).split()) == sorted(gp.__all__)
