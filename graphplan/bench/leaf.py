"""Record of this leaf, by which the core finds it: a command that charts speed against accuracy."""

from graphplan.leaves import Command, Leaf

LEAF = Leaf(commands={"chart": Command("share", "graphplan.bench.command", takes_scene=False)})
