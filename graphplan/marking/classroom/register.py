"""The register of a class: which sheet is whose, told by the code of its corner marks.

It stands in `class.json` beside the scenes of the tasks. What it says of how they are drawn is by the names of the
command line, so that each sheet can be composed again as it was printed.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from graphplan.errors import Refused
from graphplan.sheet.frames.frame import corner_numbers

FILE = "class.json"
REMEDY = "the class.json that graphplan variants wrote"


@dataclass(frozen=True)
class TaskSheet:
    """A printed task: the code of its corner marks, its variant, its student (none of a spare sheet), the file of its
    scene in the folder, and its page in the booklet, counted from 1."""

    code: int
    variant: int
    student: str
    scene: str
    page: int


@dataclass(frozen=True)
class Register:
    """The sheets of a class, the seed that their numbers were drawn by, and the options by which they are drawn."""

    title: str
    seed: int
    options: Mapping[str, str]
    sheets: tuple[TaskSheet, ...]

    def with_code(self, code: int) -> TaskSheet | None:
        """The sheet that has these corner marks; None where none has."""
        return next((sheet for sheet in self.sheets if corner_numbers(sheet.code) == corner_numbers(code)), None)

    def of(self, student: str) -> TaskSheet | None:
        """The sheet of a student; None where there is no such student."""
        return next((sheet for sheet in self.sheets if student and sheet.student == student), None)

    @property
    def alike(self) -> tuple[int, int] | None:
        """The first two variants whose sheets have the same corner marks; None where all differ."""
        seen: dict[tuple[int, ...], int] = {}
        for sheet in self.sheets:
            other = seen.setdefault(corner_numbers(sheet.code), sheet.variant)
            if other != sheet.variant:
                return other, sheet.variant
        return None

    @property
    def data(self) -> dict[str, Any]:
        """The same as data."""
        return {"title": self.title, "seed": self.seed, "options": dict(self.options),
                "sheets": [asdict(sheet) for sheet in self.sheets]}

    @property
    def text(self) -> str:
        """The file."""
        return json.dumps(self.data, indent=1, ensure_ascii=False) + "\n"

    def save(self, folder: Path) -> None:
        """Write the file into a folder."""
        (folder / FILE).write_text(self.text, encoding="utf-8")


def is_class(folder: Path) -> bool:
    """Whether a folder has a register."""
    return (folder / FILE).is_file()


def load(folder: Path) -> Register:
    """The register in a folder. Fails with `Refused` where there is none, or it is not what graphplan writes."""
    path = folder / FILE
    try:
        read = json.loads(path.read_text(encoding="utf-8"))
        return _register(read)
    except OSError as error:
        raise Refused(f"{path}", f"it cannot be read ({error.strerror})", "a folder that graphplan variants wrote"
                      ) from None
    except (ValueError, RecursionError):  # no UTF-8, or no JSON
        raise Refused(f"{path}", "not JSON", REMEDY) from None
    except (KeyError, TypeError):
        raise Refused(f"{path}", "not a register of a class", REMEDY) from None


KINDS = {"code": int, "variant": int, "student": str, "scene": str, "page": int}


def _register(read: Any) -> Register:
    """The register of a file; fails with `KeyError` or `TypeError` where something is missing or of another kind."""
    sheets = tuple(TaskSheet(**{key: _kept(row[key], kind) for key, kind in KINDS.items()}) for row in read["sheets"])
    options = {_kept(key, str): _kept(value, str) for key, value in dict(read["options"]).items()}
    if any(Path(sheet.scene).name != sheet.scene for sheet in sheets):  # a scene lies in the folder itself
        raise KeyError("scene")
    return Register(_kept(read["title"], str), _kept(read["seed"], int), options, sheets)


def _kept(value: Any, kind: type) -> Any:
    if type(value) is not kind:
        raise TypeError
    return value
