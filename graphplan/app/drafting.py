"""How a scene is drawn and what its sheet looks like, as far as it is said beside the scene itself.

From a scene to its checked construction, and to its sheet, as the options and the scene itself have it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, fields, replace
from itertools import permutations
from typing import TYPE_CHECKING, Any, TypedDict, TypeVar

from graphplan.errors import ConstructionError, Disagreement, Refused, SingularPose
from graphplan.mechanism.fields import suggestion
from graphplan.mechanism.pairs.pair import FRAME
from graphplan.mechanism.sections import BESIDE_PLANS, NO_WORDS
from graphplan.methods.design import Design
from graphplan.words import LANGUAGES

if TYPE_CHECKING:
    from graphplan.accuracy.drafted import Drafted
    from graphplan.check.report import Report
    from graphplan.design.hand import Pencil
    from graphplan.mechanism.model import Scene
    from graphplan.mechanism.tasks import SheetTask

@dataclass(frozen=True)
class Options:
    """Choices for drawing a scene and its sheet; an empty one is left to [sheet], and else to graphplan.

    `method`, `plan`, `inertia`, `strict`: as `construct` has them; `rounds` of friction are drawn. `prefer` weighs all
    forms: simple, accurate or balanced, by a `pencil` of some accuracy. `paper`, `frame`, `language`: of the sheet;
    `protocol`: where its words stand; `curves` and `centrodes`: names of points and of pairs of links, with commas
    between them, or all; `positions` of the mechanism are drawn in faint lines. Scene keys have the same names and
    meanings.
    """

    method: str = ""
    plan: str = ""
    inertia: str = ""
    rounds: int | None = None
    strict: bool = False
    prefer: str = ""
    pencil: Pencil | None = None
    paper: str = ""
    frame: str = ""
    language: str = ""
    protocol: str = ""
    curves: str = ""
    centrodes: str = ""
    positions: int | None = None


class SheetKeywords(TypedDict, total=False):
    """Keywords of functions for any sheet; the pencil may be its text, such as "point=0.2"."""

    pencil: Pencil | str | None
    paper: str
    frame: str
    language: str


class Keywords(SheetKeywords, total=False):
    """Keywords of functions for a sheet and its construction."""

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


NAMES = tuple(field.name for field in fields(Options))


def options_of(keywords: Mapping[str, object]) -> Options:
    """The options that keywords say, a pencil as its text; fails with `Refused` where there is no such option."""
    for name in keywords:
        if name not in NAMES:
            raise Refused(f"option {name}", "there is no such option", suggestion(name, NAMES, "option"))
    values: dict[str, Any] = {name: value for name, value in keywords.items() if value is not None}
    if isinstance(values.get("pencil"), str):
        from graphplan.design.hand import pencil

        values["pencil"] = pencil(values["pencil"])
    return Options(**values)


Source = TypeVar("Source", bound="Scene | SheetTask")


def with_rounds(scene: Scene, options: Options) -> Scene:
    """The scene with as many rounds of friction as are asked for, if any."""
    rounds = options.rounds or scene.sheet.rounds
    if not rounds or scene.loads is None:
        return scene
    return replace(scene, loads=replace(scene.loads, rounds=rounds))


def on_sheet(scene: Scene, options: Options, **more: Any) -> Scene:
    """The scene with its sheet as the options and `more` have it, where they say; its title in the sheet's language."""
    from graphplan.words.tongue import tongue

    wishes = dict[str, Any](more)
    if options.curves:
        wishes["curves"] = _movable(scene, options.curves)
    if options.centrodes:
        wishes["centrodes"] = _rolling(scene, options.centrodes)
    if options.positions:
        wishes["positions"] = options.positions
    scene = with_presentation(scene, options, **wishes)
    return replace(scene, title=tongue(scene.sheet.language).title(scene.title))


def as_drawn(scene: Scene, options: Options, drafted: Drafted) -> str:
    """The text of a scene that is on its sheet, with its pose and with what the options say, its design and its paper
    among the keys of [sheet]: read again, it is drawn so without being told, whatever is chosen by then."""
    from graphplan.mechanism.scene_text import with_keys
    from graphplan.mechanism.written_scene import toml_value, with_pose

    keys = {name: value for name in NAMES if (value := getattr(options, name))}
    keys |= {name: list(getattr(scene.sheet, name)) for name in ("curves", "centrodes") if name in keys}
    if options.pencil:
        keys["pencil"] = options.pencil.text
    tied = {"kappa": scene.sheet.kappa, "phi": scene.sheet.phi}
    keys |= {key: value for key, value in drafted.drawing.design.chosen_keys.items() if not tied.get(key)}
    keys.setdefault("paper", drafted.paper)
    text = scene.text
    values = {key: toml_value(value, key) for key, value in keys.items()}
    return with_pose(with_keys(text, "sheet", values), scene) if text else ""


def with_presentation(source: Source, options: Options, **more: Any) -> Source:
    """A scene or a task with its sheet as the options and `more` have it, where they say."""
    from graphplan.mechanism.sections import FRAMES
    from graphplan.mechanism.units import PAPERS

    choices = {"paper": PAPERS, "frame": FRAMES, "language": LANGUAGES}
    chosen = {key: value for key in choices if (value := getattr(options, key))}
    for key, value in chosen.items():
        if value not in choices[key]:
            raise Refused(f"{key} {value}", f"there is no such {key}", suggestion(value, choices[key], key))
    return replace(source, sheet=replace(source.sheet, **chosen, **more))


def make_report(scene: Scene, options: Options, **more: Any) -> Report:
    """The construction that the options ask for, compared with the solver; its notes say why a form is preferred."""
    from graphplan.check.trusted import report

    wishes, reasons = wishes_of(scene, options)
    result = report(scene, wishes, **more)
    result.drawing.notes.extend(reasons)
    return result


def drawable(scene: Scene, options: Options) -> Report:
    """Report of the scene on its sheet, or of its regular part in this pose; its notes have the results that are not
    drawn, with the reason."""
    from graphplan.check.answerable import report_regular_part

    result = report_regular_part(on_sheet(with_rounds(scene, options), options),
                                 lambda scene: make_report(scene, options))
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


def wishes_of(scene: Scene, options: Options) -> tuple[Design, tuple[str, ...]]:
    """Wishes for a drawing, with the named or preferred method, and the reasons for the preference, line by line.

    Where no form can be weighed, the pose's own is drawn, as without a preference.
    """
    wishes = Design(options.plan, options.method, inertia=options.inertia or scene.sheet.inertia,
                    strict=options.strict or scene.sheet.strict)
    prefer = options.prefer or scene.sheet.prefer
    if not prefer:
        return wishes, ()
    from graphplan.accuracy.preference import preferred_form, reason

    try:
        form = preferred_form(scene, prefer, pencil(options, scene), wishes)
    except (ConstructionError, Disagreement, Refused, SingularPose) as fault:
        if options.method:
            raise
        return wishes, (reason(fault),)
    return replace(wishes, method=form.method), form.remarks


def on_paper(scene: Scene, options: Options, result: Report | None = None, *, words: bool = True) -> Drafted:
    """A construction on its sheet, drawn with the pencil and in the language that are asked for; without `words` it has
    no pages of these."""
    from graphplan.accuracy.drafted import draft
    from graphplan.words.tongue import tongue

    result = result or drawable(scene, options)
    sheet = result.scene.sheet
    protocol = options.protocol or sheet.protocol
    return draft(result.drawing, pencil(options, scene), check=result.check, tongue=tongue(sheet.language),
                 protocol=protocol if words or protocol == BESIDE_PLANS else NO_WORDS)


def pencil(options: Options, source: Scene | SheetTask | None = None) -> Pencil:
    """The pencil that is asked for, by the options or by the sheet of a scene, or a careful hand's."""
    from graphplan.design import hand

    text = source.sheet.pencil if source is not None else ""
    return options.pencil or (hand.pencil(text) if text else hand.Pencil())


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
