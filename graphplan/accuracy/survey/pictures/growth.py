"""Growth as a picture: the time of each stage and the number of steps against the number of links."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from graphplan.accuracy.survey.growth import LONG, STAGES, Stage, exponent
from graphplan.accuracy.survey.picture import Axis, Chart, Look, Series, SubChart
from graphplan.sheet.plates.pens import BLUE, BROWN, GREEN, INK, RED

LOOKS = {stage: Look(colour, marker, size=1.8, width=0.25, dash=dash) for stage, (colour, marker, dash) in zip(STAGES, (
    (INK, "circle", ()), (BLUE, "square", (2.4, 0.8)), (RED, "up", (0.6, 0.8)),
    (GREEN, "diamond", (2.4, 0.6, 0.4, 0.6)), (BROWN, "down", (3.2, 1.2))), strict=True)}
STEPS = Look(INK, "circle", hollow=True, size=1.8, width=0.25)
LINKS = Axis("links")
REMARKS = (
    "A crank and a chain of dyads. Times are medians within one run, in the time that the analytic solver takes "
    "for one pose of the four-link chain, with the quartiles; a first replay writes the replay down. The "
    f"exponents are those of powers fitted from {LONG} links."
)


def picture(rows: Sequence[Stage]) -> Chart:
    """The chart of these stages."""
    times = SubChart("time", LINKS, Axis("time, in single poses of four links solved"), tuple(
        _times(look, [row for row in rows if row.stage == stage]) for stage, look in LOOKS.items()))
    counts = sorted({(row.links, row.steps) for row in rows})
    steps = SubChart("size of the program", LINKS, Axis("steps"), (Series(STEPS, tuple(counts)),))
    return Chart("Growth with the number of links", REMARKS, (times, steps), 2, (120.0, 90.0),
                 (*((_told(rows, stage), look) for stage, look in LOOKS.items()), (_steps(counts), STEPS)))


def _times(look: Look, rows: Sequence[Stage]) -> Series:
    return Series(look, tuple((row.links, row.time) for row in rows),
                  tuple(((row.links, row.low), (row.links, row.high)) for row in rows))


def _told(rows: Sequence[Stage], stage: str) -> str:
    """A stage with its exponent, where there are chains enough for one."""
    if len({row.links for row in rows if row.links >= LONG}) < 2:
        return stage
    return f"{stage}: n^{exponent(rows, stage):.2f}"


def _steps(counts: Sequence[tuple[int, int]]) -> str:
    """The steps as a straight line over the links."""
    if len(counts) < 2:
        return "steps"
    links, steps = zip(*counts, strict=True)
    slope, rest = np.polyfit(links, steps, 1)
    return f"steps: {slope:.4g} n {'+' if rest > 0 else '−'} {abs(rest):.4g}"
