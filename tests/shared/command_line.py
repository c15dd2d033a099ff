"""The command line as tests run it."""

from __future__ import annotations

import signal

from graphplan.commands import main


def run(*arguments: str) -> int:
    """The exit status of the command line, whether it returns or exits."""
    try:
        return main(arguments)
    except SystemExit as end:
        return int(end.code or 0)


def heeds_ctrl_c() -> None:
    """In a process about to start: Ctrl-C interrupts it, though a shell's background jobs are to ignore it."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
