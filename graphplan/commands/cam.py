"""Construct a cam from the law of its follower: base circle, profile by inversion, sheet, numbers, or scene.

TASK is a TOML file: `graphplan schema cam` prints its JSON Schema. The sheet shows the inversion step by step, the
law's diagrams and the curve x(s) behind whose tangents the cam's centre lies. A DXF has the profile in true size,
closed, of arcs within the tolerance; JSON has all numbers over the turn; a .toml is the cam in one pose as a scene with
its contact, for solve, draw and cycle. What cannot be made (a roller that undercuts, a hollow under a flat face, a
profile that crosses itself, pressure angles beyond those allowed) is refused with the reason and the angle.

examples:
  graphplan cam valve.toml -o valve.svg
  graphplan cam valve.toml -o valve.dxf --tolerance 0.001
  graphplan cam valve.toml -o valve.json --positions 720
  graphplan cam valve.toml -o pose.toml --at 75 && graphplan solve pose.toml

a task:
  title = "Cam with a roller follower"
  [[law]]
  angle = 120              # degrees of the cam
  motion = "harmonic"      # dwell uniform parabolic harmonic sine trapezoid 3-4-5
  stroke = 25
  [[law]]
  angle = 60
  motion = "dwell"
  [[law]]                  # or in the place of motion and stroke, from the beginning of the stage:
  table = [[0, 0], [45, -12.5], [90, -25]]
  [[law]]
  angle = 90
  motion = "dwell"
  [follower]
  moves = "translating"    # or oscillating: arm, centre_distance; strokes are degrees then
  contact = "roller"       # point, roller or flat
  radius = 8
  offset = 6
  [cam]
  turns = "clockwise"
  rpm = 300                # or omega, rad/s
  base = "pressure angle"  # a radius, or of a flat face "convex"
  pressure_angle = { rise = 30, return = 30 }
"""

from __future__ import annotations

import argparse
import os
from dataclasses import replace
from typing import TYPE_CHECKING

from graphplan.commands.choices import add_language, add_paper, add_steps, count, refuse_steps, with_steps
from graphplan.commands.output import DOTS, STANDARD, Messages, as_json, kind, write, write_sheets
from graphplan.errors import Refused
from graphplan.mechanism.sections import FRAMES
from graphplan.output import loaded

if TYPE_CHECKING:
    from graphplan.cams.construction import CamDrawing

DRAWN = ("svg", "pdf", "png", "tex")  # the sheet
ENDINGS = (".svg", ".pdf", ".png", ".tex", ".dxf", ".json", ".toml")
POSITIONS, TOLERANCE = 360, 0.001


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("task", metavar="TASK", help="a task file, or - for standard input")
    add("-o", "--output", metavar="SHEET.svg", help="the file to write: .svg, .pdf, .png or .tex, the sheet; .dxf, the "
        "profile; .json, the numbers; .toml, a scene; without it SVG on standard output")
    add("--dpi", type=count("--dpi", 20, 600), metavar="N", help=f"dots per inch of a .png ({DOTS})")
    add_paper(command, "the sheet; without it the task's, or the smallest that will do")
    add("--frame", choices=FRAMES, help="frame and title block; without it the task's, or iso")
    add("--at", type=float, metavar="DEGREES", help="the pose of the scene (0)")
    add("--positions", type=count("--positions", 1), metavar="N", help=f"of the table in JSON ({POSITIONS})")
    add("--tolerance", type=float, metavar="LENGTH",
        help=f"how far arcs may be off the profile, in the task's lengths ({TOLERANCE})")
    add_language(command)
    add_steps(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.cams.construction import drawn
    from graphplan.cams.profile import made
    from graphplan.cams.task import load
    from graphplan.check.cams import check_cam

    ending = kind(options.output, ENDINGS, "cam").removeprefix(".")
    _asked(options, ending)
    refuse_steps(options, f".{ending}")
    messages, task = Messages(options.quiet), load(options.task)
    said = {key: value for key in ("paper", "frame", "language") if (value := getattr(options, key))}
    task = replace(task, sheet=replace(task.sheet, **said))
    messages.progress("base circle and profile")
    cam = made(task)
    messages.progress("inversion")
    drawing = drawn(cam)
    check = check_cam(drawing)
    messages.progress("")
    for note in cam.notes:
        messages.remark(f"{task.name}: {note}")
    tolerance = TOLERANCE if options.tolerance is None else options.tolerance
    if ending in DRAWN:
        from graphplan.output.subjects.cam_sheet import sheets

        write_sheets(sheets(drawing, check, task.sheet.paper or None), options.output, ending, options.dpi)
    else:
        write(_data(drawing, ending, options, tolerance, check), options.output)
    return 0


def _asked(options: argparse.Namespace, ending: str) -> None:
    """Refuse options of another kind of output, and numbers that are none."""
    only = {"dpi": ("png",), "paper": DRAWN, "frame": DRAWN, "at": ("toml",),
            "positions": ("json",), "tolerance": ("json", "dxf")}
    for name, endings in only.items():
        if getattr(options, name) is not None and ending not in endings:
            raise Refused(f"--{name} {getattr(options, name)}", f"it does not apply to a .{ending}",
                          f"leave it out, or -o FILE.{endings[0]}")
    if options.output not in (None, STANDARD) and os.path.realpath(options.output) == os.path.realpath(options.task):
        raise Refused(f"-o {options.output}", "the task file would be overwritten", "another name")
    if options.tolerance is not None and not 1e-9 <= options.tolerance < float("inf"):
        raise Refused("--tolerance", f"{options.tolerance:g}", "give a length above 0, 1e-9 at least")
    if options.at is not None and not abs(options.at) < float("inf"):
        raise Refused("--at", f"{options.at:g}", "give an angle in degrees")


def _data(drawing: CamDrawing, ending: str, options: argparse.Namespace, tolerance: float,
          check: dict[str, float]) -> str | bytes:
    """What is no sheet: the profile for CAD, the numbers, or a scene."""
    if ending == "toml":
        from graphplan.cams.exports import scene_text

        return scene_text(drawing.cam, options.at or 0.0)
    if ending == "json":
        from graphplan.cams.exports import numbers
        from graphplan.output.panelled import PAPERS
        from graphplan.output.subjects.cam_sheet import CamSheet

        data = numbers(drawing, options.positions or POSITIONS, tolerance, check)
        paper = drawing.cam.task.sheet.paper or PAPERS[0]
        return as_json(with_steps(options, data, lambda: CamSheet(paper, drawing, check)))
    written: str | bytes = loaded("dxf", "cad.profile").profile_dxf(drawing.cam, tolerance)
    return written
