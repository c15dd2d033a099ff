"""A rotor, balanced: the part of `graphplan balance` for tasks with [rotor]."""

from __future__ import annotations

import argparse

from graphplan.commands.output import Messages, as_json, kind, write

ENDINGS = (".json", ".csv")


def run(options: argparse.Namespace, text: str) -> int:
    """Balance the rotor of a task's text and write what is asked for."""
    from graphplan.check.rotors import checked
    from graphplan.machine.rotor import parse
    from graphplan.machine.rotor_balance import balanced
    from graphplan.output.machine.rotor_numbers import numbers, table

    ending = kind(options.output, ENDINGS, "rotor")
    messages, found = Messages(options.quiet), balanced(parse(text, options.scene))
    check = checked(found)
    for note in found.notes:
        messages.remark(f"{options.scene}: {note}")
    write(table(found) if ending == ".csv" else as_json(numbers(found, check)), options.output)
    return 0
