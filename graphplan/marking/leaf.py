"""Record of this leaf, by which the core finds it: the tasks of a class, and verdicts on what its students hand in."""

from graphplan.leaves import Command, Leaf

LEAF = Leaf(
    commands={
        "variants": Command("teach", "graphplan.marking.commands.variants"),
        "verify": Command("teach", "graphplan.marking.commands.verify"),
    },
    names={"graphplan.marking.classroom.class_variants": "variants", "graphplan.marking.verifying": "Findings verify"},
    results=("verify",),
)
