"""The printed lines of squared or ruled paper in a picture, and the pencil without them.

They are equally far apart, one as dark as the other: their period is that which most rows of the picture share, where
they bend is told by its phase here and there, and how dark they are by what most of the picture has at each phase. A
line of the pencil keeps no such phase, so that it stays; squares that are made straight lay the whole picture straight.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import cv2
import numpy as np

from graphplan.marking.scans import measures
from graphplan.marking.scans.image import Light, Sizes, Spots
from graphplan.marking.scans.straighten import Warp, polynomial_terms


@dataclass(frozen=True)
class Ruling:
    """Printed lines across the first coordinate of a picture: how far apart they are in mm, and the polynomial of what
    their phase is, in turns, beyond that of straight lines along the other coordinate."""

    apart: float
    size: tuple[float, float]
    bend: Sizes

    def phase(self, spots: Spots) -> Sizes:
        """The phase at spots, in turns; a line is where it is whole."""
        return np.asarray(spots[:, 0] / self.apart
                          + polynomial_terms(spots, self.size, measures.RULING_DEGREE) @ self.bend)


def find_ruling(dark: Light, scale: float) -> Ruling | None:
    """The printed lines across the columns of a picture of so many pixels per mm; None without printed lines."""
    band, wide = round(measures.RULING_BAND_MM * scale), dark.shape[1]
    count = dark.shape[0] // band
    bands = np.minimum(dark[: count * band], measures.MAX_RULING_DARKNESS).reshape(count, band, wide)
    profile = np.asarray(np.median(bands, axis=1), np.float64)
    profile -= profile.mean(axis=1, keepdims=True)
    across = np.asarray((np.arange(wide) + 0.5) / scale, np.float64)
    along = np.asarray((np.arange(count) + 0.5) * band / scale, np.float64)
    least, most = (1 / apart for apart in measures.RULINGS_APART_MM[::-1])
    frequencies = np.arange(least, most, scale / (measures.RULING_FINENESS * wide))
    slopes = np.linspace(-measures.MAX_RULING_SLOPE, measures.MAX_RULING_SLOPE, measures.RULING_SLOPES)
    of_bands = profile * np.hanning(wide) @ np.exp(-2j * math.pi * np.outer(across, frequencies))
    slope_waves = np.exp(-2j * math.pi * np.multiply.outer(slopes, np.outer(along, frequencies)))
    strength = np.abs((of_bands * slope_waves).sum(axis=1))
    if strength.max() < measures.RULING_CLEAR_RATIO * np.median(strength):
        return None
    best = strength.max(axis=0)
    strong = np.flatnonzero(best > measures.RULING_LOWEST_SHARE * best.max())
    lowest = np.split(strong, np.flatnonzero(np.diff(strong) > 1) + 1)[0]  # others are multiples of it
    which = int(lowest[best[lowest].argmax()])
    slope = float(slopes[strength[:, which].argmax()])
    sides = wide / scale, dark.shape[0] / scale
    return _bent_ruling(profile, sides, across, along, float(frequencies[which]), slope)


def _bent_ruling(profile: Sizes, size: tuple[float, float], across: Sizes, along: Sizes, frequency: float,
                 slope: float) -> Ruling:
    """The lines of about this frequency and slope, as they bend: by the phases of pieces of bands."""
    middles = np.arange(measures.RULING_WINDOW_MM / 2, size[0], measures.RULING_WINDOW_MM / 4)
    near = np.clip(1 - np.abs(across[:, None] - middles) * 2 / measures.RULING_WINDOW_MM, 0, None)
    straight = np.exp(-2j * math.pi * frequency * slope * along)[:, None]
    pieces = straight * (profile @ (np.exp(-2j * math.pi * frequency * across)[:, None] * near))
    usual = pieces.sum() / np.abs(pieces.sum())
    turns = np.unwrap(np.unwrap(np.angle(pieces / usual), axis=1), axis=0) + np.angle(usual)
    beyond = (turns / (2 * math.pi) + frequency * slope * along[:, None]).ravel()
    spots = np.stack(np.meshgrid(middles, along), axis=-1).reshape(-1, 2)
    terms, weight = polynomial_terms(spots, size, measures.RULING_DEGREE), np.abs(pieces).ravel()
    off = np.zeros(pieces.size)
    for _ in range(measures.WARP_ITERATIONS):
        trust = weight * np.clip(1 - (off / measures.RULING_OFF_TURNS) ** 2, 0, None)
        bend = np.linalg.lstsq(terms * trust[:, None], beyond * trust, rcond=None)[0]
        off = beyond - terms @ bend
    return Ruling(1 / frequency, size, bend)


def without_ruling(dark: Light, ruling: Ruling, scale: float) -> Light:
    """A picture's darkness with printed lines taken off, each as dark as most of the picture is at its phase."""
    high, wide = dark.shape
    across, step = (np.arange(wide) + 0.5) / scale, measures.RULING_STRIDE
    phases = np.array([ruling.phase(np.column_stack([across, np.full(wide, along / scale)]))
                       for along in np.arange(step / 2, high + step / 2, step)], np.float32)
    bins = round(ruling.apart / measures.RULING_CELL_MM)
    cells = ((phases - np.floor(phases)) * bins).astype(np.intp) % bins
    rows = dark[step // 2 :: step]
    row_cells = cells[: len(rows)].ravel()
    order = np.argsort(row_cells)
    filled_cells, starts = np.unique(row_cells[order], return_index=True)
    darkness = [np.median(group) for group in np.split(rows.ravel()[order], starts[1:])]
    print_ = np.interp(np.arange(bins), filled_cells, darkness, period=bins)
    light = (1 - measures.RULING_SPREAD * np.maximum(print_ - np.median(print_), 0)).astype(np.float32)
    return np.asarray(np.clip(1 - (1 - dark) / np.repeat(light[cells], step, axis=0)[:high], 0, 1), np.float32)


def squared_warp(warp: Warp, across: Ruling, up: Ruling, side: float) -> Warp:
    """The way to lay a picture straight by squares that are so many mm wide, if it was laid by `warp` before, in which
    these lines run up the sheet and across it."""
    stretch = side / np.array([across.apart, up.apart])
    sides = float(warp.size[0] * stretch[0]), float(warp.size[1] * stretch[1])
    spots = np.stack(np.meshgrid(*(np.linspace(0, length, measures.RULING_PLACES) for length in warp.size)),
                     axis=-1).reshape(-1, 2)
    lines = side * np.column_stack([across.phase(spots), up.phase(spots[:, ::-1])])
    lines += (spots * stretch - lines).mean(axis=0)
    terms = polynomial_terms(lines, sides, measures.RULING_DEGREE)
    bend = np.asarray(np.linalg.lstsq(terms, spots * stretch - lines, rcond=None)[0], np.float64)
    return Warp(warp.plane @ np.diag([*(1 / stretch), 1.0]), sides, measures.RULING_DEGREE, bend)


def without_smudges(dark: Light, scale: float) -> Light:
    """Darkness above that of the surroundings, at so many pixels per mm, if dark enough for pencil, or beside it: after
    printed lines are removed, smudges and remains of lines look like dots."""
    window = 2 * round(measures.SMUDGE_MM * scale / 2) + 1
    background = cv2.medianBlur(np.round(255 * dark).astype(np.uint8), window).astype(np.float32) / 255
    darker = np.asarray(np.clip(dark - background, 0, None), np.float32)
    reach = np.ones((2 * round(measures.HALF_LINE_MM * scale) + 1,) * 2, np.uint8)
    is_pencil = cv2.dilate((darker > measures.MIN_INK_DARKNESS).astype(np.uint8), reach)
    return np.where(is_pencil, darker, np.float32(0.0))
