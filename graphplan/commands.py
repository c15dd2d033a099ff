"""The command line: one module a subcommand, and what they share."""

from __future__ import annotations

import argparse
import gc
import importlib
import os
import re
import signal
import sys
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NoReturn

from graphplan import __version__
from graphplan.app.choices import Messages, error
from graphplan.app.files import flush, hush, listening
from graphplan.errors import GraphplanError, Refused
from graphplan.leaves import Command, leaves
from graphplan.threads import prefer_one_thread

GROUPS = "describe", "construct", "move", "machine", "teach", "share"  # by what they are for, as the help has them
CORE = {  # the commands of the core; leaves have further ones
    "new": Command("describe", "graphplan.app.new", takes_scene=False),
    "list": Command("describe", "graphplan.app.catalogue", takes_scene=False),
    "schema": Command("describe", "graphplan.app.schema", takes_scene=False),
    "draw": Command("construct", "graphplan.app.draw"),
    "watch": Command("construct", "graphplan.app.watch", takes_scene=False),
    "steps": Command("construct", "graphplan.app.steps"),
    "solve": Command("construct", "graphplan.app.solve"),
    "check": Command("construct", "graphplan.app.check"),
    "cost": Command("construct", "graphplan.app.cost"),
    "cycle": Command("move", "graphplan.app.cycle"),
    "report": Command("machine", "graphplan.app.report"),
    "handout": Command("teach", "graphplan.app.handout"),
    "completion": Command("share", "graphplan.app.completion", takes_scene=False),
}
WITHOUT_QUIET = "list", "schema", "completion", "board", "watch"  # results alone, or run while one looks on
HELP = "help"
RAW = argparse.RawDescriptionHelpFormatter

GC_THRESHOLD = 2_000_000  # new objects before any is looked through: a command lives briefly and leaves little

EXAMPLES = """\
examples:
  graphplan new scene.toml                      a scene to start from, every section of it explained
  graphplan draw alt-eight-link -o sheet.svg    the construction sheet of a packaged scene
  graphplan steps scene.toml                    the construction in words, step by step
  graphplan solve scene.toml --exact            velocities and accelerations as fractions
  graphplan check scene.toml                    construction and analytic solver, number by number
  graphplan help draw                           the options of a command

exit status: 0 done; 1 construction and solver disagree; 2 bad input; 3 the pose is singular
"""


def commands() -> Mapping[str, Command]:
    """All subcommands by name, in the order in which the help lists them."""
    known = CORE | {name: command for leaf in leaves().values() for name, command in leaf.commands.items()}
    return {name: command for group in GROUPS for name, command in known.items() if command.group == group}


def main(argv: Sequence[str] | None = None) -> int:
    """Run one subcommand; its exit status. Without arguments it is the whole process, whose words are its own."""
    if argv is not None:
        return _run(list(argv))
    if sys.stderr is None:  # it is closed
        sys.stderr = open(os.devnull, "w")  # noqa: SIM115
    signal.signal(signal.SIGTERM, _end_terminated)
    gc.set_threshold(GC_THRESHOLD)
    prefer_one_thread()
    status = _run(sys.argv[1:])
    gc.freeze()  # the process ends here: nothing is looked through once more
    return status


def _end_terminated(number: int, frame: Any) -> NoReturn:
    """End as Ctrl-C does, so that nothing half written is left, with the status that a shell tells of this signal."""
    raise SystemExit(128 + number)


def _run(arguments: Sequence[str]) -> int:
    if not arguments:
        overview().print_help(sys.stderr)
        return 2
    words = with_values_joined(arguments)
    if words[0] == HELP:  # graphplan help draw
        words = [*words[1:2], "--help"]
    try:
        try:
            whole = overview() if words[0].startswith("-") else parser(_needed_command(words[0]))
            options, unknown = whole.parse_known_args(words)
            if unknown:
                raise _unknown_option(words[0], unknown)
            messages = Messages(options.quiet)
            with listening(lambda name: messages.remark(f"wrote {name}")):
                return int(options.run(options))
        finally:
            flush()
    except GraphplanError as fault:
        for line in fault.lines:
            error(line)
        return fault.status
    except MemoryError as fault:
        error(f"graphplan {words[0]}: there is not enough memory ({fault or 'for so much'}); ask for less")
        return 2
    except BrokenPipeError:
        hush()
        return 0
    except KeyboardInterrupt:
        return 130


def _needed_command(word: str) -> Sequence[str]:
    """The subcommand that is called, as its module alone is needed."""
    if word in CORE or word in commands():
        return (word,)
    from graphplan.mechanism.fields import suggestion

    raise Refused(f"graphplan {word}", "unknown command", suggestion(word, tuple(commands()), "command"))


def _unknown_option(command: str, words: Sequence[str]) -> Refused:
    """The refusal of words that no option takes: options that stand in the scene now, and slips of the pen."""
    from graphplan.app.choices import IN_THE_SCENE, OF_A_MOTION
    from graphplan.mechanism.fields import suggestion

    option = next((word.partition("=")[0] for word in words if word.startswith("-")), "")
    if not option:
        return Refused(f"graphplan {command} {words[0]}", "one word too many", f"graphplan help {command} tells more")
    if command not in commands():
        return Refused(f"graphplan {command}", "no command is named before it", f"graphplan COMMAND ... {command}")
    option_names = [name for action in command_parser(command)._actions for name in action.option_strings]
    paths = IN_THE_SCENE | OF_A_MOTION if command == "motion" else IN_THE_SCENE
    if option in paths and "--set" in option_names:
        path = paths[option]
        table, _, key = path.partition(".")
        return Refused(f"graphplan {command} {option}", f"this stands in the scene, in its table [{table}]",
                       f"{key} = ... there, or --set {path}=VALUE")
    return Refused(f"graphplan {command} {option}", "unknown option", suggestion(option, option_names, "option"))


def command_parser(name: str) -> argparse.ArgumentParser:
    """The parser of one subcommand."""
    actions = parser((name,))._actions
    commands = next(action for action in actions if isinstance(action, argparse._SubParsersAction))
    chosen: argparse.ArgumentParser = commands.choices[name]
    return chosen


class Parser(argparse.ArgumentParser):
    """A parser whose errors look like all others, and whose help has its subcommands in groups."""

    groups: Mapping[str, Sequence[str]] = {}  # the commands of each

    def format_help(self) -> str:
        """The help; that of the whole command line lists the commands by what they are for."""
        text = super().format_help()
        if not self.groups:
            return text
        names = [name for group in self.groups.values() for name in group]
        listed = {name: re.search(rf"(?m)^    {name} (?:.*\n)(?: {{8,}}.*\n)*", text) for name in names}
        whole = [entry for entry in listed.values() if entry]
        first, last = min(entry.start() for entry in whole), max(entry.end() for entry in whole)
        lines = [f"  {group}:\n" + "".join(entry[0] for name in names if (entry := listed[name]))
                 for group, names in self.groups.items()]
        return text[:first] + "".join(lines) + text[last:]

    def error(self, message: str) -> NoReturn:
        """Report a wrong command line, and exit."""
        error(f"{self.prog}: {message}; {self.prog} --help lists the options")
        raise SystemExit(2)


def parser(names: Sequence[str]) -> Parser:
    """The command line of these subcommands."""
    whole, parsers = _without_commands()
    for name in names:
        known = CORE.get(name) or commands()[name]
        module = importlib.import_module(known.module)
        summary, _, details = (module.__doc__ or "").partition("\n")
        command = parsers.add_parser(name, help=_in_list(summary), description=summary,
                                      epilog=details.strip() or None, formatter_class=RAW)
        if known.takes_scene:
            command.add_argument("scene", metavar="SCENE",
                                 help="a scene file, - for standard input, or a packaged scene")
        module.options(command)
        if name not in WITHOUT_QUIET:
            command.add_argument("-q", "--quiet", action="store_true", help="no progress and no remarks, errors alone")
        command.set_defaults(run=module.run, quiet=False)
    return whole


def overview() -> Parser:
    """The command line as its help lists it: a line of each subcommand, the first of its module, which is not loaded.
    """
    from pkgutil import get_data

    whole, parsers = _without_commands()
    whole.groups = {group: [name for name, command in commands().items() if command.group == group] for group in GROUPS}
    for name, command in commands().items():
        package, _, module = command.module.rpartition(".")
        source = get_data(package, f"{module}.py") or b""
        parsers.add_parser(name, help=_in_list(source.decode().partition("\n")[0].strip('"')))
    return whole


def _without_commands() -> tuple[Parser, argparse._SubParsersAction[Parser]]:
    """The whole command line, and where its subcommands go."""
    whole = Parser(prog="graphplan", epilog=EXAMPLES, formatter_class=RAW,
                   description="Graphical analysis of planar mechanisms: constructs velocities and accelerations as "
                   "ordered compass-and-straightedge steps, and checks them.")
    whole.add_argument("-V", "--version", action="version", version=f"graphplan {__version__}")
    return whole, whole.add_subparsers(title="commands", metavar="COMMAND", required=True, prog="graphplan")


def _in_list(summary: str) -> str:
    """A sentence as an entry of a list."""
    return summary[:1].lower() + summary[1:].rstrip(".")


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
