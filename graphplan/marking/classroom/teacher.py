"""The teacher's own word on a student's drawing: a score, a note, or both. It is kept with the results, so that it
holds until another one is given, and said on what is handed back."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict, dataclass, replace

from graphplan.accuracy.hand import decimal
from graphplan.errors import Refused, printable
from graphplan.marking.classroom import measures
from graphplan.marking.classroom.grading import Keeper
from graphplan.marking.judge.measures import FULL_SCORE
from graphplan.mechanism.fields import suggestion

KEPT_KEY = "teacher"


@dataclass(frozen=True)
class TeacherWord:
    """What a teacher says of a drawing: the score, none where the judge's is left, and a note."""

    score: float | None = None
    note: str = ""


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


def keep_words(words: Mapping[str, TeacherWord], keeper: Keeper) -> None:
    """Keep the words with what was judged."""
    keeper.put(KEPT_KEY, {"words": {owner: asdict(word) for owner, word in sorted(words.items())}})


def kept_words(keeper: Keeper) -> dict[str, TeacherWord]:
    """The words that are kept with what was judged of a class."""
    return {owner: TeacherWord(**word) for owner, word in (keeper.get(KEPT_KEY) or {}).get("words", {}).items()}


def _owner(option: str, name: str, text: str, owners: Mapping[str, str], meant: Collection[str]) -> str:
    """Whose drawing a word is on; where it names nobody, the only one that is meant."""
    if name in owners or (not name and len(meant) == 1):
        return owners.get(name) or next(iter(meant))
    if name:
        raise Refused(f"{option} {name}={text}", f"there is no {name!r} among what is judged",
                      suggestion(name, owners, "name"))
    raise Refused(f"{option} {text}", "it does not say whose it is", f'{option} "{next(iter(owners), "")}={text}"')


def _parse_score(owner: str, text: str) -> float | None:
    """A score out of 100; none where it is taken back."""
    if text.strip() == "-":
        return None
    score = decimal(text.strip())
    if not 0.0 <= score <= FULL_SCORE:
        raise Refused(f"--score {owner}={text}", "not a score", "a number from 0 to 100")
    return score
