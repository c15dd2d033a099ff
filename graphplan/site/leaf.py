"""Record of this leaf, by which the core finds it: the gallery of the packaged scenes, a small site with the manual."""

from graphplan.leaves import Command, Leaf

LEAF = Leaf(commands={"gallery": Command("share", "graphplan.site.gallery", takes_scene=False)})
