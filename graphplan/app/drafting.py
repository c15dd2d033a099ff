"""The choices of a drawing and its sheet: options and keywords are keys of [sheet].

From a scene to its checked construction, and to its sheet, as its keys have it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace
from itertools import permutations
from typing import TYPE_CHECKING, Any, TypedDict, TypeVar

from graphplan.errors import ConstructionError, Disagreement, Refused, SingularPose
from graphplan.mechanism.fields import suggestion
from graphplan.mechanism.model import Presentation, Scene
from graphplan.mechanism.pairs.pair import FRAME
from graphplan.mechanism.sections import BESIDE_PLANS, FRAMES, NO_WORDS
from graphplan.mechanism.tasks import SheetTask
from graphplan.mechanism.units import PAPERS
from graphplan.methods.design import Design, merged_plans
from graphplan.words import LANGUAGES

if TYPE_CHECKING:
    from graphplan.accuracy.drafted import Drafted
    from graphplan.app.subjects import FoundMechanism
    from graphplan.check.report import Report
    from graphplan.design.hand import Pencil


class SheetKeywords(TypedDict, total=False):
    """The keys of any [sheet] that functions have as keywords; an empty one is left to the scene or the task."""

    pencil: str | None
    paper: str
    frame: str
    language: str


class Keywords(SheetKeywords, total=False):
    """The keys of a scene's [sheet] that functions have as keywords, and commands as options.

    Names in `curves` and `centrodes` have commas between them, or are "all".
    """

    method: str
    plan: str
    inertia: str
    rounds: int | None
    strict: bool
    prefer: str
    protocol: str
    curves: str
    centrodes: str
    positions: int | None


KEYS = tuple(Keywords.__annotations__)
CHOICES_OF_KEYS = {"paper": PAPERS, "frame": FRAMES, "language": LANGUAGES}
AUTO = "auto"  # words stand beside the plans, or on pages of their own where these need the room
Source = TypeVar("Source", bound="Scene | SheetTask | FoundMechanism")


def with_sheet(source: Source, keys: Mapping[str, Any]) -> Source:
    """A scene, a task or what is found for one, with other keys of [sheet]; of plans those of motion, or of forces.

    Fails with `Refused` where there is no such key, value, point or link.
    """
    if not isinstance(source, Scene | SheetTask):
        return source.with_sheet(keys)
    for key in keys:
        if key not in KEYS:
            raise Refused(f"option {key}", "there is no such option", suggestion(key, KEYS, "option"))
    values = {key: value for key, value in keys.items() if value}
    for key, choices in CHOICES_OF_KEYS.items():
        if key in values and values[key] not in choices:
            raise Refused(f"{key} {values[key]}", f"there is no such {key}", suggestion(values[key], choices, key))
    if isinstance(source, Scene):
        values |= {key: read(source, values[key]) for key, read in NAME_LISTS.items() if key in values}
    if "plan" in values:
        values["plan"] = merged_plans(values["plan"], source.sheet.plan)
    if "pencil" in values:
        from graphplan.design.hand import pencil

        values["pencil"] = pencil(values["pencil"]).text
    return replace(source, sheet=replace(source.sheet, **values))


def translate_title(scene: Scene) -> Scene:
    """The scene with its title in the sheet's language."""
    from graphplan.words.tongue import tongue

    return replace(scene, title=tongue(scene.sheet.language).title(scene.title))


def as_drawn(scene: Scene, drafted: Drafted) -> str:
    """The text of a scene that is on its sheet, with its pose, its design and its paper, and with the keys of [sheet]
    that it has beside its text: read again, it is drawn so without being told, whatever is chosen by then."""
    from graphplan.mechanism.scene import tables_of
    from graphplan.mechanism.scene_text import with_keys
    from graphplan.mechanism.written_scene import toml_value, with_pose

    if not scene.text:
        return ""
    written: Any = tables_of(scene.text, scene.name).get("sheet", {})
    written = vars(Presentation()) | written
    values = {key: getattr(scene.sheet, key) for key in KEYS}
    values = {key: [*value] if isinstance(value, tuple) else value for key, value in values.items()}
    keys = {key: value for key, value in values.items() if value and value != written[key]}
    tied = {"kappa": scene.sheet.kappa, "phi": scene.sheet.phi}
    keys |= {key: value for key, value in drafted.drawing.design.chosen_keys.items() if not tied.get(key)}
    keys.setdefault("paper", drafted.paper)
    text = with_keys(scene.text, "sheet", {key: toml_value(value, key) for key, value in keys.items()})
    return with_pose(text, scene)


def make_report(scene: Scene, **more: Any) -> Report:
    """The construction of a scene, compared with the solver; its notes say why a form is preferred."""
    from graphplan.check.trusted import report

    wishes, reasons = wishes_of(scene)
    result = report(scene, wishes, **more)
    result.drawing.notes.extend(reasons)
    return result


def drawable(scene: Scene) -> Report:
    """Report of the scene on its sheet, or of its regular part in this pose; its notes have the results that are not
    drawn, with the reason."""
    from graphplan.check.answerable import report_regular_part

    result = report_regular_part(translate_title(scene), make_report)
    left_out = dict[str, list[str]]()
    if result.given_scene is not result.scene:
        from graphplan.check.json_results import reasons
        from graphplan.phrases import said

        for named in reasons(result).values():
            for name, why in named.items():
                left_out.setdefault(why, []).append(name)
        missing = tuple(said("not drawn: {0}: {1}", ", ".join(dict.fromkeys(names)), why)
                        for why, names in left_out.items())
        result = replace(result, drawing=replace(result.drawing, whole=result.given_scene, missing=missing))
    return result


def wishes_of(scene: Scene) -> tuple[Design, tuple[str, ...]]:
    """Wishes for a drawing beside the scene's plans and method, and the reasons for a preferred form, line by line.

    Where no form can be weighed, the pose's own is drawn, as without a preference.
    """
    sheet = scene.sheet
    wishes = Design(method=sheet.method, inertia=sheet.inertia, strict=sheet.strict)
    if not sheet.prefer:
        return wishes, ()
    from graphplan.accuracy.preference import preferred_form, reason

    try:
        form = preferred_form(scene, sheet.prefer, pencil(scene), wishes)
    except (ConstructionError, Disagreement, Refused, SingularPose) as fault:
        if sheet.method:
            raise
        return wishes, (reason(fault),)
    return replace(wishes, method=form.method), form.remarks


def on_paper(scene: Scene, result: Report | None = None, *, words: bool = True) -> Drafted:
    """A construction on its sheet, drawn with its pencil and in its language; without `words` it has no pages of
    these."""
    from graphplan.accuracy.drafted import draft
    from graphplan.words.tongue import tongue

    result = result or drawable(scene)
    sheet = result.scene.sheet
    protocol = sheet.protocol or AUTO
    return draft(result.drawing, pencil(scene), check=result.check, tongue=tongue(sheet.language),
                 protocol=protocol if words or protocol == BESIDE_PLANS else NO_WORDS)


def pencil(source: Scene | SheetTask) -> Pencil:
    """The pencil of a sheet, or a careful hand's."""
    from graphplan.design import hand

    return hand.pencil(source.sheet.pencil)


def _movable(scene: Scene, text: str) -> tuple[str, ...]:
    """The points of an option, all of which must move."""
    movable = [point for point, links in scene.links_of.items() if links and FRAME not in links]
    points = movable if text == "all" else text.replace(",", " ").split()
    for point in points:
        if point not in movable:
            why = f"{point} does not move" if point in scene.points else f"there is no point {point}"
            raise Refused(f"--curves {text}", why, suggestion(point, movable, "point"))
    return tuple(dict.fromkeys(points))


def _rolling(scene: Scene, text: str) -> tuple[str, ...]:
    """The pairs of links of an option, all of which the scene has; all those on the frame, if it is "all"."""
    if text == "all":
        return tuple(f"{link} {scene.frame}" for link in scene.moving)
    choices = [f"{link} {on}" for link, on in permutations((FRAME, *scene.moving), 2)]
    pairs = [" ".join(names.split()) for names in text.split(",")]
    for links in pairs:
        if links not in choices:
            why = f"there are no two links {links}" if links else "no links are named"
            raise Refused(f"--centrodes {text}", why, suggestion(links, choices, "pair of links"))
    return tuple(dict.fromkeys(pairs))


NAME_LISTS = {"curves": _movable, "centrodes": _rolling}


# ---- live pages ------------------------------------------------------------------------------------------------------

CHOICES = "plans", "methods", "languages"


def choices_of(choices: Collection[str] | str | None) -> frozenset[str] | None:
    """Choices of a page; None if they are left open."""
    if choices is None:
        return None
    names = [] if choices == "none" else choices.split(",") if isinstance(choices, str) else [*choices]
    if unknown := [choice for choice in names if choice not in (*CHOICES, *LANGUAGES)]:
        raise Refused("--choices", f"{unknown[0]} cannot be chosen",
                      f"some of {', '.join((*CHOICES, *LANGUAGES))}, or none")
    return frozenset(names) | (frozenset(LANGUAGES) if "languages" in names else frozenset())


def languages_of(language: str, offered: Collection[str] | None, unasked: Collection[str]) -> list[str]:
    """The languages of a page, its own first; without a word on what is offered some `unasked` ones."""
    chosen = unasked if offered is None else offered
    return [language, *(code for code in LANGUAGES if code != language and code in chosen)]
