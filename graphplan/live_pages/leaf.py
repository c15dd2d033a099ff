"""Record of this leaf, by which the core finds it: pages for a browser, on which the mechanism is dragged."""

from graphplan.leaves import Command, Leaf

LEAF = Leaf(
    commands={"live": Command("share", "graphplan.live_pages.command")},
    names={"graphplan.live_pages.scene_page": "live"},
    pages={".html": "graphplan.live_pages.scene_page"},
)
