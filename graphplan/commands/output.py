"""Output: where a command writes its results, and its messages on standard error. All commands write here.

Errors are always said, red on a terminal unless NO_COLOR is set (no-color.org); remarks, and which files were written,
unless `--quiet` is given; progress on a terminal alone.
"""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from dataclasses import dataclass

from graphplan.errors import printable
from graphplan.public.files import (
    DEFAULT_DPI,
    SHEETS,
    STANDARD,
    as_json,
    flush,
    folder_at,
    hush,
    kind,
    listening,
    new_folder,
    page_names,
    refuse_same_output,
    write,
    write_all,
    write_folder,
    write_sheets,
)

__all__ = ["DEFAULT_DPI", "SHEETS", "STANDARD", "Messages", "as_json", "error", "flush", "folder_at", "hush", "kind",
           "listening", "new_folder", "page_names", "refuse_same_output", "write", "write_all", "write_folder",
           "write_sheets"]

RED, PLAIN = "\x1b[31m", "\x1b[0m"
PROGRESS_WIDTH = 60  # of the line of progress, which is written over and over


def error(line: str) -> None:
    """Report an error."""
    coloured = sys.stderr.isatty() and not os.environ.get("NO_COLOR")
    _say(line, *((RED, PLAIN) if coloured else ("", "")))


def _say(line: str, before: str = "", after: str = "") -> None:
    """A line, which covers progress that may stand there."""
    text = printable(line)
    covering = f"{text:<{PROGRESS_WIDTH}}" if sys.stderr.isatty() else text
    _tell(f"{before}{covering}{after}\n")


def _tell(text: str) -> None:
    with suppress(OSError):  # there is no place to say so
        print(text, end="", file=sys.stderr, flush=True)


@dataclass(frozen=True)
class Messages:
    """The messages of a command besides errors and results."""

    quiet: bool

    def remark(self, line: str) -> None:
        """Report a remark."""
        if not self.quiet:
            _say(line)

    def progress(self, told: str) -> None:
        """Report progress, in place of the message before; empty when it is done."""
        if not self.quiet and sys.stderr.isatty():
            _tell(f"\r{told:<{PROGRESS_WIDTH}}\r")
