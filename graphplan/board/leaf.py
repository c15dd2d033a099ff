"""Record of this leaf, by which the core finds it: pages for a browser, on which the mechanism is dragged."""

from graphplan.leaves import Command, Leaf

LEAF = Leaf(
    commands={"live": Command("share", "graphplan.board.command")},
    names={"graphplan.board.scene_page": "live"},
    pages={".html": "graphplan.board.scene_page"},
)
