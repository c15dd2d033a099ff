"""The pages of the scenes: where the site begins, an index by topic, and for each scene its sheet, words and files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from html import escape

from graphplan.phrases import said
from graphplan.site import shown_scenes
from graphplan.site.chapters import INDEX, SCENES, Sight, SitePage, cards, preformatted_block
from graphplan.site.shown_scenes import ShownScene, by_topic
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
        yield page.paragraph(shown_scenes.PURPOSE)
        if moving:
            title = tongue.title(by_name[moving].scene.title)
            yield Sight(shown_scenes.ANIMATION, title, by_name[moving].live or f"{moving}.html", escape(title)).figure
        yield "<ul>" + "".join(f"<li>{page.say(words)}</li>" for words in shown_scenes.AUDIENCES) + "</ul>"
        yield f"<h2>{page.say(said('Tutorial'))}</h2>"
        yield lesson_links(tongue)

    return page.page(tongue(said("Graphical analysis of planar mechanisms")), body())


def scenes_page(shown: Sequence[ShownScene], charts: Iterable[str], tongue: Tongue) -> str:
    """The page that leads to all scenes, by topic and by the words that one looks for, and shows the charts."""
    page, by_name = SitePage(tongue, SCENES), {card.name: card for card in shown}
    measured = [Sight(f"charts/{name}.svg", name, f"charts/{name}.svg") for name in charts]

    def body() -> Iterator[str]:
        yield page.paragraph(shown_scenes.CONSTRUCTED)
        yield f'<p><label>{page.say(said("Find a scene"))} <input type="search" id="filter"></label></p>'
        for topic, names in by_topic(by_name).items():
            yield f"<section><h2>{page.say(topic)}</h2>"
            yield cards(_card(page, by_name[name]) for name in names)
            yield "</section>"
        if measured:
            yield f"<h2>{page.say(shown_scenes.CHARTS)}</h2>"
            yield page.paragraph(shown_scenes.MEASURED)
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
