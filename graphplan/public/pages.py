"""The sheet of a scene as files: SVG, PDF, PNG or DXF, whole or in part, with its pages of words and of stages.

Pages to print and pages that move: handouts of a scene, and its live page.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple, Unpack

from graphplan.errors import ConstructionError, Refused
from graphplan.mechanism.model import Scene
from graphplan.mechanism.sections import METHODS
from graphplan.output import back_end
from graphplan.public import drafting, files
from graphplan.public.drafting import Keywords, Options
from graphplan.words import LANGUAGES

if TYPE_CHECKING:
    from graphplan.cycle.turn import Turn
    from graphplan.kernel.program import Program
    from graphplan.methods.construction import Construction
    from graphplan.output.live.page import PageVariant
    from graphplan.phrases import Said
    from graphplan.public.synthesis import SynthesisResults
    from graphplan.sheet.layout.composition import Composition
    from graphplan.sheet.plates.display import Sheet
    from graphplan.sheet.plates.plans import Plans

ENDINGS = (".svg", ".pdf", ".png", ".dxf")
WHOLE = {"pdf", "dxf"}  # formats that have all pages in one file
STAGES = "-stages"  # what the names of pages of stages add to that of the sheet
STAGED = "stages"


@dataclass(frozen=True)
class SheetExcerpt:
    """What of a sheet is drawn, and how: as it stands after a step (`until`); `steps` such as 6-12 over what was drawn
    before them; a `strip` of pictures, one a mark or one a step; `by` stages on pages of their own, or the sheet alone;
    with the `numbers` of steps at all marks; a .png in `dpi`."""

    until: str = ""
    steps: str = ""
    strip: str = ""
    by: str = ""
    numbers: bool = False
    dpi: int | None = None


class SheetFiles(NamedTuple):
    """The files of a sheet, each with its path, and what is not drawn as the pose is singular in part."""

    contents: list[tuple[str | None, Any]]
    missing: tuple[Said, ...]


def save_sheet(scene: Scene, path: str | None, options: Options, excerpt: SheetExcerpt) -> tuple[Said, ...]:
    """Write the sheet of a scene by the ending of a path, further pages beside it; without one, or where it is `-`, SVG
    on standard output. Return what is not drawn as the pose is singular in part."""
    sheet = sheet_files(scene, path, sheet_format(path, excerpt.dpi), options, excerpt)
    files.write_all(sheet.contents)
    return sheet.missing


def sheet_files(scene: Scene, path: str | None, name: str, options: Options, excerpt: SheetExcerpt) -> SheetFiles:
    """Return the files of the sheet of a scene in a format; without a path the first page alone."""
    from graphplan.sheet.layout.layout import pages, with_numbers
    from graphplan.sheet.strip import by_stages, strip

    report = drafting.drawable(scene, options)
    composition = drafting.on_paper(scene, options, report).composition
    composition = with_numbers(composition) if excerpt.numbers else composition
    names, text = files.page_names(path, 2), drafting.as_drawn(report.scene, options)
    more: list[Sheet] = []
    if excerpt.strip:
        sheets = strip(composition, cut=excerpt.strip)
    elif _wants_stages(excerpt, report.drawing.strict) and (name in WHOLE or len(names) > 1):
        sheets, more = by_stages(composition)
    else:
        sheets = [_requested_steps(sheet, report.drawing.drawn, excerpt) for sheet in pages(composition)]
    sheets, more = ([replace(sheet, scene=text) for sheet in some] for some in (sheets, more))
    write_out, look = back_end(name), {"dpi": excerpt.dpi or files.DEFAULT_DPI} if name == "png" else {}
    if name in WHOLE:
        content = write_out(sheets + more, *([composition.plates] if name == "dxf" else []))
        return SheetFiles([(path, content)], report.drawing.missing)
    names = files.page_names(path, len(sheets), "" if excerpt.strip else files.PROTOCOL)
    names += files.page_names(path, 1 + len(more), STAGES)[1:]
    contents = [(path, write_out(sheet, **look)) for path, sheet in zip(names, sheets + more, strict=False)]
    return SheetFiles(contents, report.drawing.missing)


def sheet_format(path: str | None, dpi: int | None = None) -> str:
    """The format of a sheet by the ending of its path; fails with `Refused` where nothing can be written there."""
    name = files.kind(path, ENDINGS, "sheet").removeprefix(".")
    if dpi and name != "png":
        raise Refused(f"--dpi {dpi}", "only a .png has a resolution", "leave it out, or -o SHEET.png")
    return name


def _wants_stages(excerpt: SheetExcerpt, strict: bool) -> bool:
    """Whether stages are drawn: on request, and by default without set squares."""
    return excerpt.by == STAGED or (strict and not (excerpt.by or excerpt.until or excerpt.steps))


def _requested_steps(sheet: Sheet, drawn: Program, excerpt: SheetExcerpt) -> Sheet:
    """What of the sheet is asked for."""
    if not (excerpt.until or excerpt.steps):
        return sheet
    from graphplan.sheet.layout.layout import sheet_at_step, step_range

    first, last = step_range(drawn, excerpt.steps or excerpt.until)
    return sheet_at_step(sheet, last, first if excerpt.steps else 0)


MAX_ALTERNATIVES = 2  # further constructions for a plan or method that is not the page's own: each takes its time
MAX_OFFERED = 2  # constructions for the poses of a page: their words in all languages are small, and quickly told
TRAVEL_POSES = 144  # in which the plans are looked at for the room that they need
PLANS = "polar", "orthogonal"


# ---- handouts --------------------------------------------------------------------------------------------------------


def handout(scene: Scene | SynthesisResults, path: str | os.PathLike[str], *, only: str | None = None,
            choices: Collection[str] | str | None = None, **options: Unpack[Keywords]) -> None:
    """Write a handout, as `graphplan handout` does: a .pdf with the task, its guided version and the solution in true
    size, or `only` one of them; or a .html, the live page with the steps in front. In the place of a scene it takes
    what `synthesize` finds.

    Further keywords say how it is drawn and what the sheet looks like, as for `construct` and `drawing.save`.
    Fails as they do.
    """
    save_handout(scene, os.fspath(path), drafting.options_of(options), only, drafting.choices_of(choices))


def save_handout(scene: Scene | SynthesisResults, path: str, options: Options, only: str | None = None,
                 offered: Collection[str] | None = None) -> None:
    """The same with options in one record."""
    if not isinstance(scene, Scene):
        return scene.save_handout(path, options, only, offered)
    if files.handout_ending(path, only) == ".html":
        if scene.assembly is not None:
            raise Refused("--at", "a page for a browser moves to any pose", "leave it out, or -o FILE.pdf")
        files.write(live_page(scene, options, offered, steps_first=True), path)
    else:
        files.write(back_end("pdf")(_pages(drafting.on_paper(scene, options).composition, only)), path)


def _pages(composition: Composition, only: str | None) -> list[Sheet]:
    """The pages of the parts that are wanted."""
    from graphplan.sheet.handout import guided_task, solution, task

    pages = {"task": task, "guided": guided_task, "solution": solution}
    return [sheet for part in files.PARTS if only in (None, part) for sheet in pages[part](composition)]


# ---- live pages ------------------------------------------------------------------------------------------------------


def live(scene: Scene | SynthesisResults, path: str | os.PathLike[str], *, choices: Collection[str] | str | None = None,
         **options: Unpack[Keywords]) -> None:
    """Write the live page of a scene, as `graphplan live -o` does: one .html without a network, on which the mechanism
    is dragged and the construction follows.

    `choices` says what may be chosen on it: "plans", "methods", "languages" or some languages by their codes, or
    "none". Further keywords say how it is drawn and what the sheet looks like. Of what `synthesize` finds it is the
    page of the task, on which given positions are dragged. Fails as `construct` does.
    """
    files.kind(os.fspath(path), files.LIVE_ENDINGS, "live page")
    files.write(live_page(scene, drafting.options_of(options), drafting.choices_of(choices)), os.fspath(path))


def live_page(scene: Scene | SynthesisResults, options: Options, offered: Collection[str] | None = None, *,
              steps_first: bool = False, shared: str = "") -> str:
    """The page of a scene; `steps_first` it is opened at the first step; with a `shared` script it leaves that out."""
    if not isinstance(scene, Scene):
        return scene.live_page(options, offered, steps_first=steps_first)
    from graphplan.output.live.page import live as page

    scene = drafting.with_rounds(scene, options)
    language = drafting.on_sheet(scene, options).sheet.language or "en"
    variants = [*_variants(scene, options, offered)]
    few = len(variants[0].compositions) <= MAX_OFFERED
    languages = drafting.languages_of(language, offered, LANGUAGES if few else ("en",))
    return page(variants, languages, scene.title, steps_first=steps_first, shared=shared)


def _variants(scene: Scene, options: Options, offered: Collection[str] | None) -> Iterator[PageVariant]:
    """The ways to draw the scene that may be chosen: first as the options have it, then by other plans and methods,
    those that can be drawn, each once."""
    from graphplan.accuracy.reach import MAX_CONSTRUCTIONS, constructions, reachable_poses
    from graphplan.output.live.page import PageVariant, on_one_sheet
    from graphplan.sheet.layout.screen import compose_for_screen

    earlier, poses, turn, own_plan = list[list[str]](), None, None, None  # all move alike: poses are looked for once
    for plan, method in _plans_and_methods(options, offered):
        first = not earlier
        how = replace(options, plan=plan, method=method)
        if method == options.method and plan.split(",")[0] == own_plan:
            continue  # by these plans it is drawn already
        try:
            report = drafting.drawable(scene, how)
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
            composition = compose_for_screen(plans_over_travel(drawing, alternatives, turn))
            yield PageVariant(drawing.plan, method, on_one_sheet(composition, alternatives), report.missing)


def turn_over_travel(scene: Scene) -> Turn | None:
    """The poses to which the drive leads; none of a mechanism that cannot be moved."""
    from graphplan.cycle.turn import loop

    try:
        return loop(scene, TRAVEL_POSES).turn
    except Refused:
        return None


def plans_over_travel(drawing: Construction, alternatives: Sequence[Construction], turn: Turn | None) -> Plans:
    """The plans with room for all poses of a turn; where there is none for their own. Pages tell each movement."""
    from graphplan.sheet.layout.screen import with_poses
    from graphplan.sheet.plates.plans import Plans
    from graphplan.words.tongue import tongue

    plans = Plans(drawing, tongue(drawing.scene.sheet.language or "en"), unfolded=True)
    drawings = [drawing, *alternatives]
    return with_poses(plans, drawings, turn.points, turn.guides, turn.loads) if turn else plans


def _plans_and_methods(options: Options, offered: Collection[str] | None) -> Iterator[tuple[str, str]]:
    """Pairs of plan and method: first as the options have them, then the alternatives that are wanted."""
    plan, method, wanted = options.plan, options.method, offered or ("plans",) * (offered is None)
    forces = ",".join(word for word in plan.split(",") if word not in PLANS)
    plans = [plan, *(",".join(filter(None, (motion_plan, forces)))
                     for motion_plan in PLANS)] if "plans" in wanted else [plan]
    methods = [method, *METHODS] if "methods" in wanted else [method]
    yield from dict.fromkeys((plan, method) for plan in plans for method in methods)
