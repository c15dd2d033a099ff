"""Constructions as users have them: checked, saved as sheets, shown in notebooks, replayed over a cycle.

Poses around the travel of a mechanism's drive, and what a construction gives in them: all at once, or in any number in
the memory of one block.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, Unpack

from graphplan.app import files
from graphplan.app.drafting import Keywords, with_sheet
from graphplan.check.cycle import efficiency_of, requested_points
from graphplan.check.stream import PoseBlock, Stream, Summary
from graphplan.mechanism.model import Frozen, NamedValues
from graphplan.mechanism.travel import printed_travels
from graphplan.methods.construction import Construction
from graphplan.methods.results import NamedResults, axes, facts, forces
from graphplan.output.tables import Columns, csv_head, csv_rows, pose_columns, sizes_and_directions

if TYPE_CHECKING:
    from graphplan.cycle.turn import Turn
    from graphplan.mechanism.model import Scene

@dataclass(frozen=True, eq=False, repr=False)
class WorkingDrawing(Construction):
    """A construction of a scene: ordered steps, each with what it draws, from what, with which instrument, and why.

    `velocity`, `acceleration`, `omega`, `alpha`, `reactions` and `curvature` are mappings by name, in scene units,
    vectors as complex numbers. `given_scene` is what it was drawn from.
    """

    given_scene: Scene | None = None

    def save(self, path: str | os.PathLike[str], *, until: str = "", steps: str = "", strip: str = "", by: str = "",
             numbers: bool = False, dpi: int | None = None, **options: Unpack[Keywords]) -> None:
        """Write the sheet by the ending of its path (.svg, .pdf, .png, .dxf), byte for byte as `graphplan draw` does.

        `until` a step, `steps` such as "6-12", a `strip` by "mark" or "step", `by` "stages", `numbers` and `dpi` are
        the options of `draw`; further keywords say how it is drawn (plan="polar") and what the sheet looks like
        (paper="A3", language="de"). Fails with `Refused` where it cannot be drawn or written so.
        """
        from graphplan.app.pages import save_sheet

        save_sheet(with_sheet(self.given_scene or self.scene, options), os.fspath(path), until=str(until), steps=steps,
                   strip=strip, by=by, numbers=numbers, dpi=dpi)

    def evaluate(self, poses: PoseSeries | Mapping[str, Any] | None = None,  # type: ignore[override]
                 guides: Mapping[str, Any] | None = None, *, points: Mapping[str, Any] | None = None,
                 loads: Mapping[str, Any] | None = None, only: Collection[str] | None = None, workers: int | str = 1,
                 compiled: bool = False, progress: Callable[[int, int], None] | None = None) -> MotionSeries:
        """Evaluate the steps in n poses: those of `gp.follow`, or `points` as complex arrays of shape (n,).

        Gives velocities and the like as arrays of shape (n,), nan where a pose is singular or not reached, and `faults`
        by the pose's place. `guides`, `loads`, `only`, `workers`, `compiled` and `progress` are those of
        :meth:`Construction.evaluate`.
        """
        series = poses if isinstance(poses, PoseSeries) else None
        places: Mapping[str, Any] = points or {}
        if series:
            places, guides, loads = series.turn.points, guides or series.turn.guides, loads or series.turn.loads
        elif poses is not None:
            places = dict(poses)  # type: ignore[arg-type]
        motion = super().evaluate(places, guides, loads=loads, only=only, workers=workers, compiled=compiled,
                                  progress=progress)
        faults = motion.faults | (dict(series.faults) if series else {})
        results = {kind: {name: read_only(z) for name, z in named.items()} for kind, named in motion.results.items()}
        return MotionSeries(motion.scene, motion.n, results, Frozen(dict(sorted(faults.items()))),
                            Frozen({name: read_only(z) for name, z in places.items() if hasattr(z, "view")}), series)

    def array_function(self, *names: str, only: Collection[str] | None = None,
                       ) -> Callable[[Mapping[str, tuple[Any, Any]]], dict[str, dict[str, Any]]]:
        """Return the steps as a function of the places of the points and guides of these names; others stand still.

        It reads x and y by name, as arrays of one library that speaks the array API (numpy, CuPy, JAX), and gives the
        results, all or `only` of some kinds, by kind and name: x and y of vectors, one array of numbers, in scene units
        and doubles, nan where a pose is singular. It has no branches, so jax.grad and jax.jit take it.
        Fails with `Refused` where no drawn point or guide of a name moves.
        """
        from graphplan.methods.replay import function_of

        return function_of(self, names, only)

    def stream(self, positions: int, span: tuple[float, float] | None = None, *, only: Collection[str] | None = None,
               checked: bool = True, compiled: bool = False, workers: int | str = 1) -> MotionStream:
        """Evaluate the steps in any number of poses of the drive's travel, block by block: :class:`MotionStream`.

        Poses, `span` and `compiled` are those of `gp.follow`, `only` is that of `evaluate`: without it all that is
        asked for is computed. `workers` processes, or a dask scheduler by its address, share the poses out. What is
        not `checked` is not compared with the analytic solver, which takes most of the time. Fails with `Refused`
        where there are no positions, or a kind of `only` is not asked for.
        """
        return MotionStream(Stream(self, positions, span, only, checked, compiled), workers)

    def _repr_svg_(self) -> str:
        """The sheet of a construction, drawn when a notebook asks."""
        from graphplan.app.pages import sheet_files

        return str(sheet_files(self.given_scene or self.scene, None, "svg").contents[0][1])


def construct(scene: Scene, *, checked: bool = True, **options: Unpack[Keywords]) -> WorkingDrawing:
    """The construction of what a scene asks for, compared with the analytic solver unless `checked` is False.

    Keywords say how: `method` names the form of loci and rings (auxiliary, trial or poles) or of centres of curvature;
    without it the pose chooses, and the construction says why. `plan` is orthogonal or polar, and for forces lever,
    polygons or both, such as "polar,lever". `inertia` is the form of inertia forces, as `[sheet] inertia`;
    `strict` draws with compasses and straightedge alone; `prefer` weighs forms: quick, accurate or balanced; so many
    `rounds` of friction are drawn. A construction that has no numbers in this pose shows that when they are read.
    Fails with `Disagreement` where every way to draw it differs from the solver, with `SingularPose` where there are
    numbers and what is asked does not exist, and with `Refused` where no move of the planner reaches it.
    """
    from graphplan.app.drafting import wishes_of
    from graphplan.check.trusted import construct as trusted

    scene = with_sheet(scene, options)
    wishes, reasons = wishes_of(scene)
    drawing = trusted(scene, wishes, checked=checked)
    drawing.notes.extend(reasons)
    values = {item.name: getattr(drawing, item.name) for item in fields(drawing)}
    return WorkingDrawing(**values, given_scene=scene)


def follow(scene: Scene, positions: int, span: tuple[float, float] | None = None, *, compiled: bool = False,
           progress: Callable[[float], None] | None = None) -> PoseSeries:
    """The scene's points in so many poses of its drive's travel, each followed from the given pose on its branch.

    Reads a scene with a drive, and the span of the first drive's travel, in degrees (in lengths where it slides), both
    ends included; without one it is a full turn, whose end is left out. `compiled`, they are placed by machine code,
    where numba is installed. Gives :class:`PoseSeries`.
    Fails with :class:`Refused` where no drive leads, and with :class:`SceneError` where the drives leave links loose.
    """
    from graphplan.cycle.turn import follow as turn

    return PoseSeries(scene, turn(scene, positions, span, progress, compiled))


# ---- poses, and what a construction gives in them: all at once, or block by block ------------------------------------


@dataclass(frozen=True, repr=False)
class PoseSeries:
    """n poses of a mechanism, each followed from the given one without changing branch.

    `travel` of the first drive in its sense, real of shape (n,), in degrees, or in lengths of one that slides;
    `points` by name, complex of shape (n,), nan where a pose is not reached; `faults` by the pose's place: why. After
    a full turn of a `closed` motion all is as it was.
    """

    scene: Scene
    turn: Turn = field(repr=False)

    @cached_property
    def travel(self) -> Any:
        return read_only(printed_travels(self.scene, self.turn.travel))

    @cached_property
    def points(self) -> Frozen[str, Any]:
        return NamedValues({name: read_only(z) for name, z in self.turn.points.items()}, "place")

    @cached_property
    def faults(self) -> Frozen[int, str]:
        return Frozen(self.turn.faults)

    @property
    def closed(self) -> bool:
        return self.turn.closed

    def __len__(self) -> int:
        return len(self.turn.travel)

    def __repr__(self) -> str:
        lost = f"; {len(self.faults)} not reached" if self.faults else ""
        return f"<{len(self)} poses of {self.scene.title or self.scene.name}{lost}>"


@dataclass(frozen=True, repr=False)
class MotionSeries(NamedResults[Any, Any]):
    """Results of a construction in n poses: by name complex arrays of shape (n,) for vectors, real ones for numbers.

    `faults` has, by the pose's place, the reason for a pose of nan. `poses` are those of `gp.follow`, if given.
    """

    scene: Scene
    n: int
    results: Mapping[str, Mapping[str, Any]]
    faults: Mapping[int, str]
    points: Mapping[str, Any]
    poses: PoseSeries | None = None

    def results_of_kind(self, kind: str) -> dict[str, Any]:
        return dict(self.results.get(kind, {}))

    def _zero(self) -> Any:
        import numpy as np

        return read_only(np.zeros(self.n, dtype=complex))

    @cached_property
    def efficiency(self) -> Any:
        """The instantaneous efficiency in each pose of a motion; None of a machine without friction."""
        return efficiency_of(self.scene, self.poses.turn, self.results) if self.poses is not None else None

    def table(self, *names: str) -> dict[str, Any]:
        """Columns by name, each of shape (n,), as pandas.DataFrame takes them: `travel`, and of points, links and
        slides (without names of all) such as C.x, C.vx, C.ax, 3.omega, 3.alpha; of forces the sizes and directions as
        well, such as `2 at B.size`, and the efficiency.

        Fails with `KeyError` where nothing of a name was asked for.
        """
        columns: dict[str, Any] = {"travel": self.poses.travel} if self.poses is not None else {}
        known = [*self.points, *(name for named in self.results.values() for name in named)]
        if unknown := [name for name in names if name not in known]:
            raise KeyError(f"nothing of {unknown[0]} was asked for, but of {', '.join(dict.fromkeys(known))}")
        for name in dict.fromkeys(names or [of for named in self.results.values() for of in named]):
            if name in self.points:
                columns |= {f"{name}.{axis}": z for axis, z in axes(self.points[name]).items()}
            for fact in facts(self.results):
                columns |= fact.columns if fact.of == name else {}
        for kind, named in sizes_and_directions(forces(self.scene, self.results)).items():
            columns |= {f"{name}.{kind}": z for name, z in named.items() if not names or name in names}
        return columns | ({} if names or self.efficiency is None else {"efficiency": self.efficiency})

    def __repr__(self) -> str:
        singular = f"; {len(self.faults)} without results" if self.faults else ""
        return f"<Motion of {self.scene.title or self.scene.name} in {self.n} poses{singular}>"


def read_only(array: Any) -> Any:
    """An array that cannot be written to."""
    view = array.view()
    view.flags.writeable = False
    return view


@dataclass(frozen=True, repr=False)
class MotionStream:
    """n poses of a construction, of which one block at a time is in memory: as series, as what all come to, as a file.

    Each is compared with the analytic solver, unless that was left out; where a pose differs, is singular or is not
    reached, there is nan and a fault that says why.
    Processes and dask's workers are told the construction once, then ranges of poses, and give back no more than is
    kept of them; they start by importing the calling script, whose work therefore stands under
    `if __name__ == "__main__":`.
    """

    stream: Stream
    workers: int | str = 1

    def __len__(self) -> int:
        return self.stream.positions

    def __iter__(self) -> Iterator[MotionSeries]:
        """Neighbouring poses as series, one after the other, `faults` by the place in each."""
        return map(self._series, self.stream.blocks(self.workers))

    def summary(self) -> Summary:
        """The extremes of each result, of vectors of their lengths, such as `summary.results["velocity"]["C"].greatest`
        and `.greatest_at`, the mean, and how many poses have a fault, the first of them with its place."""
        return self.stream.summary(self.workers)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write a table as its rows come, whole or not at all: the comma-separated text of `graphplan cycle` (.csv).

        Fails with `Refused` where it cannot be written so.
        """
        files.kind(os.fspath(path), (".csv",), "table")
        files.write(self._csv_parts(), os.fspath(path))

    def _csv_parts(self) -> Iterator[bytes]:
        yield csv_head(_columns(self.stream, replace(self.stream, length=0).block(0))).encode()
        yield from self.stream.shared_out(_rows, self.workers)

    def _series(self, block: PoseBlock) -> MotionSeries:
        scene, count = self.stream.drawing.scene, len(block.turn.travel)
        poses, faults = PoseSeries(scene, block.turn), {at - block.start: why for at, why in block.faults.items()}
        return MotionSeries(scene, count, block.results, Frozen(faults), poses.points, poses)


def _columns(of: Stream, block: PoseBlock) -> Columns:
    scene = of.drawing.scene
    return [*pose_columns(scene, block.turn.travel, requested_points(scene, block.turn), block.results,
                          efficiency_of(scene, block.turn, block.results))]


def _rows(of: Stream, start: int) -> bytes:
    """The rows of a block, as workers send them."""
    block = of.block(start)
    return csv_rows(_columns(of, block), block.faults, block.start).encode()
