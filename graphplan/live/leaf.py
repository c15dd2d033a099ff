"""What this leaf adds: pages for a browser, on which the mechanism is dragged and the construction follows."""

from graphplan.leaves import Command, Leaf

LEAF = Leaf(
    commands={"live": Command("share", "graphplan.live.command")},
    names={"graphplan.live.scene_page": "live"},
    pages={".html": "graphplan.live.scene_page"},
)
