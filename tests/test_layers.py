"""The arrows between the folders, read from the imports: errors <- kernel <- methods, and so on."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from graphplan.kernel import TABLE

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "graphplan"
FILES = sorted(PACKAGE.rglob("*.py"))

# What a folder may import from graphplan, itself apart. `commands` and the front door may import anything.
MAY = {
    "errors": set(),
    "phrases": set(),
    "words": {"errors", "phrases"},
    "kernel": {"errors", "phrases"},
    "mechanism": {"errors", "phrases", "words"},
    "solver": {"errors", "mechanism"},
    "methods": {"errors", "phrases", "kernel", "mechanism"},
    "sheet": {"errors", "phrases", "words", "kernel", "mechanism", "methods"},
    "output": {"errors", "phrases", "words", "kernel", "mechanism", "methods", "sheet", "marking"},
    "marking": {"errors", "phrases", "words", "kernel", "mechanism", "methods", "sheet", "accuracy"},
    "cycle": {"errors", "phrases", "kernel", "mechanism", "methods", "sheet"},
    "check": {"errors", "phrases", "kernel", "mechanism", "methods", "solver", "cycle"},
    "accuracy": {"errors", "phrases", "words", "kernel", "mechanism", "methods", "solver", "cycle", "check", "sheet"},
}
FRONT = {"__init__", "__main__", "commands"}

# Who may import what does not come with Python.
OUTSIDE = {
    "matplotlib": {"output/pdf_png.py"},
    "svgwrite": {"output/svg.py", "output/stepper.py"},
    "shapely": {"sheet", "marking"},
    "ezdxf": {"output", "marking"},
    "cv2": {"marking"},
    "pypdfium2": {"marking"},
    "svgelements": {"marking"},
    "numba": {"kernel/tape/blocks.py"},
    "distributed": {"methods/executors.py"},
    "flint": {"kernel/numbers/enclosures.py"},
    "shtab": {"commands/completion.py"},
}
# Where the kernel reckons beyond Python alone.
NUMBERS = {*(f"kernel/numbers/{domain}.py" for domain in ("arrays", "gradients", "enclosures")),
           "kernel/tape/blocks.py"}


def folder(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def imports(path: Path, *, typing: bool = False) -> Iterator[str]:
    """The modules that a file imports; those for the type checker alone only if asked for."""
    tree = ast.parse(path.read_text())
    skipped = {id(node) for block in ast.walk(tree) if _for_typing(block) for node in ast.walk(block)}
    for node in ast.walk(tree):
        if id(node) in skipped and not typing:
            continue
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: imports are absolute"
            module = node.module or ""
            yield from (f"{module}.{alias.name}" for alias in node.names) if module == "graphplan" else [module]


def _for_typing(node: ast.AST) -> bool:
    return isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING")


def inside(path: Path) -> set[str]:
    """The folders of graphplan that a file imports from."""
    return {name.split(".")[1] for name in imports(path) if name.startswith("graphplan.")}


def outside(path: Path) -> set[str]:
    """The packages beyond graphplan and Python that a file imports."""
    return {name.split(".")[0] for name in imports(path, typing=True)} - set(sys.stdlib_module_names) - {"graphplan"}


def named(path: Path) -> str:
    return str(path.relative_to(PACKAGE))


DOORS = {"sheet/__init__.py"}  # calls the back end, as users do: `gp.sheet.svg(drawing)`
LAYERED = [path for path in FILES if folder(path) not in FRONT and named(path) not in DOORS]


@pytest.mark.parametrize("path", LAYERED, ids=named)
def test_arrows(path: Path) -> None:
    """A file imports from its own folder and from those below it."""
    assert folder(path) in MAY, f"say in MAY what {folder(path)} may import"
    assert inside(path) - {folder(path)} <= MAY[folder(path)]


def test_no_circles() -> None:
    """What a folder may import may not import it."""
    assert not [(one, two) for one, below in MAY.items() for two in below if one in MAY[two]]


@pytest.mark.parametrize("path", FILES, ids=named)
def test_outside_packages(path: Path) -> None:
    """matplotlib and svgwrite serve writers alone; what the kernel computes with stands in its number domains."""
    found = outside(path)
    for package, users in OUTSIDE.items():
        assert package not in found or users & {folder(path), named(path)}
    assert found <= {"numpy", *OUTSIDE}
    if folder(path) in ("errors", "kernel") and named(path) not in NUMBERS:
        assert not found


@pytest.mark.parametrize("path", FILES, ids=named)
def test_files_are_short(path: Path) -> None:
    """No file is longer than 400 lines, and none is a drawer for odds and ends."""
    assert len(path.read_text().splitlines()) <= 400
    assert path.stem not in {"utils", "helpers", "common", "util", "misc"}


def test_solving_needs_no_drawing_packages() -> None:
    """Solving a scene loads neither matplotlib nor shapely nor svgwrite."""
    scenes = sorted((PACKAGE / "scenes").glob("*.toml"))
    if not scenes:
        pytest.skip("no scenes yet")
    code = ("import sys; from graphplan.commands import main; "
            f"assert main(['solve', {str(scenes[0])!r}]) in (0, None); "
            "print({'matplotlib', 'shapely', 'svgwrite'} & set(sys.modules), file=sys.stderr)")
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.stderr.strip().endswith("set()"), done.stderr


def test_a_command_loads_no_more_than_it_needs() -> None:
    """Importing graphplan loads no folder of it; solving loads no other command, no sheet and no back end."""
    code = ("import sys, graphplan; print([m for m in sys.modules if m.startswith('graphplan.')], file=sys.stderr); "
            "from graphplan.commands import SUBCOMMANDS, main; assert main(['solve', 'four-bar']) == 0; "
            "others = {f'graphplan.commands.{name}' for name in SUBCOMMANDS} - {'graphplan.commands.solve'}; "
            "unused = [m for m in sys.modules"
            " if m in others or m.startswith(('graphplan.sheet', 'graphplan.output'))]; "
            "print(unused, file=sys.stderr)")
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.stderr.split() == ["[]", "[]"], done.stderr


FORCES = ("methods.forces", "check.forces",
          "solver.statics", "solver.virtual_power", "solver.friction")


@pytest.mark.parametrize(("scene", "touched"), [("four-bar", False), ("jaanimets-10", True)])
def test_scenes_without_loads_touch_no_force_code(scene: str, touched: bool) -> None:
    """What forces need is imported where there are loads, and nowhere else."""
    code = ("import sys; from graphplan.commands import main; "
            f"assert main(['solve', {scene!r}]) == 0; assert main(['draw', {scene!r}]) == 0; "
            f"print([m for m in {FORCES!r} if 'graphplan.' + m in sys.modules], file=sys.stderr)")
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.stderr.strip() == str(list(FORCES) if touched else []), done.stderr


# Words that name an operation and something else as well: an element of SVG, a key of a scene, a kind of vector.
OTHER_SENSES = {"line", "circle", "opening", "radius", "given", "pick", "begin", "balance", "couple", "normal"}


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


@pytest.mark.parametrize("path", [path for path in FILES if folder(path) != "kernel"], ids=named)
def test_operations_are_told_by_their_records(path: Path) -> None:
    """Outside the kernel nothing hangs on an operation's name: what is to be known of it stands in its record."""
    found = [f"{named(path)}:{getattr(node, 'lineno', 0)}" for node in _told_by_name(ast.parse(path.read_text()))]
    assert not found, f"operations told by name: {', '.join(found)}; ask their movement, root, crossing ..."
