"""The force polygons of a machine with friction, of which the reactions of the last round are read, too."""

from __future__ import annotations

from graphplan.mechanism import units
from graphplan.mechanism.model import Scene
from graphplan.methods.construction import Construction
from graphplan.methods.forces.free_bodies import DrawnForces, reaction_on
from graphplan.methods.forces.friction import rubbing
from graphplan.methods.forces.groups import ForceTransfer
from graphplan.methods.forces.loaded import Loaded
from graphplan.methods.forces.loading import Loading
from graphplan.methods.kinds import ResultKind
from graphplan.methods.motion.alternatives import ways
from graphplan.methods.motion.network import Network
from graphplan.methods.panels import JointForce
from graphplan.methods.styles import Style
from graphplan.phrases import said

RUBBED_REACTION = ResultKind(said("reaction with friction"), units.FORCE, pair=True)


class RubbedForces(Loaded):
    """Draws one scene with its forces by polygons, and reads what the pairs that rub bear in the last round."""

    def note_rubbed(self, loading: Loading, forces: DrawnForces) -> None:
        """Keep the balances with friction, and the reactions of journals and slides that rub."""
        super().note_rubbed(loading, forces)
        for journal in rubbing(loading.net.scene, forces):
            point = journal.point if journal.point in forces.scene.points else journal.friction.at
            self.read(RUBBED_REACTION, JointForce(journal.friction.at, journal.link).name,
                      *reaction_on(forces, self.board, point, journal.link))
        leaning = {frozenset(friction.links) for friction in self.loads.frictions if friction.coefficient}
        for slide in self.scene.slides:
            if frozenset(slide.links) in leaning and slide in forces.slides:
                self.read(RUBBED_REACTION, slide.name, *forces.slides[slide])


def rubbed_drawing(scene: Scene, method: str = "") -> Construction:
    """The polygons of a scene with friction, drawn by the best way of its motion, by a method if one is named."""
    plans = ForceTransfer(scene)
    return next(ways(Network(scene), method, lambda planner: RubbedForces(
        scene, planner, Style(lever=False), plans).draw()))[0]
