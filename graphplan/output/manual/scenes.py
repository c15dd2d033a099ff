"""The pages of the scenes: an index of them, and for each its sheet, its construction in words, and its files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape

from graphplan.mechanism.model import Scene
from graphplan.output.manual.site import INDEX, Sight, SitePage, cards
from graphplan.output.manual.topics import by_topic
from graphplan.phrases import phrase, said
from graphplan.words.tongue import Tongue

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
