"""The machine over its cycle: flywheel, true motion, balancing; and the balancing of rotors."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache, partial
from typing import TYPE_CHECKING, Unpack

from graphplan.app.drafting import SheetKeywords, pencil, translate_title, with_sheet
from graphplan.app.files import SHEETS
from graphplan.app.subjects import JSON, Subject, driven_scene
from graphplan.errors import Refused

if TYPE_CHECKING:
    from graphplan.design.hand import Pencil
    from graphplan.machines.flywheel.result import FlywheelResult
    from graphplan.machines.rotors.rotor import RotorTask
    from graphplan.mechanism.model import Scene
    from graphplan.sheet.panels import PanelSheet

Amount = Fraction | float | int
ENDINGS = (JSON, ".csv", *SHEETS)
POSITIONS, MAX_DRAWN = 24, 96  # plans of a motion unless it is said how many, and those that can be drawn
BALANCED_POSITIONS, GOVERNOR_POSITIONS, SHARE = 72, 7, 0.5
UNEVENNESS_LIMIT = 2
CONSTRUCTIONS = ("wittenbauer", "gutjahr", "areas")
WAYS = ("full", "partial", "share", "none")


# ---- flywheel --------------------------------------------------------------------------------------------------------


def flywheel(scene: Scene | str | os.PathLike[str], *, speed: Amount | None = None, inertia: Amount | None = None,
             unevenness: Amount | None = None, closes: str | None = None, positions: int | None = None,
             task: bool = False, by: str = "wittenbauer", **options: Unpack[SheetKeywords]) -> Subject:
    """The flywheel with which a machine runs as evenly as is asked, by Wittenbauer's diagram.

    Reads a scene with masses, loads and a table [flywheel], or its file or packaged name; keywords say otherwise: the
    mean `speed` of the first drive in rad/s, the `unevenness` (omega_max - omega_min) / mean or the `inertia` (mass *
    m^2) of a wheel that is given, what `closes` the cycle (drive or load), in how many `positions` it is drawn, and of
    the sheet paper, frame and language; a `task` has tables to fill in. `by` is the construction that the sheet draws:
    wittenbauer, gutjahr, or areas, which take the inertia as constant. Numbers are in kg m2, N m and J, travel in
    degrees (lengths of a drive that slides).
    Fails with `Refused` where the cycle cannot be followed or has no loads.
    Source: F. Wittenbauer, Graphische Dynamik (1923).
    """
    wish: dict[str, Amount | None] = {"speed": speed, "inertia": inertia, "unevenness": unevenness}
    return find_flywheel(with_sheet(driven_scene(scene), options),
                         {name: amount for name, amount in wish.items() if amount is not None}, closes, positions, task,
                         by)


def find_flywheel(driven: Scene, wish: Mapping[str, Amount], closes: str | None = None, positions: int | None = None,
                  task: bool = False, by: str = "wittenbauer") -> Subject:
    """Size the flywheel of a driven scene, with the amounts that are wished by name."""
    from graphplan.machines.flywheel.numbers import numbers, table
    from graphplan.machines.flywheel.result import flywheel as find
    from graphplan.machines.motion.check import check_flywheel

    if by not in CONSTRUCTIONS:
        raise Refused(f"--by {by}", "there is no such construction", f"one of {', '.join(CONSTRUCTIONS)}")
    amounts = {name: _amount(name, amount) for name, amount in wish.items()}
    scene = translate_title(_with_wish(driven, amounts, closes))
    result = find(scene, positions)
    result = replace(result, check=check_flywheel(result))

    def sheet(paper: str) -> PanelSheet:
        from graphplan.machines.flywheel.sheet import flywheel_sheet

        return flywheel_sheet(paper, result, task, by)

    return Subject(sheet, lambda: numbers(result, pencil_errors(result, pencil(scene))[0]), scene.sheet.paper,
                   files={".csv": partial(table, result)}, remarks=[f"{scene.name}: {note}" for note in result.notes],
                   name="flywheel", endings=ENDINGS)


def _with_wish(scene: Scene, amounts: Mapping[str, Fraction], closes: str | None) -> Scene:
    """The scene with its table [flywheel] as is wished."""
    from graphplan.mechanism.model import Flywheel

    if "inertia" in amounts and "unevenness" in amounts:
        raise Refused("inertia and unevenness", "each follows from the other", "one of them")
    if scene.flywheel is None and not ("speed" in amounts and len(amounts) > 1):
        return scene
    wish = scene.flywheel or Flywheel(amounts["speed"])
    if "inertia" in amounts or "unevenness" in amounts:
        wish = replace(wish, inertia=None, unevenness=None)
    return replace(scene, flywheel=replace(wish, **amounts, closes=closes or wish.closes))


def _amount(name: str, amount: Amount) -> Fraction:
    """A number above 0; of an inertia at least 0."""
    number = amount if isinstance(amount, Fraction) else Fraction(repr(amount))
    limit = UNEVENNESS_LIMIT if name == "unevenness" else None
    if number < 0 or (number == 0 and name != "inertia") or (limit and number >= limit):
        raise Refused(f"{name} {amount}", "out of range", "more than 0 and less than 2" if limit else "more than 0")
    return number


def pencil_errors(result: FlywheelResult, pencil: Pencil) -> tuple[float, float]:
    """The standard deviations by the pencil of the drawn flywheel, or unevenness, and of the mean moment."""
    from graphplan.accuracy.expected import deviation
    from graphplan.design.hand import program_hand

    drawing, values = result.drawing, result.drawing.values
    hand = program_hand(values.drawing.program, values.numbers, lambda step: 1.0, pencil)
    (m,), (n,), (mean,) = (values.drawing.roles[role] for role in ("m", "n", "mean"))
    intercept = deviation(hand, lambda values: values[m][1] - values[n][1]) * drawing.frames["energy"].y.unit
    return (intercept * drawing.change(result.given),
            deviation(hand, lambda values: values[mean][1]) * drawing.frames["moment"].y.unit)


# ---- true motion -----------------------------------------------------------------------------------------------------


def motion(scene: Scene | str | os.PathLike[str], *, speed: float | None = None, travel: float | None = None,
           positions: int | None = None, steady: bool = False, **options: Unpack[SheetKeywords]) -> Subject:
    """The true motion of a machine: its speed over travel and time, from its reduced inertia and its loads.

    Reads a scene with masses and loads, or its file or packaged name, the first drive's `speed` at the beginning (rad/s
    or length/s; 0: from rest), over which `travel` it is followed (degrees or lengths; without it one turn) in how many
    `positions`; `steady` is the cycle that repeats itself. Fails with `Refused` where the motion cannot be followed.
    """
    return find_motion(with_sheet(driven_scene(scene), options), speed, travel, positions, steady)


def find_motion(driven: Scene, speed: float | None, travel: float | None, positions: int | None,
                steady: bool) -> Subject:
    """Follow the true motion of a driven scene."""
    from graphplan.machines.motion.check import check_motion
    from graphplan.machines.motion.drawing import draw_motion
    from graphplan.machines.motion.runs import motion_of_scene
    from graphplan.machines.motion.sheet import motion_sheet, numbers, table

    for name, value in (("speed", speed), ("travel", travel)):
        if value is not None and not math.isfinite(value):
            raise Refused(name, f"{value:g}", "give a number")
    positions = positions or POSITIONS
    scene = translate_title(driven)
    result = motion_of_scene(scene, speed, travel, steady)
    drawing = draw_motion(result.motion, min(positions, MAX_DRAWN))
    check, remarks = check_motion(result, drawing), list[str]()
    if (stop := result.motion.stop) is not None:
        when = f"after {stop.time:.6g} s" if math.isfinite(stop.time) else "which it approaches asymptotically"
        remarks.append(f"{scene.name}: the machine stops at {result.machine.travel_text(stop.travel)}, {when}")
    if result.reduction.friction is not None:
        remarks.append(f"{scene.name}: friction is taken as it is at the speed of the drive in the scene")

    return Subject(lambda paper: motion_sheet(paper, result, min(positions, MAX_DRAWN)),
                   lambda: numbers(result, drawing, check, positions), scene.sheet.paper, ("A3", "A2"),
                   {".csv": partial(table, result, positions)}, remarks, rows=False, name="motion", endings=ENDINGS)


# ---- balancing -------------------------------------------------------------------------------------------------------


def balance(task: Scene | str | os.PathLike[str], *, positions: int | None = None, counterweights: str = "",
            radii: Mapping[str, float] | None = None, keep: Sequence[str] = (), share: float | None = None,
            **options: Unpack[SheetKeywords]) -> Subject:
    """A linkage, a rotor or a governor in balance: counterweights, the masses of planes, or the force of the balls.

    Reads a scene with masses, which is a governor where it has a table [governor], or a file, which may also be the
    task of a rotor ([rotor]). Of a linkage: in how many
    `positions` of the cycle, which `counterweights` (full, partial, share or none), how far from their pivots those of
    links stand (`radii`), links that `keep` theirs, and which `share` of the reciprocating mass is balanced. Numbers
    are in kg m, N and N m. Fails with `Refused` where it cannot be balanced so.
    """
    from graphplan.machines.rotors.rotor import parse
    from graphplan.mechanism.model import Scene
    from graphplan.mechanism.scene import source_text, tables_of

    if not isinstance(task, Scene):
        text = source_text(os.fspath(task), os.fspath(task))
        if "rotor" in tables_of(text, os.fspath(task)):
            refuse_options("a rotor", positions=positions, counterweights=counterweights, radii=radii, keep=keep,
                           share=share)
            return balance_rotor(with_sheet(parse(text, os.fspath(task)), options))
    scene = with_sheet(driven_scene(task), options)
    if scene.governor:
        refuse_options("a governor", counterweights=counterweights, radii=radii, keep=keep, share=share)
        return balance_governor(scene, positions)
    refuse_pencil(options.get("pencil"))
    return balance_linkage(scene, positions, counterweights, radii or {}, keep, share)


def refuse_options(subject: str, **options: object) -> None:
    """Fail with `Refused` where one of these is given, which do not apply to a subject."""
    for name, value in options.items():
        if value:
            raise Refused(name, f"it does not apply to {subject}", "leave it out")


def refuse_pencil(pencil: str | None) -> None:
    """Fail with `Refused` where a pencil is given for what is not drawn."""
    if pencil:
        raise Refused("--pencil", "a linkage is computed, not drawn", "leave it out")


def balance_linkage(scene: Scene, positions: int | None = None, counterweights: str = "",
                    radii: Mapping[str, float] | None = None, keep: Sequence[str] = (),
                    share: float | None = None) -> Subject:
    """A linkage, balanced."""
    from graphplan.machines.linkages.check import balancing, check_added_dyads
    from graphplan.machines.linkages.sheet import balance_sheet, numbers, table

    if share is not None and (counterweights != "share" or not 0 <= share <= 1):
        raise Refused(f"share={share:g}", "not a share of the reciprocating mass",
                      "give 0 to 1, with counterweights share")
    result = cache(partial(balancing, scene, positions or BALANCED_POSITIONS, counterweights, keep, dict(radii or {}),
                           SHARE if share is None else share))

    return Subject(lambda paper: balance_sheet(paper, result()), lambda: numbers(result()), scene.sheet.paper, files={
        ".csv": lambda: table(result().before), ".toml": lambda: check_added_dyads(scene)[0].text},
        remarks=(str(result().note) for _ in range(1) if result().note),  # the scene with dyads needs no counterweights
        name="balance", endings=(*ENDINGS[:2], ".toml", *SHEETS))


def balance_governor(scene: Scene, positions: int | None = None) -> Subject:
    """The governor of a scene, in so many positions of its range."""
    from graphplan.machines.governor.check import check_governor
    from graphplan.machines.governor.governor import draw_governor, find_governor
    from graphplan.machines.governor.sheet import governor_sheet, numbers, table

    result = find_governor(scene, positions or GOVERNOR_POSITIONS)
    drawing = draw_governor(result)
    check = check_governor(drawing)
    return Subject(lambda paper: governor_sheet(paper, result, check), lambda: numbers(drawing, check),
                   scene.sheet.paper, files={".csv": partial(table, result)}, name="governor", endings=ENDINGS)


def balance_rotor(task: RotorTask) -> Subject:
    """The rotor of a task, balanced."""
    from graphplan.machines.rotors.check import check_rotor
    from graphplan.machines.rotors.rotor_balance import balance_rotor as find
    from graphplan.machines.rotors.sheet import PAPERS, RotorOnPaper, numbers, table

    result = find(task)
    check, paper = check_rotor(result), task.sheet.paper
    on_paper = partial(RotorOnPaper, balanced=result, check=check, pencil=pencil(task))
    return Subject(lambda name: on_paper(name).sheet, lambda: numbers(on_paper(paper or PAPERS[0])), paper,
                   PAPERS, {".csv": partial(table, result)},
                   [f"{task.name}: {note}" for note in result.notes], name="rotor", endings=ENDINGS)
