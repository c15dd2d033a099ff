"""Tables that `cycle` writes, in every kind of file, and its diagrams in other languages."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from face import ran


@pytest.mark.parametrize("scene", ["class-four-loaded", "stephenson"])
def test_an_archive_of_arrays_has_what_json_has(scene: str, tmp_path: Path) -> None:
    """Travel, points and every result are arrays by their names, and so are the poses that have none, with reasons."""
    for ending in ("npz", "json"):
        assert ran("cycle", scene, "--positions", "36", "-o", tmp_path / f"turn.{ending}").status == 0
    data = json.loads((tmp_path / "turn.json").read_text(encoding="utf-8"))
    with np.load(tmp_path / "turn.npz", allow_pickle=False) as arrays:
        assert np.degrees(arrays["travel"]) == pytest.approx(np.array(data["travel"]))
        for kind in ("velocity", "acceleration", "omega", "reaction", "balance moment"):
            for name, rows in data.get(kind, {}).items():
                right = np.array([[np.nan, np.nan] if row is None else row for row in rows], float) if isinstance(
                    next(row for row in rows if row is not None), list) else np.array(rows, float)
                found = arrays[f"{kind} {name}"]
                found = np.column_stack([found.real, found.imag]) if np.iscomplexobj(found) else found
                assert found == pytest.approx(right, nan_ok=True), (kind, name)
        faults = arrays["fault_pose"]
        first = next(iter(data["velocity"]))
        assert np.array_equal(np.flatnonzero(np.isnan(arrays[f"velocity {first}"])), faults)
        assert len(arrays["fault_why"]) == len(faults) > 0


def test_a_table_is_the_same_by_several_processes(tmp_path: Path) -> None:
    """However many share the work, each byte of it is the same."""
    for workers in ("1", "2"):
        assert ran("cycle", "stephenson", "--positions", "200", "--workers", workers, "-o",
                   tmp_path / f"{workers}.csv").status == 0
    assert (tmp_path / "1.csv").read_bytes() == (tmp_path / "2.csv").read_bytes()


def test_the_plot_speaks_the_language(tmp_path: Path) -> None:
    """Names, heads and the key of the diagrams come in the language asked for."""
    file = tmp_path / "plot.svg"
    options = "--positions", "24", "--plot", file, "--set", "sheet.language=de"
    assert ran("cycle", "slider-crank", *options).status == 0
    words = re.sub(r"\s+", " ", re.sub(r"<[^>]*>", "", file.read_text(encoding="utf-8")))
    assert all(word in words for word in ("Schubgelenk 3 auf Gestell", "Stellung", "aus den Plänen", "durch Sehnen"))
    assert not re.search(r"\b(slide|position|drive|order|chords|plans|per mm)\b", words)
