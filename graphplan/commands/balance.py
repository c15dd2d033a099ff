"""Balance a linkage or a rotor: mass centre, shaking force and counterweights, or the masses of correction planes.

SCENE has links with masses; a file with a table [rotor] is a rotor. Of a linkage the mass centre is constructed by
principal vectors over the cycle, with its velocity and acceleration, and what its inertia does to the frame. JSON has
the numbers, in kg m, N and N m, points in the scene's lengths, travel in degrees (lengths of a drive that slides); .csv
the table over the cycle.

examples:
  graphplan balance ozols-16-1 --positions 72 -o engine.json
  graphplan balance rotor.toml -o rotor.svg
"""

from __future__ import annotations

import argparse

from graphplan.commands.choices import count
from graphplan.commands.output import as_json, kind, write

ENDINGS = (".json", ".csv")
POSITIONS = 72


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("scene", metavar="SCENE", help="a scene with masses, a packaged one, a task with [rotor], or - for standard "
        "input")
    add("-o", "--output", metavar="FILE", help=", ".join(ENDINGS) + "; without it JSON on standard output")
    add("--positions", type=count("--positions", 3), metavar="N", help=f"in how many poses of the cycle ({POSITIONS})")


def run(options: argparse.Namespace) -> int:
    from graphplan.mechanism.scene import source_text, tables_of

    text = source_text(options.scene, options.scene)
    if "rotor" in tables_of(text, options.scene):
        from graphplan.commands import balance_rotor

        return balance_rotor.run(options, text)
    from graphplan.check.balance import mass_motion
    from graphplan.mechanism.scene import parse
    from graphplan.output.machine.balance_numbers import numbers, table

    ending = kind(options.output, ENDINGS, "balance")
    motion = mass_motion(parse(text, options.scene), options.positions or POSITIONS)
    write(table(motion) if ending == ".csv" else as_json(numbers(motion)), options.output)
    return 0
