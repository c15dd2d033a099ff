"""Wording and size of the package, as far as linters do not see them: `python tests/lint.py` prints a line a fault.

A bare participle or adverb does not say what a function gives (`frame_reactions` does, `borne` does not), and a
variable called `found` may be anything. Each figure has a limit, which is only ever lowered. Numbers of rounding and
what a drawing is judged by stand in tables, one a room, each with the size that it is a part of, or its unit, and why.
"""

from __future__ import annotations

import ast
import re
import sys
import tokenize
from collections import defaultdict
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import grimp

import graphplan
from graphplan.kernel import TABLE

PACKAGE = Path(graphplan.__file__).parent
LIMITS = {
    "functions named by a bare participle or adverb, %": 0.5,
    "assignments to names that say nothing, %": 3.0,
    "imports, % of the lines of code": 10.6,
    "lines of the longest file": 800,
    "numeric constants": 1150,
    "tokens": 952_000,
}


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
READ_BY_THE_PAGE = {"sheet/plates/symbols.py"}  # its constants are the names that the page's script has
UNCOUNTED = {tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.COMMENT, tokenize.ENDMARKER}

# Small numbers that are none of rounding: lines of scales, what was measured, what may be asked for.
REASONED = {
    "bench/machine.py": word_set("1e-12 1e-16 1e-20 1e-40"),  # the ends of an axis, and proven digits
    "bench/stability.py": word_set("1e-4 1e-8"),  # of 100 mm, at an axis
    "public/subjects.py": word_set("1e-9"),  # the least tolerance that --tolerance takes
    "marking/scans/measures.py": word_set("6e-4 1e-5"),  # the grain of paper, and its stiffness, measured
}
MEASURED = r".{8,} \[(practice|measured|tuned|defined|cost|assumed)\]"  # how a number of the judge was found
NO_MEASURES = word_set("SENSES FROM_POINTS UNMARKED DEEDS SURVIVAL STDERR PLACES REFERENCES OTHER_SIDES MB")

# Words that name an operation and something else as well: an element of SVG, a key of a scene, a kind of vector.
OTHER_SENSES = word_set("line circle opening radius given pick begin balance couple normal conjugate crank")
OPERATIONS = set(TABLE) - OTHER_SENSES
CUTTING = word_set("startswith endswith partition rpartition removeprefix removesuffix split find")
# What bears a plan, a kind of result, a law, a reason or a form, by the word that it goes by.
NAMED = word_set("panel home kind quantity law why reason form")
READERS = word_set(  # what is no such name there: rows of surveys, and a dyad's form
    "bench/draughtsman.py bench/growth.py bench/machine.py mechanism/structure.py")
LAZY = word_set("__init__.py commands.py leaves.py bench/command.py mechanism/load_values.py "
                "mechanism/pairs/__init__.py output/__init__.py site/reference.py solver/__init__.py")


class File:
    """A file of the package: its text, its syntax, what stands in it."""

    def __init__(self, path: Path, text: str = ""):
        self.path, self.text = path, text or path.read_text(encoding="utf-8")
        self.tree = ast.parse(self.text)
        self.nodes = [*ast.walk(self.tree)]
        self.lines = self.text.splitlines()

    @property
    def name(self) -> str:
        return str(self.path.relative_to(PACKAGE)) if self.path.is_relative_to(PACKAGE) else str(self.path)

    def constants(self) -> dict[str, ast.Assign | ast.AnnAssign]:
        """The assignments of the module to names of its own."""
        nodes = [node for node in self.tree.body if isinstance(node, ast.Assign | ast.AnnAssign)]
        return {name: node for node in nodes for name in assigned_names(node) if name.isupper()}

    def comment(self, node: ast.stmt) -> str:
        """The comment beside a statement and on the lines above it."""
        above, words = node.lineno - 2, [self.lines[node.lineno - 1].partition("  # ")[2]]
        while above >= 0 and self.lines[above].startswith("# ") and not self.lines[above].startswith("# ----"):
            words.insert(0, self.lines[above].removeprefix("# "))
            above -= 1
        return " ".join(filter(None, words))

    def tokens(self) -> list[tokenize.TokenInfo]:
        """The tokens, without layout and comments."""
        lines = iter(self.text.splitlines(keepends=True))
        return [token for token in tokenize.generate_tokens(lambda: next(lines, "")) if token.type not in UNCOUNTED]

    def code_lines(self) -> int:
        """The number of lines that are no docstring, comment or blank."""
        described = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
        docstrings = {number for node in self.nodes if isinstance(node, described) and ast.get_docstring(node)
                      for number in range(node.body[0].lineno, (node.body[0].end_lineno or 0) + 1)}
        return sum(bool(line.strip()) and not line.strip().startswith("#") and number not in docstrings
                   for number, line in enumerate(self.lines, 1))


# --- figures ---------------------------------------------------------------------------------------------------------


def is_bare(function: str) -> bool:
    """Whether a function's name is a participle, an adverb or an empty word, and nothing else."""
    word = function.strip("_")
    participle = re.fullmatch("[a-z]+ed", word) is not None and word not in NOUNS_IN_ED
    return not function.startswith("__") and (participle or word in EMPTY | PARTICIPLES | ADVERBS)


def assigned_names(node: ast.AST) -> Iterator[str]:
    """The names that a statement, a loop or a comprehension assigns to."""
    targets = getattr(node, "targets", [getattr(node, "target", None)])
    for target in targets if not isinstance(node, ast.Delete) else ():
        yield from (inner.id for inner in ast.walk(target or ast.Pass()) if isinstance(inner, ast.Name)
                    and isinstance(inner.ctx, ast.Store))


def is_number(node: ast.expr | None) -> bool:
    """Whether an expression is a plain number, or reckoned from such."""
    arithmetic = (ast.Constant, ast.UnaryOp, ast.BinOp, ast.operator, ast.unaryop)
    return node is not None and all(isinstance(inner, arithmetic) for inner in ast.walk(node)) and any(
        isinstance(inner, ast.Constant) and isinstance(inner.value, int | float) for inner in ast.walk(node))


def too_large(files: list[File]) -> Iterator[str]:
    """The figures that are above their limits."""
    functions = [node.name for file in files for node in file.nodes
                 if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]
    names = [name for file in files for node in file.nodes for name in assigned_names(node)]
    empty = [name for name in names if name.strip("_") in EMPTY]
    imports = sum((node.end_lineno or 0) - node.lineno + 1 for file in files for node in file.nodes
                  if isinstance(node, ast.Import | ast.ImportFrom))
    figures = (100 * sum(map(is_bare, functions)) / len(functions), 100 * len(empty) / len(names),
               100 * imports / sum(file.code_lines() for file in files), max(len(file.lines) for file in files),
               sum(is_number(node.value) for file in files for node in file.constants().values()),
               sum(len(file.tokens()) for file in files))
    for (what, limit), figure in zip(LIMITS.items(), figures, strict=True):
        if figure > limit:
            yield f"graphplan: {what}: {figure:,.2f}; at most {limit:,}"


# --- names and numbers -----------------------------------------------------------------------------------------------


def vague_constants(file: File) -> Iterator[str]:
    """A constant that is a number names the quantity that it bounds."""
    yield from (f"{file.name}:{node.lineno}: {name} names no quantity" for name, node in file.constants().items()
                if is_number(node.value) and name.strip("_").lower() in VAGUE and file.name not in READ_BY_THE_PAGE)


def loose_numbers(file: File) -> Iterator[str]:
    """Outside the tables stands no small number but the reasoned ones."""
    for token in file.tokens() if file.path.name != "tolerances.py" else ():
        small = token.type == tokenize.NUMBER and "e-" in token.string.lower() and float(token.string) < 1e-3
        if small and token.string not in REASONED.get(file.name, ()):
            yield f"{file.name}:{token.start[0]}: {token.string} stands in tolerances.py of its room, with its reason"


def unexplained(file: File) -> Iterator[str]:
    """Each entry of a table says of what it is a part, or its unit, and why; one of the judge's how it was found."""
    reason = {"tolerances.py": r".*(\w+.*:|\w+ \w+ \w+).*", "measures.py": MEASURED}.get(file.path.name)
    for name, node in file.constants().items() if reason else ():
        if name not in NO_MEASURES and not isinstance(getattr(node.value, "value", 0), str) and not re.fullmatch(
                str(reason), file.comment(node)):
            yield f"{file.name}:{node.lineno}: {name} says of what, and why"


def unused(files: list[File]) -> Iterator[str]:
    """Each entry of a table is read somewhere."""
    for table in files:
        if table.path.name not in ("tolerances.py", "measures.py"):
            continue
        users = [file.text for file in files if file is not table and table.path.stem in file.text]
        yield from (f"{table.name}:{node.lineno}: {name} is not used" for name, node in table.constants().items()
                    if not any(re.search(rf"\b{name}\b", text) for text in users))


def shared_class_names(files: list[File]) -> Iterator[str]:
    """A class has a name of its own."""
    homes = defaultdict[str, set[str]](set)
    for file in files:
        for node in file.nodes:
            if isinstance(node, ast.ClassDef):
                homes[node.name].add(file.name)
    yield from (f"{', '.join(sorted(found))}: class {name} in several files" for name, found in homes.items()
                if len(found) > 1)


# --- what hangs on what ----------------------------------------------------------------------------------------------


def told_by_name(file: File) -> Iterator[str]:
    """Outside the kernel nothing hangs on an operation's name: what is to be known of it stands in its record."""
    spoken = {id(inner) for node in file.nodes if isinstance(node, ast.FormattedValue) for inner in ast.walk(node)}
    spoken |= {id(value) for node in file.nodes if isinstance(node, ast.Dict) for value in node.values}
    for node in file.nodes if not file.name.startswith("kernel/") else ():
        names: list[ast.expr | None] = []
        match node:
            case ast.Attribute(attr="name", value=ast.Attribute(attr="op")) if id(node) not in spoken:
                yield f"{file.name}:{node.lineno}: an operation is told by its name; ask its movement, root, crossing"
            case ast.Dict(keys=keys):
                names = keys
            case ast.Compare(comparators=[ast.Tuple(elts=elements) | ast.Set(elts=elements)]):
                names = [*elements]
            case ast.MatchValue(value=value):
                names = [value]
        yield from (f"{file.name}:{name.lineno}: an operation is told by its name" for name in names
                    if isinstance(name, ast.Constant) and name.value in OPERATIONS)


def cut_names(file: File) -> Iterator[str]:
    """No plan, kind of result, law or form is found by cutting its name or by comparing words."""
    for node in file.nodes if file.name not in READERS else ():
        match node:
            case ast.Call(ast.Attribute(ast.Name(word) | ast.Attribute(attr=word), verb)) if (
                    word in NAMED and verb in CUTTING):
                yield f"{file.name}:{node.lineno}: a name is cut"
            case ast.Compare(ast.Attribute(attr="why" | "reason"), comparators=[ast.Constant(str()), *_]):
                yield f"{file.name}:{node.lineno}: words are compared"
            case ast.Compare(ast.Constant(str()), [ast.In() | ast.NotIn()], [ast.Name(word) | ast.Attribute(attr=word)]
                             ) if word in NAMED:
                yield f"{file.name}:{node.lineno}: a word is looked for in a name"


def hidden_imports(file: File) -> Iterator[str]:
    """A module is imported by its name put together only where registries are."""
    if "import_module" in file.text and file.name not in LAZY:
        yield f"{file.name}: imports by a name, which no contract of rooms sees"


def circles(graph: grimp.ImportGraph) -> Iterator[str]:
    """No file imports one that imports it, at its top, in a function or for the type checker alone."""
    modules = graph.modules - {"graphplan"}
    try:
        TopologicalSorter({module: graph.find_modules_directly_imported_by(module) & modules - {module}
                           for module in modules}).prepare()
    except CycleError as error:
        yield f"files in a circle: {' -> '.join(error.args[1])}"


OF_A_FILE = vague_constants, loose_numbers, unexplained, told_by_name, cut_names, hidden_imports
OF_ALL = too_large, unused, shared_class_names


def main() -> int:
    """Prints all faults; the exit status is 1 where there is one."""
    files = [File(path) for path in sorted(PACKAGE.rglob("*.py"))]
    faults = [fault for rule in OF_A_FILE for file in files for fault in rule(file)]
    faults += [fault for rule in OF_ALL for fault in rule(files)]
    faults += circles(grimp.build_graph("graphplan", exclude_type_checking_imports=False))
    print(*faults, sep="\n", end="\n" if faults else "")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
