"""The numbers by which scans are read, in one table: sizes, limits and counts, each with its unit, what it means and
how it was found.

A name says the quantity and the unit: `_MM` are millimetres of the printed sheet, `_PX` pixels of the picture,
`_SIGMAS` standard deviations, `_SHARE` a part of what is named, `_RATIO` how many times; darkness and lightness go from
0 to 1. How a number was found stands at its end:

- [measured] on pencil lines, dots, rings and papers, as scanners and cameras show them;
- [tuned] with it the drawn, printed and spoilt sheets of tests/marking are read as they should be;
- [defined] it follows from what the thing is: from the print of our own sheets, or a format of files;
- [cost] it bounds the time or the memory that a picture takes.
"""

import math

from graphplan.marking.files.safe import MB

# ---- pictures -------------------------------------------------------------------------------------------------------

MAX_FILE_BYTES = 96 * MB  # of a file [cost]
MAX_PICTURE_PX = 120_000_000  # of a whole picture [cost]
MIN_SIDE_PX = 400  # of the shorter side of a picture [measured]
MAX_WHOLE_PX = 60_000_000  # of a picture: above it half as many a side will do [cost]
CONTRAST_PX = 300_000  # of a small picture, in which print is seen, and noise is not [tuned]
MIN_CONTRAST_SHADES = 30  # shades of 255 between paper and print [measured]
# percent of the pixels: of which the darkest is print, and the lightest paper [measured]
CONTRAST_PERCENTILES = 0.2, 90
BLANK_PERCENTILES = 0.05, 90  # percent of the pixels: the same of a page that may be blank [measured]
PDF_DPI = 200  # dots per inch at which a page of a PDF is drawn [measured]
POINTS_PER_INCH = 72  # the units of a PDF [defined]
MAX_PAGES = 20  # count: pages of a PDF that are tried [cost]
MEDIAN_SIGMAS = 0.6745  # the median of what is off by chance [defined]
FACSIMILE_PX_PER_MM = 6.0  # of a sheet that is handed back [tuned]
FACSIMILE_JPEG_QUALITY = 75  # of 100: how well JPEG keeps it [tuned]
A4_LONG_MM = 297.0  # the longer side of a page whose size nobody knows [defined]
PAGE_PX_PER_MM = 8.0  # of a straightened page [tuned]
MAX_PAGE_PX = 4.0e7  # of a straightened page, at most [cost]

# ---- corner marks ---------------------------------------------------------------------------------------------------

CORNER_BITS = 8  # of the code in each mark [defined]
MARK_SIZE_RATIO = 2.0  # how much larger one mark of a sheet may look than another [tuned]
MIN_MARK_RIM_PX = 48.0  # of a mark's rim, below which its cells are not told apart [measured]
THRESHOLD_WINDOWS_PX = 15, 55, 20  # windows in which dark is told from light: from, to, step [tuned]
CELL_PX = 8  # of a cell of a mark, as it is read [tuned]
CELL_RIM_SHARE = 0.3  # of a cell at its rim, which is blurred and not read [tuned]
CORNER_WINDOW_SHARE = 0.1  # of a mark, within which its corner is refined [tuned]
MARKS_APART_SIDES = 5.0  # times a mark's side, that two marks of a sheet are apart at least [defined]
PAGE_RIM_SHARE = 0.03  # of a page's side, beside which nothing counts: shadows of a scanner's lid [measured]
MIN_MARKS = 3  # count: marks by which a sheet may be laid [defined]
ALL_MARKS = 4  # count: marks by which it is laid without a doubt [defined]

# ---- the frame ------------------------------------------------------------------------------------------------------

FRAME_SEARCH_PX = 2400  # of the picture's longer side, in which a frame is searched [cost]
FRAME_WINDOW_PX = 41  # of the window in which dark is told from light [tuned]
FRAME_SHADES = 12  # shades of 255 by which a frame is darker than what is about it [tuned]
FRAME_CORNER_SHARE = 0.02  # of its rim, by which a rectangle's sides may bend [tuned]
MIN_FRAME_SHARE = 0.15  # of the picture, that a frame covers [tuned]
MAX_RECTANGLES = 4  # count: rectangles that are tried [cost]
SIDE_MIDDLE_SHARE = 0.35  # of a side, to each side of its middle, that tells where it is [tuned]
SIDE_OFF_SHARE = 0.02  # of a side, by which that may be off it [tuned]
SAME_RIM_SHARE = 0.002  # of the picture, by which the two rims of one line are apart [measured]
PRINT_PX_PER_MM = 1.0  # at which print is compared [cost]
SHADE_MM = 20  # over which light changes, that is no print [measured]

# ---- straightening --------------------------------------------------------------------------------------------------

WARP_GRID_PX = 16  # between the places where a warp is worked out; it is straight between them [tuned]
FINENESS_MM = 10  # over which the pixels of a mm are counted [defined]
PROFILE_STEP_MM = 0.125  # across a piece: how closely it is read off [tuned]
PROFILE_REACH_MM = 1.0  # across a piece: how far to each side of its middle it is read off [tuned]
PROFILE_PLACES = 9  # count: places along a piece [cost]
PROFILE_SHARE = 0.8  # of a piece, about its middle, that is read off [tuned]
PROFILE_ROWS = 32000  # count: rows of pixels that are read in one go, as OpenCV allows [defined]
MIN_CORRELATION = 0.6  # from which on a piece counts [tuned]
MIN_PRINT_CONTRAST = 0.03  # of lightness: the least contrast of a piece of print [tuned]
BLACK_SHARE = 0.35  # of the paper's lightness, below which all of the print is inked [measured]
WHITE_VARIANCE = 1.0  # the square of a shade: what varies less is white [defined]
# how far is searched, in mm, and the degree fitted [tuned]
WARP_ROUNDS = (2.5, 1), (2.5, 3), (1.5, 4), (0.75, 5), (0.375, 5)
WARP_ITERATIONS = 6  # count: reweighted fits of a round [tuned]
PAPER_STIFFNESS = 1e-5  # of all the evidence: how much bends are held back [measured]
MIN_BENT_PIECES = 40  # count: pieces below which only the plane is moved [tuned]
MIN_DPI = 110.0  # dots per inch of a picture: at 100 one of ten right drawings is called wrong [measured]
INCH_MM = 25.4  # of an inch [defined]
OWN_PRINT_SHARE = 0.5  # of a task's print: a picture of its own sheet shows more [tuned]
SURE_PRINT_SHARE = 0.95  # of the print, by which the sheet is known [tuned]
PANEL_MARGIN_MM = 1.0  # by which a plan may be off the picture [tuned]

# ---- print ----------------------------------------------------------------------------------------------------------

PRINT_FINENESS = 2  # times as fine print is drawn as it is asked for [cost]
PRINT_BITS = 4  # bits for parts of a pixel [defined]
MIN_PIECE_MM = 0.9  # of the pieces that lines are cut into [tuned]
MAX_PIECE_MM = 8.0  # of the same [tuned]
MIN_OWN_PIECE_MM = 2.5  # of a piece that is no cross of a grid [defined]
OWN_PIECE_INSET_MM = 1.0  # from a plan's edge, of what only this task has [defined]
RED_GREEN_BLUE_LIGHT = 0.299, 0.587, 0.114  # of the light of a colour, to a scanner: ITU-R BT.601 [defined]

# ---- pencil ---------------------------------------------------------------------------------------------------------

LIGHT_PX = 4  # of the picture for one pixel in which light is estimated [cost]
LIGHT_LINE_PX = 5  # of those: wider than any line, which is so left out [measured]
LIGHT_REACH_PX = 31  # of those, over which light is even [measured]
MIN_INK_DARKNESS = 0.12  # what is darker is no paper [measured]
MAX_PRINT_LIGHTNESS = 0.75  # what is printed lighter is paper, on which pencil is seen [measured]
PAPER_EDGE_MM = 5.0  # of paper, where nothing is drawn and pictures have shadows [practice]
PRINT_RIM_MM = 0.25  # beside print, in which pencil is not told from it [measured]
PRINT_GAP_MM = 1.25  # between two edges of print, in which pencil is not told from it [measured]
HALF_LINE_MM = 0.18  # half a pencil line, by which the picture is smoothed [measured]
GRAIN_STRIDE = 7  # count: one pixel of so many tells the paper's grain [cost]
COARSE_DPI = 135.0  # dots per inch of a picture, below which what JPEG does to paper is as strong as lines [measured]
MIN_PAPER_GRAIN = 6e-4  # of the smoothest paper, in the same measure as strengths [measured]
FAINT_SIGMAS = 2.5  # of the paper's grain: a strength that may be a line [tuned]
CLEAR_SIGMAS = 4.5  # of the paper's grain: a strength that is one [tuned]
MIN_CREST_ROW_MM = 0.9  # of crests without a gap [measured]
CREST_OFF_PX = 0.7  # of a pixel, that a crest's middle is from its pixel's [defined]
PIXEL_NEIGHBOURS = 8  # count: of a pixel, those at its corners too [defined]
SOBEL_SUM = 8  # the sum of the positive weights of OpenCV's first derivative, over two pixels [defined]

# ---- strokes --------------------------------------------------------------------------------------------------------

STROKE_CELL_MM = 0.25  # how closely a line is looked at [tuned]
MAX_GAP_MM = 2.0  # the widest gap in a line [measured]
ROW_REACHES_MM = 0.6, 0.6, 0.3, 0.3  # from a line, in which crests are taken, from fit to fit [tuned]
MIN_NORMAL_COSINE = math.cos(math.radians(18.0))  # of the angle between a crest's normal and its line's [measured]
MIN_CRESTS = 8  # count: crests below which there is no line [tuned]
MIN_SAG_MM = 0.12  # by which a line bends, more than wobble does [measured]
BOW_RATIO = 0.7  # of a line's roughness: a bow that fits so much better is one [tuned]
RIM_REACH_MM = 0.35  # from a rim, in which crests are taken [tuned]
RIM_ROUNDS = 8  # count: how often a rim may grow [cost]
MIN_RIM_RADIUS_MM = 1.5  # of a rim: compasses strike no smaller one [measured]
MAX_RIM_RADIUS_MM = 1000.0  # of a rim: larger ones are straight [defined]
MAX_RIM_ROUGHNESS_MM = 0.12  # standard deviation of a rim's crests from it [measured]
MIN_STROKE_SHARE = 0.55  # of a line or a rim that is seen [tuned]
RIM_SPOTS_DEGREES = 20.0  # between the spots that say where a rim is [defined]
MIN_RIM_SPOTS = 5  # count: of the same [defined]
VOTE_TURN_RAD = math.radians(0.5)  # of a cell of the vote [tuned]
VOTE_SHIFT_MM = 0.25  # of a cell of the vote [tuned]
NORMAL_CELLS = 6  # count: cells by which a crest's own direction may be off, to each side [measured]
MIN_LINE_MM = 5.0  # of a line that is found without being expected [measured]
VOTES_PER_MM = 36.0  # of a line, below which it is not heard [tuned]
MAX_CREST_VOTES = 12.0  # no crest counts for more [tuned]
MAX_CREST_STRENGTH = 12.0  # no crest of a faint line counts for more [tuned]
SILENCED_VOTES = -1e9  # where a line was taken, nothing is heard again [defined]
MAX_LINES = 600  # count: lines that are tried [cost]
RIM_RATIO = 1.25  # how much longer a rim is than the piece of it that looked straight [tuned]

# ---- dots and rings -------------------------------------------------------------------------------------------------

HALF_DOT_MM = 0.25  # half a dot, by which the picture is smoothed [measured]
MIN_DOT_ROUNDNESS = 0.25  # of its steepest fall to one side: how steeply a dot falls off to any other [tuned]
MIN_DOT_DARKNESS = 0.05  # of a dot [measured]
DOT_REACH_MM = 0.45  # in which a dot's middle is weighed [measured]
DOT_ERROR_MM = 0.2  # standard deviation of a dot at print [measured]
DOT_AT_PRINT_RATIO = 1.15  # of the usual darkness: more than strokes have at their rim beside print [measured]
DOT_BLUR_SHARE = 10  # of a dot's width: the part of one by which its middle is unsure [measured]
DOT_STROKE_MM = 0.5  # from a stroke: what is dark there may be its own darkness, or its crossing [measured]
# of a line's darkness: a dot for sure, by how many strokes it lies on [tuned]
SURE_DOT_RATIOS = 0.8, 1.5, 1.8, 1.85, 2.2
FAINT_DOT_RATIOS = 0.0, 1.25, 1.6, 1.65, 2.0  # of a line's darkness: what may be a dot, likewise [tuned]
BLACK_DOT_RATIO = 2.0  # of a line's darkness: a dot that may be as oval as it likes [tuned]
DOT_RIM_MM = 0.3  # radius about a dot's middle at which it is still dark, and no crossing of lines is [measured]
DOT_RIM_SHIFTS_MM = -0.3, 0.31, 0.1  # from a dark spot, within which a dot's middle is: from, to, step [tuned]
DOT_RIM_PERCENTILE = 20  # of the sides: where a dot may be lighter [tuned]
MAX_HIDDEN_RIM_SHARE = 0.3  # of a dot's rim, that print may hide [tuned]
WIDE_DOT_SHARE = 0.95  # of the usual darkness, that a dot has at its rim [measured]
RING_RADII_MM = 0.5, 1.41, 0.1  # of rings: from, to, step [measured]
MIN_RING_RADIUS_MM = 0.5  # of a ring [measured]
RING_CELL_MM = 0.2  # how closely middles are voted for [tuned]
RING_SIDES = 16  # count: sides from which they are voted for [tuned]
MIN_RING_SIDES = 8  # count: sides that must vote [tuned]
RING_PLACES = 32  # count: places around a ring at which it is looked at [cost]
RING_SEARCH_MM = 0.3, 0.06  # from a ring's middle: where its rim is looked for at the nearest, and how closely [tuned]
RING_SEARCH_RIMS = 2.5  # times the room about a rim: how far beyond it the search goes [tuned]
MIN_RING_OPEN_SHARE = 0.6  # of the places around a ring, that print must leave open [tuned]
RING_OFF_MM = 0.12  # that a rim may be off its circle [measured]
RING_BESIDE_MM = 0.36  # within and beyond a rim, where it is lighter [measured]
MIN_RING_RIM_SHARE = 0.85  # of the rim, that is drawn [tuned]
MIN_RING_CREST_SHARE = 0.5  # of the drawn rim, where it is lighter beside it [tuned]
RING_LIGHTER_RATIO = 0.8  # of the rim's darkness: what is beside it has less [tuned]
RING_PENCIL_SHARE = 0.4  # of the usual darkness, that is drawn [tuned]
RING_BLUR_MM = 0.25  # standard deviation: a ring is drawn beside its middle [measured]
RING_LINE_BLUR_MM = 0.08  # standard deviation: a line runs beside its point [measured]
SAME_RING_SHARE = 0.9  # of the radius, in which there is no other ring [defined]

# ---- what is sought where it is expected ----------------------------------------------------------------------------

CREST_TURN_DEGREES = 20.0  # by which a crest's own direction is unsure [measured]
FAINT_CELL_MM = 0.1  # how finely a faint line is searched [tuned]
FAINT_REACH_MM = 0.25  # how far its crests are off it [measured]
BEYOND_ENDS_MM = 5.0  # beyond the expected ends, in which it may go on [measured]
MIN_FAINT_SHARE = 0.5  # of a faint line, that must be seen [tuned]
MIN_FAINT_MM = 5.0  # of a faint line, that must be seen [tuned]
MIN_CENTRE_DEGREES = 40.0  # of a rim, from which on it tells its own centre [measured]
MIN_ARC_MM = 2.0  # of a rim [measured]
DARKNESS_PLACES = 40  # count: places along a line, at which its darkness is read off [cost]
DARKNESS_SHARES = 0.05, 0.95  # of a line, between which that is: its ends are heavy [measured]
DARKNESS_REACH_MM = 0.25  # about a line, in which that is [measured]
DOT_SEARCH_MM = 0.35  # about a dot, in which its darkest spot is [measured]
DOT_CLEAR_MM = 0.8  # about a dot, in which is no print, whose rest it might be [measured]
MIN_LONG_STROKE_MM = 6.0  # of a stroke that is no letter's [measured]
STROKE_WIDTH_MM = 0.7  # of a stroke that is taken off, with all about it [measured]
HALF_RIM_MM = 0.15  # half the width of a ring's rim [measured]
MAX_DOT_MM = 1.4  # of a dot [measured]
LETTER_EXCESS_MM = 0.8  # by which a piece beside strokes is larger than a ring, if it is a letter's [measured]
MAX_HIDDEN_SHARE = 0.6  # of a stroke, that print may hide [tuned]
