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

# ---- how plans share a page ------------------------------------------------------------------------------------------

MAX_SHAPES = 8  # shapes of a run of neighbours that are kept [assumed]
SIZE_STEP, MAX_TRIES = 0.7, 24  # by which the common size of plans falls from try to try, and how often [assumed]
FINER_STEPS = 1.25, 1.6, 2.0, 2.5, 4.0, 5.0, 10.0  # times as fine a round scale is as the next coarser one [assumed]
COARSER_STEP = 1.001  # times as coarse the next coarser scale is at least: any number above 1 will do [assumed]
MIN_RELIEF = 0.02  # of the marks near each other, by which an exchange of scales must lessen them [assumed]
MAX_COARSER = 4  # steps of the series by which other plans are made coarser for one that is made finer [assumed]
MAX_EXCHANGES = 40  # exchanges of scales that are tried one after the other [measured]
MAX_FILL = 0.92  # of a region that panels of whatever shapes may fill after an exchange [assumed]
MAX_REORDERED = 8  # plans that are tried in other orders: more take too long [assumed]

# ---- words, and what is given and found ------------------------------------------------------------------------------

GUTTER_MM, COLUMN_MM = 5.0, 96.0  # mm of A4: between columns of words, and their width at least [practice]
MIN_PLANS_SHARE = 0.6  # of a page that plans take where facts have a part of their own [assumed]
FACT_GAP_MM, PADDING_MM = 4.0, 2.0  # mm between two columns of results, and about the rows [practice]
ROW_STEP_MM = 2.0  # mm: by so much a strip grows until it holds its rows [assumed]
BLOCK_WIDTHS_MM = 60.0, 80.0, 100.0, 130.0, 160.0, 200.0  # mm of A4: a block on a part of the page of its own [assumed]
BLOCK_COLUMNS = 1, 2, 3, 4  # of results in it, just as wide as they need [assumed]
MIN_ROWS_TOGETHER = 3  # of results under their heading, and at the end of a column [practice]
FACT_COLUMN_MM = 50.0  # mm: the width of columns of facts above the title block at least [practice]
FREE_WIDTHS_MM = 190.0, 160.0, 130.0, 105.0, 85.0, 70.0, 58.0, 48.0  # mm of A4: a block in free room [assumed]
FREE_COLUMNS = 1, 2, 3  # of results in it, just as wide as they need [assumed]
CELL_MM, CLEARANCE_MM = 1.5, 2.0  # mm: of the grid on which free room is looked for; about what is drawn [practice]
