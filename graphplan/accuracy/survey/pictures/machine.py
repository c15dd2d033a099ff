"""The machine's board as a picture: time for a pose against error, some scenes alone, and the median of all."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from graphplan.accuracy.survey.machine import ARITHMETICS, EXACT_SOLVER, LAPACK, SOLVER, Measure
from graphplan.accuracy.survey.picture import Axis, Chart, Look, Place, Series, SubChart, grouped
from graphplan.accuracy.survey.timing import spread
from graphplan.sheet.plates.pens import BLUE, GREEN, GREY, INK, RED

SHOWN = ("alt-eight-link", "class-four", "shaper")  # by themselves, where they are among the scenes
PROVEN = 1e-20  # errors below this are those of enclosures
MARKERS = dict(zip((*ARITHMETICS, SOLVER, LAPACK, EXACT_SOLVER), (
    "circle", "square", "up", "diamond", "star", "plus", "cross", "down", "left", "right"), strict=True))
COLOURS = {"": GREY, "pose's own": INK, "every method": INK, "auxiliary": BLUE, "trial": RED, "poles": GREEN}
TIME = Axis("time for a pose, in poses solved by LAPACK in batches")
ERROR = Axis("largest error, relative", before=(("exact", "exact"), ("proven", "proven")))
REMARKS = (
    "Each mark is one form in one arithmetic; the solver's are grey. Times are medians within one run, in the "
    "time that LAPACK takes for a pose of the same scene in batches. Errors are the largest of any velocity or "
    "acceleration in five poses, beside the largest of its kind, against fractions. The last picture has the "
    "medians over all scenes, with the quartiles, of the form that the pose chooses."
)


def picture(rows: Sequence[Measure]) -> Chart:
    """The chart of these measures."""
    scenes = grouped(rows, "scene")
    shown = [scene for scene in scenes if scene in SHOWN] or list(scenes)[:1]
    panels = [SubChart(scene, TIME, ERROR, tuple(_alone(scenes[scene]))) for scene in shown]
    if len(scenes) > 1:
        panels.append(SubChart(f"median of {len(scenes)} scenes", TIME, ERROR, tuple(_median(rows))))
    return Chart("The machine: time against error", REMARKS, tuple(panels), 2,
                 (140.0, 85.0), tuple(_key()))


def _alone(rows: Iterable[Measure]) -> Iterable[Series]:
    """Each measure of a scene as a mark."""
    for row in rows:
        if row.time is not None and row.error is not None:
            yield Series(look(row), ((row.time, _level(row.error)),))


def _median(rows: Sequence[Measure]) -> Iterable[Series]:
    """Each arithmetic by its median over the scenes, with the quartiles."""
    groups: dict[tuple[str, str], list[Measure]] = {}
    for row in rows:
        if row.time is not None and row.form.split(", ")[0] in ("", "pose's own", "every method"):
            groups.setdefault((row.plan, row.arithmetic), []).append(row)
    scenes = {row.scene for row in rows}
    for group in groups.values():
        if 2 * len(group) <= len(scenes):  # what was measured of few scenes is no median of all
            continue
        left, x, right = spread([row.time for row in group if row.time is not None])
        low, y, high = spread([row.error for row in group if row.error is not None])
        corners = (left, _level(low)), (right, _level(high))
        yield Series(look(group[0]), ((x, _level(y)),), (corners,))


def _level(error: float) -> Place:
    return "exact" if error == 0 else "proven" if error < PROVEN else error


def look(row: Measure) -> Look:
    """A measure's look: its arithmetic by the marker, its method by the colour, polar plans hollow."""
    return Look(COLOURS[row.form.split(", ")[0]], MARKERS[row.arithmetic], hollow=row.plan == "polar", size=2.2)


def _key() -> Iterable[tuple[str, Look]]:
    yield from ((name, Look(GREY if name.startswith("solver") else INK, marker, size=2.2))
                for name, marker in MARKERS.items())
    yield "form of the pose or of every method", Look(INK, area=True)
    yield from ((name, Look(COLOURS[name], area=True)) for name in ("auxiliary", "trial", "poles"))
    yield "hollow: polar plans", Look(INK, "circle", hollow=True, size=2.2)
