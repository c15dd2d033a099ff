"""GeoGebra 4.0 itself, on a screen that nobody sees, where it is installed."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path
from typing import Any, Self

import pytest

DRIVER = Path(__file__).parent / "GeoGebraDriver.java"
JARS = (Path("/usr/share/geogebra/geogebra.jar"), Path("/usr/share/java/geogebra.jar"))
NEEDS = "needs GeoGebra 4.0, a JDK and Xvfb: apt install geogebra default-jdk-headless xvfb"


class GeoGebra:
    """A running GeoGebra, which answers commands."""

    def __init__(self, folder: Path):
        jar = next((jar for jar in JARS if jar.is_file()), None)
        if jar is None or not all(map(shutil.which, ("java", "javac", "Xvfb"))):
            pytest.skip(NEEDS)
        path = os.pathsep.join([str(jar), str(jar.parent.parent / "java" / "*"), str(folder)])
        subprocess.run(["javac", "-cp", path, "-d", str(folder), str(DRIVER)], check=True, capture_output=True)
        read, write = os.pipe()
        self.screen = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1500x1100x24"],
                                       pass_fds=(write,), stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as told:
            display = told.readline().strip()
        self.program = subprocess.Popen(
            ["java", "-cp", path, "GeoGebraDriver"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
            stderr=subprocess.DEVNULL, env={**os.environ, "DISPLAY": f":{display}"}, encoding="utf-8")

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: Any) -> None:
        for one in (self.program, self.screen):
            one.terminate()
            one.wait()

    def tell(self, *parts: object) -> str:
        """The answer to a command."""
        assert self.program.stdin
        assert self.program.stdout
        self.program.stdin.write("\t".join(map(str, parts)) + "\n")
        self.program.stdin.flush()
        found = self.program.stdout.readline().rstrip("\n")
        assert not found.startswith("error"), found
        return found

    def open(self, file: Path, packed: bytes) -> None:
        file.write_bytes(packed)
        assert self.tell("open", file) == "true"

    def values(self) -> dict[str, complex]:
        """Where points and vectors are, and numbers, by label; nan where they are not defined."""
        parts = self.tell("all").split("\t")
        told = {label: text.split()[1:] for label, text in zip(parts[::2], parts[1::2], strict=False)}
        return {label: complex(float(x), float(y)) for label, (x, y) in told.items()}

    def seen(self) -> set[str]:
        """The labels of what is shown."""
        parts = self.tell("all").split("\t")
        return {label for label, text in zip(parts[::2], parts[1::2], strict=False) if text.startswith("seen")}
