"""The live page of a scene: which constructions it offers, on plans with room for all poses of the travel."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Unpack

from graphplan.app import drafting, files
from graphplan.app.drafting import Keywords, with_sheet
from graphplan.errors import ConstructionError, Refused
from graphplan.live_pages.page import PageVariant, on_one_sheet
from graphplan.live_pages.page import live as page
from graphplan.mechanism.model import Presentation, Scene
from graphplan.mechanism.sections import METHODS, MOTION_PLANS
from graphplan.methods.panels import MECHANISM
from graphplan.words import LANGUAGES

if TYPE_CHECKING:
    from graphplan.app.subjects import FoundMechanism
    from graphplan.cycle.turn import Turn
    from graphplan.methods.construction import Construction
    from graphplan.sheet.plates.plans import Plans

MAX_ALTERNATIVES = 2  # further constructions for a plan or method that is not the page's own: each takes its time
MAX_OFFERED = 2  # constructions for the poses of a page: their words in all languages are small, and quickly told
SCREENS_MM = (("A4", 250.0, 180.0), ("A4", 310.0, 223.0), ("A3", 380.0, 274.0))
"""The plans' part of a window of 1280 by 800 pixels, and the paper whose letters they have: the first on which they can
be read."""
TRAVEL_POSES = 144  # in which the plans are looked at for the room that they need
PLANS = "polar", "orthogonal"


def live(scene: Scene | FoundMechanism, path: str | os.PathLike[str], *, choices: Collection[str] | str | None = None,
         **options: Unpack[Keywords]) -> None:
    """Write the live page of a scene, as `graphplan live -o` does: one .html without a network, on which the mechanism
    is dragged and the construction follows.

    `choices` says what may be chosen on it: "plans", "methods", "languages" or some languages by their codes, or
    "none". Further keywords say how it is drawn and what the sheet looks like. Of what `synthesize` finds it is the
    page of the task, on which given positions are dragged. Fails as `construct` does.
    """
    files.kind(os.fspath(path), files.LIVE_ENDINGS, "live page")
    files.write(live_page(with_sheet(scene, options), drafting.choices_of(choices)), os.fspath(path))


def live_page(scene: Scene | FoundMechanism, offered: Collection[str] | None = None, *, shared: str = "") -> str:
    """The page of a scene; with a `shared` script it leaves that out."""
    if not isinstance(scene, Scene):
        return scene.live_page(offered)
    variants = [*_variants(scene, offered)]
    few = len(variants[0].compositions) <= MAX_OFFERED
    languages = drafting.languages_of(scene.sheet.language, offered, LANGUAGES if few else ("en",))
    return page(variants, languages, scene.title, shared=shared)


def _variants(scene: Scene, offered: Collection[str] | None) -> Iterator[PageVariant]:
    """The ways to draw the scene that may be chosen: first as its sheet has it, then by other plans and methods,
    those that can be drawn, each once."""
    from graphplan.accuracy.reach import MAX_CONSTRUCTIONS, constructions, reachable_poses
    from graphplan.sheet.layout.screen import compose_for_screen

    earlier, poses, turn, own_plan = list[list[str]](), None, None, None  # all move alike: poses are looked for once
    for plan, method in _plans_and_methods(scene.sheet, offered):
        first = not earlier
        if method == scene.sheet.method and plan.split(",")[0] == own_plan:
            continue  # by these plans it is drawn already
        try:
            report = drafting.drawable(replace(scene, sheet=replace(scene.sheet, plan=plan, method=method)))
            drawing = replace(report.drawing, scene=report.given_scene)
        except (Refused, ConstructionError):
            if first:
                raise
            continue
        if (steps := drawing.sentences()) in earlier:
            continue
        if first:
            poses, turn, own_plan = reachable_poses(drawing), turn_over_travel(drawing.scene), drawing.plan
        earlier.append(steps)
        with suppress(*(() if first else (Refused,))):
            _, *alternatives = constructions(drawing, MAX_CONSTRUCTIONS if first else 1 + MAX_ALTERNATIVES, poses)
            composition = compose_for_screen(plans_over_travel(drawing, alternatives, turn), SCREENS_MM)
            yield PageVariant(drawing.plan, method, on_one_sheet(composition, alternatives), report.missing)


def turn_over_travel(scene: Scene) -> Turn | None:
    """The poses of the drive's travel; None for a mechanism that cannot be moved."""
    from graphplan.cycle.turn import loop

    try:
        return loop(scene, TRAVEL_POSES).turn
    except Refused:
        return None


def plans_over_travel(drawing: Construction, alternatives: Sequence[Construction], turn: Turn | None) -> Plans:
    """The plans, that of the mechanism with room for all poses of a turn: the others have a scale in each pose. Pages
    tell each movement."""
    from graphplan.sheet.layout.screen import with_poses
    from graphplan.sheet.plates.plans import Plans
    from graphplan.words.tongue import tongue

    plans = Plans(drawing, tongue(drawing.scene.sheet.language or "en"), unfolded=True)
    if turn is None:
        return plans
    swept = with_poses(plans, [drawing, *alternatives], turn.points, turn.guides, turn.loads).swept
    return replace(plans, swept={MECHANISM: swept[MECHANISM]} if MECHANISM in swept else {})


def _plans_and_methods(sheet: Presentation, offered: Collection[str] | None) -> Iterator[tuple[str, str]]:
    """Pairs of plan and method: first as the sheet has them, then the alternatives that are wanted."""
    plan, method, wanted = sheet.plan, sheet.method, offered or ("plans",) * (offered is None)
    forces = ",".join(word for word in plan.split(",") if word not in MOTION_PLANS)
    plans = [plan, *(",".join(filter(None, (motion_plan, forces)))
                     for motion_plan in PLANS)] if "plans" in wanted else [plan]
    methods = [method, *METHODS] if "methods" in wanted else [method]
    yield from dict.fromkeys((plan, method) for plan in plans for method in methods)
