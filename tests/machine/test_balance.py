"""Balanced linkages: mass centres, counterweights, engines and added dyads, as `graphplan balance` gives them."""

from __future__ import annotations

import cmath
import math
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from linkages_with_masses import four_bar, scene, slider_crank

import graphplan as gp

CASES = Path(__file__).parents[1] / "cases" / "machine" / "balance"
OFFSET = [(2, 0.06, 0.02), (3, 0.2, -0.03), (4, 0.12, 0.01)]
STRAIGHT = [(m, s, 0) for m, s, _ in OFFSET]
FOUR_BAR = [(2, 0.06, 0), (3, 0.15, 0), (4, 0.12, 0)]
ENGINE = [(2, 0.06, 0), (3, 0.15, 0), (4, 0, 0)]
FAR = {"1": 1e9, "2": 1e9}  # counterweights that far off have no mass, as the book has it
KGF = 9.81


def series(rows: list[list[float]]) -> Any:
    """Vectors over the cycle as complex numbers, from rows of travel, x and y."""
    return np.array([complex(*row[1:]) for row in rows])


def s_of(found: dict[str, Any]) -> list[float]:
    """Where the mass centres are along their links."""
    return [link["s"] for link in found["links"].values() if "s" in link]


# ---- the mass centre -------------------------------------------------------------------------------------------------


def test_principal_vectors_of_a_four_bar() -> None:
    """Ozols (16.8), (16.9), in numbers: h = 0.0911111, 0.2222222, 0.0533333 m; S where the offsets lead it."""
    found = gp.balance(four_bar(STRAIGHT), positions=3).json()["principal_vectors"].values()
    assert [vector["h"] for vector in found] == pytest.approx([0.0911111, 0.2222222, 0.0533333], abs=5e-8)
    assert [vector["offset"] for vector in found] == pytest.approx([0, 0, 0], abs=1e-15)
    aside = gp.balance(four_bar(OFFSET), positions=3).json()["mass_centre"]["path"]
    assert aside[0] == pytest.approx([0, 0.257904, 0.139965], abs=5e-7)


@pytest.mark.parametrize("linkage", [four_bar(OFFSET), slider_crank(OFFSET)], ids=["four-bar", "slider-crank"])
def test_the_mass_centre_over_the_cycle(linkage: gp.Scene) -> None:
    """The path is that of the masses' places, velocity and acceleration are its derivatives, and F = -m a."""
    found = gp.balance(linkage, positions=90).json()
    assert {"path", "velocity", "acceleration", "shaking force", "shaking moment"} <= {*found["check"]}
    assert max(found["check"].values()) < 1e-12
    path, velocity, acceleration = (series(found["mass_centre"][what]) for what in ("path", "velocity", "acceleration"))
    turn = gp.cycle.follow(linkage, 90)
    assert path == pytest.approx(sum(m * turn.points[f"S{k}"] for k, (m, _, _) in enumerate(OFFSET, 1)) / 9, abs=1e-14)
    waves = 1j * np.fft.fftfreq(90, 1 / 90) * 10  # of the first drive's 10 rad/s
    assert velocity == pytest.approx(np.fft.ifft(waves * np.fft.fft(path)), abs=1e-9)
    assert acceleration == pytest.approx(np.fft.ifft(waves**2 * np.fft.fft(path)), abs=1e-6)
    assert series(found["shaking_force"]) == pytest.approx(-9 * acceleration, abs=1e-11)


def test_travel_counts_as_the_drive_moves() -> None:
    """A crank that turns clockwise goes through the same poses the other way round, with the same forces."""
    there, back = (gp.balance(four_bar(OFFSET, omega=omega), positions=8).json() for omega in (10, -10))
    assert [row[0] for row in there["shaking_force"]] == [row[0] for row in back["shaking_force"]]
    for rows, other, near in ((there["mass_centre"]["path"], back["mass_centre"]["path"], 1e-15),
                              (there["shaking_force"], back["shaking_force"], 1e-11)):
        assert series(rows) == pytest.approx(np.roll(series(other)[::-1], 1), abs=near)


def test_open_chains_and_drives_at_rest() -> None:
    """Open chains with a drive in each joint are followed, too, and drives that stand still shake nothing."""
    assert max(gp.balance(CASES / "arm.toml", positions=12).json()["check"].values()) < 1e-12
    still = gp.balance(four_bar(OFFSET, omega=0), positions=12).json()
    assert max(still["check"].values()) < 1e-12
    assert np.abs(series(still["shaking_force"])).max() < 1e-12


@pytest.mark.parametrize("name", ["walschaerts-loaded", "jaanimets-10", "slotted-link", "wheel-on-rail", "geneva",
                                  "racks", "planetary", "plough-lift", "ozols-5-5", "gear-linkage"])
def test_masses_anywhere(name: str) -> None:
    """Linkages with slides, gears and contacts are followed with masses on all links, and balanced where they can be.
    """
    given, number = gp.load(name, by_drive=True), count(1)
    masses = {link: {"mass": next(number), "inertia": 0.01, "centre": given.links[link][-1]} for link in given.moving}
    found = gp.balance(given.replace("friction", []).replace("masses", masses), positions=4)
    data = found.json()
    assert max(data["check"].values()) < 1e-9
    assert data["counterweights"] or any("cannot be balanced" in remark for remark in found.remarks)


# ---- masses that replace a link --------------------------------------------------------------------------------------


@pytest.mark.parametrize("made", [four_bar, slider_crank])
def test_replaced_masses(made: Any) -> None:
    """Masses at points have each link's force and, with what two leave, its moment; none replace a link whose mass
    centre is beside the line of its pins."""
    found = gp.balance(made(STRAIGHT), positions=24).json()
    assert found["check"]["replaced masses"] < 1e-12
    assert found["replaced_masses"]
    for link, one in found["replaced_masses"].items():
        mass, s, _ = STRAIGHT[int(link) - 1]
        assert sum(one["static"].values()) == pytest.approx(sum(one["dynamic"].values())) == pytest.approx(mass)
        length = found["links"][link]["length"]
        assert min(one["static"].values()) == pytest.approx(mass * min(s, length - s) / length)
    assert not gp.balance(made(OFFSET), positions=3).json().get("replaced_masses")


# ---- counterweights --------------------------------------------------------------------------------------------------


def test_full_balance_of_a_four_bar() -> None:
    """Ozols (16.10), in numbers: with s_2 = 0.15 s_1 = -0.0857143 and s_3 = 0.3964286 m, S at x = 0.2349206 m."""
    found = gp.balance(four_bar(FOUR_BAR), positions=36, counterweights="full", keep=["2"],
                       radii={"1": 1e9, "3": 1e9}).json()["balanced"]
    assert s_of(found) == pytest.approx([-0.0857143, 0.15, 0.3964286], abs=5e-8)
    path = series(found["mass_centre"]["path"])
    assert np.abs(path - 0.2349206).max() < 5e-8
    assert np.abs(path - path[0]).max() < 1e-15


def test_balance_of_a_slider_crank() -> None:
    """Ozols (16.11), in numbers: s_1 = -0.35, s_2 = -0.53333 m, with an offset of the guide, too; and (16.12): with
    s_2 = 0.15 s_1 = -0.09375 m, and S moves along the guide alone, by 0.1139 m where that passes the crank's hinge."""
    full = gp.balance(slider_crank(ENGINE), positions=4, counterweights="full", radii=FAR).json()["balanced"]
    assert s_of(full) == pytest.approx([-0.35, -0.533333], abs=5e-7)
    for offset in (0.03, 0.0):
        found = gp.balance(slider_crank(ENGINE, 0.0, offset=offset), positions=12, counterweights="partial", keep=["2"],
                           radii={"1": 1e9}).json()["balanced"]
        assert s_of(found) == pytest.approx([-0.09375, 0.15], abs=5e-7)
        path = series(found["mass_centre"]["path"])
        assert np.ptp(path.imag) < 1e-15
    assert np.ptp(path.real) == pytest.approx(0.1139, abs=5e-5)


@pytest.mark.parametrize(("masses", "kept", "wanted"), [
    ([(2, 0.03, 0), (3, 0.15, 0), (4, 0.12, 0)], ["1"], "a"), ([(2, 0.13, 0), (3, 0.15, 0), (4, 0.12, 0)], ["1"], "b"),
    (FOUR_BAR, ["2"], "c"), (FOUR_BAR, ["3"], "d"), ([(2, 0.06, 0), (3, 0.15, 0), (4, -0.1, 0)], ["3"], "e")])
def test_variants(masses: list[tuple[float, float, float]], kept: list[str], wanted: str) -> None:
    """Table 16-1 has all that can be: which variant it becomes depends on the link that keeps its masses."""
    found = gp.balance(four_bar(masses), positions=12, counterweights="full", keep=kept).json()["balanced"]
    assert found["variant"] == wanted
    (m_1, s_1, l_1), (m_2, s_2, l_2), (m_3, s_3, l_3) = (
        (link["mass"], link["s"], link["length"]) for link in found["links"].values())
    assert m_1 * s_1 == pytest.approx(m_2 * l_1 * (s_2 / l_2 - 1))  # (16.10)
    assert m_2 * s_2 == pytest.approx(m_3 * l_2 * (s_3 / l_3 - 1))
    path = series(found["mass_centre"]["path"])
    assert np.abs(path - path[0]).max() < 1e-14


def six_bar(seed: int) -> gp.Scene:
    """A Watt linkage of two four-bars in a row, or a Stephenson one, with masses anywhere."""
    rng = np.random.default_rng(seed)
    places = {"O": 0j, "D": 0.4 + 0j, "A": cmath.rect(0.1, 0.7), "B": 0.35 + 0.3j, "C": 0.55 + 0.25j, "E": 0.8 + 0.4j,
              "F": 0.9 + 0j}
    places |= {f"S{k}": complex(*rng.uniform(-0.2, 0.6, 2)) for k in range(1, 6)}
    bodies = {"1": "O A S1", "2": "A B S2", "3": "B D S3", "4": "C E S4", "5": "E F S5", "frame": "O D F"}
    bodies["3" if seed % 2 else "2"] += " C"
    return scene(places, bodies, [(float(m), 0, 0) for m in rng.uniform(1, 5, 5)])


@pytest.mark.parametrize("seed", range(6))
def test_linkages_of_joints_can_be_balanced(seed: int) -> None:
    """Linkages of revolute pairs alone are fully balanced by half as many counterweights as they have links."""
    found = gp.balance(six_bar(seed), positions=24, counterweights="full").json()
    assert len(found["counterweights"]) == 3
    after = found["balanced"]
    force = np.nanmax([abs(complex(*row[1:])) for row in after["shaking_force"] if row[1] is not None])
    assert force < 1e-12 * max(abs(complex(*row[1:])) for rows in after["shaking_forces"].values() for row in rows
                               if row[1] is not None)


def test_a_yoke_is_balanced_across_its_guide() -> None:
    """What slides along the guide does not count across it: then a counterweight on the crank will do. Unasked a
    linkage is fully balanced if it can be; else the reason stands beside the numbers."""
    assert len(gp.balance("ozols-16-1", positions=6).json()["counterweights"]) == 2
    assert any("cannot be balanced" in remark for remark in gp.balance(CASES / "yoke.toml", positions=6).remarks)
    found = gp.balance(CASES / "yoke.toml", positions=24, counterweights="partial").json()
    assert [weight["link"] for weight in found["counterweights"]] == ["1"]
    assert np.ptp(series(found["balanced"]["mass_centre"]["path"]).imag) < 1e-15


# ---- engines ---------------------------------------------------------------------------------------------------------


def orders(found: dict[str, Any], key: str = "engine") -> dict[int, complex]:
    """The amplitudes of an engine's force along its guide, by orders."""
    return {one["order"]: complex(one["cos"], one["sin"]) for one in found[key]["orders"]}


@pytest.mark.parametrize(("angle", "none", "main", "both"), [
    (0, (2494, 0), (1724, 0), (314, 0)),  # 1744 is printed, which the other figures contradict
    (90, (-314, 770), (-314, 0), (-314, -1410)),
    (180, (-1866, 0), (-1096, 0), (314, 0)),
    (270, (-314, -770), (-314, 0), (-314, 1410))])
def test_printed_table_of_counterweights(angle: float, none: tuple[float, float], main: tuple[float, float],
                                         both: tuple[float, float]) -> None:
    """Ozols, table 16-2 in kgf: the forces of first and second order without counterweights, with the main one of
    27.5 kg, and with the additional one of 50.5 kg (50.0 is printed)."""
    data, turned = gp.balance("ozols-16-1", positions=4).json(), cmath.rect(1, math.radians(angle))
    found, square = data["engine"], float(gp.load("ozols-16-1").drives[0].rate) ** 2
    force = found["centrifugal"] * turned + sum((orders(data)[k] * turned**k).real for k in (1, 2))
    for weight, (x, y) in (({"mass_radius": 0}, none), (found["main_counterweight"], main),
                           (found["additional_counterweight"], both)):
        force -= weight["mass_radius"] * square * turned
        assert (force.real / KGF, force.imag / KGF) == pytest.approx((x, y), abs=5)


@pytest.mark.parametrize("ratio", [0.2, 0.5])
def test_coefficients_are_those_of_the_series(ratio: float) -> None:
    """They are (6.47)'s: A_2 = r^2/4 + r^4/16 + ..., A_4 = -r^4/64 - ..., and no odd order but the first is told."""
    crank = slider_crank([(2, 0.06, 0), (3, 0.15, 0), (4, 0, 0)], lengths=(0.4 * ratio, 0.4), offset=0.0)
    data = gp.balance(crank, positions=4).json()
    second = [ratio**2 / 4, ratio**4 / 16, 15 * ratio**6 / 512]
    assert data["engine"]["coefficients"]["A_2"] == pytest.approx(sum(second), abs=ratio**8 / 40)
    assert data["engine"]["coefficients"]["A_4"] == pytest.approx(-ratio**4 / 64 - 3 * ratio**6 / 256,
                                                                  abs=ratio**8 / 40)
    assert not [order for order in orders(data) if order % 2 and order != 1]


def test_orders_make_up_the_shaking_force() -> None:
    """All orders together are the shaking force of the linkage, with the guide beside the crank's hinge, too; a crank
    as long as its rod, a four-bar, and a rod whose mass centre is beside its line have none."""
    for given in (slider_crank(ENGINE), gp.load("ozols-16-1")):
        assert gp.balance(given, positions=12, counterweights="none").json()["check"]["orders"] < 1e-12
    long = gp.balance(slider_crank(ENGINE, lengths=(0.2499, 0.25), offset=0.0), positions=12, counterweights="none")
    assert "orders" not in long.json()["check"]  # of such a crank they have no end
    for other in (four_bar(FOUR_BAR), slider_crank([(2, 0.06, 0), (3, 0.15, 0.02), (4, 0, 0)])):
        assert not gp.balance(other, positions=4).json().get("engine")


def test_a_share_of_what_reciprocates() -> None:
    """With half of the reciprocating mass on the crank the first order is half as large along the guide, and as large
    across it."""
    found = gp.balance("ozols-16-1", positions=360, counterweights="share", share=0.5).json()
    (weight,) = found["counterweights"]
    assert weight["mass"] == pytest.approx(27.5 + 50.5 / 2)
    force, half = series(found["balanced"]["shaking_force"]), abs(orders(found)[1]) / 2
    phase = np.radians(np.arange(360) + 60)
    assert 2 * np.array([force.real @ np.cos(phase), force.imag @ np.sin(phase)]) / 360 == pytest.approx([half, -half])


def test_wheels_against_each_other() -> None:
    """Two wheels that turn against each other with the crank balance the first order, two at twice its speed the
    second; Ozols (16.19)."""
    data, omega = gp.balance("ozols-16-1", positions=4).json(), float(gp.load("ozols-16-1").drives[0].rate)
    wheels = data["engine"]["counter_rotating"]
    assert [wheel["speed"] for wheel in wheels] == [1, 2]
    for wheel in wheels:
        assert 2 * wheel["mass_radius"] * (wheel["speed"] * omega) ** 2 == pytest.approx(
            abs(orders(data)[wheel["speed"]]))


@pytest.mark.parametrize(("cranks", "forces", "couple"), [
    ((0, 180), {1: 0, 2: 2, 4: 2}, 1), ((0, 180, 180, 0), {1: 0, 2: 4, 4: 4}, 0),
    ((0, 240, 120, 120, 240, 0), {1: 0, 2: 0, 4: 0, 6: 6}, 0)])
def test_cylinders_in_line(cranks: tuple[int, ...], forces: dict[int, int], couple: int) -> None:
    """Of two cylinders the second order is left and a couple of the first; of four the second; of six the sixth, as
    there are no odd orders but the first. A couple is of the distance of the cylinders, 0.1 m."""
    engine = gp.load("ozols-16-1")
    sizes = {order: abs(size) for order, size in orders(gp.balance(engine, positions=4).json()).items()}
    line = engine.replace("cylinders", {"angles": [*cranks], "places": [100 * k for k in range(len(cranks))]})
    found = {one["order"]: one for one in gp.balance(line, positions=4).json()["cylinders"]}
    assert {order: found[order]["force"] / sizes[order] for order in forces if order in sizes} == pytest.approx(
        {order: times for order, times in forces.items() if order in sizes}, abs=1e-9)
    assert found[1]["couple"] == pytest.approx(couple * 0.1 * sizes[1], abs=1e-9 * sizes[1])


# ---- added dyads -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("linkage", "dyads"), [
    (four_bar(OFFSET), 3), (four_bar(STRAIGHT), 3), (slider_crank(OFFSET), 1), (gp.load("ozols-16-1"), 1),
    (gp.load("rosenauer-loaded"), 1)], ids=["four-bar", "straight", "slider", "engine", "eight"])
def test_the_joint_of_added_dyads_moves_as_the_mass_centre(linkage: gp.Scene, dyads: int, tmp_path: Path) -> None:
    """A slider-crank takes one dyad, a four-bar three; the plans find velocity and acceleration of the mass centre, in
    a pose a little further, too."""
    gp.balance(linkage, counterweights="none").save(tmp_path / "dyads.toml")
    added, masses = gp.load(tmp_path / "dyads.toml"), linkage.loads.masses.values()
    assert len(added.links) - len(linkage.links) == 2 * dyads
    drawing, truth, mass = gp.construct(added), gp.analytic.solve(linkage), sum(float(one.mass) for one in masses)
    for found, of in ((drawing.velocity["S"], truth.velocity), (drawing.acceleration["S"], truth.acceleration)):
        terms = [float(one.mass) * of[one.centre] / mass for one in masses]
        assert abs(found - sum(terms)) < 1e-12 * max(map(abs, terms))
    there, joint = gp.cycle.follow(linkage, 2, (0, 5)).points, gp.cycle.follow(added, 2, (0, 5)).points["S"]
    path = sum(float(one.mass) * there[one.centre] for one in masses) / mass
    assert np.diff(joint) == pytest.approx(np.diff(path), rel=1e-9)
