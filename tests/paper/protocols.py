"""Protocols of scenes as data: through the command line, or quickly, each plan in a room of a usual size."""

from __future__ import annotations

import io
import json
import sys
from collections.abc import Iterator
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch

import graphplan as gp
from graphplan.commands import main
from graphplan.mechanism.model import Scene
from graphplan.output.text import steps
from graphplan.sheet.layout.composition import USUAL_PANEL
from graphplan.sheet.layout.paper import room
from graphplan.sheet.layout.plan_scales import given_scales, windows
from graphplan.sheet.plates.display import Rect
from graphplan.sheet.plates.plans import Plans
from graphplan.sheet.plates.plate import Plates

PAPER = "A3"  # on which rooms of a usual size have place


def protocol(scene: Scene, **how: Any) -> dict[str, Any]:
    """The protocol of a scene, drawn in one of the ways of `gp.construct`, as `steps --json` has it but for the layout:
    plans lie over each other, each in a room of its own."""
    plans = Plans(gp.construct(scene, **how))
    rooms = {panel: room(Rect(0.0, 0.0, *USUAL_PANEL)) for panel in plans.panels}
    scales, views = windows(rooms, plans, given_scales(plans))
    composition: Any = SimpleNamespace(plans=plans, scales=scales, plates=Plates(plans, views),
                                       arrangement=SimpleNamespace(height=USUAL_PANEL[1]))
    return {**steps(composition), "pencil": {"paper": PAPER}}


def printed(scene: str, *options: str, text: str = "") -> dict[str, Any] | None:
    """What `steps --json` prints; nothing where it refuses, or the pose is singular."""
    out = io.StringIO()
    with redirect_stdout(out), redirect_stderr(io.StringIO()), patch("sys.stdin", io.StringIO(text)):
        status = main(["steps", scene, "--json", "-q", *options])
    told: dict[str, Any] | None = json.loads(out.getvalue()) if status == 0 else None
    return told


def random_scenes(seed: int) -> Iterator[Scene]:
    """The scenes of one seed: a linkage, one with gears and contacts, and both under load where it can be held."""
    sys.path.append(str(Path(__file__).parents[1] / "random"))
    from gearings import gearing
    from linkages import linkage, scenes
    from loads import loaded_scenes

    for made in (linkage, gearing):
        yield next(scenes(seed, 1, made))
        yield from loaded_scenes(seed, 1, made)
