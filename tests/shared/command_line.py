"""The command line as tests run it."""

from __future__ import annotations

from graphplan.commands import main


def run(*arguments: str) -> int:
    """The exit status of the command line, whether it returns or exits."""
    try:
        return main(arguments)
    except SystemExit as end:
        return int(end.code or 0)
