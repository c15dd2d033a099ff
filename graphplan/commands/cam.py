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
from typing import TYPE_CHECKING

from graphplan.commands.choices import add_diagrams, add_language, count, with_presentation
from graphplan.commands.output import STANDARD, Messages
from graphplan.commands.subjects import JSON, PNG, SCENE, Subject, add_steps, run_subject
from graphplan.errors import Refused
from graphplan.output import load_writer

if TYPE_CHECKING:
    from graphplan.output.subjects.cam_sheet import CamSheet

DRAWN = (".svg", ".pdf", ".png", ".tex")  # the sheet
ENDINGS = (".svg", ".pdf", ".png", ".tex", ".dxf", ".json", ".toml")
POSITIONS, TOLERANCE = 360, 0.001


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("task", metavar="TASK", help="a task file, or - for standard input")
    add("-o", "--output", metavar="SHEET.svg", help="the file to write: .svg, .pdf, .png or .tex, the sheet; .dxf, the "
        "profile; .json, the numbers; .toml, a scene; without it SVG on standard output")
    add_diagrams(command, "task")
    add("--at", type=float, metavar="DEGREES", help="the pose of the scene (0)")
    add("--positions", type=count("--positions", 1), metavar="N", help=f"of the table in JSON ({POSITIONS})")
    add("--tolerance", type=float, metavar="LENGTH",
        help=f"how far arcs may be off the profile, in the task's lengths ({TOLERANCE})")
    add_language(command)
    add_steps(command)


def run(options: argparse.Namespace) -> int:
    return run_subject(options, "cam", ENDINGS, construct_cam, dpi=PNG, paper=DRAWN, frame=DRAWN, at=SCENE,
                       positions=JSON, tolerance=(*JSON, ".dxf"))


def construct_cam(options: argparse.Namespace, ending: str, messages: Messages) -> Subject:
    """The cam of the task that is named."""
    from graphplan.cams.construction import draw_cam
    from graphplan.cams.exports import numbers, scene_text
    from graphplan.cams.profile import make_cam
    from graphplan.cams.task import load
    from graphplan.check.cams import check_cam

    _check_options(options)
    task = with_presentation(options, load(options.task))
    messages.progress("base circle and profile")
    cam = make_cam(task)
    messages.progress("inversion")
    drawing = draw_cam(cam)
    check = check_cam(drawing)
    tolerance = TOLERANCE if options.tolerance is None else options.tolerance

    def sheet(paper: str) -> CamSheet:
        from graphplan.output.subjects.cam_sheet import CamSheet

        return CamSheet(paper, drawing, check)

    return Subject(sheet, lambda: numbers(drawing, options.positions or POSITIONS, tolerance, check), task.sheet.paper,
                   files={".toml": lambda: scene_text(cam, options.at or 0.0),
                          ".dxf": lambda: load_writer("dxf", "cad.profile").profile_dxf(cam, tolerance)},
                   remarks=[f"{task.name}: {note}" for note in cam.notes], rows=False)


def _check_options(options: argparse.Namespace) -> None:
    """Refuse to write over the task, and numbers out of range."""
    if options.output not in (None, STANDARD) and os.path.realpath(options.output) == os.path.realpath(options.task):
        raise Refused(f"-o {options.output}", "the task file would be overwritten", "another name")
    if options.tolerance is not None and not 1e-9 <= options.tolerance < float("inf"):
        raise Refused("--tolerance", f"{options.tolerance:g}", "give a length above 0, 1e-9 at least")
    if options.at is not None and not abs(options.at) < float("inf"):
        raise Refused("--at", f"{options.at:g}", "give an angle in degrees")
