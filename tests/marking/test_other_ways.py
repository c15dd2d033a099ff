"""Right drawings by other ways than the sheet's: whatever is valid is judged right, and earns what was asked for."""

from __future__ import annotations

import cmath
import json
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pytest

import graphplan as gp
from graphplan.commands import main
from graphplan.kernel.kinds import POINT, Movement
from graphplan.kernel.numbers import Floats
from graphplan.kernel.program import evaluate
from graphplan.sheet.layout.composition import Composition, compose

WATT = """
title = "Watt's six-bar linkage"
[points]
O = [0, 0]
A = [30, 55]
B = [150, 95]
C = [180, 0]
D = [205, 108]
E = [300, 140]
F = [330, 10]
[links]
1 = "O A"
2 = "A B"
3 = "B C D"
4 = "D E"
5 = "E F"
frame = "O C F"
[[drive]]
link = "1"
omega = 5.0
alpha = 12.0
"""
Marks = Mapping[str, complex]  # where the letters are, mm, y upward
Table = list[tuple[str, complex, str]]  # mark, place, plan
MECHANISM, N_PLAN = "mechanism", "N-plan"


@dataclass(frozen=True)
class Drawn:
    """A construction on its sheet, as a student who knows its letters has drawn it."""

    composition: Composition

    @property
    def table(self) -> Table:
        """Every point, by its letter, or where it has none by the number of its step."""
        drawn = self.composition.plates.steps
        return [(one.name or str(one.number), complex(*one.spot), str(one.panel)) for one in drawn if one.kind == POINT]

    @property
    def letters(self) -> Table:
        """The points that bear letters."""
        return [row for row in self.table if not row[0].isdigit()]

    @property
    def joints(self) -> Marks:
        return {name: at for name, at, plan in self.letters if not name.startswith("v_") and plan == MECHANISM}

    @property
    def velocities(self) -> dict[str, complex]:
        """True velocities of the joints, as long as they are on the sheet."""
        ends, at = {name: z for name, z, _ in self.letters}, self.joints
        found = {name: v for name, v in self.composition.plans.drawing.velocity.items() if v and name in at}
        scale = next(abs(ends[f"v_{name.lower()}"] - at[name]) / abs(v) for name, v in found.items()
                     if f"v_{name.lower()}" in ends)
        return {name: scale * v for name, v in found.items()}

    @property
    def unlettered(self) -> Table:
        """The ends of velocities that have no letters of their own, as they fall on other marks of the sheet."""
        ends, at = {name: z for name, z, _ in self.letters}, self.joints
        found = {name: v for name, v in self.composition.plans.drawing.velocity.items() if v and name in at}
        turn = next((ends[f"v_{name.lower()}"] - at[name]) / v for name, v in found.items()
                    if f"v_{name.lower()}" in ends)
        return [(f"v_{name.lower()}", at[name] + turn * v, MECHANISM) for name, v in found.items()
                if f"v_{name.lower()}" not in ends]


@cache
def drawn(scene: str, **how: str) -> Drawn:
    return Drawn(compose(gp.construct(gp.load(scene), **how)))


def given(drawing: Drawn) -> Table:
    """The points of the pose alone."""
    return [row for row in drawing.table if row[0] in drawing.composition.plans.drawing.scene.points]


def stretched(factor: complex, whole: Callable[[Drawn], Table] = lambda drawing: [*drawing.letters, *drawing.unlettered]
              ) -> Callable[[Drawn], Table]:
    """Velocities so many times as long as on the sheet, or turned; accelerations as their squares."""
    def rows(drawing: Drawn) -> Table:
        at, first = drawing.joints, next((z for _, z, plan in drawing.table if plan == N_PLAN), 0j)
        found = []
        for name, z, plan in whole(drawing):
            joint = next((one for one in at if f"v_{one.lower()}" == name), None)
            if joint:
                z = at[joint] + factor * (z - at[joint])
            found.append((name, first + abs(factor) ** 2 * (z - first) if plan == N_PLAN else z, plan))
        return found
    return rows


def true_vectors(factor: float) -> Callable[[Drawn], Table]:
    """Velocities laid off at the joints as they are, not turned."""
    def rows(drawing: Drawn) -> Table:
        at = drawing.joints
        return [*given(drawing), *((f"v_{name.lower()}", at[name] + factor * v, MECHANISM)
                                   for name, v in drawing.velocities.items())]
    return rows


def finals(drawing: Drawn) -> Table:
    """What is given, where the plans begin, and the ends of vectors."""
    ends = re.compile(r"v_\w+|\w+_1")
    begun = {plan: name for name, _, plan in reversed(drawing.letters)}
    return [row for row in drawing.letters if ends.fullmatch(row[0]) or begun[row[2]] == row[0]
            or row in given(drawing) or (row[2] == N_PLAN and len(row[0]) == 1)]


def polar(factor: float, place: complex = 0j) -> Callable[[Drawn], Table]:
    """A plan of velocities from a pole, of its own scale and at its own place."""
    def rows(drawing: Drawn) -> Table:
        pole = 100 + 50j + place
        return [*given(drawing), ("p", pole, "velocity plan"),
                *((name.lower(), pole + factor * v, "velocity plan") for name, v in drawing.velocities.items())]
    return rows


def plan_moved(change: Callable[[complex], complex], plan: str = N_PLAN) -> Callable[[Drawn], Table]:
    """All of a plan elsewhere, turned or in another size."""
    return lambda drawing: [(name, change(at) if on == plan else at, on) for name, at, on in drawing.table]


def sheet_moved(change: Callable[[complex], complex]) -> Callable[[Drawn], Table]:
    """All that is drawn, in other coordinates of the paper."""
    return lambda drawing: [(name, change(at), plan) for name, at, plan in drawing.table]


def trial(ratio: float) -> Callable[[Drawn], Table]:
    """The same construction begun with another trial length."""
    def rows(drawing: Drawn) -> Table:
        program, found = drawing.composition.plans.drawing.drawn, []
        picked = {step.index: {"ratio": ratio * float(step.params["ratio"])} for step in program.steps
                  if step.op.movement is Movement.PICKED}
        for one, value in zip(drawing.composition.plates.steps, evaluate(program, Floats(), picked), strict=True):
            if one.kind == POINT and one.name:
                found.append((one.name, complex(*one.view((float(value[0]), float(value[1])))), str(one.panel)))
        assert picked
        return found
    return rows


@dataclass(frozen=True)
class Way:
    """A scene, how a student draws it, and, where only that is asked for, what; `how` chooses their construction, and
    `plan` is the one that the task asks for."""

    scene: str
    table: Callable[[Drawn], Table]
    how: Mapping[str, str] | None = None
    asked: str = ""
    plan: str = ""


ONLY_VELOCITIES = "velocity"
ORTHOGONAL = {"plan": "orthogonal"}
WAYS = {
    "velocities half as long": Way("four-bar", stretched(0.5)),
    "velocities 0.8 times as long": Way("slider-crank", stretched(0.8), ORTHOGONAL, plan="orthogonal"),
    "velocities 1.6 times as long": Way("watt", stretched(1.6)),
    "turned the other way": Way("four-bar", stretched(-1)),
    "turned the other way, and shorter": Way("watt", stretched(-0.7)),
    "true vectors at the joints": Way("four-bar", true_vectors(1), asked=ONLY_VELOCITIES),
    "true vectors at the joints, longer": Way("slider-crank", true_vectors(1.3), ORTHOGONAL,
                                              ONLY_VELOCITIES, "orthogonal"),
    "final vectors alone": Way("four-bar", finals),
    "final vectors alone of six links": Way("watt", finals),
    "polar plan of its own scale and place": Way("four-bar", polar(1.4, 80 - 20j), asked=ONLY_VELOCITIES),
    "polar plan of a slider-crank": Way("slider-crank", polar(0.6), ORTHOGONAL, asked=ONLY_VELOCITIES),
    "polar plan of six links": Way("watt", polar(1.2, -60 + 10j), asked=ONLY_VELOCITIES),
    "polar plans of both": Way("four-bar", lambda drawing: drawing.letters, {"plan": "polar"}),
    "polar plans of both, of a slider-crank": Way("slider-crank", lambda drawing: drawing.letters, {"plan": "polar"}),
    "another order": Way("watt", lambda drawing: drawing.table[::-1]),
    "trial figures for auxiliary points": Way("triad", lambda drawing: drawing.letters, {"method": "trial"}),
    "another trial length": Way("triad", trial(1.5), {"method": "trial"}),
    "instant centres": Way("ozols-5-1", lambda drawing: drawing.letters, {"method": "poles"}),
    "N-plan elsewhere": Way("four-bar", plan_moved(lambda z: z + 60 - 45j)),
    "larger N-plan": Way("slider-crank", plan_moved(lambda z: 1.5 * z - 40), ORTHOGONAL, plan="orthogonal"),
    "paper measured downward": Way("watt", sheet_moved(lambda z: z.conjugate() + 200j)),
    "another size, turned": Way("watt", sheet_moved(lambda z: 1.25 * cmath.exp(0.6j) * z + 30)),
}


def rows(table: Table) -> str:
    """The table as a file, read with a ruler of a tenth of a millimetre."""
    lines = [f'{name},{at.real:.1f},{at.imag:.1f},"{plan}",0.1' for name, at, plan in table]
    return "\n".join(["mark,x,y,panel,precision", *lines]) + "\n"


def scene_file(way: Way, folder: Path) -> str:
    """The scene as a file, or a packaged one's name; of some, velocities alone are asked for."""
    if way.scene != "watt" and not way.asked:
        return way.scene
    whole = WATT if way.scene == "watt" else Path(gp.__file__).with_name("scenes").joinpath(
        f"{way.scene}.toml").read_text()
    if way.asked:
        moving = ", ".join(f'"{name}"' for name in drawn_names(whole, folder))
        whole = re.sub(r"(?s)\[find\].*?(?=\n\[|\Z)", "", whole)
        whole += f"\n[find]\nvelocity = [{moving}]\n"
    path = folder / f"{way.scene}.toml"
    path.write_text(whole)
    return str(path)


def drawn_names(whole: str, folder: Path) -> list[str]:
    """The points whose velocities are asked for."""
    path = folder / "asked.toml"
    path.write_text(whole)
    return list(gp.construct(gp.load(str(path))).velocity)


@pytest.mark.parametrize("case", WAYS)
def test_other_ways_are_right(case: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """No step is wrong, and what was asked for has earned at least 90 of 100."""
    way = WAYS[case]
    scene, path = scene_file(way, tmp_path), tmp_path / f"{re.sub(r'[^a-z0-9]+', '-', case.lower())}.csv"
    path.write_text(rows(way.table(drawn(scene, **way.how or {}))))
    plan = ["--plan", way.plan] if way.plan else []
    assert main(["verify", scene, str(path), "--json", "-q", *plan]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["first_wrong"] is None
    assert found["score"]["total"] >= 90


@pytest.mark.parametrize("scene", ["four-bar", "slider-crank"])
def test_results_alone_are_right(scene: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """All numbers that were asked for, read to four digits, without a drawing."""
    assert main(["solve", scene]) == 0
    solved, path = json.loads(capsys.readouterr().out), tmp_path / "results.csv"
    told = [f"{kind},{name},{vector[0]:.4g},{vector[1]:.4g},," for name, point in solved["points"].items()
            for kind, vector in point.items() if any(vector)]
    told += [f"{kind},{name},,,{value:.4g}," for name, link in solved["links"].items()
             for kind, value in link.items()]
    told += [f"slide {kind},{name},{vector[0]:.4g},{vector[1]:.4g},,"
             for name, slide in solved.get("slides", {}).items() for kind, vector in slide.items()]
    path.write_text("\n".join(["quantity,of,x,y,value,unit", *told]) + "\n")
    assert main(["verify", scene, str(path), "--json", "-q"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["first_wrong"] is None
    assert found["score"]["total"] >= 90
