"""The numbers of a scene's pose: those of the construction, compared with the analytic solver."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any, Unpack

from graphplan.app.drafting import Keywords, make_report, pencil, wishes_of, with_sheet
from graphplan.app.files import as_json, kind, write
from graphplan.errors import Refused, missing_package
from graphplan.mechanism.model import Frozen, NamedValues
from graphplan.methods import kinds
from graphplan.methods.kinds import kind_of
from graphplan.methods.results import NamedResults

if TYPE_CHECKING:
    from graphplan.check.report import Report
    from graphplan.mechanism.model import Scene

NOWHERE = complex("nan+nanj")
ENDINGS = (".json",)


@dataclass(frozen=True, repr=False)
class Results(NamedResults[complex, float]):
    """Results of `solve`: velocities, accelerations, rates, poles and forces, in the scene's units.

    Vectors are complex numbers, or pairs of fractions where the numbers are exact. Mappings by name have what was
    asked for; velocity and acceleration of a fixed point are 0, and any other name is a `KeyError` that says which
    were asked for. What does not exist in the pose is nan (of fractions None), and `reasons` says why.
    """

    scene: Scene
    text: str

    @property
    def balance(self) -> Any:
        """The balance that maintains the motion: a moment in force * m, or a force; several as a tuple, None if not
        asked for."""
        values = tuple(self.balances)
        return values[0] if len(values) == 1 else values or None

    @property
    def balances(self) -> list[Any]:
        """The balances in the scene's order: moments in force * m, forces as complex numbers."""
        printed = self._data.get("balance", [])
        return [_number(entry.get("moment", entry.get("force")))
                for entry in (printed if isinstance(printed, list) else [printed])]

    @property
    def reactions(self) -> NamedValues[complex]:
        """Reactions, complex, in the scene's unit of force: on a link at a joint, such as `2 at B`; on the first link
        of a slide, gear or contact, by its name."""
        def name(entry: Mapping[str, Any]) -> str:
            return next((entry[sort] for sort in ("slide", "gear", "strand", "contact") if sort in entry),
                        f"{entry['on']} at {entry.get('at')}")

        return NamedValues({name(entry): _number(entry["force"], vector=True)
                            for entry in self._data.get("reactions", ())}, "reaction")

    @property
    def reasons(self) -> Frozen[str, Mapping[str, str]]:
        """Why what was asked for does not exist in the pose, by the key of the JSON and the name."""
        return Frozen(self._data.get("reasons", {}))

    @property
    def check(self) -> Frozen[str, float]:
        """Largest difference from the analytic solver by kind, relative to the largest term of the number."""
        return Frozen(self._data.get("check", {}))

    def json(self) -> dict[str, Any]:
        """The JSON of `graphplan solve`."""
        data: dict[str, Any] = json.loads(self.text)
        return data

    def save(self, path: str) -> None:
        """Write what `graphplan solve` prints to a .json file; fails with `Refused` where that cannot be."""
        kind(path, ENDINGS, "result")
        write(self.text, path)

    def __repr__(self) -> str:
        check = ", ".join(f"{name} {gap:.1e}" for name, gap in self.check.items())
        return f"<Results of {self.scene.title or self.scene.name}: " \
               f"{', '.join([*self.velocity, *self.omega]) or 'no motion'}; check {check or 'none'}>"

    def _repr_html_(self) -> str:
        """A table of points and links, for notebooks."""
        from html import escape

        columns = ("velocity", "acceleration", "omega", "alpha")
        rows = {**self._data["points"], **self._data["links"]}
        cells = ["<tr><td>" + "</td><td>".join([escape(name), *(escape(_text(entry.get(key))) for key in columns)])
                 + "</td></tr>" for name, entry in rows.items()]
        heads = "".join(f"<th>{column}</th>" for column in ("", *columns))
        return f"<table><caption>{escape(self.scene.title)}</caption><tr>{heads}</tr>{''.join(cells)}</table>"

    @cached_property
    def _data(self) -> dict[str, Any]:
        return self.json()

    def results_of_kind(self, kind: str) -> dict[str, Any]:
        """Results of a kind by name, in the units of the scene; nan if one does not exist."""
        printed = kind_of(kind)
        return {name: _number(entry and entry.get(printed.key), vector=not printed.single)
                for name, entry in self._data.get(printed.table, {}).items()
                if entry is None or printed.key in entry or printed == kinds.POLE}


def _number(value: Any, vector: bool = False) -> Any:
    """A number or a vector of the JSON: floats, or fractions where it has strings."""
    if value is None:
        return NOWHERE if vector else float("nan")
    if isinstance(value, list):
        x, y = map(_number, value)
        return complex(x, y) if isinstance(x, float) and isinstance(y, float) else (x, y)
    return Fraction(value) if isinstance(value, str) else float(value)


def _text(value: Any) -> str:
    """A number or vector in a table."""
    if isinstance(value, list):
        return ", ".join(map(_text, value))
    return "" if value is None else value if isinstance(value, str) else f"{value:.6g}"


def solve(scene: Scene, *, exact: bool = False, digits: int | None = None, bounds: bool = False,
          **options: Unpack[Keywords]) -> Results:
    """The velocities, accelerations and forces that a scene asks for, constructed and compared with the solver.

    Reads a scene, and as keywords how it is drawn (`method`, `plan`, `inertia`, `prefer`, `pencil`, `rounds`); with
    `exact` the numbers are fractions, with `digits` there are so many proven ones, with `bounds` a proven bound for
    each. Gives :class:`Results`, in the scene's units, rad and s.
    Fails with `SingularPose` where nothing that is asked for exists, with `Disagreement` where every construction
    differs from the solver, and with `Refused` where exact numbers meet an irrational scene.
    """
    return find_results(with_sheet(scene, options), exact=exact, digits=digits, bounds=bounds,
                        errors=bool(options.get("pencil")))


def find_results(scene: Scene, *, exact: bool = False, digits: int | None = None, bounds: bool = False,
                 errors: bool = False) -> Results:
    """Solve a scene; with the `errors` that its pencil makes."""
    if digits is not None:
        return Results(scene, as_json(_certified_data(scene, digits, exact), 2))
    return Results(scene, as_json(_data(scene, exact, bounds, errors), 2))


def _data(scene: Scene, exact: bool, bounds: bool, errors: bool) -> dict[str, Any]:
    """JSON data of a scene's results."""
    from graphplan.check.answerable import report_regular_part
    from graphplan.check.json_results import result_data
    from graphplan.mechanism.replaced import scene_beyond

    def report(scene: Scene) -> Report:
        return make_report(scene, exact=exact, alone=not errors)

    regular = report_regular_part(scene, report)
    printed = result_data(regular, each=bounds)
    if errors:
        from graphplan.accuracy.drafted import draft

        printed["pencil"] = draft(regular.drawing, pencil(scene), check=regular.check).data
    if after := scene_beyond(regular.scene):
        after_data = result_data(report(after))
        printed["beyond"] = {section: after_data[section] for section in ("points", "links", "slides")}
    return printed


def _certified_data(scene: Scene, digits: int, exact: bool) -> dict[str, Any]:
    """JSON data of a scene's results with proven bounds."""
    from graphplan.kernel.faithful import has_flint

    if exact:
        raise Refused("--digits", "--exact already gives every digit", "leave out one of the two")
    if not has_flint():
        raise missing_package("--digits", "python-flint", "certified")
    from graphplan.check.answerable import report_regular_part
    from graphplan.check.certified import Certified, certify

    def proven(scene: Scene) -> Certified:
        return certify(scene, digits, wishes_of(scene)[0])

    report = report_regular_part(scene, proven)
    if not report.agrees:
        raise report.disagreement
    return report.data
