"""Balance a linkage or a rotor: mass centre, shaking force and counterweights, or correction masses; or a governor.

SCENE has links with masses. A file with a table [rotor] is a rotor; a scene with a table [governor] is a governor, of
which the characteristic, speeds, stability and degree of irregularity are found. For a linkage the mass centre is
constructed by principal vectors over the cycle, with its velocity and acceleration, the shaking force and its moment.
JSON is in kg m, N and N m, points in the scene's lengths, travel in degrees (lengths of a drive that slides); .csv has
the table over the cycle. A .toml is the scene with added dyads whose joint S moves as the mass centre does, for draw,
solve and cycle.

examples:
  graphplan balance ozols-16-1 -o sheet.svg
  graphplan balance ozols-16-1 --counterweights share=0.6 --radius 1=80 --positions 72 -o engine.json
  graphplan balance ozols-16-1 -o dyads.toml && graphplan draw dyads.toml -o dyads.svg
  graphplan balance rotor.toml -o rotor.svg
  graphplan new watt.toml --kind governor && graphplan balance watt.toml -o watt.svg
"""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from dataclasses import replace
from functools import partial

from graphplan.app.choices import SCENE, Messages, add_subject, count, run_subject, sheet_keys, text_of_scene
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
)

OF_LINKAGES = "counterweights", "radius", "keep"


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("scene", metavar="SCENE", help="a scene with masses, a packaged one, a task with [rotor], or - for standard "
        "input")
    add("-o", "--output", metavar="FILE", help="the sheet: .svg, .pdf, .png, .tex or .dxf; the numbers: .json or .csv; "
        "of a linkage also .toml; without it JSON on standard output")
    add("--positions", type=count("--positions", 3), metavar="N",
        help=f"number of poses of the cycle ({BALANCED_POSITIONS})")
    add("--counterweights", type=_counterweights, metavar="HOW", help="full: the mass centre stands still "
        "(the default where that is possible); partial: it moves along the first guide on the frame; share: on the "
        f"crank of a slider-crank, for the rotating mass and {SHARE:g} of the reciprocating one, or share=0.6; none")
    add("--radius", action="append", default=[], metavar="LINK=LENGTH", help="distance of a link's counterweight from "
        "its pivot (the length of the link)")
    add("--keep", action="append", default=[], metavar="LINK", help="a link that gets no counterweight")
    add_subject(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.mechanism.scene import tables_of

    text = text_of_scene(options, options.scene)
    if "rotor" in tables_of(text, options.scene):
        return run_subject(options, "rotor", ENDINGS, partial(_rotor, text))
    return run_subject(options, "balance", (*ENDINGS[:2], *SCENE, *SHEETS), partial(_linkage, text))


def _linkage(text: str, options: argparse.Namespace, ending: str, messages: Messages) -> Subject:
    """The linkage of a scene's text, balanced as the options have it."""
    from graphplan.mechanism.written_scene import parse

    scene = with_sheet(parse(text, options.scene, by_drive=True), sheet_keys(options))
    if scene.governor:
        _refuse_options(options, "a governor", OF_LINKAGES)
        return balance_governor(scene, options.positions)
    way, share = options.counterweights or ("", None)
    subject = balance_linkage(scene, options.positions, way, _radii(options.radius), options.keep, share)
    return replace(subject, remarks=()) if ending in SCENE else subject


def _rotor(text: str, options: argparse.Namespace, ending: str, messages: Messages) -> Subject:
    """The rotor of a task's text, balanced."""
    from graphplan.machines.rotors.rotor import parse

    _refuse_options(options, "a rotor", ("positions", *OF_LINKAGES))
    return balance_rotor(with_sheet(parse(text, options.scene), sheet_keys(options)))


def _refuse_options(options: argparse.Namespace, subject: str, names: Iterable[str]) -> None:
    """Fail with `Refused` where an option is given that does not apply to a subject."""
    refuse_options(subject, **{f"--{name}": getattr(options, name) for name in names})


def _counterweights(text: str) -> tuple[str, float | None]:
    """The kind of counterweights that an option names, and the share of the reciprocating mass, if it is said."""
    way, equals, share = text.partition("=")
    if way not in WAYS or (equals and way != "share"):
        raise Refused(f"--counterweights {text}", "unknown", f"choose one of {', '.join(WAYS)}, or share=0.6")
    try:
        return way, float(share) if equals else None
    except ValueError:
        raise Refused(f"--counterweights {text}", "not a number", "such as share=0.6") from None


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
