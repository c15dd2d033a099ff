"""Record of this leaf, by which the core finds it: constructions for geometry programs, TeX and CAD, and as code."""

from graphplan.leaves import Command, Format, Leaf
from graphplan.phrases import said

LEAF = Leaf(
    commands={"export": Command("share", "graphplan.exports.command")},
    formats={
        "ggb": Format(".ggb", said("GeoGebra, 4.0 and later"), "graphplan.exports.geogebra", "geogebra", "plates"),
        "tikz": Format(".tex", said("LaTeX with TikZ"), "graphplan.exports.tikz", "tikz", "composition"),
        "c": Format(".c", said("the numbers in C99, over arrays of poses"), "graphplan.exports.code", "c",
                    "construction"),
        "js": Format(".js", said("the numbers in JavaScript, in one pose or many"), "graphplan.exports.code",
                     "javascript", "construction"),
    "dxf": Format(".dxf", said("the mechanism 1:1 and the sheet, for CAD"), "graphplan.exports.dxf", "dxf",
                  "sheets on plates", "dxf"),
    },
    sheets={".tex": "graphplan.exports.latex"},
)
