"""What `graphplan cycle --plot` draws by matplotlib: all that its table has, by name, as curves or polar diagrams, and
families over values of the scene."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any, NamedTuple

from graphplan.app.choices import drawing_options, load_scene, load_sheet_scene, question, set_value, text_of_scene
from graphplan.app.drafting import on_sheet
from graphplan.errors import Refused
from graphplan.mechanism.model import Scene

if TYPE_CHECKING:
    from graphplan.check.cycle import Cycle
    from graphplan.output.cycle_diagrams import DiagramPanel, TravelCurve
    from graphplan.output.tables import TableQuantity

MAX_CURVES, MAX_PANELS = 8, 8  # of a panel, and of a page: more are told apart by nobody
CONSTRUCTED = ".svg"  # the ending of diagrams by chords and tangents
SHOWN_NAMES = 12  # of those that may be meant


class Member(NamedTuple):
    """A scene of a family, and what makes it another than the rest; empty of a scene alone."""

    label: str
    scene: Scene


def add_plot(add: Callable[..., Any]) -> None:
    add("--plot", metavar="FILE", help="kinematic diagrams (.svg), or curves of other columns of the table over the "
        "travel (.svg, .pdf or .png)")
    add("--of", action="append", default=[], metavar="NAME",
        help="what to plot: a link (its angle), a slide, or a point's coordinate such as B.x, up to four times, with "
        "chords and tangents; or other columns as plain curves, such as 'reaction B', balance, efficiency, "
        "'velocity A', A.vx, 'omega 3', 'frame at O.size'")
    add("--polar", action="store_true", help="polar diagrams: of a joint's force, or a hodograph")
    add("--vary", metavar="PATH=VALUES", help="a family of curves over a value of the scene, such as "
        "moments.0.value=1,2,4")


def check_plot(options: argparse.Namespace) -> None:
    """Refuse what belongs to plots where there is none, and a table of a family."""
    if not options.plot:
        for option, value in (("--polar", options.polar), ("--vary", options.vary)):
            if value:
                raise Refused(option, "only a plot uses it", "add --plot FILE.svg, or leave it out")
    if options.vary and options.output:
        raise Refused("--vary", "a table is of one scene", "leave out -o, or take --set")


def plot_members(options: argparse.Namespace, ending: str) -> list[Member]:
    """Return the scenes whose cycles are plotted, each asking for what is named, which is checked first."""
    from graphplan.check.cycle import quantities, scene_asking_for

    members = scenes_of_family(options) if options.vary else [Member("", load_sheet_scene(options))]
    if is_plain(members[0].scene, options):
        members = [Member(label, scene_asking(scene, options.of)) for label, scene in members]
        _check_names(members[0].scene, options)
        return members
    if ending != CONSTRUCTED:
        raise Refused(f"--plot {options.plot}", "chords and tangents are drawn as .svg alone",
                      "a name in .svg, or another quantity, such as --of B.vx")
    [(label, scene)] = members
    return [Member(label, scene_asking_for(scene, quantities(scene, options.of)))]


def plot_file(options: argparse.Namespace, members: Sequence[Member], cycles: Sequence[Cycle],
              ending: str) -> str | bytes:
    """Return the file of the plot: plain diagrams, or those that are constructed by chords and tangents."""
    scene = cycles[0].scene
    if is_plain(scene, options):
        return _figure_file([(member.label, cycle) for member, cycle in zip(members, cycles, strict=True)], options.of,
                            options.polar, ending)
    from graphplan.check.cycle import curves, quantities
    from graphplan.cycle.diagrams import diagram
    from graphplan.output.plots import diagrams
    from graphplan.words.tongue import tongue

    plots = [diagram(curve) for curve in curves(cycles[0], quantities(scene, options.of))]
    return diagrams(plots, scene.title, tongue(scene.sheet.language))


def is_plain(scene: Scene, options: argparse.Namespace) -> bool:
    """Whether the plot is of plain curves: polar, a family, or of anything but links, slides and coordinates."""
    from graphplan.check.cycle import is_plot_quantity

    return bool(options.polar or options.vary) or not all(is_plot_quantity(scene, name) for name in options.of)


def scenes_of_family(options: argparse.Namespace) -> list[Member]:
    """Return the scene with each of the values that are asked for.

    Fails with `Refused` where no values are given or they are too many, and as a scene with such a value does.
    """
    from graphplan.mechanism.written_scene import parse

    path, equals, values = options.vary.partition("=")
    each = [value.strip() for value in values.split(",") if value.strip()]
    if not equals or not each:
        raise Refused(f"--vary {options.vary}", "no values are given", "such as --vary moments.0.value=1,2,4")
    if len(each) > MAX_CURVES:
        raise Refused(f"--vary {options.vary}", f"{len(each)} curves are too many", f"at most {MAX_CURVES}")
    text, members = text_of_scene(options, options.scene), list[Member]()
    for value in each:
        scene = parse(set_value(text, path.strip(), value, options.scene), options.scene)
        question(options, scene)
        posed = load_scene(options, scene)
        members.append(Member(f"{path.strip()} = {value}", on_sheet(posed, drawing_options(options))))
    return members


def scene_asking(scene: Scene, names: Iterable[str]) -> Scene:
    """Return the scene, asking also for the motion that these names tell of."""
    from graphplan.check.cycle import side_of_link

    requested, find = {*names}, scene.find
    turning = [link for link in scene.moving if len(scene.links[link]) > 1 and requested & {
        text for rate in ("omega", "alpha") for text in (f"{rate} {link}", f"{link}.{rate}")}]
    ends = {P for link in turning for P in side_of_link(scene, link)} if find.links is None else set[str]()

    def points(known: Sequence[str], rate: str, *columns: str) -> tuple[str, ...]:
        return tuple(P for P in scene.points if P in {*known, *ends} or requested & {
            f"{rate} {P}", *(f"{P}.{column}" for column in columns)})

    links = find.links and tuple(link for link in scene.moving if link in {*find.links, *turning})
    return replace(scene, find=replace(find, velocity=points(find.velocity, "velocity", "vx", "vy", "x", "y"),
                                       acceleration=points(find.acceleration, "acceleration", "ax", "ay"), links=links))


def chosen_quantities(scene: Scene, quantities: Mapping[str, TableQuantity], names: Sequence[str],
                      polar: bool) -> list[TableQuantity]:
    """Return what these names mean, each once.

    Fails with `Refused` where a name means nothing, with the nearest that there is, and where a number is to be polar.
    """
    from graphplan.output.tables import quantity_groups

    groups = quantity_groups(scene, quantities)
    if polar and not names:
        names = ["reaction"] if groups.get("reaction") else []
    if not names:
        raise Refused("--of", "the quantity is missing", f"such as --of {_in_quotes(next(iter(groups)))}")
    chosen: dict[str, TableQuantity] = {}
    for name in names:
        members = groups.get(name) or [name]
        if members[0] not in quantities:
            raise _unknown(name, [*groups, *quantities])
        for member in members:
            quantity = quantities[member]
            if polar and not quantity.is_vector:
                vectors = [other for other, of in quantities.items() if of.is_vector]
                raise Refused(f"--of {_in_quotes(name)}", "it has no direction: there is no polar diagram of it",
                              f"such as {_nearest_name(name, vectors)}, or leave out --polar")
            chosen[member] = quantity
    return [*chosen.values()]


def _unknown(name: str, names: Sequence[str]) -> Refused:
    nearest = _nearest_name(name, names)
    others = ", ".join([other for other in names if other != nearest][:SHOWN_NAMES])
    return Refused(f"--of {_in_quotes(name)}", "unknown quantity", f"{nearest}, or another, such as {others}")


def _nearest_name(name: str, names: Sequence[str]) -> str:
    """Return the name that was probably meant, of some."""
    return next(iter(get_close_matches(name, names, 1, 0.0)), "")


def _in_quotes(name: str) -> str:
    return f"'{name}'" if " " in name else name


def _figure_file(members: Sequence[tuple[str, Cycle]], names: Sequence[str], polar: bool, ending: str) -> bytes:
    """Return the file of the diagrams of what these names mean, of one cycle or of the members of a family."""
    from graphplan.output.cycle_diagrams import curves_figure, polar_figure
    from graphplan.output.diagrams import file_of
    from graphplan.words.tongue import tongue

    scene = members[0][1].scene
    panels = [*_panels(members, names, polar)]
    if len(panels) > MAX_PANELS or any(len(panel.curves) > MAX_CURVES for panel in panels):
        raise Refused("--of", "too many curves for one page", f"at most {MAX_PANELS} panels of {MAX_CURVES} curves")
    travel_unit = members[0][1].scene.units.length if scene.drives[0].slides else "deg"
    draw = polar_figure if polar else curves_figure
    return file_of(draw(scene.title, panels, travel_unit, tongue(scene.sheet.language)), ending)


def _panels(members: Sequence[tuple[str, Cycle]], names: Sequence[str], polar: bool) -> Iterator[DiagramPanel]:
    """Yield the panels: of a family one for each quantity, else one for each unit."""
    from graphplan.output.cycle_diagrams import DiagramPanel
    from graphplan.output.tables import named_quantities

    by_member: dict[str, dict[str, TableQuantity]] = {}
    for label, cycle in members:
        named = named_quantities(cycle.scene, cycle.requested_points, cycle.results, cycle.efficiency)
        by_member[label] = {quantity.name: quantity
                            for quantity in chosen_quantities(cycle.scene, named, names, polar)}
    first = next(iter(by_member.values()))
    if len(members) > 1:
        for name, quantity in first.items():
            yield DiagramPanel(quantity.label, quantity.unit, [
                _curve(cycle, label, by_member[label][name].values) for label, cycle in members])
        return
    [(_, cycle)] = members
    for measure in dict.fromkeys(quantity.unit for quantity in first.values()):
        yield DiagramPanel("", measure, [_curve(cycle, quantity.label, quantity.values) for quantity in first.values()
                                  if quantity.unit == measure])


def _curve(cycle: Cycle, label: str, values: Any) -> TravelCurve:
    """Return a curve over the poses of a cycle; one that is closed ends where it began."""
    import numpy as np

    from graphplan.output.cycle_diagrams import TravelCurve
    from graphplan.output.tables import FULL_TURN, printed_travel

    measure, travel = printed_travel(cycle.scene, cycle.turn.travel)
    if cycle.turn.closed and not cycle.faults and measure == "deg":
        travel, values = np.append(travel, travel[0] + FULL_TURN), np.append(values, values[0])
    return TravelCurve(label, travel, values)


def _check_names(scene: Scene, options: argparse.Namespace) -> None:
    """Fail with `Refused` where a name means nothing in a scene's table, before any pose is followed."""
    import numpy as np

    from graphplan.design.decide import general_construction
    from graphplan.methods.design import Design
    from graphplan.output.tables import named_quantities

    drawing = general_construction(scene, Design(inertia=scene.sheet.inertia))
    points = {name: np.zeros(1, complex) for name in (*scene.find.velocity, *scene.find.acceleration,
                                                      *scene.sheet.curves)}
    rubs = bool(scene.loads and scene.loads.frictions)
    results = drawing.empty_arrays(1)
    named = named_quantities(scene, points, results, np.zeros(1) if rubs else None)
    chosen_quantities(scene, named, options.of, options.polar)
