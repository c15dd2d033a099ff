"""How the package is worded, measured: names that say little, names of several meanings, how much there is to read.

A bare participle or adverb does not say what a function gives (`frame_reactions` does, `borne` does not), and a
variable called `found` may be anything. Each figure has a limit, which is only ever lowered, down to its aim.
"""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections import defaultdict
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple

import pytest
from sources import FILES, PACKAGE, parsed


class Limit(NamedTuple):
    """The most that a figure may be today, and what it is to come to."""

    today: float
    aim: float


LIMITS = {
    "functions named by a bare participle or adverb, %": Limit(0.5, 0.5),
    "assignments to names that say nothing, %": Limit(3.0, 3.0),
    "class names in several files": Limit(0, 0),
    "constants that name no quantity": Limit(2, 0),  # those that the live page's script reads by name
    "imports, % of the lines of code": Limit(11.3, 9.0),
    "lines of the longest file": Limit(400, 400),
    "tokens": Limit(950_950, 660_000),  # 942,849 before what other programs write is read whole, and said
}
SHARED_CLASS_NAMES: frozenset[str] = frozenset()  # may stand in several files, as they mean one thing


def word_set(text: str) -> frozenset[str]:
    """The words of a text."""
    return frozenset(text.split())


EMPTY = word_set(
    "found told held asked drawn shown known given made there here one other own what way ways size part parts seen "
    "left laid placed moved meant said wanted kept borne spoken rest things where others thing some both")
PARTICIPLES = word_set(  # the irregular ones that are no verb in the present tense, too
    "begun bent blurred bought broken brought built caught chosen dealt done drawn driven fallen felt fitted flown "
    "forgotten foreseen found given gone grown heard held hidden hung kept known laid lain leant led left lent lost "
    "made meant met mended paid ridden ringed risen rewritten said sat seen sent shaken shed shot shown slid "
    "slipped sought spoken stood struck stuck sunk swept swum swung taken thought thrown told torn tied trod "
    "understood undrawn unwritten withdrawn won worn woven written spun")
ADVERBS = word_set(
    "about above across after again against ahead alike alone along anywhere apart around aside at away back before "
    "behind below beneath beside besides between beyond by down each either else enough ever every far first "
    "forward further here home how in inside instead last least less likely little many more most much near nearest "
    "next now of off on once only onto onwards others out outer over past same so some somewhere sooner still such "
    "then thence there thereby through thus till to together too under until up upon upwards when whence where "
    "wherever which while whole why with within without")
NOUNS_IN_ED = word_set("bed embed feed need proceed seed shed speed")
VAGUE = word_set(
    "nothing hair most enough little longest near beside few rounds far apart along aside away close coarse fine "
    "finer faint farthest largest least less longer many more much same short sure tall thick thin thinnest wide "
    "wider widest wild shortest smallest greatest deepest together tried tries turned taken told struck unsure "
    "vague worse")
UNCOUNTED = {tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.COMMENT, tokenize.ENDMARKER}


def is_bare(function: str) -> bool:
    """Whether a function's name is a participle, an adverb or an empty word, and nothing else."""
    word = function.strip("_")
    participle = re.fullmatch("[a-z]+ed", word) is not None and word not in NOUNS_IN_ED
    return not function.startswith("__") and (participle or word in EMPTY | PARTICIPLES | ADVERBS)


@pytest.mark.parametrize(("function", "bare"), [
    ("_told", True), ("joined", True), ("_within", True), ("speed", False), ("joined_links", False), ("read", False),
    ("__init__", False),
])
def test_bare_names_are_seen(function: str, bare: bool) -> None:
    """A participle alone says little; with its noun, or as a verb, it says enough."""
    assert is_bare(function) == bare


def assigned_names(node: ast.AST) -> Iterator[str]:
    """The names that a statement, a loop or a comprehension assigns to."""
    match node:
        case ast.Assign(targets=targets):
            pass
        case ast.AnnAssign(target=target) | ast.NamedExpr(target=target) | ast.AugAssign(target=target) | (
                ast.For(target=target)) | ast.comprehension(target=target):
            targets = [target]
        case _:
            return
    for target in targets:
        yield from (inner.id for inner in ast.walk(target) if isinstance(inner, ast.Name)
                    and isinstance(inner.ctx, ast.Store))


def share(names: list[str], poor: list[str]) -> float:
    """The percentage of poor names."""
    return 100 * len(poor) / len(names)


def is_number(node: ast.expr | None) -> bool:
    """Whether an expression is a plain number, or reckoned from such."""
    arithmetic = (ast.Constant, ast.UnaryOp, ast.BinOp, ast.operator, ast.unaryop)
    return node is not None and all(isinstance(inner, arithmetic) for inner in ast.walk(node))


def vague_constants(path: Path) -> list[str]:
    """A file's constants that are numbers and do not name a quantity."""
    statements = [node for node in parsed(path).body if isinstance(node, ast.Assign | ast.AnnAssign)]
    return [name for node in statements if is_number(node.value) for name in assigned_names(node)
            if name.isupper() and name.strip("_").lower() in VAGUE]


def docstring_lines(path: Path) -> set[int]:
    """The numbers of the lines on which docstrings stand."""
    described = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    return {number for node in ast.walk(parsed(path)) if isinstance(node, described) and ast.get_docstring(node)
            for number in range(node.body[0].lineno, (node.body[0].end_lineno or 0) + 1)}


def code_lines(path: Path) -> int:
    """The number of a file's lines that are no docstring, comment or blank."""
    described = docstring_lines(path)
    return sum(1 for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
               if line.strip() and not line.strip().startswith("#") and number not in described)


def import_lines(path: Path) -> int:
    """The number of lines that a file's imports take, lazy ones included."""
    return sum((node.end_lineno or 0) - node.lineno + 1 for node in ast.walk(parsed(path))
               if isinstance(node, ast.Import | ast.ImportFrom))


def token_count(path: Path) -> int:
    """The number of a file's tokens, layout and comments apart."""
    text = io.StringIO(path.read_text(encoding="utf-8"))
    return sum(token.type not in UNCOUNTED for token in tokenize.generate_tokens(text.readline))


@cache
def figures() -> dict[str, tuple[float, list[str]]]:
    """Each figure of `LIMITS`, with the names or files that it counts."""
    functions, assigned, class_files = list[str](), list[str](), defaultdict[str, set[Path]](set)
    for path in FILES:
        for node in ast.walk(parsed(path)):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                functions.append(node.name)
            elif isinstance(node, ast.ClassDef):
                class_files[node.name].add(path)
            assigned += assigned_names(node)
    bare = [name for name in functions if is_bare(name)]
    empty = [name for name in assigned if name.strip("_") in EMPTY]
    shared = [name for name, files in class_files.items() if len(files) > 1 and name not in SHARED_CLASS_NAMES]
    vague = [f"{path.relative_to(PACKAGE)}:{name}" for path in FILES for name in vague_constants(path)]
    lengths = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in FILES}
    counted = [
        (share(functions, bare), bare), (share(assigned, empty), empty), (len(shared), shared), (len(vague), vague),
        (100 * sum(map(import_lines, FILES)) / sum(map(code_lines, FILES)), []),
        (max(lengths.values()), [str(path.relative_to(PACKAGE)) for path in FILES if lengths[path] > 390]),
        (sum(map(token_count, FILES)), []),
    ]
    return dict(zip(LIMITS, counted, strict=True))


@pytest.mark.parametrize("figure", LIMITS)
def test_no_figure_grows(figure: str) -> None:
    """What is counted stays within its limit."""
    value, names = figures()[figure]
    assert value <= LIMITS[figure].today, f"{figure}: {value:g}; aim {LIMITS[figure].aim:g}; {sorted(set(names))}"


def test_limits_are_not_below_their_aims() -> None:
    """Where a limit has come to its aim, it stays there."""
    assert all(limit.today >= limit.aim for limit in LIMITS.values())
