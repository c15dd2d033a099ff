"""The site that `graphplan gallery` makes: whole, offline, and made from the records themselves."""

from __future__ import annotations

import re
import shlex
from collections.abc import Sequence
from html import unescape
from pathlib import Path
from urllib.parse import urlsplit

import pytest

import graphplan as gp
from graphplan.commands import SUBCOMMANDS, main
from graphplan.kernel import TABLE
from graphplan.marking.judge.score import KINDS
from graphplan.mechanism import pairs
from graphplan.mechanism.schema import KEY, keys
from graphplan.output.manual import chapters as manual_chapters
from graphplan.output.manual.chapters import chapters, page_of
from graphplan.output.manual.tutorial import TUTORIALS, Lesson

SCENES = ("four-bar", "five-bar")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The site of a few scenes."""
    folder = tmp_path_factory.mktemp("site")
    assert main(["gallery", str(folder), *SCENES, "-q"]) == 0
    return folder


def text(page: Path) -> str:
    return page.read_text(encoding="utf-8")


@pytest.mark.costly
def test_every_link_leads_to_a_file_of_the_site(site: Path) -> None:
    """Links and pictures name files that are there, and nothing elsewhere."""
    pages = [*site.glob("*.html"), *site.glob("manual/*.html")]
    assert len(pages) == len(SCENES) + 4 + len(chapters())
    for page in pages:
        for address in re.findall(r'(?:href|src)="([^"]*)"', text(page)):
            parts = urlsplit(unescape(address))
            assert not parts.netloc, f"{page.name}: {address}"
            target = page.parent / parts.path if parts.path else page
            assert target.is_file(), f"{page.name}: {address}"
            assert not parts.fragment or f'id="{parts.fragment}"' in text(target), f"{page.name}: {address}"


def test_links_of_the_front_page_lead_to_files_of_the_site(site: Path) -> None:
    """On a code host pictures, protocols, tutorial and tables are found, each scene with its own."""
    for page in (site / "README.md", site / "tutorial.md"):
        addresses = re.findall(r'\]\(([^)]+)\)|<img src="([^"]+)"', text(page))
        assert [address for pair in addresses for address in pair if address and not (site / address).is_file()] == []
    for scene in SCENES:
        assert f"({scene}.txt)" in text(site / "README.md")


def test_chapters_are_pages_with_the_tables_of_the_records(site: Path) -> None:
    """Each chapter is a page whose words lead within the site; a table stands in the place of the link to it."""
    for name in chapters():
        page = text(site / page_of(name))
        assert "<table>" in page or "|---" not in chapters()[name]
        assert [address for address in re.findall(r'href="([^"]*)"', page) if ".md" in address] == []
    cells = {unescape(name) for name in re.findall(r"<td><code>([^<]*)</code></td>", text(site / page_of("scene")))}
    assert {row.key for row in keys() if row.level == KEY} <= cells
    assert "v |v|" in text(site / page_of("scene"))


def test_pictures_that_a_site_has_not_leave_their_words(site: Path) -> None:
    """A chapter's picture of a scene that the site lacks is left out, with what it shows in its place."""
    page = text(site / page_of("forces"))
    assert "<img" not in page
    assert "A loaded four-bar: force polygons and Zhukovsky's lever" in unescape(page)


def test_without_the_library_of_chapters_the_rest_stands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
                                                         capsys: pytest.CaptureFixture[str]) -> None:
    """Where markdown-it-py is not installed, a line says what to install, and no page leads to chapters."""
    monkeypatch.setattr(manual_chapters, "has_chapters", lambda: False)
    assert main(["gallery", str(tmp_path), "five-bar", "--brief"]) == 0
    assert "pip install 'graphplan[manual]'" in capsys.readouterr().err
    assert not (tmp_path / "manual").exists()
    assert [page.name for page in tmp_path.glob("*.html") if "manual/" in text(page).partition("</nav>")[0]] == []


def test_the_front_page_of_another_is_kept(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A README.md that the gallery did not write is not replaced: the folder is refused, and nothing is written."""
    (tmp_path / "README.md").write_text("# My project\n", encoding="utf-8")
    assert main(["gallery", str(tmp_path), "five-bar", "--brief"]) == 2
    assert "choose another folder" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["README.md"]
    assert text(tmp_path / "README.md") == "# My project\n"


@pytest.mark.parametrize(("title", "names"), [
    ("commands", SUBCOMMANDS), ("primitives", [*TABLE]), ("mistakes", [*KINDS]), ("pairs", pairs.KINDS),
    ("keys", sorted({row.key for row in keys() if row.level == KEY})), ("results", ["at", "velocity?", "reactions?"]),
])
def test_the_reference_tells_all_of_each_table(site: Path, title: str, names: list[str]) -> None:
    """Every record of a table has a row in the reference."""
    told = {unescape(name) for name in re.findall(r"<code>([^<]*)</code>", text(site / "reference.html"))}
    assert [name for name in names if name not in told] == [], title


@pytest.mark.costly
def test_what_is_there_is_checked(site: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """--check finds nothing in a fresh site; and a page that differs, one too many and one too few in another."""
    again = ["gallery", str(site), *SCENES, "-q", "--check"]
    assert main(again) == 0
    (site / "live" if (site / "live").is_dir() else site / "ggb").joinpath("stray.txt").write_text("")
    (site / "index.html").write_text("")
    (site / "four-bar.txt").unlink()
    assert main(again) == 1
    err = capsys.readouterr().err
    assert [name for name in ("stray.txt", "index.html", "four-bar.txt") if name not in err] == []


def test_the_site_speaks_the_language_that_is_asked_for(tmp_path: Path) -> None:
    """Pages and sheets are in the language chosen."""
    assert main(["gallery", str(tmp_path), "four-bar", "--brief", "--language", "de", "-q"]) == 0
    assert '<html lang="de">' in text(tmp_path / "index.html")
    assert "Mechanismus" in text(tmp_path / "four-bar.txt") or "Getriebe" in text(tmp_path / "four-bar.txt")
    assert "<title>Viergelenkgetriebe mit Koppelpunkt" in text(tmp_path / "four-bar.svg")
    assert "<td>Bleistift</td>" in text(tmp_path / "reference.html")
    assert "## Getriebe mit Drehgelenken" in text(tmp_path / "README.md")
    chapter = text(tmp_path / page_of("handouts"))
    assert "Dieses Kapitel ist auf Englisch." in chapter
    assert '<article lang="en">' in chapter
    assert 'aria-current="page">Handbuch</a>' in text(tmp_path / page_of("README"))


@pytest.mark.costly
@pytest.mark.parametrize("lessons", TUTORIALS.values(), ids=map(str, TUTORIALS))
def test_the_tutorial_can_be_followed(lessons: Sequence[Lesson], tmp_path: Path,
                                      monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """What a tutorial has its reader write and type works, in order."""
    monkeypatch.chdir(tmp_path)
    Path("four-bar.toml").write_text(gp.load("four-bar").text, encoding="utf-8")
    for lesson in lessons:
        if lesson.writes[0]:
            Path(lesson.writes[0]).write_text(lesson.writes[1], encoding="utf-8")
        for command in lesson.commands.splitlines():
            assert main(shlex.split(command)[1:]) == 0, f"{command}: {capsys.readouterr().err}"


@pytest.mark.parametrize(("scenes", "told"), [
    (["four-bar", "sub/four-bar.toml"], "has the name four-bar, too"), (["index.toml"], "a page index of its own"),
])
def test_scenes_whose_pages_would_be_one_are_refused(scenes: list[str], told: str, tmp_path: Path,
                                                     capsys: pytest.CaptureFixture[str]) -> None:
    """Two scenes of one name, or one with the name of a page of the site, are refused; nothing is written."""
    assert main(["gallery", str(tmp_path), *scenes]) == 2
    assert told in capsys.readouterr().err
    assert [*tmp_path.iterdir()] == []
