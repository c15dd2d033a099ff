"""Any loads on mechanisms with gears and contacts: forces are the solver's as fractions, in any order of writing."""

from __future__ import annotations

from gearings import Gearing, gearing
from loads import loaded_scenes

from graphplan.check.forces import force_truth
from graphplan.errors import SingularPose
from graphplan.kernel.numbers import Fractions
from graphplan.methods import kinds
from graphplan.methods.construct import construct
from graphplan.solver import reactions

GEARINGS = 16


def inclined(seed: int) -> Gearing:
    """A mechanism whose gears have a pressure angle of rational tangent."""
    found = gearing(seed)
    found.slides = [f"{text}\npressure_angle = {{ tangent = 0.36 }}" if "[[gears]]" in text and "belt" not in text
                    else text for text in found.slides]
    return found


def test_forces_of_gears_and_contacts_are_constructed_exactly() -> None:
    """Reactions of all pairs and balances, as fractions; none is left out that is asked for."""
    told = set()
    for seed in range(GEARINGS):
        for scene in loaded_scenes(seed, 1 + seed % 2, inclined):
            if any(gear.direction is None and not sum(gear.factors) for gear in scene.gears):
                break  # a belt over equal wheels is the lever's
            try:
                right, results = reactions(scene, exact=True), construct(scene, plan="polygons").read(Fractions())
            except SingularPose:
                break
            truth = force_truth(scene, results, right)
            wrong = {(kind, name) for kind, named in results.items() if kind in truth
                     for name, value in named.items() if value != truth[kind][name]}
            assert not wrong, (seed, wrong)
            for kind, pairs in ((kinds.GEAR_REACTION, scene.gears), (kinds.CONTACT_REACTION, scene.contacts)):
                asked = {pair.name for pair in pairs if pair.name in (scene.find.reactions or [pair.name])}
                assert results.get(kind, {}).keys() >= (asked if scene.find.reactions != () else set()), seed
            told |= results.keys()
    assert told >= {kinds.GEAR_REACTION, kinds.CONTACT_REACTION}
