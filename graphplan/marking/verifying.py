"""Drawings and answers that students hand in, judged: the first wrong step, by how much, and what a pencil allows."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Unpack

from graphplan.app.drafting import Keywords, on_paper, pencil, with_sheet
from graphplan.app.files import STANDARD, as_json, kind, page_names, write_all
from graphplan.errors import GraphplanError, Refused
from graphplan.marking.classroom.class_files import Listener, ignore
from graphplan.marking.desk import Desk, printable
from graphplan.marking.files.quantities import unit_factor
from graphplan.marking.files.tables import TableAnswer
from graphplan.mechanism.units import Dimension, Units
from graphplan.output import back_end
from graphplan.phrases import Said, arrange, digits, said, unit

if TYPE_CHECKING:
    from graphplan.app.subjects import FoundMechanism
    from graphplan.machines.rotors.rotor import RotorTask
    from graphplan.machines.rotors.rotor_balance import Answer
    from graphplan.machines.rotors.sheet import RotorOnPaper
    from graphplan.marking.classroom.results import MarkedDrawing
    from graphplan.marking.classroom.stack import TeacherWord
    from graphplan.marking.judge.score import Weights
    from graphplan.mechanism.model import Scene

RIGHT, WRONG, MISSING = "right", "wrong", "missing"
TOLERANCE_FACTOR = 1.5  # times the two standard deviations by which a drawing may be off: three
SI_UNITS = Units("m", "N", "kg")
TURN_DEGREES = 360.0
UNIT_POWERS = tuple(10.0**power for power in (-6, -3, -2, -1, 1, 2, 3, 6))  # that a unit may be mistaken by


@dataclass(frozen=True)
class TrueNumber:
    """A true number: what it is, and of what; its value in SI or in degrees, where it has no dimension; two standard
    deviations of what is drawn; how its unit is written, and what one of that is in SI."""

    quantity: str
    of: str
    value: float
    off: float
    written: str
    unit_size: float = 1.0
    dimension: Dimension | None = None

    def matches(self, answer: TableAnswer) -> bool:
        """Whether an answer is to this."""
        return (answer.quantity, answer.of.casefold()) == (self.quantity, self.of.casefold())

    def read(self, answer: TableAnswer) -> float:
        """The number of an answer in SI or degrees; fails with `ValueError` where its unit is of something else."""
        if self.dimension is None:
            if answer.unit not in ("", "°", "deg"):
                raise ValueError(f"{answer.unit!r} is not a unit of angle")
            return answer.value
        return answer.value * (unit_factor(answer.unit, self.dimension, SI_UNITS) if answer.unit else self.unit_size)

    def gap(self, value: float) -> float:
        """Difference of a number from this."""
        if self.dimension is not None:
            return abs(value - self.value)
        return abs((value - self.value + TURN_DEGREES / 2) % TURN_DEGREES - TURN_DEGREES / 2)

    def number_text(self, value: float) -> Said:
        """A number in its unit."""
        pattern = "{0} {1}" if self.dimension else "{0}{1}"
        return arrange(pattern, digits(value / self.unit_size), unit(self.written))


@dataclass(frozen=True)
class AnswerVerdict:
    """A true number and what was answered, in SI or degrees, if anything was; whether that is right, and if it is not,
    what may have gone wrong."""

    expected: TrueNumber
    answered: float | None
    state: str
    hint: str = ""

    @property
    def text(self) -> Said:
        """The verdict in words."""
        name = " ".join(filter(None, (self.expected.quantity, self.expected.of)))
        if self.answered is None:
            return said("{0}: missing", name)
        answered = self.expected.number_text(self.answered)
        if self.state == RIGHT:
            return said("{0}: {1}, right", name, answered)
        true = self.expected.number_text(self.expected.value)
        if self.hint:
            return said("{0}: {1}, wrong, it is {2}: {3}", name, answered, true, self.hint)
        return said("{0}: {1}, wrong, it is {2}", name, answered, true)

    @property
    def record(self) -> dict[str, Any]:
        """The answer beside the true value, for JSON."""
        unit_size = self.expected.unit_size
        return {"quantity": self.expected.quantity, "of": self.expected.of, "unit": self.expected.written,
                "answered": None if self.answered is None else self.answered / unit_size,
                "true": self.expected.value / unit_size, "state": self.state, "hint": str(self.hint)}


def judge_answers(expected: Sequence[TrueNumber], answers: Sequence[TableAnswer]) -> list[AnswerVerdict]:
    """The verdict on each number that is expected; fails with `ValueError` where an answer has a wrong unit."""
    return [_judge_answer(number, expected, next((answer for answer in answers if number.matches(answer)), None))
            for number in expected]


def _judge_answer(one: TrueNumber, expected: Sequence[TrueNumber], answer: TableAnswer | None) -> AnswerVerdict:
    """The verdict on one number, as far as a pencil and rounding allow."""
    if answer is None:
        return AnswerVerdict(one, None, MISSING)
    value = one.read(answer)
    scale = abs(value / answer.value) if answer.value else one.unit_size
    if one.gap(value) <= TOLERANCE_FACTOR * one.off + 2 * answer.rounding * scale:
        return AnswerVerdict(one, value, RIGHT)
    return AnswerVerdict(one, value, WRONG, _hint(one, expected, value))


def _hint(one: TrueNumber, expected: Sequence[TrueNumber], value: float) -> str:
    """Possible cause of an error: a unit, a sense, or another's number."""
    def is_near(rival: TrueNumber, number: float) -> bool:
        least = 0.01 * abs(rival.value) if rival.dimension else 0.5
        return rival.gap(number) <= TOLERANCE_FACTOR * max(rival.off, least)

    alike = next((rival for rival in expected if rival is not one and rival.written == one.written
                  and is_near(rival, value)), None)
    if alike is not None:
        return said("this is that of {0}", " ".join(filter(None, (alike.quantity, alike.of))))
    if one.dimension is None:
        return said("it is opposite") if is_near(one, value + TURN_DEGREES / 2) else said(
            "counted clockwise") if is_near(one, -value) else ""
    power = next((power for power in UNIT_POWERS if is_near(one, value / power)), None)
    if power is not None:
        return said("{0} times as large: probably a wrong unit", digits(power))
    return said("negative") if is_near(one, -value) else ""


def count_right(verdicts: Sequence[AnswerVerdict]) -> int:
    """Number of right answers."""
    return sum(verdict.state == RIGHT for verdict in verdicts)


ENDINGS, CLASS_ENDINGS = (".html", ".svg", ".pdf", ".json"), (".html", ".json")


class Listeners(NamedTuple):
    """Listeners: to the progress, and in a folder to the files that cannot be judged; the earlier `report` among the
    files."""

    progress: Listener = ignore
    error: Listener = ignore
    report: str | None = None


@dataclass(frozen=True, repr=False)
class Findings:
    """Findings of a drawing or of a class: as `data`, in `lines` of words, as `pages` of a report of some ending;
    whether any was `judged`, and in which `endings` a report is written; data of tables in `rows`."""

    data: Any
    lines: Sequence[str]
    pages: Callable[[str], Sequence[str | bytes]]
    judged: bool = True
    endings: Sequence[str] = ENDINGS
    rows: bool = False

    @property
    def text(self) -> str:
        """The data as `verify --json` prints them."""
        return as_json(self.data, rows=self.rows)

    def json(self) -> Any:
        """The JSON of `graphplan verify --json`."""
        return json.loads(self.text)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a report by its ending, as `graphplan verify --report` does; fails with `Refused` where it cannot be.
        """
        name = os.fspath(path)
        ending = kind(name, self.endings, "report", "--report")
        pages = [self.text] if ending == ".json" else self.pages(ending)
        write_all(list(zip(page_names(name, len(pages)), pages, strict=False)))

    def __repr__(self) -> str:
        return f"<Findings: {self.lines[0] if self.lines else 'nothing'}>"

    def __str__(self) -> str:
        return "\n".join(self.lines)


def verify(scene: Scene | FoundMechanism | str | os.PathLike[str], drawing: str | os.PathLike[str], *,
           weights: str = "", score: Sequence[str] = (), note: Sequence[str] = (), **options: Unpack[Keywords]
           ) -> Findings:
    """A drawing made by hand, or a table of results, judged by the construction of a scene.

    Reads a scene, what `synthesize` finds, or a file of a scene or task, and what was handed in: measured points or
    results (.csv, .toml), a drawing (.svg, .dxf, .ggb), a scan or a photo (.png, .jpg, .pdf), or a folder of them.
    `weights` are what steps earn; `score` and `note` are the teacher's own, such as "85", or "FILE=85" of a folder;
    further keywords are those of the sheet that was drawn on (plan, method, paper).
    Fails with `Refused` where the drawing cannot be read.
    """
    from graphplan import leaves
    from graphplan.machines.rotors import rotor
    from graphplan.marking.judge.score import parse_weights
    from graphplan.mechanism.scene import source_text, tables_of
    from graphplan.mechanism.written_scene import load

    path = Path(drawing)
    source: Scene | FoundMechanism
    if isinstance(scene, str | os.PathLike):
        name = os.fspath(scene)
        text = source_text(name, name)
        tables = tables_of(text, name)
        if "rotor" in tables:
            return judge_rotor(with_sheet(rotor.parse(text, name), options), path)
        kind = leaves.kind_of_task(tables)
        source = leaves.module(kind.finder).find(text, name) if kind and kind.finder else load(name)
    else:
        source = scene
    desk = desk_for(with_sheet(source, options), parse_weights(weights), options, words_on_files(path, score, note))
    return (judge_folder if path.is_dir() else judge_file)(desk, path, Listeners())


def desk_for(source: Scene | FoundMechanism, weights: Weights, keys: Mapping[str, Any], words: Mapping[str, TeacherWord]
             ) -> Desk:
    """The desk on which drawings of a scene, or of a task of synthesis, are judged, with keys of [sheet] beside it."""
    from graphplan.mechanism.model import Scene

    if isinstance(source, Scene):
        return Desk(on_paper(source), weights, keys, words)
    desk: Desk = source.desk(weights, keys, words)
    return desk


def _in_tongue(desk: Desk, lines: Iterable[Said]) -> tuple[str, ...]:
    """Lines in the language of the sheet."""
    say = desk.on_sheet.composition.plans.tongue
    return tuple(str(say(line)) for line in lines)


def report_kind(output: str | None, path: Path, scene: str) -> str:
    """Kind of the report; a report over its own source is refused before the judging."""
    if output == STANDARD:
        raise Refused("--report -", "standard output has the verdict", "name a file, or --json alone")
    for source, source_name in ((path, "drawing"), (scene, "scene")):
        if output and is_same_file(output, source):
            raise Refused(f"--report {output}", f"the {source_name} itself would be overwritten", "another name")
    folder = os.path.isdir(path)
    return kind(output, CLASS_ENDINGS if folder else ENDINGS, f"report{' of a folder' * folder}", "--report")


def words_on_files(path: Path, scores: Sequence[str], notes: Sequence[str], report: str | None = None
                   ) -> dict[str, TeacherWord]:
    """The teacher's words on a drawing, or on those of a folder, by file: `scores` and `notes` by the names of files,
    whole or without their suffix, or without a name for a single one; an earlier `report` is left out."""
    from graphplan.marking.classroom.stack import teacher_words

    files = _files(path, report) if os.path.isdir(path) else [path]
    owners = {name: file.name for part in ("stem", "name") for file in files for name in [getattr(file, part)]}
    return teacher_words(scores, notes, owners, {})


def is_same_file(one: str, other: str | Path) -> bool:
    """Whether two names are those of one file that is there."""
    try:
        return os.path.samefile(one, other)
    except (OSError, ValueError):  # one of them is not there, or no file system has it
        return False


def judge_file(desk: Desk, path: Path, listen: Listeners) -> Findings:
    """Judge one drawing."""
    from graphplan.marking.judge.findings import judgement_record
    from graphplan.marking.judge.overlay import overlay

    listen.progress(printable(path.name))
    drawing = desk.judge_file(path)
    listen.progress("")

    def pages(ending: str) -> Sequence[str | bytes]:
        sheets = overlay(drawing.judgement, drawing.score)
        if ending != ".html":
            write_out = back_end(ending[1:])
            return [write_out(sheets)] if ending == ".pdf" else list(map(write_out, sheets))
        from graphplan.marking.report_page import report_page

        return [report_page(drawing.judgement, drawing.score, sheets)]

    return Findings(judgement_record(drawing.judgement, drawing.score), _in_tongue(desk, _lines(drawing)), pages)


def _lines(one: MarkedDrawing) -> Iterator[Said]:
    """The verdict in a few lines."""
    from graphplan.marking.judge.findings import (
        first_wrong_sentence,
        look_at_lines,
        opinion,
        reading_lines,
        summary_lines,
        wrong_number,
        wrong_numbers,
    )

    yield from reading_lines(one.judgement)
    yield opinion(one.judgement)
    yield from first_wrong_sentence(one.judgement)
    yield from summary_lines(one.judgement)
    yield from look_at_lines(one.judgement)
    wrong = wrong_numbers(one.judgement)  # the first is the opinion, if no step is wrong
    yield from (wrong_number(one.judgement, number) for number in (wrong if one.judgement.first_wrong else wrong[1:]))
    yield one.score.text


def judge_folder(desk: Desk, folder: Path, listen: Listeners) -> Findings:
    """Every file of a folder, judged; one that cannot be judged is an error line, and the others go on."""
    from graphplan.marking.classroom.results import Classroom, Unread, class_lines

    paths = _files(folder, listen.report)
    marked, unread = [], []
    for number, path in enumerate(paths):
        listen.progress(f"{number}/{len(paths)} {printable(path.name)}")
        try:
            _require_drawing(path)
            marked.append(desk.judge_file(path))
        except GraphplanError as fault:
            listen.error(printable(fault.lines[0]))
            unread.append(Unread(printable(path.name), printable(fault.lines[0].removeprefix(f"{path}: "))))
    listen.progress("")
    classroom = Classroom(desk.on_sheet.drawing.scene.title, tuple(marked), tuple(unread))

    def pages(ending: str) -> Sequence[str]:
        from graphplan.marking.report_page import class_list

        return [class_list(classroom, desk.on_sheet.composition.plans.tongue)]

    return Findings(classroom.data, _in_tongue(desk, class_lines(classroom)), pages, bool(marked), CLASS_ENDINGS)


def _files(folder: Path, report: str | None) -> list[Path]:
    """All in a folder that was handed in, by name: what is hidden was not, nor was an earlier report."""
    try:
        files = sorted(folder.iterdir())
    except OSError as fault:
        raise Refused(f"{folder}", f"it cannot be read ({fault.strerror})", "a readable folder") from None
    drawings = [path
                for path in files if not path.name.startswith(".") and not (report and is_same_file(report, path))]
    if not drawings:
        raise Refused(f"{folder}", "it contains no drawing", "a folder of drawings, each a file of its own")
    return drawings


def _require_drawing(path: Path) -> None:
    """Refuse what is in a folder and no drawing, whatever it is called."""
    if os.path.isdir(path):
        raise Refused(f"{path}", "this is a folder within the folder", "move its drawings out of it")
    if not os.path.exists(path):
        raise Refused(f"{path}", "the target of this link does not exist", "the drawing itself")


def judge_rotor(task: RotorTask, path: Path) -> Findings:
    """The answers to the task of a rotor in a table, or in each of a folder, judged."""
    from graphplan.machines.rotors.check import check_rotor
    from graphplan.machines.rotors.rotor_balance import balance_rotor
    from graphplan.machines.rotors.sheet import PAPERS, RotorOnPaper

    balance = balance_rotor(task)
    paper = task.sheet.paper or PAPERS[0]
    sheet = RotorOnPaper(paper, balance, check_rotor(balance), pencil(task))
    return _judge_tables(path, [_true_numbers(sheet, answer) for answer in balance.answers], task.sheet.language)


def _judge_tables(path: Path, choices: Sequence[Sequence[TrueNumber]], language: str) -> Findings:
    """A table of answers, or each in a folder, judged by the nearest of the choices."""
    from graphplan.words.tongue import tongue

    files = sorted(path.glob("*.csv")) if path.is_dir() else [path]
    if not files:
        raise Refused(f"{path}", "it contains no table of answers", "files that end in .csv")
    verdicts = {file.name: _judge_table(choices, file) for file in files}
    records = [_table_record(name, each) for name, each in verdicts.items()]
    say, lines = tongue(language), list[str]()
    for name, each in verdicts.items():
        lines += [name] if path.is_dir() else []
        lines += [str(say(verdict.text)) for verdict in each]
    return Findings(records if path.is_dir() else records[0], tuple(lines), lambda ending: (), endings=(".json",),
                    rows=True)


def _judge_table(choices: Sequence[Sequence[TrueNumber]], path: Path) -> list[AnswerVerdict]:
    """The verdicts on one table, by the choice that it is nearest to."""
    from graphplan.marking.files.tables import read_answers

    answers = read_answers(path)
    for answer in answers:
        if not any(number.matches(answer) for number in choices[0]):
            known_answers = ", ".join(f"{number.quantity},{number.of}" for number in choices[0])
            raise Refused(answer.where, f"{answer.quantity!r} of {answer.of!r} is not asked for",
                          f"one of {known_answers}")
    try:
        return max((judge_answers(choice, answers) for choice in choices), key=count_right)
    except ValueError as error:
        raise Refused(f"{path}", str(error), f"a unit such as {choices[0][0].written}") from None


def _true_numbers(sheet: RotorOnPaper, answer: Answer) -> list[TrueNumber]:
    """The true numbers of a rotor: corrections plane by plane, the static unbalance and the moment about plane I."""
    from graphplan.mechanism.units import Dimension

    task, sums, numbers = sheet.balanced.task, sheet.balanced.sums, list[TrueNumber]()
    mass, length, kg_m, metres = task.units.mass, task.units.length, float(task.kg_m), float(task.metres)
    unbalance, moment = Dimension(0, 2, 1, "U", "kg*m"), Dimension(1, 2, 1, "U", "kg*m^2")
    for correction, off_by in zip(answer, sheet.errors, strict=True):
        numbers.append(TrueNumber("correction", correction.letter, correction.mass_radius * kg_m,
                                  2 * off_by.mass_radius * kg_m,
                                  f"{mass}·{length}", kg_m, unbalance))
        if correction.mass_radius:
            numbers.append(TrueNumber("angle", correction.letter, correction.angle, 2 * off_by.angle, "°"))
    off = 2 * kg_m * sheet.errors[0].mass_radius  # the sum of m·r is drawn as well as what balances it
    numbers.append(TrueNumber("static unbalance", "", sums.static * kg_m, off, f"{mass}·{length}", kg_m, unbalance))
    if task.rotor.dynamic:
        off = 2 * kg_m * metres * sheet.errors[1].mass_radius * float(task.rotor.plane_distance)
        numbers.append(TrueNumber("moment", "", sums.dynamic * kg_m * metres, off, f"{mass}·{length}²", kg_m * metres,
                                  moment))
    return numbers


def _table_record(name: str, verdicts: Sequence[AnswerVerdict]) -> dict[str, Any]:
    """The verdicts on one table as data."""
    return {"name": name, "right": count_right(verdicts), "of": len(verdicts),
            "answers": [verdict.record for verdict in verdicts]}
