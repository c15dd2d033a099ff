"""Constructions as users have them: checked, saved as sheets, shown in notebooks, replayed over a cycle."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING, Any, Unpack

from graphplan.methods.construction import Construction
from graphplan.public.drafting import Keywords, Options, options_of

if TYPE_CHECKING:
    from graphplan.mechanism.model import Scene
    from graphplan.public.poses import MotionSeries, PoseSeries


@dataclass(frozen=True, eq=False, repr=False)
class WorkingDrawing(Construction):
    """A construction of a scene: ordered steps, each with what it draws, from what, with which instrument, and why.

    `velocity`, `acceleration`, `omega`, `alpha`, `reactions` and `curvature` are mappings by name, in scene units,
    vectors as complex numbers. `given_scene` and `options` are what it was drawn from.
    """

    given_scene: Scene | None = None
    options: Options = field(default_factory=Options)

    def save(self, path: str | os.PathLike[str], *, until: str = "", steps: str = "", strip: str = "", by: str = "",
             numbers: bool = False, dpi: int | None = None, **options: Unpack[Keywords]) -> None:
        """Write the sheet by the ending of its path (.svg, .pdf, .png, .dxf), byte for byte as `graphplan draw` does.

        `until` a step, `steps` such as "6-12", a `strip` by "mark" or "step", `by` "stages", `numbers` and `dpi` are
        the options of `draw`; further keywords say how it is drawn (plan="polar") and what the sheet looks like
        (paper="A3", language="de"). Fails with `Refused` where it cannot be drawn or written so.
        """
        from graphplan.public.pages import SheetExcerpt, save_sheet

        chosen = options_of({**{name: value for name, value in vars(self.options).items() if value}, **options})
        excerpt = SheetExcerpt(str(until), steps, strip, by, numbers, dpi)
        save_sheet(self.given_scene or self.scene, os.fspath(path), chosen, excerpt)

    def evaluate(self, poses: PoseSeries | Mapping[str, Any] | None = None,  # type: ignore[override]
                 guides: Mapping[str, Any] | None = None, *, points: Mapping[str, Any] | None = None,
                 loads: Mapping[str, Any] | None = None, only: Collection[str] | None = None, workers: int | str = 1,
                 compiled: bool = False, progress: Callable[[int, int], None] | None = None) -> MotionSeries:
        """The same steps over n poses: those that `gp.follow` gives, or `points` as complex arrays of shape (n,).

        Gives velocities and the like as arrays of shape (n,), nan where a pose is singular or not reached, and `faults`
        by the pose's place. `guides`, `loads`, `only`, `workers`, `compiled` and `progress` are those of
        :meth:`Construction.evaluate`.
        """
        from graphplan.public.poses import evaluate

        return evaluate(self, poses if poses is not None else points or {}, guides, loads, only=only, workers=workers,
                        compiled=compiled, progress=progress)

    def array_function(self, *names: str, only: Collection[str] | None = None,
                       ) -> Callable[[Mapping[str, tuple[Any, Any]]], dict[str, dict[str, Any]]]:
        """The same steps as a function of where the points and guides of these names are; others stand still.

        It reads x and y by name, as arrays of one library that speaks the array API (numpy, CuPy, JAX), and gives the
        results, all or `only` of some kinds, by kind and name: x and y of vectors, one array of numbers, in scene units
        and doubles, nan where a pose is singular. It has no branches, so jax.grad and jax.jit take it.
        Fails with `Refused` where no drawn point or guide of a name moves.
        """
        from graphplan.methods.array_function import function_of

        return function_of(self, names, only)

    def _repr_svg_(self) -> str:
        """The sheet of a construction, drawn when a notebook asks."""
        from graphplan.sheet import svg

        return svg(self)


def construct(scene: Scene, *, checked: bool = True, **options: Unpack[Keywords]) -> WorkingDrawing:
    """The construction of what a scene asks for, compared with the analytic solver unless `checked` is False.

    Keywords say how: `method` names the form of loci and rings (auxiliary, trial or poles) or of centres of curvature;
    without it the pose chooses, and the construction says why. `plan` is orthogonal or polar, and for forces lever,
    polygons or both, such as "polar,lever". `inertia` is the form of inertia forces: couple, shifted or points;
    `strict` draws with compasses and straightedge alone; `prefer` weighs forms: quick, accurate or balanced; so many
    `rounds` of friction are drawn. A construction that has no numbers in this pose shows that when they are read.
    Fails with `Disagreement` where every way to draw it differs from the solver, with `SingularPose` where there are
    numbers and what is asked does not exist, and with `Refused` where no move of the planner reaches it.
    """
    from graphplan.check.trusted import construct as trusted
    from graphplan.public.drafting import drawn_by, with_rounds

    chosen = options_of(options)
    asked = with_rounds(scene, chosen)
    how, reasons = drawn_by(asked, chosen)
    drawing = trusted(asked, checked=checked, **how)
    drawing.notes.extend(reasons)
    values = {item.name: getattr(drawing, item.name) for item in fields(drawing)}
    return WorkingDrawing(**values, given_scene=scene, options=replace(chosen, method=how["method"]))
