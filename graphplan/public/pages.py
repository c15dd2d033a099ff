"""Pages to print and pages that move: handouts of a scene, and its live page."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Unpack

from graphplan.errors import ConstructionError, Refused
from graphplan.mechanism.sections import METHODS
from graphplan.output import back_end
from graphplan.public.drafting import make_report, on_paper, on_sheet, with_rounds
from graphplan.public.files import kind, write
from graphplan.public.options import Keywords, Options, options_of
from graphplan.words import LANGUAGES

if TYPE_CHECKING:
    from graphplan.mechanism.model import Scene
    from graphplan.methods.construction import Construction
    from graphplan.output.live.page import PageVariant
    from graphplan.sheet.layout.composition import Composition
    from graphplan.sheet.plates.display import Sheet
    from graphplan.sheet.plates.plans import Plans

PARTS = "task", "guided", "solution"
HANDOUT_ENDINGS, LIVE_ENDINGS = (".pdf", ".html"), (".html",)
CHOICES = "plans", "methods", "languages"
MAX_ALTERNATIVES = 2  # further constructions for a plan or method that is not the page's own: each takes its time
MAX_OFFERED = 2  # constructions for the poses of a page: their words in all languages are small, and quickly told
TRAVEL_POSES = 144  # in which the plans are looked at for the room that they need
PLANS = "polar", "orthogonal"


# ---- handouts --------------------------------------------------------------------------------------------------------


def handout(scene: Scene, path: str | os.PathLike[str], *, only: str | None = None,
            choices: Collection[str] | str | None = None, **options: Unpack[Keywords]) -> None:
    """Write a handout, as `graphplan handout` does: a .pdf with the task, its guided version and the solution in true
    size, or `only` one of them; or a .html, the live page with the steps in front.

    Further keywords say how it is drawn and what the sheet looks like, as for `construct` and `drawing.save`.
    Fails as they do.
    """
    save_handout(scene, os.fspath(path), options_of(options), only, choices_of(choices))


def save_handout(scene: Scene, path: str, options: Options, only: str | None = None,
                 offered: Collection[str] | None = None) -> None:
    """The same with options in one record."""
    suffix = kind(path, HANDOUT_ENDINGS, "handout")
    if only is not None and only not in PARTS:
        raise Refused(f"--only {only}", "a handout has no such part", f"one of {', '.join(PARTS)}")
    if suffix == ".html":
        if only:
            raise Refused(f"--only {only}", "a page for a browser has no parts", "leave it out, or -o FILE.pdf")
        if scene.assembly is not None:
            raise Refused("--at", "a page for a browser moves to any pose", "leave it out, or -o FILE.pdf")
        write(live_page(scene, options, offered, steps_first=True), path)
    else:
        write(back_end("pdf")(_pages(on_paper(scene, options).composition, only)), path)


def _pages(composition: Composition, only: str | None) -> list[Sheet]:
    """The pages of the parts that are wanted."""
    from graphplan.sheet.handout import guided_task, solution, task

    pages = {"task": task, "guided": guided_task, "solution": solution}
    return [sheet for part in PARTS if only in (None, part) for sheet in pages[part](composition)]


# ---- live pages ------------------------------------------------------------------------------------------------------


def live(scene: Scene, path: str | os.PathLike[str], *, choices: Collection[str] | str | None = None,
         **options: Unpack[Keywords]) -> None:
    """Write the live page of a scene, as `graphplan live -o` does: one .html without a network, on which the mechanism
    is dragged and the construction follows.

    `choices` says what may be chosen on it: "plans", "methods", "languages" or some languages by their codes, or
    "none". Further keywords say how it is drawn and what the sheet looks like. Fails as `construct` does.
    """
    kind(os.fspath(path), LIVE_ENDINGS, "live page")
    write(live_page(scene, options_of(options), choices_of(choices)), os.fspath(path))


def choices_of(choices: Collection[str] | str | None) -> frozenset[str] | None:
    """What may be chosen on a page; None where nothing is said of it."""
    if choices is None:
        return None
    names = [] if choices == "none" else choices.split(",") if isinstance(choices, str) else [*choices]
    if unknown := [choice for choice in names if choice not in (*CHOICES, *LANGUAGES)]:
        raise Refused("--choices", f"{unknown[0]} cannot be chosen",
                      f"some of {', '.join((*CHOICES, *LANGUAGES))}, or none")
    return frozenset(names) | (frozenset(LANGUAGES) if "languages" in names else frozenset())


def live_page(scene: Scene, options: Options, offered: Collection[str] | None = None, *, steps_first: bool = False,
              shared: str = "") -> str:
    """The page of a scene; `steps_first` it is opened at the first step; with a `shared` script it leaves that out."""
    from graphplan.output.live.page import live as page

    scene = with_rounds(scene, options)
    language = on_sheet(scene, options).sheet.language or "en"
    variants = [*_variants(scene, options, offered)]
    few = len(variants[0].compositions) <= MAX_OFFERED
    chosen = offered if offered is not None else LANGUAGES if few else ("en",)
    languages = [language, *(code for code in LANGUAGES if code != language and code in chosen)]
    return page(variants, languages, scene.title, steps_first=steps_first, shared=shared)


def _variants(scene: Scene, options: Options, offered: Collection[str] | None) -> Iterator[PageVariant]:
    """The ways to draw the scene that may be chosen: first as the options have it, then by other plans and methods,
    those that can be drawn, each once."""
    from graphplan.output.live.page import PageVariant, on_one_sheet
    from graphplan.sheet.layout.screen import compose_for_screen

    earlier: list[list[str]] = []
    for plan, method in _plans_and_methods(options, offered):
        first = not earlier
        how = replace(options, plan=plan, method=method)
        try:
            drawing = make_report(on_sheet(scene, how), how).drawing
        except (Refused, ConstructionError):
            if first:
                raise
            continue
        if (steps := drawing.sentences()) in earlier:
            continue
        earlier.append(steps)
        with suppress(*(() if first else (Refused,))):
            alternatives = _alternatives(drawing)
            composition = compose_for_screen(plans_over_the_travel(drawing, alternatives))
            yield PageVariant(drawing.plan, method,
                              on_one_sheet(composition, alternatives if first else alternatives[:MAX_ALTERNATIVES]))


def plans_over_the_travel(drawing: Construction, alternatives: Sequence[Construction]) -> Plans:
    """The plans with room for all poses to which the drive leads; of a mechanism that cannot be moved for its own."""
    from graphplan.cycle.turn import loop
    from graphplan.sheet.layout.screen import with_poses
    from graphplan.sheet.plates.plans import Plans
    from graphplan.words.tongue import tongue

    plans = Plans(drawing, tongue(drawing.scene.sheet.language or "en"))
    try:
        turn = loop(drawing.scene, TRAVEL_POSES).turn
        return with_poses(plans, [drawing, *alternatives], turn.points, turn.guides, turn.loads)
    except Refused:
        return plans


def _alternatives(drawing: Construction) -> list[Construction]:
    """The constructions that serve where this one cannot be drawn."""
    from graphplan.accuracy.reach import constructions

    return [alternative for alternative in constructions(drawing) if alternative is not drawing]


def _plans_and_methods(options: Options, offered: Collection[str] | None) -> Iterator[tuple[str, str]]:
    """Pairs of plan and method: first as the options have them, then the alternatives that are wanted."""
    plan, method, wanted = options.plan, options.method, offered or ("plans",) * (offered is None)
    forces = ",".join(word for word in plan.split(",") if word not in PLANS)
    plans = [plan, *(",".join(filter(None, (motion_plan, forces)))
                     for motion_plan in PLANS)] if "plans" in wanted else [plan]
    methods = [method, *METHODS] if "methods" in wanted else [method]
    yield from dict.fromkeys((plan, method) for plan in plans for method in methods)
