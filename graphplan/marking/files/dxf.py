"""Drawings in DXF, of any CAD program: points, lines and circles in mm, blocks opened, with their letters."""

from __future__ import annotations

import io
import logging
import math
import re
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, TypeVar

import ezdxf
from ezdxf.filemanagement import dxf_stream_info
from ezdxf.lldxf.encoding import decode_dxf_unicode
from ezdxf.recover import read
from ezdxf.tools.text import plain_mtext
from ezdxf.units import MM, conversion_factor

from graphplan.errors import Refused
from graphplan.kernel.kinds import CIRCLE, LINE, POINT
from graphplan.marking.files import measures
from graphplan.marking.files.drawing import (
    LAYERS_NOT_DRAWN,
    DrawingReader,
    arc_spots,
    chain_traces,
    circle_trace,
    dot_or_circle,
    recognize_curve,
    sharp_corners,
    visible_stretch,
    word_at,
)
from graphplan.marking.files.safe import Budget, contents
from graphplan.marking.traces import Frames, Spot, Submission, Trace
from graphplan.sheet.lettering.lettering import CAPS
from graphplan.sheet.plates.display import ENLARGED

T = TypeVar("T")

logging.getLogger("ezdxf").addHandler(logging.NullHandler())  # what it mends in a file it would tell on standard error
# in texts of several levels
SUPERSCRIPT, SUBSCRIPT_CODE = re.compile(r"\\S([^;^]+)\^ ?;"), re.compile(r"\\S\^ ?([^;^]+);")
OWN_APPLICATION = "GRAPHPLAN"  # whose extended data our own sheets have
# how layers of our own begin: of what is beside the sheet, and of its own
FULL_SIZE_LAYER, SHEET_LAYER = "MECHANISM 1-1", "SHEET "
ANCHOR_SHARES = {"LEFT": 0.0, "CENTER": 0.5, "RIGHT": 1.0, "MIDDLE": 0.5}


def read_dxf(path: Path, frames: Frames, size: tuple[float, float] | None = None) -> Submission:
    """The things drawn in the model space of a DXF file; on graphplan's own sheet of this size plans lie where its
    frames say."""
    def read_model_space(document: Any) -> _DxfReader:
        reader = _DxfReader(path, document)
        reader.read(document.modelspace(), 0)
        reader.add_endless_lines()
        return reader

    reader = read_document(path, contents(path, measures.MAX_DXF_BYTES), read_model_space)
    return reader.submission(frames, size)


def read_document(path: Path, data: bytes, read_out: Callable[[Any], T]) -> T:
    """Read from a document as ezdxf has it; fails with `Refused` if it is damaged."""
    try:
        return read_out(_load_document(_check_size(path, data)))
    except Refused:
        raise
    except Exception as error:  # whatever ezdxf stumbles over in a stranger's file
        reason = " ".join(f"{type(error).__name__} {error}".split())[:80]
        raise Refused(f"{path}", f"the drawing is damaged ({reason})", "save it anew") from None


def _load_document(data: bytes) -> Any:
    """The file as ezdxf has it, repaired where it must be."""
    try:
        coding = dxf_stream_info(io.StringIO(data.decode("latin-1"))).encoding
        return ezdxf.read(io.StringIO(decode_dxf_unicode(_decode(data, coding))))
    except Exception:  # whatever it stumbles over, recovery may not
        return read(io.BytesIO(data))[0]


def _decode(data: bytes, coding: str) -> str:
    """The text of a file: many programs write Unicode whatever coding they state."""
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return data.decode(coding, "surrogateescape")


def _check_size(path: Path, data: bytes) -> bytes:
    """The data, if they are a DXF as text that is read in a short time."""
    if data.startswith(b"AutoCAD Binary DXF"):
        raise Refused(f"{path}", "it is a binary DXF", "save it as DXF in text (ASCII)")
    if b"SECTION" not in data[:4096]:
        raise Refused(f"{path}", "not a DXF file", "give a DXF drawing")
    for pattern, most, unit in ((rb"\n", measures.MAX_LINES, "lines"),
                                (rb"\n *0\r?\n", measures.MAX_ENTITIES, "entities")):
        if sum(1 for _ in re.finditer(pattern, data)) > most:
            raise Refused(f"{path}", f"it has more than {most} {unit}", "a file of the drawing alone")
    return data


class _DxfReader(DrawingReader):
    """Reads one document, block by block."""

    def __init__(self, path: Path, document: Any):
        super().__init__(path)
        self.own = OWN_APPLICATION in document.appids
        self.millimetres = measures.STATED_UNIT_ODDS if document.units else 0.0
        self.short = measures.MIN_LINE_MM if document.units else 0.0
        self.mm = conversion_factor(document.units, MM) if document.units else 1.0
        self.origin = (0.0, 0.0)  # in units of the drawing: the lower left corner of a sheet of graphplan's own
        corners = [document.header.get(key, (0.0, 0.0)) for key in ("$LIMMIN", "$LIMMAX")]
        (left, bottom), (right, top) = map(self._spot, corners)
        self.size = right - left, top - bottom  # of the sheet in mm, which stays when something is drawn beyond it
        self.origin = corners[0][:2] if self.own else self.origin
        self.lines: list[tuple[complex, complex]] = []
        self.budget = Budget(path, 2 * measures.MAX_TRACES, "entities")
        self.hidden = {layer.dxf.name for layer in document.layers if layer.is_off() or layer.is_frozen()}

    def read(self, entities: Iterable[Any], depth: int) -> None:
        """All that entities show, those of blocks among them."""
        for entity in entities:
            self.budget.spend()
            layer = entity.dxf.get("layer", "0")
            if layer in self.hidden or layer.startswith(FULL_SIZE_LAYER) or entity.dxf.get("invisible", 0):
                continue
            own_layer = self._own_layer(entity, layer) if self.own else ""
            if own_layer == ENLARGED:
                continue  # what lies on a plan once more
            if entity.dxftype() == "INSERT":
                self._block(entity, depth)
            elif entity.dxftype() in ("TEXT", "MTEXT", "ATTRIB"):
                self._add_words(entity)
            elif entity.dxftype() == "SOLID":  # the last two of its corners come the other way round
                first, second, *last = map(self._spot, entity.vertices())
                self.tips += sharp_corners([first, second, *reversed(last)])
            elif own_layer not in LAYERS_NOT_DRAWN:
                traces = list(self._traces(entity))
                if self.own:  # of which the size is known
                    traces = list(map(dot_or_circle, traces))
                self.budget.spend(len(traces))
                self.traces += traces
            elif own_layer == "letters" and entity.dxftype() == "LINE":
                self.leaders += self._traces(entity)

    def _own_layer(self, entity: Any, layer: str) -> str:
        """The layer of graphplan's own sheet: what of a step is no drawing bears it, all else is on it."""
        named_layer = entity.get_xdata(OWN_APPLICATION)[0].value if entity.has_xdata(OWN_APPLICATION) else ""
        return named_layer if named_layer in LAYERS_NOT_DRAWN else layer.removeprefix(SHEET_LAYER).partition("-")[0]

    def _block(self, insert: Any, depth: int) -> None:
        """A block where it is put, each of its copies."""
        if depth >= measures.MAX_BLOCK_DEPTH:
            raise Refused(f"{self.path}", f"blocks are nested more than {measures.MAX_BLOCK_DEPTH} deep",
                          "explode the blocks")
        self.budget.spend(max(0, insert.mcount - 1))
        for copy in insert.multi_insert() if insert.mcount > 1 else [insert]:
            self.read(copy.virtual_entities(), depth + 1)
            self.read(copy.attribs, depth + 1)

    def _traces(self, entity: Any) -> Iterator[Trace]:
        """Yield the traces of an entity on paper."""
        match entity.dxftype():
            case "POINT":
                yield Trace(POINT, (self._spot(entity.dxf.location),))
            case "LINE":
                yield from chain_traces([self._spot(entity.dxf.start), self._spot(entity.dxf.end)], self.short)
            case "XLINE" | "RAY":
                start, along = entity.dxf.start, entity.dxf.unit_vector
                self.lines.append((complex(*self._spot(start)), complex(along.x, along.y)))
            case "CIRCLE":
                yield circle_trace(self._spot(entity.ocs().to_wcs(entity.dxf.center)), entity.dxf.radius * self.mm)
            case "ARC":
                yield self._arc(entity)
            case "ELLIPSE":
                ends = entity.dxf.start_param, entity.dxf.end_param
                sweep = (ends[1] - ends[0]) % math.tau or math.tau
                at = [ends[0] + sweep * i / measures.ELLIPSE_SPOTS for i in range(measures.ELLIPSE_SPOTS + 1)]
                yield from filter(None, [recognize_curve([self._spot(vertex) for vertex in entity.vertices(at)])])
            case "LWPOLYLINE" | "POLYLINE":
                yield from self._polyline(entity)
            case "HATCH":
                yield from self._filling_dots(entity)
            case "SPLINE":
                self.budget.spend(len(entity.control_points) + len(entity.fit_points))
                curve = entity.construction_tool().approximate(measures.ELLIPSE_SPOTS)
                spots = [self._spot(vertex) for vertex in curve]
                yield from filter(None, [recognize_curve(spots)])

    def _arc(self, arc: Any) -> Trace:
        """An arc by its rim, also where it is seen from behind."""
        centre, radius = self._spot(arc.ocs().to_wcs(arc.dxf.center)), arc.dxf.radius * self.mm
        start, end = arc.dxf.start_angle, arc.dxf.end_angle
        if arc.dxf.extrusion.z < 0:
            start, end = 180 - end, 180 - start
        return Trace(CIRCLE, arc_spots(centre, radius, start, end))

    def _polyline(self, polyline: Any) -> Iterator[Trace]:
        """Straight pieces together, bulges as arcs."""
        self.budget.spend(len(polyline))
        if polyline.dxftype() == "LWPOLYLINE" and polyline.closed and [abs(bulge) for *_, bulge in polyline] == [1, 1]:
            yield self._circle_of_halves(*polyline.vertices_in_wcs())
            return
        chain: list[Spot] = []
        for segment in polyline.virtual_entities():
            if segment.dxftype() == "LINE":
                ends = [self._spot(segment.dxf.start), self._spot(segment.dxf.end)]
                if chain and chain[-1] != ends[0]:
                    yield from chain_traces(chain, self.short)
                    chain = []
                chain += ends[len(chain) > 0 :]
            elif segment.dxftype() == "ARC":
                yield self._arc(segment)
        yield from chain_traces(chain, self.short)

    def _circle_of_halves(self, one: Any, other: Any) -> Trace:
        """A circle of two halves, as rings and filled dots are drawn."""
        (x, y), (u, v) = self._spot(one), self._spot(other)
        return circle_trace(((x + u) / 2, (y + v) / 2), math.hypot(u - x, v - y) / 2)

    def _filling_dots(self, hatch: Any) -> Iterator[Trace]:
        """The dots of a filling; anything larger has its outline."""
        for path in hatch.paths.rendering_paths(hatch.dxf.hatch_style):
            if hasattr(path, "vertices"):
                corners = [self._spot(vertex) for vertex in [*path.vertices, *path.vertices[:1]]]
                trace = self._circle_of_halves(*path.vertices) if len(path.vertices) == 2 else recognize_curve(corners)
            else:
                rings = [edge for edge in path.edges if edge.type.name == "ARC" and len(path.edges) == 1]
                trace = circle_trace(self._spot(rings[0].center), rings[0].radius * self.mm) if rings else None
            if trace and (point := dot_or_circle(trace)).kind == POINT:
                yield point

    def add_endless_lines(self) -> None:
        """Lines without ends, as far as they lie beside the rest."""
        spots = [spot for trace in self.traces for spot in trace.spots]
        self.traces += [Trace(LINE, ends) for at, along in self.lines if (ends := visible_stretch(at, along, spots))]

    def _add_words(self, entity: Any) -> None:
        """Letters, by the place and the height that they have on paper."""
        if entity.dxftype() == "MTEXT":
            text = plain_mtext(SUBSCRIPT_CODE.sub(r"_\1", SUPERSCRIPT.sub(r"\1", entity.text))).strip()
            high, (row, column) = entity.dxf.char_height * self.mm, divmod(entity.dxf.attachment_point - 1, 3)
            (x, y), lower, anchor = self._spot(entity.dxf.insert), 1 - row / 2, column / 2
        else:
            text = entity.plain_text().strip()
            high, (align, first, second) = entity.dxf.height * self.mm, entity.get_placement()
            anchor = next((anchor for name, anchor in ANCHOR_SHARES.items() if align.name.endswith(name)), 0.0)
            x, y = self._spot(second if anchor and second is not None else first)
            lower = 1.0 if "TOP" in align.name else 0.5 if "MIDDLE" in align.name else 0.0
        if high > 0 and "\n" not in text and not (self.own and x > self.size[0] + measures.WORDS_PAGE_GAP_MM):
            place = x, y - lower * high
            self.words.append(word_at(text.replace("^ ", "_").replace("^", ""), place, high / CAPS, anchor))

    def _spot(self, vector: Any) -> Spot:
        return (vector[0] - self.origin[0]) * self.mm, (vector[1] - self.origin[1]) * self.mm
