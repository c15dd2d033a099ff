"""Options that several subcommands share, and the output file that is written whole or not at all."""

from __future__ import annotations

import argparse
import os
import sys
import tempfile

from graphplan.errors import Refused


def add_choices(command: argparse.ArgumentParser, *, strict: bool = False) -> None:
    """The options that choose how it is drawn."""
    command.add_argument("--method", default="", choices=("auxiliary", "trial", "poles"),
                         help="the form of loci and rings; without it the pose chooses, and the protocol says why")
    command.add_argument("--plan", default="orthogonal", metavar="PLAN",
                         help="orthogonal velocities on the mechanism plan (default), or polar plans; of the forces "
                         "lever, polygons, or both (default); such as --plan polar,lever")
    command.add_argument("--inertia", default="couple", choices=("couple", "shifted", "points"),
                         help="inertia forces: at the centre of mass with a couple (default), shifted so that they "
                         "need none, or at two points that replace the link")
    if strict:
        command.add_argument("--strict", action="store_true",
                             help="compasses and straightedge alone, no set squares")


def write(text: str, path: str | None) -> None:
    """Text to a file, or to standard output; a file appears whole, or stays as it was."""
    if path is None or path == "-":
        sys.stdout.write(text)
        return
    temporary = ""
    try:
        folder = os.path.dirname(os.path.abspath(path))
        if os.path.isdir(path):
            raise IsADirectoryError(21, "this is a directory")
        with tempfile.NamedTemporaryFile("w", encoding="utf-8", dir=folder, prefix=".graphplan-", delete=False) as file:
            temporary = file.name
            file.write(text)
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, path)
    except OSError as error:
        if temporary and os.path.exists(temporary):
            os.unlink(temporary)
        why = f"cannot be written ({error.strerror})"
        raise Refused(f"{path}: output", why, "name a file in a folder that can be written to") from None


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
