"""The reference: scene keys, pairs, primitives, commands, mistakes and results, each read from the records themselves.

The words of primitives, mistakes and failures are in the language of the page; those of keys, commands and results in
English, as the program itself prints them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from html import escape
from importlib import import_module

from graphplan.kernel import TABLE
from graphplan.kernel.kinds import FAILURES, LINE, PENCIL, Primitive
from graphplan.marking.judge.score import KINDS
from graphplan.marking.report_page import HtmlCell
from graphplan.mechanism import pairs
from graphplan.mechanism.schema import FORM, keys
from graphplan.phrases import Said, phrase, said
from graphplan.sheet.words.task import INSTRUMENTS
from graphplan.site.chapters import REFERENCE, SitePage, code_spans
from graphplan.words.tongue import Tongue

Table = tuple[Said, Said, Sequence[Said], Iterator[tuple[str, Sequence[HtmlCell]]]]
"""The title of a table, its caption, the heads of its columns, and its rows, each with its class."""

ANYTHING = {"point": "ABCDEFGHIJ", LINE: "abcdefg", "opening": "rs", "circle": "kl"}  # letters of operands, by kind
HANDS = INSTRUMENTS | {PENCIL: phrase("pencil")}


def reference(commands: Mapping[str, str], results: Mapping[str, Mapping[str, object] | Sequence[str]],
              tongue: Tongue) -> str:
    """The page, from the help of each command and from the tables of results."""
    page = SitePage(tongue, REFERENCE)
    tables = (_keys(), _pairs(), _primitives(page), _failures(page), _commands(commands), _mistakes(page),
              _results(results))

    def body() -> Iterator[str]:
        links = (f'<li><a href="#table-{number}">{page.say(table[0])}</a></li>' for number, table in enumerate(tables))
        yield f"<ul>{''.join(links)}</ul>"
        for number, table in enumerate(tables):
            yield f'<section id="table-{number}">'
            yield from page.table(*table)
            yield "</section>"

    return page.page(tongue(said("Reference")), body())


def _code(text: str) -> HtmlCell:
    return HtmlCell("<br>".join(f"<code>{escape(piece)}</code>" for piece in text.split("` or `")))


def _names(names: Iterable[str]) -> str:
    """Names of the program, each as code."""
    return ", ".join(f"`{name}`" for name in names)


def _text(text: object) -> HtmlCell:
    return HtmlCell(code_spans(escape(str(text))))


def _keys() -> Table:
    rows = ((row.level, (_text(row.key) if row.level == FORM else _code(row.key), _text(row.takes), _text(row.words)))
            for row in keys())
    return said("Keys of a scene"), said("All tables and keys of a scene file."), (
        said("Table or key"), said("Takes"), said("Meaning")), rows


def _pairs() -> Table:
    """Each kind of pair by what its file and its class say of it."""
    modules = {kind: import_module(f"{pairs.__name__}.{kind}") for kind in pairs.KINDS}
    rows = (("", (_code(kind), _text(_paragraph(module.__doc__)))) for kind, module in modules.items())
    return said("Pairs"), said("Connections between links, and drives."), (
        said("Pair"), said("Meaning")), rows


def _paragraph(doc: str | None) -> str:
    """The first paragraph of a docstring."""
    return " ".join((doc or "").strip().partition("\n\n")[0].split())


def _primitives(page: SitePage) -> Table:
    """Each operation of the drawing board as it is spoken, its instrument, what may fail, its forms and its source."""
    def further_lines(op: Primitive) -> Iterator[str]:
        if op.forms:
            yield page.tongue(said("forms: {0}", _names(op.forms)))
        if op.fails:
            yield page.tongue(said("may fail: {0}", _names(op.fails)))
        if op.source:
            yield page.tongue(said("source: {0}", op.source))

    rows = (("", (_code(op.name), _text(page.tongue(_sample_sentence(op))), _text(page.tongue(HANDS[op.instrument]())),
                  _text("; ".join(further_lines(op)))))
            for op in TABLE.values())
    summary = said("The operations of the drawing board: every step of a construction is one of these.")
    return said("Primitives"), summary, (
        said("Primitive"), said("Sentence"), said("Instrument"), said("More")), rows


def _sample_sentence(op: Primitive) -> Said:
    """The sentence of an operation of any marks."""
    letters = {kind: iter(names) for kind, names in ANYTHING.items()}
    read = [next(letters[kind]) for kind in op.reads]
    result = {"point": "X", LINE: "x"}.get(op.gives) or next(letters[op.gives])
    return op.sentence_of(read, out=result, **{name: f"`{name}`" for name in op.params})


def _failures(page: SitePage) -> Table:
    rows = (("", (_code(code), _text(page.tongue(why)), _text(page.tongue(remedy))))
            for code, (why, remedy) in FAILURES.items())
    return said("Failures"), said("Reasons why a step cannot be drawn in a pose, with remedies."), (
        said("Failure"), said("Meaning"), said("Remedy")), rows


def _commands(commands: Mapping[str, str]) -> Table:
    rows = (("", (_code(name), HtmlCell(f"<pre>{escape(command)}</pre>"))) for name, command in commands.items())
    return said("Commands"), said("What `graphplan COMMAND --help` prints."), (said("Command"), said("Help")), rows


def _mistakes(page: SitePage) -> Table:
    rows = (("", (_code(kind), _text(page.tongue(words())))) for kind, words in KINDS.items())
    return said("Mistakes"), said("The kinds of mistakes that `verify` tells, as `--weights` names them."), (
        said("Mistake"), said("Meaning")), rows


def _results(results: Mapping[str, Mapping[str, object] | Sequence[str]]) -> Table:
    def rows() -> Iterator[tuple[str, Sequence[HtmlCell]]]:
        for name, table in results.items():
            alternatives = "" if isinstance(table, Mapping) else table if isinstance(table, str) else "|".join(table)
            yield "head", (_code(name), _text(alternatives), _text(""))
            for key, told in table.items() if isinstance(table, Mapping) else ():
                kind, _, words = str(told).partition(", ")
                yield "", (_code(key), _text(kind), _text(words))

    caption = said("The JSON output, table by table; ? marks optional entries, [] a list, {{}} a table by name.")
    return said("Results"), caption, (said("Table or key"), said("Takes"), said("Meaning")), rows()
