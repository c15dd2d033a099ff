"""Messages: what is told on standard error, in colour and while it works only where someone looks on.

Errors are always told, red on a terminal unless NO_COLOR is set (no-color.org); remarks unless `--quiet` is given;
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
    with suppress(OSError):  # nobody can be told that nobody can be told
        print(text, end="", file=sys.stderr, flush=True)


@dataclass(frozen=True)
class Messages:
    """What a command tells besides errors and its results."""

    quiet: bool

    def remark(self, line: str) -> None:
        """Tell what is worth knowing, though nothing is wrong."""
        if not self.quiet:
            _print(line)

    def progress(self, told: str) -> None:
        """Tell whoever waits how far it is, over what was told before; nothing when it is done."""
        if not self.quiet and sys.stderr.isatty():
            _tell(f"\r{told:<{WIDTH}}\r")
