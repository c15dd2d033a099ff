"""Write a live page: the construction in a browser, from one file, without a network; it moves, and all follows.

Drag the drive or a point, type an angle, or let it run: the linkage follows on its branch, the construction is drawn
anew, and the numbers in its sentences and tables are those of the pose. Where nothing can be moved the page
goes through the steps alone.

examples:
  graphplan live four-bar -o four-bar.html
  graphplan live alt-eight-link --choices plans,methods,languages -o page.html
  graphplan live scene.toml --plan polar --choices none --language de -o page.html
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from graphplan.commands.choices import add_choices, add_preference, add_sheet, load_scene, load_sheet_scene, make_report
from graphplan.commands.output import kind, write
from graphplan.errors import ConstructionError, Refused
from graphplan.mechanism.sections import METHODS
from graphplan.words import LANGUAGES

if TYPE_CHECKING:
    from graphplan.methods.construction import Construction
    from graphplan.output.live.page import PageVariant

ENDINGS = (".html",)
CHOICES = "plans", "methods", "languages"
MAX_ALTERNATIVES = 2  # further constructions for a plan or method that is not the page's own: each takes its time
MAX_OFFERED = 2  # constructions for the poses of a page: their words in all languages are small, and quickly told
PLANS = "polar", "orthogonal"


def options(command: argparse.ArgumentParser) -> None:
    command.add_argument("-o", "--output", metavar="PAGE.html", required=True, help="the page to write")
    add_sheet(command, positions=False)
    add_choices(command, strict=True)
    add_preference(command)
    add_offer(command)


def add_offer(command: argparse.ArgumentParser) -> None:
    """The option that lists what may be chosen on the page."""
    command.add_argument("--choices", type=_choices, metavar="WHAT",
                         help=f"what may be chosen on the page: {', '.join(CHOICES)}, some languages such as de,lv, or "
                         "none; without it plans, and besides its own English, or where that is small all languages")


def _choices(text: str) -> frozenset[str]:
    names = [] if text == "none" else text.split(",")
    if unknown := [choice for choice in names if choice not in (*CHOICES, *LANGUAGES)]:
        raise Refused("--choices", f"{unknown[0]} cannot be chosen",
                      f"some of {', '.join((*CHOICES, *LANGUAGES))}, or none")
    return frozenset(names) | (frozenset(LANGUAGES) if "languages" in names else frozenset())


def run(options: argparse.Namespace) -> int:
    kind(options.output, ENDINGS, "live page")
    write(page(options), options.output)
    return 0


def page(options: argparse.Namespace, *, steps_first: bool = False, shared: str = "") -> str:
    """The page of a scene; `steps_first` it is opened at the first step; with a `shared` script it leaves that out."""
    from graphplan.output.live.page import live

    scene, language = load_scene(options), load_sheet_scene(options).sheet.language or "en"
    variants = [*_variants(options)]
    few = len(variants[0].compositions) <= MAX_OFFERED
    offered = options.choices if options.choices is not None else LANGUAGES if few else ("en",)
    languages = [language, *(code for code in LANGUAGES if code != language and code in offered)]
    return live(variants, languages, scene.title, steps_first=steps_first, shared=shared)


def _variants(options: argparse.Namespace) -> Iterator[PageVariant]:
    """The ways to draw the scene that may be chosen: first as the options have it, then by other plans and methods,
    those that can be drawn, each once."""
    from graphplan.output.live.page import PageVariant, on_one_sheet
    from graphplan.sheet.layout.composition import compose

    earlier: list[list[str]] = []
    for plan, method in _plans_and_methods(options):
        first = not earlier
        try:
            drawing = _construction_by(options, plan, method)
        except (Refused, ConstructionError):
            if first:
                raise
            continue
        if (steps := drawing.sentences()) in earlier:
            continue
        earlier.append(steps)
        with suppress(*(() if first else (Refused,))):
            composition = compose(drawing, protocol="none")
            alternatives = _alternatives(drawing)
            yield PageVariant(drawing.plan, method,
                              on_one_sheet(composition, alternatives if first else alternatives[:MAX_ALTERNATIVES]))


def _alternatives(drawing: Construction) -> list[Construction]:
    """The constructions that serve where this one cannot be drawn."""
    from graphplan.accuracy.reach import constructions

    return [alternative for alternative in constructions(drawing) if alternative is not drawing]


def _plans_and_methods(options: argparse.Namespace) -> Iterator[tuple[str, str]]:
    """Pairs of plan and method: first as the options have them, then the alternatives that are wanted."""
    plan, method, offered = options.plan, options.method, options.choices or ("plans",) * (options.choices is None)
    forces = ",".join(word for word in plan.split(",") if word not in PLANS)
    plans = [plan, *(",".join(filter(None, (motion_plan, forces)))
                     for motion_plan in PLANS)] if "plans" in offered else [plan]
    methods = [method, *METHODS] if "methods" in offered else [method]
    yield from dict.fromkeys((plan, method) for plan in plans for method in methods)


def _construction_by(options: argparse.Namespace, plan: str, method: str) -> Construction:
    """The construction by a plan and a method, compared with the solver."""
    how = argparse.Namespace(**{**vars(options), "plan": plan, "method": method})
    return make_report(how, load_sheet_scene(how)).drawing
