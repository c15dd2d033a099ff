"""What a construction finds is one list of facts: JSON, keys, tables, sheets and Python say the same of each."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
from each import each
from higher import two_wheels

import graphplan as gp
from graphplan.commands.schema import tables
from graphplan.kernel.numbers import Floats
from graphplan.marking.classroom.booklet import key_rows
from graphplan.methods.kinds import KINDS, ResultKind
from graphplan.methods.results import facts, pair_forces
from graphplan.output.tables import pose_columns

SCENES = [gp.load(name) for name in ("jaanimets-11", "inflection-circle")]
BELT = two_wheels("radii = [20, 40]\nbelt = 'open'", -4) + """[[friction]]
belt = ["1", "2"]
coefficient = 0.3
[find]
reactions = "all"
"""


@each("kind", [kind for kind in KINDS.values() if kind.table])
def test_schema_has_every_printed_kind(kind: ResultKind) -> None:
    """A kind that is printed under a key of a table stands there in the schema, as a number or a vector."""
    table = tables()["solve"].get(kind.table) or tables()["solve"][f"{kind.table}?"]
    names = {"instant centre": ["place", "direction"]}.get(name := table.split("{}")[0].rstrip("?"), [name])
    keys = {key.rstrip("?"): says for one in names for key, says in tables()[one].items()}
    assert keys[kind.key].startswith("value" if kind.single else "vector")


@each("scene", SCENES, ids=lambda scene: scene.name)
def test_json_key_and_python_say_the_same(scene: gp.Scene) -> None:
    """Of each fact JSON has the number under its table, its name and its key, and Python by its name; the key and a
    table over poses have a row and columns of it, with its unit."""
    drawing, results = gp.construct(scene), gp.solve(scene)
    rows = {(row.quantity, row.of): row for row in key_rows(drawing)}
    points = {name: np.array([complex(*map(float, at))]) for name, at in scene.points.items()}
    headings = [heading for heading, _ in pose_columns(scene, np.zeros(1), {}, drawing.evaluate(points).results)]
    for fact in facts(drawing.read(Floats())):
        row, unit, near = rows[fact.kind, fact.of], fact.unit(scene.units), partial(pytest.approx, rel=1e-5, abs=1e-9)
        assert row.unit == unit
        assert [float(text) for text in (row.x, row.y, row.value) if text] == near([*fact.axes.values()])
        assert all(f"{heading} [{unit}]" in headings for heading in fact.columns)
        if fact.kind.table:
            printed = results.json()[fact.kind.table][fact.of][fact.kind.key]
            assert (printed if isinstance(printed, list) else [printed]) == near([*fact.axes.values()])
            assert results.results_of_kind(fact.kind)[fact.of] == near(drawing.results_of_kind(fact.kind)[fact.of])


def test_strands_of_belts_are_reactions_by_their_names() -> None:
    """Each force of a pair is printed with what it acts on, and Python has it by the name that results have."""
    scene = gp.parse(BELT)
    results, forces = gp.solve(scene), list(pair_forces(scene))
    assert [entry["on"] for entry in results.json()["reactions"]] == [force.on for force in forces]
    assert [*results.reactions] == [force.name for force in forces]
    assert {"1 2 left", "1 2 right", "1 2"} <= results.reactions.keys()
