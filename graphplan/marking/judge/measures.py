"""The judge's numbers, in one table: weights, limits, sizes and counts, each with its unit, its meaning and how it was
found.

A name says the quantity and the unit: `_MM` are millimetres of the student's paper, `_SIGMAS` standard deviations,
`_ODDS` natural logarithms of odds (what a fact speaks for one explanation of a drawing rather than for another),
`_COST` the same with the other sign; `MAX_` and `MIN_` are limits. How a number was found stands at its end:

- [practice] so large things are on paper, as pencils, rulers, hands and programs make them;
- [tuned] with it the drawings of tests/marking, right ones and those with known mistakes, are judged as they should be;
- [defined] it follows from what the thing is, or is agreed as a rule of the score;
- [cost] it bounds the time that a judgement takes.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from graphplan.kernel.kinds import CIRCLE, LINE, POINT

# ---- a judgement ----------------------------------------------------------------------------------------------------

FALSE_ALARM_CHANCE = 0.002  # per drawing: how often a faultless one may be called wrong [defined]
MAX_MISTAKES = 4  # count: mistakes that are looked for in one drawing [cost]
NOWHERE_MM = 1e6  # as far off as no sheet is [defined]
FRAMES_LOOKED_AT = 2  # count: frames of a plan that are looked at closely [cost]
MIN_PLAN_ODDS = -10.0  # what may speak against a frame in which no mistake is looked for [tuned]
MIN_PENCIL_RATIO = 1.1  # times the stated pencil: a program's drawing may show one so much coarser [tuned]
MISSED_MARK_COST = 3.0  # what it speaks against a plan that a mark is missing [tuned]
KNOWN_MISTAKE_ODDS = -8.0  # of a mistake of the table at a step [tuned]
UNNAMED_MISTAKE_ODDS = -14.0  # of any other mistake at a step [tuned]
DEPARTURE_ODDS = -3.0  # of a scale or direction of a plan's own, of another design, of letters without a use [tuned]
CLOSER_LOOK_ODDS = 20.0  # what a search for mistakes may find that a first look at a reading does not [tuned]
NUMBER_ODDS = 5.0  # what a number that a drawing bears out speaks for its reading [tuned]

# ---- readings: the conventions and units that a student may have taken ----------------------------------------------

MAX_TURN_ERROR_RAD = 0.15  # that a vector may be off a quarter turn [practice]
MIN_VECTOR_MM = 3.0  # the shortest vector that tells a scale [practice]
# each in mm, and what speaks against it, as log odds [tuned]
DRAWING_UNITS: Mapping[str, tuple[float, float]] = {
    "mm": (1.0, 0.0), "cm": (10.0, 0.3), "m": (1000.0, 0.5), "in": (25.4, 0.5)}
OWN_UNIT_COST = 1.2  # of a unit of the drawing's own [tuned]
RESIZED_COST = 1.5  # of a drawing e times as large, or as small, as its task [tuned]
ODD_SCALE_COST = 1.0  # of a scale that is not round [tuned]
ROUND_SCALES = (1.0, 2.0, 2.5, 4.0, 5.0, 10.0)  # of a mechanism, times powers of ten: GOST 2.302 has 1:2.5 [practice]
ROUND_SCALE_TOL = 0.005  # of itself: how far a scale may be off a round one [practice]
SIZE_RATIO = 4.0  # times as large or small as the task's sheet a drawing is looked at as it is [tuned]
EXTENT_PERCENTILES = 10.0, 90.0  # of its spots, by which the width of a drawing is measured [practice]
FRAME_TOL_PARTS = 150  # of the size of a drawing: the part of one that its marks may be off a frame [tuned]

# ---- letters: which marks they name ---------------------------------------------------------------------------------

MAX_LOOSENESS = 2  # count: how loosely a label may be read; exactly, without `_`, in small letters [defined]
REACH_MM = 6.0  # about a mark, in which its letters stand, or other ink may be meant for it [practice]
LETTER_REACH_SIZES = 2.4  # times the letters' size: the same where they are large [practice]
LETTER_CHOICES = 12  # count: things nearest to a letter that are weighed [cost]
MAX_UNDOTTED_LETTERS = 150  # count: letters about which crossings are sought [cost]
LEADER_END_MM = 0.05  # from the end of a leader to the mark in which it ends: sheets are written so finely [defined]
ASTRAY_DOT_MM = 10.0  # from where a mark should be to a dot that is meant for it, and is no other's [practice]
LETTER_GAP_SIZES = 0.4  # times the letters' size, from a mark or off their usual place: a cost of one, or half [tuned]
WRONG_NAME_COST = 4.0  # of a mark elsewhere, of what has a name, or of letters that are of none here [tuned]
ASIDE_MM = 1.5  # off a mark's place, which costs half of that; of a leader's tip off what it leads to [tuned]
NAMELESS_COST = 12.0  # of letters that name nothing [tuned]
LEFT_DOT_COST = 5.0  # of naming the tip of an arrow beside a dot that no step explains [tuned]
CLEAR_COST = 3.0  # by so much cheaper letters are certainly those of their mark, and another step's cost more [tuned]
MIN_PLACED_LETTERS = 4  # count: letters with but one mark near, of which where letters stand is told [practice]
PLACED_SHARE = 0.8  # of them that have to stand alike [tuned]
STRAY_LETTER_COST = 6.0  # of letters that stand otherwise than all others [tuned]
LINE_END_COST = 2.0  # of a line's end as a mark: most lines go on beyond theirs [tuned]
LETTERS_ALONE_COST = 7.5  # of a mark of which there is nothing but its letters [tuned]
LETTERS_ALONE_MM = 2.5  # standard deviation: how far such letters stand from their mark [practice]
OTHER_FRAME_LETTERS = 0.8  # count: letters more than in the expected frame that have to agree on another [tuned]
# the part more of them for every spot that a letter may name: of many some agree by chance [tuned]
OTHER_FRAME_SHARE = 0.3
MAX_FRAME_SPOTS = 100  # count: spots of all marks by which frames are proposed [cost]
MAX_FRAMES = 3000  # count: frames that are tried [cost]
SPOT_COST_SHARE = 0.02  # of a vote, for a unit of what letters cost: nearer spots vote louder [tuned]
MAX_SPOT_COST = 10.0  # beyond which letters' cost silences a spot no further [tuned]
RESCALED_VOTES = 0.05  # of a letter: what a frame e times as large loses against one as expected [tuned]
TURNED_VOTES = 0.01  # of a letter: what a frame loses for a radian by which it is turned [tuned]
MIN_FRAME_VOTES = 1.3  # of letters, less a half: fewer lay no frame [tuned]
MAX_CROWD = 60  # count: letters that are weighed against each other, or things about one [cost]
SAME_CROSSING_MM = 0.3  # within which crossings are one [practice]
CROSSING_BLUR_MM = 0.15  # standard deviation of a mark that is set where strokes cross squarely [practice]
MIN_CROSSING_SINE = 0.05  # the sine of the angle at which strokes hardly cross [practice]

# ---- frames: where plans lie on the sheet ---------------------------------------------------------------------------

SURE_SIGMAS = 4.0  # within which a mark, a vector or a claim agrees with what is known [defined]
SAME_FRAME_SHARE = 0.02  # of themselves: by which frames of one scale, or of one direction, differ [practice]
MAX_OWN_FRAMES = 3  # count: plans in frames of their own that are tried in those of the task, too [cost]
MAX_RIVAL_FRAMES = 8  # count: other frames that are tried for a plan [cost]
MAX_ANCHORS = 400  # count: unlabelled spots in which a mechanism is sought [cost]
AGREED_SIGMAS = 2 * SURE_SIGMAS  # within which marks agree on where a plan lies: two of them may err [defined]
CANDIDATES = 6  # count: things, pairs, places or spots that are tried for one, the nearest or likeliest first [cost]
MANY_CANDIDATES = 24  # count: the same of strokes, heaps of votes and mistakes [cost]
CHANCE_MECHANISMS = 0.01  # count: mechanisms that may be seen in spots that are not theirs [defined]
MAX_FRAME_BLUR_MM = 2.0  # marks without dots that are no surer lay no frame [tuned]
SUREST_VECTOR_STEPS = -0.1  # wrong steps: what the scale weighs that the surest vector of a plan has [defined]
REDIRECTED_STEPS = 1.2  # wrong steps: of another direction of a plan, or another scale than the printed one [tuned]
RESCALED_STEPS = REDIRECTED_STEPS / 2  # the same of another scale where none is printed [defined]

# ---- evidence: what is there of a step ------------------------------------------------------------------------------

PICTURE_ODDS = {LINE: 5.0, CIRCLE: 2.5, POINT: 8.0}  # of a picture's mark where it should be [tuned]
VECTOR_ODDS = PICTURE_ODDS | {POINT: 16.0}  # the same of dots in which strokes end [tuned]
FAINT_ODDS = {LINE: 2.5, CIRCLE: 2.0, POINT: 0.4}  # the same where it is seen only by seeking it [tuned]
FILE_ODDS = {LINE: 8.0, CIRCLE: 7.0, POINT: 10.0}  # of a file's mark: nothing is there by chance [tuned]
ABSENT_ODDS = {LINE: -4.0, CIRCLE: -3.0, POINT: -3.0}  # of no mark, where one could be seen [tuned]
SHARED_ODDS = 0.0  # of a mark that was drawn for another step [tuned]
UNSEEN_MISTAKE_ODDS = -2.0  # of a mistake at a mark that is not to be seen itself [tuned]
ABSENT_SHARE = 0.4  # of a stroke to be seen: it is hardly there [tuned]
PRESENT_SHARE = 0.8  # of a stroke to be seen: it is as good as all there [tuned]
FRAME_ERRORS = 4  # count: errors of a plan, of its turn, its scale and its place [defined]
SPOT_ERRORS = 6  # count: errors of a trace, two of each of up to three spots [defined]
SHORT_ARC_RAD = math.radians(60)  # of a shorter arc only the radius is measured, not the centre [practice]
COARSE_ERROR_SHARE = 0.1  # of a plan's diagonal: what such a pencil hides [tuned]
MAX_COARSE_ERROR_MM = 15.0  # what such a pencil hides at most [tuned]
BOUND_LIMIT = 1000.0  # of a sum of squares: no bound is larger [defined]
SAME_STROKE_MM = 0.5  # a stroke that is found twice, or begins in a mark, lies so near to itself, or to that [practice]
OVERSHOOT_MM = 5.0  # that a vector's stroke goes beyond its end, or falls short of it [practice]
STROKE_SPOTS = 20  # count: parts of a stroke at whose ends it is looked for [cost]
BESIDE_MM = 1.0  # from a mark or a stroke: what is so near may be taken for it [practice]
END_NEAR_MM = 0.25  # of the end of a stroke from the mark that it may be, where marks have letters [practice]
LONE_LINE_MM = 10.0  # of a line about its only mark; what is shorter in a picture may be no line [practice]
PENCIL_LINE_BLUR_MM = 0.06  # standard deviation of a pencil line from the edge that it is drawn along [practice]
ARC_MM = 4.0  # of an arc, to both sides of its mark [practice]

# ---- matching steps with marks --------------------------------------------------------------------------------------

SEARCH_SIGMAS = 25.0  # of a point, within which a picture is searched [tuned]
MAX_TOLERANCES_OFF = 2.0  # tolerances off: nothing that is farther fits [tuned]
CHANCE_CROSSING_MM = 8.0  # from a mark, beside whose letter other strokes cross [practice]
MAX_ASTRAY_MM = 60.0  # no mark is sought further off [tuned]
DIRECTION_SHARE = 0.01  # of its length: how far a line of a wrong direction is off that at its end [practice]

# ---- mistakes -------------------------------------------------------------------------------------------------------

SCALE_FACTORS = (10.0, 0.1, 1.5)  # times too long: the scales that are mistaken for each other [practice]
WAYS_TRIED = 12  # count: whole ways through that are gone to try the most promising mistakes [cost]
CLEAR_ODDS = 2.5  # of a mark that is right [tuned]
HOPELESS_ODDS = -4.0  # of a mistake, or of what follows from it, below which it is none [tuned]
CLEAR_SQUARES = 4.0  # sum of squares that a clearly right mark may be off, or a step back adds [tuned]
PROMISE_SPREAD_ODDS = 16.0  # how much more may be gained than was promised [tuned]
FIRST_MISTAKE_ODDS = 1.0  # what has to speak for a mistake: nearly three to one [tuned]
PICTURE_MISTAKE_ODDS = 1.5  # the same in a picture [tuned]
DOT_ASTRAY_ODDS = -16.5  # of a picture's dot as a mark that should be elsewhere [tuned]
FURTHER_MISTAKE_ODDS = 6.0  # what has to speak for a further one [tuned]
NEIGHBOUR_PROMISE = 100.0  # of another stroke beside one, which is tried before all mistakes [defined]
QUICK_SHARE = 0.6  # what a quick score sees weighs as much of what a full one does [tuned]
DRIFT_MM = 3.0  # that a careless hand sets a mark, or ends a line, off its place [practice]
DIFFERENT_MM = 0.2  # what is so far off is another to the eye [practice]
TABLE_ROW_SQUARES = 0.5  # sum of squares: what each place down the table adds [tuned]

# ---- verdicts, numbers and the score --------------------------------------------------------------------------------

MIN_PICTURE_MISTAKE_CHANCE = 0.95  # of a mistake in a picture: one that is less likely is to be looked at [tuned]
MAX_SURE_ODDS = 20.0  # beyond which nothing is surer [defined]
RESULT_SIGMAS = 3.0  # standard deviations of what the pencil makes of a result, within which it is right [defined]
RESULT_SHARE = 0.03  # of a result that is no place: within which it is right in any case [defined]
LENGTH_READING_ERRORS = 2.0  # times a pricked point's error: both ends of a length are read [practice]
# times too large: powers of ten, halves, and units that are confused [practice]
NUMBER_FACTORS = (10.0, 0.1, 100.0, 0.01, 1000.0, 0.001, 2.0, 0.5, 9.81, 1 / 9.81, math.tau, 1 / math.tau,
                  60.0 / math.tau, math.tau / 60.0, 180.0 / math.pi, math.pi / 180.0)
MAX_WEIGHT = 1000.0  # of a verdict: sums of many stay what they are [defined]
FULL_SCORE = 100.0  # points of a score, and the most that a mistake may cost [defined]
MIN_WEIGHTS = {"right": 0.001, "numbers": 0.0}  # what is right earns something; other verdicts may cost [defined]
MECHANICS_POINTS = 20.0  # of 100: what a mistake about mechanics costs by default [defined]
QUARTER_DEGREES = 90.0  # degrees between two axes, from either of which angles may be counted [defined]
MAX_SHARE_POINTS = 30.0  # of 100: the most that the share of one mark of a task of synthesis costs [defined]
SLIP_POINTS = 12.0  # of 100: what any other mistake costs by default [defined]

# ---- the pencil that a drawing shows --------------------------------------------------------------------------------

HAND_SCALES = 0.4, 4.0, 24  # times as unsteady as the stated pencil a hand may be: from, to, how many are tried [tuned]
HAND_SCALE_SIGMA = 0.4  # standard deviation of the logarithm of that [practice]
READINGS_MM = 0.02, 0.6, 24  # standard deviation of reading a coordinate: from, to, how many are tried [practice]
STATED_SHARES = 0.5, 1.0, 12  # of a stated precision that marks show: from, to, how many are tried [practice]
STATED_SHARE_SIGMA = 0.3  # standard deviation of its logarithm: who states bounds has less [practice]
RULER_MM = 0.12  # standard deviation of reading the usual ruler [practice]
READING_SIGMA = 0.6  # standard deviation of its logarithm, from reader to reader [practice]
MISTAKE_SHARE = 0.05  # of marks that are mistakes [practice]
MISTAKE_SPREAD_MM = 100.0  # over which such marks are spread [practice]
MIN_WITNESSES = 3  # count: marks, letters or points; fewer say nothing of a hand or a place [tuned]
