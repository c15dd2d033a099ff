"""What the site shows of the packaged scenes and tasks: under which topic and in which order, and in which words;
and its front page on a code host, which has them all.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape

from graphplan.mechanism.model import Scene
from graphplan.phrases import Said, said
from graphplan.site import shown_scenes  # noqa: PLW0406
from graphplan.site.chapters import TABLES, titles
from graphplan.words.tongue import Tongue

TOPICS: dict[Said, str] = {
    said("Linkages with pin joints"):
        "four-bar five-bar open-chain stephenson",
    said("Slides and slotted links"):
        "slider-crank ozols-5-1 slotted-link shaper ozols-5-2 ozols-5-3 ozols-5-4 ozols-5-5 plough-lift geneva-slide",
    said("Groups of higher class, rings of links"):
        "triad class-four parallel-links rosenauer-basic rosenauer-example-1 rosenauer-example-2 alt-eight-link "
        "alt-eight-link-2 alt-ten-link alt-ten-link-2 double-butterfly",
    said("Gears"):
        "planetary biplanetary david gear-linkage geared-five-bar racks",
    said("Cams and contacts"):
        "arc-cam roller-cam ozols-5-6 geneva wheel-on-rail",
    said("Instant centres and curvature"):
        "instant-centres inflection-circle cardan-circles dwell",
    said("Forces and friction"):
        "jaanimets-10 jaanimets-11 ozols-9-1 ozols-10-1 ozols-10-2 kinytskyi triad-loaded class-four-loaded "
        "rosenauer-loaded walschaerts-loaded",
    said("Machines over their cycle"):
        "ozols-13-6 ozols-13-7 ozols-16-1",
    said("Mechanisms that are found"):
        "guidance-moving guidance-fixed guidance-22-8 function-rocker function-slide stroke-slider-crank "
        "stroke-crank-rocker stroke-lever cognates-four-bar dwell-output geneva-19-1 conjugate-pin gear-21-1",
}


def by_topic(names: Iterable[str]) -> dict[Said, list[str]]:
    """The names under their topics, in the order of these; what is no packaged scene comes last."""
    remaining = dict.fromkeys(names)
    sorted_names = {topic: [name for name in scenes.split() if remaining.pop(name, name) is None]
                    for topic, scenes in TOPICS.items()}
    sorted_names[said("Further scenes")] = [*remaining]
    return {topic: scenes for topic, scenes in sorted_names.items() if scenes}


PURPOSE = said("graphplan finds the velocities, accelerations and forces of a planar mechanism as a draughtsman "
               "does: with compasses and straightedge, in ordered steps, each with its reason. It draws the sheet, "
               "judges drawings made by hand, and checks every number against an independent solver.")
AUDIENCES = (
    said("For teachers: a task for each student, and the scans of a whole class judged step by step."),
    said("For students: the construction in words and in motion, in any pose of the mechanism."),
    said("For engineers: numbers with proven bounds over the whole cycle, forces with friction, flywheels, "
           "balancing."),
    said("For authors: figures for LaTeX, CAD and GeoGebra, which move."),
)
CONSTRUCTED = said("What graphplan constructs of each scene: the sheet, the construction in words, and the page on "
                     "which it moves.")
CHARTS = said("Measured and followed round")
MEASURED = said("Speed against accuracy (`graphplan chart`) and kinematic diagrams (`graphplan cycle`); times are "
                  "ratios within one run.")
ANIMATION = "moving.svg"


@dataclass(frozen=True)
class ShownScene:
    """A scene of the site under its name: how many steps it takes, its construction in words, its files with what they
    are, and the page on which it moves."""

    scene: Scene
    name: str
    steps: int
    protocol: str
    files: Mapping[str, str]
    live: str = ""


# ---- the front page of the site on a code host -----------------------------------------------------------------------

README, LESSONS = "README.md", "tutorial.md"
MARK = "<!-- Written by graphplan gallery. -->"  # a page without it is another's, and stays as it is
COLUMNS, WIDTH = 3, 260  # thumbnails in a row, and the width of each in pixels


def front_page(shown: Sequence[ShownScene], moving: str, charts: Iterable[str], tongue: Tongue) -> str:
    """The page as Markdown, with the scene of the animation and the charts that are there."""
    by_name, pictures = {scene.name: scene for scene in shown}, [*charts]

    def page_lines() -> Iterator[str]:
        yield MARK
        yield f"# {tongue(said('Gallery'))}"
        yield tongue(shown_scenes.PURPOSE)
        if moving:
            yield f"![{_cell(tongue.title(by_name[moving].scene.title))}]({shown_scenes.ANIMATION})"
        yield "\n".join(f"- {tongue(words)}" for words in shown_scenes.AUDIENCES)
        yield tongue(shown_scenes.CONSTRUCTED)
        yield tongue(said("Begin with the {0}. A picture leads to its sheet, the number of steps to the construction "
                          "in words. In a browser the site begins with `index.html`.",
                          f"[{tongue(said('Tutorial'))}]({LESSONS})"))
        yield " · ".join(f"[{tongue(title)}]({TABLES}/{name}.md)" for name, title in titles().items())
        for topic, names in by_topic(by_name).items():
            yield f"## {tongue(topic)}"
            yield _thumbnails([_scene(by_name[name], tongue) for name in names])
        if pictures:
            yield f"## {tongue(shown_scenes.CHARTS)}"
            yield tongue(shown_scenes.MEASURED)
            yield _thumbnails([_picture(f"charts/{name}.svg", name) for name in pictures])

    return "\n\n".join(page_lines()) + "\n"


def _thumbnails(cells: Sequence[str]) -> str:
    """Cells in rows, as a table without heads."""
    cells = [*cells, *[""] * (-len(cells) % COLUMNS)]
    rows = [cells[first:first + COLUMNS] for first in range(0, len(cells), COLUMNS)]
    return "\n".join(f"| {' | '.join(row)} |" for row in ([""] * COLUMNS, ["---"] * COLUMNS, *rows))


def _scene(one: ShownScene, tongue: Tongue) -> str:
    title = tongue.title(one.scene.title)
    steps = tongue(said("{0} steps", one.steps))
    return f"{_picture(f'{one.name}.svg', title)}<br>{_cell(title)}<br>[{steps}]({one.name}.txt)"


def _picture(path: str, shows: str) -> str:
    return f'[<img src="{path}" alt="{_cell(shows)}" width="{WIDTH}">]({path})'


def _cell(text: str) -> str:
    """Words in a cell of a table in Markdown: none of them ends the cell or begins an element."""
    return escape(text).replace("|", "&#124;")
