"""The manual's chapters in Markdown as pages, the tables made from records, and the reference of the Python names.

The chapters of the manual: Markdown files of the package, and the same as pages of the site.

A chapter is read on a code host as it stands: links and pictures are relative to its file. On the site they lead to the
page or file that they mean, as far as the site has it; else the words stand alone. A table that the records give is
no text of a chapter: a paragraph which is a link to the table's page, such as `tables/scene-keys.md`, stands in its
place, and on the site the table itself.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from importlib.resources import files
from importlib.util import find_spec
from types import ModuleType
from typing import TYPE_CHECKING, Any, NamedTuple

import graphplan
from graphplan import leaves
from graphplan.marking.report_page import HtmlPage
from graphplan.mechanism.schema import reference
from graphplan.phrases import Said, said
from graphplan.words.tongue import Tongue

if TYPE_CHECKING:
    from markdown_it.token import Token

INDEX, SCENES, TUTORIAL, REFERENCE = "index.html", "scenes.html", "tutorial.html", "reference.html"
MANUAL = "manual"  # the folder of the chapters
MANUAL_PAGE = f"{MANUAL}/index.html"
PLACES = {INDEX: said("Start"), SCENES: said("Scenes"), TUTORIAL: said("Tutorial"), MANUAL_PAGE: said("Manual"),
          REFERENCE: said("Reference")}


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
                         for name, words in PLACES.items() if name != MANUAL_PAGE or has_chapters())


def preformatted_block(text: str) -> str:
    """Text as it is written; the keyboard reaches it, as it may have to be scrolled."""
    return f'<pre tabindex="0">{escape(text)}</pre>'


def code_spans(html: str) -> str:
    """Words as HTML in which what stands in ` is code."""
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", html)


def cards(sights: Iterable[Sight]) -> str:
    """Pictures beside each other."""
    return '<div class="cards">\n' + "\n".join(sight.figure for sight in sights) + "\n</div>"


CONTENTS = "README"  # the chapter that lists all others
SITE = "../../../gallery/"  # the site of the packaged scenes, as a chapter's links name it
PAGES = {"README.md": SCENES, "tutorial.md": TUTORIAL}  # what is Markdown there for a code host, and its page
TABLES = "tables"  # the folder of the tables' pages
_TABLE = re.compile(rf"(?m)^\[[^\]]*\]\({re.escape(SITE)}{TABLES}/([\w-]+)\.md\)$")


def chapters() -> dict[str, str]:
    """The Markdown text of each chapter by its name."""
    folder = files(__package__).joinpath("chapters")
    texts = {path.name: path.read_text("utf-8") for path in folder.iterdir() if path.name.endswith(".md")}
    return {name.removesuffix(".md"): texts[name] for name in sorted(texts)}


def titles() -> dict[str, Said]:
    """The titles of the tables' pages, by name."""
    keys = {f"{name}-keys": kind.keys for name, kind in leaves.tasks().items()}
    return {"scene-keys": said("Keys of a scene"), **keys, "commands": said("Commands"),
            "python": said("Python reference")}


def tables(commands: Mapping[str, str]) -> dict[str, str]:
    """The tables that the records give, as Markdown by their names, from the summary of each command."""
    rows = (f"| `graphplan {name}` | {summary} |" for name, summary in commands.items())
    keys = {f"{name}-keys": reference(leaves.module(kind.module).TASK) for name, kind in leaves.tasks().items()}
    listed = "\n".join(["| command | what it does |", "|---|---|", *rows, ""])
    return {"scene-keys": reference(), **keys, "commands": listed, "python": python_reference()}


def table_pages(texts: Mapping[str, str], tongue: Tongue) -> dict[str, str]:
    """Each table as a page of its own, for a code host, by its path in the site."""
    return {f"{TABLES}/{name}.md": f"# {tongue(titles()[name])}\n\n{text}" for name, text in texts.items()}


def chapter_pages(texts: Mapping[str, str], site: Collection[str], tongue: Tongue) -> Iterator[tuple[str, str]]:
    """Every chapter as a page, by its path in the site; `texts` are the tables, `site` the paths of its other files."""
    for name, text in chapters().items():
        page = ChapterPage(tongue, page_of(name), frozenset(site))
        yield page.here, page.chapter(_TABLE.sub(lambda link: texts[link[1]], text))


def page_of(name: str) -> str:
    """The path in the site of a chapter."""
    return f"{MANUAL}/{'index' if name == CONTENTS else name}.html"


def anchor(head: str) -> str:
    """Anchor of a heading as code hosts make it: lower case, words joined by hyphens."""
    return re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-")


@dataclass(frozen=True)
class ChapterPage(SitePage):
    """A chapter as a page of a site that has these files."""

    site: frozenset[str]

    def chapter(self, text: str) -> str:
        """The page of a chapter that begins with its title."""
        from markdown_it import MarkdownIt

        markdown = MarkdownIt("commonmark").enable("table")
        title, *tokens = self._resolve_links(markdown.parse(text))[1:]
        body = markdown.renderer.render(tokens[1:], markdown.options, {})
        body = body.replace("<table>", '<div class="wide" tabindex="0"><table>').replace("</table>", "</table></div>")
        body = body.replace("<pre>", '<pre tabindex="0">')
        return self.page(title.content, [*self._language(), f'<article lang="en">\n{body}</article>'])

    def _language(self) -> Iterator[str]:
        """The remark of a site in another language."""
        if self.tongue.code != "en":
            yield self.paragraph(said("This chapter is in English."))

    def _resolve_links(self, tokens: Sequence[Token]) -> Sequence[Token]:
        """The tokens with names of their heads, and with addresses as the site has them."""
        for token, following in zip(tokens, [*tokens[1:], None], strict=True):
            if token.type == "heading_open" and following:
                token.attrSet("id", anchor(following.content))
            if token.children:
                token.children = [*self._address_links(token.children)]
        return tokens

    def _address_links(self, tokens: Sequence[Token]) -> Iterator[Token]:
        """The tokens of a paragraph; a link or a picture that leads out of the site leaves its words."""
        leads_out = False
        for token in tokens:
            name = {"link_open": "href", "image": "src"}.get(token.type)
            if name:
                address = self.address(str(token.attrGet(name)))
                token.attrSet(name, address or "")
                if token.type == "image" and not address:
                    yield from token.children or ()
                    continue
                leads_out = not address
            if not (leads_out and token.type in ("link_open", "link_close")):
                yield token

    def address(self, link: str) -> str:
        """Address on the site of a chapter's link; empty if the site does not have it."""
        path, mark, head = link.partition("#")
        if not path:
            return link
        if chapter := re.fullmatch(r"([\w-]+)\.md", path):
            return f"{self.root}{page_of(chapter[1])}{mark}{head}"
        if not path.startswith(SITE):
            return ""
        target = path.removeprefix(SITE)
        target = PAGES.get(target, target)
        return f"{self.root}{target}" if target in self.site else ""


HEAD = """\
The public names of `import graphplan as gp`, from their docstrings. Lengths, forces and masses are in the scene's
units, angles and travels in degrees, rates in rad/s; vectors are complex numbers.
"""
GROUPS = {
    "Scenes": "scene load parse at Scene WrittenScene",
    "Constructions and results": "construct solve Construction WorkingDrawing Results",
    "Poses": "follow PoseSeries MotionSeries MotionStream Summary",
    "Machines and cams": "report flywheel motion balance cam synthesize position_errors Subject SynthesisResults",
    "Teaching and sharing": "handout live variants verify Findings",
    "Modules": "analytic cycle sheet",
    "Errors": "GraphplanError SceneError Refused SingularPose NoMechanism Disagreement ConstructionError",
}


def python_reference() -> str:
    """All public names in their groups, as Markdown; those of no group stand at the end."""
    grouped = " ".join(GROUPS.values()).split()
    groups = {**GROUPS, "More": " ".join(name for name in graphplan.__all__ if name not in grouped)}
    sections = (f"## {title}\n\n" + "\n".join(map(_entry, names.split())) for title, names in groups.items() if names)
    return "\n".join([HEAD, *sections])


def _entry(name: str) -> str:
    """A public name: how it is called, and what its docstring says; of a class and a module what it has, too."""
    thing = getattr(graphplan, name)
    if isinstance(thing, ModuleType):
        public = [inner for inner in getattr(thing, "__all__", ()) or vars(thing) if _is_function(thing, inner)]
        members = [_member(f"gp.{name}.{inner}", getattr(thing, inner)) for inner in public]
        return "\n".join([f"### gp.{name}\n", f"{_text(thing)}\n", *members])
    if not inspect.isclass(thing):
        return f"### gp.{name}\n\n```python\ngp.{name}{_signature(thing)}\n```\n\n{_text(thing)}\n"
    members = [_member(inner, value) for inner, value in _public_members(thing)]
    return "\n".join([f"### class gp.{name}\n", f"{_text(thing)}\n", *members, *([""] if members else [])])


def _is_function(module: ModuleType, name: str) -> bool:
    thing = getattr(module, name)
    return not name.startswith("_") and inspect.isfunction(thing) and (
        name in getattr(module, "__all__", ()) or thing.__module__ == module.__name__)


def _public_members(kind: type) -> Iterator[tuple[str, Any]]:
    """The methods and properties of a class and of those of graphplan that it extends."""
    names: dict[str, Any] = {}
    for base in reversed(kind.__mro__):
        if base.__module__.startswith("graphplan.") and not issubclass(base, Exception):
            names |= {name: value for name, value in vars(base).items() if not name.startswith("_")}
    for name, value in names.items():
        inner = getattr(value, "fget", None) or getattr(value, "func", None) or value
        if inspect.isfunction(inner) and inner.__doc__:
            yield (f"{name}{_signature(inner)}" if inspect.isfunction(value) else name), inner


def _member(call: str, thing: Any) -> str:
    """A line of a list: how it is called, and the first sentences of what is said of it."""
    first = " ".join((inspect.getdoc(thing) or "").split("\n\n")[0].split())
    call = call if "(" in call or not call.startswith("gp.") else f"{call}{_signature(thing)}"
    return f"- `{call}`: {_markdown(first)}"


def _signature(thing: Any) -> str:
    """Parameters with their types and defaults, without the module of a name."""
    signature = inspect.signature(thing)
    own = [parameter for name, parameter in signature.parameters.items() if name != "self"]
    text = re.sub(r"(: |-> )'([^']*)'", r"\1\2", str(signature.replace(parameters=own)))
    return re.sub(r"\b(?:typing|os|collections\.abc)\.", "", re.sub(r"<function .*? at 0x[0-9a-f]+>", "...", text))


def _text(thing: Any) -> str:
    return _markdown(inspect.getdoc(thing) or "")


def _markdown(text: str) -> str:
    """A docstring in Markdown: other names of graphplan as code."""
    return re.sub(r":(?:class|func|meth):`([^`]+)`", r"`\1`", text)
