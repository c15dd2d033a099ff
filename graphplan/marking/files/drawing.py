"""What a drawing program's file shows, put together: lines, circles and points by their spots, each thing once, sound,
and with its letters.

Which letters name which of the things is not told here: that the whole drawing tells, beside its construction.
"""

from __future__ import annotations

import cmath
import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import chain, combinations, pairwise
from pathlib import Path

from shapely import Point, STRtree

from graphplan.errors import Refused
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.files import measures
from graphplan.marking.files.safe import Budget, on_paper
from graphplan.marking.tolerances import BULGE_TOL, COLLINEAR_TOL, SIZE_TOL
from graphplan.marking.traces import Frames, Lettering, Spot, Submission, Trace, can_name_line
from graphplan.sheet.layout.facts_block import FACTS
from graphplan.sheet.lettering.lettering import DEPTH, INDEX_DEPTH, SUBSCRIPT, TextRun, width
from graphplan.sheet.plates.display import ENLARGED

# ---- lines and circles by their spots -------------------------------------------------------------------------------


def circle_spots(centre: Spot, radius: float) -> tuple[Spot, ...]:
    """Four spots of a circle's rim."""
    (x, y), r = centre, radius
    return (x + r, y), (x, y + r), (x - r, y), (x, y - r)


def arc_spots(centre: Spot, radius: float, start: float, end: float) -> tuple[Spot, ...]:
    """Return both ends and the middle of an arc, counter-clockwise between two angles in degrees; four spots of a
    circle."""
    sweep = (end - start) % 360 or 360.0
    if sweep == 360:
        return circle_spots(centre, radius)
    z = complex(*centre)
    spots = [z + cmath.rect(radius, math.radians(start + share * sweep)) for share in (0.0, 0.5, 1.0)]
    return tuple([(spot.real, spot.imag) for spot in spots])


def circle_trace(centre: Spot, radius: float) -> Trace:
    """A circle."""
    return Trace(CIRCLE, circle_spots(centre, radius))


def dots_to_points(traces: Sequence[Trace]) -> list[Trace]:
    """The things with points for what stands for them: circles and crosses that are small beside all."""
    drawing_extent = extent([spot for trace in traces for spot in trace.spots] or [(0.0, 0.0)])
    most = min(measures.MAX_DOT_RADIUS_MM, drawing_extent / measures.DOT_SIZE_RATIO)
    return _crosses_to_points([dot_or_circle(trace, most) for trace in traces], most)


def dot_or_circle(trace: Trace, radius: float = measures.MAX_DOT_RADIUS_MM) -> Trace:
    """A circle, or the point that a small one stands for."""
    if trace.kind != CIRCLE or len(trace.spots) != measures.CIRCLE_SPOTS:
        return trace
    rim = circle_through(*trace.spots[:3])
    return Trace(POINT, (rim[0],)) if rim and rim[1] < radius else trace


def _crosses_to_points(traces: Sequence[Trace], most: float) -> list[Trace]:
    """With a point for every two short strokes that halve each other."""
    short = [trace for trace in traces if trace.kind == LINE and math.dist(*trace.spots) < 3 * most]
    replacements, crosses = dict[Trace, Trace | None](), STRtree([trace.figure.centroid for trace in short])
    for first in short:
        for place in crosses.query(first.figure.centroid, "dwithin", measures.CROSS_MIDDLE_SHARE * first.figure.length):
            second = short[place]
            directions = [complex(*trace.spots[1]) - complex(*trace.spots[0]) for trace in (first, second)]
            across = abs((directions[0].conjugate() * directions[1]).imag)
            if (first not in replacements and second not in replacements
                and across > measures.MIN_CROSS_SINE * max(abs(direction) for direction in directions) ** 2):
                at = first.figure.centroid
                replacements |= {first: Trace(POINT, ((at.x, at.y),)), second: None}
    return [replacement for trace in traces if (replacement := replacements.get(trace, trace))]


def chain_traces(spots: Sequence[Spot], short: float = 0.0) -> Iterator[Trace]:
    """Yield the traces of a chain of straight pieces: one line if it is straight, a circle if it is round, else line by
    line; pieces up to `short` are left out."""
    if len(spots) > 2 and (far := extent(spots)) > short and _chord_deviation(spots) <= measures.SHAPE_TOL * far:
        yield Trace(LINE, (spots[0], spots[-1]))
    elif len(spots) > measures.MIN_ROUND_PIECES and (curve := recognize_curve(spots)):
        yield curve
    else:
        for start, end in pairwise(spots):
            if math.dist(start, end) > short:
                yield Trace(LINE, (start, end))


def recognize_curve(spots: Sequence[Spot]) -> Trace | None:
    """The line, circle, arc or dot that a smooth curve through these spots is; None where it is another.

    A flat arc is as good as straight; it is an arc where it lies closer to its circle by far.
    """
    count, far = len(spots) - 1, extent(spots)
    closed = math.dist(spots[0], spots[-1]) < measures.SHAPE_TOL * far
    rim_spots = [spots[count * i // 4] for i in range(4)] if closed else [spots[0], spots[count // 2], spots[-1]]
    rim = circle_through(*rim_spots[:3])
    off = max(abs(math.dist(spot, rim[0]) - rim[1]) for spot in spots) if rim else math.inf
    bulge = _chord_deviation(spots)
    if bulge <= measures.SHAPE_TOL * far and not BULGE_TOL * far < bulge > measures.ARC_CLOSER_RATIO * off:
        return Trace(LINE, (spots[0], spots[-1])) if far > measures.MIN_LINE_MM else None
    if rim is None or off > measures.SHAPE_TOL * rim[1]:
        return None
    return Trace(CIRCLE, tuple(rim_spots))


def sharp_corners(corners: Sequence[Spot]) -> Iterator[Spot]:
    """The sharp corners of an outline, as the tip of an arrow's head is."""
    spots = [complex(*corner) for corner in corners]
    for before, vertex, after in zip([*spots[-1:], *spots], spots, [*spots[1:], *spots[:1]], strict=False):
        turn = (before - vertex) * (after - vertex).conjugate()
        if turn and abs(cmath.phase(turn)) < measures.MAX_TIP_RAD:
            yield vertex.real, vertex.imag


def open_heads(traces: Iterable[Trace]) -> Iterator[Spot]:
    """The tips of arrows whose heads are two short strokes, as long as each other, aslant on both sides of the shaft.
    """
    ways = defaultdict[Spot, list[complex]](list)  # of the strokes that end in a spot
    for trace in traces:
        if trace.kind == LINE:
            for begin, end in (trace.spots[:2], trace.spots[1::-1]):
                x, y = (round(coordinate, measures.POSITION_DIGITS - 1) for coordinate in begin)
                ways[x, y].append(complex(*end) - complex(*begin))
    for spot, strokes in ways.items():
        short = [way for way in strokes if abs(way) < measures.MAX_HEAD_MM][:measures.MAX_HEAD_SPOTS]
        for barb, second in combinations(short, 2):
            angle = abs(cmath.phase(barb / second))
            if (measures.MIN_HEAD_RAD < angle < measures.MAX_HEAD_RAD
                and math.isclose(abs(barb), abs(second), rel_tol=measures.SAME_BARBS_TOL) and any(
                    abs(cmath.phase(shaft / (barb / abs(barb) + second / abs(second)))) < measures.SAME_BARBS_TOL
                    for shaft in strokes if abs(shaft) > abs(barb))):
                yield spot
                break


def circle_through(first: Spot, second: Spot, third: Spot) -> tuple[Spot, float] | None:
    """Centre and radius of the circle through three spots; None where they lie on a line."""
    a, b, c = (complex(*spot) for spot in (first, second, third))
    u, v = b - a, c - a
    across = 2 * (u.conjugate() * v).imag
    if abs(across) <= COLLINEAR_TOL * abs(u) * abs(v):
        return None
    z = a + 1j * (v * abs(u) ** 2 - u * abs(v) ** 2) / -across
    return (z.real, z.imag), abs(z - a)


def visible_stretch(at: complex, along: complex, spots: Iterable[Spot]) -> tuple[Spot, Spot] | None:
    """Visible part of an endless line beside these spots; None if it is empty."""
    if not along:
        return None
    along /= abs(along)
    steps = [((complex(*spot) - at) * along.conjugate()).real for spot in spots]
    if not steps or min(steps) == max(steps):
        return None
    start, end = at + min(steps) * along, at + max(steps) * along
    return (start.real, start.imag), (end.real, end.imag)


def distance_off_line(line: Sequence[Spot], spot: Spot) -> float:
    """Distance of a spot from an endless line through two others."""
    a, b = complex(*line[0]), complex(*line[1])
    return abs(((complex(*spot) - a) * (b - a).conjugate()).imag) / abs(b - a) if a != b else math.dist(line[0], spot)


def extent(spots: Iterable[Spot]) -> float:
    """The diagonal of what spots cover."""
    xs, ys = zip(*spots, strict=True)
    return math.hypot(max(xs) - min(xs), max(ys) - min(ys))


def _chord_deviation(spots: Sequence[Spot]) -> float:
    """Largest distance of spots from the chord from the first to the last."""
    a, b = complex(*spots[0]), complex(*spots[-1])
    if a == b:
        return extent(spots)
    along = (b - a) / abs(b - a)
    offs = [(complex(*spot) - a) * along.conjugate() for spot in spots]
    return max(max(abs(off.imag), -off.real, off.real - abs(b - a)) for off in offs)


# ---- drawings -------------------------------------------------------------------------------------------------------


def word_at(text: str, at: Spot, size: float, anchor: float = 0.0) -> Lettering:
    """Words that are anchored at a part of their length: 0 at the beginning, 1 at the end; a subscript is smaller."""
    stem, _, index = text.partition("_")
    long = width((TextRun(stem), TextRun(index, -1)), size)
    return Lettering(text, (at[0] - anchor * long, at[1]), size, long)


def join_words(words: Sequence[Lettering]) -> list[Lettering]:
    """Words that stand apart in a file and together on the sheet, in the order of the file: smaller ones that are set
    lower become subscripts."""
    joined_words: list[Lettering] = []
    end = math.inf
    for word in words:
        if joined_words and (link := _join_text(joined_words[-1], end, word)) is not None:
            joined_words[-1] = word_at(joined_words[-1].text + link + word.text, joined_words[-1].at,
                                       joined_words[-1].size)
        else:
            joined_words.append(word)
        end = word.at[0] + word.long
    return joined_words


def _join_text(whole: Lettering, end: float, word: Lettering) -> str | None:
    """Text between a text and the word that continues it; None if it does not continue it."""
    drop, smaller = (whole.at[1] - word.at[1]) / whole.size, word.size / whole.size
    gap = abs(end - word.at[0]) / whole.size
    if gap > measures.SUBSCRIPT_GAP_SIZES or abs(drop) > measures.MAX_SUBSCRIPT_DROP_SIZES:
        return None
    if drop > measures.MIN_SUBSCRIPT_DROP_SIZES:
        is_small = SUBSCRIPT / 2 < smaller < measures.MAX_SUBSCRIPT_SIZE
        return "_" if is_small and "_" not in whole.text.rpartition(",")[2] else None
    return "" if abs(smaller - 1) < measures.SAME_SIZE_TOL and "_" in whole.text else None


def follow_leaders(words: Sequence[Lettering], traces: Sequence[Trace], leaders: Sequence[Trace] | None
        ) -> tuple[list[Lettering], list[Trace]]:
    """The words that name marks, with the ends of their leaders, and the traces without these. Some files know their
    `leaders`; in others none starts at a number or a Greek letter, as those stand where lines end, nor at letters that
    stand at a point of their own."""
    words = [word for word in words if word.names]
    if leaders is not None:
        words = words[:measures.MAX_WORDS]
        return _follow_aimed_leaders(words, _join_leaders(leaders)[:measures.MAX_WORDS]), list(traces)
    ends, taken = dict[int, tuple[float, Spot]](), set[Trace]()
    at_points = _words_at_points(words, traces)
    able = [place for place, word in enumerate(words) if not (place in at_points or can_name_line(word.names[0]))]
    boxes = STRtree([words[place].box for place in able])
    for stroke, near, mark in _likely_leaders(traces) if able else ():
        nearest = int(boxes.nearest(near))
        word, gap = able[nearest], float(boxes.geometries[nearest].distance(near))
        if gap < measures.LEADER_GAP_SIZES * words[word].size and gap < ends.get(word, (math.inf,))[0]:
            ends[word] = gap, (mark.x, mark.y)
            taken.add(stroke)
    led_words = [replace(word, leads=ends[place][1]) if place in ends else word for place, word in enumerate(words)]
    return led_words, [trace for trace in traces if trace not in taken]


def _words_at_points(words: Sequence[Lettering], traces: Sequence[Trace]) -> set[int]:
    """The words, by their places, that stand beside a point to which no other word is nearer."""
    boxes, at_points = STRtree([word.box for word in words]), set[int]()
    for point in (trace.figure for trace in traces if trace.kind == POINT and words):
        nearest = int(boxes.nearest(point))
        if boxes.geometries[nearest].distance(point) < measures.LEADER_GAP_SIZES * words[nearest].size:
            at_points.add(nearest)
    return at_points


def _join_leaders(leaders: Iterable[Trace]) -> list[Trace]:
    """Leaders with what goes on in their direction beyond letters that cut them, from the mark as far as that goes."""
    joined: list[Trace] = []
    for leader in (stroke for stroke in leaders if stroke.kind == LINE):
        (mark, cut), (begin, end) = joined[-1].spots[:2] if joined else leader.spots[::-1], leader.spots[:2]
        goes_on = math.dist(mark, cut) < math.dist(mark, begin) < math.dist(mark, end) < measures.MAX_LEADER_MM and all(
            distance_off_line((mark, end), spot) < measures.LEADER_BEND_MM for spot in (cut, begin))
        if goes_on:
            joined.pop()
        joined.append(Trace(LINE, (mark, end)) if goes_on else leader)
    return joined


def _follow_aimed_leaders(words: Sequence[Lettering], leaders: Sequence[Trace]) -> list[Lettering]:
    """Words with where their leaders end, on a sheet where every leader begins at its mark and aims at the nearest spot
    of its letters: others stand nearer to its end where they cut it. Of two that may be of the same letters it is the
    longer, as the shorter was cut."""
    boxes = STRtree([word.box for word in words])
    pairs = sorted((round(cost, 1), -stroke.figure.length, leader, int(word)) for leader, stroke in enumerate(leaders)
                   for word in boxes.query(Point(*stroke.spots[1]), "dwithin", measures.MAX_LEADER_MM)
                   if (cost := _leader_cost(stroke, words[word])) is not None)
    mark_of_word, free = dict[int, Spot](), set(range(len(leaders)))
    for _, _, leader, word in pairs:
        if leader in free and word not in mark_of_word:
            mark_of_word[word] = leaders[leader].spots[0]
            free.discard(leader)
    return [replace(letters, leads=mark_of_word.get(word)) for word, letters in enumerate(words)]


def _leader_cost(leader: Trace, word: Lettering) -> float | None:
    """Price of a leader for letters: its distance before them and its aim beside them, in letter sizes; None if it
    cannot be theirs."""
    mark, end = (complex(*spot) for spot in leader.spots[:2])
    left, line, right, top = word.box.bounds
    low = line - (INDEX_DEPTH if "_" in word.text else DEPTH) * word.size  # as the sheet has their box
    nearest = complex(min(max(mark.real, left), right), min(max(mark.imag, low), top))
    rest = (nearest - end) * (end - mark).conjugate() / (abs(end - mark) or 1.0) / word.size
    is_before = -measures.LEADER_ASIDE_SIZES < rest.real < measures.LEADER_CUT_SIZES
    cost = abs(rest.real) + measures.LEADER_ASIDE_COST * abs(rest.imag)
    return cost if is_before and abs(rest.imag) < measures.LEADER_ASIDE_SIZES else None


def _likely_leaders(traces: Sequence[Trace]) -> Iterator[tuple[Trace, Point, Point]]:
    """Yield the short strokes that may be leaders, each with its free end and the point that it leads to: past no other
    point, and not the continuation of a line through the point."""
    lines = [trace for trace in traces if trace.kind == LINE]
    points = STRtree([Point(*trace.spots[0]) for trace in traces if trace.kind == POINT])
    figures, strokes = STRtree([trace.figure for trace in traces]), STRtree([trace.figure for trace in lines])

    for line in lines:
        ends = [Point(*spot) for spot in line.spots]
        marked = [bool(len(points.query(end, "dwithin", measures.LEADER_MARK_MM))) for end in ends]
        if (line.figure.length > measures.MAX_LEADER_MM or sum(marked) != 1
                or len(points.query(line.figure, "dwithin", measures.LEADER_FREE_MM)) > 1):
            continue
        mark, end = ends if marked[0] else ends[::-1]
        through = (lines[place] for place in strokes.query(mark, "dwithin", measures.LEADER_MARK_MM))
        if len(figures.query(end, "dwithin", measures.LEADER_FREE_MM)) == 1 and not any(
                line_through is not line and distance_off_line(line_through.spots, (end.x, end.y))
                < measures.LEADER_FREE_MM for line_through in through):
            yield line, end, mark


LAYERS_NOT_DRAWN = frozenset({  # layers of graphplan's own sheets with nothing that a construction draws
    "paper", "border", "corner marks", "ruling", "frame", "text", "letters", "results", "ground", "wheels", "drive",
    "motion", "machine", "arms", "details", ENLARGED, *FACTS})


def same_paper(size: tuple[float, float], asked: tuple[float, float] | None) -> bool:
    """Whether one of graphplan's own files is of the size of paper that is asked for, if one is."""
    return asked is None or all(math.isclose(*pair, rel_tol=SIZE_TOL) for pair in zip(size, asked, strict=True))


class DrawingReader:
    """Reader of a drawing program's file: its drawn and written items, in mm; `own` tells whether it is one of
    graphplan's own sheets, `size` is that sheet's size, `millimetres` the certainty of its unit."""

    own: bool
    size: tuple[float, float]
    millimetres: float

    def __init__(self, path: Path):
        self.path = path
        self.traces: list[Trace] = []
        self.leaders: list[Trace] = []  # of a sheet of graphplan's own
        self.tips: list[Spot] = []
        self.words: list[Lettering] = []

    def submission(self, frames: Frames, size: tuple[float, float] | None) -> Submission:
        """The drawing as it was handed in; on graphplan's own sheet of this size plans lie where its frames say.

        Fails as `drawing_submission`.
        """
        known_frames = frames if self.own and same_paper(self.size, size) else {}
        blur = measures.OWN_ROUNDING_MM if self.own else 0.0  # by which lines cross elsewhere that are almost parallel
        traces = [replace(trace, blur=blur) if trace.kind == LINE else trace for trace in self.traces]
        return drawing_submission(self.path, traces, self.words, known_frames, self.tips,
                                  self.leaders if self.own else None, self.millimetres)


def _position(trace: Trace) -> tuple[object, ...]:
    """Position of a trace, as closely as files are drawn, and its label."""
    return trace.kind, trace.label, *(round(coordinate, measures.POSITION_DIGITS)
                                      for spot in trace.spots for coordinate in spot)


def drawing_submission(path: Path, traces: Iterable[Trace], words: Sequence[Lettering], frames: Frames,
                       tips: Sequence[Spot] = (), leaders: Sequence[Trace] | None = None, millimetres: float = 0.0
            ) -> Submission:
    """A drawing as it was handed in: what is drawn twice is one thing, and letters are tied to their leaders.

    Fails with `Refused` where something lies on no sheet, there is too much of it, or nothing at all.
    """
    once = list({_position(trace): trace for trace in dots_to_points(list(traces))}.values())
    Budget(path, measures.MAX_TRACES, "points, lines and circles").spend(len(once))
    for trace in once:
        if not on_paper(*chain.from_iterable(trace.spots)):
            raise Refused(f"{path}", f"a {trace.kind} lies farther away than {measures.MAX_DISTANCE_MM:g} mm, or "
                          "nowhere", "millimetres of paper as unit of the drawing")
    if not once:
        raise Refused(f"{path}", "it contains no point, line or circle", "give the drawing itself")
    sound = [word for word in words if word.size > 0 and on_paper(*word.at, word.size, word.long)]
    letters, remaining = follow_leaders(join_words(sound), once, leaders)
    shows = frozenset({LINE, *(trace.kind for trace in remaining)})
    ends = tuple(tip for tip in (*tips, *open_heads(once)) if on_paper(*tip))
    return Submission(path.name, tuple(remaining), shows=shows, frames=frames, tips=ends,
                      letters=tuple(letters[:measures.MAX_WORDS]),
                      millimetres=millimetres)
