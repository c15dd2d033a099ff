"""What this leaf adds: pages for a browser, on which the mechanism is dragged and the construction follows."""

from graphplan.leaves import Command, Leaf

LEAF = Leaf(
    commands={"live": Command("share", "graphplan.board.command")},
    names={"graphplan.board.scene_page": "live"},
    pages={".html": "graphplan.board.scene_page"},
)
