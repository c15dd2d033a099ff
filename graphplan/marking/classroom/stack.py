"""Whose each page of a stack is: by the code of its corner marks, or by the word of the teacher, and never by a guess.

A page scanned twice is told, and its first scan counts. Pages without a code are left to the teacher, who names them
(after A. Bienvenüe's Auto Multiple Choice, whose association is by a code, by a list, or by hand).
"""

from __future__ import annotations

import csv
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path

from graphplan.errors import Refused
from graphplan.marking.classroom.pages import Sight, StackPage
from graphplan.marking.classroom.register import Register, TaskSheet
from graphplan.marking.files.safe import MB, text
from graphplan.mechanism.items import suggestion
from graphplan.phrases import Said, join, said
from graphplan.sheet.frames.frame import corner_numbers, page_code

SURE, ENOUGH = 3, 2  # marks that tell a sheet though another one is misread, and though the others are lost
ALL = 4  # marks of a page
PAGES = 3  # of a task, at most
ASIDE = "-"  # in the place of a name: the page is set aside
COUNTS, AGAIN, JOINED, BLANK, SET_ASIDE, UNASSIGNED = "judged", "again", "joined", "blank", "aside", "unassigned"
PERHAPS = "perhaps"  # it counts or is joined, as there is no other sheet of its student, or is one


@dataclass(frozen=True)
class Seen:
    """A page and what is seen on it."""

    page: StackPage
    sight: Sight


@dataclass(frozen=True)
class Placed:
    """A page and what becomes of it: it counts, is the same sheet `again`, is joined to the sheet of its student, is
    blank, set aside by the teacher, or still unassigned; and what the teacher must know of it.

    `sheet` is whose task it is judged by, `owner` the student, or of a spare sheet nobody.
    """

    seen: Seen
    fate: str
    sheet: TaskSheet | None = None
    owner: str = ""
    mirrored: bool = False
    notes: tuple[Said, ...] = ()


@dataclass(frozen=True)
class Coded:
    """The sheet whose code a page bears, and which page of it it is, or why none is told; how many marks are seen."""

    sheet: TaskSheet | None
    number: int = 1
    mirrored: bool = False
    marks: int = 0
    why: Said | None = None


def coded(sight: Sight, register: Register) -> Coded:
    """The sheet of a page by its marks: the only one of the class that they fit."""
    best = Coded(None)
    for mirrored, marks in ((False, sight.marks), (True, sight.mirrored)):
        fitting = list(_fitting(marks, register.sheets))
        if len(fitting) > 1:
            names = join(_told(sheet) for sheet, _ in fitting)
            return Coded(None, why=said("its corner marks fit several sheets: {0}", names))
        if fitting and len(marks) > best.marks:
            best = Coded(*fitting[0], mirrored, len(marks))
    if best.sheet is not None:
        return best
    if len(sight.marks) > ENOUGH:
        return Coded(None, why=said("its code is that of no sheet of this class"))
    return Coded(None, why=said("too few of its corner marks can be read") if sight.marks else
                 said("no corner marks are seen on it"))


def _fitting(marks: Sequence[int], sheets: Iterable[TaskSheet]) -> Iterator[tuple[TaskSheet, int]]:
    """The sheets and the pages of them that bear these marks: all of them, or at least three."""
    for sheet, page in product(sheets, range(1, PAGES + 1)):
        own = len(set(marks) & set(corner_numbers(page_code(sheet.code, page))))
        if own >= SURE or own == len(marks) >= ENOUGH:
            yield sheet, page


def _told(sheet: TaskSheet) -> Said | str:
    """A sheet by its student, or its variant."""
    return sheet.student or said("variant {0}", sheet.variant)


# ---- the teacher's word --------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Assignment:
    """Whose a page is by the teacher's word: a student, or a variant; neither sets it aside."""

    student: str = ""
    variant: int = 0


def assignments(told: Sequence[str], pages: Sequence[StackPage], register: Register) -> dict[str, Assignment]:
    """The teacher's word by the name of the page: from `PAGE=STUDENT`, or tables with `page` and `student` or
    `variant`.

    Fails with `Refused` where there is no such page, student or variant.
    """
    found = {}
    for one in told:
        for name, student, variant in _rows(one):
            found[_page(one, name, pages)] = _assignment(one, student, variant, register)
    return found


def _rows(told: str) -> Iterator[tuple[str, str, str]]:
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


def _page(told: str, name: str, pages: Sequence[StackPage]) -> str:
    """The name of a page; of a stack in one file the number will do."""
    names = [page.name for page in pages]
    if name in names:
        return name
    if len({page.path for page in pages}) == 1 and name.isdecimal() and 0 < int(name) <= len(names):
        return names[int(name) - 1]
    raise Refused(f"--assign {told}", f"there is no page {name} in the stack", suggestion(name, names, "page"))


def _assignment(told: str, student: str, variant: str, register: Register) -> Assignment:
    """Who or what was meant."""
    if ASIDE in (student, variant):
        return Assignment()
    known = [str(sheet.variant) for sheet in register.sheets]
    if variant and variant not in known:
        raise Refused(f"--assign {told}", f"there is no variant {variant}", f"one of {', '.join(dict.fromkeys(known))}")
    return Assignment(student, int(variant or 0))


# ---- association ---------------------------------------------------------------------------------------------------


def placed(stack: Iterable[Seen], register: Register, assigned: Mapping[str, Assignment]) -> list[Placed]:
    """What becomes of every page, in the order of the stack.

    Fails with `Refused` where a page without a code is assigned to a student who has no sheet.
    """
    found = [_placed(seen, coded(seen.sight, register), register, assigned.get(seen.page.name)) for seen in stack]
    return list(_counted(found))


def _placed(seen: Seen, code: Coded, register: Register, word: Assignment | None) -> Placed:
    """One page, whatever the others are."""
    if word is None and code.sheet is not None:
        return Placed(seen, _fate(code), code.sheet, code.sheet.student, code.mirrored, tuple(_notes(code)))
    if word is None:
        why = (code.why,) if code.why is not None else ()
        return Placed(seen, BLANK) if seen.sight.blank else Placed(seen, UNASSIGNED, notes=why)
    if word == Assignment():
        return Placed(seen, SET_ASIDE, code.sheet)
    return _named(seen, code, register, word)


def _named(seen: Seen, code: Coded, register: Register, word: Assignment) -> Placed:
    """A page that the teacher names: what its code says of the task stands, the name is the teacher's."""
    sheet = code.sheet or register.of(word.student) or _variant(register, word.variant)
    if sheet is None:
        students = [sheet.student for sheet in register.sheets if sheet.student]
        raise Refused(f"--assign {seen.page.name}={word.student}", "this student has no sheet, and the page no code",
                      suggestion(word.student, students, "student"))
    notes = *_notes(code), said("named by the teacher")
    return Placed(seen, _fate(code), sheet, word.student or sheet.student, code.mirrored, notes)


def _fate(code: Coded) -> str:
    """What becomes of a page that is somebody's: the plans count; further pages, and those without a code, are joined
    to them."""
    if code.sheet is None:
        return PERHAPS
    return COUNTS if code.number == 1 else JOINED


def _variant(register: Register, variant: int) -> TaskSheet | None:
    return next((sheet for sheet in register.sheets if sheet.variant == variant), None)


def _notes(code: Coded) -> Iterator[Said]:
    """What the teacher must know of how a page was read."""
    if code.mirrored:
        yield said("the page is mirrored")
    if code.sheet is not None and code.marks < ALL:
        yield said("{0} of 4 corner marks are read", code.marks)


def _counted(found: Sequence[Placed]) -> Iterator[Placed]:
    """The first sheet of everybody counts, further ones are told; a page without a code that the teacher names is
    that sheet where there is none."""
    first = dict[str, Placed]()
    for fate in (COUNTS, PERHAPS):
        for one in found:
            if one.fate == fate:
                first.setdefault(_key(one), one)
    for one in found:
        counts = first.get(_key(one))
        if one.fate not in (COUNTS, PERHAPS) or counts is None:
            yield one
        elif one is counts:
            yield replace(one, fate=COUNTS)
        elif one.fate == PERHAPS:
            yield replace(one, fate=JOINED)
        else:
            note = said("handed in twice: page {0} counts", counts.seen.page.name)
            yield replace(one, fate=AGAIN, notes=(*one.notes, note))


def instead(found: Sequence[Placed], failed: Collection[str]) -> Iterator[Placed]:
    """The same, where some pages by their names cannot be judged: the next scan of the same sheet, if it can be, counts
    in its place."""
    gone = {_key(one): one for one in found if one.fate == COUNTS and one.seen.page.name in failed}
    counts = dict[str, Placed]()
    for one in found:
        if one.fate == AGAIN and one.seen.page.name not in failed and _key(one) in gone:
            counts.setdefault(_key(one), one)
    for one in found:
        if counts.get(_key(one)) is one:
            yield replace(one, fate=COUNTS, notes=(*one.notes[:-1], said("page {0} cannot be judged",
                                                                         gone[_key(one)].seen.page.name)))
        elif one.fate == COUNTS and _key(one) in counts:
            yield replace(one, fate=AGAIN)
        else:
            yield one


def _key(one: Placed) -> str:
    """Whose a page is: a student's, or the variant's of a spare sheet."""
    return one.owner or (str(one.sheet.variant) if one.sheet else "")
