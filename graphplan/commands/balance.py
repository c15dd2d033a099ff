"""Balance a linkage or a rotor: mass centre, shaking force and counterweights, or the masses of correction planes.

SCENE has links with masses; a file with a table [rotor] is a rotor. Of a linkage the mass centre is constructed by
principal vectors over the cycle, with its velocity and acceleration, and what its inertia does to the frame. JSON has
the numbers, in kg m, N and N m, points in the scene's lengths, travel in degrees (lengths of a drive that slides); .csv
the table over the cycle. A .toml is the scene with added dyads whose joint S moves as the mass centre does, for draw,
solve and cycle.

examples:
  graphplan balance ozols-16-1 -o sheet.svg
  graphplan balance ozols-16-1 --counterweights share --share 0.6 --radius 1=80 --positions 72 -o engine.json
  graphplan balance ozols-16-1 -o dyads.toml && graphplan draw dyads.toml -o dyads.svg
  graphplan balance rotor.toml -o rotor.svg
"""

from __future__ import annotations

import argparse
from functools import cache, partial
from typing import TYPE_CHECKING

from graphplan.commands.choices import add_diagrams, add_language, add_pencil, count, pencil, with_presentation
from graphplan.commands.output import SHEETS, Messages
from graphplan.commands.subjects import PNG, SCENE, Subject, add_steps, run_subject
from graphplan.errors import Refused

if TYPE_CHECKING:
    from graphplan.output.subjects.balance_sheet import BalanceSheet
    from graphplan.output.subjects.rotor_sheet import RotorSheet

POSITIONS, SHARE = 72, 0.5
WAYS = ("full", "partial", "share", "none")
ENDINGS = (".json", ".csv", *SHEETS)
PICTURES = {"dpi": PNG, "paper": SHEETS, "frame": SHEETS}


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("scene", metavar="SCENE", help="a scene with masses, a packaged one, a task with [rotor], or - for standard "
        "input")
    add("-o", "--output", metavar="FILE", help="the sheet: .svg, .pdf, .png, .tex or .dxf; the numbers: .json or .csv; "
        "of a linkage also .toml; without it JSON on standard output")
    add("--positions", type=count("--positions", 3), metavar="N", help=f"in how many poses of the cycle ({POSITIONS})")
    add("--counterweights", choices=WAYS, default="", help="so that the mass centre stands still (full, the default "
        "where it can be done); moves along the guide on the frame alone (partial); of a slider-crank on the crank "
        "alone, for what rotates and a share of what reciprocates (share); or none")
    add("--radius", action="append", default=[], metavar="LINK=LENGTH", help="how far from its pivot the counterweight "
        "of a link stands; without it the length of the link")
    add("--keep", action="append", default=[], metavar="LINK", help="a link that gets no counterweight")
    add("--share", type=float, metavar="PART", help=f"of the reciprocating mass that is balanced ({SHARE:g})")
    add_diagrams(command, "task")
    add_language(command)
    add_pencil(command)
    add_steps(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.mechanism.scene import source_text, tables_of

    text = source_text(options.scene, options.scene)
    if "rotor" in tables_of(text, options.scene):
        return run_subject(options, "rotor", ENDINGS, partial(balance_rotor, text), **PICTURES)
    return run_subject(options, "balance", (*ENDINGS[:2], *SCENE, *SHEETS), partial(balance_linkage, text), **PICTURES)


def balance_linkage(text: str, options: argparse.Namespace, ending: str, messages: Messages) -> Subject:
    """The linkage of a scene's text, balanced as the options have it."""
    from graphplan.check.balance import balancing, check_added_dyads
    from graphplan.mechanism.scene import parse
    from graphplan.output.subjects.balance_numbers import numbers, table

    scene = with_presentation(options, parse(text, options.scene, by_drive=True))
    if options.pencil:
        raise Refused("--pencil", "a linkage is computed, not drawn", "leave it out")
    if options.share is not None and (options.counterweights != "share" or not 0 <= options.share <= 1):
        raise Refused(f"--share {options.share:g}", "not a fraction of the reciprocating mass", "give 0 to 1, with "
                      "--counterweights share")
    result = cache(partial(balancing, scene, options.positions or POSITIONS, options.counterweights, options.keep,
                           _radii(options.radius), SHARE if options.share is None else options.share))

    def sheet(paper: str) -> BalanceSheet:
        from graphplan.output.subjects.balance_sheet import BalanceSheet

        return BalanceSheet(paper, result())

    balanced = ending not in SCENE  # the scene with dyads needs no counterweights
    return Subject(sheet, lambda: numbers(result()), scene.sheet.paper, files={
        ".csv": lambda: table(result().before), ".toml": lambda: check_added_dyads(scene)[0].text},
        remarks=[str(result().note)] if balanced and result().note else ())


def balance_rotor(text: str, options: argparse.Namespace, ending: str, messages: Messages) -> Subject:
    """The rotor of a task's text, balanced."""
    from graphplan.check.rotors import check_rotor
    from graphplan.machine.rotors.rotor import parse
    from graphplan.machine.rotors.rotor_balance import balance_rotor
    from graphplan.output.subjects.rotor_numbers import numbers, table
    from graphplan.output.subjects.rotor_sheet import PAPERS, RotorSheet

    for name in ("positions", "counterweights", "radius", "keep", "share"):
        if getattr(options, name):
            raise Refused(f"--{name}", "it does not apply to a rotor", "leave it out")
    result = balance_rotor(with_presentation(options, parse(text, options.scene)))
    check, paper = check_rotor(result), result.task.sheet.paper

    def sheet(paper: str) -> RotorSheet:
        return RotorSheet(paper, result, check, pencil(options))

    return Subject(sheet, lambda: numbers(sheet(paper or PAPERS[0])), paper, PAPERS, {".csv": partial(table, result)},
                   [f"{options.scene}: {note}" for note in result.notes])


def _radii(texts: list[str]) -> dict[str, float]:
    """The radii of an option, by link."""
    radii = {}
    for text in texts:
        link, _, length = text.partition("=")
        try:
            radius = float(length)
        except ValueError:
            radius = -1.0
        if not 0 < radius < float("inf"):
            raise Refused(f"--radius {text}", "not a link with a length above 0", "such as --radius 1=60")
        radii[link.strip()] = radius
    return radii
