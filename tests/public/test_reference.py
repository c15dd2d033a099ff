"""The reference of the manual is what the docstrings say, and every public name has one."""

from __future__ import annotations

import inspect
import subprocess
import sys
from pathlib import Path

from each import each

import graphplan as gp
from graphplan.output.manual.api_reference import GROUPS, api_reference

CHAPTER = Path(gp.__file__).parent / "output" / "manual" / "chapters" / "api.md"
FUNCTIONS = [name for name in gp.__all__ if inspect.isfunction(getattr(gp, name))]


def test_the_chapter_is_what_is_generated() -> None:
    """`python -m graphplan.output.manual.api_reference` writes it."""
    same = CHAPTER.read_text(encoding="utf-8") == api_reference()
    assert same, "run python -m graphplan.output.manual.api_reference"


def test_every_name_is_in_one_group() -> None:
    """Every public name stands in the reference once."""
    grouped = " ".join(GROUPS.values()).split()
    assert sorted(grouped) == sorted(gp.__all__)


@each("name", FUNCTIONS)
def test_docstrings_say_what_fails(name: str) -> None:
    """A public function says what it gives and with what it fails."""
    text = inspect.getdoc(getattr(gp, name)) or ""
    assert "Fails" in text, name


def test_importing_is_quick() -> None:
    """`import graphplan` loads nothing of it, and not numpy."""
    code = "import sys, graphplan; print([m for m in sys.modules if m.startswith(('graphplan.', 'numpy'))])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
