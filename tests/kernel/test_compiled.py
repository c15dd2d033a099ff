"""Machine code is kept in the user's cache folder, whole or not at all, and never missed where it cannot be."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from graphplan.errors import Refused
from graphplan.kernel.tape.machine import LANES, Machine
from graphplan.kernel.tape.record import Symbols

pytest.importorskip("numba")

from graphplan.kernel.tape import compiled


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A cache folder of its own, and nothing compiled yet."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    compiled.compile_c.cache_clear()
    yield tmp_path / "graphplan" / "tapes"
    compiled.compile_c.cache_clear()


def tripled(add: float = 0.0) -> bool:
    """Whether machine code, compiled anew in this process, gives 3 x + add, over an odd number of poses."""
    compiled.compile_c.cache_clear()
    tape = Symbols().tape
    x = tape.input("x")
    numbers, found = np.arange(2.0 * LANES + 1), np.empty(2 * LANES + 1)
    left = Machine(tape, [x.place], [(3 * x + add).place]).run([numbers], [found])
    return left.size == 0 and np.array_equal(found, 3 * numbers + add)


def test_code_is_kept_and_found_again(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The first time a file is written, the second time it is read and nothing is compiled."""
    assert tripled()
    (file,) = cache.iterdir()
    monkeypatch.setattr(compiled, "_keep", lambda *_: pytest.fail("compiled again"))
    assert tripled()
    assert list(cache.iterdir()) == [file]


@pytest.mark.parametrize("content", [b"", b"short", bytes(4000)])
def test_a_broken_file_is_written_anew(content: bytes, cache: Path) -> None:
    """A file that is cut off or damaged is not run."""
    assert tripled()
    (file,) = cache.iterdir()
    whole = file.read_bytes()
    file.write_bytes(content or whole[:-1])
    assert tripled()
    assert file.read_bytes() == whole


@pytest.mark.parametrize("home", ["a file", "relative"])
def test_without_a_folder_nothing_is_kept(home: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where no folder can be made, and nobody is at home, the code serves all the same."""
    (tmp_path / "file").touch()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file") if home == "a file" else "")
    monkeypatch.setattr(compiled.os.path, "expanduser", lambda path: path)
    assert tripled()
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_old_files_go(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No more files are kept than are told."""
    monkeypatch.setattr(compiled, "KEPT", 2)
    assert all(tripled(add) for add in (1.0, 2.0, 3.0))
    assert len(list(cache.iterdir())) == 2


def test_numba_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without numba machine code is refused, with what to install."""
    monkeypatch.setitem(sys.modules, "numba", None)
    with pytest.raises(Refused, match=r"graphplan\[numba\]"):
        Machine(Symbols().tape, [], [])


@pytest.mark.parametrize("n", [1, LANES - 1, LANES, LANES + 1, 3 * LANES + 2])
def test_any_number_of_poses(n: int, cache: Path) -> None:
    """Parts of complex arrays, single arrays and every other pose of one are read and written where they stand."""
    tape = Symbols().tape
    x, y, t = (tape.input(name) for name in "xyt")
    reading = Machine(tape, [x.place, y.place, t.place], [(x * t).place, (y * t).place, (x - y).place])
    random = np.random.default_rng(n)
    z, numbers = random.normal(size=n) + 1j * random.normal(size=n), random.normal(size=2 * n)[::2]
    found, other = np.empty(n, complex), np.empty(2 * n)[::2]
    assert reading.run([z.real, z.imag, numbers], [found.real, found.imag, other]).size == 0
    assert np.array_equal(found, z.real * numbers + 1j * (z.imag * numbers))
    assert np.array_equal(other, z.real - z.imag)
