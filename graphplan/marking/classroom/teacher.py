"""The teacher's own word on a student's drawing: a score, a note, or both. It is kept with the results of the class, so
that it holds until another one is given, and said on what is handed back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace

from graphplan.accuracy.hand import decimal
from graphplan.errors import Refused, printable
from graphplan.marking.classroom.grading import Keeper
from graphplan.marking.classroom.register import ClassRegister
from graphplan.marking.judge import measures
from graphplan.mechanism.items import suggestion

KEPT_KEY = "teacher"
MAX_NOTE_CHARS = 500


@dataclass(frozen=True)
class TeacherWord:
    """What a teacher says of a drawing: the score, none where the judge's is left, and a note."""

    score: float | None = None
    note: str = ""


def teacher_words(scores: Sequence[str], notes: Sequence[str], register: ClassRegister, keeper: Keeper
                  ) -> dict[str, TeacherWord]:
    """The words by student, or by variant where a sheet has none: those that are kept, and over them `STUDENT=SCORE`
    and `STUDENT=NOTE`; a note that names nobody is on the only student who is given a score. A `-` takes a word back.

    Fails with `Refused` where there is no such student, or no such score.
    """
    kept = (keeper.get(KEPT_KEY) or {}).get("words", {})
    words = {owner: TeacherWord(**word) for owner, word in kept.items()}
    scored = [_parse_entry("--score", entry, register) for entry in scores]
    for owner, text in scored:
        words[owner] = replace(words.get(owner, TeacherWord()), score=_parse_score(owner, text))
    for entry in notes:
        if len(scored) == 1 and _owner(entry.partition("=")[0].strip(), register) is None:
            owner, text = scored[0][0], entry
        else:
            owner, text = _parse_entry("--note", entry, register)
        note = "" if text.strip() == "-" else " ".join(printable(text).split())[:MAX_NOTE_CHARS]
        words[owner] = replace(words.get(owner, TeacherWord()), note=note)
    return {owner: word for owner, word in words.items() if word != TeacherWord()}


def keep_words(words: Mapping[str, TeacherWord], keeper: Keeper) -> None:
    """Keep the words with what was judged."""
    keeper.put(KEPT_KEY, {"words": {owner: asdict(word) for owner, word in sorted(words.items())}})


def _parse_entry(option: str, entry: str, register: ClassRegister) -> tuple[str, str]:
    """Whose drawing is meant, and what is said of it."""
    name, _, text = entry.partition("=") if option == "--note" else entry.rpartition("=")
    owner = _owner(name.strip(), register)
    if owner is None:
        names = [sheet.student or str(sheet.variant) for sheet in register.sheets]
        raise Refused(f"{option} {entry}", f"there is no student {name.strip()!r} in this class",
                      suggestion(name.strip(), names, "student"))
    return owner, text


def _owner(name: str, register: ClassRegister) -> str | None:
    """A student of the class by name, or of a sheet that has none by its variant."""
    return next((name for sheet in register.sheets if name and name == (sheet.student or str(sheet.variant))), None)


def _parse_score(owner: str, text: str) -> float | None:
    """A score out of 100; none where it is taken back."""
    if text.strip() == "-":
        return None
    score = decimal(text.strip())
    if not 0.0 <= score <= measures.FULL_SCORE:
        raise Refused(f"--score {owner}={text}", "not a score", "a number from 0 to 100")
    return score
