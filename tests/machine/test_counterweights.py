"""Counterweights: textbook values, what can be balanced and what cannot, verified over the cycle."""

from __future__ import annotations

import cmath
import json
from pathlib import Path

import numpy as np
import pytest
from linkages_with_masses import four_bar, scene, slider_crank

from graphplan.check.balance import balancing, mass_motion
from graphplan.commands import main
from graphplan.errors import Refused
from graphplan.machine.linkages.counterweights import add_counterweights, balance_along_guide, balance_fully
from graphplan.mechanism.model import Scene
from graphplan.mechanism.scene import load
from graphplan.output.subjects.balance_numbers import links, variant

FOUR_BAR = [(2, 0.06, 0), (3, 0.15, 0), (4, 0.12, 0)]
ENGINE = [(2, 0.06, 0), (3, 0.15, 0), (4, 0, 0)]
FAR = {"1": 1e9, "2": 1e9}  # counterweights that far off have no mass, as the book has it


def s_of(found: Scene) -> list[float]:
    """Where the mass centres are along their links."""
    return [link["s"] for link in links(mass_motion(found, 4)).values() if "s" in link]


def test_full_balance_of_a_four_bar() -> None:
    """Ozols (16.10), in numbers: with s_2 = 0.15 s_1 = -0.0857143 and s_3 = 0.3964286 m, S at x = 0.2349206 m."""
    given = four_bar(FOUR_BAR)
    found = add_counterweights(given, balance_fully(given, ["2"], {"1": 1e9, "3": 1e9}))
    assert s_of(found) == pytest.approx([-0.0857143, 0.15, 0.3964286], abs=5e-8)
    path = mass_motion(found, 36).path
    assert np.abs(path - 0.2349206).max() < 5e-8
    assert np.abs(path - path[0]).max() < 1e-15


def test_full_balance_of_a_slider_crank() -> None:
    """Ozols (16.11), in numbers: s_1 = -0.35, s_2 = -0.53333 m, with an offset of the guide, too."""
    given = slider_crank(ENGINE)
    assert s_of(add_counterweights(given, balance_fully(given, radii=FAR))) == pytest.approx([-0.35, -0.533333],
                                                                                             abs=5e-7)


def test_partial_balance_of_a_slider_crank() -> None:
    """Ozols (16.12), in numbers: with s_2 = 0.15 s_1 = -0.09375 m, and S moves along the guide alone, by 0.1139 m where
    the guide passes the crank's hinge."""
    for offset in (0.03, 0.0):
        given = slider_crank(ENGINE, 0.0, offset=offset)
        found = add_counterweights(given, balance_along_guide(given, ["2"], {"1": 1e9}))
        assert s_of(found) == pytest.approx([-0.09375, 0.15], abs=5e-7)
        path = mass_motion(found, 12).path
        assert np.ptp(path.imag) < 1e-15
    assert np.ptp(path.real) == pytest.approx(0.1139, abs=5e-5)


@pytest.mark.parametrize(("masses", "kept", "wanted"), [
    ([(2, 0.03, 0), (3, 0.15, 0), (4, 0.12, 0)], ["1"], "a"), ([(2, 0.13, 0), (3, 0.15, 0), (4, 0.12, 0)], ["1"], "b"),
    (FOUR_BAR, ["2"], "c"), (FOUR_BAR, ["3"], "d"), ([(2, 0.06, 0), (3, 0.15, 0), (4, -0.1, 0)], ["3"], "e")])
def test_variants(masses: list[tuple[float, float, float]], kept: list[str], wanted: str) -> None:
    """Table 16-1 has all that can be: which variant it becomes hangs on the link that keeps its masses."""
    given = four_bar(masses)
    found = mass_motion(add_counterweights(given, balance_fully(given, kept)), 12)
    assert variant(found) == wanted
    (m_1, s_1, l_1), (m_2, s_2, l_2), (m_3, s_3, l_3) = (
        (link["mass"], link["s"], link["length"]) for link in links(found).values())
    assert m_1 * s_1 == pytest.approx(m_2 * l_1 * (s_2 / l_2 - 1))  # (16.10)
    assert m_2 * s_2 == pytest.approx(m_3 * l_2 * (s_3 / l_3 - 1))
    assert np.abs(found.path - found.path[0]).max() < 1e-14


def six_bar(seed: int) -> Scene:
    """A Watt linkage of two four-bars in a row, or a Stephenson one, with masses anywhere."""
    rng = np.random.default_rng(seed)
    places = {"O": 0j, "D": 0.4 + 0j, "A": cmath.rect(0.1, 0.7), "B": 0.35 + 0.3j, "C": 0.55 + 0.25j, "E": 0.8 + 0.4j,
              "F": 0.9 + 0j}
    places |= {f"S{k}": complex(*rng.uniform(-0.2, 0.6, 2)) for k in range(1, 6)}
    third = "2" if seed % 2 else "3"
    bodies = {"1": "O A S1", "2": "A B S2", "3": "B D S3", "4": "C E S4", "5": "E F S5", "frame": "O D F"}
    bodies[third] += " C"
    return scene(places, bodies, [(float(m), 0, 0) for m in rng.uniform(1, 5, 5)], "")


@pytest.mark.parametrize("seed", range(6))
def test_linkages_of_joints_can_be_balanced(seed: int) -> None:
    """Linkages of revolute pairs alone are fully balanced by half as many counterweights as they have links."""
    given = six_bar(seed)
    found = balancing(given, 24, "full")
    assert len(found.weights) == 3
    assert found.after is not None
    force = np.abs(found.after.shaking.force[np.isfinite(found.after.path)]).max()
    assert force < 1e-12 * max(np.abs(part).max() for part in found.after.shaking.parts.values())


@pytest.mark.parametrize(("name", "options", "why"), [
    ("shaper", {}, "what slides with it cannot be balanced"),
    ("four", {"keep": ["1", "2"]}, "cannot be balanced by counterweights on 3"),
    ("four", {"way": "partial"}, "no slide is guided on the frame"),
    ("four", {"way": "share"}, "not a slider-crank"),
    ("four", {"keep": ["9"]}, "there is no moving link 9"),
    ("shaper", {"radii": {"3": 0.1}}, "link 3 does not turn"),
    ("four", {"keep": ["1"], "radii": {"2": 0.2}}, "would need ever larger counterweights"),
])
def test_what_cannot_be_balanced(name: str, options: dict[str, object], why: str) -> None:
    """What no counterweights can do is refused, with the reason."""
    given = sliding_yoke() if name == "shaper" else four_bar(FOUR_BAR)
    with pytest.raises(Refused, match=why):
        balancing(given, 4, **{"way": "full", **options})  # type: ignore[arg-type]


def sliding_yoke() -> Scene:
    """A scotch yoke, whose yoke hangs on no joint."""
    places = {"O": 0j, "A": 0.06 + 0.08j, "Y": 0.06 + 0j, "S1": 0j, "S2": 0.06 + 0.08j, "S3": 0.2 + 0j}
    slides = ('[[slides]]\nlink = "2"\nalong = "3"\nat = "A"\ndirection = [0, 1]\n'
              '[[slides]]\nlink = "3"\nalong = "frame"\nat = "Y"\ndirection = [1, 0]\n')
    return scene(places, {"1": "O A S1", "2": "A S2", "3": "Y S3", "frame": "O"}, [(2, 0, 0), (1, 0, 0), (5, 0, 0)],
                 slides)


def test_a_yoke_is_balanced_across_its_guide() -> None:
    """What slides along the guide does not count across it: then a counterweight on the crank will do."""
    found = balancing(sliding_yoke(), 24, "partial")
    assert found.after is not None
    assert [weight.link for weight in found.weights] == ["1"]
    assert np.ptp(found.after.path.imag) < 1e-15


def test_what_can_be_is_done_unasked() -> None:
    """Without a word a linkage is fully balanced if it can be; else the reason stands beside the numbers."""
    assert len(balancing(load("ozols-16-1"), 6).weights) == 2
    assert "cannot be balanced" in balancing(sliding_yoke(), 6).note


def test_command(tmp_path: Path) -> None:
    """JSON has the counterweights in kg m, with the masses that they have at the radii asked for."""
    file = tmp_path / "out.json"
    assert main(["balance", "ozols-16-1", "-q", "--positions", "6", "--radius", "1=50", "-o", str(file)]) == 0
    first, second = json.loads(file.read_text())["counterweights"]
    assert (first["link"], second["link"]) == ("1", "2")
    assert first["mass_radius"] == pytest.approx(first["mass"] * 0.05)
    assert second["mass_radius"] == pytest.approx(40 * 0.1 / 0.22 + 30 * 0.35 * 0.1 / 0.22 - 0, rel=1e-12)
    for options in (["--radius", "1=-3"], ["--radius", "50"], ["--share", "0.5"], ["--keep", "9"],
                    ["--counterweights", "share", "--share", "2"]):
        assert main(["balance", "ozols-16-1", "-q", "--positions", "6", *options]) == 2
