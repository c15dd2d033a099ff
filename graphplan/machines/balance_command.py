"""Balance a linkage or a rotor: mass centre, shaking force and counterweights, or correction masses; or a governor.

SCENE has links with masses; a file with a table [rotor] is a rotor, a scene with a table [governor] a governor, of
which the characteristic, speeds, stability and degree of irregularity are found. Of a linkage the mass centre is
constructed by principal vectors over the cycle, with its velocity and acceleration, and what its inertia does to the
frame. JSON has the numbers, in kg m, N and N m, points in the scene's lengths, travel in degrees (lengths of a drive
that slides); .csv the table over the cycle. A .toml is the scene with added dyads whose joint S moves as the mass
centre does, for draw, solve and cycle.

examples:
  graphplan balance ozols-16-1 -o sheet.svg
  graphplan balance ozols-16-1 --counterweights share --share 0.6 --radius 1=80 --positions 72 -o engine.json
  graphplan balance ozols-16-1 -o dyads.toml && graphplan draw dyads.toml -o dyads.svg
  graphplan balance rotor.toml -o rotor.svg
  graphplan new watt.toml --kind governor && graphplan balance watt.toml -o watt.svg
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from dataclasses import replace
from functools import partial

from graphplan.app.choices import (
    SCENE,
    Messages,
    add_pencil,
    add_subject,
    count,
    run_subject,
    sheet_keys,
    text_of_scene,
)
from graphplan.app.drafting import with_sheet
from graphplan.app.files import SHEETS
from graphplan.app.subjects import Subject
from graphplan.errors import Refused
from graphplan.machines.subjects import (
    BALANCED_POSITIONS,
    ENDINGS,
    SHARE,
    WAYS,
    balance_governor,
    balance_linkage,
    balance_rotor,
    refuse_options,
    refuse_pencil,
)

PICTURES = {"paper": SHEETS}
OF_LINKAGES = "counterweights", "radius", "keep", "share"


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("scene", metavar="SCENE", help="a scene with masses, a packaged one, a task with [rotor], or - for standard "
        "input")
    add("-o", "--output", metavar="FILE", help="the sheet: .svg, .pdf, .png, .tex or .dxf; the numbers: .json or .csv; "
        "of a linkage also .toml; without it JSON on standard output")
    add("--positions", type=count("--positions", 3), metavar="N",
        help=f"in how many poses of the cycle ({BALANCED_POSITIONS})")
    add("--counterweights", choices=WAYS, default="", help="so that the mass centre stands still (full, the default "
        "where it can be done); moves along the guide on the frame alone (partial); of a slider-crank on the crank "
        "alone, for what rotates and a share of what reciprocates (share); or none")
    add("--radius", action="append", default=[], metavar="LINK=LENGTH", help="how far from its pivot the counterweight "
        "of a link stands; without it the length of the link")
    add("--keep", action="append", default=[], metavar="LINK", help="a link that gets no counterweight")
    add("--share", type=float, metavar="PART", help=f"of the reciprocating mass that is balanced ({SHARE:g})")
    add_pencil(command)
    add_subject(command, "task")


def run(options: argparse.Namespace) -> int:
    from graphplan.mechanism.scene import tables_of

    text = text_of_scene(options, options.scene)
    if "rotor" in tables_of(text, options.scene):
        return run_subject(options, "rotor", ENDINGS, partial(_rotor, text), **PICTURES)
    return run_subject(options, "balance", (*ENDINGS[:2], *SCENE, *SHEETS), partial(_linkage, text), **PICTURES)


def _linkage(text: str, options: argparse.Namespace, ending: str, messages: Messages) -> Subject:
    """The linkage of a scene's text, balanced as the options have it."""
    from graphplan.mechanism.written_scene import parse

    scene = with_sheet(parse(text, options.scene, by_drive=True), sheet_keys(options))
    if scene.governor:
        _refuse_options(options, "a governor", OF_LINKAGES)
        return balance_governor(scene, options.positions)
    refuse_pencil(options.pencil)
    subject = balance_linkage(scene, options.positions, options.counterweights, _radii(options.radius), options.keep,
                              options.share)
    return replace(subject, remarks=()) if ending in SCENE else subject


def _rotor(text: str, options: argparse.Namespace, ending: str, messages: Messages) -> Subject:
    """The rotor of a task's text, balanced."""
    from graphplan.machines.rotors.rotor import parse

    _refuse_options(options, "a rotor", ("positions", *OF_LINKAGES))
    return balance_rotor(with_sheet(parse(text, options.scene), sheet_keys(options)))


def _refuse_options(options: argparse.Namespace, subject: str, names: Iterable[str]) -> None:
    """Fail with `Refused` where an option is given that does not apply to a subject."""
    refuse_options(subject, **{f"--{name}": getattr(options, name) for name in names})


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
