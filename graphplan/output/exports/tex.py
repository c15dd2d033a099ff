"""Letters in the mathematics of TeX, as GCLC and LaTeX set them, and words as LaTeX takes them."""

from __future__ import annotations

from graphplan.sheet.lettering.lettering import GREEK, Run, Runs

SIGNS = {sign: rf"\{name} " for name, sign in GREEK.items() if name != "upsilon"} | {"′": "'", "″": "''"}
SPECIAL = {char: rf"\{char}" for char in "&%$#_{}"} | {"~": r"\textasciitilde{}", "^": r"\textasciicircum{}",
                                                      "\\": r"\textbackslash{}"}  # fmt: skip


def formulated(runs: Runs) -> str:
    """Lettering as a formula: subscripts in braces, Greek letters by name."""
    return "".join(map(_run, runs))


def _run(run: Run) -> str:
    said = "".join(SIGNS.get(char, char) for char in run.text).strip()
    return f"_{{{said}}}" if run.level < 0 else said


def spelled(words: str) -> str:
    """Words with the characters escaped that LaTeX would take for commands."""
    return "".join(SPECIAL.get(char, char) for char in words)
