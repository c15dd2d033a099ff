"""Poses around the travel of a mechanism's drive, and what a construction gives in them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

from graphplan.mechanism.frozen import Frozen, NamedValues
from graphplan.mechanism.travel import printed_travels
from graphplan.methods.kinds import KINDS
from graphplan.methods.recorded import NamedResults

if TYPE_CHECKING:
    from graphplan.cycle.turn import Turn
    from graphplan.mechanism.model import Scene
    from graphplan.methods.construction import Construction


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
        return _read_only(printed_travels(self.scene, self.turn.travel))

    @cached_property
    def points(self) -> Frozen[str, Any]:
        return NamedValues({name: _read_only(z) for name, z in self.turn.points.items()}, "place")

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
class MotionSeries(NamedResults):
    """What a construction gives in n poses: by name complex arrays of shape (n,) for vectors, real ones for numbers.

    `faults` says by the pose's place why there is nothing, where all is nan. `poses` are those of `gp.follow`, if they
    are.
    """

    scene: Scene
    n: int
    results: Mapping[str, Mapping[str, Any]]
    faults: Mapping[int, str]
    points: Mapping[str, Any]
    poses: PoseSeries | None = None

    def results_of_kind(self, kind: str) -> dict[str, Any]:
        return dict(self.results.get(kind, {}))

    def zero(self) -> Any:
        import numpy as np

        return _read_only(np.zeros(self.n, dtype=complex))

    def table(self, *names: str) -> dict[str, Any]:
        """Columns by name, each of shape (n,), as pandas.DataFrame takes them: `travel`, and of points, links and
        slides (without names of all) such as C.x, C.vx, C.ax, 3.omega, 3.alpha.

        Fails with `KeyError` where nothing of a name was asked for.
        """
        columns: dict[str, Any] = {"travel": self.poses.travel} if self.poses is not None else {}
        known = [*self.points, *(name for named in self.results.values() for name in named)]
        if unknown := [name for name in names if name not in known]:
            raise KeyError(f"nothing of {unknown[0]} was asked for, but of {', '.join(dict.fromkeys(known))}")
        for name in dict.fromkeys(names or [of for named in self.results.values() for of in named]):
            if name in self.points:
                columns |= _components(f"{name}.", self.points[name])
            for kind, named in self.results.items():
                if name in named:
                    way, letter = KINDS[kind].way, KINDS[kind].dimension.letter
                    columns |= _components(f"{way} {name}.{letter}".strip(), named[name])
        return columns

    def __repr__(self) -> str:
        singular = f"; {len(self.faults)} without results" if self.faults else ""
        return f"<Motion of {self.scene.title or self.scene.name} in {self.n} poses{singular}>"


def _components(heading: str, z: Any) -> dict[str, Any]:
    """A real column, or the two of a complex one."""
    return {f"{heading}x": z.real, f"{heading}y": z.imag} if z.dtype.kind == "c" else {heading: z}


def _read_only(array: Any) -> Any:
    """An array that cannot be written to."""
    view = array.view()
    view.flags.writeable = False
    return view


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


def evaluate(drawing: Construction, poses: PoseSeries | Mapping[str, Any], guides: Mapping[str, Any] | None = None,
             loads: Mapping[str, Any] | None = None, **how: Any) -> MotionSeries:
    """A construction over poses, which are those of `follow` or points as arrays; see `WorkingDrawing.evaluate`."""
    from graphplan.methods.construction import Construction

    series = poses if isinstance(poses, PoseSeries) else None
    if isinstance(poses, PoseSeries):
        turn = poses.turn
        places, guides, loads = turn.points, guides or turn.guides, loads or turn.loads
    else:
        places = dict(poses)
    motion = Construction.evaluate(drawing, places, guides, loads=loads, **how)
    faults = motion.faults | (dict(series.faults) if series else {})
    results = {kind: {name: _read_only(z) for name, z in named.items()} for kind, named in motion.results.items()}
    return MotionSeries(motion.scene, motion.n, results, Frozen(dict(sorted(faults.items()))),
                        Frozen({name: _read_only(z) for name, z in places.items() if hasattr(z, "view")}), series)
