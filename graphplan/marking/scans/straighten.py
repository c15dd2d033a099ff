"""A picture of a sheet made straight: laid on the printed one by its marks or its frame, then lens and paper taken out.

What is printed is known, so each piece of it says how far off it is seen. Across every straight piece of print the
lightness is read off in the picture and in the sheet as it should be; how far one must be shifted to fit the other is
one equation for the polynomial that bends the sheet. Pieces that a pencil has crossed are outweighed."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from graphplan.errors import Refused
from graphplan.marking.scans.image import Grey, deviation
from graphplan.marking.scans.printed_ink import Light, Pieces, pieces
from graphplan.marking.scans.sheet_finder import by_frame, find
from graphplan.marking.scans.warp import Spots, Warp, powers, terms
from graphplan.sheet.frames.corner_marks import places
from graphplan.sheet.plates.display import Sheet

STEP, NEAR = 0.125, 1.0  # mm across a piece: how closely it is read off, and how far to each side of its middle
ALONG, ROWS = 9, 32000  # places along a piece; rows of pixels that are read in one go
FITS, VISIBLE = 0.6, 0.03  # correlation from which on a piece counts, and the least contrast of its print
PLAIN = 1.0  # the square of a shade of grey: what varies less is white
ROUNDS = (2.5, 1), (2.5, 3), (1.5, 4), (0.75, 5), (0.375, 5)  # how far is searched, in mm, and the degree fitted
STIFF = 1e-5  # how much bends are held back, beside all the evidence
FEW = 40  # pieces below which only the plane is moved


@dataclass(frozen=True)
class Registered:
    """A warp that fits the print; `error` is what is left, as a standard deviation in mm, `share` how much of the
    print was found where it should be."""

    warp: Warp
    error: float
    share: float


def registered(image: Grey, start: Warp, light: Light, scale: float, pieces: Pieces) -> Registered:
    """The warp by which a picture shows a sheet; `light` is the sheet as printed, at `scale` pixels per mm."""
    warp, error, share = start, NEAR, 0.0
    ideal = _profiles(light, lambda spots: _upright(spots, start.size[1], scale), pieces, NEAR)
    seen = ideal.std(axis=1) > VISIBLE
    pieces = Pieces(pieces.middles[seen], pieces.along[seen], pieces.halves[seen])
    ideal = ideal[seen]
    for reach, degree in ROUNDS if len(ideal) >= FEW else ROUNDS[:1]:
        profiles = _profiles(image, warp, pieces, NEAR + reach)
        shift, match = _shifts(ideal, profiles)
        good = match > FITS
        warp, error, near = _fitted(warp, pieces, shift, good, degree, reach / 4)
        share = float(near.sum() / max(1, len(ideal)))
    return Registered(warp, error, share)


def _upright(spots: Spots, height: float, scale: float) -> Spots:
    """Where spots are in the straight picture of a sheet."""
    return np.column_stack([spots[:, 0], height - spots[:, 1]]) * scale - 0.5


def _profiles(image: Grey | Light, warp: Callable[[Spots], Spots], pieces: Pieces, reach: float) -> NDArray[np.float32]:
    """The lightness across each piece, averaged along it; so near by, a warp is as good as straight."""
    import cv2

    count = round(reach / STEP)
    side = np.column_stack([-pieces.along[:, 1], pieces.along[:, 0]])
    ends = pieces.along * (0.8 * pieces.halves)[:, None]
    middle, end, off = (warp(spots) for spots in (pieces.middles, pieces.middles + ends, pieces.middles + side * reach))
    along, across = np.linspace(-1, 1, ALONG), np.arange(-count, count + 1) / count
    seen = (middle[:, None, None] + along[None, :, None, None] * (end - middle)[:, None, None]
            + across[None, None, :, None] * (off - middle)[:, None, None])
    seen = seen.reshape(len(side) * ALONG, -1, 2).astype(np.float32)
    read = [cv2.remap(image, seen[i : i + ROWS, :, 0], seen[i : i + ROWS, :, 1], cv2.INTER_LINEAR,
                      borderMode=cv2.BORDER_REPLICATE) for i in range(0, len(seen), ROWS)]
    values = np.concatenate(read).astype(np.float32).reshape(len(side), ALONG, -1)
    return np.asarray(values.mean(axis=1), np.float32)


def _shifts(ideal: NDArray[np.float32], seen: NDArray[np.float32]) -> tuple[Spots, Spots]:
    """How far each profile is off, in mm, and how well it fits there: the peak of the correlation."""
    wide = ideal.shape[1]
    pattern = ideal - ideal.mean(axis=1, keepdims=True)
    pattern /= np.sqrt((pattern**2).sum(axis=1, keepdims=True))
    windows = np.lib.stride_tricks.sliding_window_view(seen, wide, axis=1)
    spread = np.sqrt(np.maximum(windows.var(axis=2) * wide, PLAIN))
    match = np.einsum("ijk,ik->ij", windows, pattern) / spread
    best = np.clip(match.argmax(axis=1), 1, match.shape[1] - 2)
    row = np.arange(len(match))
    left, top, right = (match[row, best + i] for i in (-1, 0, 1))
    part = (left - right) / np.minimum(2 * (left - 2 * top + right), -1e-9)
    return (best + np.clip(part, -1, 1) - match.shape[1] // 2) * STEP, top


def _fitted(warp: Warp, pieces: Pieces, shift: Spots, good: NDArray[np.bool_],
            degree: int, allowed: float) -> tuple[Warp, float, NDArray[np.bool_]]:
    """The warp bent to what the pieces say; also what is left, and which pieces agree."""
    side = np.column_stack([-pieces.along[:, 1], pieces.along[:, 0]])
    wanted = shift + (warp.moved(pieces.middles) * side).sum(axis=1)
    base = terms(pieces.middles, warp.size, degree)
    design = np.hstack([base * side[:, :1], base * side[:, 1:]])
    hold = np.tile([0.0 if i + j < 2 else 1.0 for i, j in powers(degree)], 2)
    trust = good * pieces.halves
    weight, left = trust, np.zeros(len(shift))
    for _ in range(6):
        normal = design.T @ (design * weight[:, None]) + np.diag((STIFF * hold + 1e-9) * max(weight.sum(), 1.0))
        solution = np.linalg.solve(normal, design.T @ (weight * wanted))
        left = wanted - design @ solution
        weight = trust * np.clip(1 - (left / allowed) ** 2, 0, None) ** 2
    near = good & (np.abs(left) < allowed)
    error = deviation(left[near]) if near.any() else NEAR
    return replace(warp, degree=degree, bend=solution.reshape(2, -1).T), error, near


LEAST_DPI, INCH = 100.0, 25.4
ENOUGH, ALL = 3, 4  # marks by which a sheet may be laid, and is laid without a doubt
OWN, SURE = 0.5, 0.95  # the share of the print that is found on its own sheet, and by which it is known
MARGIN = 1.0  # mm by which a plan may be off the picture


def straighten(image: Grey, sheet: Sheet, light: Light, scale: float, code: int | None, name: str
               ) -> tuple[NDArray[np.float32], Registered]:
    """The picture laid over the printed sheet, of which `light` is the picture at `scale` pixels per mm: its lightness
    0..255, the top first, and the warp by which it shows the sheet.

    Fails with `Refused` where the sheet is not found, is another one, is cut off, or too coarse.
    """
    import cv2

    found = find(image, code, name)
    result = _laid(image, sheet, light, scale, found)
    if result is None:
        raise Refused(name, "neither the corner marks nor the frame of this task are found in it",
                      "photograph the whole sheet with its four corner marks, lying flat, in even light")
    if result.share < OWN:
        raise Refused(name, "what is printed on it is not found where this task has it",
                      "verify it against its own scene, plan and paper, and photograph the sheet lying flat")
    _whole(result.warp, image, sheet, name)
    columns, rows = result.warp.maps(scale)
    straight = cv2.remap(image, columns, rows, cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE)
    return straight.astype(np.float32), result


def _laid(image: Grey, sheet: Sheet, light: Light, scale: float, found: dict[int, Spots]) -> Registered | None:
    """The sheet laid by its marks, or where some are lost, by its frame, whichever fits the print."""
    best, ink = None, pieces(sheet)
    for start in _starts(image, sheet, light, found):
        result = registered(image, start, light, scale, ink)
        best = result if best is None or result.share > best.share else best
        if best.share > SURE:
            break
    return best


def _starts(image: Grey, sheet: Sheet, light: Light, found: dict[int, Spots]) -> Iterator[Warp]:
    """The ways to lay the sheet, the surest first."""
    if len(found) >= ENOUGH:
        yield _by_marks(found, sheet)
    if len(found) < ALL:
        yield from by_frame(image, sheet, light)


def _by_marks(found: dict[int, Spots], sheet: Sheet) -> Warp:
    """The plane through the corners of the marks."""
    import cv2

    rects = places(sheet.width, sheet.height, sheet.frame)
    printed = [spot for corner in found for spot in rects[corner].corners[::-1]]
    seen = np.concatenate([found[corner] for corner in found])
    plane, _ = cv2.findHomography(np.array(printed), seen)
    return Warp(np.asarray(plane, float), (sheet.width, sheet.height))


def _whole(warp: Warp, image: Grey, sheet: Sheet, name: str) -> None:
    """Refuse a picture that is too coarse, or that does not show all the plans."""
    dpi = warp.fineness() * INCH
    if dpi < LEAST_DPI:
        raise Refused(name, f"{dpi:.0f} dots per inch are too few to see pencil lines", "scan it at 200 dpi")
    high, wide = image.shape
    for panel, rect in sheet.panels.items():
        seen = warp(np.array(rect.inset(MARGIN, MARGIN, MARGIN, MARGIN).corners))
        if (seen < 0).any() or (seen > [wide - 1, high - 1]).any():
            raise Refused(name, f"the {panel} is cut off", "scan or photograph the whole sheet")
