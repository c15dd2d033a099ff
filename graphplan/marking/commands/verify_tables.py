"""Verify the tables of a class: each student's results or measured points by his own variant, from one table with a
column student or variant, or from a folder of tables that are called after students or variants.

What is found goes into the folder where the results of scans go, and looks the same.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from graphplan.app.files import write
from graphplan.errors import GraphplanError
from graphplan.marking.classroom import results as found_results
from graphplan.marking.classroom.class_files import ClassRegister, TaskSheet
from graphplan.marking.classroom.grading import Data, file_digest
from graphplan.marking.classroom.results import SheetResult, StackResults, Unread
from graphplan.marking.classroom.stack import keep_words
from graphplan.marking.commands.verify_stack import (
    HandedOut,
    StackDesk,
    conclude,
    make_folder,
    outcome,
    stack_desk,
    with_outcome,
)
from graphplan.marking.files.tables import TableReading, read_class_csv
from graphplan.marking.submission import IMAGE_SUFFIXES

NOBODY = "there is no such student or variant in this class"


@dataclass(frozen=True)
class TableJob:
    """Submission of one student: its name, its reader, and the task."""

    name: str
    reading: TableReading
    task: HandedOut


def find_tables(handed_in: Path) -> list[Path]:
    """The tables of a class: a file of them, or all in a folder without pictures; empty if scans are meant."""
    paths = sorted(handed_in.glob("*.csv")) if handed_in.is_dir() else [handed_in]
    pictures = handed_in.is_dir() and any(path.suffix.casefold() in IMAGE_SUFFIXES for path in handed_in.glob("*"))
    return [] if pictures or any(path.suffix.casefold() != ".csv" for path in paths) else paths


def run(options: argparse.Namespace, tables: Sequence[Path]) -> int:
    """Judge the tables of a class; return 2 if no table could be judged."""
    classroom = stack_desk(options)
    return conclude(classroom, results_of_tables(classroom, tables))


def results_of_tables(classroom: StackDesk, tables: Sequence[Path]) -> StackResults:
    """Results of a class's tables; of a student who is in several the first counts."""
    make_folder(classroom.keeper.folder)
    keep_words(classroom.words, classroom.keeper)
    register, jobs, others, unread = classroom.register, dict[str, TableJob](), list[SheetResult](), list[Unread]()
    sheets_judged = dict[int, str]()
    for path in tables:
        try:
            readings = read_class_csv(path)
        except GraphplanError as fault:
            unread.append(Unread(path.name, fault.lines[0].removeprefix(f"{path}: ")))
            continue
        for owner, reading in readings.items():
            sheet, name = sheet_of(register, owner), f"{path.name}: {owner}"
            if sheet is None:
                others.append(SheetResult(found_results.FAILED, name, look=(NOBODY,)))
            elif sheet.variant in sheets_judged:
                others.append(SheetResult(found_results.AGAIN, name, sheet.variant, sheet.student))
            else:
                made_from, task = classroom.task(sheet, file_digest(path), name)
                jobs[made_from], sheets_judged[sheet.variant] = TableJob(name, reading, task), made_from
    outcomes = classroom.do_jobs(judge_table, jobs, "tables", lambda job: job.name)
    lines = [_line(sheet, jobs, outcomes, sheets_judged.get(sheet.variant)) for sheet in register.sheets
             if sheet.student or sheet.variant in sheets_judged]
    return StackResults(register.title, classroom.say.code, (*lines, *others), unread=tuple(unread))


def sheet_of(register: ClassRegister, owner: str) -> TaskSheet | None:
    """The sheet of a student by name, or of a variant by number, `7` or `variant-07`."""
    number = owner.casefold().removeprefix("variant").strip(" -_")
    return register.sheet_of(owner) or next(
        (sheet for sheet in register.sheets if number.isdecimal() and sheet.variant == int(number)), None)


def _line(sheet: TaskSheet, jobs: dict[str, TableJob], outcomes: dict[str, Data], name: str | None) -> SheetResult:
    """A student's line of the results."""
    about = SheetResult(found_results.ABSENT, "", sheet.variant, sheet.student, group=sheet.group)
    return with_outcome(replace(about, status=found_results.JUDGED, page=jobs[name].name),
                        outcomes[name]) if name else about


def judge_table(job: TableJob) -> Data:
    """Judge a student's table; the corrections are written."""
    from graphplan.marking.judge.overlay import overlay
    from graphplan.output.pdf import pdf

    desk = job.task.desk
    marked = desk.judge_submission(replace(job.reading(desk.plans), name=job.name), job.task.word)
    sheets = overlay(marked.judgement, marked.score)
    write(pdf(sheets), str(job.task.corrected))
    return outcome(marked, job.task.corrected, sheets[0])
