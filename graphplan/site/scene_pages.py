"""Pages of the site about scenes: each with its sheets, and the list of those that are shown."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape

from graphplan.mechanism.model import Scene
from graphplan.phrases import Said, said
from graphplan.site.chapters import INDEX, SCENES, TABLES, Sight, SitePage, cards, preformatted_block, titles
from graphplan.site.tutorial import lesson_links
from graphplan.words.tongue import Tongue

FILTER = """
const field = document.getElementById("filter"), plain = (text) => text.toLowerCase();
field.addEventListener("input", () => {
  const words = plain(field.value).split(/\\s+/);
  for (const section of document.querySelectorAll("section")) {
    const topic = section.querySelector("h2").textContent;
    for (const card of section.querySelectorAll("figure"))
      card.hidden = !words.every((word) => plain(`${topic} ${card.textContent}`).includes(word));
    section.hidden = !section.querySelector("figure:not([hidden])");
  }
});
"""


def start_page(shown: Sequence[ShownScene], moving: str, tongue: Tongue) -> str:
    """The page on which the site begins: what graphplan does, and for whom; `moving` is the scene of the animation."""
    page, by_name = SitePage(tongue, INDEX), {card.name: card for card in shown}

    def body() -> Iterator[str]:
        yield page.paragraph(PURPOSE)
        if moving:
            title = tongue.title(by_name[moving].scene.title)
            yield Sight(ANIMATION, title, by_name[moving].live or f"{moving}.html", escape(title)).figure
        yield "<ul>" + "".join(f"<li>{page.say(words)}</li>" for words in AUDIENCES) + "</ul>"
        yield f"<h2>{page.say(said('Tutorial'))}</h2>"
        yield lesson_links(tongue)

    return page.page(tongue(said("Graphical analysis of planar mechanisms")), body())


def scenes_page(shown: Sequence[ShownScene], charts: Iterable[str], tongue: Tongue) -> str:
    """The page that leads to all scenes, by topic and by the words that one looks for, and shows the charts."""
    page, by_name = SitePage(tongue, SCENES), {card.name: card for card in shown}
    measured = [Sight(f"charts/{name}.svg", name, f"charts/{name}.svg") for name in charts]

    def body() -> Iterator[str]:
        yield page.paragraph(CONSTRUCTED)
        yield f'<p><label>{page.say(said("Find a scene"))} <input type="search" id="filter"></label></p>'
        for topic, names in by_topic(by_name).items():
            yield f"<section><h2>{page.say(topic)}</h2>"
            yield cards(_card(page, by_name[name]) for name in names)
            yield "</section>"
        if measured:
            yield f"<h2>{page.say(CHARTS)}</h2>"
            yield page.paragraph(MEASURED)
            yield cards(measured)
        yield f"<script>{FILTER}</script>"

    return page.page(page.tongue(said("Scenes")), body())


def _card(page: SitePage, one: ShownScene) -> Sight:
    """A scene on the index."""
    title = page.tongue.title(one.scene.title)
    links = [f'<a href="{one.name}.html">{page.say(said("{0} steps", one.steps))}</a>']
    links += [f'<a href="{one.live}">{page.say(said("moving"))}</a>'] if one.live else []
    caption = f"<b>{escape(title)}</b><br>{escape(one.scene.source)}<br>{' · '.join(links)}"
    return Sight(f"{one.name}.svg", title, f"{one.name}.html", caption)


def scene_page(one: ShownScene, tongue: Tongue) -> str:
    """The page of one scene."""
    page = SitePage(tongue, f"{one.name}.html")
    title = page.tongue.title(one.scene.title)

    def body() -> Iterator[str]:
        if one.scene.source:
            yield f"<p>{escape(one.scene.source)}</p>"
        if one.live:
            yield f'<p><a href="{one.live}">{page.say(said("The page on which it moves"))}</a></p>'
        yield Sight(f"{one.name}.svg", title, f"{one.name}.svg").figure
        yield f"<h2>{page.say(said('Files'))}</h2>"
        yield "<ul>" + "".join(f'<li><a href="{name}">{name}</a>: {page.say(words)}</li>'
                               for name, words in one.files.items()) + "</ul>"
        yield f"<h2>{page.say(said('The construction in words'))}</h2>"
        yield preformatted_block(one.protocol)
        yield f"<h2>{page.say(said('The scene'))}</h2>"
        yield preformatted_block(one.scene.text)

    return page.page(title, body())


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
        "quick-return ozols-13-6 ozols-13-7 ozols-16-1",
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
CONSTRUCTED = said("The constructions of each scene: the sheet, the steps in words, and the page on which it moves.")
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


README, LESSONS = "README.md", "tutorial.md"
MARK = "<!-- Written by graphplan gallery. -->"  # a page without it is another's, and stays as it is
COLUMNS, WIDTH = 3, 260  # thumbnails in a row, and the width of each in pixels


def front_page(shown: Sequence[ShownScene], moving: str, charts: Iterable[str], tongue: Tongue) -> str:
    """The page as Markdown, with the scene of the animation and the charts that are there."""
    by_name, pictures = {scene.name: scene for scene in shown}, [*charts]

    def page_lines() -> Iterator[str]:
        yield MARK
        yield f"# {tongue(said('Gallery'))}"
        yield tongue(PURPOSE)
        if moving:
            yield f"![{_cell(tongue.title(by_name[moving].scene.title))}]({ANIMATION})"
        yield "\n".join(f"- {tongue(words)}" for words in AUDIENCES)
        yield tongue(CONSTRUCTED)
        yield tongue(said("Begin with the {0}. A picture leads to its sheet, the number of steps to the construction "
                          "in words. In a browser the site begins with `index.html`.",
                          f"[{tongue(said('Tutorial'))}]({LESSONS})"))
        yield " · ".join(f"[{tongue(title)}]({TABLES}/{name}.md)" for name, title in titles().items())
        for topic, names in by_topic(by_name).items():
            yield f"## {tongue(topic)}"
            yield _thumbnails([_scene(by_name[name], tongue) for name in names])
        if pictures:
            yield f"## {tongue(CHARTS)}"
            yield tongue(MEASURED)
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
    """Escape words for a cell of a Markdown table."""
    return escape(text).replace("|", "&#124;")
