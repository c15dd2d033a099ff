"""No result leaves unchecked: a rule of the kernel that is wrong is seen by every command, and by proof in a digit."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from decimal import Decimal, localcontext
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from face import ran

from graphplan.kernel import TABLE

DIGITS = Path(__file__).parents[1] / "cases" / "digits"
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899")
WRONG = [("jaanimets-10", op) for op in ("given", "line", "parallel", "perpendicular", "meet", "similar", "normal",
                                         "transfer", "lay_off", "balance", "couple")]
WRONG += [("alt-eight-link", "carry"), ("alt-eight-link", "settle"), ("class-four-loaded", "false_position"),
          ("class-four-loaded", "weigh"), ("ozols-5-3", "coriolis"), ("ozols-5-3", "lay_along"),
          ("kinytskyi", "touch"), ("kinytskyi", "inertia_pair")]


def sow(monkeypatch: pytest.MonkeyPatch, op: str, off: Fraction) -> None:
    """From here on the rule of an operation is off by so much of its first number."""
    rule = TABLE[op].rule

    def wrong(domain: Any, *values: Any, **params: Any) -> Any:
        first, *others = rule(domain, *values, **params)
        share = float(off) if isinstance(first, float) else off
        return first + (first + first * first) * share, *others  # no affine map: statics would not see it

    monkeypatch.setitem(TABLE, op, replace(TABLE[op], rule=wrong))


@pytest.mark.parametrize(("name", "op"), WRONG)
def test_a_rule_that_is_wrong_in_the_25th_digit_is_caught(name: str, op: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The enclosures of construction and solver part, and the command says so with status 1."""
    sow(monkeypatch, op, Fraction(1, 10**25))
    done = ran("solve", name, "--digits", "30")
    assert done.status == 1
    assert "disagree" in done.err


@pytest.mark.parametrize("line", [
    "solve four-bar -q", "check four-bar -q", "check four-bar --json", "steps four-bar", "draw four-bar -o out.svg",
    "export four-bar -o out.tex", "handout four-bar -o out.pdf", "live four-bar -o out.html",
    "report four-bar -o out.pdf",
    "cycle four-bar --positions 3 -o out.csv", "cost four-bar",
])
def test_a_disagreement_is_status_1_and_writes_nothing(line: str, tmp_path: Path,
                                                       monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever command shows a construction has compared it first; that it is wrong is no remark."""
    monkeypatch.chdir(tmp_path)
    sow(monkeypatch, "meet", Fraction(1, 10**6))
    done = ran(*line.split())
    assert done.status == 1
    assert "disagree" in done.err
    assert not list(tmp_path.iterdir())


# ---- digits ----------------------------------------------------------------------------------------------------------


def solved(scene: str | Path, digits: int) -> Any:
    """What `solve --digits` prints."""
    return ran("solve", scene, "--digits", digits).json


def test_sixty_digits_by_hand() -> None:
    """Compasses and rpm: a four-bar's rates are those worked out by hand, right to the last of 60 digits."""
    with localcontext() as context:
        context.prec = 90
        along = Decimal(16000 + 110**2 - 90**2) / 32000
        across = (Decimal(110**2) / 16000 - along**2).sqrt()
        ux, uy = 120 * along + 40 * across, 120 * across - 40 * along
        wx, wy, crank = ux - 120, uy + 40, 95 * PI / 30
        omega = crank * (30 * uy - 40 * ux) / (wx * uy - wy * ux)
        found = solved(DIGITS / "four-bar.toml", 60)
        told = [Decimal(x) for x in (found["links"]["3"]["omega"], *found["points"]["B"]["velocity"])]
        for ours, truth in zip(told, (omega, -wy * omega, wx * omega), strict=True):
            assert len(ours.as_tuple().digits) == 60
            assert abs(ours - truth) <= Decimal((0, (5, 1), ours.as_tuple().exponent - 2))


@pytest.mark.parametrize("direction", ["25", '"O A"'])
def test_directions_are_as_written(direction: str, tmp_path: Path) -> None:
    """An actuator along an angle, or towards a polar point, moves by the cosine and sine of the exact degrees."""
    text = (DIGITS / "actuator.toml").read_text(encoding="utf-8")
    (tmp_path / "a.toml").write_text(text.replace("direction = 25", f"direction = {direction}"), encoding="utf-8")
    with localcontext() as context:
        context.prec = 60
        c, s = (Decimal(text) / 3 for text in solved(tmp_path / "a.toml", 40)["points"]["A"]["velocity"])
        cosine_of_75 = (Decimal(6).sqrt() - Decimal(2).sqrt()) / 4
        assert abs(c * c + s * s - 1) < Decimal("1e-39")
        assert abs(4 * c**3 - 3 * c - cosine_of_75) < Decimal("1e-38")


def test_thousands_of_digits() -> None:
    """Ten thousand digits are no other matter than thirty."""
    velocity, thirty = (solved("ozols-5-5", digits)["points"]["B"]["velocity"][0] for digits in (10000, 30))
    assert len(Decimal(velocity).as_tuple().digits) == 10000
    assert velocity.startswith(thirty[:-1])


@pytest.mark.parametrize(("line", "library", "extra"), [
    ("solve four-bar --digits 30", "flint", "graphplan[certified]"),
    ("export four-bar -o a.dxf", "ezdxf", "ezdxf is not installed; pip install 'graphplan[dxf]'"),
])
def test_a_missing_library_is_named_with_its_extra(line: str, library: str, extra: str, tmp_path: Path) -> None:
    """Where a library is not installed, the one line says what installs it, and nothing is written."""
    code = (f"import runpy, sys\nsys.modules[{library!r}] = None\nsys.argv = ['graphplan', *{line.split()}]\n"
            "runpy.run_module('graphplan', run_name='__main__')")
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1), done.stderr
    assert extra in done.stderr
    assert not list(tmp_path.iterdir())
