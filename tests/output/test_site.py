"""The site that `graphplan gallery` makes: whole, offline, and made from the records themselves."""

from __future__ import annotations

import re
import shlex
from collections.abc import Sequence
from html import unescape
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from face import ran
from live_browser import browser

import graphplan as gp
from graphplan.commands import commands
from graphplan.kernel import TABLE
from graphplan.marking.judge.score import KINDS
from graphplan.mechanism import pairs
from graphplan.mechanism.schema import KEY, keys
from graphplan.site import chapters as manual_chapters
from graphplan.site.chapters import chapters, page_of
from graphplan.site.tutorial import TUTORIALS, Lesson

SCENES = ("four-bar", "five-bar")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The site of a few scenes."""
    folder = tmp_path_factory.mktemp("site")
    assert ran("gallery", folder, *SCENES, "-q").status == 0
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
    """Each chapter is a page whose words lead within the site; a table stands instead of the link to it."""
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


def test_without_the_library_of_chapters_the_rest_stands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where markdown-it-py is not installed, a line says what to install, and no page leads to chapters."""
    monkeypatch.setattr(manual_chapters, "has_chapters", lambda: False)
    done = ran("gallery", tmp_path, "five-bar", "--brief")
    assert done.status == 0
    assert "pip install 'graphplan[manual]'" in done.err
    assert not (tmp_path / "manual").exists()
    assert [page.name for page in tmp_path.glob("*.html") if "manual/" in text(page).partition("</nav>")[0]] == []


def test_the_front_page_of_another_is_kept(tmp_path: Path) -> None:
    """A README.md that the gallery did not write is not replaced: the folder is refused, and nothing is written."""
    (tmp_path / "README.md").write_text("# My project\n", encoding="utf-8")
    refused = ran("gallery", tmp_path, "five-bar", "--brief")
    assert refused.status == 2
    assert "choose another folder" in refused.err
    assert [path.name for path in tmp_path.iterdir()] == ["README.md"]
    assert text(tmp_path / "README.md") == "# My project\n"


@pytest.mark.parametrize(("title", "names"), [
    ("commands", (*commands(),)), ("primitives", [*TABLE]), ("mistakes", [*KINDS]), ("pairs", pairs.KINDS),
    ("keys", sorted({row.key for row in keys() if row.level == KEY})), ("results", ["at", "velocity?", "reactions?"]),
])
def test_the_reference_tells_all_of_each_table(site: Path, title: str, names: list[str]) -> None:
    """Every record of a table has a row in the reference."""
    told = {unescape(name) for name in re.findall(r"<code>([^<]*)</code>", text(site / "reference.html"))}
    assert [name for name in names if name not in told] == [], title


@pytest.mark.costly
def test_what_is_there_is_checked(site: Path) -> None:
    """--check finds nothing in a fresh site; and a page that differs, one too many and one too few in another."""
    again = ["gallery", str(site), *SCENES, "-q", "--check"]
    assert ran(*again).status == 0
    (site / "live" if (site / "live").is_dir() else site / "ggb").joinpath("stray.txt").write_text("")
    (site / "index.html").write_text("")
    (site / "four-bar.txt").unlink()
    found = ran(*again)
    assert found.status == 1
    assert [name for name in ("stray.txt", "index.html", "four-bar.txt") if name not in found.err] == []


def test_a_live_page_of_the_site_shares_its_script_and_leads_back(site: Path) -> None:
    """The script stands beside the page, which moves as others do, and leads to where the site begins."""
    path = site / "live" / "four-bar.html"
    assert "class Motion" not in text(path)
    assert '<a href="../index.html"' in text(path)
    page = browser().new_page()
    page.goto(path.as_uri())
    page.evaluate("graphplan.ready")
    assert page.evaluate("graphplan.travel = 12; graphplan.results().points.A.velocity.length") == 2
    page.close()


@pytest.mark.costly
@pytest.mark.parametrize("lessons", TUTORIALS.values(), ids=map(str, TUTORIALS))
def test_the_tutorial_can_be_followed(lessons: Sequence[Lesson], tmp_path: Path,
                                      monkeypatch: pytest.MonkeyPatch) -> None:
    """What a tutorial has its reader write and type works, in order."""
    monkeypatch.chdir(tmp_path)
    Path("four-bar.toml").write_text(gp.load("four-bar").text, encoding="utf-8")
    for lesson in lessons:
        if lesson.writes[0]:
            Path(lesson.writes[0]).write_text(lesson.writes[1], encoding="utf-8")
        for command in lesson.commands.splitlines():
            done = ran(*shlex.split(command)[1:])
            assert done.status == 0, f"{command}: {done.err}"
