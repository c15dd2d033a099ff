"""The page on which a teacher looks at the sheets of a class: what was read of each laid over it, and its verdicts, to
be accepted or overruled by mouse and keys. It is one file, fetches nothing, and saves what is decided as a file.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import asdict
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any

from graphplan.marking.classroom.results import JUDGED, StackResults
from graphplan.marking.classroom.stack import WORDS_KEY, TeacherWord
from graphplan.marking.judge.verdict import FOLLOWS, MISSING, RIGHT, STATES, WRONG
from graphplan.phrases import phrase
from graphplan.words.tongue import Tongue

OVERRULES = RIGHT, FOLLOWS, WRONG, MISSING  # the verdicts that a teacher may give, by the keys 1, 2, 3, 4
LABELS = {
    "review": phrase("Review"), "sheets": phrase("Sheets of the class"), "steps": phrase("Steps"),
    "verdict": phrase("Verdict"), "score": phrase("Score"), "own": phrase("The teacher's own score"),
    "note": phrase("Note"), "accept": phrase("Accept the sheet and go to the next"), "next": phrase("Next sheet"),
    "previous": phrase("Previous sheet"), "save": phrase("Save the decisions"), "judge": phrase("the judge's verdict"),
    "all": phrase("Show all steps"),
    "after": phrase("The score is computed again when the decisions are given to verify --words."),
}  # fmt: skip


def review_page(found: StackResults, words: Mapping[str, TeacherWord], kept: Path, tongue: Tongue) -> str:
    """The page of a class, the sheets that are to be looked at first; `words` are those that the teacher said before,
    `kept` is the folder with the sheets that were laid over."""
    data = {"title": found.title, "words": {owner: asdict(word) for owner, word in words.items()},
            "states": {state: str(tongue(words_of())) for state, words_of in STATES.items()}, "overrules": OVERRULES,
            "labels": {name: str(tongue(label())) for name, label in LABELS.items()}, "key": WORDS_KEY,
            "sheets": list(_sheets(found, kept))}
    text = files(__package__).joinpath("review_page.html").read_text("utf-8")
    fields = {"language": tongue.code, "title": escape(found.title), "data": json.dumps(data, ensure_ascii=False)
              .replace("<", "\\u003c")}
    return re.sub(r"\{\{(\w+)\}\}", lambda slot: fields[slot[1]], text)


def _sheets(found: StackResults, kept: Path) -> Any:
    """The sheets that were judged, as data."""
    for sheet in found.in_order_of_doubt:
        if sheet.status == JUDGED:
            yield {"owner": sheet.student or str(sheet.variant), "page": sheet.page, "score": sheet.score,
                   "words": sheet.words, "look": sheet.look_text, "rows": sheet.review,
                   "picture": (kept / sheet.overlaid).read_text("utf-8")}
