"""Cases as files: what is typed, what must come of it.

A case is a file `tests/cases/**/*.case.toml`; the files that it reads (scenes, files of other programs) lie beside it.

    says = "a disc of PMKS+ is the link that its letters name"      the behaviour, in one line
    run = ["import disc.txt -o scene.toml", "solve scene.toml"]      commands, one after another, in a folder of copies
    packaged = ["four-bar"]                                          packaged scenes that lie there, too: four-bar.toml
    change = { "four-bar.toml" = [["omega = 2", "omega = nan"]] }    what is written otherwise in a file: the text that
                                                                     stands there once, and what it becomes; in the
                                                                     place of "" at the end of the file
    write = { "empty.toml" = "" }                                    a file of a line or none
    given = "..."                                                    what stands on standard input
    status = 0                                                       of the last one; all before it must give 0
    error = ["no field 'q'"]                                         texts on standard error, each in some line
    lines = 1                                                        how many lines stand there
    output = ["v_A"]                                                 texts on standard output
    order = ["line OA", "line KB"]                                   texts that follow one another there
    silent = ["disagree"]                                            texts that stand nowhere in what is printed
    files = { "scene.toml" = ["[links]"] }                           files that are written, and texts in them
    absent = ["sheet.svg"]                                           files that are not
    same = [["one.svg", "two.svg"]]                                  files that are equal, byte for byte
    json = "results.json"                                            where the values stand, if not on standard output
    [values]                                                         values at paths of that JSON
    "links.3.omega" = 2.0833
    [within]                                                         how near, of the number's own size; 1e-9 by itself
    "links.3.omega" = 1e-4

A path goes through tables by name and through lists by number, and `#` at its end is how many there are; a value may
be a number, a text, a list or, for what must not be had, "null". A file may have several cases, each under [[case]]:
what stands above them holds for each that does not say otherwise.
"""

from __future__ import annotations

import json
import shlex
import shutil
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from face import ran

import graphplan as gp

CASES = Path(__file__).parent / "cases"
SCENES = Path(gp.__file__).parent / "scenes"
KEYS = {"says", "run", "packaged", "change", "write", "given", "status", "error", "lines", "output", "order", "silent",
        "files", "absent", "same", "json", "values", "within"}
NEAR = 1e-9


def cases() -> Iterator[Any]:
    """All cases, each with the folder of its file, by the file's name and the case's number in it."""
    for path in sorted(CASES.rglob("*.case.toml")):
        head = tomllib.loads(path.read_text(encoding="utf-8"))
        each = head.pop("case", [{}])
        name = str(path.relative_to(CASES)).removesuffix(".case.toml")
        for number, own in enumerate(each, 1):
            yield pytest.param(path.parent, head | own, id=name if len(each) == 1 else f"{name}-{number}")


@pytest.mark.parametrize(("folder", "case"), [*cases()])
def test_case(folder: Path, case: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What a case's commands print, write and return is what its file says."""
    assert {"says", "run"} <= {*case} <= KEYS, f"unknown: {', '.join({*case} - KEYS)}"
    lay_out(folder, case, tmp_path)
    monkeypatch.chdir(tmp_path)
    *before, last = case["run"]
    for line in before:
        done = ran(*shlex.split(line))
        assert done.status == 0, done.err
    status, out, err = ran(*shlex.split(last), given=case.get("given", ""))
    assert status == case.get("status", 0), err
    for text in case.get("error", ()):
        assert any(text in line for line in err.splitlines()), f"{text!r} is not said:\n{err}"
    if "lines" in case:
        assert len(err.splitlines()) == case["lines"], err
    assert not [text for text in case.get("silent", ()) if text in err + out], err
    assert not [text for text in case.get("output", ()) if text not in out], out
    at = -1
    for text in case.get("order", ()):
        assert (at := out.find(text, at + 1)) >= 0, f"{text!r} does not follow:\n{out}"
    for name, texts in case.get("files", {}).items():
        content = (tmp_path / name).read_bytes().decode(errors="replace")
        assert not [text for text in texts if text not in content], content
    assert not [name for name in case.get("absent", ()) if (tmp_path / name).exists()]
    for one, two in case.get("same", ()):
        assert (tmp_path / one).read_bytes() == (tmp_path / two).read_bytes()
    if "values" in case:
        data = json.loads((tmp_path / case["json"]).read_text(encoding="utf-8") if "json" in case else out)
        for where, right in case["values"].items():
            share = case.get("within", {}).get(where, NEAR)
            assert value(data, where) == (None if right == "null" else near(right, share)), where


def lay_out(folder: Path, case: dict[str, Any], into: Path) -> None:
    """Puts what a case reads into a folder."""
    for other in folder.iterdir():
        if other.is_file() and not other.name.endswith(".case.toml"):
            shutil.copy(other, into)
    for name in case.get("packaged", ()):
        shutil.copy(next(SCENES.rglob(f"{name}.toml")), into)
    for name, text in case.get("write", {}).items():
        (into / name).write_text(text, encoding="utf-8")
    for name, changes in case.get("change", {}).items():
        text = (into / name).read_text(encoding="utf-8")
        for old, new in changes:
            assert not old or text.count(old) == 1, f"{name} has {old!r} {text.count(old)} times"
            text = text.replace(old, new) if old else text + new
        (into / name).write_text(text, encoding="utf-8")


def value(data: Any, path: str) -> Any:
    """The value at a path of JSON; `a."b.c".d` quotes a name with dots."""
    words = shlex.shlex(path, posix=True, punctuation_chars="")
    words.whitespace, words.whitespace_split, words.commenters = ".", True, ""
    for key in words:
        data = len(data) if key == "#" else data[int(key)] if isinstance(data, list) else data[key]
    return data


def near(right: Any, share: float) -> Any:
    """A number, or a list of numbers, to be met within a share of its size."""
    numeric = isinstance(right, float | list) or type(right) is int
    return pytest.approx(right, rel=share, abs=share * 1e-3) if numeric else right
