"""The pages of a stack of scans, each by its name, and what is seen on them before anyone knows whose they are."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from hashlib import blake2b
from pathlib import Path
from typing import Any

from graphplan.errors import GraphplanError, Refused, by_name, printable
from graphplan.marking.classroom.class_list import Unread
from graphplan.marking.submission import IMAGES

THUMBNAIL, QUALITY = 480, 70  # pixels of its longer side, and how well JPEG keeps it


@dataclass(frozen=True)
class StackPage:
    """A page: its file, its number there, counted from 1, and its name, such as `scans.pdf#3`."""

    path: Path
    number: int
    name: str


@dataclass(frozen=True)
class Sight:
    """What is seen on a page: a digest of its picture, the numbers of the corner marks as it lies and as its mirror
    image has them, whether it is blank, and a small picture of it, a JPEG in base 64."""

    digest: str
    marks: tuple[int, ...]
    mirrored: tuple[int, ...]
    blank: bool
    thumbnail: str

    @property
    def data(self) -> dict[str, Any]:
        """The same as data."""
        return asdict(self)


def sight(data: dict[str, Any]) -> Sight:
    """What was seen, from its data. Fails with `TypeError` or `KeyError` where it is none."""
    return Sight(**{**data, "marks": tuple(data["marks"]), "mirrored": tuple(data["mirrored"])})


def pages(stack: Path) -> tuple[list[StackPage], list[Unread]]:
    """All pages of a file or of the files in a folder, in the order of their names, and what is no scan.

    Fails with `Refused` where there is nothing to be read.
    """
    found, unread = list[StackPage](), list[Unread]()
    for path in _files(stack):
        name = printable(path.name)
        try:
            found += _numbered(path, name)
        except GraphplanError as fault:
            unread.append(Unread(name, fault.lines[0].removeprefix(f"{path}: ")))
    return found, unread


def look(page: StackPage) -> Sight:
    """What is seen on a page. Fails with `Refused` where it cannot be opened."""
    from graphplan.marking.scans.image import jpeg, picture, smaller
    from graphplan.marking.scans.sheet_marks import blank, sheet_marks

    image = picture(page.path, page.number)
    small = smaller(image, THUMBNAIL**2 * min(image.shape) / max(image.shape))
    marks, mirrored = (tuple(sorted(sheet_marks(seen).values())) for seen in (image, image[:, ::-1]))
    digest = blake2b(image.tobytes(), digest_size=16, person=b"graphplan page")
    digest.update(repr(image.shape).encode())
    empty = not marks and not mirrored and blank(image)
    return Sight(digest.hexdigest(), marks, mirrored, empty, b64encode(jpeg(small, QUALITY)).decode())


def _files(stack: Path) -> list[Path]:
    """The files of a stack; what is hidden is none."""
    if not stack.is_dir():
        return [stack]
    try:
        held = [path for path in stack.iterdir() if not path.name.startswith(".")]
    except OSError as fault:
        raise Refused(f"{stack}", f"it cannot be read ({fault.strerror})", "a readable folder") from None
    if not held:
        raise Refused(f"{stack}", "it contains no scan", "a folder of scans, PDF, PNG or JPEG")
    return sorted(held, key=lambda path: by_name(path.name))


def _numbered(path: Path, name: str) -> Iterator[StackPage]:
    """The pages of a file."""
    if path.is_dir():
        raise Refused(f"{path}", "this is a folder within the folder", "move its scans out of it")
    if not path.is_file():
        raise Refused(f"{path}", "no such file", "a scan, or a folder of scans")
    if path.suffix.casefold() not in IMAGES:
        raise Refused(f"{path}", "not a scan", f"one of {' '.join(IMAGES)}")
    from graphplan.marking.scans.image import count

    many = path.suffix.casefold() == ".pdf"
    for number in range(1, count(path) + 1):
        yield StackPage(path, number, f"{name}#{number}" if many else name)
