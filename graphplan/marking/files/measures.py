"""The numbers by which files are read, in one table: bounds on what strangers send, sizes and limits, each with its
unit, what it means and how it was found.

A name says the quantity and the unit: `_MM` are millimetres of paper, `_SIZES` times the letters' size, `_SHARE` a part
of what is named, `_RATIO` how many times; `MAX_` and `MIN_` are limits. How a number was found stands at its end:

- [assumed] it was written so; nothing in the code or its history shows how it was found;
- [defined] it follows from what the thing is, or from the format of a file;
- [cost] it bounds the time or the memory that a file takes.
"""

from __future__ import annotations

import math

# ---- bounds on files ------------------------------------------------------------------------------------------------

MAX_SVG_BYTES = 16 * 2**20  # of an SVG drawing [cost]
MAX_GGB_BYTES = 16 * 2**20  # of a GeoGebra file, and of what it unpacks to [cost]
MAX_PDF_BYTES = 96 * 2**20  # of a PDF, which may hold pictures [cost]
MAX_PDF_SECONDS = 30.0  # in which pages of a PDF are read, of a few seconds for a full scan [cost]
MAX_DXF_BYTES = 8 * 2**20  # of a DXF drawing [cost]
MAX_CSV_BYTES = 4 * 2**20  # of a table [cost]
MAX_TOML_BYTES = 2**19  # of a file of marks [cost]
MAX_TRACES = 20_000  # count: more things are on no sheet [assumed]
MAX_XML_ELEMENTS = 60_000  # count: of an XML document, and of what its copies amount to [cost]
MAX_XML_TEXT = 400 * 2**20  # letters of all entities times bytes of the document: more than it could unpack to [cost]
MAX_XML_DEPTH = 100  # count: elements within each other [cost]
MAX_DISTANCE_MM = 1e6  # a kilometre of paper [defined]
MAX_NUMERAL_CHARS = 40  # characters of a numeral [assumed]
MAX_ELEMENTS = 30_000  # count: elements of an SVG drawing [cost]
MAX_PATH_PIECES = 200_000  # count: straight and curved pieces of all paths of a PDF; with more it is looked at [cost]
MIN_PDF_LETTERS = 2  # count: names beside marks, with which a page of a PDF is read as a drawing [assumed]
MAX_LETTERS = 400_000  # of attributes and words of an SVG drawing; those of copies among them [cost]
MAX_TERM_LETTERS = 300_000  # of all terms of a GeoGebra file that are worked out; what is beyond has no value [cost]
MAX_TERM_LENGTH = 2000  # letters of one of these [cost]
MAX_LINES = 300_000  # count: lines of a DXF file; so many are read in a short time [cost]
MAX_ENTITIES = 20_000  # count: entities of a DXF file [cost]
MAX_BLOCK_DEPTH = 8  # count: blocks within each other [assumed]
MAX_DOTS = 3000  # in a line of TOML, or as many squared: the time that dotted keys take grows so [cost]
MAX_NAME_CHARS = 40  # characters of a mark's name [assumed]
MAX_WORDS = 500  # count: words that may be names; more name nothing [cost]
MAX_UNIT_CHARS = 30  # characters of a unit [assumed]
MAX_RESULT = 1e60  # of a number with its unit: beyond it squares leave the range of a float [defined]

# ---- lines and circles by their spots -------------------------------------------------------------------------------

MAX_DOT_RADIUS_MM = 1.5  # no compass strikes so small a circle; a pair's symbol has 1.2 [assumed]
DOT_SIZE_RATIO = 100  # times: a dot is no larger a part of a drawing that knows no mm [assumed]
CIRCLE_SPOTS = 4  # count: spots of a whole circle [defined]
CROSS_MIDDLE_SHARE = 0.05  # of their length, by which strokes of a cross may miss their middles [assumed]
MIN_CROSS_SINE = 0.7  # of the angle of a cross's strokes [assumed]
SHAPE_TOL = 0.01  # of its size: how far spots may lie off a line or circle that they are to show [assumed]
ARC_CLOSER_RATIO = 10  # times: where an arc is so much closer to spots than a line, they show no line [assumed]
MIN_ROUND_PIECES = 12  # count: straight pieces at least that show a circle [assumed]
MIN_LINE_MM = 0.5  # a straight piece shorter than this shows no line [assumed]
MAX_TIP_RAD = math.radians(45)  # the corner of an outline that is as sharp as a tip [assumed]
MAX_HEAD_SPOTS = 6  # count: spots of the outline of an arrow's head [assumed]
MAX_HEAD_MM = 6.0  # of a stroke of an arrow's open head [assumed]
MIN_HEAD_RAD = math.radians(10)  # between the two strokes of an open head, at least [assumed]
MAX_HEAD_RAD = math.radians(100)  # and at most between the two strokes of one [assumed]
SAME_BARBS_TOL = 0.1  # by which these differ in length at most, as a share, and about the shaft, in rad [assumed]
MAX_COMMAND_NUMERALS = 7  # count: numerals of a path's command, those of an arc [defined]
CURVE_PARTS = 8  # count: stretches by which a curve of SVG is read [cost]
CUBIC_SPOTS = 3  # of a curve of the third degree, beside where it begins [defined]
ELLIPSE_SPOTS = 48  # count: spots by which an ellipse of DXF is read [cost]

# ---- words ----------------------------------------------------------------------------------------------------------

STATED_UNIT_ODDS = 3.0  # natural logarithm of odds: what the unit that a file states speaks for itself [assumed]
OWN_ROUNDING_MM = 0.01 / math.sqrt(12.0)  # standard deviation of numbers in graphplan's own sheets [defined]
POSITION_DIGITS = 3  # decimals of a mm: what agrees so far is drawn twice [defined]
LEADER_GAP_SIZES = 0.6  # that a leader begins beside letters [assumed]
LEADER_MARK_MM = 0.3  # from a leader's end to its mark [assumed]
LEADER_FREE_MM = 0.5  # from a leader's other end to anything [assumed]
MAX_LEADER_MM = 30.0  # of a leader [assumed]
LEADER_ASIDE_SIZES = 0.15  # beside the nearest spot of its letters' box, where a leader of an own sheet aims [assumed]
LEADER_CUT_SIZES = 3.5  # before its letters, where a leader ends that is cut by others [assumed]
LEADER_BEND_MM = 0.03  # off its line, where a leader goes on that was cut [assumed]
LEADER_ASIDE_COST = 25.0  # letter sizes before letters that are worth one beside them [assumed]
SUBSCRIPT_GAP_SIZES = 0.25  # that a word may begin beside the end of the word that it continues [assumed]
MIN_SUBSCRIPT_DROP_SIZES = 0.05  # under the base line, where a subscript begins [assumed]
MAX_SUBSCRIPT_DROP_SIZES = 0.6  # under the base line, or over it, beyond which a word continues none [assumed]
MAX_SUBSCRIPT_SIZE = 0.95  # of the letters' size: a subscript is smaller [assumed]
SAME_SIZE_TOL = 0.05  # of the letters' size: so much as large are the letters after a subscript [assumed]
WORDS_PAGE_GAP_MM = 15.0  # so far right of the first page are further ones of words [defined]

# ---- numbers --------------------------------------------------------------------------------------------------------

MAX_PRECISION_MM = 1.0  # to which anybody can measure; with a blur without bounds any mark would pass [assumed]
MIN_COMMON_NUMBERS = 12  # count: numbers that are multiples of coarser steps, which are so by plan [assumed]
COARSER_STEPS = 5, 2  # units of the last digit, of which numbers may be multiples by plan [assumed]
UNIFORM_WIDTH_SIGMAS = math.sqrt(12.0)  # the width of a uniform distribution [defined]
