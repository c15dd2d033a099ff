"""Pages of a sheet at the command line: plans first, words where there is room for them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from graphplan.commands import main


def written(folder: Path, *arguments: str) -> list[str]:
    """The names of the files that drawing a four-bar linkage writes."""
    assert main(["draw", "four-bar", *arguments]) == 0
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.parametrize(("protocol", "apart", "told"), [
    ("none", False, {"sheet": False}), ("aside", False, {"sheet": True}),
    ("pages", True, {"sheet": False, "sheet-protocol": True}),
])
def test_words_stand_where_they_are_wanted(protocol: str, apart: bool, told: dict[str, bool], tmp_path: Path) -> None:
    """Aside the first page has the words, on pages those that follow, which are numbered; without any none has."""
    names = written(tmp_path, "--set", f"sheet.protocol={protocol}", "-o", str(tmp_path / "sheet.svg"))
    assert ("sheet-protocol.svg" in names) == apart
    assert {re.sub(r"-\d+$", "", name.removesuffix(".svg")) for name in names} == set(told)
    for name, words in told.items():
        page = re.sub("</?tspan[^>]*>", "", (tmp_path / f"{name}.svg").read_text())
        assert bool(re.search(r"<text[^>]*>[^<]*Draw ", page)) == words


def test_a_page_that_cannot_be_written_leaves_all_as_it_was(tmp_path: Path) -> None:
    """Where the protocol's name is that of a folder neither page is written."""
    (tmp_path / "sheet-protocol.svg").mkdir()
    assert main(["draw", "four-bar", "--set", "sheet.protocol=pages", "-o", str(tmp_path / "sheet.svg")]) == 2
    assert [path.name for path in tmp_path.iterdir()] == ["sheet-protocol.svg"]


@pytest.mark.costly
def test_a_pdf_has_all_pages(tmp_path: Path) -> None:
    """Plans and words are pages of one PDF, as many as there are files of SVG."""
    assert written(tmp_path, "--set", "sheet.protocol=pages", "-o", str(tmp_path / "sheet.pdf")) == ["sheet.pdf"]
    files = written(tmp_path, "--set", "sheet.protocol=pages", "-o", str(tmp_path / "sheet.svg"))
    assert (tmp_path / "sheet.pdf").read_bytes().count(b"/MediaBox") == len(files) - 1 > 1


def test_standard_output_has_the_first_page(capsysbinary: pytest.CaptureFixture[bytes]) -> None:
    """One SVG goes to standard output, with the plans."""
    assert main(["draw", "four-bar", "--set", "sheet.protocol=pages"]) == 0
    out = capsysbinary.readouterr().out
    assert (out.count(b"<svg "), b'class="panel"' in out) == (1, True)
