"""Write a report on a machine over its cycle: problem and answer, construction sheet, diagrams, and tables, as PDF.

The first page is a plate: the mechanism in its positions, what is given, strokes, time ratios, and the largest of each
quantity with its place and its root mean square. The construction sheet of the given pose follows with its words, then
diagrams of all that the scene asks for over the travel of the drive, the polar diagram of the bearing that bears most,
and a table of positions. Each pose is compared with the analytic solver.

examples:
  graphplan report quick-return -o report.pdf
  graphplan report kinytskyi --positions 12 --language de -o bericht.pdf
  graphplan report plough-lift --from 0 --to 80 -o lift.pdf
  graphplan report scene.toml --set drive.0.rpm=90 --set sheet.plan=polar -o report.pdf
"""

from __future__ import annotations

import argparse
import math
import os
from typing import TYPE_CHECKING, Unpack

from graphplan.app import drafting, files
from graphplan.app.choices import add_language, add_settings, count, load_scene
from graphplan.app.cycle import add_span, span_of
from graphplan.app.drafting import Keywords, with_sheet
from graphplan.errors import BrokenClaim, Refused
from graphplan.mechanism.model import Scene
from graphplan.output import back_end

if TYPE_CHECKING:
    from graphplan.check.cycle import Cycle

DEFAULT_POSITIONS, LEAST, MOST = 24, 2, 48  # of the table
POSES = 120  # that diagrams have at least


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="FILE", required=True, help="the .pdf to write")
    command.add_argument("--positions", type=count("--positions", LEAST, MOST), default=DEFAULT_POSITIONS, metavar="N",
                         help=f"how many positions the table has ({DEFAULT_POSITIONS}); extremes and diagrams have "
                         "further poses between")
    add_span(command.add_argument, "one full turn, or the way between limits")
    add_language(command)
    add_settings(command)


def run(options: argparse.Namespace) -> int:
    save_report(load_scene(options), options.output, options.positions, span_of(options))
    return 0


def report(scene: Scene, path: str | os.PathLike[str], *, n: int = DEFAULT_POSITIONS,
           span: tuple[float, float] | None = None, **options: Unpack[Keywords]) -> None:
    """Write the report on a machine over its cycle as a .pdf, as `graphplan report` does; its table has
    `n` positions over a turn, or over a `span` of the travel as `follow` has it.

    Further keywords say how it is drawn and what the sheet looks like, as for `construct` and `drawing.save`. Fails as
    they do, and as `follow` does.
    """
    save_report(with_sheet(scene, options), os.fspath(path), n, span)


def save_report(scene: Scene, path: str, positions: int, span: tuple[float, float] | None = None) -> None:
    """Write a report, drawn as [sheet] has it."""
    from dataclasses import replace

    from graphplan.output.report import CycleReport
    from graphplan.sheet.layout.layout import pages

    files.kind(path, (".pdf",), "report")
    whole = drafting.drawable(scene)
    drafted = drafting.on_paper(scene, whole)
    between = math.ceil(POSES / positions)
    cycle = followed_cycle(drafting.translate_title(scene), positions, between, span)
    composition = drafted.composition
    sheets = CycleReport(cycle, drafted.drawing, between).pages(
        lambda earlier, further: pages(replace(composition, earlier=earlier, further=further)),
        composition.page_count)
    text = drafting.as_drawn(whole.scene, drafted)
    files.write(back_end("pdf")([replace(sheet, scene=text) for sheet in sheets]), path)


def followed_cycle(scene: Scene, positions: int, between: int, span: tuple[float, float] | None) -> Cycle:
    """The cycle in so many positions with poses between: over a span, round a turn, or from limit to limit; both ends
    of what is no turn are positions.

    Fails with `Refused` where the mechanism does not move, and with `BrokenClaim` where a pose is wrong.
    """
    from graphplan.check.cycle import cycle
    from graphplan.cycle.turn import reachable_span, whole_motion
    from graphplan.mechanism.travel import travel_unit

    if span is None and not (motion := whole_motion(scene)).goes_round:
        unit = travel_unit(scene)[0]
        low, high = reachable_span(motion)
        span = float(low / unit), float(high / unit)
    poses = positions * between if span is None else (positions - 1) * between + 1
    result = cycle(scene, poses, span, drafting.wishes_of(scene)[0])
    for pose in result.wrong:
        raise BrokenClaim(scene.name, f"pose {pose}: the construction and the analytic solver disagree")
    if len(result.faults) == poses:
        raise Refused(f"{scene.name}: the cycle", next(iter(result.faults.values())), "another scene")
    return result
