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


@pytest.mark.parametrize(("protocol", "names"), [
    ("none", ["sheet.svg"]), ("pages", ["sheet-protocol.svg", "sheet.svg"]), ("aside", ["sheet.svg"]),
])
def test_words_stand_where_they_are_wanted(protocol: str, names: list[str], tmp_path: Path) -> None:
    """Aside there is one file with the words, on pages there is one more, and without any no words at all."""
    assert written(tmp_path, "--protocol", protocol, "-o", str(tmp_path / "sheet.svg")) == names
    told = [bool(re.search(r"<text[^>]*>[^<]*strike the arc", (tmp_path / name).read_text())) for name in names]
    assert told == {"none": [False], "pages": [True, False], "aside": [True]}[protocol]


@pytest.mark.parametrize(("arguments", "names"), [
    (["--by", "stages", "--protocol", "none"], ["sheet-stages-2.svg", "sheet-stages.svg", "sheet.svg"]),
    (["--by", "sheet", "--strict", "--protocol", "aside"], ["sheet.svg"]),
    (["--strip", "--paper", "A4"], ["sheet-2.svg", "sheet.svg"]),
])
def test_stages_and_pictures_have_pages(arguments: list[str], names: list[str], tmp_path: Path) -> None:
    """Stages follow the sheet under a name of their own, and the pages of a strip are numbered."""
    assert written(tmp_path, *arguments, "-o", str(tmp_path / "sheet.svg")) == names


def test_a_strict_construction_is_told_by_stages(tmp_path: Path) -> None:
    """With compasses and straightedge alone the stages follow the sheet, and their steps stand with them alone."""
    names = written(tmp_path, "--strict", "--protocol", "pages", "-o", str(tmp_path / "sheet.svg"))
    told = {name: (tmp_path / name).read_text() for name in names}
    assert len([name for name in names if "stages" in name]) > 2
    assert {name for name, text in told.items() if re.search(r"<text[^>]*>[^<]*strike arc", text)} == {
        name for name in names if "stages" in name}


def test_a_page_that_cannot_be_written_leaves_all_as_it_was(tmp_path: Path) -> None:
    """Where the protocol's name is that of a folder neither page is written."""
    (tmp_path / "sheet-protocol.svg").mkdir()
    assert main(["draw", "four-bar", "--protocol", "pages", "-o", str(tmp_path / "sheet.svg")]) == 2
    assert [path.name for path in tmp_path.iterdir()] == ["sheet-protocol.svg"]


def test_a_pdf_has_all_pages(tmp_path: Path) -> None:
    """Plans and words are pages of one PDF."""
    assert written(tmp_path, "--protocol", "pages", "-o", str(tmp_path / "sheet.pdf")) == ["sheet.pdf"]
    assert (tmp_path / "sheet.pdf").read_bytes().count(b"/MediaBox") == 2


def test_standard_output_has_the_first_page(capsysbinary: pytest.CaptureFixture[bytes]) -> None:
    """One SVG goes to standard output, with the plans."""
    assert main(["draw", "four-bar", "--protocol", "pages"]) == 0
    out = capsysbinary.readouterr().out
    assert (out.count(b"<svg "), b'class="panel"' in out) == (1, True)
