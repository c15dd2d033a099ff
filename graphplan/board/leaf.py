"""Record of this leaf, by which the core finds it: a page in a browser on which mechanisms are drawn with the mouse."""

from graphplan.leaves import Command, Leaf

LEAF = Leaf(commands={"board": Command("describe", "graphplan.board.command", takes_scene=False)})
