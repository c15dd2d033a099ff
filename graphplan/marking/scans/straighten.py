"""A picture of a sheet made straight: found by its coded marks, or by its frame, the largest dark rectangle; laid on
the printed one; then lens and paper taken out.

What is printed is known, so each piece of it says how far off it is seen. Across every straight piece of print the
lightness is read off in the picture and in the sheet as it should be; how far one must be shifted to fit the other is
one equation for the polynomial that bends the sheet. Pieces that a pencil has crossed are outweighed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

import cv2
import numpy as np
from shapely import LinearRing

from graphplan.errors import Refused
from graphplan.marking.scans import measures
from graphplan.marking.scans.image import Flags, Grey, Light, Spots, encode_jpeg, median_deviation, shrink, shrink_sides
from graphplan.marking.scans.printed_ink import Pieces, find_marks, print_pieces, signed_area
from graphplan.marking.tolerances import MIN_DIVISOR
from graphplan.sheet.frames.frame import WHITE, corner_rects
from graphplan.sheet.plates.display import Photograph, Rect, Sheet


@dataclass(frozen=True)
class Warp:
    """Takes spots of the sheet, in mm, to pixels: `bend` are the coefficients of a polynomial of this degree, by which
    the spots are first moved on the sheet, in mm."""

    plane: Spots
    size: tuple[float, float]
    degree: int = 0
    bend: Spots = field(default_factory=lambda: np.zeros((1, 2)))

    def __call__(self, spots: Spots) -> Spots:
        return project(self.plane, spots + self.displacement(spots))

    def displacement(self, spots: Spots) -> Spots:
        """By how much paper and lens move spots of the sheet, in mm."""
        return polynomial_terms(spots, self.size, self.degree) @ self.bend

    def maps(self, scale: float) -> tuple[Light, Light]:
        """Columns and rows in the picture for every pixel of the sheet, at so many pixels per mm, the top first."""
        wide, high = round(self.size[0] * scale), round(self.size[1] * scale)
        columns, rows = np.meshgrid(np.arange(0, wide + measures.WARP_GRID_PX, measures.WARP_GRID_PX),
                                    np.arange(0, high + measures.WARP_GRID_PX, measures.WARP_GRID_PX))
        spots = np.column_stack([(columns.ravel() + 0.5) / scale, self.size[1] - (rows.ravel() + 0.5) / scale])
        pixels = self(spots).reshape(*columns.shape, 2)
        return _interpolate_grid(pixels[..., 0], wide, high), _interpolate_grid(pixels[..., 1], wide, high)

    def fineness(self) -> float:
        """Pixels per mm in the middle of the sheet."""
        (x, y), half = (self.size[0] / 2, self.size[1] / 2), measures.FINENESS_MM / 2
        pixels = self(np.array([(x - half, y), (x + half, y), (x, y - half), (x, y + half)]))
        return float(min(np.hypot(*(pixels[1] - pixels[0])), np.hypot(*(pixels[3] - pixels[2]))) / measures.FINENESS_MM)


def project(plane: Spots, spots: Spots) -> Spots:
    """Spots through a projective map."""
    homogeneous = np.column_stack([spots, np.ones(len(spots))]) @ plane.T
    return np.asarray(homogeneous[:, :2] / homogeneous[:, 2:])


def polynomial_terms(spots: Spots, size: tuple[float, float], degree: int) -> Spots:
    """The terms of a polynomial at spots, by Chebyshev, from -1 to 1 over the sheet."""
    across, up = (np.polynomial.chebyshev.chebvander(2 * spots[:, i] / size[i] - 1, degree) for i in range(2))
    return np.column_stack([across[:, i] * up[:, j] for i, j in term_powers(degree)])


def term_powers(degree: int) -> list[tuple[int, int]]:
    """The powers of x and y in each term of a polynomial, up to this degree in all."""
    return [(total - j, j) for total in range(degree + 1) for j in range(total + 1)]


def _interpolate_grid(coarse: Spots, wide: int, high: int) -> Light:
    """Values at every pixel from those at every `GRID`th."""
    grow = np.array([[measures.WARP_GRID_PX, 0, 0], [0, measures.WARP_GRID_PX, 0]], float)
    return np.asarray(cv2.warpAffine(coarse.astype(np.float32), grow, (wide, high), flags=cv2.INTER_LINEAR,
                                     borderMode=cv2.BORDER_REPLICATE), np.float32)


def warps_by_frame(image: Grey, sheet: Sheet, light: Light) -> list[Warp]:
    """The planes in which the printed frame may be seen, the largest first, each turned so that the print fits."""
    print_size = round(sheet.width * measures.PRINT_PX_PER_MM), round(sheet.height * measures.PRINT_PX_PER_MM)
    small = cv2.resize(light, print_size, interpolation=cv2.INTER_AREA)
    ideal = np.asarray(cv2.GaussianBlur(small, (0, 0), measures.PRINT_PX_PER_MM), np.float32)
    warps = []
    for rim in _rectangles(image):
        turned = [np.roll(rim, turn, axis=0) for turn in range(4)]
        tried = [plane_warp(corners, corners_seen, (sheet.width, sheet.height))
                 for corners in _outlines(sheet) for corners_seen in turned]
        warps.append(max(tried, key=lambda warp: _correlation(image, warp, ideal)))
    return warps


def _outlines(sheet: Sheet) -> list[Spots]:
    """The frame's corners, and those of all straight print, which may go beyond it."""
    ink = print_pieces(sheet)
    half = ink.along * ink.halves[:, None]
    ends = np.concatenate([ink.middles - half, ink.middles + half])
    (left, bottom), (right, top) = ends.min(axis=0), ends.max(axis=0)
    return [np.array(sheet.frame.corners), np.array(Rect(left, bottom, right, top).corners)]


def _rectangles(image: Grey) -> Iterator[Spots]:
    """The largest four-sided rims in the picture, in pixels, in the sense in which a frame's corners go round."""
    small, scale = shrink_sides(image, measures.FRAME_SEARCH_PX)
    dark = cv2.adaptiveThreshold(small, 255, cv2.ADAPTIVE_THRESH_MEAN_C, cv2.THRESH_BINARY_INV,
                                 measures.FRAME_WINDOW_PX, measures.FRAME_SHADES)
    rims, _ = cv2.findContours(dark, cv2.RETR_LIST, cv2.CHAIN_APPROX_SIMPLE)
    large = sorted((rim for rim in rims if cv2.contourArea(rim) > measures.MIN_FRAME_SHARE * small.size),
                   key=cv2.contourArea)
    rectangles: list[Spots] = []
    for rim in large[::-1]:
        hull = cv2.convexHull(rim)
        four = cv2.approxPolyDP(hull, measures.FRAME_CORNER_SHARE * cv2.arcLength(rim, True),
                                True).reshape(-1, 2).astype(float)
        corners = _side_corners(hull.reshape(-1, 2).astype(float), four) if len(four) == 4 else None
        if corners is None or any(np.abs(corners - rectangle).max() < measures.SAME_RIM_SHARE * measures.FRAME_SEARCH_PX
                                  for rectangle in rectangles):
            continue
        rectangles.append(corners)
        yield (corners + 0.5) / scale - 0.5
        if len(rectangles) == measures.MAX_RECTANGLES:
            return


def _side_corners(hull: Spots, four: Spots) -> Spots | None:
    """The corners of a rectangle, in the sense in which a frame's go round, from the middles of its sides: whatever
    its corners themselves have lost."""
    around = four if signed_area(four) < 0 else four[::-1]
    around = np.roll(around, -int(around.sum(axis=1).argmin()), axis=0)
    rim = np.array(LinearRing(hull).segmentize(1.0).coords)
    sides = [_side_line(rim, first, second) for first, second in zip(around, np.roll(around, -1, axis=0), strict=True)]
    if any(side is None for side in sides):
        return None
    lines = np.array(sides)
    return np.array([np.linalg.solve([first[:2], second[:2]], [first[2], second[2]])
                     for first, second in zip(np.roll(lines, 1, axis=0), lines, strict=True)])


def _side_line(rim: Spots, one: Spots, two: Spots) -> tuple[float, float, float] | None:
    """The line along the middle of a side: its unit normal, and how far it is from the origin."""
    long = np.hypot(*(two - one))
    ahead = (two - one) / long
    along, off = (rim - one) @ ahead / long, (rim - one) @ np.array([-ahead[1], ahead[0]])
    middle = rim[(np.abs(along - 0.5) < measures.SIDE_MIDDLE_SHARE) & (np.abs(off) < measures.SIDE_OFF_SHARE * long)]
    if len(middle) < 2:
        return None
    at = middle.mean(axis=0)
    normal = np.linalg.eigh((middle - at).T @ (middle - at))[1][:, 0]
    return float(normal[0]), float(normal[1]), float(normal @ at)


def _correlation(image: Grey, warp: Warp, ideal: Light) -> float:
    """The correlation of a picture, straightened, with the print."""
    columns, rows = warp.maps(measures.PRINT_PX_PER_MM)
    picture = cv2.GaussianBlur(cv2.remap(image, columns, rows, cv2.INTER_LINEAR), (0, 0),
                               measures.PRINT_PX_PER_MM).astype(np.float32)
    picture -= cv2.GaussianBlur(picture, (0, 0), measures.SHADE_MM * measures.PRINT_PX_PER_MM)
    return float(np.corrcoef(picture.ravel(), ideal.ravel())[0, 1])


@dataclass(frozen=True)
class RegisteredWarp:
    """A warp that fits the print; `error` is what is left, as a standard deviation in mm, `share` how much of the print
    was found where it should be, and `own_share` of what only this task has; of a drawing that was not made on it the
    rest may be another."""

    warp: Warp
    error: float
    share: float
    own_share: float


def register_warp(image: Grey, start: Warp, light: Light, scale: float, pieces: Pieces) -> RegisteredWarp:
    """The warp by which a picture shows a sheet; `light` is the sheet as printed, at `scale` pixels per mm."""
    warp, error, near = start, measures.PROFILE_REACH_MM, np.zeros(0, bool)
    ideal = _profiles(light, lambda spots: np.column_stack([spots[:, 0], start.size[1] - spots[:, 1]]) * scale - 0.5,
                      pieces, measures.PROFILE_REACH_MM)
    is_visible = ideal.std(axis=1) > measures.MIN_PRINT_CONTRAST
    pieces, ideal = pieces.select(is_visible), ideal[is_visible]
    for reach, degree in measures.WARP_ROUNDS if len(ideal) >= measures.MIN_BENT_PIECES else measures.WARP_ROUNDS[:1]:
        shift, match = _profile_shifts(ideal, _profiles(image, warp, pieces, measures.PROFILE_REACH_MM + reach))
        warp, error, near = _fit_warp(warp, pieces, shift, match > measures.MIN_CORRELATION, degree, reach / 4)
    share, mine = float(near.sum() / max(1, len(ideal))), pieces.select(pieces.is_own)
    own_found = near[pieces.is_own]
    if len(own_found):
        profiles = _profiles(image, warp, mine, measures.PROFILE_REACH_MM)
        own_found = own_found | _are_overdrawn(ideal[pieces.is_own], profiles)
    return RegisteredWarp(warp, error, share, float(own_found.mean()) if len(own_found) else share)


def _profiles(image: Grey | Light, warp: Callable[[Spots], Spots], pieces: Pieces, reach: float) -> Light:
    """The lightness across each piece, averaged along it; so near by, a warp is as good as straight."""
    count = round(reach / measures.PROFILE_STEP_MM)
    side = np.column_stack([-pieces.along[:, 1], pieces.along[:, 0]])
    ends = pieces.along * (measures.PROFILE_SHARE * pieces.halves)[:, None]
    middle, end, off = (warp(spots) for spots in (pieces.middles, pieces.middles + ends, pieces.middles + side * reach))
    along, across = np.linspace(-1, 1, measures.PROFILE_PLACES), np.arange(-count, count + 1) / count
    pixels = (middle[:, None, None] + along[None, :, None, None] * (end - middle)[:, None, None]
              + across[None, None, :, None] * (off - middle)[:, None, None])
    pixels = pixels.reshape(len(side) * measures.PROFILE_PLACES, -1, 2).astype(np.float32)
    read = [cv2.remap(image, pixels[i : i + measures.PROFILE_ROWS, :, 0], pixels[i : i + measures.PROFILE_ROWS, :, 1],
                      cv2.INTER_LINEAR,
                      borderMode=cv2.BORDER_REPLICATE) for i in range(0, len(pixels), measures.PROFILE_ROWS)]
    values = np.concatenate(read).astype(np.float32).reshape(len(side), measures.PROFILE_PLACES, -1)
    return np.asarray(values.mean(axis=1), np.float32)


def _profile_shifts(ideal: Light, seen: Light) -> tuple[Spots, Spots]:
    """Shift of each profile, in mm, and its fit there: the peak of the correlation."""
    wide = ideal.shape[1]
    pattern = ideal - ideal.mean(axis=1, keepdims=True)
    pattern /= np.sqrt((pattern**2).sum(axis=1, keepdims=True))
    windows = np.lib.stride_tricks.sliding_window_view(seen, wide, axis=1)
    spread = np.sqrt(np.maximum(windows.var(axis=2) * wide, measures.WHITE_VARIANCE))
    match = np.einsum("ijk,ik->ij", windows, pattern) / spread
    best = np.clip(match.argmax(axis=1), 1, match.shape[1] - 2)
    row = np.arange(len(match))
    before, top, right = (match[row, best + i] for i in (-1, 0, 1))
    offset = (before - right) / np.minimum(2 * (before - 2 * top + right), -MIN_DIVISOR)
    return (best + np.clip(offset, -1, 1) - match.shape[1] // 2) * measures.PROFILE_STEP_MM, top


def _are_overdrawn(ideal: Light, seen: Light) -> Flags:
    """Whether each profile is as dark as print wherever print is: a pencil drawn along it hides its pattern, not its
    ink."""
    ink = ideal.max(axis=1, keepdims=True, initial=0.0) - ideal
    light = (ink * seen).sum(axis=1) / np.maximum(ink.sum(axis=1), MIN_DIVISOR)
    return np.asarray(light < measures.BLACK_SHARE * seen.max(axis=1, initial=0.0))


def _fit_warp(warp: Warp, pieces: Pieces, shift: Spots, good: Flags,
              degree: int, allowed: float) -> tuple[Warp, float, Flags]:
    """The warp bent to what the pieces say; also what is left, and which pieces agree."""
    side = np.column_stack([-pieces.along[:, 1], pieces.along[:, 0]])
    target = shift + (warp.displacement(pieces.middles) * side).sum(axis=1)
    base = polynomial_terms(pieces.middles, warp.size, degree)
    design = np.hstack([base * side[:, :1], base * side[:, 1:]])
    hold = np.tile([0.0 if i + j < 2 else 1.0 for i, j in term_powers(degree)], 2)
    trust = good * pieces.halves
    weight, residuals = trust, np.zeros(len(shift))
    for _ in range(measures.WARP_ITERATIONS):
        normal = (design.T @ (design * weight[:, None])
                  + np.diag((measures.PAPER_STIFFNESS * hold + MIN_DIVISOR) * max(weight.sum(), 1.0)))
        solution = np.linalg.solve(normal, design.T @ (weight * target))
        residuals = target - design @ solution
        weight = trust * np.clip(1 - (residuals / allowed) ** 2, 0, None) ** 2
    near = good & (np.abs(residuals) < allowed)
    error = median_deviation(residuals[near]) if near.any() else measures.PROFILE_REACH_MM
    return replace(warp, degree=degree, bend=solution.reshape(2, -1).T), error, near


def straighten(image: Grey, sheet: Sheet, light: Light, scale: float, code: int | None, name: str
               ) -> tuple[Light, RegisteredWarp]:
    """The picture laid over the printed sheet, of which `light` is the picture at `scale` pixels per mm: its lightness
    0..255, the top first, and the warp by which it shows the sheet.

    Fails with `Refused` where the sheet is not found, is another one, is cut off, or too coarse.
    """
    marks = find_marks(image, code, name)
    result = _lay_sheet(image, sheet, light, scale, marks)
    if result is None:
        raise Refused(name, "neither the corner marks nor the frame of this task was found: only drawings on the "
                      "printed task are read from pictures", "scan the whole printed task, or photograph it lying flat "
                      "in even light; of a drawing on other paper hand in measured points (.csv)")
    if result.own_share < measures.OWN_PRINT_SHARE:
        raise Refused(name, "the print of this task was not found on it",
                      "verify it against its own scene, plan, pose and paper, photographed lying flat; of a drawing on "
                      "other paper hand in measured points (.csv)")
    _require_whole(result.warp, image, sheet, name)
    return lay_straight(image, result.warp, scale), result


def _lay_sheet(image: Grey, sheet: Sheet, light: Light, scale: float, found: dict[int, Spots]) -> RegisteredWarp | None:
    """The sheet laid by its marks, or where some are lost, by its frame, whichever fits the print."""
    best, ink = None, print_pieces(sheet)
    for start in _first_warps(image, sheet, light, found):
        result = register_warp(image, start, light, scale, ink)
        best = result if best is None or result.share > best.share else best
        if best.share > measures.SURE_PRINT_SHARE:
            break
    return best


def _first_warps(image: Grey, sheet: Sheet, light: Light, found: dict[int, Spots]) -> Iterator[Warp]:
    """The ways to lay the sheet, the surest first."""
    if len(found) >= measures.MIN_MARKS:
        yield _warp_by_marks(found, sheet)
    if len(found) < measures.ALL_MARKS:
        yield from warps_by_frame(image, sheet, light)


def _warp_by_marks(found: dict[int, Spots], sheet: Sheet) -> Warp:
    """The plane through the corners of the marks."""
    rects = corner_rects(sheet.width, sheet.height, sheet.frame)
    printed = [spot for corner in found for spot in rects[corner].corners[::-1]]
    corners_seen = np.concatenate([found[corner] for corner in found])
    return plane_warp(np.array(printed), corners_seen, (sheet.width, sheet.height))


def plane_warp(spots: Spots, seen: Spots, size: tuple[float, float]) -> Warp:
    """The plane in which spots of a sheet of this size, in mm, are seen."""
    return Warp(np.asarray(cv2.findHomography(spots, seen)[0], float), size)


def _require_whole(warp: Warp, image: Grey, sheet: Sheet, name: str) -> None:
    """Refuse a picture that is too coarse, or that does not show all the plans."""
    dpi = warp.fineness() * measures.INCH_MM
    if dpi < measures.MIN_DPI:
        raise Refused(name, f"{dpi:.0f} dots per inch are too few to see pencil lines", "scan it at 200 dpi")
    high, wide = image.shape
    for panel, rect in sheet.panels.items():
        corners_seen = warp(np.array(rect.inset(measures.PANEL_MARGIN_MM, measures.PANEL_MARGIN_MM,
                                                measures.PANEL_MARGIN_MM,
                                                measures.PANEL_MARGIN_MM).corners))
        if (corners_seen < 0).any() or (corners_seen > [wide - 1, high - 1]).any():
            raise Refused(name, f"the {panel} is cut off", "scan or photograph the whole sheet")


# ---- to be drawn on: a sheet laid straight, or as it is -------------------------------------------------------------


LAYER = "scan"


def lay_straight(image: Grey, warp: Warp, scale: float) -> Light:
    """The sheet in a picture, laid straight, at so many pixels per mm."""
    columns, rows = warp.maps(scale)
    straight = cv2.remap(image, columns, rows, cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)
    return straight.astype(np.float32)


def straight_picture(image: Grey, warp: Warp) -> Grey:
    """The sheet in a picture, laid straight, at `FINE` pixels per mm."""
    columns, rows = warp.maps(measures.FACSIMILE_PX_PER_MM)
    return np.asarray(cv2.remap(shrink(image, measures.MAX_PAGE_PX), columns, rows, cv2.INTER_AREA, borderValue=255),
                      np.uint8)


def sheet_photograph(sheet: Grey) -> Photograph:
    """A straight sheet, or a piece of it, as it lies on paper."""
    high, wide = sheet.shape
    return Photograph(WHITE, LAYER, None,
                      Rect(0.0, 0.0, wide / measures.FACSIMILE_PX_PER_MM, high / measures.FACSIMILE_PX_PER_MM),
                      encode_jpeg(sheet, measures.FACSIMILE_JPEG_QUALITY), (wide, high))


def whole_photograph(image: Grey, longest: float = measures.A4_LONG_MM) -> Photograph:
    """A whole picture, on paper whose longer side is so many mm."""
    small = shrink(image, (longest * measures.FACSIMILE_PX_PER_MM) ** 2 * min(image.shape) / max(image.shape))
    photograph, (high, wide) = sheet_photograph(small), image.shape
    rect = Rect(0.0, 0.0, longest * wide / max(image.shape), longest * high / max(image.shape))
    return replace(photograph, rect=rect)


def cut_out(sheet: Grey, rect: Rect) -> Photograph:
    """A piece of a straight sheet, at the origin."""
    left, right = (round(side * measures.FACSIMILE_PX_PER_MM) for side in (rect.left, rect.right))
    low, high = (sheet.shape[0] - round(side * measures.FACSIMILE_PX_PER_MM) for side in (rect.bottom, rect.top))
    return sheet_photograph(np.ascontiguousarray(sheet[max(0, high) : low, max(0, left) : right]))
