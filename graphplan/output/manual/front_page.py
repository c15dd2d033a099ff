"""Topics: under which head of the gallery each packaged scene or task stands, and in which order.

The pages of the scenes: an index of them, and for each its sheet, its construction in words, and its files.

The front page of the site on a code host: thumbnails of the scenes by topic, each with its construction in words.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape

from graphplan.mechanism.model import Scene
from graphplan.output.manual.chapters import INDEX, TABLES, TITLES, Sight, SitePage, cards
from graphplan.phrases import Said, phrase, said
from graphplan.words.tongue import Tongue

TOPICS: dict[Said, tuple[str, ...]] = {
    said("Linkages with pin joints"): ("four-bar", "five-bar", "open-chain", "stephenson"),
    said("Slides and slotted links"): (
        "slider-crank", "ozols-5-1", "slotted-link", "shaper", "ozols-5-2", "ozols-5-3", "ozols-5-4", "ozols-5-5",
        "plough-lift", "geneva-slide"),
    said("Groups of higher class, rings of links"): (
        "triad", "class-four", "parallel-links", "rosenauer-basic", "rosenauer-example-1", "rosenauer-example-2",
        "alt-eight-link", "alt-eight-link-2", "alt-ten-link", "alt-ten-link-2", "double-butterfly"),
    said("Gears"): ("planetary", "biplanetary", "david", "gear-linkage", "geared-five-bar", "racks"),
    said("Cams and contacts"): ("arc-cam", "roller-cam", "ozols-5-6", "geneva", "wheel-on-rail"),
    said("Instant centres and curvature"): ("instant-centres", "inflection-circle", "cardan-circles", "dwell"),
    said("Forces and friction"): (
        "jaanimets-10", "jaanimets-11", "ozols-9-1", "ozols-10-1", "ozols-10-2", "kinytskyi", "triad-loaded",
        "class-four-loaded", "rosenauer-loaded", "walschaerts-loaded"),
    said("Machines over their cycle"): ("ozols-13-6", "ozols-13-7", "ozols-16-1"),
    said("Mechanisms that are found"): (
        "guidance-moving", "guidance-fixed", "guidance-22-8", "function-rocker", "function-slide",
        "stroke-slider-crank", "stroke-crank-rocker", "stroke-lever", "cognates-four-bar", "dwell-output",
        "geneva-19-1", "conjugate-pin", "gear-21-1"),
}


def by_topic(names: Iterable[str]) -> dict[Said, list[str]]:
    """The names under their topics, in the order of these; what is no packaged scene comes last."""
    requested = [*names]
    sorted_names = {topic: [name for name in scenes if name in requested] for topic, scenes in TOPICS.items()}
    in_topics = {name for scenes in TOPICS.values() for name in scenes}
    sorted_names[said("Further scenes")] = [name for name in requested if name not in in_topics]
    return {topic: scenes for topic, scenes in sorted_names.items() if scenes}


CONSTRUCTED = phrase("What graphplan constructs of each scene: the sheet, the construction in words, and the page on "
                     "which it moves.")
CHARTS = phrase("Measured and followed round")
MEASURED = phrase("Speed against accuracy (`graphplan chart`) and kinematic diagrams (`graphplan cycle`); times are "
                  "ratios within one run.")


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


def index(shown: Sequence[ShownScene], charts: Iterable[str], tongue: Tongue) -> str:
    """The page that leads to all scenes, and shows the charts that are there."""
    page, by_name = SitePage(tongue, INDEX), {card.name: card for card in shown}
    measured = [Sight(f"charts/{name}.svg", name, f"charts/{name}.svg") for name in charts]

    def body() -> Iterator[str]:
        yield page.paragraph(CONSTRUCTED())
        for topic, names in by_topic(by_name).items():
            yield f"<h2>{page.say(topic)}</h2>"
            yield cards(_card(page, by_name[name]) for name in names)
        if measured:
            yield f"<h2>{page.say(CHARTS())}</h2>"
            yield page.paragraph(MEASURED())
            yield cards(measured)

    return page.page(page.tongue(said("Gallery")), body())


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
        yield f"<pre>{escape(one.protocol)}</pre>"
        yield f"<h2>{page.say(said('The scene'))}</h2>"
        yield f"<pre>{escape(one.scene.text)}</pre>"

    return page.page(title, body())


README, LESSONS = "README.md", "tutorial.md"
MARK = "<!-- Written by graphplan gallery. -->"  # a page without it is another's, and stays as it is
COLUMNS, WIDTH = 3, 260  # thumbnails in a row, and the width of each in pixels


def front_page(shown: Sequence[ShownScene], charts: Iterable[str], tongue: Tongue) -> str:
    """The page as Markdown, with the charts that are there."""
    by_name, pictures = {scene.name: scene for scene in shown}, [*charts]

    def page_lines() -> Iterator[str]:
        yield MARK
        yield f"# {tongue(said('Gallery'))}"
        yield tongue(CONSTRUCTED())
        yield tongue(said("Begin with the {0}. A picture leads to its sheet, the number of steps to the construction "
                          "in words. In a browser the site begins with `index.html`.",
                          f"[{tongue(said('Tutorial'))}]({LESSONS})"))
        yield " · ".join(f"[{tongue(title)}]({TABLES}/{name}.md)" for name, title in TITLES.items())
        for topic, names in by_topic(by_name).items():
            yield f"## {tongue(topic)}"
            yield _thumbnails([_scene(by_name[name], tongue) for name in names])
        if pictures:
            yield f"## {tongue(CHARTS())}"
            yield tongue(MEASURED())
            yield _thumbnails([_picture(f"charts/{name}.svg", name) for name in pictures])

    return "\n\n".join(page_lines()) + "\n"


def _thumbnails(cells: Sequence[str]) -> str:
    """Cells in rows, as a table without heads."""
    columns = min(COLUMNS, len(cells))
    rows = [[*cells[first:first + columns]] for first in range(0, len(cells), columns)]
    rows[-1] += [""] * (columns - len(rows[-1]))
    lines = [" | ".join(row) for row in ([""] * columns, ["---"] * columns, *rows)]
    return "\n".join(f"| {line} |" for line in lines)


def _scene(one: ShownScene, tongue: Tongue) -> str:
    title = tongue.title(one.scene.title)
    steps = tongue(said("{0} steps", one.steps))
    return f"{_picture(f'{one.name}.svg', title)}<br>{_cell(title)}<br>[{steps}]({one.name}.txt)"


def _picture(path: str, shows: str) -> str:
    return f'[<img src="{path}" alt="{_cell(shows)}" width="{WIDTH}">]({path})'


def _cell(text: str) -> str:
    """Words in a cell of a table in Markdown: none of them ends the cell or begins an element."""
    return escape(text).replace("|", "&#124;")
