"""Options that several subcommands share."""

from __future__ import annotations

import argparse
from dataclasses import replace
from typing import TYPE_CHECKING

from graphplan.errors import Refused

if TYPE_CHECKING:
    from graphplan.mechanism.model import Scene

MOST_ROUNDS = 50  # of friction that are drawn, each in force plans of its own


def add_choices(command: argparse.ArgumentParser, *, strict: bool = False) -> None:
    """The options that choose how it is drawn."""
    command.add_argument("--method", default="", choices=("auxiliary", "trial", "poles"),
                         help="the form of loci and rings; without it the pose chooses, and the protocol says why")
    command.add_argument("--plan", default="", metavar="PLAN",
                         help="orthogonal velocities on the mechanism plan, or polar plans (without either the lengths "
                         "of the links decide); of the forces lever, polygons, or both (default); such as "
                         "--plan polar,lever")
    command.add_argument("--inertia", default="couple", choices=("couple", "shifted", "points"),
                         help="inertia forces: at the centre of mass with a couple (default), shifted so that they "
                         "need none, or at two points that replace the link")
    command.add_argument("--rounds", type=int, metavar="N",
                         help="draw so many rounds of friction; without it they go on until the forces stand")
    if strict:
        command.add_argument("--strict", action="store_true",
                             help="compasses and straightedge alone, no set squares")


def add_language(command: argparse.ArgumentParser, default: str = "en") -> None:
    """The option that says in which language it is said; the `default` may be left to the scene."""
    from graphplan.words.tongue import LANGUAGES

    told = default or "without it the scene's, or en"
    command.add_argument("--language", default=default, choices=LANGUAGES, help=f"the language of all words ({told})")


def add_sheet(command: argparse.ArgumentParser) -> None:
    """The options that say what the sheet looks like; without them the scene has a say in it."""
    command.add_argument("--paper", choices=("A4", "A3", "A2", "A1"),
                         help="the sheet; without it the scene's, or the smallest that will do")
    command.add_argument("--frame", choices=("iso", "gost"),
                         help="frame and title block after ISO 5457 and 7200, or GOST 2.301 and 2.104; without it the "
                         "scene's, or iso")
    add_language(command, default="")


def rounded(options: argparse.Namespace, scene: Scene) -> Scene:
    """The scene with as many rounds of friction as the options ask for, if they do."""
    if options.rounds is None:
        return scene
    if not 1 <= options.rounds <= MOST_ROUNDS:
        raise Refused("--rounds", f"{options.rounds} rounds of friction", f"give 1 to {MOST_ROUNDS}")
    if scene.loads is None:
        return scene
    return replace(scene, loads=replace(scene.loads, rounds=options.rounds))


def presented(options: argparse.Namespace, scene: Scene) -> Scene:
    """The scene with its sheet and its rounds of friction as the options have it, where they say; its title in the
    sheet's language."""
    from graphplan.words.tongue import tongue

    scene = rounded(options, scene)
    said = {key: value for key in ("paper", "frame", "language") if (value := getattr(options, key))}
    sheet = replace(scene.sheet, **said)
    return replace(scene, sheet=sheet, title=tongue(sheet.language or "en").title(scene.title))


def add_pencil(command: argparse.ArgumentParser) -> None:
    """The option that says how well it is drawn."""
    command.add_argument("--pencil", default="", metavar="SIZES",
                         help="how far off the pencil is, as standard deviations: such as point=0.1,edge=0.1,"
                         "opening=0.1 in mm of paper and angle=0.05 in degrees (the defaults)")


def add_preference(command: argparse.ArgumentParser) -> None:
    """The options by which a form is preferred."""
    command.add_argument("--prefer", default="", choices=("quick", "accurate", "balanced"),
                         help="weigh all forms: the fewest operations, the smallest pencil error, or both")
    add_pencil(command)


def chosen(options: argparse.Namespace, scene: Scene, *, strict: bool = False,
           paper: str | None = None) -> tuple[str, tuple[str, ...]]:
    """The method to draw by, as named or as preferred, and what is told of the preference."""
    if not options.prefer:
        return options.method, ()
    from graphplan.accuracy.pencil import pencil
    from graphplan.accuracy.preference import preferred
    from graphplan.check.trusted import construct

    found = preferred(scene, options.prefer, pencil(options.pencil), method=options.method, plan=options.plan,
                      strict=strict, inertia=options.inertia, paper=paper, construct=construct)
    return found.method, found.told
