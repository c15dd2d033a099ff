"""Write a scene to start from, with every section explained.

It can be drawn as it stands; a file that is there is never overwritten.

examples:
  graphplan new scene.toml                         a four-bar linkage
  graphplan new press.toml --kind slider-crank
  graphplan new - --kind blank                     on standard output
"""

from __future__ import annotations

import argparse

from graphplan.commands.choices import write
from graphplan.commands.messages import Messages
from graphplan.commands.starts import STARTS
from graphplan.errors import Refused


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("file", metavar="FILE", help="the scene to write, such as scene.toml; - for standard output")
    command.add_argument("--kind", choices=[*STARTS], default="four-bar", help="the mechanism to start from")


def run(options: argparse.Namespace) -> int:
    text = STARTS[options.kind].text
    if options.file == "-":
        write(text, None)
        return 0
    try:
        with open(options.file, "x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError:
        raise Refused(f"{options.file}: new", "it is there already", "another name, or remove it first") from None
    except (OSError, ValueError) as error:  # ValueError: a path that no file system has
        why = f"it cannot be written ({getattr(error, 'strerror', None) or error})"
        raise Refused(f"{options.file}: new", why, "name a file in a folder that can be written to") from None
    told = f"{options.file}: written; graphplan watch {options.file} draws it whenever it is saved"
    Messages(options.quiet).remark(told)
    return 0
