"""The numbers by which a sheet is laid out, in one table: each with its unit, what it means and how it was found.

A name says the quantity and the unit: `_MM` are millimetres of paper, `_SHARE` a part of what is named; `MAX_` and
`MIN_` are limits. How a number was found stands at its end:

- [measured] on the packaged scenes and 90 random ones: with it papers are smallest at as many letters in good places;
- [practice] it is what a ruler, a pencil or an eye can tell;
- [assumed] it was written so; nothing in the code or its history shows how it was found.
"""

from __future__ import annotations

import math

# ---- which paper ----------------------------------------------------------------------------------------------------

# Results that are too far off, or letters without a place, ask for no larger paper than the usual.
USUAL_PAPERS = (  # paper, for up to so many moving links and plans [measured]
    ("A4", 3, 5), ("A3", 7, 8), ("A2", math.inf, 12), ("A1", math.inf, math.inf))
MAX_ERROR_SHARE = 0.1  # of the largest value of its kind: a result may be so far off, on paper below usual [measured]
MAX_POOR_SHARE = 0.08  # of the letters that may find no good place, on paper smaller than usual [measured]
MAX_POOR_SHARE_ON_A4 = 0.25  # the same on A4 where that is usual [measured]
MAX_POOR_SHARE_ON_USUAL = 0.7  # the same on other usual paper, or where paper or scales are named [assumed]
LARGEST_PAPERS = "A1", "A0"  # papers on which any part of the letters may find no good place [assumed]
USUAL_PANEL_MM = 200.0, 150.0  # mm: a panel, at whose scales facts and words get their room [assumed]

# ---- how large plans are --------------------------------------------------------------------------------------------

MIN_LINK_MM = 4.5  # mm: a link shorter than this has no room for letters [practice]
MIN_VECTOR_MM = 5.0  # mm: the shortest vector that can be measured with a ruler [practice]
SHORT_VECTOR_PRICE = 0.2  # of a scale's logarithm, given up for a vector that can be measured [measured]
READING_ORDER_PRICE = 0.2  # the same for results that are read after what is given [measured]

# ---- panels ---------------------------------------------------------------------------------------------------------

CAPTION_MM, CAPTION_SIDE_MM = 11.0, 2.5  # mm: a panel's caption strip, and what is free beside its text [practice]
PANEL_EDGE_MM = 0.5  # mm of a panel on each side of its room [practice]
MARGIN_MM = 9.0  # mm: kept free for letters around a panel's figure [practice]
