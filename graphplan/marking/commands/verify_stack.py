"""Verify a stack of scans of a class: each sheet by the scene that the code in its corners names.

What is found goes into a folder: results.csv, results.html, results.json, and corrected/NAME.pdf for every student to
have back. Its folder `kept` has what was judged, so that running again judges only what is new.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from graphplan import __version__
from graphplan.app.choices import Messages
from graphplan.app.files import as_json, kind, write
from graphplan.errors import Refused, missing_package
from graphplan.marking.classroom import results as found_results
from graphplan.marking.classroom.class_files import REGISTER_FILE, ClassRegister, TaskSheet, is_class, load_register
from graphplan.marking.classroom.class_variants import draft_scene
from graphplan.marking.classroom.grading import FAULT_KEY, FILES_KEY, Data, Keeper, file_digest, key, run_jobs
from graphplan.marking.classroom.results import (
    MarkedDrawing,
    SheetResult,
    StackResults,
    Unread,
    csv_text,
    file_names,
    require_openpyxl,
    workbook,
)
from graphplan.marking.classroom.stack import (
    BLANK,
    PageSight,
    PlacedPage,
    SeenPage,
    StackPage,
    TeacherWord,
    assignments,
    keep_words,
    kept_words,
    look_at_page,
    pages,
    place_pages,
    replace_failed,
    teacher_words,
    words_in_file,
)
from graphplan.marking.desk import Desk
from graphplan.marking.judge.score import Weights, parse_weights
from graphplan.mechanism.scene import load as load_scene
from graphplan.methods.executors import cores
from graphplan.phrases import join, said
from graphplan.sheet.plates.display import Sheet
from graphplan.words.tongue import Tongue, tongue

HANDED_IN_KEY = "handed in"  # what is kept under it: what the class has handed in last
GRADE_ENDINGS = ".csv", ".xlsx"
# Options, as they are kept.
SHEET_OPTIONS = {"method": str, "plan": str, "inertia": str, "rounds": int, "paper": str, "language": str}


def run(options: argparse.Namespace) -> int:
    """Judge a stack; return 2 if no sheet could be judged."""
    stack = Path(options.drawing)
    if not find_spec("cv2"):
        raise missing_package(f"{stack}", "OpenCV", "scan")
    if stack.is_dir() and is_class(stack):
        raise Refused(f"{stack}", f"this folder has a {REGISTER_FILE}, and no scans",
                      "the file or the folder of the scans")
    classroom = stack_desk(options)
    return conclude(classroom, classroom.results(*pages(stack)))


def stack_desk(options: argparse.Namespace) -> StackDesk:
    """Desk for the submissions of a class."""
    folder = Path(options.scene)
    into = Path(options.output or folder / "results")
    if options.review:
        kind(options.review, (".html",), "page", "--review")
    if options.report and kind(options.report, GRADE_ENDINGS, "grade book", "--report") == ".xlsx":
        require_openpyxl(options.report)
    return StackDesk(folder, load_register(folder), into, parse_weights(options.weights), options)


def conclude(classroom: StackDesk, results: StackResults) -> int:
    """Write the results of a class and report them; return 2 if no sheet could be judged."""
    classroom.write(results)
    classroom.keeper.put(HANDED_IN_KEY, {"path": os.path.abspath(classroom.options.drawing)})
    write(as_json(results.data) if classroom.options.json else
          "".join(f"{classroom.say(line)}\n" for line in results.findings()))
    return 0 if results.with_status(found_results.JUDGED) else 2


def last_handed_in(options: argparse.Namespace) -> str:
    """What a class has handed in last, which is looked at again with the teacher's words on it."""
    into = Path(options.output or Path(options.scene) / "results")
    stack = Keeper(into / "kept").get(HANDED_IN_KEY)
    if not stack:
        raise Refused("DRAWING", "nothing of this class was judged before",
                      "verify FOLDER STACK, with a stack of scans or a table")
    return str(stack["path"])


@dataclass(frozen=True)
class HandedOut:
    """A task that was handed out: whose it is, where its corrections are written, how it is weighed and drawn, and what
    the teacher says of it."""

    sheet: TaskSheet
    scene: Path
    corrected: Path
    weights: Weights
    keys: Mapping[str, Any]  # of [sheet]
    word: TeacherWord

    @property
    def desk(self) -> Desk:
        """Desk for the sheet, with the task that was printed for its student."""
        scene, sheet = load_scene(str(self.scene)), self.sheet
        named = replace(scene.sheet, student=sheet.student, group=sheet.group, variant=str(sheet.variant))
        return Desk(draft_scene(self.keys, replace(scene, sheet=named)), self.weights, self.keys)


@dataclass(frozen=True)
class Job:
    """A sheet to be judged: its page, whether that is mirrored, pages that are joined to it, and its task."""

    page: StackPage
    mirrored: bool
    further: tuple[StackPage, ...]
    task: HandedOut


@dataclass(frozen=True)
class StackDesk:
    """Desk for the stacks of a class."""

    folder: Path
    register: ClassRegister
    into: Path
    weights: Weights
    options: argparse.Namespace

    @property
    def keeper(self) -> Keeper:
        return Keeper(self.into / "kept")

    @cached_property
    def words(self) -> dict[str, TeacherWord]:
        """The teacher's words by student, or by variant for a sheet without one."""
        owners = {sheet.owner: sheet.owner for sheet in self.register.sheets}
        words = kept_words(self.keeper)
        if self.options.words:
            words = words_in_file(self.options.words, owners, words)
        return teacher_words(self.options.score or (), self.options.note or (), owners, words)

    @cached_property
    def say(self) -> Tongue:
        """The tongue of the sheets."""
        named = self.register.options.get("language")
        return tongue(named or load_scene(str(self.folder / self.register.sheets[0].scene)).sheet.language)

    def results(self, stack: Sequence[StackPage], unread: Sequence[Unread]) -> StackResults:
        """Results of a stack."""
        word = assignments(self.options.assign or (), stack, self.register)
        if stack:
            make_folder(self.keeper.folder)
            keep_words(self.words, self.keeper)
        seen_pages, broken = self._look_at_pages(stack)
        whose = place_pages(seen_pages, self.register, word)
        judged = self._judge_pages(whose)
        whose = list(replace_failed(whose, {page for page, data in judged.items() if FAULT_KEY in data}))
        sheets = [*self._sheets(whose, judged), *broken]
        blank = sum(placed_page.fate == BLANK for placed_page in whose)
        return StackResults(self.register.title, self.say.code, tuple(sheets), blank, tuple(unread))

    # ---- page by page ----------------------------------------------------------------------------------------------

    def _look_at_pages(self, stack: Sequence[StackPage]) -> tuple[list[SeenPage], list[SheetResult]]:
        """Views of all pages, and the pages that cannot be opened."""
        files = {path: file_digest(path) for path in dict.fromkeys(page.path for page in stack)}
        keys = {page: key("sight", __version__, files[page.path], page.number) for page in stack}
        jobs = {name: page for page, name in reversed(keys.items())}
        outcomes = self.do_jobs(look_at_page, jobs, "pages", lambda page: page.name)
        seen_pages, broken = [], []
        for page, name in keys.items():
            if FAULT_KEY in outcomes[name]:
                broken.append(SheetResult(found_results.FAILED, page.name, look=(outcomes[name][FAULT_KEY],)))
            else:
                seen_pages.append(SeenPage(page, PageSight(**outcomes[name])))
        return seen_pages, broken

    def _judge_pages(self, whose: Sequence[PlacedPage]) -> dict[str, Data]:
        """Results of every sheet, by the name of its page; equal pictures are judged once."""
        jobs, keys = dict[str, Job](), dict[str, str]()
        for placed_page in whose:
            if placed_page.fate in (found_results.JUDGED, found_results.AGAIN):
                further = [joined_page for joined_page in whose if joined_page.fate == found_results.JOINED
                           and joined_page.whose == placed_page.whose]
                name, job = self._job(placed_page, further if placed_page.fate == found_results.JUDGED else [])
                keys[placed_page.seen_page.page.name] = name
                jobs.setdefault(name, job)
        outcomes = self.do_jobs(judge_scan, jobs, "sheets", lambda job: job.page.name)
        return {page: outcomes[name] for page, name in keys.items()}

    def _job(self, one: PlacedPage, further: Sequence[PlacedPage]) -> tuple[str, Job]:
        """The job of a sheet, by a digest of all that it hangs on."""
        assert one.sheet is not None
        digests = [placed_page.seen_page.sight.digest for placed_page in (one, *further)]
        made_from, task = self.task(one.sheet, digests, one.mirrored)
        return made_from, Job(one.seen_page.page, one.mirrored,
                              tuple(joined_page.seen_page.page for joined_page in further), task)

    def task(self, sheet: TaskSheet, *handed_in: object) -> tuple[str, HandedOut]:
        """A task with what was handed in for it, by a digest of all that its verdict hangs on."""
        scene, keys = self.folder / sheet.scene, self.sheet_keys()
        word = self.words.get(sheet.owner, TeacherWord())
        made_from = key("judged sheet", __version__, *handed_in, sheet, file_digest(scene),
                        sorted(self.register.options.items()), self.options.pencil, self.weights, word)
        return made_from, HandedOut(sheet, scene, self.keeper.folder / f"{made_from}.pdf", self.weights, keys, word)

    def sheet_keys(self) -> dict[str, Any]:
        """The keys of [sheet] by which the sheets of the class were drawn, and the pencil of this run."""
        if conflicting := [name for name in (*SHEET_OPTIONS, "at") if getattr(self.options, name, None)]:
            raise Refused(f"--{conflicting[0]}", f"the sheets of this class were drawn as its {REGISTER_FILE} says",
                          "leave it out")
        kept = {name: kind(value) for name, kind in SHEET_OPTIONS.items()
                if (value := self.register.options.get(name))}
        return kept | {"pencil": self.options.pencil}

    def do_jobs(self, work: Callable[[Any], Data], jobs: Mapping[str, Any], what: str, named: Callable[[Any], str]
              ) -> dict[str, Data]:
        """Results of all jobs, reported as they are done."""
        messages, outcomes = Messages(self.options.quiet), dict[str, Data]()
        try:
            for name, outcome in run_jobs(work, jobs, self.keeper, self.options.jobs or cores()):
                outcomes[name] = outcome
                if FAULT_KEY in outcome:
                    prefix = f"{getattr(jobs[name], 'path', named(jobs[name]))}: "
                    outcome[FAULT_KEY] = outcome[FAULT_KEY].removeprefix(prefix)
                messages.progress(f"{what}: {len(outcomes)}/{len(jobs)} {named(jobs[name])}")
        except KeyboardInterrupt:
            messages.remark(
                f"interrupted: {len(outcomes)} of {len(jobs)} {what} are done and kept; run it again to go on")
            raise
        messages.progress("")
        return outcomes

    # ---- put together ----------------------------------------------------------------------------------------------

    def _sheets(self, whose: Sequence[PlacedPage], judged: Mapping[str, Data]) -> Iterator[SheetResult]:
        """Yield the sheets by variant, students without one, then unassigned pages."""
        named = [placed_page for placed_page in whose if placed_page.sheet is not None]
        for sheet in self.register.sheets:
            sheet_pages = [placed_page for placed_page in named if placed_page.sheet == sheet]
            yield from (self._result(placed_page, judged.get(placed_page.seen_page.page.name))
                        for placed_page in sheet_pages)
            if sheet.student and not any(placed_page.owner == sheet.student for placed_page in named):
                yield SheetResult(found_results.ABSENT, variant=sheet.variant, student=sheet.student, group=sheet.group)
        for placed_page in whose:
            if placed_page.sheet is None and placed_page.fate != BLANK:
                yield self._result(placed_page, None)

    def _result(self, one: PlacedPage, data: Data | None) -> SheetResult:
        """One page as a line of the results."""
        notes = tuple(self.say(note) for note in one.notes)
        about = SheetResult(one.fate, one.seen_page.page.name, one.sheet.variant if one.sheet else None, one.owner,
                            group=one.sheet.group if one.sheet else "", look=notes,
                            thumbnail=one.seen_page.sight.thumbnail)
        return about if data is None else with_outcome(about, data)

    def write(self, found: StackResults) -> None:
        """Write all that is found into the folder, and remove what an earlier run had to hand back."""
        from graphplan.marking.report_page import results_page
        from graphplan.marking.review_page import review_page

        earlier = self.keeper.get("corrected") or {}
        to_hand_back = [sheet for sheet in found.sheets if sheet.corrected and sheet.status == found_results.JUDGED]
        names = file_names([sheet.student or self.say(said("variant {0}", sheet.variant)) for sheet in to_hand_back])
        files = {sheet.page: f"corrected/{name}.pdf" for sheet, name in zip(to_hand_back, names, strict=True)}
        make_folder(self.into / "corrected")
        for sheet in to_hand_back:
            write((self.keeper.folder / sheet.corrected).read_bytes(), str(self.into / files[sheet.page]))
        for file in set(earlier.get("written", ())) - set(files.values()):
            (self.into / "corrected" / Path(file).name).unlink(missing_ok=True)
        self.keeper.put("corrected", {"written": sorted(files.values())})
        found = replace(found,
                        sheets=tuple(replace(sheet, corrected=files.get(sheet.page, "")) for sheet in found.sheets))
        for name, content in (("results.csv", csv_text(found.table)), ("results.json", as_json(found.data)),
                              ("results.html", results_page(found, self.say))):
            write(content, str(self.into / name))
        if page := self.options.review:
            write(review_page(found, self.words, self.keeper.folder, self.say), page)
        if book := self.options.report:
            write((csv_text if kind(book, GRADE_ENDINGS, "grade book") == ".csv" else workbook)(found.table), book)


def with_outcome(about: SheetResult, data: Data) -> SheetResult:
    """A line of the results with what is found of its sheet."""
    if FAULT_KEY in data:
        return replace(about, status=found_results.FAILED, look=(*about.look, data[FAULT_KEY]))
    judged_fields = {name: value for name, value in data.items() if name != FILES_KEY}
    return replace(about, **{**judged_fields, "look": (*about.look, *data["look"])}, corrected=data[FILES_KEY][0],
                   overlaid=data[FILES_KEY][1])


def make_folder(folder: Path) -> None:
    """Make a folder, unless it is there."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError) as fault:
        raise Refused(f"{folder}", f"it cannot be made ({getattr(fault, 'strerror', None) or fault})",
                      "-o FOLDER, where it can be") from None


# ---- in a process of its own ----------------------------------------------------------------------------------------


def judge_scan(job: Job) -> Data:
    """Judge a sheet; its corrections are written."""
    from graphplan.marking.classroom.corrections import Corrections
    from graphplan.marking.report_page import picture as embedded
    from graphplan.marking.scans.image import page_picture
    from graphplan.marking.scans.scan import PencilPage, read_picture
    from graphplan.marking.scans.straighten import cut_out, sheet_photograph, straight_picture, whole_photograph
    from graphplan.output.pdf import pdf
    from graphplan.sheet.handout import code, task

    image = page_picture(job.page.path, job.page.number)
    image = image[:, ::-1] if job.mirrored else image
    desk, task_code = job.task.desk, job.task.sheet.code
    composition = desk.on_sheet.composition
    if code(composition) != task_code:
        raise Refused(f"{job.task.scene}", "its sheet is no longer the one that was printed",
                      "the scenes as they were made")
    submission = read_picture(image, job.page.name, task(composition)[0], desk.frames, task_code)
    marked = desk.judge_submission(submission, job.task.word)
    if isinstance(submission.page, PencilPage):
        sheet = straight_picture(image, submission.page.warp)
        photograph = sheet_photograph(sheet)
    else:  # there is nothing on it
        photograph = whole_photograph(image, max(composition.arrangement.width, composition.arrangement.height))
    corrections = Corrections(marked.judgement, marked.score, composition, photograph)
    further = [whole_photograph(page_picture(page.path, page.number)) for page in job.further]
    sheets = corrections.pages(further)
    write(pdf(sheets), str(job.task.corrected))
    detail = corrections.detail(lambda rect: cut_out(sheet, rect))
    return outcome(marked, job.task.corrected, sheets[0], embedded(detail) if detail else "")


def outcome(marked: MarkedDrawing, corrected: Path, overlaid: Sheet, detail: str = "") -> Data:
    """What is kept of a judged drawing: its verdict, its score, the file to hand back, the sheet with what was read
    laid over it, a picture of the place."""
    from graphplan.marking.judge.findings import judgement_record, opinion, review_rows
    from graphplan.marking.report_page import picture as embedded

    first, say = marked.judgement.first_wrong, marked.judgement.composition.plans.tongue
    (laid_over := corrected.with_suffix(".svg")).write_text(embedded(overlaid), "utf-8")
    return {
        "score": marked.score.total, "groups": marked.score.groups, "note": marked.score.note,
        "by_teacher": marked.by_teacher,
        "first": marked.guilty.short if marked.guilty else "",
        "words": say(join((*marked.score.teacher_lines, opinion(marked.judgement)), " ")),
        "faultless": marked.faultless, "kind": first.kind if first else "",
        "confidence": round(marked.confidence, 3),
        "look": [say(line) for line in marked.look], "detail": detail,
        "judgement": judgement_record(marked.judgement, marked.score), "review": review_rows(marked.judgement),
        FILES_KEY: [corrected.name, laid_over.name],
    }  # fmt: skip
