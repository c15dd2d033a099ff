"""The numbers of a scene's pose: those of the construction, compared with the analytic solver."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any, Unpack

from graphplan.errors import Refused
from graphplan.mechanism.frozen import Frozen, NamedValues
from graphplan.mechanism.pairs.pair import FRAME
from graphplan.public.drafting import Keywords, Options, options_of
from graphplan.public.files import as_json, kind, write

if TYPE_CHECKING:
    from graphplan.check.report import Report
    from graphplan.mechanism.model import Scene

NOWHERE = complex("nan+nanj")
ENDINGS = (".json",)


@dataclass(frozen=True, repr=False)
class Results:
    """What `solve` finds: velocities, accelerations, rates, poles and forces, in the scene's units.

    Vectors are complex numbers, or pairs of fractions where the numbers are exact. Mappings by name have what was
    asked for; velocity and acceleration of a fixed point are 0, and any other name is a `KeyError` that says which
    were asked for. What does not exist in the pose is nan (of fractions None), and `reasons` says why.
    """

    scene: Scene
    text: str

    @property
    def velocity(self) -> NamedValues[Any]:
        """The velocities of points, by name."""
        return self._of_points("velocity")

    @property
    def acceleration(self) -> NamedValues[Any]:
        """The accelerations of points, by name."""
        return self._of_points("acceleration")

    @property
    def omega(self) -> NamedValues[Any]:
        """The angular velocities of links in rad/s, counter-clockwise positive, by name."""
        return self._named_values("links", "omega", "angular velocity", {FRAME}, 0.0)

    @property
    def alpha(self) -> NamedValues[Any]:
        """The angular accelerations of links in rad/s^2, by name."""
        return self._named_values("links", "alpha", "angular acceleration", {FRAME}, 0.0)

    @property
    def sliding_velocity(self) -> NamedValues[Any]:
        """The velocities of sliding points relative to their guides, by slide, such as `3 along 2`."""
        return self._named_values("slides", "velocity", "sliding velocity")

    @property
    def sliding_acceleration(self) -> NamedValues[Any]:
        """The accelerations of sliding points relative to their guides, by slide."""
        return self._named_values("slides", "acceleration", "sliding acceleration")

    @property
    def poles(self) -> NamedValues[Any]:
        """The instant centres, such as `2 frame`; nan of one that lies at infinity, or does not exist."""
        return self._named_values("poles", "at", "pole")

    @property
    def curvature(self) -> NamedValues[Any]:
        """The centres of curvature of paths, such as that of `M on 2`; nan where the path is straight."""
        return self._named_values("curvature", "centre", "centre of curvature")

    @property
    def balance(self) -> Any:
        """What keeps the motion: a moment in force * m, or a force; several as a tuple, None where none is asked for.
        """
        balances = self._data.get("balance")
        if balances is None:
            return None
        values = tuple(_number(entry.get("moment", entry.get("force")))
                       for entry in (balances if isinstance(balances, list) else [balances]))
        return values[0] if len(values) == 1 else values

    @property
    def reactions(self) -> NamedValues[Any]:
        """The reactions: the force on a link at a joint, such as `2 at B`, on the first link of a slide, gear or
        contact by its name."""
        def name(entry: Mapping[str, Any]) -> str:
            return next((entry[sort] for sort in ("slide", "gear", "contact") if sort in entry),
                        f"{entry['on']} at {entry.get('at')}")

        return NamedValues({name(entry): _number(entry["force"], vector=True)
                            for entry in self._data.get("reactions", ())}, "reaction")

    @property
    def reasons(self) -> Frozen[str, Mapping[str, str]]:
        """Why what was asked for does not exist in the pose, by the key of the JSON and the name."""
        return Frozen(self._data.get("reasons", {}))

    @property
    def check(self) -> Frozen[str, float]:
        """The largest difference from the analytic solver, relative to what a number is made of, by kind."""
        return Frozen(self._data.get("check", {}))

    def json(self) -> dict[str, Any]:
        """What `graphplan solve` prints, as JSON reads it."""
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
        columns = ("velocity", "acceleration", "omega", "alpha")
        rows = {**self._data["points"], **self._data["links"]}
        cells = ["<tr><td>" + "</td><td>".join([escape(name), *(escape(_text(entry.get(key))) for key in columns)])
                 + "</td></tr>" for name, entry in rows.items()]
        heads = "".join(f"<th>{column}</th>" for column in ("", *columns))
        return f"<table><caption>{escape(self.scene.title)}</caption><tr>{heads}</tr>{''.join(cells)}</table>"

    @cached_property
    def _data(self) -> dict[str, Any]:
        return self.json()

    def _of_points(self, key: str) -> NamedValues[Any]:
        return self._named_values("points", key, key, self.scene.links.get(FRAME, ()), 0j)

    def _named_values(self, table: str, key: str, what: str, fixed: Any = (), zero: Any = None) -> NamedValues[Any]:
        entries = self._data.get(table, {})
        vector = table != "links"
        return NamedValues({name: _number(entry and entry.get(key), vector) for name, entry in entries.items()
                            if entry is None or key in entry or table == "poles"}, what, fixed, zero)


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
    return find_results(scene, options_of(options), exact=exact, digits=digits, bounds=bounds)


def find_results(scene: Scene, options: Options, *, exact: bool = False, digits: int | None = None,
                 bounds: bool = False) -> Results:
    """The same with options in one record."""
    from graphplan.public.drafting import with_rounds

    scene = with_rounds(scene, options)
    if digits is not None:
        return Results(scene, as_json(_certified_data(scene, options, digits, exact), 2))
    return Results(scene, as_json(_data(scene, options, exact, bounds), 2))


def _data(scene: Scene, options: Options, exact: bool, bounds: bool) -> dict[str, Any]:
    """What is printed of a scene."""
    from graphplan.check.answerable import report_regular_part
    from graphplan.check.json_results import result_data
    from graphplan.mechanism.replaced import scene_beyond
    from graphplan.public.drafting import make_report

    def report(scene: Scene) -> Report:
        return make_report(scene, options, exact=exact, alone=not options.pencil)

    regular = report_regular_part(scene, report)
    printed = result_data(regular, each=bounds)
    if options.pencil:
        from graphplan.accuracy.drafted import draft

        printed["pencil"] = draft(regular.drawing, options.pencil, check=regular.check).data
    if after := scene_beyond(regular.scene):
        after_data = result_data(report(after))
        printed["beyond"] = {section: after_data[section] for section in ("points", "links", "slides")}
    return printed


def _certified_data(scene: Scene, options: Options, digits: int, exact: bool) -> dict[str, Any]:
    """The same between proven bounds."""
    from importlib.util import find_spec

    if exact:
        raise Refused("--digits", "--exact already gives every digit", "leave out one of the two")
    if find_spec("flint") is None:
        raise Refused("--digits", "proven digits need python-flint", "install graphplan[certified]")
    from graphplan.check.answerable import report_regular_part
    from graphplan.check.certified import Certified, certify
    from graphplan.public.drafting import drawn_by

    def proven(scene: Scene) -> Certified:
        how, _ = drawn_by(scene, options)
        return certify(scene, digits, method=how["method"], plan=options.plan, inertia=how["inertia"])

    report = report_regular_part(scene, proven)
    if not report.agrees:
        raise report.disagreement
    return report.data
