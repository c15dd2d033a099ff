"""The site: its pages share a frame and a head that leads from one to the other; nothing is fetched from elsewhere."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from importlib.util import find_spec
from typing import NamedTuple

from graphplan.output.report_page import HtmlPage
from graphplan.phrases import Said, said

INDEX, TUTORIAL, REFERENCE = "index.html", "tutorial.html", "reference.html"
MANUAL = "manual"  # the folder of the chapters
CONTENTS = f"{MANUAL}/index.html"
PLACES = {INDEX: said("Scenes"), TUTORIAL: said("Tutorial"), CONTENTS: said("Manual"), REFERENCE: said("Reference")}


def has_chapters() -> bool:
    """Whether the library that renders the chapters is installed."""
    return find_spec("markdown_it") is not None


class Sight(NamedTuple):
    """A picture of the site, what it shows, and where it leads."""

    picture: str
    shows: str
    leads: str
    caption: str = ""

    @property
    def figure(self) -> str:
        """The picture as HTML; its caption is HTML."""
        caption = f"<figcaption>{self.caption}</figcaption>" if self.caption else ""
        image = f'<img src="{self.picture}" alt="{escape(self.shows)}" loading="lazy">'
        return f'<figure><a href="{self.leads}">{image}</a>{caption}</figure>'


@dataclass(frozen=True)
class SitePage(HtmlPage):
    """A page of the site in a tongue; `here` is its path in the site."""

    here: str

    def page(self, title: str, body: Iterable[str], pictures: str = "") -> str:
        """The whole page; the body is HTML."""
        fields = {"language": self.tongue.code, "title": f"graphplan: {escape(title)}", "places": self._places(),
                  "body": "\n".join([f"<h1>{escape(title)}</h1>", *body])}
        text = files(__package__).joinpath("site.html").read_text("utf-8")
        return re.sub(r"\{\{(\w+)\}\}", lambda slot: fields[slot[1]], text)

    def paragraph(self, told: Said) -> str:
        """Words as a paragraph; what stands in ` is code."""
        return f"<p>{code_spans(self.say(told))}</p>"

    @property
    def root(self) -> str:
        """The way from this page to the site's own folder."""
        return "../" * self.here.count("/")

    def _places(self) -> str:
        current = ' aria-current="page"'
        return "\n".join(f'<a href="{self.root}{name}"{current if name == self.here else ""}>{self.say(words)}</a>'
                         for name, words in PLACES.items() if name != CONTENTS or has_chapters())


def code_spans(html: str) -> str:
    """Words as HTML in which what stands in ` is code."""
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", html)


def cards(sights: Iterable[Sight]) -> str:
    """Pictures beside each other."""
    return '<div class="cards">\n' + "\n".join(sight.figure for sight in sights) + "\n</div>"
