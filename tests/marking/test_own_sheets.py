"""Draw, then verify: graphplan's own sheets, read back from their files, are faultless drawings."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from functools import cache
from html import escape
from itertools import cycle
from pathlib import Path

import pytest
from sampling import CORE

import graphplan as gp
from graphplan.accuracy.hand import Pencil
from graphplan.errors import GraphplanError
from graphplan.importing import embedded_scene
from graphplan.kernel.kinds import LINE, Movement
from graphplan.marking.files import measures
from graphplan.marking.files.pdf import read_pdf
from graphplan.marking.judge.findings import opinion
from graphplan.marking.judge.judge import judge
from graphplan.marking.judge.score import Weights, score
from graphplan.marking.judge.verdict import MISSING, RIGHT, UNCLEAR, WRONG, Judgement
from graphplan.marking.submission import read_submission
from graphplan.marking.traces import PlanFrame, Submission, Trace
from graphplan.mechanism.model import Scene
from graphplan.mechanism.written_scene import parse
from graphplan.output import pdf as pdf_writer
from graphplan.output.dxf import dxf
from graphplan.output.exports.geogebra import geogebra
from graphplan.output.pdf import pdf
from graphplan.output.svg import svg
from graphplan.public import drafting
from graphplan.public.drafting import Options
from graphplan.public.verifying import desk_for
from graphplan.sheet.layout.composition import Composition, compose
from graphplan.sheet.layout.layout import pages
from graphplan.sheet.plates.display import Text

SCENES = sorted(path.stem for path in (Path(gp.__file__).parent / "scenes").glob("*.toml"))


@pytest.mark.parametrize(("name", "other"), list(zip(SCENES, cycle(["dxf", "ggb", "pdf"]), strict=False)))
def test_own_sheets_are_faultless(name: str, other: str, tmp_path: Path) -> None:
    """No mark of a packaged scene's sheet is wrong or missing, as SVG and in one of the other formats in turn, and all
    points are earned."""
    composition = compose(gp.construct(gp.load(name)))
    drawing = composition.plans.drawing
    sheet, *more = pages(composition)
    files = {"svg": lambda: svg(sheet).encode(), "dxf": lambda: dxf([sheet, *more], composition.plates),
             "ggb": lambda: geogebra(composition.plates), "pdf": lambda: pdf([sheet, *more])}
    for kind in ("svg", other):
        path = tmp_path / f"sheet.{kind}"
        path.write_bytes(files[kind]())
        found = read_back(composition, path)
        assert not [(kind, drawing.drawn.text(verdict.step), verdict.state) for verdict in found.verdicts
                    if verdict.state in (WRONG, MISSING, UNCLEAR)]
        assert (kind, score(found).total, str(found.reading)) == (kind, 100, "")


DRAWN = [
    *({"language": code} for code in ("de", "lv", "et", "ru", "uk")), {"strict": True}, {"protocol": "apart"},
    *({"plan": plan} for plan in ("polar", "orthogonal", "lever", "polygons")), {"paper": "A2"}, {"paper": "Tabloid"},
    *({"method": method} for method in ("auxiliary", "trial", "poles")), {"prefer": "accurate"}, {"curves": "all"},
    {"frame": "gost", "language": "uk"}, {"pencil": "point=0.3"}, {"positions": 6}, {"inertia": "static"}]
KINDS = "svg", "dxf", "pdf"


@pytest.mark.parametrize("name", CORE)
def test_own_sheets_need_not_be_told(name: str, tmp_path: Path) -> None:
    """Whatever the language, the paper, the plans and the form of a sheet: verified as the scene's, at most one mark of
    a hundred is not right, as where letters in a crowd stand nearest to another dot, and the words are in the language
    that is asked for. Each scene is drawn in a fifth of the ways, so that each way is tried on four."""
    scene, number = gp.load(name), CORE.index(name)
    desk, kind = desk_for(scene, Weights(), Options(), {}), KINDS[number % 3]
    for how in DRAWN[number % 5::5]:
        try:
            gp.construct(scene, **how).save(path := tmp_path / f"sheet.{kind}", by="sheet")
        except GraphplanError:  # the scene has no such sheet
            continue
        judged = desk.judge_file(path)
        verdicts = judged.judgement.verdicts
        assert 100 * sum(verdict.state in (WRONG, MISSING, UNCLEAR) for verdict in verdicts) <= len(verdicts), how
        assert judged.judgement.composition.plans.tongue.code == scene.sheet.language


@pytest.mark.parametrize("name", ["four-bar", "ozols-13-6"])
def test_pdfs_of_drawing_programs_are_read_by_their_strokes(
        name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A PDF that does not say what its layers are is judged as the drawing that it is, not as a picture of it; one with
    the corner marks of a printed task is looked at, and so is one without letters."""
    composition = compose(gp.construct(gp.load(name)))
    sheet = pages(composition)[0]
    monkeypatch.setattr(pdf_writer, "_layer", lambda item: "ink")
    (path := tmp_path / "sheet.pdf").write_bytes(pdf([sheet]))
    assert score(read_back(composition, path)).total == 100
    assert read_pdf(path, {}, None, lambda: True) is None
    strokes = tuple(item for item in sheet.items if not isinstance(item, Text))
    path.write_bytes(pdf([replace(sheet, items=strokes)]))
    assert read_pdf(path, {}, None, lambda: False) is None


def test_a_pdf_of_more_pieces_than_a_drawing_has_is_looked_at(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Handwriting in outlines over a printed task is no reason to refuse it."""
    (path := tmp_path / "sheet.pdf").write_bytes(pdf([pages(four_bar(""))[0]]))
    assert read_pdf(path, {}, None, lambda: False) is not None
    monkeypatch.setattr(measures, "MAX_PATH_PIECES", 100)
    assert read_pdf(path, {}, None, lambda: False) is None


def test_scenes_in_files_of_strangers_are_not_drawn(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A scene of another mechanism, of the same with more to it, or far too long is told before it is drawn."""
    scene = gp.load("four-bar")
    desk = desk_for(scene, Weights(), Options(), {})
    gp.construct(scene, paper="A2").save(path := tmp_path / "sheet.svg", by="sheet")
    own = embedded_scene(path, path.read_bytes())
    drawn: list[Scene] = []
    on_paper = drafting.on_paper
    monkeypatch.setattr(drafting, "on_paper", lambda scene, options: drawn.append(scene) or on_paper(scene, options))
    for text in (gp.load("rosenauer-example-2").text, own.replace("[points]", "[points]\nZ = [1, 2]"),
                 own + "# more\n" * 100_000, "x = " + "[" * 50_000):
        path.write_text(f'<svg><metadata id="scene">{escape(text)}</metadata></svg>')
        assert desk._desk_for_own_sheet(path) is desk
    assert not drawn
    path.write_text(f'<svg><metadata id="scene">{escape(own)}</metadata></svg>')
    assert desk._desk_for_own_sheet(path) is not desk
    assert drawn


def test_a_form_that_is_asked_for_is_asked_of_own_sheets(tmp_path: Path) -> None:
    """On a sheet of the student's own, too, the plan counts that the teacher asks for."""
    scene = gp.load("four-bar")
    gp.construct(scene, plan="polar", paper="A2").save(path := tmp_path / "sheet.svg", by="sheet")
    asked = Options(plan="polar")
    own = desk_for(scene, Weights(), asked, {})._desk_for_own_sheet(path)
    assert (own.options, own.on_sheet.drawing.scene.sheet.paper) == (asked, "A2")


@pytest.mark.parametrize("travels", [0, 60])
def test_of_an_own_sheet_of_another_form_its_points_are_right(travels: int, tmp_path: Path) -> None:
    """Where another plan is asked for than a sheet has, whatever its pose, no given point of it is wrong: what is told
    is the plan that is not there."""
    scene = gp.load("four-bar")
    gp.construct(gp.at(scene, travels) if travels else scene).save(path := tmp_path / "sheet.svg", by="sheet")
    judged = desk_for(scene, Weights(), Options(plan="polar"), {}).judge_file(path).judgement
    givens = judged.drawing.drawn.givens
    assert judged.other_pose == (f"{travels}" if travels else "")
    assert {verdict.state for verdict in judged.verdicts[:givens]} == {RIGHT}
    assert judged.composition.plans.plan_of_step[judged.first_wrong.step] == "velocity plan"


def test_scales_that_a_task_gives_are_no_choice(tmp_path: Path) -> None:
    """A sheet of the student's own at another scale than the task's is judged by the task's; where the task gives none,
    by its own."""
    text = gp.load("four-bar").text
    theirs = text.replace("[sheet]", "[sheet]\nk_v = 45")
    gp.construct(parse(theirs)).save(path := tmp_path / "sheet.svg", by="sheet")
    for task, is_own in ((text.replace("[sheet]", "[sheet]\nk_v = 30"), False), (text, True)):
        desk = desk_for(parse(task), Weights(), Options(), {})
        assert (desk._desk_for_own_sheet(path) is not desk) is is_own
        assert (desk.judge_file(path).score.total == 100) is is_own


@pytest.mark.parametrize("opening", ['<metadata id="scene">', "<metadata ", '<metadata id="scene" '])
def test_openings_without_end_are_no_scene(opening: str) -> None:
    """A million of them, of which each would be looked through to the end, do not hang the program."""
    assert embedded_scene(Path("sheet.svg"), b"<svg>" + opening.encode() * 1_000_000) == ""


def submitted(composition: Composition, path: Path) -> Submission:
    """A sheet of a composition, read from its file."""
    frames = {panel: PlanFrame(complex(*view.origin), view.scale) for panel, view in composition.views.items()}
    arrangement = composition.arrangement
    return read_submission(path, list(composition.views), frames, size=(arrangement.width, arrangement.height))


def read_back(composition: Composition, path: Path) -> Judgement:
    """What is said of it."""
    return judge(composition.plans.drawing, composition, submitted(composition, path), Pencil())


def test_lines_of_own_sheets_are_as_sure_as_their_numbers(tmp_path: Path) -> None:
    """Their ends are rounded to 0.01 mm, which moves where two lines cross that are almost parallel: a mark made there
    to the same hundredth is right."""
    (path := tmp_path / "sheet.svg").write_text(text := svg(pages(four_bar(""))[0]), encoding="utf-8")
    (stranger := tmp_path / "other.svg").write_text(text.replace('class="layer-paper"', ""), encoding="utf-8")
    for file, blur in ((path, 0.01 / math.sqrt(12)), (stranger, 0.0)):
        lines = [trace.blur for trace in read_submission(file, [], {}).traces if trace.kind == LINE]
        assert lines == pytest.approx([blur] * len(lines))
        assert lines


def own_score(scene: Scene, folder: Path, strict: bool = False) -> float | None:
    """What a scene's own sheet earns."""
    composition = compose(gp.construct(scene, strict=strict))
    (path := folder / "sheet.svg").write_bytes(svg(pages(composition)[0]).encode())
    return score(read_back(composition, path)).total


@pytest.mark.parametrize("name", [
    "inflection-circle", "jaanimets-11", "triad-loaded", "ozols-13-7", "rosenauer-loaded"])
def test_compasses_alone_make_marks_twice_and_beyond_the_paper(name: str, tmp_path: Path) -> None:
    """A point that is made twice has one dot, neither is wrong for that; arcs beyond the paper are not asked for; a
    point that is chosen on a line is the dot there that is nearest to where the sheet has it. Letters of a mark that
    the sheet leaves out, as of a force too short to be drawn, are no second letters of a dot beside them."""
    assert own_score(gp.load(name), tmp_path, strict=True) == 100


@pytest.mark.parametrize("name", ["ozols-13-6", "jaanimets-10", "ozols-10-1"])
def test_corners_without_dots_are_where_arrows_end(name: str, tmp_path: Path) -> None:
    """On sheets of loaded scenes, where letters stand at corners of force polygons that are but the tips of arrows."""
    assert own_score(gp.load(name), tmp_path) == 100


@pytest.mark.parametrize("name", ["ozols-13-6", "ozols-10-1", "triad-loaded", "rosenauer-loaded"])
def test_corners_without_dots_have_letters(name: str, tmp_path: Path) -> None:
    """Where a file does not say what its layers are, and so not where its plans lie: by its ink and letters alone."""
    composition = compose(gp.construct(gp.load(name)))
    text = re.sub(r' class="[^"]*"', "", svg(pages(composition)[0]))
    (path := tmp_path / "sheet.svg").write_text(text, encoding="utf-8")
    assert score(read_back(composition, path)).total == 100


def shift_mark(text: str, spot: tuple[float, float], letters: str, by: tuple[float, float],
               with_letters: bool = True) -> str:
    """An SVG sheet on which a dot lies elsewhere, and its letters if they follow it, and nothing else."""
    def shift(found: re.Match[str]) -> str:
        x, y = (float(found[k]) + far for k, far in zip((2, 4), by, strict=True))
        return f"{found[1]}{x:.2f}{found[3]}{y:.2f}{found[5]}"

    x, y = (re.escape(f"{round(coordinate, 2):g}") for coordinate in spot)
    dot = rf'(<circle cx=")({x})(" cy=")({y})(")'
    name, _, low = letters.partition("_")
    written = rf"<tspan>{name}</tspan><tspan [^>]*>{low}<" if low else f"{name}<"
    words = rf'(<text [^>]*x=")([\d.]+)(" y=")([\d.]+)(">{written})'
    for pattern in (dot, words) if with_letters else (dot,):
        text, count = re.subn(pattern, shift, text)
        assert count == 1
    return text


@cache
def four_bar(plan: str) -> Composition:
    """The sheet of the four-bar linkage."""
    return compose(gp.construct(gp.load("four-bar"), plan=plan))


@pytest.mark.parametrize(("letters", "plan", "with_letters"), [
    ("v_m", "", True), ("A_1", "", True), ("p", "polar", True), ("v_m", "", False), ("p", "polar", False)])
def test_a_mark_that_was_moved_is_told(letters: str, plan: str, with_letters: bool, tmp_path: Path) -> None:
    """A dot with its letters, or without them, 6 mm off where strokes still cross and the arrow ends: the mark is
    wrong, by so much; and so is the beginning of a plan where strokes no longer begin."""
    composition = four_bar(plan)
    step, = (step for step in composition.plates.steps if step.name == letters)
    page = pages(composition)[0]
    spot = step.spot[0], page.height - step.spot[1]
    text = shift_mark(svg(page), spot, letters, (3.6, -4.8), with_letters)
    (path := tmp_path / "sheet.svg").write_text(text, encoding="utf-8")
    judged = read_back(composition, path)
    assert [(verdict.step, round(verdict.off, 1)) for verdict in judged.verdicts if verdict.state == WRONG] == [
        (step.index, 6.0)]


def test_letters_of_forces_name_no_points(tmp_path: Path) -> None:
    """On a lever where a force without power begins at a point: its letter is no mark of the step that has no dot."""
    scene = gp.scene({
        "points": {"P": [0, 0], "R": [0, 20]}, "links": {"1": "P", "frame": "R"},
        "slides": [{"link": "1", "along": "frame", "at": "P", "direction": [0, 2]}],
        "drive": [{"slide": ["1", "frame"], "speed": 7}],
        "forces": [{"on": "1", "at": "P", "value": value} for value in ([0, -1000], [250, 0])],
        "balance": {"on": "1", "at": "P", "direction": [0, 1]},
        "friction": [{"slide": ["1", "frame"], "coefficient": 0.2}]})
    assert own_score(scene, tmp_path) == 100


def test_where_all_is_zero_there_is_nothing_to_judge(tmp_path: Path) -> None:
    """A mechanism that stands still, of which nothing is asked but zeros: that is said, and no score is lost."""
    scene = gp.scene({"points": {"P": [9, 2], "R": [1, -10]}, "links": {"1": "P", "frame": "R"},
                      "slides": [{"link": "1", "along": "frame", "at": "P", "direction": [-4, 3]}],
                      "drive": [{"slide": ["1", "frame"], "speed": 0}], "find": {"velocity": "all"}})
    composition = compose(gp.construct(scene))
    (path := tmp_path / "sheet.svg").write_bytes(svg(pages(composition)[0]).encode())
    judged = read_back(composition, path)
    assert str(opinion(judged)) == "There is nothing to draw: all that is asked for is zero or given."
    assert score(judged).total is None


def test_a_stub_is_no_line_where_more_of_it_is_drawn(tmp_path: Path) -> None:
    """A line in two pieces is the longer one, though a stub begins at its mark: that hardly has a direction."""
    composition = four_bar("")
    (path := tmp_path / "sheet.svg").write_bytes(svg(pages(composition)[0]).encode())
    submission, drawing = submitted(composition, path), composition.plans.drawing
    line = next(step for step in drawing.drawn.steps if step.op.movement is Movement.PARALLEL and step.args[1])
    stroke = judge(drawing, composition, submission, Pencil()).verdicts[line.index].trace
    begin = complex(*composition.plates.steps[line.args[1]].spot)
    end = complex(*max(stroke.spots, key=lambda spot: abs(complex(*spot) - begin)))
    along = (end - begin) / abs(end - begin)
    stub, rest = (Trace(LINE, tuple((spot.real, spot.imag) for spot in spots))
                  for spots in ((begin, begin + along * (2.5 + 0.007j)), (begin + 15 * along, end)))
    traces = (*(trace for trace in submission.traces if trace != stroke), stub, rest)
    judged = judge(drawing, composition, replace(submission, traces=traces), Pencil())
    assert judged.verdicts[line.index].trace == rest
