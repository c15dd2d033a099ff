"""Scales that a scene gives for its sheet, and the two ways in which scales are told."""

from __future__ import annotations

import re
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from inked_sheet import InkedSheet
from sheets import drawing_of, outside

import graphplan as gp
from graphplan.errors import Refused
from graphplan.kernel.program import Panel
from graphplan.methods.construction import Construction
from graphplan.sheet.layout.composition import compose
from graphplan.sheet.layout.layout import layout
from graphplan.sheet.layout.scales import Scales, round_up
from graphplan.sheet.lettering.lettering import plain
from graphplan.sheet.plates.display import Text
from graphplan.sheet.plates.pens import FORCES


def wishing(name: str, plan: str = "orthogonal", **wishes: Any) -> Construction:
    """The construction of a scene whose sheet has these wishes."""
    drawing = drawing_of(name, plan)
    return replace(drawing, scene=replace(drawing.scene, sheet=replace(drawing.scene.sheet, **wishes)))


def scales_of(name: str, plan: str = "orthogonal", paper: str | None = "A2", **wishes: Any) -> Scales:
    """The scales of a scene's sheet with these wishes."""
    return compose(wishing(name, plan, **wishes), paper).scales


def test_a_given_scale_holds() -> None:
    """The mechanism plan has the scale given, round or not, on any paper; the other plans' scales stay round."""
    for k_s in (Fraction(3), Fraction(22, 7)):
        for paper in ("A3", "A2", None):
            scales = scales_of("four-bar", paper=paper, k_s=k_s)
            assert scales.k_s == pytest.approx(float(k_s), rel=1e-12)
            k_a = scales.acceleration("N-plan")
            assert float(round_up(k_a)) == pytest.approx(k_a, rel=1e-12)


def test_a_scale_of_vectors_fixes_that_of_lengths() -> None:
    """A given scale of velocities, accelerations or forces is that of the plans that have such vectors."""
    assert scales_of("four-bar", k_v=Fraction(30)).speed("mechanism") == pytest.approx(30, rel=1e-12)
    assert scales_of("four-bar", "polar", k_v=Fraction(30)).speed("velocity plan") == pytest.approx(30, rel=1e-12)
    assert scales_of("four-bar", k_a=Fraction(300)).acceleration("N-plan") == pytest.approx(300, rel=1e-12)
    loaded = scales_of("jaanimets-10", k_F=Fraction(6), paper="A1")
    forced = [panel for panel in loaded.multiples if panel.startswith(("force plan", "lever"))]
    assert forced
    assert [loaded.force(panel) for panel in forced] == pytest.approx([6.0] * len(forced), rel=1e-12)


def test_given_multiples_hold() -> None:
    """A plan has the multiple that is given for it, also beside a given scale of its vectors."""
    assert scales_of("four-bar", multiples={"N-plan": Fraction(3, 4)}).multiples == {"N-plan": Fraction(3, 4)}
    both = scales_of("four-bar", k_a=Fraction(300), multiples={"N-plan": Fraction(1, 2)})
    assert both.acceleration("N-plan") == pytest.approx(600, rel=1e-12)


def test_scales_are_round_in_the_unit_of_the_scene() -> None:
    """In inches, too, the numbers of all scales are round: 16 in/s per mm, not the 15.75 of a plan drawn 1 : 10."""
    for unit, name in (("in", "four-bar"), ("ft", "rosenauer-basic")):
        scene = gp.load(name)
        scene = replace(scene, units=replace(scene.units, length=unit), sheet=replace(scene.sheet, paper="A3"))
        assert InkedSheet.of(gp.sheet.svg(gp.construct(scene))).odd_scales == []


@pytest.mark.parametrize("sheet", [{}, {"scale": "1 : 5"}, {"k_s": 0.2}], ids=["chosen", "given", "given in inches"])
def test_forces_in_inches_have_round_scales(sheet: dict[str, Any]) -> None:
    """Also where they are drawn on the mechanism plan, whose scale of lengths is round in mm or given."""
    crank = gp.scene({
        "units": {"length": "in", "force": "lbf"},
        "points": {"O": [0, 0], "A": [1, 2], "B": [9, 0]},
        "links": {"1": "O A", "2": "A B", "3": "B", "frame": "O"},
        "slides": [{"link": "3", "along": "frame", "at": "B", "direction": [1, 0]}],
        "drive": [{"link": "1", "omega": 10}], "forces": [{"on": "3", "at": "B", "value": [-30, 0]}],
        "balance": {"link": "1"}, "find": {"velocity": ["B"]}, "sheet": sheet,
    })  # fmt: skip
    composition = compose(gp.construct(crank))
    told = {float(f"{composition.scales.force(panel):.9g}") for panel in composition.views
            if composition.plans.kinds(panel) & FORCES}
    assert told
    assert {float(round_up(k_F)) for k_F in told} == told


@pytest.mark.parametrize("paper", ["A3", "A2"])
def test_a_scale_too_large_is_refused_with_the_largest_that_fits(paper: str) -> None:
    """The refusal names the paper and a scale; at that scale the sheet is drawn, and nothing leaves its frame."""
    with pytest.raises(Refused, match=f"the mechanism does not fit on {paper}; .*, or a larger sheet") as refusal:
        scales_of("four-bar", paper=paper, k_s=Fraction(1, 10))
    said = re.search(r"k_s = ([\d.]+)", refusal.value.do)
    assert said
    assert outside(layout(compose(wishing("four-bar", k_s=Fraction(said[1])), paper))) == []


def test_a_multiple_too_large_is_refused_with_the_largest_that_fits() -> None:
    """So is a plan that its multiple makes too large."""
    with pytest.raises(Refused, match="the N-plan ×50: it does not fit on A3") as refusal:
        scales_of("four-bar", paper="A3", k_s=Fraction(4), multiples={"N-plan": Fraction(50)})
    said = re.search(r"×([\d.]+) or less", refusal.value.do)
    assert said
    assert scales_of("four-bar", paper="A3", k_s=Fraction(4), multiples={"N-plan": Fraction(said[1])})


def test_scales_that_do_not_go_together_are_refused() -> None:
    """Two scales that the lengths of the construction tie otherwise are refused with the value that would fit."""
    drawn = float(Fraction(4) / Fraction(drawing_of("four-bar").kappa))
    with pytest.raises(Refused, match=rf"sheet.k_v = 7: .*; k_v = {drawn:g}, or leave one of them out"):
        scales_of("four-bar", k_s=Fraction(4), k_v=Fraction(7))
    with pytest.raises(Refused, match=r"sheet.k_F: the scene has no forces"):
        scales_of("four-bar", k_F=Fraction(4))
    with pytest.raises(Refused, match=r"sheet.multiples.force plan 9: unknown plan; choose one of force plan"):
        scales_of("jaanimets-10", multiples={"force plan 9": Fraction(4)})


def test_drawn_per_real_is_one_over_real_per_drawn() -> None:
    """Every scale of a loaded scene is told with its units, by one convention as the reciprocal of the other."""
    drawing = drawing_of("jaanimets-10")
    kinds = {"velocity", "acceleration", "load"}
    real = compose(drawing).scales
    drawn = replace(real, convention="drawn")
    for panel in ("mechanism", *real.multiples):
        for one, other in zip(real.scale_texts(panel, kinds), drawn.scale_texts(panel, kinds), strict=True):
            values = [float(re.findall(r"= (\S+) ", told)[0].replace("·10", "e")) for told in (one, other)]
            assert values[0] * values[1] == pytest.approx(1, rel=1e-3)
            assert other.startswith(one.replace("k_", "mu_", 1)[:5])
    assert drawn.scale_texts("mechanism", kinds)[:2] == [f"mu_s = {1 / real.k_s:g} mm/mm",
                                                         f"mu_v = {1 / real.speed('mechanism'):g} mm per mm/s"]


def test_captions_title_block_and_description_follow_the_convention() -> None:
    """A sheet that tells drawn per real has no scale by the other letter anywhere."""
    sheet = layout(compose(wishing("four-bar", convention="drawn"), "A3"))
    told = " ".join([sheet.description, *(plain(item.runs) for item in sheet.items if isinstance(item, Text))])
    assert re.search(r"\bk_?[sva]\b", told) is None
    assert f"1 : {sheet.scales.k_s:g}; μs = {1 / sheet.scales.k_s:g} mm/mm" in told
    assert told.count("mm per mm/s²") == 2


def test_scales_are_told_in_the_language_of_the_scene(tmp_path: Path) -> None:
    """A scene that wishes German has its scales in German words."""
    wishes = '[sheet]\nlanguage = "de"\nconvention = "drawn"\n[points]'
    text = gp.load("jaanimets-10").text.replace("[points]", wishes, 1)
    path = tmp_path / "scene.toml"
    path.write_text(text)
    sheet = layout(compose(gp.construct(gp.load(path)), "A1"))
    assert sheet.language == "de"
    assert " mm je mm/s" in sheet.description


@pytest.mark.parametrize(("plan", "scales"), [("orthogonal", {"N-plan": "k_a"}),
                                              ("polar", {"velocity plan": "k_v", "acceleration plan": "k_a"})])
def test_a_plan_of_rates_has_its_scale_whatever_is_asked(plan: str, scales: dict[str, str]) -> None:
    """The N-plan and polar plans tell k_v and k_a where only a link's rates are asked for, and no arrow lies there."""
    scene = gp.load("four-bar")
    scene = replace(scene, find=replace(scene.find, velocity=(), acceleration=(), links=("3",)))
    composition = compose(gp.construct(scene, plan=plan))
    for panel, letter in scales.items():
        (told,) = composition.scales.scale_texts(Panel(panel), composition.plans.kinds(Panel(panel)))
        assert told.startswith(f"{letter} = ")
