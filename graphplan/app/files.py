"""Files: where results are written, in one step, whole or not at all, also behind a symbolic link.

A device or a pipe is written through and stays what it is; `-` is standard output. Folders are made where they are
missing. Who is `listening` is told the name of each file that was written.
"""

from __future__ import annotations

import json
import os
import re
import stat
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from errno import EACCES, EBADF, EEXIST, EISDIR, ENOTDIR
from io import StringIO
from typing import Any

from graphplan.errors import Refused

STANDARD = "-"
Content = str | bytes | Iterable[bytes]
MAX_ROW_LENGTH = 100  # of a row of numbers
NUMBERS = re.compile(r"\[\n( *)([-+\d.eE,\s]+|(?:[-+\d.eE,\s]|null|NaN|Infinity)+)\]")  # no string has a line's end


SHEETS = (".svg", ".pdf", ".png", ".dxf", ".tex")  # what sheets of diagrams are written as
HANDOUT_ENDINGS, LIVE_ENDINGS = (".pdf", ".html"), (".html",)
PARTS = "task", "guided", "solution"  # of a handout
DEFAULT_DPI = 150  # per inch
PROTOCOL = "-protocol"  # what the name of a page of words adds to that of the sheet

_listeners: list[Callable[[str], None]] = []


@contextmanager
def listening(listener: Callable[[str], None]) -> Iterator[None]:
    """Tell this listener, and no other, the name of each file that is written meanwhile."""
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


def _announce(*names: str) -> None:
    """Tell who listens what was written."""
    for name in names if _listeners else ():
        _listeners[-1](name)


def kind(path: str | None, endings: Sequence[str], what: str, option: str = "-o") -> str:
    """The ending of an output among a command's endings, in lower case; the first if its name has no ending.

    Fails with `Refused` where the ending is another one, or nothing can be written there: before any work is done.
    """
    if path is None or path == STANDARD:
        return endings[0]
    try:
        _is_file(path)
    except (OSError, ValueError) as error:
        raise _unwritable(path, error) from None
    ending = os.path.splitext(path)[1].lower()
    if ending and ending not in endings:
        raise Refused(f"{option} {path}", f"no {what} is written as {ending}", f"a name in {', '.join(endings)}")
    return ending or endings[0]


def handout_ending(path: str, only: str | None) -> str:
    """The ending of a handout; fails with `Refused` where it has no such part alone."""
    ending = kind(path, HANDOUT_ENDINGS, "handout")
    if only is not None and only not in PARTS:
        raise Refused(f"--only {only}", "a handout has no such part", f"one of {', '.join(PARTS)}")
    if only and ending == ".html":
        raise Refused(f"--only {only}", "a page for a browser has no parts", "leave it out, or -o FILE.pdf")
    return ending


def refuse_same_output(*paths: str | None) -> None:
    """Refuse one name for two results, of which one would replace the other."""
    named = list[str]()
    for path in filter(None, paths):
        try:
            named.append(path if path == STANDARD else os.path.realpath(path))
        except ValueError as error:  # a byte that no file name may have
            raise _unwritable(path, error) from None
    if twice := next((name for name in named if named.count(name) > 1), ""):
        raise Refused(f"{twice}: output", "two results would be written to one file", "a name for each")


def refuse_without_room(path: str, size: int, instead: str) -> None:
    """Refuse a file, which is being written, of about so many bytes where not even half of them have room on its disk.
    """
    import shutil

    free = shutil.disk_usage(os.path.dirname(os.path.realpath(path))).free
    if _is_file(path) and size > 2 * free:
        raise Refused(f"{path}: output",
                      f"about {size / 1e9:,.1f} GB would be written, and {free / 1e9:,.1f} GB are free", instead)


def folder_at(path: str | os.PathLike[str]) -> None:
    """Refuse a folder that is not there and cannot be made: before any work is done."""
    try:
        _require_folder(os.path.realpath(path))
    except (OSError, ValueError) as error:
        raise _unwritable(os.fspath(path), error) from None


def new_folder(path: str) -> None:
    """Refuse a name at which no new folder can be made: what is there must be an empty folder."""
    if path == STANDARD:
        raise Refused(f"-o {path}", "a folder cannot go to standard output", "the name of a folder")
    try:
        place = os.path.realpath(path)
        with suppress(FileNotFoundError):
            if os.listdir(place):
                raise Refused(f"{path}: folder", "it is there already, and not empty", "another name, or an empty one")
        _require_folder(os.path.dirname(place))
    except (OSError, ValueError) as error:
        raise _unwritable(path, error) from None


def write_folder(files: Mapping[str, str | bytes], path: str) -> None:
    """Make a new folder with these files in one step, whole or not at all."""
    import shutil

    new_folder(path)
    place = os.path.realpath(path)
    temporary = os.path.join(os.path.dirname(place), f".graphplan-{os.urandom(8).hex()}")
    try:
        os.makedirs(temporary)
        for name, content in files.items():
            with open(os.path.join(temporary, name), "xb") as file:
                file.write(content.encode() if isinstance(content, str) else content)
        if os.path.isdir(place):
            os.rmdir(place)
        os.rename(temporary, place)
        _announce(path)
    except OSError as error:
        raise _unwritable(path, error) from None
    finally:  # not there any more where all went well
        shutil.rmtree(temporary, ignore_errors=True)


def write(content: Content, path: str | None = STANDARD, *, new: bool = False) -> None:
    """Write text (as UTF-8), bytes, or parts to a file or to standard output; with `new` an existing file is not
    replaced."""
    write_all([(path, content)], new=new)


def page_names(path: str | None, count: int, more: str = "") -> list[str | None]:
    """The names of so many pages: SHEET.svg, then SHEET-2.svg or, where their names add `more`, SHEET-more.svg and
    SHEET-more-2.svg. What is no file has the first page alone.

    Fails with `Refused` where one of them cannot be written.
    """
    if path is None or path == STANDARD or count == 1 or not _is_file(path):
        return [path]
    stem, ending = os.path.splitext(path)
    first = 1 if more else 2
    numbered = [f"{stem}{more}{f'-{k}' if k > 1 else ''}{ending}" for k in range(first, first + count - 1)]
    for name in numbered:
        kind(name, (ending.lower(),), "page")
    return [path, *numbered]


def write_sheets(pages: Sequence[Any], path: str | None, ending: str, dpi: int | None = None,
                 suffix: str = PROTOCOL) -> None:
    """Write the pages of a sheet of diagrams, by its ending: the words that stand apart follow it as further pages, or
    as files of their own, with this suffix."""
    from graphplan.output import back_end, sheet_writer

    if ending in ("pdf", "dxf"):
        write(back_end(ending)(pages), path)
    else:
        write_out, look = sheet_writer(ending), {"dpi": dpi or DEFAULT_DPI} if ending == "png" else {}
        names = page_names(path, len(pages), suffix)
        write_all([(name, write_out(page, **look)) for name, page in zip(names, pages, strict=False)])


def write_all(contents: Sequence[tuple[str | None, Content]], *, new: bool = False) -> None:
    """Write several outputs: each file in one step, and no file where one of them cannot be written.

    Each is written beside its place, then all are put there: two that write at once do not mix.
    """
    path, places = None, dict[str, tuple[str, str]]()
    try:
        for path, content in contents:
            whole = content.encode() if isinstance(content, str) else content
            data = [whole] if isinstance(whole, bytes) else whole
            if path is None or path == STANDARD or not _is_file(path):
                _pass_on(data, path)
                continue
            target, there = os.path.realpath(path), os.path.exists(path)
            if there and new:
                raise FileExistsError(EEXIST, os.strerror(EEXIST))
            folder = os.path.dirname(target)
            os.makedirs(folder, exist_ok=True)
            temporary, _ = places[path] = os.path.join(folder, f".graphplan-{os.urandom(8).hex()}"), target
            with open(temporary, "xb") as file:
                file.writelines(data)
            if there:
                os.chmod(temporary, stat.S_IMODE(os.stat(target).st_mode))
        for temporary, target in places.values():
            os.replace(temporary, target)
    except (OSError, ValueError) as error:
        if isinstance(error, BrokenPipeError) and path in (None, STANDARD):
            raise  # whoever read standard output has had enough, which is no fault
        raise _unwritable(path, error) from None
    finally:  # not there any more where all went well; there also where the user interrupts
        for temporary, _ in places.values():
            with suppress(OSError):
                os.unlink(temporary)
    _announce(*places)


def as_json(data: Any, indent: int = 1, rows: bool = False) -> str:
    """Data as a text file; lists of numbers as `rows` of them, where there are tables."""
    text = json.dumps(data, indent=indent, ensure_ascii=False) + "\n"
    return NUMBERS.sub(_row, text) if rows else text


def _row(listed: re.Match[str]) -> str:
    """A list of numbers on one line, or filling lines where it is long."""
    row = " ".join(listed[2].split())
    if len(row) <= MAX_ROW_LENGTH:
        return f"[{row}]"
    import textwrap

    lines = textwrap.wrap(row, MAX_ROW_LENGTH, initial_indent=listed[1], subsequent_indent=listed[1])
    return "\n".join(["[", *lines, listed[1][:-1] + "]"])


def flush() -> None:
    """Flush what other code, such as argparse, has printed; fails as `write` does."""
    if sys.stdout is not None:
        write(b"")


def hush() -> None:
    """Discard what standard output could not take, so that the process does not retry when it ends."""
    with suppress(OSError):  # held in memory, it has no descriptor
        if sys.stdout is not None:
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _pass_on(data: Iterable[bytes], path: str | None) -> None:
    """Write to standard output, by whatever name, or to a device or a pipe."""
    if path not in (None, STANDARD) and not _is_standard(os.stat(path)):
        with open(path, "wb") as file:
            file.writelines(data)
        return
    if sys.stdout is None:
        raise OSError(EBADF, "it is closed")
    sys.stdout.flush()
    if isinstance(sys.stdout, StringIO):
        sys.stdout.write(b"".join(data).decode())
    else:
        sys.stdout.buffer.writelines(data)
        sys.stdout.buffer.flush()


def _is_file(path: str) -> bool:
    """Whether a name is, or is going to be, that of a regular file, and not of standard output; fails with `OSError`
    where it cannot be written."""
    if os.path.isdir(path):
        raise OSError(EISDIR, "this is a directory")
    try:
        status = os.stat(path)
    except FileNotFoundError:
        status = None
    if status and (not stat.S_ISREG(status.st_mode) or _is_standard(status)):
        return False
    target = os.path.realpath(path)
    _require_folder(os.path.dirname(target))
    if status and not os.access(target, os.W_OK):
        raise OSError(EACCES, os.strerror(EACCES))
    return True


def _require_folder(folder: str) -> None:
    """Fail if a folder cannot be written to or made."""
    while not os.path.lexists(folder) and os.path.dirname(folder) != folder:
        folder = os.path.dirname(folder)
    if not os.path.isdir(folder):
        raise OSError(ENOTDIR, os.strerror(ENOTDIR))
    if not os.access(folder, os.W_OK):
        raise OSError(EACCES, os.strerror(EACCES))


def _is_standard(status: os.stat_result) -> bool:
    """Whether a file is standard output by another name, such as /dev/stdout: it goes on where that stands."""
    with suppress(OSError):
        return sys.stdout is not None and os.path.samestat(status, os.fstat(1))
    return False


def _unwritable(path: str | None, error: OSError | ValueError) -> Refused:
    """The refusal of an output that cannot be written."""
    why = getattr(error, "strerror", None) or str(error)
    if path in (None, STANDARD):
        hush()
        return Refused("standard output", f"cannot be written ({why})", "an open one with room, or a file")
    if getattr(error, "errno", None) == EEXIST:
        return Refused(f"{path}: output", "it is there already", "another name, or remove it first")
    return Refused(f"{path}: output", f"cannot be written ({why})", "name a file in a folder that can be written to")
