"""Record of this leaf, by which the core finds it: scenes from the files of other programs."""

from graphplan.leaves import Command, Leaf

LEAF = Leaf(commands={"import": Command("describe", "graphplan.importing.command", takes_scene=False)})
