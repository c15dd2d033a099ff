"""The numbers by which variants are chosen and a class is marked, in one table: each with its unit, what it means and
how it was found.

A name says the quantity and the unit: `_MM` are millimetres of paper, `_SHARE` a part of what is named, `_RATIO` how
many times; `MAX_` and `MIN_` are limits. How a number was found stands at its end:

- [assumed] it was written so; nothing in the code or its history shows how it was found;
- [defined] it follows from what the thing is, or is agreed as a rule of a class's sheets or report;
- [cost] it bounds the time or the memory that a class takes.
"""

from __future__ import annotations

# ---- variants -------------------------------------------------------------------------------------------------------

MIN_CROSSING_DEGREES = 12.0  # two lines that cross flatter have no clear point [assumed]
SQUARE_DEGREES = 90.0  # how lines cross where none do [defined]
MAX_ERROR_SHARE = 0.15  # of the largest of its kind: a result that a careful hand misses by more is none [assumed]
MAX_POOR_SHARE = 0.15  # of the letters that have no good place, on paper of any size [assumed]
MAX_WORSE_RATIO = 1.25  # so much worse than the scene itself a variant may be where that is no better [assumed]
MIN_DRAWN_MM = 3.0  # of a vector that is drawn, or gives a direction [defined]
MIN_ASKED_MM = 8.0  # of a vector that is asked for [defined]
SHAPE_DECIMALS = 3  # count: decimals of a result, relative to the largest, in which scaled copies agree [assumed]
GOLDEN_ITERATIONS = 40  # count: by which the golden ratio is found to all its digits [defined]
REJECTIONS_PER_USE = 4  # count: of a value, by which it is tried as seldom as if it were given out once more [cost]
MIN_DRAWS = 100  # count: draws without a good one by which ranges are given up [cost]
DRAWS_PER_VARIANT = 40  # count: more of them for each good one [cost]
PILOT_VARIANTS = 12  # count: first variants by which scales are chosen [cost]
MIN_FITTING_SHARE = 0.75  # of these that is to fit [assumed]
SMALLER_SHARES = 1 / 6, 1 / 2  # of them that are drawn as small, or smaller [assumed]

# ---- whose a page is ------------------------------------------------------------------------------------------------

MIN_MARKS_OF_SHEET = 3  # count: marks that tell a sheet though another one is misread [defined]
MIN_MARKS_ALONE = 2  # count: marks that tell it though the others are lost [assumed]
MARKS_OF_PAGE = 4  # count: marks of a page [defined]
MAX_TASK_PAGES = 3  # count: pages of a task [assumed]
MAX_LIST_BYTES = 10_000_000  # of a class list [cost]
MAX_NAMES = 10_000  # count: names in it [cost]

# ---- results --------------------------------------------------------------------------------------------------------

MIN_SURE_CHANCE = 0.9  # of a verdict: one that is less sure is to be looked at first [assumed]
SETTLED_CHANCE = 2.0  # of a verdict that need not be looked at: above all that are to be [defined]
SCORE_BINS = 10  # count: bins of the histogram of scores [defined]
MISTAKES_SHOWN = 5  # count: the most frequent mistakes that are shown, and pictures of each [defined]
MAX_FILE_NAME_CHARS = 60  # characters of a file's name [assumed]
MAX_NOTE_CHARS = 500  # characters of a teacher's note [assumed]
THUMBNAIL_PX = 480  # pixels of a thumbnail's longer side [defined]
THUMBNAIL_JPEG_QUALITY = 70  # of 100: how well JPEG keeps it [assumed]
READ_BYTES = 2**20  # of a file that are read at a time [cost]
DIGEST_BYTES = 16  # of a digest by which results are kept [defined]

# ---- corrections ----------------------------------------------------------------------------------------------------

RIGHT_RING_MM = 1.0  # about what is right [defined]
DETAIL_HALF_MM = 28.0, 20.0  # to each side of the first wrong mark that its picture shows [assumed]
DETAIL_RING_MM = 4.0  # about that mark [assumed]
MAX_TURN_RAD = 0.02  # by which a plan may be turned, and where its marks should be is still shown [assumed]
