"""Diagrams over a machine's cycle: curves over the drive's travel, one panel a unit, and polar diagrams of vectors."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from graphplan.output import diagrams
from graphplan.output.diagrams import COLOURS, DASHES, MM, Axes, Figure, Heading, Margins, SeriesLabel
from graphplan.phrases import Said, digits, join, said, unit
from graphplan.words.tongue import Tongue

PANEL_MM, POLAR_MM = (170.0, 62.0), (105.0, 105.0)
TRAVEL_STEPS = 5, 10, 15, 30, 45, 60, 90, 180, 360  # degrees: between readings of a travel
MAX_READINGS = 13  # along the travel
MARKED_STEP, NUMBERED_STEP = 30.0, 90.0  # degrees of travel: between marks and numbers along a polar diagram
HALF_TURN = 180.0  # degrees: a direction that changes by more goes on from the other side
RATIO_ENDS = -1.05, 1.05  # of the axis of efficiencies: a machine near to locking itself has far lower ones
DECIMALS = 6  # of a travel in steps: as far as it is known
POLAR_ROOM = 1.08  # of the largest vector: the radius of a polar diagram


class TravelCurve(NamedTuple):
    """A quantity over the poses, of vectors complex: what it is, its travel as printed, and its values."""

    label: Said | str
    travel: Any
    values: Any


class DiagramPanel(NamedTuple):
    """Curves that share an axis: what they are, where that is one thing, and their unit."""

    label: Said | str
    unit: str
    curves: Sequence[TravelCurve]


@diagrams.in_style
def curves_figure(title: str, panels: Sequence[DiagramPanel], travel_unit: str, say: Tongue) -> Figure:
    """Return curves over the travel, of vectors their sizes; the largest of each is marked and told with its place."""
    figure, all_axes = diagrams.page(title, "", [Heading(say(panel.label)) for panel in panels], PANEL_MM, 1,
                                     Margins(left=28.0, right=92.0))
    number = 0
    for axes, panel in zip(all_axes, panels, strict=True):
        labels = list[SeriesLabel]()
        for curve, colour, dash in zip(panel.curves, COLOURS, DASHES, strict=False):
            number += 1
            sizes = np.abs(curve.values) if np.iscomplexobj(curve.values) else curve.values
            axes.plot(curve.travel, _break_at_jumps(sizes, panel.unit), color=colour, linestyle=dash,
                      gid=f"curve-{number}")
            if panel.unit and (most := _place_of_largest(curve)) is not None:
                axes.plot([curve.travel[most]], [sizes[most]], color=colour, marker="o", linestyle="none")
            ends = np.flatnonzero(np.isfinite(sizes))
            if ends.size:
                labels.append(SeriesLabel(curve.travel[ends[-1]], sizes[ends[-1]],
                                    _words(curve, panel.unit, travel_unit, say), colour))
        if not panel.unit and axes.get_ylim()[0] < RATIO_ENDS[0]:
            axes.set_ylim(*RATIO_ENDS)
        _set_travel(axes, [curve.travel for curve in panel.curves], travel_unit)
        axes.yaxis.set_major_formatter(lambda value, place: say(digits(value)))
        axes.set(xlabel=f"{say(said('drive'))}, {say(unit(_sign(travel_unit)))}", ylabel=say(unit(_sign(panel.unit))))
        diagrams.end_labels(axes, labels)
    return figure


@diagrams.in_style
def polar_figure(title: str, panels: Sequence[DiagramPanel], travel_unit: str, say: Tongue) -> Figure:
    """Return polar diagrams: the ends of vectors from one pole, marked at equal steps of the travel."""
    figure, all_axes = diagrams.page(title, "", [Heading(say(panel.label)) for panel in panels], POLAR_MM, 2,
                                     Margins(left=16.0, right=90.0, above=10.0), projection="polar")
    number = 0
    for axes, panel in zip(all_axes, panels, strict=True):
        for curve, colour, dash in zip(panel.curves, COLOURS, DASHES, strict=False):
            number += 1
            angles, sizes = np.angle(curve.values), np.abs(curve.values)
            axes.plot(angles, sizes, color=colour, linestyle=dash, gid=f"curve-{number}",
                      label=_words(curve, panel.unit, travel_unit, say))
            marked = _places_at_steps(curve.travel, MARKED_STEP)
            axes.plot(angles[marked], sizes[marked], color=colour, marker="o", markersize=1.2 * MM, linestyle="none")
            for k in _places_at_steps(curve.travel, NUMBERED_STEP) if len(panel.curves) == 1 else ():
                axes.annotate(f"{curve.travel[k]:g}{_sign(travel_unit)}", (angles[k], sizes[k]), (1.5 * MM, 1.5 * MM),
                              textcoords="offset points")
            if (most := _place_of_largest(curve)) is not None:
                axes.plot([angles[most]], [sizes[most]], color=colour, marker="D", linestyle="none")
        reach = max((float(np.nanmax(np.abs(curve.values))) for curve in panel.curves
                     if np.isfinite(curve.values).any()), default=0.0)
        axes.set_ylim(0.0, POLAR_ROOM * reach or 1.0)
        axes.yaxis.set_major_formatter(lambda value, place: say(digits(value)))
        axes.legend(loc="upper left", bbox_to_anchor=(1.12, 1.0), borderaxespad=0.0, labelspacing=0.9,
                    title=say(unit(_sign(panel.unit))), alignment="left")
    return figure


def _words(curve: TravelCurve, measure: str, travel_unit: str, say: Tongue) -> str:
    """Return what a curve is, and under it its largest value with its place."""
    most = _place_of_largest(curve)
    if most is None or not measure:  # an efficiency has a mean, not a largest value
        return say(curve.label)
    value = curve.values[most]
    size = join((digits(float(np.abs(value) if np.iscomplexobj(value) else value)), unit(_sign(measure))), " ")
    place = join((digits(float(curve.travel[most])), unit(_sign(travel_unit))), "" if travel_unit == "deg" else " ")
    return f"{say(curve.label)}\n{say(said('largest {0} at {1}', size, place))}"


def _place_of_largest(curve: TravelCurve) -> int | None:
    """Return the place of the largest size; None where no value is known."""
    return int(np.nanargmax(np.abs(curve.values))) if np.isfinite(curve.values).any() else None


def _break_at_jumps(values: Any, measure: str) -> Any:
    """Return directions with gaps where they go on from the other side; other values as they are."""
    if measure != "deg":
        return values
    broken = np.array(values, dtype=float)
    broken[np.flatnonzero(np.abs(np.diff(broken)) > HALF_TURN)] = np.nan
    return broken


def _places_at_steps(travel: Any, step: float) -> Any:
    """Return the places whose travel is a whole number of steps, each once."""
    return [k for k, gone in enumerate(travel[:-1]) if round(gone / step, DECIMALS) == round(gone / step)]


def _set_travel(axes: Axes, travels: Sequence[Any], travel_unit: str) -> None:
    """Set the axis of the travel from its least to its greatest, in degrees with round readings."""
    start, end = (float(of([of(travel) for travel in travels])) for of in (np.min, np.max))
    axes.set_xlim(start, end if end > start else start + 1.0)
    if travel_unit == "deg":
        step = next((step for step in TRAVEL_STEPS if (end - start) / step < MAX_READINGS), TRAVEL_STEPS[-1])
        first, last = int(np.ceil(start / step)), int(np.floor(end / step))
        axes.set_xticks([step * k for k in range(first, last + 1)])


def _sign(measure: str) -> str:
    """Return a unit as sheets write it."""
    return "°" if measure == "deg" else measure.replace("^2", "²").replace("*", "·")
