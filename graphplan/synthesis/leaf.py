"""Record of this leaf, by which the core finds it: mechanisms found from what they are to do."""

from graphplan.leaves import Command, Leaf, TaskKind
from graphplan.phrases import said

LEAF = Leaf(
    commands={"synthesize": Command("machine", "graphplan.synthesis.command", takes_scene=False)},
    names={"graphplan.synthesis.subject": "SynthesisResults synthesize"},
    tasks={"synthesize": TaskKind(
        ("guidance", "function", "stroke", "cognates", "dwell", "geneva", "conjugate", "gear"),
        "synthesize", said("Keys of a synthesis"),
        "graphplan.synthesis.task", "graphplan.synthesis.subject", packaged=True)},
)
