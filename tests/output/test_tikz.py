"""The construction as LaTeX: its form, and where there is a TeX, its marks as TeX reckons them."""

from __future__ import annotations

import math
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from each import each
from laid_out import laid_out
from objects import MECHANISM, NAMES, PLACES, TWO, VIEWS, Place, loose, programs

from graphplan.kernel.kinds import POINT
from graphplan.output.exports.latex import standalone
from graphplan.output.exports.tikz import TikzWriter
from graphplan.output.exports.walk import identifiers
from graphplan.sheet.plates.plate import Plates

POINT_MM = 2.845275590551  # TeX's points in a millimetre
MADE = re.compile(r"coordinate ?\((\w+)\)")
READ = re.compile(r"[(,{ ]([A-Za-z]\w*)(?=[),}$]|--)|--([A-Za-z]\w*)")


def compiled(source: str, plates: Plates, folder: Path) -> dict[str, tuple[float, float]]:
    """The points of a plates in mm, as pdflatex tells them."""
    names = identifiers(plates.all_marks)
    made = {*MADE.findall(source)}
    points = [names[mark] for mark in plates.all_marks if mark.kind == POINT and names[mark] in made]
    probe = "".join(rf"\path ({id}); \pgfgetlastxy{{\X}}{{\Y}}\typeout{{AT {id} \X\space\Y}}" + "\n" for id in points)
    (folder / "figure.tex").write_text(source.replace(r"\end{tikzpicture}", probe + r"\end{tikzpicture}"))
    run = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "figure.tex"]
    done = subprocess.run(run, cwd=folder, capture_output=True, timeout=1200, check=False)
    log = (folder / "figure.log").read_text(errors="replace").replace("\n", "")
    assert done.returncode == 0, log[-800:]
    told = re.finditer(r"AT (\w+) (-?[\d.]+)pt (-?[\d.]+)pt", log)
    return {found[1]: (float(found[2]) / POINT_MM, float(found[3]) / POINT_MM) for found in told}


def written(plates: Plates) -> str:
    """A document of a picture alone."""
    return "\n".join(standalone(TikzWriter(plates).picture(), "en"))


def available() -> bool:
    """Whether what an export needs is installed."""
    if shutil.which("pdflatex") is None or shutil.which("kpsewhich") is None:
        return False
    return not subprocess.run(["kpsewhich", "standalone.cls", "xfp.sty"], capture_output=True, check=False).returncode


@pytest.mark.parametrize("name", ["slider-crank", "jaanimets-10", "double-butterfly"])
def test_every_step_is_said_and_nothing_used_before_it_is_made(name: str) -> None:
    """Sentences stand in order; braces are balanced; each coordinate is made before it is read, and made once."""
    _, plates = laid_out(name)
    source = written(plates)
    places = [source.index(f"\n% {mark.number}. {mark.sentence}\n") for mark in plates.all_marks if mark.number]
    assert places == sorted(places)
    body = re.sub(r"(?<!\\)%.*", "", source[source.index(r"\begin{tikzpicture}") :])
    bare = body.replace(r"\{", "").replace(r"\}", "")
    assert bare.count("{") == bare.count("}")
    assert body.count(r"\begin{scope}") == len(plates.plans.panels)
    made = [*MADE.findall(body)]
    assert len(set(made)) == len(made)
    known: set[str] = set()
    for line in body.replace("\n  ", " ").splitlines():
        read = {one or two for one, two in READ.findall(re.sub(r"\{\$.*?\$\}", "", MADE.sub("", line)))}
        assert (read & set(made)) <= known, line
        known |= {*MADE.findall(line)}
    assert written(plates) == source


@PLACES
@each("name", NAMES)
def test_every_operation_is_translated(name: str, place: Place) -> None:
    """Each operation of the table gives coordinates under its sentence, a line through two points apart."""
    for program, values in programs(name):
        plates = loose(program, values, place)
        last = plates.steps[-1]
        sentence = f"\n% {last.number}. {last.sentence}\n" if last.number else "tikzpicture}"
        said = written(plates).partition(sentence)[2]
        made = {*MADE.findall(said)}
        called = identifiers(plates.all_marks)[last]
        needless = name == "line" and all(arg.panel == last.panel for arg in last.args)
        assert needless or made & {called, f"{called}_to"}


def test_what_tex_cannot_hold_is_left_out_and_told() -> None:
    """A mark too far out for TeX's dimensions gets no coordinate; what rests on it stands as it lies, and says so."""
    program, values = next(programs("transfer"))
    out = VIEWS[MECHANISM].origin[0] + 6000.0, 0.0
    plates = loose(program, values, lambda _, index: TWO if index < 2 else MECHANISM,
                   {**VIEWS, TWO: replace(VIEWS[MECHANISM], origin=out)})  # fmt: skip
    first, last, names = plates.steps[0], plates.steps[-1], identifiers(plates.all_marks)
    source = written(plates)
    assert f"({names[first]})" not in source
    assert "too far out for TeX's dimensions" in source
    assert re.search(rf"given as it lies: .*\n\\coordinate \({names[last]}\) at \([-\d.]+,[-\d.]+\);", source)


@pytest.mark.parametrize("name", ["slider-crank", "ozols-10-1"])
def test_tex_puts_every_point_where_it_lies(name: str, tmp_path: Path) -> None:
    """Compiled by pdflatex without an error, every point stands within a fifth of a millimetre of its place."""
    if not available():
        pytest.skip("there is no pdflatex with what this file needs")
    _, plates = laid_out(name)
    found, names = compiled(written(plates), plates, tmp_path), identifiers(plates.all_marks)
    points = [mark for mark in plates.all_marks if mark.kind == POINT]
    assert len(found) == len(points)
    assert max(math.dist(found[names[mark]], mark.spot) for mark in points) < 0.2


def test_tex_takes_plans_that_reach_metres_off_the_paper(tmp_path: Path) -> None:
    """Plans far too large for their windows are compiled without an error, with what of them TeX can hold."""
    if not available():
        pytest.skip("there is no pdflatex with what this file needs")
    _, plates = laid_out("slider-crank", times=40.0)
    source = written(plates)
    assert "too far out for TeX's dimensions" in source
    assert 0 < len(compiled(source, plates, tmp_path)) < len(plates.all_marks)
