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
  [[law]]                  # or instead of motion and stroke, from the beginning of the stage:
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

from graphplan.app.choices import JSON, SCENE, Messages, add_subject, count, read_task, run_subject
from graphplan.app.subjects import Subject
from graphplan.cams.subject import CAM_ENDINGS, POSITIONS, TOLERANCE, find_cam

DRAWN = (".svg", ".pdf", ".png", ".tex")  # the sheet


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("task", metavar="TASK", help="a task file, or - for standard input")
    add("-o", "--output", metavar="FILE", help="the file to write: .svg, .pdf, .png or .tex, the sheet; .dxf, the "
        "profile; .json, the numbers; .toml, a scene; without it SVG on standard output")
    add("--at", type=float, metavar="TRAVEL", help="the pose of the scene, in degrees of the cam (0)")
    add("--positions", type=count("--positions", 1), metavar="N", help=f"positions of the table in JSON ({POSITIONS})")
    add("--tolerance", type=float, metavar="LENGTH",
        help=f"largest error of the profile's arcs, in the task's lengths ({TOLERANCE})")
    add_subject(command)


def run(options: argparse.Namespace) -> int:
    return run_subject(options, "cam", CAM_ENDINGS, _cam, paper=DRAWN, at=SCENE, positions=JSON,
                       tolerance=(*JSON, ".dxf"))


def _cam(options: argparse.Namespace, ending: str, messages: Messages) -> Subject:
    """The cam of the task that is named."""
    from graphplan.cams.task import load, parse

    task = read_task(options, load, parse)
    messages.progress("base circle and profile")
    return find_cam(task, options.at, options.positions, options.tolerance)
