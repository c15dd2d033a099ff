"""A stack of scans: its pages, whose each is, and the teacher's own word on a drawing.

A page scanned twice is told, and its first scan counts. Pages without a code are left to the teacher, who names them
(after A. Bienvenüe's Auto Multiple Choice, whose association is by a code, by a list, or by hand).
"""

from __future__ import annotations

import csv
import json
from base64 import b64encode
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from hashlib import blake2b
from itertools import product
from pathlib import Path
from typing import Any

from graphplan.design.hand import decimal
from graphplan.errors import GraphplanError, Refused, by_name, printable
from graphplan.marking.classroom import measures
from graphplan.marking.classroom.class_files import ClassRegister, TaskSheet
from graphplan.marking.classroom.grading import Keeper
from graphplan.marking.classroom.results import AGAIN, ASIDE, JOINED, JUDGED, UNASSIGNED, Unread
from graphplan.marking.files.safe import MB, text
from graphplan.marking.judge.measures import FULL_SCORE
from graphplan.marking.judge.verdict import STATES
from graphplan.marking.submission import IMAGE_SUFFIXES, PICTURE_SUFFIXES
from graphplan.mechanism.fields import suggestion
from graphplan.phrases import Said, join, said
from graphplan.sheet.frames.frame import corner_numbers, page_code

KEPT_KEY = "teacher"
WORDS_KEY = "words"


@dataclass(frozen=True)
class TeacherWord:
    """What a teacher says of a drawing: the score, none where the judge's is left, a note, the verdicts on steps that
    are other than the judge's, by what the steps are called, and whether the sheet was looked at and is settled."""

    score: float | None = None
    note: str = ""
    verdicts: Mapping[str, str] = field(default_factory=dict)
    accepted: bool = False


def teacher_words(scores: Sequence[str], notes: Sequence[str], owners: Mapping[str, str],
                  kept: Mapping[str, TeacherWord]) -> dict[str, TeacherWord]:
    """The words by owner, who is a student, a variant or a file, by the names for each: those that are kept, and over
    them `NAME=SCORE` and `NAME=NOTE`; a score alone is on the only owner, a note alone on the only one who has a score.
    A `-` takes a word back.

    Fails with `Refused` where there is no such owner, or no such score.
    """
    words, everybody = dict(kept), set(owners.values())
    scored = dict[str, str]()
    for entry in scores:
        name, _, text = entry.rpartition("=")
        scored[_owner("--score", name.strip(), text, owners, everybody)] = text
    for owner, text in scored.items():
        words[owner] = replace(words.get(owner, TeacherWord()), score=_parse_score(owner, text))
    for entry in notes:
        name, _, text = entry.partition("=")
        name, text = (name.strip(), text) if name.strip() in owners else ("", entry)
        owner = _owner("--note", name, text, owners, set(scored) or everybody)
        note = "" if text.strip() == "-" else " ".join(printable(text).split())[:measures.MAX_NOTE_CHARS]
        words[owner] = replace(words.get(owner, TeacherWord()), note=note)
    return {owner: word for owner, word in words.items() if word != TeacherWord()}


def words_in_file(path: str, owners: Collection[str], kept: Mapping[str, TeacherWord]) -> dict[str, TeacherWord]:
    """The words that were saved from a page of review, over those that are kept.

    Fails with `Refused` where it is no such file, or says what nobody can mean.
    """
    try:
        told = json.loads(text(Path(path), MB))[WORDS_KEY]
        words = {owner: _word_of(f"--words {path}: {owner}", word) for owner, word in told.items()}
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        raise Refused(f"--words {path}", "it does not hold decisions", "the file saved by a page of --review") from None
    for owner in words:
        if owner not in owners:
            raise Refused(f"--words {path}", f"there is no {owner!r} in this class", suggestion(owner, owners, "name"))
    return {**kept, **words}


def _word_of(where: str, told: Mapping[str, Any]) -> TeacherWord:
    """A word as it was saved: a score out of 100, or none, and verdicts that there are."""
    score, verdicts = told.get("score"), dict(told.get("verdicts", {}))
    if score is not None and not 0.0 <= float(score) <= FULL_SCORE:
        raise Refused(where, f"{score} is not a score", "a number from 0 to 100")
    if unknown := sorted({*verdicts.values()} - STATES.keys()):
        raise Refused(where, f"{unknown[0]!r} is not a verdict", f"one of {', '.join(STATES)}")
    note = " ".join(printable(str(told.get("note", ""))).split())[:measures.MAX_NOTE_CHARS]
    return TeacherWord(None if score is None else float(score), note, verdicts, bool(told.get("accepted")))


def keep_words(words: Mapping[str, TeacherWord], keeper: Keeper) -> None:
    """Keep the words with what was judged."""
    keeper.put(KEPT_KEY, {WORDS_KEY: {owner: asdict(word) for owner, word in sorted(words.items())}})


def kept_words(keeper: Keeper) -> dict[str, TeacherWord]:
    """The words that are kept with what was judged of a class."""
    return {owner: TeacherWord(**word) for owner, word in (keeper.get(KEPT_KEY) or {}).get(WORDS_KEY, {}).items()}


def _owner(option: str, name: str, text: str, owners: Mapping[str, str], meant: Collection[str]) -> str:
    """Name of the drawing that a word is for; without a name, the only one."""
    if name in owners or (not name and len(meant) == 1):
        return owners.get(name) or next(iter(meant))
    if name:
        raise Refused(f"{option} {name}={text}", f"there is no {name!r} among what is judged",
                      suggestion(name, owners, "name"))
    raise Refused(f"{option} {text}", "it does not say whose it is", f'{option} "{next(iter(owners), "")}={text}"')


def _parse_score(owner: str, text: str) -> float | None:
    """A score out of 100; None to take it back."""
    if text.strip() == "-":
        return None
    score = decimal(text.strip())
    if not 0.0 <= score <= FULL_SCORE:
        raise Refused(f"--score {owner}={text}", "not a score", "a number from 0 to 100")
    return score


@dataclass(frozen=True)
class StackPage:
    """A page: its file, its number there, counted from 1, and its name, such as `scans.pdf#3`."""

    path: Path
    number: int
    name: str


@dataclass(frozen=True)
class PageSight:
    """View of a page: a digest of its picture, the numbers of the corner marks as it lies and as its mirror image has
    them, whether it is blank, and a small picture of it, a JPEG in base 64."""

    digest: str
    marks: Sequence[int]
    mirrored: Sequence[int]
    blank: bool
    thumbnail: str


def pages(stack: Path) -> tuple[list[StackPage], list[Unread]]:
    """All pages of a file or of the files in a folder, in the order of their names, and what is no scan.

    Fails with `Refused` where there is nothing to be read.
    """
    scans, unread = list[StackPage](), list[Unread]()
    for path in _files(stack):
        name = printable(path.name)
        try:
            scans += _file_pages(path, name)
        except GraphplanError as fault:
            unread.append(Unread(name, fault.lines[0].removeprefix(f"{path}: ")))
    return scans, unread


def look_at_page(page: StackPage) -> dict[str, Any]:
    """View of a page, as data; fails with `Refused` if it cannot be opened. Fails with `Refused` where it cannot be
    opened."""
    from graphplan.marking.scans.image import encode_jpeg, page_picture, shrink
    from graphplan.marking.scans.printed_ink import is_blank, marks_of_sheet

    image = page_picture(page.path, page.number)
    small = shrink(image, measures.THUMBNAIL_PX**2 * min(image.shape) / max(image.shape))
    marks, mirrored = (sorted(marks_of_sheet(picture).values()) for picture in (image, image[:, ::-1]))
    digest = blake2b(image.tobytes(), digest_size=measures.DIGEST_BYTES, person=b"graphplan page")
    digest.update(repr(image.shape).encode())
    empty = not marks and not mirrored and is_blank(image)
    return asdict(PageSight(digest.hexdigest(), marks, mirrored, empty,
                            b64encode(encode_jpeg(small, measures.THUMBNAIL_JPEG_QUALITY)).decode()))


def _files(stack: Path) -> list[Path]:
    """The files of a stack, without hidden ones."""
    if not stack.is_dir():
        return [stack]
    try:
        files = [path for path in stack.iterdir() if not path.name.startswith(".")]
    except OSError as fault:
        raise Refused(f"{stack}", f"it cannot be read ({fault.strerror})", "a readable folder") from None
    if not files:
        raise Refused(f"{stack}", "it contains no scan", "a folder of scans, PDF, PNG or JPEG")
    return sorted(files, key=lambda path: by_name(path.name))


def _file_pages(path: Path, name: str) -> Iterator[StackPage]:
    """The pages of a file."""
    if path.is_dir():
        raise Refused(f"{path}", "this is a folder within the folder", "move its scans out of it")
    if not path.is_file():
        raise Refused(f"{path}", "no such file", "a scan, or a folder of scans")
    if path.suffix.casefold() not in PICTURE_SUFFIXES:
        raise Refused(f"{path}", "not a scan", f"one of {' '.join(IMAGE_SUFFIXES)}")
    from graphplan.marking.scans.image import count

    many = path.suffix.casefold() == ".pdf"
    for number in range(1, count(path) + 1):
        yield StackPage(path, number, f"{name}#{number}" if many else name)


SET_ASIDE_NAME = "-"  # instead of a name: the page is set aside
BLANK = "blank"
PERHAPS = "perhaps"  # it counts or is joined, as there is no other sheet of its student, or is one


@dataclass(frozen=True)
class SeenPage:
    """A page and what is seen on it."""

    page: StackPage
    sight: PageSight


@dataclass(frozen=True)
class PlacedPage:
    """A page and what becomes of it: it counts, is the same sheet `again`, is joined to the sheet of its student, is
    blank, set aside by the teacher, or still unassigned; and what the teacher must know of it.

    `sheet` is whose task it is judged by, `owner` the student, or of a spare sheet nobody.
    """

    seen_page: SeenPage
    fate: str
    sheet: TaskSheet | None = None
    owner: str = ""
    mirrored: bool = False
    notes: tuple[Said, ...] = ()

    @property
    def whose(self) -> str:
        """A student, or the variant of a spare sheet."""
        return self.owner or (self.sheet.owner if self.sheet else "")


@dataclass(frozen=True)
class DecodedPage:
    """The sheet whose code a page has, and its number among its pages, or the reason why the code is unreadable; and
    the number of visible marks."""

    sheet: TaskSheet | None
    number: int = 1
    mirrored: bool = False
    marks: int = 0
    why: Said | None = None


def decode_page(sight: PageSight, register: ClassRegister) -> DecodedPage:
    """The sheet of a page by its marks: the only one of the class that they fit."""
    best = DecodedPage(None)
    for mirrored, marks in ((False, sight.marks), (True, sight.mirrored)):
        fitting = list(_fitting_sheets(marks, register.sheets))
        if len(fitting) > 1:
            names = join(_sheet_name(sheet) for sheet, _ in fitting)
            return DecodedPage(None, why=said("its corner marks fit several sheets: {0}", names))
        if fitting and len(marks) > best.marks:
            best = DecodedPage(*fitting[0], mirrored, len(marks))
    if best.sheet is not None:
        return best
    if len(sight.marks) > measures.MIN_MARKS_ALONE:
        return DecodedPage(None, why=said("its code is that of no sheet of this class"))
    return DecodedPage(None, why=said("too few of its corner marks can be read") if sight.marks else
                       said("no corner marks are seen on it"))


def _fitting_sheets(marks: Sequence[int], sheets: Iterable[TaskSheet]) -> Iterator[tuple[TaskSheet, int]]:
    """The sheets and the pages of them that bear these marks: all of them, or at least three."""
    for sheet, page in product(sheets, range(1, measures.MAX_TASK_PAGES + 1)):
        matching_marks = len(set(marks) & set(corner_numbers(page_code(sheet.code, page))))
        if matching_marks >= measures.MIN_MARKS_OF_SHEET or matching_marks == len(marks) >= measures.MIN_MARKS_ALONE:
            yield sheet, page


def _sheet_name(sheet: TaskSheet) -> Said | str:
    """A sheet by its student, or its variant."""
    return sheet.student or said("variant {0}", sheet.variant)


@dataclass(frozen=True)
class Assignment:
    """Whose a page is by the teacher's word: a student, or a variant; neither sets it aside."""

    student: str = ""
    variant: int = 0


def assignments(told: Sequence[str], pages: Sequence[StackPage], register: ClassRegister) -> dict[str, Assignment]:
    """The teacher's word by the name of the page: from `PAGE=STUDENT`, or tables with `page` and `student` or
    `variant`.

    Fails with `Refused` where there is no such page, student or variant.
    """
    assigned = {}
    for entry in told:
        for name, student, variant in _assigned_rows(entry):
            assigned[_page_name(entry, name, pages)] = _parse_assignment(entry, student, variant, register)
    return assigned


def _assigned_rows(told: str) -> Iterator[tuple[str, str, str]]:
    """Page, student and variant, as they were told."""
    if "=" in told and not Path(told).is_file():
        page, _, student = told.rpartition("=")
        yield page.strip(), student.strip(), ""
        return
    written = text(Path(told), MB).splitlines()
    rows = csv.DictReader(written, delimiter=";" if written[0].count(";") else ",", restval="")
    heads = {(head or "").strip().casefold(): head for head in rows.fieldnames or ()}
    if "page" not in heads or not heads.keys() & {"student", "variant"}:
        raise Refused(f"--assign {told}", "it has no columns page and student", "a first line such as page,student")
    for row in rows:
        page, student, variant = (str(row[heads[head]]).strip() if head in heads else ""
                                  for head in ("page", "student", "variant"))
        if page and (student or variant):
            yield page, student, variant


def _page_name(told: str, name: str, pages: Sequence[StackPage]) -> str:
    """The name of a page; of a stack in one file the number will do."""
    names = [page.name for page in pages]
    if name in names:
        return name
    if len({page.path for page in pages}) == 1 and name.isdecimal() and 0 < int(name) <= len(names):
        return names[int(name) - 1]
    raise Refused(f"--assign {told}", f"there is no page {name} in the stack", suggestion(name, names, "page"))


def _parse_assignment(told: str, student: str, variant: str, register: ClassRegister) -> Assignment:
    """Parse the student or variant of an assignment."""
    if SET_ASIDE_NAME in (student, variant):
        return Assignment()
    variants = [str(sheet.variant) for sheet in register.sheets]
    if variant and variant not in variants:
        raise Refused(f"--assign {told}", f"there is no variant {variant}",
                      f"one of {', '.join(dict.fromkeys(variants))}")
    return Assignment(student, int(variant or 0))


def place_pages(stack: Iterable[SeenPage], register: ClassRegister,
                assigned: Mapping[str, Assignment]) -> list[PlacedPage]:
    """Place every page, in the order of the stack.

    Fails with `Refused` if a page without a code is assigned to a student without a sheet.
    """
    placed_pages = [_place_page(seen_page, decode_page(seen_page.sight, register), register,
                                assigned.get(seen_page.page.name))
                    for seen_page in stack]
    return list(_choose_counting(placed_pages))


def _place_page(seen: SeenPage, code: DecodedPage, register: ClassRegister, word: Assignment | None) -> PlacedPage:
    """Place a page of a stack, without regard to the other pages."""
    if word is None and code.sheet is not None:
        return PlacedPage(seen, _fate(code), code.sheet, code.sheet.student, code.mirrored, tuple(_notes(code)))
    if word is None:
        why = (code.why,) if code.why is not None else ()
        return PlacedPage(seen, BLANK) if seen.sight.blank else PlacedPage(seen, UNASSIGNED, notes=why)
    if word == Assignment():
        return PlacedPage(seen, ASIDE, code.sheet)
    return _place_by_teacher(seen, code, register, word)


def _place_by_teacher(seen: SeenPage, code: DecodedPage, register: ClassRegister, word: Assignment) -> PlacedPage:
    """A page that the teacher names: what its code says of the task stands, the name is the teacher's."""
    sheet = code.sheet or register.sheet_of(word.student) or _variant(register, word.variant)
    if sheet is None:
        students = [sheet.student for sheet in register.sheets if sheet.student]
        raise Refused(f"--assign {seen.page.name}={word.student}", "this student has no sheet, and the page no code",
                      suggestion(word.student, students, "student"))
    notes = *_notes(code), said("named by the teacher")
    return PlacedPage(seen, _fate(code), sheet, word.student or sheet.student, code.mirrored, notes)


def _fate(code: DecodedPage) -> str:
    """Use of a student's page: the plans are judged; further pages, and those without a code, are joined to them."""
    if code.sheet is None:
        return PERHAPS
    return JUDGED if code.number == 1 else JOINED


def _variant(register: ClassRegister, variant: int) -> TaskSheet | None:
    return next((sheet for sheet in register.sheets if sheet.variant == variant), None)


def _notes(code: DecodedPage) -> Iterator[Said]:
    """Yield the remarks on the reading of a page."""
    if code.mirrored:
        yield said("the page is mirrored")
    if code.sheet is not None and code.marks < measures.MARKS_OF_PAGE:
        yield said("{0} of 4 corner marks are read", code.marks)


def _choose_counting(found: Sequence[PlacedPage]) -> Iterator[PlacedPage]:
    """Choose the first sheet of each student to be judged, further ones are reported; a page without a code that the
    teacher names is used if there is no other."""
    first = dict[str, PlacedPage]()
    for fate in (JUDGED, PERHAPS):
        for page in found:
            if page.fate == fate:
                first.setdefault(page.whose, page)
    for page in found:
        counts = first.get(page.whose)
        if page.fate not in (JUDGED, PERHAPS) or counts is None:
            yield page
        elif page is counts:
            yield replace(page, fate=JUDGED)
        elif page.fate == PERHAPS:
            yield replace(page, fate=JOINED)
        else:
            note = said("handed in twice: page {0} counts", counts.seen_page.page.name)
            yield replace(page, fate=AGAIN, notes=(*page.notes, note))


def replace_failed(found: Sequence[PlacedPage], failed: Collection[str]) -> Iterator[PlacedPage]:
    """Replace pages that cannot be judged by the next scan of the same sheet, if it can be."""
    gone = {page.whose: page for page in found if page.fate == JUDGED and page.seen_page.page.name in failed}
    counts = dict[str, PlacedPage]()
    for page in found:
        if page.fate == AGAIN and page.seen_page.page.name not in failed and page.whose in gone:
            counts.setdefault(page.whose, page)
    for page in found:
        if counts.get(page.whose) is page:
            note = said("page {0} cannot be judged", gone[page.whose].seen_page.page.name)
            yield replace(page, fate=JUDGED, notes=(*page.notes[:-1], note))
        elif page.fate == JUDGED and page.whose in counts:
            yield replace(page, fate=AGAIN)
        else:
            yield page
