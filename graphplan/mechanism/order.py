"""The order of a scene's links, points and pairs, independent of the order in which they are written.

Links by name, the frame last; a link's points as motion passes through them: those on the frame first, then joints with
links before this one, joints with links after it, and the others, each by name; slides and drives by their links.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, TypeVar

from graphplan.errors import Key as Key
from graphplan.errors import by_name as by_name
from graphplan.mechanism.model import FRAME, Contact, Drive, Force, Gear, Loads, Moment, Scene, Slide

Load = TypeVar("Load", Force, Moment)


def sort_scene(scene: Scene) -> Scene:
    """The scene with its links, points, pairs and loads in this order; its balances stay numbered as they are."""
    links = ordered_links(scene)
    higher = (*sorted(scene.gears, key=_by_links), *sorted(scene.contacts, key=_by_links))
    return replace(scene, points={point: scene.points[point] for point in ordered_points(scene)}, links=links,
                   written=(*ordered_slides(scene), *higher, *scene.drives),
                   loads=scene.loads and _ordered_loads(scene.loads))


def without_higher_pairs(scene: Scene) -> Scene:
    """The scene in this order without its higher pairs, where others stand for them."""
    sorted_scene = sort_scene(scene)
    return replace(sorted_scene, written=tuple(pair for pair in sorted_scene.written
                                               if not isinstance(pair, Gear | Contact)))


def _ordered_loads(loads: Loads) -> Loads:
    """The loads by their links, those of one link by their values and points."""
    def key(load: Force | Moment) -> tuple[Key, tuple[float, ...], Key]:
        at, value = (load.at, load.value) if isinstance(load, Force) else ("", (load.value,))
        if load.table is not None:  # so a load is called alike in every pose
            value = *(load.direction or () if isinstance(load, Force) else ()), *load.table.numbers
        return by_name(load.on), tuple(map(float, value)), by_name(at)

    masses = {link: loads.masses[link] for link in sorted(loads.masses, key=by_name)}
    return replace(loads, masses=masses, forces=tuple(sorted(loads.forces, key=key)),
                   moments=tuple(sorted(loads.moments, key=key)),
                   frictions=tuple(sorted(loads.frictions, key=lambda f: (f.links, by_name(f.at)))))


def named_forces(loads: Loads) -> dict[str, Force]:
    """The given forces by their letters: P_2 and P_2' on link 2."""
    return _by_letter("P", _ordered_loads(loads).forces)


def named_moments(loads: Loads) -> dict[str, Moment]:
    """The given moments by their letters: M_2 and M_2' on link 2."""
    return _by_letter("M", _ordered_loads(loads).moments)


def changing_loads(loads: Loads | None) -> dict[str, Force | Moment]:
    """The loads that change over the cycle, by their letters."""
    named: dict[str, Force | Moment] = {**named_forces(loads), **named_moments(loads)} if loads else {}
    return {name: load for name, load in named.items() if load.table}


def with_values(loads: Loads, values: Mapping[str, Any]) -> Loads:
    """The loads, some with other values by their letters: pairs for forces, numbers for moments; or arrays of them."""
    new_values: dict[int, Any] = {id(load): values[name]
                                  for name, load in changing_loads(loads).items() if name in values}

    def with_value(load: Any) -> Any:
        return replace(load, value=new_values[id(load)]) if id(load) in new_values else load

    return replace(loads, forces=tuple(map(with_value, loads.forces)), moments=tuple(map(with_value, loads.moments)))


def _by_letter(letter: str, loads: Sequence[Load]) -> dict[str, Load]:
    """Loads by their letters: that of their link, with a prime where it is taken."""
    links = [load.on for load in loads]
    return {f"{letter}_{load.on}" + "'" * links[:i].count(load.on): load for i, load in enumerate(loads)}


def ordered_links(scene: Scene) -> dict[str, tuple[str, ...]]:
    """Each link with its points."""
    links = sorted(scene.links, key=lambda link: (link == FRAME, by_name(link)))
    rank = {link: -1 if link == FRAME else number for number, link in enumerate(links)}

    def place(link: str, point: str) -> tuple[int, Key]:
        first = min((rank[link_before] for link_before in scene.links_of[point] if link_before != link), default=None)
        if first is None:
            return 3, by_name(point)
        return (0 if first < 0 else 1 if first < rank[link] else 2), by_name(point)

    return {link: tuple(sorted(scene.links[link], key=partial(place, link))) for link in links}


def ordered_points(scene: Scene) -> tuple[str, ...]:
    """The points, link by link; last those that no link has."""
    linked = dict.fromkeys(point for points in ordered_links(scene).values() for point in points)
    return (*linked, *sorted(scene.points.keys() - linked, key=by_name))


def ordered_slides(scene: Scene) -> tuple[Slide, ...]:
    """The slides by their links."""
    return tuple(sorted(scene.slides, key=_by_links))


def ordered_drives(scene: Scene) -> tuple[Drive, ...]:
    """The drives by their links, those of turnings first."""
    return tuple(sorted(scene.drives, key=lambda drive: (drive.slides, _by_links(drive))))


def turning_drives(scene: Scene) -> tuple[Drive, ...]:
    """The drives that prescribe a turning, by their links."""
    return tuple(drive for drive in ordered_drives(scene) if not drive.slides)


def _by_links(pair: Slide | Gear | Contact | Drive) -> tuple[Key, ...]:
    return *map(by_name, pair.links), by_name("" if isinstance(pair, Drive) else pair.name)
