"""What a finer setting buys: the error against what drawing or computing takes, for each choice that a user has.

Rounds of friction are drawn one on the other, a diagram's strips each have a plan, as a flywheel's positions have, a
cam's outline consists of arcs, and an answer may be checked, or be in fractions.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from graphplan.accuracy.tolerances import EPSILON
from graphplan.bench.rows import group_rows, ratios
from graphplan.bench.stability import by_pencil
from graphplan.cams.profile import make_cam
from graphplan.cams.task import parse
from graphplan.check.report import STANDING_ROUNDS
from graphplan.check.trusted import report
from graphplan.design.decide import construct
from graphplan.design.hand import Pencil
from graphplan.kernel.lemoine import counts
from graphplan.kernel.numbers import Floats
from graphplan.machines.flywheel.result import flywheel
from graphplan.machines.motion.drawing import draw_motion
from graphplan.machines.motion.runs import motion_of_scene
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import load
from graphplan.output import diagrams

ROUNDS, STRIPS, TOLERANCE, ANSWER = "rounds of friction", "strips of a motion", "tolerance of a cam", "check"
POSITIONS = "positions of a flywheel"
MAX_ROUNDS = 3
FRICTION = 1, 2, 4  # times the scene's coefficients
STRIP_COUNTS = 6, 12, 24, 48, 96
POSITION_COUNTS = 6, 12, 24, 48, 96, 192
FLYWHEELS = "ozols-13-6", "ozols-9-1", "jaanimets-10"  # by the speed and the unevenness that the first one has
TOLERANCES = tuple(10.0 ** -k for k in range(1, 7))  # mm
LAWS = "sine", "parabolic"
ANSWERED = ("four-bar", "alt-eight-link", "jaanimets-10")
UNPROMISED, FRACTIONS = "nothing promised", "fractions"


@dataclass(frozen=True)
class Setting:
    """One choice in one case: its value, its price (operations, strips, arcs, or time relative to that of a
    construction alone), and its error, relative to the largest or in mm; None if no error is promised."""

    choice: str
    case: str
    value: str
    takes: float
    error: float | None


def settings(pencil: Pencil) -> Iterator[Setting]:
    """Each choice in its cases, the cheapest value first."""
    yield from _rounds(pencil)
    for name in ("ozols-13-6", "ozols-13-7"):
        motion = motion_of_scene(load(name)).motion
        for strips in STRIP_COUNTS:
            if drawing := draw_motion(motion, strips):
                yield Setting(STRIPS, name, str(strips), strips, drawing.errors["omega"])
    yield from _positions()
    for law in LAWS:
        cam = make_cam(parse(CAM.format(law=law), law))
        for tolerance in TOLERANCES:
            yield Setting(TOLERANCE, f"{law} law", f"{tolerance:g}", len(cam.arcs(tolerance)), tolerance)
    yield from _answers()


def _rounds(pencil: Pencil) -> Iterator[Setting]:
    """The balance of a machine that rubs, after so many rounds, against the one that stands; without, the smooth one's.
    Beside it what a pencil loses: of the least friction.
    """
    scene = load("kinytskyi")
    assert scene.loads is not None
    for times in FRICTION:
        rough = replace(scene.loads, frictions=tuple(replace(friction, coefficient=times * friction.coefficient)
                                                     for friction in scene.loads.frictions))
        drawings = [construct(replace(scene, loads=rough, sheet=replace(scene.sheet, rounds=rounds)))
                    for rounds in (*range(1, MAX_ROUNDS + 1), STANDING_ROUNDS)]
        smooth = construct(replace(scene, loads=replace(rough, frictions=())))
        smooth_balance, *balances, standing = (drawing.balances[0] for drawing in (smooth, *drawings))
        coefficient = max(float(friction.coefficient) for friction in rough.frictions)
        steps = [counts(drawing.drawn).operations for drawing in (smooth, *drawings)]
        for rounds, balance in enumerate([smooth_balance, *balances]):
            yield Setting(ROUNDS, f"f = {coefficient:g}", str(rounds), steps[rounds],
                          max(EPSILON, abs(balance - standing) / abs(standing)))
        if times == FRICTION[0]:
            for rounds, drawing in enumerate((smooth, *drawings[:-1])):
                yield Setting(ROUNDS, "by pencil", str(rounds), steps[rounds], by_pencil(drawing, pencil)[0])


def _positions() -> Iterator[Setting]:
    """The flywheel that is drawn through so many positions of a cycle, against that of the curves themselves."""
    wish = load(FLYWHEELS[0]).flywheel
    for name in FLYWHEELS:
        scene = replace(load(name), flywheel=wish)
        runs = {count: (partial(_drawn_inertia, scene, count), 1) for count in POSITION_COUNTS}
        true = flywheel(scene).wheel.inertia
        for count, (_, time, _) in ratios(runs, POSITION_COUNTS[0]).items():
            yield Setting(POSITIONS, name, str(count), time, abs(_drawn_inertia(scene, count) / true - 1))


def _drawn_inertia(scene: Scene, positions: int) -> float:
    """The inertia of the flywheel, as it is read from its drawing."""
    return flywheel(scene, positions).drawn_result


def _answers() -> Iterator[Setting]:
    """A construction in floats, alone and compared with the solver within proven bounds, and in fractions."""
    for name in ANSWERED:
        scene = load(name)
        runs: dict[str, Any] = {"unchecked": lambda scene=scene: construct(scene).read(Floats()),
                                "checked": lambda scene=scene: report(scene),
                                "exact": lambda scene=scene: report(scene, exact=True)}
        promised = {"unchecked": None, "checked": max(report(scene).bounds.values()), "exact": 0.0}
        for value, (_, time, _) in ratios({value: (run, 1) for value, run in runs.items()}, "unchecked").items():
            yield Setting(ANSWER, name, value, time, promised[value])


CAM = """
[[law]]
angle = 120
motion = "{law}"
stroke = 25
[[law]]
angle = 60
motion = "dwell"
[[law]]
angle = 120
motion = "{law}"
stroke = -25
[[law]]
angle = 60
motion = "dwell"
[follower]
moves = "translating"
contact = "roller"
radius = 8
[cam]
base = 40
rpm = 300
"""


LOOKS = tuple(zip((diagrams.BLACK, diagrams.GREY, diagrams.BLUE, diagrams.VERMILION), ("o", "P", "s", "^"),
                  diagrams.DASHES, strict=False))
HEADINGS = {
    ROUNDS: "In kinytskyi, from none, the smooth machine, on: one round is enough for a pencil, whose own error is "
            "that of the worst result.",
    STRIPS: "Twice as many strips, a quarter of the error, where loads do not depend on the speed.",
    POSITIONS: "From 6 on, each mark twice as many; they cost a computer little, a draughtsman a pose each.",
    TOLERANCE: "Ten times as fine, about twice as many arcs.",
    ANSWER: "A check is a second solution with proven bounds; fractions are exact.",
}
AXES = {
    ROUNDS: ("drawing operations", "error of the balance, relative"),
    STRIPS: ("strips", "error of the speed, relative"),
    POSITIONS: ("time; with 6 positions 1", "error of the inertia, relative"),
    TOLERANCE: ("arcs of the outline", "tolerance, mm"),
    ANSWER: ("time; a construction alone is 1", "promised error, relative"),
}
# where answers stand of which no error is known, or which have none
LEVELS = {UNPROMISED: 10.0 ** -8, FRACTIONS: 10.0 ** -18}
REMARKS = "Lower is more accurate, further left is cheaper. Drawn with {pencil}."


@diagrams.in_style
def picture(rows: Sequence[Setting], pencil: str) -> diagrams.Figure:
    """Return the chart of all choices."""
    choices = group_rows(rows, "choice")
    headings = [diagrams.Heading(choice.capitalize(), HEADINGS[choice]) for choice in choices]
    figure, panels = diagrams.page("What a finer setting buys", REMARKS.format(pencil=pencil), headings,
                                   (110.0, 80.0), 3, diagrams.Margins(left=34.0))
    for axes, (choice, of) in zip(panels, choices.items(), strict=True):
        _draw_choice(axes, choice, of)
    return figure


def _draw_choice(axes: diagrams.Axes, choice: str, rows: Sequence[Setting]) -> None:
    """Draw a line for each case, through its values from the cheapest on, with its name at the end."""
    labels, errors = list[diagrams.SeriesLabel](), [row.error for row in rows if row.error]
    for (colour, marker, dash), (case, of) in zip(LOOKS, group_rows(rows, "case").items(), strict=False):
        takes, levels = zip(*((row.takes, _level(row.error)) for row in of), strict=True)
        axes.plot(takes, levels, color=colour, marker=marker, linestyle=dash, gid=case)
        labels.append(diagrams.SeriesLabel(takes[-1], levels[-1], case, colour))
    diagrams.ratio_axis(axes.xaxis, min(row.takes for row in rows), max(row.takes for row in rows))
    names = {level: name for name, level in LEVELS.items()} if choice == ANSWER else None
    diagrams.logarithmic(axes.yaxis, min(errors), max(errors), names)
    axes.set(**dict(zip(("xlabel", "ylabel"), AXES[choice], strict=True)))
    diagrams.place_labels(axes, labels)


def _level(error: float | None) -> float:
    return LEVELS[UNPROMISED] if error is None else error or LEVELS[FRACTIONS]
