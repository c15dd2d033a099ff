"""The command line: one module a subcommand, and what they share."""

from __future__ import annotations

import argparse
import gc
import importlib
import os
import sys
from collections.abc import Sequence

from graphplan.errors import GraphplanError

SUBCOMMANDS = ("draw", "steps", "solve", "check", "cycle", "cost", "chart", "gallery")

GARBAGE = 100_000  # new objects before any is looked through: a command lives briefly and leaves little

EXAMPLES = """\
examples:
  graphplan draw alt-eight-link -o sheet.svg    the construction sheet of a packaged scene
  graphplan steps scene.toml                    the construction in words, step by step
  graphplan solve scene.toml --exact            velocities and accelerations as fractions
  graphplan check scene.toml                    the construction beside the analytic solver
  graphplan cost scene.toml                     what each form costs, and how far off the pencil is

exit status: 0 done; 1 construction and solver disagree; 2 bad input; 3 the pose is singular
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run one subcommand; its exit status. Without arguments it is the whole process, whose words are its own."""
    if argv is not None:
        return _run(list(argv))
    gc.set_threshold(GARBAGE)
    status = _run(sys.argv[1:])
    gc.freeze()  # the process ends here: nothing is looked through once more
    return status


def _run(arguments: Sequence[str]) -> int:
    options = _parser(_called(arguments)).parse_args(arguments)
    try:
        status = int(options.run(options))
        sys.stdout.flush()
        return status
    except GraphplanError as error:
        for line in error.lines:
            print(line, file=sys.stderr)
        return error.status
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except KeyboardInterrupt:
        return 130


def _called(arguments: Sequence[str]) -> Sequence[str]:
    """The subcommand that is called, as its module alone is needed; all where help is wanted."""
    return arguments[:1] if arguments and arguments[0] in SUBCOMMANDS else SUBCOMMANDS


def _parser(names: Sequence[str]) -> argparse.ArgumentParser:
    """The command line of these subcommands."""
    parser = argparse.ArgumentParser(
        prog="graphplan",
        description="Graphical analysis of planar mechanisms: constructs velocities and accelerations as ordered "
        "compass-and-straightedge steps, and checks them.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True, prog="graphplan")
    for name in names:
        module = importlib.import_module(f"graphplan.commands.{name}")
        summary, _, details = (module.__doc__ or "").partition("\n")
        command = commands.add_parser(
            name,
            help=summary[0].lower() + summary[1:].rstrip("."),
            description=summary,
            epilog=details.strip() or None,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        if name not in ("chart", "gallery"):
            what = "a scene file, - for standard input, or a packaged scene"
            command.add_argument("scene", metavar="SCENE", help=what)
        module.options(command)
        command.set_defaults(run=module.run)
    return parser
