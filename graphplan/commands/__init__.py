"""The command line: one module a subcommand, and what they share."""

from __future__ import annotations

import argparse
import gc
import importlib
import os
import re
import sys
from collections.abc import Iterator, Sequence
from typing import NoReturn

from graphplan import __version__
from graphplan.commands.output import error, flush, hush
from graphplan.errors import GraphplanError, Refused

SUBCOMMANDS = ("new", "list", "import", "draw", "export", "watch", "steps", "solve", "check", "cycle", "cam",
               "flywheel", "motion", "balance", "cost", "handout", "live", "variants", "verify", "chart", "gallery",
               "schema", "completion")
MODULES = {"list": "catalogue", "import": "import_"}  # whose own names Python has taken
# all others take a scene
SCENELESS = ("new", "list", "import", "watch", "cam", "balance", "chart", "gallery", "schema", "completion")

GC_THRESHOLD = 100_000  # new objects before any is looked through: a command lives briefly and leaves little

EXAMPLES = """\
examples:
  graphplan new scene.toml                      a scene to start from, every section of it explained
  graphplan draw alt-eight-link -o sheet.svg    the construction sheet of a packaged scene
  graphplan steps scene.toml                    the construction in words, step by step
  graphplan solve scene.toml --exact            velocities and accelerations as fractions
  graphplan check scene.toml                    construction and analytic solver, number by number
  graphplan cost scene.toml                     what each form costs, and how far off the pencil is

exit status: 0 done; 1 construction and solver disagree; 2 bad input; 3 the pose is singular
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Run one subcommand; its exit status. Without arguments it is the whole process, whose words are its own."""
    if argv is not None:
        return _run(list(argv))
    if sys.stderr is None:  # it is closed
        sys.stderr = open(os.devnull, "w")  # noqa: SIM115
    gc.set_threshold(GC_THRESHOLD)
    status = _run(sys.argv[1:])
    gc.freeze()  # the process ends here: nothing is looked through once more
    return status


def _run(arguments: Sequence[str]) -> int:
    if not arguments:
        parser(SUBCOMMANDS).print_help(sys.stderr)
        return 2
    try:
        try:
            options = parser(_needed_commands(arguments[0])).parse_args(with_values_joined(arguments))
            return int(options.run(options))
        finally:
            flush()
    except GraphplanError as fault:
        for line in fault.lines:
            error(line)
        return fault.status
    except MemoryError as fault:
        error(f"graphplan {arguments[0]}: there is not enough memory ({fault or 'for so much'}); ask for less")
        return 2
    except BrokenPipeError:
        hush()
        return 0
    except KeyboardInterrupt:
        return 130


def _needed_commands(word: str) -> Sequence[str]:
    """The subcommand that is called, as its module alone is needed; all where help is wanted."""
    if word in SUBCOMMANDS:
        return (word,)
    if word.startswith("-"):
        return SUBCOMMANDS
    from graphplan.mechanism.items import suggestion

    raise Refused(f"graphplan {word}", "unknown command", suggestion(word, SUBCOMMANDS, "command"))


class Parser(argparse.ArgumentParser):
    """A parser whose errors look like all others."""

    def error(self, message: str) -> NoReturn:
        """Report a wrong command line, and exit."""
        error(f"{self.prog}: {message}; {self.prog} --help lists the options")
        raise SystemExit(2)


def parser(names: Sequence[str]) -> argparse.ArgumentParser:
    """The command line of these subcommands."""
    raw = argparse.RawDescriptionHelpFormatter
    parser = Parser(prog="graphplan", epilog=EXAMPLES, formatter_class=raw,
                    description="Graphical analysis of planar mechanisms: constructs velocities and accelerations as "
                    "ordered compass-and-straightedge steps, and checks them.")
    parser.add_argument("-V", "--version", action="version", version=f"graphplan {__version__}")
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True, prog="graphplan")
    for name in names:
        module = importlib.import_module(f"graphplan.commands.{MODULES.get(name, name)}")
        summary, _, details = (module.__doc__ or "").partition("\n")
        command = commands.add_parser(name, help=summary[0].lower() + summary[1:].rstrip("."), description=summary,
                                      epilog=details.strip() or None, formatter_class=raw)
        if name not in SCENELESS:
            command.add_argument("scene", metavar="SCENE",
                                 help="a scene file, - for standard input, or a packaged scene")
        module.options(command)
        command.add_argument("-q", "--quiet", action="store_true", help="no progress and no remarks, errors alone")
        command.set_defaults(run=module.run)
    return parser


# --- numbers below zero, which argparse would take for options -------------------------------------------------------


SIZE = r"(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?(?:/\d+)?"
NUMBER = rf"[-+\u2212]?{SIZE}"
OPTION = re.compile(r"--[a-z][\w-]*")
BELOW_ZERO = re.compile(rf"[-\u2212](?:{SIZE}|inf|nan)(?:,.*)?", re.IGNORECASE)
TRAVELS = re.compile(rf"{NUMBER}(?:,\s*{NUMBER})*,?", re.IGNORECASE)
MINUS = "\u2212"  # as it is printed
AT = "--at"  # the option that takes the travels of several drives, also as several words


def with_values_joined(words: Sequence[str]) -> list[str]:
    """The words, with each number below zero joined to the option before it, and the travels of a list into one word.

    --at -3,1.5 becomes --at=-3,1.5, and --at 60 -30 becomes --at=60,-30.
    """
    return list(_join_values([*words]))


def _join_values(words: list[str]) -> Iterator[str]:
    while words:
        word = words.pop(0)
        if word == "--":
            yield from (word, *words)
            return
        option, equals, value = word.partition("=")
        values = [value] if equals else []
        while option == AT and words and all(map(TRAVELS.fullmatch, (*values, words[0]))):
            values.append(words.pop(0))
        if not values and OPTION.fullmatch(option) and words and BELOW_ZERO.fullmatch(words[0]):
            values.append(words.pop(0))
        joined = ",".join(value.rstrip(",") for value in values) if len(values) > 1 else "".join(values)
        yield f"{option}={joined.replace(MINUS, '-')}" if values else word
