"""Scenes spoilt by chance: whatever a scene says, a command ends with a status and one line for each fault."""

from __future__ import annotations

from pathlib import Path
from random import Random

import pytest
from fuzzing import complaint, scenes, spoilt

QUICK = (  # tried with each scene in turn
    ["solve", "-"], ["check", "-"], ["solve", "-", "--exact"], ["steps", "-"], ["solve", "-", "--method", "trial"],
    ["check", "-", "--plan", "polar"], ["solve", "-", "--digits", "12"],
    ["check", "-", "--json", "--set", "sheet.inertia=points"],
    ["solve", "-", "--method", "poles", "--plan", "polar"], ["check", "-", "--exact", "--set", "sheet.inertia=shifted"],
)
SLOW = (  # tried now and then
    ["draw", "-", "-o", "sheet.svg"], ["draw", "-", "--strict"], ["cycle", "-", "--positions", "6"],
    ["draw", "-", "--plan", "polar", "-o", "sheet.dxf"], ["export", "-", "-o", "figure.tex"],
    ["export", "-", "-o", "figure.ggb"], ["handout", "-", "-o", "page.html", "--positions", "2"],
    ["steps", "-", "--prefer", "quick"], ["draw", "-", "--steps", "2-5", "-o", "part.pdf"],
    ["cycle", "-", "--positions", "12", "--plot", "plot.svg"], ["handout", "-", "-o", "task.pdf", "--only", "guided"],
)
PARTS, TRIES, RARE = 10, 200, 6  # one scene in so many goes through a slow command


@pytest.mark.parametrize("part", range(PARTS))
def test_spoilt_scenes(part: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No spoilt scene gives a traceback, a warning, or another status than 0 to 3."""
    monkeypatch.chdir(tmp_path)
    texts, found = scenes(), {}
    for seed in range(part, TRIES, PARTS):
        chance = Random(seed)
        text = spoilt(chance.choice(texts), chance)
        words = chance.choice(SLOW) if chance.randrange(RARE) == 0 else chance.choice(QUICK)
        if wrong := complaint(words, text):
            found[seed] = f"{' '.join(words)}: {wrong}\n{text}"
    assert not found, "\n\n".join(f"--- {seed}: {told}" for seed, told in found.items())
