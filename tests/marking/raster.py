"""Hand drawings as a scanner or a phone sees them: a printed page, pencil strokes on it, and all that spoils a picture.

One number decides everything, so that a picture is the same in every run. Strokes are chains of spots in mm of the
sheet with a pencil's width and darkness; where they came from, these pictures do not know.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from graphplan.output.png import png
from graphplan.sheet.plates.display import Sheet

PHONE = 4032, 3024  # pixels: 12 megapixels
INCH, FINE = 25.4, 8.0  # mm; the page is drawn in so many pixels per mm before anyone looks at it
Image = NDArray[np.float32]
Stroke = tuple[Sequence[tuple[float, float]], float, float]  # spots in mm, the pencil's width in mm, its darkness 0..1


@dataclass(frozen=True)
class Hand:
    """How a student draws: wobble in mm, overshoot at the ends of lines in mm, and how many smudges are left."""

    wobble: tuple[float, float] = (0.03, 0.08)
    overshoot: float = 1.5
    smudges: int = 3


@dataclass(frozen=True)
class Printed:
    """A page as the printer left it: its size in mm, and its lightness 0..1, `FINE` pixels per mm."""

    width: float
    height: float
    page: Image


def printed(sheet: Sheet) -> Printed:
    """A sheet from the printer, a little soft."""
    picture = cv2.imdecode(np.frombuffer(png(sheet, FINE * INCH), np.uint8), cv2.IMREAD_GRAYSCALE)
    return Printed(sheet.width, sheet.height, cv2.GaussianBlur(picture.astype(np.float32) / 255, (0, 0), 0.5))


@dataclass(frozen=True)
class Picture:
    """A picture, and where each spot of the sheet is in it: `seen` takes spots in mm to pixels."""

    image: NDArray[np.uint8]
    turn: NDArray[np.float64]
    bend: float = 0.0

    def seen(self, spots: NDArray[np.float64]) -> NDArray[np.float64]:
        """Where spots of the sheet, in mm, are in the picture, in pixels."""
        flat = cv2.perspectiveTransform(np.asarray(spots, float).reshape(-1, 1, 2), self.turn).reshape(-1, 2)
        return _bent(flat, self.image.shape, self.bend)


def drawn(sheet: Printed, strokes: Sequence[Stroke], seed: int, hand: Hand | None = None) -> Image:
    """The page with its strokes, lightness 0..1, `FINE` pixels per mm."""
    hand, chance = hand or Hand(), np.random.default_rng(seed)
    page = sheet.page.copy()
    pencil = np.zeros_like(page)
    for spots, width, dark in strokes:
        _stroke(pencil, _wobbling(np.asarray(spots, float), hand, chance), width, dark, sheet.height, chance)
    grain = cv2.GaussianBlur(chance.standard_normal(page.shape, np.float32), (0, 0), 0.8)
    pencil *= np.clip(1 + 0.9 * grain, 0, 1)  # graphite stays on the hills of the paper
    for _ in range(hand.smudges):
        _smudge(pencil, chance)
    page *= 1 - np.clip(pencil, 0, 1)
    page += 0.012 * grain
    return page


def scan(sheet: Printed, strokes: Sequence[Stroke], seed: int, *, dpi: float = 200.0, quarters: int = 0,
         hand: Hand | None = None) -> Picture:
    """The page on a flatbed: a little askew, stretched by the feed, turned by quarters of a full turn."""
    chance = np.random.default_rng([seed, 1])
    fine, scale = drawn(sheet, strokes, seed, hand), dpi / INCH
    width, height = round(sheet.width * scale), round(sheet.height * scale)
    askew, feed = math.radians(chance.uniform(-0.8, 0.8)), 1 + chance.uniform(-0.002, 0.002)
    shift = chance.uniform(-0.7, 0.7, 2) * scale
    turn = np.array([[scale * math.cos(askew), -scale * math.sin(askew), 0.0],
                     [scale * feed * math.sin(askew), scale * feed * math.cos(askew), 0.0], [0, 0, 1]])
    middle = np.array([width, height]) / 2 - (turn[:2, :2] @ [sheet.width / 2, sheet.height / 2]) + shift
    turn[:2, 2] = middle
    image = _looked_at(fine, turn, (width, height), 0.0, 0.97)
    image = cv2.GaussianBlur(image, (0, 0), chance.uniform(0.5, 0.8))
    image *= _shade(image.shape, chance, 0.04)
    image = _noisy(image, chance, 0.012)
    final = turn @ _flip(sheet)
    for _ in range(quarters % 4):
        image, final = np.rot90(image), _quarter(image.shape) @ final
    return Picture(_stored(image, chance, 88), final)


def photo(sheet: Printed, strokes: Sequence[Stroke], seed: int, *, tilt: float = 15.0, around: float = 8.0,
          size: tuple[int, int] = PHONE, hand: Hand | None = None) -> Picture:
    """The page on a table before a phone: tilted, turned, bent by the lens, a shadow across it."""
    chance = np.random.default_rng([seed, 2])
    fine = drawn(sheet, strokes, seed, hand)
    turn = _view(sheet, size, chance, tilt, around)
    bend = chance.uniform(-0.02, 0.012)
    image = _looked_at(fine, turn, size, bend, 0.45)
    image = cv2.GaussianBlur(image, (0, 0), chance.uniform(0.7, 1.2))
    image *= _shade(image.shape, chance, 0.18) * _shadow(image.shape, chance)
    image = _noisy(0.9 * image, chance, 0.018)
    return Picture(_stored(image, chance, 85), turn @ _flip(sheet), bend)


# ---- the pencil ----------------------------------------------------------------------------------------------------


def _wobbling(spots: NDArray[np.float64], hand: Hand, chance: np.random.Generator) -> NDArray[np.float64]:
    """Spots every 0.05 mm along the stroke, drawn past its ends, off to its side by a slow wobble."""
    if len(spots) < 2 or (math.dist(spots[0], spots[-1]) < 1e-9 and len(spots) == 2):
        return spots
    if len(spots) == 2 and hand.overshoot:
        along = (spots[1] - spots[0]) / math.dist(*spots)
        spots = spots + np.outer(chance.uniform(0, hand.overshoot, 2) * [-1, 1], along)
    legs = np.hypot(*np.diff(spots, axis=0).T)
    way = np.concatenate([[0.0], np.cumsum(legs)])
    at = np.arange(0.0, way[-1], 0.05)
    path = np.column_stack([np.interp(at, way, spots[:, i]) for i in range(2)])
    knots = chance.standard_normal(int(way[-1] / 12) + 4) * chance.uniform(*hand.wobble)
    side = np.interp(at, np.arange(len(knots)) * 12.0 - 12.0, knots)
    side = np.convolve(np.pad(side, 60, "edge"), np.ones(121) / 121, "valid")
    heading = np.gradient(path, axis=0)
    heading /= np.maximum(np.hypot(*heading.T), 1e-12)[:, None]
    return path + side[:, None] * np.column_stack([-heading[:, 1], heading[:, 0]])


def _stroke(page: Image, path: NDArray[np.float64], width: float, dark: float, height: float,
            chance: np.random.Generator) -> None:
    """Lead along a path: the darkness of each spot spread over the pixels about it."""
    radius = width / 2 * FINE
    reach = math.ceil(radius + 1)
    x, y = path[:, 0] * FINE - 0.5, (height - path[:, 1]) * FINE - 0.5
    uneven = np.convolve(chance.standard_normal(len(x) + 40), np.ones(41) / 6.4, "valid")
    press = dark * np.clip(1 + 0.15 * uneven, 0, 1)
    column, row = np.rint(x).astype(int), np.rint(y).astype(int)
    for i in range(-reach, reach + 1):
        for j in range(-reach, reach + 1):
            off = np.hypot(column + i - x, row + j - y)
            lead = press * np.clip(radius + 0.5 - off, 0, 1)
            inside = (lead > 0) & (row + j >= 0) & (row + j < page.shape[0]) & (column + i >= 0) & (
                column + i < page.shape[1])
            np.maximum.at(page, (row[inside] + j, column[inside] + i), lead[inside].astype(np.float32))


def _smudge(pencil: Image, chance: np.random.Generator) -> None:
    """A finger's mark: broad, soft and faint."""
    high, wide = pencil.shape
    patch = np.zeros((high // 16 + 1, wide // 16 + 1), np.float32)
    centre = int(chance.uniform(0, patch.shape[1])), int(chance.uniform(0, patch.shape[0]))
    axes = int(chance.uniform(2, 6) * FINE / 16 + 1), int(chance.uniform(4, 15) * FINE / 16 + 1)
    cv2.ellipse(patch, centre, axes, chance.uniform(0, 180), 0, 360, chance.uniform(0.04, 0.12), -1)
    pencil += cv2.resize(cv2.GaussianBlur(patch, (0, 0), 1.5), (wide, high))


# ---- how it is seen ------------------------------------------------------------------------------------------------


def _view(sheet: Printed, size: tuple[int, int], chance: np.random.Generator, tilt: float,
          around: float) -> NDArray[np.float64]:
    """Mm of the sheet (y down) to pixels of a tilted camera that sees all of it."""
    pitch, yaw, roll = np.radians([*chance.uniform(-tilt, tilt, 2) / math.sqrt(2), chance.uniform(-around, around)])
    lean = cv2.Rodrigues(np.array([pitch, 0.0, 0.0]))[0] @ cv2.Rodrigues(np.array([0.0, yaw, 0.0]))[0]
    pose = lean @ cv2.Rodrigues(np.array([0.0, 0.0, roll]))[0]
    focal, far = 0.8 * size[0], 1.3 * max(sheet.width, sheet.height)
    corners = np.array([[0, 0], [sheet.width, 0], [sheet.width, sheet.height], [0, sheet.height]], float)
    centred = np.array([[1, 0, -sheet.width / 2], [0, 1, -sheet.height / 2], [0, 0, 1]])
    seen = np.column_stack([pose[:, 0], pose[:, 1], [0, 0, far]]) @ centred
    camera = np.array([[focal, 0, 0], [0, focal, 0], [0, 0, 1.0]]) @ seen
    flat = cv2.perspectiveTransform(corners.reshape(-1, 1, 2), camera).reshape(-1, 2)
    low, high = flat.min(axis=0), flat.max(axis=0)
    zoom = 0.95 * min(np.array(size) / (high - low))
    move = np.array(size) / 2 - zoom * (low + high) / 2
    return np.array([[zoom, 0, move[0]], [0, zoom, move[1]], [0, 0, 1]]) @ camera


def _bent(spots: NDArray[np.float64], shape: tuple[int, ...], bend: float) -> NDArray[np.float64]:
    """Pixels moved outwards (or inwards) by the square of their distance from the middle."""
    middle = np.array([shape[1], shape[0]]) / 2
    out = (spots - middle) / np.hypot(*middle)
    return middle + (spots - middle) * (1 + bend * (out**2).sum(axis=1, keepdims=True))


def _looked_at(fine: Image, turn: NDArray[np.float64], size: tuple[int, int], bend: float, table: float) -> Image:
    """The page through a camera; whatever is beside it has the lightness of the table."""
    step = 16
    x, y = np.meshgrid(np.arange(0, size[0] + step, step, float), np.arange(0, size[1] + step, step, float))
    seen = np.column_stack([x.ravel(), y.ravel()])
    flat = seen.copy()
    for _ in range(6):
        flat += seen - _bent(flat, (size[1], size[0]), bend)
    page = cv2.perspectiveTransform(flat.reshape(-1, 1, 2), np.linalg.inv(turn)).reshape(*x.shape, 2) * FINE - 0.5
    maps = [_interpolated(page[..., i], size, step) for i in range(2)]
    return cv2.remap(fine, *maps, cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT, borderValue=table)


def _interpolated(coarse: NDArray[np.float64], size: tuple[int, int], step: int) -> Image:
    """Values at every pixel between those at every `step`th."""
    along = np.arange(size[0], dtype=np.float32) / step
    down = np.arange(size[1], dtype=np.float32) / step
    grid = np.meshgrid(along, down)
    return cv2.remap(coarse.astype(np.float32), *grid, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)


def _shade(shape: tuple[int, ...], chance: np.random.Generator, most: float) -> Image:
    """Light from one side, and uneven."""
    rough = 1 - most * chance.uniform(0, 1, (3, 4)).astype(np.float32)
    return cv2.resize(rough, (shape[1], shape[0]), interpolation=cv2.INTER_CUBIC)


def _shadow(shape: tuple[int, ...], chance: np.random.Generator) -> Image:
    """A shadow with a soft edge across the page."""
    angle = chance.uniform(0, 2 * math.pi)
    x, y = np.meshgrid(np.linspace(-1, 1, 160, dtype=np.float32), np.linspace(-1, 1, 120, dtype=np.float32))
    beyond = x * math.cos(angle) + y * math.sin(angle) - chance.uniform(0, 0.6)
    dark = 1 - chance.uniform(0.15, 0.35) / (1 + np.exp(-beyond / chance.uniform(0.03, 0.12)))
    return cv2.resize(dark.astype(np.float32), (shape[1], shape[0]))


def _noisy(image: Image, chance: np.random.Generator, noise: float) -> Image:
    return image + noise * chance.standard_normal(image.shape, np.float32)


def _stored(image: Image, chance: np.random.Generator, quality: int) -> NDArray[np.uint8]:
    """Through JPEG and back."""
    coded = cv2.imencode(".jpg", np.clip(255 * image, 0, 255).astype(np.uint8), [cv2.IMWRITE_JPEG_QUALITY, quality])[1]
    return np.asarray(cv2.imdecode(coded, cv2.IMREAD_GRAYSCALE), np.uint8)


def _flip(sheet: Printed) -> NDArray[np.float64]:
    """From y up to y down."""
    return np.array([[1, 0, 0], [0, -1, sheet.height], [0, 0, 1.0]])


def _quarter(shape: tuple[int, ...]) -> NDArray[np.float64]:
    """What np.rot90 does to the pixels of a picture of this shape."""
    return np.array([[0, 1, 0], [-1, 0, shape[1] - 1], [0, 0, 1.0]])
