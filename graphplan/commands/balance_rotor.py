"""A rotor, balanced: the part of `graphplan balance` for tasks with [rotor]."""

from __future__ import annotations

import argparse
from dataclasses import replace

from graphplan.commands.balance import drawn_alone
from graphplan.commands.choices import pencil, refuse_steps, with_steps
from graphplan.commands.output import Messages, as_json, kind, write, write_sheets
from graphplan.errors import Refused

NUMBERS = ".json", ".csv"
ENDINGS = (*NUMBERS, ".svg", ".pdf", ".png", ".tex", ".dxf")


def run(options: argparse.Namespace, text: str) -> int:
    """Balance the rotor of a task's text and write what is asked for."""
    from graphplan.check.rotors import check_rotor
    from graphplan.machine.rotors.rotor import parse
    from graphplan.machine.rotors.rotor_balance import balanced
    from graphplan.output.subjects.rotor_numbers import numbers, table
    from graphplan.output.subjects.rotor_sheet import one_sheet, sheets

    ending = kind(options.output, ENDINGS, "rotor")
    _asked(options, ending)
    refuse_steps(options, ending)
    task = parse(text, options.scene)
    said = {key: value for key in ("paper", "frame", "language") if (value := getattr(options, key))}
    messages, found = Messages(options.quiet), balanced(replace(task, sheet=replace(task.sheet, **said)))
    check = check_rotor(found)
    for note in found.notes:
        messages.remark(f"{options.scene}: {note}")
    if ending == ".csv":
        write(table(found), options.output)
    elif ending == ".json":
        sheet = one_sheet(found, check, pencil(options))
        write(as_json(with_steps(options, numbers(sheet), lambda: sheet), rows=True), options.output)
    else:
        write_sheets(sheets(found, check, pencil(options)), options.output, ending[1:], options.dpi)
    return 0


def _asked(options: argparse.Namespace, ending: str) -> None:
    """Refuse options of linkages, and those of another kind of output."""
    for name in ("positions", "counterweights", "radius", "keep", "share"):
        if getattr(options, name):
            raise Refused(f"--{name}", "it does not apply to a rotor", "leave it out")
    drawn_alone(options, ending)
