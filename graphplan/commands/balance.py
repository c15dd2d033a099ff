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
from dataclasses import replace

from graphplan.commands.choices import add_language, add_paper, add_pencil, add_steps, count, refuse_steps, with_steps
from graphplan.commands.output import DOTS, SHEETS, Messages, as_json, kind, write, write_sheets
from graphplan.errors import Refused
from graphplan.mechanism.sections import FRAMES

ENDINGS = (".json", ".csv", ".toml", *SHEETS)
POSITIONS, SHARE = 72, 0.5
WAYS = ("full", "partial", "share", "none")


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
    add("--dpi", type=count("--dpi", 20, 600), metavar="N", help=f"dots per inch of a .png ({DOTS})")
    add_paper(command, "the sheet; without it the task's, or the smallest that will do")
    add("--frame", choices=FRAMES, help="frame and title block; without it the task's, or iso")
    add_language(command)
    add_pencil(command)
    add_steps(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.mechanism.scene import source_text, tables_of

    text = source_text(options.scene, options.scene)
    if "rotor" in tables_of(text, options.scene):
        from graphplan.commands import balance_rotor

        return balance_rotor.run(options, text)
    from graphplan.check.balance import balancing
    from graphplan.mechanism.scene import parse
    from graphplan.output.subjects.balance_numbers import numbers, table

    scene = parse(text, options.scene, by_drive=True)
    said = {key: value for key in ("paper", "frame", "language") if (value := getattr(options, key))}
    scene = replace(scene, sheet=replace(scene.sheet, **said))
    ending, messages = kind(options.output, ENDINGS, "balance"), Messages(options.quiet)
    drawn_alone(options, ending)
    refuse_steps(options, ending)
    if options.pencil:
        raise Refused("--pencil", "a linkage is computed, not drawn", "leave it out")
    if ending == ".toml":
        from graphplan.check.balance import check_added_dyads

        write(check_added_dyads(scene)[0].text, options.output)
        return 0
    if options.share is not None and (options.counterweights != "share" or not 0 <= options.share <= 1):
        raise Refused(f"--share {options.share:g}", "not a fraction of the reciprocating mass", "give 0 to 1, with "
                      "--counterweights share")
    found = balancing(scene, options.positions or POSITIONS, options.counterweights, options.keep,
                      _radii(options.radius), SHARE if options.share is None else options.share)
    if found.note:
        messages.remark(found.note)
    if ending in SHEETS:
        from graphplan.output.subjects.balance_sheet import sheets

        write_sheets(sheets(found, scene.sheet.paper or None), options.output, ending.removeprefix("."), options.dpi)
    else:
        from graphplan.output.panelled import PAPERS
        from graphplan.output.subjects.balance_sheet import BalanceSheet

        paper = scene.sheet.paper or PAPERS[0]
        data = with_steps(options, numbers(found), lambda: BalanceSheet(paper, found))
        write(table(found.before) if ending == ".csv" else as_json(data, rows=True), options.output)
    return 0


def drawn_alone(options: argparse.Namespace, ending: str) -> None:
    """Refuse options of sheets where none is drawn."""
    for name, fits in (("dpi", ending == ".png"), ("paper", ending in SHEETS), ("frame", ending in SHEETS)):
        if getattr(options, name) and not fits:
            raise Refused(f"--{name} {getattr(options, name)}", f"it does not apply to a {ending}",
                          "leave it out, or -o FILE.png")


def _radii(given: list[str]) -> dict[str, float]:
    """The radii of an option, by link."""
    found = {}
    for text in given:
        link, _, length = text.partition("=")
        try:
            found[link.strip()] = float(length)
        except ValueError:
            found[link.strip()] = -1.0
        if not 0 < found[link.strip()] < float("inf"):
            raise Refused(f"--radius {text}", "not a link with a length above 0", "such as --radius 1=60")
    return found
