"""Machines that move by special geometry though the count says they cannot, in any order, by any drive, and onwards.

What each gives in its pose is in `cases/special-geometry`.
"""

from __future__ import annotations

import tomllib
from itertools import combinations
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from face import names, ran

import graphplan as gp

FOLDER = Path(__file__).parents[1] / "cases" / "special-geometry"
MACHINES = sorted(path.stem.removesuffix("-loaded") for path in FOLDER.glob("*-loaded.toml"))
every = pytest.mark.parametrize("name", MACHINES)


def tables(name: str) -> dict[str, Any]:
    """The tables of a machine."""
    return tomllib.loads((FOLDER / f"{name}.toml").read_text(encoding="utf-8"))


@every
def test_the_order_of_writing_means_nothing(name: str) -> None:
    """Points, links and slides in any order give the same redundant conditions and the same rates, as fractions."""
    chance, written = Random(1909), tables(name)
    whole = gp.scene(written)
    rates = gp.analytic.solve(whole, exact=True)

    def mixed(table: Any) -> Any:
        items = list(table.items() if isinstance(table, dict) else table)
        chance.shuffle(items)
        return dict(items) if isinstance(table, dict) else items

    for _ in range(3):
        links = {link: " ".join(mixed(points.split())) for link, points in written["links"].items()}
        other = gp.scene(written | {"points": mixed(written["points"]), "links": mixed(links),
                                    "slides": mixed(written.get("slides", []))})
        assert (other.redundant, {*other.repeating}) == (whole.redundant, {*whole.repeating})
        again = gp.analytic.solve(other, exact=True)
        assert (again.velocity, again.acceleration, again.omega) == (rates.velocity, rates.acceleration, rates.omega)


@every
def test_it_goes_on_as_it_is_solved_to(name: str) -> None:
    """As the drive goes on, all lengths stay and guides stay met, redundant ones too, and points move as solved."""
    scene = gp.load(FOLDER / f"{name}.toml")
    step, velocity = 1e-3, gp.solve(scene).velocity
    sliding = bool(scene.drives[0].slides)
    reach = float(scene.extent) * 1e-4 if sliding else step
    poses = gp.follow(scene, 3, (-reach, reach))
    seconds = 2 * reach / (3 if sliding else np.degrees(2))
    fastest = max(map(abs, velocity.values()))
    for point, value in velocity.items():
        slope = (poses.points[point][2] - poses.points[point][0]) / seconds
        assert slope == pytest.approx(value, abs=1e-5 * fastest), point
    wide = gp.follow(scene, 9, (-4 * reach, 4 * reach) if sliding else (-4, 4)).points
    for link, held in scene.links.items():
        for one, other in combinations(held, 2):
            lengths = np.abs(wide[one] - wide[other])
            assert lengths == pytest.approx(np.full(9, lengths[4]), rel=1e-9), link
    for slide in scene.slides:
        if slide.along == "frame":
            off = (wide[slide.at] - wide[slide.at][4]) / complex(*map(float, slide.direction))
            assert off.imag == pytest.approx(0, abs=1e-9 * np.abs(off).max())


@every
def test_any_link_may_drive_it(name: str) -> None:
    """Whatever link or slide is driven, the construction is exact, or the pose is singular for that drive."""
    written, done = tables(name), 0
    slides = [{"slide": [one["link"], one["along"]], "speed": 3} for one in written.get("slides", [])]
    for drive in [*({"link": link, "omega": 2} for link in written["links"] if link != "frame"), *slides]:
        try:
            text = gp.scene(written | {"drive": [drive]}).text
        except gp.SceneError:  # its drive says what a slide does: the link does not turn
            assert slides
            assert "link" in drive
            continue
        found = ran("check", "-", "--exact", given=text)
        assert found.status in (0, 3), found.err
        done += found.status == 0
    assert done


@pytest.mark.parametrize("name", [name for name in names() if not gp.load(name).motions])
def test_a_bar_too_many_changes_nothing(name: str) -> None:
    """A bar between two points of one link is told as redundant or makes another so, and the rates stay the same."""
    scene, chance = gp.load(name), Random(name)
    link = chance.choice([link for link in scene.moving if len(scene.links[link]) > 1])
    one, two = chance.sample(scene.links[link], 2)
    doubled = gp.parse(scene.text.replace("[links]", f'[links]\nbar = "{one} {two}"', 1), name)
    assert doubled.redundant
    omega = gp.solve(doubled).omega
    assert all(omega[link] == pytest.approx(rate, abs=1e-9) for link, rate in gp.solve(scene).omega.items())
