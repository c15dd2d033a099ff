"""The arrows between the folders, read from all imports: errors <- kernel <- methods, and so on."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator, Mapping
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import pytest
from each import each
from sources import FILES, PACKAGE, parsed

from graphplan.kernel import TABLE

ROOT = Path(__file__).parent.parent

# What a folder may import from graphplan, itself apart. `commands` and the front door may import anything.
MAY = {
    "errors": set(),
    "phrases": set(),
    "threads": set(),
    "words": {"errors", "phrases"},
    "kernel": {"errors", "phrases"},
    "mechanism": {"errors", "phrases", "words"},
    "solver": {"errors", "mechanism"},
    "methods": {"errors", "phrases", "kernel", "mechanism"},
    "sheet": {"errors", "phrases", "words", "kernel", "mechanism", "methods"},
    "output": {"errors", "phrases", "words", "kernel", "mechanism", "methods", "sheet", "marking", "cycle",
               "check", "accuracy", "cams", "machine", "synthesis"},
    "marking": {"errors", "phrases", "threads", "words", "kernel", "mechanism", "methods", "sheet", "accuracy"},
    "importing": {"errors", "marking", "mechanism"},
    "cycle": {"errors", "phrases", "kernel", "mechanism", "methods", "sheet"},
    "cams": {"errors", "phrases", "kernel", "mechanism"},
    "synthesis": {"errors", "phrases", "kernel", "mechanism", "cycle"},
    "machine": {"errors", "phrases", "kernel", "mechanism", "methods", "cycle"},
    "check": {"errors", "phrases", "kernel", "mechanism", "methods", "solver", "cycle", "cams", "machine",
              "synthesis"},
    "accuracy": {"errors", "phrases", "words", "kernel", "mechanism", "methods", "solver", "cycle", "check", "sheet",
                 "cams", "machine"},
}
FRONT = {"__init__", "__main__", "commands", "public"}

# Who may import what does not come with Python.
OUTSIDE = {
    "matplotlib": {"output/png.py"},
    "PIL": {"output/animation.py"},  # it comes with matplotlib
    "svgwrite": {"output/svg.py"},
    "shapely": {"sheet", "marking", "cams"},
    "ezdxf": {"output", "marking"},
    "cv2": {"marking"},
    "pypdfium2": {"marking"},
    "svgelements": {"marking"},
    "openpyxl": {"marking/classroom/spreadsheet.py"},
    "llvmlite": {"kernel/tape/compiled.py"},
    "distributed": {"methods/executors.py"},
    "flint": {"kernel/numbers/enclosures.py"},
    "shtab": {"commands/completion.py"},
    "markdown_it": {"output/manual/chapters.py"},
}
# Where the kernel reckons beyond Python alone.
NUMBERS = {*(f"kernel/numbers/{domain}.py" for domain in ("arrays", "gradients", "enclosures")),
           *(f"kernel/tape/{reading}.py" for reading in ("blocks", "machine", "compiled"))}


def folder(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def named(path: Path) -> str:
    return str(path.relative_to(PACKAGE))


def dotted(path: Path) -> str:
    """The module of a file."""
    return ".".join(("graphplan", *path.relative_to(PACKAGE).with_suffix("").parts)).removesuffix(".__init__")


MODULES = {dotted(path): path for path in FILES}


@cache
def imports(path: Path) -> frozenset[str]:
    """The modules that a file imports: at its top, in functions, for the type checker alone, and by their names."""
    return frozenset(name for node in ast.walk(parsed(path)) for name in _imported(node))


def _imported(node: ast.AST) -> Iterator[str]:
    """The modules that are imported at one place; of a name that is put together, the package that it begins with."""
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
    elif isinstance(node, ast.ImportFrom):
        assert node.level == 0, f"{ast.unparse(node)}: imports are absolute"
        inner = [f"{node.module}.{alias.name}" for alias in node.names]
        yield from (name if name in MODULES else str(node.module) for name in inner)
    elif isinstance(node, ast.Call) and node.args and ast.unparse(node.func).endswith(("import_module", "__import__")):
        name = node.args[0].values[0] if isinstance(node.args[0], ast.JoinedStr) else node.args[0]
        if isinstance(name, ast.Constant):
            yield str(name.value).removesuffix(".")


def inside(path: Path) -> set[str]:
    """The folders of graphplan that a file imports from."""
    return {name.split(".")[1] for name in imports(path) if name.startswith("graphplan.")}


def outside(path: Path) -> set[str]:
    """The packages beyond graphplan and Python that a file imports."""
    return {name.split(".")[0] for name in imports(path)} - set(sys.stdlib_module_names) - {"graphplan"}


DOORS = {"sheet/__init__.py"}  # calls the back end, as users do: `gp.sheet.svg(drawing)`
LAYERED = [path for path in FILES if folder(path) not in FRONT and named(path) not in DOORS]


@each("path", LAYERED, ids=named)
def test_arrows(path: Path) -> None:
    """A file imports from its own folder and from those below it."""
    assert folder(path) in MAY, f"say in MAY what {folder(path)} may import"
    assert inside(path) - {folder(path)} <= MAY[folder(path)]


def test_no_circles_of_rooms() -> None:
    """What a folder imports, by whatever way, does not import it."""
    below = {room: set[str]() for room in MAY}
    for path in LAYERED:
        below[folder(path)] |= inside(path) - {folder(path)}
    for arrows in (below, MAY):
        TopologicalSorter(arrows).prepare()  # fails where arrows run in a circle


# Circles of files that are still there: each is to be opened.
KNOWN: set[str] = set()


def test_no_circles_of_files() -> None:
    """No file imports one that imports it, at its top, in a function or for the type checker alone."""
    below = {path: {MODULES[name] for name in imports(path) if name in MODULES} - {path} for path in FILES}
    assert {named(path) for path in FILES if path in reached(path, below)} <= KNOWN


def reached(path: Path, below: Mapping[Path, set[Path]]) -> set[Path]:
    """All files that a file imports, and those that these import, and so on."""
    found, left = set[Path](), [path]
    while left:
        new = below.get(left.pop(), set()) - found
        found |= new
        left += new
    return found


def test_there_are_seventeen_rooms() -> None:
    """graphplan has seventeen folders of code, the public layer and synthesis among them."""
    assert len({folder(path) for path in FILES if path.parent != PACKAGE}) <= 17


@each("path", FILES, ids=named)
def test_outside_packages(path: Path) -> None:
    """matplotlib and svgwrite serve writers alone; what the kernel computes with stands in its number domains."""
    found = outside(path)
    for package, users in OUTSIDE.items():
        assert package not in found or users & {folder(path), named(path)}
    assert found <= {"numpy", *OUTSIDE}
    if folder(path) in ("errors", "kernel") and named(path) not in NUMBERS:
        assert not found


@each("path", FILES, ids=named)
def test_files_are_short(path: Path) -> None:
    """No file is longer than 400 lines, and none is a drawer for odds and ends."""
    assert len(path.read_text().splitlines()) <= 400
    assert path.stem not in {"utils", "helpers", "common", "util", "misc"}


def test_a_flywheel_loads_neither_masked_arrays_nor_pools() -> None:
    """A machine's numbers load neither numpy's masked arrays, which take as long as numpy, nor what shares work out."""
    code = ("import sys; from graphplan.commands import main; "
            "assert main(['flywheel', 'ozols-13-6', '--positions', '12']) == 0; "
            "print({'numpy.ma', 'multiprocessing', 'concurrent.futures'} & set(sys.modules), file=sys.stderr)")
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.stderr.strip().endswith("set()"), done.stderr


def test_a_command_loads_no_more_than_it_needs() -> None:
    """Importing graphplan loads no folder of it; solving loads no other command, no sheet, no back end, not
    numpy where eight links have no loads, and none of the packages that draw."""
    code = ("import sys, graphplan; print([m for m in sys.modules if m.startswith('graphplan.')], file=sys.stderr); "
            "from graphplan.commands import SUBCOMMANDS, main; assert main(['solve', 'alt-eight-link']) == 0; "
            "others = {f'graphplan.commands.{name}' for name in SUBCOMMANDS} - {'graphplan.commands.solve'}; "
            "unused = [m for m in sys.modules"
            " if m in others or m.startswith(('graphplan.sheet', 'graphplan.output'))"
            " or m in ('matplotlib', 'shapely', 'svgwrite', 'numpy')]; "
            "print(unused, file=sys.stderr)")
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.stderr.split() == ["[]", "[]"], done.stderr


FORCES = ("methods.forces", "check.forces", "solver.statics", "solver.friction")


@pytest.mark.parametrize(("scene", "touched"), [("four-bar", False), ("jaanimets-10", True)])
def test_scenes_without_loads_touch_no_force_code(scene: str, touched: bool) -> None:
    """What forces need is imported where there are loads, and nowhere else."""
    code = ("import sys; from graphplan.commands import main; "
            f"assert main(['solve', {scene!r}]) == 0; assert main(['draw', {scene!r}]) == 0; "
            f"print([m for m in {FORCES!r} if 'graphplan.' + m in sys.modules], file=sys.stderr)")
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.stderr.strip() == str(list(FORCES) if touched else []), done.stderr


# Words that name an operation and something else as well: an element of SVG, a key of a scene, a kind of vector.
OTHER_SENSES = {"line", "circle", "opening", "radius", "given", "pick", "begin", "balance", "couple", "normal",
                "conjugate", "crank"}


def _told_by_name(tree: ast.AST) -> Iterator[ast.AST]:
    """Where operations are told apart by their names: what stands in words or data alone is none of it."""
    spoken = {id(inner) for node in ast.walk(tree) if isinstance(node, ast.FormattedValue) for inner in ast.walk(node)}
    spoken |= {id(value) for node in ast.walk(tree) if isinstance(node, ast.Dict) for value in node.values}
    names = set(TABLE) - OTHER_SENSES
    for node in ast.walk(tree):
        match node:
            case ast.Attribute(attr="name", value=ast.Attribute(attr="op")) if id(node) not in spoken:
                yield node
            case ast.Subscript(value=ast.Name(id="TABLE"), slice=ast.Constant()):
                yield node
            case ast.Dict(keys=keys):
                yield from (key for key in keys if isinstance(key, ast.Constant) and key.value in names)
            case ast.Compare(comparators=[ast.Tuple(elts=elements) | ast.Set(elts=elements)]):
                yield from (part for part in elements if isinstance(part, ast.Constant) and part.value in names)
            case ast.MatchValue(value=ast.Constant(value=value)) if value in names:
                yield node


@each("path", [path for path in FILES if folder(path) != "kernel"], ids=named)
def test_operations_are_told_by_their_records(path: Path) -> None:
    """Outside the kernel nothing hangs on an operation's name: what is to be known of it stands in its record."""
    found = [f"{named(path)}:{getattr(node, 'lineno', 0)}" for node in _told_by_name(parsed(path))]
    assert not found, f"operations told by name: {', '.join(found)}; ask their movement, root, crossing ..."
