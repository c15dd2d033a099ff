"""The public names, for who checks types; `__init__.py` imports each when it is first used."""

from graphplan import cycle, sheet
from graphplan.app import analytic
from graphplan.app.construction import MotionSeries, MotionStream, PoseSeries, WorkingDrawing, construct, follow
from graphplan.app.pages import handout
from graphplan.app.report import report
from graphplan.app.results import Results, solve
from graphplan.app.subjects import Subject
from graphplan.cams.subject import cam
from graphplan.check.stream import Summary
from graphplan.cycle.pose import at
from graphplan.errors import (
    ConstructionError,
    Disagreement,
    GraphplanError,
    NoMechanism,
    Refused,
    SceneError,
    SingularPose,
)
from graphplan.live_pages.scene_page import live
from graphplan.machines.errors.subject import position_errors
from graphplan.machines.subjects import balance, flywheel, motion
from graphplan.marking.classroom.class_variants import variants
from graphplan.marking.verifying import Findings, verify
from graphplan.mechanism.model import Scene
from graphplan.mechanism.written_scene import WrittenScene, load, parse, scene
from graphplan.methods.construction import Construction
from graphplan.synthesis.subject import SynthesisResults, synthesize

__version__: str

__all__ = [
    "Construction", "ConstructionError", "Disagreement", "Findings", "GraphplanError", "MotionSeries", "MotionStream",
    "NoMechanism", "PoseSeries", "Refused", "Results", "Scene", "SceneError", "SingularPose", "Subject", "Summary",
    "SynthesisResults", "WorkingDrawing", "WrittenScene",
    "analytic", "at", "balance", "cam", "construct", "cycle", "flywheel", "follow", "handout", "live", "load", "motion",
    "parse", "position_errors", "report", "scene", "sheet", "solve", "synthesize", "variants", "verify",
]
