"""The trusted construction: drawn, compared with the analytic solver, and taken another way where the two differ.

Both opinions are reckoned in floats with proven bounds. Where these do not prove nine digits of each number, or the two
differ by more than rounding, the next better arithmetic is taken: enclosures of more and more digits, then fractions. A
construction that is proven to differ is given up for one that goes another way.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import islice
from typing import Any, TypeVar

from graphplan.check.bench import WAYS, Bench
from graphplan.check.report import Report
from graphplan.errors import ConstructionError, Refused, SingularPose, by_name
from graphplan.kernel.numbers.floats import Floats
from graphplan.mechanism.model import Scene
from graphplan.methods.construct import constructions
from graphplan.methods.construction import Construction
from graphplan.solver import solve

Judged = TypeVar("Judged", bound=Report)


def construct(scene: Scene, *, method: str = "", plan: str = "", strict: bool = False, inertia: str = "couple",
              checked: bool = True) -> Construction:
    """The construction of what the scene asks for, compared with the analytic solver unless `checked` is False.

    `method` names the form of loci and rings (auxiliary, trial or poles); without it the pose chooses, and the
    construction says why. `plan` is orthogonal or polar, and for forces lever, polygons or both, such as "polar,lever".
    `inertia` is the form of inertia forces: couple, shifted or points; `strict` draws with compasses and straightedge
    alone. A construction that has no numbers in this pose shows that when they are read, and may have some in others.
    Fails with `Disagreement` where every way to draw it differs from the solver, with `SingularPose` where there are
    numbers and what is asked does not exist, and with `Refused` where no move of the planner reaches it.
    """
    how: dict[str, Any] = {"method": method, "plan": plan, "strict": strict, "inertia": inertia}
    if not checked:
        return next(constructions(scene, **how))
    try:
        return report(scene, **how).drawing
    except (SingularPose, ConstructionError):
        drawing = next(constructions(scene, **how))
        if _readable(drawing):
            raise
        return drawing


def _readable(drawing: Construction) -> bool:
    """Whether floats give a construction any numbers."""
    try:
        return bool(drawing.read(Floats()))
    except ConstructionError:
        return False


def report(scene: Scene, *, exact: bool = False, method: str = "", plan: str = "", strict: bool = False,
           inertia: str = "couple", refuse: bool = True, alone: bool = False) -> Report:
    """The first construction that agrees with the solver, with its numbers; `exact` asks for fractions.

    Where journals rub, which depends on the sizes of reactions, friction is left out of exact numbers. Fails as
    `construct` does, with `SingularPose` naming the links and the lines that should meet, and with `Refused` where
    `exact` meets an irrational scene; unless `refuse` says otherwise, with `Disagreement` where no way agrees: else
    that is the report's to tell.
    With `alone` it is the solver's own numbers where no way can be drawn though the pose is regular.
    """
    if exact and scene.irrational:
        irrational = ", ".join(sorted(scene.irrational, key=by_name))
        raise Refused(f"{scene.name}: {irrational}", "fractions cannot hold this", "leave out --exact")
    if exact and scene.loads is not None and any(friction.at for friction in scene.loads.frictions):
        scene = replace(scene, loads=replace(scene.loads, frictions=()))
    how: dict[str, Any] = {"method": method, "plan": plan, "strict": strict, "inertia": inertia}
    bench = Bench(scene, how, exact)
    try:
        found = first_sound(scene, how, bench.judged)
    except Refused:
        solve(scene, exact)  # where the pose is singular, that is why nothing can be drawn
        raise
    if isinstance(found, Report):
        if refuse and not found.agrees:
            raise found.disagreement
        return found
    if alone and not exact:
        return bench.alone(*found)
    raise found[1]


def first_sound(scene: Scene, how: dict[str, Any], judged: Callable[[Construction], Judged],
                ) -> Judged | tuple[Construction, ConstructionError]:
    """The first construction that is judged to agree with the solver, else the first that is drawn.

    Where none can be drawn in this pose, the first with its error; fails with `Refused` where there is none at all.
    """
    wrong: Judged | None = None
    undrawn: tuple[Construction, ConstructionError] | None = None
    try:
        for drawing in islice(constructions(scene, **how), WAYS):
            try:
                found = judged(drawing)
            except ConstructionError as error:
                undrawn = undrawn or (drawing, error)
                continue
            if found.agrees:
                return found
            wrong = wrong or found
    except Refused as refused:
        if wrong is None and undrawn is None:
            raise Refused(f"{scene.name}: {refused.what}", refused.why, refused.do) from None
    found_or_not = wrong or undrawn
    assert found_or_not is not None
    return found_or_not
