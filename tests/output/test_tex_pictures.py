"""The construction in LaTeX as it looks: compiled by three engines in all languages, and laid over the sheet."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from laid_out import laid_out
from tex_pictures import ENGINES, HIDDEN, compiled, lacking, lettered, rendered, strokes, uncovered

import graphplan as gp
from graphplan.accuracy.drafted import draft
from graphplan.accuracy.hand import pencil
from graphplan.mechanism.scene import packaged_names
from graphplan.output.exports.latex import letters, package
from graphplan.output.exports.tikz import TikzWriter, tikz
from graphplan.sheet.layout.composition import Composition
from graphplan.words import LANGUAGES
from graphplan.words.tongue import tongue

NEEDED = "standalone.cls", "xfp.sty", "t2aenc.def", "lmodern.sty"
EACH = pytest.mark.parametrize(("name", "engine", "language"), [
    (name, ENGINES[(k + k // len(LANGUAGES)) % 3], LANGUAGES[k % len(LANGUAGES)])
    for k, name in enumerate(packaged_names()) if k % 4 == 0
])  # fmt: skip


def composed(name: str, language: str) -> Composition:
    """A packaged scene on its sheet in a language."""
    return draft(gp.construct(gp.load(name)), pencil(""), tongue=tongue(language)).composition


@pytest.mark.parametrize("name", packaged_names()[2::3])
def test_every_scene_is_written_in_what_every_font_has(name: str) -> None:
    """Every packaged scene is written, in English with ASCII alone beside the comments."""
    _, plates = laid_out(name)
    source = re.sub(r"(?<!\\)%.*", "", "\n".join(TikzWriter(plates).picture()))
    assert source.isascii()
    assert source.count(r"\begin{scope}") == len(plates.plans.panels)
    for link in plates.scene.moving:
        spots = {plates.pose[point].spot for point in plates.scene.links[link]}
        assert len(spots) < 3 or r"\draw[plate]" in source or r"\draw[bar]" in source


@EACH
def test_the_picture_is_that_of_the_sheet(name: str, engine: str, language: str, tmp_path: Path) -> None:
    """Compiled without a complaint, every stroke has its like on the sheet within half a millimetre, and every letter
    stands where it stands there."""
    if missing := lacking(engine, *NEEDED):
        pytest.skip(f"not at hand: {missing}")
    composition = composed(name, language)
    source = tikz(composition)
    assert compiled(source, engine, tmp_path) == []
    whole = rendered(tmp_path)
    compiled(source.replace(r"\begin{document}", rf"{HIDDEN}\begin{{document}}"), engine, tmp_path)
    drawn, meant = rendered(tmp_path), strokes(composition)
    assert uncovered(meant, drawn) < 0.01
    assert uncovered(drawn, meant) < 0.01
    ink = whole & ~drawn
    assert all(ink[place].any() for place in lettered(composition))
    for place in lettered(composition):
        ink[place] = False
    assert ink.sum() < 0.02 * (whole & ~drawn).sum()


@pytest.mark.parametrize("language", LANGUAGES)
def test_one_document_has_all_pictures(language: str, tmp_path: Path) -> None:
    """Bare pictures share the style of a package, and nothing is complained of in any language by any engine."""
    if missing := lacking("pdflatex", *NEEDED) or lacking("lualatex") or lacking("xelatex"):
        pytest.skip(f"not at hand: {missing}")
    (tmp_path / "graphplan.sty").write_text(package(), encoding="utf-8")
    pages = list[str]()
    for name in packaged_names()[LANGUAGES.index(language)::12]:
        composition = composed(name, language)
        for k in range(2):
            source = tikz(composition, bare=True, width=0.6 * k)
            (tmp_path / f"{name}-{k}.tex").write_text(source, encoding="utf-8")
            pages.append(rf"\noindent\input{{{name}-{k}}}\newpage")
    first = [r"\documentclass{article}", r"\usepackage[paperwidth=1220mm,paperheight=1220mm,margin=5mm]{geometry}"]
    packages = r"\usepackage{graphplan}"
    source = "\n".join([*first, *letters(language), packages, r"\begin{document}", *pages, r"\end{document}"])
    assert {engine: compiled(source, engine, tmp_path) for engine in ENGINES} == {engine: [] for engine in ENGINES}
