"""Anything by chance: scenes, options, drawings and files of other programs, spoilt, always the same for a seed.

Whatever a command is given, it ends with status 0, 1, 2 or 3, without a traceback or a warning; a failure is said in
lines that can be printed, each with what would be right, and leaves no part of a file.
"""

from __future__ import annotations

import io
import re
import warnings
import zipfile
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from pathlib import Path
from random import Random
from xml.etree import ElementTree

import pytest
from face import names, ran

import graphplan as gp

CASES = Path(__file__).parents[1] / "cases"


def complaint(words: Sequence[str | Path], given: str = "") -> str:
    """What is wrong with how a command goes; empty where nothing is."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # it would be told on standard error
            status, out, err = ran(*words, given=given)
    except Exception as error:
        last = error.__traceback__
        while last and last.tb_next:
            last = last.tb_next
        place = f"{Path(last.tb_frame.f_code.co_filename).name}:{last.tb_lineno}" if last else ""
        return f"{type(error).__name__} at {place}: {error}"
    told, wrong = err.splitlines(), []
    if status not in (0, 1, 2, 3):
        wrong.append(f"exit status {status}")
    if status in (2, 3) and not told:
        wrong.append("no word of what is wrong")
    if not all(line.isprintable() for line in told):
        wrong.append(f"told {err[:300]!r}")
    if status in (2, 3) and not out:  # of what is printed all the same, such as poses, some are told to be wrong
        wrong += [f"told {line[:300]!r}" for line in told if ": " not in line or not re.search("; |Do: ", line)]
    return ", ".join(wrong)


# ---- scenes ----------------------------------------------------------------------------------------------------------

NUMBER = re.compile(r"(?<![\w.\"-])-?\d+(?:\.\d+)?(?![\w.\"])")
NAME = re.compile(r"\b[A-Za-z]\w*\b|\"\w+\"|(?m:^\w+)(?= *=)")
VALUE = re.compile(r"(?m)(?<== )[^=\n]+$")
EXTREMES = ("0", "-0.0", "1", "-1", "1e-9", "1e9", "1e-30", "1e30", "9e59", "1e60", "1e-60", "1e-61", "-1e59", "nan",
            "inf", "-inf", "1" + "0" * 40, "1" + "0" * 5000, "0.1", "0.333333333333333333333333", "1e400", "12,5",
            "250 mm", "95 rpm", "20°", "0x10", "1_000")
VALUES = ("true", '"text"', '""', "[]", "{}", "[1]", "[1, 2, 3]", "[[1, 2]]", "1979-05-27", "07:32:00", '"A"', '"1"',
          '"frame"', '"all"', "{ from = 1 }", "''", "2", "[0, 0]", '["1", "2"]', '"A A"', '"A, B"', f'"{"A" * 400}"',
          "a" + ".a" * 3000 + " = 1", "[" * 3000)
STRANGE = ("é", "λ", "𝔸", "\u202e", "\u0000", "\x1b[31m", "\ufeff", "٣", "’", "\t", "\r", "  ", '"', "]", "{", "#",
           "\\", "=", "\ud7ff")


def exchanged(pattern: re.Pattern[str], new: Callable[[str, Random, list[str]], str]) -> Callable[[str, Random], str]:
    """A mutation: something of a pattern is replaced, somewhere."""
    def mutation(text: str, chance: Random) -> str:
        found = list(pattern.finditer(text))
        if not found:
            return text
        at = chance.choice(found)
        return text[: at.start()] + new(at[0], chance, [one[0] for one in found]) + text[at.end():]

    return mutation


def by_lines(edit: Callable[[list[str], Random], object]) -> Callable[[str, Random], str]:
    """A mutation of the lines of a text."""
    def mutation(text: str, chance: Random) -> str:
        lines = text.splitlines()
        edit(lines, chance)
        return "\n".join(lines) + "\n"

    return mutation


def character(text: str, chance: Random) -> str:
    """A character is dropped, one that nobody types is put in, or the end is missing."""
    at = chance.randrange(len(text))
    return text[:at] + chance.choice((text[at + 1:], chance.choice(STRANGE) + text[at:], ""))


def swapped(text: str, chance: Random) -> str:
    """Two names are exchanged everywhere."""
    one, two = (chance.choice(sorted({*re.findall(r"\b\w+\b", text)}) or [""]) for _ in range(2))
    return re.sub(rf"\b(?:{one}|{two})\b", lambda name: two if name[0] == one else one, text)


def shuffled(text: str, chance: Random) -> str:
    """The sections stand in another order."""
    head, *sections = re.split(r"(?m)^(?=\[)", text)
    chance.shuffle(sections)
    return head + "\n".join(section.rstrip("\n") + "\n" for section in sections)


def near(number: str, chance: Random, _: list[str]) -> str:
    """A number is off by a little, or by its sign."""
    return f"{float(number) * (1 + chance.choice((1e-13, -1e-9, 1e-6, -2, 9, -0.5))):.17g}"


extreme = exchanged(NUMBER, lambda _, chance, others: chance.choice(EXTREMES))
other = exchanged(NUMBER, lambda _, chance, others: chance.choice(others))
renamed = exchanged(NAME, lambda _, chance, others: chance.choice(others))
typed = exchanged(VALUE, lambda _, chance, others: chance.choice(VALUES))
removed = by_lines(lambda lines, chance: lines.pop(chance.randrange(len(lines))))
doubled = by_lines(lambda lines, chance: lines.insert(chance.randrange(len(lines)), chance.choice(lines)))
moved = by_lines(lambda lines, chance: lines.insert(chance.randrange(len(lines)),
                                                    lines.pop(chance.randrange(len(lines)))))
MUTATIONS = (character, character, character, extreme, extreme, other, other, exchanged(NUMBER, near), renamed, renamed,
             swapped, typed, typed, removed, removed, doubled, moved, shuffled)
QUICK = (  # tried with each scene in turn
    "solve -", "check -", "solve - --exact", "steps -", "solve - --method trial", "check - --plan polar",
    "solve - --digits 12", "check - --json --set sheet.inertia=points", "solve - --method poles --plan polar",
    "check - --exact --set sheet.inertia=shifted")
SLOW = (  # tried now and then
    "draw - -o out.svg", "draw - --strict", "cycle - --positions 6", "draw - --plan polar -o out.dxf",
    "export - -o out.tex", "export - -o out.ggb", "handout - -o out.html --positions 2", "steps - --prefer quick",
    "draw - --steps 2-5 -o out.pdf", "cycle - --positions 12 --plot out.svg", "handout - -o out.pdf --only guided")


def spoilt(text: str, chance: Random) -> str:
    """The text with one to three mutations."""
    for mutation in chance.choices(MUTATIONS, k=chance.choice((1, 1, 1, 2, 3))):
        text = mutation(text, chance) if text.strip() else text
    return text


@cache
def scenes() -> list[str]:
    """The texts that are spoilt: the packaged scenes, those that once failed, and the small ones of the faults."""
    paths = [*(CASES / "once-wrong").glob("*.toml"), *(CASES / "faults").glob("*.toml")]
    files = sorted(path for path in paths if not path.name.endswith(".case.toml"))
    return [*(gp.load(name).text for name in names()), *(path.read_text(encoding="utf-8") for path in files)]


@pytest.mark.parametrize("part", range(10))
def test_spoilt_scenes(part: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A scene that is spoilt is refused, or done; of what is refused no file is left."""
    monkeypatch.chdir(tmp_path)
    found = {}
    for seed in range(part, 220, 10):
        chance = Random(seed)
        text = spoilt(chance.choice(scenes()), chance).encode("utf-8", "replace").decode()
        line = chance.choice(SLOW if chance.randrange(6) == 0 else QUICK)
        if wrong := complaint(line.split(), text):
            found[seed] = f"{line}: {wrong}\n{text}"
        if (left := [*tmp_path.iterdir()]) and ran(*line.split(), given=text).status in (2, 3):
            found[seed] = f"{line} leaves {left}\n{text}"
        for path in left:
            path.unlink()
    assert not found, "\n\n".join(f"--- {seed}: {told}" for seed, told in found.items())


# ---- options ---------------------------------------------------------------------------------------------------------

SCENES = ("four-bar", "four-bar", "slider-crank", "open-chain", "jaanimets-10", "no-such-scene", "", "-", ".", "é",
          "a\0b", "/dev/null")
LONG = {"board": ["."], "chart": ["no-such-chart", "."], "gallery": ["/dev/null/site"],
        "watch": ["no-such-file"]}  # minutes in earnest, or no end
WORDS = ("", "-", "0", "-1", "1", "3", "12", "-0.5", "1.5", "nan", "inf", "-inf", "1e18", "1e400", "1" + "0" * 30, "9"
         * 5000, "1000000000", "x", "é", "\x1b[31m", "a\nb", "a\0b", "a,b", "=", ",", "--", "-x", "--nosuch", "all",
         "2-5", "5-2", "point=1", "point=nan", "point=-1,edge=2", "point=1e308", "right=1e9", "follows=inf",
         "numbers=0", "angle=44", "polar", "lever", "orthogonal,polygons", "polar,polar", "B.x", "3", "A4", "iso",
         "en", "en_US", "auxiliary")
FILES = ("-", "x.svg", "x.pdf", "x.png", "x.dxf", "x.csv", "x.npz", "x.html", "x.json", "x.gif", "x", "no/x.svg",
         "points.csv", "/dev/full", "/dev/null", "scene.toml", "x" * 300 + ".svg", "a\0b.svg", "é.svg", "x.SVG",
         "x.tex", "x.toml")
NEEDED = {"SCENE": "four-bar", "TASK": "gear-21-1", "DRAWING": "points.csv", "FOLDER": "x", "FILE": "x.toml"}
COMMANDS = re.findall(r"(?m)^    (\w+)\s", ran("--help").out.partition("\nexamples:")[0])


@cache
def takes(command: str) -> tuple[list[tuple[str, str]], list[str]]:
    """The options of a command, each with what it takes, and its arguments, as its help has them."""
    head, _, rest = ran(command, "--help").out.partition("\noptions:\n")
    usage = " ".join(head.partition("\n\n")[0].split())
    line = r"(?m)^  (-[\w-]+)(?: (\{[^}]*\}|[^\s,]+))?(?:, (--[\w-]+))?"
    options = re.findall(line, rest.partition("\nexample")[0])
    known = [(long or short, value) for short, value, long in options if short != "-h"]
    return known, re.findall(r" ([A-Z]{3,})(?= |$)", re.sub(r"\[[^\]]*\]|-\S+ \S+", "", usage))


def words(command: str, chance: Random) -> Iterator[str]:
    """A command with some of its options; what it cannot do without is left out only now and then."""
    yield from (command, *LONG.get(command, ()))
    options, arguments = takes(command)
    for argument in arguments if command not in LONG else ():
        if chance.randrange(12):
            yield chance.choice(SCENES if argument == "SCENE" else FILES)
    for option, value in options:
        if chance.randrange(2 if option == "--output" else 6):
            continue
        yield option
        if value.startswith("{") and chance.randrange(4):
            yield chance.choice(value.strip("{}").split(","))
        elif value:
            yield chance.choice(FILES if re.search(r"FILE|FOLDER|\.", value) and chance.randrange(8) else WORDS)
    if chance.randrange(10) == 0:
        yield chance.choice(("--nosuch", "-Z", "more", "--output", "-o", "--help-me"))


@pytest.mark.parametrize("part", range(8))
def test_options_by_chance(part: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever words a command gets; a scene that is there is never overwritten."""
    monkeypatch.chdir(tmp_path)
    Path("scene.toml").write_text("mine")
    Path("points.csv").write_text("mark,x,y\nA,32.1,46.0\n")
    found = {}
    for seed in range(part, 240, 8):
        chance = Random(seed)
        said = [*words(chance.choice(COMMANDS), chance)]
        if wrong := complaint(said):
            found[seed] = f"{said}: {wrong}"
        assert Path("scene.toml").read_text() == "mine" or "scene.toml" in said[2:], said
        Path("scene.toml").write_text("mine")
    assert not found, "\n".join(f"--- {seed}: {told}" for seed, told in found.items())


@pytest.mark.parametrize("command", COMMANDS)
def test_unknown_options_and_bad_numbers_are_one_line(command: str, tmp_path: Path,
                                                      monkeypatch: pytest.MonkeyPatch) -> None:
    """Each command tells an option that it does not know in one line with status 2, and where its options stand; an
    option that takes a number refuses what is none."""
    monkeypatch.chdir(tmp_path)
    options, arguments = takes(command)
    given = LONG.get(command) or [NEEDED.get(argument, "bash") for argument in arguments]
    output = ["-o", "x.html"] if command in ("export", "live", "handout", "import", "report", "variants") else []
    done = ran(command, *given, *output, "--zzz")
    assert (done.status, done.out, done.err.count("\n")) == (2, "", 1), done.err
    assert "--zzz" in done.err
    assert "--help" in done.err
    for option, value in options:
        if value in ("N", "K", "S", "W") and command not in LONG and option != "--workers":
            for number in ("nan", "inf", "-1", "1e400", "x", "", "9" * 5000):
                done = ran(command, *given, *output, f"{option}={number}")
                assert (done.status, done.out, done.err.count("\n")) == (2, "", 1), (option, number, done.err)
    assert not [*tmp_path.iterdir()]


# ---- drawings and files of other programs ----------------------------------------------------------------------------


def spoilt_file(kind: str, data: bytes, chance: Random) -> bytes:
    """The file with its text spoilt, or with bytes changed, missing or doubled."""
    if kind in ("svg", "dxf", "csv", "toml"):
        return spoilt(data.decode(), chance).encode("utf-8", "surrogatepass")
    if kind == "ggb":
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            members = {name: archive.read(name) for name in archive.namelist()}
        with zipfile.ZipFile(out := io.BytesIO(), "w") as archive:
            for name, member in members.items():
                archive.writestr(name, spoilt_file("svg", member, chance) if name.endswith(".xml") else member)
        return out.getvalue()
    start, length = chance.randrange(len(data)), chance.choice((1, 8, 500))
    return data[:start] + chance.choice((b"", chance.randbytes(length), 2 * data[start:start + length])) + data[
        start + length:]


@pytest.fixture(scope="module")
def drawings(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """A drawing of the four-bar linkage in every kind of file."""
    folder, drawing = tmp_path_factory.mktemp("drawings"), gp.construct(gp.load("four-bar"))
    for kind in ("svg", "dxf", "pdf", "png"):
        drawing.save(folder / f"sheet.{kind}", by="sheet")
    assert ran("export", "four-bar", "-q", "-o", folder / "sheet.ggb").status == 0
    marks = {"O": (20, 20), "A": (30, 75), "B": (87, 132), "C": (175, 20), "v_a": (-10, 90), "v_b": (60, 150)}
    (folder / "sheet.csv").write_text("\n".join(["mark,x,y", *(f"{name},{x},{y}" for name, (x, y) in marks.items())]))
    (folder / "sheet.toml").write_text("\n".join(["[marks]", *(f"{name} = {[*at]}" for name, at in marks.items())]))
    return {path.suffix[1:]: path.read_bytes() for path in folder.iterdir()}


@pytest.mark.parametrize("part", range(3))
def test_spoilt_drawings(part: int, drawings: dict[str, bytes], tmp_path: Path,
                         monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever is handed in, verify ends with a status, and with a whole report or none."""
    monkeypatch.chdir(tmp_path)
    found = {}
    for seed in range(part, 30, 3):
        chance = Random(seed)
        kind = ("svg", "dxf", "csv", "toml", "ggb", "pdf", "png")[seed % 7]
        Path(f"drawing.{kind}").write_bytes(data := spoilt_file(kind, drawings[kind], chance))
        if wrong := complaint(["verify", "four-bar", f"drawing.{kind}", "-q", "--report", "report.html"]):
            found[seed] = f"{kind}: {wrong}\n{data[:200]!r}"
        if (report := Path("report.html")).exists():
            assert report.read_text(encoding="utf-8").rstrip().endswith("</html>"), seed
            report.unlink()
        Path(f"drawing.{kind}").unlink()
        assert not [*tmp_path.iterdir()], seed
    assert not found, "\n\n".join(f"--- {seed}: {told}" for seed, told in found.items())


def without(element: ElementTree.Element, chance: Random) -> str:
    """An attribute or a child of something is removed, or a strange one added; says what."""
    parents = [one for one in element.iter() if one.attrib]
    one, kind = chance.choice(parents), chance.choice(("attribute", "child", "stranger"))
    if kind == "attribute":
        name = chance.choice([*one.attrib])
        del one.attrib[name]
        return f"{name} of {one.tag} removed"
    if kind == "child" and (full := [parent for parent in element.iter() if len(parent)]):
        parent = chance.choice(full)
        child = chance.choice([*parent])
        parent.remove(child)
        return f"{child.tag} of {parent.tag} removed"
    ElementTree.SubElement(one, "strange", {"more": "1"})
    return f"a stranger in {one.tag}"


def mutant(name: str, data: bytes, chance: Random) -> tuple[str, bytes]:
    """A file of another program with something removed or added, and what that is."""
    if name.endswith(".linkage2"):
        root = ElementTree.fromstring(data)
        return without(root, chance), ElementTree.tostring(root)
    if name.endswith(".ggb"):
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            root = ElementTree.fromstring(archive.read("geogebra.xml"))
        construction = root.find("construction")
        assert construction is not None
        held = ElementTree.Element("all", {"x": "1"})
        held.extend(construction)
        done = without(held, chance)
        construction[:] = [*held]
        with zipfile.ZipFile(packed := io.BytesIO(), "w") as archive:
            archive.writestr("geogebra.xml", ElementTree.tostring(root))
        return done, packed.getvalue()
    lines = data.decode().splitlines()
    if name.endswith(".dxf"):
        first = lines.index("ENTITIES") + 1
        starts = [place for place in range(first, len(lines) - 1, 2) if lines[place].strip() == "0"]
        which = chance.randrange(len(starts) - 2)
        if chance.random() < 0.5:
            lines[starts[which]: starts[which]] = ["  0", "STRANGE", "  5", "FFFF", "  8", "0"]
            return f"a stranger before line {starts[which]}", "\n".join(lines).encode() + b"\n"
        del lines[starts[which]: starts[which + 1]]
        return f"the entity at line {starts[which]} removed", "\n".join(lines).encode() + b"\n"
    between = "%0A" if "?j=" in lines[0] else "\n"
    rows = between.join(lines).split(between)
    place = chance.choice([place for place, row in enumerate(rows) if "," in row])
    cells = rows[place].split(",")
    if chance.random() < 0.5:
        rows[place] += ",strange"
        return f"a stranger in row {place}", between.join(rows).encode()
    full = [at for at, cell in enumerate(cells) if cell]
    del cells[at := chance.choice(full)]
    rows[place] = ",".join(cells)
    return f"cell {at} of row {place} removed", between.join(rows).encode()


SOURCES = [path for folder in ("importing/programs", "strangers/import") for path in sorted((CASES / folder).iterdir())
           if path.suffix != ".toml" and not re.search(rb"\?(?!j=)", path.read_bytes())]


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.name)
def test_a_mutant_is_told_from_its_file(path: Path, tmp_path: Path) -> None:
    """Nothing of a file is lost silently: what is removed or added changes the scene or the remarks, or is refused."""
    def imported(data: bytes) -> tuple[int, str, str]:
        (tmp_path / path.name).write_bytes(data)
        out = tmp_path / "scene.toml"
        out.unlink(missing_ok=True)
        done = ran("import", tmp_path / path.name, "-o", out)
        return done.status, out.read_text(encoding="utf-8") if out.exists() else "", done.err

    whole = imported(path.read_bytes())
    assert whole[0] == 0, whole[2]
    for seed in range(4):
        done, data = mutant(path.name, path.read_bytes(), Random(f"{path.name} {seed}"))
        status, scene, remarks = imported(data)
        if status:
            assert (status, scene, len(remarks.splitlines())) == (2, "", 1), done
            assert remarks.startswith(f"{tmp_path / path.name}: ")
        else:
            assert (scene, remarks) != whole[1:], done


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.name)
def test_spoilt_files_of_other_programs(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Bytes that are lost on the way, doubled or made others: a scene comes of them, or one line and no scene."""
    monkeypatch.chdir(tmp_path)
    for seed in range(3):
        data = spoilt_file("png", path.read_bytes(), Random(f"{path.name} {seed}"))
        Path(path.name).write_bytes(data)
        wrong = complaint(["import", path.name, "-o", "scene.toml", "-q"])
        assert not wrong, f"{seed}: {wrong}\n{data[:200]!r}"
        Path("scene.toml").unlink(missing_ok=True)


def test_what_is_nested_without_end_is_no_scene(tmp_path: Path) -> None:
    """However deep a text nests, it is refused in one line."""
    (tmp_path / "deep.toml").write_text("a = " + "[" * 1_000_000)
    refused = ran("solve", tmp_path / "deep.toml")
    assert (refused.status, refused.err.count("\n")) == (2, 1)
    assert "nested too deeply" in refused.err
