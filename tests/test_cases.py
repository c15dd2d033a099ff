"""Cases as files: what is typed, what must come of it.

A case is a file `tests/cases/**/*.case.toml`; what it reads (scenes, files of other programs, folders without cases)
lies beside it.

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
    stderr = ["a.toml: file: it is empty; ..."]                      all lines there, from the first to the last letter
    lines = 1                                                        how many lines stand there
    output = ["v_A"]                                                 texts on standard output, wherever lines break
    order = ["line OA", "line KB"]                                   texts that follow one another there
    silent = ["disagree"]                                            texts that stand nowhere in what is printed
    files = { "scene.toml" = ["[links]"] }                           files that are written, and texts in them
    absent = ["sheet.svg"]                                           files that are not
    same = [["one.svg", "two.svg"]]                                  files that are equal, byte for byte; "-" is what
                                                                     stands on standard output
    alike = [["scene.toml", "right.toml"]]                           scenes of one mechanism, whatever its links are
                                                                     called: the same places, units and velocities
    costly = true                                                    it takes seconds, and is not in the sample
    json = "results.json"                                            where the values stand, if not on standard output
    [values]                                                         values at paths of that JSON
    "links.3.omega" = 2.0833
    [within]                                                         how near, of the number's own size; 1e-9 by itself
    "links.3.omega" = 1e-4

A path goes through tables by name and through lists by number, and `#` at its end is how many there are; a value may
be a number, a text, a list or, for what must not be had, "null". A file may have several cases, each under [[case]]:
what stands above them holds for each that does not say otherwise.

Many faults of one file are a table; `check FILE`, or what `run` says, must refuse each in just these lines:

    says = "a fault of a point is told at the point"
    of = "press.toml"                                                the file that is spoilt, anew for each row
    faults = [
        ["O = [0, 0]", "O = [0]", "points.O: ...; ..."],             what stands there once, what it becomes, and the
        ["", "[find]\nlinks = 3", "find.links: ...; ..."],           line, which the file's name precedes; there may be
        ["a = 1", "", "b = 2", "b = 3", ["a: ...", "b: ..."]],       several changes, and a list of all lines
    ]
"""

from __future__ import annotations

import json
import shlex
import shutil
import tomllib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest
from face import Ran, ran

import graphplan as gp

CASES = Path(__file__).parent / "cases"
SCENES = Path(gp.__file__).parent / "scenes"
KEYS = {"says", "run", "packaged", "change", "write", "given", "status", "error", "stderr", "lines", "output", "order",
        "silent", "files", "absent", "same", "alike", "json", "values", "within", "of", "faults", "costly"}
NEAR = 1e-9


def cases() -> Iterator[Any]:
    """All cases, each with the folder of its file, by the file's name and the case's number in it."""
    for path in sorted(CASES.rglob("*.case.toml")):
        head = tomllib.loads(path.read_text(encoding="utf-8"))
        each = head.pop("case", [{}])
        name = str(path.relative_to(CASES)).removesuffix(".case.toml")
        for number, own in enumerate(each, 1):
            case = head | own
            yield pytest.param(path.parent, case, id=name if len(each) == 1 else f"{name}-{number}",
                               marks=[pytest.mark.costly] if case.get("costly") else [])


@pytest.mark.small
@pytest.mark.parametrize(("folder", "case"), [*cases()])
def test_case(folder: Path, case: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The commands of a case print, write and return as its file says."""
    monkeypatch.chdir(tmp_path)
    hold(folder, case, tmp_path)


def hold(folder: Path, case: dict[str, Any], place: Path) -> None:
    """Runs a case in a folder that is the working directory, and fails where it is not as its file says."""
    assert not {*case} - KEYS, f"unknown: {', '.join({*case} - KEYS)}"
    assert {"says", "faults" if "of" in case else "run"} <= {*case}
    lay_out(folder, case, place)
    if "of" in case:
        refuse(case, place / case["of"])
        return
    *before, last = case["run"]
    for line in before:
        done = ran(*shlex.split(line))
        assert done.status == 0, done.err
    done = ran(*shlex.split(last), given=case.get("given", ""))
    assert done.status == case.get("status", 0), done.err
    judge_printed(case, done)
    judge_files(case, done, place)
    if "values" in case:
        data = json.loads((place / case["json"]).read_text(encoding="utf-8") if "json" in case else done.out)
        for where, right in case["values"].items():
            share = case.get("within", {}).get(where, NEAR)
            assert value(data, where) == (None if right == "null" else near(right, share)), where


def judge_printed(case: dict[str, Any], done: Ran) -> None:
    """Compares what is printed with what a case says of it."""
    _, out, err = done
    for text in case.get("error", ()):
        assert any(text in line for line in err.splitlines()), f"{text!r} is not said:\n{err}"
    if "stderr" in case:
        assert err.splitlines() == case["stderr"]
    if "lines" in case:
        assert len(err.splitlines()) == case["lines"], err
    assert not [text for text in case.get("silent", ()) if text in err + out], err
    words = " ".join(out.split())
    assert not [text for text in case.get("output", ()) if text not in out and text not in words], out
    at = -1
    for text in case.get("order", ()):
        assert (at := out.find(text, at + 1)) >= 0, f"{text!r} does not follow:\n{out}"


def judge_files(case: dict[str, Any], done: Ran, place: Path) -> None:
    """Compares the files of a folder with what a case says of them."""
    for name, texts in case.get("files", {}).items():
        content = (place / name).read_bytes().decode(errors="replace")
        lacking = [text for text in texts if text not in content]
        assert not lacking, f"{name} lacks {lacking}:\n{content[:2000]}"
    assert not [name for name in case.get("absent", ()) if (place / name).exists()]
    for pair in case.get("same", ()):
        one, two = (done.out.encode() if name == "-" else (place / name).read_bytes() for name in pair)
        assert one == two, pair
    for one, two in case.get("alike", ()):
        assert (found := mechanism(place / one)).keys() == (right := mechanism(place / two)).keys()
        assert found == {what: near(at, NEAR) for what, at in right.items()}


def refuse(case: dict[str, Any], path: Path) -> None:
    """Fails where a file that is spoilt by a row of faults is not refused in the row's lines, and in these alone.

    All other files must stay as they are.
    """
    sound, otherwise, beside = path.read_text(encoding="utf-8"), list[str](), contents(path)
    for *changes, told in case["faults"]:
        path.write_text(changed(sound, path.name, [*zip(changes[::2], changes[1::2], strict=True)]), encoding="utf-8")
        lines = [f"{path.name}: {line}" for line in ([told] if isinstance(told, str) else told)]
        for line in case.get("run", [f"check {path.name}"]):
            done = ran(*shlex.split(line))
            if (done.status, done.out, done.err.splitlines()) != (2, "", lines):
                otherwise.append(f"{changes}: {done.status}\n{done.out}{done.err}instead of\n" + "\n".join(lines))
    assert not otherwise, "\n\n".join(otherwise)
    assert contents(path) == beside


def contents(path: Path) -> dict[str, bytes]:
    """The content of each file in a folder, but for one file."""
    return {other.name: other.read_bytes() for other in path.parent.iterdir() if other != path and other.is_file()}


def lay_out(folder: Path, case: dict[str, Any], into: Path) -> None:
    """Puts what a case reads into a folder."""
    for other in folder.iterdir():
        if other.is_file() and not other.name.endswith(".case.toml"):
            shutil.copy(other, into)
        elif other.is_dir() and not [*other.rglob("*.case.toml")]:
            shutil.copytree(other, into / other.name)
    for name in case.get("packaged", ()):
        shutil.copy(next(SCENES.rglob(f"{name}.toml")), into)
    for name, text in case.get("write", {}).items():
        (into / name).write_text(text, encoding="utf-8")
    for name, changes in case.get("change", {}).items():
        text = (into / name).read_text(encoding="utf-8")
        (into / name).write_text(changed(text, name, changes), encoding="utf-8")


def changed(text: str, name: str, changes: Sequence[Sequence[str]]) -> str:
    """The text of a file with each first text, which stands there once, replaced by the second."""
    for old, new in changes:
        assert not old or text.count(old) == 1, f"{name} has {old!r} {text.count(old)} times"
        text = text.replace(old, new) if old else text + new
    return text


def value(data: Any, path: str) -> Any:
    """The value at a path of JSON; `a."b.c".d` quotes a name with dots."""
    words = shlex.shlex(path, posix=True, punctuation_chars="")
    words.whitespace, words.whitespace_split, words.commenters = ".", True, ""
    for key in words:
        data = len(data) if key == "#" else data[int(key)] if isinstance(data, list) else data[key]
    return data


def near(right: Any, share: float) -> Any:
    """A number, or a list of numbers, to be met within a share of its size."""
    numbers = right if isinstance(right, list) else [right]
    numeric = all(isinstance(number, float) or type(number) is int for number in numbers)
    return pytest.approx(right, rel=share, abs=share * 1e-3) if numeric else right


def mechanism(path: Path) -> dict[Any, Any]:
    """A scene without names: its units, its links by where their points lie, and how these places move."""
    scene = gp.load(path)
    at = {name: tuple(round(float(part), 9) + 0.0 for part in place) for name, place in scene.points.items()}
    links = [(name == "frame", tuple(sorted(at[point] for point in held))) for name, held in scene.links.items()]
    units = "units", scene.units.length, scene.units.force, scene.units.mass
    found: dict[Any, Any] = {units: 1} | {("link", *link): links.count(link) for link in links}
    rates = gp.analytic.solve(scene) if scene.drives or scene.motions else None
    for name, velocity in sorted(rates.velocity.items(), key=lambda item: abs(item[1])) if rates else ():
        found.setdefault(("velocity", at[name]), []).extend([velocity.real, velocity.imag])
    return found


RIGHT = {"says": "", "packaged": ["four-bar", "slider-crank"], "run": ["steps four-bar.toml -q", "solve four-bar.toml"]}
FAULT = {"says": "", "packaged": ["four-bar"], "of": "four-bar.toml",
         "faults": [['1 = "O A"', '1 = "O Q"', "links.1: there is no point Q; one of A, B, C, M, O"]]}


@pytest.mark.parametrize("right", [RIGHT, FAULT], ids=["run", "faults"])
def test_a_right_case_holds(right: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The cases that are made wrong below are right as they stand."""
    monkeypatch.chdir(tmp_path)
    hold(CASES / "protocol", right, tmp_path)


@pytest.mark.parametrize("wrong", [
    {"status": 2}, {"run": ["solve nosuch", "solve four-bar.toml"]}, {"error": ["no word of it"]}, {"lines": 1},
    {"stderr": ["no word of it"]}, {"output": ["no word of it"]}, {"order": ["links", "points"]}, {"silent": ["title"]},
    {"files": {"four-bar.toml": ["no word of it"]}}, {"absent": ["four-bar.toml"]}, {"strange": 1},
    {"same": [["four-bar.toml", "slider-crank.toml"]]}, {"same": [["four-bar.toml", "-"]]},
    {"alike": [["four-bar.toml", "slider-crank.toml"]]}, {"values": {"links.3.omega": 2.2500001}},
    {"values": {"links.3.omega": "null"}}, {"values": {"links.#": 4}}, {"values": {"points.B.velocity": [1, 2]}},
    {"change": {"four-bar.toml": [["no word of it", ""]]}}, {"change": {"four-bar.toml": [["omega = 10", "omega = 1"]]},
                                                              "values": {"links.1.omega": 10}},
], ids=str)
def test_a_wrong_case_fails(wrong: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each key of a case can fail, and an unknown one is named."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(AssertionError, match="unknown: strange" if "strange" in wrong else None):
        hold(CASES / "protocol", RIGHT | wrong, tmp_path)


@pytest.mark.parametrize("row", [
    ["1 = ", "1 = ", FAULT["faults"][0][-1]], [*FAULT["faults"][0][:2], "links.1: there is no point Q"],
    [*FAULT["faults"][0][:2], [FAULT["faults"][0][-1], "drive: another fault; none"]],
    ["no word of it", "", FAULT["faults"][0][-1]],
], ids=["sound", "half a line", "a line too many", "nothing to change"])
def test_a_wrong_row_of_faults_fails(row: list[Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A row must be refused, in these lines and in no others."""
    monkeypatch.chdir(tmp_path)
    with pytest.raises(AssertionError):
        hold(CASES / "protocol", FAULT | {"faults": [*FAULT["faults"], row]}, tmp_path)
