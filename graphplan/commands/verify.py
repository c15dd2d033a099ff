"""Verify a drawing made by hand: the first wrong step, by how much it is off, and what a pencil allows.

DRAWING is a file of measured points or results (.csv, .toml), of a CAD or geometry program (.svg, .dxf, .ggb), a scan
or a photo (.png, .jpg, .pdf), or a folder of them, of a whole class. Say --plan, --method and --paper as for the
handout that was drawn on.

verify FOLDER STACK judges a stack of scans, a PDF or a folder of them, each sheet by the scene that the code in its
corners names, and writes results.csv, .html and .json and each student's corrected sheet; FOLDER is what graphplan
variants wrote. What was judged is kept, so that running again judges only what is new.

Measured points are a table with a line for each mark, in mm on the student's sheet; panel, x2 and y2 of a line, r of a
circle and precision may be left out:
  mark,x,y,panel
  A,32.1,46.0,mechanism
Results are a table with x and y, or value:
  quantity,of,x,y,value,unit
  velocity,A,-1100,200,,mm/s
  omega,2,,,-5.2,rad/s
Of a task with [rotor] they are the numbers that balance it: correction and angle of I and II, static unbalance, moment:
  quantity,of,value,unit
  correction,I,58,kg·mm
  angle,I,276.5,°

examples:
  graphplan verify four-bar points.csv
  graphplan verify scene.toml scan.png --report report.html
  graphplan verify four-bar points.csv --pencil point=0.2 --weights "follows=0.5,numbers=3,reversed=30"
  graphplan verify four-bar drawings/ --report class.html
  graphplan verify class/ scans.pdf --assign "scans.pdf#7=Student 3"
  graphplan verify class/ scans.pdf --score "Student 3=85" --note "A method of your own, and right."
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from graphplan.commands.choices import add_choices, add_pencil, add_sheet, count, on_paper, pencil
from graphplan.commands.output import STANDARD, Messages, as_json, error, kind, page_names, write, write_all
from graphplan.commands.verify_desk import Desk, printable
from graphplan.errors import GraphplanError, Refused
from graphplan.output import back_end

if TYPE_CHECKING:
    from graphplan.machine.rotors.rotor_balance import Answer
    from graphplan.marking.answers import AnswerVerdict, TrueNumber
    from graphplan.marking.classroom.results import MarkedDrawing
    from graphplan.output.subjects.rotor_sheet import RotorSheet
    from graphplan.phrases import Said

MAX_JOBS = 256
ENDINGS, CLASS_ENDINGS = (".html", ".svg", ".pdf", ".json"), (".html", ".json")


def options(command: argparse.ArgumentParser) -> None:
    add = command.add_argument
    add("drawing", metavar="DRAWING", help="the file that was handed in, or a folder of them")
    add("--report", metavar="FILE",
        help="the report to write: .html, .json, and of one drawing .svg or .pdf, the drawing over the true one")
    add("--weights", default="", metavar="WEIGHTS", help="what a step earns by its verdict, and how many steps a "
        "result that is asked for counts: such as right=1,follows=1,missing=0,wrong=0,numbers=2 (the defaults); "
        "follows is right after an earlier mistake; and by its kind what the first such mistake costs at least, of "
        "100: such as \"reversed=30,wrong scale=5\" (by default 20, or 12 of mere slips); an unknown name lists all")
    add("--json", action="store_true", help="as data")
    add("-o", "--output", metavar="FOLDER", help="where the results of a stack are written; without it FOLDER/results")
    add("--assign", action="append", metavar="PAGE=STUDENT", help="whose a page of a stack is that bears no code; - "
        "sets it aside; or a table with the columns page and student, or page and variant")
    add("--score", action="append", metavar="STUDENT=SCORE", help="the teacher's own score of a student's sheet in a "
        "stack, of 100, in the place of the judged one; kept with the results, and printed on the sheet; - takes it "
        "back")
    add("--note", action="append", metavar="STUDENT=TEXT", help="the same with a note; beside a single --score the "
        "text is enough")
    add("--jobs", type=count("--jobs", 1, MAX_JOBS), metavar="N", help="so many sheets of a stack at once; without it "
        "one for each core")
    add_sheet(command)
    add_choices(command)
    add_pencil(command)


def run(options: argparse.Namespace) -> int:
    from graphplan.marking.classroom.register import is_class
    from graphplan.marking.judge.score import parse_weights

    if is_class(Path(options.scene)):
        from graphplan.commands import verify_stack

        return verify_stack.run(options)
    _refuse_stack_options(options)
    if (status := _of_answers(options)) is not None:
        return status
    path, weighed = Path(options.drawing), parse_weights(options.weights)
    ending = _report_kind(options.report, path, options.scene)
    desk = Desk(on_paper(options), weighed, options)
    findings = (_judge_folder if os.path.isdir(path) else _judge_file)(desk, path)
    if options.report:
        pages = [as_json(findings.data)] if ending == ".json" else findings.pages(ending)
        write_all(list(zip(page_names(options.report, len(pages)), pages, strict=False)))
    say = desk.on_sheet.composition.plans.tongue
    write(as_json(findings.data) if options.json else "".join(f"{say(line)}\n" for line in findings.lines))
    return 0 if findings.judged else 2


def _of_answers(options: argparse.Namespace) -> int | None:
    """The verdict on single numbers, where the scene is the task of a rotor."""
    if options.scene == STANDARD:
        return None
    from graphplan.mechanism.scene import source_text, tables_of

    text = source_text(options.scene, options.scene)
    if "rotor" not in tables_of(text, options.scene):
        return None
    return of_rotor(options, text)


def _refuse_stack_options(options: argparse.Namespace) -> None:
    """Refuse options that only a stack of a class has."""
    for name, value in (("--assign", options.assign), ("--score", options.score), ("--note", options.note),
                        ("--jobs", options.jobs), ("--output", options.output)):
        if value:
            raise Refused(name, "it applies only to a class's stack of scans",
                          "verify FOLDER STACK, with the folder that graphplan variants wrote")


class Findings(NamedTuple):
    """What is found of a drawing or of a class: as data, in words, as the pages of a report of some ending; whether any
    was judged.
    """

    data: dict[str, Any]
    lines: Iterable[Said]
    pages: Callable[[str], Sequence[str | bytes]]
    judged: bool = True


def _report_kind(output: str | None, path: Path, scene: str) -> str:
    """What kind of report is asked for; one that would be written over what it is of is refused before it is judged."""
    if output == STANDARD:
        raise Refused("--report -", "standard output has the verdict", "name a file, or --json alone")
    for source, source_name in ((path, "drawing"), (scene, "scene")):
        if output and _is_same_file(output, source):
            raise Refused(f"--report {output}", f"the {source_name} itself would be overwritten", "another name")
    folder = os.path.isdir(path)
    return kind(output, CLASS_ENDINGS if folder else ENDINGS, f"report{' of a folder' * folder}", "--report")


def _is_same_file(one: str, other: str | Path) -> bool:
    """Whether two names are those of one file that is there."""
    try:
        return os.path.samefile(one, other)
    except (OSError, ValueError):  # one of them is not there, or no file system has it
        return False


# ---- one drawing ---------------------------------------------------------------------------------------------------


def _judge_file(desk: Desk, path: Path) -> Findings:
    """One drawing, judged."""
    from graphplan.marking.judge.findings import judgement_record
    from graphplan.marking.judge.overlay import overlay

    messages = Messages(desk.options.quiet)
    messages.progress(printable(path.name))
    drawing = desk.judge_file(path)
    messages.progress("")

    def pages(ending: str) -> Sequence[str | bytes]:
        sheets = overlay(drawing.judgement, drawing.score)
        if ending != ".html":
            write_out = back_end(ending[1:])
            return [write_out(sheets)] if ending == ".pdf" else list(map(write_out, sheets))
        from graphplan.output.report_page import report_page

        return [report_page(drawing.judgement, drawing.score, sheets)]

    return Findings(judgement_record(drawing.judgement, drawing.score), _lines(drawing), pages)


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


# ---- a class -------------------------------------------------------------------------------------------------------


def _judge_folder(desk: Desk, folder: Path) -> Findings:
    """Every file of a folder, judged; one that cannot be judged is an error line, and the others go on."""
    from graphplan.marking.classroom.results import Classroom, Unread, class_lines

    messages, paths = Messages(desk.options.quiet), _files(folder, desk.options.report)
    marked, unread = [], []
    for number, path in enumerate(paths):
        messages.progress(f"{number}/{len(paths)} {printable(path.name)}")
        try:
            _require_drawing(path)
            marked.append(desk.judge_file(path))
        except GraphplanError as fault:
            error(printable(fault.lines[0]))
            unread.append(Unread(printable(path.name), printable(fault.lines[0].removeprefix(f"{path}: "))))
    messages.progress("")
    classroom = Classroom(desk.on_sheet.drawing.scene.title, tuple(marked), tuple(unread))

    def pages(ending: str) -> Sequence[str]:
        from graphplan.output.report_page import class_list

        return [class_list(classroom, desk.on_sheet.composition.plans.tongue)]

    return Findings(classroom.data, class_lines(classroom), pages, bool(marked))


def _files(folder: Path, report: str | None) -> list[Path]:
    """All in a folder that was handed in, by name: what is hidden was not, nor was an earlier report."""
    try:
        files = sorted(folder.iterdir())
    except OSError as fault:
        raise Refused(f"{folder}", f"it cannot be read ({fault.strerror})", "a readable folder") from None
    drawings = [path
                for path in files if not path.name.startswith(".") and not (report and _is_same_file(report, path))]
    if not drawings:
        raise Refused(f"{folder}", "it contains no drawing", "a folder of drawings, each a file of its own")
    return drawings


def _require_drawing(path: Path) -> None:
    """Refuse what is in a folder and no drawing, whatever it is called."""
    if os.path.isdir(path):
        raise Refused(f"{path}", "this is a folder within the folder", "move its drawings out of it")
    if not os.path.exists(path):
        raise Refused(f"{path}", "the target of this link does not exist", "the drawing itself")


# ---- answers to a rotor's task ---------------------------------------------------------------------------------------


def of_rotor(options: argparse.Namespace, text: str) -> int:
    """Judge the answers to the task of a rotor."""
    from graphplan.check.rotors import check_rotor
    from graphplan.machine.rotors.rotor import parse
    from graphplan.machine.rotors.rotor_balance import balance_rotor
    from graphplan.output.subjects.rotor_sheet import rotor_sheet

    balance = balance_rotor(parse(text, options.scene))
    sheet = rotor_sheet(balance, check_rotor(balance), pencil(options))
    return _judge_tables(options, [_true_numbers(sheet, answer) for answer in balance.answers],
                         balance.task.sheet.language)


def _judge_tables(options: argparse.Namespace, choices: Sequence[Sequence[TrueNumber]], language: str) -> int:
    """Judge a table of answers, or each in a folder, by the nearest of the choices, and print the verdicts."""
    from graphplan.words.tongue import tongue

    if options.report:
        raise Refused(f"--report {options.report}", "there is no report of answers", "--json")
    path = Path(options.drawing)
    files = sorted(path.glob("*.csv")) if path.is_dir() else [path]
    if not files:
        raise Refused(f"{path}", "it contains no table of answers", "files that end in .csv")
    verdicts = {file.name: _judge_table(choices, file) for file in files}
    if options.json:
        write(as_json([_table_record(name, each) for name, each in verdicts.items()] if path.is_dir() else
                      _table_record(path.name, verdicts[path.name]), rows=True))
        return 0
    say, lines = tongue(options.language or language), []
    for name, each in verdicts.items():
        lines += [name] if path.is_dir() else []
        lines += [str(say(verdict.text)) for verdict in each]
    write("".join(f"{line}\n" for line in lines))
    return 0


def _judge_table(choices: Sequence[Sequence[TrueNumber]], path: Path) -> list[AnswerVerdict]:
    """The verdicts on one table, by the choice that it is nearest to."""
    from graphplan.marking.answers import count_right, judge_answers
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


def _true_numbers(sheet: RotorSheet, answer: Answer) -> list[TrueNumber]:
    """The true numbers of a rotor: corrections plane by plane, the static unbalance and the moment about plane I."""
    from graphplan.marking.answers import TrueNumber
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
    from graphplan.marking.answers import count_right

    return {"name": name, "right": count_right(verdicts), "of": len(verdicts),
            "answers": [verdict.record for verdict in verdicts]}
