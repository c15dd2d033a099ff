"""What is given of a machine, in words: its masses and inertias, its loads.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from graphplan.mechanism.model import FRAME, Scene
from graphplan.mechanism.order import named_forces, named_moments
from graphplan.mechanism.springs import spring_numbers
from graphplan.output.panelled import Words
from graphplan.phrases import arrange, digits, join, said, unit

MAX_TABLE_ROWS = 40  # of a table at most that are told: more are a curve


def masses_and_loads(scene: Scene) -> Iterator[Words]:
    """The masses link by link, then the forces and moments by their letters, those that change by their tables."""
    loads, names = scene.loads, scene.units
    if loads is None:
        return
    for link, mass in loads.masses.items():
        parts = [arrange("m_{0} = {1} {2}", link, digits(float(mass.mass)), unit(names.mass))] if mass.mass else []
        if mass.inertia:
            parts.append(arrange("I_{0} = {1} {2}", link, digits(float(mass.inertia)), unit(f"{names.mass} m²")))
        if parts and link != FRAME:
            yield join(parts)
    if loads.masses and any(loads.gravity):
        yield arrange("g = ({0}, {1}) {2}", *(digits(float(part)) for part in loads.gravity), unit("m/s²"))
    for name, force in named_forces(loads).items():
        value = (digits(float(part)) for part in force.value)
        yield load_by_table(name, force.table, names.force) or arrange("{0} = ({1}, {2}) {3}", name, *value,
                                                                       unit(names.force))
    measure = f"{names.force} m"
    for name, moment in named_moments(loads).items():
        yield load_by_table(name, moment.table, measure) or arrange("{0} = {1} {2}", name, digits(float(moment.value)),
                                                                    unit(measure))


def load_by_table(name: str, table: Any, measure: str) -> Words | None:
    """A load by its table, if it has one."""
    if table is None:
        return None
    if table.span:
        stiffness, free = map(float, spring_numbers(table))
        return arrange("{0} = {1} ({2} - {3}) {4}", name, digits(stiffness), "".join(table.span), digits(free),
                       unit(measure))
    if table.powers:
        c = [digits(float(power)) for power in (*table.powers, 0, 0)][:3]
        return arrange("{0} = {1} + {2} v + {3} v |v| {4}; v: {5}", name, *c, unit(measure), table.over)
    told = arrange("{0}: {1}", name, said("A load over {0}, in {1} rows", table.over, len(table.rows)))
    if len(table.rows) > MAX_TABLE_ROWS:
        return told
    rows = join([arrange("({0}; {1})", *(digits(float(number)) for number in row)) for row in table.rows])
    return arrange("{0}: {1} {2}", told, rows, unit(measure))
