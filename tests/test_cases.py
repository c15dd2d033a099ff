"""Cases as files: what is typed, what must come of it.

A case is a file `tests/cases/**/*.case.toml`; the files that it reads (scenes, files of other programs) lie beside it.

    says = "a disc of PMKS+ is the link that its letters name"      the behaviour, in one line
    run = ["import disc.txt -o scene.toml", "solve scene.toml"]      commands, one after another, in a folder of copies
    status = 0                                                       of the last one; all before it must give 0
    error = ["no field 'q'"]                                         texts on standard error, each in a line of its own
    lines = 1                                                        how many lines stand there
    silent = ["disagree"]                                            texts that stand nowhere in what is printed
    output = ["v_A"]                                                 texts on standard output
    files = { "scene.toml" = ["[links]"] }                           files that are written, and texts in them
    absent = ["sheet.svg"]                                           files that are not
    [values]                                                         numbers at paths of the last command's JSON
    "links.3.omega" = 2.0833
    [within]                                                         how near, of the number's own size; 1e-9 by itself
    "links.3.omega" = 1e-4

A path goes through tables by name and through lists by number; a value may be a number, a text, a list or, for what
must not be had, "null".
"""

from __future__ import annotations

import json
import shlex
import shutil
import tomllib
from pathlib import Path
from typing import Any

import pytest
from command_line import run

CASES = Path(__file__).parent / "cases"
KEYS = {"says", "run", "status", "error", "lines", "silent", "output", "files", "absent", "values", "within"}
NEAR = 1e-9


@pytest.mark.parametrize("path", sorted(CASES.rglob("*.case.toml")),
                         ids=lambda path: str(path.relative_to(CASES)).removesuffix(".case.toml"))
def test_case(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """What a case's commands print, write and return is what its file says."""
    case = tomllib.loads(path.read_text(encoding="utf-8"))
    assert {"says", "run"} <= {*case} <= KEYS, f"{path.name}: keys of a case are {', '.join(sorted(KEYS))}"
    for other in path.parent.iterdir():
        if other.is_file() and not other.name.endswith(".case.toml"):
            shutil.copy(other, tmp_path)
    monkeypatch.chdir(tmp_path)
    *before, last = case["run"]
    for line in before:
        assert run(*shlex.split(line)) == 0, capsys.readouterr().err
    capsys.readouterr()
    status = run(*shlex.split(last))
    printed = capsys.readouterr()
    assert status == case.get("status", 0), printed.err
    for text in case.get("error", ()):
        assert any(text in line for line in printed.err.splitlines()), f"{text!r} is not said:\n{printed.err}"
    if "lines" in case:
        assert len(printed.err.splitlines()) == case["lines"], printed.err
    assert not [text for text in case.get("silent", ()) if text in printed.err + printed.out], printed.err
    assert not [text for text in case.get("output", ()) if text not in printed.out], printed.out
    for name, texts in case.get("files", {}).items():
        content = (tmp_path / name).read_text(encoding="utf-8")
        assert not [text for text in texts if text not in content], content
    assert not [name for name in case.get("absent", ()) if (tmp_path / name).exists()]
    for where, right in case.get("values", {}).items():
        value = at(json.loads(printed.out), where)
        assert value == (None if right == "null" else near(right, case.get("within", {}).get(where, NEAR))), where


def at(data: Any, path: str) -> Any:
    """The value at a path of JSON; `a."b.c".d` quotes a name with dots."""
    words = shlex.shlex(path, posix=True, punctuation_chars="")
    words.whitespace, words.whitespace_split = ".", True
    for key in words:
        data = data[int(key)] if isinstance(data, list) else data[key]
    return data


def near(right: Any, share: float) -> Any:
    """A number, or a list of numbers, to be met within a share of its size."""
    numeric = isinstance(right, float | list) or type(right) is int
    return pytest.approx(right, rel=share, abs=share * 1e-3) if numeric else right
