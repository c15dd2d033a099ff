"""Messages on standard error: in colour, and with progress, only where someone looks on.

Errors are always written, red on a terminal unless NO_COLOR is set (no-color.org); remarks unless `--quiet` is given;
progress on a terminal alone.
"""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from dataclasses import dataclass

from graphplan.errors import printable

RED, PLAIN = "\x1b[31m", "\x1b[0m"
WIDTH = 60  # of the line of progress, which is written over and over


def error(line: str) -> None:
    """Tell what went wrong."""
    coloured = sys.stderr.isatty() and not os.environ.get("NO_COLOR")
    _print(line, *((RED, PLAIN) if coloured else ("", "")))


def _print(line: str, before: str = "", after: str = "") -> None:
    """A line, which covers progress that may stand there."""
    told = printable(line)
    covering = f"{told:<{WIDTH}}" if sys.stderr.isatty() else told
    _tell(f"{before}{covering}{after}\n")


def _tell(text: str) -> None:
    with suppress(OSError):  # there is no place to say so
        print(text, end="", file=sys.stderr, flush=True)


@dataclass(frozen=True)
class Messages:
    """What a command says besides errors and its results."""

    quiet: bool

    def remark(self, line: str) -> None:
        """Tell what is worth knowing, though nothing is wrong."""
        if not self.quiet:
            _print(line)

    def progress(self, told: str) -> None:
        """Say how far it is, over what was said before; nothing when it is done."""
        if not self.quiet and sys.stderr.isatty():
            _tell(f"\r{told:<{WIDTH}}\r")
