"""Write a scene to start from, with every section explained.

It can be drawn as it stands; a file that is there is never overwritten.

examples:
  graphplan new scene.toml                         a four-bar linkage
  graphplan new press.toml --kind slider-crank
  graphplan new - --kind blank                     on standard output
"""

from __future__ import annotations

import argparse

from graphplan.commands.messages import Messages
from graphplan.commands.output import STANDARD, kind, write
from graphplan.commands.templates import KINDS, template

ENDINGS = (".toml",)


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("file", metavar="FILE", help="the scene to write, such as scene.toml; - for standard output")
    command.add_argument("--kind", choices=KINDS, default="four-bar", help="the mechanism to start from")


def run(options: argparse.Namespace) -> int:
    kind(options.file, ENDINGS, "scene", "new")
    write(template(options.kind), options.file, new=True)
    if options.file != STANDARD:
        told = f"{options.file}: written; graphplan watch {options.file} draws it whenever it is saved"
        Messages(options.quiet).remark(told)
    return 0
