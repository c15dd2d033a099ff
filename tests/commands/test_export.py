"""`graphplan export`: every format of its table, whole files or none."""

from __future__ import annotations

import re
import subprocess
import sys
from functools import cache
from itertools import cycle
from pathlib import Path
from zipfile import ZipFile

import pytest

import graphplan as gp
from graphplan.accuracy.drafted import Drafted, draft
from graphplan.accuracy.hand import pencil
from graphplan.check.trusted import report
from graphplan.commands import main, parser
from graphplan.commands.export import READ, format_of
from graphplan.output import FORMATS, back_end

BEGINS = {
    "ggb": b"PK", "json": b"{", "svg": b"<?xml", "pdf": b"%PDF", "png": b"\x89PNG",
}
BOTH = "jaanimets-10", "rosenauer-basic"


@cache
def on_sheet(scene: str) -> Drafted:
    """A packaged scene on its sheet."""
    found = report(gp.load(scene))
    return draft(found.drawing, pencil(""), check=found.check)


@pytest.mark.parametrize(("name", "scene"), list(zip(FORMATS, cycle(BOTH), strict=False)))
def test_every_format(name: str, scene: str, tmp_path: Path) -> None:
    """Every format writes a file that begins as such files do, the same bytes twice."""
    if FORMATS[name].extra == "dxf":
        pytest.importorskip("ezdxf")
    path = tmp_path / f"a{FORMATS[name].suffix}"
    assert main(["export", scene, "-o", str(path), "--format", name]) == 0
    written, again = path.read_bytes(), back_end(name)(*READ[FORMATS[name].reads](on_sheet(scene)))
    assert written == (again.encode() if isinstance(again, str) else again)
    assert len(written) > 1000
    assert written.startswith(BEGINS.get(name, b""))


def test_the_suffix_says_which() -> None:
    """Without a name the suffix chooses, in either case; of two formats with one suffix the first of the table."""
    suffixes = dict.fromkeys(format.suffix for format in FORMATS.values())
    assert [FORMATS[format_of(f"a{suffix.upper()}", None)].suffix for suffix in suffixes] == list(suffixes)
    assert format_of("a.tex", None) == format_of("a.tex", "tikz") == "tikz"


def test_help_tells_every_format() -> None:
    """The help lists each format of the table with its line."""
    helped = " ".join(parser(["export"])._subparsers._group_actions[0].choices["export"].format_help().split())  # type: ignore[union-attr,index]
    for name, format in FORMATS.items():
        assert f"{name} {format.suffix} {format.told}" in helped


@pytest.mark.parametrize(("arguments", "said"), [
    (["-o", "{tmp}/a.dwg"], "a name in .ggb, .tex"),
    (["-o", "{tmp}/a"], "the name has no suffix that tells the format"),
    (["-o", "{tmp}/a.html"], "graphplan live SCENE -o"),
    (["-o", "/dev/null/a.ggb"], "cannot be written"),
    (["-o", "{tmp}/a.ggb", "--plan", "nonsense"], "nonsense"),
])
def test_nothing_is_written_where_it_fails(arguments: list[str], said: str, tmp_path: Path,
                                           capsys: pytest.CaptureFixture[str]) -> None:
    """What cannot be exported is told in one line, with exit status 2, and leaves no file."""
    assert main(["export", "four-bar", *(word.format(tmp=tmp_path) for word in arguments)]) == 2
    told = capsys.readouterr().err
    assert said in told
    assert len(told.strip().splitlines()) == 1
    assert not list(tmp_path.iterdir())


def test_a_failure_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A back end that fails at its end leaves what was there."""
    import graphplan.output.exports.geogebra as geogebra

    path = tmp_path / "a.ggb"
    path.write_text("old")
    monkeypatch.setattr(geogebra.zipfile, "ZipFile", lambda *_: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        main(["export", "four-bar", "-o", str(path)])
    assert [path.read_text(), len(list(tmp_path.iterdir()))] == ["old", 1]


def test_a_missing_library_names_its_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
                                           capsys: pytest.CaptureFixture[str]) -> None:
    """Where the library of a format is not installed, the one line says what installs it."""
    monkeypatch.delitem(sys.modules, "graphplan.output.dxf", raising=False)
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    assert main(["export", "four-bar", "-o", str(tmp_path / "a.dxf")]) == 2
    assert "ezdxf is not installed; pip install 'graphplan[dxf]'" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.costly
def test_the_steps_are_those_that_are_printed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The JSON is what `steps --json` prints, of another plan too."""
    path = tmp_path / "a.json"
    assert main(["export", "four-bar", "--plan", "polar", "-o", str(path)]) == 0
    assert main(["steps", "four-bar", "--plan", "polar", "--json"]) == 0
    assert path.read_text() == capsys.readouterr().out



@pytest.mark.costly
def test_a_step_export_loads_no_renderer(tmp_path: Path) -> None:
    """matplotlib is not loaded for a GeoGebra file."""
    code = ("import sys; from graphplan.commands import main; "
            f"assert main(['export', 'four-bar', '-o', {str(tmp_path / 'a.ggb')!r}]) == 0; "
            "print([m for m in ('matplotlib', 'ezdxf') if m in sys.modules])")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize("name", ["ggb", "tikz", "json"])
def test_exports_speak_the_language(name: str, tmp_path: Path) -> None:
    """Sentences and captions of every step format come in the language asked for."""
    path = tmp_path / f"a{FORMATS[name].suffix}"
    assert main(["export", "four-bar", "-o", str(path), "--format", name, "--language", "de"]) == 0
    text = ZipFile(path).read("geogebra.xml").decode() if name == "ggb" else path.read_text(encoding="utf-8")
    assert "Schneide" in text
    assert name == "json" or "Lageplan mit gedrehten Geschwindigkeiten" in text
    assert not re.search(r"\b(Draw|Mark|Mechanism plan|drawable|plan:)\b", text)
