"""graphplan as its users meet it: the command line in this process, and all that a scene gives."""

from __future__ import annotations

import io
import json
import sys
from functools import cache, cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, NamedTuple
from unittest import mock

from inked_sheet import InkedSheet

import graphplan as gp
from graphplan.commands import main


class Ran(NamedTuple):
    """The exit status of a command, its standard output and its standard error."""

    status: int
    out: str
    err: str

    @property
    def json(self) -> Any:
        """Its standard output, read as JSON."""
        assert self.status in (0, 1), self.err
        return json.loads(self.out)


def ran(*arguments: str | Path, given: str = "") -> Ran:
    """Runs the command line; `given` stands on standard input."""
    streams = {"stdout": _stream(), "stderr": _stream()}
    with mock.patch.multiple(sys, stdin=_stream(given), **streams):
        try:
            status = main([*map(str, arguments)])
        except SystemExit as end:
            status = int(end.code or 0)
    out, err = (stream.buffer.getvalue().decode() for stream in streams.values())
    return Ran(status, out, err)


def _stream(text: str = "") -> io.TextIOWrapper:
    return io.TextIOWrapper(io.BytesIO(text.encode()), encoding="utf-8", write_through=True)


class Got:
    """Data, sheet, protocol and files of a scene, by its name or path, each made when it is first asked for."""

    def __init__(self, name: str | Path):
        self.name = str(name)
        self._made: dict[tuple[str, ...], Any] = {}

    def __repr__(self) -> str:
        return self.name

    def printed(self, command: str, *options: str) -> str:
        """The standard output of a command on the scene."""
        if (key := (command, *options)) not in self._made:
            done = ran(command, self.name, *options)
            assert done.status == 0, done.err
            self._made[key] = done.out
        return str(self._made[key])

    def data(self, command: str, *options: str) -> Any:
        """The JSON that a command prints."""
        if (key := ("json", command, *options)) not in self._made:
            self._made[key] = json.loads(self.printed(command, *options))
        return self._made[key]

    def files(self, ending: str, command: str = "draw", *options: str) -> list[bytes]:
        """The files that a command writes, in the order of their pages."""
        if (key := ("files", ending, command, *options)) not in self._made:
            with TemporaryDirectory() as folder:
                done = ran(command, self.name, "-o", f"{folder}/file.{ending}", *options)
                assert done.status == 0, done.err
                written = sorted(Path(folder).iterdir(), key=lambda path: (len(path.name), path.name))
                self._made[key] = [path.read_bytes() for path in written]
        return list(self._made[key])

    def file(self, ending: str, command: str = "draw", *options: str) -> bytes:
        """The file that a command writes, or its first page."""
        return self.files(ending, command, *options)[0]

    def sheets(self, *options: str) -> list[InkedSheet]:
        """The construction sheet as it is drawn with some options, and the pages of its words."""
        if (key := ("sheets", *options)) not in self._made:
            self._made[key] = [InkedSheet.of(page.decode()) for page in self.files("svg", "draw", *options)]
        return list(self._made[key])

    @cached_property
    def scene(self) -> gp.Scene:
        return gp.load(self.name)

    @cached_property
    def drawing(self) -> gp.WorkingDrawing:
        return gp.construct(self.scene)

    @property
    def solved(self) -> Any:
        """The results, by `solve`."""
        return self.data("solve")

    @property
    def steps(self) -> Any:
        """The construction as data, by `steps --json`."""
        return self.data("steps", "--json")

    @property
    def protocol(self) -> str:
        """The construction in words."""
        return self.printed("steps")

    @property
    def svg(self) -> str:
        """The construction sheet, as SVG."""
        return self.file("svg").decode()

    @property
    def sheet(self) -> InkedSheet:
        """The construction sheet, as its SVG has it."""
        return self.sheets()[0]


@cache
def got(name: str) -> Got:
    """Data, sheet, protocol and files of a packaged scene, made once in a process."""
    return Got(name)


@cache
def names(kind: str = "scenes") -> tuple[str, ...]:
    """The packaged scenes, or tasks of synthesis, as `graphplan list` has them."""
    return tuple(row["name"] for row in ran("list", kind, "--json").json)
