"""Record of this leaf, by which the core finds it: cams from the law of their follower."""

from graphplan.leaves import Command, Leaf, TaskKind
from graphplan.phrases import said

LEAF = Leaf(
    commands={"cam": Command("machine", "graphplan.cams.command", takes_scene=False)},
    names={"graphplan.cams.subject": "cam"},
    tasks={"cam": TaskKind(("law",), "cam", said("Keys of a cam"), "graphplan.cams.task")},
)
