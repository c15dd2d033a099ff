"""Follow the mechanism over a turn of its drive: every pose constructed, checked, tabulated and plotted.

The mechanism stays on the assembly branch of the given pose. Poses that are singular or cannot be reached are reported
on standard error and in the table, with travel and reason. The table is comma-separated text, an archive of arrays
(.npz), or JSON; it has the paths of points and the centrodes, too, which --paths draws with the mechanism alone. --plot
draws displacement, velocity and acceleration, with graphical differentiation and integration; or any column of the
table as a plain curve, polar diagrams of vectors, and families over a value of the scene. --animate shows the mechanism
with its construction in motion: over a full turn, or to and fro between limits.

examples:
  graphplan cycle four-bar --positions 12
  graphplan cycle jaanimets-10 --positions 360 -o forces.csv --plot rocker.svg --of 3
  graphplan cycle kinytskyi --positions 90 --plot loads.pdf --of "reaction C" --of balance --of efficiency
  graphplan cycle kinytskyi --positions 90 --plot bearing.svg --of "reaction O" --polar
  graphplan cycle kinytskyi --positions 90 --plot family.svg --of balance --vary moments.0.value=-10,-20,-40
  graphplan cycle plough-lift --positions 50 --from 0 --to 80 -o lift.npz
  graphplan cycle four-bar --animate four-bar.gif
  graphplan cycle four-bar --positions 90 --curves M --centrodes "2 frame" --paths curves.svg -o curves.json
  graphplan cycle plough-lift --animate lift.svg --positions 60
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from graphplan.app.choices import Messages, add_curves, add_settings, count, error, load_scene, on_paper
from graphplan.app.cycle_plot import Member, add_plot, check_plot, plot_file, plot_members
from graphplan.app.drafting import translate_title
from graphplan.app.files import STANDARD, kind, refuse_same_output, refuse_without_room, write
from graphplan.errors import Refused
from graphplan.mechanism.sections import NO_WORDS
from graphplan.mechanism.written_scene import MAX_TRAVEL
from graphplan.methods.design import Design

if TYPE_CHECKING:
    from graphplan.check.cycle import Cycle
    from graphplan.cycle.turn import Loop
    from graphplan.mechanism.model import Scene
    from graphplan.methods.construction import Construction
    from graphplan.output.animation import Film
    from graphplan.sheet.layout.composition import Composition
    from graphplan.sheet.plates.display import Sheet


BY_COLUMNS = (".npz", ".json")
ENDINGS, PATH_ENDINGS, PLOT_ENDINGS = (".csv", *BY_COLUMNS), (".svg",), (".svg", ".pdf", ".png")
NOTHING_REACHED = 3


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("--positions", type=count("--positions", 1), metavar="N",
        help=f"the number of poses ({DEFAULT_POSES} in an animation)")
    add_span(add)
    add("-o", "--output", metavar="FILE", help=".csv, .npz or .json; else comma-separated text on standard output")
    add_curves(command)
    add("--paths", metavar="FILE.svg", help="draw the mechanism with these paths and centrodes")
    add_plot(add)
    add_animation(add)
    add("--workers", default="1", metavar="N", help="processes that share the work, or a dask scheduler's address")
    add_settings(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.check.cycle import Cycle, cycle, cycle_blocks

    span = span_of(options)
    ending = kind(options.output, ENDINGS, "table")
    plot_ending = kind(options.plot, PLOT_ENDINGS, "plot", "--plot")
    kind(options.paths, PATH_ENDINGS, "drawing", "--paths")
    check_plot(options)
    check_animation(options)
    refuse_same_output(options.output, options.plot, options.animate, options.paths)
    if options.paths:
        write(_paths(options), options.paths)
    if options.animate:
        write(animation(options, span), options.animate)
    if (options.animate or options.paths) and not (options.output or options.plot):
        return 0
    members = plot_members(options, plot_ending) if options.plot else [Member("", translate_title(load_scene(options)))]
    scene = members[0].scene
    workers = int(options.workers) if options.workers.lstrip("-").isdigit() else options.workers
    messages = Messages(options.quiet)
    how: Any = {"wishes": Design(inertia=scene.sheet.inertia), "workers": workers,
                "progress": lambda what, done, of: messages.progress(f"{what}: {done} of {of}" if done < of else "")}
    if options.output not in (None, STANDARD) and not options.plot:
        return MotionReport(scene, options.positions).write_table(
            cycle_blocks(scene, options.positions, span, **how), options.output, ending, messages)
    cycles, reports = list[Cycle](), list[MotionReport]()
    for member in members:
        cycles.append(cycle(member.scene, options.positions, span, **how))
        reports.append(MotionReport(member.scene, options.positions))
        reports[-1].add(cycles[-1])
        if reports[-1].wrong:
            return reports[-1].tell_wrong()
    if options.output not in (None, STANDARD):
        parts = MotionReport(scene, options.positions).table_parts(iter(cycles), options.output, ending)
        write(parts, options.output)
    elif options.output or not options.plot:
        write(_csv(cycles[0]), options.output)
    if options.plot:
        write(plot_file(options, members, cycles, plot_ending), options.plot)
    return max(report.tell(messages, member.label) for member, report in zip(members, reports, strict=True))


def add_span(add: Callable[..., Any], whole: str = "one full turn") -> None:
    """The options of a range of the travel, instead of the `whole`."""
    add("--from", type=float, dest="start", metavar="A",
        help=f"a range of the first drive's travel from the given pose, in degrees or lengths; without it {whole}")
    add("--to", type=float, dest="end", metavar="B", help="the end of the range, which is a pose too")


def span_of(options: argparse.Namespace) -> tuple[float, float] | None:
    """The range of the travel that is asked for; fails with `Refused` where it is no range, or too far."""
    if (options.start is None) != (options.end is None):
        raise Refused("range", "only one of --from and --to is given", "both, or neither for a full turn")
    span = None if options.start is None else (options.start, options.end)
    if span and max(map(abs, span)) > MAX_TRAVEL:
        raise Refused(f"--from {span[0]:g} --to {span[1]:g}", "too far: every turn is followed",
                      f"at most {MAX_TRAVEL} degrees or lengths")
    return span


def _paths(options: argparse.Namespace) -> str:
    """The mechanism with its paths and centrodes as SVG text: a sheet without a construction."""
    from dataclasses import replace

    from graphplan.cycle.motion_curves import traced_motion
    from graphplan.design.decide import construct
    from graphplan.output.svg import svg
    from graphplan.sheet.layout.composition import compose
    from graphplan.sheet.layout.layout import layout
    from graphplan.words.tongue import tongue

    scene = translate_title(load_scene(options))
    if not (scene.sheet.curves or scene.sheet.centrodes):
        raise Refused("--paths", "no point or link is named", 'such as --curves M, or --centrodes "2 frame"')
    nothing = replace(scene.find, velocity=(), acceleration=(), links=(), slides=(), reactions=())
    drawing = construct(replace(scene, find=nothing, loads=None))
    composition = compose(drawing, tongue=tongue(scene.sheet.language), protocol="none", motion=traced_motion(scene))
    return svg(layout(composition))


def _csv(results: Cycle) -> str:
    """All poses as comma-separated text."""
    from graphplan.output.tables import text

    return text(results.scene, results.turn.travel, results.requested_points, results.results, results.faults,
                results.efficiency)


class WrongPoses(Exception):
    """Raised where poses are wrong, so that no table is written."""


class MotionReport:
    """Remarks on a motion's poses, block by block; equal ones in one line."""

    def __init__(self, scene: Scene, positions: int):
        from graphplan.output.tables import LargestLoads

        self.scene, self.positions, self.done, self.failures = scene, positions, 0, 0
        self.wrong, self.check = list[int](), dict[str, float]()
        self.faults, self.otherwise = list[NotedPoses](), list[NotedPoses]()
        self.largest, self.locked = LargestLoads(scene), list[int]()

    def add(self, block: Cycle) -> None:
        """Take in the next block."""
        self.wrong += [self.done + k for k in block.wrong]
        self.failures += len(block.faults)
        self.check = {kind: max(gap, self.check.get(kind, 0.0)) for kind, gap in block.check.items()}
        self.largest.add(block.turn.travel, block.results)
        if block.efficiency is not None:
            self.locked += [self.done + int(k) for k in (block.efficiency < 0).nonzero()[0]]
        _add_notes(self.faults, block.faults, self.done)
        _add_notes(self.otherwise, {k: f"drawn by {how}" for k, how in block.otherwise.items()}, self.done)
        self.done += len(block.turn.travel)

    def write_table(self, blocks: Iterator[Cycle], path: str, ending: str, messages: Messages) -> int:
        """Write a table of this kind in the memory of a block; the command's exit status."""
        try:
            write(self.table_parts(blocks, path, ending), path)
        except WrongPoses:
            return self.tell_wrong()
        return self.tell(messages)

    def table_parts(self, blocks: Iterator[Cycle], path: str, ending: str) -> Iterator[bytes]:
        """Yield a table in parts: rows of each block, or columns after the last one; the table ends at a wrong pose,
        with `WrongPoses` at the end.

        Fails with `Refused` if, by the first block, the disk has no room for all.
        """
        yield from self._column_parts(blocks, path, ending) if ending in BY_COLUMNS else self._csv_parts(blocks, path)
        if self.wrong:
            raise WrongPoses

    def _csv_parts(self, blocks: Iterator[Cycle], path: str) -> Iterator[bytes]:
        from graphplan.output.tables import csv_head, csv_rows, pose_columns

        for start, block in self._blocks_until_wrong(blocks):
            columns = [*pose_columns(block.scene, block.turn.travel, block.requested_points, block.results,
                                     block.efficiency)]
            rows = csv_rows(columns, {start + k: why for k, why in block.faults.items()}, start).encode()
            if not start:
                refuse_without_room(path, len(rows) * self.positions // self.done, "fewer --positions")
                yield csv_head(columns).encode()
            yield rows

    def _column_parts(self, blocks: Iterator[Cycle], path: str, ending: str) -> Iterator[bytes]:
        from graphplan.cycle.swings import motion_results
        from graphplan.output.tables import ArchiveTable, JsonTable

        table = (JsonTable if ending == ".json" else ArchiveTable)(self.scene, os.path.dirname(os.path.realpath(path)))
        with table.spool.file:
            for start, block in self._blocks_until_wrong(blocks):
                faults = {start + k: why for k, why in block.faults.items()}
                table.add(block.turn.travel, block.requested_points, block.results, faults, block.efficiency)
                if not start:  # there is a temporary file of the same size
                    refuse_without_room(path, 2 * table.spool.size * self.positions // self.done, "fewer --positions")
            if not self.wrong:
                yield from table.parts(motion_results(self.scene) | self.largest.data)

    def _blocks_until_wrong(self, blocks: Iterator[Cycle]) -> Iterator[tuple[int, Cycle]]:
        """Yield the blocks with their first poses, up to a wrong one."""
        for block in blocks:
            start = self.done
            self.add(block)
            if not self.wrong:
                yield start, block

    def tell_wrong(self) -> int:
        """Say which poses are wrong."""
        for k in self.wrong:
            error(f"pose {k}: the construction and the analytic solver disagree")
        return 1

    def tell(self, messages: Messages, label: str = "") -> int:
        """Say it on standard error, under the label of a member of a family; the command's exit status."""
        from graphplan.cycle.swings import motion_remarks

        if label:
            messages.remark(f"{label}:")
        say = error if self.failures == self.positions else messages.remark
        for first, last, note in (*self.faults, *self.otherwise):
            say(f"pose {first}: {note}" if first == last else f"poses {first} to {last} ({last - first + 1}): {note}")
        checked = ", ".join(f"{kind} {gap:.2g}" for kind, gap in self.check.items())
        for line in (*motion_remarks(self.scene), *self.largest.remarks()):
            messages.remark(line)
        if self.locked:
            messages.remark(f"the efficiency is negative in {len(self.locked)} of {self.positions} poses, such as pose "
                            f"{self.locked[0]}: there the loads drive, but do not overcome the friction, so that the "
                            "machine stands without its drive")
        messages.remark(f"{self.positions - self.failures} of {self.positions} poses; "
                        f"largest difference from the analytic solver: {checked}")
        return NOTHING_REACHED if self.failures == self.positions else 0


class NotedPoses(NamedTuple):
    """Neighbouring poses of which the same is to be said, by the note on the first."""

    first: int
    last: int
    note: str


def _add_notes(noted: list[NotedPoses], notes: Mapping[int, str], start: int) -> None:
    """Add the notes on a block's poses."""
    for place, note in notes.items():
        pose = start + place
        if noted and noted[-1].last == pose - 1 and _reason(noted[-1].note) == _reason(note):
            noted[-1] = noted[-1]._replace(last=pose)
        else:
            noted.append(NotedPoses(pose, pose, note))


def _reason(note: str) -> str:
    """A note without the pose's own angle."""
    return note.partition(": ")[2] if note.startswith("at ") else note


# --- animations ------------------------------------------------------------------------------------------------------


ANIMATION_ENDINGS = (".gif", ".svg")
DEFAULT_POSES, MAX_POSES = 48, 240
ROUND_SECONDS = 6  # until an animation begins again
ANIMATION_WIDTH = 900  # pixels


def add_animation(add: Callable[..., Any]) -> None:
    add("--animate", metavar="FILE.gif", help="the construction in motion: .gif, or an animated .svg")


def check_animation(options: argparse.Namespace) -> None:
    """Refuse what an animation cannot be, before any work is done."""
    kind(options.animate, ANIMATION_ENDINGS, "animation", "--animate")
    if options.positions is None and (options.output or options.plot or not (options.animate or options.paths)):
        raise Refused("--positions", "the number of poses is missing", "such as --positions 36")
    poses = options.positions or DEFAULT_POSES
    if options.animate and poses > MAX_POSES:
        raise Refused(f"--positions {poses}", "too many poses", f"at most {MAX_POSES}")


def animation(options: argparse.Namespace, span: tuple[float, float] | None = None) -> str | bytes:
    """The animation that is asked for."""
    from graphplan.cycle.turn import loop
    from graphplan.output.animation import gif, svg

    on_sheet, messages = on_paper(options, protocol=NO_WORDS), Messages(options.quiet)  # there is no time to read it
    motion = loop(on_sheet.drawing.scene, options.positions or DEFAULT_POSES, span)
    film = _film(on_sheet.drawing, on_sheet.composition, motion, messages)
    write_out = svg if kind(options.animate, ANIMATION_ENDINGS, "animation") == ".svg" else gif
    return write_out(film, ANIMATION_WIDTH)


def _film(drawing: Construction, composition: Composition, moved: Loop, messages: Messages) -> Film:
    """The sheets of a loop, in its order; the mechanism alone in poses that cannot be drawn, which is reported."""
    from graphplan.accuracy.reach import constructions
    from graphplan.check.stream import points_where_sound
    from graphplan.mechanism.travel import travel_unit
    from graphplan.output.animation import Film
    from graphplan.phrases import arrange, digits, unit
    from graphplan.sheet.cycle_frames import sheets
    from graphplan.sheet.layout.screen import compose_for_screen, with_poses

    turn = moved.turn
    reached = [k for k in range(len(turn.travel)) if k not in turn.faults]
    if not reached:
        raise Refused("--animate", "no pose of the range is reached", "another range")
    points, guides, loads = ({name: z[reached] for name, z in arrays.items()}
                             for arrays in (turn.points, turn.guides, turn.loads))
    constructions_by_pose = [(construction, points_where_sound(construction, points, guides, loads))
                             for construction in constructions(drawing)]
    composition = compose_for_screen(with_poses(composition.plans, [one for one, _ in constructions_by_pose],
                                                points, guides, loads))
    frames: dict[int, tuple[Sheet, bool]] = {}
    for k, frame in zip(reached, sheets(composition, constructions_by_pose, points, guides, loads), strict=True):
        frames[k] = frame
        messages.progress(f"drawn: {len(frames)} of {len(reached)}" if len(frames) < len(reached) else "")
    if bare := sum(not drawn for _, drawn in frames.values()):
        messages.remark(f"the mechanism alone, without a construction, in {bare} of {len(frames)} poses")
    poses, (each, name) = [k for k in moved.order if k in frames], travel_unit(drawing.scene)
    words = (arrange("{0}°" if name == "degrees" else "{0} {1}", digits(float(turn.travel[k]) / each), unit(name))
             for k in poses)
    return Film([frames[k][0] for k in poses], [composition.plans.tongue(caption) for caption in words], ROUND_SECONDS)
