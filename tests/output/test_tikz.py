"""The construction as LaTeX: its form, and where there is a TeX, its marks as TeX reckons them."""

from __future__ import annotations

import math
import re
import shutil
import subprocess
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from laid_out import laid_out
from objects import NAMES, ONE, loose, programs

from graphplan.kernel.kinds import POINT
from graphplan.output.exports.figure import Figure
from graphplan.output.exports.tikz import tikz
from graphplan.output.exports.tkz import tkz_euclide

Export = Callable[[Figure], str]
POINT_MM = 2.845275590551  # TeX's points in a millimetre
BOTH = pytest.mark.parametrize("export", [tikz, tkz_euclide])
MADE = re.compile(r"coordinate ?\((\w+)\)|tkzGetPoint\{(\w+)\}|tkzGetPoints\{(\w+)\}\{(\w+)\}"
                  r"|tkzDefPoint\([^)]*\)\{(\w+)\}")
READ = re.compile(r"[(,{ ]([A-Za-z]\w*)(?=[),}$]|--)|--([A-Za-z]\w*)")


def compiled(source: str, figure: Figure, folder: Path) -> dict[str, tuple[float, float]]:
    """The points of a figure in mm, as pdflatex tells them."""
    points = [object.id for object in figure.objects if object.kind == POINT and f"({object.id})" in source]
    probe = "".join(rf"\path ({id}); \pgfgetlastxy{{\X}}{{\Y}}\typeout{{AT {id} \X\space\Y}}" + "\n" for id in points)
    (folder / "figure.tex").write_text(source.replace(r"\end{tikzpicture}", probe + r"\end{tikzpicture}"))
    run = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "figure.tex"]
    done = subprocess.run(run, cwd=folder, capture_output=True, timeout=120, check=False)
    log = (folder / "figure.log").read_text(errors="replace").replace("\n", "")
    assert done.returncode == 0, log[-800:]
    told = re.finditer(r"AT (\w+) (-?[\d.]+)pt (-?[\d.]+)pt", log)
    return {found[1]: (float(found[2]) / POINT_MM, float(found[3]) / POINT_MM) for found in told}


def available(export: Export) -> bool:
    """Whether what an export needs is installed."""
    package = "tkz-euclide.sty" if export is tkz_euclide else "standalone.cls"
    if shutil.which("pdflatex") is None or shutil.which("kpsewhich") is None:
        return False
    return not subprocess.run(["kpsewhich", package, "xfp.sty"], capture_output=True, check=False).returncode


@BOTH
@pytest.mark.parametrize("name", ["slider-crank", "jaanimets-10", "double-butterfly"])
def test_every_step_is_said_and_nothing_used_before_it_is_made(export: Export, name: str) -> None:
    """Sentences stand in order; braces are balanced; each coordinate is made before it is read, and made once."""
    _, figure = laid_out(name)
    source = export(figure)
    places = [source.index(f"\n% {object.number}. {object.sentence}\n") for object in figure.steps]
    assert places == sorted(places)
    body = re.sub(r"(?<!\\)%.*", "", source[source.index(r"\begin{tikzpicture}") :])
    bare = body.replace(r"\{", "").replace(r"\}", "")
    assert bare.count("{") == bare.count("}")
    assert body.count(r"\begin{scope}") == len(figure.plans)
    made = [name for found in MADE.findall(body) for name in found if name]
    assert len(set(made)) == len(made)
    known: set[str] = set()
    for line in body.replace("\n  ", " ").splitlines():
        read = {one or two for one, two in READ.findall(re.sub(r"\{\$.*?\$\}", "", MADE.sub("", line)))}
        assert (read & set(made)) <= known, line
        known |= {name for found in MADE.findall(line) for name in found if name}
    assert export(figure) == source


@BOTH
@pytest.mark.parametrize("apart", [False, True], ids=["one plan", "several plans"])
@pytest.mark.parametrize("name", NAMES)
def test_every_operation_is_translated(export: Export, name: str, apart: bool) -> None:
    """Each operation of the table gives coordinates under its sentence, a line through two points apart."""
    for program, values in programs(name):
        figure = loose(program, values, apart)
        last = figure.objects[-1]
        said = export(figure).partition(f"\n% {last.number}. {last.sentence}\n" if last.number else "tikzpicture}")[2]
        made = {name for found in MADE.findall(said) for name in found if name}
        needless = name == "line" and all(arg.plan is last.plan for arg in last.args)
        assert needless or made & {last.id, f"{last.id}_to"}


@BOTH
def test_what_tex_cannot_hold_is_left_out_and_told(export: Export) -> None:
    """A mark too far out for TeX's dimensions gets no coordinate; what rests on it stands as it lies, and says so."""
    program, values = next(programs("midpoint"))
    figure = loose(program, values, apart=False)
    far = replace(ONE, origin=(ONE.origin[0] + 6000.0, 0.0))
    first, *others = figure.objects
    moved = replace(first, plan=far)
    rest = [replace(o, args=tuple(moved if arg is first else arg for arg in o.args)) for o in others]
    source = export(replace(figure, objects=(moved, *rest), marks={}))
    assert f"({first.id})" not in source
    assert "too far out for TeX's dimensions" in source
    assert re.search(rf"given as it lies: .*\n\\coordinate \({rest[-1].id}\) at \([-\d.]+,[-\d.]+\);", source)


@BOTH
@pytest.mark.parametrize("name", ["slider-crank", "ozols-10-1"])
def test_tex_puts_every_point_where_it_lies(export: Export, name: str, tmp_path: Path) -> None:
    """Compiled by pdflatex without an error, every point stands within a fifth of a millimetre of its place."""
    if not available(export):
        pytest.skip("there is no pdflatex with what this file needs")
    _, figure = laid_out(name)
    found = compiled(export(figure), figure, tmp_path)
    points = [object for object in figure.objects if object.kind == POINT]
    assert len(found) == len(points)
    assert max(math.dist(found[object.id], object.at) for object in points) < 0.2


@BOTH
def test_tex_takes_plans_that_reach_metres_off_the_paper(export: Export, tmp_path: Path) -> None:
    """Plans far too large for their windows are compiled without an error, with what of them TeX can hold."""
    if not available(export):
        pytest.skip("there is no pdflatex with what this file needs")
    _, figure = laid_out("slider-crank", times=40.0)
    source = export(figure)
    assert "too far out for TeX's dimensions" in source
    assert 0 < len(compiled(source, figure, tmp_path)) < len(figure.objects)
