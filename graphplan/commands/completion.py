"""Print a script that completes the command line in a shell.

It is made from the commands and options that there are, with the names of the packaged scenes.

examples:
  source <(graphplan completion bash)                                     for ~/.bashrc
  graphplan completion zsh > _graphplan                                   in a folder of $fpath
  graphplan completion fish > ~/.config/fish/completions/graphplan.fish
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import TYPE_CHECKING

from graphplan.commands.output import write

if TYPE_CHECKING:
    from graphplan.commands.completion_scripts import Argument, Command

PLACES = {"SCENE": "scene", "FOLDER": "folder", "DRAWING": "file"}  # what completes an argument, by its name


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("shell", metavar="SHELL", choices=("bash", "zsh", "fish"), help="bash, zsh or fish")


def run(options: argparse.Namespace) -> int:
    from graphplan.commands import SUBCOMMANDS, parser
    from graphplan.commands.completion_scripts import SHELLS
    from graphplan.mechanism.scene import packaged

    write(SHELLS[options.shell]([*_commands(parser(SUBCOMMANDS))], packaged()))
    return 0


def _commands(parser: argparse.ArgumentParser) -> Iterator[Command]:
    """The subcommands with all that may follow them."""
    from graphplan.commands.completion_scripts import Command

    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for name, command in action.choices.items():
                yield Command(name, command.description or "", tuple(map(_argument, command._actions)))


def _argument(action: argparse.Action) -> Argument:
    """An option or an argument, with what completes it: its own choices, or what its name says."""
    from graphplan.commands.completion_scripts import Argument

    takes = "" if action.nargs == 0 else str(action.metavar or action.dest.upper())
    place = PLACES.get(takes, "file" if "FILE" in takes or "." in takes else "")
    return Argument(tuple(action.option_strings), action.help or "", takes, place, tuple(action.choices or ()))
