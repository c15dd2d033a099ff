"""Options that several subcommands share, and what they are asked for: a scene, its construction, its sheet."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from itertools import permutations
from typing import TYPE_CHECKING, Any, TypeVar

from graphplan.accuracy import PREFERENCES
from graphplan.commands.output import DEFAULT_DPI, Messages
from graphplan.errors import ConstructionError, Disagreement, Refused, SingularPose
from graphplan.mechanism.items import suggestion
from graphplan.mechanism.pairs.pair import FRAME
from graphplan.mechanism.sections import FRAMES, MAX_POSITIONS, METHODS, OF_PATHS, PROTOCOLS, SIZES
from graphplan.methods.panels import INERTIA
from graphplan.words import LANGUAGES

if TYPE_CHECKING:
    from graphplan.accuracy.drafted import Drafted
    from graphplan.accuracy.hand import Pencil
    from graphplan.cams.task import Task
    from graphplan.check.report import Report
    from graphplan.machine.rotors.rotor import RotorTask
    from graphplan.mechanism.model import Scene

Source = TypeVar("Source", "Scene", "Task", "RotorTask")
MAX_ROUNDS = 50  # of friction that are drawn, each in force plans of its own


def count(option: str, least: int, most: int | None = None) -> Callable[[str], int]:
    """What reads the whole number of an option, within bounds."""
    right = f"at least {least}" if most is None else f"{least} to {most}"

    def read(text: str) -> int:
        try:
            number = int(text)
        except ValueError:
            number = least - 1
        if number < least or (most is not None and number > most):
            raise Refused(option, text, f"give {right}")
        return number

    return read


# --- declared ------------------------------------------------------------------------------------------------------


def add_choices(command: argparse.ArgumentParser, *, strict: bool = False) -> None:
    """The options that choose how it is drawn."""
    add = command.add_argument
    add("--method", default="", choices=(*METHODS, *OF_PATHS),
        help="the form of loci and rings, or of centres of curvature; without it the pose chooses, and the protocol "
        "says why")
    add("--plan", default="", metavar="PLAN", help="orthogonal velocities on the mechanism plan, polar plans, or "
        "velocity triangles on the lines of centres of gears (without any the lengths of the links decide); of the "
        "forces lever, polygons, or both (default); such as --plan polar,lever")
    add("--inertia", default=INERTIA[0], choices=INERTIA, help="inertia forces: at the centre of mass with a couple "
        "(default), shifted so that they need none, or at two points that replace the link")
    add("--rounds", type=count("--rounds", 1, MAX_ROUNDS), metavar="N",
        help="draw N rounds of the friction iteration; without it until the forces no longer change")
    command.set_defaults(strict=False, prefer="", pencil=None, paper=None, frame=None, language="", protocol="auto",
                         curves="", centrodes="", faint=None)
    if strict:
        add("--strict", action="store_true", help="compasses and straightedge alone, no set squares")


def add_travel(command: argparse.ArgumentParser) -> None:
    """The option that asks for another pose."""
    command.add_argument("--at", metavar="TRAVEL", help="construct the mechanism where its drive has gone so far from "
                         "the given pose, in degrees or in lengths of one that slides, and then its plans; of several "
                         "drives it sets the first, the others follow in proportion, or a list such as 60,-30; or "
                         "outer or inner, an extreme position of the rocker or slider that its crank swings, of "
                         "several such as 'outer 3'")


def add_language(command: argparse.ArgumentParser) -> None:
    """The option that chooses the language; by default the scene's."""
    command.add_argument("--language", default="", choices=LANGUAGES,
                         help="the language of all words (without it the scene's, or en)")


def add_paper(command: argparse.ArgumentParser, told: str) -> None:
    """The option that names the sheet."""
    command.add_argument("--paper", choices=tuple(SIZES), help=told)


def add_diagrams(command: argparse.ArgumentParser, source: str = "scene") -> None:
    """The options that say what a sheet of diagrams looks like; without them the scene, or the task, has a say in it.
    """
    add = command.add_argument
    add("--dpi", type=count("--dpi", 20, 600), metavar="N", help=f"dots per inch of a .png ({DEFAULT_DPI})")
    add_paper(command, f"the sheet; without it the {source}'s, or the smallest that will do")
    add("--frame", choices=FRAMES, help=f"frame and title block; without it the {source}'s, or iso")


def add_sheet(command: argparse.ArgumentParser, *, positions: bool = True) -> None:
    """The options that say what the sheet looks like; without them the scene has a say in it.

    The option of `positions` is left to a command to which they mean something else.
    """
    add_paper(command, "the sheet; without it the scene's, or the smallest that will do")
    command.add_argument("--frame", choices=FRAMES, help="frame and title block after ISO 5457 and 7200, or GOST "
                         "2.301 and 2.104; without it the scene's, or iso")
    command.add_argument("--protocol", choices=PROTOCOLS, default="auto", help="where the words stand: aside, in "
                         "columns beside the plans; on pages of their own; nowhere; or aside where the plans keep "
                         "most of the page, else on pages (auto, the default)")
    add_curves(command)
    if positions:
        command.add_argument("--positions", type=count("--positions", 1, MAX_POSITIONS), metavar="N", dest="faint",
                             help="so many positions of the mechanism in faint lines")
    add_language(command)


def add_curves(command: argparse.ArgumentParser) -> None:
    """The options that name the curves of the motion."""
    add = command.add_argument
    add("--curves", metavar="POINTS", help="the paths of these points over the motion, such as M,C, or of all")
    add("--centrodes", metavar="LINKS", help='the fixed and the moving centrodes of these links, each with the link '
        'that it moves on, such as "2 frame,2 3"')


def add_pencil(command: argparse.ArgumentParser) -> None:
    """The option that sets the accuracy of the pencil."""
    command.add_argument("--pencil", type=_pencil, metavar="SIZES",
                         help="how far off the pencil is, as standard deviations: such as point=0.1,edge=0.1,"
                         "opening=0.1 in mm of paper and angle=0.05 in degrees (the defaults)")


def _pencil(text: str) -> Pencil:
    from graphplan.accuracy.hand import pencil

    return pencil(text)


def add_preference(command: argparse.ArgumentParser) -> None:
    """The options by which a form is preferred."""
    command.add_argument("--prefer", default="", choices=PREFERENCES,
                         help="weigh all forms: the fewest operations, the smallest pencil error, or both")
    add_pencil(command)


# --- asked for -----------------------------------------------------------------------------------------------------


def load_scene(options: argparse.Namespace, scene: Scene | None = None) -> Scene:
    """The scene, by default that which is named, with as many rounds of friction as the options ask for, if they do."""
    from graphplan.mechanism.scene import load

    if scene is None:
        scene = load(options.scene)
        question(options, scene)
    if getattr(options, "at", None) is not None:
        from graphplan.cycle.pose import at

        scene = at(scene, _travels(options.at))
    if options.rounds is None or scene.loads is None:
        return scene
    return replace(scene, loads=replace(scene.loads, rounds=options.rounds))


def question(options: argparse.Namespace, scene: Scene) -> None:
    """Report what is probably a slip of the pen in a scene, though it is allowed."""
    from graphplan.mechanism.checks import questions

    for fault in questions(scene):
        Messages(options.quiet).remark(f"{scene.name}: {fault}")


def _travels(text: str) -> list[Fraction] | str:
    """The travels of an option, of each drive or of the first alone, or the words for an extreme position."""
    if text.strip()[:1].isalpha():
        return text
    try:
        travels = [Fraction(travel.strip()) for travel in text.split(",")]
        sum(map(float, travels))  # OverflowError: a travel that is larger than any float
        return travels
    except (ValueError, ZeroDivisionError, OverflowError):
        raise Refused(f"--at {text}", "not a travel", "degrees or lengths, such as 60, or 60,-30") from None


def load_sheet_scene(options: argparse.Namespace, scene: Scene | None = None) -> Scene:
    """The same with its sheet as the options have it, where they say; its title in the sheet's language."""
    scene, wishes = load_scene(options, scene), dict[str, Any]()
    if options.curves:
        wishes["curves"] = _movable(scene, options.curves)
    if options.centrodes:
        wishes["centrodes"] = _rolling(scene, options.centrodes)
    if options.faint:
        wishes["positions"] = options.faint
    return on_sheet(options, scene, **wishes)


def on_sheet(options: argparse.Namespace, scene: Scene, **more: Any) -> Scene:
    """A scene with its sheet as the options and `more` have it, where they say; its title in the sheet's language."""
    from graphplan.words.tongue import tongue

    scene = with_presentation(options, scene, **more)
    return replace(scene, title=tongue(scene.sheet.language).title(scene.title))


def with_presentation(options: argparse.Namespace, source: Source, **more: Any) -> Source:
    """A scene or a task with its sheet as the options and `more` have it, where they say."""
    chosen = {key: value for key in ("paper", "frame", "language") if (value := getattr(options, key))}
    return replace(source, sheet=replace(source.sheet, **chosen, **more))


def make_report(options: argparse.Namespace, scene: Scene, **more: Any) -> Report:
    """The construction that the options ask for, compared with the solver; its notes say why a form is preferred."""
    from graphplan.check.trusted import report

    how, reasons = drawn_by(options, scene)
    result = report(scene, **how, **more)
    result.drawing.notes.extend(reasons)
    return result


def drawable(options: argparse.Namespace) -> Report:
    """The same of the scene on its sheet, or of the part of it that is regular in this pose; its notes say what of the
    rest is not drawn, and why."""
    from graphplan.check.answerable import report_regular_part
    from graphplan.check.json_results import reasons
    from graphplan.phrases import said

    result, left_out = report_regular_part(load_sheet_scene(options),
                                           lambda scene: make_report(options, scene)), dict[str, list[str]]()
    if result.given_scene is not result.scene:
        for named in reasons(result).values():
            for name, why in named.items():
                left_out.setdefault(why, []).append(name)
        result.drawing.notes.extend(said("not drawn: {0}: {1}", ", ".join(dict.fromkeys(names)), why)
                                    for why, names in left_out.items())
    return result


def drawn_by(options: argparse.Namespace, scene: Scene) -> tuple[dict[str, Any], tuple[str, ...]]:
    """How a scene is to be drawn, by the method named or preferred, and the lines that say why it is preferred.

    Where no form can be weighed, the pose's own is drawn, as without a preference.
    """
    how = {key: getattr(options, key) for key in ("method", "plan", "inertia", "strict")}
    if not options.prefer:
        return how, ()
    from graphplan.accuracy.preference import preferred_form, reason
    from graphplan.check.trusted import construct

    try:
        form = preferred_form(scene, options.prefer, pencil(options), construct=construct, **how)
    except (ConstructionError, Disagreement, Refused, SingularPose) as fault:
        if options.method:
            raise
        return how, (reason(fault),)
    return {**how, "method": form.method}, form.remarks


def on_paper(options: argparse.Namespace, result: Report | None = None) -> Drafted:
    """A construction on its sheet, drawn with the pencil and in the language that are asked for."""
    from graphplan.accuracy.drafted import draft
    from graphplan.words.tongue import tongue

    result = result or drawable(options)
    return draft(result.drawing, pencil(options), check=result.check, tongue=tongue(result.scene.sheet.language),
                 protocol=options.protocol)


def pencil(options: argparse.Namespace) -> Pencil:
    """The pencil that is asked for, or a careful hand's."""
    from graphplan.accuracy.hand import Pencil

    return options.pencil or Pencil()


def _movable(scene: Scene, text: str) -> tuple[str, ...]:
    """The points of an option, all of which must move."""
    movable = [point for point, links in scene.links_of.items() if links and FRAME not in links]
    points = movable if text == "all" else text.replace(",", " ").split()
    for point in points:
        if point not in movable:
            why = f"{point} does not move" if point in scene.points else f"there is no point {point}"
            raise Refused(f"--curves {text}", why, suggestion(point, movable, "point"))
    return tuple(dict.fromkeys(points))


def _rolling(scene: Scene, text: str) -> tuple[str, ...]:
    """The pairs of links of an option, all of which the scene has; all those on the frame, if it is "all"."""
    if text == "all":
        return tuple(f"{link} {FRAME}" for link in scene.moving)
    choices = [f"{link} {on}" for link, on in permutations((FRAME, *scene.moving), 2)]
    pairs = [" ".join(names.split()) for names in text.split(",")]
    for links in pairs:
        if links not in choices:
            why = f"there are no two links {links}" if links else "no links are named"
            raise Refused(f"--centrodes {text}", why, suggestion(links, choices, "pair of links"))
    return tuple(dict.fromkeys(pairs))
